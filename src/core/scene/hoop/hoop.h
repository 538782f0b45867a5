/* A bead on a circular hoop that turns at a constant rate about its vertical diameter. theta is the
 * angle of the bead from the lowest point, v = R theta' its velocity along the hoop:
 *
 *   theta'' = (W^2 cos theta - g/R) sin theta - c theta'/m - mu N/(m R) sign theta',
 *
 * with the normal force N of the wire, in the plane of the hoop m (g cos theta + R theta'^2 +
 * R W^2 sin^2 theta), across it 2 m W R cos theta theta'. */
#ifndef ROT_HOOP_H
#define ROT_HOOP_H

#include "engine/model.h"

extern const rot_constraint rot_hoop_constraint;

#endif
