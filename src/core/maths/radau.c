#include "maths/radau.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { STAGES = 5, MAX_ITERATIONS = 12 };

/* Roots of d^4/dx^4 x^4 (x - 1)^5, and the collocation integrals (mpmath, 60 digits). */
static const double node[STAGES] = {0.057104196114517682193, 0.27684301363812382768,
                                    0.58359043236891682006, 0.86024013565621944785, 1.0};
static const double weight[STAGES][STAGES] = {
    {0.072998864317903324306, -0.026735331107945571878, 0.018676929763984354412,
     -0.012879106093306439854, 0.0050428392338820152067},
    {0.15377523147918246867, 0.14621486784749350665, -0.036444568905128089527,
     0.021233063119304719422, -0.0079355799027287775326},
    {0.14006304568480987151, 0.2989671294912834794, 0.16758507013524896344,
     -0.033969101686617746572, 0.010944288744192252274},
    {0.14489430810953475754, 0.27650006876015922756, 0.32579792291042102998, 0.12875675325490976116,
     -0.015708917378805328388},
    {0.14371356079122594132, 0.28135601514946206019, 0.31182652297574125408, 0.2231039010835707444,
     0.04}};
/* In the embedded formula f(t, y) has the weight gamma, the real eigenvalue of the matrix above;
 * spread[]: its difference from the method, as weights of the Z. */
static const double gamma_0 = 0.15906584442746912048;
static const double spread[STAGES] = {-4.4189977167963817226, 0.57923485225667005447,
                                      -0.19923756095346800874, 0.094167483691945488975,
                                      -0.031813168885493824096};

struct rot_radau {
  size_t dim;          /* components of y */
  size_t n;            /* components in the implicit equations, the first ones */
  double t_end, h;     /* end and length of the last step, for the first guess */
  double *stage_slope; /* STAGES x dim */
  double *z, *z_last;  /* STAGES x n: stages of this step and of the last one */
  double *step;        /* STAGES x n: Newton correction */
  double *y, *f;       /* dim: arguments and result of f */
  double *jacobian;    /* n x n */
  double *matrix;      /* (STAGES n)^2, factored */
  double *small;       /* n x n, factored: of the error estimate */
  size_t *pivot, *small_pivot;
};

rot_radau *rot_radau_alloc(size_t dim, size_t controlled) {
  const size_t n = controlled, s = STAGES;
  rot_radau *r = calloc(1, sizeof *r);
  if (!r) return NULL;
  double *x = calloc(s * dim + 3 * s * n + 2 * dim + 2 * n * n + s * s * n * n, sizeof *x);
  r->pivot = calloc((s + 1) * n + 1, sizeof *r->pivot);
  r->stage_slope = x;
  if (!x || !r->pivot) {
    rot_radau_free(r);
    return NULL;
  }
  r->dim = dim;
  r->n = n;
  r->t_end = NAN;
  r->z = x + s * dim;
  r->z_last = r->z + s * n;
  r->step = r->z_last + s * n;
  r->y = r->step + s * n;
  r->f = r->y + dim;
  r->jacobian = r->f + dim;
  r->small = r->jacobian + n * n;
  r->matrix = r->small + n * n;
  r->small_pivot = r->pivot + s * n;
  return r;
}

void rot_radau_free(rot_radau *r) {
  if (!r) return;
  free(r->stage_slope);
  free(r->pivot);
  free(r);
}

/* ---- linear equations ----------------------------------------------------------------------- */

/* LU factors of a in place, partial pivoting; -1: singular. */
static int factor(size_t n, double a[], size_t pivot[]) {
  for (size_t k = 0; k < n; k++) {
    size_t best = k;
    for (size_t i = k + 1; i < n; i++) {
      if (fabs(a[i * n + k]) > fabs(a[best * n + k])) best = i;
    }
    pivot[k] = best;
    if (!(fabs(a[best * n + k]) > 0.0)) return -1;
    for (size_t j = 0; best != k && j < n; j++) {
      const double swap = a[k * n + j];
      a[k * n + j] = a[best * n + j];
      a[best * n + j] = swap;
    }
    for (size_t i = k + 1; i < n; i++) {
      const double m = a[i * n + k] /= a[k * n + k];
      for (size_t j = k + 1; m != 0.0 && j < n; j++) a[i * n + j] -= m * a[k * n + j];
    }
  }
  return 0;
}

static void solve(size_t n, const double a[], const size_t pivot[], double x[]) {
  for (size_t k = 0; k < n; k++) {
    const double swap = x[k];
    x[k] = x[pivot[k]];
    x[pivot[k]] = swap;
  }
  for (size_t i = 0; i < n; i++) {
    for (size_t j = 0; j < i; j++) x[i] -= a[i * n + j] * x[j];
  }
  for (size_t i = n; i-- > 0;) {
    for (size_t j = i + 1; j < n; j++) x[i] -= a[i * n + j] * x[j];
    x[i] /= a[i * n + i];
  }
}

