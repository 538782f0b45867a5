#include "rot_ode.h"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_odeiv2.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "rot_dense.h"
#include "rot_radau.h"
#include "rot_real.h"

enum { STEPS_PER_POLL = 4 }; /* a look at the clock is 25 ns, a step 350 ns and more */

#define LEAST_TOLERANCE 1e-13 /* finer steps than half of these: rounding is all one sees */
#define MOST_TOLERANCE  3e-3
#define LEAST_SIZE                                                                                 \
  1e-290 /* below, doubles have no 16 digits left that an error test could ask for */

/* Ends of the steps of one run on one side of the start, outward: t, the error that the test found
 * in the step that ends there (a part of the largest value), y[dim]. */
typedef struct mesh {
  size_t dim, count, room;
  double *data;
} mesh;

static const double *mesh_node(const mesh *m, size_t i) { return m->data + i * (2 + m->dim); }

/* One run. */
typedef struct ode_run {
  const rot_ode_params *p;
  const rot_hooks *hooks;
  rot_info *info;
  rot_method method;
  gsl_odeiv2_step *rk;
  gsl_odeiv2_system system;
  rot_radau *radau;
  double tolerance;
  size_t budget;
  double t, h;          /* h: the step that the error test would like next */
  double after, before; /* rhs is evaluated strictly inside (break, next break) */
  int forward;
  double end;            /* of this side */
  int slope_known;       /* slope holds f(t, y) */
  int wild;              /* rhs was not finite in the last trial */
  double stretch_t;      /* where the stretch began */
  int at_rest, may_flip; /* a stretch began at zero; nothing said which way it goes */
  int was_cut;           /* the last step ended at a dip that was none */
  double noise;          /* of a stretch that began at rest: what cancels in its slope there */
  double grace;          /* held up to here whatever drives */
  rot_status status;     /* of the last rhs call */
  double *y, *trial, *trial_error, *slope, *trial_slope, *allowed, *work; /* dim each */
  double *largest;   /* the caller's: size of each component so far */
  double worst;      /* error that the test found in a step, largest so far */
  double unresolved; /* of steps where halving did not help, the sum of squares */
  const mesh *guide; /* steps of the run before, to be halved; NULL: the error test rules */
  size_t guide_at;   /* t lies from this node of it to the next */
  double limit;      /* no step is longer, after a rejection in a guided run */
  mesh *trace;       /* its own steps */
  double stage_t, *stage_y, *stage_f, stiffness; /* Hairer's test, see rhs_for_gsl() */
  int watch_stiffness, stiff, stiff_steps, calm_steps;
  /* rows, outward from the start */
  rot_dense dense;
  rot_dense_form *form;
  const double *time_s;
  double *y_rows, *slope_rows, *share; /* y_rows NULL: no rows are wanted of this run */
  size_t first, total, done;
} ode_run;

/* ---- the right-hand side -------------------------------------------------------------------- */

/* The last two calls of a step are at the same time: the last stage and the result. Their slopes'
 * difference over their own is what h times has a limit for an explicit method (Hairer, Norsett &
 * Wanner, Solving ODEs II, IV.2). */
static void note_stiffness(ode_run *run, double t, const double y[], const double f[]) {
  const size_t n = run->p->controlled;
  if (t == run->stage_t) {
    double apart = 0.0, rise = 0.0;
    for (size_t i = 0; i < n; i++) {
      const double size = fmax(LEAST_SIZE, fmax(run->largest[i], fabs(y[i])));
      apart = fmax(apart, fabs(y[i] - run->stage_y[i]) / size);
      rise = fmax(rise, fabs(f[i] - run->stage_f[i]) / size);
    }
    /* Rounding apart tells nothing. */
    run->stiffness = apart > 64.0 * ROT_EPS ? rise / apart : 0.0;
  }
  run->stage_t = t;
  memcpy(run->stage_y, y, n * sizeof *y);
  memcpy(run->stage_f, f, n * sizeof *f);
}

static int rhs_for_gsl(double t, const double y[], double dydt[], void *ctx) {
  ode_run *run = ctx;
  t = t < run->after ? run->after : t > run->before ? run->before : t;
  run->info->rhs_calls++;
  run->status = run->p->rhs(t, y, dydt, run->p->ctx);
  if (run->status != ROT_OK) return GSL_EBADFUNC; /* the only code at which rk8pd stops at once */
  for (size_t i = 0; i < run->p->controlled; i++) {
    if (!isfinite(dydt[i])) {
      run->wild = 1;
      run->info->time_s = t;
      return GSL_EBADFUNC;
    }
  }
  if (run->watch_stiffness) note_stiffness(run, t, y, dydt);
  return GSL_SUCCESS;
}

static rot_status know_slope(ode_run *run) {
  if (run->slope_known) return ROT_OK;
  run->wild = 0;
  if (rhs_for_gsl(run->t, run->y, run->slope, run) != GSL_SUCCESS) {
    return run->wild ? ROT_ETORQUE : run->status;
  }
  run->slope_known = 1;
  return ROT_OK;
}

/* ---- one step ------------------------------------------------------------------------------- */

/* From (t, y) with its slope to t + h: trial, trial_error, trial_slope. ROT_ETORQUE: not here, try
 * shorter; else what ends the run. */
static rot_status attempt(ode_run *run, double t, double h, const double y[],
                          const double slope[]) {
  const size_t dim = run->p->dim;
  int code;
  run->wild = 0;
  run->status = ROT_OK;
  memcpy(run->trial, y, dim * sizeof *y);
  if (run->method == ROT_METHOD_RADAU) {
    for (size_t i = 0; i < dim; i++) {
      run->allowed[i] = run->tolerance * fmax(LEAST_SIZE, fmax(run->largest[i], fabs(y[i])));
      if (run->largest[i] == 0.0)
        run->allowed[i] = fmax(LEAST_SIZE, run->tolerance * fabs(h * slope[i]));
    }
    code = rot_radau_step(run->radau, rhs_for_gsl, run, t, h, run->trial, run->trial_error, slope,
                          run->allowed);
    if (code == ROT_RADAU_DIVERGED) return ROT_ETORQUE;
    if (code == GSL_SUCCESS) code = rhs_for_gsl(t + h, run->trial, run->trial_slope, run);
  } else {
    code = gsl_odeiv2_step_apply(run->rk, t, h, run->trial, run->trial_error, slope,
                                 run->trial_slope, &run->system);
  }
  if (code == GSL_SUCCESS) return ROT_OK;
  return run->wild ? ROT_ETORQUE : run->status != ROT_OK ? run->status : ROT_ENOMEM;
}

