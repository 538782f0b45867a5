/* Rows between the steps. */
#ifndef ROT_ODE_ROWS_H
#define ROT_ODE_ROWS_H

#include "engine/ode/run.h"

/* Those at the start itself. */
void rot_ode_rows_at_start(rot_ode_march *run);

/* The rows that the nodes so far allow for: all of them, or those with four nodes beyond. */
rot_status rot_ode_fill_rows(rot_ode_march *run, int whole_stretch);

#endif
