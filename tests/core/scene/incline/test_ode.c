/* The integrated incline: against the closed form of constant forces, which is tested against
 * mpmath; and with drag and forces against closed forms that need no friction law. */
#include "scene/incline/ode.h"

#include <math.h>
#include <stdint.h>

#include "scene/incline/models.h"
#include "ground/real.h"
#include "rot_test.h"

enum { ROWS = 64 };

typedef struct table {
  double c[11][ROWS], s[8][ROWS];
  int rolling[ROWS];
  rot_incline_columns out;
  rot_incline_sums sums;
  rot_info info;
  rot_events events;
} table;

static void point(table *to) {
  to->out = (rot_incline_columns){to->c[0], to->c[1], to->c[2], to->c[3], to->c[4],  to->c[5],
                                  to->c[6], to->c[7], to->c[8], to->c[9], to->c[10], to->rolling};
  to->sums = (rot_incline_sums){to->s[0], to->s[1], to->s[2], to->s[3], to->s[4],
                                to->s[5], to->s[6], to->s[7], {0.0}};
  to->events = (rot_events){0};
}

static rot_status run(const rot_incline_scene *scene, size_t n, const double t[], double accuracy,
                      rot_method method, table *to) {
  const rot_incline_ode_options options = {accuracy, 100000, method, 0.0, 0.0};
  point(to);
  return rot_incline_integrate(scene, &options, n, t, &to->out, &to->sums, &to->events, NULL, NULL,
                               &to->info);
}

static uint64_t state = 88172645463325252u;

static double uniform(double lo, double hi) {
  state ^= state << 13;
  state ^= state >> 7;
  state ^= state << 17;
  return lo + (hi - lo) * (double)(state >> 11) * 0x1p-53;
}

/* A sphere of 2 kg and 0.1 m. */
static rot_incline_scene sphere(double angle_deg, double mu, double arm_m, double v0, double w0) {
  const rot_incline_params slope = {2.0,   0.1, 0.008, angle_deg, 9.8,      0.8 * mu, mu,
                                    arm_m, 0.0, v0,    0.0,       w0 / 0.1, 0.0};
  return (rot_incline_scene){.slope = slope};
}

/* The rows at events of a run to 3 s: one for each time of the log, as those of the closed form. */
static void rows_of_events(const rot_incline_scene *scene, rot_method method) {
  const rot_incline_ode_options options = {1e-10, 100000, method, 0.0, 0.0};
  rot_incline_event_rows exact = {0, 0, NULL}, ours = {0, 0, NULL};
  rot_events events = {0};
  rot_info info;
  table to;
  const double t = 3.0;
  point(&to);
  ROT_CHECK(rot_incline_run(&scene->slope, 1, &t, &to.out, &events, &exact, NULL, &info) == ROT_OK);
  ROT_CHECK(rot_incline_integrate(scene, &options, 1, &t, &to.out, &to.sums, NULL, NULL, NULL,
                                  &to.info) == ROT_OK);
  ROT_CHECK(rot_incline_integrate(scene, &options, 1, &t, &to.out, &to.sums, &to.events, &ours,
                                  NULL, &to.info) == ROT_OK);
  ROT_CHECK(ours.count == exact.count && exact.count <= events.count);
  for (size_t k = 0; k < exact.count && k < ours.count; k++) {
    const rot_incline_row *a = &exact.row[k], *b = &ours.row[k];
    const double size = 1.0 + fabs(a->v_m_per_s);
    ROT_CHECK(fabs(a->time_s - b->time_s) <= 1e-8);
    ROT_CHECK(fabs(a->x_m - b->x_m) <= 1e-8 * (1.0 + fabs(a->x_m)));
    ROT_CHECK(fabs(a->v_m_per_s - b->v_m_per_s) <= 1e-7 * size);
    ROT_CHECK(fabs(a->omega_rad_per_s - b->omega_rad_per_s) <= 1e-6 * size);
    ROT_CHECK(fabs(a->slip_heat_j - b->slip_heat_j) <= 1e-7 * (1.0 + a->slip_heat_j));
    ROT_CHECK(fabs(a->friction_force_n - b->friction_force_n) <= 1e-7);
    ROT_CHECK(a->rolling == b->rolling);
    int logged = 0;
    for (size_t e = 0; e < events.count; e++) logged |= events.time_s[e] == a->time_s;
    ROT_CHECK(logged);
  }
  rot_incline_event_rows_free(&exact);
  rot_incline_event_rows_free(&ours);
  rot_events_free(&events);
  rot_events_free(&to.events);
}

