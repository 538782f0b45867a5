#include "tables/statics.h"

#include <stdlib.h>

#include "rot_test.h"
#include "statics_cases.h"

static const double none[3] = {0.0, 0.0, 0.0};

typedef struct solution {
  rot_status status;
  double x[12], error[12], low[12], high[12];
  int determined[12];
  rot_rest rest;
} solution;

static solution solve(const rot_structure *s) {
  solution out;
  out.status = rot_statics_solve(s, out.x, out.error, out.determined, out.low, out.high, &out.rest);
  return out;
}

static rot_structure structure_of(const statics_case *c) {
  const rot_structure s = {c->plane, c->reactions, 0,        c->loads,  c->reaction,
                           NULL,     c->at,        c->force, c->couple, 1e-12};
  return s;
}

/* Within the error, which is not larger than the condition explains; and, since residuals have
 * twice the precision, within a few ulp of the largest reaction. */
static void exact_reactions(void) {
  double worst = 0.0;
  for (size_t i = 0; i < sizeof statics_cases / sizeof *statics_cases; i++) {
    const statics_case *c = &statics_cases[i];
    const rot_structure s = structure_of(c);
    const solution got = solve(&s);
    double largest = 0.0, size[2] = {0.0, 0.0};
    ROT_CHECK_EQ_INT(got.status, ROT_OK);
    ROT_CHECK(got.rest.rests);
    ROT_CHECK_EQ_INT(got.rest.rank, c->reactions);
    for (size_t j = 0; j < c->reactions; j++) {
      const int k = c->reaction[j].is_couple;
      size[k] = fmax(size[k], fabs(c->want[j]));
      largest = fmax(largest, fabs(got.x[j] - c->want[j]) / fmax(got.error[j], 5e-324));
      ROT_CHECK(got.determined[j]);
    }
    ROT_CHECK(largest <= 1.0);
    for (size_t j = 0; j < c->reactions; j++) {
      const double off = fabs(got.x[j] - c->want[j]) / size[c->reaction[j].is_couple];
      worst = fmax(worst, off / 0x1p-53);
    }
  }
  printf("statics: %.2g roundings of the largest reaction\n", worst);
  ROT_CHECK(worst <= 4.0);
}

static rot_reaction along(double x, double y, double dx, double dy, int one_sided) {
  const rot_reaction out = {{x, y, 0.0}, {0.0, 0.0, 0.0}, {dx, dy, 0.0}, 0, one_sided};
  return out;
}

/* A beam of 4 on a pin and a roller, 8 down at 1: 6 and 2 up. In any units, to the last bit. */
static void beam_in_any_units(void) {
  for (int e = -990; e <= 990; e += 180)
    for (int f = -1010; f <= 1010; f += 202) {
      const double length = ldexp(1.0, e), newton = ldexp(1.0, f);
      const rot_reaction r[3] = {along(0, 0, 1, 0, 0), along(0, 0, 0, 1, 0),
                                 along(4 * length, 0, 0, 1, 0)};
      const double at[3] = {length, 0.0, 0.0}, force[3] = {0.0, -8.0 * newton, 0.0};
      const rot_structure s = {1, 3, 0, 1, r, NULL, at, force, none, 1e-12};
      const solution got = solve(&s);
      ROT_CHECK_ULP(got.x[1], 6.0 * newton, 0);
      ROT_CHECK_ULP(got.x[2], 2.0 * newton, 0);
      ROT_CHECK(fabs(got.x[0]) <= 1e-15 * newton);
      ROT_CHECK(got.error[1] <= 1e-13 * newton && got.error[1] > 0.0);
    }
}

