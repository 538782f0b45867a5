/* Does the reported error cover the true one? Random scenes for each model, judged by truth.h.
 *
 *   coverage [scenes per model] [seed] */
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "random.h"
#include "scene/axle/linear.h"
#include "scene/axle/bands.h"
#include "scene/axle/drag.h"
#include "scene/axle/forced.h"
#include "scene/axle/ode.h"
#include "scene/axle/oscillator.h"
#include "scene/axle/pendulum.h"
#include "scene/axle/skater.h"
#include "truth.h"

enum { ROWS = 16, KNOTS = 12, TERMS = 4, BREAKS = 64 };

/* A scene with room for all that it may hold. */
typedef struct sample {
  rot_axle_scene scene;
  double knot_s[KNOTS], knot_n_m[KNOTS], inertia_s[KNOTS], inertia_kg_m2[KNOTS], breaks[BREAKS];
  rot_term terms[TERMS];
  double x[TERMS][32];
  double span_s, rows_s[ROWS], accuracy;
} sample;

static int by_size(const void *a, const void *b) {
  const double x = *(const double *)a, y = *(const double *)b;
  return (x > y) - (x < y);
}

static void sorted(size_t n, double x[], double lo, double hi) {
  for (size_t i = 0; i < n; i++) x[i] = uniform(lo, hi);
  qsort(x, n, sizeof *x, by_size);
}

static void base(sample *s) {
  memset(s, 0, sizeof *s);
  rot_axle_params *p = &s->scene.linear;
  s->span_s = power(-1.0, 1.3);
  p->start_s = chance(0.5) ? 0.0 : uniform(-3.0, 3.0);
  p->inertia_kg_m2 = power(-2.0, 1.0);
  p->theta0_rad = chance(0.3) ? 0.0 : uniform(-3.0, 3.0);
  p->omega0_rad_per_s = chance(0.3) ? 0.0 : either(power(-1.0, 1.0));
  p->torque.time_s = s->knot_s;
  p->torque.torque_n_m = s->knot_n_m;
  s->scene.terms = s->terms;
  s->scene.inertia_time_s = s->inertia_s;
  s->scene.inertia_kg_m2 = s->inertia_kg_m2;
  s->scene.breaks_s = s->breaks;
  sorted(ROWS, s->rows_s, p->start_s, p->start_s + s->span_s);
}

/* Torque that moves the body by some rad/s in the span. */
static double torque_size(const sample *s) {
  return s->scene.linear.inertia_kg_m2 * power(-1.0, 1.0) / fmin(s->span_s, 1.0);
}

static void viscous(sample *s, double lo, double hi) {
  s->scene.viscous_n_m_s = power(lo, hi) * s->scene.linear.inertia_kg_m2 / s->span_s;
}

static void line_knots(sample *s) {
  rot_torque *torque = &s->scene.linear.torque;
  torque->n = 2 + (size_t)uniform(0.0, KNOTS - 2);
  sorted(torque->n, s->knot_s, s->scene.linear.start_s - 0.2 * s->span_s,
         s->scene.linear.start_s + 1.2 * s->span_s);
  for (size_t i = 0; i < torque->n; i++) s->knot_n_m[i] = either(torque_size(s));
}

static void step_knots(sample *s) {
  rot_torque *torque = &s->scene.linear.torque;
  const size_t steps = 1 + (size_t)uniform(0.0, KNOTS / 2 - 1);
  double at[KNOTS];
  sorted(steps, at, s->scene.linear.start_s, s->scene.linear.start_s + s->span_s);
  torque->before_n_m = chance(0.3) ? 0.0 : either(torque_size(s));
  double value = torque->before_n_m;
  for (size_t i = 0; i < steps; i++) {
    s->knot_s[2 * i] = s->knot_s[2 * i + 1] = at[i];
    s->knot_n_m[2 * i] = value;
    value = chance(0.3) ? 0.0 : either(torque_size(s));
    s->knot_n_m[2 * i + 1] = value;
  }
  torque->after_n_m = value;
  torque->n = 2 * steps;
}

static void add_term(sample *s, rot_term_kind kind, size_t length) {
  rot_term *term = &s->terms[s->scene.n_terms];
  *term = (rot_term){kind, -INFINITY, INFINITY, length, s->x[s->scene.n_terms]};
  s->scene.n_terms++;
}

static double *last_x(sample *s) { return s->x[s->scene.n_terms - 1]; }

static void sinusoid(sample *s) {
  add_term(s, ROT_TERM_SINUSOID, 3);
  double *x = last_x(s);
  x[0] = either(torque_size(s));
  x[1] = power(-1.0, 2.0) / s->span_s;
  x[2] = uniform(-3.0, 3.0);
}

