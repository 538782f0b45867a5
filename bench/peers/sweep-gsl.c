/* The sweep by GSL's Prince-Dormand 8(7), split at the kinks of the torque: the last state of each
 * row alone, with one driver for all. The tolerance is 1e-9. HOW is not looked at. */
#include <gsl/gsl_errno.h>
#include <gsl/gsl_odeiv2.h>

#include "child.h"
#include "sweep.h"

typedef struct design {
  double inertia, viscous;
  long calls;
} design;

static int rates(double t, const double y[], double out[], void *data) {
  design *d = data;
  d->calls++;
  out[0] = y[1];
  out[1] = (spin_torque(t) - d->viscous * y[1]) / d->inertia;
  return GSL_SUCCESS;
}

static int solve(const char *how, solution *s) {
  static const double stops[] = {1.0, 4.0, 6.0, 8.0};
  design d = {0.0, 0.0, 0};
  gsl_odeiv2_system system = {rates, NULL, 2, &d};
  gsl_odeiv2_driver *driver =
      gsl_odeiv2_driver_alloc_y_new(&system, gsl_odeiv2_step_rk8pd, 1e-1, 1e-9, 1e-9);
  int status = driver ? GSL_SUCCESS : GSL_ENOMEM;
  (void)how;
  for (size_t i = 0; i < s->n && status == GSL_SUCCESS; i++) {
    double t = 0.0, y[2] = {0.0, 0.0};
    d.inertia = sweep_inertia(s->time_s[i]);
    d.viscous = sweep_viscous(s->time_s[i]);
    for (size_t k = 0; k < sizeof stops / sizeof *stops && status == GSL_SUCCESS; k++) {
      gsl_odeiv2_driver_reset(driver);
      status = gsl_odeiv2_driver_apply(driver, &t, stops[k], y);
    }
    s->theta_rad[i] = y[0];
    s->omega_rad_per_s[i] = y[1];
  }
  s->rhs_calls = d.calls;
  if (driver) gsl_odeiv2_driver_free(driver);
  return status != GSL_SUCCESS;
}

int main(int argc, char **argv) {
  gsl_set_error_handler_off();
  return child_main(argc, argv, solve);
}
