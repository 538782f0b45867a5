#include "maths/simplex.h"

#include <math.h>
#include <string.h>

enum { MAX = ROT_SIMPLEX_ROWS, MAX_STEPS = 5000, BLAND_AFTER = 300 };

/* Smaller pivots and reduced costs count as 0. Generated columns may differ by the square root of
 * it only; the inverse of a basis with two such columns loses as many digits. */
static const double small = 1e-11, small_generated = 1e-9;

typedef struct tableau {
  size_t basis[MAX];        /* a column, or lp->capacity + i: artificial column i */
  double sign[MAX];         /* of the artificial columns */
  double inverse[MAX][MAX]; /* of the basis */
  double x[MAX];            /* of the basis, >= 0 */
  double rhs[MAX];          /* perturbed by 1e-10, against cycling in degenerate steps */
} tableau;

static double dot(size_t m, const double a[], const double b[]) {
  double sum = 0.0;
  for (size_t i = 0; i < m; i++) sum += a[i] * b[i];
  return sum;
}

static void basis_column(const rot_simplex *lp, const tableau *t, size_t j, double to[MAX]) {
  memset(to, 0, MAX * sizeof *to);
  if (t->basis[j] >= lp->capacity) {
    const size_t i = t->basis[j] - lp->capacity;
    to[i] = t->sign[i];
  } else {
    memcpy(to, lp->column + t->basis[j] * lp->m, lp->m * sizeof *to);
  }
}

/* basis => inverse, x, by Gauss-Jordan with row pivoting; returns 0 for a singular basis */
static int invert(const rot_simplex *lp, tableau *t) {
  const size_t m = lp->m;
  double a[MAX][2 * MAX], column[MAX];
  memset(a, 0, sizeof a);
  for (size_t j = 0; j < m; j++) {
    basis_column(lp, t, j, column);
    for (size_t i = 0; i < m; i++) a[i][j] = column[i];
    a[j][m + j] = 1.0;
  }
  for (size_t j = 0; j < m; j++) {
    size_t p = j;
    for (size_t i = j + 1; i < m; i++)
      if (fabs(a[i][j]) > fabs(a[p][j])) p = i;
    if (!(fabs(a[p][j]) > 0.0)) return 0;
    for (size_t l = 0; l < 2 * m; l++) {
      const double swap = a[p][l];
      a[p][l] = a[j][l];
      a[j][l] = swap;
    }
    const double pivot = a[j][j];
    for (size_t l = 0; l < 2 * m; l++) a[j][l] /= pivot;
    for (size_t i = 0; i < m; i++) {
      const double factor = a[i][j];
      if (i == j || (factor >= 0.0 && factor <= 0.0)) continue;
      for (size_t l = 0; l < 2 * m; l++) a[i][l] -= factor * a[j][l];
    }
  }
  for (size_t i = 0; i < m; i++) {
    memcpy(t->inverse[i], a[i] + m, m * sizeof *a[i]);
    t->x[i] = dot(m, t->inverse[i], t->rhs);
    if (t->x[i] < 0.0) t->x[i] = 0.0; /* rounding: the ratio test keeps x >= 0 */
  }
  return 1;
}

static double basis_cost(const rot_simplex *lp, const tableau *t, size_t j, int phase) {
  if (t->basis[j] >= lp->capacity) return phase == 1 ? 1.0 : 0.0;
  return phase == 1 ? 0.0 : lp->cost[t->basis[j]];
}

static double reduced(const rot_simplex *lp, size_t j, int phase) {
  return (phase == 1 ? 0.0 : lp->cost[j]) - dot(lp->m, lp->dual, lp->column + j * lp->m);
}

