/* The sweep by rotdyn's C core, without R: all seven columns, in memory that is there. One
 * thread; HOW is not looked at. */
#include "child.h"
#include "scene/axle/sweep.h"
#include "sweep.h"

static double *column(size_t n) {
  double *x = malloc(n * sizeof *x);
  if (!x) exit(EXIT_FAILURE);
  return x;
}

static int solve(const char *how, solution *s) {
  static const double time_s[] = {0.0, 1.0, 4.0, 6.0, 8.0}, torque[] = {0.0, 0.8, 0.8, 0.0, 0.0};
  static const double none = 0.0, one = 1.0, end = 8.0;
  static double *inertia, *viscous, *to[5];
  static int *status;
  if (!inertia) {
    inertia = column(s->n);
    viscous = column(s->n);
    for (size_t i = 0; i < s->n; i++) {
      inertia[i] = sweep_inertia(s->time_s[i]);
      viscous[i] = sweep_viscous(s->time_s[i]);
    }
    for (int j = 0; j < 5; j++) to[j] = column(s->n);
    status = malloc(s->n * sizeof *status);
    if (!status) return 1;
  }
  const rot_torque law = {5, time_s, torque, 0.0, 0.0, NULL, NULL};
  const rot_axle_sweep_rows rows = {s->n,      0.0,        {inertia, 1}, {viscous, 1},
                                    {&one, 0}, {&none, 0}, {&none, 0},   {&end, 0}};
  const rot_axle_sweep_columns out = {
      s->theta_rad, s->omega_rad_per_s, to[0], to[1], to[2], to[3], to[4], status};
  rot_info info;
  (void)how;
  s->rhs_calls = 0;
  return rot_axle_sweep_linear(&law, &rows, 1, &out, NULL, &info) != ROT_OK;
}

int main(int argc, char **argv) { return child_main(argc, argv, solve); }
