/* A body on an incline against mpmath: v and R omega marched separately from event to event, with a
 * search for the forces that fit, 60 digits; the shared table of slip to roll; limits. */
#include "scene/incline/incline.h"

#include "ground/real.h"
#include "rot_test.h"
#include "shared_table.h"

enum { ROWS = 64 };

/* Columns of one run. */
typedef struct table {
  double c[11][ROWS];
  int rolling[ROWS];
  rot_incline_columns out;
} table;

static rot_status run(const rot_incline_params *p, size_t n, const double t[], table *to,
                      rot_events *events, rot_info *info) {
  to->out = (rot_incline_columns){to->c[0], to->c[1], to->c[2], to->c[3], to->c[4],  to->c[5],
                                  to->c[6], to->c[7], to->c[8], to->c[9], to->c[10], to->rolling};
  return rot_incline_run(p, n, t, &to->out, events, NULL, NULL, info);
}

/* ---- random scenes --------------------------------------------------------------------------- */

/* Events: R roll, L slip, V reverse, S stick, X slip_reverse. */
typedef struct incline_case {
  rot_incline_params p;
  double t, x, v, theta, omega, slip_heat, rolling_heat;
  const char *events;
} incline_case;

static const incline_case cases[] = {
#ifdef MORE_CASES
#include MORE_CASES
#else
    {{2.73, 0.51, 0.47338199999999997, 37.8, 9.81, 0.103, 0.103, 0.007752, 0.0, 3.02, 0.0,
      5.921568627450981, 0.0},
     0.201,
     0.71234988882798843845,
     4.0680585953033671062,
     1.2306704409804278695,
     6.3239083972298932688,
     0.18463133993922615947,
     0.20188287805643265766,
     ""},
    {{10.9, 0.564, 1.7336231999999998, 42.2, 9.80665, 0.30189400000000005, 0.557, 0.0, 0.0, 4.16,
      0.0, 7.375886524822696, 0.0},
     2.03,
     17.493374303685624117,
     13.074851530724754342,
     31.016621105825577655,
     23.182360870079353897,
     0.0,
     0.0,
     ""},
    {{14.4, 0.43, 2.66256, 4.1, 1.62, 0.6331, 0.974, 0.007353, 0.0, -3.27, 0.0, -7.604651162790698,
      0.0},
     4.0,
     -12.506172142449183264,
     -2.9830860712245916144,
     -29.084121261509728972,
     -6.9374094679641666526,
     0.0,
     4.9760546432088857457,
     ""},
    {{18.8, 0.24, 0.433152, 0.0, 9.81, 0.110561, 0.209, 0.0, 0.0, 3.38, 0.0, 33.2, 0.0},
     3.22,
     14.312405728154409078,
     4.6908571428571428855,
     71.187273665058256164,
     19.54523809523809608,
     56.533598171428585472,
     0.0,
     "R"},
    {{17.2, 0.169, 0.49124920000000005, -1.7, 9.81, 0.684, 0.684, 0.0, 0.0, 0.0, 0.0, -33.7, 0.0},
     4.33,
     -13.10274682591044816,
     -3.4777209749382380519,
     -84.533192281491858237,
     -20.578230620936318455,
     136.51495445100856615,
     0.0,
     "R"},
    {{16.3, 0.0882, 0.0507206448, 47.9, 9.80665, 0.547324, 0.934, 0.0, 0.0, 3.32, 0.0, -28.8, 0.0},
     4.71,
     66.322883778258187996,
     26.12521190289686892,
     715.35456761884319002,
     296.20421658613229859,
     189.37372950358994725,
     0.0,
     "R"},
    {{7.77, 0.34, 0.898212, 0.0, 9.80665, 0.472, 0.472, 0.04046, 0.0, 1.37, 0.0, 0.0, 0.0},
     4.21,
     0.46007809013764467717,
     0.0,
     1.0120112526083534375,
     0.0,
     4.1717685672727275868,
     3.1199879327272731477,
     "RS"},
    {{7.23, 0.0392, 0.031441037376, -4.03, 1.62, 0.891, 0.891, 0.039592, 0.0, 1.0, 0.0, 29.0, 0.0},
     2.88,
     1.326859567436378705,
     0.0,
     33.947442676347975874,
     0.0,
     0.040393206576102738186,
     15.703362104904184048,
     "RS"},
    {{19.6, 0.317, 0.7208678904, -1.88, 9.81, 0.8, 0.8, 0.279911, 0.0, 3.65, 0.0, 11.6, 0.0},
     2.65,
     1.0173982886208232506,
     0.0,
     3.2094805056996922905,
     0.0,
     0.0010810373575709851685,
     172.64179997252913139,
     "RS"},
    {{4.91, 0.0527, 0.00545459756, -4.78, 9.80665, 0.474, 0.474, 0.0, 0.0, 0.0, 0.0, 25.7, 0.0},
     4.27,
     -3.6859903421464897619,
     -2.1054551680233038514,
     -68.81243335271181627,
     -39.951710968184136193,
     1.3549779135516843294,
     0.0,
     "RV"},
    {{11.4, 0.581, 3.8481954, 38.4, 9.81, 0.567, 0.567, 0.00047177199999999997, 0.0, -1.54, 0.0,
      0.0, 0.0},
     2.52,
     7.6873925096117629525,
     6.901469571184770297,
     13.369164643896638989,
     11.878605113915268092,
     3.9800917400307715182,
     0.56092044260173939474,
     "RV"},
    {{16.9, 0.259, 0.45346756, 2.72, 9.80665, 0.361, 0.361, 0.0, 0.0, -1.34, 0.0, 0.0, 0.0},
     4.16,
     -1.1254002843089055806,
     0.42568813040514917971,
     -4.0752498064797317653,
     1.6435835150777960099,
     4.1779953294954396921,
     0.0,
     "RV"},
    {{3.64, 0.0334, 0.0040606384, 62.6, 1.62, 0.78754, 0.845, 0.024148199999999998, 0.0, -4.77, 0.0,
      17.2, 0.0},
     4.02,
     -4.5020056296688061029,
     1.3788344584052998031,
     3.8242556450819594967,
     2.3337779031530620424,
     14.398366369170916909,
     0.57213342015185012128,
     "RVL"},
    {{16.7, 0.365, 1.1124287499999999, 4.1, 1.62, 0.7536100000000001, 0.806, 0.29163500000000003,
      0.0, 2.15, 0.0, 0.0, 0.0},
     2.71,
     2.0975173365340756971,
     0.0,
     0.0,
     0.0,
     42.655085708119897527,
     0.0,
     "S"},
    {{15.2, 0.584, 2.3483751936, 3.05, 1.62, 0.12771000000000002, 0.33, 0.5250159999999999, 0.0,
      -0.077, 0.0, 0.0, 0.0},
     3.83,
     -0.010124895949829099372,
     0.0,
     0.0,
     0.0,
     0.031794972556052999339,
     0.0,
     "S"},
    {{17.7, 0.169, 0.13699854870000003, 0.0, 9.81, 0.24775999999999998, 0.304, 0.12370800000000001,
      0.0, -1.0, 0.0, 29.3, 0.0},
     1.59,
     -0.20571682108594125259,
     0.0,
     2.0453730451327741319,
     0.0,
     23.720744058770105475,
     43.935197977961409012,
     "S"},
    {{13.7, 0.189, 0.3262518, 90.0, 9.81, 0.747, 0.747, 0.0, 0.0, -0.981, 0.0, -17.9, 0.0},
     1.29,
     6.8969205000000008504,
     11.673900000000001007,
     -23.090999999999998803,
     -17.899999999999998579,
     0.0,
     0.0,
     "V"},
    {{2.58, 0.0296, 0.0022604928, 90.0, 9.80665, 0.0995, 0.0995, 0.0017878400000000002, 0.0, -1.87,
      0.0, -63.17567567567568, 0.0},
     5.06,
     116.08057196999997341,
     47.751648999999993142,
     -319.6689189189188983,
     -63.17567567567567648,
     0.0,
     0.0,
     "V"},
    {{18.3, 0.557, 2.2710226800000006, 90.0, 9.80665, 0.58, 0.58, 0.078537, 0.0, -0.974, 0.0,
      -1.7486535008976658, 0.0},
     1.54,
     10.128765569999999853,
     14.128240999999999483,
     -2.6929263913824054986,
     -1.7486535008976658678,
     0.0,
     0.0,
     "V"},
    {{10.3, 0.107, 0.04716988, 0.0, 9.80665, 0.74, 0.74, 0.0, 0.0, -0.549, 0.0, 35.2, 0.0},
     5.47,
     3.6365810456199347357,
     0.68397142857142853082,
     37.41290080327254102,
     6.3922563417890518159,
     27.401939249714289405,
     0.0,
     "VR"},
    {{6.23, 0.246, 0.18850734, 8.51, 9.80665, 0.497, 0.497, 0.0, 0.0, -0.0554, 0.0, 25.2, 0.0},
     5.04,
     22.106424277889768041,
     6.9055252866502974778,
     94.860530940230538177,
     28.071241002643486087,
     36.915012607157292543,
     0.0,
     "VR"},
    {{1.99, 0.214, 0.036453616, 42.7, 9.80665, 0.160066, 0.326, 0.0, 0.0, -1.83, 0.0, 5.85, 0.0},
     2.9,
     17.094797706453138527,
     12.826525804917122706,
     81.958547634680138928,
     59.93703647157534093,
     1.0200390709112429814,
     0.0,
     "VR"},
    {{16.8, 0.536, 14.045326848000002, 13.7, 9.81, 0.749, 0.749, 0.78256, 0.0, 3.5, 0.0, -11.7,
      0.0},
     2.01,
     1.2352979899844502796,
     0.0,
     -5.0863845104613881678,
     0.0,
     475.11145577302146128,
     637.33810588144045251,
     "VRS"},
    {{18.3, 0.186, 0.3273162156, 0.0, 1.62, 0.799654, 0.821, 0.25482, 0.0, 0.0887, 0.0, -32.1, 0.0},
     2.98,
     -0.59623566340411353578,
     0.0,
     -14.956171589239891866,
     0.0,
     55.722131492701756471,
     112.98480872899626649,
     "VXS"},
#endif
};

