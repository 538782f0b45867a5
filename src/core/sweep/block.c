#include "sweep/block.h"

#include <math.h>

#include "ground/parallel.h"

typedef struct frame {
  const rot_sweep *sweep;
  const rot_block *block;
} frame;

enum { MAX_INPUTS = 64 };

/* Rows first .. last - 1, for rot_parallel_rows(). */
static void run_part(const void *of, size_t first, size_t last) {
  const frame *f = of;
  const rot_row_plan *plan = &f->sweep->plan;
  rot_rows_worker *worker;
  rot_refusal no;
  const rot_status opened = rot_rows_open(plan, &worker, &no);
  double input[MAX_INPUTS], output[MAX_INPUTS];
  for (size_t i = first; i < last; i++) {
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
  rot_rows_close(worker);
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
