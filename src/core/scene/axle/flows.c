#include "scene/axle/flows.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "ground/sort.h"
#include "ground/real.h"
#include "ground/search.h"
#include "ground/store.h"
#include "maths/panels.h"
#include "scene/axle/ledger.h"
#include "scene/axle/linear.h"
#include "scene/axle/motor.h"
#include "scene/axle/time_scales.h"

enum {
  WORK = ROT_AXLE_FLOW_WORK,
  VISCOUS = ROT_AXLE_FLOW_VISCOUS,
  QUADRATIC = ROT_AXLE_FLOW_QUADRATIC,
  COULOMB = ROT_AXLE_FLOW_COULOMB,
  IMPULSE = ROT_AXLE_FLOW_IMPULSE,
  DAMPING = ROT_AXLE_FLOW_DAMPING,
  INERTIA = ROT_AXLE_FLOW_INERTIA,
  FLOWS = ROT_AXLE_FLOWS
};

const char *const rot_axle_flow_names[FLOWS] = {
#define X(code, name) #name,
    ROT_AXLE_FLOW_LIST(X)
#undef X
};

/* ---- jumps of the inertia -------------------------------------------------------------------- */

/* Knot i, the first at its time => 1 if the inertia jumps there, and its values around the jump. A
 * jump conserves the angular momentum, not the energy. */
static int jump_at(const rot_axle_scene *scene, size_t i, double side[2]) {
  const double *t = scene->inertia_time_s;
  if ((i > 0 && t[i - 1] == t[i]) || i + 1 >= scene->n_inertia || t[i + 1] != t[i]) return 0;
  side[0] = scene->inertia_kg_m2[i];
  side[1] = scene->inertia_kg_m2[rot_upper_bound(scene->n_inertia, t, t[i]) - 1];
  return 1;
}

static double jump_work(double momentum, const double side[2]) {
  return 0.5 * momentum * (momentum / side[1] - momentum / side[0]);
}

/* Adds the work of each jump at a row or at the start. */
void rot_axle_flows_jumps(const rot_axle_scene *scene, size_t n, const double time_s[],
                          const double momentum[], const rot_axle_flows *flows) {
  const double start = scene->linear.start_s;
  const double own = scene->linear.inertia_kg_m2 * scene->linear.omega0_rad_per_s;
  double side[2];
  for (size_t k = 0; k < scene->n_inertia; k++) {
    const double at = scene->inertia_time_s[k];
    if (!jump_at(scene, k, side)) continue;
    double size = 0.0;
    for (size_t i = 0; i < n; i++) {
      const int before = time_s[i] < start && at == start;
      const int after = time_s[i] > start && at == time_s[i];
      if (!before && !after) continue;
      const double l = after ? momentum[i] : own, work = jump_work(l, side);
      flows->value[INERTIA][i] += after ? work : -work;
      size = fmax(size, 0.5 * fabs(l * (l / side[1])) + 0.5 * fabs(l * (l / side[0])));
    }
    flows->error[INERTIA] += 8.0 * ROT_EPS * size;
  }
}

/* ---- the motion at any time ------------------------------------------------------------------ */

typedef struct work {
  const rot_axle_motion *of;
  const rot_hooks *hooks;
  rot_store store;
} work;

/* n times, not decreasing => rows, by the closed form and all torques. memory: for its columns. */
static rot_status rows_at(const work *w, size_t n, const double t[], double memory[],
                          rot_axle_columns *rows) {
  const rot_axle_motion *m = w->of;
  rot_info info;
  size_t at = 0;
#define X(type, name) rows->name = memory + n * at++;
  ROT_AXLE_COLUMNS(X)
#undef X
  rot_info_clear(&info, rot_turning);
  const rot_status status = m->closed(m->solved, n, t, rows, NULL, w->hooks, &info);
  if (status == ROT_OK && m->acts != m->solved) {
    rot_axle_scene_torques(m->acts, n, t, rows->theta_rad, rows->omega_rad_per_s,
                           rows->applied_torque_n_m, rows->damping_torque_n_m,
                           rows->net_torque_n_m);
  }
  return status;
}

enum { COLUMNS = 7 };

static double inertia_slope(const rot_axle_scene *scene, double t) {
  const size_t n = scene->n_inertia, past = rot_upper_bound(n, scene->inertia_time_s, t);
  if (past == 0 || past >= n) return 0.0;
  const double *at = scene->inertia_time_s, *moment = scene->inertia_kg_m2;
  return (moment[past] - moment[past - 1]) / (at[past] - at[past - 1]);
}

