/* Rows by batch kernels against the same rows by themselves: states within both error figures,
 * statuses, defaults that follow from what varies, extremes, plans that no kernel takes. */
#include "sweep/table.h"

#include "sweep/block.h"
#include "sweep/outputs.h"
#include "sweep_kit.h"

enum { ROWS = 600, MAX_INPUTS = 4, MAX_OUTPUTS = 12 };

static rot_object *wheel(void) {
  static const double time_s[] = {0.0, 0.5, 1.5, 3.0}, torque[] = {0.5, 0.8, -1.0, 0.2};
  rot_object *scene = of("scene_axle"), *knots = of("torque_knots");
  puts_of(knots, "time_s", 4, time_s);
  puts_of(knots, "torque_n_m", 4, torque);
  put(scene, "body", 0.0625);
  part(scene, "torque", knots);
  part(scene, "resistance", loss(0.03, 0.0, 0.0));
  put(scene, "theta0_rad", 0.25);
  return scene;
}

/* A skater draws in the arms. */
static rot_object *skater(void) {
  static const double time_s[] = {0.0, 1.0, 2.0}, inertia[] = {3.0, 1.0, 1.0};
  rot_object *scene = of("scene_axle"), *knots = of("inertia_knots");
  puts_of(knots, "time_s", 3, time_s);
  puts_of(knots, "moment_of_inertia_kg_m2", 3, inertia);
  part(scene, "body", knots);
  put(scene, "omega0_rad_per_s", 2.0);
  return scene;
}

static rot_object *slope(void) {
  rot_object *scene = of("scene_incline");
  part(scene, "body", disk(2.0, 0.1));
  put(scene, "incline_angle_deg", 20.0);
  put(scene, "static_friction", 0.4);
  return scene;
}

static rot_object *spinning_slope(void) {
  rot_object *scene = slope();
  put(scene, "kinetic_friction", 0.1);
  put(scene, "omega0_rad_per_s", 3.0);
  return scene;
}

static rot_object *brick(void) {
  static const double moment[] = {1.0, 2.0, 3.0}, omega[] = {0.1, 1.0, 0.2};
  static const double attitude[] = {0.6, 0.0, 0.8, 0.0};
  rot_object *scene = of("scene_free");
  puts_of(scene, "body", 3, moment);
  puts_of(scene, "omega0_rad_per_s", 3, omega);
  puts_of(scene, "attitude0", 4, attitude);
  return scene;
}

typedef struct kernel_case {
  rot_object *(*make)(void);
  const char *model;
  double end_s;
  const char *input[MAX_INPUTS + 1];
  double low[MAX_INPUTS], high[MAX_INPUTS];
} kernel_case;

static const kernel_case cases[] = {
    {wheel,
     "axle_linear",
     4.0,
     {"body", "resistance$viscous_n_m_s", "omega0_rad_per_s", "theta0_rad", NULL},
     {-0.01, -0.05, -3.0, -1.0},
     {0.5, 1.0, 3.0, 1.0}},
    {wheel, "axle_linear", 4.0, {"time_s", "body", NULL}, {-0.5, 1e-3}, {9.0, 2.0}},
    {slope,
     "incline_exact",
     2.0,
     {"incline_angle_deg", "static_friction", "v0_m_per_s", NULL},
     {-93.0, -0.05, -2.0},
     {93.0, 1.0, 2.0}},
    {slope, "incline_exact", 2.0, {"rolling_arm_m", "time_s", NULL}, {-0.001, -0.2}, {0.01, 5.0}},
    {spinning_slope,
     "incline_exact",
     2.0,
     {"static_friction", "kinetic_friction", "v0_m_per_s", "omega0_rad_per_s", NULL},
     {0.3, -0.02, -2.0, -9.0},
     {0.5, 0.32, 2.0, 9.0}},
    {brick,
     "free_exact",
     60.0,
     {"body[1]", "body[3]", "omega0_rad_per_s[1]", "omega0_rad_per_s[3]", NULL},
     {-0.1, 0.5, -1.0, -1.0},
     {3.0, 4.0, 1.0, 1.0}},
    {brick, "free_exact", 60.0, {"omega0_rad_per_s[2]", "time_s", NULL}, {-1.0, -1.0}, {1.0, 1e3}},
    /* A moment of 0 is among them, and a body without moments. */
    {brick,
     "free_exact",
     60.0,
     {"body[1]", "body[2]", "body[3]", "omega0_rad_per_s[1]", NULL},
     {0.0, 0.0, 0.0, 0.0},
     {1.0, 1.0, 1.0, 1.0}},
    {brick, "free_exact", 60.0, {"omega0_rad_per_s[3]", "body[1]", NULL}, {-1.0, 0.0}, {1.0, 4.0}},
    {brick, "free_exact", 60.0, {"omega0_rad_per_s[3]", "body[2]", NULL}, {-1.0, 0.0}, {1.0, 3.5}},
};
enum { CASES = sizeof cases / sizeof *cases };

