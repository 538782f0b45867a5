/* A torque law as data, with its breakpoints. */
#ifndef ROT_TORQUE_H
#define ROT_TORQUE_H

#include <stddef.h>

#include "ground/status.h"

/* A law that only the caller can evaluate; anything but ROT_OK stops the run. */
typedef rot_status (*rot_torque_fn)(double time_s, double theta_rad, double omega_rad_per_s,
                                    double *torque_n_m, void *ctx);

/* Piecewise linear between n knots (times not decreasing; a repeated time is a jump), `before` the
 * first and `after` the last. A constant has no knot. Where `call` is set it is the law, and the
 * knots' times are its breakpoints. */
typedef struct rot_torque {
  size_t n;
  const double *time_s, *torque_n_m;
  double before_n_m, after_n_m;
  rot_torque_fn call;
  void *ctx;
} rot_torque;

/* One linear piece: torque start_n_m at start_s to end_n_m at end_s; the outer two are constant and
 * reach to -Inf and +Inf. */
typedef struct rot_torque_piece {
  double start_s, end_s, start_n_m, end_n_m;
} rot_torque_piece;

/* Piece i of n + 1: piece 0 lies before the first knot, piece n after the last. */
rot_torque_piece rot_torque_piece_at(const rot_torque *torque, size_t i);

/* The piece that holds the time just after t (forward) or just before it. */
size_t rot_torque_find(const rot_torque *torque, double t, int forward);

/* Torque of a piece at a time inside it: 3 ulp, also where it crosses zero, down to 1e-32 of the
 * larger end. */
double rot_torque_in_piece(const rot_torque_piece *piece, double t);

/* Torque of the knots at any time: after the jump at a jump, the last knot's at the last knot. */
double rot_torque_at(const rot_torque *torque, double t);

#endif
