/* What the page calls: a scene from its text, its rows, models, balances and R code. The answers
 * are JSON; times and columns are doubles in memory.
 *
 *   lab_input(n)     memory for a text of n bytes, which the caller ends with a zero byte
 *   lab_read()       the scene in it => {"status", "input", "reason"} or its columns
 *   lab_run(...)     => the report; column i at lab_column(i), times at lab_times()
 *   lab_models()     => the models by their cost, for the same times
 *   lab_audit()      => the balances of the run
 *   lab_code()       => the R code
 *   lab_catalogue()  => all constructors with their inputs */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "api/object.h"
#include "scene.h"
#include "scene/free/free.h"
#include "scene/incline/incline.h"
#include "scene/run.h"
#include "text/scene_code.h"

#ifdef __wasm__
#define LAB_ENTRY(name) __attribute__((export_name(#name)))
#else
#define LAB_ENTRY(name)
#endif

enum { MAX_EVENTS = 200, MAX_ROWS = 20001 };

typedef struct lab_column_of {
  const char *name;
  int flag;
  size_t measure; /* as of rot_column_of */
} lab_column_of;

static struct {
  char *input;
  rot_writer answer;
  rot_json *tree;
  rotdyn_object *scene;
  lab_column_of column[ROT_MAX_COLUMNS];
  size_t n_columns, rows_per_time, n;
  const char *index, *id;
  double *times, *values; /* values: the columns, one after the other */
  rotdyn_options options;
} lab;

static const char *answered(void) { return lab.answer.failed ? NULL : lab.answer.text; }

static void begin(void) {
  lab.answer.length = 0;
  lab.answer.failed = 0;
}

static void member(const char *name, const char *text) {
  rot_write(&lab.answer, ",\"%s\":", name);
  rot_write_string(&lab.answer, text);
}

static void number_member(const char *name, double x) {
  rot_write(&lab.answer, ",\"%s\":", name);
  rot_write_number(&lab.answer, x);
}

/* ---- the catalogue --------------------------------------------------------------------------- */

static void add_inputs(const char *constructor) {
  rotdyn_input input = ROTDYN_INIT(rotdyn_input);
  for (size_t i = 0; rotdyn_input_at(constructor, i, &input) == ROTDYN_OK; i++) {
    rot_write(&lab.answer, "%s{\"name\":", i ? "," : "");
    rot_write_string(&lab.answer, input.name);
    member("unit", input.unit);
    member("kinds", input.kinds);
    rot_write(&lab.answer, ",\"required\":%d,\"above\":%d", input.required, input.above);
    number_member("low", input.low);
    number_member("high", input.high);
    number_member("otherwise", input.otherwise);
    member("words", input.words);
    for (size_t k = 0; input.options && input.options[k]; k++) {
      rot_write(&lab.answer, k ? "," : ",\"options\":[");
      rot_write_string(&lab.answer, input.options[k]);
      if (!input.options[k + 1]) rot_write(&lab.answer, "]");
    }
    rot_write(&lab.answer, "}");
  }
}

const char *lab_catalogue(void);
LAB_ENTRY(lab_catalogue) const char *lab_catalogue(void) {
  const char *constructor;
  begin();
  rot_write(&lab.answer, "{\"version\":\"%s\"", rotdyn_version());
  for (size_t i = 0; (constructor = rotdyn_object_at(i)) != NULL; i++) {
    rot_write(&lab.answer, ",\"%s\":{\"kind\":\"%s\",\"inputs\":[", constructor,
              rotdyn_object_kind(constructor));
    add_inputs(constructor);
    rot_write(&lab.answer, "]}");
  }
  rot_write(&lab.answer, ",\"models\":{");
  rotdyn_model model = ROTDYN_INIT(rotdyn_model);
  for (size_t i = 0; rotdyn_model_at(i, &model) == ROTDYN_OK; i++) {
    rot_write(&lab.answer, "%s\"%s\":", i ? "," : "", model.model);
    rot_write_string(&lab.answer, model.why);
  }
  rot_write(&lab.answer, "}}");
  return answered();
}

