/* Nodes for integrals over a body. A box, a cylinder, a ball or an ellipsoid is the image of a
 * cuboid of parameters; the integral of a density is a sum over nodes in that cuboid,
 *
 *   int rho dV = sum w_i rho(x_i),   w_i = (weight of the rule) |det dx/dp|.
 *
 * Nodes: Gauss-Legendre, evenly spaced for a periodic angle, or one random point in each of many
 * equal cells. Coordinates are relative to the centre of the domain, so a distant origin causes no
 * loss of digits.
 *
 * Reference: Davis & Rabinowitz, Methods of Numerical Integration, 2nd ed. (1984), ch. 2 and 5. */
#ifndef ROT_DENSITY_H
#define ROT_DENSITY_H

#include <stddef.h>

#include "ground/status.h"

typedef enum rot_domain_kind {
  ROT_DOMAIN_BOX,      /* x, y, z */
  ROT_DOMAIN_CYLINDER, /* distance from the z axis, angle, z */
  ROT_DOMAIN_BALL,     /* distance from the centre, cosine of the polar angle, azimuth */
  ROT_DOMAIN_COUNT
} rot_domain_kind;

typedef struct rot_domain {
  rot_domain_kind kind;
  double low[3], high[3]; /* range of each parameter, in the order above */
  double stretch[3];      /* final factors of x, y, z: an ellipsoid is a scaled unit ball */
} rot_domain;

/* domain => exponent e: volumes and weights are in units of 2^e m^3, so that none overflows */
int rot_domain_exponent(const rot_domain *domain);

/* A quadrature rule on [-1, 1]. */
typedef struct rot_rule {
  size_t n;
  const double *t, *w; /* nodes, weights */
} rot_rule;

/* n => smallest number of nodes of rot_rule_gauss() that is at least n */
size_t rot_rule_size(size_t n);
/* n, a rot_rule_size() => Gauss-Legendre nodes and weights, in panels for large n */
rot_status rot_rule_gauss(size_t n, double t[], double w[]);
/* n => midpoints of n equal parts and weights: spectrally accurate for periodic functions */
void rot_rule_even(size_t n, double t[], double w[]);

/* (domain, rules) => coordinates and weights of nodes from .. from + count - 1 of n1 n2 n3; the
 * third parameter varies fastest */
void rot_density_nodes(const rot_domain *domain, const rot_rule rule[3], size_t from, size_t count,
                       double x[], double y[], double z[], double w[]);

/* The same with one random point in each of side^3 cells. The points depend on seed and replicate
 * only, not on `from` and `count`. */
rot_status rot_density_strata(const rot_domain *domain, size_t side, unsigned long seed,
                              unsigned long replicate, size_t from, size_t count, double x[],
                              double y[], double z[], double w[]);

#endif
