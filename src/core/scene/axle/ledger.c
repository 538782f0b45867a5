#include "scene/axle/ledger.h"

#include <math.h>
#include <string.h>

#include "ground/gauss.h"
#include "ground/store.h"
#include "maths/phi.h"
#include "ground/real.h"

typedef struct running_sum {
  double hi, lo;
} running_sum;

static double difference(running_sum a, running_sum b) { return (a.hi - b.hi) + (a.lo - b.lo); }

static void add(running_sum *sum, double x) { rot_accumulate(&sum->hi, &sum->lo, x); }

/* Data of a step, in units of 2^unit rad/s. Each is used only if it has the magnitude of omega:
 * squares do not overflow for any z from 0 to Inf. */
typedef struct step_drive {
  double z, z_lo; /* c s/I */
  double u0;      /* omega at the start */
  double ua, ub;  /* s torque/I at start and end, for |z| <= 8 */
  double qa, qb;  /* torque/c at start and end, for |z| > 3 */
  int unit;
} step_drive;

/* Scales all numbers by the largest of them. */
static step_drive drive_of(const rot_axle_params *p, double s, double s_lo, double w0, double a,
                           double b) {
  const double I = p->inertia_kg_m2, c = p->viscous_n_m_s;
  double z_lo, z = rot_muldiv(c, s, I, &z_lo);
  if (isfinite(z)) z_lo += z * (s_lo / s);
  const int settled = fabs(z) > 8.0;
  step_drive drive = {z, z_lo, 0.0, 0.0, 0.0, 0.0, 0.0, 0};
  int e0 = 0, ea, eb;
  const double m0 = frexp(w0, &e0);
  const double ma =
      settled ? rot_product_split(1, &a, c, &ea) : rot_product_split(2, (double[]){s, a}, I, &ea);
  const double mb =
      settled ? rot_product_split(1, &b, c, &eb) : rot_product_split(2, (double[]){s, b}, I, &eb);
  int e = m0 != 0.0 ? e0 : ma != 0.0 ? ea : eb;
  if (ma != 0.0 && ea > e) e = ea;
  if (mb != 0.0 && eb > e) e = eb;
  drive.unit = e;
  drive.u0 = ldexp(m0, e0 - e);
  if (settled) {
    drive.qa = ldexp(ma, ea - e);
    drive.qb = ldexp(mb, eb - e);
  } else {
    drive.ua = ldexp(ma, ea - e);
    drive.ub = ldexp(mb, eb - e);
    drive.qa = fabs(z) > 3.0 ? drive.ua / z : 0.0;
    drive.qb = fabs(z) > 3.0 ? drive.ub / z : 0.0;
  }
  return drive;
}

/* int_0^1 omega(x)^2 dx of a step; *size: the same with all terms positive. */
static double mean_square(const step_drive *drive, double *size) {
  const double z = drive->z, u0 = drive->u0, ua = drive->ua, ub = drive->ub;
  if (!(fabs(z) <= 3.0)) {
    double phi[2];
    rot_phi(z, drive->z_lo, 1, phi);
    const double g1 = rot_phi_g1(z, phi[0], phi[1]),
                 twice = -expm1(-2.0 * z) / (2.0 * z) * (z < 0.0 ? 1.0 - 2.0 * drive->z_lo : 1.0);
    const double p1 = drive->qb - drive->qa, p0 = drive->qa - p1 / z, d = u0 - p0, pe = p0 + p1;
    *size = (p0 * p0 + fabs(p0 * pe) + pe * pe) / 3.0 +
            2.0 * fabs(d) * (fabs(p0) * phi[1] + fabs(p1) * g1) + d * d * twice;
    return (p0 * p0 + p0 * pe + pe * pe) / 3.0 + 2.0 * d * (p0 * phi[1] + p1 * g1) + d * d * twice;
  }
  double sum = 0.0;
  *size = 0.0;
  for (int i = 0; i < 12; i++) {
    const rot_gauss_node at = rot_gauss(i);
    const double x = at.x;
    double phi[3];
    rot_phi(z * x, 0.0, 2, phi);
    const double from_a = ua * x * (phi[1] - x * phi[2]), from_b = ub * x * x * phi[2];
    const double omega = u0 * phi[0] + (from_a + from_b);
    const double largest = fabs(u0) * phi[0] + fabs(from_a) + fabs(from_b);
    sum += at.weight * omega * omega;
    *size += at.weight * largest * largest;
  }
  return sum;
}

