#include "engine/ode/propagation.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "engine/ode/norm.h"
#include "maths/expm.h"
#include "maths/scaling.h"
#include "ground/real.h"

rot_ode_propagation *rot_ode_propagation_alloc(const rot_ode_params *p) {
  const size_t n = p->controlled, square = n * n;
  if (n > ROT_ODE_MAX_PROPAGATION) return NULL;
  rot_ode_propagation *g = calloc(1, sizeof *g);
  double *data = calloc(4 * square + ROT_EXPM_WORK(n) + 2 * n + 6 * p->dim, sizeof *data);
  if (!g || !data) {
    free(g);
    free(data);
    return NULL;
  }
  g->n = n;
  g->spread = data;
  g->derivative0 = data + square;
  g->derivative1 = data + 2 * square;
  g->map = data + 3 * square;
  g->worst = data + 4 * square;
  g->units = g->worst + n;
  g->y = g->units + n;
  g->f = g->y + p->dim;
  g->last_y = g->f + p->dim;
  g->last_slope = g->last_y + p->dim;
  g->mid_y = g->last_slope + p->dim;
  g->mid_slope = g->mid_y + p->dim;
  g->work = g->mid_slope + p->dim;
  return g;
}

void rot_ode_propagation_free(rot_ode_propagation *g) {
  if (!g) return;
  free(g->spread);
  free(g);
}

void rot_ode_propagation_begin(rot_ode_propagation *g) {
  if (g) memset(g->spread, 0, g->n * g->n * sizeof *g->spread);
}

void rot_ode_propagation_new_segment(rot_ode_propagation *g) {
  if (g) g->known = 0;
}

void rot_ode_propagation_hold(rot_ode_propagation *g, size_t component) {
  if (!g) return;
  for (size_t i = 0; i < g->n; i++) {
    g->spread[i * g->n + component] = g->spread[component * g->n + i] = 0.0;
  }
}

/* Beyond a surface the right-hand side is called on the surface: no difference there. */
static int passes_surface(const rot_ode_law *law, size_t component, double to) {
  for (size_t k = 0; k < law->surfaces->count; k++) {
    const rot_ode_surface *w = &law->surfaces->surface[k];
    if (w->component != component) continue;
    if (law->side[k] > 0 ? to < w->above : law->side[k] < 0 && to > w->below) return 1;
  }
  return 0;
}

/* Where a derivative is taken; `far`: another state of the step. */
typedef struct place {
  double t;
  const double *y, *slope, *far, *largest;
} place;

/* The derivative of the slope by the state, from differences of a thousandth of the step. */
static rot_status derivative(rot_ode_propagation *propagation, rot_ode_law *law, const place *at,
                             rot_ode_trajectory *trajectory, double d[]) {
  const rot_ode_params *p = law->p;
  const size_t n = p->controlled;
  double *y = propagation->y, *f = propagation->f;
  memcpy(y, at->y, p->dim * sizeof *y);
  for (size_t m = 0; m < rot_ode_steering(p); m++) {
    const rot_ode_group g = rot_ode_group_of(p, m);
    double moved = 0.0, size = 0.0;
    for (size_t i = g.first; i < g.first + g.count; i++) {
      moved = fmax(moved, fabs(at->y[i] - at->far[i]));
      size = fmax(size, fabs(at->y[i]));
    }
    const double by = fmax(1e-3 * moved, 1e-8 * fmax(size, at->largest[m]));
    for (size_t i = g.first; i < g.first + g.count; i++) {
      y[i] = at->y[i] + (passes_surface(law, i, at->y[i] + by) ? -by : by);
      const double step = y[i] - at->y[i];
      rot_status status = ROT_ERHS;
      if (step != 0.0) status = rot_ode_slope_at(law, at->t, y, f);
      if (status != ROT_OK && status != ROT_ERHS) return status;
      double *all =
          trajectory ? trajectory->derivative + (trajectory->nodes.count - 1) * p->dim * n : NULL;
      for (size_t k = 0; k < p->dim && all && status == ROT_OK; k++) {
        all[k * n + i] = (f[k] - at->slope[k]) / step;
      }
      for (size_t k = 0; k < n; k++) {
        d[k * n + i] = status == ROT_OK ? (f[k] - at->slope[k]) / step : 0.0;
      }
      y[i] = at->y[i];
    }
  }
  law->status = ROT_OK;
  return ROT_OK;
}

/* c = a b - b a. */
static void commutator(size_t n, const double a[], const double b[], double c[]) {
  for (size_t i = 0; i < n; i++) {
    for (size_t j = 0; j < n; j++) {
      double sum = 0.0;
      for (size_t k = 0; k < n; k++)
        sum += a[i * n + k] * b[k * n + j] - b[i * n + k] * a[k * n + j];
      c[i * n + j] = sum;
    }
  }
}

/* The exponent of the step to order 4, from the derivatives at its ends and in the middle: Blanes,
 * Casas, Oteo & Ros, Physics Reports 470 (2009) 151, section 5. The commutator is left out where
 * the series does not converge, in long implicit steps. */