/* Error of the trial step over what is allowed; NaN if it makes no sense. */
static double trial_ratio(const ode_run *run, double h) {
  double ratio = 0.0;
  for (size_t i = 0; i < run->p->controlled; i++) {
    /* Breaking loose, what drives and what resists cancel: their rounding is no error of a step. */
    const double lost = run->p->turn && i == run->p->turn->watched ? fabs(h) : h * h;
    const double error = fmax(0.0, fabs(run->trial_error[i]) - 16.0 * ROT_EPS * run->noise * lost);
    /* Of its size so far, never of its size later: where errors grow with the motion, what is
     * small against the end is all there is at the start. */
    const double scale = fmax(LEAST_SIZE, fmax(run->largest[i], fabs(run->trial[i])));
    if (!isfinite(run->trial[i])) return NAN;
    const double noise = run->p->noise ? run->p->noise[i] * fabs(h) : 0.0;
    const double allowed = run->tolerance * scale + noise;
    if (error != 0.0 && !(error / allowed <= ratio)) ratio = error / allowed;
  }
  return ratio;
}

static rot_status add_to_mesh(ode_run *run, double error) {
  const size_t stride = 2 + run->p->dim;
  mesh *m = run->trace;
  if (m->count == m->room) {
    const size_t room = m->room ? 2 * m->room : 64;
    double *data = realloc(m->data, room * stride * sizeof *data);
    if (!data) return ROT_ENOMEM;
    m->data = data;
    m->room = room;
  }
  double *node = m->data + m->count++ * stride;
  node[0] = run->t;
  node[1] = error;
  memcpy(node + 2, run->y, run->p->dim * sizeof *node);
  return ROT_OK;
}

static rot_status add_node(ode_run *run) {
  return run->y_rows ? rot_dense_insert(&run->dense, run->dense.count, run->t, run->y, run->slope)
                     : ROT_OK;
}

static rot_status fill_rows(ode_run *run, int whole_stretch);

/* The state moves on to the trial, at t. */
static rot_status accept(ode_run *run, double t, double error) {
  double *swap = run->y;
  run->y = run->trial;
  run->trial = swap;
  swap = run->slope;
  run->slope = run->trial_slope;
  run->trial_slope = swap;
  run->t = t;
  run->at_rest = run->may_flip = 0;
  for (size_t i = 0; i < run->p->dim; i++) {
    run->largest[i] = fmax(run->largest[i], fabs(run->y[i]));
  }
  run->info->steps++;
  if (add_to_mesh(run, error) != ROT_OK || add_node(run) != ROT_OK) return ROT_ENOMEM;
  enum { BLOCK = 512 };
  return run->dense.count >= BLOCK ? fill_rows(run, 0) : ROT_OK;
}

/* Why no step is short enough: the right-hand side is not finite, or the state is about to be. */
static rot_status why_wild(const ode_run *run) {
  for (size_t i = 0; i < run->p->controlled; i++) {
    if (fabs(run->y[i]) > 1e300 || fabs(run->slope[i]) > 1e300) return ROT_ERANGE;
  }
  return ROT_ETORQUE;
}

/* ---- zeros of the watched component ---------------------------------------------------------- */

/* The cubic through values and slopes at both ends of a step, x from 0 to 1. */
static double cubic(const double w[4], double x) {
  const double u = 1.0 - x;
  return u * u * ((1.0 + 2.0 * x) * w[0] + x * w[1]) + x * x * ((3.0 - 2.0 * x) * w[2] - u * w[3]);
}

static rot_status attempt_part(ode_run *run, double h, double *w, double *rise) {
  const size_t i = run->p->turn->watched;
  const rot_status status = attempt(run, run->t, h, run->y, run->slope);
  *w = *run->p->turn->mode * run->trial[i];
  *rise = *run->p->turn->mode * run->trial_slope[i];
  return status;
}

/* The watched component is positive (times the mode) at the start and not so after hi: re-step to
 * the zero by Newton, kept between. *hi becomes that step, trial the state there. */
static rot_status find_zero(ode_run *run, const double w[4], double *hi) {
  double lo = 0.0, high = *hi, a = 0.0, b = 1.0;
  for (int k = 0; k < 40; k++) { /* first guess: the zero of the cubic, whose 1 is the whole step */
    const double mid = 0.5 * (a + b);
    if (cubic(w, mid) > 0.0) {
      a = mid;
    } else {
      b = mid;
    }
  }
  double x = b * *hi;
  for (int k = 0; k < 200; k++) {
    double v, rise;
    const rot_status status = attempt_part(run, x, &v, &rise);
    if (status != ROT_OK) return status;
    const double next = x - v / rise, resolved = 2.0 * ROT_EPS * fmax(fabs(run->t), fabs(x));
    if (v > 0.0) {
      lo = x;
    } else {
      high = x;
    }
    if (v == 0.0 || fabs(next - x) <= resolved || fabs(high - lo) <= 2.0 * resolved) break;
    const int inside = (next - lo) * (next - high) < 0.0; /* NaN is not */
    x = inside ? next : lo + 0.5 * (high - lo);
  }
  *hi = x;
  run->trial[run->p->turn->watched] = 0.0;
  return ROT_OK;
}

/* What an accepted step did to the watched component. */
typedef enum passage { SAME_SIDE, AT_ZERO, CUT_SHORT, TRY_SHORTER } passage;

/* A step from rest that ends on the wrong side: does it go the right way at first? */
static rot_status leave_rest(ode_run *run, const double w[4], double *h, passage *what) {
  double best = 0.0, at = 0.0, v, rise;
  *what = TRY_SHORTER;
  for (int k = 1; k < 16; k++) {
    if (cubic(w, k / 16.0) > best) {
      best = cubic(w, k / 16.0);
      at = k / 16.0;
    }
  }
  if (best == 0.0) return ROT_OK;
  const rot_status status = attempt_part(run, at * *h, &v, &rise);
  if (status == ROT_OK && v > 0.0) {
    *h *= at;
    *what = CUT_SHORT;
  }
  return status;
}

/* Looks at the end of the step and, by its cubic, at seven places within. */
static rot_status look_for_zero(ode_run *run, double *h, passage *what) {
  const rot_ode_switch *turn = run->p->turn;
  *what = SAME_SIDE;
  if (!turn) return ROT_OK;
  const size_t i = turn->watched;
  const double s = *turn->mode;
  double w[4] = {s * run->y[i], s * run->slope[i] * *h, s * run->trial[i],
                 s * run->trial_slope[i] * *h};
  if (run->at_rest && w[1] == 0.0 && w[2] == 0.0 && w[3] == 0.0) return ROT_OK; /* still */
  if (run->at_rest && w[2] <= 0.0) {
    if (!run->may_flip) return leave_rest(run, w, h, what);
    run->may_flip = 0;
    *turn->mode = -*turn->mode;
    run->slope_known = 0;
    *what = TRY_SHORTER;
    return ROT_OK;
  }
  /* Between two ends on one side it may dip to the other. The cubic is of order 4, so that it is
   * believed only where it stays clear of zero. */
  double dip = 1.0, least = run->was_cut ? 0.0 : 0.3 * fmin(w[0], w[2]);
  for (int k = 1; k < 8 && w[2] > 0.0; k++) {
    if (cubic(w, 0.125 * k) < least) {
      least = cubic(w, 0.125 * k);
      dip = 0.125 * k;
    }
  }
  if (w[2] > 0.0 && (dip == 1.0 || run->at_rest)) return ROT_OK;
  if (dip < 1.0) { /* ask the method itself */
    double v, rise;
    const rot_status status = attempt_part(run, dip * *h, &v, &rise);
    if (status != ROT_OK) return status;
    *h *= dip;
    if (v > 0.0) {
      *what = CUT_SHORT;
      return ROT_OK;
    }
    w[1] *= dip;
    w[2] = v;
    w[3] = rise * *h;
  }
  *what = AT_ZERO;
  return find_zero(run, w, h);
}

