/* Sines and cosines of double-double numbers. */
#ifndef ROT_DD_TRIG_H
#define ROT_DD_TRIG_H

#include "ground/dd.h"

/* x = n pi/2 + r, |r| <= pi/4 (a little more where n is rounded), with pi/2 to 212 bits; returns n,
 * which is exact below 2^52. */
double rot_dd_quarter_turns(rot_dd x, rot_dd *r);

/* The sine of |r| < 0.8, by its series. */
rot_dd rot_dd_sine(rot_dd r);

/* Sine and cosine of any x below 2^52 quarter turns. */
void rot_dd_sine_cosine(rot_dd x, rot_dd *sine, rot_dd *cosine);

/* x less the nearest multiple of 4 pi: what is left of the angle of a quaternion. */
rot_dd rot_dd_less_double_turns(rot_dd x);

#endif
