/* How far two runs of one motion, of steps and of parts of them, are from each other. */
#ifndef ROT_ODE_DIFFERENCE_H
#define ROT_ODE_DIFFERENCE_H

#include "engine/ode/stepping.h"

enum { ROT_ODE_MAX_PLACES = 32 };

/* Of each measure the larger of difference[] and that of the states a and b. `change`: dim of work
 * space. */
void rot_ode_note_difference(const rot_ode_params *p, const double a[], const double b[],
                             double change[], double difference[]);

/* (traces of one side; its rows, from `first` on) => the largest difference of each measure, where
 * both have a step's end: at that on or behind a row, and at so many `places` in front of it, since
 * at one the difference of an oscillation may be next to 0 in one of its measures. The rows move by
 * `correction` times the difference there. `change`: as above. */
void rot_ode_differences(const rot_ode_trace *coarse, const rot_ode_trace *fine,
                         const rot_ode_job *job, int forward, size_t first, size_t rows,
                         size_t places, double correction, double change[], double difference[]);

#endif
