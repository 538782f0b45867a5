#include "maths/divided.h"

#include <math.h>

#include "maths/phi.h"
#include "ground/real.h"

void rot_sin_cos(double x, double x_lo, double *sine, double *cosine) {
  const double s = sin(x), c = cos(x);
  double sl = x_lo, cl = 1.0;
  if (fabs(x_lo) > 0x1p-28) { /* above x = 1e8 the second order counts */
    sl = sin(x_lo);
    cl = cos(x_lo);
  }
  *sine = fma(s, cl, c * sl);
  *cosine = fma(c, cl, -(s * sl));
}

double rot_exp_split(double x, double x_lo, int *exponent) {
  *exponent = 0;
  if (fabs(x) < 700.0) {
    const double e = exp(x);
    return e + e * x_lo;
  }
  if (!(fabs(x) < 7e5)) return exp(x); /* 0, Inf or NaN */
  /* ln 2 in two parts; the first has 33 bits: its product with k < 2^20 is exact. */
  const double k = rint(x * 1.4426950408889634);
  const double rest = (x - k * 0x1.62e42feep-1) + (x_lo - k * 0x1.a39ef35793c76p-33);
  *exponent = (int)k;
  return exp(rest);
}

/* x => (x - sin x)/x^3 for |x| <= 2, to rounding */
static double sine_gap(double x) {
  double s = 0.0;
  for (int n = 25; n >= 3; n -= 2) s = fma(-(x * x), s, rot_inverse_factorial[n]);
  return s;
}

/* (z, phi_1(-z)) => phi_2(-z) for |z| <= 2 */
static double phi_2(double z, double phi1) {
  if (z > 1.0) return (1.0 - phi1) / z;
  double s = 0.0;
  for (int n = fabs(z) <= 0.1 ? 11 : 25; n >= 2; n--) s = fma(-z, s, rot_inverse_factorial[n]);
  return s;
}

/* Element i of the wave: (re + i im)/(zr + i yr), where max(|zr|, |yr|) = 1. */
static void divide(rot_divided_wave *wave, int i, double re, double im, double size, double zr,
                   double yr) {
  const double d = zr * zr + yr * yr;
  wave->re[i] = (re * zr + im * yr) / d;
  wave->im[i] = (im * zr - re * yr) / d;
  wave->size[i] = size / sqrt(d);
}

/* exp[-z, iy]    = (exp(iy) - exp(-z))/(z + iy)
 * exp[0, -z, iy] = (phi_1(iy) - phi_1(-z))/(z + iy)
 *                = (z phi_2(-z) - y^2 (y - sin y)/y^3 + i (1 - cos y)/y)/(z + iy),
 *
 * the last form for small z and y, where the difference of the phi_1 cancels. */
rot_divided_wave rot_divided_wave_at(double z, double z_lo, double y, double y_lo,
                                     double y_over_z) {
  rot_divided_wave wave;
  double zr = 1.0, yr = 0.0, sh, ch;
  if (fabs(y_over_z) <= 1.0) {
    yr = y_over_z;
  } else if (y != 0.0) {
    yr = 1.0;
    zr = 1.0 / y_over_z;
  }
  const int by_z = yr != 1.0 || fabs(y_over_z) <= 1.0;
  rot_sin_cos(0.5 * y, 0.5 * y_lo, &sh, &ch);
  const double gone = z < INFINITY ? exp(-z) * z_lo - expm1(-z) : 1.0;
  const double phi1 = z == 0.0 ? 1.0 : (fabs(z) <= 2.0 ? -expm1(-z) : gone) / z;
  /* (sin y)/y and (1 - cos y)/y through the half angle, so that y^2 may underflow. */
  const double half_sinc = fabs(y) > 1e-100 ? sh / (0.5 * y) : 1.0;
  const double sinc = half_sinc * ch, rise = half_sinc * sh;
  if (fabs(z) <= 2.0 && fabs(y) <= 2.0) {
    const double from_z = zr * phi_2(z, phi1), from_y = yr * (y * sine_gap(y));
    const double half = yr * (0.5 * half_sinc * half_sinc);
    wave.scale = 1.0;
    divide(&wave, 0, zr * phi1 - yr * rise, yr * sinc,
           fabs(zr) * phi1 + fabs(yr) * (fabs(rise) + fabs(sinc)), zr, yr);
    divide(&wave, 1, from_z - from_y, half, fabs(from_z) + fabs(from_y) + fabs(half), zr, yr);
  } else {
    const double fall = 2.0 * sh * sh, sine = 2.0 * sh * ch; /* 1 - cos y, sin y */
    wave.scale = by_z ? z : y;
    divide(&wave, 0, gone - fall, sine, fabs(gone) + fabs(fall) + fabs(sine), zr, yr);
    divide(&wave, 1, sinc - phi1, rise, fabs(sinc) + fabs(phi1) + fabs(rise), zr, yr);
  }
  return wave;
}

/* For p >= 3, (phi_1(-q) - exp(-q) phi_1(-r))/p loses a bit at most; below,
 * exp(-p) sum h_k(p, r)/(k+2)! with h_k = sum_j p^j r^(k-j), all terms positive. */
double rot_divided_decay(double p, double q, double r, double *scale) {
  *scale = 1.0;
  if (p >= 3.0) {
    const double far = q > 0.0 ? -expm1(-q) / q : 1.0, near = r > 0.0 ? -expm1(-r) / r : 1.0;
    *scale = p;
    return far - exp(-q) * near;
  }
  double sum = 0.5, power = 1.0, h = 1.0;
  for (int k = 1; k < 28; k++) {
    power *= p;
    h = fma(r, h, power);
    const double next = h * rot_inverse_factorial[k + 2];
    sum += next;
    if (!(next > 0x1p-56 * sum)) break;
  }
  return exp(-p) * sum;
}
