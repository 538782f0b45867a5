#include "rot_axle_ode.h"

#include <math.h>
#include <stdlib.h>

#include "rot_ode.h"

enum { THETA, OMEGA, WORK, HEAT, IMPULSE, DIM };

static rot_status torque_now(const rot_axle_params *p, double t, double theta, double omega,
                             double *torque) {
  if (p->torque.call) return p->torque.call(t, theta, omega, torque, p->torque.ctx);
  *torque = rot_torque_at(&p->torque, t);
  return ROT_OK;
}

static rot_status axle_rhs(double t, const double y[], double dydt[], void *ctx) {
  const rot_axle_params *p = ctx;
  double torque, omega = y[OMEGA];
  rot_status status = torque_now(p, t, y[THETA], omega, &torque);
  if (status != ROT_OK) return status;
  dydt[THETA] = omega;
  dydt[OMEGA] = (torque - p->viscous_n_m_s * omega) / p->inertia_kg_m2;
  dydt[WORK] = torque * omega;
  dydt[HEAT] = p->viscous_n_m_s * omega * omega;
  dydt[IMPULSE] = torque;
  return ROT_OK;
}

static rot_status fill_columns(const rot_axle_params *p, size_t n, const double time_s[],
                               const double y[], const rot_axle_columns *out, rot_info *info) {
  const size_t reached = info->rows_done;
  info->rows_done = 0;
  for (size_t i = 0; i < n && i < reached; i++) {
    const double theta = y[i * DIM + THETA], omega = y[i * DIM + OMEGA];
    double torque;
    rot_status status = torque_now(p, time_s[i], theta, omega, &torque);
    info->rhs_calls++;
    if (status == ROT_OK && !isfinite(torque)) status = ROT_ETORQUE;
    if (status != ROT_OK) {
      info->time_s = time_s[i];
      return status;
    }
    rot_axle_row(p, out, i, theta, omega, torque);
    info->rows_done = i + 1;
  }
  return ROT_OK;
}

rot_status rot_axle_integrate(const rot_axle_params *p, const rot_axle_ode_options *options,
                              size_t n, const double time_s[], const rot_axle_columns *out,
                              rot_axle_ledger *ledger, const rot_hooks *hooks, rot_info *info) {
  const double start[DIM] = {p->theta0_rad, p->omega0_rad_per_s, 0.0, 0.0, 0.0};
  double error[DIM] = {0.0}, largest[DIM] = {0.0};
  rot_ode_params ode = {DIM,
                        2,
                        axle_rhs,
                        NULL,
                        p->torque.n,
                        p->torque.time_s,
                        p->start_s,
                        start,
                        options->accuracy,
                        options->max_steps};
  rot_axle_params law = *p; /* the hook wants a pointer it may write through */
  double *y = malloc((n ? n : 1) * DIM * sizeof *y);
  ode.ctx = &law;
  rot_info_clear(info);
  if (!y) return info->status = ROT_ENOMEM;

  rot_status failure = rot_ode_run(&ode, n, time_s, y, error, largest, hooks, info);
  if (failure != ROT_EUNWIND) {
    rot_status columns = fill_columns(p, n, time_s, y, out, info);
    if (columns != ROT_OK) failure = columns;
  }
  info->status = failure;
  info->theta_error = error[THETA];
  info->omega_error = error[OMEGA];
  info->theta_max = largest[THETA];
  info->omega_max = largest[OMEGA];
  if (info->rows_done > 0) {
    const double *first = y, *last = y + (info->rows_done - 1) * DIM;
    ledger->work_j = last[WORK] - first[WORK];
    ledger->dissipated_j = last[HEAT] - first[HEAT];
    ledger->impulse_n_m_s = last[IMPULSE] - first[IMPULSE];
    ledger->work_rounding_j = 2.0 * error[WORK];
    ledger->dissipated_rounding_j = 2.0 * error[HEAT];
    ledger->impulse_rounding_n_m_s = 2.0 * error[IMPULSE];
  }
  free(y);
  return failure;
}
