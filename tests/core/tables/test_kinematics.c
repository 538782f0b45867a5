/* Constant angular acceleration, points that go round, units of angles: against numbers of 20
 * digits, at the edges, and against themselves in units of 2^k, which must change no bit. */
#include "tables/kinematics.h"
#include "rot_test.h"

enum {
  THETA = 1 << ROT_MOTION_THETA,
  OMEGA0 = 1 << ROT_MOTION_OMEGA0,
  OMEGA = 1 << ROT_MOTION_OMEGA,
  ALPHA = 1 << ROT_MOTION_ALPHA,
  TIME = 1 << ROT_MOTION_TIME
};

static const unsigned combinations[] = {
    THETA | OMEGA0 | OMEGA, THETA | OMEGA0 | ALPHA, THETA | OMEGA0 | TIME,  THETA | OMEGA | ALPHA,
    THETA | OMEGA | TIME,   THETA | ALPHA | TIME,   OMEGA0 | OMEGA | ALPHA, OMEGA0 | OMEGA | TIME,
    OMEGA0 | ALPHA | TIME,  OMEGA | ALPHA | TIME};
enum { COMBINATIONS = sizeof combinations / sizeof *combinations };

/* ---- known motions --------------------------------------------------------------------------
 *
 * What is given, how many motions there are, and both of them: theta, omega0, omega, alpha, t. From
 * the textbook formulas at 9000 bits (mpmath), the doubles of the given quantities taken as exact.
 * First plain ones, then some that cancel, then some at the ends of the range. Each is the double
 * next to the true value. */
