#include "scene/free/rotors.h"

#include <math.h>
#include <string.h>

#include "maths/attitude.h"
#include "scene/free/torque.h"
#include "ground/real.h"

/* Inverse of a symmetric positive definite matrix. Returns 0 if it is not, else 1. */
static int invert(double m[3][3], double out[3][3]) {
  for (int i = 0; i < 3; i++) {
    const int a = (i + 1) % 3, b = (i + 2) % 3;
    for (int j = 0; j < 3; j++) {
      const int c = (j + 1) % 3, d = (j + 2) % 3;
      out[j][i] = m[a][c] * m[b][d] - m[a][d] * m[b][c];
    }
  }
  const double by = m[0][0] * out[0][0] + m[0][1] * out[1][0] + m[0][2] * out[2][0];
  const double size = m[0][0] * m[1][1] * m[2][2];
  const int fits = m[0][0] > 0.0 && m[1][1] > 0.0 && m[2][2] > 0.0 && out[0][0] > 0.0 &&
                   out[1][1] > 0.0 && out[2][2] > 0.0 && by > 1e-12 * size;
  for (int i = 0; i < 9; i++) out[i / 3][i % 3] /= by;
  return fits;
}

/* Inverse of I - sum J a a*, scaled by a power of two: no product overflows. Returns 0 if
 * singular. */
static int invert_tensor(const rot_free_params *p, rot_free_rotors *out) {
  double m[3][3] = {{0.0}}, norm = 0.0;
  int scale;
  (void)frexp(fmax(p->moment_kg_m2[0], fmax(p->moment_kg_m2[1], p->moment_kg_m2[2])), &scale);
  for (int i = 0; i < 3; i++) m[i][i] = ldexp(p->moment_kg_m2[i], -scale);
  for (size_t k = 0; k < out->n; k++) {
    if (p->rotors[k].driven) continue;
    const double moment = ldexp(p->rotors[k].moment_kg_m2, -scale);
    for (int i = 0; i < 9; i++) {
      m[i / 3][i % 3] -= moment * out->axis[k][i / 3] * out->axis[k][i % 3];
    }
  }
  if (!invert(m, out->inverse)) return 0;
  for (int i = 0; i < 3; i++) { /* row norm >= 1 / min moment */
    double *row = out->inverse[i];
    norm = fmax(norm, fabs(row[0]) + fabs(row[1]) + fabs(row[2]));
    for (int j = 0; j < 3; j++) row[j] = ldexp(row[j], -scale);
  }
  out->min = ldexp(1.0 / norm, scale);
  return 1;
}

/* Axes, states, inverse tensor, momenta at the start. */
const char *rot_free_rotors_begin(const rot_free_params *p, rot_free_rotors *out) {
  double q[4];
  memset(out, 0, sizeof *out);
  out->p = p;
  out->n = p->n_rotors;
  out->min = fmin(p->moment_kg_m2[0], fmin(p->moment_kg_m2[1], p->moment_kg_m2[2]));
  rot_free_principal(p, out->omega0, q);
  for (int i = 0; i < 3; i++) out->momentum0[i] = p->moment_kg_m2[i] * out->omega0[i];
  if (!(out->min > 0.0)) return "the body has an axis without moment";
  for (size_t k = 0; k < out->n; k++) {
    const rot_free_rotor *rotor = &p->rotors[k];
    const double spin = rotor->moment_kg_m2 * rotor->omega_rad_per_s;
    for (int i = 0; i < 3; i++) out->axis[k][i] = rotor->axis[i];
    if (p->turned) rot_attitude_to_body(p->axes, rotor->axis, out->axis[k]);
    out->size += fabs(spin);
    for (int i = 0; i < 3; i++) {
      out->momentum0[i] += spin * out->axis[k][i];
      if (rotor->driven) out->driven[i] += spin * out->axis[k][i];
    }
    if (rotor->driven) continue;
    out->state[k] = out->n_states++;
    out->start[out->state[k]] = spin + rotor->moment_kg_m2 * rot_dot(out->axis[k], out->omega0);
  }
  if (out->n && !invert_tensor(p, out)) return "a rotor has more moment than the body with it";
  return NULL;
}

void rot_free_rotors_omega(const rot_free_rotors *r, const double l[3], const double s[],
                           double omega[3]) {
  if (!r->n) {
    for (int i = 0; i < 3; i++) omega[i] = l[i] / r->p->moment_kg_m2[i];
    return;
  }
  double own[3];
  for (int i = 0; i < 3; i++) own[i] = l[i] - r->driven[i];
  for (size_t k = 0; k < r->n; k++) {
    if (r->p->rotors[k].driven) continue;
    for (int i = 0; i < 3; i++) own[i] -= s[r->state[k]] * r->axis[k][i];
  }
  for (int i = 0; i < 3; i++) omega[i] = rot_dot(r->inverse[i], own);
}

/* Only for axes along principal axes, within rounding. */
int rot_free_rotors_constant(const rot_free_rotors *r, double m[3], double h[3]) {
  int fits = 1;
  for (int i = 0; i < 3; i++) {
    m[i] = 1.0 / r->inverse[i][i];
    h[i] = r->driven[i];
    for (int j = 0; j < 3; j++) {
      const double size = sqrt(r->inverse[i][i] * r->inverse[j][j]);
      fits &= i == j || fabs(r->inverse[i][j]) <= 32.0 * ROT_EPS * size;
    }
  }
  for (size_t k = 0; k < r->n; k++) {
    if (r->p->rotors[k].driven) continue;
    for (int i = 0; i < 3; i++) h[i] += r->start[r->state[k]] * r->axis[k][i];
  }
  return fits;
}

