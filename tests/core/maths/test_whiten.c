/* Whitening against the dense covariance matrix; REML against its own definition. */
#include <stdlib.h>

#include "rot_test.h"
#include "maths/whiten.h"

enum { N = 40, MANY = 400 };

static double uniform(uint64_t *state) {
  *state = *state * 6364136223846793005u + 1442695040888963407u;
  return ((double)(*state >> 11) + 0.5) * 0x1p-53;
}

static double normal(uint64_t *state) {
  const double r = sqrt(-2.0 * log(uniform(state)));
  return r * cos(6.283185307179586 * uniform(state));
}

/* The lower Cholesky factor of the covariance. */
static void factor(const rot_noise *noise, const double t[], double l[N][N]) {
  for (int i = 0; i < N; i++) {
    for (int j = 0; j <= i; j++) {
      double sum =
          (1.0 - noise->white) * exp(-(t[i] - t[j]) / noise->tau_s) + (i == j ? noise->white : 0.0);
      for (int k = 0; k < j; k++) sum -= l[i][k] * l[j][k];
      l[i][j] = i == j ? sqrt(sum) : sum / l[j][j];
    }
  }
}

/* The filter is the inverse of the Cholesky factor: uneven times, equal times, a gap. */
static void check_dense(void) {
  uint64_t seed = 3;
  for (int trial = 0; trial < rot_test_trials(200); trial++) {
    double t[N], x[2 * N], want[2 * N], l[N][N], logdet = 0.0;
    const rot_noise noise = {0.05 + 3.0 * uniform(&seed), 0.02 + 0.9 * uniform(&seed)};
    t[0] = 0.0;
    for (int i = 1; i < N; i++) t[i] = t[i - 1] + (trial % 2 ? 0.1 : 0.2 * uniform(&seed));
    if (trial % 3 == 0) t[7] = t[6];
    for (int i = 20; trial % 5 == 0 && i < N; i++) t[i] += 50.0;
    factor(&noise, t, l);
    for (int i = 0; i < 2 * N; i++) x[i] = want[i] = normal(&seed);
    for (int i = 0; i < N; i++) {
      logdet += 2.0 * log(l[i][i]);
      for (int c = 0; c < 2; c++) {
        for (int k = 0; k < i; k++) want[2 * i + c] -= l[i][k] * want[2 * k + c];
        want[2 * i + c] /= l[i][i];
      }
    }
    double got = NAN;
    ROT_CHECK(rot_whiten(&noise, N, t, 2, x, &got) == ROT_OK && fabs(got - logdet) < 1e-11);
    for (int i = 0; i < 2 * N; i++) ROT_CHECK(fabs(x[i] - want[i]) < 1e-11);
  }
}

static void check_white(void) {
  const rot_noise white[2] = {{0.0, 0.3}, {1.0, 1.0}};
  const double t[3] = {0.0, 1.0, 2.0};
  for (int i = 0; i < 2; i++) {
    double x[3] = {1.0, -2.0, 3.0}, logdet = NAN;
    ROT_CHECK(rot_whiten(white + i, 3, t, 1, x, &logdet) == ROT_OK);
    ROT_CHECK(logdet == 0.0 && x[0] == 1.0 && x[2] == 3.0);
  }
}

/* The most columns at once give what each gives alone; one more is refused, and nothing changes. */
static void check_max_columns(void) {
  enum { MAX = ROT_WHITEN_COLUMNS };
  const rot_noise noise = {0.4, 0.3};
  double t[3] = {0.0, 0.1, 0.3}, x[3 * MAX], alone[3], many[3 * (MAX + 1)];
  for (int i = 0; i < 3 * MAX; i++) x[i] = sin(i + 1.0);
  for (int i = 0; i < 3; i++) alone[i] = x[i * MAX + MAX - 1];
  ROT_CHECK(rot_whiten(&noise, 3, t, MAX, x, NULL) == ROT_OK);
  ROT_CHECK(rot_whiten(&noise, 3, t, 1, alone, NULL) == ROT_OK);
  for (int i = 0; i < 3; i++) ROT_CHECK(x[i * MAX + MAX - 1] == alone[i]);
  for (int i = 0; i < 3 * (MAX + 1); i++) many[i] = i;
  ROT_CHECK(rot_whiten(&noise, 3, t, MAX + 1, many, NULL) == ROT_EVALUE);
  for (int i = 0; i < 3 * (MAX + 1); i++) ROT_CHECK(many[i] == i);
}

