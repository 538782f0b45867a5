#include "body/density.h"

#include <gsl/gsl_integration.h>
#include <gsl/gsl_rng.h>
#include <math.h>
#include <stdint.h>

#include "ground/dd.h"

/* An integrand that needs more nodes is not smooth; panels are then as accurate. */
#define SINGLE_NODES 96
#define PANEL_NODES  64
/* GSL has tables up to this number of nodes, and for 32, 64 and 96. For others it computes the
 * nodes to the last digit, but the weights only to 8e-15 at 21 nodes and 1e-10 at 63. */
#define TABLE_NODES  20
/* Cells per stream of random numbers. */
#define BLOCK_CELLS  4096

/* ---- parameters => coordinates --------------------------------------------------------------- */

static int exponent_of(double x) {
  int e = 0;
  (void)frexp(x, &e);
  return e;
}

/* domain => exponents of the parameters, 0 for angles and cosines */
static void exponents(const rot_domain *domain, int e[3]) {
  for (int k = 0; k < 3; k++) {
    e[k] = exponent_of(fmax(fabs(domain->low[k]), fabs(domain->high[k])));
  }
  if (domain->kind == ROT_DOMAIN_CYLINDER) e[1] = 0;
  if (domain->kind == ROT_DOMAIN_BALL) e[1] = e[2] = 0;
}

int rot_domain_exponent(const rot_domain *domain) {
  int e[3], sum = 0;
  exponents(domain, e);
  for (int k = 0; k < 3; k++) sum += e[k] + exponent_of(domain->stretch[k]);
  if (domain->kind == ROT_DOMAIN_CYLINDER) sum += e[0];
  if (domain->kind == ROT_DOMAIN_BALL) sum += 2 * e[0];
  return sum;
}

/* The map from t in [-1, 1]^3 to x. */
typedef struct chart {
  const rot_domain *domain;
  int e[3];                  /* from exponents() */
  double middle[3], half[3]; /* of the parameters' ranges */
  double stretch;            /* product of the domain's factors, without their powers of two */
} chart;

static chart chart_of(const rot_domain *domain) {
  chart c = {.domain = domain, .stretch = 1.0};
  exponents(domain, c.e);
  for (int k = 0; k < 3; k++) {
    int e;
    c.middle[k] = 0.5 * domain->low[k] + 0.5 * domain->high[k];
    c.half[k] = 0.5 * domain->high[k] - 0.5 * domain->low[k];
    c.stretch *= frexp(domain->stretch[k], &e);
  }
  return c;
}

/* t in [-1, 1]^3 => x, determinant of the map without the domain's power of two */
static double place(const chart *c, const double t[3], double x[3]) {
  double p[3], det = c->stretch;
  for (int k = 0; k < 3; k++) {
    p[k] = c->middle[k] + c->half[k] * t[k];
    det *= ldexp(c->half[k], -c->e[k]);
  }
  if (c->domain->kind == ROT_DOMAIN_CYLINDER) {
    det *= ldexp(p[0], -c->e[0]);
    x[0] = p[0] * cos(p[1]);
    x[1] = p[0] * sin(p[1]);
    x[2] = p[2];
  } else if (c->domain->kind == ROT_DOMAIN_BALL) {
    const double r = ldexp(p[0], -c->e[0]), across = p[0] * sqrt((1.0 - p[1]) * (1.0 + p[1]));
    det *= r * r;
    x[0] = across * cos(p[2]);
    x[1] = across * sin(p[2]);
    x[2] = p[0] * p[1];
  } else {
    for (int k = 0; k < 3; k++) x[k] = p[k];
  }
  for (int k = 0; k < 3; k++) x[k] *= c->domain->stretch[k];
  return det;
}

/* ---- rules ---------------------------------------------------------------------------------- */

size_t rot_rule_size(size_t n) {
  if (n <= SINGLE_NODES) return n;
  return PANEL_NODES * ((n + PANEL_NODES - 1) / PANEL_NODES);
}

/* t => weight w = 2/((1 - t^2) P'(t)^2) at the root next to t, by Legendre's recurrence in twice
 * the precision. The root is at t + delta, and dw/w = -2 t delta/(1 - t^2). */
