/* The designs of the sweep: the disk of the spin-up with 0.5 to 1.5 times its inertia, and 0.5 to
 * 1.5 times its damping in an order of its own. `u` in [0, 1) is the row's number in FILE. */
#ifndef BENCH_SWEEP_H
#define BENCH_SWEEP_H

#include <math.h>

#include "spin-up.h"

static inline double sweep_inertia(double u) { return spin_inertia * (0.5 + u); }

static inline double sweep_viscous(double u) {
  const double v = 1000.0 * u;
  return spin_viscous * (0.5 + (v - floor(v)));
}

#endif
