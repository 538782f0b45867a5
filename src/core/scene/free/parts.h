/* Parts of free bodies: rotors, tables of torques, principal moments; as built. */
#ifndef ROT_FREE_PARTS_H
#define ROT_FREE_PARTS_H

#include "engine/part.h"
#include "scene/free/free.h"

/* A table of torques. */
typedef struct rot_free_table_of {
  size_t n;                /* number of times */
  size_t columns;          /* 1 or 3 */
  const double *time_s;    /* n, not decreasing */
  const double *torque[3]; /* n each, N m */
} rot_free_table_of;

typedef struct rot_free_rotor_of {
  rot_free_rotor rotor;
  rot_law law; /* of its motor; call NULL: none */
  size_t n_breaks;
  const double *breaks_s;
} rot_free_rotor_of;

typedef struct rot_free_moments_of {
  double moment_kg_m2[3], axes[4];
} rot_free_moments_of;

extern const rot_part rot_free_parts[];
extern const size_t rot_free_n_parts;

extern const char *const rot_free_arguments[]; /* names of the arguments of a law */

/* quaternion => unit quaternion; one of unit length keeps its bits. */
void rot_free_read_attitude(const double given[4], double q[4]);

#endif
