#include "scene/axle/sweep.h"

#include <math.h>
#include <stdlib.h>

#include "ground/real.h"
#include "scene/axle/sweep_kernel.h"
#include "ground/parallel.h"
#include "ground/simd.h"

/* Rows between two polls: some ms. */
enum { LINEAR_PART = 2048, SCENE_PART = 16 };

static inline double larger(double x, double y) { return x > y ? x : y; } /* fmax() is a call */

/* ---- rows in closed form -------------------------------------------------------------------- */

typedef struct linear_frame {
  const rot_axle_sweep_rows *rows;
  const rot_axle_sweep_columns *out;
  const rot_torque_piece *pieces; /* from the piece of the start on */
  double start_n_m;               /* torque just after the start */
  int well_scaled;                /* 1: all knots are */
} linear_frame;

static int well_scaled(double x) { return rot_well_scaled(x, 1e40); }

typedef rot_axle_sweep_block block;
enum { BLOCK = ROT_AXLE_SWEEP_BLOCK };

static void pass_pieces(const linear_frame *frame, block *x) {
  const rot_torque_piece *piece = frame->pieces;
  const int simd = rot_simd_ok();
  double start_n_m = frame->start_n_m, last = x->end_s[0];
  for (size_t i = 1; i < BLOCK; i++) last = larger(last, x->end_s[i]);
  for (;; piece++, start_n_m = piece->start_n_m) {
    if (simd)
      rot_axle_sweep_pass_simd(x, piece, start_n_m);
    else
      pass_block(x, piece, start_n_m);
    if (last <= piece->end_s) return;
  }
}

/* ---- rows of any magnitude ------------------------------------------------------------------- */

static inline void note(block *x, size_t l, double time_s, double omega, double omega_error) {
  if (omega > x->omega_max[l]) {
    x->omega_max[l] = omega;
    x->omega_max_time_s[l] = time_s;
  }
  if (omega < x->omega_min[l]) x->omega_min[l] = omega;
  if (omega_error > x->worst_error[l]) x->worst_error[l] = omega_error;
}

static void put_row(const rot_axle_sweep_columns *out, size_t i, const block *x, size_t l,
                    rot_status status) {
  const int good = status == ROT_OK;
  const double speed = larger(x->omega_max[l], -x->omega_min[l]);
  const double of_theta = rot_relative_error(x->theta_error[l], x->theta_max[l]),
               of_omega = rot_relative_error(x->worst_error[l], speed);
  out->theta_rad[i] = good ? x->theta[l] : NAN;
  out->omega_rad_per_s[i] = good ? x->omega[l] : NAN;
  out->omega_max[i] = good ? x->omega_max[l] : NAN;
  out->omega_max_time_s[i] = good ? x->omega_max_time_s[l] : NAN;
  out->omega_min[i] = good ? x->omega_min[l] : NAN;
  out->speed_max[i] = good ? speed : NAN;
  out->error[i] = good ? larger(of_theta, of_omega) : NAN;
  out->status[i] = (int)status;
}

/* Extremum of omega inside the piece, as in scene/axle/sweep_kernel.h, for any numbers. */
static void step_turn(block *x, size_t l, const rot_axle_params *p, const rot_axle_state *from,
                      const rot_axle_state *to, const rot_torque_piece *piece) {
  const double a = rot_torque_in_piece(piece, from->time_s);
  const double b = rot_torque_in_piece(piece, to->time_s), s = to->time_s - from->time_s;
  const double excess = a - p->viscous_n_m_s * from->omega_rad_per_s,
               left = b - p->viscous_n_m_s * to->omega_rad_per_s;
  if (!((excess > 0.0 && left < 0.0) || (excess < 0.0 && left > 0.0))) return;
  double at = rot_product(2, (double[]){-excess, s}, b - a);
  const double z = rot_muldiv(p->viscous_n_m_s, at, p->inertia_kg_m2, NULL);
  if (z != 0.0) at *= log1p(z) / z;
  if (!(at > 0.0 && at < s)) return;
  const rot_axle_state turn = rot_axle_step(p, from, piece, from->time_s + at);
  note(x, l, turn.time_s, turn.omega_rad_per_s, turn.omega_error);
}

