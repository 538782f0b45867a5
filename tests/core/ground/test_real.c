/* Error-free transforms, products of any size, and the sine and cosine of degrees. The references
 * are exact rational arithmetic and 60-digit values. */
#include <float.h>

#include "ground/real.h"
#include "rot_test.h"

/* In [-1, 1), the same numbers on every machine. */
static uint64_t seed = 7;
static double uniform(void) {
  seed = seed * 6364136223846793005u + 1442695040888963407u;
  return (double)(seed >> 11) * 0x1p-52 - 1.0;
}

/* ---- sums and products ---------------------------------------------------------------------- */

static void check_two_sum(void) {
  double lo;
  ROT_CHECK(rot_two_sum(1.0, 0x1p-60, &lo) == 1.0 && lo == 0x1p-60);
  ROT_CHECK(rot_two_sum(0x1p-60, 1.0, &lo) == 1.0 && lo == 0x1p-60); /* in either order */
  ROT_CHECK(rot_two_sum(1.0, -0x1p-60, &lo) == 1.0 && lo == -0x1p-60);
  ROT_CHECK(rot_two_sum(1.0, 0x1.8p-53, &lo) == 1.0 + 0x1p-52 && lo == -0x1p-54);
  ROT_CHECK(rot_two_sum(3.0, -3.0, &lo) == 0.0 && lo == 0.0);
  ROT_CHECK(rot_two_sum(0x1p1000, 3.0, &lo) == 0x1p1000 && lo == 3.0);
  /* 0.1 + 0.2 lies half way between two doubles. */
  ROT_CHECK(rot_two_sum(0.1, 0.2, &lo) == 0x1.3333333333334p-2 && lo == -0x1p-55);
  /* Nothing is lost: the sum of integers below 2^60 is known in 64 bits. */
  for (int i = 0; i < 200; i++) {
    const int64_t a = (int64_t)(uniform() * 0x1p52), b = (int64_t)(uniform() * 0x1p30);
    const double s = rot_two_sum((double)a * 128.0, (double)b, &lo);
    ROT_CHECK_EQ_INT((int64_t)s + (int64_t)lo, a * 128 + b);
    ROT_CHECK(s == (double)a * 128.0 + (double)b);
  }
}

/* ldexp() of the library rounds once. */
static void check_powers(void) {
  static const int exponents[] = {-1080, -1074, -1023, -1022, -60, -1, 0, 1, 52, 1022, 1023, 1024};
  for (int i = 0; i < 4000; i++) {
    const double x = ldexp(uniform(), (int)(uniform() * 1070.0));
    const int e = i < 12 ? exponents[i] : (int)(uniform() * 1100.0);
    ROT_CHECK(rot_ldexp(x, e) == ldexp(x, e) && rot_ldexp(-x, e) == -ldexp(x, e));
  }
  ROT_CHECK(rot_ldexp(0x1p-1073, 1) == 0x1p-1072 && isinf(rot_ldexp(1.0, 1024)));
  ROT_CHECK(rot_ldexp(3.0, -1074) == 0x1.8p-1073 && signbit(rot_ldexp(-0.0, 7)));
}

static void check_length(void) {
  for (int i = 0; i < 600; i++) {
    const int e = i - 300;
    const double x[] = {ldexp(2.0, 3 * e), ldexp(-3.0, 3 * e), ldexp(6.0, 3 * e)};
    ROT_CHECK(rot_length(x) == ldexp(7.0, 3 * e)); /* 4 + 9 + 36 = 49 */
  }
}

static void check_two_prod(void) {
  double lo;
  ROT_CHECK(rot_two_prod(3.0, 5.0, &lo) == 15.0 && lo == 0.0);
  ROT_CHECK(rot_two_prod(1.0 + 0x1p-30, 1.0 + 0x1p-30, &lo) == 1.0 + 0x1p-29 && lo == 0x1p-60);
  ROT_CHECK(rot_two_prod(1.0 + 0x1p-30, 0x1p-30 - 1.0, &lo) == -1.0 && lo == 0x1p-60);
  for (int i = 0; i < 200; i++) {
    const int64_t a = (int64_t)(uniform() * 0x1p31), b = (int64_t)(uniform() * 0x1p30);
    const double p = rot_two_prod((double)a, (double)b, &lo);
    ROT_CHECK_EQ_INT((int64_t)p + (int64_t)lo, a * b);
  }
}

