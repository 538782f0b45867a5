#include "engine/ode/rounding.h"

#include <math.h>
#include <string.h>

#include "engine/ode/difference.h"
#include "engine/ode/norm.h"
#include "ground/real.h"

/* Three distances from the first of them: their mean square is less than a ninth of what is
 * expected in one of 30, and the figure takes three times its root. */
enum { RUNS = 4 };

int rot_ode_roundings_rule(const rot_ode_job *coarse) {
  const rot_ode_params *p = coarse->p;
  const rot_ode_propagation *g = coarse->propagation;
  int rule = 0;
  if (!g || p->turn) return 0;
  for (size_t m = 0; m < rot_ode_steering(p); m++) {
    rule = rule || !(3.0 * g->worst[m] <= p->accuracy * coarse->largest[m]);
  }
  return rule;
}

/* Where both have a step's end: a step that one of them rejects is divided in one alone. 0: too
 * seldom. */
static int note_distances(const rot_ode_params *p, const rot_ode_trace *one,
                          const rot_ode_trace *other, double change[], double distance[]) {
  size_t j = 0, met = 0;
  for (size_t k = 0; k < one->count; k++) {
    const double *a = rot_ode_node(one, k);
    while (j < other->count &&
           fabs(rot_ode_node(other, j)[0] - p->start_s) < fabs(a[0] - p->start_s)) {
      j++;
    }
    if (j == other->count) break;
    const double *b = rot_ode_node(other, j);
    if (a[0] != b[0]) continue;
    met++;
    rot_ode_note_difference(p, a + 2, b + 2, change, distance);
  }
  return 2 * met >= one->count;
}

rot_status rot_ode_see_roundings(const rot_ode_job *coarse, const rot_ode_job *fine,
                                 rot_ode_trace traces[2][2], double seen[], double change[],
                                 const rot_hooks *hooks, rot_info *info) {
  const rot_ode_params *p = coarse->p;
  const size_t measures = rot_ode_measures(p);
  double *distance = seen + measures;
  int parted = 0; /* two runs are as far from each other as the motion is long: they say enough */
  if (RUNS * info->steps * fine->parts > p->max_steps) return ROT_OK;
  memset(seen, 0, measures * sizeof *seen);
  for (unsigned run = 0; run < RUNS && !parted; run++) {
    rot_ode_job moved = *fine;
    moved.trace = traces[run > 0];
    moved.probes = NULL;
    moved.rounding = run + 1;
    rot_ode_run_once(&moved, hooks, info);
    if (info->status != ROT_OK) return info->status;
    if (run == 0) continue;
    memset(distance, 0, measures * sizeof *distance);
    for (int side = 0; side < 2; side++) {
      if (!note_distances(p, &traces[0][side], &traces[1][side], change, distance)) return ROT_OK;
    }
    for (size_t m = 0; m < rot_ode_steering(p); m++) {
      parted = parted || distance[m] >= coarse->largest[m];
    }
    for (size_t m = 0; m < measures; m++) {
      seen[m] = hypot(seen[m], distance[m] / sqrt(2.0 * (parted ? run : RUNS - 1)));
    }
  }
  for (size_t m = 0; m < rot_ode_steering(p); m++) {
    coarse->propagation->worst[m] = fmin(coarse->propagation->worst[m], seen[m]);
  }
  coarse->propagation->seen = 1;
  return ROT_OK;
}