/* Integrand (rot_panels_rates): n times => rates of the flows. */
static rot_status rates(size_t n, const double t[], double value[], void *ctx) {
  const work *w = ctx;
  const rot_axle_scene *scene = w->of->acts;
  double *memory = malloc((COLUMNS * n + 1) * sizeof *memory);
  rot_axle_columns rows;
  if (!memory) return ROT_ENOMEM;
  const rot_status status = rows_at(w, n, t, memory, &rows);
  for (size_t i = 0; i < n && status == ROT_OK; i++) {
    const double omega = rows.omega_rad_per_s[i], applied = rows.applied_torque_n_m[i];
    double *to = value + i * FLOWS;
    to[WORK] = applied * omega;
    to[VISCOUS] = scene->viscous_n_m_s * (omega * omega);
    to[QUADRATIC] = scene->quadratic_n_m_s2 * fabs(omega * omega * omega);
    to[COULOMB] = scene->coulomb_n_m * fabs(omega);
    to[IMPULSE] = applied;
    to[DAMPING] = rows.damping_torque_n_m[i];
    to[INERTIA] = scene->n_inertia ? -0.5 * inertia_slope(scene, t[i]) * (omega * omega) : 0.0;
  }
  free(memory);
  return status;
}

/* ---- ends of the panels ---------------------------------------------------------------------- */

typedef struct times {
  size_t n, room;
  double *at;
} times;

static int add_time(times *to, double t) {
  if (to->n == to->room) {
    const size_t room = 2 * to->room + 64;
    double *more = realloc(to->at, room * sizeof *more);
    if (!more) return 0;
    to->at = more;
    to->room = room;
  }
  to->at[to->n++] = t;
  return 1;
}

/* Sorts the times, removes duplicates and those outside [from, to]. */
static void close_times(times *of, double from, double to) {
  size_t kept = 0;
  of->n = rot_sort_once(of->n, of->at);
  for (size_t i = 0; i < of->n; i++) {
    const double t = of->at[i];
    if (t >= from && t <= to) of->at[kept++] = t;
  }
  of->n = kept;
}

/* Times at doubling distances from the anchors (disturbances, sorted): a panel much longer than the
 * shortest time scale would miss a transient after an anchor. */
static int add_graded(const times *anchors, double start, double shortest, double from, double to,
                      times *out) {
  if (!isfinite(shortest)) return 1;
  for (size_t i = 0; i <= anchors->n; i++) {
    const double *at = anchors->at;
    const double begin = i ? at[i - 1] : fmin(from, at[0]);
    const double end = i < anchors->n ? at[i] : fmax(to, at[i - 1]);
    if (!(end - begin > 50.0 * shortest && end > from && begin < to)) continue;
    const double first = fmax(shortest, (end - begin) * 0x1p-1000); /* 2^1024 overflows */
    const int doublings = (int)floor(log2((end - begin) / first));
    for (int k = -1; k <= doublings; k++) {
      const double away = ldexp(first, k), t = end <= start ? end - away : begin + away;
      if (t > from && t < to && !add_time(out, t)) return 0;
    }
  }
  return 1;
}

/* Time between two times at which omega passes a point of a torque-speed curve, by bisection. */
static rot_status kink_between(const work *w, double from, double to, double point, int rises,
                               double *at) {
  double memory[COLUMNS];
  for (int halving = 0; halving < 60; halving++) {
    const double middle = from + (to - from) / 2.0;
    rot_axle_columns row;
    const rot_status status = rows_at(w, 1, &middle, memory, &row);
    if (status != ROT_OK) return status;
    if ((row.omega_rad_per_s[0] > point) == rises) {
      to = middle;
    } else {
      from = middle;
    }
  }
  *at = to;
  return ROT_OK;
}

enum { PARTS = 16 };

