/* The right-hand side as the steps call it: between breaks, counted, finite, and with the state
 * kept on the sides of the walls (engine/ode/wall.h) on which it is. */
#ifndef ROT_ODE_LAW_H
#define ROT_ODE_LAW_H

#include "engine/ode/run.h"

/* Below, doubles have no 16 digits left that an error test could ask for. */
#define ROT_ODE_LEAST_SIZE 1e-290

/* Calls of an attempt of rk8pd beside its given slope, which run->called takes. */
enum { ROT_ODE_CALLS = 13 };

/* Of a time, not of a component. */
static inline int rot_ode_is_time(const rot_ode_march *run, size_t wall) {
  return run->walls->wall[wall].component == run->p->dim;
}

/* The right-hand side in GSL's form: on this side of the breaks, counted, and finite. */
int rot_ode_slope_at(double t, const double y[], double dydt[], void *march);

/* The slope at (run->t, run->y), into run->slope. */
rot_status rot_ode_know_slope(rot_ode_march *run);

/* ROT_ERANDOM where two calls at (run->t, run->y) differ by more than the accuracy, of the slope: a
 * law that draws random numbers, or keeps count, has no solution that steps converge to. */
rot_status rot_ode_check_repeats(rot_ode_march *run);

/* *t and y (dim) as the sides of the walls allow. */
void rot_ode_keep_sides(const rot_ode_march *run, double *t, double y[]);
double rot_ode_keep_time(const rot_ode_march *run, double t);

/* Slope where the motion slides along run->slides. */
int rot_ode_sliding_slope(rot_ode_march *run, double t, const double y[], double dydt[]);

/* Positive while it slides; the level of the wall that the next side begins at. */
double rot_ode_hold_of_slide(rot_ode_march *run, double t, const double y[]);
double rot_ode_wall_level(const rot_ode_march *run, size_t wall);

/* Slopes on both sides of a wall; the caller restores the side. */
int rot_ode_both_slopes(rot_ode_march *run, size_t wall, double t, const double y[], double below[],
                        double above[]);

#endif
