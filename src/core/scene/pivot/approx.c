#include "scene/pivot/approx.h"

#include <math.h>

#include "maths/attitude.h"
#include "engine/stepping.h"
#include "scene/pivot/pivot.h"
#include "ground/real.h"
#include "scene/pivot/top_motion.h"

/* The start in the top's axes, reversed if the weight hangs: G > 0. */
typedef struct top {
  const rot_free_params *p;
  int axis;    /* of symmetry, 0 to 2 */
  int hangs;   /* 1: axes reversed */
  int nutates; /* 1: small nutation, 0: precession */
  double transverse, axial, weight;
  double u, s, phi, theta, psi;                /* u = cos(theta), s = sin(theta) */
  double phi_rate, theta_rate, omega3;         /* at the start */
  double a, beta;                              /* I3 w3/I1, 2 G/I1 */
  double b_minus_a, b_plus_a;                  /* phi' = (b - a u)/(1 - u^2) */
  double rate;                                 /* of the gyroscope: G/(I3 w3) */
  double low, high, period;                    /* exact limits of u, period of the nutation */
  double mean_phi, mean_psi, fastest;          /* mean rates; largest |u'| */
  double n, centre, sway, phi_slope, psi_turn; /* small nutation: see begin(), write_row() */
  const double *time_s;
  const rot_free_columns *out;
  rot_info *info;
} top;

/* parameters => constants of the approximation. ROT_EVALUE: no symmetric top, or the start at a
 * pole. */
static rot_status begin(const rot_free_params *p, int nutates, top *x) {
  static const double over[4] = {0.0, 1.0, 0.0, 0.0};
  const int k = rot_pivot_axis(p);
  double omega[3], w[3], q[4];
  *x = (top){.p = p, .axis = k, .nutates = nutates};
  if (k < 0) return ROT_EVALUE;
  rot_free_principal(p, omega, q);
  rot_attitude_times(q, rot_pivot_turns[k], q);
  for (int i = 0; i < 3; i++) w[i] = omega[(k + 1 + i) % 3];
  x->transverse = p->moment_kg_m2[(k + 1) % 3];
  x->axial = p->moment_kg_m2[k];
  x->weight = fabs(p->lever_n_m[k]);
  x->hangs = p->lever_n_m[k] < 0.0;
  if (x->hangs) {
    rot_attitude_times(q, over, q);
    w[1] = -w[1];
    w[2] = -w[2];
  }
  const double down = hypot(q[1], q[2]), up = hypot(q[0], q[3]);
  const double sum = 2.0 * atan2(q[3], q[0]), difference = 2.0 * atan2(q[2], q[1]);
  if (!(down > 0.0 && up > 0.0)) return ROT_EVALUE;
  x->u = (up - down) * (up + down);
  x->s = 2.0 * up * down;
  x->theta = 2.0 * atan2(down, up);
  x->phi = 0.5 * (sum + difference);
  x->psi = 0.5 * (sum - difference);
  x->theta_rate = w[0] * cos(x->psi) - w[1] * sin(x->psi);
  x->phi_rate = (w[0] * sin(x->psi) + w[1] * cos(x->psi)) / x->s;
  x->omega3 = w[2];
  x->a = x->axial * w[2] / x->transverse;
  x->beta = 2.0 * x->weight / x->transverse;
  x->b_minus_a = x->phi_rate * x->s * x->s - x->a * (1.0 - x->u);
  x->b_plus_a = x->phi_rate * x->s * x->s + x->a * (1.0 + x->u);
  x->rate = x->weight / (x->axial * w[2]);
  rot_top_start start;
  rot_top_motion m;
  for (int i = 0; i < 3; i++) start.omega[i] = (rot_dd){w[i], 0.0};
  for (int i = 0; i < 4; i++) start.q[i] = (rot_dd){q[i], 0.0};
  const rot_status status = rot_top_begin(x->transverse, x->axial, x->weight, &start, 0.0, &m);
  if (status != ROT_OK) return status;
  const double sum_rate = ldexp(m.sum.rate.hi, m.exponent);
  x->mean_phi = ldexp(m.precession, m.exponent);
  x->mean_psi = sum_rate - x->mean_phi;
  x->low = x->high = x->u;
  if (!m.steady) {
    const rot_top_nutation n = rot_top_nutates(&m);
    x->low = fmin(n.lowest_cosine, x->u);
    x->high = fmax(n.highest_cosine, x->u);
    x->period = n.period_s;
    /* u'^2 = beta (u - u1)(u2 - u)(u3 - u) with beta (u3 - u1) = 4 lambda^2 */
    x->fastest = ldexp(m.lambda.hi, m.exponent) * (x->high - x->low);
  }
  /* x = u - u(0): x'' = f1/2 - n^2 x + ... */
  const double s2 = x->s * x->s,
               v2 = x->phi_rate * x->phi_rate * s2 + x->theta_rate * x->theta_rate;
  const double f1 =
      s2 * (2.0 * x->a * x->phi_rate - x->beta - 2.0 * x->u * x->phi_rate * x->phi_rate) -
      2.0 * x->u * x->theta_rate * x->theta_rate;
  const double n2 = v2 + x->a * x->a - 2.0 * x->beta * x->u;
  x->n = n2 > 0.0 ? sqrt(n2) : NAN;
  x->centre = 0.5 * f1 / n2;
  x->sway = -x->s * x->theta_rate / x->n;
  x->phi_slope = (2.0 * x->u * x->phi_rate - x->a) / s2;
  x->psi_turn = x->phi_rate + x->u * x->phi_slope;
  return ROT_OK;
}

