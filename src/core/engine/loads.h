/* Torque laws as users give them, and the normal form that the models read: one set of knots, the
 * slope of the motors, terms, and the laws that only the caller evaluates. */
#ifndef ROT_LOADS_H
#define ROT_LOADS_H

#include "engine/part.h"
#include "engine/term.h"
#include "engine/torque.h"

typedef enum rot_law_kind { ROT_LAW_KNOTS, ROT_LAW_MOTOR, ROT_LAW_TERM, ROT_LAW_CALL } rot_law_kind;

/* One law; what its kind does not need is 0. */
typedef struct rot_law_one {
  rot_law_kind kind;
  rot_torque knots;
  double stall_n_m, no_load_rad_per_s; /* of a motor */
  rot_term term;
  rot_law call; /* of time_s, theta_rad, omega_rad_per_s */
  size_t n_breaks;
  const double *breaks_s; /* beside those of its numbers */
  double noise_n_m;       /* how far its numbers may be off */
} rot_law_one;

/* What a part that makes a torque builds: a sum of laws. */
typedef struct rot_law_sum {
  size_t n;
  const rot_law_one *law;
} rot_law_sum;

/* The laws given, in the store: a number, a law, an object, a list of them, or nothing. */
rot_status rot_law_sum_of(const rot_given *given, rot_store *store, rot_law_sum *sum);

typedef struct rot_loads {
  rot_torque knots; /* constants, knots, motors at rest; with the call of all laws that need one */
  double motor_n_m_s; /* how steeply the motors' torque falls with omega */
  size_t n_terms;
  const rot_term *terms;
  size_t n_breaks;
  const double *breaks_s; /* beside those of their numbers, increasing */
  double noise_n_m;
} rot_loads;

/* Their normal form. ROT_ENOMEM, or ROT_EVALUE: a sum is beyond double precision. */
rot_status rot_loads_of(const rot_given *given, rot_store *store, rot_loads *loads);

/* The sum of n laws that are knots: linear between the knots of all, jumps stay jumps. The numbers
 * are those of the laws or in the store. */
rot_status rot_loads_add_knots(size_t n, const rot_torque law[], rot_store *store, rot_torque *sum);

/* A law that is the same at all times. */
rot_torque rot_loads_constant(double torque_n_m);

#endif