static void window(sample *s) {
  rot_term *term = &s->terms[s->scene.n_terms - 1];
  if (chance(0.5)) return;
  term->from_s = s->scene.linear.start_s + uniform(-0.2, 0.5) * s->span_s;
  term->to_s = term->from_s + uniform(0.1, 1.0) * s->span_s;
}

static void any_time_term(sample *s) {
  const double which = uniform(0.0, 3.0);
  if (which < 1.0) {
    sinusoid(s);
    window(s);
  } else if (which < 2.0) {
    add_term(s, ROT_TERM_EXPONENTIAL, 3);
    double *x = last_x(s);
    x[0] = either(torque_size(s));
    x[1] = chance(0.2) ? -power(-1.0, 0.5) / s->span_s : power(-1.0, 1.5) / s->span_s;
    x[2] = s->scene.linear.start_s;
    window(s);
  } else {
    const size_t degree = (size_t)uniform(0.0, 6.0);
    add_term(s, ROT_TERM_POLYNOMIAL, 2 + 3 + 2 * (degree + 1));
    double *x = last_x(s);
    x[0] = 2.0;
    x[1] = (double)(degree + 1);
    x[2] = s->scene.linear.start_s + uniform(-0.2, 0.3) * s->span_s;
    x[3] = x[2] + uniform(0.1, 0.5) * s->span_s;
    x[4] = x[3] + uniform(0.1, 0.5) * s->span_s;
    for (size_t i = 0; i < 2 * (degree + 1); i++) {
      x[5 + i] = either(torque_size(s)) / pow(s->span_s, (double)(i % (degree + 1)));
    }
  }
}

static void spring(sample *s, rot_term_kind kind) {
  add_term(s, kind, 2);
  double *x = last_x(s);
  const double omega = power(-0.5, 1.3) / fmin(s->span_s, 5.0);
  x[0] = s->scene.linear.inertia_kg_m2 * omega * omega;
  x[1] = chance(0.5) ? 0.0 : uniform(-2.0, 2.0);
}

static void curve(sample *s) {
  const size_t n = 2 + (size_t)uniform(0.0, 6.0);
  add_term(s, ROT_TERM_CURVE, 1 + 2 * n);
  double *x = last_x(s);
  x[0] = (double)n;
  sorted(n, x + 1, -5.0, 10.0);
  const double top = torque_size(s);
  for (size_t i = 0; i < n; i++)
    x[1 + n + i] = top * (1.0 - (double)i / (double)n * uniform(0.5, 1.5));
}

static void friction(sample *s) {
  s->scene.coulomb_n_m = torque_size(s) * uniform(0.05, 1.0);
  s->scene.static_n_m = s->scene.coulomb_n_m * (chance(0.5) ? 1.0 : uniform(1.0, 1.5));
}

static void drag(sample *s, double lo, double hi) {
  s->scene.quadratic_n_m_s2 = power(lo, hi) * s->scene.linear.inertia_kg_m2 / s->span_s;
}

/* ---- scenes for each model ------------------------------------------------------------------- */

static void free_scene(sample *s) { base(s); }

static void linear_scene(sample *s) {
  base(s);
  line_knots(s);
  viscous(s, -3.0, 2.5);
  if (chance(0.1)) s->scene.viscous_n_m_s *= chance(0.5) ? 0.0 : -0.02;
}

static void forced_scene(sample *s) {
  base(s);
  if (chance(0.5)) line_knots(s);
  viscous(s, -3.0, 2.3);
  if (chance(0.2)) s->scene.viscous_n_m_s *= chance(0.5) ? 0.0 : -0.02;
  do {
    any_time_term(s);
  } while (s->scene.n_terms < TERMS && chance(0.5));
}

static void drag_scene(sample *s) {
  base(s);
  step_knots(s);
  if (chance(0.7)) viscous(s, -3.0, 1.5);
  if (chance(0.8)) drag(s, -3.0, 1.5);
  if (chance(0.5)) friction(s);
}

static void bands_scene(sample *s) {
  base(s);
  if (chance(0.8)) line_knots(s);
  viscous(s, -3.0, 1.5);
  if (chance(0.5)) curve(s);
  if (chance(0.7)) friction(s);
}

static void oscillator_scene(sample *s) {
  base(s);
  spring(s, ROT_TERM_SPRING);
  if (chance(0.5)) line_knots(s);
  if (chance(0.5)) sinusoid(s);
  if (chance(0.7)) viscous(s, -3.0, 2.0);
}

static void pendulum_scene(sample *s) {
  base(s);
  spring(s, ROT_TERM_GRAVITY);
}

