/* The pendulum against elliptic functions at 140 digits (themselves checked against Taylor
 * integration), from amplitude 1e-300 over the separatrix to fast turning; energy; back in time. */
#include "axle_row.h"
#include "scene/axle/pendulum.h"
#include "rot_test.h"

typedef struct row {
  double inertia, gravity, rest, start, theta0, omega0, t, theta, omega;
} row;

/* mpmath, 140 digits. */
/* clang-format off */
static const row table[] = {
    /* amplitudes 1e-300, 1e-8, 0.1, 1, 3 */
    {2.0, 5.0, 0.0, 0.0, 1e-300, 0.0, 0.7, 4.4752799187514484457e-301, -1.4139649009860537731e-300},
    {2.0, 5.0, 0.0, 0.0, 1e-300, 0.0, 1000.0, -6.0762832009890617703e-301, 1.2557744867349603684e-300},
    {2.0, 5.0, 0.0, 0.0, 1e-300, 0.0, 4000000.0, 4.9681164946572763875e-302, -1.5791863267594102049e-300},
    {2.0, 5.0, 0.0, 0.0, 1e-08, 0.0, 0.7, 4.4752799187514484965e-9, -1.4139649009860537547e-8},
    {2.0, 5.0, 0.0, 0.0, 1e-08, 0.0, 1000.0, -6.0762832009891402391e-9, 1.2557744867349508609e-8},
    {2.0, 5.0, 0.0, 0.0, 1e-08, 0.0, 4000000.0, 4.9681164986052421942e-10, -1.579186326756305119e-8},
    {2.0, 5.0, 0.0, 0.0, 0.1, 0.0, 0.7, 0.044822112335570956271, -0.14127087469264356973},
    {2.0, 5.0, 0.0, 0.0, 0.1, 0.0, 1000.0, -0.099752150895847376851, -0.011115993316621664546},
    {2.0, 5.0, 0.0, 0.0, 0.1, 0.0, 4000000.0, 0.05376378285596947236, -0.13324621289583825438},
    {2.0, 5.0, 0.0, 0.0, 1.0, 0.0, 0.7, 0.51636765259996146635, -1.2831913071389592862},
    {2.0, 5.0, 0.0, 0.0, 1.0, 0.0, 1000.0, 0.99870762898276961433, 0.073723849510027933341},
    {2.0, 5.0, 0.0, 0.0, 1.0, 0.0, 4000000.0, 0.84734276721776380056, 0.77998344391788740285},
    {2.0, 5.0, 0.0, 0.0, 3.0, 0.0, 0.7, 2.9044950855186421256, -0.29973903942590649544},
    {2.0, 5.0, 0.0, 0.0, 3.0, 0.0, 1000.0, 2.5579310245873500432, 0.88187898825090838475},
    {2.0, 5.0, 0.0, 0.0, 3.0, 0.0, 11000000.0, -2.8089937513050369865, -0.47326262905873339504},
    /* pi - 1e-6, pi - 1e-12, and the double next to pi */
    {2.0, 5.0, 0.0, 0.0, 3.141591653589793, 0.0, 1.0, 3.1415901204754968094, -3.6799008268719868582e-6},
    {2.0, 5.0, 0.0, 0.0, 3.141591653589793, 0.0, 11.0, -2.2613927376005459595, -1.3472248356485257456},
    {2.0, 5.0, 0.0, 0.0, 3.141591653589793, 0.0, 30000000.0, 3.1415705386581064759, -0.000034931010702873974633},
    {2.0, 5.0, 0.0, 0.0, 3.141592653588793, 0.0, 1.0, 3.1415926535872595888, -3.6806786291121282398e-12},
    {2.0, 5.0, 0.0, 0.0, 3.141592653588793, 0.0, 18.0, 2.0252089434719542387, -1.6749110208050854219},
    {2.0, 5.0, 0.0, 0.0, 3.141592653588793, 0.0, 60000000.0, -3.1415926512461939722, -3.705555464581079849e-9},
    {2.0, 5.0, 0.0, 0.0, 3.141592653589793, 0.0, 5.0, 3.1415926535896271344, -2.6263351521273785129e-13},
    {2.0, 5.0, 0.0, 0.0, 3.141592653589793, 0.0, 24.0, 1.4083498400522930314, -2.410117181676502001},
    {2.0, 5.0, 0.0, 0.0, 3.141592653589793, 0.0, 100000000.0, -3.1411814830902687743, 0.0006501176380036741883},
    /* moving at the start, to either side; a rest angle; a start time; backward */
    {0.3, 0.7, 0.4, 1.0, 1.9, 1.2, 1.5, 2.2104139959256576281, 0.048448820637603475877},
    {0.3, 0.7, 0.4, 1.0, 1.9, 1.2, 60.0, -0.55922664757021500451, -1.9466060988969310666},
    {0.3, 0.7, 0.4, 1.0, 1.9, 1.2, -8.0, 1.4793595138319696047, -1.8199068901057009536},
    {0.3, 0.7, 0.4, 1.0, -1.9, -1.7, 1.5, -2.590211408446819536, -1.1772810710168008348},
    {0.3, 0.7, 0.4, 1.0, -1.9, -1.7, 60.0, -123.28296110885973389, -2.0345345321671009902},
    {0.3, 0.7, 0.4, 1.0, -1.9, -1.7, -8.0, 16.803779785949962905, -1.5548243699100953353},
    /* just below and just above the separatrix */
    {1.0, 1.0, 0.0, 0.0, 0.0, 1.999999999998, 10.0, 3.1414110428578779164, 0.00018158870568716327822},
    {1.0, 1.0, 0.0, 0.0, 0.0, 1.999999999998, 40.0, -3.1414566885352898761, -0.00013593563254201173893},
    {1.0, 1.0, 0.0, 0.0, 0.0, 1.999999999998, 1000000.0, 3.097304371292045841, 0.044284662740434038783},
    {1.0, 1.0, 0.0, 0.0, 0.0, 2.000000000002, 10.0, 3.141411064885080933, 0.00018161073288682019661},
    {1.0, 1.0, 0.0, 0.0, 0.0, 2.000000000002, 40.0, 9.4246420402321833931, 0.00013594996548178881858},
    {1.0, 1.0, 0.0, 0.0, 0.0, 2.000000000002, 1000000.0, 211482.59160611995323, 0.001055587898891810087},
    {1.0, 1.0, 0.0, 0.0, 0.0, -2.0000000000000004, 10.0, -3.1414110538733134965, -0.0001815997211210632594},
    {1.0, 1.0, 0.0, 0.0, 0.0, -2.0000000000000004, 40.0, -8.8172408277999491182, -0.59823669742749572531},
    {1.0, 1.0, 0.0, 0.0, 0.0, -2.0000000000000004, 1000000.0, -164811.09621851782113, -0.0040185409743453620661},
    /* on it */
    {1.0, 1.0, 0.0, 0.0, 0.0, 2.0, 3.0, 2.9426086822343854829, 0.19865585483886641566},
    {1.0, 1.0, 0.0, 0.0, 0.0, 2.0, 30.0, 3.1415926535894189335, 3.743049187536069842e-13},
    {1.0, 1.0, 0.0, 0.0, 0.0, 2.0, -3.0, -2.9426086822343854829, 0.19865585483886641566},
    /* all the way round, either way, slow and fast, from far away */
    {2.0, 5.0, 0.0, 0.0, 1000.0, 4.5, 0.3, 1001.2439165501941017, 3.7980914260838319835},
    {2.0, 5.0, 0.0, 0.0, 1000.0, 4.5, 77.0, 1316.3206312678499827, 3.5267855800985022584},
    {2.0, 5.0, 0.0, 0.0, 1000.0, 4.5, 10000000.0, 41096274.805079860074, 4.0701780475486655193},
    {2.0, 5.0, 0.0, 0.0, 1000.0, 4.5, -5.0, 979.2261863327149595, 4.5103862980281648369},
    {2.0, 5.0, 0.0, 0.0, -3.0, -400.0, 0.01, -7.0000699341937082257, -400.01089890653774622},
    {2.0, 5.0, 0.0, 0.0, -3.0, -400.0, 300000.0, -120001859.19960760544, -400.01181138765294745},
    /* G < 0: it hangs at rest + pi; from next to the top */
    {2.0, -5.0, 0.0, 0.0, 1e-09, 0.0, 3.0, 5.7417271239414647264e-8, 9.0770907186450873299e-8},
    {2.0, -5.0, 0.0, 0.0, 1e-09, 0.0, 20.0, 6.2825943546519144382, 0.00093437797464115549432},
    {2.0, -5.0, 0.0, 0.0, 1e-09, 0.0, 1000000.0, 1.4326243459526021073e-9, -1.6220454036617785449e-9},
    {2.0, -5.0, 1.0, 0.0, 3.5, 0.4, 3.0, 3.9473998519237818501, -1.0297090423990699484},
    {2.0, -5.0, 1.0, 0.0, 3.5, 0.4, 20.0, 3.4892219059498752667, -0.35709384573030034829},
    {2.0, -5.0, 1.0, 0.0, 3.5, 0.4, 1000000.0, 4.6825941392645684893, 0.66351238098059565038},
    /* sizes */
    {1.6905424996341288e+271, 4.226356249085322e+271, 0.0, 0.0, 1.0, 0.5, 7.0, -0.91841372952797327481, 0.76413064133325838793},
    {2.3661043723335494e-271, 3.944304526105059e-30, 0.0, 0.0, 1.0, 1.2911249390434543e+120, 2.7108143403945228e-120, -0.91841372952797327481, 1.9731762554252777459e+120},
};
/* clang-format on */

