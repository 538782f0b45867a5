#include "scene/free/steps.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "engine/ode/fixed.h"
#include "maths/attitude.h"
#include "scene/free/rotors.h"
#include "scene/free/torque.h"
#include "ground/real.h"

#define PI 3.14159265358979323846

/* State: q since the start, in the principal axes at the start: a motion of 1e-9 rad about a
 * tilted rest keeps its digits; L in principal axes; flows since the start, along the axes at the
 * start (without the work of gravity, which follows from the height); momenta of the rotors that
 * are not driven. Rows have q and flows in space. */
enum { MOMENTUM = 4, STATE = 7, ROTORS = STATE + ROT_FREE_FLOWS };
enum { MAX = ROTORS + ROT_FREE_MAX_ROTORS };
enum { WORK = STATE, HEAT, TORQUE_IMPULSE, DAMPING_IMPULSE = TORQUE_IMPULSE + 3 };
enum { MOTOR_WORK = STATE + ROT_FREE_MOTOR_WORK };

typedef struct stepper {
  const rot_free_params *p;
  rot_free_rotors rotors;
  size_t dim; /* number of components */
  rot_method method;
  int a, b, c;             /* axes of the splitting */
  double per_a;            /* 1/Ia */
  double gap[2];           /* 1/Ib - 1/Ia, 1/Ic - 1/Ia */
  double against[3];       /* h/I of the rotors */
  double earliest, latest; /* limits of the times at which torques are evaluated: the breaks */
  double q0[4];            /* attitude of the principal axes at the start */
  double l0[3];            /* L at the start */
  int weight;              /* 1: gravity acts */
  rot_free_hung hung;
  size_t steps, calls;
} stepper;

/* ---- slopes ---------------------------------------------------------------------------------- */

static void omega_of(const stepper *s, const double y[], double omega[3]) {
  rot_free_rotors_omega(&s->rotors, y + MOMENTUM, y + ROTORS, omega);
}

/* (q since the start) => attitude; only laws and torques in space read it. */
static void attitude_of(const stepper *s, const double q[4], double attitude[4]) {
  rot_attitude_times(s->q0, q, attitude);
}

/* (t, omega, q) => torque with and without gravity, in body axes. */
static rot_status torques(stepper *s, double t, const double omega[3], const double q[4],
                          double all[3], double own[3]) {
  const double at = fmin(fmax(t, s->earliest), s->latest);
  double attitude[4] = {1.0, 0.0, 0.0, 0.0};
  s->calls++;
  if (s->p->law || s->p->in_space) attitude_of(s, q, attitude);
  const rot_status status = rot_free_torque(s->p, at, omega, attitude, own);
  if (status != ROT_OK) return status;
  if (s->weight && !s->p->law) {
    return rot_free_torque_hung(s->p, &s->hung, at, omega, attitude, q, all);
  }
  for (int k = 0; k < 3; k++) all[k] = own[k];
  if (s->weight) rot_free_add_hung(s->p, &s->hung, q, all); /* without a further call of the law */
  return ROT_OK;
}

/* Rates of the momenta of the rotors, power of their motors. */
static rot_status motors(stepper *s, double t, const double omega[3], const double q[4],
                         const double y[], double f[]) {
  const double at = fmin(fmax(t, s->earliest), s->latest);
  double attitude[4];
  attitude_of(s, q, attitude);
  return rot_free_rotors_slopes(&s->rotors, at, omega, attitude, y + ROTORS, f + ROTORS,
                                &f[MOTOR_WORK]);
}

