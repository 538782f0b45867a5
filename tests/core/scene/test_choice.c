/* The choice of a model: effects, reasons, order by cost, trials, what is dropped, words. */
#include "axle_friction.h"
#include "scene/axle/models.h"
#include "scene/choice.h"
#include "scene/clutch/clutch.h"
#include "scene/clutch/models.h"
#include "scene/incline/models.h"
#include "scene/incline/ode.h"
#include "scene/shaft/shaft.h"
#include "scene/shaft/models.h"

static char text[512];

static const char *reason(const rot_constraint *constraint, const rot_candidate *c) {
  rot_choice_reason(constraint, c, sizeof text, text);
  return text;
}

static rot_query query(size_t n, const double time_s[], double accuracy) {
  const rot_query q = {n, time_s, accuracy, 1e-6};
  return q;
}

/* ---- every constraint ------------------------------------------------------------------------ */

static void check_lists(void) {
  size_t n;
  const rot_constraint *const *list = rot_choice_constraints(&n);
  for (size_t i = 0; i < n; i++) {
    const rot_constraint *c = list[i];
    ROT_CHECK(rot_choice_constraint(c->id) == c);
    ROT_CHECK(c->n_effects <= ROT_MAX_EFFECTS && c->n_models <= ROT_MAX_MODELS);
    for (size_t k = 0; k < c->n_effects; k++) {
      ROT_CHECK(*c->effects[k].name && *c->effects[k].words);
      for (size_t j = 0; j < k; j++) ROT_CHECK(strcmp(c->effects[k].name, c->effects[j].name));
    }
    for (size_t k = 0; k < c->n_models; k++) {
      const rot_model *m = &c->models[k];
      ROT_CHECK(rot_choice_model(c, m->id) == m && *m->why && m->promise > 0.0);
      ROT_CHECK(!(m->takes >> c->n_effects));
    }
  }
  ROT_CHECK(!rot_choice_constraint("none") && !rot_choice_model(list[0], "none"));
  /* A name of two constraints is two effects. */
  ROT_CHECK(!strcmp(rot_axle_constraint.effects[ROT_AXLE_INDEX_SPRING].name,
                    rot_shaft_constraint.effects[1].name));
  rot_choice_effects(&rot_shaft_constraint, 2u, sizeof text, text);
  ROT_CHECK(!strcmp(text, "springs between neighbours"));
}

/* ---- a constraint of its own ----------------------------------------------------------------- */

/* The scene: effects, costs of the models, a bound on what is dropped. */
typedef struct toy {
  unsigned effects;
  double cost_s[5], bound;
} toy;

static unsigned toy_effects(const void *scene) { return ((const toy *)scene)->effects; }

static const char *toy_why_not(const void *scene, const rot_query *q) {
  (void)q;
  return ((const toy *)scene)->effects == 3u ? "not the two" : NULL;
}

static double toy_cost(const rot_model *model, const void *scene, const rot_query *q) {
  (void)q;
  return ((const toy *)scene)->cost_s[(int)model->seconds[0]];
}

static void toy_drop(const void *scene, const rot_model *model, unsigned effects,
                     const rot_query *q, double worst, rot_drop *drop) {
  (void)model, (void)q, (void)worst;
  drop->error = effects == 2u ? ((const toy *)scene)->bound : (double)INFINITY;
  drop->each[1] = drop->error;
  drop->until_s = 1.0;
  drop->why_not = NULL;
}

static const char *const toy_measures[] = {"x", NULL};
static const rot_effect toy_list[] = {{"a", "an a", 0, 0}, {"b", "a b", 1, 0}, {"c", "a c", 0, 1}};
static const rot_model toy_models[] = {
    {"first", 1, ROT_BOUND, 1e-14, 0, "it is first", toy_why_not, toy_cost, {0}},
    {"second", 3, ROT_BOUND, 1e-14, 0, "it is second", toy_why_not, toy_cost, {1}},
    {"trial", 7, ROT_BOUND, 1e-15, 1, "tried", NULL, toy_cost, {2}},
    {"steps", 7, ROT_ADAPTIVE, 1e-12, 0, "stepped", NULL, toy_cost, {3}},
    {"more", 7, ROT_ADAPTIVE, 1e-12, 0, "stepped", NULL, toy_cost, {4}}};
