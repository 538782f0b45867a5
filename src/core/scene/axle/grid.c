#include "scene/axle/grid.h"

#include <math.h>

#include "scene/axle/grid_fill.h"
#include "ground/real.h"
#include "ground/simd.h"

/* With l = c/I, A the acceleration at the start and b the slope of the torque over I,
 *
 *   omega = omega0 + A s + g E2(s),   theta = theta0 + omega0 s + A s^2/2 + g E3(s),   g = b - l A,
 *
 * E1 = (1 - exp(-l s))/l and its integrals E2 = (s - E1)/l = s^2 phi2, E3 = s^3 phi3. The terms
 * added to the state are small relative to it or of one sign: no cancellation up to l s = 1/2. */
#define NEAR 0.5

/* ---- one short step ------------------------------------------------------------------------- */

/* Number of terms of the series, even. */
static int terms_for(double z) {
  return z <= 0.01 ? 6 : z <= 0.06 ? 8 : z <= 0.39 ? 12 : ROT_GRID_TERMS;
}

typedef rot_axle_law law;
typedef rot_axle_departure departure;

void rot_axle_grid_begin(rot_axle_grid *grid) { grid->step_s = 0.0; }

void rot_axle_grid_enter(rot_axle_grid *grid, const rot_axle_params *p,
                         const rot_torque_piece *piece) {
  const double I = p->inertia_kg_m2, a = piece->start_n_m, b = piece->end_n_m;
  law k = {I, p->viscous_n_m_s, p->viscous_n_m_s / I, 0.0, 0.0, b, 0.0, 0.0, a * b < 0.0};
  if (a != b) {
    const double span = piece->end_s - piece->start_s;
    k.slope = (b - a) / span / I;
    k.a = a / span;
    k.b = b / span;
    k.start_s = piece->start_s;
    k.end_s = piece->end_s;
  }
  grid->law = k;
}

static departure depart(const law *k, const rot_axle_state *from) {
  const double t = from->time_s;
  departure go;
  go.torque = k->slope != 0.0 ? k->a * (k->end_s - t) + k->b * (t - k->start_s) : k->b;
  go.acceleration = (go.torque - k->c * from->omega_rad_per_s) / k->I;
  go.bend = k->slope - k->lambda * go.acceleration;
  return go;
}

/* Rounding of omega in a step. Errors in units: A 2 plus those of its terms, E2 4.5, E3 6. Hence
 * the term of A 6 + 6 z, of omega0 (2 + z) z; a sloping torque 5, its slope 4. Rounding of theta:
 * at most 2/3 of that times s, plus 4 units of omega0 s. */
static double step_rounding(const law *k, const rot_axle_state *from, const departure *go,
                            double s) {
  const double z = k->lambda * s;
  double sum =
      (6.0 + 6.0 * z) * fabs(go->acceleration) * s + (2.0 + z) * z * fabs(from->omega_rad_per_s);
  if (k->slope != 0.0) {
    sum += (5.0 + 3.0 * z) * fabs(go->torque) * s / k->I + 6.5 * fabs(k->slope) * s * s;
  }
  return ROT_EPS * sum;
}

/* (state, step with its E2 and E3) => state at the end of the step. */
static rot_axle_state arrive(const law *k, const rot_axle_state *from, const departure *go,
                             double rounding, double time_s, double s, double e2, double e3) {
  const double w0 = from->omega_rad_per_s, A = go->acceleration, z = k->lambda * s;
  const double gained = A * s + go->bend * e2;
  const double turned = s * (w0 + 0.5 * A * s) + go->bend * e3;
  rot_axle_state to;
  double lo;
  to.time_s = time_s;
  to.omega_rad_per_s = rot_two_sum(w0, gained + from->omega_lo, &to.omega_lo);
  to.theta_rad = rot_two_sum(from->theta_rad, turned, &lo);
  lo += from->theta_lo + s * from->omega_lo;
  to.theta_rad = rot_two_sum(to.theta_rad, lo, &to.theta_lo);
  to.omega_error = from->omega_error * (1.0 - z + 0.5 * z * z) + rounding;
  to.theta_error = from->theta_error +
                   s * (from->omega_error + 2.0 / 3.0 * rounding + 4.0 * ROT_EPS * fabs(w0)) +
                   2.0 * ROT_EPS * ROT_EPS * fabs(to.theta_rad);
  return to;
}

rot_axle_state rot_axle_grid_step(const rot_axle_grid *grid, const rot_axle_params *p,
                                  const rot_axle_state *from, const rot_torque_piece *piece,
                                  double time_s) {
  const law *k = &grid->law;
  const double s = time_s - from->time_s;
  if (k->two_signs || !(k->lambda * s <= NEAR) || !(s > 1e-60)) { /* or too short a step */
    return rot_axle_step(p, from, piece, time_s);
  }
  const departure go = depart(k, from);
  rot_pair e3, e2 = short_integrals(k->lambda, ROT_BOTH(s), terms_for(k->lambda * s), &e3);
  return arrive(k, from, &go, step_rounding(k, from, &go, s), time_s, s, rot_first(e2),
                rot_first(e3));
}

/* ---- the table ------------------------------------------------------------------------------ */

/* Length of the longest chunk with c s/I <= 1/2; 0: too short to be worthwhile. */
static size_t chunk_rows(double z) {
  size_t rows = ROT_GRID_ROWS;
  while (rows >= 8 && !((double)rows * z <= NEAR)) rows /= 2;
  return rows >= 8 ? rows : 0;
}

