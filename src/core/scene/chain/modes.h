/* Small-amplitude modes of a hanging chain, K u = w^2 M u with M_ij = a_ij, K_ii = b_i, and a bound
 * on the error of the linear equations.
 *
 * Unit of mass: the total mass; unit of time: 1 s/sqrt(g). M = G'G with the rows G of the
 * velocities; the singular values of G K^-1/2 are 1/w. Each row of G is a sum of lengths times the
 * root of a mass, so that slow and fast modes of graded chains keep their digits. */
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

/* links => modes. ROT_ERANGE: a rate overflows or underflows. */
rot_status rot_links_modes_build(const rot_links *c, rot_links_modes *modes);

/* A linear motion in modal coordinates, at the start. */
typedef struct rot_links_swing {
  double eta[ROT_LINKS_MAX];    /* K^1/2 theta in the modes */
  double beside[ROT_LINKS_MAX]; /* the rates of eta over w */
} rot_links_swing;
/* (angles, rates) at the start => modal coordinates. */
void rot_links_swing_start(const rot_links *c, const rot_links_modes *modes, const double theta[],
                           const double omega[], rot_links_swing *swing);
/* (modal coordinates, time since the start) => angles, rates, and in *sum (NULL: not computed) the
 * integral of the sum of b_i theta_i over the total mass. */
void rot_links_swing_at(const rot_links *c, const rot_links_modes *modes,
                        const rot_links_swing *swing, double time_s, double theta[], double omega[],
                        double *sum);

/* Bounds on the error of the linear motion, with rounding; Inf if a swing may exceed 0.5 rad. */
typedef struct rot_links_bound {
  double theta; /* 2-norm of the angles, rad */
  double omega; /* 2-norm of the rates, rad/s */
  double sum;   /* integral of the sum of b_i (sin theta_i - linear theta_i) over the total mass */
} rot_links_bound;
/* (angles, rates) at the start => bounds up to |time_s| seconds from the start. */
rot_links_bound rot_links_linear_bound(const rot_links *c, const rot_links_modes *modes,
                                       const double theta[], const double omega[], double time_s);

#endif
