/* The skater against closed forms at 200 digits (checked against Taylor integration) and against
 * the shared table where it is present; momentum; back in time. */
#include <stdlib.h>

#include "axle_row.h"
#include "scene/axle/skater.h"
#include "rot_test.h"
#include "shared_table.h"

typedef struct row {
  double inertia, start, theta0, omega0;
  int n_inertia;
  double inertia_s[4], moment[4];
  int n_knots;
  double knot_s[4], knot_n_m[4], before, after;
  double t, theta, omega;
} row;

/* mpmath, 200 digits. */
/* clang-format off */
static const row table[] = {
    /* arms in, from 5 to 2, and held; before, at the ends, between, after */
    {5.0, 0.0, 0.0, 2.0, 2, {1.0, 3.0, 0.0, 0.0}, {5.0, 2.0, 0.0, 0.0}, 0, {0.0, 0.0, 0.0, 0.0}, {0.0, 0.0, 0.0, 0.0}, 0.0, 0.0, -1.0, -2.0, 2.0},
    {5.0, 0.0, 0.0, 2.0, 2, {1.0, 3.0, 0.0, 0.0}, {5.0, 2.0, 0.0, 0.0}, 0, {0.0, 0.0, 0.0, 0.0}, {0.0, 0.0, 0.0, 0.0}, 0.0, 0.0, 1.0, 2.0, 2.0},
    {5.0, 0.0, 0.0, 2.0, 2, {1.0, 3.0, 0.0, 0.0}, {5.0, 2.0, 0.0, 0.0}, 0, {0.0, 0.0, 0.0, 0.0}, {0.0, 0.0, 0.0, 0.0}, 0.0, 0.0, 2.5, 5.9855800050374696625, 3.6363636363636363636},
    {5.0, 0.0, 0.0, 2.0, 2, {1.0, 3.0, 0.0, 0.0}, {5.0, 2.0, 0.0, 0.0}, 0, {0.0, 0.0, 0.0, 0.0}, {0.0, 0.0, 0.0, 0.0}, 0.0, 0.0, 3.0, 8.1086048791610337679, 5.0},
    {5.0, 0.0, 0.0, 2.0, 2, {1.0, 3.0, 0.0, 0.0}, {5.0, 2.0, 0.0, 0.0}, 0, {0.0, 0.0, 0.0, 0.0}, {0.0, 0.0, 0.0, 0.0}, 0.0, 0.0, 8.0, 33.108604879161033768, 5.0},
    /* hardly a change, and a change to a millionth */
    {5.0, 0.0, 0.1, 2.0, 2, {0.0, 3.0, 0.0, 0.0}, {5.0, 5.000000000001, 0.0, 0.0}, 0, {0.0, 0.0, 0.0, 0.0}, {0.0, 0.0, 0.0, 0.0}, 0.3, 0.3, 2.0, 4.2199999999997226431, 2.1199999999997173038},
    {5.0, 0.0, 0.1, 2.0, 2, {0.0, 3.0, 0.0, 0.0}, {5.0, 5e-06, 0.0, 0.0}, 0, {0.0, 0.0, 0.0, 0.0}, {0.0, 0.0, 0.0, 0.0}, 0.3, 0.3, 1.0, 2.5717412277205476121, 3.0899984550007724963},
    {5.0, 0.0, 0.1, 2.0, 2, {0.0, 3.0, 0.0, 0.0}, {5.0, 5e-06, 0.0, 0.0}, 0, {0.0, 0.0, 0.0, 0.0}, {0.0, 0.0, 0.0, 0.0}, 0.3, 0.3, 2.9, 21.821664777118047228, 65.218108674848371119},
    {5.0, 0.0, 0.1, 2.0, 2, {0.0, 3.0, 0.0, 0.0}, {5.0, 5e-06, 0.0, 0.0}, 0, {0.0, 0.0, 0.0, 0.0}, {0.0, 0.0, 0.0, 0.0}, 0.3, 0.3, 3.0, 89.913536323005836545, 2179999.999999999815},
    {5.0, 0.0, 0.1, 2.0, 2, {0.0, 3.0, 0.0, 0.0}, {5e-06, 5.0, 0.0, 0.0}, 0, {0.0, 0.0, 0.0, 0.0}, {0.0, 0.0, 0.0, 0.0}, -0.3, -0.3, 1.0, -0.079917011382383053317, -0.1799936400127199679},
    {5.0, 0.0, 0.1, 2.0, 2, {0.0, 3.0, 0.0, 0.0}, {5e-06, 5.0, 0.0, 0.0}, 0, {0.0, 0.0, 0.0, 0.0}, {0.0, 0.0, 0.0, 0.0}, -0.3, -0.3, 2.9, -0.421910390179821418, -0.1799979248276577579},
    /* a jump: the momentum runs on */
    {2.0, 0.0, 0.0, 3.0, 4, {1.0, 2.0, 2.0, 3.0}, {2.0, 1.0, 4.0, 3.0}, 4, {0.5, 0.5, 2.5, 2.5}, {0.0, 1.0, 1.0, -2.0}, 0.0, -2.0, -1.0, -3.0, 3.0},
    {2.0, 0.0, 0.0, 3.0, 4, {1.0, 2.0, 2.0, 3.0}, {2.0, 1.0, 4.0, 3.0}, 4, {0.5, 0.5, 2.5, 2.5}, {0.0, 1.0, 1.0, -2.0}, 0.0, -2.0, 1.5, 5.0077976158401378832, 4.6666666666666666667},
    {2.0, 0.0, 0.0, 3.0, 4, {1.0, 2.0, 2.0, 3.0}, {2.0, 1.0, 4.0, 3.0}, 4, {0.5, 0.5, 2.5, 2.5}, {0.0, 1.0, 1.0, -2.0}, 0.0, -2.0, 2.0, 7.95425103475953513, 1.875},
    {2.0, 0.0, 0.0, 3.0, 4, {1.0, 2.0, 2.0, 3.0}, {2.0, 1.0, 4.0, 3.0}, 4, {0.5, 0.5, 2.5, 2.5}, {0.0, 1.0, 1.0, -2.0}, 0.0, -2.0, 2.75, 9.5639700220952671747, 2.3076923076923076923},
    {2.0, 0.0, 0.0, 3.0, 4, {1.0, 2.0, 2.0, 3.0}, {2.0, 1.0, 4.0, 3.0}, 4, {0.5, 0.5, 2.5, 2.5}, {0.0, 1.0, 1.0, -2.0}, 0.0, -2.0, 5.0, 13.477346063102136934, 1.0},
    /* the start between the knots, and back over the jump */
    {3.0, 2.6, 1.0, -1.0, 4, {1.0, 2.0, 2.0, 3.0}, {2.0, 1.0, 4.0, 3.0}, 4, {0.5, 0.5, 2.5, 2.5}, {0.0, 1.0, 1.0, -2.0}, 0.25, -2.0, -1.0, 9.7052358458316685013, -2.7874999999999998668},
    {3.0, 2.6, 1.0, -1.0, 4, {1.0, 2.0, 2.0, 3.0}, {2.0, 1.0, 4.0, 3.0}, 4, {0.5, 0.5, 2.5, 2.5}, {0.0, 1.0, 1.0, -2.0}, 0.25, -2.0, 0.75, 5.0302358458316687344, -2.4749999999999998668},
    {3.0, 2.6, 1.0, -1.0, 4, {1.0, 2.0, 2.0, 3.0}, {2.0, 1.0, 4.0, 3.0}, 4, {0.5, 0.5, 2.5, 2.5}, {0.0, 1.0, 1.0, -2.0}, 0.25, -2.0, 1.5, 3.1503692502118603403, -2.7999999999999998224},
    {3.0, 2.6, 1.0, -1.0, 4, {1.0, 2.0, 2.0, 3.0}, {2.0, 1.0, 4.0, 3.0}, 4, {0.5, 0.5, 2.5, 2.5}, {0.0, 1.0, 1.0, -2.0}, 0.25, -2.0, 2.0, 1.555613458319816617, -0.92499999999999993339},
    {3.0, 2.6, 1.0, -1.0, 4, {1.0, 2.0, 2.0, 3.0}, {2.0, 1.0, 4.0, 3.0}, 4, {0.5, 0.5, 2.5, 2.5}, {0.0, 1.0, 1.0, -2.0}, 0.25, -2.0, 2.75, 0.83977156013921029886, -1.1384615384615383796},
    {3.0, 2.6, 1.0, -1.0, 4, {1.0, 2.0, 2.0, 3.0}, {2.0, 1.0, 4.0, 3.0}, 4, {0.5, 0.5, 2.5, 2.5}, {0.0, 1.0, 1.0, -2.0}, 0.25, -2.0, 5.0, -3.6099973914641943789, -2.7333333333333332445},
    /* sizes */
    {4.226356249085322e+271, 0.0, 0.0, 2.0, 2, {1.0, 3.0, 0.0, 0.0}, {4.226356249085322e+271, 1.6905424996341288e+271, 0.0, 0.0}, 0, {0.0, 0.0, 0.0, 0.0}, {0.0, 0.0, 0.0, 0.0}, 4.226356249085322e+270, 4.226356249085322e+270, 2.5, 6.399122339462254756, 4.0909090909090909091},
};
/* clang-format on */

