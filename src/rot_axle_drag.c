#include "rot_axle_drag.h"

#include <math.h>

#include "rot_axle_rest.h"
#include "rot_drag.h"
#include "rot_real.h"

static int fits(const rot_axle_scene *scene) {
  const rot_axle_params *p = &scene->linear;
  return p->inertia_kg_m2 > 0.0 && p->viscous_n_m_s >= 0.0 && scene->quadratic_n_m_s2 >= 0.0 &&
         scene->coulomb_n_m >= 0.0 && scene->static_n_m >= scene->coulomb_n_m &&
         scene->n_terms == 0 && scene->n_inertia == 0 && !p->torque.call;
}

/* The law for motion in a direction, mirrored where that is backward. */
static rot_drag_law law_towards(const rot_axle_scene *scene, double torque, int direction) {
  rot_drag_law law = {0.0, 0.0, scene->linear.viscous_n_m_s, scene->quadratic_n_m_s2,
                      scene->linear.inertia_kg_m2};
  law.drive_n_m = rot_two_sum(direction * torque, -scene->coulomb_n_m, &law.drive_lo);
  return law;
}

typedef struct change {
  double dtheta, omega, theta_error, omega_error;
} change;

/* From the base, with its errors carried along. */
static change after(const rot_axle_base *base, const rot_drag *flow, double t, double t_lo) {
  const rot_drag_state to = rot_drag_at(flow, t, t_lo);
  const int sign = base->heading;
  change out;
  out.dtheta = sign * to.theta;
  out.omega = to.omega > 0.0 ? sign * to.omega : to.omega;
  out.omega_error = to.omega_error + base->omega_error * to.gain;
  out.theta_error = base->theta_error + base->omega_error * to.reach_s + to.theta_error +
                    ROT_EPS * fabs(base->theta + out.dtheta);
  return out;
}

/* Rows of one motion: before `end_s`, and before the stop. */
static rot_status moving_rows(rot_axle_march *march, const rot_torque_piece *piece,
                              const rot_drag *flow, double stop) {
  const double motor = march->scene->motor_n_m_s;
  const rot_axle_base *base = &march->base;
  rot_status status = ROT_OK;
  while (status == ROT_OK && rot_axle_march_row_before(march, piece->end_s)) {
    const double t = march->time_s[march->done];
    double lo, s = rot_axle_march_elapsed(march, t, &lo);
    if (s >= stop) break;
    const change to = after(base, flow, s, lo);
    const double theta = base->theta + (to.dtheta + base->theta_lo);
    const double applied = t == piece->start_s
                               ? rot_axle_scene_applied(march->scene, t, theta, 0.0, to.omega)
                               : piece->start_n_m - (motor != 0.0 ? motor * to.omega : 0.0);
    status = rot_axle_march_row(march, theta, to.omega, applied, to.theta_error, to.omega_error);
  }
  return status;
}

/* Move on to the stop or to the end of the piece. */
static rot_status motion(rot_axle_march *march, const rot_torque_piece *piece) {
  rot_axle_base *base = &march->base;
  const rot_drag_law law = law_towards(march->scene, piece->start_n_m, base->heading);
  const double horizon = fmin(piece->end_s, rot_axle_march_horizon(march));
  double lo, left_lo, e, span = rot_axle_march_elapsed(march, horizon, &lo);
  const rot_drag flow = rot_drag_from(&law, fabs(base->omega), span);
  const double stop = rot_drag_stop(&flow);
  rot_status status = moving_rows(march, piece, &flow, stop);
  if (status != ROT_OK || (march->done == march->n && !march->endless)) return status;
  const double left = isfinite(piece->end_s) ? rot_axle_march_elapsed(march, piece->end_s, &left_lo)
                                             : (double)INFINITY;
  if (stop < left) {
    change to = after(base, &flow, stop, 0.0);
    const double time = rot_two_sum(base->time_s, stop, &e), drive = fabs(law.drive_n_m);
    /* The time of the stop is good to 4 roundings, the speed lost meanwhile to as many. */
    to.omega_error += 4.0 * ROT_EPS * rot_muldiv(drive, stop, law.inertia_kg_m2, NULL);
    base->settle_s = rot_muldiv(to.omega_error, law.inertia_kg_m2, drive, NULL);
    return rot_axle_march_move(march, time, e + base->time_lo, to.dtheta, 0.0,
                               to.theta_error + to.omega_error * base->settle_s, to.omega_error);
  }
  if (!isfinite(left)) return ROT_OK;
  const change to = after(base, &flow, left, left_lo);
  return rot_axle_march_move(march, piece->end_s, 0.0, to.dtheta, to.omega, to.theta_error,
                             to.omega_error);
}