/* ---- the step ------------------------------------------------------------------------------- */

/* Jacobian at (t, y) by differences of f: 1e-8 of each component, or of its change in the step if
 * larger. */
static int differentiate(rot_radau *r, rot_radau_rhs rhs, void *ctx, double t, double h,
                         const double y[], const double slope[], const double allowed[]) {
  const size_t n = r->n;
  memcpy(r->y, y, r->dim * sizeof *y);
  for (size_t j = 0; j < n; j++) {
    const double size = fmax(fabs(y[j]), allowed[j]);
    const double far = fmin(fabs(h * slope[j]), 1e3 * size);
    volatile double there = y[j] + 1e-8 * fmax(size, far);
    const double delta = there - y[j];
    r->y[j] = there;
    const int code = rhs(t, r->y, r->f, ctx);
    if (code) return code;
    for (size_t i = 0; i < n; i++) r->jacobian[i * n + j] = (r->f[i] - slope[i]) / delta;
    r->y[j] = y[j];
  }
  return 0;
}

/* Max growth of the fastest growing mode in a step, in e-folds: in long steps the method damps
 * growing modes, too. */
enum { MAX_FOLDS = 4 };

static int grows_too_fast(const rot_radau *r, double h) {
  const double *j = r->jacobian;
  if (r->n == 1) return h * j[0] > MAX_FOLDS;
  if (r->n != 2) return 0;
  const double half = 0.5 * h * (j[0] + j[3]), difference = 0.5 * h * (j[0] - j[3]);
  const double d = difference * difference + (h * j[1]) * (h * j[2]);
  return half + (d > 0.0 ? sqrt(d) : 0.0) > MAX_FOLDS;
}

/* Factors the matrices of the stages and of the error estimate. */
static int factor_both(rot_radau *r, double h) {
  const size_t n = r->n, order = STAGES * n;
  for (size_t i = 0; i < STAGES; i++) {
    for (size_t j = 0; j < STAGES; j++) {
      for (size_t k = 0; k < n; k++) {
        for (size_t l = 0; l < n; l++) {
          r->matrix[(i * n + k) * order + j * n + l] =
              (i == j && k == l ? 1.0 : 0.0) - h * weight[i][j] * r->jacobian[k * n + l];
        }
      }
    }
  }
  for (size_t k = 0; k < n; k++) {
    for (size_t l = 0; l < n; l++) {
      r->small[k * n + l] = (k == l ? 1.0 : 0.0) - h * gamma_0 * r->jacobian[k * n + l];
    }
  }
  if (factor(order, r->matrix, r->pivot)) return ROT_RADAU_DIVERGED;
  return factor(n, r->small, r->small_pivot) ? ROT_RADAU_DIVERGED : 0;
}

/* Initial Z: extrapolates the last step's polynomial, which is 0 at 0 and Z_j at c_j. */
static void guess(rot_radau *r, double t, double h) {
  const size_t n = r->n;
  memcpy(r->z_last, r->z, STAGES * n * sizeof *r->z);
  if (!(fabs(t - r->t_end) <= 1e-9 * fabs(r->h)) || !(fabs(h) <= 4.0 * fabs(r->h))) {
    memset(r->z, 0, STAGES * n * sizeof *r->z);
    return;
  }
  for (size_t i = 0; i < STAGES; i++) {
    const double x = 1.0 + node[i] * h / r->h;
    for (size_t k = 0; k < n; k++) r->z[i * n + k] = -r->z_last[(STAGES - 1) * n + k];
    for (size_t j = 0; j < STAGES; j++) {
      double l = x / node[j];
      for (size_t m = 0; m < STAGES; m++) {
        if (m != j) l *= (x - node[m]) / (node[j] - node[m]);
      }
      for (size_t k = 0; k < n; k++) r->z[i * n + k] += l * r->z_last[j * n + k];
    }
  }
}

static int slopes_at_stages(rot_radau *r, rot_radau_rhs rhs, void *ctx, double t, double h,
                            const double y[]) {
  const size_t n = r->n, dim = r->dim;
  for (size_t i = 0; i < STAGES; i++) {
    memcpy(r->y, y, dim * sizeof *y);
    for (size_t k = 0; k < n; k++) r->y[k] += r->z[i * n + k];
    const int code = rhs(t + node[i] * h, r->y, r->stage_slope + i * dim, ctx);
    if (code) return code;
  }
  return 0;
}

