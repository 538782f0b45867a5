/* Registers of four doubles, where processor and compiler have them (AVX2). A kernel that is
 * written with ground/pair.h is compiled for two doubles by the file that calls it, and for four by
 * a file of its own: one that defines ROT_WIDE under ROT_WIDE_CAN before it includes the kernel.
 * The operations are the same lane by lane, and so are the bits. */
#ifndef ROT_SIMD_H
#define ROT_SIMD_H

#include "ground/ieee.h"

/* On Windows the stack is not aligned for registers of four. */
#if defined(__GNUC__) && defined(__x86_64__) && defined(__SSE2__) && !defined(_WIN32)
#define ROT_SIMD_CAN
#endif

enum { ROT_SIMD_PAIR = 4 };

/* Whether kernels for registers of four may be called. */
int rot_simd_ok(void);
/* The same for kernels that also call fused multiply-adds (ROT_WIDE_FMA). */
int rot_simd_fma_ok(void);
/* For tests: 0 forbids them, 1 allows them where they can run. */
void rot_simd_allow(int allowed);

#endif
