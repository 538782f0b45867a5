#include "api/scene.h"

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "api/structs.h"
#include "scene/run.h"

typedef struct caller_law {
  rotdyn_law_fn call;
  void *context;
} caller_law;

struct rotdyn_scene {
  const rot_constraint *constraint;
  rot_given given[ROT_MOST_INPUTS];
  double number[ROT_MOST_INPUTS];   /* where given[] points to of one number */
  double *numbers[ROT_MOST_INPUTS]; /* and of several */
  caller_law law[ROT_MOST_INPUTS];
};

static rot_status call_law(const double argument[], double value[], void *ctx) {
  const caller_law *law = ctx;
  return law->call(argument, value, law->context) ? ROT_EUNWIND : ROT_OK;
}

/* ---- the tables ------------------------------------------------------------------------------ */

const char *rotdyn_scene_at(size_t i) {
  size_t n;
  const rot_constraint *const *list = rot_choice_constraints(&n);
  for (size_t k = 0; k < n; k++) {
    if (list[k]->constructor && i-- == 0) return list[k]->constructor;
  }
  return NULL;
}

static const rot_constraint *constraint_of(const char *constructor) {
  return constructor ? rot_run_constraint(constructor) : NULL;
}

static const char *kind_text(unsigned kinds) {
  switch (kinds) {
  case ROT_INPUT_NUMBER: return "number";
  case ROT_INPUT_LIMIT: return "limit";
  case ROT_INPUT_TIMES: return "times";
  case ROT_INPUT_VECTOR: return "vector";
  case ROT_INPUT_ATTITUDE: return "attitude";
  case ROT_INPUT_CHOICE: return "choice";
  case ROT_INPUT_BODY: return "body";
  case ROT_INPUT_LAW: return "law";
  case ROT_INPUT_NUMBERS: return "numbers";
  case ROT_INPUT_VECTOR | ROT_INPUT_LAW: return "vector or law";
  default: return NULL;
  }
}

int rotdyn_input_at(const char *constructor, size_t i, rotdyn_input *out) {
  const rot_constraint *c = constraint_of(constructor);
  if (!out) return ROTDYN_EARGUMENT;
  if (!c) return ROTDYN_ENAME;
  if (i >= c->n_inputs) return ROTDYN_EEND;
  const rot_input *from = &c->inputs[i];
  const rotdyn_input to = {.name = from->name,
                           .unit = from->unit,
                           .kind = kind_text(from->kinds),
                           .required = from->required,
                           .low = from->low,
                           .high = from->high,
                           .above = from->above,
                           .otherwise = from->otherwise,
                           .words = from->words,
                           .options = from->options};
  return rot_api_give(&to, sizeof to, out) ? ROTDYN_OK : ROTDYN_EARGUMENT;
}

const char *rotdyn_column_at(const char *constructor, size_t i) {
  const rot_constraint *c = constraint_of(constructor);
  return c && i < c->n_columns ? c->columns[i].name : NULL;
}

/* ---- inputs ---------------------------------------------------------------------------------- */

rotdyn_scene *rotdyn_scene_new(const char *constructor) {
  const rot_constraint *c = constraint_of(constructor);
  rotdyn_scene *scene = c ? calloc(1, sizeof *scene) : NULL;
  if (scene) scene->constraint = c;
  return scene;
}

void rotdyn_scene_free(rotdyn_scene *scene) {
  if (!scene) return;
  for (size_t i = 0; i < ROT_MOST_INPUTS; i++) free(scene->numbers[i]);
  free(scene);
}

/* ROTDYN_OK, its place, and its kind among those asked for. */
static rotdyn_status find(const rotdyn_scene *scene, const char *name, unsigned kinds, size_t *at,
                          unsigned *kind) {
  if (!scene || !name) return ROTDYN_EARGUMENT;
  const rot_constraint *c = scene->constraint;
  *at = rot_input_named(c->n_inputs, c->inputs, name);
  if (*at == c->n_inputs) return ROTDYN_ENAME;
  *kind = c->inputs[*at].kinds & kinds;
  return *kind ? ROTDYN_OK : ROTDYN_EARGUMENT;
}

