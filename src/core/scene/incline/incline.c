#include "scene/incline/incline.h"

#include <math.h>
#include <stdlib.h>

#include "engine/stepping.h"
#include "ground/real.h"

const char *const rot_incline_measures[] = {"x", "v", "theta", "omega", NULL};

/* v: velocity of the centre; w = R omega: of the rim. Their mean M = (v + beta w)/(1 + beta) is
 * independent of the friction and of the error of the time at which rolling begins. The slip u = v
 * - w is then 0: rolling has v = w = M. v and w are stored too: computed from M and u, the smaller
 * one would lose digits. Paths count from the start; forces are per kg. */
typedef struct incline {
  const rot_incline_params *p;
  rot_incline_contact on;
  double time_s;
  double x, v, turn, w, mean, slip; /* paths and speeds of centre and rim; M; u */
  double slip_heat, rolling_heat;   /* J, since the start */
  double x_error, v_error, turn_error, w_error, mean_error, slip_error;
  double settled_s; /* latest time at which rolling began: the slip is exactly 0 after it */
  rot_incline_directions at; /* spin: also without a resistance */
  int direction;             /* sign of v before a reversal */
  /* The segment from time_s to end_s. */
  double force, torque;
  double v_rate, w_rate, mean_rate, slip_rate;
  double v_rate_error, w_rate_error, mean_rate_error, slip_rate_error;
  double end_s;
  enum { NOTHING, SLIP_ENDS, SPIN_ENDS, TURNS } ends;
} incline;

static int sign(double x) { return (x > 0.0) - (x < 0.0); }

/* Rounding of the products, and of the angle: the latter changes the tangent by the relative error
 * times angle/(sin cos). A body at its critical angle therefore rolls. */
double rot_incline_holds(double angle_deg, double sine, double cosine) {
  const double holds = 1.0 + 16.0 * ROT_EPS;
  if (sine * cosine == 0.0) return holds;
  return holds + 2.0 * ROT_EPS * fabs(angle_deg * 0.017453292519943295 / sine) / cosine;
}

void rot_incline_touch(const rot_incline_params *p, rot_incline_contact *out) {
  double sine, cosine;
  rot_sin_cos_deg(p->angle_deg, &sine, &cosine);
  const double normal = p->gravity_m_per_s2 * cosine;
  out->beta = p->inertia_kg_m2 / p->mass_kg / p->radius_m / p->radius_m;
  out->own = 1.0 / (1.0 + 1.0 / out->beta);
  out->spin = 1.0 / (1.0 + out->beta);
  out->pull = p->gravity_m_per_s2 * sine;
  out->slides = rot_incline_friction(p->mu_kinetic, normal);
  out->breakaway = rot_incline_friction(p->mu_static, normal);
  out->resists = p->arm_m / p->radius_m * normal;
  out->holds = rot_incline_holds(p->angle_deg, sine, cosine);
}

/* parameters => state at the start; a slip within rounding is 0. */
static void begin(incline *c, const rot_incline_params *p) {
  const double v0 = p->v0_m_per_s, w0 = p->radius_m * p->omega0_rad_per_s;
  *c = (incline){0};
  c->p = p;
  rot_incline_touch(p, &c->on);
  c->time_s = p->start_s;
  c->v = v0;
  c->w = w0;
  c->slip = v0 - w0;
  c->mean = c->on.spin * v0 + c->on.own * w0;
  c->w_error = ROT_EPS * fabs(w0);
  c->mean_error = 12.0 * ROT_EPS * (c->on.spin * fabs(v0) + c->on.own * fabs(w0));
  c->slip_error = ROT_EPS * (fabs(w0) + fabs(c->slip));
  if (fabs(c->slip) <= 4.0 * ROT_EPS * fabs(w0)) {
    c->slip = 0.0;
    c->mean = c->w = v0;
    c->w_error = c->mean_error = 4.0 * ROT_EPS * fabs(w0);
  }
  c->at = (rot_incline_directions){sign(c->slip), sign(c->w)};
  c->direction = sign(v0);
  c->settled_s = p->start_s;
}

/* ---- the forces of a segment ----------------------------------------------------------------- */

