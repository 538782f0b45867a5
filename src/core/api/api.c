#include "api/api.h"

#include <float.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "api/structs.h"
#include "scene/axle/bands.h"
#include "scene/axle/closed.h"
#include "scene/axle/drag.h"
#include "scene/axle/drop.h"
#include "scene/axle/models.h"
#include "scene/axle/ode.h"
#include "scene/axle/sweep.h"
#include "scene/choice.h"
#include "tables/energy.h"
#include "ground/gsl.h"
#include "body/inertia.h"
#include "scene/pivot/precession.h"
#include "tables/rolling.h"
#include "ground/search.h"
#include "body/shapes.h"

/* ---- statuses -------------------------------------------------------------------------------- */

static const char *const status_texts[] = {
    "ok",
    "out of memory",
    "an argument is not possible",
    "the motion leaves the range of double precision",
    "the torque function gave no finite number",
    "the step budget is used up",
    "the step fell below the resolution of time",
    "stopped by the caller",
    "there is no such model, or it does not take the scene",
    "no model reaches the accuracy",
    "there is no such shape, scene, input or column",
    "the end of the list",
    "a fault of the library",
};

const char *rotdyn_status_text(int status) {
  const int n = (int)(sizeof status_texts / sizeof *status_texts);
  return status >= 0 && status < n ? status_texts[status] : "unknown status";
}

const char *rotdyn_version(void) { return ROTDYN_VERSION; }

typedef struct reason {
  char text[sizeof((rotdyn_info *)NULL)->reason];
} reason;

static rotdyn_status refuse(reason *why, const char *text) {
  (void)snprintf(why->text, sizeof why->text, "%s", text);
  return ROTDYN_EARGUMENT;
}

static rotdyn_status refuse_row(reason *why, const char *what, size_t row) {
  (void)snprintf(why->text, sizeof why->text, "%s in row %zu", what, row);
  return ROTDYN_EARGUMENT;
}

/* ---- rolling, energies, shapes, models ------------------------------------------------------- */

/* NaN outside the domain, as for NaN. */
static double within(double x, double lo, double hi) { return x >= lo && x <= hi ? x : NAN; }

static double from_0(double x) { return within(x, 0.0, INFINITY); }

double rotdyn_rolling_acceleration(double beta, double angle_deg, double gravity) {
  return rot_rolling_acceleration(from_0(beta), within(angle_deg, -90.0, 90.0), from_0(gravity));
}

double rotdyn_rolling_final_speed(double beta, double height_m, double gravity) {
  return rot_rolling_final_speed(from_0(beta), from_0(height_m), from_0(gravity));
}

double rotdyn_rolling_rotational_fraction(double beta) {
  return rot_rolling_rotational_fraction(from_0(beta));
}

double rotdyn_rolling_translational_fraction(double beta) {
  return rot_rolling_translational_fraction(from_0(beta));
}

double rotdyn_rolling_friction(double beta, double angle_deg) {
  return rot_rolling_friction(from_0(beta), within(angle_deg, -90.0, 90.0));
}

int rotdyn_rolling_energies(double mass_kg, double radius_m, double beta, double speed_m_per_s,
                            rotdyn_energies *out) {
  rotdyn_energies e = {0};
  const rot_energy_input in = {{&mass_kg, 0}, {&radius_m, 0}, {&beta, 0}, {&speed_m_per_s, 0}};
  const rot_energy_output to = {&e.inertia_kg_m2, &e.omega_rad_per_s, &e.translational_j,
                                &e.rotational_j, &e.total_j};
  if (!out || mass_kg < 0.0 || beta < 0.0 || radius_m <= 0.0) return ROTDYN_EARGUMENT;
  rot_energy_partition(1, &in, &to);
  return rot_api_give(&e, sizeof e, out) ? ROTDYN_OK : ROTDYN_EARGUMENT;
}

int rotdyn_precession_rates(const rotdyn_top *top, rotdyn_top_rates *out) {
  rotdyn_top t;
  rotdyn_top_rates r = {0};
  if (!out || !rot_api_take(top, sizeof t, &t)) return ROTDYN_EARGUMENT;
  const int known = t.transverse_kg_m2 != 0.0;
  if (t.mass_kg < 0.0 || t.gravity_m_per_s2 < 0.0 || t.axial_kg_m2 <= 0.0 ||
      t.spin_rad_per_s == 0.0 || t.axis_angle_deg < 0.0 || t.axis_angle_deg > 180.0 ||
      (known && t.transverse_kg_m2 < t.axial_kg_m2 / 2.0 * (1.0 - 1e-9))) {
    return ROTDYN_EARGUMENT;
  }
  const rot_precession_input in = {t.mass_kg,
                                   t.lever_arm_m,
                                   t.axial_kg_m2,
                                   t.spin_rad_per_s,
                                   known ? t.transverse_kg_m2 : NAN,
                                   t.axis_angle_deg,
                                   t.gravity_m_per_s2};
  const rot_precession p = rot_precession_of(&in);
  r.torque_n_m = p.torque_n_m;
  r.momentum_kg_m2_per_s = p.momentum_kg_m2_per_s;
  r.precession_rad_per_s = p.rate_rad_per_s;
  r.period_s = p.period_s;
  r.slow_rad_per_s = p.slow_rad_per_s;
  r.fast_rad_per_s = p.fast_rad_per_s;
  r.formula_error = p.error;
  r.nutation_period_s = p.nutation_s;
  r.lowest_angle_deg = p.lowest_deg;
  r.mean_precession_rad_per_s = p.mean_rad_per_s;
  return rot_api_give(&r, sizeof r, out) ? ROTDYN_OK : ROTDYN_EARGUMENT;
}

