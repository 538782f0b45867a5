/* Status codes, the report of a run, and the hooks a caller may hang on a long one. */
#ifndef ROT_STATUS_H
#define ROT_STATUS_H

#include <stddef.h>

/* code, text, kind: the R condition class is rotdyn_error_<kind>. Listed once, here. */
#define ROT_STATUS_LIST(X)                                                                         \
  X(ROT_OK, "ok", "none")                                                                          \
  X(ROT_ENOMEM, "out of memory", "memory")                                                         \
  X(ROT_EVALUE, "a value outside its domain", "value")                                             \
  X(ROT_ERANGE, "the state left the range of double precision", "range")                           \
  X(ROT_ETORQUE, "the torque law gave no finite number", "torque")                                 \
  X(ROT_ERHS, "the right-hand side gave no finite number", "rhs")                                  \
  X(ROT_EBUDGET, "the step budget is used up", "budget")                                           \
  X(ROT_ESTEP, "the step fell below the resolution of time", "step")                               \
  X(ROT_EUNWIND, "stopped by the caller", "unwind")

typedef enum rot_status {
#define X(code, text, kind) code,
  ROT_STATUS_LIST(X)
#undef X
      ROT_STATUS_COUNT
} rot_status;

const char *rot_status_text(rot_status status);
const char *rot_status_kind(rot_status status);

/* How a run was made: listed once, here, with the name that R shows. */
#define ROT_METHOD_LIST(X)                                                                         \
  X(ROT_METHOD_NONE, "none")                                                                       \
  X(ROT_METHOD_RK8PD, "rk8pd") /* Prince & Dormand, order 8 */                                     \
  X(ROT_METHOD_RADAU, "radau") /* Radau IIA, order 9, for stiff motions */

typedef enum rot_method {
#define X(code, name) code,
  ROT_METHOD_LIST(X)
#undef X
      ROT_METHOD_COUNT
} rot_method;

/* What happened. Filled by every run, also by one that failed. */
typedef struct rot_info {
  rot_status status;
  double time_s;      /* how far the run came, or where it failed */
  size_t rows_done;   /* rows of the output that are valid, counted from the start of the run */
  size_t steps;       /* accepted steps; segments for a closed form */
  size_t rejected;    /* rejected steps */
  size_t rhs_calls;   /* right-hand sides evaluated; 0 for a closed form */
  double theta_error; /* largest absolute error of theta over the rows: bound or estimate */
  double omega_error; /* the same of omega */
  double theta_max;   /* largest |theta| from the start to the last row, as far as it was seen */
  double omega_max;   /* the same of omega */
  double omega_high, omega_low; /* omega itself, by the models that call rot_note_state() */
  double tolerance;  /* tolerance per step of the run that chose the steps; 0 for a closed form */
  rot_method method; /* of the steps; ROT_METHOD_NONE for a closed form */
} rot_info;

const char *rot_method_name(rot_method method);

void rot_info_clear(rot_info *info);
/* Largest error relative to the largest value, of theta or of omega. The values on the way count
 * too: a row at rest is not an infinite error, and no row's error depends on the others asked. */
double rot_info_error(const rot_info *info);

/* Take note of a state on the way; of a row with its errors. NaN stays. */
static inline void rot_note_state(rot_info *info, double theta, double omega) {
  info->omega_high = omega > info->omega_high ? omega : info->omega_high;
  info->omega_low = omega < info->omega_low ? omega : info->omega_low;
  theta = theta < 0.0 ? -theta : theta;
  omega = omega < 0.0 ? -omega : omega;
  if (!(theta <= info->theta_max)) info->theta_max = theta;
  if (!(omega <= info->omega_max)) info->omega_max = omega;
}

static inline void rot_note_row(rot_info *info, double theta, double omega, double theta_error,
                                double omega_error) {
  rot_note_state(info, theta, omega);
  if (!(theta_error <= info->theta_error)) info->theta_error = theta_error;
  if (!(omega_error <= info->omega_error)) info->omega_error = omega_error;
}

/* poll() is called now and then from a long run; anything but ROT_OK stops it. */
typedef struct rot_hooks {
  rot_status (*poll)(void *ctx, double fraction);
  void *ctx;
} rot_hooks;

rot_status rot_poll(const rot_hooks *hooks, double fraction);

#endif
