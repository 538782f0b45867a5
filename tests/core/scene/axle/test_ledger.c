/* Work, heat and impulse of the axle: against 90-digit values, against each other through the
 * balance of energy, and each error against the rounding stated beside it. */
#include <stdlib.h>

#include "axle_scenes.h"
#include "scene/axle/linear.h"
#include "scene/axle/ledger.h"
#include "ground/real.h"
#include "rot_test.h"
#include "shared_table.h"

/* ---- scenes with known answers -------------------------------------------------------------- */

typedef struct known {
  double from, to, work, dissipated, impulse;
} known;

/* constant torque, no resistance */
static const known of_constant_free[] = {
    {1.0, 3.0, -12.0, 0.0, 12.0},
    {-1.0, 1.0, -84.0, 0.0, 12.0},
    {-1.0, 11.0, 576.0, 0.0, 72.0},
    {2.0, 2.0, 0.0, 0.0, 0.0},
};
/* a ramp, no resistance */
static const known of_ramp_free[] = {
    {0.0, 2.0, 40.0, 0.0, 8.0},
    {0.0, 4.0, 201.25, 0.0, 23.0},
    {-2.0, 3.0, 135.0, 0.0, 18.0},
    {1.0, 3.0, 128.0, 0.0, 16.0},
};
/* coasting */
static const known of_coasting[] = {
    {0.0, 0.1, 0.0, 6.47954448295705366, 0.0},    {0.0, 2.0, 0.0, 24.938031195583341, 0.0},
    {-2.0, 2.0, 0.0, 10085.6578685139614, 0.0},   {0.3, 400.0, 0.0, 10.1642414935149781, 0.0},
    {-0.1, 1e-09, 0.0, 8.74647026440007805, 0.0},
};
/* constant torque against resistance */
static const known of_constant_damped[] = {
    {-1.0, -0.99, 0.278308468220386695, 1.45231035916090049, 0.0400000000000000355},
    {-1.0, 1.0, 25.0254398557745004, 71.4157286694316033, 8.0},
    {-1.0, 1000000.0, 5.33335377777777778e6, 5.333401e6, 4.000004e6},
    {0.3, 20.0, 107.216585970640334, 110.016495542151498, 78.8},
    {0.9, 1.001, 0.661548365475710427, 0.812515674939619878, 0.403999999999999471},
};
/* ramps, a jump and a pulse */
static const known of_pulse[] = {
    {0.4, 1.5, 11.212408167324564, 3.89836487293597111, 3.18999999999999996},
    {0.4, 40.0, 995.633675231620575, 962.033700173231572, 108.44},
    {-3.0, 0.4, -22.2008671416973123, 27.1642598964579429, 6.56000000000000004},
    {-3.0, 40.0, 973.432808089923263, 989.197960069689515, 115.0},
    {2.0, 2.5, -5.08535945126838043, 4.65035069694697002, -0.875},
    {2.5, 3.0, 1.52540664920163117, 2.60435441527939012, 0.375},
    {3.0, 6.0, 0.0, 5.5448907370288158, 0.0},
    {6.0, 6.25, 22.6649879801436745, 1.81803974706538116, 5.0},
    {5.9, 7.0, 25.3585912094818365, 12.4739917780844568, 5.40909090909090909},
    {12.0, 17.0, 146.416874181694046, 142.949831633233556, 15.0},
};
/* all signs positive, z up to 1 */
static const known of_positive[] = {
    {0.0, 0.001, 0.00500162508265344043, 0.00125006251736165528, 0.00100030000000000002},
    {0.0, 60.0, 15250.0479130929935, 5572.59321019913733, 340.0},
    {1.0, 45.0, 6356.43408187378223, 2152.297964270146, 206.616666666666667},
    {9.0, 11.0, 225.580608689144972, 28.2439793906128309, 13.45},
};
/* torque far from its start */
static const known of_far[] = {
    {0.0, 0.01, 2.23144098350286899e-4, 3.68059274626263964e-6, 0.0300005000000000006},
    {0.0, 1000.0, 3.8635930080896e5, 3.8625930080896e5, 40750.0},
    {0.3, 1.2, 1.3214927972815454, 1.09491022810469037, 2.7067499999999999},
    {1.2, 50.0, 103.501577752261362, 103.339615287673673, 158.8928},
    {99.0, 100.5, 4.81824468721004863, 4.79825157462458433, 6.02375},
};
/* driven: negative resistance */
static const known of_driven[] = {
    {0.0, 5.0, -789.395834316627383, -90178.3032088164637, 8.5},
    {-6.0, 0.0, -1.14954026691412127, -1.07919154130950901, -4.0},
    {-6.0, 5.0, -790.545374583541505, -90179.3824003577732, 4.5},
    {-1.0, 2.0, 0.344627397500828235, -16.9222618985441432, -2.5},
};
/* a late start between close knots */
static const known of_close_knots[] = {
    {999.0, 1002.0, -23.6495541595422447, 23.9978690168700224, 1.25000000000045475},
    {1000.5, 1000.75, 0.347459090651276901, 0.0301380061760376752, -0.624999999999488409},
    {1000.5, 1002.0, 6.3369450863326542, 2.72842079591196182, -1.99999999999954525},
};
/* tiny inertia */
static const known of_tiny[] = {
    {0.0, 0.1, 1.85996375519726073e-301, 9.49514894765126152e-301, 1.05000000000000009e-301},
    {0.0, 3.0, 6.12827966134192176e-300, 7.63357805128506015e-300, 7.00000000000000051e-300},
    {0.9, 1.1, 2.58203419916498156e-301, 2.49933755894921859e-301, 4.00000000000000171e-301},
};
/* huge inertia */
static const known of_huge_inertia[] = {
    {0.0, 0.1, 1.85996375519726079e299, 9.4951489476512614e299, 1.05000000000000012e299},
    {0.0, 3.0, 6.1282796613419217e300, 7.63357805128506013e300, 7.00000000000000037e300},
    {0.9, 1.1, 2.5820341991649816e299, 2.49933755894921868e299, 4.00000000000000165e299},
};
/* long times */
static const known of_long_times[] = {
    {0.0, 1e280, 5.9999999999571437e-15, 8.99999999987143035e-10, 2.00000000000000019e-15},
    {0.0, 1e290, 5.59113093630430233e-5, 7.82847271115824303, 2.00000000000000024e-5},
    {1e289, 1e292, 4.14079591057921607e-4, 30.6131555143017731, 0.00199800000000000015},
};
/* settled at once */
static const known of_settled[] = {
    {0.0, 1e-10, 1.80000000012000007e-10, 1.80000000012000007e-10, 3.00000000010000011e-10},
    {0.0, 1.0, 3.26666666666666667, 3.26666666666666667, 4.0},
    {1.0, 5.0, 36.6666666666666667, 36.6666666666666667, 27.0},
};
/* hardly any resistance */
static const known of_hardly_damped[] = {
    {0.0, 7.0, 411.249999999999995, 1.14508333333333338e-14, 35.0},
    {3.0, 1000.0, 2.67178749999999541e5, 9.21208595833329836e-10, 1013.0},
};
/* coasting through hundreds of time constants */
static const known of_coasting_long[] = {
    {0.1, 5.7, 0.0, 8.67798971332107422, 0.0},
    {-20.7, 0.1, 0.0, 4.84014348964816523e8, 0.0},
    {-400.3, 0.1, 0.0, 9.81463701393765144e149, 0.0},
    {-800.3, -77.7, 0.0, 7.81338934924321392e298, 0.0},
    {0.3, 1500.1, 0.0, 7.37152886414674921, 0.0},
    {77.7, 800.3, 0.0, 1.13558801301080511e-28, 0.0},
};
/* an undriven start */
static const known of_undriven_start[] = {
    {0.1, 0.2, 4.41371751946560645e-6, 7.47360136502251465e-8, 0.00250000000000000039},
    {0.1, 9.1, 1.92503188421593958, 1.591694083679139, 2.6099999999999998},
    {0.7, 4.3, 0.594704845108649103, 0.369108626045031335, 1.07999999999999992},
};
/* driven through hundreds of time constants */
static const known of_driven_long[] = {
    {0.1, 5.7, 471.039602946042831, -4724.23651756986915, 11.2000000000000003},
    {0.1, 77.7, 1.51128787248967807e16, -3.6706998753236054e30, 155.200000000000006},
    {0.1, 400.3, 1.67363759888102242e76, -4.50170809133823332e150, 800.400000000000023},
    {-1500.1, 0.1, -19948.2222222222218, -19941.4166666666662, 3000.39999999999982},
};
/* a ramp driven through hundreds of time constants */
static const known of_ramp_driven_long[] = {
    {0.1, 5.7, 1271.7656162389204, -7392.70349926894201, 20.5833399973344002},
    {0.1, 20.9, 3.69012231820001682e6, -5.14906105600880188e9, 171.051792616286794},
    {0.1, 300.1, 4.72257355849443202e59, -4.41866296712043e113, 27529.2283086765327},
    {0.1, 700.3, 3.38185344026106898e134, -4.17548169067828816e262, 1.48098879248300656e5},
};

