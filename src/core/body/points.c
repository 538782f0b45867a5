#include "body/points.h"

#include <float.h>

#include "body/inertia.h"
#include "ground/real.h"

/* Masses of one band differ by a factor of at most 2^300, so that terms that underflow are
 * negligible compared with the farthest point of the band. Usually there is one band. */
#define BAND_BITS    300
/* Limit of the exponents, so that the powers of two are doubles. */
#define MAX_EXPONENT 1000
/* Points between two polls: some milliseconds. */
#define POLL_POINTS  65536

size_t rot_points_bad(const rot_points *points, int *column) {
  for (size_t i = 0; i < points->n; i++) {
    const double m = rot_at(points->mass, i);
    *column = 0;
    if (!(m >= 0.0 && m <= DBL_MAX)) return i;
    for (int k = 0; k < 3; k++) {
      *column = k + 1;
      if (!isfinite(rot_at(points->x[k], i))) return i;
    }
  }
  return points->n;
}

/* ---- one band ------------------------------------------------------------------------------- */

typedef struct band {
  double above, upto;                        /* masses in (above, upto] */
  int mass_bits, length_bits;                /* sums are of m 2^-mass_bits and x 2^-length_bits */
  double ref[3];                             /* origin of the sums, unscaled */
  double count;                              /* points */
  double mass[2], first[3][2], second[6][2]; /* sums and their low parts */
} band;

static int exponent_of(double x) {
  int e = 0;
  (void)frexp(x, &e);
  if (e > MAX_EXPONENT) return MAX_EXPONENT;
  return e < -MAX_EXPONENT ? -MAX_EXPONENT : e;
}

static int in_band(const band *b, double m) { return m > b->above && m <= b->upto; }

/* band => count, origin at the centre of its bounding box, scale of lengths */
static rot_status find_box(const rot_points *points, band *b) {
  double low[3], high[3], size = 0.0;
  b->count = 0.0;
  for (int k = 0; k < 3; k++) {
    low[k] = DBL_MAX;
    high[k] = -DBL_MAX;
  }
  for (size_t i = 0; i < points->n; i++) {
    if (!in_band(b, rot_at(points->mass, i))) continue;
    b->count += 1.0;
    for (int k = 0; k < 3; k++) {
      const double x = rot_at(points->x[k], i);
      if (x < low[k]) low[k] = x;
      if (x > high[k]) high[k] = x;
    }
  }
  if (!(b->count > 0.0)) return ROT_OK;
  for (int k = 0; k < 3; k++) {
    const double span = high[k] - low[k];
    if (!(span <= DBL_MAX)) return ROT_ERANGE;
    if (span > size) size = span;
    b->ref[k] = low[k] + 0.5 * span;
  }
  b->length_bits = exponent_of(size);
  return ROT_OK;
}

static void clear_sums(band *b) {
  for (int j = 0; j < 2; j++) {
    b->mass[j] = 0.0;
    for (int k = 0; k < 3; k++) b->first[k][j] = 0.0;
    for (int k = 0; k < 6; k++) b->second[k][j] = 0.0;
  }
}

static void close_sum(double sum[2]) {
  const double hi = sum[0] + sum[1];
  sum[1] += sum[0] - hi;
  sum[0] = hi;
}

/* band => sums about b->ref */
static rot_status add_up(const rot_points *points, const rot_hooks *hooks, band *b) {
  const double to_length = ldexp(1.0, -b->length_bits), to_mass = ldexp(1.0, -b->mass_bits);
  clear_sums(b);
  for (size_t i = 0; i < points->n; i++) {
    if (i % POLL_POINTS == POLL_POINTS - 1) {
      const rot_status status = rot_poll(hooks, (double)i / (double)points->n);
      if (status != ROT_OK) return status;
    }
    double m = rot_at(points->mass, i), d[3], md[3];
    if (!in_band(b, m)) continue;
    m *= to_mass;
    rot_accumulate(&b->mass[0], &b->mass[1], m);
    for (int k = 0; k < 3; k++) {
      d[k] = (rot_at(points->x[k], i) - b->ref[k]) * to_length;
      md[k] = m * d[k];
      rot_accumulate(&b->first[k][0], &b->first[k][1], md[k]);
    }
    for (int k = 0; k < 6; k++) {
      rot_accumulate(&b->second[k][0], &b->second[k][1],
                     md[rot_tensor_row[k]] * d[rot_tensor_column[k]]);
    }
  }
  close_sum(b->mass);
  for (int k = 0; k < 3; k++) close_sum(b->first[k]);
  for (int k = 0; k < 6; k++) close_sum(b->second[k]);
  return ROT_OK;
}

