/* What the models with friction share: the base from which rows are computed, with its time to
 * twice the precision, the piece of the torque that it lies in, and what happens where omega is
 * zero:
 *
 *   |applied| <= tau_s: held;   else it leaves in the torque's direction.
 *
 * A model moves from base to base in segments: one motion, or one hold, inside one piece. */
#ifndef ROT_AXLE_REST_H
#define ROT_AXLE_REST_H

#include "scene/axle/scene.h"

typedef struct rot_axle_base {
  double time_s, time_lo, theta, theta_lo, omega;
  double theta_error, omega_error; /* bounds */
  int heading;                     /* sign of the last motion; 0: none yet */
  int stuck;
  double settle_s; /* at rest: error of the time of the stop */
} rot_axle_base;

typedef struct rot_axle_rest {
  const rot_axle_scene *scene;
  const double *time_s;
  const rot_axle_columns *out;
  rot_events *events;
  rot_info *info;
  double last_s; /* of the rows; Inf: there is none */
  rot_axle_base base;
  size_t index; /* of the piece */
  rot_torque_piece piece;
} rot_axle_rest;

/* At the start of the scene, the report of the run begun; n may be 0. */
rot_axle_rest rot_axle_rest_from(const rot_axle_scene *scene, size_t n, const double time_s[],
                                 const rot_axle_columns *out, rot_events *events, rot_info *info);
/* On to the piece that the base lies in, if it is not the present one; whether it was not. */
int rot_axle_rest_enter(rot_axle_rest *rest);
/* Time from the base to t, to twice the precision; not below 0. */
double rot_axle_rest_elapsed(const rot_axle_rest *rest, double t, double *lo);

/* A motion from the base: angle turned, omega after it, and the bounds there. */
typedef struct rot_axle_change {
  double dtheta, omega, theta_error, omega_error;
} rot_axle_change;

/* Row i: moving, or held. */
rot_status rot_axle_rest_row(rot_axle_rest *rest, size_t i, const rot_axle_change *by,
                             double applied);
rot_status rot_axle_rest_held_row(rot_axle_rest *rest, size_t i);

/* Move the base by a motion to a time; or, held, to a time. */
rot_status rot_axle_rest_move(rot_axle_rest *rest, double time_s, double time_lo,
                              const rot_axle_change *by);
void rot_axle_rest_hold(rot_axle_rest *rest, double end_s);
/* The base is at rest and `applied` acts: *leaves is 0 where it is held, else the direction. Logs
 * what happens. */
rot_status rot_axle_rest_decide(rot_axle_rest *rest, double applied, int *leaves);

#endif
