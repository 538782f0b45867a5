#include "engine/ode/advance.h"

#include <math.h>
#include <stdint.h>
#include <string.h>

#include "engine/ode/norm.h"
#include "ground/real.h"

enum { PARTS = 3 };               /* into which a finer run divides a step */
enum { STEPS_PER_POLL = 4 };      /* a look at the clock is 25 ns, a step 350 ns and more */
enum { REJECTED_PER_CHECK = 16 }; /* whether the right-hand side repeats itself */
/* The error test of rk8pd ignores the first so many calls of an attempt beside its given slope.
 * Where one of them meets another law, the later ones lie beside the motion. */
enum { UNWEIGHED = 4 };

/* A run that has to end here. */
static rot_status end_here(rot_ode_stepping *run, rot_status why) {
  run->info->time_s = run->clock.t;
  return why;
}

/* By how much the progress may grow; of steady steps 10 for what the start excites. */
enum { PROGRESS_STEPS = 10000, PROGRESS_FACTOR = 1000, STEADY_FACTOR = 10 };

/* 1 if the rest of the budget ends far before the run does: see rot_ode_params.fades_s. */
static int is_out_of_reach(rot_ode_stepping *run, size_t tried) {
  const rot_ode_progress was = run->progress;
  const double t = run->clock.t;
  const double settles_s = run->p->settles_s;
  const int settled = settles_s > 0.0 && fabs(t - run->p->start_s) > settles_s;
  if (!(run->p->fades_s > 0.0 || settled) || run->p->n_breaks || run->reference.trace) return 0;
  if (tried < was.tried + PROGRESS_STEPS) return 0;
  run->progress = (rot_ode_progress){tried, t};
  const double periods = (double)(run->budget - tried) / PROGRESS_STEPS;
  const double to_end = fabs(run->clock.end - t);
  const double left = settled ? to_end : fmin(run->p->fades_s, to_end);
  return left / (run->p->steady ? STEADY_FACTOR : PROGRESS_FACTOR) > periods * fabs(t - was.t);
}

/* Before a step: the budget, and every so many steps the caller. */
static rot_status may_go_on(rot_ode_stepping *run, size_t steps_per_poll, double fraction) {
  const size_t tried = run->info->steps + run->info->rejected;
  if (tried >= run->budget || is_out_of_reach(run, tried)) return end_here(run, ROT_EBUDGET);
  return tried % steps_per_poll == 0 ? rot_poll(run->hooks, fraction) : ROT_OK;
}

/* ---- the end of a step ----------------------------------------------------------------------- */

rot_status rot_ode_add_node(rot_ode_stepping *run) {
  if (run->trajectory) {
    run->trajectory->slid = run->trajectory->slid || run->law.slides != NO_SURFACE;
    const rot_status status = rot_ode_trajectory_node(run->trajectory, run->p, run->clock.t,
                                                      run->state.y, run->state.slope);
    if (status != ROT_OK) return status;
  }
  return rot_ode_rows_node(&run->rows);
}

/* A slope that belongs to a state off the manifold by less than a part of what a step may err is
 * kept. */
static rot_status project(rot_ode_stepping *run) {
  const rot_ode_params *p = run->p;
  rot_ode_state *state = &run->state;
  double *moved = run->scratch;
  if (!p->project) return ROT_OK;
  memcpy(moved, state->y, p->dim * sizeof *moved);
  p->project(run->clock.t, state->y, p->ctx);
  for (size_t i = 0; i < p->dim; i++) moved[i] = state->y[i] - moved[i];
  for (size_t m = 0; m < rot_ode_measures(p); m++) {
    const rot_ode_group g = rot_ode_group_of(p, m);
    const double size = fmax(state->largest[m], rot_ode_size(g, state->y));
    const double by = rot_ode_difference(g, state->y, moved);
    if (!(by <= 16.0 * ROT_EPS * size)) run->errors->moved[m] += by;
    if (!(rot_ode_rate(g, moved) <= 1e-3 * run->step.tolerance * size)) state->slope_known = 0;
  }
  return rot_ode_know_slope(&run->law, state);
}

