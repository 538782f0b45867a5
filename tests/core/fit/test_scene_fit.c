/* Fits of scenes to records made from closed forms: exact records come back, coverage of simulated
 * ones, unknowns at an edge, without effect and not determined, offsets, factors, clocks, priors,
 * several records, correlated noise, a wrong start. */
#include "fit/scene_fit.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "../sweep/sweep_kit.h"

enum { N = 120, M = ROT_FIT_UNKNOWNS };

static uint64_t state = 12345;
static double uniform(void) {
  state = state * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
  return ((double)(state >> 11) + 0.5) * 0x1p-53;
}
static double normal(void) {
  return sqrt(-2.0 * log(uniform())) * cos(6.283185307179586 * uniform());
}

/* A wheel with dry friction, inertia 1: rests at w/tau. */
static double coast(double w, double tau, double t) {
  return t < w / tau ? w * t - tau * t * t / 2.0 : w * w / (2.0 * tau);
}

static rot_object *wheel(void) {
  rot_object *scene = of("scene_axle");
  put(scene, "body", 1.0);
  part(scene, "resistance", loss(0.0, 0.0, 0.4));
  put(scene, "omega0_rad_per_s", 2.5);
  return scene;
}

/* One record of one column, and all that a fit needs. */
typedef struct kit {
  rot_object *scene;
  double time_s[2][N], y[2][N];
  rot_fit_series series[2];
  rot_fit_record record[2];
  int unknown[2][M], logarithm[M];
  double value[M], low[M], high[M], prior[M], prior_sd[M];
  rot_fit_problem problem;
  double x[M], wave[M], covariance[M * M], factor[M * M], triangle[M * M], fitted[2 * N],
      white[2 * N];
  int held[M];
  rot_fit_noise noise[2];
  rot_fit fit;
} kit;

static void begin(kit *k, rot_object *scene, size_t n, const char *const inputs[],
                  const char *column, size_t records) {
  memset(k, 0, sizeof *k);
  k->scene = scene;
  const size_t at = rot_run_column(scene->constraint, column);
  for (size_t i = 0; i < M; i++) {
    k->low[i] = -DBL_MAX;
    k->high[i] = DBL_MAX;
    k->prior[i] = k->prior_sd[i] = NAN;
    k->unknown[0][i] = k->unknown[1][i] = i < n ? (int)i : ROT_FIT_NONE;
  }
  for (size_t r = 0; r < 2; r++) {
    for (int i = 0; i < N; i++) k->time_s[r][i] = 10.0 * i / (N - 1.0);
    k->series[r] = (rot_fit_series){.of = {at, 0},
                                    .y = k->y[r],
                                    .offset = ROT_FIT_NONE,
                                    .factor = ROT_FIT_NONE,
                                    .rounding = 1e-15};
    k->record[r] =
        (rot_fit_record){N, k->time_s[r], k->unknown[r], k->value, ROT_FIT_NONE, 1, &k->series[r]};
  }
  k->problem = (rot_fit_problem){.scene = scene,
                                 .n_inputs = n,
                                 .inputs = inputs,
                                 .n_records = records,
                                 .records = k->record,
                                 .n_unknowns = n,
                                 .logarithm = k->logarithm,
                                 .low = k->low,
                                 .high = k->high,
                                 .prior = k->prior,
                                 .prior_sd = k->prior_sd,
                                 .accuracy = 1e-10,
                                 .max_steps = 1e6,
                                 .threshold = INFINITY};
  k->fit = (rot_fit){.x = k->x,
                     .held = k->held,
                     .covariance = k->covariance,
                     .wave = k->wave,
                     .factor = k->factor,
                     .triangle = k->triangle,
                     .noise = k->noise,
                     .fitted = k->fitted,
                     .white = k->white};
}

static rot_status solve(kit *k, rot_refusal *no) {
  rot_refusal own;
  return rot_fit_solve(&k->problem, NULL, &k->fit, no ? no : &own);
}

static const char *const friction_and_speed[] = {"resistance$coulomb_n_m", "omega0_rad_per_s"};

