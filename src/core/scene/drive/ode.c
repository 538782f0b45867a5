#include "scene/drive/ode.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "scene/drive/contact.h"
#include "scene/drive/ledger.h"
#include "scene/drive/mesh.h"
#include "scene/drive/time_scales.h"
#include "engine/ode/ode.h"
#include "ground/real.h"
#include "ground/search.h"

/* Components after the state: integrals; heat of the resistance of each rotor, of its brake, of
 * each coupling; the number of the mode set, for the rows. */
enum { WORK, TORQUE, RESISTANCE, HOUSING, INTEGRALS };

typedef struct motion {
  rot_drive_system s;
  size_t dim;                                           /* number of components */
  size_t resistance_at, brake_at, coupling_at, mode_at; /* first components of the heats, mode */
  double *breaks, *slope, *y;
  size_t n_breaks;
  signed char *modes; /* n_modes rows: sets of modes; row 0: the start, used there only */
  size_t n_modes, room;
  signed char *now, *before;
  int mode; /* present row of `modes` */
  double span_s, noise[3];
  double rounding, rounds[3]; /* of the rates: moving, and as the state is */
  double max[2];              /* largest |theta|, |omega| so far */
  rot_status failed;          /* status of an event function, returned by the next rhs */
  rot_events *events;
} motion;

static signed char *modes_of(const motion *m, int mode) {
  return m->modes + (size_t)mode * m->s.n_contacts;
}

/* ---- the right-hand side --------------------------------------------------------------------- */

/* (t, state) => rates of state, integrals and heats, in the present modes. */
static rot_status drive_rhs(double t, const double y[], double dydt[], void *ctx) {
  motion *m = ctx;
  rot_drive_system *s = &m->s;
  const rot_drive_scene *scene = s->scene;
  const signed char *mode = modes_of(m, m->mode);
  rot_status status = m->failed;
  if (status == ROT_OK) status = rot_drive_forces(s, t, y, mode);
  if (status != ROT_OK) return status;
  rot_drive_rates(s, y, mode, dydt);
  double work = 0.0, torque = 0.0, resistance = 0.0, housing = 0.0;
  for (size_t i = 0; i < s->n; i++) {
    const double omega = rot_drive_omega(s, y, i);
    work += s->applied[i] * omega;
    torque += s->applied[i];
    resistance += s->smooth[i] + s->dry[i] + s->brake[i];
    dydt[m->resistance_at + i] = -(s->smooth[i] + s->dry[i]) * omega;
    dydt[m->brake_at + i] = -s->brake[i] * omega;
    if (i + 1 == s->n) break;
    const rot_drive_coupling *c = &scene->coupling[i];
    double heat = 0.0;
    if (c->kind == ROT_DRIVE_SHAFT) {
      const double rate = dydt[s->state_of[i]];
      heat = c->damping_n_m_s * rate * rate;
    } else if (c->kind == ROT_DRIVE_CLUTCH) {
      heat = mode[s->contact_of[i]] == ROT_DRIVE_STICKS ? 0.0 : s->torque[i] * y[s->state_of[i]];
    } else {
      heat = (1.0 - s->passed[i]) * s->torque[i] * omega;
    }
    dydt[m->coupling_at + i] = heat;
    housing += (c->ratio * s->passed[i] - 1.0) * s->torque[i];
  }
  dydt[s->state + WORK] = work;
  dydt[s->state + TORQUE] = torque;
  dydt[s->state + RESISTANCE] = resistance;
  dydt[s->state + HOUSING] = housing;
  dydt[m->mode_at] = 0.0;
  return ROT_OK;
}

static void new_positions(double t, double h, const double before[], double y[], void *ctx) {
  const motion *m = ctx;
  (void)t;
  rot_drive_positions(&m->s, h, before, y);
}

/* ---- modes ----------------------------------------------------------------------------------- */

/* modes => their row: an earlier one, or a new one. */
static rot_status number_modes(motion *m, const signed char mode[], int *number) {
  const size_t k = m->s.n_contacts;
  for (size_t i = 1; i < m->n_modes; i++) {
    if (!memcmp(m->modes + i * k, mode, k)) {
      *number = (int)i;
      return ROT_OK;
    }
  }
  if (m->n_modes == m->room) {
    const size_t room = 2 * m->room;
    signed char *modes = realloc(m->modes, room * (k ? k : 1));
    if (!modes) return ROT_ENOMEM;
    m->modes = modes;
    m->room = room;
  }
  if (k) memcpy(m->modes + m->n_modes * k, mode, k);
  *number = (int)m->n_modes++;
  return ROT_OK;
}

