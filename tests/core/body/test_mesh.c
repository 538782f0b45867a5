/* Integrals over meshes: against the exact tetrahedron at offsets to 1e8, against sums of another
 * form in double words about the origin, against the formulas of sphere and torus, and what moving,
 * scaling, mirroring and splitting must leave alone. Every bound is held against the true error. */
#include "mesh_shapes.h"
#include "ground/dd.h"
#include "rot_test.h"
#include "ground/simd.h"

/* ---- the reference: a . (b x c), in double words; a from the first vertex, exactly ---------- */

typedef struct truth {
  rot_dd size, centre[3], c[6];
} truth;

static const int axes[6][2] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {0, 2}, {1, 2}};

static rot_dd dd(double x) { return (rot_dd){x, 0.0}; }

static rot_dd twice_area(const double *p[3]) {
  rot_dd u[3], v[3], sum = dd(0.0);
  for (int k = 0; k < 3; k++) {
    u[k] = rot_dd_sum2(p[1][k], -p[0][k]);
    v[k] = rot_dd_sum2(p[2][k], -p[0][k]);
  }
  for (int k = 0; k < 3; k++) {
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    const rot_dd n = rot_dd_sub(rot_dd_mul(u[i], v[j]), rot_dd_mul(u[j], v[i]));
    sum = rot_dd_add(sum, rot_dd_mul(n, n));
  }
  return rot_dd_sqrt(sum);
}

static rot_dd determinant(rot_dd p[3][3]) {
  rot_dd sum = dd(0.0);
  for (int k = 0; k < 3; k++) {
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    const rot_dd minor = rot_dd_sub(rot_dd_mul(p[1][i], p[2][j]), rot_dd_mul(p[1][j], p[2][i]));
    sum = rot_dd_add(sum, rot_dd_mul(minor, p[0][k]));
  }
  return sum;
}

static truth reference(const shape *s, int shell) {
  truth t = {dd(0.0), {dd(0.0), dd(0.0), dd(0.0)}, {{0.0, 0.0}}};
  for (size_t f = 0; f < s->faces; f++) {
    const double *p[3];
    for (int k = 0; k < 3; k++) p[k] = s->xyz + 3 * (s->corner[3 * f + (size_t)k] - 1);
    rot_dd sum[3], r[3][3];
    for (int v = 0; v < 3; v++) {
      for (int k = 0; k < 3; k++) r[v][k] = rot_dd_sum2(p[v][k], -s->xyz[k]);
    }
    const rot_dd w = shell ? twice_area(p) : determinant(r);
    for (int k = 0; k < 3; k++) sum[k] = rot_dd_add(rot_dd_add(r[0][k], r[1][k]), r[2][k]);
    t.size = rot_dd_add(t.size, w);
    for (int k = 0; k < 3; k++) t.centre[k] = rot_dd_add(t.centre[k], rot_dd_mul(w, sum[k]));
    for (int k = 0; k < 6; k++) {
      const int i = axes[k][0], j = axes[k][1];
      rot_dd q = rot_dd_mul(sum[i], sum[j]);
      for (int v = 0; v < 3; v++) q = rot_dd_add(q, rot_dd_mul(r[v][i], r[v][j]));
      t.c[k] = rot_dd_add(t.c[k], rot_dd_mul(w, q));
    }
  }
  for (int k = 0; k < 3; k++) {
    t.centre[k] = rot_dd_div(t.centre[k], rot_dd_mul1(t.size, shell ? 3.0 : 4.0));
  }
  for (int k = 0; k < 6; k++) {
    t.c[k] = rot_dd_div(t.c[k], rot_dd_mul1(t.size, shell ? 12.0 : 20.0));
    t.c[k] = rot_dd_sub(t.c[k], rot_dd_mul(t.centre[axes[k][0]], t.centre[axes[k][1]]));
  }
  for (int k = 0; k < 3; k++) t.centre[k] = rot_dd_add1(t.centre[k], s->xyz[k]);
  t.size = rot_dd_div(t.size, dd(shell ? 2.0 : 6.0));
  return t;
}