static const struct answers {
  const known *rows;
  size_t n;
} answers[AXLE_SCENES] = {
    [CONSTANT_FREE] = {of_constant_free, 4},
    [RAMP_FREE] = {of_ramp_free, 4},
    [COASTING] = {of_coasting, 5},
    [CONSTANT_DAMPED] = {of_constant_damped, 5},
    [PULSE] = {of_pulse, 10},
    [POSITIVE] = {of_positive, 4},
    [FAR] = {of_far, 5},
    [DRIVEN] = {of_driven, 4},
    [CLOSE_KNOTS] = {of_close_knots, 3},
    [TINY] = {of_tiny, 3},
    [HUGE_INERTIA] = {of_huge_inertia, 3},
    [LONG_TIMES] = {of_long_times, 3},
    [SETTLED] = {of_settled, 3},
    [HARDLY_DAMPED] = {of_hardly_damped, 2},
    [COASTING_LONG] = {of_coasting_long, 6},
    [UNDRIVEN_START] = {of_undriven_start, 3},
    [DRIVEN_LONG] = {of_driven_long, 4},
    [RAMP_DRIVEN_LONG] = {of_ramp_driven_long, 4},
};

/* ---- helpers -------------------------------------------------------------------------------- */

static rot_torque constant(double value) {
  rot_torque torque = {0, NULL, NULL, value, value, NULL, NULL};
  return torque;
}

