/* Rows of a sweep: equal to rot_run() of a scene made with the row's numbers, bit for bit, in many
 * constraints; times; rows that are refused, with their status; one model for all rows. */
#include "sweep_kit.h"

/* ---- rows equal runs ------------------------------------------------------------------------- */

enum { NAMES = 4 * ROT_MAX_COLUMNS, NAME = 80 };

/* Outputs of a case: each column at the end, extremes of it, error, steps. */
typedef struct output_list {
  size_t n;
  char name[NAMES][NAME];
  const char *list[NAMES];
} output_list;

static void add(output_list *o, const char *prefix, const char *column, size_t copy) {
  const size_t k = o->n++;
  if (copy)
    (void)snprintf(o->name[k], NAME, "%s%s[%zu]", prefix, column, copy);
  else
    (void)snprintf(o->name[k], NAME, "%s%s", prefix, column);
  o->list[k] = o->name[k];
}

static const char *const prefixes[] = {"final_", "max_", "min_", "max_abs_"};

static void all_outputs(const rot_constraint *c, size_t copies, output_list *o) {
  o->n = 0;
  for (int p = 0; p < 4; p++) {
    for (size_t i = 0; i < c->n_columns && i < 15; i++) {
      for (size_t k = 1; k <= copies; k++)
        add(o, prefixes[p], c->columns[i].name, c->index ? k : 0);
    }
  }
  add(o, "error", "", 0);
  add(o, "steps", "", 0);
}

static double extreme(const kit_run *r, int how, size_t column, size_t copy) {
  double found = kit_cell(r, column, r->n - 1, copy);
  if (how == 0) return found;
  if (how == 3) found = fabs(found);
  for (size_t i = 0; i < r->n; i++) {
    const double x = kit_cell(r, column, i, copy);
    if (how == 1 && x > found) found = x;
    if (how == 2 && x < found) found = x;
    if (how == 3 && fabs(x) > found) found = fabs(x);
  }
  return found;
}

/* A row against the run of a scene made with its numbers. */
static void check_row(const kit_case *c, const char *model, size_t n_times, const double time_s[],
                      rot_rows_worker *w, const output_list *o, const double x[]) {
  rot_object *made = c->make(x);
  double value[NAMES], error, times[KIT_TIMES + 1] = {0.0};
  const rot_model *ran;
  for (size_t i = 0; i < n_times; i++) times[i + 1] = time_s[i];
  kit_run r = kit_run_of(made, model, 1e-9, n_times + 1, times);
  ROT_CHECK(r.end == ROT_RUN_DONE && r.out.info.status == ROT_OK);
  ROT_CHECK_EQ_INT(rot_rows_run(w, x, value, &error, &ran, NULL), ROT_OK);
  ROT_CHECK(ran == r.out.model && same_bits(error, r.out.error));
  size_t k = 0, differ = 0;
  for (int p = 0; p < 4; p++) {
    for (size_t i = 0; i < r.constraint->n_columns && i < 15; i++) {
      for (size_t copy = 0; copy < c->copies; copy++, k++) {
        differ += !same_bits(value[k], extreme(&r, p, i, copy));
      }
    }
  }
  ROT_CHECK_EQ_INT(differ, 0);
  ROT_CHECK(same_bits(value[k], r.out.error));
  ROT_CHECK(same_bits(value[k + 1], (double)r.out.info.steps));
  ROT_CHECK_EQ_INT(k + 2, o->n);
  kit_free(&r);
  rot_object_free(made);
}

static output_list wanted;