/* => entering column, lp->n for none */
static size_t entering(rot_simplex *lp, int phase, int step) {
  size_t best = lp->n;
  const double enough = lp->price ? -small_generated : -small;
  double min = enough;
  for (size_t j = 0; j < lp->n; j++) {
    const double d = reduced(lp, j, phase);
    if (!(d < min)) continue;
    best = j;
    min = d;
    if (step > BLAND_AFTER) return best;
  }
  if (best < lp->n || !lp->price || lp->n == lp->capacity) return best;
  if (!lp->price(lp->ctx, lp->dual, phase, lp->column + lp->n * lp->m, lp->cost + lp->n))
    return best;
  if (reduced(lp, lp->n, phase) < enough) return lp->n++;
  return lp->n;
}

/* => max value of the entering column for which row i is >= 0, Inf for no limit. In phase 2 an
 * artificial column leaves immediately, so that it stays 0. */
static double ratio_of(const rot_simplex *lp, const tableau *t, const double u[], int phase,
                       size_t i) {
  if (phase == 2 && t->basis[i] >= lp->capacity && fabs(u[i]) > small) return 0.0;
  return u[i] > small ? t->x[i] / u[i] : INFINITY;
}

/* => leaving row, m for none. Among ties within rounding: the largest pivot or, after BLAND_AFTER
 * steps, the first column. */
static size_t leaving(const rot_simplex *lp, const tableau *t, const double u[], int phase,
                      int step) {
  double min = INFINITY;
  size_t best = lp->m;
  for (size_t i = 0; i < lp->m; i++) min = fmin(min, ratio_of(lp, t, u, phase, i));
  if (!(min < INFINITY)) return best;
  for (size_t i = 0; i < lp->m; i++) {
    if (!(ratio_of(lp, t, u, phase, i) <= min + 1e-13)) continue;
    if (best == lp->m ||
        (step > BLAND_AFTER ? t->basis[i] < t->basis[best] : fabs(u[i]) > fabs(u[best])))
      best = i;
  }
  return best;
}

/* Simplex steps of phase 1 (feasibility) or 2 (cost). */
static rot_simplex_result run_phase(rot_simplex *lp, tableau *t, int phase) {
  const size_t m = lp->m;
  for (int step = 0; step < MAX_STEPS; step++) {
    double u[MAX];
    if (!invert(lp, t)) return ROT_SIMPLEX_STOPPED;
    lp->value = 0.0;
    for (size_t j = 0; j < m; j++) lp->dual[j] = 0.0;
    for (size_t i = 0; i < m; i++) {
      const double cost = basis_cost(lp, t, i, phase);
      lp->value += cost * dot(m, t->inverse[i], lp->rhs);
      for (size_t j = 0; j < m; j++) lp->dual[j] += cost * t->inverse[i][j];
    }
    const size_t in = entering(lp, phase, step);
    if (in == lp->n) return ROT_SIMPLEX_OPTIMAL;
    for (size_t i = 0; i < m; i++) u[i] = dot(m, t->inverse[i], lp->column + in * m);
    const size_t out = leaving(lp, t, u, phase, step);
    if (out == m) return ROT_SIMPLEX_UNBOUNDED;
    t->basis[out] = in;
  }
  return ROT_SIMPLEX_STOPPED;
}

rot_simplex_result rot_simplex_solve(rot_simplex *lp) {
  tableau t;
  double largest = 0.0;
  for (size_t i = 0; i < lp->m; i++) largest = fmax(largest, fabs(lp->rhs[i]));
  for (size_t i = 0; i < lp->m; i++) {
    const double turn = 0.6180339887498949 * (double)(i + 1);
    t.rhs[i] = lp->rhs[i] + 1e-10 * (largest > 0.0 ? largest : 1.0) * (turn - floor(turn) + 0.5);
    t.basis[i] = lp->capacity + i;
    t.sign[i] = t.rhs[i] < 0.0 ? -1.0 : 1.0;
  }
  rot_simplex_result result = run_phase(lp, &t, 1);
  if (result == ROT_SIMPLEX_STOPPED) return result;
  if (!(lp->value <= lp->tolerance * largest)) return ROT_SIMPLEX_INFEASIBLE;
  return run_phase(lp, &t, 2);
}
