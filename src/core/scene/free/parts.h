/* The parts of bodies in space: rotors, tables of torques, principal moments; as they are built. */
#ifndef ROT_FREE_PARTS_H
#define ROT_FREE_PARTS_H

#include "engine/part.h"
#include "scene/free/free.h"

/* Torques at times that do not decrease, one or three at each. */
typedef struct rot_free_table_of {
  size_t n, columns;
  const double *time_s, *torque[3];
} rot_free_table_of;

typedef struct rot_free_rotor_of {
  rot_free_rotor rotor;
  rot_law law; /* of its motor; call NULL: it has none */
  size_t n_breaks;
  const double *breaks_s;
} rot_free_rotor_of;

typedef struct rot_free_moments_of {
  double moment_kg_m2[3], axes[4];
} rot_free_moments_of;

extern const rot_part rot_free_parts[];
extern const size_t rot_free_n_parts;

extern const char *const rot_free_arguments[]; /* of the law of a torque, and of a motor's */

/* The quaternion given, scaled to unit length; one that has it keeps its bits. */
void rot_free_read_attitude(const double given[4], double q[4]);

#endif
