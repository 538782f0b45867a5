/* The figures of random scenes of every constraint, as they were when api/figures.txt was written:
 * what is refused and why, what each model promises and costs, the motion by each model that takes
 * the scene, its error figures, events and balances, a few rows. That the figures are right is for
 * the other tests to say; this one notices that one has changed.
 *
 *   ROTDYN_FIGURES=write    writes the file anew (`make figures`): read the difference before you
 *                           commit it
 *   ROTDYN_FIGURES=other    estimates within a factor of 10: for another build of GSL
 *
 * A line of the file is a list of words and numbers. Texts stand as hashes. A column is its values
 * at all rows with weights, summed; the number behind it is how many are NaN. */
#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "ground/hash.h"
#include "random_scenes.h"
#include "rot_test.h"

enum {
  SCENES = 42 * N_MAKERS,
  FEW = 4,
  EVEN = 24, /* of these a closed form has rows by four */
  MAX_ROWS = EVEN * 4,
  MAX_COLUMNS = 40,
  MAX_EVENTS = 16,
  MAX_LINE = 1 << 12,
  MAX_TOKENS = 256
};

/* Beside the error figure of an integrator: other functions sin, exp, ... of another C library
 * differ by 1 ulp. Error figures and costs are themselves estimates of these numbers. */
static const double value_tolerance = 1e-9, figure_tolerance = 0.02;

/* ---- one line of the file -------------------------------------------------------------------- */

static FILE *file;
static int writes, other_build;
static size_t scene_number;
static char line[MAX_LINE], token[MAX_TOKENS][96];
static double tolerance[MAX_TOKENS]; /* negative: a word */
static size_t n_tokens;

static void word(const char *text) {
  if (n_tokens == MAX_TOKENS) return;
  (void)snprintf(token[n_tokens], sizeof *token, "%s", text && *text ? text : "-");
  tolerance[n_tokens++] = -1.0;
}

static void count(size_t n) {
  char text[32];
  (void)snprintf(text, sizeof text, "%zu", n);
  word(text);
}

static void sentence(const char *text) {
  char hash[ROT_HASH_SIZE];
  rot_hash((const unsigned char *)text, strlen(text), hash);
  hash[8] = 0;
  word(*text ? hash : "-");
}

/* `scale`: what an error counts against. */
static void number_of(const char *format, double x, double scale, double relative) {
  if (!isfinite(x)) {
    word(isnan(x) ? "NaN" : x > 0.0 ? "Inf" : "-Inf");
  } else if (n_tokens < MAX_TOKENS) {
    (void)snprintf(token[n_tokens], sizeof *token, format, x);
    tolerance[n_tokens++] = relative * scale;
  }
}

/* A figure of rounding depends on the last bits of the functions. Another build of GSL contracts
 * the steps of an integrator: then it takes others, and estimates differ. */
static void figure_of(double x, int estimate) {
  const int rounding = fabs(x) < 1e-9;
  if (estimate && other_build)
    number_of("%.4e", x, 9.0 * fabs(x) + 1e-11, 1.0);
  else
    number_of("%.4e", x, fabs(x) + DBL_MIN, rounding ? 0.4 : figure_tolerance);
}

static void figure(double x) { figure_of(x, 0); }

/* Ends the line: writes it, or compares it with the next one of the file. */
static int end_line(void) {
  int same = 1;
  if (writes) {
    for (size_t i = 0; i < n_tokens; i++) (void)fprintf(file, i ? " %s" : "%s", token[i]);
    (void)fputc('\n', file);
  } else {
    size_t i = 0;
    same = fgets(line, sizeof line, file) != NULL;
    for (char *at = same ? strtok(line, " \n") : NULL; at && same; at = strtok(NULL, " \n"), i++) {
      char *end = at;
      const double known = strtod(at, &end);
      if (i >= n_tokens) {
        same = 0;
      } else if (tolerance[i] < 0.0 || *end) {
        same = !strcmp(at, token[i]);
      } else {
        same = fabs(strtod(token[i], NULL) - known) <= tolerance[i];
      }
      if (!same)
        printf("  scene %zu, %s %s, place %zu: %s, in the file %s\n", scene_number, token[0],
               n_tokens > 1 ? token[1] : "", i, i < n_tokens ? token[i] : "nothing", at);
    }
    same = same && i == n_tokens;
  }
  n_tokens = 0;
  return same;
}