/* Place of contact k in events: first rotor with friction of its unit. */
static int place_of(const motion *m, size_t k) {
  const rot_drive_contact *c = &m->s.contact[k];
  const rot_drive_unit *u = &m->s.unit[c->unit];
  if (c->coupling != SIZE_MAX) return -(int)(c->coupling + 1);
  for (size_t i = u->first; i < u->end; i++) {
    if (m->s.scene->brake[i].acts || m->s.scene->rotor[i].static_n_m > 0.0) return (int)(i + 1);
  }
  return (int)(u->first + 1);
}

/* (modes before, after) => events. Changes from open to slipping are none, nor are those without
 * capacity, unless the slip of a clutch changes its sign; a lossy gear resists, though it has
 * none. */
static rot_status log_changes(motion *m, double t, const signed char before[],
                              const signed char after[]) {
  rot_status status = ROT_OK;
  for (size_t k = 0; k < m->s.n_contacts && status == ROT_OK; k++) {
    const int sticks = after[k] == ROT_DRIVE_STICKS, stuck = before[k] == ROT_DRIVE_STICKS;
    const int clutch = m->s.contact[k].coupling != SIZE_MAX;
    const int resists =
        m->s.capacity[k] > 0.0 || (!clutch && m->s.unit[m->s.contact[k].unit].lossy);
    const int turns = clutch && !stuck && before[k] != ROT_DRIVE_OPEN &&
                      rot_drive_slip_rate(&m->s, k) * (double)before[k] < 0.0;
    if (before[k] == after[k] || (!sticks && !resists && !stuck && !turns)) continue;
    if (before[k] == ROT_DRIVE_OPEN && !sticks) continue;
    const rot_event event = sticks  ? (clutch ? ROT_EVENT_LOCK : ROT_EVENT_STICK)
                            : stuck ? ROT_EVENT_SLIP
                                    : ROT_EVENT_REVERSE;
    status = rot_events_add_at(m->events, t, event, place_of(m, k));
  }
  return status;
}

/* t => time just after t if t is a break: value of the laws after it. */
static double side_after(const motion *m, double t) {
  const size_t k = rot_lower_bound(m->n_breaks, m->breaks, t);
  return k < m->n_breaks && m->breaks[k] == t ? nextafter(t, INFINITY) : t;
}

static double ahead(const motion *m, double t) {
  const size_t k = rot_upper_bound(m->n_breaks, m->breaks, t);
  const double next = k < m->n_breaks ? 0.25 * (m->breaks[k] - t) : INFINITY;
  return fmax(fmin(next, 1e-9 * m->span_s), 0.0);
}

/* Rounding of the rates: proportional to the sum of the torques. Without it no step would pass the
 * error test where the motion starts within rounding. */
static void note_noise(motion *m) {
  double max = 0.0;
  double off = 0.0; /* of sampled laws */
  for (size_t u = 0; u < m->s.m; u++) max = fmax(max, m->s.size[u] / m->s.unit[u].inertia);
  for (size_t i = 0; i < m->s.n; i++) {
    const rot_axle_scene *rotor = &m->s.scene->rotor[i];
    off = fmax(off, rotor->noise_n_m / rotor->linear.inertia_kg_m2);
  }
  m->noise[1] = 4.0 * ROT_EPS * max + off;
  m->noise[0] = m->noise[2] = m->noise[1] * m->span_s;
  m->rounding = ROT_EPS * max + off;
}

/* Sticking bodies come to rest together: after the event of one of them the others have a rate
 * within rounding: set to 0. */
static void round_to_rest(const motion *m, double y[]) {
  for (size_t k = 0; k < m->s.n_contacts; k++) {
    double *speed = &y[m->s.contact[k].state];
    const int beyond = *speed * (double)modes_of(m, m->mode)[k] < 0.0;
    if (fabs(*speed) <= (beyond ? 1e-10 : 64.0 * ROT_EPS) * m->max[1]) *speed = 0.0;
  }
}

