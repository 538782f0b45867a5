#include "scene/drive/exact.h"

#include <math.h>
#include <string.h>

#include "ground/sort.h"
#include "ground/real.h"
#include "maths/panels.h"
#include "scene/axle/inputs.h"
#include "scene/axle/runs.h"
#include "scene/axle/models.h"
#include "scene/clutch/clutch.h"
#include "scene/drive/ledger.h"
#include "scene/drive/units.h"
#include "scene/shaft/modal.h"

/* ---- scenes of other constraints ------------------------------------------------------------- */

typedef struct exact {
  const rot_drive_scene *scene;
  rot_drive_form form;
  rot_drive_units u;
  rot_axle_built axle;
  const rot_model_run *run; /* model of the axle */
  rot_clutch_params clutch;
  rot_shaft_params shaft;
  const rot_hooks *hooks;
} exact;

/* All units are one: scene of an axle. */
static rot_status axle_of(exact *x, rot_store *store) {
  rot_axle_scene *axle = &x->axle.scene;
  rot_loads loads;
  const rot_status status = rot_drive_unit_loads(x->scene, &x->u, 0, store, &loads);
  if (status != ROT_OK) return status;
  memset(&x->axle, 0, sizeof x->axle);
  axle->motor_n_m_s = loads.motor_n_m_s;
  axle->viscous_n_m_s = x->u.viscous_n_m_s[0];
  axle->linear.inertia_kg_m2 = x->u.inertia_kg_m2[0];
  axle->linear.viscous_n_m_s = axle->viscous_n_m_s + axle->motor_n_m_s;
  axle->linear.start_s = x->scene->start_s;
  axle->linear.omega0_rad_per_s = x->u.omega0_rad_per_s[0];
  axle->linear.torque = loads.knots;
  axle->n_terms = loads.n_terms;
  axle->terms = loads.terms;
  double *breaks_s = rot_store_get(store, rot_axle_scene_room(axle), sizeof *breaks_s);
  if (!breaks_s) return ROT_ENOMEM;
  axle->n_breaks = rot_axle_scene_breaks(axle, breaks_s);
  axle->breaks_s = breaks_s;
  return ROT_OK;
}

/* axle => cheapest closed form with a bound; NULL: none. */
static const rot_model_run *form_of_axle(const rot_axle_built *axle, const rot_query *query) {
  const rot_constraint *c = &rot_axle_constraint;
  const unsigned effects = c->effects_of(axle);
  const rot_model_run *found = NULL;
  double min = INFINITY;
  for (size_t i = 0; i < c->n_models; i++) {
    const rot_model *model = &c->models[i];
    if (model->error_kind != ROT_BOUND || effects & ~model->takes) continue;
    if (model->why_not && model->why_not(axle, query)) continue;
    const double cost = model->cost_s(model, axle, query);
    if (cost < min) min = cost, found = &c->runs[i];
  }
  return found;
}

/* unit k => steps of its torque. */
static rot_status steps_of(const exact *x, size_t k, rot_store *store, rot_steps *steps) {
  rot_loads loads;
  const rot_status status = rot_drive_unit_loads(x->scene, &x->u, k, store, &loads);
  const rot_torque *knots = &loads.knots;
  if (status != ROT_OK) return status;
  double *time_s = rot_store_get(store, knots->n, sizeof *time_s);
  double *value = rot_store_get(store, knots->n + 1, sizeof *value);
  if (!time_s || !value) return ROT_ENOMEM;
  *steps = (rot_steps){0, time_s, value};
  value[0] = knots->before_n_m;
  for (size_t i = 0; i < knots->n; i++) {
    const int last = i + 1 == knots->n;
    if (!last && !(knots->time_s[i + 1] > knots->time_s[i])) continue;
    time_s[steps->n] = knots->time_s[i];
    value[++steps->n] = last ? knots->after_n_m : knots->torque_n_m[i];
  }
  return ROT_OK;
}

