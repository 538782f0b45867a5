/* Equations of the caller's own against closed forms: an oscillator, a decay, a Kepler orbit, a
 * stiff van der Pol oscillator; steps of fixed length; refusals; laws that fail. */
#include "scene/equations/equations.h"

#include "scene_kit.h"

static const double pi = 3.14159265358979323846;

typedef struct law {
  size_t n;
  void (*f)(double t, const double y[], double rate[]);
  size_t calls, fails_at; /* 0: never */
} law;

static rot_status called(const double argument[], double value[], void *ctx) {
  law *l = ctx;
  if (++l->calls == l->fails_at) return ROT_EUNWIND;
  l->f(argument[0], argument + 1, value);
  return ROT_OK;
}

static kit *equations_of(law *l, const double start[]) {
  kit *k = kit_new("scene_equations");
  k->given[kit_input(k, "f")] = (rot_given){.is = ROT_INPUT_LAW, .law = {called, l, 0.0}};
  kit_numbers(k, "start", l->n, start);
  return k;
}

static void swing(double t, const double y[], double rate[]) {
  (void)t;
  rate[0] = y[1];
  rate[1] = -y[0];
}

static void fade(double t, const double y[], double rate[]) {
  (void)t;
  rate[0] = -y[0];
}

static void orbit(double t, const double y[], double rate[]) {
  const double r = hypot(y[0], y[1]), pull = -1.0 / (r * r * r);
  (void)t;
  rate[0] = y[2];
  rate[1] = y[3];
  rate[2] = pull * y[0];
  rate[3] = pull * y[1];
}

static void relax(double t, const double y[], double rate[]) {
  (void)t;
  rate[0] = y[1];
  rate[1] = 1000.0 * (1.0 - y[0] * y[0]) * y[1] - y[0];
}

/* Two equal pendulums of 1 m, one below the other. */
static void fling(double t, const double y[], double rate[]) {
  const double bend = y[0] - y[1], c = cos(bend), s = sin(bend), mass = 3.0 - cos(2.0 * bend);
  const double u = y[2] * y[2], v = y[3] * y[3], g = 9.8;
  (void)t;
  rate[0] = y[2];
  rate[1] = y[3];
  rate[2] = -(g * (2.0 * sin(y[0]) + sin(y[0] - 2.0 * y[1])) + 2.0 * s * (v + u * c)) / mass;
  rate[3] = 2.0 * s * (2.0 * u + 2.0 * g * cos(y[0]) + v * c) / mass;
}

static double at(const motion *m, size_t state, size_t row) { return m->column[state][row]; }

static void check_row(const motion *m, size_t row, size_t n, const double want[], double accuracy) {
  for (size_t k = 0; k < n; k++) {
    const double off = fabs(at(m, k, row) - want[k]);
    ROT_CHECK(off <= m->out.info.measure[k].error + 4e-16 * fabs(want[k]));
    ROT_CHECK(m->out.info.measure[k].error <= 3.0 * accuracy * m->out.info.measure[k].largest);
  }
}

static void closed_forms(void) {
  static const double accuracies[] = {1e-6, 1e-9, 1e-12};
  static const double time_s[] = {-3.0, 0.0, 1.0, 20.0};
  for (size_t a = 0; a < 3; a++) {
    law l = {2, swing, 0, 0};
    kit *k = equations_of(&l, (const double[]){1.0, 0.0});
    motion m = kit_run(k, NULL, accuracies[a], 4, time_s);
    ROT_CHECK(m.end == ROT_RUN_DONE && m.out.info.status == ROT_OK);
    ROT_CHECK(m.out.info.n_measures == 2 && m.out.info.method == ROT_METHOD_RK8PD);
    for (size_t i = 0; i < 4; i++) {
      check_row(&m, i, 2, (const double[]){cos(time_s[i]), -sin(time_s[i])}, accuracies[a]);
    }
    motion_free(&m);
    kit_free(k);
    law decay = {1, fade, 0, 0};
    k = equations_of(&decay, (const double[]){1.0});
    m = kit_run(k, NULL, accuracies[a], 4, time_s);
    for (size_t i = 0; i < 4; i++) {
      check_row(&m, i, 1, (const double[]){exp(-time_s[i])}, accuracies[a]);
    }
    motion_free(&m);
    kit_free(k);
  }
}

