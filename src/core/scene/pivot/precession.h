/* A top or gyroscope whose axis precesses: the fast-top formula, the steady motion, and the
 * nutation of one that is released.
 *
 * Reference: Goldstein, Poole & Safko 2002, section 5.7. */
#ifndef ROT_PRECESSION_H
#define ROT_PRECESSION_H

#include "ground/ieee.h"

typedef struct rot_precession_input {
  double mass_kg, lever_arm_m, axial_kg_m2, spin_rad_per_s, transverse_kg_m2, angle_deg,
      gravity_m_per_s2; /* transverse: about the fixed point, NaN where it is not known */
} rot_precession_input;

typedef struct rot_precession {
  double torque_n_m, momentum_kg_m2_per_s; /* of gravity; of the spin */
  double rate_rad_per_s, period_s;         /* m g l/(I3 omega3), as a formula */
  double slow_rad_per_s, fast_rad_per_s;   /* of steady precession; NaN: there is none */
  double error;      /* of the formula, relative to the slow one; NaN where that is not known */
  double nutation_s; /* of the top released from rest: its period, largest angle, mean rate */
  double lowest_deg, mean_rad_per_s;
} rot_precession;

rot_precession rot_precession_of(const rot_precession_input *in);

/* The least spin at which the top stands upright: 2 sqrt(I1 m g l)/I3. */
double rot_precession_sleeps(double axial_kg_m2, double transverse_kg_m2, double mass_kg,
                             double lever_arm_m, double gravity_m_per_s2);

#endif
