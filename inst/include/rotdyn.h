/* The C interface of rotdyn: rotational dynamics in SI units. C99 and C++11.
 *
 * In a library for C, C++, Fortran, Rust, Python, Julia (`make library`), every function F of the
 * table below is exported as rotdyn_F:
 *
 *   #include <rotdyn.h>                  cc program.c $(pkg-config --cflags --libs rotdyn)
 *   double a = rotdyn_rolling_acceleration(0.4, 20.0, 9.80665);
 *
 * In an R package (LinkingTo: rotdyn, Imports: rotdyn) the table is fetched once:
 *
 *   #define ROTDYN_USE_R
 *   #include <rotdyn.h>
 *   const rotdyn_api *api = rotdyn_api_from_r();      NULL: another major version is installed
 *   if (!ROTDYN_HAS(api, scene_run)) ...              the installed version lacks this function
 *   double a = api->rolling_acceleration(0.4, 20.0, 9.80665);
 *
 * Rules
 * - Structs that are passed begin with their size: declare them by ROTDYN_INIT, such as
 *   `rotdyn_report report = ROTDYN_INIT(rotdyn_report);`. All other members are then 0 or NULL,
 *   which is each member's default. Nothing is read or written beyond that size. Of a newer
 *   header's struct, the members that the installed version does not know must be 0, else
 *   ROTDYN_EARGUMENT.
 * - A function that returns int returns a rotdyn_status. Nothing prints or ends the process.
 * - All functions may be called from any number of threads at a time, with outputs of their own.
 *   The same call gives the same bits in every thread. The R API is not called.
 * - Objects are freed by object_free(); nothing else that is returned need be freed. Texts are in
 *   English, constant, and never freed.
 * - GSL's error handler belongs to the process, and aborts it by default. It is switched off once,
 *   when the library or the R package is loaded, and never touched again. A program with a handler
 *   of its own sets it after that; the core then reaches it only where memory is out. */
#ifndef ROTDYN_H
#define ROTDYN_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

#define ROTDYN_API_MAJOR 1 /* another major: another layout */
#define ROTDYN_API_MINOR 0 /* members are added at the end only */
#define ROTDYN_VERSION   "0.6.0"

#if defined ROTDYN_BUILD && defined __GNUC__
#define ROTDYN_EXPORT __attribute__((visibility("default")))
#else
#define ROTDYN_EXPORT
#endif

#ifdef __cplusplus
#define ROTDYN_INIT(type) rotdyn_init_of<type>()
#else
#define ROTDYN_INIT(type)                                                                          \
  { .size = sizeof(type) }
#endif

typedef enum rotdyn_status {
  ROTDYN_OK = 0,
  ROTDYN_EMEMORY = 1,   /* out of memory */
  ROTDYN_EARGUMENT = 2, /* a NULL, a size or a value that is not possible */
  ROTDYN_ERANGE = 3,    /* the motion leaves the range of double precision */
  ROTDYN_ETORQUE = 4,   /* the torque function gave no finite number */
  ROTDYN_EBUDGET = 5,   /* max_steps are used up */
  ROTDYN_ESTEP = 6,     /* the step fell below the resolution of time */
  ROTDYN_ESTOPPED = 7,  /* stopped by the poll or by the torque function */
  ROTDYN_EMODEL = 8,    /* no such model, or it does not take the scene */
  ROTDYN_EACCURACY = 9, /* no model reaches the accuracy */
  ROTDYN_ENAME = 10,    /* no such shape, object, input or column */
  ROTDYN_EEND = 11,     /* the end of a list */
  ROTDYN_EINTERNAL = 12 /* a fault of this library */
} rotdyn_status;

/* A column of input: values[i * step]. Step 0: one value for all rows. NULL: the default. */
typedef struct rotdyn_column {
  const double *values;
  size_t step;
} rotdyn_column;

/* Not 0 stops the run. `fraction`: the share that is done, 0 to 1. */
typedef int (*rotdyn_poll_fn)(void *context, double fraction);
/* A law that only the caller can evaluate, of the arguments that the input's words list. Not 0
 * stops the run. Finite. */
typedef int (*rotdyn_law_fn)(const double *argument, double *value, void *context);