static void cover_calls(rot_ode_probes *probes, rot_ode_calls *calls, size_t controlled) {
  for (size_t k = UNWEIGHED; k < calls->count; k++) {
    const double *call = calls->data + k * (1 + controlled);
    rot_ode_probes_cover(probes, call[0], call + 1);
  }
  calls->count = 0;
}

static void swap(double **a, double **b) {
  double *was = *a;
  *a = *b;
  *b = was;
}

/* Over an implicit step, much longer than stiff motions, these fade. */
static const double *rounds_of(const rot_ode_stepping *run) {
  return run->step.method == ROT_METHOD_RADAU ? NULL : run->p->rounds;
}

/* Each component by one, and by that of its slope over the step h, up or down. */
static void move_by_roundings(rot_ode_stepping *run, double h) {
  const rot_ode_params *p = run->p;
  const double *rounds = rounds_of(run);
  for (size_t m = 0; m < rot_ode_steering(p); m++) {
    const rot_ode_group g = rot_ode_group_of(p, m);
    const double size[] = {ROT_EPS * rot_ode_rounds(g, run->state.y, g.first),
                           ROT_EPS * rot_ode_rounds(g, run->state.y, g.first + 1)};
    const double slope = rounds ? rounds[m] * fabs(h) : 0.0;
    for (size_t i = g.first; i < g.first + g.count; i++) {
      const double by = size[i > g.first] + slope;
      /* Multiplier: L'Ecuyer, Mathematics of Computation 68 (1999) 249, table 4. */
      run->rounding = run->rounding * UINT64_C(2862933555777941757) + 1;
      run->state.y[i] += run->rounding >> 63 ? by : -by;
    }
  }
}

/* The trial, projected, becomes the state at t, and goes to all that follows the run. */
static rot_status accept(rot_ode_stepping *run, double t, double error) {
  enum { BLOCK = 512 };
  rot_ode_state *state = &run->state;
  if (run->rows.probes) cover_calls(run->rows.probes, &run->step.calls, run->p->controlled);
  swap(&state->y, &run->step.trial);
  swap(&state->slope, &run->step.trial_slope);
  if (run->rounding && run->law.slides == NO_SURFACE) move_by_roundings(run, t - run->clock.t);
  run->clock.t = t;
  state->slope_known = 1;
  rot_status status = project(run);
  if (status != ROT_OK) return status;
  for (size_t m = 0; m < rot_ode_measures(run->p); m++) {
    const double size = rot_ode_size(rot_ode_group_of(run->p, m), state->y);
    state->largest[m] = fmax(state->largest[m], size);
  }
  run->info->steps++;
  status = rot_ode_trace_add(run->trace, t, error, state->y);
  if (status == ROT_OK) status = rot_ode_add_node(run);
  if (status != ROT_OK) return status;
  return run->rows.dense.count >= BLOCK ? rot_ode_fill_rows(&run->rows, 0) : ROT_OK;
}

rot_status rot_ode_rest_until(rot_ode_stepping *run, double stop, int *broke_loose) {
  const double whole = stop - run->clock.t;
  const double max = whole / (isfinite(whole) ? (run->reference.trace ? 8.0 : 4.0) : 1.0);
  double h = max, end;
  *broke_loose = 0;
  while (run->clock.t != stop && !*broke_loose) {
    rot_status status = may_go_on(run, 1, 0.0);
    if (status == ROT_OK) status = rot_ode_hold(&run->rest, stop, whole, &h, &end, broke_loose);
    if (status == ROT_OK && !isnan(end)) {
      status = accept(run, end, 0.0);
      h = copysign(fmin(fabs(max), 2.0 * fabs(h)), whole);
    }
    if (status != ROT_OK) return status;
  }
  return ROT_OK;
}

/* ---- the length of steps --------------------------------------------------------------------- */

typedef struct step_plan {
  double h, target; /* target: the time at its end */
  int as_wished;    /* not cut short by a target */
} step_plan;

