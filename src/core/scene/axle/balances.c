#include "scene/axle/balances.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "ground/real.h"
#include "scene/axle/inputs.h"

/* ---- potential energy ------------------------------------------------------------------------ */

static int stores(const rot_term *term) {
  return term->kind == ROT_TERM_SPRING || term->kind == ROT_TERM_GRAVITY;
}

static int always(const rot_term *term) {
  return term->from_s == -INFINITY && term->to_s == INFINITY;
}

/* Number of terms with a potential energy; 0 if one of them does not act at all times. */
static size_t count_stores(const rot_axle_scene *scene) {
  size_t n = 0;
  for (size_t i = 0; i < scene->n_terms; i++) {
    const rot_term *term = &scene->terms[i];
    if (!stores(term)) continue;
    if (!always(term)) return 0;
    n++;
  }
  return n;
}

/* Rest angle of a term; half a turn further if gravity pulls up. */
static double rest_angle(const rot_term *term) {
  const int up = term->kind == ROT_TERM_GRAVITY && term->x[0] < 0.0;
  return term->x[1] + (up ? 3.141592653589793 : 0.0);
}

/* (two angles, their errors) => change of the potential energy, its error. As a product: a small
 * change of a large energy keeps its digits. */
static double potential_change(const rot_axle_scene *scene, const double theta[2],
                               const double error[2], double *explained) {
  double change = 0.0;
  *explained = 0.0;
  for (size_t i = 0; i < scene->n_terms; i++) {
    const rot_term *term = &scene->terms[i];
    if (!stores(term)) continue;
    const int spring = term->kind == ROT_TERM_SPRING;
    const double k = fabs(term->x[0]), rest = rest_angle(term);
    const double away[2] = {theta[0] - rest, theta[1] - rest};
    const double half = (away[0] + away[1]) / 2.0, turned = theta[1] - theta[0];
    const double one = spring ? 0.5 * term->x[0] * turned * (away[0] + away[1])
                              : 2.0 * k * sin(half) * sin(turned / 2.0);
    change += one;
    for (int end = 0; end < 2; end++) {
      const double off = error[end] + DBL_EPSILON * fabs(rest);
      const double slope = k * (spring ? fabs(away[end]) : fabs(sin(away[end])));
      *explained += slope * off + k * off * off;
    }
    *explained += 8.0 * DBL_EPSILON * fabs(one);
  }
  return change;
}

static int knots_push(const rot_torque *knots) {
  int acts = knots->before_n_m != 0.0 || knots->after_n_m != 0.0;
  for (size_t i = 0; i < knots->n; i++) acts |= knots->torque_n_m[i] != 0.0;
  return acts;
}

/* 1 if a torque other than `terms` of the terms acts, else 0. */
static int pushes(const rot_axle_scene *scene, size_t terms) {
  const rot_torque *torque = &scene->linear.torque;
  return knots_push(torque) || torque->call || scene->motor_n_m_s != 0.0 || scene->n_terms > terms;
}

/* ---- balances -------------------------------------------------------------------------------- */

enum { ENERGY, MOMENTUM };
const rot_balance rot_axle_balances[ROT_AXLE_BALANCES] = {
    [ENERGY] = {"energy", NULL, "J"}, [MOMENTUM] = {"angular_momentum", "the axle", "kg m^2/s"}};

enum {
  KINETIC,
  PULLEY,
  MASSES,
  POTENTIAL,
  WORK,
  INERTIA_WORK,
  VISCOUS_HEAT,
  QUADRATIC_HEAT,
  DRY_HEAT,
  CHANGE,
  IMPULSE,
  RESISTING
};
const rot_balance_term rot_axle_terms[ROT_AXLE_TERMS] = {
    [KINETIC] = {ENERGY, ROT_CHANGE, "change of kinetic energy", 0},
    [PULLEY] = {ENERGY, ROT_CHANGE, "change of kinetic energy of the pulley", 0},
    [MASSES] = {ENERGY, ROT_CHANGE, "change of kinetic energy of the masses", 0},
    [POTENTIAL] = {ENERGY, ROT_CHANGE, "change of potential energy", 0},
    [WORK] = {ENERGY, ROT_SUPPLIED, "work of the torque", 0},
    [INERTIA_WORK] = {ENERGY, ROT_SUPPLIED, "work of what changes the inertia", 0},
    [VISCOUS_HEAT] = {ENERGY, ROT_DISSIPATED, "heat of viscous resistance", 0},
    [QUADRATIC_HEAT] = {ENERGY, ROT_DISSIPATED, "heat of quadratic drag", 0},
    [DRY_HEAT] = {ENERGY, ROT_DISSIPATED, "heat of dry friction", 0},
    [CHANGE] = {MOMENTUM, ROT_CHANGE, "change of angular momentum", 0},
    [IMPULSE] = {MOMENTUM, ROT_SUPPLIED, "impulse of the torque", 0},
    [RESISTING] = {MOMENTUM, ROT_DISSIPATED, "impulse of the resistance", 0}};

