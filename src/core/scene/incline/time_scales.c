#include "scene/incline/time_scales.h"

#include <math.h>

#include "scene/incline/incline.h"
#include "scene/incline/ode.h"

/* Without gravity and drag there is no time scale. */
void rot_incline_time_scales(const void *of, const double sizes[], rot_time_scales *to) {
  const rot_incline_scene *scene = of;
  const rot_incline_params *p = &scene->slope;
  const double speed = fmax(sizes[ROT_INCLINE_V], p->radius_m * sizes[ROT_INCLINE_OMEGA]);
  const double drag = (scene->drag_n_s_per_m + scene->drag_n_s2_per_m2 * speed) / p->mass_kg;
  const double falls = speed / p->gravity_m_per_s2;
  to->swing_rad_per_s = 0.0;
  to->fades_s = drag > 0.0 ? 1.0 / drag : INFINITY;
  if (isfinite(falls) && falls > 0.0) to->fades_s = fmin(to->fades_s, falls);
}

void rot_incline_time_scales_of_start(const void *of, rot_time_scales *to) {
  const rot_incline_params *p = &((const rot_incline_scene *)of)->slope;
  double sizes[ROT_MAX_MEASURES] = {0.0};
  sizes[ROT_INCLINE_V] = fabs(p->v0_m_per_s);
  sizes[ROT_INCLINE_OMEGA] = fabs(p->omega0_rad_per_s);
  rot_incline_time_scales(of, sizes, to);
}
