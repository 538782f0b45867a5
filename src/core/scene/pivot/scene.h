/* Additional columns of bodies with a fixed point, and the runs of their models. */
#ifndef ROT_PIVOT_SCENE_H
#define ROT_PIVOT_SCENE_H

#include "engine/model.h"

enum { ROT_PIVOT_MODELS = 11 };
extern const rot_model_run rot_pivot_runs[ROT_PIVOT_MODELS];

/* rot_constraint.shows: column => 1 if the scene shows it, else 0. */
int rot_pivot_shows(const void *scene, size_t column);

#endif
