#include "scene/drive/contact.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "ground/real.h"

/* Tie: capacity and load agree to this relative difference; each is a sum of a few torques. */
#define TIE 1e-13

static double twist_rate(const rot_drive_system *s, const double y[], size_t j) {
  return rot_drive_omega(s, y, j) - s->scene->coupling[j].ratio * rot_drive_omega(s, y, j + 1);
}

void rot_drive_positions(const rot_drive_system *s, double h, const double before[], double y[]) {
  for (size_t u = 0; u < s->m; u++) y[u] = before[u] + h * y[s->m + u];
  for (size_t j = 0; j + 1 < s->n; j++) {
    if (s->scene->coupling[j].kind != ROT_DRIVE_SHAFT) continue;
    y[s->state_of[j]] = before[s->state_of[j]] + h * twist_rate(s, y, j);
  }
}

/* Rates of units, slip speeds (0 if sticking) and twists. */
void rot_drive_rates(const rot_drive_system *s, const double y[], const signed char mode[],
                     double dydt[]) {
  for (size_t u = 0; u < s->m; u++) {
    dydt[u] = y[s->m + u];
    dydt[s->m + u] = s->acceleration[u];
  }
  for (size_t j = 0; j + 1 < s->n; j++) {
    const rot_drive_coupling *c = &s->scene->coupling[j];
    if (c->kind == ROT_DRIVE_SHAFT) {
      dydt[s->state_of[j]] = twist_rate(s, y, j);
    } else if (c->kind == ROT_DRIVE_CLUTCH) {
      const size_t k = s->contact_of[j];
      dydt[s->state_of[j]] = mode[k] == ROT_DRIVE_STICKS ? 0.0 : rot_drive_slip_rate(s, k);
    }
  }
}

/* ---- rates of sticking bodies ---------------------------------------------------------------- */

static int clutch_behind(const rot_drive_system *s, size_t u, const signed char mode[]) {
  const size_t j = s->unit[u].end - 1;
  return u + 1 < s->m && s->scene->coupling[j].kind == ROT_DRIVE_CLUTCH &&
         mode[s->contact_of[j]] == ROT_DRIVE_STICKS;
}

/* Equal rates in each group. A group with a unit at rest is at rest, also where this unit has just
 * changed its direction: a rate within rounding would do so again. All its contacts to ground
 * stick. */
static void equal_rates(const rot_drive_system *s, double y[], signed char mode[]) {
  for (size_t from = 0; from < s->m;) {
    size_t to = from;
    double momentum = 0.0, inertia = 0.0;
    int held = 0;
    while (clutch_behind(s, to, mode)) to++;
    for (size_t u = from; u <= to; u++) {
      const double scaled = s->unit[u].inertia / s->unit[u].scale;
      momentum += scaled * y[s->m + u];
      inertia += scaled / s->unit[u].scale;
      held |= y[s->m + u] == 0.0;
    }
    for (size_t u = from; u <= to; u++) {
      if (held) {
        y[s->m + u] = 0.0;
        if (s->unit[u].ground != SIZE_MAX) mode[s->unit[u].ground] = ROT_DRIVE_STICKS;
      } else if (from < to) {
        y[s->m + u] = momentum / inertia / s->unit[u].scale;
      }
    }
    from = to + 1;
  }
}

/* ---- decisions ------------------------------------------------------------------------------- */

static signed char sign_mode(double x) { return x > 0.0 ? 1 : -1; }

/* The weakest contact breaks loose: the clutch, or all contacts that hold the units of the cut (at
 * its ends and to ground). */
static void let_go(const rot_drive_system *s, signed char mode[], double load) {
  const rot_drive_weakest *w = &s->weakest;
  const rot_drive_coupling *c = s->scene->coupling;
  if (!w->grounded) {
    mode[s->contact_of[s->unit[w->to].end - 1]] = sign_mode(load);
    return;
  }
  const signed char direction = sign_mode(load);
  for (size_t u = w->from; u <= w->to; u++) {
    if (s->unit[u].ground != SIZE_MAX) mode[s->unit[u].ground] = direction;
  }
  for (int behind = 0; behind < 2; behind++) { /* clutches at both ends */
    if (!behind && w->from == 0) continue;
    const size_t j = s->unit[behind ? w->to : w->from - 1].end - 1;
    if (j + 1 >= s->n || c[j].kind != ROT_DRIVE_CLUTCH) continue;
    const size_t k = s->contact_of[j];
    const int up = (s->product[j] > 0.0) == (behind != 0);
    if (mode[k] == ROT_DRIVE_STICKS) mode[k] = up ? direction : (signed char)-direction;
  }
}

/* A contact that broke loose and would slip against its direction sticks again. Returns 1 if there
 * is one. */