/* A load on one leg beyond the other: it tips about that one, clockwise beyond the right. */
static void tips(void) {
  const rot_reaction r[3] = {along(0, 0, 1, 0, 0), along(0, 0, 0, 1, 1), along(4, 0, 0, 1, 1)};
  const double at[3] = {5.0, 0.0, 0.0}, force[3] = {0.0, -8.0, 0.0};
  const rot_structure s = {1, 3, 0, 1, r, NULL, at, force, none, 1e-12};
  const solution got = solve(&s);
  ROT_CHECK(!got.rest.rests && !got.rest.sticks && !got.rest.driven);
  ROT_CHECK_ULP(got.x[1], -2.0, 1);
  ROT_CHECK_ULP(got.x[2], 10.0, 1);
  ROT_CHECK(got.rest.omega[2] < 0.0);
  /* The right leg stays: v + omega x (4, 0) = 0, about the first support. */
  ROT_CHECK(fabs(got.rest.velocity[1] + 4.0 * got.rest.omega[2]) <= 1e-12);
}

/* On one pin: a load beside it turns the body the way it pulls; one above leaves it at rest. */
static void mechanism(void) {
  const rot_reaction r[2] = {along(1, 1, 1, 0, 0), along(1, 1, 0, 1, 0)};
  double at[3] = {3.0, 1.0, 0.0};
  const double force[3] = {0.0, -5.0, 0.0};
  const rot_structure s = {1, 2, 0, 1, r, NULL, at, force, none, 1e-12};
  solution got = solve(&s);
  ROT_CHECK(got.rest.driven && !got.rest.rests);
  ROT_CHECK_EQ_INT(got.rest.rank, 2);
  ROT_CHECK(got.rest.omega[2] < 0.0 && fabs(got.rest.velocity[0]) <= 1e-15);
  at[0] = 1.0;
  got = solve(&s);
  ROT_CHECK(!got.rest.driven && got.rest.rests);
  ROT_CHECK_ULP(got.x[1], 5.0, 0);
}

/* Three rods through one point, and three that are parallel: rank 2. */
static void forces_through_one_point(void) {
  const rot_reaction one[3] = {along(1, 0, 1, 0, 0), along(0, 2, 0, 1, 0), along(3, 3, 1, 1, 0)};
  const rot_reaction parallel[3] = {along(0, 0, 0, 1, 0), along(2, 0, 0, 1, 0),
                                    along(5, 1, 0, 1, 0)};
  const double at[3] = {1.0, 0.0, 0.0}, down[3] = {0.0, -1.0, 0.0}, side[3] = {1.0, 0.0, 0.0};
  rot_structure s = {1, 3, 0, 1, one, NULL, at, down, none, 1e-12};
  solution got = solve(&s);
  ROT_CHECK_EQ_INT(got.rest.rank, 2);
  ROT_CHECK(got.rest.driven); /* 1 beside the common point */
  s.reaction = parallel;
  got = solve(&s);
  ROT_CHECK_EQ_INT(got.rest.rank, 2);
  ROT_CHECK(!got.rest.driven && got.rest.rests);
  s.load_force = side;
  got = solve(&s);
  ROT_CHECK(got.rest.driven && got.rest.velocity[0] > 0.5);
}

/* Three legs in line under one load: redundant once, with ranges by hand. Legs that push at 0, 1,
 * 2 and 6 N at 0.5: a + b + c = 6, b + 2 c = 3: c in [0, 1.5], b = 3 - 2 c, a = 3 + c. */
static void ranges(void) {
  const rot_reaction r[4] = {along(0, 0, 1, 0, 0), along(0, 0, 0, 1, 1), along(1, 0, 0, 1, 1),
                             along(2, 0, 0, 1, 1)};
  const double at[3] = {0.5, 0.0, 0.0}, force[3] = {0.0, -6.0, 0.0};
  const rot_structure s = {1, 4, 0, 1, r, NULL, at, force, none, 1e-12};
  const solution got = solve(&s);
  const double low[4] = {0.0, 3.0, 0.0, 0.0}, high[4] = {0.0, 4.5, 3.0, 1.5};
  ROT_CHECK(got.determined[0] && !got.determined[1] && got.rest.rests);
  for (int j = 0; j < 4; j++) {
    ROT_CHECK(fabs(got.low[j] - low[j]) <= 1e-12);
    ROT_CHECK(fabs(got.high[j] - high[j]) <= 1e-12);
  }
  /* Minimum norm: a^2 + b^2 + c^2 with c = 1/2: (3.5, 2, 0.5). */
  ROT_CHECK_REL(got.x[1], 3.5, 1e-14);
  ROT_CHECK_REL(got.x[2], 2.0, 1e-14);
  ROT_CHECK_REL(got.x[3], 0.5, 1e-13);
}