static void constant_forces(void) {
  static const double arms[] = {0.0, 0.004, 0.05};
  double worst = 0.0;
  for (int i = 0; i < 120; i++) {
    rot_incline_scene scene =
        sphere(i % 5 ? uniform(-60.0, 60.0) : 0.0, uniform(0.0, 0.8), arms[i % 3],
               i % 7 ? uniform(-4.0, 4.0) : 0.0, i % 4 ? uniform(-4.0, 4.0) : 0.0);
    scene.slope.x0_m = i % 2 ? 0.7 : 0.0;
    double t[ROWS];
    table exact, ours;
    for (int k = 0; k < ROWS; k++) t[k] = 3.0 * k / (ROWS - 1);
    point(&exact);
    ROT_CHECK(rot_incline_run(&scene.slope, ROWS, t, &exact.out, &exact.events, NULL, NULL,
                              &exact.info) == ROT_OK);
    ROT_CHECK(run(&scene, ROWS, t, 1e-10, i % 6 ? ROT_METHOD_RK8PD : ROT_METHOD_RADAU, &ours) ==
              ROT_OK);
    ROT_CHECK(ours.events.count == exact.events.count);
    for (size_t e = 0; e < exact.events.count && e < ours.events.count; e++) {
      ROT_CHECK(ours.events.event[e] == exact.events.event[e]);
      ROT_CHECK(fabs(ours.events.time_s[e] - exact.events.time_s[e]) <= 1e-8);
    }
    for (int c = 0; c < 4; c++) {
      const rot_measure *a = &exact.info.measure[c], *b = &ours.info.measure[c];
      for (int k = 0; k < ROWS; k++) {
        const double off = fabs(ours.c[c][k] - exact.c[c][k]);
        ROT_CHECK(off <= a->error + b->error);
        worst = fmax(worst, a->largest > 0.0 ? off / a->largest : off);
      }
    }
    for (int k = 0; k < ROWS; k++) {
      ROT_CHECK(ours.rolling[k] == exact.rolling[k]);
      ROT_CHECK(fabs(ours.c[5][k] - exact.c[5][k]) <= 1e-7);
      ROT_CHECK(fabs(ours.c[9][k] - exact.c[9][k]) <= 1e-7 * (1.0 + exact.c[9][k]));
      ROT_CHECK(fabs(ours.c[10][k] - exact.c[10][k]) <= 1e-7 * (1.0 + exact.c[10][k]));
    }
    rows_of_events(&scene, i % 6 ? ROT_METHOD_RK8PD : ROT_METHOD_RADAU);
    rot_events_free(&exact.events);
    rot_events_free(&ours.events);
  }
  printf("constant forces: %.2g\n", worst);
  ROT_CHECK(worst <= 1e-9);
}

