/* Closed forms of a drive: its units (scene/drive/units.h) as a body on an axle (gears only), as
 * two bodies with a clutch, or as rotors on a shaft. */
#ifndef ROT_DRIVE_EXACT_H
#define ROT_DRIVE_EXACT_H

#include "engine/model.h"
#include "scene/drive/ode.h"

typedef enum rot_drive_form {
  ROT_DRIVE_AS_AXLE,
  ROT_DRIVE_AS_CLUTCH,
  ROT_DRIVE_AS_SHAFT,
  ROT_DRIVE_FORMS
} rot_drive_form;

/* (scene, form) => NULL, or why the form does not apply. */
const char *rot_drive_exact_why_not(const rot_drive_scene *scene, rot_drive_form form,
                                    const rot_query *query);

/* (scene, form that applies, times) => rows, as rot_drive_integrate(). ledger: integrals by
 * quadrature of the motion; NULL: none. */
rot_status rot_drive_exact(const rot_drive_scene *scene, rot_drive_form form, size_t n,
                           const double time_s[], const rot_drive_columns *out,
                           rot_drive_ledger *ledger, rot_events *events, const rot_hooks *hooks,
                           rot_info *info);

#endif