/* Two units and a clutch: parameters at the first shaft. */
static rot_status clutch_of(exact *x, rot_store *store) {
  const rot_drive_units *u = &x->u;
  const rot_drive_friction *friction = &x->scene->coupling[u->between[0]].friction;
  rot_clutch_params *p = &x->clutch;
  const double *omega = u->omega0_rad_per_s;
  memset(p, 0, sizeof *p);
  p->capacity_n_m = friction->law.linear.torque.before_n_m / fabs(u->ratio[u->between[0]]);
  p->static_n_m = friction->static_ratio * p->capacity_n_m;
  p->start_s = x->scene->start_s;
  p->engage_s = fmax(friction->from_s, p->start_s);
  /* A slip within rounding is 0. */
  const int alike = fabs(omega[1] - omega[0]) <= 4.0 * ROT_EPS * fabs(omega[0]);
  rot_status status = ROT_OK;
  for (size_t k = 0; k < 2 && status == ROT_OK; k++) {
    p->inertia_kg_m2[k] = u->inertia_kg_m2[k];
    p->omega0_rad_per_s[k] = alike ? omega[0] : omega[k];
    status = steps_of(x, k, store, &p->torque_n_m[k]);
  }
  return status;
}

/* Units as rotors of a shaft. The initial twist of each shaft, at the first shaft, is that of the
 * angles of the units. */
static rot_status shaft_of(exact *x, rot_store *store) {
  const rot_drive_units *u = &x->u;
  const size_t m = u->m;
  double *room = rot_store_get(store, m, 4 * sizeof *room);
  if (!room) return ROT_ENOMEM;
  double *stiffness = room, *damping = room + m, *torque = room + 2 * m, *theta = room + 3 * m;
  for (size_t k = 0; k + 1 < m; k++) {
    const size_t j = u->between[k];
    const rot_drive_coupling *c = &x->scene->coupling[j];
    const double P = u->ratio[j], before = x->scene->rotor[j].linear.theta0_rad;
    stiffness[k] = c->stiffness_n_m_per_rad / (P * P);
    damping[k] = c->damping_n_m_s / (P * P);
    theta[k + 1] = theta[k] - P * (before - c->ratio * x->scene->rotor[j + 1].linear.theta0_rad);
  }
  for (size_t k = 0; k < m; k++) {
    rot_loads loads;
    const rot_status status = rot_drive_unit_loads(x->scene, u, k, store, &loads);
    if (status != ROT_OK) return status;
    torque[k] = loads.knots.before_n_m;
  }
  x->shaft = (rot_shaft_params){.n = m,
                                .inertia_kg_m2 = u->inertia_kg_m2,
                                .stiffness_n_m_per_rad = stiffness,
                                .damping_n_m_s = damping,
                                .viscous_n_m_s = u->viscous_n_m_s,
                                .torque_n_m = torque,
                                .theta0_rad = theta,
                                .omega0_rad_per_s = u->omega0_rad_per_s,
                                .start_s = x->scene->start_s};
  return ROT_OK;
}

static rot_status open_form(exact *x, const rot_query *query, rot_store *store) {
  rot_status status = rot_drive_units_of(x->scene, store, &x->u);
  if (status != ROT_OK) return status;
  switch (x->form) {
  case ROT_DRIVE_AS_AXLE:
    status = axle_of(x, store);
    if (status == ROT_OK) x->run = form_of_axle(&x->axle, query);
    return status == ROT_OK && !x->run ? ROT_EVALUE : status;
  case ROT_DRIVE_AS_CLUTCH: return clutch_of(x, store);
  default: return shaft_of(x, store);
  }
}

/* ---- choice of the form ---------------------------------------------------------------------- */

static int all_rotors(const rot_drive_scene *scene, int (*fits)(const rot_axle_scene *)) {
  int all = 1;
  for (size_t i = 0; i < scene->n; i++) all &= fits(&scene->rotor[i]);
  return all;
}

static size_t count(const rot_drive_scene *scene, rot_drive_kind kind) {
  size_t n = 0;
  for (size_t i = 0; i + 1 < scene->n; i++) n += scene->coupling[i].kind == kind;
  return n;
}

static const rot_drive_friction *friction_of(const rot_drive_scene *scene) {
  size_t i = 0;
  while (scene->coupling[i].kind != ROT_DRIVE_CLUTCH) i++;
  return &scene->coupling[i].friction;
}