/* Twice the restricted log likelihood of r for the columns J = (1, t), by the definition:
 * -(log|V| + log|J'V^-1 J| + (n - 2) log(r'Pr)). */
static double reml_of(const rot_noise *noise, const double t[], const double r[]) {
  double l[N][N], z[N][3], g[3][3] = {{0}}, sum = 0.0;
  factor(noise, t, l);
  for (int i = 0; i < N; i++) {
    const double row[3] = {1.0, t[i], r[i]};
    sum -= 2.0 * log(l[i][i]);
    for (int c = 0; c < 3; c++) {
      z[i][c] = row[c];
      for (int k = 0; k < i; k++) z[i][c] -= l[i][k] * z[k][c];
      z[i][c] /= l[i][i];
    }
    for (int a = 0; a < 3; a++) {
      for (int b = 0; b < 3; b++) g[a][b] += z[i][a] * z[i][b];
    }
  }
  const double det = g[0][0] * g[1][1] - g[0][1] * g[0][1];
  const double x = (g[1][1] * g[0][2] - g[0][1] * g[1][2]) / det;
  const double y = (g[0][0] * g[1][2] - g[0][1] * g[0][2]) / det;
  return sum - log(det) - (N - 2) * log(g[2][2] - x * g[0][2] - y * g[1][2]);
}

/* What REML finds is a maximum of the likelihood by its definition, and no grid finds a better. */
static void check_reml(void) {
  uint64_t seed = 9;
  int found = 0;
  for (int trial = 0; trial < rot_test_trials(40); trial++) {
    double t[N], r[N], J[2 * N], e = normal(&seed);
    for (int i = 0; i < N; i++) {
      t[i] = 0.1 * i;
      e = exp(-0.1 / 0.25) * e + sqrt(1.0 - exp(-0.2 / 0.25)) * normal(&seed);
      r[i] = e + 0.3 * normal(&seed);
      J[2 * i] = 1.0;
      J[2 * i + 1] = t[i];
    }
    rot_reml out;
    const double cap = 2.0;
    ROT_CHECK(rot_whiten_reml(N, t, 2, J, r, cap, 2.0, NULL, NULL, &out) == ROT_OK);
    const rot_noise white = {1.0, 1.0 - 1e-13};
    double best = -HUGE_VAL;
    for (int i = 0; i <= 40; i++) {
      for (int j = -16; j <= 16; j++) {
        const rot_noise noise = {0.026 * pow(cap / 0.026, i / 40.0), 1.0 / (1.0 + exp(-0.5 * j))};
        best = fmax(best, reml_of(&noise, t, r));
      }
    }
    const double at_white = reml_of(&white, t, r);
    if (out.noise.tau_s > 0.0) {
      const double height = reml_of(&out.noise, t, r);
      ROT_CHECK(fabs(out.gain - (height - at_white)) < 1e-6 * (1.0 + fabs(height)));
      ROT_CHECK(height > best - 0.02);
      ROT_CHECK(out.gain > 2.0);
      found++;
    } else {
      ROT_CHECK(best - at_white < 3.0);
    }
  }
  ROT_CHECK(found > rot_test_trials(40) / 2);
}