static void check_rows(const char *model, const kit_case *c, size_t n_times, int rows) {
  const double time_s[] = {0.3 * c->end_s, 0.4 * c->end_s, c->end_s};
  const double *times = time_s + (3 - n_times);
  double base[KIT_INPUTS], x[KIT_INPUTS];
  kit_inputs(c, 0, base);
  if (c->make == make_box) base[2] = 1.0; /* its attitude is the default */
  rot_object *scene = c->make(base);
  all_outputs(scene->constraint, c->copies, &wanted);
  const rot_row_plan plan = {.scene = scene,
                             .n_inputs = KIT_INPUTS,
                             .inputs = c->path,
                             .n_times = n_times,
                             .time_s = times,
                             .model = model,
                             .accuracy = 1e-9,
                             .max_steps = 1e6,
                             .n_outputs = wanted.n,
                             .outputs = wanted.list};
  rot_rows_worker *w;
  rot_refusal no;
  ROT_CHECK(rot_rows_open(&plan, &w, &no) == ROT_OK);
  if (!w) return;
  for (int k = 0; k < rows; k++) {
    kit_inputs(c, (size_t)k, x);
    check_row(c, model, n_times, times, w, &wanted, x);
  }
  check_row(c, model, n_times, times, w, &wanted, base); /* nothing of a row stays */
  rot_rows_close(w);
  rot_object_free(scene);
}

static void named_models(void) {
  for (int i = 0; i < KIT_CASES; i++) {
    check_rows(kit_cases[i].model, &kit_cases[i], 1, rot_test_trials(160));
    check_rows(kit_cases[i].model, &kit_cases[i], 3, rot_test_trials(80));
  }
}

static void chosen_models(void) {
  for (int i = 0; i < KIT_CASES; i++) check_rows(NULL, &kit_cases[i], 1, rot_test_trials(80));
}

/* ---- times and refusals ---------------------------------------------------------------------- */

enum { THETA, OMEGA, ERROR, PLAIN };
static const char *const plain[PLAIN] = {"final_theta_rad", "final_omega_rad_per_s", "error"};

static int run_one(const rot_object *scene, const char *model, const char *input, double x,
                   size_t n_times, const double time_s[], double value[PLAIN], rot_refusal *no) {
  const rot_row_plan plan = {scene, 1, &input, n_times, time_s, model, 0, 1e-9, 1e6, PLAIN, plain};
  rot_rows_worker *w;
  double error = 0.0;
  const rot_model *ran = NULL;
  if (rot_rows_open(&plan, &w, no) != ROT_OK) return -1;
  const int status = rot_rows_run(w, &x, value, &error, &ran, no);
  ROT_CHECK(status == ROT_OK ? ran != NULL && same_bits(error, value[ERROR])
                             : ran == NULL && isnan(error));
  for (int k = 0; k < PLAIN; k++) ROT_CHECK(status == ROT_OK || isnan(value[k]));
  rot_rows_close(w);
  return status;
}

/* `time_s` among the inputs replaces the last time; times after it are left out. */
static void last_times(void) {
  static const double x[] = {2.0, 0.03, 1.0}, time_s[] = {0.5, 1.0, 3.0};
  rot_object *wheel = make_wheel(x);
  rot_refusal no;
  double value[PLAIN];
  for (double end = 0.25; end < 4.0; end *= 2.0) {
    double times[KIT_TIMES] = {0.0};
    size_t n = 1;
    if (end >= 0.5) times[n++] = 0.5;
    if (end >= 1.0) times[n++] = 1.0;
    times[n++] = end;
    kit_run r = kit_run_of(wheel, "axle_linear", 1e-9, n, times);
    ROT_CHECK_EQ_INT(run_one(wheel, "axle_linear", "time_s", end, 3, time_s, value, &no), ROT_OK);
    ROT_CHECK(same_bits(value[THETA], kit_cell(&r, 0, n - 1, 0)));
    ROT_CHECK(same_bits(value[OMEGA], kit_cell(&r, 1, n - 1, 0)));
    ROT_CHECK(same_bits(value[ERROR], r.out.error));
    kit_free(&r);
  }
  ROT_CHECK_EQ_INT(run_one(wheel, "axle_linear", "time_s", NAN, 1, time_s, value, &no), ROT_EVALUE);
  ROT_CHECK_EQ_INT(run_one(wheel, "axle_linear", "time_s", INFINITY, 1, time_s, value, &no),
                   ROT_EVALUE);
  /* Without times of the plan, too. */
  ROT_CHECK_EQ_INT(run_one(wheel, "axle_linear", "time_s", 2.0, 0, NULL, value, &no), ROT_OK);
  kit_run r = kit_run_of(wheel, "axle_linear", 1e-9, 2, (const double[]){0.0, 2.0});
  ROT_CHECK(same_bits(value[THETA], kit_cell(&r, 0, 1, 0)));
  kit_free(&r);
  rot_object_free(wheel);
}