static const char *why_no_axle(const rot_drive_scene *scene, const rot_query *query) {
  if (count(scene, ROT_DRIVE_GEAR) + 1 < scene->n) return "it takes rigid gears alone";
  if (!all_rotors(scene, rot_drive_of_time)) return "it takes torques of time, and motors";
  exact x = {.scene = scene, .form = ROT_DRIVE_AS_AXLE};
  rot_store store = {0};
  const rot_status status = open_form(&x, query, &store);
  rot_store_free(&store);
  return status == ROT_OK ? NULL : "no closed form takes its torque";
}

static const char *why_no_clutch(const rot_drive_scene *scene, const rot_query *query) {
  if (count(scene, ROT_DRIVE_CLUTCH) != 1 || count(scene, ROT_DRIVE_SHAFT)) {
    return "it takes one clutch, and gears";
  }
  const rot_drive_friction *friction = friction_of(scene);
  if (!rot_drive_constant(&friction->law) || friction->to_s < INFINITY)
    return "it takes a constant capacity";
  if (!all_rotors(scene, rot_drive_stepped)) {
    return "it takes torques that are constant between jumps";
  }
  const int before = query->n && query->time_s[0] < scene->start_s;
  return before ? "it cannot run backwards from the scene's start" : NULL;
}

static const char *why_no_shaft(const rot_drive_scene *scene) {
  if (count(scene, ROT_DRIVE_CLUTCH) || !count(scene, ROT_DRIVE_SHAFT)) {
    return "it takes elastic shafts, and gears";
  }
  return all_rotors(scene, rot_drive_constant) ? NULL : "it takes constant torques";
}

const char *rot_drive_exact_why_not(const rot_drive_scene *scene, rot_drive_form form,
                                    const rot_query *query) {
  switch (form) {
  case ROT_DRIVE_AS_AXLE: return why_no_axle(scene, query);
  case ROT_DRIVE_AS_CLUTCH: return why_no_clutch(scene, query);
  default: return why_no_shaft(scene);
  }
}

/* ---- the motion of the units ----------------------------------------------------------------- */

/* Motion of the units, n rows. */
typedef struct solution {
  double *turned, *rate; /* m each, of the units */
  double *between;       /* m - 1 each: torques of the couplings, at the first shaft */
  double *heat;          /* of the clutch; NULL: no clutch */
  int *locked;
} solution;

static rot_status solve_axle(const exact *x, size_t n, const double t[], rot_store *store,
                             rot_events *events, solution *s, rot_info *info) {
  void *column[ROT_AXLE_ALL_COLUMNS];
  for (int i = 0; i < ROT_AXLE_ALL_COLUMNS; i++) {
    column[i] = rot_store_get(store, n, sizeof(double));
    if (!column[i]) return ROT_ENOMEM;
  }
  const rot_task task = {.n = n, .time_s = t, .accuracy = 1e-12, .max_steps = 1000000, .asked = 1};
  const rot_rows rows = {.column = column, .events = events};
  s->turned = column[0];
  s->rate = column[1];
  return x->run->run(&x->axle, &task, x->run->method, &rows, x->hooks, info);
}

/* (times) => rows of the clutch as motion of two units, events. */
static rot_status solve_clutch(const exact *x, size_t n, const double t[], rot_store *store,
                               rot_events *events, solution *s, rot_info *info) {
  double *row = rot_store_get(store, n, 6 * sizeof *row);
  s->turned = rot_store_get(store, n, 2 * sizeof(double));
  s->rate = rot_store_get(store, n, 2 * sizeof(double));
  s->locked = rot_store_get(store, n, sizeof *s->locked);
  if (!row || !s->turned || !s->rate || !s->locked) return ROT_ENOMEM;
  s->between = row + 4 * n;
  s->heat = row + 5 * n;
  const rot_clutch_columns out = {row,        row + n, row + 2 * n, row + 3 * n,
                                  s->between, s->heat, s->locked};
  const rot_status status =
      rot_clutch_run(&x->clutch, n, t, &out, NULL, NULL, events, x->hooks, info);
  for (size_t i = 0; i < n; i++) {
    for (size_t k = 0; k < 2; k++) {
      s->turned[2 * i + k] = row[2 * k * n + i];
      s->rate[2 * i + k] = row[(2 * k + 1) * n + i];
    }
  }
  return status;
}