static rot_axle_params axle(double inertia, double viscous, double omega0, rot_torque torque) {
  rot_axle_params p = {inertia, viscous, 0.0, 0.25, omega0, torque};
  return p;
}

static rot_axle_ledger ledger(const rot_axle_params *p, double from, double to) {
  rot_axle_ledger out;
  rot_info info;
  memset(&out, 0x5a, sizeof out);
  ROT_CHECK_EQ_INT(rot_axle_linear_ledger(p, from, to, NULL, &out, &info), ROT_OK);
  ROT_CHECK_EQ_INT(info.status, ROT_OK);
  return out;
}

/* omega with its bound */
static double omega_at(const rot_axle_params *p, double t, double *bound) {
  double row[7];
  const rot_axle_columns out = {row, row + 1, row + 2, row + 3, row + 4, row + 5, row + 6};
  rot_info info;
  ROT_CHECK_EQ_INT(rot_axle_linear(p, 1, &t, &out, NULL, &info), ROT_OK);
  *bound = info.measure[ROT_OMEGA].error;
  return row[1];
}

static void check_within(double got, double want, double rounding, const char *what) {
  const int ok = fabs(got - want) <= rounding + ROT_EPS * fabs(want); /* the reference's own */
  if (!ok)
    printf("%s: got %.17g, want %.17g, off by %g, stated %g\n", what, got, want, fabs(got - want),
           rounding);
  ROT_CHECK(ok);
}

/* Work - heat - gain of kinetic energy = 0, each taken by itself. */
static void check_balance(const rot_axle_params *p, const rot_axle_ledger *it, double from,
                          double to) {
  double bound0, bound1;
  const double omega0 = omega_at(p, from, &bound0), omega1 = omega_at(p, to, &bound1);
  const double I = p->inertia_kg_m2, k0 = 0.5 * (I * omega0) * omega0,
               k1 = 0.5 * (I * omega1) * omega1;
  const double rounding = it->work_rounding_j + it->dissipated_rounding_j +
                          I * fabs(omega0) * bound0 + I * fabs(omega1) * bound1 +
                          4.0 * ROT_EPS * (k0 + k1 + fabs(it->work_j));
  ROT_CHECK(fabs(it->work_j - it->dissipated_j - (k1 - k0)) <= rounding);
}

/* ---- known answers -------------------------------------------------------------------------- */

static void check_scene(int name) {
  const struct axle_scene *scene = &axle_scenes[name];
  const long failed = rot_test_failed;
  for (size_t i = 0; i < answers[name].n; i++) {
    const known *row = &answers[name].rows[i];
    const rot_axle_ledger it = ledger(&scene->p, row->from, row->to);
    check_within(it.work_j, row->work, it.work_rounding_j, "work");
    check_within(it.dissipated_j, row->dissipated, it.dissipated_rounding_j, "heat");
    check_within(it.impulse_n_m_s, row->impulse, it.impulse_rounding_n_m_s, "impulse");
    check_balance(&scene->p, &it, row->from, row->to);
    if (rot_test_failed > failed)
      printf("  in the scene: %s, from %g s to %g s\n", scene->name, row->from, row->to);
  }
}

