#include "ground/simd.h"

static int forbidden = 0;

void rot_simd_allow(int allowed) { forbidden = !allowed; }

int rot_simd_ok(void) {
#ifdef ROT_SIMD_CAN
  return !forbidden && __builtin_cpu_supports("avx2") != 0;
#else
  return 0;
#endif
}

int rot_simd_fma_ok(void) {
#ifdef ROT_SIMD_CAN
  return rot_simd_ok() && __builtin_cpu_supports("fma") != 0;
#else
  return 0;
#endif
}