static const rot_constraint toys = {.id = "toy",
                                    .measures = toy_measures,
                                    .n_effects = 3,
                                    .n_models = 5,
                                    .effects = toy_list,
                                    .models = toy_models,
                                    .effects_of = toy_effects,
                                    .drop = toy_drop};

static void expect_pick(const toy *scene, double accuracy, const char *a, const char *b) {
  rot_candidate picked[ROT_MAX_MODELS], all[ROT_MAX_MODELS];
  const rot_query q = query(0, NULL, accuracy);
  const size_t n = rot_choice_pick(&toys, scene, &q, picked);
  ROT_CHECK_EQ_INT(n, (a != NULL) + (b != NULL));
  if (a && n > 0) ROT_CHECK(!strcmp(picked[0].model->id, a));
  if (b && n > 1) ROT_CHECK(!strcmp(picked[1].model->id, b));
  /* The same as the cheapest of the candidates that apply. */
  ROT_CHECK_EQ_INT(rot_choice_candidates(&toys, scene, &q, all), 5);
  size_t k = 0;
  for (size_t i = 0; i < 5; i++) {
    if (i) ROT_CHECK(!(all[i].cost_s < all[i - 1].cost_s));
    if (!all[i].applies || k == n) continue;
    ROT_CHECK(all[i].model == picked[k].model);
    k++;
  }
  ROT_CHECK(k == n);
}

static void check_rules(void) {
  toy scene = {1u, {2.0, 2.0, 9.0, 1.0, 1.0}, 0.0};
  /* The cheapest; of equal cost, the first listed. */
  expect_pick(&scene, 1e-9, "steps", NULL);
  scene.cost_s[3] = scene.cost_s[4] = 3.0;
  expect_pick(&scene, 1e-9, "first", NULL);
  scene.cost_s[1] = 1.0;
  expect_pick(&scene, 1e-9, "second", NULL);
  /* One on trial, then the next that is sure; on trial alone where nothing else reaches it. */
  scene.cost_s[2] = 0.5;
  expect_pick(&scene, 1e-9, "trial", "second");
  expect_pick(&scene, 1e-14, "trial", "second");
  expect_pick(&scene, 2e-15, "trial", NULL);
  expect_pick(&scene, 1e-16, NULL, NULL);
  expect_pick(&scene, NAN, NULL, NULL);
  /* Nothing is dropped where a closed form takes the scene unchanged, however dear it is. */
  scene = (toy){2u, {1.0, 5.0, 9.0, 3.0, 3.0}, 1e-10};
  expect_pick(&scene, 1e-9, "steps", NULL);
  /* Else it is, if the bound is small enough. */
  scene.effects = 3u;
  expect_pick(&scene, 1e-9, "first", NULL);
  scene = (toy){6u, {1.0, 2.0, 9.0, 3.0, 3.0}, 1e-10};
  expect_pick(&scene, 1e-9, "steps", NULL); /* c cannot be dropped */
}

/* The same with a list in which nothing takes b by a bound. */
static void check_dropping(void) {
  rot_model list[] = {toy_models[0], toy_models[3]};
  rot_constraint few = toys;
  few.id = "few";
  few.n_models = 2;
  few.models = list;
  toy scene = {3u, {1.0, 0.0, 0.0, 3.0, 0.0}, 1e-10};
  rot_candidate picked[ROT_MAX_MODELS], all[ROT_MAX_MODELS];
  rot_query q = query(0, NULL, 1e-9);
  ROT_CHECK_EQ_INT(rot_choice_pick(&few, &scene, &q, picked), 1);
  ROT_CHECK(picked[0].model == &list[0] && picked[0].dropped && picked[0].untaken == 2u);
  ROT_CHECK(picked[0].error == 1e-10 + 1e-14);
  ROT_CHECK(!strcmp(reason(&few, &picked[0]),
                    "a b ignored: it changes omega by at most 1e-10 of its maximum"));
  q.accuracy = 1e-11;
  ROT_CHECK_EQ_INT(rot_choice_pick(&few, &scene, &q, picked), 1);
  ROT_CHECK(picked[0].model == &list[1]);
  rot_choice_candidates(&few, &scene, &q, all);
  ROT_CHECK(!strcmp(reason(&few, &all[0]),
                    "it does not take a b, and without it the error could be 1e-10"));
  /* The integrator costs less: it is chosen, and the other still applies. */
  q.accuracy = 1e-9;
  scene.cost_s[3] = 0.5;
  rot_choice_pick(&few, &scene, &q, picked);
  ROT_CHECK(picked[0].model == &list[1]);
  rot_choice_candidates(&few, &scene, &q, all);
  ROT_CHECK(all[0].model == &list[1] && all[1].applies && all[1].dropped);
  /* NaN for a bound is no bound. */
  scene.bound = NAN;
  rot_choice_judge(&few, &list[0], &scene, &q, &all[0]);
  ROT_CHECK(!all[0].applies);
  /* An implied effect goes without words; short buffers are cut. */
  rot_choice_effects(&few, 7u, sizeof text, text);
  ROT_CHECK(!strcmp(text, "a b and a c"));
  rot_choice_effects(&few, 3u, 5, text);
  ROT_CHECK(!strcmp(text, "an a"));
}

