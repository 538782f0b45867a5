#include "scene/incline/ode.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "engine/ode/ode.h"
#include "ground/dd_trig.h"
#include "ground/real.h"

/* State vector: paths of centre and rim, R (theta - theta0), since the start; speeds v and w = R
 * omega; integrals; the mode, for the rows. */
enum {
  TRAVEL,
  TURN,
  SPEED,
  RIM,
  STATE,
  SLIP_HEAT = STATE,
  ROLLING_HEAT,
  DRAG_HEAT,
  WORK,
  FRICTION,
  DRAG,
  FORCE,
  RESISTANCE,
  MODE,
  DIM
};

/* Without a resistance spin is 0 and omega is not held. */
typedef rot_incline_directions directions;

/* State after an event, for the row at its time. */
typedef struct change {
  double time_s, y[DIM];
  int mode;
} change;

typedef struct motion {
  const rot_incline_scene *scene;
  const rot_incline_params *p; /* scene->slope */
  rot_incline_contact on;
  struct {
    double pull, slides, resists;
  } lost;            /* the forces of the contact less their doubles */
  int mode;          /* see mode_of() */
  double max;        /* largest speed so far, m/s */
  double v;          /* the last one beyond rounding, m/s */
  rot_status failed; /* status of an event function, returned by the next rhs */
  rot_events *events;
  size_t n_changes, room;
  change *changes;
  double noise[STATE];               /* rounding and noise of the rates, see note_noise() */
  double rounds[STATE], push_rounds; /* of a force that is called; as the mode is */
  double span_s;                     /* start to last row */
} motion;

static int sign(double x) { return (x > 0.0) - (x < 0.0); }

static int mode_of(directions at) { return 3 * (at.slip + 1) + at.spin + 1; }
static directions directions_of(int mode) { return (directions){mode / 3 - 1, mode % 3 - 1}; }

static int held(const motion *m, directions at) { return rot_incline_held(&m->on, at); }
static int rests(const motion *m, directions at) { return held(m, at) && at.slip == 0; }

/* ---- forces ---------------------------------------------------------------------------------- */

typedef struct forces {
  double applied, drag; /* N */
  double pull, lost;    /* of gravity, drag and force, per kg: the double, and the rest */
} forces;

/* Without it a body that its force nearly balances moved by the rounding of gravity: 1e-12 m/s was
 * off by 3 % after 20 s. */
static void note_lost(motion *m) {
  static const rot_dd degree = {0.017453292519943295, 2.9486522708701687e-19};
  const rot_incline_params *p = m->p;
  const rot_dd gravity = {p->gravity_m_per_s2, 0.0}, mu = {p->mu_kinetic, 0.0};
  const rot_dd arm = rot_dd_div((rot_dd){p->arm_m, 0.0}, (rot_dd){p->radius_m, 0.0});
  rot_dd sine, cosine;
  rot_dd_sine_cosine(rot_dd_mul1(degree, p->angle_deg), &sine, &cosine);
  const rot_dd normal = rot_dd_mul(gravity, cosine);
  m->lost.pull = rot_dd_add1(rot_dd_mul(gravity, sine), -m->on.pull).hi;
  m->lost.slides =
      isinf(m->on.slides) ? 0.0 : rot_dd_add1(rot_dd_mul(mu, normal), -m->on.slides).hi;
  m->lost.resists = rot_dd_add1(rot_dd_mul(arm, normal), -m->on.resists).hi;
}

static rot_status pull_at(const motion *m, double t, double travel, double v, forces *f) {
  const rot_incline_scene *scene = m->scene;
  f->applied = 0.0;
  if (scene->force) {
    const double x = m->p->x0_m + travel;
    const rot_status status = scene->force(t, x, v, &f->applied, scene->ctx);
    if (status != ROT_OK) return status;
  }
  f->drag = -(scene->drag_n_s_per_m + scene->drag_n_s2_per_m2 * fabs(v)) * v;
  const double mass = m->p->mass_kg, push = f->applied / mass;
  double lost[2];
  const double pull = rot_two_sum(m->on.pull, push, &lost[0]);
  const double sum = rot_two_sum(pull, f->drag / mass, &lost[1]);
  const double more = lost[0] + lost[1] + m->lost.pull + fma(-push, mass, f->applied) / mass;
  f->pull = sum;
  f->lost = 0.0;
  if (isfinite(more)) f->pull = rot_two_sum(sum, more, &f->lost);
  return ROT_OK;
}

