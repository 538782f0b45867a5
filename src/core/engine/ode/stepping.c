#include "engine/ode/stepping.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "engine/ode/norm.h"
#include "ground/real.h"

/* ---- segments ------------------------------------------------------------------------------- */

/* Integrating backward, stick and slip swap. */
static rot_status log_event(const rot_ode_stepping *run, rot_event event) {
  const int stick = event == ROT_EVENT_STICK, swaps = stick || event == ROT_EVENT_SLIP;
  if (!run->clock.forward && swaps) event = stick ? ROT_EVENT_SLIP : ROT_EVENT_STICK;
  return rot_events_add(run->p->log, run->clock.t, event);
}

/* A drive within the rounding of the time of its zero: that of some roundings later, and its
 * direction is a guess. */
static rot_status look_beyond_rounding(rot_ode_stepping *run, double *drive, int *guess) {
  const double beyond = rot_ode_direction(&run->clock) * 8.0 * ROT_EPS * fabs(run->clock.t);
  double later, unused;
  const rot_status status = rot_ode_held_slope(&run->rest, run->clock.t + beyond, &later, &unused);
  if (status != ROT_OK) return status;
  *guess = !(later * *drive > 0.0);
  if (*guess) *drive = later;
  return ROT_OK;
}

/* Of the group that has this component. */
static double largest_of(const rot_ode_stepping *run, size_t component) {
  size_t m = 0;
  rot_ode_group g = rot_ode_group_of(run->p, m);
  while (component >= g.first + g.count) g = rot_ode_group_of(run->p, ++m);
  return run->state.largest[m];
}

/* At rest and not driven, now or a step later: a motion that fades, which reaches zero by rounding
 * alone and never passes it. It goes on within the rounding. */
static rot_status is_still(rot_ode_stepping *run, double drive, int *still) {
  double later = drive, unused;
  rot_status status = ROT_OK;
  if (drive == 0.0) {
    status = rot_ode_held_slope(&run->rest, run->clock.t + run->step.h, &later, &unused);
  }
  *still = status == ROT_OK && later == 0.0;
  return rot_ode_may_retry(status) ? ROT_OK : status;
}

/* The mode of a switch from here on. `was`: the mode before, 2 at the start of a run. */
static rot_status choose_mode(rot_ode_stepping *run, int was) {
  const rot_ode_switch *turn = run->p->turn;
  int *mode = run->p->mode;
  run->step.noise = 0.0;
  run->state.phase = ROT_ODE_MOVING;
  if (!turn) return ROT_OK;
  const double w = run->state.y[turn->watched];
  run->state.slope_known = 0;
  if (w != 0.0) {
    *mode = w > 0.0 ? 1 : -1;
    return ROT_OK;
  }
  double drive, excess;
  *mode = 0;
  rot_status status = rot_ode_held_slope(&run->rest, run->clock.t, &drive, &excess);
  if (status != ROT_OK) return status;
  if (turn->holds > 0.0 && excess <= 0.0) {
    run->state.phase = ROT_ODE_HELD;
    return was == 1 || was == -1 ? log_event(run, ROT_EVENT_STICK) : ROT_OK;
  }
  int guess = drive == 0.0, still = 0;
  const double rounding = ROT_EPS * largest_of(run, turn->watched);
  if ((was == 1 || was == -1) && rounding > 0.0) status = is_still(run, drive, &still);
  if (still) {
    run->state.y[turn->watched] = was * rounding;
    *mode = was;
    return status;
  }
  if (status == ROT_OK && turn->holds == 0.0 && !guess)
    status = look_beyond_rounding(run, &drive, &guess);
  const int direction = drive > 0.0 ? 1 : drive < 0.0 ? -1 : was == 1 ? -1 : 1;
  const int chosen = run->clock.forward || drive == 0.0 ? direction : -direction;
  run->state.phase = guess ? ROT_ODE_UNDECIDED : ROT_ODE_LEAVING;
  if (turn->holds > 0.0) { /* in the other direction nothing cancels: the rounding of the slope */
    double unused;
    *mode = -chosen;
    status = rot_ode_held_slope(&run->rest, run->clock.t, &drive, &unused);
    run->step.noise = fabs(run->step.trial_slope[turn->watched]);
  }
  *mode = chosen;
  if (status == ROT_OK && was == 0) status = log_event(run, ROT_EVENT_SLIP);
  if (status == ROT_OK && was == -chosen) status = log_event(run, ROT_EVENT_REVERSE);
  return status;
}

