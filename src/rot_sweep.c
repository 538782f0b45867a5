#include "rot_sweep.h"

#include <math.h>
#include <stdlib.h>

#include "rot_pair.h"
#include "rot_real.h"

#ifdef _OPENMP
#include <omp.h>
#endif

/* Rows between two polls: some milliseconds. */
enum { LINEAR_CHUNK = 65536, SCENE_CHUNK = 512, PARTS = 32 }; /* a thread takes part by part */

/* ---- sharing out ---------------------------------------------------------------------------- */

int rot_sweep_threads(void) {
#ifdef _OPENMP
  const int most = omp_get_max_threads(), limit = omp_get_thread_limit();
  return most < limit ? most : limit;
#else
  return 1;
#endif
}

/* Rows first .. last-1 in the given frame. */
typedef void (*row_worker)(const void *frame, size_t first, size_t last);

static void share_out(row_worker work, const void *frame, size_t first, size_t last, size_t part,
                      int threads) {
#ifdef _OPENMP
  if (threads > 1) {
    const int parts = (int)((last - first + part - 1) / part);
#pragma omp parallel for num_threads(threads) schedule(dynamic, 1)
    for (int i = 0; i < parts; i++) {
      const size_t from = first + (size_t)i * part;
      work(frame, from, last - from < part ? last : from + part);
    }
    return;
  }
#endif
  (void)part;
  (void)threads;
  work(frame, first, last);
}

/* Only this thread polls: the hooks may speak to R. */
static rot_status sweep(row_worker work, const void *frame, size_t n, size_t chunk, int threads,
                        const rot_hooks *hooks, rot_info *info) {
  const int most = rot_sweep_threads();
  if (threads < 1 || threads > most) threads = most;
  rot_info_clear(info);
  for (size_t first = 0; first < n && info->status == ROT_OK;) {
    const size_t last = n - first < chunk ? n : first + chunk;
    share_out(work, frame, first, last, chunk / PARTS, threads);
    info->rows_done = first = last;
    info->status = rot_poll(hooks, (double)last / (double)n);
  }
  return info->status;
}

/* ---- weights -------------------------------------------------------------------------------- */

static inline double larger(double x, double y) { return x > y ? x : y; } /* fmax() is a call */

/* phi0, phi1, g1, phi2, phi3 of -z for two steps. */
typedef struct weights {
  rot_pair start, reach, near, far, last;
} weights;

/* 0 <= z <= 1, in strands: what follows the last term is below 2^-54 of the first. */
ROT_INLINE rot_pair phi3_below_1(rot_pair z) {
#define C(x) ROT_BOTH(1 / x)
  const rot_pair zz = z * z, z4 = zz * zz, z8 = z4 * z4;
  const rot_pair p =
      (C(6.0) + zz * C(120.0)) + z4 * (C(5040.0) + zz * C(362880.0)) +
      z8 * ((C(39916800.0) + zz * C(6227020800.0)) +
            z4 * ((C(1307674368000.0) + zz * C(355687428096000.0)) + z4 * C(121645100408832000.0)));
  const rot_pair q = (C(24.0) + zz * C(720.0)) + z4 * (C(40320.0) + zz * C(3628800.0)) +
                     z8 * ((C(479001600.0) + zz * C(87178291200.0)) +
                           z4 * (C(20922789888000.0) + zz * C(6402373705728000.0)));
#undef C
  return p - z * q;
}

/* Downward from the series below z = 1. */
ROT_INLINE weights weights_below(rot_pair z) {
  weights w;
  w.last = phi3_below_1(z);
  w.far = ROT_BOTH(0.5) - z * w.last;
  w.reach = ROT_BOTH(1.0) - z * w.far;
  w.near = w.reach - w.far;
  w.start = ROT_BOTH(1.0) - z * w.reach;
  return w;
}

/* Upward from the exponential above, where that loses less than a factor of ten. */
ROT_INLINE weights weights_above(rot_pair z) {
  const rot_pair one = ROT_BOTH(1.0), most = ROT_BOTH(700.0), each = one / z;
  weights w;
  w.start = rot_pair_decay(rot_pair_if_more(z, most, most, z));
  w.reach = (one - w.start) * each;
  w.near = (w.reach - w.start) * each;
  w.far = (one - w.reach) * each;
  w.last = (ROT_BOTH(0.5) - w.far) * each;
  return w;
}