static const struct {
  unsigned given;
  int motions;
  double x[2][ROT_MOTION_SIZE];
} known[] = {
    {OMEGA0 | ALPHA | TIME, 1, {{22.5, 2.0, 7.0, 1.0, 5.0}, {0, 0, 0, 0, 0}}},
    {THETA | OMEGA0 | ALPHA,
     2,
     {{300.0, 0.0, -54.772255750516611346, 5.0, -10.954451150103322269},
      {300.0, 0.0, 54.772255750516611346, 5.0, 10.954451150103322269}}},
    {OMEGA0 | OMEGA | TIME,
     1,
     {{3665.1914291880922292, 733.03828583761844584, 0.0, -73.303828583761844584, 10.0},
      {0, 0, 0, 0, 0}}},
    {OMEGA0 | OMEGA | ALPHA, 1, {{-2.0, 3.0, -5.0, -4.0, 2.0}, {0, 0, 0, 0, 0}}},
    {THETA | OMEGA0 | OMEGA, 1, {{20.0, 3.0, 7.0, 1.0, 4.0}, {0, 0, 0, 0, 0}}},
    {OMEGA | ALPHA | TIME, 1, {{-17.0, 10.0, 7.0, 1.5, -2.0}, {0, 0, 0, 0, 0}}},
    {THETA | OMEGA0 | TIME,
     1,
     {{0.69999999999999995559, 0.10000000000000000555, 4.5666666666666665378, 14.888888888888888992,
       0.2999999999999999889},
      {0, 0, 0, 0, 0}}},
    {THETA | OMEGA | TIME,
     1,
     {{0.69999999999999995559, 4.5666666666666665378, 0.10000000000000000555,
       -14.888888888888888992, 0.2999999999999999889},
      {0, 0, 0, 0, 0}}},
    {THETA | ALPHA | TIME,
     1,
     {{0.69999999999999995559, 2.3183333333333332714, 2.3483333333333332719, 0.10000000000000000555,
       0.2999999999999999889},
      {0, 0, 0, 0, 0}}},
    {THETA | OMEGA | ALPHA,
     2,
     {{0.2000000000000000111, -0.78102496759066540103, 0.69999999999999995559,
       -0.2999999999999999889, -4.9367498919688847048},
      {0.2000000000000000111, 0.78102496759066540103, 0.69999999999999995559,
       -0.2999999999999999889, 0.27008322530221816147}}},
    {THETA | OMEGA0 | ALPHA,
     2,
     {{1.5, -2.0, -3.6055512754639892931, 3.0, -0.53518375848799643104},
      {1.5, -2.0, 3.6055512754639892931, 3.0, 1.8685170918213297644}}},
    {THETA | OMEGA0 | ALPHA,
     2,
     {{0.5, 2.0, 1.0, -3.0, 0.33333333333333333333}, {0.5, 2.0, -1.0, -3.0, 1.0}}},
    {THETA | OMEGA0 | ALPHA,
     2,
     {{0.2999999999999999889, 1.0, -1.0000000003, 1.0000000000000000623e-9,
       -2.0000000002999998754e+9},
      {0.2999999999999999889, 1.0, 1.0000000003, 1.0000000000000000623e-9,
       0.29999999995499998891}}},
    {THETA | OMEGA0 | ALPHA,
     2,
     {{0.0010000000000000000208, -1.0e+8, -1.0000000000000000001e+8, 1.0,
       -1.0000000000000000208e-11},
      {0.0010000000000000000208, -1.0e+8, 1.0000000000000000001e+8, 1.0,
       2.0000000000000000001e+8}}},
    {THETA | OMEGA0 | ALPHA,
     2,
     {{4.9999999999999991118, 1.0, 1.1050996910178159547e-8, -0.10000000000000000555,
       9.9999998894900303431},
      {4.9999999999999991118, 1.0, -1.1050996910178159547e-8, -0.10000000000000000555,
       10.000000110509968547}}},
    {THETA | OMEGA | ALPHA,
     2,
     {{0.064285714285714196103, 1.1158117316431553361e-8, 0.2999999999999999889,
       0.69999999999999995559, 0.42857141263126098786},
      {0.064285714285714196103, -1.1158117316431553361e-8, 0.2999999999999999889,
       0.69999999999999995559, 0.42857144451159617766}}},
    {THETA | OMEGA0 | TIME,
     1,
     {{0.30000000000000004441, 0.10000000000000000555, 0.10000000000000002405,
       6.1679056923619807801e-18, 3.0},
      {0, 0, 0, 0, 0}}},
    {THETA | OMEGA | TIME,
     1,
     {{-0.30000000000000004441, 0.10000000000000002405, 0.10000000000000000555,
       6.1679056923619807801e-18, -3.0},
      {0, 0, 0, 0, 0}}},
    {THETA | ALPHA | TIME,
     1,
     {{0.049000000000000001887, 7.6922595277600138722e-18, 0.14000000000000000658,
       0.2000000000000000111, 0.69999999999999995559},
      {0, 0, 0, 0, 0}}},
    {THETA | ALPHA | TIME,
     1,
     {{0.049000000000000001887, 0.14000000000000000658, 7.6922595277600138722e-18,
       -0.2000000000000000111, 0.69999999999999995559},
      {0, 0, 0, 0, 0}}},
    {OMEGA0 | OMEGA | TIME,
     1,
     {{1.0000000000000001048e-13, 0.10000000000000000555, 0.10000000000000001943,
       1.3877787807814457034e-5, 9.9999999999999997989e-13},
      {0, 0, 0, 0, 0}}},
    {THETA | OMEGA0 | OMEGA,
     1,
     {{9.9999999999999997989e-13, 0.10000000000000000555, -0.10000000000000001943,
       1.3877787807814458768e-6, -144115.1880758558691},
      {0, 0, 0, 0, 0}}},
    {OMEGA0 | ALPHA | TIME,
     1,
     {{9.8686491077791685634e-18, 0.10000000000000000555, -0.099999999999999975945,
       -0.2999999999999999889, 0.66666666666666662966},
      {0, 0, 0, 0, 0}}},
    {OMEGA | ALPHA | TIME,
     1,
     {{9.8686491077791685634e-18, -0.099999999999999975945, 0.10000000000000000555,
       0.2999999999999999889, 0.66666666666666662966},
      {0, 0, 0, 0, 0}}},
    {THETA | OMEGA0 | ALPHA,
     2,
     {{9.007199254740882e+15, 9.007199254740881e+15, 1.0, -4.50359962737044e+15, 2.0},
      {9.007199254740882e+15, 9.007199254740881e+15, -1.0, -4.50359962737044e+15,
       2.0000000000000004441}}},
    {THETA | OMEGA | ALPHA,
     2,
     {{9.007199254740878e+15, 1.0, 9.007199254740877e+15, 4.503599627370438e+15, 2.0},
      {9.007199254740878e+15, -1.0, 9.007199254740877e+15, 4.503599627370438e+15,
       2.0000000000000004441}}},
    {THETA | OMEGA0 | ALPHA,
     2,
     {{5.5751862996325864607e+42, -9.6714065569169142123e+24, 1.073741824e+9,
       -8.3886079999998975545e+6, -1.152921504606846976e+18},
      {5.5751862996325864607e+42, -9.6714065569169142123e+24, -1.073741824e+9,
       -8.3886079999998975545e+6, -1.15292150460684672e+18}}},
    {THETA | ALPHA | TIME,
     1,
     {{1.4921114354397171375, 2.0363305322922553813e-22, 2.0501370207461871726,
       1.4084275825536558546, 1.4556211807702825745},
      {0, 0, 0, 0, 0}}},
    {THETA | ALPHA | TIME,
     1,
     {{2.954037911180069198, -1.0542448850198777945e-21, 3.4064936211554252603,
       1.964124892753491336, 1.7343569310299247199},
      {0, 0, 0, 0, 0}}},
    {THETA | ALPHA | TIME,
     1,
     {{1.5840493596250442287, -7.9717588266813404207e-22, 2.0029070872711894032,
       1.2662600366161389509, 1.5817502166645109885},
      {0, 0, 0, 0, 0}}},
    {THETA | ALPHA | TIME,
     1,
     {{2.3511574986481909022, -1.3923602479116761535e-21, 3.0323234743672140463,
       1.9554167805613091868, 1.5507300052405068591},
      {0, 0, 0, 0, 0}}},
    {THETA | ALPHA | TIME,
     1,
     {{1.2696832527676324975, 2.2446487960489680424, -1.1405914961030962037e-21,
       -1.9841358884672077867, 1.1312979161840637232},
      {0, 0, 0, 0, 0}}},
    {OMEGA0 | OMEGA | TIME,
     1,
     {{INFINITY, 1.0000000000000000525e+300, 1.5000000000000000788e+300, 0.5,
       1.0000000000000000525e+300},
      {0, 0, 0, 0, 0}}},
    {OMEGA0 | OMEGA | ALPHA,
     1,
     {{4.0000000000000005976e-300, 1.0000000000000000251e-300, 3.000000000000000241e-300,
       1.0000000000000000251e-300, 2.0000000000000001658},
      {0, 0, 0, 0, 0}}},
    {OMEGA0 | OMEGA | ALPHA,
     1,
     {{0.0, 1.6999999999999999388e+308, -1.6999999999999999388e+308, -1.6999999999999999388e+308,
       2.0},
      {0, 0, 0, 0, 0}}},
    {THETA | OMEGA0 | ALPHA,
     2,
     {{3.9999999999999998693e+99, 9.9999999999999996973e+199, 4.4721359549995785386e+199,
       -1.0000000000000000525e+300, 5.5278640450004208685e-101},
      {3.9999999999999998693e+99, 9.9999999999999996973e+199, -4.4721359549995785386e+199,
       -1.0000000000000000525e+300, 1.4472135954999577476e-100}}},
    {THETA | OMEGA0 | ALPHA,
     2,
     {{1.00000000000000002e-100, 9.999999999999999821e-201, -1.7320508075688773092e-200,
       1.0000000000000000251e-300, -2.7320508075688772228e+100},
      {1.00000000000000002e-100, 9.999999999999999821e-201, 1.7320508075688773092e-200,
       1.0000000000000000251e-300, 7.3205080756887730876e+99}}},
    {THETA | OMEGA0 | ALPHA,
     2,
     {{1.0000000000000000251e-300, 1.000000000000000054e-250, -1.4142135623730950107e-25,
       9.999999999999999211e+249, -1.4142135623730951223e-275},
      {1.0000000000000000251e-300, 1.000000000000000054e-250, 1.4142135623730950107e-25,
       9.999999999999999211e+249, 1.4142135623730951223e-275}}},
    {THETA | OMEGA | ALPHA,
     2,
     {{-2.000000000000000105e+300, 1.0000000000000000065e+160, 1.0000000000000000065e+160,
       2.9999999999999999659e-160, -2.000000000000000092e+140},
      {-2.000000000000000105e+300, -1.0000000000000000065e+160, 1.0000000000000000065e+160,
       2.9999999999999999659e-160, INFINITY}}},
    {THETA | OMEGA0 | TIME,
     1,
     {{2.5, 9.9999999999999996973e+199, 4.0000000000000001198e+200, INFINITY,
       9.999999999999999821e-201},
      {0, 0, 0, 0, 0}}},
    {THETA | ALPHA | TIME,
     1,
     {{1.0000000000000000159e+100, 5.0000000000000004877e-101, 1.5000000000000000436e-100,
       1.0000000000000000251e-300, 9.9999999999999996973e+199},
      {0, 0, 0, 0, 0}}},
    {OMEGA | ALPHA | TIME,
     1,
     {{-9.9999999999999999918e-301, -1.0000000000000000206e-180, -1.0000000000000000206e-180,
       1.0000000000000000206e-180, 9.9999999999999997861e-121},
      {0, 0, 0, 0, 0}}},
};

