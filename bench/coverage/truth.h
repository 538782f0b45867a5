/* The motion of an axle in quadruple precision, from its equation alone: extrapolated midpoint
 * steps (Gragg, Bulirsch, Stoer) that end at each break and at each change of the law in omega. It
 * shares no formula with the models that it judges. */
#ifndef TRUTH_H
#define TRUTH_H

#include "midpoint.h"
#include "scene/axle/scene.h"

/* theta and omega at times (not decreasing, from start_s on); the largest |theta| and |omega| that
 * occurred at the steps. Returns 0, or 1 without convergence. */
int truth_run(const rot_axle_scene *scene, size_t n, const double time_s[], quad theta[],
              quad omega[], double *theta_max, double *omega_max);

#endif
