#include "scene/drive/forces.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "scene/drive/mesh.h"
#include "ground/real.h"

/* ---- the system ------------------------------------------------------------------------------ */

static int has_dry(const rot_drive_scene *scene, size_t i) {
  const rot_axle_scene *r = &scene->rotor[i];
  return r->coulomb_n_m != 0.0 || r->static_n_m != 0.0 || scene->brake[i].acts;
}

/* Groups of geared rotors; fraction: d theta_i / d coordinate. */
static void find_units(rot_drive_system *s) {
  const rot_drive_scene *scene = s->scene;
  s->m = 0;
  for (size_t i = 0; i < s->n; i++) {
    const int joined = i > 0 && scene->coupling[i - 1].kind == ROT_DRIVE_GEAR;
    s->product[i] = i ? s->product[i - 1] * scene->coupling[i - 1].ratio : 1.0;
    if (!joined) {
      s->unit[s->m].first = i;
      s->unit[s->m].scale = INFINITY;
      s->unit[s->m++].ground = SIZE_MAX;
    }
    rot_drive_unit *u = &s->unit[s->m - 1];
    u->end = i + 1;
    u->scale = fmin(u->scale, fabs(s->product[i]));
    u->quadratic |= scene->rotor[i].quadratic_n_m_s2 != 0.0;
    u->lossy |= joined && rot_drive_mesh_loses(&scene->coupling[i - 1]);
    s->passed[i] = 1.0;
    s->unit_of[i] = s->m - 1;
  }
  for (size_t i = 0; i < s->n; i++) {
    rot_drive_unit *u = &s->unit[s->unit_of[i]];
    s->fraction[i] = u->scale / s->product[i];
    u->inertia += scene->rotor[i].linear.inertia_kg_m2 * s->fraction[i] * s->fraction[i];
  }
}

/* Contacts to ground and clutches; components of slip speeds and twists. */
static void find_contacts(rot_drive_system *s) {
  const rot_drive_scene *scene = s->scene;
  for (size_t u = 0; u < s->m; u++) {
    int dry = s->unit[u].lossy;
    for (size_t i = s->unit[u].first; i < s->unit[u].end; i++) dry |= has_dry(scene, i);
    if (!dry) continue;
    s->unit[u].ground = s->n_contacts;
    s->contact[s->n_contacts++] = (rot_drive_contact){u, SIZE_MAX, s->m + u};
  }
  for (size_t j = 0; j + 1 < s->n; j++) {
    s->contact_of[j] = s->state_of[j] = SIZE_MAX;
    if (scene->coupling[j].kind != ROT_DRIVE_CLUTCH) continue;
    s->contact_of[j] = s->n_contacts;
    s->state_of[j] = 2 * s->m + s->n_slips++;
    s->contact[s->n_contacts++] = (rot_drive_contact){s->unit_of[j], j, s->state_of[j]};
  }
  for (size_t j = 0; j + 1 < s->n; j++) {
    if (scene->coupling[j].kind != ROT_DRIVE_SHAFT) continue;
    s->state_of[j] = 2 * s->m + s->n_slips + s->n_twists++;
  }
  s->state = 2 * s->m + s->n_slips + s->n_twists;
}

/* One block of memory for all arrays. */
rot_status rot_drive_system_new(rot_drive_system *s, const rot_drive_scene *scene) {
  const size_t n = scene->n;
  memset(s, 0, sizeof *s);
  s->scene = scene;
  s->n = n;
  double **numbers[] = {&s->product,      &s->fraction,  &s->applied, &s->smooth, &s->dry,
                        &s->brake,        &s->dry_cap,   &s->torque,  &s->force,  &s->size,
                        &s->hold,         &s->brake_cap, &s->alpha,   &s->low,    &s->high,
                        &s->acceleration, &s->passed};
  enum { COUNT = sizeof numbers / sizeof *numbers };
  double *memory = calloc(n * (COUNT + 4), sizeof *memory);
  size_t *indices = calloc(3 * n, sizeof *indices);
  s->unit = calloc(n, sizeof *s->unit);
  s->contact = calloc(2 * n, sizeof *s->contact);
  s->memory = memory;
  s->unit_of = indices;
  if (!memory || !indices || !s->unit || !s->contact) {
    rot_drive_system_free(s);
    return ROT_ENOMEM;
  }
  for (size_t k = 0; k < COUNT; k++) *numbers[k] = memory + k * n;
  s->capacity = memory + COUNT * n; /* of at most 2 n - 1 contacts */
  s->capacity_ahead = s->capacity + 2 * n;
  s->state_of = indices + n;
  s->contact_of = indices + 2 * n;
  find_units(s);
  find_contacts(s);
  return ROT_OK;
}