int rotdyn_shape_at(size_t i, rotdyn_shape *out) {
  rotdyn_shape s = {0};
  if (!out) return ROTDYN_EARGUMENT;
  if (i >= rot_shape_count()) return ROTDYN_EEND;
  const rot_shape *shape = rot_shape_at(i);
  s.name = shape->name;
  s.dimension = shape->dimension;
  s.n_sizes = (size_t)shape->sizes;
  for (int k = 0; k < shape->sizes; k++) s.size_name[k] = rot_size_at((int)shape->size[k])->name;
  return rot_api_give(&s, sizeof s, out) ? ROTDYN_OK : ROTDYN_EARGUMENT;
}

int rotdyn_shape_moments(const char *shape, double mass_kg, size_t n_sizes, const double *sizes,
                         rotdyn_moments *out) {
  size_t i = 0, row;
  int slot;
  if (!shape || !out || (n_sizes && !sizes)) return ROTDYN_EARGUMENT;
  while (i < rot_shape_count() && strcmp(rot_shape_at(i)->name, shape)) i++;
  if (i == rot_shape_count()) return ROTDYN_ENAME;
  const rot_shape *found = rot_shape_at(i);
  if (n_sizes != (size_t)found->sizes || mass_kg < 0.0) return ROTDYN_EARGUMENT;
  if (rot_shape_check(found, sizes, &slot) != ROT_SHAPE_FITS) return ROTDYN_EARGUMENT;
  rotdyn_moments m = {0};
  rot_shape_body body;
  rot_shape_make(found, mass_kg, 0, sizes, &body);
  /* The table has one rounding less in its moments. */
  const int at = (int)i;
  double column[ROT_SHAPE_COLUMNS], *to[ROT_SHAPE_COLUMNS];
  rot_shape_rows rows = {&at, 0, {&mass_kg, 0}, {&mass_kg, 0}, {{NULL, 0}}};
  for (int k = 0; k < ROT_SHAPE_COLUMNS; k++) to[k] = &column[k];
  for (int k = 0; k < ROT_SIZE_COUNT; k++) rows.size[k] = (rot_column){&mass_kg, 0};
  for (int k = 0; k < found->sizes; k++) rows.size[found->size[k]] = (rot_column){&sizes[k], 0};
  if (rot_shapes_table(1, &rows, to, &row, &slot) != ROT_SHAPE_FITS) return ROTDYN_EARGUMENT;
  m.mass_kg = mass_kg;
  m.moment_kg_m2 = column[ROT_SHAPE_MOMENT];
  m.ixx_kg_m2 = column[ROT_SHAPE_IXX];
  m.iyy_kg_m2 = column[ROT_SHAPE_IYY];
  m.izz_kg_m2 = column[ROT_SHAPE_IZZ];
  m.ixy_kg_m2 = 0.0 - body.second_kg_m2[ROT_XY];
  m.beta = column[ROT_SHAPE_ROLLS];
  m.gyration_m = column[ROT_SHAPE_GYRATION];
  memcpy(m.centre_m, body.centre_m, sizeof m.centre_m);
  m.error = body.error;
  return rot_api_give(&m, sizeof m, out) ? ROTDYN_OK : ROTDYN_EARGUMENT;
}

int rotdyn_model_at(size_t i, rotdyn_model *out) {
  size_t n;
  const rot_constraint *const *list = rot_choice_constraints(&n);
  if (!out) return ROTDYN_EARGUMENT;
  for (size_t k = 0; k < n; i -= list[k]->n_models, k++) {
    if (i >= list[k]->n_models) continue;
    const rot_model *model = &list[k]->models[i];
    rotdyn_model m = {0};
    m.model = model->id;
    m.constraint = list[k]->id;
    m.why = model->why;
    m.error = model->promise;
    m.error_is_bound = model->error_kind == ROT_BOUND;
    return rot_api_give(&m, sizeof m, out) ? ROTDYN_OK : ROTDYN_EARGUMENT;
  }
  return ROTDYN_EEND;
}

/* ---- a scene on an axle ---------------------------------------------------------------------- */

