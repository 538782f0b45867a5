#include "scene/drive/models.h"

#include <math.h>
#include <stddef.h>

#include "engine/ode/fixed.h"
#include "scene/drive/exact.h"
#include "scene/drive/inputs.h"
#include "scene/drive/ledger.h"
#include "scene/drive/mesh.h"
#include "scene/drive/time_scales.h"
#include "ground/search.h"

/* ---- effects --------------------------------------------------------------------------------- */

enum {
  TORQUE = 1 << 0,
  LAW = 1 << 1,
  SHAFT = 1 << 2,
  CLUTCH = 1 << 3,
  GEAR = 1 << 4,
  VISCOUS = 1 << 5,
  QUADRATIC = 1 << 6,
  FRICTION = 1 << 7,
  BRAKE = 1 << 8,
  MESH = ROT_DRIVE_MESH,
  ALL = (1 << 10) - 1
};

static const rot_effect effects[] = {{"torque", "constant torques", 0, 0},
                                     {"law", "torque laws", 0, TORQUE},
                                     {"shaft", "an elastic shaft", 0, 0},
                                     {"clutch", "a clutch", 0, 0},
                                     {"gear", "a gear", 0, 0},
                                     {"viscous", "viscous resistance", 0, 0},
                                     {"quadratic", "quadratic drag", 0, 0},
                                     {"friction", "dry friction", 0, 0},
                                     {"brake", "a brake", 0, 0},
                                     {"mesh", "a gear with a loss", 0, 0}};

static unsigned torque_effects(const rot_axle_scene *r) {
  const rot_torque *torque = &r->linear.torque;
  unsigned mask = torque->before_n_m != 0.0 || torque->after_n_m != 0.0 ? TORQUE : 0u;
  if (torque->n || torque->call || r->n_terms || r->motor_n_m_s != 0.0) mask |= TORQUE | LAW;
  return mask;
}

/* scene => mask of its effects. */
static unsigned effects_of(const void *of) {
  const rot_drive_scene *scene = of;
  unsigned mask = 0;
  for (size_t i = 0; i < scene->n; i++) {
    const rot_axle_scene *r = &scene->rotor[i];
    mask |= torque_effects(r);
    if (r->viscous_n_m_s != 0.0) mask |= VISCOUS;
    if (r->quadratic_n_m_s2 != 0.0) mask |= QUADRATIC;
    if (r->coulomb_n_m != 0.0 || r->static_n_m != 0.0) mask |= FRICTION;
    if (scene->brake[i].acts) mask |= BRAKE;
    if (i + 1 == scene->n) break;
    const rot_drive_coupling *c = &scene->coupling[i];
    if (c->kind == ROT_DRIVE_SHAFT) mask |= SHAFT;
    if (c->kind == ROT_DRIVE_CLUTCH) mask |= CLUTCH;
    if (c->kind == ROT_DRIVE_GEAR || c->ratio != 1.0) mask |= GEAR;
    if (rot_drive_mesh_loses(c)) mask |= MESH;
  }
  return mask;
}

/* ---- models ---------------------------------------------------------------------------------- */

static const char *not_integrated(const void *of, const rot_query *query) {
  const rot_drive_scene *scene = of;
  const int before = query->n && query->time_s[0] < scene->start_s;
  return before && (effects_of(of) & (CLUTCH | FRICTION | BRAKE | MESH))
             ? "it cannot run backwards from the scene's start"
             : NULL;
}

/* Rates: oscillation (shafts and laws), decay (resistance and dampers). */
static void rates_of(const rot_drive_scene *scene, double *swing_per_s, double *decay_per_s) {
  *swing_per_s = *decay_per_s = 0.0;
  for (size_t i = 0; i < scene->n; i++) {
    const rot_axle_scene *r = &scene->rotor[i];
    const double inertia = r->linear.inertia_kg_m2;
    double spring = 0.0, damping = r->viscous_n_m_s + r->motor_n_m_s;
    for (int side = 0; side < 2; side++) {
      if (side ? i == 0 : i + 1 == scene->n) continue;
      const rot_drive_coupling *c = &scene->coupling[side ? i - 1 : i];
      const double turn = side ? c->ratio * c->ratio : 1.0;
      spring += turn * c->stiffness_n_m_per_rad;
      damping += turn * c->damping_n_m_s;
    }
    for (size_t k = 0; k < r->n_terms; k++) {
      const double *x = r->terms[k].x;
      const rot_term_kind kind = r->terms[k].kind;
      if (kind == ROT_TERM_SINUSOID) *swing_per_s = fmax(*swing_per_s, fabs(x[1]));
      if (kind == ROT_TERM_SPRING || kind == ROT_TERM_GRAVITY) spring += fabs(x[0]);
    }
    *swing_per_s = fmax(*swing_per_s, sqrt(spring / inertia));
    *decay_per_s = fmax(*decay_per_s, damping / inertia);
  }
}