/* Each by its own z: no row depends on its neighbour. */
ROT_INLINE weights weights_of(rot_pair z) {
  const rot_pair one = ROT_BOTH(1.0);
  double each[ROT_PAIR];
  int above = 0;
  rot_store(each, z);
  for (int i = 0; i < ROT_PAIR; i++) above += each[i] > 1.0;
  if (above == 0) return weights_below(z);
  if (above == ROT_PAIR) return weights_above(z);
  const weights low = weights_below(rot_pair_if_more(z, one, one, z));
  const weights high = weights_above(rot_pair_if_more(z, one, z, one));
  weights w;
  w.start = rot_pair_if_more(z, one, high.start, low.start);
  w.reach = rot_pair_if_more(z, one, high.reach, low.reach);
  w.near = rot_pair_if_more(z, one, high.near, low.near);
  w.far = rot_pair_if_more(z, one, high.far, low.far);
  w.last = rot_pair_if_more(z, one, high.last, low.last);
  return w;
}

/* ---- axles side by side --------------------------------------------------------------------- */

enum { BLOCK = 32 };

typedef struct block {
  double c[BLOCK], inverse[BLOCK], lambda[BLOCK], scale[BLOCK], end_s[BLOCK]; /* 1/I, c/I */
  double time_s[BLOCK], theta[BLOCK], omega[BLOCK], theta_error[BLOCK], omega_error[BLOCK];
  double omega_max[BLOCK], omega_max_time_s[BLOCK], omega_min[BLOCK], theta_max[BLOCK],
      worst_error[BLOCK];
  double s[BLOCK], stop_s[BLOCK], a[BLOCK], b[BLOCK], omega_end[BLOCK]; /* of the step at hand */
} block;

/* Where omega turns inside a piece, its acceleration I A = excess at the start:
 * exp(c s/I) = 1 - (c/I) excess/slope. */
static double turning_s(double excess, double slope, double lambda) {
  const double straight = -excess / slope, x = lambda * straight;
  return x != 0.0 ? straight * (log1p(x) / x) : straight;
}

static void note_turn(block *x, size_t i) {
  const double a = x->a[i], b = x->b[i], c = x->c[i], s = x->s[i], w0 = x->omega[i];
  const double excess = a - c * w0, left = b - c * x->omega_end[i];
  if (!((excess > 0.0 && left < 0.0) || (excess < 0.0 && left > 0.0))) return;
  const double at = turning_s(excess, (b - a) / s, x->lambda[i]), z = x->lambda[i] * at;
  if (!(at > 0.0 && at < s)) return;
  const double torque = a + (b - a) * (at / s), most = larger(fabs(a), fabs(b));
  double omega, error = x->omega_error[i];
  if (z >= 1.0) {
    omega = torque / c; /* nothing is left over for acceleration */
    error += 12.0 * ROT_EPS * (most / c + fabs(w0));
  } else {
    const weights w = weights_of(ROT_BOTH(z));
    double start[ROT_PAIR], near[ROT_PAIR], far[ROT_PAIR];
    const double v = at * x->inverse[i];
    rot_store(start, w.start);
    rot_store(near, w.near);
    rot_store(far, w.far);
    omega = w0 * start[0] + v * (a * near[0] + torque * far[0]);
    error += 16.0 * ROT_EPS * (fabs(w0) + v * most);
  }
  /* The end of the step was noted already; the turn is beyond it, whatever rounding says. */
  if (omega > x->omega_max[i] || (excess > 0.0 && x->omega_max_time_s[i] >= x->stop_s[i])) {
    x->omega_max[i] = larger(omega, x->omega_max[i]);
    x->omega_max_time_s[i] = x->time_s[i] + at;
  }
  if (omega < x->omega_min[i]) x->omega_min[i] = omega;
  if (error > x->worst_error[i]) x->worst_error[i] = error;
}

/* Two steps at a time; `most` bounds the torque in the piece, unscaled. The weights of omega are
 * good to 10 units at z = 1, where they are worst, those of theta to 20; with products, sums, the
 * rounding of z and a torque inside the piece 16 + 3 z and 24. g1 + phi2 = phi1. A step of no length changes nothing.
 */
