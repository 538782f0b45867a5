#include "api/api.h"

#include <float.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "api/object.h"
#include "api/structs.h"
#include "scene/axle/bands.h"
#include "scene/axle/linear.h"
#include "scene/axle/drag.h"
#include "scene/axle/models.h"
#include "scene/axle/sweep.h"
#include "scene/choice.h"
#include "tables/energy.h"
#include "ground/gsl.h"
#include "body/inertia.h"
#include "scene/pivot/precession.h"
#include "tables/rolling.h"
#include "body/shapes.h"

/* ---- statuses -------------------------------------------------------------------------------- */

static const char *const status_texts[] = {
    "ok",
    "out of memory",
    "an argument is not possible",
    "the motion leaves the range of double precision",
    "the torque function gave no finite number",
    "the step budget does not suffice",
    "the step fell below the resolution of time",
    "stopped by the caller",
    "there is no such model, or it does not take the scene",
    "no model reaches the accuracy",
    "there is no such shape, object, input or column",
    "the end of the list",
    "a fault of the library",
};

const char *rotdyn_status_text(int status) {
  const int n = (int)(sizeof status_texts / sizeof *status_texts);
  return status >= 0 && status < n ? status_texts[status] : "unknown status";
}

const char *rotdyn_version(void) { return ROTDYN_VERSION; }

/* ---- rolling, energies, shapes, models ------------------------------------------------------- */

/* => x, or NaN outside [lo, hi] */
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
  /* Moments from the table have one rounding less. */
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

/* ---- sweep ----------------------------------------------------------------------------------- */

enum { COLUMNS = 7 };

typedef struct job {
  rot_api_built built;
  rot_axle_scene scene; /* copy, with the numbers of the present row */
  rotdyn_options options;
  rot_hooks hooks;
  rotdyn_report report;
} job;

static rot_status call_poll(void *ctx, double fraction) {
  const rotdyn_options *o = ctx;
  return o->poll && o->poll(o->poll_context, fraction) ? ROT_EUNWIND : ROT_OK;
}

static rotdyn_status refuse(job *j, const char *text) {
  (void)snprintf(j->report.reason, sizeof j->report.reason, "%s", text);
  return ROTDYN_EARGUMENT;
}

static rotdyn_status refuse_row(job *j, const char *what, size_t row) {
  (void)snprintf(j->report.reason, sizeof j->report.reason, "%s in row %zu", what, row);
  return ROTDYN_EARGUMENT;
}

static rotdyn_status open_job(const rotdyn_object *scene, const rotdyn_options *options, job *j) {
  memset(j, 0, sizeof *j);
  const char *fault = rot_api_options(options, &j->options);
  if (fault) return refuse(j, fault);
  j->hooks = (rot_hooks){call_poll, &j->options};
  const rotdyn_status status = rot_api_build(scene, &j->built, &j->report);
  if (status != ROTDYN_OK) return status;
  if (j->built.constraint != &rot_axle_constraint) return refuse(j, "it is no scene_axle");
  j->scene = *(const rot_axle_scene *)j->built.scene;
  return ROTDYN_OK;
}

typedef struct sweep {
  rot_axle_sweep_rows rows;
  rot_axle_sweep_columns out;
  double *scratch; /* columns not wanted by the caller, the viscous column with a motor */
  int *statuses;   /* NULL: the caller's */
  double min_viscous, max_viscous;
  int scaled; /* 1: a torque_scale other than 1 */
} sweep;

static rot_column column_or(rotdyn_column column, const double *otherwise) {
  const rot_column out = {column.values ? column.values : otherwise,
                          column.values ? column.step : 0};
  return out;
}

