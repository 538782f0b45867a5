#include "body/inertia.h"

#include <float.h>
#include <stdlib.h>

#include "ground/dd.h"
#include "rot_test.h"
#include "shared_table.h"

static uint64_t seed = 20;
static double uniform(void) {
  seed = seed * 6364136223846793005u + 1442695040888963407u;
  return (double)(seed >> 11) * 0x1p-53;
}
static double between(double a, double b) { return a + (b - a) * uniform(); }

static const int row_of[] = {0, 1, 2, 0, 0, 1}, column_of[] = {0, 1, 2, 1, 2, 2};

/* A rotation from a random unit quaternion, orthogonal to some roundings. */
static void random_rotation(double r[9]) {
  double q[4], norm = 0.0;
  do {
    norm = 0.0;
    for (int i = 0; i < 4; i++) {
      q[i] = between(-1.0, 1.0);
      norm += q[i] * q[i];
    }
  } while (norm < 0.01 || norm > 1.0);
  for (int i = 0; i < 4; i++) q[i] /= sqrt(norm);
  const double w = q[0], x = q[1], y = q[2], z = q[3];
  const double values[9] = {
      1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y - w * z),       2.0 * (x * z + w * y),
      2.0 * (x * y + w * z),       1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z - w * x),
      2.0 * (x * z - w * y),       2.0 * (y * z + w * x),       1.0 - 2.0 * (x * x + y * y)};
  for (int i = 0; i < 9; i++) r[i] = values[i];
}

/* ---- C and I -------------------------------------------------------------------------------- */

/* Three points, by hand: 2 kg at (1, 2, 3), 1 kg at (-1, 0, 2), 4 kg at (0, -2, 1). */
static void check_conversion(void) {
  const double c[] = {3.0, 24.0, 26.0, 4.0, 4.0, 4.0};
  /* Ixx = sum m (y^2 + z^2) = 26 + 4 + 20, and so on; Ixy = -sum m x y. */
  const double want[] = {50.0, 29.0, 27.0, -4.0, -4.0, -4.0};
  double inertia[6], back[6];
  rot_inertia_of_second(c, inertia);
  rot_inertia_to_second(inertia, back);
  for (int k = 0; k < 6; k++) {
    ROT_CHECK(inertia[k] == want[k]);
    ROT_CHECK(back[k] == c[k]);
  }
  /* A product of 0 is +0, so that no table prints -0. */
  const double flat[] = {1.0, 2.0, 0.0, 0.0, 0.0, 0.0};
  rot_inertia_of_second(flat, inertia);
  for (int k = 3; k < 6; k++) ROT_CHECK(!signbit(inertia[k]));
  ROT_CHECK(inertia[2] == inertia[0] + inertia[1]);
  /* (a + b - c)/2 where the sum cannot be held: 2^53 + 1 - 2^53. */
  const double thin[] = {0x1p53, 0x1p53, 1.0, 0.0, 0.0, 0.0};
  rot_inertia_to_second(thin, back);
  ROT_CHECK(back[0] == 0.5 && back[1] == 0.5 && back[2] == 0x1p53 - 0.5);
  const double huge[] = {1.5e308, 1.7e308, 1.6e308, 0.0, 0.0, 0.0};
  rot_inertia_to_second(huge, back);
  ROT_CHECK_REL(back[0], 0.9e308, 3e-16);
  ROT_CHECK_REL(back[1], 0.7e308, 3e-16);
  ROT_CHECK_REL(back[2], 0.8e308, 3e-16);
}

/* ---- moved and turned ----------------------------------------------------------------------- */

