/* The phi functions against values of another series at 100 digits, against the series itself in
 * double words at random arguments, and against the shared table where it is at hand. */
#include <stdlib.h>

#include "rot_phi.h"
#include "rot_real.h"
#include "rot_test.h"

/* ---- references ----------------------------------------------------------------------------- */

/* z, phi_0(-z) .. phi_6(-z), g1(z). Both sides of every border between two methods are here. */
static const double reference[][9] = {
    {0.0, 1.0, 1.0, 0.5, 0.16666666666666666667, 0.041666666666666666667, 0.0083333333333333333333,
     0.0013888888888888888889, 0.5},
    {1e-300, 1.0, 1.0, 0.5, 0.16666666666666666667, 0.041666666666666666667,
     0.0083333333333333333333, 0.0013888888888888888889, 0.5},
    {1e-16, 0.9999999999999999, 0.99999999999999995, 0.49999999999999998333, 0.1666666666666666625,
     0.041666666666666665833, 0.0083333333333333331944, 0.001388888888888888869,
     0.49999999999999996667},
    {1e-08, 0.99999999000000005, 0.99999999500000001667, 0.4999999983333333375,
     0.16666666625000000083, 0.041666666583333333472, 0.0083333333194444444643,
     0.0013888888869047619072, 0.49999999666666667917},
    {0.001, 0.99900049983337499165, 0.99950016662500833193, 0.49983337499166805535,
     0.16662500833194464283, 0.041658334722023834322, 0.0083319446428323440253,
     0.0013886905009893080357, 0.49966679163334027658},
    {0.1, 0.90483741803595956814, 0.95162581964040426576, 0.48374180359595731554,
     0.16258196404042683553, 0.040847026262398309113, 0.0081964040426835750866,
     0.0013692929064975823917, 0.46788401604444695022},
    {0.3, 0.74081822068171787429, 0.86393926439427378433, 0.45353578535242073567,
     0.15488071549193088682, 0.039286503915785934266, 0.0079338758362691082966,
     0.0013315249902140835052, 0.41040347904185304866},
    {0.49999999999999994, 0.60653065971263345727, 0.78693868057473317282, 0.42612263885053370167,
     0.14775472229893261307, 0.037823888735468111387, 0.0076855558623971114121,
     0.0012955549418724439862, 0.36081604172419947116},
    {0.5, 0.6065306597126334236, 0.78693868057473315279, 0.42612263885053369442,
     0.14775472229893261117, 0.037823888735468110994, 0.0076855558623971113451,
     0.0012955549418724439765, 0.36081604172419945838},
    {0.5000000000000001, 0.60653065971263335627, 0.78693868057473311273, 0.42612263885053367991,
     0.14775472229893260736, 0.037823888735468110208, 0.007685555862397111211,
     0.001295554941872443957, 0.36081604172419943282},
    {0.75, 0.47236655274101470714, 0.70351126301198039048, 0.39531831598402614602,
     0.13957557868796513864, 0.036121450638268704041, 0.0073936213711972835006,
     0.0012529492828480664437, 0.30819294702795424446},
    {0.9999999999999999, 0.36787944117144236244, 0.63212055882855770774, 0.3678794411714423331,
     0.13212055882855768157, 0.034546107838108988935, 0.0071205588285576785218,
     0.0012127745047756549462, 0.26424111765711537464},
    {1.0, 0.3678794411714423216, 0.6321205588285576784, 0.3678794411714423216,
     0.1321205588285576784, 0.034546107838108988262, 0.0071205588285576784045,
     0.0012127745047756549289, 0.26424111765711535681},
    {1.0000000000000002, 0.36787944117144223991, 0.63212055882855761973, 0.36787944117144229858,
     0.13212055882855767208, 0.034546107838108986916, 0.0071205588285576781698,
     0.0012127745047756548942, 0.26424111765711532115},
    {2.0, 0.13533528323661269189, 0.43233235838169365405, 0.28383382080915317297,
     0.10808308959542341351, 0.029291788535621626577, 0.006187439065522520045,
     0.0010729471339054066442, 0.14849853757254048108},
    {2.9999999999999996, 0.049787068367863965089, 0.31673764387737872519, 0.22775411870754045865,
     0.090748627097486527216, 0.025306013189726716896, 0.0054535511589799840641,
     0.00095992739145111656516, 0.088983525169838266539},
    {3.0, 0.049787068367863942979, 0.31673764387737868567, 0.22775411870754043811,
     0.09074862709748652063, 0.025306013189726715345, 0.0054535511589799837737,
     0.00095992739145111651986, 0.088983525169838247565},
    {3.0000000000000004, 0.049787068367863920869, 0.31673764387737864616, 0.22775411870754041757,
     0.090748627097486514044, 0.025306013189726713795, 0.0054535511589799834834,
     0.00095992739145111647456, 0.08898352516983822859},
    {5.0, 0.0067379469990854670966, 0.19865241060018290658, 0.16026951787996341868,
     0.067946096424007316263, 0.019744114048531870081, 0.0043845105236269593172,
     0.00078976456194127480323, 0.038382892720219487897},
    {7.999999999999999, 0.00033546262790251213677, 0.12495806717151219986, 0.10938024160356098716,
     0.048827469799554882026, 0.014729899608388974715, 0.0033670958822847118677,
     0.00062077968138107775212, 0.015577825567951212694},
    {8.0, 0.00033546262790251183882, 0.12495806717151218602, 0.10938024160356097675,
     0.048827469799554877907, 0.014729899608388973595, 0.003367095882284711634,
     0.00062077968138107771242, 0.015577825567951209273},
    {20.0, 2.061153622438557828e-9, 0.049999999896942318878, 0.047500000005152884056,
     0.022624999999742355797, 0.0072020833333462155435, 0.0017232291666660225562,
     0.00033050520833336553886, 0.002499999891789434822},
    {36.0, 2.3195228302435693883e-16, 0.027777777777777771335, 0.027006172839506173018,
     0.013138717421124828527, 0.004264665256820606615, 0.0010389444836068350014,
     0.00020262191249240273144, 0.00077160493827159831618},
    {100.0, 3.720075976020835963e-44, 0.01, 0.0099, 0.004901, 0.0016176566666666666667,
     0.0004004901, 7.9328432333333333333e-5, 0.0001},
    {700.0, 9.8596765437597708567e-305, 0.0014285714285714285714, 0.0014265306122448979592,
     0.0007122478134110787172, 0.00023707774121893655421, 5.9185127036353900161e-5,
     1.182021172328139919e-5, 2.0408163265306122449e-6},
    {745.0, 2.8223507304719370764e-324, 0.0013422818791946308725, 0.0013404801585514166029,
     0.00066934163737107192402, 0.00022281520138160482516, 5.5629330825885989049e-5,
     1.1111012083902613885e-5, 1.8017206432142696275e-6},
    {10000.0, 0.0, 0.0001, 9.999e-5, 4.9990001e-5, 1.6661667666566666667e-5, 4.16500049990001e-6,
     8.3291683328334333233e-7, 1.0e-8},
    {100000000.0, 0.0, 1.0e-8, 9.9999999e-9, 4.999999900000001e-9, 1.6666666166666676667e-9,
     4.166666500000005e-10, 8.3333329166666833333e-11, 1.0e-16},
    {1e150, 0.0, 1.0000000000000000192e-150, 1.0000000000000000192e-150, 5.0000000000000000958e-151,
     1.6666666666666666986e-151, 4.1666666666666667465e-152, 8.333333333333333493e-153,
     1.0000000000000000383e-300},
    {1e300, 0.0, 9.999999999999999475e-301, 9.999999999999999475e-301, 4.9999999999999997375e-301,
     1.6666666666666665792e-301, 4.1666666666666664479e-302, 8.3333333333333328958e-303, 0.0},
    {-1e-300, 1.0, 1.0, 0.5, 0.16666666666666666667, 0.041666666666666666667,
     0.0083333333333333333333, 0.0013888888888888888889, 0.5},
    {-1e-16, 1.0000000000000001, 1.00000000000000005, 0.50000000000000001667,
     0.16666666666666667083, 0.0416666666666666675, 0.0083333333333333334722,
     0.0013888888888888889087, 0.50000000000000003333},
    {-1e-08, 1.00000001000000005, 1.0000000050000000167, 0.50000000166666667083,
     0.16666666708333333417, 0.041666666750000000139, 0.0083333333472222222421,
     0.0013888888908730158755, 0.50000000333333334583},
    {-0.001, 1.0010005001667083417, 1.0005001667083416681, 0.50016670834166805576,
     0.16670834166805575399, 0.041675001389087326392, 0.0083347224206597249783,
     0.0013890873263916448964, 0.50033345836667361231},
    {-0.1, 1.1051709180756476309, 1.0517091807564762511, 0.51709180756476248214,
     0.17091807564762481195, 0.042514089809581450459, 0.0084742314291478374573,
     0.001408980958145041161, 0.53461737319171376894},
    {-0.3, 1.349858807576003089, 1.1661960252533436731, 0.553986750844478931,
     0.17995583614826310999, 0.044297231605321479372, 0.0087685497955160426763,
     0.001450721540609031197, 0.61220927440886474215},
    {-0.49999999999999994, 1.6487212707001280553, 1.2974425414002562547, 0.59488508280051257544,
     0.18977016560102517195, 0.046206997868717015696, 0.0090806624041006990676,
     0.0014946581415347316345, 0.70255745859974367926},
    {-0.5, 1.6487212707001281468, 1.2974425414002562937, 0.59488508280051258739,
     0.18977016560102517479, 0.046206997868717016245, 0.0090806624041006991568,
     0.001494658141534731647, 0.7025574585997437063},
    {-0.5000000000000001, 1.6487212707001283299, 1.2974425414002563717, 0.5948850828005126113,
     0.18977016560102518047, 0.046206997868717017342, 0.0090806624041006993353,
     0.001494658141534731672, 0.70255745859974376039},
    {-0.9999999999999999, 2.7182818284590449336, 1.7182818284590451243, 0.71828182845904520408,
     0.21828182845904522832, 0.051615161792378567381, 0.009948495125711901819,
     0.001615161792378568665, 0.99999999999999992025},
    {-1.0, 2.7182818284590452354, 1.7182818284590452354, 0.71828182845904523536,
     0.21828182845904523536, 0.051615161792378568694, 0.009948495125711902027,
     0.0016151617923785686936, 1.0},
    {-1.0000000000000002, 2.7182818284590458389, 1.7182818284590454574, 0.71828182845904529791,
     0.21828182845904524945, 0.051615161792378571318, 0.0099484951257119024428,
     0.0016151617923785687508, 1.0000000000000001595},
    {-2.0, 7.3890560989306502272, 3.1945280494653251136, 1.0972640247326625568,
     0.2986320123663312784, 0.065982672849832305869, 0.012158003091582819601,
     0.0019123348791247431338, 2.0972640247326625568},
    {-3.0, 20.085536923187667741, 6.3618456410625559136, 1.7872818803541853045,
     0.42909396011806176818, 0.087475764483798367172, 0.015269699272377233502,
     0.0023121219796813000561, 4.5745637607083706091},
    {-3.9999999999999996, 54.598150033144214832, 13.399537508286055196, 3.099884377071514143,
     0.64997109426787860792, 0.12082610690030299873, 0.019789860058409085213,
     0.0028641316812689382878, 10.299653131214541053},
    {-4.0, 54.598150033144239078, 13.39953750828605977, 3.0998843770715149424,
     0.6499710942678787356, 0.12082610690030301723, 0.019789860058409087641,
     0.002864131681268938577, 10.299653131214544827},
    {-4.000000000000001, 54.598150033144287571, 13.399537508286068917, 3.0998843770715165411,
     0.64997109426787899094, 0.12082610690030305424, 0.019789860058409092499,
     0.0028641316812689391555, 10.299653131214552376},
    {-10.0, 22026.465794806716517, 2202.5465794806716517, 220.15465794806716517,
     21.965465794806716517, 2.179879912814004985, 0.21382132461473383184, 0.02054879912814004985,
     1982.3919215326044865},
    {-36.0, 4.3112315471151952271e15, 1.1975643186431095075e14, 3.3265675517863875209e12,
     9.2404654216274653359e10, 2.5667959504474440748e9, 7.129988751127159467e7,
     1.980552430637173926e6, 1.1642986431252456323e14},
    {-100.0, 2.6881171418161354484e43, 2.6881171418161354484e41, 2.6881171418161354484e39,
     2.6881171418161354484e37, 2.6881171418161354484e35, 2.6881171418161354484e33,
     2.6881171418161354484e31, 2.6612359703979740939e41},
    {-300.0, 1.9424263952412559366e130, 6.4747546508041864553e127, 2.1582515502680621518e125,
     7.1941718342268738392e122, 2.3980572780756246131e120, 7.9935242602520820436e117,
     2.6645080867506940145e115, 6.4531721353015058338e127},
    {-700.0, 1.0142320547350045095e304, 1.4489029353357207278e301, 2.069861336193886754e298,
     2.9569447659912667914e295, 4.2242068085589525592e292, 6.0345811550842179417e289,
     8.6208302215488827738e286, 1.446833073999526841e301},
};

