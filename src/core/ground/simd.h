/* Registers of four doubles (AVX2), if processor and compiler support them. A kernel written with
 * ground/pair.h is compiled twice: for two doubles in the file that calls it, for four in a
 * separate file that defines ROT_SIMD under ROT_SIMD_CAN before it includes the kernel. Each lane
 * has the same operations, and so the same bits. */
#ifndef ROT_SIMD_H
#define ROT_SIMD_H

#include "ground/ieee.h"

/* On Windows the stack is not aligned for registers of four. */
#if defined(__GNUC__) && defined(__x86_64__) && defined(__SSE2__) && !defined(_WIN32)
#define ROT_SIMD_CAN
#endif

enum { ROT_SIMD_PAIR = 4 };

/* 1 if kernels for registers of four may be called. */
int rot_simd_ok(void);
/* 1 if kernels that also use fused multiply-adds (ROT_SIMD_FMA) may be called. */
int rot_simd_fma_ok(void);
/* For tests: 0 forbids both kinds, 1 allows them where they can run. */
void rot_simd_allow(int allowed);

#endif
