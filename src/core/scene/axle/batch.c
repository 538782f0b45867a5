#include "scene/axle/batch.h"

#include <string.h>

#include "scene/axle/sweep.h"

enum { INERTIA, VISCOUS, OMEGA0, THETA0 };
static const char *const inputs[] = {"body", "resistance$viscous_n_m_s", "omega0_rad_per_s",
                                     "theta0_rad", NULL};
static const char *const columns[] = {"theta_rad", "omega_rad_per_s", NULL};

static int takes(const void *of) {
  const rot_axle_scene *scene = of;
  return scene->inertia_lo == 0.0 && scene->motor_n_m_s == 0.0 && scene->n_terms == 0 &&
         scene->n_inertia == 0 && !scene->linear.torque.call;
}

static rot_status run(const void *of, const rot_batch_rows *rows) {
  static const double one = 1.0;
  const rot_axle_scene *scene = of;
  const rot_axle_params *p = &scene->linear;
  const rot_column inertia = rot_batch_input(rows, INERTIA, &p->inertia_kg_m2);
  const rot_column viscous = rot_batch_input(rows, VISCOUS, &scene->viscous_n_m_s);
  const rot_column omega0 = rot_batch_input(rows, OMEGA0, &p->omega0_rad_per_s);
  const rot_column theta0 = rot_batch_input(rows, THETA0, &p->theta0_rad);
  double unused[4][ROT_BATCH_ROWS];
  rot_info info;
  const rot_axle_sweep_rows some = {.n = rows->n,
                                    .start_s = p->start_s,
                                    .inertia_kg_m2 = inertia,
                                    .viscous_n_m_s = viscous,
                                    .torque_scale = {&one, 0},
                                    .omega0_rad_per_s = omega0,
                                    .theta0_rad = theta0,
                                    .time_s = rows->time_s};
  const rot_axle_sweep_columns out = {.theta_rad = rows->end[0],
                                      .omega_rad_per_s = rows->end[1],
                                      .omega_max = unused[0],
                                      .omega_max_time_s = unused[1],
                                      .omega_min = unused[2],
                                      .speed_max = unused[3],
                                      .error = rows->error,
                                      .status = rows->status};
  for (size_t i = 0; i < rows->n; i++) {
    rows->start[0][i] = rot_at(some.theta0_rad, i);
    rows->start[1][i] = rot_at(some.omega0_rad_per_s, i);
  }
  const rot_status status = rot_axle_sweep_linear(&p->torque, &some, 1, &out, NULL, &info);
  if (status != ROT_OK) return status;
  return ROT_OK;
}

const rot_batch rot_axle_batches[] = {{"axle_linear", inputs, columns, takes, run},
                                      {NULL, NULL, NULL, NULL, NULL}};
