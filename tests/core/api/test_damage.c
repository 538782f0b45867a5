/* Random and damaged calls of every function of the C interface, by two threads at a time, which
 * share a scene: each ends in an object, a result or a status.
 *
 * ROTDYN_CALLS: how many calls; ROTDYN_SEED: of the random numbers. tools/check-damage.sh runs a
 * million under sanitizers. */
#define _POSIX_C_SOURCE 200809L
#include <math.h>
#include <pthread.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "api/interface.h"
#include "rot_test.h"

enum { THREADS = 2, MAX_ROWS = 6, MAX_KINDS = 128 };

/* One thread: its random numbers, what it did, what went wrong first. */
typedef struct actor {
  uint64_t random;
  long calls, max, failed;
  const char *what;
  const rotdyn_object *shared;
  size_t right[MAX_KINDS]; /* objects that were right, by constructor */
  size_t ran, refused, audited, rows, swept;
} actor;

#define EXPECT(a, condition)                                                                       \
  do {                                                                                             \
    if (!(condition) && (a)->failed++ == 0) (a)->what = #condition;                                \
  } while (0)

/* A status of the header, and no fault of the library. */
#define EXPECT_STATUS(a, status) EXPECT(a, (status) >= ROTDYN_OK && (status) < ROTDYN_EINTERNAL)

static size_t next(actor *a) { /* xorshift64 */
  a->random ^= a->random << 13;
  a->random ^= a->random >> 7;
  a->random ^= a->random << 17;
  return (size_t)(a->random >> 8);
}

static int one_in(actor *a, size_t n) { return next(a) % n == 0; }

static double odd_number(actor *a) {
  static const double odd[] = {0.0,   -0.0,   -1.0,   1.0,    NAN, INFINITY, -INFINITY,
                               1e308, -1e308, 1e-320, 1e-300, 0.1, 30.0,     1e5};
  return odd[next(a) % (sizeof odd / sizeof *odd)];
}

static double some_number(actor *a) {
  return one_in(a, 60) ? odd_number(a) : 0.25 * (double)(1 + next(a) % 12);
}

/* ---- objects --------------------------------------------------------------------------------- */

/* A law of three numbers or one, which now and then fails or gives no number. Its context is the
 * actor's, so that no thread sees another's. */
static int some_law(const double *argument, double *value, void *context) {
  actor *a = context;
  *value = one_in(a, 4096) ? odd_number(a) : 1.0 - argument[0];
  return one_in(a, 4096);
}

static size_t count_objects(void) {
  size_t n = 0;
  while (rotdyn_object_at(n)) n++;
  return n;
}

static const char *some_name(actor *a) {
  static const char *const wrong[] = {
      NULL,   "",           "none",    "scene_", "list",
      "body", "theta0_rad", "mass_kg", "torque", "a name of nothing at all"};
  return wrong[next(a) % (sizeof wrong / sizeof *wrong)];
}

static rotdyn_object *some_object(actor *a, const char *constructor, int depth);

/* An object for an input of these kinds, into it; 0: there is none. */
static int set_part(actor *a, rotdyn_object *object, const char *name, const char *kinds, int any,
                    int depth) {
  static const char *const objects[] = {"body",     "torque", "resistance", "inertia",
                                        "coupling", "brake",  "table",      "rotor",
                                        "moments",  "points", "sizes"};
  const size_t known = count_objects(), from = next(a) % known;
  for (size_t k = 0; k < sizeof objects / sizeof *objects; k++) {
    if ((!any && !strstr(kinds, objects[k])) || one_in(a, 3)) continue;
    /* The first of the kind behind a random place of the list. */
    for (size_t i = 0; i < known; i++) {
      const char *constructor = rotdyn_object_at((from + i) % known);
      if (strcmp(rotdyn_object_kind(constructor), objects[k])) continue;
      rotdyn_object *part = some_object(a, constructor, depth - 1);
      EXPECT_STATUS(a, rotdyn_set_object(object, name, part));
      rotdyn_object_free(part);
      a->calls += 3;
      return 1;
    }
  }
  return 0;
}

