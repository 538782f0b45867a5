/* What resists a motion: the terms of resistance(), of which a scene takes some. */
#ifndef ROT_RESISTANCE_H
#define ROT_RESISTANCE_H

#include "engine/part.h"

typedef struct rot_resistance {
  double viscous_n_m_s;    /* torque over the angular velocity; below 0 it drives */
  double quadratic_n_m_s2; /* torque over its square, >= 0 */
  double coulomb_n_m;      /* sliding friction, >= 0 */
  double static_n_m;       /* largest static friction, >= coulomb_n_m */
  double damping_per_s;    /* of a body in space: torque over the angular momentum */
  double drag_n_s_per_m;   /* on a centre of mass: force over the velocity, >= 0 */
  double drag_n_s2_per_m2; /* over its square, >= 0 */
} rot_resistance;

extern const rot_part rot_resistance_part;

/* The terms of a torque about an axle: `options` of an input that takes these, by their names. */
extern const char *const rot_axle_resistance[];
/* Its viscous term alone; the linear drag on a centre of mass. */
extern const char *const rot_viscous_resistance[], *const rot_drag_resistance[];

/* (what an input was given) => its terms. Nothing: none. Refused: a term that is not among
 * input->options. `at`: the place of the input. */
rot_status rot_resistance_of(const rot_input *input, size_t at, const rot_given *given,
                             rot_resistance *terms, rot_refusal *refusal);

/* As rot_input_numbers(), where a resistance is the one term that its input takes. */
rot_status rot_resistance_numbers(size_t n, const rot_input inputs[], const rot_given given[],
                                  double x[], rot_refusal *refusal);

/* An input that is a resistance of these terms. */
#define ROT_RESISTANCE_INPUT(words, terms)                                                         \
  { "resistance", "", ROT_INPUT_RESISTANCE, 0, 0.0, 0.0, 0, NAN, words, terms }

/* The viscous coefficient of each of n bodies: from one or n numbers, from a resistance for all, or
 * from a list with a number, a resistance or nothing for each. */
rot_status rot_resistance_each(const rot_input *input, size_t at, const rot_given *given, size_t n,
                               double viscous_n_m_s[], rot_refusal *refusal);

/* Kinds of such an input. */
#define ROT_RESISTANCES (ROT_INPUT_NUMBERS | ROT_INPUT_RESISTANCE | ROT_INPUT_LIST)

#endif
