/* One step of Radau IIA: every coefficient, its order, its Newton. */
#include "maths/radau.h"
#include "ground/real.h"
#include "rot_test.h"

/* y0' = y1, y1' = t^power: what a ninth-order collocation must get to rounding. */
static int power_of_time(double t, const double y[], double f[], void *ctx) {
  f[0] = y[1];
  f[1] = pow(t, *(const double *)ctx);
  f[2] = y[1] * 3.0; /* an integral along the way */
  return 0;
}

static void check_coefficients(void) {
  for (double power = 0.0; power <= 7.0; power += 1.0) {
    rot_radau *r = rot_radau_alloc(3, 2);
    double y[] = {0.0, 0.0, 0.0}, error[3];
    const double slope[] = {0.0, power == 0.0 ? 1.0 : 0.0, 0.0}, allowed[] = {1e-6, 1e-6, 1e-6};
    ROT_CHECK_EQ_INT(
        rot_radau_step(r, power_of_time, &power, 0.0, 2.0, y, error, slope, allowed, 0),
        ROT_RADAU_OK);
    const double want = pow(2.0, power + 2.0) / ((power + 1.0) * (power + 2.0));
    ROT_CHECK_REL(y[1], pow(2.0, power + 1.0) / (power + 1.0), 1e-15);
    ROT_CHECK_REL(y[0], want, 1e-15);
    ROT_CHECK_REL(y[2], 3.0 * want, 1e-15);
    /* The embedded formula is exact up to t^4 at the first level. */
    if (power <= 3.0) ROT_CHECK(fabs(error[0]) <= 1e-13 && fabs(error[1]) <= 1e-13);
    if (power == 5.0) ROT_CHECK(fabs(error[1]) > 1e-6);
    rot_radau_free(r);
  }
}

/* y' = rate (cos t - y), one component */
static int towards_cosine(double t, const double y[], double f[], void *ctx) {
  f[0] = *(const double *)ctx * (cos(t) - y[0]);
  return 0;
}

/* y' = -y^3: 1/sqrt(1 + 2 t) */
static int cube(double t, const double y[], double f[], void *ctx) {
  (void)t;
  ++*(long *)ctx;
  f[0] = -y[0] * y[0] * y[0];
  return 0;
}

static double stepping(int n, double end, long *calls) {
  rot_radau *r = rot_radau_alloc(1, 1);
  double y[] = {1.0}, error[1], allowed[] = {1e-7};
  for (int i = 0; i < n; i++) {
    const double slope[] = {-y[0] * y[0] * y[0]};
    ROT_CHECK_EQ_INT(
        rot_radau_step(r, cube, calls, i * (end / n), end / n, y, error, slope, allowed, 0), 0);
  }
  rot_radau_free(r);
  return y[0] - 1.0 / sqrt(1.0 + 2.0 * end);
}

static void check_order(void) {
  long calls = 0;
  const double coarse = stepping(6, 2.0, &calls), fine = stepping(12, 2.0, &calls);
  printf("order %.2f, %.1f calls a step\n", log2(fabs(coarse / fine)), (double)calls / 18.0);
  ROT_CHECK(log2(fabs(coarse / fine)) > 8.0);
  ROT_CHECK(calls < 18 * 45);
}

/* A step of 1e12 time constants lands on the slow motion. */
static void check_stiff(void) {
  for (double rate = 1e2; rate < 1e13; rate *= 100.0) {
    rot_radau *r = rot_radau_alloc(1, 1);
    double y[] = {7.0}, error[1];
    const double slope[] = {rate * (1.0 - 7.0)}, allowed[] = {1e-6};
    ROT_CHECK_EQ_INT(
        rot_radau_step(r, towards_cosine, &rate, 0.0, 1.0, y, error, slope, allowed, 0), 0);
    const double settled = (rate * rate * cos(1.0) + rate * sin(1.0)) / (1.0 + rate * rate);
    ROT_CHECK(fabs(y[0] - settled) <= 60.0 / rate + 1e-13);
    rot_radau_free(r);
  }
}

/* What grows by more than exp(4) in a step is not for it, whichever component grows. */
static int difference(double t, const double y[], double f[], void *ctx) {
  const double *rate = ctx;
  (void)t;
  f[0] = rate[0] * y[0];
  f[1] = rate[1] * y[1];
  return 0;
}

static void check_propagation(void) {
  for (int first = 0; first < 2; first++) {
    for (int fast = 0; fast < 2; fast++) {
      double rate[2] = {-1.0, -1.0}, y[] = {1.0, 1.0}, error[2];
      rate[first] = fast ? 4.2 : 3.8;
      const double slope[] = {rate[0], rate[1]}, allowed[] = {1e-3, 1e-3};
      rot_radau *r = rot_radau_alloc(2, 2);
      ROT_CHECK_EQ_INT(rot_radau_step(r, difference, rate, 0.0, 1.0, y, error, slope, allowed, 0),
                       fast ? ROT_RADAU_DIVERGED : ROT_RADAU_OK);
      rot_radau_free(r);
    }
  }
}

/* What the right-hand side says ends the step. */
static int says(double t, const double y[], double f[], void *ctx) {
  (void)t;
  f[0] = -y[0];
  return --*(int *)ctx < 0 ? 42 : 0;
}

static void check_stop(void) {
  for (int k = 0; k < 6; k++) {
    rot_radau *r = rot_radau_alloc(1, 1);
    int left = k;
    double y[] = {1.0}, error[1];
    const double slope[] = {-1.0}, allowed[] = {1e-6};
    ROT_CHECK_EQ_INT(rot_radau_step(r, says, &left, 0.0, 0.5, y, error, slope, allowed, 0), 42);
    ROT_CHECK(y[0] == 1.0);
    rot_radau_free(r);
  }
}

/* y' = -y^2, and y'' = -sin y: one step, against the collocation of five stages by 40 digits. What
 * Newton's iteration may leave is less than a rounding here. */
static int square(double t, const double y[], double f[], void *ctx) {
  (void)t, (void)ctx;
  f[0] = -y[0] * y[0];
  return 0;
}

static int pendulum(double t, const double y[], double f[], void *ctx) {
  (void)t, (void)ctx;
  f[0] = y[1];
  f[1] = -sin(y[0]);
  return 0;
}

static void check_digits(void) {
  const double allowed[] = {1e-10, 1e-10};
  double y[] = {1.0, 0.5}, error[2], slope[] = {-1.0, 0.0};
  rot_radau *one = rot_radau_alloc(1, 1), *two = rot_radau_alloc(2, 2);
  ROT_CHECK_EQ_INT(rot_radau_step(one, square, NULL, 0.0, 0.5, y, error, slope, allowed, 0), 0);
  ROT_CHECK_ULP(y[0], 0.6666666666625905220603126, 4);
  y[0] = 1.0;
  slope[0] = 0.5, slope[1] = -sin(1.0);
  ROT_CHECK_EQ_INT(rot_radau_step(two, pendulum, NULL, 0.0, 1.0, y, error, slope, allowed, 0), 0);
  ROT_CHECK_ULP(y[0], 1.056272124833736355523172, 4);
  ROT_CHECK_ULP(y[1], -0.3919652846285381059630473, 8);
  rot_radau_free(one);
  rot_radau_free(two);
}

int main(void) {
  check_coefficients();
  check_order();
  check_stiff();
  check_propagation();
  check_stop();
  check_digits();
  return rot_test_report("radau");
}