static void check_shift(void) {
  const double c[] = {7.0, 5.0, 3.0, 1.0, -2.0, 0.5}, d[] = {1.0, 2.0, -4.0};
  /* + 3 d d' */
  const double want[] = {10.0, 17.0, 51.0, 7.0, -14.0, -23.5};
  double out[6], back[6], inertia[6], moved[6], again[6];
  rot_inertia_shift_second(3.0, d, 1.0, c, out);
  rot_inertia_shift_second(3.0, d, -1.0, out, back);
  for (int k = 0; k < 6; k++) {
    ROT_CHECK(out[k] == want[k]);
    ROT_CHECK(back[k] == c[k]);
  }
  /* The same of the inertia tensor: I + 3 (21 - d d'). */
  rot_inertia_of_second(c, inertia);
  rot_inertia_shift(3.0, d, 1.0, inertia, moved);
  rot_inertia_of_second(want, again);
  for (int k = 0; k < 6; k++) ROT_CHECK(moved[k] == again[k]);
  const double by_hand[] = {8.0 + 3.0 * 20.0, 10.0 + 3.0 * 17.0, 12.0 + 3.0 * 5.0,
                            -1.0 - 3.0 * 2.0, 2.0 + 3.0 * 4.0,   -0.5 + 3.0 * 8.0};
  for (int k = 0; k < 6; k++) ROT_CHECK(moved[k] == by_hand[k]);
  rot_inertia_shift(3.0, d, -1.0, moved, again);
  for (int k = 0; k < 6; k++) ROT_CHECK(again[k] == inertia[k]);
  /* d is squared only together with the mass: 2^-900 kg at 2^450 (1, 2, -4) m and more. */
  const int by[] = {450, 500, -500};
  const double zero[6] = {0.0};
  for (int i = 0; i < 3; i++) {
    const double far[] = {ldexp(1.0, by[i]), ldexp(2.0, by[i]), ldexp(-4.0, by[i])};
    rot_inertia_shift_second(ldexp(3.0, -2 * by[i]), far, 1.0, zero, out);
    for (int k = 0; k < 6; k++) ROT_CHECK(out[k] == 3.0 * d[row_of[k]] * d[column_of[k]]);
  }
  /* 1e-300 kg at 1e150 m; mpmath, 50 digits, of the doubles given. */
  const double far[] = {1e150, 0.0, -3e150};
  rot_inertia_shift_second(1e-300, far, 1.0, zero, out);
  ROT_CHECK_REL(out[ROT_XX], 0.9999999999999999867302842, 5e-16);
  ROT_CHECK_REL(out[ROT_ZZ], 9.000000000000000970830644, 5e-16);
  ROT_CHECK_REL(out[ROT_XZ], -3.000000000000000141900534, 5e-16);
  ROT_CHECK(out[ROT_YY] == 0.0 && out[ROT_XY] == 0.0 && out[ROT_YZ] == 0.0);
}

static void check_rotate(void) {
  /* A quarter turn about z takes x to y and y to -x. */
  const double quarter[9] = {0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0};
  const double c[] = {7.0, 5.0, 3.0, 1.0, -2.0, 0.5};
  const double want[] = {5.0, 7.0, 3.0, -1.0, -0.5, -2.0};
  double out[6], back[6];
  rot_inertia_rotate(quarter, c, out);
  for (int k = 0; k < 6; k++) ROT_CHECK(out[k] == want[k]);
  double worst = 0.0;
  for (int n = 0; n < 2000; n++) {
    double r[9], transposed[9], t[6], size = 0.0;
    random_rotation(r);
    for (int i = 0; i < 9; i++) transposed[i] = r[3 * (i % 3) + i / 3];
    for (int k = 0; k < 6; k++) {
      t[k] = between(-1.0, 1.0);
      size = fmax(size, fabs(t[k]));
    }
    rot_inertia_rotate(r, t, out);
    rot_inertia_rotate(transposed, out, back);
    for (int k = 0; k < 6; k++) {
      rot_dd sum = {0.0, 0.0};
      for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) {
          const int at[9] = {ROT_XX, ROT_XY, ROT_XZ, ROT_XY, ROT_YY,
                             ROT_YZ, ROT_XZ, ROT_YZ, ROT_ZZ};
          const rot_dd rr = rot_dd_mul2(r[3 * row_of[k] + i], r[3 * column_of[k] + j]);
          sum = rot_dd_add(sum, rot_dd_mul1(rr, t[at[3 * i + j]]));
        }
      }
      worst = fmax(worst, fabs((sum.hi - out[k]) + sum.lo) / size);
      ROT_CHECK(fabs(back[k] - t[k]) <= 1e-14 * size);
    }
  }
  printf("rotate: worst %.2g of the largest element\n", worst);
  ROT_CHECK(worst <= 2e-15);
}

/* ---- about an axis -------------------------------------------------------------------------- */

/* sum m |u x (r - p)|^2 of point masses about a centre, in double words; u = n/|n|. */
static double axis_truth(int n, const double mass[], double r[][3], const double axis[3],
                         const double point[3]) {
  rot_dd sum = {0.0, 0.0}, length2 = {0.0, 0.0};
  for (int k = 0; k < 3; k++) length2 = rot_dd_add(length2, rot_dd_mul2(axis[k], axis[k]));
  for (int i = 0; i < n; i++) {
    rot_dd d[3], part = {0.0, 0.0};
    for (int k = 0; k < 3; k++) d[k] = rot_dd_sum2(r[i][k], -point[k]);
    for (int k = 0; k < 3; k++) {
      const int a = (k + 1) % 3, b = (k + 2) % 3;
      const rot_dd cross = rot_dd_sub(rot_dd_mul1(d[b], axis[a]), rot_dd_mul1(d[a], axis[b]));
      part = rot_dd_add(part, rot_dd_mul(cross, cross));
    }
    sum = rot_dd_add(sum, rot_dd_mul1(part, mass[i]));
  }
  sum = rot_dd_div(sum, length2);
  return sum.hi + sum.lo;
}

