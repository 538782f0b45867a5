#include "scene/clutch/clutch.h"

#include "ground/real.h"
#include "rot_test.h"

/* ---- against mpmath -------------------------------------------------------------------------- */

/* Random scenes, both bodies marched by themselves from event to event; mpmath, 60 digits. The
 * letters are the events on the way: L lock, S slip, R reverse. */
typedef struct clutch_case {
  double I[2], capacity, hold;
  int n1;
  double time1[4], torque1[4];
  int n2;
  double time2[4], torque2[4], engage, theta0[2], omega0[2], t, theta[2], omega[2], heat, torque;
  int locked;
  const char *events;
  double work;
} clutch_case;

static const clutch_case cases[] = {
#ifdef MORE_CASES
#include MORE_CASES
#else
    {{0.0895, 1.5},
     1.29,
     1.935,
     3,
     {0.106, 0.135, 1.78},
     {0.0, -14.2, -2.69, 0.0},
     3,
     {0.134, 2.2, 3.04},
     {18.8, 21.9, 2.62, 13.9},
     1.24,
     {-0.22, 1.74},
     {15.15, 15.15},
     11.0,
     {306.34518743016761509, 748.26006920000000993},
     {101.78184357541900122, 113.8293333333333355},
     523.16570733586592518,
     -1.2900000000000000355,
     0,
     "",
     10522.180125546294635},
    {{13.1, 26.4},
     1.83,
     1.83,
     2,
     {0.653, 1.17},
     {0.0, -94.0, 12.2},
     0,
     {0.0},
     {-0.43},
     0.0,
     {-1.75, 1.42},
     {19.59, -16.46},
     3.42,
     {57.482224503816793574, -54.563068181818183615},
     {17.497893129770992725, -16.278636363636364473},
     210.84398561471201631,
     1.8300000000000000711,
     0,
     "",
     -375.7588357650241522},
    {{0.012, 0.511},
     1.76,
     1.76,
     0,
     {0.0},
     {6.53},
     2,
     {1.26, 6.98},
     {0.0, -0.17, 4.04},
     0.0,
     {-1.38, -1.83},
     {14.71, -7.45},
     11.0,
     {24209.180000000000718, 175.38613698630134946},
     {4387.2100000000001297, 60.315949119373772259},
     42298.685198904111102,
     1.7600000000000000089,
     0,
     "",
     158698.38801514678165},
    {{0.321, 30.2},
     1.44,
     2.16,
     0,
     {0.0},
     {-66.4},
     2,
     {0.728, 2.76},
     {0.516, 0.0, 23.2},
     0.107,
     {0.36, -1.47},
     {5.34, -6.7},
     11.0,
     {-12189.394195389408894, -51.786748713642384829},
     {-2221.1836137071652534, -0.87689642384105965427},
     17480.939753567656769,
     -1.4399999999999999467,
     0,
     "R",
     808662.02675566972158},
    {{8.96, 0.0123},
     0.152,
     0.22799999999999998,
     0,
     {0.0},
     {77.6},
     2,
     {0.437, 1.53},
     {1.24, 34.0, -27.5},
     0.0,
     {-0.76, -1.11},
     {12.15, 12.15},
     3.68,
     {102.69927680239352165, 3099.9593553295960829},
     {44.056511049586359363, -1754.9604881539686886},
     676.03520015474114489,
     0.15199999999999999623,
     0,
     "R",
     27650.652581979896878},
    {{0.0255, 0.194},
     1.0,
     1.0,
     3,
     {0.145, 4.16, 8.34},
     {-0.451, 0.0, 0.126, 0.0},
     2,
     {0.479, 4.53},
     {-7.21, 0.245, 2.48},
     0.0,
     {-1.86, -0.35},
     {-12.02, -0.91},
     11.0,
     {86.814665931195954339, 89.285434194610826848},
     {61.78924829157175035, 61.78924829157175035},
     0.96076826341487238941,
     -0.28810933940774484872,
     1,
     "L",
     418.05407215043077653},
    {{1.72, 87.7},
     14.2,
     14.2,
     3,
     {1.09, 2.12, 4.71},
     {0.0, 38.4, 0.0, 0.0},
     3,
     {0.106, 1.43, 3.09},
     {-0.794, 0.0, 65.6, -82.4},
     0.0,
     {-0.59, -1.21},
     {1.39, 1.39},
     10.7,
     {19.446315657821054922, 0.92699273615219622788},
     {-3.9633903377320510535, -3.9633903377320510535},
     254.1703854876977808,
     1.5849698054126593952,
     1,
     "SL",
     870.11157384187193272},
    {{19.7, 0.0107},
     7.69,
     7.69,
     0,
     {0.0},
     {-0.556},
     3,
     {0.126, 0.443, 4.36},
     {0.0, 0.0, -0.181, 0.0},
     0.336,
     {-0.44, -0.78},
     {-9.4, 19.52},
     1.47,
     {-14.27583384925201017, -4.3151648818135628075},
     {-9.435197278635462317, -9.435197278635462317},
     4.4752402232199302809,
     0.18059991781113810701,
     1,
     "L",
     9.4430350680289183308},
    {{7.31, 0.332},
     0.174,
     0.174,
     0,
     {0.0},
     {-6.51},
     3,
     {0.122, 1.88, 5.93},
     {-7.63, 0.881, -0.544, 0.646},
     0.0,
     {1.52, 1.75},
     {-5.03, 15.91},
     11.0,
     {-106.24885088919289031, 138.95196494578313804},
     {-14.564336525307797993, 15.235174698795181803},
     42.624921955285825999,
     -0.17399999999999998801,
     0,
     "",
     721.95944757427822704},
    {{5.78, 57.0},
     15.7,
     23.549999999999997,
     3,
     {1.34, 2.16, 2.93},
     {0.0, 2.63, 0.0, 0.0},
     2,
     {0.175, 4.82},
     {-10.5, 0.0, -20.1},
     0.0,
     {-1.57, 1.0},
     {17.38, -17.55},
     5.41,
     {54.071469723183389452, -90.147673925438602769},
     {3.0581314878892732701, -16.300166666666667368},
     2304.5895552833651745,
     15.699999999999999289,
     0,
     "",
     252.89980616499724201},
    {{0.093, 0.0524},
     0.562,
     0.8430000000000001,
     3,
     {0.32, 1.58, 7.54},
     {4.68, 3.17, 33.9, -18.6},
     3,
     {0.205, 0.634, 5.96},
     {0.307, 56.2, 0.0, -0.396},
     0.0,
     {1.41, 0.15},
     {11.18, 6.86},
     11.0,
     {13432.6386756384861, 5023.8180806893270329},
     {1512.7789326107015576, 497.47057761841113461},
     5464.8432261549761782,
     0.56200000000000005507,
     0,
     "RR",
     118356.94947986102975},
    {{36.1, 0.169},
     0.637,
     0.637,
     1,
     {0.221},
     {0.0, -12.4},
     1,
     {0.863},
     {-29.2, 0.0},
     0.0,
     {1.13, 1.53},
     {-18.17, 16.44},
     6.96,
     {-133.51277340677294277, -776.3584805650718944},
     {-20.600675807134217574, -107.91386605002842041},
     414.06897824711685126,
     0.63700000000000001066,
     0,
     "R",
     3076.2803030797227194},
    {{68.4, 26.0},
     0.532,
     0.532,
     2,
     {0.188, 1.75},
     {10.6, 0.0, 0.0},
     0,
     {0.0},
     {0.19},
     0.0,
     {0.32, 0.7},
     {-19.72, -6.61},
     4.28,
     {-83.888404748538011728, -27.711278707692310772},
     {-19.657576608187133368, -6.6662984615384618658},
     29.684071053729914522,
     -0.53200000000000002842,
     0,
     "",
     -44.665672377525863101},
    {{3.78, 9.32},
     2.95,
     2.95,
     2,
     {0.173, 0.354},
     {-0.218, -0.195, 1.33},
     2,
     {2.12, 2.19},
     {0.0, -76.6, -3.78},
     0.0,
     {-1.76, -0.82},
     {9.12, 9.69},
     8.9,
     {77.612063329889723261, 78.281179307566191991},
     {8.0421199236641226096, 8.0421199236641226096},
     1.6870798584453598459,
     2.036946564885496136,
     1,
     "LSL",
     -169.44257386535448272},
#endif
};

