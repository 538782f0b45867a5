#include "measure/smooth.h"

#include <gsl/gsl_randist.h>
#include <gsl/gsl_rng.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Max order, max states: one more for the correlated part of the errors. */
enum { ORDERS = ROT_SMOOTH_MAX, P = ORDERS + 1, PP = P * P, CHANNELS = ROT_SMOOTH_CHANNELS };

/* Standard deviation of an unknown state, in units of sigma about a polynomial through the next
 * samples. 1e3 changes results by 6e-4 of a standard error; 1e5 loses digits at small lambda. */
static const double diffuse = 1e4;
/* The same for the first angle of a record without angles: it is set to 0. */
static const double pinned = 1e-6;
/* Relative change of gain and variance below which they are kept constant. */
static const double settled = 1e-13;
/* Relative difference below which spacings are equal. */
static const double equal_gap = 1e-9;

static const double binomial[ORDERS][ORDERS] = {
    {1, 1, 1, 1, 1}, {0, 1, 2, 3, 4}, {0, 0, 1, 3, 6}, {0, 0, 0, 1, 4}, {0, 0, 0, 0, 1}};

/* ---- small matrices, by rows, `stride` apart ------------------------------------------------- */

/* m => upper triangle R with R'R = M'M, in the first rows of m, by Householder reflections */
static void triangle(double *m, int rows, int columns, int stride) {
  for (int c = 0; c < columns && c < rows; c++) {
    double square = 0.0;
    for (int r = c + 1; r < rows; r++) square += m[r * stride + c] * m[r * stride + c];
    if (!(square > 0.0)) continue;
    const double pivot = m[c * stride + c];
    const double norm = sqrt(pivot * pivot + square), to = pivot > 0.0 ? -norm : norm;
    const double head = pivot - to, scale = 1.0 / (head * to); /* -2/|v|^2 */
    for (int j = c + 1; j < columns; j++) {
      double dot = head * m[c * stride + j];
      for (int r = c + 1; r < rows; r++) dot += m[r * stride + c] * m[r * stride + j];
      dot *= scale;
      m[c * stride + j] += dot * head;
      for (int r = c + 1; r < rows; r++) m[r * stride + j] += dot * m[r * stride + c];
    }
    m[c * stride + c] = to;
    for (int r = c + 1; r < rows; r++) m[r * stride + c] = 0.0;
  }
}

/* ---- the process ----------------------------------------------------------------------------- */

/* The process and its transition over the last gap. */
typedef struct process {
  int p, states;       /* order; with the correlated part of the errors */
  double root_lambda;  /* sqrt(lambda) */
  double unit[PP];     /* factor of Q for gap 1, lambda 1, upper triangle */
  double gap, keep;    /* of the last transition */
  double a[PP], q[PP]; /* A; factor of Q */
} process;

/* (model, states) => process; the factor of Q by Cholesky's method */
static void process_begin(process *of, const rot_smooth_model *model, int states) {
  static const double factorial[ORDERS] = {1, 1, 2, 6, 24};
  const int p = model->order;
  of->p = p;
  of->states = states;
  of->keep = NAN;
  of->root_lambda = sqrt(model->lambda);
  of->gap = NAN;
  for (int i = 0; i < p; i++)
    for (int j = 0; j <= i; j++) { /* Cholesky's L, stored as its transpose */
      const double scale =
          factorial[p - 1 - i] * factorial[p - 1 - j] * factorial[i] * factorial[j];
      double sum = 1.0 / ((2 * p - 1 - i - j) * scale);
      for (int k = 0; k < j; k++) sum -= of->unit[k * p + i] * of->unit[k * p + j];
      of->unit[j * p + i] = i == j ? sqrt(sum) : sum / of->unit[j * p + j];
      if (i != j) of->unit[i * p + j] = 0.0;
    }
}

static double keep_at(const rot_smooth_nodes *nodes, size_t k) {
  return nodes->keep ? nodes->keep[k] : 0.0;
}

/* (gap, correlation `keep`) => A and the factor of Q over it */
static void process_over(process *of, double gap, double keep) {
  const int p = of->p, n = of->states;
  double power[P];
  if (of->gap == gap && (n == p || of->keep == keep)) return;
  of->gap = gap;
  of->keep = keep;
  power[0] = 1.0;
  for (int i = 1; i < p; i++) power[i] = power[i - 1] * gap;
  const double root = of->root_lambda * sqrt(gap);
  for (int i = 0; i < n; i++)
    for (int j = 0; j < n; j++) {
      const int of_motion = i < p && i <= j && j < p;
      of->a[i * n + j] = of_motion ? binomial[i][j] * power[j - i] : 0.0;
      of->q[i * n + j] = of_motion ? root * power[p - 1 - j] * of->unit[i * p + j] : 0.0;
    }
  if (n > p) {
    of->a[n * n - 1] = keep;
    of->q[n * n - 1] = sqrt((1.0 - keep) * (1.0 + keep));
  }
}

