/* Closed forms of drives against the integrator, by rows, heat and ledger. */
#include "scene/drive/exact.h"

#include "scene/drive/ledger.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "rot_test.h"

enum { MAX = 4, ROWS = 9 };

static rot_axle_scene rotor[MAX];
static rot_drive_friction brake[MAX];
static rot_drive_coupling coupling[MAX];

static void clear(size_t n) {
  memset(brake, 0, sizeof brake);
  memset(coupling, 0, sizeof coupling);
  memset(rotor, 0, sizeof rotor);
  for (size_t i = 0; i < n; i++) {
    coupling[i].ratio = 1.0;
    rotor[i].linear.inertia_kg_m2 = 1.0 + 0.5 * (double)i;
  }
}

static void torque(size_t i, double n_m) {
  rotor[i].linear.torque.before_n_m = rotor[i].linear.torque.after_n_m = n_m;
}

/* The rates of a chain of gears agree. */
static void turn(size_t n, double omega) {
  for (size_t i = 0; i < n; i++) {
    rotor[i].linear.omega0_rad_per_s = omega;
    rotor[i].linear.theta0_rad = 0.1 * (double)i;
    omega /= coupling[i].ratio;
  }
}

typedef struct rows {
  double column[9][ROWS * MAX], sum[10][ROWS];
  int locked[ROWS * MAX];
  rot_drive_columns out;
  rot_drive_ledger ledger;
  rot_events events;
  rot_info info;
} rows;

static void open_rows(rows *r) {
  double **column[] = {&r->out.theta_rad,
                       &r->out.omega_rad_per_s,
                       &r->out.angular_momentum_kg_m2_per_s,
                       &r->out.rotational_kinetic_energy_j,
                       &r->out.applied_torque_n_m,
                       &r->out.damping_torque_n_m,
                       &r->out.coupling_torque_n_m,
                       &r->out.heat_j,
                       &r->out.coupling_heat_j};
  size_t k = 0;
  memset(r, 0, sizeof *r);
  for (int i = 0; i < 9; i++) *column[i] = r->column[i];
  r->out.locked = r->locked;
#define X(name) r->ledger.name = r->sum[k++];
  ROT_DRIVE_LEDGER(X)
#undef X
}

static void close_rows(rows *r) { rot_events_free(&r->events); }

static int near(double got, double want, double by) { return fabs(got - want) <= by; }

