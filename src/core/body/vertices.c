#include "body/vertices.h"

#include <math.h>
#include <stdlib.h>

#include "ground/dd.h"
#include "ground/real.h"
#include "body/inertia.h"

/* A vertex relative to the first vertex, exact, in units of 2^exponent. */
typedef struct corner {
  rot_dd x[3];
} corner;

/* => exponent of the largest coordinate difference, from halves, since the difference may overflow
 */
static int exponent_of(size_t n, int dimension, const double v[]) {
  double max = 0.0;
  int e = 0;
  for (int d = 0; d < dimension; d++) {
    for (size_t i = 1; i < n; i++) {
      max = fmax(max, fabs(v[(size_t)d * n + i] / 2.0 - v[(size_t)d * n] / 2.0));
    }
  }
  (void)frexp(max, &e);
  return e + 1;
}

/* i => vertex i. Scaled before the subtraction, which is exact unless a coordinate underflows. */
static corner corner_at(size_t n, int dimension, const double v[], size_t i, int e) {
  corner c = {{{0.0, 0.0}, {0.0, 0.0}, {0.0, 0.0}}};
  for (int d = 0; d < dimension; d++) {
    const double *row = v + (size_t)d * n;
    c.x[d] = rot_dd_sum2(ldexp(row[i], -e), -ldexp(row[0], -e));
  }
  return c;
}

static double square_length(const rot_dd x[3], const rot_dd from[3]) {
  double sum = 0.0;
  for (int d = 0; d < 3; d++) {
    const double t = rot_dd_sub(x[d], from[d]).hi;
    sum += t * t;
  }
  return sum;
}

/* (amount, measure, second moments of unit mass) => mass, second moments */
static void give_mass(rot_vertices_body *out, int dimension, double measure, double amount,
                      int is_density, int e, const double second[6]) {
  int power;
  out->measure = ldexp(measure, dimension * e);
  out->mass_kg = amount;
  if (is_density) {
    const double p = rot_product_split(2, (double[]){amount, measure}, 1.0, &power);
    out->mass_kg = ldexp(p, power + dimension * e);
  }
  for (int k = 0; k < 6; k++) {
    const double p = rot_product_split(2, (double[]){out->mass_kg, second[k]}, 1.0, &power);
    out->second_kg_m2[k] = ldexp(p, power + 2 * e);
  }
}

/* ---- polygon -------------------------------------------------------------------------------- */

static rot_dd cross(const rot_dd a[], const rot_dd b[]) {
  return rot_dd_sub(rot_dd_mul(a[0], b[1]), rot_dd_mul(a[1], b[0]));
}

/* corners => twice the signed area, sum of the absolute values of its terms */
static rot_dd double_area(size_t n, const corner c[], double *terms) {
  rot_dd area = {0.0, 0.0};
  *terms = 0.0;
  for (size_t i = 0; i < n; i++) {
    const rot_dd *a = c[i].x, *b = c[(i + 1) % n].x;
    area = rot_dd_add(area, cross(a, b));
    *terms += fabs(a[0].hi * b[1].hi) + fabs(a[1].hi * b[0].hi);
  }
  return area;
}

static void polygon_centre(size_t n, const corner c[], rot_dd area2, rot_dd g[3]) {
  rot_dd sum[2] = {{0.0, 0.0}, {0.0, 0.0}};
  for (size_t i = 0; i < n; i++) {
    const rot_dd *a = c[i].x, *b = c[(i + 1) % n].x, d = cross(a, b);
    for (int k = 0; k < 2; k++) {
      sum[k] = rot_dd_add(sum[k], rot_dd_mul(d, rot_dd_add(a[k], b[k])));
    }
  }
  for (int k = 0; k < 2; k++) g[k] = rot_dd_div(sum[k], rot_dd_mul1(area2, 3.0));
  g[2] = (rot_dd){0.0, 0.0};
}

/* => a_j a_k + b_j b_k + (a_j + b_j)(a_k + b_k) */
static rot_dd edge_term(const rot_dd a[], const rot_dd b[], int j, int k) {
  const rot_dd ends = rot_dd_add(rot_dd_mul(a[j], a[k]), rot_dd_mul(b[j], b[k]));
  return rot_dd_add(ends, rot_dd_mul(rot_dd_add(a[j], b[j]), rot_dd_add(a[k], b[k])));
}

