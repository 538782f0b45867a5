/* Steps of fixed length: the methods of the classroom.
 *
 *   euler          y' = y + h f(t, y)                                        order 1
 *   semi_implicit  the rates so, then the positions by the new rates         order 1
 *   rk4            the classical Runge-Kutta method                          order 4
 *
 * Steps have the length asked for from the start, a break or an event that changes the law; the
 * last one before the next is shorter. A row between two ends of steps takes a shorter step from
 * the one before. The error is found by a second run, which takes each step in two halves, the
 * shorter ones included.
 *
 * Reference: Hairer, Norsett & Wanner, Solving Ordinary Differential Equations I, II.1 and II.4. */
#ifndef ROT_ODE_FIXED_H
#define ROT_ODE_FIXED_H

#include "engine/model.h"
#include "engine/ode/rows.h"

/* What the difference of a run of this order and one of half its steps is worth, as the error of
 * the first: 2^n/(2^n - 1), but for the next order's part of it, which may be a quarter with the
 * other sign: 2.4 at order 1, 1.08 at 4. That part goes with the step, the difference with its n-th
 * power: from 0.06 and 2e-5 of the motion's `size` on the part is larger, at last a half: 4 and
 * 1.10. */
double rot_ode_fixed_factor(int order, double difference, double size);

/* Rounding of this many steps, relative to the size of what they add up: at random, and alike where
 * each adds the same (at most 0.121 eps for a step in 300 sums of 500 to 4000 equal numbers). */
double rot_ode_fixed_rounding(double steps);

/* As rot_ode_run(), with p->method of those above and p->step_s > 0. */
rot_status rot_ode_run_fixed(const rot_ode_params *p, const rot_ode_output *out,
                             const rot_hooks *hooks, rot_info *info);

/* Of a run of which no step is given: 1/64 of the shortest period or decay of the start; 1/1000 of
 * the span where there is none. */
double rot_fixed_step_s(const rot_time_scales *time_scales, double span_s);
double rot_fixed_task_step_s(const rot_task *task, double start_s,
                             const rot_time_scales *time_scales);
/* Predicted time of a run: seconds of a step. `calls`: the scene has a law of the caller. */
double rot_fixed_cost_s(const rot_model *model, const rot_query *query, double start_s, int calls,
                        const rot_time_scales *time_scales);

/* The three models of a constraint, items of its list, and their runs. */
#define ROT_FIXED_MODELS(prefix, takes, why_not, cost_s)                                           \
  ROT_FIXED_MODEL(prefix "euler", takes, "explicit Euler: order 1", why_not, cost_s, 0.25e-6),     \
      ROT_FIXED_MODEL(prefix "semi_implicit", takes, "semi-implicit Euler: order 1", why_not,      \
                      cost_s, 0.25e-6),                                                            \
      ROT_FIXED_MODEL(prefix "rk4", takes, "Runge-Kutta: order 4", why_not, cost_s, 0.4e-6)
#define ROT_FIXED_MODEL(id, takes, steps, why_not, cost_s, step_s)                                 \
  {                                                                                                \
    id, takes, ROT_ESTIMATE, 1.0, ROT_BY_NAME, "steps of fixed length, " steps, why_not, cost_s, { \
      step_s, 0.0, 0.0, 0.0                                                                        \
    }                                                                                              \
  }
#define ROT_FIXED_METHODS(run)                                                                     \
  {ROT_METHOD_EULER, run}, {ROT_METHOD_SEMI_IMPLICIT, run}, { ROT_METHOD_RK4, run }

#endif