static int hangs(const rot_axle_built *axle) { return axle->rope.mass_kg[0] > 0.0; }

const char *rot_axle_term_words(const void *built, size_t term) {
  const rot_axle_built *axle = built;
  const int rope = hangs(axle);
  switch (term) {
  case KINETIC:
  case WORK: return rope ? NULL : rot_axle_terms[term].words;
  case PULLEY:
  case MASSES: return rope ? rot_axle_terms[term].words : NULL;
  case POTENTIAL: return rope || count_stores(&axle->scene) ? rot_axle_terms[term].words : NULL;
  case DRY_HEAT: return axle->geared ? "loss of the gears" : rot_axle_terms[term].words;
  case IMPULSE: return rope ? "impulse of the weights" : rot_axle_terms[term].words;
  default: return rot_axle_terms[term].words;
  }
}

/* Data of two rows for the balances. */
typedef struct ends {
  double theta[2], theta_error[2], omega[2], omega_error[2], inertia[2];
  double potential, potential_explained;
} ends;

/* two rows => data; inertia after a jump at a row. */
static ends ends_of(const rot_axle_built *axle, const rot_span *span) {
  const rot_axle_scene *scene = &axle->scene;
  ends e = {.potential = 0.0};
  for (int k = 0; k < 2; k++) {
    const double *row = k ? span->last : span->first;
    e.theta[k] = row[0];
    e.omega[k] = row[1];
    e.theta_error[k] = span->error[ROT_THETA] + DBL_EPSILON * fabs(e.theta[k]);
    e.omega_error[k] = span->error[ROT_OMEGA] + DBL_EPSILON * fabs(e.omega[k]);
    e.inertia[k] = rot_axle_inertia_at(scene, span->time_s[k]);
  }
  if (hangs(axle)) {
    e.potential =
        rot_axle_rope_potential(&axle->rope, e.theta, e.theta_error, &e.potential_explained);
  } else if (count_stores(scene)) {
    e.potential = potential_change(scene, e.theta, e.theta_error, &e.potential_explained);
  }
  return e;
}

/* Changes as products: a small change of a large energy keeps its digits. */
static double kinetic_change(double inertia, const double omega[2]) {
  return 0.5 * inertia * (omega[1] - omega[0]) * (omega[1] + omega[0]);
}

static double kinetic(const ends *e) {
  if (e->inertia[0] == e->inertia[1]) return kinetic_change(e->inertia[0], e->omega);
  return 0.5 * (e->inertia[1] * (e->omega[1] * e->omega[1]) -
                e->inertia[0] * (e->omega[0] * e->omega[0]));
}

/* Terms in the order of the enum above. */
void rot_axle_audit(const void *built, const rot_span *span, double term[]) {
  const rot_axle_built *axle = built;
  const rot_axle_scene *scene = &axle->scene;
  const double *flow = span->flow;
  const ends e = ends_of(axle, span);
  const size_t springs = count_stores(scene);
  double work = flow[ROT_AXLE_FLOW_WORK];
  /* Work of other torques: without that of springs and gravity, which is the change of their
   * energy. */
  if (springs) work = pushes(scene, springs) ? work + e.potential : 0.0;
  const int linear = scene->quadratic_n_m_s2 == 0.0 && scene->static_n_m == 0.0;
  const double value[ROT_AXLE_TERMS] = {
      [KINETIC] = kinetic(&e),
      [PULLEY] = kinetic_change(axle->rope.inertia_kg_m2, e.omega),
      [MASSES] = kinetic_change(rot_axle_rope_moment(&axle->rope), e.omega),
      [POTENTIAL] = e.potential,
      [WORK] = work,
      [INERTIA_WORK] = flow[ROT_AXLE_FLOW_INERTIA],
      [VISCOUS_HEAT] = flow[ROT_AXLE_FLOW_VISCOUS],
      [QUADRATIC_HEAT] = flow[ROT_AXLE_FLOW_QUADRATIC],
      [DRY_HEAT] = flow[ROT_AXLE_FLOW_COULOMB],
      [CHANGE] = e.inertia[0] == e.inertia[1]
                     ? e.inertia[0] * (e.omega[1] - e.omega[0])
                     : e.inertia[1] * e.omega[1] - e.inertia[0] * e.omega[0],
      [IMPULSE] = flow[ROT_AXLE_FLOW_IMPULSE],
      [RESISTING] =
          linear ? scene->viscous_n_m_s * (e.theta[1] - e.theta[0]) : -flow[ROT_AXLE_FLOW_DAMPING]};
  memcpy(term, value, sizeof value);
}

