/* Integrals over panels against closed forms. */
#include "maths/panels.h"

#include <math.h>

#include "rot_test.h"

typedef struct calls {
  size_t n;
  int decreases;
  rot_status status;
} calls;

static rot_status rates(size_t n, const double t[], double value[], void *ctx) {
  calls *c = ctx;
  for (size_t i = 0; i < n; i++) {
    if (i > 0) c->decreases |= t[i] < t[i - 1];
    value[3 * i] = exp(-t[i]);
    value[3 * i + 1] = sin(40.0 * t[i]);
    value[3 * i + 2] = sqrt(fabs(t[i] - 0.3)); /* a kink */
  }
  c->n += n;
  return c->status;
}

static void check_closed_forms(void) {
  const double edge[] = {-1.0, 0.25, 2.0, 3.0};
  double value[9], error[3], size[3];
  calls c = {0, 0, ROT_OK};
  const rot_panels p = {3, 3, edge, NULL, value, error, size, 0, 0};
  ROT_CHECK_EQ_INT(rot_panels_integrate(&p, rates, &c), ROT_OK);
  ROT_CHECK(!c.decreases && c.n > 3 * 15);
  for (int i = 0; i < 3; i++) {
    const double a = edge[i], b = edge[i + 1];
    const double root = (pow(fabs(b - 0.3), 1.5) * (b > 0.3 ? 1.0 : -1.0) -
                         pow(fabs(a - 0.3), 1.5) * (a > 0.3 ? 1.0 : -1.0)) *
                        2.0 / 3.0;
    ROT_CHECK(fabs(value[3 * i] - (exp(-a) - exp(-b))) <= 4e-15);
    ROT_CHECK(fabs(value[3 * i + 1] - (cos(40.0 * a) - cos(40.0 * b)) / 40.0) <= 4e-15);
    ROT_CHECK(fabs(value[3 * i + 2] - root) <= error[2] + 4e-15);
  }
  ROT_CHECK(error[0] <= 1e-14 && error[1] <= 1e-13 && error[2] <= 1e-9);
  ROT_CHECK(fabs(size[0] - (exp(1.0) - exp(-3.0))) <= 1e-14 && size[1] > 2.0);
}

/* What it is added to is so large that one halving more is of no use. */
static void check_min(void) {
  const double edge[] = {0.0, 3.0}, min[] = {1e30, 1e30, 1e30};
  double value[3], error[3], size[3];
  calls c = {0, 0, ROT_OK};
  const rot_panels p = {3, 1, edge, min, value, error, size, 0, 0};
  ROT_CHECK_EQ_INT(rot_panels_integrate(&p, rates, &c), ROT_OK);
  ROT_CHECK(c.n == 15 && error[1] > 0.01);
}

static rot_status waves(size_t n, const double t[], double value[], void *ctx) {
  (void)ctx;
  for (size_t i = 0; i < n; i++) value[i] = 1.0 + 1e-3 * cos(1e6 * t[i]);
  return ROT_OK;
}

/* Too few panels for 1e6/(2 pi) waves: the error is unknown, or bounded by their height. */
static void check_max(void) {
  const double edge[] = {0.0, 0.5, 2.0};
  double value[2], error[1], size[1];
  rot_panels p = {1, 2, edge, NULL, value, error, size, 100, 0};
  ROT_CHECK_EQ_INT(rot_panels_integrate(&p, waves, NULL), ROT_OK);
  ROT_CHECK(isnan(error[0]));
  p.bounded = 1;
  ROT_CHECK_EQ_INT(rot_panels_integrate(&p, waves, NULL), ROT_OK);
  const double off = fabs(value[0] + value[1] - (2.0 + 1e-9 * sin(2e6)));
  ROT_CHECK(off <= error[0] && error[0] <= 5e-3 && off > 1e-9);
}

static rot_status infinite(size_t n, const double t[], double value[], void *ctx) {
  (void)ctx;
  for (size_t i = 0; i < n; i++) value[i] = t[i] > 1.0 ? INFINITY : 1.0;
  return ROT_OK;
}

static void check_ends(void) {
  const double edge[] = {0.0, 0.5, 2.0};
  double value[6], error[3], size[3];
  calls c = {0, 0, ROT_EUNWIND};
  const rot_panels p = {3, 2, edge, NULL, value, error, size, 0, 0};
  ROT_CHECK_EQ_INT(rot_panels_integrate(&p, rates, &c), ROT_EUNWIND);
  const rot_panels one = {1, 2, edge, NULL, value, error, size, 0, 0};
  ROT_CHECK_EQ_INT(rot_panels_integrate(&one, infinite, NULL), ROT_OK);
  ROT_CHECK(value[0] == 0.5 && isinf(value[1]));
  const rot_panels none = {3, 0, edge, NULL, value, error, size, 0, 0};
  ROT_CHECK_EQ_INT(rot_panels_integrate(&none, rates, &c), ROT_OK);
  ROT_CHECK(error[0] == 0.0 && size[0] == 0.0);
}

int main(void) {
  check_closed_forms();
  check_min();
  check_max();
  check_ends();
  return rot_test_report("panels");
}