/* ---- inputs beside those of a maker ---------------------------------------------------------- */

static int of_kind(const rotdyn_input *input, const char *kind) {
  const size_t n = strlen(kind);
  for (const char *at = input->kinds; (at = strstr(at, kind)); at += n)
    if ((at == input->kinds || at[-1] == ' ') && (at[n] == ',' || at[n] == 0)) return 1;
  return 0;
}

static double some_number(const rotdyn_input *input) {
  const double low = input->low, high = input->high;
  if (low > -100.0 && high < 100.0) return between(low, high);
  if (low > -100.0) return low + between(0.0625, 2.0);
  return either_sign(0.0, 2.0);
}

/* A law of all its arguments, three numbers or one. */
static int some_law(const double *argument, double *value, void *context) {
  const int n = *(const int *)context;
  for (int i = 0; i < n; i++)
    value[i] = 0.5 * sin(2.0 * argument[0] + i) - 0.125 * argument[1] - 0.0625 * argument[2];
  return 0;
}

static void set_some(rotdyn_object *to, const rotdyn_input *input, int depth);

/* An object of this kind with all that it needs and some of the rest. */
static rotdyn_object *some_object(const char *kind, int depth) {
  const char *constructor = NULL;
  size_t n = 0;
  for (size_t i = 0; (constructor = rotdyn_object_at(i)); i++)
    n += !strcmp(rotdyn_object_kind(constructor), kind);
  n = (size_t)(next() % (n ? n : 1));
  for (size_t i = 0; (constructor = rotdyn_object_at(i)); i++)
    if (!strcmp(rotdyn_object_kind(constructor), kind) && n-- == 0) break;
  if (!constructor) return NULL;
  rotdyn_object *object = made(constructor);
  rotdyn_input input = ROTDYN_INIT(rotdyn_input);
  for (size_t i = 0; rotdyn_input_at(constructor, i, &input) == ROTDYN_OK; i++)
    if (input.required || !strcmp(input.name, "mass_kg") || one_in(3))
      set_some(object, &input, depth + 1);
  return object;
}

static void set_some(rotdyn_object *to, const rotdyn_input *input, int depth) {
  static const char *const kinds[] = {"torque",  "resistance", "brake", "coupling", "body",
                                      "inertia", "rotor",      "table", "moments",  "points"};
  static const int one = 1, three = 3;
  size_t n = 0;
  if (of_kind(input, "choice") && one_in(2)) {
    while (input->options && input->options[n]) n++;
    if (n) {
      const char *option = input->options[next() % n];
      say(input->name), say(option);
      (void)rotdyn_set_text(to, input->name, option);
      return;
    }
  }
  if (of_kind(input, "law") && one_in(3)) {
    say(input->name), say("f");
    (void)rotdyn_set_law(to, input->name, some_law,
                         (void *)(uintptr_t)(of_kind(input, "vector") ? &three : &one));
    return;
  }
  for (size_t i = 0; depth < 3 && i < sizeof kinds / sizeof *kinds; i++) {
    if (!of_kind(input, kinds[i]) || (of_kind(input, "number") && one_in(3))) continue;
    rotdyn_object *part = some_object(kinds[i], depth);
    if (part) give(to, input->name, part);
    return;
  }
  if (of_kind(input, "number") || of_kind(input, "limit")) {
    number(to, input->name, some_number(input));
  } else if (of_kind(input, "vector")) {
    vector(to, input->name, -1.0, 1.0);
  } else if (of_kind(input, "attitude") || of_kind(input, "numbers") || of_kind(input, "times")) {
    double x[4];
    for (int i = 0; i < 4; i++) x[i] = of_kind(input, "times") ? 0.5 * i : some_number(input);
    numbers(to, input->name, of_kind(input, "attitude") ? 4 : 2 + (size_t)(next() % 2), x);
  }
}

