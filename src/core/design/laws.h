/* Laws of inputs: quantile functions, one call for a column.
 *
 * Reference for the normal law: M. J. Wichura, Algorithm AS 241, Appl. Stat. 37 (1988) 477 (GSL's
 * gsl_cdf_ugaussian_Pinv). */
#ifndef ROT_DESIGN_LAWS_H
#define ROT_DESIGN_LAWS_H

#include <stddef.h>
#include <stdint.h>

#include "ground/ieee.h"
#include "ground/status.h"
#include "ground/store.h"

/* code, name, names of the parameters */
#define ROT_VARY_LIST(X)                                                                           \
  X(ROT_VARY_FIXED, "fixed", "value", "", "")                                                      \
  X(ROT_VARY_VALUES, "values", "", "", "") /* x, weight */                                         \
  X(ROT_VARY_COLUMN, "column", "", "", "") /* x: a value for each row */                           \
  X(ROT_VARY_UNIFORM, "uniform", "low", "high", "")                                                \
  X(ROT_VARY_LOGUNIFORM, "loguniform", "low", "high", "") /* 0 < low */                            \
  X(ROT_VARY_NORMAL, "normal", "mean", "sd", "")                                                   \
  X(ROT_VARY_LOGNORMAL, "lognormal", "median", "factor", "") /* exp(sd of the logarithm) */        \
  X(ROT_VARY_TRIANGULAR, "triangular", "low", "mode", "high")

typedef enum rot_vary_kind {
#define X(code, name, a, b, c) code,
  ROT_VARY_LIST(X)
#undef X
      ROT_VARY_COUNT
} rot_vary_kind;

enum { ROT_VARY_PARAMETERS = 3 };

/* kind => name; NULL if there is no such kind */
const char *rot_vary_name(int kind);
/* (kind, i < 3) => name of the parameter, "" if there is none */
const char *rot_vary_parameter(int kind, int i);

typedef struct rot_vary {
  rot_vary_kind kind;
  double p[ROT_VARY_PARAMETERS];
  double low, high;     /* truncated to this interval; -Inf, Inf: not truncated */
  size_t n;             /* values */
  const double *x;      /* of them */
  const double *weight; /* of each, at least 0; NULL: equal */
  /* Set by rot_vary_begin(). */
  const double *cumulative; /* weights up to each value; NULL: equal */
  double from, span;        /* probabilities taken: from + span u */
  int upper;                /* they are counted from the upper end */
} rot_vary;

/* Checks a law and prepares it; memory from the store. ROT_EVALUE: parameters outside their
 * domains, or a truncation that leaves no probability. */
rot_status rot_vary_begin(rot_vary *law, rot_store *store);

/* Is the law one that takes a coordinate (not fixed, no column)? */
int rot_vary_varies(const rot_vary *law);

/* u[] in (0, 1) => values, in place; not for columns */
void rot_vary_quantiles(const rot_vary *law, size_t n, double u[]);

/* Standard normal scores => values, in place. The normal laws take them directly. */
void rot_vary_of_scores(const rot_vary *law, size_t n, double z[]);

/* u[] in (0, 1) => standard normal scores, in place */
void rot_scores(size_t n, double u[]);

#endif
