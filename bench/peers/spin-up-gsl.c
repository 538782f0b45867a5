/* The spin-up by GSL's Prince-Dormand 8(7), driven plainly. HOW is "whole", or "split" to stop at
 * the kinks of the torque. The tolerance is 1e-9. */
#include <gsl/gsl_errno.h>
#include <gsl/gsl_odeiv2.h>

#include "child.h"
#include "spin-up.h"

static int rates(double t, const double y[], double out[], void *calls) {
  ++*(long *)calls;
  spin_rates(t, y, out);
  return GSL_SUCCESS;
}

static int solve(const char *how, solution *s) {
  static const double kinks[] = {1.0, 4.0, 6.0};
  const size_t n_kinks = strcmp(how, "split") ? 0 : sizeof kinks / sizeof *kinks;
  gsl_odeiv2_system system = {rates, NULL, 2, &s->rhs_calls};
  gsl_odeiv2_driver *driver =
      gsl_odeiv2_driver_alloc_y_new(&system, gsl_odeiv2_step_rk8pd, 1e-3, 1e-9, 1e-9);
  double t = s->time_s[0], y[2] = {0.0, 0.0};
  size_t kink = 0;
  int status = driver ? GSL_SUCCESS : GSL_ENOMEM;
  s->rhs_calls = 0;
  for (size_t i = 0; i < s->n && status == GSL_SUCCESS; i++) {
    while (status == GSL_SUCCESS && kink < n_kinks && kinks[kink] <= s->time_s[i]) {
      status = gsl_odeiv2_driver_apply(driver, &t, kinks[kink++], y);
      gsl_odeiv2_driver_reset(driver);
    }
    if (status == GSL_SUCCESS && t < s->time_s[i]) {
      status = gsl_odeiv2_driver_apply(driver, &t, s->time_s[i], y);
    }
    s->theta_rad[i] = y[0];
    s->omega_rad_per_s[i] = y[1];
  }
  if (driver) gsl_odeiv2_driver_free(driver);
  return status != GSL_SUCCESS;
}

int main(int argc, char **argv) {
  gsl_set_error_handler_off();
  return child_main(argc, argv, solve);
}
