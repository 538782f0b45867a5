/* A drive as it is computed: its units and contacts, and the torques of a state.
 *
 * Rotors joined by gears are a unit with one coordinate: the turn of its fastest rotor. With
 * P_i, the product of all ratios before rotor i, the coordinate x = P_i theta_i makes every ratio
 * 1; forces and inertias "to the first shaft" are in it.
 *
 * A contact is a clutch, or the dry friction and brakes of a unit. It sticks or slips. Units joined
 * by sticking clutches are a group, at rest if a contact to ground in it sticks. */
#ifndef ROT_DRIVE_SYSTEM_H
#define ROT_DRIVE_SYSTEM_H

#include "scene/drive/drive.h"

/* The mode of a contact: 1 and -1 are the sign of the slip. */
enum { ROT_DRIVE_STICKS = 0, ROT_DRIVE_OPEN = 2 }; /* open: no capacity, no slip, nothing drives */

typedef struct rot_drive_unit {
  size_t first, end; /* rotors */
  double scale;      /* min |P_i| */
  double inertia;    /* at its coordinate */
  size_t ground;     /* contact; SIZE_MAX: none */
  int quadratic;     /* it has quadratic drag */
  int lossy;         /* a gear of it has a loss */
} rot_drive_unit;

typedef struct rot_drive_contact {
  size_t unit;     /* of a clutch: the one before it */
  size_t coupling; /* SIZE_MAX: to ground */
  size_t state;    /* component of the state that holds its slip speed */
} rot_drive_contact;

/* The weakest sticking contact, or the weakest cut through a group at rest. */
typedef struct rot_drive_weakest {
  double margin; /* (capacity - load)/(capacity + load); 2: nothing sticks */
  double capacity;
  size_t from, to; /* units that would move; the clutch that breaks is behind unit `to` */
  int grounded;
  double load; /* its sign: the way they would move, or the torque of the clutch */
} rot_drive_weakest;

typedef struct rot_drive_system {
  const rot_drive_scene *scene;
  size_t n, m, n_contacts, n_slips, n_twists;
  size_t state; /* components: turn and rate of the units, slip speeds, twists */
  rot_drive_unit *unit;
  rot_drive_contact *contact;
  size_t *unit_of;            /* n */
  size_t *state_of;           /* n - 1: slip or twist of a coupling; its contact is contact_of */
  size_t *contact_of;         /* n - 1 */
  double *product, *fraction; /* n: P_i; d theta_i / d coordinate of the unit */
  /* Of the last call of rot_drive_forces(): */
  double *applied, *smooth;    /* n: torque; viscous and quadratic resistance */
  double *dry, *brake;         /* n: dry friction and brake on the rotor, with sign */
  double *dry_cap, *brake_cap; /* n: capacities, static where the contact sticks */
  double *torque;              /* n - 1: T of the couplings */
  double *passed;              /* n - 1: the part of T that the next rotor takes */
  double *capacity;     /* contacts, at the rotor before a clutch, at the unit's coordinate */
  double *force, *size; /* m: all known torques on a unit at its coordinate; their sizes */
  double *hold;         /* m: of the ground where it sticks, likewise */
  double *acceleration; /* m: of the coordinate */
  double *alpha;        /* n: of the rotors */
  double *low, *high;   /* m: scratch */
  rot_drive_weakest weakest;
  void *memory;
} rot_drive_system;

#endif
