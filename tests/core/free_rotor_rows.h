/* Rows of a free body with rotors, for its tests. */
#ifndef FREE_ROTOR_ROWS_H
#define FREE_ROTOR_ROWS_H

#include <string.h>

#include "rot_free_ode.h"

enum { ROWS = 8 };

typedef struct rows {
#define X(type, name) type name[ROWS];
  ROT_FREE_COLUMNS(X)
#undef X
  double speed[ROT_FREE_MOST_ROTORS][ROWS], momentum[ROT_FREE_MOST_ROTORS][ROWS];
  double *speeds[ROT_FREE_MOST_ROTORS], *momenta[ROT_FREE_MOST_ROTORS];
} rows;

static double flows[ROT_FREE_FLOWS][ROWS], flow_error[ROT_FREE_FLOWS];

static inline rot_free_columns columns_of(rows *r) {
  rot_free_columns out;
#define X(type, name) out.name = r->name;
  ROT_FREE_COLUMNS(X)
#undef X
  for (int k = 0; k < ROT_FREE_MOST_ROTORS; k++) {
    r->speeds[k] = r->speed[k];
    r->momenta[k] = r->momentum[k];
  }
  out.rotor_omega = r->speeds;
  out.rotor_momentum = r->momenta;
  return out;
}

static inline rot_free_params scene(double a, double b, double c, double x, double y, double z) {
  rot_free_params p;
  memset(&p, 0, sizeof p);
  p.moment_kg_m2[0] = a, p.moment_kg_m2[1] = b, p.moment_kg_m2[2] = c;
  p.omega0_rad_per_s[0] = x, p.omega0_rad_per_s[1] = y, p.omega0_rad_per_s[2] = z;
  p.axes[0] = p.q0[0] = 1.0;
  return p;
}

static inline rot_status integrated(const rot_free_params *p, double accuracy, size_t n,
                                    const double t[], rows *r, rot_info *info) {
  const rot_free_columns out = columns_of(r);
  double *flow[ROT_FREE_FLOWS];
  const rot_free_ode_options options = {accuracy, 1000000, ROT_METHOD_NONE};
  for (int k = 0; k < ROT_FREE_FLOWS; k++) flow[k] = flows[k];
  return rot_free_integrate(p, &options, n, t, &out, flow, flow_error, NULL, NULL, info);
}

#endif
