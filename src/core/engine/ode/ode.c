#include "engine/ode/ode.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "engine/ode/collocate.h"
#include "engine/ode/difference.h"
#include "engine/ode/fixed.h"
#include "engine/ode/rounding.h"
#include "engine/ode/stepping.h"
#include "engine/ode/norm.h"
#include "ground/real.h"

#define MIN_TOLERANCE 1e-13 /* finer steps than half of these: rounding is all one sees */
#define MIN_FINE      1e-13 /* of a reference run: below, its error test may reject rounding */
#define MAX_TOLERANCE 3e-3

/* ---- the error estimate ---------------------------------------------------------------------- */

/* Where a step meets a kink of the right-hand side, halving it gains little, and the two runs may
 * even err alike: their distance missed the error by up to 6 in a tenth of 60 motions on torque
 * curves; twice the distance and four times the test's figure missed one of 600, by 1.3. */
#define KINK_MARGIN    2.0
/* Steps that end on a surface are no equal parts of each other. */
#define SURFACE_MARGIN 10.0

/* Kinks that no break marks. */
static int has_kinks(const rot_ode_job *j) { return j->p->kinks || j->kinks->missed; }

/* At accuracies above this the steps are too long for the order that the gain assumes: with the
 * margins of finer ones, and differences at the rows alone, the estimate missed the error of 17
 * and 26 of the 100 scenes of check_estimate_of_one_row() at 1e-2 and 1e-4, by up to 410 times; now
 * that of 2 each, by up to 2.5. */
#define LOOSE 3e-6

/* The fine run's error is its distance from the coarse one over gain - 1, or more where its own
 * error tests `fell` by less than the gain; that part is corrected in the rows. Four times it, for
 * steps that are not short; 2.5 times where the gain is 3^8 or more. In the last digits the
 * distance is rounding: no finer run makes it less. */
static double part_of_distance(const rot_ode_job *fine, double ratio, double rounding_fraction,
                               double fell) {
  if (has_kinks(fine)) return KINK_MARGIN;
  const double part = fmax(1.0 / rot_ode_gain(fine->method, ratio), fell);
  const int radau = fine->method == ROT_METHOD_RADAU;
  const double margin = !radau && fine->p->accuracy > LOOSE ? 12.0
                        : radau || ratio < 3.0              ? 4.0
                                                            : 2.5;
  const double surfaces = fine->surfaces->count ? SURFACE_MARGIN : 1.0;
  /* Long implicit steps may pass a weak kink of a called law that their error tests do not show. */
  const double min = fine->p->expensive && fine->method == ROT_METHOD_RADAU ? 1.0 : 0.0;
  if (part >= 0.5) return 1.0;
  return fmax(min, fmin(1.0, surfaces * margin * part / (1.0 - part) + rounding_fraction));
}

/* No step is shortened for an integral: along 14 and 27 of them, errors of several steps cancelled
 * in the distance of two runs and not in the work, which was off by 9 and 5 times its estimate. The
 * distance counts as no less than this part of what the error test found in all steps. */
#define MISSED_PART (1.0 / 32.0)

/* Beyond this relative difference the two runs may be different motions, whose distance does not
 * fall as the error of a step does: it counts alone, and a finer run shows whether it falls. At
 * loose accuracies (LOOSE) a smaller one: of 1000 driven pendulums (bench/coverage/equations.R,
 * seed 20261) the truth exceeded the figure in 11, by up to 132 times, where 0.03 and 300
 * accuracies were needed; now in 2, by 1.2, for 9 % more calls. */
static double lost_difference(double accuracy) { return accuracy > LOOSE ? 0.003 : 0.03; }

/* What rounding makes of a measure. */
static double roundings_of(const rot_ode_job *j, size_t m, size_t steps, double size) {
  const double each = 4.0 * ROT_EPS * sqrt(1.0 + (double)steps) * size;
  if (!j->propagation || m >= rot_ode_steering(j->p)) return each;
  const double grown = j->propagation->worst[m];
  /* Where it grows by ten decades, the motions of two runs grow differently. */
  return fmax(each, (grown > 1e-6 * size && !j->propagation->seen ? 10.0 : 3.0) * grown);
}

