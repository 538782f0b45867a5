#include "scene/run.h"

#include "ground/real.h"
#include "ground/sort.h"

#include <float.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

const rot_maker *rot_run_maker(const char *constructor, const rot_constraint **of) {
  size_t n;
  const rot_constraint *const *list = rot_choice_constraints(&n);
  for (size_t i = 0; i < n; i++) {
    for (size_t k = 0; k < list[i]->n_makers; k++) {
      if (strcmp(list[i]->makers[k].constructor, constructor)) continue;
      *of = list[i];
      return &list[i]->makers[k];
    }
  }
  return NULL;
}

rot_status rot_run_build(const rot_maker *maker, const rot_given given[], rot_store *store,
                         void *scene, rot_refusal *refusal) {
  const rot_status status = rot_inputs_check(maker->n_inputs, maker->inputs, given, refusal);
  return status == ROT_OK ? maker->build(given, store, scene, refusal) : status;
}

size_t rot_run_column(const rot_constraint *constraint, const char *name) {
  size_t i = 0;
  while (i < constraint->n_columns && strcmp(constraint->columns[i].name, name)) i++;
  return i;
}

size_t rot_run_rows_per_time(const rot_constraint *constraint, const void *scene) {
  return constraint->rows_per_time ? constraint->rows_per_time(scene) : 1;
}

/* What decides which columns a scene shows. */
typedef struct showing {
  unsigned effects;
  uint64_t mask;
} showing;

static showing showing_of(const rot_constraint *c, const void *scene) {
  return (showing){c->effects_of(scene), c->shows ? c->shows(scene) : ~(uint64_t)0};
}

static int shows(const rot_constraint *c, showing by, size_t column) {
  const unsigned with = c->columns[column].only_with;
  return !with || ((with == ROT_AS_SHOWN || with & by.effects) && (by.mask >> column & 1u));
}

int rot_run_shows(const rot_constraint *constraint, const void *scene, unsigned effects,
                  size_t column) {
  const uint64_t mask = constraint->shows ? constraint->shows(scene) : ~(uint64_t)0;
  return shows(constraint, (showing){effects, mask}, column);
}

const char *rot_run_term_words(const rot_constraint *constraint, const void *scene, size_t term) {
  const rot_balance_term *of = &constraint->terms[term];
  if (constraint->term_words) return constraint->term_words(scene, term);
  return !of->only_with || of->only_with & constraint->effects_of(scene) ? of->words : NULL;
}

/* ---- one run --------------------------------------------------------------------------------- */

typedef struct job {
  const rot_constraint *constraint;
  const void *scene;
  const rot_hooks *hooks;
  void *column[ROT_MAX_COLUMNS]; /* every column of the constraint, if one is not wanted */
  void *memory;                  /* of the columns that the caller does not want */
  rot_rows rows;                 /* without the events */
} job;

/* (times, want) => pointers to all columns; those missing in `want` (or all, want NULL) are
 * allocated. */
static rot_status open_columns(job *j, size_t n_times, const rot_rows *want) {
  const rot_constraint *c = j->constraint;
  void *const *column = want ? want->column : NULL;
  int lacks[ROT_MAX_COLUMNS];
  size_t missing = 0, there = 0;
  while (column && !want->cells && there < c->n_columns && column[there]) there++;
  if (want && (want->cells || there == c->n_columns)) {
    j->rows = *want;
    return ROT_OK;
  }
  const size_t n = n_times * rot_run_rows_per_time(c, j->scene);
  /* A constraint with its own shows() writes no other columns. */
  const showing by = showing_of(c, j->scene);
  for (size_t i = 0; i < c->n_columns; i++) {
    j->column[i] = column ? column[i] : NULL;
    lacks[i] = !j->column[i] && (!c->shows || shows(c, by, i));
    missing += (size_t)lacks[i];
  }
  if (missing && n > (SIZE_MAX - 1) / sizeof(double) / missing) return ROT_ENOMEM;
  char *at = j->memory = missing ? malloc(missing * n * sizeof(double) + 1) : NULL;
  if (missing && !at) return ROT_ENOMEM;
  for (size_t i = 0; i < c->n_columns; i++) {
    if (!lacks[i]) continue;
    j->column[i] = at;
    at += n * sizeof(double);
  }
  j->rows = (rot_rows){.column = j->column,
                       .flow = want ? want->flow : NULL,
                       .flow_error = want ? want->flow_error : NULL,
                       .at_events = want ? want->at_events : NULL};
  return ROT_OK;
}

