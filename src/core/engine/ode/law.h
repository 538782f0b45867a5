/* The right-hand side as the steps call it: between breaks, counted, finite, and with the state
 * kept on the sides of the walls (engine/ode/wall.h) on which it is. */
#ifndef ROT_ODE_LAW_H
#define ROT_ODE_LAW_H

#include "engine/ode/clock.h"
#include "engine/ode/state.h"
#include "engine/ode/stiff.h"

/* Where the right-hand side jumps or kinks: see engine/ode/wall.h. */
enum { ROT_ODE_MOST_WALLS = 1024 };
#define NO_WALL ((size_t)-1)

typedef struct rot_ode_wall {
  size_t component; /* dim: time */
  double below, above;
} rot_ode_wall;

typedef struct rot_ode_walls {
  size_t count;
  rot_ode_wall wall[ROT_ODE_MOST_WALLS];
} rot_ode_walls;

/* t and controlled components of the first calls of an attempt of rk8pd, beside its given slope. */
enum { ROT_ODE_CALLS = 13 };
typedef struct rot_ode_calls {
  size_t count;
  double *data; /* NULL: not recorded */
} rot_ode_calls;

typedef struct rot_ode_law {
  const rot_ode_params *p;
  const rot_ode_clock *clock;     /* breaks */
  rot_info *info;                 /* its counts; where rhs is not defined, time_s */
  rot_status status;              /* of the last call */
  rot_ode_walls *walls;           /* of all runs */
  int side[ROT_ODE_MOST_WALLS];   /* of each wall; 0: slides along it */
  size_t slides;                  /* the wall that it slides along, or NO_WALL */
  double *kept, *beside, *beyond; /* dim each: a state on its sides; slopes on both sides */
  rot_ode_calls *record;          /* takes the calls; NULL: none does */
  rot_ode_stiffness *stiffness;   /* the same */
} rot_ode_law;

/* Of a time, not of a component. */
static inline int rot_ode_is_time(const rot_ode_law *law, size_t wall) {
  return law->walls->wall[wall].component == law->p->dim;
}

/* The right-hand side in GSL's form. */
int rot_ode_slope_at(double t, const double y[], double dydt[], void *law);

/* The slope at the state, into it. */
rot_status rot_ode_know_slope(rot_ode_law *law, rot_ode_state *state);

/* ROT_ERANDOM where two calls at the state differ by more than the accuracy, of the slope: a law
 * that draws random numbers, or keeps count, has no solution that steps converge to. */
rot_status rot_ode_check_repeats(rot_ode_law *law, rot_ode_state *state, double work[]);

/* t as the sides of the walls in time allow. */
double rot_ode_keep_time(const rot_ode_law *law, double t);

/* Positive while it slides; the level of the wall that the next side begins at. */
double rot_ode_hold_of_slide(rot_ode_law *law, double t, const double y[]);
double rot_ode_wall_level(const rot_ode_law *law, size_t wall);

/* Slopes on both sides of a wall. */
int rot_ode_both_slopes(rot_ode_law *law, size_t wall, double t, const double y[], double below[],
                        double above[]);

#endif
