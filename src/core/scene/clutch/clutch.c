#include "scene/clutch/clutch.h"

#include <math.h>
#include <string.h>

#include "engine/stepping.h"
#include "ground/real.h"
#include "ground/search.h"

/* ---- torques and inertias -------------------------------------------------------------------- */

/* I1/(I1 + I2) and I2/(I1 + I2), without a sum that could overflow. */
static void find_fractions(const double inertia[2], double fraction[2]) {
  fraction[0] = 1.0 / (1.0 + inertia[1] / inertia[0]);
  fraction[1] = 1.0 / (1.0 + inertia[0] / inertia[1]);
}

/* The torque of a locked clutch, (I2 tau1 - I1 tau2)/(I1 + I2), by exact products: the comparison
 * with the static capacity may depend on the last digit. */
static double locked_torque(const double inertia[2], double tau1, double tau2) {
  int of_inertia = 0, of_torque = 0;
  frexp(fmax(inertia[0], inertia[1]), &of_inertia);
  frexp(fmax(fabs(tau1), fabs(tau2)), &of_torque);
  const double I1 = ldexp(inertia[0], -of_inertia), I2 = ldexp(inertia[1], -of_inertia);
  double a_lo, b_lo, lo, sum_lo;
  const double a = rot_two_prod(I2, ldexp(tau1, -of_torque), &a_lo);
  const double b = rot_two_prod(I1, ldexp(tau2, -of_torque), &b_lo);
  const double top = rot_two_sum(a, -b, &lo), sum = rot_two_sum(I1, I2, &sum_lo);
  const double q = top / sum;
  return ldexp(q + (fma(-q, sum, top) - q * sum_lo + (lo + a_lo - b_lo)) / sum, of_torque);
}

int rot_clutch_is_driven(const rot_clutch_params *p) {
  for (int body = 0; body < 2; body++) {
    const rot_steps *steps = &p->torque_n_m[body];
    for (size_t i = 0; i <= steps->n; i++) {
      if (steps->value[i] != 0.0) return 1;
    }
  }
  return 0;
}

/* omega1' - omega2' where the torque of the clutch is x less than the locked torque. */
static double relative_rate(const double inertia[2], double x) {
  return x / inertia[0] + x / inertia[1];
}

static size_t step_at(const rot_steps *steps, double t) {
  return rot_upper_bound(steps->n, steps->time_s, t);
}

/* ---- the state ------------------------------------------------------------------------------- */

/* The mean motion (total momentum over total inertia) and its error are independent of the clutch
 * and of the error of the lock time. omega1 = mean + fraction[1] slip, omega2 = mean - fraction[0]
 * slip; angles likewise. */
typedef struct clutch {
  const rot_clutch_params *p;
  double fraction[2]; /* of the total inertia, 0 to 1 */
  double time_s;
  double mean_theta, mean_omega, slip_theta, slip_omega;
  double heat; /* J, since the start */
  double mean_theta_error, mean_omega_error, slip_theta_error, slip_omega_error;
  double settled_s; /* latest possible time of the last lock: the slip is exactly 0 after it */
  /* State at the last change of a torque, and flows up to it. */
  double anchor_s, anchor_theta, anchor_slip, anchor_theta_error, anchor_slip_error;
  rot_clutch_flows done, done_error;
  /* The segment that begins at time_s. */
  double tau[2];               /* applied torques */
  double mean_rate, slip_rate; /* rad/s^2 */
  double torque;               /* of the clutch */
  double needed;               /* torque that would keep the speeds equal */
  int locked;
  int stops; /* 1: the segment ends where the slip reaches 0 */
  double end_s;
} clutch;

/* parameters => state at the start, with its rounding. */
static void begin(clutch *c, const rot_clutch_params *p) {
  const double *theta = p->theta0_rad, *omega = p->omega0_rad_per_s;
  *c = (clutch){0};
  c->p = p;
  find_fractions(p->inertia_kg_m2, c->fraction);
  c->time_s = p->start_s;
  c->mean_theta = c->fraction[0] * theta[0] + c->fraction[1] * theta[1];
  c->mean_omega = c->fraction[0] * omega[0] + c->fraction[1] * omega[1];
  if (theta[0] == theta[1]) c->mean_theta = theta[0];
  if (omega[0] == omega[1]) c->mean_omega = omega[0];
  c->slip_theta = theta[0] - theta[1];
  c->slip_omega = omega[0] - omega[1];
  for (int i = 0; i < 2; i++) {
    c->mean_theta_error += 4.0 * ROT_EPS * c->fraction[i] * fabs(theta[i]);
    c->mean_omega_error += 4.0 * ROT_EPS * c->fraction[i] * fabs(omega[i]);
  }
  c->slip_theta_error = ROT_EPS * fabs(c->slip_theta);
  c->slip_omega_error = ROT_EPS * fabs(c->slip_omega);
  c->settled_s = -INFINITY;
  c->anchor_s = p->start_s;
  c->anchor_theta = c->mean_theta;
  c->anchor_slip = c->slip_theta;
  c->anchor_theta_error = c->mean_theta_error;
  c->anchor_slip_error = c->slip_theta_error;
}

