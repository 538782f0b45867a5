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

typedef struct rot_clutch_columns {
#define X(type, name) type *name;
  ROT_CLUTCH_COLUMNS(X)
#undef X
} rot_clutch_columns;

/* Times are finite, do not decrease and are not before start_s (ROT_EVALUE): the
 * motion before a lock is lost. Events: lock, slip, reverse. The errors in *info are bounds, unless
 * a torque is within a rounding of the static capacity. */
rot_status rot_clutch_run(const rot_clutch_params *p, size_t n, const double time_s[],
                          const rot_clutch_columns *out, rot_events *events, const rot_hooks *hooks,
                          rot_info *info);

#define ROT_CLUTCH_LEDGER(X)                                                                       \
  X(work_j)                                                                                        \
  X(work_rounding_j)

typedef struct rot_clutch_ledger {
#define X(name) double name;
  ROT_CLUTCH_LEDGER(X)
#undef X
} rot_clutch_ledger;

/* Work of the two torques between two times, not before start_s, with its rounding. */
rot_status rot_clutch_work(const rot_clutch_params *p, double from_s, double to_s,
                           rot_clutch_ledger *ledger);

/* The engagement from two speeds to one under constant torques; capacity Inf is instant. Never
 * locks: time and heat Inf, speed NaN. */
typedef struct rot_clutch_engagement {
  double lock_s, omega_rad_per_s, heat_j, locked_torque_n_m;
} rot_clutch_engagement;

rot_clutch_engagement rot_clutch_engage(double inertia_1, double inertia_2, double capacity_n_m,
                                        double torque_1, double torque_2, double omega_1,
                                        double omega_2);

#endif
