/* The shaft of rotors as one rigid body, and a bound on what that omits. */
#ifndef ROT_SHAFT_RIGID_H
#define ROT_SHAFT_RIGID_H

#include "scene/shaft/shaft.h"

/* The rotors turn as one while the springs carry the torques T_j = base_j + slope_j omega that this
 * asks for. Then (twist under T_j, no twist rate) solves the equations of the shaft but for the
 * rate of change of T_j, and since exp(A t) does not grow, the true state differs in the energy
 * norm by at most the difference at the start plus the path of the twists. */
typedef struct rot_shaft_lump {
  const rot_shaft_params *p;
  size_t n;
  double inertia, theta0, omega0, alpha, decay;
  double start;   /* energy norm of the difference at the start */
  double path;    /* energy norm of slope_j: what a change of omega by 1 adds */
  int mean_exact; /* the mean motion is that of the rigid rot_shaft_modes */
  int damped, broken;
  double *memory, *fraction, *base, *slope;
} rot_shaft_lump;

/* rot_shaft_lump_free() afterwards, also where this failed. */
rot_status rot_shaft_lump_build(rot_shaft_lump *s, const rot_shaft_params *p);
void rot_shaft_lump_free(rot_shaft_lump *s);

/* Mean angle turned and rate; sizes of the terms added. */
void rot_shaft_lump_at(const rot_shaft_lump *s, double t, double *turned, double *omega,
                       double *turned_size, double *omega_size);

/* The shaft as one rigid body. The errors in *info are bounds on what the twists would have added,
 * Inf where none is known (a missing spring; damped motion followed backwards). */
rot_status rot_shaft_rigid(const rot_shaft_params *p, size_t n, const double time_s[],
                           const rot_shaft_columns *out, const rot_hooks *hooks, rot_info *info);

#endif
