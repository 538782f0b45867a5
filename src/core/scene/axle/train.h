/* A rigid gear train as one body on the axle of its first shaft.
 *
 * All at the first shaft, turning forward: with the ratios N_i = omega_1/omega_i, inertia
 * J_i/N_i^2, viscous coefficient d_i/N_i^2, torque f_i/N_i. X_i = J_i a - f_i + d_i w + u_i is what
 * shaft i takes from the mesh before it, u_i = X_(i+1)/eta where that is positive (power forward),
 * else eta X_(i+1); X_1 = 0 is the equation of motion. u is convex in X, so that X_1 is convex in a
 * and w, and a is the smallest of the accelerations that the 2^(n-1) sets of power flows give:
 * concave in w, and piecewise linear. Backward: a(w; f) = -a(-w; -f). */
#ifndef ROT_AXLE_TRAIN_H
#define ROT_AXLE_TRAIN_H

#include "ground/store.h"
#include "scene/axle/flows.h"

/* n shafts at the first; n - 1 meshes. */
typedef struct rot_axle_train {
  size_t n;
  const double *ratio; /* omega_1/omega_i */
  const double *inertia_kg_m2, *viscous_n_m_s, *torque_n_m;
  const double *efficiency; /* in (0, 1] */
} rot_axle_train;

/* As an axle: torque + curve(omega) - viscous omega, and dry friction; the acceleration times the
 * inertia. */
typedef struct rot_axle_train_law {
  double inertia_kg_m2, torque_n_m, viscous_n_m_s, dry_n_m;
  size_t n_curve; /* points of the torque over omega; 0: none */
  const double *omega_rad_per_s, *curve_n_m;
  double rounding[2]; /* of these sums, as a torque and as a viscous coefficient */
  int lossy;          /* gears are set */
  rot_axle_gears gears;
} rot_axle_train_law;

/* Each shaft at the first, in the store, from its own numbers and the n - 1 ratios
 * omega_i/omega_(i+1). */
rot_status rot_axle_train_reflect(size_t n, const double ratio[], const double inertia_kg_m2[],
                                  const double viscous_n_m_s[], const double torque_n_m[],
                                  const double efficiency[], rot_store *store, rot_axle_train *to);

/* ROT_ESTEP: the rates at which its power flows change are too many. */
rot_status rot_axle_train_law_of(const rot_axle_train *train, rot_store *store,
                                 rot_axle_train_law *law);

/* What such a rounding changes at most, in angle and rate, between two times and up to the fastest
 * rate; `least`: the least resistance. */
void rot_axle_train_error(const rot_axle_scene *scene, const double rounding[2], double min_n_m_s,
                          double first_s, double last_s, double fastest, double error[2]);

/* The torque of each shaft as the first feels it in steady forward rotation. */
void rot_axle_train_steady(const rot_axle_train *train, double torque_n_m[]);

#endif
