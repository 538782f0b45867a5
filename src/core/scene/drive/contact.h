/* Which contacts of a drive stick at an instant, and which way the others slip. */
#ifndef ROT_DRIVE_CONTACT_H
#define ROT_DRIVE_CONTACT_H

#include "scene/drive/forces.h"

/* Decides the modes at time t (the laws are evaluated there) from those before. Slip speeds that
 * are 0 may stick; `breaks`: the weakest contact breaks loose, whatever its margin says. `ahead_s`
 * is how far ahead a tie is looked at. Rates of bodies that stick are made equal in y, to
 * rounding. */
rot_status rot_drive_settle(rot_drive_system *s, double t, double y[], signed char mode[],
                            int breaks, double ahead_s);

/* The positions at the end of a step of length h, of which y has the rates. */
void rot_drive_positions(const rot_drive_system *s, double h, const double before[], double y[]);

/* Rates of the state in these modes, after rot_drive_forces(). */
void rot_drive_rates(const rot_drive_system *s, const double y[], const signed char mode[],
                     double dydt[]);

#endif