/* Where nothing cancels: ulps, and roundings that are worth stating. */
static void check_one_sign(void) {
  double worst_work = 0.0, worst_heat = 0.0, worst_impulse = 0.0;
  for (int k = 0; k < AXLE_SCENES; k++) {
    const struct axle_scene *scene = &axle_scenes[k];
    for (size_t i = 0; i < answers[k].n && scene->one_sign; i++) {
      const known *row = &answers[k].rows[i];
      if (row->from < scene->p.start_s) continue;
      const rot_axle_ledger it = ledger(&scene->p, row->from, row->to);
      ROT_CHECK_ULP(it.work_j, row->work, 8);
      ROT_CHECK_ULP(it.dissipated_j, row->dissipated, 12);
      ROT_CHECK_ULP(it.impulse_n_m_s, row->impulse, 3);
      worst_work = fmax(worst_work, rot_test_ulp(it.work_j, row->work));
      worst_heat = fmax(worst_heat, rot_test_ulp(it.dissipated_j, row->dissipated));
      worst_impulse = fmax(worst_impulse, rot_test_ulp(it.impulse_n_m_s, row->impulse));
      ROT_CHECK(it.work_rounding_j <= 64.0 * ROT_EPS * row->work);
      ROT_CHECK(it.work_rounding_j >= 14.0 * ROT_EPS * row->work);
      ROT_CHECK(it.dissipated_rounding_j <= 128.0 * ROT_EPS * row->dissipated);
      ROT_CHECK(it.dissipated_rounding_j >= 20.0 * ROT_EPS * row->dissipated);
      ROT_CHECK(it.impulse_rounding_n_m_s <= 6.0 * ROT_EPS * row->impulse);
      ROT_CHECK(it.impulse_rounding_n_m_s >= 3.0 * ROT_EPS * row->impulse);
    }
  }
  printf("one sign: work %g ulp, heat %g ulp, impulse %g ulp\n", worst_work, worst_heat,
         worst_impulse);
}

/* Constant torque: work is torque times the angle turned, whatever the path did. */
static void check_work_of_constant_torque(void) {
  const rot_axle_params p = axle(2.0, 0.0, -4.0, constant(6.0)); /* omega = -4 + 3 t */
  const rot_axle_ledger it = ledger(&p, 0.0, 5.0);
  ROT_CHECK_ULP(it.work_j, 6.0 * 17.5, 4);
  ROT_CHECK(it.dissipated_j == 0.0);
  ROT_CHECK_ULP(it.impulse_n_m_s, 30.0, 0);
  const rot_axle_params q = axle(2.0, 3.0, 5.0, constant(6.0)); /* omega = 2 + 3 exp(-1.5 t) */
  const double turned = 2.0 * 4.0 + 2.0 * (1.0 - exp(-6.0));
  ROT_CHECK_ULP(ledger(&q, 0.0, 4.0).work_j, 6.0 * turned, 6);
}

/* A ramp 4 t on inertia 2 from rest: omega = t^2, work = int 4 t^3 = t^4. */
static void check_work_of_ramp(void) {
  static const double time_s[] = {0.0, 3.0}, torque_n_m[] = {0.0, 12.0};
  const rot_torque ramp = {2, time_s, torque_n_m, 0.0, 12.0, NULL, NULL};
  const rot_axle_params p = axle(2.0, 0.0, 0.0, ramp);
  ROT_CHECK_ULP(ledger(&p, 0.0, 3.0).work_j, 81.0, 4);
  ROT_CHECK_ULP(ledger(&p, 1.0, 3.0).work_j, 80.0, 4);
  ROT_CHECK_ULP(ledger(&p, 1.0, 3.0).impulse_n_m_s, 16.0, 1);
  /* From nearly nothing to the end of the doubles, and back: omega = 0.5, K = I/8. */
  static const double ends[][2] = {{1e-250, 1e250}, {1e250, 1e-250}};
  for (int k = 0; k < 2; k++) {
    const double once_s[] = {0.0, 1.0};
    const rot_torque wide = {2, once_s, ends[k], ends[k][0], ends[k][1], NULL, NULL};
    const rot_axle_params heavy = axle(1e250, 0.0, 0.0, wide);
    ROT_CHECK_REL(ledger(&heavy, 0.0, 1.0).work_j, 0.125e250, 1e-15);
  }
}

