/* Values between steps: exact for polynomials, honest about its share, quiet after tiny steps. */
#include <math.h>

#include "maths/dense.h"
#include "ground/real.h"
#include "rot_test.h"

static double power(double t, int k) { return k == 0 ? 1.0 : pow(t, k); }

static rot_dense nodes(size_t n, int slopes, int k, double propagation) {
  rot_dense d = {1, 0, 0, slopes, NULL};
  double t = 0.3, h = 0.05;
  for (size_t i = 0; i < n; i++, t += h, h *= propagation) {
    const double y = power(t, k), f = k ? k * power(t, k - 1) : 0.0;
    ROT_CHECK_EQ_INT(rot_dense_insert(&d, d.count, t, &y, &f), ROT_OK);
  }
  return d;
}

/* Degree 15 through eight nodes with slopes, 11 through twelve without, in every interval. */
static void check_polynomials(void) {
  for (int slopes = 0; slopes < 2; slopes++) {
    for (int k = 0; k <= (slopes ? 15 : 11); k++) {
      rot_dense d = nodes(14, slopes, k, 1.1);
      for (size_t i = 0; i + 1 < d.count; i++) {
        const double a = rot_dense_node(&d, i)[0], b = rot_dense_node(&d, i + 1)[0];
        const double t = a + 0.37 * (b - a);
        const rot_dense_form form = rot_dense_between(&d, i, 0);
        double slope, unsure, slope_unsure;
        const double y = rot_dense_at(&form, t, &slope, &unsure, &slope_unsure);
        ROT_CHECK_REL(y, power(t, k), 1e-11);
        if (k) ROT_CHECK_REL(slope, k * power(t, k - 1), 1e-9);
        if (slopes && k < 12) ROT_CHECK(unsure <= 1e-12 * power(t, k));
      }
      rot_dense_free(&d);
    }
  }
}

/* The share is more than the error, and not without measure. */
static void check_unsure(void) {
  rot_dense d = {1, 0, 0, 1, NULL};
  for (int i = 0; i < 12; i++) {
    const double t = 0.7 * i + 0.05 * (i % 3), y = sin(t), f = cos(t);
    ROT_CHECK_EQ_INT(rot_dense_insert(&d, d.count, t, &y, &f), ROT_OK);
  }
  for (size_t i = 0; i + 1 < d.count; i++) {
    const rot_dense_form form = rot_dense_between(&d, i, 0);
    const double t = 0.5 * (rot_dense_node(&d, i)[0] + rot_dense_node(&d, i + 1)[0]);
    double slope, unsure, slope_unsure;
    const double error = fabs(rot_dense_at(&form, t, &slope, &unsure, &slope_unsure) - sin(t));
    ROT_CHECK(error <= unsure && unsure < 1e-6);
    ROT_CHECK(fabs(slope - cos(t)) <= slope_unsure);
  }
  rot_dense_free(&d);
}

/* A slope within the interval, then another: each mends most of the error that is left. */
static void check_corrections(void) {
  rot_dense d = {1, 0, 0, 1, NULL};
  for (int i = 0; i < 4; i++) {
    const double t = 0.5 * i, y = sin(t), f = cos(t);
    ROT_CHECK_EQ_INT(rot_dense_insert(&d, d.count, t, &y, &f), ROT_OK);
  }
  for (size_t i = 0; i + 1 < d.count; i++) {
    rot_dense_form form = rot_dense_between(&d, i, 0);
    double before = INFINITY;
    for (int k = 0; k <= ROT_DENSE_CORRECTIONS; k++) {
      double worst = 0.0, max = 0.0;
      for (int j = 0; j <= 20; j++) {
        const double t = form.start + form.width * j / 20.0;
        double unsure;
        worst = fmax(worst, fabs(rot_dense_at(&form, t, NULL, &unsure, NULL) - sin(t)));
        max = fmax(max, unsure);
      }
      ROT_CHECK(worst <= 0.3 * before && worst <= max);
      before = worst;
      if (k == ROT_DENSE_CORRECTIONS) continue;
      const double at = rot_dense_correction_at(&form);
      double slope;
      rot_dense_correct(&form, cos(at));
      rot_dense_at(&form, at, &slope, NULL, NULL);
      ROT_CHECK_ULP(slope, cos(at), 64);
    }
  }
  rot_dense_free(&d);
}

/* Steps that grow fivefold: a straight line stays one, to rounding. */
static void check_growing_steps(void) {
  rot_dense d = nodes(7, 1, 1, 5.0);
  for (size_t i = 0; i + 1 < d.count; i++) {
    const rot_dense_form form = rot_dense_between(&d, i, 0);
    const double t = 0.5 * (rot_dense_node(&d, i)[0] + rot_dense_node(&d, i + 1)[0]);
    double unsure;
    ROT_CHECK_REL(rot_dense_at(&form, t, NULL, &unsure, NULL), t, 1e-15);
    if (form.terms > form.estimating)
      ROT_CHECK(unsure <= 1e-12 * t); /* else there is none to tell */
  }
  rot_dense_free(&d);
}

/* A node put in between, the first ones dropped. */
static void check_list(void) {
  rot_dense d = nodes(200, 1, 2, 1.0);
  const double y = 7.0, f = 8.0, t = rot_dense_node(&d, 5)[0];
  ROT_CHECK_EQ_INT(rot_dense_insert(&d, 5, 6.0, &y, &f), ROT_OK);
  ROT_CHECK(rot_dense_node(&d, 5)[0] == 6.0 && rot_dense_node(&d, 5)[2] == 8.0);
  ROT_CHECK(rot_dense_node(&d, 6)[0] == t);
  rot_dense_drop(&d, 6);
  ROT_CHECK_EQ_INT(d.count, 195);
  ROT_CHECK(rot_dense_node(&d, 0)[0] == t);
  rot_dense_drop(&d, 1000);
  ROT_CHECK_EQ_INT(d.count, 0);
  rot_dense_free(&d);
}

int main(void) {
  check_polynomials();
  check_unsure();
  check_corrections();
  check_growing_steps();
  check_list();
  return rot_test_report("dense");
}
