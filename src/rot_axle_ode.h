/* The axle with any torque law, integrated. */
#ifndef ROT_AXLE_ODE_H
#define ROT_AXLE_ODE_H

#include "rot_axle.h"
#include "rot_axle_ledger.h"

typedef struct rot_axle_ode_options {
  double accuracy; /* largest error wanted in theta and omega, relative to their largest values */
  size_t max_steps;
} rot_axle_ode_options;

/* The errors in *info and the roundings in *ledger are estimates. The ledger runs from the first
 * row to the last; it is left alone where no row was done. */
rot_status rot_axle_integrate(const rot_axle_params *p, const rot_axle_ode_options *options,
                              size_t n, const double time_s[], const rot_axle_columns *out,
                              rot_axle_ledger *ledger, const rot_hooks *hooks, rot_info *info);

#endif
