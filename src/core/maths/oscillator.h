/* The damped oscillator  I y'' + c y' + k y = 0, k > 0, c of any sign: coefficients of a step of
 * any length. With psi_1 the response of y to a unit of y' at the start of the step,
 *
 *   psi_0 = psi_1',   psi_2 = int psi_1,   psi_3 = int psi_2,   u = 1 - (k/I) psi_2,
 *
 *   y  = u y0           + psi_1 y0' + psi_2 a + psi_3 b     under the acceleration a + b s,
 *   y' = -(k/I) psi_1 y0 + psi_0 y0' + psi_1 a + psi_2 b.
 *
 * They are divided differences of the exponential over the roots l1, l2 of I l^2 + c l + k:
 * psi_1 = s exp[l1 s, l2 s], psi_2 = s^2 exp[l1 s, l2 s, 0], ...; and the response to a wave
 * exp(i Omega s) is s^2 exp[l1 s, l2 s, i Omega s]. */
#ifndef ROT_OSCILLATOR_H
#define ROT_OSCILLATOR_H

#include "ground/dd.h"
#include "ground/status.h"

typedef struct rot_complex {
  double re, im;
} rot_complex;

/* Rates are per unit of time 2^exponent s, in which the largest rate is between 1/4 and 2. */
typedef struct rot_oscillator {
  double inertia;   /* kg m^2, > 0 */
  double damping;   /* N m s/rad, any sign */
  double stiffness; /* N m/rad, > 0 */
  int exponent;
  int regime;       /* 1 under-, 0 critically, -1 overdamped */
  rot_dd half_rate; /* c/(2 I) */
  rot_dd stiff;     /* k/I */
  rot_dd split;     /* sqrt |k/I - (c/(2 I))^2|: angular frequency, or half the distance of roots */
  rot_dd slow, fast; /* overdamped: absolute values of the roots, increasing */
  double omega0;     /* sqrt(k/I) */
} rot_oscillator;

/* (I, c, k) => constants. ROT_ERANGE if no unit of time fits both rates: c^2/(k I) above 1e280, or
 * a rate outside 1e-300 .. 1e300 per second. */
rot_status rot_oscillator_begin(double inertia, double damping, double stiffness,
                                rot_oscillator *out);

/* One step of length |s| in the unit of time; for s < 0, of the reversed motion. */
typedef struct rot_oscillator_step {
  const rot_oscillator *of;
  int backward;               /* 1: s < 0; psi_1 and psi_3 below are odd in s and have its sign */
  rot_dd s;                   /* |s| */
  double damped;              /* half_rate |s|; < 0: the motion grows */
  rot_dd phase;               /* split |s| */
  rot_dd slow, fast;          /* overdamped: |roots s|, increasing */
  double decay;               /* exp(-damped) */
  double cosine, sine;        /* underdamped: of the phase */
  double u, psi0, psi1;       /* in the unit of time */
  double first;               /* psi_1 / s */
  double second, third;       /* psi_2 / s^2, psi_3 / s^3; only if `early` */
  int early;                  /* 1: the step is short against the slow time, 1 - u may cancel */
  int near_roots;             /* 1: both |roots s| are of order 1 at most */
  double u_size, psi0_size;   /* sums of absolute terms; rounding errors are 8 units of them */
  double u_phase, psi1_phase; /* errors of u and psi_1 from the rounding of the phase */
  double norm;                /* of the step in (y omega0, y') */
} rot_oscillator_step;

/* (oscillator, s in seconds) => step */
void rot_oscillator_at(const rot_oscillator *of, rot_dd s, rot_oscillator_step *out);

/* (step, omega >= 0 in rad/s) => response from rest to the acceleration exp(i Omega s): y = s^2 *y,
 * y' = s *v, with s in seconds and signed. *y_size, *v_size: sums of absolute terms. Returns 0 far
 * from resonance, where the caller uses the steady response. */
int rot_oscillator_wave(const rot_oscillator_step *step, double omega, rot_complex *y,
                        rot_complex *v, double *y_size, double *v_size);

/* omega => amplitude of the steady response y = amplitude exp(i Omega s), in units of time:
 * multiply by 4^exponent for s^2 */
rot_complex rot_oscillator_steady(const rot_oscillator *of, double omega);

#endif
