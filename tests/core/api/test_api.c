/* The C interface: numbers against mpmath, structs of other sizes, refusals, threads. */
#include "api/api.h"

#include <stdlib.h>

#include "rot_test.h"

#ifndef _WIN32
#include <pthread.h>
#endif

static const double knot_s[] = {0.0, 1.0, 4.0, 6.0, 8.0}, knot_n_m[] = {0.0, 0.8, 0.8, 0.0, 0.0};

/* A disk of 2 kg and 0.25 m under a torque that rises, is constant and falls. */
static rotdyn_axle disk(void) {
  rotdyn_axle axle = ROTDYN_INIT(rotdyn_axle);
  axle.inertia_kg_m2 = 0.0625;
  axle.viscous_n_m_s = 0.03;
  axle.n_knots = 5;
  axle.knot_time_s = knot_s;
  axle.knot_torque_n_m = knot_n_m;
  return axle;
}

/* theta and omega at one time, and the report. */
typedef struct one {
  double theta, omega;
  int status;
  rotdyn_info info;
} one;

static one at(const rotdyn_axle *axle, double time_s, const rotdyn_options *options) {
  one x = {0};
  rotdyn_axle_columns out = ROTDYN_INIT(rotdyn_axle_columns);
  out.theta_rad = &x.theta;
  out.omega_rad_per_s = &x.omega;
  x.info.size = sizeof x.info;
  x.status = rotdyn_axle_rows(axle, 1, &time_s, options, &out, &x.info);
  return x;
}

static int refused(const one *x, const char *words) {
  return x->status == ROTDYN_EARGUMENT && x->info.status == ROTDYN_EARGUMENT &&
         strstr(x->info.reason, words) != NULL;
}

/* ---- the table ------------------------------------------------------------------------------- */

static void check_table(void) {
  const rotdyn_api *api = rotdyn_get_api(ROTDYN_API_MAJOR);
  ROT_CHECK(api && api->size == sizeof *api && api->major == 1 && api->minor == ROTDYN_API_MINOR);
  ROT_CHECK(!rotdyn_get_api(0) && !rotdyn_get_api(2) && !rotdyn_get_api(-1));
  ROT_CHECK(!strcmp(api->version(), ROTDYN_VERSION));
#define X(result, name, arguments) ROT_CHECK(ROTDYN_HAS(api, name) && api->name == rotdyn_##name);
  ROTDYN_FUNCTIONS(X)
#undef X
  rotdyn_api older = *api;
  older.size = offsetof(rotdyn_api, axle_sweep);
  ROT_CHECK(!ROTDYN_HAS(&older, axle_sweep) && ROTDYN_HAS(&older, axle_rows));
  for (int i = 0; i <= ROTDYN_EINTERNAL; i++) {
    ROT_CHECK(strcmp(api->status_text(i), "unknown status"));
  }
  ROT_CHECK(!strcmp(api->status_text(ROTDYN_EINTERNAL), "a fault of the library"));
  ROT_CHECK(!strcmp(api->status_text(-1), "unknown status"));
  ROT_CHECK(!strcmp(api->status_text(ROTDYN_EINTERNAL + 1), "unknown status"));
}

static void check_rolling(void) {
  const double beta[] = {1.0, 0.5, 0.4, 0.66666666666666667, 0.0};
  const double a[] = {1.6770359192723345418, 2.2360478923631127224, 2.3957655989604778788,
                      2.0124431031268014948, 3.3540718385446690836};
  const double v[] = {3.1315571206669693163, 3.6160106931995282146, 3.7429266623859996428,
                      3.4304489502104530763, 4.4286905513932669493};
  for (int i = 0; i < 5; i++) {
    ROT_CHECK_ULP(rotdyn_rolling_acceleration(beta[i], 20.0, 9.80665), a[i], 2);
    ROT_CHECK_ULP(rotdyn_rolling_final_speed(beta[i], 1.0, 9.80665), v[i], 2);
  }
  ROT_CHECK_ULP(rotdyn_rolling_rotational_fraction(0.5), 1.0 / 3.0, 1);
  ROT_CHECK_ULP(rotdyn_rolling_translational_fraction(0.5), 2.0 / 3.0, 1);
  ROT_CHECK_ULP(rotdyn_rolling_friction(1.0, 20.0), 0.18198511713310118068, 3);
  /* Outside the domain. */
  ROT_CHECK(isnan(rotdyn_rolling_acceleration(-0.1, 20.0, 9.8)));
  ROT_CHECK(isnan(rotdyn_rolling_acceleration(0.4, 91.0, 9.8)));
  ROT_CHECK(isnan(rotdyn_rolling_final_speed(0.4, -1.0, 9.8)));
  ROT_CHECK(isnan(rotdyn_rolling_friction(0.4, (double)NAN)));
  rotdyn_energies e = ROTDYN_INIT(rotdyn_energies);
  ROT_CHECK_EQ_INT(rotdyn_rolling_energies(2.0, 0.5, 0.5, 3.0, &e), ROTDYN_OK);
  ROT_CHECK_ULP(e.inertia_kg_m2, 0.25, 0);
  ROT_CHECK_ULP(e.omega_rad_per_s, 6.0, 0);
  ROT_CHECK_ULP(e.translational_j, 9.0, 0);
  ROT_CHECK_ULP(e.rotational_j, 4.5, 0);
  ROT_CHECK_ULP(e.total_j, 13.5, 0);
  ROT_CHECK_EQ_INT(rotdyn_rolling_energies(-2.0, 0.5, 0.5, 3.0, &e), ROTDYN_EARGUMENT);
  ROT_CHECK_EQ_INT(rotdyn_rolling_energies(2.0, 0.0, 0.5, 3.0, &e), ROTDYN_EARGUMENT);
  ROT_CHECK_EQ_INT(rotdyn_rolling_energies(2.0, 0.5, 0.5, 3.0, NULL), ROTDYN_EARGUMENT);
}