static int calls(const rot_drive_friction *friction) {
  return friction->law.linear.torque.call != NULL;
}

/* => 1 if the scene has a law of the caller */
static int calls_law(const rot_drive_scene *scene) {
  for (size_t i = 0; i < scene->n; i++) {
    if (scene->rotor[i].linear.torque.call) return 1;
    if (scene->brake[i].acts && calls(&scene->brake[i])) return 1;
    if (i + 1 < scene->n && scene->coupling[i].friction.acts && calls(&scene->coupling[i].friction))
      return 1;
  }
  return 0;
}

/* As of an axle (scene/axle/models.c), with a right-hand side per rotor. model->seconds: step rate,
 * its power, decay times, later steps; for explicit and implicit steps. */
static double integrated_s(const rot_model *model, const void *of, const rot_query *query,
                           int implicit) {
  const rot_drive_scene *scene = of;
  const double *s = model->seconds, rows = (double)query->n, n = (double)scene->n;
  const double from = query->n ? fmin(scene->start_s, query->time_s[0]) : scene->start_s;
  const double to = query->n ? fmax(scene->start_s, query->time_s[query->n - 1]) : scene->start_s;
  double swing, decay, breaks = 0.0;
  rates_of(scene, &swing, &decay);
  for (size_t i = 0; i < scene->n; i++) {
    const rot_axle_scene *r = &scene->rotor[i];
    breaks += (double)(rot_lower_bound(r->n_breaks, r->breaks_s, to) -
                       rot_lower_bound(r->n_breaks, r->breaks_s, from));
  }
  const double decays = fmin(decay * (to - from), 1e300);
  const double rate = s[0] * pow(fmax(query->accuracy, model->promise), s[1]);
  const double after = s[3] * fmax(0.0, implicit ? log10(decays) : decays - s[2]);
  const double steps =
      12.0 + 3.0 * breaks + rate * fmax(swing * (to - from), fmin(decays, s[2])) + after;
  const double call_s = 120e-9 * n + (calls_law(scene) ? query->law_s : 0.0);
  return 10e-6 + steps * (implicit ? (28.0 + 6.0 * n) * call_s + 3e-6 * n * n : 20.4 * call_s) +
         rows * n * 0.6e-6;
}

static double rk8pd_s(const rot_model *model, const void *scene, const rot_query *query) {
  return integrated_s(model, scene, query, 0);
}

static double radau_s(const rot_model *model, const void *scene, const rot_query *query) {
  return integrated_s(model, scene, query, 1);
}

#define EXACT_WHY(name, form)                                                                      \
  static const char *name(const void *scene, const rot_query *query) {                             \
    return rot_drive_exact_why_not(scene, form, query);                                            \
  }
EXACT_WHY(not_axle, ROT_DRIVE_AS_AXLE)
EXACT_WHY(not_clutch, ROT_DRIVE_AS_CLUTCH)
EXACT_WHY(not_modal, ROT_DRIVE_AS_SHAFT)

/* 1 if c_i = a k_i and d_i = b J_i: each mode has a closed form (scene/shaft/modal.h). */
static int modes_decouple(const rot_drive_scene *scene) {
  const rot_drive_coupling *shaft = NULL;
  int decoupled = 1;
  for (size_t i = 0; i < scene->n; i++) {
    const rot_axle_scene *r = &scene->rotor[i], *first = &scene->rotor[0];
    const double d = r->viscous_n_m_s * first->linear.inertia_kg_m2;
    decoupled &= fabs(d - first->viscous_n_m_s * r->linear.inertia_kg_m2) <= 1e-12 * d;
    const rot_drive_coupling *c = i + 1 < scene->n ? &scene->coupling[i] : NULL;
    if (!c || c->kind != ROT_DRIVE_SHAFT) continue;
    if (!shaft) shaft = c;
    const double damped = c->damping_n_m_s * shaft->stiffness_n_m_per_rad;
    decoupled &= fabs(damped - shaft->damping_n_m_s * c->stiffness_n_m_per_rad) <= 1e-12 * damped;
  }
  return decoupled;
}