static rot_status settle_in(motion *m, double t, double y[], int breaks) {
  const size_t k = m->s.n_contacts;
  round_to_rest(m, y);
  memcpy(m->before, modes_of(m, m->mode), k);
  memcpy(m->now, m->before, k);
  rot_status status = rot_drive_settle(&m->s, side_after(m, t), y, m->now, breaks, ahead(m, t));
  if (status == ROT_OK) status = log_changes(m, t, m->before, m->now);
  if (status == ROT_OK) status = number_modes(m, m->now, &m->mode);
  if (status != ROT_OK) m->failed = status;
  y[m->mode_at] = (double)m->mode;
  note_noise(m);
  return status;
}

/* ---- events ---------------------------------------------------------------------------------- */

/* Replaces the engine's generic log entry by the actual events. */
static rot_ode_then settle_at(double t, double y[], int *mode, void *ctx, int breaks) {
  motion *m = ctx;
  if (m->events && m->events->count) m->events->count--;
  settle_in(m, t, y, breaks);
  *mode = m->mode;
  return ROT_ODE_NEW_SEGMENT;
}

static rot_ode_then at_zero(double t, double y[], int *mode, int forward, void *ctx) {
  (void)forward;
  return settle_at(t, y, mode, ctx, 0);
}

static rot_ode_then at_limit(double t, double y[], int *mode, int forward, void *ctx) {
  (void)forward;
  return settle_at(t, y, mode, ctx, 1);
}

/* Quadratic drag has a kink at rest: a new segment. */
static rot_ode_then at_kink(double t, double y[], int *mode, int forward, void *ctx) {
  const motion *m = ctx;
  if (forward && m->s.n_contacts) return settle_at(t, y, mode, ctx, 0);
  if (m->events && m->events->count) m->events->count--;
  return ROT_ODE_NEW_SEGMENT;
}

static double margin_at(double t, const double y[], void *ctx) {
  motion *m = ctx;
  if (m->failed != ROT_OK) return 1.0;
  const rot_status status = rot_drive_forces(&m->s, t, y, modes_of(m, m->mode));
  if (status != ROT_OK) m->failed = status;
  return status == ROT_OK ? m->s.weakest.margin : 1.0;
}

static void cross_break(double t, double y[], int forward, void *ctx) {
  motion *m = ctx;
  if (forward && m->s.n_contacts && m->failed == ROT_OK) settle_in(m, t, y, 0);
}

/* Observer, called at the end of each step and in each row. */
static void note_state(double t, double y[], void *ctx) {
  motion *m = ctx;
  (void)t;
  for (size_t i = 0; i < m->s.n; i++) {
    const double theta0 = m->s.scene->rotor[i].linear.theta0_rad;
    const double theta = theta0 + m->s.fraction[i] * y[m->s.unit_of[i]];
    m->max[0] = fmax(m->max[0], fabs(theta));
    m->max[1] = fmax(m->max[1], fabs(rot_drive_omega(&m->s, y, i)));
  }
  m->rounds[1] = 0.0; /* at rest: it is held, and steps are long */
  for (size_t u = 0; u < m->s.m; u++) {
    if (y[m->s.m + u] != 0.0) m->rounds[1] = m->rounding;
  }
}

/* ---- the scene ------------------------------------------------------------------------------- */

static int compare(const void *a, const void *b) {
  const double x = *(const double *)a, y = *(const double *)b;
  return (x > y) - (x < y);
}

static size_t add_friction_breaks(const rot_drive_friction *friction, double out[]) {
  if (!friction->acts) return 0;
  size_t n = rot_axle_scene_breaks(&friction->law, out);
  if (isfinite(friction->from_s)) out[n++] = friction->from_s;
  if (isfinite(friction->to_s)) out[n++] = friction->to_s;
  return n;
}

/* Breaks of all laws and friction windows, sorted, unique. */
static rot_status collect_breaks(motion *m) {
  const rot_drive_scene *scene = m->s.scene;
  size_t room = 1, n = 0;
  for (size_t i = 0; i < scene->n; i++) {
    room += rot_axle_scene_room(&scene->rotor[i]);
    if (scene->brake[i].acts) room += 2 + rot_axle_scene_room(&scene->brake[i].law);
    if (i + 1 < scene->n && scene->coupling[i].friction.acts) {
      room += 2 + rot_axle_scene_room(&scene->coupling[i].friction.law);
    }
  }
  m->breaks = malloc(room * sizeof *m->breaks);
  if (!m->breaks) return ROT_ENOMEM;
  for (size_t i = 0; i < scene->n; i++) {
    n += rot_axle_scene_breaks(&scene->rotor[i], m->breaks + n);
    n += add_friction_breaks(&scene->brake[i], m->breaks + n);
    if (i + 1 < scene->n) n += add_friction_breaks(&scene->coupling[i].friction, m->breaks + n);
  }
  qsort(m->breaks, n, sizeof *m->breaks, compare);
  m->n_breaks = 0;
  for (size_t i = 0; i < n; i++) {
    if (m->n_breaks == 0 || m->breaks[i] != m->breaks[m->n_breaks - 1]) {
      m->breaks[m->n_breaks++] = m->breaks[i];
    }
  }
  return ROT_OK;
}