static void advance(const process *of, const double *x, double *to) {
  const int p = of->p, n = of->states;
  for (int i = 0; i < p; i++) {
    double sum = x[i];
    for (int j = i + 1; j < p; j++) sum += of->a[i * n + j] * x[j];
    to[i] = sum;
  }
  if (n > p) to[p] = of->keep * x[p];
}

int rot_smooth_states(const rot_smooth_nodes *nodes, int order) {
  return nodes->slow ? order + 1 : order;
}

/* => s.d. of the correlated part of a sample's error, 0 without one */
static double slow_at(const rot_smooth_nodes *nodes, int channel, size_t k) {
  return nodes->slow && nodes->slow_channel == channel ? nodes->slow[k] : 0.0;
}

/* ---- the start ------------------------------------------------------------------------------- */

static int has(const rot_smooth_nodes *nodes, int channel, size_t k) {
  return nodes->y[channel] != NULL && !isnan(nodes->y[channel][k]);
}

static double weight(const rot_smooth_nodes *nodes, int channel, size_t k) {
  return nodes->w[channel] ? nodes->w[channel][k] : 1.0;
}

/* k => mean and diffuse standard deviation of each state at node k, from the least-squares
 * polynomial through the samples that follow. The angle of a segment without angles is 0. */
static void start(const rot_smooth_nodes *nodes, int p, size_t k, double *mean, double *sd) {
  enum { MAX = 2 * P + 2 };
  double m[MAX * (P + 1)], scale = 0.0;
  int rows = 0, angles = 0;
  const int columns = p + 1, max = 2 * p + 2;
  double at = 0.0, last = 0.0;
  double times[MAX];
  int channels[MAX];
  size_t index[MAX];
  for (size_t i = k; i < nodes->n && rows < max; i++) {
    if (i > k && nodes->first[i] == ROT_SMOOTH_STARTS) break;
    if (i > k) at += nodes->gap[i];
    for (int c = 0; c < CHANNELS && rows < max; c++)
      if (has(nodes, c, i)) {
        times[rows] = last = at;
        channels[rows] = c;
        index[rows++] = i;
        angles += c == ROT_SMOOTH_ANGLE;
      }
  }
  /* If the first samples are rates, an angle may follow later. */
  for (size_t i = k; angles == 0 && nodes->y[ROT_SMOOTH_ANGLE] && i < nodes->n; i++) {
    if (i > k && nodes->first[i] == ROT_SMOOTH_STARTS) break;
    angles += has(nodes, ROT_SMOOTH_ANGLE, i);
  }
  scale = last > 0.0 ? last : 1.0;
  for (int r = 0; r < rows; r++) {
    const double u = times[r] / scale, w = weight(nodes, channels[r], index[r]);
    double power = 1.0;
    double *row = m + r * columns;
    if (channels[r] == ROT_SMOOTH_ANGLE) {
      for (int j = 0; j < p; j++, power *= u) row[j] = power / w;
    } else {
      row[0] = 0.0;
      for (int j = 1; j < p; j++, power *= u) row[j] = j * power / (scale * w);
    }
    row[p] = nodes->y[channels[r]][index[r]] / w;
  }
  /* Spacing of these samples in mean spacings: the slope through a close group is inaccurate. */
  const double usual = rows > 1 ? last / (rows - 1) : 1.0;
  const int odd = !(usual > 0.1 && usual < 10.0);
  triangle(m, rows, columns, columns);
  double inverse[PP];
  int known[P];
  for (int i = 0; i < p; i++) {
    double largest = 0.0;
    for (int r = 0; r <= i && r < rows; r++) largest = fmax(largest, fabs(m[r * columns + i]));
    known[i] = i < rows && fabs(m[i * columns + i]) > 1e-10 * largest;
  }
  for (int i = p - 1; i >= 0; i--) {
    double sum = i < rows ? m[i * columns + p] : 0.0;
    for (int j = i + 1; j < p; j++)
      if (i < rows) sum -= m[i * columns + j] * mean[j];
    mean[i] = known[i] ? sum / m[i * columns + i] : 0.0;
  }
  memset(inverse, 0, sizeof inverse);
  for (int c = 0; c < p; c++)
    if (known[c])
      for (int i = c; i >= 0; i--) {
        double sum = i == c ? 1.0 : 0.0;
        for (int j = i + 1; j <= c; j++) sum -= m[i * columns + j] * inverse[j * P + c];
        inverse[i * P + c] = known[i] ? sum / m[i * columns + i] : 0.0;
      }
  double power = 1.0;
  for (int i = 0; i < p; i++, power *= scale) {
    double square = 0.0;
    for (int j = 0; j < p; j++) square += inverse[i * P + j] * inverse[i * P + j];
    mean[i] /= power;
    const double error = sqrt(square) / power;
    sd[i] = diffuse * (odd && error > 0.0 ? error : 1.0);
  }
  if (angles == 0) mean[0] = 0.0, sd[0] = pinned;
}