/* A last time before the start: models that run backwards do, others do not take the scene. */
static void backwards(void) {
  static const double x[] = {0.05, 0.01, 2.0}, y[] = {2.0, 0.0, 1.0}, end = 1.0;
  rot_object *dry = make_dry(x), *wheel = make_wheel(y);
  rot_refusal no;
  double value[PLAIN];
  ROT_CHECK_EQ_INT(run_one(dry, "axle_drag", "time_s", -1.0, 1, &end, value, &no),
                   ROT_ROW_NO_MODEL);
  ROT_CHECK_EQ_INT(run_one(dry, "axle_drag", "start_s", 2.0, 1, &end, value, &no),
                   ROT_ROW_NO_MODEL);
  ROT_CHECK_EQ_INT(run_one(wheel, "axle_linear", "time_s", -1.0, 1, &end, value, &no), ROT_OK);
  kit_run r = kit_run_of(wheel, "axle_linear", 1e-9, 1, (const double[]){-1.0});
  ROT_CHECK(same_bits(value[THETA], kit_cell(&r, 0, 0, 0)) && value[OMEGA] < 1.0);
  kit_free(&r);
  rot_object_free(dry);
  rot_object_free(wheel);
}

static void refused_rows(void) {
  static const double x[] = {2.0, 0.03, 1.0}, end = 2.0;
  rot_object *wheel = make_wheel(x);
  rot_refusal no;
  double value[PLAIN];
  ROT_CHECK_EQ_INT(run_one(wheel, "axle_linear", "body$mass_kg", -1.0, 1, &end, value, &no),
                   ROT_EVALUE);
  ROT_CHECK(no.input == 0 && strstr(no.reason, "body_disk") && strstr(no.reason, "mass_kg"));
  ROT_CHECK_EQ_INT(run_one(wheel, "axle_linear", "omega0_rad_per_s", NAN, 1, &end, value, &no),
                   ROT_EVALUE);
  ROT_CHECK(strstr(no.reason, "finite") != NULL);
  /* A model that does not take the effect, one that there is not, a motion beyond doubles. */
  ROT_CHECK_EQ_INT(
      run_one(wheel, "axle_linear", "resistance$coulomb_n_m", 0.1, 1, &end, value, &no),
      ROT_ROW_NO_MODEL);
  ROT_CHECK_EQ_INT(
      run_one(wheel, "axle_linear", "resistance$coulomb_n_m", 0.0, 1, &end, value, &no), ROT_OK);
  ROT_CHECK_EQ_INT(run_one(wheel, "axle_lineal", "omega0_rad_per_s", 1.0, 1, &end, value, &no),
                   ROT_ROW_NO_MODEL);
  ROT_CHECK_EQ_INT(run_one(wheel, "axle_linear", "omega0_rad_per_s", 1e308, 1, &end, value, &no),
                   ROT_ERANGE);
  /* Angular momentum and energy overflow where the state does not. */
  ROT_CHECK_EQ_INT(run_one(wheel, "axle_linear", "omega0_rad_per_s", 1e200, 1, &end, value, &no),
                   ROT_ERANGE);
  ROT_CHECK_EQ_INT(run_one(wheel, "axle_linear", "omega0_rad_per_s", 1e100, 1, &end, value, &no),
                   ROT_OK);
  rot_object_free(wheel);
}

