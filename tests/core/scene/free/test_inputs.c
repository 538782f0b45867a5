/* Bodies in space made by the names of their inputs: motors by numbers, tables and laws, principal
 * moments about other axes, and what is refused. */
#include "scene/free/inputs.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "api/audit.h"
#include "api/object.h"
#include "api/scene.h"
#include "rot_test.h"

/* A reaction wheel of J = 0.01 in a body of 2 kg m^2 about z, both at rest: the motor's torque u
 * turns the body by -u t/(2 - J). */
#define TORQUE 0.02
#define WHEEL  0.01

typedef enum motor { BY_NUMBER, BY_TABLE, BY_LAW, DRIVEN } motor;

static int push(const double *argument, double *value, void *context) {
  int *calls = context;
  ++*calls;
  /* time, omega, attitude: the body turns about z alone */
  const int about_z = argument[1] == 0.0 && argument[2] == 0.0 && argument[5] == 0.0;
  /* From body to space: it has turned as it turns now. */
  *value = about_z && argument[3] * argument[7] >= 0.0 ? TORQUE : NAN;
  return 0;
}

static rotdyn_object *table(void) {
  const double time_s[] = {0.0, 5.0}, torque[] = {TORQUE, TORQUE};
  rotdyn_object *of = rotdyn_object_new("torque");
  ROT_CHECK(rotdyn_set_numbers(of, "time_s", 2, time_s) == ROTDYN_OK);
  ROT_CHECK(rotdyn_set_numbers(of, "torque_n_m", 2, torque) == ROTDYN_OK);
  return of;
}

static void give(rotdyn_object *to, const char *input, rotdyn_object *part, int status) {
  ROT_CHECK_EQ_INT(rotdyn_set_object(to, input, part), status);
  rotdyn_object_free(part);
}

static rotdyn_object *wheel(motor by, double length, int *calls) {
  const double axis[] = {0.0, 0.0, length};
  rotdyn_object *of = rotdyn_object_new("rotor");
  ROT_CHECK(rotdyn_set_numbers(of, "axis", 3, axis) == ROTDYN_OK);
  ROT_CHECK(rotdyn_set_number(of, "moment_of_inertia_kg_m2", WHEEL) == ROTDYN_OK);
  ROT_CHECK(rotdyn_set_number(of, "omega_rad_per_s", 0.0) == ROTDYN_OK);
  if (by == BY_NUMBER) ROT_CHECK(rotdyn_set_number(of, "torque", TORQUE) == ROTDYN_OK);
  if (by == BY_TABLE) give(of, "torque", table(), ROTDYN_OK);
  if (by == BY_LAW) ROT_CHECK(rotdyn_set_law(of, "torque", push, calls) == ROTDYN_OK);
  return of;
}

static rotdyn_object *body(void) {
  const double moments[] = {4.0, 5.0, 2.0}, omega0[] = {0.0, 0.0, 0.0};
  rotdyn_object *scene = rotdyn_object_new("scene_free");
  ROT_CHECK(rotdyn_set_numbers(scene, "body", 3, moments) == ROTDYN_OK);
  ROT_CHECK(rotdyn_set_numbers(scene, "omega0_rad_per_s", 3, omega0) == ROTDYN_OK);
  return scene;
}

static double at(const rotdyn_object *scene, const char *name, double time_s) {
  double value = NAN, *column = &value;
  ROT_CHECK_EQ_INT(rotdyn_scene_run(scene, 1, &time_s, NULL, 1, 1, &name, &column, NULL),
                   ROTDYN_OK);
  return value;
}