/* A coasting body loses K0 (1 - exp(-2 z)) to heat, over every size of z. */
static void check_heat_of_coasting(void) {
  const rot_axle_params p = axle(2.0, 3.0, 5.0, constant(0.0));
  for (double z = 1e-9; z < 1e9; z *= 1.9) {
    const rot_axle_ledger it = ledger(&p, 0.0, z / 1.5);
    ROT_CHECK_ULP(it.dissipated_j, 25.0 * -expm1(-2.0 * z), 12);
    ROT_CHECK(it.work_j == 0.0 && it.impulse_n_m_s == 0.0);
  }
}

/* The two methods of the heat meet at |z| = 3, the two of the work at z = 8. */
static void check_borders(void) {
  static const double time_s[] = {0.0, 8.0}, torque_n_m[] = {1.0, 17.0};
  static const double row[][2] = {{3.0, 2.0}, {-3.0, 2.0}, {8.0, 2.0}}; /* c, t at the border */
  const rot_torque ramp = {2, time_s, torque_n_m, 1.0, 17.0, NULL, NULL};
  for (int i = 0; i < 3; i++) {
    const rot_axle_params p = axle(2.0, row[i][0], 5.0, ramp);
    const rot_axle_ledger below = ledger(&p, 0.0, nextafter(row[i][1], 0.0)),
                          above = ledger(&p, 0.0, nextafter(row[i][1], 3.0));
    ROT_CHECK_REL(below.dissipated_j, above.dissipated_j, 4e-15);
    ROT_CHECK_REL(below.work_j, above.work_j, 4e-15);
  }
}

/* ---- intervals ------------------------------------------------------------------------------ */

static void check_additive(void) {
  static const double time_s[] = {0.5, 2.0, 2.0, 5.0}, torque_n_m[] = {1.0, 5.0, -3.0, 2.0};
  const rot_torque torque = {4, time_s, torque_n_m, 1.0, 2.0, NULL, NULL};
  const double viscous[] = {0.0, 0.3, -0.3}, cut[] = {-1.0, 0.0, 0.2, 0.5, 1.1, 2.0, 4.0, 7.0};
  for (int v = 0; v < 3; v++) {
    const rot_axle_params p = axle(0.7, viscous[v], 2.0, torque);
    const rot_axle_ledger whole = ledger(&p, cut[0], cut[7]);
    double work = 0.0, heat = 0.0, impulse = 0.0, work_rounding = 0.0, heat_rounding = 0.0;
    for (int i = 0; i < 7; i++) {
      const rot_axle_ledger part = ledger(&p, cut[i], cut[i + 1]);
      work += part.work_j;
      heat += part.dissipated_j;
      impulse += part.impulse_n_m_s;
      work_rounding += part.work_rounding_j;
      heat_rounding += part.dissipated_rounding_j;
    }
    check_within(work, whole.work_j, work_rounding + whole.work_rounding_j, "sum of work");
    check_within(heat, whole.dissipated_j, heat_rounding + whole.dissipated_rounding_j,
                 "sum of heat");
    check_within(impulse, whole.impulse_n_m_s, 2e-14, "sum of impulse");
  }
}

static void check_empty_interval(void) {
  const rot_axle_params p = axle(0.7, 0.3, 2.0, constant(5.0));
  const double at[] = {-1.0, 0.0, 3.0};
  for (int i = 0; i < 3; i++) {
    const rot_axle_ledger none = ledger(&p, at[i], at[i]);
    ROT_CHECK(none.work_j == 0.0 && none.dissipated_j == 0.0 && none.impulse_n_m_s == 0.0);
    ROT_CHECK(none.work_rounding_j == 0.0 && none.dissipated_rounding_j == 0.0);
    ROT_CHECK(none.impulse_rounding_n_m_s == 0.0);
  }
}

/* The same motion, its state given before, within or after the interval. */
static void check_start_before_and_after(void) {
  const rot_axle_params p = axle(0.7, 0.3, 2.0, constant(5.0));
  const double starts[] = {-2.0, 0.5, 3.0, 6.0};
  const rot_axle_ledger want = ledger(&p, 0.25, 4.0);
  for (int i = 0; i < 4; i++) {
    double bound;
    rot_axle_params q = p;
    q.start_s = starts[i];
    q.omega0_rad_per_s = omega_at(&p, starts[i], &bound);
    const rot_axle_ledger got = ledger(&q, 0.25, 4.0);
    ROT_CHECK_REL(got.work_j, want.work_j, 8e-15);
    ROT_CHECK_REL(got.dissipated_j, want.dissipated_j, 8e-15);
    ROT_CHECK_ULP(got.impulse_n_m_s, 18.75, 1);
  }
}

