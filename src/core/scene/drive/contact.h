/* Modes of the contacts of a drive: stick, or slip with a sign. */
#ifndef ROT_DRIVE_CONTACT_H
#define ROT_DRIVE_CONTACT_H

#include "scene/drive/forces.h"

/* (t, state, modes before) => modes after, at t. Contacts with slip speed 0 may stick. breaks: the
 * weakest contact breaks loose at any margin. ahead_s: time ahead at which a tie is decided. Rates
 * of sticking bodies are made equal in y (a change within rounding). */
rot_status rot_drive_settle(rot_drive_system *s, double t, double y[], signed char mode[],
                            int breaks, double ahead_s);

/* (positions before, rates in y after a step h) => positions in y. */
void rot_drive_positions(const rot_drive_system *s, double h, const double before[], double y[]);

/* (state, modes) => rates of the state. Call rot_drive_forces() before. */
void rot_drive_rates(const rot_drive_system *s, const double y[], const signed char mode[],
                     double dydt[]);

#endif
