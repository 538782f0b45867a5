/* The march of an exact model over its pieces: rows away from start_s, backward in time first, then
 * forward. The model knows one piece of time at a time and its state at a base in it. */
#ifndef ROT_AXLE_MARCH_H
#define ROT_AXLE_MARCH_H

#include "rot_axle_scene.h"

typedef struct rot_march_state {
  double theta_rad, omega_rad_per_s;
  double theta_error, omega_error; /* bounds */
} rot_march_state;

typedef struct rot_march {
  void *model;
  /* Base and piece at start_s, to travel forward or backward from there. */
  void (*restart)(void *model, int forward);
  /* Where the piece ends in the direction of travel; an infinity if it does not. */
  double (*piece_end)(const void *model);
  /* Base to the end of the piece, and on to the next piece. */
  void (*next_piece)(void *model, rot_march_state *at_end);
  /* State at a time of the piece. */
  void (*state_at)(const void *model, double time_s, rot_march_state *state);
} rot_march;

rot_status rot_axle_march(const rot_axle_scene *scene, const rot_march *march, size_t n,
                          const double time_s[], const rot_axle_columns *out,
                          const rot_hooks *hooks, rot_info *info);

#endif
