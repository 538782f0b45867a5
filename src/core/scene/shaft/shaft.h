/* n rotors in a line on one shaft, with a spring and a damper between neighbours:
 *
 *   J_i theta_i'' = tau_i - d_i omega_i + T_(i-1) - T_i,
 *   T_i = k_i (theta_i - theta_(i+1)) + c_i (omega_i - omega_(i+1)),   T_0 = T_n = 0.
 *
 * The torques tau_i are constant. */
#ifndef ROT_SHAFT_H
#define ROT_SHAFT_H

#include <stddef.h>

#include "ground/status.h"

typedef struct rot_shaft_params {
  size_t n;                            /* >= 1 */
  const double *inertia_kg_m2;         /* J, n, > 0 */
  const double *stiffness_n_m_per_rad; /* k, n - 1, >= 0 */
  const double *damping_n_m_s;         /* c, n - 1, >= 0 */
  const double *viscous_n_m_s;         /* d, n, >= 0 */
  const double *torque_n_m;            /* tau, n */
  const double *theta0_rad;            /* n */
  const double *omega0_rad_per_s;      /* n */
  double start_s;
} rot_shaft_params;

/* Row i, rotor j at [i n + j]. The shaft torque acts on rotor j + 1; NaN for the last rotor. */
#define ROT_SHAFT_COLUMNS(X)                                                                       \
  X(double, theta_rad)                                                                             \
  X(double, omega_rad_per_s)                                                                       \
  X(double, shaft_torque_n_m)

typedef struct rot_shaft_columns {
#define X(type, name) type *name;
  ROT_SHAFT_COLUMNS(X)
#undef X
} rot_shaft_columns;

/* parameters => *info, cleared, with the state at the start. */
static inline void rot_shaft_note_start(const rot_shaft_params *p, rot_info *info) {
  rot_info_clear(info, rot_turning);
  for (size_t i = 0; i < p->n; i++) rot_note_state(info, p->theta0_rad[i], p->omega0_rad_per_s[i]);
}

#endif