static char letter(rot_event event) {
  return event == ROT_EVENT_ROLL      ? 'R'
         : event == ROT_EVENT_SLIP    ? 'L'
         : event == ROT_EVENT_REVERSE ? 'V'
         : event == ROT_EVENT_STICK   ? 'S'
                                      : 'X';
}

static void check_close(double got, double want, double error) {
  ROT_CHECK(fabs(got - want) <= error + ROT_EPS * fabs(want));
}

/* Each value within the bound reported; the bound relative to the motion is small. */
static void random_scenes(void) {
  double worst = 0.0;
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
    const incline_case *c = &cases[i];
    rot_events events = {0};
    rot_info info;
    table rows;
    ROT_CHECK(run(&c->p, 1, &c->t, &rows, &events, &info) == ROT_OK);
    check_close(rows.c[0][0], c->x, info.measure[ROT_INCLINE_X].error);
    check_close(rows.c[1][0], c->v, info.measure[ROT_INCLINE_V].error);
    check_close(rows.c[2][0], c->theta, info.measure[ROT_INCLINE_THETA].error);
    check_close(rows.c[3][0], c->omega, info.measure[ROT_INCLINE_OMEGA].error);
    check_close(rows.c[9][0], c->slip_heat, 1e-12 * (c->slip_heat + 1e-3));
    check_close(rows.c[10][0], c->rolling_heat, 1e-12 * (c->rolling_heat + 1e-3));
    worst = fmax(worst, rot_info_error(&info));
    size_t n = 0;
    for (; n < events.count && c->events[n]; n++) {
      ROT_CHECK(letter(events.event[n]) == c->events[n]);
    }
    ROT_CHECK(n == events.count && !c->events[n]);
    rot_events_free(&events);
  }
  printf("largest relative error bound: %.2g\n", worst);
  ROT_CHECK(worst < 1e-12);
}