/* The caller's functions. */
typedef struct calls {
  rotdyn_torque_fn torque;
  void *torque_context;
  rotdyn_poll_fn poll;
  void *poll_context;
} calls;

static rot_status call_torque(double t, double theta, double omega, double *torque, void *ctx) {
  const calls *c = ctx;
  return c->torque(t, theta, omega, torque, c->torque_context) ? ROT_EUNWIND : ROT_OK;
}

static rot_status call_poll(void *ctx, double fraction) {
  const calls *c = ctx;
  return c->poll && c->poll(c->poll_context, fraction) ? ROT_EUNWIND : ROT_OK;
}

typedef struct job {
  rot_axle_scene scene;   /* as described */
  rot_axle_scene reduced; /* without what is dropped */
  rot_term *terms, *fewer;
  double *breaks_s;
  size_t n_own; /* breaks of the caller */
  const double *own_s;
  rotdyn_options options;
  rot_query query;
  calls calls;
  rot_hooks hooks;
  reason why;
} job;

static rotdyn_status read_term(const rotdyn_term *from, rot_term *to, reason *why) {
  rotdyn_term term;
  if (!rot_api_take(from, sizeof term, &term)) return refuse(why, "a term has a wrong size");
  if (!term.kind || !term.x) return refuse(why, "a term has no kind or no numbers");
  const int always = term.from_s == 0.0 && term.to_s == 0.0;
  to->kind = rot_term_named(term.kind);
  to->from_s = always ? -INFINITY : term.from_s;
  to->to_s = always ? INFINITY : term.to_s;
  to->length = term.n_x;
  to->x = term.x;
  if (to->kind == ROT_TERM_KINDS) return refuse(why, "there is no term of this kind");
  if (!(to->from_s < to->to_s)) return refuse(why, "a term must begin before it ends");
  if (!rot_api_finite(term.n_x, term.x) || !rot_term_valid(to)) {
    return refuse(why, "the numbers of a term do not fit its kind, or are not finite");
  }
  return ROTDYN_OK;
}

static rotdyn_status read_terms(const rotdyn_axle *axle, job *j) {
  const unsigned char *at = (const unsigned char *)axle->terms;
  size_t stride = 0;
  rotdyn_status status = ROTDYN_OK;
  if (axle->n_terms == 0) return ROTDYN_OK;
  if (!at) return refuse(&j->why, "`terms` is NULL");
  memcpy(&stride, at, sizeof stride);
  if (axle->n_terms >= SIZE_MAX / sizeof *j->terms / 2) return ROTDYN_EMEMORY;
  j->terms = malloc(axle->n_terms * sizeof *j->terms);
  if (!j->terms) return ROTDYN_EMEMORY;
  for (size_t i = 0; i < axle->n_terms && status == ROTDYN_OK; i++) {
    status = read_term((const void *)(at + i * stride), &j->terms[i], &j->why);
  }
  j->scene.n_terms = axle->n_terms;
  j->scene.terms = j->terms;
  return status;
}

static rotdyn_status read_inertia(const rotdyn_axle *axle, job *j) {
  rot_axle_scene *s = &j->scene;
  s->linear.inertia_kg_m2 = axle->inertia_kg_m2;
  if (axle->n_inertia) {
    const double *x = axle->inertia_knots_kg_m2;
    if (axle->n_inertia < 2 || !x || !rot_api_times(axle->n_inertia, axle->inertia_time_s)) {
      return refuse(&j->why, "a changing inertia needs two knots or more, not going back in time");
    }
    for (size_t i = 0; i < axle->n_inertia; i++) {
      if (!(x[i] > 0.0 && x[i] < INFINITY)) {
        return refuse(&j->why, "a moment of inertia must be greater than 0 and finite");
      }
    }
    s->n_inertia = axle->n_inertia;
    s->inertia_time_s = axle->inertia_time_s;
    s->inertia_kg_m2 = x;
    s->linear.inertia_kg_m2 = rot_axle_scene_inertia(s, axle->start_s);
  }
  if (!(s->linear.inertia_kg_m2 > 0.0 && s->linear.inertia_kg_m2 < INFINITY)) {
    return refuse(&j->why, "`inertia_kg_m2` must be greater than 0 and finite");
  }
  return ROTDYN_OK;
}

static rotdyn_status read_torque(const rotdyn_axle *axle, job *j) {
  rot_torque *torque = &j->scene.linear.torque;
  torque->n = axle->n_knots;
  torque->time_s = axle->knot_time_s;
  torque->torque_n_m = axle->knot_torque_n_m;
  torque->before_n_m = axle->before_n_m;
  torque->after_n_m = axle->after_n_m;
  if (!isfinite(axle->before_n_m) || !isfinite(axle->after_n_m)) {
    return refuse(&j->why, "a torque is not finite");
  }
  if (axle->n_knots == 0 && axle->before_n_m != axle->after_n_m) {
    return refuse(&j->why, "without knots `before_n_m` and `after_n_m` must be equal");
  }
  if (axle->n_knots &&
      (!axle->knot_torque_n_m || !rot_api_times(axle->n_knots, axle->knot_time_s) ||
       !rot_api_finite(axle->n_knots, axle->knot_torque_n_m))) {
    return refuse(&j->why, "knots must be finite and not go back in time");
  }
  if (axle->torque) {
    torque->call = call_torque;
    torque->ctx = &j->calls;
  }
  return ROTDYN_OK;
}

