/* The C interface: rolling, shapes, tops, models, structs of other sizes, the sweep, threads. */
#include "api/api.h"

#include <stdlib.h>

#include "rot_test.h"

#ifndef _WIN32
#include <pthread.h>
#endif

static const double knot_s[] = {0.0, 1.0, 4.0, 6.0, 8.0}, knot_n_m[] = {0.0, 0.8, 0.8, 0.0, 0.0};

/* Sets an input to an object, which is freed. */
static void give(rotdyn_object *object, const char *input, rotdyn_object *part) {
  (void)rotdyn_set_object(object, input, part);
  rotdyn_object_free(part);
}

static void resist(rotdyn_object *scene, const char *name, double value) {
  rotdyn_object *resistance = rotdyn_object_new("resistance");
  (void)rotdyn_set_number(resistance, name, value);
  give(scene, "resistance", resistance);
}

/* A disk of 2 kg and 0.25 m under a torque that rises, is constant and falls. Without checks:
 * threads call it. */
static rotdyn_object *disk(void) {
  rotdyn_object *scene = rotdyn_object_new("scene_axle"),
                *knots = rotdyn_object_new("torque_knots");
  (void)rotdyn_set_number(scene, "body", 0.0625);
  (void)rotdyn_set_numbers(knots, "time_s", 5, knot_s);
  (void)rotdyn_set_numbers(knots, "torque_n_m", 5, knot_n_m);
  give(scene, "torque", knots);
  resist(scene, "viscous_n_m_s", 0.03);
  return scene;
}

/* theta and omega at one time, and the report. */
typedef struct one {
  double theta, omega;
  int status;
  rotdyn_report report;
} one;

static one at(const rotdyn_object *scene, double time_s, const rotdyn_options *options) {
  static const char *const names[] = {"theta_rad", "omega_rad_per_s"};
  one x = {0};
  double *const columns[] = {&x.theta, &x.omega};
  x.report.size = sizeof x.report;
  x.status = rotdyn_scene_run(scene, 1, &time_s, options, 1, 2, names, columns, &x.report);
  return x;
}

static int refused(const one *x, const char *words) {
  return x->status == ROTDYN_EARGUMENT && x->report.status == ROTDYN_EARGUMENT &&
         strstr(x->report.reason, words) != NULL;
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
  ROT_CHECK(!ROTDYN_HAS(&older, axle_sweep) && ROTDYN_HAS(&older, scene_run));
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
  for (int side = -1; side <= 1; side += 2) {
    const double wall = 90.0 * side, over = nextafter(wall, 2.0 * wall);
    ROT_CHECK_ULP(rotdyn_rolling_acceleration(1.0, wall, 9.0), 4.5 * side, 1);
    ROT_CHECK(isnan(rotdyn_rolling_acceleration(1.0, over, 9.0)));
    ROT_CHECK(rotdyn_rolling_friction(1.0, wall) == (double)INFINITY);
    ROT_CHECK(isnan(rotdyn_rolling_friction(1.0, over)));
  }
  ROT_CHECK(isnan(rotdyn_rolling_acceleration(0.4, 20.0, -9.8)));
  ROT_CHECK(isnan(rotdyn_rolling_final_speed(0.4, 1.0, -9.8)));
  ROT_CHECK(isnan(rotdyn_rolling_final_speed(-0.4, 1.0, 9.8)));
  ROT_CHECK(isnan(rotdyn_rolling_rotational_fraction(-0.5)));
  ROT_CHECK(isnan(rotdyn_rolling_translational_fraction(-0.5)));
  ROT_CHECK(isnan(rotdyn_rolling_friction(-0.4, 20.0)));
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
  /* A flat body has I1 = I3/2: less by rounding is one, too. */
  top.transverse_kg_m2 = 0.001 * (1.0 - 1e-10);
  ROT_CHECK_EQ_INT(rotdyn_precession_rates(&top, &r), ROTDYN_OK);
  top.transverse_kg_m2 = 0.001 * (1.0 - 1e-8);
  ROT_CHECK_EQ_INT(rotdyn_precession_rates(&top, &r), ROTDYN_EARGUMENT);
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
  ROT_CHECK(axle == 13 && n > axle);
  ROT_CHECK_EQ_INT(rotdyn_model_at(n, &m), ROTDYN_EEND);
  ROT_CHECK_EQ_INT(rotdyn_model_at((size_t)-1, &m), ROTDYN_EEND);
}