/* The step that time will really take: rounding t each time lost 4e-14 in 300 steps. */
static step_plan step_by(double t, double h) {
  const double taken = (t + h) - t;
  return (step_plan){taken, t + taken, 0};
}

/* Steps of one length since the smooth segment began: counted, so that no rounding gathers. */
static step_plan plan_fixed(const rot_ode_stepping *run, double stop) {
  const double t = run->clock.t, from = run->rows.segment_t, h = run->step.fixed_s;
  const double direction = rot_ode_direction(&run->clock);
  const double target = from + direction * h * (floor(fabs(t - from) / h + 1e-6) + 1.0);
  if (fabs(stop - t) <= fabs(target - t) + 1e-6 * h) return (step_plan){stop - t, stop, 0};
  return (step_plan){target - t, target, 0};
}

static step_plan plan_step(rot_ode_stepping *run, double stop) {
  const double t = run->clock.t, left = stop - t, wish = run->step.h, size = fabs(wish);
  const double reference_end = rot_ode_reference_aim(&run->reference, stop);
  if (run->step.fixed_s > 0.0) {
    const step_plan plan = plan_fixed(run, stop);
    return fabs(plan.h) > run->limit ? step_by(t, copysign(run->limit, left)) : plan;
  }
  if (fabs(reference_end - t) > run->limit) return step_by(t, copysign(run->limit, left));
  if (!isnan(reference_end)) return (step_plan){reference_end - t, reference_end, 0};
  /* The last step lands on the target; the one before it is halved rather than leave a sliver. */
  if (size >= fabs(left) * (1.0 - 1e-10)) return (step_plan){left, stop, 0};
  const double aim = size > 0.5 * fabs(left) ? 0.5 * left : copysign(size, left);
  step_plan plan = step_by(t, aim);
  plan.as_wished = aim == wish;
  return plan;
}

/* What the error test makes of the next step, by the ratio of this one. */
static double scaled(const rot_ode_stepping *run, double ratio) {
  const double order = run->step.method == ROT_METHOD_RADAU ? ROT_RADAU_ERROR_ORDER + 1.0 : 8.0;
  return 0.9 * pow(ratio, -1.0 / order);
}

/* `why`: ROT_ERHS, or what a step too short means. The state may be about to leave the doubles. */
static rot_status reject(rot_ode_stepping *run, double h, double factor, rot_status why) {
  const double t = run->clock.t;
  rot_ode_state *state = &run->state;
  run->info->rejected++;
  run->step.h = h * factor;
  run->limit = fabs(run->step.h);
  if (run->info->rejected % REJECTED_PER_CHECK == 0) {
    const rot_status repeats = rot_ode_check_repeats(&run->law, state, run->scratch);
    if (repeats != ROT_OK) return repeats;
  }
  /* As short as time can be resolved, or rounded back to what was just rejected. */
  const double next = fabs((t + run->step.h) - t);
  if (next > 0.0 && next < fabs(h)) return ROT_OK;
  if (state->phase == ROT_ODE_LEAVING && run->p->turn->holds > 0.0) { /* driven by rounding: held */
    run->rest.grace = t + 1e-9 * (run->clock.end - t);
    *run->p->mode = 0;
    state->phase = ROT_ODE_HELD;
    state->slope_known = 0;
    return ROT_OK;
  }
  for (size_t i = 0; i < run->p->controlled && why == ROT_ERHS; i++) {
    if (fabs(state->y[i]) > 1e300 || fabs(state->slope[i]) > 1e300) why = ROT_ERANGE;
  }
  return why == ROT_ERHS ? why : end_here(run, why); /* time_s is where rhs failed */
}

/* ---- what a step passes ---------------------------------------------------------------------- */