static void check_motors(void) {
  for (motor by = BY_NUMBER; by <= BY_LAW; by++) {
    int calls = 0;
    rotdyn_object *scene = body();
    rotdyn_balance b = ROTDYN_INIT(rotdyn_balance);
    const double time_s[] = {1.0, 4.0}, rate = TORQUE / (2.0 - WHEEL);
    give(scene, "rotors", wheel(by, 3.0, &calls), ROTDYN_OK); /* one is a list of one */
    ROT_CHECK_REL(at(scene, "omega_z_rad_per_s", 4.0), -4.0 * rate, 1e-11);
    ROT_CHECK_REL(at(scene, "rotor_1_omega_rad_per_s", 4.0), 4.0 * (TORQUE / WHEEL + rate), 1e-11);
    ROT_CHECK(at(scene, "rotor_2_omega_rad_per_s", 4.0) == 0.0); /* there is none */
    ROT_CHECK((calls > 0) == (by == BY_LAW));
    ROT_CHECK_EQ_INT(rotdyn_scene_balance(scene, 2, time_s, NULL, 0, &b, NULL), ROTDYN_OK);
    /* From 1 s to 4 s the wheel turns by (u/J + u/(2 - J)) (16 - 1)/2. */
    ROT_CHECK_REL(b.change, TORQUE * (TORQUE / WHEEL + rate) * 7.5, 1e-10);
    ROT_CHECK(b.balanced == 1 && b.conserved == 0 && strstr(b.why, "motors"));
    ROT_CHECK(b.n_terms == 4 && b.explained < 1e-8);
    ROT_CHECK_EQ_INT(rotdyn_scene_balance(scene, 2, time_s, NULL, 3, &b, NULL), ROTDYN_OK);
    ROT_CHECK(b.conserved == 1 && b.balanced == 1 && !strcmp(b.about, "the centre of mass"));
    ROT_CHECK_EQ_INT(rotdyn_scene_balance(scene, 2, time_s, NULL, 4, &b, NULL), ROTDYN_OK);
    ROT_CHECK(b.conserved == -1 && !strcmp(b.quantity, "quaternion_norm"));
    rotdyn_object_free(scene);
  }
}

/* A unit quaternion keeps its bits, another is scaled. */
static void check_attitude(void) {
  double q[4];
  const double unit[] = {1.0 - 4.0 * DBL_EPSILON, 0.0, 0.0, 0.0};
  const double off[] = {1.0 - 6.0 * DBL_EPSILON, 0.0, 0.0, 0.0};
  rot_free_read_attitude(unit, q);
  ROT_CHECK(q[0] == unit[0] && q[1] == 0.0);
  rot_free_read_attitude(off, q);
  ROT_CHECK(q[0] == 1.0);
}

/* A rod in any attitude: its moments are those of a rod, the least of them the sum's remainder. */
static void check_rods(void) {
  for (int i = 0; i < 200; i++) {
    const double a = 0.031 * i, b = 0.4 + 0.017 * i;
    const double n[] = {cos(a) * sin(b), sin(a) * sin(b), cos(b)};
    /* second moments n n', inertia 1 - n n': xx yy zz xy xz yz */
    const double second[] = {n[0] * n[0], n[1] * n[1], n[2] * n[2],
                             n[0] * n[1], n[0] * n[2], n[1] * n[2]};
    double inertia[6];
    for (int k = 0; k < 6; k++) {
      inertia[k] = k < 3 ? second[(k + 1) % 3] + second[(k + 2) % 3] : -second[k];
    }
    rot_free_params p;
    memset(&p, 0, sizeof p);
    ROT_CHECK(rot_free_build_moments(inertia, second, &p) == ROT_OK);
    const double *m = p.moment_kg_m2;
    ROT_CHECK(m[0] >= 0.0 && m[0] <= 4e-16 && fabs(m[1] - 1.0) <= 1e-15);
    ROT_CHECK(m[2] <= m[0] + m[1] && m[1] <= m[2] && m[2] - m[1] <= m[0]);
  }
}