/* ---- the filter ------------------------------------------------------------------------------ */

typedef struct state {
  double x[P];  /* mean */
  double s[PP]; /* factor of the covariance, upper triangle by rows of p */
} state;

/* Resets the states of the motion from `first` on to diffuse ones; returns the logarithm of their
 * variances. The correlated errors continue at a break and are reset at a start. */
static double forget(const rot_smooth_nodes *nodes, const process *of, size_t k, int first,
                     state *at) {
  const int p = of->p, n = of->states;
  double mean[P], sd[P], m[2 * PP], log_variance = 0.0;
  start(nodes, p, k, mean, sd);
  if (first == ROT_SMOOTH_STARTS) {
    memset(at->s, 0, sizeof at->s);
    if (n > p) at->x[p] = 0.0, at->s[n * n - 1] = 1.0;
  } else
    for (int r = 0; r < n; r++)
      for (int j = first; j < p; j++) at->s[r * n + j] = 0.0;
  for (int i = first; i < p; i++) {
    at->x[i] = mean[i];
    log_variance += 2.0 * log(sd[i]);
  }
  if (n == p || first == ROT_SMOOTH_STARTS) {
    for (int i = first; i < p; i++) at->s[i * n + i] = sd[i];
    return log_variance;
  }
  memset(m, 0, sizeof m);
  for (int r = 0; r < n; r++)
    for (int j = r; j < n; j++) m[r * n + j] = at->s[r * n + j];
  for (int i = first; i < p; i++) m[(n + i) * n + i] = sd[i];
  triangle(m, 2 * n, n, n);
  for (int r = 0; r < n; r++)
    for (int j = r; j < n; j++) at->s[r * n + j] = m[r * n + j];
  return log_variance;
}

/* state => predicted state over a gap */
static void predict(process *of, double gap, double keep, state *at) {
  const int p = of->states;
  double x[P], m[2 * PP];
  if (!(gap > 0.0)) return;
  process_over(of, gap, keep);
  advance(of, at->x, x);
  memcpy(at->x, x, (size_t)p * sizeof *x);
  for (int r = 0; r < p; r++)
    for (int i = 0; i < p; i++) {
      double sum = 0.0;
      for (int j = i > r ? i : r; j < p; j++) sum += at->s[r * p + j] * of->a[i * p + j];
      m[r * p + i] = sum;
    }
  memcpy(m + p * p, of->q, (size_t)(p * p) * sizeof *m);
  /* triangle() for a lower block that is triangular, too: column c needs rows c to p + c only. */
  for (int c = 0; c < p; c++) {
    const int rows = p + c + 1;
    double square = 0.0;
    for (int r = c + 1; r < rows; r++) square += m[r * p + c] * m[r * p + c];
    if (!(square > 0.0)) continue;
    const double pivot = m[c * p + c];
    const double norm = sqrt(pivot * pivot + square), to = pivot > 0.0 ? -norm : norm;
    const double head = pivot - to, scale = 1.0 / (head * to);
    for (int j = c + 1; j < p; j++) {
      double dot = head * m[c * p + j];
      for (int r = c + 1; r < rows; r++) dot += m[r * p + c] * m[r * p + j];
      dot *= scale;
      m[c * p + j] += dot * head;
      for (int r = c + 1; r < rows; r++) m[r * p + j] += dot * m[r * p + c];
    }
    m[c * p + c] = to;
  }
  for (int r = 0; r < p; r++)
    for (int j = r; j < p; j++) at->s[r * p + j] = m[r * p + j];
}

/* (state, sample y of s.d. w) => updated state, innovation v, its variance f, gain k. R-factor of
 * [[w, 0], [S H', S]] by one rotation for an angle, two for a rate. */
static void update(int p, int channel, double y, double w, state *at, double *v, double *f,
                   double *k) {
  double *s = at->s, row[P];
  *v = y - at->x[channel];
  if (channel == ROT_SMOOTH_ANGLE) {
    const double root = hypot(w, s[0]), shrink = w / root, fraction = s[0] / root;
    *f = root * root;
    for (int j = 0; j < p; j++) {
      k[j] = fraction * s[j] / root;
      s[j] *= shrink;
    }
  } else {
    const double first = hypot(w, s[p + 1]), root = hypot(first, s[1]);
    const double c1 = w / first, s1 = s[p + 1] / first, c2 = first / root, s2 = s[1] / root;
    *f = root * root;
    row[0] = 0.0;
    for (int j = 1; j < p; j++) {
      row[j] = s1 * s[p + j];
      s[p + j] *= c1;
    }
    for (int j = 0; j < p; j++) {
      k[j] = (c2 * row[j] + s2 * s[j]) / root;
      s[j] = c2 * s[j] - s2 * row[j];
    }
  }
  for (int j = 0; j < p; j++) at->x[j] += k[j] * *v;
}