static void pass(block *x, double most_n_m) {
  const rot_pair eps = ROT_BOTH(ROT_EPS), none = ROT_BOTH(0.0);
  for (size_t i = 0; i < BLOCK; i += ROT_PAIR) {
    const rot_pair s = rot_load(x->s + i), a = rot_load(x->a + i), b = rot_load(x->b + i);
    const rot_pair w0 = rot_load(x->omega + i), z = rot_load(x->lambda + i) * s;
    const rot_pair v = s * rot_load(x->inverse + i);
    const weights w = weights_of(z);
    const rot_pair rest = w.far - w.last;
    const rot_pair w1 = w0 * w.start + v * (a * w.near + b * w.far);
    const rot_pair theta =
        rot_load(x->theta + i) + s * (w0 * w.reach + v * (a * rest + b * w.last));
    const rot_pair most = ROT_BOTH(most_n_m) * rot_pair_abs(rot_load(x->scale + i));
    const rot_pair size = rot_pair_abs(w0), unit = rot_pair_if_more(s, none, eps, none);
    const rot_pair before = rot_load(x->omega_error + i);
    const rot_pair error =
        before * w.start + unit * ((ROT_BOTH(16.0) + ROT_BOTH(3.0) * z) * size * w.start +
                                   ROT_BOTH(16.0) * v * most * w.reach);
    const rot_pair top = rot_load(x->omega_max + i), low = rot_load(x->omega_min + i);
    rot_store(x->omega_end + i, w1);
    rot_store(x->theta + i, theta);
    rot_store(x->theta_error + i,
              rot_load(x->theta_error + i) +
                  (s * w.reach * before +
                   unit * (ROT_BOTH(24.0) * s * (size * w.reach + v * most * w.far) +
                           rot_pair_abs(theta))));
    rot_store(x->theta_max + i, rot_pair_max(rot_load(x->theta_max + i), rot_pair_abs(theta)));
    rot_store(x->worst_error + i, rot_pair_max(rot_load(x->worst_error + i), error));
    rot_store(x->omega_max_time_s + i, rot_pair_if_more(w1, top, rot_load(x->stop_s + i),
                                                        rot_load(x->omega_max_time_s + i)));
    rot_store(x->omega_max + i, rot_pair_max(top, w1));
    rot_store(x->omega_min + i, rot_pair_if_more(low, w1, w1, low));
    rot_store(x->omega_error + i, error);
  }
}

/* ---- rows in closed form -------------------------------------------------------------------- */

typedef struct linear_frame {
  const rot_sweep_rows *rows;
  const rot_sweep_columns *out;
  const rot_torque *torque;
  const rot_torque_piece *pieces; /* from the one that holds the start */
  double start_n_m;               /* just after the start */
  int tame;                       /* all knots are */
} linear_frame;

/* Products of a few such numbers stay far from overflow and underflow. */
static int tame(double x) {
  x = fabs(x);
  return x == 0.0 || (x > 1e-40 && x < 1e40);
}

static double relative(double error, double largest) {
  return error > 0.0 ? (largest > 0.0 ? error / largest : 1.0) : 0.0;
}

/* The torque of a piece at a time inside it. */
static double inside(const rot_torque_piece *piece, double t) {
  const double a = piece->start_n_m, b = piece->end_n_m;
  if (a == b) return a;
  return (a * (piece->end_s - t) + b * (t - piece->start_s)) / (piece->end_s - piece->start_s);
}

static void tame_way(const linear_frame *frame, block *x) {
  const rot_torque_piece *piece = frame->pieces;
  double a = frame->start_n_m, last = x->end_s[0];
  for (size_t i = 1; i < BLOCK; i++) last = larger(last, x->end_s[i]);
  for (;; piece++, a = piece->start_n_m) {
    for (size_t i = 0; i < BLOCK; i++) {
      const double end = x->end_s[i], stop = piece->end_s < end ? piece->end_s : end;
      const double s = stop - x->time_s[i]; /* 0 where the row has ended */
      x->s[i] = s;
      x->stop_s[i] = stop;
      x->a[i] = a * x->scale[i];
      x->b[i] = piece->end_n_m * x->scale[i];
      if (stop < piece->end_s && s > 0.0) x->b[i] = inside(piece, stop) * x->scale[i];
    }
    pass(x, larger(fabs(piece->start_n_m), fabs(piece->end_n_m)));
    for (size_t i = 0; i < BLOCK; i++) {
      if (x->a[i] != x->b[i] && x->s[i] > 0.0) note_turn(x, i);
      x->omega[i] = x->omega_end[i];
      x->time_s[i] = x->stop_s[i];
    }
    if (last <= piece->end_s) return;
  }
}

/* ---- a row that needs care ------------------------------------------------------------------ */

typedef struct axle {
  double I, c, time_s, theta, omega, theta_error;
  double omega_max, omega_max_time_s, omega_min, theta_max, worst_error; /* on the way; of omega */
} axle;

static inline void note(axle *x, double time_s, double omega) {
  if (omega > x->omega_max) {
    x->omega_max = omega;
    x->omega_max_time_s = time_s;
  }
  if (omega < x->omega_min) x->omega_min = omega;
}

