#include "api/structs.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

rotdyn_status rot_api_status(rot_status status) {
  switch (status) {
  case ROT_OK: return ROTDYN_OK;
  case ROT_ENOMEM: return ROTDYN_EMEMORY;
  case ROT_EVALUE: return ROTDYN_EARGUMENT;
  case ROT_ERANGE: return ROTDYN_ERANGE;
  case ROT_ETORQUE:
  case ROT_ERANDOM:
  case ROT_ERHS: return ROTDYN_ETORQUE;
  case ROT_EBUDGET: return ROTDYN_EBUDGET;
  case ROT_ESTEP: return ROTDYN_ESTEP;
  case ROT_EUNWIND: return ROTDYN_ESTOPPED;
  default: return ROTDYN_EINTERNAL;
  }
}

/* 1 for the size of a struct of an older or newer header, which ends between members. */
static int possible_size(size_t size) { return size >= sizeof size && size % sizeof(void *) == 0; }

int rot_api_take(const void *from, size_t size, void *to) {
  const unsigned char *bytes = from;
  size_t given;
  if (!from) return 0;
  memcpy(&given, from, sizeof given);
  if (!possible_size(given)) return 0;
  for (size_t i = size; i < given; i++) {
    if (bytes[i]) return 0;
  }
  memset(to, 0, size);
  memcpy(to, from, given < size ? given : size);
  return 1;
}

int rot_api_give(const void *from, size_t size, void *to) {
  const size_t head = sizeof(size_t);
  size_t given;
  if (!to) return 1;
  memcpy(&given, to, sizeof given);
  if (!possible_size(given)) return 0;
  const size_t both = given < size ? given : size;
  memcpy((unsigned char *)to + head, (const unsigned char *)from + head, both - head);
  return 1;
}

int rot_api_finite(size_t n, const double x[]) {
  for (size_t i = 0; i < n; i++) {
    if (!isfinite(x[i])) return 0;
  }
  return 1;
}

int rot_api_times(size_t n, const double t[]) {
  if (n && (!t || !rot_api_finite(n, t) || !isfinite(t[n - 1] - t[0]))) return 0;
  for (size_t i = 1; i < n; i++) {
    if (t[i] < t[i - 1]) return 0;
  }
  return 1;
}

void rot_api_events(const rot_events *from, rotdyn_events *to) {
  rotdyn_events events;
  if (!to || !rot_api_take(to, sizeof events, &events)) return;
  for (size_t i = 0; i < from->count && i < events.room; i++) {
    if (events.time_s) events.time_s[i] = from->time_s[i];
    if (events.name) events.name[i] = rot_event_name(from->event[i]);
    if (events.place) events.place[i] = from->place[i];
  }
  events.count = from->count;
  (void)rot_api_give(&events, sizeof events, to);
}

const char *rot_api_options(const rotdyn_options *from, rotdyn_options *to) {
  rotdyn_events events;
  memset(to, 0, sizeof *to);
  if (from && !rot_api_take(from, sizeof *to, to)) {
    return "the size of the options or a member beyond this version is wrong";
  }
  if (to->events && !rot_api_take(to->events, sizeof events, &events)) {
    return "the size of `events` or a member beyond this version is wrong";
  }
  if (to->accuracy == 0.0) to->accuracy = 1e-9;
  if (to->max_steps == 0.0) to->max_steps = 1e6;
  if (to->law_call_s == 0.0) to->law_call_s = 1e-6;
  if (!(to->accuracy > 0.0 && to->accuracy <= 1.0)) return "`accuracy` must lie between 0 and 1";
  if (!(to->max_steps >= 1.0) || !(to->law_call_s > 0.0)) {
    return "`max_steps` or `law_call_s` is out of range";
  }
  return NULL;
}

rotdyn_status rot_api_candidate(const rot_candidate *c, const char *reason, rotdyn_candidate *out) {
  rotdyn_candidate x = {0};
  x.model = c->model->id;
  x.applies = c->applies;
  x.error = c->error;
  x.error_is_bound = c->model->error_kind == ROT_BOUND;
  x.cost_s = c->cost_s;
  (void)snprintf(x.reason, sizeof x.reason, "%s", reason);
  return rot_api_give(&x, sizeof x, out) ? ROTDYN_OK : ROTDYN_EARGUMENT;
}

rotdyn_status rot_api_none_fits(const rot_constraint *constraint, const void *scene,
                                const rot_query *query, size_t size, char text[]) {
  rot_candidate all[ROT_MAX_MODELS];
  const size_t n = rot_choice_candidates(constraint, scene, query, all);
  double best = INFINITY;
  for (size_t i = 0; i < n; i++) {
    if (!all[i].untaken && !all[i].why_not) best = fmin(best, all[i].error);
  }
  if (best < INFINITY) {
    (void)snprintf(text, size, "no model of this scene reaches %.3g; the best promises %.3g",
                   query->accuracy, best);
    return ROTDYN_EACCURACY;
  }
  for (size_t i = 0; i < n; i++) {
    if (all[i].why_not) (void)snprintf(text, size, "%s", all[i].why_not);
  }
  return ROTDYN_EMODEL;
}
