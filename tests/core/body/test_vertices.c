/* Polygons and tetrahedra by their corners: against shapes whose moments are known, far from the
 * origin, at extreme scales, and what is refused. */
#include <stdlib.h>

#include "ground/real.h"
#include "rot_test.h"
#include "shared_table.h"
#include "body/vertices.h"

static rot_vertices_body polygon(size_t n, const double v[], double mass) {
  rot_vertices_body b = {0};
  rot_vertices_fault fault = ROT_VERTICES_FLAT;
  ROT_CHECK_EQ_INT(rot_polygon(n, v, mass, 0, NULL, &b, &fault), ROT_OK);
  ROT_CHECK_EQ_INT(fault, ROT_VERTICES_FIT);
  return b;
}

static rot_vertices_fault refused(size_t n, const double v[]) {
  rot_vertices_body b = {0};
  rot_vertices_fault fault = ROT_VERTICES_FIT;
  ROT_CHECK_EQ_INT(rot_polygon(n, v, 1.0, 0, NULL, &b, &fault), ROT_EVALUE);
  return fault;
}

/* Within the error reported, by the trace; the reference may be off by half an ulp itself. */
static void check_second(const rot_vertices_body *b, const double want[6]) {
  const double trace = want[0] + want[1] + want[2];
  for (int k = 0; k < 6; k++) {
    ROT_CHECK(fabs(b->second_kg_m2[k] - want[k]) <= (b->error + 2.0 * ROT_EPS) * trace);
  }
}

/* By hand, from formulas and parallel axes. */
static void check_polygons(void) {
  const double square[] = {0, 3, 3, 0, 0, 0, 2, 2}, back[] = {0, 0, 3, 3, 0, 2, 2, 0};
  const double want[6] = {2.0 * 9.0 / 12.0, 2.0 * 4.0 / 12.0, 0, 0, 0, 0};
  const rot_vertices_body b = polygon(4, square, 2.0), c = polygon(4, back, 2.0);
  check_second(&b, want);
  check_second(&c, want);
  ROT_CHECK(b.centre_m[0] == 1.5 && b.centre_m[1] == 1.0 && b.centre_m[2] == 0.0);
  ROT_CHECK(b.measure == 6.0 && c.measure == 6.0 && b.mass_kg == 2.0);
  ROT_CHECK_ULP(b.reach_m, sqrt(1.5 * 1.5 + 1.0), 1);
  ROT_CHECK(b.error > 0.0 && b.error < 1e-15);

  /* A triangle: (1/18) of the squares of its height; h (2 p - b)/36. */
  const double triangle[] = {0, 3, 1, 0, 0, 5};
  const double t[6] = {7.0 / 18.0, 25.0 / 18.0, 0, -5.0 / 36.0, 0, 0};
  const rot_vertices_body d = polygon(3, triangle, 1.0);
  check_second(&d, t);
  ROT_CHECK_ULP(d.centre_m[0], 4.0 / 3.0, 1);

  /* An L of three squares: by parallel axes from their centres. The first corner comes twice. */
  const double ell[] = {0, 0, 2, 2, 1, 1, 0, 0, 0, 0, 1, 1, 2, 2};
  const rot_vertices_body l = polygon(7, ell, 3.0);
  const double l6[6] = {3.0 / 12.0 + 2.0 / 3.0, 3.0 / 12.0 + 2.0 / 3.0, 0, -1.0 / 3.0, 0, 0};
  check_second(&l, l6);
  ROT_CHECK_ULP(l.centre_m[0], 5.0 / 6.0, 1);
  ROT_CHECK(l.measure == 3.0);
  ROT_CHECK_ULP(l.reach_m, sqrt(49.0 + 25.0) / 6.0, 1);
}

static void check_density(void) {
  const double square[] = {0, 3, 3, 0, 0, 0, 2, 2};
  rot_vertices_body b;
  rot_vertices_fault fault;
  ROT_CHECK_EQ_INT(rot_polygon(4, square, 0.5, 1, NULL, &b, &fault), ROT_OK);
  ROT_CHECK(b.mass_kg == 3.0);
  ROT_CHECK_ULP(b.second_kg_m2[0], 3.0 * 9.0 / 12.0, 2);
  const double corners[12] = {0, 1, 0, 0, 0, 0, 2, 0, 0, 0, 0, 3};
  ROT_CHECK_EQ_INT(rot_tetrahedron(corners, 7.0, 1, &b, &fault), ROT_OK);
  ROT_CHECK_ULP(b.mass_kg, 7.0, 1);
  ROT_CHECK_ULP(b.measure, 1.0, 1);
  ROT_CHECK(b.error == 8.0 * ROT_EPS); /* a mass that is computed adds four roundings */
  ROT_CHECK_EQ_INT(rot_tetrahedron(corners, 7.0, 0, &b, &fault), ROT_OK);
  ROT_CHECK(b.error == 4.0 * ROT_EPS && b.mass_kg == 7.0);
}