/* ---- held at rest ---------------------------------------------------------------------------- */

/* What drives it, over what holds: positive is loose. Sums of the others go on: sum[dim] += the
 * integral of dydt from t over h by Lobatto's four points and Kronrod's three (Gander & Gautschi,
 * BIT 40, 2000). */
enum { HELD_POINTS = 7 };
static const double held_at[HELD_POINTS] = {
    0.0, 0.5 - 0.5 * 0.81649658092772603273, 0.5 - 0.5 * 0.44721359549995793928,
    0.5, 0.5 + 0.5 * 0.44721359549995793928, 0.5 + 0.5 * 0.81649658092772603273,
    1.0};

static rot_status held_slope(ode_run *run, double t, double *drive, double *grip) {
  run->wild = 0;
  if (rhs_for_gsl(t, run->y, run->trial_slope, run) != GSL_SUCCESS) {
    return run->wild ? ROT_ETORQUE : run->status;
  }
  *drive = run->trial_slope[run->p->turn->driver];
  if (!isfinite(*drive)) {
    run->info->time_s = t;
    return ROT_ETORQUE;
  }
  *grip = fabs(*drive) - run->p->turn->holds;
  if (run->forward ? t < run->grace : t > run->grace) *grip = fmin(*grip, 0.0);
  return ROT_OK;
}

/* Seven points of a stretch at rest. The first loose one in *loose, HELD_POINTS if none; *apart is
 * how far the two rules differ. trial = y at its end, trial_slope the slope there. */
static rot_status held_segment(ode_run *run, double h, double drive[], double grip[], int *loose,
                               double *apart) {
  static const double kronrod[HELD_POINTS] = {77.0, 432.0, 625.0, 672.0, 625.0, 432.0, 77.0};
  const size_t dim = run->p->dim, driver = run->p->turn->driver;
  double four = 0.0, seven = 0.0;
  memcpy(run->trial, run->y, dim * sizeof *run->y);
  *loose = HELD_POINTS;
  for (int k = 0; k < HELD_POINTS; k++) {
    const double at = k + 1 < HELD_POINTS ? run->t + held_at[k] * h : run->t + h;
    const rot_status status = held_slope(run, at, &drive[k], &grip[k]);
    if (status != ROT_OK) return status;
    if (grip[k] > 0.0) {
      *loose = k;
      return ROT_OK;
    }
    for (size_t i = run->p->controlled; i < dim; i++) {
      run->trial[i] += h * (kronrod[k] / 2940.0) * run->trial_slope[i];
    }
    seven += kronrod[k] / 2940.0 * run->trial_slope[driver];
    if (k == 0 || k == 6) four += run->trial_slope[driver] / 12.0;
    if (k == 2 || k == 4) four += run->trial_slope[driver] * 5.0 / 12.0;
  }
  *apart = fabs(seven - four);
  return ROT_OK;
}

/* A peak between three points that may reach over zero: *at is its place if it does. */
static rot_status peak_between(ode_run *run, double h, const double grip[], int *before,
                               double *at) {
  *before = -1;
  for (int k = 1; k + 1 < HELD_POINTS; k++) {
    if (grip[k] < grip[k - 1] || grip[k] < grip[k + 1]) continue;
    const double left = held_at[k] - held_at[k - 1], right = held_at[k + 1] - held_at[k];
    const double up = (grip[k] - grip[k - 1]) / left, down = (grip[k + 1] - grip[k]) / right;
    const double bend = (down - up) / (left + right);
    if (!(bend < 0.0)) continue;
    const double x = 0.5 * (held_at[k] + held_at[k - 1]) - 0.5 * up / bend;
    const double off = (x - held_at[k - 1]) * (up + bend * (x - held_at[k]));
    const double room = fmax(grip[k] - grip[k - 1], grip[k] - grip[k + 1]);
    if (!(grip[k - 1] + off > -0.2 * room)) continue;
    double drive, there;
    const rot_status status = held_slope(run, run->t + x * h, &drive, &there);
    if (status != ROT_OK) return status;
    if (there > 0.0) {
      *before = x > held_at[k] ? k : k - 1;
      *at = x;
      return ROT_OK;
    }
  }
  return ROT_OK;
}

/* From lo, held, to hi, loose: the first double at which it is loose (regula falsi, halved). */
static rot_status find_loose(ode_run *run, double lo, double hi, double grip_lo, double *at) {
  double drive, grip_hi;
  rot_status status = held_slope(run, hi, &drive, &grip_hi);
  for (int k = 0; k < 200 && status == ROT_OK; k++) {
    double mid = lo + (hi - lo) * (grip_lo / (grip_lo - grip_hi));
    if (k % 3 == 2 || !((mid > lo && mid < hi) || (mid < lo && mid > hi))) mid = 0.5 * (lo + hi);
    if (mid == lo || mid == hi) break;
    double grip;
    status = held_slope(run, mid, &drive, &grip);
    if (status != ROT_OK) break;
    if (grip > 0.0) {
      hi = mid;
      grip_hi = grip;
    } else {
      lo = mid;
      grip_lo = grip;
    }
  }
  *at = hi;
  return status;
}

/* At rest, up to `stop` or to where it breaks loose. */
static rot_status hold(ode_run *run, double stop, int *broke_loose) {
  const double whole = stop - run->t;
  double h = whole / (isfinite(whole) ? (run->guide ? 8.0 : 4.0) : 1.0), most = h;
  *broke_loose = 0;
  while (run->t != stop && !*broke_loose) {
    double drive[HELD_POINTS], grip[HELD_POINTS], apart = 0.0, end = run->t + h, at;
    int loose, before = -1;
    if (run->info->steps + run->info->rejected >= run->budget) {
      run->info->time_s = run->t;
      return ROT_EBUDGET;
    }
    rot_status status = rot_poll(run->hooks, 0.0);
    if (status != ROT_OK) return status;
    if (fabs(stop - end) <= 1e-6 * fabs(h) || (run->forward ? end > stop : end < stop)) end = stop;
    const double width = end - run->t;
    status = held_segment(run, width, drive, grip, &loose, &apart);
    if (status != ROT_OK) return status;
    const double size = fmax(run->p->turn->holds, fabs(drive[0]));
    const int too_long = loose == HELD_POINTS && apart > 1e-7 * size &&
                         fabs(width) > 1e-5 * fabs(whole) && run->t + 0.5 * width != run->t;
    if (too_long) {
      run->info->rejected++;
      h = 0.5 * width;
      continue;
    }
    if (loose == HELD_POINTS) status = peak_between(run, width, grip, &before, &at);
    if (status != ROT_OK) return status;
    if (loose < HELD_POINTS || before >= 0) {
      /* The pieces before are done when the segment ends at the place itself. */
      const int k = before >= 0 ? before : loose - 1;
      const double hi = run->t + (before >= 0 ? at : held_at[loose]) * width;
      if (k < 0) { /* loose from the start */
        *broke_loose = 1;
        return ROT_OK;
      }
      status = find_loose(run, run->t + held_at[k] * width, hi, grip[k], &end);
      if (status != ROT_OK) return status;
      const double grace = run->grace;
      run->grace = run->forward ? INFINITY : -INFINITY; /* for the sums alone */
      status = held_segment(run, end - run->t, drive, grip, &loose, &apart);
      run->grace = grace;
      if (status != ROT_OK) return status;
      *broke_loose = 1;
    }
    status = accept(run, end, 0.0);
    if (status != ROT_OK) return status;
    run->slope_known = 1;
    h = copysign(fmin(fabs(most), 2.0 * fabs(h)), whole);
  }
  return ROT_OK;
}

