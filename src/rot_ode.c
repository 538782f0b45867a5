#include "rot_ode.h"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_odeiv2.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "rot_real.h"

enum { STEPS_PER_POLL = 4 }; /* a look at the clock is 25 ns, a step 350 ns and more */

#define LEAST_TOLERANCE 1e-13 /* its companion runs at 1e-15: below, rounding is all one sees */
#define LEAST_SIZE                                                                                 \
  1e-290 /* below, doubles have no 16 digits left that an error test could ask for */
#define MARGIN        1.1 /* on the companion's difference, 0.957 to 1.026 of the error */
#define MARGIN_FILLED 4.0 /* where it sees 64 of the rows filled in, seldom the worst: up to 3 */

/* Nodes of one smooth stretch: t, y[dim], f[dim] of each accepted step. */
typedef struct node_list {
  double *data;
  size_t count, room;
} node_list;

/* One run at one tolerance. */
typedef struct ode_run {
  const rot_ode_params *p;
  const rot_hooks *hooks;
  rot_info *info;
  gsl_odeiv2_step *step;
  gsl_odeiv2_system system;
  double tolerance;
  double cap;           /* no step is longer */
  double longest;       /* accepted step so far */
  double shortest_wish; /* of the error test, after an accepted step */
  double t, h;          /* h: the step that the error test would like next */
  double after, before; /* rhs is evaluated strictly inside (break, next break) */
  int slope_known;      /* slope holds f(t, y) */
  int wild;             /* rhs was not finite in the last trial */
  rot_status status;    /* of the last rhs call */
  double *y, *trial, *trial_error, *slope, *trial_slope; /* dim each */
  node_list nodes; /* kept where rows are filled in between steps */
  int filling;     /* rows may be filled in */
  int keep_nodes;  /* they are, on this side of the start */
  double *largest; /* the caller's: size of each component so far */
} ode_run;

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
  return GSL_SUCCESS;
}

/* Error of the trial step over what is allowed; NaN if it makes no sense. */
static double trial_ratio(const ode_run *run) {
  double ratio = 0.0;
  for (size_t i = 0; i < run->p->controlled; i++) {
    const double error = fabs(run->trial_error[i]);
    /* Of its size so far, never of its size later: where errors grow with the motion, what is
     * small against the end is all there is at the start. */
    const double scale = fmax(LEAST_SIZE, fmax(run->largest[i], fabs(run->trial[i])));
    if (!isfinite(run->trial[i])) return NAN;
    if (error != 0.0 && !(error / (run->tolerance * scale) <= ratio)) {
      ratio = error / (run->tolerance * scale);
    }
  }
  return ratio;
}

static void accept(ode_run *run, double t) {
  double *swap = run->y;
  run->y = run->trial;
  run->trial = swap;
  swap = run->slope;
  run->slope = run->trial_slope;
  run->trial_slope = swap;
  run->t = t;
  for (size_t i = 0; i < run->p->dim; i++) {
    run->largest[i] = fmax(run->largest[i], fabs(run->y[i]));
  }
  run->info->steps++;
}

static const double *node_at(const ode_run *run, size_t i) {
  return run->nodes.data + i * (1 + 2 * run->p->dim);
}

static rot_status add_node(ode_run *run) {
  const size_t dim = run->p->dim, stride = 1 + 2 * dim;
  node_list *nodes = &run->nodes;
  if (nodes->count == nodes->room) {
    const size_t room = nodes->room ? 2 * nodes->room : 64;
    double *data = realloc(nodes->data, room * stride * sizeof *data);
    if (!data) return ROT_ENOMEM;
    nodes->data = data;
    nodes->room = room;
  }
  double *node = nodes->data + nodes->count++ * stride;
  node[0] = run->t;
  memcpy(node + 1, run->y, dim * sizeof *node);
  memcpy(node + 1 + dim, run->slope, dim * sizeof *node);
  return ROT_OK;
}

/* y at a time between nodes i and i + 1: the Hermite polynomial through values and slopes of the
 * four nodes around, of degree 7 (of less where there are fewer). Its error is of the order of the
 * method's own, and the companion, which lands on rows, sees both. */