/* Largest error of the second moment, relative to its trace. */
static double error_of(const rot_mesh_moments *got, const truth *t) {
  const rot_dd trace = rot_dd_add(rot_dd_add(t->c[0], t->c[1]), t->c[2]);
  double worst = 0.0;
  for (int k = 0; k < 6; k++) {
    const double off = fabs(rot_dd_add1(t->c[k], -got->second_moment[k]).hi);
    worst = fmax(worst, off / trace.hi);
  }
  return worst;
}

/* Checks against the reference; returns the error of the second moment. */
static double check_against(shape *s, int shell, double max) {
  rot_mesh_moments got;
  const truth t = reference(s, shell);
  const rot_status status =
      shell ? rot_mesh_shell(shape_mesh(s), NULL, &got) : rot_mesh_solid(shape_mesh(s), NULL, &got);
  ROT_CHECK_EQ_INT(status, ROT_OK);
  const double error = error_of(&got, &t);
  ROT_CHECK(error <= max);
  ROT_CHECK(error <= got.error);
  ROT_CHECK(fabs(rot_dd_add1(t.size, -got.size).hi) <= got.size_error * fabs(t.size.hi));
  for (int k = 0; k < 3; k++) {
    const double largest = fmax(fabs(got.lo[k]), fabs(got.hi[k]));
    ROT_CHECK(fabs(rot_dd_add1(t.centre[k], -got.centre[k]).hi) <=
              got.error * got.reach + 2.0 * ROT_EPS * largest);
  }
  return error;
}

/* ---- tests ---------------------------------------------------------------------------------- */

/* Volume 1, centre (1/4, 1/2, 3/4), C = M/20 sum of (v - g)(v - g)'. */
static void test_tetrahedron(void) {
  static const double offsets[] = {0.0, 1e3, 1e6, 1e8, -1e8};
  static const double want[6] = {0.0375, 0.15, 0.3375, -0.025, -0.0375, -0.075};
  for (size_t i = 0; i < sizeof offsets / sizeof *offsets; i++) {
    shape s = shape_room(4, 4);
    rot_mesh_moments got;
    shape_vertex(&s, 0, 0, 0);
    shape_vertex(&s, 1, 0, 0);
    shape_vertex(&s, 0, 2, 0);
    shape_vertex(&s, 0, 0, 3);
    shape_face(&s, 1, 3, 2);
    shape_face(&s, 1, 2, 4);
    shape_face(&s, 1, 4, 3);
    shape_face(&s, 2, 3, 4);
    shape_move(&s, offsets[i]);
    ROT_CHECK_EQ_INT(rot_mesh_solid(shape_mesh(&s), NULL, &got), ROT_OK);
    ROT_CHECK_REL(got.size, 1.0, 1e-15);
    ROT_CHECK_ULP(got.centre[0], offsets[i] + 0.25, 1);
    ROT_CHECK_ULP(got.centre[1], offsets[i] + 0.5, 1);
    ROT_CHECK_ULP(got.centre[2], offsets[i] + 0.75, 1);
    for (int k = 0; k < 6; k++) {
      ROT_CHECK(fabs(got.second_moment[k] - want[k]) <= 1e-15 * 0.525);
    }
    ROT_CHECK(got.error < 1e-13);
    /* Half a last digit of 1e8 is 7e-9. */
    if (fabs(offsets[i]) > 1e7) {
      ROT_CHECK(got.coordinate_error > 7e-9 && got.coordinate_error < 1e-6);
    }
    ROT_CHECK(got.closure < 1e-15);
    /* (0, 0, 3) is 2.318... from the centre. */
    ROT_CHECK_REL(got.reach, sqrt(0.0625 + 0.25 + 5.0625), 4e-15);
    shape_free(&s);
  }
}

