/* Torques of a drive, which contacts stick, and its motion, against values by hand. */
#include <stdlib.h>

#include "scene/drive/contact.h"
#include "scene/drive/models.h"
#include "scene/drive/ode.h"
#include "rot_test.h"

#define NEAR(got, want, by) ROT_CHECK(fabs((got) - (want)) <= (by))

enum { MAX = 4, ROWS = 8 };

static rot_axle_scene rotor[MAX];
static rot_drive_friction friction[MAX];
static rot_drive_coupling coupling[MAX];

static rot_axle_scene body(double inertia, double torque, double omega) {
  rot_axle_scene b;
  memset(&b, 0, sizeof b);
  b.linear.inertia_kg_m2 = inertia;
  b.linear.omega0_rad_per_s = omega;
  b.linear.torque.before_n_m = b.linear.torque.after_n_m = torque;
  return b;
}

static rot_drive_friction hold(double capacity, double static_ratio) {
  rot_drive_friction g;
  memset(&g, 0, sizeof g);
  g.acts = 1;
  g.law = body(1.0, capacity, 0.0);
  g.static_ratio = static_ratio;
  g.from_s = -INFINITY;
  g.to_s = INFINITY;
  return g;
}

static rot_drive_scene scene_of(size_t n) {
  return (rot_drive_scene){.n = n, .rotor = rotor, .brake = friction, .coupling = coupling};
}

static void clear(void) {
  memset(friction, 0, sizeof friction);
  memset(coupling, 0, sizeof coupling);
  for (int i = 0; i < MAX; i++) coupling[i].ratio = 1.0;
}

/* ---- torques --------------------------------------------------------------------------------- */

static void gears_reflect(void) {
  rot_drive_system s;
  double y[16] = {0.0};
  signed char mode[4] = {0};
  clear();
  rotor[0] = body(0.1, 2.0, 0.0);
  rotor[1] = body(0.5, -4.0, 0.0);
  coupling[0].kind = ROT_DRIVE_GEAR;
  coupling[0].ratio = 5.0;
  const rot_drive_scene scene = scene_of(2);
  ROT_CHECK(rot_drive_system_new(&s, &scene) == ROT_OK);
  ROT_CHECK_EQ_INT(s.m, 1);
  ROT_CHECK(rot_drive_forces(&s, 0.0, y, mode) == ROT_OK);
  /* At the first shaft 0.12 kg m^2 and 1.2 N m; rotor 1 leaves 2 - 0.1 * 10 to the gear. */
  ROT_CHECK_ULP(s.alpha[0], 10.0, 4);
  ROT_CHECK_ULP(s.alpha[1], 2.0, 4);
  ROT_CHECK_ULP(s.torque[0], 1.0, 8);
  rot_drive_system_free(&s);
}

/* Brakes of 4, 3 and 2 N m with clutches between: a load on the first is held up to `least`. */
static double held_margin(double clutch, double load, signed char after[]) {
  rot_drive_system s;
  double y[16] = {0.0};
  clear();
  for (int i = 0; i < 3; i++) {
    rotor[i] = body(1.0, i ? 0.0 : load, 0.0);
    friction[i] = hold(4.0 - i, 1.0);
    coupling[i].kind = ROT_DRIVE_CLUTCH;
    coupling[i].friction = hold(i ? 100.0 : clutch, 1.0);
  }
  const rot_drive_scene scene = scene_of(3);
  ROT_CHECK(rot_drive_system_new(&s, &scene) == ROT_OK);
  memset(after, 0, s.n_contacts);
  ROT_CHECK(rot_drive_forces(&s, 0.0, y, after) == ROT_OK);
  const double margin = s.weakest.margin;
  /* What holds is in balance, and within what each contact holds. */
  if (margin >= 0.0) {
    double total = load;
    for (size_t i = 0; i < 3; i++) {
      total += s.dry[i] + s.brake[i];
      ROT_CHECK(fabs(s.brake[i]) <= 4.0 - (double)i + 1e-14);
    }
    NEAR(total, 0.0, 1e-14);
    ROT_CHECK(fabs(s.torque[0]) <= clutch + 1e-14);
  }
  ROT_CHECK(rot_drive_settle(&s, 0.0, y, after, 0, 1e-9) == ROT_OK);
  rot_drive_system_free(&s);
  return margin;
}