/* Radau's first step would pass over a transient, and the error test of its end would not see it;
 * rows within it, and what theta gains in it, would be wrong. Where a segment begins further from
 * its quick equilibrium than the accuracy, the first step is a twentieth of the transient. */
static rot_status resolve_transient(rot_ode_stepping *run) {
  const rot_ode_params *p = run->p;
  const rot_ode_state *state = &run->state;
  rot_ode_stepper *s = &run->step;
  double *y = s->trial, *rise = s->trial_slope;
  if (s->method != ROT_METHOD_RADAU || run->reference.trace) return ROT_OK;
  const rot_ode_group all = {0, p->controlled, ROT_ODE_VECTOR};
  const double max = rot_ode_rate(all, state->slope), size = rot_ode_size(all, state->y);
  if (!(max > 0.0 && isfinite(max))) return ROT_OK;
  /* Along the motion itself, far enough for the difference to have digits. */
  const double direction = rot_ode_direction(&run->clock), h = fabs(s->h);
  const double d = fmin(h, fmax(1e-6 * h, 1e-7 * size / max));
  memcpy(y, state->y, p->dim * sizeof *y);
  for (size_t i = 0; i < p->controlled; i++) y[i] += direction * d * state->slope[i];
  const rot_status status = rot_ode_slope_at(&run->law, run->clock.t, y, rise);
  if (status != ROT_OK) return status == ROT_ERHS ? ROT_OK : status;
  for (size_t i = 0; i < p->controlled; i++) rise[i] -= state->slope[i];
  const double rate = rot_ode_rate(all, rise) / d / max;
  for (size_t m = 0; m < rot_ode_steering(p); m++) {
    const rot_ode_group g = rot_ode_group_of(p, m);
    const double difference = rot_ode_rate(g, state->slope) / rate;
    const double scale = fmax(state->largest[m], rot_ode_size(g, state->y));
    if (rate * h > 1.0 && difference > 0.03 * p->accuracy * scale) {
      s->h = direction * 0.05 / rate;
      return ROT_OK;
    }
  }
  return ROT_OK;
}

/* A speed that an event left at 0, as where a contact sticks, has no error there, nor has what is
 * locked to it. */
static void hold_what_rests(rot_ode_stepping *run) {
  const rot_ode_params *p = run->p;
  const double *y = run->state.y, *slope = run->state.slope;
  int rests = 0;
  for (size_t k = 0; k < p->n_events && !rests; k++) {
    const size_t i = p->events[k].component;
    rests = !p->events[k].g && y[i] == 0.0 && slope[i] == 0.0;
  }
  for (size_t i = 0; i < p->controlled && rests; i++) {
    if (y[i] == 0.0 && slope[i] == 0.0) rot_ode_propagation_hold(run->propagation, i);
  }
}

static rot_status begin_segment(rot_ode_stepping *run, int was, size_t fired, double at) {
  rot_status status = choose_mode(run, was);
  rot_ode_propagation_new_segment(run->propagation);
  if (status == ROT_OK) status = rot_ode_know_slope(&run->law, &run->state);
  if (status == ROT_OK) hold_what_rests(run);
  if (status == ROT_OK) rot_ode_arm(&run->search, fired, at);
  if (status == ROT_OK) status = resolve_transient(run);
  rot_ode_rows_begin(&run->rows);
  if (status == ROT_OK) status = rot_ode_add_node(run);
  return status;
}

/* At an event: the log, and what follows. */
static rot_status pass_event(rot_ode_stepping *run, size_t which, int *new_segment) {
  const rot_ode_event *e = &run->p->events[which - (run->p->turn != NULL)];
  rot_status status = log_event(run, e->name);
  rot_ode_then then = ROT_ODE_GO_ON;
  if (status == ROT_OK && e->then) {
    then = e->then(run->clock.t, run->state.y, run->p->mode, run->clock.forward, run->p->ctx);
  }
  *new_segment = then == ROT_ODE_NEW_SEGMENT;
  if (then == ROT_ODE_END) run->state.phase = ROT_ODE_ENDED;
  if (*new_segment) run->state.slope_known = 0;
  return status;
}

