/* Inputs of a body with a fixed point. */
#ifndef ROT_PIVOT_INPUTS_H
#define ROT_PIVOT_INPUTS_H

#include "engine/input.h"
#include "ground/store.h"

enum { ROT_PIVOT_INPUTS = 13 };
extern const rot_input rot_pivot_inputs[ROT_PIVOT_INPUTS];

/* rot_constraint.build: inputs => rot_free_built with moments about the fixed point, or a
 * refusal. */
rot_status rot_pivot_build(const rot_given given[], rot_store *store, void *built,
                           rot_refusal *refusal);

#endif