static const rot_model_run *run_of(const rot_constraint *c, const rot_model *model) {
  return &c->runs[model - c->models];
}

static rot_status run_model(const job *j, const rot_model *model, const rot_task *task,
                            rot_events *events, rot_info *info) {
  const rot_model_run *run = run_of(j->constraint, model);
  rot_rows rows = j->rows;
  rows.events = events;
  return run->run(j->scene, task, run->method, &rows, j->hooks, info);
}

/* 1 if a shown column contains Inf. */
static int beyond_doubles(const job *j, size_t n) {
  const rot_constraint *c = j->constraint;
  const size_t cells = j->rows.cells;
  /* Usually one look at all the memory is enough. Column by column, a row of a sweep took 1.31
   * times its builder and model; so 1.25 (`bench/sweep-scale.R`, incline). */
  if (cells && cells <= 4 * n * c->n_columns && rot_all_finite(cells, j->rows.column[0])) return 0;
  const showing by = showing_of(c, j->scene);
  int finite = 1;
  for (size_t i = 0; i < c->n_columns; i++) {
    if (!c->columns[i].flag && shows(c, by, i)) finite &= rot_all_finite(n, j->rows.column[i]);
  }
  if (finite) return 0;
  for (size_t i = 0; i < c->n_columns; i++) {
    const double *x = j->rows.column[i];
    if (c->columns[i].flag || !shows(c, by, i)) continue;
    for (size_t k = 0; k < n; k++) {
      if (isinf(x[k])) return 1;
    }
  }
  return 0;
}

/* ---- the sizes of the motion ----------------------------------------------------------------- */

enum { SAMPLES = 256 };

/* Closed forms record the largest values at the rows only. Evaluates more times, unevenly spaced so
 * that no period of the motion hides larger values. */
static void measure_between_rows(const job *j, const rot_model *model, const rot_task *task,
                                 rot_info *info) {
  const double start = j->constraint->start_s(j->scene);
  const double from = fmin(start, task->time_s[0]);
  const double to = fmax(start, task->time_s[task->n - 1]);
  double time_s[SAMPLES];
  rot_task more = *task;
  rot_events events = {0};
  rot_info seen;
  job own = *j;
  for (int i = 0; i < SAMPLES; i++) {
    time_s[i] = from + (to - from) * fmod((i + 1) * 0.6180339887498949, 1.0);
  }
  rot_sort(SAMPLES, time_s);
  more.n = SAMPLES;
  more.time_s = time_s;
  more.sizes_only = 1;
  if (open_columns(&own, more.n, NULL) != ROT_OK) return;
  rot_info_clear(&seen, j->constraint->measures); /* a run finds it cleared */
  if (run_model(&own, model, &more, &events, &seen) == ROT_OK) {
    for (size_t i = 0; i < info->n_measures; i++) {
      info->measure[i].largest = fmax(info->measure[i].largest, seen.measure[i].largest);
    }
  }
  free(own.memory);
  rot_events_free(&events);
}

/* ---- choose and run -------------------------------------------------------------------------- */

