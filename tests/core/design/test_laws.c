/* Quantile functions against distribution functions written anew, known values, ends,
 * truncation. */
#include "design/laws.h"
#include "rot_test.h"

static rot_vary law(rot_vary_kind kind, double a, double b, double c) {
  rot_vary l = {0};
  l.kind = kind;
  l.p[0] = a;
  l.p[1] = b;
  l.p[2] = c;
  l.low = -HUGE_VAL;
  l.high = HUGE_VAL;
  return l;
}

static double quantile(const rot_vary *l, double u) {
  rot_vary_quantiles(l, 1, &u);
  return u;
}

static void begin(rot_vary *l) {
  rot_store store = {0};
  ROT_CHECK_EQ_INT(rot_vary_begin(l, &store), ROT_OK);
  rot_store_free(&store);
}

static const double places[] = {0x1p-53, 1e-10, 0.001, 0.2, 0.25, 0.5, 0.7, 0.999, 1 - 0x1p-53};
enum { PLACES = sizeof places / sizeof *places };

static void uniform(void) {
  rot_vary l = law(ROT_VARY_UNIFORM, -2.0, 6.0, 0.0);
  begin(&l);
  for (int i = 0; i < PLACES; i++)
    ROT_CHECK_ULP(quantile(&l, places[i]), -2.0 + 8.0 * places[i], 0);
  l = law(ROT_VARY_UNIFORM, 0.1, 0.3, 0.0);
  begin(&l);
  ROT_CHECK(quantile(&l, 1.0 - 0x1p-53) <= 0.3);
}

static void loguniform(void) {
  rot_vary l = law(ROT_VARY_LOGUNIFORM, 0.5, 8.0, 0.0);
  begin(&l);
  for (int i = 0; i < PLACES; i++)
    ROT_CHECK_REL(quantile(&l, places[i]), 0.5 * pow(16.0, places[i]), 1e-15);
  l = law(ROT_VARY_LOGUNIFORM, 1e-300, 1e300, 0.0);
  begin(&l);
  ROT_CHECK_REL(quantile(&l, 0.25), 1e-150, 1e-13);
  ROT_CHECK_REL(quantile(&l, 0.75), 1e150, 1e-13);
  ROT_CHECK_REL(quantile(&l, 0x1p-53), 1e-300, 1e-12);
  ROT_CHECK_REL(quantile(&l, 1.0 - 0x1p-53), 1e300, 1e-12);
}

/* Scores to 40 digits. */
static const double scores[][2] = {{1e-10, -6.361340902404056},
                                   {0.001, -3.090232306167813},
                                   {0.025, -1.959963984540054},
                                   {0.25, -0.6744897501960817},
                                   {0.5, 0.0},
                                   {0.75, 0.6744897501960817},
                                   {0.975, 1.959963984540054},
                                   {0x1p-53, -8.209536151601387}};

static void normal(void) {
  rot_vary l = law(ROT_VARY_NORMAL, 3.0, 2.0, 0.0);
  begin(&l);
  for (size_t i = 0; i < sizeof scores / sizeof *scores; i++) {
    const double want = 3.0 + 2.0 * scores[i][1];
    ROT_CHECK(fabs(quantile(&l, scores[i][0]) - want) <= 4e-15);
    double z = scores[i][0];
    rot_scores(1, &z);
    ROT_CHECK(fabs(z - scores[i][1]) <= 2e-15);
    ROT_CHECK_ULP(3.0 + 2.0 * z, quantile(&l, scores[i][0]), 0);
  }
  ROT_CHECK(isfinite(quantile(&l, 0x1p-53)) && isfinite(quantile(&l, 1 - 0x1p-53)));
  l = law(ROT_VARY_NORMAL, 3.0, 0.0, 0.0);
  begin(&l);
  ROT_CHECK_ULP(quantile(&l, 0.3), 3.0, 0);
}

static void lognormal(void) {
  rot_vary l = law(ROT_VARY_LOGNORMAL, 3.0, 1.2, 0.0);
  begin(&l);
  for (size_t i = 0; i < sizeof scores / sizeof *scores; i++)
    ROT_CHECK_REL(quantile(&l, scores[i][0]), 3.0 * pow(1.2, scores[i][1]), 2e-15);
  l = law(ROT_VARY_LOGNORMAL, 3.0, 1.0, 0.0);
  begin(&l);
  ROT_CHECK_ULP(quantile(&l, 0.3), 3.0, 0);
}

