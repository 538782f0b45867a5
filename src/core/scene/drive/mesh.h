/* Gears with a loss. Of the power that enters a mesh the part `efficiency` leaves it, from either
 * side. A unit with such a gear has a contact to ground: at rest a loss holds, as dry friction
 * does. All at the coordinate of the unit; `way` is the sign of its rate. */
#ifndef ROT_DRIVE_MESH_H
#define ROT_DRIVE_MESH_H

#include "scene/drive/system.h"

int rot_drive_mesh_loses(const rot_drive_coupling *coupling);

/* Sizes of the torques of a unit as its meshes may amplify them. */
double rot_drive_mesh_gain(const rot_drive_system *s, const rot_drive_unit *unit);

/* Known torques => acceleration of the unit, torques of its gears. */
void rot_drive_mesh_turns(rot_drive_system *s, size_t unit, double direction);

/* Known torques, capacities => what holds the unit at rest and what loads it; torques of its gears,
 * friction and brakes, at the same part of what each could hold. */
void rot_drive_mesh_rests(rot_drive_system *s, size_t unit, double *capacity, double *load);

#endif
