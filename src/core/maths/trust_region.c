#include "maths/trust_region.h"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_multifit_nlinear.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_STEPS = 60 };

/* Residual where there is none: the solver rejects the step. */
static const double REFUSED = 1e100;

static int call_f(const gsl_vector *x, void *data, gsl_vector *f) {
  const rot_squares_problem *of = data;
  int fits = of->residual(x->data, f->data, of->ctx) == ROT_OK;
  for (size_t i = 0; i < of->n && fits; i++) fits = fabs(f->data[i]) < REFUSED;
  for (size_t i = 0; i < of->n && !fits; i++) f->data[i] = REFUSED;
  return GSL_SUCCESS;
}

/* GSL's matrix has rows of p numbers without gaps: it allocates it so. */
static int call_df(const gsl_vector *x, void *data, gsl_matrix *jacobian) {
  const rot_squares_problem *of = data;
  if (jacobian->tda != of->p) return GSL_EFAILED;
  return of->jacobian(x->data, jacobian->data, of->ctx) == ROT_OK ? GSL_SUCCESS : GSL_EFAILED;
}

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

/* R and its inverse, of columns of length 1, and these lengths. */
typedef struct triangle {
  double *r, *inverse, *length, *q;
} triangle;

/* Modified Gram-Schmidt, each column twice: R is as accurate as with reflections. */
static void decompose(const gsl_matrix *jacobian, triangle *t) {
  const size_t n = jacobian->size1, m = jacobian->size2;
  double *q = t->q;
  for (size_t j = 0; j < m; j++) {
    double sum = 0.0;
    for (size_t i = 0; i < n; i++) sum += pow(gsl_matrix_get(jacobian, i, j), 2);
    t->length[j] = sum > 0.0 ? sqrt(sum) : 1.0;
    for (size_t i = 0; i < n; i++) q[j * n + i] = gsl_matrix_get(jacobian, i, j) / t->length[j];
  }
  for (size_t j = 0; j < m; j++) {
    for (int round = 0; round < 2; round++) {
      for (size_t k = 0; k < j; k++) {
        double dot = 0.0;
        for (size_t i = 0; i < n; i++) dot += q[k * n + i] * q[j * n + i];
        for (size_t i = 0; i < n; i++) q[j * n + i] -= dot * q[k * n + i];
        t->r[k * m + j] += dot;
      }
    }
    double sum = 0.0;
    for (size_t i = 0; i < n; i++) sum += q[j * n + i] * q[j * n + i];
    t->r[j * m + j] = sqrt(sum);
    for (size_t i = 0; i < n && sum > 0.0; i++) q[j * n + i] /= t->r[j * m + j];
  }
}

/* J => covariance and its factor, condition number of J with columns of length 1; from its R factor
 */
static rot_status invert(const gsl_matrix *jacobian, double sigma, rot_squares *to) {
  double *covariance = to->covariance;
  const size_t n = jacobian->size1, m = jacobian->size2;
  double *memory = calloc(3 * m * m + m + n * m, sizeof *memory);
  if (!memory) return ROT_ENOMEM;
  triangle t = {memory, memory + m * m, memory + 2 * m * m, memory + 2 * m * m + m};
  double *own = memory + 2 * m * m + m + n * m; /* m x m */
  decompose(jacobian, &t);
  /* Frobenius norms of R and of its inverse: an upper bound within a factor m. */
  double norm = 0.0, inverse_norm = 0.0;
  for (size_t j = 0; j < m; j++) {
    for (size_t i = j + 1; i-- > 0;) {
      double sum = i == j ? 1.0 : 0.0;
      for (size_t k = i + 1; k <= j; k++) sum -= t.r[i * m + k] * t.inverse[k * m + j];
      t.inverse[i * m + j] = sum / t.r[i * m + i];
      norm += t.r[i * m + j] * t.r[i * m + j];
      inverse_norm += t.inverse[i * m + j] * t.inverse[i * m + j];
    }
  }
  to->condition = sqrt(norm * inverse_norm);
  for (size_t i = 0; i < m; i++) {
    for (size_t j = i; j < m; j++) own[i * m + j] = sigma * t.inverse[i * m + j] / t.length[i];
    for (size_t j = 0; j <= i && covariance; j++) {
      double sum = 0.0;
      for (size_t k = i; k < m; k++) sum += own[i * m + k] * own[j * m + k];
      covariance[i * m + j] = covariance[j * m + i] = sum;
    }
  }
  if (to->factor) memcpy(to->factor, own, m * m * sizeof *own);
  for (size_t i = 0; i < m && to->triangle; i++) {
    for (size_t j = 0; j < m; j++) to->triangle[i * m + j] = t.r[i * m + j] * t.length[j];
  }
  free(memory);
  return ROT_OK;
}