/* Without events that change the law, the rows of a fine run of rk8pd take a part of its distance
 * from the coarse one. */
static int corrections(const rot_ode_job *fine) {
  const rot_ode_params *p = fine->p;
  return fine->method == ROT_METHOD_RK8PD && !p->turn && (p->n_events == 0 || !p->mode);
}

/* In front of a row, where the two runs are compared, too: half a swing or so. */
enum { PLACES = 4 };

/* Implicit steps' tests filter stiff modes out. Where they show less than this part of a distance,
 * it is the distance that falls, with the order of the stages, 5, and the tests may be rounding. */
#define FILTERED 0.01

/* What two runs say of the finer one. */
typedef struct estimated {
  double worst;    /* of the groups the largest error relative to the size */
  double steps;    /* what of it finer steps would lessen */
  double rounding; /* part of the distance that is rounding, there */
  int lost;        /* see above */
  int unknown; /* moved by their roundings, motions are as far from each other as they are long */
} estimated;

/* `rounding`: part of a distance that is rounding, if the error falls with the order. distance[]:
 * that of the two runs before, 0 if there are none, becomes that of these. => error[] */
static estimated estimate(const rot_ode_job *coarse, const rot_ode_job *fine, const rot_info *info,
                          double rounding, double change[], double distance[], double error[]) {
  const rot_ode_params *p = fine->p;
  const double ratio = (double)fine->parts / (double)coarse->parts;
  estimated found = {0.0, 0.0, rounding, 0, 0};
  const double correction =
      corrections(fine) ? 1.0 / (rot_ode_gain(fine->method, ratio) - 1.0) : 0.0;
  /* Most steps whose error does not fall meet a kink that was not found; fewer where one was. */
  const double resolve = (fine->surfaces->count ? 1.5 : 3.0) * fine->errors.unresolved;
  memset(error, 0, rot_ode_measures(p) * sizeof *error);
  for (int forward = 0; forward < 2; forward++) {
    const size_t first = forward ? fine->rows.before : 0;
    const size_t before = fine->rows.before < info->rows_done ? fine->rows.before : info->rows_done;
    const size_t rows = forward ? info->rows_done - before : before;
    rot_ode_differences(&coarse->trace[forward], &fine->trace[forward], fine, forward, first, rows,
                        PLACES, correction, change, error);
  }
  for (size_t m = 0; m < rot_ode_steering(p); m++) {
    const double difference = error[m] / fine->largest[m];
    found.lost = found.lost || difference > lost_difference(p->accuracy);
  }
  for (size_t m = 0; m < rot_ode_measures(p); m++) {
    const int integral = m >= rot_ode_steering(p);
    const double size = fine->largest[m];
    const double roundings = roundings_of(fine, m, info->steps, size);
    const rot_ode_errors *first = &coarse->errors, *last = &fine->errors;
    double of_first = first->found, of_last = last->found, rounded = rounding;
    if (fine->method == ROT_METHOD_RADAU) {
      rounded = fmin(rounded, roundings / error[m]);
      if (distance[m] > 0.0 && of_last * size < FILTERED * error[m]) {
        of_first = distance[m] / ratio;
        of_last = error[m];
      }
    } else if (integral && !found.lost) {
      error[m] = fmax(error[m], MISSED_PART * first->missed[m]);
      of_first = first->missed[m];
      of_last = last->missed[m];
    }
    const double fell = of_first > 0.0 ? of_last / of_first / ratio : 0.0;
    const double part = found.lost ? 1.0 : part_of_distance(fine, ratio, rounded, fell);
    distance[m] = error[m];
    const double lessened = fmax(0.0, part - rounded) * error[m] + resolve * size;
    error[m] = part * error[m] + last->fraction[m] + last->moved[m] + resolve * size + roundings;
    if (integral || size == 0.0) continue;
    found.steps = fmax(found.steps, lessened / size);
    found.unknown |= fine->propagation && fine->propagation->seen && roundings >= size;
    if (error[m] / size > found.worst) found.rounding = rounded;
    found.worst = fmax(found.worst, error[m] / size);
  }
  return found;
}