/* (times) => rows of the shaft as motion of the units. */
static rot_status solve_shaft(const exact *x, size_t n, const double t[], rot_store *store,
                              solution *s, rot_info *info) {
  const size_t m = x->u.m;
  double *torque = rot_store_get(store, n, m * sizeof *torque);
  s->turned = rot_store_get(store, n, m * sizeof(double));
  s->rate = rot_store_get(store, n, m * sizeof(double));
  if (!torque || !s->turned || !s->rate) return ROT_ENOMEM;
  const rot_shaft_columns out = {s->turned, s->rate, torque};
  const rot_status status = rot_shaft_modal(&x->shaft, ROT_SHAFT_EACH, n, t, &out, x->hooks, info);
  s->between = torque;
  for (size_t i = 0; i < n; i++) {
    for (size_t k = 0; k < m; k++) {
      s->turned[i * m + k] -= x->shaft.theta0_rad[k];
      if (k + 1 < m) torque[i * (m - 1) + k] = torque[i * m + k];
    }
  }
  return status;
}

static rot_status solve(const exact *x, size_t n, const double t[], rot_store *store,
                        rot_events *events, solution *s, rot_info *info) {
  memset(s, 0, sizeof *s);
  rot_info_clear(info, rot_turning);
  switch (x->form) {
  case ROT_DRIVE_AS_AXLE: return solve_axle(x, n, t, store, events, s, info);
  case ROT_DRIVE_AS_CLUTCH: return solve_clutch(x, n, t, store, events, s, info);
  default: return solve_shaft(x, n, t, store, s, info);
  }
}

/* ---- the rotors ------------------------------------------------------------------------------ */

/* n values per rotor, by rotor; couplings: per rotor except the last. */
typedef struct actions {
  double *theta, *omega, *applied, *damping, *torque;
} actions;

/* Torques of one row. In a unit, the torque of a gear balances the rotors on one side of it. */
static void torques_of_row(const exact *x, const solution *s, size_t n, size_t row, actions *a) {
  const rot_drive_units *u = &x->u;
  const rot_drive_coupling *coupling = x->scene->coupling;
  double force[2] = {0.0, 0.0}; /* on both sides of a clutch */
  for (size_t i = 0; i < u->n && s->locked; i++) {
    force[u->unit[i]] += (a->applied[i * n + row] + a->damping[i * n + row]) / u->ratio[i];
  }
  for (size_t k = 0; k + 1 < u->m; k++) {
    double torque = s->between[row * (u->m - 1) + k];
    if (s->locked && s->locked[row]) { /* by the torques of the row, also at a jump */
      const double *J = u->inertia_kg_m2;
      torque = (J[1] * force[0] - J[0] * force[1]) / (J[0] + J[1]);
    }
    a->torque[u->between[k] * n + row] = torque * u->ratio[u->between[k]];
  }
  for (size_t first = 0; first < u->n;) {
    const size_t k = u->unit[first];
    size_t last = first;
    while (last + 1 < u->n && u->unit[last + 1] == k) last++;
    double net = 0.0;
    for (size_t i = first; i <= last; i++) {
      net += (a->applied[i * n + row] + a->damping[i * n + row]) / u->ratio[i];
    }
    double into = first > 0 ? coupling[first - 1].ratio * a->torque[(first - 1) * n + row] : 0.0;
    net += into / u->ratio[first];
    if (last + 1 < u->n) net -= a->torque[last * n + row] / u->ratio[last];
    for (size_t i = first; i < last; i++) {
      const double alpha = net / u->inertia_kg_m2[k] / u->ratio[i];
      a->torque[i * n + row] = a->applied[i * n + row] + a->damping[i * n + row] + into -
                               x->scene->rotor[i].linear.inertia_kg_m2 * alpha;
      into = coupling[i].ratio * a->torque[i * n + row];
    }
    first = last + 1;
  }
}

