/* Small-amplitude modes of a chain about hanging: K u = w^2 M u with M_ij = a_ij, K_ii = b_i, and a
 * bound on what the linear equations leave out.
 *
 * In units of the total mass and of unit gravity, where a time is sqrt(g) seconds: with the rows G
 * of the velocities, M = G'G, the singular values of G K^-1/2 are 1/w. Each row of G is a sum of
 * lengths times the root of a mass, so that slow and fast modes of graded chains keep digits. */
#ifndef ROT_CHAIN_MODES_H
#define ROT_CHAIN_MODES_H

#include "ground/status.h"
#include "scene/chain/links.h"

typedef struct rot_links_modes {
  double rate[ROT_LINKS_MAX];                    /* w/sqrt(g), ascending */
  double shape[ROT_LINKS_MAX * ROT_LINKS_MAX];   /* column j: orthonormal K^1/2 u_j */
  double root[ROT_LINKS_MAX];                    /* K^1/2 */
  double inverse[ROT_LINKS_MAX * ROT_LINKS_MAX]; /* of M */
} rot_links_modes;

/* ROT_ERANGE: a rate leaves the doubles. */
rot_status rot_links_modes_build(const rot_links *c, rot_links_modes *modes);

/* A linear motion: eta = K^1/2 theta in the modes, and its rates over w. */
typedef struct rot_links_swing {
  double eta[ROT_LINKS_MAX], beside[ROT_LINKS_MAX];
} rot_links_swing;
void rot_links_swing_start(const rot_links *c, const rot_links_modes *modes, const double theta[],
                           const double omega[], rot_links_swing *swing);
/* After time_s seconds. `sum`: the integral of b_i theta_i over the total mass; NULL: unwanted. */
void rot_links_swing_at(const rot_links *c, const rot_links_modes *modes,
                        const rot_links_swing *swing, double time_s, double theta[], double omega[],
                        double *sum);

/* Bounds on the 2-norms of the errors of the angles and the rates of the linear motion, up to
 * |time_s| seconds from the start, with rounding; and on the integral of b_i (sin theta_i - theta_i
 * of the linear motion). Inf where the swing may exceed half a radian. */
typedef struct rot_links_bound {
  double theta, omega, sum;
} rot_links_bound;
rot_links_bound rot_links_linear_bound(const rot_links *c, const rot_links_modes *modes,
                                       const double theta[], const double omega[], double time_s);

#endif