enum { REFERENCES = sizeof reference / sizeof reference[0] };

/* Allowed ulps: an ulp at most above what a million random arguments between -10 and 10 showed. */
static double allowed(double z, int k) {
  static const double most[2][ROT_PHI_MAX + 1] = {{1, 2, 3, 3, 3, 4, 4}, {1, 2, 3, 3, 3, 4, 4}};
  return most[z < 0.0][k];
}
static const double allowed_g1 = 5.0;

/* Double words: hi + lo, some 31 digits. */
typedef struct word {
  double hi, lo;
} word;

static word word_sum(word a, word b) {
  word s;
  s.hi = rot_two_sum(a.hi, b.hi, &s.lo);
  s.lo += a.lo + b.lo;
  s.hi = rot_two_sum(s.hi, s.lo, &s.lo);
  return s;
}

static word word_difference(word a, word b) {
  const word minus_b = {-b.hi, -b.lo};
  return word_sum(a, minus_b);
}

static word word_times(word a, double b) {
  word p;
  p.hi = rot_two_prod(a.hi, b, &p.lo);
  p.lo += a.lo * b;
  p.hi = rot_two_sum(p.hi, p.lo, &p.lo);
  return p;
}

static word word_over(word a, double b) {
  word q = {a.hi / b, 0.0};
  q.lo = (fma(-q.hi, b, a.hi) + a.lo) / b;
  q.hi = rot_two_sum(q.hi, q.lo, &q.lo);
  return q;
}

