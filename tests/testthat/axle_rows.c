/* For test-c-interface.R: rotdyn.h's axle_rows(), called by .C() of R. */
#define ROTDYN_USE_R
#include <rotdyn.h>
#include <stdlib.h>
#include <string.h>

static const rotdyn_api *api;

void begin(void) { api = rotdyn_api_from_r(); }

/* numbers: inertia, start, theta0, omega0, viscous, quadratic, coulomb, static, motor, before,
 * after, accuracy; columns: seven, one after the other. */
void axle_rows(const double *numbers, const int *n_knots, const double *knot_s,
               const double *knot_n_m, const int *n_terms, char **kind, const int *length,
               const double *x, const double *from_s, const double *to_s, const int *n_inertia,
               const double *inertia_s, const double *inertia, const int *n, const double *time_s,
               double *columns, double *error, int *status, char **model) {
  const size_t rows = (size_t)*n;
  rotdyn_axle axle = ROTDYN_INIT(rotdyn_axle);
  rotdyn_options options = ROTDYN_INIT(rotdyn_options);
  rotdyn_axle_columns out = ROTDYN_INIT(rotdyn_axle_columns);
  rotdyn_info info = ROTDYN_INIT(rotdyn_info);
  rotdyn_term *terms = calloc((size_t)*n_terms + 1, sizeof *terms);
  axle.inertia_kg_m2 = numbers[0];
  axle.start_s = numbers[1];
  axle.theta0_rad = numbers[2];
  axle.omega0_rad_per_s = numbers[3];
  axle.viscous_n_m_s = numbers[4];
  axle.quadratic_n_m_s2 = numbers[5];
  axle.coulomb_n_m = numbers[6];
  axle.static_n_m = numbers[7];
  axle.motor_n_m_s = numbers[8];
  axle.before_n_m = numbers[9];
  axle.after_n_m = numbers[10];
  options.accuracy = numbers[11];
  axle.n_knots = (size_t)*n_knots;
  axle.knot_time_s = knot_s;
  axle.knot_torque_n_m = knot_n_m;
  axle.n_terms = (size_t)*n_terms;
  axle.terms = terms;
  for (int i = 0; i < *n_terms; x += length[i++]) {
    terms[i].size = sizeof *terms;
    terms[i].kind = kind[i];
    terms[i].n_x = (size_t)length[i];
    terms[i].x = x;
    terms[i].from_s = from_s[i];
    terms[i].to_s = to_s[i];
  }
  axle.n_inertia = (size_t)*n_inertia;
  axle.inertia_time_s = inertia_s;
  axle.inertia_knots_kg_m2 = inertia;
  out.theta_rad = columns;
  out.omega_rad_per_s = columns + rows;
  out.applied_torque_n_m = columns + 2 * rows;
  out.damping_torque_n_m = columns + 3 * rows;
  out.net_torque_n_m = columns + 4 * rows;
  out.angular_momentum_kg_m2_per_s = columns + 5 * rows;
  out.rotational_kinetic_energy_j = columns + 6 * rows;
  *status = api->axle_rows(&axle, rows, time_s, &options, &out, &info);
  *error = info.error;
  strncpy(model[0], info.model ? info.model : info.reason, 99);
  free(terms);
}