static void contacts_fraction_a_load(void) {
  signed char mode[5];
  NEAR(held_margin(100.0, 8.0, mode), 1.0 / 17.0, 1e-15);
  for (int k = 0; k < 5; k++) ROT_CHECK_EQ_INT(mode[k], 0);
  NEAR(held_margin(100.0, -10.0, mode), -1.0 / 19.0, 1e-15);
  for (int k = 0; k < 3; k++) ROT_CHECK_EQ_INT(mode[k], -1); /* all slip to ground, none between */
  for (int k = 3; k < 5; k++) ROT_CHECK_EQ_INT(mode[k], 0);
  ROT_CHECK(held_margin(1.5, 5.0, mode) > 0.0);
  ROT_CHECK(held_margin(1.5, 6.0, mode) < 0.0);
  const signed char want[] = {1, 0, 0, 1, 0};
  for (int k = 0; k < 5; k++) ROT_CHECK_EQ_INT(mode[k], want[k]);
}

/* Breaking loose at the static capacity, the sliding one loads the next contact more. */
static void one_slip_makes_another(void) {
  rot_drive_system s;
  double y[16] = {0.0};
  signed char mode[4] = {0};
  clear();
  /* Locked, clutch 1 passes 2/3 of 12 N m, clutch 2 a third. */
  for (int i = 0; i < 3; i++) {
    rotor[i] = body(1.0, i ? 0.0 : 12.0, 0.0);
    coupling[i].kind = ROT_DRIVE_CLUTCH;
  }
  coupling[0].friction = hold(7.0, 1.0);
  coupling[1].friction = hold(3.0, 1.1);
  const rot_drive_scene scene = scene_of(3);
  ROT_CHECK(rot_drive_system_new(&s, &scene) == ROT_OK);
  ROT_CHECK(rot_drive_settle(&s, 0.0, y, mode, 0, 1e-9) == ROT_OK);
  /* Clutch 2 holds 3.3, needs half of the 7 that clutch 1 passes while it slips. */
  ROT_CHECK_EQ_INT(mode[0], 1);
  ROT_CHECK_EQ_INT(mode[1], 1);
  NEAR(s.alpha[0], 5.0, 1e-14);
  NEAR(s.alpha[1], 4.0, 1e-14);
  NEAR(s.alpha[2], 3.0, 1e-14);
  rot_drive_system_free(&s);
}

static void nothing_acts_nothing_moves(void) {
  rot_drive_system s;
  double y[16] = {0.0};
  signed char mode[4] = {0};
  clear();
  rotor[0] = body(1.0, 0.0, 0.0);
  rotor[1] = body(1.0, 0.0, 0.0);
  coupling[0].kind = ROT_DRIVE_CLUTCH;
  coupling[0].friction = hold(0.0, 1.0);
  const rot_drive_scene scene = scene_of(2);
  ROT_CHECK(rot_drive_system_new(&s, &scene) == ROT_OK);
  ROT_CHECK(rot_drive_settle(&s, 0.0, y, mode, 0, 1e-9) == ROT_OK);
  ROT_CHECK_EQ_INT(mode[0], ROT_DRIVE_OPEN);
  ROT_CHECK(s.alpha[0] == 0.0 && s.alpha[1] == 0.0);
  rot_drive_system_free(&s);
}

/* Where nothing sticks, nothing breaks loose: what slips goes on as it does. */
static void what_slips_has_let_go(void) {
  rot_drive_system s;
  double y[16] = {0.0};
  signed char mode[4] = {0};
  clear();
  rotor[0] = body(1.0, 0.0, 3.0);
  rotor[1] = body(1.0, 0.0, 1.0);
  coupling[0].kind = ROT_DRIVE_CLUTCH;
  coupling[0].friction = hold(4.0, 1.0);
  const rot_drive_scene scene = scene_of(2);
  ROT_CHECK(rot_drive_system_new(&s, &scene) == ROT_OK);
  y[s.contact[0].state] = 2.0;
  for (int breaks = 0; breaks < 2; breaks++) {
    ROT_CHECK(rot_drive_settle(&s, 0.0, y, mode, breaks, 1e-9) == ROT_OK);
    ROT_CHECK_EQ_INT(mode[0], 1);
    ROT_CHECK(s.alpha[0] == -4.0 && s.alpha[1] == 4.0);
  }
  rot_drive_system_free(&s);
}

