/* The smoother of samples: against a smoother in quadruple precision, closed forms, random
 * records. */
#include "measure/smooth.h"

#include <stdlib.h>

#include "measure/smooth_breaks.h"

#include "rot_test.h"

enum { P = ROT_SMOOTH_MAX };

/* Uniform and normal numbers, of this file alone. */
static uint64_t seed = 20221;
static double uniform(void) {
  seed ^= seed << 13;
  seed ^= seed >> 7;
  seed ^= seed << 17;
  return ((double)(seed >> 11) + 0.5) / 9007199254740992.0;
}
static double normal(void) {
  return sqrt(-2.0 * log(uniform())) * cos(6.283185307179586 * uniform());
}

#ifdef __SIZEOF_FLOAT128__
__extension__ typedef __float128 quad;

/* The smoother as least squares, by orthogonal transforms: nothing is assumed of the first state.
 * Each transition is p equations L^-1 (x+ - A x) = 0, Q = L L'. The normal equations instead lose
 * 26 digits at p = 4, lambda = 1e-12. Means and covariances of each node. */
static quad quad_root(quad x) {
  quad y = sqrt((double)x);
  if (!(x > 0)) return 0;
  for (int i = 0; i < 3; i++) y = (y + x / y) / 2;
  return y;
}

static quad quad_power(quad x, int n) {
  quad y = 1;
  while (n-- > 0) y *= x;
  return y;
}

static quad factorial(int n) {
  quad y = 1;
  for (int i = 2; i <= n; i++) y *= i;
  return y;
}

enum { SIMD = 2 * P + 1 };

static void quad_triangle(quad m[][SIMD], int rows, int columns) {
  for (int c = 0; c < columns && c < rows; c++) {
    quad square = 0;
    for (int r = c + 1; r < rows; r++) square += m[r][c] * m[r][c];
    if (!(square > 0)) continue;
    const quad norm = quad_root(square + m[c][c] * m[c][c]), to = m[c][c] > 0 ? -norm : norm;
    const quad head = m[c][c] - to;
    for (int j = c + 1; j < columns; j++) {
      quad dot = head * m[c][j];
      for (int r = c + 1; r < rows; r++) dot += m[r][c] * m[r][j];
      dot /= head * to;
      m[c][j] += dot * head;
      for (int r = c + 1; r < rows; r++) m[r][j] += dot * m[r][c];
    }
    m[c][c] = to;
    for (int r = c + 1; r < rows; r++) m[r][c] = 0;
  }
}

/* L^-1 (-A | 1) of a gap: p rows, 2p columns, and a right-hand side of 0. */
static void transition(const rot_smooth_model *model, quad s, quad out[][SIMD]) {
  const int p = model->order;
  quad l[P][P];
  for (int i = 0; i < p; i++)
    for (int j = 0; j <= i; j++) {
      l[i][j] = (quad)model->lambda * quad_power(s, 2 * p - 1 - i - j) /
                ((2 * p - 1 - i - j) * factorial(p - 1 - i) * factorial(p - 1 - j) * factorial(i) *
                 factorial(j));
      for (int k = 0; k < j; k++) l[i][j] -= l[i][k] * l[j][k];
      l[i][j] = i == j ? quad_root(l[i][j]) : l[i][j] / l[j][j];
    }
  for (int i = 0; i < p; i++)
    for (int c = 0; c < SIMD; c++) {
      const int j = c - p;
      quad entry = c >= 2 * p ? 0 : j >= 0 ? (quad)(i == j) : 0;
      if (c < p && c >= i)
        entry = -factorial(c) / factorial(i) / factorial(c - i) * quad_power(s, c - i);
      for (int k = 0; k < i; k++) entry -= l[i][k] * out[k][c];
      out[i][c] = entry / l[i][i];
    }
}