/* A million numbers of 0.1 and one of -100000: plain summation is off by 1e-6. */
static void check_accumulate(void) {
  double sum = 0.0, lo = 0.0;
  for (int i = 0; i < 1000000; i++) rot_accumulate(&sum, &lo, 0.1);
  rot_accumulate(&sum, &lo, -100000.0);
  ROT_CHECK_ULP(sum + lo, 5.551115123125783e-12, 0);
}

/* ---- a b / c -------------------------------------------------------------------------------- */

static void check_muldiv(void) {
  static const struct {
    double a, b, c, want, residual; /* of the nearest double */
  } row[] = {
      {2.0, 3.0, 7.0, 0.85714285714285714286, 4.7580986769649566018e-17},
      {0.1, 0.3, 0.7, 0.042857142857142860655, 3.1154217527746741002e-18},
      {-3.0, 5.0, 11.0, -1.3636363636363636364, -1.0092936587501423095e-16},
      {1e300, 1e300, 1e300, 1.0000000000000000525e300, 0.0},
      {1e-300, 3e-300, 7e-300, 4.285714285714285957e-301, -1.0149852316479300297e-317},
      {1e300, 1e-300, 3.0, 0.33333333333333335919, -1.1152816790700824264e-17},
      {3e-300, 1e300, 7e200, 4.2857142857142862051e-201, -5.4052240167627343536e-218},
      {1.7e308, 1.9, 3.1, 1.0419354838709676259e308, -5.2806187134526653699e291},
      {5e-324, 3.0, 2e-300, 7.4109846876186979769e-24, -5.7482452015477362412e-40},
      {2.5e-310, 30000000000.0, 7e-300, 1.0714285714285786902, -3.4140319099915168691e-17},
      {1e200, 7e200, 3e300, 2.3333333333333331829e100, -1.2279821465143381159e84},
      {-5.2407074581621727e256, -7391.5440782971455, 12110.803048206899, 3.1985426585069932999e256,
       3.6038749052477821164e238},
      {-8.689422815203738e-288, 81.76368003706496, 0.008890310214920115,
       -7.9916129987987687932e-284, 4.4215968185995692793e-300},
      {-6.16511792009401e180, 81.94777125807762, 121452.98130490026, -4.1597799219652024794e177,
       -2.9728448834045587853e161},
  };
  for (size_t i = 0; i < sizeof row / sizeof row[0]; i++) {
    double lo;
    const double x = rot_muldiv(row[i].a, row[i].b, row[i].c, &lo);
    ROT_CHECK_ULP(x, row[i].want, 1);
    ROT_CHECK_ULP(rot_muldiv(row[i].a, row[i].b, row[i].c, NULL), x, 0);
    /* Both words together hold 100 bits, or what denormalized numbers leave of them. */
    const double off = ((x - row[i].want) + lo) - row[i].residual;
    ROT_CHECK(fabs(off) <= fabs(x) * 0x1p-100 + 0x1p-1074);
  }
}

/* x c + lo c = a b, and lo stays small beside x. */
static void check_muldiv_residual(void) {
  double worst = 0.0;
  for (int i = 0; i < 20000; i++) {
    const double a = uniform(), b = uniform(), c = 0.75 + 0.25 * uniform();
    double lo, ab_lo, xc_lo, x = rot_muldiv(a, b, c, &lo);
    const double ab = rot_two_prod(a, b, &ab_lo), xc = rot_two_prod(x, c, &xc_lo);
    ROT_CHECK(fabs(((ab - xc) + (ab_lo - xc_lo)) - lo * c) <= 0x1p-102 * fabs(ab));
    worst = fmax(worst, fabs(lo / (nextafter(fabs(x), 2.0) - fabs(x))));
  }
  printf("rot_muldiv: %.3f ulp from its residual\n", worst);
  ROT_CHECK(worst <= 1.5);
}

static void check_muldiv_ends(void) {
  double lo = 7.0;
  ROT_CHECK(rot_muldiv(0.0, 3.0, 2.0, &lo) == 0.0 && lo == 0.0);
  ROT_CHECK(rot_muldiv(3.0, 0.0, -2.0, &lo) == 0.0 && lo == 0.0);
  lo = 7.0;
  ROT_CHECK(rot_muldiv(1e300, -1e300, 1e-3, &lo) == -INFINITY && lo == 0.0);
  ROT_CHECK(rot_muldiv(1e-300, 1e-300, 1e3, &lo) == 0.0 && lo == 0.0);
  lo = 7.0;
  ROT_CHECK(isnan(rot_muldiv(NAN, 1.0, 2.0, &lo)) && lo == 0.0);
  ROT_CHECK(isnan(rot_muldiv(1.0, NAN, 2.0, NULL)));
  ROT_CHECK(isnan(rot_muldiv(1.0, 2.0, NAN, NULL)));
  ROT_CHECK(rot_muldiv(INFINITY, -2.0, 3.0, &lo) == -INFINITY && lo == 0.0);
  ROT_CHECK(isnan(rot_muldiv(INFINITY, 0.0, 3.0, NULL)));
  ROT_CHECK(rot_muldiv(3.0, 2.0, INFINITY, &lo) == 0.0 && lo == 0.0);
}