/* ---- motions --------------------------------------------------------------------------------- */

static struct {
  double value[9][ROWS * MAX], sum[10][ROWS];
  int locked[ROWS * MAX];
  rot_drive_columns out;
  rot_drive_ledger ledger;
  rot_events events;
  rot_info info;
  rot_status status;
} run;

static void integrate(size_t n_rotors, size_t n, const double t[], rot_method method) {
  const rot_drive_scene scene = scene_of(n_rotors);
  const rot_drive_ode_options options = {1e-10, 100000, method, 0.0, 0.0};
  run.out =
      (rot_drive_columns){run.value[0], run.value[1], run.value[2], run.value[3], run.value[4],
                          run.value[5], run.value[6], run.locked,   run.value[7], run.value[8]};
  memset(&run.ledger, 0, sizeof run.ledger);
  size_t k = 0;
#define X(name) run.ledger.name = run.sum[k++];
  ROT_DRIVE_LEDGER(X)
#undef X
  rot_events_free(&run.events);
  run.status = rot_drive_integrate(&scene, &options, n, t, &run.out, &run.ledger, &run.events, NULL,
                                   &run.info);
  ROT_CHECK_EQ_INT(run.status, run.info.status);
}

static void a_clutch_locks(void) {
  static const double t[] = {0.0, 0.5, 1.0, 2.0};
  static const double omega[] = {10.0, 0.0, 7.0, 2.0, 4.0, 4.0, 4.0, 4.0};
  for (int method = ROT_METHOD_NONE; method <= ROT_METHOD_RADAU; method++) {
    clear();
    rotor[0] = body(2.0, 0.0, 10.0);
    rotor[1] = body(3.0, 0.0, 0.0);
    coupling[0].kind = ROT_DRIVE_CLUTCH;
    coupling[0].friction = hold(12.0, 1.0);
    integrate(2, 4, t, (rot_method)method);
    ROT_CHECK(run.status == ROT_OK);
    for (int i = 0; i < 8; i++) NEAR(run.out.omega_rad_per_s[i], omega[i], 1e-13);
    NEAR(run.out.coupling_heat_j[6], 60.0, 1e-12);
    NEAR(run.ledger.clutch_j[3], 60.0, 1e-12);
    ROT_CHECK_EQ_INT(run.events.count, 1);
    ROT_CHECK_EQ_INT(run.events.event[0], ROT_EVENT_LOCK);
    ROT_CHECK_EQ_INT(run.events.place[0], -1);
    NEAR(run.events.time_s[0], 1.0, 1e-14);
    ROT_CHECK(rot_info_error(&run.info) <= 1e-10);
  }
}

static void a_brake_stops_a_geared_load(void) {
  static const double t[] = {0.0, 1.0, 2.0, 3.0};
  clear();
  rotor[0] = body(1.0, 0.0, 8.0);
  rotor[1] = body(4.0, 0.0, 4.0);
  coupling[0].kind = ROT_DRIVE_GEAR;
  coupling[0].ratio = 2.0;
  friction[1] = hold(16.0, 1.0); /* 8 N m on 2 kg m^2 at the first shaft: it stops at 2 + 0.5 s */
  friction[1].from_s = 0.5;
  integrate(2, 4, t, ROT_METHOD_NONE);
  ROT_CHECK(run.status == ROT_OK);
  NEAR(run.out.omega_rad_per_s[2], 6.0, 1e-13);
  NEAR(run.out.omega_rad_per_s[3], 3.0, 1e-13);
  ROT_CHECK(run.out.omega_rad_per_s[6] == 0.0);
  NEAR(run.out.heat_j[7], 64.0, 1e-12);
  NEAR(run.ledger.brake_j[3], 64.0, 1e-12);
  ROT_CHECK_EQ_INT(run.events.count, 1);
  NEAR(run.events.time_s[0], 2.5, 1e-14);
  ROT_CHECK_EQ_INT(run.events.place[0], 2);
  /* The momentum that the housing takes: half of that of the gear pair, less the brake's. */
  NEAR(run.ledger.resistance_impulse_n_m_s[3], -32.0, 1e-12);
  NEAR(run.ledger.housing_impulse_n_m_s[3], -24.0 + 32.0, 1e-12);
}

