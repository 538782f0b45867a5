/* What flows in the motion of a body on an axle: work, heat by what takes it, angular impulse. */
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
  X(DAMPING, damping_impulse_n_m_s) /* of the resistance, at rest too */                           \
  X(INERTIA, inertia_work_j) /* of what changes the inertia: -1/2 dI/dt omega^2, integrated */

enum {
#define X(code, name) ROT_AXLE_FLOW_##code,
  ROT_AXLE_FLOW_LIST(X)
#undef X
      ROT_AXLE_FLOWS
};

extern const char *const rot_axle_flow_names[ROT_AXLE_FLOWS];

/* As rot_rows.flow and .flow_error. */
typedef struct rot_axle_flows {
  double *const *value;
  double *error;
} rot_axle_flows;

/* The body at rest in its gears: what they take, as numbers of the torque that acts. */
typedef struct rot_axle_gears {
  double applied_n_m, forward_n_m, backward_n_m; /* of the shafts; loss from rest, both ways */
  double bearings_n_m_s, min_n_m_s;              /* resistance of the shafts; the least of all */
} rot_axle_gears;

/* A motion by a closed form, and the scene whose torques count: that one, or one with more
 * effects. */
typedef struct rot_axle_motion {
  const rot_axle_scene *solved, *acts;
  rot_axle_model closed;
  const rot_events *events;
  const rot_info *info;
} rot_axle_motion;

/* From the first row on, by quadrature; a piecewise-linear motion by its closed form. */
rot_status rot_axle_flows_of(const rot_axle_motion *motion, size_t n, const double time_s[],
                             const rot_axle_flows *flows, const rot_hooks *hooks);

/* Where the inertia jumps at a row, the row is after it; an integrator that came to the row from
 * before did not count it. `momentum`: of each row. */
void rot_axle_flows_jumps(const rot_axle_scene *scene, size_t n, const double time_s[],
                          const double momentum[], const rot_axle_flows *flows);

/* The flows of the torque that stands for gears as those of the shafts: their torques work, the
 * bearings and meshes take the rest. */
void rot_axle_flows_geared(const rot_axle_scene *scene, const rot_axle_gears *gears, size_t n,
                           const double time_s[], const double theta_rad[],
                           const rot_axle_flows *flows);

#endif