static void between_nodes(const ode_run *run, size_t i, double t, double out[]) {
  const size_t dim = run->p->dim, count = run->nodes.count, m = count < 4 ? count : 4;
  const size_t first = i < 1 ? 0 : i - 1 + m > count ? count - m : i - 1;
  const double *y0 = node_at(run, i) + 1;
  const double width = m > 1 ? node_at(run, first + m - 1)[0] - node_at(run, first)[0] : 1.0;
  memcpy(out, y0, dim * sizeof *out);
  for (size_t j = 0; j < m; j++) {
    const double *node = node_at(run, first + j);
    const double x = (t - node[0]) / width;
    double l = 1.0, s = 0.0; /* Lagrange's polynomial at t, its slope at the node */
    for (size_t k = 0; k < m; k++) {
      if (k == j) continue;
      const double apart = (node[0] - node_at(run, first + k)[0]) / width;
      l *= (t - node_at(run, first + k)[0]) / width / apart;
      s += 1.0 / apart;
    }
    const double value = (1.0 - 2.0 * x * s) * l * l, slope = x * l * l * width;
    for (size_t c = 0; c < dim; c++) {
      out[c] += (node[1 + c] - y0[c]) * value + node[1 + dim + c] * slope;
    }
  }
}

/* Why no step is short enough: the right-hand side is not finite, or the state is about to be. */
static rot_status why_wild(const ode_run *run) {
  for (size_t i = 0; i < run->p->controlled; i++) {
    if (fabs(run->y[i]) > 1e300 || fabs(run->slope[i]) > 1e300) return ROT_ERANGE;
  }
  return ROT_ETORQUE;
}

/* Integrate to a time with no break in between. */
static rot_status drive(ode_run *run, double target, double fraction) {
  const rot_ode_params *p = run->p;
  while (run->t != target) {
    const double left = target - run->t;
    const size_t tried = run->info->steps + run->info->rejected;
    if (tried >= p->max_steps) {
      run->info->time_s = run->t;
      return ROT_EBUDGET;
    }
    if (tried % STEPS_PER_POLL == 0) {
      rot_status status = rot_poll(run->hooks, fraction);
      if (status != ROT_OK) return status;
    }
    run->wild = 0;
    if (!run->slope_known) {
      if (rhs_for_gsl(run->t, run->y, run->slope, run) != GSL_SUCCESS) {
        return run->wild ? ROT_ETORQUE : run->status;
      }
      run->slope_known = 1;
    }
    /* The last step lands on the target; the one before it is halved rather than leave a sliver. */
    const double size = fmin(fabs(run->h), run->cap);
    const int last = size >= fabs(left) * (1.0 - 1e-10);
    const double aim = size > 0.5 * fabs(left) ? 0.5 * left : copysign(size, left);
    /* The step that time will really take: rounding t each time lost 4e-14 in 300 steps. */
    const double h = last ? left : (run->t + aim) - run->t;
    if (run->t + h == run->t) {
      run->info->time_s = run->t;
      return ROT_ESTEP;
    }
    memcpy(run->trial, run->y, p->dim * sizeof *run->y);
    int code = gsl_odeiv2_step_apply(run->step, run->t, h, run->trial, run->trial_error, run->slope,
                                     run->trial_slope, &run->system);
    if (code != GSL_SUCCESS && !run->wild) return run->status != ROT_OK ? run->status : ROT_ENOMEM;
    const double ratio = run->wild ? NAN : trial_ratio(run);
    if (ratio <= 1.0) { /* NaN fails */
      const double grow = ratio > 0.0 ? 0.9 * pow(ratio, -1.0 / 8.0) : 5.0;
      const double wish = h * fmin(5.0, fmax(0.5, grow));
      accept(run, last ? target : run->t + h);
      if (run->keep_nodes && add_node(run) != ROT_OK) return ROT_ENOMEM;
      run->longest = fmax(run->longest, fabs(h));
      run->shortest_wish = fmin(run->shortest_wish, fabs(wish));
      /* A step cut short by a target says nothing against the longer one. */
      if (fabs(wish) > fabs(run->h) || (!last && aim == run->h)) run->h = wish;
    } else {
      run->info->rejected++;
      run->h = h * (isfinite(ratio) ? fmax(0.1, 0.9 * pow(ratio, -1.0 / 8.0)) : 0.1);
      /* As short as time can be resolved, or rounded back to what was just rejected. */
      const double next = fabs((run->t + run->h) - run->t);
      if (!(next > 0.0 && next < fabs(h))) {
        const rot_status why = run->wild ? why_wild(run) : ROT_ESTEP;
        if (why != ROT_ETORQUE) run->info->time_s = run->t; /* else it is where the torque failed */
        return why;
      }
    }
  }
  return ROT_OK;
}