/* All breaks of a scene: the caller's first. */
static rotdyn_status collect_breaks(job *j, rot_axle_scene *scene) {
  scene->n_breaks = j->n_own;
  scene->breaks_s = j->own_s;
  free(j->breaks_s);
  j->breaks_s = malloc(rot_axle_scene_room(scene) * sizeof *j->breaks_s);
  if (!j->breaks_s) return ROTDYN_EMEMORY;
  scene->n_breaks = rot_axle_scene_breaks(scene, j->breaks_s);
  scene->breaks_s = j->breaks_s;
  return ROTDYN_OK;
}

static rotdyn_status read_axle(const rotdyn_axle *from, job *j) {
  rotdyn_axle axle;
  rot_axle_scene *s = &j->scene;
  if (!rot_api_take(from, sizeof axle, &axle)) {
    return refuse(&j->why,
                  "the axle is NULL, or its size or a member beyond this version is wrong");
  }
  const double numbers[] = {axle.start_s,       axle.theta0_rad,  axle.omega0_rad_per_s,
                            axle.viscous_n_m_s, axle.motor_n_m_s, axle.quadratic_n_m_s2,
                            axle.coulomb_n_m,   axle.static_n_m};
  if (!rot_api_finite(sizeof numbers / sizeof *numbers, numbers)) {
    return refuse(&j->why, "a number of the axle is not finite");
  }
  if (axle.static_n_m == 0.0) axle.static_n_m = axle.coulomb_n_m;
  if (axle.quadratic_n_m_s2 < 0.0 || axle.coulomb_n_m < 0.0 || axle.static_n_m < axle.coulomb_n_m) {
    return refuse(&j->why, "quadratic drag and friction must not be negative, static friction not "
                           "less than sliding friction");
  }
  s->linear.start_s = axle.start_s;
  s->linear.theta0_rad = axle.theta0_rad;
  s->linear.omega0_rad_per_s = axle.omega0_rad_per_s;
  s->viscous_n_m_s = axle.viscous_n_m_s;
  s->motor_n_m_s = axle.motor_n_m_s;
  s->linear.viscous_n_m_s = axle.viscous_n_m_s + axle.motor_n_m_s;
  s->quadratic_n_m_s2 = axle.quadratic_n_m_s2;
  s->coulomb_n_m = axle.coulomb_n_m;
  s->static_n_m = axle.static_n_m;
  j->calls.torque = axle.torque;
  j->calls.torque_context = axle.torque_context;
  j->n_own = axle.n_breaks;
  j->own_s = axle.breaks_s;
  if (!rot_api_times(axle.n_breaks, axle.breaks_s)) {
    return refuse(&j->why, "breaks must be finite and not go back in time");
  }
  rotdyn_status status = read_torque(&axle, j);
  if (status == ROTDYN_OK) status = read_inertia(&axle, j);
  if (status == ROTDYN_OK) status = read_terms(&axle, j);
  if (status == ROTDYN_OK) status = collect_breaks(j, s);
  return status;
}

static rotdyn_status read_options(const rotdyn_options *from, job *j) {
  const char *fault = rot_api_options(from, &j->options);
  if (fault) return refuse(&j->why, fault);
  j->calls.poll = j->options.poll;
  j->calls.poll_context = j->options.poll_context;
  j->hooks.poll = call_poll;
  j->hooks.ctx = &j->calls;
  return ROTDYN_OK;
}

static rotdyn_status open_job(const rotdyn_axle *axle, size_t n, const double time_s[],
                              const rotdyn_options *options, job *j) {
  memset(j, 0, sizeof *j);
  rotdyn_status status = read_options(options, j);
  if (status == ROTDYN_OK) status = read_axle(axle, j);
  if (status != ROTDYN_OK) return status;
  const double start = j->scene.linear.start_s;
  if (!rot_api_times(n, time_s) ||
      (n && (!isfinite(time_s[0] - start) || !isfinite(time_s[n - 1] - start)))) {
    return refuse(&j->why, "times must be finite and not decrease");
  }
  j->query.n = n;
  j->query.time_s = time_s;
  j->query.accuracy = j->options.accuracy;
  j->query.law_s = j->options.torque_call_s;
  return ROTDYN_OK;
}

static void close_job(job *j) {
  free(j->terms);
  free(j->fewer);
  free(j->breaks_s);
}

/* ---- the choice ------------------------------------------------------------------------------ */