/* Of a coarse run that failed, the steps that lead to the last row it reached. */
static void cut_traces(const rot_ode_job *coarse, size_t *n) {
  rot_ode_trace *m = &coarse->trace[1];
  const double reached = m->count ? rot_ode_node(m, m->count - 1)[0] : -INFINITY;
  while (*n > coarse->rows.before && coarse->rows.time_s[*n - 1] > reached) --*n;
  if (*n > coarse->rows.before) {
    while (m->count > 1 && rot_ode_node(m, m->count - 2)[0] >= coarse->rows.time_s[*n - 1])
      m->count--;
  }
}

/* Nothing more is to be called. */
static int is_over(rot_status status) { return status == ROT_EUNWIND || status == ROT_ENOMEM; }

static void run_with(rot_ode_job *coarse, rot_method method, double tolerance, int stiff,
                     const rot_hooks *hooks, rot_info *info) {
  coarse->method = method;
  coarse->tolerance = tolerance;
  coarse->stiff = stiff;
  rot_ode_run_once(coarse, hooks, info);
}

/* The run that chooses the steps, and with them the method. */
static void choose_steps(rot_ode_job *coarse, double tolerance, const rot_hooks *hooks,
                         rot_info *info) {
  const int any = coarse->p->method == ROT_METHOD_NONE;
  if (coarse->p->method != ROT_METHOD_RADAU) {
    run_with(coarse, ROT_METHOD_RK8PD, tolerance, any, hooks, info);
    if (!coarse->stiff) return;
  }
  /* Its error test is that of order 5, the result has order 9. */
  run_with(coarse, ROT_METHOD_RADAU, fmin(1e-3, pow(tolerance, 6.0 / 9.0)), 0, hooks, info);
  if (info->status == ROT_ESTEP && any) {
    run_with(coarse, ROT_METHOD_RK8PD, tolerance, 0, hooks, info);
  }
}

static int compare(const void *a, const void *b) {
  const double x = *(const double *)a, y = *(const double *)b;
  return (x > y) - (x < y);
}

/* *split as p, with the kinks added to its breaks; both in one array, the kinks' own. */
static rot_status split_at_kinks(const rot_ode_params *p, rot_ode_kinks *kinks,
                                 rot_ode_params *split) {
  const size_t n = kinks->count + p->n_breaks;
  double *time_s = realloc(kinks->time_s, (n ? n : 1) * sizeof *time_s);
  if (!time_s) return ROT_ENOMEM;
  kinks->time_s = time_s;
  if (p->n_breaks) memcpy(time_s + kinks->count, p->breaks, p->n_breaks * sizeof *time_s);
  qsort(time_s, n, sizeof *time_s, compare);
  split->breaks = time_s;
  split->n_breaks = n;
  return ROT_OK;
}

/* Of finer runs; of those that lessen the error by FAST, as implicit steps do where stiff modes
 * reduce their order. */
enum { MAX_RUNS = 4, MAX_FAST_RUNS = 10 };
#define FAST 0.1

/* The tolerance of the run that chooses the steps, and into how many parts the next divides them:
 * three where the error of the first run is then still small against the motion. The factors are
 * what an error test may grow to in most motions, less the margin and the gain of the parts. */
static size_t first_parts(const rot_ode_params *p, double *tolerance) {
  const int three = p->accuracy <= 3e-7 && !p->kinks && p->method != ROT_METHOD_RADAU;
  const double factor = three ? 256.0 : p->accuracy > LOOSE ? 5.0 : 10.0;
  *tolerance = fmin(MAX_TOLERANCE, fmax(MIN_TOLERANCE, factor * p->accuracy));
  return three ? 3 : 2;
}

/* Of a loosely solved motion collocation takes as many calls as a finer run, some 1300 over 20 s at
 * 1e-7; at 1e-9 it takes two thirds. */
#define COLLOCATED_ACCURACY 5e-8

/* Whether the result may come from collocation, instead of a finer run. */
static int collocates(const rot_ode_params *p, const rot_ode_propagation *propagation) {
  return p->expensive && propagation && p->accuracy <= COLLOCATED_ACCURACY && !p->kinks &&
         p->method != ROT_METHOD_RADAU && p->controlled <= ROT_ODE_MAX_COLLOCATED &&
         p->dim <= ROT_ODE_MAX_COLLOCATED_ALL && p->n_groups == 0 && !p->turn && p->n_events == 0 &&
         !p->project && !p->at_break;
}

