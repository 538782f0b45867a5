/* Outputs by name: values at the end, extremes, events, stops, energies against the audit of a run,
 * flags, copies; names that there are not. */
#include "sweep_kit.h"
#include "sweep/outputs.h"

static const rot_constraint *constraint(const char *id) { return rot_choice_constraint(id); }

static int named(const char *id, const char *name) {
  rot_output_of to;
  return rot_output_named(constraint(id), name, &to);
}

static void names(void) {
  static const char *const wrong[] = {"",
                                      "final_",
                                      "final_phi_rad",
                                      "theta_rad",
                                      "final_theta_rad[1]",
                                      "error[1]",
                                      "errors",
                                      "n_",
                                      "n_lock",
                                      "first_stick",
                                      "first_stick_time",
                                      "first_lock_time_s",
                                      "n_stick[1]",
                                      "max_abs_",
                                      "first__time_s",
                                      "_time_s",
                                      "first_time_s",
                                      "final_theta_rad[",
                                      "final_theta_rad[0]",
                                      "stop_time_s[1]"};
  static const char *const right[] = {"final_theta_rad",
                                      "max_theta_rad",
                                      "min_omega_rad_per_s",
                                      "n_stick",
                                      "max_abs_theta_rad",
                                      "first_slip_time_s",
                                      "n_reverse",
                                      "stop_time_s",
                                      "supplied_j",
                                      "lost_j",
                                      "balanced",
                                      "error",
                                      "steps"};
  for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) ROT_CHECK(!named("axle", wrong[i]));
  for (size_t i = 0; i < sizeof right / sizeof *right; i++) ROT_CHECK(named("axle", right[i]));
  /* Rows with an index have each column once for each copy. */
  ROT_CHECK(named("chain", "final_theta_rad[2]") && !named("chain", "final_theta_rad"));
  ROT_CHECK(!named("chain", "final_theta_rad[0]") && !named("chain", "final_theta_rad[2"));
  ROT_CHECK(!named("chain", "final_theta_rad[2]x") && !named("chain", "final_theta_rad[]"));
  ROT_CHECK(named("drive", "n_stick") && named("drive", "n_stick[2]") &&
            !named("chain", "n_stick"));
  ROT_CHECK(named("free", "n_flip") && !named("free", "n_stick"));
  rot_output_of o;
  ROT_CHECK(rot_output_named(constraint("axle"), "max_abs_omega_rad_per_s", &o));
  ROT_CHECK(o.kind == ROT_OUT_MAX_ABS && o.at == 1 && o.place == 0 && !rot_output_audits(&o));
  ROT_CHECK(rot_output_named(constraint("axle"), "lost_j", &o) && rot_output_audits(&o));
  ROT_CHECK(rot_output_named(constraint("axle"), "supplied_j", &o) && rot_output_audits(&o));
  ROT_CHECK(rot_output_named(constraint("axle"), "balanced", &o) && rot_output_audits(&o));
  ROT_CHECK(rot_output_named(constraint("drive"), "n_stick[12]", &o) && o.place == 12);
}

/* ---- the walk -------------------------------------------------------------------------------- */

typedef struct walked {
  const rot_constraint *constraint;
  size_t n, stop, bad, stops, columns, shown;
} walked;

static int visit(const char *name, const char *unit, const char *words, void *ctx) {
  walked *w = ctx;
  rot_output_of to;
  w->bad += !rot_output_named(w->constraint, name, &to) || !words[0];
  w->stops += !strcmp(name, "stop_time_s");
  w->columns += !strncmp(name, "final_", 6);
  (void)unit;
  return ++w->n == w->stop;
}

static void walks(void) {
  for (int i = 0; i < KIT_CASES; i++) {
    double x[KIT_INPUTS];
    kit_inputs(&kit_cases[i], 1, x);
    rot_object *made = kit_cases[i].make(x);
    kit_run r = kit_run_of(made, NULL, 1e-9, 1, (const double[]){0.0});
    walked w = {.constraint = r.constraint};
    rot_outputs_walk(r.constraint, r.scene, visit, &w);
    size_t shown = 0;
    const unsigned effects = r.constraint->effects_of(r.scene);
    for (size_t k = 0; k < r.constraint->n_columns; k++) {
      shown += rot_run_shows(r.constraint, r.scene, effects, k) != 0;
    }
    ROT_CHECK(w.bad == 0 && w.columns == shown * kit_cases[i].copies);
    ROT_CHECK(w.stops == (r.constraint->events >> ROT_EVENT_STICK & 1u));
    w = (walked){.constraint = r.constraint, .stop = 2};
    rot_outputs_walk(r.constraint, r.scene, visit, &w);
    ROT_CHECK_EQ_INT(w.n, 2);
    kit_free(&r);
    rot_object_free(made);
  }
}