/* A step that ends at the change itself, to rounding, finds it in time: a break is put there. */
static void breaks_at_changes(void) {
  double worst = 0.0;
  for (int i = 0; i < 200; i++) {
    rot_incline_scene scene = sphere(uniform(-40.0, 40.0), uniform(0.05, 0.8), i % 2 ? 0.004 : 0.0,
                                     uniform(-4.0, 4.0), uniform(-4.0, 4.0));
    const double t = 3.0;
    double at[3];
    table exact, ours;
    point(&exact);
    ROT_CHECK(rot_incline_run(&scene.slope, 1, &t, &exact.out, &exact.events, NULL, NULL,
                              &exact.info) == ROT_OK);
    const size_t n = exact.events.count < 3 ? exact.events.count : 3;
    for (size_t e = 0; e < n; e++) {
      at[e] = exact.events.time_s[e] * (1.0 + (i % 3 - 1) * 0x1p-52);
    }
    scene.breaks_s = at;
    scene.n_breaks = n;
    ROT_CHECK(run(&scene, 1, &t, 1e-12, ROT_METHOD_RK8PD, &ours) == ROT_OK);
    ROT_CHECK_EQ_INT((long)ours.events.count, (long)exact.events.count);
    for (size_t e = 0; e < exact.events.count && e < ours.events.count; e++) {
      ROT_CHECK(ours.events.event[e] == exact.events.event[e]);
      worst = fmax(worst, fabs(ours.events.time_s[e] - exact.events.time_s[e]));
    }
    rot_events_free(&exact.events);
    rot_events_free(&ours.events);
  }
  printf("changes at breaks: %.2g s\n", worst);
  ROT_CHECK(worst <= 1e-11);
}

/* Rolling with quadratic drag: v = vt tanh(c vt t/M), x = M/c log cosh(c vt t/M), M = m (1 + beta),
 * vt^2 = m g sin/c. */
static void quadratic_drag(void) {
  rot_incline_scene scene = sphere(30.0, 0.9, 0.0, 0.0, 0.0);
  scene.drag_n_s2_per_m2 = 0.3;
  const double t[] = {0.5, 2.0, 9.0}, top = sqrt(2.0 * 9.8 * 0.5 / 0.3), mass = 2.0 * 1.4;
  table rows;
  ROT_CHECK(run(&scene, 3, t, 1e-12, ROT_METHOD_RK8PD, &rows) == ROT_OK);
  for (int k = 0; k < 3; k++) {
    const double s = 0.3 * top * t[k] / mass;
    ROT_CHECK_REL(rows.c[1][k], top * tanh(s), 1e-11);
    ROT_CHECK_REL(rows.c[3][k], top * tanh(s) / 0.1, 1e-11);
    ROT_CHECK_REL(rows.c[0][k], mass / 0.3 * log(cosh(s)), 1e-11);
    /* Energy: m g sin x = kinetic + drag. */
    const double kinetic = 0.5 * mass * rows.c[1][k] * rows.c[1][k];
    ROT_CHECK_REL(rows.s[1][k], 9.8 * rows.c[0][k] - kinetic, 1e-10);
    ROT_CHECK_REL(rows.s[6][k], -0.3 * rows.c[1][k] * rows.c[1][k], 1e-12);
  }
}

/* Sliding without friction on a level floor, linear drag: v = v0 exp(-c t/m); omega stays. */
static void linear_drag(void) {
  rot_incline_scene scene = sphere(0.0, 0.0, 0.0, 3.0, -1.0);
  scene.drag_n_s_per_m = 0.8;
  const double t[] = {1.0, 6.0};
  for (int method = ROT_METHOD_RK8PD; method <= ROT_METHOD_RADAU; method++) {
    table rows;
    ROT_CHECK(run(&scene, 2, t, 1e-11, (rot_method)method, &rows) == ROT_OK);
    for (int k = 0; k < 2; k++) {
      ROT_CHECK_REL(rows.c[1][k], 3.0 * exp(-0.4 * t[k]), 1e-10);
      ROT_CHECK_REL(rows.c[0][k], -7.5 * expm1(-0.4 * t[k]), 1e-10);
      ROT_CHECK_REL(rows.c[3][k], -10.0, 1e-15);
    }
    ROT_CHECK_EQ_INT((long)rows.events.count, 0);
  }
}

static rot_status ramp(double t, double x, double v, double *force, void *ctx) {
  (void)x, (void)v;
  *force = *(const double *)ctx * t;
  return ROT_OK;
}

static rot_status pulse(double t, double x, double v, double *force, void *ctx) {
  (void)x, (void)v, (void)ctx;
  *force = t < 1.0 ? 0.0 : t < 2.0 ? 8.0 : 0.0;
  return ROT_OK;
}

/* A force 6 t on a level floor: it rests until 6 t = m g b/R, rolls, and slips where
 * F = (beta F/m + g b/R)/(1 + beta) is mu_s g. */
