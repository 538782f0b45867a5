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
#include "random_scenes.h"

enum { TIMES = 9, MAX_ROWS_PER_TIME = 4, MAX_COLUMNS = 24, MAX_EVENTS = 64 };

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
  const char *constructor = random_constructor(i);
  rotdyn_object *scene;
  char hash[ROT_HASH_SIZE];
  size_t n = 0, rows;
  int status;

  scene = random_scene(i);
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
  rot_hash((const unsigned char *)scene_text, scene_text_size, hash);
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
      printf("  scene %zu (%s): %s and %s, another text\n", a.i, random_constructor(a.i), a.model,
             b.model);
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
             random_constructor(a.i), a.model, difference(&a, &b), a.error, b.error);
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
