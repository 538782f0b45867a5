/* Modes of a shaft coupled by damping: all together, by the matrix exponential of their system. */
#ifndef ROT_SHAFT_COUPLED_H
#define ROT_SHAFT_COUPLED_H

#include "ground/dd.h"
#include "scene/shaft/modes.h"

/* exp(A h) of y' = A y. State: p (q/h of rigid-body modes) in n places, r in n places, the torque
 * in one. The modes have unit mass: A is antisymmetric except for the damping, so that exp(A t), t
 * > 0, does not grow. */
typedef struct rot_shaft_stepper {
  size_t size;  /* 2 n + 1 */
  double step;  /* h, s */
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

/* t since the start => state, p and r, by one exponential. */
rot_status rot_shaft_jump(const rot_shaft_modes *s, rot_shaft_stepper *y, rot_dd t, double state[],
                          double p[], double r[]);

/* (t, p, r) => errors of the modes. extra: additional error of steps in between, as a multiple. */
void rot_shaft_coupled_errors(const rot_shaft_modes *s, double t, double extra, const double p[],
                              const double r[], double error[]);

#endif
