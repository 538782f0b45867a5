#include "scene/incline/race.h"

#include <math.h>

#include "scene/incline/incline.h"
#include "ground/real.h"

/* Rows between two polls: some ms. */
enum { CHUNK = 65536 };

typedef struct slope {
  double angle, sine, cosine, holds;
} slope;

/* body i => acceleration, needed friction, finish time, mode. */
static void start(const rot_race_bodies *b, size_t i, slope *on, const rot_race_columns *out) {
  const double beta = rot_at(b->beta, i), radius = rot_at(b->radius_m, i);
  const double angle = rot_at(b->angle_deg, i), gravity = rot_at(b->gravity_m_per_s2, i);
  const double length = rot_at(b->length_m, i), arm = rot_at(b->arm_m, i);
  const double mu_static = rot_at(b->mu_static, i), mu_kinetic = rot_at(b->mu_kinetic, i);
  if (angle != on->angle) {
    on->angle = angle;
    rot_sin_cos_deg(angle, &on->sine, &on->cosine);
    on->holds = rot_incline_holds(angle, on->sine, on->cosine);
  }
  const double normal = gravity * on->cosine, pull = gravity * on->sine;
  const double resists = beta > 0.0 ? arm / radius * normal : 0.0, spin = 1.0 / (1.0 + beta);
  const rot_incline_contact c = {beta,
                                 isinf(beta) ? 1.0 : beta * spin,
                                 spin,
                                 pull,
                                 rot_incline_friction(mu_kinetic, normal),
                                 rot_incline_friction(mu_static, normal),
                                 resists,
                                 on->holds};
  const rot_incline_directions direction = rot_incline_leave_rest(&c, pull);
  const rot_incline_forces f = rot_incline_forces_of(&c, pull, direction);
  const double held = fabs(pull) <= resists * on->holds ? fabs(pull) : resists;
  const double need = rot_incline_needed(&c, fabs(pull), held);
  const double rate = direction.slip != 0 || direction.spin != 0 ? f.v : 0.0,
               turn = direction.spin != 0 ? f.w : 0.0;
  const int known = !isnan(beta + radius + angle + gravity + arm + mu_static + mu_kinetic);
  out->acceleration_m_per_s2[i] = known ? rate : NAN;
  out->angular_acceleration_rad_per_s2[i] = !known ? NAN : beta == 0.0 ? 0.0 : turn / radius;
  out->friction_needed[i] = !known         ? NAN
                            : need == 0.0  ? 0.0
                            : normal > 0.0 ? need / normal
                                           : (double)INFINITY;
  out->finish_time_s[i] = !known || isnan(length) ? NAN
                          : rate > 0.0            ? sqrt(2.0 * (length / rate))
                                                  : (double)INFINITY;
  out->slips[i] = direction.slip != 0;
  out->rests[i] = direction.slip == 0 && rate == 0.0;
}

rot_status rot_race_starts(const rot_race_bodies *bodies, const rot_race_columns *out,
                           const rot_hooks *hooks, rot_info *info) {
  slope on = {NAN, 0.0, 0.0, 1.0};
  rot_info_clear(info, NULL);
  for (size_t i = 0; i < bodies->n; i++) {
    start(bodies, i, &on, out);
    info->rows_done = i + 1;
    if ((i + 1) % CHUNK) continue;
    info->status = rot_poll(hooks, (double)i / (double)bodies->n);
    if (info->status != ROT_OK) return info->status;
  }
  return ROT_OK;
}

/* => rate times t: of an infinite rate 0 at the start. */
static double after(double rate, double t) { return t == 0.0 && isinf(rate) ? 0.0 : rate * t; }

rot_status rot_race_run(size_t n, const double acceleration[], const double angular[],
                        const double finish_s[], size_t times, const double time_s[],
                        const rot_race_frames *out, const rot_hooks *hooks, rot_info *info) {
  const double rows = (double)n * (double)times;
  rot_info_clear(info, NULL);
  for (size_t k = 0, row = 0; k < times; k++) {
    for (size_t i = 0; i < n; i++, row++) {
      const int finished = time_s[k] >= finish_s[i];
      const double t = finished ? finish_s[i] : time_s[k], half = 0.5 * t;
      out->time_s[row] = time_s[k];
      out->v_m_per_s[row] = after(acceleration[i], t);
      out->omega_rad_per_s[row] = after(angular[i], t);
      out->x_m[row] = after(out->v_m_per_s[row], half);
      out->theta_rad[row] = after(out->omega_rad_per_s[row], half);
      out->finished[row] = finished;
      if ((row + 1) % CHUNK) continue;
      info->status = rot_poll(hooks, (double)row / rows);
      if (info->status != ROT_OK) return info->status;
    }
  }
  info->rows_done = n * times;
  return ROT_OK;
}
