/* Rows of a sweep by rotdyn's C core, without R: where a scene ends, its two last columns. HOW is
 * "WAY MODEL"; FILE has a number in [0, 1) for each row.
 *
 *   core MODEL   rot_rows_run(): numbers set, scene built, model run, outputs taken
 *   own MODEL    the model's own run, of scenes built before
 *   build MODEL  the numbers set and the scene built, alone
 *   pair MODEL   the same, and the model's own run of it
 *   1 MODEL      rot_block_run() of a Sobol design of as many rows, one thread
 *   2 MODEL      the same, two threads
 *   sobol plain | scrambled   rows of two columns of Sobol's sequence, from row 2^39 on
 *   sobol one                 the same, scrambled, each row by itself, spread over 2^40 rows */
#include <math.h>

#include "child.h"
#include "design/sobol.h"
#include "sweep/block.h"

/* Two numbers that vary, in orders of their own. */
typedef struct example {
  const char *model;
  rot_object *(*make)(void);
  const char *input[2], *output[2];
  double low[2], high[2], end_s;
} example;

static rot_object *object(const char *constructor) {
  rot_object *made = rot_object_new(constructor);
  if (!made) exit(EXIT_FAILURE);
  return made;
}

/* Adds a part and frees it. */
static void add_part(rot_object *to, const char *input, rot_object *part) {
  rot_object_part(to, input, part);
  rot_object_free(part);
}

static rot_object *make_incline(void) {
  rot_object *scene = object("scene_incline"), *ball = object("body_sphere");
  rot_object_number(ball, "mass_kg", 1.0);
  rot_object_number(ball, "radius_m", 0.1);
  add_part(scene, "body", ball);
  rot_object_number(scene, "incline_angle_deg", 20.0);
  rot_object_number(scene, "static_friction", 0.1);
  return scene;
}

static rot_object *make_wheel(int dry) {
  rot_object *scene = object("scene_axle"), *disk = object("body_disk"),
             *loss = object("resistance");
  rot_object_number(disk, "mass_kg", 2.0);
  rot_object_number(disk, "radius_m", 0.25);
  rot_object_number(loss, "viscous_n_m_s", 0.03);
  if (dry) rot_object_number(loss, "coulomb_n_m", 0.05);
  add_part(scene, "body", disk);
  add_part(scene, "resistance", loss);
  if (dry)
    rot_object_number(scene, "omega0_rad_per_s", 2.0);
  else
    rot_object_number(scene, "torque", 0.8);
  return scene;
}

static rot_object *make_linear(void) { return make_wheel(0); }
static rot_object *make_dry(void) { return make_wheel(1); }

static rot_object *make_box(void) {
  static const double omega[] = {1.0, 2.0, 3.0};
  rot_object *scene = object("scene_free"), *box = object("body_box");
  rot_object_number(box, "mass_kg", 2.0);
  rot_object_number(box, "length_m", 0.25);
  rot_object_number(box, "width_m", 0.35);
  rot_object_number(box, "height_m", 0.45);
  add_part(scene, "body", box);
  rot_object_numbers(scene, "omega0_rad_per_s", 3, omega);
  return scene;
}

static const example examples[] = {
    {"incline_exact",
     make_incline,
     {"body$radius_m", "incline_angle_deg"},
     {"final_x_m", "final_v_m_per_s"},
     {0.1, 10.0},
     {0.2, 30.0},
     2.0},
    {"axle_linear",
     make_linear,
     {"body$mass_kg", "resistance$viscous_n_m_s"},
     {"final_theta_rad", "final_omega_rad_per_s"},
     {1.0, 0.01},
     {3.0, 0.05},
     2.0},
    {"axle_drag",
     make_dry,
     {"body$mass_kg", "resistance$coulomb_n_m"},
     {"final_theta_rad", "final_omega_rad_per_s"},
     {1.0, 0.01},
     {3.0, 0.1},
     2.0},
    {"free_exact",
     make_box,
     {"body$mass_kg", "omega0_rad_per_s[2]"},
     {"final_qw", "final_omega_x_rad_per_s"},
     {1.0, 2.0},
     {3.0, 3.0},
     2.0},
};
enum { EXAMPLES = sizeof examples / sizeof *examples };

/* What a program needs of its example; made by the first call. */
typedef struct bench {
  const example *of;
  const rot_constraint *constraint;
  const rot_model_run *run;
  rot_row_plan plan;
  rot_rows_worker *worker;
  rot_variants *variants;
  char *scene; /* n of them, built before */
  void *column[ROT_MAX_COLUMNS];
  size_t at[2]; /* of the outputs */
} bench;

static void inputs_of(const example *of, double u, double input[2]) {
  const double v = 1000.0 * u;
  input[0] = of->low[0] + (of->high[0] - of->low[0]) * u;
  input[1] = of->low[1] + (of->high[1] - of->low[1]) * (v - floor(v));
}

static const void *built(bench *b, double u) {
  rot_refusal no;
  const void *scene;
  double input[2];
  inputs_of(b->of, u, input);
  rot_variants_set(b->variants, 0, input[0]);
  rot_variants_set(b->variants, 1, input[1]);
  if (rot_variants_build(b->variants, &scene, &no) != ROT_OK) exit(EXIT_FAILURE);
  return scene;
}