static void compare(size_t n, rot_drive_form form, double start_s, double first_s) {
  static rows exact, by_steps;
  const rot_drive_scene scene = {
      .n = n, .rotor = rotor, .brake = brake, .coupling = coupling, .start_s = start_s};
  const rot_drive_ode_options options = {1e-12, 100000, ROT_METHOD_RK8PD, 0.0, 0.0};
  double t[ROWS];
  for (size_t i = 0; i < n; i++) rotor[i].linear.start_s = start_s;
  for (int i = 0; i < ROWS; i++) t[i] = first_s + 0.4 * i;
  const rot_query query = {ROWS, t, 1e-12, 0.0};
  open_rows(&exact);
  open_rows(&by_steps);
  ROT_CHECK(rot_drive_exact_why_not(&scene, form, &query) == NULL);
  for (int f = 0; f < ROT_DRIVE_FORMS; f++) {
    if (f != (int)form) ROT_CHECK(rot_drive_exact_why_not(&scene, (rot_drive_form)f, &query));
  }
  ROT_CHECK_EQ_INT(rot_drive_exact(&scene, form, ROWS, t, &exact.out, &exact.ledger, &exact.events,
                                   NULL, &exact.info),
                   ROT_OK);
  ROT_CHECK_EQ_INT(rot_drive_integrate(&scene, &options, ROWS, t, &by_steps.out, &by_steps.ledger,
                                       &by_steps.events, NULL, &by_steps.info),
                   ROT_OK);
  ROT_CHECK(rot_info_error(&exact.info) <= 1e-12);
  for (size_t c = 0; c < 9; c++) {
    double size = 1e-3;
    for (size_t i = 0; i < ROWS * n; i++) {
      const int last = (i + 1) % n == 0 && (c == 6 || c == 8);
      if (!last) size = fmax(size, fabs(by_steps.column[c][i]));
    }
    for (size_t i = 0; i < ROWS * n; i++) {
      if ((i + 1) % n == 0 && (c == 6 || c == 8)) continue;
      ROT_CHECK(near(exact.column[c][i], by_steps.column[c][i], 3e-10 * size));
    }
  }
  for (size_t i = 0; i < ROWS * n; i++) {
    if ((i + 1) % n) ROT_CHECK_EQ_INT(exact.locked[i], by_steps.locked[i]);
  }
  const rot_drive_ledger *a = &exact.ledger, *b = &by_steps.ledger;
  const double error[] = {a->work_error_j + b->work_error_j, a->heat_error_j + b->heat_error_j,
                          a->impulse_error_n_m_s + b->impulse_error_n_m_s,
                          a->elastic_error_j + b->elastic_error_j};
  for (size_t k = 0; k < 10; k++) {
    const size_t of = k == 0 ? 0 : k < 6 ? 1 : k < 9 ? 2 : 3;
    for (size_t i = 0; i < ROWS; i++) {
      ROT_CHECK(near(exact.sum[k][i], by_steps.sum[k][i], error[of] + 1e-14));
    }
  }
  ROT_CHECK(a->work_error_j <= 1e-10 && a->heat_error_j <= 1e-10);
  ROT_CHECK_EQ_INT((long long)exact.events.count, (long long)by_steps.events.count);
  for (size_t i = 0; i < exact.events.count && i < by_steps.events.count; i++) {
    ROT_CHECK(near(exact.events.time_s[i], by_steps.events.time_s[i], 1e-9));
    ROT_CHECK_EQ_INT(exact.events.place[i], by_steps.events.place[i]);
  }
  close_rows(&exact);
  close_rows(&by_steps);
}

/* Gears, a wave, a ramp and a polynomial behind ratios, a motor, resistance; forward and back. */
static void check_gears(void) {
  const double wave[] = {2.0, 3.0, 0.5}, ramp_s[] = {0.5, 2.0}, ramp[] = {0.0, 3.0};
  const double pieces[] = {1.0, 2.0, 0.0, 2.5, 0.5, -0.25};
  const rot_term terms[] = {{ROT_TERM_SINUSOID, -INFINITY, INFINITY, 3, wave},
                            {ROT_TERM_POLYNOMIAL, -INFINITY, INFINITY, 6, pieces}};
  const double breaks[] = {0.0, 0.5, 2.0, 2.5};
  for (int back = 0; back < 2; back++) {
    clear(3);
    for (int i = 0; i < 2; i++) coupling[i].kind = ROT_DRIVE_GEAR;
    coupling[0].ratio = -2.0;
    coupling[1].ratio = 0.4;
    rotor[1].n_terms = 2;
    rotor[1].terms = terms;
    rotor[2].linear.torque =
        (rot_torque){.n = 2, .time_s = ramp_s, .torque_n_m = ramp, .after_n_m = 3.0};
    rotor[0].motor_n_m_s = 0.3;
    rotor[0].linear.viscous_n_m_s = 0.3;
    torque(0, 5.0);
    rotor[2].viscous_n_m_s = 0.2;
    rotor[2].linear.viscous_n_m_s = 0.2;
    for (int i = 0; i < 3; i++) rotor[i].n_breaks = 4, rotor[i].breaks_s = breaks;
    turn(3, 1.5);
    compare(3, ROT_DRIVE_AS_AXLE, 0.0, back ? -1.0 : 0.25);
  }
}

