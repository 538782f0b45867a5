#include "rot_axle_ledger.h"

#include <math.h>

#include "rot_phi.h"
#include "rot_real.h"

typedef struct running_sum {
  double hi, lo;
} running_sum;

static void add(running_sum *sum, double x) { rot_accumulate(&sum->hi, &sum->lo, x); }

/* int_0^1 omega(x)^2 dx of a step, in the unit of u0 (omega at its start), ua and ub (s torque/I at
 * its ends); *size is the same with every term positive. */
static double mean_square(double z, double u0, double ua, double ub, double *size) {
  if (!(fabs(z) <= 3.0)) {
    double phi[2];
    rot_phi(z, 0.0, 1, phi);
    const double g1 = rot_phi_g1(z, phi[0], phi[1]), twice = -expm1(-2.0 * z) / (2.0 * z);
    const double p1 = (ub - ua) / z, p0 = (ua - p1) / z, d = u0 - p0, pe = p0 + p1;
    *size = (p0 * p0 + fabs(p0 * pe) + pe * pe) / 3.0 +
            2.0 * fabs(d) * (fabs(p0) * phi[1] + fabs(p1) * g1) + d * d * twice;
    return (p0 * p0 + p0 * pe + pe * pe) / 3.0 + 2.0 * d * (p0 * phi[1] + p1 * g1) + d * d * twice;
  }
  /* Gauss-Legendre, 12 points: truncation below 1e-17 for |z| <= 3. */
  static const double node[6] = {0.98156063424671925069, 0.90411725637047485667,
                                 0.76990267419430468703, 0.58731795428661744729,
                                 0.36783149899818019375, 0.12523340851146891547};
  static const double weight[6] = {0.04717533638651182719, 0.10693932599531843096,
                                   0.16007832854334622633, 0.20316742672306592174,
                                   0.23349253653835480876, 0.24914704581340278500};
  double sum = 0.0;
  *size = 0.0;
  for (int i = 0; i < 12; i++) {
    const double x = 0.5 + (i < 6 ? -0.5 : 0.5) * node[i < 6 ? i : 11 - i];
    double phi[3];
    rot_phi(z * x, 0.0, 2, phi);
    const double from_a = ua * x * (phi[1] - x * phi[2]), from_b = ub * x * x * phi[2];
    const double omega = u0 * phi[0] + (from_a + from_b);
    const double largest = fabs(u0) * phi[0] + fabs(from_a) + fabs(from_b);
    sum += 0.5 * weight[i < 6 ? i : 11 - i] * omega * omega;
    *size += 0.5 * weight[i < 6 ? i : 11 - i] * largest * largest;
  }
  return sum;
}

typedef struct running_ledger {
  running_sum work, heat, impulse;
  double work_rounding, heat_rounding, impulse_rounding;
} running_ledger;

