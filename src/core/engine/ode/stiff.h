/* Whether stability limits the steps of an explicit method, by Hairer's test: the last two calls of
 * a step are at the same time, the last stage and the result; the difference of their slopes over
 * their own is what h times has a limit (Hairer, Norsett & Wanner, Solving ODEs II, IV.2). */
#ifndef ROT_ODE_STIFF_H
#define ROT_ODE_STIFF_H

#include "engine/ode/params.h"

typedef struct rot_ode_stiffness {
  const rot_ode_params *p;
  const double *largest; /* size of each measure so far */
  double t, *y, *f;      /* of the last call; t is NaN where no call of this step is known */
  double rate;           /* of the last step, in 1/s */
  int stiff, calm;       /* steps one after the other */
} rot_ode_stiffness;

void rot_ode_stiffness_begin(rot_ode_stiffness *s);
/* A call of rhs. */
void rot_ode_stiffness_note(rot_ode_stiffness *s, double t, const double y[], const double f[]);
/* After a step of length h with so much time left: another method is to take over. */
int rot_ode_is_stiff(rot_ode_stiffness *s, double h, double left);

#endif