static void forget(rotdyn_scene *scene, size_t at) {
  free(scene->numbers[at]);
  scene->numbers[at] = NULL;
  memset(&scene->given[at], 0, sizeof scene->given[at]);
}

int rotdyn_scene_unset(rotdyn_scene *scene, const char *input) {
  if (!scene || !input) return ROTDYN_EARGUMENT;
  const rot_constraint *c = scene->constraint;
  const size_t at = rot_input_named(c->n_inputs, c->inputs, input);
  if (at == c->n_inputs) return ROTDYN_ENAME;
  forget(scene, at);
  return ROTDYN_OK;
}

int rotdyn_scene_number(rotdyn_scene *scene, const char *input, double value) {
  size_t at;
  unsigned kind;
  const rotdyn_status status = find(scene, input, ROT_INPUT_NUMBER | ROT_INPUT_LIMIT, &at, &kind);
  if (status != ROTDYN_OK) return (int)status;
  forget(scene, at);
  scene->number[at] = value;
  scene->given[at] = (rot_given){.is = kind, .n = 1, .x = &scene->number[at]};
  return ROTDYN_OK;
}

int rotdyn_scene_numbers(rotdyn_scene *scene, const char *input, size_t n, const double *values) {
  const unsigned kinds =
      ROT_INPUT_TIMES | ROT_INPUT_VECTOR | ROT_INPUT_ATTITUDE | ROT_INPUT_NUMBERS;
  size_t at;
  unsigned kind;
  const rotdyn_status status = find(scene, input, kinds, &at, &kind);
  if (status != ROTDYN_OK) return (int)status;
  if (n && !values) return ROTDYN_EARGUMENT;
  if (n >= SIZE_MAX / sizeof *values) return ROTDYN_EMEMORY;
  double *copy = malloc((n + 1) * sizeof *copy);
  if (!copy) return ROTDYN_EMEMORY;
  if (n) memcpy(copy, values, n * sizeof *copy);
  forget(scene, at);
  scene->numbers[at] = copy;
  scene->given[at] = (rot_given){.is = kind, .n = n, .x = copy};
  return ROTDYN_OK;
}

int rotdyn_scene_text(rotdyn_scene *scene, const char *input, const char *option) {
  size_t at;
  unsigned kind;
  int place = 0;
  const rotdyn_status status = find(scene, input, ROT_INPUT_CHOICE, &at, &kind);
  if (status != ROTDYN_OK) return (int)status;
  const char *const *options = scene->constraint->inputs[at].options;
  if (!option) return ROTDYN_EARGUMENT;
  while (options[place] && strcmp(options[place], option)) place++;
  if (!options[place]) return ROTDYN_EARGUMENT;
  forget(scene, at);
  scene->given[at] = (rot_given){.is = kind, .option = place};
  return ROTDYN_OK;
}

int rotdyn_scene_body(rotdyn_scene *scene, const char *input, const rotdyn_body *body) {
  size_t at;
  unsigned kind;
  rotdyn_body from;
  const rotdyn_status status = find(scene, input, ROT_INPUT_BODY, &at, &kind);
  if (status != ROTDYN_OK) return (int)status;
  if (!rot_api_take(body, sizeof from, &from)) return ROTDYN_EARGUMENT;
  forget(scene, at);
  rot_given_body *to = &scene->given[at].body;
  scene->given[at].is = kind;
  to->mass_kg = from.mass_kg;
  memcpy(to->centre_m, from.centre_m, sizeof to->centre_m);
  memcpy(to->inertia_kg_m2, from.inertia_kg_m2, sizeof to->inertia_kg_m2);
  to->radius_m = from.radius_m == 0.0 ? NAN : from.radius_m;
  return ROTDYN_OK;
}

int rotdyn_scene_law(rotdyn_scene *scene, const char *input, rotdyn_law_fn law, void *context) {
  size_t at;
  unsigned kind;
  const rotdyn_status status = find(scene, input, ROT_INPUT_LAW, &at, &kind);
  if (status != ROTDYN_OK) return (int)status;
  if (!law) return ROTDYN_EARGUMENT;
  forget(scene, at);
  scene->law[at] = (caller_law){law, context};
  scene->given[at] = (rot_given){.is = kind, .law = {call_law, &scene->law[at]}};
  return ROTDYN_OK;
}