/* Torque and motion mirrored: the same energies, the impulse turned, the same roundings. */
static void check_mirror(void) {
  static const double time_s[] = {0.5, 2.0, 2.0, 5.0, 5.0, 9.0},
                      torque_n_m[] = {1.0, 5.0, -3.0, 2.0, 0.0, 1.0},
                      mirrored[] = {-1.0, -5.0, 3.0, -2.0, 0.0, -1.0};
  const rot_torque torque = {6, time_s, torque_n_m, 1.0, 2.0, NULL, NULL},
                   turned = {6, time_s, mirrored, -1.0, -2.0, NULL, NULL};
  const double viscous[] = {0.0, 0.3, 0.9, 4.0, 30.0, -0.3, -3.0};
  for (int v = 0; v < 7; v++) {
    for (int sign = -1; sign <= 1; sign += 2) {
      const rot_axle_params p = axle(0.7, viscous[v], 2.0 * sign, torque),
                            q = axle(0.7, viscous[v], -2.0 * sign, turned);
      const rot_axle_ledger a = ledger(&p, 0.1, 11.0), b = ledger(&q, 0.1, 11.0);
      ROT_CHECK(a.work_j == b.work_j && a.dissipated_j == b.dissipated_j);
      ROT_CHECK(a.impulse_n_m_s == -b.impulse_n_m_s);
      ROT_CHECK(a.work_rounding_j == b.work_rounding_j);
      ROT_CHECK(a.dissipated_rounding_j == b.dissipated_rounding_j);
      ROT_CHECK(a.impulse_rounding_n_m_s == b.impulse_rounding_n_m_s);
    }
  }
}

/* An error of omega that earlier pieces left moves work and heat: by e int torque dt, and by
 * 2 c int omega e dt. A violent push back and forth leaves a slow body with a large one. */
static void check_error_passed_on(void) {
  static const double time_s[] = {0.0, 1.0, 1.0, 2.0, 2.0, 7.0},
                      torque_n_m[] = {1e6, 1e6, -1e6, -1e6, 1.0, 5.0};
  const rot_torque torque = {6, time_s, torque_n_m, 0.0, 0.0, NULL, NULL};
  double bound;
  const rot_axle_params p = axle(2.0, 0.0, 3.0, torque);
  ROT_CHECK(omega_at(&p, 2.0, &bound) == 3.0);
  ROT_CHECK_REL(ledger(&p, 2.0, 7.0).work_rounding_j, 15.0 * bound, 0.01);
  const rot_axle_params q = axle(2.0, 1e-9, 3.0, torque);
  const double omega = omega_at(&q, 2.0, &bound);
  const double mean = omega + 5.0 * (1.0 + (5.0 - 1.0) / 3.0) / 2.0 / 2.0;
  ROT_CHECK(ledger(&q, 2.0, 7.0).dissipated_rounding_j >= 0.99 * 2e-9 * 5.0 * mean * bound);
  ROT_CHECK(ledger(&q, 2.0, 7.0).dissipated_rounding_j <= 8e-9 * 5.0 * mean * bound);
}

/* Without torque all of it counts: 2 c omega e t. */
static void check_error_passed_on_coasting(void) {
  static const double time_s[] = {0.0, 1.0, 1.0, 2.0, 2.0},
                      torque_n_m[] = {1e6, 1e6, -1e6, -1e6, 0.0};
  const rot_torque torque = {5, time_s, torque_n_m, 0.0, 0.0, NULL, NULL};
  const rot_axle_params p = axle(2.0, 1e-9, 3.0, torque);
  double bound;
  const double omega = omega_at(&p, 2.0, &bound);
  ROT_CHECK_REL(ledger(&p, 2.0, 7.0).dissipated_rounding_j, 2e-9 * 5.0 * omega * bound, 0.01);
}

/* Many knots on a line: the sums carry what they round off, whatever part of them is asked for. */
static void check_many_pieces(void) {
  enum { N = 20001 };
  static double time_s[N], torque_n_m[N];
  for (int i = 0; i < N; i++) {
    time_s[i] = 0.0007 * i;
    torque_n_m[i] = 6.1;
  }
  const rot_torque torque = {N, time_s, torque_n_m, 6.1, 6.1, NULL, NULL};
  const double from[] = {0.0, 5.0, 1.0};
  for (int i = 0; i < 3; i++) {
    rot_axle_params split = axle(1.9, 1e-20, 4.3, torque),
                    whole = axle(1.9, 1e-20, 4.3, constant(6.1));
    if (i == 2) split.start_s = whole.start_s = 14.3; /* backward: the motion before its start */
    const rot_axle_ledger a = ledger(&split, from[i], 14.3), b = ledger(&whole, from[i], 14.3);
    ROT_CHECK_REL(a.work_j, b.work_j, 2e-15);
    ROT_CHECK_REL(a.dissipated_j, b.dissipated_j, 2e-15);
    ROT_CHECK_ULP(a.impulse_n_m_s, b.impulse_n_m_s, 1);
  }
}