/* (corners, twice the area, centre g) => second moments of unit mass about g */
static void polygon_second(size_t n, const corner c[], rot_dd area2, const rot_dd g[3],
                           double second[6]) {
  rot_dd sum[3] = {{0.0, 0.0}, {0.0, 0.0}, {0.0, 0.0}};
  for (size_t i = 0; i < n; i++) {
    rot_dd a[2], b[2];
    for (int k = 0; k < 2; k++) {
      a[k] = rot_dd_sub(c[i].x[k], g[k]);
      b[k] = rot_dd_sub(c[(i + 1) % n].x[k], g[k]);
    }
    const rot_dd d = cross(a, b);
    sum[0] = rot_dd_add(sum[0], rot_dd_mul(d, edge_term(a, b, 0, 0)));
    sum[1] = rot_dd_add(sum[1], rot_dd_mul(d, edge_term(a, b, 1, 1)));
    sum[2] = rot_dd_add(sum[2], rot_dd_mul(d, edge_term(a, b, 0, 1)));
  }
  const rot_dd by = rot_dd_mul1(area2, 12.0);
  second[0] = rot_dd_div(sum[0], by).hi;
  second[1] = rot_dd_div(sum[1], by).hi;
  second[3] = rot_dd_div(sum[2], by).hi;
  second[2] = second[4] = second[5] = 0.0;
}

/* => side of the line from a to b on which c lies: 1, -1, or 0 within rounding */
static int side(const rot_dd a[], const rot_dd b[], const rot_dd c[]) {
  const double abx = b[0].hi - a[0].hi, aby = b[1].hi - a[1].hi, acx = c[0].hi - a[0].hi,
               acy = c[1].hi - a[1].hi, p = abx * acy, q = aby * acx;
  const double doubt = 8.0 * ROT_EPS * (fabs(p) + fabs(q));
  return p - q > doubt ? 1 : p - q < -doubt ? -1 : 0;
}

static int same_place(const rot_dd a[], const rot_dd b[]) {
  const rot_dd x = rot_dd_sub(a[0], b[0]), y = rot_dd_sub(a[1], b[1]);
  return x.hi == 0.0 && y.hi == 0.0;
}

/* 1 if the angle at v between a and b is below 90 degrees. */
static int ahead(const rot_dd v[], const rot_dd a[], const rot_dd b[]) {
  return (a[0].hi - v[0].hi) * (b[0].hi - v[0].hi) + (a[1].hi - v[1].hi) * (b[1].hi - v[1].hi) >
         0.0;
}

/* 1 if the outline a, v, b crosses the edge from s to t at the vertex v. */
static int goes_through(const rot_dd a[], const rot_dd v[], const rot_dd b[], const rot_dd s[],
                        const rot_dd t[]) {
  if (side(s, t, v) != 0 || !ahead(s, t, v) || !ahead(t, s, v)) return 0;
  if (same_place(v, s) || same_place(v, t)) return 0;
  return side(s, t, a) * side(s, t, b) < 0;
}

/* 1 if the direction from v to x is between those to a and b, counter-clockwise; -1 if it is equal
 * to one of them. */
static int between(const rot_dd v[], const rot_dd a[], const rot_dd b[], const rot_dd x[]) {
  const int ab = side(v, a, b), ax = side(v, a, x), bx = side(v, b, x);
  if ((ax == 0 && ahead(v, a, x)) || (bx == 0 && ahead(v, b, x))) return -1;
  if (ab == 0) return ahead(v, a, b) ? -1 : ax > 0;
  return ab > 0 ? ax > 0 && bx < 0 : !(bx > 0 && ax < 0);
}

/* 1 if the paths a, v, b and s, v, t cross at v, from which the others differ. */
static int cross_at_corner(const rot_dd a[], const rot_dd v[], const rot_dd b[], const rot_dd s[],
                           const rot_dd t[]) {
  return between(v, a, b, s) + between(v, a, b, t) == 1 && between(v, a, b, s) >= 0 &&
         between(v, a, b, t) >= 0;
}

/* (edge p, of some length) => where the next such edge ends: a corner may be repeated */
static const rot_dd *next_end(size_t n, const corner c[], size_t p) {
  const rot_dd *v = c[(p + 1) % n].x;
  size_t k = p + 2;
  while (k < p + n && same_place(c[k % n].x, v)) k++;
  return c[k % n].x;
}

