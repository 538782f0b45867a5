/* Processor time of this process, to measure the cost of a run. */
#ifndef ROT_CLOCK_H
#define ROT_CLOCK_H

#include "ground/ieee.h"

/* => processor time in s from an arbitrary origin; NaN if unavailable. */
double rot_clock_cpu_s(void);

#endif
