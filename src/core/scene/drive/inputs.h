/* Inputs of a drive, of couplings and brakes; its columns; the runs of its models. */
#ifndef ROT_DRIVE_INPUTS_H
#define ROT_DRIVE_INPUTS_H

#include "engine/model.h"
#include "engine/part.h"
#include "scene/drive/drive.h"

enum {
  ROT_DRIVE_INPUTS = 8,
  ROT_DRIVE_ALL_COLUMNS = 10,
  ROT_DRIVE_MODELS = 8,
  ROT_DRIVE_DERIVED = 4
};

extern const rot_input rot_drive_inputs[ROT_DRIVE_INPUTS];
extern const rot_derived rot_drive_derived[ROT_DRIVE_DERIVED];
extern const rot_column_of rot_drive_all_columns[ROT_DRIVE_ALL_COLUMNS];
extern const rot_model_run rot_drive_runs[ROT_DRIVE_MODELS];

/* rot_constraint.build: inputs => rot_drive_scene, or a refusal. */
rot_status rot_drive_build(const rot_given given[], rot_store *store, void *scene,
                           rot_refusal *refusal);
/* rot_constraint.start_s */
double rot_drive_start_s(const void *scene);
/* rot_constraint.rows_per_time: number of rotors. */
size_t rot_drive_rows_per_time(const void *scene);

/* coupling_shaft(), coupling_clutch(), coupling_gear(), brake() */
extern const rot_part rot_drive_parts[];
extern const size_t rot_drive_n_parts;

#endif