/* The stop is inside the record, and elsewhere at the start of the search. */
static void exact_records(void) {
  kit k;
  begin(&k, wheel(), 2, friction_and_speed, "theta_rad", 1);
  k.low[0] = 0.0;
  for (int i = 0; i < N; i++) k.y[0][i] = coast(3.0, 0.5, k.time_s[0][i]);
  k.x[0] = 0.4;
  k.x[1] = 2.5;
  ROT_CHECK(solve(&k, NULL) == ROT_OK);
  ROT_CHECK_REL(k.x[0], 0.5, 1e-10);
  ROT_CHECK_REL(k.x[1], 3.0, 1e-10);
  ROT_CHECK(k.fit.samples == N && k.fit.model != NULL && k.fit.iterations > 0);
  for (int i = 0; i < N; i++) ROT_CHECK(fabs(k.y[0][i] - k.fitted[i]) < 1e-10);
  /* A missing sample is left out. */
  k.y[0][7] = NAN;
  k.x[0] = 0.45;
  ROT_CHECK(solve(&k, NULL) == ROT_OK && k.fit.samples == N - 1);
  ROT_CHECK(isnan(k.white[7]) && fabs(k.fitted[7] - coast(3.0, 0.5, k.time_s[0][7])) < 1e-9);
  ROT_CHECK_REL(k.x[0], 0.5, 1e-10);
  rot_object_free(k.scene);
}

/* The end of the search does not depend on its start. */
static void from_elsewhere(void) {
  static const double start[][2] = {{0.4, 2.5}, {0.7, 3.6}, {0.55, 2.9}};
  double found[3][2], sd = NAN;
  kit k;
  begin(&k, wheel(), 2, friction_and_speed, "theta_rad", 1);
  k.low[0] = 0.0;
  for (int i = 0; i < N; i++) k.y[0][i] = coast(3.0, 0.5, k.time_s[0][i]) + 0.02 * normal();
  for (int s = 0; s < 3; s++) {
    for (int i = 0; i < 2; i++) k.x[i] = start[s][i];
    ROT_CHECK(solve(&k, NULL) == ROT_OK);
    for (int i = 0; i < 2; i++) found[s][i] = k.x[i];
    sd = sqrt(k.covariance[0]);
  }
  for (int s = 1; s < 3; s++) ROT_CHECK(fabs(found[s][0] - found[0][0]) < 2e-5 * sd);
  rot_object_free(k.scene);
}

/* 68 and 95 % intervals of 200 simulated records. */
static void coverage(void) {
  const int trials = rot_test_trials(200) < 200 ? 100 : 200;
  int in_1[2] = {0, 0}, in_2[2] = {0, 0};
  static const double truth[] = {0.5, 3.0};
  kit k;
  begin(&k, wheel(), 2, friction_and_speed, "theta_rad", 1);
  k.low[0] = 0.0;
  for (int trial = 0; trial < trials; trial++) {
    for (int i = 0; i < N; i++) k.y[0][i] = coast(3.0, 0.5, k.time_s[0][i]) + 0.02 * normal();
    k.x[0] = 0.4;
    k.x[1] = 2.5;
    ROT_CHECK(solve(&k, NULL) == ROT_OK);
    ROT_CHECK(k.noise[0].sigma > 0.014 && k.noise[0].sigma < 0.027);
    for (int i = 0; i < 2; i++) {
      const double off = fabs(k.x[i] - truth[i]) / sqrt(k.covariance[i * 2 + i]);
      in_1[i] += off < 1.0;
      in_2[i] += off < 1.98;
    }
  }
  printf("of %d records 68 %% intervals hold %d, %d; 95 %%: %d, %d\n", trials, in_1[0], in_1[1],
         in_2[0], in_2[1]);
  for (int i = 0; i < 2; i++) {
    ROT_CHECK(in_1[i] > 0.68 * trials - 3.0 * sqrt(0.22 * trials));
    ROT_CHECK(in_1[i] < 0.68 * trials + 3.0 * sqrt(0.22 * trials));
    ROT_CHECK(in_2[i] > 0.95 * trials - 3.0 * sqrt(0.05 * trials));
  }
  rot_object_free(k.scene);
}