/* The series of the definition, sum (-z)^j/(j+k)!. What cancels at |z| <= 10 leaves 20 digits. */
static word phi_word(double z, int k) {
  word term = {1.0, 0.0}, sum = {0.0, 0.0};
  for (int i = 2; i <= k; i++) term = word_over(term, i);
  for (int j = 1; j <= 70; j++) {
    sum = word_sum(sum, term);
    term = word_over(word_times(term, -z), j + k);
  }
  return sum;
}

/* The same numbers on every machine, in [0, 1). */
static uint64_t seed = 20;
static double uniform(void) {
  seed = seed * 6364136223846793005u + 1442695040888963407u;
  return (double)(seed >> 11) * 0x1p-53;
}

/* ---- one argument --------------------------------------------------------------------------- */

static void check_references(void) {
  for (int i = 0; i < REFERENCES; i++) {
    const double *row = reference[i], z = row[0];
    double phi[ROT_PHI_MAX + 1];
    rot_phi(z, 0.0, ROT_PHI_MAX, phi);
    for (int k = 0; k <= ROT_PHI_MAX; k++) ROT_CHECK_ULP(phi[k], row[1 + k], allowed(z, k));
    ROT_CHECK_ULP(rot_phi_g1(z, phi[0], phi[1]), row[8], allowed_g1);
  }
}

