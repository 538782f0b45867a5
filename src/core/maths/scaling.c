#include "maths/scaling.h"

#include <math.h>

#include "ground/ieee.h"

enum { MAX_SWEEPS = 20 };

void rot_scaling_of(size_t n, const double a[], double by[]) {
  for (size_t i = 0; i < n; i++) by[i] = 1.0;
  for (int sweep = 0, changed = 1; changed && sweep < MAX_SWEEPS; sweep++) {
    changed = 0;
    for (size_t i = 0; i < n; i++) {
      double row = 0.0, column = 0.0;
      for (size_t j = 0; j < n; j++) {
        if (j == i) continue;
        row = fmax(row, fabs(a[i * n + j]) * (by[j] / by[i]));
        column = fmax(column, fabs(a[j * n + i]) * (by[i] / by[j]));
      }
      if (!(row > 0.0 && column > 0.0 && isfinite(row) && isfinite(column))) continue;
      const int power = (ilogb(row) - ilogb(column)) / 2;
      if (power == 0) continue;
      by[i] = ldexp(by[i], power);
      changed = 1;
    }
  }
}

double rot_scaling_largest(size_t n, const double a[], const double by[]) {
  double max = 0.0;
  for (size_t i = 0; i < n; i++) {
    for (size_t j = 0; j < n; j++) max = fmax(max, fabs(a[i * n + j]) * (by[j] / by[i]));
  }
  return max;
}

void rot_scaling_apply(size_t n, double a[], const double by[]) {
  for (size_t i = 0; i < n; i++) {
    for (size_t j = 0; j < n; j++) a[i * n + j] *= by[j] / by[i];
  }
}

void rot_scaling_undo(size_t n, double a[], const double by[]) {
  for (size_t i = 0; i < n; i++) {
    for (size_t j = 0; j < n; j++) a[i * n + j] *= by[i] / by[j];
  }
}
