#include "scene/axle/forced.h"

#include <math.h>
#include <stdlib.h>

#include "scene/axle/effects.h"
#include "scene/axle/pieces.h"
#include "ground/dd.h"
#include "maths/divided.h"
#include "maths/phi.h"
#include "ground/real.h"
#include "ground/search.h"

enum { MAX_DEGREE = ROT_PHI_HIGH - 2 };

int rot_axle_forced_max_degree(void) { return MAX_DEGREE; }

int rot_axle_forced_fits(const rot_axle_scene *scene) {
  for (size_t i = 0; i < scene->n_terms; i++) {
    const rot_term *term = &scene->terms[i];
    if (term->kind == ROT_TERM_POLYNOMIAL && term->x[1] > MAX_DEGREE + 1) return 0;
  }
  return rot_axle_fits(scene, ROT_AXLE_FORCED_TAKES);
}

/* ---- a term between two breaks -------------------------------------------------------------- */

/* Error of a contribution in units of roundoff times the sum of its |parts|, worst case: kernel 6
 * to 10 (phi functions with c < 0), scaling 5 to 8, omitted residuals up to 4 more for a wave with
 * c < 0. In 8000 random scenes the largest error was half of the sum. */
enum { WAVE_ROUNDINGS = 14, DECAY_ROUNDINGS = 16, POWER_ROUNDINGS = 24 };

/* Constants of a term between two breaks. Coefficient j of a polynomial about the base: a[j]
 * 2^exponent[j]; at_most[j]: sum of the |numbers| added in it, same unit. */
typedef struct forced_term {
  const rot_term *term;             /* NULL: does not act here */
  double cosine, sine;              /* sinusoid: of the phase at the base */
  double log_factor, log_factor_lo; /* exponential: its logarithm at the base */
  double ratio;                     /* Omega I/c, or lambda I/c */
  int degree;                       /* polynomial */
  double a[MAX_DEGREE + 1], at_most[MAX_DEGREE + 1];
  int exponent[MAX_DEGREE + 1];
} forced_term;

/* A step from the base: s + s_lo, z + z_lo = c s/I, and the phi functions needed by the terms. */
typedef struct forced_span {
  double I, c, s, s_lo, z, z_lo;
  double phi[ROT_PHI_HIGH + 1];
} forced_span;

/* Contribution of a term. */
typedef struct forced_part {
  double value[2];  /* to omega, theta */
  double size[2];   /* sums of its |terms| */
  double roundings; /* error in units of roundoff times size */
} forced_part;

/* Product of n numbers over d1 d2 without intermediate over- or underflow. If no partial result is
 * near the limits, the plain product has the same rounding. */
static double quotient(int n, const double x[], double d1, double d2) {
  const double low = 1e-280, high = 1e280;
  double p = 1.0;
  int plain = 1;
  for (int i = 0; i < n; i++) {
    p *= x[i];
    plain &= fabs(p) > low && fabs(p) < high;
  }
  p /= d1;
  plain &= fabs(p) > low && fabs(p) < high;
  p /= d2;
  plain &= fabs(p) > low && fabs(p) < high;
  if (plain) return p;
  int e1 = 0, e2 = 0, e;
  const double m1 = frexp(d1, &e1), m2 = frexp(d2, &e2);
  p = rot_product_split(n, x, m1, &e) / m2;
  return ldexp(p, e - e1 - e2);
}

/* ---- sinusoid ------------------------------------------------------------------------------- */

/* Sinusoid: phase at the base, exact in three parts. */
static void prepare_wave(forced_term *f, double base_s, double I, double c) {
  const double *x = f->term->x;
  double lo, rest, last, s, c_rest, at = rot_two_prod(x[1], base_s, &lo);
  const double angle = rot_two_sum(at, x[2], &rest), s_angle = sin(angle), c_angle = cos(angle);
  rest = rot_two_sum(rest, lo, &last);
  rot_sin_cos(rest, last, &s, &c_rest);
  f->sine = fma(s_angle, c_rest, c_angle * s);
  f->cosine = fma(c_angle, c_rest, -(s_angle * s));
  f->ratio = rot_muldiv(x[1], I, c, NULL);
}