const char *rot_pivot_not_spinning(const rot_free_params *p) {
  const char *not_top = rot_pivot_not_top(p);
  top x;
  if (not_top) return not_top;
  if (p->omega0_rad_per_s[0] == 0.0 && p->omega0_rad_per_s[1] == 0.0 &&
      p->omega0_rad_per_s[2] == 0.0) {
    return "it does not spin";
  }
  const rot_status status = begin(p, 0, &x);
  if (status == ROT_ERANGE) return "gravity is below 1e-60 of the squares of its rates";
  if (status != ROT_OK) return "its axis is vertical";
  return x.omega3 != 0.0 ? NULL : "it does not spin";
}

/* ---- bounds ---------------------------------------------------------------------------------- */

/* Limits of phi' for u in [low, high]: sum of those of its two terms, which are monotonic. */
static void phi_rates(const top *x, double low, double high, double *min, double *max) {
  const double a = x->b_minus_a / (1.0 - low), b = x->b_minus_a / (1.0 - high);
  const double c = x->b_plus_a / (1.0 + low), d = x->b_plus_a / (1.0 + high);
  *min = 0.5 * (fmin(a, b) + fmin(c, d));
  *max = 0.5 * (fmax(a, b) + fmax(c, d));
}

/* Limits of the sine for a cosine in [low, high]. */
static void sines(double low, double high, double *min, double *max) {
  const double a = sqrt((1.0 - low) * (1.0 + low)), b = sqrt((1.0 - high) * (1.0 + high));
  *min = fmin(a, b);
  *max = low < 0.0 && high > 0.0 ? 1.0 : fmax(a, b);
}

/* Bounds of the errors of attitude and omega up to |t|. Errors (phi, theta, psi) of the Euler
 * angles rotate the attitude by at most |theta| + hypot(s phi, u phi + psi). An angle with a
 * periodic rate that is even in time about the turning points differs from its mean motion by at
 * most a quarter period times the largest deviation of the rate if it starts there, and by twice
 * that from any other start. */
