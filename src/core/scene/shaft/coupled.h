/* Modes of a shaft coupled by damping: all together, by the matrix exponential of their system. */
#ifndef ROT_SHAFT_COUPLED_H
#define ROT_SHAFT_COUPLED_H

#include "ground/dd.h"
#include "maths/propagator.h"
#include "scene/shaft/modes.h"

/* exp(A h) of y' = A y. State: p (q/h of rigid-body modes) in n places, r in n places, the torque
 * in one. The modes have unit mass: A is antisymmetric except for the damping, so that exp(A t), t
 * > 0, does not grow. */
typedef struct rot_shaft_stepper {
  size_t size;  /* 2 n + 1 */
  double step;  /* h, s */
  double scale; /* of the rigid-body modes, 1/h */
  double unit;  /* value of the last place */
  double *a;    /* A h, size x size */
  double *e;    /* exp(A h), size x size */
  double *work; /* of rot_expm() */
} rot_shaft_stepper;

/* n => number of doubles for a, e and work of a stepper. */
size_t rot_shaft_coupled_room(size_t n);
/* memory => stepper that uses it. */
rot_shaft_stepper rot_shaft_stepper_in(size_t n, double memory[]);

/* (modes, h) => A h, exp(A h). */
rot_status rot_shaft_set_step(const rot_shaft_modes *s, rot_shaft_stepper *y, double h);

/* state of the system => p (or q) and r of the modes. */
void rot_shaft_coupled_read(const rot_shaft_modes *s, const rot_shaft_stepper *y,
                            const double state[], double p[], double r[]);

/* ---- from the start -------------------------------------------------------------------------- */

enum { ROT_SHAFT_SHIFTS = 2 };

/* Modes at any time, in twice the precision: what is left is the rounding of the modes and of the
 * start, whose effect motions with moved inputs tell. */
typedef struct rot_shaft_coupled {
  const rot_shaft_modes *s;
  int rated;         /* 1: with errors */
  double rate, unit; /* scale of the angles of rigid-body modes, 1/s; value of the last place */
  double *memory;
  rot_dd *now, *moved;
  double *error, errors_s; /* last errors found, and when */
  rot_shaft_modes shifted[ROT_SHAFT_SHIFTS];
  rot_propagator propagator[2][1 + ROT_SHAFT_SHIFTS]; /* forwards, backwards */
} rot_shaft_coupled;

/* modes => *x; rated: 1 with errors, 0 with none (0). Call rot_shaft_coupled_end() afterwards, also
 * after a failure. */
rot_status rot_shaft_coupled_begin(rot_shaft_coupled *x, const rot_shaft_modes *s, int rated);
/* t since the start => p and r (or q) of the modes, their errors: of r, then of p. */
rot_status rot_shaft_coupled_at(rot_shaft_coupled *x, rot_dd t, double p[], double r[],
                                double error[]);
/* Frees the memory. */
void rot_shaft_coupled_end(rot_shaft_coupled *x);

/* h => one step of it. */
rot_status rot_shaft_coupled_step(rot_shaft_coupled *x, double h, rot_shaft_stepper *y);
/* (step, state before it) => added to the errors of the modes. */
void rot_shaft_step_errors(const rot_shaft_coupled *x, const rot_shaft_stepper *y,
                           const double state[], double error[]);

#endif
