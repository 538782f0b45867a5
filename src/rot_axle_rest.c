#include "rot_axle_rest.h"

#include <math.h>

#include "rot_real.h"

enum { ROWS_PER_POLL = 8192, STEPS_PER_POLL = 1024 };

rot_status rot_axle_march_begin(rot_axle_march *march) {
  const rot_axle_params *p = &march->scene->linear;
  rot_axle_base *base = &march->base;
  *base = (rot_axle_base){0};
  base->time_s = p->start_s;
  base->theta = p->theta0_rad;
  base->omega = p->omega0_rad_per_s;
  base->heading = (base->omega > 0.0) - (base->omega < 0.0);
  march->done = 0;
  rot_info_clear(march->info, rot_turning);
  rot_note_state(march->info, base->theta, base->omega);
  march->info->time_s = p->start_s;
  if (march->n > 0 && !(march->time_s[0] >= p->start_s)) {
    march->info->time_s = march->time_s[0];
    return ROT_EVALUE;
  }
  return ROT_OK;
}

double rot_axle_march_elapsed(const rot_axle_march *march, double t, double *lo) {
  double first, second, s = rot_two_sum(t, -march->base.time_s, &first);
  s = rot_two_sum(s, first - march->base.time_lo, &second);
  if (s < 0.0) s = second = 0.0;
  *lo = second;
  return s;
}

int rot_axle_march_row_before(const rot_axle_march *march, double end_s) {
  return march->done < march->n && march->time_s[march->done] < end_s;
}

double rot_axle_march_horizon(const rot_axle_march *march) {
  return march->endless || march->n == 0 ? (double)INFINITY : march->time_s[march->n - 1];
}

rot_status rot_axle_march_row(rot_axle_march *march, double theta, double omega, double applied,
                              double theta_error, double omega_error) {
  const rot_axle_scene *scene = march->scene;
  const size_t i = march->done;
  const double t = march->time_s[i];
  march->info->time_s = t;
  if (!(isfinite(theta) && isfinite(omega))) return ROT_ERANGE;
  rot_axle_scene_row(scene, march->out, i, t, theta, omega, applied, march->base.stuck);
  if (omega == 0.0 && !march->base.stuck && scene->coulomb_n_m > 0.0) {
    /* It is about to leave: friction is there already. */
    march->out->damping_torque_n_m[i] = -copysign(scene->coulomb_n_m, applied);
    march->out->net_torque_n_m[i] = applied + march->out->damping_torque_n_m[i];
  }
  rot_note_row(march->info, theta, omega, theta_error, omega_error);
  march->info->rows_done = ++march->done;
  if (march->done % ROWS_PER_POLL) return ROT_OK;
  return rot_poll(march->hooks, (double)march->done / (double)march->n);
}

rot_status rot_axle_march_held(rot_axle_march *march, double end_s) {
  rot_axle_base *base = &march->base;
  rot_status status = ROT_OK;
  double lo;
  while (status == ROT_OK && rot_axle_march_row_before(march, end_s)) {
    const double t = march->time_s[march->done];
    const int near = rot_axle_march_elapsed(march, t, &lo) <= base->settle_s;
    status = rot_axle_march_row(march, base->theta, 0.0,
                                rot_axle_scene_applied(march->scene, t, base->theta, 0.0, 0.0),
                                base->theta_error, near ? base->omega_error : 0.0);
  }
  if (status != ROT_OK || !isfinite(end_s)) return status;
  if (rot_axle_march_elapsed(march, end_s, &lo) > base->settle_s) {
    base->settle_s = base->omega_error = 0.0;
  }
  base->time_s = end_s;
  base->time_lo = 0.0;
  return ROT_OK;
}

rot_status rot_axle_march_move(rot_axle_march *march, double time_s, double time_lo, double dtheta,
                               double omega, double theta_error, double omega_error) {
  rot_axle_base *base = &march->base;
  double lo;
  base->time_s = rot_two_sum(time_s, time_lo, &base->time_lo);
  base->theta = rot_two_sum(base->theta, dtheta, &lo);
  base->theta = rot_two_sum(base->theta, lo + base->theta_lo, &base->theta_lo);
  base->omega = omega;
  base->theta_error = theta_error;
  base->omega_error = omega_error;
  if (omega != 0.0) base->heading = omega > 0.0 ? 1 : -1;
  if (!march->endless) march->info->time_s = base->time_s;
  if (!(isfinite(base->theta) && isfinite(omega))) return ROT_ERANGE;
  rot_note_state(march->info, base->theta, omega);
  return ROT_OK;
}

rot_status rot_axle_march_rest(rot_axle_march *march, double applied, int *leaves) {
  rot_axle_base *base = &march->base;
  const double most = march->scene->static_n_m;
  rot_status status = ROT_OK;
  if (fabs(applied) <= most) {
    if (!base->stuck && most > 0.0) {
      status = rot_events_add(march->events, base->time_s, ROT_EVENT_STICK);
    }
    base->stuck = 1;
    *leaves = 0;
    return status;
  }
  *leaves = applied > 0.0 ? 1 : -1;
  if (most > 0.0 && (base->stuck || base->heading == 0)) {
    status = rot_events_add(march->events, base->time_s, ROT_EVENT_SLIP);
  } else if (base->heading != 0 && *leaves != base->heading) {
    status = rot_events_add(march->events, base->time_s, ROT_EVENT_REVERSE);
  }
  base->stuck = 0;
  base->settle_s = 0.0;
  base->heading = *leaves;
  return status;
}

rot_status rot_axle_march_step(rot_axle_march *march) {
  if (++march->info->steps % STEPS_PER_POLL) return ROT_OK;
  return rot_poll(march->hooks, march->n ? (double)march->done / (double)march->n : 0.0);
}
