/* The constructors of scenes on an axle; the moments of inertia that change. */
#ifndef ROT_AXLE_INPUTS_H
#define ROT_AXLE_INPUTS_H

#include "engine/loads.h"
#include "engine/model.h"
#include "engine/resistance.h"
#include "scene/axle/flows.h"
#include "scene/axle/rope.h"
#include "scene/axle/scene.h"

/* Breaks of the laws that are called. */
typedef struct rot_axle_own {
  size_t n;
  const double *breaks_s;
} rot_axle_own;

/* As built: what the models read first, as they read it. */
typedef struct rot_axle_built {
  rot_axle_scene scene;
  rot_axle_own own;
  double axis[3];     /* of the axle, in the body's own axes */
  double distance_m;  /* of a pendulum: of its centre of mass from the axle */
  rot_axle_rope rope; /* its first mass is 0: there is none */
  int is_train;       /* its coefficients are computed: */
  double rounding[2]; /* of them, as a torque and as a viscous coefficient */
  int geared;         /* a curve and dry friction stand for what the gears take */
  rot_axle_gears gears;
} rot_axle_built;

enum { ROT_AXLE_MAKERS = 4 };
extern const rot_maker rot_axle_makers[ROT_AXLE_MAKERS];

/* inertia_knots() */
extern const rot_part rot_axle_parts[];
extern const size_t rot_axle_n_parts;

/* At a jump, the moment after it. */
double rot_axle_inertia_at(const rot_axle_scene *scene, double time_s);

/* What acts on an axle: a torque and a resistance, each of which may be absent (`resistance` may be
 * NULL). The rest of the scene has been set. `own` may be NULL. ROT_EVALUE: the sum of the torques
 * is beyond double precision. */
rot_status rot_axle_load(const rot_given *torque, const rot_resistance *resistance,
                         rot_store *store, rot_axle_scene *scene, rot_axle_own *own);

/* All breaks of a scene, those in it and those of what acts, in the store. */
rot_status rot_axle_gather_breaks(rot_axle_scene *scene, rot_store *store);

/* Of an input that is a torque. */
#define ROT_TORQUE_KINDS (ROT_INPUT_NUMBER | ROT_INPUT_LAW | ROT_INPUT_TORQUE | ROT_INPUT_LIST)

#endif
