/* Processor time: it does not go back, and it grows by about what work takes. */
#include "ground/clock.h"

#include <time.h>

#include "rot_test.h"

/* Work until the clock of the C library has gone on by that much. */
static double work(double seconds) {
  const clock_t start = clock();
  volatile double x = 1.0;
  while ((double)(clock() - start) < seconds * (double)CLOCKS_PER_SEC) x = sqrt(x + 1.0);
  return x;
}

int main(void) {
  double before = rot_clock_cpu_s(), grown;
  for (int i = 0; i < 1000; i++) {
    const double now = rot_clock_cpu_s();
    ROT_CHECK(now >= before);
    before = now;
  }
  before = rot_clock_cpu_s();
  ROT_CHECK(work(0.05) > 1.0);
  grown = rot_clock_cpu_s() - before;
  ROT_CHECK(grown > 0.045 && grown < 0.2);
  return rot_test_report("clock");
}
