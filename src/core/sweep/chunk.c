#include "sweep/chunk.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

/* Memory of one block, and the trees of its sums. */
typedef struct work {
  const rot_chunk_plan *plan;
  size_t n_inputs, n_outputs; /* derived ones among the inputs */
  double **column;            /* inputs, then outputs */
  double *memory, *error, *holds;
  int *status;
  rot_tree *summaries, *means, *indices;
} work;

static rot_status open_work(work *w, const rot_chunk_plan *plan) {
  const rot_sweep *sweep = plan->sweep;
  const size_t rows = plan->block_rows;
  w->plan = plan;
  w->n_inputs = sweep->design.n_inputs + sweep->n_derived;
  w->n_outputs = sweep->plan.n_outputs;
  const size_t columns = w->n_inputs + w->n_outputs;
  w->column = malloc((columns + 1) * sizeof *w->column);
  w->memory = malloc((columns + 2) * rows * sizeof *w->memory);
  w->status = malloc(rows * sizeof *w->status);
  if (!w->column || !w->memory || !w->status) return ROT_ENOMEM;
  for (size_t k = 0; k < columns; k++) w->column[k] = w->memory + k * rows;
  w->error = w->memory + columns * rows;
  w->holds = w->error + rows;
  if (!plan->summed) return ROT_OK;
  w->summaries = rot_tree_new(&rot_summary_node);
  w->means = rot_tree_new(&rot_means_node);
  w->indices = rot_tree_new(&rot_indices_node);
  return w->summaries && w->means && w->indices ? ROT_OK : ROT_ENOMEM;
}

static void close_work(work *w) {
  free(w->column);
  free(w->memory);
  free(w->status);
  if (w->summaries) rot_tree_free(w->summaries);
  if (w->means) rot_tree_free(w->means);
  if (w->indices) rot_tree_free(w->indices);
}

/* ---- rows that are kept ---------------------------------------------------------------------- */

static int grow(double **x, size_t room) {
  double *more = room < SIZE_MAX / sizeof *more ? realloc(*x, room * sizeof *more) : NULL;
  if (more) *x = more;
  return more != NULL;
}

static rot_status make_room(rot_kept *kept, size_t n) {
  if (kept->n + n <= kept->room) return ROT_OK;
  const size_t room = kept->n + n > 2 * kept->room ? kept->n + n : 2 * kept->room;
  for (size_t k = 0; k < kept->n_columns; k++) {
    if (!grow(&kept->column[k], room)) return ROT_ENOMEM;
  }
  if (!grow(&kept->row, room) || !grow(&kept->error, room)) return ROT_ENOMEM;
  int *status = realloc(kept->status, room * sizeof *status);
  if (!status) return ROT_ENOMEM;
  kept->status = status;
  kept->room = room;
  return ROT_OK;
}

/* Appends the rows of a block for which holds[i] is neither 0 nor NaN (NULL: all). */
static rot_status keep_rows(const work *w, uint64_t first, size_t n, const double *holds,
                            rot_kept *kept, uint64_t *count) {
  rot_status status = make_room(kept, n);
  *count = 0;
  for (size_t i = 0; i < n && status == ROT_OK; i++) {
    if (holds && (holds[i] == 0.0 || isnan(holds[i]))) continue;
    const size_t to = kept->n++;
    for (size_t k = 0; k < kept->n_columns; k++) kept->column[k][to] = w->column[k][i];
    kept->row[to] = (double)(first + i);
    kept->error[to] = w->error[i];
    kept->status[to] = w->status[i];
    ++*count;
  }
  return status;
}

/* ---- the checksum ---------------------------------------------------------------------------- */

/* One round of a multiplicative hash; the constant is that of Steele and Vigna's splitmix. */
static uint64_t mixed(uint64_t hash, uint64_t bits) {
  hash = (hash ^ bits) * UINT64_C(0xbf58476d1ce4e5b9);
  return hash ^ hash >> 31;
}

static uint64_t bits_of(double x) {
  uint64_t bits;
  memcpy(&bits, &x, sizeof bits);
  /* NaNs are one: their bits are no result. */
  return x == x ? bits : UINT64_C(0x7ff8000000000000);
}

static uint64_t sum_of_rows(const work *w, uint64_t first, size_t n) {
  const size_t columns = w->n_inputs + w->n_outputs;
  uint64_t sum = 0;
  for (size_t i = 0; i < n; i++) {
    uint64_t hash = mixed(first + i + 1, (uint64_t)w->status[i]);
    for (size_t k = 0; k < columns; k++) hash = mixed(hash, bits_of(w->column[k][i]));
    sum += mixed(hash, bits_of(w->error[i]));
  }
  return sum;
}

/* ---- sums ------------------------------------------------------------------------------------ */

static rot_status add_summary(work *w, uint64_t first, size_t n, const double *const output[],
                              uint64_t kept) {
  const rot_chunk_plan *plan = w->plan;
  rot_summary *part = rot_summary_new(w->n_outputs, plan->shift, plan->block_rows);
  if (!part) return ROT_ENOMEM;
  const rot_summary_block block = {.first_row = first,
                                   .n = n,
                                   .column = output,
                                   .status = w->status,
                                   .error = w->error,
                                   .accuracy = plan->sweep->plan.accuracy,
                                   .kept = kept};
  rot_status status = rot_summary_add(part, &block);
  if (status == ROT_OK) status = rot_tree_add(w->summaries, part);
  if (status != ROT_OK) rot_summary_free(part);
  return status;
}

static rot_status add_means(work *w, uint64_t first, size_t n, const double *const output[]) {
  rot_means *part =
      rot_means_new(w->n_outputs, w->plan->replicates, w->plan->run, w->plan->block_rows);
  if (!part) return ROT_ENOMEM;
  rot_status status = rot_means_add(part, first, n, output, w->status);
  if (status == ROT_OK) status = rot_tree_add(w->means, part);
  if (status != ROT_OK) rot_means_free(part);
  return status;
}