static void breaks_loose(void) {
  rot_incline_scene scene = sphere(0.0, 0.3, 0.002, 0.0, 0.0);
  double slope = 6.0;
  scene.force = ramp;
  scene.ctx = &slope;
  const double t[] = {0.0, 1.0, 8.0}, held = 9.8 * 0.02;
  const double rolls = 2.0 * held / 6.0, slips = 2.0 * (0.3 * 9.8 * 1.4 - held) / 0.4 / 6.0;
  table rows;
  ROT_CHECK(run(&scene, 3, t, 1e-11, ROT_METHOD_NONE, &rows) == ROT_OK);
  ROT_CHECK_EQ_INT((long)rows.events.count, 2);
  ROT_CHECK(rows.events.event[0] == ROT_EVENT_ROLL && rows.events.event[1] == ROT_EVENT_SLIP);
  ROT_CHECK_REL(rows.events.time_s[0], rolls, 1e-10);
  ROT_CHECK_REL(rows.events.time_s[1], slips, 1e-10);
  const double s = 1.0 - rolls; /* v' = 3 s/1.4 from then on */
  ROT_CHECK_REL(rows.c[1][1], 1.5 * s * s / 1.4, 1e-10);
  /* After the slip: m v' = 6 t - mu_k m g, I w'/R = mu_k m g R - arm m g. */
  const double d = slips - rolls, v1 = 1.5 * d * d / 1.4, u = 8.0 - slips;
  ROT_CHECK_REL(rows.c[1][2], v1 + 1.5 * (64.0 - slips * slips) - 0.24 * 9.8 * u, 1e-10);
  ROT_CHECK_REL(rows.c[3][2], (v1 + (0.24 * 9.8 - held) / 0.4 * u) / 0.1, 1e-10);
  rot_events_free(&rows.events);
}

/* A jump at a break sets it going; afterwards the resistance brings it to rest. */
static void jumps(void) {
  rot_incline_scene scene = sphere(0.0, 0.9, 0.02, 0.0, 0.0);
  const double breaks[] = {1.0, 2.0}, t[] = {1.0, 2.0, 9.0};
  scene.force = pulse;
  scene.n_breaks = 2;
  scene.breaks_s = breaks;
  table rows;
  ROT_CHECK(run(&scene, 3, t, 1e-11, ROT_METHOD_RK8PD, &rows) == ROT_OK);
  const double held = 9.8 * 0.2, v = (4.0 - held) / 1.4; /* 8 N on 2 kg for 1 s */
  ROT_CHECK_REL(rows.c[1][1], v, 1e-10);
  ROT_CHECK(rows.c[1][0] == 0.0 && rows.c[1][2] == 0.0 && rows.c[3][2] == 0.0);
  ROT_CHECK_EQ_INT((long)rows.events.count, 2);
  ROT_CHECK_REL(rows.events.time_s[1], 2.0 + v * 1.4 / held, 1e-10);
  ROT_CHECK_REL(rows.c[0][2], 0.5 * v + 0.5 * v * v * 1.4 / held, 1e-10);
  ROT_CHECK(rows.events.event[1] == ROT_EVENT_STICK);
  rot_events_free(&rows.events);
}

static rot_status nudge(double t, double x, double v, double *force, void *ctx) {
  (void)x, (void)v, (void)ctx;
  *force = t < 1.0 ? 0.0 : 0.2 * 19.6 * (1.0 + 5e-7);
  return ROT_OK;
}

/* Static friction and the rolling resistance hold the same force. A jump a little above it: to roll
 * would need more than the friction, so the body slides at once, and it does not turn, because
 * kinetic friction is less than the resistance. */
