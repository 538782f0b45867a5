/* One step of the extrapolated midpoint rule (Gragg, Bulirsch, Stoer) in quadruple precision: with
 * it the coverage programs compute true motions from the equations alone. */
#ifndef COVERAGE_MIDPOINT_H
#define COVERAGE_MIDPOINT_H

#include <math.h>
#include <quadmath.h>

typedef __float128 quad;

enum { MIDPOINT_MOST = 64 }; /* components, and rows of the table */

typedef struct midpoint {
  void (*slopes)(const void *system, quad t, const quad y[], quad f[]);
  int n;         /* components */
  int levels;    /* rows of the table at most */
  double enough; /* no further row once two agree so well; 0: all rows */
} midpoint;

/* `out` may be `y`. Returns how far the last two rows are apart, each component relative to its
 * size: the largest of size[i] (NULL: 0), of y[i] and of the result. */
static inline double midpoint_step(const midpoint *m, const void *system, quad t, quad h,
                                   const quad y[], const quad size[], quad out[]) {
  quad table[MIDPOINT_MOST][MIDPOINT_MOST], start[MIDPOINT_MOST];
  double error = INFINITY;
  for (int i = 0; i < m->n; i++) start[i] = y[i];
  for (int k = 0; k < m->levels && !(k > 3 && error < m->enough); k++) {
    const int parts = 2 * (k + 1);
    const quad d = h / parts;
    quad a[MIDPOINT_MOST], b[MIDPOINT_MOST], f[MIDPOINT_MOST];
    m->slopes(system, t, start, f);
    for (int i = 0; i < m->n; i++) {
      a[i] = start[i];
      b[i] = a[i] + d * f[i];
    }
    for (int j = 1; j < parts; j++) {
      m->slopes(system, t + j * d, b, f);
      for (int i = 0; i < m->n; i++) {
        const quad next = a[i] + 2 * d * f[i];
        a[i] = b[i];
        b[i] = next;
      }
    }
    m->slopes(system, t + h, b, f);
    error = k ? 0.0 : INFINITY;
    for (int i = 0; i < m->n; i++) {
      quad carry = (a[i] + b[i] + d * f[i]) / 2;
      for (int j = 1; j <= k; j++) {
        const int p = 2 * (k - j + 1);
        const quad old = table[j - 1][i];
        table[j - 1][i] = carry;
        carry += (carry - old) / ((quad)(parts * parts) / (p * p) - 1);
      }
      table[k][i] = out[i] = carry;
      quad scale = fmaxq(fabsq(start[i]), fabsq(carry));
      if (size) scale = fmaxq(scale, size[i]);
      if (k && scale > 0) error = fmax(error, (double)(fabsq(carry - table[k - 1][i]) / scale));
    }
  }
  return error;
}

#endif