/* ---- flows ----------------------------------------------------------------------------------- */

/* state => flows since the start, their errors. Work since the anchor is torque times angle: the
 * torques are constant. */
static void flows_of(const clutch *c, rot_clutch_flows *flows, rot_clutch_flows *error) {
  const double mean = c->mean_theta - c->anchor_theta, slip = c->slip_theta - c->anchor_slip;
  const double slip_part[2] = {c->fraction[1], -c->fraction[0]}, s = c->time_s - c->anchor_s;
  *flows = c->done;
  *error = c->done_error;
  for (int b = 0; b < 2; b++) {
    const double work = c->tau[b] * (mean + slip_part[b] * slip), impulse = c->tau[b] * s;
    const double off =
        c->anchor_theta_error + c->mean_theta_error +
        fabs(slip_part[b]) * (c->anchor_slip_error + c->slip_theta_error) +
        4.0 * ROT_EPS * (fabs(c->anchor_theta) + fabs(c->mean_theta) + fabs(slip_part[b] * slip));
    flows->work_j += work;
    error->work_j += fabs(c->tau[b]) * off + 4.0 * ROT_EPS * (fabs(work) + fabs(flows->work_j));
    flows->torque_impulse_n_m_s += impulse;
    error->torque_impulse_n_m_s +=
        4.0 * ROT_EPS * (fabs(impulse) + fabs(flows->torque_impulse_n_m_s));
  }
  flows->dissipated_j = c->heat;
  error->dissipated_j = 32.0 * ROT_EPS * c->heat + 4.0 * c->p->capacity_n_m * c->slip_theta_error;
}

static void lay_anchor(clutch *c) {
  flows_of(c, &c->done, &c->done_error);
  c->anchor_s = c->time_s;
  c->anchor_theta = c->mean_theta;
  c->anchor_slip = c->slip_theta;
  c->anchor_theta_error = c->mean_theta_error;
  c->anchor_slip_error = c->slip_theta_error;
}

/* ---- segments ------------------------------------------------------------------------------- */

static int sign(double x) { return (x > 0.0) - (x < 0.0); }

static double next_step(const rot_steps *steps, double t) {
  const size_t i = step_at(steps, t);
  return i < steps->n ? steps->time_s[i] : (double)INFINITY;
}

/* Time of the next step of a torque after t; Inf: none. */
static double next_torque(const rot_clutch_params *p, double t) {
  return fmin(next_step(&p->torque_n_m[0], t), next_step(&p->torque_n_m[1], t));
}

/* Time at which the slip reaches 0 with its present rate; Inf: never. */
static double stop_time(const clutch *c) {
  if (sign(c->slip_omega) * sign(c->slip_rate) >= 0) return INFINITY;
  return c->time_s - c->slip_omega / c->slip_rate;
}

/* end_s: the earliest of zero slip, step of a torque and engagement. */
static void find_end(clutch *c) {
  const double stop = stop_time(c), engage_s = c->p->engage_s;
  c->end_s = next_torque(c->p, c->time_s);
  if (engage_s > c->time_s) c->end_s = fmin(c->end_s, engage_s);
  c->stops = stop <= c->end_s;
  if (c->stops) c->end_s = fmax(stop, c->time_s);
}

