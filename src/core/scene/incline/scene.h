/* Inputs of an incline scene. */
#ifndef ROT_INCLINE_SCENE_H
#define ROT_INCLINE_SCENE_H

#include "engine/model.h"
#include "scene/incline/ode.h"

/* Mask of effects, in the order of their table. */
enum {
  ROT_INCLINE_GRAVITY = 1,
  ROT_INCLINE_FRICTION = 2,
  ROT_INCLINE_RESISTANCE = 4,
  ROT_INCLINE_DRAG = 8,
  ROT_INCLINE_QUADRATIC = 16,
  ROT_INCLINE_FORCE = 32,
  ROT_INCLINE_EFFECTS = 63,
  ROT_INCLINE_OUTER = ROT_INCLINE_DRAG | ROT_INCLINE_QUADRATIC | ROT_INCLINE_FORCE
};

enum { ROT_INCLINE_INPUTS = 15 };

extern const rot_input rot_incline_inputs[ROT_INCLINE_INPUTS];

/* A built scene. The models read its first member. */
typedef struct rot_incline_built {
  rot_incline_scene scene;
  rot_law law;    /* of the applied force */
  double force_n; /* if it is constant */
} rot_incline_built;

/* rot_constraint.build: inputs => rot_incline_built, or a refusal. */
rot_status rot_incline_build(const rot_given given[], rot_store *store, void *built,
                             rot_refusal *refusal);
/* rot_constraint.start_s */
double rot_incline_start(const void *scene);

#endif