/* ---- runs ------------------------------------------------------------------------------------ */

/* A scene as built, for one call: scenes are shared by threads. */
typedef struct work {
  const rot_constraint *constraint;
  void *built;
  rotdyn_options options;
  rot_hooks hooks;
  rotdyn_report report;
} work;

static rotdyn_status refuse(work *w, const char *input, const char *reason) {
  w->report.input = input;
  (void)snprintf(w->report.reason, sizeof w->report.reason, "%s", reason);
  return ROTDYN_EARGUMENT;
}

static rotdyn_status build(const rotdyn_scene *scene, work *w) {
  rot_refusal no;
  if (!scene) return refuse(w, NULL, "the scene is NULL");
  const rot_constraint *c = w->constraint = scene->constraint;
  w->built = malloc(c->scene_size);
  if (!w->built) return ROTDYN_EMEMORY;
  rot_status status = rot_inputs_check(c->n_inputs, c->inputs, scene->given, &no);
  if (status == ROT_OK) status = c->build(scene->given, w->built, &no);
  if (status == ROT_EVALUE) return refuse(w, c->inputs[no.input].name, no.reason);
  return rot_api_status(status);
}

static rot_status call_poll(void *ctx, double fraction) {
  const rotdyn_options *o = ctx;
  return o->poll && o->poll(o->poll_context, fraction) ? ROT_EUNWIND : ROT_OK;
}

/* Builds the scene, for these times. */
static rotdyn_status open_work(const rotdyn_scene *scene, size_t n, const double time_s[],
                               const rotdyn_options *options, work *w) {
  memset(w, 0, sizeof *w);
  const char *fault = rot_api_options(options, &w->options);
  w->hooks = (rot_hooks){call_poll, &w->options};
  rotdyn_status status = fault ? refuse(w, NULL, fault) : build(scene, w);
  if (status != ROTDYN_OK) return status;
  const double start = w->constraint->start_s(w->built);
  if (!rot_api_times(n, time_s) ||
      (n && (!isfinite(time_s[0] - start) || !isfinite(time_s[n - 1] - start)))) {
    return refuse(w, NULL, "times must be finite and not decrease");
  }
  return ROTDYN_OK;
}

static int close_work(rotdyn_status status, work *w, rotdyn_report *report) {
  free(w->built);
  w->report.status = (int)status;
  return rot_api_give(&w->report, sizeof w->report, report) ? (int)status : ROTDYN_EARGUMENT;
}

int rotdyn_scene_check(const rotdyn_scene *scene, rotdyn_report *report) {
  work w;
  memset(&w, 0, sizeof w);
  return close_work(build(scene, &w), &w, report);
}

int rotdyn_scene_candidate(const rotdyn_scene *scene, size_t n, const double *time_s,
                           const rotdyn_options *options, size_t k, rotdyn_candidate *out) {
  work w;
  rot_candidate all[ROT_MOST_MODELS];
  rotdyn_status status = open_work(scene, n, time_s, options, &w);
  if (status == ROTDYN_OK && !out) status = ROTDYN_EARGUMENT;
  if (status == ROTDYN_OK) {
    const rot_query query = {n, time_s, w.options.accuracy, w.options.torque_call_s};
    const size_t count = rot_choice_candidates(w.constraint, w.built, &query, all);
    status = k < count ? rot_api_candidate(w.constraint, &all[k], out) : ROTDYN_EEND;
  }
  return close_work(status, &w, NULL);
}

/* The caller's columns by their place; flags are written as int, then widened. */
typedef struct places {
  void *column[ROT_MOST_COLUMNS];
  double *flags[ROT_MOST_COLUMNS]; /* the caller's */
} places;

