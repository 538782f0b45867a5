/* Tables of free bodies: against 110-digit values (the shared table) and the motion of one body,
 * registers of two against four and against doubles, threads, neighbours, rows that the kernel
 * leaves to others. */
#define ROT_ALONE

#include "scene/free/table.h"

#include <stdlib.h>
#include <string.h>

#include "maths/attitude.h"
#include "scene/free/motion.h"
#include "scene/free/kernel.h"
#include "rot_test.h"
#include "ground/simd.h"
#include "shared_table.h"

enum { N = 3000, IN = 11, OUT = 8 };

typedef struct table {
  size_t n;
  double in[IN][N]; /* moments, rates, quaternion, time */
  double out[OUT][N];
} table;

static double uniform(void) { return rand() / (RAND_MAX + 1.0); }

static void run(table *x, int threads) {
  double(*c)[N] = x->in;
  const rot_free_table_rows rows = {x->n,
                                    {{c[0], 1}, {c[1], 1}, {c[2], 1}},
                                    {{c[3], 1}, {c[4], 1}, {c[5], 1}},
                                    {{c[6], 1}, {c[7], 1}, {c[8], 1}, {c[9], 1}},
                                    {c[10], 1}};
  const rot_free_table_columns out = {x->out[0], x->out[1], x->out[2], x->out[3], x->out[4],
                                      x->out[5], x->out[6], x->out[7], NULL};
  rot_info info;
  memset(x->out, 0, sizeof x->out);
  ROT_CHECK(rot_free_table(&rows, threads, &out, NULL, &info) == ROT_OK && info.rows_done == x->n);
}

static void put(table *x, size_t i, const double moment[3], const double omega[3], double t) {
  static const double none[4] = {1.0, 0.0, 0.0, 0.0};
  for (int k = 0; k < 3; k++) {
    x->in[k][i] = moment[k];
    x->in[3 + k][i] = omega[k];
  }
  for (int k = 0; k < 4; k++) x->in[6 + k][i] = none[k];
  x->in[10][i] = t;
}

static double quaternion(const table *x, size_t i, double q[4]) {
  for (int k = 0; k < 4; k++) q[k] = x->out[k][i];
  return x->out[7][i];
}

/* I1..3, omega, t, omega(t), q. */
static void check_shared(table *x) {
  FILE *file = shared_table("refs/free_rigid_body.csv");
  static double row[N][14];
  double worst = 0.0, q[4];
  if (!file) return;
  for (x->n = 0; x->n < N && shared_row(file, 14, row[x->n]); x->n++) {
    put(x, x->n, row[x->n], row[x->n] + 3, row[x->n][6]);
  }
  ROT_CHECK(x->n == 175);
  run(x, 1);
  for (size_t i = 0; i < x->n; i++) {
    const double error = quaternion(x, i, q), off = rot_attitude_angle(q, row[i] + 10);
    const double *w = row[i] + 7, size = sqrt(w[0] * w[0] + w[1] * w[1] + w[2] * w[2]);
    worst = fmax(worst, off);
    ROT_CHECK(off <= 4e-15 && off <= error && error <= 2e-14);
    for (int k = 0; k < 3; k++) ROT_CHECK(fabs(x->out[4 + k][i] - w[k]) <= 4e-15 * size);
  }
  printf("table: %d rows, attitude %.2e rad\n", (int)x->n, worst);
}

/* Bodies of all kinds: any order of the axes, symmetric within an ulp, next to the separatrix and
 * to the spin about the middle axis, and rows without a motion. */
static void draw(table *x, size_t i) {
  double moment[3], omega[3];
  const size_t a = i % 3, b = (i + 1) % 3, c = (i + 2) % 3, kind = i % 11;
  for (int k = 0; k < 3; k++) {
    moment[k] = 1.0 + uniform();
    omega[k] = 2.0 * uniform() - 1.0;
  }
  if (kind == 1) moment[a] = moment[b];
  if (kind == 2) moment[a] = moment[b] * (1.0 + 0x1p-52);
  if (kind == 3) { /* 2 T I2 = L^2, nearly */
    moment[a] = 1.0, moment[b] = 2.0, moment[c] = 3.0;
    omega[c] = omega[a] * sqrt(1.0 / 3.0) * (1.0 + pow(10.0, -4.0 - 11.0 * uniform()));
  }
  if (kind == 4) {
    moment[a] = 1.0, moment[b] = 2.0, moment[c] = 3.0;
    omega[a] *= pow(10.0, -9.0 * uniform());
    omega[c] *= pow(10.0, -9.0 * uniform());
  }
  if (kind == 5) moment[a] *= pow(10.0, -9.0 * uniform());
  if (kind == 6) omega[a] = omega[b] = 0.0;
  if (kind == 7) omega[a] = 0.0;
  if (kind == 8) moment[a] = moment[b] = moment[c];
  put(x, i, moment, omega, (2.0 * uniform() - 1.0) * pow(10.0, 12.0 * uniform()));
  for (int k = 0; k < 4; k++) x->in[6 + k][i] = 4.0 * uniform() - 2.0;
  if (kind == 9) {
    const double scale = pow(2.0, 1000.0 * uniform() - 500.0);
    for (int k = 0; k < 3; k++) x->in[k][i] *= scale;
  }
  if (i % 97 == 0) x->in[10][i] = 0.0;
  if (i % 101 == 0) x->in[10][i] = 1e17;
  if (i % 103 == 0) x->in[i % IN][i] = NAN;
  if (i % 107 == 0) x->in[a][i] = -1.0;
  if (i % 109 == 0) x->in[3 + a][i] = INFINITY;
}