static void check_known(void) {
  unsigned seen = 0;
  for (size_t i = 0; i < sizeof known / sizeof *known; i++) {
    double x[2][ROT_MOTION_SIZE];
    memcpy(x[0], known[i].x[0], sizeof x[0]);
    for (unsigned j = 0; j < ROT_MOTION_SIZE; j++) {
      if (!(known[i].given >> j & 1U)) x[0][j] = 7.0; /* must not be read */
    }
    ROT_CHECK_EQ_INT(rot_motion_solve(known[i].given, x), known[i].motions);
    for (int k = 0; k < known[i].motions; k++) {
      for (unsigned j = 0; j < ROT_MOTION_SIZE; j++) {
        ROT_CHECK_ULP(x[k][j], known[i].x[k][j], 0);
      }
    }
    for (unsigned c = 0; c < COMBINATIONS; c++) {
      if (combinations[c] == known[i].given) seen |= 1U << c;
    }
  }
  ROT_CHECK(seen == (1U << COMBINATIONS) - 1U);
}

/* ---- any three of a motion give it back -----------------------------------------------------
 *
 * Small whole numbers, so that every quantity is exact: omega0, alpha and t from -4 to 4. */
static void check_exact_motions(void) {
  for (int i = 0; i < 9 * 9 * 9; i++) {
    const double w0 = i % 9 - 4, a = 2 * (i / 9 % 9 - 4), t = i / 81 - 4;
    const double all[] = {w0 * t + 0.5 * a * t * t, w0, w0 + a * t, a, t};
    for (unsigned c = 0; c < COMBINATIONS; c++) {
      double x[2][ROT_MOTION_SIZE];
      memcpy(x[0], all, sizeof all);
      const rot_motion_kind kind = rot_motion_solve(combinations[c], x);
      ROT_CHECK(kind != ROT_MOTION_IMPOSSIBLE);
      int found = 0;
      for (int k = 0; k < (kind == ROT_MOTION_TWO ? 2 : 1); k++) {
        int same = 0;
        for (int j = 0; j < ROT_MOTION_SIZE; j++) {
          same += x[k][j] == all[j] || (kind == ROT_MOTION_UNDETERMINED && isnan(x[k][j]));
        }
        found += same == ROT_MOTION_SIZE;
      }
      ROT_CHECK_EQ_INT(found, 1);
      if (kind == ROT_MOTION_TWO) ROT_CHECK(x[0][ROT_MOTION_TIME] < x[1][ROT_MOTION_TIME]);
      if (a != 0.0 && t != 0.0 && w0 + all[ROT_MOTION_OMEGA] != 0.0) ROT_CHECK(kind > 0);
    }
  }
}

