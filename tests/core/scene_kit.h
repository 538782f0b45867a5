/* Scenes of the constraints that the core builds, for their tests: inputs by name, runs, audits. */
#ifndef SCENE_KIT_H
#define SCENE_KIT_H

#include "engine/resistance.h"
#include "rot_test.h"
#include "scene/run.h"

enum { KIT_MAX = 20 };

typedef struct kit {
  const rot_constraint *c;
  const rot_maker *maker;
  rot_given given[ROT_MAX_INPUTS];
  double x[ROT_MAX_INPUTS][KIT_MAX];
  rot_resistance resistance;
  void *scene;
  rot_refusal no;
  rot_store store;
} kit;

static inline kit *kit_new(const char *constructor) {
  kit *k = calloc(1, sizeof *k);
  if (!k) exit(1);
  k->maker = rot_run_maker(constructor, &k->c);
  ROT_CHECK(k->maker != NULL);
  return k;
}

static inline void kit_free(kit *k) {
  rot_store_free(&k->store);
  free(k->scene);
  free(k);
}

static inline size_t kit_input(const kit *k, const char *name) {
  const size_t at = rot_input_named(k->maker->n_inputs, k->maker->inputs, name);
  ROT_CHECK(at < k->maker->n_inputs);
  return at;
}

static inline void kit_numbers(kit *k, const char *name, size_t n, const double x[]) {
  const size_t at = kit_input(k, name);
  memcpy(k->x[at], x, n * sizeof *x);
  k->given[at] = (rot_given){.is = k->maker->inputs[at].kinds, .n = n, .x = k->x[at]};
}

static inline void kit_number(kit *k, const char *name, double x) { kit_numbers(k, name, 1, &x); }

/* A resistance of one term. */
static inline void kit_resist(kit *k, const char *term, double x) {
  const rot_part *part = &rot_resistance_part;
  rot_given given[ROT_MAX_INPUTS] = {0};
  given[rot_input_named(part->n_inputs, part->inputs, term)] =
      (rot_given){.is = ROT_INPUT_NUMBER, .n = 1, .x = &x};
  ROT_CHECK(rot_inputs_check(part->n_inputs, part->inputs, given, &k->no) == ROT_OK);
  ROT_CHECK(part->build(part, given, NULL, &k->resistance, &k->no) == ROT_OK);
  k->given[kit_input(k, "resistance")] =
      (rot_given){.is = ROT_INPUT_RESISTANCE, .n = 1, .object = &k->resistance};
}

static inline void kit_option(kit *k, const char *name, int option) {
  k->given[kit_input(k, name)] = (rot_given){.is = ROT_INPUT_CHOICE, .option = option};
}

static inline void kit_unset(kit *k, const char *name) {
  memset(&k->given[kit_input(k, name)], 0, sizeof *k->given);
}

static inline rot_status kit_build(kit *k) {
  rot_store_free(&k->store);
  free(k->scene);
  k->scene = malloc(k->c->scene_size);
  if (!k->scene) exit(1);
  return rot_run_build(k->maker, k->given, &k->store, k->scene, &k->no);
}

/* Refused for this input, with these words in the reason. */
static inline int kit_refuses(kit *k, const char *input, const char *words) {
  return kit_build(k) == ROT_EVALUE && k->no.input == kit_input(k, input) &&
         strstr(k->no.reason, words) != NULL;
}

/* ---- runs ------------------------------------------------------------------------------------ */

typedef struct motion {
  size_t n, rows_per_time;
  double *column[ROT_MAX_COLUMNS], *flow[ROT_MAX_FLOWS];
  double flow_error[ROT_MAX_FLOWS];
  rot_outcome out;
  rot_run_end end;
} motion;

static inline void motion_free(motion *m) {
  for (size_t i = 0; i < ROT_MAX_COLUMNS; i++) free(m->column[i]);
  for (size_t i = 0; i < ROT_MAX_FLOWS; i++) free(m->flow[i]);
  rot_events_free(&m->out.events);
}

