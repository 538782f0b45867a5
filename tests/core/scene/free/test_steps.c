/* Steps of fixed length: the order of each method, in the attitude, omega and L; the errors that
 * they report; what they keep; rows between steps, breaks, the budget. */
#include "scene/free/steps.h"

#include <stdlib.h>

#include "free_rows.h"
#include "maths/attitude.h"
#include "scene/free/exact.h"
#include "scene/free/ode.h"
#include "engine/ode/fixed.h"
#include "rot_test.h"

static const rot_method methods[4] = {ROT_METHOD_EULER, ROT_METHOD_SEMI_IMPLICIT, ROT_METHOD_RK4,
                                      ROT_METHOD_SPLIT};

static rot_status steps(const rot_free_params *p, rot_method method, double step_s, size_t n,
                        const double t[], rows *r, rot_info *info) {
  const rot_free_columns out = columns_of(r);
  const rot_free_step_options options = {method, step_s, 100000000};
  double *flow[ROT_FREE_FLOWS];
  for (int k = 0; k < ROT_FREE_FLOWS; k++) flow[k] = flows[k];
  return rot_free_step_through(p, &options, n, t, &out, flow, flow_error, NULL, info);
}

/* The largest errors of the attitude, omega and L in space. */
static void difference(const rows *x, const rows *y, size_t n, double off[3]) {
  off[0] = off[1] = off[2] = 0.0;
  for (size_t i = 0; i < n; i++) {
    const double p[4] = {x->qw[i], x->qx[i], x->qy[i], x->qz[i]};
    const double q[4] = {y->qw[i], y->qx[i], y->qy[i], y->qz[i]};
    off[0] = fmax(off[0], rot_attitude_angle(p, q));
    off[1] = fmax(off[1], hypot(hypot(x->omega_x_rad_per_s[i] - y->omega_x_rad_per_s[i],
                                      x->omega_y_rad_per_s[i] - y->omega_y_rad_per_s[i]),
                                x->omega_z_rad_per_s[i] - y->omega_z_rad_per_s[i]));
    off[2] = fmax(
        off[2],
        hypot(hypot(x->angular_momentum_x_kg_m2_per_s[i] - y->angular_momentum_x_kg_m2_per_s[i],
                    x->angular_momentum_y_kg_m2_per_s[i] - y->angular_momentum_y_kg_m2_per_s[i]),
              x->angular_momentum_z_kg_m2_per_s[i] - y->angular_momentum_z_kg_m2_per_s[i]));
  }
}

/* The slope of the errors between two steps, and whether the report covers them, to a tenth. */
static void check_order(const char *name, const rot_free_params *p, rot_method method,
                        const rows *truth, double coarse, double ratio, const double t[]) {
  static rows r;
  double off[2][3];
  rot_info info;
  for (int k = 0; k < 2; k++) {
    ROT_CHECK_EQ_INT(steps(p, method, k ? coarse / ratio : coarse, ROWS, t, &r, &info), ROT_OK);
    difference(&r, truth, ROWS, off[k]);
    ROT_CHECK_EQ_INT(info.method, method);
    for (int i = 0; i < 3; i++) {
      ROT_CHECK(off[k][i] <= 1.1 * info.measure[i].error + 1e-14);
      const double rounding = rot_ode_fixed_rounding((double)info.steps);
      ROT_CHECK(off[k][i] + rounding * info.measure[i].largest >=
                0.8 * info.measure[i].error - 3e-12);
    }
  }
  for (int i = 0; i < 3; i++) {
    const double slope = log(off[0][i] / off[1][i]) / log(ratio);
    printf("%s, %s: %s off by %.1e, order %.2f\n", name, rot_method_name(method),
           rot_free_measures[i], off[1][i], slope);
    if (off[0][i] > 1e-12) { /* semi-implicit steps keep L of a free body */
      ROT_CHECK(fabs(slope - rot_free_step_order(method)) <=
                (method == ROT_METHOD_SPLIT ? 0.5 : 0.3));
    }
  }
}