/* ---- objects ---------------------------------------------------------------------------------
 *
 * Scenes and their parts - bodies, torque laws, couplings, ... - are made by the name of their
 * constructor in R and set input by input, so that a host with keyword arguments or JSON needs a
 * loop and nothing else:
 *
 *   rotdyn_object *scene = rotdyn_object_new("scene_axle");
 *   rotdyn_object *disk = rotdyn_object_new("body_disk");
 *   rotdyn_set_number(disk, "mass_kg", 2.0);
 *   rotdyn_set_number(disk, "radius_m", 0.25);
 *   rotdyn_set_object(scene, "body", disk);
 *   rotdyn_set_number(scene, "torque", 0.8);
 *   status = rotdyn_scene_run(scene, n, time_s, &options, n, 1, &name, &column, &report);
 *   rotdyn_object_free(disk);
 *   rotdyn_object_free(scene);
 *
 * A list is an object, too, made by the name "list". What is set in it without a name (NULL) is
 * added at its end; unset adds an empty place. Torques are added up by "torque_sum".
 *
 * Numbers and objects are copied when they are set. A scene may be run from several threads at a
 * time while none sets it. */
typedef struct rotdyn_object rotdyn_object;

typedef struct rotdyn_input {
  size_t size;
  const char *name, *unit; /* unit: "1" of a plain number, "" where there is none */
  /* What it takes, separated by ", ": "number", "limit" (a number or Inf), "numbers" (any count),
   * "times" (increasing), "vector" (3 numbers), "attitude" (a quaternion, scalar first), "choice",
   * "text", "law", "list" (of what it takes else), "nothing" (an empty place of a list); an object
   * by what object_kind() says of it: "body", "torque", "resistance", "inertia", "coupling",
   * "brake". */
  char kinds[96];
  int required;
  double low, high; /* of numbers: the domain, */
  int above;        /* without `low` itself */
  double otherwise; /* the default; NaN: from other inputs, as `words` say */
  const char *words;
  const char *const *options; /* of a choice, the first is the default; the list ends with NULL */
} rotdyn_input;

/* Events of a run, in their order: "stick", "slip", "reverse", "lock", ... */
typedef struct rotdyn_events {
  size_t size;
  size_t room;       /* of the two arrays */
  double *time_s;    /* those that found room */
  const char **name; /* may be NULL */
  size_t count;      /* of all events; set by the run */
  int *place;        /* may be NULL: 0, or where: rotor i, from 1; the coupling behind it as -i */
} rotdyn_events;

typedef struct rotdyn_options {
  size_t size;
  double accuracy;     /* largest relative error wanted; 0: 1e-9 */
  const char *model;   /* NULL: the cheapest that takes the scene and reaches the accuracy */
  double max_steps;    /* of an integrator, beyond one for each row; 0: 1e6 */
  double law_call_s;   /* time of a call of a law, for the prediction of costs; 0: 1e-6 */
  rotdyn_poll_fn poll; /* called from the calling thread, up to every few milliseconds */
  void *poll_context;
  rotdyn_events *events;
  /* Of scene_rows and axle_sweep, where the library has OpenMP; 0: one. No bit depends on it. */
  size_t threads;
} rotdyn_options;

/* The report of a run, also of one that failed. */
typedef struct rotdyn_report {
  size_t size;
  int status;
  size_t rows_done;                  /* times whose rows are valid */
  double time_s;                     /* how far the run came, or where it failed */
  size_t steps, rejected, law_calls; /* of an integrator; law_calls: right-hand sides */
  double error;                      /* the largest relative error of a measure */
  int error_is_bound;                /* else an estimate */
  size_t n_measures;
  const char *measure[8]; /* such as "theta" */
  double measure_error[8], measure_largest[8];
  const char *model; /* the one that ran; NULL: none. An integrator may switch to the other. */
  const char *index; /* of several rows for each time: what they count, such as "rotor"; or NULL */
  size_t rows_per_time; /* rows for each time */
  const char *input;    /* the one that was refused; NULL: none */
  char reason[512]; /* why it was, or no model or not this one fits; or what the model ignored */
} rotdyn_report;