static double trace_of(const double c[6]) { return c[0] + c[1] + c[2]; }

/* Moves the origin of the sums to a double next to their centre, unless the offset contributes less
 * than a sixteenth of the trace. Returns 1 if it moved. */
static int step_to_centre(band *b) {
  const double trace = b->second[0][0] + b->second[1][0] + b->second[2][0];
  double h[3], left = 0.0;
  int moved = 0;
  for (int k = 0; k < 3; k++) {
    h[k] = b->first[k][0] / b->mass[0];
    left += h[k] * b->first[k][0];
  }
  if (!(left > trace / 16.0)) return 0;
  for (int k = 0; k < 3; k++) {
    const double next = b->ref[k] + ldexp(h[k], b->length_bits);
    if (next < b->ref[k] || next > b->ref[k]) moved = 1;
    b->ref[k] = next;
  }
  return moved;
}

/* Repeats the sums until the origin is next to the centre: usually once, more often if most of the
 * mass is in a region below the rounding of the box. Each pass resolves 1e-16 of the size. */
static rot_status settle(const rot_points *points, const rot_hooks *hooks, band *b) {
  for (int turn = 0;; turn++) {
    const rot_status status = add_up(points, hooks, b);
    if (status != ROT_OK) return status;
    if (turn == 40 || !step_to_centre(b)) return ROT_OK;
  }
}

/* sums of a band => moments and error bounds */
static void finish(const band *b, int mass_exponent, rot_moments *out) {
  const double m = b->mass[0];
  const double sums = ROT_EPS + 2.0 * (b->count * ROT_EPS) * (b->count * ROT_EPS);
  double h[3], h_max = 0.0, a_max = 0.0, c[6];
  for (int k = 0; k < 3; k++) {
    h[k] = b->first[k][0] / m;
    h_max = fmax(h_max, fabs(h[k]));
    a_max = fmax(a_max, b->second[k][0]);
    out->centre[k] = rot_two_sum(b->ref[k], ldexp(h[k], b->length_bits), &out->centre_lo[k]);
  }
  for (int k = 0; k < 6; k++) {
    const double left = b->first[rot_tensor_row[k]][0] * h[rot_tensor_column[k]];
    c[k] = (b->second[k][0] - left) + b->second[k][1];
    if (k < 3 && c[k] < 0.0) c[k] = 0.0;
    out->c[k] = ldexp(c[k], b->mass_bits + mass_exponent + 2 * b->length_bits);
  }
  out->mass = ldexp(m, b->mass_bits + mass_exponent);
  out->mass_error = sums;
  const double trace = trace_of(c), kept = trace_of(out->c);
  out->vanished = out->mass < DBL_MIN || (trace > 0.0 && kept < DBL_MIN);
  /* Roundings: four of a term m d d, two of a term m d; |sum m d| <= sqrt(M A). */
  const double first_error = (2.0 * ROT_EPS + sums) * sqrt(m * a_max);
  const double off = (4.0 * ROT_EPS + sums) * a_max + 2.0 * h_max * first_error +
                     4.0 * ROT_EPS * m * h_max * h_max + ROT_EPS * a_max;
  out->error = 0.0;
  if (a_max > 0.0) out->error = off / trace + (kept > 0.0 ? 0x1p-1074 / kept : 0.0);
  out->centre_error = ldexp(first_error / m + 4.0 * ROT_EPS * h_max, b->length_bits) + 0x1p-1074;
  if (!(a_max > 0.0)) out->centre_error = 0.0;
}

/* ---- all bands ------------------------------------------------------------------------------ */

/* Massless points => zero moments, centre at the unweighted mean */
static rot_status mean_of(const rot_points *points, const rot_hooks *hooks, rot_moments *out) {
  static const double one = 1.0;
  rot_points equal = *points;
  equal.mass = (rot_column){&one, 0};
  equal.mass_exponent = 0;
  const rot_status status = rot_points_moments(&equal, hooks, out);
  out->mass = out->mass_error = out->error = 0.0;
  for (int k = 0; k < 6; k++) out->c[k] = 0.0;
  out->vanished = 0;
  return status;
}

