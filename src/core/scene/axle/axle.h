/* A body on a fixed axle: I d(omega)/dt = torque(t) - c omega, d(theta)/dt = omega. Parameters,
 * columns, and one step of the closed form. */
#ifndef ROT_AXLE_H
#define ROT_AXLE_H

#include <math.h>
#include <stddef.h>

#include "ground/status.h"
#include "engine/torque.h"

typedef struct rot_axle_params {
  double inertia_kg_m2; /* > 0, about the axle */
  double viscous_n_m_s; /* any sign; < 0 drives */
  double start_s;       /* time of the state below */
  double theta0_rad, omega0_rad_per_s;
  rot_torque torque;
} rot_axle_params;

/* Columns of the result, one value per time: type, name (in R and of the member). */
#define ROT_AXLE_COLUMNS(X)                                                                        \
  X(double, theta_rad)                                                                             \
  X(double, omega_rad_per_s)                                                                       \
  X(double, applied_torque_n_m)                                                                    \
  X(double, damping_torque_n_m)                                                                    \
  X(double, net_torque_n_m)                                                                        \
  X(double, angular_momentum_kg_m2_per_s)                                                          \
  X(double, rotational_kinetic_energy_j)

typedef struct rot_axle_columns {
#define X(type, name) type *name;
  ROT_AXLE_COLUMNS(X)
#undef X
} rot_axle_columns;

/* columns => the same from row i on. */
static inline rot_axle_columns rot_axle_columns_from(const rot_axle_columns *columns, size_t i) {
  rot_axle_columns out;
#define X(type, name) out.name = columns->name + i;
  ROT_AXLE_COLUMNS(X)
#undef X
  return out;
}

/* State between steps of the closed form, for callers that loop over the pieces. */
typedef struct rot_axle_state {
  double time_s;
  double theta_rad, theta_lo, omega_rad_per_s, omega_lo; /* in twice the precision */
  double theta_error, omega_error;                       /* bounds */
} rot_axle_state;

/* parameters => error bound of a step, relative to the sum of the |terms| added. */
double rot_axle_rounding(const rot_axle_params *p);
/* parameters => state at the start. */
rot_axle_state rot_axle_start(const rot_axle_params *p);
/* (state, torque piece of the state, time in the piece or its end) => state at the time. */
rot_axle_state rot_axle_step(const rot_axle_params *p, const rot_axle_state *from,
                             const rot_torque_piece *piece, double time_s);

/* 1 if angle and rate are finite, else 0. */
static inline int rot_axle_in_range(const rot_axle_state *state) {
  return isfinite(state->theta_rad) && isfinite(state->omega_rad_per_s);
}

/* (theta, omega, applied torque) => all columns of row i. */
static inline void rot_axle_row(const rot_axle_params *p, const rot_axle_columns *out, size_t i,
                                double theta, double omega, double applied) {
  double damping = 0.0 - p->viscous_n_m_s * omega, momentum = p->inertia_kg_m2 * omega;
  out->theta_rad[i] = theta;
  out->omega_rad_per_s[i] = omega;
  out->applied_torque_n_m[i] = applied;
  out->damping_torque_n_m[i] = damping;
  out->net_torque_n_m[i] = applied + damping;
  out->angular_momentum_kg_m2_per_s[i] = momentum;
  out->rotational_kinetic_energy_j[i] = 0.5 * momentum * omega;
}

#endif