/* At zero every phi_k is 1/k!, to the last bit, whatever the sign of the zero. */
static void check_zero(void) {
  const double factorial[] = {1, 1, 2, 6, 24, 120, 720}, zero[] = {0.0, -0.0};
  for (int i = 0; i < 2; i++) {
    double phi[ROT_PHI_MAX + 1];
    rot_phi(zero[i], 0.0, ROT_PHI_MAX, phi);
    for (int k = 0; k <= ROT_PHI_MAX; k++) ROT_CHECK_ULP(phi[k], 1.0 / factorial[k], 0);
    ROT_CHECK_ULP(rot_phi_g1(zero[i], 1.0, 1.0), 0.5, 0);
  }
}

/* Every k_max in turn: some methods begin at the highest function and come down. */
static void check_random_arguments(void) {
  enum { G1 = ROT_PHI_MAX + 1 };
  double worst[2][G1 + 1] = {{0.0}};
  for (int i = 0; i < 6000; i++) {
    const double u = uniform(), z = i % 4 == 0   ? -10.0 * u
                                    : i % 4 == 1 ? 3.5 * u
                                    : i % 4 == 2 ? 2.0 * u - 1.0
                                                 : pow(10.0, 1.0 - 13.0 * u);
    const int k_max = 1 + i / 4 % ROT_PHI_MAX;
    double phi[ROT_PHI_MAX + 1], *most = worst[z < 0.0];
    rot_phi(z, 0.0, k_max, phi);
    for (int k = 0; k <= k_max; k++)
      most[k] = fmax(most[k], rot_test_ulp(phi[k], phi_word(z, k).hi));
    const word g1 = word_difference(phi_word(z, 1), phi_word(z, 2));
    most[G1] = fmax(most[G1], rot_test_ulp(rot_phi_g1(z, phi[0], phi[1]), g1.hi));
  }
  for (int k = 0; k <= ROT_PHI_MAX; k++) {
    printf("phi_%d: worst %g ulp for z >= 0, %g for z < 0\n", k, worst[0][k], worst[1][k]);
    ROT_CHECK(worst[0][k] <= allowed(1.0, k));
    ROT_CHECK(worst[1][k] <= allowed(-1.0, k));
  }
  printf("g1: worst %g ulp for z >= 0, %g for z < 0\n", worst[0][G1], worst[1][G1]);
  ROT_CHECK(worst[0][G1] <= allowed_g1);
  ROT_CHECK(worst[1][G1] <= allowed_g1);
}

