/* A rigid gear train as one body on the axle of its first shaft.
 *
 * All quantities at the first shaft, forward: with the ratios N_i = omega_1/omega_i, inertia
 * J_i/N_i^2, viscous coefficient d_i/N_i^2, torque f_i/N_i. X_i = J_i a - f_i + d_i w + u_i is the
 * torque that shaft i takes from the mesh before it, u_i = X_(i+1)/eta if positive (power forward),
 * else eta X_(i+1). X_1 = 0 is the equation of motion. u is convex in X: X_1 is convex in a and w,
 * and a is the smallest of the accelerations of the 2^(n-1) sets of power flows: concave in w,
 * piecewise linear. Backward: a(w; f) = -a(-w; -f). */
#ifndef ROT_AXLE_TRAIN_H
#define ROT_AXLE_TRAIN_H

#include "ground/store.h"
#include "scene/axle/flows.h"

/* n shafts, converted to the first; n - 1 meshes. */
typedef struct rot_axle_train {
  size_t n;
  const double *ratio;                                      /* n: omega_1/omega_i */
  const double *inertia_kg_m2, *viscous_n_m_s, *torque_n_m; /* n each */
  const double *efficiency;                                 /* n - 1, in (0, 1] */
} rot_axle_train;

/* As an axle: inertia omega' = torque + curve(omega) - viscous omega, with dry friction. */
typedef struct rot_axle_train_law {
  double inertia_kg_m2, torque_n_m, viscous_n_m_s;
  double dry_n_m;                            /* >= 0, dry friction */
  size_t n_curve;                            /* points of the curve; 0: none */
  const double *omega_rad_per_s, *curve_n_m; /* n_curve each */
  double rounding[2]; /* of these sums: as a torque, as a viscous coefficient */
  int lossy;          /* 1: `gears` is set */
  rot_axle_gears gears;
} rot_axle_train_law;

/* numbers of each shaft, n - 1 ratios omega_i/omega_(i+1) => train converted to the first shaft, in
 * the store. */
rot_status rot_axle_train_reflect(size_t n, const double ratio[], const double inertia_kg_m2[],
                                  const double viscous_n_m_s[], const double torque_n_m[],
                                  const double efficiency[], rot_store *store, rot_axle_train *to);

/* train => law. ROT_ESTEP: too many rates at which power flows change. */
rot_status rot_axle_train_law_of(const rot_axle_train *train, rot_store *store,
                                 rot_axle_train_law *law);

/* rounding of a law => bounds of the changes of angle and rate between two times, up to the rate
 * `fastest`. min_n_m_s: smallest slope of the resistance. */
void rot_axle_train_error(const rot_axle_scene *scene, const double rounding[2], double min_n_m_s,
                          double first_s, double last_s, double fastest, double error[2]);

/* train => torque of each shaft at the first in steady forward rotation, losses included. */
void rot_axle_train_steady(const rot_axle_train *train, double torque_n_m[]);

#endif
