#include "scene/incline/scene.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- inputs ---------------------------------------------------------------------------------- */

enum {
  BODY,
  ANGLE,
  STATIC,
  KINETIC,
  ARM,
  RADIUS,
  V0,
  OMEGA0,
  X0,
  THETA0,
  DRAG,
  QUADRATIC,
  FORCE,
  BREAKS,
  GRAVITY,
  START
};

#define ANY -DBL_MAX, DBL_MAX, 0

const rot_input rot_incline_inputs[ROT_INCLINE_INPUTS] = {
    [BODY] = {"body", "", ROT_INPUT_BODY, 1, ANY, NAN, "round about its own z axis", NULL},
    [ANGLE] = {"incline_angle_deg", "degree", ROT_INPUT_NUMBER, 1, -90.0, 90.0, 0, NAN,
               "of the slope", NULL},
    [STATIC] = {"static_friction", "1", ROT_INPUT_LIMIT, 0, 0.0, INFINITY, 0, INFINITY,
                "coefficient of static friction; Inf: the contact never slips", NULL},
    [KINETIC] = {"kinetic_friction", "1", ROT_INPUT_LIMIT, 0, 0.0, INFINITY, 0, NAN,
                 "coefficient of kinetic friction; default: that of static friction", NULL},
    [ARM] = {"rolling_arm_m", "m", ROT_INPUT_NUMBER, 0, 0.0, DBL_MAX, 0, 0.0,
             "arm of the rolling resistance: the normal force acts that far ahead of the centre",
             NULL},
    [RADIUS] = {"radius_m", "m", ROT_INPUT_NUMBER, 0, 0.0, DBL_MAX, 1, NAN,
                "on which the body rolls; default: its own", NULL},
    [V0] = {"v0_m_per_s", "m/s", ROT_INPUT_NUMBER, 0, ANY, 0.0, "down the slope, at the start",
            NULL},
    [OMEGA0] = {"omega0_rad_per_s", "rad/s", ROT_INPUT_NUMBER, 0, ANY, NAN,
                "at the start; default: v0/radius, it rolls", NULL},
    [X0] = {"x0_m", "m", ROT_INPUT_NUMBER, 0, ANY, 0.0, "place along the slope at the start", NULL},
    [THETA0] = {"theta0_rad", "rad", ROT_INPUT_NUMBER, 0, ANY, 0.0, "angle at the start", NULL},
    [DRAG] = {"drag_n_s_per_m", "N*s/m", ROT_INPUT_NUMBER, 0, 0.0, DBL_MAX, 0, 0.0,
              "linear air drag on the centre of mass", NULL},
    [QUADRATIC] = {"drag_n_s2_per_m2", "N*s^2/m^2", ROT_INPUT_NUMBER, 0, 0.0, DBL_MAX, 0, 0.0,
                   "quadratic air drag on the centre of mass", NULL},
    [FORCE] = {"force_n", "N", ROT_INPUT_LAW, 0, ANY, NAN,
               "along the slope on the centre of mass, positive down, of time_s, x_m, v_m_per_s",
               NULL},
    [BREAKS] = {"force_breaks_s", "s", ROT_INPUT_TIMES, 0, ANY, NAN,
                "where the force may jump or kink", NULL},
    [GRAVITY] = {"gravity_m_per_s2", "m/s^2", ROT_INPUT_NUMBER, 0, 0.0, DBL_MAX, 0, 9.80665,
                 "acceleration of gravity", NULL},
    [START] = {"start_s", "s", ROT_INPUT_NUMBER, 0, ANY, 0.0, "when the state above holds", NULL},
};

static rot_status call_force(double t, double x, double v, double *force, void *ctx) {
  const rot_law *law = ctx;
  const double argument[] = {t, x, v};
  return law->call(argument, force, law->ctx);
}

