#include "scene/shaft/ledger.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "maths/expm.h"
#include "ground/gauss.h"
#include "ground/real.h"
#include "scene/shaft/rigid.h"
#include "scene/shaft/modes.h"
#include "scene/shaft/decoupled.h"
#include "scene/shaft/coupled.h"

static double angle_of(const rot_shaft_modes *s, const double p[], size_t i) {
  double sum = 0.0;
  for (size_t m = s->n; m-- > 1;) {
    sum += s->shape[i * s->n + m] * (m > s->floppy ? p[m] / s->sigma[m] : p[m]);
  }
  return sum;
}

/* Size from which loops poll, as in rot_expm_multiply(). */
enum { LARGE = 128 };

static rot_status add_transformed(size_t n, double w[], const double weight, const double e[],
                                  const double q[], double work[], const rot_hooks *hooks) {
  /* w += weight e' q e. */
  rot_status status = rot_expm_multiply(n, q, e, work, hooks);
  for (size_t i = 0; i < n && status == ROT_OK; i++) {
    for (size_t k = 0; k < n; k++) {
      const double x = weight * e[k * n + i];
      if (x == 0.0) continue;
      for (size_t j = 0; j < n; j++) w[i * n + j] += x * work[k * n + j];
    }
    if (n >= LARGE) status = rot_poll(hooks, 0.0);
  }
  return status;
}

/* Heat = x0' W x0 with W = int exp(A't) Q exp(A t) dt: quadrature over a short time, then doubling,
 * W(2h) = W(h) + exp(A'h) W(h) exp(A h). All terms are positive: no cancellation. */
static rot_status find_heat(const rot_shaft_modes *s, double from, double span, const double p[],
                            const double r[], rot_shaft_ledger *ledger) {
  const size_t n = s->n, size = 2 * n + 1, square = size * size;
  double *memory = calloc(4 * square + 2 * size + ROT_EXPM_WORK(size) + 2 * square, sizeof *memory);
  if (!memory) return ROT_ENOMEM;
  double *q = memory, *w = q + square, *sum = w + square, *x = sum + 2 * square, *y = x + size;
  rot_shaft_stepper step = rot_shaft_stepper_in(n, y + size);
  int doublings = 0;
  const double norm = fmax(s->norm, fmax(s->decay, s->coupling[0]));
  if (norm * span > 1.0) doublings = (int)ceil(log2(norm * span));
  const double h = ldexp(span, -doublings);
  for (size_t a = 0; a < n; a++) {
    for (size_t b = 0; b < n; b++) q[(n + a) * size + n + b] = s->coupling[a * n + b];
  }
  rot_status status = ROT_OK;
  for (int i = 0; i < 12 && status == ROT_OK; i++) {
    const rot_gauss_node at = rot_gauss(i);
    status = rot_shaft_set_step(s, &step, at.x * h);
    /* Rescale the last place from step.unit to 1. */
    for (size_t k = 0; k < size; k++) step.e[k * size + 2 * n] *= step.unit;
    step.e[square - 1] = 1.0;
    if (status == ROT_OK) {
      status = add_transformed(size, w, at.weight * h, step.e, q, sum, s->hooks);
    }
  }
  if (status == ROT_OK) status = rot_shaft_set_step(s, &step, h);
  for (size_t k = 0; k < size; k++) step.e[k * size + 2 * n] *= step.unit;
  step.e[square - 1] = 1.0;
  for (int i = 0; i < doublings && status == ROT_OK; i++) {
    memcpy(sum, w, square * sizeof *w);
    status = add_transformed(size, w, 1.0, step.e, sum, sum + square, s->hooks);
    if (status == ROT_OK) status = rot_expm_multiply(size, step.e, step.e, sum, s->hooks);
    memcpy(step.e, sum, square * sizeof *sum);
  }
  for (size_t m = 0; m < n; m++) {
    x[m] = m <= s->floppy ? 0.0 : p[m];
    x[n + m] = m == 0 ? r[0] * s->root_inertia : r[m];
  }
  x[2 * n] = 1.0;
  rot_expm_apply(size, w, x, y);
  double max = 0.0;
  ledger->dissipated_j = 0.0;
  for (size_t i = 0; i < size; i++) {
    ledger->dissipated_j += x[i] * y[i];
    for (size_t j = 0; j < size; j++) max += fabs(x[i] * w[i * size + j] * x[j]);
  }
  ledger->dissipated_rounding_j =
      ROT_EPS * (32.0 + 8.0 * (double)n + 4.0 * s->norm * (fabs(from) + span)) * max;
  free(memory);
  return isfinite(ledger->dissipated_j) || status != ROT_OK ? status : ROT_ERANGE;
}

