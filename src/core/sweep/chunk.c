#include "sweep/chunk.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "ground/parallel.h"

/* Memory of one block, and what is made of it. */
typedef struct slot {
  double **column; /* inputs, then outputs */
  double *memory, *error, *holds;
  int *status;
  uint64_t first; /* row */
  size_t at, n;   /* of the chunk's rows; how many */
  rot_status end;
  rot_refusal no;
  uint64_t checksum;
  rot_kept kept; /* of ROT_KEEP_SOME */
  rot_summary *summary;
  rot_means *means;
  rot_indices *indices;
} slot;

/* The blocks that are computed at a time, and the trees of their sums. */
typedef struct work {
  const rot_chunk_plan *plan;
  rot_sweep sweep;            /* how a block is computed */
  size_t n_inputs, n_outputs; /* derived ones among the inputs */
  int threads;                /* that take blocks, one each */
  size_t n_slots;
  slot *slots;
  rot_kept *all; /* of ROT_KEEP_ALL: the rows of the chunk */
  const rot_hooks *hooks;
  rot_tree *summaries, *means, *indices;
} work;

enum { MAX_THREADS = 64, QUICK_PARTS = 128 };

/* Threads take whole blocks, design and sums with them, if there are enough and each is quick: only
 * the calling thread polls, between two blocks. Else they share the rows of one. Each has one block
 * at a time: two of 5 MB leave the caches, and two threads were 1.7 times one, not 1.8. */
static void divide_threads(work *w, uint64_t rows) {
  const rot_chunk_plan *plan = w->plan;
  const size_t part = plan->sweep->part ? plan->sweep->part : 256;
  int threads = plan->sweep->threads;
  if (threads < 1 || threads > rot_parallel_threads()) threads = rot_parallel_threads();
  if (threads > MAX_THREADS) threads = MAX_THREADS;
  w->sweep = *plan->sweep;
  w->threads = 1;
  if (plan->given || plan->block_rows / part > QUICK_PARTS ||
      rows / plan->block_rows < 2 * (uint64_t)threads) {
    return;
  }
  w->threads = threads;
  if (threads > 1) w->sweep.threads = 1;
}

static rot_status open_slot(const work *w, slot *s) {
  const size_t rows = w->plan->block_rows, columns = w->n_inputs + w->n_outputs;
  s->column = malloc((columns + 1) * sizeof *s->column);
  s->memory = malloc((columns + 2) * rows * sizeof *s->memory);
  s->status = malloc(rows * sizeof *s->status);
  if (!s->column || !s->memory || !s->status) return ROT_ENOMEM;
  for (size_t k = 0; k < columns; k++) s->column[k] = s->memory + k * rows;
  s->error = s->memory + columns * rows;
  s->holds = s->error + rows;
  return ROT_OK;
}

static rot_status open_kept(const work *w, rot_kept *kept) {
  kept->n_columns = w->n_inputs + w->n_outputs;
  kept->column = calloc(kept->n_columns + 1, sizeof *kept->column);
  return kept->column ? ROT_OK : ROT_ENOMEM;
}

static void free_kept(rot_kept *kept) {
  for (size_t k = 0; k < kept->n_columns && kept->column; k++) free(kept->column[k]);
  free(kept->column);
  free(kept->row);
  free(kept->error);
  free(kept->status);
}

static rot_status open_work(work *w, const rot_chunk_plan *plan, uint64_t rows) {
  rot_status status = ROT_OK;
  w->plan = plan;
  w->n_inputs = plan->sweep->design.n_inputs + plan->sweep->n_derived;
  w->n_outputs = plan->sweep->plan.n_outputs;
  divide_threads(w, rows);
  const size_t n = (size_t)w->threads;
  w->slots = calloc(n, sizeof *w->slots);
  if (!w->slots) return ROT_ENOMEM;
  for (w->n_slots = 0; w->n_slots < n && status == ROT_OK; w->n_slots++) {
    slot *s = &w->slots[w->n_slots];
    status = open_slot(w, s);
    if (status == ROT_OK && plan->keep == ROT_KEEP_SOME) status = open_kept(w, &s->kept);
  }
  if (!plan->summed || status != ROT_OK) return status;
  w->summaries = rot_tree_new(&rot_summary_node);
  w->means = rot_tree_new(&rot_means_node);
  w->indices = rot_tree_new(&rot_indices_node);
  return w->summaries && w->means && w->indices ? ROT_OK : ROT_ENOMEM;
}

/* What no tree has taken. */
static void drop_sums(slot *s) {
  if (s->summary) rot_summary_free(s->summary);
  if (s->means) rot_means_free(s->means);
  if (s->indices) rot_indices_free(s->indices);
  s->summary = NULL;
  s->means = NULL;
  s->indices = NULL;
}

