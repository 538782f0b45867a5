#include "scene/pivot/ledger.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "ground/real.h"
#include "maths/panels.h"
#include "scene/free/ledger.h"
#include "scene/pivot/pivot.h"

/* ---- flows ----------------------------------------------------------------------------------- */

enum { WORK = 0, TORQUE_X = 2, TORQUE_Y = 3 };
enum { MAX_PANELS = 15000, MAX_HALVED = 50000 };

typedef struct along {
  rot_free_rows_of *form;
  const rot_free_params *p;
  const rot_hooks *hooks;
} along;

/* n times => torque of gravity r x F, F along -z: two numbers per time. */
static rot_status torques(size_t n, const double time_s[], double value[], void *ctx) {
  const along *a = ctx;
  const size_t columns = ROT_FREE_OWN_COLUMNS + 2 * a->p->n_rotors;
  double *memory = malloc((columns * n + 1) * sizeof *memory);
  void *column[ROT_FREE_ALL_COLUMNS] = {NULL};
  rot_free_out out;
  rot_events events = {0};
  rot_info info;
  if (!memory) return ROT_ENOMEM;
  for (size_t k = 0; k < columns; k++) column[k] = memory + k * n;
  rot_free_out_of(column, &out);
  const rot_status status = a->form(a->p, n, time_s, &out.columns, &events, a->hooks, &info);
  rot_events_free(&events);
  for (size_t i = 0; i < n && status == ROT_OK; i++) {
    double q[4], lever[3];
    for (int k = 0; k < 4; k++) q[k] = memory[(size_t)k * n + i];
    rot_pivot_lever(a->p, q, lever);
    value[2 * i] = -lever[1];
    value[2 * i + 1] = lever[0];
  }
  free(memory);
  return status;
}

/* (start, rows, rate) => ends of the integration panels: start, rows, and divisions such that no
 * panel turns by more than 1 rad. Returns their number. */
static size_t edges_of(double start_s, const rot_task *task, double rate, double edge[]) {
  const size_t n = task->n;
  double span = 0.0;
  size_t at = 0, before = 0;
  while (before < n && task->time_s[before] < start_s) before++;
  if (n) span = fmax(task->time_s[n - 1], start_s) - fmin(task->time_s[0], start_s);
  const double max = fmin(fmax(1.0, ceil(span * rate)), MAX_PANELS) / span;
  for (size_t i = 0; i <= n; i++) {
    const double to = i < before ? task->time_s[i] : i == before ? start_s : task->time_s[i - 1];
    const double from = at ? edge[at - 1] : to;
    const double parts = at ? fmax(1.0, ceil((to - from) * max)) : 1.0;
    if (at && !(to > from)) continue;
    for (double k = 1.0; k < parts; k++) {
      const double t = from + (to - from) * (k / parts);
      if (t > edge[at - 1] && t < to) edge[at++] = t;
    }
    edge[at++] = to;
  }
  return at;
}

/* integrals of the panels => integrals since the start, at the rows. */
static void add_up(const rot_panels *panels, double start_s, const rot_task *task,
                   const rot_rows *rows) {
  for (size_t k = 0; k < 2; k++) {
    double *flow = rows->flow[TORQUE_X + k], sum = 0.0, before = 0.0;
    size_t row = 0;
    for (size_t i = 0; i <= panels->n; i++) {
      const double t = panels->edge_s[i];
      if (t == start_s) before = sum;
      while (row < task->n && task->time_s[row] <= t) flow[row++] = sum;
      if (i < panels->n) sum += panels->value[2 * i + k];
    }
    for (size_t i = 0; i < task->n; i++) flow[i] -= before;
  }
}

/* largest: an upper limit of the impulses. A component that is 0, or rounding only, is not resolved
 * further than that. */