/* The same corners elsewhere and at other scales: coordinates that are exact there give the same
 * digits. */
static void check_places(void) {
  const double at[] = {0, 4, 0, 1.5, 0, 1, 5, 1.25};
  const rot_vertices_body here = polygon(4, at, 1.0);
  const double offsets[] = {1e4, -1e8, 3e12};
  for (int i = 0; i < 3; i++) {
    double v[8];
    for (int k = 0; k < 8; k++) v[k] = at[k] + (k < 4 ? offsets[i] : 2.0 * offsets[i]);
    const rot_vertices_body there = polygon(4, v, 1.0);
    for (int k = 0; k < 6; k++) ROT_CHECK(there.second_kg_m2[k] == here.second_kg_m2[k]);
    ROT_CHECK(there.error == here.error && there.reach_m == here.reach_m);
    ROT_CHECK_ULP(there.centre_m[0], here.centre_m[0] + offsets[i], 1);
  }
  const int powers[] = {-1000, -500, 500, 1000};
  for (int i = 0; i < 4; i++) {
    double v[8];
    for (int k = 0; k < 8; k++) v[k] = ldexp(at[k], powers[i]);
    rot_vertices_body b;
    rot_vertices_fault fault;
    ROT_CHECK_EQ_INT(rot_polygon(4, v, ldexp(1.0, -powers[i]), 0, NULL, &b, &fault), ROT_OK);
    for (int k = 0; k < 6; k++) {
      ROT_CHECK(b.second_kg_m2[k] == ldexp(here.second_kg_m2[k], powers[i]));
    }
    ROT_CHECK(b.reach_m == ldexp(here.reach_m, powers[i]));
  }
  const double simd[] = {-1.5e308, 1.5e308, 0, 0, 0, 1e308}; /* wider than the largest double */
  ROT_CHECK_ULP(polygon(3, simd, 0.0).centre_m[1], 1e308 / 3.0, 1);
}

/* A slanted strip of length 1 and width w: its moment across is w^2/12, its area w. */
static void check_thin(void) {
  const double widths[] = {1e-2, 1e-5, 1e-9};
  for (int i = 0; i < 3; i++) {
    const double w = widths[i],
                 v[] = {0, 0.6, 0.6 - 0.8 * w, -0.8 * w, 0, 0.8, 0.8 + 0.6 * w, 0.6 * w};
    const rot_vertices_body b = polygon(4, v, 1.0);
    const double *c = b.second_kg_m2;
    ROT_CHECK_REL(b.measure, w, 1e-15 / w);
    ROT_CHECK_REL(c[0] + c[1], (1.0 + w * w) / 12.0, 1e-15);
    ROT_CHECK(b.error < 1e-14);
  }
}

/* n corners on a circle. */
static rot_status stop(void *ctx, double fraction) {
  (void)ctx;
  (void)fraction;
  return ROT_EUNWIND;
}

static void check_many(void) {
  enum { N = 5000 };
  double *v = malloc(2 * N * sizeof *v);
  for (int i = 0; i < N; i++) {
    v[i] = cos(8.0 * atan(1.0) * i / N);
    v[N + i] = sin(8.0 * atan(1.0) * i / N);
  }
  const rot_vertices_body b = polygon(N, v, 1.0);
  ROT_CHECK_REL(b.second_kg_m2[0], 0.25 - sin(4.0 * atan(1.0) / N) * sin(4.0 * atan(1.0) / N) / 6.0,
                2e-15);
  ROT_CHECK(b.error < 1e-14);
  const rot_hooks hooks = {stop, NULL};
  rot_vertices_body none;
  rot_vertices_fault fault;
  ROT_CHECK_EQ_INT(rot_polygon(N, v, 1.0, 0, &hooks, &none, &fault), ROT_EUNWIND);
  free(v);
}

