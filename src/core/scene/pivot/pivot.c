#include "scene/pivot/pivot.h"

#include <math.h>

#include "maths/attitude.h"
#include "ground/real.h"
#include "scene/free/rotors.h"
#include "engine/stepping.h"
#include "scene/pivot/top_motion.h"

/* Tolerance on the difference of the moments across the axis: their rounding. */
#define ALIKE (16.0 * ROT_EPS)

const double rot_pivot_turns[3][4] = {
    {0.5, 0.5, 0.5, 0.5}, {0.5, -0.5, -0.5, -0.5}, {1.0, 0.0, 0.0, 0.0}};

int rot_pivot_axis(const rot_free_params *p) {
  for (int k = 0; k < 3; k++) {
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    const double a = p->moment_kg_m2[i], b = p->moment_kg_m2[j], *g = p->lever_n_m;
    const double max = fabs(g[k]) * (p->turned ? 8.0 * ROT_EPS : 0.0);
    if (fabs(g[i]) <= max && fabs(g[j]) <= max && g[k] != 0.0 && fabs(a - b) <= ALIKE * a) {
      return k;
    }
  }
  return -1;
}

/* 1 if all rotors are along axis k, else 0. */
static int along(const rot_free_rotors *r, int k) {
  const double max = r->p->turned ? 8.0 * ROT_EPS : 0.0;
  for (size_t i = 0; i < r->n; i++) {
    if (!(fabs(r->axis[i][(k + 1) % 3]) <= max && fabs(r->axis[i][(k + 2) % 3]) <= max)) return 0;
  }
  return 1;
}

/* => angular momentum of rotors along axis k, relative to the body */
static rot_dd wheels_of(const rot_free_rotors *r, int k) {
  rot_dd sum = {0.0, 0.0};
  for (size_t i = 0; i < r->p->n_rotors; i++) { /* with constant speeds, like omega3 */
    const rot_free_rotor *one = &r->p->rotors[i];
    const rot_dd spin = rot_dd_mul2(one->moment_kg_m2, one->omega_rad_per_s);
    sum = rot_dd_add(sum, r->axis[i][k] < 0.0 ? rot_dd_neg(spin) : spin);
  }
  return sum;
}

/* => 0, or the power of 4 by which gravity is below the range of rot_top_begin(). */
static int excess(const rot_free_params *p, int k, const double omega[3], double wheels) {
  const double fastest = fmax(fabs(omega[0]), fmax(fabs(omega[1]), fabs(omega[2])));
  return rot_top_excess(p->moment_kg_m2[(k + 1) % 3], p->lever_n_m[k], wheels, fastest);
}

/* 1 if the angular momentum turns the body across its axis by at least 1e-12 of its fastest rate.
 * Then gravity that is below the range of rot_top_begin(), or at its limit, changes the motion by
 * less than 1e-36 of the angle turned: less than rounding. */
static int turns_over(const rot_free_params *p, int k, const double omega[3], double wheels) {
  const int i = (k + 1) % 3, j = (k + 2) % 3;
  const double moment = p->moment_kg_m2[i];
  const double axial = fabs(p->moment_kg_m2[k] / moment * omega[k] + wheels / moment);
  const double turns = fmax(fmax(fabs(omega[i]), fabs(omega[j])), axial);
  return turns >= 1e-12 * fmax(fabs(omega[k]), fabs(wheels / moment));
}

const char *rot_pivot_not_top(const rot_free_params *p) {
  const int k = rot_pivot_axis(p);
  double w[3], q[4], wheels = 0.0;
  rot_free_rotors rotors;
  if (k < 0) return "it is no symmetric top";
  if (p->n_rotors) {
    const char *why = rot_free_rotors_begin(p, &rotors);
    if (why) return why;
    if (!along(&rotors, k)) return "the rotors are not along the axis of symmetry";
    wheels = wheels_of(&rotors, k).hi;
  }
  rot_free_principal(p, w, q);
  return excess(p, k, w, wheels) && !turns_over(p, k, w, wheels)
             ? "gravity is below 1e-60 of the squares of its rates"
             : NULL;
}

