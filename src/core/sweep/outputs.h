/* Outputs of a run by name: final and extreme values, events, errors, the audit. */
#ifndef ROT_OUTPUTS_H
#define ROT_OUTPUTS_H

#include "scene/run.h"

typedef enum rot_output_kind {
  ROT_OUT_FINAL,    /* a column at the last time */
  ROT_OUT_MAX,      /* its largest value at the times of the run */
  ROT_OUT_MIN,      /* its least one */
  ROT_OUT_MAX_ABS,  /* its largest size */
  ROT_OUT_FIRST,    /* time of the first event of a kind; Inf: there is none */
  ROT_OUT_COUNT,    /* number of events of a kind */
  ROT_OUT_STOP,     /* time since when it is at rest, up to the last time; Inf: it moves then */
  ROT_OUT_PERIOD,   /* of the motion, where the constraint has one; NaN: none */
  ROT_OUT_SUPPLIED, /* energy, from the first to the last time */
  ROT_OUT_LOST,     /* to resistance */
  ROT_OUT_BALANCED, /* 1: all balances are; 0: one is not; NaN: one is not known */
  ROT_OUT_ERROR,    /* the error figure */
  ROT_OUT_STEPS
} rot_output_kind;

typedef struct rot_output_of {
  rot_output_kind kind;
  size_t at;    /* the column or the event */
  size_t place; /* of several rows for each time, or where an event is: from 1; 0: any */
} rot_output_of;

/* name => output; returns 0: scenes of this constraint have no such output */
int rot_output_named(const rot_constraint *constraint, const char *name, rot_output_of *to);
/* output => 1 if it needs flows */
int rot_output_audits(const rot_output_of *output);

/* A run, for its outputs. */
typedef struct rot_output_run {
  const rot_constraint *constraint;
  const void *scene;
  const rot_outcome *outcome;
  size_t n_times, rows_per_time;
  void *const *column;
  const double *time_s;
  /* If an output audits: flows at each time, their errors, room for 2 n_columns rows_per_time. */
  double *const *flow;
  const double *flow_error;
  double *cell;
} rot_output_run;
/* (run, n outputs) => values */
rot_status rot_outputs_of(const rot_output_run *run, size_t n, const rot_output_of outputs[],
                          double value[]);

/* An output that scenes have, by its name. Not 0 ends the walk. */
typedef int (*rot_output_visit)(const char *name, const char *unit, const char *words, void *ctx);
/* Visits the outputs of a scene; unit NULL: that of the column, as R's dictionary has it. */
void rot_outputs_walk(const rot_constraint *constraint, const void *scene, rot_output_visit visit,
                      void *ctx);

#endif
