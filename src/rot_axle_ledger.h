/* Where the energy went: work, heat and angular impulse between two times. */
#ifndef ROT_AXLE_LEDGER_H
#define ROT_AXLE_LEDGER_H

#include "rot_axle.h"

typedef struct rot_axle_ledger {
  double work_j;       /* of the applied torque */
  double dissipated_j; /* by the resistance; computed by itself, never as a difference */
  double impulse_n_m_s;
  double work_rounding_j, dissipated_rounding_j, impulse_rounding_n_m_s; /* bounds */
  double viscous_j, quadratic_j, coulomb_j;                              /* parts of dissipated_j */
  double damping_impulse_n_m_s;  /* of the resistance, that which holds at rest too */
  double inertia_work_j;         /* of what changes the inertia: -1/2 dI/dt omega^2, integrated */
  double damping_rounding_n_m_s; /* of damping_impulse_n_m_s */
} rot_axle_ledger;

/* Closed form of rot_axle_linear() from from_s to to_s >= from_s. */
rot_status rot_axle_linear_ledger(const rot_axle_params *p, double from_s, double to_s,
                                  const rot_hooks *hooks, rot_axle_ledger *out, rot_info *info);

#endif
