#include "fit/work.h"

#include <math.h>
#include <string.h>

/* ---- variables ------------------------------------------------------------------------------- */

double rot_fit_variable_of(const rot_fit_problem *p, size_t k, double x) {
  return p->logarithm[k] ? log(x) : x;
}

double rot_fit_value_of(const rot_fit_problem *p, size_t k, double u) {
  const double x = p->logarithm[k] ? exp(u) : u;
  return x < p->low[k] ? p->low[k] : x > p->high[k] ? p->high[k] : x;
}

int rot_fit_has_prior(const rot_fit_problem *p, size_t k) { return p->prior_sd[k] > 0.0; }

/* ---- opening --------------------------------------------------------------------------------- */

static size_t present(const rot_fit_record *record, const rot_fit_series *of, size_t at[]) {
  size_t n = 0;
  for (size_t i = 0; i < record->n; i++) {
    if (!isfinite(of->y[i])) continue;
    if (at) at[n] = i;
    n++;
  }
  return n;
}

static rot_status open_series(rot_fit_work *w) {
  const rot_fit_problem *p = w->problem;
  size_t k = 0;
  for (size_t r = 0; r < p->n_records; r++) {
    const rot_fit_record *record = &p->records[r];
    for (size_t c = 0; c < record->n_series; c++, k++) {
      rot_fit_samples *s = &w->series[k];
      s->of = &record->series[c];
      s->record = r;
      s->first = w->n_residuals;
      s->noise = &w->fit->noise[k];
      s->at = rot_store_get(&w->store, record->n + 1, sizeof *s->at);
      s->time_s = rot_store_get(&w->store, record->n + 1, sizeof *s->time_s);
      if (!s->at || !s->time_s) return ROT_ENOMEM;
      s->n = present(record, s->of, s->at);
      for (size_t i = 0; i < s->n; i++) s->time_s[i] = record->time_s[s->at[i]];
      w->n_residuals += s->n;
    }
  }
  w->fit->samples = w->n_residuals;
  for (size_t j = 0; j < p->n_unknowns; j++) w->n_priors += (size_t)rot_fit_has_prior(p, j);
  w->n_residuals += w->n_priors;
  return ROT_OK;
}

static rot_status open_motions(rot_fit_work *w, rot_refusal *no) {
  const rot_fit_problem *p = w->problem;
  rot_fit_column *columns = w->columns;
  for (size_t r = 0; r < p->n_records; r++) {
    const rot_fit_record *record = &p->records[r];
    for (size_t c = 0; c < record->n_series; c++) columns[c] = record->series[c].of;
    w->plans[r] = (rot_fit_motion_plan){.scene = p->scene,
                                        .run = p->run,
                                        .ctx = p->ctx,
                                        .record = r,
                                        .n_inputs = p->n_inputs,
                                        .inputs = p->inputs,
                                        .n_columns = record->n_series,
                                        .columns = columns,
                                        .n = record->n,
                                        .time_s = record->time_s,
                                        .accuracy = p->accuracy,
                                        .max_steps = p->max_steps};
    columns += record->n_series;
    const rot_status status = rot_fit_motion_open(&w->plans[r], &w->motions[r], no);
    if (status != ROT_OK) return status;
  }
  return ROT_OK;
}

rot_status rot_fit_work_open(rot_fit_work *w, rot_refusal *no) {
  const rot_fit_problem *p = w->problem;
  const size_t m = p->n_unknowns;
  size_t longest_block = 0;
  for (size_t r = 0; r < p->n_records; r++) {
    const rot_fit_record *record = &p->records[r];
    w->n_series += record->n_series;
    if (record->n * record->n_series > longest_block) longest_block = record->n * record->n_series;
    if (record->n > w->longest) w->longest = record->n;
  }
  w->series = rot_store_get(&w->store, w->n_series + 1, sizeof *w->series);
  w->motions = rot_store_get(&w->store, p->n_records + 1, sizeof *w->motions);
  w->plans = rot_store_get(&w->store, p->n_records + 1, sizeof *w->plans);
  w->columns = rot_store_get(&w->store, w->n_series + 1, sizeof *w->columns);
  w->free_at = rot_store_get(&w->store, m + 1, sizeof *w->free_at);
  double *numbers = rot_store_get(&w->store, 4 * m + p->n_inputs + 1, sizeof *numbers);
  w->step = rot_store_get(&w->store, p->n_records * (p->n_inputs + 1) + 1, sizeof *w->step);
  w->value = rot_store_get(&w->store, longest_block + 1, sizeof *w->value);
  w->slope = rot_store_get(&w->store, longest_block * (m + 1) + 1, sizeof *w->slope);
  w->block = rot_store_get(&w->store, w->longest * (m + 1) + 1, sizeof *w->block);
  if (!w->series || !w->motions || !w->plans || !w->columns || !w->free_at || !numbers ||
      !w->step || !w->value || !w->slope || !w->block) {
    return ROT_ENOMEM;
  }
  w->u = numbers;
  w->x = numbers + m;
  w->best_u = numbers + 2 * m;
  w->input = numbers + 3 * m;
  memset(w->motions, 0, (p->n_records + 1) * sizeof *w->motions);
  memset(w->step, 0, (p->n_records * (p->n_inputs + 1) + 1) * sizeof *w->step);
  const rot_status status = open_series(w);
  return status == ROT_OK ? open_motions(w, no) : status;
}

void rot_fit_work_close(rot_fit_work *w) {
  for (size_t r = 0; w->motions && r < w->problem->n_records; r++) {
    if (w->motions[r]) w->fit->runs += rot_fit_motion_runs(w->motions[r]);
    rot_fit_motion_close(w->motions[r]);
  }
  rot_store_free(&w->store);
}
