/* state of a drive => torques, accelerations, torques of contacts. */
#ifndef ROT_DRIVE_FORCES_H
#define ROT_DRIVE_FORCES_H

#include "scene/drive/system.h"

/* scene => system with its memory. ROT_OK or ROT_ENOMEM. */
rot_status rot_drive_system_new(rot_drive_system *s, const rot_drive_scene *scene);
/* Frees the memory of the system. */
void rot_drive_system_free(rot_drive_system *s);

/* system => state at the start of the scene. */
void rot_drive_start(const rot_drive_system *s, double y[]);

/* (t, state, modes) => torques, accelerations, capacities, weakest contact in *s. Returns the
 * status of a law. */
rot_status rot_drive_forces(rot_drive_system *s, double t, const double y[],
                            const signed char mode[]);

/* (state, rotor i) => omega. */
static inline double rot_drive_omega(const rot_drive_system *s, const double y[], size_t i) {
  return s->fraction[i] * y[s->m + s->unit_of[i]];
}
/* contact => rate of its slip speed, after rot_drive_forces(). */
double rot_drive_slip_rate(const rot_drive_system *s, size_t contact);

#endif
