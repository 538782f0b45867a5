#include "maths/scaling.h"

#include "rot_test.h"

/* A random map, and the same one with its components in other units: the entries of both are as
 * large as those of the first, and come back to the last bit. */
static void check_units(void) {
  unsigned long seed = 7;
  for (int round = 0; round < 100; round++) {
    double a[16], other[16], copy[16], by[4], unit[4];
    for (int i = 0; i < 4; i++) {
      seed = seed * 1103515245UL % 2147483647UL;
      unit[i] = ldexp(1.0, (int)(seed % 200UL) - 100);
    }
    for (int i = 0; i < 16; i++) {
      seed = seed * 1103515245UL % 2147483647UL;
      a[i] = 1.0 + (double)(seed % 1000UL) / 1000.0;
      copy[i] = other[i] = a[i] * (unit[i / 4] / unit[i % 4]);
    }
    rot_scaling_of(4, other, by);
    const double max = rot_scaling_largest(4, other, by);
    rot_scaling_apply(4, other, by);
    double seen = 0.0;
    for (int i = 0; i < 16; i++) seen = fmax(seen, fabs(other[i]));
    ROT_CHECK(seen == max);
    ROT_CHECK(max <= 4.0 * 2.0);
    rot_scaling_undo(4, other, by);
    for (int i = 0; i < 16; i++) ROT_CHECK(other[i] == copy[i]);
  }
}

/* A component that nothing acts on, or that acts on nothing, keeps its unit. */
static void check_alone(void) {
  const double a[] = {1.0, 1e30, 0.0, 1.0}, zero[] = {0.0};
  double by[2];
  rot_scaling_of(2, a, by);
  ROT_CHECK(by[0] == 1.0 && by[1] == 1.0);
  rot_scaling_of(1, zero, by);
  ROT_CHECK(by[0] == 1.0);
}

int main(void) {
  check_units();
  check_alone();
  return rot_test_report("scaling");
}
