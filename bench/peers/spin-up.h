/* The standard damped spin-up: a disk of 2 kg and 0.25 m. */
#ifndef BENCH_SPIN_UP_H
#define BENCH_SPIN_UP_H

static const double spin_inertia = 0.0625, spin_viscous = 0.03;

/* Straight lines between (0, 0), (1, 0.8), (4, 0.8), (6, 0), (8, 0). */
static inline double spin_torque(double t) {
  if (t < 1.0) return t > 0.0 ? 0.8 * t : 0.0;
  if (t < 4.0) return 0.8;
  return t < 6.0 ? 0.4 * (6.0 - t) : 0.0;
}

static inline void spin_rates(double t, const double y[], double rates[]) {
  rates[0] = y[1];
  rates[1] = (spin_torque(t) - spin_viscous * y[1]) / spin_inertia;
}

#endif
