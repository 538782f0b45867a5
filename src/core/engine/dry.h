/* Dry friction of a body on its path, by differences from the start: where friction nearly balances
 * the force along the path, what is left of both keeps its digits. Forces in units of one's own. */
#ifndef ROT_DRY_H
#define ROT_DRY_H

#include "ground/dd.h"

typedef struct rot_dry {
  double mu_static, mu_kinetic;
  double presses;              /* the normal force at the start, at rest */
  double loose;                /* the first double beyond mu_static */
  double slides[2], breaks[2]; /* the force along less kinetic and static friction, down, up */
} rot_dry;

/* Of the start, at rest: the force along the path, the normal force in its plane. */
rot_dry rot_dry_from(rot_dd along, rot_dd presses, double mu_static, double mu_kinetic);

/* along: the path; normal: to it; more: of both, less those at the start */
typedef struct rot_dry_forces {
  double along, normal, more_along, more_normal;
} rot_dry_forces;

/* (force along and its change; normal forces in the plane and across it, the former's change) */
rot_dry_forces rot_dry_now(const rot_dry *d, double along, double more_along, double in_plane,
                           double more, double across);

/* => the force along less kinetic friction against a motion of that sign; 0: none */
double rot_dry_left(const rot_dry *d, const rot_dry_forces *f, int sign);

/* => the force along over the normal force, on its own side of mu_static. */
double rot_dry_drive(const rot_dry *d, const rot_dry_forces *f);

#endif