/* The same for a sample whose error has a correlated part: the row [w; S H'] is rotated into S from
 * the last row up, so that S remains triangular. */
static void update_slow(const process *of, int channel, double y, double w, double slow, state *at,
                        double *v, double *f, double *k) {
  const int n = of->states, p = of->p;
  double row[P] = {0.0}, top = w;
  *v = y - at->x[channel] - slow * at->x[p];
  for (int r = n - 1; r >= 0; r--) {
    double *s = at->s + r * n;
    const double along = (r <= channel ? s[channel] : 0.0) + slow * s[p];
    const double root = hypot(top, along);
    if (!(root > 0.0)) continue;
    const double c = top / root, t = along / root;
    for (int j = r; j < n; j++) {
      const double kept = s[j];
      s[j] = c * kept - t * row[j];
      row[j] = c * row[j] + t * kept;
    }
    top = root;
  }
  *f = top * top;
  for (int j = 0; j < n; j++) {
    k[j] = row[j] / top;
    at->x[j] += k[j] * *v;
  }
}

static void store_node(rot_smooth_store *store, int p, size_t k, const state *at) {
  memcpy(store->x + k * (size_t)p, at->x, (size_t)p * sizeof(double));
  double *to = store->s + k * (size_t)(p * p);
  for (int r = 0; r < p; r++)
    for (int j = 0; j < p; j++) to[r * p + j] = j < r ? 0.0 : at->s[r * p + j];
}

/* The last node, to detect a steady state. */
typedef struct steady {
  int repeats; /* nodes in succession with equal gain and variance */
  double gap, keep, slow;
  double f[CHANNELS], k[CHANNELS][P], w[CHANNELS]; /* variance, gain, s.d. of the sample */
  int has[CHANNELS];                               /* 1: a sample in this channel */
} steady;

static int same(double a, double b) { return fabs(a - b) <= settled * fabs(b); }

/* Filters nodes equal to the last one with constant gain and variance; returns the first node that
 * differs. */
static size_t coast(const rot_smooth_nodes *nodes, process *of, const steady *kept, size_t k,
                    size_t to, state *at, rot_smooth_sums *sums) {
  const int p = of->states;
  const size_t begin = k;
  double square[CHANNELS] = {0.0, 0.0};
  process_over(of, kept->gap, kept->keep);
  for (; k < to; k++) {
    double x[P];
    if (nodes->first[k] != ROT_SMOOTH_FLOWS ||
        !(fabs(nodes->gap[k] - kept->gap) <= equal_gap * kept->gap) ||
        !(fabs(keep_at(nodes, k) - kept->keep) <= equal_gap) ||
        !(fabs(slow_at(nodes, nodes->slow_channel, k) - kept->slow) <= 0.0))
      break;
    int repeats = 1;
    for (int c = 0; c < CHANNELS; c++)
      repeats = repeats && has(nodes, c, k) == kept->has[c] &&
                (!kept->has[c] || !(fabs(weight(nodes, c, k) - kept->w[c]) > 0.0));
    if (!repeats) break;
    advance(of, at->x, x);
    for (int c = 0; c < CHANNELS; c++)
      if (kept->has[c]) {
        double v = nodes->y[c][k] - x[c];
        if (p > of->p && c == nodes->slow_channel) v -= kept->slow * x[of->p];
        square[c] += v * v;
        for (int j = 0; j < p; j++) x[j] += kept->k[c][j] * v;
      }
    memcpy(at->x, x, (size_t)p * sizeof *x);
  }
  for (int c = 0; c < CHANNELS; c++)
    if (kept->has[c]) {
      sums->square += square[c] / kept->f[c];
      sums->log_f += (double)(k - begin) * log(kept->f[c]);
      sums->counted += k - begin;
      sums->order_square += square[c] / kept->f[c];
      sums->order_log_f += (double)(k - begin) * log(kept->f[c]);
      sums->order_counted += k - begin;
      sums->samples += k - begin;
    }
  return k;
}