/* (motion of the units, times) => angles, rates and torques of the rotors. */
static rot_status act(const exact *x, const solution *s, size_t n, const double t[],
                      rot_store *store, actions *a) {
  const rot_drive_units *u = &x->u;
  double **part[] = {&a->theta, &a->omega, &a->applied, &a->damping, &a->torque};
  double *net = rot_store_get(store, n, sizeof *net);
  for (size_t i = 0; i < ROT_COUNT(part); i++) {
    *part[i] = rot_store_get(store, n, u->n * sizeof(double));
    if (!*part[i] || !net) return ROT_ENOMEM;
  }
  for (size_t i = 0; i < u->n; i++) {
    const size_t k = u->unit[i];
    double *theta = a->theta + i * n, *omega = a->omega + i * n;
    for (size_t row = 0; row < n; row++) {
      theta[row] = x->scene->rotor[i].linear.theta0_rad + s->turned[row * u->m + k] / u->ratio[i];
      omega[row] = s->rate[row * u->m + k] / u->ratio[i];
    }
    rot_axle_scene_torques(&x->scene->rotor[i], n, t, theta, omega, a->applied + i * n,
                           a->damping + i * n, net);
  }
  for (size_t row = 0; row < n; row++) torques_of_row(x, s, n, row, a);
  return ROT_OK;
}

/* ---- integrals ------------------------------------------------------------------------------- */

/* Integrals: work, three impulses, heat of each rotor, heat of each coupling. */
enum { WORK, TORQUE, RESISTANCE, HOUSING, ROTORS };

static size_t width_of(const exact *x) { return ROTORS + 2 * x->u.n - 1; }

/* torques of a row => rates of the integrals. */
static void rates_of_row(const exact *x, const actions *a, size_t n, size_t row, double f[]) {
  const size_t rotors = x->u.n;
  for (int k = 0; k < ROTORS; k++) f[k] = 0.0;
  for (size_t i = 0; i < rotors; i++) {
    const size_t at = i * n + row;
    const double omega = a->omega[at];
    f[WORK] += a->applied[at] * omega;
    f[TORQUE] += a->applied[at];
    f[RESISTANCE] += a->damping[at];
    f[ROTORS + i] = -a->damping[at] * omega;
    if (i + 1 == rotors) break;
    const rot_drive_coupling *c = &x->scene->coupling[i];
    const double slip = omega - c->ratio * a->omega[at + n];
    f[HOUSING] += a->torque[at] * (c->ratio - 1.0);
    f[ROTORS + rotors + i] =
        c->kind == ROT_DRIVE_CLUTCH ? slip * a->torque[at] : c->damping_n_m_s * slip * slip;
  }
}

/* n times => rates of the integrals (integrand of the quadrature). */
static rot_status rates(size_t n, const double t[], double value[], void *ctx) {
  const exact *x = ctx;
  rot_store store = {0};
  solution s;
  actions a;
  rot_info info;
  rot_events events = {0};
  rot_status status = solve(x, n, t, &store, &events, &s, &info);
  if (status == ROT_OK) status = act(x, &s, n, t, &store, &a);
  for (size_t row = 0; row < n && status == ROT_OK; row++) {
    rates_of_row(x, &a, n, row, value + row * width_of(x));
  }
  rot_events_free(&events);
  rot_store_free(&store);
  return status;
}

/* Integrals since the start, one row per time; their errors, sums of |increments|. */
typedef struct integrals {
  double *value, *error, *size;
} integrals;

/* Ends of the quadrature panels: the times, the start, and times in between at which the rates have
 * kinks. */
