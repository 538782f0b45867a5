#include "scene/shaft/modal.h"
#include "scene/shaft/ledger.h"
#include "scene/shaft/rigid.h"

#include <stdlib.h>
#include <string.h>

#include "ground/real.h"
#include "rot_test.h"
#include "shared_table.h"

enum { MAX = 64 };

/* ---- against mpmath -------------------------------------------------------------------------- */

/* Random shafts: undamped, proportionally damped, damped between the rotors, damped outside too;
 * springs missing, times before the start. Exponential of the 2 n + 1 equations, mpmath, 120
 * digits; heat from the energies. */
typedef struct shaft_case {
  size_t n;
  double J[6], k[5], c[5], d[6], tau[6], theta0[6], omega0[6], t, theta[6], omega[6], heat, torque;
} shaft_case;

static const shaft_case cases[] = {
#ifdef MORE_CASES
#include MORE_CASES
#else
    {5,
     {36.5, 0.23, 0.00239, 0.00988, 746.0},
     {1540.0, 129.0, 160.0, 24900.0},
     {0.0, 0.0, 0.0, 0.0},
     {0.0, 0.0, 0.0, 0.0, 0.0},
     {0.0, 0.132, -93.8, 0.0, -4.05},
     {0.8911829772317446, 0.7969493374028169, -0.0049565613030994335, -0.008142794519508216,
      0.006283430459579629},
     {1.68, 0.289, -1.834, -1.248, -1.083},
     0.92,
     {0.80660970713617315313, 0.69300429817791989472, -0.57420514121200356426,
      -0.96615200023995234071, -0.96564282190963139751},
     {-2.1315005694475740438, 0.63802454400939223363, -11.245120018458173028, 21.252244932090298778,
      -1.0173979553664485527},
     -1.2226394649591541981e-130,
     174.95232979571001796},
    {2,
     {2.31, 0.39},
     {325000.0},
     {79.345703125},
     {0.144375, 0.024375},
     {0.0, 0.0},
     {-0.6018371938497864, -0.009387226590948107},
     {1.5, 1.5},
     0.893,
     {0.78654432612677330675, 0.78654432612677330675},
     {1.4185746616503295307, 1.4185746616503295307},
     57037.327424066853949,
     1.3218688458683740523e-42},
    {6,
     {0.337, 0.0212, 0.00605, 0.801, 5.71, 5.33},
     {34400.0, 1500.0, 17.4, 134.0, 87600.0},
     {1.27, 0.0, 0.0, 0.363, 81.3},
     {0.0, 0.0, 0.0, 0.0, 0.0, 0.0},
     {0.0, 0.0, 0.0, 0.0, 0.0, 0.0},
     {0.0004896950629369812, 0.24457784428244067, -0.7974772389522746, 0.002899126867794164,
      -0.3735382118925821, 0.195401346933888},
     {1.5, 1.5, 1.5, 1.5, 1.5, 1.5},
     0.00242,
     {0.025148491863119696707, -0.24605432330134525699, -0.2274494560523249723,
      0.006312212963854495924, -0.34530611634768082214, 0.17270127738796670821},
     {-7.4009332392348008337, 45.319044094869708016, 347.85134519491284575, 1.3313097962489098453,
      21.278853580217786427, -19.668275414907554871},
     297.28196748199421562,
     9262.4224704432816799},
    {5,
     {0.145, 21.5, 0.479, 0.525, 0.00143},
     {473.0, 2390.0, 1810.0, 0.0},
     {0.299, 8.07, 38.6, 0.0},
     {0.0, 0.0, 0.0263, 0.0, 1.25},
     {0.0, 0.0, 0.0, 0.0, 0.0},
     {-0.00490273112393695, 0.8379808097659767, 0.005289633908329672, 0.6519192571959531,
      0.5089913856560107},
     {1.5, 1.5, 1.5, 1.5, 1.5},
     0.417,
     {1.2421145466622975409, 1.4383381269333650999, 1.4098751893725130425, 1.401382474653063616,
      0.51070738565601065317},
     {-28.161459885754140179, 1.7153355903840756278, 1.5059568867670296105, 0.7979096024887787438,
      7.4335637247003092298e-159},
     1300.5161995301880207,
     -101.74691531558028161},
    {5,
     {2.99, 1.3, 1.56, 1.02, 0.487},
     {141000.0, 168000.0, 112.0, 17900.0},
     {0.0, 0.0, 0.0, 0.0},
     {0.0, 0.0, 0.0, 0.0, 0.0},
     {0.0, 0.0, 0.0, 0.0, 0.0},
     {0.006903957667683876, -0.8625968023297939, 0.44122815141431726, 0.4290923480197357,
      -0.006931682364218135},
     {-2.814, -0.438, -0.126, 1.39, 2.231},
     -0.0213,
     {0.034086897013551000674, -0.73483305245521831845, 0.41359933115078219966,
      0.280851918638113639, 0.17607647779857105077},
     {-30.816665134011709561, 214.29427264573784672, -125.88718510685324145, -29.771338676417157177,
      69.064734143475096406},
     3.5548814274198639903e-123,
     108417.712875096474},
    {5,
     {1.09, 2.38, 1.18, 3.12, 0.72},
     {20400.0, 2760.0, 7300.0, 416.0},
     {9.9609375, 1.34765625, 3.564453125, 0.203125},
     {0.0, 0.0, 0.0, 0.0, 0.0},
     {0.136, 0.0, 0.768, 0.411, -69.1},
     {-0.009056888034079233, 0.006962523748972402, -0.0016163416804692732, -0.0008611520462688139,
      0.00016326022336404789},
     {2.969, 1.972, -2.89, 0.66, -1.275},
     3.93,
     {-59.024121119089149656, -59.024534069686802754, -59.033858630631383282,
      -59.037496299503011153, -59.092202968590124263},
     {-30.527330016474320107, -30.52931389334362061, -30.578918648410401991, -30.616176930418298219,
      -32.214343316466386004},
     18.634236350567876885,
     8.4439534656260118858},
    {4,
     {0.535, 0.325, 2.7, 0.665},
     {10.1, 112.0, 3890.0},
     {65.2, 14.9, 0.0},
     {0.0, 0.0, 0.0, 0.0},
     {-16.4, 0.106, 0.0, 0.0},
     {-0.0024474362300078356, -0.35140826696975624, 0.0004980219567380062, 0.7649628764342706},
     {1.5, 1.5, 1.5, 1.5},
     0.118,
     {0.35534370471263687835, 0.061341202268449100358, 0.35810239087335560466,
      -0.22256714158317175987},
     {3.8708189255131040738, 3.2344378426249998994, -6.8737843199521294935, 29.85254923288438292},
     116.16227377869058719,
     44.461471878990690428},
    {2,
     {0.0111, 0.0737},
     {38900.0},
     {0.077},
     {0.0, 0.472},
     {0.0, 0.0},
     {-0.9317407692032678, -0.5173619698731748},
     {2.504, 0.802},
     10.3,
     {-0.33324798682232736288, -0.33324798682232736288},
     {-1.2867380443711952007e-17, 1.9359023389720711902e-18},
     3339.8139032073511099,
     -9.6006145767526643787e-17},
    {6,
     {0.692, 1.62, 2.66, 0.355, 1.45, 2.12},
     {233000.0, 9050.0, 36.6, 530.0, 11.4},
     {0.0, 0.0, 0.0, 0.0, 0.0},
     {0.0, 0.0, 0.0, 0.0, 0.0, 0.0},
     {0.0, 0.0, 0.0, 0.0, 0.0, 2.07},
     {-0.0074559749007778, -0.000849772278977221, 0.0034539728478903144, 0.001533792070303597,
      0.5168539934989325, 0.083210609863003},
     {-1.205, -1.686, -1.335, -0.291, 1.024, -0.057},
     0.00993,
     {-0.020376778317528195059, -0.015362065431878711184, -0.010906582774764341776,
      0.036274150367854587542, 0.51763061918931500397, 0.082808229770157611284},
     {0.81163711060377355998, -2.1947785233826091415, -1.5475549943649765909, 7.1954575339328892605,
      -0.84698119169642627044, -0.024033011430898091958},
     8.2795653765311813848e-126,
     -1168.428102356329743},
    {3,
     {0.971, 0.378, 1.05},
     {396000.0, 241000.0},
     {6187.5, 3765.625},
     {0.0, 0.0, 0.0},
     {0.0, 0.0, 3.4},
     {0.021414339330837917, 0.0072979154580211135, 0.9411940221284463},
     {0.842, 2.188, -1.701},
     0.00118,
     {0.044991902493510136824, 0.035364918141525950119, 0.90912961214242765187},
     {24.307460976562914638, 24.776237928419011292, -31.528909090652356714},
     12197.010329322709344,
     911.72841377613988919},
    {6,
     {1.08, 0.814, 0.817, 0.439, 2.37, 2.39},
     {34.2, 44900.0, 16500.0, 604.0, 221.0},
     {29.7, 2.44, 0.0, 0.0118, 5.76},
     {0.0, 0.0, 0.0, 0.0, 0.0, 0.0},
     {0.0, 0.0, 0.0, 0.0, 0.0, 0.0},
     {0.0, 0.0, 0.0, 0.0, 0.0, 0.0},
     {1.5, 1.5, 1.5, 1.5, 1.5, 1.5},
     0.006,
     {0.0090000000000000001874, 0.0090000000000000001874, 0.0090000000000000001874,
      0.0090000000000000001874, 0.0090000000000000001874, 0.0090000000000000001874},
     {1.5, 1.5, 1.5, 1.5, 1.5, 1.5},
     2.1659413714998112925e-124,
     -3.9973230352685002221e-124},
    {4,
     {0.339, 0.476, 0.875, 1.92},
     {1630.0, 3360.0, 78.0},
     {2.12, 122.0, 0.793},
     {9.76, 0.0432, 2.93, 0.0},
     {0.0, 0.0, 0.0, 0.0},
     {0.0, 0.0, 0.0, 0.0},
     {-1.396, 0.239, 2.554, 1.429},
     0.0153,
     {-0.010114944003442512423, 0.020209895221641135818, 0.026149660952765432515,
      0.021897603815259956319},
     {0.31853706011173359653, 1.2649315788362633731, 1.3475086458891505098, 1.4328222496622268218},
     1.185331906949729949,
     -51.43584431658234986},
    {4,
     {0.441, 0.511, 0.339, 0.571},
     {179000.0, 0.0, 98.2},
     {0.0, 0.0, 0.0},
     {0.0, 0.0, 0.0, 0.0},
     {-0.206, 47.2, 0.0, -44.9},
     {-0.0003647277298759133, -0.5488734378217421, 0.009959965795564452, 0.8021535384202139},
     {-1.647, 0.02, -0.807, -1.802},
     15.5,
     {5917.9259299875539678, 5917.7468125319631723, -5949.2214585270292161, -5948.4308265507783389},
     {522.34913636344975133, 973.25816803076065117, -765.24420851256192843, -766.78586394788354287},
     -3.0981779206691762044e-129,
     32062.024550752385406},
    {5,
     {1.54, 1.68, 2.15, 1.58, 1.17},
     {13.6875, 213000.0, 19.0, 0.0},
     {0.01336669921875, 208.0078125, 0.0185546875, 0.0},
     {0.09625, 0.105, 0.134375, 0.09875, 0.073125},
     {-0.574, 17.8, -68.7, 0.0, 1.5},
     {0.43173581630273583, 0.007206270946310771, -0.3620265232271469, 0.0075189772283568695,
      0.00041061172905364484},
     {-0.322, 0.153, -1.057, -1.336, -0.004},
     -0.00038,
     {0.43185788210585506947, 0.0036726130064093869479, -0.35891038395626102792,
      0.0080263389851687153247, 0.00041222431193915533205},
     {-0.32045970785324271071, 18.650449091497720333, -15.504114539735391148,
      -1.3343162602082003782, -0.0044872802736098317251},
     -31.371531958506503788,
     5.6072074389714007612},
    {6,
     {0.549, 0.343, 0.85, 2.98, 1.32, 0.926},
     {3670.0, 179.0, 31800.0, 8640.0, 32.6},
     {202.0, 0.0, 0.0, 0.703, 4.24},
     {0.0, 0.0, 0.0, 0.0, 0.0, 0.0},
     {0.0, 0.0, 0.0, 0.0, 0.0, 0.0},
     {0.0, 0.0, 0.0, 0.0, 0.0, 0.0},
     {0.818, -0.864, -0.465, -2.796, 2.846, 1.807},
     8.06,
     {-3.6437739206474018594, -3.6439629376478256912, -3.6346882164302273637,
      -3.6365055618766580409, -3.6359725575651803956, -3.6386537533555008353},
     {-0.73216443238851602314, -0.72453054615761039462, 1.0089204120052475556,
      -0.83669674097890614246, -0.3376536460594985462, -0.44562526843998422477},
     16.967766955606055459,
     -0.8483526270874743223},
    {2,
     {2.38, 2.92},
     {4150.0},
     {106.0},
     {0.16, 0.586},
     {0.0, 0.0},
     {0.17257822910956766, 0.00715493893805784},
     {1.5, 1.5},
     0.178,
     {0.34442945695803012098, 0.34419260641700492868},
     {1.4541395178503874541, 1.4603245472320756421},
     57.114677697433508863,
     0.3273166307956001014},

#endif
};