/* ---- slip to roll ---------------------------------------------------------------------------- */

static void slip_to_roll(void) {
  FILE *file = shared_table("refs/slip_to_roll.csv");
  double x[14], worst = 0.0;
  while (file && shared_row(file, 14, x)) {
    const double deg = x[4] * 57.29577951308232;
    const rot_incline_params p = {
        x[0], x[1], x[2] * x[0] * x[1] * x[1], deg, x[5], x[3], x[3], 0.0, 0.0, x[6], 0.0,
        x[7], 0.0};
    const double t[] = {isfinite(x[8]) ? x[8] : 100.0, isfinite(x[8]) ? 1.001 * x[8] : 100.0};
    rot_events events = {0};
    rot_info info;
    table rows;
    ROT_CHECK(run(&p, 2, t, &rows, &events, &info) == ROT_OK);
    double rolls = INFINITY;
    for (size_t i = 0; i < events.count; i++) {
      if (events.event[i] == ROT_EVENT_ROLL) rolls = events.time_s[i];
    }
    rot_events_free(&events);
    if (!isfinite(x[8])) {
      ROT_CHECK(rolls == INFINITY);
      continue;
    }
    /* The angle in degrees is a rounding off that of the table: relative to the largest terms. */
    const double pull = x[5] * fabs(sin(x[4])), rub = x[3] * x[5] * cos(x[4]);
    const double u = fabs(x[6] - x[1] * x[7]);
    if (x[8] == 0.0) {
      ROT_CHECK(rolls == INFINITY && rows.c[4][0] == 0.0);
      continue;
    }
    const double spread = (pull + rub * (1.0 + 1.0 / x[2])) * x[8] / u;
    const double v = fmax(fabs(x[6]), fmax(fabs(x[1] * x[7]), (pull + rub) * x[8])) * spread;
    /* Too little friction: the slip passes through zero. */
    const int passes = x[3] < x[13];
    ROT_CHECK((rolls == INFINITY) == passes);
    const double off[] = {passes ? 0.0 : fabs(rolls - x[8]) / (x[8] * spread),
                          fabs(rows.c[1][0] - x[9]) / v, fabs(rows.c[3][0] - x[10]) * x[1] / v,
                          fabs(rows.c[0][0] - x[11]) / (v * x[8]),
                          fabs(rows.c[9][0] - x[12]) / (x[0] * v * u)};
    for (int i = 0; i < 5; i++) worst = fmax(worst, off[i] / (2.0 * ROT_EPS));
  }
  printf("slip to roll: %.2g ulp of the largest term\n", worst);
  ROT_CHECK(worst <= 6.0);
}

