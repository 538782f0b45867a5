/* The kernel for registers of four lanes (ground/simd.h). */
#include "ground/simd.h"

#ifdef ROT_SIMD_CAN
#define ROT_SIMD
#define ROT_SIMD_FMA
#endif

#include "scene/free/kernel.h"

ROT_TARGET void rot_free_pass_simd(rot_free_block *x) { rot_free_pass(x); }
