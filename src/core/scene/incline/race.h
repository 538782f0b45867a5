/* Many round bodies released together at the top of an incline. From rest, all forces are
 * constant: a body rests, rolls or slides for good. */
#ifndef ROT_INCLINE_RACE_H
#define ROT_INCLINE_RACE_H

#include "ground/column.h"
#include "ground/status.h"

typedef struct rot_race_bodies {
  size_t n;
  rot_column beta;     /* >= 0; 0: it does not turn; Inf: it does not move */
  rot_column radius_m; /* > 0 */
  rot_column angle_deg, gravity_m_per_s2, mu_static, mu_kinetic, arm_m;
  rot_column length_m; /* > 0, to the finish */
} rot_race_bodies;

/* needed: the coefficient of friction that rolling, or rest, needs; Inf where no normal force acts
 * and one would be needed. finish_time_s: Inf where the body does not come
 * down. Neither slips nor rests: it rolls. */
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

/* NaN in a row with NaN. */
rot_status rot_race_starts(const rot_race_bodies *bodies, const rot_race_columns *out,
                           const rot_hooks *hooks, rot_info *info);

/* A row for each time >= 0 and body, all bodies at the first time first. From the finish on a body
 * keeps the state in which it arrived. */
typedef struct rot_race_frames {
  double *time_s, *x_m, *v_m_per_s, *theta_rad, *omega_rad_per_s;
  int *finished;
} rot_race_frames;

rot_status rot_race_run(size_t n, const double acceleration[], const double angular[],
                        const double finish_s[], size_t times, const double time_s[],
                        const rot_race_frames *out, const rot_hooks *hooks, rot_info *info);

#endif