static void check_shapes(void) {
  rotdyn_shape shape = ROTDYN_INIT(rotdyn_shape);
  rotdyn_moments m = ROTDYN_INIT(rotdyn_moments);
  const double sizes[] = {0.2, 0.1};
  size_t n = 0;
  while (rotdyn_shape_at(n, &shape) == ROTDYN_OK) {
    double x[4] = {3.0, 3.0, 3.0, 3.0};
    ROT_CHECK(shape.n_sizes <= 4 && *shape.name);
    ROT_CHECK_EQ_INT(rotdyn_shape_moments(shape.name, 1.0, shape.n_sizes, x, &m), ROTDYN_OK);
    n++;
  }
  ROT_CHECK(n >= 30);
  ROT_CHECK_EQ_INT(rotdyn_shape_at(n, &shape), ROTDYN_EEND);
  /* 2/5 m (R^5 - r^5)/(R^3 - r^3) */
  ROT_CHECK_EQ_INT(rotdyn_shape_moments("hollow_sphere", 3.0, 2, sizes, &m), ROTDYN_OK);
  ROT_CHECK_REL(m.moment_kg_m2, 0.053142857142857148757, 4e-16);
  ROT_CHECK_ULP(m.ixx_kg_m2, m.izz_kg_m2, 1);
  ROT_CHECK_REL(m.beta, 0.053142857142857148757 / (3.0 * 0.2 * 0.2), 6e-16);
  ROT_CHECK_EQ_INT(rotdyn_shape_moments("disk", 2.0, 1, (double[]){0.25}, &m), ROTDYN_OK);
  ROT_CHECK_ULP(m.izz_kg_m2, 0.0625, 0);
  ROT_CHECK_ULP(m.ixx_kg_m2, 0.03125, 0);
  ROT_CHECK(m.size == sizeof m);
  /* A right triangle, legs 3 and 4 from the origin: Ixy about its centre is +m a b/36. */
  ROT_CHECK_EQ_INT(rotdyn_shape_moments("triangle", 1.0, 3, (double[]){3.0, 4.0, 0.0}, &m), 0);
  ROT_CHECK_REL(m.ixy_kg_m2, 12.0 / 36.0, 1e-15);
  ROT_CHECK_EQ_INT(rotdyn_shape_moments("dusk", 2.0, 1, sizes, &m), ROTDYN_ENAME);
  ROT_CHECK_EQ_INT(rotdyn_shape_moments("disk", 2.0, 2, sizes, &m), ROTDYN_EARGUMENT);
  ROT_CHECK_EQ_INT(rotdyn_shape_moments("disk", -2.0, 1, sizes, &m), ROTDYN_EARGUMENT);
  ROT_CHECK_EQ_INT(rotdyn_shape_moments("disk", 2.0, 1, (double[]){-1.0}, &m), ROTDYN_EARGUMENT);
  ROT_CHECK_EQ_INT(rotdyn_shape_moments("disk", 2.0, 1, NULL, &m), ROTDYN_EARGUMENT);
}