static void precession_errors(const top *x, double t, double *attitude, double *omega) {
  double min, max, s_min, s_max;
  const double reach = fmax(x->high - x->u, x->u - x->low), time = fabs(t);
  phi_rates(x, x->low, x->high, &min, &max);
  sines(x->low, x->high, &s_min, &s_max);
  const double off = fmax(max - x->mean_phi, x->mean_phi - min);
  const double swing_phi = 0.5 * x->period * off;
  const double swing_rest = reach * fmax(fabs(min), fabs(max)) * x->period;
  const double phi = x->mean_phi - x->rate, psi = x->mean_psi - (x->omega3 - x->u * x->rate);
  const double theta = fmax(fabs(acos(x->low) - x->theta), fabs(acos(x->high) - x->theta));
  const double by_phi = fabs(phi) * time + swing_phi;
  const double by_psi =
      (fabs(x->u * phi + psi) + reach * fabs(phi)) * time + reach * swing_phi + swing_rest;
  const double psi_off = fabs(psi) * time + fabs(x->u) * swing_phi + swing_rest;
  *attitude = theta + hypot(s_max * by_phi, by_psi);
  *omega = (x->fastest > 0.0 ? x->fastest / s_min : 0.0) +
           fmax(max - x->rate, x->rate - min) * s_max + fabs(x->rate) * (s_max - s_min) +
           fabs(x->rate) * x->s * fmin(2.0, psi_off);
}

/* The error e of u satisfies e'' = -n^2 e + 3/2 beta x^2. With X = max |x|: |e| <= 3/2 beta X^2
 * t/n, and its integral is at most 3 beta X^2 t/n^2. The second derivatives of phi' and u phi' with
 * respect to u are at most |b - a|/(1 - u)^3 + |b + a|/(1 + u)^3. */
static void nutation_errors(const top *x, double t, double *attitude, double *omega) {
  const double wave = hypot(x->centre, x->sway), about = fabs(x->centre) + wave;
  const double low = fmin(x->low, x->u - about), high = fmax(x->high, x->u + about);
  const double reach = fmax(x->high - x->u, x->u - x->low), time = fabs(t);
  *attitude = *omega = INFINITY;
  if (!(low > -1.0 && high < 1.0 && x->n > 0.0)) return;
  double s_min, s_max;
  sines(low, high, &s_min, &s_max);
  const double max_u = fmax(fabs(low), fabs(high)), drive = 1.5 * x->beta * reach * reach;
  const double e = fmin(drive * time / x->n, reach + about);
  const double e_rate = fmin(drive * time, x->fastest + x->n * wave);
  const double sum = fmin(2.0 * drive * time / (x->n * x->n), e * time);
  const double curve =
      0.5 * reach * reach *
      (fabs(x->b_minus_a) / pow(1.0 - high, 3.0) + fabs(x->b_plus_a) / pow(1.0 + low, 3.0));
  const double by_phi = fabs(x->phi_slope) * sum + curve * time;
  const double by_psi = fabs(x->psi_turn) * sum + curve * time;
  const double fast = x->n * wave, phi_max = fabs(x->phi_rate) + fabs(x->phi_slope) * about;
  const double tilt = e * max_u / s_min;
  *attitude = e / s_min + by_phi + by_psi;
  *omega = e_rate / s_min + fast * tilt / (s_min * s_min) +
           (fabs(x->phi_slope) * e + curve) * s_max + phi_max * tilt +
           (fast / s_min + phi_max * s_max) * fmin(2.0, by_psi);
}

static void errors_at(const top *x, double t, double *attitude, double *omega) {
  if (x->nutates) {
    nutation_errors(x, t, attitude, omega);
  } else {
    precession_errors(x, t, attitude, omega);
  }
  /* rounding of the angles, and of phi' by cancellation */
  const double turned = (fabs(x->omega3) + fabs(x->a) / (x->s * x->s)) * fabs(t);
  *attitude += 16.0 * ROT_EPS * (4.0 + turned);
  *omega += 16.0 * ROT_EPS * (fabs(x->omega3) + fabs(x->a) / x->s);
  if (!(*attitude >= 0.0)) *attitude = INFINITY;
  if (!(*omega >= 0.0)) *omega = INFINITY;
}

static double bound(const rot_free_params *p, int nutates, double t) {
  top x;
  rot_info info;
  double attitude, omega;
  rot_info_clear(&info, rot_free_measures);
  if (begin(p, nutates, &x) != ROT_OK || x.omega3 == 0.0) return INFINITY;
  double w[3], q[4];
  rot_free_principal(p, w, q);
  errors_at(&x, t, &attitude, &omega);
  rot_free_note(p, w, attitude, omega, &info);
  return rot_info_error(&info);
}