void rot_smooth_filter(const rot_smooth_nodes *nodes, const rot_smooth_model *model, size_t from,
                       size_t to, rot_smooth_store *store, int stores, rot_smooth_sums *sums) {
  const int p = rot_smooth_states(nodes, model->order);
  process of;
  state at;
  const size_t settles = nodes->settles > ROT_SMOOTH_BEHIND ? nodes->settles : ROT_SMOOTH_BEHIND;
  /* Samples of this segment and after its last break; a continued filter counts all of them. */
  size_t seen = ROT_SMOOTH_SKIPPED, behind = settles;
  steady kept = {0, NAN, NAN, NAN, {0.0, 0.0}, {{0.0}}, {0.0, 0.0}, {0, 0}};
  process_begin(&of, model, p);
  memset(&at, 0, sizeof at);
  memset(sums, 0, sizeof *sums);
  if (from > 0) {
    memcpy(at.x, store->x + (from - 1) * (size_t)p, (size_t)p * sizeof(double));
    memcpy(at.s, store->s + (from - 1) * (size_t)(p * p), (size_t)(p * p) * sizeof(double));
  }
  for (size_t k = from; k < to; k++) {
    const int first = k == 0 ? ROT_SMOOTH_STARTS : nodes->first[k];
    if (first == ROT_SMOOTH_FLOWS)
      predict(&of, nodes->gap[k], keep_at(nodes, k), &at);
    else {
      const double log_variance = forget(nodes, &of, k, first, &at);
      if (first == ROT_SMOOTH_STARTS)
        seen = 0, behind = nodes->settles > 0 ? 0 : settles;
      else {
        sums->fresh += first < of.p ? (size_t)(of.p - first) : 0;
        sums->log_f -= log_variance;
        behind = 0;
      }
    }
    int repeats =
        first == ROT_SMOOTH_FLOWS && fabs(nodes->gap[k] - kept.gap) <= equal_gap * kept.gap;
    int any = 0;
    const double keep = keep_at(nodes, k), part = slow_at(nodes, nodes->slow_channel, k);
    repeats = repeats && fabs(keep - kept.keep) <= equal_gap && fabs(part - kept.slow) <= 0.0;
    kept.gap = first == ROT_SMOOTH_FLOWS ? nodes->gap[k] : NAN;
    kept.keep = keep;
    kept.slow = part;
    for (int c = 0; c < CHANNELS; c++) {
      const int present = has(nodes, c, k);
      double v = NAN, f = 0.0, gain[P];
      if (present != kept.has[c]) repeats = 0;
      kept.has[c] = present;
      if (present) {
        const double w = weight(nodes, c, k);
        any = 1;
        if (p > of.p)
          update_slow(&of, c, nodes->y[c][k], w, slow_at(nodes, c, k), &at, &v, &f, gain);
        else
          update(p, c, nodes->y[c][k], w, &at, &v, &f, gain);
        sums->samples++;
        if (seen++ >= ROT_SMOOTH_SKIPPED) {
          sums->log_f += log(f);
          sums->square += v * v / f;
          sums->counted++;
          if (behind >= settles) {
            sums->order_log_f += log(f);
            sums->order_square += v * v / f;
            sums->order_counted++;
          }
        } else {
          sums->first_log_f += log(f);
          sums->first_square += v * v / f;
        }
        behind++;
        repeats = repeats && !(fabs(w - kept.w[c]) > 0.0) && same(f, kept.f[c]);
        for (int j = 0; j < p; j++) repeats = repeats && same(gain[j], kept.k[c][j]);
        kept.f[c] = f;
        kept.w[c] = w;
        memcpy(kept.k[c], gain, sizeof gain);
      } else
        memset(gain, 0, sizeof gain);
      if (stores) {
        store->v[c][k] = v;
        store->f[c][k] = f;
        memcpy(store->k[c] + k * (size_t)p, gain, (size_t)p * sizeof *gain);
      }
    }
    if (stores) store_node(store, p, k, &at);
    kept.repeats = repeats && any ? kept.repeats + 1 : 0;
    if (!stores && kept.repeats >= 2 && seen >= ROT_SMOOTH_SKIPPED && behind >= settles) {
      k = coast(nodes, &of, &kept, k + 1, to, &at, sums) - 1;
      kept.repeats = 0;
    }
  }
}

rot_status rot_smooth_store_new(rot_smooth_store *store, size_t n, int states) {
  const size_t p = (size_t)states, each = p + p * p + CHANNELS * (2 + p);
  double *all = n < ((size_t)-1) / (each * sizeof *all) ? malloc(n * each * sizeof *all) : NULL;
  store->x = all;
  if (!all) return ROT_ENOMEM;
  store->s = all + n * p;
  all = store->s + n * p * p;
  for (int c = 0; c < CHANNELS; c++) {
    store->v[c] = all;
    store->f[c] = all + n;
    store->k[c] = all + 2 * n;
    all += n * (2 + p);
  }
  return ROT_OK;
}

void rot_smooth_store_free(rot_smooth_store *store) {
  free(store->x);
  store->x = NULL;
}

/* ---- backward -------------------------------------------------------------------------------- */