/* A viscous loss that is not there stays at 0, and the others are as without it. */
static void edge(void) {
  static const char *const input[] = {"resistance$quadratic_n_m_s2", "resistance$coulomb_n_m",
                                      "omega0_rad_per_s"};
  kit k;
  begin(&k, wheel(), 3, input, "theta_rad", 1);
  k.low[0] = k.low[1] = 0.0;
  for (int i = 0; i < N; i++) {
    /* a little less curved than friction alone */
    const double t = k.time_s[0][i];
    k.y[0][i] = coast(3.0, 0.5, t) + (t < 6.0 ? 0.01 * t * t * (6.0 - t) / 36.0 : 0.0);
  }
  k.x[0] = 0.01;
  k.x[1] = 0.4;
  k.x[2] = 2.5;
  ROT_CHECK(solve(&k, NULL) == ROT_OK);
  ROT_CHECK(k.x[0] == 0.0 && k.held[0] == -1 && k.held[1] == 0 && k.held[2] == 0);
  ROT_CHECK_REL(k.x[1], 0.5, 0.05);
  ROT_CHECK(k.covariance[0] == 0.0 && k.covariance[4] > 0.0);
  rot_object_free(k.scene);
}

/* Offset, factor and clock of an instrument; a prior; two records with speeds of their own. */
static void instruments(void) {
  kit k;
  begin(&k, wheel(), 2, friction_and_speed, "theta_rad", 2);
  k.low[0] = 0.0;
  k.problem.n_unknowns = 6;
  /* friction, speed 1, speed 2, offset, factor, clock of the second */
  k.unknown[1][1] = 2;
  for (int r = 0; r < 2; r++) {
    k.series[r].offset = 3;
    k.series[r].factor = 4;
  }
  k.record[1].shift = 5;
  k.low[5] = 0.0; /* the record begins with the scene */
  k.prior[4] = 1.02;
  k.prior_sd[4] = 1e-6; /* else it is one with speed and friction */
  for (int i = 0; i < N; i++) {
    const double t = k.time_s[0][i];
    k.y[0][i] = 0.3 + 1.02 * coast(3.0, 0.5, t);
    k.y[1][i] = 0.3 + 1.02 * coast(2.0, 0.5, t + 0.25);
  }
  const double start[] = {0.45, 2.8, 2.2, 0.0, 1.0, 0.0};
  static const double truth[] = {0.5, 3.0, 2.0, 0.3, 1.02, 0.25};
  memcpy(k.x, start, sizeof start);
  ROT_CHECK(solve(&k, NULL) == ROT_OK);
  for (int i = 0; i < 6; i++) ROT_CHECK(fabs(k.x[i] - truth[i]) < 1e-6);
  ROT_CHECK(k.fit.samples == 2 * N);
  rot_object_free(k.scene);
}

/* Correlated noise is found, and the standard errors grow. */
static void correlated(void) {
  kit k;
  begin(&k, wheel(), 2, friction_and_speed, "theta_rad", 1);
  k.low[0] = 0.0;
  double slow = 0.02 * normal();
  const double keep = exp(-10.0 / (N - 1.0) / 0.5);
  for (int i = 0; i < N; i++) {
    k.y[0][i] = coast(3.0, 0.5, k.time_s[0][i]) + slow;
    slow = keep * slow + sqrt(1.0 - keep * keep) * 0.02 * normal();
  }
  double white[2], coloured[2];
  for (int how = 0; how < 2; how++) {
    k.x[0] = 0.4;
    k.x[1] = 2.5;
    k.problem.threshold = how ? 2.0 : INFINITY;
    ROT_CHECK(solve(&k, NULL) == ROT_OK);
    for (int i = 0; i < 2; i++) (how ? coloured : white)[i] = sqrt(k.covariance[i * 2 + i]);
  }
  ROT_CHECK(k.noise[0].reml.noise.tau_s > 0.1 && k.noise[0].reml.noise.tau_s < 1.01);
  ROT_CHECK(coloured[0] > 1.5 * white[0] && coloured[1] > 1.5 * white[1]);
  /* Given noise is not changed. */
  const rot_fit_noise given = k.noise[0];
  k.problem.noise = &given;
  ROT_CHECK(solve(&k, NULL) == ROT_OK);
  ROT_CHECK(k.noise[0].sigma == given.sigma);
  rot_object_free(k.scene);
}