/* a - b of numbers in two parts */
static double less(double a, double a_lost, double b, double b_lost) {
  double lost;
  const double sum = rot_two_sum(a, -b, &lost), more = lost + (a_lost - b_lost);
  return isfinite(more) ? sum + more : sum;
}

static rot_incline_forces forces_of(const motion *m, const forces *f, directions at) {
  rot_incline_forces on = rot_incline_forces_of(&m->on, f->pull, at);
  const double slides = at.slip * m->lost.slides, resists = at.spin * m->lost.resists;
  if (at.slip == 0 && !held(m, at)) {
    on.v = on.w = m->on.spin * less(f->pull, f->lost, on.torque, resists);
  } else if (at.slip != 0) {
    on.v = less(f->pull, f->lost, on.friction, slides);
    if (!held(m, at)) on.w = less(on.friction, slides, on.torque, resists) / m->on.beta;
  }
  return on;
}

/* (time, state) => rates, in the present mode. */
static rot_status incline_rhs(double t, const double y[], double dydt[], void *ctx) {
  const motion *m = ctx;
  const directions at = directions_of(m->mode);
  const double v = y[SPEED], w = y[RIM], mass = m->p->mass_kg;
  forces f;
  rot_status status = m->failed;
  if (status == ROT_OK) status = pull_at(m, t, y[TRAVEL], v, &f);
  if (status != ROT_OK) return status;
  const rot_incline_forces on = forces_of(m, &f, at);
  dydt[TRAVEL] = v;
  dydt[TURN] = w;
  dydt[SPEED] = on.v;
  dydt[RIM] = on.w;
  dydt[SLIP_HEAT] = at.slip == 0 ? 0.0 : mass * on.friction * (v - w);
  dydt[ROLLING_HEAT] = held(m, at) ? 0.0 : mass * on.torque * w;
  dydt[DRAG_HEAT] = -f.drag * v;
  dydt[WORK] = f.applied * v;
  dydt[FRICTION] = -mass * on.friction;
  dydt[DRAG] = f.drag;
  dydt[FORCE] = f.applied;
  dydt[RESISTANCE] = mass * on.torque * m->p->radius_m;
  dydt[MODE] = 0.0;
  return ROT_OK;
}

/* ---- changes of mode ------------------------------------------------------------------------- */

typedef enum cause { BEGINS, SLIP_ENDS, SPIN_ENDS, STICK_ENDS, JUMPS } cause;

/* pull => mode after rest. `lost`: the pull has reached the breakaway force; after a jump it may
 * exceed it. */
static directions leave_rest(const motion *m, double pull, int lost) {
  const int direction = sign(pull);
  directions at = {0, 0};
  if (!lost || fabs(pull) > (1.0 + 1e-9) * m->on.holds * fmin(m->on.breakaway, m->on.resists)) {
    return rot_incline_leave_rest(&m->on, pull);
  }
  if (m->on.resists <= m->on.breakaway) {
    at.spin = direction;
  } else {
    at.slip = direction;
    if (m->on.slides > m->on.resists) at.spin = direction;
  }
  return at;
}

static directions find_directions(const motion *m, directions from, double pull, const double y[],
                                  int lost) {
  const int turns = m->on.resists > 0.0;
  if (rests(m, from) && y[SPEED] == 0.0) return leave_rest(m, pull, lost);
  return rot_incline_go_on(&m->on, from, pull, y[SPEED], turns, lost);
}

static rot_status keep_change(motion *m, double t, const double y[]) {
  if (m->n_changes == m->room) {
    const size_t room = m->room ? 2 * m->room : 16;
    change *more = realloc(m->changes, room * sizeof *more);
    if (!more) return ROT_ENOMEM;
    m->changes = more;
    m->room = room;
  }
  change *now = &m->changes[m->n_changes++];
  now->time_s = t;
  memcpy(now->y, y, sizeof now->y);
  now->mode = m->mode;
  return ROT_OK;
}

