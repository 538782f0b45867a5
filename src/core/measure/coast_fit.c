#include "measure/coast_fit.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "maths/trust_region.h"

enum { P = ROT_COAST_PARAMETERS, ALL = ROT_COAST_ALL };

typedef struct work {
  const rot_coast_record *record;
  const rot_noise *noise;
  size_t columns;                            /* fitted parameters */
  int column[ALL];                           /* their indices */
  double p[ALL];                             /* all parameters */
  double *theta, *omega, *d_theta, *d_omega; /* motion and derivatives at the samples */
  double *j;                                 /* Jacobian, n rows of `columns` */
  double *r;                                 /* model - data */
  double *memory;
} work;

/* Allocates the work space; w->memory is to be freed. */
static rot_status work_begin(work *w, const rot_coast_record *record, const int fitted[],
                             const double p[], const rot_noise *noise) {
  const size_t n = record->n;
  w->record = record;
  w->noise = noise;
  w->columns = 0;
  for (int i = 0; i < ALL; i++) {
    if (fitted[i]) w->column[w->columns++] = i;
  }
  memcpy(w->p, p, sizeof w->p);
  w->memory = malloc(n * (3 + 2 * P + ALL) * sizeof(double));
  if (!w->memory) return ROT_ENOMEM;
  w->theta = w->memory;
  w->omega = w->theta + n;
  w->r = w->omega + n;
  w->d_theta = w->r + n;
  w->d_omega = w->d_theta + n * P;
  w->j = w->d_omega + n * P;
  return ROT_OK;
}

/* ---- residuals ------------------------------------------------------------------------------ */

/* angle x => runout, its first and second derivatives by x, its derivatives by the amplitudes */
static double runout(const double p[], double x, double *slope, double *bend, double column[]) {
  double sum = 0.0;
  *slope = *bend = 0.0;
  for (int h = 1; h <= ROT_COAST_HARMONICS; h++) {
    const double c = cos(h * x), s = sin(h * x);
    const double a = p[ROT_COAST_RUNOUT + 2 * h - 2], b = p[ROT_COAST_RUNOUT + 2 * h - 1];
    sum += a * c + b * s;
    *slope += h * (b * c - a * s);
    *bend -= h * h * (a * c + b * s);
    column[2 * h - 2] = c;
    column[2 * h - 1] = s;
  }
  return sum;
}

/* => model - data at row i; d (or NULL): its derivatives by all parameters */
static double residual_at(const work *w, size_t i, int uneven, double d[ALL]) {
  const rot_coast_record *record = w->record;
  const double theta = w->theta[i], omega = w->omega[i], y = record->y[i];
  double slope = 0.0, bend = 0.0, wave[2 * ROT_COAST_HARMONICS] = {0}, extra = 0.0, r = 0.0;
  const double *x = d ? w->d_theta + i * P : NULL, *s = d ? w->d_omega + i * P : NULL;
  /* A pulse has a known angle: the runout is evaluated there, without the model's error. */
  const double at = record->kind == ROT_COAST_PULSES ? y : theta;
  if (uneven) extra = runout(w->p, at, &slope, &bend, wave);
  if (record->kind == ROT_COAST_PULSES) slope = 0.0;
  switch (record->kind) {
  case ROT_COAST_ANGLES:
    r = theta + extra - y;
    for (int j = 0; d && j < P; j++) d[j] = x[j] * (1.0 + slope);
    for (int j = 0; d && j < 2 * ROT_COAST_HARMONICS; j++) d[P + j] = wave[j];
    break;
  case ROT_COAST_RATES:
    r = omega * (1.0 + slope) - y;
    for (int j = 0; d && j < P; j++) d[j] = s[j] * (1.0 + slope) + omega * bend * x[j];
    for (int h = 1; d && h <= ROT_COAST_HARMONICS; h++) {
      d[P + 2 * h - 2] = -omega * h * wave[2 * h - 1];
      d[P + 2 * h - 1] = omega * h * wave[2 * h - 2];
    }
    break;
  case ROT_COAST_PULSES:
    /* Residual in time: one Newton step from the time of the pulse. */
    r = (theta + extra - y) / omega;
    for (int j = 0; d && j < P; j++) d[j] = (x[j] * (1.0 + slope) - r * s[j]) / omega;
    for (int j = 0; d && j < 2 * ROT_COAST_HARMONICS; j++) d[P + j] = wave[j] / omega;
    break;
  }
  return r;
}

