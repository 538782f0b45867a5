#define _POSIX_C_SOURCE 199309L /* clock_gettime */

#include "ground/clock.h"

#include <math.h>
#include <time.h>

double rot_clock_cpu_s(void) {
#ifdef CLOCK_PROCESS_CPUTIME_ID
  struct timespec now;
  if (clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now) == 0) {
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
  }
#endif
  const clock_t ticks = clock();
  return ticks == (clock_t)-1 ? (double)NAN : (double)ticks / (double)CLOCKS_PER_SEC;
}
