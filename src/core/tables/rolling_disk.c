#include "tables/rolling_disk.h"

#include <math.h>
#include <stdlib.h>

#include "maths/attitude.h"
#include "engine/ode/ode.h"
#include "ground/real.h"

/* The state: attitude quaternion, omega in space, x and y of the centre. */
enum { OMEGA = 4, STATE = 7, PLACE = 7, DIM = 9 };

/* Vectors in space at a state. */
typedef struct rolling {
  double e[3];          /* axis of the disk, unit vector */
  double d[3];          /* from the contact to the centre, unit vector */
  double omega_rate[3]; /* angular acceleration */
  double v[3], a[3];    /* of the centre */
} rolling;

/* state y => directions, velocity, accelerations; ROT_ERHS if the disk is horizontal */
static rot_status find(const rot_rolling_disk *p, const double y[], rolling *x) {
  static const double along[3] = {0.0, 0.0, 1.0};
  const double *w = y + OMEGA;
  double q[4] = {y[0], y[1], y[2], y[3]}, n[3], e_rate[3], d_rate[3], wd[3], l[3], gyro[3], turn[3];
  (void)rot_attitude_unit(q);
  rot_attitude_to_space(q, along, x->e);
  const double c = x->e[2], s = hypot(x->e[0], x->e[1]);
  if (!(s > 0.0)) return ROT_ERHS;
  for (int k = 0; k < 3; k++) x->d[k] = (along[k] - c * x->e[k]) / s;
  rot_cross(x->e, x->d, n);
  rot_cross(w, x->e, e_rate);
  const double c_rate = e_rate[2], s_rate = -c * c_rate / s;
  for (int k = 0; k < 3; k++) {
    d_rate[k] = -(c_rate * x->e[k] + c * e_rate[k] + x->d[k] * s_rate) / s;
  }
  const double we = rot_dot(w, x->e);
  for (int k = 0; k < 3; k++)
    l[k] = p->transverse * w[k] + (p->axial - p->transverse) * we * x->e[k];
  rot_cross(w, l, gyro);
  rot_cross(w, d_rate, wd);
  /* d x (omega x d' + (g/r) z) */
  double push[3] = {wd[0], wd[1], wd[2] + p->gravity_m_per_s2 / p->radius_m};
  rot_cross(x->d, push, turn);
  double b[3];
  for (int k = 0; k < 3; k++) b[k] = -gyro[k] - turn[k];
  const double by_e = rot_dot(b, x->e) / (p->axial + 1.0), by_d = rot_dot(b, x->d) / p->transverse,
               by_n = rot_dot(b, n) / (p->transverse + 1.0);
  for (int k = 0; k < 3; k++) {
    x->omega_rate[k] = by_e * x->e[k] + by_d * x->d[k] + by_n * n[k];
  }
  rot_cross(w, x->d, x->v);
  rot_cross(x->omega_rate, x->d, x->a);
  for (int k = 0; k < 3; k++) {
    x->v[k] *= p->radius_m;
    x->a[k] = p->radius_m * (x->a[k] + wd[k]);
  }
  return ROT_OK;
}

static rot_status rhs(double t, const double y[], double f[], void *ctx) {
  const double *w = y + OMEGA;
  rolling x;
  (void)t;
  const rot_status status = find(ctx, y, &x);
  if (status != ROT_OK) return status;
  f[0] = 0.5 * (-w[0] * y[1] - w[1] * y[2] - w[2] * y[3]);
  f[1] = 0.5 * (w[0] * y[0] + w[1] * y[3] - w[2] * y[2]);
  f[2] = 0.5 * (w[1] * y[0] + w[2] * y[1] - w[0] * y[3]);
  f[3] = 0.5 * (w[2] * y[0] + w[0] * y[2] - w[1] * y[1]);
  for (int k = 0; k < 3; k++) f[OMEGA + k] = x.omega_rate[k];
  f[PLACE] = x.v[0];
  f[PLACE + 1] = x.v[1];
  return ROT_OK;
}

static void renormalise(double t, double y[], void *ctx) {
  (void)t, (void)ctx;
  (void)rot_attitude_unit(y);
}

/* Event: zero where |sin(lean)| = |e_z| reaches ROT_ROLLING_DISK_FLAT. */
static double above_flat(double t, const double y[], void *ctx) {
  const double up = (y[0] - y[1]) * (y[0] + y[1]) + (y[3] - y[2]) * (y[3] + y[2]);
  (void)t, (void)ctx;
  return ROT_ROLLING_DISK_FLAT - fabs(up);
}

