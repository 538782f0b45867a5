/* Lossy gears: the fraction `efficiency` of the power entering a mesh leaves it, in both
 * directions. A unit with such a gear has a contact to ground: at rest, the loss holds like dry
 * friction. All quantities are at the coordinate of the unit; direction: sign of its rate. */
#ifndef ROT_DRIVE_MESH_H
#define ROT_DRIVE_MESH_H

#include "scene/drive/system.h"

/* coupling => 1 if it is a lossy gear, else 0. */
int rot_drive_mesh_loses(const rot_drive_coupling *coupling);

/* unit => factor by which its meshes may amplify the rounding of torques. */
double rot_drive_mesh_gain(const rot_drive_system *s, const rot_drive_unit *unit);

/* Known torques => acceleration of the unit, torques of its gears. */
void rot_drive_mesh_turns(rot_drive_system *s, size_t unit, double direction);

/* (known torques, capacities) => capacity and load of the unit at rest; torques of its gears,
 * friction and brakes, each at the same fraction of its capacity. */
void rot_drive_mesh_rests(rot_drive_system *s, size_t unit, double *capacity, double *load);

#endif