/* A surface is met to rounding, or a little beyond: what has its zero there is passed with it. */
static rot_status pass_events_beside(rot_ode_stepping *run) {
  const rot_ode_switch *turn = run->p->turn;
  const size_t events = run->p->n_events + (turn != NULL);
  rot_status status = ROT_OK;
  for (size_t k = 0; k < events && status == ROT_OK; k++) {
    int new_segment;
    if (!rot_ode_is_beyond(&run->search, k)) continue;
    if (turn && k == 0) {
      run->state.y[turn->watched] = 0.0;
    } else {
      status = pass_event(run, k, &new_segment);
    }
  }
  return status;
}

/* The end of a segment: its rows, in its mode; then the surface that it met, and those in time. */
static rot_status end_segment(rot_ode_stepping *run, int mode, size_t surface, int timed,
                              double stop) {
  const rot_ode_params *p = run->p;
  const int next = p->mode ? *p->mode : 0;
  if (p->mode) *p->mode = mode;
  rot_status status = rot_ode_fill_rows(&run->rows, 1);
  if (p->mode) *p->mode = next;
  if (timed) rot_ode_pass_time(&run->law, &run->state);
  if (status == ROT_OK && surface != NO_SURFACE) {
    status = rot_ode_pass_surface(&run->law, &run->state, surface);
    if (run->law.slides == surface) {
      rot_ode_propagation_hold(run->propagation, run->law.surfaces->surface[surface].component);
    }
  }
  /* What jumps there may lead to another mode, as at a break that was given. */
  const int passed = timed || (surface != NO_SURFACE && run->law.slides == NO_SURFACE);
  if (passed && p->at_break && run->clock.t != stop) {
    p->at_break(run->clock.t, run->state.y, run->clock.forward, p->ctx);
  }
  return status;
}

/* One step, or a rest, towards `stop`, and what follows from where it ends. */
static rot_status go_on(rot_ode_stepping *run, double stop) {
  const rot_ode_params *p = run->p;
  const int was = p->turn ? *p->mode : 1, mode = p->mode ? *p->mode : 0;
  const double until = rot_ode_next_stop(&run->law, stop);
  rot_ode_passage what = ROT_ODE_SAME_SIDE;
  rot_status status;
  int new_segment = 0;
  size_t which = SIZE_MAX, surface = NO_SURFACE;
  double at = 0.0;
  if (run->state.phase == ROT_ODE_HELD) {
    rot_ode_propagation_hold(run->propagation, p->turn->watched);
    status = rot_ode_rest_until(run, until, &new_segment);
  } else {
    const double whole = run->clock.end - p->start_s;
    status = rot_ode_advance(run, until, fabs((run->clock.t - p->start_s) / whole), &what, &which);
    if (run->state.phase == ROT_ODE_STIFF) return ROT_ESTEP;
  }
  if (what == ROT_ODE_AT_ZERO) surface = rot_ode_surface_of(&run->search, which);
  if (status == ROT_OK && surface != NO_SURFACE) status = pass_events_beside(run);
  if (status != ROT_OK) return status;
  if (what != ROT_ODE_TRY_SHORTER) rot_ode_watch_on(&run->search, which);
  if (what == ROT_ODE_AT_ZERO) {
    new_segment = (p->turn && which == 0) || surface != NO_SURFACE;
    if (!new_segment) {
      at = rot_ode_event_value(&run->search, which);
      status = pass_event(run, which, &new_segment);
    }
  }
  const int timed = rot_ode_at_time_surface(&run->law);
  if (status != ROT_OK || !(new_segment || timed)) return status;
  status = end_segment(run, mode, surface, timed, stop);
  return status == ROT_OK ? begin_segment(run, was, which, at) : status;
}

/* ---- one side of the start ------------------------------------------------------------------- */