static rot_status edges_of(const exact *x, size_t n, const double t[], rot_store *store,
                           double **edges, size_t *count) {
  const rot_drive_scene *scene = x->scene;
  const double from = n ? fmin(t[0], scene->start_s) : scene->start_s;
  const double to = n ? fmax(t[n - 1], scene->start_s) : scene->start_s;
  const double ends[] = {from, to};
  rot_events events = {0};
  rot_info info;
  solution s;
  rot_status status = solve(x, 2, ends, store, &events, &s, &info);
  size_t room = n + 1 + events.count;
  for (size_t i = 0; i < scene->n; i++) room += scene->rotor[i].n_breaks + 1;
  double *all = status == ROT_OK ? rot_store_get(store, room, sizeof *all) : NULL;
  if (status == ROT_OK && !all) status = ROT_ENOMEM;
  size_t found = 0, kept = 0;
  if (status == ROT_OK) {
    for (size_t i = 0; i < n; i++) all[found++] = t[i];
    all[found++] = scene->start_s;
    for (size_t i = 0; i < events.count; i++) all[found++] = events.time_s[i];
    for (size_t i = 0; i < scene->n; i++) {
      const rot_axle_scene *r = &scene->rotor[i];
      for (size_t k = 0; k < r->n_breaks; k++) all[found++] = r->breaks_s[k];
      if (i + 1 < scene->n && scene->coupling[i].friction.acts) {
        all[found++] = scene->coupling[i].friction.from_s;
      }
    }
    rot_sort(found, all);
    for (size_t i = 0; i < found; i++) {
      const int inside = all[i] >= from && all[i] <= to;
      if (inside && (kept == 0 || all[i] != all[kept - 1])) all[kept++] = all[i];
    }
  }
  rot_events_free(&events);
  *edges = all;
  *count = kept;
  return status;
}

/* Scale below which heat and impulses are rounding: kinetic energy and momentum of the motion. */
static rot_status min_of(exact *x, size_t n, const double t[], rot_store *store, double min[]) {
  solution s;
  actions a;
  rot_info info;
  rot_events events = {0};
  rot_status status = solve(x, n, t, store, &events, &s, &info);
  if (status == ROT_OK) status = act(x, &s, n, t, store, &a);
  double energy = 0.0, momentum = 0.0;
  for (size_t row = 0; row < n && status == ROT_OK; row++) {
    double e = 0.0, l = 0.0;
    for (size_t i = 0; i < x->u.n; i++) {
      const double inertia = x->scene->rotor[i].linear.inertia_kg_m2, w = a.omega[i * n + row];
      e += inertia * w * w;
      l += inertia * fabs(w);
    }
    energy = fmax(energy, e);
    momentum = fmax(momentum, l);
  }
  for (size_t k = 0; k < width_of(x); k++) {
    const int impulse = k == TORQUE || k == RESISTANCE || k == HOUSING;
    min[k] = impulse ? momentum : energy;
    if (!isfinite(min[k])) min[k] = 0.0;
  }
  rot_events_free(&events);
  return status;
}

/* times => integrals since the start, by adaptive quadrature. */
static rot_status integrate(exact *x, size_t n, const double t[], rot_store *store,
                            integrals *out) {
  const size_t width = width_of(x);
  double *edges, *min = rot_store_get(store, width, sizeof *min);
  size_t count = 0;
  out->value = rot_store_get(store, n, width * sizeof(double));
  out->error = rot_store_get(store, width, sizeof(double));
  out->size = rot_store_get(store, width, sizeof(double));
  if (!min || !out->value || !out->error || !out->size) return ROT_ENOMEM;
  rot_status status = edges_of(x, n, t, store, &edges, &count);
  if (status != ROT_OK || count < 2) return status;
  double *value = rot_store_get(store, count, width * sizeof *value);
  if (!value) return ROT_ENOMEM;
  status = min_of(x, count, edges, store, min);
  const rot_panels panels = {.width = width,
                             .n = count - 1,
                             .edge_s = edges,
                             .min = min,
                             .value = value + width,
                             .error = out->error,
                             .size = out->size};
  if (status == ROT_OK) status = rot_panels_integrate(&panels, rates, x);
  if (status != ROT_OK) return status;
  size_t start = 0;
  for (size_t i = 1; i < count; i++) {
    if (edges[i] <= x->scene->start_s) start = i;
    for (size_t k = 0; k < width; k++) value[i * width + k] += value[(i - 1) * width + k];
  }
  for (size_t row = 0, i = 0; row < n; row++) {
    while (edges[i] < t[row]) i++;
    for (size_t k = 0; k < width; k++) {
      out->value[row * width + k] = value[i * width + k] - value[start * width + k];
    }
  }
  return ROT_OK;
}

