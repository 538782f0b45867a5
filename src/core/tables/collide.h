/* Collision at a point of two free rigid bodies, or of one and a fixed obstacle. */
#ifndef ROT_COLLIDE_H
#define ROT_COLLIDE_H

#include "tables/collide_flow.h"

typedef struct rot_collide_body {
  double mass;       /* kg, > 0; Inf: fixed, the other members are not read */
  double moment[3];  /* principal, kg m^2, >= 0 */
  double axes[3][3]; /* axes[j]: unit vector along principal axis j, in space */
  double arm[3];     /* from the centre of mass to the point of contact, m */
  double v[3];       /* of the centre of mass, m/s */
  double omega[3];   /* rad/s, in space */
} rot_collide_body;

typedef struct rot_collide_input {
  rot_collide_body body[2];
  double normal[3];   /* out of body 2, into body 1; any length > 0 */
  double restitution; /* 0 to 1 */
  double friction;    /* 0 to Inf */
  rot_restitution law;
} rot_collide_input;

typedef struct rot_collide_end {
  double v[2][3], omega[2][3]; /* after the collision */
  double impulse[3];           /* on body 1, at the point of contact, N s */
  double normal_impulse;       /* >= 0 */
  double friction_impulse;     /* size of its resultant, >= 0 */
  double normal_loss;          /* J; < 0 where the coefficient creates energy */
  double friction_loss;        /* J, >= 0 */
  int sticks;                  /* 1: no slip at the end */
} rot_collide_end;

typedef enum rot_collide_status {
  ROT_COLLIDE_OK,
  ROT_COLLIDE_NO_MOMENT, /* an impulse at the point has a moment about an axis without inertia */
  ROT_COLLIDE_BEYOND     /* beyond double precision */
} rot_collide_status;

/* bodies before => after the collision; unchanged if they do not approach at the point */
rot_collide_status rot_collide(const rot_collide_input *in, rot_collide_end *end);

#endif
