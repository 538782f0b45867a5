#include "scene/pivot/scene.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "body/inertia.h"
#include "maths/attitude.h"
#include "scene/free/scene.h"
#include "scene/pivot/approx.h"
#include "scene/pivot/pivot.h"

enum { BODY, OMEGA0, PIVOT, GRAVITY, COMMON };

const rot_input rot_pivot_inputs[ROT_PIVOT_INPUTS] = {
    {"body", "", ROT_INPUT_BODY, 1, ROT_FREE_ANY, NAN, "with its mass and its centre of mass",
     NULL},
    ROT_FREE_OMEGA0_INPUT,
    {"pivot_m", "m", ROT_INPUT_VECTOR, 0, ROT_FREE_ANY, NAN,
     "the fixed point, in the body's own axes; default: 0, 0, 0", NULL},
    {"gravity_m_per_s2", "m/s^2", ROT_INPUT_NUMBER, 0, 0.0, DBL_MAX, 0, 9.80665,
     "acceleration of gravity, against z", NULL},
    ROT_FREE_COMMON_INPUTS};

rot_status rot_pivot_build(const rot_given given[], rot_store *store, void *to, rot_refusal *no) {
  (void)store;
  rot_free_built *built = to;
  rot_free_params *p = &built->params;
  const rot_given_body *body = &given[BODY].body;
  const double gravity = rot_input_number(rot_pivot_inputs, given, GRAVITY);
  double pivot[3], centre[3], moved[ROT_TENSOR], inertia[ROT_TENSOR], lever[3];
  memset(built, 0, sizeof *built);
  rot_input_vector(&given[PIVOT], pivot);
  for (int i = 0; i < 3; i++) {
    centre[i] = body->centre_m[i] - pivot[i];
    lever[i] = body->mass_kg * gravity * centre[i];
    if (!isfinite(lever[i])) return rot_refuse(no, BODY, "must have a finite torque of gravity");
  }
  rot_inertia_shift_second(body->mass_kg, centre, 1.0, body->second_kg_m2, moved);
  rot_inertia_of_second(moved, inertia);
  for (int i = 0; i < ROT_TENSOR; i++) {
    if (!isfinite(inertia[i])) return rot_refuse(no, PIVOT, "must leave finite moments about it");
  }
  rot_inertia_to_second(inertia, moved);
  if (rot_free_build_moments(inertia, moved, p) != ROT_OK) {
    return rot_refuse(no, BODY, "must have finite principal moments");
  }
  memcpy(p->lever_n_m, lever, sizeof lever);
  if (p->turned) rot_attitude_to_body(p->axes, lever, p->lever_n_m);
  rot_pivot_sharpen(p, body->mass_kg, gravity, centre);
  return rot_free_build_rest(rot_pivot_inputs, given, OMEGA0, COMMON, built, no);
}

static rot_status run_top(ROT_FREE_RUN_ARGUMENTS) {
  (void)method;
  return rot_free_run_closed(rot_pivot_top, scene, task, rows, hooks, info);
}

static rot_status run_precession(ROT_FREE_RUN_ARGUMENTS) {
  (void)method;
  return rot_free_run_closed(rot_pivot_precession, scene, task, rows, hooks, info);
}

static rot_status run_nutation(ROT_FREE_RUN_ARGUMENTS) {
  (void)method;
  return rot_free_run_closed(rot_pivot_small_nutation, scene, task, rows, hooks, info);
}

const rot_model_run rot_pivot_runs[ROT_PIVOT_MODELS] = {
    {ROT_METHOD_NONE, run_top},
    {ROT_METHOD_NONE, run_precession},
    {ROT_METHOD_NONE, run_nutation},
    {ROT_METHOD_NONE, rot_free_run_exact},
    {ROT_METHOD_NONE, rot_free_run_gyrostat},
    {ROT_METHOD_RK8PD, rot_free_run_integrated},
    {ROT_METHOD_RADAU, rot_free_run_integrated},
    {ROT_METHOD_EULER, rot_free_run_steps},
    {ROT_METHOD_SEMI_IMPLICIT, rot_free_run_steps},
    {ROT_METHOD_RK4, rot_free_run_steps},
    {ROT_METHOD_SPLIT, rot_free_run_steps},
};