/* a b - c d with exact products. */
static double cross(double a, double b, double c, double d) {
  const double cd = c * d, lost = fma(-c, d, cd);
  return fma(a, b, -cd) + lost;
}

/* (sinusoid, step) => contribution by divided differences of the exponential. */
static forced_part wave_part(const forced_term *f, const forced_span *at) {
  const double *x = f->term->x, s = at->s, I = at->I;
  double y_lo, y = rot_two_prod(x[1], s, &y_lo);
  y_lo += x[1] * at->s_lo;
  const rot_divided_wave w = rot_divided_wave_at(at->z, at->z_lo, y, y_lo, f->ratio);
  forced_part part = {0};
  part.roundings = at->z < 0.0 ? WAVE_ROUNDINGS + 4.0 : WAVE_ROUNDINGS;
  /* Rounding of the residual of the phase: relevant if it is many radians. */
  if (at->s_lo != 0.0) part.roundings += fabs(x[1] * at->s_lo) + fabs(y_lo);
  const int settled = !(at->z < INFINITY); /* s/(I z) = 1/c */
  for (int i = 0; i < 2; i++) {
    const double value = cross(f->cosine, w.re[i], f->sine, w.im[i]), size = w.size[i];
    part.value[i] = settled ? quotient(2 + i, (double[]){x[0], value, s}, at->c, 1.0)
                            : quotient(3 + i, (double[]){x[0], s, value, s}, I, w.scale);
    part.size[i] = settled ? quotient(2 + i, (double[]){x[0], size, s}, at->c, 1.0)
                           : quotient(3 + i, (double[]){x[0], s, size, s}, I, w.scale);
  }
  return part;
}

/* ---- exponential ---------------------------------------------------------------------------- */

static void prepare_decay(forced_term *f, double base_s, double I, double c) {
  const double *x = f->term->x;
  double since_lo, lo, since = rot_two_sum(base_s, -x[2], &since_lo);
  const double fall = rot_two_prod(x[1], since, &lo);
  f->log_factor = -fall;
  f->log_factor_lo = isfinite(lo) ? -(lo + x[1] * since_lo) : 0.0;
  f->ratio = rot_muldiv(x[1], I, c, NULL);
}

/* rot_dd_add() in which an infinite term (a completed decay) stays infinite. */
static rot_dd sum_of(rot_dd a, rot_dd b) {
  const double hi = a.hi + b.hi;
  return isfinite(hi) ? rot_dd_add(a, b) : (rot_dd){hi, 0.0};
}

static double phi_1(double z) { return z != 0.0 ? -expm1(-z) / z : 1.0; }

/* A exp(g) x[0] x[1] .. / (d1 d2) without intermediate over- or underflow. */
static double grown(double A, rot_dd g, int n, const double x[], double d1, double d2) {
  int exponent;
  const double e = rot_exp_split(g.hi, g.lo, &exponent);
  double factor[6] = {A, e};
  for (int i = 0; i < n; i++) factor[2 + i] = x[i];
  if (exponent == 0) return quotient(n + 2, factor, d1, d2);
  int shift, e1 = 0, e2 = 0;
  const double m1 = frexp(d1, &e1), m2 = frexp(d2, &e2);
  const double p = rot_product_split(n + 2, factor, m1, &shift) / m2;
  return ldexp(p, shift - e1 - e2 + exponent);
}

