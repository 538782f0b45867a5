/* Rolling down an incline: literal answers, limits, and the table against the single formulas to
 * the last bit. */
#include "tables/rolling.h"
#include "ground/real.h"
#include "rot_test.h"

/* ---- single formulas ------------------------------------------------------------------------ */

static void check_known_values(void) {
  static const struct {
    double beta, angle, height, gravity, acceleration, speed, rotational, translational, friction;
  } row[] = {
      {1.0, 20.0, 1.0, 9.80665, 1.677035919272334542, 3.131557120666969316, 0.5, 0.5,
       0.1819851171331011807},
      {0.4, 20.0, 1.0, 9.80665, 2.395765598960477879, 3.742926662385999643, 0.2857142857142857256,
       0.7142857142857142744, 0.1039914955046292502},
      {0.5, 20.0, 3.0, 9.80665, 2.236047892363112722, 6.263114241333938633, 0.3333333333333333333,
       0.6666666666666666667, 0.1213234114220674538},
      {0.6666666666666666, 35.0, 2.0, 1.62, 0.5575162961332168545, 1.971801207018598095,
       0.3999999999999999867, 0.6000000000000000133, 0.2800830152838839025},
      {0.0, 20.0, 2.0, 9.80665, 3.354071838544669084, 6.263114241333938633, 0.0, 1.0, 0.0},
      {3.0, 30.0, 7.0, 2.0, 0.25, 2.645751311064590591, 0.75, 0.25, 0.4330127018922193234},
      {2.5, -20.0, 0.3, 9.80665, -0.9583062395841911667, 1.29658782965135063, 0.7142857142857142857,
       0.2857142857142857143, 0.2599787387615731153},
      {0.4, 90.0, 2.0, 9.80665, 7.004749999999999477, 5.29329764891414338, 0.2857142857142857256,
       0.7142857142857142744, INFINITY},
      {0.4, 89.9999999999, 2.0, 9.80665, 7.004749999999999477, 5.29329764891414338,
       0.2857142857142857256, 0.7142857142857142744, 1.636993057518801445e11},
      {1e-300, 20.0, 3.0, 9.8, 3.351797404591553827, 7.668115805072325866,
       1.000000000000000025e-300, 1.0, 3.639702342662023705e-301},
      {1e300, 20.0, 3.0, 9.8, 3.351797404591553651e-300, 7.668115805072325665e-150, 1.0,
       9.999999999999999475e-301, 0.3639702342662023614},
      {0.4, 1e-300, 1e-300, 9.8, 1.221730476396030804e-301, 3.741657386773941538e-150,
       0.2857142857142857256, 0.7142857142857142744, 4.986655005698084828e-303},
      {0.4, 20.0, 1e300, 1e300, 2.443001023754776754e299, 1.195228609334393693e300,
       0.2857142857142857256, 0.7142857142857142744, 0.1039914955046292502},
      {0.4, 20.0, 1e-300, 3e-300, 7.329003071264330466e-301, 2.070196678027062746e-300,
       0.2857142857142857256, 0.7142857142857142744, 0.1039914955046292502},
      {3.0, 200.0, 5.0, 1e-10, -8.550503583141718638e-12, 1.581138830084189695e-5, 0.75, 0.25,
       0.272977675699651771},
      {0.4, 20.0, 7e307, 9.8, 2.394141003279681267, 3.130495168499705725e154, 0.2857142857142857256,
       0.7142857142857142744, 0.1039914955046292502},
      {1e308, 20.0, 2.0, 9.8, 3.35179740459155379e-308, 6.260990336999411343e-154, 1.0,
       9.99999999999999989e-309, 0.3639702342662023614},
  };
  double worst = 0.0;
  for (size_t i = 0; i < sizeof row / sizeof row[0]; i++) {
    const double beta = row[i].beta, angle = row[i].angle, g = row[i].gravity;
    const double got[] = {
        rot_rolling_acceleration(beta, angle, g), rot_rolling_final_speed(beta, row[i].height, g),
        rot_rolling_rotational_fraction(beta), rot_rolling_translational_fraction(beta),
        rot_rolling_friction(beta, angle)};
    const double want[] = {row[i].acceleration, row[i].speed, row[i].rotational,
                           row[i].translational, row[i].friction};
    for (int k = 0; k < 5; k++) {
      ROT_CHECK_ULP(got[k], want[k], 4);
      worst = fmax(worst, rot_test_ulp(got[k], want[k]));
    }
  }
  printf("rolling: worst %g ulp\n", worst);
}