void rot_pivot_sharpen(rot_free_params *p, double mass_kg, double gravity_m_per_s2,
                       const double centre_m[3]) {
  int e_mass, e_gravity;
  const double mass = frexp(mass_kg, &e_mass), gravity = frexp(gravity_m_per_s2, &e_gravity);
  const rot_dd weight = rot_dd_mul2(mass, gravity);
  for (int k = 0; k < 3; k++) {
    int e;
    const double centre = frexp(centre_m[k], &e);
    const rot_dd product = rot_dd_mul1(weight, centre);
    e += e_mass + e_gravity;
    if (p->turned) {
      p->own_lever_n_m[0][k] = ldexp(product.hi, e);
      p->own_lever_n_m[1][k] = ldexp(product.lo, e);
      continue;
    }
    const double scaled = ldexp(p->lever_n_m[k], -e), low = rot_dd_add1(product, -scaled).hi;
    const int rounded = fabs(low) <= 4.0 * ROT_EPS * fabs(scaled);
    p->lever_low_n_m[k] = rounded ? ldexp(low, e) : 0.0;
  }
}

typedef struct run {
  const rot_free_params *p;
  rot_top_motion motion;
  rot_free_rotors rotors;
  int lifted;     /* power of 4 of gravity in `motion` over that of `p`, without effect */
  int axis;       /* of symmetry, 0 to 2; top's axes 1, 2, 3: axis + 1, axis + 2, axis (mod 3) */
  double turn[4]; /* v_principal = turn v_top turn* */
  const double *time_s;
  const rot_free_columns *out;
  rot_info *info;
} run;

/* (omega, q) in principal axes => initial state of the top: q turn, exact (halves of sums, in twice
 * the precision). */
static void begin_start(const run *r, const double omega[3], const double q[4],
                        rot_top_start *out) {
  static const int at[4][4] = {{0, 1, 2, 3}, {1, 0, 3, 2}, {2, 3, 0, 1}, {3, 2, 1, 0}};
  static const double sign[4][4] = {
      {1.0, -1.0, -1.0, -1.0}, {1.0, 1.0, -1.0, 1.0}, {1.0, 1.0, 1.0, -1.0}, {1.0, -1.0, 1.0, 1.0}};
  for (int i = 0; i < 3; i++) out->omega[i] = (rot_dd){omega[(r->axis + 1 + i) % 3], 0.0};
  for (int i = 0; i < 4; i++) {
    rot_dd sum = {0.0, 0.0};
    for (int j = 0; j < 4; j++) {
      /* component i: sum of q_j times component at[i][j] of the turn, or the reverse */
      sum = rot_dd_add1(sum, sign[i][j] * r->turn[j] * q[at[i][j]]);
    }
    out->q[i] = sum;
  }
}

/* parameters => motion, rotors, errors of the start. */
static rot_status begin(const rot_free_params *p, run *r) {
  const int k = rot_pivot_axis(p);
  double omega[3], q[4];
  rot_top_start start;
  rot_dd wheels = {0.0, 0.0};
  if (k < 0) return ROT_EVALUE;
  if (p->n_rotors && (rot_free_rotors_begin(p, &r->rotors) || !along(&r->rotors, k))) {
    return ROT_EVALUE;
  }
  if (p->n_rotors) wheels = wheels_of(&r->rotors, k);
  r->p = p;
  r->axis = k;
  for (int i = 0; i < 4; i++) r->turn[i] = rot_pivot_turns[k][i];
  rot_free_principal(p, omega, q);
  begin_start(r, omega, q, &start);
  const double a = p->moment_kg_m2[(k + 1) % 3], b = p->moment_kg_m2[(k + 2) % 3];
  const double uneven = fmax(p->given, fabs(a - b) / a);
  const double given = p->turned ? fmax(uneven, 4.0 * ROT_EPS) : uneven;
  const int by = excess(p, k, omega, wheels.hi);
  const rot_dd weight = rot_dd_ldexp(rot_dd_sum2(p->lever_n_m[k], p->lever_low_n_m[k]), 2 * by);
  if (by && !(turns_over(p, k, omega, wheels.hi) && isfinite(weight.hi))) return ROT_ERANGE;
  r->lifted = by;
  const rot_status status =
      rot_top_begin_wheels(a, p->moment_kg_m2[k], weight, wheels, &start, given, &r->motion);
  if (status != ROT_OK) return status;
  /* The attitude is rounded in four components. A rotation about the vertical changes no rate. */
  for (int i = 0; i < 4; i++) {
    rot_top_motion other;
    double near[4] = {q[0], q[1], q[2], q[3]};
    if (q[i] == 0.0 || fabs(q[i]) == 1.0) continue;
    near[i] *= 1.0 + 4.0 * ROT_EPS;
    begin_start(r, omega, near, &start);
    if (rot_top_begin_wheels(a, p->moment_kg_m2[k], weight, wheels, &start, given, &other) ==
        ROT_OK) {
      rot_top_differ(&r->motion, &other);
    }
  }
  return ROT_OK;
}