/* Limits for infinite z or y: quasi-static axle, impulsive torque. */
static forced_part decay_at_once(const forced_term *f, const forced_span *at, rot_dd y) {
  const double A = f->term->x[0], rate = f->term->x[1], s = at->s, I = at->I, c = at->c;
  const rot_dd g = {f->log_factor, f->log_factor_lo}, z = {at->z, at->z_lo};
  forced_part part = {0};
  /* s/(I p) remains, p: distance of the outer two of the nodes 0, -z, -y. */
  if (z.hi == INFINITY && y.hi == INFINITY) {
    part.value[1] = grown(A, g, 1, (double[]){1.0 / rate}, c, 1.0);
  } else if (z.hi == INFINITY) {
    const double difference = 1.0 - f->ratio;
    const rot_dd high = y.hi < 0.0 ? sum_of(g, rot_dd_neg(y)) : g;
    part.value[0] = grown(A, sum_of(g, rot_dd_neg(y)), 0, NULL, c, difference);
    part.value[1] =
        grown(A, high, 2, (double[]){s, phi_1(fabs(y.hi))}, c, y.hi < 0.0 ? difference : 1.0);
  } else {
    const double difference = 1.0 - 1.0 / f->ratio;
    const rot_dd high = z.hi < 0.0 ? sum_of(g, rot_dd_neg(z)) : g;
    part.value[0] = grown(A, sum_of(g, rot_dd_neg(z)), 1, (double[]){1.0 / difference}, I, rate);
    part.value[1] = grown(
        A, high, 3, (double[]){s, phi_1(fabs(z.hi)), z.hi < 0.0 ? 1.0 / difference : 1.0}, I, rate);
  }
  return part;
}

/* (exponential, step) => contribution by divided differences of the exponential. */
static forced_part decay_part(const forced_term *f, const forced_span *at) {
  const double A = f->term->x[0], s = at->s, I = at->I;
  const rot_dd z = {at->z, at->z_lo}, g = {f->log_factor, f->log_factor_lo};
  rot_dd y;
  y.hi = rot_two_prod(f->term->x[1], s, &y.lo);
  y.lo = isfinite(y.lo) ? y.lo + f->term->x[1] * at->s_lo : 0.0;
  forced_part part;
  if (z.hi == INFINITY || y.hi == INFINITY) {
    part = decay_at_once(f, at, y);
  } else {
    /* exp[-z, -y] = exp(-min) phi_1(-|z - y|); exp[0, -z, -y] with the largest node shifted to
     * 0. */
    const rot_dd gap = sum_of(z, rot_dd_neg(y)), less = gap.hi > 0.0 ? y : z,
                 more = gap.hi > 0.0 ? z : y;
    const double difference = fabs(gap.hi);
    rot_dd top = {0.0, 0.0};
    double p, q, r, scale;
    part.value[0] =
        grown(A, sum_of(g, rot_dd_neg(less)), 2, (double[]){s, phi_1(difference)}, I, 1.0);
    if (less.hi >= 0.0) { /* nodes 0, -less, -more */
      p = more.hi;
      q = less.hi;
      r = difference;
    } else if (more.hi >= 0.0) { /* -less, 0, -more */
      top = rot_dd_neg(less);
      p = difference;
      q = -less.hi;
      r = more.hi;
    } else { /* -less, -more, 0 */
      top = rot_dd_neg(less);
      p = -less.hi;
      q = difference;
      r = -more.hi;
    }
    const double value = rot_divided_decay(p, q, r, &scale);
    part.value[1] = grown(A, sum_of(g, top), 3, (double[]){s, value, s}, I, scale);
  }
  part.roundings = DECAY_ROUNDINGS;
  for (int i = 0; i < 2; i++) part.size[i] = fabs(part.value[i]);
  return part;
}

/* ---- polynomial ----------------------------------------------------------------------------- */

static double binomial(int n, int k) {
  double b = 1.0;
  for (int i = 1; i <= k; i++) b = b * (n - k + i) / i; /* exact: n <= 16 */
  return b;
}

