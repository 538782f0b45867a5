#include "scene/axle/drop.h"

#include <math.h>
#include <stdlib.h>

#include "scene/axle/effects.h"

/* ---- sizes ----------------------------------------------------------------------------------- */

static double time_span(const rot_axle_scene *scene, const rot_query *query) {
  const double start = scene->linear.start_s;
  if (query->n == 0) return 0.0;
  return fmax(fabs(query->time_s[0] - start), fabs(query->time_s[query->n - 1] - start));
}

static double min_inertia(const rot_axle_scene *scene) {
  double min = scene->linear.inertia_kg_m2;
  for (size_t i = 0; i < scene->n_inertia; i++) min = fmin(min, scene->inertia_kg_m2[i]);
  return min;
}

/* Sum of size(x) over the terms of a kind. */
static double term_sum(const rot_axle_scene *scene, rot_term_kind kind,
                       double (*size)(const double *x)) {
  double sum = 0.0;
  for (size_t i = 0; i < scene->n_terms; i++) {
    if (scene->terms[i].kind == kind) sum += size(scene->terms[i].x);
  }
  return sum;
}

static double strength(const double *x) { return fabs(x[0]); }

/* Destabilising stiffness of a spring (negative stiffness), else 0. */
static double pushing(const double *x) { return fmax(0.0, -x[0]); }

/* Largest positive slope of a curve; 0: none. */
static double steepest_rise(const double *x) {
  const size_t n = (size_t)x[0];
  const double *speed = x + 1, *torque = speed + n;
  double max = 0.0;
  for (size_t i = 1; i < n; i++) {
    max = fmax(max, (torque[i] - torque[i - 1]) / (speed[i] - speed[i - 1]));
  }
  return max;
}

/* Largest |torque| in N m of the loads independent of the motion. */
static double largest_drive(const rot_axle_scene *scene, double last_s) {
  const rot_torque *torque = &scene->linear.torque;
  double knots = fmax(fabs(torque->before_n_m), fabs(torque->after_n_m)), terms = 0.0;
  for (size_t i = 0; i < torque->n; i++) knots = fmax(knots, fabs(torque->torque_n_m[i]));
  for (size_t i = 0; i < scene->n_terms; i++) {
    const double *x = scene->terms[i].x;
    double max = 0.0;
    switch (scene->terms[i].kind) {
    case ROT_TERM_SINUSOID: terms += fabs(x[0]); break;
    case ROT_TERM_EXPONENTIAL: terms += fabs(x[0]) * fmax(1.0, exp(-x[1] * (last_s - x[2]))); break;
    case ROT_TERM_CURVE:
      for (size_t j = 1; j <= (size_t)x[0]; j++) max = fmax(max, fabs(x[(size_t)x[0] + j]));
      terms += max;
      break;
    case ROT_TERM_SPRING:
    case ROT_TERM_GRAVITY: break;
    default: terms = INFINITY;
    }
  }
  return torque->call ? INFINITY : knots + terms;
}

/* Bound of the growth of a disturbance: exp of time times growth rates of the torques that depend
 * on the motion. */
static double propagation_bound(const rot_axle_scene *scene, double span) {
  const double inertia = min_inertia(scene);
  const double driven = fmax(0.0, -scene->linear.viscous_n_m_s) / inertia;
  const double rising = term_sum(scene, ROT_TERM_CURVE, steepest_rise) / inertia;
  const double pulled =
      term_sum(scene, ROT_TERM_GRAVITY, strength) + term_sum(scene, ROT_TERM_SPRING, pushing);
  return exp(span * (driven + rising + sqrt(pulled / inertia)));
}

/* Bound of |omega| by comparison. Resistance only brakes; a torque D drives to at most D/I T or,
 * with viscous resistance c, to D/c; a spring or gravity returns at most its energy. If the inertia
 * decreases, the torque changes I omega, and each decrease of I can multiply the energy of an
 * oscillation by its ratio (parametric pumping). */