/* Some of the rows, and a state at each. */
enum { SAMPLE_ROWS = 64 };
typedef struct row_sample {
  size_t rows, row[SAMPLE_ROWS];
  double time_s[SAMPLE_ROWS];
  double *y; /* SAMPLE_ROWS of dim */
} row_sample;

/* At most `most` of the first n rows: the last always, the first if it lies before the start. */
static void choose_rows(row_sample *sample, const rot_ode_params *p, size_t most, size_t n,
                        const double time_s[]) {
  most = most < 1 ? 1 : most > SAMPLE_ROWS ? SAMPLE_ROWS : most;
  sample->rows = n < most ? n : most;
  for (size_t j = 0; j < sample->rows; j++) {
    sample->row[j] = (size_t)((double)(j + 1) * (double)n / (double)sample->rows + 0.5) - 1;
  }
  if (sample->rows > 1 && time_s[0] < p->start_s) sample->row[0] = 0;
  for (size_t j = 0; j < sample->rows; j++) sample->time_s[j] = time_s[sample->row[j]];
}

/* The way outward from the start: the next break, and the side of it that rhs may see. */
typedef struct way {
  int forward;
  double outward; /* +Inf or -Inf */
  size_t k;       /* breaks[k] is next forward, breaks[k - 1] backward */
  double *near, *far;
} way;

static way set_out(ode_run *run, const double time_s[], size_t first, size_t last, int forward) {
  const rot_ode_params *p = run->p;
  way w = {forward, forward ? INFINITY : -INFINITY, 0, NULL, NULL};
  w.near = forward ? &run->after : &run->before;
  w.far = forward ? &run->before : &run->after;
  memcpy(run->y, p->start, p->dim * sizeof *run->y);
  run->t = p->start_s;
  run->h = (time_s[forward ? last - 1 : first] - p->start_s) / 100.0;
  run->slope_known = 0;
  run->after = -INFINITY;
  run->before = INFINITY;
  while (w.k < p->n_breaks && (forward ? p->breaks[w.k] <= run->t : p->breaks[w.k] < run->t)) w.k++;
  const int on_break = forward ? w.k > 0 && p->breaks[w.k - 1] == run->t
                               : w.k < p->n_breaks && p->breaks[w.k] == run->t;
  if (on_break) *w.near = nextafter(run->t, w.outward);
  return w;
}

/* The next break, +-Inf if there is none; rhs stays on this side of it. */
static double next_break(const ode_run *run, way *w) {
  const int more = w->forward ? w->k < run->p->n_breaks : w->k > 0;
  const double stop = more ? run->p->breaks[w->forward ? w->k : w->k - 1] : w->outward;
  *w->far = more ? nextafter(stop, -w->outward) : w->outward;
  return stop;
}

static void cross_break(ode_run *run, way *w, double stop) {
  *w->near = nextafter(stop, w->outward);
  run->slope_known = 0;
  w->k = w->forward ? w->k + 1 : w->k - 1;
}

/* All rows on one side of the start, with a step that ends at each. */
static rot_status land_on_rows(ode_run *run, const double time_s[], size_t first, size_t last,
                               int forward, double y_rows[]) {
  const size_t total = last - first, dim = run->p->dim;
  way w = set_out(run, time_s, first, last, forward);
  for (size_t done = 0; done < total; done++) {
    const size_t row = forward ? first + done : last - 1 - done;
    const double fraction = (double)done / (double)total;
    for (;;) {
      const double stop = next_break(run, &w);
      if (forward ? time_s[row] < stop : time_s[row] > stop) break;
      rot_status status = drive(run, stop, fraction);
      if (status != ROT_OK) return status;
      cross_break(run, &w, stop);
    }
    rot_status status = drive(run, time_s[row], fraction);
    if (status != ROT_OK) return status;
    memcpy(y_rows + row * dim, run->y, dim * sizeof *run->y);
    if (forward) run->info->rows_done = row + 1;
    run->info->time_s = run->t;
  }
  return ROT_OK;
}

/* The same with the steps that the error test allows, three at least from break to break, and the
 * rows filled in between them. */
