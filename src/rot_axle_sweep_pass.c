/* The kernel for registers of four (rot_wide.h). */
#include "rot_wide.h"

#ifdef ROT_WIDE_CAN
#define ROT_WIDE
#endif

#include "rot_axle_sweep_pass.h"

ROT_TARGET void rot_axle_sweep_pass_wide(rot_axle_sweep_block *block, const rot_torque_piece *piece,
                                         double start_n_m) {
  pass_block(block, piece, start_n_m);
}