/* ---- the stretches of a motion that may turn or stick ---------------------------------------- */

static void log_event(const ode_run *run, rot_event event, rot_status *status) {
  /* Met on the way back, coming to rest is breaking loose. */
  if (!run->forward && event != ROT_EVENT_REVERSE) {
    event = event == ROT_EVENT_STICK ? ROT_EVENT_SLIP : ROT_EVENT_STICK;
  }
  if (rot_events_add(run->p->turn->events, run->t, event) != ROT_OK) *status = ROT_ENOMEM;
}

/* Which way it goes on from here. `was`: the mode before, 2 at the start of a run. */
static rot_status choose_mode(ode_run *run, int was) {
  const rot_ode_switch *turn = run->p->turn;
  run->at_rest = run->may_flip = run->was_cut = 0;
  run->noise = 0.0;
  if (!turn) return ROT_OK;
  rot_status status = ROT_OK;
  const double w = run->y[turn->watched];
  run->slope_known = 0;
  if (w != 0.0) {
    *turn->mode = w > 0.0 ? 1 : -1;
    return ROT_OK;
  }
  double drive, grip;
  *turn->mode = 0;
  status = held_slope(run, run->t, &drive, &grip);
  if (status != ROT_OK) return status;
  if (turn->holds > 0.0 && grip <= 0.0) {
    if (was == 1 || was == -1) log_event(run, ROT_EVENT_STICK, &status);
    return status;
  }
  const int way = drive > 0.0 ? 1 : drive < 0.0 ? -1 : was == 1 ? -1 : 1;
  *turn->mode = run->forward || drive == 0.0 ? way : -way;
  run->at_rest = 1;
  run->may_flip = drive == 0.0;
  if (turn->holds > 0.0) { /* against its way, nothing cancels */
    const int mode = *turn->mode;
    double unused;
    *turn->mode = -mode;
    if (status == ROT_OK) status = held_slope(run, run->t, &drive, &unused);
    *turn->mode = mode;
    run->noise = fabs(run->trial_slope[turn->watched]);
  }
  if (was == 0) log_event(run, ROT_EVENT_SLIP, &status);
  if (was == -*turn->mode) log_event(run, ROT_EVENT_REVERSE, &status);
  return status;
}

/* Radau's first step would pass over a transient, and the error test of its end would not see it;
 * rows within it, and what theta gains in it, would be wrong. Where a stretch begins further from
 * its quick equilibrium than the accuracy, the first step is a twentieth of the transient. */
static rot_status resolve_transient(ode_run *run) {
  const rot_ode_params *p = run->p;
  if (run->method != ROT_METHOD_RADAU || run->guide) return ROT_OK;
  double most = 0.0, size = 0.0, change = 0.0;
  for (size_t i = 0; i < p->controlled; i++) {
    most = fmax(most, fabs(run->slope[i]));
    size = fmax(size, fabs(run->y[i]));
  }
  if (!(most > 0.0 && isfinite(most))) return ROT_OK;
  /* Along the motion itself, far enough for the difference to have digits. */
  const double way = run->forward ? 1.0 : -1.0;
  const double d = fmin(fabs(run->h), fmax(1e-6 * fabs(run->h), 1e-7 * size / most));
  for (size_t i = 0; i < p->controlled; i++) run->trial[i] = run->y[i] + way * d * run->slope[i];
  for (size_t i = p->controlled; i < p->dim; i++) run->trial[i] = run->y[i];
  if (rhs_for_gsl(run->t, run->trial, run->trial_slope, run) != GSL_SUCCESS) {
    const int elsewhere = run->wild;
    run->wild = 0;
    return elsewhere ? ROT_OK : run->status;
  }
  for (size_t i = 0; i < p->controlled; i++) {
    change = fmax(change, fabs(run->trial_slope[i] - run->slope[i]));
  }
  const double rate = change / d / most;
  for (size_t i = 0; i < p->controlled; i++) {
    const double apart = fabs(run->slope[i]) / rate;
    const double scale = fmax(run->largest[i], fabs(run->y[i]));
    if (rate * fabs(run->h) > 1.0 && apart > 0.03 * p->accuracy * scale) {
      run->h = way * 0.05 / rate;
      return ROT_OK;
    }
  }
  return ROT_OK;
}

static rot_status begin_stretch(ode_run *run, int was) {
  rot_status status = choose_mode(run, was);
  if (status == ROT_OK) status = know_slope(run);
  if (status == ROT_OK) status = resolve_transient(run);
  run->stretch_t = run->t;
  run->dense.count = 0;
  if (status == ROT_OK) status = add_node(run);
  return status;
}

/* ---- the march ------------------------------------------------------------------------------- */

/* Where the guided run steps to next: halves of the steps of its guide. Nearer than a third of a
 * half step it goes for the one after, so that after a zero, which no two runs meet at the same
 * time, it falls in with the guide again. */
static double guided_aim(ode_run *run, double stop) {
  const mesh *m = run->guide;
  while (run->guide_at + 2 < m->count &&
         (run->forward ? mesh_node(m, run->guide_at + 1)[0] <= run->t
                       : mesh_node(m, run->guide_at + 1)[0] >= run->t)) {
    run->guide_at++;
  }
  for (size_t k = run->guide_at; k + 1 < m->count; k++) {
    const double a = mesh_node(m, k)[0], b = mesh_node(m, k + 1)[0], mid = 0.5 * (a + b);
    const double least = 0.3 * fabs(mid - a), way = run->forward ? 1.0 : -1.0;
    const double aim = way * (mid - run->t) > least ? mid : b;
    if (way * (aim - run->t) <= 0.0) continue;
    if (way * (stop - aim) <= 0.0) return stop;
    if (way * (aim - run->t) > least) return aim;
  }
  return stop;
}

typedef struct step_plan {
  double h, target; /* target: the time at its end */
  int as_wished;    /* not cut short by a target */
} step_plan;