typedef struct running_ledger {
  running_sum work, heat, impulse, turned;
  double work_rounding, heat_rounding, impulse_rounding;
} running_ledger;

/* Product of n numbers, in units of 2^unit. */
static double in_unit(int n, const double x[], int unit) {
  int exponent;
  const double p = rot_product_split(n, x, 1.0, &exponent);
  return ldexp(p, exponent + unit);
}

/* (state, piece, time) => adds work, heat and impulse of the step, with their rounding. */
static void add_step(const rot_axle_params *p, const rot_axle_state *from,
                     const rot_torque_piece *piece, double time_s, running_ledger *sum) {
  const double c = p->viscous_n_m_s;
  const double a = rot_torque_in_piece(piece, from->time_s), b = rot_torque_in_piece(piece, time_s);
  double s_lo, s = rot_two_sum(time_s, -from->time_s, &s_lo);
  if (s == 0.0) return;
  const step_drive drive = drive_of(p, s, s_lo, from->omega_rad_per_s, a, b);
  const double z = drive.z, u0 = drive.u0;

  /* Work = s (a X + b Y); X, Y: means of omega with weights 1-x and x. */
  double phi[5], near_a, far_a, near_b, far_b; /* coefficients of a, b in X and Y */
  rot_phi(z, drive.z_lo, 4, phi);
  const double g1 = rot_phi_g1(z, phi[0], phi[1]);
  const int settled = fabs(z) > 8.0;
  if (settled) {
    near_a = far_b = 1.0 / 3.0 - phi[2] + phi[3];
    far_a = 1.0 / 6.0 - phi[3];
    near_b = 1.0 / 6.0 - phi[1] + 2.0 * phi[2] - phi[3];
  } else {
    near_a = far_b = phi[3] - phi[4];
    far_a = phi[4];
    near_b = phi[2] - 2.0 * phi[3] + phi[4];
  }
  const double da = settled ? drive.qa : drive.ua, db = settled ? drive.qb : drive.ub;
  const double x = u0 * phi[2] + da * near_a + db * far_a;
  const double y = u0 * g1 + da * near_b + db * far_b;
  const double x_size = fabs(u0) * phi[2] + fabs(da * near_a) + fabs(db * far_a);
  const double y_size = fabs(u0) * g1 + fabs(da * near_b) + fabs(db * far_b);
  double square_size, square = mean_square(&drive, &square_size);

  /* Errors due to that of omega at the start. */
  const double u_error = ldexp(from->omega_error, -drive.unit);
  const double largest =
      fabs(u0) + (settled ? fabs(da) + fabs(db) : (fabs(da) + fabs(db)) * phi[1]);
  const double x_rounding = 16.0 * ROT_EPS * x_size + u_error * phi[2];
  const double y_rounding = 16.0 * ROT_EPS * y_size + u_error * g1;
  const double square_rounding = 24.0 * ROT_EPS * square_size + 2.0 * u_error * largest * phi[1];

  add(&sum->work, in_unit(3, (double[]){s, a, x}, drive.unit));
  add(&sum->work, in_unit(3, (double[]){s, b, y}, drive.unit));
  add(&sum->heat, in_unit(3, (double[]){c, s, square}, 2 * drive.unit));
  add(&sum->impulse, rot_product(3, (double[]){s, 0.5, a + b}, 1.0));
  sum->work_rounding += in_unit(3, (double[]){fabs(s), fabs(a), x_rounding}, drive.unit) +
                        in_unit(3, (double[]){fabs(s), fabs(b), y_rounding}, drive.unit);
  sum->heat_rounding += fabs(in_unit(3, (double[]){c, s, square_rounding}, 2 * drive.unit));
  sum->impulse_rounding += 4.0 * ROT_EPS * fabs(0.5 * s) * (fabs(a) + fabs(b));
}