static void exact_smoother(const rot_smooth_nodes *nodes, const rot_smooth_model *model, quad *mean,
                           quad *covariance) {
  const int p = model->order, simd = 2 * p + 1;
  const size_t n = nodes->n;
  quad(*kept)[P][SIMD] = calloc(n, sizeof *kept); /* R, T, z: R x = z - T x+ */
  quad info[P + 1][SIMD];                         /* of the node: p columns and z, by triangle */
  memset(info, 0, sizeof info);
  for (size_t k = 0; k < n; k++) {
    if (k > 0) {
      quad m[2 * P][SIMD], over[P][SIMD];
      memset(m, 0, sizeof m);
      transition(model, nodes->gap[k], over);
      for (int r = 0; r < p; r++) {
        for (int c = 0; c < p; c++) m[r][c] = info[r][c];
        m[r][2 * p] = info[r][p];
        memcpy(m[p + r], over[r], sizeof over[r]);
      }
      quad_triangle(m, 2 * p, simd);
      memcpy(kept[k - 1], m, (size_t)p * sizeof m[0]);
      memset(info, 0, sizeof info);
      for (int r = 0; r < p; r++)
        for (int c = 0; c <= p; c++) info[r][c] = m[p + r][p + c];
    }
    for (int c = 0; c < ROT_SMOOTH_CHANNELS; c++)
      if (nodes->y[c] && !isnan(nodes->y[c][k])) {
        const quad w = nodes->w[c] ? (quad)nodes->w[c][k] : 1;
        for (int j = 0; j < p; j++) info[p][j] = j == c ? 1 / w : 0;
        info[p][p] = (quad)nodes->y[c][k] / w;
        quad_triangle(info, p + 1, p + 1);
      }
  }
  for (int r = 0; r < p; r++)
    for (int c = 0; c < simd; c++)
      kept[n - 1][r][c] = c < p ? info[r][c] : c == 2 * p ? info[r][p] : 0;
  for (size_t k = n; k-- > 0;) {
    quad(*row)[SIMD] = kept[k];
    quad *x = mean + k * (size_t)p, *cov = covariance + k * (size_t)(p * p), inverse[P][P];
    const quad *next = k + 1 < n ? x + p : NULL, *after = k + 1 < n ? cov + p * p : NULL;
    memset(inverse, 0, sizeof inverse);
    for (int r = p - 1; r >= 0; r--) {
      x[r] = row[r][2 * p];
      for (int c = r + 1; c < p; c++) x[r] -= row[r][c] * x[c];
      for (int c = 0; next && c < p; c++) x[r] -= row[r][p + c] * next[c];
      x[r] /= row[r][r];
      for (int c = r; c < p; c++) {
        inverse[r][c] = c == r ? 1 : 0;
        for (int j = r + 1; j <= c; j++) inverse[r][c] -= row[r][j] * inverse[j][c];
        inverse[r][c] /= row[r][r];
      }
    }
    quad half[P][P], inner[P][P]; /* 1 + T C+ T' */
    for (int a = 0; a < p; a++)
      for (int d = 0; d < p; d++) {
        half[a][d] = 0;
        for (int c = 0; after && c < p; c++) half[a][d] += row[a][p + c] * after[c * p + d];
      }
    for (int a = 0; a < p; a++)
      for (int b = 0; b < p; b++) {
        inner[a][b] = a == b;
        for (int d = 0; d < p; d++) inner[a][b] += half[a][d] * row[b][p + d];
      }
    for (int i = 0; i < p; i++)
      for (int j = 0; j < p; j++) {
        quad sum = 0;
        for (int a = 0; a < p; a++)
          for (int b = 0; b < p; b++) sum += inverse[i][a] * inner[a][b] * inverse[j][b];
        cov[i * p + j] = sum;
      }
  }
  free(kept);
}

/* Uneven times with a gap of 1000 spacings in the middle, range/sigma 1e4: means to 1e-4 of their
 * standard error, standard errors to 1e-5. */
static void against_quadruple(int p, double lambda, int rates) {
  enum { N = 200 };
  static double gap[N], y[N], z[N];
  static signed char first[N];
  static quad mean[N * P], covariance[N * P * P];
  static double got[N * P], cov[N * 6];
  double t = 0.0, total = 0.0;
  for (int k = 0; k < N; k++) {
    gap[k] = k == 0 ? 0.0 : k == N / 2 ? 1000.0 : 0.2 + 1.6 * uniform();
    total += gap[k];
    first[k] = ROT_SMOOTH_FLOWS;
  }
  for (int k = 0; k < N; k++) {
    gap[k] *= (N - 1) / total;
    t += gap[k];
    y[k] = 1e4 * sin(0.03 * t) + normal();
    z[k] = 300.0 * cos(0.03 * t) + normal();
    if (rates && k % 3 == 1)
      y[k] = NAN;
    else
      z[k] = NAN;
  }
  const rot_smooth_nodes nodes = {N,    gap, {y, rates ? z : NULL}, {NULL, NULL}, first, 0, NULL,
                                  NULL, 0};
  const rot_smooth_model model = {p, lambda};
  exact_smoother(&nodes, &model, mean, covariance);
  rot_smooth_store store;
  rot_smooth_sums sums;
  ROT_CHECK(rot_smooth_store_new(&store, N, p) == ROT_OK);
  rot_smooth_filter(&nodes, &model, 0, N, &store, 1, &sums);
  rot_smooth_smooth(&nodes, &model, &store, got, cov);
  double worst = 0.0, off = 0.0;
  const int at[3] = {0, 3, 5};
  for (int k = 0; k < N; k++)
    for (int i = 0; i < 3; i++) {
      const double variance = (double)covariance[(k * p + i) * p + i];
      const double difference = (double)((quad)got[k * p + i] - mean[k * p + i]);
      worst = fmax(worst, fabs(sqrt(cov[6 * k + at[i]] / variance) - 1.0));
      off = fmax(off, fabs(difference) / sqrt(variance));
    }
  ROT_CHECK(worst <= 1e-5);
  ROT_CHECK(off <= 1e-4);
  if (getenv("ROT_SMOOTH_SHOW"))
    printf("p %d lambda %g rates %d: s.e. %.1e mean %.1e\n", p, lambda, rates, worst, off);
  rot_smooth_store_free(&store);
}

