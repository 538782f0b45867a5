/* A body with a fixed point from its inputs, and the runs of its models; its columns are those of a
 * free body (scene/free/scene.h). */
#ifndef ROT_PIVOT_SCENE_H
#define ROT_PIVOT_SCENE_H

#include "engine/model.h"

enum { ROT_PIVOT_INPUTS = 10, ROT_PIVOT_MODELS = 11 };

extern const rot_input rot_pivot_inputs[ROT_PIVOT_INPUTS];
extern const rot_model_run rot_pivot_runs[ROT_PIVOT_MODELS];

/* rot_constraint.build */
rot_status rot_pivot_build(const rot_given given[], rot_store *store, void *built,
                           rot_refusal *refusal);

#endif