static void check_refused(void) {
  const double bow[] = {0, 2, 0, 2, 0, 2, 2, 0}, line[] = {0, 1, 2, 0, 1, 2};
  const double rounded[] = {0.1, 0.2, 0.7, 0.3, 0.6, 2.1}; /* on y = 3 x, but for rounding */
  const double star[] = {0, 4, -4, 3, -3, 5, -2, -2, -4 + 10, -4 + 0};
  const double pentagram[] = {0, 0.588, -0.951, 0.951, -0.588, 1, -0.809, 0.309, 0.309, -0.809};
  const double same[] = {1, 1, 1, 2, 2, 2};
  ROT_CHECK_EQ_INT(refused(4, bow), ROT_VERTICES_CROSSING);
  ROT_CHECK_EQ_INT(refused(5, pentagram), ROT_VERTICES_CROSSING);
  ROT_CHECK_EQ_INT(refused(5, star), ROT_VERTICES_CROSSING);
  ROT_CHECK_EQ_INT(refused(3, line), ROT_VERTICES_FLAT);
  ROT_CHECK_EQ_INT(refused(3, rounded), ROT_VERTICES_FLAT);
  ROT_CHECK_EQ_INT(refused(3, same), ROT_VERTICES_FLAT);
  ROT_CHECK_EQ_INT(refused(2, line), ROT_VERTICES_FLAT);
  ROT_CHECK_EQ_INT(refused(0, line), ROT_VERTICES_FLAT);
  rot_vertices_body b = {0};
  rot_vertices_fault fault;
  (void)rot_polygon(4, bow, 1.0, 0, NULL, &b, &fault);
  ROT_CHECK(b.edge[0] == 0 && b.edge[1] == 2);
  /* Corners that touch an edge cross nothing; nor does a slit. */
  const double touching[] = {0, 4, 4, 2, 0, 0, 0, 4, 0, 4};
  const double slit[] = {0, 4, 4, 0, 0, 1, 1, 0, 0, 0, 4, 4, 2, 2, 2, 2};
  ROT_CHECK(polygon(5, touching, 1.0).measure == 8.0);
  ROT_CHECK(polygon(8, slit, 1.0).measure == 16.0);
  const double thin[] = {0, 1, 1, 0, 0, 0, 1e-20, 1e-20}; /* a plate, however thin */
  ROT_CHECK_REL(polygon(4, thin, 1.0).measure, 1e-20, 1e-15);
}

/* Tetrahedron (0,0,0), (1,0,0), (0,2,0), (0,0,3): C = (1/20) sum v v' - (1/16) g g'..., by hand:
 * xx 3/80 a^2, xy -a b/80. */
static void check_tetrahedron(void) {
  const double at[12] = {0, 1, 0, 0, 0, 0, 2, 0, 0, 0, 0, 3};
  const double want[6] = {3.0 / 80.0,  12.0 / 80.0, 27.0 / 80.0,
                          -2.0 / 80.0, -3.0 / 80.0, -6.0 / 80.0};
  const double offsets[] = {0.0, 1e4, 1e8};
  rot_vertices_body b;
  rot_vertices_fault fault;
  for (int i = 0; i < 3; i++) {
    double v[12];
    for (int k = 0; k < 12; k++) v[k] = at[k] + offsets[i];
    ROT_CHECK_EQ_INT(rot_tetrahedron(v, 1.0, 0, &b, &fault), ROT_OK);
    check_second(&b, want);
    for (int k = 0; k < 3; k++) ROT_CHECK_ULP(b.centre_m[k], offsets[i] + (k + 1) / 4.0, 0);
    ROT_CHECK(b.measure == 1.0);
    ROT_CHECK_ULP(b.reach_m, sqrt(1.0 / 16.0 + 0.25 + 81.0 / 16.0), 1);
    ROT_CHECK(b.error > 0.0 && b.error < 1e-15);
  }
  const double flat[12] = {0.1, 1,   0.3, 0.7, 0.2, 0.3,
                           0.9, 0.1, 0.3, 1.3, 1.2, 0.8}; /* z = x + y */
  ROT_CHECK_EQ_INT(rot_tetrahedron(flat, 1.0, 0, &b, &fault), ROT_EVALUE);
  ROT_CHECK_EQ_INT(fault, ROT_VERTICES_FLAT);
}

