#include "scene/axle/models.h"

#include <math.h>
#include <string.h>

#include "scene/axle/batch.h"
#include "scene/axle/period.h"
#include "scene/axle/balances.h"
#include "scene/axle/drop.h"
#include "scene/axle/forced.h"
#include "engine/ode/fixed.h"
#include "scene/axle/inputs.h"
#include "scene/axle/time_scales.h"
#include "scene/axle/runs.h"
#include "ground/search.h"

/* ---- effects --------------------------------------------------------------------------------- */

static const rot_effect effects[] = {
#define X(code, name, words, droppable, implies) {name, words, droppable, implies},
    ROT_AXLE_EFFECT_LIST(X)
#undef X
};

static unsigned effects_of(const void *scene) { return rot_axle_effects(scene); }

/* ---- reasons against a scene ----------------------------------------------------------------- */

static size_t count_kind(const rot_axle_scene *scene, rot_term_kind kind) {
  size_t n = 0;
  for (size_t i = 0; i < scene->n_terms; i++) n += scene->terms[i].kind == kind;
  return n;
}

static int all_always(const rot_axle_scene *scene) {
  for (size_t i = 0; i < scene->n_terms; i++) {
    if (scene->terms[i].from_s != -INFINITY || scene->terms[i].to_s != INFINITY) return 0;
  }
  return 1;
}

static const char *backward(const rot_axle_scene *scene, const rot_query *query) {
  const int before = query->n && query->time_s[0] < scene->linear.start_s;
  return before ? "it cannot run backwards from the scene's start" : NULL;
}

static const char *not_pendulum(const void *of, const rot_query *query) {
  const rot_axle_scene *scene = of;
  (void)query;
  if (count_kind(scene, ROT_TERM_GRAVITY) != 1) return "it needs gravity, and only one";
  return all_always(scene) ? NULL : "gravity must act at all times";
}

static const char *not_oscillator(const void *of, const rot_query *query) {
  const rot_axle_scene *scene = of;
  (void)query;
  if (count_kind(scene, ROT_TERM_SPRING) != 1) return "it needs a spring, and only one";
  for (size_t i = 0; i < scene->n_terms; i++) {
    if (scene->terms[i].kind == ROT_TERM_SPRING && !(scene->terms[i].x[0] > 0.0)) {
      return "the spring's stiffness must be greater than 0";
    }
  }
  return all_always(scene) ? NULL : "spring and sinusoids must act at all times";
}

static const char *not_forced(const void *of, const rot_query *query) {
  const rot_axle_scene *scene = of;
  (void)query;
  for (size_t i = 0; i < scene->n_terms; i++) {
    if (scene->terms[i].kind == ROT_TERM_POLYNOMIAL &&
        scene->terms[i].x[1] - 1.0 > rot_axle_forced_max_degree()) {
      return "it takes polynomials up to degree 16";
    }
  }
  return NULL;
}

static const char *not_drag(const void *of, const rot_query *query) {
  const rot_axle_scene *scene = of;
  if (scene->linear.viscous_n_m_s < 0.0) return "it takes no viscous coefficient below 0";
  return backward(scene, query);
}

static const char *not_bands(const void *of, const rot_query *query) {
  const rot_axle_scene *scene = of;
  if (count_kind(scene, ROT_TERM_CURVE) > 1) return "it takes one curve";
  if (!all_always(scene)) return "the curve must act at all times";
  return backward(scene, query);
}

static const char *not_integrated(const void *of, const rot_query *query) {
  const rot_axle_scene *scene = of;
  return scene->static_n_m != 0.0 ? backward(scene, query) : NULL;
}

/* ---- predicted times ------------------------------------------------------------------------- *
 *
 * Processor time of the core alone, 2.6 GHz, gcc -O2; bench/costs.R compares them with the
 * clock. */

static double between(size_t n, const double x[], double from, double to) {
  return n ? (double)(rot_lower_bound(n, x, to) - rot_upper_bound(n, x, from)) : 0.0;
}

/* Number of breaks between the first and last time, and this span. A complete list of the scene
 * also contains the knots. */
