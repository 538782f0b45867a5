/* Two bodies on one axis with a clutch between them:
 *
 *   I1 omega1' = tau1(t) - T,   I2 omega2' = tau2(t) + T.
 *
 * Slipping: T = capacity sign(omega1 - omega2). Locked: T keeps the speeds equal, |T| <= static
 * capacity. Not engaged: T = 0. The torques are piecewise constant in time. Closed form, with exact
 * times of locking. */
#ifndef ROT_CLUTCH_H
#define ROT_CLUTCH_H

#include <stddef.h>

#include "engine/events.h"
#include "ground/status.h"

/* A piecewise constant function of time. */
typedef struct rot_steps {
  size_t n;             /* number of steps */
  const double *time_s; /* n, increasing */
  const double *value;  /* n + 1: value[0] before time_s[0], value[i + 1] from time_s[i] on */
} rot_steps;

typedef struct rot_clutch_params {
  double inertia_kg_m2[2]; /* > 0 */
  double capacity_n_m;     /* >= 0, torque of the slipping clutch */
  double static_n_m;       /* >= capacity_n_m, largest torque of the locked clutch */
  rot_steps torque_n_m[2]; /* applied to the bodies */
  double engage_s;         /* >= start_s; the clutch transmits from then on */
  double start_s;
  double theta0_rad[2];
  double omega0_rad_per_s[2];
} rot_clutch_params;

#define ROT_CLUTCH_COLUMNS(X)                                                                      \
  X(double, theta_1_rad)                                                                           \
  X(double, omega_1_rad_per_s)                                                                     \
  X(double, theta_2_rad)                                                                           \
  X(double, omega_2_rad_per_s)                                                                     \
  X(double, clutch_torque_n_m) /* on body 2; the opposite on body 1 */                             \
  X(double, heat_j)            /* since the start */                                               \
  X(int, locked)

/* Indices of columns. */
enum { ROT_CLUTCH_OMEGA_1 = 1, ROT_CLUTCH_OMEGA_2 = 3, ROT_CLUTCH_HEAT_J = 5 };

typedef struct rot_clutch_columns {
#define X(type, name) type *name;
  ROT_CLUTCH_COLUMNS(X)
#undef X
} rot_clutch_columns;

/* 1 if a torque is not 0 at some time, else 0. */
int rot_clutch_is_driven(const rot_clutch_params *p);

/* Since the start: work of the two torques, heat of the clutch, impulse of the two torques. */
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

/* (parameters, times) => rows, flows, events (lock, slip, reverse), errors. Times: finite, not
 * decreasing, >= start_s (else ROT_EVALUE: the motion before a lock is not determined). flow[]: a
 * column for each flow, flow_error[] its bound; or NULL. The errors in *info are bounds, unless a
 * torque is within rounding of the static capacity. */
rot_status rot_clutch_run(const rot_clutch_params *p, size_t n, const double time_s[],
                          const rot_clutch_columns *out, double *const flow[], double flow_error[],
                          rot_events *events, const rot_hooks *hooks, rot_info *info);

/* An engagement under constant torques. Never locked: lock_s and heat_j Inf, omega NaN; so it is
 * where the speeds meet and the locked torque is beyond the capacity. */
typedef struct rot_clutch_engagement {
  double lock_s;            /* since engaging, >= 0 */
  double omega_rad_per_s;   /* common speed at the lock */
  double heat_j;            /* until the lock */
  double locked_torque_n_m; /* that keeps the speeds equal */
} rot_clutch_engagement;

/* (inertias, capacity, torques, speeds) => engagement; capacity Inf: locked at once. */
rot_clutch_engagement rot_clutch_engage(double inertia_1, double inertia_2, double capacity_n_m,
                                        double torque_1, double torque_2, double omega_1,
                                        double omega_2);

#endif