/* A closed form whose run tells why it fails (rot_constraint.run_tells). */
static void told_by_the_run(void) {
  static const double end = 2.0;
  static const char *const outputs[] = {"final_qw"}, *const inputs[] = {"body[1]", "body[3]"};
  static const double moments[] = {1.0, 1.0, 1.5}, omega[] = {1.0, 0.1, 3.0};
  rot_object *scene = of("scene_free");
  puts_of(scene, "body", 3, moments);
  puts_of(scene, "omega0_rad_per_s", 3, omega);
  const rot_row_plan plan = {scene, 2, inputs, 1, &end, "free_exact", 0, 1e-9, 1e6, 1, outputs};
  rot_rows_worker *w;
  rot_refusal no;
  double value, error;
  ROT_CHECK(rot_rows_open(&plan, &w, &no) == ROT_OK);
  /* Moments too far apart: the same words as by rot_choice_judge(). */
  ROT_CHECK_EQ_INT(rot_rows_run(w, (const double[]){1e-200, 1.0}, &value, &error, NULL, &no),
                   ROT_ROW_NO_MODEL);
  ROT_CHECK(isnan(value));
  ROT_CHECK_EQ_INT(rot_rows_run(w, (const double[]){1.5, 1.2}, &value, &error, NULL, &no), ROT_OK);
  puts_of(scene, "body", 3, (const double[]){1e-200, 1.0, 1.0});
  kit_run r = kit_run_of(scene, "free_exact", 1e-9, 1, &end);
  rot_candidate judged;
  const rot_query query = {1, &end, 1e-9, 0.0};
  rot_choice_judge(r.constraint, rot_choice_model(r.constraint, "free_exact"), r.scene, &query,
                   &judged);
  ROT_CHECK(r.end == ROT_RUN_NO_MODEL && !r.out.model && r.out.picked.why_not && !judged.applies);
  ROT_CHECK(judged.why_not == r.out.picked.why_not && r.out.info.status == ROT_OK);
  ROT_CHECK(r.out.events.count == 0 && !r.out.picked.applies && isfinite(judged.cost_s));
  kit_free(&r);
  rot_rows_close(w);
  rot_object_free(scene);
}

/* An element of an attitude that is not given: the others are those of (1, 0, 0, 0). */
static void default_attitude(void) {
  static const double x[] = {0.25, 2.0, 1.0}, end = 2.0, times[] = {0.0, 2.0};
  static const char *const input = "attitude0[2]", *const output = "final_qw";
  rot_object *box = make_box(x);
  const rot_row_plan plan = {box, 1, &input, 1, &end, "free_exact", 0, 1e-9, 1e6, 1, &output};
  rot_rows_worker *w;
  rot_refusal no;
  double value, error;
  const double turned = 0.7;
  ROT_CHECK(rot_rows_open(&plan, &w, &no) == ROT_OK);
  ROT_CHECK_EQ_INT(rot_rows_run(w, &turned, &value, &error, NULL, NULL), ROT_OK);
  puts_of(box, "attitude0", 4, (const double[]){1.0, turned, 0.0, 0.0});
  kit_run r = kit_run_of(box, "free_exact", 1e-9, 2, times);
  ROT_CHECK(same_bits(value, kit_cell(&r, 0, 1, 0)) && same_bits(error, r.out.error));
  kit_free(&r);
  rot_rows_close(w);
  rot_object_free(box);
}

