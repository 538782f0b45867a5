#include "scene/axle/drag.h"

#include <math.h>

#include "scene/axle/effects.h"
#include "scene/axle/motor.h"
#include "scene/axle/rest.h"
#include "maths/drag.h"
#include "engine/stepping.h"
#include "ground/real.h"

static int fits(const rot_axle_scene *scene) {
  return rot_axle_fits(scene, ROT_AXLE_DRAG_TAKES) && scene->linear.viscous_n_m_s >= 0.0 &&
         scene->quadratic_n_m_s2 >= 0.0 && scene->coulomb_n_m >= 0.0 &&
         scene->static_n_m >= scene->coulomb_n_m;
}

/* Law of a motion in a direction; mirrored if backward. */
static rot_drag_law law_towards(const rot_axle_scene *scene, double torque, int direction) {
  rot_drag_law law = {0.0, 0.0, scene->linear.viscous_n_m_s, scene->quadratic_n_m_s2,
                      scene->linear.inertia_kg_m2};
  law.drive_n_m = rot_two_sum(direction * torque, -scene->coulomb_n_m, &law.drive_lo);
  return law;
}

/* State of a run: held until the end of the piece, or moving until that or the stop. */
typedef struct drag_run {
  rot_axle_rest rest;
  int held; /* 1: hold, 0: motion */
  rot_drag_law law;
  rot_drag flow;
  double stop_s; /* time of the stop since the base */
} drag_run;

/* time since the base => change, with the propagated errors of the base. */
static rot_axle_change after(const drag_run *run, double t, double t_lo) {
  const rot_axle_base *base = &run->rest.base;
  const rot_drag_state to = rot_drag_at(&run->flow, t, t_lo);
  const int sign = base->heading;
  rot_axle_change out;
  out.dtheta = sign * to.theta;
  out.omega = to.omega > 0.0 ? sign * to.omega : to.omega;
  out.omega_error = to.omega_error + base->omega_error * to.gain;
  out.theta_error = base->theta_error + base->omega_error * to.reach_s + to.theta_error +
                    ROT_EPS * fabs(base->theta + out.dtheta);
  return out;
}

/* base => hold or motion by the torque there, events. */
static rot_status enter_segment(drag_run *run) {
  rot_axle_rest *rest = &run->rest;
  const rot_axle_base *base = &rest->base;
  rot_axle_rest_enter(rest);
  const rot_torque_piece *piece = &rest->piece;
  run->held = 0;
  if (base->omega == 0.0) {
    int leaves;
    const rot_status status = rot_axle_rest_decide(rest, piece->start_n_m, &leaves);
    run->held = !leaves;
    if (status != ROT_OK || run->held) return status;
  }
  double lo, span = rot_axle_rest_elapsed(rest, fmin(piece->end_s, rest->last_s), &lo);
  run->law = law_towards(rest->scene, piece->start_n_m, base->heading);
  run->flow = rot_drag_from(&run->law, fabs(base->omega), span);
  run->stop_s = rot_drag_stop(&run->flow);
  return ROT_OK;
}

static rot_status restart(void *model, int forward) {
  return forward ? enter_segment(model) : ROT_EVALUE;
}

static int holds(const void *model, double time_s) {
  const drag_run *run = model;
  double lo;
  return time_s < run->rest.piece.end_s &&
         (run->held || !(rot_axle_rest_elapsed(&run->rest, time_s, &lo) >= run->stop_s));
}

static rot_status write_row(void *model, size_t i) {
  drag_run *run = model;
  rot_axle_rest *rest = &run->rest;
  const rot_axle_base *base = &rest->base;
  if (run->held) return rot_axle_rest_held_row(rest, i);
  const double t = rest->time_s[i], motor = rest->scene->motor_n_m_s;
  double lo, s = rot_axle_rest_elapsed(rest, t, &lo);
  const rot_axle_change to = after(run, s, lo);
  const double applied = t == rest->piece.start_s
                             ? rot_axle_scene_applied(rest->scene, t, base->theta, 0.0, to.omega)
                             : rest->piece.start_n_m - (motor != 0.0 ? motor * to.omega : 0.0);
  return rot_axle_rest_row(rest, i, &to, applied);
}