static rot_shaft_params params_of(const shaft_case *x) {
  return (rot_shaft_params){x->n, x->J, x->k, x->c, x->d, x->tau, x->theta0, x->omega0, 0.0};
}

static double worst_ratio = 0.0, smallest_ratio = 1.0, worst_relative = 0.0;

static double largest(size_t n, const double x[]) {
  double max = 0.0;
  for (size_t i = 0; i < n; i++) max = fmax(max, fabs(x[i]));
  return max;
}

/* One row, and the same row as the last of an even grid. Both are within the errors stated. */
static void check_case(const shaft_case *x) {
  enum { GRID = 200 };
  static double theta[GRID * 6], omega[GRID * 6], torque[GRID * 6];
  const rot_shaft_params p = params_of(x);
  const rot_shaft_columns out = {theta, omega, torque};
  double time[GRID];
  for (int pass = 0; pass < 2; pass++) {
    const size_t rows = pass == 0 || x->t < 0.0 ? 1 : GRID, last = (rows - 1) * x->n;
    for (size_t i = 0; i < rows; i++) time[i] = x->t * (double)(i + 1) / (double)rows;
    time[rows - 1] = x->t;
    rot_info info;
    ROT_CHECK_EQ_INT(rot_shaft_modal(&p, (rot_shaft_care)pass, rows, time, &out, NULL, &info),
                     ROT_OK);
    ROT_CHECK_EQ_INT((long long)info.rows_done, (long long)rows);
    const double slack = 1e-300;
    double theta_off = 0.0, omega_off = 0.0;
    for (size_t i = 0; i < x->n; i++) {
      theta_off = fmax(theta_off, fabs(theta[last + i] - x->theta[i]));
      omega_off = fmax(omega_off, fabs(omega[last + i] - x->omega[i]));
    }
    ROT_CHECK(theta_off <= info.measure[ROT_THETA].error + slack);
    ROT_CHECK(omega_off <= info.measure[ROT_OMEGA].error + slack);
    if (!(theta_off <= info.measure[ROT_THETA].error + slack &&
          omega_off <= info.measure[ROT_OMEGA].error + slack)) {
      printf("  case %d pass %d: %g of %g, %g of %g\n", (int)(x - cases), pass, theta_off,
             info.measure[ROT_THETA].error, omega_off, info.measure[ROT_OMEGA].error);
    }
    if (pass == 0) {
      const double ratio = fmax(theta_off / (info.measure[ROT_THETA].error + slack),
                                omega_off / (info.measure[ROT_OMEGA].error + slack));
      worst_ratio = fmax(worst_ratio, ratio);
      smallest_ratio = fmin(smallest_ratio, ratio);
      worst_relative = fmax(worst_relative, omega_off / largest(x->n, x->omega));
      if (getenv("ROTORS_VERBOSE")) {
        printf("case %d: ratio %.3g  error %.3g (theta %.3g)\n", (int)(x - cases), ratio,
               info.measure[ROT_OMEGA].error, info.measure[ROT_THETA].error);
      }
    }
    double size = fabs(x->k[0]) * info.measure[ROT_THETA].error;
    for (size_t i = 0; i < 2; i++) size += x->c[0] * info.measure[ROT_OMEGA].error;
    ROT_CHECK(fabs(torque[last] - x->torque) <= 2.0 * size + 1e-13 * fabs(x->torque) + slack);
    ROT_CHECK(isnan(torque[last + x->n - 1]));
  }
}

