/* Bodies with a fixed point: the closed form against the integrator for every axis of symmetry, the
 * turning points, what is no symmetric top. */
#include <stdlib.h>

#include "free_rows.h"
#include "maths/attitude.h"
#include "scene/pivot/pivot.h"
#include "rot_test.h"

static rot_free_params random_top(int axis) {
  rot_free_params p = {.axes = {1.0}};
  const double across = uniform(0.5, 2.0);
  for (int i = 0; i < 3; i++) {
    p.moment_kg_m2[i] = across;
    p.omega0_rad_per_s[i] = uniform(-5.0, 5.0);
  }
  p.moment_kg_m2[axis] = across * uniform(0.1, 1.9);
  p.lever_n_m[axis] = uniform(-4.0, 4.0);
  for (int i = 0; i < 4; i++) p.q0[i] = uniform(-1.0, 1.0);
  (void)rot_attitude_unit(p.q0);
  p.start_s = 0.25;
  return p;
}

static void test_against_integration(void) {
  enum { N = 9 };
  double worst = 0.0, time_s[N];
  for (int i = 0; i < N; i++) time_s[i] = -0.5 + 0.5 * i;
  srand(40);
  for (int k = 0; k < rot_test_trials(120); k++) {
    const rot_free_params p = random_top(k % 3);
    rows a, b;
    rot_info info;
    const rot_free_columns out = columns_of(&a);
    ROT_CHECK(rot_pivot_not_top(&p) == NULL);
    ROT_CHECK(rot_pivot_top(&p, N, time_s, &out, NULL, NULL, &info) == ROT_OK);
    ROT_CHECK(info.measure[ROT_FREE_ATTITUDE].error <= 1e-13);
    ROT_CHECK_EQ_INT(integrated(&p, 1e-12, ROT_METHOD_RK8PD, N, time_s, &b, NULL, &info), ROT_OK);
    for (size_t i = 0; i < N; i++) {
      worst = fmax(worst, angle_between(&a, &b, i));
      ROT_CHECK(fabs(a.omega_y_rad_per_s[i] - b.omega_y_rad_per_s[i]) <= 1e-9);
    }
  }
  printf("tops against integration: %.1e rad\n", worst);
  ROT_CHECK(worst <= 1e-10);
}

/* A released top is highest at its start, half a nutation later lowest. */
static void test_events(void) {
  rot_free_params p = {.axes = {1.0}, .moment_kg_m2 = {1.0, 1.0, 0.5}, .q0 = {0.8, 0.6}};
  double nutation[3];
  rows a;
  rot_info info;
  const rot_free_columns out = columns_of(&a);
  rot_events events = {0};
  p.omega0_rad_per_s[2] = 9.0;
  p.lever_n_m[2] = 3.0;
  ROT_CHECK(rot_pivot_nutation(&p, nutation) == ROT_OK);
  const double time_s[1] = {1.25 * nutation[0]};
  ROT_CHECK(rot_pivot_top(&p, 1, time_s, &out, &events, NULL, &info) == ROT_OK);
  ROT_CHECK(events.count == 3 && events.event[0] == ROT_EVENT_HIGHEST &&
            events.event[1] == ROT_EVENT_LOWEST && events.event[2] == ROT_EVENT_HIGHEST);
  ROT_CHECK(events.time_s[0] == 0.0);
  ROT_CHECK_REL(events.time_s[1], 0.5 * nutation[0], 1e-15);
  /* in 60 digits, from the angle whose cosine is 0.8^2 - 0.6^2 */
  ROT_CHECK_REL(nutation[1], 0.15000659011670355235, 4e-16);
  ROT_CHECK_REL(nutation[2], 0.66505438407370041738, 4e-16);
  rot_events_free(&events);
}

/* Released or thrown, before the start and after it, the integrator lists the turns of the closed
 * form. */
static void test_turns_of_both(void) {
  enum { N = 3 };
  const double time_s[N] = {-2.0, 1.0, 6.0};
  srand(41);
  for (int k = 0; k < rot_test_trials(80); k++) {
    rot_free_params p = random_top(k % 3);
    if (k % 4 == 0) p.omega0_rad_per_s[(k + 1) % 3] = p.omega0_rad_per_s[(k + 2) % 3] = 0.0;
    rows a, b;
    rot_info info;
    rot_events form = {0}, steps = {0};
    const rot_free_columns out = columns_of(&a);
    ROT_CHECK_EQ_INT(rot_pivot_top(&p, N, time_s, &out, &form, NULL, &info), ROT_OK);
    ROT_CHECK_EQ_INT(integrated(&p, 1e-11, ROT_METHOD_NONE, N, time_s, &b, &steps, &info), ROT_OK);
    ROT_CHECK_EQ_INT((long)steps.count, (long)form.count);
    ROT_CHECK(form.count > 0);
    for (size_t i = 0; i < form.count && i < steps.count; i++) {
      ROT_CHECK(form.event[i] == steps.event[i]);
      ROT_CHECK(fabs(form.time_s[i] - steps.time_s[i]) <= 1e-8);
    }
    rot_events_free(&form);
    rot_events_free(&steps);
  }
}

static void test_refusals(void) {
  rot_free_params p = {.axes = {1.0}, .moment_kg_m2 = {1.0, 1.0, 0.5}, .q0 = {1.0}};
  p.lever_n_m[2] = 1.0;
  ROT_CHECK(rot_pivot_not_top(&p) == NULL);
  p.moment_kg_m2[1] = 1.1;
  ROT_CHECK(rot_pivot_not_top(&p) != NULL);
  p.moment_kg_m2[1] = 1.0;
  p.lever_n_m[0] = 0.1;
  ROT_CHECK(rot_pivot_not_top(&p) != NULL);
}

int main(void) {
  test_against_integration();
  test_events();
  test_turns_of_both();
  test_refusals();
  return rot_test_report("pivot");
}
