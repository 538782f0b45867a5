/* The sliding ball by GSL's Prince-Dormand 8(7) and Brent's root finder: the step in which the slip
 * changes sign is repeated to the root. HOW is the tolerance. */
#include <gsl/gsl_errno.h>
#include <gsl/gsl_odeiv2.h>
#include <gsl/gsl_roots.h>
#include <math.h>

#include "child.h"
#include "slip.h"

enum { X, V, THETA, OMEGA, DIM };

typedef struct ball {
  int slides;
  long calls;
} ball;

static double slip_of(const double y[]) { return y[V] - slip_radius * y[OMEGA]; }

static int rates(double t, const double y[], double out[], void *p) {
  ball *b = p;
  const double slip = slip_of(y);
  const double force = b->slides ? -slip_friction * slip_gravity * ((slip > 0) - (slip < 0)) : 0.0;
  (void)t;
  b->calls++;
  out[X] = y[V];
  out[V] = force;
  out[THETA] = y[OMEGA];
  out[OMEGA] = -force / 0.4 / slip_radius;
  return GSL_SUCCESS;
}

/* The slip at the end of one step of length h from a kept state. */
typedef struct probe {
  gsl_odeiv2_step *step;
  const gsl_odeiv2_system *system;
  double t, from[DIM], to[DIM];
} probe;

static double slip_after(double h, void *p) {
  probe *a = p;
  double error[DIM];
  memcpy(a->to, a->from, sizeof a->to);
  gsl_odeiv2_step_apply(a->step, a->t, h, a->to, error, NULL, NULL, a->system);
  return slip_of(a->to);
}

static double end_of_slip(gsl_root_fsolver *solver, probe *a, double h) {
  gsl_function f = {slip_after, a};
  gsl_root_fsolver_set(solver, &f, 0.0, h);
  for (int k = 0; k < 100; k++) {
    gsl_root_fsolver_iterate(solver);
    const double lo = gsl_root_fsolver_x_lower(solver), up = gsl_root_fsolver_x_upper(solver);
    if (gsl_root_test_interval(lo, up, 1e-15, 1e-15) == GSL_SUCCESS) break;
  }
  return gsl_root_fsolver_root(solver);
}

static int solve(const char *how, solution *s) {
  const double tolerance = atof(how);
  ball b = {1, 0};
  gsl_odeiv2_system system = {rates, NULL, DIM, &b};
  probe a = {gsl_odeiv2_step_alloc(gsl_odeiv2_step_rk8pd, DIM), &system, 0.0, {0.0}, {0.0}};
  gsl_odeiv2_step *step = gsl_odeiv2_step_alloc(gsl_odeiv2_step_rk8pd, DIM);
  gsl_odeiv2_control *control = gsl_odeiv2_control_y_new(tolerance, tolerance);
  gsl_odeiv2_evolve *evolve = gsl_odeiv2_evolve_alloc(DIM);
  gsl_root_fsolver *solver = gsl_root_fsolver_alloc(gsl_root_fsolver_brent);
  double t = s->time_s[0], h = 1e-3, y[DIM] = {0.0, slip_speed, 0.0, 0.0};
  int status = GSL_SUCCESS;
  for (size_t i = 0; i < s->n && status == GSL_SUCCESS; i++) {
    while (t < s->time_s[i] && status == GSL_SUCCESS) {
      a.t = t;
      memcpy(a.from, y, sizeof y);
      status = gsl_odeiv2_evolve_apply(evolve, control, step, &system, &t, s->time_s[i], &h, y);
      if (status != GSL_SUCCESS || !b.slides || slip_of(y) > 0.0) continue;
      const double root = end_of_slip(solver, &a, t - a.t);
      slip_after(root, &a);
      t = a.t + root;
      memcpy(y, a.to, sizeof y);
      y[OMEGA] = y[V] / slip_radius;
      b.slides = 0;
      gsl_odeiv2_evolve_reset(evolve);
      gsl_odeiv2_step_reset(step);
    }
    s->theta_rad[i] = y[THETA];
    s->omega_rad_per_s[i] = y[OMEGA];
  }
  s->rhs_calls = b.calls;
  gsl_root_fsolver_free(solver);
  gsl_odeiv2_evolve_free(evolve);
  gsl_odeiv2_control_free(control);
  gsl_odeiv2_step_free(step);
  gsl_odeiv2_step_free(a.step);
  return status != GSL_SUCCESS;
}

int main(int argc, char **argv) {
  gsl_set_error_handler_off();
  return child_main(argc, argv, solve);
}