static rot_status fine_exponent(rot_ode_propagation *g, rot_ode_law *law,
                                const rot_ode_state *state, const rot_ode_propagation_of *step) {
  const rot_ode_params *p = law->p;
  const size_t n = g->n, square = n * n;
  const double t = law->clock->t, h = step->h;
  const double *y = g->known ? g->last_y : step->before;
  const double *slope = g->known ? g->last_slope : step->slope;
  double *middle = g->work, *turn = g->work + square;
  rot_status status = ROT_OK;
  if (!g->known) {
    const place start = {t - h, y, slope, state->y, state->largest};
    status = derivative(g, law, &start, NULL, g->derivative0);
  }
  for (size_t i = 0; i < p->dim; i++) { /* of the cubic */
    g->mid_y[i] = 0.5 * (y[i] + state->y[i]) + 0.125 * h * (slope[i] - state->slope[i]);
  }
  const double half = t - 0.5 * h;
  if (status == ROT_OK) status = rot_ode_slope_at(law, half, g->mid_y, g->mid_slope);
  if (status == ROT_ERHS) {
    memcpy(middle, g->derivative1, square * sizeof *middle);
    law->status = ROT_OK;
  } else if (status == ROT_OK) {
    const place at = {half, g->mid_y, g->mid_slope, state->y, state->largest};
    status = derivative(g, law, &at, NULL, middle);
  }
  if (status != ROT_OK && status != ROT_ERHS) return status;
  for (size_t i = 0; i < square; i++) {
    g->map[i] = h / 6.0 * (g->derivative0[i] + 4.0 * middle[i] + g->derivative1[i]);
  }
  commutator(n, g->derivative0, g->derivative1, turn);
  const double by = h * h / 12.0;
  rot_scaling_of(n, g->map, g->units);
  if (by * rot_scaling_largest(n, turn, g->units) <
      0.5 * rot_scaling_largest(n, g->map, g->units)) {
    for (size_t i = 0; i < square; i++) g->map[i] -= by * turn[i];
  }
  memcpy(g->last_y, state->y, p->dim * sizeof *g->last_y);
  memcpy(g->last_slope, state->slope, p->dim * sizeof *g->last_slope);
  return ROT_OK;
}

/* The rounding of each group as it is now. */
static void note_worst(rot_ode_propagation *g, const rot_ode_params *p) {
  for (size_t m = 0; m < rot_ode_steering(p); m++) {
    const rot_ode_group group = rot_ode_group_of(p, m);
    double sum = 0.0;
    for (size_t i = group.first; i < group.first + group.count; i++) sum += g->spread[i * g->n + i];
    if (group.norm == ROT_ODE_QUATERNION) sum *= 4.0;
    const double now = sqrt(sum);
    if (!(now <= g->worst[m])) g->worst[m] = now;
  }
}

rot_status rot_ode_propagation_step(rot_ode_propagation *g, rot_ode_law *law,
                                    const rot_ode_state *state, rot_ode_trajectory *trajectory,
                                    const rot_ode_propagation_of *step) {
  const rot_ode_params *p = law->p;
  const size_t n = g->n, parts = step->parts;
  const double h = step->h, *before = step->before;
  const place end = {law->clock->t, state->y, state->slope, before, state->largest};
  if (h == 0.0) return ROT_OK;
  if (step->rows && p->fine_propagation) note_worst(g, p);
  double *swap = g->derivative0;
  g->derivative0 = g->derivative1;
  g->derivative1 = swap;
  rot_ode_stiffness *stiffness = law->stiffness;
  law->stiffness = NULL;
  rot_status status = derivative(g, law, &end, trajectory, g->derivative1);
  if (status == ROT_OK && p->fine_propagation) status = fine_exponent(g, law, state, step);
  law->stiffness = stiffness;
  if (status != ROT_OK) return status;
  for (size_t i = 0; i < n * n && !p->fine_propagation; i++) {
    const double mean =
        g->known ? 0.5 * (g->derivative0[i] + g->derivative1[i]) : g->derivative1[i];
    g->map[i] = h * mean;
  }
  g->known = 1;
  double *e = g->derivative0; /* not needed any more */
  rot_scaling_of(n, g->map, g->units);
  rot_scaling_apply(n, g->map, g->units);
  status = rot_expm(n, g->map, e, g->work, NULL);
  rot_scaling_undo(n, e, g->units);
  if (status != ROT_OK) { /* beyond the doubles in one step */
    for (size_t m = 0; m < rot_ode_steering(p); m++) g->worst[m] = INFINITY;
    return ROT_OK;
  }
  /* e spread e': the work space has room for two more matrices. */
  double *left = g->work, *turned = g->work + n * n;
  rot_expm_multiply(n, e, g->spread, left, NULL);
  for (size_t i = 0; i < n; i++) {
    for (size_t j = 0; j < n; j++) turned[j * n + i] = e[i * n + j];
  }
  rot_expm_multiply(n, left, turned, g->spread, NULL);
  for (size_t m = 0; m < rot_ode_steering(p); m++) {
    const rot_ode_group group = rot_ode_group_of(p, m);
    const int turns = group.norm == ROT_ODE_QUATERNION;
    double size = 0.0;
    for (size_t i = group.first + (size_t)turns; i < group.first + group.count; i++) {
      size = fmax(size, fmax(fabs(state->y[i]), fabs(before[i])));
    }
    for (size_t i = group.first; i < group.first + group.count; i++) { /* rot_ode_rounds() */
      const double by = ROT_EPS * (turns && i == group.first ? 1.0 : size);
      const double slope = step->rounds ? step->rounds[m] * h / (double)parts : 0.0;
      g->spread[i * n + i] += (double)parts * (by * by + slope * slope);
    }
  }
  if (step->rows || !p->fine_propagation) note_worst(g, p);
  return ROT_OK;
}