rot_status rot_points_moments(const rot_points *points, const rot_hooks *hooks, rot_moments *out) {
  double min = DBL_MAX, max = 0.0;
  const rot_moments none = {0};
  *out = none;
  for (size_t i = 0; i < points->n; i++) {
    const double m = rot_at(points->mass, i);
    if (m > 0.0 && m < min) min = m;
    if (m > max) max = m;
  }
  if (points->n == 0) return ROT_OK;
  if (!(max > 0.0)) return mean_of(points, hooks, out);
  for (double upto = max; upto >= min; upto = ldexp(upto, -BAND_BITS)) {
    band b = {.above = ldexp(upto, -BAND_BITS), .upto = upto, .mass_bits = exponent_of(upto)};
    rot_moments here = none, sum = *out;
    rot_status status = find_box(points, &b);
    if (status == ROT_OK && b.count > 0.0) {
      status = settle(points, hooks, &b);
      if (status == ROT_OK) finish(&b, points->mass_exponent, &here);
    }
    if (status != ROT_OK) return status;
    if (b.count > 0.0) rot_moments_join(&sum, &here, out);
    if (!(b.above > 0.0)) break;
  }
  return ROT_OK;
}

/* C = C_a + C_b + m d d', m the reduced mass, d from one centre to the other. */
void rot_moments_join(const rot_moments *a, const rot_moments *b, rot_moments *out) {
  if (!(a->mass > 0.0) || !(b->mass > 0.0)) {
    const int vanished = a->vanished | b->vanished;
    *out = b->mass > 0.0 || !(a->mass > 0.0) ? *b : *a;
    out->vanished = vanished;
    return;
  }
  const rot_moments p = *a, q = *b; /* copies: out may be a or b */
  const double fraction = 1.0 / (1.0 + p.mass / q.mass);
  const double less = fmin(p.mass, q.mass), reduced = less / (1.0 + less / fmax(p.mass, q.mass));
  double d[3], d_max = 0.0;
  for (int k = 0; k < 3; k++) {
    double lo, step_lo, step;
    d[k] = rot_two_sum(q.centre[k], -p.centre[k], &lo);
    lo += q.centre_lo[k] - p.centre_lo[k];
    d[k] += lo;
    d_max = fmax(d_max, fabs(d[k]));
    step = rot_two_sum(p.centre[k], fraction * d[k], &step_lo);
    out->centre[k] = rot_two_sum(step, step_lo + p.centre_lo[k], &out->centre_lo[k]);
  }
  for (int k = 0; k < 6; k++) {
    const double x[3] = {reduced, d[rot_tensor_row[k]], d[rot_tensor_column[k]]};
    out->c[k] = p.c[k] + q.c[k] + rot_product(3, x, 1.0);
  }
  const double trace = trace_of(out->c);
  /* Points at different places have a moment, even if it underflows. */
  out->vanished = p.vanished | q.vanished | (d_max > 0.0 && trace < DBL_MIN);
  out->mass = p.mass + q.mass;
  out->mass_error = fmax(p.mass_error, q.mass_error) + ROT_EPS;
  const double slip = p.centre_error + q.centre_error;
  out->centre_error = fmax(p.centre_error, q.centre_error) + 4.0 * ROT_EPS * fraction * d_max;
  if (!(trace > 0.0)) {
    out->error = 0.0;
    return;
  }
  const double separation[3] = {reduced, d_max, d_max}, slipped[3] = {reduced, 2.0 * d_max, slip};
  out->error = p.error * (trace_of(p.c) / trace) + q.error * (trace_of(q.c) / trace) +
               (12.0 * ROT_EPS + p.mass_error + q.mass_error) * rot_product(3, separation, trace) +
               rot_product(3, slipped, trace) + 2.0 * ROT_EPS;
}

rot_status rot_moments_check(const rot_moments *moments) {
  const double trace = trace_of(moments->c);
  if (!(moments->mass <= DBL_MAX) || !(trace <= DBL_MAX)) return ROT_ERANGE;
  const int small = moments->mass < DBL_MIN || trace < DBL_MIN;
  return moments->vanished && small ? ROT_ERANGE : ROT_OK;
}

double rot_points_reach(const rot_points *points, const rot_moments *moments) {
  double max = 0.0;
  for (size_t i = 0; i < points->n; i++) {
    double r = 0.0;
    for (int k = 0; k < 3; k++) {
      r = hypot(r, rot_at(points->x[k], i) - moments->centre[k] - moments->centre_lo[k]);
    }
    if (!(r <= max)) max = r;
  }
  return max * (1.0 + 8.0 * ROT_EPS) + moments->centre_error;
}
