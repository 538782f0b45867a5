#include "maths/whiten.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- the filter ----------------------------------------------------------------------------- */

typedef struct filter {
  double slow, white; /* variances of the correlated and the white part, sum 1 */
  double tau;         /* s, > 0 */
  double spread;      /* predicted variance of the correlated part at the next sample */
  double step, decay; /* last interval and its exp(-step/tau), reused for equal intervals */
} filter;

static filter filter_from(const rot_noise *noise) {
  return (filter){1.0 - noise->white, noise->white, noise->tau_s, 1.0 - noise->white, -1.0, 1.0};
}

/* Predicts the next sample, h later; returns the decay of the correlated part. */
static double filter_wait(filter *f, double h) {
  /* Times i h differ in their last bits: the spacing counts as equal within 1e-12. */
  if (!(fabs(h - f->step) <= 1e-12 * h)) {
    f->step = h;
    f->decay = exp(-h / f->tau);
  }
  f->spread = f->decay * f->decay * f->spread + (1.0 - f->decay * f->decay) * f->slow;
  return f->decay;
}

rot_status rot_whiten(const rot_noise *noise, size_t n, const double t[], size_t columns,
                      double x[], double *logdet) {
  double state[ROT_WHITEN_COLUMNS] = {0}, sum = 0.0;
  if (columns > ROT_WHITEN_COLUMNS) return ROT_EVALUE;
  if (logdet) *logdet = 0.0;
  if (!(noise->tau_s > 0.0) || noise->white == 1.0) return ROT_OK;
  filter f = filter_from(noise);
  for (size_t i = 0; i < n; i++) {
    const double decay = i > 0 ? filter_wait(&f, t[i] - t[i - 1]) : 1.0;
    const double variance = f.spread + f.white, k = f.spread / variance;
    if (!(variance > 0.0)) return ROT_ERANGE;
    const double scale = 1.0 / sqrt(variance);
    double *row = x + i * columns;
    for (size_t j = 0; j < columns; j++) {
      const double ahead = decay * state[j], v = row[j] - ahead;
      row[j] = v * scale;
      state[j] = ahead + k * v;
    }
    f.spread *= f.white / variance;
    sum += log(variance);
  }
  if (logdet) *logdet = sum;
  return ROT_OK;
}

/* ---- the likelihood ------------------------------------------------------------------------- */

typedef struct problem {
  size_t n, p; /* samples; columns */
  const double *t;
  double *z;                /* n x (p + 1): orthonormal columns, the residual */
  double *work;             /* of the size of z */
  double log_low, log_high; /* range of log tau */
  double spacing;           /* of anticorrelated noise: that of the samples; else 0 */
  size_t evaluations;
  double logdet; /* of the last evaluation */
} problem;

/* Gram matrix g => log det of its leading p x p block; *rest: squared distance of the last column
 * from the span of the others. g is overwritten. */
static double reduce(size_t p, double g[ROT_WHITEN_COLUMNS][ROT_WHITEN_COLUMNS], double *rest) {
  double logdet = 0.0;
  for (size_t j = 0; j < p; j++) {
    const double d = g[j][j];
    if (!(d > 0.0)) {
      *rest = NAN;
      return 0.0;
    }
    logdet += log(d);
    for (size_t i = j + 1; i <= p; i++) {
      const double f = g[j][i] / d;
      for (size_t k = i; k <= p; k++) g[i][k] -= f * g[j][k];
    }
  }
  *rest = g[p][p];
  return logdet;
}

/* Minus twice the restricted log likelihood, sigma profiled out. */
static double deviance(problem *q, const rot_noise *noise) {
  const size_t n = q->n, p = q->p, m = p + 1;
  double g[ROT_WHITEN_COLUMNS][ROT_WHITEN_COLUMNS] = {{0}}, rest = 0.0;
  memcpy(q->work, q->z, n * m * sizeof(double));
  if (rot_whiten(noise, n, q->t, m, q->work, &q->logdet) != ROT_OK) return DBL_MAX;
  for (size_t i = 0; i < n; i++) {
    const double *row = q->work + i * m;
    for (size_t j = 0; j < m; j++) {
      for (size_t k = j; k < m; k++) g[j][k] += row[j] * row[k];
    }
  }
  const double fixed = reduce(p, g, &rest);
  q->evaluations++;
  if (!(rest > 0.0)) return DBL_MAX;
  return q->logdet + fixed + (double)(n - p) * log(rest);
}

/* Coordinates: log tau, log(f/(1 - f)). f is the white fraction; of anticorrelated noise 1 -
 * 1/white over its limit (1 - rho)/(1 + rho), at which the power at frequency 0 vanishes. A penalty
 * beyond their ends keeps the minimum inside. */
static const double LOGIT_END = 9.0, ANTI_END = 2.5;

/* => limit of 1 - 1/white of anticorrelated noise */
static double anti_limit(const problem *q, double tau) { return tanh(0.5 * q->spacing / tau); }