/* A clutch between two pairs of gears, engaged late, with a torque that jumps. */
static void check_clutch(void) {
  const double jump_s[] = {1.0, 1.0}, jump[] = {4.0, -3.0};
  clear(4);
  coupling[0].kind = coupling[2].kind = ROT_DRIVE_GEAR;
  coupling[0].ratio = 2.0;
  coupling[1].ratio = 1.5;
  coupling[2].ratio = -0.5;
  coupling[1].kind = ROT_DRIVE_CLUTCH;
  coupling[1].friction.acts = 1;
  coupling[1].friction.law.linear.inertia_kg_m2 = 1.0;
  coupling[1].friction.law.linear.torque.before_n_m = 6.0;
  coupling[1].friction.law.linear.torque.after_n_m = 6.0;
  coupling[1].friction.static_ratio = 1.2;
  coupling[1].friction.from_s = 0.3;
  coupling[1].friction.to_s = INFINITY;
  rotor[0].linear.torque = (rot_torque){
      .n = 2, .time_s = jump_s, .torque_n_m = jump, .before_n_m = 4.0, .after_n_m = -3.0};
  rotor[0].n_breaks = 1;
  rotor[0].breaks_s = jump_s;
  torque(3, 1.0);
  turn(2, 8.0);
  rotor[2].linear.omega0_rad_per_s = -1.0;
  rotor[3].linear.omega0_rad_per_s = 2.0;
  compare(4, ROT_DRIVE_AS_CLUTCH, 0.0, 0.0);
}

/* Two shafts and a gear; damped in proportion, unevenly, not at all. */
static void check_shafts(void) {
  for (int damped = 0; damped < 3; damped++) {
    clear(4);
    coupling[0] =
        (rot_drive_coupling){.kind = ROT_DRIVE_SHAFT, .ratio = 1.5, .stiffness_n_m_per_rad = 40.0};
    coupling[1].kind = ROT_DRIVE_GEAR;
    coupling[1].ratio = -0.5;
    coupling[2] =
        (rot_drive_coupling){.kind = ROT_DRIVE_SHAFT, .ratio = 1.0, .stiffness_n_m_per_rad = 60.0};
    coupling[0].damping_n_m_s = damped == 0 ? 0.0 : 0.4;
    coupling[2].damping_n_m_s = damped == 1 ? 0.6 : 0.0;
    torque(0, 2.0);
    torque(2, -1.0);
    rotor[0].linear.omega0_rad_per_s = 1.0;
    rotor[1].linear.omega0_rad_per_s = 0.5;
    rotor[2].linear.omega0_rad_per_s = -1.0;
    rotor[1].linear.theta0_rad = 0.2;
    compare(4, ROT_DRIVE_AS_SHAFT, 0.5, damped == 0 ? -0.3 : 0.5);
  }
}

/* Energy and momentum stay unless something acts: each cause alone is told. */
static void check_conserved(void) {
  enum { ENERGY = 0, MOMENTUM = 1 };
  const char *why[ROT_MAX_CAUSES];
  for (int cause = -1; cause < 8; cause++) {
    clear(2);
    coupling[0] = (rot_drive_coupling){
        .kind = ROT_DRIVE_SHAFT, .ratio = cause == 7 ? 2.0 : 1.0, .stiffness_n_m_per_rad = 40.0};
    if (cause == 0) rotor[1].viscous_n_m_s = 0.1;
    if (cause == 1) rotor[0].quadratic_n_m_s2 = 0.1;
    if (cause == 2) rotor[1].coulomb_n_m = 0.1;
    if (cause == 3) rotor[0].static_n_m = 0.1;
    if (cause == 4) torque(1, 0.1);
    if (cause == 5) coupling[0].damping_n_m_s = 0.1;
    if (cause == 6) coupling[0].kind = ROT_DRIVE_CLUTCH;
    const rot_drive_scene scene = {.n = 2, .rotor = rotor, .brake = brake, .coupling = coupling};
    const size_t energy = cause >= 0 && cause < 7,
                 momentum = cause >= 0 && (cause < 5 || cause == 7);
    ROT_CHECK_EQ_INT(rot_drive_conserved(&scene, ENERGY, why), energy);
    if (cause >= 0 && cause < 4) ROT_CHECK(strstr(why[0], "resistance") != NULL);
    ROT_CHECK_EQ_INT(rot_drive_conserved(&scene, MOMENTUM, why), momentum);
  }
}

int main(void) {
  check_gears();
  check_clutch();
  check_shafts();
  check_conserved();
  return rot_test_report("drive exact");
}
