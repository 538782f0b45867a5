/* Many axles at once: against 50-digit values, against the rows of rot_axle_linear(), against the
 * kernel for doubles, and every outcome of a row or a run. */
#define ROT_ALONE

#include "scene/axle/linear.h"
#include "scene/axle/sweep.h"

#include <stdlib.h>

#include "ground/real.h"
#include "ground/parallel.h"
#include "scene/axle/sweep_kernel.h"
#include "rot_test.h"

enum { MAX = 140000 };

static double theta[MAX], omega[MAX], omega_max[MAX], max_time[MAX], omega_min[MAX], speed[MAX],
    error[MAX];
static int status[MAX];
static const rot_axle_sweep_columns out = {theta,     omega, omega_max, max_time,
                                           omega_min, speed, error,     status};

static const double time_s[] = {0.0, 1.0, 4.0, 6.0, 8.0};
static const double torque_n_m[] = {0.0, 0.8, 0.8, 0.0, 0.0};
static const rot_torque torque = {5, time_s, torque_n_m, 0.0, 0.0, NULL, NULL};

static rot_column column(const double *x, size_t step) {
  const rot_column one = {x, step};
  return one;
}

/* x: inertia, viscous, scale, omega0, theta0, time; n = 1: every column serves all rows. */
static rot_axle_sweep_rows rows_of(double *const x[6], size_t n, size_t step, double start_s) {
  const rot_axle_sweep_rows rows = {n,
                                    start_s,
                                    column(x[0], step),
                                    column(x[1], step),
                                    column(x[2], step),
                                    column(x[3], step),
                                    column(x[4], step),
                                    column(x[5], step)};
  return rows;
}

/* ---- known rows ----------------------------------------------------------------------------- */

/* The closed form in mpmath, 50 digits: inertia, viscous, scale, omega0, theta0, time, start;
 * theta, omega, largest omega, its time, smallest omega. Maxima inside a piece; sweeps before and
 * after the knots; zero, tiny, large and negative resistance; sizes beyond the kernel's range. */
static const double known[][12] = {
    {0.0625, 0.03, 1.0, 0.0, 0.0, 8.0, 0.0, 107.858645333017103749, 5.82785024015179531384,
     22.053944064363792175, 4.34595419517271573991, 0.0},
    {0.0625, 0.03, 1.0, 0.0, 0.0, 5.5, 0.0, 79.8310161413961043476, 18.4811122521298744843,
     22.053944064363792175, 4.34595419517271573991, 0.0},
    {0.05, 0.2, -1.5, 3.0, 1.0, 7.0, 0.25, -25.0590669697637449914, -0.0137321209450200344492, 3.0,
     0.25, -5.99998986604297353392},
    {0.0625, 0.0, 1.0, -2.0, 0.5, 8.0, 0.0, 285.300000000000016698, 55.6000000000000031974,
     55.6000000000000031974, 6.0, -2.0},
    {2.0, 1e-09, 4.0, 1.0, 0.0, 6.0, 0.0, 29.1999999689000013123, 8.19999998540000041523,
     8.19999998540000042574, 5.99999999487500000912, 0.999999999999999999922},
    {0.001, 0.5, 1.0, 10.0, 0.0, 5.0, 0.5, 6.61839680000000036667, 0.801600000000000044531, 10.0,
     0.5, 0.801600000000000044531},
    {0.0625, 0.03, -1.0, 30.0, 0.0, 8.0, 0.0, -46.7019954170852216284, -5.18304219979909764543,
     30.0, 0.0, -18.5581674066030886052},
    {1e-50, 3e-51, 1e-50, 0.0, 0.0, 8.0, 0.0, 9.27199297400465944364, 0.818402107798602366748,
     1.81670781309053656383, 4.63746914018209765276, 0.0},
    {1e-05, 0.03, 2.0, 0.0, -1.0, 8.0, 0.0, 239.000000000000022204, 0.0, 53.3333333333333382677,
     4.0, 0.0},
    {0.0625, -0.01, 1.0, -6.0, 0.0, 5.75, 0.0, 176.680558098515729121, 79.6688892957625204342,
     79.6688892957625204342, 5.75, -6.03629061713461857799},
    {1e+200, 1e+199, 1e+200, 1.0, 0.0, 8.0, 0.0, 19.9474992812410996352, 2.60525007187588998204,
     3.31576870008811934353, 5.17105782497797010447, 0.993801599884572263677},
};

