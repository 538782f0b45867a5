/* Modes of a shaft that damping couples: all together, by the exponential of their system. */
#ifndef ROT_SHAFT_COUPLED_H
#define ROT_SHAFT_COUPLED_H

#include "ground/dd.h"
#include "scene/shaft/modes.h"

/* State (p or q/T in n places, r in n places, the torque as one number) after a step h obeys
 * y' = A y; `a` is A h. Velocities have masses 1, so A is -A' but for the damping, and exp(A t)
 * does not grow. */
typedef struct rot_shaft_stepper {
  size_t size;
  double step, unit; /* h; the value of the last place */
  double *a, *e, *work;
} rot_shaft_stepper;

/* Doubles for a stepper's a, e and work. */
size_t rot_shaft_coupled_room(size_t n);
rot_shaft_stepper rot_shaft_stepper_in(size_t n, double memory[]);

/* Sets up exp(A h). */
rot_status rot_shaft_set_step(const rot_shaft_modes *s, rot_shaft_stepper *y, double h);

/* Back to p (or q) and r of the modes. */
void rot_shaft_coupled_read(const rot_shaft_modes *s, const rot_shaft_stepper *y,
                            const double state[], double p[], double r[]);

/* The state at t after the start by one exponential; p and r too. */
rot_status rot_shaft_jump(const rot_shaft_modes *s, rot_shaft_stepper *y, rot_dd t, double state[],
                          double p[], double r[]);

/* Errors of the modes at t, `extra` times as many again for steps in between. */
void rot_shaft_coupled_errors(const rot_shaft_modes *s, double t, double extra, const double p[],
                              const double r[], double error[]);

#endif