/* ---- ends of the range ---------------------------------------------------------------------- */

/* Inertia, resistance and torque scaled alike scale the energies. */
static void check_scaling(void) {
  static const double time_s[] = {0.0, 2.0, 5.0}, unscaled_n_m[] = {1.0, 3.0, 2.0};
  const rot_torque unscaled = {3, time_s, unscaled_n_m, 1.0, 2.0, NULL, NULL};
  const rot_axle_params q = axle(2.0, 0.7, 4.0, unscaled);
  const rot_axle_ledger want = ledger(&q, 0.5, 7.0);
  for (int e = -960; e <= 960; e += 120) {
    const double times = ldexp(1.0, e);
    const double torque_n_m[] = {times, 3.0 * times, 2.0 * times};
    const rot_torque torque = {3, time_s, torque_n_m, times, 2.0 * times, NULL, NULL};
    const rot_axle_params p = axle(2.0 * times, 0.7 * times, 4.0, torque);
    const rot_axle_ledger got = ledger(&p, 0.5, 7.0);
    ROT_CHECK_ULP(got.work_j, times * want.work_j, 2);
    ROT_CHECK_ULP(got.dissipated_j, times * want.dissipated_j, 2);
    ROT_CHECK_ULP(got.impulse_n_m_s, times * want.impulse_n_m_s, 1);
    ROT_CHECK_REL(got.work_rounding_j, times * want.work_rounding_j, 1e-9);
    ROT_CHECK_REL(got.dissipated_rounding_j, times * want.dissipated_rounding_j, 1e-9);
  }
}

/* Speeds and torques whose squares leave the doubles, while the energies do not. */
static void check_speed_scaling(void) {
  static const double time_s[] = {0.0, 2.0, 5.0}, unscaled_n_m[] = {1.0, 3.0, 2.0};
  const rot_torque unscaled = {3, time_s, unscaled_n_m, 1.0, 2.0, NULL, NULL};
  const double viscous[] = {0.7, 70.0};
  for (int v = 0; v < 2; v++) {
    for (int e = -600; e <= 600; e += 200) {
      for (int sign = -1; sign <= 1; sign += 2) {
        const double fast = sign * ldexp(1.0, e), light = ldexp(1.0, -e - e / 3);
        const double torque_n_m[] = {fast * light, 3.0 * fast * light, 2.0 * fast * light};
        const rot_torque torque = {3, time_s, torque_n_m, 0.0, 0.0, NULL, NULL};
        for (double omega = 0.0; omega <= 4.0; omega += 4.0) {
          const rot_axle_params p = axle(2.0 * light, viscous[v] * light, omega * fast, torque),
                                q = axle(2.0, viscous[v], omega, unscaled);
          const rot_axle_ledger got = ledger(&p, 0.5, 4.9), want = ledger(&q, 0.5, 4.9);
          ROT_CHECK_ULP(got.work_j, light * fast * fast * want.work_j, 2);
          ROT_CHECK_ULP(got.dissipated_j, light * fast * fast * want.dissipated_j, 2);
        }
      }
    }
  }
}

/* Settled for ages: work and heat are both torque^2 t/c, however large c t/I. */
static void check_huge_z(void) {
  const double inertia[] = {1e-10, 1e-100, 1e-140, 1e-160, 1e-200, 1e-300};
  for (int i = 0; i < 6; i++) {
    const rot_axle_params p = axle(inertia[i], 2.0, 0.0, constant(6.0));
    const rot_axle_ledger it = ledger(&p, 0.0, 5.0);
    ROT_CHECK_REL(it.work_j, 90.0, 1e-9);
    ROT_CHECK_REL(it.dissipated_j, 90.0, 1e-9);
    ROT_CHECK(it.work_rounding_j < 1e-11 && it.dissipated_rounding_j < 1e-11);
  }
  /* Beyond, where c t/I itself is out of range. */
  const rot_axle_params p = axle(1e-308, 2e5, 0.0, constant(6e5));
  ROT_CHECK_REL(ledger(&p, 0.0, 5.0).work_j, 9e6, 1e-9);
  ROT_CHECK_REL(ledger(&p, 0.0, 5.0).dissipated_j, 9e6, 1e-9);
}