static int is_uneven(const work *w) {
  for (int j = P; j < ALL; j++) {
    if (w->p[j] != 0.0) return 1;
  }
  return w->columns > 0 && w->column[w->columns - 1] >= P;
}

static rot_status rows_of(work *w, int derivatives) {
  const rot_coast_record *c = w->record;
  return rot_coast_rows(&c->load, w->p, c->t[0], c->n, c->t, w->theta, w->omega,
                        derivatives ? w->d_theta : NULL, derivatives ? w->d_omega : NULL);
}

static void weigh(const work *w, size_t columns, double x[]) {
  const rot_coast_record *c = w->record;
  for (size_t i = 0; c->weight && i < c->n * columns; i++) x[i] /= c->weight[i / columns];
}

/* Rows of samples by their weights, without the correlation of the noise. */
static rot_status whiten(const work *w, size_t columns, double x[]) {
  weigh(w, columns, x);
  return rot_whiten(w->noise, w->record->n, w->record->t, columns, x, NULL);
}

/* w->p => residuals and Jacobian, not whitened */
static rot_status linearise(work *w) {
  const rot_status status = rows_of(w, 1);
  const int uneven = is_uneven(w);
  double d[ALL];
  if (status != ROT_OK) return status;
  for (size_t i = 0; i < w->record->n; i++) {
    w->r[i] = residual_at(w, i, uneven, d);
    for (size_t j = 0; j < w->columns; j++) w->j[i * w->columns + j] = d[w->column[j]];
  }
  return ROT_OK;
}

static void take(work *w, const double x[]) {
  for (size_t j = 0; j < w->columns; j++) w->p[w->column[j]] = x[j];
}

static rot_status call_residual(const double x[], double r[], void *ctx) {
  work *w = ctx;
  const size_t n = w->record->n;
  take(w, x);
  const rot_status status = rows_of(w, 0);
  const int uneven = is_uneven(w);
  for (size_t i = 0; i < n && status == ROT_OK; i++) r[i] = residual_at(w, i, uneven, NULL);
  return status == ROT_OK ? whiten(w, 1, r) : status;
}

static rot_status call_jacobian(const double x[], double j[], void *ctx) {
  work *w = ctx;
  const size_t n = w->record->n, m = w->columns;
  take(w, x);
  rot_status status = linearise(w);
  if (status == ROT_OK) status = whiten(w, m, w->j);
  if (status == ROT_OK) memcpy(j, w->j, n * m * sizeof *j);
  return status;
}

/* ---- the fit -------------------------------------------------------------------------------- */

/* => smallest s.d. of the residuals that the rounding of the data allows */
static double rounding_of(const rot_coast_record *record) {
  double largest = 0.0;
  const double *y = record->kind == ROT_COAST_PULSES ? record->t : record->y;
  for (size_t i = 0; i < record->n; i++) largest = fmax(largest, fabs(y[i]));
  return 4.0 * DBL_EPSILON * largest;
}

static void put_result(const work *w, const double x[], const rot_squares *found,
                       rot_coast_fit *fit) {
  const size_t m = w->columns;
  memset(fit->covariance, 0, sizeof fit->covariance);
  memset(fit->factor, 0, sizeof fit->factor);
  for (size_t i = 0; i < m; i++) {
    fit->p[w->column[i]] = x[i];
    for (size_t j = 0; j < m; j++) {
      fit->covariance[w->column[i]][w->column[j]] = found->covariance[i * m + j];
      fit->factor[w->column[i]][j] = found->factor[i * m + j];
    }
  }
  fit->squares = found->squares;
  fit->sigma = found->sigma;
  fit->condition = found->condition;
}

