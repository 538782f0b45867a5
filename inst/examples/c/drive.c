/* A motor, a clutch that closes in half a second, a load: ./drive [capacity_n_m] */
#include <rotdyn.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { TIMES = 101, ROTORS = 2, ROWS = TIMES * ROTORS };

static int failed = 0;

static void check(const char *input, int status) {
  if (status == ROTDYN_OK) return;
  fprintf(stderr, "%s: %s\n", input ? input : "item of a list", rotdyn_status_text(status));
  failed = 1;
}

static void number(rotdyn_object *object, const char *input, double value) {
  check(input, rotdyn_set_number(object, input, value));
}

/* Gives an object away. */
static void object(rotdyn_object *to, const char *input, rotdyn_object *value) {
  check(input, rotdyn_set_object(to, input, value));
  rotdyn_object_free(value);
}

/* The sum of a motor and a sinusoid. */
static rotdyn_object *drive_torque(void) {
  rotdyn_object *sum = rotdyn_object_new("list");
  rotdyn_object *motor = rotdyn_object_new("torque_motor");
  rotdyn_object *sinusoid = rotdyn_object_new("torque_sinusoid");
  number(motor, "stall_torque_n_m", 40.0);
  number(motor, "no_load_omega_rad_per_s", 200.0);
  number(sinusoid, "amplitude_n_m", 3.0);
  number(sinusoid, "angular_frequency_rad_per_s", 12.0);
  object(sum, NULL, motor);
  object(sum, NULL, sinusoid);
  return sum;
}

static rotdyn_object *clutch(double capacity_n_m) {
  const double time_s[] = {0.0, 0.5}, torque_n_m[] = {0.0, capacity_n_m};
  rotdyn_object *coupling = rotdyn_object_new("coupling_clutch");
  rotdyn_object *closing = rotdyn_object_new("torque_knots");
  check("time_s", rotdyn_set_numbers(closing, "time_s", 2, time_s));
  check("torque_n_m", rotdyn_set_numbers(closing, "torque_n_m", 2, torque_n_m));
  check("outside", rotdyn_set_text(closing, "outside", "hold"));
  object(coupling, "capacity_n_m", closing);
  number(coupling, "static_ratio", 1.2);
  return coupling;
}

static rotdyn_object *machine(double capacity_n_m) {
  const double omega0[] = {150.0, 0.0};
  rotdyn_object *scene = rotdyn_object_new("scene_drive");
  rotdyn_object *bodies = rotdyn_object_new("list"), *torques = rotdyn_object_new("list");
  rotdyn_object *resistances = rotdyn_object_new("list");
  rotdyn_object *disk = rotdyn_object_new("body_disk"), *loss = rotdyn_object_new("resistance");
  number(disk, "mass_kg", 8.0);
  number(disk, "radius_m", 0.3);
  object(bodies, NULL, disk);
  number(bodies, NULL, 2.0);
  object(torques, NULL, drive_torque());
  number(torques, NULL, -5.0);
  number(loss, "viscous_n_m_s", 0.02);
  number(loss, "coulomb_n_m", 1.0);
  check(NULL, rotdyn_unset(resistances, NULL)); /* nothing on the first rotor */
  object(resistances, NULL, loss);
  object(scene, "bodies", bodies);
  object(scene, "couplings", clutch(capacity_n_m));
  object(scene, "torque", torques);
  object(scene, "resistance", resistances);
  check("omega0_rad_per_s", rotdyn_set_numbers(scene, "omega0_rad_per_s", 2, omega0));
  return scene;
}

/* R's NA. */
static void print_value(double x) {
  if (isnan(x)) {
    printf(",NA");
  } else {
    printf(",%.17g", x);
  }
}

int main(int argc, char *argv[]) {
  static const char *const names[] = {"omega_rad_per_s", "coupling_torque_n_m", "heat_j"};
  double time_s[TIMES], column[3][ROWS], *const columns[] = {column[0], column[1], column[2]};
  rotdyn_report report = ROTDYN_INIT(rotdyn_report);
  rotdyn_object *scene = machine(argc > 1 ? atof(argv[1]) : 60.0);
  int i, k, status;
  for (i = 0; i < TIMES; i++) time_s[i] = i / 50.0;
  status = rotdyn_scene_run(scene, TIMES, time_s, NULL, ROWS, 3, names, columns, &report);
  rotdyn_object_free(scene);
  if (status != ROTDYN_OK || failed) {
    fprintf(stderr, "%s: %s %s\n", rotdyn_status_text(status), report.input ? report.input : "",
            report.reason);
    return 1;
  }
  fprintf(stderr, "model %s, error %s %.2g\n", report.model,
          report.error_is_bound ? "at most" : "about", report.error);
  printf("time_s,rotor,omega_rad_per_s,coupling_torque_n_m,heat_j\n");
  for (i = 0; i < ROWS; i++) {
    printf("%.17g,%d", time_s[i / ROTORS], i % ROTORS + 1);
    for (k = 0; k < 3; k++) print_value(column[k][i]);
    printf("\n");
  }
  return 0;
}
