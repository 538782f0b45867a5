#include "rot_axle_march.h"

#include <math.h>

enum { STEPS_PER_POLL = 4096 };

typedef struct marching {
  const rot_axle_scene *scene;
  const rot_march *march;
  size_t n;
  const double *time_s;
  const rot_axle_columns *out;
  const rot_hooks *hooks;
  rot_info *info;
  size_t since_poll;
} marching;

static int is_finite(const rot_march_state *state) {
  return isfinite(state->theta_rad) && isfinite(state->omega_rad_per_s);
}

static rot_status now_and_then(marching *run, size_t i) {
  if (++run->since_poll < STEPS_PER_POLL) return ROT_OK;
  run->since_poll = 0;
  return rot_poll(run->hooks, (double)i / (double)run->n);
}

static rot_status one_row(const marching *run, size_t i) {
  const double t = run->time_s[i];
  rot_march_state state;
  run->march->state_at(run->march->model, t, &state);
  run->info->time_s = t;
  if (!is_finite(&state)) return ROT_ERANGE;
  rot_axle_scene_row(
      run->scene, run->out, i, t, state.theta_rad, state.omega_rad_per_s,
      rot_axle_scene_applied(run->scene, t, state.theta_rad, 0.0, state.omega_rad_per_s), 0);
  rot_note_row(run->info, state.theta_rad, state.omega_rad_per_s, state.theta_error,
               state.omega_error);
  return ROT_OK;
}

static rot_status to_next_piece(const marching *run, double end) {
  rot_march_state state;
  run->march->next_piece(run->march->model, &state);
  run->info->steps++;
  run->info->time_s = end;
  if (!is_finite(&state)) return ROT_ERANGE;
  rot_note_state(run->info, state.theta_rad, state.omega_rad_per_s);
  return ROT_OK;
}

/* `count` rows, the first of them row i; onward or back through the rows. */
static rot_status one_way(marching *run, size_t i, size_t count, int forward) {
  const rot_march *march = run->march;
  rot_status status = ROT_OK;
  if (count == 0) return ROT_OK;
  march->restart(march->model, forward);
  run->info->steps++;
  while (count > 0 && status == ROT_OK) {
    const double end = march->piece_end(march->model), t = run->time_s[i];
    if (forward ? t >= end : t <= end) {
      status = to_next_piece(run, end);
    } else {
      status = one_row(run, i);
      if (status != ROT_OK) break;
      if (forward) run->info->rows_done = i + 1; /* backward, the first rows come last */
      i = forward ? i + 1 : i - 1;
      count--;
    }
    if (status == ROT_OK) status = now_and_then(run, i);
  }
  return status;
}

rot_status rot_axle_march(const rot_axle_scene *scene, const rot_march *march, size_t n,
                          const double time_s[], const rot_axle_columns *out,
                          const rot_hooks *hooks, rot_info *info) {
  marching run = {scene, march, n, time_s, out, hooks, info, 0};
  size_t before = 0, hi = n;
  while (before < hi) {
    const size_t mid = before + (hi - before) / 2;
    if (time_s[mid] < scene->linear.start_s) {
      before = mid + 1;
    } else {
      hi = mid;
    }
  }
  rot_info_clear(info, rot_turning);
  rot_note_state(info, scene->linear.theta0_rad, scene->linear.omega0_rad_per_s);
  info->status = one_way(&run, before - 1, before, 0);
  if (info->status == ROT_OK) {
    info->rows_done = before;
    info->status = one_way(&run, before, n - before, 1);
  }
  return info->status;
}