/* The same with the load at 0.1: the unrestricted minimum pulls at the last leg; it lifts off. */
static void minimum_norm_that_pushes(void) {
  const rot_reaction r[4] = {along(0, 0, 1, 0, 0), along(0, 0, 0, 1, 1), along(1, 0, 0, 1, 1),
                             along(2, 0, 0, 1, 1)};
  const double at[3] = {0.125, 0.0, 0.0}, force[3] = {0.0, -8.0, 0.0};
  const rot_structure s = {1, 4, 0, 1, r, NULL, at, force, none, 1e-12};
  const solution got = solve(&s);
  ROT_CHECK(got.rest.rests && got.rest.projected);
  /* b + 2 c = 1, a = 7 + c; a^2 + b^2 + c^2 is least at c = -5/6: c = 0 where it must not pull. */
  const double want[4] = {0.0, 7.0, 1.0, 0.0};
  for (int j = 0; j < 4; j++) ROT_CHECK(fabs(got.x[j] - want[j]) <= got.error[j]);
  ROT_CHECK(got.error[1] <= 1e-9);
}

/* A block of 1 on a floor in space, pulled along any direction: slides beyond mu. The cone is
 * circular, not a pyramid. */
static void circular_cone(void) {
  const double size = 0.5;
  rot_reaction r[9];
  rot_contact contact[3];
  const double corner[3][2] = {{-1, -1}, {1, -1}, {0, 2}};
  for (size_t c = 0; c < 3; c++) {
    for (int i = 0; i < 3; i++) {
      const rot_reaction one = {
          {corner[c][0], corner[c][1], 0}, {0, 0, 0}, {i == 0, i == 1, i == 2}, 0, 0};
      r[3 * c + (size_t)i] = one;
    }
    const rot_contact one = {3 * c, {0, 0, 1}, size};
    contact[c] = one;
  }
  for (int turn = 0; turn < 16; turn++) {
    const double angle = 0.1 + 0.3927 * turn, at[6] = {0};
    const double force[6] = {0, 0, -1, cos(angle), sin(angle), 0}, couple[6] = {0};
    const int chosen[2] = {0, 1};
    double limits[2];
    const rot_structure s = {0, 9, 3, 2, r, contact, at, force, couple, 1e-12};
    ROT_CHECK_EQ_INT(rot_statics_factors(&s, chosen, limits), ROT_OK);
    ROT_CHECK(fabs(limits[1] - 0.5) <= 1e-9);
    ROT_CHECK(fabs(limits[0] + 0.5) <= 1e-9);
    const solution got = solve(&s);
    ROT_CHECK(!got.rest.rests && got.rest.sticks);
    /* It starts to slide along the pull. */
    ROT_CHECK(got.rest.velocity[0] * cos(angle) + got.rest.velocity[1] * sin(angle) > 0.0);
  }
}

/* Friction 1/2 under 4 N, beside a rod, against 6 N: half each would be 3 N, friction bears 2. And
 * alone it holds 2 N. */
