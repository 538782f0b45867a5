/* The right-hand side as the steps call it: between breaks, counted, finite, and with the state
 * kept on the sides of the surfaces on which it is.
 *
 * Switching surfaces: values of one component of the state, or times, where the right-hand side
 * jumps or kinks, found in a run, known from then on. On either side the right-hand side is
 * evaluated with the component kept on that side, so that a step sees no jump; the step that passes
 * it ends on it. Where the slopes of both sides point to the surface the motion slides along it
 * (Filippov, Differential Equations with Discontinuous Righthand Sides, 1988): sign(omega) is dry
 * friction. */
#ifndef ROT_ODE_LAW_H
#define ROT_ODE_LAW_H

#include "engine/ode/state.h"

enum { ROT_ODE_MAX_SURFACES = 1024 };
#define NO_SURFACE ((size_t)-1)

typedef struct rot_ode_surface {
  size_t component; /* dim: time */
  double below, above;
} rot_ode_surface;

typedef struct rot_ode_surfaces {
  size_t count;
  rot_ode_surface surface[ROT_ODE_MAX_SURFACES];
} rot_ode_surfaces;

/* t and controlled components of the first calls of an attempt of rk8pd, beside its given slope. */
enum { ROT_ODE_CALLS = 13 };
typedef struct rot_ode_calls {
  size_t count;
  double *data; /* NULL: not recorded */
} rot_ode_calls;

/* Whether stability limits the steps of an explicit method, by Hairer's test: the last two calls of
 * a step are at the same time, the last stage and the result; the difference of their slopes over
 * their own is what h times has a limit (Hairer, Norsett & Wanner, Solving ODEs II, IV.2). */
typedef struct rot_ode_stiffness {
  const rot_ode_params *p;
  const double *largest; /* size of each measure so far */
  double t, *y, *f;      /* of the last call; t is NaN where no call of this step is known */
  double rate;           /* of the last step, in 1/s */
  int stiff, calm;       /* steps one after the other */
} rot_ode_stiffness;

typedef struct rot_ode_law {
  const rot_ode_params *p;
  const rot_ode_clock *clock;     /* breaks */
  rot_info *info;                 /* its counts; where rhs is not defined, time_s */
  rot_status status;              /* of the last call */
  rot_ode_surfaces *surfaces;     /* of all runs */
  int side[ROT_ODE_MAX_SURFACES]; /* of each surface; 0: slides along it */
  size_t slides;                  /* the surface that it slides along, or NO_SURFACE */
  double *kept, *beside, *beyond; /* dim each: a state on its sides; slopes on both sides */
  rot_ode_calls *record;          /* takes the calls; NULL: none does */
  rot_ode_stiffness *stiffness;   /* the same */
} rot_ode_law;

/* Of a time, not of a component. */
static inline int rot_ode_is_time(const rot_ode_law *law, size_t surface) {
  return law->surfaces->surface[surface].component == law->p->dim;
}

rot_status rot_ode_slope_at(rot_ode_law *law, double t, const double y[], double dydt[]);

/* The slope at the state, into it. */
rot_status rot_ode_know_slope(rot_ode_law *law, rot_ode_state *state);
/* ROT_ERANDOM where two calls at the state differ by more than the accuracy, of the slope: a law
 * that draws random numbers, or keeps count, has no solution that steps converge to. */
rot_status rot_ode_check_repeats(rot_ode_law *law, rot_ode_state *state, double work[]);

/* t as the sides of the surfaces in time allow. */
double rot_ode_keep_time(const rot_ode_law *law, double t);
/* Positive while it slides. */
double rot_ode_hold_of_slide(rot_ode_law *law, double t, const double y[]);

/* After a step of length h with so much time left: another method is to take over. */
int rot_ode_is_stiff(rot_ode_stiffness *s, double h, double left);

/* Adds a surface that is not there yet; whether it did. `below` and `above`: values on its two
 * sides, equal at a kink. component = dim: time. `size`: of a step, in time. */
int rot_ode_add_surface(rot_ode_surfaces *surfaces, size_t component, double below, double above,
                        double size);

/* The side of a surface, or of all, at the start of a run or where a surface was added. */
rot_status rot_ode_choose_side(rot_ode_law *law, rot_ode_state *state, size_t surface);
rot_status rot_ode_choose_sides(rot_ode_law *law, rot_ode_state *state);
/* The state lies on the surface: the side that the motion goes on, or that it slides. */
rot_status rot_ode_pass_surface(rot_ode_law *law, rot_ode_state *state, size_t surface);

/* The first time surface before `stop`, or stop. */
double rot_ode_next_stop(const rot_ode_law *law, double stop);
/* Whether it is time for a time surface that is still ahead; and past it. */
int rot_ode_at_time_surface(const rot_ode_law *law);
void rot_ode_pass_time(rot_ode_law *law, rot_ode_state *state);

#endif
