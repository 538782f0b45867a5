/* Impulse at a contact point with friction, by Routh's incremental integration over the normal
 * impulse, with friction opposite to the slip (Keller 1986).
 *
 * In the axes (t1, t2, n) of the contact, with the velocity u of the contact point of body 1
 * relative to body 2 and the impulse p on body 1:  du = K dp,  dp = (-mu t, 1) dp_n for the slip
 * direction t, or in stick (-Ktt^-1 ktn, 1) dp_n if this is within the friction cone.
 *
 *   compression ends where u_n = 0; the collision ends where
 *   energetic  the work of restitution is e^2 of the work of compression (Stronge 1990)
 *   kinetic    p_n is 1 + e times that of compression (Poisson)
 *   kinematic  u_n is -e times that at the start (Newton)
 *
 * Only the energetic coefficient cannot create energy: the normal work is -(1 - e^2) W, and the
 * work of friction is always negative. */
#ifndef ROT_COLLIDE_FLOW_H
#define ROT_COLLIDE_FLOW_H

#include "ground/ieee.h"

#define ROT_RESTITUTION_LIST(X)                                                                    \
  X(ROT_ENERGETIC, "energetic")                                                                    \
  X(ROT_KINETIC, "kinetic")                                                                        \
  X(ROT_KINEMATIC, "kinematic")

typedef enum rot_restitution {
#define X(code, name) code,
  ROT_RESTITUTION_LIST(X)
#undef X
      ROT_RESTITUTIONS
} rot_restitution;

/* Scaled so that the largest elements of K and u are about 1. */
typedef struct rot_contact {
  double k[3][3];     /* K */
  double root[3][3];  /* upper triangular, K = root' root; root[2][2] cannot be computed from K */
  double friction;    /* >= 0; Inf: the slip stops immediately */
  double restitution; /* 0 to 1 */
  rot_restitution law;
} rot_contact;

typedef struct rot_contact_end {
  double p[3];             /* impulse on body 1 */
  double compression_work; /* >= 0 */
  double restitution_work; /* >= 0 */
  double slip_heat;        /* >= 0 */
  int sticks;              /* 1: no slip at the end */
} rot_contact_end;

/* (contact, u with u[2] < 0) => end. Returns 0 if the numbers exceed double precision. */
int rot_contact_flow(const rot_contact *contact, const double u[3], rot_contact_end *end);

#endif
