#include "measure/coast_fit.h"

#include <float.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_multifit_nlinear.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

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

static void take(work *w, const gsl_vector *x) {
  for (size_t j = 0; j < w->columns; j++) w->p[w->column[j]] = gsl_vector_get(x, j);
}

/* Residual where the motion cannot be computed: the solver rejects the step. */
static const double REFUSED = 1e100;

static int call_f(const gsl_vector *x, void *data, gsl_vector *f) {
  work *w = data;
  const size_t n = w->record->n;
  take(w, x);
  int fits = rows_of(w, 0) == ROT_OK;
  const int uneven = is_uneven(w);
  for (size_t i = 0; i < n && fits; i++) {
    w->r[i] = residual_at(w, i, uneven, NULL);
    fits = fabs(w->r[i]) < REFUSED;
  }
  if (fits) fits = rot_whiten(w->noise, n, w->record->t, 1, w->r, NULL) == ROT_OK;
  for (size_t i = 0; i < n; i++) gsl_vector_set(f, i, fits ? w->r[i] : REFUSED);
  return GSL_SUCCESS;
}

static int call_df(const gsl_vector *x, void *data, gsl_matrix *jacobian) {
  work *w = data;
  const size_t n = w->record->n, m = w->columns;
  take(w, x);
  if (linearise(w) != ROT_OK) return GSL_EFAILED;
  if (rot_whiten(w->noise, n, w->record->t, m, w->j, NULL) != ROT_OK) return GSL_EFAILED;
  for (size_t i = 0; i < n; i++)
    memcpy(jacobian->data + i * jacobian->tda, w->j + i * m, m * sizeof(double));
  return GSL_SUCCESS;
}

/* ---- the fit -------------------------------------------------------------------------------- */

enum { MAX_STEPS = 60 };

/* step dx => |J dx|; its square is the predicted decrease of the sum of squares */
static double step_size(const gsl_matrix *jacobian, const gsl_vector *dx) {
  double sum = 0.0;
  for (size_t i = 0; i < jacobian->size1; i++) {
    double change = 0.0;
    for (size_t j = 0; j < jacobian->size2; j++) {
      change += gsl_matrix_get(jacobian, i, j) * gsl_vector_get(dx, j);
    }
    sum += change * change;
  }
  return sqrt(sum);
}

static double size_of(const gsl_vector *x) {
  double sum = 0.0;
  for (size_t i = 0; i < x->size; i++) sum += gsl_vector_get(x, i) * gsl_vector_get(x, i);
  return sqrt(sum);
}

/* => smallest s.d. of the residuals that the rounding of the data allows */
static double rounding_of(const rot_coast_record *record) {
  double largest = 0.0;
  const double *y = record->kind == ROT_COAST_PULSES ? record->t : record->y;
  for (size_t i = 0; i < record->n; i++) largest = fmax(largest, fabs(y[i]));
  return 4.0 * DBL_EPSILON * largest;
}

/* J => covariance and its factor, condition number of J with columns of length 1; from its R factor
 */
static rot_status invert(const gsl_matrix *jacobian, double sigma, const work *w,
                         rot_coast_fit *fit) {
  const size_t n = jacobian->size1, m = jacobian->size2;
  double r[ALL][ALL] = {{0}}, inverse[ALL][ALL] = {{0}}, length[ALL];
  double *q = malloc(n * m * sizeof *q);
  if (!q) return ROT_ENOMEM;
  for (size_t j = 0; j < m; j++) {
    double sum = 0.0;
    for (size_t i = 0; i < n; i++) sum += pow(gsl_matrix_get(jacobian, i, j), 2);
    length[j] = sum > 0.0 ? sqrt(sum) : 1.0;
    for (size_t i = 0; i < n; i++) q[j * n + i] = gsl_matrix_get(jacobian, i, j) / length[j];
  }
  /* Modified Gram-Schmidt, each column twice: R is as accurate as with reflections. */
  for (size_t j = 0; j < m; j++) {
    for (int round = 0; round < 2; round++) {
      for (size_t k = 0; k < j; k++) {
        double dot = 0.0;
        for (size_t i = 0; i < n; i++) dot += q[k * n + i] * q[j * n + i];
        for (size_t i = 0; i < n; i++) q[j * n + i] -= dot * q[k * n + i];
        r[k][j] += dot;
      }
    }
    double sum = 0.0;
    for (size_t i = 0; i < n; i++) sum += q[j * n + i] * q[j * n + i];
    r[j][j] = sqrt(sum);
    for (size_t i = 0; i < n && sum > 0.0; i++) q[j * n + i] /= r[j][j];
  }
  free(q);
  /* Frobenius norms of R and of its inverse: an upper bound within a factor m. */
  double norm = 0.0, inverse_norm = 0.0;
  for (size_t j = 0; j < m; j++) {
    for (size_t i = j + 1; i-- > 0;) {
      double sum = i == j ? 1.0 : 0.0;
      for (size_t k = i + 1; k <= j; k++) sum -= r[i][k] * inverse[k][j];
      inverse[i][j] = sum / r[i][i];
      norm += r[i][j] * r[i][j];
      inverse_norm += inverse[i][j] * inverse[i][j];
    }
  }
  fit->condition = sqrt(norm * inverse_norm);
  memset(fit->covariance, 0, sizeof fit->covariance);
  memset(fit->factor, 0, sizeof fit->factor);
  for (size_t i = 0; i < m; i++) {
    for (size_t j = i; j < m; j++) {
      fit->factor[w->column[i]][j] = sigma * inverse[i][j] / length[i];
    }
    for (size_t j = 0; j <= i; j++) {
      const double *a = fit->factor[w->column[i]], *b = fit->factor[w->column[j]];
      double sum = 0.0;
      for (size_t k = i; k < m; k++) sum += a[k] * b[k];
      fit->covariance[w->column[i]][w->column[j]] = sum;
      fit->covariance[w->column[j]][w->column[i]] = sum;
    }
  }
  return ROT_OK;
}