static void jumps_barely(void) {
  rot_incline_scene scene = sphere(0.0, 0.2, 0.02, 0.0, 0.0);
  const double breaks[] = {1.0}, t[] = {1.0, 2.0};
  scene.force = nudge;
  scene.n_breaks = 1;
  scene.breaks_s = breaks;
  table rows;
  ROT_CHECK(run(&scene, 2, t, 1e-11, ROT_METHOD_RK8PD, &rows) == ROT_OK);
  ROT_CHECK_REL(rows.c[1][1], 0.2 * 9.8 * (1.0 + 5e-7 - 0.8), 1e-10);
  ROT_CHECK(rows.c[2][1] == 0.0 && rows.c[3][1] == 0.0);
  ROT_CHECK_EQ_INT((long)rows.events.count, 1);
  ROT_CHECK(rows.events.event[0] == ROT_EVENT_SLIP);
  rot_events_free(&rows.events);
}

/* A row at the time of an event has the state after it. */
static void rows_at_events(void) {
  const rot_incline_scene scene = sphere(0.0, 0.2, 0.0, 7.0, 0.0);
  double t[] = {0.0, 3.0};
  table rows;
  ROT_CHECK(run(&scene, 2, t, 1e-9, ROT_METHOD_RK8PD, &rows) == ROT_OK);
  t[0] = rows.events.time_s[0];
  rot_events_free(&rows.events);
  ROT_CHECK(run(&scene, 2, t, 1e-9, ROT_METHOD_RK8PD, &rows) == ROT_OK);
  ROT_CHECK(rows.rolling[0] && rows.c[4][0] == 0.0 && rows.c[5][0] == 0.0);
  ROT_CHECK_REL(rows.c[1][0], 5.0, 1e-9); /* 7/1.4 */
  rot_events_free(&rows.events);
}

static rot_status fails(double t, double x, double v, double *force, void *ctx) {
  (void)x, (void)v, (void)ctx;
  *force = t < 1.0 ? 0.0 : NAN;
  return ROT_OK;
}

static void failures(void) {
  rot_incline_scene scene = sphere(20.0, 0.9, 0.0, 0.0, 0.0);
  const double t[] = {0.5, 0.9, 2.0}, before[] = {-1.0, 1.0};
  table rows;
  scene.force = fails;
  ROT_CHECK(run(&scene, 3, t, 1e-9, ROT_METHOD_NONE, &rows) != ROT_OK);
  ROT_CHECK(rows.info.rows_done == 2 && rows.info.time_s <= 1.1);
  rot_events_free(&rows.events);
  scene.force = NULL;
  ROT_CHECK(run(&scene, 2, before, 1e-9, ROT_METHOD_NONE, &rows) == ROT_EVALUE);
  ROT_CHECK(run(&scene, 0, t, 1e-9, ROT_METHOD_NONE, &rows) == ROT_OK);
}

static void choice(void) {
  rot_incline_scene scene = sphere(20.0, 0.9, 0.0, 0.0, 0.0);
  const rot_constraint *c = &rot_incline_constraint;
  const double t[] = {1.0};
  const rot_query query = {1, t, 1e-9, 0.0};
  ROT_CHECK((c->effects_of(&scene) & ~c->models[0].takes) == 0);
  ROT_CHECK(c->models[0].cost_s(&c->models[0], &scene, &query) <
            c->models[1].cost_s(&c->models[1], &scene, &query));
  scene.drag_n_s_per_m = 1.0;
  ROT_CHECK((c->effects_of(&scene) & ~c->models[0].takes) != 0);
  ROT_CHECK((c->effects_of(&scene) & ~c->models[1].takes) == 0);
}

/* The place may leave the range of doubles where the rates do not. */
static void check_range(void) {
  static table to;
  const double t[] = {1.0, 1e160};
  rot_incline_scene scene = sphere(0.0, 0.5, 0.0, 1e150, 1e150);
  const rot_status status = run(&scene, 2, t, 1e-9, ROT_METHOD_RK8PD, &to);
  ROT_CHECK_EQ_INT(status, ROT_ERANGE);
  rot_events_free(&to.events);
}

int main(void) {
  constant_forces();
  breaks_at_changes();
  quadratic_drag();
  linear_drag();
  breaks_loose();
  jumps();
  jumps_barely();
  rows_at_events();
  failures();
  choice();
  check_range();
  return rot_test_report("incline_ode");
}