static void test_box(void) {
  const double lo[3] = {-0.5, 1.0, 2.0}, hi[3] = {1.5, 4.0, 7.0}; /* 2 x 3 x 5 */
  shape s = shape_room(8, 12);
  rot_mesh_moments got;
  add_box(&s, lo, hi, 0);
  ROT_CHECK_EQ_INT(rot_mesh_solid(shape_mesh(&s), NULL, &got), ROT_OK);
  ROT_CHECK_REL(got.size, 30.0, 1e-15);
  ROT_CHECK_REL(got.area, 62.0, 1e-15);
  ROT_CHECK_REL(got.second_moment[0], 4.0 / 12.0, 2e-15);
  ROT_CHECK_REL(got.second_moment[1], 9.0 / 12.0, 2e-15);
  ROT_CHECK_REL(got.second_moment[2], 25.0 / 12.0, 2e-15);
  ROT_CHECK(fabs(got.second_moment[3]) < 1e-15);
  /* Plates of a box a, b, c: xx = a^2/12 (4 plates, 2 a (b + c)) + a^2/4 (2 plates, 2 b c). */
  ROT_CHECK_EQ_INT(rot_mesh_shell(shape_mesh(&s), NULL, &got), ROT_OK);
  ROT_CHECK_REL(got.size, 62.0, 1e-15);
  ROT_CHECK_REL(got.second_moment[0], (4.0 / 12 * 32 + 4.0 / 4 * 30) / 62, 2e-15);
  ROT_CHECK_REL(got.second_moment[1], (9.0 / 12 * 42 + 9.0 / 4 * 20) / 62, 2e-15);
  ROT_CHECK_REL(got.second_moment[2], (25.0 / 12 * 50 + 25.0 / 4 * 12) / 62, 2e-15);
  ROT_CHECK_REL(got.centre[2], 4.5, 1e-15);
  shape_free(&s);
}

/* Rough tori, long, flat and far away: error and bound, solid and surface. */
static void test_rough(void) {
  static const double offsets[] = {0.0, 1e2, 1e5};
  static const double scale[][3] = {{1, 1, 1}, {1e3, 1, 1}, {1, 1, 1e-4}, {1, 1e-3, 1e3}};
  double worst = 0.0, looser = 0.0;
  for (size_t i = 0; i < 3; i++) {
    for (size_t j = 0; j < 4; j++) {
      shape s = shape_room(4000, 8000);
      rot_mesh_moments got;
      add_torus(&s, 80, 50, 2.0, 0.75);
      shape_roughen(&s, 0.02, 17 + i);
      for (size_t k = 0; k < 3 * s.vertices; k++) s.xyz[k] *= scale[j][k % 3];
      shape_move(&s, offsets[i]);
      const double solid = check_against(&s, 0, 2e-15);
      (void)check_against(&s, 1, 4e-15);
      ROT_CHECK_EQ_INT(rot_mesh_solid(shape_mesh(&s), NULL, &got), ROT_OK);
      worst = fmax(worst, solid);
      looser = fmax(looser, got.error / fmax(solid, ROT_EPS));
      shape_free(&s);
    }
  }
  printf("  rough tori: error %.2g, bound up to %.0f times the error\n", worst, looser);
  ROT_CHECK(looser < 1000.0);
}

/* A small ball on a long thin needle: nearly all of the mass is far from the middle of the box. */
static void test_far_centre(void) {
  static const double at[3] = {0.0, 0.0, 0.0}, lo[3] = {0.0, -1e-6, -1e-6},
                      hi[3] = {1e4, 1e-6, 1e-6};
  shape s = shape_room(1000, 2000);
  rot_mesh_moments got;
  add_sphere(&s, 20, 12, 1.0, at);
  add_box(&s, lo, hi, 0);
  const truth t = reference(&s, 0);
  ROT_CHECK_EQ_INT(rot_mesh_solid(shape_mesh(&s), NULL, &got), ROT_OK);
  ROT_CHECK(error_of(&got, &t) <= got.error);
  ROT_CHECK(error_of(&got, &t) <= 1e-11); /* of coordinates good to 1e4 eps */
  shape_free(&s);
}

