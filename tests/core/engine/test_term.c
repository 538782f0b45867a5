/* Terms of a torque law against values from mpmath, 50 digits. */
#include "engine/term.h"

#include <math.h>

#include "rot_test.h"

static rot_term term(rot_term_kind kind, size_t length, const double x[]) {
  return (rot_term){kind, -INFINITY, INFINITY, length, x};
}

static void test_values(void) {
  const double wave[] = {2.0, 3.0, 0.5}, fading[] = {0.7, 2.0, 1.0};
  rot_term t = term(ROT_TERM_SINUSOID, 3, wave);
  ROT_CHECK_ULP(rot_term_at(&t, 1.25, 0, 0, 0), -0.8921749798275856, 2); /* 2 cos(4.25) */
  /* The phase of a large angle: 2 cos(3e12 + 0.5), and 3 * 0.1 is not 0.3. */
  ROT_CHECK_ULP(rot_term_at(&t, 1e12, 0, 0, 0), 0.19553126616580463, 4);
  t = term(ROT_TERM_EXPONENTIAL, 3, fading);
  ROT_CHECK_ULP(rot_term_at(&t, 1.25, 0, 0, 0), 0.42457146179884343, 2); /* 0.7 exp(-0.5) */
  const double spring[] = {3.0, 0.5}, gravity[] = {2.0, 0.5};
  t = term(ROT_TERM_SPRING, 2, spring);
  ROT_CHECK_ULP(rot_term_at(&t, 9.0, 2.0, 0, 7.0), -4.5, 0);
  t = term(ROT_TERM_GRAVITY, 2, gravity);
  ROT_CHECK_ULP(rot_term_at(&t, 9.0, 2.0, 0, 7.0), -1.9949899732081089, 2); /* -2 sin(1.5) */
  /* Near rest what the angle's last digit leaves is all there is. */
  const double far[] = {3.0, 1e6}, upright[] = {2.0, 0.0};
  t = term(ROT_TERM_SPRING, 2, far);
  ROT_CHECK_ULP(rot_term_at(&t, 0.0, 1e6, 1e-14, 0.0), -3e-14, 1);
  t = term(ROT_TERM_GRAVITY, 2, far);
  ROT_CHECK_ULP(rot_term_at(&t, 0.0, 1e6, 1e-14, 0.0), -3e-14, 1);
  t = term(ROT_TERM_GRAVITY, 2, upright);
  ROT_CHECK_ULP(rot_term_at(&t, 0.0, 3.141592653589793, 1e-20, 0.0), -2.4490935982947064e-16, 2);
}

static void test_pieces(void) {
  /* 1 + 2 s + 3 s^2 on [0, 1), -1 + s^2/2 on [1, 3). */
  const double x[] = {2, 3, 0, 1, 3, 1, 2, 3, -1, 0, 0.5};
  rot_term t = term(ROT_TERM_POLYNOMIAL, 11, x);
  ROT_CHECK(rot_term_valid(&t));
  ROT_CHECK(rot_term_at(&t, -1e-300, 0, 0, 0) == 0.0);
  ROT_CHECK(rot_term_at(&t, 0.0, 0, 0, 0) == 1.0);
  ROT_CHECK(rot_term_at(&t, 0.5, 0, 0, 0) == 2.75);
  ROT_CHECK(rot_term_at(&t, 1.0, 0, 0, 0) == -1.0); /* after the jump */
  ROT_CHECK(rot_term_at(&t, 2.0, 0, 0, 0) == -0.5);
  ROT_CHECK(rot_term_at(&t, 3.0, 0, 0, 0) == 0.0);
  /* T_0 + 2 T_1 + 3 T_2 on [0, 2], u = t - 1. */
  const double y[] = {1, 3, 0, 2, 1, 2, 3};
  t = term(ROT_TERM_CHEBYSHEV, 7, y);
  ROT_CHECK(rot_term_at(&t, 0.0, 0, 0, 0) == 2.0);
  ROT_CHECK(rot_term_at(&t, 1.0, 0, 0, 0) == -2.0);
  ROT_CHECK(rot_term_at(&t, 1.5, 0, 0, 0) == 0.5);
  ROT_CHECK(rot_term_at(&t, 2.0, 0, 0, 0) == 6.0); /* its last time is its own */
  ROT_CHECK(rot_term_at(&t, 2.1, 0, 0, 0) == 0.0);
  ROT_CHECK(isnan(rot_term_at(&(rot_term){ROT_TERM_KINDS, -1, 1, 0, y}, 0, 0, 0, 0)));
}

