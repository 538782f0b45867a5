/* Units of the components of a linear map, powers of two: with component i counted in units of
 * by[i], row i and column i are about as large. Without them a motion in units of 2^-32 s has
 * entries of 2^64 beside ones: its exponential loses all digits in squarings.
 *
 * References: Osborne, J. ACM 7 (1960) 338; Parlett & Reinsch, Numer. Math. 13 (1969) 293. */
#ifndef ROT_SCALING_H
#define ROT_SCALING_H

#include <stddef.h>

/* a, n x n by rows => the units; 1 where a row or a column has nothing but its diagonal */
void rot_scaling_of(size_t n, const double a[], double by[]);

/* => the largest |a_ij| by_j/by_i */
double rot_scaling_largest(size_t n, const double a[], const double by[]);

/* a_ij => a_ij by_j/by_i, and back */
void rot_scaling_apply(size_t n, double a[], const double by[]);
void rot_scaling_undo(size_t n, double a[], const double by[]);

#endif