static rot_status add_indices(work *w, uint64_t first, size_t n, const double *const output[]) {
  const rot_design *design = &w->plan->sweep->design;
  if (design->kind != ROT_DESIGN_SALTELLI) return ROT_OK;
  rot_indices *part = rot_indices_new(design->n_varied, w->n_outputs, w->plan->shift, w->plan->run,
                                      w->plan->block_rows);
  if (!part) return ROT_ENOMEM;
  rot_status status = rot_indices_add(part, first, n, output, w->status);
  if (status == ROT_OK) status = rot_tree_add(w->indices, part);
  if (status != ROT_OK) rot_indices_free(part);
  return status;
}

/* ---- the chunk ------------------------------------------------------------------------------- */

/* The fraction of the chunk that a fraction of a block is. */
typedef struct progress {
  const rot_hooks *hooks;
  double done, part;
} progress;

static rot_status poll_part(void *ctx, double fraction) {
  const progress *p = ctx;
  return rot_poll(p->hooks, p->done + p->part * fraction);
}

/* Rows `at` and on of those that the caller has computed => the block. */
static void copy_block(const work *w, const rot_block *given, size_t at, size_t n) {
  for (size_t k = 0; k < w->n_inputs; k++) {
    memcpy(w->column[k], given->input[k] + at, n * sizeof **w->column);
  }
  for (size_t k = 0; k < w->n_outputs; k++) {
    memcpy(w->column[w->n_inputs + k], given->output[k] + at, n * sizeof **w->column);
  }
  memcpy(w->status, given->status + at, n * sizeof *w->status);
  memcpy(w->error, given->error + at, n * sizeof *w->error);
}

static rot_status run_block(work *w, uint64_t first, size_t at, size_t n, progress *p,
                            rot_chunk *chunk, rot_refusal *no) {
  const rot_chunk_plan *plan = w->plan;
  const rot_block block = {w->column, w->column + w->n_inputs, w->status, w->error};
  const double *const *all = (const double *const *)w->column;
  const double *const *output = all + w->n_inputs;
  const rot_hooks hooks = {poll_part, p};
  rot_info info;
  uint64_t kept = 0;
  rot_status status = ROT_OK;
  if (plan->given)
    copy_block(w, plan->given, at, n);
  else
    status = rot_block_run(plan->sweep, first, n, &block, &hooks, &info, no);
  if (status == ROT_OK) chunk->checksum += sum_of_rows(w, first, n);
  if (status == ROT_OK && plan->keep == ROT_KEEP_SOME) {
    status = rot_formula_rows(plan->condition, n, all, w->holds);
  }
  if (status == ROT_OK && plan->keep != ROT_KEEP_NONE) {
    status =
        keep_rows(w, first, n, plan->keep == ROT_KEEP_SOME ? w->holds : NULL, &chunk->kept, &kept);
  }
  if (!plan->summed || status != ROT_OK) return status;
  status = add_summary(w, first, n, output, kept);
  if (status == ROT_OK) status = add_means(w, first, n, output);
  return status == ROT_OK ? add_indices(w, first, n, output) : status;
}

static rot_status finish(work *w, rot_chunk *chunk) {
  void *node;
  rot_status status = rot_tree_finish(w->summaries, &node);
  if (status == ROT_OK) {
    chunk->summary = node;
    status = rot_tree_finish(w->means, &node);
  }
  if (status != ROT_OK) return status;
  chunk->means = node;
  if (w->plan->sweep->design.kind != ROT_DESIGN_SALTELLI) return ROT_OK;
  status = rot_tree_finish(w->indices, &node);
  if (status == ROT_OK) chunk->indices = node;
  return status;
}

rot_status rot_chunk_run(const rot_chunk_plan *plan, uint64_t first, uint64_t n,
                         const rot_hooks *hooks, rot_chunk *chunk, rot_refusal *no) {
  work w = {0};
  rot_status status = open_work(&w, plan);
  if (status == ROT_OK && plan->keep != ROT_KEEP_NONE) {
    chunk->kept.n_columns = w.n_inputs + w.n_outputs;
    chunk->kept.column = calloc(chunk->kept.n_columns + 1, sizeof *chunk->kept.column);
    if (!chunk->kept.column) status = ROT_ENOMEM;
    if (status == ROT_OK && plan->keep == ROT_KEEP_ALL) {
      status = n < SIZE_MAX / sizeof(double) ? make_room(&chunk->kept, (size_t)n) : ROT_ENOMEM;
    }
  }
  for (uint64_t done = 0; done < n && status == ROT_OK; done += plan->block_rows) {
    const size_t rows = n - done < plan->block_rows ? (size_t)(n - done) : plan->block_rows;
    progress p = {hooks, (double)done / (double)n, (double)rows / (double)n};
    status = run_block(&w, first + done, (size_t)done, rows, &p, chunk, no);
  }
  if (status == ROT_OK && plan->summed) status = finish(&w, chunk);
  close_work(&w);
  return status;
}

void rot_chunk_free(rot_chunk *chunk) {
  for (size_t k = 0; k < chunk->kept.n_columns && chunk->kept.column; k++) {
    free(chunk->kept.column[k]);
  }
  free(chunk->kept.column);
  free(chunk->kept.row);
  free(chunk->kept.error);
  free(chunk->kept.status);
  if (chunk->summary) rot_summary_free(chunk->summary);
  if (chunk->means) rot_means_free(chunk->means);
  if (chunk->indices) rot_indices_free(chunk->indices);
  memset(chunk, 0, sizeof *chunk);
}
