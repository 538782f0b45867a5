/* Rolling without slipping down an incline. beta = I/(m R^2): hoop 1, disk 1/2, sphere 2/5.
 *
 *   a = g sin(angle)/(1 + beta),   v = sqrt(2 g h/(1 + beta)),
 *   K_rot/K = beta/(1 + beta),     mu_min = tan|angle| beta/(1 + beta).
 *
 * beta = +Inf gives the limit (all energy is rotational); NaN gives NaN. Source: Goldstein,
 * Classical Mechanics, 3rd ed., section 2.4 (hoop on an incline). */
#ifndef ROT_ROLLING_H
#define ROT_ROLLING_H

#include <stddef.h>

#include "ground/column.h"
#include "ground/status.h"

/* => a */
double rot_rolling_acceleration(double beta, double angle_deg, double gravity);
/* => v after a descent of height_m from rest */
double rot_rolling_final_speed(double beta, double height_m, double gravity);
/* => K_rot/K */
double rot_rolling_rotational_fraction(double beta);
/* => 1 - K_rot/K */
double rot_rolling_translational_fraction(double beta);
/* => mu_min */
double rot_rolling_friction(double beta, double angle_deg);

typedef struct rot_rolling_input {
  rot_column beta, angle_deg, height_m, gravity;
} rot_rolling_input;

typedef struct rot_rolling_output {
  double *acceleration, *final_speed, *rotational_fraction, *translational_fraction;
} rot_rolling_output;

/* n rows => the four columns in one pass */
rot_status rot_rolling_table(size_t n, const rot_rolling_input *in, const rot_rolling_output *out,
                             const rot_hooks *hooks, rot_info *info);

/* => first row of a column with a value outside [lo, hi], n if none; NaN is not outside */
size_t rot_rolling_first_outside(rot_column column, size_t n, double lo, double hi);

#endif