/* Of both runs, that asked for and that of Radau IIA beside it, no call is lost. */
static void counted(void) {
  static const double time_s[] = {2.0};
  law l = {2, swing, 0, 0};
  kit *k = equations_of(&l, (const double[]){1.0, 0.0});
  kit_number(k, "positions", 1.0);
  motion m = kit_run(k, "equations_rk8pd", 1e-9, 1, time_s);
  ROT_CHECK(l.calls > 100 && m.out.info.rhs_calls > 100 && m.out.info.rhs_calls <= l.calls);
  printf("equations: %zu calls, %zu counted\n", l.calls, m.out.info.rhs_calls);
  motion_free(&m);
  kit_free(k);
}

static void an_orbit(void) {
  const double e = 0.9, fast = sqrt((1.0 + e) / (1.0 - e));
  const double start[] = {1.0 - e, 0.0, 0.0, fast}, far[] = {-1.0 - e, 0.0, 0.0, -1.0 / fast};
  const double time_s[] = {pi, 2.0 * pi};
  law l = {4, orbit, 0, 0};
  kit *k = equations_of(&l, start);
  motion m = kit_run(k, NULL, 1e-9, 2, time_s);
  check_row(&m, 0, 4, far, 1e-9);
  check_row(&m, 1, 4, start, 1e-9);
  motion_free(&m);
  kit_free(k);
}

/* Mazzia & Magherini, Test Set for Initial Value Problem Solvers 2.4 (2008), problem VDPOL, in the
 * time of the unscaled equation. A figure may be too large, never too small. */
static void stiff(void) {
  static const double accuracies[] = {1e-6, 1e-8, 1e-9, 1e-10};
  static const double want[] = {1.706167732170483, -0.8928097010247975e-3};
  for (size_t a = 0; a < 4; a++) {
    law l = {2, relax, 0, 0};
    kit *k = equations_of(&l, (const double[]){2.0, 0.0});
    motion m = kit_run(k, NULL, accuracies[a], 1, (const double[]){2000.0});
    ROT_CHECK(m.out.info.method == ROT_METHOD_RADAU);
    for (size_t s = 0; s < 2; s++) {
      ROT_CHECK(fabs(at(&m, s, 0) - want[s]) <= m.out.info.measure[s].error + 2e-15);
    }
    ROT_CHECK(m.out.error <= 1e-5);
    motion_free(&m);
    kit_free(k);
  }
}

/* A motion that begins in the rounding of its rates ends, and soon. */
static void unstable(double t, const double y[], double rate[]) {
  (void)t;
  rate[0] = y[1];
  rate[1] = -9.81 * sin(y[0]);
}

static void balanced(void) {
  law l = {2, unstable, 0, 0};
  kit *k = equations_of(&l, (const double[]){pi, 0.0});
  motion m = kit_run(k, NULL, 1e-9, 1, (const double[]){12.0});
  ROT_CHECK(m.out.info.status == ROT_OK && l.calls < 100000);
  motion_free(&m);
  kit_free(k);
}

