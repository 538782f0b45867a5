/* Balances of free bodies and bodies with a fixed point: energy, angular momentum about the centre
 * of mass or the fixed point, norm of the quaternion; their flows. */
#ifndef ROT_FREE_LEDGER_H
#define ROT_FREE_LEDGER_H

#include "engine/model.h"
#include "scene/free/free.h"

enum { ROT_FREE_KEPT = 4 }; /* balances except the last */

/* clang-format off */
/* Initialisers of the balances about a point and of their terms; with: effect of rotors. */
#define ROT_FREE_BALANCES_ABOUT(point)                                                             \
  {"energy", NULL, "J"}, {"angular_momentum_x", point, "kg m^2/s"},                                \
  {"angular_momentum_y", point, "kg m^2/s"}, {"angular_momentum_z", point, "kg m^2/s"},            \
  {"quaternion_norm", NULL, "1"}
#define ROT_FREE_MOMENTUM_TERMS(k)                                                                 \
  {k, ROT_CHANGE, "change of angular momentum", 0},                                                \
  {k, ROT_SUPPLIED, "impulse of the torque", 0}, {k, ROT_DISSIPATED, "impulse of the damping", 0}
#define ROT_FREE_TERMS_WITH(with)                                                                  \
  {0, ROT_CHANGE, "change of rotational energy", 0}, {0, ROT_SUPPLIED, "work of the torque", 0},   \
  {0, ROT_SUPPLIED, "work of the motors", with}, {0, ROT_DISSIPATED, "heat of the damping", 0},    \
  ROT_FREE_MOMENTUM_TERMS(1), ROT_FREE_MOMENTUM_TERMS(2), ROT_FREE_MOMENTUM_TERMS(3),              \
  {4, ROT_CHANGE, "change of the norm", 0}
/* clang-format on */

extern const char *const rot_free_flow_names[ROT_FREE_FLOWS];

/* rows of the closed form => rows->flow since the start, their errors. */
void rot_free_exact_flows(const rot_free_params *p, const rot_task *task, const rot_rows *rows);
/* The same of the gyrostat. */
void rot_free_gyrostat_flows(const rot_free_params *p, const rot_task *task, const rot_rows *rows,
                             const rot_info *info);

/* rot_constraint.audit: (two rows, flows) => terms of the balances. */
void rot_free_audit(const void *scene, const rot_span *span, double term[]);
/* rot_constraint.explain: (two rows, terms) => residuals explained by the errors. */
void rot_free_explain(const void *scene, const rot_span *span, const double term[],
                      double explained[]);
/* rot_constraint.conserved: balance => number of reasons against conservation, reasons. */
size_t rot_free_conserved(const void *scene, size_t balance, const char *why[]);
/* rot_constraint.time_scales: largest values of the measures => time scales. */
void rot_free_time_scales(const void *scene, const double sizes[], rot_time_scales *time_scales);

/* (parameters, axis k of the axes of the torque) => 1 if the torque has a component along it; k <
 * 0: along any axis. */
int rot_free_acts_along(const rot_free_params *p, int k);
/* parameters => 1 if motors do work; motors of driven rotors do. */
int rot_free_motors_work(const rot_free_params *p);

#endif
