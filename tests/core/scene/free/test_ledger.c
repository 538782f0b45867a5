/* What flows in closed forms of bodies in space: the errors that are stated, from above and from
 * below. */
#include "scene/free/ledger.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "scene_kit.h"

static void vector(kit *k, const char *name, double x, double y, double z) {
  const double of[] = {x, y, z};
  kit_numbers(k, name, 3, of);
  k->given[kit_input(k, name)].is = ROT_INPUT_VECTOR;
}

static double largest(const motion *m, int flow) {
  double max = 0.0;
  for (size_t i = 0; i < m->n; i++) max = fmax(max, fabs(m->flow[flow][i]));
  return max;
}

static void within(const motion *m, int flow, double roundings) {
  const double rounding = DBL_EPSILON * largest(m, flow);
  ROT_CHECK(m->flow_error[flow] >= rounding && m->flow_error[flow] <= roundings * rounding);
}

/* A fast body in a medium: its heat is a million times its impulses. */
static void check_damped(void) {
  enum { HEAT = 1, IMPULSE = 5, MOTORS = 8 };
  const double t[] = {0.0, 2.0, 5.0};
  kit *k = kit_new("scene_free");
  vector(k, "body", 1.0, 2.0, 2.5);
  vector(k, "omega0_rad_per_s", 1e6, 2e6, -1e6);
  kit_resist(k, "damping_per_s", 0.3);
  motion m = kit_run(k, "free_exact", 1e-9, 3, t);
  ROT_CHECK(ran(&m) && largest(&m, HEAT) > 1e5 * largest(&m, IMPULSE));
  within(&m, HEAT, 32.0);
  for (int i = IMPULSE; i < MOTORS; i++) {
    ROT_CHECK(m.flow_error[i] <= 32.0 * DBL_EPSILON * 1e7 && m.flow_error[i] > 0.0);
  }
  for (size_t b = 0; b < k->c->n_balances; b++) ROT_CHECK(audit(k, &m, b, 0, 2, -1, NULL) <= 1.0);
  motion_free(&m);
  kit_free(k);
}

/* A top: the work of its weight, of which the lever and the attitude's error say how far it may be
 * off. */
static void check_weight(void) {
  enum { WORK = 0, TORQUE_X = 2 };
  const double t[] = {0.0, 0.5, 1.5}, lever = 0.5 * 9.80665 * 0.08;
  const double tilted[] = {cos(0.25), sin(0.25), 0.0, 0.0};
  kit *k = kit_new("scene_pivot");
  vector(k, "body", 0.0042, 0.0042, 0.002);
  vector(k, "omega0_rad_per_s", 0.0, 0.0, 60.0);
  vector(k, "centre_m", 0.0, 0.0, 0.08);
  kit_number(k, "mass_kg", 0.5);
  kit_numbers(k, "attitude0", 4, tilted);
  k->given[kit_input(k, "attitude0")].is = ROT_INPUT_ATTITUDE;
  motion m = kit_run(k, "pivot_top", 1e-9, 3, t);
  ROT_CHECK(ran(&m));
  const double off = reported(&m, 0), max = lever * (2.0 * off + 32.0 * DBL_EPSILON);
  ROT_CHECK(m.flow_error[WORK] >= lever * off && m.flow_error[WORK] <= max);
  ROT_CHECK(m.flow_error[TORQUE_X] >= 1.5 * lever * off);
  ROT_CHECK(m.flow_error[TORQUE_X] <= 1.5 * lever * (4.0 * off + 1e4 * DBL_EPSILON));
  for (size_t b = 0; b < k->c->n_balances; b++) ROT_CHECK(audit(k, &m, b, 0, 2, -1, NULL) <= 1.0);
  motion_free(&m);
  kit_free(k);
}

/* What an audit allows of the momentum of an integrated run: the errors of both ends. */
static void check_explained(void) {
  const double t[] = {0.0, 7.0};
  kit *k = kit_new("scene_free");
  vector(k, "body", 1.0, 2.0, 2.5);
  vector(k, "omega0_rad_per_s", 0.5, 1.5, -1.0);
  motion m = kit_run(k, "free_rk8pd", 1e-6, 2, t);
  ROT_CHECK(ran(&m));
  double first[ROT_MAX_COLUMNS], last[ROT_MAX_COLUMNS], flow[ROT_MAX_FLOWS];
  double error[ROT_MAX_MEASURES], terms[ROT_MAX_TERMS], explained[ROT_MAX_BALANCES];
  for (size_t c = 0; c < k->c->n_columns; c++) first[c] = m.column[c][0], last[c] = m.column[c][1];
  for (size_t f = 0; f < k->c->n_flows; f++) flow[f] = m.flow[f][1] - m.flow[f][0];
  for (size_t e = 0; e < m.out.info.n_measures; e++) error[e] = reported(&m, e);
  const rot_span span = {
      .first = first, .last = last, .flow = flow, .flow_error = m.flow_error, .error = error};
  (void)rot_run_audit(k->c, k->scene, &span, terms, explained);
  const double of_l = reported(&m, 2);
  ROT_CHECK(of_l > 1e-12);
  for (int b = 1; b < 4; b++) {
    ROT_CHECK(explained[b] >= 2.0 * of_l && explained[b] <= 2.05 * of_l);
  }
  motion_free(&m);
  kit_free(k);
}

/* Rates that turn the body: twice its own, and twice those that the rotors give it about the axis
 * of the smallest moment. */
static void check_time_scales(void) {
  const rot_free_rotor rotors[] = {{.moment_kg_m2 = 0.1, .omega_rad_per_s = 20.0},
                                   {.moment_kg_m2 = 0.2, .omega_rad_per_s = -5.0}};
  rot_free_params p = {.moment_kg_m2 = {2.0, 0.5, 1.0}};
  double sizes[ROT_MAX_MEASURES] = {0};
  sizes[ROT_FREE_OMEGA] = 3.0;
  rot_time_scales found = {0};
  rot_free_time_scales(&p, sizes, &found);
  ROT_CHECK(found.swing_rad_per_s == 6.0 && isinf(found.fades_s));
  p.rotors = rotors, p.n_rotors = 2, p.damping_per_s = 4.0;
  rot_free_time_scales(&p, sizes, &found);
  ROT_CHECK(found.swing_rad_per_s == 6.0 + 2.0 * 3.0 / 0.5 && found.fades_s == 0.25);
}

int main(void) {
  check_time_scales();
  check_damped();
  check_weight();
  check_explained();
  return rot_test_report("free ledger");
}
