/* Work, heat and balances of a shaft of rotors. */
#ifndef ROT_SHAFT_LEDGER_H
#define ROT_SHAFT_LEDGER_H

#include "engine/model.h"
#include "scene/shaft/shaft.h"

/* Work of the torques and heat of all dampers between two times; their rounding. */
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

/* (shaft, times from_s <= to_s) => work, heat. rigid: those of the rigid shaft. */
rot_status rot_shaft_balance(const rot_shaft_params *p, int rigid, double from_s, double to_s,
                             const rot_hooks *hooks, rot_shaft_ledger *ledger);

enum { ROT_SHAFT_FLOWS = 4, ROT_SHAFT_BALANCES = 2, ROT_SHAFT_TERMS = 7 };

extern const char *const rot_shaft_flow_names[ROT_SHAFT_FLOWS];
extern const rot_balance rot_shaft_balances[ROT_SHAFT_BALANCES];
extern const rot_balance_term rot_shaft_terms[ROT_SHAFT_TERMS];

/* rows of a run => flows since the start, their errors. */
rot_status rot_shaft_flow(const rot_shaft_params *p, int rigid, size_t n, const double time_s[],
                          const rot_shaft_columns *rows, const rot_info *info, double *const flow[],
                          double error[], const rot_hooks *hooks);

/* rot_constraint.audit: (two rows, flows) => terms of the balances. */
void rot_shaft_audit(const void *scene, const rot_span *span, double term[]);
/* rot_constraint.conserved: balance => number of reasons against conservation, reasons. */
size_t rot_shaft_conserved(const void *scene, size_t balance, const char *why[]);

#endif