static rot_status fill_rows(ode_run *run, const double time_s[], size_t first, size_t last,
                            int forward, double y_rows[]) {
  const size_t total = last - first, dim = run->p->dim;
  const double cap = run->cap, end = time_s[forward ? last - 1 : first];
  const double whole = end - run->p->start_s;
  way w = set_out(run, time_s, first, last, forward);
  rot_status status = ROT_OK;
  size_t done = 0;
  while (status == ROT_OK && done < total) {
    const double at_break = next_break(run, &w);
    const int breaks = forward ? at_break < end : at_break > end;
    const double stop = breaks ? at_break : end;
    run->nodes.count = 0;
    if (!run->slope_known) {
      if (rhs_for_gsl(run->t, run->y, run->slope, run) != GSL_SUCCESS) {
        return run->wild ? ROT_ETORQUE : run->status;
      }
      run->slope_known = 1;
    }
    status = add_node(run);
    run->cap = fmin(cap, fabs(stop - run->t) / 3.0);
    if (status == ROT_OK)
      status = drive(run, stop, whole != 0.0 ? (run->t - run->p->start_s) / whole : 0.0);
    size_t i = 0;
    while (done < total) {
      const size_t row = forward ? first + done : last - 1 - done;
      const double t = time_s[row];
      if (forward ? t > run->t : t < run->t) break;
      while (i + 2 < run->nodes.count &&
             (forward ? node_at(run, i + 1)[0] <= t : node_at(run, i + 1)[0] >= t)) {
        i++;
      }
      between_nodes(run, i, t, y_rows + row * dim);
      if (forward) run->info->rows_done = row + 1;
      done++;
    }
    if (status == ROT_OK) {
      run->info->time_s = run->t;
      if (breaks) cross_break(run, &w, stop);
    }
  }
  run->cap = cap;
  return status;
}

static rot_status sweep(ode_run *run, const double time_s[], size_t first, size_t last, int forward,
                        double y_rows[]) {
  if (last == first) return ROT_OK;
  run->keep_nodes = run->filling && last - first > SAMPLE_ROWS;
  return run->keep_nodes ? fill_rows(run, time_s, first, last, forward, y_rows)
                         : land_on_rows(run, time_s, first, last, forward, y_rows);
}

/* How one run is made, and what it did with its steps. */
typedef struct run_plan {
  double tolerance, cap;         /* in: per step; longest step */
  int filling;                   /* in: many rows may be filled in between steps */
  double longest, shortest_wish; /* out: longest step taken; shortest that the error test wished */
} run_plan;

/* One run: rows of y at the times, and the largest size of each component. */
static rot_status run_once(const rot_ode_params *p, run_plan *plan, size_t n, const double time_s[],
                           double y_rows[], double largest[], const rot_hooks *hooks,
                           rot_info *info) {
  ode_run run = {0};
  double *scratch = calloc(5 * p->dim, sizeof *scratch);
  size_t before = 0;
  rot_info_clear(info);
  info->tolerance = plan->tolerance;
  run.p = p;
  run.hooks = hooks;
  run.info = info;
  run.tolerance = plan->tolerance;
  run.cap = plan->cap;
  run.filling = plan->filling;
  run.shortest_wish = INFINITY;
  run.largest = largest;
  for (size_t i = 0; i < p->dim; i++) largest[i] = fabs(p->start[i]);
  run.step = gsl_odeiv2_step_alloc(gsl_odeiv2_step_rk8pd, p->dim);
  info->status = scratch && run.step ? ROT_OK : ROT_ENOMEM;
  if (info->status == ROT_OK) {
    run.y = scratch;
    run.trial = scratch + p->dim;
    run.trial_error = scratch + 2 * p->dim;
    run.slope = scratch + 3 * p->dim;
    run.trial_slope = scratch + 4 * p->dim;
    run.system = (gsl_odeiv2_system){rhs_for_gsl, NULL, p->dim, &run};
    while (before < n && time_s[before] < p->start_s) before++;
    info->status = sweep(&run, time_s, 0, before, 0, y_rows);
  }
  if (info->status == ROT_OK) {
    info->rows_done = before;
    info->status = sweep(&run, time_s, before, n, 1, y_rows);
  }
  plan->longest = run.longest;
  plan->shortest_wish = run.shortest_wish;
  if (run.step) gsl_odeiv2_step_free(run.step);
  free(run.nodes.data);
  free(scratch);
  return info->status;
}