/* Columns of the measures, and their places among them. */
typedef struct states {
  size_t n;
  char name[MAX_OUTPUTS][64];
  const char *output[MAX_OUTPUTS];
  size_t measure[MAX_OUTPUTS];
} states;

static void states_of(const rot_constraint *c, const char *prefix, states *to) {
  to->n = 0;
  for (size_t i = 0; i < c->n_columns && to->n < MAX_OUTPUTS; i++) {
    if (!c->columns[i].measure) continue;
    (void)snprintf(to->name[to->n], 64, "%s%s", prefix, c->columns[i].name);
    to->output[to->n] = to->name[to->n];
    to->measure[to->n++] = c->columns[i].measure - 1;
  }
}

static double number(const kernel_case *c, size_t k, size_t i) {
  static const double step[] = {0.6180339887498949, 0.7548776662466927, 0.5698402909980532,
                                0.4301597090019467};
  const double u = (double)(i + 1) * step[k];
  if (i % 97 == 96) return k == 0 ? NAN : c->high[k];
  if (i % 89 == 88) return k == 0 ? INFINITY : c->low[k];
  if (i % 83 == 82) return c->low[k];
  return c->low[k] + (c->high[k] - c->low[k]) * (u - floor(u));
}

static double in[MAX_INPUTS][ROWS], out[MAX_OUTPUTS][ROWS], error[ROWS];
static int status[ROWS];

static void by_kernel(rot_table *table, size_t n_inputs, size_t n_outputs) {
  const double *input[MAX_INPUTS];
  double *output[MAX_OUTPUTS];
  for (size_t k = 0; k < n_inputs; k++) input[k] = in[k];
  for (size_t k = 0; k < n_outputs; k++) output[k] = out[k];
  for (size_t first = 0; first < ROWS; first += ROT_BATCH_ROWS) {
    const size_t n = ROWS - first < ROT_BATCH_ROWS ? ROWS - first : ROT_BATCH_ROWS;
    ROT_CHECK(rot_table_run(table, first, n, input, output, error + first, status + first) ==
              ROT_OK);
  }
}

static double larger(double a, double b) { return a > b ? a : b; }

/* The states of a row agree within the sum of both figures of the largest of each measure. */
static int agrees(const states *s, size_t row, const double value[], const double size[],
                  double allowed) {
  double largest[8] = {0.0};
  for (size_t k = 0; k < s->n; k++) {
    largest[s->measure[k]] = larger(largest[s->measure[k]], larger(fabs(size[k]), fabs(value[k])));
  }
  for (size_t k = 0; k < s->n; k++) {
    /* Lengths of vectors: at most sqrt(3) times their largest component; attitudes as angles. */
    const double scale = strncmp(s->name[k], "final_q", 7) ? 1.8 * largest[s->measure[k]] : 1.0;
    if (!(fabs(out[k][row] - value[k]) <= allowed * scale)) return 0;
  }
  return 1;
}

