#include "scene/incline/models.h"

#include <math.h>
#include <stddef.h>

#include "engine/ode/fixed.h"
#include "scene/incline/batch.h"
#include "scene/incline/ledger.h"
#include "scene/incline/time_scales.h"
#include "scene/incline/runs.h"

static const rot_effect effects[] = {{"gravity", "gravity", 0, 0},
                                     {"friction", "friction of the contact", 0, 0},
                                     {"resistance", "rolling resistance", 0, 0},
                                     {"drag", "linear air drag", 0, 0},
                                     {"quadratic", "quadratic air drag", 0, 0},
                                     {"force", "a force along the slope", 0, 0}};

static unsigned effects_of(const void *of) {
  const rot_incline_scene *scene = of;
  const rot_incline_params *p = &scene->slope;
  return (p->gravity_m_per_s2 != 0.0 ? ROT_INCLINE_GRAVITY : 0u) |
         (p->mu_static != 0.0 ? ROT_INCLINE_FRICTION : 0u) |
         (p->arm_m != 0.0 ? ROT_INCLINE_RESISTANCE : 0u) |
         (scene->drag_n_s_per_m != 0.0 ? ROT_INCLINE_DRAG : 0u) |
         (scene->drag_n_s2_per_m2 != 0.0 ? ROT_INCLINE_QUADRATIC : 0u) |
         (scene->force ? ROT_INCLINE_FORCE : 0u);
}

static const char *not_before(const void *scene, const rot_query *query) {
  const int before =
      query->n && query->time_s[0] < ((const rot_incline_scene *)scene)->slope.start_s;
  return before ? "it cannot run backwards from the scene's start" : NULL;
}

/* model->seconds: per run, per row. */
static double cost_s(const rot_model *model, const void *scene, const rot_query *query) {
  (void)scene;
  return model->seconds[0] + (double)query->n * model->seconds[1];
}

/* Steps of one segment, times a few segments. Drag adds steps per decay time as in
 * scene/axle/models.c. model->seconds: step rate, its power, decay times, later steps; for explicit
 * and implicit steps. */
static double integrated_s(const rot_model *model, const void *of, const rot_query *query,
                           int implicit) {
  const rot_incline_scene *scene = of;
  const rot_incline_params *p = &scene->slope;
  const double *s = model->seconds, rows = (double)query->n;
  const double span = query->n ? query->time_s[query->n - 1] - p->start_s : 0.0;
  const double speed = fmax(fabs(p->v0_m_per_s), p->gravity_m_per_s2 * fabs(span));
  const double drag = (scene->drag_n_s_per_m + scene->drag_n_s2_per_m2 * speed) / p->mass_kg;
  const double decays = fmin(drag * fabs(span), 1e300);
  const double rate = s[0] * pow(fmax(query->accuracy, model->promise), s[1]);
  const double after = s[3] * fmax(0.0, implicit ? log10(decays) : decays - s[2]);
  const double steps = 30.0 + rate * fmin(decays, s[2]) + after;
  const double call_s = scene->force ? query->law_s + 0.1e-6 : 0.1e-6;
  return 15e-6 + steps * (implicit ? 50.0 * call_s + 10e-6 : 20.4 * call_s) +
         rows * (scene->force ? call_s + 1e-6 : 1e-6);
}

static double rk8pd_s(const rot_model *model, const void *scene, const rot_query *query) {
  return integrated_s(model, scene, query, 0);
}

static double radau_s(const rot_model *model, const void *scene, const rot_query *query) {
  return integrated_s(model, scene, query, 1);
}

static double fixed_s(const rot_model *model, const void *of, const rot_query *query) {
  rot_time_scales of_start;
  rot_incline_time_scales_of_start(of, &of_start);
  const rot_incline_scene *scene = of;
  return rot_fixed_cost_s(model, query, rot_incline_start(of), scene->force != NULL, &of_start);
}

static const rot_model models[ROT_INCLINE_MODELS] = {
    {"incline_exact",
     ROT_INCLINE_GRAVITY | ROT_INCLINE_FRICTION | ROT_INCLINE_RESISTANCE,
     ROT_BOUND,
     8e-15,
     ROT_FREELY,
     "all forces are constant between events: closed form",
     not_before,
     cost_s,
     {0.6e-6, 60e-9, 0.0, 0.0}},
    {"incline_rk8pd",
     ROT_INCLINE_EFFECTS,
     ROT_ADAPTIVE,
     1e-13,
     ROT_FREELY,
     "integrated, with explicit steps: it is not stiff",
     not_before,
     rk8pd_s,
     {0.25, -1.0 / 8.5, 10.0, 0.39}},
    {"incline_radau",
     ROT_INCLINE_EFFECTS,
     ROT_ADAPTIVE,
     1e-13,
     ROT_FREELY,
     "integrated, with implicit steps: it is stiff",
     not_before,
     radau_s,
     {0.24, -1.0 / 9.0, 6.0, 2.0}},
    ROT_FIXED_MODELS("incline_", ROT_INCLINE_EFFECTS, not_before, fixed_s),
};

static const rot_derived derived[] = {
    {"mass_kg", offsetof(rot_incline_built, scene.slope.mass_kg), 1},
    {"moment_of_inertia_kg_m2", offsetof(rot_incline_built, scene.slope.inertia_kg_m2), 1},
    {"radius_m", offsetof(rot_incline_built, scene.slope.radius_m), 1},
    {"kinetic_friction", offsetof(rot_incline_built, scene.slope.mu_kinetic), 1},
    {"omega0_rad_per_s", offsetof(rot_incline_built, scene.slope.omega0_rad_per_s), 1},
};

const rot_constraint rot_incline_constraint = {
    .id = "incline",
    .measures = rot_incline_measures,
    .n_effects = ROT_COUNT(effects),
    .n_models = ROT_COUNT(models),
    .effects = effects,
    .models = models,
    .effects_of = effects_of,
    ROT_MADE_BY("scene_incline", rot_incline_inputs, ROT_INCLINE_INPUTS, rot_incline_build, derived,
                ROT_COUNT(derived)),
    .n_columns = ROT_INCLINE_ALL_COLUMNS,
    .columns = rot_incline_all_columns,
    .runs = rot_incline_runs,
    .scene_size = sizeof(rot_incline_built),
    .start_s = rot_incline_start,
    .events = 1u << ROT_EVENT_STICK | 1u << ROT_EVENT_SLIP | 1u << ROT_EVENT_ROLL |
              1u << ROT_EVENT_REVERSE | 1u << ROT_EVENT_SLIP_REVERSES,
    .n_flows = ROT_INCLINE_FLOWS,
    .flows = rot_incline_flow_names,
    .n_balances = ROT_INCLINE_BALANCES,
    .n_kept = ROT_INCLINE_KEPT,
    .balances = rot_incline_balances,
    .n_terms = ROT_INCLINE_TERMS,
    .terms = rot_incline_terms,
    .audit = rot_incline_audit,
    .conserved = rot_incline_conserved,
    .time_scales = rot_incline_time_scales,
    .event_rows = 1,
    .batches = rot_incline_batches,
};