/* Something that the input takes, or, now and then, anything. */
static void set_something(actor *a, rotdyn_object *object, const char *name, const char *kinds,
                          int depth) {
  double x[9];
  const int any = one_in(a, 80);
  const size_t n = one_in(a, 3) ? next(a) % 6 : 1 + next(a) % 2;
  for (int i = 0; i < 9; i++) x[i] = one_in(a, 60) ? odd_number(a) : 0.5 * i + 0.5;
  if (one_in(a, 200)) name = some_name(a);
  a->calls++;
  if (depth > 0 && set_part(a, object, name, kinds, any, depth)) return;
  if ((any || strstr(kinds, "list")) && depth > 0 && one_in(a, 2)) {
    rotdyn_object *list = rotdyn_object_new("list");
    for (size_t i = 0; i < n; i++) {
      if (one_in(a, 8)) {
        EXPECT_STATUS(a, rotdyn_unset(list, NULL));
      } else {
        set_something(a, list, NULL, kinds, depth - 1);
      }
    }
    EXPECT_STATUS(a, rotdyn_set_object(object, name, list));
    if (one_in(a, 100)) EXPECT_STATUS(a, rotdyn_set_object(list, NULL, list));
    rotdyn_object_free(list);
    a->calls += 3;
    return;
  }
  int status;
  if ((any || strstr(kinds, "law")) && one_in(a, 6)) {
    status = rotdyn_set_law(object, name, one_in(a, 50) ? NULL : some_law, a);
  } else if (any || strstr(kinds, "choice")) {
    static const char *const words[] = {"hold", "zero", "space", "z", "centre", "gravity", NULL};
    status = rotdyn_set_text(object, name, words[next(a) % 7]);
  } else if (strstr(kinds, "vector")) {
    status = rotdyn_set_numbers(object, name, 3, x);
  } else if (strstr(kinds, "attitude")) {
    status = rotdyn_set_numbers(object, name, 4, x);
  } else if (strstr(kinds, "numbers") || strstr(kinds, "times") || any) {
    const size_t count = one_in(a, 8) ? next(a) % 9 : n;
    status = rotdyn_set_numbers(object, name, count, one_in(a, 60) ? NULL : x);
  } else {
    status = rotdyn_set_number(object, name, some_number(a));
  }
  EXPECT_STATUS(a, status);
  if (one_in(a, 60)) EXPECT_STATUS(a, rotdyn_unset(object, name));
}

static rotdyn_object *some_object(actor *a, const char *constructor, int depth) {
  rotdyn_object *object = rotdyn_object_new(constructor);
  rotdyn_input input = ROTDYN_INIT(rotdyn_input);
  a->calls++;
  for (size_t i = 0; rotdyn_input_at(constructor, i, &input) == ROTDYN_OK; i++) {
    a->calls++;
    if (input.required ? one_in(a, 100) : !one_in(a, 6)) continue;
    if (!strcmp(constructor, "torque_term") && one_in(a, 2)) {
      (void)rotdyn_set_text(object, "kind", one_in(a, 2) ? "curve" : "polynomial");
    } else {
      set_something(a, object, input.name, input.kinds, depth);
    }
  }
  return object;
}

/* ---- calls about a scene --------------------------------------------------------------------- */

static int some_poll(void *context, double fraction) {
  actor *a = context;
  EXPECT(a, fraction >= 0.0 && fraction <= 1.0);
  return one_in(a, 64);
}

/* Options, with events that have room for `room`, or lie about their size. */
static rotdyn_options some_options(actor *a, rotdyn_events *events, size_t room, double time_s[],
                                   const char *name[]) {
  static const char *const models[] = {
      "axle_linear", "axle_rk8pd", "free_exact",   "drive_radau", "none",         "",
      "hoop_rk8pd",  "pivot_top",  "rotors_modal", "axle_radau",  "clutch_exact", "incline_race"};
  rotdyn_options options = ROTDYN_INIT(rotdyn_options);
  if (one_in(a, 8)) options.accuracy = odd_number(a);
  if (one_in(a, 12)) options.model = models[next(a) % (sizeof models / sizeof *models)];
  /* A default of a million steps takes half a minute where the motion is wild. */
  options.max_steps = one_in(a, 16) ? -fabs(odd_number(a)) - 1.0 : 300.0;
  if (one_in(a, 16)) options.law_call_s = odd_number(a);
  if (one_in(a, 8)) options.poll = some_poll;
  options.poll_context = a;
  options.threads = one_in(a, 4) ? next(a) % 4 : 0;
  *events = (rotdyn_events)ROTDYN_INIT(rotdyn_events);
  events->room = next(a) % (room + 1);
  events->time_s = time_s;
  events->name = one_in(a, 3) ? NULL : name;
  if (one_in(a, 4)) options.events = events;
  if (one_in(a, 100)) events->size = next(a) % sizeof *events;
  if (one_in(a, 100)) options.size = next(a) % sizeof options;
  return options;
}