/* ---- the error estimate --------------------------------------------------------------------- */

/* The companion's difference is the error of whichever of the two is worse, so their steps must
 * differ: runs with the same steps, which dense rows make them take, differ by nothing.
 *
 * Finer: a hundredth of the tolerance, and no step longer than 0.55 of the run's longest. At order
 * 8 that is a hundredth of its error: the difference is the run's.
 * Coarser: where every step was cut short by a row, and 1.8 times the longest would have passed the
 * error test, the companion takes those. It costs a fraction; the difference is its own error, and
 * the run's is less. */
enum { COARSER_ROWS = 8 }; /* rows of the run for one that the coarser companion visits */
#define FINER_STEP   0.55
#define COARSER_STEP 1.8

/* error[i]: largest difference of component i between the run and its companion. Returns the worst
 * of the controlled ones relative to their largest size. */
static double compare(const rot_ode_params *p, double margin, const double y[], const row_sample *c,
                      size_t rows, const double largest[], double steps, double error[]) {
  double worst = 0.0;
  for (size_t i = 0; i < p->dim; i++) {
    double difference = 0.0;
    for (size_t j = 0; j < rows; j++) {
      difference = fmax(difference, fabs(y[c->row[j] * p->dim + i] - c->y[j * p->dim + i]));
    }
    error[i] = margin * difference + 4.0 * ROT_EPS * sqrt(1.0 + steps) * largest[i];
    if (i < p->controlled && largest[i] > 0.0) worst = fmax(worst, error[i] / largest[i]);
  }
  return worst;
}

rot_status rot_ode_run(const rot_ode_params *p, size_t n, const double time_s[], double y[],
                       double error[], double largest[], const rot_hooks *hooks, rot_info *info) {
  gsl_set_error_handler_off(); /* process-wide, and aborts by default: at every entry */
  double *scratch = calloc((1 + SAMPLE_ROWS) * p->dim, sizeof *scratch);
  row_sample other;
  double tolerance = fmax(LEAST_TOLERANCE, 0.1 * p->accuracy);
  size_t rhs_calls = 0;
  rot_info_clear(info);
  info->status = scratch ? ROT_OK : ROT_ENOMEM;
  other.y = scratch;
  double *unused = scratch + SAMPLE_ROWS * p->dim;
  int coarser = 1, filling = n > SAMPLE_ROWS; /* try those first */
  while (info->status == ROT_OK) {
    rot_info report;
    run_plan plan = {tolerance, INFINITY, filling, 0.0, 0.0};
    run_once(p, &plan, n, time_s, y, largest, hooks, info);
    rhs_calls += info->rhs_calls;
    if (info->status == ROT_EUNWIND || info->status == ROT_ENOMEM) break;

    /* Of a run that failed, the rows that it reached are worth an error figure too. */
    const size_t reached = info->rows_done;
    double worst = INFINITY;
    coarser =
        coarser && reached <= SAMPLE_ROWS && plan.shortest_wish >= COARSER_STEP * plan.longest;
    for (; worst > p->accuracy; coarser = 0) {
      const size_t most = coarser ? reached / COARSER_ROWS : SAMPLE_ROWS;
      run_plan with = {coarser ? tolerance : 0.01 * tolerance,
                       coarser ? INFINITY : FINER_STEP * plan.longest, 0, 0.0, 0.0};
      choose_rows(&other, p, most, reached, time_s);
      run_once(p, &with, other.rows, other.time_s, other.y, unused, hooks, &report);
      rhs_calls += report.rhs_calls;
      if (report.status == ROT_OK || !coarser) {
        worst = compare(p, filling ? MARGIN_FILLED : MARGIN, y, &other, report.rows_done, largest,
                        (double)info->steps, error);
      }
      if (!coarser || report.status == ROT_EUNWIND) break;
    }
    if (report.status != ROT_OK) {
      info->status = report.status;
      info->time_s = report.time_s;
      info->rows_done = report.rows_done ? other.row[report.rows_done - 1] + 1 : 0;
    }
    if (worst <= p->accuracy || (tolerance <= LEAST_TOLERANCE && !filling)) break;
    if (tolerance <= LEAST_TOLERANCE) filling = 0; /* the last digits: land on every row */
    tolerance = fmax(LEAST_TOLERANCE, 0.01 * tolerance);
  }
  info->rhs_calls = rhs_calls;
  free(scratch);
  return info->status;
}
