/* Units: rotors joined by gears. In the coordinate x = P_i theta_i, P_i the product of all ratios
 * before rotor i, every ratio is 1: moments of inertia and coefficients are divided by P_i^2,
 * torques by P_i. */
#ifndef ROT_DRIVE_UNITS_H
#define ROT_DRIVE_UNITS_H

#include "engine/loads.h"
#include "scene/drive/drive.h"

typedef struct rot_drive_units {
  size_t n, m;     /* numbers of rotors, of units */
  size_t *unit;    /* n: unit of each rotor */
  size_t *between; /* m - 1: coupling behind each unit except the last */
  double *ratio;   /* n: P_i */
  /* m each, at the first shaft. */
  double *inertia_kg_m2, *viscous_n_m_s, *omega0_rad_per_s;
} rot_drive_units;

/* scene => units. */
rot_status rot_drive_units_of(const rot_drive_scene *scene, rot_store *store,
                              rot_drive_units *units);

/* (scene, unit k) => sum of the torques of its rotors at the first shaft: functions of time only,
 * and motors. */
rot_status rot_drive_unit_loads(const rot_drive_scene *scene, const rot_drive_units *units,
                                size_t k, rot_store *store, rot_loads *loads);

/* rotor => 1 if its torques are functions of time or motors. */
int rot_drive_of_time(const rot_axle_scene *rotor);
/* rotor => 1 if its torques are piecewise constant in time. */
int rot_drive_stepped(const rot_axle_scene *rotor);
/* rotor => 1 if its torques are constant. */
int rot_drive_constant(const rot_axle_scene *rotor);

#endif
