/* Many inclines: each row against the run of its own scene, which is tested against mpmath; limits,
 * bad rows, threads. */
#include "scene/incline/table.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "scene/incline/incline.h"
#include "ground/real.h"
#include "ground/parallel.h"
#include "rot_test.h"
#include "shared_table.h"

enum { INPUTS = 11, COLUMNS = 8 };

typedef struct table {
  size_t n;
  double *in[INPUTS], *c[COLUMNS];
  int *rolling, *status;
  rot_incline_rows rows;
  rot_incline_table_columns out;
} table;

static rot_column whole(const double *x) {
  const rot_column column = {x, 1};
  return column;
}

static table table_new(size_t n) {
  table t;
  t.n = n;
  for (int k = 0; k < INPUTS; k++) t.in[k] = calloc(n, sizeof(double));
  for (int k = 0; k < COLUMNS; k++) t.c[k] = calloc(n, sizeof(double));
  t.rolling = calloc(n, sizeof(int));
  t.status = calloc(n, sizeof(int));
  t.rows = (rot_incline_rows){n,
                              whole(t.in[0]),
                              whole(t.in[1]),
                              whole(t.in[2]),
                              whole(t.in[3]),
                              whole(t.in[4]),
                              whole(t.in[5]),
                              whole(t.in[6]),
                              whole(t.in[7]),
                              whole(t.in[8]),
                              whole(t.in[9]),
                              whole(t.in[10])};
  t.out = (rot_incline_table_columns){t.c[0], t.c[1],    t.c[2], t.c[3],   t.c[4], t.c[5],
                                      t.c[6], t.rolling, t.c[7], t.status, NAN};
  return t;
}

static void table_free(table *t) {
  for (int k = 0; k < INPUTS; k++) free(t->in[k]);
  for (int k = 0; k < COLUMNS; k++) free(t->c[k]);
  free(t->rolling);
  free(t->status);
}

static uint64_t state = 88172645463325252u;

static double uniform(double lo, double hi) {
  state ^= state << 13;
  state ^= state >> 7;
  state ^= state << 17;
  return lo + (hi - lo) * (double)(state >> 11) * 0x1p-53;
}

static int chance(double p) { return uniform(0.0, 1.0) < p; }

static void fill_row(table *t, size_t i) {
  const double mu = chance(0.1) ? 0.0 : uniform(0.0, 0.9);
  t->in[0][i] = chance(0.3) ? 0.4 : uniform(0.05, 3.0);
  t->in[1][i] = uniform(0.01, 1.0);
  t->in[2][i] = uniform(0.1, 20.0);
  t->in[3][i] = chance(0.1) ? 0.0 : chance(0.03) ? 90.0 : uniform(-80.0, 80.0);
  t->in[4][i] = chance(0.02) ? 0.0 : 9.80665;
  t->in[5][i] = mu;
  t->in[6][i] = chance(0.5) ? mu : uniform(0.3, 1.0) * mu;
  t->in[7][i] = chance(0.2) ? uniform(0.0, 0.1) : 0.0;
  t->in[8][i] = chance(0.2) ? 0.0 : uniform(-5.0, 5.0);
  t->in[9][i] = chance(0.2) ? NAN : chance(0.2) ? 0.0 : uniform(-60.0, 60.0);
  t->in[10][i] = chance(0.02) ? 0.0 : uniform(0.0, 5.0);
}

static rot_incline_params scene_of(const table *t, size_t i) {
  double x[INPUTS];
  for (int k = 0; k < INPUTS; k++) x[k] = t->in[k][i];
  const double inertia = rot_product(4, (double[]){x[0], x[2], x[1], x[1]}, 1.0);
  const double omega = isnan(x[9]) ? x[8] / x[1] : x[9];
  const rot_incline_params p = {x[2], x[1], inertia, x[3], x[4],  x[6], x[5],
                                x[7], 0.0,  x[8],    0.0,  omega, 0.0};
  return p;
}

