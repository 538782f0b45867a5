/* Scenes of a free body: closed form and integration against each other and against motions known
 * by hand, in principal axes and in others; damping; torques; flips; the ledger. */
#include <stdlib.h>

#include "free_rows.h"
#include "maths/attitude.h"
#include "scene/choice.h"
#include "scene/free/exact.h"
#include "scene/free/ledger.h"
#include "scene/free/models.h"
#include "scene/free/motion.h"
#include "scene/free/ode.h"
#include "rot_test.h"

static double off(const rows *x, const rows *y, size_t n) {
  double worst = 0.0;
  for (size_t i = 0; i < n; i++) worst = fmax(worst, angle_between(x, y, i));
  return worst;
}

static double off_omega(const rows *x, const rows *y, size_t n) {
  double worst = 0.0;
  for (size_t i = 0; i < n; i++) {
    worst = fmax(worst, hypot(hypot(x->omega_x_rad_per_s[i] - y->omega_x_rad_per_s[i],
                                    x->omega_y_rad_per_s[i] - y->omega_y_rad_per_s[i]),
                              x->omega_z_rad_per_s[i] - y->omega_z_rad_per_s[i]));
  }
  return worst;
}

static rot_status exact(const rot_free_params *p, size_t n, const double t[], rows *r,
                        rot_events *events, rot_info *info) {
  const rot_free_columns out = columns_of(r);
  return rot_free_exact(p, n, t, &out, events, NULL, info);
}

/* Undamped and damped, forwards and backwards, in principal axes and in others. */
static void check_exact_and_integrated(void) {
  static rows x, y;
  double t[ROWS];
  int beyond = 0; /* estimates are no bounds: one of the 32 may be exceeded, by less than itself */
  for (int i = 0; i < ROWS; i++) t[i] = 0.5 * i - 6.0;
  for (int k = 0; k < 8; k++) {
    rot_free_params p = scene(1.0, 2.0, 2.7, 0.4, 1.1, -0.6);
    if (k & 1) p.damping_per_s = 0.07;
    if (k & 2) {
      p.turned = 1;
      const double axes[4] = {0.5, -0.5, 0.1, 0.7}, q0[4] = {0.1, 0.2, -0.3, 0.4};
      for (int i = 0; i < 4; i++) p.axes[i] = axes[i], p.q0[i] = q0[i];
      rot_attitude_unit(p.axes);
      rot_attitude_unit(p.q0);
    }
    if (k & 4) p.start_s = -2.25;
    rot_info by_form, by_steps;
    ROT_CHECK_EQ_INT(exact(&p, ROWS, t, &x, NULL, &by_form), ROT_OK);
    for (int method = 0; method < 2; method++) {
      ROT_CHECK_EQ_INT(integrated(&p, 1e-11, method ? ROT_METHOD_RADAU : ROT_METHOD_NONE, ROWS, t,
                                  &y, NULL, &by_steps),
                       ROT_OK);
      const rot_measure *m = by_steps.measure;
      const double angle = off(&x, &y, ROWS), omega = off_omega(&x, &y, ROWS);
      printf("free %d: angle %.1e (said %.1e, exact %.1e), omega %.1e (said %.1e)\n", k, angle,
             m[0].error, by_form.measure[0].error, omega, m[1].error);
      const double of_angle = m[0].error + by_form.measure[0].error,
                   of_omega = m[1].error + by_form.measure[1].error;
      beyond += (angle > of_angle) + (omega > of_omega);
      ROT_CHECK(angle <= 2.0 * of_angle && omega <= 2.0 * of_omega && m[0].error < 1e-10);
      ROT_CHECK(by_form.measure[0].error <= (k & 2 ? 1e-12 : 5e-14)); /* rounded turns */
      /* the ledger of the steps is that of the closed form */
      double want[ROT_FREE_FLOWS];
      rot_free_flows(&p, p.start_s, t[ROWS - 1], want);
      for (int f = 0; f < ROT_FREE_FLOWS; f++) {
        ROT_CHECK(fabs(flows[f][ROWS - 1] - want[f]) <= flow_error[f] + 1e-13);
      }
    }
  }
  ROT_CHECK(beyond <= 1);
}

/* A steady torque along an axis of a ball: omega grows evenly, the angle as its square. In space
 * axes the same from any attitude. */