/* Errors between 1e-2 and 1e-10, forwards and backwards; the times hit no step. */
static void check_orders(void) {
  static const double step[4] = {5e-4, 5e-4, 0.02, 0.2}, ratio[4] = {4.0, 4.0, 4.0, 2.0};
  static rows truth;
  double t[ROWS];
  rot_info info;
  for (int i = 0; i < ROWS; i++) t[i] = 0.1317 * i - 1.5;
  rot_free_params free = scene(1.0, 2.0, 3.0, 0.3, 2.0, 0.4);
  const double axes[4] = {0.5, -0.5, 0.1, 0.7}, q0[4] = {0.1, 0.2, -0.3, 0.4};
  free.turned = 1;
  for (int i = 0; i < 4; i++) free.axes[i] = axes[i], free.q0[i] = q0[i];
  rot_attitude_unit(free.axes);
  rot_attitude_unit(free.q0);
  const rot_free_columns out = columns_of(&truth);
  ROT_CHECK_EQ_INT(rot_free_exact(&free, ROWS, t, &out, NULL, NULL, &info), ROT_OK);
  for (int k = 0; k < 4; k++) check_order("free", &free, methods[k], &truth, step[k], ratio[k], t);
  rot_free_params damped = free;
  damped.damping_per_s = 0.2;
  ROT_CHECK_EQ_INT(rot_free_exact(&damped, ROWS, t, &out, NULL, NULL, &info), ROT_OK);
  for (int k = 0; k < 3; k++) {
    check_order("damped", &damped, methods[k], &truth, step[k], ratio[k], t);
  }
  /* a heavy asymmetric top; and torques between knots, in space */
  static const double knot_s[3] = {-0.4, 1.1, 2.3}, along[3] = {0.3, 0.9, -0.5};
  for (int kind = 0; kind < 2; kind++) {
    rot_free_params p = scene(1.0, 1.4, 2.2, 0.3, 0.2, 2.0);
    double *flow[ROT_FREE_FLOWS];
    const rot_free_ode_options options = {1e-13, 1000000, ROT_METHOD_NONE, 0.0};
    for (int i = 0; i < ROT_FREE_FLOWS; i++) flow[i] = flows[i];
    p.lever_n_m[0] = 0.2, p.lever_n_m[2] = 1.0;
    if (kind) {
      p.in_space = 1;
      p.n_knots = p.n_breaks = 3;
      p.knot_s = p.breaks_s = knot_s;
      for (int i = 0; i < 3; i++) p.knot_torque[i] = along;
    }
    ROT_CHECK_EQ_INT(
        rot_free_integrate(&p, &options, ROWS, t, &out, flow, flow_error, NULL, NULL, &info),
        ROT_OK);
    for (int k = 0; k < 4 - kind; k++) {
      check_order(kind ? "torque" : "top", &p, methods[k], &truth, step[k], ratio[k], t);
    }
  }
}

/* One row, within the first long step or after a few. */
static void check_few_steps(void) {
  static rows r, truth;
  const rot_free_params p = scene(1.0, 2.0, 3.0, 0.3, 2.0, 0.4);
  const rot_free_columns out = columns_of(&truth);
  for (int m = 0; m < 4; m++) {
    int missed = 0;
    for (int k = 1; k <= 60; k++) {
      const double t = 0.01 * k, h = 0.09;
      double off[3];
      rot_info info;
      ROT_CHECK_EQ_INT(rot_free_exact(&p, 1, &t, &out, NULL, NULL, &info), ROT_OK);
      ROT_CHECK_EQ_INT(steps(&p, methods[m], h, 1, &t, &r, &info), ROT_OK);
      difference(&r, &truth, 1, off);
      for (int i = 0; i < 3; i++) missed += off[i] > info.measure[i].error + 1e-14;
    }
    printf("%s: %d of 180 errors of few steps missed\n", rot_method_name(methods[m]), missed);
    ROT_CHECK(missed == 0);
  }
}

static double energy_of(const rot_free_params *p, const rows *r, size_t i) {
  const double q[4] = {r->qw[i], r->qx[i], r->qy[i], r->qz[i]};
  double lever[3];
  rot_attitude_to_space(q, p->lever_n_m, lever);
  return r->rotational_kinetic_energy_j[i] + lever[2];
}