/* u^m 2^(m exponent of u) for m = 0 .. degree in double words; mantissas only. */
static void powers(double u, double u_lo, int degree, rot_dd power[MAX_DEGREE + 1], int *exponent) {
  *exponent = 0;
  const double m = frexp(u, exponent), m_lo = ldexp(u_lo, -*exponent);
  power[0] = (rot_dd){1.0, 0.0};
  for (int k = 1; k <= degree; k++) {
    const rot_dd last = power[k - 1];
    double lo, hi = rot_two_prod(last.hi, m, &lo);
    lo += last.lo * m + last.hi * m_lo;
    power[k].hi = rot_two_sum(hi, lo, &power[k].lo);
  }
}

/* sum_k a_k (u + v)^k = sum_j a'_j v^j with a'_j = sum_k C(k, j) a_k u^(k-j), in double words:
 * cancellation costs no digits of the rows. */
static void shift_coefficients(forced_term *f, const double a[], double u, double u_lo) {
  const int n = f->degree;
  rot_dd power[MAX_DEGREE + 1];
  int eu;
  powers(u, u_lo, n, power, &eu);
  for (int j = 0; j <= n; j++) {
    int max = -1000000, e[MAX_DEGREE + 1] = {0};
    double m[MAX_DEGREE + 1];
    for (int k = j; k <= n; k++) {
      m[k] = u == 0.0 && k > j ? 0.0 : frexp(a[k], &e[k]);
      e[k] += (k - j) * eu;
      if (m[k] != 0.0 && e[k] > max) max = e[k];
    }
    rot_dd sum = {0.0, 0.0};
    double size = 0.0;
    for (int k = j; k <= n; k++) {
      if (m[k] == 0.0 || e[k] < max - 2000) continue;
      const rot_dd p = power[k - j];
      const double b = ldexp(m[k], e[k] - max), c = binomial(k, j);
      double lo, cb = c * b, cb_lo = fma(c, b, -cb), hi = rot_two_prod(cb, p.hi, &lo);
      sum = sum_of(sum, (rot_dd){hi, lo + cb * p.lo + cb_lo * p.hi});
      size += fabs(hi);
    }
    f->a[j] = sum.hi;
    f->at_most[j] =
        fabs(sum.hi) + size * 0x1p-45; /* rounding of sum, and 2^-98 of the |terms| added */
    f->exponent[j] = max;
  }
}

/* Polynomial: coefficients about the base. Returns 0 outside its breaks, else 1. low_s: lower end
 * of the span. */
static int prepare_powers(forced_term *f, double base_s, double low_s) {
  const double *x = f->term->x, *breaks = x + 2;
  const size_t n = (size_t)x[0], m = (size_t)x[1];
  if (!(low_s >= breaks[0] && low_s < breaks[n])) return 0;
  const size_t k = rot_upper_bound(n, breaks, low_s) - 1;
  double u_lo, u = rot_two_sum(base_s, -breaks[k], &u_lo);
  f->degree = (int)m - 1;
  shift_coefficients(f, breaks + n + 1 + k * m, u, u_lo);
  return 1;
}

/* (polynomial, step) => contribution. omega: (s/I) sum a_j s^j j! phi_(j+1), theta: (s^2/I) sum a_j
 * s^j j! phi_(j+2). */
