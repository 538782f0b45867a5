/* Flows of a body on an axle: work, heat by mechanism, angular impulse. */
#ifndef ROT_AXLE_FLOWS_H
#define ROT_AXLE_FLOWS_H

#include "scene/axle/scene.h"

/* code, name. Heat is computed separately, never as a difference. */
#define ROT_AXLE_FLOW_LIST(X)                                                                      \
  X(WORK, work_j) /* of the applied torque */                                                      \
  X(VISCOUS, viscous_j)                                                                            \
  X(QUADRATIC, quadratic_j)                                                                        \
  X(COULOMB, coulomb_j)                                                                            \
  X(IMPULSE, impulse_n_m_s)                                                                        \
  X(DAMPING, damping_impulse_n_m_s) /* of the resistance, also at rest */                          \
  X(INERTIA, inertia_work_j)        /* by changing the inertia: integral of -1/2 dI/dt omega^2 */

enum {
#define X(code, name) ROT_AXLE_FLOW_##code,
  ROT_AXLE_FLOW_LIST(X)
#undef X
      ROT_AXLE_FLOWS
};

extern const char *const rot_axle_flow_names[ROT_AXLE_FLOWS];

/* As rot_rows.flow and .flow_error. */
typedef struct rot_axle_flows {
  double *const *value; /* [flow][row] */
  double *error;        /* [flow] */
} rot_axle_flows;

/* Losses of a gear train, at its first shaft. */
typedef struct rot_axle_gears {
  double applied_n_m;               /* sum of the torques on the shafts */
  double forward_n_m, backward_n_m; /* torque lost in the meshes at rest, in both directions */
  double bearings_n_m_s;            /* viscous resistance of the shafts */
  double min_n_m_s;                 /* smallest slope of the total resistance */
} rot_axle_gears;

/* A motion by a closed form, and the scene whose torques count: the same, or one with more
 * effects. */
typedef struct rot_axle_motion {
  const rot_axle_scene *solved; /* of the closed form */
  const rot_axle_scene *acts;   /* of the torques */
  rot_axle_model closed;
  const rot_events *events;
  const rot_info *info;
} rot_axle_motion;

/* motion => flows since the first row, by quadrature; piecewise-linear motions by closed form. */
rot_status rot_axle_flows_of(const rot_axle_motion *motion, size_t n, const double time_s[],
                             const rot_axle_flows *flows, const rot_hooks *hooks);

/* Adds the work of inertia jumps at rows: a row is after the jump, but an integrator reaching the
 * row from before did not count it. momentum: of each row. */
void rot_axle_flows_jumps(const rot_axle_scene *scene, size_t n, const double time_s[],
                          const double momentum[], const rot_axle_flows *flows);

/* Flows of the torque that represents gears => flows of the shafts: work of their torques, heat of
 * bearings and meshes. */
void rot_axle_flows_geared(const rot_axle_scene *scene, const rot_axle_gears *gears, size_t n,
                           const double time_s[], const double theta_rad[],
                           const rot_axle_flows *flows);

#endif