void rot_drive_system_free(rot_drive_system *s) {
  free(s->memory);
  free(s->unit_of);
  free(s->unit);
  free(s->contact);
  memset(s, 0, sizeof *s);
}

/* Rates of the units, slip speeds, twists from the rotors. */
void rot_drive_start(const rot_drive_system *s, double y[]) {
  const rot_drive_scene *scene = s->scene;
  for (size_t u = 0; u < s->m; u++) y[u] = 0.0;
  for (size_t i = 0; i < s->n; i++) {
    if (fabs(s->fraction[i]) == 1.0) {
      y[s->m + s->unit_of[i]] = scene->rotor[i].linear.omega0_rad_per_s * s->fraction[i];
    }
  }
  for (size_t j = 0; j + 1 < s->n; j++) {
    const rot_drive_coupling *c = &scene->coupling[j];
    if (c->kind == ROT_DRIVE_CLUTCH) {
      const double a = rot_drive_omega(s, y, j), b = c->ratio * rot_drive_omega(s, y, j + 1);
      /* A slip within rounding is 0. */
      y[s->state_of[j]] = fabs(a - b) <= 4.0 * ROT_EPS * fabs(a) ? 0.0 : a - b;
    } else if (c->kind == ROT_DRIVE_SHAFT) {
      y[s->state_of[j]] =
          fma(-c->ratio, scene->rotor[j + 1].linear.theta0_rad, scene->rotor[j].linear.theta0_rad);
    }
  }
}

/* ---- laws ------------------------------------------------------------------------------------ */

static rot_status law_at(const rot_axle_scene *law, double t, double theta, double theta_lo,
                         double omega, double *value) {
  const rot_torque *torque = &law->linear.torque;
  double called = 0.0;
  if (torque->call) {
    const rot_status status = torque->call(t, theta, omega, &called, torque->ctx);
    if (status != ROT_OK) return status;
  }
  *value = called + rot_axle_scene_applied(law, t, theta, theta_lo, omega);
  return ROT_OK;
}

static rot_status friction_at(const rot_drive_friction *friction, double t, double theta,
                              double slip, int sticks, double *capacity) {
  *capacity = 0.0;
  if (!friction->acts || !(t >= friction->from_s && t < friction->to_s)) return ROT_OK;
  const rot_status status = law_at(&friction->law, t, theta, 0.0, sticks ? 0.0 : slip, capacity);
  *capacity = fmax(0.0, *capacity) * (sticks ? friction->static_ratio : 1.0);
  return status;
}

static double sign_of(double x) { return (double)((x > 0.0) - (x < 0.0)); }

/* mode of a contact => sign of its slip; 0: it sticks. */
static double slip_sign(signed char mode, double speed) {
  return mode == ROT_DRIVE_OPEN ? sign_of(speed) : (double)mode;
}

/* ---- known torques --------------------------------------------------------------------------- */