static void test_scales(void) {
  static const double sizes[] = {1e-100, 1e100, 3e-90, 7e95};
  rot_mesh_moments one, got;
  shape s = shape_room(600, 1200);
  add_torus(&s, 30, 20, 2.0, 0.75);
  shape_roughen(&s, 0.1, 5);
  ROT_CHECK_EQ_INT(rot_mesh_solid(shape_mesh(&s), NULL, &one), ROT_OK);
  for (size_t i = 0; i < 4; i++) {
    const double size = sizes[i];
    for (size_t k = 0; k < 3 * s.vertices; k++) s.xyz[k] *= size;
    ROT_CHECK_EQ_INT(rot_mesh_solid(shape_mesh(&s), NULL, &got), ROT_OK);
    ROT_CHECK_REL(got.size / size / size / size, one.size, 1e-14);
    ROT_CHECK_REL(got.area / size / size, one.area, 1e-14);
    ROT_CHECK_REL(got.reach / size, one.reach, 1e-14);
    for (int k = 0; k < 3; k++) {
      ROT_CHECK_REL(got.second_moment[k] / size / size, one.second_moment[k], 1e-14);
    }
    ROT_CHECK(got.error < 1e-13);
    for (size_t k = 0; k < 3 * s.vertices; k++) s.xyz[k] /= size;
  }
  shape_free(&s);
}

/* Errors of a mesh inscribed in a smooth body fall with the square of its steps. */
static void test_converges(void) {
  static const double at[3] = {1.0, -2.0, 0.5};
  const double pi = 3.14159265358979323846;
  double sphere[2], torus[2], shell[2];
  for (int fine = 0; fine < 2; fine++) {
    const int n = fine ? 160 : 80;
    rot_mesh_moments got;
    shape s = shape_room(25600, 51200);
    add_sphere(&s, n, n / 2, 3.0, at);
    ROT_CHECK_EQ_INT(rot_mesh_solid(shape_mesh(&s), NULL, &got), ROT_OK);
    sphere[fine] = got.second_moment[0] / (9.0 / 5.0) - 1.0;
    ROT_CHECK(fabs(got.size / (36.0 * pi) - 1.0) < 1e-2);
    ROT_CHECK_EQ_INT(rot_mesh_shell(shape_mesh(&s), NULL, &got), ROT_OK);
    shell[fine] = got.second_moment[2] / 3.0 - 1.0;
    s.vertices = s.faces = 0;
    add_torus(&s, n, n, 2.0, 0.75);
    ROT_CHECK_EQ_INT(rot_mesh_solid(shape_mesh(&s), NULL, &got), ROT_OK);
    /* Izz = R^2 + 3 a^2/4, Ixx = R^2/2 + 5 a^2/8. */
    torus[fine] = (got.second_moment[0] + got.second_moment[1]) / (4.0 + 0.75 * 0.5625) - 1.0;
    ROT_CHECK(fabs(got.size / (2.0 * pi * pi * 2.0 * 0.5625) - 1.0) < 5e-3);
    shape_free(&s);
  }
  ROT_CHECK(fabs(sphere[0]) < 3e-3);
  ROT_CHECK(fabs(sphere[0] / sphere[1] - 4.0) < 0.1);
  ROT_CHECK(fabs(shell[0] / shell[1] - 4.0) < 0.1);
  ROT_CHECK(fabs(torus[0]) < 5e-3);
  ROT_CHECK(fabs(torus[0] / torus[1] - 4.0) < 0.1);
}

static void test_metamorphic(void) {
  rot_mesh_moments one, got;
  shape s = shape_room(600, 1200);
  add_torus(&s, 30, 20, 2.0, 0.75);
  shape_roughen(&s, 0.1, 9);
  ROT_CHECK_EQ_INT(rot_mesh_solid(shape_mesh(&s), NULL, &one), ROT_OK);
  /* Flipped: the volume alone changes its sign. */
  for (size_t i = 0; i < s.faces; i++) shape_flip(&s, i);
  ROT_CHECK_EQ_INT(rot_mesh_solid(shape_mesh(&s), NULL, &got), ROT_OK);
  ROT_CHECK_REL(got.size, -one.size, 1e-14);
  for (int k = 0; k < 6; k++) {
    ROT_CHECK(fabs(got.second_moment[k] - one.second_moment[k]) < 1e-14);
  }
  /* Mirrored in x, flipped back by that: xy and xz change their signs. */
  for (size_t i = 0; i < s.vertices; i++) s.xyz[3 * i] = -s.xyz[3 * i];
  ROT_CHECK_EQ_INT(rot_mesh_solid(shape_mesh(&s), NULL, &got), ROT_OK);
  ROT_CHECK_REL(got.size, one.size, 1e-14);
  ROT_CHECK(fabs(got.second_moment[3] + one.second_moment[3]) < 1e-14);
  ROT_CHECK(fabs(got.second_moment[5] - one.second_moment[5]) < 1e-14);
  shape_free(&s);
}

