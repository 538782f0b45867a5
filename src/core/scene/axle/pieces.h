/* Rows of an exact model of the axle that treats one piece of time at a time, from a base state in
 * it. */
#ifndef ROT_AXLE_PIECES_H
#define ROT_AXLE_PIECES_H

#include "scene/axle/scene.h"

typedef struct rot_axle_point {
  double theta_rad, omega_rad_per_s;
  double theta_error, omega_error; /* bounds */
  double theta_lo;                 /* low part of theta, or 0: for the torque after many turns */
} rot_axle_point;

typedef struct rot_axle_pieces {
  /* => base and piece at start_s, for stepping forward or backward in time. */
  void (*restart)(void *model, int forward);
  /* => end of the piece in the direction of stepping; +-Inf: none. */
  double (*piece_end)(const void *model);
  /* => base at the end of the piece, next piece. */
  void (*next_piece)(void *model, rot_axle_point *at_end);
  /* time in the piece => state. */
  void (*state_at)(const void *model, double time_s, rot_axle_point *state);
} rot_axle_pieces;

/* (model, times) => rows, bounds of the errors in *info. */
rot_status rot_axle_by_pieces(const rot_axle_scene *scene, const rot_axle_pieces *pieces,
                              void *model, size_t n, const double time_s[],
                              const rot_axle_columns *out, const rot_hooks *hooks, rot_info *info);

#endif
