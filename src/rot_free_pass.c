/* The kernel for registers of four (rot_wide.h). */
#include "rot_wide.h"

#ifdef ROT_WIDE_CAN
#define ROT_WIDE
#define ROT_WIDE_FMA
#endif

#include "rot_free_pass.h"

ROT_TARGET void rot_free_pass_wide(rot_free_block *x) { rot_free_pass(x); }
