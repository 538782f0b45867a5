/* An exact model of the axle that knows one piece of time at a time, and its state at a base in it:
 * all its rows. */
#ifndef ROT_AXLE_PIECES_H
#define ROT_AXLE_PIECES_H

#include "scene/axle/scene.h"

typedef struct rot_axle_point {
  double theta_rad, omega_rad_per_s;
  double theta_error, omega_error; /* bounds */
  double theta_lo;                 /* what theta lacks, or 0: for the torque after many turns */
} rot_axle_point;

typedef struct rot_axle_pieces {
  /* Base and piece at start_s, to travel forward or backward from there. */
  void (*restart)(void *model, int forward);
  /* Where the piece ends in the direction of travel; an infinity if it does not. */
  double (*piece_end)(const void *model);
  /* Base to the end of the piece, and on to the next piece. */
  void (*next_piece)(void *model, rot_axle_point *at_end);
  /* State at a time of the piece. */
  void (*state_at)(const void *model, double time_s, rot_axle_point *state);
} rot_axle_pieces;

rot_status rot_axle_by_pieces(const rot_axle_scene *scene, const rot_axle_pieces *pieces,
                              void *model, size_t n, const double time_s[],
                              const rot_axle_columns *out, const rot_hooks *hooks, rot_info *info);

#endif
