#include "api/scene.h"

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "api/object.h"
#include "api/structs.h"
#include "api/work.h"
#include "ground/parallel.h"
#include "scene/run.h"

/* ---- candidates ------------------------------------------------------------------------------ */

int rotdyn_scene_candidate(const rotdyn_object *scene, size_t n, const double *time_s,
                           const rotdyn_options *options, size_t k, rotdyn_candidate *out) {
  rot_api_work w;
  rot_candidate all[ROT_MAX_MODELS];
  rotdyn_status status = rot_api_open(scene, n, time_s, options, &w);
  if (status == ROTDYN_OK && !out) status = ROTDYN_EARGUMENT;
  if (status == ROTDYN_OK) {
    const rot_constraint *c = w.built.constraint;
    const rot_task task = {.n = n,
                           .time_s = time_s,
                           .accuracy = w.options.accuracy,
                           .max_steps = (size_t)fmin(w.options.max_steps, 1e15) + n};
    char reason[512];
    size_t count;
    const size_t chosen =
        rot_run_candidates(c, w.built.scene, &task, w.options.law_call_s, all, &count);
    if (k < count) {
      rot_run_reason(c, count, all, chosen, k, sizeof reason, reason);
      status = rot_api_candidate(&all[k], reason, out);
    } else {
      status = ROTDYN_EEND;
    }
  }
  return rot_api_close(status, &w, NULL);
}

/* ---- columns --------------------------------------------------------------------------------- */

/* The caller's columns by index; flags are computed as int, then converted. */
typedef struct places {
  void *column[ROT_MAX_COLUMNS];  /* the caller's, or ints of a flag */
  double *flags[ROT_MAX_COLUMNS]; /* the caller's columns of flags */
} places;

/* names => column indices; ROTDYN_ENAME: unknown, ROTDYN_EARGUMENT: twice, or NULL */
static rotdyn_status find_columns(rot_api_work *w, size_t n, const char *const names[],
                                  double *const columns[], size_t at[]) {
  const rot_constraint *c = w->built.constraint;
  uint64_t seen = 0;
  if (n && (!names || !columns)) return rot_api_refuse(w, NULL, "`names` or `columns` is NULL");
  for (size_t i = 0; i < n; i++) {
    if (!names[i] || !columns[i]) return rot_api_refuse(w, NULL, "a name or a column is NULL");
    const size_t place = rot_run_column(c, names[i]);
    if (place == c->n_columns) {
      (void)snprintf(w->report.reason, sizeof w->report.reason, "there is no column `%.64s`",
                     names[i]);
      return ROTDYN_ENAME;
    }
    if (seen >> place & 1u) return rot_api_refuse(w, NULL, "a column is asked for twice");
    seen |= (uint64_t)1 << place;
    at[i] = place;
  }
  return ROTDYN_OK;
}

/* columns of `rows` values => places, columns set to 0; close_columns() in each case */
static rotdyn_status place_columns(const rot_constraint *c, size_t rows, size_t n,
                                   const size_t at[], double *const columns[], places *p) {
  memset(p, 0, sizeof *p);
  for (size_t i = 0; i < n; i++) {
    p->column[at[i]] = columns[i];
    if (c->columns[at[i]].flag) {
      if (rows >= SIZE_MAX / sizeof(int)) return ROTDYN_EMEMORY;
      p->flags[at[i]] = columns[i];
      p->column[at[i]] = calloc(rows + 1, sizeof(int));
      if (!p->column[at[i]]) return ROTDYN_EMEMORY;
    }
    /* Columns without effects in this scene stay 0. */
    for (size_t k = 0; k < rows; k++) columns[i][k] = 0.0;
  }
  return ROTDYN_OK;
}

static void close_columns(places *p, size_t rows) {
  for (size_t i = 0; i < ROT_MAX_COLUMNS; i++) {
    const int *flag = p->flags[i] ? p->column[i] : NULL;
    for (size_t k = 0; k < rows && flag; k++) p->flags[i][k] = flag[k] < 0 ? (double)NAN : flag[k];
    if (p->flags[i]) free(p->column[i]);
  }
}

/* ---- runs ------------------------------------------------------------------------------------ */