/* state => segment from time_s on (torque, rates, end), events. */
static rot_status enter(clutch *c, int was_locked, rot_events *events) {
  const rot_clutch_params *p = c->p;
  const int engaged = c->time_s >= p->engage_s;
  double tau[2];
  for (int i = 0; i < 2; i++) {
    tau[i] = p->torque_n_m[i].value[step_at(&p->torque_n_m[i], c->time_s)];
  }
  if (tau[0] != c->tau[0] || tau[1] != c->tau[1]) lay_anchor(c);
  memcpy(c->tau, tau, sizeof tau);
  c->needed = locked_torque(p->inertia_kg_m2, c->tau[0], c->tau[1]);
  c->mean_rate = c->fraction[0] * (c->tau[0] / p->inertia_kg_m2[0]) +
                 c->fraction[1] * (c->tau[1] / p->inertia_kg_m2[1]);
  c->locked = engaged && c->slip_omega == 0.0 && fabs(c->needed) <= p->static_n_m;
  if (c->locked) {
    c->torque = c->needed;
    c->slip_rate = 0.0;
  } else {
    const int direction = c->slip_omega != 0.0 ? sign(c->slip_omega) : sign(c->needed);
    c->torque = engaged ? direction * p->capacity_n_m : 0.0;
    c->slip_rate = relative_rate(p->inertia_kg_m2, c->needed - c->torque);
  }
  find_end(c);
  if (c->locked && !was_locked && c->time_s > p->start_s) {
    return rot_events_add(events, c->time_s, ROT_EVENT_LOCK);
  }
  return !c->locked && was_locked ? rot_events_add(events, c->time_s, ROT_EVENT_SLIP) : ROT_OK;
}

/* (segment, time) => state at a later time of the segment. */
static clutch after(const clutch *c, double time) {
  clutch to = *c;
  const double s = time - c->time_s, half = 0.5 * s * s, *I = c->p->inertia_kg_m2;
  const double rates =
      fabs(c->tau[0] / I[0]) * c->fraction[0] + fabs(c->tau[1] / I[1]) * c->fraction[1];
  const double pull = relative_rate(I, fabs(c->needed) + fabs(c->torque));
  to.time_s = time;
  to.mean_theta += c->mean_omega * s + c->mean_rate * half;
  to.mean_omega += c->mean_rate * s;
  to.slip_theta += c->slip_omega * s + c->slip_rate * half;
  to.slip_omega += c->slip_rate * s;
  /* The slip has one sign on the segment: both parts of the heat are positive. */
  to.heat += fabs(c->torque) * (c->locked ? 0.0 : 0.5 * s * fabs(c->slip_omega + to.slip_omega));
  /* Includes the rounding of the time difference: at most 6 roundings of each term, 10 of half
   * s^2. */
  to.mean_omega_error += ROT_EPS * (8.0 * rates * s + fabs(to.mean_omega));
  to.mean_theta_error +=
      c->mean_omega_error * s +
      ROT_EPS * (3.0 * fabs(c->mean_omega) * s + 12.0 * rates * half + fabs(to.mean_theta));
  if (!c->locked) {
    to.slip_omega_error += ROT_EPS * (8.0 * pull * s + fabs(to.slip_omega));
    to.slip_theta_error +=
        c->slip_omega_error * s +
        ROT_EPS * (3.0 * fabs(c->slip_omega) * s + 12.0 * pull * half + fabs(to.slip_theta));
  }
  return to;
}

/* segment => state at its end, next segment, events. */
static rot_status cross(clutch *c, rot_events *events) {
  const int was_locked = c->locked, stops = c->stops, direction = sign(c->slip_omega);
  const double rate = fabs(c->slip_rate), heat = c->heat, end = c->end_s;
  if (stops) {
    /* w dt + A dt^2/2 with dt = -w/A is -w^2/(2 A), free of the rounding of dt. */
    const double w = c->slip_omega, turned = 0.5 * w * (-w / c->slip_rate);
    const double warmed = fabs(c->torque) * fabs(turned), slip = c->slip_theta;
    *c = after(c, end);
    c->slip_theta = slip + turned;
    c->heat = heat + warmed;
    c->slip_omega = 0.0;
    c->slip_omega_error += 2.0 * ROT_EPS * rate * fabs(end);
    c->settled_s = end + c->slip_omega_error / rate;
  } else {
    *c = after(c, end);
    if (was_locked && end > c->settled_s) c->slip_omega_error = 0.0;
  }
  rot_status status = enter(c, was_locked, events);
  /* The error of the stop time acts with the slip rate that follows. */
  if (stops && fabs(c->slip_rate) > rate) c->slip_omega_error *= fabs(c->slip_rate) / rate;
  if (status == ROT_OK && stops && !c->locked && sign(c->slip_rate) == -direction) {
    status = rot_events_add(events, c->time_s, ROT_EVENT_REVERSE);
  }
  if (status != ROT_OK) return status;
  return isfinite(c->mean_theta) && isfinite(c->slip_theta) ? ROT_OK : ROT_ERANGE;
}

/* ---- rows ------------------------------------------------------------------------------------ */

typedef struct clutch_run {
  clutch at;
  const double *time_s;
  const rot_clutch_columns *out;
  double *const *flow;
  double *flow_error;
  rot_events *events;
  rot_info *info;
} clutch_run;