/* Scenes for the models that take few effects: variant k. */
static void make_simple(rotdyn_object *scene, const char *constructor, size_t k) {
  static const char *const extras[] = {"resistance", "brake", "rotors", "mass_kg", "centre_m"};
  rotdyn_object *part = NULL;
  double x[3];
  if (strcmp(constructor, "scene_axle") && strcmp(constructor, "scene_drive") &&
      strcmp(constructor, "scene_free") && strcmp(constructor, "scene_pivot") &&
      strcmp(constructor, "scene_chain") && strcmp(constructor, "scene_equations") &&
      strcmp(constructor, "scene_rotors"))
    return;
  for (size_t e = 0; e < 5 && strcmp(constructor, "scene_chain"); e++)
    (void)rotdyn_unset(scene, extras[e]);
  if (!strcmp(constructor, "scene_axle")) {
    (void)rotdyn_unset(scene, "torque");
    switch (k % 5) {
    case 0: break;
    case 1: number(scene, "torque", between(-1.0, 1.0)); break;
    case 2: give(scene, "body", some_object("inertia", 0)); break;
    case 3:
      part = made("torque_spring");
      number(part, "stiffness_n_m_per_rad", between(0.5, 4.0));
      give(scene, "torque", part);
      break;
    default:
      part = made("torque_motor");
      number(part, "stall_torque_n_m", between(0.25, 1.0));
      number(part, "no_load_omega_rad_per_s", between(4.0, 16.0));
      give(scene, "torque", part);
    }
    if (k % 3) {
      part = made("resistance");
      number(part, k % 3 == 1 ? "viscous_n_m_s" : "coulomb_n_m", between(0.0, 0.5));
      give(scene, "resistance", part);
    }
  } else if (!strcmp(constructor, "scene_drive")) {
    (void)rotdyn_unset(scene, "theta0_rad");
    part = made(k % 2 ? "coupling_shaft" : "coupling_clutch");
    number(part, k % 2 ? "stiffness_n_m_per_rad" : "capacity_n_m", between(0.5, 20.0));
    give(scene, "couplings", part);
    part = made("list");
    number(part, NULL, between(-1.0, 1.0)), number(part, NULL, between(-1.0, 1.0));
    give(scene, "torque", part);
    speeds_of(scene, 2);
  } else if (!strcmp(constructor, "scene_chain")) {
    double theta[2];
    for (int i = 0; i < 2; i++) theta[i] = between(-0x1p-12, 0x1p-12), x[i] = 1.0;
    numbers(scene, "theta0_rad", 2, theta);
    numbers(scene, "length_m", 2, x), numbers(scene, "mass_kg", 2, x);
  } else if (!strcmp(constructor, "scene_rotors")) {
    x[0] = between(-1.0, 1.0), x[1] = x[2] = 0.0;
    number(scene, "stiffness_n_m_per_rad", k % 2 ? 1e7 : 1e4);
    number(scene, "omega0_rad_per_s", between(-8.0, 8.0));
    if (rotdyn_set_numbers(scene, "torque", 2, x) == ROTDYN_OK &&
        rotdyn_object_check(scene, NULL) != ROTDYN_OK)
      (void)rotdyn_set_numbers(scene, "torque", 3, x);
  } else if (!strcmp(constructor, "scene_equations")) {
    x[0] = 1.0;
    numbers(scene, "positions", 1, x);
  } else {
    /* A symmetric body whose axis is the body frame's z, or (0, -0.96, -0.28). */
    const int turned = k % 2 == 1;
    const double axis[3] = {0.0, turned ? -0.96 : 0.0, turned ? -0.28 : 1.0};
    const double turn[4] = {0.6, 0.8, 0.0, 0.0}, tilt[4] = {0.875, 0.25, 0.25, 0.125};
    const double lever = between(0.0625, 0.25), spin = between(20.0, 60.0) * (k % 3 ? 1.0 : 16.0);
    double at[3], omega[3];
    for (int i = 0; i < 3; i++) at[i] = lever * axis[i], omega[i] = spin * axis[i];
    x[0] = x[1] = between(0.25, 0.5), x[2] = between(0.125, 0.5);
    rotdyn_object *top = made("body_tensor");
    number(top, "mass_kg", 1.0), numbers(top, "inertia_kg_m2", 3, x);
    part = made("place_body");
    give(part, "body", top);
    if (turned) numbers(part, "rotation", 4, turn);
    if (!strcmp(constructor, "scene_pivot")) numbers(part, "at_m", 3, at);
    give(scene, "body", part);
    numbers(scene, "attitude0", 4, tilt);
    if (k % 4 < 3) numbers(scene, "omega0_rad_per_s", 3, omega);
    if (k % 5 < 2 && !strcmp(constructor, "scene_pivot")) number(scene, "gravity_m_per_s2", 0.0);
    if (k % 3) return;
    part = made("rotor");
    numbers(part, "axis", 3, axis);
    number(part, "moment_of_inertia_kg_m2", between(0.0625, 0.125));
    number(part, "omega_rad_per_s", between(-9.0, 9.0));
    give(scene, "rotors", part);
  }
}

