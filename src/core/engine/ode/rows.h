/* Rows between the steps. */
#ifndef ROT_ODE_ROWS_H
#define ROT_ODE_ROWS_H

#include "engine/ode/probe.h"
#include "engine/ode/step.h"
#include "maths/dense.h"

/* The rows: as in rot_ode_run. `before`: those before the start. */
typedef struct rot_ode_output {
  size_t n, before;
  const double *time_s;
  double *y, *slope; /* y NULL: none are wanted; slope may be NULL */
} rot_ode_output;

typedef struct rot_ode_rows {
  const rot_ode_clock *clock;
  const rot_ode_state *state;
  rot_ode_law *law;
  rot_ode_stepper *stepper; /* steps to rows where polynomials are not good enough */
  rot_ode_probes *probes;   /* of the steps that have passed; NULL: none */
  rot_ode_output out;
  double *share;        /* of each measure: what the polynomials may be off by */
  size_t done;          /* outward from the start */
  double stretch_t;     /* where the stretch began */
  double probed_t;      /* up to here */
  rot_dense dense;      /* nodes of the stretch */
  rot_dense_form *form; /* of the interval of a row */
  double *row, *change; /* dim each */
} rot_ode_rows;

/* Rows on one side of the start. */
size_t rot_ode_rows_total(const rot_ode_rows *r);

/* Those at the start itself, where a run sets out. */
void rot_ode_rows_at_start(rot_ode_rows *r);

/* A stretch begins; the state is a node. */
void rot_ode_rows_begin(rot_ode_rows *r);
rot_status rot_ode_rows_node(rot_ode_rows *r);

/* The rows that the nodes so far allow for: all of them, or those with four nodes beyond. */
rot_status rot_ode_fill_rows(rot_ode_rows *r, int whole_stretch);

#endif
