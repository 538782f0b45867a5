#include "engine/ode/march.h"

#include <gsl/gsl_errno.h>
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "engine/ode/accept.h"
#include "engine/ode/event.h"
#include "engine/ode/growth.h"
#include "engine/ode/kink.h"
#include "engine/ode/law.h"
#include "engine/ode/norm.h"
#include "engine/ode/rest.h"
#include "engine/ode/rows.h"
#include "engine/ode/step.h"
#include "engine/ode/wall.h"
#include "ground/real.h"

enum { PARTS = 3 };               /* into which a finer run divides a step */
enum { STEPS_PER_POLL = 4 };      /* a look at the clock is 25 ns, a step 350 ns and more */
enum { REJECTED_PER_CHECK = 16 }; /* whether the right-hand side repeats itself */

/* ---- stretches ------------------------------------------------------------------------------- */

/* Integrating backward, stick and slip swap. */
static rot_status log_event(const rot_ode_march *run, rot_event event) {
  if (!run->forward && event == ROT_EVENT_STICK) {
    event = ROT_EVENT_SLIP;
  } else if (!run->forward && event == ROT_EVENT_SLIP) {
    event = ROT_EVENT_STICK;
  }
  return rot_events_add(run->p->log, run->t, event);
}

/* The mode of a switch from here on. `was`: the mode before, 2 at the start of a run. */
static rot_status choose_mode(rot_ode_march *run, int was) {
  const rot_ode_switch *turn = run->p->turn;
  int *mode = run->p->mode;
  run->noise = 0.0;
  run->phase = ROT_ODE_MOVING;
  if (!turn) return ROT_OK;
  const double w = run->y[turn->watched];
  run->slope_known = 0;
  if (w != 0.0) {
    *mode = w > 0.0 ? 1 : -1;
    return ROT_OK;
  }
  double drive, grip;
  *mode = 0;
  rot_status status = rot_ode_held_slope(run, run->t, &drive, &grip);
  if (status != ROT_OK) return status;
  if (turn->holds > 0.0 && grip <= 0.0) {
    run->phase = ROT_ODE_HELD;
    return was == 1 || was == -1 ? log_event(run, ROT_EVENT_STICK) : ROT_OK;
  }
  const int way = drive > 0.0 ? 1 : drive < 0.0 ? -1 : was == 1 ? -1 : 1;
  const int chosen = run->forward || drive == 0.0 ? way : -way;
  run->phase = drive == 0.0 ? ROT_ODE_UNDECIDED : ROT_ODE_LEAVING;
  if (turn->holds > 0.0) { /* in the other direction nothing cancels: the rounding of the slope */
    double unused;
    *mode = -chosen;
    status = rot_ode_held_slope(run, run->t, &drive, &unused);
    run->noise = fabs(run->trial_slope[turn->watched]);
  }
  *mode = chosen;
  if (status == ROT_OK && was == 0) status = log_event(run, ROT_EVENT_SLIP);
  if (status == ROT_OK && was == -chosen) status = log_event(run, ROT_EVENT_REVERSE);
  return status;
}

/* Radau's first step would pass over a transient, and the error test of its end would not see it;
 * rows within it, and what theta gains in it, would be wrong. Where a stretch begins further from
 * its quick equilibrium than the accuracy, the first step is a twentieth of the transient. */
static rot_status resolve_transient(rot_ode_march *run) {
  const rot_ode_params *p = run->p;
  if (run->method != ROT_METHOD_RADAU || run->guide) return ROT_OK;
  const rot_ode_group all = {0, p->controlled, ROT_ODE_VECTOR};
  const double most = rot_ode_rate(all, run->slope), size = rot_ode_size(all, run->y);
  if (!(most > 0.0 && isfinite(most))) return ROT_OK;
  /* Along the motion itself, far enough for the difference to have digits. */
  const double way = run->forward ? 1.0 : -1.0;
  const double d = fmin(fabs(run->h), fmax(1e-6 * fabs(run->h), 1e-7 * size / most));
  for (size_t i = 0; i < p->controlled; i++) run->trial[i] = run->y[i] + way * d * run->slope[i];
  for (size_t i = p->controlled; i < p->dim; i++) run->trial[i] = run->y[i];
  if (rot_ode_slope_at(run->t, run->trial, run->trial_slope, run) != GSL_SUCCESS) {
    return run->status == ROT_ERHS ? ROT_OK : run->status;
  }
  for (size_t i = 0; i < p->controlled; i++) run->trial_slope[i] -= run->slope[i];
  const double rate = rot_ode_rate(all, run->trial_slope) / d / most;
  for (size_t m = 0; m < rot_ode_steering(p); m++) {
    const rot_ode_group g = rot_ode_group_of(p, m);
    const double apart = rot_ode_rate(g, run->slope) / rate;
    const double scale = fmax(run->largest[m], rot_ode_size(g, run->y));
    if (rate * fabs(run->h) > 1.0 && apart > 0.03 * p->accuracy * scale) {
      run->h = way * 0.05 / rate;
      return ROT_OK;
    }
  }
  return ROT_OK;
}

