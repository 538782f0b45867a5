/* One run of the integrator on one side of the start, and its steps: tried, searched for events,
 * kinks and surfaces, accepted. */
#ifndef ROT_ODE_ADVANCE_H
#define ROT_ODE_ADVANCE_H

#include <stdint.h>

#include "engine/ode/event.h"
#include "engine/ode/propagation.h"
#include "engine/ode/kink.h"
#include "engine/ode/rest.h"
#include "engine/ode/rows.h"
#include "engine/ode/trace.h"

/* What the steps of a run say of its errors, of each measure where it is an array. */
typedef struct rot_ode_errors {
  double found;      /* by the error test, in the steps, their sum */
  double *missed;    /* of each integral, likewise: no test weighs them */
  double unresolved; /* in steps where halving did not help: the root of the sum of squares */
  double *moved;     /* by the projection, summed */
  double *fraction;  /* by polynomials, in rows */
} rot_ode_errors;

/* Where a number of tried steps had led. */
typedef struct rot_ode_progress {
  size_t tried;
  double t;
} rot_ode_progress;

/* Each member's struct says what it reads and what it changes of the others. */
typedef struct rot_ode_stepping {
  const rot_ode_params *p;
  const rot_hooks *hooks;
  rot_info *info;
  size_t budget;
  rot_ode_progress progress;
  rot_ode_clock clock;
  rot_ode_state state;
  rot_ode_stiffness stiffness;
  rot_ode_law law;
  rot_ode_stepper step;
  rot_ode_search search;
  rot_ode_kink_search kinks;
  rot_ode_rest rest;
  rot_ode_reference reference;
  rot_ode_rows rows;
  double limit;    /* no step is longer, after a rejection in a reference run */
  double *scratch; /* dim */
  rot_ode_errors *errors;
  rot_ode_trace *trace;             /* its own steps */
  rot_ode_propagation *propagation; /* of its rounding; NULL: not followed */
  rot_ode_trajectory *trajectory;   /* NULL: not kept */
  uint64_t rounding;                /* the next roundings that a state is moved by; 0: none */
} rot_ode_stepping;

/* The state becomes a node of all that follows the run. */
rot_status rot_ode_add_node(rot_ode_stepping *run);

/* One step towards `stop`, which no break comes before; *which: as rot_ode_look_for_events(). */
rot_status rot_ode_advance(rot_ode_stepping *run, double stop, double fraction,
                           rot_ode_passage *what, size_t *which);
/* At rest, up to `stop` or to where it breaks loose. */
rot_status rot_ode_rest_until(rot_ode_stepping *run, double stop, int *broke_loose);

#endif
