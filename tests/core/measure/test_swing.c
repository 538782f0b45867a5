/* Free oscillations: closed forms, a first integral, differences for the derivatives. */
#include "measure/swing.h"
#include "rot_test.h"

enum { N = 160, P = ROT_SWING_PARAMETERS };

static rot_swing swing_of(double theta, double omega, double omega0, double decay, double coulomb,
                          double quadratic, int spring, int rate) {
  return (rot_swing){{theta, omega, omega0, decay, coulomb, quadratic}, spring, rate};
}

static void times(double t[N], double start, double step) {
  for (int i = 0; i < N; i++) t[i] = start + step * i + (i % 3) * 0.1 * step;
}

/* theta = exp(-g t) (A cos(w t) + (v + g A)/w sin(w t)) */
static void check_viscous_spring(void) {
  const double a = 0.7, v = -2.0, w0 = 5.0, g = 0.3, w = sqrt(w0 * w0 - g * g);
  double t[N], y[N], z[N], d[N * P];
  times(t, 3.0, 0.05);
  const rot_swing angle = swing_of(a, v, w0, g, 0, 0, 1, 0),
                  rate = swing_of(a, v, w0, g, 0, 0, 1, 1);
  ROT_CHECK(rot_swing_rows(&angle, 3.0, N, t, NULL, y, d) == ROT_OK);
  ROT_CHECK(rot_swing_rows(&rate, 3.0, N, t, NULL, z, d) == ROT_OK);
  for (int i = 0; i < N; i++) {
    const double x = t[i] - 3.0, b = (v + g * a) / w, e = exp(-g * x);
    const double s = sin(w * x), c = cos(w * x);
    ROT_CHECK(fabs(y[i] - e * (a * c + b * s)) < 2e-14);
    ROT_CHECK(fabs(z[i] - e * ((b * w - g * a) * c - (a * w + g * b) * s)) < 1e-13);
  }
}

/* Dry friction moves the centre by delta = a/w0^2 in each half swing; the body stops where the
 * spring cannot pull it on. */
static void check_coulomb_spring(void) {
  const double w0 = 2.0, a = 0.6, delta = a / (w0 * w0);
  const rot_swing swing = swing_of(1.0, 0.0, w0, 0, a, 0, 1, 0);
  double t[10], y[10], d[10 * P], late[2] = {40.0, 80.0};
  size_t n;
  ROT_CHECK(rot_swing_extremes(&swing, 0.0, 60.0, 10, NULL, &n, t, y, d) == ROT_OK);
  /* 1, -.7, .4, -.1: |-.1| < .15 is the rest. */
  ROT_CHECK(n == 3);
  for (size_t i = 0; i < n; i++) {
    const double k = (double)(i + 1), sign = i % 2 ? 1.0 : -1.0;
    ROT_CHECK(fabs(t[i] - k * 3.14159265358979323846 / w0) < 1e-14);
    ROT_CHECK(fabs(y[i] - sign * (1.0 - 2.0 * delta * k)) < 1e-14);
    ROT_CHECK(fabs(d[i * P + ROT_SWING_COULOMB] + sign * 2.0 * k / (w0 * w0)) < 1e-13);
    ROT_CHECK(fabs(d[i * P + ROT_SWING_THETA] - sign) < 1e-14);
    ROT_CHECK(fabs(d[i * P + ROT_SWING_OMEGA0] - sign * 4.0 * k * delta / w0) < 1e-13);
  }
  ROT_CHECK(rot_swing_rows(&swing, 0.0, 2, late, NULL, y, d) == ROT_OK);
  ROT_CHECK(fabs(y[0] + 0.1) < 1e-14 && y[1] == y[0]);
}

/* Between turning points theta'^2 = C exp(-+2 k theta) + closed form: the extremes of a pendulum
 * in a fluid. */