static rot_noise noise_at(const problem *q, const double x[2], double *cost) {
  const int anti = q->spacing > 0.0;
  const double a = fmin(fmax(x[0], q->log_low), q->log_high), tau = exp(a);
  const double b = fmin(fmax(x[1], -LOGIT_END), anti ? ANTI_END : LOGIT_END);
  const double f = 1.0 / (1.0 + exp(-b));
  *cost = fabs(x[0] - a) + fabs(x[1] - b);
  return (rot_noise){tau, anti ? 1.0 / (1.0 - f * anti_limit(q, tau)) : f};
}

static void place_of(const problem *q, const rot_noise *noise, double x[2]) {
  const int anti = q->spacing > 0.0;
  const double f = anti ? (1.0 - 1.0 / noise->white) / anti_limit(q, noise->tau_s) : noise->white;
  x[0] = log(noise->tau_s);
  x[1] = log(f / (1.0 - f));
}

static double deviance_at(problem *q, const double x[2]) {
  double cost;
  const rot_noise noise = noise_at(q, x, &cost);
  return deviance(q, &noise) + cost;
}

/* (x, its deviance *min) => local minimum, by Nelder and Mead's simplex in two dimensions */
static rot_status descend(problem *q, double x[2], double *min, const rot_hooks *hooks) {
  double v[3][2], f[3];
  for (int i = 0; i < 3; i++) {
    v[i][0] = x[0] + (i == 1 ? 0.7 : 0.0);
    v[i][1] = x[1] + (i == 2 ? 0.9 : 0.0);
    f[i] = i == 0 ? *min : deviance_at(q, v[i]);
  }
  for (int turn = 0; turn < 80; turn++) {
    int low = 0, high = 0;
    for (int i = 1; i < 3; i++) {
      if (f[i] < f[low]) low = i;
      if (f[i] >= f[high]) high = i;
    }
    if (low == high) break;
    const int mid = 3 - low - high;
    const double size = fmax(fabs(v[high][0] - v[low][0]), fabs(v[high][1] - v[low][1]));
    /* Twice the log likelihood to 1e-3, the coordinates to .02: standard errors do not change. */
    if (f[high] - f[low] < 1e-3 && size < 0.02) break;
    const rot_status status = rot_poll(hooks, 0.5);
    if (status != ROT_OK) return status;
    const double centre[2] = {0.5 * (v[low][0] + v[mid][0]), 0.5 * (v[low][1] + v[mid][1])};
    double y[2], z[2], fy, fz;
    for (int k = 0; k < 2; k++) y[k] = 2.0 * centre[k] - v[high][k];
    fy = deviance_at(q, y);
    if (fy < f[low]) {
      for (int k = 0; k < 2; k++) z[k] = 3.0 * centre[k] - 2.0 * v[high][k];
    } else if (fy < f[mid]) {
      memcpy(v[high], y, sizeof y);
      f[high] = fy;
      continue;
    } else {
      const double *from = fy < f[high] ? y : v[high];
      for (int k = 0; k < 2; k++) z[k] = 0.5 * (centre[k] + from[k]);
    }
    fz = deviance_at(q, z);
    if (fz < fmin(fy, f[high])) {
      memcpy(v[high], z, sizeof z);
      f[high] = fz;
    } else if (fy < f[high]) {
      memcpy(v[high], y, sizeof y);
      f[high] = fy;
    } else {
      for (int i = 0; i < 3; i++) {
        if (i == low) continue;
        for (int k = 0; k < 2; k++) v[i][k] = 0.5 * (v[i][k] + v[low][k]);
        f[i] = deviance_at(q, v[i]);
      }
    }
  }
  int low = 0;
  for (int i = 1; i < 3; i++) {
    if (f[i] < f[low]) low = i;
  }
  memcpy(x, v[low], sizeof v[low]);
  *min = f[low];
  return ROT_OK;
}

/* ---- the columns ---------------------------------------------------------------------------- */

/* (J, r) => z: an orthonormal basis of the columns of J by two rounds of modified Gram-Schmidt, and
 * r orthogonal to it; returns the size of the basis. Dependent columns are left out. */
static size_t orthonormal(size_t n, size_t p, const double J[], const double r[], double z[],
                          size_t stride) {
  size_t kept = 0;
  for (size_t j = 0; j <= p; j++) {
    double before = 0.0, after = 0.0;
    for (size_t i = 0; i < n; i++) {
      const double x = j < p ? J[i * p + j] : r[i];
      z[i * stride + kept] = x;
      before += x * x;
    }
    for (int round = 0; round < 2; round++) {
      for (size_t k = 0; k < kept; k++) {
        double dot = 0.0;
        for (size_t i = 0; i < n; i++) dot += z[i * stride + k] * z[i * stride + kept];
        for (size_t i = 0; i < n; i++) z[i * stride + kept] -= dot * z[i * stride + k];
      }
    }
    if (j == p) break;
    for (size_t i = 0; i < n; i++) after += z[i * stride + kept] * z[i * stride + kept];
    if (!(after > 1e-26 * before)) continue;
    after = 1.0 / sqrt(after);
    for (size_t i = 0; i < n; i++) z[i * stride + kept] *= after;
    kept++;
  }
  return kept;
}

