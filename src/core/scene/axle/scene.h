/* The torques and moments of inertia of an axle:
 *
 *   d(I(t) omega)/dt = knots(t) + sum of terms(t, theta, omega) - motor omega + resistance,
 *   resistance = -c omega - q omega |omega| - tau_c sign(omega)   while it turns,
 *
 * and at rest it stays at rest while the other torques are at most tau_s. */
#ifndef ROT_AXLE_SCENE_H
#define ROT_AXLE_SCENE_H

#include "scene/axle/axle.h"
#include "engine/events.h"
#include "engine/term.h"

typedef struct rot_axle_scene {
  /* The linear part: inertia at the start, state at the start, knots (or a call). Its viscous_n_m_s
   * is the sum of the next two, for rot_axle_step(). */
  rot_axle_params linear;
  double inertia_lo;    /* what its inertia lacks, where it is computed: for long times */
  double viscous_n_m_s; /* of the resistance, any sign */
  double motor_n_m_s;   /* how steeply a motor's torque falls with omega: stall / no-load speed */
  double quadratic_n_m_s2, coulomb_n_m, static_n_m; /* >= 0, static >= coulomb */
  size_t n_terms;
  const rot_term *terms;
  size_t n_inertia; /* knots of I(t), straight between them, held outside; 0: constant */
  const double *inertia_time_s, *inertia_kg_m2;
  size_t n_breaks; /* times where a torque or I(t) jumps or kinks, increasing */
  const double *breaks_s;
  double noise_n_m; /* how far the terms may be off: the integrator looks for no more digits */
} rot_axle_scene;

/* A model of the scene: rows at the times (finite, not decreasing), events in their order. On
 * failure the first info->rows_done rows are good. */
typedef rot_status rot_axle_run(const rot_axle_scene *scene, size_t n, const double time_s[],
                                const rot_axle_columns *out, rot_events *events,
                                const rot_hooks *hooks, rot_info *info);
typedef rot_axle_run *rot_axle_model;

/* All breaks of a scene, increasing: knots, terms, I(t), and the scene's own list of others. They
 * go to out[], which has room for rot_axle_scene_room(); returns how many there are. */
size_t rot_axle_scene_room(const rot_axle_scene *scene);
size_t rot_axle_scene_breaks(const rot_axle_scene *scene, double out[]);

/* Knots + terms - motor omega; not the call, which may fail. */
double rot_axle_scene_applied(const rot_axle_scene *scene, double t, double theta, double theta_lo,
                              double omega);
double rot_axle_scene_inertia(const rot_axle_scene *scene, double t);
/* The resistance while it turns. */
double rot_axle_scene_resistance(const rot_axle_scene *scene, double omega);

/* Row i. `stuck`: it is held at rest, and the resistance balances what is applied. */
void rot_axle_scene_row(const rot_axle_scene *scene, const rot_axle_columns *out, size_t i,
                        double t, double theta, double omega, double applied, int stuck);

/* Whether dry friction holds it at rest against the torque applied. */
int rot_axle_scene_sticks(const rot_axle_scene *scene, double omega, double applied);

/* The torques that act in n states, the call left out. At rest, friction holds the body or opposes
 * its breaking loose. */
void rot_axle_scene_torques(const rot_axle_scene *scene, size_t n, const double time_s[],
                            const double theta_rad[], const double omega_rad_per_s[],
                            double applied_n_m[], double damping_n_m[], double net_n_m[]);

/* Numbers so small that no column can leave the range of doubles where the state does not. */
int rot_axle_scene_plain(const rot_axle_scene *scene, const rot_info *info);

#endif
