#include "scene/incline/scene.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "engine/resistance.h"

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
  RESISTANCE,
  FORCE,
  BREAKS,
  GRAVITY,
  START
};

static const char *const drag_terms[] = {"drag_n_s_per_m", "drag_n_s2_per_m2", NULL};

const rot_input rot_incline_inputs[ROT_INCLINE_INPUTS] = {
    [BODY] = {"body", "", ROT_INPUT_BODY, 1, ROT_NO_DOMAIN, NAN, "round about its own z axis",
              NULL},
    [ANGLE] = {"incline_angle_deg", "degree", ROT_INPUT_NUMBER, 1, -90.0, 90.0, 0, NAN,
               "of the slope", NULL},
    [STATIC] = {"static_friction", "1", ROT_INPUT_LIMIT, 0, 0.0, INFINITY, 0, INFINITY,
                "coefficient of static friction; Inf: the contact never slips", NULL},
    [KINETIC] = {"kinetic_friction", "1", ROT_INPUT_LIMIT, 0, 0.0, INFINITY, 0, NAN,
                 "coefficient of kinetic friction; default: that of static friction",
                 rot_max_static},
    [ARM] = {"rolling_arm_m", "m", ROT_INPUT_NUMBER, 0, 0.0, DBL_MAX, 0, 0.0,
             "arm of the rolling resistance: the normal force acts that far ahead of the centre",
             NULL},
    [RADIUS] = {"radius_m", "m", ROT_INPUT_NUMBER, 0, 0.0, DBL_MAX, 1, NAN,
                "on which the body rolls; default: its own", NULL},
    [V0] = {"v0_m_per_s", "m/s", ROT_INPUT_NUMBER, 0, ROT_NO_DOMAIN, 0.0,
            "down the slope, at the start", NULL},
    [OMEGA0] = {"omega0_rad_per_s", "rad/s", ROT_INPUT_NUMBER, 0, ROT_NO_DOMAIN, NAN,
                "at the start; default: v0/radius, it rolls", NULL},
    [X0] = {"x0_m", "m", ROT_INPUT_NUMBER, 0, ROT_NO_DOMAIN, 0.0,
            "place along the slope at the start", NULL},
    [THETA0] = {"theta0_rad", "rad", ROT_INPUT_NUMBER, 0, ROT_NO_DOMAIN, 0.0, "angle at the start",
                NULL},
    [RESISTANCE] = ROT_RESISTANCE_INPUT("air drag on the centre of mass", drag_terms),
    [FORCE] = {"force", "N", ROT_INPUT_NUMBER | ROT_INPUT_LAW, 0, ROT_NO_DOMAIN, NAN,
               "along the slope on the centre of mass, positive down, of time_s, x_m, v_m_per_s",
               NULL},
    [BREAKS] = {"breaks_s", "s", ROT_INPUT_TIMES, 0, ROT_NO_DOMAIN, NAN,
                "where the force may jump or kink", NULL},
    [GRAVITY] = {"gravity_m_per_s2", "m/s^2", ROT_INPUT_NUMBER, 0, 0.0, DBL_MAX, 0, 9.80665,
                 "acceleration of gravity", NULL},
    [START] = {"start_s", "s", ROT_INPUT_NUMBER, 0, ROT_NO_DOMAIN, 0.0,
               "when the state above holds", NULL},
};

static rot_status call_force(double t, double x, double v, double *force, void *ctx) {
  const rot_law *law = ctx;
  const double argument[] = {t, x, v};
  return law->call(argument, force, law->ctx);
}

static rot_status constant_force(const double argument[], double value[], void *ctx) {
  (void)argument;
  *value = *(const double *)ctx;
  return ROT_OK;
}

rot_status rot_incline_build(const rot_given given[], rot_store *store, void *to, rot_refusal *no) {
  (void)store;
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
  p->mu_kinetic = NUMBER(KINETIC);
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
    return rot_refuse(no, KINETIC,
                      "must be finite where the start slips, by %g m/s here: it would end the slip "
                      "at once, and leave a rolling speed of %.7g m/s",
                      slip,
                      (p->v0_m_per_s + beta * p->radius_m * p->omega0_rad_per_s) / (1.0 + beta));
  }
  p->gravity_m_per_s2 = NUMBER(GRAVITY);
  const double min = p->gravity_m_per_s2 * fmin(1.0, p->mass_kg);
  if (p->gravity_m_per_s2 > 0.0 && min < DBL_MIN) {
    return rot_refuse(no, GRAVITY,
                      "and the weight must be 0 or at least %g, where numbers have all their "
                      "digits; gravity k^2 times as large gives the same places after 1/k of the "
                      "time, from velocities k times as large",
                      DBL_MIN);
  }
  p->start_s = NUMBER(START);
#undef NUMBER
  rot_resistance terms;
  const rot_status status = rot_resistance_of(&rot_incline_inputs[RESISTANCE], RESISTANCE,
                                              &given[RESISTANCE], &terms, no);
  if (status != ROT_OK) return status;
  scene->drag_n_s_per_m = terms.drag_n_s_per_m;
  scene->drag_n_s2_per_m2 = terms.drag_n_s2_per_m2;
  if (given[BREAKS].is && given[BREAKS].n && !given[FORCE].is) {
    return rot_refuse(no, BREAKS, "needs a force");
  }
  if (given[FORCE].is) {
    built->law = given[FORCE].law;
    if (given[FORCE].is == ROT_INPUT_NUMBER) {
      built->force_n = given[FORCE].x[0];
      built->law = (rot_law){constant_force, &built->force_n, 0.0};
    }
    scene->force = call_force;
    scene->force_is_called = built->law.call != constant_force;
    scene->ctx = &built->law;
    scene->force_noise_n = built->law.noise;
    scene->n_breaks = given[BREAKS].is ? given[BREAKS].n : 0;
    scene->breaks_s = given[BREAKS].x;
  }
  return ROT_OK;
}

double rot_incline_start(const void *scene) {
  return ((const rot_incline_scene *)scene)->slope.start_s;
}