static void check_known(void) {
  for (size_t i = 0; i < sizeof known / sizeof known[0]; i++) {
    const double *k = known[i];
    double x[6], *in[6];
    rot_info info;
    for (int j = 0; j < 6; j++) {
      x[j] = k[j];
      in[j] = &x[j];
    }
    const rot_axle_sweep_rows rows = rows_of(in, 1, 0, k[6]);
    ROT_CHECK(rot_axle_sweep_linear(&torque, &rows, 1, &out, NULL, &info) == ROT_OK);
    ROT_CHECK(status[0] == ROT_OK && info.rows_done == 1);
    const double fast = fmax(k[9], -k[11]), far = fmax(fabs(k[7]), fabs(theta[0]));
    ROT_CHECK(error[0] > 0.0 && error[0] < 1.5e-14);
    ROT_CHECK(fabs(omega[0] - k[8]) <= error[0] * fast && fabs(omega[0] - k[8]) < 2e-15 * fast);
    ROT_CHECK(fabs(theta[0] - k[7]) < 2e-15 * far + 2e-15 * fast * k[5]);
    ROT_CHECK_REL(speed[0], fast, 1.5e-15);
    ROT_CHECK(fabs(omega_max[0] - k[9]) <= 1.5e-15 * fast);
    ROT_CHECK(fabs(omega_min[0] - k[11]) <= 1.5e-15 * fast);
    ROT_CHECK_REL(max_time[0], k[10], 1e-14);
  }
}

/* ---- against rows one by one ---------------------------------------------------------------- */

static double uniform(unsigned long long *seed) {
  *seed = *seed * 6364136223846793005ULL + 1442695040888963407ULL;
  return (double)(*seed >> 11) * 0x1p-53;
}

/* What rot_axle_linear() sees at so many rows is at most the extremes, and close to them. */
static void check_against_rows(const rot_axle_sweep_rows *rows, size_t i, double scale) {
  enum { N = 2001 };
  static double t[N], to[7][N];
  double scaled[5], top = -INFINITY, low = INFINITY;
  const rot_axle_columns columns = {to[0], to[1], to[2], to[3], to[4], to[5], to[6]};
  rot_axle_params p = {
      rot_at(rows->inertia_kg_m2, i), rot_at(rows->viscous_n_m_s, i),    rows->start_s,
      rot_at(rows->theta0_rad, i),    rot_at(rows->omega0_rad_per_s, i), torque};
  rot_info info;
  for (int j = 0; j < 5; j++) scaled[j] = scale * torque_n_m[j];
  p.torque.torque_n_m = scaled;
  const double end = rot_at(rows->time_s, i);
  for (int j = 0; j < N; j++) t[j] = p.start_s + (end - p.start_s) * j / (N - 1);
  t[N - 1] = end;
  ROT_CHECK(rot_axle_linear(&p, N, t, &columns, NULL, &info) == ROT_OK);
  for (int j = 0; j < N; j++) {
    top = fmax(top, to[1][j]);
    low = fmin(low, to[1][j]);
  }
  const double off =
      error[i] * fmax(speed[i], info.measure[ROT_OMEGA].largest) + info.measure[ROT_OMEGA].error;
  const double off_theta = error[i] * fmax(info.measure[ROT_THETA].largest, fabs(theta[i])) +
                           info.measure[ROT_THETA].error;
  ROT_CHECK(fabs(omega[i] - to[1][N - 1]) <= off);
  ROT_CHECK(fabs(theta[i] - to[0][N - 1]) <= off_theta);
  ROT_CHECK(omega_max[i] >= top - off && omega_min[i] <= low + off);
  ROT_CHECK(omega_max[i] <= top + 2e-3 * info.measure[ROT_OMEGA].largest + off);
  ROT_CHECK(omega_min[i] >= low - 2e-3 * info.measure[ROT_OMEGA].largest - off);
  ROT_CHECK(speed[i] == fmax(omega_max[i], -omega_min[i]));
}

