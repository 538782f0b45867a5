/* Links of a planar chain that hangs from a fixed pivot: uniform rods, or massless rods with a
 * point mass at the lower end. theta_i is the angle of link i from the downward vertical, with the
 * unit vectors e = (sin theta, -cos theta) along the link and t = (cos theta, sin theta) across:
 *
 *   sum_j a_ij cos(theta_i - theta_j) theta_j'' + a_ij sin(theta_i - theta_j) theta_j'^2
 *     + b_i sin theta_i = T_i - T_(i+1),   T_i = -c_i (theta_i' - theta_(i-1)'),
 *
 *   a_ij = l_i l_j s_max(i,j),  a_ii = l_i^2 (h m_i + M_i),  b_i = g l_i s_i,  s_i = f m_i + M_i,
 *
 * M_i: the masses below link i; points: f = h = 1, rods: f = 1/2, h = 1/3. */
#ifndef ROT_CHAIN_LINKS_H
#define ROT_CHAIN_LINKS_H

#include <stddef.h>

enum { ROT_LINKS_MAX = 16 };

typedef struct rot_links {
  size_t n;
  int rods;
  double length_m[ROT_LINKS_MAX];
  double total_kg;
  double fraction[ROT_LINKS_MAX];    /* of each mass in the total */
  double below[ROT_LINKS_MAX];       /* M_i, likewise */
  double joint_n_m_s[ROT_LINKS_MAX]; /* at the upper end */
  double gravity_m_per_s2;
} rot_links;

/* f and h of the equations. */
static inline double rot_links_first(const rot_links *c) { return c->rods ? 0.5 : 1.0; }
static inline double rot_links_second(const rot_links *c) { return c->rods ? 1.0 / 3.0 : 1.0; }

/* Fills the masses. 0: a share of the total is below the normal doubles, or the total infinite. */
int rot_links_masses(rot_links *c, const double mass_kg[]);

/* a_ij and b_i/g per kg of the total mass. */
double rot_links_inertia(const rot_links *c, size_t i, size_t j);
double rot_links_weight(const rot_links *c, size_t i);

/* The viscous torque on link i by its upper joint. */
double rot_links_joint(const rot_links *c, const double omega[], size_t i);

/* sin and cos of theta, `low`: what theta lacks of the exact angle. */
void rot_links_sine(double theta, double low, double *sine, double *cosine);

/* (angles, rates) => accelerations. The articulated mass of the chain from each joint on, without a
 * difference of what is nearly equal: a heavy end on light links costs no digits, and the time is
 * linear in the links. A factorisation of a_ij loses m_1/m_n of the digits.
 *
 * Reference: Featherstone, Int. J. Robotics Research 2 (1983) 13. */
void rot_links_accelerations(const rot_links *c, const double theta[], const double low[],
                             const double omega[], double acceleration[]);

#endif