static double count_breaks(const rot_axle_scene *scene, const rot_query *query, double *span_s) {
  const rot_torque *torque = &scene->linear.torque;
  const double start = scene->linear.start_s;
  const double from = query->n ? fmin(start, query->time_s[0]) : start;
  const double to = query->n ? fmax(start, query->time_s[query->n - 1]) : start;
  if (span_s) *span_s = to - from;
  if (!(to > from)) return 0.0;
  return fmax(between(scene->n_breaks, scene->breaks_s, from, to),
              between(torque->n, torque->time_s, from, to) +
                  between(scene->n_inertia, scene->inertia_time_s, from, to));
}

/* model->seconds: per run, per row, per term and row, per break. */
static double closed_form_s(const rot_model *model, const void *of, const rot_query *query) {
  const rot_axle_scene *scene = of;
  const double *s = model->seconds;
  return s[0] + (double)query->n * (s[1] + s[2] * (double)scene->n_terms) +
         s[3] * count_breaks(scene, query, NULL);
}

/* seconds[1]: evenly spaced times, seconds[2]: others; decided by three of the times. */
static double linear_s(const rot_model *model, const void *of, const rot_query *query) {
  const double *s = model->seconds, *t = query->time_s;
  const size_t n = query->n, half = (n - 1) / 2;
  const int even = n > 2 && fabs(t[2 * half] - t[half] - (t[half] - t[0])) <=
                                1e-9 * (fabs(t[0]) + fabs(t[2 * half]));
  return s[0] + (double)n * (even ? s[1] : s[2]) + s[3] * count_breaks(of, query, NULL);
}

/* model->seconds: per run; per row and sinusoid or exponential; per row for the knots; per
 * break. */
static double forced_s(const rot_model *model, const void *of, const rot_query *query) {
  const rot_axle_scene *scene = of;
  const double *s = model->seconds;
  double row_s = 0.6 * s[1];
  for (size_t i = 0; i < scene->n_terms; i++) {
    const int powers = scene->terms[i].kind == ROT_TERM_POLYNOMIAL;
    row_s += powers ? s[1] * (0.6 + 0.5 * scene->terms[i].x[1]) : s[1];
  }
  if (scene->linear.torque.n || scene->linear.torque.after_n_m != 0.0) row_s += s[2];
  return s[0] + (double)query->n * row_s + s[3] * count_breaks(scene, query, NULL);
}

/* Rates of the motion. */
typedef struct rates {
  double swing_per_s; /* of persistent oscillations */
  double decay_per_s; /* of damping */
  double span_s;
  double breaks; /* number of breaks in the span */
} rates;

/* (scene, query) => rates by the kinds of the loads. */
static rates rates_of(const rot_axle_scene *scene, const rot_query *query) {
  const double inertia = scene->linear.inertia_kg_m2;
  const rot_torque *torque = &scene->linear.torque;
  rates r = {0.0, 0.0, 0.0, 0.0};
  r.breaks = count_breaks(scene, query, &r.span_s);
  double falling = fmax(0.0, scene->linear.viscous_n_m_s), pull = 0.0;
  double drive = fmax(fabs(torque->before_n_m), fabs(torque->after_n_m));
  for (size_t i = 0; i < scene->n_terms; i++) {
    const double *x = scene->terms[i].x;
    switch (scene->terms[i].kind) {
    case ROT_TERM_SINUSOID:
      drive += fabs(x[0]);
      r.swing_per_s = fmax(r.swing_per_s, fabs(x[1]));
      break;
    case ROT_TERM_EXPONENTIAL: /* ten decay times */
      r.swing_per_s = fmax(r.swing_per_s, fmin(fabs(x[1]), 10.0 / r.span_s));
      break;
    case ROT_TERM_SPRING: pull += fabs(x[0]); break;
    case ROT_TERM_GRAVITY: pull += 4.0 * fabs(x[0]); break; /* twice the steps of a spring */
    case ROT_TERM_CURVE:
      for (size_t j = 1, n = (size_t)x[0]; j < n; j++) {
        falling = fmax(falling, (x[n + j] - x[n + j + 1]) / (x[j + 1] - x[j]));
      }
      break;
    default: break;
    }
  }
  const double q = scene->quadratic_n_m_s2;
  const size_t knots = q > 0.0 ? torque->n : 0;
  for (size_t i = 0; i < knots; i++) drive = fmax(drive, fabs(torque->torque_n_m[i]));
  falling += 2.0 * fmax(q * fabs(scene->linear.omega0_rad_per_s), sqrt(q * drive));
  r.swing_per_s = fmax(r.swing_per_s, sqrt(pull / inertia));
  /* A law of the caller is unknown: assume some periods. */
  if (torque->call) r.swing_per_s = fmax(r.swing_per_s, 20.0 / fmax(r.span_s, 1e-300));
  r.decay_per_s = fmax(r.decay_per_s, falling / inertia);
  return r;
}