static void skater_scene(sample *s) {
  base(s);
  if (chance(0.7)) step_knots(s);
  s->scene.n_inertia = 2 + (size_t)uniform(0.0, KNOTS - 2);
  sorted(s->scene.n_inertia, s->inertia_s, s->scene.linear.start_s - 0.2 * s->span_s,
         s->scene.linear.start_s + 1.2 * s->span_s);
  for (size_t i = 0; i < s->scene.n_inertia; i++) {
    s->inertia_kg_m2[i] = s->scene.linear.inertia_kg_m2 * power(-0.7, 0.7);
  }
}

static void smooth_scene(sample *s) { /* what no closed form takes */
  base(s);
  if (chance(0.5)) line_knots(s);
  if (chance(0.5)) sinusoid(s);
  if (chance(0.5)) spring(s, ROT_TERM_GRAVITY);
  viscous(s, -3.0, 1.3);
  if (chance(0.5)) drag(s, -3.0, 1.0);
  if (chance(0.3)) friction(s);
  s->accuracy = power(-12.0, -3.0);
}

/* ---- the models ------------------------------------------------------------------------------ */

static rot_status run_free(const sample *s, const rot_axle_columns *out, rot_info *info) {
  return rot_axle_free(&s->scene.linear, ROWS, s->rows_s, out, NULL, info);
}
static rot_status run_linear(const sample *s, const rot_axle_columns *out, rot_info *info) {
  return rot_axle_linear(&s->scene.linear, ROWS, s->rows_s, out, NULL, info);
}
static rot_status integrate(const sample *s, int method, const rot_axle_columns *out,
                            rot_info *info) {
  const rot_axle_ode_options options = {s->accuracy, 1000000, method, 0.0};
  return rot_axle_integrate(&s->scene, &options, ROWS, s->rows_s, out, NULL, NULL, NULL, info);
}
static rot_status run_rk8pd(const sample *s, const rot_axle_columns *out, rot_info *info) {
  return integrate(s, 1, out, info);
}
static rot_status run_radau(const sample *s, const rot_axle_columns *out, rot_info *info) {
  return integrate(s, 2, out, info);
}
#define EXACT(name)                                                                                \
  static rot_status run_##name(const sample *s, const rot_axle_columns *out, rot_info *info) {     \
    return rot_axle_##name(&s->scene, ROWS, s->rows_s, out, NULL, NULL, info);                     \
  }
EXACT(forced)
EXACT(drag)
EXACT(bands)
EXACT(oscillator)
EXACT(pendulum)
EXACT(skater)

static const struct {
  const char *name;
  void (*make)(sample *);
  rot_status (*run)(const sample *, const rot_axle_columns *, rot_info *);
} contestants[] = {
    {"axle_free", free_scene, run_free},
    {"axle_linear", linear_scene, run_linear},
    {"axle_skater", skater_scene, run_skater},
    {"axle_drag", drag_scene, run_drag},
    {"axle_forced", forced_scene, run_forced},
    {"axle_oscillator", oscillator_scene, run_oscillator},
    {"axle_pendulum", pendulum_scene, run_pendulum},
    {"axle_bands", bands_scene, run_bands},
    {"axle_rk8pd", smooth_scene, run_rk8pd},
    {"axle_radau", smooth_scene, run_radau},
};

static void finish(sample *s) {
  rot_axle_scene *scene = &s->scene;
  size_t n = 0;
  scene->linear.viscous_n_m_s = scene->viscous_n_m_s + scene->motor_n_m_s;
  if (scene->n_inertia)
    scene->linear.inertia_kg_m2 = rot_axle_scene_inertia(scene, scene->linear.start_s);
  for (size_t i = 0; i < scene->linear.torque.n; i++) s->breaks[n++] = s->knot_s[i];
  for (size_t i = 0; i < scene->n_inertia; i++) s->breaks[n++] = s->inertia_s[i];
  for (size_t i = 0; i < scene->n_terms; i++) {
    const rot_term *term = &s->terms[i];
    if (isfinite(term->from_s)) s->breaks[n++] = term->from_s;
    if (isfinite(term->to_s)) s->breaks[n++] = term->to_s;
    if (term->kind == ROT_TERM_POLYNOMIAL) {
      for (size_t j = 0; j <= (size_t)term->x[0]; j++) s->breaks[n++] = term->x[2 + j];
    }
  }
  qsort(s->breaks, n, sizeof *s->breaks, by_size);
  size_t kept = 0;
  for (size_t i = 0; i < n; i++) {
    if (kept == 0 || s->breaks[i] > s->breaks[kept - 1]) s->breaks[kept++] = s->breaks[i];
  }
  scene->n_breaks = kept;
}

