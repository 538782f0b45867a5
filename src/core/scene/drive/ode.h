/* Numerical integration of a drive with any loads. In a segment each contact sticks or slips.
 * Events: a slip speed reaches 0; a load reaches the capacity of a contact. */
#ifndef ROT_DRIVE_ODE_H
#define ROT_DRIVE_ODE_H

#include "scene/drive/drive.h"

typedef struct rot_drive_ode_options {
  double accuracy; /* requested error of theta and omega, relative to the largest of all rotors */
  size_t max_steps;
  rot_method method; /* ROT_METHOD_NONE: choose */
  double resolution; /* of changes of a law given as a function; 0: default (engine/ode/ode.h) */
  double step_s;     /* step of a fixed-step method */
} rot_drive_ode_options;

/* (scene, options, times) => rows, ledger, events, errors (estimates). Times before the start: only
 * if no contact may stick. */
rot_status rot_drive_integrate(const rot_drive_scene *scene, const rot_drive_ode_options *options,
                               size_t n, const double time_s[], const rot_drive_columns *out,
                               rot_drive_ledger *ledger, rot_events *events, const rot_hooks *hooks,
                               rot_info *info);

#endif