static int law_has_curve(const rot_axle_scene *law) {
  for (size_t i = 0; i < law->n_terms; i++) {
    if (law->terms[i].kind == ROT_TERM_CURVE) return 1;
  }
  return 0;
}

/* 1 if kinks occur at unknown times: a capacity that is not piecewise linear in time reaches 0; the
 * power through a lossy gear changes its sign. */
static int has_kinks(const rot_drive_scene *scene) {
  int kinks = 0;
  for (size_t i = 0; i < scene->n; i++) {
    const rot_drive_friction *friction[] = {&scene->brake[i],
                                            i + 1 < scene->n ? &scene->coupling[i].friction : NULL};
    kinks |= law_has_curve(&scene->rotor[i]);
    kinks |= i + 1 < scene->n && rot_drive_mesh_loses(&scene->coupling[i]);
    for (int k = 0; k < 2; k++) {
      kinks |= friction[k] && friction[k]->acts &&
               (friction[k]->law.n_terms || friction[k]->law.linear.torque.call);
    }
  }
  return kinks;
}

/* 1 if a torque or a capacity is a function of the caller. */
static int calls_law(const rot_drive_scene *scene) {
  int calls = 0;
  for (size_t i = 0; i < scene->n; i++) {
    calls |= scene->rotor[i].linear.torque.call != NULL ||
             scene->brake[i].law.linear.torque.call != NULL;
    if (i + 1 < scene->n) calls |= scene->coupling[i].friction.law.linear.torque.call != NULL;
  }
  return calls;
}

/* scene => motion with its memory. */
static rot_status motion_new(motion *m, const rot_drive_scene *scene, double span_s) {
  memset(m, 0, sizeof *m);
  m->span_s = span_s;
  rot_status status = rot_drive_system_new(&m->s, scene);
  if (status == ROT_OK) status = collect_breaks(m);
  if (status != ROT_OK) return status;
  const size_t k = m->s.n_contacts ? m->s.n_contacts : 1;
  m->resistance_at = m->s.state + INTEGRALS;
  m->brake_at = m->resistance_at + scene->n;
  m->coupling_at = m->brake_at + scene->n;
  m->mode_at = m->coupling_at + scene->n - 1;
  m->dim = m->mode_at + 1;
  m->room = 16;
  m->modes = calloc(m->room, k);
  m->now = calloc(2, k);
  m->y = calloc(2 * m->dim, sizeof *m->y);
  if (!m->modes || !m->now || !m->y) return ROT_ENOMEM;
  m->before = m->now + k;
  m->slope = m->y + m->dim;
  m->n_modes = 1;
  return ROT_OK;
}

static void motion_free(motion *m) {
  rot_drive_system_free(&m->s);
  free(m->breaks);
  free(m->modes);
  free(m->now);
  free(m->y);
}

/* state at the start => row 0 of the modes. */
static rot_status settle_at_start(motion *m) {
  const double start = m->s.scene->start_s;
  rot_drive_start(&m->s, m->y);
  if (m->s.n_contacts == 0) return rot_drive_forces(&m->s, side_after(m, start), m->y, m->modes);
  return rot_drive_settle(&m->s, side_after(m, start), m->y, m->modes, 0, ahead(m, start));
}

/* ---- rows ------------------------------------------------------------------------------------ */

