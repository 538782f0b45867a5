#include "scene/axle/axle.h"

#include <math.h>

#include "maths/phi.h"
#include "ground/real.h"

/* With z = c s/I, the torque a at the start of the step and b at its end,
 *
 *   omega  = omega0 phi0 + (s a/I) g1 + (s b/I) phi2
 *   dtheta = s (omega0 phi1 + (s a/I)(phi2 - phi3) + (s b/I) phi3).
 *
 * All weights are positive: no cancellation under a torque of one sign. From z = 3 on, the same
 * terms are divided by c instead of I: they keep their digits where z^2 would overflow. */
double rot_axle_rounding(const rot_axle_params *p) {
  return (p->viscous_n_m_s >= 0.0 ? 12.0 : 24.0) * ROT_EPS;
}

rot_axle_state rot_axle_start(const rot_axle_params *p) {
  rot_axle_state state = {0};
  state.time_s = p->start_s;
  state.theta_rad = p->theta0_rad;
  state.omega_rad_per_s = p->omega0_rad_per_s;
  return state;
}

/* Terms of a step. */
typedef struct step_terms {
  double omega[3], theta[3]; /* from omega0, a, b */
  double decay, reach;       /* factors of an error of omega0: in omega, in theta */
} step_terms;

/* (state, terms) => state after the step, its bounds. */
static rot_axle_state add_terms(const rot_axle_params *p, const rot_axle_state *from,
                                const step_terms *terms, double time_s) {
  const double *w = terms->omega, *h = terms->theta;
  rot_axle_state to;
  double driven_lo, driven = rot_two_sum(w[1], w[2], &driven_lo);
  double turned = h[0] + (h[1] + h[2]);
  to.time_s = time_s;
  to.omega_rad_per_s = rot_two_sum(w[0], driven, &to.omega_lo);
  to.omega_lo += driven_lo + from->omega_lo * terms->decay;
  to.omega_rad_per_s = rot_two_sum(to.omega_rad_per_s, to.omega_lo, &to.omega_lo);
  to.theta_rad = rot_two_sum(from->theta_rad, turned, &to.theta_lo);
  to.theta_lo += from->theta_lo;
  to.theta_rad = rot_two_sum(to.theta_rad, to.theta_lo, &to.theta_lo);
  to.omega_error = from->omega_error * terms->decay +
                   rot_axle_rounding(p) * (fabs(w[0]) + fabs(w[1]) + fabs(w[2]));
  to.theta_error = from->theta_error + from->omega_error * terms->reach +
                   rot_axle_rounding(p) * (fabs(h[0]) + fabs(h[1]) + fabs(h[2])) +
                   ROT_EPS * fabs(to.theta_rad);
  return to;
}

/* Weights by phi functions (z < 3), or divided by c. */
rot_axle_state rot_axle_step(const rot_axle_params *p, const rot_axle_state *from,
                             const rot_torque_piece *piece, double time_s) {
  const double I = p->inertia_kg_m2, c = p->viscous_n_m_s, w0 = from->omega_rad_per_s;
  const double a = rot_torque_in_piece(piece, from->time_s), b = rot_torque_in_piece(piece, time_s);
  double s_lo, s = rot_two_sum(time_s, -from->time_s, &s_lo);
  if (s == 0.0 || (w0 == 0.0 && a == 0.0 && b == 0.0)) { /* stays at rest, also if exp(-z) is Inf */
    rot_axle_state same = *from;
    same.time_s = time_s;
    return same;
  }
  double phi[4], z_lo, z = rot_muldiv(c, s, I, &z_lo);
  if (isfinite(z)) z_lo += z * (s_lo / s);
  rot_phi(z, z_lo, 3, phi);
  step_terms terms;
  terms.omega[0] = w0 * phi[0];
  terms.decay = phi[0];
  if (z < 3.0) {
    const double g1 = rot_phi_g1(z, phi[0], phi[1]);
    terms.omega[1] = rot_product(3, (double[]){s, a, g1}, I);
    terms.omega[2] = rot_product(3, (double[]){s, b, phi[2]}, I);
    terms.theta[0] = rot_product(3, (double[]){s, w0, phi[1]}, 1.0);
    terms.theta[1] = rot_product(4, (double[]){s, s, a, phi[2] - phi[3]}, I);
    terms.theta[2] = rot_product(4, (double[]){s, s, b, phi[3]}, I);
    terms.reach = fabs(s) * phi[1];
  } else {
    const double settled = -expm1(-z);
    terms.omega[1] = rot_product(2, (double[]){a, phi[1] - phi[0]}, c);
    terms.omega[2] = rot_product(2, (double[]){b, 1.0 - phi[1]}, c);
    terms.theta[0] = rot_product(3, (double[]){w0, I, settled}, c);
    terms.theta[1] = rot_product(3, (double[]){s, a, 0.5 - phi[1] + phi[2]}, c);
    terms.theta[2] = rot_product(3, (double[]){s, b, 0.5 - phi[2]}, c);
    terms.reach = rot_product(2, (double[]){I, settled}, fabs(c));
  }
  return add_terms(p, from, &terms, time_s);
}