int rotdyn_scene_run(const rotdyn_object *scene, size_t n, const double *time_s,
                     const rotdyn_options *options, size_t room, size_t n_columns,
                     const char *const *names, double *const *columns, rotdyn_report *report) {
  rot_api_work w;
  places p;
  size_t at[ROT_MAX_COLUMNS];
  memset(&p, 0, sizeof p);
  rotdyn_status status = rot_api_open(scene, n, time_s, options, &w);
  if (status == ROTDYN_OK && n_columns > ROT_MAX_COLUMNS) {
    status = rot_api_refuse(&w, NULL, "there are more columns than the scene has");
  }
  if (status == ROTDYN_OK) status = find_columns(&w, n_columns, names, columns, at);
  if (status == ROTDYN_OK && n_columns && room / w.report.rows_per_time < n) {
    status = rot_api_refuse(&w, NULL, "the columns have no room for the rows of all times");
  }
  const size_t rows = n * w.report.rows_per_time;
  if (status == ROTDYN_OK) {
    status = place_columns(w.built.constraint, rows, n_columns, at, columns, &p);
  }
  if (status == ROTDYN_OK) {
    const rot_rows want = {.column = p.column};
    rot_outcome o;
    status = rot_api_run(w.built.constraint, w.built.scene, &w.options, &w.hooks, n, time_s, &want,
                         &o, &w.report);
    rot_api_events(&o.events, w.options.events);
    rot_events_free(&o.events);
  }
  close_columns(&p, w.report.rows_done * w.report.rows_per_time);
  return rot_api_close(status, &w, report);
}

/* ---- many scenes, one per row ---------------------------------------------------------------- */

/* Shared by the threads; they write only rows of the output columns. */
typedef struct many {
  const rot_api_work *w;
  rotdyn_rows_in in;
  rotdyn_rows_out out;
  size_t place[ROT_MAX_INPUTS]; /* index of each input that varies */
  size_t at[ROT_MAX_COLUMNS];   /* index of each column */
  size_t rows_per_time;
} many;

static double value_of(rotdyn_column column, size_t i) { return column.values[i * column.step]; }

/* => kind as which an input accepts one number, 0 if none */
static unsigned number_kind(const rot_input *input) {
  const unsigned one = input->kinds & (ROT_INPUT_NUMBER | ROT_INPUT_LIMIT);
  return one ? one : input->kinds & ROT_INPUT_NUMBERS;
}

/* Builds the scene of row i and runs it; `built`: memory of the scene. */
static rotdyn_status run_row(const many *m, size_t i, void *built, rotdyn_report *report) {
  const rot_constraint *c = m->w->built.constraint;
  const rot_maker *maker = m->w->built.maker;
  double number[ROT_MAX_INPUTS], *column[ROT_MAX_COLUMNS];
  rot_given given[ROT_MAX_INPUTS];
  rot_refusal no;
  rot_store store = {0};
  places p;
  rotdyn_options options = m->w->options;
  const double time_s = value_of(m->in.time_s, i);
  memset(&p, 0, sizeof p);
  memcpy(given, m->w->built.given, maker->n_inputs * sizeof *given);
  for (size_t k = 0; k < m->in.n_inputs; k++) {
    const size_t at = m->place[k];
    number[k] = value_of(m->in.values[k], i);
    given[at] = (rot_given){.is = number_kind(&maker->inputs[at]), .n = 1, .x = &number[k]};
  }
  memset(built, 0, c->scene_size);
  rot_status status = rot_run_build(maker, given, &store, built, &no);
  if (status == ROT_OK && !rot_api_possible(c, built, 1, &time_s)) {
    status = rot_refuse(&no, maker->n_inputs, "the time must be finite");
  } else if (status == ROT_OK && rot_run_rows_per_time(c, built) != m->rows_per_time) {
    status = rot_refuse(&no, maker->n_inputs, "the row has another number of %ss", c->index);
  }
  if (status == ROT_EVALUE) {
    report->input = no.input < maker->n_inputs ? maker->inputs[no.input].name : NULL;
    (void)snprintf(report->reason, sizeof report->reason, "%s", no.reason);
  }
  rotdyn_status ended = rot_api_status(status);
  options.events = NULL;
  for (size_t k = 0; k < m->out.n_columns; k++)
    column[k] = m->out.columns[k] + i * m->rows_per_time;
  if (ended == ROTDYN_OK) {
    ended = place_columns(c, m->rows_per_time, m->out.n_columns, m->at, column, &p);
  }
  if (ended == ROTDYN_OK) {
    const rot_rows want = {.column = p.column};
    rot_outcome o;
    ended = rot_api_run(c, built, &options, NULL, 1, &time_s, &want, &o, report);
    rot_events_free(&o.events);
  }
  close_columns(&p, m->rows_per_time);
  rot_store_free(&store);
  for (size_t k = 0; k < m->out.n_columns && ended != ROTDYN_OK; k++) {
    for (size_t j = 0; j < m->rows_per_time; j++) column[k][j] = NAN;
  }
  return ended;
}

