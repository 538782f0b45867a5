/* Divided differences of the exponential, the kernel of the closed forms with sinusoidal and
 * exponential torque. With x_0, x_1, ... the nodes,
 *
 *   exp[a, b] = (exp(a) - exp(b))/(a - b),   exp[a, b, c] = (exp[a, b] - exp[a, c])/(b - c),
 *
 * with their limits for equal nodes. Arguments have residuals, so results are as accurate for large
 * angles and exponents as for small ones. Reference: McCurdy, Ng & Parlett, Math. Comp. 43 (1984).
 */
#ifndef ROT_DIVIDED_H
#define ROT_DIVIDED_H

#include "ground/ieee.h"

/* x + x_lo => sine, cosine, for x_lo of any size */
void rot_sin_cos(double x, double x_lo, double *sine, double *cosine);

/* x + x_lo => m, exponent with exp(x + x_lo) = m 2^exponent, also beyond the range of doubles */
double rot_exp_split(double x, double x_lo, int *exponent);

/* exp[-z, iy] and exp[0, -z, iy], each (re + i im)/scale. */
typedef struct rot_divided_wave {
  double re[2], im[2];
  double size[2]; /* sum of the absolute values of the terms, in the same scale */
  double scale;   /* 1, z or y */
} rot_divided_wave;

/* (z, y, their residuals, y/z) => both divided differences. y is finite; y/z is infinite for z = 0,
 * unused if both are 0, and also defined for infinite z. Error: 6 units of roundoff of the size,
 * normwise. */
rot_divided_wave rot_divided_wave_at(double z, double z_lo, double y, double y_lo, double y_over_z);

/* (p = q + r < Inf, q >= 0, r >= 0) => exp[0, -q, -p] times *scale; 5 ulp for exact q and r */
double rot_divided_decay(double p, double q, double r, double *scale);

#endif
