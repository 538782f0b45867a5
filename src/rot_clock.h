/* Processor time of this process, to measure what a run costs: other processes do not count. */
#ifndef ROT_CLOCK_H
#define ROT_CLOCK_H

/* In s since some moment; NaN where the system does not tell. */
double rot_clock_cpu_s(void);

#endif
