/* Divided differences of the exponential against values from mpmath, 300 digits. */
#include "maths/divided.h"
#include "ground/real.h"
#include "rot_test.h"

/* z, y, exp[-z, iy], exp[0, -z, iy] */
static const double waves[][6] = {
    {0.0, 0.0, 1.0, 0.0, 0.5, 0.0},
    {1e-09, 1e-09, 0.9999999995, 4.9999999983333336447e-10, 0.49999999983333333333,
     1.6666666662500001038e-10},
    {1e-200, 3e-05, 0.99999999985000000001, 0.00001499999999887500038, 0.4999999999625,
     4.9999999997750001267e-6},
    {0.3, 0.4, 0.83936067567924144853, 0.17891357345651305352, 0.44728393364128260896,
     0.061446471787580836101},
    {2.0, 2.0, 0.089453826760481654126, 0.36519488665235919357, 0.18259744332617959679,
     0.17143926581060599996},
    {2.0, 2.0000000000000004, 0.089453826760481537586, 0.36519488665235919785,
     0.18259744332617955838, 0.17143926581060602017},
    {1.9, -1.5, 0.22977180657879021073, -0.34359856670308902388, 0.22906571113539268258,
     -0.14521577132549599068},
    {0.0, 1.2, 0.77669923830602197339, 0.53136853793610533714, 0.442807114946754464,
     0.18608396807831502906},
    {0.7, 0.0, 0.71916385172655785026, 0.0, 0.4011944975334888108, 0.0},
    {0.001, 6.283185307179586, 2.5317634303005033843e-8, -0.00015907538811011646965,
     -0.000025317634341986751641, 0.15907538811011646634},
    {3.0, 0.1, 0.31583070281855363859, 0.022750115454990930739, 0.22750115454990929477,
     0.0090694105882504703579},
    {0.1, 30.0, -0.033017419050455762998, 0.024909474208110998031, 0.00083031580693703326771,
     0.032821441289695334292},
    {100.0, 100.0, 0.0017797661558896257022, -0.0068434225669872136388, -0.000068434225669872136388,
     0.000082202338441103742978},
    {-1.5, 0.3, 2.2983696298363632824, 0.26266045485971292981, 0.8755348495323764651,
     0.075854723518933111585},
    {-9.0, 4.0, 751.86196835860821509, 334.24496399219342096, 83.561240998048355239,
     37.092394787441946442},
    {-40.0, 1000.0, 9400370081350.639198, 235009252033765.95928, 235009252033.76595928,
     5875231300844.148971},
    {100000000.0, 2.5, -8.0114360058512961152e-9, 5.9847216413254650868e-9,
     2.3938886565301860347e-9, 7.2045744023405184461e-9},
    {0.0, 1000000.0, -3.4999350217129295212e-7, 6.3247872466855213061e-8, 6.3247872466855213061e-14,
     1.0000003499935021713e-6},
    {5.0, 1000000000.0, 5.4584345360444572242e-10, -8.3114923163559959927e-10,
     -8.3114923163559959927e-19, 1.9865241005433945298e-10},
};
/* q, r, exp[0, -q, -q - r] */
static const double decays[][3] = {
    {0.0, 0.0, 0.5},
    {1e-300, 0.0, 0.5},
    {0.0, 1e-09, 0.49999999983333333337},
    {0.1, 0.2, 0.43843277623065243975},
    {1.0, 0.0, 0.26424111765711535681},
    {0.0, 1.0, 0.3678794411714423216},
    {1.5, 1.5, 0.13411705512688984114},
    {2.5, 0.49, 0.10109465454194861454},
    {2.5, 0.51, 0.10061972537117322045},
    {3.0, 0.0, 0.088983525169838247565},
    {0.0, 3.0, 0.22775411870754043811},
    {0.001, 5.0, 0.16017722638318751604},
    {7.0, 1e-09, 0.0202592845742232748},
    {20.0, 20.0, 0.0012499999948471159492},
    {1e-12, 1000000.0, 9.999989999995e-7},
    {1000000.0, 1000000.0, 5.0e-13},
};

