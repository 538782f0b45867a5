/* Torques of a drive at a state, and the accelerations and torques of contacts that follow. */
#ifndef ROT_DRIVE_FORCES_H
#define ROT_DRIVE_FORCES_H

#include "scene/drive/system.h"

/* ROT_OK or ROT_ENOMEM. */
rot_status rot_drive_system_new(rot_drive_system *s, const rot_drive_scene *scene);
void rot_drive_system_free(rot_drive_system *s);

/* The state at the start of the scene. */
void rot_drive_start(const rot_drive_system *s, double y[]);

/* The status is that of a law. */
rot_status rot_drive_forces(rot_drive_system *s, double t, const double y[],
                            const signed char mode[]);

/* omega of a rotor; slip speed and its rate, of a contact. */
static inline double rot_drive_omega(const rot_drive_system *s, const double y[], size_t i) {
  return s->fraction[i] * y[s->m + s->unit_of[i]];
}
double rot_drive_slip_rate(const rot_drive_system *s, size_t contact);

#endif