/* ---- units ----------------------------------------------------------------------------------
 *
 * Time in units of 2^p s and angles in 2^q rad: the same motion, to the last bit. */
static void check_scales(void) {
  static const int shifts[][2] = {{400, 0},  {-400, 0},  {0, 500},
                                  {0, -500}, {300, 300}, {-300, 200}};
  for (size_t i = 0; i < 12; i++) {
    for (int s = 0; s < 6; s++) {
      const int p = shifts[s][0], q = shifts[s][1];
      const int shift[] = {q, q - p, q - p, q - 2 * p, p};
      double x[2][ROT_MOTION_SIZE], y[2][ROT_MOTION_SIZE];
      for (int j = 0; j < ROT_MOTION_SIZE; j++) {
        x[0][j] = known[i].x[0][j];
        y[0][j] = ldexp(x[0][j], shift[j]);
      }
      ROT_CHECK_EQ_INT(rot_motion_solve(known[i].given, x), known[i].motions);
      ROT_CHECK_EQ_INT(rot_motion_solve(known[i].given, y), known[i].motions);
      for (int k = 0; k < known[i].motions; k++) {
        for (int j = 0; j < ROT_MOTION_SIZE; j++) {
          ROT_CHECK(y[k][j] == ldexp(x[k][j], shift[j]));
        }
      }
    }
  }
}