static void random_rows(void) {
  enum { N = 20000 };
  table t = table_new(N);
  rot_info info;
  size_t rolls = 0;
  double worst = 0.0;
  for (size_t i = 0; i < N; i++) fill_row(&t, i);
  ROT_CHECK(rot_incline_table(&t.rows, 1, &t.out, NULL, &info) == ROT_OK);
  ROT_CHECK(info.rows_done == N);
  for (size_t i = 0; i < N; i++) {
    const rot_incline_params p = scene_of(&t, i);
    const double time = t.in[10][i];
    double c[11];
    int rolling;
    const rot_incline_columns to = {&c[0], &c[1], &c[2], &c[3], &c[4],  &c[5],
                                    &c[6], &c[7], &c[8], &c[9], &c[10], &rolling};
    rot_events events = {0};
    rot_info one;
    ROT_CHECK(t.status[i] == ROT_OK);
    ROT_CHECK(rot_incline_run(&p, 1, &time, &to, &events, NULL, NULL, &one) == ROT_OK);
    for (int k = 0; k < 4; k++) {
      const rot_measure *m = &one.measure[k];
      ROT_CHECK(fabs(t.c[k][i] - c[k]) <= m->error + t.c[7][i] * m->largest * (1.0 + 1e-9));
    }
    ROT_CHECK(t.rolling[i] == rolling);
    const double heat = 0.5 * p.mass_kg * p.v0_m_per_s * p.v0_m_per_s +
                        0.5 * p.inertia_kg_m2 * p.omega0_rad_per_s * p.omega0_rad_per_s +
                        p.mass_kg * p.gravity_m_per_s2 * fabs(c[0]);
    ROT_CHECK(fabs(t.c[4][i] - c[9]) <= 1e-12 * heat);
    ROT_CHECK(fabs(t.c[5][i] - c[10]) <= 1e-12 * heat);
    double first = NAN;
    for (size_t e = 0; e < events.count && isnan(first); e++) {
      if (events.event[e] == ROT_EVENT_ROLL) first = events.time_s[e];
    }
    /* Ball at rest on a level floor: the run calls it rest. */
    if (isnan(first)) {
      ROT_CHECK(isnan(t.c[6][i]) || p.angle_deg == 0.0 || p.gravity_m_per_s2 == 0.0);
    } else {
      rolls++;
      ROT_CHECK(fabs(t.c[6][i] - first) <= 1e-11 * first);
    }
    worst = fmax(worst, t.c[7][i]);
    rot_events_free(&events);
  }
  printf("incline table: %zu of %d begin to roll, largest error bound %.2g\n", rolls, N, worst);
  ROT_CHECK(rolls > 1000);
  table_free(&t);
}

/* The shared table: start, slope and friction give the state where rolling begins. */
static void slip_to_roll(void) {
  FILE *file = shared_table("refs/slip_to_roll.csv");
  double x[14];
  table t = table_new(1);
  rot_info info;
  while (file && shared_row(file, 14, x)) {
    const double deg = x[4] * 57.29577951308232;
    const double row[INPUTS] = {
        x[2], x[1], x[0], deg, x[5], x[3], x[3], 0.0, x[6], x[7], isfinite(x[8]) ? x[8] : 100.0};
    for (int k = 0; k < INPUTS; k++) t.in[k][0] = row[k];
    ROT_CHECK(rot_incline_table(&t.rows, 1, &t.out, NULL, &info) == ROT_OK);
    if (!isfinite(x[8]) || x[3] < x[13]) {
      ROT_CHECK(isnan(t.c[6][0]));
      continue;
    }
    if (x[8] == 0.0) continue;
    const double size = fmax(fabs(x[6]), fmax(fabs(x[1] * x[7]), 2.0 * x[5] * x[8]));
    ROT_CHECK(fabs(t.c[1][0] - x[9]) <= 4e-15 * size);
    ROT_CHECK(fabs(t.c[3][0] - x[10]) <= 4e-15 * size / x[1]);
    ROT_CHECK(fabs(t.c[0][0] - x[11]) <= 4e-15 * size * x[8]);
    ROT_CHECK(fabs(t.c[4][0] - x[12]) <= 1e-12 * x[12]);
    t.in[10][0] = 1.001 * x[8];
    ROT_CHECK(rot_incline_table(&t.rows, 1, &t.out, NULL, &info) == ROT_OK);
    ROT_CHECK_REL(t.c[6][0], x[8], 1e-12);
    ROT_CHECK(t.rolling[0]);
  }
  table_free(&t);
}

