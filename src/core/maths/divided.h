/* Divided differences of the exponential, the kernel of the closed forms with sinusoidal and
 * exponential torque. With x_0, x_1, ... the nodes,
 *
 *   exp[a, b] = (exp(a) - exp(b))/(a - b),   exp[a, b, c] = (exp[a, b] - exp[a, c])/(b - c),
 *
 * with their limits for equal nodes. Arguments have residuals, so that large angles and exponents
 * are as accurate as small ones. Reference: McCurdy, Ng & Parlett, Math. Comp. 43 (1984). */
#ifndef ROT_DIVIDED_H
#define ROT_DIVIDED_H

#include "ground/ieee.h"

/* sin and cos of x + x_lo, for x_lo of any size. */
void rot_sin_cos(double x, double x_lo, double *sine, double *cosine);

/* exp(x + x_lo) = returned 2^exponent, also far outside the range of doubles. */
double rot_exp_split(double x, double x_lo, int *exponent);

/* exp[-z, iy] and exp[0, -z, iy], each (re + i im)/scale; scale is 1, z or y. `size`: the sum of
 * the absolute values of the terms of each, in the same scale. */
typedef struct rot_divided_wave {
  double re[2], im[2], size[2], scale;
} rot_divided_wave;

/* z and y with residuals, and y/z (infinite where z = 0; not read where both are 0), which is
 * defined for infinite z, too. y is finite. Error: 6 units of roundoff of the size, normwise. */
rot_divided_wave rot_divided_wave_at(double z, double z_lo, double y, double y_lo, double y_over_z);

/* exp[0, -q, -p] for p = q + r < Inf, q and r >= 0: returned/(*scale). 5 ulp for exact q and r. */
double rot_divided_decay(double p, double q, double r, double *scale);

#endif
