/* Columns of a motion on an axle, and the runs of its models. */
#ifndef ROT_AXLE_RUNS_H
#define ROT_AXLE_RUNS_H

#include "scene/axle/closed.h"
#include "scene/axle/inputs.h"

enum { ROT_AXLE_ALL_COLUMNS = 21 };

extern const rot_column_of rot_axle_all_columns[ROT_AXLE_ALL_COLUMNS];
extern const rot_model_run rot_axle_runs[ROT_AXLE_MODELS];

/* rot_constraint.start_s */
double rot_axle_start_s(const void *built);
/* rot_constraint.shows: scene => mask of the columns that it shows. */
uint64_t rot_axle_shows(const void *built);
/* rot_constraint.reduce: (scene, mask of effects) => scene without them. */
rot_status rot_axle_reduce(const void *built, unsigned without, rot_store *store, void *to);

#endif
