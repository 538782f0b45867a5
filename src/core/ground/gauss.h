/* The 12-point Gauss-Legendre rule. */
#ifndef ROT_GAUSS_H
#define ROT_GAUSS_H

#include "ground/ieee.h"

/* The 12-point Gauss-Legendre rule on (0, 1). Truncation error below 1e-17 for exponentials and
 * sines with arguments up to 3. */
typedef struct rot_gauss_node {
  double x;      /* 0 to 1 */
  double weight; /* > 0, sum 1 */
} rot_gauss_node;

/* i in 0 .. 11 => node i, increasing */
static inline rot_gauss_node rot_gauss(int i) {
  static const double place[6] = {0.98156063424671925069, 0.90411725637047485667,
                                  0.76990267419430468703, 0.58731795428661744729,
                                  0.36783149899818019375, 0.12523340851146891547};
  static const double weight[6] = {0.04717533638651182719, 0.10693932599531843096,
                                   0.16007832854334622633, 0.20316742672306592174,
                                   0.23349253653835480876, 0.24914704581340278500};
  const int k = i < 6 ? i : 11 - i;
  return (rot_gauss_node){0.5 + (i < 6 ? -0.5 : 0.5) * place[k], 0.5 * weight[k]};
}

#endif
