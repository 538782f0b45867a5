/* Columns of a scene's motion at the times of a record, for numbers of its inputs that vary, and
 * their derivatives by these numbers: differences whose step follows from the errors of the motion.
 * Where an event passes a sample between the two sides, the derivative is that of the side on which
 * the sample lies. */
#ifndef ROT_FIT_MOTION_H
#define ROT_FIT_MOTION_H

#include "sweep/variants.h"

/* A column of the motion that was observed. */
typedef struct rot_fit_column {
  size_t column; /* of the constraint */
  size_t place;  /* of several rows for each time: from 1; 0: one row */
} rot_fit_column;

/* The motion of a record as the caller computes it: (numbers that vary, n times) => column k at
 * time i in value[k * n + i], how many events are at or before each time, the largest relative
 * error. ROT_EVALUE: the numbers are refused. After ROT_EUNWIND it is not called again. */
typedef rot_status (*rot_fit_run)(size_t record, const double input[], size_t n,
                                  const double time_s[], double value[], size_t events[],
                                  double *error, void *ctx);

typedef struct rot_fit_motion_plan {
  const rot_object *scene;
  size_t n_inputs;
  const char *const *inputs; /* paths */
  size_t n_columns;
  const rot_fit_column *columns;
  size_t n; /* times, not decreasing, none before the start of a scene */
  const double *time_s;
  double accuracy, max_steps;
  rot_fit_run run; /* NULL: the core computes the motion; else it needs no scene and no paths */
  void *ctx;
  size_t record;
} rot_fit_motion_plan;

typedef struct rot_fit_motion rot_fit_motion;

/* ROT_EVALUE: a path or the scene is refused; no->input: the place of the path, or n_inputs */
rot_status rot_fit_motion_open(const rot_fit_motion_plan *plan, rot_fit_motion **to,
                               rot_refusal *no);
void rot_fit_motion_close(rot_fit_motion *motion);

/* (inputs, shift of the times) => column k at time i in value[k * n + i], and the largest relative
 * error. ROT_EVALUE: refused. The same point again runs nothing, nor do its derivatives. */
rot_status rot_fit_motion_at(rot_fit_motion *motion, const double input[], double shift_s,
                             double value[], double *error);

/* The derivatives by input j, or by the shift (j = n_inputs), at the point of the last
 * rot_fit_motion_at(), in slope[k * n + i]. low, high: the domain of the input. *size is the step
 * that was used before, or 0; it follows the motion. */
rot_status rot_fit_motion_slope(rot_fit_motion *motion, size_t j, double low, double high,
                                double *size, double slope[]);

/* => model of the last run (NULL: none, or `run` knows), number of runs */
const rot_model *rot_fit_motion_model(const rot_fit_motion *motion);
size_t rot_fit_motion_runs(const rot_fit_motion *motion);

#endif
