/* The damped oscillator  I y'' + c y' + k y = 0, k > 0, c of any sign: what a step of any length
 * needs. With psi_1 the answer in y to a unit of y' at the start of the step,
 *
 *   psi_0 = psi_1',   psi_2 = int psi_1,   psi_3 = int psi_2,   u = 1 - (k/I) psi_2,
 *
 *   y  = u y0           + psi_1 y0' + psi_2 a + psi_3 b     under the acceleration a + b s,
 *   y' = -(k/I) psi_1 y0 + psi_0 y0' + psi_1 a + psi_2 b.
 *
 * They are divided differences of the exponential over the roots l1, l2 of I l^2 + c l + k:
 * psi_1 = s exp[l1 s, l2 s], psi_2 = s^2 exp[l1 s, l2 s, 0], ...; and the answer to a wave
 * exp(i Omega s) is s^2 exp[l1 s, l2 s, i Omega s]. */
#ifndef ROT_OSCILLATOR_H
#define ROT_OSCILLATOR_H

#include "ground/dd.h"
#include "ground/status.h"

typedef struct rot_complex {
  double re, im;
} rot_complex;

/* Rates are per unit of time 2^exponent s; in that unit none is above 2, and the largest of them
 * not below 1/4. */
typedef struct rot_oscillator {
  double inertia, damping, stiffness;
  int exponent;
  int regime;       /* 1 under-, 0 critically, -1 overdamped */
  rot_dd half_rate; /* c/(2 I) */
  rot_dd stiff;     /* k/I */
  rot_dd split;     /* sqrt |k/I - (c/(2 I))^2|: angular frequency, or half the distance of roots */
  rot_dd slow, fast; /* overdamped: the roots by size, as positive numbers */
  double omega0;     /* sqrt(k/I) */
} rot_oscillator;

/* ROT_ERANGE where no unit of time holds both rates: c^2/(k I) above 1e280, or a rate outside
 * 1e-300 .. 1e300 per second. */
rot_status rot_oscillator_begin(double inertia, double damping, double stiffness,
                                rot_oscillator *out);

/* One step. All for |s| in the unit of time and, for s < 0, for the reversed motion. */
typedef struct rot_oscillator_step {
  const rot_oscillator *of;
  int backward;         /* s < 0: psi_1 and psi_3 below are odd in s and carry their sign */
  rot_dd s;             /* |s| */
  double damped;        /* half_rate |s|, < 0 where the motion grows */
  rot_dd phase;         /* split |s| */
  rot_dd slow, fast;    /* overdamped: roots |s| by size */
  double decay;         /* exp(-damped) */
  double cosine, sine;  /* underdamped: of the phase */
  double u, psi0, psi1; /* in the unit of time */
  double first;         /* psi_1 / s */
  double second, third; /* psi_2 / s^2, psi_3 / s^3; only where `early` */
  int early;            /* the step is short against the slow time: 1 - u may lose its digits */
  int near_roots;       /* both |roots s| are of order 1 at most */
  /* Sums of the terms of u, psi_0, psi_1: their roundings are 8 units of these; and the errors of a
   * phase of that size. */
  double u_size, psi0_size, u_phase, psi1_phase;
  double norm; /* of the step in (y omega0, y') */
} rot_oscillator_step;

/* s seconds. */
void rot_oscillator_at(const rot_oscillator *of, rot_dd s, rot_oscillator_step *out);

/* Answer to the acceleration exp(i Omega s), from rest: y = s^2 *y, y' = s *v, s in seconds and
 * signed. omega >= 0 in rad/s. Not for the far field, where the caller uses the steady answer: then
 * 0 is returned. *y_size, *v_size: sums of terms. */
int rot_oscillator_wave(const rot_oscillator_step *step, double omega, rot_complex *y,
                        rot_complex *v, double *y_size, double *v_size);

/* The steady answer to it, y = *steady exp(i Omega s), in s^2: times 4^exponent still. */
rot_complex rot_oscillator_steady(const rot_oscillator *of, double omega);

#endif