static int open_bench(bench *b, const char *model, const solution *s) {
  rot_refusal no;
  for (size_t i = 0; i < EXAMPLES; i++) {
    if (!strcmp(examples[i].model, model)) b->of = &examples[i];
  }
  if (!b->of) return 0;
  rot_object *scene = b->of->make();
  b->constraint = scene->constraint;
  const size_t size = b->constraint->scene_size;
  b->plan = (rot_row_plan){.scene = scene,
                           .n_inputs = 2,
                           .inputs = b->of->input,
                           .n_times = 1,
                           .time_s = &b->of->end_s,
                           .model = model,
                           .accuracy = 1e-9,
                           .max_steps = 1e6,
                           .n_outputs = 2,
                           .outputs = b->of->output};
  b->run = &b->constraint->runs[rot_choice_model(b->constraint, model) - b->constraint->models];
  if (rot_rows_open(&b->plan, &b->worker, &no) != ROT_OK ||
      rot_variants_new(scene, 2, b->of->input, &b->variants, &no) != ROT_OK) {
    return 0;
  }
  b->scene = malloc(s->n * size);
  double *columns = calloc(2 * ROT_MAX_COLUMNS, sizeof *columns);
  if (!b->scene || !columns) return 0;
  for (size_t i = 0; i < ROT_MAX_COLUMNS; i++) b->column[i] = columns + 2 * i;
  for (int k = 0; k < 2; k++) {
    b->at[k] = rot_run_column(b->constraint, b->of->output[k] + strlen("final_"));
  }
  /* What a scene points to is the same in all rows. */
  for (int twice = 0; twice < 2; twice++) {
    for (size_t i = 0; i < s->n; i++) memcpy(b->scene + i * size, built(b, s->time_s[i]), size);
  }
  return 1;
}

/* A built scene => its last two columns, by the model alone. */
static int run_own(const bench *b, const void *scene, double output[2]) {
  const double time_s[] = {b->constraint->start_s(scene), b->of->end_s};
  const rot_task task = {.n = 2, .time_s = time_s, .accuracy = 1e-9, .max_steps = 1000000};
  rot_events events = {0};
  rot_info info;
  const rot_rows rows = {.column = b->column, .events = &events};
  const rot_status status = b->run->run(scene, &task, b->run->method, &rows, NULL, &info);
  for (int k = 0; k < 2; k++) output[k] = ((const double *)b->column[b->at[k]])[1];
  rot_events_free(&events);
  return status != ROT_OK;
}

/* A block of rows of a Sobol design. */
static int run_block(const bench *b, solution *s, int threads) {
  static const size_t bound[] = {0, 1};
  static rot_vary law[2];
  static rot_sweep sweep;
  static rot_block block;
  static double *column[4];
  rot_store store = {0};
  rot_refusal no;
  rot_info info;
  if (!block.status) {
    for (int k = 0; k < 2; k++) {
      law[k] = (rot_vary){.kind = ROT_VARY_UNIFORM, .low = -HUGE_VAL, .high = HUGE_VAL};
      law[k].p[0] = b->of->low[k];
      law[k].p[1] = b->of->high[k];
    }
    sweep.plan = b->plan;
    sweep.bound = bound;
    sweep.design = (rot_design){.kind = ROT_DESIGN_SOBOL,
                                .points = s->n,
                                .n_inputs = 2,
                                .input = law,
                                .seeded = 1,
                                .seed = 1};
    if (rot_design_begin(&sweep.design, &store) != ROT_OK) return 1;
    for (int k = 0; k < 4; k++) column[k] = malloc(s->n * sizeof(double));
    block =
        (rot_block){column, column + 2, malloc(s->n * sizeof(int)), malloc(s->n * sizeof(double))};
  }
  sweep.threads = threads;
  const rot_status status = rot_block_run(&sweep, 0, s->n, &block, NULL, &info, &no);
  memcpy(s->theta_rad, column[2], s->n * sizeof(double));
  memcpy(s->omega_rad_per_s, column[3], s->n * sizeof(double));
  s->rhs_calls = 0;
  return status != ROT_OK;
}

static int run_sobol(const char *how, solution *s) {
  static rot_sobol x[2];
  static int ready;
  const uint64_t seed = 1, far = (uint64_t)1 << 39;
  if (!ready) {
    for (size_t k = 0; k < 2; k++) rot_sobol_begin(&x[k], k, strcmp(how, "plain") ? &seed : NULL);
    ready = 1;
  }
  if (!strcmp(how, "one")) {
    for (size_t i = 0; i < s->n; i++) {
      const uint64_t row = (uint64_t)i * (2 * far / s->n) + 1;
      rot_sobol_column(&x[0], row, 1, s->theta_rad + i);
      rot_sobol_column(&x[1], row, 1, s->omega_rad_per_s + i);
    }
  } else {
    rot_sobol_column(&x[0], far, s->n, s->theta_rad);
    rot_sobol_column(&x[1], far, s->n, s->omega_rad_per_s);
  }
  s->rhs_calls = 0;
  return 0;
}

static int solve(const char *how, solution *s) {
  static bench b;
  if (!strncmp(how, "sobol ", 6)) return run_sobol(how + 6, s);
  const char *model = strchr(how, ' ');
  int failed = 0;
  if (!model || (!b.scene && !open_bench(&b, model + 1, s))) return 1;
  if (how[0] == '1' || how[0] == '2') return run_block(&b, s, how[0] - '0');
  for (size_t i = 0; i < s->n; i++) {
    double input[2], output[2] = {0.0}, error;
    if (how[0] == 'c') {
      inputs_of(b.of, s->time_s[i], input);
      failed |= rot_rows_run(b.worker, input, output, &error, NULL, NULL);
    } else if (how[0] == 'o') {
      failed |= run_own(&b, b.scene + i * b.constraint->scene_size, output);
    } else if (how[0] == 'p') {
      failed |= run_own(&b, built(&b, s->time_s[i]), output);
    } else {
      output[0] = *(const double *)built(&b, s->time_s[i]);
    }
    s->theta_rad[i] = output[0];
    s->omega_rad_per_s[i] = output[1];
  }
  s->rhs_calls = 0;
  return failed;
}

int main(int argc, char **argv) { return child_main(argc, argv, solve); }