/* => size of the full Gauss-Newton step in the residuals: the norm of their projection on the span
 * of the Jacobian's columns */
static rot_status promised(const gsl_matrix *jacobian, const gsl_vector *residual, double *size) {
  const size_t n = jacobian->size1, m = jacobian->size2;
  double *q = malloc(n * m * sizeof *q), sum = 0.0;
  if (!q) return ROT_ENOMEM;
  for (size_t j = 0; j < m; j++) {
    double *column = q + j * n, length = 0.0, along = 0.0;
    for (size_t i = 0; i < n; i++) {
      column[i] = gsl_matrix_get(jacobian, i, j);
      length += column[i] * column[i];
    }
    const double before = sqrt(length);
    for (size_t k = 0; k < 2 * j; k++) { /* twice: the columns are nearly dependent */
      const double *other = q + (k % j) * n;
      double dot = 0.0;
      for (size_t i = 0; i < n; i++) dot += other[i] * column[i];
      for (size_t i = 0; i < n; i++) column[i] -= dot * other[i];
    }
    length = 0.0;
    for (size_t i = 0; i < n; i++) length += column[i] * column[i];
    length = sqrt(length);
    const double scale = length > 1e-12 * before ? 1.0 / length : 0.0;
    for (size_t i = 0; i < n; i++) {
      column[i] *= scale;
      along += column[i] * gsl_vector_get(residual, i);
    }
    sum += along * along;
  }
  free(q);
  *size = sqrt(sum);
  return ROT_OK;
}

/* Iterates until a step is below 1e-4 standard errors, and the full step below one. */
static rot_status iterate(gsl_multifit_nlinear_workspace *g, const work *w, double rounding,
                          const rot_hooks *hooks, rot_coast_fit *fit) {
  const size_t n = w->record->n, m = w->columns;
  for (int step = 0; step < MAX_STEPS; step++) {
    const rot_status status = rot_poll(hooks, 0.5);
    if (status != ROT_OK) return status;
    const int code = gsl_multifit_nlinear_iterate(g);
    if (code != GSL_SUCCESS && code != GSL_ENOPROG) return ROT_ERANGE;
    if (code == GSL_SUCCESS) fit->iterations++;
    const gsl_matrix *jacobian = gsl_multifit_nlinear_jac(g);
    const gsl_vector *residual = gsl_multifit_nlinear_residual(g);
    const double sigma = size_of(residual) / sqrt((double)(n - m));
    /* 1e-4 standard errors, or rounding. */
    if (code == GSL_SUCCESS && step_size(jacobian, g->dx) > fmax(1e-4 * sigma, 0.1 * rounding))
      continue;
    /* A step is short at the minimum or in a small trust region; in the latter case the full step
     * is long. For nearly dependent columns it remains a fraction of a standard error. */
    double size;
    const rot_status found = promised(jacobian, residual, &size);
    if (found != ROT_OK) return found;
    if (size <= fmax(sigma, rounding * sqrt((double)n))) return ROT_OK;
    if (code == GSL_ENOPROG) return ROT_EBUDGET;
  }
  return ROT_EBUDGET;
}

