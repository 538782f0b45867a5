/* Instantaneous collisions in closed form: ball on a floor, hinged body, rims of disks. Energies
 * are products of one sign, never differences. */
#ifndef ROT_IMPACT_H
#define ROT_IMPACT_H

#include "ground/ieee.h"

/* A ball on a floor: x along it, y up; omega > 0 rolls towards +x. */
typedef struct rot_bounce_input {
  double mass_kg;       /* > 0 */
  double radius_m;      /* > 0 */
  double beta;          /* I/(m r^2), > 0 */
  double vx, vy, omega; /* m/s, rad/s */
  double restitution;   /* 0 to 1 */
  double friction;      /* >= 0; Inf: always sticks */
  double tangential;    /* tangential restitution in stick, 0 to 1 */
} rot_bounce_input;

typedef struct rot_bounce {
  double vx, vy, omega; /* after */
  double normal_impulse, friction_impulse;
  double normal_loss, friction_loss; /* J, >= 0 */
  int sticks; /* 1: friction stops the slip and reverses the tangential fraction of it */
} rot_bounce;

/* state before => after; unchanged for vy >= 0 */
rot_bounce rot_impact_bounce(const rot_bounce_input *in);

/* A hinged body hit by a particle; all positive along the particle's motion. */
typedef struct rot_hinged_input {
  double inertia;       /* about the hinge, kg m^2, > 0 */
  double mass;          /* of the body */
  double centre;        /* of mass, from the hinge, m */
  double distance;      /* of the point of impact from the hinge, m */
  double omega;         /* before */
  double particle_mass; /* > 0; Inf: a solid wall of constant velocity */
  double particle_v;    /* before */
  double restitution;   /* 0 to 1 */
} rot_hinged_input;

typedef struct rot_hinged {
  double impulse;           /* on the body */
  double omega, particle_v; /* after */
  double hinge_impulse;     /* of the hinge on the body */
  double loss;              /* J, >= 0 */
} rot_hinged;

/* state before => after; unchanged if the particle does not approach */
rot_hinged rot_impact_hinged(const rot_hinged_input *in);

/* Two disks on fixed axles whose rims touch, or on one axle (radii 1 and -1). omega > 0 is the same
 * sense for both; rims that roll on each other from outside rotate in opposite senses. radius[1] <
 * 0: the rim of disk 2 is a ring around disk 1. */
typedef struct rot_rims_input {
  double inertia[2];  /* > 0 */
  double radius[2];   /* not 0 */
  double omega[2];    /* before */
  double restitution; /* of the slip, 0 to 1 */
  double max;         /* max impulse of friction; Inf: no limit */
} rot_rims_input;

typedef struct rot_rims {
  double omega[2]; /* after */
  double impulse;  /* on the rim of disk 1, along its motion for omega > 0 */
  double loss;     /* J, >= 0 */
  int locked;      /* 1: the slip ends and `restitution` of it is reversed */
} rot_rims;

/* state before => after */
rot_rims rot_impact_rims(const rot_rims_input *in);

/* => impulse of the hinge on the body for an impulse of 1 at the distance */
double rot_impact_hinge_fraction(double inertia, double mass, double centre, double distance);

#endif