static void check_waves(void) {
  double worst = 0.0;
  for (size_t i = 0; i < sizeof waves / sizeof *waves; i++) {
    const double *row = waves[i], z = row[0], y = row[1];
    const rot_divided_wave w = rot_divided_wave_at(z, 0.0, y, 0.0, y / z);
    for (int k = 0; k < 2; k++) {
      const double re = row[2 + 2 * k], im = row[3 + 2 * k], size = w.size[k] / fabs(w.scale);
      const double off = hypot(w.re[k] / w.scale - re, w.im[k] / w.scale - im);
      ROT_CHECK(off <= 6.0 * ROT_EPS * size);
      /* What is added is not much more than what comes out, but where phi_1 meets phi_1. */
      ROT_CHECK(size >= 0.99 * hypot(re, im) && size <= 6.0 * hypot(re, im));
      worst = fmax(worst, off / (ROT_EPS * hypot(re, im)));
    }
  }
  printf("waves: worst %.2f units of roundoff\n", worst);
  ROT_CHECK(worst <= 6.0);
}

/* z beyond the range: exp[-z, iy] z = exp(iy)/(1 + i y/z), and exp[0, -z, iy] z = phi_1(iy). */
static void check_infinite(void) {
  const rot_divided_wave w = rot_divided_wave_at(INFINITY, 0.0, 2.0, 0.0, 0.0);
  ROT_CHECK(isinf(w.scale));
  ROT_CHECK_ULP(w.re[0], -0.41614683654714238700, 1);
  ROT_CHECK_ULP(w.im[0], 0.90929742682568169540, 1);
  ROT_CHECK_ULP(w.re[1], 0.45464871341284084770, 1);
  ROT_CHECK_ULP(w.im[1], 0.70807341827357119350, 1);
  const rot_divided_wave tilted = rot_divided_wave_at(INFINITY, 0.0, 2.0, 0.0, 0.5);
  /* (cos 2 + i sin 2)/(1 + i/2) */
  ROT_CHECK_REL(tilted.re[0], 0.03080150149255876856, 6e-16 * 15);
  ROT_CHECK_REL(tilted.im[0], 0.89389667607940231112, 6e-16);
}

/* Large angles keep their digits: y + y_lo = 1e12 + 3e-5, where y alone is off by far. */
static void check_residuals(void) {
  double s, c;
  rot_sin_cos(1e12, 3e-5, &s, &c);
  ROT_CHECK_ULP(s, -0.61121495871278005694, 1);
  ROT_CHECK_ULP(c, 0.79146463865780799036, 1);
  rot_sin_cos(0x1p80, 0x1.8p20, &s, &c);
  ROT_CHECK_ULP(s, -0.5026829910335996411, 1);
  ROT_CHECK_ULP(c, 0.86447082687937710581, 1);
  int e;
  double x = rot_exp_split(-2000.3, 1e-14, &e);
  ROT_CHECK_ULP(ldexp(x, e + 2886), 1.130616541639230379, 1);
  x = rot_exp_split(1234.5, -1e-14, &e);
  ROT_CHECK_ULP(ldexp(x, e - 1781), 1.0048833074077181026, 1);
  x = rot_exp_split(3.0, 0.0, &e);
  ROT_CHECK(e == 0);
  ROT_CHECK_ULP(x, 20.085536923187667741, 1);
  ROT_CHECK(rot_exp_split(-1e9, 0.0, &e) == 0.0);
  ROT_CHECK(isinf(rot_exp_split(1e9, 0.0, &e)));
}

static void check_decays(void) {
  for (size_t i = 0; i < sizeof decays / sizeof *decays; i++) {
    double scale, q = decays[i][0], r = decays[i][1];
    const double value = rot_divided_decay(q + r, q, r, &scale);
    ROT_CHECK_ULP(value / scale, decays[i][2], 4);
  }
}

/* Sine and cosine of x + x_lo: by the sums of angles in extended precision, where that is more. */
static void check_split_angle(void) {
  if (sizeof(long double) <= sizeof(double)) return;
  const double at[] = {0.5, -2.0, 1e9, -3e12};
  for (int i = 0; i < 4; i++) {
    for (int e = -40; e <= -12; e++) {
      const double lo = 0.7 * ldexp(1.0, e);
      const long double s = sinl(at[i]), c = cosl(at[i]), sl = sinl(lo), cl = cosl(lo);
      double sine, cosine;
      rot_sin_cos(at[i], lo, &sine, &cosine);
      ROT_CHECK(fabs(sine - (double)(s * cl + c * sl)) <= 2.3e-16);
      ROT_CHECK(fabs(cosine - (double)(c * cl - s * sl)) <= 2.3e-16);
    }
  }
}

int main(void) {
  check_waves();
  check_infinite();
  check_residuals();
  check_decays();
  check_split_angle();
  return rot_test_report("divided");
}
