#include "scene/axle/linear.h"

#include <math.h>

#include "scene/axle/grid.h"
#include "scene/axle/motor.h"
#include "engine/stepping.h"
#include "maths/phi.h"
#include "ground/real.h"

/* ---- free spin ------------------------------------------------------------------------------ */

typedef struct row_run {
  const rot_axle_params *p;
  const double *time_s;
  const rot_axle_columns *out;
  rot_info *info;
  rot_axle_state base;
  rot_torque_piece piece;
  size_t index;     /* of the piece */
  int forward;      /* 1: forward in time */
  int in_lanes;     /* 1: well-scaled numbers, several rows at a time */
  int on_grids;     /* 1: evenly spaced rows by a table */
  double last_s[2]; /* times of the last rows, backward and forward */
  rot_axle_grid *grid;
} row_run;

static rot_status free_rows(void *model, size_t first, size_t last, size_t *end) {
  const row_run *run = model;
  const rot_axle_params *p = run->p;
  const double omega = p->omega0_rad_per_s;
  for (size_t i = first; i < last; i++) {
    double turned = omega * (run->time_s[i] - p->start_s), theta = p->theta0_rad + turned;
    *end = i;
    if (!isfinite(theta)) return ROT_ERANGE;
    rot_axle_row(p, run->out, i, theta, omega, 0.0);
    /* Three roundings: time difference, product, sum. */
    rot_note_row(run->info, theta, omega, ROT_EPS * (2.0 * fabs(turned) + fabs(theta)), 0.0);
  }
  *end = last;
  return ROT_OK;
}

rot_status rot_axle_free(const rot_axle_params *p, size_t n, const double time_s[],
                         const rot_axle_columns *out, const rot_hooks *hooks, rot_info *info) {
  static const rot_stepping stepping = {.write_rows = free_rows};
  row_run run = {.p = p, .time_s = time_s, .out = out, .info = info};
  rot_info_clear(info, rot_turning);
  rot_note_state(info, p->theta0_rad, p->omega0_rad_per_s);
  info->steps = n > 0;
  return rot_step_rows(&stepping, &run, p->start_s, n, time_s, hooks, info);
}

/* ---- rows inside one piece ------------------------------------------------------------------ */

/* Well-scaled numbers need no scaling of products: several rows at a time, 25 ns per row instead of
 * 150 to 400. */
static int well_scaled(double x) { return rot_well_scaled(x, 1e60); }

static rot_status finish_row(const row_run *run, size_t i, const rot_axle_state *state) {
  if (!rot_axle_in_range(state)) return ROT_ERANGE;
  rot_axle_row(run->p, run->out, i, state->theta_rad, state->omega_rad_per_s,
               rot_torque_at(&run->p->torque, state->time_s));
  rot_note_row(run->info, state->theta_rad, state->omega_rad_per_s, state->theta_error,
               state->omega_error);
  return ROT_OK;
}

static rot_status one_row(const row_run *run, size_t i) {
  rot_axle_state state = rot_axle_step(run->p, &run->base, &run->piece, run->time_s[i]);
  return finish_row(run, i, &state);
}

static double quick_torque(const rot_torque_piece *piece, double t) {
  const double a = piece->start_n_m, b = piece->end_n_m;
  if (a == b) return a;
  if (a * b < 0.0) return rot_torque_in_piece(piece, t);
  return (a * (piece->end_s - t) + b * (t - piece->start_s)) / (piece->end_s - piece->start_s);
}

/* z = c s/I of a row with its residual, from s with its own; one division. */
static double quick_z(const rot_axle_params *p, double s, double s_lo, double *s_over_I,
                      double *z_lo) {
  const double I = p->inertia_kg_m2, c = p->viscous_n_m_s;
  double cs_lo, cs = rot_two_prod(c, s, &cs_lo);
  *s_over_I = s / I;
  const double z = c * *s_over_I;
  *z_lo = s != 0.0 ? (fma(-z, I, cs) + (cs_lo + c * s_lo)) * (*s_over_I / s) : 0.0;
  return z;
}

