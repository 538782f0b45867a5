/* Modes of a shaft that damping does not couple. */
#ifndef ROT_SHAFT_DECOUPLED_H
#define ROT_SHAFT_DECOUPLED_H

#include "ground/dd.h"
#include "scene/shaft/modes.h"

/* p and r of all modes at t after the start, and their errors; n places each. */
void rot_shaft_decoupled_at(const rot_shaft_modes *s, rot_dd t, double p[], double r[],
                            double error[]);

/* Size of the error of (p, r) in units of roundoff: the leak, and the phase turned, while it
 * lasts. */
double rot_shaft_mode_error(const rot_shaft_modes *s, size_t m, double t);

/* Roundings of a mode's error, over what rot_shaft_mode_error() says. 200 random shafts of 2 to 6
 * rotors showed at most 0.6 of what is stated, mostly 0.01. */
double rot_shaft_roundings(const rot_shaft_modes *s);

#endif