static int held(const incline *c) { return rot_incline_held(&c->on, c->at); }

static int rests(const incline *c) { return c->at.slip == 0 && c->at.spin == 0 && c->mean == 0.0; }

/* mode => forces, accelerations, rounding errors of the accelerations. */
static void find_forces(incline *c) {
  c->at = rests(c) ? rot_incline_leave_rest(&c->on, c->on.pull)
                   : rot_incline_go_on(&c->on, c->at, c->on.pull, c->mean, 1, 0);
  c->v_rate = c->w_rate = c->mean_rate = c->slip_rate = 0.0;
  c->v_rate_error = c->w_rate_error = c->mean_rate_error = c->slip_rate_error = 0.0;
  if (rests(c)) {
    c->force = c->torque = c->on.pull;
    return;
  }
  const rot_incline_contact *on = &c->on;
  const rot_incline_forces f = rot_incline_forces_of(on, on->pull, c->at);
  c->force = f.friction;
  c->torque = f.torque;
  c->v_rate = f.v;
  c->w_rate = f.w;
  c->mean_rate = on->spin * (on->pull - f.torque);
  c->mean_rate_error = 12.0 * ROT_EPS * on->spin * (fabs(on->pull) + on->resists);
  if (c->at.slip == 0) {
    c->v_rate_error = c->w_rate_error = c->mean_rate_error;
    return;
  }
  c->v_rate_error = 8.0 * ROT_EPS * (fabs(on->pull) + on->slides);
  if (held(c)) {
    c->slip_rate = c->v_rate;
    c->slip_rate_error = c->v_rate_error;
    c->mean_rate_error = on->spin * c->v_rate_error + 8.0 * ROT_EPS * fabs(c->mean_rate);
    return;
  }
  c->w_rate_error = 12.0 * ROT_EPS * (on->slides + on->resists) / on->beta;
  c->slip_rate = c->v_rate - c->w_rate;
  c->slip_rate_error = c->v_rate_error + c->w_rate_error + ROT_EPS * fabs(c->slip_rate);
}

/* Time at which `value` reaches 0 at a constant rate; Inf: never, or direction is 0. */
static double zero_s(const incline *c, int direction, double value, double rate) {
  if (direction == 0 || direction * rate >= 0.0) return INFINITY;
  const double s = -value / rate;
  return c->time_s + (s > 0.0 ? s : 0.0);
}

static void find_end(incline *c) {
  const double slip = zero_s(c, c->at.slip, c->slip, c->slip_rate);
  const double spin =
      c->on.resists > 0.0 ? zero_s(c, c->at.spin, c->w, c->w_rate) : (double)INFINITY;
  /* With a resistance, v reaches 0 together with omega (rolling) or with the slip (omega held):
   * those are the events. */
  const double turn = c->on.resists > 0.0 && (c->at.slip == 0 || c->at.spin == 0)
                          ? (double)INFINITY
                          : zero_s(c, c->direction, c->v, c->v_rate);
  c->end_s = INFINITY;
  c->ends = NOTHING;
  if (turn < c->end_s) c->end_s = turn, c->ends = TURNS;
  if (spin <= c->end_s && spin < INFINITY) c->end_s = spin, c->ends = SPIN_ENDS;
  if (slip <= c->end_s && slip < INFINITY) c->end_s = slip, c->ends = SLIP_ENDS;
}

static void enter(incline *c) {
  find_forces(c);
  if (rests(c)) c->direction = 0;
  if (c->direction == 0) c->direction = sign(c->v_rate);
  find_end(c);
}

/* ---- along a segment ------------------------------------------------------------------------- */

/* (path, speed, rate) => path, speed and their errors after s; includes the rounding of s. */
static void move(double s, double rate, double rate_error, double *path, double *speed,
                 double *path_error, double *speed_error) {
  /* s^2 may overflow where rate s^2 does not. */
  const double half = 0.5 * s, gain = rate * s, gain_error = rate_error * s;
  *path_error += *speed_error * s + gain_error * half +
                 ROT_EPS * (4.0 * fabs(*speed) * s + 6.0 * fabs(gain) * half);
  *speed_error += gain_error + 4.0 * ROT_EPS * fabs(gain);
  *path += *speed * s + gain * half;
  *speed += gain;
  *path_error += ROT_EPS * fabs(*path);
  *speed_error += ROT_EPS * fabs(*speed);
}