static rot_ode_then end_flat(double t, double y[], int *mode, int forward, void *ctx) {
  (void)t, (void)y, (void)mode, (void)forward, (void)ctx;
  return ROT_ODE_END;
}

/* state y => row i of all columns */
static void write_row(const rot_rolling_disk *p, const double y[], size_t i,
                      const rot_rolling_disk_columns *out) {
  const double *w = y + OMEGA, m = p->mass_kg, r = p->radius_m, g = p->gravity_m_per_s2;
  rolling x;
  (void)find(p, y, &x);
  const double s = hypot(x.e[0], x.e[1]), we = rot_dot(w, x.e);
  out->x_m[i] = y[PLACE];
  out->y_m[i] = y[PLACE + 1];
  out->z_m[i] = r * s;
  out->contact_x_m[i] = y[PLACE] - r * x.d[0];
  out->contact_y_m[i] = y[PLACE + 1] - r * x.d[1];
  out->qw[i] = y[0];
  out->qx[i] = y[1];
  out->qy[i] = y[2];
  out->qz[i] = y[3];
  out->omega_space_x_rad_per_s[i] = w[0];
  out->omega_space_y_rad_per_s[i] = w[1];
  out->omega_space_z_rad_per_s[i] = w[2];
  out->lean_rad[i] = atan2(x.e[2], s);
  out->kinetic_energy_j[i] =
      0.5 * m * rot_dot(x.v, x.v) +
      0.5 * m * r * r * (p->transverse * (rot_dot(w, w) - we * we) + p->axial * we * we);
  out->potential_energy_j[i] = m * g * r * s;
  out->normal_n[i] = m * (g + x.a[2]);
  out->friction_needed[i] = hypot(x.a[0], x.a[1]) / (g + x.a[2]);
}

rot_status rot_rolling_disk_run(const rot_rolling_disk *p, double accuracy, size_t n,
                                const double time_s[], const rot_rolling_disk_columns *out,
                                double error[3], double *flat_s, const rot_hooks *hooks,
                                rot_info *info) {
  static const rot_ode_group groups[] = {{0, 4, ROT_ODE_QUATERNION}, {OMEGA, 3, ROT_ODE_VECTOR}};
  static const rot_ode_event flat = {
      .g = above_flat, .direction = 0, .name = ROT_EVENT_LOWEST, .then = end_flat};
  const double half = 0.5 * (p->lean_rad - 0.5 * 3.14159265358979323846);
  double start[DIM] = {cos(half), sin(half)}, errors[DIM] = {0.0}, largest[DIM] = {0.0};
  rot_events events = {0};
  rot_rolling_disk own = *p;
  start[OMEGA] = p->lean_rad_per_s;
  start[OMEGA + 1] = p->spin_rad_per_s * cos(p->lean_rad);
  start[OMEGA + 2] = p->spin_rad_per_s * sin(p->lean_rad) + p->yaw_rad_per_s;
  const rot_ode_params ode = {.dim = DIM,
                              .controlled = STATE,
                              .n_groups = 2,
                              .groups = groups,
                              .rhs = rhs,
                              .ctx = &own,
                              .start = start,
                              .accuracy = accuracy,
                              .max_steps = 1000000,
                              .fades_s = INFINITY,
                              .method = ROT_METHOD_RK8PD,
                              .n_events = 1,
                              .events = &flat,
                              .log = &events,
                              .project = renormalise};
  double *y = malloc((n ? n : 1) * DIM * sizeof *y);
  rot_info_clear(info, NULL);
  *flat_s = NAN;
  if (!y) return info->status = ROT_ENOMEM;
  const rot_status status = rot_ode_run(&ode, n, time_s, y, NULL, errors, largest, hooks, info);
  for (size_t i = 0; i < info->rows_done && i < n; i++) write_row(p, y + i * DIM, i, out);
  error[0] = errors[0];
  error[1] = largest[1] > 0.0 ? errors[1] / largest[1] : 0.0;
  /* The effect of rounding on the heading, some eps of the angle turned, is common to both runs. */
  const double time = n ? fmax(fabs(time_s[0]), fabs(time_s[n - 1])) : 0.0;
  const double angle = largest[1] * time;
  error[2] = hypot(errors[2], errors[3]) + 4.0 * ROT_EPS * p->radius_m * angle * (1.0 + angle);
  if (events.count) *flat_s = events.time_s[events.count - 1];
  rot_events_free(&events);
  free(y);
  return status;
}

double rot_rolling_disk_min(const rot_rolling_disk *p) {
  return sqrt(p->gravity_m_per_s2 / p->radius_m * p->transverse / (p->axial * (p->axial + 1.0)));
}
