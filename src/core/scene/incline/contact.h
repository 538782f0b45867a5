/* Contact of a round body with an incline: static and kinetic friction, rolling resistance, forces
 * and accelerations, onset of motion from rest. Forces are per kg. */
#ifndef ROT_INCLINE_CONTACT_H
#define ROT_INCLINE_CONTACT_H

#include <math.h>

#include "ground/ieee.h"

typedef struct rot_incline_contact {
  double beta;      /* I/(m R^2), > 0 */
  double own;       /* beta/(1 + beta) */
  double spin;      /* 1/(1 + beta) */
  double pull;      /* g sin(angle), m/s^2 */
  double slides;    /* mu_kinetic g cos(angle), >= 0 */
  double breakaway; /* mu_static g cos(angle), >= 0; Inf: no slip */
  double resists;   /* arm/R g cos(angle), >= 0 */
  double holds;     /* factor >= 1 on breakaway and resists: tolerance for rounding */
} rot_incline_contact;

/* (coefficient, normal force) => largest friction. Inf also without a normal force: at 90 degrees
 * such a contact does not slip. */
static inline double rot_incline_friction(double coefficient, double normal) {
  return isinf(coefficient) ? coefficient : coefficient * normal;
}

/* Mode of the motion. */
typedef struct rot_incline_directions {
  int slip; /* sign of v - R omega; 0: the contact sticks */
  int spin; /* sign of omega; 0 with a resistance: omega is held at 0 */
} rot_incline_directions;

/* 1 if the rolling resistance holds omega at 0, else 0. */
static inline int rot_incline_held(const rot_incline_contact *c, rot_incline_directions at) {
  return c->resists > 0.0 && at.spin == 0;
}

/* (pull, resistance) => friction that keeps the contact sticking. */
static inline double rot_incline_needed(const rot_incline_contact *c, double pull, double torque) {
  return c->own * pull + c->spin * torque;
}

/* pull on the centre of mass => mode after rest; {0, 0}: it stays at rest. */
static inline rot_incline_directions rot_incline_leave_rest(const rot_incline_contact *c,
                                                            double pull) {
  const int direction = (pull > 0.0) - (pull < 0.0);
  const double size = fabs(pull), breakaway = c->breakaway * c->holds;
  rot_incline_directions to = {0, 0};
  if (size <= breakaway && size <= c->resists * c->holds) return to;
  if (size > c->resists * c->holds && rot_incline_needed(c, size, c->resists) <= breakaway) {
    to.spin = direction;
    return to;
  }
  to.slip = direction;
  if (c->slides > c->resists) to.spin = direction;
  return to;
}

/* (mode, pull, v) => next mode of a body that is not at rest. `turns`: the mode has the sign of
 * omega; `lost`: the friction needed has reached breakaway. */
static inline rot_incline_directions rot_incline_go_on(const rot_incline_contact *c,
                                                       rot_incline_directions at, double pull,
                                                       double v, int turns, int lost) {
  if (at.slip == 0) {
    if (turns && at.spin == 0) at.spin = (v > 0.0) - (v < 0.0);
    const double need = rot_incline_needed(c, pull, at.spin * c->resists);
    if (lost || fabs(need) > c->breakaway * c->holds) at.slip = (need > 0.0) - (need < 0.0);
  } else if (turns && at.spin == 0 && c->slides > c->resists) {
    at.spin = at.slip;
  }
  return at;
}

/* Forces of the contact, and accelerations. */
typedef struct rot_incline_forces {
  double friction; /* positive up the slope */
  double torque;   /* of the rolling resistance, over R */
  double v;        /* acceleration of the centre */
  double w;        /* rate of R omega */
} rot_incline_forces;

/* (pull, mode) => forces, accelerations. */
static inline rot_incline_forces rot_incline_forces_of(const rot_incline_contact *c, double pull,
                                                       rot_incline_directions at) {
  rot_incline_forces f = {0.0, at.spin * c->resists, 0.0, 0.0};
  const int held = rot_incline_held(c, at);
  if (at.slip == 0 && held) { /* at rest */
    f.friction = f.torque = pull;
  } else if (at.slip == 0) {
    f.friction = rot_incline_needed(c, pull, f.torque);
    f.v = f.w = c->spin * (pull - f.torque);
  } else {
    f.friction = at.slip * c->slides;
    f.v = pull - f.friction;
    if (held) f.torque = f.friction;
    if (!held) f.w = (f.friction - f.torque) / c->beta;
  }
  return f;
}

#endif