/* m * force * s * speed without intermediate overflow. */
static double heat(double m, double force, double s, double speed) {
  if (force == 0.0 || s == 0.0 || speed == 0.0) return 0.0;
  const double x = m * force * (s * speed);
  if (isfinite(x) && x > 1e-290) return x;
  return rot_product(4, (double[]){m, force, s, speed}, 1.0);
}

/* (segment, time) => state at a later time of the segment. */
static incline after(const incline *c, double time) {
  incline to = *c;
  const double s = time - c->time_s, m = c->p->mass_kg;
  double path = 0.0, path_error = 0.0;
  to.time_s = time;
  if (held(c) && time >= c->settled_s) to.w_error = 0.0;
  if (rests(c)) {
    if (time >= c->settled_s) to.v_error = to.w_error = 0.0;
    return to;
  }
  move(s, c->mean_rate, c->mean_rate_error, &path, &to.mean, &path_error, &to.mean_error);
  move(s, c->v_rate, c->v_rate_error, &to.x, &to.v, &to.x_error, &to.v_error);
  if (!held(c)) {
    move(s, c->w_rate, c->w_rate_error, &to.turn, &to.w, &to.turn_error, &to.w_error);
  }
  if (c->at.slip == 0) {
    to.v = to.w = to.mean;
    to.v_error = to.w_error = to.mean_error;
    if (time < c->settled_s) {
      to.v_error += c->on.own * c->slip_error;
      to.w_error += c->on.spin * c->slip_error;
    }
  } else {
    path = path_error = 0.0;
    move(s, c->slip_rate, c->slip_rate_error, &path, &to.slip, &path_error, &to.slip_error);
    /* Slip and spin have one sign on the segment: all parts of the heat are positive. */
    to.slip_heat += heat(m, fabs(c->force), 0.5 * s, fabs(c->slip + to.slip));
  }
  if (c->at.spin != 0) to.rolling_heat += heat(m, c->on.resists, 0.5 * s, fabs(c->w + to.w));
  return to;
}

static void end_slip(incline *c, const incline *from) {
  /* u s + u' s^2/2 with s = -u/u' is -u^2/(2 u'), free of the rounding of s. */
  const double path = 0.5 * from->slip * (-from->slip / from->slip_rate);
  c->slip_heat = from->slip_heat + from->p->mass_kg * fabs(from->force) * fabs(path);
  c->slip = 0.0;
  c->at.slip = 0;
  /* If omega is held, or 0 within its error, the body is at rest. */
  if (from->on.resists > 0.0 && (c->at.spin == 0 || fabs(c->mean) <= c->mean_error)) {
    c->mean = 0.0;
    c->at.spin = 0;
  }
}

/* At the rounded time w (and M, if rolling) is not exactly 0: set it. While slipping, M keeps its
 * value. */
static void end_spin(incline *c) {
  c->at.spin = 0;
  c->w_error += fabs(c->w);
  c->w = 0.0;
  if (c->at.slip != 0) return;
  c->mean_error += fabs(c->mean);
  c->mean = 0.0;
}

/* The error `late` of the time of an event changes later speeds by `late` times the change of their
 * rates. */
static void spread(incline *c, const incline *from, double late) {
  const double v = fabs(c->v_rate - from->v_rate) * late;
  const double w = fabs(c->w_rate - from->w_rate) * late;
  c->mean_error += fabs(c->mean_rate - from->mean_rate) * late;
  c->slip_error += fabs(c->slip_rate - from->slip_rate) * late;
  c->x_error += v * late;
  c->turn_error += w * late;
  c->settled_s = c->time_s + late;
  c->v_error += v;
  c->w_error += w;
  if (c->at.slip == 0) {
    /* Rolling: both speeds are the mean. At rest: error 0 after the event. */
    c->v = c->w = c->mean;
    c->v_error = rests(c) ? v : c->mean_error;
    c->w_error = rests(c) ? w : c->mean_error;
  }
}