/* fit->p => fit, by one trust-region method of GSL */
static rot_status solve_by(const gsl_multifit_nlinear_trs *trs, double shrink, work *w,
                           const rot_hooks *hooks, rot_coast_fit *fit) {
  const size_t n = w->record->n;
  const double rounding = rounding_of(w->record);
  gsl_multifit_nlinear_parameters how = gsl_multifit_nlinear_default_parameters();
  how.trs = trs;
  how.scale = gsl_multifit_nlinear_scale_more;
  how.solver = gsl_multifit_nlinear_solver_qr;
  how.factor_down = shrink;
  gsl_multifit_nlinear_fdf fdf;
  memset(&fdf, 0, sizeof fdf);
  fdf.f = call_f;
  fdf.df = call_df;
  fdf.n = n;
  fdf.p = w->columns;
  fdf.params = w;
  gsl_multifit_nlinear_workspace *g =
      gsl_multifit_nlinear_alloc(gsl_multifit_nlinear_trust, &how, n, w->columns);
  gsl_vector *start = gsl_vector_alloc(w->columns);
  rot_status status = g && start ? ROT_OK : ROT_ENOMEM;
  if (status == ROT_OK) {
    for (size_t j = 0; j < w->columns; j++) gsl_vector_set(start, j, fit->p[w->column[j]]);
    if (gsl_multifit_nlinear_init(start, &fdf, g) != GSL_SUCCESS) status = ROT_ERANGE;
  }
  if (status == ROT_OK) status = iterate(g, w, rounding, hooks, fit);
  if (status == ROT_OK) {
    const double size = size_of(gsl_multifit_nlinear_residual(g));
    take(w, gsl_multifit_nlinear_position(g));
    memcpy(fit->p, w->p, sizeof fit->p);
    fit->squares = size * size;
    fit->sigma = fmax(size / sqrt((double)(n - w->columns)), rounding);
    /* Rounding errors are equal for all samples: they do not average out. */
    status =
        invert(gsl_multifit_nlinear_jac(g), fmax(fit->sigma, rounding * sqrt((double)n)), w, fit);
  }
  if (g) gsl_multifit_nlinear_free(g);
  if (start) gsl_vector_free(start);
  return status;
}

/* The dogleg method needs half the steps of Levenberg and Marquardt's from a start near the
 * solution. With nearly dependent columns it may fail where the latter converges. */
rot_status rot_coast_solve(const rot_coast_record *record, const int fitted[ROT_COAST_ALL],
                           const rot_hooks *hooks, rot_coast_fit *fit) {
  work w;
  rot_status status = work_begin(&w, record, fitted, fit->p, &fit->reml.noise);
  if (status != ROT_OK) return status;
  fit->free = w.columns;
  if (record->n <= w.columns || w.columns == 0) {
    status = ROT_EVALUE;
  } else {
    status = solve_by(gsl_multifit_nlinear_trs_dogleg, 2.0, &w, hooks, fit);
    if (status == ROT_EBUDGET || status == ROT_ERANGE) {
      memcpy(w.p, fit->p, sizeof w.p);
      status = solve_by(gsl_multifit_nlinear_trs_lm, 8.0, &w, hooks, fit);
    }
  }
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
  if (linearise(&all) == ROT_OK && rot_whiten(all.noise, n, record->t, m, all.j, NULL) == ROT_OK &&
      rot_whiten(all.noise, n, record->t, 1, all.r, NULL) == ROT_OK) {
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
                               double residual[]) {
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

/* => set of losses fixed at 0 (bits) with the smallest increase of the quadratic model, among the
 * sets for which no other loss is negative */
static int choose_held(const rot_coast_fit *fit, const int fitted[], int min_set) {
  int best = 7;
  double min = INFINITY;
  for (int set = 0; set < 8; set++) {
    int at[3], held = 0, inside = 1;
    if ((set & min_set) != min_set) continue;
    for (int i = 0; i < 3; i++) {
      if (!(set >> i & 1)) continue;
      if (!fitted[ROT_COAST_COULOMB + i]) inside = 0;
      at[held++] = ROT_COAST_COULOMB + i;
    }
    if (!inside) continue;
    double a[3][3] = {{0}}, y[3] = {0}, cost = 0.0;
    for (int i = 0; i < held; i++) {
      for (int j = 0; j < held; j++) a[i][j] = fit->covariance[at[i]][at[j]];
      y[i] = fit->p[at[i]];
    }
    solve_small((size_t)held, a, y);
    for (int i = 0; i < held; i++) cost += y[i] * fit->p[at[i]];
    for (int i = 0; i < 3; i++) {
      const int k = ROT_COAST_COULOMB + i;
      double value = fit->p[k];
      if (!fitted[k] || set >> i & 1) continue;
      for (int j = 0; j < held; j++) value -= fit->covariance[k][at[j]] * y[j];
      if (value < 0.0) inside = 0;
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
  const rot_coast_fit free_fit = *fit;
  rot_status status = ROT_OK;
  memset(at_bound, 0, 3 * sizeof *at_bound);
  for (int turn = 0; turn < 4 && status == ROT_OK; turn++) {
    int below = 0;
    for (int i = 0; i < 3; i++) {
      if (fitted[ROT_COAST_COULOMB + i] && fit->p[ROT_COAST_COULOMB + i] < 0.0) below |= 1 << i;
    }
    if (!below) break;
    set = turn == 0 ? choose_held(&free_fit, fitted, 0) : set | below;
    memcpy(some, fitted, sizeof some);
    for (int i = 0; i < 3; i++) {
      at_bound[i] = set >> i & 1 && fitted[ROT_COAST_COULOMB + i];
      if (!at_bound[i]) continue;
      fit->p[ROT_COAST_COULOMB + i] = 0.0;
      some[ROT_COAST_COULOMB + i] = 0;
    }
    status = rot_coast_solve(record, some, hooks, fit);
  }
  return status;
}