/* (t, state) => rates of the state. */
static rot_status slopes(stepper *s, double t, const double y[], double f[]) {
  const double *l = y + MOMENTUM, damping = s->p->damping_per_s;
  double w[3], all[3], own[3], unit[4] = {y[0], y[1], y[2], y[3]};
  omega_of(s, y, w);
  (void)rot_attitude_unit(unit);
  const rot_status status = torques(s, t, w, unit, all, own);
  if (status != ROT_OK) return status;
  f[0] = 0.5 * (-y[1] * w[0] - y[2] * w[1] - y[3] * w[2]);
  f[1] = 0.5 * (y[0] * w[0] + y[2] * w[2] - y[3] * w[1]);
  f[2] = 0.5 * (y[0] * w[1] + y[3] * w[0] - y[1] * w[2]);
  f[3] = 0.5 * (y[0] * w[2] + y[1] * w[1] - y[2] * w[0]);
  f[4] = l[1] * w[2] - l[2] * w[1] + all[0] - damping * l[0];
  f[5] = l[2] * w[0] - l[0] * w[2] + all[1] - damping * l[1];
  f[6] = l[0] * w[1] - l[1] * w[0] + all[2] - damping * l[2];
  f[WORK] = own[0] * w[0] + own[1] * w[1] + own[2] * w[2];
  f[HEAT] = damping * (l[0] * w[0] + l[1] * w[1] + l[2] * w[2]);
  rot_attitude_to_space(unit, all, f + TORQUE_IMPULSE);
  rot_attitude_to_space(unit, l, f + DAMPING_IMPULSE);
  for (int k = 0; k < 3; k++) f[DAMPING_IMPULSE + k] *= -damping;
  f[MOTOR_WORK] = 0.0;
  return s->rotors.n ? motors(s, t, w, unit, y, f) : ROT_OK;
}

/* ---- steps ----------------------------------------------------------------------------------- */

static rot_status euler(stepper *s, double t, double h, double y[]) {
  double f[MAX];
  const rot_status status = slopes(s, t, y, f);
  for (size_t k = 0; status == ROT_OK && k < s->dim; k++) y[k] += h * f[k];
  (void)rot_attitude_unit(y);
  return status;
}

static rot_status rk4(stepper *s, double t, double h, double y[]) {
  static const double node[4] = {0.0, 0.5, 0.5, 1.0}, weight[4] = {1.0, 2.0, 2.0, 1.0};
  double f[MAX] = {0.0}, at[MAX], sum[MAX] = {0.0};
  for (int stage = 0; stage < 4; stage++) {
    for (size_t k = 0; k < s->dim; k++) at[k] = y[k] + h * node[stage] * f[k];
    const rot_status status = slopes(s, t + h * node[stage], at, f);
    if (status != ROT_OK) return status;
    for (size_t k = 0; k < s->dim; k++) sum[k] += weight[stage] * f[k];
  }
  for (size_t k = 0; k < s->dim; k++) y[k] += h / 6.0 * sum[k];
  (void)rot_attitude_unit(y);
  return ROT_OK;
}

/* q after a rotation by a vector in body axes. */
static void turn_by(const double v[3], double q[4]) {
  const double angle = sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
  const double part = angle > 1e-150 ? sin(0.5 * angle) / angle : 0.5;
  const double turn[4] = {cos(0.5 * angle), part * v[0], part * v[1], part * v[2]};
  rot_attitude_times(q, turn, q);
}

/* One step: L in space, then q with the new rate. */
static rot_status semi_implicit(stepper *s, double t, double h, double y[]) {
  const double damping = s->p->damping_per_s;
  double w[3], all[3], own[3], l[3], torque[3], turn[3];
  omega_of(s, y, w);
  const rot_status status = torques(s, t, w, y, all, own);
  if (status != ROT_OK) return status;
  rot_attitude_to_space(y, all, torque);
  for (int k = 0; k < 3; k++) {
    /* from the start: the rounding of rotations does not accumulate */
    l[k] = s->l0[k] + y[TORQUE_IMPULSE + k] + y[DAMPING_IMPULSE + k];
    y[TORQUE_IMPULSE + k] += h * torque[k];
    y[DAMPING_IMPULSE + k] -= h * damping * l[k];
    l[k] = s->l0[k] + y[TORQUE_IMPULSE + k] + y[DAMPING_IMPULSE + k];
  }
  if (s->rotors.n) {
    double f[MAX];
    const rot_status of_motors = motors(s, t, w, y, y, f);
    if (of_motors != ROT_OK) return of_motors;
    for (size_t k = 0; k < s->rotors.n_states; k++) y[ROTORS + k] += h * f[ROTORS + k];
    y[MOTOR_WORK] += h * f[MOTOR_WORK];
  }
  rot_attitude_to_body(y, l, y + MOMENTUM);
  omega_of(s, y, w);
  for (int k = 0; k < 3; k++) {
    turn[k] = h * w[k];
    y[WORK] += h * own[k] * w[k];
    y[HEAT] += h * damping * y[MOMENTUM + k] * w[k];
  }
  turn_by(turn, y);
  (void)rot_attitude_unit(y);
  rot_attitude_to_body(y, l, y + MOMENTUM);
  return ROT_OK;
}

