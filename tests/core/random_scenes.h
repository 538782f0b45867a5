/* Random scenes of every constraint by the C interface, from a seed. Their numbers come from
 * integers alone, so that all processors describe the same scenes.
 *
 *   rotdyn_object *scene = random_scene(i);        scene i of any number of them
 *   scene_text, scene_text_size                                its inputs as lines of text
 */
#ifndef RANDOM_SCENES_H
#define RANDOM_SCENES_H

#include <math.h>
#include <stdint.h>
#include <string.h>

#include "api/interface.h"
#include "ground/text.h"

enum { MAX_TEXT = 1 << 16 };

static uint64_t random_state;
static char scene_text[MAX_TEXT];
static size_t scene_text_size;

static void say(const char *words) {
  const size_t n = strlen(words);
  if (scene_text_size + n + 1 >= MAX_TEXT) return;
  memcpy(scene_text + scene_text_size, words, n);
  scene_text_size += n;
  scene_text[scene_text_size++] = '\n';
}

static void say_number(double x) {
  char number[ROT_TEXT_SIZE];
  (void)rot_text_number(x, number);
  say(number);
}

/* ---- random numbers -------------------------------------------------------------------------- */

static uint64_t next(void) { /* splitmix64 */
  uint64_t z = random_state += UINT64_C(0x9e3779b97f4a7c15);
  z = (z ^ (z >> 30)) * UINT64_C(0xbf58476d1ce4e5b9);
  z = (z ^ (z >> 27)) * UINT64_C(0x94d049bb133111eb);
  return z ^ (z >> 31);
}

static int one_in(uint64_t n) { return next() % n == 0; }

/* In [low, high), by 40 random bits: exact, since the limits used here are multiples of 1/128 below
 * 64, so that extended precision changes no scene. */
static double between(double low, double high) {
  return low + (high - low) * ((double)(next() >> 24) / 1099511627776.0);
}

static double either_sign(double low, double high) {
  const double x = between(low, high);
  return one_in(2) ? -x : x;
}

/* ---- making objects -------------------------------------------------------------------------- */

static void number(rotdyn_object *to, const char *input, double x) {
  say(input ? input : "-");
  say_number(x);
  (void)rotdyn_set_number(to, input, x);
}

static void numbers(rotdyn_object *to, const char *input, size_t n, const double *x) {
  say(input);
  for (size_t i = 0; i < n; i++) say_number(x[i]);
  (void)rotdyn_set_numbers(to, input, n, x);
}

static void vector(rotdyn_object *to, const char *input, double low, double high) {
  double x[3];
  for (int i = 0; i < 3; i++) x[i] = between(low, high);
  numbers(to, input, 3, x);
}

static void give(rotdyn_object *to, const char *input, rotdyn_object *part) {
  say(input ? input : "-");
  (void)rotdyn_set_object(to, input, part);
  rotdyn_object_free(part);
}

static rotdyn_object *made(const char *constructor) {
  say(constructor);
  return rotdyn_object_new(constructor);
}

static rotdyn_object *round_body(void) {
  static const char *const shapes[] = {"body_disk", "body_hoop", "body_sphere"};
  rotdyn_object *body = made(shapes[next() % 3]);
  number(body, "mass_kg", between(0.5, 4.0));
  number(body, "radius_m", between(0.125, 0.5));
  return body;
}

static rotdyn_object *box(void) {
  rotdyn_object *body = made("body_box");
  number(body, "mass_kg", between(0.5, 4.0));
  number(body, "length_m", between(0.25, 0.5));
  number(body, "width_m", between(0.5, 0.75));
  number(body, "height_m", between(0.75, 1.0));
  return body;
}

static rotdyn_object *compound(void) {
  rotdyn_object *joined = made("join_bodies"), *list = made("list"), *placed;
  give(list, NULL, box());
  for (int i = 0; i < 2; i++) {
    placed = made("place_body");
    give(placed, "body", round_body());
    vector(placed, "at_m", -0.5, 0.5);
    give(list, NULL, placed);
  }
  give(joined, "bodies", list);
  return joined;
}

static rotdyn_object *losses(void) {
  rotdyn_object *loss = made("resistance");
  number(loss, "viscous_n_m_s", between(0.0, 0.0625));
  if (one_in(3)) number(loss, "quadratic_n_m_s2", between(0.0, 0.03125));
  if (one_in(2)) number(loss, "coulomb_n_m", between(0.0, 0.125));
  return loss;
}

