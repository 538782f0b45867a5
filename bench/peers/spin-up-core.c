/* The spin-up by rotdyn's C core, without R: all seven columns, in memory that is there. */
#include "child.h"
#include "scene/axle/linear.h"
#include "spin-up.h"

static int solve(const char *how, solution *s) {
  static const double time_s[] = {0.0, 1.0, 4.0, 6.0, 8.0}, torque[] = {0.0, 0.8, 0.8, 0.0, 0.0};
  static double *spare[5];
  for (int i = 0; i < 5; i++) {
    if (!spare[i] && !(spare[i] = malloc(s->n * sizeof(double)))) return 1;
  }
  rot_axle_params params = {.inertia_kg_m2 = spin_inertia, .viscous_n_m_s = spin_viscous};
  const rot_axle_columns columns = {s->theta_rad, s->omega_rad_per_s, spare[0], spare[1],
                                    spare[2],     spare[3],           spare[4]};
  rot_info info;
  (void)how;
  params.torque.n = sizeof torque / sizeof *torque;
  params.torque.time_s = time_s;
  params.torque.torque_n_m = torque;
  s->rhs_calls = 0;
  return rot_axle_linear_fast(&params, s->n, s->time_s, &columns, NULL, &info) != ROT_OK;
}

int main(int argc, char **argv) { return child_main(argc, argv, solve); }