static rot_status run_scene(const row *r, double t, rot_info *info) {
  const double x[2] = {r->gravity, r->rest};
  const rot_term term = {ROT_TERM_GRAVITY, -INFINITY, INFINITY, 2, x};
  const rot_axle_scene scene = {.linear = {r->inertia, 0.0, r->start, r->theta0, r->omega0, {0}},
                                .n_terms = 1,
                                .terms = &term};
  return rot_axle_pendulum(&scene, 1, &t, &columns, NULL, NULL, info);
}

static void test_table(void) {
  for (size_t i = 0; i < sizeof table / sizeof *table; i++) {
    rot_info info;
    ROT_CHECK_EQ_INT(run_scene(&table[i], table[i].t, &info), ROT_OK);
    /* 2e-13 after 26000 turns 1e-16 from the separatrix; else 1e-14. */
    const int near_separatrix = table[i].omega0 == -2.0000000000000004;
    check_row(&info, table[i].theta, table[i].omega, near_separatrix ? 3e-13 : 3e-14);
  }
}

/* Products that are no doubles, to twice the precision (mpmath, 60 digits): m g d of 0.3, 9.80665
 * and 0.7 on 1 kg m^2, after 4e7 rad of phase. */
static void test_long_products(void) {
  const double x[3] = {2.0593964999999996, 0.0, 4.1826153651669544e-17}, t = 1e8;
  const rot_term term = {ROT_TERM_GRAVITY, -INFINITY, INFINITY, 3, x};
  const rot_axle_scene scene = {
      .linear = {1.0, 0.0, 0.0, 1.0, 0.0, {0}}, .n_terms = 1, .terms = &term};
  rot_info info;
  ROT_CHECK_EQ_INT(rot_axle_pendulum(&scene, 1, &t, &columns, NULL, NULL, &info), ROT_OK);
  check_row(&info, 0.78305838919908771639, -0.83297031596623563464, 3e-14);
}