/* ---- rows ------------------------------------------------------------------------------------ */

/* Measures. Errors: those of the coordinates over the smallest ratio. Largest values: of the rows
 * and the start, or of the fastest rotor of a single unit. */
static void measure(const exact *x, size_t n, const actions *a, const rot_info *of,
                    rot_info *info) {
  const rot_drive_units *u = &x->u;
  double scale = INFINITY, largest = 0.0;
  for (size_t i = 0; i < u->n; i++) {
    const rot_axle_params *r = &x->scene->rotor[i].linear;
    scale = fmin(scale, fabs(u->ratio[i]));
    rot_note_state(info, r->theta0_rad, r->omega0_rad_per_s);
    for (size_t row = 0; row < n; row++) {
      rot_note_state(info, a->theta[i * n + row], a->omega[i * n + row]);
    }
  }
  rot_measure *theta = &info->measure[ROT_THETA], *omega = &info->measure[ROT_OMEGA];
  if (u->m == 1) largest = of->measure[ROT_OMEGA].largest / scale;
  omega->largest = fmax(omega->largest, largest);
  theta->error = of->measure[ROT_THETA].error / scale + 8.0 * ROT_EPS * theta->largest;
  omega->error = of->measure[ROT_OMEGA].error / scale + 8.0 * ROT_EPS * omega->largest;
}

static int is_lossy(const exact *x) {
  for (size_t i = 0; i < x->u.n; i++) {
    if (x->scene->rotor[i].viscous_n_m_s != 0.0) return 1;
    if (i + 1 < x->u.n && x->scene->coupling[i].damping_n_m_s != 0.0) return 1;
  }
  return 0;
}

/* (motion, torques) => columns. heat: integrals; NULL: only a clutch dissipates. */
static void write_rows(const exact *x, size_t n, const solution *s, const actions *a,
                       const integrals *heat, const rot_drive_columns *out) {
  const size_t rotors = x->u.n, width = width_of(x);
  for (size_t row = 0; row < n; row++) {
    for (size_t i = 0; i < rotors; i++) {
      const size_t at = row * rotors + i, from = i * n + row;
      const double omega = a->omega[from], inertia = x->scene->rotor[i].linear.inertia_kg_m2;
      const int last = i + 1 == rotors;
      const int clutch = !last && x->scene->coupling[i].kind == ROT_DRIVE_CLUTCH;
      const double *sum = heat ? heat->value + row * width + ROTORS : NULL;
      out->theta_rad[at] = a->theta[from];
      out->omega_rad_per_s[at] = omega;
      out->angular_momentum_kg_m2_per_s[at] = inertia * omega;
      out->rotational_kinetic_energy_j[at] = 0.5 * inertia * omega * omega;
      out->applied_torque_n_m[at] = a->applied[from];
      out->damping_torque_n_m[at] = 0.0 + a->damping[from]; /* no -0 */
      out->coupling_torque_n_m[at] = last ? (double)NAN : a->torque[from];
      out->locked[at] = last ? -1 : clutch && s->locked ? s->locked[row] : 0;
      out->heat_j[at] = sum ? sum[i] : 0.0;
      out->coupling_heat_j[at] = last                ? (double)NAN
                                 : clutch && s->heat ? s->heat[row]
                                 : sum               ? sum[rotors + i]
                                                     : 0.0;
    }
  }
}