/* ---- the scene ------------------------------------------------------------------------------- */

char *lab_input(size_t n);
LAB_ENTRY(lab_input) char *lab_input(size_t n) {
  char *input = n < SIZE_MAX ? realloc(lab.input, n + 1) : NULL;
  if (!input) return NULL;
  input[n] = input[0] = '\0';
  return lab.input = input;
}

static void vector_member(const char *name, size_t n, const double x[]) {
  rot_write(&lab.answer, ",\"%s\":[", name);
  for (size_t i = 0; i < n; i++) {
    if (i) rot_write(&lab.answer, ",");
    rot_write_number(&lab.answer, x[i]);
  }
  rot_write(&lab.answer, "]");
}

/* What a picture of a body in space needs: half the sides of the homogeneous box with its moments,
 * the largest 1, along its principal axes, and where the weight acts from the fixed point, in these
 * axes. */
static void add_box(const rot_free_params *p) {
  double side[3], largest = 0.0;
  for (int i = 0; i < 3; i++) {
    const double *m = p->moment_kg_m2;
    side[i] = sqrt(fmax(m[(i + 1) % 3] + m[(i + 2) % 3] - m[i], 0.0));
    largest = fmax(largest, side[i]);
  }
  for (int i = 0; i < 3; i++) side[i] = largest > 0.0 ? side[i] / largest : 1.0;
  vector_member("box", 3, side);
  if (p->turned) vector_member("axes", 4, p->axes);
  vector_member("lever_n_m", 3, p->lever_n_m);
}

/* The columns that rows of the scene show. */
static void find_columns(void) {
  rot_api_built built = {0};
  rotdyn_report report = ROTDYN_INIT(rotdyn_report);
  lab.n_columns = 0;
  if (rot_api_build(lab.scene, &built, &report) == ROTDYN_OK) {
    const rot_constraint *c = built.constraint;
    const unsigned effects = c->effects_of(built.scene);
    for (size_t i = 0; i < c->n_columns; i++) {
      if (!rot_run_shows(c, built.scene, effects, i)) continue;
      lab.column[lab.n_columns++] =
          (lab_column_of){c->columns[i].name, c->columns[i].flag, c->columns[i].measure};
    }
    lab.rows_per_time = report.rows_per_time;
    lab.index = report.index;
    lab.id = c->id;
    number_member("start_s", c->start_s(built.scene));
    if (strcmp(c->id, "free") == 0 || strcmp(c->id, "pivot") == 0) add_box(built.scene);
    if (strcmp(c->id, "incline") == 0) {
      number_member("radius_m", ((const rot_incline_params *)built.scene)->radius_m);
    }
  }
  rot_api_release(&built);
}

static void forget(void) {
  rotdyn_object_free(lab.scene);
  rot_json_free(lab.tree);
  lab.scene = NULL;
  lab.tree = NULL;
  lab.n = lab.n_columns = 0;
}

const char *lab_read(void);
LAB_ENTRY(lab_read) const char *lab_read(void) {
  lab_refusal refusal;
  forget();
  begin();
  lab.tree = lab.input ? rot_json_read(lab.input) : NULL;
  lab.scene = lab_scene_read(lab.tree, &refusal);
  rot_write(&lab.answer, "{\"status\":%d", lab.scene ? ROTDYN_OK : refusal.status);
  if (!lab.scene) {
    member("input", refusal.input[0] ? refusal.input : NULL);
    member("reason", refusal.reason);
  } else {
    member("constructor", rot_scene_member(lab.tree)->key);
    find_columns();
    member("constraint", lab.id);
    member("index", lab.index);
    rot_write(&lab.answer, ",\"rows_per_time\":%zu,\"columns\":[", lab.rows_per_time);
    for (size_t i = 0; i < lab.n_columns; i++) {
      rot_write(&lab.answer, "%s{\"name\":\"%s\",\"flag\":%d,\"measure\":%d}", i ? "," : "",
                lab.column[i].name, lab.column[i].flag, (int)lab.column[i].measure - 1);
    }
    rot_write(&lab.answer, "]");
  }
  rot_write(&lab.answer, "}");
  return answered();
}

