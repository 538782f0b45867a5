/* Values between the steps of an integrator: the polynomial through the values, and where they are
 * to be trusted the slopes, of the steps' ends around.
 *
 * Hermite through eight nodes has degree 15: at steps h of order-8 methods its error is far below
 * theirs, where four nodes were a thousand times above. The share of the last node taken in is
 * kept as an estimate, which tells where a further node is needed. */
#ifndef ROT_DENSE_H
#define ROT_DENSE_H

#include <stddef.h>

#include "ground/status.h"

/* Nodes of one smooth segment in their order: t, y[dim], f[dim] each. */
typedef struct rot_dense {
  size_t dim, count, room;
  int slopes; /* f is to be trusted */
  double *data;
} rot_dense; /* begin with {dim, 0, 0, slopes, NULL} */

/* Nodes of a polynomial: with slopes, and of values alone. */
enum {
  ROT_DENSE_NODES = 8,
  ROT_DENSE_VALUES = 12,
  ROT_DENSE_CORRECTIONS = 2,
  ROT_DENSE_TERMS = 2 * ROT_DENSE_NODES + ROT_DENSE_CORRECTIONS
};

/* ROT_OK or ROT_ENOMEM. Insert before node `at`, or add with at = count. */
rot_status rot_dense_insert(rot_dense *d, size_t at, double t, const double y[], const double f[]);
/* Drop the first nodes. */
void rot_dense_drop(rot_dense *d, size_t count);
void rot_dense_free(rot_dense *d);

static inline const double *rot_dense_node(const rot_dense *d, size_t i) {
  return d->data + i * (1 + 2 * d->dim);
}

/* One component between nodes i and i + 1, in Newton's form. */
typedef struct rot_dense_form {
  size_t terms, fraction; /* fraction: of those, the last node's, or the last correction */
  size_t corrections;
  double start, width, base;
  double z[ROT_DENSE_TERMS], c[ROT_DENSE_TERMS];
} rot_dense_form;

rot_dense_form rot_dense_between(const rot_dense *d, size_t i, size_t component);

/* Place of the next correction: where a term more has the steepest slope. */
double rot_dense_correction_at(const rot_dense_form *form);
/* Adds one term so that the derivative there equals `slope`. At most ROT_DENSE_CORRECTIONS times.
 * */
void rot_dense_correct(rot_dense_form *form, double slope);

/* The value at t, its slope, and what the last node's share of each is (any may be NULL). */
double rot_dense_at(const rot_dense_form *form, double t, double *slope, double *fraction,
                    double *slope_fraction);

#endif