static double worst = 0.0;

static void check_case(const clutch_case *x) {
  enum { ROWS = 50 };
  double time[ROWS], theta[2][ROWS], omega[2][ROWS], torque[ROWS], heat[ROWS];
  int locked[ROWS];
  const rot_clutch_params p = {
      {x->I[0], x->I[1]},
      x->capacity,
      x->hold,
      {{(size_t)x->n1, x->time1, x->torque1}, {(size_t)x->n2, x->time2, x->torque2}},
      x->engage,
      0.0,
      {x->theta0[0], x->theta0[1]},
      {x->omega0[0], x->omega0[1]}};
  const rot_clutch_columns out = {theta[0], omega[0], theta[1], omega[1], torque, heat, locked};
  rot_events events = {0};
  rot_info info;
  for (int i = 0; i < ROWS; i++) time[i] = x->t * i / (ROWS - 1.0);
  time[ROWS - 1] = x->t;
  double work[ROWS], dissipated[ROWS], impulse[ROWS], off[ROT_CLUTCH_N_FLOWS];
  double *const flow[ROT_CLUTCH_N_FLOWS] = {work, dissipated, impulse};
  ROT_CHECK_EQ_INT(rot_clutch_run(&p, ROWS, time, &out, flow, off, &events, NULL, &info), ROT_OK);
  const int end = ROWS - 1;
  for (int b = 0; b < 2; b++) {
    const double theta_off = fabs(theta[b][end] - x->theta[b]);
    const double omega_off = fabs(omega[b][end] - x->omega[b]);
    ROT_CHECK(theta_off <= info.measure[ROT_THETA].error);
    ROT_CHECK(omega_off <= info.measure[ROT_OMEGA].error);
    ROT_CHECK(info.measure[ROT_OMEGA].error <= 1e-12 * info.measure[ROT_OMEGA].largest);
    worst = fmax(worst, fmax(theta_off / info.measure[ROT_THETA].error,
                             omega_off / info.measure[ROT_OMEGA].error));
    ROT_CHECK(omega[b][0] == x->omega0[b]);
  }
  ROT_CHECK(fabs(heat[end] - x->heat) <= 1e-13 * x->heat);
  ROT_CHECK(fabs(torque[end] - x->torque) <= 1e-14 * (fabs(x->torque) + x->capacity));
  ROT_CHECK_EQ_INT(locked[end], x->locked);
  ROT_CHECK_EQ_INT((long long)events.count, (long long)strlen(x->events));
  for (size_t i = 0; i < events.count && i < strlen(x->events); i++) {
    const char *name = rot_event_name(events.event[i]);
    ROT_CHECK(name[0] + 'A' - 'a' == x->events[i]);
  }
  for (int i = 1; i < ROWS; i++) ROT_CHECK(heat[i] >= heat[i - 1]);
  const double gained =
      x->I[0] * (x->omega[0] - x->omega0[0]) + x->I[1] * (x->omega[1] - x->omega0[1]);
  const double size = x->I[0] * (fabs(x->omega[0]) + fabs(x->omega0[0])) +
                      x->I[1] * (fabs(x->omega[1]) + fabs(x->omega0[1]));
  ROT_CHECK(fabs(work[end] - x->work) <= off[0] && off[0] <= 1e-11 * fabs(x->work));
  ROT_CHECK(fabs(dissipated[end] - x->heat) <= off[1] && off[1] <= 1e-11 * x->heat);
  ROT_CHECK(fabs(impulse[end] - gained) <= off[2] + 1e-14 * size);
  ROT_CHECK(off[2] <= 1e-12 * (fabs(gained) + size));
  rot_events_free(&events);
}

