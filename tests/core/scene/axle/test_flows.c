/* Work, heat and impulses of closed forms, against formulas on paper. */
#include "scene/axle/flows.h"

#include <math.h>
#include <string.h>

#include "rot_test.h"
#include "scene/axle/bands.h"
#include "scene/axle/drag.h"
#include "scene/axle/linear.h"
#include "scene/axle/pendulum.h"
#include "scene/axle/skater.h"

enum { ROWS = 4, FLOWS = ROT_AXLE_FLOWS };

static double flow[FLOWS][ROWS], error[FLOWS];
static double *const value[FLOWS] = {flow[0], flow[1], flow[2], flow[3], flow[4], flow[5], flow[6]};
static const rot_axle_flows flows = {value, error};

static rot_axle_scene bare(double inertia, double omega0) {
  rot_axle_scene scene;
  memset(&scene, 0, sizeof scene);
  scene.linear.inertia_kg_m2 = inertia;
  scene.linear.omega0_rad_per_s = omega0;
  return scene;
}

/* The flows of a motion, with its last row's kinetic energy. */
static double run(const rot_axle_scene *solved, const rot_axle_scene *acts, rot_axle_model model,
                  const double t[ROWS]) {
  static double column[7][ROWS];
  const rot_axle_columns out = {column[0], column[1], column[2], column[3],
                                column[4], column[5], column[6]};
  rot_events events = {0};
  rot_info info;
  memset(flow, 0x5a, sizeof flow);
  ROT_CHECK_EQ_INT(model(solved, ROWS, t, &out, &events, NULL, &info), ROT_OK);
  const rot_axle_motion motion = {solved, acts, model, &events, &info};
  ROT_CHECK_EQ_INT(rot_axle_flows_of(&motion, ROWS, t, &flows, NULL), ROT_OK);
  rot_events_free(&events);
  return column[6][ROWS - 1];
}

static void check_friction(void) {
  const double t[ROWS] = {0.0, 1.0, 5.0, 8.0}, turned[ROWS] = {0.0, 9.0, 25.0, 25.0};
  rot_axle_scene scene = bare(2.0, 10.0);
  scene.coulomb_n_m = scene.static_n_m = 4.0;
  (void)run(&scene, &scene, rot_axle_drag, t);
  for (int i = 0; i < ROWS; i++) {
    ROT_CHECK_REL(flow[ROT_AXLE_FLOW_COULOMB][i], 4.0 * turned[i], 1e-14);
    ROT_CHECK_REL(flow[ROT_AXLE_FLOW_DAMPING][i], -4.0 * fmin(t[i], 5.0), 1e-14);
    ROT_CHECK(flow[ROT_AXLE_FLOW_WORK][i] == 0.0 && flow[ROT_AXLE_FLOW_VISCOUS][i] == 0.0);
  }
  ROT_CHECK(error[ROT_AXLE_FLOW_COULOMB] > 1e-14 && error[ROT_AXLE_FLOW_COULOMB] < 1e-11);
  /* From the second row on: the flows begin there. */
  const double late[ROWS] = {1.0, 2.0, 3.0, 4.0};
  (void)run(&scene, &scene, rot_axle_drag, late);
  ROT_CHECK(flow[ROT_AXLE_FLOW_COULOMB][0] == 0.0);
  ROT_CHECK_REL(flow[ROT_AXLE_FLOW_COULOMB][3], 4.0 * (24.0 - 9.0), 1e-14);
}

/* L = 12: from 4 to 1 kg m^2 at 1 s, then in a straight line to 3 at 3 s. A row at the jump is
 * after it. */
static void check_inertia(void) {
  const double t[ROWS] = {0.0, 0.5, 1.0, 3.0};
  const double knot_s[] = {0.0, 1.0, 1.0, 3.0}, moment[] = {4.0, 4.0, 1.0, 3.0};
  const double want[ROWS] = {0.0, 0.0, 72.0 * (1.0 - 0.25), 72.0 * (1.0 / 3.0 - 0.25)};
  rot_axle_scene scene = bare(4.0, 3.0);
  scene.n_inertia = 4;
  scene.inertia_time_s = knot_s;
  scene.inertia_kg_m2 = moment;
  scene.n_breaks = 4;
  scene.breaks_s = knot_s;
  (void)run(&scene, &scene, rot_axle_skater, t);
  for (int i = 0; i < ROWS; i++) ROT_CHECK_REL(flow[ROT_AXLE_FLOW_INERTIA][i], want[i], 1e-14);
  /* An integrator comes to the jump from before, and leaves it to the caller. */
  const double momentum[ROWS] = {12.0, 12.0, 12.0, 12.0};
  memset(flow, 0, sizeof flow);
  rot_axle_flows_jumps(&scene, ROWS, t, momentum, &flows);
  ROT_CHECK_REL(flow[ROT_AXLE_FLOW_INERTIA][2], 54.0, 1e-15);
  ROT_CHECK(flow[ROT_AXLE_FLOW_INERTIA][1] == 0.0 && flow[ROT_AXLE_FLOW_INERTIA][3] == 0.0);
  /* One at the start is no part of what is before it. */
  const double before[ROWS] = {0.5, 1.0, 2.0, 3.0};
  scene.linear.start_s = 1.0;
  scene.linear.inertia_kg_m2 = 1.0;
  scene.linear.omega0_rad_per_s = 12.0;
  memset(flow, 0, sizeof flow);
  rot_axle_flows_jumps(&scene, ROWS, before, momentum, &flows);
  ROT_CHECK_REL(flow[ROT_AXLE_FLOW_INERTIA][0], -54.0, 1e-15);
  ROT_CHECK(flow[ROT_AXLE_FLOW_INERTIA][1] == 0.0 && flow[ROT_AXLE_FLOW_INERTIA][2] == 0.0);
}