static void check_axis(void) {
  /* The body of check_conversion() about (3, 0, 4)/5 by hand: (9*50 + 16*27 - 2*12*4)/25. */
  rot_inertial body = {7.0, {0.0, 0.0, 0.0}, {3.0, 24.0, 26.0, 4.0, 4.0, 4.0}};
  const double n[] = {3.0, 0.0, 4.0}, origin[3] = {0.0, 0.0, 0.0};
  ROT_CHECK_REL(rot_inertia_axis(&body, n, origin), 786.0 / 25.0, 4e-16);
  /* The length of n, and where on the axis the point lies, do not matter. */
  for (int e = -1000; e <= 1000; e += 500) {
    const double long_n[] = {ldexp(3.0, e), 0.0, ldexp(4.0, e)};
    ROT_CHECK(rot_inertia_axis(&body, long_n, origin) == rot_inertia_axis(&body, n, origin));
  }
  const double along[] = {6.0, 0.0, 8.0}, beside[] = {4.0, 0.0, -3.0};
  ROT_CHECK_REL(rot_inertia_axis(&body, n, along), 786.0 / 25.0, 4e-16);
  /* 5 m beside the axis: + 7 * 25. */
  ROT_CHECK_REL(rot_inertia_axis(&body, n, beside), 786.0 / 25.0 + 175.0, 4e-16);
  /* A rod about itself: 0 and not less, in any direction. */
  for (int i = 0; i < 500; i++) {
    double u[3], c[6];
    for (int k = 0; k < 3; k++) u[k] = between(-1.0, 1.0);
    for (int k = 0; k < 6; k++) c[k] = u[row_of[k]] * u[column_of[k]];
    rot_inertial rod = {1.0, {0.0, 0.0, 0.0}, {c[0], c[1], c[2], c[3], c[4], c[5]}};
    const double own = rot_inertia_axis(&rod, u, origin);
    ROT_CHECK(own >= 0.0 && own <= 1e-15);
  }
  double worst = 0.0;
  for (int trial = 0; trial < 1000; trial++) {
    /* Four points in pairs about the centre, so that its place is exact. */
    double mass[4], r[4][3], axis[3], point[3];
    rot_inertial b = {0.0, {0.0, 0.0, 0.0}, {0.0}};
    for (int k = 0; k < 3; k++) {
      b.centre_m[k] = floor(between(-8.0, 8.0));
      axis[k] = between(-1.0, 1.0);
      point[k] = between(-4.0, 4.0);
    }
    for (int i = 0; i < 4; i++) {
      mass[i] = i % 2 ? mass[i - 1] : between(0.5, 2.0);
      b.mass_kg += mass[i];
      for (int k = 0; k < 3; k++) {
        const double x = i % 2 ? b.centre_m[k] - r[i - 1][k] : floor(between(-64.0, 64.0)) / 8.0;
        r[i][k] = b.centre_m[k] + x;
      }
      for (int k = 0; k < 6; k++) {
        b.second_kg_m2[k] += mass[i] * (r[i][row_of[k]] - b.centre_m[row_of[k]]) *
                             (r[i][column_of[k]] - b.centre_m[column_of[k]]);
      }
    }
    const double got = rot_inertia_axis(&b, axis, point);
    const double want = axis_truth(4, mass, r, axis, point);
    /* Against the largest moment about the point, where the axis misses little. */
    double scale = 0.0;
    for (int i = 0; i < 4; i++) {
      for (int k = 0; k < 3; k++) scale += mass[i] * (r[i][k] - point[k]) * (r[i][k] - point[k]);
    }
    worst = fmax(worst, fabs(got - want) / scale);
    /* The same with all masses and lengths scaled, up to what the moment can be. */
    const int mass_by = trial % 2 ? 990 : -990, length_by = trial % 2 ? -490 : 490;
    rot_inertial far = b;
    double far_point[3];
    far.mass_kg = ldexp(b.mass_kg, mass_by);
    for (int k = 0; k < 3; k++) {
      far.centre_m[k] = ldexp(b.centre_m[k], length_by);
      far_point[k] = ldexp(point[k], length_by);
    }
    for (int k = 0; k < 6; k++) {
      far.second_kg_m2[k] = ldexp(b.second_kg_m2[k], mass_by + 2 * length_by);
    }
    ROT_CHECK_REL(rot_inertia_axis(&far, axis, far_point), ldexp(got, mass_by + 2 * length_by),
                  1e-15);
  }
  printf("axis: worst %.2g of the trace\n", worst);
  ROT_CHECK(worst <= 1e-15);
}

/* ---- principal axes ------------------------------------------------------------------------- */

/* What holds for every result: ascending moments, right-handed, orthogonal, the sign rule.
 * Returns how far V'V is from 1. */