static rot_status run_scene(const row *r, double t, rot_info *info) {
  const rot_axle_scene scene = {
      .linear = {r->inertia,
                 0.0,
                 r->start,
                 r->theta0,
                 r->omega0,
                 {(size_t)r->n_knots, r->knot_s, r->knot_n_m, r->before, r->after, NULL, NULL}},
      .n_inertia = (size_t)r->n_inertia,
      .inertia_time_s = r->inertia_s,
      .inertia_kg_m2 = r->moment};
  return rot_axle_skater(&scene, 1, &t, &columns, NULL, NULL, info);
}

static void test_table(void) {
  for (size_t i = 0; i < sizeof table / sizeof *table; i++) {
    rot_info info;
    ROT_CHECK_EQ_INT(run_scene(&table[i], table[i].t, &info), ROT_OK);
    check_row(&info, table[i].theta, table[i].omega, 1e-14);
  }
}

/* I0, I1, L0, tau, t, dtheta, omega1: 4 ulp, of the larger term where the two differ in sign. */
static void test_shared(void) {
  FILE *file = shared_table("refs/variable_inertia.csv");
  double x[7];
  long rows = 0;
  if (!file) return;
  while (shared_row(file, 7, x)) {
    const row r = {.inertia = x[0],
                   .omega0 = x[2] / x[0],
                   .n_inertia = 2,
                   .inertia_s = {0.0, x[4]},
                   .moment = {x[0], x[1]},
                   .before = x[3],
                   .after = x[3]};
    rot_info info;
    ROT_CHECK_EQ_INT(run_scene(&r, x[4], &info), ROT_OK);
    const double size = fabs(x[2]) + fabs(x[3] * x[4]);
    ROT_CHECK(fabs(got[0] - x[5]) <=
              4.0 * 0x1p-52 * fmax(fabs(x[5]), size * x[4] / fmax(x[0], x[1])));
    ROT_CHECK(fabs(got[1] - x[6]) <= 4.0 * 0x1p-52 * fmax(fabs(x[6]), size / x[1]));
    rows++;
  }
  ROT_CHECK(rows >= 5);
}

