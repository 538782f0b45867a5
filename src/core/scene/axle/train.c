#include "scene/axle/train.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "ground/exact.h"

/* Extended type for sums and products, as in R. */
typedef long double extended;

static double sum_of(size_t n, const double x[]) {
  extended sum = 0.0L;
  for (size_t i = 0; i < n; i++) sum += x[i];
  return (double)sum;
}

/* ---- conversion to the first shaft ----------------------------------------------------------- */

/* Products of the ratios, then each number at the first shaft. */
rot_status rot_axle_train_reflect(size_t n, const double ratio[], const double inertia_kg_m2[],
                                  const double viscous_n_m_s[], const double torque_n_m[],
                                  const double efficiency[], rot_store *store, rot_axle_train *to) {
  double *first = rot_store_get(store, n, sizeof *first);
  double *inertia = rot_store_get(store, n, sizeof *inertia);
  double *viscous = rot_store_get(store, n, sizeof *viscous);
  double *torque = rot_store_get(store, n, sizeof *torque);
  extended product = 1.0L;
  if (!first || !inertia || !viscous || !torque) return ROT_ENOMEM;
  for (size_t i = 0; i < n; i++) {
    if (i) product *= ratio[i - 1];
    first[i] = (double)product;
    /* Two divisions: the square of a ratio may overflow where the quotient does not. */
    inertia[i] = inertia_kg_m2[i] / first[i] / first[i];
    viscous[i] = viscous_n_m_s[i] / first[i] / first[i];
    torque[i] = torque_n_m[i] / first[i];
  }
  *to = (rot_axle_train){n, first, inertia, viscous, torque, efficiency};
  return ROT_OK;
}

/* ---- power through the meshes ---------------------------------------------------------------- */

/* Products of the factors u/X of the meshes before each shaft; shaft i takes own[i]. */
static void mesh_gains(size_t n, const double own[], const double efficiency[], double gain[]) {
  double taken = own[n - 1];
  for (size_t i = n - 1; i-- > 0;) {
    gain[i + 1] = taken > 0.0 ? 1.0 / efficiency[i] : efficiency[i];
    taken = own[i] + gain[i + 1] * taken;
  }
  extended product = gain[0] = 1.0;
  for (size_t i = 1; i < n; i++) gain[i] = (double)(product *= gain[i]);
}

void rot_axle_train_steady(const rot_axle_train *train, double torque_n_m[]) {
  const size_t n = train->n;
  for (size_t i = 0; i < n; i++) torque_n_m[i] = -train->torque_n_m[i];
  mesh_gains(n, torque_n_m, train->efficiency, torque_n_m);
  for (size_t i = 0; i < n; i++) torque_n_m[i] *= train->torque_n_m[i];
}

/* One direction of rotation: sign times the torques, for w >= 0. */
typedef struct side {
  const rot_axle_train *train;
  double sign;        /* 1 or -1 */
  double *own, *gain; /* n each, scratch */
} side;

/* Acceleration a at w, and the line start + slope w of the power flows there. */
typedef struct line {
  double a, start, slope, w;
} line;

/* w => line, by Newton's iteration: finite, since the function is convex with finitely many
 * lines. */
static line line_at(const side *at, double w) {
  const rot_axle_train *t = at->train;
  const size_t n = t->n;
  const double force = at->sign * sum_of(n, t->torque_n_m);
  line to = {.w = w};
  to.a = (force - sum_of(n, t->viscous_n_m_s) * w) / sum_of(n, t->inertia_kg_m2);
  for (size_t turn = 0; turn < 10 + 4 * n; turn++) {
    extended inertia = 0.0L, start = 0.0L, slope = 0.0L;
    for (size_t i = 0; i < n; i++) {
      at->own[i] =
          t->inertia_kg_m2[i] * to.a - at->sign * t->torque_n_m[i] + t->viscous_n_m_s[i] * w;
    }
    mesh_gains(n, at->own, t->efficiency, at->gain);
    for (size_t i = 0; i < n; i++) {
      inertia += t->inertia_kg_m2[i] * at->gain[i];
      start += at->sign * t->torque_n_m[i] * at->gain[i];
      slope += t->viscous_n_m_s[i] * at->gain[i];
    }
    to.start = (double)start / (double)inertia;
    to.slope = -(double)slope / (double)inertia;
    const double now = to.start + to.slope * w;
    if (now >= to.a && turn > 0) break; /* decreases to the zero from above */
    to.a = now;
  }
  return to;
}

/* ---- changes of power flow ------------------------------------------------------------------- */

enum { MAX_BENDS = 4096 }; /* limit of their number and of recursions */

typedef struct bends {
  size_t count;
  double *w;
} bends;