static double check_frame(const rot_principal *p) {
  double skew = 0.0;
  const double *v = p->axes;
  for (int i = 0; i < 3; i++) {
    for (int j = 0; j < 3; j++) {
      const double dot = (v[i] * v[j] + v[3 + i] * v[3 + j]) + v[6 + i] * v[6 + j];
      skew = fmax(skew, fabs(dot - (i == j)));
    }
  }
  ROT_CHECK(p->second[0] >= p->second[1] && p->second[1] >= p->second[2]);
  ROT_CHECK(p->moment[0] <= p->moment[1] && p->moment[1] <= p->moment[2]);
  const double det = v[0] * (v[4] * v[8] - v[5] * v[7]) - v[1] * (v[3] * v[8] - v[5] * v[6]) +
                     v[2] * (v[3] * v[7] - v[4] * v[6]);
  ROT_CHECK(fabs(det - 1.0) <= 4e-15);
  for (int k = 0; k < 2; k++) {
    double max = 0.0, min = 0.0;
    for (int i = 0; i < 3; i++) {
      max = fmax(max, v[3 * i + k]);
      min = fmin(min, v[3 * i + k]);
    }
    /* Of two of one size the first decides. */
    ROT_CHECK(max >= -min * (1.0 - 2e-8));
  }
  return skew;
}

/* max |V diag V' - C| / max |C| */
static double misfit(const rot_principal *p, const double c[6]) {
  double off = 0.0, size = 0.0;
  for (int k = 0; k < 6; k++) {
    double sum = 0.0;
    for (int j = 0; j < 3; j++) {
      sum += p->second[j] * p->axes[3 * row_of[k] + j] * p->axes[3 * column_of[k] + j];
    }
    off = fmax(off, fabs(sum - c[k]));
    size = fmax(size, fabs(c[k]));
  }
  return off / size;
}

static void check_shared_table(void) {
  FILE *file = shared_table("refs/eig3.csv");
  double x[9], worst = 0.0;
  long rows = 0;
  if (!file) return;
  while (shared_row(file, 9, x)) {
    const double c[6] = {x[0], x[3], x[5], x[1], x[2], x[4]};
    rot_principal p;
    ROT_CHECK_EQ_INT(rot_inertia_principal(c, 1e-12, &p), ROT_OK);
    for (int k = 0; k < 3; k++) {
      ROT_CHECK_REL(p.second[k], x[8 - k], 1e-15);
      worst = fmax(worst, rot_test_rel(p.second[k], x[8 - k]));
    }
    ROT_CHECK_REL(p.moment[0], x[7] + x[6], 1e-15);
    ROT_CHECK_REL(p.moment[1], x[8] + x[6], 1e-15);
    ROT_CHECK_REL(p.moment[2], x[8] + x[7], 1e-15);
    ROT_CHECK(check_frame(&p) <= 2e-15);
    ROT_CHECK(misfit(&p, c) <= 3e-14);
    rows++;
  }
  printf("second moments: worst %.2g relative\n", worst);
  ROT_CHECK(rows >= 20);
}

static void check_random_axes(void) {
  double skew = 0.0, off = 0.0;
  for (int trial = 0; trial < 4000; trial++) {
    const double grade = trial % 4 == 3 ? 1e-9 : 1.0;
    const double values[3] = {between(1.0, 2.0), between(0.1, 1.0) * grade,
                              trial % 3 ? between(0.0, 0.1) * grade * grade : 0.0};
    double r[9], t[6];
    random_rotation(r);
    const double diagonal[6] = {values[0], values[1], values[2], 0.0, 0.0, 0.0};
    rot_inertia_rotate(r, diagonal, t);
    const int by = trial % 5 == 0 ? 900 : trial % 5 == 1 ? -900 : 0;
    for (int k = 0; k < 6; k++) t[k] = ldexp(t[k], by);
    rot_principal p;
    ROT_CHECK_EQ_INT(rot_inertia_principal(t, 1e-12, &p), ROT_OK);
    skew = fmax(skew, check_frame(&p));
    off = fmax(off, misfit(&p, t));
    ROT_CHECK(fabs(ldexp(p.second[0], -by) - values[0]) <= 4e-15);
    ROT_CHECK(fabs(ldexp(p.moment[1], -by) - (values[0] + values[2])) <= 4e-15);
  }
  printf("axes: V'V - 1 at most %.2g, V diag V' - C %.2g of the largest\n", skew, off);
  ROT_CHECK(skew <= 2e-15);
  ROT_CHECK(off <= 4e-15);
}

static void check_axis_is(const rot_principal *p, int k, double x, double y, double z) {
  const double want[3] = {x, y, z};
  for (int i = 0; i < 3; i++) ROT_CHECK(fabs(p->axes[3 * i + k] - want[i]) <= 4e-16);
}

/* Of two components of an axis that differ by more than rounding, the larger is positive. */
static void check_signs(void) {
  for (int k = 0; k < 2; k++) {
    const double a = k ? -0.6 : -0.6 * (1.0 + 1e-6), b = k ? 0.6 * (1.0 + 1e-6) : 0.6;
    const double length = a * a + b * b;
    /* C = 1 + n n' / 2 with n along (a, b, 0), and 3 along z; the axis across n follows. */
    const double c[] = {1.0 + 0.5 * a * a / length,
                        1.0 + 0.5 * b * b / length,
                        3.0,
                        0.5 * a * b / length,
                        0.0,
                        0.0};
    rot_principal p;
    ROT_CHECK_EQ_INT(rot_inertia_principal(c, 1e-12, &p), ROT_OK);
    for (int axis = 0; axis < 3; axis++) {
      if (fabs(p.axes[axis]) < 0.5 || fabs(fabs(p.axes[axis]) - fabs(a / sqrt(length))) > 1e-9) {
        continue;
      }
      ROT_CHECK(p.axes[3 * k + axis] > 0.0 && p.axes[3 * (1 - k) + axis] < 0.0);
    }
  }
}