static void begin(rot_ode_stepping *run, double end, int forward, int first_mode) {
  const rot_ode_params *p = run->p;
  memcpy(run->state.y, p->start, p->dim * sizeof *p->start);
  if (p->mode) *p->mode = first_mode;
  run->state.phase = ROT_ODE_MOVING;
  run->state.slope_known = 0;
  run->clock = rot_ode_clock_at_start(p, end, forward);
  run->step.h = (end - p->start_s) / 100.0;
  if (p->start_s + run->step.h == p->start_s) run->step.h = end - p->start_s;
  run->limit = INFINITY;
  run->progress = (rot_ode_progress){run->info->steps + run->info->rejected, p->start_s};
  run->reference.at = 0;
  run->rest.grace = forward ? -INFINITY : INFINITY;
  run->kinks.before = run->kinks.looked_t = NAN;
  run->stiffness.t = NAN;
  run->stiffness.rate = 0.0;
  run->stiffness.stiff = run->stiffness.calm = 0;
  rot_ode_propagation_begin(run->propagation);
  rot_ode_rows_at_start(&run->rows);
}

/* To the end of this side, all breaks on the way. */
static rot_status step_to_end(rot_ode_stepping *run) {
  const rot_ode_params *p = run->p;
  rot_ode_clock *clock = &run->clock;
  rot_ode_state *state = &run->state;
  rot_status status = rot_ode_trace_add(run->trace, clock->t, 0.0, state->y);
  if (status == ROT_OK) status = rot_ode_choose_sides(&run->law, state);
  int was = 2, repeats = run->reference.trace != NULL; /* known to */
  while (status == ROT_OK && clock->t != clock->end && state->phase != ROT_ODE_ENDED) {
    const double at_break = rot_ode_next_break(clock);
    const int breaks = rot_ode_is_before(clock, at_break, clock->end);
    const double stop = breaks ? at_break : clock->end;
    status = begin_segment(run, was, SIZE_MAX, 0.0);
    if (status == ROT_OK && !repeats) {
      status = rot_ode_check_repeats(&run->law, state, run->scratch);
    }
    repeats = 1;
    while (status == ROT_OK && clock->t != stop && state->phase != ROT_ODE_ENDED) {
      status = go_on(run, stop);
    }
    const rot_status rows = rot_ode_fill_rows(&run->rows, 1);
    if (status == ROT_OK) status = rows;
    if (status == ROT_OK) run->info->time_s = clock->t;
    if (status == ROT_OK && breaks && clock->t == at_break) {
      rot_ode_cross_break(clock);
      state->slope_known = 0;
      if (p->at_break) p->at_break(clock->t, state->y, clock->forward, p->ctx);
    }
    was = p->turn ? *p->mode : 1;
  }
  return status;
}

static rot_status step_to_both_sides(rot_ode_stepping *run, rot_ode_job *job) {
  const rot_ode_output *rows = &job->rows;
  rot_status status = ROT_OK;
  for (int forward = 0; forward < 2 && status == ROT_OK; forward++) {
    const rot_ode_trace *reference = job->reference ? &job->reference[forward] : NULL;
    run->reference.trace = reference;
    run->trace = &job->trace[forward];
    run->trace->dim = job->p->dim;
    run->trace->count = 0;
    run->trajectory = job->trajectory ? &job->trajectory[forward] : NULL;
    if (run->trajectory) run->trajectory->nodes.count = 0, run->trajectory->slid = 0;
    if (forward) run->info->rows_done = rows->before;
    if ((forward ? rows->n - rows->before : rows->before) == 0) continue;
    double end = rows->time_s[forward ? rows->n - 1 : 0];
    if (reference && reference->count && !reference->ended)
      end = rot_ode_node(reference, reference->count - 1)[0];
    begin(run, end, forward, job->first_mode);
    status = step_to_end(run);
    run->trace->ended = run->state.phase == ROT_ODE_ENDED;
  }
  return status;
}

/* ---- one run --------------------------------------------------------------------------------- */

