/* The modes of a shaft of rotors: frequencies, shapes, damping and initial values. */
#ifndef ROT_SHAFT_MODES_H
#define ROT_SHAFT_MODES_H

#include "scene/shaft/shaft.h"

/* Modes: 0 is the mean motion, 1 .. floppy are the other rigid-body modes (groups of rotors
 * that missing springs leave), the rest are twists, slowest first. In each the motion is q, with
 * p = sigma q (q itself where sigma = 0) and r = q'. */
typedef struct rot_shaft_modes {
  const rot_shaft_params *p;
  const rot_hooks *hooks; /* or NULL; polled by all that takes long with many rotors */
  size_t n, floppy;
  double inertia, root_inertia;      /* all together, and its square root */
  double theta0, omega0;             /* means at the start, weighted by inertia */
  double theta_spread, omega_spread; /* largest distance of a rotor from the first, at the start */
  double alpha, decay;               /* mean: omega' = alpha - decay omega, if it is decoupled */
  int mean_alone;                    /* external damping does not couple the mean to the twists */
  int decoupled;                     /* all modes are */
  double norm;                       /* of the twists' matrix, 1/s */
  double *memory;
  double *leak, *force_leak; /* n: sizes whose roundings p0 and r0, and force, carry */
  double *sigma_lo;          /* n: what sigma lacks */
  double *sigma_off;         /* n: relative error of both together, some 1e-30 */
  double *fraction;          /* J_i / sum J */
  double *sigma, *damp;      /* n: frequency; diagonal damping */
  double *p0, *r0, *force;   /* n: state at the start, modal torque; r0[0] = omega0 */
  double *shape;             /* n x n: theta_i per q_m; column 0 is 1 */
  double *twist;             /* (n - 1) x n: shape_i - shape_(i+1) */
  double *lever;             /* (n - 1) x n: elastic torque per p_m */
  double *coupling;          /* n x n: damping of the modes, masses 1 */
} rot_shaft_modes;

/* rot_shaft_modes_free() afterwards, also where this failed. */
rot_status rot_shaft_modes_build(rot_shaft_modes *s, const rot_shaft_params *p,
                                 const rot_hooks *hooks);
void rot_shaft_modes_free(rot_shaft_modes *s);

#endif
