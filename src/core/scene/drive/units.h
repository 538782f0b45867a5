/* Rotors joined by gears are one unit. With P_i, the product of all ratios before rotor i, the
 * coordinate x = P_i theta_i makes every ratio 1: moments of inertia and coefficients count over
 * P_i^2, torques over P_i. */
#ifndef ROT_DRIVE_UNITS_H
#define ROT_DRIVE_UNITS_H

#include "engine/loads.h"
#include "scene/drive/drive.h"

typedef struct rot_drive_units {
  size_t n, m;     /* rotors, units */
  size_t *unit;    /* n: of each rotor */
  size_t *between; /* m - 1: the coupling behind each unit but the last */
  double *ratio;   /* n: P_i */
  double *inertia_kg_m2, *viscous_n_m_s, *omega0_rad_per_s; /* m, at the first shaft */
} rot_drive_units;

rot_status rot_drive_units_of(const rot_drive_scene *scene, rot_store *store,
                              rot_drive_units *units);

/* The torques of the rotors of unit k at the first shaft: of time alone, and motors. */
rot_status rot_drive_unit_loads(const rot_drive_scene *scene, const rot_drive_units *units,
                                size_t k, rot_store *store, rot_loads *loads);

/* What acts on a rotor is of time, but for motors; constant between jumps; constant. */
int rot_drive_of_time(const rot_axle_scene *rotor);
int rot_drive_stepped(const rot_axle_scene *rotor);
int rot_drive_constant(const rot_axle_scene *rotor);

#endif
