#include "scene/shaft/models.h"

#include <math.h>
#include <stddef.h>

#include "scene/shaft/inputs.h"
#include "scene/shaft/ledger.h"
#include "scene/shaft/shaft.h"

enum { TORQUE = 1, SPRING = 2, DAMPER = 4, VISCOUS = 8, ALL = 15 };

static const rot_effect effects[] = {{"torque", "constant torques", 0, 0},
                                     {"spring", "springs between neighbours", 0, 0},
                                     {"damper", "dampers between neighbours", 0, 0},
                                     {"viscous", "viscous resistance", 0, 0}};

static int any(size_t n, const double x[]) {
  for (size_t i = 0; i < n; i++) {
    if (x[i] != 0.0) return 1;
  }
  return 0;
}

static unsigned effects_of(const void *scene) {
  const rot_shaft_params *p = scene;
  return (any(p->n, p->torque_n_m) ? TORQUE : 0u) |
         (any(p->n - 1, p->stiffness_n_m_per_rad) ? SPRING : 0u) |
         (any(p->n - 1, p->damping_n_m_s) ? DAMPER : 0u) |
         (any(p->n, p->viscous_n_m_s) ? VISCOUS : 0u);
}

static const char *not_rigid(const void *scene, const rot_query *query) {
  const rot_shaft_params *p = scene;
  for (size_t i = 0; i + 1 < p->n; i++) {
    if (p->stiffness_n_m_per_rad[i] <= 0.0) return "a piece of the shaft has no stiffness";
  }
  const int backward = query->n && query->time_s[0] < p->start_s;
  if (backward && effects_of(scene) & (DAMPER | VISCOUS)) {
    return "backwards, with damping, no bound is known on what it leaves out";
  }
  return NULL;
}

/* 1 if c_i = a k_i and d_i = b J_i (each mode has a closed form), else 0. */
static int modes_decouple(const rot_shaft_params *p) {
  int decoupled = 1;
  for (size_t i = 1; i < p->n; i++) {
    const double *J = p->inertia_kg_m2, *d = p->viscous_n_m_s, *k = p->stiffness_n_m_per_rad;
    const double *c = p->damping_n_m_s, off = d[i] * J[0] - d[0] * J[i];
    decoupled &= fabs(off) <= 1e-12 * d[i] * J[0];
    if (i + 1 < p->n) decoupled &= fabs(c[i] * k[0] - c[0] * k[i]) <= 1e-12 * c[i] * k[0];
  }
  return decoupled;
}

static double rigid_s(const rot_model *model, const void *scene, const rot_query *query) {
  const double n = (double)((const rot_shaft_params *)scene)->n, rows = (double)query->n;
  const double *s = model->seconds, exponential_s = effects_of(scene) & VISCOUS ? s[3] : 0.0;
  return s[0] + rows * (n * s[1] + n * n * s[2] + exponential_s);
}

/* (shaft, springs or dampers k) => bound (Gershgorin) on the largest eigenvalue of J^-1/2 K J^-1/2:
 * fastest oscillation or decay of a twist. */
static double largest_rate(const rot_shaft_params *p, const double k[]) {
  const double *J = p->inertia_kg_m2;
  double max = 0.0, before = 0.0;
  for (size_t i = 0; i < p->n; i++) {
    double behind = 0.0, own = 0.0, next = 0.0;
    if (i + 1 < p->n) {
      const double across = k[i] / sqrt(J[i]) / sqrt(J[i + 1]);
      own = k[i] / J[i];
      next = k[i] / J[i + 1] + across;
      behind = own + across;
    }
    max = fmax(max, behind + before);
    before = next;
  }
  return max;
}

/* Coupled modes: four propagators in twice the precision (of the motion, of two with moved inputs,
 * and of the sizes), each the series and a square for each doubling of its time; then a product and
 * a series for each row from the start, and for the sizes; rows that share a step take products in
 * doubles. A second of 2 rows takes 2 ms of 10 rotors, 25 ms of 24, 0.2 s of 50; predicted within a
 * factor of 3. */
