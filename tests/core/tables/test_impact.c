/* Collisions: the shared table of bounces, balances of random ones, literal answers. */
#include "tables/impact.h"

#include <stdlib.h>

#include "ground/real.h"
#include "rot_test.h"
#include "shared_table.h"

static double uniform(double lo, double hi) {
  static uint64_t state = 88172645463325252u;
  state ^= state << 13;
  state ^= state >> 7;
  state ^= state << 17;
  return lo + (hi - lo) * (double)(state >> 11) * 0x1p-53;
}

static void bounces_of_the_table(void) {
  FILE *file = shared_table("refs/ball_bounce.csv");
  double x[13], worst = 0.0;
  while (file && shared_row(file, 13, x)) {
    const rot_bounce_input in = {x[0], x[1], x[2], x[5], x[6], x[7], x[3], x[4], 0.0};
    const rot_bounce got = rot_impact_bounce(&in);
    ROT_CHECK(got.sticks == (x[8] != 0.0));
    const double v = fabs(x[5]) + fabs(x[1] * x[7]) + fabs(got.friction_impulse) / x[0] / x[2];
    const double off[] = {fabs(got.vx - x[9]) / v, fabs(got.vy - x[10]) / fabs(x[10]),
                          fabs(got.omega - x[11]) * x[1] / v,
                          fabs(got.normal_loss + got.friction_loss + x[12]) / fabs(x[12])};
    for (int i = 0; i < 4; i++) worst = fmax(worst, off[i] / (2.0 * ROT_EPS));
  }
  printf("bounces: %.2g ulp of the largest term\n", worst);
  ROT_CHECK(worst <= 4.0);
}

/* Energy never grows; what is lost is what the two parts say; impulses explain the momenta. */
static void random_bounces(void) {
  double off = 0.0;
  for (int i = 0; i < 200000; i++) {
    const double m = uniform(0.01, 10.0), r = uniform(0.01, 1.0), beta = uniform(0.05, 3.0);
    const rot_bounce_input in = {m,
                                 r,
                                 beta,
                                 uniform(-9.0, 9.0),
                                 uniform(-9.0, 0.5),
                                 uniform(-50.0, 50.0),
                                 uniform(0.0, 1.0),
                                 uniform(0.0, 1.0),
                                 i % 2 ? 0.0 : uniform(0.0, 1.0)};
    const rot_bounce to = rot_impact_bounce(&in);
    const double spin = m * beta * r * r;
    const double before = 0.5 * (m * (in.vx * in.vx + in.vy * in.vy) + spin * in.omega * in.omega);
    const double after = 0.5 * (m * (to.vx * to.vx + to.vy * to.vy) + spin * to.omega * to.omega);
    ROT_CHECK(to.normal_loss >= 0.0 && to.friction_loss >= 0.0);
    ROT_CHECK(after <= before * (1.0 + 1e-14));
    off = fmax(off, fabs(before - after - to.normal_loss - to.friction_loss) / before);
    ROT_CHECK(fabs(to.friction_impulse) <= in.friction * to.normal_impulse * (1.0 + 4e-16));
    const double slip = to.vx - r * to.omega, was = in.vx - r * in.omega;
    const double largest = fabs(in.vx) + r * fabs(in.omega), back = in.tangential * was;
    if (to.sticks && in.vy < 0.0) ROT_CHECK(fabs(slip + back) <= 2e-14 * largest);
    if (!(in.tangential > 0.0)) ROT_CHECK(slip * was >= -1e-13 * was * was - 1e-12);
    ROT_CHECK(fabs(slip) <= fabs(was) + 2e-14 * largest);
    /* About the contact, friction has no arm. */
    const double about = m * r * in.vx + spin * in.omega, now = m * r * to.vx + spin * to.omega;
    ROT_CHECK(fabs(now - about) <= 1e-14 * (m * r * fabs(in.vx) + spin * fabs(in.omega)) +
                                       4e-16 * r * fabs(to.friction_impulse));
  }
  printf("bounces: energy balanced to %.2g\n", off);
  ROT_CHECK(off <= 1e-14);
}

