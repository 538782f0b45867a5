/* One step of an ordinary differential equation, with the names of GSL that the core uses. */
#ifndef ROTDYN_FEW_ODEIV2_H
#define ROTDYN_FEW_ODEIV2_H

#include <stddef.h>

typedef struct gsl_odeiv2_system {
  int (*function)(double t, const double y[], double dydt[], void *params);
  int (*jacobian)(double t, const double y[], double *dfdy, double dfdt[], void *params);
  size_t dimension;
  void *params;
} gsl_odeiv2_system;

typedef struct gsl_odeiv2_step_type {
  const char *name;
} gsl_odeiv2_step_type;

typedef struct gsl_odeiv2_step gsl_odeiv2_step;

extern const gsl_odeiv2_step_type *gsl_odeiv2_step_rk8pd;

gsl_odeiv2_step *gsl_odeiv2_step_alloc(const gsl_odeiv2_step_type *type, size_t dim);
void gsl_odeiv2_step_free(gsl_odeiv2_step *step);
int gsl_odeiv2_step_apply(gsl_odeiv2_step *step, double t, double h, double y[], double yerr[],
                          const double dydt_in[], double dydt_out[],
                          const gsl_odeiv2_system *system);

#endif