/* ---- the axle -------------------------------------------------------------------------------- */

static const double t[] = {0.5, 1.0, 2.0}, before[] = {-1.0, 1.0};

static rot_term term(rot_term_kind kind, size_t length, const double x[]) {
  const rot_term out = {kind, -INFINITY, INFINITY, length, x};
  return out;
}

static void expect_axle(const rot_axle_scene *scene, unsigned effects, const char *chosen) {
  rot_candidate picked[ROT_MAX_MODELS];
  const rot_query q = query(3, t, 1e-9);
  ROT_CHECK_EQ_INT(rot_axle_effects(scene), effects);
  ROT_CHECK_EQ_INT(rot_choice_pick(&rot_axle_constraint, scene, &q, picked), 1);
  ROT_CHECK(!strcmp(picked[0].model->id, chosen));
}

static void expect_reason(const rot_axle_scene *scene, const double time_s[], const char *model,
                          const char *why_not) {
  const rot_query q = query(2, time_s, 1e-9);
  rot_candidate c;
  rot_choice_judge(&rot_axle_constraint, rot_choice_model(&rot_axle_constraint, model), scene, &q,
                   &c);
  ROT_CHECK(c.applies == !why_not);
  if (why_not) ROT_CHECK(!strcmp(reason(&rot_axle_constraint, &c), why_not));
}

static const double ramp_s[] = {0.0, 2.0}, ramp[] = {1.0, 3.0}, flat[] = {1.0, 1.0},
                    jump_s[] = {1.0, 1.0}, sine[] = {1.0, 2.0, 0.0}, spring[] = {2.0, 0.1},
                    soft[] = {-2.0, 0.1}, gravity[] = {1.0, 0.0},
                    curve[] = {2.0, 0.0, 10.0, 1.0, 0.0}, cubic[] = {1.0, 2.0, 0.0, 1.0, 1.0, 1.0},
                    zeros[] = {0.0, 0.0}, moments[] = {2.0, 1.0};

static rot_status law(double time_s, double theta, double omega, double *torque, void *ctx) {
  (void)time_s, (void)theta, (void)omega, (void)ctx;
  *torque = 1.0;
  return ROT_OK;
}