static void test_curve(void) {
  const double x[] = {3, 0, 100, 200, 3, 2, 0};
  rot_term t = term(ROT_TERM_CURVE, 7, x);
  ROT_CHECK(rot_term_valid(&t));
  ROT_CHECK(rot_term_at(&t, 0, 0, 0, -5.0) == 3.0);
  ROT_CHECK(rot_term_at(&t, 0, 0, 0, 50.0) == 2.5);
  ROT_CHECK(rot_term_at(&t, 0, 0, 0, 100.0) == 2.0);
  ROT_CHECK(rot_term_at(&t, 0, 0, 0, 150.0) == 1.0);
  ROT_CHECK(rot_term_at(&t, 0, 0, 0, 1e300) == 0.0);
  ROT_CHECK(isnan(rot_term_at(&t, 0, 0, 0, NAN)));
}

static void test_window(void) {
  const double wave[] = {2.0, 0.0, 0.0};
  rot_term t = term(ROT_TERM_SINUSOID, 3, wave);
  t.from_s = 1.0;
  t.to_s = 2.0;
  ROT_CHECK(rot_term_at(&t, 0.999, 0, 0, 0) == 0.0);
  ROT_CHECK(rot_term_at(&t, 1.0, 0, 0, 0) == 2.0);
  ROT_CHECK(rot_term_at(&t, 2.0, 0, 0, 0) == 0.0);
  ROT_CHECK(rot_term_at(&t, NAN, 0, 0, 0) == 0.0);
}

static void test_what_does_not_hold_together(void) {
  const double x[] = {2, 3, 0, 1, 3, 1, 2, 3, -1, 0, 0.5};
  const double wild[] = {1e300, 3, 0, 1}, nan[] = {NAN, 3, 0, 1}, half[] = {1.5, 1, 0, 1};
  for (size_t length = 0; length < 11; length++) {
    rot_term t = term(ROT_TERM_POLYNOMIAL, length, x);
    ROT_CHECK(!rot_term_valid(&t));
    t.kind = ROT_TERM_CURVE;
    ROT_CHECK(!rot_term_valid(&t) || length == 5);
    t.kind = ROT_TERM_SINUSOID;
    ROT_CHECK(rot_term_valid(&t) == (length == 3));
    t.kind = ROT_TERM_SPRING;
    ROT_CHECK(rot_term_valid(&t) == (length == 2));
  }
  rot_term t = term(ROT_TERM_POLYNOMIAL, 4, wild);
  ROT_CHECK(!rot_term_valid(&t));
  t.x = nan;
  ROT_CHECK(!rot_term_valid(&t));
  t.x = half;
  ROT_CHECK(!rot_term_valid(&t));
}

static void test_names(void) {
  ROT_CHECK_EQ_INT(rot_term_named("sinusoid"), ROT_TERM_SINUSOID);
  ROT_CHECK_EQ_INT(rot_term_named("chebyshev"), ROT_TERM_CHEBYSHEV);
  ROT_CHECK_EQ_INT(rot_term_named("gravity"), ROT_TERM_GRAVITY);
  ROT_CHECK_EQ_INT(rot_term_named("gravit"), ROT_TERM_KINDS);
  ROT_CHECK_EQ_INT(rot_term_named(""), ROT_TERM_KINDS);
}

