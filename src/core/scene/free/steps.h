/* Fixed-step methods for a body rotating about a point: textbook methods, and a splitting for long
 * frictionless runs.
 *
 *   euler          q and L (body axes): explicit Euler                         order 1
 *   semi_implicit  L (space axes) first, then q with the new rate:             order 1
 *                  without torque L is conserved, the energy is not
 *   rk4            classical Runge-Kutta method                                order 4
 *   split          exact rotations and kicks; gravity only                     order 6
 *
 * The splitting uses T = |L|^2/(2 Ia) + L_b^2 (1/Ib - 1/Ia)/2 + L_c^2 (1/Ic - 1/Ia)/2, a the middle
 * axis: each part rotates the body at constant rates; the kick of gravity changes L only. The parts
 * are composed to order 6. L along the vertical and |q| are conserved up to rounding, the energy
 * within a bound that does not grow. Rotors with a constant momentum h add -h.(L/I), which rotates
 * the body at a constant rate.
 *
 * References: Hairer, Lubich & Wanner 2006, sections VII.5 and V.3; Kahan & Li, Math. Comp. 66
 * (1997) 1089 (s9odr6a); McLachlan, SIAM J. Sci. Comput. 16 (1995) 151. */
#ifndef ROT_FREE_STEPS_H
#define ROT_FREE_STEPS_H

#include "scene/free/free.h"

typedef struct rot_free_step_options {
  rot_method method; /* one of those above */
  double step_s;     /* > 0 */
  size_t max_steps;
} rot_free_step_options;

/* parameters => NULL, or why the splitting does not apply to these rotors. */
const char *rot_free_not_split(const rot_free_params *p);

/* method => its order. */
int rot_free_step_order(rot_method method);

/* Default step: 1/64 (split: 1/32) of 2 pi/rate with rate = |omega0| + sqrt(torque/min moment) +
 * |damping| at the start; rate 0: 1/1000 of the span. */
double rot_free_default_step(const rot_free_params *p, rot_method method, double span_s);

/* (parameters, options, times) => rows, flows, errors, as rot_free_integrate(). Steps have the
 * given length, from the start or from a break of the torque. Before a break, n steps are each
 * shortened by less than the fraction 1/n. A row between two step ends has a shorter step. Errors:
 * from a second run with half the step. The splitting takes gravity only. */
rot_status rot_free_step_through(const rot_free_params *p, const rot_free_step_options *options,
                                 size_t n, const double time_s[], const rot_free_columns *out,
                                 double *const flow[ROT_FREE_FLOWS],
                                 double flow_error[ROT_FREE_FLOWS], const rot_hooks *hooks,
                                 rot_info *info);

#endif