/* `model`: NULL: the one that is chosen. */
static inline motion kit_run(kit *k, const char *model, double accuracy, size_t n,
                             const double time_s[]) {
  motion m;
  memset(&m, 0, sizeof m);
  m.n = n;
  ROT_CHECK(kit_build(k) == ROT_OK);
  m.rows_per_time = rot_run_rows_per_time(k->c, k->scene);
  for (size_t i = 0; i < k->c->n_columns; i++) m.column[i] = calloc(n * m.rows_per_time + 1, 8);
  for (size_t i = 0; i < k->c->n_flows; i++) m.flow[i] = calloc(n + 1, 8);
  void *column[ROT_MAX_COLUMNS];
  for (size_t i = 0; i < ROT_MAX_COLUMNS; i++) column[i] = m.column[i];
  const rot_task task = {.n = n, .time_s = time_s, .accuracy = accuracy, .max_steps = 10000000};
  const rot_rows want = {.column = column, .flow = m.flow, .flow_error = m.flow_error};
  m.end = rot_run(k->c, k->scene, model, &task, 0.0, &want, &m.out, NULL);
  return m;
}

/* Row i of a link (0: of the only one). */
static inline double value(const kit *k, const motion *m, const char *name, size_t i, size_t link) {
  const size_t at = rot_run_column(k->c, name);
  ROT_CHECK(at < k->c->n_columns);
  return m->column[at][i * m->rows_per_time + link];
}

static inline int ran(const motion *m) {
  return m->end == ROT_RUN_DONE && m->out.info.status == ROT_OK && m->out.info.rows_done == m->n;
}

/* The absolute error that the run reports of a measure. */
static inline double reported(const motion *m, size_t measure) {
  return m->out.info.measure[measure].error;
}

/* |change - supplied + dissipated| over what is explained, between rows i and j. `wrong`: a term
 * whose sign is turned; -1: none. Its value in *term if that is not NULL. */
static inline double audit(const kit *k, const motion *m, size_t balance, size_t i, size_t j,
                           int wrong, double *term) {
  double first[ROT_MAX_COLUMNS * KIT_MAX], last[ROT_MAX_COLUMNS * KIT_MAX];
  double flow[ROT_MAX_FLOWS], error[ROT_MAX_MEASURES], terms[ROT_MAX_TERMS];
  double explained[ROT_MAX_BALANCES], residual = 0.0;
  for (size_t c = 0; c < k->c->n_columns; c++) {
    for (size_t l = 0; l < m->rows_per_time; l++) {
      first[c * m->rows_per_time + l] = m->column[c][i * m->rows_per_time + l];
      last[c * m->rows_per_time + l] = m->column[c][j * m->rows_per_time + l];
    }
  }
  for (size_t f = 0; f < k->c->n_flows; f++) flow[f] = m->flow[f][j] - m->flow[f][i];
  for (size_t e = 0; e < m->out.info.n_measures; e++) error[e] = reported(m, e);
  const rot_span span = {
      .first = first, .last = last, .flow = flow, .flow_error = m->flow_error, .error = error};
  (void)rot_run_audit(k->c, k->scene, &span, terms, explained);
  for (size_t t = 0; t < k->c->n_terms; t++) {
    if (k->c->terms[t].balance != balance) continue;
    const double sign = k->c->terms[t].role == ROT_SUPPLIED ? -1.0 : 1.0;
    residual += (wrong == (int)t ? -sign : sign) * terms[t];
    if (wrong == (int)t && term) *term = terms[t];
  }
  return fabs(residual) / fmax(explained[balance], 1e-300);
}

/* Every balance holds between all rows; a term of a size that matters is noticed with a wrong
 * sign. */
static inline void check_audits(const kit *k, const motion *m) {
  for (size_t b = 0; b < k->c->n_balances; b++) {
    double term[ROT_MAX_TERMS] = {0.0}, ratio[ROT_MAX_TERMS], max = 0.0;
    const char *why;
    for (size_t i = 0; i + 1 < m->n; i++) {
      ROT_CHECK(audit(k, m, b, i, i + 1, -1, NULL) <= 1.0);
      ROT_CHECK(audit(k, m, b, 0, i + 1, -1, NULL) <= 1.0);
    }
    for (size_t t = 0; t < k->c->n_terms; t++) {
      if (k->c->terms[t].balance != b) continue;
      ratio[t] = audit(k, m, b, 0, m->n - 1, (int)t, &term[t]);
      max = fmax(max, fabs(term[t]));
    }
    for (size_t t = 0; t < k->c->n_terms && m->out.error < 1e-6; t++) {
      if (!k->c->conserved(k->scene, b, &why) || fabs(term[t]) <= 1e-4 * max) continue;
      ROT_CHECK(ratio[t] > 10.0);
    }
  }
}

#endif