/* ---- none, or too many ---------------------------------------------------------------------- */

static void check_edge(unsigned given, double theta, double omega0, double omega, double alpha,
                       double t, rot_motion_kind kind, const double want[ROT_MOTION_SIZE]) {
  double x[2][ROT_MOTION_SIZE] = {{theta, omega0, omega, alpha, t}, {0.0}};
  ROT_CHECK_EQ_INT(rot_motion_solve(given, x), kind);
  for (int j = 0; j < ROT_MOTION_SIZE; j++) ROT_CHECK_ULP(x[0][j], want[j], 0);
}

#define EDGE(given, theta, omega0, omega, alpha, t, kind, ...)                                     \
  do {                                                                                             \
    const double want_[] = {__VA_ARGS__};                                                          \
    check_edge(given, theta, omega0, omega, alpha, t, kind, want_);                                \
  } while (0)

static void check_impossible(void) {
  const rot_motion_kind no = ROT_MOTION_IMPOSSIBLE;
  EDGE(OMEGA0 | OMEGA | TIME, 0, 1, 2, 0, 0, no, NAN, 1, 2, NAN, 0);
  EDGE(OMEGA0 | OMEGA | ALPHA, 0, 1, 2, 0, 0, no, NAN, 1, 2, 0, NAN);
  EDGE(OMEGA0 | OMEGA | THETA, 3, 1, -1, 0, 0, no, 3, 1, -1, NAN, NAN);
  EDGE(OMEGA0 | OMEGA | THETA, 0, 1, 2, 0, 0, no, 0, 1, 2, NAN, NAN);
  EDGE(OMEGA0 | ALPHA | THETA, -0.75, 1, 0, 1, 0, no, -0.75, 1, NAN, 1, NAN);
  EDGE(OMEGA0 | ALPHA | THETA, 2, 0, 0, 0, 0, no, 2, 0, NAN, 0, NAN);
  EDGE(OMEGA | ALPHA | THETA, 0.75, 0, 1, 1, 0, no, 0.75, NAN, 1, 1, NAN);
  EDGE(OMEGA | ALPHA | THETA, 2, 0, 0, 0, 0, no, 2, NAN, 0, 0, NAN);
  EDGE(OMEGA0 | TIME | THETA, 2, 1, 0, 0, 0, no, 2, 1, NAN, NAN, 0);
  EDGE(OMEGA | TIME | THETA, 2, 0, 1, 0, 0, no, 2, NAN, 1, NAN, 0);
  EDGE(ALPHA | TIME | THETA, 2, 0, 0, 1, 0, no, 2, NAN, NAN, 1, 0);
}

static void check_undetermined(void) {
  const rot_motion_kind many = ROT_MOTION_UNDETERMINED;
  ROT_CHECK_EQ_INT(many, -1); /* the others count motions; callers elsewhere read the numbers */
  EDGE(OMEGA0 | OMEGA | TIME, 9, 2, 2, 9, 0, many, 0, 2, 2, NAN, 0);
  EDGE(OMEGA0 | OMEGA | ALPHA, 9, 2, 2, 0, 9, many, NAN, 2, 2, 0, NAN);
  EDGE(OMEGA0 | OMEGA | THETA, 0, 2, 2, 9, 9, many, 0, 2, 2, NAN, 0);
  EDGE(OMEGA0 | OMEGA | THETA, 0, 2, -2, 9, 9, many, 0, 2, -2, NAN, NAN);
  EDGE(OMEGA0 | ALPHA | THETA, 0, 0, 9, 0, 9, many, 0, 0, 0, 0, NAN);
  EDGE(OMEGA | ALPHA | THETA, 0, 9, 0, 0, 9, many, 0, 0, 0, 0, NAN);
  EDGE(OMEGA0 | TIME | THETA, 0, 3, 9, 9, 0, many, 0, 3, 3, NAN, 0);
  EDGE(OMEGA | TIME | THETA, 0, 9, 3, 9, 0, many, 0, 3, 3, NAN, 0);
  EDGE(ALPHA | TIME | THETA, 0, 9, 9, 3, 0, many, 0, NAN, NAN, 3, 0);
}