/* Inertia and friction of a coasting wheel only as their ratio; a mass on a slope not at all. */
static void not_determined(void) {
  static const char *const input[] = {"body", "resistance$coulomb_n_m", "omega0_rad_per_s"};
  kit k;
  begin(&k, wheel(), 3, input, "theta_rad", 1);
  k.logarithm[0] = 1;
  k.low[0] = k.low[1] = 0.0;
  for (int i = 0; i < N; i++) k.y[0][i] = coast(3.0, 0.5, k.time_s[0][i]) + 0.01 * normal();
  k.x[0] = 1.0;
  k.x[1] = 0.4;
  k.x[2] = 2.5;
  const rot_status status = solve(&k, NULL);
  ROT_CHECK(status == ROT_OK);
  ROT_CHECK_REL(k.x[1] / k.x[0], 0.5, 0.01);
  /* The null vector (1, coulomb, 0) of the triangle. */
  double largest = 0.0;
  for (int i = 0; i < 3; i++) {
    const double *row = k.triangle + 3 * i;
    largest = fmax(largest, fabs(row[0] + row[1] * k.x[1]) / fmax(fabs(row[0]), 1e-300));
  }
  ROT_CHECK(fabs(k.triangle[0] + k.triangle[1] * k.x[1]) < 1e-6 * fabs(k.triangle[0]));
  rot_object_free(k.scene);
  static const char *const mass[] = {"v0_m_per_s", "body$mass_kg"};
  rot_object *slope = of("scene_incline");
  part(slope, "body", disk(2.0, 0.1));
  put(slope, "incline_angle_deg", 5.0);
  begin(&k, slope, 2, mass, "x_m", 1);
  for (int i = 0; i < N; i++) k.y[0][i] = k.time_s[0][i];
  k.x[0] = 1.0;
  k.x[1] = 2.0;
  rot_refusal no;
  ROT_CHECK(solve(&k, &no) == ROT_EVALUE && no.input == 3 + 1 && strstr(no.reason, "no effect"));
  /* One number fixed; too many unknowns. */
  k.low[1] = k.high[1] = 2.0;
  ROT_CHECK(solve(&k, &no) == ROT_OK && k.held[1] == -1 && k.x[1] == 2.0);
  k.problem.n_unknowns = M + 1;
  ROT_CHECK(solve(&k, &no) == ROT_EVALUE);
  rot_object_free(slope);
}

/* A free wheel is a straight line: the weighted regression of the angles, by its sums. Samples of
 * weight 1e6 say nothing. White residuals are those by weight and noise; the floor holds. */
static void weights(void) {
  static const char *const line[] = {"theta0_rad", "omega0_rad_per_s"};
  kit k;
  double weight[N], s[5] = {0.0};
  rot_object *scene = of("scene_axle");
  put(scene, "body", 1.0);
  put(scene, "omega0_rad_per_s", 2.0);
  begin(&k, scene, 2, line, "theta_rad", 1);
  for (int i = 0; i < N; i++) {
    const double t = k.time_s[0][i];
    weight[i] = i % 3 ? 1.0 + 0.1 * i : 1e6;
    k.y[0][i] = 0.2 + 3.0 * t + (i % 3 ? 0.02 * normal() : 50.0);
    const double w = 1.0 / (weight[i] * weight[i]);
    s[0] += w;
    s[1] += w * t;
    s[2] += w * t * t;
    s[3] += w * k.y[0][i];
    s[4] += w * t * k.y[0][i];
  }
  k.series[0].weight = weight;
  k.x[1] = 2.0;
  ROT_CHECK(solve(&k, NULL) == ROT_OK);
  const double d = s[0] * s[2] - s[1] * s[1];
  ROT_CHECK_REL(k.x[0], (s[2] * s[3] - s[1] * s[4]) / d, 1e-9);
  ROT_CHECK_REL(k.x[1], (s[0] * s[4] - s[1] * s[3]) / d, 1e-9);
  const double sigma = k.noise[0].sigma;
  ROT_CHECK_REL(k.covariance[0], sigma * sigma * s[2] / d, 1e-6);
  for (int i = 0; i < N; i++) {
    ROT_CHECK(fabs(k.white[i] - (k.y[0][i] - k.fitted[i]) / (sigma * weight[i])) < 1e-9);
  }
  k.series[0].floor = 10.0;
  ROT_CHECK(solve(&k, NULL) == ROT_OK && k.noise[0].sigma == 10.0);
  rot_object_free(scene);
}

int main(void) {
  exact_records();
  weights();
  from_elsewhere();
  coverage();
  edge();
  instruments();
  correlated();
  not_determined();
  return rot_test_report("scene_fit");
}