static int known(const table *x, size_t i) {
  double sum = 0.0;
  for (int k = 0; k < IN; k++) sum += x->in[k][i];
  return isfinite(sum) && x->in[0][i] >= 0.0 && x->in[1][i] >= 0.0 && x->in[2][i] >= 0.0;
}

/* Within both bounds of the motion of one body, and of the same sign. */
static void check_motion(table *x) {
  double widest = 0.0;
  for (size_t i = 0; i < x->n; i++) {
    double moment[3], omega[3], q0[4], q[4], want[4];
    rot_free_motion motion;
    rot_free_state s;
    const double error = quaternion(x, i, q);
    if (!known(x, i)) {
      ROT_CHECK(isnan(q[0]) && isnan(q[3]) &&
                (isnan(error) || isnan(x->in[6][i]) || isnan(x->in[7][i]) || isnan(x->in[8][i]) ||
                 isnan(x->in[9][i])));
      continue;
    }
    for (int k = 0; k < 3; k++) {
      moment[k] = x->in[k][i];
      omega[k] = x->in[3 + k][i];
    }
    for (int k = 0; k < 4; k++) q0[k] = x->in[6 + k][i];
    ROT_CHECK_EQ_INT(rot_free_begin(moment, omega, 0.0, &motion), ROT_OK);
    rot_free_at(&motion, (rot_dd){x->in[10][i], 0.0}, &s);
    (void)rot_attitude_unit(q0);
    rot_attitude_times(q0, s.q, want);
    const double dot = q[0] * want[0] + q[1] * want[1] + q[2] * want[2] + q[3] * want[3];
    ROT_CHECK(rot_attitude_angle(q, want) <= error + s.q_error + 8.0 * ROT_EPS);
    ROT_CHECK(dot > 0.0 || error > 1e-3);
    widest = fmax(widest, error / (s.q_error + 8.0 * ROT_EPS));
    for (int k = 0; k < 3; k++) {
      ROT_CHECK(fabs(x->out[4 + k][i] - s.omega[k]) <= 2.0 * s.omega_error);
    }
  }
  printf("bounds at most %.3g times those of one body\n", widest);
  ROT_CHECK(widest <= 1.2);
}

static void check_bits(table *x, table *y) {
  for (int k = 0; k < 2; k++) {
    rot_simd_allow(k);
    *y = *x;
    run(y, 1);
    ROT_CHECK(memcmp(x->out, y->out, sizeof x->out) == 0);
    run(y, 7);
    ROT_CHECK(memcmp(x->out, y->out, sizeof x->out) == 0);
  }
  if (!rot_simd_fma_ok()) printf("skip - no registers of four here\n");
  /* a row alone, and among others */
  for (size_t i = 0; i < x->n; i += 61) {
    y->n = 1;
    for (int k = 0; k < IN; k++) y->in[k][0] = x->in[k][i];
    run(y, 1);
    for (int k = 0; k < OUT; k++) {
      ROT_CHECK(memcmp(&y->out[k][0], &x->out[k][i], sizeof(double)) == 0);
    }
  }
}

/* The kernel compiled for doubles. */
static void check_doubles(const table *x) {
  static rot_free_block b;
  size_t good = 0;
  for (size_t first = 0; first + ROT_FREE_BLOCK <= x->n; first += ROT_FREE_BLOCK) {
    for (size_t l = 0; l < ROT_FREE_BLOCK; l++) {
      for (size_t k = 0; k < 3; k++) b.moment[k][l] = x->in[k][first + l];
      for (size_t k = 0; k < 3; k++) b.omega[k][l] = x->in[3 + k][first + l];
      for (size_t k = 0; k < 4; k++) b.q[k][l] = x->in[6 + k][first + l];
      b.time[l] = x->in[10][first + l];
    }
    rot_free_pass(&b);
    for (size_t l = 0; l < ROT_FREE_BLOCK; l++) {
      if (!(b.good[l] > 0.0)) continue;
      good++;
      for (size_t k = 0; k < 4; k++) ROT_CHECK(b.q[k][l] == x->out[k][first + l]);
      for (size_t k = 0; k < 3; k++) ROT_CHECK(b.omega[k][l] == x->out[4 + k][first + l]);
      ROT_CHECK(b.error[l] + 8.0 * ROT_EPS == x->out[7][first + l]);
    }
  }
  ROT_CHECK(good > N / 2);
}

int main(void) {
  static table x, y;
  srand(5);
  check_shared(&x);
  x.n = N;
  for (size_t i = 0; i < N; i++) draw(&x, i);
  run(&x, 1);
  check_motion(&x);
  check_bits(&x, &y);
  check_doubles(&x);
  return rot_test_report("free_table");
}