/* Adds the kinks of curves as ends of panels: sign changes between 16 times in each interval. */
static rot_status add_kinks(work *w, times *edges) {
  const rot_axle_scene *scene = w->of->acts;
  size_t curves = 0;
  for (size_t i = 0; i < scene->n_terms; i++) curves += scene->terms[i].kind == ROT_TERM_CURVE;
  if (!curves || edges->n < 2) return ROT_OK;
  const size_t n = (edges->n - 1) * PARTS + 1, first = edges->n;
  double *t = rot_store_get(&w->store, n, sizeof *t);
  double *memory = rot_store_get(&w->store, n, COLUMNS * sizeof *memory);
  rot_axle_columns rows;
  if (!t || !memory) return ROT_ENOMEM;
  for (size_t i = 0; i + 1 < first; i++) {
    const double width = edges->at[i + 1] - edges->at[i];
    for (int k = 0; k < PARTS; k++) t[i * PARTS + (size_t)k] = edges->at[i] + width * k / PARTS;
  }
  t[n - 1] = edges->at[first - 1];
  rot_status status = rows_at(w, n, t, memory, &rows);
  for (size_t i = 0; i < scene->n_terms && status == ROT_OK; i++) {
    const rot_term *curve = &scene->terms[i];
    const size_t points = curve->kind == ROT_TERM_CURVE ? (size_t)curve->x[0] : 0;
    for (size_t k = 0; k < points && status == ROT_OK; k++) {
      const double point = curve->x[1 + k];
      for (size_t j = 1; j < n && status == ROT_OK; j++) {
        const int rises = rows.omega_rad_per_s[j] > point;
        double at;
        if (rises == (rows.omega_rad_per_s[j - 1] > point)) continue;
        status = kink_between(w, t[j - 1], t[j], point, rises, &at);
        if (status == ROT_OK && !add_time(edges, at)) status = ROT_ENOMEM;
      }
    }
  }
  return status;
}

/* (rows) => ends of the panels: rows, breaks, graded times, kinks. */
static rot_status find_edges(work *w, size_t n, const double time_s[], times *edges) {
  const rot_axle_motion *m = w->of;
  const rot_axle_scene *scene = m->acts;
  const double from = time_s[0], to = time_s[n - 1], start = scene->linear.start_s;
  const double omega = m->info->measure[ROT_OMEGA].largest;
  times anchors = {0};
  int room = add_time(&anchors, start);
  for (size_t i = 0; i < scene->n_breaks && room; i++)
    room = add_time(&anchors, scene->breaks_s[i]);
  for (size_t i = 0; m->events && i < m->events->count && room; i++) {
    room = add_time(&anchors, m->events->time_s[i]);
  }
  if (room) close_times(&anchors, -INFINITY, INFINITY);
  room = room && add_graded(&anchors, start, 1.0 / rot_axle_rates_of(scene, omega).decay_per_s,
                            from, to, edges);
  for (size_t i = 0; i < anchors.n && room; i++) room = add_time(edges, anchors.at[i]);
  for (size_t i = 0; i < n && room; i++) room = add_time(edges, time_s[i]);
  free(anchors.at);
  if (!room) return ROT_ENOMEM;
  close_times(edges, from, to);
  const rot_status status = add_kinks(w, edges);
  if (status == ROT_OK) close_times(edges, from, to);
  return status;
}

/* ---- quadrature ------------------------------------------------------------------------------ */

/* What the rounding of the time does at panel i's start, where the rates change from those before:
 * a stop lies within a rounding of its time. */
static void add_rounding_at(const times *edges, size_t i, const double value[], double error[]) {
  const double *at = edges->at, here = at[i + 1] - at[i], before = at[i] - at[i - 1];
  for (int k = 0; k < FLOWS; k++) {
    const double change =
        value[i * FLOWS + (size_t)k] / here - value[(i - 1) * FLOWS + (size_t)k] / before;
    error[k] += ROT_EPS * fabs(at[i] * change);
  }
}

/* Flows by quadrature. Uses only omega and the torques of the motion: the balance with the kinetic
 * energy is an independent test. */
