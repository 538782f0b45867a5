#include "scene/free/exact.h"

#include <math.h>

#include "ground/real.h"
#include "maths/attitude.h"
#include "scene/free/motion.h"
#include "engine/stepping.h"

static const double pi = 0x1.921fb54442d18p+1;

typedef struct run {
  const rot_free_params *p;
  rot_free_motion motion;
  double q0[4]; /* attitude of the principal axes at the start */
  const double *time_s;
  const rot_free_columns *out;
  rot_info *info;
} run;

static rot_status begin(const rot_free_params *p, run *out) {
  double omega[3];
  out->p = p;
  rot_free_principal(p, omega, out->q0);
  return rot_free_begin(p->moment_kg_m2, omega,
                        p->turned ? fmax(p->given, 4.0 * ROT_EPS) : p->given, &out->motion);
}

const char *rot_free_not_exact(const rot_free_params *p) {
  run r;
  switch (begin(p, &r)) {
  case ROT_OK: return NULL;
  case ROT_ERANGE: return "its moments of inertia are too far apart, or two of them too close";
  default: return "it spins about an axis without moment of inertia";
  }
}

/* (motion, i) => row i, its errors. */
static rot_status write_row(void *model, size_t i) {
  const run *r = model;
  const rot_free_params *p = r->p;
  const double damping = p->damping_per_s;
  const rot_dd t = rot_dd_sum2(r->time_s[i], -p->start_s);
  rot_free_state at;
  double q[4], fade = 1.0, late = 0.0;
  if (damping == 0.0) {
    rot_free_at(&r->motion, t, &at);
  } else {
    const double s = -expm1(-damping * t.hi) / damping;
    if (!isfinite(s)) return ROT_ERANGE;
    rot_free_at(&r->motion, (rot_dd){s, 0.0}, &at);
    fade = exp(-damping * t.hi);
    /* rounding of s and of its argument */
    late = ROT_EPS * (4.0 * fabs(s) + 2.0 * fabs(t.hi) * fade) *
           rot_ldexp(r->motion.rate, r->motion.exponent);
    for (int k = 0; k < 3; k++) at.omega[k] *= fade;
  }
  rot_attitude_times(r->q0, at.q, q);
  (void)rot_attitude_unit(q);
  const double size = rot_length(at.omega);
  const double omega_error =
      fade * at.omega_error +
      (damping == 0.0 ? 0.0 : size * (late + ROT_EPS * (4.0 + 2.0 * fabs(damping * t.hi))));
  rot_free_note(p, at.omega, at.q_error + late + 8.0 * ROT_EPS, omega_error, r->info);
  return rot_free_write(p, at.omega, q, i, r->out);
}

/* Time of the k-th zero of the rate about the middle axis, in s of the scene; NaN: never. */
static double flip_at(const run *r, double k) {
  const rot_free_motion *m = &r->motion;
  const double damping = r->p->damping_per_s;
  const rot_dd u = rot_dd_sub(rot_dd_mul1(rot_dd_ldexp(m->jacobi.k, 1), k), m->start);
  const rot_dd s = rot_dd_ldexp(rot_dd_div(u, m->lambda), -m->exponent);
  if (damping == 0.0) return rot_dd_add1(s, r->p->start_s).hi;
  const double x = damping * s.hi;
  return x < 1.0 ? r->p->start_s - log1p(-x) / damping : NAN;
}

static double phase_of(const run *r, double time_s) {
  const double damping = r->p->damping_per_s;
  double t = time_s - r->p->start_s;
  if (damping != 0.0) t = -expm1(-damping * t) / damping;
  return ldexp(t, r->motion.exponent) * r->motion.lambda.hi + r->motion.start.hi;
}

/* motion => events at the zeros between the first and the last row. */
static rot_status log_flips(const run *r, size_t n, const double time_s[], rot_events *events) {
  const rot_free_motion *m = &r->motion;
  if (!n || m->still || m->steady || m->jacobi.m1 == 0.0 ||
      !rot_free_flips(r->p->moment_kg_m2, m->omega0)) {
    return ROT_OK;
  }
  const double from = fmin(time_s[0], r->p->start_s), to = fmax(time_s[n - 1], r->p->start_s);
  const double period = 2.0 * m->jacobi.k.hi;
  const double first = floor(phase_of(r, from) / period), last = ceil(phase_of(r, to) / period);
  if (!(last - first <= ROT_FREE_MAX_FLIPS)) return ROT_OK;
  for (double k = first; k <= last; k++) {
    const double t = flip_at(r, k);
    if (!(t >= from && t <= to)) continue;
    const rot_status status = rot_events_add(events, t, ROT_EVENT_FLIP);
    if (status != ROT_OK) return status;
  }
  return ROT_OK;
}

rot_status rot_free_exact(const rot_free_params *p, size_t n, const double time_s[],
                          const rot_free_columns *out, rot_events *events, const rot_hooks *hooks,
                          rot_info *info) {
  static const rot_stepping stepping = {NULL, NULL, NULL, write_row, NULL};
  run r = {.time_s = time_s, .out = out, .info = info};
  rot_info_clear(info, rot_free_measures);
  info->status = begin(p, &r);
  if (info->status != ROT_OK) return info->status;
  rot_free_note(p, r.motion.omega0, 0.0, 0.0, info);
  const rot_status status = rot_step_rows(&stepping, &r, p->start_s, n, time_s, hooks, info);
  return status == ROT_OK ? info->status = log_flips(&r, n, time_s, events) : status;
}

/* From the decay of the energy, exp(-2 damping t), and of L, exp(-damping t). */
void rot_free_flows(const rot_free_params *p, double from_s, double to_s,
                    double flow[ROT_FREE_FLOWS]) {
  double omega[3], q[4], l[3], space[3], energy = 0.0;
  rot_free_principal(p, omega, q);
  for (int i = 0; i < 3; i++) {
    l[i] = p->moment_kg_m2[i] * omega[i];
    energy += 0.5 * l[i] * omega[i];
  }
  rot_attitude_to_space(q, l, space);
  const double before = p->damping_per_s * (from_s - p->start_s);
  const double during = p->damping_per_s * (to_s - from_s);
  for (int i = 0; i < ROT_FREE_FLOWS; i++) flow[i] = 0.0;
  if (p->damping_per_s == 0.0) return;
  flow[1] = -energy * exp(-2.0 * before) * expm1(-2.0 * during);
  for (int i = 0; i < 3; i++) flow[5 + i] = space[i] * exp(-before) * expm1(-during);
}

double rot_free_period(const rot_free_params *p, rot_free_cycle *cycle) {
  run r;
  rot_free_cycle own = ROT_FREE_STILL;
  double period = NAN;
  if (begin(p, &r) == ROT_OK && !r.motion.still) {
    const double half = rot_free_half_period(&r.motion);
    if (half < INFINITY) {
      own = ROT_FREE_WOBBLE;
      period = 2.0 * half;
    } else if (r.motion.steady) {
      own = ROT_FREE_ROTATION;
      period = 2.0 * pi / rot_length(p->omega0_rad_per_s);
    } else {
      own = ROT_FREE_SEPARATRIX;
      period = INFINITY;
    }
  }
  if (cycle) *cycle = own;
  return period;
}

rot_status rot_free_flip_time(const double moment_kg_m2[3], const double omega_rad_per_s[3],
                              double *time_s) {
  rot_free_motion motion;
  const rot_status status = rot_free_begin(moment_kg_m2, omega_rad_per_s, 0.0, &motion);
  *time_s = status == ROT_OK ? rot_free_half_period(&motion) : NAN;
  return status;
}