/* Without torque I omega stays; there and back again; as many knots on a line as one likes. */
static void test_metamorphic(void) {
  row r = {.inertia = 5.0,
           .omega0 = 3.0,
           .n_inertia = 4,
           .inertia_s = {0.0, 1.0, 1.0, 2.0},
           .moment = {5.0, 0.5, 1e3, 2.0}};
  for (double t = -1.0; t < 3.0; t += 0.171) {
    rot_info info;
    ROT_CHECK_EQ_INT(run_scene(&r, t, &info), ROT_OK);
    ROT_CHECK_REL(got[5], 15.0, 4e-16);
  }
  r.n_knots = 2;
  r.knot_s[0] = r.knot_s[1] = 0.75;
  r.before = r.knot_n_m[0] = 4.0;
  r.after = r.knot_n_m[1] = -3.0;
  for (double t = 0.1; t < 3.0; t += 0.171) {
    rot_info info;
    row back = r;
    ROT_CHECK_EQ_INT(run_scene(&r, t, &info), ROT_OK);
    ROT_CHECK_REL(got[5], 15.0 + 4.0 * fmin(t, 0.75) - 3.0 * fmax(t - 0.75, 0.0), 1e-15);
    back.start = t;
    back.theta0 = got[0];
    back.omega0 = got[1];
    ROT_CHECK_EQ_INT(run_scene(&back, 0.0, &info), ROT_OK);
    ROT_CHECK(fabs(got[0]) <= 1e-14);
    ROT_CHECK_REL(got[1], 3.0, 4e-15);
  }
}

static void test_columns_and_refusals(void) {
  row r = {.inertia = 2.0, .theta0 = 0.5, .omega0 = 3.0, .before = 0.5, .after = 0.5};
  rot_info info;
  ROT_CHECK_EQ_INT(run_scene(&r, 2.0, &info), ROT_OK);
  ROT_CHECK(got[0] == 7.0 && got[1] == 3.5 && got[2] == 0.5 && got[3] == 0.0 && got[4] == 0.5);
  ROT_CHECK(got[5] == 7.0 && got[6] == 12.25);
  r.n_inertia = 1;
  r.moment[0] = -1.0;
  ROT_CHECK_EQ_INT(run_scene(&r, 2.0, &info), ROT_EVALUE);
  r.n_inertia = 0;
  r.n_knots = 2;
  r.knot_s[1] = 1.0;
  r.knot_n_m[1] = 1.0;
  ROT_CHECK_EQ_INT(run_scene(&r, 2.0, &info), ROT_EVALUE);
  r.n_knots = 0;
  r.omega0 = 1e300;
  ROT_CHECK_EQ_INT(run_scene(&r, 1e20, &info), ROT_ERANGE);
  ROT_CHECK_EQ_INT(info.rows_done, 0);
}

int main(void) {
  test_table();
  test_shared();
  test_metamorphic();
  test_columns_and_refusals();
  return rot_test_report("axle_skater");
}