/* Times in order, but for some; n of at most MOST_ROWS. */
static size_t some_times(actor *a, double time_s[]) {
  const size_t n = next(a) % (MAX_ROWS + 1);
  double at = one_in(a, 4) ? -1.0 : 0.0;
  for (size_t i = 0; i < n; i++) {
    time_s[i] = one_in(a, 40) ? odd_number(a) : at;
    at += one_in(a, 5) ? 0.0 : 0.25 * (double)(next(a) % 4);
  }
  return n;
}

static void expect_report(actor *a, int status, const rotdyn_report *report, size_t n) {
  EXPECT_STATUS(a, status);
  EXPECT(a, report->status == status);
  EXPECT(a, report->rows_done <= n);
  EXPECT(a, status != ROTDYN_OK || report->rows_done == n);
  EXPECT(a, !(report->error < 0.0));
  EXPECT(a, status == ROTDYN_OK || report->reason[0] || report->model);
  EXPECT(a, memchr(report->reason, 0, sizeof report->reason) != NULL);
  if (status != ROTDYN_OK) a->refused++;
}

static void run_some(actor *a, const rotdyn_object *scene, const char *constructor,
                     size_t rows_per_time) {
  double time_s[MAX_ROWS], event_s[4];
  const char *event[4], *names[2];
  rotdyn_events events;
  rotdyn_report report = ROTDYN_INIT(rotdyn_report);
  const rotdyn_options options = some_options(a, &events, 4, event_s, event);
  const size_t n = some_times(a, time_s), lies = one_in(a, 16) ? next(a) % 3 : 0;
  const size_t room = n * rows_per_time + lies > 2 && one_in(a, 40) ? n * rows_per_time - 1
                                                                    : n * rows_per_time + lies;
  const size_t n_columns = next(a) % 3;
  double *values[2] = {calloc(room + 1, sizeof(double)), calloc(room + 1, sizeof(double))};
  for (int k = 0; k < 2; k++) {
    names[k] = one_in(a, 12) ? some_name(a) : rotdyn_column_at(constructor, next(a) % 12);
  }
  const int status = rotdyn_scene_run(scene, n, one_in(a, 100) ? NULL : time_s,
                                      scene == a->shared ? NULL : &options, room, n_columns, names,
                                      one_in(a, 200) ? NULL : values, &report);
  expect_report(a, status, &report, n);
  a->ran += status == ROTDYN_OK;
  a->calls++;
  for (int k = 0; k < 2; k++) free(values[k]);
}

static void ask_some(actor *a, const rotdyn_object *scene) {
  double time_s[MAX_ROWS], event_s[4];
  const char *event[4];
  rotdyn_events events;
  const rotdyn_options options = some_options(a, &events, 4, event_s, event);
  const size_t n = some_times(a, time_s);
  rotdyn_candidate candidate = ROTDYN_INIT(rotdyn_candidate);
  rotdyn_balance balance = ROTDYN_INIT(rotdyn_balance);
  rotdyn_report report = ROTDYN_INIT(rotdyn_report);
  int status = rotdyn_scene_candidate(scene, n, time_s, &options, next(a) % 14,
                                      one_in(a, 100) ? NULL : &candidate);
  EXPECT_STATUS(a, status);
  EXPECT(a, status != ROTDYN_OK || (candidate.model && !(candidate.error < 0.0)));
  status = rotdyn_scene_balance(scene, n, time_s, &options, next(a) % 7,
                                one_in(a, 100) ? NULL : &balance, &report);
  EXPECT_STATUS(a, status);
  EXPECT(a, report.status == status);
  if (status == ROTDYN_OK) {
    EXPECT(a, balance.quantity && balance.unit && balance.n_terms <= 16);
    EXPECT(a, balance.balanced >= -1 && balance.balanced <= 1);
    EXPECT(a, !(balance.explained < 0.0));
    a->audited++;
  }
  a->calls += 2;
}