/* ---- structs of other sizes ------------------------------------------------------------------ */

static void check_sizes(void) {
  struct {
    rotdyn_options options;
    double later;
  } newer;
  struct {
    rotdyn_report report;
    double beyond;
  } report;
  const double end = 8.0;
  rotdyn_object *scene = disk();
  const one reference = at(scene, end, NULL);
  ROT_CHECK(reference.status == ROTDYN_OK);
  /* A newer header: its members are taken where they are 0. */
  memset(&newer, 0, sizeof newer);
  newer.options.size = sizeof newer;
  one x = at(scene, end, &newer.options);
  ROT_CHECK(x.status == ROTDYN_OK && x.theta == reference.theta);
  newer.later = 1.0;
  x = at(scene, end, &newer.options);
  ROT_CHECK(refused(&x, "beyond this version"));
  /* An older one: what it lacks is 0, and what lies there is not read. */
  rotdyn_options older = ROTDYN_INIT(rotdyn_options);
  older.model = "axle_none";
  ROT_CHECK_EQ_INT(at(scene, end, &older).status, ROTDYN_EMODEL);
  older.size = offsetof(rotdyn_options, model);
  x = at(scene, end, &older);
  ROT_CHECK(x.status == ROTDYN_OK && x.theta == reference.theta);
  older.size = 3;
  ROT_CHECK_EQ_INT(at(scene, end, &older).status, ROTDYN_EARGUMENT);
  older.size = sizeof older;
  older.model = NULL;
  older.accuracy = 2.0;
  x = at(scene, end, &older);
  ROT_CHECK(refused(&x, "accuracy"));
  older.accuracy = (double)NAN;
  x = at(scene, end, &older);
  ROT_CHECK(refused(&x, "accuracy"));
  older.accuracy = 0.0;
  older.max_steps = -1.0;
  x = at(scene, end, &older);
  ROT_CHECK(refused(&x, "max_steps"));
  /* A report is written as far as it goes. */
  memset(&report, 0, sizeof report);
  report.report.size = offsetof(rotdyn_report, steps);
  report.report.error = -7.0;
#define RUN rotdyn_scene_run(scene, 1, &end, NULL, 0, 0, NULL, NULL, &report.report)
  ROT_CHECK_EQ_INT(RUN, ROTDYN_OK);
  ROT_CHECK(report.report.rows_done == 1 && report.report.error == -7.0);
  report.report.size = sizeof report;
  report.beyond = -7.0;
  ROT_CHECK_EQ_INT(RUN, ROTDYN_OK);
  ROT_CHECK(report.beyond == -7.0 && report.report.size == sizeof report);
  report.report.size = 0;
  ROT_CHECK_EQ_INT(RUN, ROTDYN_EARGUMENT);
#undef RUN
  rotdyn_object_free(scene);
}

/* ---- sweep ----------------------------------------------------------------------------------- */

static int twist(const double *argument, double *torque, void *context) {
  const double omega = argument[2];
  (void)context;
  *torque = 2.0 - 0.25 * omega * fabs(omega);
  return 0;
}