static void plane_friction(void) {
  const rot_reaction r[3] = {along(0, 0, 1, 0, 0), along(0, 0, 0, 1, 0), along(0, 0, 1, 0, 0)};
  const rot_contact contact = {0, {0, 1, 0}, 0.5};
  const double at[6] = {0}, force[6] = {0, -4, 0, 6, 0, 0}, couple[6] = {0};
  const int chosen[2] = {0, 1};
  double limits[2];
  rot_structure s = {1, 3, 1, 2, r, &contact, at, force, couple, 1e-12};
  const solution got = solve(&s);
  ROT_CHECK(got.rest.rests && got.rest.projected);
  const double want[3] = {-2.0, 4.0, -4.0}, low[3] = {-2.0, 4.0, -8.0}, high[3] = {2.0, 4.0, -4.0};
  for (int j = 0; j < 3; j++) {
    ROT_CHECK(fabs(got.x[j] - want[j]) <= got.error[j] && got.error[j] <= 1e-9);
    ROT_CHECK(fabs(got.low[j] - low[j]) <= 1e-12 && fabs(got.high[j] - high[j]) <= 1e-12);
  }
  /* With a rod upright, too: fx = -a, fy = 2 a, and a^2 + (6 - a)^2 + (2 a)^2 + (4 - 2 a)^2 is
   * least at a = 1.4. */
  const rot_reaction more[4] = {r[0], r[1], r[2], along(0, 0, 0, 1, 0)};
  const double both[4] = {-1.4, 2.8, -4.6, 1.2};
  s.reaction = more;
  s.reactions = 4;
  const solution min = solve(&s);
  for (int j = 0; j < 4; j++) ROT_CHECK(fabs(min.x[j] - both[j]) <= 1e-9);
  s.reactions = 2;
  ROT_CHECK_EQ_INT(rot_statics_factors(&s, chosen, limits), ROT_OK);
  ROT_CHECK_REL(limits[1], 1.0 / 3.0, 1e-12);
  ROT_CHECK_REL(limits[0], -1.0 / 3.0, 1e-12);
}

/* Three rods of which one misses the common point by h: the error is at least what an ulp of h
 * changes, and not a thousand times as much. */
static void error_near_a_mechanism(void) {
  for (double h = 1e-3; h > 1e-10; h /= 10) {
    rot_reaction r[3] = {along(0, 0, 1, 1, 0), along(2, 0, -1, 1, 0), along(1, 0, h, 1, 0)};
    const double at[3] = {0.3, 0.0, 0.0}, force[3] = {0.0, -1.0, 0.0};
    const rot_structure s = {1, 3, 0, 1, r, NULL, at, force, none, 1e-12};
    const solution got = solve(&s);
    r[2].to[0] = h;
    r[0].to[0] = 1.0 + 0x1p-52;
    const solution moved = solve(&s);
    const double change = fabs(moved.x[2] - got.x[2]);
    ROT_CHECK(change <= 2.0 * got.error[2] && got.error[2] <= 1000.0 * change);
  }
}

static double uniform(double low, double high) {
  return low + (high - low) * (double)rand() / (double)RAND_MAX;
}

/* Velocity of a point in the motion that begins. */
static void velocity_at(const rot_rest *rest, const double at[3], double v[3]) {
  for (int i = 0; i < 3; i++) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    v[i] = rest->velocity[i] + rest->omega[j] * (at[k] - rest->about[k]) -
           rest->omega[k] * (at[j] - rest->about[j]);
  }
}

/* Random contacts: what rests has reactions that only push, within friction, inside their ranges;
 * what does not begins a motion that the loads drive, into no support. */
