/* The balances of two bodies and a clutch. */
#ifndef ROT_CLUTCH_LEDGER_H
#define ROT_CLUTCH_LEDGER_H

#include "engine/model.h"

enum { ROT_CLUTCH_BALANCES = 2, ROT_CLUTCH_TERMS = 5 };

extern const rot_balance rot_clutch_balances[ROT_CLUTCH_BALANCES];
extern const rot_balance_term rot_clutch_terms[ROT_CLUTCH_TERMS];

/* rot_constraint.audit: (two rows, flows) => terms of the balances. */
void rot_clutch_audit(const void *scene, const rot_span *span, double term[]);
/* rot_constraint.conserved: balance => number of reasons against conservation, reasons. */
size_t rot_clutch_conserved(const void *scene, size_t balance, const char *why[]);

#endif