/* motion => base at the stop or the end of the piece. */
static rot_status move(drag_run *run) {
  rot_axle_rest *rest = &run->rest;
  rot_axle_base *base = &rest->base;
  const double end_s = rest->piece.end_s;
  double lo = 0.0, e, left = isfinite(end_s) ? rot_axle_rest_elapsed(rest, end_s, &lo) : end_s;
  if (!(run->stop_s < left)) {
    const rot_axle_change to = after(run, left, lo);
    return rot_axle_rest_move(rest, end_s, 0.0, &to);
  }
  rot_axle_change to = after(run, run->stop_s, 0.0);
  const double time = rot_two_sum(base->time_s, run->stop_s, &e), drive = fabs(run->law.drive_n_m);
  /* Errors of the stop: its time, 4 roundings; the speed lost meanwhile, as many. */
  to.omega_error += 4.0 * ROT_EPS * rot_muldiv(drive, run->stop_s, run->law.inertia_kg_m2, NULL);
  base->settle_s = rot_muldiv(to.omega_error, run->law.inertia_kg_m2, drive, NULL);
  to.theta_error += to.omega_error * base->settle_s;
  to.omega = 0.0;
  return rot_axle_rest_move(rest, time, e + base->time_lo, &to);
}

/* End of the present segment, next segment; ROT_ESTEP if nothing changes. */
static rot_status next_piece(void *model, double *end_s) {
  drag_run *run = model;
  rot_axle_rest *rest = &run->rest;
  const rot_axle_base *base = &rest->base, before = *base;
  rot_status status = ROT_OK;
  if (run->held) {
    rot_axle_rest_hold(rest, rest->piece.end_s);
  } else {
    status = move(run);
  }
  *end_s = base->time_s;
  if (status != ROT_OK) return status;
  /* A stop within one ulp of time is a change. */
  const int stays = base->time_s == before.time_s && base->time_lo == before.time_lo &&
                    base->omega == before.omega;
  return stays ? ROT_ESTEP : enter_segment(run);
}

rot_status rot_axle_drag(const rot_axle_scene *scene, size_t n, const double time_s[],
                         const rot_axle_columns *out, rot_events *events, const rot_hooks *hooks,
                         rot_info *info) {
  static const rot_stepping stepping = {restart, holds, next_piece, write_row, NULL};
  drag_run run = {.rest = rot_axle_rest_from(scene, n, time_s, out, events, info)};
  if (!fits(scene)) return info->status = ROT_EVALUE;
  rot_step_rows(&stepping, &run, scene->linear.start_s, n, time_s, hooks, info);
  rot_axle_motor_error(scene, n, time_s, info);
  return info->status;
}

/* Steps through the pieces without rows. */
rot_status rot_axle_drag_stop(const rot_axle_scene *scene, double *time_s, double *theta_rad) {
  rot_info info;
  rot_events events = {0};
  drag_run run = {.rest = rot_axle_rest_from(scene, 0, NULL, NULL, &events, &info)};
  *time_s = INFINITY;
  *theta_rad = NAN;
  if (!fits(scene)) return ROT_EVALUE;
  rot_status status = enter_segment(&run);
  while (status == ROT_OK &&
         (isfinite(run.rest.piece.end_s) || (!run.held && run.stop_s < INFINITY))) {
    status = next_piece(&run, &info.time_s);
  }
  if (status == ROT_OK && run.rest.base.stuck) {
    *time_s = scene->linear.start_s;
    *theta_rad = run.rest.base.theta;
    for (size_t i = 0; i < events.count; i++) {
      if (events.event[i] == ROT_EVENT_STICK) *time_s = events.time_s[i];
    }
  } else if (status == ROT_OK) {
    const rot_axle_base *base = &run.rest.base;
    *theta_rad = base->theta + base->heading * rot_drag_reach(&run.law, fabs(base->omega));
  } else if (status == ROT_ERANGE && run.rest.base.omega == 0.0 &&
             run.rest.piece.end_s == INFINITY &&
             fabs(run.rest.piece.start_n_m) <= scene->static_n_m) {
    /* At rest for good, at an angle that is no double. */
    *time_s = run.rest.base.time_s;
    *theta_rad = run.rest.base.heading * (double)INFINITY;
    status = ROT_OK;
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