/* Bound of the rounding of a speed that is 0 at an event. */
static double small(const motion *m) { return 64.0 * ROT_EPS * m->max; }

/* (state, cause) => state, mode and events after the event. */
static rot_status settle(motion *m, double t, double y[], cause why) {
  const directions from = directions_of(m->mode);
  directions at = from;
  forces f;
  const rot_status status = pull_at(m, t, y[TRAVEL], y[SPEED], &f);
  if (status != ROT_OK) return status;
  if (why == SLIP_ENDS) {
    at.slip = 0;
    /* If the contact does not stick, the slip changes its sign and both speeds are continuous. */
    const double need = fabs(rot_incline_needed(&m->on, f.pull, at.spin * m->on.resists));
    if (held(m, from)) {
      y[SPEED] = y[RIM] = 0.0;
    } else if (need <= m->on.breakaway * m->on.holds) {
      y[SPEED] = y[RIM] = m->on.spin * y[SPEED] + m->on.own * y[RIM];
    }
    if (m->on.resists > 0.0 && fabs(y[SPEED]) <= small(m)) {
      y[SPEED] = y[RIM] = 0.0;
      at.spin = 0;
    }
  } else if (why == SPIN_ENDS) {
    y[RIM] = 0.0;
    if (at.slip == 0) y[SPEED] = 0.0;
    at.spin = 0;
  }
  at = find_directions(m, at, f.pull, y, why == STICK_ENDS);
  m->mode = mode_of(at);
  y[MODE] = (double)m->mode;
  /* A reversal: the body stopped while rolling, or while slipping with omega held, and does not
   * stay at rest. */
  const int turned = y[SPEED] == 0.0 && y[RIM] == 0.0 && !rests(m, from) && !rests(m, at) &&
                     ((why == SPIN_ENDS && from.slip == 0) || (why == SLIP_ENDS && held(m, from)));
  if (why == BEGINS) return ROT_OK;
  const rot_status logged =
      rot_incline_log(m->events, t, from, at, rests(m, from), rests(m, at), turned);
  return logged == ROT_OK ? keep_change(m, t, y) : logged;
}

/* ---- events ---------------------------------------------------------------------------------- */

/* Replaces the engine's generic log entry by the actual events. */
static rot_ode_then settle_at(double t, double y[], int *mode, void *ctx, cause why) {
  motion *m = ctx;
  if (m->events && m->events->count) m->events->count--;
  const rot_status status = settle(m, t, y, why);
  if (status != ROT_OK) m->failed = status;
  *mode = m->mode;
  return ROT_ODE_NEW_SEGMENT;
}

static rot_ode_then at_slip_zero(double t, double y[], int *mode, int forward, void *ctx) {
  (void)forward;
  return settle_at(t, y, mode, ctx, SLIP_ENDS);
}

static rot_ode_then at_spin_zero(double t, double y[], int *mode, int forward, void *ctx) {
  (void)forward;
  return settle_at(t, y, mode, ctx, SPIN_ENDS);
}

static rot_ode_then at_limit(double t, double y[], int *mode, int forward, void *ctx) {
  (void)forward;
  return settle_at(t, y, mode, ctx, STICK_ENDS);
}

/* Where nothing moves a body at rest, its motion fades: it reaches zero by rounding alone, and does
 * not reverse, but goes on within the rounding. Quadratic drag has a kink where v changes its sign:
 * a new segment. */
