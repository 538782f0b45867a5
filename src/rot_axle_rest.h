/* What the marching models with friction share: the state from which rows are computed, with its
 * time to twice the precision, and what happens where omega is zero:
 *
 *   |applied| <= tau_s: held;   else it leaves in the torque's direction. */
#ifndef ROT_AXLE_REST_H
#define ROT_AXLE_REST_H

#include "rot_axle_scene.h"

typedef struct rot_axle_base {
  double time_s, time_lo, theta, theta_lo, omega;
  double theta_error, omega_error; /* bounds */
  int heading;                     /* sign of the last motion; 0: none yet */
  int stuck;
  double settle_s; /* at rest: how uncertain the time of the stop is */
} rot_axle_base;

typedef struct rot_axle_march {
  const rot_axle_scene *scene;
  size_t n, done; /* rows, and how many are filled */
  const double *time_s;
  const rot_axle_columns *out;
  rot_events *events;
  const rot_hooks *hooks;
  rot_info *info;
  rot_axle_base base;
  int endless; /* march on without rows, until nothing more happens */
} rot_axle_march;

/* At the start of the scene. ROT_EVALUE where a row lies before it: friction runs forward only. */
rot_status rot_axle_march_begin(rot_axle_march *march);
/* Time from the base to t, to twice the precision; not below 0. */
double rot_axle_march_elapsed(const rot_axle_march *march, double t, double *lo);
/* Is there a row before `end_s`, or only an endless way? */
int rot_axle_march_row_before(const rot_axle_march *march, double end_s);
/* The last time that matters: the last row's, or Inf. */
double rot_axle_march_horizon(const rot_axle_march *march);

/* Write the next row, at its time. */
rot_status rot_axle_march_row(rot_axle_march *march, double theta, double omega, double applied,
                              double theta_error, double omega_error);
/* Rows at rest before `end_s`; the base moves there. */
rot_status rot_axle_march_held(rot_axle_march *march, double end_s);
/* Move the base: by dtheta to `omega` at a time, with the errors there. */
rot_status rot_axle_march_move(rot_axle_march *march, double time_s, double time_lo, double dtheta,
                               double omega, double theta_error, double omega_error);
/* The base is at rest and `applied` acts: *leaves is 0 where it is held, else the direction. Logs
 * what happens. */
rot_status rot_axle_march_rest(rot_axle_march *march, double applied, int *leaves);
/* Call once for each piece or event: counts steps and polls. */
rot_status rot_axle_march_step(rot_axle_march *march);

#endif
