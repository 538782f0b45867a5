/* The contact of a round body with an incline: what holds it, its forces and the rates that they
 * make, what moves first from rest. Forces are those on 1 kg. */
#ifndef ROT_INCLINE_CONTACT_H
#define ROT_INCLINE_CONTACT_H

#include <math.h>

#include "ground/ieee.h"

typedef struct rot_incline_contact {
  double beta, own, spin;                  /* I/(m R^2); shares: beta/(1 + beta), 1/(1 + beta) */
  double pull, slides, breakaway, resists; /* g sin; mu_kinetic, mu_static, arm/R times g cos */
  double holds; /* a force this much larger than what friction holds is held */
} rot_incline_contact;

/* What a coefficient of friction holds. The limit Inf holds without a normal force, too: a wall at
 * 90 degrees that never lets the body slip. */
static inline double rot_incline_friction(double coefficient, double normal) {
  return isinf(coefficient) ? coefficient : coefficient * normal;
}

/* The sign of the slip, 0: the contact sticks; the sign of omega, 0: the resistance holds it, where
 * there is one. */
typedef struct rot_incline_directions {
  int slip, spin;
} rot_incline_directions;

static inline int rot_incline_held(const rot_incline_contact *c, rot_incline_directions at) {
  return c->resists > 0.0 && at.spin == 0;
}

/* The friction that keeps the contact from slipping under this pull and resistance. */
static inline double rot_incline_needed(const rot_incline_contact *c, double pull, double torque) {
  return c->own * pull + c->spin * torque;
}

/* From rest, under a pull of gravity and what else acts on the centre. Both 0: it rests. */
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

/* What moves on, for a body that does not rest. `turns`: the spin counts; `lost`: static friction
 * is. */
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

/* Of the contact; v and w: the rates of the centre's velocity and of R omega. */
typedef struct rot_incline_forces {
  double friction, torque, v, w;
} rot_incline_forces;

static inline rot_incline_forces rot_incline_forces_of(const rot_incline_contact *c, double pull,
                                                       rot_incline_directions at) {
  rot_incline_forces f = {0.0, at.spin * c->resists, 0.0, 0.0};
  const int held = rot_incline_held(c, at);
  if (at.slip == 0 && held) { /* it rests */
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
