#include "scene/free/batch.h"

#include <math.h>

#include "ground/real.h"
#include "maths/attitude.h"
#include "scene/free/table.h"

enum { MOMENT, OMEGA0 = 3 };
static const char *const inputs[] = {"body[1]",
                                     "body[2]",
                                     "body[3]",
                                     "omega0_rad_per_s[1]",
                                     "omega0_rad_per_s[2]",
                                     "omega0_rad_per_s[3]",
                                     NULL};
enum { Q, OMEGA = 4, MOMENTUM = 7 };
static const char *const columns[] = {"qw",
                                      "qx",
                                      "qy",
                                      "qz",
                                      "omega_x_rad_per_s",
                                      "omega_y_rad_per_s",
                                      "omega_z_rad_per_s",
                                      "angular_momentum_x_kg_m2_per_s",
                                      "angular_momentum_y_kg_m2_per_s",
                                      "angular_momentum_z_kg_m2_per_s",
                                      NULL};

/* The kernel begins at time 0, with moments without error about the body's own axes. */
static int takes(const void *of) {
  const rot_free_params *p = of;
  return !p->turned && p->given == 0.0 && p->start_s == 0.0 && p->damping_per_s == 0.0;
}

/* The largest relative error of attitude, rates and angular momentum, as rot_free_note() has it. */
static double figure(const double moment[3], const double omega0[3], const double omega[3],
                     double angle_error, double omega_error) {
  double l[3], max = 0.0;
  for (int k = 0; k < 3; k++) {
    l[k] = moment[k] * omega[k];
    max = fmax(max, moment[k]);
  }
  const double size = rot_length(omega), momentum = rot_length(l);
  const double of_omega =
      rot_relative_error(omega_error + 4.0 * ROT_EPS * size, fmax(size, rot_length(omega0)));
  const double of_momentum =
      rot_relative_error(max * omega_error + momentum * (angle_error + 8.0 * ROT_EPS), momentum);
  return fmax(angle_error, fmax(of_omega, of_momentum));
}

/* Angular momentum in space of row i, from its attitude and rates. */
static void put_momentum(const double moment[3], double *const column[], size_t i) {
  double l[3], q[4], space[3];
  for (size_t k = 0; k < 4; k++) q[k] = column[Q + k][i];
  for (size_t k = 0; k < 3; k++) l[k] = moment[k] * column[OMEGA + k][i];
  rot_attitude_to_space(q, l, space);
  for (size_t k = 0; k < 3; k++) column[MOMENTUM + k][i] = space[k];
}

static rot_status run(const void *of, const rot_batch_rows *rows) {
  const rot_free_params *p = of;
  rot_column moment[3], omega0[3];
  for (size_t k = 0; k < 3; k++) {
    moment[k] = rot_batch_input(rows, MOMENT + k, &p->moment_kg_m2[k]);
    omega0[k] = rot_batch_input(rows, OMEGA0 + k, &p->omega0_rad_per_s[k]);
  }
  double omega_error[ROT_BATCH_ROWS];
  rot_info info;
  rot_free_table_rows some = {.n = rows->n, .time_s = rows->time_s};
  for (size_t k = 0; k < 3; k++) {
    some.moment_kg_m2[k] = moment[k];
    some.omega_rad_per_s[k] = omega0[k];
  }
  for (size_t k = 0; k < 4; k++) some.q[k] = (rot_column){&p->q0[k], 0};
  const rot_free_table_columns out = {.final_qw = rows->end[0],
                                      .final_qx = rows->end[1],
                                      .final_qy = rows->end[2],
                                      .final_qz = rows->end[3],
                                      .final_omega_x_rad_per_s = rows->end[4],
                                      .final_omega_y_rad_per_s = rows->end[5],
                                      .final_omega_z_rad_per_s = rows->end[6],
                                      .error = rows->error,
                                      .omega_error = omega_error};
  const rot_status status = rot_free_table(&some, 1, &out, NULL, &info);
  if (status != ROT_OK) return status;
  for (size_t i = 0; i < rows->n; i++) {
    double inertia[3], before[3], after[3];
    for (size_t k = 0; k < 3; k++) {
      inertia[k] = rot_at(some.moment_kg_m2[k], i);
      before[k] = rot_at(some.omega_rad_per_s[k], i);
      after[k] = rows->end[OMEGA + k][i];
      rows->start[OMEGA + k][i] = before[k];
    }
    for (size_t k = 0; k < 4; k++) rows->start[Q + k][i] = p->q0[k];
    put_momentum(inertia, rows->start, i);
    put_momentum(inertia, rows->end, i);
    rows->error[i] = figure(inertia, before, after, rows->error[i], omega_error[i]);
    /* No motion, or a body without moments, which the builder refuses: it says why. */
    const int good = isfinite(rows->error[i]) && inertia[0] + inertia[1] + inertia[2] > 0.0;
    rows->status[i] = good ? ROT_OK : ROT_EVALUE;
  }
  return ROT_OK;
}

const rot_batch rot_free_batches[] = {{"free_exact", inputs, columns, takes, run},
                                      {NULL, NULL, NULL, NULL, NULL}};