/* The article's fast rotor: m g l = 0.392266 N m, L = 1 kg m^2/s. */
static void check_tops(void) {
  rotdyn_top top = ROTDYN_INIT(rotdyn_top);
  rotdyn_top_rates r = ROTDYN_INIT(rotdyn_top_rates);
  top.mass_kg = 0.5;
  top.lever_arm_m = 0.08;
  top.axial_kg_m2 = 0.002;
  top.spin_rad_per_s = 500.0;
  top.axis_angle_deg = 90.0;
  top.gravity_m_per_s2 = 9.80665;
  ROT_CHECK_EQ_INT(rotdyn_precession_rates(&top, &r), ROTDYN_OK);
  ROT_CHECK_REL(r.torque_n_m, 0.392266, 4e-16);
  ROT_CHECK_ULP(r.momentum_kg_m2_per_s, 1.0, 0);
  ROT_CHECK_REL(r.precession_rad_per_s, 0.392266, 4e-16);
  ROT_CHECK_REL(r.period_s, 16.017664817189322, 4e-16); /* 2 pi/0.392266 */
  ROT_CHECK(r.formula_error == 0.0 && isnan(r.fast_rad_per_s) && isnan(r.nutation_period_s));
  /* Steady: the slow and the fast rate have the sum L/(I1 cos) and the product m g l/(I1 cos). */
  top.axis_angle_deg = 60.0;
  top.transverse_kg_m2 = 0.0042;
  ROT_CHECK_EQ_INT(rotdyn_precession_rates(&top, &r), ROTDYN_OK);
  ROT_CHECK_REL(r.slow_rad_per_s + r.fast_rad_per_s, 1.0 / (0.0042 * 0.5), 2e-15);
  ROT_CHECK_REL(r.slow_rad_per_s * r.fast_rad_per_s, 0.392266 / (0.0042 * 0.5), 2e-15);
  ROT_CHECK(r.lowest_angle_deg > 60.0 && r.nutation_period_s > 0.0);
  top.transverse_kg_m2 = 0.0005;
  ROT_CHECK_EQ_INT(rotdyn_precession_rates(&top, &r), ROTDYN_EARGUMENT);
  top.transverse_kg_m2 = top.spin_rad_per_s = 0.0;
  ROT_CHECK_EQ_INT(rotdyn_precession_rates(&top, &r), ROTDYN_EARGUMENT);
  ROT_CHECK_EQ_INT(rotdyn_precession_rates(NULL, &r), ROTDYN_EARGUMENT);
}

static void check_models(void) {
  rotdyn_model m = ROTDYN_INIT(rotdyn_model);
  size_t n = 0, axle = 0;
  while (rotdyn_model_at(n, &m) == ROTDYN_OK) {
    ROT_CHECK(m.error > 0.0 && *m.why);
    axle += !strcmp(m.constraint, "axle");
    n++;
  }
  ROT_CHECK(axle == 10 && n > axle);
  ROT_CHECK_EQ_INT(rotdyn_model_at(n, &m), ROTDYN_EEND);
  ROT_CHECK_EQ_INT(rotdyn_model_at((size_t)-1, &m), ROTDYN_EEND);
}

/* ---- the axle -------------------------------------------------------------------------------- */

static void check_spin_up(void) {
  const double time_s[] = {0.5, 3.0, 8.0};
  const double theta[] = {0.25140496914891098451, 28.00522306631831973, 107.85864533301710375};
  const double omega[] = {1.4793256148085228207, 18.557492928167208804, 5.8278502401517953138};
  const rotdyn_axle axle = disk();
  double x[7][3];
  rotdyn_axle_columns out = {sizeof out, x[0], x[1], x[2], x[3], x[4], x[5], x[6]};
  rotdyn_info info = ROTDYN_INIT(rotdyn_info);
  ROT_CHECK_EQ_INT(rotdyn_axle_rows(&axle, 3, time_s, NULL, &out, &info), ROTDYN_OK);
  ROT_CHECK(!strcmp(info.model, "axle_linear") && info.error_is_bound && info.rows_done == 3);
  ROT_CHECK(info.error > 0.0 && info.error < 1e-14 && !*info.reason);
  for (int i = 0; i < 3; i++) {
    ROT_CHECK_REL(x[0][i], theta[i], 1e-15);
    ROT_CHECK_REL(x[1][i], omega[i], 1e-15);
    ROT_CHECK_ULP(x[3][i], -0.03 * x[1][i], 0);
    ROT_CHECK_ULP(x[4][i], x[2][i] + x[3][i], 0);
    ROT_CHECK_ULP(x[5][i], 0.0625 * x[1][i], 0);
    ROT_CHECK_REL(x[6][i], 0.5 * 0.0625 * omega[i] * omega[i], 1e-15);
  }
  ROT_CHECK_ULP(x[2][0], 0.4, 0);
  ROT_CHECK_REL(info.largest_omega_rad_per_s, 18.9, 0.2); /* at more times than the rows */
  /* The same numbers where columns are left out, without a report, without a row. */
  double alone[3];
  rotdyn_axle_columns few = ROTDYN_INIT(rotdyn_axle_columns);
  few.omega_rad_per_s = alone;
  ROT_CHECK_EQ_INT(rotdyn_axle_rows(&axle, 3, time_s, NULL, &few, NULL), ROTDYN_OK);
  ROT_CHECK(!memcmp(alone, x[1], sizeof alone));
  ROT_CHECK_EQ_INT(rotdyn_axle_rows(&axle, 0, NULL, NULL, &few, &info), ROTDYN_OK);
  ROT_CHECK_EQ_INT(info.rows_done, 0);
}

