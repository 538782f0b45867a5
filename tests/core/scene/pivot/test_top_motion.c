/* Heavy symmetric tops: against 40-digit values (the shared tables), the equations of motion by
 * differences, what is conserved, restarts on the way, mirrored and scaled tops. */
#include <stdlib.h>

#include "maths/attitude.h"
#include "rot_test.h"
#include "scene/pivot/top_motion.h"
#include "shared_table.h"

typedef struct top {
  double i1, i3, weight;
  rot_top_start start;
} top;

static rot_top_state at(const top *x, double t) {
  rot_top_motion motion;
  rot_top_state out = {{NAN, NAN, NAN, NAN}, {NAN, NAN, NAN}, NAN, NAN};
  if (rot_top_begin(x->i1, x->i3, x->weight, &x->start, 0.0, &motion) == ROT_OK) {
    rot_top_at(&motion, (rot_dd){t, 0.0}, &out);
  }
  return out;
}

static double gap(const double x[3], const double y[3]) {
  double sum = 0.0;
  for (int i = 0; i < 3; i++) sum += (x[i] - y[i]) * (x[i] - y[i]);
  return sqrt(sum);
}

static double length(const double x[3]) { return sqrt(x[0] * x[0] + x[1] * x[1] + x[2] * x[2]); }

/* I1, I3, G, theta, phi, psi, theta', phi', omega3, t, q, omega, cos theta. */
static void check_table(void) {
  FILE *table = shared_table("refs/heavy_top.csv");
  double x[18], worst = 0.0, worst_omega = 0.0;
  int rows = 0;
  if (!table) return;
  while (shared_row(table, 18, x)) {
    top t = {x[0], x[1], x[2], {{{0.0, 0.0}}, {{0.0, 0.0}}}};
    rot_top_from_euler(x[4], x[3], x[5], x[7], x[6], x[8], &t.start);
    const rot_top_state s = at(&t, x[9]);
    const double off = rot_attitude_angle(s.q, x + 10);
    rows++;
    worst = fmax(worst, off);
    worst_omega = fmax(worst_omega, gap(s.omega, x + 14) / length(x + 14));
    ROT_CHECK(off <= 2e-15 && off <= s.q_error && s.q_error <= 2e-14);
    ROT_CHECK(gap(s.omega, x + 14) <= s.omega_error);
  }
  printf("table: %d rows, attitude %.2e rad, omega %.2e\n", rows, worst, worst_omega);
  ROT_CHECK(rows == 14 && worst_omega <= 1e-15);
}

/* I1, I3, G, theta, omega3, slow, fast, fast-top formula, period, lowest cosine, precession. */
static void check_answers(void) {
  FILE *table = shared_table("refs/heavy_top_scalar.csv");
  double x[11];
  int rows = 0;
  if (!table) return;
  while (shared_row(table, 11, x)) {
    rot_top_start start;
    rot_top_motion motion;
    double slow, fast;
    rot_top_steady(x[0], x[1], x[2], cos(x[3]), x[4], &slow, &fast);
    ROT_CHECK_REL(slow, x[5], 5e-16);
    ROT_CHECK_REL(fast, x[6], 5e-16);
    rot_top_from_euler(0.0, x[3], 0.0, 0.0, 0.0, x[4], &start);
    ROT_CHECK(rot_top_begin(x[0], x[1], x[2], &start, 0.0, &motion) == ROT_OK);
    const rot_top_nutation n = rot_top_nutates(&motion);
    ROT_CHECK_REL(n.period_s, x[8], 4e-16);
    ROT_CHECK(fabs(n.lowest_cosine - x[9]) <= 2.3e-16);
    ROT_CHECK_REL(n.precession_rad_per_s, x[10] / x[8], 6e-16);
    ROT_CHECK(fabs(cos(n.lowest_rad) - x[9]) <= 4e-16);
    ROT_CHECK(fabs(2.0 * n.amplitude_rad - (n.lowest_rad - x[3])) <= 4e-16);
    ROT_CHECK(fabs(n.highest_cosine - cos(x[3])) <= 2.3e-16);
    rows++;
  }
  ROT_CHECK(rows == 6);
}

static double uniform(double low, double high) {
  return low + (high - low) * ((double)rand() / (double)RAND_MAX);
}

static top random_top(void) {
  top x = {pow(10.0, uniform(-2.0, 2.0)), 0.0, 0.0, {{{0.0, 0.0}}, {{0.0, 0.0}}}};
  x.i3 = x.i1 * uniform(0.01, 2.0);
  x.weight = x.i1 * uniform(-3.0, 3.0);
  for (int i = 0; i < 4; i++) x.start.q[i].hi = uniform(-1.0, 1.0);
  for (int i = 0; i < 3; i++) x.start.omega[i].hi = uniform(-4.0, 4.0);
  return x;
}

