#include "api/work.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

rotdyn_status rot_api_refuse(rot_api_work *w, const char *input, const char *reason) {
  w->report.input = input;
  (void)snprintf(w->report.reason, sizeof w->report.reason, "%s", reason);
  return ROTDYN_EARGUMENT;
}

static rot_status call_poll(void *ctx, double fraction) {
  const rotdyn_options *o = ctx;
  return o->poll && o->poll(o->poll_context, fraction) ? ROT_EUNWIND : ROT_OK;
}

int rot_api_possible(const rot_constraint *c, const void *scene, size_t n, const double time_s[]) {
  const double start = c->start_s(scene);
  return rot_api_times(n, time_s) &&
         (n == 0 || (isfinite(time_s[0] - start) && isfinite(time_s[n - 1] - start)));
}

rotdyn_status rot_api_open(const rotdyn_object *scene, size_t n, const double time_s[],
                           const rotdyn_options *options, rot_api_work *w) {
  memset(w, 0, sizeof *w);
  const char *fault = rot_api_options(options, &w->options);
  w->hooks = (rot_hooks){call_poll, &w->options};
  if (fault) return rot_api_refuse(w, NULL, fault);
  const rotdyn_status status = rot_api_build(scene, &w->built, &w->report);
  if (status == ROTDYN_OK && !rot_api_possible(w->built.constraint, w->built.scene, n, time_s)) {
    return rot_api_refuse(w, NULL, "times must be finite and not decrease");
  }
  return status;
}

int rot_api_close(rotdyn_status status, rot_api_work *w, rotdyn_report *report) {
  rot_api_release(&w->built);
  w->report.status = (int)status;
  return rot_api_give(&w->report, sizeof w->report, report) ? (int)status : ROTDYN_EARGUMENT;
}

/* ---- runs ------------------------------------------------------------------------------------ */

/* outcome => report */
static void report_run(const rot_constraint *c, const rot_outcome *o, rotdyn_report *to) {
  const rot_info *info = &o->info;
  to->rows_done = info->rows_done;
  to->time_s = info->time_s;
  to->steps = info->steps;
  to->rejected = info->rejected;
  to->law_calls = info->rhs_calls;
  to->error = o->error;
  to->model = o->model ? o->model->id : NULL;
  to->error_is_bound = o->model && o->model->error_kind == ROT_BOUND;
  to->n_measures = info->n_measures;
  for (size_t i = 0; i < info->n_measures; i++) {
    to->measure[i] = info->measure_names[i];
    to->measure_error[i] = info->measure[i].error;
    to->measure_largest[i] = info->measure[i].largest;
  }
  if (o->picked.dropped) rot_choice_reason(c, &o->picked, sizeof to->reason, to->reason);
}

rotdyn_status rot_api_run(const rot_constraint *c, const void *scene, const rotdyn_options *options,
                          const rot_hooks *hooks, size_t n, const double time_s[],
                          const rot_rows *want, rot_outcome *o, rotdyn_report *report) {
  const double max = fmin(options->max_steps, 1e15);
  const rot_task task = {.n = n,
                         .time_s = time_s,
                         .accuracy = options->accuracy,
                         .max_steps = (size_t)max + n,
                         .asked = options->model != NULL};
  memset(o, 0, sizeof *o);
  const rot_run_end end =
      rot_run(c, scene, options->model, &task, options->law_call_s, want, o, hooks);
  if (end == ROT_RUN_DONE) {
    const rotdyn_status status = rot_api_status(o->info.status);
    report_run(c, o, report);
    return status == ROTDYN_OK && isnan(o->error) ? ROTDYN_ERANGE : status;
  }
  if (end == ROT_RUN_NO_MODEL) {
    if (rot_choice_model(c, options->model)) {
      rot_choice_reason(c, &o->picked, sizeof report->reason, report->reason);
    } else {
      (void)snprintf(report->reason, sizeof report->reason, "there is no model of this name");
    }
    return ROTDYN_EMODEL;
  }
  const rot_query query = {n, time_s, options->accuracy, options->law_call_s};
  return rot_api_none_fits(c, scene, &query, sizeof report->reason, report->reason);
}
