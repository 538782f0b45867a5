/* A body that coasts down, with the sensitivities of its motion to everything that is fitted:
 *
 *   omega' = -(a + b |omega| + k omega^2) sign(omega),  a = tau_c/I, b = c/I, k = q/I,
 *
 * where a torque may act until a time: omega' gains T/(I + J) and the losses count I/(I + J), with
 * J an inertia added while it acts (the mass that unwinds from a drum). The torque may change in
 * steps at given times. Losses of any sign, as a fit without bounds meets them. Where none is
 * negative the motion is that of rot_drag.
 *
 * The sensitivities follow from sample to sample by the integrals of the flow's own derivatives
 * (numerics-measurement M5), in the variable tanh(s t)/s, where they are rational. */
#ifndef ROT_COAST_H
#define ROT_COAST_H

#include <stddef.h>

#include "ground/status.h"

enum {
  ROT_COAST_THETA, /* at the start */
  ROT_COAST_OMEGA,
  ROT_COAST_COULOMB, /* a, b, k */
  ROT_COAST_VISCOUS,
  ROT_COAST_QUADRATIC,
  ROT_COAST_LOAD,    /* what multiplies the torque and the added inertia */
  ROT_COAST_RELEASE, /* when they cease, s */
  ROT_COAST_PARAMETERS
};

/* T/I and J/I where the multiplier p[ROT_COAST_LOAD] is 1. `scales`: J/I is multiplied, too (the
 * unknown is 1/I or the mass), not T/I alone (gravity). No torque: 0, 0. Behind each step_s
 * (increasing) T/I is that of the step. */
typedef struct rot_coast_load {
  double torque_ratio, added_ratio;
  int scales;
  size_t steps;
  const double *step_s, *step_ratio;
} rot_coast_load;

/* theta, omega and, where they are not NULL, their derivatives: n rows of ROT_COAST_PARAMETERS
 * numbers. Times do not decrease and are not before start_s. ROT_ERANGE: a motion with negative
 * losses that grows without bound before the last time. */
rot_status rot_coast_rows(const rot_coast_load *load, const double p[ROT_COAST_PARAMETERS],
                          double start_s, size_t n, const double t[], double theta[],
                          double omega[], double d_theta[], double d_omega[]);

#endif