/* ---- by hand --------------------------------------------------------------------------------- */

typedef struct scene {
  rot_clutch_params p;
  double theta[2][8], omega[2][8], torque[8], heat[8];
  int locked[8];
  rot_events events;
  rot_info info;
} scene;

static rot_status run(scene *x, size_t n, const double time[]) {
  const rot_clutch_columns out = {x->theta[0], x->omega[0], x->theta[1], x->omega[1],
                                  x->torque,   x->heat,     x->locked};
  rot_events_free(&x->events);
  return rot_clutch_run(&x->p, n, time, &out, NULL, NULL, &x->events, NULL, &x->info);
}

/* I = 2 and 3, 10 and 0 rad/s, 12 N m: 12 (1/2 + 1/3) = 10 rad/s^2, so 1 s to 4 rad/s, and
 * (1/2)(6/5) 100 = 60 J. */
static void check_engagement(void) {
  const double zero = 0.0, time[] = {0.0, 0.5, 1.0, 2.0};
  scene x = {{{2.0, 3.0},
              12.0,
              12.0,
              {{0, NULL, &zero}, {0, NULL, &zero}},
              0.0,
              0.0,
              {0.0, 1.0},
              {10.0, 0.0}},
             {{0}},
             {{0}},
             {0},
             {0},
             {0},
             {0},
             {0}};
  ROT_CHECK_EQ_INT(run(&x, 4, time), ROT_OK);
  ROT_CHECK_ULP(x.omega[0][1], 7.0, 2);
  ROT_CHECK_ULP(x.omega[1][1], 2.0, 4);
  ROT_CHECK_ULP(x.omega[0][3], 4.0, 2);
  ROT_CHECK_ULP(x.omega[1][3], 4.0, 2);
  ROT_CHECK_ULP(x.theta[0][3], 7.0 + 4.0, 4);
  ROT_CHECK_ULP(x.theta[1][3], 1.0 + 2.0 + 4.0, 4);
  ROT_CHECK_ULP(x.heat[1], 45.0, 4); /* 12 N m over 5 - 1.25 rad */
  ROT_CHECK_ULP(x.heat[3], 60.0, 4);
  ROT_CHECK(x.torque[1] == 12.0 && x.torque[3] == 0.0);
  ROT_CHECK(!x.locked[1] && x.locked[3]);
  ROT_CHECK_EQ_INT((long long)x.events.count, 1);
  ROT_CHECK_ULP(x.events.time_s[0], 1.0, 2);
  rot_clutch_engagement e = rot_clutch_engage(2.0, 3.0, 12.0, 0.0, 0.0, 10.0, 0.0);
  ROT_CHECK_ULP(e.lock_s, 1.0, 2);
  ROT_CHECK_ULP(e.omega_rad_per_s, 4.0, 2);
  ROT_CHECK_ULP(e.heat_j, 60.0, 3);
  e = rot_clutch_engage(2.0, 3.0, INFINITY, 5.0, -7.0, 0.0, 10.0);
  ROT_CHECK(e.lock_s == 0.0);
  ROT_CHECK_ULP(e.heat_j, 60.0, 3);
  ROT_CHECK_ULP(e.omega_rad_per_s, 6.0, 2);
  ROT_CHECK_ULP(e.locked_torque_n_m, (3.0 * 5.0 + 2.0 * 7.0) / 5.0, 1);
  /* Against scale: heat 60e300 would pass through 1e302 twice. */
  e = rot_clutch_engage(2e300, 3e300, INFINITY, 0.0, 0.0, 10.0, 0.0);
  ROT_CHECK_REL(e.heat_j, 60e300, 1e-15);
  ROT_CHECK_REL(e.omega_rad_per_s, 4.0, 1e-15);
  e = rot_clutch_engage(2.0, 3.0, 1.0, 10.0, -10.0, 10.0, 0.0); /* driven apart */
  ROT_CHECK(isinf(e.lock_s) && isnan(e.omega_rad_per_s) && isinf(e.heat_j));
  rot_events_free(&x.events);
}