static rot_status by_quadrature(work *w, size_t n, const double time_s[],
                                const rot_axle_flows *flows) {
  const rot_info *info = w->of->info;
  const rot_axle_scene *scene = w->of->acts;
  double error[FLOWS] = {0.0}, size[FLOWS] = {0.0}, sum[FLOWS] = {0.0};
  times edges = {0};
  rot_status status = find_edges(w, n, time_s, &edges);
  const size_t panels = edges.n ? edges.n - 1 : 0;
  double *value = rot_store_get(&w->store, panels, FLOWS * sizeof *value);
  if (status == ROT_OK && !value) status = ROT_ENOMEM;
  if (status == ROT_OK && panels) {
    const rot_panels p = {.width = FLOWS,
                          .n = panels,
                          .edge_s = edges.at,
                          .value = value,
                          .error = error,
                          .size = size};
    status = rot_panels_integrate(&p, rates, w);
  }
  for (size_t i = 1; i < panels && status == ROT_OK; i++) add_rounding_at(&edges, i, value, error);
  size_t knot = 0;
  for (size_t i = 0, row = 0; i < edges.n && status == ROT_OK; i++) {
    const double t = edges.at[i];
    for (int k = 0; k < FLOWS && i; k++) sum[k] += value[(i - 1) * FLOWS + (size_t)k];
    /* A jump at the first row precedes it. */
    for (; knot < scene->n_inertia && scene->inertia_time_s[knot] <= t; knot++) {
      double side[2], memory[COLUMNS];
      rot_axle_columns at;
      if (scene->inertia_time_s[knot] <= time_s[0] || !jump_at(scene, knot, side)) continue;
      status = rows_at(w, 1, &t, memory, &at);
      if (status != ROT_OK) break;
      const double l = at.angular_momentum_kg_m2_per_s[0];
      sum[INERTIA] += jump_work(l, side);
      size[INERTIA] += 0.5 * fabs(l * (l / side[1])) + 0.5 * fabs(l * (l / side[0]));
    }
    for (; row < n && time_s[row] <= t; row++) {
      for (int k = 0; k < FLOWS; k++) flows->value[k][row] = sum[k];
    }
  }
  free(edges.at);
  /* Effect of the error of the motion: error of omega on the rates, to first order. */
  const rot_measure *omega = &info->measure[ROT_OMEGA];
  const double off = omega->error / fmax(omega->largest, 1e-300);
  for (int k = 0; k < FLOWS; k++) flows->error[k] = error[k] + (4e-15 + 3.0 * off) * size[k];
  return status;
}

/* ---- closed form ----------------------------------------------------------------------------- */

/* Flows by the closed form of ledgers. */
static rot_status linear_flows(const rot_axle_scene *scene, size_t n, const double time_s[],
                               const rot_axle_flows *flows, const rot_hooks *hooks) {
  rot_store store = {0};
  rot_axle_ledger *row = rot_store_get(&store, n, sizeof *row);
  rot_info info;
  rot_status status = ROT_ENOMEM;
  if (row) status = rot_axle_linear_ledgers(&scene->linear, n, time_s, hooks, row, &info);
  for (size_t i = 0; i < n && status == ROT_OK; i++) {
    rot_axle_ledger *of = &row[i];
    rot_axle_motor_ledger(scene, of);
    const double value[FLOWS] = {of->work_j,        of->viscous_j,     of->quadratic_j,
                                 of->coulomb_j,     of->impulse_n_m_s, of->damping_impulse_n_m_s,
                                 of->inertia_work_j};
    for (int k = 0; k < FLOWS; k++) flows->value[k][i] = value[k];
    flows->error[WORK] = of->work_rounding_j;
    flows->error[VISCOUS] = of->dissipated_rounding_j;
    flows->error[IMPULSE] = of->impulse_rounding_n_m_s;
  }
  rot_store_free(&store);
  return status;
}

rot_status rot_axle_flows_of(const rot_axle_motion *motion, size_t n, const double time_s[],
                             const rot_axle_flows *flows, const rot_hooks *hooks) {
  const int linear =
      motion->closed == rot_axle_free_scene || motion->closed == rot_axle_linear_scene;
  for (int k = 0; k < FLOWS; k++) flows->error[k] = 0.0;
  if (n == 0) return ROT_OK;
  if (linear && motion->acts == motion->solved) {
    return linear_flows(motion->solved, n, time_s, flows, hooks);
  }
  work w = {motion, hooks, {0}};
  const rot_status status = by_quadrature(&w, n, time_s, flows);
  rot_store_free(&w.store);
  return status;
}

/* ---- gears ----------------------------------------------------------------------------------- */

/* Replaces the summed work and heat by those of shafts, bearings and meshes. */
void rot_axle_flows_geared(const rot_axle_scene *scene, const rot_axle_gears *gears, size_t n,
                           const double time_s[], const double theta_rad[],
                           const rot_axle_flows *flows) {
  double *const *f = flows->value;
  const double viscous = scene->viscous_n_m_s;
  for (size_t i = 0; i < n; i++) {
    const double done =
        gears->applied_n_m * (theta_rad[i] - theta_rad[0]) - (f[WORK][i] - f[WORK][0]);
    const double impulse =
        gears->applied_n_m * (time_s[i] - time_s[0]) - (f[IMPULSE][i] - f[IMPULSE][0]);
    const double meshes =
        viscous > 0.0 ? f[VISCOUS][i] * (1.0 - gears->bearings_n_m_s / viscous) : 0.0;
    f[COULOMB][i] += done + meshes;
    f[VISCOUS][i] -= meshes;
    f[DAMPING][i] -= impulse;
    f[WORK][i] += done;
    f[IMPULSE][i] += impulse;
  }
}
