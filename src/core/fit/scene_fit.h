/* Least-squares fit of inputs of a scene, and of offsets, factors and clocks of instruments, to
 * records of its motion. */
#ifndef ROT_SCENE_FIT_H
#define ROT_SCENE_FIT_H

#include "fit/problem.h"

/* (problem, start x) => fit. low = high: fixed. ROT_EVALUE: refused; no->input: place of the path,
 * n_inputs: the scene, n_inputs + 1 + k: unknown k has no effect on what was observed. ROT_ERANGE,
 * ROT_EBUDGET: no minimum; the fit has the best point, without errors. A point whose motion cannot
 * be computed is one with infinite residuals: the step to it is shortened. */
rot_status rot_fit_solve(const rot_fit_problem *problem, const rot_hooks *hooks, rot_fit *fit,
                         rot_refusal *no);

#endif