/* Torques on rotors and units: applied, resistance, friction and brakes. */
static rot_status rotor_torques(rot_drive_system *s, double t, const double y[],
                                const signed char mode[]) {
  const rot_drive_scene *scene = s->scene;
  for (size_t i = 0; i < s->n; i++) {
    const rot_axle_scene *r = &scene->rotor[i];
    const size_t u = s->unit_of[i], ground = s->unit[u].ground;
    const double fraction = s->fraction[i], omega = fraction * y[s->m + u];
    double lo, theta = rot_two_sum(r->linear.theta0_rad, fraction * y[u], &lo);
    rot_status status = law_at(r, t, theta, lo, omega, &s->applied[i]);
    if (status != ROT_OK) return status;
    s->smooth[i] = -r->viscous_n_m_s * omega - r->quadratic_n_m_s2 * omega * fabs(omega);
    s->force[u] += fraction * (s->applied[i] + s->smooth[i]);
    s->size[u] += fabs(fraction) * (fabs(s->applied[i]) + fabs(s->smooth[i]));
    s->dry[i] = s->brake[i] = s->dry_cap[i] = s->brake_cap[i] = 0.0;
    if (ground == SIZE_MAX) continue;
    /* The sign of the segment: a stage beyond the zero has no kink. */
    const int sticks = mode[ground] == ROT_DRIVE_STICKS;
    const double sign = slip_sign(mode[ground], y[s->m + u]);
    s->dry_cap[i] = sticks ? fmax(r->static_n_m, r->coulomb_n_m) : r->coulomb_n_m;
    status = friction_at(&scene->brake[i], t, theta, sign * fabs(fraction) * y[s->m + u], sticks,
                         &s->brake_cap[i]);
    if (status != ROT_OK) return status;
    s->dry[i] = -sign * sign_of(fraction) * s->dry_cap[i];
    s->brake[i] = -sign * sign_of(fraction) * s->brake_cap[i];
    const double capacity = fabs(fraction) * (s->dry_cap[i] + s->brake_cap[i]);
    s->capacity[ground] += capacity;
    s->force[u] -= sign * capacity;
    s->size[u] += capacity;
  }
  return ROT_OK;
}

/* Torques of shafts and slipping clutches. */
static rot_status coupling_torques(rot_drive_system *s, double t, const double y[],
                                   const signed char mode[]) {
  const rot_drive_scene *scene = s->scene;
  for (size_t j = 0; j + 1 < s->n; j++) {
    const rot_drive_coupling *c = &scene->coupling[j];
    const size_t a = s->unit_of[j], b = s->unit_of[j + 1];
    if (c->kind == ROT_DRIVE_GEAR) continue;
    if (c->kind == ROT_DRIVE_SHAFT) {
      const double rate = rot_drive_omega(s, y, j) - c->ratio * rot_drive_omega(s, y, j + 1);
      s->torque[j] = c->stiffness_n_m_per_rad * y[s->state_of[j]] + c->damping_n_m_s * rate;
    } else {
      const size_t k = s->contact_of[j];
      const double slip = y[s->state_of[j]], sign = slip_sign(mode[k], slip);
      const double theta = scene->rotor[j].linear.theta0_rad + s->fraction[j] * y[a];
      const rot_status status = friction_at(&c->friction, t, theta, sign * slip,
                                            mode[k] == ROT_DRIVE_STICKS, &s->capacity[k]);
      if (status != ROT_OK) return status;
      s->torque[j] = sign * s->capacity[k];
    }
    const double on_a = s->fraction[j] * s->torque[j];
    const double on_b = c->ratio * s->fraction[j + 1] * s->torque[j];
    s->force[a] -= on_a;
    s->force[b] += on_b;
    s->size[a] += fabs(on_a);
    s->size[b] += fabs(on_b);
  }
  return ROT_OK;
}

/* ---- groups ---------------------------------------------------------------------------------- */

/* Known torque on unit u, to the first shaft. */
static double force_of(const rot_drive_system *s, size_t u) {
  return s->force[u] / s->unit[u].scale;
}

static double inertia_of(const rot_drive_system *s, size_t u) {
  return s->unit[u].inertia / s->unit[u].scale / s->unit[u].scale;
}

/* Capacity of the sticking clutch behind unit u, to the first shaft; 0: it slips. */
static double clutch_capacity(const rot_drive_system *s, size_t u, const signed char mode[]) {
  const size_t j = s->unit[u].end - 1;
  if (u + 1 >= s->m || s->scene->coupling[j].kind != ROT_DRIVE_CLUTCH) return 0.0;
  const size_t k = s->contact_of[j];
  return mode[k] == ROT_DRIVE_STICKS ? s->capacity[k] / fabs(s->product[j]) : 0.0;
}

