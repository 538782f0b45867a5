/* A round body on an incline that rolls, slides or rests. Positive: down the slope.
 *
 *   m v' = m g sin(angle) - F,   I omega' = F R - T,   N = m g cos(angle).
 *
 * F: friction of the contact. Slipping: mu_kinetic N sign(v - R omega). Rolling: F keeps v = R
 * omega, |F| <= mu_static N. T: rolling resistance. Turning: arm N sign(omega). Not turning: T
 * keeps omega = 0, |T| <= arm N. All accelerations are constant between events, whose times are
 * exact. */
#ifndef ROT_INCLINE_H
#define ROT_INCLINE_H

#include <stddef.h>

#include "engine/events.h"
#include "ground/real.h"
#include "ground/status.h"
#include "scene/incline/contact.h"

typedef struct rot_incline_params {
  double mass_kg;          /* > 0 */
  double radius_m;         /* > 0 */
  double inertia_kg_m2;    /* > 0 */
  double angle_deg;        /* -90 to 90 */
  double gravity_m_per_s2; /* >= 0 */
  double mu_kinetic;       /* >= 0 */
  double mu_static;        /* >= mu_kinetic; Inf: no slip, also without a normal force */
  double arm_m;            /* >= 0, of the rolling resistance */
  double x0_m, v0_m_per_s, theta0_rad, omega0_rad_per_s; /* state at start_s */
  double start_s;
} rot_incline_params;

/* Measures of the errors. The list of names ends with NULL. */
enum { ROT_INCLINE_X, ROT_INCLINE_V, ROT_INCLINE_THETA, ROT_INCLINE_OMEGA };
extern const char *const rot_incline_measures[];

#define ROT_INCLINE_COLUMNS(X)                                                                     \
  X(double, x_m)                                                                                   \
  X(double, v_m_per_s)                                                                             \
  X(double, theta_rad)                                                                             \
  X(double, omega_rad_per_s)                                                                       \
  X(double, slip_speed_m_per_s)                                                                    \
  X(double, friction_force_n) /* on the body, positive down the slope */                           \
  X(double, translational_kinetic_energy_j)                                                        \
  X(double, rotational_kinetic_energy_j)                                                           \
  X(double, potential_energy_j) /* 0 at x = 0 */                                                   \
  X(double, slip_heat_j)        /* since the start */                                              \
  X(double, rolling_heat_j)                                                                        \
  X(int, rolling)

typedef struct rot_incline_columns {
#define X(type, name) type *name;
  ROT_INCLINE_COLUMNS(X)
#undef X
} rot_incline_columns;

/* Columns of integrated runs only: integrals since the start, and forces. */
#define ROT_INCLINE_SUMS(X)                                                                        \
  X(applied_work_j)                                                                                \
  X(drag_heat_j)                                                                                   \
  X(friction_impulse_n_s) /* along the slope */                                                    \
  X(drag_impulse_n_s)                                                                              \
  X(applied_impulse_n_s)                                                                           \
  X(resistance_impulse_n_m_s) /* about the centre of mass */                                       \
  X(drag_force_n)             /* at the time of the row */                                         \
  X(applied_force_n)
/* Errors of the first six, then of the two heats of the rows. */
enum { ROT_INCLINE_OF_SLIP_HEAT = 6, ROT_INCLINE_OF_ROLLING_HEAT, ROT_INCLINE_SUM_ERRORS };

/* Columns at the time of an event, after the event. */
typedef struct rot_incline_row {
  double time_s;
#define X(type, name) type name;
  ROT_INCLINE_COLUMNS(X)
#undef X
#define X(name) double name;
  ROT_INCLINE_SUMS(X)
#undef X
} rot_incline_row;

/* One row for each time with an event, ascending. Initialise with {0}. */
typedef struct rot_incline_event_rows {
  size_t count, room;
  rot_incline_row *row;
} rot_incline_event_rows;