/* A slope of 30 degrees has sine 1/2 to the last bit; beta 3 takes three parts of four. */
static void check_by_head(void) {
  ROT_CHECK(rot_rolling_acceleration(3.0, 30.0, 8.0) == 1.0);
  ROT_CHECK(rot_rolling_acceleration(3.0, -30.0, 8.0) == -1.0);
  ROT_CHECK(rot_rolling_acceleration(3.0, 150.0, 8.0) == 1.0);
  ROT_CHECK(rot_rolling_acceleration(3.0, 0.0, 8.0) == 0.0);
  ROT_CHECK(rot_rolling_acceleration(0.0, 90.0, 9.80665) == 9.80665);
  ROT_CHECK(rot_rolling_final_speed(3.0, 6.0, 3.0) == 3.0); /* sqrt(2 3 6/4) */
  ROT_CHECK(rot_rolling_final_speed(0.0, 8.0, 4.0) == 8.0);
  ROT_CHECK(rot_rolling_final_speed(3.0, 0.0, 9.8) == 0.0);
  ROT_CHECK(rot_rolling_final_speed(3.0, 5.0, 0.0) == 0.0);
  ROT_CHECK(rot_rolling_rotational_fraction(3.0) == 0.75);
  ROT_CHECK(rot_rolling_translational_fraction(3.0) == 0.25);
  ROT_CHECK_ULP(rot_rolling_friction(3.0, 45.0), 0.75, 1);
  ROT_CHECK_ULP(rot_rolling_friction(3.0, -45.0), 0.75, 1);
}

/* The friction needed grows without end towards 90 degrees; what need not spin needs none. */
static void check_friction_at_ends(void) {
  ROT_CHECK(rot_rolling_friction(0.4, 90.0) == INFINITY);
  ROT_CHECK(rot_rolling_friction(0.4, -90.0) == INFINITY);
  ROT_CHECK(rot_rolling_friction(0.0, 90.0) == 0.0);
  ROT_CHECK(rot_rolling_friction(0.0, 35.0) == 0.0);
  ROT_CHECK(rot_rolling_friction(0.4, 0.0) == 0.0);
  ROT_CHECK_ULP(rot_rolling_friction(INFINITY, 45.0), 1.0, 1);
  ROT_CHECK(isnan(rot_rolling_friction(NAN, 30.0)));
  ROT_CHECK(isnan(rot_rolling_friction(0.4, NAN)));
  ROT_CHECK(isnan(rot_rolling_friction(0.0, NAN)));
}

/* All energy rotates: it does not move. */
static void check_infinite_beta(void) {
  ROT_CHECK(rot_rolling_acceleration(INFINITY, 30.0, 9.8) == 0.0);
  ROT_CHECK(rot_rolling_final_speed(INFINITY, 2.0, 9.8) == 0.0);
  ROT_CHECK(rot_rolling_final_speed(INFINITY, 1e300, 1e300) == 0.0);
  ROT_CHECK(rot_rolling_rotational_fraction(INFINITY) == 1.0);
  ROT_CHECK(rot_rolling_translational_fraction(INFINITY) == 0.0);
}

static void check_nan(void) {
  ROT_CHECK(isnan(rot_rolling_acceleration(NAN, 30.0, 9.8)));
  ROT_CHECK(isnan(rot_rolling_acceleration(0.4, NAN, 9.8)));
  ROT_CHECK(isnan(rot_rolling_acceleration(0.4, 30.0, NAN)));
  ROT_CHECK(isnan(rot_rolling_final_speed(NAN, 2.0, 9.8)));
  ROT_CHECK(isnan(rot_rolling_final_speed(0.4, NAN, 9.8)));
  ROT_CHECK(isnan(rot_rolling_final_speed(0.4, 2.0, NAN)));
  ROT_CHECK(isnan(rot_rolling_rotational_fraction(NAN)));
  ROT_CHECK(isnan(rot_rolling_translational_fraction(NAN)));
}