static double below_triangular(const double p[3], double x) {
  return x < p[1] ? (x - p[0]) * (x - p[0]) / ((p[2] - p[0]) * (p[1] - p[0]))
                  : 1.0 - (p[2] - x) * (p[2] - x) / ((p[2] - p[0]) * (p[2] - p[1]));
}

static void triangular(void) {
  const double laws[][3] = {{1.0, 2.0, 5.0}, {-1.0, -1.0, 1.0}, {0.0, 3.0, 3.0}};
  for (int k = 0; k < 3; k++) {
    rot_vary l = law(ROT_VARY_TRIANGULAR, laws[k][0], laws[k][1], laws[k][2]);
    begin(&l);
    for (int i = 0; i < PLACES; i++) {
      const double x = quantile(&l, places[i]);
      ROT_CHECK(x >= laws[k][0] && x <= laws[k][2]);
      ROT_CHECK(fabs(below_triangular(laws[k], x) - places[i]) < 1e-15);
    }
  }
}

static void values(void) {
  const double x[] = {5.0, -0.0, 7.0, 9.0}, weight[] = {1.0, 0.0, 3.0, 0.0};
  rot_store store = {0};
  rot_vary l = law(ROT_VARY_VALUES, 0.0, 0.0, 0.0);
  l.n = 4;
  l.x = x;
  begin(&l);
  ROT_CHECK_ULP(quantile(&l, 0x1p-53), 5.0, 0);
  ROT_CHECK_ULP(quantile(&l, 0.25 - 0x1p-54), 5.0, 0);
  ROT_CHECK(signbit(quantile(&l, 0.25)));
  ROT_CHECK_ULP(quantile(&l, 0.5), 7.0, 0);
  ROT_CHECK_ULP(quantile(&l, 1 - 0x1p-53), 9.0, 0);
  l.weight = weight;
  ROT_CHECK_EQ_INT(rot_vary_begin(&l, &store), ROT_OK);
  ROT_CHECK_ULP(quantile(&l, 0x1p-53), 5.0, 0);
  ROT_CHECK_ULP(quantile(&l, 0.25 - 0x1p-54), 5.0, 0);
  ROT_CHECK_ULP(quantile(&l, 0.25), 7.0, 0); /* the second has no weight */
  ROT_CHECK_ULP(quantile(&l, 1 - 0x1p-53), 7.0, 0);
  /* Where the sum of weights rounds, the last one has still none. */
  const double least[] = {0x1p-1074, 0.0, 0.0, 0.0};
  l.weight = least;
  ROT_CHECK_EQ_INT(rot_vary_begin(&l, &store), ROT_OK);
  ROT_CHECK_ULP(quantile(&l, 0.75), 5.0, 0);
  rot_store_free(&store);
}

static void fixed(void) {
  rot_vary l = law(ROT_VARY_FIXED, -0.0, 0.0, 0.0);
  begin(&l);
  ROT_CHECK(signbit(quantile(&l, 0.3)));
  ROT_CHECK(!rot_vary_varies(&l));
  l.kind = ROT_VARY_COLUMN;
  ROT_CHECK(!rot_vary_varies(&l));
  l.kind = ROT_VARY_VALUES;
  ROT_CHECK(rot_vary_varies(&l));
}

static rot_vary truncated(rot_vary l, double low, double high) {
  l.low = low;
  l.high = high;
  begin(&l);
  return l;
}

static double below_normal(double z) { return 0.5 * erfc(-z / sqrt(2.0)); }