static void threads(void) {
  enum { N = 70000 };
  table a = table_new(N), b = table_new(N);
  rot_info info;
  for (size_t i = 0; i < N; i++) {
    fill_row(&a, i);
    for (int k = 0; k < INPUTS; k++) b.in[k][i] = a.in[k][i];
  }
  ROT_CHECK(rot_incline_table(&a.rows, 1, &a.out, NULL, &info) == ROT_OK);
  for (int max = 0; max <= 3; max++) {
    ROT_CHECK(rot_incline_table(&b.rows, max, &b.out, NULL, &info) == ROT_OK);
    for (int k = 0; k < COLUMNS; k++) ROT_CHECK(!memcmp(a.c[k], b.c[k], N * sizeof(double)));
    ROT_CHECK(!memcmp(a.rolling, b.rolling, N * sizeof(int)));
  }
  ROT_CHECK(rot_parallel_threads() >= 1);
  table_free(&a);
  table_free(&b);
}

static void set(table *t, size_t i, const double x[]) {
  for (int k = 0; k < INPUTS; k++) t->in[k][i] = x[k];
}

static void limits(void) {
  table t = table_new(8);
  rot_info info;
  /* beta, R, m, degrees, g, mu_s, mu_k, arm, v0, omega0, t */
  set(&t, 0, (double[]){0.4, 0.1, 1, 30, 9.8, INFINITY, INFINITY, 0, 0, NAN, 3});
  set(&t, 1, (double[]){0.4, 0.1, 1, 30, 9.8, INFINITY, INFINITY, 0, 1, 0, 3});
  set(&t, 2, (double[]){0.4, 0.1, 1, 91, 9.8, 1, 1, 0, 0, NAN, 3});
  set(&t, 3, (double[]){0.4, 0.1, 1, 20, 9.8, 0.1, 0.2, 0, 0, NAN, 3});
  set(&t, 4, (double[]){0.0, 0.1, 1, 20, 9.8, 0.2, 0.2, 0, 0, NAN, 3});
  set(&t, 5, (double[]){1e200, 1e-200, 1, 30, 1e300, 1, 1, 0, 0, NAN, 1e20});
  set(&t, 6, (double[]){0.4, 1e-200, 1e-250, 20, 9.8, 0.1, 0.1, 0, 1, 0, 1});
  /* The critical angle: tan = mu (1 + beta)/beta = 1 at 45 degrees for a hoop and 1/2. */
  set(&t, 7, (double[]){1, 0.1, 1, 45, 9.8, 0.5, 0.2, 0, 0, NAN, 1});
  ROT_CHECK(rot_incline_table(&t.rows, 1, &t.out, NULL, &info) == ROT_OK);
  ROT_CHECK_REL(t.c[0][0], 15.75, 4e-16); /* University Physics 11: 3.5 m/s^2 */
  ROT_CHECK(t.rolling[0] && isnan(t.c[6][0]));
  for (size_t i = 1; i <= 4; i++) {
    ROT_CHECK(t.status[i] == ROT_EVALUE && isnan(t.c[0][i]) && !t.rolling[i]);
  }
  ROT_CHECK(t.status[5] == ROT_ERANGE && isnan(t.c[0][5]));
  /* (20 degrees, 0.1): v = 1 + g (sin - 0.1 cos), omega = 0.25 g cos/R */
  ROT_CHECK(t.status[6] == ROT_OK);
  ROT_CHECK_REL(t.c[1][6], 1.0 + 9.8 * (rot_sin_deg(20.0) - 0.1 * rot_cos_deg(20.0)), 1e-15);
  ROT_CHECK_REL(t.c[3][6], 0.25 * 9.8 * rot_cos_deg(20.0) / 1e-200, 1e-15);
  ROT_CHECK(t.rolling[7]);
  table_free(&t);
}

int main(void) {
  random_rows();
  slip_to_roll();
  threads();
  limits();
  return rot_test_report("incline_table");
}