/* ---- the table ------------------------------------------------------------------------------ */

enum { MAX_ROWS = 70000 };
static double beta[MAX_ROWS], angle[MAX_ROWS], height[MAX_ROWS], gravity[MAX_ROWS];
static double result[4][MAX_ROWS];
static const rot_rolling_output out = {result[0], result[1], result[2], result[3]};

/* Ordinary rows with a strange one among them now and then. */
static void fill_inputs(void) {
  for (int i = 0; i < MAX_ROWS; i++) {
    beta[i] = 0.4 + 0.001 * (i % 977);
    angle[i] = -20.0 + 0.37 * (i % 331);
    height[i] = 0.1 + 0.01 * (i % 451);
    gravity[i] = 1.62 + 0.05 * (i % 173);
  }
  for (int i = 0; i < MAX_ROWS; i += 97) {
    const double strange[] = {INFINITY, NAN, 1e300, 1e-300, 0.0};
    beta[i] = strange[i % 5];
    height[i + 1] = strange[i % 5];
    gravity[i + 2] = strange[(i + 1) % 5];
    angle[i + 3] = strange[(i + 2) % 5];
    height[i + 4] = gravity[i + 4] = i % 2 ? 1e300 : 1e-300; /* their product is out of range */
  }
}

/* Bit 0 to 3 of `scalar`: beta, angle, height, gravity are one value for all rows, that of `at`. */
static rot_rolling_input input(int scalar, size_t at) {
  rot_rolling_input in = {{beta, 1}, {angle, 1}, {height, 1}, {gravity, 1}};
  if (scalar & 1) in.beta = (rot_column){beta + at, 0};
  if (scalar & 2) in.angle_deg = (rot_column){angle + at, 0};
  if (scalar & 4) in.height_m = (rot_column){height + at, 0};
  if (scalar & 8) in.gravity = (rot_column){gravity + at, 0};
  return in;
}

static int same(double a, double b) { return a == b || (isnan(a) && isnan(b)); }

/* Rows that differ from the single formulas; n comes with sentinels before and behind. */
static long differing_rows(const rot_rolling_input *in, size_t n) {
  long differing = 0;
  for (size_t i = 0; i < n; i++) {
    const double b = rot_at(in->beta, i), a = rot_at(in->angle_deg, i), h = rot_at(in->height_m, i),
                 g = rot_at(in->gravity, i);
    differing += !(same(result[0][i], rot_rolling_acceleration(b, a, g)) &&
                   same(result[1][i], rot_rolling_final_speed(b, h, g)) &&
                   same(result[2][i], rot_rolling_rotational_fraction(b)) &&
                   same(result[3][i], rot_rolling_translational_fraction(b)));
  }
  return differing;
}

static void check_table(void) {
  const size_t rows[] = {1, 2, 3, 1023, 1024, 1025, 2050};
  const size_t scalar_at[] = {7, 1, 97 + 4, 0}; /* ordinary, strange, out of range, infinite */
  for (size_t k = 0; k < 7; k++) {
    for (int scalar = 0; scalar < 16; scalar++) {
      for (int at = 0; at < 4; at++) {
        const rot_rolling_input in = input(scalar, scalar_at[at]);
        rot_info info;
        for (int c = 0; c < 4; c++) result[c][rows[k]] = -7.0;
        ROT_CHECK_EQ_INT(rot_rolling_table(rows[k], &in, &out, NULL, &info), ROT_OK);
        ROT_CHECK_EQ_INT(info.rows_done, rows[k]);
        ROT_CHECK_EQ_INT(differing_rows(&in, rows[k]), 0);
        for (int c = 0; c < 4; c++) ROT_CHECK(result[c][rows[k]] == -7.0); /* nothing beyond */
      }
    }
  }
}

static void check_no_rows(void) {
  const rot_rolling_input in = input(0, 0);
  rot_info info;
  memset(&info, 0x5a, sizeof info);
  ROT_CHECK_EQ_INT(rot_rolling_table(0, &in, &out, NULL, &info), ROT_OK);
  ROT_CHECK(info.status == ROT_OK && info.rows_done == 0 && info.steps == 0);
}

