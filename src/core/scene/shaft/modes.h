/* The modes of a shaft of rotors: frequencies, shapes, damping and initial values. */
#ifndef ROT_SHAFT_MODES_H
#define ROT_SHAFT_MODES_H

#include "scene/shaft/shaft.h"

/* Modes: 0 is the mean motion; 1 .. floppy are the other rigid-body modes (groups of rotors
 * separated by missing springs); the rest are twists, ascending by frequency. Coordinates: q; p =
 * sigma q (q if sigma = 0); r = q'. */
typedef struct rot_shaft_modes {
  const rot_shaft_params *p;
  const rot_hooks *hooks;            /* or NULL; polled in long computations with many rotors */
  size_t n;                          /* number of rotors and modes */
  size_t floppy;                     /* number of missing springs */
  double inertia, root_inertia;      /* total; its square root */
  double theta0, omega0;             /* means at the start, weighted by inertia */
  double theta_spread, omega_spread; /* largest difference from the first rotor, at the start */
  double alpha, decay;               /* mean: omega' = alpha - decay omega, if decoupled */
  int mean_alone;                    /* 1: external damping does not couple mean and twists */
  int decoupled;                     /* 1: no modes are coupled */
  double norm;                       /* of the twists' matrix, 1/s */
  double *memory;                    /* of the arrays below */
  double *leak, *force_leak; /* n: magnitudes that determine the rounding of (p0, r0), of force */
  double *sigma_lo;          /* n: low part of sigma in twice the precision */
  double *sigma_off;         /* n: relative error of sigma + sigma_lo, about 1e-30 */
  double *fraction;          /* n: J_i / sum J */
  double *sigma, *damp;      /* n: frequency; diagonal damping */
  double *p0, *r0, *force;   /* n: state at the start, modal torque; r0[0] = omega0 */
  double *shape;             /* n x n: theta_i per q_m; column 0 is 1 */
  double *twist;             /* (n - 1) x n: shape_i - shape_(i+1) */
  double *lever;             /* (n - 1) x n: elastic torque per p_m */
  double *coupling;          /* n x n: damping of the modes, masses 1 */
  double *coupling_lo;       /* n x n: its low part */
} rot_shaft_modes;

/* shaft => modes. Call rot_shaft_modes_free() afterwards, also after a failure. */
rot_status rot_shaft_modes_build(rot_shaft_modes *s, const rot_shaft_params *p,
                                 const rot_hooks *hooks);
/* modes => modes with levers, start and torques moved by the fraction of what rounding moves them
 * by, in directions that `which` chooses; their shapes and damping follow. Likewise to be freed. */
rot_status rot_shaft_modes_shift(const rot_shaft_modes *s, double fraction, int which,
                                 rot_shaft_modes *to);
/* Frees the memory of the modes. */
void rot_shaft_modes_free(rot_shaft_modes *s);

#endif