static step_plan plan_step(ode_run *run, double stop) {
  const double left = stop - run->t;
  step_plan plan = {left, stop, 0};
  if (run->guide) {
    plan.target = guided_aim(run, stop);
    plan.h = plan.target - run->t;
    if (fabs(plan.h) > run->limit) {
      plan.h = (run->t + copysign(run->limit, left)) - run->t;
      plan.target = run->t + plan.h;
    }
    return plan;
  }
  /* The last step lands on the target; the one before it is halved rather than leave a sliver. */
  const double size = fabs(run->h);
  if (size >= fabs(left) * (1.0 - 1e-10)) return plan;
  const double aim = size > 0.5 * fabs(left) ? 0.5 * left : copysign(size, left);
  /* The step that time will really take: rounding t each time lost 4e-14 in 300 steps. */
  plan.h = (run->t + aim) - run->t;
  plan.target = run->t + plan.h;
  plan.as_wished = aim == run->h;
  return plan;
}

static double error_power(const ode_run *run) {
  return run->method == ROT_METHOD_RADAU ? -1.0 / (ROT_RADAU_ERROR_ORDER + 1.0) : -1.0 / 8.0;
}

/* A stiff problem costs an explicit method steps that its error test would not need. */
static void judge_stiffness(ode_run *run, double h) {
  if (!run->watch_stiffness) return;
  if (fabs(h) * run->stiffness > 4.0) {
    run->stiff_steps++;
    run->calm_steps = 0;
  } else if (++run->calm_steps >= 6) {
    run->stiff_steps = 0;
  }
  run->stiff = run->stiff_steps >= 15 && fabs(run->end - run->t) > 50.0 * fabs(h);
}

static rot_status reject(ode_run *run, double h, double factor) {
  run->info->rejected++;
  run->h = h * factor;
  run->limit = fabs(run->h);
  /* As short as time can be resolved, or rounded back to what was just rejected. */
  const double next = fabs((run->t + run->h) - run->t);
  if (next > 0.0 && next < fabs(h)) return ROT_OK;
  if (run->at_rest && run->p->turn->holds > 0.0) { /* drives no further than rounding: held */
    run->grace = run->t + 1e-9 * (run->end - run->t);
    *run->p->turn->mode = 0;
    run->slope_known = 0;
    return ROT_OK;
  }
  const rot_status why = run->wild ? why_wild(run) : ROT_ESTEP;
  if (why != ROT_ETORQUE) run->info->time_s = run->t; /* else it is where the torque failed */
  return why;
}

/* Half the step should divide the error that the test sees by 2^8 (2^6: Radau). Where it does not,
 * something is too quick for these steps, or has a kink, and the test's figure itself must stand
 * for the error. */
static void note_error(ode_run *run, double error) {
  run->worst = fmax(run->worst, error);
  if (!run->guide || run->guide_at + 1 >= run->guide->count) return;
  double before = mesh_node(run->guide, run->guide_at + 1)[1];
  if (run->guide_at + 2 < run->guide->count) { /* after a zero the guide is some way off */
    before = fmax(before, mesh_node(run->guide, run->guide_at + 2)[1]);
  }
  if (error > before / (run->method == ROT_METHOD_RADAU ? 8.0 : 32.0) && error > 16.0 * ROT_EPS) {
    /* Radau's test is that of order 5, its result of order 9. */
    const double missed = run->method == ROT_METHOD_RADAU ? pow(error, 1.5) : error;
    run->unresolved += missed * missed;
  }
}

/* One step towards `stop`, which no break comes before. */
static rot_status take_step(ode_run *run, double stop, double fraction, passage *what) {
  const size_t tried = run->info->steps + run->info->rejected;
  *what = TRY_SHORTER;
  if (tried >= run->budget) {
    run->info->time_s = run->t;
    return ROT_EBUDGET;
  }
  rot_status status = tried % STEPS_PER_POLL == 0 ? rot_poll(run->hooks, fraction) : ROT_OK;
  if (status == ROT_OK) status = know_slope(run);
  if (status != ROT_OK) return status;
  step_plan plan = plan_step(run, stop);
  if (run->t + plan.h == run->t) {
    run->info->time_s = run->t;
    return ROT_ESTEP;
  }
  status = attempt(run, run->t, plan.h, run->y, run->slope);
  if (status != ROT_OK && status != ROT_ETORQUE) return status;
  if (status == ROT_ETORQUE && !run->wild && run->status != ROT_OK) return status;
  const double ratio = status == ROT_OK ? trial_ratio(run, plan.h) : NAN;
  if (!(ratio <= 1.0)) { /* NaN fails */
    const double less = isfinite(ratio) ? fmax(0.1, 0.9 * pow(ratio, error_power(run))) : 0.1;
    return reject(run, plan.h, less);
  }
  double h = plan.h;
  status = look_for_zero(run, &h, what);
  if (status == ROT_ETORQUE && run->wild) return reject(run, plan.h, 0.5);
  if (status != ROT_OK) return status;
  if (*what == TRY_SHORTER) return run->slope_known ? reject(run, plan.h, 0.1) : ROT_OK;
  note_error(run, ratio * run->tolerance);
  run->limit = INFINITY;
  run->was_cut = *what == CUT_SHORT;
  const double grow = ratio > 0.0 ? 0.9 * pow(ratio, error_power(run)) : 5.0;
  const double wish = plan.h * fmin(5.0, fmax(0.5, grow));
  judge_stiffness(run, plan.h);
  /* A step cut short by a target says nothing against the longer one. */
  if (fabs(wish) > fabs(run->h) || plan.as_wished) run->h = wish;
  return accept(run, *what == SAME_SIDE ? plan.target : run->t + h, ratio * run->tolerance);
}

/* Integrate to a time with no break in between. */
static rot_status drive(ode_run *run, double stop) {
  const rot_ode_switch *turn = run->p->turn;
  const double whole = run->end - run->p->start_s;
  while (run->t != stop) {
    passage what = SAME_SIDE;
    rot_status status;
    int was = turn ? *turn->mode : 1, broke_loose = 0;
    if (was == 0) {
      status = hold(run, stop, &broke_loose);
    } else {
      status = take_step(run, stop, fabs((run->t - run->p->start_s) / whole), &what);
      if (run->stiff) return ROT_ESTEP;
    }
    if (status != ROT_OK) return status;
    if (what == AT_ZERO || broke_loose) {
      status = fill_rows(run, 1);
      if (status == ROT_OK) status = begin_stretch(run, was);
      if (status != ROT_OK) return status;
    }
  }
  return ROT_OK;
}

/* The way outward from the start: the next break, and the side of it that rhs may see. */
typedef struct course {
  double outward; /* +Inf or -Inf */
  size_t k;       /* breaks[k] is next forward, breaks[k - 1] backward */
  double *near, *far;
} course;

