/* What moves first of a round body at rest on an incline. Forces are those on 1 kg. */
#ifndef ROT_INCLINE_REST_H
#define ROT_INCLINE_REST_H

#include <math.h>

#include "ground/ieee.h"

/* What a coefficient of friction holds. The limit Inf holds without a normal force, too: a wall at
 * 90 degrees that never lets the body slip. */
static inline double rot_incline_friction(double coefficient, double normal) {
  return isinf(coefficient) ? coefficient : coefficient * normal;
}

/* The sign of the slip, 0: the contact grips; the sign of omega, 0: the resistance holds it. */
typedef struct rot_incline_ways {
  int slip, spin;
} rot_incline_ways;

/* pull: of gravity and what else acts on the centre; grips, slides, resists: what static and
 * kinetic friction and the rolling resistance hold; a force is held up to `holds` times that. own,
 * spin: beta/(1 + beta), 1/(1 + beta). Both 0: it rests. */
static inline rot_incline_ways rot_incline_leave_rest(double pull, double grips, double slides,
                                                      double resists, double holds, double own,
                                                      double spin) {
  const int way = (pull > 0.0) - (pull < 0.0);
  const double size = fabs(pull);
  rot_incline_ways to = {0, 0};
  if (size <= grips * holds && size <= resists * holds) return to;
  if (size > resists * holds && own * size + spin * resists <= grips * holds) {
    to.spin = way;
    return to;
  }
  to.slip = way;
  if (slides > resists) to.spin = way;
  return to;
}

#endif
