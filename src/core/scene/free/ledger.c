#include "scene/free/ledger.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "ground/real.h"
#include "maths/attitude.h"
#include "scene/free/exact.h"

#define X(name) #name,
const char *const rot_free_flow_names[ROT_FREE_FLOWS] = {ROT_FREE_LEDGER(X)};
#undef X

enum { WORK, HEAT, TORQUE, DAMPING = 5, MOTORS = ROT_FREE_MOTOR_WORK }; /* flows */
enum { Q, RATES = 4, ROTORS = ROT_FREE_OWN_COLUMNS };                   /* columns */

/* ---- flows of closed forms ------------------------------------------------------------------- */

void rot_free_exact_flows(const rot_free_params *p, const rot_task *task, const rot_rows *rows) {
  double max[ROT_FREE_FLOWS] = {0.0}, damping = 0.0;
  for (size_t i = 0; i < task->n; i++) {
    double flow[ROT_FREE_FLOWS];
    rot_free_flows(p, p->start_s, task->time_s[i], flow);
    for (int k = 0; k < ROT_FREE_FLOWS; k++) {
      rows->flow[k][i] = flow[k];
      max[k] = fmax(max[k], fabs(flow[k]));
    }
  }
  for (int k = DAMPING; k < MOTORS; k++) damping = fmax(damping, max[k]);
  for (int k = 0; k < ROT_FREE_FLOWS; k++) {
    rows->flow_error[k] = 8.0 * DBL_EPSILON * (k < DAMPING || k == MOTORS ? max[k] : damping);
  }
}

/* Torque on a driven rotor: J a omega'; power: torque times its speed. */
void rot_free_gyrostat_flows(const rot_free_params *p, const rot_task *task, const rot_rows *rows,
                             const rot_info *info) {
  double driven[3] = {0.0}, size = 0.0;
  for (size_t k = 0; k < p->n_rotors; k++) {
    const rot_free_rotor *one = &p->rotors[k];
    const double spin = one->moment_kg_m2 * one->omega_rad_per_s;
    for (int j = 0; j < 3 && one->driven; j++) driven[j] += spin * one->axis[j];
  }
  for (int j = 0; j < 3; j++) size += fabs(driven[j]);
  for (int k = 0; k < ROT_FREE_FLOWS; k++) {
    memset(rows->flow[k], 0, task->n * sizeof *rows->flow[k]);
    rows->flow_error[k] = 0.0;
  }
  for (size_t i = 0; i < task->n; i++) {
    for (int j = 0; j < 3; j++) {
      const double rate = ((const double *)rows->column[RATES + j])[i];
      rows->flow[MOTORS][i] += driven[j] * (rate - p->omega0_rad_per_s[j]);
    }
  }
  rows->flow_error[MOTORS] = 2.0 * size * info->measure[ROT_FREE_OMEGA].error;
}

/* ---- balances -------------------------------------------------------------------------------- */

/* L of the body with locked rotors, own axes. */
static void momentum_of(const rot_free_params *p, const double omega[3], double l[3]) {
  double own[3] = {omega[0], omega[1], omega[2]};
  if (p->turned) rot_attitude_to_body(p->axes, omega, own);
  for (int k = 0; k < 3; k++) own[k] *= p->moment_kg_m2[k];
  memcpy(l, own, sizeof own);
  if (p->turned) rot_attitude_to_space(p->axes, own, l);
}

/* L with the contribution of the rotors. */
static void momentum_at(const rot_free_params *p, const double row[], double l[3]) {
  momentum_of(p, row + RATES, l);
  for (size_t k = 0; k < p->n_rotors; k++) {
    const double spin = p->rotors[k].moment_kg_m2 * row[ROTORS + 2 * k];
    for (int j = 0; j < 3; j++) l[j] += spin * p->rotors[k].axis[j];
  }
}

/* Change of the energy without cancellation. */
static double change_of_energy(const rot_free_params *p, const double a[], const double b[]) {
  double before[3], after[3], change = 0.0;
  momentum_of(p, a + RATES, before);
  momentum_of(p, b + RATES, after);
  for (int k = 0; k < 3; k++) {
    change += 0.5 * (b[RATES + k] - a[RATES + k]) * (after[k] + before[k]);
  }
  for (size_t k = 0; k < p->n_rotors; k++) {
    const rot_free_rotor *one = &p->rotors[k];
    const double from = a[ROTORS + 2 * k], to = b[ROTORS + 2 * k];
    const double along = rot_dot(one->axis, a + RATES), later = rot_dot(one->axis, b + RATES);
    const double mean = 0.5 * (from + to);
    change +=
        one->moment_kg_m2 * ((to - from) * (0.5 * (along + later) + mean) + mean * (later - along));
  }
  return change;
}