/* Each closed form is what the choice takes; references of mpmath, 40 digits. */
static void check_closed_forms(void) {
  rotdyn_axle axle = ROTDYN_INIT(rotdyn_axle);
  rotdyn_term term = ROTDYN_INIT(rotdyn_term);
  axle.inertia_kg_m2 = 2.0;
  axle.theta0_rad = 1.0;
  axle.n_terms = 1;
  axle.terms = &term;
  term.kind = "gravity";
  term.n_x = 2;
  term.x = (double[]){19.5, 0.0};
  one x = at(&axle, 1.0, NULL);
  ROT_CHECK(x.status == ROTDYN_OK && !strcmp(x.info.model, "axle_pendulum"));
  ROT_CHECK_REL(x.theta, -0.97827747599739700569, 1e-14);
  ROT_CHECK_REL(x.omega, -0.59491539467318678721, 1e-14);
  axle.inertia_kg_m2 = 0.5;
  axle.viscous_n_m_s = 0.2;
  axle.theta0_rad = 0.3;
  term.kind = "spring";
  term.x = (double[]){8.0, 0.0};
  x = at(&axle, 2.0, NULL);
  ROT_CHECK(!strcmp(x.info.model, "axle_oscillator"));
  ROT_CHECK_REL(x.theta, -0.017292823763693817845, 1e-13);
  ROT_CHECK_REL(x.omega, -0.79795331558058467284, 1e-14);
  axle.theta0_rad = 0.0;
  term.kind = "sinusoid";
  term.n_x = 3;
  term.x = (double[]){1.5, 3.0, 0.25};
  x = at(&axle, 2.0, NULL);
  ROT_CHECK(!strcmp(x.info.model, "axle_forced"));
  ROT_CHECK_REL(x.theta, -0.53164406741112678458, 1e-13);
  ROT_CHECK_REL(x.omega, -0.067925548837629020837, 1e-13);
  axle.n_terms = 0;
  axle.viscous_n_m_s = 0.0;
  axle.quadratic_n_m_s2 = 0.25;
  axle.before_n_m = axle.after_n_m = 2.0;
  x = at(&axle, 0.75, NULL);
  ROT_CHECK(!strcmp(x.info.model, "axle_drag"));
  ROT_CHECK_REL(x.theta, 0.96145700114501991779, 1e-14);
  ROT_CHECK_REL(x.omega, 2.2229072552546211283, 1e-14);
  /* A skater: I omega stays. */
  axle.quadratic_n_m_s2 = axle.before_n_m = axle.after_n_m = 0.0;
  axle.inertia_kg_m2 = 0.0;
  axle.omega0_rad_per_s = 2.0;
  axle.n_inertia = 2;
  axle.inertia_time_s = (double[]){0.0, 1.0};
  axle.inertia_knots_kg_m2 = (double[]){3.0, 1.0};
  x = at(&axle, 1.0, NULL);
  ROT_CHECK(!strcmp(x.info.model, "axle_skater"));
  ROT_CHECK_REL(x.theta, 3.2958368660043290, 1e-14); /* 3 log(3) */
  ROT_CHECK_ULP(x.omega, 6.0, 1);
}

static int twist(double t, double theta, double omega, double *torque, void *context) {
  (void)theta;
  *torque = 2.0 - 0.25 * omega * fabs(omega);
  if (context && t > *(double *)context) return 1;
  return 0;
}

static int no_number(double t, double theta, double omega, double *torque, void *context) {
  (void)theta, (void)omega, (void)context;
  *torque = t > 0.5 ? (double)NAN : 1.0;
  return 0;
}

static int count_poll(void *context, double fraction) {
  int *calls = context;
  ROT_CHECK(fraction >= 0.0 && fraction <= 1.0);
  return ++*calls >= 3;
}