/* q' = q omega/2 and Euler's equations, by differences of order 4. */
static void check_equations(void) {
  srand(20);
  for (int k = 0; k < 300; k++) {
    const top x = random_top();
    const double t = uniform(-20.0, 20.0), h = 1e-3;
    const rot_top_state s = at(&x, t);
    const double *w = s.omega;
    double dq[4] = {0.0}, dw[3] = {0.0}, want[4], z[3];
    static const double weight[4] = {1.0 / 12.0, -8.0 / 12.0, 8.0 / 12.0, -1.0 / 12.0};
    for (int j = 0; j < 4; j++) {
      const rot_top_state there = at(&x, t + (j < 2 ? j - 2 : j - 1) * h);
      double same = 0.0;
      for (int i = 0; i < 4; i++) same += there.q[i] * s.q[i];
      for (int i = 0; i < 4; i++) dq[i] += weight[j] * (same < 0.0 ? -1.0 : 1.0) * there.q[i] / h;
      for (int i = 0; i < 3; i++) dw[i] += weight[j] * there.omega[i] / h;
    }
    const double turn[4] = {0.0, 0.5 * w[0], 0.5 * w[1], 0.5 * w[2]}, up[3] = {0.0, 0.0, 1.0};
    rot_attitude_times(s.q, turn, want);
    for (int i = 0; i < 4; i++) ROT_CHECK(fabs(dq[i] - want[i]) <= 1e-8);
    rot_attitude_to_body(s.q, up, z);
    ROT_CHECK(fabs(x.i1 * dw[0] - (x.i1 - x.i3) * w[1] * w[2] - x.weight * z[1]) <= 1e-7 * x.i1);
    ROT_CHECK(fabs(x.i1 * dw[1] - (x.i3 - x.i1) * w[2] * w[0] + x.weight * z[0]) <= 1e-7 * x.i1);
    ROT_CHECK(w[2] == x.start.omega[2].hi);
  }
}

/* Energy and the momentum about the vertical, at times to 1e12. */
static void check_invariants(void) {
  double worst = 0.0;
  srand(21);
  for (int k = 0; k < 2000; k++) {
    const top x = random_top();
    const double up[3] = {0.0, 0.0, 1.0};
    double first[2] = {0.0}, size = 0.0;
    for (int j = 0; j < 4; j++) {
      const rot_top_state s = at(&x, j == 0 ? 0.0 : pow(10.0, 4.0 * j) * uniform(-1.0, 1.0));
      const double *w = s.omega;
      double z[3];
      rot_attitude_to_body(s.q, up, z);
      const double kinetic = 0.5 * (x.i1 * (w[0] * w[0] + w[1] * w[1]) + x.i3 * w[2] * w[2]);
      const double energy = kinetic + x.weight * z[2];
      const double about = x.i1 * (w[0] * z[0] + w[1] * z[1]) + x.i3 * w[2] * z[2];
      if (j == 0) {
        first[0] = energy;
        first[1] = about;
        size = kinetic + fabs(x.weight);
        continue;
      }
      const double momentum = x.i1 * hypot(w[0], w[1]) + fabs(x.i3 * w[2]) + sqrt(x.i1 * size);
      worst = fmax(worst, fabs(energy - first[0]) / size);
      worst = fmax(worst, fabs(about - first[1]) / momentum);
    }
  }
  printf("invariants to 1e12 s: %.1e\n", worst);
  ROT_CHECK(worst <= 1e-14);
}

/* Half-way and on from there is the whole way. */
static void check_restart(void) {
  srand(22);
  for (int k = 0; k < 500; k++) {
    top x = random_top();
    const double t = uniform(-5.0, 5.0), more = uniform(-5.0, 5.0);
    const rot_top_state half = at(&x, t), whole = at(&x, t + more);
    for (int i = 0; i < 4; i++) x.start.q[i] = (rot_dd){half.q[i], 0.0};
    for (int i = 0; i < 3; i++) x.start.omega[i] = (rot_dd){half.omega[i], 0.0};
    const rot_top_state on = at(&x, more);
    ROT_CHECK(rot_attitude_angle(on.q, whole.q) <= 3e-12);
    ROT_CHECK(gap(on.omega, whole.omega) <= 1e-11);
  }
}

/* Seconds of another length, kilograms of another size: the same digits. The body's axes turned
 * over: the same motion. */