static void check_heat(const shaft_case *x) {
  const rot_shaft_params p = params_of(x);
  rot_shaft_ledger ledger;
  if (x->t < 0.0) return;
  ROT_CHECK_EQ_INT(rot_shaft_balance(&p, 0, 0.0, x->t, NULL, &ledger), ROT_OK);
  double work = 0.0;
  for (size_t i = 0; i < x->n; i++) work += x->tau[i] * (x->theta[i] - x->theta0[i]);
  ROT_CHECK(fabs(ledger.dissipated_j - x->heat) <= ledger.dissipated_rounding_j + 1e-30);
  ROT_CHECK(ledger.dissipated_rounding_j <= 1e-6 * fabs(x->heat) + 1e-30);
  ROT_CHECK(fabs(ledger.work_j - work) <= ledger.work_rounding_j + 1e-13 * fabs(work));
}

static void check_cases(void) {
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
    check_case(&cases[i]);
    check_heat(&cases[i]);
  }
  printf("true error / stated: at most %.3g; largest relative error of omega %.3g\n", worst_ratio,
         worst_relative);
}

/* ---- refs/coupled_rotors.csv ----------------------------------------------------------------- */

/* Numbers separated by semicolons; returns how many, and leaves *at behind the comma. */
static size_t read_list(char **at, double x[]) {
  size_t n = 0;
  for (;;) {
    char *end;
    x[n] = strtod(*at, &end);
    if (end == *at) break;
    n++;
    *at = end;
    if (*end != ';') break;
    *at = end + 1;
  }
  if (**at == ',') ++*at;
  return n;
}

