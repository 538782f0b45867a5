#include "scene/clutch/models.h"

#include <math.h>
#include <stddef.h>

#include "scene/clutch/clutch.h"
#include "scene/clutch/inputs.h"
#include "scene/clutch/ledger.h"

enum { TORQUE = 1, CLUTCH = 2 };

static const rot_effect effects[] = {{"torque", "constant or stepped torques", 0, 0},
                                     {"clutch", "a clutch", 0, 0}};

static unsigned effects_of(const void *scene) {
  const rot_clutch_params *p = scene;
  return (p->static_n_m != 0.0 ? CLUTCH : 0u) | (rot_clutch_is_driven(p) ? TORQUE : 0u);
}

static const char *not_exact(const void *scene, const rot_query *query) {
  const int before = query->n && query->time_s[0] < ((const rot_clutch_params *)scene)->start_s;
  return before ? "it cannot run backwards from the scene's start" : NULL;
}

/* model->seconds: per run, per row, per step of a torque. */
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

/* Between events the angles are parabolas: no time scale. */
static void time_scales(const void *scene, const double sizes[], rot_time_scales *to) {
  (void)scene, (void)sizes;
  *to = (rot_time_scales){INFINITY, 0.0};
}

static const char *const flows[] = {
#define X(name) #name,
    ROT_CLUTCH_FLOWS(X)
#undef X
};

static const rot_derived derived[] = {
    {"moment_of_inertia_kg_m2", offsetof(rot_clutch_params, inertia_kg_m2), 2},
    {"static_capacity_n_m", offsetof(rot_clutch_params, static_n_m), 1}};

const rot_constraint rot_clutch_constraint = {
    .id = "clutch",
    .measures = rot_turning,
    .n_effects = ROT_COUNT(effects),
    .n_models = ROT_COUNT(models),
    .effects = effects,
    .models = models,
    .effects_of = effects_of,
    ROT_MADE_BY("scene_clutch", rot_clutch_inputs, ROT_CLUTCH_INPUTS, rot_clutch_build, derived,
                ROT_COUNT(derived)),
    .n_columns = ROT_CLUTCH_ALL_COLUMNS,
    .columns = rot_clutch_all_columns,
    .runs = rot_clutch_runs,
    .scene_size = sizeof(rot_clutch_params),
    .start_s = rot_clutch_start_s,
    .events = 1u << ROT_EVENT_LOCK | 1u << ROT_EVENT_SLIP | 1u << ROT_EVENT_REVERSE,
    .n_flows = ROT_COUNT(flows),
    .flows = flows,
    .n_balances = ROT_CLUTCH_BALANCES,
    .balances = rot_clutch_balances,
    .n_terms = ROT_CLUTCH_TERMS,
    .terms = rot_clutch_terms,
    .audit = rot_clutch_audit,
    .conserved = rot_clutch_conserved,
    .time_scales = time_scales,
};
