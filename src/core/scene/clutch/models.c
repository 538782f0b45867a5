#include "scene/clutch/models.h"

#include "scene/clutch/inputs.h"
#include "scene/clutch/clutch.h"

enum { TORQUE = 1, CLUTCH = 2 };

static const rot_effect effects[] = {{"torque", "constant or stepped torques", 0, 0},
                                     {"clutch", "a clutch", 0, 0}};

static unsigned effects_of(const void *scene) {
  const rot_clutch_params *p = scene;
  unsigned mask = p->static_n_m != 0.0 ? CLUTCH : 0u;
  for (int body = 0; body < 2; body++) {
    const rot_steps *steps = &p->torque_n_m[body];
    for (size_t i = 0; i <= steps->n; i++) {
      if (steps->value[i] != 0.0) mask |= TORQUE;
    }
  }
  return mask;
}

static const char *not_exact(const void *scene, const rot_query *query) {
  const int before = query->n && query->time_s[0] < ((const rot_clutch_params *)scene)->start_s;
  return before ? "it cannot run backwards from the scene's start" : NULL;
}

/* seconds: of a run, of a row, of a step of a torque. */
static double cost_s(const rot_model *model, const void *scene, const rot_query *query) {
  const rot_clutch_params *p = scene;
  const double steps = (double)(p->torque_n_m[0].n + p->torque_n_m[1].n);
  return model->seconds[0] + (double)query->n * model->seconds[1] + steps * model->seconds[2];
}

static const rot_model models[] = {
    {"clutch_exact",
     TORQUE | CLUTCH,
     ROT_BOUND,
     4e-15,
     ROT_FREELY,
     "all torques are constant between events: closed form",
     not_exact,
     cost_s,
     {0.9e-6, 65e-9, 0.13e-6, 0.0}},
};

const rot_constraint rot_clutch_constraint = {
    .id = "clutch",
    .measures = rot_turning,
    .n_effects = sizeof effects / sizeof *effects,
    .n_models = sizeof models / sizeof *models,
    .effects = effects,
    .models = models,
    .effects_of = effects_of,
    .constructor = "scene_clutch",
    .n_inputs = ROT_CLUTCH_INPUTS,
    .n_columns = ROT_CLUTCH_ALL_COLUMNS,
    .inputs = rot_clutch_inputs,
    .columns = rot_clutch_all_columns,
    .runs = rot_clutch_runs,
    .scene_size = sizeof(rot_clutch_built),
    .build = rot_clutch_build,
    .release = rot_clutch_release,
    .start_s = rot_clutch_start_s,
};