/* From rest angles 0. The phases are known to twice the precision: k = 1e10 loses
 * no digit. */
static void check_shared_table(void) {
  FILE *file = shared_table("refs/coupled_rotors.csv");
  char line[4096];
  long rows = 0;
  if (!file) return;
  while (fgets(line, sizeof line, file)) {
    char *at = line;
    double head[4], J[6], k[6], c[6], omega0[6], dtheta[6], want[6], zero[6] = {0.0};
    for (int i = 0; i < 4; i++)
      if (read_list(&at, &head[i]) != 1) break;
    const size_t n = read_list(&at, J);
    if (n == 0) continue; /* the heading */
    read_list(&at, k);
    read_list(&at, c);
    read_list(&at, omega0);
    read_list(&at, dtheta);
    ROT_CHECK_EQ_INT((long long)read_list(&at, want), (long long)n);
    double theta[6], omega[6], torque[6], off = 0.0;
    const rot_shaft_params p = {n, J, k, c, zero, zero, zero, omega0, 0.0};
    const rot_shaft_columns out = {theta, omega, torque};
    rot_info info;
    ROT_CHECK_EQ_INT(rot_shaft_modal(&p, ROT_SHAFT_EACH, 1, &head[3], &out, NULL, &info), ROT_OK);
    for (size_t i = 0; i < n; i++) {
      ROT_CHECK(fabs(theta[i] - dtheta[i]) <= fmin(2e-15, info.measure[ROT_THETA].error));
      ROT_CHECK(fabs(omega[i] - want[i]) <= info.measure[ROT_OMEGA].error);
      off = fmax(off, fabs(omega[i] - want[i]));
    }
    ROT_CHECK(off <= 1e-14);
    printf("n = %d, k = %g, c = %g: omega off by %.2g, stated %.2g\n", (int)n, head[1], head[2],
           off, info.measure[ROT_OMEGA].error);
    rows++;
  }
  fclose(file);
  ROT_CHECK(rows >= 4);
}

/* ---- what must hold -------------------------------------------------------------------------- */

/* Frequencies known in closed form: equal rotors and springs have 2 sqrt(k/J) sin(m pi/(2 n)). */
static void check_frequencies(void) {
  double J[MAX], k[MAX], zero[MAX] = {0.0}, sigma[MAX];
  for (int i = 0; i < MAX; i++) J[i] = 0.5, k[i] = 200.0;
  const rot_shaft_params p = {MAX, J, k, zero, zero, zero, zero, zero, 0.0};
  ROT_CHECK_EQ_INT(rot_shaft_frequencies(&p, sigma, NULL), ROT_OK);
  ROT_CHECK(sigma[0] == 0.0);
  for (int m = 1; m < MAX; m++) {
    ROT_CHECK_REL(sigma[m], 40.0 * sin(m * 3.14159265358979323846 / (2.0 * MAX)), 4e-15);
  }
  /* Two rotors: sqrt(k (1/J1 + 1/J2)), wherever the numbers are. */
  const double scale[] = {1e-300, 1.0, 1e300};
  for (int i = 0; i < 3; i++) {
    double pair[2] = {2.0 * scale[i], 3.0 * scale[i]}, spring = 7.0 * scale[i];
    const rot_shaft_params two = {2, pair, &spring, zero, zero, zero, zero, zero, 0.0};
    ROT_CHECK_EQ_INT(rot_shaft_frequencies(&two, sigma, NULL), ROT_OK);
    ROT_CHECK_REL(sigma[1], sqrt(7.0 * 5.0 / 6.0), 1e-15);
  }
  /* A missing spring separates two such pairs: two modes without a frequency. */
  double four[4] = {2.0, 3.0, 1.0, 4.0}, springs[3] = {7.0, 0.0, 5.0};
  const rot_shaft_params split = {4, four, springs, zero, zero, zero, zero, zero, 0.0};
  ROT_CHECK_EQ_INT(rot_shaft_frequencies(&split, sigma, NULL), ROT_OK);
  ROT_CHECK(sigma[0] == 0.0 && sigma[1] == 0.0);
  ROT_CHECK_REL(sigma[2], sqrt(7.0 * 5.0 / 6.0), 1e-15);
  ROT_CHECK_REL(sigma[3], sqrt(5.0 * 5.0 / 4.0), 1e-15);
}