static double largest_omega(const rot_axle_scene *scene, const rot_query *query) {
  const rot_axle_params *p = &scene->linear;
  const double span = time_span(scene, query), inertia = min_inertia(scene);
  const double drive = largest_drive(scene, query->n ? query->time_s[query->n - 1] : p->start_s);
  double stored = 0.0, reach = drive / inertia * span, pumped = 1.0;
  for (size_t i = 0; i < scene->n_terms; i++) {
    const double *x = scene->terms[i].x, size = fabs(x[0]) / inertia;
    if (scene->terms[i].kind == ROT_TERM_GRAVITY) stored += 4.0 * size;
    if (scene->terms[i].kind == ROT_TERM_SPRING) {
      stored += size * (p->theta0_rad - x[1]) * (p->theta0_rad - x[1]);
    }
  }
  const int oscillates = !(stored <= 0.0);
  for (size_t i = 1; oscillates && i < scene->n_inertia; i++) {
    pumped *= sqrt(fmax(1.0, scene->inertia_kg_m2[i - 1] / scene->inertia_kg_m2[i]));
  }
  if (p->viscous_n_m_s > 0.0 && !oscillates && scene->n_inertia == 0) {
    reach = fmin(reach, drive / p->viscous_n_m_s);
  }
  const double start = fabs(p->omega0_rad_per_s) * p->inertia_kg_m2 / inertia;
  return (sqrt(start * start + stored) + reach) * pumped * propagation_bound(scene, span);
}

/* ---- bounds ---------------------------------------------------------------------------------- */

/* |delta omega| <= size/I min(T, I/c), and at most impulse/I. Resistance that increases with omega
 * makes two motions converge: all but the viscous one is omitted here. */
void rot_axle_disturbance(const rot_axle_scene *scene, const rot_query *query, double size_n_m,
                          double impulse_n_m_s, double propagation, double *theta, double *omega) {
  const double span = time_span(scene, query), inertia = min_inertia(scene);
  const double c = scene->linear.viscous_n_m_s;
  const int oscillates = (rot_axle_effects(scene) &
                          (unsigned)(ROT_AXLE_SPRING | ROT_AXLE_GRAVITY | ROT_AXLE_INERTIA)) != 0;
  const double reach = c > 0.0 && !oscillates ? fmin(span, inertia / c) : span;
  if (isnan(propagation)) {
    const int backward = query->n && query->time_s[0] < scene->linear.start_s;
    propagation =
        propagation_bound(scene, span) * (backward ? exp(fmax(0.0, c) / inertia * span) : 1.0);
  }
  *omega = fmin(size_n_m * reach, impulse_n_m_s) / inertia * propagation;
  *theta = *omega * span;
}

/* Largest torque of an effect for |omega| and |angle| up to these. */
static double effect_torque(const rot_axle_scene *scene, unsigned effect, double omega,
                            double angle) {
  double sum = 0.0;
  switch (effect) {
  case ROT_AXLE_VISCOUS: return fabs(scene->viscous_n_m_s) * omega;
  case ROT_AXLE_QUADRATIC: return scene->quadratic_n_m_s2 * omega * omega;
  case ROT_AXLE_FRICTION: return scene->static_n_m;
  case ROT_AXLE_GRAVITY: return term_sum(scene, ROT_TERM_GRAVITY, strength);
  case ROT_AXLE_SPRING:
    for (size_t i = 0; i < scene->n_terms; i++) {
      const double *x = scene->terms[i].x;
      if (scene->terms[i].kind == ROT_TERM_SPRING) sum += fabs(x[0]) * (angle + fabs(x[1]));
    }
    return sum;
  default: return INFINITY;
  }
}

/* Omits terms and resistance by the bits of the mask. */
rot_axle_scene rot_axle_without(const rot_axle_scene *scene, unsigned effects, rot_term terms[]) {
  rot_axle_scene out = *scene;
  if (effects & ROT_AXLE_VISCOUS) {
    out.viscous_n_m_s = 0.0;
    out.linear.viscous_n_m_s = out.motor_n_m_s;
  }
  if (effects & ROT_AXLE_QUADRATIC) out.quadratic_n_m_s2 = 0.0;
  if (effects & ROT_AXLE_FRICTION) out.coulomb_n_m = out.static_n_m = 0.0;
  out.n_terms = 0;
  out.terms = terms;
  for (size_t i = 0; i < scene->n_terms; i++) {
    const unsigned effect = 1u << (ROT_AXLE_INDEX_SINUSOID + (int)scene->terms[i].kind);
    if (!(effects & effect)) terms[out.n_terms++] = scene->terms[i];
  }
  return out;
}