/* Two times => p and r (or q) of the modes then, their errors. */
static rot_status modes_at(const rot_shaft_modes *s, const rot_dd t[2], double *const p[2],
                           double *const r[2], double *const error[2]) {
  if (s->decoupled) {
    for (int k = 0; k < 2; k++) rot_shaft_decoupled_at(s, t[k], p[k], r[k], error[k]);
    return ROT_OK;
  }
  rot_shaft_coupled x;
  rot_status status = rot_shaft_coupled_begin(&x, s, 1);
  for (int k = 0; k < 2 && status == ROT_OK; k++) {
    status = rot_shaft_coupled_at(&x, t[k], p[k], r[k], error[k]);
  }
  rot_shaft_coupled_end(&x);
  return status;
}

/* (shaft, two times) => work from the angles, heat from the modes. */
static rot_status balance_of_modes(const rot_shaft_params *p, rot_dd begin, rot_dd finish,
                                   const rot_hooks *hooks, rot_shaft_ledger *ledger) {
  rot_shaft_modes s;
  const double from = begin.hi, to = finish.hi;
  const size_t n = p->n;
  double *memory = calloc(8 * n, sizeof *memory);
  rot_status status = memory ? rot_shaft_modes_build(&s, p, hooks) : ROT_ENOMEM;
  if (!memory) return status;
  double *p0 = memory, *r0 = p0 + n, *p1 = r0 + n, *r1 = p1 + n, *e0 = r1 + n, *e1 = e0 + 2 * n;
  if (status == ROT_OK) {
    status = modes_at(&s, (const rot_dd[2]){begin, finish}, (double *const[2]){p0, p1},
                      (double *const[2]){r0, r1}, (double *const[2]){e0, e1});
  }
  for (size_t i = 0; i < n && status == ROT_OK; i++) {
    const double tau = p->torque_n_m[i], twist = angle_of(&s, p1, i) - angle_of(&s, p0, i);
    double error = 8.0 * ROT_EPS * (fabs(p0[0]) + fabs(p1[0]));
    for (size_t m = 0; m < n; m++) {
      const double shape = fabs(s.shape[i * n + m]);
      error += shape * (m > s.floppy ? (e0[n + m] + e1[n + m]) / s.sigma[m]
                                     : (e0[m] + e1[m]) * (fabs(to) + fabs(from)));
    }
    ledger->work_j += tau * ((p1[0] - p0[0]) + twist);
    ledger->work_rounding_j += fabs(tau) * error;
  }
  int damped = 0;
  for (size_t m = 0; m < n * n; m++) damped |= s.coupling != NULL && s.coupling[m] != 0.0;
  if (damped && to > from && status == ROT_OK) {
    status = find_heat(&s, from, to - from, p0, r0, ledger);
  }
  rot_shaft_modes_free(&s);
  free(memory);
  return status;
}

/* (shaft, two times) => work, heat of the rigid body: Gauss-Legendre quadrature of omega^2 over
 * segments of decay * t = 2. */