static course set_out(ode_run *run, double end, int forward) {
  const rot_ode_params *p = run->p;
  course w = {forward ? INFINITY : -INFINITY, 0, NULL, NULL};
  w.near = forward ? &run->after : &run->before;
  w.far = forward ? &run->before : &run->after;
  memcpy(run->y, p->start, p->dim * sizeof *run->y);
  run->forward = forward;
  run->end = end;
  run->t = p->start_s;
  run->h = (end - p->start_s) / 100.0;
  run->limit = INFINITY;
  run->slope_known = 0;
  run->guide_at = 0;
  run->grace = -w.outward;
  run->stage_t = NAN;
  run->stiffness = 0.0;
  run->stiff_steps = run->calm_steps = 0;
  run->after = -INFINITY;
  run->before = INFINITY;
  while (w.k < p->n_breaks && (forward ? p->breaks[w.k] <= run->t : p->breaks[w.k] < run->t)) w.k++;
  const int on_break = forward ? w.k > 0 && p->breaks[w.k - 1] == run->t
                               : w.k < p->n_breaks && p->breaks[w.k] == run->t;
  if (on_break) *w.near = nextafter(run->t, w.outward);
  return w;
}

/* The next break, +-Inf if there is none; rhs stays on this side of it. */
static double next_break(const ode_run *run, course *w) {
  const int more = run->forward ? w->k < run->p->n_breaks : w->k > 0;
  const double stop = more ? run->p->breaks[run->forward ? w->k : w->k - 1] : w->outward;
  *w->far = more ? nextafter(stop, -w->outward) : w->outward;
  return stop;
}

static void cross_break(ode_run *run, course *w, double stop) {
  *w->near = nextafter(stop, w->outward);
  run->slope_known = 0;
  w->k = run->forward ? w->k + 1 : w->k - 1;
  if (run->p->at_break) run->p->at_break(stop, run->y, run->forward, run->p->ctx);
}

/* From the start to `end`, all breaks on the way. */
static rot_status march(ode_run *run, double end, int forward) {
  course w = set_out(run, end, forward);
  rot_status status = add_to_mesh(run, 0.0);
  int was = 2;
  while (status == ROT_OK && run->t != end) {
    const double at_break = next_break(run, &w);
    const int breaks = forward ? at_break < end : at_break > end;
    status = begin_stretch(run, was);
    if (status == ROT_OK) status = drive(run, breaks ? at_break : end);
    const rot_status rows = fill_rows(run, 1);
    if (status == ROT_OK) status = rows;
    if (status == ROT_OK) run->info->time_s = run->t;
    if (status == ROT_OK && breaks) cross_break(run, &w, at_break);
    was = run->p->turn ? *run->p->turn->mode : 1;
  }
  return status;
}

/* ---- rows ------------------------------------------------------------------------------------ */

static size_t row_now(const ode_run *run) {
  return run->forward ? run->first + run->done : run->first + run->total - 1 - run->done;
}

static void row_is(ode_run *run, const double y[], double slope) {
  const size_t row = row_now(run);
  memcpy(run->y_rows + row * run->p->dim, y, run->p->dim * sizeof *y);
  if (run->slope_rows) run->slope_rows[row] = slope;
  run->done++;
  if (run->forward) run->info->rows_done = row + 1;
}

/* A row from the polynomials; 0 if they are not good enough there. */
static int row_between(ode_run *run, double t, int held) {
  const rot_ode_params *p = run->p;
  double slope = NAN;
  for (size_t i = 0; i < p->dim; i++) {
    double share, rise, rise_share;
    run->work[i] = rot_dense_at(&run->form[i], t, &rise, &share, &rise_share);
    /* A tenth: the share is what the last of the nodes mends, some ten times what is left. */
    if (i < p->controlled && !held) {
      if (!(share <= 0.03 * p->accuracy * run->largest[i])) return 0;
      run->share[i] = fmax(run->share[i], share);
    }
    if (i == p->sloped && run->slope_rows && run->dense.slopes) {
      const double *a = rot_dense_node(&run->dense, 0) + 1 + p->dim + i;
      const size_t stride = 1 + 2 * p->dim;
      double size = 0.0;
      for (size_t k = 0; k < run->dense.count; k++) size = fmax(size, fabs(a[k * stride]));
      if (rise_share <= 0.03 * p->accuracy * size) slope = rise;
    }
  }
  row_is(run, run->work, slope);
  return 1;
}

/* A node of its own for a row, or for the middle of an interval with several. */
static rot_status step_between(ode_run *run, size_t i, size_t rows) {
  const rot_ode_params *p = run->p;
  const double *node = rot_dense_node(&run->dense, i);
  const double a = node[0], b = rot_dense_node(&run->dense, i + 1)[0],
               t = run->time_s[row_now(run)];
  const double mid = 0.5 * (a + b);
  const int split = rows > 2 && mid != a && mid != b;
  const double to = split ? mid : t;
  const rot_status status = attempt(run, a, to - a, node + 1, node + 1 + p->dim);
  if (status != ROT_OK) return status;
  if (split) return rot_dense_insert(&run->dense, i + 1, mid, run->trial, run->trial_slope);
  row_is(run, run->trial, run->dense.slopes ? run->trial_slope[p->sloped] : NAN);
  return ROT_OK;
}

/* The rows that the nodes so far allow for: all of them, or those with four nodes beyond. */
/* Radau steps over a transient that dies out within its first step, and the values at the steps'
 * ends do not show it; the slope where the stretch begins does. */
static int in_transient(const ode_run *run, const double *node, double t) {
  if (run->method != ROT_METHOD_RADAU || node[0] != run->stretch_t) return 0;
  for (size_t i = 0; i < run->p->controlled; i++) {
    double rise;
    rot_dense_at(&run->form[i], node[0], &rise, NULL, NULL);
    const double missed = fabs(node[1 + run->p->dim + i] - rise) * fabs(t - node[0]);
    if (!(missed <= 0.03 * run->p->accuracy * run->largest[i])) return 1;
  }
  return 0;
}

static rot_status fill_rows(ode_run *run, int whole_stretch) {
  enum { BEYOND = 4, BEHIND = 8 };
  rot_dense *d = &run->dense;
  if (!run->y_rows) return ROT_OK;
  const int watching = run->watch_stiffness, held = run->p->turn && *run->p->turn->mode == 0;
  const double way = run->forward ? 1.0 : -1.0;
  const size_t beyond = whole_stretch ? 0 : BEYOND;
  size_t i = 0, formed = (size_t)-1;
  rot_status status = ROT_OK;
  run->watch_stiffness = 0;
  while (status == ROT_OK && run->done < run->total && d->count > beyond) {
    const double t = run->time_s[row_now(run)];
    const size_t last = d->count - 1 - beyond;
    if (way * (t - rot_dense_node(d, last)[0]) > 0.0) break;
    while (i < last && way * (t - rot_dense_node(d, i + 1)[0]) >= 0.0) i++;
    const double *node = rot_dense_node(d, i);
    if (t == node[0]) {
      const int inside = i > 0 && i + 1 < d->count;
      row_is(run, node + 1, inside ? node[1 + run->p->dim + run->p->sloped] : NAN);
      continue;
    }
    if (formed != i) {
      for (size_t k = 0; k < run->p->dim; k++) run->form[k] = rot_dense_between(d, i, k);
      formed = i;
    }
    const int enough = held || run->form[0].terms >= 4 * (d->slopes ? 2 : 1);
    if (enough && !in_transient(run, node, t) && row_between(run, t, held)) continue;
    size_t rows = 1;
    while (run->done + rows < run->total && rows < 3) {
      const double next = run->time_s[run->forward ? row_now(run) + rows : row_now(run) - rows];
      if (way * (next - rot_dense_node(d, i + 1)[0]) >= 0.0) break;
      rows++;
    }
    const size_t count = d->count;
    status = step_between(run, i, rows);
    if (d->count != count) formed = (size_t)-1;
  }
  if (!whole_stretch && d->count > BEYOND + BEHIND + 1) {
    rot_dense_drop(d, d->count - (BEYOND + BEHIND + 1));
  }
  run->watch_stiffness = watching;
  return status;
}