static void check_integrated(void) {
  rotdyn_axle axle = ROTDYN_INIT(rotdyn_axle);
  rotdyn_options options = ROTDYN_INIT(rotdyn_options);
  double limit = 0.5;
  axle.inertia_kg_m2 = 0.5;
  axle.torque = twist;
  one x = at(&axle, 0.75, NULL);
  ROT_CHECK(x.status == ROTDYN_OK && !strcmp(x.info.model, "axle_rk8pd"));
  ROT_CHECK(!x.info.error_is_bound && x.info.error <= 1e-9 && x.info.steps > 0);
  ROT_CHECK_REL(x.theta, 0.96145700114501991779, x.info.error);
  ROT_CHECK_REL(x.omega, 2.2229072552546211283, x.info.error);
  options.accuracy = 1e-4;
  x = at(&axle, 0.75, &options);
  ROT_CHECK(x.info.error > 1e-9 && x.info.error <= 1e-4);
  options.accuracy = 1e-12;
  options.model = "axle_radau";
  x = at(&axle, 0.75, &options);
  ROT_CHECK(x.status == ROTDYN_OK && !strcmp(x.info.model, "axle_radau"));
  ROT_CHECK_REL(x.omega, 2.2229072552546211283, 1e-12);
  axle.torque_context = &limit;
  x = at(&axle, 0.75, &options);
  ROT_CHECK_EQ_INT(x.status, ROTDYN_ESTOPPED);
  axle.torque = no_number;
  ROT_CHECK_EQ_INT(at(&axle, 0.75, NULL).status, ROTDYN_ETORQUE);
  axle.torque = twist;
  axle.torque_context = NULL;
  options.model = "axle_rk8pd";
  options.max_steps = 2.0;
  x = at(&axle, 1e6, &options);
  ROT_CHECK_EQ_INT(x.status, ROTDYN_EBUDGET);
  ROT_CHECK(x.info.rows_done == 0);
}

static void check_stops(void) {
  rotdyn_axle axle = disk();
  rotdyn_options options = ROTDYN_INIT(rotdyn_options);
  rotdyn_axle_columns out = ROTDYN_INIT(rotdyn_axle_columns);
  rotdyn_info info = ROTDYN_INIT(rotdyn_info);
  const size_t n = 200000;
  double *t = malloc(n * sizeof *t);
  int calls = 0;
  ROT_CHECK(t != NULL);
  for (size_t i = 0; t && i < n; i++) t[i] = 8.0 * (double)i / (double)n;
  options.poll = count_poll;
  options.poll_context = &calls;
  ROT_CHECK_EQ_INT(rotdyn_axle_rows(&axle, n, t, &options, &out, &info), ROTDYN_ESTOPPED);
  ROT_CHECK(calls == 3 && info.rows_done > 0 && info.rows_done < n);
  free(t);
}

/* A brake: it comes to rest at I omega0/tau and stays there. */
static void check_events(void) {
  rotdyn_axle axle = ROTDYN_INIT(rotdyn_axle);
  rotdyn_options options = ROTDYN_INIT(rotdyn_options);
  rotdyn_events events = ROTDYN_INIT(rotdyn_events);
  double when[1] = {0.0};
  const char *name[1] = {NULL};
  events.room = 1;
  events.time_s = when;
  events.name = name;
  options.events = &events;
  axle.inertia_kg_m2 = 0.5;
  axle.omega0_rad_per_s = 3.0;
  axle.coulomb_n_m = 0.75;
  one x = at(&axle, 5.0, &options);
  ROT_CHECK(x.status == ROTDYN_OK && x.omega == 0.0);
  ROT_CHECK_REL(x.theta, 3.0, 1e-15); /* I omega0^2/(2 tau) */
  ROT_CHECK_EQ_INT(events.count, 1);
  ROT_CHECK(name[0] && !strcmp(name[0], "stick"));
  ROT_CHECK_REL(when[0], 2.0, 1e-15);
}

/* ---- the choice ------------------------------------------------------------------------------ */

static void check_choice(void) {
  rotdyn_axle axle = disk();
  rotdyn_options options = ROTDYN_INIT(rotdyn_options);
  rotdyn_candidate chosen = ROTDYN_INIT(rotdyn_candidate), c = ROTDYN_INIT(rotdyn_candidate);
  const double end = 8.0;
  double cost = 0.0;
  size_t k = 0;
  ROT_CHECK_EQ_INT(rotdyn_axle_choose(&axle, 1, &end, NULL, &chosen), ROTDYN_OK);
  ROT_CHECK(!strcmp(chosen.model, "axle_linear") && chosen.applies && chosen.error_is_bound);
  for (; rotdyn_axle_candidate(&axle, 1, &end, NULL, k, &c) == ROTDYN_OK; k++) {
    ROT_CHECK(c.cost_s >= cost && (c.applies || *c.reason));
    cost = c.cost_s;
  }
  ROT_CHECK_EQ_INT(k, 10);
  ROT_CHECK_EQ_INT(rotdyn_axle_candidate(&axle, 1, &end, NULL, k, &c), ROTDYN_EEND);
  /* Drag that 1e-6 does not see, with its bound, and that 1e-12 does. */
  axle.quadratic_n_m_s2 = 1e-12;
  options.accuracy = 1e-6;
  one x = at(&axle, end, &options);
  ROT_CHECK(!strcmp(x.info.model, "axle_linear") &&
            strstr(x.info.reason, "quadratic drag ignored"));
  ROT_CHECK(x.info.error > 1e-12 && x.info.error < 1e-6);
  options.accuracy = 1e-12;
  x = at(&axle, end, &options);
  ROT_CHECK(!strcmp(x.info.model, "axle_rk8pd") && !*x.info.reason);
  ROT_CHECK_REL(x.omega, 5.8278502401517953138, 2e-9); /* the drag takes 1e-9 */
  /* The model asked for; none that reaches the accuracy. */
  options.model = "axle_free";
  x = at(&axle, end, &options);
  ROT_CHECK_EQ_INT(x.status, ROTDYN_EMODEL);
  ROT_CHECK(strstr(x.info.reason, "it does not take") && !x.info.model);
  options.model = "axle_none";
  ROT_CHECK_EQ_INT(at(&axle, end, &options).status, ROTDYN_EMODEL);
  options.model = NULL;
  options.accuracy = 1e-15;
  x = at(&axle, end, &options);
  ROT_CHECK_EQ_INT(x.status, ROTDYN_EACCURACY);
  ROT_CHECK(strstr(x.info.reason, "the best promises 1e-13"));
  ROT_CHECK_EQ_INT(rotdyn_axle_choose(&axle, 1, &end, &options, &c), ROTDYN_EACCURACY);
  /* Friction does not run backward in time. */
  axle.coulomb_n_m = 0.1;
  options.accuracy = 1e-9;
  x = at(&axle, -1.0, &options);
  ROT_CHECK_EQ_INT(x.status, ROTDYN_EMODEL);
  ROT_CHECK(strstr(x.info.reason, "backwards"));
}