static void check_random(void) {
  enum { ROWS = 400 };
  static double x[6][ROWS];
  double *in[6], worst = 0.0;
  unsigned long long seed = 5;
  rot_info info;
  for (int j = 0; j < 6; j++) in[j] = x[j];
  for (size_t i = 0; i < ROWS; i++) {
    x[0][i] = 0.0625 * exp2(8.0 * uniform(&seed) - 4.0);
    x[1][i] = i % 10 == 0 ? 0.0 : x[0][i] * exp2(16.0 * uniform(&seed) - 12.0);
    x[2][i] = 4.0 * uniform(&seed) - 2.0;
    x[3][i] = i % 3 ? 40.0 * uniform(&seed) - 20.0 : 0.0;
    x[4][i] = i % 5 ? 2.0 * uniform(&seed) - 1.0 : 0.0;
    x[5][i] = 0.5 + 9.0 * uniform(&seed);
    if (i % 7 == 0) x[1][i] = -0.1 * x[1][i]; /* drives */
  }
  const rot_axle_sweep_rows rows = rows_of(in, ROWS, 1, 0.5);
  ROT_CHECK(rot_axle_sweep_linear(&torque, &rows, 1, &out, NULL, &info) == ROT_OK);
  for (size_t i = 0; i < ROWS; i++) {
    ROT_CHECK_EQ_INT(status[i], ROT_OK);
    check_against_rows(&rows, i, x[2][i]);
    worst = fmax(worst, error[i]);
  }
  printf("  random rows: widest bound %.2g\n", worst);
}

/* The kernel compiled for doubles gives the bits of registers. */
static void check_doubles(void) {
  enum { ROWS = ROT_AXLE_SWEEP_BLOCK };
  static double x[6][ROWS];
  static rot_axle_sweep_block b;
  double *in[6];
  unsigned long long seed = 9;
  rot_info info;
  for (int j = 0; j < 6; j++) in[j] = x[j];
  for (int turn = 0; turn < 50; turn++) {
    for (size_t i = 0; i < ROWS; i++) {
      x[0][i] = 0.0625 * exp2(8.0 * uniform(&seed) - 4.0);
      x[1][i] = x[0][i] * exp2(16.0 * uniform(&seed) - 12.0);
      x[2][i] = 4.0 * uniform(&seed) - 2.0;
      x[3][i] = 40.0 * uniform(&seed) - 20.0;
      x[4][i] = 2.0 * uniform(&seed) - 1.0;
      x[5][i] = 0.5 + 9.0 * uniform(&seed);
      b.c[i] = x[1][i];
      b.inverse[i] = 1.0 / x[0][i];
      b.lambda[i] = x[1][i] / x[0][i];
      b.scale[i] = x[2][i];
      b.end_s[i] = x[5][i];
      b.time_s[i] = b.omega_max_time_s[i] = 0.5;
      b.theta[i] = x[4][i];
      b.omega[i] = b.omega_max[i] = b.omega_min[i] = x[3][i];
      b.theta_error[i] = b.omega_error[i] = b.worst_error[i] = 0.0;
      b.theta_max[i] = fabs(x[4][i]);
    }
    const rot_axle_sweep_rows rows = rows_of(in, ROWS, 1, 0.5);
    ROT_CHECK(rot_axle_sweep_linear(&torque, &rows, 1, &out, NULL, &info) == ROT_OK);
    for (size_t k = 1; k <= torque.n; k++) {
      const rot_torque_piece piece = rot_torque_piece_at(&torque, k);
      pass_block(&b, &piece, k > 1 ? piece.start_n_m : rot_torque_in_piece(&piece, 0.5));
    }
    for (size_t i = 0; i < ROWS; i++) {
      ROT_CHECK(b.theta[i] == theta[i] && b.omega[i] == omega[i] &&
                b.omega_max[i] == omega_max[i] && b.omega_max_time_s[i] == max_time[i] &&
                b.omega_min[i] == omega_min[i]);
    }
  }
}