/* The model asked for, or the cheapest that applies; none of the axle's is on trial. */
static rotdyn_status select_model(job *j, rot_candidate *out) {
  rot_candidate picked[ROT_MOST_MODELS];
  if (j->options.model) {
    const rot_model *model = rot_choice_model(&rot_axle_constraint, j->options.model);
    if (!model) {
      (void)refuse(&j->why, "there is no model of the axle of this name");
      return ROTDYN_EMODEL;
    }
    rot_choice_judge(&rot_axle_constraint, model, &j->scene, &j->query, out);
    if (!out->applies) {
      rot_choice_reason(&rot_axle_constraint, out, sizeof j->why.text, j->why.text);
      return ROTDYN_EMODEL;
    }
    return ROTDYN_OK;
  }
  if (rot_choice_pick(&rot_axle_constraint, &j->scene, &j->query, picked) == 0) {
    return rot_api_none_fits(&rot_axle_constraint, &j->scene, &j->query, sizeof j->why.text,
                             j->why.text);
  }
  *out = picked[0];
  return ROTDYN_OK;
}

int rotdyn_axle_candidate(const rotdyn_axle *axle, size_t n, const double *time_s,
                          const rotdyn_options *options, size_t k, rotdyn_candidate *out) {
  job j;
  rot_candidate all[ROT_MOST_MODELS];
  rotdyn_status status = open_job(axle, n, time_s, options, &j);
  if (status == ROTDYN_OK && !out) status = ROTDYN_EARGUMENT;
  if (status == ROTDYN_OK) {
    const size_t count = rot_choice_candidates(&rot_axle_constraint, &j.scene, &j.query, all);
    status = k < count ? rot_api_candidate(&rot_axle_constraint, &all[k], out) : ROTDYN_EEND;
  }
  close_job(&j);
  return (int)status;
}

int rotdyn_axle_choose(const rotdyn_axle *axle, size_t n, const double *time_s,
                       const rotdyn_options *options, rotdyn_candidate *out) {
  job j;
  rot_candidate chosen;
  rotdyn_status status = open_job(axle, n, time_s, options, &j);
  if (status == ROTDYN_OK && !out) status = ROTDYN_EARGUMENT;
  if (status == ROTDYN_OK) status = select_model(&j, &chosen);
  if (status == ROTDYN_OK) status = rot_api_candidate(&rot_axle_constraint, &chosen, out);
  close_job(&j);
  return (int)status;
}

/* ---- rows ------------------------------------------------------------------------------------ */

enum { COLUMNS = 7, ON_THE_WAY = 256 };

/* Columns that the caller does not want are written to memory that is freed. */
static rotdyn_status open_columns(const rotdyn_axle_columns *from, size_t n, rot_axle_columns *to,
                                  double **scratch) {
  rotdyn_axle_columns given;
  if (!rot_api_take(from, sizeof given, &given)) return ROTDYN_EARGUMENT;
  size_t missing = 0, at = 0;
#define X(type, name) missing += given.name == NULL;
  ROT_AXLE_COLUMNS(X)
#undef X
  if (n > SIZE_MAX / sizeof(double) / COLUMNS) return ROTDYN_EMEMORY;
  if (missing) {
    *scratch = malloc((n ? n : 1) * missing * sizeof **scratch);
    if (!*scratch) return ROTDYN_EMEMORY;
  }
#define X(type, name) to->name = given.name ? given.name : *scratch + n * at++;
  ROT_AXLE_COLUMNS(X)
#undef X
  return ROTDYN_OK;
}

static rot_status run_model(const job *j, const rot_candidate *c, size_t n, const double time_s[],
                            const rot_axle_columns *out, rot_events *events, rot_info *info) {
  const rot_axle_model closed = rot_axle_closed_form(c->model->id);
  if (closed) return closed(&j->reduced, n, time_s, out, events, &j->hooks, info);
  const double most = fmin(j->options.max_steps, 1e15);
  rot_axle_ode_options options = {j->options.accuracy, (size_t)most + n, ROT_METHOD_NONE, 0.0};
  rot_axle_ledger ledger;
  if (j->options.model) {
    options.method = strcmp(c->model->id, "axle_radau") ? ROT_METHOD_RK8PD : ROT_METHOD_RADAU;
  }
  return rot_axle_integrate(&j->reduced, &options, n, time_s, out, events, &ledger, &j->hooks,
                            info);
}