static rot_ode_then at_turn(double t, double y[], int *mode, int forward, void *ctx) {
  motion *m = ctx;
  const directions at = directions_of(m->mode);
  forces f;
  (void)mode, (void)forward;
  rot_status status = pull_at(m, t, y[TRAVEL], 0.0, &f);
  if (status == ROT_OK && forces_of(m, &f, at).v == 0.0) {
    if (m->events && m->events->count) m->events->count--;
    y[SPEED] = copysign(ROT_EPS * m->max, m->v);
    if (at.slip == 0) y[RIM] = y[SPEED];
    return ROT_ODE_NEW_SEGMENT;
  }
  if (status == ROT_OK) status = keep_change(m, t, y);
  if (status != ROT_OK) m->failed = status;
  return m->scene->drag_n_s2_per_m2 != 0.0 ? ROT_ODE_NEW_SEGMENT : ROT_ODE_GO_ON;
}

/* A speed that is 0 at the start of a segment has the sign of its mode. */
static double signed_speed(double speed, int direction) {
  return speed == 0.0 ? direction * DBL_MIN : speed;
}

static double slip_at(double t, const double y[], void *ctx) {
  const motion *m = ctx;
  const int slip = directions_of(m->mode).slip;
  (void)t;
  return slip == 0 ? 1.0 : signed_speed(y[SPEED] - y[RIM], slip);
}

static double spin_at(double t, const double y[], void *ctx) {
  const motion *m = ctx;
  const int spin = directions_of(m->mode).spin;
  (void)t;
  return m->on.resists == 0.0 || spin == 0 ? 1.0 : signed_speed(y[RIM], spin);
}

/* With a resistance, v reaches 0 together with omega (rolling) or with the slip (omega held): those
 * are the events. */
static double turn_at(double t, const double y[], void *ctx) {
  const motion *m = ctx;
  const directions at = directions_of(m->mode);
  (void)t;
  return m->on.resists > 0.0 && (at.slip == 0 || at.spin == 0) ? 1.0 : y[SPEED];
}

/* 1 - needed/maximal friction; 1 without a pull, negative beyond breakaway. */
static double margin_at(double t, const double y[], void *ctx) {
  motion *m = ctx;
  const directions at = directions_of(m->mode);
  forces f;
  if (at.slip != 0 || m->failed != ROT_OK) return 1.0;
  const rot_status status = pull_at(m, t, y[TRAVEL], y[SPEED], &f);
  if (status != ROT_OK) {
    m->failed = status;
    return 1.0;
  }
  double max = m->on.breakaway, need = fabs(f.pull);
  if (rests(m, at)) {
    max = max < m->on.resists ? max : m->on.resists;
  } else {
    need = fabs(rot_incline_needed(&m->on, f.pull, at.spin * m->on.resists));
  }
  if (isinf(max) || need == 0.0) return 1.0;
  return max > 0.0 ? m->on.holds - need / max : -1.0;
}

static void cross_break(double t, double y[], int forward, void *ctx) {
  motion *m = ctx;
  if (!forward || m->failed != ROT_OK) return;
  const rot_status status = settle(m, nextafter(t, INFINITY), y, JUMPS);
  if (status != ROT_OK) m->failed = status;
}

/* Below this a speed that fades is none: with denormal numbers a step takes 50 times as long. */
#define FADED 1e-300

/* At rest no force moves it, and steps are long. */
static void note_rounds(motion *m) {
  const directions at = directions_of(m->mode);
  m->rounds[SPEED] = rests(m, at) ? 0.0 : m->push_rounds;
  m->rounds[RIM] = at.slip == 0 ? m->rounds[SPEED] : 0.0;
}

static void note_speed(double t, double y[], void *ctx) {
  motion *m = ctx;
  (void)t;
  if (fabs(y[SPEED]) < FADED && fabs(y[RIM]) < FADED) y[SPEED] = y[RIM] = 0.0;
  note_rounds(m);
  m->max = fmax(m->max, fmax(fabs(y[SPEED]), fabs(y[RIM])));
  if (fabs(y[SPEED]) > small(m)) m->v = y[SPEED];
}

/* ---- the scene ------------------------------------------------------------------------------- */

