#include "scene/free/models.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

#include "scene/free/batch.h"
#include "scene/free/exact.h"
#include "scene/free/gyrostat.h"
#include "scene/free/inputs.h"
#include "scene/free/ledger.h"
#include "scene/free/ode.h"
#include "scene/free/rotors.h"
#include "scene/free/scene.h"
#include "scene/free/steps.h"

enum { TORQUE = 1, LAW = 2, DAMPING = 4, ROTORS = 8, MOTORS = 16 };

static const rot_effect effects[] = {{"torque", "a torque", 0, 0},
                                     {"law", "a torque function", 0, 0},
                                     {"damping", "damping", 0, 0},
                                     {"rotors", "rotors", 0, 0},
                                     {"motors", "rotors with motor torques", 0, ROTORS}};

int rot_free_has_motors(const rot_free_params *p) {
  int found = p->motors != NULL;
  for (size_t k = 0; k < p->n_rotors; k++) {
    found |= !p->rotors[k].driven && (p->rotors[k].torque != 0.0 || p->rotors[k].n_knots);
  }
  return found;
}

static unsigned effects_of(const void *of) {
  const rot_free_params *p = of;
  const int constant = p->torque[0] != 0.0 || p->torque[1] != 0.0 || p->torque[2] != 0.0;
  return (constant || p->n_knots ? TORQUE : 0u) | (p->law ? LAW : 0u) |
         (p->damping_per_s != 0.0 ? DAMPING : 0u) | (p->n_rotors ? ROTORS : 0u) |
         (rot_free_has_motors(p) ? MOTORS : 0u);
}

static double period_s(const void *scene) {
  return effects_of(scene) ? NAN : rot_free_period(scene, NULL);
}

const char *rot_free_refuses_exact(const void *scene, const rot_query *query) {
  (void)query;
  return rot_free_not_exact(scene);
}

const char *rot_free_refuses_gyrostat(const void *scene, const rot_query *query) {
  (void)query;
  return rot_free_not_gyrostat(scene);
}

const char *rot_free_refuses_ode(const void *scene, const rot_query *query) {
  (void)query;
  return rot_free_not_integrated(scene);
}

const char *rot_free_refuses_split(const void *scene, const rot_query *query) {
  const char *why = rot_free_refuses_ode(scene, query);
  return why ? why : rot_free_not_split(scene);
}

/* model->seconds: per run, per row. */
double rot_free_exact_s(const rot_model *model, const void *scene, const rot_query *query) {
  (void)scene;
  return model->seconds[0] + (double)query->n * model->seconds[1];
}

/* The number of steps is proportional to the angle turned; damping within the span adds some.
 * model->seconds: steps per rad at accuracy 1, power of the accuracy, per step, per row. */
double rot_free_integrated_s(const rot_model *model, const void *of, const rot_query *query) {
  const rot_free_params *p = of;
  const double *s = model->seconds, rows = (double)query->n;
  const double from = query->n ? fmin(p->start_s, query->time_s[0]) : p->start_s;
  const double to = query->n ? fmax(p->start_s, query->time_s[query->n - 1]) : p->start_s;
  double rate = 0.0;
  rot_free_rotors rotors;
  for (int i = 0; i < 3; i++) rate = hypot(rate, p->omega0_rad_per_s[i]);
  if (p->n_rotors && !rot_free_rotors_begin(p, &rotors)) rate += rotors.size / rotors.min;
  const double calls = p->law || p->motors ? query->law_s : 0.0;
  const double turns = (rate + fabs(p->damping_per_s)) * (to - from);
  const double steps = 10.0 + 3.0 * (double)p->n_breaks +
                       s[0] * pow(fmax(query->accuracy, model->promise), s[1]) * fmin(turns, 1e300);
  return 10e-6 + steps * (s[2] + 20.0 * calls) + rows * s[3];
}

/* Steps of the run and of one with half the step: three times. model->seconds: per step. */
double rot_free_steps_s(const rot_model *model, const void *of, const rot_query *query) {
  const rot_free_params *p = of;
  const double from = query->n ? fmin(p->start_s, query->time_s[0]) : p->start_s;
  const double to = query->n ? fmax(p->start_s, query->time_s[query->n - 1]) : p->start_s;
  const rot_method method = /* half as many steps for the splitting */
      strstr(model->id, "split") ? ROT_METHOD_SPLIT : ROT_METHOD_RK4;
  const double steps = 3.0 * ((to - from) / rot_free_default_step(p, method, to - from));
  const double calls = p->law || p->motors ? 4.0 * query->law_s : 0.0;
  return 10e-6 + fmin(steps, 1e300) * (model->seconds[0] + calls) + (double)query->n * 1e-6;
}

static const rot_model models[ROT_FREE_MODELS] = {
    {"free_exact",
     DAMPING,
     ROT_BOUND,
     1e-14,
     ROT_FREELY,
     "no torque: closed form by elliptic functions",
     rot_free_refuses_exact,
     rot_free_exact_s,
     {6e-6, 0.8e-6, 0.0, 0.0}},
    {"free_gyrostat",
     ROTORS,
     ROT_BOUND,
     1e-14,
     ROT_FREELY,
     "rotors along a principal axis: closed form",
     rot_free_refuses_gyrostat,
     rot_free_exact_s,
     {30e-6, 0.8e-6, 0.0, 0.0}},
    ROT_FREE_INTEGRATED("free_", TORQUE | LAW | DAMPING | ROTORS | MOTORS),
    ROT_FREE_STEPS("free_", TORQUE | LAW | DAMPING | ROTORS | MOTORS, ROTORS),
};

static const rot_column_of columns[] = {ROT_FREE_TABLE(ROTORS)};
static const rot_balance balances[] = {ROT_FREE_BALANCES_ABOUT("the centre of mass")};
static const rot_balance_term terms[] = {ROT_FREE_TERMS_WITH(ROTORS)};
static const rot_derived derived[] = {ROT_FREE_DERIVED};

const rot_constraint rot_free_constraint = {
    .id = "free",
    .measures = rot_free_measures,
    .n_effects = ROT_COUNT(effects),
    .n_models = ROT_COUNT(models),
    .effects = effects,
    .models = models,
    .effects_of = effects_of,
    ROT_MADE_BY("scene_free", rot_free_inputs, ROT_FREE_INPUTS, rot_free_build, derived,
                ROT_COUNT(derived)),
    .n_columns = ROT_COUNT(columns),
    .columns = columns,
    .runs = rot_free_runs,
    .run_tells = 3u, /* the closed forms */
    .scene_size = sizeof(rot_free_built),
    .start_s = rot_free_start,
    .events = 1u << ROT_EVENT_FLIP | 1u << ROT_EVENT_HIGHEST | 1u << ROT_EVENT_LOWEST,
    .n_flows = ROT_FREE_FLOWS,
    .flows = rot_free_flow_names,
    .n_balances = ROT_COUNT(balances),
    .balances = balances,
    .n_kept = ROT_FREE_KEPT,
    .n_terms = ROT_COUNT(terms),
    .terms = terms,
    .audit = rot_free_audit,
    .explain = rot_free_explain,
    .conserved = rot_free_conserved,
    .time_scales = rot_free_time_scales,
    .shows = rot_free_shows,
    .period_s = period_s,
    .batches = rot_free_batches,
};
