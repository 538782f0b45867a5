/* Rotors in a line on one shaft, n of them, with a spring and a damper between neighbours:
 *
 *   J_i theta_i'' = tau_i - d_i omega_i + T_(i-1) - T_i,
 *   T_i = k_i (theta_i - theta_(i+1)) + c_i (omega_i - omega_(i+1)),   T_0 = T_n = 0,
 *
 * with constant torques tau_i. Exact: the mean motion by itself, the twists in modes. */
#ifndef ROT_ROTORS_H
#define ROT_ROTORS_H

#include <stddef.h>

#include "rot_status.h"

typedef struct rot_rotors_params {
  size_t n;                                            /* >= 1 */
  const double *inertia_kg_m2;                         /* n, > 0 */
  const double *stiffness_n_m_per_rad, *damping_n_m_s; /* n - 1, >= 0 */
  const double *viscous_n_m_s, *torque_n_m;            /* n; viscous >= 0 */
  const double *theta0_rad, *omega0_rad_per_s;         /* n */
  double start_s;
} rot_rotors_params;

/* Row i, rotor j at [i n + j]; the shaft torque is that on rotor j + 1, NaN for the last. */
#define ROT_ROTORS_COLUMNS(X)                                                                      \
  X(double, theta_rad)                                                                             \
  X(double, omega_rad_per_s)                                                                       \
  X(double, shaft_torque_n_m)

typedef struct rot_rotors_columns {
#define X(type, name) type *name;
  ROT_ROTORS_COLUMNS(X)
#undef X
} rot_rotors_columns;

/* Exact for any stiffness. Without damping, or with c_i = a k_i and d_i = b J_i, each mode is a
 * closed form; otherwise the exponential of the system in energy-scaled modal coordinates. `fast`
 * lets even stretches of rows share one exponential. The errors in *info are estimates:
 * roundings times the phase turned, and what the balance of momentum is off by. */
rot_status rot_rotors_modal(const rot_rotors_params *p, int fast, size_t n, const double time_s[],
                            const rot_rotors_columns *out, const rot_hooks *hooks, rot_info *info);

/* Clears *info, the state at the start noted. */
void rot_rotors_note_start(const rot_rotors_params *p, rot_info *info);

/* Angular frequencies sqrt(eigenvalue) of the undamped shaft in rad/s, ascending, n of them: 0 for
 * the mean motion and for each spring that is missing. */
rot_status rot_rotors_frequencies(const rot_rotors_params *p, double sigma[]);

#endif