static double coupled_s(const rot_model *model, const rot_shaft_params *p, const rot_query *query) {
  const double n = (double)p->n, size = 2.0 * n + 1.0, square = size * size, *s = model->seconds;
  const double product_s = 0.5 * s[2], rows = (double)query->n;
  const double rate =
      sqrt(largest_rate(p, p->stiffness_n_m_per_rad)) + largest_rate(p, p->damping_n_m_s);
  const double span = query->n ? fabs(query->time_s[query->n - 1] - p->start_s) : 0.0;
  const double doublings = fmin(fmax(log2(4.0 * rate * span), 1.0), 1100.0);
  const double row_s = (doublings + 12.0) * square * product_s;
  return 3.0 * s[0] + 2.0 * n * n * n * s[3] + 4.0 * (doublings + 6.0) * size * square * product_s +
         128.0 * row_s +
         (query->accuracy >= 1e-11 && query->n > 8 ? size * row_s + rows * 6.0 * square * product_s
                                                   : 2.5 * rows * row_s);
}

static double modal_s(const rot_model *model, const void *scene, const rot_query *query) {
  const double n = (double)((const rot_shaft_params *)scene)->n, rows = (double)query->n;
  const double *s = model->seconds;
  if (!modes_decouple(scene)) return coupled_s(model, scene, query);
  return s[0] + n * n * n * s[3] + rows * n * (s[1] + n * s[2]);
}

static const rot_model models[] = {
    {"rotors_rigid",
     ALL,
     ROT_BOUND,
     4e-15,
     ROT_ON_TRIAL,
     "twists below the accuracy: the shaft turns as one body",
     not_rigid,
     rigid_s,
     {0.8e-6, 30e-9, 3e-9, 80e-9}},
    {"rotors_modal",
     ALL,
     ROT_ESTIMATE,
     1e-14,
     ROT_FREELY,
     "linear springs, constant torques: the modes are exact",
     NULL,
     modal_s,
     {1e-6, 80e-9, 5e-9, 60e-9}},
};

static void time_scales(const void *scene, const double sizes[], rot_time_scales *to) {
  const rot_shaft_params *p = scene;
  double slows = 0.0;
  (void)sizes;
  for (size_t i = 0; i < p->n; i++) slows = fmax(slows, p->viscous_n_m_s[i] / p->inertia_kg_m2[i]);
  to->fades_s = 1.0 / (largest_rate(p, p->damping_n_m_s) + slows);
  to->swing_rad_per_s = sqrt(largest_rate(p, p->stiffness_n_m_per_rad));
}

static const rot_derived derived[] = {
    {"moment_of_inertia_kg_m2", offsetof(rot_shaft_params, inertia_kg_m2), 0}};

const rot_constraint rot_shaft_constraint = {
    .id = "rotors",
    .measures = rot_turning,
    .n_effects = ROT_COUNT(effects),
    .n_models = ROT_COUNT(models),
    .effects = effects,
    .models = models,
    .effects_of = effects_of,
    ROT_MADE_BY("scene_rotors", rot_shaft_inputs, ROT_SHAFT_INPUTS, rot_shaft_build, derived,
                ROT_COUNT(derived)),
    .n_columns = ROT_SHAFT_ALL_COLUMNS,
    .columns = rot_shaft_all_columns,
    .runs = rot_shaft_runs,
    .scene_size = sizeof(rot_shaft_params),
    .start_s = rot_shaft_start_s,
    .index = "rotor",
    .rows_per_time = rot_shaft_rows_per_time,
    .n_flows = ROT_SHAFT_FLOWS,
    .flows = rot_shaft_flow_names,
    .n_balances = ROT_SHAFT_BALANCES,
    .balances = rot_shaft_balances,
    .n_terms = ROT_SHAFT_TERMS,
    .terms = rot_shaft_terms,
    .audit = rot_shaft_audit,
    .conserved = rot_shaft_conserved,
    .time_scales = time_scales,
};