/* The largest values at more times, unevenly spaced: those of the rows may be far below them. */
static void measure_on_the_way(const job *j, const rot_candidate *c, rot_info *info) {
  const rot_query *q = &j->query;
  const double from = fmin(j->scene.linear.start_s, q->time_s[0]);
  const double to = fmax(j->scene.linear.start_s, q->time_s[q->n - 1]);
  double time_s[ON_THE_WAY], column[COLUMNS][ON_THE_WAY];
  const rot_axle_columns out = {column[0], column[1], column[2], column[3],
                                column[4], column[5], column[6]};
  rot_events events = {0, 0, NULL, NULL};
  rot_info more;
  for (int i = 0; i < ON_THE_WAY; i++) {
    const double part = fmod((i + 1) * 0.6180339887498949, 1.0);
    int k = i;
    for (; k > 0 && time_s[k - 1] > part; k--) time_s[k] = time_s[k - 1];
    time_s[k] = part;
  }
  for (int i = 0; i < ON_THE_WAY; i++) time_s[i] = from + (to - from) * time_s[i];
  if (run_model(j, c, ON_THE_WAY, time_s, &out, &events, &more) == ROT_OK) {
    for (size_t i = 0; i < info->n_measures; i++) {
      info->measure[i].largest = fmax(info->measure[i].largest, more.measure[i].largest);
    }
  }
  rot_events_free(&events);
}

static void report(const rot_info *from, double error, rotdyn_info *to) {
  const rot_measure *theta = &from->measure[ROT_THETA], *omega = &from->measure[ROT_OMEGA];
  to->rows_done = from->rows_done;
  to->time_s = from->time_s;
  to->steps = from->steps;
  to->rejected = from->rejected;
  to->torque_calls = from->rhs_calls;
  to->error = error;
  to->theta_error_rad = theta->error;
  to->omega_error_rad_per_s = omega->error;
  to->largest_theta_rad = theta->largest;
  to->largest_omega_rad_per_s = omega->largest;
}

static rotdyn_status run_axle(job *j, const rotdyn_axle_columns *out, rotdyn_info *info,
                              double **scratch) {
  rot_candidate c;
  rot_axle_columns columns;
  rot_events events = {0, 0, NULL, NULL};
  rot_info run;
  const rot_query *q = &j->query;
  rotdyn_status status = open_columns(out, q->n, &columns, scratch);
  if (status == ROTDYN_EARGUMENT) return refuse(&j->why, "`out` is NULL or has a wrong size");
  if (status == ROTDYN_OK) status = select_model(j, &c);
  if (status != ROTDYN_OK) return status;
  info->model = c.model->id;
  info->error_is_bound = c.model->error_kind == ROT_BOUND;
  j->reduced = j->scene;
  if (c.dropped) {
    rot_choice_reason(&rot_axle_constraint, &c, sizeof j->why.text, j->why.text);
    j->fewer = malloc((j->scene.n_terms + 1) * sizeof *j->fewer);
    if (!j->fewer) return ROTDYN_EMEMORY;
    j->reduced = rot_axle_without(&j->scene, c.untaken, j->fewer);
    status = collect_breaks(j, &j->reduced);
    if (status != ROTDYN_OK) return status;
  }
  const rot_status ran = run_model(j, &c, q->n, q->time_s, &columns, &events, &run);
  rot_api_events(&events, j->options.events);
  rot_events_free(&events);
  if (run.method == ROT_METHOD_RADAU) info->model = "axle_radau";
  if (run.method == ROT_METHOD_RK8PD) info->model = "axle_rk8pd";
  double error = rot_info_error(&run);
  if (!rot_axle_scene_plain(&j->reduced, &run)) {
#define X(type, name)                                                                              \
  if (!rot_api_finite(run.rows_done, columns.name)) error = INFINITY;
    ROT_AXLE_COLUMNS(X)
#undef X
  }
  const int beyond = isinf(error);
  if (c.dropped) {
    run.measure[ROT_THETA].error += c.drop.bound[ROT_THETA];
    run.measure[ROT_OMEGA].error += c.drop.bound[ROT_OMEGA];
    rot_axle_scene_torques(&j->scene, run.rows_done, q->time_s, columns.theta_rad,
                           columns.omega_rad_per_s, columns.applied_torque_n_m,
                           columns.damping_torque_n_m, columns.net_torque_n_m);
  }
  if (!beyond) error = rot_info_error(&run);
  if (ran == ROT_OK && q->n && !beyond && c.model->error_kind != ROT_ADAPTIVE &&
      (error > 1e-13 || error > q->accuracy)) {
    measure_on_the_way(j, &c, &run);
    error = rot_info_error(&run);
  }
  report(&run, error, info);
  return ran != ROT_OK ? rot_api_status(ran) : isnan(error) ? ROTDYN_ERANGE : ROTDYN_OK;
}

/* The report, with the reason; its struct may be too small to be one. */
static int finish(rotdyn_status status, const job *j, rotdyn_info *local, rotdyn_info *info) {
  local->status = (int)status;
  memcpy(local->reason, j->why.text, sizeof local->reason);
  return rot_api_give(local, sizeof *local, info) ? (int)status : ROTDYN_EARGUMENT;
}

int rotdyn_axle_rows(const rotdyn_axle *axle, size_t n, const double *time_s,
                     const rotdyn_options *options, const rotdyn_axle_columns *out,
                     rotdyn_info *info) {
  job j;
  rotdyn_info local;
  double *scratch = NULL;
  memset(&local, 0, sizeof local);
  rotdyn_status status = open_job(axle, n, time_s, options, &j);
  if (status == ROTDYN_OK) status = run_axle(&j, out, &local, &scratch);
  free(scratch);
  close_job(&j);
  return finish(status, &j, &local, info);
}