/* (t, state) => rows of all rotors, ledger. */
static rot_status fill_row(motion *m, size_t row, double t, double y[],
                           const rot_drive_columns *out, const rot_drive_ledger *sums) {
  rot_drive_system *s = &m->s;
  const signed char *mode = modes_of(m, (int)y[m->mode_at]);
  rot_status status = ROT_OK;
  if (s->n_contacts && side_after(m, t) != t &&
      t >= s->scene->start_s) { /* after a jump, as the laws */
    memcpy(m->now, mode, s->n_contacts);
    status = rot_drive_settle(s, side_after(m, t), y, m->now, 0, ahead(m, t));
    mode = m->now;
  }
  if (status == ROT_OK) status = rot_drive_forces(s, t, y, mode);
  if (status != ROT_OK) return status;
  for (size_t i = 0; i < s->n; i++) {
    const size_t at = row * s->n + i;
    const rot_axle_scene *r = &s->scene->rotor[i];
    const double omega = rot_drive_omega(s, y, i);
    const int last = i + 1 == s->n;
    out->theta_rad[at] = r->linear.theta0_rad + s->fraction[i] * y[s->unit_of[i]];
    out->omega_rad_per_s[at] = omega;
    out->angular_momentum_kg_m2_per_s[at] = r->linear.inertia_kg_m2 * omega;
    out->rotational_kinetic_energy_j[at] = 0.5 * r->linear.inertia_kg_m2 * omega * omega;
    out->applied_torque_n_m[at] = s->applied[i];
    out->damping_torque_n_m[at] = 0.0 + s->smooth[i] + s->dry[i] + s->brake[i];
    out->coupling_torque_n_m[at] = last ? 0.0 : s->torque[i];
    out->locked[at] =
        !last && s->contact_of[i] != SIZE_MAX && mode[s->contact_of[i]] == ROT_DRIVE_STICKS;
    out->heat_j[at] = y[m->resistance_at + i] + y[m->brake_at + i];
    out->coupling_heat_j[at] = last ? 0.0 : y[m->coupling_at + i];
    if (!isfinite(s->applied[i])) return ROT_ETORQUE;
  }
  sums->work_j[row] = y[s->state + WORK];
  sums->torque_impulse_n_m_s[row] = y[s->state + TORQUE];
  sums->resistance_impulse_n_m_s[row] = y[s->state + RESISTANCE];
  sums->housing_impulse_n_m_s[row] = y[s->state + HOUSING];
  sums->resistance_j[row] = sums->brake_j[row] = 0.0;
  sums->damper_j[row] = sums->clutch_j[row] = sums->mesh_j[row] = 0.0;
  for (size_t i = 0; i < s->n; i++) {
    sums->resistance_j[row] += y[m->resistance_at + i];
    sums->brake_j[row] += y[m->brake_at + i];
    if (i + 1 == s->n) break;
    double *const heat[] = {sums->damper_j, sums->clutch_j, sums->mesh_j};
    heat[s->scene->coupling[i].kind][row] += y[m->coupling_at + i];
  }
  return ROT_OK;
}

static rot_status fill_rows(motion *m, size_t n, const double time_s[], double y[],
                            const rot_drive_columns *out, const rot_drive_ledger *sums,
                            rot_info *info) {
  const size_t reached = info->rows_done;
  info->rows_done = 0;
  for (size_t i = 0; i < n && i < reached; i++) {
    const rot_status status = fill_row(m, i, time_s[i], y + i * m->dim, out, sums);
    if (status != ROT_OK) {
      info->time_s = time_s[i];
      return status;
    }
    info->rows_done = i + 1;
  }
  return ROT_OK;
}

/* The error of a unit bounds that of its rotors: its coordinate is the fastest one. */
static void note_errors(const motion *m, size_t n_groups, const double error[], rot_info *info,
                        rot_drive_ledger *sums) {
  const double *integral = error + n_groups;
  info->measure[ROT_THETA].error = error[0] + 4.0 * ROT_EPS * m->max[0];
  info->measure[ROT_THETA].largest = m->max[0];
  info->measure[ROT_OMEGA].error = error[1];
  info->measure[ROT_OMEGA].largest = m->max[1];
  sums->work_error_j = 2.0 * integral[WORK];
  sums->impulse_error_n_m_s = 2.0 * (integral[TORQUE] + integral[RESISTANCE] + integral[HOUSING]);
  sums->twist_error_rad = n_groups == 3 ? error[2] : 0.0;
  sums->heat_error_j = 0.0;
  for (size_t i = m->resistance_at; i < m->mode_at; i++) {
    sums->heat_error_j += 2.0 * integral[i - m->s.state];
  }
}

/* ---- the run --------------------------------------------------------------------------------- */

