#include "engine/ode/fixed.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "engine/ode/difference.h"
#include "engine/ode/norm.h"
#include "ground/real.h"

#define PI 3.14159265358979323846

/* In front of a row, where the two runs are compared, too: half a swing of rot_fixed_step_s(). */
enum { PLACES = 32 };

static int order_of(rot_method method) { return method == ROT_METHOD_RK4 ? 4 : 1; }

double rot_ode_fixed_factor(int order, double difference, double size) {
  const double step = size > 0.0 ? pow(difference / size, 1.0 / order) : 0.0;
  const double next = fmin(0.5, fmax(0.25, 4.0 * step)), power = ldexp(1.0, -order);
  return (1.0 - next) / (1.0 - power - next * (1.0 - 0.5 * power));
}

double rot_ode_fixed_rounding(double steps) {
  return ROT_EPS * (6.0 * sqrt(1.0 + steps) + 0.125 * steps);
}

/* The errors of the rows by those of half the step; `distance`: how far the two runs are from each
 * other at the steps in front of a row. */
static void note_errors(const rot_ode_params *p, const rot_ode_output *out, const double half[],
                        size_t rows, size_t half_rows, size_t steps, const double distance[],
                        double change[]) {
  const double rounding = rot_ode_fixed_rounding((double)steps);
  for (size_t m = 0; m < rot_ode_measures(p); m++) {
    double max = half_rows < rows ? INFINITY : distance[m];
    for (size_t i = 0; i < rows && i < half_rows; i++) {
      const double *x = out->y + i * p->dim, *y = half + i * p->dim;
      for (size_t k = 0; k < p->dim; k++) change[k] = y[k] - x[k];
      const double difference = rot_ode_difference(rot_ode_group_of(p, m), x, change);
      if (!(difference <= max)) max = difference;
    }
    const double size = out->largest[m];
    out->error[m] = rot_ode_fixed_factor(order_of(p->method), max, size) * max + rounding * size;
  }
}

rot_status rot_ode_run_fixed(const rot_ode_params *p, const rot_ode_output *out,
                             const rot_hooks *hooks, rot_info *info) {
  const size_t dim = p->dim;
  rot_ode_surfaces *surfaces = calloc(1, sizeof *surfaces);
  double *half = malloc((out->n ? out->n : 1) * dim * sizeof *half);
  double *scratch = calloc(6 * dim, sizeof *scratch);
  rot_ode_trace traces[2][2] = {{{.count = 0}}}; /* with half the step, and with it */
  info->status = surfaces && half && scratch ? ROT_OK : ROT_ENOMEM;
  if (info->status == ROT_OK) {
    const int first_mode = p->mode ? *p->mode : 0;
    rot_ode_job job = {.p = p,
                       .rows = *out,
                       .method = p->method,
                       .step_s = p->step_s,
                       .budget = p->max_steps,
                       .parts = 2,
                       .trace = traces[0],
                       .surfaces = surfaces,
                       .largest = scratch + dim,
                       .first_mode = first_mode};
    job.errors.fraction = scratch + 2 * dim;
    job.errors.moved = scratch + 3 * dim;
    job.errors.missed = scratch + 4 * dim;
    job.rows.y = half;
    job.rows.slope = NULL;
    const rot_status second = rot_ode_run_once(&job, hooks, info);
    const size_t half_rows = info->rows_done, steps = info->steps;
    if (second != ROT_EUNWIND && second != ROT_ENOMEM) {
      for (size_t i = 0; out->slope && i < out->n; i++) out->slope[i] = NAN;
      job.rows = *out;
      job.trace = traces[1];
      job.parts = 1;
      job.largest = out->largest;
      if (p->mode) *p->mode = first_mode;
      rot_ode_run_once(&job, hooks, info);
      double *distance = scratch + 5 * dim;
      for (int forward = 0; forward < 2; forward++) {
        const size_t first = forward ? job.rows.before : 0;
        const size_t end = forward ? info->rows_done : job.rows.before;
        const size_t n = end < info->rows_done ? end : info->rows_done;
        rot_ode_differences(&traces[1][forward], &traces[0][forward], &job, forward, first,
                            n > first ? n - first : 0, PLACES, 0.0, scratch, distance);
      }
      note_errors(p, out, half, info->rows_done, half_rows, steps, distance, scratch);
    }
    info->step_s = p->step_s;
  }
  const rot_status sorted = p->log ? rot_events_sort(p->log) : ROT_OK;
  if (sorted != ROT_OK) info->status = sorted;
  for (int k = 0; k < 4; k++) free(traces[k / 2][k % 2].data);
  free(scratch);
  free(half);
  free(surfaces);
  return info->status;
}

/* ---- the length of a step -------------------------------------------------------------------- */

double rot_fixed_step_s(const rot_time_scales *time_scales, double span_s) {
  enum { STEPS = 64 };
  const double shortest =
      fmin(2.0 * PI / time_scales->swing_rad_per_s, time_scales->fades_s) / STEPS;
  if (shortest > 0.0 && isfinite(shortest)) return shortest;
  return span_s > 0.0 && isfinite(span_s) ? 1e-3 * span_s : 1.0;
}

static double span_of(size_t n, const double time_s[], double start_s) {
  return n ? fmax(fabs(time_s[0] - start_s), fabs(time_s[n - 1] - start_s)) : 0.0;
}

double rot_fixed_task_step_s(const rot_task *task, double start_s,
                             const rot_time_scales *time_scales) {
  return task->step_s > 0.0
             ? task->step_s
             : rot_fixed_step_s(time_scales, span_of(task->n, task->time_s, start_s));
}

double rot_fixed_cost_s(const rot_model *model, const rot_query *query, double start_s, int calls,
                        const rot_time_scales *time_scales) {
  const double span = span_of(query->n, query->time_s, start_s);
  const double steps = fmin(span / rot_fixed_step_s(time_scales, span), 1e300) + (double)query->n;
  return 4.0 * steps * (model->seconds[0] + (calls ? query->law_s : 0.0));
}