static void a_gear_loses_power(void) {
  static const double t[] = {0.0, 1.0};
  /* 3 N m forward through 0.8: 0.2 + 1.8/(9 * 0.8) kg m^2; backward: 0.2 + 1.8/9 * 0.8. */
  for (int forward = 0; forward < 2; forward++) {
    const double rate = forward ? 3.0 / 0.45 : -3.0 / 0.36, omega = 20.0 + rate;
    clear();
    rotor[0] = body(0.2, forward ? 3.0 : -3.0, 20.0);
    rotor[1] = body(1.8, 0.0, 20.0 / 3.0);
    coupling[0].kind = ROT_DRIVE_GEAR;
    coupling[0].ratio = 3.0;
    coupling[0].efficiency = 0.8;
    integrate(2, 2, t, ROT_METHOD_NONE);
    ROT_CHECK(run.status == ROT_OK);
    NEAR(run.out.omega_rad_per_s[2], omega, 1e-12);
    const double lost = 0.1 * (400.0 - omega * omega) + 0.9 * (400.0 - omega * omega) / 9.0 +
                        (forward ? 3.0 : -3.0) * 0.5 * (20.0 + omega);
    NEAR(run.ledger.mesh_j[1], lost, 1e-10);
    ROT_CHECK(run.ledger.mesh_j[1] > 1.0);
  }
}

/* From rest without a contact the power flows forward, whichever way the torque pushes. */
static void a_lossy_gear_starts(void) {
  for (int way = -1; way <= 1; way += 2) {
    rot_drive_system s;
    double y[16] = {0.0};
    signed char mode[4] = {ROT_DRIVE_OPEN, ROT_DRIVE_OPEN, ROT_DRIVE_OPEN, ROT_DRIVE_OPEN};
    clear();
    rotor[0] = body(0.2, 3.0 * way, 0.0);
    rotor[1] = body(1.8, 0.0, 0.0);
    coupling[0].kind = ROT_DRIVE_GEAR;
    coupling[0].ratio = 3.0;
    coupling[0].efficiency = 0.8;
    const rot_drive_scene scene = scene_of(2);
    ROT_CHECK(rot_drive_system_new(&s, &scene) == ROT_OK);
    ROT_CHECK(rot_drive_forces(&s, 0.0, y, mode) == ROT_OK);
    ROT_CHECK_ULP(s.alpha[0], 3.0 / 0.45 * way, 4);
    ROT_CHECK_ULP(s.alpha[1], 1.0 / 0.45 * way, 4);
    ROT_CHECK_ULP(s.torque[0], 3.0 * 0.25 / 0.45 * way, 8); /* what the gear takes */
    rot_drive_system_free(&s);
  }
}

static void effects_are_seen(void) {
  clear();
  rotor[0] = body(1.0, 2.0, 0.0);
  rotor[1] = body(1.0, 0.0, 0.0);
  rotor[1].quadratic_n_m_s2 = 1.0;
  coupling[0].kind = ROT_DRIVE_SHAFT;
  coupling[0].ratio = 3.0;
  const rot_drive_scene scene = scene_of(2);
  const unsigned mask = rot_drive_constraint.effects_of(&scene);
  for (size_t i = 0; i < rot_drive_constraint.n_effects; i++) {
    const char *name = rot_drive_constraint.effects[i].name;
    const int want = !strcmp(name, "torque") || !strcmp(name, "shaft") || !strcmp(name, "gear") ||
                     !strcmp(name, "quadratic");
    ROT_CHECK_EQ_INT((mask >> i) & 1u, want);
  }
}

int main(void) {
  gears_reflect();
  contacts_fraction_a_load();
  one_slip_makes_another();
  nothing_acts_nothing_moves();
  what_slips_has_let_go();
  a_clutch_locks();
  a_brake_stops_a_geared_load();
  a_gear_loses_power();
  a_lossy_gear_starts();
  effects_are_seen();
  rot_events_free(&run.events);
  return rot_test_report("drive");
}