rot_status rot_incline_log(rot_events *events, double time_s, rot_incline_directions from,
                           rot_incline_directions to, int rested, int rests, int turned) {
  if (!events) return ROT_OK;
  const struct {
    int happens;
    rot_event event;
  } log[] = {
      {rests && !rested, ROT_EVENT_STICK},
      {turned && !(rests && !rested), ROT_EVENT_REVERSE},
      {!rests && to.slip == 0 && (from.slip != 0 || rested), ROT_EVENT_ROLL},
      {from.slip == 0 && to.slip != 0, ROT_EVENT_SLIP},
      {from.slip * to.slip < 0, ROT_EVENT_SLIP_REVERSES},
  };
  for (size_t i = 0; i < sizeof log / sizeof *log; i++) {
    if (!log[i].happens) continue;
    const rot_status status = rot_events_add(events, time_s, log[i].event);
    if (status != ROT_OK) return status;
  }
  return ROT_OK;
}

/* segment => state at its end, next segment, events. */
static rot_status cross(incline *c, rot_events *events) {
  const incline from = *c;
  const double end = c->end_s;
  double late = ROT_EPS * fabs(end);
  *c = after(&from, end);
  if (from.ends == SLIP_ENDS) {
    late += c->slip_error / fabs(from.slip_rate);
    end_slip(c, &from);
  } else if (from.ends == SPIN_ENDS) {
    late += c->w_error / fabs(from.w_rate);
    end_spin(c);
  }
  const int turned = from.ends == TURNS || (from.ends == SPIN_ENDS && from.at.slip == 0) ||
                     (from.ends == SLIP_ENDS && held(&from));
  if (turned) c->direction = -from.direction;
  enter(c);
  if (from.ends != TURNS) spread(c, &from, late);
  const rot_status status = rot_incline_log(events, end, from.at, c->at, 0, rests(c), turned);
  if (status != ROT_OK) return status;
  return isfinite(c->x) && isfinite(c->turn) ? ROT_OK : ROT_ERANGE;
}

/* ---- rows ------------------------------------------------------------------------------------ */

rot_incline_row *rot_incline_event_row(rot_incline_event_rows *rows, double time_s) {
  if (rows->count && rows->row[rows->count - 1].time_s == time_s) {
    return &rows->row[rows->count - 1];
  }
  if (rows->count == rows->room) {
    const size_t room = rows->room ? 2 * rows->room : 8;
    rot_incline_row *more = realloc(rows->row, room * sizeof *more);
    if (!more) return NULL;
    rows->row = more;
    rows->room = room;
  }
  rows->row[rows->count] = (rot_incline_row){.time_s = time_s};
  return &rows->row[rows->count++];
}

void rot_incline_event_rows_free(rot_incline_event_rows *rows) {
  free(rows->row);
  *rows = (rot_incline_event_rows){0, 0, NULL};
}

rot_incline_columns rot_incline_columns_of(rot_incline_row *row) {
  return (rot_incline_columns){
#define X(type, name) &row->name,
      ROT_INCLINE_COLUMNS(X)
#undef X
  };
}

typedef struct incline_run {
  incline at;
  const double *time_s;
  const rot_incline_columns *out;
  rot_events *events;
  rot_incline_event_rows *at_events;
  rot_info *info;
} incline_run;

static void note(rot_info *info, int which, double value, double error) {
  rot_measure *measure = &info->measure[which];
  rot_note_value(measure, value);
  if (!(error <= measure->error)) measure->error = error;
}

typedef struct state {
  double x, v, theta, omega;
} state;

static state state_of(const incline *c) {
  const rot_incline_params *p = c->p;
  if (c->time_s == p->start_s) {
    return (state){p->x0_m, p->v0_m_per_s, p->theta0_rad, p->omega0_rad_per_s};
  }
  return (state){p->x0_m + c->x, c->v, p->theta0_rad + c->turn / p->radius_m, c->w / p->radius_m};
}

