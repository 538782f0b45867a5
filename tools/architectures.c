/* 1,000 random scenes as lines of text, for the comparison of processors (check-architectures.sh).
 *
 *   architectures run [SCENES]     a line for each scene
 *   architectures compare A B      two such files: what is equal, what is within the error figures
 *
 * The numbers of the scenes come from integers alone, so that all processors describe the same
 * scenes. A line:
 *
 *   I TEXT-HASH STATUS MODEL ROWS ERROR COLUMNS NUMBERS...
 *
 * TEXT-HASH is that of the inputs as JSON numbers, of the constructor, the columns, the words of
 * the choice and the names of the events. ERROR and the numbers are doubles in hexadecimal. */
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "ground/hash.h"
#include "ground/text.h"
#include "rotdyn.h"

enum { TIMES = 9, MAX_ROWS_PER_TIME = 4, MAX_COLUMNS = 24, MAX_TEXT = 1 << 16, MAX_EVENTS = 64 };

static uint64_t random_state;
static char text[MAX_TEXT];
static size_t text_size;

static void say(const char *words) {
  const size_t n = strlen(words);
  if (text_size + n + 1 >= MAX_TEXT) return;
  memcpy(text + text_size, words, n);
  text_size += n;
  text[text_size++] = '\n';
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

/* ---- one line -------------------------------------------------------------------------------- */

static void print_number(double x) {
  uint64_t bits;
  memcpy(&bits, &x, sizeof bits);
  if (x != x)
    printf(" NaN"); /* NaN has many bit patterns */
  else
    printf(" %016llx", (unsigned long long)bits);
}

static void line(size_t i) {
  static double values[MAX_COLUMNS][TIMES * MAX_ROWS_PER_TIME];
  const char *names[MAX_COLUMNS], *event[MAX_EVENTS];
  double *columns[MAX_COLUMNS], time_s[TIMES], event_s[MAX_EVENTS];
  rotdyn_report report = ROTDYN_INIT(rotdyn_report);
  rotdyn_options options = ROTDYN_INIT(rotdyn_options);
  rotdyn_events events = ROTDYN_INIT(rotdyn_events);
  rotdyn_candidate candidate = ROTDYN_INIT(rotdyn_candidate);
  const char *constructor = makers[i % (sizeof makers / sizeof *makers)].constructor;
  rotdyn_object *scene;
  char hash[ROT_HASH_SIZE];
  size_t n = 0, rows;
  int status;

  random_state = (uint64_t)i * UINT64_C(1000003) + 20260101;
  text_size = 0;
  scene = makers[i % (sizeof makers / sizeof *makers)].fill(made(constructor));
  for (int k = 0; k < TIMES; k++) time_s[k] = 0.5 * k;
  for (size_t k = 0; n < MAX_COLUMNS && (names[n] = rotdyn_column_at(constructor, k)); k++) {
    /* Rotors of a body in space and masses on threads are not there. */
    if (strstr(names[n], "rotor_") || strstr(names[n], "tension") || strstr(names[n], "height") ||
        strstr(names[n], "mass_"))
      continue;
    columns[n] = values[n];
    say(names[n++]);
  }
  options.max_steps = 1e5;
  options.accuracy = 1e-8;
  events.room = MAX_EVENTS;
  events.time_s = event_s;
  events.name = event;
  options.events = &events;
  memset(values, 0, sizeof values);
  status = rotdyn_scene_run(scene, TIMES, time_s, &options, TIMES * MAX_ROWS_PER_TIME, n, names,
                            columns, &report);
  say(rotdyn_status_text(status));
  say(report.reason);
  for (size_t k = 0; k < events.count && k < MAX_EVENTS; k++) say(event[k]);
  /* Predicted costs and estimates depend on the numbers; what applies and why does not. */
  for (size_t k = 0; rotdyn_scene_candidate(scene, TIMES, time_s, &options, k, &candidate) == 0;
       k++) {
    say(candidate.model);
    say(candidate.applies ? "applies" : candidate.reason);
  }
  rotdyn_object_free(scene);
  rot_hash((const unsigned char *)text, text_size, hash);
  rows = status == ROTDYN_OK ? TIMES * report.rows_per_time : 0;
  printf("%zu %s %d %s %zu", i, hash, status, report.model ? report.model : "-", rows);
  print_number(report.error);
  printf(" %zu", n);
  for (size_t k = 0; k < n; k++)
    for (size_t r = 0; r < rows; r++) print_number(values[k][r]);
  puts("");
}

/* ---- two files ------------------------------------------------------------------------------- */

typedef struct scene_line {
  char hash[ROT_HASH_SIZE], model[64];
  int status;
  size_t i, rows, n;
  double error;
  double value[MAX_COLUMNS * TIMES * MAX_ROWS_PER_TIME];
} scene_line;

static int read_number(FILE *file, double *x) {
  char word[32];
  unsigned long long digits;
  uint64_t bits;
  if (fscanf(file, " %31s", word) != 1) return 0;
  if (!strcmp(word, "NaN")) {
    *x = NAN;
    return 1;
  }
  if (sscanf(word, "%16llx", &digits) != 1) return 0;
  bits = digits;
  memcpy(x, &bits, sizeof bits);
  return 1;
}

static int read_line(FILE *file, scene_line *s) {
  if (fscanf(file, "%zu %32s %d %63s %zu", &s->i, s->hash, &s->status, s->model, &s->rows) != 5)
    return 0;
  if (!read_number(file, &s->error) || fscanf(file, "%zu", &s->n) != 1) return 0;
  if (s->n > MAX_COLUMNS || s->rows > TIMES * MAX_ROWS_PER_TIME) return 0;
  for (size_t k = 0; k < s->n * s->rows; k++)
    if (!read_number(file, s->value + k)) return 0;
  return 1;
}

/* Of all columns: the largest difference relative to the column's largest value. Infinite where one
 * is NaN and the other is not. */
static double difference(const scene_line *a, const scene_line *b) {
  double worst = 0.0;
  for (size_t k = 0; k < a->n; k++) {
    const double *x = a->value + k * a->rows, *y = b->value + k * a->rows;
    double size = 0.0, off = 0.0;
    for (size_t r = 0; r < a->rows; r++) {
      if (isnan(x[r]) != isnan(y[r])) return INFINITY;
      size = fmax(size, fabs(x[r])); /* NaN is ignored */
      off = fmax(off, fabs(x[r] - y[r]));
    }
    if (off > 0.0) worst = fmax(worst, off / size);
  }
  return worst;
}

/* The bound of a difference: both error figures, which are of angles, speeds and momenta, ten
 * times, since torques and energies have squares of them; and rounding in the columns. */
static double allowed(const scene_line *a, const scene_line *b) {
  return 10.0 * (a->error + b->error) + 1e-12;
}

static int compare(const char *one, const char *other) {
  static scene_line a, b;
  FILE *x = fopen(one, "r"), *y = fopen(other, "r");
  size_t n = 0, texts = 0, models = 0, same = 0, within = 0, beyond = 0, ran = 0;
  double worst = 0.0;
  if (!x || !y) {
    fprintf(stderr, "architectures: %s cannot be read\n", x ? other : one);
    return 2;
  }
  while (read_line(x, &a) && read_line(y, &b)) {
    n++;
    texts += !strcmp(a.hash, b.hash);
    models += !strcmp(a.model, b.model) && a.status == b.status;
    ran += a.status == ROTDYN_OK;
    if (strcmp(a.hash, b.hash))
      printf("  scene %zu (%s): %s and %s, another text\n", a.i,
             makers[a.i % (sizeof makers / sizeof *makers)].constructor, a.model, b.model);
    if (a.status != b.status || a.n != b.n || a.rows != b.rows) {
      beyond++;
    } else if (!memcmp(a.value, b.value, a.n * a.rows * sizeof *a.value)) {
      same++;
    } else if (difference(&a, &b) <= allowed(&a, &b)) {
      within++;
      worst = fmax(worst, difference(&a, &b) / allowed(&a, &b));
    } else {
      beyond++;
      printf("  scene %zu (%s, %s): off by %.2g, error figures %.2g and %.2g\n", a.i,
             makers[a.i % (sizeof makers / sizeof *makers)].constructor, a.model,
             difference(&a, &b), a.error, b.error);
    }
  }
  printf("%zu scenes, %zu ran: texts equal %zu, models equal %zu, all bits equal %zu, within the "
         "bounds %zu (at most %.2g of them), beyond %zu\n",
         n, ran, texts, models, same, within, worst, beyond);
  (void)fclose(x), (void)fclose(y);
  return n == 0 || texts < n || models < n || beyond > 0;
}

int main(int argc, char **argv) {
  if (argc == 4 && !strcmp(argv[1], "compare")) return compare(argv[2], argv[3]);
  if (argc < 2 || strcmp(argv[1], "run")) {
    fputs("usage: architectures run [SCENES] | compare A B\n", stderr);
    return 2;
  }
  const size_t n = argc > 2 ? (size_t)strtoul(argv[2], NULL, 10) : 1000;
  for (size_t i = 0; i < n; i++) line(i);
  return 0;
}