static rot_status add_bend(bends *b, double w) {
  if (b->count == MAX_BENDS) return ROT_ESTEP;
  b->w[b->count++] = w;
  return ROT_OK;
}

static int same_line(const line *a, const line *b) {
  return a->slope == b->slope && a->start == b->start;
}

/* Bends of the concave a(w) between two lines, recursively at their intersections. */
static rot_status find_bends(const side *at, const line *left, const line *right, size_t depth,
                             bends *b) {
  const double fall = left->slope - right->slope;
  if (!(fall > 2.0 * DBL_EPSILON * fabs(right->slope))) return ROT_OK;
  const double w = (right->start - left->start) / fall;
  if (!(w > left->w && w < right->w)) return ROT_OK;
  const line here = line_at(at, w);
  const double below = left->start + left->slope * w - here.a;
  if (same_line(&here, left) || same_line(&here, right) ||
      below <= 8.0 * DBL_EPSILON * (fabs(left->start) + fabs(left->slope * w))) {
    return add_bend(b, w);
  }
  if (depth == MAX_BENDS) return ROT_ESTEP;
  const rot_status status = find_bends(at, left, &here, depth + 1, b);
  return status == ROT_OK ? find_bends(at, &here, right, depth + 1, b) : status;
}

/* Behaviour from rest. */
typedef struct from_rest {
  double a;    /* acceleration at rest */
  double last; /* slope at high rates */
  double min;  /* smallest |slope| */
  bends bends;
} from_rest;

/* side => acceleration at rest, bends, slope beyond all bends. */
static rot_status look_ahead(const side *at, rot_store *store, from_rest *to) {
  const rot_axle_train *t = at->train;
  side still = *at;
  extended gain = 1.0L, force = 0.0L;
  still.sign = 0.0;
  to->bends = (bends){0, rot_store_get(store, MAX_BENDS, sizeof(double))};
  if (!to->bends.w) return ROT_ENOMEM;
  to->a = line_at(at, 0.0).a;
  to->last = line_at(&still, 1.0).slope;
  to->min = fabs(to->last);
  for (size_t i = 0; i < t->n; i++) {
    force += fabs(t->torque_n_m[i]);
    if (i + 1 < t->n) gain *= t->efficiency[i];
  }
  if (to->last == 0.0 || force == 0.0L) return ROT_OK;
  /* Rate beyond all bends: the resistance exceeds the torques by far. */
  const double through = (double)gain;
  double far = 1e3 * (double)force / (through * through) / sum_of(t->n, t->viscous_n_m_s);
  const double near = 1e-15 * far;
  line outer = line_at(at, far);
  for (int turn = 1; turn < 40 && isfinite(far) && far != 0.0 && outer.slope != to->last; turn++) {
    far *= 8.0;
    outer = line_at(at, far);
  }
  /* Just above rest a mesh without power at rest has a direction. */
  const line beside = line_at(at, near);
  to->min = fabs(beside.slope);
  if (!(far > 0.0 && isfinite(far))) return ROT_OK;
  return find_bends(at, &beside, &outer, 0, &to->bends);
}

/* ---- the law --------------------------------------------------------------------------------- */

/* Rounding of the law: 3 n of the ratios and gains of each term, and of the sums; times the
 * amplification of the meshes. */
static void set_rounding(const rot_axle_train *t, int lossy, double alpha,
                         rot_axle_train_law *law) {
  const double count = DBL_EPSILON / 2.0 * (3.0 * (double)t->n + 3.0);
  extended product = 1.0L, whole = 0.0L, felt = 0.0L, torque = 0.0L, viscous = 0.0L, sum = 0.0L;
  for (size_t i = 0; i < t->n; i++) {
    if (i) product *= 1.0 / t->efficiency[i - 1];
    const double gain = (double)product;
    whole += t->inertia_kg_m2[i];
    felt += t->inertia_kg_m2[i] / gain;
    torque += gain * (fabs(t->torque_n_m[i]) + (lossy ? fabs(alpha) : 0.0) * t->inertia_kg_m2[i]);
    viscous += gain * t->viscous_n_m_s[i];
    sum += t->torque_n_m[i];
  }
  const double fraction = lossy ? (double)whole / (double)felt : 1.0;
  law->rounding[0] = count * fraction * ((double)torque + (lossy ? 0.0 : fabs((double)sum)));
  law->rounding[1] = count * fraction * (double)viscous;
}

/* Curve points at the bends of a side, outward: torques relative to that at rest. */
static void curve_points(const side *at, const from_rest *of, double inertia, double viscous,
                         double omega[], double torque[], size_t first) {
  for (size_t i = 0; i < of->bends.count; i++) {
    const double w = of->bends.w[i];
    const size_t to = at->sign > 0.0 ? first + 1 + i : first - 1 - i;
    omega[to] = at->sign * w;
    torque[to] = at->sign * (inertia * (line_at(at, w).a - of->a) + viscous * w);
  }
}