/* ROT_LANES rows at once; if fewer, the last one is repeated. */
static void lane_rows(const row_run *run, const size_t row[ROT_LANES], double base_torque) {
  const rot_axle_state *base = &run->base;
  const double w0 = base->omega_rad_per_s, rounding = rot_axle_rounding(run->p);
  double s[ROT_LANES], u[ROT_LANES], z[ROT_LANES], z_lo[ROT_LANES];
  for (int l = 0; l < ROT_LANES; l++) {
    double s_lo;
    s[l] = rot_two_sum(run->time_s[row[l]], -base->time_s, &s_lo);
    z[l] = quick_z(run->p, s[l], s_lo, &u[l], &z_lo[l]);
  }
  rot_phi_lanes phi;
  rot_phi_in_lanes(z, z_lo, &phi);
  for (int l = 0; l < ROT_LANES; l++) {
    const double b = quick_torque(&run->piece, run->time_s[row[l]]);
    const double va = u[l] * base_torque, vb = u[l] * b;
    const double p23 = phi.phi2[l] - phi.phi3[l];
    const double from_w0 = w0 * phi.phi0[l], driven = va * phi.g1[l] + vb * phi.phi2[l];
    const double turned = s[l] * (w0 * phi.phi1[l] + (va * p23 + vb * phi.phi3[l]));
    const double omega = from_w0 + (driven + base->omega_lo * phi.phi0[l]);
    const double theta = base->theta_rad + (turned + base->theta_lo);
    rot_axle_row(run->p, run->out, row[l], theta, omega, b);
    rot_note_row(run->info, theta, omega,
                 base->theta_error +
                     fabs(s[l]) * (base->omega_error * phi.phi1[l] +
                                   rounding * (fabs(w0) * phi.phi1[l] + fabs(va) * p23 +
                                               fabs(vb) * phi.phi3[l])) +
                     ROT_EPS * fabs(theta),
                 base->omega_error * phi.phi0[l] +
                     rounding * (fabs(from_w0) + fabs(va) * phi.g1[l] + fabs(vb) * phi.phi2[l]));
  }
}

/* Row without torque: omega0 phi0, s omega0 phi1. */
static void coasting_row(const row_run *run, size_t i) {
  const rot_axle_state *base = &run->base;
  const double w0 = base->omega_rad_per_s, rounding = rot_axle_rounding(run->p);
  double s_lo, s = rot_two_sum(run->time_s[i], -base->time_s, &s_lo), u, z_lo;
  const double z = quick_z(run->p, s, s_lo, &u, &z_lo);
  const double gone = z < 0.5 ? -expm1(-z) : 1.0 - exp(-z); /* exp(-z) is small for large z */
  double phi0 = z < 0.5 ? 1.0 - gone : exp(-z);
  const double phi1 = z == 0.0 ? 1.0 : gone / z;
  phi0 -= phi0 * z_lo;
  const double omega = w0 * phi0 + base->omega_lo * phi0, turned = s * w0 * phi1;
  const double theta = base->theta_rad + (turned + base->theta_lo);
  rot_axle_row(run->p, run->out, i, theta, omega, 0.0);
  rot_note_row(run->info, theta, omega,
               base->theta_error + base->omega_error * fabs(s) * phi1 + rounding * fabs(turned) +
                   ROT_EPS * fabs(theta),
               base->omega_error * phi0 + rounding * fabs(omega));
}