static rotdyn_object *torque(void) {
  double time_s[4] = {0.0, 1.0, 2.5, 4.0}, torque_n_m[4];
  rotdyn_object *law;
  switch (next() % 7) {
  case 0:
    law = made("torque_sinusoid");
    number(law, "amplitude_n_m", between(0.0, 1.0));
    number(law, "angular_frequency_rad_per_s", between(0.5, 8.0));
    return law;
  case 1:
    law = made("torque_motor");
    number(law, "stall_torque_n_m", between(0.25, 1.0));
    number(law, "no_load_omega_rad_per_s", between(4.0, 16.0));
    return law;
  case 2:
    law = made("torque_spring");
    number(law, "stiffness_n_m_per_rad", between(0.5, 4.0));
    return law;
  case 3:
    law = made("torque_exponential");
    number(law, "torque_n_m", between(0.25, 1.0));
    number(law, "decay_per_s", between(0.25, 2.0));
    return law;
  case 4:
    law = made("torque_gravity");
    number(law, "mass_kg", between(0.25, 1.0));
    number(law, "distance_m", between(0.125, 0.5));
    return law;
  case 5:
    law = made("list");
    for (int i = 0; i < 2; i++) give(law, NULL, torque());
    return law;
  default:
    law = made("torque_knots");
    for (int i = 0; i < 4; i++) torque_n_m[i] = between(-1.0, 1.0);
    numbers(law, "time_s", 4, time_s);
    numbers(law, "torque_n_m", 4, torque_n_m);
    return law;
  }
}

/* ---- scenes ---------------------------------------------------------------------------------- */

static void rotors_of(rotdyn_object *scene, size_t n) {
  double inertia[3];
  for (size_t i = 0; i < n; i++) inertia[i] = between(0.0625, 1.0);
  numbers(scene, "bodies", n, inertia);
}

static void speeds_of(rotdyn_object *scene, size_t n) {
  double speed[3];
  for (size_t i = 0; i < n; i++) speed[i] = between(-8.0, 8.0);
  numbers(scene, "omega0_rad_per_s", n, speed);
}

static void space_of(rotdyn_object *scene) {
  double attitude[4] = {1.0, 0.0, 0.0, 0.0};
  vector(scene, "omega0_rad_per_s", -4.0, 4.0);
  if (one_in(2)) {
    for (int i = 0; i < 4; i++) attitude[i] = between(0.25, 1.0);
    numbers(scene, "attitude0", 4, attitude);
  }
  if (one_in(3)) {
    rotdyn_object *loss = made("resistance");
    number(loss, "damping_per_s", between(0.0, 0.25));
    give(scene, "resistance", loss);
  }
}

static rotdyn_object *axle(rotdyn_object *scene) {
  give(scene, "body", one_in(4) ? compound() : round_body());
  give(scene, "torque", torque());
  if (!one_in(3)) give(scene, "resistance", losses());
  number(scene, "omega0_rad_per_s", either_sign(0.0, 8.0));
  return scene;
}

static rotdyn_object *pendulum(rotdyn_object *scene) {
  give(scene, "body", box());
  number(scene, "distance_m", between(0.25, 1.0));
  number(scene, "theta0_rad", either_sign(0.0, 3.0));
  if (one_in(2)) give(scene, "resistance", losses());
  return scene;
}

static rotdyn_object *hanging(rotdyn_object *scene) {
  give(scene, "body", round_body());
  number(scene, "mass_kg", between(0.5, 2.0));
  number(scene, "counter_mass_kg", between(0.0, 0.5));
  number(scene, "radius_m", between(0.125, 0.5));
  if (one_in(2)) give(scene, "resistance", losses());
  return scene;
}

static rotdyn_object *gears(rotdyn_object *scene) {
  double inertia[2], torque_n_m[2], ratio;
  for (int i = 0; i < 2; i++) inertia[i] = between(0.0625, 1.0);
  torque_n_m[0] = between(0.0, 2.0), torque_n_m[1] = between(-0.125, 0.125);
  ratio = either_sign(0.5, 4.0);
  numbers(scene, "bodies", 2, inertia);
  numbers(scene, "ratios", 1, &ratio);
  numbers(scene, "torque", 2, torque_n_m);
  if (one_in(2)) number(scene, "efficiency", between(0.75, 1.0));
  return scene;
}

static rotdyn_object *rotors(rotdyn_object *scene) {
  const size_t n = 2 + next() % 2;
  rotors_of(scene, n);
  speeds_of(scene, n);
  number(scene, "stiffness_n_m_per_rad", between(8.0, 64.0));
  if (one_in(2)) number(scene, "damping_n_m_s", between(0.0, 1.0));
  return scene;
}

static rotdyn_object *clutch(rotdyn_object *scene) {
  double speed[2];
  speed[0] = between(0.0, 16.0), speed[1] = between(-4.0, 4.0);
  give(scene, "body_1", round_body());
  number(scene, "body_2", between(0.0625, 1.0));
  number(scene, "capacity_n_m", between(0.25, 1.0));
  numbers(scene, "omega0_rad_per_s", 2, speed);
  return scene;
}