/* ---- limits ---------------------------------------------------------------------------------- */

static double after_1s(rot_incline_params p, int which) {
  const double t = 1.0;
  rot_info info;
  table rows;
  ROT_CHECK(run(&p, 1, &t, &rows, NULL, &info) == ROT_OK);
  return which == 11 ? (double)rows.rolling[0] : rows.c[which][0];
}

static void limits(void) {
  /* Sphere of 0.1 kg and 5 cm at 15 degrees, 9.81 m/s^2, from rest: v = 5/7 g sin(15). */
  rot_incline_params p = {0.1, 0.05, 1e-4, 15.0, 9.81, 0.5, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0};
  ROT_CHECK_ULP(after_1s(p, 1), 1.8135820226, 1e7);
  ROT_CHECK_ULP(after_1s(p, 5), -0.07254328093, 1e6);
  /* Infinite friction is the same; none slides without turning. */
  p.mu_static = p.mu_kinetic = INFINITY;
  ROT_CHECK_ULP(after_1s(p, 1), 1.8135820226, 1e7);
  p.mu_static = p.mu_kinetic = 0.0;
  ROT_CHECK_ULP(after_1s(p, 1), 9.81 * 0.25881904510252076, 2);
  ROT_CHECK(after_1s(p, 3) == 0.0);
  /* At 90 degrees no finite friction acts; the infinite one is a rack: v' = g/(1 + beta). */
  p.angle_deg = 90.0;
  p.mu_static = p.mu_kinetic = 1e300;
  ROT_CHECK(after_1s(p, 1) == 9.81 && after_1s(p, 3) == 0.0);
  p.mu_static = p.mu_kinetic = INFINITY;
  ROT_CHECK_ULP(after_1s(p, 1), 9.81 / 1.4, 4);
  ROT_CHECK_ULP(after_1s(p, 3), 9.81 / 1.4 / 0.05, 4);
  p.angle_deg = -90.0;
  ROT_CHECK_ULP(after_1s(p, 1), -9.81 / 1.4, 4);
  /* The co-angle: 1e-10 degrees off 90, the normal force is g 1e-10 pi/180. */
  p.angle_deg = 90.0 - 0x1p-33;
  p.mu_static = p.mu_kinetic = 1.0;
  ROT_CHECK_ULP(after_1s(p, 3), 9.81 * 0x1p-33 * 0.017453292519943295 / 0.4 / 0.05, 4);
  /* The arm holds the body on a slope of tan = 0.1 up to 0.1 R. */
  p = (rot_incline_params){1.0, 0.5, 0.1, 5.710593137499643, 9.8, 1.0, 1.0, 0.0500001, 0.0, 0.0,
                           0.0, 0.0, 0.0};
  ROT_CHECK(after_1s(p, 1) == 0.0 && after_1s(p, 11) != 0.0);
  p.arm_m = 0.0499999;
  ROT_CHECK(after_1s(p, 1) > 0.0);
  /* Thrown sliding uphill on no gravity: nothing changes. */
  p.gravity_m_per_s2 = 0.0;
  p.v0_m_per_s = -3.0;
  ROT_CHECK(after_1s(p, 1) == -3.0 && after_1s(p, 0) == -3.0);
}

