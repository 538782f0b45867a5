/* Masses on a rope over the body of an axle, and the separation of its motion into that of the body
 * and of the masses. Forward rotation lowers the first mass. */
#ifndef ROT_AXLE_ROPE_H
#define ROT_AXLE_ROPE_H

#include "scene/axle/scene.h"

typedef struct rot_axle_rope {
  double mass_kg[2];    /* first > 0 (0: no rope), second >= 0 */
  double radius_m;      /* > 0 */
  double inertia_kg_m2; /* of the body without masses */
  double gravity_m_per_s2;
} rot_axle_rope;

/* Columns of a mass; index: "" (one mass), "_1", "_2". */
#define ROT_AXLE_MASS_COLUMNS(X, index)                                                            \
  X("tension" index "_n", "N")                                                                     \
  X("height" index "_m", "m")                                                                      \
  X("mass" index "_kinetic_energy_j", "J")                                                         \
  X("mass" index "_potential_energy_j", "J")
enum { ROT_AXLE_OF_MASS = 4 };

/* Rows of body and masses together => rows of the body, alpha, columns of each mass (one mass: of
 * the first). */
void rot_axle_rope_rows(const rot_axle_rope *rope, double whole_kg_m2, size_t n,
                        const rot_axle_columns *rows, double alpha[],
                        double *const mass[2][ROT_AXLE_OF_MASS]);

/* (two angles, their errors) => change of the potential energy of the masses; *explained: its
 * error. */
double rot_axle_rope_potential(const rot_axle_rope *rope, const double theta[2],
                               const double error[2], double *explained);

/* => moment of the weights about the axle. */
double rot_axle_rope_moment(const rot_axle_rope *rope);

#endif
