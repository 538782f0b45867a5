#include "sweep/table.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "sweep/outputs.h"

struct rot_table {
  const rot_row_plan *plan;
  const rot_batch *batch;
  const void *scene;
  rot_variants *variants; /* own the scene */
  rot_batch_rows rows;
  double start_s;
  size_t bound[ROT_BATCH_INPUTS]; /* input of the plan that is an input of the kernel */
  double low[ROT_BATCH_INPUTS], high[ROT_BATCH_INPUTS]; /* its domain */
  int above[ROT_BATCH_INPUTS];
  size_t time_at; /* input of the plan that is the time; n_inputs: it does not vary */
  size_t n_columns;
  rot_output_of *outputs;
  size_t *from; /* of each output: column of the kernel; n_columns: the error */
  double start[ROT_BATCH_COLUMNS][ROT_BATCH_ROWS], end[ROT_BATCH_COLUMNS][ROT_BATCH_ROWS];
};

/* ---- opening --------------------------------------------------------------------------------- */

static size_t named(const char *const *names, const char *name) {
  size_t i = 0;
  while (names[i] && strcmp(names[i], name)) i++;
  return i;
}

/* The scene as a whole: the model takes it without loss, and the kernel does. */
static int takes(const rot_row_plan *plan, const rot_batch *batch, const void *scene) {
  const rot_constraint *c = plan->scene->constraint;
  const rot_model *model = rot_choice_model(c, batch->model);
  const double start = c->start_s(scene);
  const double times[] = {start, plan->time_s[0] > start ? plan->time_s[0] : start};
  const rot_query query = {2, times, plan->accuracy, 0.0};
  return model && !(c->effects_of(scene) & ~model->takes) && batch->takes(scene) &&
         !(model->why_not && model->why_not(scene, &query));
}

/* The number at a path: its domain, and that it is there. */
typedef struct found {
  rot_table *table;
  int places;
} found;

static int take_place(const rot_place *place, const char *path, void *ctx) {
  found *f = ctx;
  const size_t k = named(f->table->batch->inputs, path);
  if (!f->table->batch->inputs[k]) return 0;
  f->places |= 1 << k;
  f->table->low[k] = place->input->low;
  f->table->high[k] = place->input->high;
  f->table->above[k] = place->input->above;
  return 0;
}

/* Which inputs of the plan are those of the kernel; 0: one is not. */
static int bind_inputs(rot_table *t) {
  const rot_object *scene = t->plan->scene;
  found f = {t, 0};
  size_t n = 0;
  while (t->batch->inputs[n]) n++;
  for (size_t k = 0; k < n; k++) {
    const size_t own = rot_input_named(scene->n, scene->inputs, t->batch->inputs[k]);
    t->bound[k] = t->plan->n_inputs;
    if (own < scene->n && scene->values[own].is != ROT_VALUE_UNSET) t->rows.given |= 1u << k;
  }
  rot_variants_walk(scene, take_place, &f);
  t->time_at = t->plan->n_inputs;
  for (size_t i = 0; i < t->plan->n_inputs; i++) {
    const size_t k = named(t->batch->inputs, t->plan->inputs[i]);
    if (k < n && f.places >> k & 1) {
      t->bound[k] = i;
      t->rows.given |= 1u << k;
    } else if (!strcmp(t->plan->inputs[i], "time_s") && t->time_at == t->plan->n_inputs) {
      t->time_at = i;
    } else {
      return 0;
    }
  }
  return 1;
}

/* Outputs that follow from the states at both times; 0: one does not. */
static int bind_outputs(rot_table *t) {
  const rot_constraint *c = t->plan->scene->constraint;
  t->outputs = calloc(t->plan->n_outputs + 1, sizeof *t->outputs);
  t->from = calloc(t->plan->n_outputs + 1, sizeof *t->from);
  if (!t->outputs || !t->from) return 0;
  for (size_t k = 0; k < t->plan->n_outputs; k++) {
    rot_output_of *output = &t->outputs[k];
    if (!rot_output_named(c, t->plan->outputs[k], output)) return 0;
    t->from[k] = t->n_columns;
    switch (output->kind) {
    case ROT_OUT_ERROR: continue;
    case ROT_OUT_FINAL:
    case ROT_OUT_MAX:
    case ROT_OUT_MIN:
    case ROT_OUT_MAX_ABS: break;
    default: return 0;
    }
    t->from[k] = named(t->batch->columns, c->columns[output->at].name);
    if (t->from[k] == t->n_columns) return 0;
  }
  return 1;
}