/* integrals => ledger, its errors. */
static void write_ledger(const exact *x, size_t n, const double t[], const integrals *sums,
                         const rot_info *info, rot_drive_ledger *out) {
  const size_t rotors = x->u.n, width = width_of(x);
  for (size_t row = 0; row < n; row++) {
    const double *f = sums->value + row * width;
    double of[3] = {0.0, 0.0, 0.0}; /* shafts, clutches, gears: order of rot_drive_kind */
    double rotor = 0.0;
    for (size_t i = 0; i < rotors; i++) rotor += f[ROTORS + i];
    for (size_t i = 0; i + 1 < rotors; i++) {
      of[x->scene->coupling[i].kind] += f[ROTORS + rotors + i];
    }
    out->work_j[row] = f[WORK];
    out->resistance_j[row] = rotor;
    out->brake_j[row] = out->mesh_j[row] = 0.0;
    out->damper_j[row] = of[ROT_DRIVE_SHAFT];
    out->clutch_j[row] = of[ROT_DRIVE_CLUTCH];
    out->torque_impulse_n_m_s[row] = f[TORQUE];
    out->resistance_impulse_n_m_s[row] = f[RESISTANCE];
    out->housing_impulse_n_m_s[row] = f[HOUSING];
  }
  const double start = x->scene->start_s, error = rot_info_error(info);
  const double span = n ? fmax(t[n - 1], start) - fmin(t[0], start) : 0.0;
  const double theta = info->measure[ROT_THETA].error, omega = info->measure[ROT_OMEGA].error;
  double heat = 0.0, impulse = 0.0, work = 0.0;
  for (size_t k = 0; k < width; k++) {
    const double off = sums->error[k] + (1e-14 + 3.0 * error) * sums->size[k];
    *(k == WORK ? &work : k < ROTORS ? &impulse : &heat) += off;
  }
  /* The relative error of the torque of a stiff shaft may exceed that of the motion. */
  for (size_t i = 0; i + 1 < rotors; i++) {
    const rot_drive_coupling *c = &x->scene->coupling[i];
    impulse += span * fabs(c->ratio - 1.0) * (1.0 + fabs(c->ratio)) *
               (c->stiffness_n_m_per_rad * theta + c->damping_n_m_s * omega);
  }
  out->work_error_j = work;
  out->heat_error_j = heat;
  out->impulse_error_n_m_s = impulse;
  out->twist_error_rad = 2.0 * theta;
}

/* Events of the clutch, at its coupling. */
static rot_status place_events(const exact *x, const rot_events *found, rot_events *events) {
  const int where = x->u.m > 1 ? -(int)(x->u.between[0] + 1) : 1;
  for (size_t i = 0; i < found->count; i++) {
    if (x->form != ROT_DRIVE_AS_CLUTCH) continue;
    const rot_status status = rot_events_add_at(events, found->time_s[i], found->event[i], where);
    if (status != ROT_OK) return status;
  }
  return ROT_OK;
}

/* Motion of the units, of the rotors, integrals, rows. */
rot_status rot_drive_exact(const rot_drive_scene *scene, rot_drive_form form, size_t n,
                           const double time_s[], const rot_drive_columns *out,
                           rot_drive_ledger *ledger, rot_events *events, const rot_hooks *hooks,
                           rot_info *info) {
  exact x = {.scene = scene, .form = form, .hooks = hooks};
  const rot_query query = {n, time_s, 1e-12, 0.0};
  rot_store store = {0};
  rot_events found = {0};
  solution s;
  actions a;
  integrals sums = {NULL, NULL, NULL};
  rot_info of;
  rot_info_clear(info, rot_turning);
  rot_info_clear(&of, rot_turning);
  rot_status status = open_form(&x, &query, &store);
  if (status == ROT_OK) status = solve(&x, n, time_s, &store, &found, &s, &of);
  if (status == ROT_OK) status = act(&x, &s, n, time_s, &store, &a);
  const int integrates = status == ROT_OK && n && (ledger || is_lossy(&x));
  if (status == ROT_OK) {
    measure(&x, n, &a, &of, info);
    if (integrates) status = integrate(&x, n, time_s, &store, &sums);
  }
  if (status == ROT_OK) {
    write_rows(&x, n, &s, &a, integrates && is_lossy(&x) ? &sums : NULL, out);
    if (integrates && ledger) {
      write_ledger(&x, n, time_s, &sums, info, ledger);
      rot_drive_elastic(scene, n, out, info, ledger);
    }
    status = place_events(&x, &found, events);
  }
  info->status = status;
  info->time_s = of.time_s;
  info->rows_done = status == ROT_OK ? n : 0;
  rot_events_free(&found);
  rot_store_free(&store);
  return status;
}