static void close_work(work *w) {
  for (size_t i = 0; i < w->n_slots; i++) {
    slot *s = &w->slots[i];
    drop_sums(s);
    free_kept(&s->kept);
    free(s->column);
    free(s->memory);
    free(s->status);
  }
  free(w->slots);
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

static void put_row(const slot *s, size_t i, rot_kept *kept, size_t to) {
  for (size_t k = 0; k < kept->n_columns; k++) kept->column[k][to] = s->column[k][i];
  kept->row[to] = (double)(s->first + i);
  kept->error[to] = s->error[i];
  kept->status[to] = s->status[i];
}

/* The rows of a block to their places in the chunk. */
static void keep_all(const slot *s, rot_kept *kept) {
  for (size_t i = 0; i < s->n; i++) put_row(s, i, kept, s->at + i);
}

/* Those for which holds[i] is neither 0 nor NaN. */
static rot_status keep_some(slot *s) {
  s->kept.n = 0;
  const rot_status status = make_room(&s->kept, s->n);
  for (size_t i = 0; i < s->n && status == ROT_OK; i++) {
    if (s->holds[i] != 0.0 && !isnan(s->holds[i])) put_row(s, i, &s->kept, s->kept.n++);
  }
  return status;
}

static rot_status append(const rot_kept *from, rot_kept *to) {
  const rot_status status = make_room(to, from->n);
  if (status != ROT_OK || from->n == 0) return status;
  const size_t bytes = from->n * sizeof(double);
  for (size_t k = 0; k < to->n_columns; k++) memcpy(to->column[k] + to->n, from->column[k], bytes);
  memcpy(to->row + to->n, from->row, bytes);
  memcpy(to->error + to->n, from->error, bytes);
  memcpy(to->status + to->n, from->status, from->n * sizeof *to->status);
  to->n += from->n;
  return ROT_OK;
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

static uint64_t sum_of_rows(const slot *s, size_t columns) {
  uint64_t sum = 0;
  for (size_t i = 0; i < s->n; i++) {
    uint64_t hash = mixed(s->first + i + 1, (uint64_t)s->status[i]);
    for (size_t k = 0; k < columns; k++) hash = mixed(hash, bits_of(s->column[k][i]));
    sum += mixed(hash, bits_of(s->error[i]));
  }
  return sum;
}

/* ---- a block --------------------------------------------------------------------------------- */

static rot_status sum_block(const work *w, slot *s, uint64_t kept) {
  const rot_chunk_plan *plan = w->plan;
  const rot_design *design = &plan->sweep->design;
  const double *const *output = (const double *const *)s->column + w->n_inputs;
  const rot_summary_block block = {.first_row = s->first,
                                   .n = s->n,
                                   .column = output,
                                   .status = s->status,
                                   .error = s->error,
                                   .accuracy = plan->sweep->plan.accuracy,
                                   .kept = kept};
  s->summary = rot_summary_new(w->n_outputs, plan->shift, plan->block_rows);
  s->means = rot_means_new(w->n_outputs, plan->replicates, plan->run, plan->block_rows);
  if (!s->summary || !s->means) return ROT_ENOMEM;
  rot_status status = rot_summary_add(s->summary, &block);
  if (status == ROT_OK) status = rot_means_add(s->means, s->first, s->n, output, s->status);
  if (status != ROT_OK || design->kind != ROT_DESIGN_SALTELLI) return status;
  s->indices =
      rot_indices_new(design->n_varied, w->n_outputs, plan->shift, plan->run, plan->block_rows);
  return s->indices ? rot_indices_add(s->indices, s->first, s->n, output, s->status) : ROT_ENOMEM;
}

/* Rows that the caller has computed => the block. */
static void copy_block(const work *w, const rot_block *given, slot *s) {
  for (size_t k = 0; k < w->n_inputs; k++) {
    memcpy(s->column[k], given->input[k] + s->at, s->n * sizeof **s->column);
  }
  for (size_t k = 0; k < w->n_outputs; k++) {
    memcpy(s->column[w->n_inputs + k], given->output[k] + s->at, s->n * sizeof **s->column);
  }
  memcpy(s->status, given->status + s->at, s->n * sizeof *s->status);
  memcpy(s->error, given->error + s->at, s->n * sizeof *s->error);
}

/* All that follows from a block's rows alone. */
static rot_status run_block(const work *w, slot *s, const rot_hooks *hooks) {
  const rot_chunk_plan *plan = w->plan;
  const rot_block block = {s->column, s->column + w->n_inputs, s->status, s->error};
  rot_info info;
  rot_status status = ROT_OK;
  uint64_t kept = 0;
  if (plan->given)
    copy_block(w, plan->given, s);
  else
    status = rot_block_run(&w->sweep, s->first, s->n, &block, hooks, &info, &s->no);
  if (status != ROT_OK) return status;
  s->checksum = sum_of_rows(s, w->n_inputs + w->n_outputs);
  if (plan->keep == ROT_KEEP_SOME) {
    status = rot_formula_rows(plan->condition, s->n, (const double *const *)s->column, s->holds);
    if (status == ROT_OK) status = keep_some(s);
    kept = s->kept.n;
  } else if (plan->keep == ROT_KEEP_ALL) {
    keep_all(s, w->all);
    kept = s->n;
  }
  return status == ROT_OK && plan->summed ? sum_block(w, s, kept) : status;
}

/* Slots first .. last - 1, for rot_parallel_rows(). Threads do not poll inside a block. */
static void run_slots(const void *of, size_t first, size_t last) {
  const work *w = of;
  for (size_t i = first; i < last; i++) {
    slot *s = &w->slots[i];
    s->end = run_block(w, s, w->threads > 1 ? NULL : w->hooks);
  }
}

/* ---- the chunk ------------------------------------------------------------------------------- */

/* The fraction of the chunk that a fraction of some blocks is. */
typedef struct progress {
  const rot_hooks *hooks;
  double done, part;
} progress;

static rot_status poll_part(void *ctx, double fraction) {
  const progress *p = ctx;
  return rot_poll(p->hooks, p->done + p->part * fraction);
}

static rot_status add_to(rot_tree *tree, void *node) {
  return node ? rot_tree_add(tree, node) : ROT_OK;
}

/* What was made of a block, in the order of the rows. */
static rot_status take_slot(work *w, slot *s, rot_chunk *chunk, rot_refusal *no) {
  rot_status status = s->end;
  if (status == ROT_EVALUE && no) *no = s->no;
  if (status != ROT_OK) return status;
  chunk->checksum += s->checksum;
  if (w->plan->keep == ROT_KEEP_SOME) status = append(&s->kept, &chunk->kept);
  if (w->plan->keep == ROT_KEEP_ALL) chunk->kept.n += s->n;
  if (!w->plan->summed || status != ROT_OK) return status;
  status = add_to(w->summaries, s->summary);
  if (status != ROT_OK) return status;
  s->summary = NULL;
  status = add_to(w->means, s->means);
  if (status != ROT_OK) return status;
  s->means = NULL;
  status = add_to(w->indices, s->indices);
  if (status == ROT_OK) s->indices = NULL;
  return status;
}

/* The next blocks, as many as there are slots => how many rows they have. */
static rot_status run_wave(work *w, uint64_t first, uint64_t done, uint64_t rows, progress *p,
                           rot_chunk *chunk, rot_refusal *no, uint64_t *ran) {
  const rot_hooks hooks = {poll_part, p};
  const size_t block = w->plan->block_rows;
  rot_info info;
  size_t n = 0;
  *ran = 0;
  for (; n < w->n_slots && done + *ran < rows; n++) {
    slot *s = &w->slots[n];
    const uint64_t left = rows - done - *ran;
    s->first = first + done + *ran;
    s->at = (size_t)(done + *ran);
    s->n = left < block ? (size_t)left : block;
    *ran += s->n;
  }
  p->done = (double)done / (double)rows;
  p->part = (double)*ran / (double)rows;
  w->hooks = &hooks;
  rot_status status = ROT_OK;
  if (w->threads > 1) {
    status = rot_parallel_rows(run_slots, w, n, 1, w->threads, &hooks, &info);
  } else {
    run_slots(w, 0, n);
  }
  for (size_t i = 0; i < n && status == ROT_OK; i++) {
    status = take_slot(w, &w->slots[i], chunk, no);
  }
  return status;
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
  work w = {.all = &chunk->kept};
  progress p = {hooks, 0.0, 0.0};
  rot_status status = open_work(&w, plan, n);
  if (status == ROT_OK && plan->keep != ROT_KEEP_NONE) {
    status = open_kept(&w, &chunk->kept);
    if (status == ROT_OK && plan->keep == ROT_KEEP_ALL) {
      status = n < SIZE_MAX / sizeof(double) ? make_room(&chunk->kept, (size_t)n) : ROT_ENOMEM;
    }
  }
  for (uint64_t done = 0, ran = 0; done < n && status == ROT_OK; done += ran) {
    status = run_wave(&w, first, done, n, &p, chunk, no, &ran);
  }
  if (status == ROT_OK && plan->summed) status = finish(&w, chunk);
  close_work(&w);
  return status;
}

void rot_chunk_free(rot_chunk *chunk) {
  free_kept(&chunk->kept);
  if (chunk->summary) rot_summary_free(chunk->summary);
  if (chunk->means) rot_means_free(chunk->means);
  if (chunk->indices) rot_indices_free(chunk->indices);
  memset(chunk, 0, sizeof *chunk);
}
