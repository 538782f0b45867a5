/* A free body by GSL's rk8pd with adaptive steps: quaternion, body to space, and angular velocity.
 *
 *   space-gsl TOLERANCE I1 I2 I3 w1 w2 w3 t ...
 *
 * A line for each time: t, the quaternion, the angular velocity along the body's axes, CPU seconds,
 * right-hand sides. */
#include <gsl/gsl_errno.h>
#include <gsl/gsl_odeiv2.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

static double moment[3];
static long calls;

static int rates(double t, const double y[], double f[], void *ctx) {
  const double *w = y + 4;
  (void)t, (void)ctx;
  calls++;
  f[0] = 0.5 * (-y[1] * w[0] - y[2] * w[1] - y[3] * w[2]);
  f[1] = 0.5 * (y[0] * w[0] + y[2] * w[2] - y[3] * w[1]);
  f[2] = 0.5 * (y[0] * w[1] + y[3] * w[0] - y[1] * w[2]);
  f[3] = 0.5 * (y[0] * w[2] + y[1] * w[1] - y[2] * w[0]);
  f[4] = (moment[1] - moment[2]) / moment[0] * w[1] * w[2];
  f[5] = (moment[2] - moment[0]) / moment[1] * w[2] * w[0];
  f[6] = (moment[0] - moment[1]) / moment[2] * w[0] * w[1];
  return GSL_SUCCESS;
}

int main(int argc, char **argv) {
  if (argc < 9) return 2;
  const double tolerance = atof(argv[1]);
  double y[7] = {1.0, 0.0, 0.0, 0.0}, t = 0.0;
  for (int i = 0; i < 3; i++) {
    moment[i] = atof(argv[2 + i]);
    y[4 + i] = atof(argv[5 + i]);
  }
  gsl_odeiv2_system system = {rates, NULL, 7, NULL};
  gsl_odeiv2_driver *driver =
      gsl_odeiv2_driver_alloc_y_new(&system, gsl_odeiv2_step_rk8pd, 1e-2, tolerance, tolerance);
  const clock_t start = clock();
  for (int i = 8; i < argc; i++) {
    if (gsl_odeiv2_driver_apply(driver, &t, atof(argv[i]), y) != GSL_SUCCESS) return 1;
    printf("%.17g", t);
    for (int k = 0; k < 7; k++) printf(" %.17g", y[k]);
    printf(" %.6g %ld\n", (double)(clock() - start) / CLOCKS_PER_SEC, calls);
  }
  gsl_odeiv2_driver_free(driver);
  return 0;
}