/* ---- the run --------------------------------------------------------------------------------- */

/* n times from `start` to `end`, as seq() of R has them. */
static int set_times(double start, double end, size_t n) {
  if (!lab.scene || n < 1 || n > MAX_ROWS) return 0;
  double *times = realloc(lab.times, n * sizeof *times);
  if (times) lab.times = times;
  const size_t size = n * lab.rows_per_time * lab.n_columns + 1;
  double *values = realloc(lab.values, size * sizeof *values);
  if (values) lab.values = values;
  if (!times || !values) return 0;
  const double by = (end - start) / ((double)n - 1.0);
  for (size_t i = 0; i < n; i++) times[i] = i == 0 ? start : start + (double)i * by;
  if (n > 1) times[n - 1] = end;
  lab.n = n;
  return 1;
}

static void add_measures(const rotdyn_report *r) {
  rot_write(&lab.answer, ",\"measures\":[");
  for (size_t i = 0; i < r->n_measures; i++) {
    rot_write(&lab.answer, "%s{\"name\":\"%s\"", i ? "," : "", r->measure[i]);
    number_member("error", r->measure_error[i]);
    number_member("largest", r->measure_largest[i]);
    rot_write(&lab.answer, "}");
  }
  rot_write(&lab.answer, "]");
}

static void add_events(const rotdyn_events *e) {
  rot_write(&lab.answer, ",\"n_events\":%zu,\"events\":[", e->count);
  for (size_t i = 0; i < e->count && i < e->room; i++) {
    rot_write(&lab.answer, "%s{\"name\":\"%s\",\"place\":%d", i ? "," : "", e->name[i],
              e->place[i]);
    number_member("time_s", e->time_s[i]);
    rot_write(&lab.answer, "}");
  }
  rot_write(&lab.answer, "]");
}

/* The input has the name of a model, or is empty. Without a scene: NULL. */
const char *lab_run(double start, double end, unsigned n, double accuracy, double max_steps);
LAB_ENTRY(lab_run)
const char *lab_run(double start, double end, unsigned n, double accuracy, double max_steps) {
  static double event_s[MAX_EVENTS];
  static const char *event_name[MAX_EVENTS];
  static int event_place[MAX_EVENTS];
  const char *names[ROT_MAX_COLUMNS];
  double *columns[ROT_MAX_COLUMNS];
  rotdyn_report r = ROTDYN_INIT(rotdyn_report);
  rotdyn_events events = {.size = sizeof events,
                          .room = MAX_EVENTS,
                          .time_s = event_s,
                          .name = event_name,
                          .place = event_place};
  if (!set_times(start, end, n)) return NULL;
  const size_t room = lab.n * lab.rows_per_time;
  for (size_t i = 0; i < lab.n_columns; i++) {
    names[i] = lab.column[i].name;
    columns[i] = lab.values + i * room;
    for (size_t k = 0; k < room; k++) columns[i][k] = (double)NAN;
  }
  lab.options = (rotdyn_options){
      .size = sizeof lab.options, .accuracy = accuracy, .max_steps = max_steps, .events = &events};
  if (lab.input && lab.input[0]) lab.options.model = lab.input;
  (void)rotdyn_scene_run(lab.scene, lab.n, lab.times, &lab.options, room, lab.n_columns, names,
                         columns, &r);
  lab.options.events = NULL;
  lab.options.model = r.model;
  begin();
  rot_write(&lab.answer, "{\"status\":%d", r.status);
  member("status_text", rotdyn_status_text(r.status));
  member("model", r.model);
  member("input", r.input);
  member("reason", r.reason);
  number_member("error", r.error);
  number_member("time_s", r.time_s);
  rot_write(&lab.answer, ",\"error_is_bound\":%d,\"rows_done\":%zu,\"steps\":%zu,\"rejected\":%zu",
            r.error_is_bound, r.rows_done, r.steps, r.rejected);
  add_measures(&r);
  add_events(&events);
  rot_write(&lab.answer, "}");
  return answered();
}