/* Steps of two runs, counted in the finer one: some at the start and at breaks; accuracy to a power
 * times the persistent oscillations or the first decay times. After these, stability limits an
 * explicit step to about 5 decay times; implicit steps grow. model->seconds: step rate, its power,
 * decay times, later steps. */
static double integrated_s(const rot_model *model, const void *of, const rot_query *query,
                           int implicit) {
  const rot_axle_scene *scene = of;
  const rates r = rates_of(scene, query);
  const double *s = model->seconds, n = (double)query->n, terms = (double)scene->n_terms;
  const double swings = r.swing_per_s * r.span_s;
  const double decays = fmin(r.decay_per_s * r.span_s, 1e300); /* finite, for comparisons */
  const double rate = s[0] * pow(fmax(query->accuracy, model->promise), s[1]);
  const double after = s[3] * fmax(0.0, implicit ? log10(decays) : decays - s[2]);
  const double steps = 8.0 + 2.0 * r.breaks + rate * fmax(swings, fmin(decays, s[2])) + after;
  const double law_s = scene->linear.torque.call ? query->law_s : 0.0;
  const double call_s = 40e-9 + 35e-9 * terms + law_s;
  const double row_s = implicit ? 1.2e-6 : 0.55e-6 + 70e-9 * terms;
  /* Collocation calls a law less often than the finer run. */
  const double calls = law_s > 0.0 && query->accuracy <= 1e-7 ? 13.0 : 20.4;
  return 5e-6 + 2e-6 * r.breaks + steps * (implicit ? 28.0 * call_s + 1.5e-6 : calls * call_s) +
         n * row_s + fmin(n, 64.0) * law_s;
}

static double rk8pd_s(const rot_model *model, const void *scene, const rot_query *query) {
  return integrated_s(model, scene, query, 0);
}

static double radau_s(const rot_model *model, const void *scene, const rot_query *query) {
  return integrated_s(model, scene, query, 1);
}

/* ---- models ---------------------------------------------------------------------------------- */

static double fixed_s(const rot_model *model, const void *of, const rot_query *query) {
  const rot_axle_scene *scene = of;
  rot_time_scales time_scales;
  rot_axle_time_scales_of_start(scene, &time_scales);
  return rot_fixed_cost_s(model, query, rot_axle_start_s(scene), scene->linear.torque.call != NULL,
                          &time_scales);
}

#define ALL ((1u << ROT_AXLE_EFFECTS) - 1u)

#define CLOSED ": closed form"

/* A reason fits on one line of 80 characters in the head of a trajectory. EXACT: a closed form; the
 * last four numbers are its cost. */
#define EXACT(id, takes, promise, why, why_not, cost_s, a, b, c, d)                                \
  {                                                                                                \
    id, (unsigned)(takes), ROT_BOUND, promise, 0, why, why_not, cost_s, { a, b, c, d }             \
  }

