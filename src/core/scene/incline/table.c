#include "scene/incline/table.h"

#include <math.h>

#include "scene/incline/incline.h"
#include "ground/real.h"
#include "ground/parallel.h"

/* Rows between two polls: some ms. */
enum { PART = 2048 };

/* Kind of motion of a row. Without rolling resistance it has at most two segments. */
typedef enum kind {
  ROLLS,
  LETS_GO,    /* slip 0 at the start, breakaway exceeded: slips permanently */
  SLIPS,      /* slips until the end */
  CATCHES,    /* slips, then rolls */
  SLIPS_BACK, /* slips, then slips in the opposite direction */
  OTHER,      /* rolling resistance, or numbers out of range: rot_incline_to() */
  KINDS
} kind;

/* A row: its scene, forces per kg, the first slip segment. */
typedef struct row {
  double beta, radius, mass, angle, gravity, mu_static, mu_kinetic, arm;
  double v0, w0, omega0, time;    /* w0 = R omega0 */
  double sine, cosine;            /* of the angle */
  double pull, slides, breakaway; /* as in rot_incline_contact */
  double slip, direction;         /* v0 - w0, its sign */
  double rim;                     /* |rate of w| while slipping */
  double rate, inverse;           /* of the slip; 1/|rate| */
  double slip_s;                  /* time at which the slip reaches 0 */
} row;

static inline double larger(double x, double y) { return x > y ? x : y; } /* fmax() is a call */

static inline double sign(double x) { return (double)((x > 0.0) - (x < 0.0)); }

/* A path and its speed, with their errors in units of ROT_EPS. */
typedef struct mover {
  double path, speed, path_error, speed_error;
} mover;

/* (path, speed, rate) => path, speed and their errors after s. size: sum of the |forces| in the
 * rate, whose error is 6 ROT_EPS size. */
static inline mover advance(mover from, double s, double rate, double size) {
  /* s^2 may overflow where rate s^2 does not. */
  const double half = 0.5 * s, gain = rate * s, along = from.speed * s, step = along + gain * half;
  mover to;
  to.path = from.path + step;
  to.speed = from.speed + gain;
  to.path_error = from.path_error + from.speed_error * s + 9.0 * (size * s) * half +
                  3.0 * fabs(along) + fabs(step) + fabs(to.path);
  to.speed_error = from.speed_error + 8.0 * (size * s) + fabs(to.speed);
  return to;
}

static inline double figure(double error, double value, double other) {
  const double size = larger(fabs(value), fabs(other));
  return size > 0.0 ? ROT_EPS * error / size : error > 0.0 ? 1.0 : 0.0;
}

/* row => kind. Branch-free: mispredicted branches cost 12 ns per row (79 instead of 67 ns on random
 * rows). */
static inline kind kind_of(row *r) {
  static const unsigned char kinds[] = {SLIPS,   SLIPS, SLIPS_BACK, CATCHES,
                                        LETS_GO, ROLLS, LETS_GO,    ROLLS};
  const double need = fabs(r->beta / (1.0 + r->beta) * r->pull);
  /* rot_incline_holds() without its division. */
  const double steep = fabs(r->sine * r->cosine);
  const int breakaway =
      (need <= r->breakaway) |
      ((r->breakaway > 0.0) &
       (need * steep <= r->breakaway * (steep * (1.0 + 16.0 * ROT_EPS) +
                                        2.0 * ROT_EPS * 0.017453292519943295 * fabs(r->angle))));
  r->slip = r->v0 - r->w0;
  r->direction = sign(r->slip);
  r->rim = r->slides / r->beta;
  r->rate = r->pull - r->direction * r->slides - r->direction * r->rim;
  r->inverse = 1.0 / fabs(r->rate);
  r->slip_s = fabs(r->slip) * r->inverse;
  const int still = fabs(r->slip) <= 4.0 * ROT_EPS * fabs(r->w0);
  const int ends = (r->direction * r->rate < 0.0) & (r->slip_s < r->time);
  return (kind)kinds[4 * still + 2 * ends + breakaway];
}

/* row => columns. Returns 0 if a number overflows, else 1. `how` is a compile-time constant of each
 * call. rot_incline_to() takes 260 ns per row instead of 40: it handles events, resistance and
 * copies of the state. */
