/* Scenes with friction for tests: room for a run, and the scenes with known answers. */
#ifndef AXLE_FRICTION_H
#define AXLE_FRICTION_H

#include "axle_friction_cases.h"
#include "scene/axle/scene.h"
#include "ground/real.h"
#include "rot_test.h"

enum { MAX_ROWS = 4096 };

typedef struct run {
  double column[7][MAX_ROWS];
  double *theta, *omega, *applied, *damping, *net, *energy;
  rot_events events;
  rot_info info;
  rot_status status;
} run;

/* Runs the model afresh; what the run before it found is gone. */
static void run_model(run *r, rot_axle_model model, const rot_axle_scene *scene, size_t n,
                      const double time_s[]) {
  const rot_axle_columns out = {r->column[0], r->column[1], r->column[2], r->column[3],
                                r->column[4], r->column[5], r->column[6]};
  r->theta = out.theta_rad;
  r->omega = out.omega_rad_per_s;
  r->applied = out.applied_torque_n_m;
  r->damping = out.damping_torque_n_m;
  r->net = out.net_torque_n_m;
  r->energy = out.rotational_kinetic_energy_j;
  rot_events_free(&r->events);
  r->status = model(scene, n, time_s, &out, &r->events, NULL, &r->info);
  ROT_CHECK(r->status == r->info.status);
}

static rot_axle_scene plain_scene(double inertia, double viscous, double omega0, double torque) {
  rot_axle_scene s = {.linear = {.inertia_kg_m2 = inertia,
                                 .viscous_n_m_s = viscous,
                                 .omega0_rad_per_s = omega0,
                                 .torque = {.before_n_m = torque, .after_n_m = torque}},
                      .viscous_n_m_s = viscous};
  return s;
}

typedef struct friction_case {
  int model;
  rot_axle_scene scene;
  rot_term curve;
  size_t rows, events;
  double time_s[16], theta[16], omega[16];
  const double *event; /* time and kind, in turn */
} friction_case;

/* Reads one scene; the next one begins at what it returns. The case must stay where it is. */
static inline const double *read_case(const double *x, friction_case *c) {
  const rot_axle_scene nothing = {.n_terms = 0};
  c->model = (int)x[0];
  c->scene = nothing;
  c->scene.linear.inertia_kg_m2 = x[1];
  c->scene.linear.viscous_n_m_s = c->scene.viscous_n_m_s = x[2];
  c->scene.quadratic_n_m_s2 = x[3];
  c->scene.coulomb_n_m = x[4];
  c->scene.static_n_m = x[5];
  c->scene.linear.start_s = x[6];
  c->scene.linear.theta0_rad = x[7];
  c->scene.linear.omega0_rad_per_s = x[8];
  rot_torque *torque = &c->scene.linear.torque;
  torque->before_n_m = x[9];
  torque->after_n_m = x[10];
  torque->n = (size_t)x[11];
  torque->time_s = x + 12;
  torque->torque_n_m = torque->time_s + torque->n;
  x = torque->torque_n_m + torque->n;
  const size_t points = (size_t)x[0];
  c->curve.kind = ROT_TERM_CURVE;
  c->curve.from_s = -INFINITY;
  c->curve.to_s = INFINITY;
  c->curve.length = 1 + 2 * points;
  c->curve.x = x;
  if (points) {
    c->scene.n_terms = 1;
    c->scene.terms = &c->curve;
  }
  x += 1 + 2 * points;
  c->rows = (size_t)*x++;
  for (size_t i = 0; i < c->rows; i++) {
    c->time_s[i] = *x++;
    c->theta[i] = *x++;
    c->omega[i] = *x++;
  }
  c->events = (size_t)*x++;
  c->event = x;
  x += 2 * c->events;
  /* The table counts how a start from rest goes on; for the models that is no event. */
  if (c->events && c->event[0] <= c->scene.linear.start_s + 1e-14) {
    c->event += 2;
    c->events--;
  }
  /* It lists each turn: without dry or quadratic friction nothing happens there. */
  const rot_axle_scene *by = &c->scene;
  if (by->quadratic_n_m_s2 == 0.0 && by->coulomb_n_m == 0.0 && by->static_n_m == 0.0) c->events = 0;
  return x;
}

/* The true errors are below the bounds, the bounds below 1e-12 of the motion, the events the same.
 * A known value is itself good to half a unit in the last place. */
