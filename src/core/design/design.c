#include "design/design.h"

#include <math.h>
#include <string.h>

static const char *const names[ROT_DESIGN_COUNT] = {
#define X(code, name) name,
    ROT_DESIGN_LIST(X)
#undef X
};

const char *rot_design_name(int kind) {
  return kind >= 0 && kind < ROT_DESIGN_COUNT ? names[kind] : NULL;
}

/* ---- preparation ---------------------------------------------------------------------------- */

static int fits(rot_design_kind kind, rot_vary_kind law) {
  if (law == ROT_VARY_FIXED) return kind != ROT_DESIGN_ROWS;
  if (kind == ROT_DESIGN_ROWS) return law == ROT_VARY_COLUMN;
  if (kind == ROT_DESIGN_GRID) return law == ROT_VARY_VALUES;
  return law != ROT_VARY_COLUMN;
}

static rot_status begin_laws(rot_design *d, rot_store *store) {
  d->n_varied = 0;
  d->varied = rot_store_get(store, d->n_inputs, sizeof *d->varied);
  if (!d->varied) return ROT_ENOMEM;
  for (size_t i = 0; i < d->n_inputs; i++) {
    const rot_status status = rot_vary_begin(&d->input[i], store);
    if (status != ROT_OK) return status;
    if (!fits(d->kind, d->input[i].kind)) return ROT_EVALUE;
    if (rot_vary_varies(&d->input[i])) d->varied[d->n_varied++] = i;
  }
  return ROT_OK;
}

/* Number of rows, and the strides of a grid. */
static rot_status count_rows(rot_design *d, rot_store *store) {
  d->n = 1;
  if (d->kind == ROT_DESIGN_ROWS) {
    d->n = d->input[0].n;
    for (size_t i = 1; i < d->n_inputs; i++)
      if (d->input[i].n != d->n) return ROT_EVALUE;
  } else if (d->kind == ROT_DESIGN_GRID) {
    d->stride = rot_store_get(store, d->n_inputs, sizeof *d->stride);
    if (!d->stride) return ROT_ENOMEM;
    for (size_t i = 0; i < d->n_inputs; i++) {
      const uint64_t levels = d->input[i].kind == ROT_VARY_VALUES ? d->input[i].n : 1;
      if (d->input[i].weight || levels > ROT_DESIGN_MAX_ROWS / d->n) return ROT_EVALUE;
      d->stride[i] = d->n;
      d->n *= levels;
    }
  } else {
    const uint64_t variants = d->kind == ROT_DESIGN_SALTELLI ? d->n_varied + 2 : 1;
    if (d->points > ROT_DESIGN_MAX_ROWS / variants) return ROT_EVALUE;
    d->n = d->points * variants;
  }
  return d->n > 0 && d->n <= ROT_DESIGN_MAX_ROWS ? ROT_OK : ROT_EVALUE;
}

static rot_status begin_coordinates(rot_design *d, rot_store *store) {
  const size_t dimensions = d->kind == ROT_DESIGN_SALTELLI ? 2 * d->n_varied : d->n_varied;
  if (d->kind == ROT_DESIGN_GRID || d->kind == ROT_DESIGN_ROWS) return ROT_OK;
  if (!d->seeded && d->kind != ROT_DESIGN_SOBOL) return ROT_EVALUE;
  if (d->kind == ROT_DESIGN_LATIN) {
    d->permutation = rot_store_get(store, dimensions + 1, sizeof *d->permutation);
    if (!d->permutation) return ROT_ENOMEM;
    for (size_t v = 0; v < dimensions; v++)
      rot_permutation_begin(&d->permutation[v], d->n, d->seed, (uint32_t)v,
                            ROT_STREAM_PERMUTATIONS);
  } else if (d->kind != ROT_DESIGN_RANDOM) {
    if (dimensions > ROT_SOBOL_DIMENSIONS) return ROT_EVALUE;
    d->sobol = rot_store_get(store, dimensions + 1, sizeof *d->sobol);
    if (!d->sobol) return ROT_ENOMEM;
    for (size_t v = 0; v < dimensions; v++)
      rot_sobol_begin(&d->sobol[v], v, d->seeded ? &d->seed : NULL);
  }
  return ROT_OK;
}

/* symmetric m x m matrix with ones on the diagonal => lower factor; returns 0 if the matrix is not
 * one, or not positive definite */
static int cholesky(size_t m, const double a[], double lower[]) {
  for (size_t i = 0; i < m; i++) {
    for (size_t j = 0; j <= i; j++) {
      double sum = a[i * m + j];
      if (!(fabs(sum) <= 1.0) || a[j * m + i] != sum || (i == j && sum != 1.0)) return 0;
      for (size_t k = 0; k < j; k++) sum -= lower[i * m + k] * lower[j * m + k];
      if (i == j && !(sum > 0.0)) return 0;
      lower[i * m + j] = i == j ? sqrt(sum) : sum / lower[j * m + j];
    }
  }
  return 1;
}

