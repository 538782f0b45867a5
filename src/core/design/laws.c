#include "design/laws.h"

#include <gsl/gsl_cdf.h>
#include <math.h>

static const struct {
  const char *name, *parameter[ROT_VARY_PARAMETERS];
} kinds[ROT_VARY_COUNT] = {
#define X(code, name, a, b, c) {name, {a, b, c}},
    ROT_VARY_LIST(X)
#undef X
};

const char *rot_vary_name(int kind) {
  return kind >= 0 && kind < ROT_VARY_COUNT ? kinds[kind].name : NULL;
}

const char *rot_vary_parameter(int kind, int i) {
  return kind >= 0 && kind < ROT_VARY_COUNT && i >= 0 && i < ROT_VARY_PARAMETERS
             ? kinds[kind].parameter[i]
             : "";
}

int rot_vary_varies(const rot_vary *law) {
  return law->kind != ROT_VARY_FIXED && law->kind != ROT_VARY_COLUMN;
}

static inline double clamp(double x, double low, double high) {
  return x < low ? low : x > high ? high : x;
}

/* ---- probability => value ------------------------------------------------------------------- */

/* p, the probability below, and q = 1 - p, of which the smaller one is exact */
static inline double score(double p, double q) {
  return p < q ? gsl_cdf_ugaussian_Pinv(p) : -gsl_cdf_ugaussian_Pinv(q);
}

static inline double uniform(const rot_vary *law, double p) {
  return clamp(law->p[0] + p * (law->p[1] - law->p[0]), law->p[0], law->p[1]);
}

/* In two factors from the nearer end: no overflow, and the exponents stay small. */
static inline double loguniform(const rot_vary *law, double ratio, double p, double q) {
  const double half = exp(p < q ? 0.5 * p * ratio : -0.5 * q * ratio);
  return clamp((p < q ? law->p[0] : law->p[1]) * half * half, law->p[0], law->p[1]);
}

static inline double triangular(const rot_vary *law, double rises, double falls, double p,
                                double q) {
  const double a = law->p[0], b = law->p[2];
  return clamp(p < rises ? a + (b - a) * sqrt(p * rises) : b - (b - a) * sqrt(q * falls), a, b);
}

static double log_ratio(const rot_vary *law) { return log(law->p[1]) - log(law->p[0]); }
static double rising_part(const rot_vary *law) {
  return (law->p[1] - law->p[0]) / (law->p[2] - law->p[0]);
}
static double falling_part(const rot_vary *law) {
  return (law->p[2] - law->p[1]) / (law->p[2] - law->p[0]);
}

static inline double value_of_score(const rot_vary *law, double log_factor, double z) {
  return law->kind == ROT_VARY_NORMAL ? law->p[0] + law->p[1] * z : law->p[0] * exp(log_factor * z);
}

/* Index of the value whose weights cover the probability. */
static size_t covering(const rot_vary *law, double u) {
  const double want = u * law->cumulative[law->n - 1];
  size_t low = 0, high = law->n - 1;
  while (low < high) {
    const size_t middle = low + (high - low) / 2;
    if (law->cumulative[middle] > want)
      high = middle;
    else
      low = middle + 1;
  }
  while (low && !(law->weight[low] > 0.0)) low--;
  return low;
}

static void values(const rot_vary *law, size_t n, double u[]) {
  const double size = (double)law->n;
  for (size_t i = 0; i < n; i++) {
    if (law->cumulative) {
      u[i] = law->x[covering(law, u[i])];
    } else {
      const size_t at = (size_t)(u[i] * size);
      u[i] = law->x[at < law->n ? at : law->n - 1];
    }
  }
}

static int is_truncated(const rot_vary *law) {
  return law->low > -HUGE_VAL || law->high < HUGE_VAL;
}

/* (p, q) of each place, by the case that is the same for a whole column. */
#define FOR_ALL(expression)                                                                        \
  do {                                                                                             \
    for (size_t i = 0; i < n; i++) {                                                               \
      const double part = law->from + law->span * u[i];                                            \
      const double p = law->upper ? 1.0 - part : part, q = law->upper ? part : 1.0 - part;         \
      (void)p, (void)q;                                                                            \
      u[i] = (expression);                                                                         \
    }                                                                                              \
  } while (0)

void rot_vary_quantiles(const rot_vary *law, size_t n, double u[]) {
  switch (law->kind) {
  case ROT_VARY_FIXED:
    for (size_t i = 0; i < n; i++) u[i] = law->p[0];
    return;
  case ROT_VARY_VALUES: values(law, n, u); return;
  case ROT_VARY_UNIFORM: FOR_ALL(uniform(law, p)); break;
  case ROT_VARY_LOGUNIFORM: {
    const double ratio = log_ratio(law);
    FOR_ALL(loguniform(law, ratio, p, q));
    break;
  }
  case ROT_VARY_NORMAL: FOR_ALL(law->p[0] + law->p[1] * score(p, q)); break;
  case ROT_VARY_LOGNORMAL: {
    const double log_factor = log(law->p[1]);
    FOR_ALL(law->p[0] * exp(log_factor * score(p, q)));
    break;
  }
  case ROT_VARY_TRIANGULAR: {
    const double rises = rising_part(law), falls = falling_part(law);
    FOR_ALL(triangular(law, rises, falls, p, q));
    break;
  }
  case ROT_VARY_COLUMN:
  case ROT_VARY_COUNT: return;
  }
  if (!is_truncated(law)) return;
  for (size_t i = 0; i < n; i++) u[i] = clamp(u[i], law->low, law->high);
}