/* Borders of the methods must not show: no step between neighbours in z beyond the roundings. */
static void check_borders(void) {
  const double border[] = {-4.0, -1.0, -0.5, 0.5, 1.0, 3.0};
  for (int i = 0; i < 6; i++) {
    double below[ROT_PHI_MAX + 1], above[ROT_PHI_MAX + 1];
    const double z = border[i], z_below = nextafter(z, -100.0);
    rot_phi(z_below, 0.0, ROT_PHI_MAX, below);
    rot_phi(z, 0.0, ROT_PHI_MAX, above);
    for (int k = 0; k <= ROT_PHI_MAX; k++) {
      ROT_CHECK_ULP(below[k], above[k], 2.0 * allowed(z, k) + 2.0 * fabs(z));
    }
    ROT_CHECK_ULP(rot_phi_g1(z_below, below[0], below[1]), rot_phi_g1(z, above[0], above[1]), 8);
  }
}

/* z phi_(k+1) = 1/k! - phi_k, which no method uses in this direction everywhere. */
static void check_recurrence(void) {
  const double inverse_factorial[] = {1.0, 1.0, 1.0 / 2, 1.0 / 6, 1.0 / 24, 1.0 / 120};
  for (int i = 0; i < 500; i++) {
    const double z = i < 250 ? 20.0 * uniform() : -20.0 * uniform();
    double phi[ROT_PHI_MAX + 1];
    rot_phi(z, 0.0, ROT_PHI_MAX, phi);
    for (int k = 0; k < ROT_PHI_MAX; k++) {
      const double off = fabs(z * phi[k + 1] + phi[k] - inverse_factorial[k]);
      ROT_CHECK(off <= 16.0 * ROT_EPS * fmax(phi[k], inverse_factorial[k]));
    }
  }
}