/* ---- products ------------------------------------------------------------------------------- */

static void check_product(void) {
  ROT_CHECK_ULP(rot_product(3, (double[]){2.0, 3.0, 5.0}, 7.0), 30.0 / 7.0, 0);
  ROT_CHECK_ULP(rot_product(1, (double[]){-3.0}, 4.0), -0.75, 0);
  ROT_CHECK_ULP(rot_product(0, (double[]){9.0}, 4.0), 0.25, 0);
  /* Only the first n count. */
  ROT_CHECK_ULP(rot_product(2, (double[]){2.0, 3.0, 5.0}, 1.0), 6.0, 0);
  /* n + 1 roundings: 0.1 0.3 0.7 0.9/1.1, correctly rounded. */
  ROT_CHECK_ULP(rot_product(4, (double[]){0.1, 0.3, 0.7, 0.9}, 1.1), 0.017181818181818180943, 4);
}

/* Neither overflow nor underflow on the way, in whatever order. */
static void check_product_range(void) {
  ROT_CHECK_ULP(rot_product(4, (double[]){1e300, 1e300, 3e-300, 1e-300}, 2.0), 1.5, 4);
  ROT_CHECK_ULP(rot_product(4, (double[]){1e-300, 1e-300, 3e300, 1e300}, 2.0), 1.5, 4);
  ROT_CHECK_ULP(rot_product(3, (double[]){1e300, 1e300, 5.0}, 1e300), 5e300, 4);
  ROT_CHECK_ULP(rot_product(2, (double[]){1e-300, 3e-300}, 1e-300), 3e-300, 3);
  ROT_CHECK_ULP(rot_product(2, (double[]){0x1p-1074, 0x1p-1074}, 0x1p-1074), 0x1p-1074, 0);
  ROT_CHECK_ULP(rot_product(1, (double[]){0x1p-1074}, 0x1p-1070), 0x1p-4, 0);
  ROT_CHECK_ULP(rot_product(2, (double[]){3.0, 0x1p-1074}, 1.0), 3 * 0x1p-1074, 0);
  /* True overflow and underflow end where they must. */
  ROT_CHECK(rot_product(2, (double[]){1e300, -1e300}, 2.0) == -INFINITY);
  ROT_CHECK(rot_product(2, (double[]){1e-300, 1e-300}, 2.0) == 0.0);
}

static void check_product_ends(void) {
  ROT_CHECK(rot_product(2, (double[]){0.0, 5.0}, 2.0) == 0.0);
  ROT_CHECK(isnan(rot_product(2, (double[]){NAN, 5.0}, 2.0)));
  ROT_CHECK(isnan(rot_product(2, (double[]){3.0, 5.0}, NAN)));
  ROT_CHECK(isnan(rot_product(2, (double[]){0.0, INFINITY}, 2.0)));
  ROT_CHECK(rot_product(2, (double[]){-2.0, INFINITY}, 2.0) == -INFINITY);
  ROT_CHECK(rot_product(2, (double[]){-2.0, 3.0}, INFINITY) == 0.0);
}

/* ---- degrees -------------------------------------------------------------------------------- */

/* Where the sine is 0, 1/2 or 1 it is so to the last bit, any number of turns away. */
static void check_exact_degrees(void) {
  static const double sine[12] = {0.0, 0.5, 2.0, 1.0, 2.0, 0.5, 0.0, -0.5, 2.0, -1.0, 2.0, -0.5};
  const double turns[] = {0.0, 360.0, -360.0, 720.0, 3.6e9, -3.6e9, 3.6e14};
  for (int turn = 0; turn < 7; turn++) {
    for (int i = 0; i < 12; i++) { /* 2.0: sqrt(3)/2, which no double is */
      const double deg = 30.0 * i + turns[turn];
      if (fabs(sine[i]) <= 1.0) ROT_CHECK(rot_sin_deg(deg) == sine[i]);
      if (fabs(sine[(i + 3) % 12]) <= 1.0) ROT_CHECK(rot_cos_deg(deg) == sine[(i + 3) % 12]);
    }
    ROT_CHECK_ULP(rot_sin_deg(60.0 + turns[turn]), 0.86602540378443864676, 1);
    ROT_CHECK_ULP(rot_sin_deg(-120.0 + turns[turn]), -0.86602540378443864676, 1);
    ROT_CHECK_ULP(rot_cos_deg(30.0 + turns[turn]), 0.86602540378443864676, 1);
    ROT_CHECK_ULP(rot_cos_deg(150.0 + turns[turn]), -0.86602540378443864676, 1);
  }
}