/* No acceleration, and a turning point that is just reached: one motion each. */
static void check_one_root(void) {
  EDGE(OMEGA0 | ALPHA | THETA, 6, 2, 9, 0, 9, ROT_MOTION_ONE, 6, 2, 2, 0, 3);
  EDGE(OMEGA | ALPHA | THETA, 6, 9, 2, 0, 9, ROT_MOTION_ONE, 6, 2, 2, 0, 3);
  EDGE(OMEGA0 | ALPHA | THETA, 2, 2, 9, -1, 9, ROT_MOTION_ONE, 2, 2, 0, -1, 2);
  EDGE(OMEGA | ALPHA | THETA, 2, 9, 2, 1, 9, ROT_MOTION_ONE, 2, 0, 2, 1, 2);
}

static void check_nan(void) {
  for (unsigned c = 0; c < COMBINATIONS; c++) {
    for (unsigned j = 0; j < ROT_MOTION_SIZE; j++) {
      if (!(combinations[c] >> j & 1U)) continue;
      double x[2][ROT_MOTION_SIZE] = {{1.0, 2.0, 3.0, 4.0, 5.0}, {0.0}};
      x[0][j] = NAN;
      ROT_CHECK_EQ_INT(rot_motion_solve(combinations[c], x), ROT_MOTION_ONE);
      for (unsigned k = 0; k < ROT_MOTION_SIZE; k++) {
        ROT_CHECK(isnan(x[0][k]) == (k == j || !(combinations[c] >> k & 1U)));
      }
    }
  }
}

/* ---- a point that goes round (mpmath, 60 digits) -------------------------------------------- */

static void check_point(void) {
  static const struct {
    double omega, alpha, radius, speed, tangential, centripetal, total, angle;
  } row[] = {
      {6.0, -2.5, 0.3, 1.7999999999999999334, -0.74999999999999997224, 10.7999999999999996,
       10.82601034545967868, -0.069333133688208584975},
      {1e200, 1e300, 1e-300, 9.9999999999999999479e-101, 1.0000000000000000776,
       9.9999999999999996453e+99, 9.9999999999999996453e+99, 1.000000000000000113e-100},
      {1e-170, 1e-300, 1e300, 1.0000000000000000359e+130, 1.0000000000000000776,
       1.0000000000000000192e-40, 1.0000000000000000776, 1.5707963267948966192},
      {-3.0, 0.0, 2.0, -6.0, 0.0, 18.0, 18.0, 0.0},
      {1e160, 1e170, 1e-200, 9.9999999999999998863e-41, 1.0000000000000000165e-30,
       9.9999999999999999516e+119, 9.9999999999999999516e+119, 1.0000000000000000214e-150},
      {0.0, -2.0, 3.0, 0.0, -6.0, 0.0, 6.0, -1.5707963267948966192},
  };
  for (size_t i = 0; i < sizeof row / sizeof *row; i++) {
    const double w = row[i].omega, a = row[i].alpha, r = row[i].radius;
    ROT_CHECK_ULP(rot_tangential_speed(w, r), row[i].speed, 1);
    ROT_CHECK_ULP(rot_tangential_acceleration(a, r), row[i].tangential, 1);
    ROT_CHECK_ULP(rot_centripetal_acceleration(w, r), row[i].centripetal, 2);
    ROT_CHECK_ULP(rot_total_acceleration(w, a, r), row[i].total, 3);
    ROT_CHECK_ULP(rot_acceleration_angle(w, a), row[i].angle, 2);
  }
  ROT_CHECK(isnan(rot_tangential_speed(NAN, 1.0)) && isnan(rot_tangential_acceleration(1.0, NAN)));
  ROT_CHECK(isnan(rot_centripetal_acceleration(1.0, NAN)));
  ROT_CHECK(isnan(rot_total_acceleration(1.0, NAN, 1.0)));
  ROT_CHECK(isnan(rot_acceleration_angle(NAN, 1.0)) && isnan(rot_acceleration_angle(1.0, NAN)));
}