/* The result by collocation in the steps of the coarse run; 0: there is none. */
static int collocate(const rot_ode_job *coarse, const rot_hooks *hooks, rot_info *info) {
  const rot_ode_output *out = &coarse->rows;
  int good;
  info->status = rot_ode_collocate(coarse->p, coarse->trajectory, coarse->surfaces, out,
                                   coarse->probes, hooks, info, &good);
  if (!good) return 0;
  for (size_t m = 0; m < coarse->p->dim; m++) {
    out->error[m] += roundings_of(coarse, m, info->steps, out->largest[m]);
  }
  info->rows_done = out->n;
  info->time_s = out->time_s[out->n - 1];
  if (coarse->probes) rot_ode_probes_sift(coarse->probes, out->error);
  return 1;
}

/* The result by finer runs, of which the first divides the steps of the coarse one into `parts`.
 * `scratch`: dim, the distances, then twice the integrals of the last two, then twice dim.
 * => 1: it is unknown, and no steps would say more. */
static int refine(rot_ode_job coarse, size_t parts, double tolerance, int stepwise,
                  rot_ode_trace traces[2][2], double *scratch, const rot_hooks *hooks,
                  rot_info *info) {
  const rot_ode_params *p = coarse.p;
  const rot_ode_trace *reference = coarse.trace;
  const rot_ode_output out = coarse.rows;
  const double first = coarse.tolerance;
  double *distance = scratch + p->dim;
  double last = INFINITY;
  int stalls = 0; /* runs in succession without gain: at one, that before may have been the worse */
  for (int k = 0; k < MAX_FAST_RUNS; k++) {
    /* Not where the coarse run is kept: it may be a finer run than the first. */
    const size_t other = coarse.trace == traces[0];
    rot_ode_job fine = coarse;
    fine.reference = reference;
    fine.parts = parts;
    fine.trace = traces[other];
    fine.rows.slope =
        corrections(&fine) ? NULL : out.slope; /* slopes are those of the rows as they stay */
    fine.largest = out.largest;
    fine.errors.missed = scratch + (2 + other) * p->dim;
    fine.budget = p->max_steps;
    fine.tolerance = fmax(MIN_FINE, 8.0 * first / rot_ode_gain(fine.method, (double)parts));
    if (k == 0 && info->status == ROT_OK && rot_ode_roundings_rule(&coarse)) {
      rot_ode_see_roundings(&coarse, &fine, traces, scratch + 4 * p->dim, scratch, hooks, info);
      if (is_over(info->status)) return 0;
    }
    for (size_t i = 0; out.slope && i < out.n; i++) out.slope[i] = NAN;
    rot_ode_run_once(&fine, hooks, info);
    if (is_over(info->status)) return 0;
    /* A step's rounding beside what its error test allows. */
    const double fraction =
        4e-15 * rot_ode_gain(ROT_METHOD_RK8PD, (double)coarse.parts) / tolerance;
    const estimated now = estimate(&coarse, &fine, info, fraction, scratch, distance, out.error);
    const double gained = now.worst / last;
    stalls = gained > 0.5 ? stalls + 1 : 0;
    if (coarse.probes) {
      rot_ode_probes_sift(coarse.probes, out.error);
      if (coarse.probes->n_sights) return now.unknown; /* other steps are needed */
    }
    if (info->status != ROT_OK || now.worst <= p->accuracy || now.rounding > 0.3 || stalls == 2 ||
        now.unknown || now.steps < 0.5 * now.worst || (k + 1 >= MAX_RUNS && !(gained < FAST))) {
      return now.unknown;
    }
    last = now.lost ? INFINITY : now.worst;
    const double ratio = pow(1.0 + 2.0 * now.steps / p->accuracy, 1.0 / 8.0);
    const double more = stepwise ? 2.0 : fmin(4.0, ratio);
    const size_t next = (size_t)fmax(ceil(more * (double)parts), (double)parts + 1.0);
    if (info->steps * next > p->max_steps * parts) return 0;
    parts = next;
    if (coarse.probes) rot_ode_probes_uncover(coarse.probes);
    if (stepwise || now.lost) coarse = fine;
  }
  return 0;
}