static void check_torque_on_a_ball(void) {
  static rows r;
  const double t[4] = {-1.0, 0.0, 1.0, 3.0};
  rot_free_params p = scene(2.0, 2.0, 2.0, 0.0, 0.0, 0.5);
  rot_info info;
  p.torque[2] = 0.8;
  for (int space = 0; space < 2; space++) {
    p.in_space = space;
    if (space) { /* the body's z along -x of space: a torque along -x */
      const double q0[4] = {0.7071067811865476, 0.0, -0.7071067811865476, 0.0};
      for (int i = 0; i < 4; i++) p.q0[i] = q0[i];
      p.torque[0] = -0.8, p.torque[2] = 0.0;
    }
    ROT_CHECK_EQ_INT(integrated(&p, 1e-12, ROT_METHOD_NONE, 4, t, &r, NULL, &info), ROT_OK);
    for (int i = 0; i < 4; i++) {
      const double omega = 0.5 + 0.4 * t[i], angle = 0.5 * t[i] + 0.2 * t[i] * t[i];
      ROT_CHECK(fabs(r.omega_z_rad_per_s[i] - omega) <= 1e-12);
      const double turn[4] = {cos(0.5 * angle), 0.0, 0.0, sin(0.5 * angle)};
      double want[4], got[NUMBERS];
      rot_attitude_times(p.q0, turn, want);
      row_of(&r, (size_t)i, got);
      ROT_CHECK(rot_attitude_angle(want, got) <= 1e-11);
      ROT_CHECK(fabs(flows[0][i] - (omega * omega - 0.25)) <= 1e-11); /* 2/2 omega^2 */
      ROT_CHECK(fabs(flows[space ? 2 : 4][i] - (space ? -0.8 : 0.8) * t[i]) <= 1e-12);
    }
  }
}

/* Knots: a triangle of area 1 about y; the function of the caller says the same. */
static rot_status triangle(double t, const double omega[3], const double q[4], double torque[3],
                           void *ctx) {
  (void)omega, (void)q;
  (*(long *)ctx)++;
  torque[0] = torque[2] = 0.0;
  torque[1] = t < 0.0 || t > 2.0 ? 0.0 : t < 1.0 ? t : 2.0 - t;
  return ROT_OK;
}

static void check_knots_and_law(void) {
  static rows x, y;
  const double t[] = {-1.0, 0.5, 1.0, 1.5, 2.0, 6.0}, knot[] = {0.0, 1.0, 2.0};
  const double zero[] = {0.0, 0.0, 0.0}, up[] = {0.0, 1.0, 0.0};
  rot_free_params p = scene(1.0, 2.0, 2.5, 0.3, 0.2, 0.1);
  long calls = 0;
  rot_info info;
  p.n_knots = p.n_breaks = 3;
  p.knot_s = p.breaks_s = knot;
  p.knot_torque[0] = p.knot_torque[2] = zero;
  p.knot_torque[1] = up;
  ROT_CHECK_EQ_INT(integrated(&p, 1e-11, ROT_METHOD_NONE, 6, t, &x, NULL, &info), ROT_OK);
  p.n_knots = 0;
  p.law = triangle;
  p.ctx = &calls;
  ROT_CHECK_EQ_INT(integrated(&p, 1e-11, ROT_METHOD_NONE, 6, t, &y, NULL, &info), ROT_OK);
  ROT_CHECK(calls > 0 && off(&x, &y, 6) <= 1e-9 && off_omega(&x, &y, 6) <= 1e-9);
  /* after 2 s nothing acts: L in space stays */
  ROT_CHECK(fabs(x.angular_momentum_y_kg_m2_per_s[5] - x.angular_momentum_y_kg_m2_per_s[4]) <=
            1e-10);
  p = scene(3.0, 3.0, 3.0, 0.0, 0.0, 0.0);
  p.n_knots = p.n_breaks = 3;
  p.knot_s = p.breaks_s = knot;
  p.knot_torque[0] = p.knot_torque[2] = zero;
  p.knot_torque[1] = up;
  ROT_CHECK_EQ_INT(integrated(&p, 1e-12, ROT_METHOD_NONE, 6, t, &x, NULL, &info), ROT_OK);
  ROT_CHECK(fabs(x.omega_y_rad_per_s[5] - 1.0 / 3.0) <= 1e-13);
  ROT_CHECK(fabs(x.omega_y_rad_per_s[1] - 0.125 / 3.0) <= 1e-13);
}

