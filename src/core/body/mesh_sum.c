/* The kernel for registers of four (ground/simd.h). */
#include "ground/simd.h"

#ifdef ROT_SIMD_CAN
#define ROT_SIMD
#endif

#include "body/mesh_sum.h"

ROT_TARGET void rot_mesh_sum_simd(const rot_mesh *mesh, rot_mesh_sums *sums, size_t from,
                                  size_t end, int shell) {
  if (shell) {
    sum_faces(mesh, sums, from, end, 1);
  } else {
    sum_faces(mesh, sums, from, end, 0);
  }
}
