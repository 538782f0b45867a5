#include "rot_sweep.h"

#include <math.h>
#include <stdlib.h>

#include "rot_real.h"

#ifdef _OPENMP
#include <omp.h>
#endif

/* Rows between two polls: some milliseconds. */
enum { LINEAR_CHUNK = 65536, SCENE_CHUNK = 512 };

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

static void share_out(row_worker work, const void *frame, size_t first, size_t last, int threads) {
#ifdef _OPENMP
  if (threads > 1) {
    const size_t n = last - first, parts = (size_t)threads;
#pragma omp parallel for num_threads(threads) schedule(static, 1)
    for (int i = 0; i < threads; i++) {
      const size_t at = (size_t)i;
      work(frame, first + n / parts * at + (at < n % parts ? at : n % parts),
           first + n / parts * (at + 1) + (at + 1 < n % parts ? at + 1 : n % parts));
    }
    return;
  }
#endif
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
    share_out(work, frame, first, last, threads);
    info->rows_done = first = last;
    info->status = rot_poll(hooks, (double)last / (double)n);
  }
  return info->status;
}

/* ---- one axle ------------------------------------------------------------------------------- */

typedef struct axle {
  double I, c, time_s, theta, omega, theta_error, omega_error;           /* now */
  double omega_max, omega_max_time_s, omega_min, theta_max, worst_error; /* on the way; of omega */
} axle;

static inline double larger(double x, double y) { return x > y ? x : y; } /* fmax() is a call */

static inline void note(axle *x, double time_s, double omega) {
  if (omega > x->omega_max) {
    x->omega_max = omega;
    x->omega_max_time_s = time_s;
  }
  if (omega < x->omega_min) x->omega_min = omega;
}

/* phi3(-z) for 0 <= z < 1, in four strands: what follows the last term is below 2^-54 of the first,
 * as it is from the eleventh on below 1/4. */
static inline double phi3_below_1(double z) {
  const double zz = z * z, z4 = zz * zz;
  double p = 1 / 6.0 + zz * (1 / 120.0) + z4 * (1 / 5040.0 + zz * (1 / 362880.0));
  double q = 1 / 24.0 + zz * (1 / 720.0) + z4 * (1 / 40320.0 + zz * (1 / 3628800.0));
  const double z8 = z4 * z4;
  p += z8 * ((1 / 39916800.0 + zz * (1 / 6227020800.0)) +
             z4 * ((1 / 1307674368000.0 + zz * (1 / 355687428096000.0)) +
                   z4 * (1 / 121645100408832000.0)));
  q += z8 * ((1 / 479001600.0 + zz * (1 / 87178291200.0)) +
             z4 * (1 / 20922789888000.0 + zz * (1 / 6402373705728000.0)));
  return p - z * q;
}

typedef struct weights {
  double start, near, far, reach; /* phi0, g1, phi2, phi1 */
} weights;

/* From z = 1 the recurrence upward loses less than a factor of four. */
static weights weights_from_1(double z) {
  const double each = 1.0 / z, phi0 = exp(-z), phi1 = (1.0 - phi0) * each;
  const weights w = {phi0, (phi1 - phi0) * each, (1.0 - phi1) * each, phi1};
  return w;
}

static weights weights_below_1(double z, double phi3) {
  const double phi2 = 0.5 - z * phi3, phi1 = 1.0 - z * phi2;
  const weights w = {1.0 - z * phi1, phi1 - phi2, phi2, phi1};
  return w;
}

/* Where omega turns inside a piece, its acceleration I A = excess at the start:
 * exp(c s/I) = 1 - (c/I) excess/slope. */
static double turning_s(double excess, double slope, double lambda) {
  const double straight = -excess / slope, x = lambda * straight;
  return x != 0.0 ? straight * (log1p(x) / x) : straight;
}

static void note_turn(axle *x, double lambda, double inverse, double s, double a, double b) {
  const double at = turning_s(a - x->c * x->omega, (b - a) / s, lambda), z = lambda * at;
  if (!(at > 0.0 && at < s)) return;
  const double torque = a + (b - a) * (at / s), most = larger(fabs(a), fabs(b));
  double omega, error = x->omega_error;
  if (z >= 1.0) {
    omega = torque / x->c; /* nothing is left over for acceleration */
    error += 12.0 * ROT_EPS * (most / x->c + fabs(x->omega));
  } else {
    const weights w = weights_below_1(z, phi3_below_1(z));
    const double v = at * inverse;
    omega = x->omega * w.start + v * (a * w.near + torque * w.far);
    error += 16.0 * ROT_EPS * (fabs(x->omega) + v * most);
  }
  note(x, x->time_s + at, omega);
  if (error > x->worst_error) x->worst_error = error;
}

