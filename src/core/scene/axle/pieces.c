#include "scene/axle/pieces.h"

#include <math.h>

#include "scene/axle/motor.h"
#include "engine/stepping.h"

typedef struct run {
  const rot_axle_scene *scene;
  const rot_axle_pieces *pieces;
  void *model;
  const double *time_s;
  const rot_axle_columns *out;
  rot_info *info;
  int forward;
} run;

static int is_finite(const rot_axle_point *state) {
  return isfinite(state->theta_rad) && isfinite(state->omega_rad_per_s);
}

static rot_status restart(void *data, int forward) {
  run *r = data;
  r->forward = forward;
  r->pieces->restart(r->model, forward);
  return ROT_OK;
}

static int holds(const void *data, double time_s) {
  const run *r = data;
  const double end_s = r->pieces->piece_end(r->model);
  return r->forward ? time_s < end_s : time_s > end_s;
}

static rot_status next_piece(void *data, double *end_s) {
  const run *r = data;
  rot_axle_point state;
  *end_s = r->pieces->piece_end(r->model);
  r->pieces->next_piece(r->model, &state);
  if (!is_finite(&state)) return ROT_ERANGE;
  rot_note_state(r->info, state.theta_rad, state.omega_rad_per_s);
  return ROT_OK;
}

static rot_status write_row(void *data, size_t i) {
  const run *r = data;
  const double t = r->time_s[i];
  rot_axle_point state = {0.0, 0.0, 0.0, 0.0, 0.0};
  r->pieces->state_at(r->model, t, &state);
  const double theta = state.theta_rad, omega = state.omega_rad_per_s;
  if (!is_finite(&state)) return ROT_ERANGE;
  rot_axle_scene_row(r->scene, r->out, i, t, theta, omega,
                     rot_axle_scene_applied(r->scene, t, theta, state.theta_lo, omega), 0);
  rot_note_row(r->info, theta, omega, state.theta_error, state.omega_error);
  return ROT_OK;
}

rot_status rot_axle_by_pieces(const rot_axle_scene *scene, const rot_axle_pieces *pieces,
                              void *model, size_t n, const double time_s[],
                              const rot_axle_columns *out, const rot_hooks *hooks, rot_info *info) {
  static const rot_stepping stepping = {restart, holds, next_piece, write_row, NULL};
  run r = {scene, pieces, model, time_s, out, info, 1};
  rot_info_clear(info, rot_turning);
  rot_note_state(info, scene->linear.theta0_rad, scene->linear.omega0_rad_per_s);
  rot_step_rows(&stepping, &r, scene->linear.start_s, n, time_s, hooks, info);
  rot_axle_motor_error(scene, n, time_s, info);
  return info->status;
}