static rot_status begin_correlation(rot_design *d, rot_store *store) {
  const size_t m = d->n_correlated;
  if (m == 0) return ROT_OK;
  if (d->kind != ROT_DESIGN_RANDOM && d->kind != ROT_DESIGN_LATIN && d->kind != ROT_DESIGN_SOBOL)
    return ROT_EVALUE;
  for (size_t a = 0; a < m; a++) {
    if (d->correlated[a] >= d->n_inputs || (a && d->correlated[a] <= d->correlated[a - 1]) ||
        !rot_vary_varies(&d->input[d->correlated[a]]))
      return ROT_EVALUE;
  }
  d->factor = rot_store_get(store, m * m, sizeof *d->factor);
  if (!d->factor) return ROT_ENOMEM;
  return cholesky(m, d->correlation, d->factor) ? ROT_OK : ROT_EVALUE;
}

rot_status rot_design_begin(rot_design *d, rot_store *store) {
  if (!rot_design_name((int)d->kind) || d->n_inputs == 0) return ROT_EVALUE;
  rot_status status = begin_laws(d, store);
  if (status == ROT_OK) status = count_rows(d, store);
  if (status == ROT_OK) status = begin_coordinates(d, store);
  if (status == ROT_OK) status = begin_correlation(d, store);
  return status;
}

/* ---- rows ----------------------------------------------------------------------------------- */

/* Values of one input of a grid: each is repeated for `stride` rows. */
static void grid_column(const rot_vary *law, uint64_t stride, uint64_t first, size_t n,
                        double out[]) {
  uint64_t done = first % stride, level = first / stride % law->n;
  for (size_t i = 0; i < n; i++) {
    out[i] = law->x[level];
    if (++done < stride) continue;
    done = 0;
    if (++level == law->n) level = 0;
  }
}

/* Row j (d + 2) + k has coordinates of A (k = 0), of B (k = 1), or of A with that of B for input
 * k - 2. */
static void saltelli_column(const rot_design *d, size_t v, uint64_t first, size_t n, double u[]) {
  const uint64_t variants = d->n_varied + 2;
  uint64_t j = first / variants, k = first % variants;
  for (size_t i = 0; i < n;) {
    double a[ROT_SOBOL_NEAR], b[ROT_SOBOL_NEAR];
    const uint64_t left = (k + n - i + variants - 1) / variants;
    const size_t skip = (size_t)(j % ROT_SOBOL_NEAR);
    const size_t m = left < ROT_SOBOL_NEAR - skip ? (size_t)left : ROT_SOBOL_NEAR - skip;
    rot_sobol_column(&d->sobol[v], j, m, a);
    rot_sobol_column(&d->sobol[d->n_varied + v], j, m, b);
    for (size_t at = 0; at < m; at++, j++) {
      for (; k < variants && i < n; k++, i++) u[i] = k == 1 || k == v + 2 ? b[at] : a[at];
      if (k == variants) k = 0;
    }
  }
}

/* Coordinates of the inputs that take one. */
static void coordinates(const rot_design *d, uint64_t first, size_t n, double *const column[]) {
  for (size_t v = 0; v < d->n_varied; v++) {
    double *u = column[d->varied[v]];
    if (d->kind == ROT_DESIGN_SOBOL) rot_sobol_column(&d->sobol[v], first, n, u);
    if (d->kind == ROT_DESIGN_SALTELLI) saltelli_column(d, v, first, n, u);
    if (d->kind != ROT_DESIGN_RANDOM && d->kind != ROT_DESIGN_LATIN) continue;
    if (v % 2 == 0)
      rot_philox_columns(d->seed, first, n, (uint32_t)(v / 2), ROT_STREAM_INPUTS, u,
                         v + 1 < d->n_varied ? column[d->varied[v + 1]] : NULL);
    if (d->kind == ROT_DESIGN_LATIN) rot_latin_column(&d->permutation[v], first, n, u);
  }
}

/* Coordinates of the correlated inputs => correlated scores: from the last input to the first, as a
 * row of the factor refers to inputs before it. */
static void correlated_scores(const rot_design *d, size_t n, double *const column[]) {
  const size_t m = d->n_correlated;
  for (size_t a = 0; a < m; a++) rot_scores(n, column[d->correlated[a]]);
  for (size_t a = m; a-- > 0;) {
    const double *row = d->factor + a * m;
    double *z = column[d->correlated[a]];
    for (size_t i = 0; i < n; i++) z[i] *= row[a];
    for (size_t b = 0; b < a; b++) {
      const double *other = column[d->correlated[b]];
      for (size_t i = 0; i < n; i++) z[i] += row[b] * other[i];
    }
  }
}

rot_status rot_design_rows(const rot_design *d, uint64_t first, size_t n, double *const column[]) {
  if (first > d->n || n > d->n - first) return ROT_EVALUE;
  if (d->kind != ROT_DESIGN_GRID && d->kind != ROT_DESIGN_ROWS) coordinates(d, first, n, column);
  if (d->n_correlated) correlated_scores(d, n, column);
  size_t a = 0;
  for (size_t i = 0; i < d->n_inputs; i++) {
    const rot_vary *law = &d->input[i];
    const int is_score = a < d->n_correlated && d->correlated[a] == i;
    if (is_score) a++;
    if (law->kind == ROT_VARY_COLUMN) {
      memcpy(column[i], law->x + first, n * sizeof(double));
    } else if (d->kind == ROT_DESIGN_GRID && law->kind == ROT_VARY_VALUES) {
      grid_column(law, d->stride[i], first, n, column[i]);
    } else if (is_score) {
      rot_vary_of_scores(law, n, column[i]);
    } else {
      rot_vary_quantiles(law, n, column[i]);
    }
  }
  return ROT_OK;
}
