/* The motion of an axle in quadruple precision, from its equation alone: extrapolated midpoint steps
 * (Gragg, Bulirsch, Stoer), every break and every change of the law in omega stepped on. It shares
 * no formula with the models that are judged by it. */
#ifndef TRUTH_H
#define TRUTH_H

#include "rot_axle_scene.h"

typedef __float128 quad;

/* theta and omega at times (not decreasing, from start_s on); largest |theta| and |omega| on the way
 * as far as it was seen. Returns 0, or 1 where it gave up. */
int truth_run(const rot_axle_scene *scene, size_t n, const double time_s[], quad theta[],
              quad omega[], double *theta_max, double *omega_max);

#endif