static double square_rate(double w0, double k, double theta, double side) {
  return 2.0 * w0 * w0 * (cos(theta) - 2.0 * k * side * sin(theta)) / (1.0 + 4.0 * k * k);
}

static void check_quadratic_pendulum(void) {
  for (int i = 0; i < 6; i++) {
    const double w0 = 3.0, k = 0.02 * (i - 1), start = 0.4 + 0.5 * i;
    const rot_swing swing = swing_of(start, 0.0, w0, 0, 0, k, 0, 0);
    double t[20], y[20], d[20 * P];
    size_t n;
    ROT_CHECK(rot_swing_extremes(&swing, 0.0, 15.0, 20, NULL, &n, t, y, d) == ROT_OK);
    ROT_CHECK(n >= 8);
    for (size_t j = 0; j < n; j++) {
      const double from = j ? y[j - 1] : start, side = from > 0.0 ? -1.0 : 1.0;
      const double c = -square_rate(w0, k, from, side) * exp(2.0 * k * side * from);
      const double left = c * exp(-2.0 * k * side * y[j]) + square_rate(w0, k, y[j], side);
      ROT_CHECK(fabs(left) < 2e-14 * w0 * w0);
      ROT_CHECK(from * y[j] < 0.0);
    }
  }
}

/* Without losses the half period is 2 K(k)/omega0 = pi/(omega0 AGM(1, cos(A/2))). */
static void check_period(void) {
  for (int i = 1; i < 32; i++) {
    const double amplitude = 0.1 * i, w0 = 4.0;
    double a = 1.0, b = cos(0.5 * amplitude), t[6], y[6], d[6 * P];
    size_t n;
    while (fabs(a - b) > 1e-15 * a) {
      const double mean = 0.5 * (a + b);
      b = sqrt(a * b);
      a = mean;
    }
    const rot_swing swing = swing_of(amplitude, 0.0, w0, 0, 0, 0, 0, 0);
    ROT_CHECK(rot_swing_extremes(&swing, 1.0, 100.0, 6, NULL, &n, t, y, d) == ROT_OK);
    ROT_CHECK(n == 6);
    const double sensitive = 1.0 / (3.2 - amplitude);
    for (size_t j = 0; j < n; j++) {
      const double want = 1.0 + (double)(j + 1) * 3.14159265358979323846 / (w0 * a);
      ROT_CHECK(fabs(t[j] - want) < 1e-13 * sensitive * sensitive);
      ROT_CHECK(fabs(fabs(y[j]) - amplitude) < 1e-13 * sensitive);
    }
  }
}