/* What each part knows of the others, and its states and slopes, dim each. NULL: no memory. */
static double *assemble(rot_ode_stepping *run) {
  rot_ode_clock *clock = &run->clock;
  rot_ode_state *state = &run->state;
  rot_ode_law *law = &run->law;
  rot_ode_stepper *step = &run->step;
  rot_ode_rows *rows = &run->rows;
  double **part[] = {&state->y,          &state->slope,        &step->trial,  &step->trial_error,
                     &step->trial_slope, &step->allowed,       &law->kept,    &law->beside,
                     &law->beyond,       &rows->row,           &rows->change, &run->stiffness.y,
                     &run->stiffness.f,  &run->search.between, &run->scratch};
  const size_t parts = sizeof part / sizeof *part;
  double *memory = calloc(parts * run->p->dim, sizeof *memory);
  for (size_t k = 0; k < parts && memory; k++) *part[k] = memory + k * run->p->dim;
  run->stiffness.p = law->p = run->p;
  run->stiffness.largest = state->largest;
  law->info = run->info;
  law->clock = run->reference.clock = clock;
  step->law = run->search.law = run->kinks.law = run->rest.law = rows->law = law;
  step->state = run->search.state = run->kinks.state = run->rest.state = rows->state = state;
  run->search.step = run->kinks.step = run->rest.step = rows->step = step;
  run->search.clock = run->kinks.clock = run->rest.clock = rows->clock = clock;
  return memory;
}

void rot_ode_clear_report(rot_info *info) {
  info->status = ROT_OK;
  info->time_s = info->tolerance = info->step_s = 0.0;
  info->rows_done = info->steps = info->rejected = 0;
  info->method = ROT_METHOD_NONE;
}

rot_status rot_ode_run_once(rot_ode_job *job, const rot_hooks *hooks, rot_info *info) {
  const rot_ode_params *p = job->p;
  const size_t dim = p->dim;
  rot_ode_errors *errors = &job->errors;
  rot_ode_stepping run;
  memset(&run, 0, sizeof run);
  rot_ode_clear_report(info);
  info->tolerance = job->tolerance;
  info->method = job->method;
  errors->found = errors->unresolved = 0.0;
  for (size_t m = 0; m < dim; m++) errors->fraction[m] = errors->moved[m] = errors->missed[m] = 0.0;
  for (size_t m = 0; m < rot_ode_measures(p); m++) {
    job->largest[m] = rot_ode_size(rot_ode_group_of(p, m), p->start);
  }
  if (p->log) p->log->count = 0;
  run.p = p;
  run.hooks = hooks;
  run.info = info;
  run.budget = job->budget;
  run.errors = errors;
  run.propagation = job->reference ? NULL : job->propagation;
  run.rounding = job->rounding;
  run.state.largest = job->largest;
  run.law.surfaces = job->surfaces;
  run.law.slides = NO_SURFACE;
  if (job->stiff) run.law.stiffness = &run.stiffness;
  run.step.method = job->method;
  run.step.fixed_s = job->step_s;
  run.step.fixed_parts = job->parts;
  run.step.tolerance = job->tolerance;
  run.kinks.found = job->reference ? NULL : job->kinks;
  run.reference.parts = job->parts;
  run.reference.gain = rot_ode_gain(job->method, (double)job->parts);
  run.rows.out = job->rows;
  if (!job->reference && !(job->step_s > 0.0)) run.rows.out.y = NULL;
  run.rows.fraction = errors->fraction;
  run.rows.probes = job->reference ? job->probes : NULL;
  run.rows.dense.dim = dim;
  run.rows.dense.slopes = job->method == ROT_METHOD_RK8PD;
  run.rows.form = calloc(dim, sizeof *run.rows.form);
  run.search.watch = calloc(ROT_ODE_MAX_SURFACES + p->n_events + 1, sizeof *run.search.watch);
  if (run.rows.probes) run.step.calls.data = malloc(ROT_ODE_CALLS * (1 + dim) * sizeof(double));
  double *memory = assemble(&run);
  const int room =
      memory && run.rows.form && run.search.watch && (!run.rows.probes || run.step.calls.data);
  info->status = room ? rot_ode_stepper_open(&run.step) : ROT_ENOMEM;
  if (info->status == ROT_OK) info->status = step_to_both_sides(&run, job);
  errors->unresolved = sqrt(errors->unresolved);
  job->stiff = run.state.phase == ROT_ODE_STIFF;
  rot_ode_stepper_close(&run.step);
  rot_dense_free(&run.rows.dense);
  free(run.rows.form);
  free(run.search.watch);
  free(run.step.calls.data);
  free(memory);
  return info->status;
}