/* 64 rotors, damped outside at one end only: the balance of momentum and of energy. */
static void check_balances(void) {
  enum { N = 64, ROWS = 20 };
  static double theta[ROWS * N], omega[ROWS * N], torque[ROWS * N];
  double J[N], k[N], c[N], d[N] = {0.0}, tau[N], zero[N] = {0.0}, omega0[N], time[ROWS];
  for (int i = 0; i < N; i++) {
    J[i] = 1.0 + 0.5 * sin(i), k[i] = 1e4 * (2.0 + cos(3 * i)), c[i] = i % 3 ? 2.0 : 0.0;
    tau[i] = i == 0 ? 5.0 : i == N - 1 ? -3.0 : 0.0;
    omega0[i] = 2.0 + 0.1 * sin(5 * i);
  }
  d[N - 1] = 0.7;
  for (int i = 0; i < ROWS; i++) time[i] = 0.1 * i;
  const rot_shaft_params p = {N, J, k, c, d, tau, zero, omega0, 0.0};
  const rot_shaft_columns out = {theta, omega, torque};
  rot_info info;
  rot_shaft_ledger ledger;
  ROT_CHECK_EQ_INT(rot_shaft_modal(&p, ROT_SHAFT_EVEN, ROWS, time, &out, NULL, &info), ROT_OK);
  ROT_CHECK_EQ_INT(rot_shaft_balance(&p, 0, 0.0, time[ROWS - 1], NULL, &ledger), ROT_OK);
  double momentum = 0.0, energy = 0.0, size = 0.0;
  const double *last = omega + (ROWS - 1) * N, *turned = theta + (ROWS - 1) * N;
  for (int i = 0; i < N; i++) {
    momentum += J[i] * (last[i] - omega0[i]);
    size += J[i] * fabs(last[i]);
    energy += 0.5 * J[i] * (last[i] - omega0[i]) * (last[i] + omega0[i]);
    ROT_CHECK(fabs(omega[i] - omega0[i]) <= 1e-15); /* the row at the start */
  }
  for (int i = 0; i + 1 < N; i++) {
    const double twist = turned[i] - turned[i + 1];
    energy += 0.5 * k[i] * twist * twist;
  }
  const double impulse = (5.0 - 3.0) * time[ROWS - 1] - 0.7 * turned[N - 1];
  ROT_CHECK(fabs(momentum - impulse) <= 4e-16 * 800.0 * size); /* the stiffest phase: 800 */
  ROT_CHECK(ledger.dissipated_j > 0.1);
  ROT_CHECK(fabs(energy - ledger.work_j + ledger.dissipated_j) <= 1e-11);
  ROT_CHECK_REL(ledger.work_j, 5.0 * turned[0] - 3.0 * turned[N - 1], 1e-13);
}

/* Two rotors of 1 kg m^2, twisted by 0.1 rad against 100 N m/rad: after a quarter of the period
 * 2 pi/sqrt(200) the 0.5 J of the shaft are gone, known to some roundings of them. */
static void check_elastic(void) {
  double J[2] = {1.0, 1.0}, k = 100.0, zero[2] = {0.0}, theta0[2] = {0.05, -0.05};
  double theta[4], omega[4], torque[4], flows[ROT_SHAFT_FLOWS][2], off[ROT_SHAFT_FLOWS];
  double *flow[ROT_SHAFT_FLOWS];
  const double time[2] = {0.0, 0.5 * acos(-1.0) / sqrt(200.0)};
  const rot_shaft_params p = {2, J, &k, zero, zero, zero, theta0, zero, 0.0};
  const rot_shaft_columns out = {theta, omega, torque};
  rot_info info;
  int elastic = 0;
  for (int i = 0; i < ROT_SHAFT_FLOWS; i++) {
    flow[i] = flows[i];
    if (strstr(rot_shaft_flow_names[i], "elastic")) elastic = i;
  }
  ROT_CHECK_EQ_INT(rot_shaft_modal(&p, ROT_SHAFT_EACH, 2, time, &out, NULL, &info), ROT_OK);
  ROT_CHECK_EQ_INT(rot_shaft_flow(&p, 0, 2, time, &out, &info, flow, off, NULL), ROT_OK);
  ROT_CHECK(fabs(flows[elastic][1] + 0.5) <= off[elastic]);
  ROT_CHECK(off[elastic] <= 400.0 * ROT_EPS * 0.5);
  printf("elastic energy: allowance of %.3g roundings\n", off[elastic] / (0.5 * ROT_EPS));
}