static void add_step(const rot_axle_params *p, const rot_axle_state *from,
                     const rot_torque_piece *piece, double time_s, running_ledger *sum) {
  const double I = p->inertia_kg_m2, c = p->viscous_n_m_s;
  const double a = rot_torque_in_piece(piece, from->time_s), b = rot_torque_in_piece(piece, time_s);
  const double s = time_s - from->time_s, w0 = from->omega_rad_per_s;
  if (s == 0.0) return;
  const double z = rot_muldiv(c, s, I, NULL), va = rot_muldiv(s, a, I, NULL),
               vb = rot_muldiv(s, b, I, NULL);

  /* Velocities in units of 2^e, so that their products stay in range; I likewise. */
  int e, ei;
  frexp(fmax(fabs(w0), fmax(fabs(va), fabs(vb))), &e);
  const double u0 = ldexp(w0, -e), ua = ldexp(va, -e), ub = ldexp(vb, -e), mi = frexp(I, &ei);

  double phi[5];
  rot_phi(z, 0.0, 4, phi);
  const double g1 = rot_phi_g1(z, phi[0], phi[1]), p34 = phi[3] - phi[4];
  const double b2 = z < 8.0 ? phi[2] - 2.0 * phi[3] + phi[4]
                            : (1.0 / 6.0 - phi[1] + 2.0 * phi[2] - phi[3]) / z;
  const double work = ua * (u0 * phi[2] + ua * p34 + ub * phi[4]) +
                      ub * (u0 * g1 + ua * b2 + ub * p34);
  const double work_size =
      fabs(ua) * (fabs(u0) * phi[2] + fabs(ua) * p34 + fabs(ub) * phi[4]) +
      fabs(ub) * (fabs(u0) * g1 + fabs(ua) * b2 + fabs(ub) * p34);
  double square_size, square = mean_square(z, u0, ua, ub, &square_size);
  const double impulse = rot_product(3, (double[]){s, 0.5, a + b}, 1.0);

  /* How far the error of omega at the start moves the two; it is relative to 2^e, too. */
  const double e0 = ldexp(from->omega_error, -e);
  const double largest = fabs(u0) + (fabs(ua) + fabs(ub)) * phi[1];
  const double work_rounding =
      16.0 * ROT_EPS * work_size + e0 * (fabs(ua) * phi[2] + fabs(ub) * g1);
  const double heat_rounding = 24.0 * ROT_EPS * square_size + 2.0 * e0 * largest * phi[1];

  add(&sum->work, ldexp(mi * work, ei + 2 * e));
  add(&sum->heat, ldexp(rot_product(3, (double[]){c, s, square}, 1.0), 2 * e));
  add(&sum->impulse, impulse);
  sum->work_rounding += ldexp(mi * work_rounding, ei + 2 * e);
  sum->heat_rounding += fabs(ldexp(rot_product(3, (double[]){c, s, heat_rounding}, 1.0), 2 * e));
  sum->impulse_rounding += 4.0 * ROT_EPS * fabs(0.5 * s) * (fabs(a) + fabs(b));
}

/* March from *state to a time, adding up on the way if there is a sum. */
static rot_status march(const rot_axle_params *p, rot_axle_state *state, double to_s,
                        running_ledger *sum, const rot_hooks *hooks, rot_info *info) {
  const int forward = to_s >= state->time_s;
  size_t k = rot_torque_find(&p->torque, state->time_s, forward);
  while (state->time_s != to_s) {
    const rot_torque_piece piece = rot_torque_piece_at(&p->torque, k);
    const double stop =
        forward ? fmin(piece.end_s, to_s) : fmax(piece.start_s, to_s);
    if (sum) add_step(p, state, &piece, stop, sum);
    *state = rot_axle_step(p, state, &piece, stop);
    info->time_s = stop;
    if (!(isfinite(state->theta_rad) && isfinite(state->omega_rad_per_s))) return ROT_ERANGE;
    k = forward ? k + 1 : k - 1;
    if (++info->steps % 256 == 0) {
      rot_status status = rot_poll(hooks, 0.0);
      if (status != ROT_OK) return status;
    }
  }
  return ROT_OK;
}

rot_status rot_axle_linear_ledger(const rot_axle_params *p, double from_s, double to_s,
                                  const rot_hooks *hooks, rot_axle_ledger *out, rot_info *info) {
  rot_axle_state state = rot_axle_start(p);
  running_ledger sum = {{0.0, 0.0}, {0.0, 0.0}, {0.0, 0.0}, 0.0, 0.0, 0.0};
  rot_info_clear(info);
  info->status = march(p, &state, from_s, NULL, hooks, info);
  if (info->status == ROT_OK) info->status = march(p, &state, to_s, &sum, hooks, info);
  out->work_j = sum.work.hi + sum.work.lo;
  out->dissipated_j = sum.heat.hi + sum.heat.lo;
  out->impulse_n_m_s = sum.impulse.hi + sum.impulse.lo;
  out->work_rounding_j = sum.work_rounding;
  out->dissipated_rounding_j = sum.heat_rounding;
  out->impulse_rounding_n_m_s = sum.impulse_rounding;
  return info->status;
}