/* Flow of gravity for a time h: the body does not move. */
static void kick(stepper *s, double h, double y[]) {
  double torque[3] = {0.0, 0.0, 0.0}, space[3];
  if (!s->weight) return;
  rot_free_add_hung(s->p, &s->hung, y, torque);
  s->calls++;
  for (int k = 0; k < 3; k++) y[MOMENTUM + k] += h * torque[k];
  rot_attitude_to_space(y, torque, space);
  for (int k = 0; k < 3; k++) y[TORQUE_IMPULSE + k] += h * space[k];
}

/* Flow of gap L_axis^2/2 for a time h: rotation about one body axis; L in space is conserved. */
static void turn_about(int axis, double gap, double h, double y[]) {
  double *l = y + MOMENTUM;
  const int i = (axis + 1) % 3, j = (axis + 2) % 3;
  const double angle = h * gap * l[axis], c = cos(angle), d = sin(angle), li = l[i], lj = l[j];
  double turn[4] = {cos(0.5 * angle), 0.0, 0.0, 0.0};
  if (angle == 0.0) return;
  turn[1 + axis] = sin(0.5 * angle);
  rot_attitude_times(y, turn, y);
  l[i] = c * li + d * lj;
  l[j] = c * lj - d * li;
}

/* Flow of -c.L for a time h: rotation of the body by -c; L in space is conserved. */
static void turn_against(const stepper *s, double h, double y[]) {
  double turn[3], back[4] = {1.0, 0.0, 0.0, 0.0};
  for (int k = 0; k < 3; k++) turn[k] = -h * s->against[k];
  turn_by(turn, y);
  turn_by(turn, back);
  rot_attitude_to_body(back, y + MOMENTUM, y + MOMENTUM);
}

/* Symmetric composition of second order of the rotations. */
static void free_flow(const stepper *s, double h, double y[]) {
  const double *l = y + MOMENTUM;
  double turn[3];
  turn_about(s->b, s->gap[0], 0.5 * h, y);
  turn_about(s->c, s->gap[1], s->rotors.n ? 0.5 * h : h, y);
  for (int k = 0; k < 3; k++) turn[k] = h * s->per_a * l[k];
  turn_by(turn, y);
  if (s->rotors.n) {
    turn_against(s, h, y);
    turn_about(s->c, s->gap[1], 0.5 * h, y);
  }
  turn_about(s->b, s->gap[0], 0.5 * h, y);
}

/* One step, composition s9odr6a of Kahan and Li. */
static rot_status split(stepper *s, double t, double h, double y[]) {
  static const double part[9] = {
      0.39216144400731413928,  0.33259913678935943860, -0.70624617255763935981,
      0.082213596293550800230, 0.79854399093482996340, 0.082213596293550800230,
      -0.70624617255763935981, 0.33259913678935943860, 0.39216144400731413928};
  (void)t;
  kick(s, 0.5 * part[0] * h, y);
  for (int i = 0; i < 9; i++) {
    free_flow(s, part[i] * h, y);
    kick(s, 0.5 * (part[i] + (i < 8 ? part[i + 1] : 0.0)) * h, y);
  }
  (void)rot_attitude_unit(y);
  return ROT_OK;
}

static rot_status one_step(stepper *s, double t, double h, double y[]) {
  switch (s->method) {
  case ROT_METHOD_EULER: return euler(s, t, h, y);
  case ROT_METHOD_SEMI_IMPLICIT: return semi_implicit(s, t, h, y);
  case ROT_METHOD_RK4: return rk4(s, t, h, y);
  default: return split(s, t, h, y);
  }
}

const char *rot_free_not_split(const rot_free_params *p) {
  rot_free_rotors r;
  double m[3], h[3];
  if (!p->n_rotors || rot_free_rotors_begin(p, &r) || rot_free_rotors_constant(&r, m, h)) {
    return NULL;
  }
  return "free rotors are not along the principal axes";
}

int rot_free_step_order(rot_method method) {
  return method == ROT_METHOD_RK4 ? 4 : method == ROT_METHOD_SPLIT ? 6 : 1;
}

/* ---- a run ----------------------------------------------------------------------------------- */

/* Ends of steps in front of a row, where the two runs are compared, too: half a swing and more. At
 * the row alone the difference of an oscillation may be next to 0. */
