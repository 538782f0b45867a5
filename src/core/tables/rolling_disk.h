/* A disk with a sharp edge (coin, hoop) that rolls on a level floor without slipping.
 *
 * With e the disk's axis, d the unit vector from the contact to the centre, r the radius and
 * n = e x d:
 *
 *   v = r omega x d,   I omega' + omega x I omega = -r d x F,   F = m (v' + g z),
 *
 * which along e, d, n is (Ia + 1, It, It + 1) omega' = b with moments in m r^2 and
 * b = -omega x I omega - d x (omega x d') - (g/r) d x z. Axes of space, z upward; energy is
 * conserved.
 *
 * References: Routh, Advanced Rigid Dynamics, 6th ed. (1905), sections 244 to 247; O'Reilly,
 * Nonlinear Dynamics 10 (1996) 287. */
#ifndef ROT_ROLLING_DISK_H
#define ROT_ROLLING_DISK_H

#include <stddef.h>

#include "ground/status.h"

typedef struct rot_rolling_disk {
  double mass_kg;          /* > 0 */
  double radius_m;         /* > 0 */
  double axial;            /* axial moment over m r^2 */
  double transverse;       /* transverse moment over m r^2 */
  double gravity_m_per_s2; /* >= 0 */
  /* At time 0 the heading is x and the axis, for zero lean, is y; a positive lean raises the axis
   * towards z. omega = spin axis + yaw z + lean rate x. */
  double lean_rad, spin_rad_per_s, yaw_rad_per_s, lean_rad_per_s;
} rot_rolling_disk;

#define ROT_ROLLING_DISK_COLUMNS(X)                                                                \
  X(double, x_m) /* centre */                                                                      \
  X(double, y_m)                                                                                   \
  X(double, z_m)                                                                                   \
  X(double, contact_x_m)                                                                           \
  X(double, contact_y_m)                                                                           \
  X(double, qw) /* the body's z is the axis */                                                     \
  X(double, qx)                                                                                    \
  X(double, qy)                                                                                    \
  X(double, qz)                                                                                    \
  X(double, omega_space_x_rad_per_s)                                                               \
  X(double, omega_space_y_rad_per_s)                                                               \
  X(double, omega_space_z_rad_per_s)                                                               \
  X(double, lean_rad)                                                                              \
  X(double, kinetic_energy_j)                                                                      \
  X(double, potential_energy_j)                                                                    \
  X(double, normal_n)                                                                              \
  X(double, friction_needed)

typedef struct rot_rolling_disk_columns {
#define X(type, name) type *name;
  ROT_ROLLING_DISK_COLUMNS(X)
#undef X
} rot_rolling_disk_columns;

/* |sin(lean)| at which the disk counts as flat and the run ends. */
#define ROT_ROLLING_DISK_FLAT 0.9999999

/* (disk, n non-decreasing times of any sign) => columns, integrated from time 0. error: of attitude
 * (rad), omega (relative), position (m). The run ends where the disk falls flat, at *flat_s (else
 * NaN); the first info->rows_done rows are valid. */
rot_status rot_rolling_disk_run(const rot_rolling_disk *p, double accuracy, size_t n,
                                const double time_s[], const rot_rolling_disk_columns *out,
                                double error[3], double *flat_s, const rot_hooks *hooks,
                                rot_info *info);

/* => min angular velocity of stable upright rolling along a straight line, for which the lean
 * oscillates */
double rot_rolling_disk_min(const rot_rolling_disk *p);

#endif