/* What is asked for does not change what comes back, and nothing is written beyond it. */
static void check_k_max(void) {
  const double z[] = {-5.0, -0.2, 0.0, 0.2, 1.0, 7.0, 1e9};
  for (int i = 0; i < 7; i++) {
    double all[ROT_PHI_MAX + 1];
    rot_phi(z[i], 0.0, ROT_PHI_MAX, all);
    for (int k_max = 0; k_max < ROT_PHI_MAX; k_max++) {
      double some[ROT_PHI_MAX + 1];
      for (int k = 0; k <= ROT_PHI_MAX; k++) some[k] = -7.0;
      rot_phi(z[i], 0.0, k_max, some);
      for (int k = 0; k <= k_max; k++) ROT_CHECK_ULP(some[k], all[k], k < 2 ? 0 : 4);
      for (int k = k_max + 1; k <= ROT_PHI_MAX; k++) ROT_CHECK(some[k] == -7.0);
    }
  }
}

/* The residual of z turns phi_0 alone: exp(-(z + z_lo)) = exp(-z)(1 - z_lo). */
static void check_residual(void) {
  double with[3], without[3];
  rot_phi(2.0, 0x1p-20, 2, with);
  rot_phi(2.0, 0.0, 2, without);
  ROT_CHECK_ULP(with[0], without[0] * (1.0 - 0x1p-20), 1);
  ROT_CHECK_ULP(with[1], without[1], 0);
  ROT_CHECK_ULP(with[2], without[2], 0);
  /* What it is for: 700.3 is no double, and the nearest is off by 200 ulp of the exponential. */
  rot_phi(700.3, 4.5474735088646411896e-14, 0, with);
  rot_phi(700.3, 0.0, 0, without);
  ROT_CHECK_ULP(with[0], 7.3042280336453832072e-305, 2);
  ROT_CHECK(rot_test_ulp(without[0], with[0]) > 150.0);
}

static void check_ends(void) {
  double phi[ROT_PHI_MAX + 1];
  rot_phi(INFINITY, 0.0, ROT_PHI_MAX, phi);
  for (int k = 0; k <= ROT_PHI_MAX; k++) ROT_CHECK_ULP(phi[k], 0.0, 0);
  ROT_CHECK_ULP(rot_phi_g1(INFINITY, phi[0], phi[1]), 0.0, 0);
  rot_phi(-INFINITY, 0.0, ROT_PHI_MAX, phi);
  for (int k = 0; k <= ROT_PHI_MAX; k++) ROT_CHECK(phi[k] > 0.0 && isinf(phi[k]));
  rot_phi(NAN, 0.0, ROT_PHI_MAX, phi);
  for (int k = 0; k <= ROT_PHI_MAX; k++) ROT_CHECK(isnan(phi[k]));
  ROT_CHECK(isnan(rot_phi_g1(NAN, phi[0], phi[1])));
  rot_phi(-800.0, 0.0, ROT_PHI_MAX, phi); /* overflow is an infinity, not a NaN */
  for (int k = 0; k <= ROT_PHI_MAX; k++) ROT_CHECK(phi[k] > 0.0 && isinf(phi[k]));
}

/* ---- lanes ---------------------------------------------------------------------------------- */

static double lane(const rot_phi_lanes *lanes, int which, int l) {
  const double *column[] = {lanes->phi0, lanes->phi1, lanes->g1, lanes->phi2, lanes->phi3};
  return column[which][l];
}

/* Each column of eight lanes against the double words; keeps the worst. */
static void compare_lanes(const double z[ROT_LANES], double worst[5]) {
  const double no_residual[ROT_LANES] = {0.0};
  rot_phi_lanes lanes;
  rot_phi_in_lanes(z, no_residual, &lanes);
  for (int l = 0; l < ROT_LANES; l++) {
    const word phi1 = phi_word(z[l], 1), phi2 = phi_word(z[l], 2);
    const double want[5] = {phi_word(z[l], 0).hi, phi1.hi, word_difference(phi1, phi2).hi, phi2.hi,
                            phi_word(z[l], 3).hi};
    double phi[4];
    rot_phi(z[l], 0.0, 3, phi);
    const double scalar[5] = {phi[0], phi[1], rot_phi_g1(z[l], phi[0], phi[1]), phi[2], phi[3]};
    for (int c = 0; c < 5; c++) {
      worst[c] = fmax(worst[c], rot_test_ulp(lane(&lanes, c, l), want[c]));
      ROT_CHECK_ULP(lane(&lanes, c, l), scalar[c], 6);
    }
  }
}