/* ---- values ---------------------------------------------------------------------------------- */

enum { MOST = 16 };

/* Outputs of a scene without numbers that vary; returns the status of the row. */
static int outputs(const rot_object *scene, const char *model, size_t n_times,
                   const double time_s[], size_t n, const char *const name[], double value[]) {
  const rot_row_plan plan = {scene, 0, NULL, n_times, time_s, model, 0, 1e-9, 1e6, n, name};
  rot_rows_worker *w;
  rot_refusal no;
  double error;
  if (rot_rows_open(&plan, &w, &no) != ROT_OK) return -1;
  const int status = rot_rows_run(w, NULL, value, &error, NULL, NULL);
  rot_rows_close(w);
  return status;
}

static const char *const events_of[] = {
    "first_stick_time_s",   "n_stick",     "first_slip_time_s",    "n_slip", "n_reverse",
    "first_reverse_time_s", "stop_time_s", "final_omega_rad_per_s"};
enum { STICK, STICKS, SLIP, SLIPS, REVERSES, REVERSE, STOP, OMEGA, EVENTS };

/* I omega' = -tau: stops at I omega0 / tau. */
static void stops(void) {
  static const double x[] = {0.05, 0.0, 2.0}, early[] = {1.0}, late[] = {1.0, 50.0};
  rot_object *dry = make_dry(x);
  double v[MOST];
  part(dry, "resistance", loss(0.0, 0.0, 0.05));
  ROT_CHECK_EQ_INT(outputs(dry, NULL, 2, late, EVENTS, events_of, v), ROT_OK);
  ROT_CHECK_REL(v[STICK], 0.0625 * 2.0 / 0.05, 1e-14);
  ROT_CHECK(v[STICKS] == 1.0 && same_bits(v[STOP], v[STICK]) && v[OMEGA] == 0.0);
  ROT_CHECK(isinf(v[SLIP]) && v[SLIPS] == 0.0 && v[REVERSES] == 0.0 && isinf(v[REVERSE]));
  ROT_CHECK_EQ_INT(outputs(dry, NULL, 1, early, EVENTS, events_of, v), ROT_OK);
  ROT_CHECK(isinf(v[STICK]) && v[STICKS] == 0.0 && isinf(v[STOP]) && v[STOP] > 0.0);
  ROT_CHECK_REL(v[OMEGA], 2.0 - 0.05 / 0.0625, 1e-14);
  /* At rest from the start, which is not 0. */
  put(dry, "omega0_rad_per_s", 0.0);
  put(dry, "start_s", 0.5);
  ROT_CHECK_EQ_INT(outputs(dry, NULL, 2, late, EVENTS, events_of, v), ROT_OK);
  ROT_CHECK(v[STOP] == 0.5);
  rot_object_free(dry);
}

/* A torque from 10 s to 12 s breaks it loose: two stops, the last counts. */
static void stops_twice(void) {
  static const double torque[] = {0.2, 0.0}, end = 60.0;
  rot_object *scene = of("scene_axle"), *steps = of("torque_steps");
  double v[MOST];
  puts_of(steps, "time_s", 2, (const double[]){10.0, 12.0});
  puts_of(steps, "torque_n_m", 2, torque);
  put(scene, "body", 0.1);
  put(scene, "omega0_rad_per_s", 1.0);
  part(scene, "torque", steps);
  part(scene, "resistance", loss(0.0, 0.0, 0.1));
  ROT_CHECK_EQ_INT(outputs(scene, NULL, 1, &end, EVENTS, events_of, v), ROT_OK);
  ROT_CHECK(v[STICKS] == 2.0 && v[SLIPS] == 1.0 && v[SLIP] == 10.0);
  ROT_CHECK_REL(v[STICK], 1.0, 1e-14); /* 0.1 * 1 / 0.1 */
  ROT_CHECK_REL(v[STOP], 14.0, 1e-14); /* 2 s up at 1 rad/s^2, as long down */
  rot_object_free(scene);
}