/* ---- endings -------------------------------------------------------------------------------- */

static void check_bad_rows(void) {
  double x[6][6] = {{1, 0, -1, 1, 1, 1},    {0, 0, 0, 0, -1e300, NAN}, {1, 1, 1, 1, 1, 1},
                    {1, 1, 1, 1, 1e300, 1}, {0, 0, 0, 0, 0, 0},        {2, 2, 2, -1, 1e300, 2}};
  static const int want[] = {ROT_OK, ROT_EVALUE, ROT_EVALUE, ROT_EVALUE, ROT_ERANGE, ROT_EVALUE};
  double *in[6];
  rot_info info;
  for (int j = 0; j < 6; j++) in[j] = x[j];
  const rot_axle_sweep_rows rows = rows_of(in, 6, 1, 0.0);
  ROT_CHECK(rot_axle_sweep_linear(&torque, &rows, 1, &out, NULL, &info) == ROT_OK);
  for (int i = 0; i < 6; i++) {
    ROT_CHECK_EQ_INT(status[i], want[i]);
    ROT_CHECK(isnan(theta[i]) == (want[i] != ROT_OK) && isnan(omega_max[i]) == isnan(theta[i]));
    ROT_CHECK(isnan(error[i]) == isnan(theta[i]) && isnan(speed[i]) == isnan(theta[i]));
  }
}

typedef struct polls {
  int calls, stop_at;
} polls;

static rot_status count_polls(void *ctx, double fraction) {
  polls *p = ctx;
  ROT_CHECK(fraction > 0.0 && fraction <= 1.0);
  return ++p->calls == p->stop_at ? ROT_EUNWIND : ROT_OK;
}

/* Many rows: the same whoever computes them, and stopped between chunks. */
static void check_many(void) {
  static double x[6][MAX], first[2][MAX];
  double *in[6];
  unsigned long long seed = 9;
  rot_info info;
  polls seen = {0, 2};
  const rot_hooks hooks = {count_polls, &seen};
  for (int j = 0; j < 6; j++) in[j] = x[j];
  for (size_t i = 0; i < MAX; i++) {
    x[0][i] = 0.05 + 0.1 * uniform(&seed);
    x[1][i] = 0.01 + 0.1 * uniform(&seed);
    x[2][i] = 1.0;
    x[5][i] = 8.0 * uniform(&seed);
  }
  const rot_axle_sweep_rows rows = rows_of(in, MAX, 1, 0.0);
  ROT_CHECK(rot_axle_sweep_linear(&torque, &rows, 1, &out, NULL, &info) == ROT_OK);
  ROT_CHECK_EQ_INT(info.rows_done, MAX);
  memcpy(first[0], omega, sizeof first[0]);
  memcpy(first[1], max_time, sizeof first[1]);
  ROT_CHECK(rot_axle_sweep_linear(&torque, &rows, 0, &out, &hooks, &info) == ROT_EUNWIND);
  ROT_CHECK(info.rows_done > 0 && info.rows_done < MAX && seen.calls == 2);
  ROT_CHECK(rot_axle_sweep_linear(&torque, &rows, 3, &out, NULL, &info) == ROT_OK);
  ROT_CHECK(!memcmp(first[0], omega, sizeof first[0]));
  ROT_CHECK(!memcmp(first[1], max_time, sizeof first[1]));
  ROT_CHECK(rot_parallel_threads() >= 1);
}

/* ---- by a model ----------------------------------------------------------------------------- */