static rot_status balance_of_lump(const rot_shaft_params *p, double from, double to,
                                  rot_shaft_ledger *ledger) {
  rot_shaft_lump s;
  double theta0, theta1, omega, theta_size, omega_size, torque = 0.0, max = 0.0;
  const rot_status status = rot_shaft_lump_build(&s, p);
  if (status != ROT_OK) return status;
  rot_shaft_lump_at(&s, from, &theta0, &omega, &theta_size, &omega_size);
  max += theta_size;
  rot_shaft_lump_at(&s, to, &theta1, &omega, &theta_size, &omega_size);
  max += theta_size;
  for (size_t i = 0; i < p->n; i++) torque += p->torque_n_m[i];
  ledger->work_j = torque * (theta1 - theta0);
  ledger->work_rounding_j = fabs(torque) * 16.0 * ROT_EPS * max;
  /* From t = 40/decay on omega is constant: one segment. */
  const double settled = s.decay > 0.0 ? fmin(to, fmax(from, 40.0 / s.decay)) : to;
  const double parts = fmax(1.0, ceil(s.decay * (settled - from) / 2.0));
  double sum = 0.0;
  for (double k = 0.0; k < parts && s.decay > 0.0; k += 1.0) {
    const double h = (settled - from) / parts;
    for (int i = 0; i < 12; i++) {
      const rot_gauss_node at = rot_gauss(i);
      rot_shaft_lump_at(&s, from + (k + at.x) * h, &theta1, &omega, &theta_size, &omega_size);
      sum += at.weight * h * omega * omega;
    }
  }
  if (s.decay > 0.0 && to > settled) {
    rot_shaft_lump_at(&s, to, &theta1, &omega, &theta_size, &omega_size);
    sum += (to - settled) * omega * omega;
  }
  ledger->dissipated_j = s.decay * s.inertia * sum;
  ledger->dissipated_rounding_j = 40.0 * ROT_EPS * ledger->dissipated_j;
  rot_shaft_lump_free(&s);
  return ROT_OK;
}

rot_status rot_shaft_balance(const rot_shaft_params *p, int rigid, double from_s, double to_s,
                             const rot_hooks *hooks, rot_shaft_ledger *ledger) {
  const rot_dd from = rot_dd_sum2(from_s, -p->start_s), to = rot_dd_sum2(to_s, -p->start_s);
  *ledger = (rot_shaft_ledger){0.0, 0.0, 0.0, 0.0};
  return rigid ? balance_of_lump(p, from.hi, to.hi, ledger)
               : balance_of_modes(p, from, to, hooks, ledger);
}

/* ---- flows ----------------------------------------------------------------------------------- */

enum { WORK, HEAT, ELASTIC, IMPULSE };
const char *const rot_shaft_flow_names[ROT_SHAFT_FLOWS] = {[WORK] = "work_j",
                                                           [HEAT] = "dissipated_j",
                                                           [ELASTIC] = "elastic_energy_j",
                                                           [IMPULSE] = "torque_impulse_n_m_s"};

static double sum_of(size_t n, const double x[]) {
  double sum = 0.0;
  for (size_t i = 0; i < n; i++) sum += x[i];
  return sum;
}

static double size_of(size_t n, const double x[]) {
  double sum = 0.0;
  for (size_t i = 0; i < n; i++) sum += fabs(x[i]);
  return sum;
}

/* Change of the elastic energy since the start, from the torques of a row: a difference of two
 * angles loses the twist of a stiff shaft. The energy norm of the error of the twists equals that
 * of the error of omega. */
static double elastic_at(const rot_shaft_params *p, const double omega[], const double shaft[],
                         double omega_error, double *error) {
  double change = 0.0, before = 0.0, after = 0.0, rounding = 0.0;
  for (size_t i = 0; i + 1 < p->n; i++) {
    const double k = p->stiffness_n_m_per_rad[i], c = p->damping_n_m_s[i];
    if (k == 0.0) continue;
    const double damper = c * (omega[i] - omega[i + 1]), spring = shaft[i] - damper;
    const double start = k * (p->theta0_rad[i] - p->theta0_rad[i + 1]);
    const double twisted = k * (fabs(p->theta0_rad[i]) + fabs(p->theta0_rad[i + 1]));
    const double size = fabs(shaft[i]) + c * (fabs(omega[i]) + fabs(omega[i + 1]));
    change += 0.5 * (spring - start) * (spring + start) / k;
    before += start * start / k;
    after += spring * spring / k;
    rounding += 16.0 * ROT_EPS * (fabs(start) * twisted + fabs(spring) * size) / k;
  }
  const double root = sqrt(2.0 * sum_of(p->n, p->inertia_kg_m2));
  *error = root * (sqrt(before) + sqrt(after)) * omega_error + rounding;
  return change;
}