static void note_state(const incline *c, const state *at, rot_info *info, int with_error) {
  const double r = c->p->radius_m, on = with_error ? 1.0 : 0.0;
  note(info, ROT_INCLINE_X, at->x, on * (c->x_error + ROT_EPS * fabs(at->x)));
  note(info, ROT_INCLINE_V, at->v, on * (c->v_error + ROT_EPS * fabs(at->v)));
  note(info, ROT_INCLINE_THETA, at->theta,
       on * (c->turn_error / r + ROT_EPS * (fabs(at->theta) + 2.0 * fabs(c->turn / r))));
  note(info, ROT_INCLINE_OMEGA, at->omega, on * (c->w_error / r + 2.0 * ROT_EPS * fabs(at->omega)));
}

static rot_status restart(void *model, int forward) {
  incline_run *run = model;
  if (!forward) return ROT_EVALUE;
  enter(&run->at);
  return ROT_OK;
}

static int holds(const void *model, double time_s) {
  return !(((const incline_run *)model)->at.end_s <= time_s);
}

/* state => row i, its errors. */
static rot_status fill_row(const incline *at_time, const rot_incline_columns *out, size_t i,
                           rot_info *info) {
  const incline now = *at_time;
  const rot_incline_params *p = now.p;
  const state at = state_of(&now);
  const double w = p->radius_m * at.omega;
  if (!(isfinite(at.x) && isfinite(at.v) && isfinite(at.theta) && isfinite(at.omega))) {
    return ROT_ERANGE;
  }
  out->x_m[i] = at.x;
  out->v_m_per_s[i] = at.v;
  out->theta_rad[i] = at.theta;
  out->omega_rad_per_s[i] = at.omega;
  out->slip_speed_m_per_s[i] = now.at.slip == 0 ? 0.0 : now.slip;
  out->friction_force_n[i] = -p->mass_kg * now.force + 0.0;
  out->translational_kinetic_energy_j[i] = 0.5 * p->mass_kg * at.v * at.v;
  out->rotational_kinetic_energy_j[i] = 0.5 * p->mass_kg * now.on.beta * w * w;
  out->potential_energy_j[i] = -p->mass_kg * now.on.pull * at.x + 0.0;
  out->slip_heat_j[i] = now.slip_heat;
  out->rolling_heat_j[i] = now.rolling_heat;
  out->rolling[i] = now.at.slip == 0;
  note_state(&now, &at, info, now.time_s > p->start_s);
  return ROT_OK;
}

/* End of the present segment, next segment, row of the event. */
static rot_status next_piece(void *model, double *end_s) {
  incline_run *run = model;
  *end_s = run->at.end_s;
  const size_t before = run->events ? run->events->count : 0;
  const rot_status status = cross(&run->at, run->events);
  /* A spin that passes 0 while the contact slips ends a segment, but is no event. */
  const int logged = run->events && run->events->count > before;
  if (status != ROT_OK || !run->at_events || !logged) {
    const state at = state_of(&run->at);
    note_state(&run->at, &at, run->info, 0);
    return status;
  }
  rot_incline_row *row = rot_incline_event_row(run->at_events, *end_s);
  if (!row) return ROT_ENOMEM;
  const rot_incline_columns out = rot_incline_columns_of(row);
  return fill_row(&run->at, &out, 0, run->info);
}

static rot_status write_row(void *model, size_t i) {
  const incline_run *run = model;
  const incline now = after(&run->at, run->time_s[i]);
  return fill_row(&now, run->out, i, run->info);
}

rot_status rot_incline_run(const rot_incline_params *p, size_t n, const double time_s[],
                           const rot_incline_columns *out, rot_events *events,
                           rot_incline_event_rows *at_events, const rot_hooks *hooks,
                           rot_info *info) {
  static const rot_stepping stepping = {restart, holds, next_piece, write_row, NULL};
  incline_run run = {
      .time_s = time_s, .out = out, .events = events, .at_events = at_events, .info = info};
  rot_info_clear(info, rot_incline_measures);
  begin(&run.at, p);
  const state start = state_of(&run.at);
  note_state(&run.at, &start, info, 0);
  return rot_step_rows(&stepping, &run, p->start_s, n, time_s, hooks, info);
}

/* ---- state at one time ----------------------------------------------------------------------- */

