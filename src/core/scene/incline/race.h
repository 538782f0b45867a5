/* Round bodies released together at the top of inclines. Forces from rest are constant: each body
 * rests, rolls or slides permanently. */
#ifndef ROT_INCLINE_RACE_H
#define ROT_INCLINE_RACE_H

#include "ground/column.h"
#include "ground/status.h"

typedef struct rot_race_bodies {
  size_t n;
  rot_column beta;             /* I/(m R^2) >= 0; 0: point mass; Inf: the body does not move */
  rot_column radius_m;         /* > 0 */
  rot_column angle_deg;        /* -90 to 90 */
  rot_column gravity_m_per_s2; /* >= 0 */
  rot_column mu_static;        /* >= 0 */
  rot_column mu_kinetic;       /* >= 0 */
  rot_column arm_m;            /* >= 0, of the rolling resistance */
  rot_column length_m;         /* > 0, to the finish */
} rot_race_bodies;

/* friction_needed: smallest coefficient of friction for rolling or rest; Inf: friction is needed
 * without a normal force. finish_time_s: Inf if the body does not reach the finish. Neither slips
 * nor rests: it rolls. */
#define ROT_RACE_COLUMNS(X)                                                                        \
  X(double, acceleration_m_per_s2)                                                                 \
  X(double, angular_acceleration_rad_per_s2)                                                       \
  X(double, friction_needed)                                                                       \
  X(double, finish_time_s)                                                                         \
  X(int, slips)                                                                                    \
  X(int, rests)

typedef struct rot_race_columns {
#define X(type, name) type *name;
  ROT_RACE_COLUMNS(X)
#undef X
} rot_race_columns;

/* bodies => accelerations, finish times, modes. A row with a NaN gives NaN. */
rot_status rot_race_starts(const rot_race_bodies *bodies, const rot_race_columns *out,
                           const rot_hooks *hooks, rot_info *info);

/* One row per time and body, sorted by time. */
typedef struct rot_race_frames {
  double *time_s, *x_m, *v_m_per_s, *theta_rad, *omega_rad_per_s;
  int *finished;
} rot_race_frames;

/* (accelerations, finish times, times >= 0) => rows. After the finish a body keeps its state at the
 * finish. */
rot_status rot_race_run(size_t n, const double acceleration[], const double angular[],
                        const double finish_s[], size_t times, const double time_s[],
                        const rot_race_frames *out, const rot_hooks *hooks, rot_info *info);

#endif
