/* Collisions of one body that an impulse changes at once, in closed form. Energies are products of
 * one sign, never differences. */
#ifndef ROT_IMPACT_H
#define ROT_IMPACT_H

#include "ground/ieee.h"

/* A ball on a floor: x along it, y up; omega > 0 rolls towards +x. */
typedef struct rot_bounce_input {
  double mass_kg, radius_m, beta; /* > 0 */
  double vx, vy, omega;
  double restitution, friction; /* 0 to 1; >= 0, Inf: always sticks */
  double tangential;            /* 0 to 1: fraction of the slip that is returned where it sticks */
} rot_bounce_input;

typedef struct rot_bounce {
  double vx, vy, omega, normal_impulse, friction_impulse, normal_loss, friction_loss;
  int sticks; /* friction stops the slip, and gives the tangential share of it back */
} rot_bounce;

/* A ball that does not move down keeps its motion. */
rot_bounce rot_impact_bounce(const rot_bounce_input *in);

/* A body on a hinge, struck at a distance from it; all positive along the blow. */
typedef struct rot_hinged_input {
  double inertia;                                /* about the hinge, > 0 */
  double mass, centre, distance;                 /* of the body; centre of mass from the hinge */
  double omega;                                  /* before */
  double particle_mass, particle_v, restitution; /* > 0; Inf: a wall that keeps its velocity */
} rot_hinged_input;

typedef struct rot_hinged {
  double impulse, omega, particle_v, hinge_impulse, loss;
} rot_hinged;

/* A particle that does not approach leaves everything unchanged. */
rot_hinged rot_impact_hinged(const rot_hinged_input *in);
/* Two disks on fixed axles whose rims touch, or on one axle (radii 1 and -1). omega > 0 is the same
 * sense for both; rims that roll on each other from outside turn in opposite senses. A negative
 * radius 2: the rim of disk 2 is a ring around disk 1. */
typedef struct rot_rims_input {
  double inertia[2], radius[2], omega[2]; /* inertia > 0, radius not 0 */
  double restitution;                     /* 0 to 1, of the slip */
  double max;                             /* the largest impulse of friction; Inf: no limit */
} rot_rims_input;

typedef struct rot_rims {
  double omega[2], impulse; /* on the rim of disk 1 along its motion for omega > 0 */
  double loss;
  int locked; /* the slip ends, and `restitution` of it is given back */
} rot_rims;

rot_rims rot_impact_rims(const rot_rims_input *in);
/* The impulse of the hinge on the body, for an impulse 1 at the distance. */
double rot_impact_hinge_fraction(double inertia, double mass, double centre, double distance);

#endif