/* F(x) = F(low) + u (F(high) - F(low)), by complementary error functions. */
static void truncations(void) {
  const double z[][2] = {{-1.0, 2.0}, {-HUGE_VAL, 0.5}, {0.25, HUGE_VAL}, {-7.0, -6.0}, {-20, -19}};
  for (int k = 0; k < 5; k++)
    for (int i = 0; i < PLACES; i++) {
      const double from = below_normal(z[k][0]), to = below_normal(z[k][1]);
      const double want = from + places[i] * (to - from);
      rot_vary l = law(ROT_VARY_NORMAL, 3.0, 2.0, 0.0);
      l = truncated(l, 3.0 + 2.0 * z[k][0], 3.0 + 2.0 * z[k][1]);
      double x = quantile(&l, places[i]);
      ROT_CHECK(x >= l.low && x <= l.high);
      ROT_CHECK_REL(below_normal((x - 3.0) / 2.0), want, 1e-12);
      /* The mirror image from the other end: the same digits in the upper tail. */
      rot_vary m = law(ROT_VARY_NORMAL, -3.0, 2.0, 0.0);
      m = truncated(m, -l.high, -l.low);
      if (places[i] == 0.25) ROT_CHECK_REL(quantile(&m, 0.75), -quantile(&l, 0.25), 1e-14);
      if (places[i] == 0.001) ROT_CHECK_REL(quantile(&m, 0.999), -quantile(&l, 0.001), 1e-13);
      rot_vary g = law(ROT_VARY_LOGNORMAL, 3.0, exp(2.0), 0.0);
      g = truncated(g, 3.0 * exp(2.0 * z[k][0]), 3.0 * exp(2.0 * z[k][1]));
      x = quantile(&g, places[i]);
      ROT_CHECK(x >= g.low && x <= g.high);
      ROT_CHECK_REL(below_normal(log(x / 3.0) / 2.0), want, 1e-11);
    }
  for (int i = 0; i < PLACES; i++) {
    const double u = places[i], p[] = {1.0, 2.0, 5.0};
    rot_vary l = truncated(law(ROT_VARY_UNIFORM, -2.0, 6.0, 0.0), 1.0, 9.0);
    ROT_CHECK(fabs(quantile(&l, u) - (1.0 + 5.0 * u)) < 2e-15);
    l = truncated(law(ROT_VARY_UNIFORM, -2.0, 6.0, 0.0), 4.0, 5.0);
    ROT_CHECK(fabs(quantile(&l, u) - (4.0 + u)) < 2e-15);
    l = truncated(law(ROT_VARY_LOGUNIFORM, 0.5, 8.0, 0.0), 0.1, 2.0);
    ROT_CHECK_REL(quantile(&l, u), 0.5 * pow(4.0, u), 1e-15);
    l = truncated(law(ROT_VARY_LOGUNIFORM, 0.5, 8.0, 0.0), 4.0, 100.0);
    ROT_CHECK_REL(quantile(&l, u), 4.0 * pow(2.0, u), 1e-15);
    const double ends[][2] = {{1.5, 4.0}, {0.0, 1.2}, {4.5, 6.0}, {1.2, 1.7}, {3.0, 4.0}};
    for (int k = 0; k < 5; k++) {
      l = truncated(law(ROT_VARY_TRIANGULAR, 1.0, 2.0, 5.0), ends[k][0], ends[k][1]);
      const double from = ends[k][0] < 1.0 ? 0.0 : below_triangular(p, ends[k][0]);
      const double to = ends[k][1] > 5.0 ? 1.0 : below_triangular(p, ends[k][1]);
      ROT_CHECK(fabs(below_triangular(p, quantile(&l, u)) - (from + u * (to - from))) < 1e-15);
    }
    /* The mode at an end, where the law ends. P(x) = ((x - 1)/4)^2 and 1 - ((5 - x)/4)^2. */
    l = truncated(law(ROT_VARY_TRIANGULAR, 1.0, 5.0, 5.0), 3.0, 5.0);
    ROT_CHECK_REL(quantile(&l, u), 1.0 + 4.0 * sqrt(0.25 + 0.75 * u), 1e-15);
    l = truncated(law(ROT_VARY_TRIANGULAR, 1.0, 1.0, 5.0), 1.0, 3.0);
    ROT_CHECK_REL(quantile(&l, u), 5.0 - 4.0 * sqrt(1.0 - 0.75 * u), 1e-15);
  }
}

/* Scores give the quantiles of their probabilities. */
static void of_scores(void) {
  const rot_vary laws[] = {law(ROT_VARY_NORMAL, 3.0, 2.0, 0.0),
                           law(ROT_VARY_LOGNORMAL, 3.0, 1.2, 0.0),
                           law(ROT_VARY_UNIFORM, -2.0, 6.0, 0.0),
                           truncated(law(ROT_VARY_NORMAL, 3.0, 2.0, 0.0), 2.0, 4.0)};
  for (size_t k = 0; k < 4; k++)
    for (int i = -80; i <= 80; i++) {
      rot_vary l = laws[k];
      double z = i / 10.0;
      begin(&l);
      const double want = quantile(&l, i == 0 ? 0.5 : below_normal(z));
      rot_vary_of_scores(&l, 1, &z);
      ROT_CHECK(fabs(z - want) <= (i > 40 ? 0.2 : 1e-9) * (fabs(want) + 1e-3));
      if (k == 0) ROT_CHECK_ULP(z, 3.0 + 2.0 * (i / 10.0), 0);
    }
  double far = 40.0;
  rot_vary l = law(ROT_VARY_TRIANGULAR, 0.0, 1.0, 2.0);
  begin(&l);
  rot_vary_of_scores(&l, 1, &far);
  ROT_CHECK(far < 2.0);
  /* The places next to both ends. */
  double ends[] = {-40.0, 40.0};
  l = law(ROT_VARY_UNIFORM, 0.0, 1.0, 0.0);
  begin(&l);
  rot_vary_of_scores(&l, 2, ends);
  ROT_CHECK(ends[0] == 0x1p-53 && ends[1] == 1.0 - 0x1p-53);
}