/* ---- units of angles (mpmath, 60 digits) ---------------------------------------------------- */

static void check_units(void) {
  static const double x[] = {7000.0, -0.1, 1.0000000000000002, 123456789.123, 3e-310, 1.7e307};
  static const double want[ROT_ANGLE_UNIT_COUNT][6] = {
      {122.17304763960307038, -0.0017453292519943296738, 0.017453292519943299645,
       2.154727454136672667e+6, 5.2359877559829727345e-312, 2.9670597283903600869e+305},
      {401070.45659157624614, -5.7295779513082324057, 57.295779513082333599,
       7.073552968984507476e+9, 1.718873385392464375e-308, INFINITY},
      {43982.297150257105338, -0.62831853071795868257, 6.2831853071795878721,
       7.7570188348920216011e+8, 1.8849555921538701844e-309, 1.0681415022205296313e+308},
      {1114.0846016432673504, -0.01591549430918953446, 0.15915494309189537111,
       1.9648758247179187433e+7, 4.7746482927568454862e-311, 2.7056340325622205313e+306},
      {733.03828583761842231, -0.010471975511965978043, 0.10471975511965979787,
       1.2928364724820036002e+7, 3.1415926535897836407e-311, 1.7802358370342160522e+306},
      {66845.076098596041023, -0.95492965855137206762, 9.5492965855137222665,
       1.178925494830751246e+9, 2.8647889756541072917e-309, 1.6233804195373323188e+308},
  };
  for (int u = 0; u < ROT_ANGLE_UNIT_COUNT; u++) {
    const rot_angle_unit unit = (rot_angle_unit)u;
    for (int i = 0; i < 6; i++) ROT_CHECK_ULP(rot_convert_angle(x[i], unit), want[u][i], 1);
    ROT_CHECK(rot_convert_angle(0.0, unit) == 0.0);
    ROT_CHECK(rot_convert_angle(-INFINITY, unit) == -INFINITY);
    ROT_CHECK(isnan(rot_convert_angle(NAN, unit)));
  }
  ROT_CHECK(rot_convert_angle(180.0, ROT_RAD_FROM_DEG) == 3.14159265358979323846);
  ROT_CHECK(rot_convert_angle(60.0, ROT_RAD_PER_S_FROM_RPM) == 6.28318530717958647693);
}

/* By hand; a cancellation, mpmath at 50 digits; no overflow on the way. */
static void check_moments(void) {
  const double zero[3] = {0.0, 0.0, 0.0}, r[3] = {1.0, 2.0, 3.0}, f[3] = {4.0, 5.0, 6.0};
  double out[3];
  rot_moment(2.0, r, zero, f, out);
  ROT_CHECK(out[0] == -6.0 && out[1] == 12.0 && out[2] == -6.0);
  const double about[3] = {1.0, 2.0, 2.0};
  rot_moment(1.0, r, about, f, out);
  ROT_CHECK(out[0] == -5.0 && out[1] == 4.0 && out[2] == 0.0);
  const double along[3] = {0.1, 0.3, 0.0}, nearly[3] = {1.0, 3.0, 0.0};
  rot_moment(1.0, along, zero, nearly, out); /* 3 fl(0.1) - fl(0.3) */
  ROT_CHECK_REL(out[2], 2.775557561562891351e-17, 1e-15);
  const double far[3] = {1e300, 0.0, 0.0}, faint[3] = {0.0, 1e-300, 0.0};
  rot_moment(3.0, far, zero, faint, out);
  ROT_CHECK_ULP(out[2], 3.0, 1);
  ROT_CHECK_ULP(rot_lever(1.0, 0.25, 40.0, 30.0), 5.0, 0);
  ROT_CHECK_ULP(rot_lever(1e-200, 1e200, 1e200, -90.0), -1e200, 1);
  ROT_CHECK(rot_lever(2.0, 3.0, 4.0, 180.0) == 0.0 && isnan(rot_lever(1.0, NAN, 1.0, 1.0)));
}

int main(void) {
  check_known();
  check_exact_motions();
  check_scales();
  check_impossible();
  check_undetermined();
  check_one_root();
  check_nan();
  check_point();
  check_units();
  check_moments();
  return rot_test_report("kinematics");
}