/* A third of the scenes are a maker's, a third simple, and a third have further inputs, which may
 * be refused. */
static rotdyn_object *some_scene(size_t i) {
  const char *constructor = random_constructor(i);
  rotdyn_object *scene = random_scene(i);
  rotdyn_input input = ROTDYN_INIT(rotdyn_input);
  if (i / N_MAKERS % 3 == 0) return scene;
  if (i / N_MAKERS % 3 == 1) {
    make_simple(scene, constructor, i / N_MAKERS / 3);
    return scene;
  }
  for (size_t k = 0; rotdyn_input_at(constructor, k, &input) == ROTDYN_OK; k++) {
    if (!input.required && one_in(4)) set_some(scene, &input, 0);
    if (!strcmp(input.name, "body") && one_in(4)) set_some(scene, &input, 0);
  }
  return scene;
}

/* ---- what a scene gives ---------------------------------------------------------------------- */

static double values[MAX_COLUMNS][MAX_ROWS];
static double time_s[EVEN];
static size_t n_times;
static const char *names[MAX_COLUMNS];
static double *columns[MAX_COLUMNS];
static size_t n_columns;

static void columns_of(const char *constructor) {
  n_columns = 0;
  for (size_t k = 0; n_columns < MAX_COLUMNS; k++) {
    const char *name = rotdyn_column_at(constructor, k);
    if (!name) break;
    columns[n_columns] = values[n_columns];
    names[n_columns++] = name;
  }
}

/* The weights of the rows are the golden section's multiples, so that no two are alike. */
static void column(const double *x, size_t n, double relative, double largest) {
  double sum = 0.0, size = 0.0;
  size_t missing = 0;
  for (size_t r = 0; r < n; r++) {
    const double weight = 1.0 + fmod(0.6180339887498949 * (double)(r + 1), 1.0);
    missing += isnan(x[r]) ? 1 : 0;
    if (isnan(x[r])) continue;
    sum += weight * x[r];
    size = fmax(size, fabs(x[r]));
  }
  if (other_build) size = fmax(size, largest); /* of a component that is rounding */
  number_of("%.9e", sum, size * (double)n + DBL_MIN, relative);
  if (missing) count(missing);
}

static void all_columns(size_t n, double relative) {
  double largest = 0.0;
  for (size_t k = 0; k < n_columns; k++)
    for (size_t r = 0; r < n; r++) largest = fmax(largest, fabs(values[k][r]));
  for (size_t k = 0; k < n_columns; k++) column(values[k], n, relative, largest);
}

/* How far a correct program may be off: little for a closed form. */
static double off(const rotdyn_report *report) {
  const double of_two_runs = other_build ? 2.0 : 0.3;
  return value_tolerance + (report->error_is_bound ? 0.0 : of_two_runs * report->error);
}

/* Into *ran: the model that ran, or NULL. */
static int run(const rotdyn_object *scene, const rotdyn_options *options, const char **ran) {
  const char *event[MAX_EVENTS];
  double event_s[MAX_EVENTS];
  int place[MAX_EVENTS] = {0};
  rotdyn_report report = ROTDYN_INIT(rotdyn_report);
  rotdyn_options own = *options;
  rotdyn_events events = ROTDYN_INIT(rotdyn_events);
  events.room = MAX_EVENTS;
  events.time_s = event_s;
  events.name = event;
  events.place = place;
  own.events = &events;
  memset(values, 0, sizeof values);
  const int status =
      rotdyn_scene_run(scene, n_times, time_s, &own, MAX_ROWS, n_columns, names, columns, &report);
  *ran = status == ROTDYN_OK ? report.model : NULL;
  word("run"), word(options->model), count((size_t)status), word(report.model);
  sentence(report.reason), word(report.input), count(report.rows_done), count(report.rows_per_time);
  count((size_t)report.error_is_bound);
  if (status == ROTDYN_OK) {
    figure_of(report.error, !report.error_is_bound);
    for (size_t k = 0; k < report.n_measures; k++) {
      word(report.measure[k]);
      figure_of(report.measure_error[k], !report.error_is_bound);
      number_of("%.5e", report.measure_largest[k], report.measure_largest[k], figure_tolerance);
    }
    count(events.count);
    for (size_t k = 0; k < events.count && k < MAX_EVENTS; k++) {
      word(event[k]), count((size_t)(place[k] + 100));
      number_of("%.8e", event_s[k], time_s[n_times - 1], 100.0 * off(&report));
    }
    all_columns(n_times * report.rows_per_time, 10.0 * off(&report));
  }
  return end_line();
}

