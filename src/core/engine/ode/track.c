#include "engine/ode/track.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

void rot_ode_track_free(rot_ode_track *track) {
  rot_dense_free(&track->nodes);
  free(track->derivative);
  track->derivative = NULL;
  track->room = 0;
}

rot_status rot_ode_track_node(rot_ode_track *track, const rot_ode_params *p, double t,
                              const double y[], const double slope[]) {
  const size_t each = p->dim * p->controlled;
  track->controlled = p->controlled;
  track->nodes.dim = p->dim;
  track->nodes.slopes = 1;
  if (rot_dense_insert(&track->nodes, track->nodes.count, t, y, slope) != ROT_OK) {
    return ROT_ENOMEM;
  }
  if (track->room != track->nodes.room) {
    double *more = realloc(track->derivative, track->nodes.room * each * sizeof *more);
    if (!more) return ROT_ENOMEM;
    track->derivative = more;
    track->room = track->nodes.room;
  }
  for (size_t i = 0; i < each; i++) track->derivative[(track->nodes.count - 1) * each + i] = NAN;
  return ROT_OK;
}

void rot_ode_track_derivative(rot_ode_track *track, size_t i, const double rise[], double step) {
  const size_t dim = track->nodes.dim, n = track->controlled;
  const double *node = rot_dense_node(&track->nodes, track->nodes.count - 1);
  double *d = track->derivative + (track->nodes.count - 1) * dim * n;
  for (size_t k = 0; k < dim; k++) d[k * n + i] = (rise[k] - node[1 + dim + k]) / step;
}