/* Equal moments: coordinate axes where they will do. */
static void check_equal(void) {
  rot_principal p;
  const double ball[] = {2.0, 2.0, 2.0, 0.0, 0.0, 0.0};
  ROT_CHECK_EQ_INT(rot_inertia_principal(ball, 1e-12, &p), ROT_OK);
  ROT_CHECK(p.equal12 && p.equal23);
  for (int i = 0; i < 9; i++) ROT_CHECK(p.axes[i] == (i % 4 == 0));
  for (int k = 0; k < 3; k++) ROT_CHECK(p.moment[k] == 4.0);

  /* A disk across z: axis 3 is z, axes 1 and 2 are x and y. */
  const double disk[] = {1.0, 1.0, 0.0, 0.0, 0.0, 0.0};
  ROT_CHECK_EQ_INT(rot_inertia_principal(disk, 1e-12, &p), ROT_OK);
  ROT_CHECK(p.equal12 && !p.equal23);
  for (int i = 0; i < 9; i++) ROT_CHECK(p.axes[i] == (i % 4 == 0));
  ROT_CHECK(p.moment[2] == p.moment[0] + p.moment[1]);

  /* A disk across x: y, z, x. */
  const double wheel[] = {0.0, 1.0, 1.0, 0.0, 0.0, 0.0};
  ROT_CHECK_EQ_INT(rot_inertia_principal(wheel, 1e-12, &p), ROT_OK);
  check_axis_is(&p, 0, 0.0, 1.0, 0.0);
  check_axis_is(&p, 1, 0.0, 0.0, 1.0);
  check_axis_is(&p, 2, 1.0, 0.0, 0.0);

  /* The same disk tilted about x, its normal at (0, 0.6, 0.8): x stays. C = 1 - n n'. */
  const double tilted[] = {1.0, 0.64, 0.36, 0.0, 0.0, -0.48};
  ROT_CHECK_EQ_INT(rot_inertia_principal(tilted, 1e-12, &p), ROT_OK);
  ROT_CHECK(p.equal12 && !p.equal23);
  check_axis_is(&p, 0, 1.0, 0.0, 0.0);
  check_axis_is(&p, 1, 0.0, 0.8, -0.6);
  check_axis_is(&p, 2, 0.0, 0.6, 0.8);

  /* A rod along (0, -0.6, 0.8): axis 1 along it, its largest component positive; axis 2 is x. */
  const double rod[] = {0.0, 0.36, 0.64, 0.0, 0.0, -0.48};
  ROT_CHECK_EQ_INT(rot_inertia_principal(rod, 1e-12, &p), ROT_OK);
  ROT_CHECK(!p.equal12 && p.equal23);
  check_axis_is(&p, 0, 0.0, -0.6, 0.8);
  check_axis_is(&p, 1, 1.0, 0.0, 0.0);
  check_axis_is(&p, 2, 0.0, 0.8, 0.6);

  /* Nothing at all: the coordinate axes. */
  const double nothing[6] = {0.0};
  ROT_CHECK_EQ_INT(rot_inertia_principal(nothing, 1e-12, &p), ROT_OK);
  for (int i = 0; i < 9; i++) ROT_CHECK(p.axes[i] == (i % 4 == 0));

  /* The tolerance is of the largest second moment, and its edge counts as equal. */
  const double near[] = {4.0, 4.0 - 0x1p-20, 1.0, 0.0, 0.0, 0.0};
  ROT_CHECK_EQ_INT(rot_inertia_principal(near, 0x1p-22, &p), ROT_OK);
  ROT_CHECK(p.equal12 && !p.equal23);
  ROT_CHECK_EQ_INT(rot_inertia_principal(near, 0x1p-23, &p), ROT_OK);
  ROT_CHECK(!p.equal12);

  const double bad[] = {1.0, NAN, 1.0, 0.0, 0.0, 0.0}, endless[] = {1.0, 1.0, INFINITY, 0, 0, 0};
  ROT_CHECK(rot_inertia_principal(bad, 1e-12, &p) != ROT_OK);
  ROT_CHECK(rot_inertia_principal(endless, 1e-12, &p) != ROT_OK);
}

/* ---- several bodies as one ------------------------------------------------------------------ */