static void begin(motion *m, const rot_incline_scene *scene, double span_s, double y[]) {
  const rot_incline_params *p = &scene->slope;
  const double v0 = p->v0_m_per_s, w0 = p->radius_m * p->omega0_rad_per_s;
  *m = (motion){.scene = scene, .p = p, .span_s = span_s};
  rot_incline_touch(p, &m->on);
  note_lost(m);
  const int rolls = fabs(v0 - w0) <= 4.0 * ROT_EPS * fabs(w0);
  y[SPEED] = v0;
  y[RIM] = rolls ? v0 : w0;
  m->max = fmax(fabs(v0), fabs(w0));
  m->mode =
      mode_of((directions){rolls ? 0 : sign(v0 - w0), m->on.resists > 0.0 ? sign(y[RIM]) : 0});
}

/* Rounding of the rates: of what acts in sum, and of a force that is called, whose law may be a sum
 * that cancels. Without it no step would pass the error test where the motion starts within
 * rounding. */
static void note_noise(motion *m, const forces *f) {
  const directions at = directions_of(m->mode);
  const rot_incline_forces on = forces_of(m, f, at);
  const double called = m->scene->force_is_called ? fabs(f->applied) / m->p->mass_kg : 0.0;
  const double off = m->scene->force_noise_n / m->p->mass_kg;
  m->push_rounds = ROT_EPS * called + off;
  note_rounds(m);
  m->noise[SPEED] = 4.0 * ROT_EPS * (fabs(on.v) + called) + off;
  m->noise[RIM] = 4.0 * ROT_EPS * (fabs(on.w) + called) + off;
  m->noise[TRAVEL] = m->noise[SPEED] * m->span_s;
  m->noise[TURN] = m->noise[RIM] * m->span_s;
}

/* ---- rows ------------------------------------------------------------------------------------ */

/* time => the last change at that time, or NULL. Changes of the returned run come last. */
static const change *change_at(const motion *m, double t) {
  const rot_events *log = m->events;
  int logged = 0;
  for (size_t i = 0; log && i < log->count && !logged; i++) logged = log->time_s[i] == t;
  for (size_t i = m->n_changes; logged && i-- > 0;) {
    if (m->changes[i].time_s == t) return &m->changes[i];
  }
  return NULL;
}

/* (time, state) => row i. */
static rot_status fill_row(const motion *m, size_t i, double t, const double y[],
                           const rot_incline_columns *out, const rot_incline_sums *sums) {
  const rot_incline_params *p = m->p;
  const change *changed = change_at(m, t);
  const int start = t == p->start_s;
  const directions at = directions_of(changed ? changed->mode : (int)y[MODE]);
  if (changed) y = changed->y;
  const double v = y[SPEED], w = at.slip == 0 ? v : y[RIM];
  forces f;
  const rot_status status = pull_at(m, t, y[TRAVEL], v, &f);
  if (status != ROT_OK) return status;
  out->x_m[i] = p->x0_m + y[TRAVEL];
  out->v_m_per_s[i] = v;
  out->theta_rad[i] = p->theta0_rad + y[TURN] / p->radius_m;
  out->omega_rad_per_s[i] = start ? p->omega0_rad_per_s : w / p->radius_m;
  out->slip_speed_m_per_s[i] = at.slip == 0 ? 0.0 : v - w;
  out->friction_force_n[i] = -p->mass_kg * rot_incline_forces_of(&m->on, f.pull, at).friction + 0.0;
  out->translational_kinetic_energy_j[i] = 0.5 * p->mass_kg * v * v;
  out->rotational_kinetic_energy_j[i] = 0.5 * p->mass_kg * m->on.beta * w * w;
  out->potential_energy_j[i] = -p->mass_kg * m->on.pull * out->x_m[i] + 0.0;
  out->slip_heat_j[i] = y[SLIP_HEAT];
  out->rolling_heat_j[i] = y[ROLLING_HEAT];
  out->rolling[i] = at.slip == 0;
  sums->applied_work_j[i] = y[WORK];
  sums->drag_heat_j[i] = y[DRAG_HEAT];
  sums->friction_impulse_n_s[i] = y[FRICTION];
  sums->drag_impulse_n_s[i] = y[DRAG];
  sums->applied_impulse_n_s[i] = y[FORCE];
  sums->resistance_impulse_n_m_s[i] = y[RESISTANCE];
  sums->drag_force_n[i] = f.drag + 0.0;
  sums->applied_force_n[i] = f.applied;
  const int finite = isfinite(out->x_m[i]) && isfinite(v) && isfinite(out->theta_rad[i]) &&
                     isfinite(out->omega_rad_per_s[i]);
  return !isfinite(f.applied) ? ROT_ERHS : finite ? ROT_OK : ROT_ERANGE;
}