static void random_hits(void) {
  double off = 0.0;
  for (int i = 0; i < 200000; i++) {
    const double mass = uniform(0.1, 10.0), centre = uniform(0.0, 2.0);
    const double inertia = mass * (centre * centre + uniform(0.01, 1.0)), d = uniform(-2.0, 2.0);
    const rot_hinged_input in = {inertia,
                                 mass,
                                 centre,
                                 d,
                                 uniform(-5.0, 5.0),
                                 uniform(0.01, 5.0),
                                 uniform(-9.0, 9.0),
                                 uniform(0.0, 1.0)};
    const rot_hinged to = rot_impact_hinged(&in);
    const double m = in.particle_mass, closing = in.particle_v - in.omega * d;
    const double before = 0.5 * (inertia * in.omega * in.omega + m * in.particle_v * in.particle_v);
    const double after = 0.5 * (inertia * to.omega * to.omega + m * to.particle_v * to.particle_v);
    const double size = inertia * fabs(in.omega) + m * fabs(in.particle_v * d);
    ROT_CHECK(to.loss >= 0.0 && after <= before * (1.0 + 1e-14));
    off = fmax(off, fabs(before - after - to.loss) / before);
    /* Angular momentum about the hinge. */
    ROT_CHECK(fabs(inertia * (to.omega - in.omega) + m * d * (to.particle_v - in.particle_v)) <=
              4e-15 * size);
    /* Momentum: that of the centre of mass is what both impulses give. */
    ROT_CHECK(fabs(mass * centre * (to.omega - in.omega) - to.impulse - to.hinge_impulse) <=
              1e-14 * (fabs(to.impulse) + mass * centre * (fabs(to.omega) + fabs(in.omega))));
    if (closing <= 0.0) {
      ROT_CHECK(to.impulse == 0.0 && to.omega == in.omega);
    } else {
      ROT_CHECK(fabs(to.omega * d - to.particle_v - in.restitution * closing) <=
                2e-14 * (fabs(in.particle_v) + fabs(in.omega * d)));
    }
  }
  printf("hits: energy balanced to %.2g\n", off);
  ROT_CHECK(off <= 1e-14);
}

static void literal_answers(void) {
  /* A perfect bounce without friction turns vy alone. */
  const rot_bounce_input smooth = {1.0, 0.1, 0.4, 3.0, -2.0, 7.0, 1.0, 0.0, 0.0};
  const rot_bounce a = rot_impact_bounce(&smooth);
  ROT_CHECK(a.vx == 3.0 && a.vy == 2.0 && a.omega == 7.0 && a.normal_loss == 0.0);
  /* Infinite friction: v = (v + beta w)/(1 + beta) = 3/1.4 for no spin. */
  const rot_bounce_input rough = {1.0, 0.1, 0.4, 3.0, -2.0, 0.0, 0.0, INFINITY, 0.0};
  const rot_bounce b = rot_impact_bounce(&rough);
  ROT_CHECK_ULP(b.vx, 2.142857142857142857, 2);
  ROT_CHECK_ULP(b.omega, 21.42857142857142857, 4);
  ROT_CHECK(b.sticks && b.vy == 0.0);
  ROT_CHECK_ULP(b.friction_loss, 1.2857142857142857, 4);
  /* A superball, perfectly elastic both ways, without spin: v = (1 - beta)/(1 + beta) vx = 3/7 of
   * it, omega = 2/(1 + beta) vx/r = 10/7 of it (Garwin 1969); nothing is lost. */
  const rot_bounce_input super = {1.0, 0.1, 0.4, 7.0, -2.0, 0.0, 1.0, INFINITY, 1.0};
  const rot_bounce s = rot_impact_bounce(&super);
  ROT_CHECK_ULP(s.vx, 3.0, 2);
  ROT_CHECK_ULP(s.omega, 100.0, 2);
  ROT_CHECK(s.sticks && s.friction_loss <= 0.0 && s.normal_loss <= 0.0);
  const rot_bounce_input away = {1.0, 0.1, 0.4, 3.0, 2.0, 0.0, 0.0, 1.0, 0.0};
  ROT_CHECK(rot_impact_bounce(&away).vx == 3.0 && rot_impact_bounce(&away).vy == 2.0);
  /* A rod of 2 kg and 1.2 m, struck at 2/3 of its length: no impulse of the hinge. */
  ROT_CHECK(fabs(rot_impact_hinge_fraction(0.96, 2.0, 0.6, 0.8)) <= 2e-16);
  ROT_CHECK_ULP(rot_impact_hinge_fraction(0.96, 2.0, 0.6, 1.2), 0.5, 4);
}