/* Diagonal in axes turned by 90 degrees about x: y and z change places. */
static void check_moments(void) {
  const double moments[] = {1.0, 2.0, 3.0}, half = sqrt(0.5);
  const double axes[] = {half, half, 0.0, 0.0}, omega0[] = {0.0, 1.0, 0.0};
  rotdyn_object *scene = body(), *of = rotdyn_object_new("principal_moments");
  ROT_CHECK(rotdyn_set_numbers(of, "moment_of_inertia_kg_m2", 3, moments) == ROTDYN_OK);
  ROT_CHECK(rotdyn_set_numbers(of, "axes", 4, axes) == ROTDYN_OK);
  give(scene, "body", of, ROTDYN_OK);
  ROT_CHECK(rotdyn_set_numbers(scene, "omega0_rad_per_s", 3, omega0) == ROTDYN_OK);
  ROT_CHECK_REL(at(scene, "angular_momentum_y_kg_m2_per_s", 2.0), 3.0, 1e-14);
  ROT_CHECK_REL(at(scene, "rotational_kinetic_energy_j", 2.0), 1.5, 1e-14);
  rotdyn_object_free(scene);
}

/* A torque along x of 0.3 t N m up to 2 s, of 1 kg m^2: 0.15 t^2, then it stays. */
static void check_table(void) {
  const double time_s[] = {0.0, 2.0}, x[] = {0.0, 0.6}, zero[] = {0.0, 0.0}, back[] = {2.0, 0.0};
  const double ball[] = {1.0, 1.0, 1.0};
  rotdyn_object *scene = body(), *of = rotdyn_object_new("torque");
  rotdyn_report report = ROTDYN_INIT(rotdyn_report);
  ROT_CHECK(rotdyn_set_numbers(scene, "body", 3, ball) == ROTDYN_OK);
  ROT_CHECK(rotdyn_set_numbers(of, "time_s", 2, time_s) == ROTDYN_OK);
  ROT_CHECK(rotdyn_set_numbers(of, "x_n_m", 2, x) == ROTDYN_OK);
  ROT_CHECK(rotdyn_set_numbers(of, "y_n_m", 2, zero) == ROTDYN_OK);
  ROT_CHECK(rotdyn_set_object(scene, "torque", of) == ROTDYN_OK);
  ROT_CHECK_EQ_INT(rotdyn_object_check(scene, &report), ROTDYN_EARGUMENT); /* no z */
  ROT_CHECK(strstr(report.reason, "z_n_m") && strstr(report.reason, "for each time"));
  ROT_CHECK(rotdyn_set_numbers(of, "z_n_m", 2, zero) == ROTDYN_OK);
  ROT_CHECK(rotdyn_set_object(scene, "torque", of) == ROTDYN_OK);
  ROT_CHECK_REL(at(scene, "omega_x_rad_per_s", 1.0), 0.15, 1e-12);
  ROT_CHECK_REL(at(scene, "omega_x_rad_per_s", 9.0), 0.6, 1e-12);
  ROT_CHECK(rotdyn_set_numbers(of, "time_s", 2, back) == ROTDYN_OK);
  ROT_CHECK(rotdyn_set_object(scene, "torque", of) == ROTDYN_OK);
  ROT_CHECK_EQ_INT(rotdyn_object_check(scene, &report), ROTDYN_EARGUMENT);
  ROT_CHECK(strstr(report.reason, "go back"));
  ROT_CHECK(rotdyn_set_numbers(of, "time_s", 2, zero) == ROTDYN_OK);
  ROT_CHECK(rotdyn_set_object(scene, "torque", of) == ROTDYN_OK);
  ROT_CHECK_EQ_INT(rotdyn_object_check(scene, &report), ROTDYN_EARGUMENT);
  ROT_CHECK(strstr(report.reason, "span"));
  give(scene, "torque", table(), ROTDYN_OK); /* of a motor */
  ROT_CHECK_EQ_INT(rotdyn_object_check(scene, &report), ROTDYN_EARGUMENT);
  ROT_CHECK(!strcmp(report.input, "torque") && strstr(report.reason, "x_n_m"));
  rotdyn_object_free(of);
  rotdyn_object_free(scene);
}