static inline int two_segments(kind how, const row *r, const rot_incline_table_columns *out,
                               size_t i) {
  const double spin = 1.0 / (1.0 + r->beta), own = r->beta * spin;
  const double size = fabs(r->pull) + r->slides, rim = r->rim;
  const double mean_rate = spin * r->pull;
  mover v = {0.0, r->v0, 0.0, 0.0}, w = {0.0, r->w0, 0.0, fabs(r->w0)};
  double slip = r->slip, left = r->time, heat = 0.0, roll_s = out->none, jump = 0.0,
         direction = r->direction;
  double v_max = r->v0, w_max = r->w0, x_max = 0.0, turn_max = 0.0;
  const int rolling = how == ROLLS || how == CATCHES;
  if (how == ROLLS || how == LETS_GO) {
    w.speed = v.speed;
    w.speed_error = v.speed_error = 4.0 * fabs(r->w0);
    direction = sign(r->pull);
    slip = 0.0;
  } else if (how != SLIPS) {
    const double s = r->slip_s, u = fabs(slip);
    const double late = (2.0 * fabs(r->w0) + u + 8.0 * (size + rim) * s) * r->inverse + 2.0 * s;
    v = advance(v, s, r->pull - direction * r->slides, size);
    w = advance(w, s, direction * rim, rim);
    if (rolling) { /* the mean is independent of the friction */
      const double fractions = spin * fabs(r->v0) + own * fabs(r->w0);
      v.speed = w.speed = spin * r->v0 + own * r->w0 + mean_rate * s;
      v.speed_error = w.speed_error = 8.0 * (fractions + fabs(mean_rate) * s);
      /* Paths are stationary in the time at which slip ends: its error enters squared. */
      const double again = 0.5 * ROT_EPS * fabs(r->rate) * late * late;
      v.path_error += again;
      w.path_error += again;
      roll_s = s;
    } else { /* the friction reverses: the time error acts with its jump */
      jump = 2.0 * late;
    }
    heat = r->mass * r->slides * (0.5 * s * u);
    left = r->time - s;
    slip = 0.0;
    direction = sign(r->pull);
    v_max = larger(fabs(v_max), fabs(v.speed));
    w_max = larger(fabs(w_max), fabs(w.speed));
    x_max = v.path;
    turn_max = w.path;
  }
  if (rolling) {
    v = advance(v, left, mean_rate, fabs(mean_rate));
    w = advance(w, left, mean_rate, fabs(mean_rate));
  } else {
    const double v_rate = r->pull - direction * r->slides;
    const double v_off = jump * r->slides, w_off = jump * rim;
    v = advance(v, left, v_rate, size);
    w = advance(w, left, direction * rim, rim);
    v.speed_error += v_off;
    w.speed_error += w_off;
    v.path_error += v_off * left;
    w.path_error += w_off * left;
    const double end = slip + (v_rate - direction * rim) * left;
    heat += r->mass * r->slides * (0.5 * left * fabs(slip + end));
  }
  const double theta = w.path / r->radius, omega = w.speed / r->radius;
  /* Inf or NaN if any of them is. */
  const double all =
      fabs(v.path) + fabs(v.speed) + fabs(theta) + fabs(omega) + heat + v.path_error + w.path_error;
  if (!isfinite(all)) return 0;
  out->final_x_m[i] = v.path;
  out->final_v_m_per_s[i] = v.speed;
  out->final_theta_rad[i] = theta;
  out->final_omega_rad_per_s[i] = r->time == 0.0 ? r->omega0 : omega;
  out->slip_heat_j[i] = heat;
  out->rolling_heat_j[i] = 0.0;
  out->roll_time_s[i] = roll_s;
  out->rolling[i] = rolling;
  const double of_v =
      larger(figure(v.path_error, v.path, x_max), figure(v.speed_error, v.speed, v_max));
  const double of_w = larger(figure(w.path_error + 2.0 * fabs(w.path), w.path, turn_max),
                             figure(w.speed_error + 2.0 * fabs(w.speed), w.speed, w_max));
  out->error[i] = r->time == 0.0 ? 0.0 : larger(of_v, of_w);
  return 1;
}

/* row => parameters, with beta in place of the moment of inertia. */
static inline rot_incline_params scene_of(const row *r) {
  return (rot_incline_params){.mass_kg = r->mass,
                              .radius_m = r->radius,
                              .inertia_kg_m2 = r->beta,
                              .angle_deg = r->angle,
                              .gravity_m_per_s2 = r->gravity,
                              .mu_kinetic = r->mu_kinetic,
                              .mu_static = r->mu_static,
                              .arm_m = r->arm,
                              .v0_m_per_s = r->v0,
                              .omega0_rad_per_s = r->omega0};
}