rot_status rot_coast_solve(const rot_coast_record *record, const int fitted[ROT_COAST_ALL],
                           const rot_hooks *hooks, rot_coast_fit *fit) {
  work w;
  rot_status status = work_begin(&w, record, fitted, fit->p, &fit->reml.noise);
  if (status != ROT_OK) return status;
  double x[ALL], covariance[ALL * ALL], factor[ALL * ALL];
  rot_squares found = {.iterations = fit->iterations, .covariance = covariance, .factor = factor};
  const rot_squares_problem problem = {record->n, w.columns,           call_residual, call_jacobian,
                                       &w,        rounding_of(record), 1e-12};
  fit->free = w.columns;
  for (size_t j = 0; j < w.columns; j++) x[j] = fit->p[w.column[j]];
  status = rot_squares_solve(&problem, hooks, x, &found);
  fit->iterations = found.iterations;
  if (status == ROT_OK) put_result(&w, x, &found, fit);
  free(w.memory);
  return status;
}

/* ---- noise and runout ------------------------------------------------------------------------ */

/* => F statistic and amplitudes of harmonics that are not fitted, for the fit's noise */
static void test_runout(work *w, const int fitted[], rot_coast_fit *fit) {
  const rot_coast_record *record = w->record;
  const size_t n = record->n;
  int with[ALL];
  work all;
  fit->runout_f = NAN;
  fit->runout_columns = 0;
  fit->runout_size[0] = fit->runout_size[1] = NAN;
  if (fabs(w->theta[n - 1] - w->theta[0]) < 6.2831853 * 1.5) return;
  memcpy(with, fitted, sizeof with);
  for (int j = P; j < ALL; j++) {
    if (fitted[j]) return;
    with[j] = 1;
  }
  if (n < w->columns + 12 || work_begin(&all, record, with, fit->p, &fit->reml.noise) != ROT_OK) {
    return;
  }
  const size_t m = all.columns;
  if (linearise(&all) == ROT_OK && whiten(&all, m, all.j) == ROT_OK &&
      whiten(&all, 1, all.r) == ROT_OK) {
    /* Gram-Schmidt: sums of squares explained by each column in turn. */
    double explained = 0.0, rest = 0.0, coefficient[ALL] = {0}, r[ALL][ALL] = {{0}};
    double size[ALL] = {0};
    for (size_t j = 0; j < m; j++) {
      for (size_t i = 0; i < n; i++) size[j] += all.j[i * m + j] * all.j[i * m + j];
    }
    for (size_t j = 0; j < m; j++) {
      double after = 0.0, dot = 0.0, before = size[j];
      /* A sine that is zero at each pulse is at rounding level compared with its cosine. */
      if (all.column[j] >= P) before += size[(all.column[j] - P) % 2 == 0 ? j + 1 : j - 1];
      for (int round = 0; round < 2; round++) {
        for (size_t k = 0; k < j; k++) {
          double part = 0.0;
          for (size_t i = 0; i < n; i++) part += all.j[i * m + k] * all.j[i * m + j];
          for (size_t i = 0; i < n; i++) all.j[i * m + j] -= part * all.j[i * m + k];
          r[k][j] += part;
        }
      }
      for (size_t i = 0; i < n; i++) after += all.j[i * m + j] * all.j[i * m + j];
      if (!(after > 1e-16 * before)) {
        for (size_t i = 0; i < n; i++) all.j[i * m + j] = 0.0;
        r[j][j] = 0.0;
        continue;
      }
      r[j][j] = sqrt(after);
      for (size_t i = 0; i < n; i++) all.j[i * m + j] /= r[j][j];
      for (size_t i = 0; i < n; i++) dot += all.j[i * m + j] * all.r[i];
      for (size_t i = 0; i < n; i++) all.r[i] -= dot * all.j[i * m + j];
      coefficient[j] = dot;
      if (all.column[j] >= P) {
        explained += dot * dot;
        fit->runout_columns++;
      }
    }
    for (size_t i = 0; i < n; i++) rest += all.r[i] * all.r[i];
    for (size_t j = m; j-- > 0;) {
      for (size_t k = j + 1; k < m; k++) coefficient[j] -= r[j][k] * coefficient[k];
      coefficient[j] = r[j][j] > 0.0 ? coefficient[j] / r[j][j] : 0.0;
    }
    for (int h = 0; h < ROT_COAST_HARMONICS; h++) {
      const size_t at = m - 2 * ROT_COAST_HARMONICS + 2 * (size_t)h;
      fit->runout_size[h] = hypot(coefficient[at], coefficient[at + 1]);
    }
    /* A harmonic needs two columns; one or two pulses per turn give fewer. */
    if (fit->runout_columns > 1 && rest > 0.0) {
      fit->runout_f = explained / (double)fit->runout_columns /
                      (rest / (double)(n - w->columns - fit->runout_columns));
    }
  }
  free(all.memory);
}