/* Row of a settled motion, z >= 3: rot_axle_step() for well-scaled numbers. */
static void settled_row(const row_run *run, size_t i, double base_torque) {
  const double I = run->p->inertia_kg_m2, c = run->p->viscous_n_m_s;
  const rot_axle_state *base = &run->base;
  const double t = run->time_s[i], w0 = base->omega_rad_per_s, rounding = rot_axle_rounding(run->p);
  const double b = quick_torque(&run->piece, t);
  double s_lo, s = rot_two_sum(t, -base->time_s, &s_lo), u, z_lo;
  const double z = quick_z(run->p, s, s_lo, &u, &z_lo);
  double phi0 = exp(-z), settled = 1.0 - phi0;
  phi0 -= phi0 * z_lo;
  const double phi1 = settled / z, phi2 = (1.0 - phi1) / z;
  const double from_w0 = w0 * phi0, from_a = base_torque / c * (phi1 - phi0),
               from_b = b / c * (1.0 - phi1);
  const double turned0 = w0 * settled * (I / c),
               turned_a = base_torque / c * s * (0.5 - phi1 + phi2),
               turned_b = b / c * s * (0.5 - phi2);
  const double omega = from_w0 + (from_a + from_b),
               theta = base->theta_rad + (turned0 + (turned_a + turned_b) + base->theta_lo);
  rot_axle_row(run->p, run->out, i, theta, omega, b);
  rot_note_row(run->info, theta, omega,
               base->theta_error + base->omega_error * (I / c) +
                   rounding * (fabs(turned0) + fabs(turned_a) + fabs(turned_b)) +
                   ROT_EPS * fabs(theta),
               base->omega_error * phi0 + rounding * (fabs(from_w0) + fabs(from_a) + fabs(from_b)));
}

/* Rows of an even grid from row i on; returns their number, moves the base. */
static size_t grid_rows(row_run *run, size_t i, size_t end) {
  const rot_axle_columns out = rot_axle_columns_from(run->out, i);
  return rot_axle_grid_rows(run->grid, run->p, &run->base, &run->piece, end - i, run->time_s + i,
                            &out, run->info);
}

/* Rows queued for the lanes. */
typedef struct lane_queue {
  size_t row[ROT_LANES];
  int filled;
} lane_queue;

static void flush_lanes(const row_run *run, lane_queue *queue, double base_torque) {
  if (queue->filled == 0) return;
  for (int l = queue->filled; l < ROT_LANES; l++) queue->row[l] = queue->row[queue->filled - 1];
  lane_rows(run, queue->row, base_torque);
  queue->filled = 0;
}

/* Rows i to end - 1, all in the present piece and beyond its base. Well-scaled numbers cannot
 * fail. */
static rot_status rows_in_piece(void *model, size_t i, size_t end, size_t *good) {
  row_run *run = model;
  rot_status status = ROT_OK;
  *good = end;
  if (!run->in_lanes) {
    for (; i < end && status == ROT_OK; i++) status = one_row(run, i);
    if (status != ROT_OK) *good = i - 1;
    return status;
  }
  const double c = run->p->viscous_n_m_s, I = run->p->inertia_kg_m2;
  const int coasting = run->piece.start_n_m == 0.0 && run->piece.end_n_m == 0.0;
  double base_torque = quick_torque(&run->piece, run->base.time_s);
  lane_queue queue = {{0}, 0};
  const int on_grids = run->on_grids && run->forward;
  int even = on_grids;
  for (; i < end && status == ROT_OK; i++) {
    const double t = run->time_s[i];
    /* At a knot the torque column has the value after a jump; a tiny time over the inertia may be
     * out of range: one_row() handles both. */
    if (fabs(t - run->base.time_s) < 1e-60 || t == run->piece.start_s || t == run->piece.end_s) {
      status = one_row(run, i);
      even = on_grids;
      continue;
    }
    if (even) {
      flush_lanes(run, &queue, base_torque);
      const size_t done = grid_rows(run, i, end);
      even = done > 0;
      base_torque = quick_torque(&run->piece, run->base.time_s);
      if (even) {
        i += done - 1;
        continue;
      }
    }
    if (coasting) {
      coasting_row(run, i);
    } else if (c * (t - run->base.time_s) >= 3.0 * I) {
      settled_row(run, i, base_torque);
    } else {
      queue.row[queue.filled++] = i;
      if (queue.filled == ROT_LANES) flush_lanes(run, &queue, base_torque);
    }
  }
  flush_lanes(run, &queue, base_torque);
  return status;
}

/* ---- time stepping -------------------------------------------------------------------------- */

