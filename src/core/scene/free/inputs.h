/* Inputs of a free body; most of them also of bodies with a fixed point. */
#ifndef ROT_FREE_INPUTS_H
#define ROT_FREE_INPUTS_H

#include "engine/resistance.h"
#include "scene/free/parts.h"

enum { ROT_FREE_INPUTS = 9 };
extern const rot_input rot_free_inputs[ROT_FREE_INPUTS];

/* A built scene. The models read its first member. */
typedef struct rot_free_built {
  rot_free_params params;
  double mass_kg;     /* of a body with a fixed point */
  double centre_m[3]; /* of mass, from the fixed point */
  rot_law law;        /* of the torque */
  rot_free_rotor rotor[ROT_FREE_MAX_ROTORS];
  rot_law motor[ROT_FREE_MAX_ROTORS]; /* call NULL: none */
} rot_free_built;

/* rot_constraint.build: inputs => rot_free_built, or a refusal. */
rot_status rot_free_build(const rot_given given[], rot_store *store, void *built,
                          rot_refusal *refusal);
/* rot_constraint.start_s */
double rot_free_start(const void *scene);

/* ---- shared with bodies that have a fixed point ---------------------------------------------- */

extern const char *const rot_free_axes[];       /* of the torque */
extern const char *const rot_free_resistance[]; /* terms of the resistance */

/* clang-format off */
#define ROT_FREE_ANY -DBL_MAX, DBL_MAX, 0
#define ROT_FREE_OMEGA0_INPUT                                                                      \
  {"omega0_rad_per_s", "rad/s", ROT_INPUT_VECTOR, 1, ROT_FREE_ANY, NAN,                            \
   "at the start, in the body's own axes", NULL}
#define ROT_FREE_COMMON_INPUTS                                                                     \
  {"attitude0", "1", ROT_INPUT_ATTITUDE, 0, ROT_FREE_ANY, NAN,                                     \
   "at the start, own axes to space, scalar first; default: 1, 0, 0, 0", NULL},                    \
  {"torque", "N*m", ROT_INPUT_VECTOR | ROT_INPUT_TABLE | ROT_INPUT_LAW, 0, ROT_FREE_ANY, NAN,  \
   "constant, a table, or a law of time_s, omega_rad_per_s (3, own axes), attitude (4); default: " \
   "none", rot_free_arguments},                                                                    \
  {"torque_axes", "", ROT_INPUT_CHOICE, 0, ROT_FREE_ANY, NAN, "axes of the torque",                \
   rot_free_axes},                                                                                 \
  ROT_RESISTANCE_INPUT("a torque against the angular momentum", rot_free_resistance),              \
  {"rotors", "", ROT_INPUT_ROTOR | ROT_INPUT_LIST, 0, ROT_FREE_ANY, NAN,                           \
   "one rotor, or a list of at most 16; the body includes them, locked", NULL},                    \
  {"breaks_s", "s", ROT_INPUT_TIMES, 0, ROT_FREE_ANY, NAN,                                         \
   "where the torque may jump or kink", NULL},                                                     \
  {"start_s", "s", ROT_INPUT_NUMBER, 0, ROT_FREE_ANY, 0.0, "when the state above holds", NULL}
/* clang-format on */
/* Indices of the common inputs, from the first of them. */
enum {
  ROT_FREE_ATTITUDE0,
  ROT_FREE_TORQUE,
  ROT_FREE_AXES,
  ROT_FREE_RESISTANCE,
  ROT_FREE_ROTORS,
  ROT_FREE_BREAKS,
  ROT_FREE_START
};

/* Initialisers of the derived numbers. */
#define ROT_FREE_DERIVED                                                                           \
  {"moment_of_inertia_kg_m2", offsetof(rot_free_built, params.moment_kg_m2), 3},                   \
      {"axes", offsetof(rot_free_built, params.axes), 4}, {                                        \
    "moment_error", offsetof(rot_free_built, params.given), 1                                      \
  }

/* (inertia tensor, second moments) => principal moments, axes. ROT_ERANGE: not finite. */
rot_status rot_free_build_moments(const double inertia_kg_m2[6], const double second_kg_m2[6],
                                  rot_free_params *params);
/* input of three moments, with or without axes => moments, axes. Returns 0 if it is neither, else
 * 1. */
int rot_free_read_moments(const rot_given *given, rot_free_params *params);
/* inputs from `common` on and the rates at `omega0` => scene, or a refusal. */
rot_status rot_free_build_rest(const rot_input inputs[], const rot_given given[], size_t omega0,
                               size_t common, rot_store *store, rot_free_built *built,
                               rot_refusal *refusal);

#endif