typedef struct rotdyn_candidate {
  size_t size;
  const char *model;
  int applies;
  double error;       /* relative, promised; of a model on trial that of its run */
  int error_is_bound; /* else an estimate */
  double cost_s;      /* predicted time */
  char reason[512];   /* why it is chosen, would do, does not apply, or what it ignores */
} rotdyn_candidate;

/* change = supplied - dissipated + residual, of one quantity between two times. */
typedef struct rotdyn_balance {
  size_t size;
  const char *quantity, *about, *unit; /* about: the point or axis of a momentum, or NULL */
  double change, supplied, dissipated, residual;
  double explained; /* what rounding and the errors of the motion explain of the residual */
  int balanced;     /* 1: it explains all of it; 0: it does not; -1: not known */
  int conserved;    /* 1: nothing changes the quantity, and why; 0: what changes it; -1: unknown */
  char why[512];
  size_t n_terms;
  const char *term[16]; /* in words */
  int role[16];         /* 0: supplied, 1: dissipated, 2: change */
  double value[16];
} rotdyn_balance;

/* Many scenes, a row each. */
typedef struct rotdyn_rows_in {
  size_t size;
  rotdyn_column time_s; /* of each row */
  size_t n_inputs;      /* numbers of the scene, one each, that differ from row to row */
  const char *const *inputs;
  const rotdyn_column *values;
} rotdyn_rows_in;

typedef struct rotdyn_rows_out {
  size_t size;
  size_t n_columns;
  const char *const *names;
  double *const *columns; /* n times report.rows_per_time values each */
  double *error;          /* of each row, or NULL: as rotdyn_report.error */
  int *status;            /* of each row, or NULL; its numbers are NaN where it is not ROTDYN_OK */
  const char **model;     /* of each row, or NULL: the one that ran; NULL: none */
} rotdyn_rows_out;

/* Many axles, a row each, under the torque of one scene_axle. */
typedef struct rotdyn_sweep_in {
  size_t size;
  rotdyn_column time_s;        /* where each row ends, not before start_s */
  rotdyn_column inertia_kg_m2; /* these: NULL for the value of the scene */
  rotdyn_column viscous_n_m_s, omega0_rad_per_s, theta0_rad;
  rotdyn_column torque_scale; /* of the knots; NULL: 1 */
} rotdyn_sweep_in;

typedef struct rotdyn_sweep_out {
  size_t size;
  double *theta_rad, *omega_rad_per_s;                          /* at the end; all may be NULL */
  double *omega_max, *omega_max_time_s, *omega_min, *speed_max; /* of the continuous motion */
  double *error;
  int *status; /* of each row; its numbers are NaN where it is not ROTDYN_OK */
} rotdyn_sweep_out;

/* ---- bodies, rolling, models ----------------------------------------------------------------- */

typedef struct rotdyn_shape {
  size_t size;
  const char *name;
  int dimension; /* 3: solid, 2: surface, 1: line, 0: point */
  size_t n_sizes;
  const char *size_name[4]; /* with the unit: "radius_m"; "sides" is a whole number */
} rotdyn_shape;

typedef struct rotdyn_moments {
  size_t size;
  double mass_kg;
  double moment_kg_m2;                    /* the one in tables: about the axis of the shape */
  double ixx_kg_m2, iyy_kg_m2, izz_kg_m2; /* about the centre of mass, in the own axes */
  double ixy_kg_m2;                       /* entry of the tensor: -int x y dm; the others are 0 */
  double beta;                            /* izz/(m r^2) where it rolls about z, else NaN */
  double gyration_m;                      /* sqrt(moment/m) */
  double centre_m[3];
  double error; /* bound, relative to the trace */
} rotdyn_moments;

typedef struct rotdyn_energies {
  size_t size;
  double inertia_kg_m2, omega_rad_per_s, translational_j, rotational_j, total_j;
} rotdyn_energies;

/* A top or gyroscope whose axis precesses about the vertical through its fixed point. */
typedef struct rotdyn_top {
  size_t size;
  double mass_kg, lever_arm_m; /* from the fixed point to the centre of mass, along the axis */
  double axial_kg_m2;          /* > 0, about the axis, I3 */
  double spin_rad_per_s;       /* along the axis, not 0 */
  double axis_angle_deg;       /* from the upward vertical, 0 to 180 */
  double gravity_m_per_s2;
  double transverse_kg_m2; /* about a line across the axis, I1 >= I3/2; 0: unknown */
} rotdyn_top;

