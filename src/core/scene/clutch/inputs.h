/* Inputs of a clutch scene, its columns, and the run of its model. */
#ifndef ROT_CLUTCH_INPUTS_H
#define ROT_CLUTCH_INPUTS_H

#include "engine/model.h"
#include "scene/clutch/clutch.h"

enum { ROT_CLUTCH_INPUTS = 9, ROT_CLUTCH_ALL_COLUMNS = 7, ROT_CLUTCH_MODELS = 1 };

extern const rot_input rot_clutch_inputs[ROT_CLUTCH_INPUTS];
extern const rot_column_of rot_clutch_all_columns[ROT_CLUTCH_ALL_COLUMNS];
extern const rot_model_run rot_clutch_runs[ROT_CLUTCH_MODELS];

/* rot_constraint.build: inputs => rot_clutch_params, or a refusal. */
rot_status rot_clutch_build(const rot_given given[], rot_store *store, void *scene,
                            rot_refusal *refusal);
/* rot_constraint.start_s */
double rot_clutch_start_s(const void *scene);

#endif