/* *ratio becomes that of a step that was cut at a surface. */
static rot_status look_for_events(rot_ode_stepping *run, double *h, rot_ode_passage *what,
                                  size_t *which, double *ratio) {
  const double whole = *h;
  const rot_status status = rot_ode_look_for_events(&run->search, h, what, which);
  if (status != ROT_OK) return status;
  if (*what == ROT_ODE_OTHER_SIDE) {
    const size_t surface = rot_ode_surface_of(&run->search, *which);
    const int side = run->search.watch[*which].side;
    if (surface != NO_SURFACE) {
      run->law.side[surface] = side;
    } else {
      run->state.phase = ROT_ODE_LEAVING;
      *run->p->mode = side;
    }
    run->state.slope_known = 0;
    run->info->rejected++; /* the budget ends a motion that changes sides for ever */
    *what = ROT_ODE_TRY_SHORTER;
    *which = SIZE_MAX;
  }
  if (run->law.surfaces->count && *h != whole) *ratio = rot_ode_trial_ratio(&run->step, *h);
  return ROT_OK;
}

/* After a search that began with so many surfaces: the side of one that was added. */
static rot_status join_surface(rot_ode_stepping *run, size_t known, rot_status searched,
                               int *added) {
  rot_status status = searched;
  *added = run->law.surfaces->count != known;
  if (status != ROT_OK || !*added) return status;
  status = rot_ode_choose_side(&run->law, &run->state, known);
  if (run->law.slides == known) {
    rot_ode_propagation_hold(run->propagation, run->law.surfaces->surface[known].component);
  }
  if (status == ROT_OK) status = rot_ode_know_slope(&run->law, &run->state);
  /* That alone: an event that was just met has a zero here that is no new one. */
  if (status == ROT_OK) rot_ode_arm_last(&run->search);
  return rot_ode_may_retry(status) ? ROT_OK : status;
}

/* The rows so far lie on unknown sides of a surface that was added since: filled without it. */
static rot_status close_rows(rot_ode_stepping *run) {
  run->law.surfaces->count--;
  rot_status status = rot_ode_fill_rows(&run->rows, 1);
  run->law.surfaces->count++;
  rot_ode_rows_begin(&run->rows);
  run->state.slope_known = 0;
  if (status == ROT_OK) status = rot_ode_know_slope(&run->law, &run->state);
  return status == ROT_OK ? rot_ode_add_node(run) : status;
}

/* The step over h failed its error test, or was no step (`tried`). */
static rot_status refuse(rot_ode_stepping *run, double h, double ratio, rot_status tried) {
  const size_t surfaces = run->law.surfaces->count;
  if (isnan(run->kinks.before)) {
    int added;
    rot_status status = rot_ode_look_for_kink(&run->kinks, h, ratio, tried == ROT_ESTEP);
    status = join_surface(run, surfaces, status, &added);
    if (status != ROT_OK) return status;
    if (added || !isnan(run->kinks.before)) {
      run->info->rejected++;
      return ROT_OK;
    }
  }
  const double less = isfinite(ratio) ? fmax(0.1, scaled(run, ratio)) : 0.1;
  return reject(run, h, less, tried == ROT_OK ? ROT_ESTEP : tried);
}

/* Whether rhs may change its law where nothing marks it. Where it does not, steps whose error does
 * not fall are of two motions that have parted, as chaotic ones do. */
static int may_bend(const rot_ode_params *p) { return p->kinks || p->resolution > 0.0; }

static void note_error(rot_ode_stepping *run, double error, int unresolved) {
  rot_ode_errors *e = run->errors;
  e->found += error;
  for (size_t m = rot_ode_steering(run->p); m < rot_ode_measures(run->p); m++) {
    e->missed[m] += rot_ode_rate(rot_ode_group_of(run->p, m), run->step.trial_error);
  }
  if (!unresolved) return;
  /* Radau's test is that of order 5, its result of order 9. */
  const double missed = run->step.method == ROT_METHOD_RADAU ? pow(error, 1.2) : error;
  e->unresolved += missed * missed;
}