/* *state => state at a time, piece by piece; sum (NULL: none) += flows. */
static rot_status go_to(const rot_axle_params *p, rot_axle_state *state, double to_s,
                        running_ledger *sum, const rot_hooks *hooks, rot_info *info) {
  const int forward = to_s >= state->time_s;
  size_t k = rot_torque_find(&p->torque, state->time_s, forward);
  while (state->time_s != to_s) {
    const rot_torque_piece piece = rot_torque_piece_at(&p->torque, k);
    const double stop = forward ? fmin(piece.end_s, to_s) : fmax(piece.start_s, to_s);
    if (sum) add_step(p, state, &piece, stop, sum);
    const rot_axle_state from = *state;
    *state = rot_axle_step(p, state, &piece, stop);
    if (sum) {
      add(&sum->turned, state->theta_rad - from.theta_rad);
      add(&sum->turned, state->theta_lo - from.theta_lo);
    }
    info->time_s = stop;
    if (!rot_axle_in_range(state)) return ROT_ERANGE;
    k = forward ? k + 1 : k - 1;
    if (++info->steps % 256 == 0) {
      rot_status status = rot_poll(hooks, 0.0);
      if (status != ROT_OK) return status;
    }
  }
  return ROT_OK;
}

/* Ledger since the first row: of - first, with the rounding of all. */
static rot_axle_ledger ledger_of(const rot_axle_params *p, const running_ledger *of,
                                 const running_ledger *first, const running_ledger *rounding) {
  rot_axle_ledger out;
  out.work_j = difference(of->work, first->work);
  out.dissipated_j = difference(of->heat, first->heat);
  out.impulse_n_m_s = difference(of->impulse, first->impulse);
  out.work_rounding_j = rounding->work_rounding;
  out.dissipated_rounding_j = rounding->heat_rounding;
  out.impulse_rounding_n_m_s = rounding->impulse_rounding;
  out.viscous_j = out.dissipated_j;
  out.quadratic_j = out.coulomb_j = out.inertia_work_j = 0.0;
  out.damping_impulse_n_m_s = 0.0 - p->viscous_n_m_s * difference(of->turned, first->turned);
  return out;
}

/* Sums outward from the start, like the rows: inward, a motion that decays outward would grow, with
 * its rounding. */
static rot_status sum_rows(const rot_axle_params *p, size_t n, const double t[],
                           const rot_hooks *hooks, running_ledger row[], running_ledger *rounding,
                           rot_info *info) {
  running_ledger before, after;
  rot_axle_state state = rot_axle_start(p);
  size_t late = 0; /* first row not before the start */
  memset(&before, 0, sizeof before);
  after = before;
  rot_info_clear(info, rot_turning);
  while (late < n && t[late] < p->start_s) late++;
  if (n && late == n) info->status = go_to(p, &state, t[n - 1], NULL, hooks, info);
  for (size_t i = late; i-- > 0 && info->status == ROT_OK;) {
    info->status = go_to(p, &state, t[i], &before, hooks, info);
    row[i] = before;
  }
  state = rot_axle_start(p);
  if (n && late == 0 && info->status == ROT_OK) {
    info->status = go_to(p, &state, t[0], NULL, hooks, info);
  }
  for (size_t i = late; i < n && info->status == ROT_OK; i++) {
    info->status = go_to(p, &state, t[i], &after, hooks, info);
    row[i] = after;
  }
  *rounding = after;
  rounding->work_rounding += before.work_rounding;
  rounding->heat_rounding += before.heat_rounding;
  rounding->impulse_rounding += before.impulse_rounding;
  return info->status;
}

rot_status rot_axle_linear_ledgers(const rot_axle_params *p, size_t n, const double time_s[],
                                   const rot_hooks *hooks, rot_axle_ledger out[], rot_info *info) {
  rot_store store = {0};
  running_ledger rounding, *row = rot_store_get(&store, n, sizeof *row);
  rot_info_clear(info, rot_turning);
  if (!row) return info->status = ROT_ENOMEM;
  (void)sum_rows(p, n, time_s, hooks, row, &rounding, info);
  for (size_t i = 0; i < n; i++) out[i] = ledger_of(p, &row[i], &row[0], &rounding);
  rot_store_free(&store);
  return info->status;
}

rot_status rot_axle_linear_ledger(const rot_axle_params *p, double from_s, double to_s,
                                  const rot_hooks *hooks, rot_axle_ledger *out, rot_info *info) {
  const double ends[] = {from_s, to_s};
  rot_axle_ledger row[2];
  const rot_status status = rot_axle_linear_ledgers(p, 2, ends, hooks, row, info);
  if (status != ROT_ENOMEM) *out = row[1];
  return status;
}