static void check_axle(void) {
  rot_axle_scene s = plain_scene(1.0, 0.0, 1.0, 0.0);
  expect_axle(&s, 0u, "axle_free");
  s.linear.torque = (rot_torque){2, ramp_s, zeros, 0.0, 0.0, NULL, NULL};
  expect_axle(&s, 0u, "axle_free");
  s.linear.torque = (rot_torque){2, ramp_s, flat, 0.0, 0.0, NULL, NULL};
  expect_axle(&s, ROT_AXLE_TORQUE, "axle_linear");
  s.linear.torque = (rot_torque){2, jump_s, ramp, 0.0, 0.0, NULL, NULL};
  expect_axle(&s, ROT_AXLE_TORQUE, "axle_linear"); /* a jump is no ramp */
  s.linear.torque = (rot_torque){2, ramp_s, ramp, 0.0, 0.0, NULL, NULL};
  expect_axle(&s, ROT_AXLE_TORQUE | ROT_AXLE_RAMP, "axle_linear");
  s.viscous_n_m_s = s.linear.viscous_n_m_s = 0.1;
  s.coulomb_n_m = s.static_n_m = 0.1;
  expect_axle(&s, ROT_AXLE_TORQUE | ROT_AXLE_RAMP | ROT_AXLE_VISCOUS | ROT_AXLE_FRICTION,
              "axle_bands");
  s = plain_scene(1.0, 0.1, 1.0, 1.0);
  s.motor_n_m_s = 0.2;
  s.quadratic_n_m_s2 = 0.1;
  expect_axle(&s, ROT_AXLE_TORQUE | ROT_AXLE_VISCOUS | ROT_AXLE_MOTOR | ROT_AXLE_QUADRATIC,
              "axle_drag");
  s = plain_scene(2.0, 0.0, 1.0, 0.0);
  s.n_inertia = 2;
  s.inertia_time_s = ramp_s;
  s.inertia_kg_m2 = moments;
  expect_axle(&s, ROT_AXLE_INERTIA, "axle_skater");
  s = plain_scene(1.0, 0.0, 1.0, 0.0);
  s.linear.torque.call = law;
  expect_axle(&s, ROT_AXLE_FUNCTION, "axle_rk8pd");
  const struct {
    rot_term term;
    unsigned effect;
    const char *model;
  } kinds[] = {{term(ROT_TERM_SINUSOID, 3, sine), ROT_AXLE_SINUSOID, "axle_forced"},
               {term(ROT_TERM_EXPONENTIAL, 3, sine), ROT_AXLE_EXPONENTIAL, "axle_forced"},
               {term(ROT_TERM_POLYNOMIAL, 6, cubic), ROT_AXLE_POLYNOMIAL, "axle_forced"},
               {term(ROT_TERM_CHEBYSHEV, 6, cubic), ROT_AXLE_CHEBYSHEV, "axle_rk8pd"},
               {term(ROT_TERM_CURVE, 5, curve), ROT_AXLE_CURVE, "axle_bands"},
               {term(ROT_TERM_SPRING, 2, spring), ROT_AXLE_SPRING, "axle_oscillator"},
               {term(ROT_TERM_GRAVITY, 2, gravity), ROT_AXLE_GRAVITY, "axle_pendulum"}};
  for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++) {
    s = plain_scene(1.0, 0.0, 1.0, 0.0);
    s.n_terms = 1;
    s.terms = &kinds[i].term;
    expect_axle(&s, kinds[i].effect, kinds[i].model);
  }
  /* Stiff: implicit steps first. */
  s = plain_scene(1e-6, 1.0, 1.0, 1.0);
  s.linear.torque.call = law;
  expect_axle(&s, ROT_AXLE_TORQUE | ROT_AXLE_FUNCTION | ROT_AXLE_VISCOUS, "axle_radau");
}