/* Omits friction and must report that. It runs in threads, so it makes no checks. */
static rot_status linear_model(const rot_axle_scene *scene, size_t n, const double t[],
                               const rot_axle_columns *to, rot_events *events,
                               const rot_hooks *hooks, rot_info *info) {
  (void)events;
  if (scene->quadratic_n_m_s2 != 0.25 || scene->coulomb_n_m != 0.5 || scene->static_n_m != 0.75 ||
      scene->viscous_n_m_s + 0.125 != scene->linear.viscous_n_m_s) {
    return ROT_EBUDGET;
  }
  return rot_axle_linear(&scene->linear, n, t, to, hooks, info);
}

static void check_scenes(void) {
  enum { ROWS = 1100 };
  static double x[6][ROWS];
  static const double quadratic = 0.25, coulomb = 0.5, bad = 0.1, sticks = 0.75;
  double *in[6];
  unsigned long long seed = 11;
  rot_info info;
  rot_axle_sweep_friction friction = {column(&quadratic, 0), column(&coulomb, 0),
                                      column(&sticks, 0)};
  rot_axle_scene scene = {.motor_n_m_s = 0.125};
  rot_axle_columns row;
  double one[7][1];
  scene.linear.torque = torque;
  for (int j = 0; j < 6; j++) in[j] = x[j];
  for (size_t i = 0; i < ROWS; i++) {
    for (int j = 0; j < 6; j++) x[j][i] = 0.1 + uniform(&seed);
  }
  const rot_axle_sweep_rows rows = rows_of(in, ROWS, 1, 0.0);
  ROT_CHECK(rot_axle_sweep_scenes(linear_model, &scene, &rows, &friction, 1, 2, &out, NULL,
                                  &info) == ROT_OK);
  ROT_CHECK_EQ_INT(info.rows_done, ROWS);
  for (size_t i = 0; i < ROWS; i += 100) {
    double scaled[5];
    for (int j = 0; j < 5; j++) scaled[j] = x[2][i] * torque_n_m[j];
    const rot_axle_params p = {x[0][i], x[1][i] + 0.125, 0.0,
                               x[4][i], x[3][i],         {5, time_s, scaled, 0.0, 0.0, NULL, NULL}};
    row = (rot_axle_columns){one[0], one[1], one[2], one[3], one[4], one[5], one[6]};
    ROT_CHECK(rot_axle_linear(&p, 1, &x[5][i], &row, NULL, &info) == ROT_OK);
    ROT_CHECK(status[i] == ROT_OK && theta[i] == one[0][0] && omega[i] == one[1][0]);
    ROT_CHECK(speed[i] == info.measure[ROT_OMEGA].largest && error[i] == rot_info_error(&info));
    ROT_CHECK(omega_max[i] == info.measure[ROT_OMEGA].high &&
              omega_min[i] == info.measure[ROT_OMEGA].low);
    ROT_CHECK(isnan(max_time[i]));
  }
  ROT_CHECK(rot_axle_sweep_scenes(linear_model, &scene, &rows, &friction, 0, 1, &out, NULL,
                                  &info) == ROT_OK);
  ROT_CHECK(isnan(speed[0]) && isnan(omega_max[0]) && !isnan(omega[0]));
  friction.static_n_m = column(&bad, 0); /* below Coulomb's */
  ROT_CHECK(rot_axle_sweep_scenes(linear_model, &scene, &rows, &friction, 1, 1, &out, NULL,
                                  &info) == ROT_OK);
  ROT_CHECK(status[0] == ROT_EVALUE && isnan(omega[0]) && isnan(error[0]));
}

/* The exponential of the lanes, against the library's. */
static void check_decay(void) {
  double worst = 0.0;
  for (double x = 0.0; x <= 700.0; x += x < 2.0 ? 0.0007 : 0.173) {
    worst = fmax(worst, rot_test_ulp(rot_pair_decay(x), exp(-x)));
  }
  printf("  exponential of the lanes: %g ulp\n", worst);
  ROT_CHECK(worst <= 2.0);
}

int main(void) {
  check_decay();
  check_known();
  check_random();
  check_doubles();
  check_bad_rows();
  check_many();
  check_scenes();
  return rot_test_report("axle_sweep");
}
