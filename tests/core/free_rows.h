/* Rows of a body in space, with rotors or without, for its tests. */
#ifndef FREE_ROWS_H
#define FREE_ROWS_H

#include <stdlib.h>
#include <string.h>

#include "maths/attitude.h"
#include "scene/free/ode.h"

enum { ROWS = 64, NUMBERS = 14 }; /* NUMBERS: columns that are no rotor's */

typedef struct rows {
#define X(type, name) type name[ROWS];
  ROT_FREE_COLUMNS(X)
#undef X
  double speed[ROT_FREE_MAX_ROTORS][ROWS], momentum[ROT_FREE_MAX_ROTORS][ROWS];
  double *speeds[ROT_FREE_MAX_ROTORS], *momenta[ROT_FREE_MAX_ROTORS];
} rows;

static double flows[ROT_FREE_FLOWS][ROWS], flow_error[ROT_FREE_FLOWS];

static inline rot_free_columns columns_of(rows *r) {
  rot_free_columns out;
#define X(type, name) out.name = r->name;
  ROT_FREE_COLUMNS(X)
#undef X
  for (int k = 0; k < ROT_FREE_MAX_ROTORS; k++) {
    r->speeds[k] = r->speed[k];
    r->momenta[k] = r->momentum[k];
  }
  out.rotor_omega = r->speeds;
  out.rotor_momentum = r->momenta;
  return out;
}

/* The numbers of a row: quaternion, omega in the body and in space, L in space, energy. */
static inline void row_of(const rows *r, size_t i, double out[NUMBERS]) {
  int k = 0;
#define X(type, name) out[k++] = r->name[i];
  ROT_FREE_COLUMNS(X)
#undef X
}

static inline double angle_between(const rows *x, const rows *y, size_t i) {
  double p[NUMBERS], q[NUMBERS];
  row_of(x, i, p);
  row_of(y, i, q);
  return rot_attitude_angle(p, q);
}

static inline double uniform(double low, double high) {
  return low + (high - low) * ((double)rand() / (double)RAND_MAX);
}

static inline rot_free_params scene(double a, double b, double c, double x, double y, double z) {
  rot_free_params p;
  memset(&p, 0, sizeof p);
  p.moment_kg_m2[0] = a, p.moment_kg_m2[1] = b, p.moment_kg_m2[2] = c;
  p.omega0_rad_per_s[0] = x, p.omega0_rad_per_s[1] = y, p.omega0_rad_per_s[2] = z;
  p.axes[0] = p.q0[0] = 1.0;
  return p;
}

static inline rot_status integrated(const rot_free_params *p, double accuracy, rot_method method,
                                    size_t n, const double t[], rows *r, rot_events *events,
                                    rot_info *info) {
  const rot_free_columns out = columns_of(r);
  double *flow[ROT_FREE_FLOWS];
  const rot_free_ode_options options = {accuracy, 1000000, method, 0.0};
  for (int k = 0; k < ROT_FREE_FLOWS; k++) flow[k] = flows[k];
  return rot_free_integrate(p, &options, n, t, &out, flow, flow_error, events, NULL, info);
}

#endif
