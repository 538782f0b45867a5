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
 *   if (!ROTDYN_HAS(api, axle_rows)) ...              the installed version lacks this function
 *   double a = api->rolling_acceleration(0.4, 20.0, 9.80665);
 *
 * Rules
 * - Structs that are passed begin with their size: declare them by ROTDYN_INIT, such as
 *   `rotdyn_axle axle = ROTDYN_INIT(rotdyn_axle);`. All other members are then 0 or NULL, which is
 *   each member's default. Nothing is read or written beyond that size. Of a newer header's struct,
 *   the members that the installed version does not know must be 0, else ROTDYN_EARGUMENT.
 * - A function that returns int returns a rotdyn_status. Nothing prints or ends the process.
 * - All functions may be called from any number of threads at a time, with outputs of their own.
 *   The same call gives the same bits in every thread. The R API is not called.
 * - Nothing that is returned need be freed. Texts are in English, constant, and never freed.
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
#define ROTDYN_VERSION   "0.5.0"

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
  ROTDYN_ENAME = 10,    /* no such shape, scene, input or column */
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
/* A torque that only the caller can evaluate. Not 0 stops the run. Finite. */
typedef int (*rotdyn_torque_fn)(double time_s, double theta_rad, double omega_rad_per_s,
                                double *torque_n_m, void *context);

/* ---- a body on a fixed axle ------------------------------------------------------------------
 *
 *   d(I omega)/dt = knots(t) + terms(t, theta, omega) + torque() - motor omega + resistance
 *   resistance    = -c omega - q omega |omega| - tau_c sign(omega); at rest up to tau_s */

/* kind         x (n_x numbers)
 * sinusoid     a, w, phase                a cos(w t + phase)
 * exponential  a, k, t0                   a exp(-k (t - t0))
 * polynomial   n, m, n + 1 breaks, n rows of m coefficients; in piece i sum_j a_ij (t - break_i)^j
 * curve        n, n speeds (increasing), n torques: straight lines between, constant outside
 * spring       k, rest                    -k (theta - rest)
 * gravity      m g d, rest                -m g d sin(theta - rest) */
typedef struct rotdyn_term {
  size_t size;
  const char *kind;
  size_t n_x;
  const double *x;
  double from_s, to_s; /* it acts from from_s on and before to_s; both 0: always */
} rotdyn_term;

typedef struct rotdyn_axle {
  size_t size;
  double inertia_kg_m2;                             /* > 0, about the axle */
  double start_s, theta0_rad, omega0_rad_per_s;     /* the state holds at start_s */
  double viscous_n_m_s;                             /* c, any sign */
  double quadratic_n_m_s2, coulomb_n_m, static_n_m; /* q, tau_c, tau_s >= 0; tau_s = 0: tau_c */
  double motor_n_m_s;                               /* how a motor's torque falls with omega */
  /* Straight lines between knots (times not decreasing; a repeated time is a jump). No knot: the
   * constant torque after_n_m = before_n_m. */
  size_t n_knots;
  const double *knot_time_s, *knot_torque_n_m;
  double before_n_m, after_n_m; /* before the first knot and after the last one */
  size_t n_terms;
  const rotdyn_term *terms; /* consecutive, terms[0].size bytes each */
  rotdyn_torque_fn torque;
  void *torque_context;
  /* A moment of inertia that changes: straight lines, held outside; replaces inertia_kg_m2. */
  size_t n_inertia;
  const double *inertia_time_s, *inertia_knots_kg_m2;
  size_t n_breaks; /* further times, increasing, where torque() jumps or kinks */
  const double *breaks_s;
} rotdyn_axle;

/* Columns of n values each; those that are NULL are not written. */
typedef struct rotdyn_axle_columns {
  size_t size;
  double *theta_rad, *omega_rad_per_s;
  double *applied_torque_n_m, *damping_torque_n_m, *net_torque_n_m;
  double *angular_momentum_kg_m2_per_s, *rotational_kinetic_energy_j;
} rotdyn_axle_columns;

/* Events of a run, in their order: "stick", "slip", "reverse". */
typedef struct rotdyn_events {
  size_t size;
  size_t room;       /* of the two arrays */
  double *time_s;    /* those that found room */
  const char **name; /* may be NULL */
  size_t count;      /* of all events; set by the run */
} rotdyn_events;

