#include "scene/shaft/rigid.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "engine/stepping.h"
#include "maths/phi.h"
#include "ground/real.h"

/* Mean motion, spring torques, and both terms of the error bound. */
rot_status rot_shaft_lump_build(rot_shaft_lump *s, const rot_shaft_params *p) {
  const size_t n = p->n;
  memset(s, 0, sizeof *s);
  s->p = p;
  s->n = n;
  s->memory = calloc(3 * n, sizeof *s->memory);
  if (!s->memory) return ROT_ENOMEM;
  s->fraction = s->memory;
  s->base = s->memory + n;
  s->slope = s->memory + 2 * n;
  for (size_t i = 0; i < n; i++) s->inertia += p->inertia_kg_m2[i];
  for (size_t i = 0; i < n; i++) {
    s->fraction[i] = p->inertia_kg_m2[i] / s->inertia;
    s->alpha += p->torque_n_m[i] / s->inertia;
    s->decay += p->viscous_n_m_s[i] / s->inertia;
    s->damped |= p->viscous_n_m_s[i] > 0.0;
  }
  s->theta0 = s->omega0 = 0.0;
  for (size_t i = 1; i < n; i++) {
    s->theta0 += s->fraction[i] * (p->theta0_rad[i] - p->theta0_rad[0]);
    s->omega0 += s->fraction[i] * (p->omega0_rad_per_s[i] - p->omega0_rad_per_s[0]);
  }
  s->theta0 += p->theta0_rad[0];
  s->omega0 += p->omega0_rad_per_s[0];
  s->mean_exact = 1;
  for (size_t j = 0; j + 1 < n; j++) {
    const double k = p->stiffness_n_m_per_rad[j];
    double left = 0.0, torque_left = 0.0, torque_right = 0.0, drag_left = 0.0, drag_right = 0.0;
    for (size_t i = 0; i < n; i++) {
      left += i <= j ? s->fraction[i] : 0.0;
      *(i <= j ? &torque_left : &torque_right) += p->torque_n_m[i];
      *(i <= j ? &drag_left : &drag_right) += p->viscous_n_m_s[i];
    }
    double right = 0.0;
    for (size_t i = j + 1; i < n; i++) right += s->fraction[i];
    s->base[j] = right * torque_left - left * torque_right;
    s->slope[j] = left * drag_right - right * drag_left;
    if (fabs(s->slope[j]) <= 8.0 * ROT_EPS * (drag_left + drag_right)) s->slope[j] = 0.0;
    s->mean_exact &= s->slope[j] == 0.0;
    s->damped |= p->damping_n_m_s[j] > 0.0;
    s->broken |= k == 0.0;
    if (k == 0.0) continue;
    const double twist = p->theta0_rad[j] - p->theta0_rad[j + 1];
    const double carried = (s->base[j] + s->slope[j] * s->omega0) / sqrt(k);
    s->start = hypot(s->start, sqrt(k) * twist - carried);
    s->path = hypot(s->path, s->slope[j] / sqrt(k));
  }
  for (size_t i = 0; i < n; i++) {
    s->start = hypot(s->start, sqrt(p->inertia_kg_m2[i]) * (p->omega0_rad_per_s[i] - s->omega0));
  }
  return ROT_OK;
}

void rot_shaft_lump_free(rot_shaft_lump *s) { free(s->memory); }

void rot_shaft_lump_at(const rot_shaft_lump *s, double t, double *turned, double *omega,
                       double *turned_size, double *omega_size) {
  double phi[3];
  rot_phi(s->decay * t, 0.0, 2, phi);
  *omega = s->omega0 * phi[0] + s->alpha * t * phi[1];
  *turned = s->omega0 * t * phi[1] + s->alpha * t * t * phi[2];
  *omega_size = fabs(s->omega0) * phi[0] * (1.0 + s->decay * fabs(t)) + fabs(s->alpha * t) * phi[1];
  *turned_size = fabs(s->omega0 * t) * phi[1] + fabs(s->alpha * t * t) * phi[2];
}

typedef struct rigid_run {
  const rot_shaft_lump *s;
  const double *time_s;
  const rot_shaft_columns *out;
  rot_info *info;
} rigid_run;

/* (rigid body, row) => angles, rates, torques, error bounds. */
static rot_status write_row(void *model, size_t row) {
  const rigid_run *run = model;
  const rot_shaft_lump *s = run->s;
  const rot_shaft_columns *out = run->out;
  const rot_shaft_params *p = s->p;
  const double t = run->time_s[row] - p->start_s;
  const size_t n = s->n;
  const double rounding = (12.0 + 2.0 * (double)n) * ROT_EPS;
  double turned, omega, turned_size, omega_size;
  rot_shaft_lump_at(s, t, &turned, &omega, &turned_size, &omega_size);
  const int known = !s->broken && !(t < 0.0 && s->damped);
  const double off = known ? s->start + s->path * fabs(omega - s->omega0) : (double)INFINITY;
  const double mean_off = s->mean_exact ? 0.0 : off * fabs(t) / sqrt(s->inertia);
  for (size_t i = 0; i < n; i++) {
    const double theta = p->theta0_rad[i] + turned, J = p->inertia_kg_m2[i];
    if (!(isfinite(theta) && isfinite(omega))) return ROT_ERANGE;
    double left = 0.0, twists = 0.0;
    for (size_t j = 0; j + 1 < n; j++) {
      const double k = p->stiffness_n_m_per_rad[j];
      left += s->fraction[j];
      const double twist = (fabs(s->base[j] + s->slope[j] * omega) + off * sqrt(k)) / k;
      twists += (j >= i ? 1.0 - left : left) * twist;
    }
    out->theta_rad[row * n + i] = theta;
    out->omega_rad_per_s[row * n + i] = omega;
    out->shaft_torque_n_m[row * n + i] = i + 1 < n ? s->base[i] + s->slope[i] * omega : (double)NAN;
    rot_note_row(run->info, theta, omega,
                 fabs(p->theta0_rad[i] - s->theta0) + twists * (1.0 + rounding) + mean_off +
                     rounding * turned_size + 2.0 * ROT_EPS * fabs(theta),
                 off / sqrt(J) * (1.0 + rounding) + rounding * omega_size);
  }
  return ROT_OK;
}

rot_status rot_shaft_rigid(const rot_shaft_params *p, size_t n, const double time_s[],
                           const rot_shaft_columns *out, const rot_hooks *hooks, rot_info *info) {
  static const rot_stepping stepping = {.write_row = write_row};
  rot_shaft_lump s;
  rigid_run run = {&s, time_s, out, info};
  rot_shaft_note_start(p, info);
  info->status = rot_shaft_lump_build(&s, p);
  info->steps = n > 0;
  if (info->status == ROT_OK) {
    rot_step_rows(&stepping, &run, p->start_s, n, time_s, hooks, info);
  }
  rot_shaft_lump_free(&s);
  return info->status;
}
