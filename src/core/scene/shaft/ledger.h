/* Work and heat of a shaft of rotors. */
#ifndef ROT_SHAFT_LEDGER_H
#define ROT_SHAFT_LEDGER_H

#include "scene/shaft/shaft.h"

/* Work of the torques and heat of all dampers between two times, with their rounding. */
#define ROT_SHAFT_LEDGER(X)                                                                        \
  X(work_j)                                                                                        \
  X(dissipated_j)                                                                                  \
  X(work_rounding_j)                                                                               \
  X(dissipated_rounding_j)

typedef struct rot_shaft_ledger {
#define X(name) double name;
  ROT_SHAFT_LEDGER(X)
#undef X
} rot_shaft_ledger;

/* `rigid`: of the rigid shaft. from_s <= to_s. */
rot_status rot_shaft_balance(const rot_shaft_params *p, int rigid, double from_s, double to_s,
                             const rot_hooks *hooks, rot_shaft_ledger *ledger);

#endif