static double median(size_t n, double x[]) {
  if (n == 0) return NAN;
  qsort(x, n, sizeof *x, by_size);
  return x[n / 2];
}

int main(int argc, char **argv) {
  const long scenes = argc > 1 ? atol(argv[1]) : 1000;
  const uint64_t seed = argc > 2 ? (uint64_t)atoll(argv[2]) : 20;
  const char *only = argc > 3 ? argv[3] : NULL;
  double *ratio = malloc((size_t)scenes * sizeof *ratio);
  int bad = 0;
  long all = 0, silent = 0;
  printf("| model | scenes | covered | true error, median | true error, worst | reported / true, "
         "median |\n|---|---|---|---|---|---|\n");
  for (size_t k = 0; k < sizeof contestants / sizeof *contestants; k++) {
    if (only && strcmp(only, contestants[k].name)) continue;
    long judged = 0, covered = 0;
    size_t ratios = 0, errors = 0;
    double worst = 0.0, *error = malloc((size_t)scenes * sizeof *error);
    state = seed * 0x9E3779B97F4A7C15u + 1;
    for (long i = 0; i < scenes; i++) {
      static sample s;
      double c[7][ROWS], theta_max, omega_max;
      quad theta[ROWS], omega[ROWS];
      contestants[k].make(&s);
      finish(&s);
      const rot_axle_columns out = {c[0], c[1], c[2], c[3], c[4], c[5], c[6]};
      rot_info info;
      const uint64_t before = state;
      const rot_status status = contestants[k].run(&s, &out, &info);
      if (truth_run(&s.scene, ROWS, s.rows_s, theta, omega, &theta_max, &omega_max)) {
        fprintf(stderr, "%s %ld: no truth\n", contestants[k].name, i);
        continue;
      }
      judged++;
      if (status != ROT_OK) {
        fprintf(stderr, "%s %ld: %s\n", contestants[k].name, i, rot_status_text(status));
        continue;
      }
      double e_theta = 0.0, e_omega = 0.0;
      for (int j = 0; j < ROWS; j++) {
        e_theta = fmax(e_theta, (double)(c[0][j] > (double)theta[j] ? (quad)c[0][j] - theta[j]
                                                                    : theta[j] - (quad)c[0][j]));
        e_omega = fmax(e_omega, (double)(c[1][j] > (double)omega[j] ? (quad)c[1][j] - omega[j]
                                                                    : omega[j] - (quad)c[1][j]));
      }
      /* The truth itself is good to some 1e-28 of the motion's size. */
      const int held = e_theta <= info.measure[ROT_THETA].error + 1e-26 * theta_max &&
                       e_omega <= info.measure[ROT_OMEGA].error + 1e-26 * omega_max;
      covered += held;
      if (!held && getenv("COVERAGE_SHOW")) {
        fprintf(stderr, "%s %ld: theta %.3g of %.3g, omega %.3g of %.3g (accuracy %.2g)\n",
                contestants[k].name, i, e_theta, info.measure[ROT_THETA].error, e_omega,
                info.measure[ROT_OMEGA].error, s.accuracy);
      }
      const double relative = fmax(theta_max > 0.0 ? e_theta / theta_max : 0.0,
                                   omega_max > 0.0 ? e_omega / omega_max : 0.0);
      /* trajectory() warns where the figure exceeds the accuracy asked. */
      const double asked = s.accuracy > 0.0 ? s.accuracy : 1e-9, figure = rot_info_error(&info);
      const int missed = e_theta > 10.0 * info.measure[ROT_THETA].error ||
                         e_omega > 10.0 * info.measure[ROT_OMEGA].error;
      silent += missed && relative > 10.0 * asked && figure <= asked;
      worst = fmax(worst, relative);
      error[errors++] = relative;
      if (relative > 0.0) ratio[ratios++] = rot_info_error(&info) / relative;
      state = before;
      uniform(0.0, 1.0);
    }
    printf("| `%s` | %ld | %.1f %% | %.1e | %.1e | %.3g |\n", contestants[k].name, judged,
           judged ? 100.0 * (double)covered / (double)judged : 0.0, median(errors, error), worst,
           median(ratios, ratio));
    fflush(stdout);
    all += judged;
    const int estimate = k + 2 >= sizeof contestants / sizeof *contestants;
    if ((double)covered < (estimate ? 0.95 : 1.0) * (double)judged) bad = 1;
    free(error);
  }
  free(ratio);
  printf("scenes: %ld judged, %ld silent; seed %llu\n", all, silent, (unsigned long long)seed);
  return bad || silent > 0;
}