static int settled(const rot_noise *a, const rot_noise *b) {
  if (!(a->tau_s > 0.0) || !(b->tau_s > 0.0)) return !(a->tau_s > 0.0) && !(b->tau_s > 0.0);
  return fabs(log(a->tau_s / b->tau_s)) < 0.05 && fabs(a->white - b->white) < 0.01;
}

rot_status rot_coast_fit_noise(const rot_coast_record *record, const int fitted[ROT_COAST_ALL],
                               double threshold, const rot_hooks *hooks, rot_coast_fit *fit,
                               double residual[], double white[]) {
  work w;
  const size_t n = record->n;
  const double cap = n > 1 ? 0.1 * (record->t[n - 1] - record->t[0]) : 0.0;
  fit->reml = (rot_reml){{0.0, 1.0}, 0.0, 0.0, 0, 0};
  fit->iterations = 0;
  rot_status status = rot_coast_solve(record, fitted, hooks, fit);
  if (status != ROT_OK) return status;
  status = work_begin(&w, record, fitted, fit->p, &fit->reml.noise);
  if (status != ROT_OK) return status;
  const double rounding = rounding_of(record);
  for (int round = 0; round < 4 && status == ROT_OK; round++) {
    memcpy(w.p, fit->p, sizeof w.p);
    status = linearise(&w);
    /* Residuals at rounding level: the noise is undetermined. */
    if (status != ROT_OK || fit->sigma <= 4.0 * rounding) break;
    const rot_reml last = fit->reml;
    weigh(&w, 1, w.r);
    weigh(&w, w.columns, w.j);
    status = rot_whiten_reml(n, record->t, w.columns, w.j, w.r, cap, threshold,
                             last.noise.tau_s > 0.0 ? &last.noise : NULL, hooks, &fit->reml);
    if (status != ROT_OK || settled(&last.noise, &fit->reml.noise)) break;
    status = rot_coast_solve(record, fitted, hooks, fit);
  }
  if (status == ROT_OK) {
    memcpy(w.p, fit->p, sizeof w.p);
    status = linearise(&w);
  }
  if (status == ROT_OK) {
    for (size_t i = 0; residual && i < n; i++) residual[i] = -w.r[i];
    status = whiten(&w, 1, w.r);
    for (size_t i = 0; white && i < n; i++) white[i] = -w.r[i] / fit->sigma;
    test_runout(&w, fitted, fit);
  }
  free(w.memory);
  return status;
}

/* ---- losses >= 0 ----------------------------------------------------------------------------- */

