/* A drive with anything that may act on it, integrated. Each contact sticks or slips in a segment;
 * slip speeds that reach zero, and loads that reach what a contact holds, are events. */
#ifndef ROT_DRIVE_ODE_H
#define ROT_DRIVE_ODE_H

#include "scene/drive/drive.h"

typedef struct rot_drive_ode_options {
  double accuracy; /* largest error wanted in theta and omega of any rotor, relative to the largest
                      of all */
  size_t max_steps;
  rot_method method; /* ROT_METHOD_NONE: choose */
  double resolution; /* of changes of a law that is called: see engine/ode/ode.h; 0: as there */
  double step_s;     /* of a method with steps of fixed length */
} rot_drive_ode_options;

/* Errors are estimates. Times before the start only where no contact may stick. */
rot_status rot_drive_integrate(const rot_drive_scene *scene, const rot_drive_ode_options *options,
                               size_t n, const double time_s[], const rot_drive_columns *out,
                               rot_drive_ledger *ledger, rot_events *events, const rot_hooks *hooks,
                               rot_info *info);

#endif