/* From the errors of the flows, of the state at both rows, and the rounding of the sums. */
void rot_axle_explain(const void *built, const rot_span *span, const double term[],
                      double explained[]) {
  const rot_axle_built *axle = built;
  const double *flow = span->flow, *off = span->flow_error;
  const ends e = ends_of(axle, span);
  const double heat =
      flow[ROT_AXLE_FLOW_VISCOUS] + flow[ROT_AXLE_FLOW_QUADRATIC] + flow[ROT_AXLE_FLOW_COULOMB];
  const double size = fabs(term[KINETIC]) + fabs(flow[ROT_AXLE_FLOW_WORK]) + fabs(heat) +
                      fabs(flow[ROT_AXLE_FLOW_INERTIA]);
  double energy = off[ROT_AXLE_FLOW_WORK] + off[ROT_AXLE_FLOW_INERTIA] +
                  off[ROT_AXLE_FLOW_VISCOUS] + off[ROT_AXLE_FLOW_QUADRATIC] +
                  off[ROT_AXLE_FLOW_COULOMB] + e.potential_explained + 2.0 * DBL_EPSILON * size;
  double momentum =
      off[ROT_AXLE_FLOW_IMPULSE] + off[ROT_AXLE_FLOW_DAMPING] +
      2.0 * DBL_EPSILON * (fabs(term[CHANGE]) + fabs(term[IMPULSE]) + fabs(term[RESISTING]));
  for (int k = 0; k < 2; k++) {
    energy += e.inertia[k] * fabs(e.omega[k]) * e.omega_error[k];
    if (axle->scene.n_inertia) {
      energy += 2.0 * DBL_EPSILON * e.inertia[k] * (e.omega[k] * e.omega[k]);
    }
    momentum +=
        e.inertia[k] * e.omega_error[k] + fabs(axle->scene.viscous_n_m_s) * e.theta_error[k];
  }
  explained[ENERGY] = energy;
  explained[MOMENTUM] = momentum;
}

/* ---- conserved quantities -------------------------------------------------------------------- */

/* Springs and gravity conserve the sum of kinetic and potential energy if they act at all times. A
 * curve and dry friction represent losses of gears; on a pulley, gravity stores the work of the
 * weights. */
size_t rot_axle_conserved(const void *built, size_t balance, const char *why[]) {
  const rot_axle_built *axle = built;
  const rot_axle_scene *scene = &axle->scene;
  const int rope = hangs(axle);
  size_t stored = 0, n = 0;
  for (size_t i = 0; i < scene->n_terms; i++) {
    stored += stores(&scene->terms[i]) && always(&scene->terms[i]);
  }
  int acts = pushes(scene, stored);
  int resists = scene->viscous_n_m_s != 0.0 || scene->quadratic_n_m_s2 != 0.0 ||
                scene->coulomb_n_m != 0.0 || scene->static_n_m != 0.0;
  int lossy = 0;
  if (axle->geared) {
    const rot_axle_gears *gears = &axle->gears;
    lossy = gears->forward_n_m != 0.0 || gears->backward_n_m != 0.0 || scene->viscous_n_m_s != 0.0;
    acts = gears->applied_n_m != 0.0;
    resists = gears->bearings_n_m_s != 0.0;
  }
  const struct {
    size_t of;
    int acts;
    const char *words;
  } causes[] = {
      {ENERGY, acts && !rope, "the torque works"},
      {ENERGY, resists, "the resistance dissipates"},
      {ENERGY, lossy, "the gears dissipate"},
      {ENERGY, scene->n_inertia > 0, "what changes the moment of inertia works"},
      {MOMENTUM, acts && !rope, "a torque acts about the axle"},
      {MOMENTUM, acts && rope, "the weights act about the axle"},
      {MOMENTUM, stored > 0, "springs or gravity act about the axle"},
      {MOMENTUM, resists, "the resistance acts about the axle"},
      {MOMENTUM, lossy, "the gears take a torque"},
  };
  for (size_t i = 0; i < ROT_COUNT(causes); i++) {
    if (causes[i].of == balance && causes[i].acts) why[n++] = causes[i].words;
  }
  if (n) return n;
  why[0] = balance == MOMENTUM ? "no torque acts about the axle"
           : rope   ? "gravity gives back what it takes: kinetic plus potential energy stays"
           : stored ? "springs and gravity give back what they take: kinetic plus potential energy "
                      "stays"
                    : "nothing works and nothing dissipates";
  return 0;
}
