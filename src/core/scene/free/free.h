/* A body that nothing holds, about its centre of mass:
 *
 *   L' = L x omega + torque - damping L   in the body's axes,   L = I omega,
 *   q' = q (0, omega)/2.
 *
 * With rotors, L = I omega + the sum of moment omega_rotor axis, where I has the rotors locked: see
 * scene/free/rotors.h. The core works in the principal axes; the caller's own axes may be
 * others. */
#ifndef ROT_FREE_H
#define ROT_FREE_H

#include <stddef.h>

#include "engine/events.h"
#include "ground/status.h"

/* A torque that only the caller can evaluate: time, omega in own axes, attitude, torque. */
typedef rot_status (*rot_free_law)(double t, const double omega[3], const double q[4],
                                   double torque[3], void *ctx);

/* Torques of motors that only the caller can evaluate: one for each rotor, about its axis. */
typedef rot_status (*rot_free_motors)(double t, const double omega[3], const double q[4],
                                      double torque[], void *ctx);

enum { ROT_FREE_MAX_ROTORS = 16 };

/* A rotor that is symmetric about its axis, on which its centre of mass lies. */
typedef struct rot_free_rotor {
  double axis[3];                       /* own axes, of unit length */
  double moment_kg_m2, omega_rad_per_s; /* about the axis; relative to the body, at the start */
  int driven;                           /* at that speed; else the torque of its motor: */
  double torque;                        /* N m, on the rotor; the body has the opposite one */
  size_t n_knots; /* and one that is linear between times, 0 before and after; 0: none */
  const double *knot_s, *knot_torque;
} rot_free_rotor;

typedef struct rot_free_params {
  double moment_kg_m2[3];     /* principal, >= 0 */
  int turned;                 /* own axes are not the principal axes: */
  double axes[4];             /* v_own = axes v_principal axes* */
  double given;               /* relative error of the moments, 0 where they are exact */
  double omega0_rad_per_s[3]; /* own axes */
  double q0[4];               /* own axes to space, of unit length */
  double start_s;
  double damping_per_s;
  /* Of a body with a fixed point, about which the moments are: its weight times the centre of mass
   * from there, in principal axes. Gravity's torque is z x lever, z upward. Else 0. */
  double lever_n_m[3];
  double lever_low_n_m[3]; /* what it lacks of the product, by rounding */
  int in_space;            /* axes of the torque; else the own ones */
  double torque[3];        /* N m, constant */
  size_t n_knots;          /* and one that is linear between times, 0 before and after; 0: none */
  const double *knot_s;
  const double *knot_torque[3];
  rot_free_law law; /* and one of the caller's; may be NULL */
  void *ctx;
  double law_noise_n_m; /* how far it may be off */
  size_t n_rotors;      /* at most ROT_FREE_MOST_ROTORS */
  const rot_free_rotor *rotors;
  rot_free_motors motors; /* of those that are not driven; may be NULL */
  void *motors_ctx;
  size_t n_breaks; /* times at which a torque may jump or kink, increasing */
  const double *breaks_s;
} rot_free_params;

/* Measures of its errors: the attitude by its angle, the others as vectors. */
enum { ROT_FREE_ATTITUDE, ROT_FREE_OMEGA, ROT_FREE_MOMENTUM };
extern const char *const rot_free_measures[];

#define ROT_FREE_COLUMNS(X)                                                                        \
  X(double, qw)                                                                                    \
  X(double, qx)                                                                                    \
  X(double, qy)                                                                                    \
  X(double, qz)                                                                                    \
  X(double, omega_x_rad_per_s) /* own axes */                                                      \
  X(double, omega_y_rad_per_s)                                                                     \
  X(double, omega_z_rad_per_s)                                                                     \
  X(double, omega_space_x_rad_per_s)                                                               \
  X(double, omega_space_y_rad_per_s)                                                               \
  X(double, omega_space_z_rad_per_s)                                                               \
  X(double, angular_momentum_x_kg_m2_per_s) /* axes of space */                                    \
  X(double, angular_momentum_y_kg_m2_per_s)                                                        \
  X(double, angular_momentum_z_kg_m2_per_s)                                                        \
  X(double, rotational_kinetic_energy_j)

typedef struct rot_free_columns {
#define X(type, name) type *name;
  ROT_FREE_COLUMNS(X)
#undef X
  double *const *rotor_omega;    /* of each rotor: relative to the body */
  double *const *rotor_momentum; /* about its axis, in space */
} rot_free_columns;              /* the last two: not looked at without rotors */

/* From the start to a time: work of the torque, heat of the damping, and what both do to L in space
 * axes; work of the motors of rotors. */
#define ROT_FREE_LEDGER(X)                                                                         \
  X(work_j)                                                                                        \
  X(heat_j)                                                                                        \
  X(torque_impulse_x_n_m_s)                                                                        \
  X(torque_impulse_y_n_m_s)                                                                        \
  X(torque_impulse_z_n_m_s)                                                                        \
  X(damping_impulse_x_n_m_s)                                                                       \
  X(damping_impulse_y_n_m_s)                                                                       \
  X(damping_impulse_z_n_m_s)                                                                       \
  X(motor_work_j)

enum { ROT_FREE_OWN_COLUMNS = 14 }; /* without those of rotors, two each */
enum { ROT_FREE_FLOWS = 9, ROT_FREE_MOTOR_WORK = 8, ROT_FREE_MAX_FLIPS = 10000 };

/* Rates in principal axes, attitude of these. */
void rot_free_principal(const rot_free_params *p, double omega[3], double q[4]);

/* Row i, from both in principal axes. ROT_ERANGE where a value is not finite. */
rot_status rot_free_write(const rot_free_params *p, const double omega[3], const double q[4],
                          size_t i, const rot_free_columns *out);

/* Notes a row with its errors, of the angle and of |omega|, and the rows' sizes. */
void rot_free_note(const rot_free_params *p, const double omega[3], double angle_error,
                   double omega_error, rot_info *info);

/* Whether a body of these principal moments and rates would, without torque, turn over again and
 * again: its middle axis comes within 45 degrees of the angular momentum. */
int rot_free_flips(const double moment_kg_m2[3], const double omega_rad_per_s[3]);

#endif