/* Z => f at all stages, Newton correction `step` */
static int correct(rot_radau *r, rot_radau_rhs rhs, void *ctx, double t, double h,
                   const double y[]) {
  const size_t n = r->n, dim = r->dim;
  const int code = slopes_at_stages(r, rhs, ctx, t, h, y);
  if (code) return code;
  for (size_t i = 0; i < STAGES; i++) {
    for (size_t k = 0; k < n; k++) {
      double sum = 0.0;
      for (size_t j = 0; j < STAGES; j++) sum += weight[i][j] * r->stage_slope[j * dim + k];
      r->step[i * n + k] = h * sum - r->z[i * n + k];
    }
  }
  solve(STAGES * n, r->matrix, r->pivot, r->step);
  return 0;
}

/* Below this part of `allowed`, corrections that fall no more are the rounding of f itself: tests
 * of 1e-13 come close to it. */
#define STALLED 1e-4

/* Beside a kink a correction may be this part of the one before. */
#define KINKED_RATE 0.5

/* Newton iteration, until the correction is at rounding level or predicts that the next one is. */
static int iterate(rot_radau *r, rot_radau_rhs rhs, void *ctx, double t, double h, const double y[],
                   const double allowed[], int kinked) {
  const size_t n = r->n;
  const double min_rate = kinked ? KINKED_RATE : 0.0;
  double last = INFINITY;
  for (int k = 0; k < MAX_ITERATIONS; k++) {
    const int code = correct(r, rhs, ctx, t, h, y);
    if (code) return code;
    double now = 0.0;
    int at_rounding = 1;
    for (size_t i = 0; i < STAGES * n; i++) {
      const double step = fabs(r->step[i]);
      r->z[i] += r->step[i];
      if (!(step / allowed[i % n] <= now)) now = step / allowed[i % n];
      at_rounding = at_rounding && step <= 0x1p-51 * (fabs(y[i % n]) + fabs(r->z[i]));
    }
    if (at_rounding) return 0;
    if (!isfinite(now) || now > fmax(STALLED, 2.0 * last)) return ROT_RADAU_DIVERGED;
    const double rate = k > 0 ? fmax(min_rate, now / last) : 1.0;
    if (k > 0 && rate < 1.0 && now * rate / (1.0 - rate) <= 1e-7) return 0;
    if (k > 2 && rate > 0.9 && now <= STALLED) return 0;
    last = now;
  }
  return ROT_RADAU_DIVERGED;
}

static void embedded_error(const rot_radau *r, double h, const double slope[], double error[]) {
  const size_t n = r->n;
  for (size_t k = 0; k < n; k++) {
    error[k] = gamma_0 * h * slope[k];
    for (size_t i = 0; i < STAGES; i++) error[k] += spread[i] * r->z[i * n + k];
  }
  solve(n, r->small, r->small_pivot, error);
}

int rot_radau_step(rot_radau *r, rot_radau_rhs rhs, void *ctx, double t, double h, double y[],
                   double error[], const double slope[], const double allowed[], int kinked) {
  const size_t n = r->n, dim = r->dim;
  guess(r, t, h);
  r->t_end = NAN;
  int code = differentiate(r, rhs, ctx, t, h, y, slope, allowed);
  if (!code && grows_too_fast(r, h)) code = ROT_RADAU_DIVERGED;
  if (!code) code = factor_both(r, h);
  if (!code) code = iterate(r, rhs, ctx, t, h, y, allowed, kinked);
  /* The last correction moved the stages by up to a tenth of `allowed` after their slopes were
   * evaluated; the integrals need slopes consistent with the state. */
  if (!code && dim > n) code = slopes_at_stages(r, rhs, ctx, t, h, y);
  if (code) return code;

  memset(error, 0, dim * sizeof *error);
  embedded_error(r, h, slope, error);
  int large = 0;
  for (size_t k = 0; k < n; k++) large = large || fabs(error[k]) > allowed[k];
  if (large) { /* the first estimate is far too large for a fast decaying mode: filter it again */
    memcpy(r->y, y, dim * sizeof *y);
    for (size_t k = 0; k < n; k++) r->y[k] += error[k];
    code = rhs(t, r->y, r->f, ctx);
    if (code) return code;
    embedded_error(r, h, r->f, error);
  }
  for (size_t k = 0; k < dim; k++) {
    if (k < n) {
      y[k] += r->z[(STAGES - 1) * n + k];
    } else {
      double sum = 0.0;
      for (size_t j = 0; j < STAGES; j++) {
        sum += weight[STAGES - 1][j] * r->stage_slope[j * dim + k];
      }
      y[k] += h * sum;
    }
  }
  r->t_end = t + h;
  r->h = h;
  return 0;
}