static rot_status restart(void *model, int forward) {
  clutch_run *run = model;
  return forward ? enter(&run->at, 1, NULL) : ROT_EVALUE;
}

static int holds(const void *model, double time_s) {
  return !(((const clutch_run *)model)->at.end_s <= time_s);
}

static rot_status next_piece(void *model, double *end_s) {
  clutch_run *run = model;
  *end_s = run->at.end_s;
  return cross(&run->at, run->events);
}

/* (segment, i) => row i, its errors and flows. */
static rot_status write_row(void *model, size_t i) {
  const clutch_run *run = model;
  const clutch state = after(&run->at, run->time_s[i]), *at = &state;
  const rot_clutch_columns *out = run->out;
  const double slip_part[2] = {at->fraction[1], -at->fraction[0]};
  for (int b = 0; b < 2; b++) {
    const int first = at->time_s == at->p->start_s;
    const double theta =
        first ? at->p->theta0_rad[b] : at->mean_theta + slip_part[b] * at->slip_theta;
    const double omega =
        first ? at->p->omega0_rad_per_s[b] : at->mean_omega + slip_part[b] * at->slip_omega;
    if (!(isfinite(theta) && isfinite(omega))) return ROT_ERANGE;
    const double slip_error = at->locked && at->time_s > at->settled_s ? 0.0 : at->slip_omega_error;
    (b == 0 ? out->theta_1_rad : out->theta_2_rad)[i] = theta;
    (b == 0 ? out->omega_1_rad_per_s : out->omega_2_rad_per_s)[i] = omega;
    rot_note_row(run->info, theta, omega,
                 at->mean_theta_error + fabs(slip_part[b]) * at->slip_theta_error +
                     ROT_EPS * (4.0 * fabs(slip_part[b] * at->slip_theta) + fabs(theta)),
                 at->mean_omega_error + fabs(slip_part[b]) * slip_error +
                     ROT_EPS * (4.0 * fabs(slip_part[b] * at->slip_omega) + fabs(omega)));
  }
  if (run->flow) {
    rot_clutch_flows flows, error;
    size_t k = 0;
    flows_of(at, &flows, &error);
#define X(name)                                                                                    \
  run->flow[k][i] = flows.name;                                                                    \
  run->flow_error[k] = fmax(run->flow_error[k], error.name);                                       \
  k++;
    ROT_CLUTCH_FLOWS(X)
#undef X
  }
  out->clutch_torque_n_m[i] = at->torque;
  out->heat_j[i] = at->heat;
  out->locked[i] = at->locked;
  return ROT_OK;
}

rot_status rot_clutch_run(const rot_clutch_params *p, size_t n, const double time_s[],
                          const rot_clutch_columns *out, double *const flow[], double flow_error[],
                          rot_events *events, const rot_hooks *hooks, rot_info *info) {
  static const rot_stepping stepping = {restart, holds, next_piece, write_row, NULL};
  clutch_run run = {.time_s = time_s,
                    .out = out,
                    .flow = flow,
                    .flow_error = flow_error,
                    .events = events,
                    .info = info};
  for (size_t k = 0; flow && k < ROT_CLUTCH_N_FLOWS; k++) flow_error[k] = 0.0;
  rot_info_clear(info, rot_turning);
  begin(&run.at, p);
  for (int b = 0; b < 2; b++) rot_note_state(info, p->theta0_rad[b], p->omega0_rad_per_s[b]);
  return rot_step_rows(&stepping, &run, p->start_s, n, time_s, hooks, info);
}

/* ---- one engagement -------------------------------------------------------------------------- */

/* The torque that keeps the speeds equal is beyond the capacity, or nothing brakes the slip; NaN:
 * not known. */
static rot_clutch_engagement never_locks(double locked_torque) {
  const double never = isnan(locked_torque) ? (double)NAN : (double)INFINITY;
  return (rot_clutch_engagement){never, (double)NAN, never, locked_torque};
}

/* => factor with which the sum of two such numbers neither overflows nor underflows */
static double factor_of_sum(double a, double b) { return fmax(fabs(a), fabs(b)) < 1.0 ? 1.0 : 0.5; }

/* rot_clutch_engage() for products that may overflow or underflow: exponents kept separately, sums
 * with a factor. */
