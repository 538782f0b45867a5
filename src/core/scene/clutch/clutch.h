/* Two bodies that turn about one axis, and a clutch between them:
 *
 *   I1 omega1' = tau1(t) - T,   I2 omega2' = tau2(t) + T,
 *
 * T = capacity sign(omega1 - omega2) while it slips; while it is locked, what keeps the speeds
 * equal, as long as that is at most the static capacity; 0 before it is engaged. The torques are
 * constant between given times. Closed form, with exact times of locking. */
#ifndef ROT_CLUTCH_H
#define ROT_CLUTCH_H

#include <stddef.h>

#include "engine/events.h"
#include "ground/status.h"

/* Constant between n times, increasing; value i + 1 from time i on, n + 1 values. */
typedef struct rot_steps {
  size_t n;
  const double *time_s, *value;
} rot_steps;

typedef struct rot_clutch_params {
  double inertia_kg_m2[2];         /* > 0 */
  double capacity_n_m, static_n_m; /* 0 <= capacity <= static */
  rot_steps torque_n_m[2];
  double engage_s, start_s;
  double theta0_rad[2], omega0_rad_per_s[2];
} rot_clutch_params;

#define ROT_CLUTCH_COLUMNS(X)                                                                      \
  X(double, theta_1_rad)                                                                           \
  X(double, omega_1_rad_per_s)                                                                     \
  X(double, theta_2_rad)                                                                           \
  X(double, omega_2_rad_per_s)                                                                     \
  X(double, clutch_torque_n_m) /* on body 2; body 1 feels the opposite */                          \
  X(double, heat_j)            /* since the start */                                               \
  X(int, locked)

/* Places in it. */
enum { ROT_CLUTCH_OMEGA_1 = 1, ROT_CLUTCH_OMEGA_2 = 3, ROT_CLUTCH_HEAT_J = 5 };

typedef struct rot_clutch_columns {
#define X(type, name) type *name;
  ROT_CLUTCH_COLUMNS(X)
#undef X
} rot_clutch_columns;

int rot_clutch_is_driven(const rot_clutch_params *p);

/* Since the start: work and impulse of the two torques, heat of the clutch. */
#define ROT_CLUTCH_FLOWS(X)                                                                        \
  X(work_j)                                                                                        \
  X(dissipated_j)                                                                                  \
  X(torque_impulse_n_m_s)

typedef struct rot_clutch_flows {
#define X(name) double name;
  ROT_CLUTCH_FLOWS(X)
#undef X
} rot_clutch_flows;

enum { ROT_CLUTCH_WORK, ROT_CLUTCH_HEAT, ROT_CLUTCH_IMPULSE, ROT_CLUTCH_N_FLOWS };

/* Times are finite, do not decrease and are not before start_s (ROT_EVALUE): the
 * motion before a lock is lost. flow[]: a column for each flow, with its bound, or NULL. Events:
 * lock, slip, reverse. The errors in *info are bounds, unless a torque is within a rounding of the
 * static capacity. */
rot_status rot_clutch_run(const rot_clutch_params *p, size_t n, const double time_s[],
                          const rot_clutch_columns *out, double *const flow[], double flow_error[],
                          rot_events *events, const rot_hooks *hooks, rot_info *info);

/* The engagement from two speeds to one under constant torques; capacity Inf is instant. Never
 * locks: time and heat Inf, speed NaN. */
typedef struct rot_clutch_engagement {
  double lock_s, omega_rad_per_s, heat_j, locked_torque_n_m;
} rot_clutch_engagement;

rot_clutch_engagement rot_clutch_engage(double inertia_1, double inertia_2, double capacity_n_m,
                                        double torque_1, double torque_2, double omega_1,
                                        double omega_2);

#endif
