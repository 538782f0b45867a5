/* A free body, about its centre of mass:
 *
 *   L' = L x omega + torque - damping L   in body axes,   L = I omega,
 *   q' = q (0, omega)/2.
 *
 * With rotors: L = I omega + the sum of moment omega_rotor axis, I with locked rotors
 * (scene/free/rotors.h). The core computes in principal axes; the own axes of the caller may
 * differ. */
#ifndef ROT_FREE_H
#define ROT_FREE_H

#include <stddef.h>

#include "engine/events.h"
#include "ground/status.h"

/* Torque of the caller: (time, omega in own axes, attitude) => torque. */
typedef rot_status (*rot_free_law)(double t, const double omega[3], const double q[4],
                                   double torque[3], void *ctx);

/* Motor torques of the caller: (time, omega in own axes, attitude) => torque of each rotor about
 * its axis. */
typedef rot_status (*rot_free_motors)(double t, const double omega[3], const double q[4],
                                      double torque[], void *ctx);

enum { ROT_FREE_MAX_ROTORS = 16 };

/* A rotor, symmetric about its axis, with its centre of mass on it. */
typedef struct rot_free_rotor {
  double axis[3];         /* own axes, unit vector */
  double moment_kg_m2;    /* > 0, about the axis */
  double omega_rad_per_s; /* relative to the body, at the start */
  int driven;             /* 1: constant speed; 0: torque of its motor, the sum of: */
  double torque;          /* N m, constant, on the rotor; the opposite on the body */
  size_t n_knots;         /* piecewise linear in time, 0 outside; 0: none */
  const double *knot_s, *knot_torque;
} rot_free_rotor;

typedef struct rot_free_params {
  double moment_kg_m2[3];     /* principal, >= 0 */
  int turned;                 /* 1: the own axes are not the principal axes */
  double axes[4];             /* v_own = axes v_principal axes* */
  double given;               /* relative error of the moments; 0: exact */
  double omega0_rad_per_s[3]; /* own axes */
  double q0[4];               /* own axes to space, unit quaternion */
  double start_s;
  double damping_per_s; /* any sign; < 0 drives */
  /* Body with a fixed point (moments about this point): weight times centre of mass from there, in
   * principal axes. Torque of gravity: z x lever, z upward. Free body: 0. */
  double lever_n_m[3];
  double lever_low_n_m[3];    /* rounding error of that product */
  double own_lever_n_m[2][3]; /* turned: that product in own axes, and its rounding error */
  /* The torque is a sum of three. */
  int in_space;                 /* its axes: 1: space, 0: own axes */
  double torque[3];             /* constant, N m */
  size_t n_knots;               /* piecewise linear in time, 0 outside; 0: none */
  const double *knot_s;         /* n_knots */
  const double *knot_torque[3]; /* n_knots each, N m */
  rot_free_law law;             /* of the caller; NULL: none */
  void *ctx;                    /* of the law */
  double law_noise_n_m;         /* >= 0, error of the law */
  size_t n_rotors;              /* 0 to ROT_FREE_MAX_ROTORS */
  const rot_free_rotor *rotors;
  rot_free_motors motors; /* of the rotors that are not driven; NULL: none */
  void *motors_ctx;
  size_t n_breaks;        /* number of times at which a torque may jump or kink */
  const double *breaks_s; /* increasing */
} rot_free_params;

/* Measures of the errors. Attitude: angle of rotation; others: vectors. */
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
  X(double, angular_momentum_x_kg_m2_per_s) /* space axes */                                       \
  X(double, angular_momentum_y_kg_m2_per_s)                                                        \
  X(double, angular_momentum_z_kg_m2_per_s)                                                        \
  X(double, rotational_kinetic_energy_j)

typedef struct rot_free_columns {
#define X(type, name) type *name;
  ROT_FREE_COLUMNS(X)
#undef X
  /* One column per rotor; not used without rotors. */
  double *const *rotor_omega;    /* relative to the body */
  double *const *rotor_momentum; /* about its axis, in space */
} rot_free_columns;

/* From the start to a time: work of the torque, heat of the damping, their impulses in space axes,
 * work of the motors of rotors. */
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

/* parameters => rates in principal axes, attitude of the principal axes. */
void rot_free_principal(const rot_free_params *p, double omega[3], double q[4]);

/* (rates, attitude) in principal axes => row i. ROT_ERANGE: a value is not finite. */
rot_status rot_free_write(const rot_free_params *p, const double omega[3], const double q[4],
                          size_t i, const rot_free_columns *out);

/* (row, its errors of angle and |omega|) => *info: errors, largest values. */
void rot_free_note(const rot_free_params *p, const double omega[3], double angle_error,
                   double omega_error, rot_info *info);

/* (principal moments, rates) => 1 if the torque-free body flips repeatedly: its middle axis comes
 * within 45 degrees of the angular momentum; else 0. */
int rot_free_flips(const double moment_kg_m2[3], const double omega_rad_per_s[3]);

#endif
