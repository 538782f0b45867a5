/* Constructors of scenes on an axle; tables of changing moments of inertia. */
#ifndef ROT_AXLE_INPUTS_H
#define ROT_AXLE_INPUTS_H

#include "engine/loads.h"
#include "engine/model.h"
#include "engine/resistance.h"
#include "scene/axle/flows.h"
#include "scene/axle/rope.h"
#include "scene/axle/scene.h"

/* Breaks of laws given as functions. */
typedef struct rot_axle_own {
  size_t n;
  const double *breaks_s;
} rot_axle_own;

/* A built scene. The models read its first member. */
typedef struct rot_axle_built {
  rot_axle_scene scene;
  rot_axle_own own;
  double axis[3];     /* direction of the axle, own axes of the body */
  double distance_m;  /* pendulum: centre of mass from the axle */
  rot_axle_rope rope; /* first mass 0: none */
  int is_train;       /* 1: a gear train, with computed coefficients */
  double rounding[2]; /* of these: as a torque, as a viscous coefficient */
  int geared;         /* 1: a curve and dry friction represent the losses of gears */
  rot_axle_gears gears;
} rot_axle_built;

enum { ROT_AXLE_MAKERS = 4 };
extern const rot_maker rot_axle_makers[ROT_AXLE_MAKERS];

/* inertia_knots() */
extern const rot_part rot_axle_parts[];
extern const size_t rot_axle_n_parts;

/* (scene, time) => moment of inertia; at a jump: after it. */
double rot_axle_inertia_at(const rot_axle_scene *scene, double time_s);

/* (torque, resistance) => loads of the scene; each may be absent, `resistance` and `own` may be
 * NULL. The other members of the scene must be set. ROT_EVALUE: the sum of the torques
 * overflows. */
rot_status rot_axle_load(const rot_given *torque, const rot_resistance *resistance,
                         rot_store *store, rot_axle_scene *scene, rot_axle_own *own);

/* scene => list of all breaks, of its laws and its loads, in the store. */
rot_status rot_axle_gather_breaks(rot_axle_scene *scene, rot_store *store);

/* Kinds of an input that is a torque. */
#define ROT_TORQUE_KINDS (ROT_INPUT_NUMBER | ROT_INPUT_LAW | ROT_INPUT_TORQUE)

#endif