enum { PLACES = 32 };

typedef struct run {
  stepper s;
  double start[MAX];
  double step_s; /* > 0 */
  int parts;     /* of each step and of each row's */
  size_t n, max_steps, rows_done;
  const double *time_s;
  double *y;           /* n rows of s.dim components */
  double *place;       /* states of s.dim components at the ends of steps in front of rows */
  size_t places, room; /* number of them, of those that fit */
  size_t settled;      /* number of places in front of the last row so far */
  const rot_hooks *hooks;
  double largest_omega, largest_momentum, failed_s;
  double from, to; /* progress of this run, as fractions of the total */
} run;

/* Work of gravity since the start: how much lower the lever's end is. */
static double fall_of(const stepper *s, const double q[4]) {
  double side[3], more[3], fall = 0.0;
  rot_cross(q + 1, s->p->lever_n_m, side);
  rot_cross(q + 1, side, more);
  for (int k = 0; k < 3; k++) fall -= 2.0 * s->hung.up[k] * (q[0] * side[k] + more[k]);
  return fall;
}

/* A state of the steps => one in space. */
static void to_space(const stepper *s, double y[]) {
  if (s->weight) y[WORK] += fall_of(s, y);
  rot_attitude_times(s->q0, y, y);
  rot_attitude_to_space(s->q0, y + TORQUE_IMPULSE, y + TORQUE_IMPULSE);
  rot_attitude_to_space(s->q0, y + DAMPING_IMPULSE, y + DAMPING_IMPULSE);
}

static void note_size(run *r, const double y[]) {
  double w[3];
  omega_of(&r->s, y, w);
  r->largest_omega = fmax(r->largest_omega, hypot(hypot(w[0], w[1]), w[2]));
  r->largest_momentum = fmax(r->largest_momentum, hypot(hypot(y[4], y[5]), y[6]));
  r->largest_momentum = fmax(r->largest_momentum, r->s.rotors.size);
  for (size_t k = 0; k < r->s.rotors.n_states; k++) {
    r->largest_momentum = fmax(r->largest_momentum, fabs(y[ROTORS + k]));
  }
}

static int finite_state(const run *r, const double y[]) {
  double sum = 0.0;
  for (size_t k = 0; k < r->s.dim; k++) sum += y[k];
  return isfinite(sum);
}

/* (t, h, state) => the state after h, in its parts. */
static rot_status step_in_parts(run *r, double t, double h, double y[]) {
  const double part = h / r->parts;
  rot_status status = ROT_OK;
  for (int k = 0; k < r->parts && status == ROT_OK; k++) {
    status = one_step(&r->s, t + k * part, part, y);
  }
  return status;
}

/* The last PLACES to 2 PLACES ends of steps since the last row. */
static rot_status keep_place(run *r, const double y[]) {
  const size_t dim = r->s.dim;
  if (r->places - r->settled == 2 * PLACES) {
    double *first = r->place + r->settled * dim;
    memmove(first, first + PLACES * dim, PLACES * dim * sizeof *first);
    r->places -= PLACES;
  }
  if (r->places == r->room) {
    const size_t room = 2 * r->room + 2 * PLACES;
    double *place = realloc(r->place, room * dim * sizeof *place);
    if (!place) return ROT_ENOMEM;
    r->place = place;
    r->room = room;
  }
  double *place = r->place + r->places++ * dim;
  memcpy(place, y, dim * sizeof *place);
  return ROT_OK;
}

/* state at the end of a step => row i at time t, by a shorter step. */
static rot_status write_at(run *r, double t, const double y[], size_t i) {
  double *row = r->y + i * r->s.dim;
  rot_status status = ROT_OK;
  memcpy(row, y, r->s.dim * sizeof *row);
  if (r->time_s[i] != t) status = step_in_parts(r, t, r->time_s[i] - t, row);
  to_space(&r->s, row);
  if (status == ROT_OK && !finite_state(r, row)) status = ROT_ERANGE;
  if (status != ROT_OK) r->failed_s = r->time_s[i];
  return status;
}