/* I = 2 and 3, 10 and 0 rad/s, 6 N m on the first, 12 N m between them, 1 s: 8.5 and 2 rad, so
 * 51 J of work, 78 J of heat, 6 N m s. Their allowances are some roundings. */
static void check_allowances(void) {
  const double zero = 0.0, six = 6.0, time[] = {0.0, 1.0};
  const rot_clutch_params p = {.inertia_kg_m2 = {2.0, 3.0},
                               .capacity_n_m = 12.0,
                               .static_n_m = 12.0,
                               .torque_n_m = {{0, NULL, &six}, {0, NULL, &zero}},
                               .theta0_rad = {0.0, 0.0},
                               .omega0_rad_per_s = {10.0, 0.0}};
  double theta[2][2], omega[2][2], torque[2], heat[2], flows[3][2], off[ROT_CLUTCH_N_FLOWS];
  int locked[2];
  rot_events events = {0};
  rot_info info;
  const rot_clutch_columns out = {theta[0], omega[0], theta[1], omega[1], torque, heat, locked};
  double *const flow[ROT_CLUTCH_N_FLOWS] = {flows[0], flows[1], flows[2]};
  ROT_CHECK_EQ_INT(rot_clutch_run(&p, 2, time, &out, flow, off, &events, NULL, &info), ROT_OK);
  /* Work is the torque times an angle that is known to its figure. */
  ROT_CHECK(off[0] >= six * info.measure[ROT_THETA].error);
  static const double want[] = {51.0, 78.0, 6.0}, roundings[] = {64.0, 256.0, 16.0};
  for (int i = 0; i < 3; i++) {
    ROT_CHECK(fabs(flows[i][1] - want[i]) <= off[i]);
    ROT_CHECK(off[i] <= roundings[i] * ROT_EPS * want[i]);
    printf("%g: allowance %.3g roundings\n", want[i], off[i] / (ROT_EPS * want[i]));
  }
  rot_events_free(&events);
}