/* Rows before the start and after it are the same motion: without damping it runs backwards. */
static void check_backwards(void) {
  double J[3] = {1.0, 0.2, 3.0}, k[2] = {50.0, 80.0}, zero[3] = {0.0}, tau[3] = {1.0, 0.0, -2.0};
  double theta0[3] = {0.1, 0.0, -0.2}, omega0[3] = {1.0, 2.0, 3.0}, t = 4.0, back = -4.0;
  double theta[3], omega[3], torque[3], again[3], rate[3];
  rot_info info;
  rot_shaft_params p = {3, J, k, zero, zero, tau, theta0, omega0, 0.0};
  rot_shaft_columns out = {theta, omega, torque};
  ROT_CHECK_EQ_INT(rot_shaft_modal(&p, ROT_SHAFT_EACH, 1, &t, &out, NULL, &info), ROT_OK);
  p.theta0_rad = theta;
  p.omega0_rad_per_s = omega;
  out = (rot_shaft_columns){again, rate, torque};
  ROT_CHECK_EQ_INT(rot_shaft_modal(&p, ROT_SHAFT_EACH, 1, &back, &out, NULL, &info), ROT_OK);
  for (int i = 0; i < 3; i++) {
    ROT_CHECK(fabs(again[i] - theta0[i]) <= 1e-13);
    ROT_CHECK(fabs(rate[i] - omega0[i]) <= 1e-12);
  }
  /* With a damper on one shaft the modes are coupled; a second back, it grows. */
  double damper[2] = {0.3, 0.0}, drag[3] = {0.0, 0.1, 0.0}, early[3], fast[3];
  p = (rot_shaft_params){3, J, k, damper, drag, tau, theta0, omega0, 0.0};
  out = (rot_shaft_columns){early, fast, torque};
  t = -1.0;
  back = 1.0;
  ROT_CHECK_EQ_INT(rot_shaft_modal(&p, ROT_SHAFT_EACH, 1, &t, &out, NULL, &info), ROT_OK);
  ROT_CHECK(fabs(early[0] - theta0[0]) > 0.1);
  p.theta0_rad = early;
  p.omega0_rad_per_s = fast;
  out = (rot_shaft_columns){again, rate, torque};
  ROT_CHECK_EQ_INT(rot_shaft_modal(&p, ROT_SHAFT_EACH, 1, &back, &out, NULL, &info), ROT_OK);
  for (int i = 0; i < 3; i++) {
    ROT_CHECK(fabs(again[i] - theta0[i]) <= 1e-12);
    ROT_CHECK(fabs(rate[i] - omega0[i]) <= 1e-11);
  }
}

/* Rows that are evenly spaced but for the rounding of their times and 1e-10 s more: by
 * steps of one exponential, and by one exponential each. */
static void check_uneven_rows(void) {
  enum { ROWS = 60 };
  double J[3] = {1.0, 0.2, 3.0}, k[2] = {50.0, 80.0}, c[2] = {0.3, 0.0}, d[3] = {0.0, 0.1, 0.0};
  double tau[3] = {1.0, 0.0, -2.0}, theta0[3] = {0.1, 0.0, -0.2}, omega0[3] = {1.0, 2.0, 3.0};
  double time[ROWS], theta[2][3 * ROWS], omega[2][3 * ROWS], torque[3 * ROWS];
  rot_info info[2];
  const rot_shaft_params p = {3, J, k, c, d, tau, theta0, omega0, 3.7};
  for (int i = 0; i < ROWS; i++) time[i] = 3.7 + 0.1 * i + 1e-10 * sin(7.0 * i);
  for (int fast = 0; fast < 2; fast++) {
    const rot_shaft_columns out = {theta[fast], omega[fast], torque};
    ROT_CHECK_EQ_INT(rot_shaft_modal(&p, (rot_shaft_care)fast, ROWS, time, &out, NULL, &info[fast]),
                     ROT_OK);
  }
  ROT_CHECK(info[1].steps < ROWS / 2 && info[0].steps == ROWS);
  /* An acceleration of 100 rad/s^2 for 1e-10 s would be 1e-8. */
  for (int i = 0; i < 3 * ROWS; i++) {
    ROT_CHECK(fabs(theta[1][i] - theta[0][i]) < 1e-13);
    ROT_CHECK(fabs(omega[1][i] - omega[0][i]) < 1e-12);
  }
  /* Each step adds its rounding, up to 60 of them; one row alone is in twice the precision. */
  for (int m = ROT_THETA; m <= ROT_OMEGA; m++) {
    ROT_CHECK(info[1].measure[m].error > info[0].measure[m].error);
    ROT_CHECK(info[1].measure[m].error < 32.0 * info[0].measure[m].error);
  }
  printf("steps: %d, stated %.2g and %.2g\n", (int)info[1].steps, info[1].measure[ROT_OMEGA].error,
         info[0].measure[ROT_OMEGA].error);
}

/* Stiff shafts with uneven losses, phases up to 5e8 rad, or dampers that hold all but one motion:
 * references by mpmath 1.3.0, exponentials of 80 digits. */
static void check_stiff(void) {
  static const struct {
    double J[3], k[2], c[2], d[3], tau[3], theta0[3], omega0[3], t, theta[3], omega[3];
  } stiff[] = {
      {{0.01, 5.0, 30.0},
       {1e12, 1e16},
       {0.0, 0.0},
       {0.1, 0.02, 0.5},
       {1.0, -2.0, 3.0},
       {0.0, 0.0, 0.0},
       {2.0, 2.0, 2.0},
       10.0,
       {21.0240710398693918, 21.0240710398686121, 21.024071039868612},
       {2.19894532848107181, 2.19894533191968661, 2.19894532807993796}},
      {{0.25, 1.0, 8.0},
       {1e10, 1e14},
       {3.0, 0.0},
       {0.5, 0.0, 0.125},
       {0.0, 1.0, 0.0},
       {0.0, 0.0, 0.0},
       {1.0, -1.0, 0.5},
       2.0,
       {0.864088267003177066, 0.864088272660286368, 0.86408826632998569},
       {0.50915787361403847, 0.579599588908537522, 0.500381971986889515}},
      {{0.02, 0.6, 0.005},
       {9e5, 70.0},
       {3e5, 5e6},
       {0.01, 3.0, 0.01},
       {0.7, 0.1, 0.0},
       {-0.9, -0.5, 0.2},
       {-0.125, -0.125, -0.125},
       0.25,
       {-0.683262889784949681, -0.494316652433592289, 0.205680897288321309},
       {0.712863500646288599, 0.146022406970586475, 0.146012606093097977}},
  };
  for (size_t i = 0; i < sizeof stiff / sizeof *stiff; i++) {
    const rot_shaft_params p = {3,          stiff[i].J,   stiff[i].k,      stiff[i].c,
                                stiff[i].d, stiff[i].tau, stiff[i].theta0, stiff[i].omega0,
                                0.0};
    double theta[3], omega[3], torque[3];
    const rot_shaft_columns out = {theta, omega, torque};
    rot_info info;
    ROT_CHECK_EQ_INT(rot_shaft_modal(&p, ROT_SHAFT_EVEN, 1, &stiff[i].t, &out, NULL, &info),
                     ROT_OK);
    const double *error = (double[]){info.measure[ROT_THETA].error, info.measure[ROT_OMEGA].error};
    for (int j = 0; j < 3; j++) {
      ROT_CHECK(fabs(theta[j] - stiff[i].theta[j]) <= error[0]);
      ROT_CHECK(fabs(omega[j] - stiff[i].omega[j]) <= error[1]);
    }
    ROT_CHECK(error[0] <= 2e-13 * largest(3, stiff[i].theta));
    ROT_CHECK(error[1] <= 2e-13 * largest(3, stiff[i].omega));
  }
}