/* Up to the end of the piece, or until there is nothing more to do. */
static rot_status through_piece(rot_axle_march *march, const rot_torque_piece *piece) {
  rot_axle_base *base = &march->base;
  rot_status status = ROT_OK;
  double lo;
  /* Twice at most: a motion that stops, and the one that leaves from there. */
  while (status == ROT_OK && (march->done < march->n || march->endless)) {
    if (isfinite(piece->end_s) && rot_axle_march_elapsed(march, piece->end_s, &lo) <= 0.0) break;
    status = rot_axle_march_step(march);
    if (status == ROT_OK && base->omega == 0.0) {
      int leaves;
      status = rot_axle_march_rest(march, piece->start_n_m, &leaves);
      if (status != ROT_OK) return status;
      if (!leaves) return rot_axle_march_held(march, piece->end_s);
    }
    const rot_axle_base before = *base;
    if (status == ROT_OK) status = motion(march, piece);
    /* On and on. A stop after less time than a double can tell is a change, too. */
    if (base->time_s == before.time_s && base->time_lo == before.time_lo &&
        base->omega == before.omega) {
      break;
    }
  }
  return status;
}

static rot_status march_on(rot_axle_march *march) {
  const rot_torque *torque = &march->scene->linear.torque;
  if (!fits(march->scene)) {
    rot_info_clear(march->info, rot_turning);
    return ROT_EVALUE;
  }
  rot_status status = rot_axle_march_begin(march);
  for (size_t k = rot_torque_find(torque, march->base.time_s, 1);
       status == ROT_OK && k <= torque->n && (march->done < march->n || march->endless); k++) {
    const rot_torque_piece piece = rot_torque_piece_at(torque, k);
    if (piece.start_s == piece.end_s) continue;
    if (piece.start_n_m != piece.end_n_m) {
      march->info->time_s = piece.start_s;
      return ROT_EVALUE;
    }
    status = through_piece(march, &piece);
  }
  if (status == ROT_OK && !march->endless && march->done < march->n) return ROT_ESTEP;
  return status;
}

rot_status rot_axle_drag(const rot_axle_scene *scene, size_t n, const double time_s[],
                         const rot_axle_columns *out, rot_events *events, const rot_hooks *hooks,
                         rot_info *info) {
  rot_axle_march march = {.scene = scene,
                          .n = n,
                          .time_s = time_s,
                          .out = out,
                          .events = events,
                          .hooks = hooks,
                          .info = info};
  return info->status = march_on(&march);
}

rot_status rot_axle_drag_stop(const rot_axle_scene *scene, double *time_s, double *theta_rad) {
  rot_info info;
  rot_events events = {0, 0, NULL, NULL};
  rot_axle_march march = {.scene = scene, .events = &events, .info = &info, .endless = 1};
  const rot_status status = march_on(&march);
  *time_s = INFINITY;
  *theta_rad = NAN;
  if (status == ROT_OK && march.base.stuck) {
    *time_s = scene->linear.start_s;
    *theta_rad = march.base.theta;
    for (size_t i = 0; i < events.count; i++) {
      if (events.event[i] == ROT_EVENT_STICK) *time_s = events.time_s[i];
    }
  }
  rot_events_free(&events);
  return status;
}

double rot_axle_drag_terminal(const rot_axle_scene *scene) {
  const double last = scene->linear.torque.after_n_m;
  const int direction = last < 0.0 ? -1 : 1;
  const rot_drag_law law = law_towards(scene, last, direction);
  const double omega = rot_drag_terminal(&law);
  return omega > 0.0 ? direction * omega : omega;
}
