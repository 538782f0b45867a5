/* The sliding ball by rotdyn's C core, without R: twelve columns, in memory that is there. */
#include <math.h>

#include "child.h"
#include "scene/incline/incline.h"
#include "slip.h"

static int solve(const char *how, solution *s) {
  static double *spare[9];
  static int *rolling;
  for (int i = 0; i < 9; i++) {
    if (!spare[i] && !(spare[i] = malloc(s->n * sizeof(double)))) return 1;
  }
  if (!rolling && !(rolling = malloc(s->n * sizeof(int)))) return 1;
  const rot_incline_params params = {.mass_kg = 6.0,
                                     .radius_m = slip_radius,
                                     .inertia_kg_m2 = 0.4 * 6.0 * slip_radius * slip_radius,
                                     .gravity_m_per_s2 = slip_gravity,
                                     .mu_kinetic = slip_friction,
                                     .mu_static = slip_friction,
                                     .v0_m_per_s = slip_speed};
  const rot_incline_columns columns = {spare[0], spare[1], s->theta_rad, s->omega_rad_per_s,
                                       spare[2], spare[3], spare[4],     spare[5],
                                       spare[6], spare[7], spare[8],     rolling};
  rot_info info;
  (void)how;
  s->rhs_calls = 0;
  return rot_incline_run(&params, s->n, s->time_s, &columns, NULL, NULL, NULL, &info) != ROT_OK;
}

int main(int argc, char **argv) { return child_main(argc, argv, solve); }
