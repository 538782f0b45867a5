/* Welding: loose triangles become the mesh they were cut from, -0 is 0, and a tolerance is kept. */
#include "mesh_shapes.h"
#include "rot_test.h"
#include "body/mesh_weld.h"

/* Every face with vertices of its own. */
static shape loosen(const shape *s) {
  shape out = shape_room(3 * s->faces, s->faces);
  for (size_t i = 0; i < s->faces; i++) {
    int v[3];
    for (size_t k = 0; k < 3; k++) {
      const double *at = s->xyz + 3 * (s->corner[3 * i + k] - 1);
      v[k] = shape_vertex(&out, at[0], at[1], at[2]);
    }
    shape_face(&out, v[0], v[1], v[2]);
  }
  return out;
}

static void test_exact(void) {
  shape s = shape_room(600, 1200);
  add_torus(&s, 30, 20, 2.0, 0.75);
  shape loose = loosen(&s);
  uint32_t *same = malloc(loose.vertices * sizeof *same);
  size_t merged;
  if (!same) abort();
  ROT_CHECK_EQ_INT(rot_mesh_weld(shape_mesh(&loose), 0.0, NULL, same, &merged), ROT_OK);
  ROT_CHECK_EQ_INT(merged, 3600 - 600);
  for (size_t i = 0; i < loose.vertices; i++) {
    ROT_CHECK(same[i] <= i && same[same[i]] == same[i]);
    ROT_CHECK(memcmp(loose.xyz + 3 * i, loose.xyz + 3 * (size_t)same[i], 24) == 0);
  }
  /* One bit apart is apart; zeros of both signs are together. */
  static const double xyz[] = {0.0, -0.0, 1.0, -0.0, 0.0, 1.0, 0.0, 0.0, 1.0 + 0x1p-52};
  const rot_mesh three = {3, 0, xyz, 3, 1, NULL, 3, 1, NULL, NULL};
  ROT_CHECK_EQ_INT(rot_mesh_weld(&three, 0.0, NULL, same, &merged), ROT_OK);
  ROT_CHECK_EQ_INT(merged, 1);
  ROT_CHECK(same[0] == 0 && same[1] == 0 && same[2] == 2);
  free(same);
  shape_free(&loose);
  shape_free(&s);
}

static void test_tolerance(void) {
  static const double tolerances[] = {1e-9, 3e-13};
  shape s = shape_room(600, 1200);
  add_torus(&s, 30, 20, 2.0, 0.75);
  for (size_t t = 0; t < 2; t++) {
    const double tolerance = tolerances[t];
    shape loose = loosen(&s);
    uint32_t *same = malloc(loose.vertices * sizeof *same);
    size_t merged;
    if (!same) abort();
    /* Any two copies of a vertex are less than the tolerance apart. */
    shape_roughen(&loose, 0.49 * tolerance, 3);
    ROT_CHECK_EQ_INT(rot_mesh_weld(shape_mesh(&loose), 0.0, NULL, same, &merged), ROT_OK);
    ROT_CHECK(merged < 300);
    ROT_CHECK_EQ_INT(rot_mesh_weld(shape_mesh(&loose), tolerance, NULL, same, &merged), ROT_OK);
    ROT_CHECK_EQ_INT(merged, 3000);
    for (size_t i = 0; i < loose.vertices; i++) {
      const double *a = loose.xyz + 3 * i, *b = loose.xyz + 3 * (size_t)same[i];
      ROT_CHECK(same[i] <= i && same[same[i]] == same[i]);
      for (int k = 0; k < 3; k++) ROT_CHECK(fabs(a[k] - b[k]) <= tolerance);
    }
    /* A hundredth of it is not enough for most. */
    ROT_CHECK_EQ_INT(rot_mesh_weld(shape_mesh(&loose), tolerance / 100.0, NULL, same, &merged),
                     ROT_OK);
    ROT_CHECK(merged < 300);
    free(same);
    shape_free(&loose);
  }
  shape_free(&s);
}

static void test_refuses(void) {
  static const double xyz[] = {1.0, 2.0, 3.0};
  const rot_mesh one = {1, 0, xyz, 3, 1, NULL, 3, 1, NULL, NULL};
  uint32_t same[1];
  size_t merged;
  ROT_CHECK_EQ_INT(rot_mesh_weld(&one, NAN, NULL, same, &merged), ROT_EVALUE);
  ROT_CHECK_EQ_INT(rot_mesh_weld(&one, -1.0, NULL, same, &merged), ROT_EVALUE);
  ROT_CHECK_EQ_INT(rot_mesh_weld(&one, HUGE_VAL, NULL, same, &merged), ROT_EVALUE);
  ROT_CHECK_EQ_INT(rot_mesh_weld(&one, 1e-17, NULL, same, &merged), ROT_EVALUE);
  ROT_CHECK_EQ_INT(rot_mesh_weld(&one, 1e-15, NULL, same, &merged), ROT_OK);
  ROT_CHECK_EQ_INT(merged, 0);
}

static rot_status stop(void *ctx, double fraction) {
  (void)ctx;
  (void)fraction;
  return ROT_EUNWIND;
}

static void test_stops(void) {
  static const double xyz[] = {0.0, 0.0, 1.0, 0.0, 0.0, 1.0};
  const rot_mesh two = {2, 0, xyz, 3, 1, NULL, 3, 1, NULL, NULL};
  const rot_hooks hooks = {stop, NULL};
  uint32_t same[2];
  size_t merged;
  ROT_CHECK_EQ_INT(rot_mesh_weld(&two, 0.0, &hooks, same, &merged), ROT_EUNWIND);
  ROT_CHECK_EQ_INT(rot_mesh_weld(&two, 1e-3, &hooks, same, &merged), ROT_EUNWIND);
}

int main(void) {
  test_stops();
  test_exact();
  test_tolerance();
  test_refuses();
  return rot_test_report("mesh_weld");
}