static void compare(const kernel_case *c) {
  static const double middle[] = {0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9};
  rot_object *scene = c->make();
  size_t n_inputs = 0, left = 0, wrong = 0, refused = 0, bad = 0, checked = 0;
  while (c->input[n_inputs]) n_inputs++;
  states last, max;
  states_of(scene->constraint, "final_", &last);
  states_of(scene->constraint, "max_abs_", &max);
  rot_row_plan plan = {scene, n_inputs, c->input, 1,      &c->end_s,  c->model,
                       0,     1e-9,     1e6,      last.n, last.output};
  rot_table *table;
  rot_rows_worker *worker, *sizes;
  rot_refusal no;
  ROT_CHECK(rot_table_open(&plan, &table) == ROT_OK && table);
  ROT_CHECK(rot_rows_open(&plan, &worker, &no) == ROT_OK);
  /* More times, for the largest values; those beyond a time that varies are left out. */
  double times[10];
  for (int i = 0; i < 9; i++) times[i] = middle[i] * c->end_s;
  times[9] = c->end_s;
  rot_row_plan more = plan;
  more.n_times = 10;
  more.time_s = times;
  more.outputs = max.output;
  ROT_CHECK(rot_rows_open(&more, &sizes, &no) == ROT_OK);
  for (size_t i = 0; i < ROWS; i++) {
    for (size_t k = 0; k < n_inputs; k++) in[k][i] = number(c, k, i);
  }
  if (table) by_kernel(table, n_inputs, last.n);
  for (size_t i = 0; i < ROWS; i++) {
    double x[MAX_INPUTS], value[MAX_OUTPUTS], size[MAX_OUTPUTS], figure, other;
    for (size_t k = 0; k < n_inputs; k++) x[k] = in[k][i];
    const int own = rot_rows_run(worker, x, value, &figure, NULL, NULL);
    refused += own != ROT_OK;
    left += status[i] == ROT_TABLE_LEFT;
    if (status[i] == ROT_TABLE_LEFT) continue;
    wrong += own != ROT_OK || status[i] != ROT_OK;
    if (own != ROT_OK || rot_rows_run(sizes, x, size, &other, NULL, NULL) != ROT_OK) continue;
    checked++;
    bad += !agrees(&last, i, value, size, error[i] + figure);
  }
  ROT_CHECK_EQ_INT(wrong, 0); /* nothing that the constructor refuses comes out */
  ROT_CHECK_EQ_INT(bad, 0);
  ROT_CHECK(refused > 0 && left >= refused && left < ROWS / 4 && checked > ROWS / 2);
  rot_rows_close(sizes);
  rot_rows_close(worker);
  rot_table_close(table);
  rot_object_free(scene);
}

/* Extremes at the two times, and the error figure, from the states. */
static void extremes(void) {
  static const char *const input[] = {"omega0_rad_per_s"};
  static const char *const output[] = {"final_omega_rad_per_s", "max_omega_rad_per_s",
                                       "min_omega_rad_per_s", "max_abs_omega_rad_per_s", "error"};
  static const double end_s[] = {4.0, 0.0};
  rot_object *scene = wheel();
  for (int k = 0; k < 2; k++) {
    const rot_row_plan plan = {scene, 1,    input, 1, &end_s[k], "axle_linear",
                               0,     1e-9, 1e6,   5, output};
    rot_table *table;
    size_t differ = 0;
    ROT_CHECK(rot_table_open(&plan, &table) == ROT_OK && table);
    for (size_t i = 0; i < ROWS; i++) in[0][i] = -30.0 + 0.1 * (double)i;
    if (table) by_kernel(table, 1, 5);
    for (size_t i = 0; i < ROWS; i++) {
      const double start = in[0][i], end = out[0][i];
      differ += status[i] != ROT_OK || out[4][i] != error[i];
      differ += out[1][i] != larger(start, end) || out[2][i] != -larger(-start, -end);
      differ += out[3][i] != larger(fabs(start), fabs(end));
      if (k == 1) differ += !same_bits(start, end);
    }
    ROT_CHECK_EQ_INT(differ, 0);
    rot_table_close(table);
  }
  rot_object_free(scene);
}

