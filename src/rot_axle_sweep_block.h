/* A block of axles side by side, on their way through the pieces of one torque law. */
#ifndef ROT_AXLE_SWEEP_BLOCK_H
#define ROT_AXLE_SWEEP_BLOCK_H

#include "rot_torque.h"

enum { ROT_AXLE_SWEEP_BLOCK = 32 };

typedef struct rot_axle_sweep_block {
  double c[ROT_AXLE_SWEEP_BLOCK], inverse[ROT_AXLE_SWEEP_BLOCK],
      lambda[ROT_AXLE_SWEEP_BLOCK]; /* c, 1/I, c/I */
  double scale[ROT_AXLE_SWEEP_BLOCK], end_s[ROT_AXLE_SWEEP_BLOCK];
  double time_s[ROT_AXLE_SWEEP_BLOCK], theta[ROT_AXLE_SWEEP_BLOCK], omega[ROT_AXLE_SWEEP_BLOCK];
  double theta_error[ROT_AXLE_SWEEP_BLOCK], omega_error[ROT_AXLE_SWEEP_BLOCK];
  double omega_max[ROT_AXLE_SWEEP_BLOCK], omega_max_time_s[ROT_AXLE_SWEEP_BLOCK],
      omega_min[ROT_AXLE_SWEEP_BLOCK], theta_max[ROT_AXLE_SWEEP_BLOCK],
      worst_error[ROT_AXLE_SWEEP_BLOCK]; /* on the way; of omega */
} rot_axle_sweep_block;

#endif