static void check_axle_reasons(void) {
  rot_axle_scene s = plain_scene(1.0, 0.0, 1.0, 0.0);
  rot_term terms[2] = {term(ROT_TERM_GRAVITY, 2, gravity), term(ROT_TERM_GRAVITY, 2, gravity)};
  s.terms = terms;
  expect_reason(&s, t, "axle_pendulum", "it needs gravity, and only one");
  expect_reason(&s, t, "axle_oscillator", "it needs a spring, and only one");
  s.n_terms = 2;
  expect_reason(&s, t, "axle_pendulum", "it needs gravity, and only one");
  s.n_terms = 1;
  expect_reason(&s, t, "axle_pendulum", NULL);
  terms[0].to_s = 1.0;
  expect_reason(&s, t, "axle_pendulum", "gravity must act at all times");
  terms[0] = term(ROT_TERM_SPRING, 2, soft);
  expect_reason(&s, t, "axle_oscillator", "the spring's stiffness must be greater than 0");
  terms[0] = term(ROT_TERM_SPRING, 2, spring);
  terms[0].from_s = 1.0;
  expect_reason(&s, t, "axle_oscillator", "spring and sinusoids must act at all times");
  double steep[3 + 1 + 18] = {1.0, 18.0, 0.0, 9.0};
  terms[0] = term(ROT_TERM_POLYNOMIAL, 3 + 1 + 18, steep);
  expect_reason(&s, t, "axle_forced", "it takes polynomials up to degree 16");
  terms[0] = terms[1] = term(ROT_TERM_CURVE, 5, curve);
  s.n_terms = 2;
  expect_reason(&s, t, "axle_bands", "it takes one curve");
  s.n_terms = 1;
  expect_reason(&s, t, "axle_bands", NULL);
  expect_reason(&s, before, "axle_bands", "it cannot run backwards from the scene's start");
  terms[0].from_s = 0.0;
  expect_reason(&s, t, "axle_bands", "the curve must act at all times");
  s = plain_scene(1.0, -0.1, 1.0, 0.0);
  s.quadratic_n_m_s2 = 1.0;
  expect_reason(&s, t, "axle_drag", "it takes no viscous coefficient below 0");
  expect_reason(&s, t, "axle_linear",
                "it does not take quadratic drag, and without it the error could be 1.3");
  s = plain_scene(1.0, 0.1, 1.0, 0.0);
  s.coulomb_n_m = s.static_n_m = 1.0;
  expect_reason(&s, before, "axle_drag", "it cannot run backwards from the scene's start");
  expect_reason(&s, before, "axle_rk8pd", "it cannot run backwards from the scene's start");
  s.linear.torque = (rot_torque){2, ramp_s, ramp, 0.0, 0.0, NULL, NULL};
  expect_reason(
      &s, t, "axle_free",
      "it does not take a torque that changes in time, viscous resistance and dry friction");
  s = plain_scene(1.0, 0.1, 1.0, 0.0);
  const rot_query fine = query(3, t, 1e-14);
  rot_candidate c;
  rot_choice_judge(&rot_axle_constraint, rot_choice_model(&rot_axle_constraint, "axle_rk8pd"), &s,
                   &fine, &c);
  ROT_CHECK(!c.applies && !strcmp(reason(&rot_axle_constraint, &c),
                                  "its error of 1e-13 exceeds the accuracy asked"));
}

/* ---- the others ------------------------------------------------------------------------------ */

static void check_shaft_and_clutch(void) {
  const double ones[] = {1.0, 1.0, 1.0}, none[] = {0.0, 0.0, 0.0}, part[] = {1.0, 0.0};
  rot_shaft_params p = {3, ones, ones, none, none, none, none, ones, 0.0};
  rot_candidate picked[ROT_MAX_MODELS];
  rot_query q = query(2, before, 1e-9);
  ROT_CHECK_EQ_INT(rot_choice_pick(&rot_shaft_constraint, &p, &q, picked), 2);
  ROT_CHECK(picked[0].model->use == ROT_ON_TRIAL && picked[1].model->use == ROT_FREELY);
  p.damping_n_m_s = ones; /* backward and damped: no bound */
  ROT_CHECK_EQ_INT(rot_choice_pick(&rot_shaft_constraint, &p, &q, picked), 1);
  q.time_s = t;
  ROT_CHECK_EQ_INT(rot_choice_pick(&rot_shaft_constraint, &p, &q, picked), 2);
  p.stiffness_n_m_per_rad = part;
  rot_choice_judge(&rot_shaft_constraint, &rot_shaft_constraint.models[0], &p, &q, picked);
  ROT_CHECK(!strcmp(picked[0].why_not, "a piece of the shaft has no stiffness"));
  ROT_CHECK_EQ_INT(rot_shaft_constraint.effects_of(&p), 6);

  const double torque[] = {1.0};
  rot_clutch_params c = {{1.0, 2.0}, 1.0, 1.0,        {{0, NULL, torque}, {0, NULL, torque}},
                         0.0,        0.0, {0.0, 0.0}, {1.0, 0.0}};
  ROT_CHECK_EQ_INT(rot_choice_pick(&rot_clutch_constraint, &c, &q, picked), 1);
  ROT_CHECK_EQ_INT(rot_clutch_constraint.effects_of(&c), 3);
  q.time_s = before;
  ROT_CHECK_EQ_INT(rot_choice_pick(&rot_clutch_constraint, &c, &q, picked), 0);
}

