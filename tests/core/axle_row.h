/* One row of an axle's model, and whether it is as good as it says. */
#ifndef AXLE_ROW_H
#define AXLE_ROW_H

#include "scene/axle/axle.h"
#include "rot_test.h"

static double got[7];
static const rot_axle_columns columns = {got, got + 1, got + 2, got + 3, got + 4, got + 5, got + 6};

/* Within the bound that comes with it (and half an ulp of the wanted number as it is written),
 * which is itself a few roundings of the largest value met. */
static void check_row(const rot_info *info, double theta, double omega, double looseness) {
  ROT_CHECK(fabs(got[0] - theta) <= info->measure[ROT_THETA].error + 0x1p-53 * fabs(theta));
  ROT_CHECK(fabs(got[1] - omega) <= info->measure[ROT_OMEGA].error + 0x1p-53 * fabs(omega));
  ROT_CHECK(rot_info_error(info) <= looseness);
}

#endif
