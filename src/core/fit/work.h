/* What a fit works on: the variables that the solver moves, the samples, motions and room. */

#ifndef ROT_FIT_WORK_H
#define ROT_FIT_WORK_H

#include "fit/problem.h"

/* A series without its missing samples, whitened by its noise. */
typedef struct rot_fit_samples {
  const rot_fit_series *of;
  size_t record, first; /* of the residuals */
  size_t n;
  size_t *at; /* rows of the record */
  double *time_s;
  rot_fit_noise *noise;
  int counted; /* 1: its errors are those of its counts */
} rot_fit_samples;

typedef struct rot_fit_work {
  const rot_fit_problem *problem;
  const rot_hooks *hooks;
  rot_fit *fit;
  rot_fit_motion **motions; /* of each record */
  rot_fit_motion_plan *plans;
  rot_fit_column *columns;
  size_t n_series, n_residuals, n_priors, longest;
  rot_fit_samples *series;
  int whole;               /* 1: residuals and derivatives by weight alone, for the noise */
  size_t n_free, *free_at; /* variables that the solver moves */
  double *u, *x;           /* all variables; the inputs of their values, in their domains */
  double *step;            /* of each record and unknown, and its shift */
  double *value, *slope, *block, *input;
  double size;          /* of the whitened residuals that are not of counters */
  double error;         /* of the motions, relative, the largest so far */
  rot_status ended;     /* what ended the search in a call by the solver */
  double *best_u, best; /* the lowest sum of squares so far */
  rot_store store;
} rot_fit_work;

/* Zeroed but for problem, hooks and fit. Closed also where opening failed. */
rot_status rot_fit_work_open(rot_fit_work *w, rot_refusal *no);
void rot_fit_work_close(rot_fit_work *w);

/* The solver's variable of an unknown: its logarithm, where the problem says so. */
double rot_fit_variable_of(const rot_fit_problem *p, size_t k, double x);
/* The unknown within its domain. */
double rot_fit_value_of(const rot_fit_problem *p, size_t k, double u);
int rot_fit_has_prior(const rot_fit_problem *p, size_t k);

#endif
