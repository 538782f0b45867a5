/* A drive as computed: units, contacts, and the torques of a state.
 *
 * Rotors joined by gears are a unit. Its coordinate is the angle of its fastest rotor. "To the
 * first shaft": in the coordinate x = P_i theta_i, P_i the product of all ratios before rotor i, in
 * which every ratio is 1.
 *
 * A contact is a clutch, or the dry friction and brakes of a unit. It sticks or slips. Units joined
 * by sticking clutches are a group. A group is at rest if one of its contacts to ground sticks. */
#ifndef ROT_DRIVE_SYSTEM_H
#define ROT_DRIVE_SYSTEM_H

#include "scene/drive/drive.h"

/* Modes of a contact: 1, -1: sign of the slip. */
enum { ROT_DRIVE_STICKS = 0, ROT_DRIVE_OPEN = 2 }; /* open: no capacity, no slip, no load */

typedef struct rot_drive_unit {
  size_t first, end; /* rotors first .. end - 1 */
  double scale;      /* min |P_i| */
  double inertia;    /* kg m^2, at its coordinate */
  size_t ground;     /* contact to ground; SIZE_MAX: none */
  int quadratic;     /* 1: quadratic drag */
  int lossy;         /* 1: a lossy gear */
} rot_drive_unit;

typedef struct rot_drive_contact {
  size_t unit;     /* of a clutch: the unit before it */
  size_t coupling; /* SIZE_MAX: to ground */
  size_t state;    /* component of the state: its slip speed */
} rot_drive_contact;

/* The weakest sticking contact, or the weakest cut through a group at rest. */
typedef struct rot_drive_weakest {
  double margin; /* (capacity - |load|)/(capacity + |load|); 2: no contact sticks */
  double capacity;
  size_t from, to; /* units that would move; a clutch that breaks loose is behind unit `to` */
  int grounded;    /* 1: a cut through a group at rest, 0: a clutch */
  double load;     /* sign: direction in which the units would move, or torque of the clutch */
} rot_drive_weakest;

typedef struct rot_drive_system {
  const rot_drive_scene *scene;
  size_t n, m, n_contacts, n_slips, n_twists; /* n rotors, m units */
  size_t state; /* number of components: angle and rate of the units, slip speeds, twists */
  rot_drive_unit *unit;
  rot_drive_contact *contact;
  size_t *unit_of;            /* n */
  size_t *state_of;           /* n - 1: component of the slip or twist of a coupling */
  size_t *contact_of;         /* n - 1: contact of a coupling */
  double *product, *fraction; /* n: P_i; d theta_i / d coordinate of the unit */
  /* Of the last call of rot_drive_forces(): */
  double *applied, *smooth;    /* n: torque; viscous and quadratic resistance */
  double *dry, *brake;         /* n: signed torques of dry friction and brake */
  double *dry_cap, *brake_cap; /* n: capacities; static if the contact sticks */
  double *torque;              /* n - 1: T of the couplings */
  double *passed;              /* n - 1: fraction of T that the next rotor receives */
  double *capacity; /* n_contacts: at the rotor before a clutch, at the coordinate of a unit */
  double *capacity_ahead; /* n_contacts: where a tie was decided */
  double *force, *size;   /* m: sum of known torques on a unit, its coordinate; of their |values| */
  double *hold;           /* m: torque of the contact to ground if it sticks, at the coordinate */
  double *acceleration;   /* m: of the coordinates */
  double *alpha;          /* n: accelerations of the rotors */
  double *low, *high;     /* m: scratch */
  rot_drive_weakest weakest;
  void *memory;
} rot_drive_system;

#endif