static forced_part powers_part(const forced_term *f, const forced_span *at) {
  const double s = at->s, I = at->I;
  const int n = f->degree, settled = at->z == INFINITY;
  rot_dd power[MAX_DEGREE + 1];
  int es, max = -1000000;
  powers(s, at->s_lo, n, power, &es);
  for (int j = 0; j <= n; j++) {
    const int e = f->exponent[j] + j * es;
    if (f->a[j] != 0.0 && e > max) max = e;
  }
  double sum[2] = {0.0, 0.0}, low[2] = {0.0, 0.0}, size[2] = {0.0, 0.0}, factorial = 1.0;
  for (int j = 0; j <= n; factorial *= ++j) {
    const int e = f->exponent[j] + j * es - max;
    if (f->a[j] == 0.0 || e < -2000) continue;
    const double scale = ldexp(power[j].hi, e);
    const double w[2] = {settled ? 1.0 : factorial * at->phi[j + 1],
                         settled ? 1.0 / (j + 1) : factorial * at->phi[j + 2]};
    for (int i = 0; i < 2; i++) {
      rot_accumulate(&sum[i], &low[i], f->a[j] * scale * w[i]);
      size[i] += f->at_most[j] * fabs(scale) * w[i];
    }
  }
  forced_part part = {0};
  part.roundings = POWER_ROUNDINGS;
  if (max == -1000000) return part;
  for (int i = 0; i < 2; i++) {
    const double x[] = {sum[i] + low[i], s, s}, y[] = {size[i], s, s};
    int ex, ey;
    const int count = (settled ? 1 : 2) + i;
    const double px = rot_product_split(count, x, settled ? at->c : I, &ex);
    const double py = rot_product_split(count, y, settled ? at->c : I, &ey);
    part.value[i] = ldexp(px, ex + max);
    part.size[i] = ldexp(py, ey + max);
  }
  return part;
}

/* ---- one step ------------------------------------------------------------------------------- */

/* (term, base) => its constants. No break lies between low_s and the base, or the base and the far
 * end of the span. */
static void prepare(forced_term *f, const rot_axle_scene *scene, const rot_term *term,
                    double base_s, double low_s) {
  const double I = scene->linear.inertia_kg_m2, c = scene->linear.viscous_n_m_s;
  f->term = term;
  f->degree = -1;
  int acts = low_s >= term->from_s && low_s < term->to_s;
  if (acts && term->kind == ROT_TERM_POLYNOMIAL) acts = prepare_powers(f, base_s, low_s);
  if (!acts || (term->kind != ROT_TERM_POLYNOMIAL && term->x[0] == 0.0)) {
    f->term = NULL;
  } else if (term->kind == ROT_TERM_SINUSOID) {
    prepare_wave(f, base_s, I, c);
  } else if (term->kind == ROT_TERM_EXPONENTIAL) {
    prepare_decay(f, base_s, I, c);
  }
}

static forced_span make_span(const rot_axle_scene *scene, double from_s, double to_s, int k_max) {
  forced_span at;
  at.I = scene->linear.inertia_kg_m2;
  at.c = scene->linear.viscous_n_m_s;
  at.s = rot_two_sum(to_s, -from_s, &at.s_lo);
  at.z = rot_muldiv(at.c, at.s, at.I, &at.z_lo);
  if (isfinite(at.z) && at.s != 0.0) at.z_lo += at.z * (at.s_lo / at.s);
  if (k_max > 0) rot_phi_high(at.z, at.z_lo, k_max, at.phi);
  return at;
}

static void add_part(rot_axle_state *to, const forced_term *f, const forced_span *at) {
  const forced_part part = f->term->kind == ROT_TERM_SINUSOID      ? wave_part(f, at)
                           : f->term->kind == ROT_TERM_EXPONENTIAL ? decay_part(f, at)
                                                                   : powers_part(f, at);
  const double rounding = part.roundings * ROT_EPS;
  rot_accumulate(&to->omega_rad_per_s, &to->omega_lo, part.value[0]);
  rot_accumulate(&to->theta_rad, &to->theta_lo, part.value[1]);
  to->omega_error += rounding * fabs(part.size[0]);
  to->theta_error += rounding * fabs(part.size[1]);
}

static void settle(rot_axle_state *state) {
  state->omega_rad_per_s = rot_two_sum(state->omega_rad_per_s, state->omega_lo, &state->omega_lo);
  state->theta_rad = rot_two_sum(state->theta_rad, state->theta_lo, &state->theta_lo);
  state->omega_error += ROT_EPS * fabs(state->omega_rad_per_s);
  state->theta_error += ROT_EPS * fabs(state->theta_rad);
}

/* ---- the pieces ----------------------------------------------------------------------------- */