/* The shared table: offset -> volume, centre, inertia about the centre. */
static void check_shared(void) {
  FILE *file = shared_table("refs/tetrahedron.csv");
  double x[8];
  int rows = 0;
  if (!file) return;
  while (shared_row(file, 8, x)) {
    rows++;
    const double base[12] = {0, 1, 0, 0, 0, 0, 2, 0, 0, 0, 0, 3};
    double v[12];
    for (int k = 0; k < 12; k++) v[k] = base[k] + x[0];
    rot_vertices_body b;
    rot_vertices_fault fault;
    ROT_CHECK_EQ_INT(rot_tetrahedron(v, 1.0, 1, &b, &fault), ROT_OK);
    ROT_CHECK_ULP(b.mass_kg, x[1], 1);
    for (int k = 0; k < 3; k++) ROT_CHECK_ULP(b.centre_m[k], x[2 + k], 1);
    const double *c = b.second_kg_m2;
    ROT_CHECK_ULP(c[1] + c[2], x[5], 3);
    ROT_CHECK_ULP(c[0] + c[2], x[6], 3);
    ROT_CHECK_ULP(c[0] + c[1], x[7], 3);
  }
  ROT_CHECK(rows > 1);
}

/* An outline of n corners, from any of them on, either way round, turned and mirrored: refused as
 * crossing, or taken with its area. */
static void check_outline(int n, const double corner[][2], int crosses, double area) {
  for (int first = 0; first < n; first++) {
    for (int form = 0; form < 16; form++) {
      double at[18];
      const int turned = form >> 3 & 1;
      for (int i = 0; i < n; i++) {
        const double *from = corner[((form & 1 ? -i : i) + first + n) % n];
        at[i] = from[turned] * (form & 2 ? -1.0 : 1.0);
        at[n + i] = from[!turned] * (form & 4 ? -1.0 : 1.0);
      }
      if (crosses) ROT_CHECK_EQ_INT(refused((size_t)n, at), ROT_VERTICES_CROSSING);
      if (!crosses) ROT_CHECK(polygon((size_t)n, at, 1.0).measure == area);
    }
  }
}

/* An outline that meets itself in a corner: crossing there, or touching; also where one edge leaves
 * the corner straight on from another, and where two leave it together. */
static void check_corner(void) {
  const double crosses[6][2] = {{-1, -1}, {0, 0}, {1, 1}, {1, -1}, {0, 0}, {-1, 1}};
  const double touches[6][2] = {{-1, -1}, {0, 0}, {1, -1}, {1, 1}, {0, 0}, {-1, 1}};
  const double on[7][2] = {{0, 2}, {0, 0}, {2, 0}, {0, -1}, {-1, 0}, {0, 0}, {1, 1}};
  const double beside[7][2] = {{0, 2}, {0, 0}, {2, 0}, {0, -1}, {-1, 0}, {0, 0}, {-1, 1}};
  const double along[7][2] = {{0, 4}, {0, 0}, {4, 0}, {4, 1}, {1, 0}, {0, 0}, {1, 1}};
  /* Two edges along each other in one direction: a loop inside, and a way through. */
  const double twice[6][2] = {{0, 2}, {0, 0}, {1, 0}, {0.5, 0.5}, {0, 0}, {2, 0}};
  const double through[7][2] = {{0, 2}, {0, 0}, {2, 0}, {2, -1}, {0.5, 0}, {1, 0}, {1.5, 1}};
  /* A corner that is repeated is the same corner. */
  const double waist[9][2] = {{-1, -1}, {0, 0}, {0, 0}, {2, 2}, {2, 2},
                              {2, -2},  {0, 0}, {0, 0}, {-1, 1}};
  const double pinched[9][2] = {{-1, -1}, {0, 0}, {0, 0}, {1, -1}, {1, -1},
                                {1, 1},   {0, 0}, {0, 0}, {-1, 1}};
  check_outline(9, waist, 1, 0.0);
  check_outline(9, pinched, 0, 2.0);
  check_outline(6, twice, 1, 0.0);
  check_outline(7, through, 1, 0.0);
  check_outline(6, crosses, 1, 0.0);
  check_outline(6, touches, 0, 2.0);
  check_outline(7, on, 1, 0.0);
  check_outline(7, beside, 0, 2.5);
  check_outline(7, along, 0, 3.5);
}

int main(void) {
  check_polygons();
  check_density();
  check_places();
  check_thin();
  check_many();
  check_refused();
  check_tetrahedron();
  check_shared();
  check_corner();
  return rot_test_report("vertices");
}
