/* Two free rigid bodies, or one and a fixed obstacle, that collide at a point. */
#ifndef ROT_COLLIDE_H
#define ROT_COLLIDE_H

#include "tables/collide_flow.h"

typedef struct rot_collide_body {
  double mass;       /* > 0; Inf: fixed, nothing else is read */
  double moment[3];  /* principal, >= 0 */
  double axes[3][3]; /* axes[j]: unit vector along principal axis j, in space */
  double arm[3];     /* from the centre of mass to the point of contact */
  double v[3], omega[3];
} rot_collide_body;

typedef struct rot_collide_input {
  rot_collide_body body[2];
  double normal[3]; /* out of body 2, into body 1; any length but 0 */
  double restitution, friction;
  rot_restitution law;
} rot_collide_input;

typedef struct rot_collide_end {
  double v[2][3], omega[2][3]; /* after */
  double impulse[3];           /* on body 1, at the point of contact */
  double normal_impulse, friction_impulse;
  double normal_loss,
      friction_loss; /* the first is negative where the coefficient creates energy */
  int sticks;
} rot_collide_end;

typedef enum rot_collide_status {
  ROT_COLLIDE_OK,
  ROT_COLLIDE_NO_MOMENT, /* an impulse at the point has a moment about an axis without inertia */
  ROT_COLLIDE_BEYOND     /* beyond double precision */
} rot_collide_status;

/* Bodies that do not approach at the point keep their motion. */
rot_collide_status rot_collide(const rot_collide_input *in, rot_collide_end *end);

#endif
