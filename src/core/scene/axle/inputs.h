/* A scene on an axle from its inputs, its columns, the runs of its models; the parts that resist
 * and the moments of inertia that change. */
#ifndef ROT_AXLE_INPUTS_H
#define ROT_AXLE_INPUTS_H

#include "engine/loads.h"
#include "engine/model.h"
#include "scene/axle/closed.h"
#include "scene/axle/flows.h"
#include "scene/axle/rope.h"
#include "scene/axle/scene.h"

enum { ROT_AXLE_INPUTS = 8, ROT_AXLE_ALL_COLUMNS = 21 };

extern const rot_input rot_axle_inputs[ROT_AXLE_INPUTS];
extern const rot_column_of rot_axle_all_columns[ROT_AXLE_ALL_COLUMNS];
extern const rot_model_run rot_axle_runs[ROT_AXLE_MODELS];

/* Breaks of the laws that are called. */
typedef struct rot_axle_own {
  size_t n;
  const double *breaks_s;
} rot_axle_own;

/* As built: what the models read first, as they read it. */
typedef struct rot_axle_built {
  rot_axle_scene scene;
  rot_axle_own own;
  rot_axle_rope rope; /* its first mass is 0: there is none */
  int geared;         /* a curve and dry friction stand for what the gears take */
  rot_axle_gears gears;
} rot_axle_built;

/* At a jump, the moment after it. */
double rot_axle_inertia_at(const rot_axle_scene *scene, double time_s);

/* rot_constraint.build and .start_s */
rot_status rot_axle_build(const rot_given given[], rot_store *store, void *built,
                          rot_refusal *refusal);
double rot_axle_start_s(const void *scene);
int rot_axle_shows(const void *built, size_t column);
rot_status rot_axle_reduce(const void *built, unsigned without, rot_store *store, void *to);

/* resistance(), inertia_knots() */
extern const rot_part rot_axle_parts[];
extern const size_t rot_axle_n_parts;

/* What acts on an axle: a torque and a resistance, each of which may be absent (`resistance` may be
 * NULL). The rest of the scene has been set. `own` may be NULL. ROT_EVALUE: the sum of the torques
 * is beyond double precision. */
rot_status rot_axle_load(const rot_given *torque, const rot_given *resistance, rot_store *store,
                         rot_axle_scene *scene, rot_axle_own *own);

/* Of an input that is a torque. */
#define ROT_TORQUE_KINDS (ROT_INPUT_NUMBER | ROT_INPUT_LAW | ROT_INPUT_TORQUE | ROT_INPUT_LIST)

#endif