static void check_scaling(void) {
  srand(23);
  for (int k = 0; k < 200; k++) {
    const top x = random_top();
    const double t = uniform(-9.0, 9.0);
    const rot_top_state s = at(&x, t);
    for (int e = -400; e <= 400; e += 200) {
      top y = x;
      y.i1 = ldexp(x.i1, e);
      y.i3 = ldexp(x.i3, e);
      y.weight = ldexp(x.weight, e + e / 2);
      for (int i = 0; i < 3; i++) y.start.omega[i].hi = ldexp(x.start.omega[i].hi, e / 4);
      const rot_top_state there = at(&y, ldexp(t, -e / 4));
      for (int i = 0; i < 4; i++) ROT_CHECK(there.q[i] == s.q[i]);
      for (int i = 0; i < 3; i++) ROT_CHECK(there.omega[i] == ldexp(s.omega[i], e / 4));
    }
    top y = x;
    const double over[4] = {0.0, 1.0, 0.0, 0.0};
    double q[4];
    for (int i = 0; i < 4; i++) q[i] = x.start.q[i].hi;
    rot_attitude_times(q, over, q);
    for (int i = 0; i < 4; i++) y.start.q[i].hi = q[i];
    for (int i = 1; i < 3; i++) y.start.omega[i].hi = -x.start.omega[i].hi;
    y.weight = -x.weight;
    rot_top_state there = at(&y, t);
    rot_attitude_times(s.q, over, q);
    ROT_CHECK(rot_attitude_angle(there.q, q) <= 1e-15);
  }
}

/* At rest at a pole, asleep, steady, without weight; what is refused. */
static void check_special(void) {
  top x = {1.0, 0.5, 2.0, {{{0.0, 0.0}}, {{0.0, 0.0}}}};
  rot_top_motion motion;
  x.start.q[0].hi = 1.0;
  rot_top_state s = at(&x, 1e6);
  ROT_CHECK(s.q[0] == 1.0 && s.omega[0] == 0.0 && s.omega[2] == 0.0);
  x.start.omega[2].hi = 3.0; /* too slow to be stable, yet it stands */
  s = at(&x, 7.0);
  ROT_CHECK(fabs(s.q[0] - cos(10.5)) <= 1e-15 && fabs(s.q[3] - sin(10.5)) <= 1e-15);
  x.weight = 0.0;
  x.start.omega[0].hi = 1.0;
  s = at(&x, 2.0);
  /* omega1' = 1.5 omega2, omega2' = -1.5 omega1 */
  ROT_CHECK(fabs(s.omega[0] - cos(3.0)) <= 1e-15 && fabs(s.omega[1] + sin(3.0)) <= 1e-15);
  double slow, fast;
  rot_top_steady(1.0, 0.5, 1.0, 0.8, 1.0, &slow, &fast);
  ROT_CHECK(isnan(slow) && isnan(fast));
  rot_top_steady(1.0, 0.5, 1.0, 0.0, 4.0, &slow, &fast);
  ROT_CHECK(slow == 0.5 && isnan(fast));
  x.weight = 1.0;
  ROT_CHECK(rot_top_begin(0.0, 1.0, 1.0, &x.start, 0.0, &motion) == ROT_EVALUE);
  ROT_CHECK(rot_top_begin(1.0, 2.1, 1.0, &x.start, 0.0, &motion) == ROT_EVALUE);
  ROT_CHECK(rot_top_begin(1.0, 1.0, INFINITY, &x.start, 0.0, &motion) == ROT_EVALUE);
  ROT_CHECK(rot_top_begin(1.0, 1.0, 1e-300, &x.start, 0.0, &motion) == ROT_ERANGE);
  x.start.q[0].hi = 0.0;
  ROT_CHECK(rot_top_begin(1.0, 1.0, 1.0, &x.start, 0.0, &motion) == ROT_EVALUE);
}

/* With wheels of momentum h the axis moves as that of a top with the spin omega3 + h/I3; the body
 * is turned about it by -h/I3 t more. Standing and hanging; without weight there is no answer. */
static void check_wheels(void) {
  const double h = -1.5, i3 = 0.5, times[] = {0.25, 3.0, -41.0, 1e9};
  for (int k = 0; k < 4; k++) {
    for (int side = -1; side <= 1; side += 2) {
      top x = {1.0, i3, 2.0 * side, {{{0.0, 0.0}}, {{0.0, 0.0}}}};
      rot_top_motion motion;
      rot_top_state with;
      rot_top_from_euler(0.3, 1.1, -0.4, 0.25, 0.5, 2.0, &x.start);
      ROT_CHECK(rot_top_begin_wheels(x.i1, x.i3, (rot_dd){x.weight, 0.0}, (rot_dd){h, 0.0},
                                     &x.start, 0.0, &motion) == ROT_OK);
      rot_top_at(&motion, (rot_dd){times[k], 0.0}, &with);
      x.start.omega[2].hi += h / i3; /* -1 */
      const rot_top_state fast = at(&x, times[k]);
      const double half = -0.5 * h / i3 * times[k];
      const double turn[4] = {cos(half), 0.0, 0.0, sin(half)};
      double q[4];
      rot_attitude_times(fast.q, turn, q);
      const double angle = rot_attitude_angle(q, with.q);
      ROT_CHECK(angle <= 4e-15 && angle <= with.q_error + fast.q_error);
      ROT_CHECK(with.omega[2] == 2.0);
    }
  }
  top x = {1.0, i3, 0.0, {{{1.0, 0.0}}, {{0.0, 0.0}}}};
  rot_top_motion motion;
  const rot_dd wheels[] = {{h, 0.0}, {INFINITY, 0.0}};
  for (int k = 0; k < 2; k++) {
    ROT_CHECK(rot_top_begin_wheels(1.0, i3, (rot_dd){k, 0.0}, wheels[k], &x.start, 0.0, &motion) ==
              ROT_EVALUE);
  }
}