static void quadruple_precision(void) {
  for (int p = 3; p <= 5; p++)
    for (int e = -12; e <= 4; e += 2)
      for (int rates = 0; rates < 2; rates++)
        if (p < 5 || e <= 0) against_quadruple(p, pow(10.0, e), rates);
}
#endif

/* ---- one record, several ways ---------------------------------------------------------------- */

enum { N = 120 };

typedef struct series {
  double gap[N + 1], y[N + 1], w[N + 1];
  signed char first[N + 1];
  rot_smooth_nodes nodes;
} series;

static void make_series(series *of, int uneven) {
  double t = 0.0;
  for (int k = 0; k < N; k++) {
    of->gap[k] = k == 0 ? 0.0 : uneven ? 0.3 + 1.4 * uniform() : 1.0;
    t += of->gap[k];
    of->y[k] = 40.0 * sin(0.07 * t) + normal();
    of->w[k] = uneven ? 0.5 + uniform() : 1.0;
    of->first[k] = ROT_SMOOTH_FLOWS;
  }
  of->first[0] = ROT_SMOOTH_STARTS;
  const rot_smooth_nodes nodes = {N,    of->gap, {of->y, NULL}, {of->w, NULL}, of->first, 0, NULL,
                                  NULL, 0};
  of->nodes = nodes;
}

/* A leave-one-out residual is that of a smoother without the sample. */
static void leave_one_out(void) {
  static series all, without;
  static double mean[N * P], cov[N * 6], residual[N], shock[N];
  make_series(&all, 1);
  const rot_smooth_model model = {4, 1e-5};
  rot_smooth_store store;
  rot_smooth_sums sums;
  double *to[2] = {residual, NULL};
  ROT_CHECK(rot_smooth_store_new(&store, N, 4) == ROT_OK);
  rot_smooth_filter(&all.nodes, &model, 0, N, &store, 1, &sums);
  rot_smooth_scores(&all.nodes, &model, &store, shock, NULL, to);
  for (int i = 5; i < N; i += 23) {
    without = all;
    without.nodes.y[0] = without.y;
    without.y[i] = NAN;
    rot_smooth_filter(&without.nodes, &model, 0, N, &store, 1, &sums);
    rot_smooth_smooth(&without.nodes, &model, &store, mean, cov);
    ROT_CHECK_REL(residual[i], (all.y[i] - mean[4 * i]) / sqrt(cov[6 * i] + all.w[i] * all.w[i]),
                  1e-6);
  }
  rot_smooth_store_free(&store);
}

static double squares(const rot_smooth_nodes *nodes, const rot_smooth_model *model) {
  static double mean[(N + 1) * P];
  rot_smooth_store store;
  rot_smooth_sums sums;
  double sum = 0.0;
  ROT_CHECK(rot_smooth_store_new(&store, nodes->n, model->order) == ROT_OK);
  rot_smooth_filter(nodes, model, 0, nodes->n, &store, 1, &sums);
  for (size_t k = 0; k < nodes->n; k++)
    if (store.f[0][k] > 0.0) sum += store.v[0][k] * store.v[0][k] / store.f[0][k];
  rot_smooth_smooth(nodes, model, &store, mean, NULL);
  rot_smooth_store_free(&store);
  return sum;
}

/* The score of a shock is the fall of the sum of squares where the states from 1 on begin anew,
 * that of a kink where the last state does. */
static void score_of_shock(void) {
  static series all, broken;
  static double shock[N], kink[N];
  make_series(&all, 1);
  for (int k = 60; k < N; k++) all.y[k] += 0.8 * (k - 60);
  for (int p = 3; p <= 4; p++) {
    const rot_smooth_model model = {p, 1e-4};
    rot_smooth_store store;
    rot_smooth_sums sums;
    ROT_CHECK(rot_smooth_store_new(&store, N, p) == ROT_OK);
    rot_smooth_filter(&all.nodes, &model, 0, N, &store, 1, &sums);
    rot_smooth_scores(&all.nodes, &model, &store, shock, kink, NULL);
    rot_smooth_store_free(&store);
    for (int at = 20; at <= 100; at += 20) {
      broken = all;
      for (int k = N; k > at; k--) {
        broken.gap[k] = all.gap[k - 1];
        broken.y[k] = all.y[k - 1];
        broken.w[k] = all.w[k - 1];
        broken.first[k] = all.first[k - 1];
      }
      /* A node without a sample at the time of sample `at`, then a break with that sample. */
      broken.y[at] = NAN;
      broken.gap[at + 1] = 0.0;
      broken.first[at + 1] = 1;
      const rot_smooth_nodes nodes = {
          N + 1, broken.gap, {broken.y, NULL}, {broken.w, NULL}, broken.first, 0, NULL, NULL, 0};
      ROT_CHECK_REL(squares(&all.nodes, &model) - squares(&nodes, &model), shock[at], 1e-5);
      broken.first[at + 1] = (signed char)(p - 1);
      const double fall = squares(&all.nodes, &model) - squares(&nodes, &model);
      ROT_CHECK(fabs(fall - kink[at]) <= 1e-5 * fmax(kink[at], 1.0));
    }
  }
}