static void check_join_by_hand(void) {
  /* 1 kg at 0 and 3 kg at 4 m: centre at 3 m, 1*9 + 3*1; and what they have of their own. */
  const rot_inertial two[] = {{1.0, {0.0, 5.0, 0.0}, {0.5, 0.25, 0.0, 0.0, 0.125, 0.0}},
                              {3.0, {4.0, 5.0, 0.0}, {1.0, 2.0, 3.0, -1.0, 0.0, 0.5}}};
  const double want[] = {13.5, 2.25, 3.0, -1.0, 0.125, 0.5};
  rot_inertial whole;
  double error;
  ROT_CHECK_EQ_INT(rot_inertia_join(2, two, &whole, &error), ROT_OK);
  ROT_CHECK(whole.mass_kg == 4.0);
  ROT_CHECK(whole.centre_m[0] == 3.0 && whole.centre_m[1] == 5.0 && whole.centre_m[2] == 0.0);
  for (int k = 0; k < 6; k++) ROT_CHECK(whole.second_kg_m2[k] == want[k]);
  ROT_CHECK(error > 0.0 && error < 1e-14);
  /* Products: 2 kg at (1, 1, 0) and at (-1, -1, 0): Cxy = 4. */
  const rot_inertial pair[] = {{2.0, {1.0, 1.0, 0.0}, {0.0}}, {2.0, {-1.0, -1.0, 0.0}, {0.0}}};
  ROT_CHECK_EQ_INT(rot_inertia_join(2, pair, &whole, &error), ROT_OK);
  ROT_CHECK(whole.second_kg_m2[ROT_XY] == 4.0 && whole.second_kg_m2[ROT_XX] == 4.0);
  /* A hole gives back what joining had put in. */
  const rot_inertial both = {4.0, {3.0, 5.0, 0.0}, {13.5, 2.25, 3.0, -1.0, 0.125, 0.5}};
  const rot_inertial cut[] = {both, {-3.0, {4.0, 5.0, 0.0}, {-1.0, -2.0, -3.0, 1.0, 0.0, -0.5}}};
  ROT_CHECK_EQ_INT(rot_inertia_join(2, cut, &whole, &error), ROT_OK);
  ROT_CHECK(whole.mass_kg == 1.0 && whole.centre_m[0] == 0.0 && whole.centre_m[1] == 5.0);
  for (int k = 0; k < 6; k++) ROT_CHECK(whole.second_kg_m2[k] == two[0].second_kg_m2[k]);
  /* One body is itself, bit for bit, wherever it is. */
  const rot_inertial one = {0.3, {1e8, -0.7, 1e-3}, {0.1, 0.2, 0.3, 0.01, 0.02, 0.03}};
  ROT_CHECK_EQ_INT(rot_inertia_join(1, &one, &whole, &error), ROT_OK);
  ROT_CHECK(memcmp(&whole, &one, sizeof one) == 0);
  /* Massless bodies: 0, and no NaN. */
  const rot_inertial none[] = {{0.0, {1.0, 0.0, 0.0}, {0.0}}, {0.0, {2.0, 0.0, 0.0}, {0.0}}};
  ROT_CHECK_EQ_INT(rot_inertia_join(2, none, &whole, &error), ROT_OK);
  ROT_CHECK(whole.mass_kg == 0.0 && whole.second_kg_m2[0] == 0.0 && error == 0.0);
  ROT_CHECK(isfinite(whole.centre_m[0]));
  /* A massless one far away moves nothing. */
  const rot_inertial light[] = {{2.0, {1.0, 1.0, 0.0}, {0.0}}, {0.0, {1e9, 0.0, 0.0}, {0.0}}};
  ROT_CHECK_EQ_INT(rot_inertia_join(2, light, &whole, &error), ROT_OK);
  ROT_CHECK(whole.centre_m[0] == 1.0 && whole.second_kg_m2[0] == 0.0);
  /* What is all cut away: no figure can be given for what rounding left. */
  const rot_inertial gone[] = {{2.0, {0.0, 0.0, 0.0}, {0.3, 0.3, 0.3, 0.0, 0.0, 0.0}},
                               {-1.0, {0.0, 0.0, 0.0}, {-0.3, -0.3, -0.3, 0.0, 0.0, 0.0}}};
  ROT_CHECK_EQ_INT(rot_inertia_join(2, gone, &whole, &error), ROT_OK);
  ROT_CHECK(whole.second_kg_m2[0] == 0.0 && error > 1.0);
}

