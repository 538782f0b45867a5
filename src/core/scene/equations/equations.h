/* Equations of motion of the caller's own: a system y' = f(t, y) of the first order, of up to 16
 * states, whose right-hand side is a law that the caller evaluates. Each state is a measure. */
#ifndef ROT_EQUATIONS_H
#define ROT_EQUATIONS_H

#include "engine/model.h"

extern const rot_constraint rot_equations_constraint;

#endif
