#include "engine/ode/wall.h"

#include <gsl/gsl_errno.h>
#include <math.h>
#include <string.h>

#include "engine/ode/event.h"
#include "engine/ode/growth.h"
#include "engine/ode/law.h"

/* ---- sides ----------------------------------------------------------------------------------- */

static void settle(rot_ode_march *run, size_t wall, int side) {
  const rot_ode_wall *w = &run->walls->wall[wall];
  run->side[wall] = side;
  run->slides = side ? run->slides == wall ? NO_WALL : run->slides : wall;
  run->slope_known = 0;
  if (side == 0) rot_ode_growth_hold(run->growth, w->component);
  if (w->below == w->above) return;
  if (side) {
    run->y[w->component] = side > 0 ? w->above : w->below;
  } else {
    run->y[w->component] = w->below < 0.0 && w->above > 0.0 ? 0.0 : w->above;
  }
}

rot_status rot_ode_pass_wall(rot_ode_march *run, size_t wall) {
  const size_t c = run->walls->wall[wall].component;
  const double way = run->forward ? 1.0 : -1.0;
  const int was = run->side[wall];
  double *below = run->beside, *above = run->beyond;
  if (rot_ode_both_slopes(run, wall, run->t, run->y, below, above) != GSL_SUCCESS) {
    if (run->status != ROT_ERHS) return run->status;
    settle(run, wall, was ? -was : 1); /* not defined beyond: the next step says so */
    return ROT_OK;
  }
  const double down = way * below[c], up = way * above[c];
  const int held = down > 0.0 && up < 0.0 && (run->slides == NO_WALL || run->slides == wall);
  if (held && run->slides == NO_WALL) {
    settle(run, wall, 0);
  } else if (was > 0 || (was == 0 && down <= -up)) {
    settle(run, wall, down > 0.0 && up > 0.0 ? 1 : -1);
  } else {
    settle(run, wall, up < 0.0 && down < 0.0 ? -1 : 1);
  }
  return ROT_OK;
}

static rot_status choose_side(rot_ode_march *run, size_t k) {
  const rot_ode_wall *w = &run->walls->wall[k];
  const double x = rot_ode_is_time(run, k) ? run->t : run->y[w->component];
  const int later = rot_ode_is_time(run, k) && run->forward ? x >= w->above : x > w->above;
  run->side[k] = later ? 1 : -1;
  if (rot_ode_is_time(run, k) || x < w->below || x > w->above) return ROT_OK;
  run->side[k] = 0;
  return rot_ode_pass_wall(run, k);
}

rot_status rot_ode_choose_sides(rot_ode_march *run) {
  rot_status status = ROT_OK;
  run->slides = NO_WALL;
  memset(run->side, 0, sizeof run->side);
  for (size_t k = 0; k < run->walls->count && status == ROT_OK; k++) status = choose_side(run, k);
  return status;
}

rot_status rot_ode_add_wall(rot_ode_march *run, size_t component, double below, double above,
                            int *added) {
  rot_ode_walls *walls = run->walls;
  *added = 0;
  if (walls->count == ROT_ODE_MOST_WALLS) return ROT_OK;
  for (size_t k = 0; k < walls->count; k++) {
    const rot_ode_wall *w = &walls->wall[k];
    const double near = 1e-9 * (fabs(below) + fabs(run->h));
    if (w->component == component && above >= w->below - near && below <= w->above + near) {
      return ROT_OK;
    }
  }
  walls->wall[walls->count++] = (rot_ode_wall){component, below, above};
  *added = 1;
  if (!run->watch) return ROT_OK; /* of later runs */
  run->n_watch++;
  rot_status status = choose_side(run, walls->count - 1);
  if (status == ROT_OK) status = rot_ode_know_slope(run);
  /* That alone: an event that was just met has a zero here that is no new one. */
  if (status == ROT_OK) rot_ode_arm_last(run);
  return status;
}

/* ---- on the way ------------------------------------------------------------------------------ */

int rot_ode_passes_wall(const rot_ode_march *run) {
  const size_t first = run->n_watch - run->walls->count;
  for (size_t k = 0; k < run->walls->count; k++) {
    const int side = run->side[k];
    if (rot_ode_is_time(run, k) || side == 0 || run->watch[first + k].fresh) continue;
    const size_t c = run->walls->wall[k].component;
    const double level = rot_ode_wall_level(run, k);
    if (side * (run->y[c] - level) > 0.0 && side * (run->trial[c] - level) <= 0.0) return 1;
  }
  return 0;
}

double rot_ode_next_stop(const rot_ode_march *run, double stop) {
  for (size_t k = 0; k < run->walls->count; k++) {
    const rot_ode_wall *w = &run->walls->wall[k];
    if (!rot_ode_is_time(run, k)) continue;
    if (run->forward ? run->side[k] < 0 && w->above < stop : run->side[k] > 0 && w->below > stop) {
      stop = run->forward ? w->above : w->below;
    }
  }
  return stop;
}

static int at_time(const rot_ode_march *run, size_t k) {
  const rot_ode_wall *w = &run->walls->wall[k];
  return rot_ode_is_time(run, k) && run->side[k] == (run->forward ? -1 : 1) &&
         run->t == (run->forward ? w->above : w->below);
}

int rot_ode_at_time_wall(const rot_ode_march *run) {
  int at = 0;
  for (size_t k = 0; k < run->walls->count; k++) at |= at_time(run, k);
  return at;
}

void rot_ode_pass_time(rot_ode_march *run) {
  for (size_t k = 0; k < run->walls->count; k++) {
    if (at_time(run, k)) run->side[k] = -run->side[k];
  }
  run->slope_known = 0;
}