static int balances(const rotdyn_object *scene, const rotdyn_options *options) {
  rotdyn_balance b = ROTDYN_INIT(rotdyn_balance);
  rotdyn_report report = ROTDYN_INIT(rotdyn_report);
  int same = 1, status;
  for (size_t k = 0; k < 8; k++) {
    status = rotdyn_scene_balance(scene, n_times, time_s, options, k, &b, &report);
    if (status != ROTDYN_OK) break;
    double size = fabs(b.change) + fabs(b.supplied) + fabs(b.dissipated);
    for (size_t t = 0; t < b.n_terms; t++) size = fmax(size, fabs(b.value[t]));
    word("balance"), word(b.quantity), sentence(b.about ? b.about : ""), sentence(b.unit);
    word(b.balanced == 1 ? "yes" : b.balanced == 0 ? "no" : "unknown");
    word(b.conserved == 1 ? "kept" : b.conserved == 0 ? "changed" : "unknown"), sentence(b.why);
    figure_of(b.explained, !report.error_is_bound);
    /* Of what is conserved the change is what the audit explains by errors. */
    const double by = 10.0 * off(&report) * size + (isfinite(b.explained) ? b.explained : 0.0);
    number_of("%.9e", b.change, by, 1.0), number_of("%.9e", b.supplied, by, 1.0);
    number_of("%.9e", b.dissipated, by, 1.0);
    for (size_t t = 0; t < b.n_terms; t++) {
      sentence(b.term[t]), count((size_t)b.role[t]);
      number_of("%.9e", b.value[t], by, 1.0);
    }
    same &= end_line();
  }
  if (status != ROTDYN_EEND) {
    word("balance"), count((size_t)status), sentence(report.reason);
    same &= end_line();
  }
  return same;
}

/* Three rows that differ in a number. */
static int rows(const rotdyn_object *scene, const char *constructor,
                const rotdyn_options *options) {
  static const double scale[] = {0.5, 1.0, 1.5};
  rotdyn_input input = ROTDYN_INIT(rotdyn_input);
  int same = 1;
  for (size_t i = 0; rotdyn_input_at(constructor, i, &input) == ROTDYN_OK; i++) {
    if (!of_kind(&input, "number") || !one_in(4)) continue;
    double given[3], error[3] = {0.0, 0.0, 0.0};
    int status[3] = {0, 0, 0};
    const char *model[3] = {NULL, NULL, NULL};
    rotdyn_rows_in in = ROTDYN_INIT(rotdyn_rows_in);
    rotdyn_rows_out out = ROTDYN_INIT(rotdyn_rows_out);
    rotdyn_report report = ROTDYN_INIT(rotdyn_report);
    const rotdyn_column varied = {.values = given, .step = 1};
    const char *name = input.name;
    const double x = some_number(&input);
    for (int r = 0; r < 3; r++) given[r] = x * scale[r];
    in.time_s = (rotdyn_column){.values = time_s + 1, .step = 1};
    in.n_inputs = 1, in.inputs = &name, in.values = &varied;
    out.n_columns = n_columns, out.names = names, out.columns = columns;
    out.error = error, out.status = status, out.model = model;
    memset(values, 0, sizeof values);
    const int all = rotdyn_scene_rows(scene, 3, &in, options, &out, &report);
    word("rows"), word(name), count((size_t)all), word(report.input), sentence(report.reason);
    if (all == ROTDYN_OK) {
      double worst = 0.0;
      for (int r = 0; r < 3; r++) {
        count((size_t)status[r]), word(model[r]);
        figure_of(error[r], 1);
        if (error[r] > worst) worst = error[r];
      }
      all_columns(3 * report.rows_per_time, 10.0 * (value_tolerance + 0.3 * worst));
    }
    same &= end_line();
  }
  return same;
}