static void random_contacts(void) {
  int seen[2] = {0, 0}, converged = 0, total = 0;
  srand(7);
  for (int trial = 0; trial < rot_test_trials(600); trial++) {
    const int plane = trial % 2, size = plane ? 2 : 3, n = 1 + rand() % 8;
    rot_reaction r[24];
    rot_contact contact[8];
    static double x[24], error[24], low[24], high[24];
    static int determined[24];
    for (int c = 0; c < n; c++) {
      rot_contact *one = &contact[c];
      double at[3] = {uniform(-1, 1), uniform(-1, 1), plane ? 0.0 : uniform(-0.1, 0.1)};
      double normal[3] = {uniform(-0.7, 0.7), uniform(-0.7, 0.7), 1.0};
      if (plane) normal[1] = 1.0, normal[2] = 0.0;
      const double length =
          sqrt(normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2]);
      one->first = (size_t)(c * size);
      one->friction = rand() % 4 ? uniform(0.05, 1.0) : INFINITY;
      for (int i = 0; i < 3; i++) one->normal[i] = normal[i] / length;
      for (int i = 0; i < size; i++) {
        const rot_reaction force = {
            {at[0], at[1], at[2]}, {0, 0, 0}, {i == 0, i == 1, i == 2}, 0, 0};
        r[c * size + i] = force;
      }
    }
    const double at[3] = {uniform(-0.7, 0.7), uniform(-0.7, 0.7), 0.0};
    double force[3] = {uniform(-0.3, 0.3), uniform(-0.3, 0.3), -1.0}, couple[3] = {0};
    if (plane) force[1] = -1.0, force[2] = 0.0;
    const rot_structure s = {plane, (size_t)(n * size), (size_t)n, 1, r, contact, at, force, couple,
                             1e-12};
    rot_rest rest;
    ROT_CHECK_EQ_INT(rot_statics_solve(&s, x, error, determined, low, high, &rest), ROT_OK);
    seen[rest.rests]++;
    double v[3];
    velocity_at(&rest, at, v);
    if (!rest.rests) ROT_CHECK(v[0] * force[0] + v[1] * force[1] + v[2] * force[2] > 0.0);
    for (int c = 0; c < n; c++) {
      const rot_contact *one = &contact[c];
      double push = 0.0, across = 0.0, away = 0.0, slack = 1e-14;
      for (int i = 0; i < size; i++) {
        push += x[c * size + i] * one->normal[i];
        slack += error[c * size + i];
      }
      for (int i = 0; i < size; i++)
        across = hypot(across, x[c * size + i] - push * one->normal[i]);
      velocity_at(&rest, r[c * size].at, v);
      for (int i = 0; i < 3; i++) away += v[i] * one->normal[i];
      if (!rest.rests) {
        ROT_CHECK(away >= -1e-9);
        continue;
      }
      ROT_CHECK(push >= -slack);
      if (one->friction < 2.0) ROT_CHECK(across <= one->friction * push + 3.0 * slack);
      for (int i = c * size; i < (c + 1) * size; i++) {
        ROT_CHECK(x[i] >= low[i] - error[i] - 1e-7 && x[i] <= high[i] + error[i] + 1e-7);
        converged += error[i] < 1e-9;
        total++;
      }
    }
    if (rest.rests) ROT_CHECK(rest.residual_force <= 1e-12 && rest.residual_torque <= 1e-12);
  }
  ROT_CHECK(seen[0] > rot_test_trials(600) / 6 && seen[1] > rot_test_trials(600) / 6);
  printf("statics: %d of %d reactions to 1e-9\n", converged, total);
  ROT_CHECK(converged > 0.99 * total);
}

/* A force, a couple, a wrench: known by hand. (0, 0, 3) at (2, 0, 0) with a couple (0, 0, 6). */
static void central_axis(void) {
  const double at[3] = {2, 0, 0}, force[3] = {0, 0, 3}, couple[3] = {0, 0, 6};
  const double about[3] = {0, 1, 5};
  const rot_sums sums = rot_statics_sums(1, at, force, couple, about);
  ROT_CHECK_ULP(sums.torque[0], -3.0, 0); /* (2, -1, -5) x (0, 0, 3) = (-3, -6, 0) */
  ROT_CHECK_ULP(sums.torque[1], -6.0, 0);
  ROT_CHECK_ULP(sums.torque[2], 6.0, 0);
  const rot_axis axis = rot_statics_axis(&sums, about);
  ROT_CHECK_EQ_INT(axis.kind, 3);
  ROT_CHECK_ULP(axis.point[0], 2.0, 0);
  ROT_CHECK_ULP(axis.point[1], 0.0, 0);
  ROT_CHECK_ULP(axis.point[2], 5.0, 0);
  ROT_CHECK_ULP(axis.pitch_m, 2.0, 0);
  /* Forces that cancel leave a couple. */
  const double two[6] = {0, 0, 0, 0, 1e-3, 0}, pair[6] = {1e200, 0, 0, -1e200, 0, 0};
  const double no[6] = {0};
  const rot_sums pure = rot_statics_sums(2, two, pair, no, no);
  ROT_CHECK_EQ_INT(rot_statics_axis(&pure, no).kind, 2);
  ROT_CHECK_REL(pure.torque[2], 1e197, 1e-15);
}

int main(void) {
  exact_reactions();
  beam_in_any_units();
  tips();
  mechanism();
  forces_through_one_point();
  ranges();
  minimum_norm_that_pushes();
  circular_cone();
  plane_friction();
  error_near_a_mechanism();
  random_contacts();
  central_axis();
  return rot_test_report("statics");
}
