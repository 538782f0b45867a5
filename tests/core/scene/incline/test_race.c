/* Bodies released together: against the book's numbers, and against the run of each scene. */
#include "scene/incline/race.h"

#include <stdint.h>

#include "scene/incline/incline.h"
#include "ground/real.h"
#include "rot_test.h"

enum { MAX = 64 };

typedef struct race {
  double in[8][MAX], c[4][MAX], f[5][4 * MAX];
  int slips[MAX], rests[MAX], finished[4 * MAX];
} race;

static rot_column whole(const double *x) {
  const rot_column column = {x, 1};
  return column;
}

static rot_status starts(race *r, size_t n) {
  const rot_race_bodies bodies = {n,
                                  whole(r->in[0]),
                                  whole(r->in[1]),
                                  whole(r->in[2]),
                                  whole(r->in[3]),
                                  whole(r->in[4]),
                                  whole(r->in[5]),
                                  whole(r->in[6]),
                                  whole(r->in[7])};
  const rot_race_columns out = {r->c[0], r->c[1], r->c[2], r->c[3], r->slips, r->rests};
  rot_info info;
  const rot_status status = rot_race_starts(&bodies, &out, NULL, &info);
  ROT_CHECK(info.rows_done == n);
  return status;
}

/* beta, R, degrees, g, mu_s, mu_k, arm, length */
static void set(race *r, size_t i, const double x[]) {
  for (int k = 0; k < 8; k++) r->in[k][i] = x[k];
}

static void book(void) {
  race r;
  /* University Physics, example 11.1: a hoop on 60 degrees needs 0.866. */
  set(&r, 0, (double[]){1, 0.1, 60, 9.8, 0.5, 0.5, 0, 2});
  set(&r, 1, (double[]){1, 0.1, 60, 9.8, 0.9, 0.9, 0, 2});
  /* A marble: 3.5 m/s^2, 15.75 m in 3 s. */
  set(&r, 2, (double[]){0.4, 0.1, 30, 9.8, INFINITY, INFINITY, 0, 15.75});
  /* tan 1 degree = 0.0175 is less than b/R = 0.1: it stays. */
  set(&r, 3, (double[]){1, 0.1, 1, 9.8, 0.9, 0.9, 0.01, 2});
  set(&r, 4, (double[]){1, 0.1, 90, 9.8, 0.9, 0.9, 0.01, 4.9});
  set(&r, 5, (double[]){0, 0.1, 30, 9.8, 0, 0, 0, 2.45});
  set(&r, 6, (double[]){INFINITY, 0.1, 30, 9.8, INFINITY, INFINITY, 0, 1});
  set(&r, 7, (double[]){1, 0.1, -30, 9.8, INFINITY, INFINITY, 0, 1});
  set(&r, 8, (double[]){NAN, 0.1, 30, 9.8, INFINITY, INFINITY, 0, 1});
  ROT_CHECK(starts(&r, 9) == ROT_OK);
  ROT_CHECK_REL(r.c[2][0], 0.8660254037844386, 1e-15);
  ROT_CHECK_REL(r.c[0][0], 9.8 * (0.8660254037844386 - 0.25), 1e-15);
  ROT_CHECK_REL(r.c[1][0], 0.5 * 9.8 * 0.5 / 0.1, 1e-15);
  ROT_CHECK_REL(r.c[0][1], 0.5 * 9.8 * 0.8660254037844386, 1e-15);
  ROT_CHECK_REL(r.c[3][2], 3.0, 1e-15);
  ROT_CHECK(r.c[0][3] == 0.0 && isinf(r.c[3][3]));
  ROT_CHECK_REL(r.c[2][3], 0.017455064928217585, 1e-15);
  ROT_CHECK(isinf(r.c[2][4]) && r.c[0][4] == 9.8 && r.c[3][4] == 1.0);
  ROT_CHECK(r.c[0][5] == 4.9 && r.c[1][5] == 0.0 && r.c[3][5] == 1.0 && r.c[2][5] == 0.0);
  ROT_CHECK(r.c[0][6] == 0.0 && isinf(r.c[3][6]));
  ROT_CHECK(r.c[0][7] < 0.0 && isinf(r.c[3][7]));
  ROT_CHECK(isnan(r.c[0][8]) && isnan(r.c[3][8]));
  const char *motion = "srrrsrrr", *still = "---s--s-";
  for (int i = 0; i < 8; i++) {
    ROT_CHECK_EQ_INT(r.slips[i], motion[i] == 's');
    ROT_CHECK_EQ_INT(r.rests[i], still[i] == 's');
  }
}

static uint64_t state = 88172645463325252u;

static double uniform(double lo, double hi) {
  state ^= state << 13;
  state ^= state >> 7;
  state ^= state << 17;
  return lo + (hi - lo) * (double)(state >> 11) * 0x1p-53;
}