/* Principia's body and a second one: the times between zeros of omega2. */
static void check_flips(void) {
  static rows r;
  const double moment[][3] = {{3.0, 5.0, 9.0}, {1.0, 2.0, 3.0}};
  const double omega[][3] = {{0.0, 0.4, 0.0011111111111111111}, {0.01, 4.0, 0.01}};
  const double want[] = {59.05544352, 6.08915246};
  for (int k = 0; k < 2; k++) {
    double time_s;
    ROT_CHECK_EQ_INT(rot_free_flip_time(moment[k], omega[k], &time_s), ROT_OK);
    ROT_CHECK_REL(time_s, want[k], 2e-9);
    rot_free_params p =
        scene(moment[k][0], moment[k][1], moment[k][2], omega[k][0], omega[k][1], omega[k][2]);
    const double t[2] = {-3.0, 5.2 * time_s};
    rot_events by_form = {0}, by_steps = {0};
    rot_info info;
    ROT_CHECK_EQ_INT(exact(&p, 2, t, &r, &by_form, &info), ROT_OK);
    ROT_CHECK_EQ_INT(integrated(&p, 1e-11, ROT_METHOD_NONE, 2, t, &r, &by_steps, &info), ROT_OK);
    ROT_CHECK(by_form.count >= 5 && by_form.count == by_steps.count);
    for (size_t i = 0; i < by_form.count && i < by_steps.count; i++) {
      ROT_CHECK(by_form.event[i] == ROT_EVENT_FLIP);
      ROT_CHECK(fabs(by_form.time_s[i] - by_steps.time_s[i]) <= 1e-5);
      if (i) ROT_CHECK_REL(by_form.time_s[i] - by_form.time_s[i - 1], time_s, 1e-12);
      double at = by_form.time_s[i];
      ROT_CHECK_EQ_INT(exact(&p, 1, &at, &r, NULL, &info), ROT_OK);
      ROT_CHECK(fabs(r.omega_y_rad_per_s[0]) <= 1e-12);
    }
    rot_events_free(&by_form);
    rot_events_free(&by_steps);
  }
  /* a wobble about the longest axis is none; damping delays them, and ends them */
  rot_free_params p = scene(1.0, 2.0, 3.0, 0.1, 0.1, 4.0);
  const double t[2] = {0.0, 100.0};
  rot_events none = {0}, late = {0};
  rot_info info;
  ROT_CHECK_EQ_INT(exact(&p, 2, t, &r, &none, &info), ROT_OK);
  ROT_CHECK_EQ_INT(integrated(&p, 1e-9, ROT_METHOD_NONE, 2, t, &r, &none, &info), ROT_OK);
  ROT_CHECK(none.count == 0);
  p = scene(1.0, 2.0, 3.0, 0.01, 4.0, 0.01);
  p.damping_per_s = 0.1;
  ROT_CHECK_EQ_INT(exact(&p, 2, t, &r, &late, &info), ROT_OK);
  ROT_CHECK(late.count == 2 && late.time_s[0] > 3.4);
  const double s = -expm1(-0.1 * late.time_s[0]) / 0.1;
  p.damping_per_s = 0.0;
  ROT_CHECK_EQ_INT(exact(&p, 1, &s, &r, NULL, &info), ROT_OK);
  ROT_CHECK(fabs(r.omega_y_rad_per_s[0]) <= 1e-12);
  rot_events_free(&none);
  rot_events_free(&late);
}

/* The choice: closed form without torque, steps with one; a rod not by steps. */
static void check_choice(void) {
  const double t[2] = {0.0, 10.0};
  const rot_query query = {2, t, 1e-9, 0.0};
  rot_candidate all[ROT_MAX_MODELS];
  rot_free_params p = scene(1.0, 2.0, 2.7, 0.4, 1.1, -0.6);
  p.damping_per_s = 0.1;
  ROT_CHECK(rot_choice_constraint("free") == &rot_free_constraint);
  ROT_CHECK(rot_choice_pick(&rot_free_constraint, &p, &query, all) == 1);
  ROT_CHECK(strcmp(all[0].model->id, "free_exact") == 0);
  p.torque[0] = 1e-3;
  ROT_CHECK(rot_choice_pick(&rot_free_constraint, &p, &query, all) == 1);
  ROT_CHECK(strcmp(all[0].model->id, "free_rk8pd") == 0);
  const rot_free_params rod = scene(0.0, 1.0, 1.0, 0.0, 1.1, -0.6);
  ROT_CHECK(rot_free_not_exact(&rod) == NULL && rot_free_not_integrated(&rod) != NULL);
  const rot_free_params spun = scene(0.0, 1.0, 1.0, 0.1, 1.1, -0.6);
  ROT_CHECK(rot_free_not_exact(&spun) != NULL);
  static rows r;
  rot_info info;
  ROT_CHECK_EQ_INT(exact(&spun, 2, t, &r, NULL, &info), ROT_EVALUE);
  const double far = 1e308;
  p = scene(1.0, 2.0, 2.7, 4.0, 1.1, -0.6);
  ROT_CHECK_EQ_INT(exact(&p, 1, &far, &r, NULL, &info), ROT_OK);
  ROT_CHECK(rot_info_error(&info) > 1.0); /* no digit is left, and it says so */
}