static rot_clutch_engagement engage_extended(const double inertia[2], const double fraction[2],
                                             double capacity, const double torque[2],
                                             const double omega[2]) {
  const double of_slip = factor_of_sum(omega[0], omega[1]);
  const double of_inertia = factor_of_sum(inertia[0], inertia[1]);
  const double slip = of_slip * omega[0] - of_slip * omega[1], size = fabs(slip);
  const double sum = of_inertia * inertia[0] + of_inertia * inertia[1];
  const double reduced = fmin(inertia[0], inertia[1]) * fmax(fraction[0], fraction[1]);
  const double half_square = 0.5 / (of_slip * of_slip); /* half the slip's square over size^2 */
  rot_clutch_engagement x;
  x.locked_torque_n_m = locked_torque(inertia, torque[0], torque[1]);
  x.omega_rad_per_s = rot_product(3, (double[]){of_inertia, inertia[0], omega[0]}, sum) +
                      rot_product(3, (double[]){of_inertia, inertia[1], omega[1]}, sum);
  if (slip == 0.0) x.omega_rad_per_s = omega[0];
  if (fabs(x.locked_torque_n_m) > capacity) return never_locks(x.locked_torque_n_m);
  if (isinf(capacity) || slip == 0.0) {
    x.lock_s = 0.0;
    x.heat_j = rot_product(4, (double[]){half_square, reduced, size, size}, 1.0);
    return x;
  }
  const double of_torque = factor_of_sum(capacity, x.locked_torque_n_m);
  /* The torque that brakes the slip, with that factor. */
  const double brakes = of_torque * capacity - of_torque * sign(slip) * x.locked_torque_n_m;
  if (!(brakes > 0.0)) return never_locks(x.locked_torque_n_m);
  const double of_time = of_torque / of_slip;
  x.lock_s = rot_product(3, (double[]){of_time, size, reduced}, brakes);
  int of_sum = 0;
  const double fraction_of_sum = frexp(sum, &of_sum);
  for (int i = 0; i < 2; i++) {
    int e;
    const double p = rot_product_split(
        4, (double[]){of_time * of_inertia, torque[i], size, reduced}, brakes, &e);
    x.omega_rad_per_s += ldexp(p / fraction_of_sum, e - of_sum);
  }
  x.heat_j =
      rot_product(5, (double[]){of_torque * half_square, capacity, reduced, size, size}, brakes);
  return x;
}

rot_clutch_engagement rot_clutch_engage(double inertia_1, double inertia_2, double capacity_n_m,
                                        double torque_1, double torque_2, double omega_1,
                                        double omega_2) {
  const double inertia[2] = {inertia_1, inertia_2}, slip = omega_1 - omega_2;
  double fraction[2];
  rot_clutch_engagement x;
  find_fractions(inertia, fraction);
  const double numbers[] = {inertia_1, inertia_2, capacity_n_m, torque_1,
                            torque_2,  omega_1,   omega_2};
  int finite = 1, well_scaled = 1;
  for (int i = 0; i < 7; i++) {
    const int unlimited = i == 2 && isinf(numbers[i]);
    finite &= isfinite(numbers[i]) || unlimited;
    well_scaled &= rot_well_scaled(numbers[i], 1e60) || unlimited;
  }
  if (finite && !well_scaled) {
    return engage_extended(inertia, fraction, capacity_n_m, (double[]){torque_1, torque_2},
                           (double[]){omega_1, omega_2});
  }
  const double mean = slip == 0.0 ? omega_1 : fraction[0] * omega_1 + fraction[1] * omega_2;
  x.locked_torque_n_m = locked_torque(inertia, torque_1, torque_2);
  if (fabs(x.locked_torque_n_m) > capacity_n_m) return never_locks(x.locked_torque_n_m);
  if (isinf(capacity_n_m) || slip == 0.0) {
    /* (1/2) I1 I2/(I1 + I2) slip^2 as a product: the difference of the energies would cancel. */
    x.lock_s = 0.0;
    x.omega_rad_per_s = mean;
    x.heat_j =
        rot_product(
            4, (double[]){0.5, fmin(inertia_1, inertia_2), fmax(fraction[0], fraction[1]), slip},
            1.0) *
        slip;
    return x;
  }
  const double rate = relative_rate(inertia, x.locked_torque_n_m - sign(slip) * capacity_n_m);
  const double t = -slip / rate;
  x.lock_s = t >= 0.0 && isfinite(t) ? t : (double)INFINITY;
  if (isnan(slip) || isnan(rate)) x.lock_s = NAN;
  const double mean_rate =
      fraction[0] * (torque_1 / inertia_1) + fraction[1] * (torque_2 / inertia_2);
  x.omega_rad_per_s = isfinite(x.lock_s) ? mean + mean_rate * x.lock_s : (double)NAN;
  x.heat_j = isinf(x.lock_s) ? (double)INFINITY : 0.5 * capacity_n_m * fabs(slip) * x.lock_s;
  return x;
}
