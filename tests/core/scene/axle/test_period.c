/* Periods at 40 digits and more: any amplitude, both sides of the separatrix, any damping. */
#include "scene/axle/period.h"
#include "rot_test.h"

static rot_axle_scene scene_of(double inertia, double viscous, double theta0, double omega0,
                               const rot_term *term) {
  rot_axle_scene scene = {.viscous_n_m_s = viscous, .n_terms = term ? 1 : 0, .terms = term};
  scene.linear.inertia_kg_m2 = inertia;
  scene.linear.viscous_n_m_s = viscous;
  scene.linear.theta0_rad = theta0;
  scene.linear.omega0_rad_per_s = omega0;
  return scene;
}

static rot_term term_of(rot_term_kind kind, const double x[2]) {
  return (rot_term){kind, -INFINITY, INFINITY, 2, x};
}

/* clang-format off */
/* mpmath, 60 digits: inertia, m g d, theta0, omega0, period, amplitude */
static const double pendulums[][6] = {
    {0.7, 3.1, 1e-300, 0.0, 2.9857128787832769592, 1.0000000000000000251e-300},
    {0.7, 3.1, 1e-150, 0.0, 2.9857128787832769592, 1.0000000000000000063e-150},
    {0.7, 3.1, 1e-08, 0.0, 2.9857128787832769779, 1.0000000000000000209e-8},
    {0.7, 3.1, 0.01, 0.0, 2.9857315395956803472, 0.010000000000000000208},
    {0.7, 3.1, 0.5, 0.0, 3.033043985054148994, 0.5},
    {0.7, 3.1, 1.0, 0.0, 3.1837678901157452897, 1.0},
    {0.7, 3.1, 1.5707963267948966, 0.0, 3.5241581278331261773, 1.570796326794896558},
    {0.7, 3.1, 2.5, 0.0, 4.9054737066537616347, 2.5},
    {0.7, 3.1, 3.0, 0.0, 7.6769663171843356129, 3.0},
    {0.7, 3.1, 3.14, 0.0, 16.197922883619957584, 3.1400000000000001243},
    {0.7, 3.1, 3.1415926, 0.0, 35.774939382107370357, 3.1415926000000000684},
    {0.7, 3.1, 3.141592653589, 0.0, 56.912784572756218752, 3.1415926535889999727},
    {0.7, 3.1, 3.1415926535897927, 0.0, 70.682566876042928823, 3.1415926535897926719},
    {0.7, 3.1, 3.141592653589793, 0.0, 73.594061038317506492, 3.141592653589793116},
    {0.7, 3.1, 0.3, 1e-06, 3.0025946252149445202, 0.30000000000038203799},
    {0.7, 3.1, 0.3, 1.0, 3.0472768052984043729, 0.56901284876015570859},
    {0.7, 3.1, 0.3, 4.2, 3.2126905755220929311, NAN},
    {0.7, 3.1, 0.3, 4.208, 3.1207427704631184302, NAN},
    {0.7, 3.1, 0.3, 4.20866, 3.113867367865293298, NAN},
    {0.7, 3.1, 0.3, 5.0, 1.6444359197226584691, NAN},
    {0.7, 3.1, 0.3, 1000.0, 0.0062832118901895584105, NAN},
    {0.7, 3.1, 0.3, 10000000000.0, 6.2831853071795864772e-10, NAN},
    {1.0, 1.0, 0.0, 1.9999999999999998, 77.632484222713878853, 3.1415926237874708508},
    {1.0, 1.0, 0.0, 2.0000000000000004, 38.123094930796987896, NAN},
    {1.0, 1.0, 0.0, 1.9999, 23.966407351423252465, 3.1215925702555234925},
    {1.0, 1.0, 0.0, 2.0001, 11.982654529254127714, NAN},
    {2.0, -5.0, 0.0, 1e-05, 17.772648555859422977, NAN},
    {2.0, -5.0, 3.0, 1.0, 4.0848024250649924771, 0.65999956761398196973},
    {2e+200, 5e-200, 1.0, 0.0, 4.2374366734220955746e+200, 1.0},
};

/* inertia, viscous, stiffness, 2 pi/sqrt(k/I - (c/(2 I))^2), exp(-c/(2 I) of that) */
static const double oscillators[][5] = {
    {0.3, 0.0, 0.7, 4.1133103250835452783, 1.0},
    {2, 1e-09, 8, 3.1415926535897932385, 0.99999999921460183691},
    {2, 0.5, 8, 3.1477466117961310213, 0.67471268776794595834},
    {2, 7.9999, 8, 628.32049422330324504, 0.0},
    {2, 7.999999999999999, 8, 210828714.13315655208, 0.0},
    {0.001, 0.1, 40.0, 0.032446229407788895611, 0.19744179036948954293},
    {3, -0.4, 11, 3.2832769788180276805, 1.2446882935226081968},
    {1e+120, 1e+70, 1e+30, 6.283185307258126168e+45, 0.99996858456693876176},
    {1.3, 1.4, 0.5, 20.420352248333651363, 0.000016775781524225847423},
};
/* clang-format on */