/* Derivatives by central differences, over turning points, with all losses. */
static void check_derivatives(void) {
  for (int kind = 0; kind < 8; kind++) {
    rot_swing swing = swing_of(0.9, 1.1, 3.0, 0.04, 0.05, 0.03, kind & 1, kind >> 1 & 1);
    if (kind & 4) {
      swing.p[ROT_SWING_COULOMB] = -0.02;
      swing.p[ROT_SWING_QUADRATIC] = -0.01;
      swing.p[ROT_SWING_DECAY] = -0.01;
    }
    double t[N], y[N], d[N * P], x[4][N], unused[N * P], te[20], ye[20], de[20 * P];
    size_t n, m;
    times(t, 0.0, 0.07);
    ROT_CHECK(rot_swing_rows(&swing, 0.0, N, t, NULL, y, d) == ROT_OK);
    ROT_CHECK(rot_swing_extremes(&swing, 0.0, 9.0, 20, NULL, &n, te, ye, de) == ROT_OK);
    ROT_CHECK(n >= 7);
    for (int j = 0; j < P; j++) {
      const double h = 1e-4;
      for (int side = 0; side < 4; side++) {
        rot_swing moved = swing;
        moved.p[j] += (side & 1 ? -h : h) * (side & 2 ? 0.5 : 1.0);
        ROT_CHECK(rot_swing_rows(&moved, 0.0, N, t, NULL, x[side], unused) == ROT_OK);
      }
      for (int i = 0; i < N; i++) {
        const double simd = (x[0][i] - x[1][i]) / (2 * h), near = (x[2][i] - x[3][i]) / h;
        /* A rate has a kink where friction reverses: not at 1e-4 around it. */
        const int kink = (kind >> 1 & 1) && fabs(y[i]) < 0.03;
        const double want = (4.0 * near - simd) / 3.0;
        if (!kink) ROT_CHECK(fabs(d[i * P + j] - want) < 2e-9 * fmax(1.0, fabs(want)));
      }
      for (int side = 0; side < 4; side++) {
        rot_swing moved = swing;
        moved.p[j] += (side & 1 ? -h : h) * (side & 2 ? 0.5 : 1.0);
        ROT_CHECK(rot_swing_extremes(&moved, 0.0, 9.0, 20, NULL, &m, te, x[side], unused) == 0);
        ROT_CHECK(m == n);
      }
      for (size_t i = 0; i < n; i++) {
        const double simd = (x[0][i] - x[1][i]) / (2 * h), near = (x[2][i] - x[3][i]) / h;
        const double want = (4.0 * near - simd) / 3.0;
        ROT_CHECK(fabs(de[i * P + (size_t)j] - want) < 2e-9 * fmax(1.0, fabs(want)));
      }
    }
  }
}

/* Of a swing of 1e-164 rad the squares leave the doubles, and the derivative by the quadratic loss
 * begins with terms that are 0: theta = exp(-g t) (A cosh(k t) + g A/k sinh(k t)) all the same. */
static void check_faint(void) {
  const double a = 1e-164, g = 20.0, k = sqrt(g * g - 1.0);
  const double t[] = {0.02, 0.1, 0.5};
  double y[3], d[3 * P];
  const rot_swing swing = swing_of(a, 0.0, 1.0, g, 0, 0, 1, 0);
  ROT_CHECK_EQ_INT(rot_swing_rows(&swing, 0.0, 3, t, NULL, y, d), ROT_OK);
  for (int i = 0; i < 3; i++) {
    const double x = k * t[i];
    ROT_CHECK_REL(y[i], a * exp(-g * t[i]) * (cosh(x) + g / k * sinh(x)), 1e-13);
  }
}

static void check_refusals(void) {
  double t[2] = {0.0, 1.0}, y[2], d[2 * P];
  rot_swing swing = swing_of(0.1, 0, 0, 0, 0, 0, 0, 0);
  ROT_CHECK(rot_swing_rows(&swing, 0.0, 2, t, NULL, y, d) == ROT_EVALUE);
  swing.p[ROT_SWING_OMEGA0] = 1.0;
  ROT_CHECK(rot_swing_rows(&swing, 0.5, 2, t, NULL, y, d) == ROT_EVALUE);
  swing.p[ROT_SWING_DECAY] = NAN;
  ROT_CHECK(rot_swing_rows(&swing, 0.0, 2, t, NULL, y, d) == ROT_EVALUE);
  /* Stiff: creeps, and does not swing. */
  swing = swing_of(0.1, 0, 1, 1e5, 0, 0, 0, 0);
  t[1] = 1e3;
  ROT_CHECK(rot_swing_rows(&swing, 0.0, 2, t, NULL, y, d) == ROT_EBUDGET);
  /* Growth beyond double precision. */
  swing = swing_of(0.1, 0, 1, -5, 0, 0, 1, 0);
  t[1] = 1e4;
  ROT_CHECK(rot_swing_rows(&swing, 0.0, 2, t, NULL, y, d) == ROT_ERANGE);
}

int main(void) {
  check_viscous_spring();
  check_coulomb_spring();
  check_quadratic_pendulum();
  check_period();
  check_derivatives();
  check_faint();
  check_refusals();
  return rot_test_report("swing");
}