/* ---- sweep ----------------------------------------------------------------------------------- */

typedef struct sweep {
  rot_axle_sweep_rows rows;
  rot_axle_sweep_columns out;
  double *scratch; /* columns that the caller does not want, the viscous column with a motor */
  int *statuses;
  double least_viscous, most_viscous;
  int scaled;
} sweep;

static rot_column column_or(rotdyn_column column, const double *otherwise) {
  const rot_column out = {column.values ? column.values : otherwise,
                          column.values ? column.step : 0};
  return out;
}

static rotdyn_status check_sweep(job *j, sweep *s) {
  const rot_axle_sweep_rows *r = &s->rows;
  s->least_viscous = INFINITY;
  s->most_viscous = -INFINITY;
  for (size_t i = 0; i < r->n; i++) {
    const double inertia = rot_at(r->inertia_kg_m2, i), c = rot_at(r->viscous_n_m_s, i);
    const double scale = rot_at(r->torque_scale, i), to = rot_at(r->time_s, i);
    if (!(inertia > 0.0 && inertia < INFINITY)) {
      return refuse_row(&j->why, "the moment of inertia must be greater than 0 and finite", i);
    }
    if (!isfinite(c) || !isfinite(scale) || !isfinite(rot_at(r->omega0_rad_per_s, i)) ||
        !isfinite(rot_at(r->theta0_rad, i))) {
      return refuse_row(&j->why, "a number is not finite", i);
    }
    if (!(to >= r->start_s && isfinite(to - r->start_s))) {
      return refuse_row(&j->why, "the time must be finite and not lie before the start", i);
    }
    s->least_viscous = fmin(s->least_viscous, c);
    s->most_viscous = fmax(s->most_viscous, c);
    s->scaled |= scale != 1.0;
  }
  return ROTDYN_OK;
}

static rotdyn_status open_sweep(job *j, size_t n, const rotdyn_sweep_in *in,
                                const rotdyn_sweep_out *out, sweep *s) {
  static const double one = 1.0;
  const rot_axle_params *p = &j->scene.linear;
  rotdyn_sweep_in from;
  rotdyn_sweep_out to;
  size_t missing = 1, at = 1; /* the first column is that of the viscous coefficients */
  if (!rot_api_take(in, sizeof from, &from) || !rot_api_take(out, sizeof to, &to) ||
      !from.time_s.values) {
    return refuse(&j->why, "`in` or `out` has a wrong size, or there are no times");
  }
  s->rows.n = n;
  s->rows.start_s = p->start_s;
  s->rows.time_s = column_or(from.time_s, NULL);
  s->rows.inertia_kg_m2 = column_or(from.inertia_kg_m2, &p->inertia_kg_m2);
  s->rows.viscous_n_m_s = column_or(from.viscous_n_m_s, &j->scene.viscous_n_m_s);
  s->rows.omega0_rad_per_s = column_or(from.omega0_rad_per_s, &p->omega0_rad_per_s);
  s->rows.theta0_rad = column_or(from.theta0_rad, &p->theta0_rad);
  s->rows.torque_scale = column_or(from.torque_scale, &one);
  const rotdyn_status status = check_sweep(j, s);
  if (status != ROTDYN_OK) return status;
  double *const given[] = {to.theta_rad, to.omega_rad_per_s, to.omega_max, to.omega_max_time_s,
                           to.omega_min, to.speed_max,       to.error};
  double **const place[] = {
      &s->out.theta_rad, &s->out.omega_rad_per_s, &s->out.omega_max, &s->out.omega_max_time_s,
      &s->out.omega_min, &s->out.speed_max,       &s->out.error};
  for (int k = 0; k < COLUMNS; k++) missing += given[k] == NULL;
  if (n >= SIZE_MAX / sizeof(double) / (COLUMNS + 1)) return ROTDYN_EMEMORY;
  s->scratch = malloc((n + 1) * missing * sizeof *s->scratch);
  s->statuses = to.status ? NULL : malloc((n + 1) * sizeof *s->statuses);
  if (!s->scratch || (!to.status && !s->statuses)) return ROTDYN_EMEMORY;
  for (int k = 0; k < COLUMNS; k++) *place[k] = given[k] ? given[k] : s->scratch + n * at++;
  s->out.status = to.status ? to.status : s->statuses;
  return ROTDYN_OK;
}

