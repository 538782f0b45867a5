/* A free body from its inputs, its columns, and the runs of its models. Rotors and tables of
 * torques are not among the inputs yet. */
#ifndef ROT_FREE_SCENE_H
#define ROT_FREE_SCENE_H

#include "engine/model.h"
#include "scene/free/free.h"

enum { ROT_FREE_INPUTS = 8, ROT_FREE_ALL_COLUMNS = 14, ROT_FREE_MODELS = 8 };

extern const rot_input rot_free_inputs[ROT_FREE_INPUTS];
extern const rot_column_of rot_free_all_columns[ROT_FREE_ALL_COLUMNS];
extern const rot_model_run rot_free_runs[ROT_FREE_MODELS];

/* As built: what the models read first, as they read it. */
typedef struct rot_free_built {
  rot_free_params params;
  rot_law law;
} rot_free_built;

/* rot_constraint.build and .start_s */
rot_status rot_free_build(const rot_given given[], rot_store *store, void *built,
                          rot_refusal *refusal);
double rot_free_start(const void *scene);

/* ---- shared with bodies that have a fixed point ---------------------------------------------- */

extern const char *const rot_free_axes[]; /* of the torque */

/* clang-format off */
#define ROT_FREE_ANY -DBL_MAX, DBL_MAX, 0
#define ROT_FREE_OMEGA0_INPUT                                                                      \
  {"omega0_rad_per_s", "rad/s", ROT_INPUT_VECTOR, 1, ROT_FREE_ANY, NAN,                            \
   "at the start, in the body's own axes", NULL}
#define ROT_FREE_COMMON_INPUTS                                                                     \
  {"attitude0", "1", ROT_INPUT_ATTITUDE, 0, ROT_FREE_ANY, NAN,                                     \
   "at the start, own axes to space, scalar first; default: 1, 0, 0, 0", NULL},                    \
  {"torque_n_m", "N*m", ROT_INPUT_VECTOR | ROT_INPUT_LAW, 0, ROT_FREE_ANY, NAN,                    \
   "constant, or of time_s, omega_rad_per_s (3, own axes), attitude (4); default: none", NULL},    \
  {"torque_axes", "", ROT_INPUT_CHOICE, 0, ROT_FREE_ANY, NAN, "axes of the torque",                \
   rot_free_axes},                                                                                 \
  {"damping_per_s", "1/s", ROT_INPUT_NUMBER, 0, ROT_FREE_ANY, 0.0,                                 \
   "resistance over the angular momentum", NULL},                                                  \
  {"breaks_s", "s", ROT_INPUT_TIMES, 0, ROT_FREE_ANY, NAN,                                         \
   "where the torque may jump or kink", NULL},                                                     \
  {"start_s", "s", ROT_INPUT_NUMBER, 0, ROT_FREE_ANY, 0.0, "when the state above holds", NULL}
/* clang-format on */
/* Their places after the first of them. */
enum {
  ROT_FREE_ATTITUDE0,
  ROT_FREE_TORQUE,
  ROT_FREE_AXES,
  ROT_FREE_DAMPING,
  ROT_FREE_BREAKS,
  ROT_FREE_START
};

/* Principal moments of a tensor, and of the second moments that it is of, and their axes.
 * ROT_ERANGE: they are not finite. */
rot_status rot_free_build_moments(const double inertia_kg_m2[6], const double second_kg_m2[6],
                                  rot_free_params *params);
/* Of `inputs`, those from `common` on, and the rates at `omega0`. */
rot_status rot_free_build_rest(const rot_input inputs[], const rot_given given[], size_t omega0,
                               size_t common, rot_free_built *built, rot_refusal *refusal);

/* A run in closed form, by integration, by steps of fixed length. */
typedef rot_status rot_free_rows_of(const rot_free_params *p, size_t n, const double time_s[],
                                    const rot_free_columns *out, rot_events *events,
                                    const rot_hooks *hooks, rot_info *info);
rot_status rot_free_run_closed(rot_free_rows_of *form, const void *scene, const rot_task *task,
                               const rot_rows *rows, const rot_hooks *hooks, rot_info *info);
#define ROT_FREE_RUN_ARGUMENTS                                                                     \
  const void *scene, const rot_task *task, rot_method method, const rot_rows *rows,                \
      const rot_hooks *hooks, rot_info *info
rot_status rot_free_run_exact(ROT_FREE_RUN_ARGUMENTS);
rot_status rot_free_run_gyrostat(ROT_FREE_RUN_ARGUMENTS);
rot_status rot_free_run_integrated(ROT_FREE_RUN_ARGUMENTS);
rot_status rot_free_run_steps(ROT_FREE_RUN_ARGUMENTS);

#endif