/* Numbers of a random step, which lies within the room: values[i * step] for n rows. */
static rotdyn_column some_column(actor *a, double room[], size_t n) {
  for (size_t i = 0; i < 2 * n; i++) room[i] = some_number(a);
  if (one_in(a, 30)) return (rotdyn_column){NULL, 1};
  return (rotdyn_column){room, next(a) % 3};
}

static void run_rows(actor *a, const rotdyn_object *scene, const char *constructor,
                     size_t rows_per_time) {
  double room[4][2 * MAX_ROWS], error[MAX_ROWS], event_s[4];
  const char *inputs[2], *names[2], *model[MAX_ROWS], *event[4];
  int status_of[MAX_ROWS];
  rotdyn_column values[2];
  rotdyn_events events;
  rotdyn_input input = ROTDYN_INIT(rotdyn_input);
  rotdyn_report report = ROTDYN_INIT(rotdyn_report);
  rotdyn_rows_in in = ROTDYN_INIT(rotdyn_rows_in);
  rotdyn_rows_out out = ROTDYN_INIT(rotdyn_rows_out);
  const rotdyn_options options = some_options(a, &events, 4, event_s, event);
  const size_t n = next(a) % (MAX_ROWS + 1);
  double *columns[2] = {calloc(n * rows_per_time + 1, sizeof(double)),
                        calloc(n * rows_per_time + 1, sizeof(double))};
  in.time_s = some_column(a, room[0], n);
  in.n_inputs = next(a) % 3;
  in.inputs = inputs;
  in.values = values;
  for (int k = 0; k < 2; k++) {
    inputs[k] = some_name(a);
    if (!one_in(a, 8) && rotdyn_input_at(constructor, next(a) % 12, &input) == ROTDYN_OK) {
      inputs[k] = input.name;
    }
    values[k] = some_column(a, room[1 + k], n);
    names[k] = one_in(a, 12) ? some_name(a) : rotdyn_column_at(constructor, next(a) % 10);
  }
  out.n_columns = next(a) % 3;
  out.names = names;
  out.columns = columns;
  out.error = one_in(a, 3) ? NULL : error;
  out.status = one_in(a, 3) ? NULL : status_of;
  out.model = one_in(a, 3) ? NULL : model;
  if (one_in(a, 100)) in.size = next(a) % sizeof in;
  if (one_in(a, 100)) out.size = next(a) % sizeof out;
  const int status = rotdyn_scene_rows(scene, n, one_in(a, 100) ? NULL : &in, &options,
                                       one_in(a, 100) ? NULL : &out, &report);
  EXPECT_STATUS(a, status);
  EXPECT(a, report.status == status);
  for (size_t i = 0; i < n && status == ROTDYN_OK && out.size == sizeof out; i++) {
    if (out.status) EXPECT_STATUS(a, status_of[i]);
    if (out.error && out.status && status_of[i] == ROTDYN_OK) EXPECT(a, !(error[i] < 0.0));
  }
  a->rows += status == ROTDYN_OK && n > 0;
  a->calls++;
  for (int k = 0; k < 2; k++) free(columns[k]);
}

static void sweep_some(actor *a, const rotdyn_object *scene) {
  double room[6][2 * MAX_ROWS], to[7][MAX_ROWS], event_s[4];
  const char *event[4];
  int status_of[MAX_ROWS];
  rotdyn_events events;
  rotdyn_report report = ROTDYN_INIT(rotdyn_report);
  rotdyn_sweep_in in = ROTDYN_INIT(rotdyn_sweep_in);
  rotdyn_sweep_out out = ROTDYN_INIT(rotdyn_sweep_out);
  const rotdyn_options options = some_options(a, &events, 4, event_s, event);
  const size_t n = next(a) % (MAX_ROWS + 1);
  rotdyn_column *const columns[] = {&in.time_s,           &in.inertia_kg_m2, &in.viscous_n_m_s,
                                    &in.omega0_rad_per_s, &in.theta0_rad,    &in.torque_scale};
  double **const results[] = {
      &out.theta_rad, &out.omega_rad_per_s, &out.omega_max, &out.omega_max_time_s,
      &out.omega_min, &out.speed_max,       &out.error};
  for (int k = 0; k < 6; k++) {
    if (k == 0 || one_in(a, 2)) *columns[k] = some_column(a, room[k], n);
  }
  for (int k = 0; k < 7; k++) {
    if (!one_in(a, 4)) *results[k] = to[k];
  }
  if (!one_in(a, 3)) out.status = status_of;
  const int status = rotdyn_axle_sweep(scene, n, one_in(a, 100) ? NULL : &in, &options,
                                       one_in(a, 100) ? NULL : &out, &report);
  EXPECT_STATUS(a, status);
  EXPECT(a, report.status == status);
  a->swept += status == ROTDYN_OK && n > 0;
  a->calls++;
}