static void check_degrees(void) {
  static const double row[][3] = {
      {1.0, 0.017452406437283512819, 0.99984769515639123916},
      {10.0, 0.17364817766693034885, 0.98480775301220805937},
      {17.0, 0.2923717047227367281, 0.95630475596303548134},
      {29.0, 0.48480962024633702908, 0.87461970713939580028},
      {29.999999999999996, 0.4999999999999999463, 0.86602540378443867777},
      {31.0, 0.51503807491005421008, 0.85716730070211228747},
      {44.99999999999999, 0.70710678118654743671, 0.70710678118654761209},
      {45.0, 0.7071067811865475244, 0.7071067811865475244},
      {46.0, 0.71933980033865113936, 0.69465837045899728666},
      {59.99999999999999, 0.86602540378443858476, 0.5000000000000001074},
      {61.0, 0.87461970713939580028, 0.48480962024633702908},
      {75.0, 0.96592582628906828675, 0.25881904510252076235},
      {80.0, 0.98480775301220805937, 0.17364817766693034885},
      {89.0, 0.99984769515639123916, 0.017452406437283512819},
      {89.9999999999, 1.0, 1.745360399679057257e-12},
      {90.0000000001, 1.0, -1.745360399679057257e-12},
      {120.5, 0.86162916044152574545, -0.50753836296070416894},
      {135.0, 0.7071067811865475244, -0.7071067811865475244},
      {149.0, 0.51503807491005421008, -0.85716730070211228747},
      {179.99999999999997, 4.9605240860567209237e-16, -1.0},
      {225.0, -0.7071067811865475244, -0.7071067811865475244},
      {271.0, -0.99984769515639123916, 0.017452406437283512819},
      {300.5, -0.86162916044152574545, 0.50753836296070416894},
      {359.9999999, -1.7453296444297237044e-9, 0.99999999999999999848},
      {-1.0, -0.017452406437283512819, 0.99984769515639123916},
      {-20.0, -0.34202014332566873304, 0.93969262078590838405},
      {-100.0, -0.98480775301220805937, -0.17364817766693034885},
      {-200.0, 0.34202014332566873304, -0.93969262078590838405},
      {0.001, 1.7453292519057199977e-5, 0.99999999984769129011},
      {1e-08, 1.7453292519943296134e-10, 0.99999999999999999998},
      {1e-300, 1.7453292519943296207e-302, 1.0},
      {1e-310, 1.7453292519943242448e-312, 1.0},
      {7200010.0, 0.17364817766693034885, 0.98480775301220805937},
      {1000000.0, -0.98480775301220805937, 0.17364817766693034885},
      {123456789.125, -0.1585888927354671611, -0.98734470328297122591},
      {1000000000000003.0, -0.97437006478523522854, 0.22495105434386499805},
      {1e22, -0.98480775301220805937, 0.17364817766693034885},
      {1.7e308, 0.46947156278589077596, -0.88294759285892694203},
      {-10000000000.0, 0.98480775301220805937, 0.17364817766693034885},
  };
  double worst = 0.0;
  for (size_t i = 0; i < sizeof row / sizeof row[0]; i++) {
    ROT_CHECK_ULP(rot_sin_deg(row[i][0]), row[i][1], 1);
    ROT_CHECK_ULP(rot_cos_deg(row[i][0]), row[i][2], 1);
    ROT_CHECK_ULP(rot_sin_deg(-row[i][0]), -row[i][1], 1);
    ROT_CHECK_ULP(rot_cos_deg(-row[i][0]), row[i][2], 1);
    worst = fmax(worst, rot_test_ulp(rot_sin_deg(row[i][0]), row[i][1]));
    worst = fmax(worst, rot_test_ulp(rot_cos_deg(row[i][0]), row[i][2]));
  }
  printf("rot_sin_deg, rot_cos_deg: worst %g ulp\n", worst);
}

