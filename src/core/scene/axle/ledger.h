/* Work, heat and angular impulse between two times. */
#ifndef ROT_AXLE_LEDGER_H
#define ROT_AXLE_LEDGER_H

#include "scene/axle/axle.h"

/* Names in R and members. Heat is computed separately, never as a difference. */
#define ROT_AXLE_LEDGER(X)                                                                         \
  X(work_j) /* of the applied torque */                                                            \
  X(dissipated_j)                                                                                  \
  X(impulse_n_m_s)                                                                                 \
  X(work_rounding_j) /* bounds; estimates if integrated */                                         \
  X(dissipated_rounding_j)                                                                         \
  X(impulse_rounding_n_m_s)                                                                        \
  X(viscous_j) /* parts of dissipated_j */                                                         \
  X(quadratic_j)                                                                                   \
  X(coulomb_j)                                                                                     \
  X(damping_impulse_n_m_s) /* of the resistance, also at rest */                                   \
  X(inertia_work_j)        /* by changing the inertia: integral of -1/2 dI/dt omega^2 */

typedef struct rot_axle_ledger {
#define X(name) double name;
  ROT_AXLE_LEDGER(X)
#undef X
} rot_axle_ledger;

/* (parameters, n times, not decreasing) => ledgers from the first time to each, by the closed form
 * of rot_axle_linear(). After a failure: those before it. */
rot_status rot_axle_linear_ledgers(const rot_axle_params *p, size_t n, const double time_s[],
                                   const rot_hooks *hooks, rot_axle_ledger out[], rot_info *info);
/* (parameters, from_s, to_s >= from_s) => ledger. */
rot_status rot_axle_linear_ledger(const rot_axle_params *p, double from_s, double to_s,
                                  const rot_hooks *hooks, rot_axle_ledger *out, rot_info *info);

#endif
