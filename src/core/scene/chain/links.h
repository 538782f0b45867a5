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
  size_t n;                          /* 1 to ROT_LINKS_MAX */
  int rods;                          /* 1: uniform rods, 0: point masses */
  double length_m[ROT_LINKS_MAX];    /* > 0, from the pivot down */
  double total_kg;                   /* > 0 */
  double fraction[ROT_LINKS_MAX];    /* m_i over the total mass */
  double below[ROT_LINKS_MAX];       /* M_i over the total mass */
  double joint_n_m_s[ROT_LINKS_MAX]; /* c_i >= 0, of the joint at the upper end */
  double gravity_m_per_s2;           /* >= 0 */
} rot_links;

/* f of the equations: distance of the centre of mass over the length. */
static inline double rot_links_first(const rot_links *c) { return c->rods ? 0.5 : 1.0; }
/* h of the equations: moment of inertia about the upper end over m l^2. */
static inline double rot_links_second(const rot_links *c) { return c->rods ? 1.0 / 3.0 : 1.0; }

/* masses => total, fractions, masses below. Returns 0 if a fraction is below the normal doubles or
 * the total overflows, else 1. */
int rot_links_masses(rot_links *c, const double mass_kg[]);

/* a_ij over the total mass. */
double rot_links_inertia(const rot_links *c, size_t i, size_t j);
/* b_i over g and the total mass. */
double rot_links_weight(const rot_links *c, size_t i);

/* rates => T_i, the viscous torque on link i by its upper joint. */
double rot_links_joint(const rot_links *c, const double omega[], size_t i);

/* angle theta + low => sine, cosine. low: exact angle minus theta. */
void rot_links_sine(double theta, double low, double *sine, double *cosine);

/* (angles, rates) => accelerations, by recursion over the articulated mass of the chain below each
 * joint: no difference of nearly equal numbers, so a heavy end on light links costs no digits, and
 * the time is linear in n. A factorisation of a_ij loses m_1/m_n of the digits.
 *
 * Reference: Featherstone, Int. J. Robotics Research 2 (1983) 13. */
void rot_links_accelerations(const rot_links *c, const double theta[], const double low[],
                             const double omega[], double acceleration[]);

#endif