static void refused(void) {
  const double x[] = {1.0, 2.0}, negative[] = {1.0, -1.0}, zero[] = {0.0, 0.0};
  const double not_a_number[] = {1.0, (double)NAN}, huge[] = {1.7e308, 1.7e308};
  const rot_vary bad[] = {law(ROT_VARY_FIXED, (double)NAN, 0, 0),
                          law(ROT_VARY_UNIFORM, 1, 1, 0),
                          law(ROT_VARY_UNIFORM, 2, 1, 0),
                          law(ROT_VARY_UNIFORM, -1e308, 1e308, 0),
                          law(ROT_VARY_UNIFORM, 0, HUGE_VAL, 0),
                          law(ROT_VARY_LOGUNIFORM, 0, 1, 0),
                          law(ROT_VARY_LOGUNIFORM, 2, 1, 0),
                          law(ROT_VARY_NORMAL, 0, -1, 0),
                          law(ROT_VARY_NORMAL, (double)NAN, 1, 0),
                          law(ROT_VARY_LOGNORMAL, 0, 2, 0),
                          law(ROT_VARY_LOGNORMAL, 1, 0.9, 0),
                          law(ROT_VARY_TRIANGULAR, 1, 1, 1),
                          law(ROT_VARY_TRIANGULAR, 1, 0, 2),
                          law(ROT_VARY_TRIANGULAR, 1, 3, 2),
                          law(ROT_VARY_VALUES, 0, 0, 0),
                          law(ROT_VARY_COLUMN, 0, 0, 0),
                          law(ROT_VARY_COUNT, 0, 1, 0),
                          law((rot_vary_kind)77, 0, 1, 0)};
  rot_store store = {0};
  for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
    rot_vary l = bad[i];
    ROT_CHECK_EQ_INT(rot_vary_begin(&l, &store), ROT_EVALUE);
  }
  const double *weights[] = {negative, zero, not_a_number, huge};
  for (int i = 0; i < 4; i++) {
    rot_vary l = law(ROT_VARY_VALUES, 0, 0, 0);
    l.n = 2;
    l.x = x;
    l.weight = weights[i];
    ROT_CHECK_EQ_INT(rot_vary_begin(&l, &store), ROT_EVALUE);
  }
  const double cuts[][2] = {
      {100.0, 101.0}, {-101.0, -100.0}, {1.0, 1.0}, {2.0, 1.0}, {(double)NAN, 1.0}};
  for (int i = 0; i < 5; i++) {
    rot_vary l = law(ROT_VARY_NORMAL, 0, 1, 0);
    l.low = cuts[i][0];
    l.high = cuts[i][1];
    ROT_CHECK_EQ_INT(rot_vary_begin(&l, &store), ROT_EVALUE);
  }
  rot_vary l = law(ROT_VARY_NORMAL, 0, 0, 0);
  l.low = -1.0;
  ROT_CHECK_EQ_INT(rot_vary_begin(&l, &store), ROT_EVALUE);
  l = law(ROT_VARY_FIXED, 0, 0, 0);
  l.high = 1.0;
  ROT_CHECK_EQ_INT(rot_vary_begin(&l, &store), ROT_EVALUE);
  rot_store_free(&store);
}

static void names(void) {
  ROT_CHECK(!strcmp(rot_vary_name(ROT_VARY_LOGNORMAL), "lognormal"));
  ROT_CHECK(!strcmp(rot_vary_parameter(ROT_VARY_TRIANGULAR, 2), "high"));
  ROT_CHECK(!strcmp(rot_vary_parameter(ROT_VARY_NORMAL, 2), ""));
  ROT_CHECK(!rot_vary_name(-1) && !rot_vary_name(ROT_VARY_COUNT));
}

int main(void) {
  uniform();
  loguniform();
  normal();
  lognormal();
  triangular();
  values();
  fixed();
  truncations();
  of_scores();
  refused();
  names();
  return rot_test_report("laws of inputs");
}
