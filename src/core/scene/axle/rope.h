/* Masses on a rope over the body of an axle, and its motion as that of the body and of the masses.
 * The first mass goes down where the body turns forward. */
#ifndef ROT_AXLE_ROPE_H
#define ROT_AXLE_ROPE_H

#include "scene/axle/scene.h"

typedef struct rot_axle_rope {
  double mass_kg[2];              /* the second may be 0 */
  double radius_m, inertia_kg_m2; /* of the body alone */
  double gravity_m_per_s2;
} rot_axle_rope;

/* What the masses add to the rows, by their names for one mass and for two. */
#define ROT_AXLE_MASS_COLUMNS(X, index)                                                            \
  X("tension" index "_n", "N")                                                                     \
  X("height" index "_m", "m")                                                                      \
  X("mass" index "_kinetic_energy_j", "J")                                                         \
  X("mass" index "_potential_energy_j", "J")
enum { ROT_AXLE_OF_MASS = 4 };

/* Rows of the weights on body and masses together => those of the body. `alpha` and the columns of
 * each mass are filled; of a single mass those of the first. */
void rot_axle_rope_rows(const rot_axle_rope *rope, double whole_kg_m2, size_t n,
                        const rot_axle_columns *rows, double alpha[],
                        double *const mass[2][ROT_AXLE_OF_MASS]);

/* The change of the potential energy of the masses, and what explains it where the angles are off
 * by `error`. */
double rot_axle_rope_potential(const rot_axle_rope *rope, const double theta[2],
                               const double error[2], double *explained);

/* Of both masses about the axle. */
double rot_axle_rope_moment(const rot_axle_rope *rope);

#endif