static int compare(const void *a, const void *b) {
  const double x = *(const double *)a, y = *(const double *)b;
  return (x > y) - (x < y);
}

static double median_spacing(size_t n, const double t[], double work[]) {
  size_t m = 0;
  for (size_t i = 1; i < n; i++) {
    if (t[i] > t[i - 1]) work[m++] = t[i] - t[i - 1];
  }
  if (m == 0) return 0.0;
  qsort(work, m, sizeof *work, compare);
  return work[m / 2];
}

enum { TIMES = 6, FRACTIONS = 3, STARTS = 3 };

/* Anticorrelated noise makes errors smaller: it takes more to find it. */
static const double ANTI_SPACINGS = 4.0, ANTI_THRESHOLD = 5.0;

/* (deviance `white` of white noise) => `out`, the noise of the smallest deviance if it gains more
 * than the threshold. Starts at `near` or at the best points of a grid. */
static rot_status search(problem *q, double white, double threshold, const rot_noise *near,
                         const rot_hooks *hooks, rot_reml *out) {
  static const double fraction[FRACTIONS] = {-3.0, -0.7, 1.5};
  double start[STARTS][2], height[STARTS], best = white - threshold;
  int starts = 0;
  if (near) {
    place_of(q, near, start[0]);
    height[0] = deviance_at(q, start[0]);
    starts = 1;
  } else {
    for (int i = 0; i < TIMES; i++) {
      double x[2], min = DBL_MAX, at = 0.0;
      x[0] = q->log_low + (i + 0.5) * (q->log_high - q->log_low) / TIMES;
      for (int j = 0; j < FRACTIONS; j++) {
        x[1] = fraction[j];
        const double f = deviance_at(q, x);
        if (f < min) {
          min = f;
          at = x[1];
        }
      }
      /* Keep the best starts, sorted. */
      int place = starts < STARTS ? starts++ : STARTS;
      while (place > 0 && height[place - 1] > min) {
        if (place < STARTS) {
          height[place] = height[place - 1];
          memcpy(start[place], start[place - 1], sizeof start[0]);
        }
        place--;
      }
      if (place < STARTS) {
        height[place] = min;
        start[place][0] = x[0];
        start[place][1] = at;
      }
      const rot_status status = rot_poll(hooks, 0.5);
      if (status != ROT_OK) return status;
    }
    /* Far below the threshold: white noise without a descent. */
    if (white - height[0] < 0.5 * threshold) return ROT_OK;
  }
  for (int i = 0; i < starts; i++) {
    if (i > 0 && height[i] > height[0] + 20.0) break;
    const rot_status status = descend(q, start[i], &height[i], hooks);
    if (status != ROT_OK) return status;
    if (height[i] < best) {
      double cost;
      out->noise = noise_at(q, start[i], &cost);
      out->gain = white - height[i];
      out->at_cap = start[i][0] > q->log_high - 0.05;
      best = height[i];
    }
  }
  return ROT_OK;
}

rot_status rot_whiten_reml(size_t n, const double t[], size_t p, const double J[], const double r[],
                           double cap_s, double threshold, const rot_noise *near,
                           const rot_hooks *hooks, rot_reml *out) {
  *out = (rot_reml){{0.0, 1.0}, 0.0, 0.0, 0, 0};
  if (p + 1 > ROT_WHITEN_COLUMNS) return ROT_EVALUE;
  if (n < p + 4) return ROT_OK;
  double *z = malloc(2 * n * (p + 1) * sizeof *z);
  if (!z) return ROT_ENOMEM;
  problem q = {n, p, t, z, z + n * (p + 1), 0.0, 0.0, 0.0, 0, 0.0};
  rot_status status = ROT_OK;
  const double spacing = median_spacing(n, t, z);
  if (spacing > 0.0 && cap_s > spacing) {
    const size_t kept = orthonormal(n, p, J, r, z, p + 1);
    if (kept < p) { /* rows of the kept columns, contiguous */
      for (size_t i = 0; i < n; i++)
        memmove(z + i * (kept + 1), z + i * (p + 1), (kept + 1) * sizeof *z);
    }
    q.p = kept;
    q.log_low = log(0.25 * spacing);
    q.log_high = log(cap_s);
    double rest = 0.0;
    for (size_t i = 0; i < n; i++) {
      const double x = z[i * (kept + 1) + kept];
      rest += x * x;
    }
    if (rest > 0.0) {
      const double white = (double)(n - kept) * log(rest);
      const int anti = near && near->white > 1.0;
      if (!anti) status = search(&q, white, threshold, near, hooks, out);
      if (status == ROT_OK && (anti || (!near && !(out->noise.tau_s > 0.0)))) {
        q.spacing = spacing;
        q.log_high = fmin(q.log_high, log(ANTI_SPACINGS * spacing));
        status = search(&q, white, ANTI_THRESHOLD * threshold, near, hooks, out);
        out->at_cap = 0;
      }
    }
    if (out->noise.tau_s > 0.0) {
      deviance(&q, &out->noise);
      out->logdet = q.logdet;
    }
    out->evaluations = q.evaluations;
  }
  free(z);
  return status;
}
