/* Sums of torque laws: knots against what each law gives by itself, jumps, exact totals; the normal
 * form of sums. */
#include "engine/loads.h"

#include <stdlib.h>

#include "rot_test.h"

static uint64_t next(void) {
  static uint64_t x = 88172645463325252u;
  x ^= x << 13;
  x ^= x >> 7;
  return x ^= x << 17;
}

/* Up to eight knots at quarters of a second, so that some coincide and some are jumps. */
static rot_torque random_knots(double time_s[8], double torque[8]) {
  const size_t n = next() % 8;
  rot_torque law = {.n = n, .time_s = time_s, .torque_n_m = torque};
  double t = 0.25 * (double)(next() % 8);
  for (size_t i = 0; i < n; i++) {
    time_s[i] = t;
    torque[i] = (double)(next() % 17) - 8.0;
    t += 0.25 * (double)(next() % 4);
  }
  if (n == 0 || next() % 2) law.before_n_m = (double)(next() % 5) - 2.0;
  law.after_n_m = n == 0 ? law.before_n_m : (double)(next() % 5) - 2.0;
  return law;
}

/* Small whole numbers at quarters: everything is exact but the slopes. */
static void check_random_sums(void) {
  enum { LAWS = 5 };
  const int trials = rot_test_trials(4000);
  for (int i = 0; i < trials; i++) {
    double time_s[LAWS][8], torque[LAWS][8];
    rot_torque law[LAWS], sum;
    rot_store store = {0};
    const size_t n = 1 + next() % LAWS;
    for (size_t k = 0; k < n; k++) law[k] = random_knots(time_s[k], torque[k]);
    ROT_CHECK_EQ_INT(rot_loads_add_knots(n, law, &store, &sum), ROT_OK);
    for (size_t k = 1; k < sum.n; k++) ROT_CHECK(sum.time_s[k] >= sum.time_s[k - 1]);
    for (int j = 0; j < 40; j++) {
      /* Between quarters: at a jump, and at the last knot of one law, the laws have two values. */
      const double t = 0.125 + 0.25 * (double)(next() % 48) - 1.0;
      double want = 0.0;
      for (size_t k = 0; k < n; k++) want += rot_torque_at(&law[k], t);
      ROT_CHECK(fabs(rot_torque_at(&sum, t) - want) <= 1e-14 * 50.0);
    }
    rot_store_free(&store);
  }
}

static void check_sums(void) {
  const double a_s[] = {0.0, 1.0}, a[] = {1e16, 1e16}, b[] = {-1e16, -1e16};
  const double late_s[] = {0.5, 2.0}, late[] = {1.0, 1.0};
  rot_torque law[] = {{.n = 2, .time_s = a_s, .torque_n_m = a},
                      {.n = 2, .time_s = late_s, .torque_n_m = late},
                      {.n = 2, .time_s = a_s, .torque_n_m = b}};
  rot_torque sum;
  rot_store store = {0};
  /* 1e16 + 1 - 1e16 is 1. Jumps at 0.5 and 2; where the torque ends, its last value is kept. */
  ROT_CHECK_EQ_INT(rot_loads_add_knots(3, law, &store, &sum), ROT_OK);
  const double times[] = {0.0, 0.5, 0.5, 1.0, 2.0}, values[] = {0.0, 0.0, 1.0, 1.0, 1.0};
  ROT_CHECK_EQ_INT(sum.n, 5);
  for (size_t i = 0; i < 5; i++) {
    ROT_CHECK(sum.time_s[i] == times[i] && sum.torque_n_m[i] == values[i]);
  }
  ROT_CHECK(sum.before_n_m == 0.0 && sum.after_n_m == 0.0);
  /* One law is itself, none is nothing, constants have no knots. */
  ROT_CHECK(rot_loads_add_knots(1, law, &store, &sum) == ROT_OK && sum.time_s == a_s);
  ROT_CHECK(rot_loads_add_knots(0, law, &store, &sum) == ROT_OK && sum.n == 0);
  law[0] = rot_loads_constant(2.0);
  law[1] = rot_loads_constant(3.0);
  ROT_CHECK(rot_loads_add_knots(2, law, &store, &sum) == ROT_OK && sum.n == 0);
  ROT_CHECK(sum.before_n_m == 5.0 && sum.after_n_m == 5.0);
  rot_store_free(&store);
}