/* Plans that are refused: the place of what is wrong. */
static void refused_plans(void) {
  static const double x[] = {2.0, 0.03, 1.0}, end = 2.0;
  rot_object *wheel = make_wheel(x), *body = disk(1.0, 1.0);
  static const char *const good[] = {"time_s", "omega0_rad_per_s"};
  static const char *const bad[] = {"omega0_rad_per_s", "time_s", "body$mass"};
  static const char *const outputs[] = {"final_theta_rad", "final_phi_rad"};
  rot_row_plan plan = {wheel, 2, good, 1, &end, NULL, 0, 1e-9, 1e6, 1, outputs};
  rot_rows_worker *w = NULL;
  rot_refusal no;
  ROT_CHECK(rot_rows_open(&plan, &w, &no) == ROT_OK);
  rot_rows_close(w);
  plan.n_outputs = 2;
  ROT_CHECK(rot_rows_open(&plan, &w, &no) == ROT_EVALUE && !w && no.input == 3);
  ROT_CHECK(strstr(no.reason, "final_phi_rad") != NULL);
  plan.n_outputs = 1;
  plan.n_inputs = 3;
  plan.inputs = bad;
  ROT_CHECK(rot_rows_open(&plan, &w, &no) == ROT_EVALUE && no.input == 2);
  plan.n_inputs = 0;
  plan.scene = body;
  ROT_CHECK(rot_rows_open(&plan, &w, &no) == ROT_EVALUE && no.input == 0);
  plan.scene = NULL;
  ROT_CHECK(rot_rows_open(&plan, &w, &no) == ROT_EVALUE);
  /* The scene itself is refused. */
  rot_object *empty = of("scene_axle");
  plan.scene = empty;
  plan.n_inputs = 2;
  plan.inputs = good;
  ROT_CHECK(rot_rows_open(&plan, &w, &no) == ROT_EVALUE && no.input == 3);
  rot_rows_close(NULL);
  rot_object_free(empty);
  rot_object_free(body);
  rot_object_free(wheel);
}

/* ---- one model for all ----------------------------------------------------------------------- */

/* Of the models that take the most rows, the cheapest. */
static void model_of_all(void) {
  static const double x[] = {2.0, 0.03, 1.0}, end = 2.0;
  static const char *const input[] = {"resistance$coulomb_n_m"};
  rot_object *wheel = make_wheel(x);
  const rot_row_plan plan = {wheel, 1, input, 1, &end, NULL, 0, 1e-9, 1e6, 1, plain};
  rot_rows_worker *w;
  rot_refusal no;
  size_t taken;
  ROT_CHECK(rot_rows_open(&plan, &w, &no) == ROT_OK);
  const double none[] = {0.0, 0.0, 0.0}, some[] = {0.0, 0.1, 0.0}, wrong[] = {0.0, 0.1, -1.0};
  const double *column = none;
  const rot_model *best = rot_rows_model(w, 3, &column, &taken);
  ROT_CHECK(best && !strcmp(best->id, "axle_linear") && taken == 3);
  column = some;
  best = rot_rows_model(w, 3, &column, &taken);
  ROT_CHECK(best && !strcmp(best->id, "axle_drag") && taken == 3);
  column = wrong;
  best = rot_rows_model(w, 3, &column, &taken);
  ROT_CHECK(best && !strcmp(best->id, "axle_drag") && taken == 2);
  column = wrong + 2;
  ROT_CHECK(!rot_rows_model(w, 1, &column, &taken) && taken == 0);
  rot_rows_close(w);
  rot_object_free(wheel);
}

static void names_of_status(void) {
  ROT_CHECK(!strcmp(rot_row_status_name(ROT_OK), "ok"));
  ROT_CHECK(!strcmp(rot_row_status_name(ROT_EVALUE), "value"));
  ROT_CHECK(!strcmp(rot_row_status_name(ROT_ROW_NO_MODEL), "model"));
  ROT_CHECK(!strcmp(rot_row_status_name(ROT_ROW_COUNT), "count"));
  ROT_CHECK(!rot_row_status_name(-1) && !rot_row_status_name(ROT_ROW_STATUS_COUNT));
}

int main(void) {
  named_models();
  chosen_models();
  last_times();
  backwards();
  refused_rows();
  told_by_the_run();
  default_attitude();
  refused_plans();
  model_of_all();
  names_of_status();
  return rot_test_report("rows");
}
