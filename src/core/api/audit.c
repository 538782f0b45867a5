#include "api/audit.h"

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "api/work.h"

/* All columns and flows of a run. */
typedef struct rows {
  void *column[ROT_MAX_COLUMNS];    /* doubles or flags, in memory of doubles */
  double *flow[ROT_MAX_FLOWS];      /* since the start, at each time */
  double flow_error[ROT_MAX_FLOWS]; /* of all rows */
  double *memory;
} rows;

static rotdyn_status open_rows(const rot_constraint *c, size_t n, size_t rows_per_time, rows *r) {
  const size_t each = n * rows_per_time;
  if (each / rows_per_time != n ||
      each > SIZE_MAX / sizeof(double) / (c->n_columns + c->n_flows + 1)) {
    return ROTDYN_EMEMORY;
  }
  r->memory = malloc((c->n_columns * each + c->n_flows * n + 1) * sizeof *r->memory);
  if (!r->memory) return ROTDYN_EMEMORY;
  for (size_t i = 0; i < c->n_columns; i++) r->column[i] = r->memory + i * each;
  for (size_t k = 0; k < c->n_flows; k++) {
    r->flow[k] = r->memory + c->n_columns * each + k * n;
    r->flow_error[k] = 0.0;
  }
  return ROTDYN_OK;
}

/* => flows from the first to the last time. An adaptive model integrates them with all rows; a
 * closed form computes them at the two times only, as for R. */
static rotdyn_status run_flows(rot_api_work *w, const void *scene, size_t n, const double time_s[],
                               const rot_outcome *ran, rows *r) {
  const rot_constraint *c = w->built.constraint;
  const rot_model *model = ran->picked.model;
  const int all = model->error_kind == ROT_ADAPTIVE;
  const double ends[] = {time_s[0], time_s[n - 1]};
  const double max = fmin(w->options.max_steps, 1e15);
  const rot_task task = {.n = all                 ? n
                              : ends[0] < ends[1] ? 2
                                                  : 1,
                         .time_s = all ? time_s : ends,
                         .accuracy = w->options.accuracy,
                         .max_steps = (size_t)max + n,
                         .asked = !all || w->options.model};
  const rot_rows want = {.flow = r->flow, .flow_error = r->flow_error};
  rot_outcome o;
  memset(&o, 0, sizeof o);
  rot_run_model(c, scene, model, &task, &want, &o, &w->hooks);
  rot_events_free(&o.events);
  for (size_t k = 0; k < c->n_flows && o.info.status == ROT_OK; k++) {
    r->flow[k][0] = r->flow[k][task.n - 1] - r->flow[k][0];
  }
  return rot_api_status(o.info.status);
}

/* terms => balance */
static void fill_balance(const rot_constraint *c, const void *scene, size_t k, const double term[],
                         const double explained[], rotdyn_balance *b) {
  const char *why[ROT_MAX_CAUSES];
  for (size_t i = 0; i < c->n_terms && b->n_terms < 16; i++) {
    const rot_balance_term *of = &c->terms[i];
    const char *words = of->balance == k ? rot_run_term_words(c, scene, i) : NULL;
    if (!words) continue;
    b->term[b->n_terms] = words;
    b->role[b->n_terms] = (int)of->role;
    b->value[b->n_terms++] = term[i];
  }
  const rot_balance_sums sums = rot_run_balance(c, scene, k, term, explained);
  b->quantity = c->balances[k].quantity;
  b->about = c->balances[k].about;
  b->unit = c->balances[k].unit;
  b->supplied = sums.supplied;
  b->dissipated = sums.dissipated;
  b->change = sums.change;
  b->residual = sums.residual;
  b->explained = sums.explained;
  b->balanced = sums.balanced;
  if (c->n_kept && k >= c->n_kept) { /* conservation is unknown */
    b->conserved = -1;
    return;
  }
  size_t used = 0;
  const size_t causes = c->conserved(scene, k, why);
  b->conserved = causes == 0;
  for (size_t i = 0; i < (causes ? causes : 1) && used < sizeof b->why; i++) {
    used += (size_t)snprintf(b->why + used, sizeof b->why - used, "%s%s", i ? "; " : "", why[i]);
  }
}

/* scene, times => balance k of the run */
static rotdyn_status audit(rot_api_work *w, size_t n, const double time_s[], size_t k,
                           rotdyn_balance *b) {
  const rot_constraint *c = w->built.constraint;
  const void *scene = w->built.scene;
  rot_store store = {0}; /* of the reduced scene, if effects are left out */
  const size_t rows_per_time = w->report.rows_per_time, cells = c->n_columns * rows_per_time;
  double flow[ROT_MAX_FLOWS], error[ROT_MAX_MEASURES], term[ROT_MAX_TERMS];
  double explained[ROT_MAX_BALANCES];
  rot_outcome o;
  rows r = {.memory = NULL};
  double *cell = malloc(2 * cells * sizeof *cell);
  rotdyn_status status = cell ? open_rows(c, n, rows_per_time, &r) : ROTDYN_EMEMORY;
  memset(&o, 0, sizeof o);
  if (status == ROTDYN_OK) {
    const rot_rows want = {.column = r.column};
    status = rot_api_run(c, scene, &w->options, &w->hooks, n, time_s, &want, &o, &w->report);
    rot_api_events(&o.events, w->options.events);
    rot_events_free(&o.events);
  }
  if (status == ROTDYN_OK) {
    rot_run_cells(c, scene, r.column, 0, cell);
    rot_run_cells(c, scene, r.column, n - 1, cell + cells);
    for (size_t i = 0; i < o.info.n_measures; i++) error[i] = o.info.measure[i].error;
    if (o.picked.dropped && c->reduce) {
      void *solved = rot_store_get(&store, 1, c->scene_size);
      status = ROTDYN_EMEMORY;
      if (solved) status = rot_api_status(c->reduce(scene, o.picked.untaken, &store, solved));
      scene = solved;
    }
    if (status == ROTDYN_OK) status = run_flows(w, scene, n, time_s, &o, &r);
  }
  if (status == ROTDYN_OK) {
    for (size_t i = 0; i < c->n_flows; i++) flow[i] = r.flow[i][0];
    const rot_span span = {
        {time_s[0], time_s[n - 1]}, cell, cell + cells, flow, r.flow_error, error};
    status = rot_api_status(rot_run_audit(c, scene, &span, term, explained));
    if (status == ROTDYN_OK) fill_balance(c, scene, k, term, explained, b);
  }
  free(cell);
  free(r.memory);
  rot_store_free(&store);
  return status;
}

int rotdyn_scene_balance(const rotdyn_object *scene, size_t n, const double *time_s,
                         const rotdyn_options *options, size_t k, rotdyn_balance *out,
                         rotdyn_report *report) {
  rot_api_work w;
  rotdyn_balance b = {0};
  rotdyn_status status = rot_api_open(scene, n, time_s, options, &w);
  if (status == ROTDYN_OK) {
    if (!out || n == 0) {
      status = rot_api_refuse(&w, NULL, "`out` is NULL, or there are no times");
    } else if (k >= w.built.constraint->n_balances) {
      status = ROTDYN_EEND;
    } else {
      status = audit(&w, n, time_s, k, &b);
    }
  }
  if (status == ROTDYN_OK && !rot_api_give(&b, sizeof b, out)) status = ROTDYN_EARGUMENT;
  return rot_api_close(status, &w, report);
}
