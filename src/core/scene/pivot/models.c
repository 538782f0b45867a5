#include "scene/pivot/models.h"

#include <math.h>
#include <stddef.h>

#include "scene/free/models.h"
#include "scene/free/inputs.h"
#include "scene/free/ledger.h"
#include "scene/free/scene.h"
#include "scene/pivot/pivot.h"
#include "scene/pivot/approx.h"
#include "scene/pivot/inputs.h"
#include "scene/pivot/ledger.h"
#include "scene/pivot/scene.h"

enum { WEIGHT = 1, TORQUE = 2, LAW = 4, DAMPING = 8, ROTORS = 16, MOTORS = 32 };

static const rot_effect effects[] = {
    {"weight", "gravity", 0, 0},        {"torque", "a torque", 0, 0},
    {"law", "a torque function", 0, 0}, {"damping", "damping", 0, 0},
    {"rotors", "rotors", 0, 0},         {"motors", "rotors with motor torques", 0, ROTORS}};

static unsigned effects_of(const void *of) {
  const rot_free_params *p = of;
  const double *t = p->torque, *g = p->lever_n_m;
  return (g[0] != 0.0 || g[1] != 0.0 || g[2] != 0.0 ? WEIGHT : 0u) |
         (t[0] != 0.0 || t[1] != 0.0 || t[2] != 0.0 || p->n_knots ? TORQUE : 0u) |
         (p->law ? LAW : 0u) | (p->damping_per_s != 0.0 ? DAMPING : 0u) |
         (p->n_rotors ? ROTORS : 0u) | (rot_free_has_motors(p) ? MOTORS : 0u);
}

static const char *refuses_top(const void *scene, const rot_query *query) {
  (void)query;
  return rot_pivot_not_top(scene);
}

static const char *refuses_precession(const void *scene, const rot_query *query) {
  (void)query;
  return rot_pivot_not_spinning(scene);
}

static const char *refuses_nutation(const void *scene, const rot_query *query) {
  return refuses_precession(scene, query);
}

static double bound_of(const rot_model *model, const void *scene, const rot_query *query) {
  const rot_free_params *p = scene;
  double t = 0.0;
  const int precession = model->why_not == refuses_precession;
  if (!precession && model->why_not != refuses_nutation) return 0.0;
  if (query->n) {
    const double from = query->time_s[0], to = query->time_s[query->n - 1];
    t = fmax(fabs(from - p->start_s), fabs(to - p->start_s));
  }
  return precession ? rot_pivot_precession_bound(p, t) : rot_pivot_nutation_bound(p, t);
}

static const rot_model models[ROT_PIVOT_MODELS] = {
    {"pivot_top",
     WEIGHT | ROTORS,
     ROT_BOUND,
     1e-14,
     ROT_FREELY,
     "a heavy symmetric top: closed form by elliptic functions",
     refuses_top,
     rot_free_exact_s,
     {8e-6, 1e-6, 0.0, 0.0}},
    {"pivot_precession",
     WEIGHT,
     ROT_BOUND,
     1e-7,
     ROT_FREELY,
     "a fast top: it goes round at torque/L, nutation left out",
     refuses_precession,
     rot_free_exact_s,
     {7e-6, 0.4e-6, 0.0, 0.0}},
    {"pivot_nutation",
     WEIGHT,
     ROT_BOUND,
     1e-7,
     ROT_FREELY,
     "a fast top: small nutation, to first order",
     refuses_nutation,
     rot_free_exact_s,
     {7e-6, 0.5e-6, 0.0, 0.0}},
    {"pivot_free",
     DAMPING,
     ROT_BOUND,
     1e-14,
     ROT_FREELY,
     "no torque: closed form by elliptic functions",
     rot_free_refuses_exact,
     rot_free_exact_s,
     {6e-6, 0.8e-6, 0.0, 0.0}},
    {"pivot_gyrostat",
     ROTORS,
     ROT_BOUND,
     1e-14,
     ROT_FREELY,
     "no torque, rotors along a principal axis: closed form",
     rot_free_refuses_gyrostat,
     rot_free_exact_s,
     {30e-6, 0.8e-6, 0.0, 0.0}},
    ROT_FREE_INTEGRATED("pivot_", WEIGHT | TORQUE | LAW | DAMPING | ROTORS | MOTORS),
    ROT_FREE_STEPS("pivot_", WEIGHT | TORQUE | LAW | DAMPING | ROTORS | MOTORS, WEIGHT | ROTORS),
};

static const rot_column_of columns[] = {ROT_FREE_TABLE(ROTORS),
                                        ROT_COLUMN("potential_energy_j", "J", 0),
                                        ROT_COLUMN("inclination_rad", "rad", 0)};
static const rot_balance balances[] = {ROT_FREE_BALANCES_ABOUT("the fixed point")};
static const rot_balance_term terms[] = {ROT_FREE_TERMS_WITH(ROTORS)};
static const rot_derived derived[] = {ROT_FREE_DERIVED,
                                      {"lever_n_m", offsetof(rot_free_built, params.lever_n_m), 3},
                                      {"mass_kg", offsetof(rot_free_built, mass_kg), 1},
                                      {"centre_m", offsetof(rot_free_built, centre_m), 3}};

const rot_constraint rot_pivot_constraint = {
    .id = "pivot",
    .measures = rot_free_measures,
    .n_effects = ROT_COUNT(effects),
    .n_models = ROT_COUNT(models),
    .effects = effects,
    .models = models,
    .effects_of = effects_of,
    ROT_MADE_BY("scene_pivot", rot_pivot_inputs, ROT_PIVOT_INPUTS, rot_pivot_build, derived,
                ROT_COUNT(derived)),
    .n_columns = ROT_COUNT(columns),
    .columns = columns,
    .runs = rot_pivot_runs,
    .scene_size = sizeof(rot_free_built),
    .start_s = rot_free_start,
    .events = 1u << ROT_EVENT_HIGHEST | 1u << ROT_EVENT_LOWEST,
    .bound = bound_of,
    .n_flows = ROT_FREE_FLOWS,
    .flows = rot_free_flow_names,
    .n_balances = ROT_COUNT(balances),
    .balances = balances,
    .n_kept = ROT_FREE_KEPT,
    .n_terms = ROT_COUNT(terms),
    .terms = terms,
    .audit = rot_free_audit,
    .explain = rot_free_explain,
    .conserved = rot_pivot_conserved,
    .time_scales = rot_pivot_time_scales,
    .shows = rot_pivot_shows,
};