static inline void check_case(run *r, rot_axle_model model, const friction_case *c) {
  run_model(r, model, &c->scene, c->rows, c->time_s);
  ROT_CHECK(r->status == ROT_OK && r->info.rows_done == c->rows);
  for (size_t i = 0; i < c->rows; i++) {
    ROT_CHECK(fabs(r->theta[i] - c->theta[i]) <=
              r->info.measure[ROT_THETA].error + ROT_EPS * fabs(c->theta[i]));
    ROT_CHECK(fabs(r->omega[i] - c->omega[i]) <=
              r->info.measure[ROT_OMEGA].error + ROT_EPS * fabs(c->omega[i]));
    ROT_CHECK((r->omega[i] == 0.0) == (c->omega[i] == 0.0));
  }
  ROT_CHECK(rot_info_error(&r->info) < 1e-12);
  ROT_CHECK_EQ_INT(r->events.count, c->events);
  for (size_t i = 0; i < c->events && i < r->events.count; i++) {
    ROT_CHECK_EQ_INT(r->events.event[i], (int)c->event[2 * i + 1]);
    ROT_CHECK(fabs(r->events.time_s[i] - c->event[2 * i]) <=
              1e-13 * (fabs(c->event[2 * i]) + fabs(c->time_s[c->rows - 1])));
  }
}

static inline size_t check_known_cases(run *r, rot_axle_model model, int which) {
  const double *x = friction_scenes;
  size_t done = 0;
  for (int i = 0; i < FRICTION_SCENES; i++) {
    friction_case c;
    x = read_case(x, &c);
    if (c.model != which) continue;
    check_case(r, model, &c);
    done++;
  }
  ROT_CHECK(x == friction_scenes + sizeof friction_scenes / sizeof *friction_scenes);
  return done;
}

/* omega -> -omega, theta -> -theta, every torque turned round: each row turns round, to the bit. */
static inline void check_mirrors(rot_axle_model model, int which) {
  static run r, m;
  const double *x = friction_scenes;
  for (int i = 0; i < FRICTION_SCENES; i++) {
    friction_case c;
    double knots[32], curve[32];
    x = read_case(x, &c);
    if (c.model != which) continue;
    run_model(&r, model, &c.scene, c.rows, c.time_s);
    rot_axle_params *p = &c.scene.linear;
    p->theta0_rad = -p->theta0_rad;
    p->omega0_rad_per_s = -p->omega0_rad_per_s;
    p->torque.before_n_m = -p->torque.before_n_m;
    p->torque.after_n_m = -p->torque.after_n_m;
    for (size_t j = 0; j < p->torque.n; j++) knots[j] = -p->torque.torque_n_m[j];
    p->torque.torque_n_m = knots;
    const size_t n = (size_t)c.curve.x[0];
    curve[0] = (double)n;
    for (size_t j = 0; j < n; j++) {
      curve[1 + j] = -c.curve.x[n - j];
      curve[1 + n + j] = -c.curve.x[2 * n - j];
    }
    c.curve.x = curve;
    run_model(&m, model, &c.scene, c.rows, c.time_s);
    ROT_CHECK_EQ_INT(m.events.count, r.events.count);
    for (size_t j = 0; j < c.rows; j++) {
      ROT_CHECK(m.theta[j] == -r.theta[j] && m.omega[j] == -r.omega[j]);
      ROT_CHECK(m.applied[j] == -r.applied[j] && m.net[j] == -r.net[j]);
      ROT_CHECK(m.damping[j] == -r.damping[j] && m.energy[j] == r.energy[j]);
    }
  }
  rot_events_free(&r.events);
  rot_events_free(&m.events);
}

/* Units that are powers of two change nothing but exponents: inertia and torques times 2^p, times
 * 2^-e of a rate in 2^e per second. */
static inline void check_units(rot_axle_model model, int which) {
  static run r, m;
  const double *x = friction_scenes;
  const int tests[][2] = {{900, 0}, {-900, 0}, {0, 300}, {100, -300}};
  for (int i = 0; i < FRICTION_SCENES; i++) {
    friction_case c;
    const double *start = x;
    x = read_case(x, &c);
    if (c.model != which) continue;
    run_model(&r, model, &c.scene, c.rows, c.time_s);
    for (int k = 0; k < 4; k++) {
      const int p = tests[k][0], e = tests[k][1];
      double knots[32], times[32], curve[32];
      read_case(start, &c);
      rot_axle_scene *s = &c.scene;
      s->linear.inertia_kg_m2 = ldexp(s->linear.inertia_kg_m2, p);
      s->linear.viscous_n_m_s = s->viscous_n_m_s = ldexp(s->viscous_n_m_s, p + e);
      s->quadratic_n_m_s2 = ldexp(s->quadratic_n_m_s2, p);
      s->coulomb_n_m = ldexp(s->coulomb_n_m, p + 2 * e);
      s->static_n_m = ldexp(s->static_n_m, p + 2 * e);
      s->linear.omega0_rad_per_s = ldexp(s->linear.omega0_rad_per_s, e);
      s->linear.start_s = ldexp(s->linear.start_s, -e);
      rot_torque *torque = &s->linear.torque;
      torque->before_n_m = ldexp(torque->before_n_m, p + 2 * e);
      torque->after_n_m = ldexp(torque->after_n_m, p + 2 * e);
      for (size_t j = 0; j < torque->n; j++) {
        knots[j] = ldexp(torque->torque_n_m[j], p + 2 * e);
        times[j] = ldexp(torque->time_s[j], -e);
      }
      torque->torque_n_m = knots;
      torque->time_s = times;
      const size_t n = (size_t)c.curve.x[0];
      curve[0] = (double)n;
      for (size_t j = 1; j <= n; j++) {
        curve[j] = ldexp(c.curve.x[j], e);
        curve[n + j] = ldexp(c.curve.x[n + j], p + 2 * e);
      }
      c.curve.x = curve;
      for (size_t j = 0; j < c.rows; j++) c.time_s[j] = ldexp(c.time_s[j], -e);
      run_model(&m, model, s, c.rows, c.time_s);
      ROT_CHECK_EQ_INT(m.status, ROT_OK);
      ROT_CHECK_EQ_INT(m.events.count, r.events.count);
      for (size_t j = 0; j < c.rows; j++) {
        ROT_CHECK(fabs(m.theta[j] - r.theta[j]) <= r.info.measure[ROT_THETA].error);
        ROT_CHECK(fabs(ldexp(m.omega[j], -e) - r.omega[j]) <= r.info.measure[ROT_OMEGA].error);
      }
      ROT_CHECK_REL(m.info.measure[ROT_THETA].error, r.info.measure[ROT_THETA].error, 1e-3);
      ROT_CHECK_REL(ldexp(m.info.measure[ROT_OMEGA].error, -e), r.info.measure[ROT_OMEGA].error,
                    1e-3);
    }
  }
  rot_events_free(&r.events);
  rot_events_free(&m.events);
}