static void test_breaks(void) {
  const double x[] = {2, 1, 5, 6, 8, 1, 1};
  double out[8];
  rot_term t = term(ROT_TERM_POLYNOMIAL, 7, x);
  ROT_CHECK(rot_term_breaks(&t, NULL) >= 5);
  ROT_CHECK_EQ_INT((int)rot_term_breaks(&t, out), 3);
  ROT_CHECK(out[0] == 5.0 && out[1] == 6.0 && out[2] == 8.0);
  t = term(ROT_TERM_SPRING, 2, x);
  ROT_CHECK_EQ_INT((int)rot_term_breaks(&t, out), 0);
  t.to_s = 3.0;
  ROT_CHECK_EQ_INT((int)rot_term_breaks(&t, out), 1);
  ROT_CHECK(out[0] == 3.0);
  t.from_s = -1.0;
  ROT_CHECK_EQ_INT((int)rot_term_breaks(&t, out), 2);
}

/* The integral against mpmath, 80 digits, as the sum of two doubles: the bound covers, and is ten
 * roundings of the integral at most, and what twice the precision leaves of the phases. */
static void test_impulse(void) {
  static const struct {
    double x[5], value, rest;
  } known[] = {
      {{3.0, 20.0, 0.4, 0.1, 0.35}, 0.03348673728907136, 2.2313597584511404e-18},
      {{2.0, 3.0, 0.5, 0.0, 100000000.0}, -0.28969368488201047, -2.6283315321191995e-18},
      {{2.0, 3.0, 0.5, -100000000.0, 100000000.0}, -0.5143242868826713, 2.1373360096925267e-17},
      {{1.0, 0.1, 0.0, 1000000000.0, 1000000001.0}, -0.40932290135097077, -1.7788797293556442e-18},
      {{5.0, 7.0, -1.0, 12345.678, 1000000.0}, 0.38372128995861565, -2.5984335534156764e-17},
      {{1.0, 1e-12, 0.3, 0.0, 10.0}, 9.553364891241284, 5.893021179118266e-16},
      {{4.0, 100000.0, 2.0, 1.0, 10000000000.0}, 3.9911882742160235e-06, 2.01870603456982e-22},
      {{0.7, -2.0, 1.0, -3.0, 1000000000000000.0}, 0.20274152164308845, 3.896716910706852e-18},
      {{1.0, 0.0, 0.25, 2.0, 7.0}, 4.844562108553224, -7.949507426735018e-17},
      {{1.0, 2.0, 0.0, 0.0, 3.141592653589793}, -1.2246467991473532e-16, 2.9947698097183407e-33},
      {{1.0, 20.0, 0.0, 100000000.0, 100000000.00000095},
       3.853808727308981e-07,
       9.64226563903313e-24}};
  double error;
  for (size_t i = 0; i < sizeof known / sizeof *known; i++) {
    const double *x = known[i].x;
    const double got = rot_sinusoid_impulse(x, x[3], x[4], &error);
    ROT_CHECK(fabs((got - known[i].value) - known[i].rest) <= error);
    const double rate = fabs(x[1]), end = fmax(fabs(x[3]), fabs(x[4]));
    const double phases = 0x1p-98 * fmin(x[4] - x[3], 1.0 / rate) * (rate * end + fabs(x[2]) + 1.0);
    ROT_CHECK(error <= 0x1p-53 * 10.0 * fabs(known[i].value) + fabs(x[0]) * phases);
  }
  /* Phases without digits: whatever the integral can be. */
  const double x[] = {3.0, 2.0, 0.0};
  ROT_CHECK(rot_sinusoid_impulse(x, 0.0, 1e17, &error) == 0.0 && error >= 3.0 && error < 3.1);
  ROT_CHECK(rot_sinusoid_impulse(x, 1e17, 1e17, &error) == 0.0 && error == 0.0);
}

int main(void) {
  test_names();
  test_breaks();
  test_values();
  test_impulse();
  test_pieces();
  test_curve();
  test_window();
  test_what_does_not_hold_together();
  return rot_test_report("term");
}