/* Checks each row; finds the range of viscous coefficients. */
static rotdyn_status check_sweep(job *j, sweep *s) {
  const rot_axle_sweep_rows *r = &s->rows;
  s->min_viscous = INFINITY;
  s->max_viscous = -INFINITY;
  for (size_t i = 0; i < r->n; i++) {
    const double inertia = rot_at(r->inertia_kg_m2, i), c = rot_at(r->viscous_n_m_s, i);
    const double scale = rot_at(r->torque_scale, i), to = rot_at(r->time_s, i);
    if (!(inertia > 0.0 && inertia < INFINITY)) {
      return refuse_row(j, "the moment of inertia must be greater than 0 and finite", i);
    }
    if (!isfinite(c) || !isfinite(scale) || !isfinite(rot_at(r->omega0_rad_per_s, i)) ||
        !isfinite(rot_at(r->theta0_rad, i))) {
      return refuse_row(j, "a number is not finite", i);
    }
    if (!(to >= r->start_s && isfinite(to - r->start_s))) {
      return refuse_row(j, "the time must be finite and not lie before the start", i);
    }
    s->min_viscous = fmin(s->min_viscous, c);
    s->max_viscous = fmax(s->max_viscous, c);
    s->scaled |= scale != 1.0;
  }
  return ROTDYN_OK;
}

/* caller's columns => rows, output columns; the scene's numbers where a column is NULL */
static rotdyn_status open_sweep(job *j, size_t n, const rotdyn_sweep_in *in,
                                const rotdyn_sweep_out *out, sweep *s) {
  static const double one = 1.0;
  const rot_axle_params *p = &j->scene.linear;
  rotdyn_sweep_in from;
  rotdyn_sweep_out to;
  size_t missing = 1, at = 1; /* the first column is that of the viscous coefficients */
  if (!rot_api_take(in, sizeof from, &from) || !rot_api_take(out, sizeof to, &to) ||
      !from.time_s.values) {
    return refuse(j, "`in` or `out` has a wrong size, or there are no times");
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

/* => closed form for the effects of all rows; NULL: "axle_linear" */
static rotdyn_status sweep_model(job *j, const sweep *s, rot_axle_model *model, const char **name) {
  rot_candidate all[ROT_MAX_MODELS];
  rot_axle_scene *scene = &j->scene;
  const int linear = scene->static_n_m == 0.0 && scene->quadratic_n_m_s2 == 0.0 &&
                     scene->n_terms == 0 && !scene->linear.torque.call && scene->n_inertia == 0;
  *model = NULL;
  *name = "axle_linear";
  if (linear) return ROTDYN_OK;
  if (s->scaled && (scene->n_terms || scene->motor_n_m_s != 0.0)) {
    (void)refuse(j, "`torque_scale` is for knots only");
    return ROTDYN_EMODEL;
  }
  scene->viscous_n_m_s = s->min_viscous < 0.0 ? s->min_viscous : s->max_viscous;
  scene->linear.viscous_n_m_s = scene->viscous_n_m_s + scene->motor_n_m_s;
  const rot_query query = {1, &scene->linear.start_s, 1.0, 1e-6};
  const size_t n = rot_choice_candidates(&rot_axle_constraint, scene, &query, all);
  for (size_t i = 0; i < n && scene->n_inertia == 0; i++) {
    if (!all[i].applies || all[i].dropped || all[i].model->error_kind != ROT_BOUND) continue;
    const rot_axle_model form = rot_axle_form(all[i].model);
    if (form == rot_axle_free_scene || form == rot_axle_linear_scene) continue;
    *name = all[i].model->id;
    *model = form;
    return ROTDYN_OK;
  }
  (void)refuse(j, "no closed form takes these rows: scene_rows() integrates them");
  return ROTDYN_EMODEL;
}

/* rows => output columns, report */
static rotdyn_status run_sweep(job *j, sweep *s) {
  rotdyn_report *info = &j->report;
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

int rotdyn_axle_sweep(const rotdyn_object *scene, size_t n, const rotdyn_sweep_in *in,
                      const rotdyn_options *options, const rotdyn_sweep_out *out,
                      rotdyn_report *report) {
  job j;
  sweep s;
  memset(&s, 0, sizeof s);
  rotdyn_status status = open_job(scene, options, &j);
  if (status == ROTDYN_OK) status = open_sweep(&j, n, in, out, &s);
  if (status == ROTDYN_OK && n) status = run_sweep(&j, &s);
  free(s.scratch);
  free(s.statuses);
  rot_api_release(&j.built);
  j.report.status = (int)status;
  return rot_api_give(&j.report, sizeof j.report, report) ? (int)status : ROTDYN_EARGUMENT;
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

/* A library without R has no initialiser of R. */
#if defined ROTDYN_BUILD && defined __GNUC__
__attribute__((constructor)) static void load(void) { rot_gsl_begin(); }
#endif
