/* Additional columns of bodies with a fixed point, and the runs of their models. */
#ifndef ROT_PIVOT_SCENE_H
#define ROT_PIVOT_SCENE_H

#include "engine/model.h"

enum { ROT_PIVOT_MODELS = 11 };
extern const rot_model_run rot_pivot_runs[ROT_PIVOT_MODELS];

/* rot_constraint.shows: scene => mask of the columns that it shows. */
uint64_t rot_pivot_shows(const void *scene);

#endif
