#include "maths/propagator.h"

#include <math.h>

#include "rot_test.h"

/* A turn by 1e9 rad, forwards a slow decay beside it: the library's cosine reduces its argument
 * exactly. */
static void check_turn(void) {
  const rot_dd zero = {0.0, 0.0}, w = {1e9, 0.0}, slow = {-0.5, 0.0};
  const rot_dd a[9] = {zero, w, zero, rot_dd_neg(w), zero, zero, zero, zero, slow};
  const double times[] = {0.0, 1e-12, 0.25, 1.0, 3.0};
  rot_propagator p;
  ROT_CHECK_EQ_INT(rot_propagator_begin(&p, 3, a, NULL), ROT_OK);
  for (int i = 0; i < 5; i++) {
    rot_dd x[3] = {{1.0, 0.0}, zero, {1.0, 0.0}};
    ROT_CHECK_EQ_INT(rot_propagator_move(&p, (rot_dd){times[i], 0.0}, x), ROT_OK);
    const rot_dd phase = rot_dd_mul2(1e9, times[i]);
    ROT_CHECK(fabs(x[0].hi - (cos(phase.hi) - phase.lo * sin(phase.hi))) <= 4e-16);
    ROT_CHECK(fabs(x[1].hi + sin(phase.hi) + phase.lo * cos(phase.hi)) <= 4e-16);
    ROT_CHECK(fabs(x[2].hi - exp(-0.5 * times[i])) <= 4e-16);
  }
  rot_propagator_end(&p);
}

static void check_refusals(void) {
  const rot_dd bad = {INFINITY, 0.0}, grows = {1e3, 0.0};
  rot_dd x = {1.0, 0.0};
  rot_propagator p;
  ROT_CHECK_EQ_INT(rot_propagator_begin(&p, 1, &bad, NULL), ROT_ERANGE);
  rot_propagator_end(&p);
  ROT_CHECK_EQ_INT(rot_propagator_begin(&p, 1, &grows, NULL), ROT_OK);
  ROT_CHECK_EQ_INT(rot_propagator_move(&p, (rot_dd){1.0, 0.0}, &x), ROT_ERANGE);
  rot_propagator_end(&p);
}

int main(void) {
  check_turn();
  check_refusals();
  return rot_test_report("propagator");
}