static void enter_piece(row_run *run) {
  const rot_axle_params *p = run->p;
  const rot_torque_piece *piece = &run->piece;
  run->piece = rot_torque_piece_at(&p->torque, run->index);
  const double end_s =
      run->forward ? fmin(piece->end_s, run->last_s[1]) : fmax(piece->start_s, run->last_s[0]);
  run->in_lanes =
      well_scaled(p->inertia_kg_m2) && well_scaled(p->viscous_n_m_s) &&
      well_scaled(run->base.omega_rad_per_s) && well_scaled(run->base.theta_rad) &&
      well_scaled(piece->start_n_m) && well_scaled(piece->end_n_m) &&
      well_scaled(end_s - run->base.time_s) &&
      (piece->start_n_m == piece->end_n_m || well_scaled(piece->end_s - piece->start_s)) &&
      (run->forward ? p->viscous_n_m_s >= 0.0 : p->viscous_n_m_s == 0.0);
  if (run->in_lanes && run->on_grids && run->forward) rot_axle_grid_enter(run->grid, p, piece);
}

static rot_status restart(void *model, int forward) {
  row_run *run = model;
  run->forward = forward;
  run->index = rot_torque_find(&run->p->torque, run->p->start_s, forward);
  run->base = rot_axle_start(run->p);
  enter_piece(run);
  return ROT_OK;
}

static int holds(const void *model, double time_s) {
  const row_run *run = model;
  return run->forward ? time_s < run->piece.end_s : time_s > run->piece.start_s;
}

static rot_status next_piece(void *model, double *end_s) {
  row_run *run = model;
  *end_s = run->forward ? run->piece.end_s : run->piece.start_s;
  run->base = run->in_lanes && run->grid->step_s > 0.0
                  ? rot_axle_grid_step(run->grid, run->p, &run->base, &run->piece, *end_s)
                  : rot_axle_step(run->p, &run->base, &run->piece, *end_s);
  if (!rot_axle_in_range(&run->base)) return ROT_ERANGE;
  rot_note_state(run->info, run->base.theta_rad, run->base.omega_rad_per_s);
  run->index += run->forward ? 1 : (size_t)-1;
  enter_piece(run);
  return ROT_OK;
}

static rot_status linear(const rot_axle_params *p, size_t n, const double time_s[], int fast,
                         const rot_axle_columns *out, const rot_hooks *hooks, rot_info *info) {
  static const rot_stepping stepping = {restart, holds, next_piece, NULL, rows_in_piece};
  rot_axle_grid grid;
  row_run run = {
      .p = p, .time_s = time_s, .out = out, .info = info, .on_grids = fast, .grid = &grid};
  if (n > 0) {
    run.last_s[0] = time_s[0];
    run.last_s[1] = time_s[n - 1];
  }
  rot_axle_grid_begin(&grid);
  rot_info_clear(info, rot_turning);
  rot_note_state(info, p->theta0_rad, p->omega0_rad_per_s);
  return rot_step_rows(&stepping, &run, p->start_s, n, time_s, hooks, info);
}

rot_status rot_axle_linear(const rot_axle_params *p, size_t n, const double time_s[],
                           const rot_axle_columns *out, const rot_hooks *hooks, rot_info *info) {
  return linear(p, n, time_s, 0, out, hooks, info);
}

rot_status rot_axle_linear_fast(const rot_axle_params *p, size_t n, const double time_s[],
                                const rot_axle_columns *out, const rot_hooks *hooks,
                                rot_info *info) {
  return linear(p, n, time_s, 1, out, hooks, info);
}

rot_status rot_axle_free_scene(const rot_axle_scene *scene, size_t n, const double time_s[],
                               const rot_axle_columns *out, rot_events *events,
                               const rot_hooks *hooks, rot_info *info) {
  (void)events; /* none occur */
  return rot_axle_free(&scene->linear, n, time_s, out, hooks, info);
}

rot_status rot_axle_linear_scene(const rot_axle_scene *scene, size_t n, const double time_s[],
                                 const rot_axle_columns *out, rot_events *events,
                                 const rot_hooks *hooks, rot_info *info) {
  (void)events;
  rot_axle_linear_fast(&scene->linear, n, time_s, out, hooks, info);
  rot_axle_motor_columns(scene, info->rows_done, out);
  rot_axle_motor_error(scene, n, time_s, info);
  return info->status;
}