static void fixed_steps(void) {
  law l = {2, swing, 0, 0};
  kit *k = equations_of(&l, (const double[]){1.0, 0.0});
  ROT_CHECK(kit_build(k) == ROT_OK);
  const rot_query query = {0, NULL, 1.0, 0.0};
  rot_candidate c;
  const rot_model *model = rot_choice_model(k->c, "equations_semi_implicit");
  rot_choice_judge(k->c, model, k->scene, &query, &c);
  ROT_CHECK(!c.applies && strstr(c.why_not, "positions") != NULL);
  kit_number(k, "positions", 1.0);
  motion m = kit_run(k, "equations_semi_implicit", 1.0, 1, (const double[]){2.0});
  double x = 1.0, v = 0.0;
  for (int i = 0; i < 1000; i++) {
    v -= 2e-3 * x;
    x += 2e-3 * v;
  }
  ROT_CHECK(fabs(at(&m, 0, 0) - x) < 1e-12 && fabs(at(&m, 1, 0) - v) < 1e-12);
  motion_free(&m);
  m = kit_run(k, "equations_euler", 1.0, 1, (const double[]){2.0});
  x = 1.0, v = 0.0;
  for (int i = 0; i < 1000; i++) {
    const double was = x;
    x += 2e-3 * v;
    v -= 2e-3 * was;
  }
  ROT_CHECK(fabs(at(&m, 0, 0) - x) < 1e-12 && fabs(at(&m, 1, 0) - v) < 1e-12);
  motion_free(&m);
  kit_free(k);
}

static void refusals(void) {
  law l = {2, swing, 0, 0};
  double many[17] = {0.0};
  kit *k = equations_of(&l, many);
  kit_number(k, "positions", 3.0);
  ROT_CHECK(kit_refuses(k, "positions", "1 to 2"));
  kit_number(k, "positions", 1.5);
  ROT_CHECK(kit_refuses(k, "positions", "1 to 2"));
  kit_numbers(k, "positions", 2, (const double[]){1.0, 2.0});
  ROT_CHECK(kit_refuses(k, "positions", "no position"));
  kit_unset(k, "positions");
  kit_numbers(k, "start", 17, many);
  ROT_CHECK(kit_refuses(k, "start", "1 to 16"));
  kit_unset(k, "f");
  ROT_CHECK(kit_refuses(k, "f", "missing"));
  kit_free(k);
}

/* A law that ends the run, wherever it does. */
static void stops(void) {
  static const char *const models[] = {"equations_rk8pd", "equations_radau", "equations_euler",
                                       "equations_semi_implicit", "equations_rk4"};
  for (size_t i = 0; i < 5; i++) {
    for (size_t fails = 1; fails < 400; fails += 7) {
      law l = {2, swing, 0, fails};
      kit *k = equations_of(&l, (const double[]){1.0, 0.0});
      kit_number(k, "positions", 1.0);
      motion m = kit_run(k, models[i], 1e-9, 1, (const double[]){2.0});
      ROT_CHECK(m.out.info.status == ROT_EUNWIND || l.calls < fails);
      ROT_CHECK(l.calls <= fails);
      motion_free(&m);
      kit_free(k);
    }
  }
}

/* Where a rounding grows to the size of the motion, more steps say no more: the run ends soon, and
 * nothing is known of its end. It took 1.8e7 calls. */
static void chaos(void) {
  law l = {4, fling, 0, 0};
  kit *k = equations_of(&l, (const double[]){2.5, 2.0, 0.0, 0.0});
  const double soon = 2.0, late = 120.0;
  motion m = kit_run(k, NULL, 1e-9, 1, &soon);
  ROT_CHECK(m.end == ROT_RUN_DONE && m.out.error < 1e-9);
  motion_free(&m);
  l.calls = 0;
  m = kit_run(k, NULL, 1e-9, 1, &late);
  ROT_CHECK(m.end == ROT_RUN_DONE && m.out.info.status == ROT_OK && m.out.error >= 1.0);
  ROT_CHECK(l.calls < 3000000);
  motion_free(&m);
  kit_free(k);
}

int main(void) {
  closed_forms();
  chaos();
  counted();
  an_orbit();
  stiff();
  balanced();
  fixed_steps();
  refusals();
  stops();
  return rot_test_report("equations");
}