static double energy(const row *r, double theta, double omega) {
  const double s = sin(0.5 * (theta - r->rest));
  return 0.5 * r->inertia * omega * omega + 2.0 * r->gravity * s * s;
}

/* Energy, the mirror image in time, and the way back, from a swing to a spin. */
static void test_metamorphic(void) {
  for (double omega0 = 0.01; omega0 < 50.0; omega0 *= 1.7) {
    const row r = {1.3, 2.7, 0.125, 0.0, 0.75, omega0, 0.0, 0.0, 0.0};
    for (double t = 0.1; t < 1e4; t *= 7.3) {
      rot_info info;
      row mirror = r;
      mirror.omega0 = -omega0;
      ROT_CHECK_EQ_INT(run_scene(&mirror, -t, &info), ROT_OK);
      const double theta = got[0], omega = got[1];
      ROT_CHECK_EQ_INT(run_scene(&r, t, &info), ROT_OK);
      ROT_CHECK(fabs(got[0] - theta) <= 2.0 * info.measure[ROT_THETA].error);
      ROT_CHECK(fabs(got[1] + omega) <= 2.0 * info.measure[ROT_OMEGA].error);
      const double scale =
          1.3 * got[1] * info.measure[ROT_OMEGA].error + 2.7 * info.measure[ROT_THETA].error;
      ROT_CHECK(fabs(energy(&r, got[0], got[1]) - energy(&r, r.theta0, omega0)) <=
                2.0 * fabs(scale) + 1e-15 * energy(&r, r.theta0, omega0));
      row back = r;
      back.start = t;
      back.theta0 = got[0];
      back.omega0 = got[1];
      ROT_CHECK_EQ_INT(run_scene(&back, 0.0, &info), ROT_OK);
      /* A rounded state has another period: what it was off for grows with the time. */
      ROT_CHECK(fabs(got[0] - r.theta0) <= 1e-14 * (1.0 + t * omega0) * (1.0 + omega0));
    }
  }
}