/* ---- one run over both sides ----------------------------------------------------------------- */

/* What is asked of a run, and where the rows go. */
typedef struct job {
  const rot_ode_params *p;
  size_t n, before; /* rows; those before the start */
  const double *time_s;
  rot_method method;
  double tolerance;
  size_t budget;
  double *y_rows, *slope_rows; /* NULL: none */
  const mesh *guide;           /* of both sides, or NULL */
  mesh *trace;                 /* of both sides */
  double *largest, *share;
  double worst, unresolved; /* out: see ode_run */
  int stiff;                /* in: look for it; out: found */
} job;

static rot_status run_sides(ode_run *run, job *j) {
  rot_status status = ROT_OK;
  for (int forward = 0; forward < 2 && status == ROT_OK; forward++) {
    const mesh *guide = j->guide ? &j->guide[forward] : NULL;
    run->first = forward ? j->before : 0;
    run->total = forward ? j->n - j->before : j->before;
    run->done = 0;
    run->forward = forward;
    run->guide = guide;
    run->trace = &j->trace[forward];
    run->trace->dim = j->p->dim;
    run->trace->count = 0;
    if (forward) run->info->rows_done = j->before;
    if (run->total == 0) continue;
    double end = j->time_s[forward ? j->n - 1 : 0];
    if (guide && guide->count) end = mesh_node(guide, guide->count - 1)[0];
    if (run->y_rows) { /* rows at the start itself */
      while (run->done < run->total && j->time_s[row_now(run)] == j->p->start_s) {
        row_is(run, j->p->start, NAN);
      }
    }
    status = march(run, end, forward);
  }
  return status;
}

static rot_status run_once(job *j, const rot_hooks *hooks, rot_info *info) {
  const rot_ode_params *p = j->p;
  const size_t dim = p->dim;
  ode_run run;
  memset(&run, 0, sizeof run);
  double *scratch = calloc(9 * dim, sizeof *scratch);
  const size_t calls = info->rhs_calls;
  rot_info_clear(info);
  info->rhs_calls = calls;
  info->tolerance = j->tolerance;
  info->method = j->method;
  run.p = p;
  run.hooks = hooks;
  run.info = info;
  run.method = j->method;
  run.tolerance = j->tolerance;
  run.budget = j->budget;
  run.largest = j->largest;
  run.share = j->share;
  run.time_s = j->time_s;
  run.y_rows = j->y_rows;
  run.slope_rows = j->slope_rows;
  run.watch_stiffness = j->stiff;
  run.dense.dim = dim;
  run.dense.slopes = j->method == ROT_METHOD_RK8PD;
  run.form = calloc(dim, sizeof *run.form);
  for (size_t i = 0; i < dim; i++) {
    j->largest[i] = fabs(p->start[i]);
    if (j->share) j->share[i] = 0.0;
  }
  if (p->turn && p->turn->events) p->turn->events->count = 0;
  if (j->method == ROT_METHOD_RADAU) {
    run.radau = rot_radau_alloc(dim, p->controlled);
  } else {
    run.rk = gsl_odeiv2_step_alloc(gsl_odeiv2_step_rk8pd, dim);
  }
  info->status = scratch && run.form && (run.rk || run.radau) ? ROT_OK : ROT_ENOMEM;
  if (info->status == ROT_OK) {
    double **part[] = {&run.y,       &run.trial, &run.trial_error, &run.slope,  &run.trial_slope,
                       &run.allowed, &run.work,  &run.stage_y,     &run.stage_f};
    for (size_t k = 0; k < sizeof part / sizeof *part; k++) *part[k] = scratch + k * dim;
    run.system = (gsl_odeiv2_system){rhs_for_gsl, NULL, dim, &run};
    info->status = run_sides(&run, j);
  }
  j->worst = run.worst;
  j->unresolved = sqrt(run.unresolved);
  j->stiff = run.stiff;
  if (run.rk) gsl_odeiv2_step_free(run.rk);
  rot_radau_free(run.radau);
  rot_dense_free(&run.dense);
  free(run.form);
  free(scratch);
  return info->status;
}

/* ---- the error estimate ---------------------------------------------------------------------- */

/* Largest difference of each component between two runs, where both have a step's end, at those on
 * either side of a row. */
static void differences(const rot_ode_params *p, const mesh *coarse, const mesh *fine, int forward,
                        size_t first, size_t rows, const double time_s[], double mend,
                        double y_rows[], double apart[]) {
  const double way = forward ? 1.0 : -1.0;
  size_t f = 0, row = 0;
  const double *last[2] = {NULL, NULL}; /* the pair before */
  double last_s = 0.0;
  for (size_t c = 0; c < coarse->count && row < rows; c++) {
    const double *a = mesh_node(coarse, c);
    while (f < fine->count && way * (mesh_node(fine, f)[0] - a[0]) < 0.0) f++;
    if (f == fine->count) break;
    const double *b = mesh_node(fine, f);
    if (a[0] != b[0]) continue;
    int seen_here = 0, seen_before = 0;
    while (row < rows) {
      const size_t at = forward ? first + row : first + rows - 1 - row;
      const double t = time_s[at];
      if (way * (t - a[0]) > 0.0) break;
      const double weight = last[0] ? (t - last_s) / (a[0] - last_s) : 1.0;
      for (size_t i = 0; mend > 0.0 && i < p->dim; i++) {
        const double before = last[0] ? last[1][i] - last[0][i] : 0.0, now = b[2 + i] - a[2 + i];
        y_rows[at * p->dim + i] += mend * (before + weight * (now - before));
      }
      seen_here = 1;
      seen_before = seen_before || t != a[0];
      row++;
    }
    for (size_t i = 0; i < p->dim; i++) {
      const double now = fabs(a[2 + i] - b[2 + i]);
      if (seen_here && !(now <= apart[i])) apart[i] = now;
      if (seen_before && last[0] && !(fabs(last[0][i] - last[1][i]) <= apart[i])) {
        apart[i] = fabs(last[0][i] - last[1][i]);
      }
    }
    last_s = a[0];
    last[0] = a + 2;
    last[1] = b + 2;
  }
}

/* Where a step meets a kink of the right-hand side, halving it gains little, and the two runs may
 * even err alike: their distance missed the error by up to 6 in a tenth of 60 motions on torque
 * curves; twice the distance and four times the test's figure missed one of 600, by 1.3. */
#define KINK_MARGIN 2.0

/* The fine run's error is its distance from the coarse one over 2^8 - 1; where its own error tests
 * fell by less than 2^8, so did the error; that part is mended in
 * the rows. Four times it, for steps that are not short. In the last
 * digits the distance is rounding, which no halving makes less. */