/* A run stopped at a row and started from there again arrives at the same rows. A body at rest in
 * the middle has its history in the friction alone, so it may start anew. */
static inline void check_splits(rot_axle_model model, int which) {
  static run r, m;
  const double *x = friction_scenes;
  for (int i = 0; i < FRICTION_SCENES; i++) {
    friction_case c;
    x = read_case(x, &c);
    if (c.model != which) continue;
    run_model(&r, model, &c.scene, c.rows, c.time_s);
    const double size = r.info.measure[ROT_THETA].largest,
                 speed = r.info.measure[ROT_OMEGA].largest;
    const double error = rot_info_error(&r.info);
    for (size_t j = 0; j + 1 < c.rows; j++) {
      c.scene.linear.start_s = c.time_s[j];
      c.scene.linear.theta0_rad = r.theta[j];
      c.scene.linear.omega0_rad_per_s = r.omega[j];
      run_model(&m, model, &c.scene, c.rows - j, c.time_s + j);
      for (size_t k = j; k < c.rows; k++) {
        ROT_CHECK(fabs(m.theta[k - j] - r.theta[k]) <= 4.0 * error * size);
        ROT_CHECK(fabs(m.omega[k - j] - r.omega[k]) <= 4.0 * error * speed);
      }
    }
  }
  rot_events_free(&r.events);
  rot_events_free(&m.events);
}

/* Kinetic energy gained = integral of net torque times omega, by Gauss's rule between knots and
 * events (and between the times in `more`, where the law kinks). The net torque of the rows counts
 * every resistance, so a sign or a factor that is wrong in either shows. */
static inline void check_energy(rot_axle_model model, const rot_axle_scene *scene, size_t edges,
                                const double edge[], double max) {
  static const double node[5] = {0.07443716949081561, 0.2166976970646236, 0.3397047841495122,
                                 0.43253168334449226, 0.48695326425858586};
  static const double weight[5] = {0.14776211235737644, 0.13463335965499818, 0.10954318125799102,
                                   0.0747256745752903, 0.03333567215434407};
  static run r;
  enum { PANELS = 16 };
  for (size_t i = 0; i + 1 < edges; i++) {
    double t[2 + 10 * PANELS], h = (edge[i + 1] - edge[i]) / PANELS, work = 0.0, flow = 0.0;
    size_t n = 0;
    t[n++] = edge[i];
    for (int j = 0; j < PANELS; j++) {
      for (int k = 4; k >= 0; k--) t[n++] = edge[i] + h * (j + 0.5 - node[k]);
      for (int k = 0; k < 5; k++) t[n++] = edge[i] + h * (j + 0.5 + node[k]);
    }
    t[n++] = edge[i + 1];
    run_model(&r, model, scene, n, t);
    ROT_CHECK(r.status == ROT_OK);
    for (size_t j = 1; j + 1 < n; j++) {
      const size_t k = (j - 1) % 10;
      const double w = h * weight[k < 5 ? 4 - k : k - 5];
      work += w * r.net[j] * r.omega[j];
      flow += w * fabs(r.net[j] * r.omega[j]);
    }
    ROT_CHECK(fabs(r.energy[n - 1] - r.energy[0] - work) <=
              max * (flow + r.energy[0] + r.energy[n - 1]));
  }
  rot_events_free(&r.events);
}

#endif