typedef struct rotdyn_options {
  size_t size;
  double accuracy;      /* largest relative error wanted; 0: 1e-9 */
  const char *model;    /* NULL: the cheapest that takes the scene and reaches the accuracy */
  double max_steps;     /* of an integrator, beyond one for each row; 0: 1e6 */
  double torque_call_s; /* time of a call of torque(), for the prediction of costs; 0: 1e-6 */
  rotdyn_poll_fn poll;  /* called from the calling thread, up to every few milliseconds */
  void *poll_context;
  rotdyn_events *events;
  size_t threads; /* of a sweep, where the library has OpenMP; 0: one. No bit depends on it. */
} rotdyn_options;

/* The report of a run, also of one that failed. */
typedef struct rotdyn_info {
  size_t size;
  int status;
  size_t rows_done;                     /* rows that are valid */
  double time_s;                        /* how far the run came, or where it failed */
  size_t steps, rejected, torque_calls; /* of an integrator; torque_calls: right-hand sides */
  double error;                         /* largest relative error of theta and of omega */
  int error_is_bound;                   /* else an estimate */
  double theta_error_rad, omega_error_rad_per_s;     /* absolute */
  double largest_theta_rad, largest_omega_rad_per_s; /* of the motion, as far as seen */
  const char *model; /* the one that ran; NULL: none. An integrator may switch to the other. */
  char reason[512];  /* why no model or not this one fits; or what the model ignored */
} rotdyn_info;

typedef struct rotdyn_candidate {
  size_t size;
  const char *model;
  int applies;
  double error;       /* relative, promised */
  int error_is_bound; /* else an estimate */
  double cost_s;      /* predicted time */
  char reason[512];   /* why it does not apply, or what it ignores; else empty */
} rotdyn_candidate;