rot_status rot_ode_advance(rot_ode_stepping *run, double stop, double fraction,
                           rot_ode_passage *what, size_t *which) {
  rot_ode_state *state = &run->state;
  rot_ode_stepper *step = &run->step;
  const double t = run->clock.t;
  *what = ROT_ODE_TRY_SHORTER;
  rot_status status = may_go_on(run, STEPS_PER_POLL, fraction);
  if (status == ROT_OK) status = rot_ode_know_slope(&run->law, state);
  if (status != ROT_OK) return status;
  const step_plan plan = plan_step(run, isnan(run->kinks.before) ? stop : run->kinks.before);
  double h = plan.h;
  if (t + h == t) return end_here(run, ROT_ESTEP);
  status = rot_ode_attempt(step, t, h, state->y, state->slope);
  const int ends = run->step.fixed_s > 0.0 || !rot_ode_may_retry(status);
  if (status != ROT_OK && ends) return status;
  double ratio = status == ROT_OK ? rot_ode_trial_ratio(step, h) : NAN;
  /* Beyond a surface the step is no step of the motion, and its error none: up to the surface. */
  const int early = status == ROT_OK && ratio > 1.0 && rot_ode_passes_surface(&run->search);
  if (early) run->info->rejected++;
  if (!early && !(ratio <= 1.0)) return refuse(run, h, ratio, status); /* NaN fails */
  status = look_for_events(run, &h, what, which, &ratio);
  if (status != ROT_OK && !rot_ode_may_retry(status)) return status;
  if (status == ROT_OK && *what == ROT_ODE_TRY_SHORTER && !state->slope_known) return ROT_OK;
  if (early && (status != ROT_OK || *what == ROT_ODE_TRY_SHORTER || !(ratio <= 1.0))) {
    *what = ROT_ODE_TRY_SHORTER;
    return reject(run, h, 0.5, status == ROT_OK ? ROT_ESTEP : status);
  }
  if (status != ROT_OK) return reject(run, plan.h, 0.5, status);
  if (*what == ROT_ODE_TRY_SHORTER) return reject(run, plan.h, 0.1, ROT_ESTEP);
  const double error = ratio * step->tolerance;
  const int unresolved = rot_ode_is_unresolved(&run->reference, error);
  if (unresolved && may_bend(run->law.p) && run->law.slides == NO_SURFACE &&
      isnan(run->kinks.before)) {
    const size_t surfaces = run->law.surfaces->count;
    int added;
    status = join_surface(run, surfaces, rot_ode_look_for_surface(&run->kinks, h), &added);
    if (status != ROT_OK) return status;
    if (added) {
      run->info->rejected++;
      *what = ROT_ODE_TRY_SHORTER;
      return close_rows(run);
    }
  }
  note_error(run, error, unresolved);
  run->limit = INFINITY;
  state->phase = *what == ROT_ODE_CUT_SHORT ? ROT_ODE_CUT : ROT_ODE_MOVING;
  const double grow = ratio > 0.0 ? scaled(run, ratio) : 5.0;
  /* Up to a surface or to an event before it, which may be within a rounding of t. */
  const double base = early ? copysign(fmax(fabs(h), 1e-3 * fabs(plan.h)), h) : plan.h;
  const double wish = base * fmin(5.0, fmax(0.5, grow));
  if (run->law.stiffness && rot_ode_is_stiff(&run->stiffness, plan.h, run->clock.end - t)) {
    state->phase = ROT_ODE_STIFF;
  }
  /* A step cut short by a target says nothing against the longer one. */
  if (fabs(wish) > fabs(step->h) || plan.as_wished) step->h = wish;
  /* t + h may be rounded beyond the target. */
  const int whole =
      *what == ROT_ODE_SAME_SIDE || rot_ode_is_before(&run->clock, plan.target, t + h);
  status = accept(run, whole ? plan.target : t + h, error);
  if (status == ROT_OK && run->propagation) {
    const rot_ode_propagation_of of = {run->clock.t - t,
                                       step->trial,
                                       step->trial_slope,
                                       PARTS,
                                       rot_ode_rows_within(&run->rows.out, t, run->clock.t),
                                       rounds_of(run)};
    status = rot_ode_propagation_step(run->propagation, &run->law, state, run->trajectory, &of);
  }
  return status == ROT_OK && run->clock.t == run->kinks.before ? rot_ode_pass_kink(&run->kinks)
                                                               : status;
}