static double neumaier(size_t n, const double x[]) {
  double sum = x[0], rest = 0.0, lost;
  for (size_t i = 1; i < n; i++) {
    sum = rot_two_sum(sum, x[i], &lost);
    rest += lost;
  }
  return isfinite(rest) ? sum + rest : sum;
}

/* Both directions: torque, viscous slope, curve, dry friction of the losses. */
rot_status rot_axle_train_law_of(const rot_axle_train *t, rot_store *store,
                                 rot_axle_train_law *law) {
  const double applied = neumaier(t->n, t->torque_n_m);
  const double bearings = sum_of(t->n, t->viscous_n_m_s);
  extended torques = 0.0L;
  memset(law, 0, sizeof *law);
  law->inertia_kg_m2 = sum_of(t->n, t->inertia_kg_m2);
  for (size_t i = 0; i + 1 < t->n; i++) law->lossy |= t->efficiency[i] < 1.0;
  if (!law->lossy) {
    law->torque_n_m = applied;
    law->viscous_n_m_s = bearings;
    set_rounding(t, 0, 0.0, law);
    return ROT_OK;
  }
  double *room = rot_store_get(store, 2 * t->n, sizeof *room);
  if (!room) return ROT_ENOMEM;
  const side ahead = {t, 1.0, room, room + t->n}, behind = {t, -1.0, room, room + t->n};
  from_rest up, down;
  rot_status status = look_ahead(&ahead, store, &up);
  if (status == ROT_OK) status = look_ahead(&behind, store, &down);
  if (status != ROT_OK) return status;
  const double inertia = law->inertia_kg_m2, forward = inertia * up.a, backward = -inertia * down.a;
  for (size_t i = 0; i < t->n; i++) torques += fabs(t->torque_n_m[i]);
  law->viscous_n_m_s = -inertia * up.last;
  law->dry_n_m = fmax((backward - forward) / 2.0, 0.0);
  /* A loss within rounding is 0. */
  if (law->dry_n_m <= 8.0 * DBL_EPSILON * (double)torques) law->dry_n_m = 0.0;
  law->torque_n_m = law->dry_n_m > 0.0 ? (forward + backward) / 2.0 : applied;
  if (up.bends.count || down.bends.count) {
    law->n_curve = up.bends.count + 1 + down.bends.count;
    double *omega = rot_store_get(store, law->n_curve, sizeof *omega);
    double *curve = rot_store_get(store, law->n_curve, sizeof *curve);
    if (!omega || !curve) return ROT_ENOMEM;
    curve_points(&ahead, &up, inertia, law->viscous_n_m_s, omega, curve, down.bends.count);
    curve_points(&behind, &down, inertia, law->viscous_n_m_s, omega, curve, down.bends.count);
    law->omega_rad_per_s = omega;
    law->curve_n_m = curve;
  }
  set_rounding(t, 1, fmax(fabs(up.a), fabs(down.a)), law);
  law->gears =
      (rot_axle_gears){.applied_n_m = applied,
                       .forward_n_m = fmax(applied - (law->torque_n_m - law->dry_n_m), 0.0),
                       .backward_n_m = fmax((law->torque_n_m + law->dry_n_m) - applied, 0.0),
                       .bearings_n_m_s = bearings,
                       .min_n_m_s = inertia * fmin(up.min, down.min)};
  return ROT_OK;
}

/* A torque E changes omega by at most E min(t/I, 1/c), backward in time by E (exp(c t/I) - 1)/c:
 * resistance that does not decrease with the speed makes two motions converge. */
void rot_axle_train_error(const rot_axle_scene *scene, const double rounding[2], double min_n_m_s,
                          double first_s, double last_s, double fastest, double error[2]) {
  const double inertia = scene->linear.inertia_kg_m2, viscous = scene->viscous_n_m_s;
  const double start = scene->linear.start_s, back = fmax(start - first_s, 0.0);
  const double span = fmax(back, fabs(last_s - start));
  const double off = rounding[0] + rounding[1] * fastest;
  double lag = span / inertia;
  error[0] = error[1] = 0.0;
  if (!(fastest > 0.0)) return; /* at rest: held, or without torque */
  if (viscous > 0.0 && back > 0.0) {
    lag = fmax(lag, expm1(viscous * back / inertia) / viscous);
  } else if (min_n_m_s > 0.0) {
    lag = fmin(lag, 1.0 / min_n_m_s);
  }
  error[ROT_THETA] = off * span * (back > 0.0 ? lag : fmin(span / inertia / 2.0, lag));
  error[ROT_OMEGA] = off * lag;
}