/* The distribution of the state x at node k given the state x+ at k + 1: mean xf + G (x+ - onward),
 * factor of the covariance `left`. */
typedef struct backward {
  double gain[PP];  /* G by rows */
  double left[PP];  /* factor of the covariance given x+ */
  double onward[P]; /* predicted mean at k + 1 */
  int separate;     /* 1: k + 1 starts a segment, x is independent of x+ */
} backward;

/* filtered state at node k => distribution given the state at k + 1 */
static void step_back(process *of, const rot_smooth_nodes *nodes, const rot_smooth_store *store,
                      size_t k, backward *out) {
  const int p = of->states, width = 2 * p, first = nodes->first[k + 1];
  const double *xf = store->x + k * (size_t)p, *sf = store->s + k * (size_t)(p * p);
  double m[2 * P * 2 * P];
  out->separate = first == ROT_SMOOTH_STARTS;
  if (out->separate) return;
  memset(m, 0, (size_t)(width * width) * sizeof *m);
  if (first == ROT_SMOOTH_FLOWS && nodes->gap[k + 1] > 0.0) {
    process_over(of, nodes->gap[k + 1], keep_at(nodes, k + 1));
    advance(of, xf, out->onward);
    for (int r = 0; r < p; r++)
      for (int i = 0; i < p; i++) {
        double sum = 0.0;
        for (int j = i > r ? i : r; j < p; j++) sum += sf[r * p + j] * of->a[i * p + j];
        m[r * width + i] = sum;
        m[r * width + p + i] = sf[r * p + i];
        m[(p + r) * width + i] = of->q[r * p + i];
      }
  } else {
    const int kept = first == ROT_SMOOTH_FLOWS ? of->p : first;
    double mean[P], sd[P];
    if (kept < of->p) start(nodes, of->p, k + 1, mean, sd);
    for (int i = 0; i < p; i++) out->onward[i] = i < kept || i >= of->p ? xf[i] : mean[i];
    for (int r = 0; r < p; r++)
      for (int i = 0; i < p; i++) {
        if (i < kept || i >= of->p)
          m[r * width + i] = sf[r * p + i];
        else if (i == r)
          m[(p + r) * width + i] = sd[i];
        m[r * width + p + i] = sf[r * p + i];
      }
  }
  triangle(m, width, width, width);
  /* Sp G' = X */
  for (int c = 0; c < p; c++)
    for (int r = p - 1; r >= 0; r--) {
      double sum = m[r * width + p + c];
      for (int j = r + 1; j < p; j++) sum -= m[r * width + j] * out->gain[c * p + j];
      const double pivot = m[r * width + r];
      out->gain[c * p + r] = fabs(pivot) > 0.0 ? sum / pivot : 0.0;
    }
  for (int r = 0; r < p; r++)
    for (int j = 0; j < p; j++) out->left[r * p + j] = j < r ? 0.0 : m[(p + r) * width + p + j];
}

/* smoothed state at node k + 1 => at node k */
static void smooth_back(const rot_smooth_store *store, int p, size_t k, const backward *back,
                        state *at) {
  const double *xf = store->x + k * (size_t)p;
  double difference[P], m[2 * PP];
  if (back->separate) {
    memcpy(at->x, xf, (size_t)p * sizeof *xf);
    memcpy(at->s, store->s + k * (size_t)(p * p), (size_t)(p * p) * sizeof *xf);
    return;
  }
  for (int i = 0; i < p; i++) difference[i] = at->x[i] - back->onward[i];
  for (int i = 0; i < p; i++) {
    double sum = 0.0;
    for (int j = 0; j < p; j++) sum += back->gain[i * p + j] * difference[j];
    at->x[i] = xf[i] + sum;
  }
  memcpy(m, back->left, (size_t)(p * p) * sizeof *m);
  for (int r = 0; r < p; r++)
    for (int i = 0; i < p; i++) {
      double sum = 0.0;
      for (int j = r; j < p; j++) sum += at->s[r * p + j] * back->gain[i * p + j];
      m[(p + r) * p + i] = sum;
    }
  triangle(m, 2 * p, p, p);
  for (int r = 0; r < p; r++)
    for (int j = 0; j < p; j++) at->s[r * p + j] = j < r ? 0.0 : m[r * p + j];
}

static double product(const double *s, int rows, int p, int i, int j) {
  double sum = 0.0;
  for (int r = 0; r < rows; r++) sum += s[r * p + i] * s[r * p + j];
  return sum;
}

static void covariances(const state *at, int p, int order, double *to) {
  const int max = order < 3 ? order : 3;
  int c = 0;
  for (int i = 0; i < 3; i++)
    for (int j = i; j < 3; j++, c++) to[c] = j < max ? product(at->s, p, p, i, j) : 0.0;
}