/* The heat of resistance and dampers needs 15 quadrature nodes per interval of the rows.
 * model->seconds: per run; per row of a rotor without losses, with losses, with coupled modes. */
static double exact_s(const rot_model *model, const void *of, const rot_query *query) {
  const rot_drive_scene *scene = of;
  const double rows = (double)query->n * (double)scene->n;
  int lossy = (effects_of(of) & VISCOUS) != 0;
  for (size_t i = 0; i + 1 < scene->n; i++) lossy |= scene->coupling[i].damping_n_m_s > 0.0;
  const int coupled = lossy && model->seconds[3] > 0.0 && !modes_decouple(scene);
  return model->seconds[0] + rows * model->seconds[coupled ? 3 : lossy ? 2 : 1];
}

static double fixed_s(const rot_model *model, const void *of, const rot_query *query) {
  rot_time_scales time_scales;
  rot_drive_time_scales_of_start(of, &time_scales);
  return rot_fixed_cost_s(model, query, rot_drive_start_s(of), calls_law(of), &time_scales);
}

static const rot_model models[] = {
    {"drive_axle",
     TORQUE | LAW | GEAR | VISCOUS,
     ROT_BOUND,
     2e-14,
     ROT_FREELY,
     "rigid gears: one body with a closed form",
     not_axle,
     exact_s,
     {4e-6, 190e-9, 3.5e-6, 0.0}},
    {"drive_clutch",
     TORQUE | LAW | CLUTCH | GEAR,
     ROT_BOUND,
     2e-14,
     ROT_FREELY,
     "one clutch, all torques constant between events",
     not_clutch,
     exact_s,
     {4e-6, 60e-9, 60e-9, 0.0}},
    {"drive_modal",
     TORQUE | SHAFT | GEAR | VISCOUS,
     ROT_ESTIMATE,
     1e-13,
     ROT_FREELY,
     "the equations are linear: solved in modes",
     not_modal,
     exact_s,
     {8e-6, 190e-9, 2.3e-6, 25e-6}},
    {"drive_rk8pd",
     ALL,
     ROT_ADAPTIVE,
     1e-13,
     ROT_FREELY,
     "integrated, with explicit steps: it is not stiff",
     not_integrated,
     rk8pd_s,
     {0.25, -1.0 / 8.5, 10.0, 0.39}},
    {"drive_radau",
     ALL,
     ROT_ADAPTIVE,
     1e-13,
     ROT_FREELY,
     "integrated, with implicit steps: it is stiff",
     not_integrated,
     radau_s,
     {0.24, -1.0 / 9.0, 6.0, 2.0}},
    ROT_FIXED_MODELS("drive_", ALL, not_integrated, fixed_s),
};

static const double *breaks(const void *of, size_t *n) {
  const rot_drive_scene *scene = of;
  *n = scene->n_breaks;
  return scene->breaks_s;
}

const rot_constraint rot_drive_constraint = {
    .id = "drive",
    .measures = rot_turning,
    .n_effects = sizeof effects / sizeof *effects,
    .n_models = sizeof models / sizeof *models,
    .effects = effects,
    .models = models,
    .effects_of = effects_of,
    ROT_MADE_BY("scene_drive", rot_drive_inputs, ROT_DRIVE_INPUTS, rot_drive_build,
                rot_drive_derived, ROT_DRIVE_DERIVED),
    .n_columns = ROT_DRIVE_ALL_COLUMNS,
    .columns = rot_drive_all_columns,
    .runs = rot_drive_runs,
    .scene_size = sizeof(rot_drive_scene),
    .start_s = rot_drive_start_s,
    .events = 1u << ROT_EVENT_LOCK | 1u << ROT_EVENT_STICK | 1u << ROT_EVENT_SLIP |
              1u << ROT_EVENT_REVERSE,
    .index = "rotor",
    .rows_per_time = rot_drive_rows_per_time,
    .n_flows = ROT_DRIVE_FLOWS,
    .flows = rot_drive_flow_names,
    .n_balances = ROT_DRIVE_BALANCES,
    .balances = rot_drive_balances,
    .n_terms = ROT_DRIVE_TERMS,
    .terms = rot_drive_terms,
    .audit = rot_drive_audit,
    .conserved = rot_drive_conserved,
    .time_scales = rot_drive_time_scales,
    .breaks = breaks,
    .between = "coupling",
};
