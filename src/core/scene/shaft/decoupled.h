/* Modes of a shaft not coupled by damping. */
#ifndef ROT_SHAFT_DECOUPLED_H
#define ROT_SHAFT_DECOUPLED_H

#include "ground/dd.h"
#include "scene/shaft/modes.h"

/* t since the start => p and r of all modes, their errors; n places each. */
void rot_shaft_decoupled_at(const rot_shaft_modes *s, rot_dd t, double p[], double r[],
                            double error[]);

/* (mode m, t) => error of (p, r) in units of roundoff: rounding of the start and of the torque,
 * phase turned while the mode lasts. */
double rot_shaft_mode_error(const rot_shaft_modes *s, size_t m, double t);

/* Factor on rot_shaft_mode_error(). The errors of 200 random shafts of 2 to 6 rotors were at most
 * 0.6 of the bound, mostly 0.01. */
double rot_shaft_roundings(const rot_shaft_modes *s);

#endif