static void check_join_range(void) {
  rot_inertial whole;
  double error;
  ROT_CHECK_EQ_INT(rot_inertia_join(0, NULL, &whole, &error), ROT_EVALUE);
  const rot_inertial bad[] = {{NAN, {0.0, 0.0, 0.0}, {0.0}}, {1.0, {0.0, 0.0, 0.0}, {0.0}}};
  ROT_CHECK(rot_inertia_join(2, bad, &whole, &error) != ROT_OK);
  const rot_inertial lost[] = {{1.0, {NAN, 0.0, 0.0}, {0.0}}, {1.0, {0.0, 0.0, 0.0}, {0.0}}};
  ROT_CHECK(rot_inertia_join(2, lost, &whole, &error) != ROT_OK);
  const rot_inertial far[] = {{1.0, {1e200, 0.0, 0.0}, {0.0}}, {1.0, {-1e200, 0.0, 0.0}, {0.0}}};
  ROT_CHECK_EQ_INT(rot_inertia_join(2, far, &whole, &error), ROT_ERANGE);
  /* 1e-300 kg at +-1e150 m: 2e-300 1e300 in all. */
  const rot_inertial thin[] = {{1e-300, {1e150, 0.0, 0.0}, {0.0}},
                               {1e-300, {-1e150, 0.0, 0.0}, {0.0}}};
  ROT_CHECK_EQ_INT(rot_inertia_join(2, thin, &whole, &error), ROT_OK);
  ROT_CHECK_REL(whole.second_kg_m2[0], 2.0, 1e-15);
  ROT_CHECK(whole.centre_m[0] == 0.0);
  /* A large light body: the second moment alone is far above the mass. */
  const rot_inertial simd[] = {{1e-300, {0.0, 0.0, 0.0}, {1e300, 1e300, 0.0, 0.0, 0.0, 0.0}},
                               {1e-300, {0.0, 0.0, 0.0}, {1e300, 1e300, 0.0, 0.0, 0.0, 0.0}}};
  ROT_CHECK_EQ_INT(rot_inertia_join(2, simd, &whole, &error), ROT_OK);
  ROT_CHECK_REL(whole.second_kg_m2[0], 2e300, 1e-15);
  /* And a heavy small one. */
  const rot_inertial dense[] = {{1e300, {0.0, 0.0, 0.0}, {1e-300, 1e-300, 0.0, 0.0, 0.0, 0.0}},
                                {1e300, {0.0, 0.0, 0.0}, {1e-300, 1e-300, 0.0, 0.0, 0.0, 0.0}}};
  ROT_CHECK_EQ_INT(rot_inertia_join(2, dense, &whole, &error), ROT_OK);
  ROT_CHECK_REL(whole.second_kg_m2[0], 2e-300, 1e-15);
}

/* The same sums in double words. The centre comes out about part 0's. */
static void join_truth(size_t n, const rot_inertial part[], rot_dd second[6], rot_dd centre[3]) {
  rot_dd mass = {0.0, 0.0}, first[3];
  for (int k = 0; k < 3; k++) first[k] = mass;
  for (size_t i = 0; i < n; i++) {
    mass = rot_dd_add1(mass, part[i].mass_kg);
    for (int k = 0; k < 3; k++) {
      const rot_dd x = rot_dd_sum2(part[i].centre_m[k], -part[0].centre_m[k]);
      first[k] = rot_dd_add(first[k], rot_dd_mul1(x, part[i].mass_kg));
    }
  }
  for (int k = 0; k < 3; k++) centre[k] = rot_dd_div(first[k], mass);
  for (int k = 0; k < 6; k++) second[k] = (rot_dd){0.0, 0.0};
  for (size_t i = 0; i < n; i++) {
    rot_dd d[3];
    for (int k = 0; k < 3; k++) {
      d[k] = rot_dd_sub(rot_dd_sum2(part[i].centre_m[k], -part[0].centre_m[k]), centre[k]);
    }
    for (int k = 0; k < 6; k++) {
      const rot_dd dd = rot_dd_mul(d[row_of[k]], d[column_of[k]]);
      second[k] = rot_dd_add(second[k], rot_dd_mul1(dd, part[i].mass_kg));
      second[k] = rot_dd_add1(second[k], part[i].second_kg_m2[k]);
    }
  }
}

/* Random bodies near and far from the origin, with holes or without, scaled by powers of two: the
 * bound covers the truth each time, and is not far above it in the median. */
enum { TRIALS = 4000 };

static int ascending(const void *a, const void *b) {
  const double x = *(const double *)a, y = *(const double *)b;
  return (x > y) - (x < y);
}

