/* Rows of a sweep: a scene for each, built and run, and the outputs wanted of it. */
#ifndef ROT_ROWS_H
#define ROT_ROWS_H

#include "scene/run.h"
#include "sweep/variants.h"

/* The status of a row: a rot_status, or one of these. */
enum {
  ROT_ROW_NO_MODEL = ROT_STATUS_COUNT, /* the model does not take the scene */
  ROT_ROW_COUNT,                       /* another number of rows for each time */
  ROT_ROW_STATUS_COUNT
};
/* => short name: "ok", "value", ..., "model", "count"; NULL: no such status */
const char *rot_row_status_name(int status);

typedef struct rot_row_plan {
  const rot_object *scene;
  size_t n_inputs;
  const char *const *inputs; /* paths; "time_s" that no input of the scene has: the last time */
  size_t n_times;
  const double *time_s;
  const char *model; /* of all rows; NULL: each has the cheapest */
  int asked;         /* the user named it: an integrator does not switch to another */
  double accuracy, max_steps;
  size_t n_outputs;
  const char *const *outputs;
} rot_row_plan;

typedef struct rot_rows_worker rot_rows_worker; /* of one thread */

/* ROT_EVALUE: an input, an output or the scene is refused; no->input: the place of the input,
 * n_inputs + that of the output, or n_inputs + n_outputs. */
rot_status rot_rows_open(const rot_row_plan *plan, rot_rows_worker **to, rot_refusal *no);
void rot_rows_close(rot_rows_worker *worker);

/* One row: inputs => outputs, error figure, model; returns its status. Outputs of a row whose
 * status is not ROT_OK are NaN, and the reason is in `no`, which may be NULL. */
int rot_rows_run(rot_rows_worker *worker, const double input[], double output[], double *error,
                 const rot_model **model, rot_refusal *no);

/* The model for all of n rows: of those that take the most of them the cheapest in all. NULL: none
 * takes any. input: by column. *taken: how many it takes. */
const rot_model *rot_rows_model(rot_rows_worker *worker, size_t n, const double *const input[],
                                size_t *taken);

#endif