/* After a period all is as before; a swing has turned by nothing, a spin by one turn. */
static void test_period(void) {
  const double amplitude[] = {1e-300, 1e-8, 0.1, 1.0, 3.0, 3.1415916535897933};
  /* mpmath, 50 digits: (4/w0) K(sin^2(amplitude/2)), w0 = sqrt(2.5). */
  const double want[] = {3.9738353063184404938, 3.9738353063184405186, 3.9763203772408238825,
                         4.2374366734220956008, 10.217660249058049735, 40.211401547783335585};
  for (int i = 0; i < 6; i++) {
    const double p = rot_pendulum_period(2.0, 5.0, amplitude[i], 0.0);
    ROT_CHECK_ULP(p, want[i], 2);
    const row r = {2.0, 5.0, 0.0, 0.0, amplitude[i], 0.0, 0.0, 0.0, 0.0};
    rot_info info;
    ROT_CHECK_EQ_INT(run_scene(&r, p, &info), ROT_OK);
    ROT_CHECK_REL(got[0], amplitude[i], 1e-15);
    ROT_CHECK_EQ_INT(run_scene(&r, 0.5 * p, &info), ROT_OK);
    ROT_CHECK_REL(got[0], -amplitude[i], 1e-15);
  }
  for (double omega0 = 3.5; omega0 < 1e3; omega0 *= 3.0) {
    for (int side = -1; side <= 1; side += 2) {
      const row r = {2.0, 5.0, 0.0, 0.0, 0.5, side * omega0, 0.0, 0.0, 0.0};
      const double p = rot_pendulum_period(2.0, 5.0, 0.5, side * omega0);
      rot_info info;
      ROT_CHECK_EQ_INT(run_scene(&r, p, &info), ROT_OK);
      ROT_CHECK_REL(got[0], 0.5 + side * 6.283185307179586477, 4e-15);
      ROT_CHECK_REL(got[1], side * omega0, 4e-15);
    }
  }
  ROT_CHECK(isinf(rot_pendulum_period(1.0, 1.0, 0.0, 2.0)));
  ROT_CHECK(isinf(rot_pendulum_period(1.0, -1.0, 0.0, 0.0)));
  ROT_CHECK(isnan(rot_pendulum_period(1.0, 0.0, 1.0, 0.0)));
  ROT_CHECK_ULP(rot_pendulum_period(2.0, 5.0, 0.0, 0.0), 3.9738353063184406469, 1);
  ROT_CHECK_ULP(rot_pendulum_period(2.0 * 0x1p900, 5.0 * 0x1p-900, 1e-9, 0.0),
                3.9738353063184406469 * 0x1p900, 2);
}

