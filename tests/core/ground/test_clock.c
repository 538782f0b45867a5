/* Processor time: it does not go back, and it grows by about what work takes. */
#define _POSIX_C_SOURCE 199309L /* CLOCK_PROCESS_CPUTIME_ID */

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
  int finer = 0;
  for (int i = 0; i < 1000; i++) {
    const double now = rot_clock_cpu_s();
    ROT_CHECK(now >= before);
    finer += fabs(now * 1e6 - round(now * 1e6)) > 1e-3;
    before = now;
  }
#ifdef CLOCK_PROCESS_CPUTIME_ID
  ROT_CHECK(finer > 0); /* clock(), which serves elsewhere, counts whole microseconds */
#endif
  before = rot_clock_cpu_s();
  ROT_CHECK(work(0.05) > 1.0);
  grown = rot_clock_cpu_s() - before;
  ROT_CHECK(grown > 0.045 && grown < 0.2);
  return rot_test_report("clock");
}