static void test_pendulums(void) {
  for (size_t i = 0; i < sizeof pendulums / sizeof *pendulums; i++) {
    const double *r = pendulums[i], x[] = {r[1], 0.0};
    const rot_term gravity = term_of(ROT_TERM_GRAVITY, x);
    for (int side = -1; side <= 1; side += 2) {
      const rot_axle_scene scene = scene_of(r[0], 0.0, side * r[2], r[3], &gravity);
      const rot_period got = rot_axle_period(&scene);
      ROT_CHECK_REL(got.period_s, r[4], 1e-15);
      ROT_CHECK(got.ratio == 1.0);
      if (isnan(r[5])) {
        ROT_CHECK(got.kind == ROT_PERIOD_ROTATION && isnan(got.amplitude_rad));
      } else {
        ROT_CHECK(got.kind == ROT_PERIOD_OSCILLATION);
        ROT_CHECK_REL(got.amplitude_rad, r[5], 1e-15);
      }
    }
  }
}

static void test_oscillators(void) {
  for (size_t i = 0; i < sizeof oscillators / sizeof *oscillators; i++) {
    const double *r = oscillators[i], x[] = {r[2], 0.25};
    const rot_term spring = term_of(ROT_TERM_SPRING, x);
    const rot_axle_scene scene = scene_of(r[0], r[1], 1.0, 0.0, &spring);
    const rot_period got = rot_axle_period(&scene);
    ROT_CHECK_REL(got.period_s, r[3], 1e-15);
    ROT_CHECK(fabs(got.ratio - r[4]) <= 1e-14 * r[4]);
    ROT_CHECK(got.kind == (r[1] == 0.0 ? ROT_PERIOD_OSCILLATION : ROT_PERIOD_DAMPED));
  }
}

/* A torque moves the rest angle: 0.25 + 2/8, and theta0 = 1.5, omega0 = 2 w0. */
static void test_amplitude(void) {
  const double x[] = {8.0, 0.25};
  const rot_term spring = term_of(ROT_TERM_SPRING, x);
  rot_axle_scene scene = scene_of(2.0, 0.0, 1.5, 4.0, &spring);
  scene.linear.torque.before_n_m = scene.linear.torque.after_n_m = 2.0;
  ROT_CHECK_REL(rot_axle_period(&scene).amplitude_rad, 2.2360679774997897, 1e-15);
  scene.linear.torque.before_n_m = 1.0; /* driven */
  ROT_CHECK(rot_axle_period(&scene).kind == ROT_PERIOD_UNKNOWN);
}

static void test_kinds(void) {
  const double x[] = {1.0, 0.0};
  const rot_term gravity = term_of(ROT_TERM_GRAVITY, x), spring = term_of(ROT_TERM_SPRING, x);
  rot_axle_scene s = scene_of(1.0, 0.0, 0.0, 2.0, &gravity);
  ROT_CHECK(rot_axle_period(&s).kind == ROT_PERIOD_SEPARATRIX &&
            isinf(rot_axle_period(&s).period_s));
  s = scene_of(1.0, 0.0, 0.0, 0.0, &gravity);
  ROT_CHECK(rot_axle_period(&s).kind == ROT_PERIOD_REST);
  ROT_CHECK_REL(rot_axle_period(&s).period_s, 6.283185307179586477, 1e-15);
  s = scene_of(1.0, 0.1, 1.0, 0.0, &gravity);
  ROT_CHECK(rot_axle_period(&s).kind == ROT_PERIOD_DAMPED && isnan(rot_axle_period(&s).period_s));
  s = scene_of(1.0, 2.0, 1.0, 0.0, &spring); /* critical */
  ROT_CHECK(rot_axle_period(&s).kind == ROT_PERIOD_OVERDAMPED);
  s = scene_of(1.0, 0.0, 1.0, -4.0, NULL);
  ROT_CHECK(rot_axle_period(&s).kind == ROT_PERIOD_ROTATION);
  ROT_CHECK_REL(rot_axle_period(&s).period_s, 1.5707963267948966, 1e-15);
  s = scene_of(1.0, 0.1, 1.0, -4.0, NULL);
  ROT_CHECK(rot_axle_period(&s).kind == ROT_PERIOD_NONE);
  const rot_term both[] = {gravity, spring};
  s = scene_of(1.0, 0.0, 1.0, 0.0, both);
  s.n_terms = 2;
  ROT_CHECK(rot_axle_period(&s).kind == ROT_PERIOD_UNKNOWN);
}

int main(void) {
  test_pendulums();
  test_oscillators();
  test_amplitude();
  test_kinds();
  return rot_test_report("axle_period");
}