static double weight_at(size_t n, double t) {
  rot_dd before = {1.0, 0.0}, p = {t, 0.0};
  for (size_t k = 2; k <= n; k++) {
    const rot_dd up = rot_dd_mul1(rot_dd_mul1(p, t), (double)(2 * k - 1));
    const rot_dd next = rot_dd_sub(up, rot_dd_mul1(before, (double)(k - 1)));
    before = p;
    p = rot_dd_div(next, (rot_dd){(double)k, 0.0});
  }
  const double across = (1.0 - t) * (1.0 + t);
  const double slope = (double)n * rot_dd_sub(before, rot_dd_mul1(p, t)).hi / across;
  const double delta = -p.hi / slope;
  return 2.0 / (across * slope * slope) * (1.0 - 2.0 * t * delta / across);
}

rot_status rot_rule_gauss(size_t n, double t[], double w[]) {
  const size_t order = n > SINGLE_NODES ? PANEL_NODES : n, panels = n / order;
  const int known = order <= TABLE_NODES || order % 32 == 0;
  gsl_integration_glfixed_table *table = gsl_integration_glfixed_table_alloc(order);
  if (!table) return ROT_ENOMEM;
  const double half = 1.0 / (double)panels;
  for (size_t i = 0; i < order; i++) {
    double ti, wi;
    gsl_integration_glfixed_point(-1.0, 1.0, i, &ti, &wi, table);
    if (!known) wi = weight_at(order, ti);
    for (size_t j = 0; j < panels; j++) {
      const double middle = (double)(2 * j + 1) - (double)panels;
      t[j * order + i] = (middle + ti) * half;
      w[j * order + i] = wi * half;
    }
  }
  gsl_integration_glfixed_table_free(table);
  return ROT_OK;
}

void rot_rule_even(size_t n, double t[], double w[]) {
  for (size_t i = 0; i < n; i++) {
    t[i] = ((double)(2 * i + 1) - (double)n) / (double)n;
    w[i] = 2.0 / (double)n;
  }
}

void rot_density_nodes(const rot_domain *domain, const rot_rule rule[3], size_t from, size_t count,
                       double x[], double y[], double z[], double w[]) {
  const chart c = chart_of(domain);
  for (size_t i = 0; i < count; i++) {
    const size_t at = from + i, rest = at / rule[2].n;
    const size_t j[3] = {rest / rule[1].n, rest % rule[1].n, at % rule[2].n};
    double t[3], here[3], weight = 1.0;
    for (int k = 0; k < 3; k++) {
      t[k] = rule[k].t[j[k]];
      weight *= rule[k].w[j[k]];
    }
    w[i] = weight * place(&c, t, here);
    x[i] = here[0];
    y[i] = here[1];
    z[i] = here[2];
  }
}

/* ---- random points -------------------------------------------------------------------------- */

/* Hash of x: each bit of the result depends on each bit of x (Steele, Lea & Flood, Fast splittable
 * pseudorandom number generators, 2014). */
static uint64_t mixed(uint64_t x) {
  x += UINT64_C(0x9e3779b97f4a7c15);
  x = (x ^ (x >> 30)) * UINT64_C(0xbf58476d1ce4e5b9);
  x = (x ^ (x >> 27)) * UINT64_C(0x94d049bb133111eb);
  return x ^ (x >> 31);
}

static unsigned long block_seed(unsigned long seed, unsigned long replicate, size_t block) {
  const uint64_t x = mixed(mixed(mixed((uint64_t)seed) ^ (uint64_t)replicate) ^ (uint64_t)block);
  return (unsigned long)(x >> 32);
}

rot_status rot_density_strata(const rot_domain *domain, size_t side, unsigned long seed,
                              unsigned long replicate, size_t from, size_t count, double x[],
                              double y[], double z[], double w[]) {
  const chart c = chart_of(domain);
  const double width = 2.0 / (double)side, weight = width * width * width;
  gsl_rng *rng = gsl_rng_alloc(gsl_rng_mt19937);
  if (!rng) return ROT_ENOMEM;
  const size_t end = from + count;
  for (size_t at = from - from % BLOCK_CELLS; at < end; at++) {
    if (at % BLOCK_CELLS == 0) gsl_rng_set(rng, block_seed(seed, replicate, at / BLOCK_CELLS));
    const size_t j[3] = {at / side / side, at / side % side, at % side};
    double t[3], here[3];
    for (int k = 0; k < 3; k++) {
      t[k] = -1.0 + width * ((double)j[k] + gsl_rng_uniform_pos(rng));
    }
    if (at < from) continue;
    w[at - from] = weight * place(&c, t, here);
    x[at - from] = here[0];
    y[at - from] = here[1];
    z[at - from] = here[2];
  }
  gsl_rng_free(rng);
  return ROT_OK;
}