static void as_scenes(void) {
  race r;
  rot_info info;
  const double time_s[] = {0.0, 0.4, 1.1, 3.0};
  for (size_t i = 0; i < MAX; i++) {
    const double mu = uniform(0.0, 0.9);
    set(&r, i,
        (double[]){uniform(0.1, 1.5), uniform(0.05, 0.5), uniform(1.0, 80.0), 9.8, mu,
                   mu * uniform(0.5, 1.0), i % 3 ? 0.0 : uniform(0.0, 0.1), 6.0});
  }
  ROT_CHECK(starts(&r, MAX) == ROT_OK);
  const rot_race_frames out = {r.f[0], r.f[1], r.f[2], r.f[3], r.f[4], r.finished};
  ROT_CHECK(rot_race_run(MAX, r.c[0], r.c[1], r.c[3], 4, time_s, &out, NULL, &info) == ROT_OK);
  ROT_CHECK(info.rows_done == 4 * MAX);
  for (size_t row = 0; row < 4 * MAX; row++) {
    const size_t i = row % MAX;
    double x[8];
    for (int k = 0; k < 8; k++) x[k] = r.in[k][i];
    const rot_incline_params p = {
        1.0, x[1], x[0] * x[1] * x[1], x[2], x[3], x[5], x[4], x[6], 0.0, 0.0, 0.0, 0.0, 0.0};
    const double t = fmin(time_s[row / MAX], r.c[3][i]);
    rot_incline_end end;
    ROT_CHECK(rot_incline_to(&p, t, &end) == ROT_OK);
    ROT_CHECK(r.f[0][row] == time_s[row / MAX]);
    ROT_CHECK_REL(r.f[1][row], end.x_m, 4e-15);
    ROT_CHECK_REL(r.f[2][row], end.v_m_per_s, 4e-15);
    ROT_CHECK_REL(r.f[3][row], end.theta_rad, 4e-15);
    ROT_CHECK_REL(r.f[4][row], end.omega_rad_per_s, 4e-15);
    ROT_CHECK(r.finished[row] == (time_s[row / MAX] >= r.c[3][i]));
    if (r.finished[row]) ROT_CHECK_REL(r.f[1][row], 6.0, 1e-15);
    ROT_CHECK(t == 0.0 || end.rolling == !r.slips[i]);
  }
}

/* A spool with all its inertia at a huge radius stays: friction takes the whole pull. */
static void infinite_beta(void) {
  race r;
  set(&r, 0, (double[]){INFINITY, 0.1, 30, 9.8, 0.6, 0.5, 0, 1});
  ROT_CHECK(starts(&r, 1) == ROT_OK);
  ROT_CHECK_REL(r.c[2][0], 0.57735026918962576, 1e-15);
}

/* More rows than are computed between two polls: all of them, or those before the stop. */
enum { ROWS = 140000 };
static rot_status stop_at(void *ctx, double fraction) {
  return fraction > *(double *)ctx ? ROT_EUNWIND : ROT_OK;
}

static void many_rows(void) {
  static double time_s[ROWS], f[5][ROWS];
  static int finished[ROWS];
  const double acceleration = 3.5, angular = 7.0, finish_s = 1e9;
  for (int i = 0; i < ROWS; i++) time_s[i] = 0.5 * i;
  const rot_race_frames out = {f[0], f[1], f[2], f[3], f[4], finished};
  rot_info info;
  double until = 2.0;
  const rot_hooks hooks = {stop_at, &until};
  ROT_CHECK(rot_race_run(1, &acceleration, &angular, &finish_s, ROWS, time_s, &out, &hooks,
                         &info) == ROT_OK);
  ROT_CHECK(info.rows_done == ROWS);
  ROT_CHECK_REL(f[2][ROWS - 1], 1.75 * (ROWS - 1), 1e-15);
  /* Spheres on slopes from 1 to 31 degrees: a = 5/7 g sin(angle). */
  for (int i = 0; i < ROWS; i++) time_s[i] = 1.0 + i % 31;
  const double beta = 0.4, radius = 0.1, gravity = 9.8, mu = 1.0, arm = 0.0, length = 1.0;
  const rot_race_bodies bodies = {ROWS,     {&beta, 0}, {&radius, 0}, whole(time_s), {&gravity, 0},
                                  {&mu, 0}, {&mu, 0},   {&arm, 0},    {&length, 0}};
  const rot_race_columns columns = {f[0], f[1], f[2], f[3], finished, finished};
  ROT_CHECK(rot_race_starts(&bodies, &columns, NULL, &info) == ROT_OK && info.rows_done == ROWS);
  ROT_CHECK_REL(f[0][ROWS - 1], 7.0 * sin(time_s[ROWS - 1] * 0.017453292519943295), 1e-15);
  until = 0.0;
  ROT_CHECK(rot_race_starts(&bodies, &columns, &hooks, &info) == ROT_EUNWIND);
  ROT_CHECK(info.rows_done < ROWS);
  ROT_CHECK(rot_race_run(1, &acceleration, &angular, &finish_s, ROWS, time_s, &out, &hooks,
                         &info) == ROT_EUNWIND);
}

int main(void) {
  book();
  as_scenes();
  infinite_beta();
  many_rows();
  return rot_test_report("incline_race");
}