static void critical_angle(void) {
  /* At the angle itself the body rolls, a little beyond it slips. */
  for (int i = 1; i < 200; i++) {
    const double beta = 0.02 * i, mu = 0.01 * (double)(i * 37 % 200 + 1);
    const double angle = rot_incline_critical_deg(beta, mu);
    rot_incline_params p = {1.0, 1.0, beta, angle, 9.8, mu, mu, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0};
    ROT_CHECK(after_1s(p, 4) == 0.0);
    p.angle_deg = angle + 1e-9;
    ROT_CHECK(after_1s(p, 4) > 0.0);
  }
  ROT_CHECK_ULP(rot_incline_critical_deg(1.0, 0.5), 45.0, 1);
  ROT_CHECK(rot_incline_critical_deg(0.0, 0.1) == 90.0);
  ROT_CHECK(rot_incline_critical_deg(0.4, INFINITY) == 90.0);
  ROT_CHECK_ULP(rot_incline_critical_deg(INFINITY, 1.0), 45.0, 1);
  ROT_CHECK(isnan(rot_incline_critical_deg(NAN, 1.0)));
}

/* ---- along a motion -------------------------------------------------------------------------- */

/* Friction stays within its cone; work, heat and impulses balance. */
static void properties(void) {
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
    const rot_incline_params *p = &cases[i].p;
    const double end = 2.0 * cases[i].t, m = p->mass_kg;
    const double normal = m * p->gravity_m_per_s2 * rot_cos_deg(p->angle_deg);
    double t[ROWS];
    rot_info info;
    table rows;
    rot_incline_ledger flows;
    for (int k = 0; k < ROWS; k++) t[k] = end * k / (ROWS - 1);
    ROT_CHECK(run(p, ROWS, t, &rows, NULL, &info) == ROT_OK);
    ROT_CHECK(rot_incline_flows(p, 0.0, end, &flows) == ROT_OK);
    for (int k = 0; k < ROWS; k++) {
      const double force = rows.c[5][k], slip = rows.c[4][k];
      ROT_CHECK(fabs(force) <= p->mu_static * normal * (1.0 + 1e-14));
      if (slip != 0.0) {
        ROT_CHECK(force * slip <= 0.0 &&
                  fabs(fabs(force) - p->mu_kinetic * normal) <= 1e-14 * fabs(force));
      }
      ROT_CHECK(!rows.rolling[k] || slip == 0.0);
      if (k) ROT_CHECK(rows.c[9][k] >= rows.c[9][k - 1] && rows.c[10][k] >= rows.c[10][k - 1]);
    }
    const int z = ROWS - 1;
    const double energy = rows.c[6][z] + rows.c[7][z] - rows.c[6][0] - rows.c[7][0];
    const double size = rows.c[6][z] + rows.c[7][z] + rows.c[6][0] + rows.c[7][0] +
                        fabs(flows.work_j) + rows.c[9][z] + rows.c[10][z];
    ROT_CHECK(fabs(energy - flows.work_j + rows.c[9][z] + rows.c[10][z]) <= 1e-12 * size);
    const double impulse = flows.gravity_impulse_n_s + flows.friction_impulse_n_s;
    ROT_CHECK(fabs(m * (rows.c[1][z] - rows.c[1][0]) - impulse) <=
              1e-12 * (m * info.measure[ROT_INCLINE_V].largest + fabs(flows.gravity_impulse_n_s)));
    const double turn = -p->radius_m * flows.friction_impulse_n_s - flows.resistance_impulse_n_m_s;
    ROT_CHECK(fabs(p->inertia_kg_m2 * (rows.c[3][z] - rows.c[3][0]) - turn) <=
              1e-12 * (p->inertia_kg_m2 * info.measure[ROT_INCLINE_OMEGA].largest +
                       p->radius_m * fabs(flows.friction_impulse_n_s)));
  }
}