/* Energy never grows; the slip goes to -e of itself or as far as the largest impulse takes it. */
static void random_rims(void) {
  double off = 0.0;
  for (int i = 0; i < 50000; i++) {
    const rot_rims_input in = {{uniform(0.01, 5.0), uniform(0.01, 5.0)},
                               {uniform(0.1, 2.0), uniform(-2.0, 2.0)},
                               {uniform(-9.0, 9.0), uniform(-9.0, 9.0)},
                               i % 2 ? 0.0 : uniform(0.0, 1.0),
                               i % 3 ? INFINITY : uniform(0.0, 3.0)};
    const rot_rims to = rot_impact_rims(&in);
    const double *w = in.omega, *r = in.radius;
    const double slip = r[0] * w[0] + r[1] * w[1], now = r[0] * to.omega[0] + r[1] * to.omega[1];
    const double before = in.inertia[0] * w[0] * w[0] + in.inertia[1] * w[1] * w[1];
    const double after =
        in.inertia[0] * to.omega[0] * to.omega[0] + in.inertia[1] * to.omega[1] * to.omega[1];
    ROT_CHECK(to.loss >= 0.0 && fabs(to.impulse) <= in.max);
    off = fmax(off, fabs(0.5 * (before - after) - to.loss) / before);
    const double size = fabs(r[0] * w[0]) + fabs(r[1] * w[1]);
    if (to.locked)
      ROT_CHECK(fabs(now + in.restitution * slip) <= 1e-14 * size);
    else
      ROT_CHECK(fabs(now) <= fabs(slip) + 1e-14 * size);
  }
  printf("rims: energy balanced to %.2g\n", off);
  ROT_CHECK(off <= 1e-14);
  /* 600 rpm couples to three times the inertia at rest: 150 rpm, 3/4 of the energy lost. */
  const rot_rims_input couple = {{1.0, 3.0}, {1.0, -1.0}, {600.0, 0.0}, 0.0, INFINITY};
  const rot_rims one = rot_impact_rims(&couple);
  ROT_CHECK(one.omega[0] == 150.0 && one.omega[1] == 150.0 && one.loss == 135000.0);
  /* Rims of 0.1 and 0.3 m, 1 and 9 kg m^2: 100 and 100 for the impulse, 0.1 w1 = -0.3 w2. */
  const rot_rims_input rims = {{1.0, 9.0}, {0.1, 0.3}, {60.0, 0.0}, 0.0, INFINITY};
  const rot_rims two = rot_impact_rims(&rims);
  ROT_CHECK_ULP(two.omega[0], 30.0, 4);
  ROT_CHECK_ULP(two.omega[1], -10.0, 4);
  ROT_CHECK_ULP(two.impulse, -300.0, 4);
}

int main(void) {
  random_rims();
  bounces_of_the_table();
  random_bounces();
  random_hits();
  literal_answers();
  return rot_test_report("impact");
}