static void check_sweep(void) {
  enum { N = 3 };
  rotdyn_object *motor = rotdyn_object_new("torque_motor");
  (void)rotdyn_set_number(motor, "stall_torque_n_m", 1.0);
  (void)rotdyn_set_number(motor, "no_load_omega_rad_per_s", 100.0);
  const double inertia[N] = {0.0625, 0.125, 0.0625}, scale[N] = {1.0, 1.0, 2.0}, end = 8.0;
  rotdyn_object *axle = disk();
  rotdyn_sweep_in in = ROTDYN_INIT(rotdyn_sweep_in);
  rotdyn_sweep_out out = ROTDYN_INIT(rotdyn_sweep_out);
  rotdyn_options options = ROTDYN_INIT(rotdyn_options);
  rotdyn_report info = ROTDYN_INIT(rotdyn_report);
  double theta[N], omega[N], max[N], again[N];
  int status[N];
  in.time_s.values = &end;
  in.inertia_kg_m2 = (rotdyn_column){inertia, 1};
  in.torque_scale = (rotdyn_column){scale, 1};
  out.theta_rad = theta;
  out.omega_rad_per_s = omega;
  out.omega_max = max;
  out.status = status;
  ROT_CHECK_EQ_INT(rotdyn_axle_sweep(axle, N, &in, NULL, &out, &info), ROTDYN_OK);
  ROT_CHECK(!strcmp(info.model, "axle_linear") && info.error > 0.0 && info.error < 1e-13);
  ROT_CHECK_REL(theta[0], 107.85864533301710375, 1e-14);
  ROT_CHECK_REL(omega[0], 5.8278502401517953138, 1e-14);
  ROT_CHECK_REL(theta[2], 2.0 * 107.85864533301710375, 1e-14); /* from rest, it is linear */
  ROT_CHECK(max[0] > omega[0] && status[0] == ROTDYN_OK && status[2] == ROTDYN_OK);
  (void)rotdyn_set_number(axle, "body", 0.125);
  const one second = at(axle, end, NULL);
  ROT_CHECK_REL(theta[1], second.theta, 1e-14);
  /* No bit depends on the threads. */
  options.threads = 4;
  out.theta_rad = again;
  out.status = NULL;
  ROT_CHECK_EQ_INT(rotdyn_axle_sweep(axle, N, &in, &options, &out, NULL), ROTDYN_OK);
  ROT_CHECK(!memcmp(theta, again, sizeof theta));
  /* A motor is part of the law, and scaled with it; friction takes another model. */
  (void)rotdyn_set_object(axle, "torque", motor);
  ROT_CHECK_EQ_INT(rotdyn_axle_sweep(axle, N, &in, NULL, &out, &info), ROTDYN_OK);
  rotdyn_object_free(axle);
  axle = disk(); /* the torque of the motor twice: 2 - 0.02 omega */
  (void)rotdyn_set_number(axle, "torque", 2.0);
  resist(axle, "viscous_n_m_s", 0.05);
  ROT_CHECK_REL(again[2], at(axle, end, NULL).theta, 1e-14);
  (void)rotdyn_set_number(axle, "torque", 0.5);
  resist(axle, "coulomb_n_m", 0.1);
  in.torque_scale.values = NULL;
  out.theta_rad = theta;
  ROT_CHECK_EQ_INT(rotdyn_axle_sweep(axle, N, &in, NULL, &out, &info), ROTDYN_OK);
  ROT_CHECK(!strcmp(info.model, "axle_drag"));
  ROT_CHECK_REL(theta[0], at(axle, end, NULL).theta, 1e-14);
  /* Refusals. */
  in.torque_scale.values = scale;
  (void)rotdyn_set_object(axle, "torque", motor);
  ROT_CHECK_EQ_INT(rotdyn_axle_sweep(axle, N, &in, NULL, &out, &info), ROTDYN_EMODEL);
  (void)rotdyn_set_law(axle, "torque", twist, NULL);
  in.torque_scale.values = NULL;
  ROT_CHECK_EQ_INT(rotdyn_axle_sweep(axle, N, &in, NULL, &out, &info), ROTDYN_EMODEL);
  const double bad[N] = {1.0, 0.0, 1.0}, before = -1.0;
  in.inertia_kg_m2.values = bad;
  ROT_CHECK_EQ_INT(rotdyn_axle_sweep(axle, N, &in, NULL, &out, &info), ROTDYN_EARGUMENT);
  ROT_CHECK(strstr(info.reason, "in row 1"));
  in.inertia_kg_m2.values = inertia;
  in.time_s.values = &before;
  ROT_CHECK_EQ_INT(rotdyn_axle_sweep(axle, N, &in, NULL, &out, &info), ROTDYN_EARGUMENT);
  in.time_s.values = NULL;
  ROT_CHECK_EQ_INT(rotdyn_axle_sweep(axle, N, &in, NULL, &out, &info), ROTDYN_EARGUMENT);
  ROT_CHECK_EQ_INT(rotdyn_axle_sweep(motor, N, &in, NULL, &out, &info), ROTDYN_EARGUMENT);
  rotdyn_object_free(motor);
  rotdyn_object_free(axle);
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
      rotdyn_object *axle = disk();
      if (i % 64 == 0) (void)rotdyn_set_law(axle, "torque", twist, NULL);
      const one y = at(axle, t, NULL);
      rotdyn_object_free(axle);
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
  check_sizes();
  check_sweep();
  check_threads();
  return rot_test_report("api");
}
