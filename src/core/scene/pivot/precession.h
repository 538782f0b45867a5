/* Precession of a top or gyroscope: fast-top formula, steady precession, nutation after a release
 * from rest.
 *
 * Reference: Goldstein, Poole & Safko 2002, section 5.7. */
#ifndef ROT_PRECESSION_H
#define ROT_PRECESSION_H

#include "ground/ieee.h"

typedef struct rot_precession_input {
  double mass_kg;
  double lever_arm_m; /* fixed point to centre of mass */
  double axial_kg_m2;
  double spin_rad_per_s;
  double transverse_kg_m2; /* about the fixed point; NaN: unknown */
  double angle_deg;        /* of the axis from the vertical */
  double gravity_m_per_s2;
} rot_precession_input;

typedef struct rot_precession {
  double torque_n_m;                     /* of gravity */
  double momentum_kg_m2_per_s;           /* of the spin */
  double rate_rad_per_s, period_s;       /* fast-top formula m g l/(I3 omega3) */
  double slow_rad_per_s, fast_rad_per_s; /* steady precession; NaN: none */
  double error; /* of the formula, relative to the slow rate; NaN: unknown */
  /* After a release from rest. */
  double nutation_s;     /* period */
  double lowest_deg;     /* largest angle */
  double mean_rad_per_s; /* mean precession */
} rot_precession;

/* input => precession; NaN where a value is unknown. */
rot_precession rot_precession_of(const rot_precession_input *in);

/* => smallest spin of a stable upright top, 2 sqrt(I1 m g l)/I3. */
double rot_precession_sleeps(double axial_kg_m2, double transverse_kg_m2, double mass_kg,
                             double lever_arm_m, double gravity_m_per_s2);

#endif