enum { ROWS = 65 };

/* Largest |theta| and |omega| of a motion at evenly spaced times: lower limits of its maxima. */
static int motion_size(const rot_axle_scene *scene, rot_axle_model model, const rot_query *query,
                       double *theta, double *omega) {
  const double from = fmin(scene->linear.start_s, query->time_s[0]),
               to = query->time_s[query->n - 1];
  double time_s[ROWS], column[7][ROWS];
  const rot_axle_columns out = {column[0], column[1], column[2], column[3],
                                column[4], column[5], column[6]};
  rot_events events = {0};
  rot_info info;
  for (int i = 0; i < ROWS; i++) time_s[i] = from + (to - from) * ((double)i / (ROWS - 1));
  const rot_status status = model(scene, ROWS, time_s, &out, &events, NULL, &info);
  rot_events_free(&events);
  *theta = *omega = 0.0;
  for (int i = 0; i < ROWS; i++) {
    *theta = fmax(*theta, fabs(column[0][i]));
    *omega = fmax(*omega, fabs(column[1][i]));
  }
  return status == ROT_OK;
}

static double relative(double bound, double size) { return bound > 0.0 ? bound / size : bound; }

/* (scene, reduced scene) => bounds of the changes, for each effect and relative. */
static void bound_drop(const rot_axle_scene *scene, const rot_axle_scene *reduced,
                       rot_axle_model model, unsigned effects, const rot_query *query, double worst,
                       rot_drop *drop) {
  double size[ROT_AXLE_EFFECTS], sum = 0.0, theta, omega;
  const double max = largest_omega(scene, query);
  const double angle = fabs(scene->linear.theta0_rad) + max * time_span(scene, query);
  for (size_t i = 0; i < ROT_AXLE_EFFECTS; i++) {
    size[i] = effects >> i & 1u ? effect_torque(scene, 1u << i, max, angle) : 0.0;
    sum += size[i];
  }
  if (!isfinite(sum)) return;
  rot_axle_disturbance(reduced, query, sum, INFINITY, NAN, &drop->bound[ROT_THETA],
                       &drop->bound[ROT_OMEGA]);
  /* largest_omega() bounds the motion: a lower bound of the relative error can avoid a run. */
  if (drop->bound[ROT_OMEGA] > worst * largest_omega(reduced, query)) return;
  if (!motion_size(reduced, model, query, &theta, &omega)) return;
  drop->error =
      fmax(relative(drop->bound[ROT_OMEGA], omega), relative(drop->bound[ROT_THETA], theta));
  if (isnan(drop->bound[ROT_OMEGA]) || isnan(drop->bound[ROT_THETA])) drop->error = INFINITY;
  for (size_t i = 0; i < ROT_AXLE_EFFECTS; i++) {
    double one, turned;
    rot_axle_disturbance(reduced, query, size[i], INFINITY, NAN, &turned, &one);
    drop->each[i] = relative(one, omega);
  }
}

/* Tries the bound only forward in time and without static friction above the kinetic one. */
void rot_axle_drop(const void *of, const rot_model *model, rot_axle_model run, unsigned effects,
                   const rot_query *query, double worst, rot_drop *drop) {
  const rot_axle_scene *scene = of;
  drop->bound[ROT_THETA] = drop->bound[ROT_OMEGA] = drop->error = INFINITY;
  drop->until_s = query->n ? query->time_s[query->n - 1] : scene->linear.start_s;
  drop->why_not = NULL;
  rot_term *terms = malloc((scene->n_terms + 1) * sizeof *terms);
  if (!terms || !run) {
    free(terms);
    return;
  }
  const rot_axle_scene reduced = rot_axle_without(scene, effects, terms);
  drop->why_not = model->why_not ? model->why_not(&reduced, query) : NULL;
  /* Backward in time a brake drives: no bound. Static friction: whether a body at rest sticks can
   * depend on the last digit: no bound. */
  if (!drop->why_not && query->n && query->time_s[0] >= scene->linear.start_s &&
      reduced.static_n_m <= reduced.coulomb_n_m) {
    bound_drop(scene, &reduced, run, effects, query, worst, drop);
  }
  free(terms);
}
