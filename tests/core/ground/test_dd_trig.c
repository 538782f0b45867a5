/* Sines and cosines to twice the precision: 40-digit values, exact identities. */
#include "ground/dd_trig.h"
#include "rot_test.h"

/* x, sin x, cos x as hi + lo. By mpmath 1.2, 60 digits. */
static const double table[][5] = {
    {0x1.999999999999ap-4, 0x1.98eaecb8bcb2cp-4, 0x1.c687ae84515ddp-59, 0x1.fd712f9a817c1p-1,
     -0x1.fb7ab33ee2672p-55},
    {0x1.3333333333333p-1, 0x1.2118d17a54159p-1, -0x1.2bc34d9627555p-55, 0x1.a69263c485b15p-1,
     -0x1.4d746437cb9a1p-56},
    {0x1.921fb54442d18p-1, 0x1.6a09e667f3bccp-1, 0x1.7a7fb8d4bd43fp-55, 0x1.6a09e667f3bcdp-1,
     -0x1.ec4c7696139d5p-56},
    {0x1.8000000000000p+0, 0x1.feb7a9b2c6d8bp-1, -0x1.0c8f40129a886p-56, 0x1.21bd54fc5f9a7p-4,
     0x1.0fcb936b1ce7ep-58},
    {0x1.921fb54442d18p+0, 0x1.0000000000000p+0, -0x1.377ce858a5d48p-109, 0x1.1a62633145c07p-54,
     -0x1.f1976b7ed8fbcp-110},
    {0x1.0000000000000p+1, 0x1.d18f6ead1b446p-1, -0x1.02a3dbf3bffb2p-56, -0x1.aa22657537205p-2,
     0x1.6f3341d4d1235p-56},
    {0x1.921fb54442d18p+1, 0x1.1a62633145c07p-53, -0x1.f1976b7ed8fbdp-109, -0x1.0000000000000p+0,
     0x1.377ce858a5d48p-107},
    {0x1.0000000000000p+2, -0x1.837b9dddc1eaep-1, -0x1.c33a601568391p-55, -0x1.4eaa606db24c1p-1,
     0x1.dcc92f1e91c23p-56},
    {0x1.6000000000000p+2, -0x1.693c94e0ab057p-1, 0x1.49447d34a5e8bp-56, 0x1.6ad6c3c07d448p-1,
     0x1.598876a8e32fap-57},
    {0x1.921fb54442d18p+2, -0x1.1a62633145c07p-52, 0x1.f1976b7ed8fbfp-108, 0x1.0000000000000p+0,
     -0x1.377ce858a5d48p-105},
    {0x1.b7cdfd9d7bdbbp-34, 0x1.b7cdfd9d7bdbbp-34, -0x1.b0b0ffe8fae2bp-103, 0x1.0000000000000p+0,
     -0x1.79ca10c924224p-68},
    {0x1.9000000000000p+6, -0x1.03425b78c4db8p-1, -0x1.c23d8557420fbp-59, 0x1.b981dbf665fdfp-1,
     0x1.8fd0cdcd985e8p-55},
    {0x1.81cd6c8b43958p+13, -0x1.687d5890974a5p-1, -0x1.6a6c3056ad519p-56, 0x1.6b94c3bbe24b8p-1,
     -0x1.c9c50dc8917f6p-56},
    {0x1.7d78400000000p+26, 0x1.dcffca623a20bp-1, -0x1.de3348eb386bap-58, -0x1.741b388a8c029p-2,
     -0x1.eed99719ca202p-56},
};

static double off(rot_dd x, double hi, double lo) {
  const rot_dd d = rot_dd_sub(x, (rot_dd){hi, lo});
  return fabs(d.hi);
}

int main(void) {
  double worst = 0.0;
  for (size_t i = 0; i < sizeof table / sizeof *table; i++) {
    const double *x = table[i];
    rot_dd s, c;
    rot_dd_sine_cosine((rot_dd){x[0], 0.0}, &s, &c);
    worst = fmax(worst, fmax(off(s, x[1], x[2]), off(c, x[3], x[4])));
    ROT_CHECK(off(s, x[1], x[2]) <= 0x1p-98 && off(c, x[3], x[4]) <= 0x1p-98);
    rot_dd_sine_cosine((rot_dd){-x[0], 0.0}, &s, &c);
    ROT_CHECK(off(s, -x[1], -x[2]) <= 0x1p-98 && off(c, x[3], x[4]) <= 0x1p-98);
  }
  printf("sine and cosine: %.1e at most\n", worst);
  /* 4 pi n + x, with 4 pi as two doubles */
  const rot_dd period = {0x1.921fb54442d18p+3, 0x1.1a62633145c07p-51};
  for (int n = -1000; n <= 1000; n += 7) {
    const rot_dd x = rot_dd_add1(rot_dd_mul1(period, n), 0.625);
    ROT_CHECK(off(rot_dd_less_double_turns(x), 0.625, 0.0) <= 1e-25);
  }
  return rot_test_report("dd_trig");
}
