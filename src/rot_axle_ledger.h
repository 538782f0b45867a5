/* Where the energy went: work, heat and angular impulse of the closed form between two times. */
#ifndef ROT_AXLE_LEDGER_H
#define ROT_AXLE_LEDGER_H

#include "rot_axle.h"

typedef struct rot_axle_ledger {
  double work_j;       /* of the applied torque */
  double dissipated_j; /* by the viscous resistance; computed by itself, never as a difference */
  double impulse_n_m_s;
  double work_rounding_j, dissipated_rounding_j, impulse_rounding_n_m_s; /* bounds */
} rot_axle_ledger;

/* Closed form of rot_axle_linear() from from_s to to_s >= from_s. */
rot_status rot_axle_linear_ledger(const rot_axle_params *p, double from_s, double to_s,
                                  const rot_hooks *hooks, rot_axle_ledger *out, rot_info *info);

#endif