/* Rows from `first` up to `end` (excluded), outward from the start. */
static rot_status go(run *r, int forward, size_t first, size_t end) {
  const rot_free_params *p = r->s.p;
  const double sign = forward ? 1.0 : -1.0;
  double y[MAX], t = p->start_s, budget = (double)r->max_steps;
  size_t row = first;
  memcpy(y, r->start, sizeof y);
  while (row != end) {
    /* a segment: up to the next break, or unlimited */
    double until = sign * INFINITY;
    for (size_t i = 0; i < p->n_breaks; i++) {
      const double at = p->breaks_s[i];
      if (sign * (at - t) > 0.0 && sign * (until - at) > 0.0) until = at;
    }
    const int ends = isfinite(until);
    const double count = ends ? fmax(1.0, ceil(fabs(until - t) / r->step_s - 1e-9)) : INFINITY;
    const double h = ends ? (until - t) / count : sign * r->step_s, from = t;
    const double low = fmin(from, until), high = fmax(from, until);
    r->s.earliest = p->n_breaks ? nextafter(low, INFINITY) : -INFINITY;
    r->s.latest = p->n_breaks ? nextafter(high, -INFINITY) : INFINITY;
    for (double k = 0.0; k < count && row != end;) {
      const double next = k + 1.0 < count ? from + (k + 1.0) * h : until;
      while (row != end && sign * (next - r->time_s[row]) > 0.0) {
        const rot_status status = write_at(r, t, y, row);
        if (status != ROT_OK) return status;
        r->rows_done++;
        r->settled = r->places;
        row = forward ? row + 1 : row - 1;
      }
      if (row == end) break;
      if (next == t) return ROT_ESTEP;
      if (--budget < 0.0) {
        r->failed_s = t;
        return ROT_EBUDGET;
      }
      rot_status status = step_in_parts(r, t, next - t, y);
      if (status == ROT_OK && !finite_state(r, y)) status = ROT_ERANGE;
      if (status == ROT_OK) status = keep_place(r, y);
      r->s.steps++;
      if (status == ROT_OK && r->s.steps % 4096 == 0) {
        const double done = (double)r->rows_done / (double)r->n;
        status = rot_poll(r->hooks, r->from + (r->to - r->from) * done);
      }
      if (status != ROT_OK) {
        r->failed_s = next;
        return status;
      }
      note_size(r, y);
      t = next;
      k += 1.0;
    }
    t = ends && row != end ? until : t;
  }
  return ROT_OK;
}

/* Backward in time, then forward. */
static rot_status step_to_end(run *r) {
  size_t before = 0;
  while (before < r->n && r->time_s[before] < r->s.p->start_s) before++;
  note_size(r, r->start);
  rot_status status = before ? go(r, 0, before - 1, (size_t)-1) : ROT_OK;
  r->places = r->settled; /* those behind the last row lead to none */
  if (status != ROT_OK) {
    r->rows_done = 0;
    return status;
  }
  return go(r, 1, before, r->n);
}

/* Axes of the splitting: a the middle one, b the one with 1/I closer to it. */
static void choose_axes(stepper *s) {
  const rot_free_rotors *r = &s->rotors;
  double m[3], h[3];
  memcpy(m, s->p->moment_kg_m2, sizeof m);
  if (r->n) {
    rot_free_rotors_constant(r, m, h);
    for (int k = 0; k < 3; k++) s->against[k] = h[k] / m[k];
  }
  int low = 0, high = 0;
  for (int k = 1; k < 3; k++) {
    if (m[k] < m[low]) low = k;
    if (m[k] >= m[high]) high = k;
  }
  if (low == high) high = (low + 1) % 3;
  s->a = 3 - low - high;
  const double below = 1.0 / m[low] - 1.0 / m[s->a], above = 1.0 / m[high] - 1.0 / m[s->a];
  const int low_first = fabs(below) <= fabs(above);
  s->b = low_first ? low : high;
  s->c = low_first ? high : low;
  s->per_a = 1.0 / m[s->a];
  s->gap[0] = low_first ? below : above;
  s->gap[1] = low_first ? above : below;
}