/* A pulse that pushes back: omega passes through 0. */
static void reverses(void) {
  static const double end = 5.0;
  rot_object *scene = of("scene_axle");
  double v[MOST];
  put(scene, "body", 0.1);
  put(scene, "torque", -0.2);
  put(scene, "omega0_rad_per_s", 4.0);
  part(scene, "resistance", loss(0.0, 0.0, 0.1));
  ROT_CHECK_EQ_INT(outputs(scene, NULL, 1, &end, EVENTS, events_of, v), ROT_OK);
  ROT_CHECK(v[REVERSES] == 1.0 && v[STICKS] == 0.0 && isinf(v[STOP]));
  ROT_CHECK_REL(v[REVERSE], 4.0 * 0.1 / 0.3, 1e-14);
  ROT_CHECK_REL(v[OMEGA], -(5.0 - 4.0 / 3.0), 1e-14); /* (0.2 - 0.1) / 0.1 = 1 rad/s^2 */
  rot_object_free(scene);
}

/* Energies and the verdict against rot_run_audit() between the first and the last time. */
static void audits(void) {
  static const char *const name[] = {"supplied_j", "lost_j", "balanced", "error", "steps"};
  for (int i = 0; i < KIT_CASES; i++) {
    const kit_case *c = &kit_cases[i];
    if (c->copies > 1) continue; /* below */
    for (int more = 0; more < 2; more++) {
      const double time_s[] = {0.5 * c->end_s, c->end_s}, ends[] = {0.0, c->end_s};
      const double all[] = {0.0, 0.5 * c->end_s, c->end_s};
      double x[KIT_INPUTS], v[MOST];
      kit_inputs(c, 3, x);
      rot_object *made = c->make(x);
      const int adaptive = strstr(c->model, "rk8pd") != NULL;
      ROT_CHECK_EQ_INT(
          outputs(made, c->model, more ? 2 : 1, more ? time_s : time_s + 1, 5, name, v), ROT_OK);
      /* Closed forms have their flows between the ends. */
      kit_run r = adaptive && more ? kit_run_of(made, c->model, 1e-9, 3, all)
                                   : kit_run_of(made, c->model, 1e-9, 2, ends);
      double term[ROT_MAX_TERMS], explained[ROT_MAX_BALANCES], flow[ROT_MAX_FLOWS];
      double error[ROT_MAX_MEASURES], first[ROT_MAX_COLUMNS], last[ROT_MAX_COLUMNS];
      rot_run_cells(r.constraint, r.scene, r.column, 0, first);
      rot_run_cells(r.constraint, r.scene, r.column, r.n - 1, last);
      for (size_t k = 0; k < r.constraint->n_flows; k++)
        flow[k] = r.flow[k][r.n - 1] - r.flow[k][0];
      for (size_t k = 0; k < r.out.info.n_measures; k++) error[k] = r.out.info.measure[k].error;
      const rot_span span = {{0.0, c->end_s}, first, last, flow, r.flow_error, error};
      ROT_CHECK(rot_run_audit(r.constraint, r.scene, &span, term, explained) == ROT_OK);
      int balanced = 1;
      double supplied = NAN, lost = NAN;
      for (size_t k = 0; k < r.constraint->n_balances; k++) {
        const rot_balance_sums s = rot_run_balance(r.constraint, r.scene, k, term, explained);
        balanced &= s.balanced == 1;
        if (strcmp(r.constraint->balances[k].quantity, "energy")) continue;
        supplied = s.supplied;
        lost = s.dissipated;
      }
      ROT_CHECK(same_bits(v[0], supplied) && same_bits(v[1], lost) && v[2] == 1.0 && balanced);
      if (!more) ROT_CHECK(same_bits(v[3], r.out.error));
      if (!more) ROT_CHECK(same_bits(v[4], (double)r.out.info.steps));
      kit_free(&r);
      rot_object_free(made);
    }
  }
}

