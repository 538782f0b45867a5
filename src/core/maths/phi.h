/* The phi functions of exponential integrators, used in every closed form with linear drag:
 *
 *   phi_0(-z) = exp(-z),   phi_k(-z) = int_0^1 exp(-(1-s) z) s^(k-1)/(k-1)! ds   for k >= 1.
 *
 * Reference: Hochbruck & Ostermann, Acta Numerica 19 (2010), section 2.1. */
#ifndef ROT_PHI_H
#define ROT_PHI_H

#include "ground/ieee.h"

#define ROT_PHI_MAX 6

/* z + z_lo => phi[0..k_max] of -(z + z_lo), k_max <= ROT_PHI_MAX; z_lo is used in phi_0, and in the
 * others for z <= -6. Any z, +-Inf and NaN included. Max error: 3 ulp for k <= 4, 4 ulp for
 * k = 5, 6. */
void rot_phi(double z, double z_lo, int k_max, double phi[]);

#define ROT_PHI_HIGH 18

/* The same for k_max <= ROT_PHI_HIGH; z_lo is used in every k for z < 0. Max error: 4 ulp (z >= 0),
 * 5 ulp (z < 0). Equal to rot_phi() for k_max <= ROT_PHI_MAX and z >= 0. */
void rot_phi_high(double z, double z_lo, int k_max, double phi[]);

/* (z, its phi_0 and phi_1) => int_0^1 exp(-z y) y dy = phi_1 - phi_2, without cancellation */
double rot_phi_g1(double z, double phi0, double phi1);

#define ROT_LANES 8

/* Weights of linear-torque steps in lanes; phi0 = exp(-z), g1 from rot_phi_g1(). */
typedef struct rot_phi_lanes {
  double phi0[ROT_LANES], phi1[ROT_LANES], g1[ROT_LANES], phi2[ROT_LANES], phi3[ROT_LANES];
} rot_phi_lanes;

/* 1/n! for n <= 45. */
extern const double rot_inverse_factorial[46];

/* z + z_lo, 0 <= z < 3, in each lane => weights */
void rot_phi_in_lanes(const double z[ROT_LANES], const double z_lo[ROT_LANES], rot_phi_lanes *out);

#endif
