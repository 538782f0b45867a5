/* The kernel for registers of four (ground/wide.h). */
#include "ground/wide.h"

#ifdef ROT_WIDE_CAN
#define ROT_WIDE
#define ROT_WIDE_FMA
#endif

#include "scene/free/pass.h"

ROT_TARGET void rot_free_pass_wide(rot_free_block *x) { rot_free_pass(x); }