static int scene_figures(size_t i) {
  static const double accuracies[] = {1e-2, 1e-5, 1e-8, 1e-11};
  const char *constructor = random_constructor(i);
  rotdyn_object *scene = some_scene(i);
  rotdyn_report report = ROTDYN_INIT(rotdyn_report);
  rotdyn_options options = ROTDYN_INIT(rotdyn_options);
  rotdyn_candidate candidate = ROTDYN_INIT(rotdyn_candidate);
  char hash[ROT_HASH_SIZE];
  const char *model[32], *chosen = NULL, *ran = NULL;
  size_t n_models = 0;
  int same;
  scene_number = i;
  n_times = i / N_MAKERS % 5 < 3 ? FEW : EVEN;
  time_s[0] = between(0.0, 0.25);
  for (size_t k = 1; k < FEW; k++) time_s[k] = time_s[k - 1] + between(0.125, 1.0);
  for (size_t k = 1; k < n_times && n_times == EVEN; k++) time_s[k] = time_s[0] + 0.125 * (double)k;
  options.max_steps = 2e4;
  options.accuracy = accuracies[(i / N_MAKERS + i % N_MAKERS) % 4];
  rot_hash((const unsigned char *)scene_text, scene_text_size, hash);
  hash[8] = 0;
  word("scene"), count(i), word(constructor), word(hash);
  count((size_t)rotdyn_object_check(scene, &report)), word(report.input), sentence(report.reason);
  same = end_line();
  if (report.status == ROTDYN_OK) {
    columns_of(constructor);
    for (size_t k = 0;
         rotdyn_scene_candidate(scene, n_times, time_s, &options, k, &candidate) == ROTDYN_OK;
         k++) {
      word("model"), word(candidate.model), count((size_t)candidate.applies);
      sentence(candidate.reason), figure(candidate.error), figure(candidate.cost_s);
      count((size_t)candidate.error_is_bound);
      same &= end_line();
      if (n_models < 32) model[n_models++] = candidate.model;
    }
    same &= run(scene, &options, &chosen) && balances(scene, &options);
    for (size_t k = 0; k < n_models; k++) {
      options.model = model[k];
      /* Those of an integrator differ little between scenes. */
      const int steps = strstr(model[k], "_euler") || strstr(model[k], "_rk") ||
                        strstr(model[k], "_semi_") || strstr(model[k], "_radau");
      if (steps && (i + i / 52 + k) % 4) continue;
      if (!chosen || strcmp(chosen, model[k])) same &= run(scene, &options, &ran);
    }
    options.model = NULL;
    same &= rows(scene, constructor, &options);
  }
  rotdyn_object_free(scene);
  return same;
}

static int open_file(void) {
  static const char own[] = "test_figures.c", name[] = "figures.txt";
  char path[1024];
  const size_t folder = strlen(__FILE__) - (sizeof own - 1);
  const char *wanted = getenv("ROTDYN_FIGURES");
  writes = wanted && !strcmp(wanted, "write");
  other_build = wanted && !strcmp(wanted, "other");
  if (folder + sizeof name > sizeof path) return 0;
  memcpy(path, __FILE__, folder);
  memcpy(path + folder, name, sizeof name);
  file = fopen(path, writes ? "w" : "r");
  return file != NULL;
}

/* The lines of a scene follow one another: after a scene that differs the rest is not compared. */
static void check_figures(void) {
  const int trials = rot_test_trials(4 * SCENES), n = trials < SCENES ? trials : SCENES;
  int same = open_file();
  ROT_CHECK(same);
  for (size_t i = 0; i < (size_t)n && same; i++) {
    same = scene_figures(i);
    ROT_CHECK(same);
  }
  if (!file) return;
  if (!writes && same && n == SCENES) ROT_CHECK(fgetc(file) == EOF);
  ROT_CHECK(fclose(file) == 0);
}

int main(void) {
  check_figures();
  return rot_test_report("figures");
}