static void last_state(const rot_smooth_store *store, int p, size_t k, state *at) {
  memcpy(at->x, store->x + k * (size_t)p, (size_t)p * sizeof(double));
  memcpy(at->s, store->s + k * (size_t)(p * p), (size_t)(p * p) * sizeof(double));
}

void rot_smooth_smooth(const rot_smooth_nodes *nodes, const rot_smooth_model *model,
                       const rot_smooth_store *store, double *mean, double *covariance) {
  const int p = rot_smooth_states(nodes, model->order);
  const size_t order = (size_t)model->order;
  process of;
  state at;
  process_begin(&of, model, p);
  for (size_t k = nodes->n; k-- > 0;) {
    if (k + 1 == nodes->n)
      last_state(store, p, k, &at);
    else {
      backward back;
      step_back(&of, nodes, store, k, &back);
      smooth_back(store, p, k, &back, &at);
    }
    if (mean) memcpy(mean + k * order, at.x, order * sizeof(double));
    if (covariance) covariances(&at, p, model->order, covariance + 6 * k);
  }
}

void rot_smooth_jumps(const rot_smooth_nodes *nodes, const rot_smooth_model *model,
                      const rot_smooth_store *store, size_t n, rot_smooth_jump jumps[]) {
  const int p = rot_smooth_states(nodes, model->order), order = model->order;
  process of;
  state at;
  process_begin(&of, model, p);
  for (size_t k = nodes->n; k-- > 0;) {
    if (k + 1 == nodes->n) {
      last_state(store, p, k, &at);
      continue;
    }
    backward back;
    const state after = at;
    step_back(&of, nodes, store, k, &back);
    smooth_back(store, p, k, &back, &at);
    for (size_t i = 0; i < n; i++)
      if (jumps[i].node == k + 1 && !back.separate) {
        /* x+ - x = (1 - G) x+ - (x - G x+), with independent terms */
        double m[2 * PP];
        memcpy(m, back.left, (size_t)(p * p) * sizeof *m);
        for (int r = 0; r < p; r++)
          for (int c = 0; c < p; c++) {
            double sum = after.s[r * p + c];
            for (int j = r; j < p; j++) sum -= after.s[r * p + j] * back.gain[c * p + j];
            m[(p + r) * p + c] = sum;
          }
        const int pair[3][2] = {{1, 1}, {1, 2}, {2, 2}};
        for (int c = 0; c < order; c++) {
          jumps[i].mean[c] = after.x[c] - at.x[c];
          jumps[i].after[c] = after.x[c];
        }
        jumps[i].variance_3 = order > 3 ? product(m, 2 * p, p, 3, 3) : NAN;
        for (int c = 0; c < 3; c++) {
          const int known = pair[c][1] < order;
          jumps[i].covariance[c] = known ? product(m, 2 * p, p, pair[c][0], pair[c][1]) : NAN;
          jumps[i].after_covariance[c] =
              known ? product(after.s, p, p, pair[c][0], pair[c][1]) : NAN;
        }
      }
  }
}

/* (r, N) => r' N^-1 r of the states from `first` on, by Cholesky's method in units of the diagonal;
 * NaN for a singular N */
static double shock_of(const double *r, const double *n, int p, int first, int order) {
  double l[PP], z[P], sum = 0.0;
  const int m = order - first;
  for (int i = 0; i < m; i++) {
    const double unit = sqrt(n[(i + first) * p + i + first]);
    double rest = r[i + first] / unit;
    for (int j = 0; j <= i; j++) {
      double entry = n[(i + first) * p + j + first] / (unit * sqrt(n[(j + first) * p + j + first]));
      for (int k = 0; k < j; k++) entry -= l[i * p + k] * l[j * p + k];
      if (i == j && !(entry > 1e-13)) return NAN;
      l[i * p + j] = i == j ? sqrt(entry) : entry / l[j * p + j];
    }
    for (int k = 0; k < i; k++) rest -= l[i * p + k] * z[k];
    z[i] = rest / l[i * p + i];
    sum += z[i] * z[i];
  }
  return sum;
}

