#include "scene/incline/batch.h"

#include <math.h>

#include "scene/incline/scene.h"
#include "scene/incline/table.h"

enum { ANGLE, STATIC, KINETIC, ARM, V0, OMEGA0 };
static const char *const inputs[] = {"incline_angle_deg",
                                     "static_friction",
                                     "kinetic_friction",
                                     "rolling_arm_m",
                                     "v0_m_per_s",
                                     "omega0_rad_per_s",
                                     NULL};
static const char *const columns[] = {"x_m", "v_m_per_s", "theta_rad", "omega_rad_per_s", NULL};

/* The kernel begins at the places 0 and at time 0. */
static int takes(const void *of) {
  const rot_incline_params *p = &((const rot_incline_scene *)of)->slope;
  return p->x0_m == 0.0 && p->theta0_rad == 0.0 && p->start_s == 0.0;
}

static rot_status run(const void *of, const rot_batch_rows *rows) {
  static const double rolls = NAN;
  const rot_incline_params *p = &((const rot_incline_scene *)of)->slope;
  const double beta = p->inertia_kg_m2 / p->mass_kg / p->radius_m / p->radius_m;
  const int has_omega = (int)(rows->given >> OMEGA0 & 1u);
  const rot_column still = rot_batch_input(rows, STATIC, &p->mu_static);
  /* Its default is that of static friction. */
  const rot_column slides =
      rows->given >> KINETIC & 1u ? rot_batch_input(rows, KINETIC, &p->mu_kinetic) : still;
  const rot_column omega0 =
      has_omega ? rot_batch_input(rows, OMEGA0, &p->omega0_rad_per_s) : (rot_column){&rolls, 0};
  const rot_column angle = rot_batch_input(rows, ANGLE, &p->angle_deg);
  const rot_column arm = rot_batch_input(rows, ARM, &p->arm_m);
  const rot_column v0 = rot_batch_input(rows, V0, &p->v0_m_per_s);
  double heat[2][ROT_BATCH_ROWS], roll_s[ROT_BATCH_ROWS];
  int rolling[ROT_BATCH_ROWS];
  rot_info info;
  const rot_incline_rows some = {.n = rows->n,
                                 .beta = {&beta, 0},
                                 .radius_m = {&p->radius_m, 0},
                                 .mass_kg = {&p->mass_kg, 0},
                                 .angle_deg = angle,
                                 .gravity_m_per_s2 = {&p->gravity_m_per_s2, 0},
                                 .mu_static = still,
                                 .mu_kinetic = slides,
                                 .arm_m = arm,
                                 .v0_m_per_s = v0,
                                 .omega0_rad_per_s = omega0,
                                 .time_s = rows->time_s};
  const rot_incline_table_columns out = {.final_x_m = rows->end[0],
                                         .final_v_m_per_s = rows->end[1],
                                         .final_theta_rad = rows->end[2],
                                         .final_omega_rad_per_s = rows->end[3],
                                         .slip_heat_j = heat[0],
                                         .rolling_heat_j = heat[1],
                                         .roll_time_s = roll_s,
                                         .rolling = rolling,
                                         .error = rows->error,
                                         .status = rows->status,
                                         .none = NAN};
  const rot_status status = rot_incline_table(&some, 1, &out, NULL, &info);
  if (status != ROT_OK) return status;
  for (size_t i = 0; i < rows->n; i++) {
    const double v = rot_at(some.v0_m_per_s, i), omega = rot_at(some.omega0_rad_per_s, i);
    rows->start[0][i] = rows->start[2][i] = 0.0;
    rows->start[1][i] = v;
    rows->start[3][i] = has_omega ? omega : v / p->radius_m;
    /* Where the builder may refuse, or a product left the range, the row is the model's. */
    if (isinf(rot_at(some.mu_kinetic, i)) || !isfinite(rows->start[3][i])) {
      rows->status[i] = ROT_EVALUE;
    }
  }
  return ROT_OK;
}

const rot_batch rot_incline_batches[] = {{"incline_exact", inputs, columns, takes, run},
                                         {NULL, NULL, NULL, NULL, NULL}};