/* Registers of two and of four: the same bits, also where the last block is not full. */
static void test_width(void) {
  for (size_t cut = 0; cut < 40; cut++) {
    rot_mesh_moments narrow[2], simd[2];
    shape s = shape_room(600, 1200);
    add_torus(&s, 30, 20, 2.0, 0.75);
    shape_roughen(&s, 0.1, 9 + cut);
    s.faces -= cut;
    for (int on = 0; on < 2; on++) {
      rot_mesh_moments *to = on ? simd : narrow;
      memset(to, 0, 2 * sizeof *to);
      rot_simd_allow(on);
      ROT_CHECK_EQ_INT(rot_mesh_solid(shape_mesh(&s), NULL, &to[0]), ROT_OK);
      ROT_CHECK_EQ_INT(rot_mesh_shell(shape_mesh(&s), NULL, &to[1]), ROT_OK);
    }
    ROT_CHECK(memcmp(narrow, simd, sizeof narrow) == 0);
    shape_free(&s);
  }
}

/* Vertices moved at random within a distance: what that may cost is what is said. */
static void test_moved(void) {
  static const double at[3] = {3.0, -2.0, 1.0};
  const double by = 1e-7;
  double max = 0.0;
  for (uint64_t seed = 1; seed < 20; seed++) {
    for (int shell = 0; shell < 2; shell++) {
      rot_mesh_moments before, after;
      shape s = shape_room(1000, 2000);
      add_sphere(&s, 24, 12, 1.0, at);
      for (size_t i = 0; i < s.vertices; i++) s.xyz[3 * i + 2] *= 0.2;
      rot_status (*const run)(const rot_mesh *, const rot_hooks *, rot_mesh_moments *) =
          shell ? rot_mesh_shell : rot_mesh_solid;
      ROT_CHECK_EQ_INT(run(shape_mesh(&s), NULL, &before), ROT_OK);
      for (size_t i = 0; i < 3 * s.vertices; i++) {
        /* All of them outwards in some rounds. */
        const double off = shape_random(&seed), out = s.xyz[i] - before.centre[i % 3];
        s.xyz[i] += by * (seed % 3 ? off : copysign(1.0, out));
      }
      ROT_CHECK_EQ_INT(run(shape_mesh(&s), NULL, &after), ROT_OK);
      const double trace =
          before.second_moment[0] + before.second_moment[1] + before.second_moment[2];
      for (int k = 0; k < 6; k++) {
        const double off = fabs(after.second_moment[k] - before.second_moment[k]) / trace;
        ROT_CHECK(off <= 1.0001 * by * before.moved_error);
        max = fmax(max, off / (by * before.moved_error));
      }
      shape_free(&s);
    }
  }
  printf("  moved vertices: up to %.2f of what is said\n", max);
  ROT_CHECK(max > 0.02);
}

/* Columns as R has them, vertices that no face names, and stand-ins. */
static void test_layout(void) {
  const double lo[3] = {0.0, 0.0, 0.0}, hi[3] = {2.0, 3.0, 5.0};
  shape s = shape_room(9, 12);
  rot_mesh_moments one, got;
  double columns[27];
  int corners[36];
  uint32_t same[9];
  unsigned char used[9];
  add_box(&s, lo, hi, 0);
  ROT_CHECK_EQ_INT(rot_mesh_solid(shape_mesh(&s), NULL, &one), ROT_OK);
  shape_vertex(&s, 1e300, NAN, 0.0);
  for (size_t i = 0; i < 9; i++) {
    same[i] = (uint32_t)i;
    for (size_t k = 0; k < 3; k++) columns[k * 9 + i] = s.xyz[3 * i + k];
  }
  for (size_t i = 0; i < 12; i++) {
    for (size_t k = 0; k < 3; k++) corners[k * 12 + i] = s.corner[3 * i + k];
  }
  rot_mesh mesh = {9, 12, columns, 1, 9, corners, 1, 12, same, used};
  ROT_CHECK_EQ_INT(rot_mesh_mark_used(&mesh, used), 1);
  ROT_CHECK(used[7] && !used[8]);
  ROT_CHECK_EQ_INT(rot_mesh_solid(&mesh, NULL, &got), ROT_OK);
  for (int k = 0; k < 6; k++) ROT_CHECK_ULP(got.second_moment[k], one.second_moment[k], 0);
  /* Vertex 9 stands for vertex 8, and faces still name 8. */
  for (size_t k = 0; k < 3; k++) {
    columns[k * 9 + 8] = columns[k * 9 + 7];
    columns[k * 9 + 7] += 0.1;
  }
  same[7] = 8;
  ROT_CHECK_EQ_INT(rot_mesh_solid(&mesh, NULL, &got), ROT_OK);
  for (int k = 0; k < 6; k++) ROT_CHECK_ULP(got.second_moment[k], one.second_moment[k], 0);
  shape_free(&s);
}