/* The closed form that takes what acts in any of the rows; NULL: "axle_linear". */
static rotdyn_status sweep_model(job *j, const sweep *s, rot_axle_model *model, const char **name) {
  rot_candidate all[ROT_MOST_MODELS];
  rot_axle_scene *scene = &j->scene;
  const int linear = scene->static_n_m == 0.0 && scene->quadratic_n_m_s2 == 0.0 &&
                     scene->n_terms == 0 && !scene->linear.torque.call && scene->n_inertia == 0;
  *model = NULL;
  *name = "axle_linear";
  if (linear) return ROTDYN_OK;
  if (s->scaled && (scene->n_terms || scene->motor_n_m_s != 0.0)) {
    (void)refuse(&j->why, "`torque_scale` is for knots only");
    return ROTDYN_EMODEL;
  }
  scene->viscous_n_m_s = s->least_viscous < 0.0 ? s->least_viscous : s->most_viscous;
  scene->linear.viscous_n_m_s = scene->viscous_n_m_s + scene->motor_n_m_s;
  const rot_query query = {1, &scene->linear.start_s, 1.0, 1e-6};
  const size_t n = rot_choice_candidates(&rot_axle_constraint, scene, &query, all);
  for (size_t i = 0; i < n && scene->n_inertia == 0; i++) {
    if (!all[i].applies || all[i].dropped || all[i].model->error_kind != ROT_BOUND) continue;
    if (!strcmp(all[i].model->id, "axle_free") || !strcmp(all[i].model->id, "axle_linear"))
      continue;
    *name = all[i].model->id;
    *model = rot_axle_closed_form(*name);
    return ROTDYN_OK;
  }
  (void)refuse(&j->why, "no closed form takes these rows: axle_rows() integrates one at a time");
  return ROTDYN_EMODEL;
}

static rotdyn_status run_sweep(job *j, sweep *s, rotdyn_info *info) {
  const rot_axle_scene *scene = &j->scene;
  const int threads = j->options.threads == 0 ? 1 : (int)fmin((double)j->options.threads, 4096.0);
  rot_axle_model model;
  rot_info run;
  const double viscous = scene->viscous_n_m_s;
  const rotdyn_status status = sweep_model(j, s, &model, &info->model);
  if (status != ROTDYN_OK) return status;
  if (s->rows.viscous_n_m_s.values == &scene->viscous_n_m_s)
    s->rows.viscous_n_m_s.values = &viscous;
  rot_status ran;
  if (model) {
    const rot_axle_sweep_friction friction = {
        {&scene->quadratic_n_m_s2, 0}, {&scene->coulomb_n_m, 0}, {&scene->static_n_m, 0}};
    ran = rot_axle_sweep_scenes(model, scene, &s->rows, &friction,
                                model == rot_axle_drag || model == rot_axle_bands, threads, &s->out,
                                &j->hooks, &run);
  } else {
    if (scene->motor_n_m_s != 0.0) { /* part of the torque law: scaled with it */
      for (size_t i = 0; i < s->rows.n; i++) {
        s->scratch[i] =
            rot_at(s->rows.viscous_n_m_s, i) + rot_at(s->rows.torque_scale, i) * scene->motor_n_m_s;
      }
      s->rows.viscous_n_m_s = (rot_column){s->scratch, 1};
    }
    ran = rot_axle_sweep_linear(&scene->linear.torque, &s->rows, threads, &s->out, &j->hooks, &run);
  }
  info->error_is_bound = 1;
  info->rows_done = run.rows_done;
  info->time_s = scene->linear.start_s;
  for (size_t i = 0; i < run.rows_done; i++) {
    s->out.status[i] = (int)rot_api_status((rot_status)s->out.status[i]);
    if (!(s->out.error[i] <= info->error)) info->error = s->out.error[i];
  }
  return rot_api_status(ran);
}

int rotdyn_axle_sweep(const rotdyn_axle *axle, size_t n, const rotdyn_sweep_in *in,
                      const rotdyn_options *options, const rotdyn_sweep_out *out,
                      rotdyn_info *info) {
  job j;
  sweep s;
  rotdyn_info local;
  memset(&local, 0, sizeof local);
  memset(&s, 0, sizeof s);
  rotdyn_status status = open_job(axle, 0, NULL, options, &j);
  if (status == ROTDYN_OK) status = open_sweep(&j, n, in, out, &s);
  if (status == ROTDYN_OK && n) status = run_sweep(&j, &s, &local);
  free(s.scratch);
  free(s.statuses);
  close_job(&j);
  return finish(status, &j, &local, info);
}

/* ---- the table ------------------------------------------------------------------------------- */

const rotdyn_api *rotdyn_get_api(int major) {
  static const rotdyn_api api = {sizeof(rotdyn_api), ROTDYN_API_MAJOR, ROTDYN_API_MINOR,
#define X(result, name, arguments) rotdyn_##name,
                                 ROTDYN_FUNCTIONS(X)
#undef X
  };
  return major == ROTDYN_API_MAJOR ? &api : NULL;
}

/* In a library nobody calls R's initialiser. */
#if defined ROTDYN_BUILD && defined __GNUC__
__attribute__((constructor)) static void load(void) { rot_gsl_begin(); }
#endif
