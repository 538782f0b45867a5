/* A body that turns about a point, by steps of fixed length: the methods of the classroom, and a
 * splitting for long runs without friction.
 *
 *   euler          q and L (body axes) go on by h times their slopes.          order 1
 *   semi_implicit  L (space axes) first, then q with the rate that follows:    order 1
 *                  without torque L stays, the energy does not
 *   rk4            the classical Runge-Kutta method                            order 4
 *   split          exact turns and kicks: gravity alone                        order 6
 *
 * The splitting takes T = |L|^2/(2 Ia) + L_b^2 (1/Ib - 1/Ia)/2 + L_c^2 (1/Ic - 1/Ia)/2, with a the
 * middle axis: each part turns the body by constant rates, and gravity's kick changes L alone. The
 * pieces are composed to order 6. L along the vertical and |q| stay to rounding, the energy
 * within a bound that does not grow. Rotors with a constant momentum h add -h.(L/I), which turns
 * the body by a constant rate.
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

/* NULL, or why the splitting does not take these rotors. */
const char *rot_free_not_split(const rot_free_params *p);

/* The order of a method. */
int rot_free_step_order(rot_method method);

/* A step of 1/64 (split: 1/32) of the time 2 pi/rate, with the rate |omega0| + sqrt(torque/least
 * moment) + |damping| of the start; where that is 0, 1/1000 of the span. */
double rot_free_default_step(const rot_free_params *p, rot_method method, double span_s);

/* As rot_free_integrate(). Steps have the length asked from the start, or from a break of the
 * torque; up to the next break they are shortened by less than one part in their number. A row
 * between two ends of steps takes a shorter one. A second run, with half the step, tells the
 * errors. The split takes gravity alone. */
rot_status rot_free_step_through(const rot_free_params *p, const rot_free_step_options *options,
                                 size_t n, const double time_s[], const rot_free_columns *out,
                                 double *const flow[ROT_FREE_FLOWS],
                                 double flow_error[ROT_FREE_FLOWS], const rot_hooks *hooks,
                                 rot_info *info);

#endif