/* (out->picked, task) => rows, outcome: errors of the run and of dropped effects, sizes. */
static void run_picked(const job *j, const rot_task *task, int asked, rot_outcome *out) {
  const rot_constraint *constraint = j->constraint;
  const rot_candidate *c = &out->picked;
  rot_task own = *task;
  own.asked = asked;
  own.without = c->dropped ? c->untaken : 0u;
  rot_events_free(&out->events);
  memset(&out->events, 0, sizeof out->events);
  out->model = c->model;
  rot_info_clear(&out->info, constraint->measures);
  out->info.status = run_model(j, c->model, &own, &out->events, &out->info);
  /* An integrator may switch to another method: report the model of that method. */
  for (size_t i = 0; i < constraint->n_models && out->info.method != ROT_METHOD_NONE; i++) {
    if (constraint->runs[i].method == out->info.method) out->model = &constraint->models[i];
  }
  for (size_t i = 0; i < out->info.n_measures && c->dropped; i++) {
    out->info.measure[i].error += c->drop.bound[i];
  }
  out->error = rot_info_error(&out->info);
  if (out->info.status != ROT_OK) return;
  if (beyond_doubles(j, task->n * rot_run_rows_per_time(constraint, j->scene))) {
    out->error = INFINITY;
  } else if (task->n && c->model->error_kind != ROT_ADAPTIVE && isfinite(out->error) &&
             (out->error > 1e-13 || out->error > task->accuracy)) {
    measure_between_rows(j, c->model, &own, &out->info);
    out->error = rot_info_error(&out->info);
  }
}

/* A job before open_columns(): the rest is set there. */
static void begin(job *j, const rot_constraint *constraint, const void *scene,
                  const rot_hooks *hooks) {
  j->constraint = constraint;
  j->scene = scene;
  j->hooks = hooks;
  j->memory = NULL;
}

void rot_run_model(const rot_constraint *constraint, const void *scene, const rot_model *model,
                   const rot_task *task, const rot_rows *want, rot_outcome *out,
                   const rot_hooks *hooks) {
  job j;
  begin(&j, constraint, scene, hooks);
  out->picked = (rot_candidate){
      .model = model, .applies = 1, .untaken = task->without, .dropped = task->without != 0};
  const rot_status status = open_columns(&j, task->n, want);
  if (status == ROT_OK) {
    run_picked(&j, task, task->asked, out);
  } else {
    rot_info_clear(&out->info, constraint->measures);
    out->info.status = status;
  }
  free(j.memory);
}

/* 1 if the run failed since the model does not take the scene: then the reason counts. */
static int refused(const job *j, const rot_query *query, rot_outcome *out) {
  const rot_constraint *c = j->constraint;
  const rot_model *model = out->picked.model;
  if (out->info.status == ROT_OK || !(c->run_tells >> (model - c->models) & 1u)) return 0;
  if (out->picked.dropped || !model->why_not) return 0;
  out->picked.why_not = model->why_not(j->scene, query);
  if (!out->picked.why_not) return 0;
  out->picked.applies = 0;
  out->model = NULL;
  rot_events_free(&out->events);
  memset(&out->events, 0, sizeof out->events);
  rot_info_clear(&out->info, c->measures);
  return 1;
}

rot_run_end rot_run_named(const rot_constraint *constraint, const void *scene,
                          const rot_model *model, const rot_task *task, double law_s,
                          const rot_rows *want, rot_outcome *out, const rot_hooks *hooks) {
  const rot_query query = {task->n, task->time_s, task->accuracy, law_s};
  job j;
  rot_run_end end = ROT_RUN_DONE;
  begin(&j, constraint, scene, hooks);
  rot_choice_judge_named(constraint, model, scene, &query, &out->picked);
  const rot_status status = out->picked.applies ? open_columns(&j, task->n, want) : ROT_OK;
  if (!out->picked.applies || status != ROT_OK) {
    out->model = NULL;
    rot_info_clear(&out->info, constraint->measures);
    out->info.status = status;
    return out->picked.applies ? ROT_RUN_DONE : ROT_RUN_NO_MODEL;
  }
  run_picked(&j, task, task->asked, out);
  if (refused(&j, &query, out)) {
    end = ROT_RUN_NO_MODEL;
  } else if (model->use == ROT_ON_TRIAL && out->info.status == ROT_OK &&
             !(out->error <= task->accuracy)) {
    end = ROT_RUN_NONE_FITS;
  }
  free(j.memory);
  return end;
}