static void put_row(const rot_sweep_columns *out, size_t i, const axle *x, rot_status status) {
  const int good = status == ROT_OK;
  const double speed = larger(x->omega_max, -x->omega_min);
  const double of_theta = relative(x->theta_error, x->theta_max),
               of_omega = relative(x->worst_error, speed);
  out->theta_rad[i] = good ? x->theta : NAN;
  out->omega_rad_per_s[i] = good ? x->omega : NAN;
  out->omega_max[i] = good ? x->omega_max : NAN;
  out->omega_max_time_s[i] = good ? x->omega_max_time_s : NAN;
  out->omega_min[i] = good ? x->omega_min : NAN;
  out->speed_max[i] = good ? speed : NAN;
  out->error[i] = good ? larger(of_theta, of_omega) : NAN;
  out->status[i] = (int)status;
}

/* As above, for any numbers. */
static void careful_turn(axle *x, const rot_axle_params *p, const rot_axle_state *from,
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
  note(x, turn.time_s, turn.omega_rad_per_s);
  if (turn.omega_error > x->worst_error) x->worst_error = turn.omega_error;
}

static rot_status careful_way(const linear_frame *frame, axle *x, double end_s, double scale) {
  rot_axle_params p = {x->I,     x->c,     x->time_s,
                       x->theta, x->omega, {0, NULL, NULL, 0, 0, NULL, NULL}};
  rot_axle_state state = rot_axle_start(&p);
  for (const rot_torque_piece *next = frame->pieces;; next++) {
    rot_torque_piece piece = *next;
    piece.start_n_m *= scale;
    piece.end_n_m *= scale;
    const double stop = piece.end_s < end_s ? piece.end_s : end_s;
    const rot_axle_state from = state;
    state = rot_axle_step(&p, &from, &piece, stop);
    if (!(isfinite(state.theta_rad) && isfinite(state.omega_rad_per_s))) return ROT_ERANGE;
    if (piece.start_n_m != piece.end_n_m) careful_turn(x, &p, &from, &state, &piece);
    note(x, stop, state.omega_rad_per_s);
    if (state.omega_error > x->worst_error) x->worst_error = state.omega_error;
    if (fabs(state.theta_rad) > x->theta_max) x->theta_max = fabs(state.theta_rad);
    if (end_s <= piece.end_s) break;
  }
  x->theta = state.theta_rad;
  x->omega = state.omega_rad_per_s;
  x->theta_error = state.theta_error;
  return ROT_OK;
}

static rot_status start_row(const linear_frame *frame, size_t i, axle *x, double *scale,
                            double *end_s, int *fast) {
  const rot_sweep_rows *rows = frame->rows;
  const double I = rot_at(rows->inertia_kg_m2, i), c = rot_at(rows->viscous_n_m_s, i),
               w0 = rot_at(rows->omega0_rad_per_s, i), theta0 = rot_at(rows->theta0_rad, i),
               start_s = rows->start_s;
  const axle start = {I, c, start_s, theta0, w0, 0.0, w0, start_s, w0, fabs(theta0), 0.0};
  *x = start;
  *scale = rot_at(rows->torque_scale, i);
  *end_s = rot_at(rows->time_s, i);
  *fast = frame->tame && c >= 0.0 && tame(I) && tame(c) && tame(*scale) && tame(w0) &&
          tame(theta0) && tame(*end_s - start_s);
  return I > 0.0 && *end_s >= start_s && isfinite(I) && isfinite(c) && isfinite(*scale) &&
                 isfinite(w0) && isfinite(theta0) && isfinite(*end_s)
             ? ROT_OK
             : ROT_EVALUE;
}

static void fill_place(block *b, size_t l, const axle *x, double scale, double end_s) {
  b->c[l] = x->c;
  b->inverse[l] = 1.0 / x->I;
  b->lambda[l] = x->c / x->I;
  b->scale[l] = scale;
  b->end_s[l] = end_s;
  b->time_s[l] = b->omega_max_time_s[l] = x->time_s;
  b->theta[l] = x->theta;
  b->omega[l] = b->omega_max[l] = b->omega_min[l] = x->omega;
  b->theta_error[l] = b->omega_error[l] = b->worst_error[l] = 0.0;
  b->theta_max[l] = fabs(x->theta);
}

