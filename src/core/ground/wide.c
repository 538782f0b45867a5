#include "ground/wide.h"

static int forbidden = 0;

void rot_wide_allow(int allowed) { forbidden = !allowed; }

int rot_wide_ok(void) {
#ifdef ROT_WIDE_CAN
  return !forbidden && __builtin_cpu_supports("avx2") != 0;
#else
  return 0;
#endif
}

int rot_wide_fma_ok(void) {
#ifdef ROT_WIDE_CAN
  return rot_wide_ok() && __builtin_cpu_supports("fma") != 0;
#else
  return 0;
#endif
}