rot_run_end rot_run(const rot_constraint *constraint, const void *scene, const char *model,
                    const rot_task *task, double law_s, const rot_rows *want, rot_outcome *out,
                    const rot_hooks *hooks) {
  const rot_query query = {task->n, task->time_s, task->accuracy, law_s};
  rot_candidate picked[ROT_MAX_MODELS];
  const rot_model *named = model ? rot_choice_model(constraint, model) : NULL;
  job j;
  if (named) return rot_run_named(constraint, scene, named, task, law_s, want, out, hooks);
  begin(&j, constraint, scene, hooks);
  out->model = NULL;
  rot_info_clear(&out->info, constraint->measures);
  if (model) return ROT_RUN_NO_MODEL;
  const size_t n = rot_choice_pick(constraint, scene, &query, picked);
  out->info.status = open_columns(&j, task->n, want);
  if (out->info.status != ROT_OK) return ROT_RUN_DONE;
  rot_run_end end = ROT_RUN_NONE_FITS;
  for (size_t i = 0; i < n && end == ROT_RUN_NONE_FITS; i++) {
    const int trial = picked[i].model->use == ROT_ON_TRIAL;
    out->picked = picked[i];
    run_picked(&j, task, 0, out);
    if (!trial || out->info.status != ROT_OK || out->error <= task->accuracy) end = ROT_RUN_DONE;
  }
  free(j.memory);
  return end;
}

size_t rot_run_candidates(const rot_constraint *constraint, const void *scene, const rot_task *task,
                          double law_s, rot_candidate all[], size_t *n) {
  const rot_query query = {task->n, task->time_s, task->accuracy, law_s};
  size_t chosen = 0;
  *n = rot_choice_candidates(constraint, scene, &query, all);
  for (size_t i = 0; i < *n; i++) {
    if (!all[i].applies || all[i].model->use != ROT_ON_TRIAL) continue;
    rot_outcome o;
    o.events = (rot_events){0};
    rot_run_model(constraint, scene, all[i].model, task, NULL, &o, NULL);
    rot_events_free(&o.events);
    all[i].error = o.info.status == ROT_OK ? o.error : INFINITY;
    all[i].applies = all[i].error <= task->accuracy;
  }
  while (chosen < *n && !all[chosen].applies) chosen++;
  return chosen;
}

void rot_run_reason(const rot_constraint *constraint, size_t n, const rot_candidate all[],
                    size_t chosen, size_t k, size_t size, char text[]) {
  rot_choice_reason(constraint, &all[k], size, text);
  if (*text || chosen == n) return;
  if (k == chosen) {
    (void)snprintf(text, size, "%s", all[k].model->why);
  } else {
    (void)snprintf(text, size, "fits, but %s is cheaper", all[chosen].model->id);
  }
}

/* ---- balances -------------------------------------------------------------------------------- */

/* (term, value *x, its error) => explained[] += change of each balance when *x changes by
 * `error`. */
static void add_moved(const rot_constraint *c, const void *scene, const rot_span *span,
                      const double term[], double *x, double error, double explained[]) {
  double moved[ROT_MAX_TERMS], by[ROT_MAX_BALANCES] = {0.0};
  const double kept = *x;
  *x = kept + error;
  c->audit(scene, span, moved);
  *x = kept;
  for (size_t k = 0; k < c->n_terms; k++) {
    const double change = moved[k] - term[k];
    by[c->terms[k].balance] += c->terms[k].role == ROT_SUPPLIED ? -change : change;
  }
  for (size_t b = 0; b < c->n_balances; b++) explained[b] += fabs(by[b]);
}