/* ---- structs of other sizes ------------------------------------------------------------------ */

static void check_sizes(void) {
  struct {
    rotdyn_axle axle;
    double later;
  } newer;
  struct {
    rotdyn_info info;
    double beyond;
  } report;
  const double end = 8.0;
  const rotdyn_axle axle = disk();
  const one reference = at(&axle, end, NULL);
  /* A newer header: its members are taken where they are 0. */
  memset(&newer, 0, sizeof newer);
  newer.axle = disk();
  newer.axle.size = sizeof newer;
  one x = at(&newer.axle, end, NULL);
  ROT_CHECK(x.status == ROTDYN_OK && x.theta == reference.theta);
  newer.later = 1.0;
  x = at(&newer.axle, end, NULL);
  ROT_CHECK(refused(&x, "beyond this version"));
  /* An older one: what it lacks is 0, and what lies there is not read. */
  rotdyn_axle older = disk();
  older.n_breaks = 7;
  older.breaks_s = NULL;
  ROT_CHECK(refused((x = at(&older, end, NULL), &x), "breaks"));
  older.size = offsetof(rotdyn_axle, n_breaks);
  x = at(&older, end, NULL);
  ROT_CHECK(x.status == ROTDYN_OK && x.theta == reference.theta);
  older.size = 3;
  ROT_CHECK_EQ_INT(at(&older, end, NULL).status, ROTDYN_EARGUMENT);
  /* A report is written as far as it goes. */
  memset(&report, 0, sizeof report);
  rotdyn_axle_columns out = ROTDYN_INIT(rotdyn_axle_columns);
  report.info.size = offsetof(rotdyn_info, steps);
  report.info.error = -7.0;
  ROT_CHECK_EQ_INT(rotdyn_axle_rows(&axle, 1, &end, NULL, &out, &report.info), ROTDYN_OK);
  ROT_CHECK(report.info.rows_done == 1 && report.info.error == -7.0);
  report.info.size = sizeof report;
  report.beyond = -7.0;
  ROT_CHECK_EQ_INT(rotdyn_axle_rows(&axle, 1, &end, NULL, &out, &report.info), ROTDYN_OK);
  ROT_CHECK(report.beyond == -7.0 && report.info.size == sizeof report);
  report.info.size = 0;
  ROT_CHECK_EQ_INT(rotdyn_axle_rows(&axle, 1, &end, NULL, &out, &report.info), ROTDYN_EARGUMENT);
}

