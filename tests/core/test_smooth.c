/* The smoother of samples: against a smoother in quadruple precision, closed forms, random
 * records. */
#include "rot_smooth.h"

#include <stdlib.h>

#include "rot_test.h"

enum { P = ROT_SMOOTH_MOST };

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

enum { WIDE = 2 * P + 1 };

static void quad_triangle(quad m[][WIDE], int rows, int columns) {
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
static void transition(const rot_smooth_model *model, quad s, quad out[][WIDE]) {
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
    for (int c = 0; c < WIDE; c++) {
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
  const int p = model->order, wide = 2 * p + 1;
  const size_t n = nodes->n;
  quad(*kept)[P][WIDE] = calloc(n, sizeof *kept); /* R, T, z: R x = z - T x+ */
  quad info[P + 1][WIDE];                         /* of the node: p columns and z, by triangle */
  memset(info, 0, sizeof info);
  for (size_t k = 0; k < n; k++) {
    if (k > 0) {
      quad m[2 * P][WIDE], over[P][WIDE];
      memset(m, 0, sizeof m);
      transition(model, nodes->gap[k], over);
      for (int r = 0; r < p; r++) {
        for (int c = 0; c < p; c++) m[r][c] = info[r][c];
        m[r][2 * p] = info[r][p];
        memcpy(m[p + r], over[r], sizeof over[r]);
      }
      quad_triangle(m, 2 * p, wide);
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
    for (int c = 0; c < wide; c++)
      kept[n - 1][r][c] = c < p ? info[r][c] : c == 2 * p ? info[r][p] : 0;
  for (size_t k = n; k-- > 0;) {
    quad(*row)[WIDE] = kept[k];
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
    for (int i = 0; i < p; i++)
      for (int j = 0; j < p; j++) {
        quad sum = 0;
        for (int a = 0; a < p; a++)
          for (int b = 0; b < p; b++) {
            quad inner = a == b;
            for (int c = 0; after && c < p; c++)
              for (int d = 0; d < p; d++) inner += row[a][p + c] * after[c * p + d] * row[b][p + d];
            sum += inverse[i][a] * inner * inverse[j][b];
          }
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
  const rot_smooth_nodes nodes = {N, gap, {y, rates ? z : NULL}, {NULL, NULL}, first};
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
      const double apart = (double)((quad)got[k * p + i] - mean[k * p + i]);
      worst = fmax(worst, fabs(sqrt(cov[6 * k + at[i]] / variance) - 1.0));
      off = fmax(off, fabs(apart) / sqrt(variance));
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

int main(void) {
#ifdef __SIZEOF_FLOAT128__
  quadruple_precision();
#endif
  return rot_test_report("smooth");
}