/* time => its row; appended unless the last row has this time. NULL: out of memory. */
rot_incline_row *rot_incline_event_row(rot_incline_event_rows *rows, double time_s);
/* Frees the memory of the rows. */
void rot_incline_event_rows_free(rot_incline_event_rows *rows);
/* row => pointers to its values, as columns of length 1. */
rot_incline_columns rot_incline_columns_of(rot_incline_row *row);

/* (parameters, times) => rows, events, errors. Times: finite, not decreasing, >= start_s (else
 * ROT_EVALUE). mu_kinetic is finite unless the start rolls. A slip at the start within its rounding
 * is 0.
 *
 * Events: roll, slip, stick, reverse (the velocity changes its sign), slip_reverse (the slip
 * changes its sign without sticking). at_events: the rows at the events if `events` is not NULL;
 * NULL: none. The errors in *info are bounds for all rows, unless a force is within rounding of the
 * breakaway force; then it is taken as held. */
rot_status rot_incline_run(const rot_incline_params *p, size_t n, const double time_s[],
                           const rot_incline_columns *out, rot_events *events,
                           rot_incline_event_rows *at_events, const rot_hooks *hooks,
                           rot_info *info);

/* The state at one time. */
typedef struct rot_incline_end {
  double x_m, v_m_per_s, theta_rad, omega_rad_per_s;
  double slip_heat_j, rolling_heat_j; /* since the start */
  double roll_s;                      /* time at which slip first ended; NaN: it did not */
  double error; /* largest bound, each relative to the largest value at start, events and end */
  int rolling;
} rot_incline_end;

/* (parameters, time >= start_s) => state. ROT_EVALUE: a number is outside its domain. */
rot_status rot_incline_to(const rot_incline_params *p, double time_s, rot_incline_end *end);

/* 1 if parameters and time are in their domain, else 0. */
static inline int rot_incline_possible(const rot_incline_params *p, double time_s) {
  const double v0 = p->v0_m_per_s, slip = fabs(v0 - p->radius_m * p->omega0_rad_per_s);
  return p->mass_kg > 0.0 && p->radius_m > 0.0 && p->inertia_kg_m2 > 0.0 && p->arm_m >= 0.0 &&
         p->gravity_m_per_s2 >= 0.0 && fabs(p->angle_deg) <= 90.0 && p->mu_kinetic >= 0.0 &&
         p->mu_static >= p->mu_kinetic && time_s >= p->start_s && isfinite(p->mass_kg) &&
         isfinite(p->radius_m) && isfinite(p->inertia_kg_m2) && isfinite(p->gravity_m_per_s2) &&
         isfinite(p->arm_m) && isfinite(v0) && isfinite(p->omega0_rad_per_s) && isfinite(time_s) &&
         (isfinite(p->mu_kinetic) || slip <= 8.0 * ROT_EPS * fabs(v0));
}

typedef struct rot_incline_ledger {
  double work_j;                                    /* of gravity */
  double gravity_impulse_n_s, friction_impulse_n_s; /* along the slope */
  double resistance_impulse_n_m_s;                  /* about the centre of mass */
  /* Rounding errors of these, >= 0. */
  double work_rounding_j, gravity_rounding_n_s, friction_rounding_n_s, resistance_rounding_n_m_s;
} rot_incline_ledger;

/* (parameters, two times >= start_s) => work, impulses. */
rot_status rot_incline_flows(const rot_incline_params *p, double from_s, double to_s,
                             rot_incline_ledger *ledger);

/* (angle, its sine and cosine) => factor >= 1: a force up to this times the breakaway force counts
 * as held. It covers the rounding of both forces. */
double rot_incline_holds(double angle_deg, double sine, double cosine);
/* parameters => contact. */
void rot_incline_touch(const rot_incline_params *p, rot_incline_contact *out);

/* (modes before and after, at rest before and after) => events in the log. `turned`: log a
 * reversal, unless the body comes to rest. */
rot_status rot_incline_log(rot_events *events, double time_s, rot_incline_directions from,
                           rot_incline_directions to, int rested, int rests, int turned);

/* (beta = I/(m R^2), mu_static) => largest angle in degrees at which the body rolls from rest. */
double rot_incline_critical_deg(double beta, double mu_static);

#endif