/* (mode, component) => sign of the slip after breaking loose. If static and kinetic capacity are
 * equal, the slip rate is 0 up to rounding: take the sign from the mode. */
static int direction_of_slip(int mode, size_t component, void *ctx) {
  const motion *m = ctx;
  for (size_t k = 0; k < m->s.n_contacts; k++) {
    const signed char sign = modes_of(m, mode)[k];
    if (m->s.contact[k].state == component) return sign == ROT_DRIVE_OPEN ? 0 : sign;
  }
  return 0;
}

/* Event functions: slip speeds, kinks, margin. Returns their number. */
static size_t list_events(const motion *m, rot_ode_event event[]) {
  const rot_drive_system *s = &m->s;
  size_t n = 0;
  for (size_t k = 0; k < s->n_contacts; k++) {
    event[n++] = (rot_ode_event){.g = NULL,
                                 .component = s->contact[k].state,
                                 .name = ROT_EVENT_REVERSE,
                                 .then = at_zero,
                                 .side = direction_of_slip};
  }
  for (size_t u = 0; u < s->m; u++) {
    if (s->unit[u].quadratic && s->unit[u].ground == SIZE_MAX) {
      event[n++] = (rot_ode_event){
          .g = NULL, .component = s->m + u, .name = ROT_EVENT_REVERSE, .then = at_kink};
    }
  }
  if (s->n_contacts) {
    event[n++] =
        (rot_ode_event){.g = margin_at, .direction = -1, .name = ROT_EVENT_SLIP, .then = at_limit};
  }
  return n;
}

/* A sinusoidal torque acts for ever; neither friction against the ground nor a self-locking gear
 * may hold it. */
static int never_rests(const rot_drive_scene *scene) {
  int driven = 0;
  for (size_t i = 0; i < scene->n; i++) {
    const rot_axle_scene *rotor = &scene->rotor[i];
    if (rotor->coulomb_n_m != 0.0 || rotor->static_n_m != 0.0 || scene->brake[i].acts) return 0;
    if (i + 1 < scene->n && rot_drive_mesh_loses(&scene->coupling[i])) return 0;
    for (size_t k = 0; k < rotor->n_terms; k++) {
      const rot_term *term = &rotor->terms[k];
      driven |= term->kind == ROT_TERM_SINUSOID && term->x[0] != 0.0 && term->x[1] != 0.0 &&
                term->to_s == INFINITY;
    }
  }
  return driven;
}

/* Without losses vibrations last, and with them the short steps. */
static int is_damped(const rot_drive_scene *scene) {
  int damped = 0;
  for (size_t i = 0; i < scene->n; i++) {
    damped |= scene->rotor[i].linear.viscous_n_m_s != 0.0 || scene->rotor[i].motor_n_m_s != 0.0;
    damped |= i + 1 < scene->n && scene->coupling[i].damping_n_m_s != 0.0;
  }
  return damped;
}

/* => rot_ode_params.fades_s and steady: without friction that may hold, with linear losses */
static double fades_s_of(const motion *m, double shortest_s, int *steady) {
  const rot_drive_scene *scene = m->s.scene;
  int unknown = m->s.n_contacts || m->s.n_slips || has_kinks(scene) || calls_law(scene);
  for (size_t i = 0; i < scene->n; i++) {
    const rot_axle_scene *rotor = &scene->rotor[i];
    unknown |= rotor->quadratic_n_m_s2 != 0.0 || rotor->coulomb_n_m != 0.0 ||
               rotor->static_n_m != 0.0 || scene->brake[i].acts;
  }
  *steady = !unknown && !is_damped(scene);
  if (never_rests(scene) || *steady) return INFINITY;
  return unknown ? 0.0 : shortest_s;
}