/* Row l through all pieces by rot_axle_step(). */
static rot_status step_pieces(const linear_frame *frame, double I, block *x, size_t l) {
  const double end_s = x->end_s[l], scale = x->scale[l];
  const rot_axle_params p = {.inertia_kg_m2 = I,
                             .viscous_n_m_s = x->c[l],
                             .start_s = x->time_s[l],
                             .theta0_rad = x->theta[l],
                             .omega0_rad_per_s = x->omega[l]};
  rot_axle_state state = rot_axle_start(&p);
  for (const rot_torque_piece *next = frame->pieces;; next++) {
    rot_torque_piece piece = *next;
    piece.start_n_m *= scale;
    piece.end_n_m *= scale;
    const double stop = piece.end_s < end_s ? piece.end_s : end_s;
    const rot_axle_state from = state;
    state = rot_axle_step(&p, &from, &piece, stop);
    if (!rot_axle_in_range(&state)) return ROT_ERANGE;
    if (piece.start_n_m != piece.end_n_m) step_turn(x, l, &p, &from, &state, &piece);
    note(x, l, stop, state.omega_rad_per_s, state.omega_error);
    if (fabs(state.theta_rad) > x->theta_max[l]) x->theta_max[l] = fabs(state.theta_rad);
    if (end_s <= piece.end_s) break;
  }
  x->theta[l] = state.theta_rad;
  x->omega[l] = state.omega_rad_per_s;
  x->theta_error[l] = state.theta_error;
  return ROT_OK;
}

/* A row => place l of the block, at its start. */
static void fill_place(block *b, size_t l, double I, double c, double scale, double start_s,
                       double end_s, double theta0, double w0) {
  b->c[l] = c;
  b->inverse[l] = 1.0 / I;
  b->lambda[l] = c / I;
  b->scale[l] = scale;
  b->end_s[l] = end_s;
  b->time_s[l] = b->omega_max_time_s[l] = start_s;
  b->theta[l] = theta0;
  b->omega[l] = b->omega_max[l] = b->omega_min[l] = w0;
  b->theta_error[l] = b->omega_error[l] = b->worst_error[l] = 0.0;
  b->theta_max[l] = fabs(theta0);
}

static void put_block(const linear_frame *frame, block *b, const size_t row[], size_t filled) {
  const double start_s = frame->rows->start_s;
  if (filled == 0) return;
  for (size_t l = filled; l < BLOCK; l++) { /* empty places: final time at the start */
    fill_place(b, l, 1.0, 0.0, 0.0, start_s, start_s, 0.0, 0.0);
  }
  pass_pieces(frame, b);
  for (size_t l = 0; l < filled; l++) put_row(frame->out, row[l], b, l, ROT_OK);
}

/* Rows first to last - 1: well-scaled ones in blocks, others one by one. */
static void linear_rows(const void *data, size_t first, size_t last) {
  const linear_frame *frame = data;
  const rot_axle_sweep_rows *rows = frame->rows;
  const double start_s = rows->start_s;
  block b;
  size_t row[BLOCK], filled = 0;
  for (size_t i = first; i < last; i++) {
    const double I = rot_at(rows->inertia_kg_m2, i), c = rot_at(rows->viscous_n_m_s, i);
    const double scale = rot_at(rows->torque_scale, i), end_s = rot_at(rows->time_s, i);
    const double w0 = rot_at(rows->omega0_rad_per_s, i), theta0 = rot_at(rows->theta0_rad, i);
    const int possible = I > 0.0 && end_s >= start_s && isfinite(I) && isfinite(c) &&
                         isfinite(scale) && isfinite(w0) && isfinite(theta0) && isfinite(end_s);
    fill_place(&b, filled, I, c, scale, start_s, end_s, theta0, w0);
    if (possible && frame->well_scaled && c >= 0.0 && well_scaled(I) && well_scaled(c) &&
        well_scaled(scale) && well_scaled(w0) && well_scaled(theta0) &&
        well_scaled(end_s - start_s)) {
      row[filled++] = i;
    } else {
      put_row(frame->out, i, &b, filled, possible ? step_pieces(frame, I, &b, filled) : ROT_EVALUE);
    }
    if (filled == BLOCK) {
      put_block(frame, &b, row, filled);
      filled = 0;
    }
  }
  put_block(frame, &b, row, filled);
}

/* Pieces of the torque once, then rows in parallel. */
rot_status rot_axle_sweep_linear(const rot_torque *torque, const rot_axle_sweep_rows *rows,
                                 int threads, const rot_axle_sweep_columns *out,
                                 const rot_hooks *hooks, rot_info *info) {
  const size_t k = rot_torque_find(torque, rows->start_s, 1), n = torque->n - k + 1;
  rot_torque_piece *pieces = malloc(n * sizeof *pieces);
  rot_info_clear(info, NULL);
  if (!pieces) return info->status = ROT_ENOMEM;
  linear_frame frame = {rows, out, pieces, 0.0, 1};
  for (size_t j = 0; j < n; j++) {
    pieces[j] = rot_torque_piece_at(torque, k + j);
    frame.well_scaled = frame.well_scaled && well_scaled(pieces[j].start_n_m) &&
                        well_scaled(pieces[j].end_n_m) &&
                        (pieces[j].start_n_m == pieces[j].end_n_m ||
                         well_scaled(pieces[j].end_s - pieces[j].start_s));
  }
  frame.start_n_m = rot_torque_in_piece(&pieces[0], rows->start_s);
  const rot_status status =
      rot_parallel_rows(linear_rows, &frame, rows->n, LINEAR_PART, threads, hooks, info);
  free(pieces);
  return status;
}

