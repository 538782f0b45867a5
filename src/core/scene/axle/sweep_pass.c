/* The kernel for registers of four (ground/wide.h). */
#include "ground/wide.h"

#ifdef ROT_WIDE_CAN
#define ROT_WIDE
#endif

#include "scene/axle/sweep_pass.h"

ROT_TARGET void rot_axle_sweep_pass_wide(rot_axle_sweep_block *block, const rot_torque_piece *piece,
                                         double start_n_m) {
  pass_block(block, piece, start_n_m);
}
