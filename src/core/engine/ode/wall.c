#include "engine/ode/wall.h"

#include <gsl/gsl_errno.h>
#include <math.h>
#include <string.h>

/* ---- sides ----------------------------------------------------------------------------------- */

static void settle(rot_ode_law *law, rot_ode_state *state, size_t wall, int side) {
  const rot_ode_wall *w = &law->walls->wall[wall];
  law->side[wall] = side;
  law->slides = side ? law->slides == wall ? NO_WALL : law->slides : wall;
  state->slope_known = 0;
  if (w->below == w->above) return;
  if (side) {
    state->y[w->component] = side > 0 ? w->above : w->below;
  } else {
    state->y[w->component] = w->below < 0.0 && w->above > 0.0 ? 0.0 : w->above;
  }
}

rot_status rot_ode_pass_wall(rot_ode_law *law, rot_ode_state *state, size_t wall) {
  const size_t c = law->walls->wall[wall].component;
  const double way = rot_ode_way(law->clock);
  const int was = law->side[wall];
  double *below = law->beside, *above = law->beyond;
  if (rot_ode_both_slopes(law, wall, law->clock->t, state->y, below, above) != GSL_SUCCESS) {
    if (law->status != ROT_ERHS) return law->status;
    settle(law, state, wall, was ? -was : 1); /* not defined beyond: the next step says so */
    return ROT_OK;
  }
  const double down = way * below[c], up = way * above[c];
  if (down > 0.0 && up < 0.0 && law->slides == NO_WALL) {
    settle(law, state, wall, 0);
  } else if (was > 0 || (was == 0 && down <= -up)) {
    settle(law, state, wall, down > 0.0 && up > 0.0 ? 1 : -1);
  } else {
    settle(law, state, wall, up < 0.0 && down < 0.0 ? -1 : 1);
  }
  return ROT_OK;
}

rot_status rot_ode_choose_side(rot_ode_law *law, rot_ode_state *state, size_t k) {
  const rot_ode_wall *w = &law->walls->wall[k];
  const double x = rot_ode_is_time(law, k) ? law->clock->t : state->y[w->component];
  const int later = rot_ode_is_time(law, k) && law->clock->forward ? x >= w->above : x > w->above;
  law->side[k] = later ? 1 : -1;
  if (rot_ode_is_time(law, k) || x < w->below || x > w->above) return ROT_OK;
  law->side[k] = 0;
  return rot_ode_pass_wall(law, state, k);
}

rot_status rot_ode_choose_sides(rot_ode_law *law, rot_ode_state *state) {
  rot_status status = ROT_OK;
  law->slides = NO_WALL;
  memset(law->side, 0, sizeof law->side);
  for (size_t k = 0; k < law->walls->count && status == ROT_OK; k++)
    status = rot_ode_choose_side(law, state, k);
  return status;
}

int rot_ode_add_wall(rot_ode_walls *walls, size_t component, double below, double above,
                      double size) {
  const double near = 1e-9 * (fabs(below) + fabs(size));
  if (walls->count == ROT_ODE_MOST_WALLS) return 0;
  for (size_t k = 0; k < walls->count; k++) {
    const rot_ode_wall *w = &walls->wall[k];
    if (w->component == component && above >= w->below - near && below <= w->above + near) return 0;
  }
  walls->wall[walls->count++] = (rot_ode_wall){component, below, above};
  return 1;
}

/* ---- on the way ------------------------------------------------------------------------------ */

double rot_ode_next_stop(const rot_ode_law *law, double stop) {
  for (size_t k = 0; k < law->walls->count; k++) {
    const rot_ode_wall *w = &law->walls->wall[k];
    if (!rot_ode_is_time(law, k)) continue;
    if (law->clock->forward ? law->side[k] < 0 && w->above < stop
                            : law->side[k] > 0 && w->below > stop) {
      stop = law->clock->forward ? w->above : w->below;
    }
  }
  return stop;
}

static int at_time(const rot_ode_law *law, size_t k) {
  const rot_ode_wall *w = &law->walls->wall[k];
  return rot_ode_is_time(law, k) && law->side[k] == (law->clock->forward ? -1 : 1) &&
         law->clock->t == (law->clock->forward ? w->above : w->below);
}

int rot_ode_at_time_wall(const rot_ode_law *law) {
  int at = 0;
  for (size_t k = 0; k < law->walls->count; k++) at |= at_time(law, k);
  return at;
}

void rot_ode_pass_time(rot_ode_law *law, rot_ode_state *state) {
  for (size_t k = 0; k < law->walls->count; k++) {
    if (at_time(law, k)) law->side[k] = -law->side[k];
  }
  state->slope_known = 0;
}