/* Reflections: exact, because the reduction is. */
static void check_degree_symmetries(void) {
  for (int i = 0; i < 500; i++) {
    const double deg = (double)(int64_t)(uniform() * 0x1p20) * 0x1p-10; /* 90 - deg is exact */
    const double sine = rot_sin_deg(deg), cosine = rot_cos_deg(deg);
    ROT_CHECK(rot_sin_deg(90.0 - deg) == cosine);
    ROT_CHECK(rot_sin_deg(180.0 - deg) == sine);
    ROT_CHECK(rot_cos_deg(180.0 - deg) == -cosine);
    ROT_CHECK(rot_sin_deg(deg + 360.0) == sine);
    ROT_CHECK(rot_cos_deg(deg + 90.0) == -sine);
    ROT_CHECK(fabs(sine * sine + cosine * cosine - 1.0) <= 4.0 * ROT_EPS);
  }
}

/* An odd and an even function to the last bit, at half quarters and beside them. */
static void check_degree_parity(void) {
  for (int i = 0; i <= 40; i++) {
    for (int side = -1; side <= 1; side++) {
      const double deg = side ? nextafter(45.0 * i, side * HUGE_VAL) : 45.0 * i;
      ROT_CHECK(rot_sin_deg(-deg) == -rot_sin_deg(deg));
      ROT_CHECK(rot_cos_deg(-deg) == rot_cos_deg(deg));
    }
  }
}

static void check_degree_ends(void) {
  ROT_CHECK(rot_sin_deg(0.0) == 0.0 && rot_cos_deg(0.0) == 1.0);
  ROT_CHECK(rot_sin_deg(DBL_MIN) > 0.0 && rot_cos_deg(DBL_MIN) == 1.0);
  ROT_CHECK(isnan(rot_sin_deg(NAN)) && isnan(rot_cos_deg(NAN)));
  ROT_CHECK(isnan(rot_sin_deg(INFINITY)) && isnan(rot_cos_deg(-INFINITY)));
}

/* mpmath, 60 digits: 0.3 * 0.7 * 9.80665 of these doubles, and 0.1 more. */
static void check_sum_product(void) {
  const double x[] = {0.3, 0.7, 9.80665}, large[] = {1e300, 1e300, 1e-300}, zero[] = {0.0, 5.0};
  double lo, hi = rot_sum_product(0.0, 3, x, &lo);
  ROT_CHECK(hi == 2.0593964999999996 && fabs(lo - 4.1826153651669544e-17) < 1e-31);
  hi = rot_sum_product(0.1, 3, x, &lo);
  ROT_CHECK(hi == 2.1593964999999997 && fabs(lo + 4.1440573195217196e-17) < 1e-31);
  hi = rot_sum_product(0.0, 3, large, &lo);
  ROT_CHECK(fabs(hi / 1e300 - 1.0) < 4.0 * ROT_EPS && isfinite(lo));
  ROT_CHECK(rot_sum_product(3.0, 2, zero, &lo) == 3.0 && lo == 0.0);
  ROT_CHECK(rot_sum_product(0.0, 2, zero, &lo) == 0.0 && lo == 0.0);
  ROT_CHECK(isinf(rot_sum_product(0.0, 2, large, &lo)) && lo == 0.0);
  ROT_CHECK(isnan(rot_sum_product(NAN, 2, zero, &lo)));
}

/* One that is not finite, at each place; sums of the others are beyond the doubles. */
static void check_all_finite(void) {
  static const double bad[] = {NAN, -NAN, INFINITY, -INFINITY};
  double x[13];
  for (size_t n = 0; n <= 13; n++) {
    for (size_t i = 0; i < 13; i++) x[i] = i % 3 == 2 ? 4.9e-324 : i % 3 ? DBL_MAX : -DBL_MAX;
    ROT_CHECK(rot_all_finite(n, x));
    for (size_t i = 0; i < 13; i++) {
      for (size_t k = 0; k < 4; k++) {
        const double good = x[i];
        x[i] = bad[k];
        ROT_CHECK(rot_all_finite(n, x) == (i >= n));
        x[i] = good;
      }
    }
  }
}

int main(void) {
  check_all_finite();
  check_two_sum();
  check_powers();
  check_length();
  check_two_prod();
  check_accumulate();
  check_muldiv();
  check_muldiv_residual();
  check_muldiv_ends();
  check_product();
  check_product_range();
  check_product_ends();
  check_sum_product();
  check_exact_degrees();
  check_degrees();
  check_degree_symmetries();
  check_degree_parity();
  check_degree_ends();
  return rot_test_report("real");
}