#define MARGIN 4.0
static double part_of_distance(const job *coarse, const job *fine, double rounding_share) {
  if (fine->p->kinks) return KINK_MARGIN;
  const double fell = coarse->worst > 0.0 ? fine->worst / coarse->worst : 0.0;
  const double order = fine->method == ROT_METHOD_RADAU ? 1.0 / 63.0 : 1.0 / 255.0;
  return fmin(1.0, MARGIN * fmax(order, fell) + rounding_share);
}

static double estimate(const job *coarse, const job *fine, const rot_info *info,
                       double rounding_share, double error[]) {
  const rot_ode_params *p = fine->p;
  const double part = part_of_distance(coarse, fine, rounding_share);
  const double mend = !p->turn && fine->method == ROT_METHOD_RK8PD ? 1.0 / 255.0 : 0.0;
  const double resolve = (p->kinks ? 4.0 : 1.0) * fine->unresolved;
  double worst = 0.0;
  memset(error, 0, p->dim * sizeof *error);
  for (int forward = 0; forward < 2; forward++) {
    const size_t first = forward ? fine->before : 0;
    const size_t before = fine->before < info->rows_done ? fine->before : info->rows_done;
    const size_t rows = forward ? info->rows_done - before : before;
    if (rows) {
      differences(p, &coarse->trace[forward], &fine->trace[forward], forward, first, rows,
                  fine->time_s, mend, fine->y_rows, error);
    }
  }
  for (size_t i = 0; i < p->dim; i++) {
    error[i] = part * error[i] + fine->share[i] + resolve * fine->largest[i] +
               4.0 * ROT_EPS * sqrt(1.0 + (double)info->steps) * fine->largest[i];
    if (i < p->controlled && fine->largest[i] > 0.0) {
      worst = fmax(worst, error[i] / fine->largest[i]);
    }
  }
  return worst;
}

/* Of a coarse run that failed, the steps that lead to the last row it reached. */
static void cut_meshes(const job *coarse, size_t *n) {
  mesh *m = &coarse->trace[1];
  const double reached = m->count ? mesh_node(m, m->count - 1)[0] : -INFINITY;
  while (*n > coarse->before && coarse->time_s[*n - 1] > reached) --*n;
  if (*n > coarse->before) {
    while (m->count > 1 && mesh_node(m, m->count - 2)[0] >= coarse->time_s[*n - 1]) m->count--;
  }
}

static int by_time(rot_events *events) {
  for (size_t i = 1; events && i < events->count; i++) {
    for (size_t j = i; j > 0 && events->time_s[j] < events->time_s[j - 1]; j--) {
      const double t = events->time_s[j];
      const rot_event e = events->event[j];
      events->time_s[j] = events->time_s[j - 1];
      events->event[j] = events->event[j - 1];
      events->time_s[j - 1] = t;
      events->event[j - 1] = e;
    }
  }
  return 0;
}

/* The run that chooses the steps, and with them the method. */
static rot_status choose_steps(job *coarse, double tolerance, const rot_hooks *hooks,
                               rot_info *info) {
  const rot_method wanted = coarse->p->method;
  coarse->method = wanted == ROT_METHOD_RADAU ? wanted : ROT_METHOD_RK8PD;
  coarse->stiff = wanted == ROT_METHOD_NONE;
  coarse->tolerance = tolerance;
  if (coarse->method == ROT_METHOD_RK8PD) {
    run_once(coarse, hooks, info);
    if (!coarse->stiff) return info->status;
  }
  /* Its error test is that of order 5, the result has order 9. */
  coarse->stiff = 0;
  coarse->method = ROT_METHOD_RADAU;
  coarse->tolerance = fmin(1e-3, pow(tolerance, 6.0 / 9.0));
  run_once(coarse, hooks, info);
  if (info->status == ROT_ESTEP && wanted == ROT_METHOD_NONE) {
    coarse->method = ROT_METHOD_RK8PD;
    coarse->tolerance = tolerance;
    run_once(coarse, hooks, info);
  }
  return info->status;
}

enum { MOST_HALVINGS = 4 };

rot_status rot_ode_run(const rot_ode_params *p, size_t n, const double time_s[], double y[],
                       double slope[], double error[], double largest[], const rot_hooks *hooks,
                       rot_info *info) {
  gsl_set_error_handler_off(); /* process-wide, and aborts by default: at every entry */
  mesh meshes[2][2];
  double *scratch = calloc(2 * p->dim + 1, sizeof *scratch);
  double tolerance = fmin(MOST_TOLERANCE, fmax(LEAST_TOLERANCE, 10.0 * p->accuracy));
  job coarse;
  memset(meshes, 0, sizeof meshes);
  memset(&coarse, 0, sizeof coarse);
  rot_info_clear(info);
  info->status = scratch ? ROT_OK : ROT_ENOMEM;
  coarse.p = p;
  coarse.time_s = time_s;
  coarse.n = n;
  while (coarse.before < n && time_s[coarse.before] < p->start_s) coarse.before++;
  coarse.trace = meshes[0];
  coarse.largest = scratch;
  coarse.budget = p->max_steps / 2;
  if (info->status == ROT_OK && n) choose_steps(&coarse, tolerance, hooks, info);
  const rot_info failure = *info;
  if (scratch) memcpy(largest, scratch, p->dim * sizeof *largest);
  if (info->status != ROT_OK) cut_meshes(&coarse, &coarse.n);

  const int hopeless = info->status == ROT_EUNWIND || info->status == ROT_ENOMEM ||
                       (info->status != ROT_OK && coarse.trace[1].count == 0);
  double last = INFINITY;
  for (int k = 0; k < MOST_HALVINGS && n && !hopeless; k++) {
    job fine = coarse;
    fine.guide = coarse.trace;
    fine.trace = meshes[(k + 1) % 2];
    fine.y_rows = y;
    fine.slope_rows = slope;
    fine.largest = largest;
    fine.share = scratch + p->dim;
    fine.budget = p->max_steps;
    fine.tolerance = coarse.tolerance / (coarse.method == ROT_METHOD_RADAU ? 8.0 : 32.0);
    run_once(&fine, hooks, info);
    if (info->status == ROT_EUNWIND || info->status == ROT_ENOMEM) break;
    /* A step's rounding beside what its error test allows. */
    const double share = 4e-15 / tolerance;
    const double worst = estimate(&coarse, &fine, info, share, error);
    if (info->status != ROT_OK || worst <= p->accuracy || share > 0.3 || worst > 0.5 * last ||
        info->steps > p->max_steps / 2) {
      break;
    }
    last = worst;
    tolerance /= 256.0;
    fine.guide = NULL;
    coarse = fine;
  }
  if (failure.status != ROT_OK && info->status == ROT_OK) {
    info->status = failure.status;
    info->time_s = failure.time_s;
  }
  if (hopeless) info->rows_done = 0;
  if (p->turn) by_time(p->turn->events);
  for (int k = 0; k < 4; k++) free(meshes[k / 2][k % 2].data);
  free(scratch);
  return info->status;
}
