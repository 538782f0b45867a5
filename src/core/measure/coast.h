/* A body that coasts down, with sensitivities of its motion to all fitted parameters:
 *
 *   omega' = -(a + b |omega| + k omega^2) sign(omega),  a = tau_c/I, b = c/I, k = q/I,
 *
 * A torque may act until a given time: it adds T/(I + J) to omega' and multiplies the losses by
 * I/(I + J), with J an inertia added during that time (the mass that unwinds from a drum). The
 * torque may change in steps at given times. The losses may have any sign, for fits without bounds;
 * if none is negative, the motion is that of rot_drag.
 *
 * Sensitivities are propagated from sample to sample by integrals of the derivatives of the flow
 * (numerics-measurement M5), in the variable tanh(s t)/s, in which they are rational. */
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
  ROT_COAST_LOAD,    /* multiplier of the torque and the added inertia */
  ROT_COAST_RELEASE, /* end of the load, s */
  ROT_COAST_PARAMETERS
};

/* Torque and added inertia for a multiplier p[ROT_COAST_LOAD] of 1. */
typedef struct rot_coast_load {
  double torque_ratio; /* T/I, 0: no torque */
  double added_ratio;  /* J/I >= 0 */
  int scales; /* 1: the multiplier also applies to J/I (unknown 1/I or mass); 0: to T/I only */
  size_t steps;
  const double *step_s;     /* times at which T/I changes, increasing */
  const double *step_ratio; /* T/I after each of them */
} rot_coast_load;

/* (load, p, n non-decreasing times from start_s on) => theta, omega, their derivatives (n rows of
 * ROT_COAST_PARAMETERS numbers; may be NULL). ROT_ERANGE for a motion with negative losses that
 * grows without bound before the last time. */
rot_status rot_coast_rows(const rot_coast_load *load, const double p[ROT_COAST_PARAMETERS],
                          double start_s, size_t n, const double t[], double theta[],
                          double omega[], double d_theta[], double d_omega[]);

#endif
