/* The kernel for registers of four lanes (ground/simd.h). */
#include "ground/simd.h"

#ifdef ROT_SIMD_CAN
#define ROT_SIMD
#endif

#include "scene/axle/sweep_kernel.h"

ROT_TARGET void rot_axle_sweep_pass_simd(rot_axle_sweep_block *block, const rot_torque_piece *piece,
                                         double start_n_m) {
  pass_block(block, piece, start_n_m);
}