static void put_block(const linear_frame *frame, block *b, const size_t row[], size_t filled) {
  if (filled == 0) return;
  for (size_t l = filled; l < BLOCK; l++) { /* empty places end where they start */
    const axle idle = {1.0, 0.0, frame->rows->start_s, 0, 0, 0, 0, 0, 0, 0, 0};
    fill_place(b, l, &idle, 0.0, frame->rows->start_s);
  }
  tame_way(frame, b);
  for (size_t l = 0; l < filled; l++) {
    const axle x = {1.0,
                    b->c[l],
                    b->time_s[l],
                    b->theta[l],
                    b->omega[l],
                    b->theta_error[l],
                    b->omega_max[l],
                    b->omega_max_time_s[l],
                    b->omega_min[l],
                    b->theta_max[l],
                    b->worst_error[l]};
    put_row(frame->out, row[l], &x, ROT_OK);
  }
}

static void linear_rows(const void *data, size_t first, size_t last) {
  const linear_frame *frame = data;
  block b;
  size_t row[BLOCK], filled = 0;
  for (size_t i = first; i < last; i++) {
    axle x;
    double scale, end_s;
    int fast;
    rot_status status = start_row(frame, i, &x, &scale, &end_s, &fast);
    if (status == ROT_OK && fast) {
      fill_place(&b, filled, &x, scale, end_s);
      row[filled++] = i;
    } else {
      if (status == ROT_OK) status = careful_way(frame, &x, end_s, scale);
      put_row(frame->out, i, &x, status);
    }
    if (filled == BLOCK) {
      put_block(frame, &b, row, filled);
      filled = 0;
    }
  }
  put_block(frame, &b, row, filled);
}

rot_status rot_sweep_linear(const rot_torque *torque, const rot_sweep_rows *rows, int threads,
                            const rot_sweep_columns *out, const rot_hooks *hooks, rot_info *info) {
  const size_t k = rot_torque_find(torque, rows->start_s, 1), n = torque->n - k + 1;
  rot_torque_piece *pieces = malloc(n * sizeof *pieces);
  rot_info_clear(info);
  if (!pieces) return info->status = ROT_ENOMEM;
  linear_frame frame = {rows, out, torque, pieces, 0.0, 1};
  for (size_t j = 0; j < n; j++) {
    pieces[j] = rot_torque_piece_at(torque, k + j);
    frame.tame =
        frame.tame && tame(pieces[j].start_n_m) && tame(pieces[j].end_n_m) &&
        (pieces[j].start_n_m == pieces[j].end_n_m || tame(pieces[j].end_s - pieces[j].start_s));
  }
  frame.start_n_m = rot_torque_in_piece(&pieces[0], rows->start_s);
  const rot_status status = sweep(linear_rows, &frame, rows->n, LINEAR_CHUNK, threads, hooks, info);
  free(pieces);
  return status;
}

/* ---- rows by a model ------------------------------------------------------------------------ */

typedef struct scene_frame {
  rot_axle_model model;
  const rot_axle_scene *scene;
  const rot_sweep_rows *rows;
  const rot_sweep_friction *friction;
  const rot_sweep_columns *out;
  int true_maximum;
} scene_frame;

static rot_status run_scene(const scene_frame *frame, size_t i, double torque_n_m[], double row[7],
                            rot_info *info) {
  const rot_sweep_rows *rows = frame->rows;
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

static void scene_rows(const void *data, size_t first, size_t last) {
  const scene_frame *frame = data;
  const rot_sweep_columns *out = frame->out;
  const size_t n = frame->scene->linear.torque.n;
  double *torque_n_m = malloc((n ? n : 1) * sizeof *torque_n_m);
  for (size_t i = first; i < last; i++) {
    double row[7] = {0.0};
    rot_info info;
    rot_info_clear(&info);
    const rot_status status = torque_n_m ? run_scene(frame, i, torque_n_m, row, &info) : ROT_ENOMEM;
    const int good = status == ROT_OK;
    out->theta_rad[i] = good ? row[0] : NAN;
    out->omega_rad_per_s[i] = good ? row[1] : NAN;
    out->speed_max[i] = good && frame->true_maximum ? info.omega_max : NAN;
    out->omega_max[i] = good && frame->true_maximum ? info.omega_high : NAN;
    out->omega_min[i] = good && frame->true_maximum ? info.omega_low : NAN;
    out->omega_max_time_s[i] = NAN;
    out->error[i] = good ? rot_info_error(&info) : NAN;
    out->status[i] = (int)status;
  }
  free(torque_n_m);
}

rot_status rot_sweep_scenes(rot_axle_model model, const rot_axle_scene *scene,
                            const rot_sweep_rows *rows, const rot_sweep_friction *friction,
                            int true_maximum, int threads, const rot_sweep_columns *out,
                            const rot_hooks *hooks, rot_info *info) {
  const scene_frame frame = {model, scene, rows, friction, out, true_maximum};
  return sweep(scene_rows, &frame, rows->n, SCENE_CHUNK, threads, hooks, info);
}
