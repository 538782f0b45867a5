/* Probes: the right-hand side is called along the path that was found, and compared with the slope
 * that the steps' polynomials have there. A law that differs in a narrow interval of time or of one
 * component of the state is otherwise passed over: no stage of any step need lie in it.
 *
 * Coordinates are time and the controlled components. Each is covered over the whole range that the
 * motion visits: no gap between places where the law is known to be what the steps believed exceeds
 * ROT_ODE_GAP of the resolution. Stages of steps with an error test count as such places, so that a
 * motion in many steps takes few probes. A component that visits its range many times is covered
 * once. */
#ifndef ROT_ODE_PROBE_H
#define ROT_ODE_PROBE_H

#include "engine/ode/trace.h"

/* Gap of the probes, of the width that is sure to be found: a bump (1 + cos) / 2 of this width that
 * lies half way between two probes still shows 0.2 of its height. With 0.78, which takes 4 % fewer
 * calls, the dip of 1.12 times this width at 0.7813 of tests/core/engine/ode/test_probe.c is passed
 * over. */
#define ROT_ODE_GAP 0.7

enum { ROT_ODE_MAX_SIGHTS = 32 };

/* A place where the law is not what the steps believed, and the last and the next where it is. */
typedef struct rot_ode_sight {
  size_t component; /* of the slope that differs */
  size_t measure;   /* that this changes most of its size, */
  double worth;     /* by so much at most; Inf: not defined there, or no longer held */
  int mode;
  double t[3]; /* before, at, behind */
  double *y;   /* dim of each */
} rot_ode_sight;

typedef struct rot_ode_probes {
  const rot_ode_params *p;
  size_t bins;                 /* of each coordinate; the last coordinate is time */
  double *low, *width, *since; /* of each coordinate; since: where the gap began, NaN: covered */
  double *span;                /* of a piece: each coordinate at even times */
  unsigned char *seen;
  int looked; /* the ranges are known */
  size_t n_sights;
  rot_ode_sight sight[ROT_ODE_MAX_SIGHTS];
  /* The probes of a piece: t, state and slope each. `undecided`: what its polynomials believe is
   * too unsure for one of them. */
  int undecided;
  size_t n_values, room;
  double *values;
  double *scratch; /* 9 dim */
  double *states;  /* of the sights */
} rot_ode_probes;

/* A smooth part of the path: a step, or the time between two of its nodes. */
typedef struct rot_ode_piece {
  double t, end;
  int held;             /* at rest by friction */
  size_t n_called;      /* fractions of the piece at which the steps called the law */
  const double *called; /* covered here, or by the step itself where `covered` */
  int smooth; /* the slope changes little on the way: its values may be compared among themselves */
  int covered;
  const double *largest; /* the size of each measure so far */
  void *path;
  /* The controlled components, to a small part of the gap. */
  void (*state)(void *path, double t, double y[]);
  /* State and slope as the steps believe them, and how unsure these are; 0: unknown here. */
  int (*believed)(void *path, double t, double y[], double slope[], double y_unsure[],
                  double slope_unsure[]);
  rot_status (*call)(void *path, double t, const double y[], double dydt[]);
} rot_ode_piece;

/* NULL: no memory. */
rot_ode_probes *rot_ode_probes_new(const rot_ode_params *p);
void rot_ode_probes_free(rot_ode_probes *q);
/* Nothing is covered, nothing was seen; `clear`: no range is known either. */
void rot_ode_probes_uncover(rot_ode_probes *q);
void rot_ode_probes_clear(rot_ode_probes *q);
/* Only sights remain that the error of their measure does not explain. */
void rot_ode_probes_sift(rot_ode_probes *q, const double error[]);
/* The ranges that a run visits, from its nodes on both sides. */
void rot_ode_probes_range(rot_ode_probes *q, const rot_ode_trace traces[2]);

/* The law was called here, by a step that would not have been accepted if it were another. */
void rot_ode_probes_cover(rot_ode_probes *q, double t, const double y[]);

/* Covers what a piece visits that is not covered yet. Any status but ROT_OK ends the run. */
rot_status rot_ode_probe(rot_ode_probes *q, const rot_ode_piece *piece);

/* The state that is believed at t, and the law's own value there, compared; *known = 0: the
 * polynomials are no good there. */
rot_status rot_ode_probe_at(rot_ode_probes *q, const rot_ode_piece *piece, double t, double dydt[],
                            int *known);

#endif
