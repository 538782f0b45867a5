/* A bowling ball thrown without spin: it slides, then rolls. */
#ifndef BENCH_SLIP_H
#define BENCH_SLIP_H

static const double slip_radius = 0.11, slip_speed = 8.1, slip_friction = 0.19, slip_gravity = 9.8;

#endif