static void check_lanes(void) {
  const char *const name[5] = {"phi0", "phi1", "g1", "phi2", "phi3"};
  /* The degree of the polynomials changes at 0.03, 0.25 and 1: stay below each, then mix. */
  const double top[] = {0.03, 0.25, 1.0, 3.0};
  double worst[5] = {0.0};
  for (int i = 0; i < 400; i++) {
    double z[ROT_LANES];
    for (int l = 0; l < ROT_LANES; l++) z[l] = top[i % 4] * uniform();
    if (i % 8 == 3) z[i % ROT_LANES] = 1e-3 * uniform(), z[(i + 3) % ROT_LANES] = 0.0;
    if (i < 4) z[ROT_LANES - 1] = nextafter(top[i], 0.0);
    if (i < 3) z[0] = top[i];
    compare_lanes(z, worst);
  }
  for (int c = 0; c < 5; c++) {
    printf("%s in lanes: worst %g ulp\n", name[c], worst[c]);
    ROT_CHECK(worst[c] <= 4.0);
  }
}

/* A lane knows nothing of its neighbours beyond the last bit, wherever the largest argument is. */
static void check_lane_order(void) {
  const double no_residual[ROT_LANES] = {0.0};
  for (int big = 0; big < ROT_LANES; big++) {
    double z[ROT_LANES] = {0.001, 0.002, 0.003, 0.004, 0.005, 0.006, 0.007, 0.008};
    rot_phi_lanes small, mixed;
    rot_phi_in_lanes(z, no_residual, &small);
    z[big] = 2.9;
    rot_phi_in_lanes(z, no_residual, &mixed);
    for (int c = 0; c < 5; c++) {
      for (int l = 0; l < ROT_LANES; l++) {
        if (l != big) ROT_CHECK_ULP(lane(&mixed, c, l), lane(&small, c, l), 1);
      }
    }
    /* 1 - exp(-2.9) over 2.9 */
    ROT_CHECK_ULP(mixed.phi1[big], 0.32585406204951475691, 4);
  }
}

static void check_lane_residual(void) {
  double z[ROT_LANES], z_lo[ROT_LANES] = {0.0};
  rot_phi_lanes with, without;
  for (int l = 0; l < ROT_LANES; l++) z[l] = 0.3 * l;
  rot_phi_in_lanes(z, z_lo, &without);
  for (int l = 0; l < ROT_LANES; l++) z_lo[l] = l * 0x1p-40;
  rot_phi_in_lanes(z, z_lo, &with);
  for (int l = 0; l < ROT_LANES; l++) {
    ROT_CHECK_ULP(with.phi0[l], without.phi0[l] * (1.0 - z_lo[l]), 1);
  }
}

/* ---- the shared table ----------------------------------------------------------------------- */

static void check_shared_table(void) {
  const char *shared = getenv("ROTDYN_SHARED");
  char line[2048];
  long rows = 0;
  FILE *file = NULL;
  if (shared && snprintf(line, sizeof line, "%s/refs/phi.csv", shared) < (int)sizeof line)
    file = fopen(line, "r");
  if (!file) {
    printf("skip - refs/phi.csv: ROTDYN_SHARED does not lead to it\n");
    return;
  }
  while (fgets(line, sizeof line, file)) {
    char *at = line;
    const double z = strtod(at, &at);
    double phi[ROT_PHI_MAX + 1];
    if (at == line) continue; /* the heading */
    rot_phi(z, 0.0, ROT_PHI_MAX, phi);
    for (int k = 0; k <= ROT_PHI_MAX && *at == ','; k++) {
      const double want = strtod(at + 1, &at);
      ROT_CHECK_ULP(phi[k], want, allowed(z, k));
      rows += k == ROT_PHI_MAX;
    }
  }
  fclose(file);
  ROT_CHECK(rows >= 60);
}

int main(void) {
  check_references();
  check_zero();
  check_random_arguments();
  check_borders();
  check_recurrence();
  check_k_max();
  check_residual();
  check_ends();
  check_lanes();
  check_lane_order();
  check_lane_residual();
  check_shared_table();
  return rot_test_report("phi");
}