/* Free of torque and damping nothing flows, however long the shaft turns: exactly 0. */
static void check_no_flow(void) {
  double J[3] = {1.0, 0.2, 3.0}, k[2] = {50.0, 80.0}, zero[3] = {0.0}, omega0[3] = {1.0, 2.0, 3.0};
  const rot_shaft_params p = {3, J, k, zero, zero, zero, zero, omega0, 0.0};
  for (double span = 1.0; span < 1e150; span *= 1e50) {
    rot_shaft_ledger ledger;
    ROT_CHECK_EQ_INT(rot_shaft_balance(&p, 0, 0.0, span, NULL, &ledger), ROT_OK);
    ROT_CHECK(ledger.work_j == 0.0 && ledger.dissipated_j == 0.0);
    ROT_CHECK(ledger.work_rounding_j == 0.0 && ledger.dissipated_rounding_j == 0.0);
  }
}

/* One rotor is an axle; a bad number ends as ROT_ERANGE and no row. */
static void check_ends(void) {
  double J = 2.0, d = 0.5, tau = 3.0, theta0 = 1.0, omega0 = -4.0, t = 6.0, theta, omega, torque;
  const rot_shaft_params p = {1, &J, NULL, NULL, &d, &tau, &theta0, &omega0, 2.0};
  const rot_shaft_columns out = {&theta, &omega, &torque};
  rot_info info;
  ROT_CHECK_EQ_INT(rot_shaft_modal(&p, ROT_SHAFT_EACH, 1, &t, &out, NULL, &info), ROT_OK);
  /* d/J = 1/4, 4 s on: 6 - 10 exp(-1); 1 + 24 - 40 (1 - exp(-1)) */
  ROT_CHECK_ULP(omega, 6.0 - 10.0 * exp(-1.0), 4);
  ROT_CHECK_ULP(theta, 25.0 + 40.0 * expm1(-1.0), 30);
  ROT_CHECK_EQ_INT(rot_shaft_rigid(&p, 1, &t, &out, NULL, &info), ROT_OK);
  ROT_CHECK_ULP(omega, 6.0 - 10.0 * exp(-1.0), 4);
  ROT_CHECK(info.measure[ROT_OMEGA].error < 1e-13);
  J = 1e-300;
  tau = 1e300;
  ROT_CHECK_EQ_INT(rot_shaft_modal(&p, ROT_SHAFT_EACH, 1, &t, &out, NULL, &info), ROT_ERANGE);
  ROT_CHECK_EQ_INT((long long)info.rows_done, 0);
}

/* ---- the rigid shaft ------------------------------------------------------------------------- */

/* Its bounds hold against the modes, for shafts whose rotors start together and apart, damped
 * evenly and not, and are no more than some 30 times the truth where they start together. */
static void check_rigid(void) {
  double J[3] = {1.0, 0.5, 2.0}, k[2], c[2] = {3.0, 0.0}, zero[3] = {0.0};
  double even[3] = {0.2, 0.1, 0.4}, odd[3] = {0.3, 0.0, 0.0}, tau[3] = {4.0, 0.0, -1.0};
  double together[3] = {2.0, 2.0, 2.0}, difference[3] = {2.0, 2.0, 2.001},
         *start[] = {together, difference};
  double *drag[] = {zero, even, odd};
  for (int i = 0; i < 12; i++) {
    k[0] = i % 2 ? 1e4 : 1e10;
    k[1] = 2.0 * k[0];
    enum { ROWS = 50 };
    double time[ROWS], a[ROWS * 3], b[ROWS * 3], x[ROWS * 3], y[ROWS * 3], s[ROWS * 3];
    for (int j = 0; j < ROWS; j++) time[j] = 0.37 * j;
    const rot_shaft_params p = {3, J, k, c, drag[i / 4], tau, zero, start[i / 2 % 2], 0.0};
    const rot_shaft_columns exact = {a, b, s}, rigid = {x, y, s};
    rot_info info, bound;
    ROT_CHECK_EQ_INT(rot_shaft_modal(&p, ROT_SHAFT_EACH, ROWS, time, &exact, NULL, &info), ROT_OK);
    ROT_CHECK_EQ_INT(rot_shaft_rigid(&p, ROWS, time, &rigid, NULL, &bound), ROT_OK);
    double theta_off = 0.0, omega_off = 0.0;
    for (int j = 0; j < ROWS * 3; j++) {
      theta_off = fmax(theta_off, fabs(a[j] - x[j]));
      omega_off = fmax(omega_off, fabs(b[j] - y[j]));
    }
    ROT_CHECK(theta_off <= bound.measure[ROT_THETA].error + info.measure[ROT_THETA].error);
    ROT_CHECK(omega_off <= bound.measure[ROT_OMEGA].error + info.measure[ROT_OMEGA].error);
    if (i / 2 % 2 == 0) ROT_CHECK(bound.measure[ROT_OMEGA].error <= 30.0 * omega_off);
    rot_shaft_ledger ledger;
    double work = 0.0, energy = 0.0;
    ROT_CHECK_EQ_INT(rot_shaft_balance(&p, 1, 0.0, time[ROWS - 1], NULL, &ledger), ROT_OK);
    const double w0 = y[0], w1 = y[ROWS * 3 - 1];
    energy = 0.5 * 3.5 * (w1 - w0) * (w1 + w0);
    work = 3.0 * x[ROWS * 3 - 1] - 3.0 * x[0];
    ROT_CHECK_REL(ledger.work_j, work, 1e-14);
    ROT_CHECK(fabs(energy - ledger.work_j + ledger.dissipated_j) <= 1e-13 * ledger.work_j);
  }
  k[0] = 0.0;
  double theta[3], omega[3], torque[3], t = 1.0;
  const rot_shaft_params p = {3, J, k, c, zero, tau, zero, together, 0.0};
  const rot_shaft_columns out = {theta, omega, torque};
  rot_info info;
  ROT_CHECK_EQ_INT(rot_shaft_rigid(&p, 1, &t, &out, NULL, &info), ROT_OK);
  ROT_CHECK(isinf(info.measure[ROT_OMEGA].error));
}

