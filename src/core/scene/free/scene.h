/* Columns of free bodies, and the runs of their models. */
#ifndef ROT_FREE_SCENE_H
#define ROT_FREE_SCENE_H

#include "engine/model.h"
#include "scene/free/free.h"

enum { ROT_FREE_MODELS = 8 };
enum { ROT_FREE_ALL_COLUMNS = ROT_FREE_OWN_COLUMNS + 2 * ROT_FREE_MAX_ROTORS };

/* clang-format off */
#define ROT_FREE_ROTOR(k, with)                                                                    \
  {"rotor_" #k "_omega_rad_per_s", 0, with, "rad/s", 0, 0},                                        \
  {"rotor_" #k "_angular_momentum_kg_m2_per_s", 0, with, "kg m^2/s", 0, 0}
#define ROT_FREE_4_ROTORS(a, b, c, d, with)                                                        \
  ROT_FREE_ROTOR(a, with), ROT_FREE_ROTOR(b, with), ROT_FREE_ROTOR(c, with), ROT_FREE_ROTOR(d, with)
/* Initialisers of the columns; with: effect of rotors, whose columns are the last. */
#define ROT_FREE_TABLE(with)                                                                       \
  ROT_COLUMN("qw", "1", 1 + ROT_FREE_ATTITUDE), ROT_COLUMN("qx", "1", 1 + ROT_FREE_ATTITUDE),      \
  ROT_COLUMN("qy", "1", 1 + ROT_FREE_ATTITUDE), ROT_COLUMN("qz", "1", 1 + ROT_FREE_ATTITUDE),      \
  ROT_COLUMN("omega_x_rad_per_s", "rad/s", 1 + ROT_FREE_OMEGA),                                    \
  ROT_COLUMN("omega_y_rad_per_s", "rad/s", 1 + ROT_FREE_OMEGA),                                    \
  ROT_COLUMN("omega_z_rad_per_s", "rad/s", 1 + ROT_FREE_OMEGA),                                    \
  ROT_COLUMN("omega_space_x_rad_per_s", "rad/s", 0),                                               \
  ROT_COLUMN("omega_space_y_rad_per_s", "rad/s", 0),                                               \
  ROT_COLUMN("omega_space_z_rad_per_s", "rad/s", 0),                                               \
  ROT_COLUMN("angular_momentum_x_kg_m2_per_s", "kg m^2/s", 1 + ROT_FREE_MOMENTUM),                 \
  ROT_COLUMN("angular_momentum_y_kg_m2_per_s", "kg m^2/s", 1 + ROT_FREE_MOMENTUM),                 \
  ROT_COLUMN("angular_momentum_z_kg_m2_per_s", "kg m^2/s", 1 + ROT_FREE_MOMENTUM),                 \
  ROT_COLUMN("rotational_kinetic_energy_j", "J", 0),                                               \
  ROT_FREE_4_ROTORS(1, 2, 3, 4, with), ROT_FREE_4_ROTORS(5, 6, 7, 8, with),                        \
  ROT_FREE_4_ROTORS(9, 10, 11, 12, with), ROT_FREE_4_ROTORS(13, 14, 15, 16, with)
/* clang-format on */

/* rot_constraint.shows: scene => mask of the columns that it shows. */
uint64_t rot_free_shows(const void *scene);

/* Destination of a run. */
typedef struct rot_free_out {
  rot_free_columns columns;
  double *omega[ROT_FREE_MAX_ROTORS], *momentum[ROT_FREE_MAX_ROTORS]; /* columns of rotors */
} rot_free_out;
/* columns by index => columns by name. */
void rot_free_out_of(void *const column[], rot_free_out *out);

/* (parameters, times) => rows of a closed form. */
typedef rot_status rot_free_rows_of(const rot_free_params *p, size_t n, const double time_s[],
                                    const rot_free_columns *out, rot_events *events,
                                    const rot_hooks *hooks, rot_info *info);
/* (closed form, scene, task) => rows. */
rot_status rot_free_run_closed(rot_free_rows_of *form, const void *scene, const rot_task *task,
                               const rot_rows *rows, const rot_hooks *hooks, rot_info *info);
#define ROT_FREE_RUN_ARGUMENTS                                                                     \
  const void *scene, const rot_task *task, rot_method method, const rot_rows *rows,                \
      const rot_hooks *hooks, rot_info *info
/* (scene, task) => rows, flows: closed form of a free body. */
rot_status rot_free_run_exact(ROT_FREE_RUN_ARGUMENTS);
/* The same: closed form of a gyrostat. */
rot_status rot_free_run_gyrostat(ROT_FREE_RUN_ARGUMENTS);
/* The same: integration. */
rot_status rot_free_run_integrated(ROT_FREE_RUN_ARGUMENTS);
/* The same: fixed steps. */
rot_status rot_free_run_steps(ROT_FREE_RUN_ARGUMENTS);
extern const rot_model_run rot_free_runs[ROT_FREE_MODELS];

#endif