static void check_refusals(void) {
  const double rod[] = {1.0, 1.0, 0.0};
  rotdyn_object *scene = body(), *list = rotdyn_object_new("list");
  rotdyn_report report = ROTDYN_INIT(rotdyn_report);
  for (int k = 0; k < ROT_FREE_MAX_ROTORS; k++) give(list, NULL, wheel(DRIVEN, 1.0, NULL), 0);
  ROT_CHECK(rotdyn_set_object(scene, "rotors", list) == ROTDYN_OK);
  ROT_CHECK_EQ_INT(rotdyn_object_check(scene, &report), ROTDYN_OK);
  give(list, NULL, wheel(DRIVEN, 1.0, NULL), 0);
  ROT_CHECK(rotdyn_set_object(scene, "rotors", list) == ROTDYN_OK);
  ROT_CHECK_EQ_INT(rotdyn_object_check(scene, &report), ROTDYN_EARGUMENT);
  ROT_CHECK(!strcmp(report.input, "rotors") && strstr(report.reason, "at most 16"));
  give(scene, "rotors", wheel(DRIVEN, 0.0, NULL), ROTDYN_OK);
  ROT_CHECK_EQ_INT(rotdyn_object_check(scene, &report), ROTDYN_EARGUMENT);
  ROT_CHECK(strstr(report.reason, "axis") && strstr(report.reason, "must not be 0"));
  give(scene, "rotors", wheel(DRIVEN, 1.0, NULL), ROTDYN_OK);
  ROT_CHECK(rotdyn_set_numbers(scene, "body", 3, rod) == ROTDYN_OK);
  ROT_CHECK_EQ_INT(rotdyn_object_check(scene, &report), ROTDYN_EARGUMENT);
  ROT_CHECK(!strcmp(report.input, "rotors") && strstr(report.reason, "about each axis"));
  give(scene, "rotors", table(), ROTDYN_EARGUMENT); /* of another kind */
  ROT_CHECK(rotdyn_set_object(scene, "body", NULL) == ROTDYN_EARGUMENT);
  rotdyn_object *nested = rotdyn_object_new("list");
  give(nested, NULL, rotdyn_object_new("list"), ROTDYN_OK);
  give(scene, "rotors", nested, ROTDYN_OK);
  ROT_CHECK_EQ_INT(rotdyn_object_check(scene, &report), ROTDYN_EARGUMENT);
  ROT_CHECK(!strcmp(report.input, "rotors") && strstr(report.reason, "must be rotors"));
  rotdyn_object_free(list);
  rotdyn_object_free(scene);
}

/* Breaks are those given and the times of all tables, each once. */
static void check_breaks(void) {
  const double breaks[] = {1.0, 5.0}, want[] = {0.0, 1.0, 5.0};
  rotdyn_object *scene = body();
  rot_store store = {0};
  rot_given *given;
  rot_refusal no;
  rot_free_built built;
  give(scene, "rotors", wheel(BY_TABLE, 1.0, NULL), ROTDYN_OK);
  ROT_CHECK(rotdyn_set_numbers(scene, "breaks_s", 2, breaks) == ROTDYN_OK);
  ROT_CHECK(rot_object_given(scene, &store, &given, &no) == ROT_OK);
  ROT_CHECK(rot_free_build(given, &store, &built, &no) == ROT_OK);
  ROT_CHECK_EQ_INT(built.params.n_breaks, 3);
  ROT_CHECK(!memcmp(built.params.breaks_s, want, sizeof want));
  rot_store_free(&store);
  rotdyn_object_free(scene);
}

int main(void) {
  check_motors();
  check_attitude();
  check_moments();
  check_rods();
  check_table();
  check_refusals();
  check_breaks();
  return rot_test_report("free inputs");
}