static rot_status stop(void *ctx, double fraction) {
  (void)ctx;
  (void)fraction;
  return ROT_EUNWIND;
}

static void test_refuses(void) {
  const double lo[3] = {0.0, 0.0, 0.0}, hi[3] = {2.0, 3.0, 5.0}, flat[3] = {2.0, 3.0, 0.0};
  const rot_hooks hooks = {stop, NULL};
  shape s = shape_room(16, 24);
  rot_mesh_moments got;
  rot_mesh_entries bad;
  ROT_CHECK_EQ_INT(rot_mesh_solid(shape_mesh(&s), NULL, &got), ROT_EVALUE);
  add_box(&s, lo, hi, 0);
  ROT_CHECK_EQ_INT(rot_mesh_solid(shape_mesh(&s), &hooks, &got), ROT_EUNWIND);
  s.corner[5] = 9;
  ROT_CHECK_EQ_INT(rot_mesh_solid(shape_mesh(&s), NULL, &got), ROT_EVALUE);
  s.corner[5] = 0;
  ROT_CHECK_EQ_INT(rot_mesh_solid(shape_mesh(&s), NULL, &got), ROT_EVALUE);
  s.corner[8] = -2147483647 - 1;
  bad = rot_mesh_check_entries(shape_mesh(&s));
  ROT_CHECK_EQ_INT(bad.bad_faces, 2);
  ROT_CHECK_EQ_INT(bad.bad_vertices, 0);
  s.vertices = s.faces = 0;
  add_box(&s, lo, hi, 0);
  s.xyz[4] = NAN;
  ROT_CHECK_EQ_INT(rot_mesh_solid(shape_mesh(&s), NULL, &got), ROT_EVALUE);
  s.xyz[4] = HUGE_VAL;
  ROT_CHECK_EQ_INT(rot_mesh_shell(shape_mesh(&s), NULL, &got), ROT_EVALUE);
  s.xyz[7] = NAN;
  bad = rot_mesh_check_entries(shape_mesh(&s));
  ROT_CHECK_EQ_INT(bad.bad_vertices, 2);
  /* A flat box has area and no volume; a point has neither. */
  s.vertices = s.faces = 0;
  add_box(&s, lo, flat, 0);
  ROT_CHECK_EQ_INT(rot_mesh_solid(shape_mesh(&s), NULL, &got), ROT_ERANGE);
  ROT_CHECK_EQ_INT(rot_mesh_shell(shape_mesh(&s), NULL, &got), ROT_OK);
  ROT_CHECK_REL(got.size, 12.0, 1e-15);
  s.vertices = s.faces = 0;
  add_box(&s, lo, lo, 0);
  ROT_CHECK_EQ_INT(rot_mesh_solid(shape_mesh(&s), NULL, &got), ROT_ERANGE);
  ROT_CHECK_EQ_INT(rot_mesh_shell(shape_mesh(&s), NULL, &got), ROT_ERANGE);
  ROT_CHECK(rot_mesh_alloc(SIZE_MAX / 4, 8) == NULL);
  shape_free(&s);
}

int main(void) {
  test_tetrahedron();
  test_box();
  test_rough();
  test_far_centre();
  test_scales();
  test_converges();
  test_metamorphic();
  test_width();
  test_moved();
  test_layout();
  test_refuses();
  return rot_test_report("mesh");
}