/* The gain that is kept once it converged gives the same likelihood. */
static void kept_gain(void) {
  enum { MANY = 4000 };
  static double gap[MANY], y[MANY];
  static signed char first[MANY];
  for (int k = 0; k < MANY; k++) {
    gap[k] = 1.0;
    first[k] = k ? ROT_SMOOTH_FLOWS : ROT_SMOOTH_STARTS;
    y[k] = k % 997 == 996 ? NAN : 300.0 * sin(0.01 * k) + normal();
  }
  const rot_smooth_nodes nodes = {MANY, gap, {y, NULL}, {NULL, NULL}, first, 0, NULL, NULL, 0};
  for (int p = 3; p <= 4; p++)
    for (int e = -10; e <= 2; e += 3) {
      const rot_smooth_model model = {p, pow(10.0, e)};
      rot_smooth_store store;
      rot_smooth_sums stepped, kept;
      ROT_CHECK(rot_smooth_store_new(&store, MANY, p) == ROT_OK);
      rot_smooth_filter(&nodes, &model, 0, MANY, &store, 1, &stepped);
      rot_smooth_filter(&nodes, &model, 0, MANY, NULL, 0, &kept);
      ROT_CHECK_REL(kept.square, stepped.square, 1e-8);
      ROT_CHECK_REL(kept.log_f, stepped.log_f, 1e-8);
      ROT_CHECK_EQ_INT((long long)kept.counted, (long long)stepped.counted);
      rot_smooth_store_free(&store);
    }
}

/* Draws have the means and variances of the smoother, and the covariance of two times. */
static void draws(void) {
  enum { DRAWS = 4000 };
  static series all;
  static double mean[N * P], cov[N * 6], x[DRAWS * 2 * 4];
  make_series(&all, 0);
  const rot_smooth_model model = {4, 1e-5};
  const size_t at[2] = {30, 33};
  rot_smooth_store store;
  rot_smooth_sums sums;
  double m[2] = {0.0, 0.0}, v[3] = {0.0, 0.0, 0.0};
  ROT_CHECK(rot_smooth_store_new(&store, N, 4) == ROT_OK);
  rot_smooth_filter(&all.nodes, &model, 0, N, &store, 1, &sums);
  rot_smooth_smooth(&all.nodes, &model, &store, mean, cov);
  ROT_CHECK(rot_smooth_draw(&all.nodes, &model, &store, 1.0, 2, at, DRAWS, 7, NULL, x) == ROT_OK);
  for (int d = 0; d < DRAWS; d++) {
    const double a = x[8 * d + 1] - mean[4 * 30 + 1], b = x[8 * d + 5] - mean[4 * 33 + 1];
    m[0] += a / DRAWS;
    m[1] += b / DRAWS;
    v[0] += a * a / DRAWS;
    v[1] += b * b / DRAWS;
    v[2] += a * b / DRAWS;
  }
  const double sd0 = sqrt(cov[6 * 30 + 3]), sd1 = sqrt(cov[6 * 33 + 3]);
  ROT_CHECK(fabs(m[0]) < 5.0 * sd0 / sqrt(DRAWS));
  ROT_CHECK_REL(sqrt(v[0]), sd0, 0.06);
  ROT_CHECK_REL(sqrt(v[1]), sd1, 0.06);
  ROT_CHECK(v[2] / (sd0 * sd1) > 0.3); /* neighbours: their errors go together */
  rot_smooth_store_free(&store);
}

/* ---- records --------------------------------------------------------------------------------- */

typedef struct samples {
  double time[500], theta[500], w[500];
  rot_smooth_record record;
} samples;

static void make_samples(samples *of, size_t n) {
  memset(&of->record, 0, sizeof of->record);
  of->record.n = n;
  of->record.time_s = of->time;
  of->record.y[0] = of->theta;
  of->record.w[0] = of->w;
  for (size_t i = 0; i < n; i++) {
    of->time[i] = 0.02 * (double)i;
    of->w[i] = 1.0;
  }
}