/* A quaternion norm other than 1 appears in the rotated vectors. */
void rot_free_audit(const void *scene, const rot_span *s, double term[]) {
  const rot_free_params *p = scene;
  double l[3], before[3], after[3], norm = 0.0;
  momentum_at(p, s->first, l);
  rot_attitude_to_space(s->first + Q, l, before);
  momentum_at(p, s->last, l);
  rot_attitude_to_space(s->last + Q, l, after);
  for (int k = 0; k < 4; k++) {
    norm += 0.5 * (s->last[Q + k] - s->first[Q + k]) * (s->last[Q + k] + s->first[Q + k]);
  }
  term[0] = change_of_energy(p, s->first, s->last);
  term[1] = s->flow[WORK];
  term[2] = p->n_rotors ? s->flow[MOTORS] : 0.0;
  term[3] = s->flow[HEAT];
  for (int k = 0; k < 3; k++) {
    term[4 + 3 * k] = after[k] - before[k];
    term[5 + 3 * k] = s->flow[TORQUE + k];
    term[6 + 3 * k] = -s->flow[DAMPING + k];
  }
  term[13] = norm;
}

/* Residuals from the errors of the measures; the error of L is used for L itself. Fixed steps are
 * chosen for the worst measure, mostly the attitude: an error of omega far below that does not
 * decrease at the order of the method. The difference of two runs resolves it to 1/1000 of the
 * attitude error, not better. */
void rot_free_explain(const void *scene, const rot_span *s, const double term[],
                      double explained[]) {
  const rot_free_params *p = scene;
  const double *row[] = {s->first, s->last}, eps = DBL_EPSILON;
  double size = 0.0, fastest = 0.0, spins = 0.0, speeds = 0.0;
  for (int i = 0; i < 2; i++) {
    double l[3];
    momentum_at(p, row[i], l);
    size = fmax(size, rot_length(l));
    fastest = fmax(fastest, rot_length(row[i] + RATES));
  }
  for (size_t k = 0; k < p->n_rotors; k++) {
    const rot_free_rotor *one = &p->rotors[k];
    const size_t at = ROTORS + 2 * k;
    const double speed = fmax(fabs(row[0][at]), fabs(row[1][at]));
    spins += one->moment_kg_m2 * speed;
    speeds += speed + fmax(fabs(rot_dot(one->axis, row[0] + RATES)),
                           fabs(rot_dot(one->axis, row[1] + RATES)));
  }
  const double of_l = s->error[ROT_FREE_MOMENTUM];
  const double of_omega =
      fmax(s->error[ROT_FREE_OMEGA], 1e-3 * s->error[ROT_FREE_ATTITUDE] * fastest);
  explained[0] = 2.0 * size * (of_omega + 8.0 * eps * fastest) +
                 8.0 * eps * (fabs(term[1]) + fabs(term[2]) + fabs(term[3])) + s->flow_error[WORK] +
                 s->flow_error[HEAT] + s->flow_error[MOTORS] +
                 speeds * (2.0 * of_l + 16.0 * eps * spins);
  for (int k = 0; k < 3; k++) {
    explained[1 + k] = 2.0 * of_l + 32.0 * eps * (size + spins) + s->flow_error[TORQUE + k] +
                       s->flow_error[DAMPING + k];
  }
  explained[4] = 8.0 * eps;
}

/* ---- conserved quantities -------------------------------------------------------------------- */

int rot_free_acts_along(const rot_free_params *p, int k) {
  int acts = p->law != NULL;
  for (int j = 0; j < 3; j++) {
    if (k >= 0 && j != k) continue;
    acts |= p->torque[j] != 0.0;
    for (size_t i = 0; i < p->n_knots; i++) acts |= p->knot_torque[j][i] != 0.0;
  }
  return acts;
}

int rot_free_motors_work(const rot_free_params *p) {
  int works = p->motors != NULL;
  for (size_t k = 0; k < p->n_rotors; k++) {
    works |= p->rotors[k].driven || p->rotors[k].torque != 0.0 || p->rotors[k].n_knots;
  }
  return works;
}

/* A torque in space axes conserves the components of L across it. */
size_t rot_free_conserved(const void *scene, size_t balance, const char *why[]) {
  const rot_free_params *p = scene;
  const int along = balance && p->in_space ? (int)balance - 1 : -1;
  size_t n = 0;
  if (rot_free_acts_along(p, along)) why[n++] = balance ? "a torque acts" : "the torque works";
  if (p->damping_per_s != 0.0) why[n++] = "the damping acts";
  if (!balance && rot_free_motors_work(p)) why[n++] = "the motors of the rotors work";
  if (n) return n;
  why[0] = balance ? "no torque acts along it" : "no torque acts: the energy of rotation stays";
  return 0;
}

/* Rotors add rates to those of a body without rotors. */
void rot_free_time_scales(const void *scene, const double sizes[], rot_time_scales *time_scales) {
  const rot_free_params *p = scene;
  const double *m = p->moment_kg_m2;
  double spins = 0.0;
  for (size_t k = 0; k < p->n_rotors; k++) {
    spins += fabs(p->rotors[k].moment_kg_m2 * p->rotors[k].omega_rad_per_s);
  }
  time_scales->fades_s = p->damping_per_s > 0.0 ? 1.0 / p->damping_per_s : INFINITY;
  time_scales->swing_rad_per_s =
      2.0 * sizes[ROT_FREE_OMEGA] + 2.0 * spins / fmax(fmin(m[0], fmin(m[1], m[2])), 1e-300);
}