static void check_refusals(void) {
  const double nan = (double)NAN, inf = (double)INFINITY, end = 8.0;
  const double back[] = {0.0, 2.0, 1.0, 6.0, 8.0};
  rotdyn_term term = ROTDYN_INIT(rotdyn_term);
  rotdyn_options options = ROTDYN_INIT(rotdyn_options);
  one x;
#define REFUSED(change, words)                                                                     \
  do {                                                                                             \
    rotdyn_axle axle = disk();                                                                     \
    change;                                                                                        \
    x = at(&axle, end, NULL);                                                                      \
    ROT_CHECK(refused(&x, words));                                                                 \
  } while (0)
  REFUSED(axle.inertia_kg_m2 = 0.0, "inertia");
  REFUSED(axle.inertia_kg_m2 = inf, "inertia");
  REFUSED(axle.theta0_rad = nan, "not finite");
  REFUSED(axle.viscous_n_m_s = inf, "not finite");
  REFUSED(axle.quadratic_n_m_s2 = -1.0, "negative");
  REFUSED((axle.coulomb_n_m = 2.0, axle.static_n_m = 1.0), "static friction");
  REFUSED(axle.knot_time_s = back, "knots");
  REFUSED(axle.knot_torque_n_m = NULL, "knots");
  REFUSED(axle.after_n_m = nan, "torque");
  REFUSED((axle.n_knots = 0, axle.after_n_m = 1.0), "without knots");
  REFUSED(axle.n_terms = 1, "`terms` is NULL");
  REFUSED((axle.n_inertia = 2, axle.inertia_time_s = back), "changing inertia");
  REFUSED((axle.n_inertia = 3, axle.inertia_time_s = back, axle.inertia_knots_kg_m2 = back),
          "changing inertia");
  term.kind = "spring";
  REFUSED((axle.n_terms = 1, axle.terms = &term), "no kind or no numbers");
  term.x = back;
  REFUSED((axle.n_terms = 1, axle.terms = &term), "do not fit its kind");
  term.n_x = 2;
  term.kind = "sprung";
  REFUSED((axle.n_terms = 1, axle.terms = &term), "no term of this kind");
  term.kind = "spring";
  term.from_s = 2.0;
  term.to_s = 1.0;
  REFUSED((axle.n_terms = 1, axle.terms = &term), "before it ends");
  const rotdyn_axle axle = disk();
  x = at(&axle, nan, NULL);
  ROT_CHECK(refused(&x, "times"));
  x = at(NULL, end, NULL);
  ROT_CHECK(refused(&x, "NULL"));
  options.accuracy = 2.0;
  x = at(&axle, end, &options);
  ROT_CHECK(refused(&x, "accuracy"));
  options.accuracy = nan;
  x = at(&axle, end, &options);
  ROT_CHECK(refused(&x, "accuracy"));
  options.accuracy = 0.0;
  options.max_steps = -1.0;
  x = at(&axle, end, &options);
  ROT_CHECK(refused(&x, "max_steps"));
  rotdyn_info info = ROTDYN_INIT(rotdyn_info);
  ROT_CHECK_EQ_INT(rotdyn_axle_rows(&axle, 1, &end, NULL, NULL, &info), ROTDYN_EARGUMENT);
  ROT_CHECK_EQ_INT(rotdyn_axle_choose(&axle, 1, &end, NULL, NULL), ROTDYN_EARGUMENT);
}

/* ---- sweep ----------------------------------------------------------------------------------- */

static void check_sweep(void) {
  enum { N = 3 };
  const double inertia[N] = {0.0625, 0.125, 0.0625}, scale[N] = {1.0, 1.0, 2.0}, end = 8.0;
  rotdyn_axle axle = disk();
  rotdyn_sweep_in in = ROTDYN_INIT(rotdyn_sweep_in);
  rotdyn_sweep_out out = ROTDYN_INIT(rotdyn_sweep_out);
  rotdyn_options options = ROTDYN_INIT(rotdyn_options);
  rotdyn_info info = ROTDYN_INIT(rotdyn_info);
  double theta[N], omega[N], most[N], again[N];
  int status[N];
  in.time_s.values = &end;
  in.inertia_kg_m2 = (rotdyn_column){inertia, 1};
  in.torque_scale = (rotdyn_column){scale, 1};
  out.theta_rad = theta;
  out.omega_rad_per_s = omega;
  out.omega_max = most;
  out.status = status;
  ROT_CHECK_EQ_INT(rotdyn_axle_sweep(&axle, N, &in, NULL, &out, &info), ROTDYN_OK);
  ROT_CHECK(!strcmp(info.model, "axle_linear") && info.error > 0.0 && info.error < 1e-13);
  ROT_CHECK_REL(theta[0], 107.85864533301710375, 1e-14);
  ROT_CHECK_REL(omega[0], 5.8278502401517953138, 1e-14);
  ROT_CHECK_REL(theta[2], 2.0 * 107.85864533301710375, 1e-14); /* from rest, it is linear */
  ROT_CHECK(most[0] > omega[0] && status[0] == ROTDYN_OK && status[2] == ROTDYN_OK);
  axle.inertia_kg_m2 = 0.125;
  const one second = at(&axle, end, NULL);
  ROT_CHECK_REL(theta[1], second.theta, 1e-14);
  /* No bit depends on the threads. */
  options.threads = 4;
  out.theta_rad = again;
  out.status = NULL;
  ROT_CHECK_EQ_INT(rotdyn_axle_sweep(&axle, N, &in, &options, &out, NULL), ROTDYN_OK);
  ROT_CHECK(!memcmp(theta, again, sizeof theta));
  /* A motor is part of the law, and scaled with it; friction takes another model. */
  axle.motor_n_m_s = 0.01;
  ROT_CHECK_EQ_INT(rotdyn_axle_sweep(&axle, N, &in, NULL, &out, &info), ROTDYN_OK);
  axle.viscous_n_m_s = 0.05;
  axle.motor_n_m_s = 0.0;
  axle.inertia_kg_m2 = 0.0625;
  ROT_CHECK_REL(again[2], 2.0 * at(&axle, end, NULL).theta, 1e-14);
  axle = disk();
  axle.n_knots = 0;
  axle.before_n_m = axle.after_n_m = 0.5;
  axle.coulomb_n_m = 0.1;
  in.torque_scale.values = NULL;
  out.theta_rad = theta;
  ROT_CHECK_EQ_INT(rotdyn_axle_sweep(&axle, N, &in, NULL, &out, &info), ROTDYN_OK);
  ROT_CHECK(!strcmp(info.model, "axle_drag"));
  ROT_CHECK_REL(theta[0], at(&axle, end, NULL).theta, 1e-14);
  /* Refusals. */
  in.torque_scale.values = scale;
  axle.motor_n_m_s = 0.01;
  ROT_CHECK_EQ_INT(rotdyn_axle_sweep(&axle, N, &in, NULL, &out, &info), ROTDYN_EMODEL);
  axle.torque = twist;
  in.torque_scale.values = NULL;
  ROT_CHECK_EQ_INT(rotdyn_axle_sweep(&axle, N, &in, NULL, &out, &info), ROTDYN_EMODEL);
  const double bad[N] = {1.0, 0.0, 1.0}, before = -1.0;
  in.inertia_kg_m2.values = bad;
  ROT_CHECK_EQ_INT(rotdyn_axle_sweep(&axle, N, &in, NULL, &out, &info), ROTDYN_EARGUMENT);
  ROT_CHECK(strstr(info.reason, "in row 1"));
  in.inertia_kg_m2.values = inertia;
  in.time_s.values = &before;
  ROT_CHECK_EQ_INT(rotdyn_axle_sweep(&axle, N, &in, NULL, &out, &info), ROTDYN_EARGUMENT);
  in.time_s.values = NULL;
  ROT_CHECK_EQ_INT(rotdyn_axle_sweep(&axle, N, &in, NULL, &out, &info), ROTDYN_EARGUMENT);
}

