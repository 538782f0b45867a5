#include "scene/shaft/modal.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "maths/expm.h"
#include "engine/stepping.h"
#include "ground/real.h"
#include "scene/shaft/modes.h"
#include "scene/shaft/decoupled.h"
#include "scene/shaft/coupled.h"

enum { ROWS_PER_ANCHOR = 64 };

typedef struct modal_run {
  const rot_shaft_modes *s;
  const double *time_s;
  size_t rows;
  const rot_shaft_columns *out;
  rot_info *info;
  double *p, *r; /* n each: modes at the row */
  double *error; /* 2 n: of r, of p */
  rot_shaft_care care;
  rot_shaft_coupled from; /* coupled modes: from the start to a row */
  rot_shaft_stepper grid; /* coupled modes: one step of an even grid */
  double *state;          /* 2 n + 1, of the coupled system */
  size_t even_left;       /* remaining rows of the even grid */
} modal_run;

/* modes => angles, rates and torques of a row, their errors. */
static rot_status write_row(const modal_run *run, size_t row, double t) {
  const rot_shaft_modes *s = run->s;
  const rot_shaft_params *p = s->p;
  const size_t n = s->n;
  double *theta = run->out->theta_rad + row * n, *omega = run->out->omega_rad_per_s + row * n;
  double *torque = run->out->shaft_torque_n_m + row * n;
  double momentum = s->omega0 + s->alpha * t, size = fabs(s->omega0) + fabs(s->alpha * t);
  for (size_t i = 0; i < n; i++) {
    double turned = 0.0, rate = 0.0;
    for (size_t m = n; m-- > 1;) {
      const double q = m > s->floppy ? run->p[m] / s->sigma[m] : run->p[m];
      turned += s->shape[i * n + m] * q;
      rate += s->shape[i * n + m] * run->r[m];
    }
    theta[i] = s->theta0 + (run->p[0] + turned);
    omega[i] = run->r[0] + rate;
    if (!(isfinite(theta[i]) && isfinite(omega[i]))) return ROT_ERANGE;
    momentum -= p->viscous_n_m_s[i] / s->inertia * (theta[i] - p->theta0_rad[i]);
    size += p->viscous_n_m_s[i] / s->inertia * fabs(theta[i] - p->theta0_rad[i]);
  }
  for (size_t i = 0; i < n; i++) {
    momentum -= s->fraction[i] * omega[i];
    size += s->fraction[i] * fabs(omega[i]);
  }
  /* Without the rounding of this sum, which is no error of the rows. What the shapes leave of it is
   * an error of the rates, and swings with the twists: the angles do not add it up. */
  const double residual = fmax(0.0, fabs(momentum) - ROT_EPS * rot_shaft_roundings(s) * size);
  for (size_t i = 0; i < n; i++) {
    double theta_error = 0.0, omega_error = 0.0;
    for (size_t m = 1; m < n; m++) {
      const double shape = fabs(s->shape[i * n + m]), error = run->error[m];
      const double angle =
          m > s->floppy ? run->error[n + m] / s->sigma[m]
                        : error * fabs(t) + ROT_EPS * rot_shaft_roundings(s) * fabs(s->p0[m]);
      /* Coupled modes: one error, of the norm; decoupled modes: one error each. */
      omega_error = s->decoupled ? omega_error + shape * error : hypot(omega_error, shape * error);
      theta_error = s->decoupled ? theta_error + shape * angle : hypot(theta_error, shape * angle);
    }
    omega_error += run->error[0] + residual +
                   ROT_EPS * (2.0 * fabs(omega[i]) + rot_shaft_roundings(s) * s->omega_spread);
    theta_error +=
        run->error[0] * fabs(t) + ROT_EPS * (2.0 * fabs(s->theta0) + 2.0 * fabs(theta[i]) +
                                             rot_shaft_roundings(s) * s->theta_spread);
    if (t == 0.0) { /* the initial state, not its sum of modes */
      theta[i] = p->theta0_rad[i];
      omega[i] = p->omega0_rad_per_s[i];
      theta_error = omega_error = 0.0;
    }
    rot_note_row(run->info, theta[i], omega[i], theta_error, omega_error);
  }
  for (size_t j = 0; j + 1 < n; j++) {
    double elastic = 0.0, slip = 0.0;
    for (size_t m = 1; m < n; m++) {
      elastic += s->lever[j * n + m] * run->p[m];
      slip += s->twist[j * n + m] * run->r[m];
    }
    torque[j] = elastic + p->damping_n_m_s[j] * slip;
  }
  torque[n - 1] = NAN;
  return ROT_OK;
}

/* How much t_(i+k) is later than t_i + k h, without rounding: the last digit of a time is 1e-7 rad
 * at 1e8 rad/s. */
static double late_by(const double time_s[], size_t i, size_t k, double h) {
  const rot_dd between = rot_dd_sum2(time_s[i + k], -time_s[i]);
  return rot_dd_sub(between, rot_dd_mul2((double)k, h)).hi;
}

/* Number of evenly spaced times t_i, t_i + h, ... from row i on, up to deviations that a
 * first-order correction removes; 1: fewer than 8. */
static size_t even_rows(const rot_shaft_modes *s, size_t n, const double time_s[], size_t i) {
  if (i + 8 > n) return 1;
  const double h = time_s[i + 1] - time_s[i];
  size_t k = 1;
  if (!(h > 0.0)) return 1;
  while (i + k < n && fabs(late_by(time_s, i, k, h)) * fmax(s->norm, s->decay) <= 1e-8) {
    k++;
  }
  return k >= 8 ? k : 1;
}