/* ---- calls without an object ----------------------------------------------------------------- */

static void ask_tables(actor *a) {
  rotdyn_shape shape = ROTDYN_INIT(rotdyn_shape);
  rotdyn_moments moments = ROTDYN_INIT(rotdyn_moments);
  rotdyn_energies energies = ROTDYN_INIT(rotdyn_energies);
  rotdyn_top top = ROTDYN_INIT(rotdyn_top);
  rotdyn_top_rates rates = ROTDYN_INIT(rotdyn_top_rates);
  rotdyn_model model = ROTDYN_INIT(rotdyn_model);
  rotdyn_input input = ROTDYN_INIT(rotdyn_input);
  double sizes[5];
  for (int i = 0; i < 5; i++) sizes[i] = some_number(a);
  if (one_in(a, 50)) shape.size = moments.size = rates.size = next(a) % sizeof rates;
  int status = rotdyn_shape_at(next(a) % 40, one_in(a, 50) ? NULL : &shape);
  EXPECT_STATUS(a, status);
  const int known = status == ROTDYN_OK && shape.size == sizeof shape && !one_in(a, 8);
  const char *name = known ? shape.name : some_name(a);
  const size_t n = one_in(a, 4) || !known ? next(a) % 6 : shape.n_sizes;
  status = rotdyn_shape_moments(name, some_number(a), n < 6 ? n : 0, sizes,
                                one_in(a, 50) ? NULL : &moments);
  EXPECT_STATUS(a, status);
  EXPECT(a, status != ROTDYN_OK || !(moments.error < 0.0));
  EXPECT_STATUS(a, rotdyn_rolling_energies(some_number(a), some_number(a), some_number(a),
                                           some_number(a), one_in(a, 50) ? NULL : &energies));
  top.mass_kg = some_number(a);
  top.lever_arm_m = some_number(a);
  top.axial_kg_m2 = some_number(a);
  top.spin_rad_per_s = 20.0 * some_number(a);
  top.axis_angle_deg = 20.0 * some_number(a);
  top.gravity_m_per_s2 = some_number(a);
  top.transverse_kg_m2 = some_number(a);
  EXPECT_STATUS(
      a, rotdyn_precession_rates(one_in(a, 50) ? NULL : &top, one_in(a, 50) ? NULL : &rates));
  EXPECT_STATUS(a, rotdyn_model_at(next(a) % 80, one_in(a, 50) ? NULL : &model));
  EXPECT_STATUS(a, rotdyn_input_at(some_name(a), next(a) % 4, one_in(a, 50) ? NULL : &input));
  EXPECT(a, rotdyn_version() && rotdyn_status_text((int)(next(a) % 40) - 10));
  (void)rotdyn_rolling_acceleration(some_number(a), some_number(a), some_number(a));
  (void)rotdyn_rolling_final_speed(some_number(a), some_number(a), some_number(a));
  EXPECT(a, !(rotdyn_rolling_rotational_fraction(some_number(a)) > 1.0));
  EXPECT(a, !(rotdyn_rolling_translational_fraction(some_number(a)) < 0.0));
  (void)rotdyn_rolling_friction(some_number(a), some_number(a));
  (void)rotdyn_object_kind(some_name(a));
  (void)rotdyn_column_at(some_name(a), next(a) % 4);
  rotdyn_object *none = rotdyn_object_new(some_name(a));
  EXPECT_STATUS(a, rotdyn_set_number(none, some_name(a), 1.0));
  EXPECT_STATUS(a, rotdyn_object_check(none, NULL));
  rotdyn_object_free(none);
  a->calls += 18;
}

/* ---- all of them ----------------------------------------------------------------------------- */