/* states => rows, up to the last valid one. */
static rot_status fill_rows(const motion *m, size_t n, const double time_s[], const double y[],
                            const rot_incline_columns *out, const rot_incline_sums *sums,
                            rot_info *info) {
  const size_t reached = info->rows_done;
  info->rows_done = 0;
  for (size_t i = 0; i < n && i < reached; i++) {
    const rot_status status = fill_row(m, i, time_s[i], y + i * DIM, out, sums);
    if (m->scene->force) info->rhs_calls++;
    if (status != ROT_OK) {
      info->time_s = time_s[i];
      return status;
    }
    info->rows_done = i + 1;
  }
  return ROT_OK;
}

/* log => rows at its events. */
static rot_status fill_event_rows(const motion *m, rot_incline_event_rows *rows, rot_info *info) {
  rot_status status = ROT_OK;
  for (size_t i = 0; rows && m->events && i < m->events->count && status == ROT_OK; i++) {
    const double t = m->events->time_s[i];
    const change *changed = change_at(m, t);
    if (!changed) continue;
    rot_incline_row *row = rot_incline_event_row(rows, t);
    if (!row) return ROT_ENOMEM;
    const rot_incline_columns out = rot_incline_columns_of(row);
    const rot_incline_sums sums = {
#define X(name) .name = &row->name,
        ROT_INCLINE_SUMS(X)
#undef X
    };
    status = fill_row(m, 0, t, changed->y, &out, &sums);
    if (m->scene->force) info->rhs_calls++;
  }
  return status;
}

/* Lower bound of Radau's error estimate as a fraction of the requested accuracy. With few, long
 * steps the difference of two runs is too small: it covered 92 of 100 random scenes, with this
 * bound 98 (bench/coverage/incline.c). */
#define RADAU_MIN 1e-3

/* Error and largest value of a path x. largest: of |x - offset|; offset: x at the start. */
static void note_path(rot_measure *measure, double offset, double error, double largest, size_t n,
                      const double rows[]) {
  measure->largest = fmax(fabs(offset), largest - fabs(offset));
  for (size_t i = 0; i < n; i++) measure->largest = fmax(measure->largest, fabs(rows[i]));
  measure->error = error + 4.0 * ROT_EPS * measure->largest;
}

/* errors of the state vector => errors of the measures and of the sums. */
static void note_errors(const motion *m, double accuracy, const rot_incline_columns *out,
                        const double error[], const double largest[], rot_incline_sums *sums,
                        rot_info *info) {
  const rot_incline_params *p = m->p;
  const double r = p->radius_m;
  const size_t n = info->rows_done;
  note_path(&info->measure[ROT_INCLINE_X], p->x0_m, error[TRAVEL], largest[TRAVEL], n, out->x_m);
  note_path(&info->measure[ROT_INCLINE_THETA], p->theta0_rad, error[TURN] / r, largest[TURN] / r, n,
            out->theta_rad);
  info->measure[ROT_INCLINE_V].error = error[SPEED];
  info->measure[ROT_INCLINE_V].largest = largest[SPEED];
  info->measure[ROT_INCLINE_OMEGA].error = error[RIM] / r;
  info->measure[ROT_INCLINE_OMEGA].largest = largest[RIM] / r;
  for (size_t k = 0; info->method == ROT_METHOD_RADAU && k < info->n_measures; k++) {
    info->measure[k].error += RADAU_MIN * accuracy * info->measure[k].largest;
  }
  const int sum[ROT_INCLINE_SUM_ERRORS] = {WORK,  DRAG_HEAT,  FRICTION,  DRAG,
                                           FORCE, RESISTANCE, SLIP_HEAT, ROLLING_HEAT};
  for (int k = 0; k < ROT_INCLINE_SUM_ERRORS; k++) sums->error[k] = 2.0 * error[sum[k]];
}