/* State of a run: the piece from one break or knot to the next. */
typedef struct forced_run {
  const rot_axle_scene *scene;
  rot_axle_state base;
  rot_torque_piece piece;
  int forward;
  double end_s;
  forced_term *term; /* terms that act in the piece */
  size_t n_terms;
  int k_max; /* largest index of the phi functions needed */
} forced_run;

static rot_axle_state move(const forced_run *run, double time_s) {
  rot_axle_state to = rot_axle_step(&run->scene->linear, &run->base, &run->piece, time_s);
  if (run->n_terms == 0 || time_s == run->base.time_s) return to;
  const forced_span at = make_span(run->scene, run->base.time_s, time_s, run->k_max);
  for (size_t i = 0; i < run->n_terms; i++) add_part(&to, &run->term[i], &at);
  settle(&to);
  return to;
}

static rot_axle_point point_of(const rot_axle_state *x) {
  return (rot_axle_point){x->theta_rad, x->omega_rad_per_s, x->theta_error, x->omega_error, 0.0};
}

static void state_at(const void *model, double time_s, rot_axle_point *state) {
  const rot_axle_state at = move(model, time_s);
  *state = point_of(&at);
}

/* Next break or knot beyond t in the direction of stepping; +-Inf: none. */
static double next_stop(const rot_axle_scene *scene, double t, int forward,
                        const rot_torque_piece *piece) {
  const size_t n = scene->n_breaks, k = rot_bound(n, scene->breaks_s, t, forward);
  if (forward) return k < n ? fmin(scene->breaks_s[k], piece->end_s) : piece->end_s;
  return k > 0 ? fmax(scene->breaks_s[k - 1], piece->start_s) : piece->start_s;
}

/* base => piece beyond it, constants of its terms. */
static void enter_piece(forced_run *run) {
  const rot_axle_scene *scene = run->scene;
  const double base_s = run->base.time_s;
  const rot_torque *knots = &scene->linear.torque;
  run->piece = rot_torque_piece_at(knots, rot_torque_find(knots, base_s, run->forward));
  run->end_s = next_stop(scene, base_s, run->forward, &run->piece);
  run->n_terms = 0;
  run->k_max = 0;
  for (size_t i = 0; i < scene->n_terms; i++) {
    forced_term *f = &run->term[run->n_terms];
    prepare(f, scene, &scene->terms[i], base_s, run->forward ? base_s : run->end_s);
    if (!f->term) continue;
    run->n_terms++;
    if (f->degree + 2 > run->k_max && f->degree >= 0) run->k_max = f->degree + 2;
  }
}

static void restart(void *model, int forward) {
  forced_run *run = model;
  run->forward = forward;
  run->base = rot_axle_start(&run->scene->linear);
  enter_piece(run);
}

static double piece_end(const void *model) { return ((const forced_run *)model)->end_s; }

static void next_piece(void *model, rot_axle_point *at_end) {
  forced_run *run = model;
  run->base = move(run, run->end_s);
  *at_end = point_of(&run->base);
  enter_piece(run);
}

rot_status rot_axle_forced(const rot_axle_scene *scene, size_t n, const double time_s[],
                           const rot_axle_columns *out, rot_events *events, const rot_hooks *hooks,
                           rot_info *info) {
  static const rot_axle_pieces pieces = {restart, piece_end, next_piece, state_at};
  (void)events; /* no event can occur */
  rot_info_clear(info, rot_turning);
  info->time_s = scene->linear.start_s;
  if (!rot_axle_forced_fits(scene)) return info->status = ROT_EVALUE;
  forced_run run = {.scene = scene};
  run.term = malloc((scene->n_terms ? scene->n_terms : 1) * sizeof *run.term);
  if (!run.term) return info->status = ROT_ENOMEM;
  rot_axle_by_pieces(scene, &pieces, &run, n, time_s, out, hooks, info);
  free(run.term);
  return info->status;
}
