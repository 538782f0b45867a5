/* Scenes built and run by their constraint's table, judged against true motions in quadruple
 * precision: how often the reported errors cover the true ones, and whether audits balance. */
#ifndef COVERAGE_CONTEST_H
#define COVERAGE_CONTEST_H

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "midpoint.h"
#include "random.h"
#include "scene/run.h"

enum { ROWS = 6, LINKS = 16 };

typedef struct sample {
  const rot_constraint *c;
  const char *model; /* NULL: the one that is chosen */
  rot_given given[ROT_MAX_INPUTS];
  double x[ROT_MAX_INPUTS][LINKS];
  double start_s, rows_s[ROWS], accuracy;
} sample;

/* The true angles and rates of each link, the flows since the start, the largest angle and rate. */
typedef struct answer {
  quad theta[ROWS][LINKS], omega[ROWS][LINKS], flow[ROWS][ROT_MAX_FLOWS];
  double most[2];
} answer;

typedef struct contest {
  const char *name;
  void (*make)(sample *);
  double least; /* share to be covered */
} contest;

static inline void set(sample *s, const char *input, size_t n, const double x[]) {
  const size_t at = rot_input_named(s->c->makers->n_inputs, s->c->makers->inputs, input);
  memcpy(s->x[at], x, n * sizeof *x);
  s->given[at] = (rot_given){.is = s->c->makers->inputs[at].kinds, .n = n, .x = s->x[at]};
}

static inline void set_one(sample *s, const char *input, double x) { set(s, input, 1, &x); }

static inline void set_option(sample *s, const char *input, int option) {
  const size_t at = rot_input_named(s->c->makers->n_inputs, s->c->makers->inputs, input);
  s->given[at] = (rot_given){.is = ROT_INPUT_CHOICE, .option = option};
}

static inline int by_size(const void *a, const void *b) {
  const double x = *(const double *)a, y = *(const double *)b;
  return (x > y) - (x < y);
}

static inline double median(size_t n, double x[]) {
  if (n == 0) return NAN;
  qsort(x, n, sizeof *x, by_size);
  return x[n / 2];
}

/* Rows at random in a span on one side of the start, or on both. */
static inline void draw_rows(sample *s, double from, double to) {
  s->start_s = chance(0.5) ? 0.0 : uniform(-2.0, 2.0);
  set_one(s, "start_s", s->start_s);
  for (int i = 0; i < ROWS; i++) s->rows_s[i] = s->start_s + uniform(from, to);
  qsort(s->rows_s, ROWS, sizeof *s->rows_s, by_size);
}

/* A motion as the package has it. */
typedef struct got {
  size_t links;
  double column[ROT_MAX_COLUMNS][ROWS * LINKS], flow[ROT_MAX_FLOWS][ROWS];
  double flow_error[ROT_MAX_FLOWS];
  rot_outcome out;
} got;

/* 1: all rows are there. */
static inline int run_sample(const sample *s, void *scene, got *g) {
  rot_refusal no;
  memset(g, 0, sizeof *g);
  rot_store store = {0}; /* of hoops and chains: nothing is in it */
  const rot_status status = rot_run_build(s->c->makers, s->given, &store, scene, &no);
  if (status != ROT_OK) {
    fprintf(stderr, "%s %s\n", s->c->makers->inputs[no.input].name, no.reason);
    return 0;
  }
  void *column[ROT_MAX_COLUMNS];
  double *flow[ROT_MAX_FLOWS];
  for (int i = 0; i < ROT_MAX_COLUMNS; i++) column[i] = g->column[i];
  for (int i = 0; i < ROT_MAX_FLOWS; i++) flow[i] = g->flow[i];
  g->links = rot_run_rows_per_time(s->c, scene);
  const rot_task task = {
      .n = ROWS, .time_s = s->rows_s, .accuracy = s->accuracy, .max_steps = 1000000};
  const rot_rows want = {.column = column, .flow = flow, .flow_error = g->flow_error};
  const rot_run_end end = rot_run(s->c, scene, s->model, &task, 0.0, &want, &g->out, NULL);
  rot_events_free(&g->out.events);
  if (end == ROT_RUN_DONE && g->out.info.status == ROT_OK) return 1;
  fprintf(stderr, "no motion: %s\n",
          end == ROT_RUN_DONE ? rot_status_text(g->out.info.status) : "no model");
  return 0;
}

/* The largest part of what is explained that a balance is off by, between all rows. */
static inline double worst_audit(const sample *s, const void *scene, const got *g) {
  double first[ROT_MAX_COLUMNS * LINKS], last[ROT_MAX_COLUMNS * LINKS];
  double flow[ROT_MAX_FLOWS], error[ROT_MAX_MEASURES], worst = 0.0;
  for (size_t m = 0; m < g->out.info.n_measures; m++) error[m] = g->out.info.measure[m].error;
  for (size_t i = 0; i + 1 < ROWS; i++) {
    for (size_t j = i + 1; j < ROWS; j++) {
      double term[ROT_MAX_TERMS], explained[ROT_MAX_BALANCES], off[ROT_MAX_BALANCES] = {0.0};
      for (size_t c = 0; c < s->c->n_columns; c++) {
        for (size_t l = 0; l < g->links; l++) {
          first[c * g->links + l] = g->column[c][i * g->links + l];
          last[c * g->links + l] = g->column[c][j * g->links + l];
        }
      }
      for (size_t f = 0; f < s->c->n_flows; f++) flow[f] = g->flow[f][j] - g->flow[f][i];
      const rot_span span = {
          .first = first, .last = last, .flow = flow, .flow_error = g->flow_error, .error = error};
      if (rot_run_audit(s->c, scene, &span, term, explained) != ROT_OK) return INFINITY;
      for (size_t t = 0; t < s->c->n_terms; t++) {
        off[s->c->terms[t].balance] += s->c->terms[t].role == ROT_SUPPLIED ? -term[t] : term[t];
      }
      for (size_t b = 0; b < s->c->n_balances; b++) {
        const double ratio = off[b] == 0.0 ? 0.0 : fabs(off[b]) / explained[b];
        if (!(ratio <= worst)) worst = ratio;
      }
    }
  }
  return worst;
}

