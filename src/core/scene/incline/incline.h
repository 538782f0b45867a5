/* A round body on an incline that rolls, slides or rests. Down the slope is positive:
 *
 *   m v' = m g sin(angle) - F,   I omega' = F R - T,
 *
 * F is the friction of the contact: mu_kinetic N sign(v - R omega) while it slides, what keeps
 * v = R omega while it rolls, as long as that is at most mu_static N. T is the rolling resistance:
 * arm N sign(omega) while the body turns, what keeps omega = 0 as long as that is at most arm N.
 * N = m g cos(angle). All rates are constant between events, whose times are exact. */
#ifndef ROT_INCLINE_H
#define ROT_INCLINE_H

#include <stddef.h>

#include "engine/events.h"
#include "ground/real.h"
#include "ground/status.h"
#include "scene/incline/contact.h"

typedef struct rot_incline_params {
  double mass_kg, radius_m, inertia_kg_m2; /* > 0 */
  double angle_deg;                        /* -90 to 90 */
  double gravity_m_per_s2;                 /* >= 0 */
  double mu_kinetic, mu_static;            /* 0 <= mu_kinetic <= mu_static; Inf: no slip, without
                                              a normal force either */
  double arm_m;                            /* of the rolling resistance, >= 0 */
  double x0_m, v0_m_per_s, theta0_rad, omega0_rad_per_s, start_s;
} rot_incline_params;

/* Measures of its errors; the list of names ends with NULL. */
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

/* Sums since the start, and forces now, of integrated runs alone. */
#define ROT_INCLINE_SUMS(X)                                                                        \
  X(applied_work_j)                                                                                \
  X(drag_heat_j)                                                                                   \
  X(friction_impulse_n_s) /* along the slope */                                                    \
  X(drag_impulse_n_s)                                                                              \
  X(applied_impulse_n_s)                                                                           \
  X(resistance_impulse_n_m_s) /* about the centre of mass */                                       \
  X(drag_force_n)             /* now */                                                            \
  X(applied_force_n)
enum { ROT_INCLINE_SUM_ERRORS = 8 };

/* The columns at the time of an event, after it. */
typedef struct rot_incline_row {
  double time_s;
#define X(type, name) type name;
  ROT_INCLINE_COLUMNS(X)
#undef X
#define X(name) double name;
  ROT_INCLINE_SUMS(X)
#undef X
} rot_incline_row;

/* One for each time at which there is an event, in order. Begin with {0}. */
typedef struct rot_incline_event_rows {
  size_t count, room;
  rot_incline_row *row;
} rot_incline_event_rows;

/* The row at this time, a new one unless the last one has it; NULL: no memory. */
rot_incline_row *rot_incline_event_row(rot_incline_event_rows *rows, double time_s);
void rot_incline_event_rows_free(rot_incline_event_rows *rows);
/* Columns of one row. */
rot_incline_columns rot_incline_columns_of(rot_incline_row *row);

/* Times are finite, do not decrease and are not before start_s (ROT_EVALUE). mu_kinetic is finite
 * unless the start rolls. A slip at the start within its rounding is none. Events: roll, slip,
 * stick, reverse (the velocity passes zero), slip_reverse (the slip does, without sticking).
 * at_events takes the rows at their times, where `events` is not NULL; NULL: none. The errors in
 * *info are bounds for all rows, unless a force is within a rounding of what friction holds; such a
 * force is held. */
rot_status rot_incline_run(const rot_incline_params *p, size_t n, const double time_s[],
                           const rot_incline_columns *out, rot_events *events,
                           rot_incline_event_rows *at_events, const rot_hooks *hooks,
                           rot_info *info);

/* The state at one time alone, not before the start, its heat, and when slip first ended (NaN: it
 * did not). error: the largest bound, each relative to the largest value at the start, the events
 * and the end. ROT_EVALUE where a number is outside its domain. */
typedef struct rot_incline_end {
  double x_m, v_m_per_s, theta_rad, omega_rad_per_s, slip_heat_j, rolling_heat_j, roll_s, error;
  int rolling;
} rot_incline_end;

rot_status rot_incline_to(const rot_incline_params *p, double time_s, rot_incline_end *end);

/* Whether its numbers are in their domain. */
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
  double work_rounding_j, gravity_rounding_n_s, friction_rounding_n_s, resistance_rounding_n_m_s;
} rot_incline_ledger;

/* Work and impulses between two times, not before start_s. */
rot_status rot_incline_flows(const rot_incline_params *p, double from_s, double to_s,
                             rot_incline_ledger *ledger);

/* How much larger than what friction holds a force may be and is held: the rounding of both. */
double rot_incline_holds(double angle_deg, double sine, double cosine);
/* The contact of a scene. */
void rot_incline_touch(const rot_incline_params *p, rot_incline_contact *out);

/* Logs how the motion changes at a time. `turned`: it reverses, unless it comes to rest. */
rot_status rot_incline_log(rot_events *events, double time_s, rot_incline_directions from,
                           rot_incline_directions to, int rested, int rests, int turned);

/* The steepest angle in degrees at which a body of this beta = I/(m R^2) rolls from rest. */
double rot_incline_critical_deg(double beta, double mu_static);

#endif