static rot_status impulses(along *a, const rot_task *task, const rot_rows *rows, double rate,
                           double largest, double error[2]) {
  const size_t max = task->n + 2 + MAX_PANELS + task->n;
  const double min[2] = {largest, largest};
  double size[2], *edge = malloc(3 * max * sizeof *edge);
  if (!edge) return ROT_ENOMEM;
  const size_t n = edges_of(a->p->start_s, task, rate, edge) - 1;
  const rot_panels panels = {.width = 2,
                             .n = n,
                             .edge_s = edge,
                             .min = min,
                             .max = MAX_HALVED + n,
                             .bounded = 1,
                             .value = edge + max,
                             .error = error,
                             .size = size};
  const rot_status status = n ? rot_panels_integrate(&panels, torques, a) : ROT_OK;
  if (status == ROT_OK) add_up(&panels, a->p->start_s, task, rows);
  free(edge);
  return status;
}

rot_status rot_pivot_flows(rot_free_rows_of *form, const rot_free_params *p, const rot_task *task,
                           const rot_rows *rows, const rot_info *info, const rot_hooks *hooks) {
  along a = {form, p, hooks};
  const size_t n = task->n;
  const double *lever = p->lever_n_m;
  const double size = rot_length(lever);
  const double rate = 2.0 * fmax(info->measure[ROT_FREE_OMEGA].largest, 1e-300);
  const double off = info->measure[ROT_FREE_ATTITUDE].error;
  double start[3], error[2] = {0.0, 0.0}, span = 0.0;
  for (int k = 0; k < ROT_FREE_FLOWS; k++) {
    memset(rows->flow[k], 0, n * sizeof *rows->flow[k]);
    rows->flow_error[k] = 0.0;
  }
  if (n == 0) return ROT_OK;
  rot_pivot_lever(p, p->q0, start);
  for (size_t i = 0; i < n; i++) {
    double q[4], now[3];
    for (int k = 0; k < 4; k++) q[k] = ((const double *)rows->column[k])[i];
    rot_pivot_lever(p, q, now);
    rows->flow[WORK][i] = start[2] - now[2];
    span = fmax(span, fabs(task->time_s[i] - p->start_s));
  }
  const rot_status status = impulses(&a, task, rows, rate, size * span, error);
  rows->flow_error[WORK] = size * (2.0 * off + 16.0 * DBL_EPSILON);
  rows->flow_error[TORQUE_X] = rows->flow_error[TORQUE_Y] =
      error[0] + error[1] + size * span * (off + 16.0 * DBL_EPSILON);
  return status;
}

/* ---- conserved quantities -------------------------------------------------------------------- */

static int weighs(const rot_free_params *p) {
  return p->lever_n_m[0] != 0.0 || p->lever_n_m[1] != 0.0 || p->lever_n_m[2] != 0.0;
}

/* Gravity is vertical: the vertical component of the angular momentum and the total energy are
 * conserved. */
size_t rot_pivot_conserved(const void *scene, size_t balance, const char *why[]) {
  const rot_free_params *p = scene;
  const int acts = rot_pivot_is_driven(p);
  size_t n = 0;
  if ((balance == 1 || balance == 2) && weighs(p)) {
    why[n++] = "gravity has a torque across the vertical";
  }
  if (acts) why[n++] = "a torque or the damping acts";
  if (!balance && rot_free_motors_work(p)) why[n++] = "the motors of the rotors work";
  if (n) return n;
  why[0] = balance ? "no torque acts along it"
                   : "gravity gives back what it takes: kinetic plus potential energy stays";
  return 0;
}

void rot_pivot_time_scales(const void *scene, const double sizes[], rot_time_scales *time_scales) {
  const rot_free_params *p = scene;
  const double *lever = p->lever_n_m;
  double min = INFINITY;
  for (int k = 0; k < 3; k++) {
    if (p->moment_kg_m2[k] > 0.0) min = fmin(min, p->moment_kg_m2[k]);
  }
  rot_free_time_scales(scene, sizes, time_scales);
  time_scales->swing_rad_per_s += sqrt(hypot(hypot(lever[0], lever[1]), lever[2]) / min);
}
