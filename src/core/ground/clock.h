/* Processor time of this process, to measure the cost of a run. */
#ifndef ROT_CLOCK_H
#define ROT_CLOCK_H

#include "ground/ieee.h"

/* In s, from an arbitrary origin; NaN where it is not available. */
double rot_clock_cpu_s(void);

#endif
