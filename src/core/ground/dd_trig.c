#include "ground/dd_trig.h"

double rot_dd_quarter_turns(rot_dd x, rot_dd *r) {
  static const double part[] = {0x1.921fb54442d18p+0, 0x1.1a62633145c07p-54,
                                -0x1.f1976b7ed8fbcp-110, 0x1.4cf98e804177dp-164};
  const double n = nearbyint(x.hi * 0x1.45f306dc9c883p-1);
  rot_dd sum = x;
  for (int i = 0; i < 4; i++) sum = rot_dd_sub(sum, rot_dd_mul2(n, part[i]));
  *r = sum;
  return n;
}

rot_dd rot_dd_sine(rot_dd r) {
  const rot_dd r2 = rot_dd_neg(rot_dd_mul(r, r));
  rot_dd term = r, sum = r;
  for (int j = 1; j < 15; j++) {
    term = rot_dd_div(rot_dd_mul(term, r2), (rot_dd){2.0 * j * (2.0 * j + 1.0), 0.0});
    sum = rot_dd_add(sum, term);
  }
  return sum;
}

void rot_dd_sine_cosine(rot_dd x, rot_dd *sine, rot_dd *cosine) {
  rot_dd r;
  const double n = fmod(rot_dd_quarter_turns(x, &r), 4.0);
  const int quarter = isnan(n) ? 0 : ((int)n + 4) % 4;
  const rot_dd s = rot_dd_sine(r);
  const rot_dd c = rot_dd_sqrt(rot_dd_sub((rot_dd){1.0, 0.0}, rot_dd_mul(s, s)));
  *sine = quarter % 2 ? c : s;
  *cosine = quarter % 2 ? s : c;
  if (quarter >= 2) *sine = rot_dd_neg(*sine);
  if (quarter == 1 || quarter == 2) *cosine = rot_dd_neg(*cosine);
}

rot_dd rot_dd_less_double_turns(rot_dd x) {
  static const rot_dd period = {0x1.921fb54442d18p+3, 0x1.1a62633145c07p-51};
  for (int i = 0; i < 2; i++) {
    const double n = nearbyint(x.hi / period.hi);
    if (n == 0.0) break;
    x = rot_dd_sub(x, rot_dd_mul1(period, n));
  }
  return x;
}