/* => size of the full Gauss-Newton step in the residuals: the norm of their projection on the span
 * of the Jacobian's columns */
static rot_status promised(const gsl_matrix *jacobian, const gsl_vector *residual, double dependent,
                           double *size) {
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
    const double scale = length > dependent * before ? 1.0 / length : 0.0;
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
static rot_status iterate(gsl_multifit_nlinear_workspace *g, const rot_squares_problem *of,
                          const rot_hooks *hooks, rot_squares *to) {
  const size_t n = of->n, m = of->p;
  for (int step = 0; step < MAX_STEPS; step++) {
    const rot_status status = rot_poll(hooks, 0.5);
    if (status != ROT_OK) return status;
    const int code = gsl_multifit_nlinear_iterate(g);
    if (code != GSL_SUCCESS && code != GSL_ENOPROG) return ROT_ERANGE;
    if (code == GSL_SUCCESS) to->iterations++;
    const gsl_matrix *jacobian = gsl_multifit_nlinear_jac(g);
    const gsl_vector *residual = gsl_multifit_nlinear_residual(g);
    const double sigma = size_of(residual) / sqrt((double)(n - m));
    /* 1e-4 standard errors, or rounding. */
    if (code == GSL_SUCCESS && step_size(jacobian, g->dx) > fmax(1e-4 * sigma, 0.1 * of->rounding))
      continue;
    /* A step is short at the minimum or in a small trust region; in the latter case the full step
     * is long. For nearly dependent columns it remains a fraction of a standard error. */
    double size;
    const rot_status found = promised(jacobian, residual, of->dependent, &size);
    if (found != ROT_OK) return found;
    if (size <= fmax(sigma, of->rounding * sqrt((double)n))) return ROT_OK;
    if (code == GSL_ENOPROG) return ROT_EBUDGET;
  }
  return ROT_EBUDGET;
}

/* By one trust-region method of GSL. */
static rot_status solve_by(const gsl_multifit_nlinear_trs *trs, double shrink,
                           const rot_squares_problem *of, const rot_hooks *hooks, double x[],
                           rot_squares *to) {
  const size_t n = of->n, m = of->p;
  rot_squares_problem problem = *of; /* GSL's data is not const */
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
  fdf.p = m;
  fdf.params = &problem;
  gsl_multifit_nlinear_workspace *g =
      gsl_multifit_nlinear_alloc(gsl_multifit_nlinear_trust, &how, n, m);
  gsl_vector *start = gsl_vector_alloc(m);
  rot_status status = g && start ? ROT_OK : ROT_ENOMEM;
  if (status == ROT_OK) {
    for (size_t j = 0; j < m; j++) gsl_vector_set(start, j, x[j]);
    if (gsl_multifit_nlinear_init(start, &fdf, g) != GSL_SUCCESS) status = ROT_ERANGE;
  }
  if (status == ROT_OK) status = iterate(g, of, hooks, to);
  if (status == ROT_OK) {
    const double size = size_of(gsl_multifit_nlinear_residual(g));
    const gsl_vector *found = gsl_multifit_nlinear_position(g);
    for (size_t j = 0; j < m; j++) x[j] = gsl_vector_get(found, j);
    to->squares = size * size;
    to->sigma = fmax(size / sqrt((double)(n - m)), of->rounding);
    to->size = fmax(to->sigma, of->rounding * sqrt((double)n));
    /* Rounding errors are equal for all samples: they do not average out. */
    status = invert(gsl_multifit_nlinear_jac(g), to->size, to);
  }
  if (g) gsl_multifit_nlinear_free(g);
  if (start) gsl_vector_free(start);
  return status;
}

/* The dogleg method needs half the steps of Levenberg and Marquardt's from a start near the
 * solution. With nearly dependent columns it may fail where the latter converges. */
rot_status rot_squares_solve(const rot_squares_problem *problem, const rot_hooks *hooks, double x[],
                             rot_squares *to) {
  if (problem->n <= problem->p || problem->p == 0) return ROT_EVALUE;
  rot_status status = solve_by(gsl_multifit_nlinear_trs_dogleg, 2.0, problem, hooks, x, to);
  if (status == ROT_EBUDGET || status == ROT_ERANGE) {
    status = solve_by(gsl_multifit_nlinear_trs_lm, 8.0, problem, hooks, x, to);
  }
  return status;
}