static rotdyn_status place_columns(work *w, size_t n, size_t n_columns, const char *const names[],
                                   double *const columns[], places *p) {
  memset(p, 0, sizeof *p);
  if (n_columns && (!names || !columns)) return refuse(w, NULL, "`names` or `columns` is NULL");
  for (size_t i = 0; i < n_columns; i++) {
    if (!names[i] || !columns[i]) return refuse(w, NULL, "a name or a column is NULL");
    const size_t at = rot_run_column(w->constraint, names[i]);
    if (at == w->constraint->n_columns) {
      (void)snprintf(w->report.reason, sizeof w->report.reason, "there is no column `%.64s`",
                     names[i]);
      return ROTDYN_ENAME;
    }
    if (p->column[at]) return refuse(w, NULL, "a column is asked for twice");
    p->column[at] = columns[i];
    if (w->constraint->columns[at].flag) {
      p->flags[at] = columns[i];
      p->column[at] = malloc((n + 1) * sizeof(int));
      if (!p->column[at]) return ROTDYN_EMEMORY;
    }
    /* What this scene has no effects for stays 0. */
    for (size_t k = 0; k < n; k++) columns[i][k] = 0.0;
  }
  return ROTDYN_OK;
}

static void widen_flags(const places *p, size_t rows) {
  for (size_t i = 0; i < ROT_MOST_COLUMNS; i++) {
    if (!p->flags[i]) continue;
    for (size_t k = 0; k < rows; k++) p->flags[i][k] = ((const int *)p->column[i])[k];
  }
}

static void free_flags(places *p) {
  for (size_t i = 0; i < ROT_MOST_COLUMNS; i++) {
    if (p->flags[i]) free(p->column[i]);
  }
}

static void report_run(const rot_outcome *o, rotdyn_report *to) {
  const rot_info *info = &o->info;
  to->rows_done = info->rows_done;
  to->time_s = info->time_s;
  to->steps = info->steps;
  to->rejected = info->rejected;
  to->law_calls = info->rhs_calls;
  to->error = o->error;
  to->model = o->model ? o->model->id : NULL;
  to->error_is_bound = o->model && o->model->error_kind == ROT_BOUND;
  to->n_measures = info->n_measures;
  for (size_t i = 0; i < info->n_measures; i++) {
    to->measure[i] = info->measure_names[i];
    to->measure_error[i] = info->measure[i].error;
    to->measure_largest[i] = info->measure[i].largest;
  }
}

static rotdyn_status run(work *w, size_t n, const double time_s[], const places *p) {
  const double most = fmin(w->options.max_steps, 1e15);
  const rot_task task = {
      .n = n, .time_s = time_s, .accuracy = w->options.accuracy, .max_steps = (size_t)most + n};
  rot_outcome o;
  memset(&o, 0, sizeof o);
  const rot_rows want = {.column = p->column};
  const rot_run_end end = rot_run(w->constraint, w->built, w->options.model, &task,
                                  w->options.torque_call_s, &want, &o, &w->hooks);
  rotdyn_status status = rot_api_status(o.info.status);
  if (end == ROT_RUN_DONE) {
    report_run(&o, &w->report);
    rot_api_events(&o.events, w->options.events);
    widen_flags(p, o.info.rows_done * rot_run_copies(w->constraint, w->built));
    if (status == ROTDYN_OK && isnan(o.error)) status = ROTDYN_ERANGE;
  } else if (end == ROT_RUN_NO_MODEL) {
    status = ROTDYN_EMODEL;
    if (rot_choice_model(w->constraint, w->options.model)) {
      rot_choice_reason(w->constraint, &o.picked, sizeof w->report.reason, w->report.reason);
    } else {
      (void)refuse(w, NULL, "there is no model of this name");
    }
  } else {
    const rot_query query = {n, time_s, w->options.accuracy, w->options.torque_call_s};
    status = rot_api_none_fits(w->constraint, w->built, &query, sizeof w->report.reason,
                               w->report.reason);
  }
  rot_events_free(&o.events);
  return status;
}

int rotdyn_scene_run(const rotdyn_scene *scene, size_t n, const double *time_s,
                     const rotdyn_options *options, size_t n_columns, const char *const *names,
                     double *const *columns, rotdyn_report *report) {
  work w;
  places p;
  memset(&p, 0, sizeof p);
  rotdyn_status status = open_work(scene, n, time_s, options, &w);
  if (status == ROTDYN_OK) {
    const size_t rows = n * rot_run_copies(w.constraint, w.built);
    status = place_columns(&w, rows, n_columns, names, columns, &p);
  }
  if (status == ROTDYN_OK) status = run(&w, n, time_s, &p);
  free_flags(&p);
  return close_work(status, &w, report);
}