static void note(const run *r, const double omega[3], double angle_error, double omega_error) {
  if (r->p->n_rotors) {
    rot_free_rotors_note(&r->rotors, omega, angle_error, omega_error, r->info);
  } else {
    rot_free_note(r->p, omega, angle_error, omega_error, r->info);
  }
}

static rot_status write_row(void *model, size_t i) {
  const run *r = model;
  const rot_dd t = rot_dd_sum2(r->time_s[i], -r->p->start_s);
  const double back[4] = {r->turn[0], -r->turn[1], -r->turn[2], -r->turn[3]};
  double q[4], omega[3];
  rot_top_state at;
  rot_top_at(&r->motion, t, &at);
  rot_attitude_times(at.q, back, q);
  (void)rot_attitude_unit(q);
  for (int k = 0; k < 3; k++) omega[(r->axis + 1 + k) % 3] = at.omega[k];
  note(r, omega, at.q_error + 4.0 * ROT_EPS, at.omega_error);
  const rot_status status = rot_free_write(r->p, omega, q, i, r->out);
  if (status != ROT_OK || !r->p->n_rotors) return status;
  return rot_free_rotors_write(&r->rotors, omega, q, r->rotors.start, i, r->out);
}

/* motion => events at the times where lambda t + start is a multiple of K. */
static rot_status log_turns(const run *r, size_t n, const double time_s[], rot_events *events) {
  const rot_top_motion *m = &r->motion;
  if (!n || m->weightless || m->steady || m->jacobi.m1 == 0.0) return ROT_OK;
  const double from = fmin(time_s[0], r->p->start_s), to = fmax(time_s[n - 1], r->p->start_s);
  const double rate = ldexp(m->lambda.hi, m->exponent), k = m->jacobi.k.hi;
  const double first = floor((rate * (from - r->p->start_s) + m->start.hi) / k);
  const double last = ceil((rate * (to - r->p->start_s) + m->start.hi) / k);
  if (!(last - first <= ROT_FREE_MAX_FLIPS)) return ROT_OK;
  for (double j = first; j <= last; j++) {
    const rot_dd u = rot_dd_sub(rot_dd_mul1(m->jacobi.k, j), m->start);
    const rot_dd s = rot_dd_ldexp(rot_dd_div(u, m->lambda), -m->exponent);
    const double t = rot_dd_add1(s, r->p->start_s).hi;
    const int high = fmod(j, 2.0) != 0.0; /* sn = 1: the centre of mass is highest */
    if (!(t >= from && t <= to)) continue;
    const rot_status status =
        rot_events_add(events, t, high ? ROT_EVENT_HIGHEST : ROT_EVENT_LOWEST);
    if (status != ROT_OK) return status;
  }
  return ROT_OK;
}