static void check_join_random(void) {
  static rot_inertial part[40];
  static double ratio[TRIALS];
  double worst_far = 0.0;
  int counted = 0;
  for (int trial = 0; trial < TRIALS; trial++) {
    const size_t n = 2 + (size_t)(uniform() * 38.0);
    const double offset = trial % 3 == 0 ? 0.0 : trial % 3 == 1 ? 1e4 : 1e8;
    const double own = pow(10.0, between(-6.0, 1.0));
    const double shift[3] = {between(-1.0, 1.0), between(-1.0, 1.0), between(-1.0, 1.0)};
    for (size_t i = 0; i < n; i++) {
      const double u = between(-1.0, 1.0);
      double sign = 1.0;
      part[i].mass_kg = i == 0 ? 10.0 + 40.0 * uniform() : pow(10.0, between(-3.0, 0.0));
      if (trial % 2 && i > n / 2) sign = -1.0;
      for (int k = 0; k < 3; k++) part[i].centre_m[k] = offset * shift[k] + between(-1.0, 1.0);
      for (int k = 0; k < 3; k++) {
        part[i].second_kg_m2[k] = sign * own * part[i].mass_kg * (1.0 + uniform());
        part[i].second_kg_m2[3 + k] = sign * own * part[i].mass_kg * u * 0.5;
      }
      part[i].mass_kg *= sign;
    }
    rot_inertial whole;
    rot_dd second[6], centre[3];
    double error, trace = 0.0, off = 0.0;
    ROT_CHECK_EQ_INT(rot_inertia_join(n, part, &whole, &error), ROT_OK);
    join_truth(n, part, second, centre);
    for (int k = 0; k < 3; k++) {
      trace += second[k].hi;
      /* Rounded once, at the size of the coordinate. */
      const double c = part[0].centre_m[k], at = c + centre[k].hi;
      ROT_CHECK(fabs(whole.centre_m[k] - at) <= 4e-16 * fabs(at) + 1e-15);
    }
    for (int k = 0; k < 6; k++) {
      off = fmax(off, fabs((whole.second_kg_m2[k] - second[k].hi) - second[k].lo));
    }
    if (!(trace > 0.0)) continue;
    ROT_CHECK(off / trace <= error);
    ratio[counted++] = error * trace / fmax(off, 0x1p-54 * trace);
    if (trial % 2 == 0) worst_far = fmax(worst_far, off / trace);
  }
  qsort(ratio, (size_t)counted, sizeof ratio[0], ascending);
  printf("join: bound over truth %.2g in the median, %.2g at least; without holes %.2g off\n",
         ratio[counted / 2], ratio[0], worst_far);
  ROT_CHECK(counted > TRIALS / 2);
  ROT_CHECK(ratio[counted / 2] < 50.0);
  ROT_CHECK(worst_far <= 1e-15);
}

/* Powers of two, and what they must do to the result. */
static void check_join_scales(void) {
  rot_inertial part[5], scaled[5], whole, far;
  double error, error_far;
  for (int i = 0; i < 5; i++) {
    part[i].mass_kg = between(0.5, 2.0);
    for (int k = 0; k < 3; k++) part[i].centre_m[k] = between(-1.0, 1.0);
    for (int k = 0; k < 6; k++) part[i].second_kg_m2[k] = k < 3 ? between(0.1, 1.0) : 0.01;
  }
  ROT_CHECK_EQ_INT(rot_inertia_join(5, part, &whole, &error), ROT_OK);
  const int mass_by[] = {996, -996, 0, 0, 900}, length_by[] = {-400, 400, 500, -450, -900};
  for (int s = 0; s < 5; s++) {
    /* 2^900 2^-1800 is beneath the smallest double: its second moments are exactly 0. */
    const int both = mass_by[s] + 2 * length_by[s];
    if (both < -1000) continue;
    for (int i = 0; i < 5; i++) {
      scaled[i].mass_kg = ldexp(part[i].mass_kg, mass_by[s]);
      for (int k = 0; k < 3; k++) scaled[i].centre_m[k] = ldexp(part[i].centre_m[k], length_by[s]);
      for (int k = 0; k < 6; k++) scaled[i].second_kg_m2[k] = ldexp(part[i].second_kg_m2[k], both);
    }
    ROT_CHECK_EQ_INT(rot_inertia_join(5, scaled, &far, &error_far), ROT_OK);
    ROT_CHECK(far.mass_kg == ldexp(whole.mass_kg, mass_by[s]));
    for (int k = 0; k < 3; k++) {
      ROT_CHECK(far.centre_m[k] == ldexp(whole.centre_m[k], length_by[s]));
    }
    for (int k = 0; k < 6; k++)
      ROT_CHECK(far.second_kg_m2[k] == ldexp(whole.second_kg_m2[k], both));
    ROT_CHECK_REL(error_far, error, 1e-12);
  }
}

/* No axis has a zero with a sign, whatever the order and the signs of the axes of the tensor. */
static void check_zeros(void) {
  static const int order[6][3] = {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}};
  for (int k = 0; k < 6; k++) {
    for (int product = 0; product < 7; product++) {
      double c[6] = {0.0};
      for (int i = 0; i < 3; i++) c[i] = 1.0 + order[k][i];
      if (product) c[3 + (product - 1) / 2] = product % 2 ? 0.25 : -0.25;
      rot_principal p;
      ROT_CHECK_EQ_INT(rot_inertia_principal(c, 0.0, &p), ROT_OK);
      for (int i = 0; i < 3; i++) {
        const double x = p.axes[3 * i + 2];
        ROT_CHECK(x < 0.0 || x > 0.0 || !signbit(x));
      }
    }
  }
}

int main(void) {
  check_conversion();
  check_shift();
  check_rotate();
  check_axis();
  check_shared_table();
  check_random_axes();
  check_signs();
  check_equal();
  check_join_by_hand();
  check_join_range();
  check_join_random();
  check_join_scales();
  check_zeros();
  return rot_test_report("inertia");
}
