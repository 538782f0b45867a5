#include "tables/rolling.h"

#include <math.h>

#include "ground/pair.h"
#include "ground/real.h"

enum { BLOCK = 1024, BLOCKS_PER_POLL = 64 };

/* (beta, fraction = 1/(1 + beta)) => rotational fraction; the limit for beta = +Inf. `fraction` is
 * shared by three of the four columns, which saves a division each (6 to 4 ns a row) and costs half
 * an ulp. */
static inline double rotational_fraction(double beta, double fraction) {
  return isinf(beta) ? 1.0 : beta * fraction;
}

/* => final speed where 2 g h/(1 + beta) over- or underflows: its power of two is separate */
static double scaled_final_speed(double beta, double height_m, double gravity) {
  if (!(isfinite(beta) && isfinite(height_m) && isfinite(gravity))) {
    return sqrt(2.0 * height_m) * (sqrt(gravity) / sqrt(1.0 + beta));
  }
  int e;
  const double p = rot_product_split(2, (double[]){height_m, gravity}, 1.0 + beta, &e);
  const int odd = (e + 1) & 1;
  return ldexp(sqrt(ldexp(p, odd)), (e + 1 - odd) / 2);
}

static int needs_scaling(double twice_g_h) { return !(twice_g_h > 1e-290 && twice_g_h < 1e290); }

/* 1 if the square of the speed may be subnormal, for large beta. */
static int lost(double twice_g_h, double speed) { return speed < 1e-145 && twice_g_h > 0.0; }

double rot_rolling_acceleration(double beta, double angle_deg, double gravity) {
  return gravity * rot_sin_deg(angle_deg) / (1.0 + beta);
}

double rot_rolling_final_speed(double beta, double height_m, double gravity) {
  const double twice_g_h = 2.0 * gravity * height_m;
  const double speed = sqrt(twice_g_h * (1.0 / (1.0 + beta)));
  return needs_scaling(twice_g_h) || lost(twice_g_h, speed)
             ? scaled_final_speed(beta, height_m, gravity)
             : speed;
}

double rot_rolling_rotational_fraction(double beta) {
  return rotational_fraction(beta, 1.0 / (1.0 + beta));
}

double rot_rolling_translational_fraction(double beta) { return 1.0 / (1.0 + beta); }

double rot_rolling_friction(double beta, double angle_deg) {
  /* No rotational inertia: no friction at any angle, also at 90 degrees. */
  if (beta == 0.0 && !isnan(angle_deg)) return 0.0;
  return fabs(rot_sin_deg(angle_deg)) / fabs(rot_cos_deg(angle_deg)) *
         rot_rolling_rotational_fraction(beta);
}

/* Terms without beta of the rows of a block; computed once if angle, height and gravity are
 * constants. */
typedef struct block {
  double pull[BLOCK];      /* g sin(angle) */
  double twice_g_h[BLOCK]; /* 2 g h */
  int any_scaled;          /* 1: needs_scaling() for a row */
} block;

static void fill_block(block *to, size_t first, size_t rows, const rot_rolling_input *in) {
  const int same_pull = !in->angle_deg.step && !in->gravity.step;
  to->any_scaled = 0;
  for (size_t i = 0; i < rows; i++) {
    const double g = rot_at(in->gravity, first + i);
    to->pull[i] = same_pull && i ? to->pull[0] : g * rot_sin_deg(rot_at(in->angle_deg, first + i));
    to->twice_g_h[i] = 2.0 * g * rot_at(in->height_m, first + i);
    to->any_scaled |= needs_scaling(to->twice_g_h[i]);
  }
}

/* terms => output rows first .. first + rows - 1; a second pass for those that need scaling */
static void one_block(const block *terms, size_t first, size_t rows, const rot_rolling_input *in,
                      const rot_rolling_output *out) {
  double repeated[BLOCK];
  const double *beta = in->beta.values + first * in->beta.step;
  if (!in->beta.step) {
    for (size_t i = 0; i < rows; i++) repeated[i] = in->beta.values[0];
    beta = repeated;
  }
  double *acceleration = out->acceleration + first, *speed = out->final_speed + first;
  double *rotational = out->rotational_fraction + first;
  double *translational = out->translational_fraction + first;
  size_t i = 0;
  for (; i + ROT_PAIR <= rows; i += ROT_PAIR) {
    const rot_pair b = rot_load(beta + i), d = ROT_BOTH(1.0) + b, fraction = ROT_BOTH(1.0) / d;
    rot_store(acceleration + i, rot_load(terms->pull + i) / d);
    rot_store(speed + i, rot_pair_sqrt(rot_load(terms->twice_g_h + i) * fraction));
    rot_store(rotational + i, b * fraction);
    rot_store(translational + i, fraction);
  }
  for (; i < rows; i++) {
    const double d = 1.0 + beta[i], fraction = 1.0 / d;
    acceleration[i] = terms->pull[i] / d;
    speed[i] = sqrt(terms->twice_g_h[i] * fraction);
    rotational[i] = beta[i] * fraction;
    translational[i] = fraction;
  }
  for (i = 0; i < rows; i++) {
    if (rotational[i] != rotational[i]) rotational[i] = rotational_fraction(beta[i], 0.0);
  }
  int any_lost = terms->any_scaled;
  for (i = 0; i < rows; i++) any_lost |= speed[i] < 1e-145;
  for (i = 0; any_lost && i < rows; i++) {
    if (needs_scaling(terms->twice_g_h[i]) || lost(terms->twice_g_h[i], speed[i])) {
      speed[i] = scaled_final_speed(beta[i], rot_at(in->height_m, first + i),
                                    rot_at(in->gravity, first + i));
    }
  }
}

rot_status rot_rolling_table(size_t n, const rot_rolling_input *in, const rot_rolling_output *out,
                             const rot_hooks *hooks, rot_info *info) {
  const int same = !in->angle_deg.step && !in->gravity.step && !in->height_m.step;
  block terms;
  rot_info_clear(info, NULL);
  for (size_t first = 0; first < n; first += BLOCK) {
    const size_t rows = n - first < BLOCK ? n - first : BLOCK;
    if (!same || first == 0) fill_block(&terms, first, rows, in);
    one_block(&terms, first, rows, in, out);
    info->rows_done = first + rows;
    if (++info->steps % BLOCKS_PER_POLL == 0) {
      info->status = rot_poll(hooks, (double)info->rows_done / (double)n);
      if (info->status != ROT_OK) break;
    }
  }
  return info->status;
}

size_t rot_rolling_first_outside(rot_column column, size_t n, double lo, double hi) {
  const size_t rows = column.step ? n : n > 0;
  for (size_t first = 0; first < rows; first += BLOCK) {
    const size_t end = rows - first < BLOCK ? rows : first + BLOCK;
    int any = 0;
    for (size_t i = first; i < end; i++) any |= column.values[i] < lo || column.values[i] > hi;
    for (size_t i = first; any && i < end; i++) {
      if (column.values[i] < lo || column.values[i] > hi) return i;
    }
  }
  return n;
}