/* Rows i .. i + count - 1, evenly spaced by h, row i known: one product of matrix and vector each,
 * first-order correction of the deviation of the time. *end: rows written. */
static rot_status even_segment(const modal_run *run, size_t i, size_t count, size_t *end) {
  const rot_shaft_modes *s = run->s;
  const rot_shaft_stepper *grid = &run->grid;
  const size_t n = s->n, size = grid->size;
  const double *time_s = run->time_s;
  double *next = grid->work, *slope = grid->work + size, *moved = grid->work + 2 * size;
  double *state = run->state;
  for (size_t m = 0; m < n; m++) {
    const double weight = m == 0 ? s->root_inertia : 1.0;
    state[m] = run->p[m] * weight * (m <= s->floppy ? grid->scale : 1.0);
    state[n + m] = run->r[m] * weight;
  }
  state[2 * n] = grid->unit;
  for (size_t k = 1; k < count; k++) {
    const double late = late_by(time_s, i, k, grid->step) / grid->step;
    rot_shaft_step_errors(&run->from, grid, state, run->error);
    rot_expm_apply(size, grid->e, state, next);
    memcpy(state, next, size * sizeof *state);
    rot_expm_apply(size, grid->a, state, slope);
    for (size_t j = 0; j < size; j++) moved[j] = state[j] + late * slope[j];
    rot_shaft_coupled_read(s, grid, moved, run->p, run->r);
    const double t = time_s[i + k] - s->p->start_s;
    const rot_status status = write_row(run, i + k, t);
    if (status != ROT_OK) return status;
    *end = i + k + 1;
  }
  return ROT_OK;
}

/* Row i by one exponential, the following rows of an even grid by steps. */
static rot_status coupled_rows(void *model, size_t i, size_t last, size_t *end) {
  modal_run *run = model;
  const rot_shaft_modes *s = run->s;
  const rot_dd time = rot_dd_sum2(run->time_s[i], -s->p->start_s);
  const double t = time.hi;
  *end = i;
  rot_status status = rot_shaft_coupled_at(&run->from, time, run->p, run->r, run->error);
  if (status != ROT_OK) return status;
  run->info->steps++;
  status = write_row(run, i, t);
  if (status != ROT_OK) return status;
  *end = i + 1;
  if (run->care == ROT_SHAFT_EVEN && run->even_left <= 1) {
    run->even_left = even_rows(s, run->rows, run->time_s, i);
    if (run->even_left > 1) {
      status = rot_shaft_coupled_step(&run->from, run->time_s[i + 1] - run->time_s[i], &run->grid);
    }
  }
  size_t count = run->even_left < ROWS_PER_ANCHOR ? run->even_left : ROWS_PER_ANCHOR;
  if (count > last - i) count = last - i;
  if (status != ROT_OK || count <= 1) {
    run->even_left = 0;
    return status;
  }
  run->even_left -= count;
  return even_segment(run, i, count, end);
}

static rot_status decoupled_rows(void *model, size_t i, size_t last, size_t *end) {
  const modal_run *run = model;
  rot_status status = ROT_OK;
  for (*end = i; *end < last && *end < i + 256; ++*end) {
    const rot_dd t = rot_dd_sum2(run->time_s[*end], -run->s->p->start_s);
    rot_shaft_decoupled_at(run->s, t, run->p, run->r, run->error);
    status = write_row(run, *end, t.hi);
    if (status != ROT_OK) break;
  }
  return status;
}

/* Builds the modes; rows by decoupled_rows() or coupled_rows(). */
rot_status rot_shaft_modal(const rot_shaft_params *p, rot_shaft_care care, size_t n,
                           const double time_s[], const rot_shaft_columns *out,
                           const rot_hooks *hooks, rot_info *info) {
  static const rot_stepping coupled = {.write_rows = coupled_rows};
  static const rot_stepping decoupled = {.write_rows = decoupled_rows};
  rot_shaft_modes s;
  rot_shaft_note_start(p, info);
  info->status = rot_shaft_modes_build(&s, p, hooks);
  if (info->status == ROT_OK) {
    const size_t room = s.decoupled ? 0 : rot_shaft_coupled_room(p->n);
    double *memory = malloc((room + 6 * p->n + 1) * sizeof *memory), *x = memory;
    modal_run run = {.s = &s, .time_s = time_s, .rows = n, .out = out, .info = info, .care = care};
    if (memory) {
      if (!s.decoupled) {
        run.grid = rot_shaft_stepper_in(p->n, x);
        info->status = rot_shaft_coupled_begin(&run.from, &s, care != ROT_SHAFT_SIZES);
      }
      run.p = x += room;
      run.r = x += p->n;
      run.error = x += p->n;
      run.state = x + 2 * p->n;
      info->steps = s.decoupled && n > 0;
      if (info->status == ROT_OK) {
        rot_step_rows(s.decoupled ? &decoupled : &coupled, &run, p->start_s, n, time_s, hooks,
                      info);
      }
      if (!s.decoupled) rot_shaft_coupled_end(&run.from);
    } else {
      info->status = ROT_ENOMEM;
    }
    free(memory);
  }
  rot_shaft_modes_free(&s);
  return info->status;
}

rot_status rot_shaft_frequencies(const rot_shaft_params *p, double sigma[],
                                 const rot_hooks *hooks) {
  rot_shaft_modes s;
  const rot_status status = rot_shaft_modes_build(&s, p, hooks);
  if (status == ROT_OK) memcpy(sigma, s.sigma, p->n * sizeof *sigma);
  rot_shaft_modes_free(&s);
  return status;
}