static void check_overflow(void) {
  const rot_axle_params p = axle(2.0, -2.0, 1.0, constant(0.0));
  rot_axle_ledger out;
  rot_info info;
  ROT_CHECK_EQ_INT(rot_axle_linear_ledger(&p, 0.0, 800.0, NULL, &out, &info), ROT_ERANGE);
  ROT_CHECK_EQ_INT(info.status, ROT_ERANGE);
  ROT_CHECK(info.time_s == 800.0);
  ROT_CHECK_EQ_INT(rot_axle_linear_ledger(&p, 800.0, 900.0, NULL, &out, &info), ROT_ERANGE);
  ROT_CHECK(out.work_j == 0.0 && out.dissipated_j == 0.0); /* it never came to from_s */
}

static int polled;
static rot_status stop_at_third(void *ctx, double fraction) {
  (void)ctx;
  (void)fraction;
  return ++polled == 3 ? ROT_EUNWIND : ROT_OK;
}

/* Asked every 256 pieces. */
static void check_poll(void) {
  enum { N = 2001 };
  static double time_s[N], torque_n_m[N];
  for (int i = 0; i < N; i++) {
    time_s[i] = i;
    torque_n_m[i] = 1.0;
  }
  const rot_torque torque = {N, time_s, torque_n_m, 1.0, 1.0, NULL, NULL};
  const rot_axle_params p = axle(2.0, 0.3, 1.0, torque);
  const rot_hooks hooks = {stop_at_third, NULL};
  rot_axle_ledger out;
  rot_info info;
  ROT_CHECK_EQ_INT(rot_axle_linear_ledger(&p, 0.0, 3000.0, &hooks, &out, &info), ROT_EUNWIND);
  ROT_CHECK_EQ_INT(info.status, ROT_EUNWIND);
  ROT_CHECK_EQ_INT(info.steps, 3 * 256);
  ROT_CHECK(info.time_s == 768.0);
  ROT_CHECK_ULP(out.impulse_n_m_s, 768.0, 0);
  ROT_CHECK_EQ_INT(rot_axle_linear_ledger(&p, 0.0, 3000.0, NULL, &out, &info), ROT_OK);
  ROT_CHECK_EQ_INT(info.steps, N);
}

/* ---- the shared table ----------------------------------------------------------------------- */

static void check_shared_row(const double in[6], const double want[3]) {
  const double h = in[2], time_s[] = {0.0, h}, torque_n_m[] = {in[3], in[4]};
  const rot_torque torque = {2, time_s, torque_n_m, in[3], in[4], NULL, NULL};
  const rot_axle_params p = axle(in[0], in[1], in[5], torque);
  const rot_axle_ledger it = ledger(&p, 0.0, h);
  check_within(it.work_j, want[0], it.work_rounding_j, "work in the shared table");
  check_within(it.dissipated_j, want[1], it.dissipated_rounding_j, "heat in the shared table");
  check_within(it.impulse_n_m_s, want[2], it.impulse_rounding_n_m_s, "impulse in the shared table");
  check_balance(&p, &it, 0.0, h);
  if (in[3] >= 0.0 && in[4] >= 0.0 && in[5] >= 0.0) { /* nothing cancels */
    ROT_CHECK_ULP(it.work_j, want[0], 6);
    ROT_CHECK_ULP(it.dissipated_j, want[1], 12);
    ROT_CHECK_ULP(it.impulse_n_m_s, want[2], 2);
  }
}

static void check_shared_table(void) {
  FILE *file = shared_table("refs/fixed_axis_linear.csv");
  double x[11];
  long rows = 0;
  if (!file) return;
  while (shared_row(file, 11, x)) {
    check_shared_row(x, x + 8);
    rows++;
  }
  ROT_CHECK(rows >= 60);
}

int main(void) {
  for (int i = 0; i < AXLE_SCENES; i++) check_scene(i);
  check_one_sign();
  check_work_of_constant_torque();
  check_work_of_ramp();
  check_heat_of_coasting();
  check_borders();
  check_additive();
  check_empty_interval();
  check_start_before_and_after();
  check_mirror();
  check_error_passed_on();
  check_error_passed_on_coasting();
  check_many_pieces();
  check_scaling();
  check_speed_scaling();
  check_huge_z();
  check_overflow();
  check_poll();
  check_shared_table();
  return rot_test_report("axle_ledger");
}
