#include "fit/scene_fit.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "fit/covariance.h"
#include "fit/minimum.h"
#include "fit/noise.h"
#include "fit/residuals.h"

/* At the start the squares are finite, and each unknown changes what was observed. */
static rot_status check_effects(rot_fit_work *w, double r[], double j[], rot_refusal *no) {
  const rot_fit_problem *p = w->problem;
  rot_fit_set_free(w);
  for (size_t k = 0; k < p->n_unknowns; k++) w->x[k] = rot_fit_value_of(p, k, w->u[k]);
  rot_status status = rot_fit_residuals(w, r);
  if (status == ROT_OK) status = rot_fit_derivatives(w, j);
  if (status == ROT_EVALUE) {
    return rot_refuse(no, p->n_inputs, "no model takes the scene, or its inputs are refused");
  }
  double squares = 0.0;
  for (size_t i = 0; i < w->n_residuals && status == ROT_OK; i++) squares += r[i] * r[i];
  if (!isfinite(squares)) return ROT_ERANGE;
  for (size_t q = 0; q < w->n_free && status == ROT_OK; q++) {
    size_t i = 0;
    while (i < w->n_residuals && j[i * w->n_free + q] == 0.0) i++;
    if (i < w->n_residuals) continue;
    return rot_refuse(no, p->n_inputs + 1 + w->free_at[q],
                      "it has no effect on what was observed, as the scene starts");
  }
  return status;
}

static rot_status solve(rot_fit_work *w, rot_refusal *no) {
  const rot_fit_problem *p = w->problem;
  double *r = malloc(w->n_residuals * (p->n_unknowns + 1) * sizeof *r);
  if (!r) return ROT_ENOMEM;
  for (size_t k = 0; k < w->n_series; k++) {
    if (p->noise)
      *w->series[k].noise = p->noise[k];
    else
      rot_fit_first_noise(&w->series[k], w->block);
  }
  for (size_t k = 0; k < p->n_unknowns; k++) {
    w->u[k] = rot_fit_variable_of(p, k, w->fit->x[k]);
    w->fit->held[k] = p->low[k] == p->high[k] ? -1 : 0;
  }
  rot_status status = check_effects(w, r, r + w->n_residuals, no);
  if (status != ROT_OK) {
    free(r);
    return status;
  }
  for (int round = 0; round < 5; round++) {
    int same = 1;
    status = rot_fit_minimum(w);
    if (status != ROT_OK || round == 4 || p->noise) break;
    rot_fit_set_free(w);
    status = rot_fit_find_noise(w, r, r + w->n_residuals, &same);
    if (status != ROT_OK || (same && round > 0)) break;
  }
  if (status == ROT_OK) status = rot_fit_put_counts(w, r, r + w->n_residuals);
  free(r);
  return status;
}

rot_status rot_fit_solve(const rot_fit_problem *problem, const rot_hooks *hooks, rot_fit *fit,
                         rot_refusal *no) {
  rot_fit_work w = {.problem = problem, .hooks = hooks, .fit = fit};
  fit->iterations = fit->runs = fit->samples = 0;
  fit->condition = fit->squares = NAN;
  fit->model = NULL;
  if (problem->n_unknowns < 1 || problem->n_unknowns > ROT_FIT_UNKNOWNS) return ROT_EVALUE;
  rot_status status = rot_fit_work_open(&w, no);
  if (status == ROT_OK) {
    status = solve(&w, no);
    memcpy(fit->x, w.x, problem->n_unknowns * sizeof *fit->x);
    if (status == ROT_OK || status == ROT_ERANGE || status == ROT_EBUDGET) {
      const rot_status put = rot_fit_put_fitted(&w);
      if (status == ROT_OK) status = put;
    }
  }
  rot_fit_work_close(&w);
  return status;
}