/* An impact between two samples and a sample that is off: found, with time, jump and scatter. */
static void impact_and_outlier(void) {
  static samples of;
  make_samples(&of, 400);
  for (int i = 0; i < 400; i++) {
    const double t = of.time[i];
    of.theta[i] = 5.0 * t + (t > 4.013 ? 6.0 * (t - 4.013) : 0.0) + 1e-3 * normal();
  }
  of.theta[90] += 0.02;
  of.theta[202] -= 0.02;
  const rot_smooth_finding how = {1, 1, 3, 4, 10};
  rot_smooth_break breaks[10];
  rot_smooth_fit fit;
  size_t n = 0;
  double error;
  ROT_CHECK(rot_smooth_find(&of.record, &how, breaks, &n, NULL, &fit) == ROT_OK);
  ROT_CHECK_EQ_INT((long long)n, 1);
  ROT_CHECK(fabs(breaks[0].time_s - 4.013) < 1e-3);
  ROT_CHECK_EQ_INT(breaks[0].first, 1);
  ROT_CHECK(isinf(of.w[90]) && isinf(of.w[202]));
  ROT_CHECK_REL(fit.sigma, 1e-3, 0.15);
  ROT_CHECK(rot_smooth_time_error(&of.record, &fit, n, breaks, 0, &error) == ROT_OK);
  ROT_CHECK(error > 2e-5 && error < 1e-3);
  /* Of a weaker impact the time is less sharp; beyond 5 samples, 0.1 s, it is not known. The tries
   * double: the last one below is at 0.066 s. */
  int known = 0, unknown = 0;
  double jump = 6.0, before = error;
  for (int k = 0; k < 90; k++) {
    const double next = jump * (k < 27 ? 0.8 : 0.99);
    for (int i = 0; i < 400; i++) of.theta[i] += (next - jump) * fmax(0.0, of.time[i] - 4.013);
    jump = next;
    ROT_CHECK(rot_smooth_time_error(&of.record, &fit, n, breaks, 0, &error) == ROT_OK);
    known += !isnan(error);
    unknown += isnan(error);
    ROT_CHECK(isnan(error) || (error <= 0.07 && error > 0.9 * before));
    if (!isnan(error)) before = error;
  }
  ROT_CHECK(known > 10 && unknown > 5);
}

/* A line without noise: a polynomial, with sigma at the rounding of the samples. */
static void exact_line(void) {
  static samples of;
  make_samples(&of, 100);
  for (int i = 0; i < 100; i++) of.theta[i] = 3.0 - 7.0 * of.time[i];
  const rot_smooth_finding how = {1, 1, 3, 4, 10};
  rot_smooth_break breaks[10];
  rot_smooth_fit fit;
  size_t n = 0;
  ROT_CHECK(rot_smooth_find(&of.record, &how, breaks, &n, NULL, &fit) == ROT_OK);
  ROT_CHECK_EQ_INT((long long)n, 0);
  ROT_CHECK_EQ_INT(fit.end, ROT_SMOOTH_POLYNOMIAL);
  ROT_CHECK(fit.sigma < 1e-13);
}

/* -2 log L of a model. */
static double likelihood(const rot_smooth_record *record, const rot_smooth_model *model) {
  rot_smooth_grid grid;
  rot_smooth_sums sums;
  double sigma;
  ROT_CHECK(rot_smooth_grid_new(&grid, record, 0, 0) == ROT_OK);
  rot_smooth_grid_fill(&grid, record, 1.0, 0, NULL, NULL);
  const double objective = rot_smooth_objective(&grid.nodes, model, 0.0, &sigma, &sums);
  rot_smooth_grid_free(&grid);
  return objective;
}

/* n log GCV of a fit by the smoother's residuals and variances, and -2 log L. */
static double validation(const rot_smooth_record *record, const rot_smooth_model *model,
                         double *objective) {
  static double mean[500 * P], cov[500 * 6];
  rot_smooth_grid grid;
  rot_smooth_store store;
  rot_smooth_sums sums;
  double square = 0.0, left = 0.0, sigma;
  ROT_CHECK(rot_smooth_grid_new(&grid, record, 0, 0) == ROT_OK);
  rot_smooth_grid_fill(&grid, record, 1.0, 0, NULL, NULL);
  *objective = rot_smooth_objective(&grid.nodes, model, 0.0, &sigma, &sums);
  ROT_CHECK(rot_smooth_store_new(&store, grid.nodes.n, model->order) == ROT_OK);
  rot_smooth_filter(&grid.nodes, model, 0, grid.nodes.n, &store, 1, &sums);
  rot_smooth_smooth(&grid.nodes, model, &store, mean, cov);
  for (size_t k = 0; k < grid.nodes.n; k++) {
    const double off = record->y[0][k] - mean[k * (size_t)model->order];
    square += off * off;
    left += 1.0 - cov[6 * k];
  }
  rot_smooth_store_free(&store);
  rot_smooth_grid_free(&grid);
  return (double)record->n * (log(square) - 2.0 * log(left));
}