/* 3 N m at rest, falling by 1/2 for each rad/s up to 4 rad/s, then constant: omega = 6 (1 -
 * exp(-t/2)) up to 2 ln 3, and 4 + (t - 2 ln 3) after. The panels must end at that kink. */
static void check_curve(void) {
  const double t[ROWS] = {0.0, 1.0, 2.0, 5.0}, kink = 2.0 * log(3.0);
  const double points[] = {3.0, 0.0, 4.0, 9.0, 3.0, 1.0, 1.0};
  const rot_term curve = {ROT_TERM_CURVE, -INFINITY, INFINITY, 7, points};
  rot_axle_scene scene = bare(1.0, 0.0);
  scene.n_terms = 1;
  scene.terms = &curve;
  const double kinetic = run(&scene, &scene, rot_axle_bands, t);
  ROT_CHECK_REL(flow[ROT_AXLE_FLOW_WORK][1], 0.5 * pow(6.0 * (1.0 - exp(-0.5)), 2.0), 1e-13);
  ROT_CHECK_REL(flow[ROT_AXLE_FLOW_WORK][3], 0.5 * pow(4.0 + 5.0 - kink, 2.0), 1e-13);
  ROT_CHECK_REL(flow[ROT_AXLE_FLOW_WORK][3], kinetic, 1e-13);
  ROT_CHECK_REL(flow[ROT_AXLE_FLOW_IMPULSE][3], 9.0 - kink, 1e-13);
  ROT_CHECK(error[ROT_AXLE_FLOW_WORK] < 1e-11);
}

/* A scene that is solved without its resistance: heat of what was left out, along that motion. */
static void check_left_out(void) {
  const double t[ROWS] = {1.0, 2.0, 3.0, 4.0};
  const rot_axle_scene solved = bare(2.0, -5.0);
  rot_axle_scene whole = solved;
  whole.viscous_n_m_s = 0.5;
  whole.quadratic_n_m_s2 = 0.25;
  whole.coulomb_n_m = 2.0;
  (void)run(&solved, &whole, rot_axle_free_scene, t);
  ROT_CHECK_REL(flow[ROT_AXLE_FLOW_VISCOUS][3], 3.0 * 0.5 * 25.0, 1e-14);
  ROT_CHECK_REL(flow[ROT_AXLE_FLOW_QUADRATIC][3], 3.0 * 0.25 * 125.0, 1e-14);
  ROT_CHECK_REL(flow[ROT_AXLE_FLOW_COULOMB][3], 3.0 * 2.0 * 5.0, 1e-14);
  ROT_CHECK_REL(flow[ROT_AXLE_FLOW_DAMPING][3], 3.0 * (0.5 * 5.0 + 0.25 * 25.0 + 2.0), 1e-14);
  (void)run(&solved, &solved, rot_axle_free_scene, t);
  for (int k = 0; k < FLOWS; k++) ROT_CHECK(flow[k][3] == 0.0);
}

/* 6 N m of the shafts on 2 kg m^2, of which gears leave 4: what stands for them is a torque of 5
 * and dry friction of 1, with a viscous coefficient of 0.3 where the bearings have 0.1. */
static void check_gears(void) {
  const double t[ROWS] = {2.0, 3.0, 4.0, 6.0}, theta[ROWS] = {1.0, 2.0, 5.0, 11.0};
  const rot_axle_gears gears = {6.0, 2.0, 0.0, 0.1, 0.1};
  rot_axle_scene scene = bare(2.0, 0.0);
  scene.viscous_n_m_s = 0.3;
  scene.coulomb_n_m = scene.static_n_m = 1.0;
  memset(flow, 0, sizeof flow);
  for (int i = 0; i < ROWS; i++) {
    const double turned = theta[i] - theta[0];
    flow[ROT_AXLE_FLOW_WORK][i] = 5.0 * turned;
    flow[ROT_AXLE_FLOW_COULOMB][i] = turned;
    flow[ROT_AXLE_FLOW_VISCOUS][i] = 0.3 * i;
    flow[ROT_AXLE_FLOW_IMPULSE][i] = 5.0 * (t[i] - t[0]);
  }
  rot_axle_flows_geared(&scene, &gears, ROWS, t, theta, &flows);
  ROT_CHECK_REL(flow[ROT_AXLE_FLOW_WORK][3], 60.0, 1e-15);
  ROT_CHECK_REL(flow[ROT_AXLE_FLOW_VISCOUS][3], 0.3, 1e-15);
  ROT_CHECK_REL(flow[ROT_AXLE_FLOW_COULOMB][3], 10.0 + 10.0 + 0.6, 1e-15);
  ROT_CHECK_REL(flow[ROT_AXLE_FLOW_IMPULSE][3], 24.0, 1e-15);
  ROT_CHECK_REL(flow[ROT_AXLE_FLOW_DAMPING][3], -4.0, 1e-15);
}

int main(void) {
  check_friction();
  check_inertia();
  check_curve();
  check_left_out();
  check_gears();
  return rot_test_report("axle flows");
}