/* Factor on estimated errors: they hold in 95 of 100 motions. Of 300 stiff chains the residual of
 * one was 1.9 times its estimate. */
enum { EXPLAINS = 2 };

rot_status rot_run_audit(const rot_constraint *c, const void *scene, const rot_span *span,
                         double term[], double explained[]) {
  const size_t rows_per_time = rot_run_rows_per_time(c, scene),
               cells = c->n_columns * rows_per_time;
  double flow[ROT_MAX_FLOWS];
  double *ends = malloc(2 * cells * sizeof *ends);
  if (!ends) return ROT_ENOMEM;
  memcpy(ends, span->first, cells * sizeof *ends);
  memcpy(ends + cells, span->last, cells * sizeof *ends);
  memcpy(flow, span->flow, c->n_flows * sizeof *flow);
  rot_span own = *span;
  own.first = ends;
  own.last = ends + cells;
  own.flow = flow;
  c->audit(scene, &own, term);
  for (size_t b = 0; b < c->n_balances; b++) explained[b] = 0.0;
  if (c->explain) c->explain(scene, &own, term, explained);
  for (size_t i = 0; i < 2 * cells && !c->explain; i++) {
    const rot_column_of *column = &c->columns[i % cells / rows_per_time];
    const double of = column->measure ? span->error[column->measure - 1]
                      : column->flow  ? span->flow_error[column->flow - 1]
                                      : -1.0;
    if (of < 0.0) continue;
    const double error = EXPLAINS * of + DBL_EPSILON * fabs(ends[i]);
    add_moved(c, scene, &own, term, &ends[i], error, explained);
  }
  for (size_t k = 0; k < c->n_flows && !c->explain; k++) {
    add_moved(c, scene, &own, term, &flow[k], EXPLAINS * span->flow_error[k], explained);
  }
  for (size_t k = 0; k < c->n_terms && !c->explain; k++) {
    explained[c->terms[k].balance] += 8.0 * DBL_EPSILON * fabs(term[k]);
  }
  free(ends);
  return ROT_OK;
}

void rot_run_cells(const rot_constraint *c, const void *scene, void *const column[], size_t time,
                   double cell[]) {
  const unsigned effects = c->effects_of(scene);
  const size_t rows_per_time = rot_run_rows_per_time(c, scene);
  for (size_t i = 0; i < c->n_columns; i++) {
    const int shown = rot_run_shows(c, scene, effects, i);
    for (size_t k = 0; k < rows_per_time; k++) {
      const size_t at = time * rows_per_time + k;
      const int flag = c->columns[i].flag ? ((const int *)column[i])[at] : 0;
      const double x =
          c->columns[i].flag ? (flag < 0 ? (double)NAN : flag) : ((const double *)column[i])[at];
      cell[i * rows_per_time + k] = shown ? x : (double)NAN;
    }
  }
}

rot_balance_sums rot_run_balance(const rot_constraint *c, const void *scene, size_t k,
                                 const double term[], const double explained[]) {
  long double sum[3] = {0.0L, 0.0L, 0.0L};
  for (size_t i = 0; i < c->n_terms; i++) {
    const rot_balance_term *of = &c->terms[i];
    if (of->balance == k && rot_run_term_words(c, scene, i)) sum[of->role] += term[i];
  }
  rot_balance_sums s = {.change = (double)sum[ROT_CHANGE],
                        .supplied = (double)sum[ROT_SUPPLIED],
                        .dissipated = (double)sum[ROT_DISSIPATED],
                        .explained = explained[k]};
  s.residual = (s.change - s.supplied) + s.dissipated;
  s.balanced =
      !isfinite(s.residual) || !isfinite(s.explained) ? -1 : fabs(s.residual) <= s.explained;
  return s;
}
