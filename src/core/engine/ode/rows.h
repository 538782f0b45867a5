/* Rows between the steps. */
#ifndef ROT_ODE_ROWS_H
#define ROT_ODE_ROWS_H

#include "engine/ode/probe.h"
#include "engine/ode/step.h"
#include "maths/dense.h"

/* What rot_ode_run() is to fill. `before`: rows before the start. */
typedef struct rot_ode_output {
  size_t n, before;
  const double *time_s;
  double *y, *slope; /* y NULL: no rows are wanted; slope may be NULL */
  double *error, *largest;
} rot_ode_output;

/* Whether some row lies between two times, or at one of them. */
int rot_ode_rows_within(const rot_ode_output *out, double a, double b);

typedef struct rot_ode_rows {
  const rot_ode_clock *clock;
  const rot_ode_state *state;
  rot_ode_law *law;
  rot_ode_stepper *step;  /* steps to rows where polynomials are not good enough */
  rot_ode_probes *probes; /* of the steps that have passed; NULL: none */
  rot_ode_output out;
  double *fraction;     /* of each measure: what the polynomials may be off by */
  size_t total, done;   /* on this side of the start, outward */
  double segment_t;     /* where the segment began */
  double probed_t;      /* up to here */
  rot_dense dense;      /* nodes of the segment */
  rot_dense_form *form; /* polynomials of an interval, */
  size_t formed;        /* from this node */
  double *row, *change; /* dim each */
} rot_ode_rows;

/* At the start of a run: its own rows. */
void rot_ode_rows_at_start(rot_ode_rows *r);
/* A segment begins; the state is a node. */
void rot_ode_rows_begin(rot_ode_rows *r);
rot_status rot_ode_rows_node(rot_ode_rows *r);
/* The rows that the nodes so far allow for: all of them, or those with four nodes beyond. */
rot_status rot_ode_fill_rows(rot_ode_rows *r, int whole_segment);

#endif