/* (parameters, method, span) => step from the rates at the start. */
double rot_free_default_step(const rot_free_params *p, rot_method method, double span_s) {
  const double *m = p->moment_kg_m2;
  double min = fmin(m[0], fmin(m[1], m[2]));
  rot_free_rotors rotors;
  const double *g = p->lever_n_m, *torque = p->torque;
  double max = hypot(hypot(g[0], g[1]), g[2]) + hypot(hypot(torque[0], torque[1]), torque[2]);
  double rate = fabs(p->damping_per_s), knots = 0.0, omega = 0.0;
  for (size_t i = 0; i < p->n_knots; i++) {
    double size = 0.0;
    for (int k = 0; k < 3; k++) size = hypot(size, p->knot_torque[k][i]);
    knots = fmax(knots, size);
  }
  for (int k = 0; k < 3; k++) omega = hypot(omega, p->omega0_rad_per_s[k]);
  max += knots;
  if (p->n_rotors && !rot_free_rotors_begin(p, &rotors)) {
    for (size_t i = 0; i < p->n_rotors; i++) max += fabs(p->rotors[i].torque);
    rate += rotors.size / rotors.min;
    min = rotors.min;
  }
  rate += omega + (max > 0.0 ? sqrt(max) / sqrt(min) : 0.0);
  const double whole = method == ROT_METHOD_SPLIT ? 32.0 : 64.0;
  if (rate > 0.0) return 2.0 * PI / rate / whole;
  return span_s > 0.0 ? 1e-3 * span_s : 1.0;
}

/* Largest differences of two runs. */
typedef struct differences {
  double angle, omega, momentum, flow[ROT_FREE_FLOWS];
} differences;

static void note_difference(const stepper *s, const double x[], const double y[], differences *d) {
  const double *m = s->p->moment_kg_m2;
  double omega = 0.0, momentum = 0.0, own = 0.0, in_x[3], in_y[3], wx[3], wy[3];
  rot_attitude_to_space(x, x + MOMENTUM, in_x);
  rot_attitude_to_space(y, y + MOMENTUM, in_y);
  omega_of(s, x, wx);
  omega_of(s, y, wy);
  for (int k = 0; k < 3; k++) {
    omega = hypot(omega, s->rotors.n ? wx[k] - wy[k] : (x[MOMENTUM + k] - y[MOMENTUM + k]) / m[k]);
    momentum = hypot(momentum, in_x[k] - in_y[k]);
  }
  for (size_t k = 0; k < s->rotors.n_states; k++) own = hypot(own, x[ROTORS + k] - y[ROTORS + k]);
  d->angle = fmax(d->angle, rot_attitude_angle(x, y));
  d->omega = fmax(d->omega, omega);
  d->momentum = fmax(d->momentum, fmax(momentum, own));
  for (int f = 0; f < ROT_FREE_FLOWS; f++) {
    /* of differences between two rows, which may be on both sides of the start */
    d->flow[f] = fmax(d->flow[f], fabs(x[STATE + f] - y[STATE + f]));
  }
}

/* Errors of the rows of `r`, from a run with the halves of its steps. */
static void note_errors(const run *r, const run *half, double span_s, double flow_error[],
                        rot_info *info) {
  const double off = rot_free_law_rounding(r->s.p) * span_s; /* the same in both runs */
  const rot_free_rotors *rotors = &r->s.rotors;
  const size_t dim = r->s.dim;
  const int order = rot_free_step_order(r->s.method);
  const double rounding = rot_ode_fixed_rounding((double)half->s.steps);
  differences d = {.angle = 0.0};
  for (size_t i = 0; i < r->rows_done && i < half->rows_done; i++) {
    note_difference(&r->s, r->y + i * dim, half->y + i * dim, &d);
  }
  for (size_t i = 0; i < r->settled && i < half->settled; i++) {
    double *place = r->place + i * dim, *of_half = half->place + i * dim;
    to_space(&r->s, place);
    to_space(&half->s, of_half);
    note_difference(&r->s, place, of_half, &d);
  }
  if (half->rows_done < r->rows_done) d.angle = d.omega = d.momentum = INFINITY;
  const double by_angle = rot_ode_fixed_factor(order, d.angle, 1.0),
               by_omega = rot_ode_fixed_factor(order, d.omega, r->largest_omega),
               by_momentum = rot_ode_fixed_factor(order, d.momentum, r->largest_momentum);
  const double omega = by_omega * d.omega, momentum = by_momentum * d.momentum;
  /* Where the rates are lost, two runs may have the same wrong attitude. */
  const double angle = omega > r->largest_omega ? PI : by_angle * d.angle;
  for (int f = 0; f < ROT_FREE_FLOWS; f++) {
    flow_error[f] = d.flow[f] * 2.0 * fmax(by_angle, fmax(by_omega, by_momentum));
  }
  rot_info_measures(info, rot_free_measures);
  info->measure[ROT_FREE_ATTITUDE] =
      (rot_measure){fmin(angle + rounding + off / rotors->min * span_s, PI), 1.0, 1.0, 1.0};
  info->measure[ROT_FREE_OMEGA].error =
      omega + rounding * (r->largest_omega + rotors->size / rotors->min) + off / rotors->min;
  info->measure[ROT_FREE_MOMENTUM].error = momentum + rounding * r->largest_momentum + off;
  for (int k = 0; k < 3; k++) {
    flow_error[ROT_FREE_MOTOR_WORK] +=
        2.0 * fabs(rotors->driven[k]) * info->measure[ROT_FREE_OMEGA].error;
  }
  rot_note_value(&info->measure[ROT_FREE_OMEGA], r->largest_omega);
  rot_note_value(&info->measure[ROT_FREE_MOMENTUM], r->largest_momentum);
}