void rot_scores(size_t n, double u[]) {
  for (size_t i = 0; i < n; i++) u[i] = score(u[i], 1.0 - u[i]);
}

void rot_vary_of_scores(const rot_vary *law, size_t n, double z[]) {
  const int is_normal = law->kind == ROT_VARY_NORMAL || law->kind == ROT_VARY_LOGNORMAL;
  if (is_normal && !is_truncated(law)) {
    const double log_factor = log(law->p[1]);
    for (size_t i = 0; i < n; i++) z[i] = value_of_score(law, log_factor, z[i]);
    return;
  }
  for (size_t i = 0; i < n; i++) z[i] = clamp(gsl_cdf_ugaussian_P(z[i]), 0x1p-53, 1.0 - 0x1p-53);
  rot_vary_quantiles(law, n, z);
}

/* ---- checks and preparation ----------------------------------------------------------------- */

/* Probabilities below and above x. */
static void probabilities(const rot_vary *law, double x, double *below, double *above) {
  const double *p = law->p;
  switch (law->kind) {
  case ROT_VARY_UNIFORM:
    *below = clamp((x - p[0]) / (p[1] - p[0]), 0.0, 1.0);
    *above = clamp((p[1] - x) / (p[1] - p[0]), 0.0, 1.0);
    return;
  case ROT_VARY_LOGUNIFORM:
    *below = x <= p[0] ? 0.0 : clamp((log(x) - log(p[0])) / log_ratio(law), 0.0, 1.0);
    *above = x <= p[0] ? 1.0 : clamp((log(p[1]) - log(x)) / log_ratio(law), 0.0, 1.0);
    return;
  case ROT_VARY_NORMAL:
  case ROT_VARY_LOGNORMAL: {
    const double z = law->kind == ROT_VARY_NORMAL ? (x - p[0]) / p[1]
                     : x > 0.0                    ? (log(x) - log(p[0])) / log(p[1])
                                                  : -HUGE_VAL;
    *below = gsl_cdf_ugaussian_P(z);
    *above = gsl_cdf_ugaussian_Q(z);
    return;
  }
  case ROT_VARY_TRIANGULAR: {
    const double width = p[2] - p[0], from = (x - p[0]) / width, to = (p[2] - x) / width;
    if (x <= p[0] || x >= p[2]) {
      *below = x >= p[2];
      *above = x <= p[0];
    } else if (x < p[1]) {
      *below = from * from / rising_part(law);
      *above = 1.0 - *below;
    } else {
      *above = to * to / falling_part(law);
      *below = 1.0 - *above;
    }
    return;
  }
  default: *below = *above = 0.5; /* not truncated */
  }
}

static int is_sound(const rot_vary *law) {
  const double *p = law->p;
  int finite = 1;
  for (int i = 0; i < ROT_VARY_PARAMETERS; i++)
    finite = finite && (!*rot_vary_parameter((int)law->kind, i) || isfinite(p[i]));
  switch (law->kind) {
  case ROT_VARY_FIXED: return !isnan(p[0]) && !is_truncated(law);
  case ROT_VARY_COLUMN: return law->n > 0 && law->x && !is_truncated(law);
  case ROT_VARY_VALUES:
    return law->n > 0 && (double)law->n <= 0x1p52 && law->x && !is_truncated(law);
  case ROT_VARY_UNIFORM: return finite && p[0] < p[1] && isfinite(p[1] - p[0]);
  case ROT_VARY_LOGUNIFORM: return finite && p[0] > 0.0 && p[0] < p[1];
  case ROT_VARY_NORMAL: return finite && p[1] >= 0.0;
  case ROT_VARY_LOGNORMAL: return finite && p[0] > 0.0 && p[1] >= 1.0;
  case ROT_VARY_TRIANGULAR:
    return finite && p[0] <= p[1] && p[1] <= p[2] && p[0] < p[2] && isfinite(p[2] - p[0]);
  case ROT_VARY_COUNT: break;
  }
  return 0;
}

static rot_status add_weights(rot_vary *law, rot_store *store) {
  double *sum = rot_store_get(store, law->n, sizeof *sum), total = 0.0;
  if (!sum) return ROT_ENOMEM;
  for (size_t i = 0; i < law->n; i++) {
    if (!(law->weight[i] >= 0.0)) return ROT_EVALUE;
    sum[i] = total += law->weight[i];
  }
  law->cumulative = sum;
  return total > 0.0 && isfinite(total) ? ROT_OK : ROT_EVALUE;
}

rot_status rot_vary_begin(rot_vary *law, rot_store *store) {
  law->cumulative = NULL;
  law->from = 0.0;
  law->span = 1.0;
  law->upper = 0;
  if (!is_sound(law)) return ROT_EVALUE;
  if (law->kind == ROT_VARY_VALUES) return law->weight ? add_weights(law, store) : ROT_OK;
  if (!is_truncated(law)) return ROT_OK;
  if (!(law->low < law->high)) return ROT_EVALUE;
  if ((law->kind == ROT_VARY_NORMAL && !(law->p[1] > 0.0)) ||
      (law->kind == ROT_VARY_LOGNORMAL && !(law->p[1] > 1.0)))
    return ROT_EVALUE;
  double below[2], above[2];
  probabilities(law, law->low, &below[0], &above[0]);
  probabilities(law, law->high, &below[1], &above[1]);
  /* From the end with the smaller probabilities, which have more digits. From the upper end they
   * fall as u grows. */
  law->upper = above[0] < 0.5;
  law->from = law->upper ? above[0] : below[0];
  law->span = law->upper ? above[1] - above[0] : below[1] - below[0];
  return fabs(law->span) > 0.0 ? ROT_OK : ROT_EVALUE;
}