static void note_sizes(const incline *c, double max[4]) {
  const state at = state_of(c);
  max[0] = fmax(max[0], fabs(at.x));
  max[1] = fmax(max[1], fabs(at.v));
  max[2] = fmax(max[2], fabs(at.theta));
  max[3] = fmax(max[3], fabs(at.omega));
}

rot_status rot_incline_to(const rot_incline_params *p, double time_s, rot_incline_end *end) {
  incline c;
  double max[4] = {0.0};
  if (!rot_incline_possible(p, time_s)) return ROT_EVALUE;
  begin(&c, p);
  enter(&c);
  note_sizes(&c, max);
  *end = (rot_incline_end){.roll_s = NAN};
  while (c.end_s <= time_s) {
    const int slips = c.at.slip != 0;
    const double at = c.end_s;
    const rot_status status = cross(&c, NULL);
    if (status != ROT_OK) return status;
    if (slips && c.at.slip == 0 && !rests(&c) && isnan(end->roll_s)) end->roll_s = at;
    note_sizes(&c, max);
  }
  c = after(&c, time_s);
  note_sizes(&c, max);
  const state at = state_of(&c);
  rot_info info;
  rot_info_measures(&info, rot_incline_measures);
  note_state(&c, &at, &info, time_s > p->start_s);
  *end = (rot_incline_end){at.x,           at.v,        at.theta, at.omega,      c.slip_heat,
                           c.rolling_heat, end->roll_s, 0.0,      c.at.slip == 0};
  for (int i = 0; i < 4; i++) {
    end->error = fmax(end->error, rot_relative_error(info.measure[i].error, max[i]));
  }
  const int finite = isfinite(at.x) && isfinite(at.v) && isfinite(at.theta) && isfinite(at.omega);
  return finite ? ROT_OK : ROT_ERANGE;
}

/* ---- work and impulses ----------------------------------------------------------------------- */

static void add_flows(const incline *from, const incline *to, rot_incline_ledger *sum) {
  const double s = to->time_s - from->time_s, m = from->p->mass_kg, r = from->p->radius_m;
  const double path = to->x - from->x;
  const double off = from->x_error + to->x_error + 4.0 * ROT_EPS * (fabs(from->x) + fabs(to->x));
  sum->work_j += m * from->on.pull * path;
  sum->work_rounding_j += m * fabs(from->on.pull) * (off + 8.0 * ROT_EPS * fabs(path));
  sum->gravity_impulse_n_s += m * from->on.pull * s;
  sum->friction_impulse_n_s -= m * from->force * s;
  sum->resistance_impulse_n_m_s += m * from->torque * r * s;
  const double rounding = 16.0 * ROT_EPS * m * (s + fabs(to->time_s));
  sum->gravity_rounding_n_s += rounding * fabs(from->on.pull);
  sum->friction_rounding_n_s += rounding * fabs(from->force);
  sum->resistance_rounding_n_m_s += rounding * fabs(from->torque) * r;
}

rot_status rot_incline_flows(const rot_incline_params *p, double from_s, double to_s,
                             rot_incline_ledger *ledger) {
  incline c;
  rot_status status = ROT_OK;
  *ledger = (rot_incline_ledger){0};
  if (!(from_s >= p->start_s && to_s >= from_s)) return ROT_EVALUE;
  begin(&c, p);
  enter(&c);
  while (status == ROT_OK && c.end_s <= from_s) status = cross(&c, NULL);
  if (status == ROT_OK) c = after(&c, from_s);
  while (status == ROT_OK && c.end_s < to_s) {
    incline next = c;
    status = cross(&next, NULL);
    add_flows(&c, &next, ledger);
    c = next;
  }
  if (status != ROT_OK) return status;
  const incline last = after(&c, to_s);
  add_flows(&c, &last, ledger);
  return isfinite(ledger->work_j) ? ROT_OK : ROT_ERANGE;
}

double rot_incline_critical_deg(double beta, double mu_static) {
  const double degrees = 57.29577951308232; /* 180/pi */
  if (isnan(beta) || isnan(mu_static)) return NAN;
  if (beta == 0.0 || isinf(mu_static)) return 90.0;
  return degrees * atan(mu_static * (1.0 + 1.0 / beta));
}