/* Equal speeds at the start: locked at once, without an event, up to the static capacity to the
 * last digit; beyond it slips, the way the torques pull. */
static void check_hold(void) {
  const double zero = 0.0, time[] = {0.0, 1.0};
  double pull = 4.0; /* I = 1 and 3: 3/4 of it must be carried */
  scene x = {{{1.0, 3.0},
              2.0,
              3.0,
              {{0, NULL, &pull}, {0, NULL, &zero}},
              0.0,
              0.0,
              {0.0, 0.0},
              {5.0, 5.0}},
             {{0}},
             {{0}},
             {0},
             {0},
             {0},
             {0},
             {0}};
  ROT_CHECK_EQ_INT(run(&x, 2, time), ROT_OK);
  ROT_CHECK(x.locked[0] && x.locked[1] && x.torque[1] == 3.0 && x.heat[1] == 0.0);
  ROT_CHECK(x.omega[0][1] == 6.0 && x.omega[1][1] == 6.0);
  ROT_CHECK_EQ_INT((long long)x.events.count, 0);
  pull = nextafter(4.0, 5.0);
  ROT_CHECK_EQ_INT(run(&x, 2, time), ROT_OK);
  ROT_CHECK(!x.locked[1] && x.torque[1] == 2.0);
  ROT_CHECK_ULP(x.omega[0][1], 7.0, 2);
  ROT_CHECK_ULP(x.heat[1], 2.0 * 0.5 * (2.0 - 2.0 / 3.0), 8);
  pull = -5.0; /* the other way */
  ROT_CHECK_EQ_INT(run(&x, 2, time), ROT_OK);
  ROT_CHECK(x.torque[1] == -2.0);
  ROT_CHECK_ULP(x.omega[0][1], 2.0, 2);
  rot_events_free(&x.events);
}

/* Through zero slip: the static capacity cannot hold, and the slip goes on the other way. Body 1 is
 * pulled back with 8 N m, the clutch carries 1: from 9 rad/s of slip with -9 rad/s^2 it is at zero
 * after 1 s, then the clutch turns round and it goes on with -7. */
