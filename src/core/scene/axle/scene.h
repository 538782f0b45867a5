/* Torques and moments of inertia of an axle:
 *
 *   d(I(t) omega)/dt = knots(t) + sum of terms(t, theta, omega) - motor omega + resistance,
 *   resistance = -c omega - q omega |omega| - tau_c sign(omega)   while it rotates.
 *
 * Static contact at rest: the other torques are at most tau_s. */
#ifndef ROT_AXLE_SCENE_H
#define ROT_AXLE_SCENE_H

#include "scene/axle/axle.h"
#include "engine/events.h"
#include "engine/term.h"

typedef struct rot_axle_scene {
  /* The linear part: inertia and state at the start, knots (or a call). linear.viscous_n_m_s is the
   * sum viscous_n_m_s + motor_n_m_s, for rot_axle_step(). */
  rot_axle_params linear;
  double inertia_lo;       /* low part of a computed inertia: for long times */
  double viscous_n_m_s;    /* of the resistance, any sign */
  double motor_n_m_s;      /* slope of the torque of a motor: stall torque over no-load speed */
  double quadratic_n_m_s2; /* >= 0 */
  double coulomb_n_m;      /* >= 0 */
  double static_n_m;       /* >= coulomb_n_m */
  size_t n_terms;
  const rot_term *terms;
  size_t n_inertia;             /* knots of I(t), linear between them, constant outside; 0: none */
  const double *inertia_time_s; /* n_inertia */
  const double *inertia_kg_m2;  /* n_inertia, > 0 */
  size_t n_breaks;              /* number of times at which a torque or I(t) jumps or kinks */
  const double *breaks_s;       /* increasing */
  double noise_n_m;             /* >= 0, error of the terms: limits the accuracy of integration */
} rot_axle_scene;

/* A model: (scene, times: finite, not decreasing) => rows, events, errors. After a failure the
 * first info->rows_done rows are valid. */
typedef rot_status rot_axle_run(const rot_axle_scene *scene, size_t n, const double time_s[],
                                const rot_axle_columns *out, rot_events *events,
                                const rot_hooks *hooks, rot_info *info);
typedef rot_axle_run *rot_axle_model;

/* scene => upper limit of the number of its breaks. */
size_t rot_axle_scene_room(const rot_axle_scene *scene);
/* scene => out[]: all breaks, increasing (knots, terms, I(t), other breaks of the scene); returns
 * their number. out[] has rot_axle_scene_room() places. */
size_t rot_axle_scene_breaks(const rot_axle_scene *scene, double out[]);

/* (scene, state) => knots + terms - motor omega, without the call, which may fail. */
double rot_axle_scene_applied(const rot_axle_scene *scene, double t, double theta, double theta_lo,
                              double omega);
/* (scene, time) => I(t). */
double rot_axle_scene_inertia(const rot_axle_scene *scene, double t);
/* (scene, omega) => resistance while rotating. */
double rot_axle_scene_resistance(const rot_axle_scene *scene, double omega);

/* (state, applied torque) => row i. stuck: held at rest, the resistance balances the applied
 * torque. */
void rot_axle_scene_row(const rot_axle_scene *scene, const rot_axle_columns *out, size_t i,
                        double t, double theta, double omega, double applied, int stuck);

/* The resistance has a kink or a jump at omega = 0: only there a body that turns round reverses. */
int rot_axle_kinks_at_rest(const rot_axle_scene *scene);
/* 1 if omega is 0 and dry friction holds the body against the applied torque, else 0. */
int rot_axle_scene_sticks(const rot_axle_scene *scene, double omega, double applied);

/* n states => torques without the call. At rest, friction holds the body or opposes breaking
 * loose. */
void rot_axle_scene_torques(const rot_axle_scene *scene, size_t n, const double time_s[],
                            const double theta_rad[], const double omega_rad_per_s[],
                            double applied_n_m[], double damping_n_m[], double net_n_m[]);

/* 1 if the numbers are so small that no column overflows unless the state does, else 0. */
int rot_axle_scene_plain(const rot_axle_scene *scene, const rot_info *info);

#endif