static const rot_model models[ROT_AXLE_MODELS] = {
    EXACT("axle_free", 0, 4e-16, "nothing acts about the axle: omega keeps its value", NULL,
          closed_form_s, 0.7e-6, 6.3e-9, 0.0, 0.0),
    /* About 20 roundings of the |terms| (measured: 4). Cancelling terms lose more: see the bound of
     * the run. */
    EXACT("axle_linear", ROT_AXLE_LINEAR_TAKES, 2.5e-15,
          "piecewise-linear torque, viscous resistance" CLOSED, NULL, linear_s, 0.8e-6, 1.7e-9,
          28e-9, 0.25e-6),
    EXACT("axle_skater", ROT_AXLE_SKATER_TAKES, 4e-15,
          "angular momentum changes by the torque alone" CLOSED, NULL, closed_form_s, 1.0e-6,
          0.1e-6, 0.0, 0.25e-6),
    EXACT("axle_drag", ROT_AXLE_DRAG_TAKES, 2e-14, "torque constant between its steps" CLOSED,
          not_drag, closed_form_s, 1.1e-6, 0.29e-6, 0.0, 0.8e-6),
    EXACT("axle_forced", ROT_AXLE_FORCED_TAKES, 1e-14,
          "torques given over time, viscous resistance" CLOSED, not_forced, forced_s, 1.0e-6,
          0.17e-6, 0.24e-6, 0.55e-6),
    EXACT("axle_oscillator", ROT_AXLE_OSCILLATOR_TAKES, 1e-14, "the equation is linear" CLOSED,
          not_oscillator, closed_form_s, 1.2e-6, 0.1e-6, 0.14e-6, 0.21e-6),
    EXACT("axle_pendulum", ROT_AXLE_PENDULUM_TAKES, 1e-14, "gravity alone acts" CLOSED,
          not_pendulum, closed_form_s, 2.4e-6, 0.23e-6, 0.0, 0.0),
    EXACT("axle_bands", ROT_AXLE_BANDS_TAKES, 1e-13, "straight lines between known speeds" CLOSED,
          not_bands, closed_form_s, 1.8e-6, 0.42e-6, 0.0, 0.65e-6),
    {"axle_rk8pd",
     ALL,
     ROT_ADAPTIVE,
     1e-13,
     ROT_FREELY,
     "integrated, explicit steps: the motion is not stiff",
     not_integrated,
     rk8pd_s,
     {0.25, -1.0 / 8.5, 10.0, 0.39}},
    {"axle_radau",
     ALL,
     ROT_ADAPTIVE,
     1e-13,
     ROT_FREELY,
     "integrated, implicit steps: stiff, fast resistance",
     not_integrated,
     radau_s,
     {0.24, -1.0 / 9.0, 6.0, 2.0}},
    ROT_FIXED_MODELS("axle_", ALL, not_integrated, fixed_s),
};

static void drop(const void *scene, const rot_model *model, unsigned untaken,
                 const rot_query *query, double worst, rot_drop *to) {
  rot_axle_drop(scene, model, rot_axle_forms[model - models], untaken, query, worst, to);
}

static double period_s(const void *scene) { return rot_axle_period(scene).period_s; }

const rot_constraint rot_axle_constraint = {
    .id = "axle",
    .measures = rot_turning,
    .n_effects = sizeof effects / sizeof *effects,
    .n_models = sizeof models / sizeof *models,
    .effects = effects,
    .models = models,
    .effects_of = effects_of,
    .drop = drop,
    .n_makers = ROT_AXLE_MAKERS,
    .makers = rot_axle_makers,
    .n_columns = ROT_AXLE_ALL_COLUMNS,
    .columns = rot_axle_all_columns,
    .runs = rot_axle_runs,
    .scene_size = sizeof(rot_axle_built),
    .start_s = rot_axle_start_s,
    .events = 1u << ROT_EVENT_STICK | 1u << ROT_EVENT_SLIP | 1u << ROT_EVENT_REVERSE,
    .n_flows = ROT_AXLE_FLOWS,
    .flows = rot_axle_flow_names,
    .n_balances = ROT_AXLE_BALANCES,
    .balances = rot_axle_balances,
    .n_terms = ROT_AXLE_TERMS,
    .terms = rot_axle_terms,
    .audit = rot_axle_audit,
    .explain = rot_axle_explain,
    .term_words = rot_axle_term_words,
    .conserved = rot_axle_conserved,
    .time_scales = rot_axle_time_scales,
    .breaks = rot_axle_breaks,
    .shows = rot_axle_shows,
    .reduce = rot_axle_reduce,
    .period_s = period_s,
    .batches = rot_axle_batches,
};
