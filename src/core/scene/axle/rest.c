#include "scene/axle/rest.h"

#include <math.h>

#include "ground/real.h"

/* The first piece is that of the start. */
rot_axle_rest rot_axle_rest_from(const rot_axle_scene *scene, size_t n, const double time_s[],
                                 const rot_axle_columns *out, rot_events *events, rot_info *info) {
  const rot_axle_params *p = &scene->linear;
  const double omega = p->omega0_rad_per_s;
  rot_axle_rest rest = {.scene = scene, .time_s = time_s, .out = out, .events = events};
  rest.info = info;
  rest.last_s = n ? time_s[n - 1] : (double)INFINITY;
  rest.base = (rot_axle_base){.time_s = p->start_s, .theta = p->theta0_rad, .omega = omega};
  rest.base.heading = (omega > 0.0) - (omega < 0.0);
  rest.index = rot_torque_find(&p->torque, p->start_s, 1);
  rest.piece = rot_torque_piece_at(&p->torque, rest.index);
  rot_info_clear(info, rot_turning);
  info->time_s = p->start_s;
  rot_note_state(info, p->theta0_rad, omega);
  return rest;
}

int rot_axle_rest_enter(rot_axle_rest *rest) {
  rot_torque_piece *piece = &rest->piece;
  const size_t before = rest->index;
  double lo;
  while (isfinite(piece->end_s) && (rot_axle_rest_elapsed(rest, piece->end_s, &lo) <= 0.0 ||
                                    piece->start_s == piece->end_s)) {
    *piece = rot_torque_piece_at(&rest->scene->linear.torque, ++rest->index);
  }
  return rest->index != before;
}

double rot_axle_rest_elapsed(const rot_axle_rest *rest, double t, double *lo) {
  double first, second, s = rot_two_sum(t, -rest->base.time_s, &first);
  s = rot_two_sum(s, first - rest->base.time_lo, &second);
  if (s < 0.0) s = second = 0.0;
  *lo = second;
  return s;
}

/* Writes the row; notes its errors. */
rot_status rot_axle_rest_row(rot_axle_rest *rest, size_t i, const rot_axle_change *by,
                             double applied) {
  const rot_axle_scene *scene = rest->scene;
  const rot_axle_base *base = &rest->base;
  const double theta = base->theta + (by->dtheta + base->theta_lo), omega = by->omega;
  if (!(isfinite(theta) && isfinite(omega))) return ROT_ERANGE;
  rot_axle_scene_row(scene, rest->out, i, rest->time_s[i], theta, omega, applied, base->stuck);
  rot_note_row(rest->info, theta, omega, by->theta_error, by->omega_error);
  return ROT_OK;
}

rot_status rot_axle_rest_held_row(rot_axle_rest *rest, size_t i) {
  const rot_axle_base *base = &rest->base;
  const double t = rest->time_s[i];
  double lo;
  const int near = rot_axle_rest_elapsed(rest, t, &lo) <= base->settle_s;
  const rot_axle_change none = {-base->theta_lo, 0.0, base->theta_error,
                                near ? base->omega_error : 0.0};
  return rot_axle_rest_row(rest, i, &none,
                           rot_axle_scene_applied(rest->scene, t, base->theta, 0.0, 0.0));
}

void rot_axle_rest_hold(rot_axle_rest *rest, double end_s) {
  rot_axle_base *base = &rest->base;
  double lo;
  if (rot_axle_rest_elapsed(rest, end_s, &lo) > base->settle_s) {
    base->settle_s = base->omega_error = 0.0;
  }
  base->time_s = end_s;
  base->time_lo = 0.0;
}

rot_status rot_axle_rest_move(rot_axle_rest *rest, double time_s, double time_lo,
                              const rot_axle_change *by) {
  rot_axle_base *base = &rest->base;
  double lo;
  base->time_s = rot_two_sum(time_s, time_lo, &base->time_lo);
  base->theta = rot_two_sum(base->theta, by->dtheta, &lo);
  base->theta = rot_two_sum(base->theta, lo + base->theta_lo, &base->theta_lo);
  base->omega = by->omega;
  base->theta_error = by->theta_error;
  base->omega_error = by->omega_error;
  if (by->omega != 0.0) base->heading = by->omega > 0.0 ? 1 : -1;
  if (!(isfinite(base->theta) && isfinite(by->omega))) return ROT_ERANGE;
  rot_note_state(rest->info, base->theta, by->omega);
  return ROT_OK;
}

/* Held at rest, or breaks loose: static friction against the torque. */
rot_status rot_axle_rest_decide(rot_axle_rest *rest, double applied, int *leaves) {
  rot_axle_base *base = &rest->base;
  const double max = rest->scene->static_n_m;
  const int was_stuck = base->stuck, heading = base->heading;
  base->stuck = fabs(applied) <= max;
  *leaves = base->stuck ? 0 : applied > 0.0 ? 1 : -1;
  if (base->stuck) {
    if (was_stuck || !(max > 0.0) || heading == 0)
      return ROT_OK; /* heading 0: at rest from the start */
    return rot_events_add(rest->events, base->time_s, ROT_EVENT_STICK);
  }
  base->settle_s = 0.0;
  base->heading = *leaves;
  if (max > 0.0 && was_stuck) {
    return rot_events_add(rest->events, base->time_s, ROT_EVENT_SLIP);
  }
  if (heading == 0 || *leaves == heading || !rot_axle_kinks_at_rest(rest->scene)) return ROT_OK;
  return rot_events_add(rest->events, base->time_s, ROT_EVENT_REVERSE);
}