static void new_positions(double t, double h, const double before[], double y[], void *ctx) {
  (void)t, (void)ctx;
  y[TRAVEL] = before[TRAVEL] + h * y[SPEED];
  y[TURN] = before[TURN] + h * y[RIM];
}

rot_status rot_incline_integrate(const rot_incline_scene *scene,
                                 const rot_incline_ode_options *options, size_t n,
                                 const double time_s[], const rot_incline_columns *out,
                                 rot_incline_sums *sums, rot_events *events,
                                 rot_incline_event_rows *at_events, const rot_hooks *hooks,
                                 rot_info *info) {
  const rot_incline_params *p = &scene->slope;
  motion m;
  double start[DIM] = {0.0}, error[DIM] = {0.0}, largest[DIM] = {0.0};
  const double span = n ? fmax(0.0, time_s[n - 1] - p->start_s) : 0.0;
  forces f;
  rot_info_clear(info, rot_incline_measures);
  memset(sums->error, 0, sizeof sums->error);
  begin(&m, scene, span, start);
  m.events = events;
  double *y = malloc((n ? n : 1) * DIM * sizeof *y);
  /* A force such as sign(sin(t)) is 0 at the start only: evaluate just after it. */
  const double begins = scene->force ? nextafter(p->start_s, INFINITY) : p->start_s;
  rot_status failure = y ? settle(&m, begins, start, BEGINS) : ROT_ENOMEM;
  if (failure == ROT_OK && n && time_s[0] < p->start_s) failure = ROT_EVALUE;
  if (failure == ROT_OK) failure = pull_at(&m, p->start_s, 0.0, start[SPEED], &f);
  if (failure == ROT_OK) {
    note_noise(&m, &f);
    const rot_ode_event event[] = {{slip_at, 0, 0, ROT_EVENT_ROLL, at_slip_zero, NULL, 0},
                                   {spin_at, 0, 0, ROT_EVENT_STICK, at_spin_zero, NULL, 0},
                                   {turn_at, 0, 0, ROT_EVENT_REVERSE, at_turn, NULL, 0},
                                   {margin_at, 0, -1, ROT_EVENT_SLIP, at_limit, NULL, 1}};
    const int offset = p->x0_m != 0.0 || p->theta0_rad != 0.0;
    const rot_ode_params ode = {.dim = DIM,
                                .controlled = STATE,
                                .rhs = incline_rhs,
                                .ctx = &m,
                                .n_breaks = scene->n_breaks,
                                .breaks = scene->breaks_s,
                                .start_s = p->start_s,
                                .start_breaks = scene->force != NULL,
                                .start = start,
                                /* Relative to x, which may be half of |x - x0|. */
                                .accuracy = (offset ? 0.5 : 1.0) * options->accuracy,
                                .max_steps = options->max_steps,
                                .method = options->method,
                                .mode = &m.mode,
                                .n_events = sizeof event / sizeof *event,
                                .events = event,
                                .log = events,
                                .at_break = cross_break,
                                .project = note_speed,
                                .noise = m.noise,
                                .rounds = m.rounds,
                                .integrals_between = 1,
                                .resolution =
                                    rot_ode_resolution(scene->force != NULL, options->resolution),
                                .kinks = scene->force != NULL,
                                .step_s = rot_ode_is_fixed(options->method) ? options->step_s : 0.0,
                                .positions = new_positions};
    failure = rot_ode_run(&ode, n, time_s, y, NULL, error, largest, hooks, info);
    if (failure != ROT_EUNWIND && failure != ROT_ENOMEM) {
      rot_status rows = fill_rows(&m, n, time_s, y, out, sums, info);
      if (rows == ROT_OK && failure == ROT_OK) rows = fill_event_rows(&m, at_events, info);
      if (rows != ROT_OK) failure = rows;
    }
    note_errors(&m, options->accuracy, out, error, largest, sums, info);
  }
  free(m.changes);
  free(y);
  return info->status = failure;
}