static int polled;
static double fraction_seen;
static rot_status refuse(void *ctx, double fraction) {
  polled++;
  fraction_seen = fraction;
  return *(const rot_status *)ctx;
}

/* Asked once every 64 blocks of 1024 rows. */
static void check_poll(void) {
  rot_status says = ROT_EUNWIND;
  const rot_hooks hooks = {refuse, &says};
  const rot_rolling_input in = input(0, 0);
  rot_info info;
  result[0][65536] = -7.0;
  ROT_CHECK_EQ_INT(rot_rolling_table(MAX_ROWS, &in, &out, &hooks, &info), ROT_EUNWIND);
  ROT_CHECK_EQ_INT(info.status, ROT_EUNWIND);
  ROT_CHECK_EQ_INT(info.rows_done, 65536);
  ROT_CHECK_EQ_INT(polled, 1);
  ROT_CHECK(fraction_seen == 65536.0 / MAX_ROWS);
  ROT_CHECK(result[0][65536] == -7.0);
  ROT_CHECK_EQ_INT(differing_rows(&in, 65536), 0);
  says = ROT_OK;
  ROT_CHECK_EQ_INT(rot_rolling_table(MAX_ROWS, &in, &out, &hooks, &info), ROT_OK);
  ROT_CHECK_EQ_INT(info.rows_done, MAX_ROWS);
  ROT_CHECK_EQ_INT(info.steps, 69);
  ROT_CHECK_EQ_INT(differing_rows(&in, MAX_ROWS), 0);
}

/* ---- the check of a column ------------------------------------------------------------------ */

static void check_first_outside(void) {
  static double value[3000];
  const rot_column column = {value, 1};
  for (int i = 0; i < 3000; i++) value[i] = 5.0;
  ROT_CHECK_EQ_INT(rot_rolling_first_outside(column, 3000, 2.0, 7.0), 3000);
  ROT_CHECK_EQ_INT(rot_rolling_first_outside(column, 3000, 5.0, 5.0), 3000); /* ends belong */
  value[2999] = 8.0;
  ROT_CHECK_EQ_INT(rot_rolling_first_outside(column, 3000, 2.0, 7.0), 2999);
  ROT_CHECK_EQ_INT(rot_rolling_first_outside(column, 2999, 2.0, 7.0), 2999);
  value[1024] = 1.0;
  ROT_CHECK_EQ_INT(rot_rolling_first_outside(column, 3000, 2.0, 7.0), 1024);
  value[1023] = NAN; /* lies nowhere */
  ROT_CHECK_EQ_INT(rot_rolling_first_outside(column, 3000, 2.0, 7.0), 1024);
  value[3] = -INFINITY;
  value[2] = 7.5;
  ROT_CHECK_EQ_INT(rot_rolling_first_outside(column, 3000, 2.0, 7.0), 2);
  value[0] = 2.0; /* the ends belong also where another row of the block does not */
  value[1] = 7.0;
  ROT_CHECK_EQ_INT(rot_rolling_first_outside(column, 3000, 2.0, 7.0), 2);
  value[0] = 1.999;
  ROT_CHECK_EQ_INT(rot_rolling_first_outside(column, 3000, 2.0, 7.0), 0);
  ROT_CHECK_EQ_INT(rot_rolling_first_outside(column, 0, 2.0, 7.0), 0);
}

/* One value for all rows counts as row 0. */
static void check_first_outside_of_one(void) {
  const double inside = 5.0, outside = 9.0;
  const rot_column good = {&inside, 0}, bad = {&outside, 0};
  ROT_CHECK_EQ_INT(rot_rolling_first_outside(good, 3000, 2.0, 7.0), 3000);
  ROT_CHECK_EQ_INT(rot_rolling_first_outside(bad, 3000, 2.0, 7.0), 0);
  ROT_CHECK_EQ_INT(rot_rolling_first_outside(bad, 0, 2.0, 7.0), 0);
}

int main(void) {
  check_known_values();
  check_by_head();
  check_friction_at_ends();
  check_infinite_beta();
  check_nan();
  fill_inputs();
  check_table();
  check_no_rows();
  check_poll();
  check_first_outside();
  check_first_outside_of_one();
  return rot_test_report("rolling");
}
