/* Drag of first and second order on a rate that is not negative:
 *
 *   omega' = a - b omega - k omega^2,   a = drive/I, b = viscous/I >= 0, k = quadratic/I >= 0.
 *
 * The flow is a fraction of linear functions of omega0 whatever the sign of the discriminant
 * D = b^2/4 + a k. It is written in branches that do not cancel, in units of time and rate that are
 * powers of two, so that I, the torques and the times may have any size. */
#ifndef ROT_DRAG_H
#define ROT_DRAG_H

#include "ground/ieee.h"

typedef struct rot_drag_law {
  double drive_n_m, drive_lo; /* any sign, to twice the precision */
  double viscous_n_m_s, quadratic_n_m_s2, inertia_kg_m2;
} rot_drag_law;

/* The flow from one state, made ready. All numbers are in the units 2^time_exp and 2^omega_exp. */
typedef struct rot_drag {
  int time_exp, omega_exp;
  double a, b, k, omega0;
  double s, s_lo; /* sqrt |D| to twice the precision */
  int turns;      /* D <= 0: sine and cosine instead of the exponential */
  double rest;    /* the root a/(s + b/2): the terminal rate where a >= 0 */
  double slope;   /* b/2 + k omega0 */
} rot_drag;

/* Errors are bounds on the roundings of this evaluation. gain and reach are the derivatives of
 * omega and theta with respect to omega0, by which an error of omega0 counts. */
typedef struct rot_drag_state {
  double omega, theta, omega_error, theta_error, gain, reach_s;
} rot_drag_state;

/* From omega0 >= 0, for times up to some span_s >= 0; k omega0 t up to 1e300. */
rot_drag rot_drag_from(const rot_drag_law *law, double omega0, double span_s);
/* After t + t_lo >= 0, before the stop. */
rot_drag_state rot_drag_at(const rot_drag *flow, double t, double t_lo);
/* When omega reaches 0: 4 ulp; Inf if it never does. */
double rot_drag_stop(const rot_drag *flow);
/* Where omega tends to: 0 where a <= 0, Inf where nothing resists. */
double rot_drag_terminal(const rot_drag_law *law);
/* The angle turned from omega0 >= 0 on where omega tends to 0 and never reaches it (no drive):
 * I/q log(1 + q omega0/c) with the quadratic coefficient q, I omega0/c without it, Inf without c;
 * NaN with a drive. 4 ulp. */
double rot_drag_reach(const rot_drag_law *law, double omega0);

#endif