static int open_batch(rot_table *t, const rot_batch *batch) {
  t->batch = batch;
  t->n_columns = 0;
  while (batch->columns[t->n_columns]) t->n_columns++;
  for (size_t k = 0; k < t->n_columns; k++) {
    t->rows.start[k] = t->start[k];
    t->rows.end[k] = t->end[k];
  }
  t->start_s = t->plan->scene->constraint->start_s(t->scene);
  return takes(t->plan, batch, t->scene) && bind_inputs(t) && bind_outputs(t);
}

rot_status rot_table_open(const rot_row_plan *plan, rot_table **to) {
  const rot_constraint *c = plan->scene ? plan->scene->constraint : NULL;
  *to = NULL;
  if (!c || !c->batches || !plan->model || plan->n_times != 1) return ROT_OK;
  const rot_batch *batch = c->batches;
  while (batch->model && strcmp(batch->model, plan->model)) batch++;
  if (!batch->model) return ROT_OK;
  rot_table *t = calloc(1, sizeof *t);
  if (!t) return ROT_ENOMEM;
  rot_refusal no;
  t->plan = plan;
  const rot_status status = rot_variants_new(plan->scene, 0, NULL, &t->variants, &no);
  if (status == ROT_OK) t->scene = rot_variants_base(t->variants);
  if (status == ROT_OK && open_batch(t, batch)) {
    *to = t;
    return ROT_OK;
  }
  rot_table_close(t);
  return status == ROT_ENOMEM ? ROT_ENOMEM : ROT_OK;
}

void rot_table_close(rot_table *t) {
  if (!t) return;
  rot_variants_free(t->variants);
  free(t->outputs);
  free(t->from);
  free(t);
}

/* ---- rows ------------------------------------------------------------------------------------ */

/* In the domain of its input, and finite. */
static int possible(const rot_table *t, size_t k, double x) {
  return isfinite(x) && (t->above[k] ? x > t->low[k] : x >= t->low[k]) && x <= t->high[k];
}

static double of_states(rot_output_kind kind, double start, double end, int moved) {
  const double first = moved ? start : end;
  switch (kind) {
  case ROT_OUT_MAX: return end > first ? end : first;
  case ROT_OUT_MIN: return end < first ? end : first;
  case ROT_OUT_MAX_ABS: return fabs(end) > fabs(first) ? fabs(end) : fabs(first);
  default: return end;
  }
}

rot_status rot_table_run(rot_table *t, size_t first, size_t n, const double *const input[],
                         double *const output[], double error[], int status[]) {
  const rot_row_plan *plan = t->plan;
  rot_batch_rows *rows = &t->rows;
  int own[ROT_BATCH_ROWS];
  rows->n = n;
  rows->error = error;
  rows->status = own;
  for (size_t i = 0; i < n; i++) status[i] = ROT_OK;
  for (size_t k = 0; t->batch->inputs[k]; k++) {
    const size_t at = t->bound[k];
    rows->input[k] = (rot_column){NULL, 0};
    if (at == plan->n_inputs) continue;
    rows->input[k] = (rot_column){input[at] + first, 1};
    for (size_t i = 0; i < n; i++) {
      if (!possible(t, k, input[at][first + i])) status[i] = ROT_TABLE_LEFT;
    }
  }
  const int varies = t->time_at < plan->n_inputs;
  rows->time_s =
      varies ? (rot_column){input[t->time_at] + first, 1} : (rot_column){plan->time_s, 0};
  for (size_t i = 0; i < n; i++) {
    const double time_s = rot_at(rows->time_s, i);
    if (!isfinite(time_s - t->start_s) || time_s < t->start_s) status[i] = ROT_TABLE_LEFT;
  }
  const rot_status ran = t->batch->run(t->scene, rows);
  if (ran != ROT_OK) return ran;
  for (size_t i = 0; i < n; i++) {
    if (own[i] != ROT_OK || !isfinite(error[i])) status[i] = ROT_TABLE_LEFT;
  }
  for (size_t k = 0; k < plan->n_outputs; k++) {
    const size_t from = t->from[k];
    for (size_t i = 0; i < n; i++) {
      output[k][first + i] = from == t->n_columns
                                 ? error[i]
                                 : of_states(t->outputs[k].kind, t->start[from][i], t->end[from][i],
                                             rot_at(rows->time_s, i) > t->start_s);
    }
  }
  return ROT_OK;
}