rot_status rot_pivot_top(const rot_free_params *p, size_t n, const double time_s[],
                         const rot_free_columns *out, rot_events *events, const rot_hooks *hooks,
                         rot_info *info) {
  static const rot_stepping stepping = {NULL, NULL, NULL, write_row, NULL};
  run r = {.time_s = time_s, .out = out, .info = info};
  double omega[3], q[4];
  rot_info_clear(info, rot_free_measures);
  info->status = begin(p, &r);
  if (info->status != ROT_OK) return info->status;
  rot_free_principal(p, omega, q);
  note(&r, omega, 0.0, 0.0);
  const rot_status status = rot_step_rows(&stepping, &r, p->start_s, n, time_s, hooks, info);
  return status == ROT_OK ? info->status = log_turns(&r, n, time_s, events) : status;
}

void rot_pivot_lever(const rot_free_params *p, const double q[4], double lever[3]) {
  double own[3] = {p->lever_n_m[0], p->lever_n_m[1], p->lever_n_m[2]};
  if (p->turned) rot_attitude_to_space(p->axes, p->lever_n_m, own);
  rot_attitude_to_space(q, own, lever);
}

int rot_pivot_is_driven(const rot_free_params *p) {
  return p->law || p->n_knots || p->damping_per_s != 0.0 || p->torque[0] != 0.0 ||
         p->torque[1] != 0.0 || p->torque[2] != 0.0;
}

/* 1 if the body is driven or has motors, else 0. */
static int acts(const rot_free_params *p) {
  int found = rot_pivot_is_driven(p) || p->motors;
  /* A rotor of constant speed is part of the closed form. */
  for (size_t i = 0; i < p->n_rotors; i++) {
    found |= p->rotors[i].torque != 0.0 || p->rotors[i].n_knots;
  }
  return found;
}

rot_status rot_pivot_nutation(const rot_free_params *p, double out[3]) {
  run r;
  if (acts(p)) return ROT_EVALUE;
  const rot_status status = begin(p, &r);
  if (status != ROT_OK) return status;
  if (r.lifted) return ROT_ERANGE;
  const rot_top_nutation n = rot_top_nutates(&r.motion);
  out[0] = n.period_s;
  out[1] = n.amplitude_rad;
  out[2] = n.precession_rad_per_s;
  return ROT_OK;
}

/* The line is that of the rotation, at rest that of the torque, of a top without torque any across
 * its axis. It must be a horizontal principal axis with the centre of mass beside it. */
int rot_pivot_plane(const rot_free_params *p, rot_pivot_pendulum *out) {
  static const double down_space[3] = {0.0, 0.0, -1.0};
  const double *m = p->moment_kg_m2, *g = p->lever_n_m, weight = rot_length(g);
  const double max = fmax(m[0], fmax(m[1], m[2]));
  double w[3], q[4], down[3], torque[3], line[3], off = 0.0;
  if (acts(p) || p->n_rotors || weight == 0.0) return 0;
  rot_free_principal(p, w, q);
  rot_attitude_to_body(q, down_space, down);
  rot_cross(g, down, torque);
  const int axis = rot_pivot_axis(p), turns = rot_length(w) > 0.0,
            pulled = rot_length(torque) > 0.0;
  if (!turns && !pulled && axis < 0) return 0;
  for (int i = 0; i < 3; i++) line[i] = turns ? w[i] : pulled ? torque[i] : i == (axis + 1) % 3;
  const double length = rot_length(line);
  for (int i = 0; i < 3; i++) line[i] /= length;
  out->moment_kg_m2 =
      m[0] * line[0] * line[0] + m[1] * line[1] * line[1] + m[2] * line[2] * line[2];
  for (int i = 0; i < 3; i++) {
    off = fmax(off, fabs((m[i] - out->moment_kg_m2) * line[i]) / max);
  }
  off = fmax(off, fmax(fabs(rot_dot(line, g)) / weight,
                       turns || pulled ? fabs(rot_dot(line, down)) : 0.0));
  if (!(off <= ALIKE)) return 0;
  const double sign = rot_dot(g, down) < 0.0 ? -1.0 : 1.0;
  out->weight_n_m = sign * weight;
  out->angle_rad = atan2(-sign * rot_dot(line, torque), sign * rot_dot(g, down));
  out->omega_rad_per_s = rot_dot(line, w);
  return 1;
}