typedef struct rotdyn_top_rates {
  size_t size;
  double torque_n_m, momentum_kg_m2_per_s;    /* of gravity; of the spin */
  double precession_rad_per_s, period_s;      /* the formula m g l/(I3 omega3) */
  double slow_rad_per_s, fast_rad_per_s;      /* of steady precession; NaN: none, or unknown */
  double formula_error;                       /* relative to the slow one; NaN: unknown */
  double nutation_period_s, lowest_angle_deg; /* released from rest; NaN where I1 is unknown */
  double mean_precession_rad_per_s;
} rotdyn_top_rates;

typedef struct rotdyn_model {
  size_t size;
  const char *model, *constraint, *why;
  double error; /* the smallest relative error that it promises */
  int error_is_bound;
} rotdyn_model;

/* ---- the table -------------------------------------------------------------------------------
 *
 * version               "0.6.0"
 * status_text           of a rotdyn_status
 *
 * Rolling without slipping down an incline, beta = I/(m r^2), lengths in m, angles in degrees:
 * rolling_acceleration  g sin(angle)/(1 + beta)
 * rolling_final_speed   sqrt(2 g h/(1 + beta))
 * rolling_rotational_fraction, rolling_translational_fraction   of the kinetic energy
 * rolling_friction      the least coefficient for which it rolls: tan|angle| beta/(1 + beta)
 * rolling_energies      of a body that rolls at a speed (Koenig's theorem)
 * precession_rates      of a top or gyroscope
 *
 * shape_at              shape i of the catalogue, from 0; ROTDYN_EEND after the last
 * shape_moments         of the shape of that name; sizes in the order of rotdyn_shape.size_name;
 *                       mass >= 0
 * model_at              model i of all constraints, from 0; ROTDYN_EEND after the last
 *
 * object_at             constructor i of all, from 0: scenes, then parts; NULL after the last
 * object_kind           what it makes: "scene", "body", "torque", ... ; NULL: there is none
 * input_at, column_at   input, name of column i of such objects, from 0; ROTDYN_EEND, NULL after
 *                       the last. Columns that only some effects bring are 0 without them.
 * object_new            NULL: there is no such constructor, or no memory
 * set_number, set_numbers, set_text, set_object, set_law
 *                       set an input; ROTDYN_ENAME: there is none of this name,
 *                       ROTDYN_EARGUMENT: it takes no such value, or not this option of a choice
 * unset                 back to the default
 * object_check          ROTDYN_EARGUMENT: the report names the input and why it is refused
 * scene_candidate       the k-th cheapest model for these times and this accuracy
 * scene_run             columns by name, of n report.rows_per_time values each: those of the first
 *                       time, of the second one, ... ; flags are 0, 1, NaN. `room`: values in each
 *                       column, at least so many. object_check() gives `rows_per_time`
 * scene_balance         balance k, from 0, between the first and the last time of the run at these
 *                       times: the audit of R; ROTDYN_EEND after the last
 * scene_rows            n scenes that differ in the named numbers, a row each: the columns at the
 *                       time of the row. Laws that are called are called by one thread
 * axle_sweep            many axles in closed form, a row each; ROTDYN_EMODEL where none takes them
 *
 * `options`, `report` may be NULL. */