/* Many axles, a row each, under the torque of one rotdyn_axle. */
typedef struct rotdyn_sweep_in {
  size_t size;
  rotdyn_column time_s;        /* where each row ends, not before start_s */
  rotdyn_column inertia_kg_m2; /* these: NULL for the value of the rotdyn_axle */
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

/* ---- scenes by name --------------------------------------------------------------------------
 *
 * A scene is made by the name of its constructor in R and set input by input, so that a host with
 * keyword arguments or JSON needs a loop and nothing else:
 *
 *   rotdyn_scene *scene = rotdyn_scene_new("scene_incline");
 *   rotdyn_scene_body(scene, "body", &body);
 *   rotdyn_scene_number(scene, "incline_angle_deg", 20.0);
 *   status = rotdyn_scene_run(scene, n, time_s, &options, 1, &name, &column, &report);
 *   rotdyn_scene_free(scene);
 *
 * Bodies of a standard shape: shape_moments. Numbers are copied. A scene may be run from several
 * threads at a time while none sets it. */
typedef struct rotdyn_scene rotdyn_scene;

typedef struct rotdyn_input {
  size_t size;
  const char *name, *unit; /* unit: "1" of a plain number, "" where there is none */
  /* "number", "limit" (a number or Inf), "times" (increasing), "vector" (3 numbers), "attitude" (a
   * quaternion, scalar first), "numbers" (one or more), "choice", "body", "law"; or "vector or
   * law" */
  const char *kind;
  int required;
  double low, high; /* of numbers: the domain, */
  int above;        /* without `low` itself */
  double otherwise; /* the default; NaN: from other inputs, as `words` say */
  const char *words;
  const char *const *options; /* of a choice, the first is the default; the list ends with NULL */
} rotdyn_input;

/* A body of any kind: a shape's from shape_moments, a mesh's from the host. */
typedef struct rotdyn_body {
  size_t size;
  double mass_kg;
  double centre_m[3];      /* of mass, in its own axes */
  double inertia_kg_m2[6]; /* the tensor about it: xx, yy, zz, xy, xz, yz */
  double radius_m;         /* on which it rolls about its own z axis; 0: it has none */
} rotdyn_body;

/* A law that only the caller can evaluate, of the arguments that the input's words list. Not 0
 * stops the run. Finite. */
typedef int (*rotdyn_law_fn)(const double *argument, double *value, void *context);

typedef struct rotdyn_report {
  size_t size;
  int status;
  size_t rows_done;                  /* rows that are valid */
  double time_s;                     /* how far the run came, or where it failed */
  size_t steps, rejected, law_calls; /* of an integrator */
  double error;                      /* the largest relative error of a measure */
  int error_is_bound;                /* else an estimate */
  size_t n_measures;
  const char *measure[8]; /* such as "theta" */
  double measure_error[8], measure_largest[8];
  const char *model; /* the one that ran; NULL: none */
  const char *input; /* the one that was refused; NULL: none */
  char reason[512];  /* why an input was refused, or no model or not this one fits */
} rotdyn_report;

/* ---- the table -------------------------------------------------------------------------------
 *
 * version               "0.5.0"
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
 * axle_candidate        the k-th cheapest model of the axle for these times and this accuracy
 * axle_choose           the model that axle_rows() runs; ROTDYN_EACCURACY if there is none
 * axle_rows             the motion at n times, finite and not decreasing
 * axle_sweep            many axles in closed form, a row each; ROTDYN_EMODEL where none takes them
 *
 *
 * scene_at              constructor i of those that make scenes here, from 0; NULL after the last
 * input_at, column_at   input, name of column i of such scenes, from 0; ROTDYN_EEND, NULL after the
 *                       last. Columns that only some effects bring are 0 without them.
 * scene_new             NULL: there is no such constructor, or no memory
 * scene_number, scene_numbers, scene_text, scene_body, scene_law   set an input; ROTDYN_ENAME:
 *                       there is none of this name, ROTDYN_EARGUMENT: it is of another kind
 * scene_unset           back to the default
 * scene_check           ROTDYN_EARGUMENT: the report names the input and why it is refused
 * scene_candidate       the k-th cheapest model for these times and this accuracy
 * scene_run             columns by name, n values each (of flags 0 and 1); of scene_chain n times
 *                       the number of lengths, the links of one time together
 *
 * `options`, `info`, `report` may be NULL. Of the options scenes take accuracy, model, max_steps,
 * torque_call_s, poll and events. */
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
  X(int, axle_candidate,                                                                           \
    (const rotdyn_axle *axle, size_t n, const double *time_s, const rotdyn_options *options,       \
     size_t k, rotdyn_candidate *out))                                                             \
  X(int, axle_choose,                                                                              \
    (const rotdyn_axle *axle, size_t n, const double *time_s, const rotdyn_options *options,       \
     rotdyn_candidate *out))                                                                       \
  X(int, axle_rows,                                                                                \
    (const rotdyn_axle *axle, size_t n, const double *time_s, const rotdyn_options *options,       \
     const rotdyn_axle_columns *out, rotdyn_info *info))                                           \
  X(int, axle_sweep,                                                                               \
    (const rotdyn_axle *axle, size_t n, const rotdyn_sweep_in *in, const rotdyn_options *options,  \
     const rotdyn_sweep_out *out, rotdyn_info *info))                                              \
  X(const char *, scene_at, (size_t i))                                                            \
  X(int, input_at, (const char *constructor, size_t i, rotdyn_input *out))                         \
  X(const char *, column_at, (const char *constructor, size_t i))                                  \
  X(rotdyn_scene *, scene_new, (const char *constructor))                                          \
  X(void, scene_free, (rotdyn_scene * scene))                                                      \
  X(int, scene_number, (rotdyn_scene * scene, const char *input, double value))                    \
  X(int, scene_numbers, (rotdyn_scene * scene, const char *input, size_t n, const double *values)) \
  X(int, scene_text, (rotdyn_scene * scene, const char *input, const char *option))                \
  X(int, scene_body, (rotdyn_scene * scene, const char *input, const rotdyn_body *body))           \
  X(int, scene_law, (rotdyn_scene * scene, const char *input, rotdyn_law_fn law, void *context))   \
  X(int, scene_unset, (rotdyn_scene * scene, const char *input))                                   \
  X(int, scene_check, (const rotdyn_scene *scene, rotdyn_report *report))                          \
  X(int, scene_candidate,                                                                          \
    (const rotdyn_scene *scene, size_t n, const double *time_s, const rotdyn_options *options,     \
     size_t k, rotdyn_candidate *out))                                                             \
  X(int, scene_run,                                                                                \
    (const rotdyn_scene *scene, size_t n, const double *time_s, const rotdyn_options *options,     \
     size_t n_columns, const char *const *names, double *const *columns, rotdyn_report *report))

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