/* (a, y) => x of a x = y in y; a symmetric positive definite, up to 3 x 3 */
static void solve_small(size_t n, double a[3][3], double y[3]) {
  for (size_t j = 0; j < n; j++) {
    for (size_t i = j + 1; i < n; i++) {
      const double f = a[i][j] / a[j][j];
      for (size_t k = j; k < n; k++) a[i][k] -= f * a[j][k];
      y[i] -= f * y[j];
    }
  }
  for (size_t j = n; j-- > 0;) {
    for (size_t k = j + 1; k < n; k++) y[j] -= a[j][k] * y[k];
    y[j] /= a[j][j];
  }
}

/* (fit, losses to fix at 0 as bits) => p at the minimum of the quadratic model with them at 0, its
 * increase of the sum of squares */
static double hold(const rot_coast_fit *fit, int set, double p[ALL]) {
  int at[3], held = 0;
  double a[3][3] = {{0}}, y[3] = {0}, cost = 0.0;
  for (int i = 0; i < 3; i++) {
    if (set >> i & 1) at[held++] = ROT_COAST_COULOMB + i;
  }
  for (int i = 0; i < held; i++) {
    for (int j = 0; j < held; j++) a[i][j] = fit->covariance[at[i]][at[j]];
    y[i] = fit->p[at[i]];
  }
  solve_small((size_t)held, a, y);
  for (int i = 0; i < held; i++) cost += y[i] * fit->p[at[i]];
  for (int k = 0; k < ALL; k++) {
    p[k] = fit->p[k];
    for (int j = 0; j < held; j++) p[k] -= fit->covariance[k][at[j]] * y[j];
  }
  for (int i = 0; i < held; i++) p[at[i]] = 0.0;
  return cost;
}

/* => set of losses fixed at 0 (bits) with the smallest increase of the quadratic model, among the
 * sets for which no other loss is negative */
static int choose_held(const rot_coast_fit *fit, const int fitted[]) {
  int all = 0;
  for (int i = 0; i < 3; i++) all |= fitted[ROT_COAST_COULOMB + i] ? 1 << i : 0;
  int best = all;
  double min = INFINITY;
  for (int set = 0; set <= all; set++) {
    double p[ALL];
    int inside = 1;
    if (set & ~all) continue;
    const double cost = hold(fit, set, p);
    for (int i = 0; i < 3; i++) {
      const int k = ROT_COAST_COULOMB + i;
      if (fitted[k] && p[k] < 0.0) inside = 0;
    }
    if (inside && cost < min) {
      min = cost;
      best = set;
    }
  }
  return best;
}

rot_status rot_coast_bound(const rot_coast_record *record, const int fitted[ROT_COAST_ALL],
                           const rot_hooks *hooks, rot_coast_fit *fit, int at_bound[3]) {
  int some[ALL], set = 0;
  rot_status status = ROT_OK;
  memset(at_bound, 0, 3 * sizeof *at_bound);
  for (int turn = 0; turn < 4 && status == ROT_OK; turn++) {
    int below = 0;
    for (int i = 0; i < 3; i++) {
      if (fitted[ROT_COAST_COULOMB + i] && fit->p[ROT_COAST_COULOMB + i] < 0.0) below |= 1 << i;
    }
    if (!below) break;
    if (turn == 0) below = choose_held(fit, fitted);
    set |= below;
    /* With a loss at 0 the others may be far from where they were: the fit starts at the minimum
     * of the quadratic model. */
    double p[ALL];
    hold(fit, below, p);
    memcpy(fit->p, p, sizeof p);
    memcpy(some, fitted, sizeof some);
    for (int i = 0; i < 3; i++) {
      at_bound[i] = set >> i & 1;
      if (at_bound[i]) some[ROT_COAST_COULOMB + i] = 0;
    }
    status = rot_coast_solve(record, some, hooks, fit);
  }
  return status;
}
