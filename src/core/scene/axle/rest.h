/* Shared by the models with friction: the base from which rows are computed (time in twice the
 * precision), its piece of the torque, and the decision at omega = 0:
 *
 *   |applied| <= tau_s: held;   else: breaks loose in the direction of the torque.
 *
 * A model moves from base to base in segments: one motion, or one hold, in one piece. */
#ifndef ROT_AXLE_REST_H
#define ROT_AXLE_REST_H

#include "scene/axle/scene.h"

typedef struct rot_axle_base {
  double time_s, time_lo, theta, theta_lo; /* in twice the precision */
  double omega;
  double theta_error, omega_error; /* bounds */
  int heading;                     /* sign of the last motion; 0: none yet */
  int stuck;                       /* 1: held at rest */
  double settle_s;                 /* at rest: error of the time of the stop */
} rot_axle_base;

typedef struct rot_axle_rest {
  const rot_axle_scene *scene;
  const double *time_s;
  const rot_axle_columns *out;
  rot_events *events;
  rot_info *info;
  double last_s; /* time of the last row; Inf: no rows */
  rot_axle_base base;
  size_t index; /* of the piece */
  rot_torque_piece piece;
} rot_axle_rest;

/* (scene, times) => base at the start, *info cleared; n may be 0. */
rot_axle_rest rot_axle_rest_from(const rot_axle_scene *scene, size_t n, const double time_s[],
                                 const rot_axle_columns *out, rot_events *events, rot_info *info);
/* base => its piece. Returns 1 if the piece is a new one, else 0. */
int rot_axle_rest_enter(rot_axle_rest *rest);
/* t => time since the base in twice the precision; >= 0. */
double rot_axle_rest_elapsed(const rot_axle_rest *rest, double t, double *lo);

/* A motion from the base. */
typedef struct rot_axle_change {
  double dtheta;                   /* angle turned */
  double omega;                    /* at its end */
  double theta_error, omega_error; /* bounds at its end */
} rot_axle_change;

/* (motion from the base, applied torque) => row i. */
rot_status rot_axle_rest_row(rot_axle_rest *rest, size_t i, const rot_axle_change *by,
                             double applied);
/* base at rest => row i. */
rot_status rot_axle_rest_held_row(rot_axle_rest *rest, size_t i);

/* (motion, its end time) => base at its end. */
rot_status rot_axle_rest_move(rot_axle_rest *rest, double time_s, double time_lo,
                              const rot_axle_change *by);
/* end time of a hold => base at that time. */
void rot_axle_rest_hold(rot_axle_rest *rest, double end_s);
/* (base at rest, applied torque) => *leaves: 0: held, else the direction; events. */
rot_status rot_axle_rest_decide(rot_axle_rest *rest, double applied, int *leaves);

#endif
