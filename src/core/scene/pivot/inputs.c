#include "scene/pivot/inputs.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "body/inertia.h"
#include "maths/attitude.h"
#include "scene/free/inputs.h"
#include "scene/pivot/pivot.h"

enum { BODY, OMEGA0, PIVOT, MASS, CENTRE, GRAVITY, COMMON };

const rot_input rot_pivot_inputs[ROT_PIVOT_INPUTS] = {
    {"body", "kg*m^2", ROT_INPUT_BODY | ROT_INPUT_VECTOR | ROT_INPUT_MOMENTS, 1, ROT_FREE_ANY, NAN,
     "with its mass and its centre of mass; or its three principal moments about the fixed point",
     NULL},
    ROT_FREE_OMEGA0_INPUT,
    {"pivot_m", "m", ROT_INPUT_VECTOR, 0, ROT_FREE_ANY, NAN,
     "the fixed point, in the body's own axes; default: 0, 0, 0", NULL},
    {"mass_kg", "kg", ROT_INPUT_NUMBER, 0, 0.0, DBL_MAX, 0, NAN, "of a body given by its moments",
     NULL},
    {"centre_m", "m", ROT_INPUT_VECTOR, 0, ROT_FREE_ANY, NAN,
     "its centre of mass, from the fixed point, in its own axes", NULL},
    {"gravity_m_per_s2", "m/s^2", ROT_INPUT_NUMBER, 0, 0.0, DBL_MAX, 0, 9.80665,
     "acceleration of gravity, against z", NULL},
    ROT_FREE_COMMON_INPUTS};

/* body with mass and centre => moments and lever about the fixed point. */
static rot_status about_pivot(const rot_given given[], rot_free_built *built, rot_refusal *no) {
  const rot_given_body *body = &given[BODY].body;
  double pivot[3], moved[ROT_TENSOR], inertia[ROT_TENSOR];
  rot_input_vector(&given[PIVOT], pivot);
  built->mass_kg = body->mass_kg;
  for (int i = 0; i < 3; i++) built->centre_m[i] = body->centre_m[i] - pivot[i];
  if (given[MASS].is && given[MASS].x[0] != body->mass_kg) {
    return rot_refuse(no, MASS, "must be that of the body, %g", body->mass_kg);
  }
  for (int i = 0; i < 3 && given[CENTRE].is; i++) {
    if (given[CENTRE].x[i] != built->centre_m[i]) {
      return rot_refuse(no, CENTRE, "must be that of the body");
    }
  }
  rot_inertia_shift_second(body->mass_kg, built->centre_m, 1.0, body->second_kg_m2, moved);
  rot_inertia_of_second(moved, inertia);
  for (int i = 0; i < ROT_TENSOR; i++) {
    if (!isfinite(inertia[i])) return rot_refuse(no, PIVOT, "must leave finite moments about it");
  }
  rot_inertia_to_second(inertia, moved);
  if (rot_free_build_moments(inertia, moved, &built->params) == ROT_OK) return ROT_OK;
  return rot_refuse(no, BODY, "must have finite principal moments");
}

/* A body with its own mass and centre, or moments about the fixed point with mass and centre. */
rot_status rot_pivot_build(const rot_given given[], rot_store *store, void *to, rot_refusal *no) {
  rot_free_built *built = to;
  rot_free_params *p = &built->params;
  const double gravity = rot_input_number(rot_pivot_inputs, given, GRAVITY);
  double lever[3];
  rot_status status = ROT_OK;
  memset(built, 0, sizeof *built);
  if (rot_free_read_moments(&given[BODY], p)) {
    for (size_t i = MASS; i <= CENTRE; i++) {
      if (given[i].is) continue;
      return rot_refuse(no, i, "is missing: moments do not say where gravity acts");
    }
    if (given[PIVOT].is) return rot_refuse(no, PIVOT, "is of bodies: the moments are about it");
    built->mass_kg = given[MASS].x[0];
    rot_input_vector(&given[CENTRE], built->centre_m);
  } else {
    status = about_pivot(given, built, no);
  }
  if (status != ROT_OK) return status;
  for (int i = 0; i < 3; i++) {
    lever[i] = built->mass_kg * gravity * built->centre_m[i];
    if (!isfinite(lever[i])) return rot_refuse(no, BODY, "must have a finite torque of gravity");
  }
  memcpy(p->lever_n_m, lever, sizeof lever);
  if (p->turned) rot_attitude_to_body(p->axes, lever, p->lever_n_m);
  rot_pivot_sharpen(p, built->mass_kg, gravity, built->centre_m);
  return rot_free_build_rest(rot_pivot_inputs, given, OMEGA0, COMMON, store, built, no);
}