/* row => columns by rot_incline_to(). */
static void any_row(const row *r, const rot_incline_table_columns *out, size_t i) {
  rot_incline_params p = scene_of(r);
  p.inertia_kg_m2 = rot_product(4, (double[]){r->beta, r->mass, r->radius, r->radius}, 1.0);
  rot_incline_end end;
  const rot_status status = rot_incline_to(&p, r->time, &end);
  const int good = status == ROT_OK;
  out->final_x_m[i] = good ? end.x_m : NAN;
  out->final_v_m_per_s[i] = good ? end.v_m_per_s : NAN;
  out->final_theta_rad[i] = good ? end.theta_rad : NAN;
  out->final_omega_rad_per_s[i] = good ? end.omega_rad_per_s : NAN;
  out->slip_heat_j[i] = good ? end.slip_heat_j : NAN;
  out->rolling_heat_j[i] = good ? end.rolling_heat_j : NAN;
  out->roll_time_s[i] = good && !isnan(end.roll_s) ? end.roll_s : out->none;
  out->rolling[i] = good && end.rolling;
  out->error[i] = good ? end.error : NAN;
  out->status[i] = (int)status;
}

typedef struct frame {
  const rot_incline_rows *rows;
  const rot_incline_table_columns *out;
} frame;

/* Rows of a block are sorted by kind; those of one kind are processed together. */
enum { BLOCK = 64 };

static inline void rows_of(kind how, const row rows[], const unsigned char at[], size_t n,
                           const rot_incline_table_columns *out, size_t first) {
  for (size_t k = 0; k < n; k++) {
    const row *r = &rows[at[k]];
    if (!two_segments(how, r, out, first + at[k])) any_row(r, out, first + at[k]);
  }
}

/* rows first to last - 1 => columns. */
static void table_rows(const void *data, size_t first, size_t last) {
  const frame *f = data;
  const rot_incline_table_columns out = *f->out;
  const rot_incline_rows own = *f->rows, *in = &own;
  row rows[BLOCK];
  double sine = 0.0, cosine = 0.0, angle = NAN;
  for (size_t start = first; start < last; start += BLOCK) {
    const size_t n = last - start < BLOCK ? last - start : BLOCK;
    unsigned char at[KINDS][BLOCK];
    size_t count[KINDS] = {0};
    for (size_t k = 0; k < n; k++) {
      const size_t i = start + k;
      row *r = &rows[k];
      r->beta = rot_at(in->beta, i);
      r->radius = rot_at(in->radius_m, i);
      r->mass = rot_at(in->mass_kg, i);
      r->angle = rot_at(in->angle_deg, i);
      r->gravity = rot_at(in->gravity_m_per_s2, i);
      r->mu_static = rot_at(in->mu_static, i);
      r->mu_kinetic = rot_at(in->mu_kinetic, i);
      r->arm = rot_at(in->arm_m, i);
      r->v0 = rot_at(in->v0_m_per_s, i);
      r->omega0 = rot_at(in->omega0_rad_per_s, i);
      r->time = rot_at(in->time_s, i);
      const int rolls = isnan(r->omega0);
      if (rolls) r->omega0 = r->v0 / r->radius;
      r->w0 = rolls ? r->v0 : r->radius * r->omega0;
      out.status[i] = ROT_OK;
      kind how = OTHER;
      const rot_incline_params p = scene_of(r);
      if (rot_incline_possible(&p, r->time)) {
        if (r->angle != angle) {
          angle = r->angle;
          rot_sin_cos_deg(angle, &sine, &cosine);
        }
        r->sine = sine;
        r->cosine = cosine;
        const double normal = r->gravity * cosine;
        r->pull = r->gravity * sine;
        r->slides = rot_incline_friction(r->mu_kinetic, normal);
        r->breakaway = rot_incline_friction(r->mu_static, normal);
        /* An infinite kinetic friction: the row rolls from the start. */
        if (r->arm == 0.0 && isfinite(r->slides)) how = kind_of(r);
      }
      at[how][count[how]++] = (unsigned char)k;
    }
    rows_of(ROLLS, rows, at[ROLLS], count[ROLLS], &out, start);
    rows_of(LETS_GO, rows, at[LETS_GO], count[LETS_GO], &out, start);
    rows_of(SLIPS, rows, at[SLIPS], count[SLIPS], &out, start);
    rows_of(CATCHES, rows, at[CATCHES], count[CATCHES], &out, start);
    rows_of(SLIPS_BACK, rows, at[SLIPS_BACK], count[SLIPS_BACK], &out, start);
    for (size_t k = 0; k < count[OTHER]; k++) {
      any_row(&rows[at[OTHER][k]], &out, start + at[OTHER][k]);
    }
  }
}

rot_status rot_incline_table(const rot_incline_rows *rows, int threads,
                             const rot_incline_table_columns *out, const rot_hooks *hooks,
                             rot_info *info) {
  const frame f = {rows, out};
  return rot_parallel_rows(table_rows, &f, rows->n, PART, threads, hooks, info);
}
