#include "maths/phi.h"

#include <math.h>
#include <string.h>

#include "ground/pair.h"

/* clang-format off */

/* n and n!, for n < 30. */
#define FACTORIALS(X) \
    X(0, 1.0) X(1, 1.0) X(2, 2.0) X(3, 6.0) X(4, 24.0) X(5, 120.0) X(6, 720.0) X(7, 5040.0) \
    X(8, 40320.0) X(9, 362880.0) X(10, 3628800.0) X(11, 39916800.0) X(12, 479001600.0) \
    X(13, 6227020800.0) X(14, 87178291200.0) X(15, 1307674368000.0) X(16, 20922789888000.0) \
    X(17, 355687428096000.0) X(18, 6402373705728000.0) X(19, 121645100408832000.0) \
    X(20, 2432902008176640000.0) X(21, 51090942171709440000.0) X(22, 1124000727777607680000.0) \
    X(23, 2.585201673888498e+22) X(24, 6.204484017332394e+23) X(25, 1.5511210043330986e+25) \
    X(26, 4.0329146112660565e+26) X(27, 1.0888869450418352e+28) X(28, 3.0488834461171387e+29) \
    X(29, 8.841761993739702e+30)

const double rot_inverse_factorial[46] = {
#define X(n, factorial) 1 / factorial,
    FACTORIALS(X)
#undef X
    1 / 2.6525285981219107e+32, 1 / 8.222838654177922e+33, 1 / 2.631308369336935e+35,
    1 / 8.683317618811886e+36, 1 / 2.9523279903960416e+38, 1 / 1.0333147966386145e+40,
    1 / 3.7199332678990125e+41, 1 / 1.3763753091226346e+43, 1 / 5.230226174666011e+44,
    1 / 2.0397882081197444e+46, 1 / 8.159152832478977e+47, 1 / 3.345252661316381e+49,
    1 / 1.40500611775288e+51, 1 / 6.041526306337383e+52, 1 / 2.658271574788449e+54,
    1 / 1.1962222086548019e+56,
};

/* 1/(j! (j + 2)) and 1/(j! (j + 3)), to avoid divisions in the loop. */
static const double kummer_2[] = {
#define X(n, factorial) 1 / factorial / (n + 2),
    FACTORIALS(X)
#undef X
};
static const double kummer_3[] = {
#define X(n, factorial) 1 / factorial / (n + 3),
    FACTORIALS(X)
#undef X
};

/* clang-format on */

/* phi_k(-z) by its Taylor series sum (-z)^j / (j+k)!, to 2^-54 at |z| = 0.5 (13 terms) and at 6
 * (39 terms). */
static double taylor(double z, int k) {
  int terms = fabs(z) <= 0.5 ? 13 : 39;
  double s = rot_inverse_factorial[k + terms];
  for (int j = terms - 1; j >= 0; j--) s = s * -z + rot_inverse_factorial[k + j];
  return s;
}

/* Kummer's form, all terms positive: phi_k = exp(-z)/(k-1)! sum_j (z^j/j!)/(j+k). For z < 4 the
 * recurrences in both directions lose digits; error here: 2.9 ulp. */
static void kummer(double z, double e, int k_max, double phi[]) {
  enum { TERMS = 40 };
  double t[TERMS];
  t[0] = 1.0;
  for (int j = 1; j < TERMS; j++) t[j] = t[j - 1] * z / j;
  for (int k = 2; k <= k_max; k++) {
    double s = 0.0;
    for (int j = TERMS - 1; j >= 0; j--) s += t[j] / (j + k);
    phi[k] = e * s * rot_inverse_factorial[k - 1];
  }
}

void rot_phi(double z, double z_lo, int k_max, double phi[]) {
  double e = exp(-z);
  phi[0] = isfinite(e) ? e - e * z_lo : e;
  if (k_max < 1) return;
  if (!(z > -INFINITY)) { /* phi_k(+Inf) = +Inf; NaN stays */
    for (int k = 1; k <= k_max; k++) phi[k] = e;
    return;
  }
  phi[1] = z != 0.0 ? -expm1(-z) / z : 1.0;
  if (z >= 4.0 || z <= -6.0) {
    for (int k = 1; k < k_max; k++) phi[k + 1] = (rot_inverse_factorial[k] - phi[k]) / z;
    if (z <= -6.0 && isfinite(e)) {
      /* phi_k and the effect of the residual grow as exp(-z)/(-z)^k. */
      for (int k = 1; k <= k_max; k++) phi[k] -= phi[k] * z_lo * (1.0 + k / z);
    }
  } else if (z >= 0.5) {
    kummer(z, e, k_max, phi);
  } else if (k_max > 1) {
    phi[k_max] = taylor(z, k_max);
    for (int k = k_max - 1; k >= 2; k--) phi[k] = fma(-z, phi[k + 1], rot_inverse_factorial[k]);
  }
}

/* ---- high orders ---------------------------------------------------------------------------- */

/* phi_k = (1/k!) (1 - z/(k+1) (1 - z/(k+2) (1 - ...))) */
static double nested(double z, int k) {
  int terms = 0;
  for (double last = 1.0; last > 0x1p-57;) last *= fabs(z) / (k + ++terms);
  double s = 1.0;
  for (int j = terms; j >= 1; j--) s = fma(-(z / (k + j)), s, 1.0);
  return rot_inverse_factorial[k] * s;
}