const double *lab_times(void);
LAB_ENTRY(lab_times) const double *lab_times(void) { return lab.times; }

const double *lab_column(unsigned i);
LAB_ENTRY(lab_column) const double *lab_column(unsigned i) {
  return i < lab.n_columns ? lab.values + i * lab.n * lab.rows_per_time : NULL;
}

/* Rows for each time. */
size_t lab_rows(void);
LAB_ENTRY(lab_rows) size_t lab_rows(void) { return lab.rows_per_time; }

/* ---- models, balances, code ------------------------------------------------------------------ */

const char *lab_models(void);
LAB_ENTRY(lab_models) const char *lab_models(void) {
  rotdyn_candidate c = ROTDYN_INIT(rotdyn_candidate);
  if (!lab.scene || !lab.n) return NULL;
  rotdyn_options options = lab.options;
  options.model = NULL;
  begin();
  rot_write(&lab.answer, "[");
  for (size_t k = 0; rotdyn_scene_candidate(lab.scene, lab.n, lab.times, &options, k, &c) == 0;
       k++) {
    rot_write(&lab.answer, "%s{\"applies\":%d,\"error_is_bound\":%d", k ? "," : "", c.applies,
              c.error_is_bound);
    member("model", c.model);
    number_member("error", c.error);
    number_member("cost_s", c.cost_s);
    member("reason", c.reason);
    rot_write(&lab.answer, "}");
  }
  rot_write(&lab.answer, "]");
  return answered();
}

const char *lab_audit(void);
LAB_ENTRY(lab_audit) const char *lab_audit(void) {
  if (!lab.scene || !lab.n) return NULL;
  begin();
  rot_write(&lab.answer, "[");
  for (size_t k = 0;; k++) {
    rotdyn_balance b = ROTDYN_INIT(rotdyn_balance);
    if (rotdyn_scene_balance(lab.scene, lab.n, lab.times, &lab.options, k, &b, NULL)) break;
    rot_write(&lab.answer, "%s{\"balanced\":%d,\"conserved\":%d", k ? "," : "", b.balanced,
              b.conserved);
    member("quantity", b.quantity);
    member("about", b.about);
    member("unit", b.unit);
    member("why", b.why);
    number_member("change", b.change);
    number_member("supplied", b.supplied);
    number_member("dissipated", b.dissipated);
    number_member("residual", b.residual);
    number_member("explained", b.explained);
    rot_write(&lab.answer, ",\"terms\":[");
    for (size_t i = 0; i < b.n_terms; i++) {
      rot_write(&lab.answer, "%s{\"role\":%d", i ? "," : "", b.role[i]);
      member("words", b.term[i]);
      number_member("value", b.value[i]);
      rot_write(&lab.answer, "}");
    }
    rot_write(&lab.answer, "]}");
  }
  rot_write(&lab.answer, "]");
  return answered();
}

/* The code that makes the scene; empty where only read_scene() can. */
const char *lab_code(void);
LAB_ENTRY(lab_code) const char *lab_code(void) {
  begin();
  rot_write(&lab.answer, "%s", "");
  if (lab.tree) (void)rot_scene_code(lab.tree, &lab.answer);
  return answered();
}

/* Frees everything. */
void lab_close(void);
LAB_ENTRY(lab_close) void lab_close(void) {
  forget();
  free(lab.input);
  free(lab.answer.text);
  free(lab.times);
  free(lab.values);
  memset(&lab, 0, sizeof lab);
}