static rot_status begin_stretch(rot_ode_march *run, int was, size_t fired, double at) {
  rot_status status = choose_mode(run, was);
  rot_ode_growth_new_stretch(run->growth);
  if (status == ROT_OK) status = rot_ode_know_slope(run);
  if (status == ROT_OK) rot_ode_arm(run, fired, at);
  if (status == ROT_OK) status = resolve_transient(run);
  run->stretch_t = run->t;
  run->dense.count = 0;
  if (status == ROT_OK) status = rot_ode_add_node(run);
  return status;
}

/* ---- the march ------------------------------------------------------------------------------- */

double rot_ode_gain(rot_method method, double parts) {
  return pow(parts, method == ROT_METHOD_RADAU ? ROT_RADAU_ERROR_ORDER + 1.0 : 8.0);
}

/* A step so much shorter than the one before is not divided: it passes a kink, and ends where its
 * error is a small part of the accuracy. */
#define SLIVER 1e-3

/* The end of the next step of a guided run: equal parts of the steps of its guide. Nearer than a
 * third of a part it goes for the one after, so that after an event, which no two runs meet at the
 * same time, it falls in with the guide again. */
static double guided_aim(rot_ode_march *run, double stop) {
  const rot_ode_trace *m = run->guide;
  while (run->guide_at + 2 < m->count &&
         (run->forward ? rot_ode_node(m, run->guide_at + 1)[0] <= run->t
                       : rot_ode_node(m, run->guide_at + 1)[0] >= run->t)) {
    run->guide_at++;
  }
  for (size_t k = run->guide_at; k + 1 < m->count; k++) {
    const double a = rot_ode_node(m, k)[0], b = rot_ode_node(m, k + 1)[0];
    const int whole = k > 0 && fabs(b - a) < SLIVER * fabs(a - rot_ode_node(m, k - 1)[0]);
    const double parts = whole ? 1.0 : (double)run->parts;
    const double part = (b - a) / parts, least = 0.3 * fabs(part);
    const double way = run->forward ? 1.0 : -1.0;
    const double done = floor((run->t - a) / part + 0.3) + 1.0;
    const double aim = done < parts ? a + fmax(1.0, done) * part : b;
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

static step_plan plan_step(rot_ode_march *run, double stop) {
  const double left = stop - run->t;
  step_plan plan = {left, stop, 0};
  const rot_ode_trace *m = run->guide; /* it may have ended early, at an event */
  if (m && m->count &&
      fabs(rot_ode_node(m, m->count - 1)[0] - run->p->start_s) > fabs(run->t - run->p->start_s)) {
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

static double error_power(const rot_ode_march *run) {
  return run->method == ROT_METHOD_RADAU ? -1.0 / (ROT_RADAU_ERROR_ORDER + 1.0) : -1.0 / 8.0;
}

/* A stiff problem costs an explicit method steps that its error test would not need. */
static void judge_stiffness(rot_ode_march *run, double h) {
  if (!run->watch_stiffness) return;
  if (fabs(h) * run->stiffness > 4.0) {
    run->stiff_steps++;
    run->calm_steps = 0;
  } else if (++run->calm_steps >= 6) {
    run->stiff_steps = 0;
  }
  if (run->stiff_steps >= 15 && fabs(run->end - run->t) > 50.0 * fabs(h)) {
    run->phase = ROT_ODE_STIFF;
  }
}

/* `why`: ROT_ERHS, or what a step too short means. The state may be about to leave the doubles. */
static rot_status reject(rot_ode_march *run, double h, double factor, rot_status why) {
  run->info->rejected++;
  run->h = h * factor;
  run->limit = fabs(run->h);
  if (run->info->rejected % REJECTED_PER_CHECK == 0) {
    const rot_status repeats = rot_ode_check_repeats(run);
    if (repeats != ROT_OK) return repeats;
  }
  /* As short as time can be resolved, or rounded back to what was just rejected. */
  const double next = fabs((run->t + run->h) - run->t);
  if (next > 0.0 && next < fabs(h)) return ROT_OK;
  if (run->phase == ROT_ODE_LEAVING && run->p->turn->holds > 0.0) { /* driven by rounding: held */
    run->grace = run->t + 1e-9 * (run->end - run->t);
    *run->p->mode = 0;
    run->phase = ROT_ODE_HELD;
    run->slope_known = 0;
    return ROT_OK;
  }
  if (why != ROT_ERHS) run->info->time_s = run->t; /* else it is where rhs failed */
  for (size_t i = 0; i < run->p->controlled && why == ROT_ERHS; i++) {
    if (fabs(run->y[i]) > 1e300 || fabs(run->slope[i]) > 1e300) why = ROT_ERANGE;
  }
  if (why == ROT_ERANGE) run->info->time_s = run->t;
  return why;
}

/* A part of a step should have the error of the whole less rot_ode_gain(). Where it does not,
 * the motion is too quick for these steps, or has a kink, and the error that the test found counts
 * in full. */
static int is_unresolved(const rot_ode_march *run, double error) {
  if (!run->guide || run->guide_at + 1 >= run->guide->count) return 0;
  double before = rot_ode_node(run->guide, run->guide_at + 1)[1];
  if (run->guide_at + 2 < run->guide->count) { /* after a zero the guide is some way off */
    before = fmax(before, rot_ode_node(run->guide, run->guide_at + 2)[1]);
  }
  const double want = before / rot_ode_gain(run->method, (double)run->parts);
  return error > 4.0 * want && error > 64.0 * ROT_EPS;
}

static void note_error(rot_ode_march *run, double error) {
  const size_t steering = rot_ode_steering(run->p);
  run->found += error;
  for (size_t m = steering; m < rot_ode_measures(run->p); m++) {
    run->missed[m] += rot_ode_rate(rot_ode_group_of(run->p, m), run->trial_error);
  }
  if (!is_unresolved(run, error)) return;
  /* Radau's test is that of order 5, its result of order 9. */
  const double missed = run->method == ROT_METHOD_RADAU ? pow(error, 1.2) : error;
  run->unresolved += missed * missed;
}

/* A smooth law fails the test of a step that it chose itself by less: there may be a kink. */
#define KINK_RATIO 8.0
enum { MOST_LOOKS = 6 };

static rot_status look_for_kink(rot_ode_march *run, double h, double ratio, rot_status tried) {
  const int diverged = tried == ROT_ESTEP;
  if (!run->kinks || !(ratio > KINK_RATIO || diverged) || run->slides != NO_WALL) return ROT_OK;
  if (run->phase != ROT_ODE_MOVING && run->phase != ROT_ODE_CUT) return ROT_OK;
  run->looks = run->t == run->looked_t ? run->looks + 1 : 1;
  run->looked_t = run->t;
  if (diverged && run->looks <= MOST_LOOKS) { /* Newton's iteration: along the tangent */
    for (size_t i = 0; i < run->p->dim; i++) run->trial[i] = run->y[i] + h * run->slope[i];
    const int code = rot_ode_slope_at(run->t + h, run->trial, run->trial_slope, run);
    if (code != GSL_SUCCESS) return run->status == ROT_ERHS ? ROT_OK : run->status;
  }
  if (run->looks <= MOST_LOOKS) return rot_ode_look_for_kink(run, h);
  run->kinks->missed = run->kinks->missed || !diverged;
  return ROT_OK;
}

/* One end of the step over a kink is reached. */
static rot_status note_kink(rot_ode_march *run) {
  rot_ode_kinks *k = run->kinks;
  if (k->count == k->room) {
    const size_t room = k->room ? 2 * k->room : 16;
    double *time_s = realloc(k->time_s, room * sizeof *time_s);
    if (!time_s) return ROT_ENOMEM;
    k->time_s = time_s;
    k->room = room;
  }
  k->time_s[k->count++] = run->kink;
  run->kink = run->t == run->over ? NAN : run->over;
  return ROT_OK;
}

/* *ratio becomes that of a step that was cut at a wall. */
static rot_status look_for_events(rot_ode_march *run, double *h, rot_ode_passage *what,
                                  size_t *which, double *ratio) {
  const double whole = *h;
  const rot_status status = rot_ode_look_for_events(run, h, what, which);
  if (status == ROT_OK && run->walls->count && *h != whole) *ratio = rot_ode_trial_ratio(run, *h);
  return status;
}

static int may_retry(rot_status status) { return status == ROT_ERHS || status == ROT_ESTEP; }

/* The rows so far lie on unknown sides of walls that were added since: filled without them. */
static rot_status close_rows(rot_ode_march *run, size_t added) {
  run->walls->count -= added;
  run->n_watch -= added;
  rot_status status = rot_ode_fill_rows(run, 1);
  run->walls->count += added;
  run->n_watch += added;
  run->dense.count = 0;
  run->stretch_t = run->t;
  run->slope_known = 0;
  if (status == ROT_OK) status = rot_ode_know_slope(run);
  return status == ROT_OK ? rot_ode_add_node(run) : status;
}

/* One step towards `stop`, which no break comes before. */
static rot_status take_step(rot_ode_march *run, double stop, double fraction, rot_ode_passage *what,
                            size_t *which) {
  const size_t tried = run->info->steps + run->info->rejected;
  *what = ROT_ODE_TRY_SHORTER;
  if (tried >= run->budget) {
    run->info->time_s = run->t;
    return ROT_EBUDGET;
  }
  rot_status status = tried % STEPS_PER_POLL == 0 ? rot_poll(run->hooks, fraction) : ROT_OK;
  if (status == ROT_OK) status = rot_ode_know_slope(run);
  if (status != ROT_OK) return status;
  step_plan plan = plan_step(run, isnan(run->kink) ? stop : run->kink);
  if (run->t + plan.h == run->t) {
    run->info->time_s = run->t;
    return ROT_ESTEP;
  }
  status = rot_ode_attempt(run, run->t, plan.h, run->y, run->slope);
  if (status != ROT_OK && !may_retry(status)) return status;
  double ratio = status == ROT_OK ? rot_ode_trial_ratio(run, plan.h) : NAN;
  double h = plan.h;
  /* Beyond a wall the step is no step of the motion, and its error none: up to the wall. */
  const int early = status == ROT_OK && ratio > 1.0 && rot_ode_passes_wall(run);
  if (early) {
    run->info->rejected++;
    status = look_for_events(run, &h, what, which, &ratio);
    if (status != ROT_OK && !may_retry(status)) return status;
    if (status == ROT_OK && *what == ROT_ODE_TRY_SHORTER && !run->slope_known) return ROT_OK;
    if (status != ROT_OK || *what == ROT_ODE_TRY_SHORTER || !(ratio <= 1.0)) {
      *what = ROT_ODE_TRY_SHORTER;
      return reject(run, h, 0.5, status == ROT_OK ? ROT_ESTEP : status);
    }
  }
  if (!(ratio <= 1.0)) { /* NaN fails */
    const int aimed = !isnan(run->kink);
    const size_t walls = run->walls->count;
    const rot_status looked = aimed ? ROT_OK : look_for_kink(run, plan.h, ratio, status);
    if (looked != ROT_OK) return looked;
    if (!aimed && (!isnan(run->kink) || run->walls->count != walls)) {
      run->info->rejected++;
      return ROT_OK;
    }
    const double less = isfinite(ratio) ? fmax(0.1, 0.9 * pow(ratio, error_power(run))) : 0.1;
    return reject(run, plan.h, less, status == ROT_OK ? ROT_ESTEP : status);
  }
  if (!early) status = look_for_events(run, &h, what, which, &ratio);
  if (may_retry(status)) return reject(run, plan.h, 0.5, status);
  if (status != ROT_OK) return status;
  if (*what == ROT_ODE_TRY_SHORTER) {
    return run->slope_known ? reject(run, plan.h, 0.1, ROT_ESTEP) : ROT_OK;
  }
  if (is_unresolved(run, ratio * run->tolerance) && run->slides == NO_WALL && isnan(run->kink)) {
    const size_t walls = run->walls->count;
    const rot_status looked = rot_ode_look_for_wall(run, h);
    if (looked != ROT_OK) return looked;
    if (run->walls->count != walls) {
      run->info->rejected++;
      *what = ROT_ODE_TRY_SHORTER;
      return close_rows(run, run->walls->count - walls);
    }
  }
  note_error(run, ratio * run->tolerance);
  run->limit = INFINITY;
  run->phase = *what == ROT_ODE_CUT_SHORT ? ROT_ODE_CUT : ROT_ODE_MOVING;
  const double grow = ratio > 0.0 ? 0.9 * pow(ratio, error_power(run)) : 5.0;
  /* Up to a wall or to an event before it, which may be within a rounding of t. */
  const double base = early ? copysign(fmax(fabs(h), 1e-3 * fabs(plan.h)), h) : plan.h;
  const double wish = base * fmin(5.0, fmax(0.5, grow));
  judge_stiffness(run, plan.h);
  /* A step cut short by a target says nothing against the longer one. */
  if (fabs(wish) > fabs(run->h) || plan.as_wished) run->h = wish;
  const double from = run->t;
  status = rot_ode_accept(run, *what == ROT_ODE_SAME_SIDE ? plan.target : run->t + h,
                          ratio * run->tolerance);
  if (status == ROT_OK && run->growth) {
    status = rot_ode_growth_step(run, run->t - from, run->trial, PARTS);
  }
  return status == ROT_OK && run->t == run->kink ? note_kink(run) : status;
}

/* At an event: the log, and what follows. */
static rot_status pass_event(rot_ode_march *run, size_t which, int *new_stretch) {
  const rot_ode_event *e = &run->p->events[which - (run->p->turn != NULL)];
  rot_status status = log_event(run, e->name);
  rot_ode_then then = ROT_ODE_GO_ON;
  if (status == ROT_OK && e->then) {
    then = e->then(run->t, run->y, run->p->mode, run->forward, run->p->ctx);
  }
  *new_stretch = then == ROT_ODE_NEW_STRETCH;
  if (then == ROT_ODE_END) run->phase = ROT_ODE_ENDED;
  if (*new_stretch) run->slope_known = 0;
  return status;
}

/* A wall is met to rounding, or a little beyond: what has its zero there is passed with it. */
static rot_status pass_events_beside(rot_ode_march *run) {
  const rot_ode_switch *turn = run->p->turn;
  for (size_t k = 0; k < run->n_watch - run->walls->count; k++) {
    const double value = rot_ode_event_value(run, k);
    int new_stretch;
    if (run->watch[k].side == 0 || run->watch[k].side * value >= 0.0) continue;
    if (turn && k == 0) {
      run->y[turn->watched] = 0.0;
      continue;
    }
    const rot_ode_event *e = &run->p->events[k - (turn != NULL)];
    const int upward = run->forward ? e->direction : -e->direction;
    if (e->direction != 0 && upward == run->watch[k].side) continue;
    const rot_status status = pass_event(run, k, &new_stretch);
    if (status != ROT_OK) return status;
  }
  return ROT_OK;
}

/* Integrate to a time with no break in between. */
static rot_status drive(rot_ode_march *run, double stop) {
  const double whole = run->end - run->p->start_s;
  while (run->t != stop && run->phase != ROT_ODE_ENDED) {
    rot_ode_passage what = ROT_ODE_SAME_SIDE;
    rot_status status;
    const int was = run->p->turn ? *run->p->mode : 1, mode = run->p->mode ? *run->p->mode : 0;
    int new_stretch = 0;
    size_t which = SIZE_MAX, crossed = NO_WALL;
    double at = 0.0;
    const double until = rot_ode_next_stop(run, stop);
    if (run->phase == ROT_ODE_HELD) {
      rot_ode_growth_hold(run->growth, run->p->turn->watched);
      status = rot_ode_hold(run, until, &new_stretch);
    } else {
      status = take_step(run, until, fabs((run->t - run->p->start_s) / whole), &what, &which);
      if (run->phase == ROT_ODE_STIFF) return ROT_ESTEP;
    }
    if (status != ROT_OK) return status;
    if (what == ROT_ODE_AT_ZERO && rot_ode_wall_of(run, which) != NO_WALL) {
      status = pass_events_beside(run);
      if (status != ROT_OK) return status;
    }
    if (run->n_watch && what != ROT_ODE_TRY_SHORTER) rot_ode_watch_on(run, which);
    if (what == ROT_ODE_AT_ZERO) {
      const size_t wall = rot_ode_wall_of(run, which);
      new_stretch = (run->p->turn && which == 0) || wall != NO_WALL;
      at = new_stretch ? 0.0 : rot_ode_event_value(run, which);
      if (!new_stretch) status = pass_event(run, which, &new_stretch);
      if (wall != NO_WALL) crossed = wall;
    }
    const int timed = run->walls->count > 0 && rot_ode_at_time_wall(run);
    new_stretch |= timed;
    if (status == ROT_OK && new_stretch) { /* the rows before it belong to the mode before it */
      const int next = run->p->mode ? *run->p->mode : 0;
      if (run->p->mode) *run->p->mode = mode;
      status = rot_ode_fill_rows(run, 1);
      if (run->p->mode) *run->p->mode = next;
      if (timed) rot_ode_pass_time(run);
      if (status == ROT_OK && crossed != NO_WALL) status = rot_ode_pass_wall(run, crossed);
      /* What jumps there may lead to another mode, as at a break that was given. */
      const int passed = timed || (crossed != NO_WALL && run->slides == NO_WALL);
      if (passed && run->p->at_break && run->t != stop) {
        run->p->at_break(run->t, run->y, run->forward, run->p->ctx);
      }
      if (status == ROT_OK) status = begin_stretch(run, was, which, at);
    }
    if (status != ROT_OK) return status;
  }
  return ROT_OK;
}

/* The way outward from the start: the next break, and the side of it that rhs may see. */
typedef struct course {
  double outward; /* +Inf or -Inf */
  size_t k;       /* breaks[k] is next forward, breaks[k - 1] backward */
  double *near, *far;
} course;

static course set_out(rot_ode_march *run, double end, int forward) {
  const rot_ode_params *p = run->p;
  course w = {forward ? INFINITY : -INFINITY, 0, NULL, NULL};
  w.near = forward ? &run->after : &run->before;
  w.far = forward ? &run->before : &run->after;
  memcpy(run->y, p->start, p->dim * sizeof *run->y);
  if (p->mode) *p->mode = run->first_mode;
  run->phase = ROT_ODE_MOVING;
  run->forward = forward;
  run->end = end;
  run->t = p->start_s;
  run->h = (end - p->start_s) / 100.0;
  run->limit = INFINITY;
  run->slope_known = 0;
  run->guide_at = 0;
  run->grace = -w.outward;
  run->stage_t = run->kink = run->looked_t = NAN;
  run->probed_t = run->t;
  run->stiffness = 0.0;
  run->stiff_steps = run->calm_steps = 0;
  run->after = -INFINITY;
  run->before = INFINITY;
  while (w.k < p->n_breaks && (forward ? p->breaks[w.k] <= run->t : p->breaks[w.k] < run->t)) w.k++;
  const int on_break = forward ? w.k > 0 && p->breaks[w.k - 1] == run->t
                               : w.k < p->n_breaks && p->breaks[w.k] == run->t;
  if (on_break || p->start_breaks) *w.near = nextafter(run->t, w.outward);
  run->slides = NO_WALL;
  rot_ode_growth_set_out(run->growth);
  return w;
}

/* The next break, +-Inf if there is none; rhs stays on this side of it. Between two neighbours of
 * the doubles there is no other side: the lower of them has the value after it. */
static double next_break(rot_ode_march *run, course *w) {
  const int more = run->forward ? w->k < run->p->n_breaks : w->k > 0;
  const double stop = more ? run->p->breaks[run->forward ? w->k : w->k - 1] : w->outward;
  *w->far = more ? nextafter(stop, -w->outward) : w->outward;
  if (run->after > run->before) run->after = run->before;
  return stop;
}

static void cross_break(rot_ode_march *run, course *w, double stop) {
  *w->near = nextafter(stop, w->outward);
  run->slope_known = 0;
  w->k = run->forward ? w->k + 1 : w->k - 1;
  if (run->p->at_break) run->p->at_break(stop, run->y, run->forward, run->p->ctx);
}

rot_status rot_ode_march_to(rot_ode_march *run, double end, int forward) {
  course w = set_out(run, end, forward);
  rot_status status = rot_ode_trace_end(run, 0.0);
  if (status == ROT_OK) status = rot_ode_choose_sides(run);
  int was = 2, repeats = run->guide != NULL; /* known to */
  while (status == ROT_OK && run->t != end && run->phase != ROT_ODE_ENDED) {
    const double at_break = next_break(run, &w);
    const int breaks = forward ? at_break < end : at_break > end;
    status = begin_stretch(run, was, SIZE_MAX, 0.0);
    if (status == ROT_OK && !repeats) status = rot_ode_check_repeats(run);
    repeats = 1;
    if (status == ROT_OK) status = drive(run, breaks ? at_break : end);
    const rot_status rows = rot_ode_fill_rows(run, 1);
    if (status == ROT_OK) status = rows;
    if (status == ROT_OK) run->info->time_s = run->t;
    if (status == ROT_OK && breaks && run->t == at_break) cross_break(run, &w, at_break);
    was = run->p->turn ? *run->p->mode : 1;
  }
  return status;
}
