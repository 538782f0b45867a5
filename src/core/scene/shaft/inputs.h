/* Inputs of rotors on a shaft, their columns, and the runs of their models. */
#ifndef ROT_SHAFT_INPUTS_H
#define ROT_SHAFT_INPUTS_H

#include "engine/model.h"
#include "scene/shaft/shaft.h"

enum { ROT_SHAFT_INPUTS = 8, ROT_SHAFT_ALL_COLUMNS = 5, ROT_SHAFT_MODELS = 2 };

extern const rot_input rot_shaft_inputs[ROT_SHAFT_INPUTS];
extern const rot_column_of rot_shaft_all_columns[ROT_SHAFT_ALL_COLUMNS];
extern const rot_model_run rot_shaft_runs[ROT_SHAFT_MODELS];

/* rot_constraint.build: inputs => rot_shaft_params, or a refusal. */
rot_status rot_shaft_build(const rot_given given[], rot_store *store, void *scene,
                           rot_refusal *refusal);
/* rot_constraint.start_s */
double rot_shaft_start_s(const void *scene);
/* rot_constraint.rows_per_time: number of rotors. */
size_t rot_shaft_rows_per_time(const void *scene);

#endif
