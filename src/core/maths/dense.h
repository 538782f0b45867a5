/* Dense output between the steps of an integrator: the polynomial through the nearest steps' values
 * and, if accurate, slopes.
 *
 * The Hermite polynomial through eight nodes has degree 15: at the steps of order-8 methods its
 * error is far below theirs; with four nodes it was a thousand times above. The contribution of the
 * last node is the error estimate, which decides where a further node is needed. */
#ifndef ROT_DENSE_H
#define ROT_DENSE_H

#include <stddef.h>

#include "ground/status.h"

/* Nodes of one smooth segment in order of time. Begin with {dim, 0, 0, slopes, NULL}. */
typedef struct rot_dense {
  size_t dim;   /* components of y */
  size_t count; /* nodes */
  size_t room;  /* nodes allocated */
  int slopes;   /* 1: f is accurate and is used */
  double *data; /* t, y[dim], f[dim] of each node */
} rot_dense;

enum {
  ROT_DENSE_NODES = 8,       /* of a polynomial with slopes */
  ROT_DENSE_VALUES = 12,     /* of a polynomial of values only */
  ROT_DENSE_CORRECTIONS = 2, /* at most */
  ROT_DENSE_TERMS = 2 * ROT_DENSE_NODES + ROT_DENSE_CORRECTIONS
};

/* Inserts a node before node `at`, or appends it for at = count. ROT_OK or ROT_ENOMEM. */
rot_status rot_dense_insert(rot_dense *d, size_t at, double t, const double y[], const double f[]);
/* Removes the first `count` nodes. */
void rot_dense_drop(rot_dense *d, size_t count);
/* Frees all nodes; `d` may be used again. */
void rot_dense_free(rot_dense *d);

/* i => t, y[dim], f[dim] of node i */
static inline const double *rot_dense_node(const rot_dense *d, size_t i) {
  return d->data + i * (1 + 2 * d->dim);
}

/* Newton's form of one component between nodes i and i + 1: base + sum c_k prod (x - z_j) with
 * x = (t - start)/width. */
typedef struct rot_dense_form {
  size_t terms;       /* of the polynomial */
  size_t estimating;  /* last terms, which make the error estimate: a node or a correction */
  size_t corrections; /* added so far */
  double start;       /* time of node i */
  double width;       /* time from node i to node i + 1 */
  double base;        /* value at node i */
  double z[ROT_DENSE_TERMS], c[ROT_DENSE_TERMS];
} rot_dense_form;

/* (nodes, interval i, component) => its polynomial */
rot_dense_form rot_dense_between(const rot_dense *d, size_t i, size_t component);

/* => time of the next correction, where the slope of an additional term is largest */
double rot_dense_correction_at(const rot_dense_form *form);
/* Adds one term so that the derivative at that time equals `slope`; at most ROT_DENSE_CORRECTIONS
 * times. */
void rot_dense_correct(rot_dense_form *form, double slope);

/* t => value, slope, error estimates of both: the last terms (each may be NULL) */
double rot_dense_at(const rot_dense_form *form, double t, double *slope, double *unsure,
                    double *slope_unsure);

#endif