/* An oscillation: lambda is lowered from that of the likelihood, as far as cross-validation falls,
 * and the order grows where the motion has one more derivative. */
static void refined(void) {
  static samples of;
  int lowered = 0;
  for (int trial = 0; trial < 5; trial++) {
    make_samples(&of, 400);
    for (int i = 0; i < 400; i++) of.theta[i] = 2.0 * sin(3.0 * of.time[i]) + 0.02 * normal();
    const rot_smooth_finding how = {0, 0, 4, 4, 0};
    rot_smooth_fit fit, kept;
    size_t n = 0;
    double objective, before;
    ROT_CHECK(rot_smooth_find(&of.record, &how, NULL, &n, NULL, &fit) == ROT_OK);
    kept = fit;
    ROT_CHECK(rot_smooth_refine(&of.record, 0, NULL, 4, NULL, &fit) == ROT_OK);
    ROT_CHECK_EQ_INT(fit.model.order, 4);
    const double min = validation(&of.record, &fit.model, &objective);
    ROT_CHECK_REL(fit.objective, objective, 1e-10);
    if (fit.model.lambda < kept.model.lambda) {
      lowered++;
      ROT_CHECK(min < validation(&of.record, &kept.model, &before) - 0.45);
      ROT_CHECK(objective > before && fit.sigma > kept.sigma);
    } else
      ROT_CHECK_REL(fit.model.lambda, kept.model.lambda, 1e-12);
    const rot_smooth_model beyond = {4, fit.model.lambda * pow(10.0, -0.25)};
    if (fit.model.lambda > 0.06 * kept.model.lambda)
      ROT_CHECK(validation(&of.record, &beyond, &before) > min - 0.55);
    ROT_CHECK(rot_smooth_refine(&of.record, 0, NULL, 5, NULL, &kept) == ROT_OK);
    ROT_CHECK(kept.model.order >= 4);
  }
  ROT_CHECK(lowered >= 2);
  /* An exponential has order 5. */
  for (int trial = 0; trial < 4; trial++) {
    make_samples(&of, 400);
    for (int i = 0; i < 400; i++)
      of.theta[i] = 30.0 * (1.0 - exp(-of.time[i] / 3.0)) + 3e-3 * normal();
    const rot_smooth_finding how = {0, 0, 3, 4, 0};
    rot_smooth_fit fit;
    size_t n = 0;
    ROT_CHECK(rot_smooth_find(&of.record, &how, NULL, &n, NULL, &fit) == ROT_OK);
    ROT_CHECK_EQ_INT(fit.model.order, 4);
    ROT_CHECK(rot_smooth_refine(&of.record, 0, NULL, 5, NULL, &fit) == ROT_OK);
    ROT_CHECK_EQ_INT(fit.model.order, 5);
    /* Its lambda is the likelihood's, some quarters of a decade lowered. */
    double min = HUGE_VAL, best = 0.0;
    for (double up = -0.5; up < 1.6; up += 0.01) {
      const rot_smooth_model model = {5, fit.model.lambda * pow(10.0, up)};
      const double objective = likelihood(&of.record, &model);
      if (objective < min) min = objective, best = up;
    }
    const double quarters = best / 0.25;
    ROT_CHECK(fabs(quarters - round(quarters)) < 0.16 && quarters > -0.2);
  }
}

