/* The columns of a motion on an incline, and the runs of its models. */
#ifndef ROT_INCLINE_RUNS_H
#define ROT_INCLINE_RUNS_H

#include "scene/incline/scene.h"

enum { ROT_INCLINE_ALL_COLUMNS = 15, ROT_INCLINE_MODELS = 6 };

extern const rot_column_of rot_incline_all_columns[ROT_INCLINE_ALL_COLUMNS];
extern const rot_model_run rot_incline_runs[ROT_INCLINE_MODELS];

#endif