/* A step of length s to a time, torque a to b; `most` bounds the torque in the piece. The weights
 * are good to 10 units at z = 1, where they are worst; 16 with products, sums and a torque inside
 * the piece. From z = 1 theta follows from the balance, c dtheta = impulse - I domega. */
static void pass(axle *x, double lambda, double inverse, double time_s, double s, double a,
                 double b, double most) {
  const double z = lambda * s, v = s * inverse, w0 = x->omega;
  double w1, turned, rounding, turned_rounding;
  weights w;
  if (z < 1.0) {
    const double phi3 = phi3_below_1(z);
    w = weights_below_1(z, phi3);
    const double far = w.far - phi3;
    w1 = w0 * w.start + v * (a * w.near + b * w.far);
    turned = s * (w0 * w.reach + v * (a * far + b * phi3));
    rounding = 16.0 * ROT_EPS * (fabs(w0) * w.start + v * (fabs(a) * w.near + most * w.far));
    turned_rounding = 16.0 * ROT_EPS * s * (fabs(w0) * w.reach + v * (fabs(a) * far + most * phi3));
  } else {
    w = weights_from_1(z);
    w1 = w0 * w.start + v * (a * w.near + b * w.far);
    turned = (0.5 * s * (a + b) - x->I * (w1 - w0)) / x->c;
    rounding = ROT_EPS * ((4.0 + 3.0 * z) * fabs(w0) * w.start +
                          16.0 * v * (fabs(a) * w.near + most * w.far));
    turned_rounding =
        (8.0 * ROT_EPS * s * most + x->I * (rounding + 3.0 * ROT_EPS * (fabs(w0) + fabs(w1)))) /
        x->c;
  }
  const double excess = a - x->c * w0, left = b - x->c * w1;
  if (a != b && ((excess > 0.0 && left < 0.0) || (excess < 0.0 && left > 0.0))) {
    note_turn(x, lambda, inverse, s, a, b);
  }
  x->theta += turned;
  x->theta_error += s * w.reach * x->omega_error + turned_rounding + ROT_EPS * fabs(x->theta);
  x->omega = w1;
  x->omega_error = x->omega_error * w.start + rounding;
  if (x->omega_error > x->worst_error) x->worst_error = x->omega_error;
  x->time_s = time_s;
  note(x, time_s, w1);
  if (fabs(x->theta) > x->theta_max) x->theta_max = fabs(x->theta);
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

/* The torque of a piece at a time inside it. */
static double inside(const rot_torque_piece *piece, double t) {
  const double a = piece->start_n_m, b = piece->end_n_m;
  if (a == b) return a;
  return (a * (piece->end_s - t) + b * (t - piece->start_s)) / (piece->end_s - piece->start_s);
}

static void tame_way(const linear_frame *frame, axle *x, double end_s, double scale) {
  const double inverse = 1.0 / x->I, lambda = x->c * inverse;
  const rot_torque_piece *piece = frame->pieces;
  double a = frame->start_n_m;
  for (;; piece++, a = piece->start_n_m) {
    const double stop = piece->end_s < end_s ? piece->end_s : end_s;
    const double b = stop == piece->end_s ? piece->end_n_m : inside(piece, stop);
    const double most = larger(fabs(piece->start_n_m), fabs(piece->end_n_m));
    const double s = stop - x->time_s;
    if (s > 0.0) pass(x, lambda, inverse, stop, s, a * scale, b * scale, most * fabs(scale));
    if (end_s <= piece->end_s) return;
  }
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

static void linear_rows(const void *data, size_t first, size_t last) {
  const linear_frame *frame = data;
  const rot_sweep_rows *rows = frame->rows;
  const double start_s = rows->start_s;
  for (size_t i = first; i < last; i++) {
    const double I = rot_at(rows->inertia_kg_m2, i), c = rot_at(rows->viscous_n_m_s, i),
                 scale = rot_at(rows->torque_scale, i), w0 = rot_at(rows->omega0_rad_per_s, i),
                 theta0 = rot_at(rows->theta0_rad, i), end_s = rot_at(rows->time_s, i);
    axle x = {I, c, start_s, theta0, w0, 0.0, 0.0, w0, start_s, w0, fabs(theta0), 0.0};
    rot_status status = ROT_OK;
    if (!(I > 0.0 && end_s >= start_s && isfinite(I) && isfinite(c) && isfinite(scale) &&
          isfinite(w0) && isfinite(theta0) && isfinite(end_s))) {
      status = ROT_EVALUE;
    } else if (frame->tame && c >= 0.0 && tame(I) && tame(c) && tame(scale) && tame(w0) &&
               tame(theta0) && tame(end_s - start_s)) {
      tame_way(frame, &x, end_s, scale);
    } else {
      status = careful_way(frame, &x, end_s, scale);
    }
    put_row(frame->out, i, &x, status);
  }
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
    out->omega_max[i] = out->omega_max_time_s[i] = out->omega_min[i] = NAN;
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
