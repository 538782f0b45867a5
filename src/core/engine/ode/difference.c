#include "engine/ode/difference.h"

#include <string.h>

#include "engine/ode/norm.h"

void rot_ode_note_difference(const rot_ode_params *p, const double a[], const double b[],
                             double change[], double difference[]) {
  for (size_t i = 0; i < p->dim; i++) change[i] = b[i] - a[i];
  for (size_t m = 0; m < rot_ode_measures(p); m++) {
    const double now = rot_ode_difference(rot_ode_group_of(p, m), a, change);
    if (!(now <= difference[m])) difference[m] = now;
  }
}

void rot_ode_differences(const rot_ode_trace *coarse, const rot_ode_trace *fine,
                         const rot_ode_job *job, int forward, size_t first, size_t rows,
                         size_t places, double correction, double change[], double difference[]) {
  const rot_ode_params *p = job->p;
  const double direction = forward ? 1.0 : -1.0;
  size_t f = 0, row = 0;
  const double *last[2] = {NULL, NULL};        /* the pair before */
  const double *unseen[ROT_ODE_MAX_PLACES][2]; /* pairs before whose difference is not noted */
  double last_s = 0.0;
  size_t pairs = 0;
  for (size_t c = 0; c < coarse->count && row < rows; c++) {
    const double *a = rot_ode_node(coarse, c);
    while (f < fine->count && direction * (rot_ode_node(fine, f)[0] - a[0]) < 0.0) f++;
    if (f == fine->count) break;
    const double *b = rot_ode_node(fine, f);
    if (a[0] != b[0]) continue;
    int seen = 0;
    while (row < rows) {
      const size_t at = forward ? first + row : first + rows - 1 - row;
      const double t = job->rows.time_s[at];
      double *y = job->rows.y + at * p->dim;
      if (direction * (t - a[0]) > 0.0) break;
      const double weight = last[0] ? (t - last_s) / (a[0] - last_s) : 1.0;
      for (size_t i = 0; correction > 0.0 && i < p->dim; i++) {
        const double before = last[0] ? last[1][i] - last[0][i] : 0.0, now = b[2 + i] - a[2 + i];
        y[i] += correction * (before + weight * (now - before));
      }
      if (correction > 0.0 && p->project) p->project(t, y, p->ctx);
      seen = 1;
      row++;
    }
    last_s = a[0];
    last[0] = a + 2;
    last[1] = b + 2;
    if (seen) {
      rot_ode_note_difference(p, last[0], last[1], change, difference);
      for (size_t k = 0; k < pairs && k < places; k++)
        rot_ode_note_difference(p, unseen[k][0], unseen[k][1], change, difference);
      pairs = 0;
    } else {
      memcpy(unseen[pairs++ % places], last, sizeof last);
    }
  }
}