/* ---- rows by a model ------------------------------------------------------------------------ */

typedef struct scene_frame {
  rot_axle_model model;
  const rot_axle_scene *scene;
  const rot_axle_sweep_rows *rows;
  const rot_axle_sweep_friction *friction;
  const rot_axle_sweep_columns *out;
  int true_maximum;
} scene_frame;

/* Row i: scene with the numbers of the row, one run of the model. */
static rot_status run_scene(const scene_frame *frame, size_t i, double torque_n_m[], double row[7],
                            rot_info *info) {
  const rot_axle_sweep_rows *rows = frame->rows;
  const double scale = rot_at(rows->torque_scale, i), end_s = rot_at(rows->time_s, i);
  const rot_axle_columns to = {row, row + 1, row + 2, row + 3, row + 4, row + 5, row + 6};
  rot_axle_scene scene = *frame->scene;
  rot_axle_params *p = &scene.linear;
  p->inertia_kg_m2 = rot_at(rows->inertia_kg_m2, i);
  scene.viscous_n_m_s = rot_at(rows->viscous_n_m_s, i);
  p->viscous_n_m_s = scene.viscous_n_m_s + scene.motor_n_m_s;
  p->start_s = rows->start_s;
  p->theta0_rad = rot_at(rows->theta0_rad, i);
  p->omega0_rad_per_s = rot_at(rows->omega0_rad_per_s, i);
  scene.quadratic_n_m_s2 = rot_at(frame->friction->quadratic_n_m_s2, i);
  scene.coulomb_n_m = rot_at(frame->friction->coulomb_n_m, i);
  scene.static_n_m = rot_at(frame->friction->static_n_m, i);
  if (!(p->inertia_kg_m2 > 0.0 && isfinite(p->inertia_kg_m2) && isfinite(p->viscous_n_m_s) &&
        isfinite(scale) && isfinite(end_s) && end_s >= p->start_s && isfinite(p->theta0_rad) &&
        isfinite(p->omega0_rad_per_s) && isfinite(scene.quadratic_n_m_s2) &&
        isfinite(scene.static_n_m) && scene.quadratic_n_m_s2 >= 0.0 && scene.coulomb_n_m >= 0.0 &&
        scene.static_n_m >= scene.coulomb_n_m) ||
      (scale != 1.0 && (scene.n_terms > 0 || p->torque.call))) {
    return ROT_EVALUE;
  }
  for (size_t j = 0; j < p->torque.n; j++) torque_n_m[j] = scale * p->torque.torque_n_m[j];
  p->torque.torque_n_m = torque_n_m;
  p->torque.before_n_m *= scale;
  p->torque.after_n_m *= scale;
  return frame->model(&scene, 1, &end_s, &to, NULL, NULL, info);
}

/* Rows first to last - 1 by the model. */
static void scene_rows(const void *data, size_t first, size_t last) {
  const scene_frame *frame = data;
  const rot_axle_sweep_columns *out = frame->out;
  const size_t n = frame->scene->linear.torque.n;
  double *torque_n_m = malloc((n ? n : 1) * sizeof *torque_n_m);
  for (size_t i = first; i < last; i++) {
    double row[7] = {0.0};
    rot_info info;
    rot_info_clear(&info, NULL);
    const rot_status status = torque_n_m ? run_scene(frame, i, torque_n_m, row, &info) : ROT_ENOMEM;
    const int good = status == ROT_OK;
    out->theta_rad[i] = good ? row[0] : NAN;
    out->omega_rad_per_s[i] = good ? row[1] : NAN;
    out->speed_max[i] = good && frame->true_maximum ? info.measure[ROT_OMEGA].largest : NAN;
    out->omega_max[i] = good && frame->true_maximum ? info.measure[ROT_OMEGA].high : NAN;
    out->omega_min[i] = good && frame->true_maximum ? info.measure[ROT_OMEGA].low : NAN;
    out->omega_max_time_s[i] = NAN;
    out->error[i] = good ? rot_info_error(&info) : NAN;
    out->status[i] = (int)status;
  }
  free(torque_n_m);
}

rot_status rot_axle_sweep_scenes(rot_axle_model model, const rot_axle_scene *scene,
                                 const rot_axle_sweep_rows *rows,
                                 const rot_axle_sweep_friction *friction, int true_maximum,
                                 int threads, const rot_axle_sweep_columns *out,
                                 const rot_hooks *hooks, rot_info *info) {
  const scene_frame frame = {model, scene, rows, friction, out, true_maximum};
  return rot_parallel_rows(scene_rows, &frame, rows->n, SCENE_PART, threads, hooks, info);
}
