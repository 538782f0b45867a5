/* Drag of first and second order on a rate omega >= 0:
 *
 *   omega' = a - b omega - k omega^2,   a = drive/I, b = viscous/I >= 0, k = quadratic/I >= 0.
 *
 * The flow is a quotient of linear functions of omega0 for either sign of the discriminant
 * D = b^2/4 + a k. The branches do not cancel; units of time and rate are powers of two, so I, the
 * torques and the times may have any size. */
#ifndef ROT_DRAG_H
#define ROT_DRAG_H

#include "ground/ieee.h"

typedef struct rot_drag_law {
  double drive_n_m, drive_lo; /* any sign, to twice the precision */
  double viscous_n_m_s;       /* >= 0 */
  double quadratic_n_m_s2;    /* >= 0 */
  double inertia_kg_m2;       /* > 0 */
} rot_drag_law;

/* Constants of the flow from one state, in the units 2^time_exp s and 2^omega_exp rad/s. */
typedef struct rot_drag {
  int time_exp, omega_exp;
  double a, b, k, omega0;
  double s, s_lo; /* sqrt |D| to twice the precision */
  int turns;      /* 1: D <= 0, sine and cosine instead of the exponential */
  double rest;    /* root a/(s + b/2): the terminal rate if a >= 0 */
  double slope;   /* b/2 + k omega0 */
} rot_drag;

/* Errors are bounds on the roundings of this evaluation. */
typedef struct rot_drag_state {
  double omega, theta;             /* rad/s, rad */
  double omega_error, theta_error; /* >= 0 */
  double gain;                     /* derivative of omega with respect to omega0 */
  double reach_s;                  /* derivative of theta with respect to omega0, s */
} rot_drag_state;

/* (law, omega0 >= 0) => flow for times up to span_s >= 0 with k omega0 t up to 1e300 */
rot_drag rot_drag_from(const rot_drag_law *law, double omega0, double span_s);
/* (flow, t + t_lo >= 0, before the stop) => state */
rot_drag_state rot_drag_at(const rot_drag *flow, double t, double t_lo);
/* flow => time at which omega reaches 0, 4 ulp; Inf if it never does */
double rot_drag_stop(const rot_drag *flow);
/* law => limit of omega: 0 for a <= 0, Inf without resistance */
double rot_drag_terminal(const rot_drag_law *law);
/* (law without drive, omega0 >= 0) => limit of the angle: I/q log(1 + q omega0/c) with the
 * quadratic coefficient q, I omega0/c without it, Inf without c; NaN with a drive. 4 ulp. */
double rot_drag_reach(const rot_drag_law *law, double omega0);

#endif