static double cost_of(const rot_constraint *c, const char *id, const void *scene, size_t n,
                      const double time_s[]) {
  const rot_query q = query(n, time_s, 1e-9);
  const rot_model *m = rot_choice_model(c, id);
  ROT_CHECK(m != NULL);
  return m ? m->cost_s(m, scene, &q) : 0.0;
}

/* Closed forms of constant torques between events were measured to cost alike: a run of one row
 * within a factor of 3, a further row of a clutch's two bodies or of an incline within one of 2. */
static void check_costs_of_closed_forms(void) {
  enum { MANY = 1001 };
  static double even[MANY];
  for (int i = 0; i < MANY; i++) even[i] = 0.25 * i;
  const double ones[] = {1.0, 1.0}, none[] = {0.0, 0.0};
  const rot_axle_scene axle = {.linear = {.inertia_kg_m2 = 1.0}};
  const rot_shaft_params shaft = {2, ones, ones, none, none, none, none, ones, 0.0};
  const rot_clutch_params clutch = {.inertia_kg_m2 = {1.0, 2.0}, .static_n_m = 1.0};
  const rot_incline_scene incline = {.slope = {.mass_kg = 1.0, .radius_m = 1.0}};
  double one[5], row[5];
  for (int k = 0; k < 2; k++) {
    const size_t n = k ? MANY : 1;
    const double cost[] = {cost_of(&rot_clutch_constraint, "clutch_exact", &clutch, n, even),
                           cost_of(&rot_incline_constraint, "incline_exact", &incline, n, even),
                           cost_of(&rot_shaft_constraint, "rotors_modal", &shaft, n, even),
                           cost_of(&rot_axle_constraint, "axle_free", &axle, n, even),
                           cost_of(&rot_axle_constraint, "axle_linear", &axle, n, even)};
    for (int i = 0; i < 5; i++) *(k ? &row[i] : &one[i]) = k ? (cost[i] - one[i]) / 1e3 : cost[i];
  }
  for (int i = 1; i < 5; i++) ROT_CHECK(one[i] < 3.0 * one[0] && one[0] < 3.0 * one[i]);
  ROT_CHECK(row[0] < 2.0 * row[1] && row[1] < 2.0 * row[0]);
  for (int i = 2; i < 5; i++) ROT_CHECK(row[i] > 0.0 && row[i] < 3.0 * row[0]);
  /* Each step of a torque is another event: no more than a few rows. */
  rot_clutch_params stepped = clutch;
  stepped.torque_n_m[0].n = 1000;
  const double step =
      (cost_of(&rot_clutch_constraint, "clutch_exact", &stepped, 1, even) - one[0]) / 1e3;
  ROT_CHECK(step > row[0] && step < 4.0 * row[0]);
}

/* A closed form with a bound promises some roundings; what is looser is a short cut of the top. */
static void check_promises(void) {
  size_t n;
  const rot_constraint *const *list = rot_choice_constraints(&n);
  for (size_t i = 0; i < n; i++) {
    for (size_t k = 0; k < list[i]->n_models; k++) {
      const rot_model *m = &list[i]->models[k];
      const int short_cut = !strcmp(m->id, "pivot_precession") || !strcmp(m->id, "pivot_nutation");
      if (m->error_kind == ROT_BOUND)
        ROT_CHECK(short_cut ? m->promise <= 1e-6 : m->promise <= 1e-13);
    }
  }
}

/* What is solved in modes promises little more. */
static void check_estimates(void) {
  size_t n;
  const rot_constraint *const *list = rot_choice_constraints(&n);
  for (size_t i = 0; i < n; i++) {
    for (size_t k = 0; k < list[i]->n_models; k++) {
      const rot_model *m = &list[i]->models[k];
      if (m->error_kind == ROT_ESTIMATE && m->use == ROT_FREELY) ROT_CHECK(m->promise <= 1e-12);
    }
  }
}

int main(void) {
  check_lists();
  check_rules();
  check_dropping();
  check_axle();
  check_axle_reasons();
  check_shaft_and_clutch();
  check_costs_of_closed_forms();
  check_promises();
  check_estimates();
  return rot_test_report("choice");
}