/* A body launched with over-spin up a slope too steep for its grip: the slip passes zero at
 * s = u/(g sin + mu g cos (1 + 1/beta)), and goes on with the other sign. */
static void slip_reverses(void) {
  const rot_incline_params p = {1.0, 0.1, 0.004, 60.0, 9.80665, 0.2, 0.3,
                                0.0, 0.0, 1.0,   0.0,  40.0,    2.0};
  const double g = 9.80665, sine = rot_sin_deg(60.0), pull = g * sine, slides = 0.2 * g * 0.5;
  const double at_s = 3.0 / (pull + slides * 3.5), t = 2.0 + 2.0 * at_s;
  rot_events events = {0};
  rot_incline_event_rows rows = {0, 0, NULL};
  rot_info info;
  table to;
  ROT_CHECK(run(&p, 1, &t, &to, NULL, &info) == ROT_OK);
  ROT_CHECK(rot_incline_run(&p, 1, &t, &to.out, &events, &rows, NULL, &info) == ROT_OK);
  ROT_CHECK(events.count == 1 && events.event[0] == ROT_EVENT_SLIP_REVERSES);
  ROT_CHECK(rows.count == 1 && rows.row[0].time_s == events.time_s[0]);
  ROT_CHECK_ULP(events.time_s[0], 2.0 + at_s, 2);
  const rot_incline_row *row = &rows.row[0];
  ROT_CHECK_ULP(row->v_m_per_s, 1.0 + (pull + slides) * at_s, 4);
  ROT_CHECK_ULP(row->omega_rad_per_s, 40.0 - slides / 0.4 / 0.1 * at_s, 4);
  ROT_CHECK_ULP(row->x_m, at_s + 0.5 * (pull + slides) * at_s * at_s, 4);
  ROT_CHECK(fabs(row->slip_speed_m_per_s) <= 1e-14 && row->rolling == 0);
  /* After the event friction holds back. */
  ROT_CHECK_ULP(row->friction_force_n, -slides, 2);
  ROT_CHECK_ULP(to.c[1][0], 1.0 + 2.0 * pull * at_s, 8);
  rot_events_free(&events);
  rot_incline_event_rows_free(&rows);
}

/* Times whose square exceeds the range, where the answers do not. */
static void long_times(void) {
  rot_incline_params p = {1.0, 10.0, 40.0, 0.0, 0.0, 0.3, 0.3, 0.0, 0.0, 1.0, 0.0, 0.1, 0.0};
  const double t = 1e300;
  rot_info info;
  table rows;
  ROT_CHECK(run(&p, 1, &t, &rows, NULL, &info) == ROT_OK);
  ROT_CHECK_ULP(rows.c[0][0], 1e300, 1);
  ROT_CHECK_ULP(rows.c[2][0], 1e299, 1);
  ROT_CHECK(rows.c[1][0] == 1.0 && rot_info_error(&info) < 1e-14);
  /* x = g s^2/(2 (1 + beta)) = 1e-300 1e600/4 * 10/14 * 2. */
  p.angle_deg = 30.0;
  p.gravity_m_per_s2 = 1e-300;
  p.v0_m_per_s = p.omega0_rad_per_s = 0.0;
  ROT_CHECK(run(&p, 1, &t, &rows, NULL, &info) == ROT_OK);
  ROT_CHECK_ULP(rows.c[0][0], 1e300 / 4.0 / 1.4, 4);
  ROT_CHECK_ULP(rows.c[1][0], 0.5 / 1.4, 4);
  rot_incline_end end;
  ROT_CHECK(rot_incline_to(&p, t, &end) == ROT_OK);
  ROT_CHECK(end.x_m == rows.c[0][0]);
  /* Slips: without friction, and with one that heats: mu g x over twice the slip. */
  p.mu_static = p.mu_kinetic = 0.05;
  ROT_CHECK(run(&p, 1, &t, &rows, NULL, &info) == ROT_OK);
  const double held = 0.05 * sqrt(0.75);
  ROT_CHECK_ULP(rows.c[0][0], 0.5 * (0.5 - held) * 1e300, 8);
  ROT_CHECK_ULP(rows.c[9][0], 0.5 * held * (0.5 - held - held / 0.4), 16);
}

int main(void) {
  random_scenes();
  slip_reverses();
  long_times();
  slip_to_roll();
  limits();
  critical_angle();
  properties();
  return rot_test_report("incline");
}
