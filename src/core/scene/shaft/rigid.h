/* A shaft of rotors as one rigid body, with a bound on the error. */
#ifndef ROT_SHAFT_RIGID_H
#define ROT_SHAFT_RIGID_H

#include "scene/shaft/shaft.h"

/* As a rigid body, the shaft needs the spring torques T_j = base_j + slope_j omega. Twists under
 * T_j without twist rates solve the equations of the shaft except for the rate of change of T_j.
 * exp(A t) does not grow: in the energy norm the error is at most the difference at the start plus
 * the path length of these twists. */
typedef struct rot_shaft_lump {
  const rot_shaft_params *p;
  size_t n;
  double inertia;        /* total */
  double theta0, omega0; /* means at the start, weighted by inertia */
  double alpha, decay;   /* omega' = alpha - decay omega */
  double start;          /* energy norm of the difference at the start */
  double path;           /* energy norm of slope_j: path length per change of omega by 1 */
  int mean_exact;        /* 1: the mean motion of the shaft is that of the rigid body */
  int damped;            /* 1: some damping > 0 */
  int broken;            /* 1: a spring is missing */
  double *memory;        /* of the arrays below */
  double *fraction;      /* n: J_i / sum J */
  double *base, *slope;  /* n - 1: of the spring torques */
} rot_shaft_lump;

/* shaft => rigid body. Call rot_shaft_lump_free() afterwards, also after a failure. */
rot_status rot_shaft_lump_build(rot_shaft_lump *s, const rot_shaft_params *p);
/* Frees the memory of the rigid body. */
void rot_shaft_lump_free(rot_shaft_lump *s);

/* t since the start => mean angle turned, mean rate; sums of their |terms|. */
void rot_shaft_lump_at(const rot_shaft_lump *s, double t, double *turned, double *omega,
                       double *turned_size, double *omega_size);

/* (shaft, times) => rows of one rigid body. The errors in *info are bounds on the effect of the
 * twists; Inf: none is known (missing spring; damped motion backward in time). */
rot_status rot_shaft_rigid(const rot_shaft_params *p, size_t n, const double time_s[],
                           const rot_shaft_columns *out, const rot_hooks *hooks, rot_info *info);

#endif