/* (options, times) => rows, ledger, errors by rot_ode_run(). */
static rot_status run(motion *m, const rot_drive_ode_options *options, size_t n,
                      const double time_s[], double y[], const rot_drive_columns *out,
                      rot_drive_ledger *sums, const rot_hooks *hooks, rot_info *info) {
  const rot_drive_system *s = &m->s;
  const size_t rates = s->m + s->n_slips;
  const rot_ode_group groups[] = {{0, s->m, ROT_ODE_VECTOR},
                                  {s->m, rates, ROT_ODE_VECTOR},
                                  {s->m + rates, s->n_twists, ROT_ODE_VECTOR}};
  const size_t n_groups = s->n_twists ? 3 : 2;
  double *error = calloc(2 * m->dim, sizeof *error);
  rot_ode_event *event = calloc(s->n_contacts + s->m + 1, sizeof *event);
  int offset = 0;
  for (size_t i = 0; i < s->n; i++) offset |= s->scene->rotor[i].linear.theta0_rad != 0.0;
  rot_status status = error && event ? settle_at_start(m) : ROT_ENOMEM;
  if (status == ROT_OK) {
    rot_time_scales time_scales;
    rot_drive_time_scales_of_start(s->scene, &time_scales);
    int steady;
    const double fades_s = fades_s_of(m, time_scales.fades_s, &steady);
    note_noise(m);
    note_state(s->scene->start_s, m->y, m);
    const rot_ode_params ode = {
        .dim = m->dim,
        .controlled = s->state,
        .n_groups = n_groups,
        .groups = groups,
        .rhs = drive_rhs,
        .ctx = m,
        .n_breaks = m->n_breaks,
        .breaks = m->breaks,
        .start_s = s->scene->start_s,
        .start = m->y,
        /* Relative to the largest value of all rotors, which their norm may exceed; and to theta,
         * which may be half of |theta - theta0|. */
        .accuracy = (offset ? 0.5 : 1.0) / sqrt((double)rates) * options->accuracy,
        .max_steps = options->max_steps,
        .method = options->method,
        .mode = &m->mode,
        .n_events = list_events(m, event),
        .events = event,
        .log = m->events,
        .at_break = cross_break,
        .project = note_state,
        .noise = m->noise,
        .rounds = m->rounds,
        .integrals_between = 1,
        .resolution = rot_ode_resolution(calls_law(s->scene), options->resolution),
        .kinks = has_kinks(s->scene),
        .fades_s = fades_s,
        .steady = steady,
        .settles_s = calls_law(s->scene) ? 0.0 : ROT_SETTLED * time_scales.fades_s,
        .step_s = rot_ode_is_fixed(options->method) ? options->step_s : 0.0,
        .positions = new_positions};
    status = rot_ode_run(&ode, n, time_s, y, NULL, error, error + m->dim, hooks, info);
    if (status == ROT_ERHS) status = ROT_ETORQUE;
    if (status != ROT_EUNWIND && status != ROT_ENOMEM) {
      const rot_status rows = fill_rows(m, n, time_s, y, out, sums, info);
      if (rows != ROT_OK) status = rows;
    }
    note_errors(m, n_groups, error, info, sums);
  }
  free(event);
  free(error);
  return status;
}

/* Integrates; a second time if the chosen method turns out too inaccurate. */
rot_status rot_drive_integrate(const rot_drive_scene *scene, const rot_drive_ode_options *options,
                               size_t n, const double time_s[], const rot_drive_columns *out,
                               rot_drive_ledger *ledger, rot_events *events, const rot_hooks *hooks,
                               rot_info *info) {
  motion m;
  const double start = scene->start_s;
  const double span = n ? fmax(fabs(time_s[0] - start), fabs(time_s[n - 1] - start)) : 0.0;
  rot_info_clear(info, rot_turning);
  ledger->work_error_j = ledger->heat_error_j = 0.0;
  ledger->impulse_error_n_m_s = ledger->twist_error_rad = 0.0;
  rot_status status = motion_new(&m, scene, span);
  m.events = events;
  double *y = status == ROT_OK ? malloc((n ? n : 1) * m.dim * sizeof *y) : NULL;
  if (!y) status = ROT_ENOMEM;
  if (status == ROT_OK) {
    status = run(&m, options, n, time_s, y, out, ledger, hooks, info);
    /* A switch to the implicit method kept the tolerance of the explicit one: repeat. */
    if (status == ROT_OK && options->method == ROT_METHOD_NONE &&
        info->method == ROT_METHOD_RADAU && rot_info_error(info) > options->accuracy) {
      const rot_drive_ode_options implicit = {options->accuracy, options->max_steps,
                                              ROT_METHOD_RADAU, options->resolution, 0.0};
      m.mode = 0;
      status = run(&m, &implicit, n, time_s, y, out, ledger, hooks, info);
    }
  }
  rot_drive_elastic(scene, info->rows_done, out, info, ledger);
  free(y);
  motion_free(&m);
  return info->status = status;
}