void rot_free_rotors_speeds(const rot_free_rotors *r, const double omega[3], const double s[],
                            double speed[]) {
  for (size_t k = 0; k < r->n; k++) {
    const rot_free_rotor *rotor = &r->p->rotors[k];
    speed[k] = rotor->driven ? rotor->omega_rad_per_s
                             : s[r->state[k]] / rotor->moment_kg_m2 - rot_dot(r->axis[k], omega);
  }
}

static double knots_at(const rot_free_rotor *rotor, double t) {
  const double *y = rotor->knot_torque;
  size_t i;
  double part;
  if (!rot_free_between_knots(rotor->n_knots, rotor->knot_s, t, &i, &part)) return 0.0;
  return part < 1.0 ? y[i] + (y[i + 1] - y[i]) * part : y[i + 1];
}

/* Constant, table and law of each motor. */
rot_status rot_free_rotors_torque(const rot_free_rotors *r, double t, const double omega[3],
                                  const double q[4], double torque[]) {
  const rot_free_params *p = r->p;
  double more[ROT_FREE_MAX_ROTORS] = {0.0};
  if (p->motors) {
    double own_q[4] = {q[0], q[1], q[2], q[3]}, own[3] = {omega[0], omega[1], omega[2]};
    if (p->turned) {
      const double back[4] = {p->axes[0], -p->axes[1], -p->axes[2], -p->axes[3]};
      rot_attitude_times(q, back, own_q);
      rot_attitude_to_space(p->axes, omega, own);
    }
    (void)rot_attitude_unit(own_q);
    const rot_status status = p->motors(t, own, own_q, more, p->motors_ctx);
    if (status != ROT_OK) return status;
  }
  for (size_t k = 0; k < r->n; k++) {
    const rot_free_rotor *rotor = &p->rotors[k];
    torque[k] = rotor->driven ? 0.0 : rotor->torque + knots_at(rotor, t) + more[k];
  }
  return ROT_OK;
}

rot_status rot_free_rotors_slopes(const rot_free_rotors *r, double t, const double omega[3],
                                  const double q[4], const double s[], double slope[],
                                  double *power) {
  double torque[ROT_FREE_MAX_ROTORS], speed[ROT_FREE_MAX_ROTORS];
  const rot_status status = rot_free_rotors_torque(r, t, omega, q, torque);
  *power = 0.0;
  if (status != ROT_OK) return status;
  rot_free_rotors_speeds(r, omega, s, speed);
  for (size_t k = 0; k < r->n; k++) {
    if (r->p->rotors[k].driven) continue;
    slope[r->state[k]] = torque[k];
    *power += torque[k] * speed[k];
  }
  return ROT_OK;
}

/* Torque on a driven rotor: J a omega'; power: torque times W. */
double rot_free_rotors_driven_work(const rot_free_rotors *r, const double omega[3]) {
  double work = 0.0;
  for (int i = 0; i < 3; i++) work += r->driven[i] * (omega[i] - r->omega0[i]);
  return work;
}

void rot_free_rotors_note(const rot_free_rotors *r, const double omega[3], double angle_error,
                          double omega_error, rot_info *info) {
  const double *m = r->p->moment_kg_m2, max = fmax(m[0], fmax(m[1], m[2]));
  const double size = rot_length(r->momentum0) + r->size + max * rot_length(omega);
  rot_measure *momentum = &info->measure[ROT_FREE_MOMENTUM];
  rot_free_note(r->p, omega, angle_error, omega_error, info);
  rot_note_value(momentum, rot_length(r->momentum0));
  rot_note_value(momentum, r->size);
  momentum->error = fmax(momentum->error, max * omega_error + size * (angle_error + 8.0 * ROT_EPS));
}

/* Momentum, energy and columns of rotors. */
rot_status rot_free_rotors_write(const rot_free_rotors *r, const double omega[3], const double q[4],
                                 const double s[], size_t i, const rot_free_columns *out) {
  const rot_free_params *p = r->p;
  double speed[ROT_FREE_MAX_ROTORS], l[3], space[3], sum = 0.0;
  double energy = 0.0;
  rot_free_rotors_speeds(r, omega, s, speed);
  for (int j = 0; j < 3; j++) {
    l[j] = p->moment_kg_m2[j] * omega[j];
    energy += 0.5 * l[j] * omega[j];
  }
  for (size_t k = 0; k < r->n; k++) {
    const rot_free_rotor *rotor = &p->rotors[k];
    const double spin = rotor->moment_kg_m2 * speed[k], along = rot_dot(r->axis[k], omega);
    for (int j = 0; j < 3; j++) l[j] += spin * r->axis[k][j];
    energy += spin * (along + 0.5 * speed[k]);
    out->rotor_omega[k][i] = speed[k];
    out->rotor_momentum[k][i] = rotor->driven ? spin + rotor->moment_kg_m2 * along : s[r->state[k]];
    sum += speed[k] + out->rotor_momentum[k][i];
  }
  rot_attitude_to_space(q, l, space);
  out->angular_momentum_x_kg_m2_per_s[i] = space[0];
  out->angular_momentum_y_kg_m2_per_s[i] = space[1];
  out->angular_momentum_z_kg_m2_per_s[i] = space[2];
  out->rotational_kinetic_energy_j[i] = energy;
  return isfinite(sum + energy + space[0] + space[1] + space[2]) ? ROT_OK : ROT_ERANGE;
}
