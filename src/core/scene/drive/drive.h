/* A drive: rotors in a chain. Neighbours are coupled by an elastic shaft, a friction clutch or a
 * rigid gear, each with a ratio = omega_i/omega_(i+1):
 *
 *   J_i omega_i' = torque_i + resistance_i + ratio_(i-1) T_(i-1) - T_i,
 *   shaft:  T = k (theta_i - ratio theta_(i+1)) + c (omega_i - ratio omega_(i+1))
 *   clutch: slipping: T = capacity sign(slip); locked: |T| <= static capacity
 *   gear:   T keeps omega_i = ratio omega_(i+1); with an efficiency, the next rotor receives
 *           ratio T efficiency if T omega_i > 0, ratio T/efficiency if T omega_i < 0
 *
 * Scene, columns and ledger. */
#ifndef ROT_DRIVE_H
#define ROT_DRIVE_H

#include "scene/axle/scene.h"

/* Capacity of a clutch or brake: max(0, law) for from_s <= t < to_s, else 0. The law is called with
 * the slip speed as omega. */
typedef struct rot_drive_friction {
  int acts;            /* 0: none */
  rot_axle_scene law;  /* its loads: the capacity */
  double static_ratio; /* >= 1; static capacity over the capacity at zero slip */
  double from_s, to_s;
} rot_drive_friction;

typedef enum rot_drive_kind { ROT_DRIVE_SHAFT, ROT_DRIVE_CLUTCH, ROT_DRIVE_GEAR } rot_drive_kind;

typedef struct rot_drive_coupling {
  rot_drive_kind kind;
  double ratio;                 /* not 0 */
  double stiffness_n_m_per_rad; /* >= 0, of a shaft */
  double damping_n_m_s;         /* >= 0, of a shaft */
  rot_drive_friction friction;  /* of a clutch */
  double efficiency;            /* of a gear, (0, 1]; 0: as 1 */
} rot_drive_coupling;

typedef struct rot_drive_scene {
  size_t n;                           /* number of rotors, >= 1 */
  const rot_axle_scene *rotor;        /* torque, resistance, inertia, state at the start */
  const rot_drive_friction *brake;    /* n: from each rotor to ground */
  const rot_drive_coupling *coupling; /* n - 1 */
  double start_s;
  /* n each, derived from the inputs. */
  const double *inertia_kg_m2, *ratio_to_first, *theta0_rad, *omega0_rad_per_s;
  size_t n_breaks; /* times at which a torque, brake or clutch jumps or kinks, increasing */
  const double *breaks_s;
} rot_drive_scene;

/* Columns, times x rotors values: by time, then by rotor. Columns of the coupling behind a rotor
 * are undefined for the last rotor. */
#define ROT_DRIVE_COLUMNS(X)                                                                       \
  X(double, theta_rad)                                                                             \
  X(double, omega_rad_per_s)                                                                       \
  X(double, angular_momentum_kg_m2_per_s)                                                          \
  X(double, rotational_kinetic_energy_j)                                                           \
  X(double, applied_torque_n_m)                                                                    \
  X(double, damping_torque_n_m)  /* resistance and brake */                                        \
  X(double, coupling_torque_n_m) /* of the coupling: on the next rotor before ratio and loss */    \
  X(int, locked)                 /* 1: the clutch sticks */                                        \
  X(double, heat_j)              /* of resistance and brake, since the start */                    \
  X(double, coupling_heat_j)

typedef struct rot_drive_columns {
#define X(type, name) type *name;
  ROT_DRIVE_COLUMNS(X)
#undef X
} rot_drive_columns;

/* Columns since the start of the scene, one value per time: heat by mechanism, impulses on the
 * whole drive. */
#define ROT_DRIVE_LEDGER(X)                                                                        \
  X(work_j)                                                                                        \
  X(resistance_j)                                                                                  \
  X(brake_j)                                                                                       \
  X(damper_j)                                                                                      \
  X(clutch_j)                                                                                      \
  X(mesh_j) /* of lossy gears */                                                                   \
  X(torque_impulse_n_m_s)                                                                          \
  X(resistance_impulse_n_m_s) /* with brakes */                                                    \
  X(housing_impulse_n_m_s)    /* of the supports of the gears */                                   \
  X(elastic_j)                /* change of the elastic energy */

typedef struct rot_drive_ledger {
#define X(name) double *name;
  ROT_DRIVE_LEDGER(X)
#undef X
  /* Estimated errors. */
  double work_error_j, heat_error_j, impulse_error_n_m_s, twist_error_rad, elastic_error_j;
} rot_drive_ledger;

#endif