/* Balanced exactly on the top, and hanging, it stays; on the separatrix it only comes near. */
static void test_at_rest(void) {
  rot_info info;
  const row top = {1.0, -2.0, 0.75, 0.0, 0.75, 0.0, 0.0, 0.0, 0.0};
  ROT_CHECK_EQ_INT(run_scene(&top, 1e6, &info), ROT_OK);
  ROT_CHECK(got[0] == 0.75 && got[1] == 0.0 && info.measure[ROT_THETA].error == 0.0);
  const row hanging = {1.0, 2.0, 0.75, 0.0, 0.75, 0.0, 0.0, 0.0, 0.0};
  ROT_CHECK_EQ_INT(run_scene(&hanging, 1e6, &info), ROT_OK);
  ROT_CHECK(got[0] == 0.75 && got[1] == 0.0);
  const row separatrix = {1.0, 1.0, 0.0, 0.0, 0.0, -2.0, 0.0, 0.0, 0.0};
  ROT_CHECK_EQ_INT(run_scene(&separatrix, 1e5, &info), ROT_OK);
  ROT_CHECK_ULP(got[0], -3.1415926535897932, 0);
  ROT_CHECK(got[1] <= 0.0 && got[1] > -1e-300);
}

/* Where a double does not count the turns, the angle is known to a few units of its rounding. */
static void test_uncounted(void) {
  const row r = {2.0, 3.0, 0.0, 0.0, 0.75, 1e10, 0.0, 0.0, 0.0};
  for (double t = 1e7; t < 1e12; t *= 10.0) {
    rot_info info;
    ROT_CHECK_EQ_INT(run_scene(&r, t, &info), ROT_OK);
    ROT_CHECK_REL(got[0], 1e10 * t, 1e-9);
    ROT_CHECK(info.measure[ROT_THETA].error >= 0x1p-53 * got[0]);
    ROT_CHECK(info.measure[ROT_THETA].error <= 0x1p-47 * got[0]);
  }
}

static void test_columns(void) {
  rot_info info;
  const row r = {2.0, 3.0, 0.25, 0.0, 0.75, -1.5, 0.0, 0.0, 0.0};
  ROT_CHECK_EQ_INT(run_scene(&r, 0.0, &info), ROT_OK);
  ROT_CHECK(got[0] == 0.75 && got[1] == -1.5 && got[3] == 0.0 && got[5] == -3.0);
  ROT_CHECK_ULP(got[2], -3.0 * 0.47942553860420300027, 1);
  ROT_CHECK(got[4] == got[2] && got[6] == 2.25);
}

static void test_refusals(void) {
  rot_info info;
  row r = {1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0};
  ROT_CHECK_EQ_INT(run_scene(&r, 1.0, &info), ROT_EVALUE);
  r.gravity = 1.0;
  r.theta0 = 1e16;
  ROT_CHECK_EQ_INT(run_scene(&r, 1.0, &info), ROT_ERANGE);
  r.gravity = -1.0;
  r.theta0 = 1e-200;
  ROT_CHECK_EQ_INT(run_scene(&r, 1.0, &info), ROT_ERANGE);
  r.theta0 = 0.0;
  r.omega0 = 1e200;
  ROT_CHECK_EQ_INT(run_scene(&r, 1e200, &info), ROT_ERANGE);
}

int main(void) {
  test_table();
  test_long_products();
  test_metamorphic();
  test_period();
  test_at_rest();
  test_uncounted();
  test_columns();
  test_refusals();
  return rot_test_report("axle_pendulum");
}