/* 1 if edges p and q cross, at least one of which ends on the other. */
static int cross_where_they_touch(size_t n, const corner c[], size_t p, size_t q) {
  const rot_dd *a = c[p].x, *v = c[(p + 1) % n].x, *b = next_end(n, c, p);
  const rot_dd *s = c[q].x, *w = c[(q + 1) % n].x, *t = next_end(n, c, q);
  if (same_place(v, w)) return cross_at_corner(a, v, b, s, t);
  return goes_through(a, v, b, s, w) || goes_through(s, w, t, a, v);
}

/* 1 if the edges a, b and s, t run along each other in one direction, for more than rounding: the
 * area beside them would count twice. (In opposite directions they are a slit, as to a hole.) */
static int run_together(const rot_dd a[], const rot_dd b[], const rot_dd s[], const rot_dd t[]) {
  if (side(a, b, s) != 0 || side(a, b, t) != 0 || side(s, t, a) != 0) return 0;
  const double x = b[0].hi - a[0].hi, y = b[1].hi - a[1].hi, length = x * x + y * y;
  const double from = (s[0].hi - a[0].hi) * x + (s[1].hi - a[1].hi) * y;
  const double to = (t[0].hi - a[0].hi) * x + (t[1].hi - a[1].hi) * y;
  return fmin(length, to) - fmax(0.0, from) > 8.0 * ROT_EPS * fmax(length, fabs(to) + fabs(from));
}

typedef struct edge_box {
  double low, high, bottom, top; /* range of x, range of y */
  size_t from;                   /* first vertex of the edge */
} edge_box;

static int by_low_end(const void *a, const void *b) {
  const double x = ((const edge_box *)a)->low, y = ((const edge_box *)b)->low;
  return (x > y) - (x < y);
}

/* polygon => *found, the edges that cross. Sweep over x: each edge is compared with those that
 * begin before it ends. */
static rot_status find_crossing(size_t n, const corner c[], edge_box box[], const rot_hooks *hooks,
                                int *found, size_t edge[2]) {
  size_t edges = 0;
  *found = 0;
  for (size_t i = 0; i < n; i++) {
    const rot_dd *a = c[i].x, *b = c[(i + 1) % n].x;
    if (same_place(a, b)) continue;
    box[edges++] = (edge_box){fmin(a[0].hi, b[0].hi), fmax(a[0].hi, b[0].hi),
                              fmin(a[1].hi, b[1].hi), fmax(a[1].hi, b[1].hi), i};
  }
  qsort(box, edges, sizeof *box, by_low_end);
  for (size_t i = 0; i < edges; i++) {
    /* Usually an edge overlaps few others; in a star with long spikes, all of them. */
    if (i % 64 == 63) {
      const rot_status status = rot_poll(hooks, (double)i / (double)edges);
      if (status != ROT_OK) return status;
    }
    for (size_t j = i + 1; j < edges && box[j].low <= box[i].high; j++) {
      if (box[j].bottom > box[i].top || box[j].top < box[i].bottom) continue;
      const size_t p = box[i].from, q = box[j].from;
      const rot_dd *a = c[p].x, *b = c[(p + 1) % n].x, *s = c[q].x, *t = c[(q + 1) % n].x;
      if ((side(a, b, s) * side(a, b, t) < 0 && side(s, t, a) * side(s, t, b) < 0) ||
          cross_where_they_touch(n, c, p, q) || run_together(a, b, s, t)) {
        edge[0] = p < q ? p : q;
        edge[1] = p < q ? q : p;
        *found = 1;
        return ROT_OK;
      }
    }
  }
  return ROT_OK;
}

/* (vertices v, amount) => body; c, box: work space of n elements */
static rot_status polygon_from(size_t n, const double v[], double amount, int is_density,
                               corner c[], edge_box box[], const rot_hooks *hooks,
                               rot_vertices_body *out, rot_vertices_fault *fault) {
  const int e = exponent_of(n, 2, v);
  double terms, second[6], reach = 0.0;
  rot_dd g[3];
  for (size_t i = 0; i < n; i++) c[i] = corner_at(n, 2, v, i, e);
  const rot_dd area2 = double_area(n, c, &terms);
  int crossing;
  const rot_status status = find_crossing(n, c, box, hooks, &crossing, out->edge);
  if (status != ROT_OK) return status;
  /* Vertices collinear within the rounding of their coordinates. */
  const int flat = !(fabs(area2.hi) > 8.0 * ROT_EPS * terms);
  if (crossing || flat) {
    *fault = crossing ? ROT_VERTICES_CROSSING : ROT_VERTICES_FLAT;
    return ROT_EVALUE;
  }
  polygon_centre(n, c, area2, g);
  polygon_second(n, c, area2, g, second);
  for (size_t i = 0; i < n; i++) reach = fmax(reach, square_length(c[i].x, g));
  give_mass(out, 2, fabs(area2.hi) / 2.0, amount, is_density, e, second);
  for (int k = 0; k < 2; k++) out->centre_m[k] = v[(size_t)k * n] + ldexp(g[k].hi, e);
  out->centre_m[2] = 0.0;
  out->reach_m = ldexp(sqrt(reach), e);
  /* Errors: some 2^-96 of the terms in the sums, the last rounding, the mass. */
  const double sums = 64.0 * (double)n * ROT_DD_EPS / ROT_EPS * terms / fabs(area2.hi);
  out->error = rot_inertia_error(out->second_kg_m2, out->mass_kg, is_density,
                                 (is_density ? 8.0 : 4.0) + sums, amount > 0.0);
  return ROT_OK;
}

