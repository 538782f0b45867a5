/* The balances of a body on an axle, and what is conserved. */
#ifndef ROT_AXLE_BALANCES_H
#define ROT_AXLE_BALANCES_H

#include "engine/model.h"

enum { ROT_AXLE_BALANCES = 2, ROT_AXLE_TERMS = 12 };

extern const rot_balance rot_axle_balances[ROT_AXLE_BALANCES];
extern const rot_balance_term rot_axle_terms[ROT_AXLE_TERMS];

/* rot_constraint.audit, .explain, .term_words and .keeps, of an axle as built. */
void rot_axle_audit(const void *built, const rot_span *span, double term[]);
void rot_axle_explain(const void *built, const rot_span *span, const double term[],
                      double explained[]);
const char *rot_axle_term_words(const void *built, size_t term);
size_t rot_axle_conserved(const void *built, size_t balance, const char *why[]);

#endif