/* Over 5000 s: the energy of the splitting swings within a bound, that of the others leaves it. */
static void check_drift(void) {
  static rows r;
  double t[ROWS], first = 0.0, last = 0.0;
  rot_info info;
  rot_free_params p = scene(1.0, 1.4, 2.2, 0.3, 0.2, 2.0);
  p.lever_n_m[0] = 0.2, p.lever_n_m[2] = 1.0;
  /* half of the rows early, half late */
  for (int i = 0; i < ROWS; i++) t[i] = 2.0 * i + (i < ROWS / 2 ? 0.0 : 4900.0);
  for (int k = 1; k < 4; k++) {
    const double step = k == 3 ? 0.25 : 0.05;
    first = last = 0.0;
    ROT_CHECK_EQ_INT(steps(&p, methods[k], step, ROWS, t, &r, &info), ROT_OK);
    for (size_t i = 0; i < ROWS; i++) {
      const double off = fabs(energy_of(&p, &r, i) - energy_of(&p, &r, 0));
      if (i < ROWS / 2) first = fmax(first, off);
      if (i >= ROWS / 2) last = fmax(last, off);
      /* the ledger has the change, the work says what gravity did */
      ROT_CHECK(fabs(r.rotational_kinetic_energy_j[i] - r.rotational_kinetic_energy_j[0] -
                     flows[0][i]) <= off + 1e-12);
      if (k > 0 && k != 2) { /* gravity has no moment about the vertical */
        ROT_CHECK(fabs(r.angular_momentum_z_kg_m2_per_s[i] - r.angular_momentum_z_kg_m2_per_s[0]) <=
                  2e-12);
      }
    }
    printf("%s: energy off by %.1e early, %.1e late\n", rot_method_name(methods[k]), first, last);
    if (k < 3) ROT_CHECK(last > 10.0 * first || last > 0.5);
    if (k == 3) ROT_CHECK(first > 1e-9 && first < 1e-4 && last < 2.0 * first);
  }
  /* explicit Euler gains in every step: |L|^2 grows by h^2 |L x omega|^2 */
  const rot_free_params free = scene(1.0, 2.0, 3.0, 0.3, 2.0, 0.4);
  const double two[2] = {0.0, 0.01};
  ROT_CHECK_EQ_INT(steps(&free, ROT_METHOD_EULER, 0.01, 2, two, &r, &info), ROT_OK);
  const double lx = 0.3, ly = 4.0, lz = 1.2, wx = 0.3, wy = 2.0, wz = 0.4;
  const double cross =
      pow(ly * wz - lz * wy, 2) + pow(lz * wx - lx * wz, 2) + pow(lx * wy - ly * wx, 2);
  const double was = lx * lx + ly * ly + lz * lz;
  const double is = pow(r.angular_momentum_x_kg_m2_per_s[1], 2) +
                    pow(r.angular_momentum_y_kg_m2_per_s[1], 2) +
                    pow(r.angular_momentum_z_kg_m2_per_s[1], 2);
  ROT_CHECK_REL(is, was + 1e-4 * cross, 1e-14);
}

/* A symmetric body: the splitting is exact. Steps given and default; budget; overflow. */
static void check_limits(void) {
  static rows r, truth;
  const double t[3] = {0.0, 1.0, 50.0};
  rot_info info;
  for (int k = 0; k < 2; k++) {
    const rot_free_params p = scene(1.0, k ? 2.0 : 1.0, 2.0, 0.3, 0.2, 2.0);
    const rot_free_columns out = columns_of(&truth);
    double off[3];
    ROT_CHECK_EQ_INT(rot_free_exact(&p, 3, t, &out, NULL, NULL, &info), ROT_OK);
    ROT_CHECK_EQ_INT(steps(&p, ROT_METHOD_SPLIT, 5.0, 3, t, &r, &info), ROT_OK);
    difference(&r, &truth, 3, off);
    ROT_CHECK(off[0] <= 2e-13 && off[1] <= 2e-13 && info.steps == 10);
  }
  rot_free_params p = scene(1.0, 2.0, 3.0, 0.0, 2.0, 0.0);
  const double turn = 3.14159265358979323846;
  ROT_CHECK_REL(rot_free_default_step(&p, ROT_METHOD_RK4, 1.0), turn / 64.0, 1e-14);
  ROT_CHECK_REL(rot_free_default_step(&p, ROT_METHOD_SPLIT, 1.0), turn / 32.0, 1e-14);
  p.lever_n_m[1] = 9.0;
  ROT_CHECK_REL(rot_free_default_step(&p, ROT_METHOD_RK4, 1.0), 2.0 * turn / 5.0 / 64.0, 1e-14);
  p = scene(1.0, 2.0, 3.0, 0.0, 0.0, 0.0);
  ROT_CHECK_REL(rot_free_default_step(&p, ROT_METHOD_RK4, 7.0), 7e-3, 1e-14);
  p = scene(1.0, 2.0, 3.0, 0.3, 2.0, 0.4);
  const rot_free_columns out = columns_of(&r);
  const rot_free_step_options few = {ROT_METHOD_RK4, 0.1, 100}, none = {ROT_METHOD_RK4, 0.0, 100};
  double *flow[ROT_FREE_FLOWS];
  for (int k = 0; k < ROT_FREE_FLOWS; k++) flow[k] = flows[k];
  ROT_CHECK_EQ_INT(rot_free_step_through(&p, &few, 3, t, &out, flow, flow_error, NULL, &info),
                   ROT_EBUDGET);
  ROT_CHECK(info.rows_done == 2 && info.time_s <= 10.01);
  ROT_CHECK_EQ_INT(rot_free_step_through(&p, &none, 3, t, &out, flow, flow_error, NULL, &info),
                   ROT_EVALUE);
  ROT_CHECK_EQ_INT(steps(&p, ROT_METHOD_EULER, 1.0, 3, t, &r, &info), ROT_ERANGE);
  ROT_CHECK(info.rows_done == 2);
}

int main(void) {
  check_orders();
  check_few_steps();
  check_drift();
  check_limits();
  return rot_test_report("free_steps");
}