#define ROTDYN_FUNCTIONS(X)                                                                        \
  X(const char *, version, (void))                                                                 \
  X(const char *, status_text, (int status))                                                       \
  X(double, rolling_acceleration, (double beta, double angle_deg, double gravity))                 \
  X(double, rolling_final_speed, (double beta, double height_m, double gravity))                   \
  X(double, rolling_rotational_fraction, (double beta))                                            \
  X(double, rolling_translational_fraction, (double beta))                                         \
  X(double, rolling_friction, (double beta, double angle_deg))                                     \
  X(int, rolling_energies,                                                                         \
    (double mass_kg, double radius_m, double beta, double speed_m_per_s, rotdyn_energies *out))    \
  X(int, precession_rates, (const rotdyn_top *top, rotdyn_top_rates *out))                         \
  X(int, shape_at, (size_t i, rotdyn_shape * out))                                                 \
  X(int, shape_moments,                                                                            \
    (const char *shape, double mass_kg, size_t n_sizes, const double *sizes, rotdyn_moments *out)) \
  X(int, model_at, (size_t i, rotdyn_model * out))                                                 \
  X(const char *, object_at, (size_t i))                                                           \
  X(const char *, object_kind, (const char *constructor))                                          \
  X(int, input_at, (const char *constructor, size_t i, rotdyn_input *out))                         \
  X(const char *, column_at, (const char *constructor, size_t i))                                  \
  X(rotdyn_object *, object_new, (const char *constructor))                                        \
  X(void, object_free, (rotdyn_object * object))                                                   \
  X(int, set_number, (rotdyn_object * object, const char *input, double value))                    \
  X(int, set_numbers, (rotdyn_object * object, const char *input, size_t n, const double *values)) \
  X(int, set_text, (rotdyn_object * object, const char *input, const char *text))                  \
  X(int, set_object, (rotdyn_object * object, const char *input, const rotdyn_object *value))      \
  X(int, set_law, (rotdyn_object * object, const char *input, rotdyn_law_fn law, void *context))   \
  X(int, unset, (rotdyn_object * object, const char *input))                                       \
  X(int, object_check, (const rotdyn_object *object, rotdyn_report *report))                       \
  X(int, scene_candidate,                                                                          \
    (const rotdyn_object *scene, size_t n, const double *time_s, const rotdyn_options *options,    \
     size_t k, rotdyn_candidate *out))                                                             \
  X(int, scene_run,                                                                                \
    (const rotdyn_object *scene, size_t n, const double *time_s, const rotdyn_options *options,    \
     size_t room, size_t n_columns, const char *const *names, double *const *columns,              \
     rotdyn_report *report))                                                                       \
  X(int, scene_rows,                                                                               \
    (const rotdyn_object *scene, size_t n, const rotdyn_rows_in *in,                               \
     const rotdyn_options *options, const rotdyn_rows_out *out, rotdyn_report *report))            \
  X(int, axle_sweep,                                                                               \
    (const rotdyn_object *scene, size_t n, const rotdyn_sweep_in *in,                              \
     const rotdyn_options *options, const rotdyn_sweep_out *out, rotdyn_report *report))           \
  X(int, scene_balance,                                                                            \
    (const rotdyn_object *scene, size_t n, const double *time_s, const rotdyn_options *options,    \
     size_t k, rotdyn_balance *out, rotdyn_report *report))

typedef struct rotdyn_api {
  size_t size; /* of the table that is installed */
  int major, minor;
#define ROTDYN_MEMBER(result, name, arguments) result(*name) arguments;
  ROTDYN_FUNCTIONS(ROTDYN_MEMBER)
#undef ROTDYN_MEMBER
} rotdyn_api;

/* Whether the installed table has this function. */
#define ROTDYN_HAS(api, name) ((api)->size >= offsetof(rotdyn_api, name) + sizeof((api)->name))

#ifndef ROTDYN_USE_R
/* NULL where the library is of another major version. */
ROTDYN_EXPORT const rotdyn_api *rotdyn_get_api(int major);
#define ROTDYN_PROTOTYPE(result, name, arguments) ROTDYN_EXPORT result rotdyn_##name arguments;
ROTDYN_FUNCTIONS(ROTDYN_PROTOTYPE)
#undef ROTDYN_PROTOTYPE
#endif

#ifdef __cplusplus
}
template <class type> inline type rotdyn_init_of() {
  type out = type();
  out.size = sizeof(type);
  return out;
}
#endif

#ifdef ROTDYN_USE_R
#include <R_ext/Rdynload.h>
/* NULL: the installed rotdyn is of another major version. An R error where rotdyn is not loaded.
 * Call it once, from R's own thread; the functions of the table may then be called from any. */
static inline const rotdyn_api *rotdyn_api_from_r(void) {
  typedef const rotdyn_api *(*getter)(int);
  typedef void (*any)(void);
  return ((getter)(any)R_GetCCallable("rotdyn", "rotdyn_get_api"))(ROTDYN_API_MAJOR);
}
#endif

#endif