/* Work, heat, elastic energy and impulse, row by row. */
rot_status rot_shaft_flow(const rot_shaft_params *p, int rigid, size_t n, const double time_s[],
                          const rot_shaft_columns *rows, const rot_info *info, double *const flow[],
                          double error[], const rot_hooks *hooks) {
  const double torque = sum_of(p->n, p->torque_n_m), max = size_of(p->n, p->torque_n_m);
  rot_status status = ROT_OK;
  for (int k = 0; k < ROT_SHAFT_FLOWS; k++) error[k] = 0.0;
  for (size_t i = 0; i < n && status == ROT_OK; i++) {
    const double t = time_s[i];
    const int back = t < p->start_s;
    double off[ROT_SHAFT_FLOWS] = {0.0};
    rot_shaft_ledger ledger;
    status = back ? rot_shaft_balance(p, rigid, t, p->start_s, hooks, &ledger)
                  : rot_shaft_balance(p, rigid, p->start_s, t, hooks, &ledger);
    flow[WORK][i] = back ? -ledger.work_j : ledger.work_j;
    flow[HEAT][i] = back ? -ledger.dissipated_j : ledger.dissipated_j;
    flow[IMPULSE][i] = torque * (t - p->start_s);
    flow[ELASTIC][i] =
        rigid ? 0.0
              : elastic_at(p, rows->omega_rad_per_s + i * p->n, rows->shaft_torque_n_m + i * p->n,
                           info->measure[ROT_OMEGA].error, &off[ELASTIC]);
    off[WORK] = ledger.work_rounding_j;
    off[HEAT] = ledger.dissipated_rounding_j;
    off[IMPULSE] = 8.0 * ROT_EPS * max * fabs(t - p->start_s);
    for (int k = 0; k < ROT_SHAFT_FLOWS; k++) error[k] = fmax(error[k], off[k]);
  }
  return status;
}

/* ---- balances -------------------------------------------------------------------------------- */

enum { ENERGY, MOMENTUM };
const rot_balance rot_shaft_balances[ROT_SHAFT_BALANCES] = {
    [ENERGY] = {"energy", NULL, "J"}, [MOMENTUM] = {"angular_momentum", "the shaft", "kg m^2/s"}};

const rot_balance_term rot_shaft_terms[ROT_SHAFT_TERMS] = {
    {ENERGY, ROT_CHANGE, "change of kinetic energy", 0},
    {ENERGY, ROT_CHANGE, "change of elastic energy", 0},
    {ENERGY, ROT_SUPPLIED, "work of the torques", 0},
    {ENERGY, ROT_DISSIPATED, "heat of dampers and bearings", 0},
    {MOMENTUM, ROT_CHANGE, "change of angular momentum", 0},
    {MOMENTUM, ROT_SUPPLIED, "impulse of the torques", 0},
    {MOMENTUM, ROT_DISSIPATED, "impulse of the bearings", 0}};

/* Changes as products: a small change of a large energy keeps its digits. */
void rot_shaft_audit(const void *scene, const rot_span *s, double term[]) {
  const rot_shaft_params *p = scene;
  const size_t n = p->n;
  const double *turned = s->first, *turns = s->last, *before = s->first + n, *after = s->last + n;
  double kinetic = 0.0, momentum = 0.0, bearings = 0.0;
  for (size_t i = 0; i < n; i++) {
    const double gain = after[i] - before[i];
    kinetic += 0.5 * p->inertia_kg_m2[i] * gain * (after[i] + before[i]);
    momentum += p->inertia_kg_m2[i] * gain;
    bearings += p->viscous_n_m_s[i] * (turns[i] - turned[i]);
  }
  const double value[ROT_SHAFT_TERMS] = {kinetic,  s->flow[ELASTIC], s->flow[WORK], s->flow[HEAT],
                                         momentum, s->flow[IMPULSE], bearings};
  memcpy(term, value, sizeof value);
}

/* Springs store energy; their torques are internal. */
size_t rot_shaft_conserved(const void *scene, size_t balance, const char *why[]) {
  const rot_shaft_params *p = scene;
  size_t n = 0;
  if (size_of(p->n, p->torque_n_m) != 0.0) why[n++] = "a torque acts on a rotor";
  if (sum_of(p->n, p->viscous_n_m_s) != 0.0) {
    why[n++] = "the viscous resistance acts on a rotor";
  }
  if (balance == ENERGY && sum_of(p->n - 1, p->damping_n_m_s) != 0.0) {
    why[n++] = "the shafts are damped";
  }
  if (n) return n;
  why[0] = balance == ENERGY
               ? "the shafts give back what they take: kinetic plus elastic energy stays"
               : "all torques act between the rotors";
  return 0;
}