static double ground_capacity(const rot_drive_system *s, size_t u, const signed char mode[]) {
  const size_t k = s->unit[u].ground;
  return k != SIZE_MAX && mode[k] == ROT_DRIVE_STICKS ? s->capacity[k] / s->unit[u].scale : 0.0;
}

static int joined(const rot_drive_system *s, size_t u, const signed char mode[]) {
  const size_t j = s->unit[u].end - 1;
  return u + 1 < s->m && s->scene->coupling[j].kind == ROT_DRIVE_CLUTCH &&
         mode[s->contact_of[j]] == ROT_DRIVE_STICKS;
}

static void note_margin(rot_drive_system *s, double capacity, double load, size_t from, size_t to,
                        int grounded) {
  const double whole = capacity + fabs(load);
  const double margin = whole > 0.0 ? (capacity - fabs(load)) / whole : 0.0;
  if (!(margin >= s->weakest.margin)) {
    s->weakest = (rot_drive_weakest){margin, capacity, from, to, grounded, load};
  }
}

static void set_clutch(rot_drive_system *s, size_t u, double torque) {
  const size_t j = s->unit[u].end - 1;
  s->torque[j] = torque * s->product[j];
}

/* A moving group: one rigid body => acceleration, torques of its clutches. */
static void free_group(rot_drive_system *s, size_t from, size_t to, const signed char mode[]) {
  double force = 0.0, inertia = 0.0, torque = 0.0;
  for (size_t u = from; u <= to; u++) {
    force += force_of(s, u);
    inertia += inertia_of(s, u);
  }
  const double rate = force / inertia;
  for (size_t u = from; u <= to; u++) {
    s->acceleration[u] = from == to ? s->force[u] / s->unit[u].inertia : rate / s->unit[u].scale;
    if (u == to) break;
    torque += force_of(s, u) - inertia_of(s, u) * rate;
    set_clutch(s, u, torque);
    const double load = copysign(torque, torque * s->product[s->unit[u].end - 1]);
    note_margin(s, clutch_capacity(s, u, mode), load, from, u, 0);
  }
}

/* A group at rest: stays at rest if the load of each run of neighbouring units is at most the
 * capacity of its end clutches and contacts to ground (max-flow min-cut). Of several contacts that
 * could carry a load, the nearest one does. */
static void held_group(rot_drive_system *s, size_t from, size_t to, const signed char mode[]) {
  for (size_t a = from; a <= to; a++) {
    double load = 0.0, holds = a > from ? clutch_capacity(s, a - 1, mode) : 0.0;
    for (size_t b = a; b <= to; b++) {
      load += force_of(s, b);
      holds += ground_capacity(s, b, mode);
      note_margin(s, holds + clutch_capacity(s, b, mode), load, a, b, 1);
    }
  }
  double low = 0.0, high = 0.0;
  for (size_t u = from; u <= to; u++) {
    const double max = u < to ? clutch_capacity(s, u, mode) : 0.0;
    const double ground = ground_capacity(s, u, mode), force = force_of(s, u);
    s->acceleration[u] = 0.0;
    s->low[u] = low = fmin(max, fmax(-max, low + force - ground));
    s->high[u] = high = fmin(max, fmax(-max, high + force + ground));
  }
  double torque = 0.0;
  for (size_t u = to + 1; u-- > from;) {
    const double ground = ground_capacity(s, u, mode), force = force_of(s, u);
    double before = 0.0;
    if (u > from) {
      before = fmin(torque - force + ground, fmax(torque - force - ground, 0.0));
      before = fmin(s->high[u - 1], fmax(s->low[u - 1], before));
      set_clutch(s, u - 1, before);
    }
    s->hold[u] = (torque - before - force) * s->unit[u].scale;
    torque = before;
  }
}