/* The attitude of Euler's angles is the product of three turns; the rates along their axes add. */
static void check_euler(void) {
  const double phi = 0.7, theta = 1.9, psi = -2.3, phi_rate = 1.5, theta_rate = -0.5, omega3 = 4.0;
  const double first[4] = {cos(0.5 * phi), 0.0, 0.0, sin(0.5 * phi)};
  const double second[4] = {cos(0.5 * theta), sin(0.5 * theta), 0.0, 0.0};
  const double third[4] = {cos(0.5 * psi), 0.0, 0.0, sin(0.5 * psi)};
  const double up[3] = {0.0, 0.0, 1.0}, along[3] = {1.0, 0.0, 0.0};
  double q[4], node[4], vertical[3], line[3];
  rot_top_start start;
  rot_attitude_times(first, second, node);
  rot_attitude_times(node, third, q);
  rot_top_from_euler(phi, theta, psi, phi_rate, theta_rate, omega3, &start);
  for (int i = 0; i < 4; i++) ROT_CHECK(fabs(start.q[i].hi - q[i]) <= 4e-16);
  /* phi' turns about the vertical, theta' about the line of nodes. */
  rot_attitude_to_space(node, along, line);
  rot_attitude_to_body(q, line, line);
  rot_attitude_to_body(q, up, vertical);
  for (int i = 0; i < 2; i++) {
    ROT_CHECK(fabs(start.omega[i].hi - phi_rate * vertical[i] - theta_rate * line[i]) <= 2e-15);
  }
  ROT_CHECK(start.omega[2].hi == omega3);
}

/* Released at rest, u'^2 = (u0 - u)(beta (1 - u^2) - a^2 (u0 - u)), so that the zeros are known: of
 * the complement of the modulus the roundings of u3 - u2 cost as much as those of u3. */
static void check_loss(void) {
  const double i1 = 1.0, i3 = 0.5, weight = 2.0, theta = 1.0, omega3 = 5.0;
  const double u = cos(theta), a = i3 * omega3 / i1, beta = 2.0 * weight / i1;
  const double root = sqrt(a * a * a * a + 4.0 * beta * (beta - a * a * u));
  const double low = (a * a - root) / (2.0 * beta), far = (a * a + root) / (2.0 * beta);
  rot_top_start start;
  rot_top_motion motion;
  rot_top_from_euler(0.0, theta, 0.0, 0.0, 0.0, omega3, &start);
  ROT_CHECK(rot_top_begin(i1, i3, weight, &start, 0.0, &motion) == ROT_OK);
  ROT_CHECK_REL(rot_top_nutates(&motion).lowest_cosine, low, 1e-14);
  ROT_CHECK_REL(motion.m1_loss, 32.0 * ROT_DD_EPS * 2.0 * (1.0 + (far - u) / (far - low)), 1e-6);
}

/* Wheels may turn the top on its axis as fast as their momentum over I1: so much more is the
 * largest rate, with the same start. */
static void check_rate(void) {
  const double i1 = 2.0;
  rot_top_start start;
  rot_top_motion with, without;
  rot_top_from_euler(0.3, 1.1, -0.4, 0.25, 0.5, 2.0, &start);
  for (int side = -1; side <= 1; side += 2) {
    const rot_dd h = {1.5 * side, 0.0}, weight = {3.0, 0.0};
    ROT_CHECK(rot_top_begin(i1, 0.5, 3.0, &start, 0.0, &without) == ROT_OK);
    ROT_CHECK(rot_top_begin_wheels(i1, 0.5, weight, h, &start, 0.0, &with) == ROT_OK);
    ROT_CHECK_REL(ldexp(with.rate, with.exponent) - ldexp(without.rate, without.exponent), 0.75,
                  1e-14);
  }
}

int main(void) {
  check_euler();
  check_wheels();
  check_table();
  check_answers();
  check_equations();
  check_invariants();
  check_restart();
  check_scaling();
  check_special();
  check_loss();
  check_rate();
  return rot_test_report("top_motion");
}