static rot_status call(const double argument[], double value[], void *ctx) {
  *value = *(double *)ctx * argument[0] + argument[1] + argument[2];
  return argument[0] > 9.0 ? ROT_EUNWIND : ROT_OK;
}

static void check_normal_form(void) {
  const double breaks[] = {1.0, 3.0}, others[] = {2.0, 3.0}, spring[] = {4.0, 0.0}, one = 1.5;
  double factor[] = {2.0, 3.0};
  const rot_law_one laws[] = {
      {.kind = ROT_LAW_MOTOR, .stall_n_m = 2.0, .no_load_rad_per_s = 8.0, .noise_n_m = 0.25},
      {.kind = ROT_LAW_TERM, .term = {ROT_TERM_SPRING, -INFINITY, INFINITY, 2, spring}},
      {.kind = ROT_LAW_CALL,
       .call = {.call = call, .ctx = &factor[0]},
       .n_breaks = 2,
       .breaks_s = breaks,
       .noise_n_m = 0.5},
      {.kind = ROT_LAW_MOTOR, .stall_n_m = -1.0, .no_load_rad_per_s = -2.0}};
  const rot_law_sum sum = {4, laws};
  const rot_law_one more = {.kind = ROT_LAW_CALL,
                            .call = {.call = call, .ctx = &factor[1]},
                            .n_breaks = 2,
                            .breaks_s = others,
                            .noise_n_m = 2.0};
  const rot_law_sum last = {1, &more};
  const rot_given nested[] = {{.is = ROT_INPUT_TORQUE, .object = &last}, {0}};
  const rot_given items[] = {{.is = ROT_INPUT_NUMBER, .n = 1, .x = &one},
                             {.is = ROT_INPUT_TORQUE, .object = &sum},
                             {.is = ROT_INPUT_LIST, .n = 2, .item = nested}};
  const rot_given list = {.is = ROT_INPUT_LIST, .n = 3, .item = items}, nothing = {0};
  rot_store store = {0};
  rot_loads loads;
  ROT_CHECK_EQ_INT(rot_loads_of(&list, &store, &loads), ROT_OK);
  ROT_CHECK(loads.knots.n == 0 && loads.knots.after_n_m == 2.5 && loads.motor_n_m_s == 0.75);
  ROT_CHECK(loads.noise_n_m == 0.25 + 0.5 + 2.0);
  ROT_CHECK(loads.n_terms == 1 && loads.terms->kind == ROT_TERM_SPRING);
  ROT_CHECK(loads.n_breaks == 3 && loads.breaks_s[0] == 1.0 && loads.breaks_s[1] == 2.0 &&
            loads.breaks_s[2] == 3.0);
  double torque = 0.0;
  ROT_CHECK_EQ_INT(loads.knots.call(1.0, 0.5, 0.25, &torque, loads.knots.ctx), ROT_OK);
  ROT_CHECK(torque == 2.75 + 3.75);
  ROT_CHECK_EQ_INT(loads.knots.call(10.0, 0.0, 0.0, &torque, loads.knots.ctx), ROT_EUNWIND);
  ROT_CHECK_EQ_INT(rot_loads_of(&nothing, &store, &loads), ROT_OK);
  ROT_CHECK(loads.knots.n == 0 && loads.knots.after_n_m == 0.0 && !loads.knots.call);
  const double huge[] = {1e308, 1e308};
  const rot_given both[] = {{.is = ROT_INPUT_NUMBER, .n = 1, .x = &huge[0]},
                            {.is = ROT_INPUT_NUMBER, .n = 1, .x = &huge[1]}};
  const rot_given beyond = {.is = ROT_INPUT_LIST, .n = 2, .item = both};
  ROT_CHECK_EQ_INT(rot_loads_of(&beyond, &store, &loads), ROT_EVALUE);
  rot_store_free(&store);
}

int main(void) {
  check_sums();
  check_random_sums();
  check_normal_form();
  return rot_test_report("loads");
}