double rot_pivot_precession_bound(const rot_free_params *p, double t) { return bound(p, 0, t); }
double rot_pivot_nutation_bound(const rot_free_params *p, double t) { return bound(p, 1, t); }

/* ---- rows ------------------------------------------------------------------------------------ */

/* (constants, i) => row i, its errors. */
static rot_status write_row(void *model, size_t i) {
  static const double back_over[4] = {0.0, -1.0, 0.0, 0.0};
  const top *x = model;
  const double *turn = rot_pivot_turns[x->axis];
  const double back[4] = {turn[0], -turn[1], -turn[2], -turn[3]};
  const double t = x->time_s[i] - x->p->start_s;
  double theta = x->theta, phi = x->phi + x->rate * t, s = x->s;
  double psi = x->psi + (x->omega3 - x->u * x->rate) * t;
  double theta_rate = 0.0, phi_rate = x->rate;
  if (x->nutates) {
    const double angle = x->n * t, half = sin(0.5 * angle), versine = 2.0 * half * half;
    const double sway = sin(angle);
    const double off = x->centre * versine + x->sway * sway;
    const double rate = x->n * (x->centre * sway + x->sway * cos(angle));
    const double sum = x->centre * (t - sway / x->n) + x->sway / x->n * versine;
    theta = acos(fmin(1.0, fmax(-1.0, x->u + off)));
    s = sin(theta);
    theta_rate = -rate / s;
    phi_rate = x->phi_rate + x->phi_slope * off;
    phi = x->phi + x->phi_rate * t + x->phi_slope * sum;
    psi = x->psi + (x->omega3 - x->u * x->phi_rate) * t - x->psi_turn * sum;
  }
  const double up = cos(0.5 * theta), down = sin(0.5 * theta);
  double q[4] = {up * cos(0.5 * (phi + psi)), down * cos(0.5 * (phi - psi)),
                 down * sin(0.5 * (phi - psi)), up * sin(0.5 * (phi + psi))};
  double w[3] = {phi_rate * s * sin(psi) + theta_rate * cos(psi),
                 phi_rate * s * cos(psi) - theta_rate * sin(psi), x->omega3};
  double omega[3], attitude_error, omega_error;
  if (x->hangs) {
    rot_attitude_times(q, back_over, q);
    w[1] = -w[1];
    w[2] = -w[2];
  }
  rot_attitude_times(q, back, q);
  (void)rot_attitude_unit(q);
  for (int k = 0; k < 3; k++) omega[(x->axis + 1 + k) % 3] = w[k];
  errors_at(x, t, &attitude_error, &omega_error);
  rot_free_note(x->p, omega, fmin(attitude_error, 3.2), omega_error, x->info);
  return rot_free_write(x->p, omega, q, i, x->out);
}

static rot_status rows(const rot_free_params *p, int nutates, size_t n, const double time_s[],
                       const rot_free_columns *out, const rot_hooks *hooks, rot_info *info) {
  static const rot_stepping stepping = {NULL, NULL, NULL, write_row, NULL};
  top x;
  double omega[3], q[4];
  rot_info_clear(info, rot_free_measures);
  info->status = begin(p, nutates, &x);
  if (info->status != ROT_OK) return info->status;
  x.time_s = time_s;
  x.out = out;
  x.info = info;
  rot_free_principal(p, omega, q);
  rot_free_note(p, omega, 0.0, 0.0, info);
  return rot_step_rows(&stepping, &x, p->start_s, n, time_s, hooks, info);
}

rot_status rot_pivot_precession(const rot_free_params *p, size_t n, const double time_s[],
                                const rot_free_columns *out, rot_events *events,
                                const rot_hooks *hooks, rot_info *info) {
  (void)events;
  return rows(p, 0, n, time_s, out, hooks, info);
}

rot_status rot_pivot_small_nutation(const rot_free_params *p, size_t n, const double time_s[],
                                    const rot_free_columns *out, rot_events *events,
                                    const rot_hooks *hooks, rot_info *info) {
  (void)events;
  return rows(p, 1, n, time_s, out, hooks, info);
}
