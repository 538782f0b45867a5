/* Balances of a body on an axle, and conserved quantities. */
#ifndef ROT_AXLE_BALANCES_H
#define ROT_AXLE_BALANCES_H

#include "engine/model.h"

enum { ROT_AXLE_BALANCES = 2, ROT_AXLE_TERMS = 12 };

extern const rot_balance rot_axle_balances[ROT_AXLE_BALANCES];
extern const rot_balance_term rot_axle_terms[ROT_AXLE_TERMS];

/* Of rot_constraint; built: a rot_axle_built. audit: (two rows, flows) => terms of the balances. */
void rot_axle_audit(const void *built, const rot_span *span, double term[]);
/* explain: (two rows, terms) => residuals explained by the errors. */
void rot_axle_explain(const void *built, const rot_span *span, const double term[],
                      double explained[]);
/* term_words: term => its text; NULL: the scene lacks it. */
const char *rot_axle_term_words(const void *built, size_t term);
/* conserved: balance => number of reasons against conservation, reasons. */
size_t rot_axle_conserved(const void *built, size_t balance, const char *why[]);

#endif