/* Random nodes of every kind: variances are finite and not negative, covariances within them. */
static void random_nodes(void) {
  const char *asked = getenv("ROT_SMOOTH_RECORDS"), *from = getenv("ROT_SMOOTH_SEED");
  const long records = asked ? strtol(asked, NULL, 10) : rot_test_trials(4000);
  static double gap[N], y[N], z[N], v[N], w[N], mean[N * P], cov[N * 6];
  static signed char first[N];
  if (from) seed = 20221u + (uint64_t)strtoul(from, NULL, 10) * 2654435761u;
  for (long i = 0; i < records; i++) {
    const int p = 2 + (int)(4.0 * uniform());
    const size_t n = 1 + (size_t)(uniform() * uniform() * N);
    const double range = pow(10.0, 8.0 * uniform()), few = uniform() < 0.2 ? 0.7 : 0.05;
    for (size_t k = 0; k < n; k++) {
      gap[k] = k ? pow(10.0, uniform() < 0.05 ? 3.0 * uniform() : uniform() - 0.7) : 0.0;
      if (uniform() < 0.02) gap[k] = 0.0;
      first[k] = ROT_SMOOTH_FLOWS;
      y[k] = uniform() < few ? NAN : range * sin(0.3 * (double)k) + normal();
      z[k] = uniform() < few ? NAN : 0.3 * range * cos(0.3 * (double)k) + normal();
      v[k] = pow(10.0, 2.0 * uniform() - 1.0);
      w[k] = pow(10.0, 2.0 * uniform() - 1.0);
      if (k > 0 && uniform() < 0.03) {
        gap[k] = 0.0;
        first[k] = (signed char)(p > 2 && uniform() < 0.5 ? 2 : 1);
      }
    }
    first[0] = ROT_SMOOTH_STARTS;
    const int kind = (int)(3.0 * uniform());
    const rot_smooth_nodes nodes = {
        n, gap, {kind == 1 ? NULL : y, kind == 0 ? NULL : z}, {v, w}, first, 0, NULL, NULL, 0};
    const rot_smooth_model model = {p, pow(10.0, 20.0 * uniform() - 14.0)};
    rot_smooth_store store;
    rot_smooth_sums sums;
    if (rot_smooth_store_new(&store, n, p) != ROT_OK) return;
    rot_smooth_filter(&nodes, &model, 0, n, &store, 1, &sums);
    rot_smooth_smooth(&nodes, &model, &store, mean, cov);
    int fine = isfinite(sums.log_f) && isfinite(sums.square);
    for (size_t k = 0; k < n; k++) {
      const double *c = cov + 6 * k;
      fine = fine && isfinite(mean[k * (size_t)p]) && isfinite(mean[k * (size_t)p + 1]);
      fine = fine && c[0] >= 0.0 && c[3] >= 0.0 && c[5] >= 0.0;
      fine = fine && c[1] * c[1] <= c[0] * c[3] * (1.0 + 1e-9);
      fine = fine && c[4] * c[4] <= c[3] * c[5] * (1.0 + 1e-9);
    }
    ROT_CHECK(fine);
    rot_smooth_store_free(&store);
  }
}

/* Covariance of a p-fold integral of white noise of density 1, both from 0: by expansion about the
 * earlier time, the integral of (t - v)^(p-1) (s - v)^(p-1)/(p-1)!^2 from 0 to the smaller. */
static double covariance_of(double t, double s, int p) {
  const double difference = fabs(t - s), min = fmin(t, s);
  double sum = 0.0, directions = 1.0, whole = 1.0;
  for (int j = 0; j < p; j++) {
    sum += directions * pow(difference, p - 1 - j) * pow(min, p + j) / (p + j);
    directions *= (double)(p - 1 - j) / (j + 1);
  }
  for (int j = 2; j < p; j++) whole *= j;
  return sum / (whole * whole);
}

enum { FEW = 30, DIFFUSE = 2 * P };

/* n log GCV by dense matrices: samples have V = 1 + their process, and the diffuse states X; their
 * residuals are R y, R = V^-1 - V^-1 X (X' V^-1 X)^-1 X' V^-1, and n - edf is the trace of R. R is
 * built by eliminating the columns of X one by one. A second segment starts at `split` (0: none),
 * behind `kink` the rate and higher derivatives are new (0: none). */
static double dense_validation(int n, const double t[], const double y[], int split, double kink,
                               int p, double lambda) {
  static double r[FEW][2 * FEW];
  double x[DIFFUSE][FEW] = {{0.0}};
  int columns = 0;
  for (int part = 0; part < (split ? 2 : 1); part++)
    for (int j = 0; j < p; j++, columns++)
      for (int i = part ? split : 0; i < (part || !split ? n : split); i++)
        x[columns][i] = pow((t[i] - (part ? t[split] : 0.0)) / n, j);
  for (int j = 1; j < p && kink > 0.0; j++, columns++)
    for (int i = 0; i < n; i++)
      if (t[i] > kink) x[columns][i] = pow((t[i] - kink) / n, j);
  for (int i = 0; i < n; i++) {
    for (int k = 0; k < n; k++) {
      const double from = split && i >= split ? t[split] : 0.0;
      double v = 0.0;
      if (!split || (i >= split) == (k >= split)) {
        const double a = t[i] - from, b = t[k] - from;
        if (kink > 0.0) {
          v = covariance_of(fmin(a, kink), fmin(b, kink), p);
          if (a > kink && b > kink) v += covariance_of(a - kink, b - kink, p);
        } else
          v = covariance_of(a, b, p);
      }
      r[i][k] = lambda * v + (i == k);
      r[i][n + k] = i == k;
    }
  }
  for (int c = 0; c < n; c++) { /* Gauss and Jordan; V is positive definite */
    const double by = 1.0 / r[c][c];
    for (int k = 0; k < 2 * n; k++) r[c][k] *= by;
    for (int i = 0; i < n; i++) {
      const double factor = r[i][c];
      for (int k = 0; i != c && k < 2 * n; k++) r[i][k] -= factor * r[c][k];
    }
  }
  for (int c = 0; c < columns; c++) {
    double along[FEW], size = 0.0;
    for (int i = 0; i < n; i++) {
      along[i] = 0.0;
      for (int k = 0; k < n; k++) along[i] += r[i][n + k] * x[c][k];
      size += along[i] * x[c][i];
    }
    for (int i = 0; i < n; i++)
      for (int k = 0; k < n; k++) r[i][n + k] -= along[i] * along[k] / size;
  }
  double square = 0.0, left = 0.0;
  for (int i = 0; i < n; i++) {
    double residual = 0.0;
    for (int k = 0; k < n; k++) residual += r[i][n + k] * y[k];
    square += residual * residual;
    left += r[i][n + i];
  }
  return n * (log(square) - 2.0 * log(left));
}