void rot_smooth_scores(const rot_smooth_nodes *nodes, const rot_smooth_model *model,
                       const rot_smooth_store *store, double *shock, double *last,
                       double *residual[ROT_SMOOTH_CHANNELS]) {
  const int p = rot_smooth_states(nodes, model->order), order = model->order;
  process of;
  double r[P] = {0.0}, n[PP] = {0.0};
  process_begin(&of, model, p);
  for (size_t k = nodes->n; k-- > 0;) {
    const int first = k + 1 < nodes->n ? nodes->first[k + 1] : ROT_SMOOTH_STARTS;
    if (first == ROT_SMOOTH_FLOWS && nodes->gap[k + 1] > 0.0) { /* r = A'r, N = A'N A */
      double half[PP], to[P];
      process_over(&of, nodes->gap[k + 1], keep_at(nodes, k + 1));
      for (int i = 0; i < p; i++) {
        to[i] = 0.0;
        for (int j = 0; j <= i; j++) to[i] += of.a[j * p + i] * r[j];
        for (int c = 0; c < p; c++) {
          half[c * p + i] = 0.0;
          for (int j = 0; j <= i; j++) half[c * p + i] += n[c * p + j] * of.a[j * p + i];
        }
      }
      memcpy(r, to, (size_t)p * sizeof *to);
      for (int i = 0; i < p; i++)
        for (int c = i; c < p; c++) {
          double sum = 0.0;
          for (int j = 0; j <= i; j++) sum += of.a[j * p + i] * half[j * p + c];
          n[i * p + c] = n[c * p + i] = sum;
        }
    } else if (first != ROT_SMOOTH_FLOWS)
      for (int i = first; i < (first == ROT_SMOOTH_STARTS ? p : order); i++) {
        r[i] = 0.0;
        for (int j = 0; j < p; j++) n[i * p + j] = n[j * p + i] = 0.0;
      }
    for (int c = CHANNELS; c-- > 0;) {
      const double f = store->f[c][k];
      if (residual && residual[c]) residual[c][k] = NAN;
      if (!(f > 0.0)) continue;
      const double *gain = store->k[c] + k * (size_t)p;
      double u = store->v[c][k] / f, d = 1.0 / f, along[P];
      for (int j = 0; j < p; j++) {
        along[j] = 0.0;
        for (int i = 0; i < p; i++) along[j] += gain[i] * n[i * p + j];
        u -= gain[j] * r[j];
      }
      for (int j = 0; j < p; j++) d += along[j] * gain[j];
      r[c] += u;
      for (int j = 0; j < p; j++)
        if (j != c) n[c * p + j] = n[j * p + c] = n[c * p + j] - along[j];
      n[c * p + c] += d - 2.0 * along[c];
      const double part = slow_at(nodes, c, k);
      if (part > 0.0) { /* H has two entries: 1 at c, `part` at the last state */
        const int e = p - 1;
        r[e] += part * u;
        for (int j = 0; j < e; j++) n[e * p + j] -= part * along[j];
        n[e * p + e] += part * (part * d - 2.0 * along[e]);
        n[e * p + c] += part * d;
        for (int j = 0; j < e; j++) n[j * p + e] = n[e * p + j];
      }
      if (residual && residual[c]) residual[c][k] = u / sqrt(d);
    }
    if (shock) shock[k] = shock_of(r, n, p, 1, order);
    if (last) last[k] = shock_of(r, n, p, order - 1, order);
  }
}

rot_status rot_smooth_draw(const rot_smooth_nodes *nodes, const rot_smooth_model *model,
                           const rot_smooth_store *store, double sigma, size_t n_at,
                           const size_t at[], size_t n_draws, unsigned long seed,
                           const rot_hooks *hooks, double *draws) {
  const int p = rot_smooth_states(nodes, model->order);
  const size_t each = (size_t)p, order = (size_t)model->order;
  process of;
  rot_status status = ROT_OK;
  gsl_rng *rng = gsl_rng_alloc(gsl_rng_mt19937);
  double *now = malloc((n_draws * each + 1) * sizeof *now);
  if (!rng || !now)
    status = ROT_ENOMEM;
  else
    gsl_rng_set(rng, seed);
  process_begin(&of, model, p);
  for (size_t k = nodes->n, i = n_at; status == ROT_OK && i > 0 && k-- > 0;) {
    backward back;
    back.separate = 1;
    if (k + 1 < nodes->n) step_back(&of, nodes, store, k, &back);
    const double *xf = store->x + k * each;
    const double *factor = back.separate ? store->s + k * each * each : back.left;
    for (size_t d = 0; d < n_draws; d++) {
      double *x = now + d * each, z[P], to[P];
      for (int r = 0; r < p; r++) z[r] = sigma * gsl_ran_gaussian_ziggurat(rng, 1.0);
      for (int c = 0; c < p; c++) {
        double sum = xf[c];
        for (int r = 0; r <= c; r++) sum += factor[r * p + c] * z[r];
        if (!back.separate)
          for (int j = 0; j < p; j++) sum += back.gain[c * p + j] * (x[j] - back.onward[j]);
        to[c] = sum;
      }
      memcpy(x, to, each * sizeof *x);
    }
    if (at[i - 1] == k) {
      i--;
      for (size_t d = 0; d < n_draws; d++)
        memcpy(draws + (d * n_at + i) * order, now + d * each, order * sizeof *now);
    }
    if (k % 64 == 0) status = rot_poll(hooks, 1.0 - (double)k / (double)nodes->n);
  }
  gsl_rng_free(rng);
  free(now);
  return status;
}