/* Rows first .. last - 1, for rot_parallel_rows(). */
static void run_part(const void *frame, size_t first, size_t last) {
  const many *m = frame;
  void *built = malloc(m->w->built.constraint->scene_size);
  for (size_t i = first; i < last; i++) {
    rotdyn_report report = {0};
    const rotdyn_status status = built ? run_row(m, i, built, &report) : ROTDYN_EMEMORY;
    const int ok = status == ROTDYN_OK;
    for (size_t k = 0; k < m->out.n_columns && !built; k++) {
      for (size_t j = 0; j < m->rows_per_time; j++)
        m->out.columns[k][i * m->rows_per_time + j] = NAN;
    }
    m->out.status[i] = (int)status;
    m->out.error[i] = ok ? report.error : NAN;
    m->out.model[i] = ok ? report.model : NULL;
  }
  free(built);
}

/* caller's inputs and columns => `many`, checked */
static rotdyn_status open_rows(rot_api_work *w, size_t n, const rotdyn_rows_in *in,
                               const rotdyn_rows_out *out, many *m) {
  const rot_maker *maker = w->built.maker;
  if (!rot_api_take(in, sizeof m->in, &m->in) || !rot_api_take(out, sizeof m->out, &m->out) ||
      (n && !m->in.time_s.values)) {
    return rot_api_refuse(w, NULL, "`in` or `out` has a wrong size, or there are no times");
  }
  if (m->in.n_inputs > maker->n_inputs || (m->in.n_inputs && (!m->in.inputs || !m->in.values)) ||
      m->out.n_columns > w->built.constraint->n_columns) {
    return rot_api_refuse(w, NULL,
                          "there are more inputs or columns than the scene has, or a NULL");
  }
  for (size_t k = 0; k < m->in.n_inputs; k++) {
    const char *name = m->in.inputs[k];
    const size_t at =
        name ? rot_input_named(maker->n_inputs, maker->inputs, name) : maker->n_inputs;
    if (at == maker->n_inputs) {
      (void)rot_api_refuse(w, NULL, "there is no input of one of these names");
      return ROTDYN_ENAME;
    }
    for (size_t i = 0; i < k; i++) {
      if (m->place[i] == at) return rot_api_refuse(w, maker->inputs[at].name, "is named twice");
    }
    if (!number_kind(&maker->inputs[at]) || !m->in.values[k].values) {
      return rot_api_refuse(w, maker->inputs[at].name, "takes no number, or has no values");
    }
    m->place[k] = at;
  }
  m->rows_per_time = w->report.rows_per_time;
  return find_columns(w, m->out.n_columns, m->out.names, m->out.columns, m->at);
}

/* Runs all rows in parallel; columns that the caller does not want are temporary. */
static rotdyn_status run_rows(rot_api_work *w, size_t n, int threads, many *m) {
  int *statuses = NULL;
  double *errors = NULL;
  const char **models = NULL;
  rot_info info;
  if (n > SIZE_MAX / sizeof(double) / m->rows_per_time) return ROTDYN_EMEMORY;
  if (!m->out.status) m->out.status = statuses = malloc((n + 1) * sizeof *statuses);
  if (!m->out.error) m->out.error = errors = malloc((n + 1) * sizeof *errors);
  if (!m->out.model) m->out.model = models = malloc((n + 1) * sizeof *models);
  rotdyn_status status = ROTDYN_EMEMORY;
  if (m->out.status && m->out.error && m->out.model) {
    m->w = w;
    status = rot_api_status(rot_parallel_rows(run_part, m, n, 16, threads, &w->hooks, &info));
    w->report.rows_done = info.rows_done;
    w->report.error_is_bound = 0;
    for (size_t i = 0; i < info.rows_done; i++) {
      if (m->out.error[i] > w->report.error) w->report.error = m->out.error[i];
    }
  }
  free(statuses);
  free(errors);
  free(models);
  return status;
}

int rotdyn_scene_rows(const rotdyn_object *scene, size_t n, const rotdyn_rows_in *in,
                      const rotdyn_options *options, const rotdyn_rows_out *out,
                      rotdyn_report *report) {
  rot_api_work w;
  many m;
  memset(&m, 0, sizeof m);
  rotdyn_status status = rot_api_open(scene, 0, NULL, options, &w);
  if (status == ROTDYN_OK) status = open_rows(&w, n, in, out, &m);
  if (status == ROTDYN_OK) {
    const double max = rot_object_calls(scene) ? 1.0 : (double)w.options.threads;
    status = run_rows(&w, n, (int)fmin(fmax(max, 1.0), 4096.0), &m);
  }
  return rot_api_close(status, &w, report);
}