/* Two runs, rows, flows, errors. */
rot_status rot_free_step_through(const rot_free_params *p, const rot_free_step_options *options,
                                 size_t n, const double time_s[], const rot_free_columns *out,
                                 double *const flow[ROT_FREE_FLOWS],
                                 double flow_error[ROT_FREE_FLOWS], const rot_hooks *hooks,
                                 rot_info *info) {
  rot_free_rotors rotors;
  rot_info_clear(info, rot_free_measures);
  if (!(options->step_s > 0.0) || !isfinite(options->step_s) || rot_free_rotors_begin(p, &rotors)) {
    return info->status = ROT_EVALUE;
  }
  const size_t dim = ROTORS + rotors.n_states, room = n ? n * dim : dim;
  double *y = malloc(2 * room * sizeof *y), omega[3];
  if (!y) return info->status = ROT_ENOMEM;
  run r = {.s = {.p = p, .rotors = rotors, .dim = dim, .method = options->method},
           .step_s = options->step_s,
           .parts = 1,
           .n = n,
           .max_steps = options->max_steps,
           .time_s = time_s,
           .y = y,
           .hooks = hooks,
           .to = 1.0 / 3.0};
  choose_axes(&r.s);
  rot_free_principal(p, omega, r.s.q0);
  r.start[0] = 1.0;
  for (int k = 0; k < 3; k++) r.start[MOMENTUM + k] = rotors.momentum0[k];
  for (size_t k = 0; k < rotors.n_states; k++) r.start[ROTORS + k] = rotors.start[k];
  memcpy(r.s.l0, rotors.momentum0, sizeof r.s.l0);
  r.s.weight = rot_free_has_weight(p);
  rot_free_hang(p, &r.s.hung);
  run half = r;
  half.parts = 2;
  half.y = y + room;
  half.from = r.to;
  half.to = 1.0;
  info->method = options->method;
  info->status = step_to_end(&r);
  if (info->status == ROT_ERHS && (p->law || p->motors)) info->status = ROT_ETORQUE;
  if (info->status != ROT_EUNWIND) {
    const rot_status second = step_to_end(&half);
    if (second == ROT_EUNWIND) info->status = second;
  }
  info->time_s = info->status == ROT_OK ? (n ? time_s[n - 1] : p->start_s) : r.failed_s;
  info->steps = r.s.steps;
  info->rhs_calls = r.s.calls + half.s.calls;
  info->rows_done = r.rows_done;
  const double span_s =
      n ? fmax(fabs(time_s[0] - p->start_s), fabs(time_s[n - 1] - p->start_s)) : 0.0;
  note_errors(&r, &half, span_s, flow_error, info);
  for (size_t i = 0; i < r.rows_done && info->status != ROT_EUNWIND; i++) {
    const double *row = y + i * dim;
    omega_of(&r.s, row, omega);
    for (int k = 0; k < ROT_FREE_FLOWS; k++) flow[k][i] = row[STATE + k];
    rot_status status = rot_free_write(p, omega, row, i, out);
    if (status == ROT_OK && rotors.n) {
      flow[ROT_FREE_MOTOR_WORK][i] += rot_free_rotors_driven_work(&rotors, omega);
      status = rot_free_rotors_write(&rotors, omega, row, row + ROTORS, i, out);
    }
    if (status != ROT_OK) {
      info->rows_done = i;
      info->status = status;
      break;
    }
  }
  free(r.place);
  free(half.place);
  free(y);
  return info->status;
}