static rotdyn_object *drive(rotdyn_object *scene) {
  rotdyn_object *coupling, *torques;
  const uint64_t kind = next() % 3;
  rotors_of(scene, 2);
  if (kind < 2) speeds_of(scene, 2); /* gears start at rest: their speeds must agree */
  switch (kind) {
  case 0:
    coupling = made("coupling_shaft");
    number(coupling, "stiffness_n_m_per_rad", between(8.0, 64.0));
    number(coupling, "damping_n_m_s", between(0.0, 0.5));
    break;
  case 1:
    coupling = made("coupling_clutch");
    number(coupling, "capacity_n_m", between(0.25, 2.0));
    number(coupling, "static_ratio", between(1.0, 1.5));
    break;
  default: coupling = made("coupling_gear"); number(coupling, "ratio", either_sign(0.5, 4.0));
  }
  give(scene, "couplings", coupling);
  torques = made("list");
  give(torques, NULL, torque());
  number(torques, NULL, between(-0.25, 0.25));
  give(scene, "torque", torques);
  return scene;
}

static rotdyn_object *incline(rotdyn_object *scene) {
  give(scene, "body", round_body());
  number(scene, "incline_angle_deg", between(-30.0, 60.0));
  number(scene, "static_friction", between(0.0, 1.0));
  number(scene, "v0_m_per_s", between(-4.0, 4.0));
  if (one_in(2)) number(scene, "omega0_rad_per_s", between(-8.0, 8.0));
  if (one_in(3)) number(scene, "rolling_arm_m", between(0.0, 0.0078125));
  return scene;
}

static rotdyn_object *free_body(rotdyn_object *scene) {
  if (one_in(2))
    give(scene, "body", compound());
  else
    vector(scene, "body", 1.0, 2.0);
  space_of(scene);
  return scene;
}

static rotdyn_object *pivot(rotdyn_object *scene) {
  double centre[3] = {0.0, 0.0, 0.0}, moments[3];
  centre[2] = between(0.0625, 0.25);
  moments[0] = between(0.25, 0.5);
  moments[1] = one_in(2) ? moments[0] : between(0.25, 0.5);
  moments[2] = between(0.125, 0.5);
  numbers(scene, "body", 3, moments);
  number(scene, "mass_kg", between(0.5, 2.0));
  numbers(scene, "centre_m", 3, centre);
  space_of(scene);
  return scene;
}

static rotdyn_object *hoop(rotdyn_object *scene) {
  number(scene, "mass_kg", between(0.5, 2.0));
  number(scene, "radius_m", between(0.25, 1.0));
  number(scene, "hoop_omega_rad_per_s", between(0.0, 8.0));
  number(scene, "theta0_rad", between(0.0, 3.0));
  if (one_in(2)) number(scene, "static_friction", between(0.0, 0.5));
  return scene;
}

static rotdyn_object *chain(rotdyn_object *scene) {
  const size_t n = 2 + next() % 2;
  double length[3], mass[3], angle[3];
  for (size_t i = 0; i < n; i++) {
    length[i] = between(0.25, 1.0);
    mass[i] = between(0.25, 1.0);
    angle[i] = between(-0.5, 0.5);
  }
  numbers(scene, "length_m", n, length);
  numbers(scene, "mass_kg", n, mass);
  numbers(scene, "theta0_rad", n, angle);
  return scene;
}

static int duffing(const double *argument, double *value, void *context) {
  const double *x = context;
  const double *y = argument + 1;
  value[0] = y[1];
  value[1] = x[0] * y[0] - y[0] * y[0] * y[0] - x[1] * y[1];
  return 0;
}

static double duffing_numbers[2];

static rotdyn_object *equations(rotdyn_object *scene) {
  double start[2];
  start[0] = between(-1.0, 1.0), start[1] = between(-1.0, 1.0);
  for (int i = 0; i < 2; i++) say_number(duffing_numbers[i] = between(0.125, 1.0));
  numbers(scene, "start", 2, start);
  say("f");
  (void)rotdyn_set_law(scene, "f", duffing, duffing_numbers);
  return scene;
}

static const struct {
  const char *constructor;
  rotdyn_object *(*fill)(rotdyn_object *scene);
} makers[] = {
    {"scene_axle", axle},           {"scene_pendulum", pendulum}, {"scene_hanging_mass", hanging},
    {"scene_gears", gears},         {"scene_rotors", rotors},     {"scene_clutch", clutch},
    {"scene_drive", drive},         {"scene_incline", incline},   {"scene_free", free_body},
    {"scene_pivot", pivot},         {"scene_hoop", hoop},         {"scene_chain", chain},
    {"scene_equations", equations},
};

enum { N_MAKERS = sizeof makers / sizeof *makers };

static inline const char *random_constructor(size_t i) { return makers[i % N_MAKERS].constructor; }

static inline rotdyn_object *random_scene(size_t i) {
  random_state = (uint64_t)i * UINT64_C(1000003) + 20260101;
  scene_text_size = 0;
  return makers[i % N_MAKERS].fill(made(random_constructor(i)));
}

#endif