/* Own axes that are not the principal ones, turned about any line: at the start the rows have the
 * attitude and the rates that were given, and L and the energy of the tensor in own axes. */
static void check_own_axes(void) {
  const double t = 0.0, axes[4] = {0.5, 0.1, -0.7, 0.5}, own[3] = {0.3, -1.2, 0.8};
  static rows r;
  rot_info info;
  rot_free_params p = scene(1.0, 2.0, 2.5, own[0], own[1], own[2]);
  const double q0[4] = {0.1, 0.7, 0.5, -0.5};
  p.turned = 1;
  memcpy(p.axes, axes, sizeof axes);
  memcpy(p.q0, q0, sizeof q0);
  ROT_CHECK_REL(axes[0] * axes[0] + 0.01 + 0.49 + 0.25, 1.0, 1e-15);
  const rot_free_columns out = columns_of(&r);
  ROT_CHECK_EQ_INT(rot_free_exact(&p, 1, &t, &out, NULL, NULL, &info), ROT_OK);
  const double got[4] = {r.qw[0], r.qx[0], r.qy[0], r.qz[0]};
  ROT_CHECK(rot_attitude_angle(got, p.q0) <= 2e-15);
  ROT_CHECK(fabs(r.omega_x_rad_per_s[0] - own[0]) <= 1e-15);
  ROT_CHECK(fabs(r.omega_y_rad_per_s[0] - own[1]) <= 1e-15);
  ROT_CHECK(fabs(r.omega_z_rad_per_s[0] - own[2]) <= 1e-15);
  double w[3], l[3];
  rot_attitude_to_body(axes, own, w);
  for (int k = 0; k < 3; k++) l[k] = p.moment_kg_m2[k] * w[k];
  rot_attitude_to_space(axes, l, l);
  rot_attitude_to_space(q0, l, l);
  ROT_CHECK(fabs(r.angular_momentum_x_kg_m2_per_s[0] - l[0]) <= 2e-15);
  ROT_CHECK(fabs(r.angular_momentum_y_kg_m2_per_s[0] - l[1]) <= 2e-15);
  ROT_CHECK(fabs(r.angular_momentum_z_kg_m2_per_s[0] - l[2]) <= 2e-15);
}

/* Steps of fixed length cost as many steps as the time takes, each of them. */
static void check_cost(void) {
  const rot_free_params p = scene(1.0, 2.0, 2.5, 0.3, -1.2, 0.8);
  double cost[2];
  for (size_t k = 0; k < rot_free_constraint.n_models; k++) {
    const rot_model *m = &rot_free_constraint.models[k];
    if (strcmp(m->id, "free_rk4") && strcmp(m->id, "free_split")) continue;
    for (int i = 0; i < 2; i++) {
      const double t = i ? 1e5 : 1e4;
      const rot_query query = {1, &t, 1e-6, 0.0};
      cost[i] = m->cost_s(m, &p, &query);
    }
    ROT_CHECK(cost[1] > 9.0 * cost[0] && cost[1] < 11.0 * cost[0]);
  }
}

/* An impulse of unknown error explains nothing of its balance, and leaves the others. */
static void check_unknown_error(void) {
  const rot_free_params p = scene(1.0, 2.0, 2.5, 0.3, -1.2, 0.8);
  const double row[ROT_FREE_OWN_COLUMNS] = {1.0, 0.0, 0.0, 0.0, 0.3, -1.2, 0.8};
  const double none[ROT_FREE_FLOWS] = {0.0}, unknown[ROT_FREE_FLOWS] = {0.0, 0.0, NAN};
  const double error[3] = {0.0}, term[14] = {0.0};
  const rot_span span = {{0.0, 1.0}, row, row, none, unknown, error};
  double explained[5];
  rot_free_explain(&p, &span, term, explained);
  for (int k = 0; k < 5; k++) ROT_CHECK(isnan(explained[k]) == (k == 1));
}

int main(void) {
  check_exact_and_integrated();
  check_torque_on_a_ball();
  check_knots_and_law();
  check_flips();
  check_choice();
  check_own_axes();
  check_cost();
  check_unknown_error();
  return rot_test_report("free");
}