/* Divides the holding torque of a unit among its rotors, by capacity. */
static void distribute_hold(rot_drive_system *s, size_t u) {
  const size_t ground = s->unit[u].ground;
  const double part = s->capacity[ground] > 0.0 ? s->hold[u] / s->capacity[ground] : 0.0;
  for (size_t i = s->unit[u].first; i < s->unit[u].end; i++) {
    s->dry[i] = part * sign_of(s->fraction[i]) * s->dry_cap[i];
    s->brake[i] = part * sign_of(s->fraction[i]) * s->brake_cap[i];
  }
}

static void lossy_unit(rot_drive_system *s, size_t u, const double y[], const signed char mode[],
                       int held) {
  const size_t ground = s->unit[u].ground;
  if (!held) {
    const double direction = slip_sign(mode[ground], y[s->m + u]);
    rot_drive_mesh_turns(s, u, direction != 0.0 ? direction : s->force[u] < 0.0 ? -1.0 : 1.0);
    return;
  }
  double capacity, load;
  rot_drive_mesh_rests(s, u, &capacity, &load);
  s->capacity[ground] = capacity;
  note_margin(s, capacity / s->unit[u].scale, load / s->unit[u].scale, u, u, 1);
}

/* In a unit, the torque of a gear balances the rotors on one side of it. */
static void gear_torques(rot_drive_system *s) {
  const rot_drive_coupling *c = s->scene->coupling;
  for (size_t i = 0; i < s->n; i++) {
    s->alpha[i] = s->fraction[i] * s->acceleration[s->unit_of[i]];
    if (i + 1 == s->n || c[i].kind != ROT_DRIVE_GEAR || s->unit[s->unit_of[i]].lossy) continue;
    const double from = i ? c[i - 1].ratio * s->torque[i - 1] : 0.0;
    s->torque[i] = s->applied[i] + s->smooth[i] + s->dry[i] + s->brake[i] + from -
                   s->scene->rotor[i].linear.inertia_kg_m2 * s->alpha[i];
  }
}

/* Known torques; then each group: lossy unit, at rest, or moving. */
rot_status rot_drive_forces(rot_drive_system *s, double t, const double y[],
                            const signed char mode[]) {
  memset(s->force, 0, s->m * sizeof *s->force);
  memset(s->size, 0, s->m * sizeof *s->size);
  memset(s->hold, 0, s->m * sizeof *s->hold);
  memset(s->capacity, 0, s->n_contacts * sizeof *s->capacity);
  s->weakest = (rot_drive_weakest){2.0, 0.0, 0, 0, 0, 0.0};
  rot_status status = rotor_torques(s, t, y, mode);
  if (status == ROT_OK) status = coupling_torques(s, t, y, mode);
  if (status != ROT_OK) return status;
  for (size_t u = 0; u < s->m; u++) {
    if (s->unit[u].lossy) s->size[u] *= rot_drive_mesh_gain(s, &s->unit[u]);
  }
  for (size_t from = 0; from < s->m;) {
    size_t to = from;
    while (joined(s, to, mode)) to++;
    int held = 0;
    for (size_t u = from; u <= to; u++) {
      held |= s->unit[u].ground != SIZE_MAX && mode[s->unit[u].ground] == ROT_DRIVE_STICKS;
    }
    if (s->unit[from].lossy) { /* not joined to others by a clutch */
      lossy_unit(s, from, y, mode, held);
      held = 0;
    } else if (held) {
      held_group(s, from, to, mode);
    } else {
      free_group(s, from, to, mode);
    }
    for (size_t u = from; u <= to && held; u++) {
      if (s->unit[u].ground != SIZE_MAX) distribute_hold(s, u);
    }
    from = to + 1;
  }
  gear_torques(s);
  return ROT_OK;
}

double rot_drive_slip_rate(const rot_drive_system *s, size_t contact) {
  const rot_drive_contact *c = &s->contact[contact];
  if (c->coupling == SIZE_MAX) return s->acceleration[c->unit];
  return s->alpha[c->coupling] - s->scene->coupling[c->coupling].ratio * s->alpha[c->coupling + 1];
}