static int make_table(rot_axle_grid *grid, const rot_axle_params *p, double step_s) {
  const double lambda = p->viscous_n_m_s / p->inertia_kg_m2;
  const size_t rows = chunk_rows(lambda * step_s);
  if (rows == 0) return 0; /* keep the old table */
  grid->rows = rows;
  grid->step_s = step_s;
  const int terms = terms_for(lambda * step_s * (double)grid->rows);
  for (size_t j = 0; j <= grid->rows; j++) grid->s[j] = (double)j * step_s;
  if (rot_simd_ok())
    rot_axle_grid_table_simd(grid, lambda, terms);
  else
    fill_table(grid, lambda, terms);
  return 1;
}

/* ---- rows ----------------------------------------------------------------------------------- */

static int fill(const rot_axle_grid *grid, const rot_axle_state *from, const departure *go,
                size_t n, const double time_s[], const rot_axle_columns *out) {
  return n >= ROT_SIMD_PAIR && rot_simd_ok()
             ? rot_axle_grid_fill_simd(grid, from, go, n, time_s, out)
             : fill_chunk(grid, from, go, n, time_s, out);
}

static double larger(double x, double y) { return x > y ? x : y; } /* fmax() is a call */

/* Sizes and bounds of the rows of a chunk. omega and theta are monotonic between its ends if
 * acceleration and omega do not change their signs; else all rows are compared. */
static void note_chunk(const rot_axle_grid *grid, const rot_axle_state *from, const departure *go,
                       double rounding, size_t n, const rot_axle_columns *out, rot_info *info) {
  const double s = grid->s[n - 1], A = go->acceleration, w0 = from->omega_rad_per_s;
  const double w1 = out->omega_rad_per_s[n - 1];
  double omega = larger(fabs(w0), fabs(w1));
  double theta = larger(fabs(from->theta_rad), fabs(out->theta_rad[n - 1]));
  if (!(A * (A + go->bend * grid->once[n - 1]) >= 0.0 && w0 * w1 >= 0.0)) {
    for (size_t j = 0; j < n; j++) {
      omega = larger(omega, fabs(out->omega_rad_per_s[j]));
      theta = larger(theta, fabs(out->theta_rad[j]));
    }
  }
  rot_note_row(info, theta, omega,
               from->theta_error +
                   s * (from->omega_error + 2.0 / 3.0 * rounding + 5.0 * ROT_EPS * fabs(w0)) +
                   ROT_EPS * (theta + fabs(from->theta_rad)),
               from->omega_error + rounding + ROT_EPS * (omega + fabs(w0)));
}

/* Number of rows on the grid, from the first on. */
static size_t even_rows(const rot_axle_grid *grid, size_t n, const double time_s[]) {
  size_t j = 1;
  while (j < n && fabs((time_s[j] - time_s[0]) - grid->s[j]) <= ROT_GRID_UNEVEN * grid->step_s) j++;
  return j;
}

/* Table for the first rows; the old one if its step is equal. */
static int find_table(rot_axle_grid *grid, const rot_axle_params *p, const double time_s[]) {
  const double step_s = (time_s[ROT_GRID_MIN - 1] - time_s[0]) / (ROT_GRID_MIN - 1);
  return fabs(step_s - grid->step_s) <= ROT_GRID_UNEVEN / ROT_GRID_ROWS * step_s ||
         make_table(grid, p, step_s);
}

/* Chunk by chunk: next base, rows, sizes. */
size_t rot_axle_grid_rows(rot_axle_grid *grid, const rot_axle_params *p, rot_axle_state *base,
                          const rot_torque_piece *piece, size_t n, const double time_s[],
                          const rot_axle_columns *out, rot_info *info) {
  const law *k = &grid->law;
  if (n < ROT_GRID_MIN || k->two_signs || !find_table(grid, p, time_s)) return 0;

  rot_axle_state at = rot_axle_grid_step(grid, p, base, piece, time_s[0]);
  /* All chunks have one length, independent of the alignment of the columns: bits must not depend
   * on an address. */
  const size_t chunk_rows = grid->rows;
  size_t done = 0;
  for (;;) {
    const size_t left = n - done, rows = left < chunk_rows ? left : chunk_rows;
    const rot_axle_columns to = rot_axle_columns_from(out, done);
    const departure go = depart(k, &at);
    const double rounding = step_rounding(k, &at, &go, grid->s[rows]);
    /* The next state first: the rows are independent of this chain of sums. */
    rot_axle_state next = at;
    int more = 0;
    if (rows < left) {
      const double t = time_s[done + rows], s = t - at.time_s, off = s - grid->s[rows];
      const double e2 = grid->twice[rows] + off * grid->once[rows];
      const double e3 = grid->thrice[rows] + off * grid->twice[rows];
      more = fabs(off) <= ROT_GRID_UNEVEN * grid->step_s;
      next = arrive(k, &at, &go, rounding, t, s, e2, e3);
    }
    size_t good = rows;
    if (left < 2) {
      rot_axle_row(p, &to, 0, at.theta_rad, at.omega_rad_per_s, go.torque);
    } else if (!fill(grid, &at, &go, rows, time_s + done, &to)) {
      good = even_rows(grid, rows, time_s + done);
      if (done + good < 8) return 0;
    }
    note_chunk(grid, &at, &go, rounding, good, &to, info);
    *base = at;
    done += good;
    if (good < rows || !more) return done;
    at = next;
  }
}