rot_status rot_polygon(size_t n, const double v[], double amount, int is_density,
                       const rot_hooks *hooks, rot_vertices_body *out, rot_vertices_fault *fault) {
  corner *c = malloc((n ? n : 1) * sizeof *c);
  edge_box *box = malloc((n ? n : 1) * sizeof *box);
  rot_status status = ROT_ENOMEM;
  *fault = ROT_VERTICES_FIT;
  if (n < 3) {
    *fault = ROT_VERTICES_FLAT;
    status = ROT_EVALUE;
  } else if (c && box) {
    status = polygon_from(n, v, amount, is_density, c, box, hooks, out, fault);
  }
  free(box);
  free(c);
  return status;
}

/* ---- tetrahedron ---------------------------------------------------------------------------- */

/* corners => six times the signed volume, sum of the absolute values of its terms */
static rot_dd six_volumes(const corner c[4], double *terms) {
  rot_dd volume = {0.0, 0.0};
  *terms = 0.0;
  for (int i = 0; i < 3; i++) {
    const rot_dd *a = c[1].x, *p = c[2].x, *q = c[3].x;
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    const rot_dd minor = rot_dd_sub(rot_dd_mul(p[j], q[k]), rot_dd_mul(p[k], q[j]));
    volume = rot_dd_add(volume, rot_dd_mul(a[i], minor));
    *terms += fabs(a[i].hi) * (fabs(p[j].hi * q[k].hi) + fabs(p[k].hi * q[j].hi));
  }
  return volume;
}

rot_status rot_tetrahedron(const double v[12], double amount, int is_density,
                           rot_vertices_body *out, rot_vertices_fault *fault) {
  const int *row = rot_tensor_row, *column = rot_tensor_column;
  const int e = exponent_of(4, 3, v);
  corner c[4];
  rot_dd g[3];
  double terms, second[6], reach = 0.0;
  for (size_t i = 0; i < 4; i++) c[i] = corner_at(4, 3, v, i, e);
  const rot_dd volume6 = six_volumes(c, &terms);
  *fault = fabs(volume6.hi) > 16.0 * ROT_EPS * terms ? ROT_VERTICES_FIT : ROT_VERTICES_FLAT;
  if (*fault != ROT_VERTICES_FIT) return ROT_EVALUE;
  for (int d = 0; d < 3; d++) {
    const rot_dd sum = rot_dd_add(rot_dd_add(c[1].x[d], c[2].x[d]), c[3].x[d]);
    g[d] = rot_dd_ldexp(sum, -2);
    out->centre_m[d] = v[4 * d] + ldexp(g[d].hi, e);
  }
  for (int k = 0; k < 6; k++) {
    rot_dd sum = {0.0, 0.0};
    for (int i = 0; i < 4; i++) {
      sum = rot_dd_add(sum, rot_dd_mul(rot_dd_sub(c[i].x[row[k]], g[row[k]]),
                                       rot_dd_sub(c[i].x[column[k]], g[column[k]])));
    }
    second[k] = rot_dd_div(sum, (rot_dd){20.0, 0.0}).hi;
  }
  for (int i = 0; i < 4; i++) reach = fmax(reach, square_length(c[i].x, g));
  give_mass(out, 3, fabs(volume6.hi) / 6.0, amount, is_density, e, second);
  out->reach_m = ldexp(sqrt(reach), e);
  out->error = rot_inertia_error(out->second_kg_m2, out->mass_kg, is_density,
                                 is_density ? 8.0 : 4.0, amount > 0.0);
  return ROT_OK;
}
