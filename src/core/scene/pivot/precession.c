#include "scene/pivot/precession.h"

#include <math.h>

#include "ground/real.h"
#include "scene/pivot/top_motion.h"

static const double pi = 0x1.921fb54442d18p+1;

/* Error of the formula, (slow - formula)/formula: x = e/(1 + sqrt(1 - e))^2 with e = 4 I1 G cos/(I3
 * omega3)^2; NaN without a steady precession, e > 1. Relative to the slow rate it is x/(1 + x). */
static double formula_error(double i1, double weight, double cosine, double momentum) {
  if (cosine == 0.0 || weight == 0.0) return 0.0;
  const double e = 4.0 * (i1 / momentum) * (weight / momentum) * cosine;
  const double s = 1.0 + sqrt(1.0 - e), x = e / (s * s);
  return fabs(x / (1.0 + x));
}

/* Limits within rounding: of a top whose spin does not act; of one whose axis moves in proportion
 * to its angle. */
#define SLOW      1e-30
#define SMALL_DEG 1e-20

/* A vertical top stays; its period is that of a small nutation. A hanging one is computed as an
 * upright one whose axis, spin and lever are reversed, with the same rates. */
static void release(const rot_precession_input *in, double weight, int vertical,
                    rot_precession *out) {
  const double flip = vertical && in->angle_deg > 90.0 ? -1.0 : 1.0;
  const double i1 = in->transverse_kg_m2, pendulum = sqrt(fabs(weight) / i1);
  const double spin = copysign(fmax(fabs(in->spin_rad_per_s), SLOW * pendulum), in->spin_rad_per_s);
  const double nutation = in->axial_kg_m2 * fabs(spin) / i1; /* of a fast top */
  const int sleeps = weight < 0.0 || nutation > 2.0 * pendulum;
  const int small = sleeps && in->angle_deg < SMALL_DEG;
  const double angle_deg = small ? SMALL_DEG : in->angle_deg;
  const double theta = vertical ? 0.0 : angle_deg * (pi / 180.0);
  rot_top_start start;
  rot_top_motion motion;
  rot_top_from_euler(0.0, theta, 0.0, 0.0, 0.0, flip * spin, &start);
  const rot_status status = rot_top_begin(i1, in->axial_kg_m2, flip * weight, &start, 0.0, &motion);
  if (status == ROT_ERANGE) { /* limits for a fast spin */
    out->nutation_s = 2.0 * pi / fabs(in->spin_rad_per_s) / in->axial_kg_m2 * i1;
    out->lowest_deg = in->angle_deg;
    out->mean_rad_per_s = out->rate_rad_per_s;
  }
  if (status != ROT_OK) return;
  const rot_top_nutation n = rot_top_nutates(&motion);
  out->nutation_s = n.period_s;
  out->lowest_deg =
      vertical ? in->angle_deg : n.lowest_rad * (180.0 / pi) * (in->angle_deg / angle_deg);
  out->mean_rad_per_s = n.precession_rad_per_s;
}

/* Formula, steady rates, and nutation of a release from rest if the transverse moment is known. */
rot_precession rot_precession_of(const rot_precession_input *in) {
  rot_precession out = {NAN, NAN, NAN, NAN, NAN, NAN, NAN, NAN, NAN, NAN};
  const double cosine = rot_sin_deg(90.0 - fabs(in->angle_deg));
  const double sine = rot_sin_deg(in->angle_deg);
  const double factors[] = {in->mass_kg, in->gravity_m_per_s2, in->lever_arm_m};
  const double weight = rot_product(3, factors, 1.0);
  const double momentum = in->axial_kg_m2 * in->spin_rad_per_s;
  out.torque_n_m = weight * sine;
  out.momentum_kg_m2_per_s = momentum;
  out.rate_rad_per_s = weight / in->axial_kg_m2 / in->spin_rad_per_s;
  out.period_s = fabs(2.0 * pi / out.rate_rad_per_s);
  if (cosine == 0.0) { /* the formula is exact for any transverse moment */
    out.slow_rad_per_s = out.rate_rad_per_s;
    out.error = 0.0;
  }
  if (isnan(in->transverse_kg_m2)) return out;
  rot_top_steady(in->transverse_kg_m2, in->axial_kg_m2, weight, cosine, in->spin_rad_per_s,
                 &out.slow_rad_per_s, &out.fast_rad_per_s);
  out.error = formula_error(in->transverse_kg_m2, weight, cosine, momentum);
  release(in, weight, sine == 0.0, &out);
  return out;
}

double rot_precession_sleeps(double i3, double i1, double mass, double lever, double gravity) {
  const double factors[] = {mass, gravity, lever};
  const double weight = rot_product(3, factors, 1.0);
  return 2.0 * (sqrt(i1) / i3) * sqrt(fmax(weight, 0.0));
}
