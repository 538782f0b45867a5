/* Status codes, the report of a run, and polling hooks. */
#ifndef ROT_STATUS_H
#define ROT_STATUS_H

#include <stddef.h>

#include "ground/ieee.h"

/* code, text, kind; the R condition class is rotdyn_error_<kind>. */
#define ROT_STATUS_LIST(X)                                                                         \
  X(ROT_OK, "ok", "none")                                                                          \
  X(ROT_ENOMEM, "out of memory", "memory")                                                         \
  X(ROT_EVALUE, "a value outside its domain", "value")                                             \
  X(ROT_ERANGE, "the state left the range of double precision", "range")                           \
  X(ROT_ETORQUE, "the torque law gave no finite number", "torque")                                 \
  X(ROT_ERHS, "the right-hand side gave no finite number", "rhs")                                  \
  X(ROT_EBUDGET, "the step budget does not suffice", "budget")                                     \
  X(ROT_ESTEP, "the step fell below the resolution of time", "step")                               \
  X(ROT_ERANDOM, "the torque law gave two values for the same arguments", "random")                \
  X(ROT_EUNWIND, "stopped by the caller", "unwind")

typedef enum rot_status {
#define X(code, text, kind) code,
  ROT_STATUS_LIST(X)
#undef X
      ROT_STATUS_COUNT
} rot_status;

/* status => text of the list above */
const char *rot_status_text(rot_status status);
/* status => kind of the list above */
const char *rot_status_kind(rot_status status);

/* Integration methods: code, name shown by R. */
#define ROT_METHOD_LIST(X)                                                                         \
  X(ROT_METHOD_NONE, "none")                                                                       \
  X(ROT_METHOD_RK8PD, "rk8pd") /* Prince & Dormand, order 8 */                                     \
  X(ROT_METHOD_RADAU, "radau") /* Radau IIA, order 9, for stiff motions */                         \
  /* fixed step: */                                                                                \
  X(ROT_METHOD_EULER, "euler")                                                                     \
  X(ROT_METHOD_SEMI_IMPLICIT, "semi_implicit")                                                     \
  X(ROT_METHOD_RK4, "rk4")                                                                         \
  X(ROT_METHOD_SPLIT, "split")

typedef enum rot_method {
#define X(code, name) code,
  ROT_METHOD_LIST(X)
#undef X
      ROT_METHOD_COUNT
} rot_method;

/* A measure: a named quantity with an error. */
typedef struct rot_measure {
  double error;     /* max absolute error over the rows: bound or estimate */
  double largest;   /* max absolute value from the start to the last row, of the states noted */
  double high, low; /* extreme values, by models that call rot_note_state(); else -Inf and Inf */
} rot_measure;

enum { ROT_MAX_MEASURES = 16 };

/* Measures of bodies that turn about a fixed axis; the list of names ends with NULL. */
enum { ROT_THETA, ROT_OMEGA };
extern const char *const rot_turning[];

/* The report of a run, also of a failed one. */
typedef struct rot_info {
  rot_status status;
  double time_s;     /* time reached, or time of the failure */
  size_t rows_done;  /* valid rows of the output, counted from the start of the run */
  size_t steps;      /* accepted steps; segments for a closed form */
  size_t rejected;   /* rejected steps */
  size_t rhs_calls;  /* right-hand sides evaluated; 0 for a closed form */
  double tolerance;  /* tolerance per step of the run that chose the steps; 0 for a closed form */
  rot_method method; /* of the steps; ROT_METHOD_NONE for a closed form */
  double step_s;     /* fixed step length; 0: variable steps */
  size_t n_measures; /* <= ROT_MAX_MEASURES */
  const char *const *measure_names;
  rot_measure measure[ROT_MAX_MEASURES];
} rot_info;

/* method => name of the list above */
const char *rot_method_name(rot_method method);

/* Sets all to zero, but for measures beyond these, and names them: a list that ends with NULL, or
 * NULL for none. */
void rot_info_clear(rot_info *info, const char *const names[]);
/* Names and clears the measures only. */
void rot_info_measures(rot_info *info, const char *const names[]);

/* (error, largest value) => relative error. 1 where the value is 0; 0 for an error up to 1e-300,
 * which underflow leaves in a motion at rest; NaN stays. */
static inline double rot_relative_error(double error, double largest) {
  if (largest > 0.0) return error > 0.0 ? error / largest : error;
  return error > 1e-300 ? 1.0 : error >= 0.0 ? 0.0 : error;
}

/* Error figure: the largest relative error of n measures. Errors are relative to the largest value
 * of the whole motion, so a row at rest has a finite error. NaN stays. */
double rot_error_figure(size_t n, const double error[], const double largest[]);
/* Error figure of the measures of a run. */
double rot_info_error(const rot_info *info);

/* Updates the extreme values of a measure. */
static inline void rot_note_value(rot_measure *measure, double value) {
  const double size = value < 0.0 ? -value : value;
  measure->high = value > measure->high ? value : measure->high;
  measure->low = value < measure->low ? value : measure->low;
  if (!(size <= measure->largest)) measure->largest = size;
}

/* Updates the extremes by a state of an axle. NaN stays. */
static inline void rot_note_state(rot_info *info, double theta, double omega) {
  rot_note_value(&info->measure[ROT_THETA], theta);
  rot_note_value(&info->measure[ROT_OMEGA], omega);
}

/* Updates extremes and errors by a row. NaN stays. */
static inline void rot_note_row(rot_info *info, double theta, double omega, double theta_error,
                                double omega_error) {
  rot_note_state(info, theta, omega);
  if (!(theta_error <= info->measure[ROT_THETA].error))
    info->measure[ROT_THETA].error = theta_error;
  if (!(omega_error <= info->measure[ROT_OMEGA].error))
    info->measure[ROT_OMEGA].error = omega_error;
}

/* A long run calls poll() often with the fraction done, 0 to 1; a status other than ROT_OK stops
 * the run. */
typedef struct rot_hooks {
  rot_status (*poll)(void *ctx, double fraction);
  void *ctx;
} rot_hooks;

/* Calls the hook; ROT_OK without one. */
rot_status rot_poll(const rot_hooks *hooks, double fraction);

#endif