/* White residuals stay white, and a column that repeats another is left out. */
static void check_columns(void) {
  uint64_t seed = 21;
  int white = 0;
  for (int trial = 0; trial < 100; trial++) {
    double t[N], r[N], J[2 * N];
    for (int i = 0; i < N; i++) {
      t[i] = i;
      r[i] = normal(&seed);
      J[2 * i] = 1.0;
      J[2 * i + 1] = 2.0;
    }
    rot_reml out;
    ROT_CHECK(rot_whiten_reml(N, t, 2, J, r, 4.0, 4.0, NULL, NULL, &out) == ROT_OK);
    white += out.noise.tau_s == 0.0;
  }
  ROT_CHECK(white > 85);
}

/* => mean of t^2 of the mean of 200 records of n samples of e_i - ma e_(i-1) + ar r_(i-1), by the
 * noise found; found: how often it is anticorrelated */
static double square_of_mean(int n, double ma, double ar, int *found) {
  uint64_t seed = 8;
  double square = 0.0;
  *found = 0;
  for (int trial = 0; trial < 200; trial++) {
    double t[MANY], r[MANY], J[MANY], w[2 * MANY], last = normal(&seed), xx = 0.0, xy = 0.0,
                                                   yy = 0.0, before = normal(&seed);
    for (int i = 0; i < n; i++) {
      const double e = normal(&seed);
      t[i] = 0.1 * i;
      r[i] = before = e - ma * last + ar * before;
      last = e;
      J[i] = 1.0;
    }
    rot_reml out;
    ROT_CHECK(rot_whiten_reml((size_t)n, t, 1, J, r, 2.0, 2.0, NULL, NULL, &out) == ROT_OK);
    *found += out.noise.white > 1.0;
    for (int i = 0; i < n; i++) {
      w[2 * i] = J[i];
      w[2 * i + 1] = r[i];
    }
    ROT_CHECK(rot_whiten(&out.noise, (size_t)n, t, 2, w, NULL) == ROT_OK);
    for (int i = 0; i < n; i++) {
      xx += w[2 * i] * w[2 * i];
      xy += w[2 * i] * w[2 * i + 1];
      yy += w[2 * i + 1] * w[2 * i + 1];
    }
    square += xy * xy / xx / ((yy - xy * xy / xx) / (n - 1)) / 200.0;
  }
  return square;
}

/* Noise e_i - 0.6 e_(i-1): its mean has (1 - 0.6)^2/(1 + 0.6^2) = 0.118 of the variance that white
 * noise of its size would give it. Of an autoregression with -0.5 it has a third. */
static void check_anticorrelated(void) {
  int found = 0;
  double square = square_of_mean(MANY, 0.6, 0.0, &found);
  ROT_CHECK(found > 150 && square > 0.6 && square < 1.5);
  square = square_of_mean(MANY, 0.0, -0.5, &found);
  ROT_CHECK(found > 150 && square > 0.7 && square < 1.15);
}

/* The search ends where twice the log likelihood is known to 1e-3: some dozen values of it. */
static void check_effort(void) {
  uint64_t seed = 5;
  size_t max = 0;
  for (int trial = 0; trial < 40; trial++) {
    double t[N], r[N], J[N], e = normal(&seed);
    for (int i = 0; i < N; i++) {
      t[i] = 0.1 * i;
      e = exp(-0.4) * e + sqrt(1.0 - exp(-0.8)) * normal(&seed);
      r[i] = e + 0.3 * normal(&seed);
      J[i] = 1.0;
    }
    rot_reml out;
    ROT_CHECK(rot_whiten_reml(N, t, 1, J, r, 2.0, 2.0, NULL, NULL, &out) == ROT_OK);
    if (out.evaluations > max) max = out.evaluations;
  }
  printf("most values of the likelihood: %zu\n", max);
  ROT_CHECK(max < 400);
}

int main(void) {
  check_dense();
  check_white();
  check_max_columns();
  check_reml();
  check_columns();
  check_anticorrelated();
  check_effort();
  return rot_test_report("whiten");
}