static void check_reversal(void) {
  const double zero = 0.0, back = -8.0, time[] = {1.0, 2.0};
  scene x = {{{1.0, 1e300},
              1.0,
              2.0,
              {{0, NULL, &back}, {0, NULL, &zero}},
              0.0,
              0.0,
              {0.0, 0.0},
              {9.0, 0.0}},
             {{0}},
             {{0}},
             {0},
             {0},
             {0},
             {0},
             {0}};
  ROT_CHECK_EQ_INT(run(&x, 2, time), ROT_OK);
  ROT_CHECK(fabs(x.omega[0][0]) <= 4e-15);
  ROT_CHECK_ULP(x.omega[0][1], -7.0, 4);
  ROT_CHECK_ULP(x.heat[1], 4.5 + 3.5, 4);
  ROT_CHECK(x.torque[1] == -1.0);
  ROT_CHECK_EQ_INT((long long)x.events.count, 1);
  ROT_CHECK_EQ_INT(x.events.event[0], ROT_EVENT_REVERSE);
  ROT_CHECK_ULP(x.events.time_s[0], 1.0, 2);
  rot_events_free(&x.events);
}

/* Engaged while the speeds happen to be equal; before that each goes its own way. Rows before the
 * start are refused. */
static void check_late(void) {
  const double zero = 0.0, time[] = {1.0, 2.0, 3.0}, early[] = {-1.0};
  scene x = {{{2.0, 2.0},
              5.0,
              5.0,
              {{0, NULL, &zero}, {0, NULL, &zero}},
              2.0,
              0.0,
              {0.0, 0.0},
              {4.0, 4.0}},
             {{0}},
             {{0}},
             {0},
             {0},
             {0},
             {0},
             {0}};
  ROT_CHECK_EQ_INT(run(&x, 3, time), ROT_OK);
  ROT_CHECK(!x.locked[0] && x.locked[1] && x.locked[2]);
  ROT_CHECK_EQ_INT((long long)x.events.count, 1);
  ROT_CHECK_EQ_INT(x.events.event[0], ROT_EVENT_LOCK);
  ROT_CHECK(x.events.time_s[0] == 2.0);
  x.p.omega0_rad_per_s[0] = 9.0;
  ROT_CHECK_EQ_INT(run(&x, 3, time), ROT_OK);
  ROT_CHECK(x.omega[0][0] == 9.0 && x.torque[0] == 0.0 && x.heat[1] == 0.0);
  ROT_CHECK_ULP(x.omega[0][2], 6.5, 2); /* locks at 3 s: 5 (1/2 + 1/2) = 5 */
  ROT_CHECK_EQ_INT(run(&x, 1, early), ROT_EVALUE);
  ROT_CHECK_EQ_INT((long long)x.info.rows_done, 0);
  rot_events_free(&x.events);
}

/* The slip of open bodies, 2 - 2 s, changes sign at 1e6 + 1 s: a time that two roundings have made,
 * and which the slip knows to as much times its rate. */
static void check_late_zero(void) {
  const double pull[] = {-1.0, 1.0}, time[] = {1e6 + 3.0};
  scene x = {{{1.0, 1.0},
              5.0,
              5.0,
              {{0, NULL, &pull[0]}, {0, NULL, &pull[1]}},
              INFINITY,
              1e6,
              {0.0, 0.0},
              {2.0, 0.0}},
             {{0}},
             {{0}},
             {0},
             {0},
             {0},
             {0},
             {0}};
  ROT_CHECK_EQ_INT(run(&x, 1, time), ROT_OK);
  ROT_CHECK(fabs(x.omega[0][0] + 1.0) <= x.info.measure[ROT_OMEGA].error);
  /* Half of the slip is each body's. */
  const double known = 0.5 * 2.0 * 2.0 * ROT_EPS * 1e6;
  ROT_CHECK(x.info.measure[ROT_OMEGA].error >= known);
  ROT_CHECK(x.info.measure[ROT_OMEGA].error <= 1.1 * known);
  rot_events_free(&x.events);
}

int main(void) {
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) check_case(&cases[i]);
  printf("true error / bound: at most %.3g\n", worst);
  check_engagement();
  check_allowances();
  check_hold();
  check_reversal();
  check_late();
  check_late_zero();
  return rot_test_report("clutch");
}