/* The allowances from above: of an angle twice the rounding of the initial one and of the result,
 * of a row behind k others k times the rounding of 2 n products. */
static void check_allowances(void) {
  enum { ROWS = 64 };
  double J[2] = {2.0, 0.5}, k = 1.0, c = 0.25, none[2] = {0.0}, far[2] = {1e3, 1e3};
  double slow[2] = {1e-3, 1e-3}, same[2] = {0.25, 0.0625};
  double theta[2 * ROWS], omega[2 * ROWS], torque[2 * ROWS], time[ROWS];
  const rot_shaft_columns out = {theta, omega, torque};
  for (int i = 0; i < ROWS; i++) time[i] = 0.125 * (i + 1);
  rot_info info;
  const rot_shaft_params turned = {2, J, &k, &c, same, none, far, slow, 0.0};
  ROT_CHECK_EQ_INT(rot_shaft_modal(&turned, ROT_SHAFT_EVEN, 1, time, &out, NULL, &info), ROT_OK);
  const double angle = info.measure[ROT_THETA].error / (ROT_EPS * 1e3);
  ROT_CHECK(angle >= 4.0 && angle <= 5.0);
  double own[2] = {0.25, 0.0}, start[2] = {1.0, -1.0};
  const rot_shaft_params coupled = {2, J, &k, &c, own, none, none, start, 0.0};
  ROT_CHECK_EQ_INT(rot_shaft_modal(&coupled, ROT_SHAFT_EACH, ROWS, time, &out, NULL, &info),
                   ROT_OK);
  const double alone = info.measure[ROT_OMEGA].error;
  ROT_CHECK_EQ_INT(rot_shaft_modal(&coupled, ROT_SHAFT_EVEN, ROWS, time, &out, NULL, &info),
                   ROT_OK);
  const double steps = (info.measure[ROT_OMEGA].error - alone) / (ROT_EPS * 4.0 * ROWS);
  ROT_CHECK(steps >= 0.9 && steps <= 1.5);
  /* Errors of uneven rows grow with the rate: those of one row are not those of a later one. */
  double stiff = 1e6, faint[2] = {1e-6, 0.0}, push[2] = {1.0, 0.0};
  const rot_shaft_params ringing = {2, J, &stiff, none, faint, push, none, start, 0.0};
  for (int i = 0; i < ROWS; i++) time[i] = ldexp(1.0 + 0.01 * i, i / 8 - 1);
  ROT_CHECK_EQ_INT(rot_shaft_modal(&ringing, ROT_SHAFT_EACH, 1, time, &out, NULL, &info), ROT_OK);
  const double first = info.measure[ROT_OMEGA].error;
  ROT_CHECK_EQ_INT(rot_shaft_modal(&ringing, ROT_SHAFT_EACH, 1, time + ROWS - 1, &out, NULL, &info),
                   ROT_OK);
  const double last = info.measure[ROT_OMEGA].error;
  ROT_CHECK_EQ_INT(rot_shaft_modal(&ringing, ROT_SHAFT_EACH, ROWS, time, &out, NULL, &info),
                   ROT_OK);
  ROT_CHECK(last > 4.0 * first && info.measure[ROT_OMEGA].error >= last / 1.07);
}

static rot_status stop(void *ctx, double fraction) {
  (void)ctx;
  (void)fraction;
  return ROT_EUNWIND;
}

static void check_stop(void) {
  enum { ROWS = 300 };
  static double theta[2 * ROWS], omega[2 * ROWS], torque[2 * ROWS], time[ROWS];
  double J[2] = {1.0, 1.0}, k = 1.0, c = 0.1, d[2] = {0.1, 0.0}, zero[2] = {0.0};
  const rot_shaft_params p = {2, J, &k, &c, d, zero, zero, J, 0.0};
  const rot_shaft_columns out = {theta, omega, torque};
  const rot_hooks hooks = {stop, NULL};
  rot_info info;
  for (int i = 0; i < ROWS; i++) time[i] = i;
  ROT_CHECK_EQ_INT(rot_shaft_modal(&p, ROT_SHAFT_EVEN, ROWS, time, &out, &hooks, &info),
                   ROT_EUNWIND);
  ROT_CHECK(info.rows_done > 0 && info.rows_done < ROWS);
}

int main(void) {
  check_shared_table();
  check_frequencies();
  check_balances();
  check_elastic();
  check_backwards();
  check_uneven_rows();
  check_stiff();
  check_no_flow();
  check_ends();
  check_rigid();
  check_allowances();
  check_stop();
  check_cases();
  return rot_test_report("shaft");
}