static void call_about(actor *a, const rotdyn_object *object, const char *constructor,
                       size_t rows_per_time) {
  switch (next(a) % 4) {
  case 0: ask_some(a, object); break;
  case 1: run_rows(a, object, constructor, rows_per_time); break;
  case 2: sweep_some(a, object); break;
  default: run_some(a, object, constructor, rows_per_time);
  }
}

static void *act(void *data) {
  actor *a = data;
  const size_t objects = count_objects();
  while (a->calls < a->max) {
    const size_t scenes = 12, place = one_in(a, 2) ? next(a) % objects : next(a) % scenes;
    const char *constructor = rotdyn_object_at(place);
    rotdyn_object *object = some_object(a, constructor, 3);
    rotdyn_report report = ROTDYN_INIT(rotdyn_report);
    if (one_in(a, 200)) report.size = next(a) % 300;
    const int lies = report.size != sizeof report;
    const int status = rotdyn_object_check(object, &report);
    a->calls++;
    EXPECT_STATUS(a, status);
    EXPECT(a, lies || report.status == status);
    EXPECT(a, lies || status == ROTDYN_OK || (report.input && report.reason[0]));
    if (status == ROTDYN_OK && place < MAX_KINDS) a->right[place]++;
    /* `rows_per_time` of a refused scene is 0: its runs are refused, too. */
    call_about(a, object, constructor, lies ? 16 : report.rows_per_time);
    if (a->shared && one_in(a, 4)) call_about(a, a->shared, "scene_free", 1);
    if (one_in(a, 20)) ask_tables(a);
    rotdyn_object_free(object);
    a->calls++;
  }
  return NULL;
}

static rotdyn_object *tumbling(void) {
  const double moments[] = {1.0, 2.0, 2.5}, omega[] = {0.1, 3.0, 0.2};
  rotdyn_object *scene = rotdyn_object_new("scene_free");
  ROT_CHECK_EQ_INT(rotdyn_set_numbers(scene, "body", 3, moments), ROTDYN_OK);
  ROT_CHECK_EQ_INT(rotdyn_set_numbers(scene, "omega0_rad_per_s", 3, omega), ROTDYN_OK);
  return scene;
}

static long number_of(const char *name, long otherwise) {
  const char *text = getenv(name);
  const long x = text ? strtol(text, NULL, 10) : 0;
  return x > 0 ? x : otherwise;
}

static void check_damaged_calls(void) {
  static actor actors[THREADS];
  pthread_t thread[THREADS];
  size_t ran = 0, refused = 0, audited = 0, rows = 0, swept = 0, right = 0;
  const long calls = number_of("ROTDYN_CALLS", rot_test_trials(1000000));
  rotdyn_object *shared = tumbling();
  for (int k = 0; k < THREADS; k++) {
    actors[k].random =
        88172645463325252u + 977u * (uint64_t)number_of("ROTDYN_SEED", 1) + (uint64_t)k;
    actors[k].max = calls / THREADS;
    actors[k].shared = shared;
    ROT_CHECK_EQ_INT(pthread_create(&thread[k], NULL, act, &actors[k]), 0);
  }
  for (int k = 0; k < THREADS; k++) {
    ROT_CHECK_EQ_INT(pthread_join(thread[k], NULL), 0);
    const actor *a = &actors[k];
    if (a->failed) printf("thread %d: %ld failed, first: %s\n", k, a->failed, a->what);
    ROT_CHECK_EQ_INT(a->failed, 0);
    ran += a->ran;
    refused += a->refused;
    audited += a->audited;
    rows += a->rows;
    swept += a->swept;
  }
  for (int i = 0; i < MAX_KINDS; i++) right += actors[0].right[i] + actors[1].right[i] > 0;
  rotdyn_object_free(shared);
  if (getenv("ROTDYN_CALLS")) {
    printf("# %ld calls: %zu scenes ran, %zu were refused or failed, %zu balances, %zu tables of "
           "rows, %zu sweeps\n",
           calls, ran, refused, audited, rows, swept);
  }
  /* Each kind of result is among them, and of each kind of object. */
  ROT_CHECK(ran > 0 && refused > 0 && audited > 0 && rows > 0 && swept > 0);
  ROT_CHECK(calls < 1000000 || right >= 8 * count_objects() / 10);
}

int main(void) {
  check_damaged_calls();
  return rot_test_report("damage");
}