/* One choice of steps and what follows from it, with the surfaces known so far. *unknown: no other
 * choice would say more. */
static rot_status solve(const rot_ode_params *p, rot_ode_surfaces *surfaces, rot_ode_probes *probes,
                        const rot_ode_output *out, int *unknown, const rot_hooks *hooks,
                        rot_info *info) {
  const size_t dim = p->dim;
  rot_ode_trace traces[3][2] = {
      {{.count = 0}}}; /* of the run that chose the steps, of the last two */
  rot_ode_trajectory tracks[2] = {{.slid = 0}};
  double *scratch = calloc(10 * dim + 1, sizeof *scratch), tolerance;
  size_t parts = first_parts(p, &tolerance);
  rot_ode_kinks kinks = {0, 0, NULL, 0};
  rot_ode_params split = *p;
  rot_ode_job coarse = {.p = p,
                        .rows = *out,
                        .budget = p->max_steps / 2,
                        .parts = 1,
                        .trace = traces[0],
                        .kinks = &kinks,
                        .surfaces = surfaces,
                        .propagation = rot_ode_propagation_alloc(p),
                        .probes = probes,
                        .largest = scratch,
                        .first_mode = p->mode ? *p->mode : 0};
  info->status = scratch ? ROT_OK : ROT_ENOMEM;
  if (collocates(p, coarse.propagation)) coarse.trajectory = tracks;
  if (scratch) {
    coarse.errors.fraction = scratch + dim;
    coarse.errors.moved = scratch + 2 * dim;
    coarse.errors.missed = scratch + 3 * dim;
    if (out->n) choose_steps(&coarse, tolerance, hooks, info);
    memcpy(out->largest, scratch, rot_ode_measures(p) * sizeof *scratch);
  }
  const int explicit = coarse.method == ROT_METHOD_RK8PD;
  if (explicit && kinks.count) {
    const rot_status status = split_at_kinks(p, &kinks, &split);
    if (status != ROT_OK) info->status = status;
    coarse.p = &split;
  }
  const rot_info chosen = *info;
  if (chosen.status != ROT_OK) {
    cut_traces(&coarse, &coarse.rows.n);
  } else if (p->fine_propagation && coarse.method == ROT_METHOD_RADAU) {
    coarse.probes = NULL; /* its polynomials are too unsure of steep rates for a small figure */
  } else if (probes && out->n) {
    rot_ode_probes_range(probes, traces[0]);
  }
  const int stepwise = !explicit || has_kinks(&coarse);
  if (stepwise) {
    parts = 2;
  } else if (surfaces->count) {
    parts++; /* for SURFACE_MARGIN */
  }
  int hopeless = is_over(chosen.status) || (chosen.status != ROT_OK && traces[0][1].count == 0);
  int solved = out->n == 0 || hopeless;
  if (coarse.trajectory && !solved && chosen.status == ROT_OK && !stepwise && !kinks.count) {
    solved = collocate(&coarse, hooks, info);
    hopeless = !solved && info->status != ROT_OK;
  }
  coarse.trajectory = NULL;
  if (!solved && !hopeless) {
    *unknown =
        refine(coarse, parts, tolerance, stepwise, traces + 1, scratch + 4 * dim, hooks, info);
  }
  if (chosen.status != ROT_OK && info->status == ROT_OK) {
    info->status = chosen.status;
    info->time_s = chosen.time_s;
  }
  if (hopeless) info->rows_done = 0;
  /* Backward runs log in reverse. */
  const rot_status sorted = p->log ? rot_events_sort(p->log) : ROT_OK;
  if (sorted != ROT_OK) info->status = sorted;
  for (int k = 0; k < 6; k++) free(traces[k / 2][k % 2].data);
  for (int k = 0; k < 2; k++) rot_ode_trajectory_free(&tracks[k]);
  rot_ode_propagation_free(coarse.propagation);
  free(kinks.time_s);
  free(scratch);
  return info->status;
}