/* `truth` returns 0, or 1 without an answer. Scenes, seed and the name of a class as arguments. */
static inline int run_contests(const char *title, size_t n, const contest contests[],
                               const rot_constraint *constraint,
                               int (*truth)(const sample *, answer *), int argc, char **argv) {
  const long scenes = argc > 1 ? atol(argv[1]) : 1000;
  const uint64_t seed = argc > 2 ? (uint64_t)atoll(argv[2]) : 20;
  const char *only = argc > 3 ? argv[3] : NULL;
  double *ratio = malloc((size_t)scenes * sizeof *ratio);
  double *error = malloc((size_t)scenes * sizeof *error);
  void *scene = malloc(constraint->scene_size);
  long silent = 0;
  int bad = !ratio || !error || !scene;
  printf(
      "| %s | judged | bounds | covered | flows covered | audits balanced | silent | true error, "
      "median | worst below 1 | reported / true, median |\n|---|---|---|---|---|---|---|---|---|"
      "---|\n",
      title);
  for (size_t k = 0; k < n && ratio && error && scene; k++) {
    if (only && strcmp(only, contests[k].name)) continue;
    long judged = 0, covered = 0, bounds = 0, broken = 0, flows = 0, balanced = 0, quiet = 0;
    size_t ratios = 0, errors = 0;
    double worst = 0.0;
    state = seed * 0x9E3779B97F4A7C15u + 1;
    for (long i = 0; i < scenes; i++) {
      static sample s;
      static got g;
      static answer true_;
      memset(&s, 0, sizeof s);
      s.c = constraint;
      contests[k].make(&s);
      const int done = run_sample(&s, scene, &g);
      if (truth(&s, &true_)) {
        fprintf(stderr, "%s %ld: no truth\n", contests[k].name, i);
        continue;
      }
      judged++;
      if (!done) {
        fprintf(stderr, "%s %ld\n", contests[k].name, i);
        continue;
      }
      double off[2] = {0.0, 0.0}, part = 0.0, said = 0.0;
      int flow_held = 1, held = 1;
      for (int m = 0; m < 2; m++) {
        for (size_t j = 0; j < ROWS * g.links; j++) {
          const quad want = (m ? true_.omega : true_.theta)[j / g.links][j % g.links];
          off[m] = fmax(off[m], (double)fabsq((quad)g.column[m][j] - want));
        }
        const double figure = g.out.info.measure[m].error, size = true_.most[m];
        held = held && off[m] <= figure + 1e-24 * size;
        if (size > 0.0) part = fmax(part, off[m] / size), said = fmax(said, figure / size);
        if (getenv("COVERAGE_SHOW") && off[m] > figure) {
          fprintf(stderr, "%s %ld: %s, measure %d off by %.3g of %.3g (largest %.3g, asked %.1e)\n",
                  contests[k].name, i, g.out.model->id, m, off[m], figure, size, s.accuracy);
        }
      }
      for (size_t f = 0; f < constraint->n_flows; f++) {
        for (int j = 0; j < ROWS; j++) {
          const double e = (double)fabsq((quad)g.flow[f][j] - true_.flow[j][f]);
          const int here = e <= g.flow_error[f] + 4e-16 * fabs(g.flow[f][j]);
          if (getenv("COVERAGE_SHOW") && !here) {
            fprintf(stderr, "%s %ld: %s off by %.3g of %.3g (value %.3g, asked %.1e)\n",
                    contests[k].name, i, constraint->flows[f], e, g.flow_error[f], g.flow[f][j],
                    s.accuracy);
          }
          flow_held = flow_held && here;
        }
      }
      const double audit = worst_audit(&s, scene, &g);
      if (getenv("COVERAGE_SHOW") && !(audit <= 1.0)) {
        fprintf(stderr, "%s %ld: an audit is off by %.3g of what is explained\n", contests[k].name,
                i, audit);
      }
      covered += held;
      flows += flow_held;
      balanced += audit <= 1.0;
      if (g.out.model->error_kind == ROT_BOUND) {
        bounds++;
        broken += !held;
      }
      if (!held && part > 10.0 * said && part > 1e-14) {
        quiet++;
        fprintf(stderr, "%s %ld: silent\n", contests[k].name, i);
      }
      if (said < 1.0) worst = fmax(worst, part);
      error[errors++] = part;
      if (part > 0.0) ratio[ratios++] = said / part;
    }
    const double all = judged ? (double)judged : 1.0;
    printf(
        "| `%s` | %ld | %ld, %ld broken | %.1f %% | %.1f %% | %.1f %% | %ld | %.1e | %.1e | %.3g "
        "|\n",
        contests[k].name, judged, bounds, broken, 100.0 * (double)covered / all,
        100.0 * (double)flows / all, 100.0 * (double)balanced / all, quiet, median(errors, error),
        worst, median(ratios, ratio));
    fflush(stdout);
    silent += quiet;
    if (broken || (double)covered < contests[k].least * (double)judged ||
        (double)flows < 0.95 * (double)judged || (double)balanced < 0.95 * (double)judged) {
      bad = 1;
    }
  }
  printf("%s: %ld silent\n", title, silent);
  free(ratio);
  free(error);
  free(scene);
  return bad || silent > 0;
}

#endif