/* Short records, where the first samples and the diffuse states count: lambda is lowered by the
 * quarters of a decade that dense matrices say, of one segment, of two, behind a break. */
static void lowered_as_dense(void) {
  double t[FEW], y[FEW];
  int segment[FEW], seen[6] = {0}, compared = 0;
  for (int trial = 0; trial < 300; trial++) {
    const int n = 16 + trial % 15, p = 2 + trial % 2, split = trial % 3 == 1 ? n / 2 : 0;
    const double kink = trial % 3 == 2 ? 0.5 * n + 0.25 : 0.0;
    const double swing = pow(10.0, 1.5 * uniform()), rate = 0.3 + 0.7 * uniform();
    const double at = 2.0 * uniform() - 0.5;
    for (int i = 0; i < n; i++) {
      t[i] = i;
      segment[i] = split && i >= split;
      y[i] = swing * sin(rate * i) + (kink > 0.0 && i > kink ? swing * (i - kink) : 0.0) + normal();
    }
    double value[6];
    int want = 0, clear = 1;
    for (int step = 0; step < 6; step++)
      value[step] = dense_validation(n, t, y, split, kink, p, pow(10.0, at - 0.25 * step));
    for (int step = 1; step < 6 && want == step - 1; step++) {
      const double falls = value[step - 1] - value[step];
      if (falls > 0.5) want = step;
      clear = clear && fabs(falls - 0.5) > 0.02;
    }
    if (!clear) continue;
    const rot_smooth_record record = {
        (size_t)n, t, {y, NULL}, {NULL, NULL}, split ? segment : NULL, {0.0, 0.0}, NULL, NULL, 0};
    const rot_smooth_break broken = {kink, 0, 1};
    rot_smooth_fit fit = {.model = {p, pow(10.0, at)}, .ratio = 1.0, .end = ROT_SMOOTH_WITHIN};
    ROT_CHECK(rot_smooth_refine(&record, kink > 0.0, &broken, p, NULL, &fit) == ROT_OK);
    ROT_CHECK_REL(fit.model.lambda, pow(10.0, at - 0.25 * want), 1e-12);
    seen[want]++;
    compared++;
  }
  printf("lowered as by dense matrices: %d records; steps %d %d %d %d %d %d\n", compared, seen[0],
         seen[1], seen[2], seen[3], seen[4], seen[5]);
  ROT_CHECK(compared > 250 && seen[0] > 15 && seen[5] > 15 && seen[2] + seen[3] > 10);
}

/* A switched torque is no impact: a jump of omega, one state more, has to pay for itself. A small
 * impact is one. */
static void switch_or_impact(void) {
  static samples of;
  int switches = 0, impacts = 0;
  for (int trial = 0; trial < 12; trial++) {
    const double at = 4.0 + 0.02 * uniform();
    for (int struck = 0; struck < 2; struck++) {
      make_samples(&of, 400);
      for (int i = 0; i < 400; i++) {
        const double t = of.time[i], since = fmax(0.0, t - at);
        of.theta[i] =
            5.0 * t + 4.0 * since * since + (struck ? 0.5 * since : 0.0) + 1e-3 * normal();
      }
      const rot_smooth_finding how = {1, 0, 3, 4, 10};
      rot_smooth_break breaks[10];
      rot_smooth_fit fit;
      size_t n = 0;
      ROT_CHECK(rot_smooth_find(&of.record, &how, breaks, &n, NULL, &fit) == ROT_OK);
      if (n != 1 || fabs(breaks[0].time_s - at) > 0.05) continue;
      switches += !struck && breaks[0].first == 2;
      impacts += struck && breaks[0].first == 1;
    }
  }
  printf("of 12: %d switched torques, %d impacts\n", switches, impacts);
  ROT_CHECK(switches >= 10 && impacts >= 10);
}

int main(void) {
#ifdef __SIZEOF_FLOAT128__
  quadruple_precision();
#endif
  leave_one_out();
  score_of_shock();
  kept_gain();
  draws();
  impact_and_outlier();
  exact_line();
  refined();
  random_nodes();
  lowered_as_dense();
  switch_or_impact();
  return rot_test_report("smooth");
}
