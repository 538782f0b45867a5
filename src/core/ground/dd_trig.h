/* Sines and cosines of double-double numbers. */
#ifndef ROT_DD_TRIG_H
#define ROT_DD_TRIG_H

#include "ground/dd.h"

/* x => n, r with x = n pi/2 + r and |r| <= pi/4 (slightly more where n is rounded). pi/2 has 212
 * bits; the returned n is exact below 2^52. */
double rot_dd_quarter_turns(rot_dd x, rot_dd *r);

/* r => sin r by its series, |r| < 0.8 */
rot_dd rot_dd_sine(rot_dd r);

/* x => sin x, cos x, for |x| below 2^52 quarter turns */
void rot_dd_sine_cosine(rot_dd x, rot_dd *sine, rot_dd *cosine);

/* x => x minus the nearest multiple of 4 pi, the period of a quaternion */
rot_dd rot_dd_less_double_turns(rot_dd x);

#endif
