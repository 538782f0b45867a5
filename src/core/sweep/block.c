#include "sweep/block.h"

#include <math.h>

#include "ground/parallel.h"
#include "sweep/table.h"

typedef struct frame {
  const rot_sweep *sweep;
  const rot_block *block;
} frame;

enum { MAX_INPUTS = 64 };

/* Row i alone. The worker is there if `opened` is ROT_OK. */
static void run_row(const frame *f, rot_rows_worker *worker, rot_status opened, size_t i) {
  const rot_row_plan *plan = &f->sweep->plan;
  double input[MAX_INPUTS], output[MAX_INPUTS];
  int status = (int)opened;
  f->block->error[i] = NAN;
  for (size_t k = 0; k < plan->n_outputs; k++) output[k] = NAN;
  for (size_t k = 0; k < plan->n_inputs; k++) {
    input[k] = f->block->input[f->sweep->bound[k]][i];
  }
  if (opened == ROT_OK) {
    status = rot_rows_run(worker, input, output, &f->block->error[i], NULL, NULL);
  }
  for (size_t k = 0; k < plan->n_outputs; k++) f->block->output[k][i] = output[k];
  f->block->status[i] = status;
}

/* Rows first .. last - 1 by the kernel; those that it leaves by themselves. */
static void run_table(const frame *f, rot_table *table, size_t first, size_t last) {
  const rot_row_plan *plan = &f->sweep->plan;
  const double *input[MAX_INPUTS];
  rot_rows_worker *worker = NULL;
  rot_status opened = ROT_OK;
  for (size_t k = 0; k < plan->n_inputs; k++) input[k] = f->block->input[f->sweep->bound[k]];
  for (size_t start = first; start < last; start += ROT_BATCH_ROWS) {
    const size_t n = last - start < ROT_BATCH_ROWS ? last - start : ROT_BATCH_ROWS;
    int *status = f->block->status + start;
    const rot_status ran =
        rot_table_run(table, start, n, input, f->block->output, f->block->error + start, status);
    for (size_t i = 0; i < n; i++) {
      rot_refusal no;
      if (ran == ROT_OK && status[i] == ROT_OK) continue;
      if (ran == ROT_OK && !worker && opened == ROT_OK) opened = rot_rows_open(plan, &worker, &no);
      run_row(f, worker, ran == ROT_OK ? opened : ran, start + i);
    }
  }
  rot_rows_close(worker);
}

/* Rows first .. last - 1, for rot_parallel_rows(). */
static void run_part(const void *of, size_t first, size_t last) {
  const frame *f = of;
  const rot_row_plan *plan = &f->sweep->plan;
  rot_table *table = NULL;
  rot_rows_worker *worker;
  rot_refusal no;
  rot_status opened = f->sweep->table ? rot_table_open(plan, &table) : ROT_OK;
  if (table) {
    run_table(f, table, first, last);
    rot_table_close(table);
    return;
  }
  if (opened == ROT_OK) opened = rot_rows_open(plan, &worker, &no);
  for (size_t i = first; i < last; i++) run_row(f, worker, opened, i);
  if (opened == ROT_OK) rot_rows_close(worker);
}

rot_status rot_block_run(const rot_sweep *sweep, uint64_t first, size_t n, const rot_block *block,
                         const rot_hooks *hooks, rot_info *info, rot_refusal *no) {
  const rot_row_plan *plan = &sweep->plan;
  const frame f = {sweep, block};
  rot_info_clear(info, NULL);
  if (plan->n_inputs > MAX_INPUTS || plan->n_outputs > MAX_INPUTS) {
    return rot_refuse(no, 0, "has more than %d inputs or outputs", (int)MAX_INPUTS);
  }
  rot_rows_worker *worker; /* checks the plan once */
  rot_status status = rot_rows_open(plan, &worker, no);
  if (status == ROT_OK) rot_rows_close(worker);
  if (status == ROT_OK) status = rot_design_rows(&sweep->design, first, n, block->input);
  for (size_t k = 0; k < sweep->n_derived && status == ROT_OK; k++) {
    status = rot_formula_rows(&sweep->derived[k], n, (const double *const *)block->input,
                              block->input[sweep->design.n_inputs + k]);
  }
  if (status != ROT_OK) return status;
  return rot_parallel_rows(run_part, &f, n, sweep->part ? sweep->part : 256, sweep->threads, hooks,
                           info);
}