static int catches(const rot_drive_system *s, const double y[], signed char mode[]) {
  for (size_t k = 0; k < s->n_contacts; k++) {
    const rot_drive_contact *c = &s->contact[k];
    if (y[c->state] != 0.0 || mode[k] == ROT_DRIVE_STICKS || mode[k] == ROT_DRIVE_OPEN) continue;
    const double rate = rot_drive_slip_rate(s, k);
    double noise = 0.0;
    for (size_t u = c->unit; u < s->m && u <= c->unit + (c->coupling != SIZE_MAX); u++) {
      noise = fmax(noise, s->size[u] / s->unit[u].inertia);
    }
    if (rate * (double)mode[k] < -1e-12 * noise) {
      mode[k] = ROT_DRIVE_STICKS;
      return 1;
    }
  }
  return 0;
}

/* Decides a tie by the signs of margin and load at t + ahead_s, on the sticking motion. */
static rot_status look_ahead(rot_drive_system *s, double t, const double y[],
                             const signed char mode[], double ahead_s, double *margin,
                             double *load) {
  const rot_drive_weakest now = s->weakest;
  double *rate = malloc(2 * s->state * sizeof *rate), *later = rate + s->state;
  if (!rate) return ROT_ENOMEM;
  rot_drive_rates(s, y, mode, rate);
  for (size_t i = 0; i < s->state; i++) later[i] = y[i] + ahead_s * rate[i];
  rot_status status = rot_drive_forces(s, t + ahead_s, later, mode);
  *margin = s->weakest.margin;
  *load = s->weakest.load;
  memcpy(s->capacity_ahead, s->capacity, s->n_contacts * sizeof *s->capacity);
  if (status == ROT_OK) status = rot_drive_forces(s, t, y, mode);
  s->weakest = now;
  free(rate);
  return status;
}

/* Contacts without load, and without capacity now and ahead, become open: one whose capacity begins
 * to grow holds. Returns 1 if there is one. */
static int open_up(const rot_drive_system *s, signed char mode[]) {
  int found = 0;
  for (size_t k = 0; k < s->n_contacts; k++) {
    if (mode[k] == ROT_DRIVE_STICKS && s->capacity[k] == 0.0 && s->capacity_ahead[k] == 0.0) {
      mode[k] = ROT_DRIVE_OPEN;
      found = 1;
    }
  }
  return found;
}

/* A clutch that does not act is open, also between units that are held: nothing locks it. Only its
 * mode changes, since it carries nothing where it sticks. */
static void open_idle(const rot_drive_system *s, double t, signed char mode[]) {
  for (size_t k = 0; k < s->n_contacts; k++) {
    const size_t j = s->contact[k].coupling;
    if (j == SIZE_MAX || mode[k] != ROT_DRIVE_STICKS) continue;
    const rot_drive_friction *friction = &s->scene->coupling[j].friction;
    if (!(t >= friction->from_s && t < friction->to_s)) mode[k] = ROT_DRIVE_OPEN;
  }
}

/* Starts with all possible contacts sticking; breaks the weakest loose until the margins are
 * positive. */
static rot_status settle_contacts(rot_drive_system *s, double t, double y[], signed char mode[],
                                  int breaks, double ahead_s) {
  for (size_t k = 0; k < s->n_contacts; k++) {
    const double speed = y[s->contact[k].state];
    mode[k] = speed != 0.0 ? sign_mode(speed) : ROT_DRIVE_STICKS;
  }
  equal_rates(s, y, mode);
  /* A contact breaks loose and sticks again a few times at most; a cycle ends in its present
   * state. */
  for (size_t round = 0; round < 4 * s->n_contacts + 4; round++) {
    rot_status status = rot_drive_forces(s, t, y, mode);
    if (status != ROT_OK) return status;
    if (round > 0 && round < 2 * s->n_contacts + 2 && catches(s, y, mode)) continue;
    double margin = s->weakest.margin, load = s->weakest.load;
    if (margin > 1.5) return ROT_OK; /* no contact sticks */
    const int tie = fabs(margin) <= TIE, forced = breaks && round == 0;
    if (tie && !forced) {
      const double capacity = s->weakest.capacity;
      status = look_ahead(s, t, y, mode, ahead_s, &margin, &load);
      if (status != ROT_OK) return status;
      if (!(margin < -TIE)) {
        if (capacity == 0.0 && open_up(s, mode)) continue;
        return ROT_OK;
      }
    } else if (margin > 0.0 && !forced) {
      return ROT_OK;
    }
    let_go(s, mode, load);
  }
  return ROT_OK;
}

rot_status rot_drive_settle(rot_drive_system *s, double t, double y[], signed char mode[],
                            int breaks, double ahead_s) {
  const rot_status status = settle_contacts(s, t, y, mode, breaks, ahead_s);
  if (status == ROT_OK) open_idle(s, t, mode);
  return status;
}