/* phi_1 .. phi_k_max for z >= 0. The upward recurrence phi_(k+1) = (1/k! - phi_k)/z amplifies an
 * error by k/z, the downward one by about z/k: upward for k < z; downward above, from an order at
 * which the alternating series does not cancel. */
static void phi_high_damped(double z, int k_max, double phi[]) {
  const int middle = z < k_max ? (int)z + 1 : k_max;
  for (int k = 1; k < middle; k++) phi[k + 1] = (rot_inverse_factorial[k] - phi[k]) / z;
  if (middle >= k_max) return;
  int k = (int)(2.0 * z) + 2;
  if (k < k_max) k = k_max;
  double value = nested(z, k);
  if (k == k_max) phi[k] = value;
  while (--k > middle) {
    value = fma(-z, value, rot_inverse_factorial[k]);
    if (k <= k_max) phi[k] = value;
  }
}

/* The same for z < 0. Downward, all terms are positive. Upward, the first terms of the exponential
 * are subtracted from it; for -z >= k + 6 they are less than a twentieth of it. */
static void phi_high_driven(double z, double z_lo, int k_max, double phi[]) {
  double all[ROT_PHI_HIGH + 2];
  all[1] = phi[1];
  if (z <= -(k_max + 6.0)) {
    for (int k = 1; k <= k_max; k++) all[k + 1] = (rot_inverse_factorial[k] - all[k]) / z;
  } else {
    all[k_max + 1] = nested(z, k_max + 1);
    for (int k = k_max; k >= 1; k--) all[k] = fma(-z, all[k + 1], rot_inverse_factorial[k]);
  }
  /* d/dz phi_k(-z) = k phi_(k+1) - phi_k */
  for (int k = 1; k <= k_max; k++) {
    phi[k] = isfinite(all[k]) ? all[k] - z_lo * (all[k] - k * all[k + 1]) : all[k];
  }
}

void rot_phi_high(double z, double z_lo, int k_max, double phi[]) {
  if (k_max <= ROT_PHI_MAX && !(z < 0.0)) {
    rot_phi(z, z_lo, k_max, phi);
    return;
  }
  rot_phi(z, z_lo, 0, phi);
  if (k_max < 1) return;
  phi[1] = z != 0.0 ? -expm1(-z) / z : 1.0;
  if (z >= 0.0) {
    phi_high_damped(z, k_max, phi);
  } else if (z > -INFINITY) {
    phi_high_driven(z, z_lo, k_max, phi);
  } else { /* phi_k(+Inf) = +Inf; NaN stays */
    for (int k = 1; k <= k_max; k++) phi[k] = phi[0];
  }
}

double rot_phi_g1(double z, double phi0, double phi1) {
  if (fabs(z) >= 1.0) return (phi1 - phi0) / z;
  double s = rot_inverse_factorial[20];
  for (int j = 17; j >= 0; j--) s = s * z + rot_inverse_factorial[j + 2];
  return phi0 * s;
}

/* phi_1 = exp(-z) (1 + z G), g1 = exp(-z) G, phi_2 = exp(-z) A2, phi_3 = exp(-z) A3 / 2 with
 *   G = sum z^j/(j+2)!,   A_k = sum (z^j/j!)/(j+k):
 * polynomials with positive terms only. The degree needed for 2^-54 grows with z. */
static int degree_for(double z) { return z <= 0.03 ? 8 : z <= 0.25 ? 13 : z <= 1.0 ? 19 : 29; }

void rot_phi_in_lanes(const double z[ROT_LANES], const double z_lo[ROT_LANES], rot_phi_lanes *out) {
  double z_max = z[0], g[ROT_LANES], a2[ROT_LANES], a3[ROT_LANES];
  for (int l = 1; l < ROT_LANES; l++) z_max = z[l] > z_max ? z[l] : z_max;
  enum { HALF = ROT_LANES / 2, PAIRS = HALF / ROT_PAIR };
  const int degree = degree_for(z_max);
  for (int l = 0; l < ROT_LANES; l += HALF) { /* half of the lanes fit in the registers */
    rot_pair zs[PAIRS], gs[PAIRS], a2s[PAIRS], a3s[PAIRS];
    memcpy(zs, z + l, sizeof zs);
    for (int i = 0; i < PAIRS; i++) gs[i] = a2s[i] = a3s[i] = ROT_BOTH(0.0);
    for (int j = degree; j >= 0; j--) {
      for (int i = 0; i < PAIRS; i++) {
        gs[i] = gs[i] * zs[i] + ROT_BOTH(rot_inverse_factorial[j + 2]);
        a2s[i] = a2s[i] * zs[i] + ROT_BOTH(kummer_2[j]);
        a3s[i] = a3s[i] * zs[i] + ROT_BOTH(kummer_3[j]);
      }
    }
    memcpy(g + l, gs, sizeof gs);
    memcpy(a2 + l, a2s, sizeof a2s);
    memcpy(a3 + l, a3s, sizeof a3s);
  }
  for (int l = 0; l < ROT_LANES; l++) {
    double e = exp(-z[l]);
    e -= e * z_lo[l];
    out->phi0[l] = e;
    out->phi1[l] = e * (1.0 + z[l] * g[l]);
    out->g1[l] = e * g[l];
    out->phi2[l] = e * a2[l];
    out->phi3[l] = 0.5 * e * a3[l];
  }
}