/* A plan that a kernel takes, with one thing changed in each of the others. */
static void plans_without_kernel(void) {
  static const char *const input[] = {"omega0_rad_per_s"}, *const mass[] = {"body$mass_kg"};
  static const char *const twice[] = {"omega0_rad_per_s", "time_s", "torque$torque_n_m[2]"};
  static const char *const output[] = {"final_theta_rad"}, *const steps[] = {"steps"};
  static const char *const speed[] = {"final_kinetic_energy_j"};
  static const double times[] = {1.0, 2.0};
  static const double x[] = {1.0, 0.0, 3.0};
  rot_object *scene = wheel(), *dry = make_dry(x), *disks = make_wheel(x), *box = make_box(x);
  rot_object *drawn_in = skater();
  const rot_row_plan good = {scene, 1, input, 1, times, "axle_linear", 0, 1e-9, 1e6, 1, output};
  rot_row_plan plan[] = {good, good, good, good, good, good, good, good, good, good};
  plan[1].n_times = 2;
  plan[2].model = NULL;
  plan[3].model = "axle_drag";
  plan[4].outputs = steps;
  plan[5].outputs = speed;
  plan[6].n_inputs = 3, plan[6].inputs = twice;
  plan[7].scene = dry;
  plan[8].scene = disks, plan[8].inputs = mass;
  plan[9].scene = drawn_in;
  rot_table *table;
  for (size_t i = 0; i < sizeof plan / sizeof *plan; i++) {
    ROT_CHECK(rot_table_open(&plan[i], &table) == ROT_OK && (table != NULL) == (i == 0));
    rot_table_close(table);
  }
  /* Attitudes that vary are the model's. */
  static const char *const attitude[] = {"attitude0[1]"}, *const q[] = {"final_qw"};
  const rot_row_plan turned = {box, 1, attitude, 1, times, "free_exact", 0, 1e-9, 1e6, 1, q};
  ROT_CHECK(rot_table_open(&turned, &table) == ROT_OK && !table);
  /* The kernel of tumbling begins at 0 s. */
  static const char *const spin[] = {"omega0_rad_per_s[1]"};
  for (int late = 0; late < 2; late++) {
    rot_object *body = brick();
    if (late) put(body, "start_s", 0.5);
    const rot_row_plan exact = {body, 1, spin, 1, times, "free_exact", 0, 1e-9, 1e6, 1, q};
    ROT_CHECK(rot_table_open(&exact, &table) == ROT_OK && (table == NULL) == late);
    rot_table_close(table);
    rot_object_free(body);
  }
  rot_object_free(scene);
  rot_object_free(dry);
  rot_object_free(disks);
  rot_object_free(drawn_in);
  rot_object_free(box);
}

/* Rows of a block do not depend on parts and threads; those that the kernel leaves are there. */
static void blocks(void) {
  enum { N = 3000 };
  static const char *const input[] = {"body", "omega0_rad_per_s"};
  static const char *const output[] = {"final_theta_rad", "final_omega_rad_per_s"};
  static const size_t bound[] = {0, 1}, parts[] = {1, 100, 256, 1000, 8192};
  static const double end_s = 4.0;
  static double number[2][5][N];
  static int found[2][N];
  rot_object *scene = wheel();
  rot_vary law[2];
  rot_sweep s = {.bound = bound, .threads = 1, .table = 1};
  rot_store store = {0};
  for (int k = 0; k < 2; k++) {
    law[k] = (rot_vary){.kind = ROT_VARY_UNIFORM, .low = -HUGE_VAL, .high = HUGE_VAL};
    law[k].p[0] = k ? -3.0 : -0.01; /* moments of inertia below 0 are refused */
    law[k].p[1] = 3.0;
  }
  s.plan = (rot_row_plan){scene, 2, input, 1, &end_s, "axle_linear", 0, 1e-9, 1e6, 2, output};
  s.design = (rot_design){
      .kind = ROT_DESIGN_RANDOM, .points = N, .n_inputs = 2, .input = law, .seeded = 1, .seed = 7};
  ROT_CHECK(rot_design_begin(&s.design, &store) == ROT_OK);
  for (size_t p = 0; p < 2 * sizeof parts / sizeof *parts; p++) {
    const int at = p > 0;
    double *column[4] = {number[at][0], number[at][1], number[at][2], number[at][3]};
    const rot_block block = {column, column + 2, found[at], number[at][4]};
    rot_info info;
    rot_refusal no;
    s.part = parts[p / 2];
    s.threads = 1 + (int)(p % 2);
    ROT_CHECK(rot_block_run(&s, 0, N, &block, NULL, &info, &no) == ROT_OK);
    if (!at) continue;
    ROT_CHECK(memcmp(number[0], number[1], sizeof number[0]) == 0);
    ROT_CHECK(memcmp(found[0], found[1], sizeof found[0]) == 0);
  }
  size_t refused = 0;
  for (size_t i = 0; i < N; i++) {
    refused += found[0][i] != ROT_OK;
    if (found[0][i] != ROT_OK) ROT_CHECK(found[0][i] == ROT_EVALUE && isnan(number[0][2][i]));
  }
  ROT_CHECK(refused > 2 && refused < 40); /* 0.01 of 3.01 */
  rot_store_free(&store);
  rot_object_free(scene);
}

int main(void) {
  for (size_t i = 0; i < CASES; i++) compare(&cases[i]);
  extremes();
  plans_without_kernel();
  blocks();
  return rot_test_report("table");
}