rot_status rot_incline_build(const rot_given given[], void *to, rot_refusal *no) {
  rot_incline_built *built = to;
  rot_incline_scene *scene = &built->scene;
  rot_incline_params *p = &scene->slope;
  const rot_given_body *body = &given[BODY].body;
  const double *inertia = body->inertia_kg_m2;
#define NUMBER(input) rot_input_number(rot_incline_inputs, given, input)
  memset(built, 0, sizeof *built);
  p->mass_kg = body->mass_kg;
  p->inertia_kg_m2 = inertia[2];
  p->radius_m = given[RADIUS].is ? NUMBER(RADIUS) : body->radius_m;
  if (!(p->radius_m > 0.0 && p->radius_m < INFINITY)) {
    return rot_refuse(no, RADIUS, "is missing: the body has no radius of its own to roll on");
  }
  const double beta = p->inertia_kg_m2 / p->mass_kg / p->radius_m / p->radius_m;
  if (!(beta > 0.0 && beta < INFINITY)) {
    return rot_refuse(no, BODY, "must have a finite I/(m r^2) greater than 0; it is %g", beta);
  }
  p->angle_deg = NUMBER(ANGLE);
  p->mu_static = NUMBER(STATIC);
  p->mu_kinetic = given[KINETIC].is ? NUMBER(KINETIC) : p->mu_static;
  if (p->mu_kinetic > p->mu_static) {
    return rot_refuse(no, KINETIC, "must be at most that of static friction, %g; it is %g",
                      p->mu_static, p->mu_kinetic);
  }
  p->arm_m = NUMBER(ARM);
  p->x0_m = NUMBER(X0);
  p->v0_m_per_s = NUMBER(V0);
  p->theta0_rad = NUMBER(THETA0);
  p->omega0_rad_per_s = given[OMEGA0].is ? NUMBER(OMEGA0) : p->v0_m_per_s / p->radius_m;
  if (!isfinite(p->omega0_rad_per_s)) {
    return rot_refuse(no, V0, "over the radius exceeds double precision");
  }
  const double slip = p->v0_m_per_s - p->radius_m * p->omega0_rad_per_s;
  if (isinf(p->mu_kinetic) && fabs(slip) > 8.0 * DBL_EPSILON * fabs(p->v0_m_per_s)) {
    return rot_refuse(no, KINETIC, "must be finite where the start slips, by %g m/s here", slip);
  }
  p->gravity_m_per_s2 = NUMBER(GRAVITY);
  p->start_s = NUMBER(START);
  scene->drag_n_s_per_m = NUMBER(DRAG);
  scene->drag_n_s2_per_m2 = NUMBER(QUADRATIC);
#undef NUMBER
  if (given[BREAKS].is && given[BREAKS].n && !given[FORCE].is) {
    return rot_refuse(no, BREAKS, "needs a force");
  }
  if (given[FORCE].is) {
    built->law = given[FORCE].law;
    scene->force = call_force;
    scene->ctx = &built->law;
    scene->n_breaks = given[BREAKS].is ? given[BREAKS].n : 0;
    scene->breaks_s = given[BREAKS].x;
  }
  return ROT_OK;
}

double rot_incline_start(const void *scene) {
  return ((const rot_incline_scene *)scene)->slope.start_s;
}

/* ---- columns --------------------------------------------------------------------------------- */

#define OUTER (ROT_INCLINE_DRAG | ROT_INCLINE_QUADRATIC | ROT_INCLINE_FORCE)

#define FLAG_double   0
#define FLAG_int      1
#define X(type, name) {#name, FLAG_##type, 0, NULL, 0},
const rot_column_of rot_incline_all_columns[ROT_INCLINE_ALL_COLUMNS] = {
    ROT_INCLINE_COLUMNS(X){"drag_force_n", 0, OUTER, NULL, 0},
    {"applied_force_n", 0, OUTER, NULL, 0}};
#undef X

static rot_incline_columns columns_of(void *const column[]) {
  rot_incline_columns out;
  size_t i = 0;
#define X(type, name) out.name = column[i++];
  ROT_INCLINE_COLUMNS(X)
#undef X
  return out;
}

/* ---- runs ------------------------------------------------------------------------------------ */

static rot_status run_exact(const void *of, const rot_task *task, rot_method method,
                            const rot_rows *rows, const rot_hooks *hooks, rot_info *info) {
  const rot_incline_scene *scene = of;
  const rot_incline_columns out = columns_of(rows->column);
  (void)method;
  return rot_incline_run(&scene->slope, task->n, task->time_s, &out, rows->events, NULL, hooks,
                         info);
}

static rot_status run_integrated(const void *of, const rot_task *task, rot_method method,
                                 const rot_rows *rows, const rot_hooks *hooks, rot_info *info) {
  const rot_incline_scene *scene = of;
  void *const *column = rows->column;
  const rot_incline_columns out = columns_of(column);
  const rot_incline_ode_options options = {
      task->accuracy, task->max_steps, task->asked ? method : ROT_METHOD_NONE, task->resolution};
  rot_incline_sums sums = {0};
  size_t at = 0;
#define X(name) at++;
  ROT_INCLINE_SUMS(X)
#undef X
  double *values = malloc((task->n ? task->n : 1) * at * sizeof *values);
  if (!values) {
    rot_info_clear(info, rot_incline_measures);
    return info->status = ROT_ENOMEM;
  }
  at = 0;
#define X(name) sums.name = values + task->n * at++;
  ROT_INCLINE_SUMS(X)
#undef X
  sums.drag_force_n = column[ROT_INCLINE_ALL_COLUMNS - 2];
  sums.applied_force_n = column[ROT_INCLINE_ALL_COLUMNS - 1];
  const rot_status status = rot_incline_integrate(scene, &options, task->n, task->time_s, &out,
                                                  &sums, rows->events, NULL, hooks, info);
  free(values);
  return status;
}

const rot_model_run rot_incline_runs[ROT_INCLINE_MODELS] = {
    {ROT_METHOD_NONE, run_exact},
    {ROT_METHOD_RK8PD, run_integrated},
    {ROT_METHOD_RADAU, run_integrated},
};
