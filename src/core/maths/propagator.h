/* x' = A x with constant A in twice the precision, for any length of time: exp(A h) of a short h,
 * then of 2 h, 4 h, ..., as many as the times need; a state at t takes those of the binary digits
 * of t/h, and a series for the rest. At |A| t = 1e9 squaring in doubles leaves 1e-7 of the state,
 * and of a slow motion beside the fast one as much; here 1e-22. */
#ifndef ROT_PROPAGATOR_H
#define ROT_PROPAGATOR_H

#include <stddef.h>

#include "ground/dd.h"
#include "ground/status.h"

typedef struct rot_propagator {
  size_t n;
  int exponent;    /* h = 2^exponent s, |A| h between 1/8 and 1/4 */
  size_t levels;   /* number of powers */
  size_t room;     /* for so many */
  rot_dd *memory;  /* of a, work */
  rot_dd *a;       /* A h, n x n, by rows */
  size_t *places;  /* n x n: in which columns each row has entries that are not 0 */
  size_t *entries; /* n: how many */
  rot_dd *work;    /* 2 n, for products */
  rot_dd *power;   /* levels x n x n: exp(A h 2^level) */
  const rot_hooks *hooks;
} rot_propagator;

/* (A n x n, 1/s) => propagator. ROT_ERANGE if A is not finite. Call rot_propagator_end()
 * afterwards, also after a failure. */
rot_status rot_propagator_begin(rot_propagator *x, size_t n, const rot_dd a[],
                                const rot_hooks *hooks);
/* x => exp(A t) x, t >= 0. ROT_ERANGE if it overflows. */
rot_status rot_propagator_move(rot_propagator *p, rot_dd t, rot_dd x[]);
/* Frees the memory. */
void rot_propagator_end(rot_propagator *x);

#endif