/* 0.1 N m on 0.1 kg m^2 for 2 s: 0.2 J; friction of a slide takes all. */
static void energies(void) {
  static const char *const name[] = {"supplied_j", "lost_j", "balanced"};
  static const double end = 2.0, far = 60.0, x[] = {0.05, 0.0, 2.0};
  double v[MOST];
  rot_object *scene = of("scene_axle"), *dry = make_dry(x);
  put(scene, "body", 0.1);
  put(scene, "torque", 0.1);
  ROT_CHECK_EQ_INT(outputs(scene, NULL, 1, &end, 3, name, v), ROT_OK);
  ROT_CHECK_REL(v[0], 0.2, 1e-14);
  ROT_CHECK(v[1] == 0.0 && v[2] == 1.0);
  ROT_CHECK_EQ_INT(outputs(dry, NULL, 1, &far, 3, name, v), ROT_OK);
  ROT_CHECK_REL(v[1], 0.5 * 0.0625 * 4.0, 1e-12);
  ROT_CHECK(v[0] == 0.0 && v[2] == 1.0);
  rot_object_free(scene);
  rot_object_free(dry);
}

/* Between two times before the start, where neither flow is 0: what resistance took is what the
 * torque supplied less what the energy gained. */
static void energies_before_the_start(void) {
  static const char *const name[] = {"supplied_j",
                                     "lost_j",
                                     "final_rotational_kinetic_energy_j",
                                     "min_rotational_kinetic_energy_j",
                                     "final_theta_rad",
                                     "min_theta_rad",
                                     "max_theta_rad"};
  static const double x[] = {2.0, 0.03, 20.0}, time_s[] = {-2.0, -1.0};
  rot_object *wheel = make_wheel(x);
  double v[MOST];
  ROT_CHECK_EQ_INT(outputs(wheel, "axle_linear", 2, time_s, 7, name, v), ROT_OK);
  ROT_CHECK(v[1] > 0.0 && v[2] > v[3] && same_bits(v[4], v[6]));
  ROT_CHECK_REL(v[0], 0.8 * (v[6] - v[5]), 1e-12);
  ROT_CHECK_REL(v[2] - v[3], v[0] - v[1], 1e-12);
  rot_object_free(wheel);
}

/* Flags, columns that the scene does not show, copies that it does not have. */
static void cells(void) {
  static const double x[] = {0.1, 30.0, 0.05}, y[] = {2.0, 0.03, 1.0}, z[] = {0.5, 0.2, 1.0};
  static const char *const of_slope[] = {"final_rolling", "max_rolling", "min_rolling",
                                         "final_drag_force_n"};
  static const char *const of_wheel[] = {"final_tension_n", "max_moment_of_inertia_kg_m2"};
  static const char *const of_chain[] = {"final_theta_rad[2]", "final_theta_rad[3]",
                                         "final_theta_rad[1]"};
  static const double end[] = {0.0, 0.5}, short_s = 0.1;
  rot_object *slope = make_slope(x), *wheel = make_wheel(y), *chain = make_chain(z);
  double v[MOST];
  ROT_CHECK_EQ_INT(outputs(slope, NULL, 2, end, 4, of_slope, v), ROT_OK);
  ROT_CHECK(v[0] == 0.0 && v[1] == 0.0 && v[2] == 0.0 && isnan(v[3]));
  put(slope, "static_friction", 5.0);
  ROT_CHECK_EQ_INT(outputs(slope, NULL, 2, end, 4, of_slope, v), ROT_OK);
  ROT_CHECK(v[0] == 1.0 && v[1] == 1.0 && v[2] == 0.0);
  ROT_CHECK_EQ_INT(outputs(wheel, NULL, 1, end + 1, 2, of_wheel, v), ROT_OK);
  ROT_CHECK(isnan(v[0]) && isnan(v[1]));
  ROT_CHECK_EQ_INT(outputs(chain, NULL, 1, &short_s, 3, of_chain, v), ROT_OK);
  ROT_CHECK(isnan(v[1]) && isfinite(v[0]) && isfinite(v[2]) && v[0] != v[2]);
  rot_object_free(slope);
  rot_object_free(wheel);
  rot_object_free(chain);
}

int main(void) {
  names();
  walks();
  stops();
  stops_twice();
  reverses();
  audits();
  energies();
  energies_before_the_start();
  cells();
  return rot_test_report("outputs");
}