/* ---- what the probes saw --------------------------------------------------------------------- */

/* Choices of steps, each with the surfaces and breaks that the probes of the one before found. */
enum { MAX_ROUNDS = 8 };

typedef struct stops {
  size_t count;
  double *time_s;
} stops;

static rot_status add_stop(stops *s, double t) {
  size_t at = 0;
  while (at < s->count && s->time_s[at] < t) at++;
  if (at < s->count && s->time_s[at] == t) return ROT_OK;
  double *more = realloc(s->time_s, (s->count + 1) * sizeof *more);
  if (!more) return ROT_ENOMEM;
  memmove(more + at + 1, more + at, (s->count - at) * sizeof *more);
  more[at] = t;
  s->time_s = more;
  s->count++;
  return ROT_OK;
}

/* surfaces where the law changes between the places that it was seen at, or a break there. */
static rot_status look_at_sights(const rot_ode_params *p, const rot_ode_probes *probes,
                                 rot_ode_surfaces *surfaces, stops *breaks, rot_info *info) {
  double break_s[ROT_ODE_MAX_SIGHTS];
  rot_status status = rot_ode_look_at_sights(p, probes, surfaces, break_s, info);
  for (size_t k = 0; k < probes->n_sights && status == ROT_OK; k++) {
    if (!isnan(break_s[k])) status = add_stop(breaks, break_s[k]);
  }
  return status;
}

static int is_accurate(const rot_ode_params *p, const double error[], const double largest[]) {
  int good = 1;
  for (size_t m = 0; m < rot_ode_steering(p); m++) good &= error[m] <= p->accuracy * largest[m];
  return good;
}

rot_status rot_ode_run(const rot_ode_params *p, size_t n, const double time_s[], double y[],
                       double slope[], double error[], double largest[], const rot_hooks *hooks,
                       rot_info *info) {
  rot_ode_surfaces surfaces;
  rot_ode_params now = *p;
  stops breaks = {0, NULL};
  rot_ode_probes *probes = NULL;
  const int first_mode = p->mode ? *p->mode : 0;
  rot_status status = ROT_OK;
  int unknown = 0;
  rot_ode_output out = {n, 0, time_s, y, slope, error, largest};
  surfaces.count = 0;
  while (out.before < n && time_s[out.before] < p->start_s) out.before++;
  rot_ode_clear_report(info);
  info->rhs_calls = 0;
  if (p->step_s > 0.0) return rot_ode_run_fixed(p, &out, hooks, info);
  if (p->resolution > 0.0 && p->resolution < 1.0) {
    probes = rot_ode_probes_new(p);
    if (!probes) status = ROT_ENOMEM;
    for (size_t k = 0; k < p->n_breaks && status == ROT_OK; k++) {
      status = add_stop(&breaks, p->breaks[k]);
    }
    if (status != ROT_OK) info->status = status;
  }
  for (int round = 0; status == ROT_OK; round++) {
    const size_t known = surfaces.count;
    if (p->mode) *p->mode = first_mode;
    if (probes) rot_ode_probes_clear(probes);
    const int before = unknown;
    unknown = 0;
    status = solve(&now, &surfaces, probes, &out, &unknown, hooks, info);
    const size_t sights = probes ? probes->n_sights : 0;
    /* A run that meets a surface unprepared may be far from the next one, which knows it. */
    const int unprepared = surfaces.count > known && !is_accurate(p, error, largest);
    if (status != ROT_OK || (sights == 0 && !unprepared)) break;
    /* Unknown with the surfaces of the round before, too: no other would help. */
    if (round == MAX_ROUNDS || (before && unknown)) {
      for (size_t k = 0; k < sights; k++) error[probes->sight[k].measure] += probes->sight[k].worth;
      break;
    }
    if (sights == 0) continue;
    status = look_at_sights(&now, probes, &surfaces, &breaks, info);
    if (status != ROT_OK) info->status = status;
    now.breaks = breaks.time_s;
    now.n_breaks = breaks.count;
  }
  rot_ode_probes_free(probes);
  free(breaks.time_s);
  return status;
}
