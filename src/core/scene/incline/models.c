#include "scene/incline/models.h"

#include <math.h>

#include "scene/incline/scene.h"

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

/* seconds: of a run, of a row. */
static double cost_s(const rot_model *model, const void *scene, const rot_query *query) {
  (void)scene;
  return model->seconds[0] + (double)query->n * model->seconds[1];
}

/* Steps of a stretch, and a few stretches; drag counts by the times that it fades in, as in
 * scene/axle/models.c. seconds: the rate, its power, decay times, steps after, of explicit and
 * implicit steps. */
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
};

const rot_constraint rot_incline_constraint = {
    .id = "incline",
    .measures = rot_incline_measures,
    .n_effects = sizeof effects / sizeof *effects,
    .n_models = sizeof models / sizeof *models,
    .effects = effects,
    .models = models,
    .effects_of = effects_of,
    .constructor = "scene_incline",
    .n_inputs = ROT_INCLINE_INPUTS,
    .n_columns = ROT_INCLINE_ALL_COLUMNS,
    .inputs = rot_incline_inputs,
    .columns = rot_incline_all_columns,
    .runs = rot_incline_runs,
    .scene_size = sizeof(rot_incline_built),
    .build = rot_incline_build,
    .start_s = rot_incline_start,
};