/* ---- threads --------------------------------------------------------------------------------- */

#ifndef _WIN32
/* Each takes long without optimisation (the sanitizers) and under valgrind. */
static int calls(void) { return getenv("ROTDYN_LONG") ? 250000 : rot_test_trials(16000); }

enum { THREADS = 4 };

/* A checksum of the bits of many calls: closed forms, an integrator in every 64th, rolling, shapes.
 * The frame is the same in each thread. */
static void *work(void *frame) {
  uint64_t *sum = frame, bits[2];
  rotdyn_moments m = ROTDYN_INIT(rotdyn_moments);
  double x[2];
  const int n = calls();
  for (int i = 0; i < n; i++) {
    const double t = 0.25 + 8.0 * i / n;
    if (i % 4 == 1) {
      x[0] = rotdyn_rolling_acceleration(t, 20.0, 9.80665);
      x[1] = rotdyn_rolling_final_speed(t, 1.0, 9.80665);
    } else if (i % 4 == 2) {
      (void)rotdyn_shape_moments("hollow_sphere", t, 2, (double[]){t, 0.25}, &m);
      x[0] = m.izz_kg_m2;
      x[1] = m.beta;
    } else {
      rotdyn_axle axle = disk();
      if (i % 64 == 0) axle.torque = twist;
      const one y = at(&axle, t, NULL);
      x[0] = y.theta;
      x[1] = y.omega;
    }
    memcpy(bits, x, sizeof bits);
    *sum = (*sum ^ bits[0]) * UINT64_C(0x9e3779b97f4a7c15);
    *sum = (*sum ^ bits[1]) * UINT64_C(0x9e3779b97f4a7c15);
  }
  return NULL;
}

static void check_threads(void) {
  uint64_t alone = 1, sum[THREADS];
  pthread_t thread[THREADS];
  (void)work(&alone);
  for (int i = 0; i < THREADS; i++) {
    sum[i] = 1;
    ROT_CHECK_EQ_INT(pthread_create(&thread[i], NULL, work, &sum[i]), 0);
  }
  for (int i = 0; i < THREADS; i++) {
    ROT_CHECK_EQ_INT(pthread_join(thread[i], NULL), 0);
    ROT_CHECK(sum[i] == alone);
  }
}
#else
static void check_threads(void) { ROT_CHECK(1); }
#endif

int main(void) {
  check_table();
  check_rolling();
  check_shapes();
  check_tops();
  check_models();
  check_spin_up();
  check_closed_forms();
  check_integrated();
  check_stops();
  check_events();
  check_choice();
  check_sizes();
  check_refusals();
  check_sweep();
  check_threads();
  return rot_test_report("api");
}
