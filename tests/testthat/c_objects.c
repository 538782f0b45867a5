/* For test-c-interface.R: objects of rotdyn.h, made and set by .C() of R. An object is its place in
 * a table. */
#define ROTDYN_USE_R
#include <rotdyn.h>
#include <stdlib.h>
#include <string.h>

enum { MOST = 4096 };
static const rotdyn_api *api;
static rotdyn_object *object[MOST];
static int used;

void begin(void) { api = rotdyn_api_from_r(); }

void is_object(char **constructor, int *answer) {
  *answer = api->object_kind(*constructor) != NULL;
}

void new_object(char **constructor, int *at) {
  *at = used;
  if (used < MOST) object[used++] = api->object_new(*constructor);
}

void free_all(void) {
  while (used > 0) api->object_free(object[--used]);
}

/* An empty name: an item is added to a list. */
static const char *name_of(char **input) { return **input ? *input : NULL; }

void set_numbers(const int *at, char **input, const int *n, const double *x, int *status) {
  *status = *n == 1 ? api->set_number(object[*at], name_of(input), *x) : ROTDYN_EARGUMENT;
  if (*status == ROTDYN_EARGUMENT) {
    *status = api->set_numbers(object[*at], name_of(input), (size_t)*n, x);
  }
}

void set_text(const int *at, char **input, char **text, int *status) {
  *status = api->set_text(object[*at], name_of(input), *text);
}

void set_object(const int *at, char **input, const int *value, int *status) {
  *status = api->set_object(object[*at], name_of(input), object[*value]);
}

void set_nothing(const int *at, char **input, int *status) {
  *status = api->unset(object[*at], name_of(input));
}

void check(const int *at, int *copies, char **reason) {
  rotdyn_report report = ROTDYN_INIT(rotdyn_report);
  (void)api->object_check(object[*at], &report);
  *copies = (int)report.rows_per_time;
  strncpy(*reason, report.reason, 199);
}

/* Columns one after the other. */
void run(const int *at, const int *n, const double *time_s, const double *accuracy, char **asked,
         const int *n_columns, char **names, const int *rows, double *values, double *error,
         int *status, char **model) {
  rotdyn_options options = ROTDYN_INIT(rotdyn_options);
  rotdyn_report report = ROTDYN_INIT(rotdyn_report);
  double *columns[64];
  options.accuracy = *accuracy;
  options.model = **asked ? *asked : NULL;
  for (int i = 0; i < *n_columns && i < 64; i++) columns[i] = values + (size_t)i * (size_t)*rows;
  *status = api->scene_run(object[*at], (size_t)*n, time_s, &options, (size_t)*rows,
                           (size_t)*n_columns, (const char *const *)names, columns, &report);
  *error = report.error;
  strncpy(*model, report.model ? report.model : report.reason, 199);
}

/* numbers: change, supplied, dissipated, residual, explained; flags: balanced, conserved. */
void balance(const int *at, const int *n, const double *time_s, const double *accuracy,
             const int *k, double *numbers, int *flags, char **quantity, char **why, int *status) {
  rotdyn_options options = ROTDYN_INIT(rotdyn_options);
  rotdyn_balance b = ROTDYN_INIT(rotdyn_balance);
  options.accuracy = *accuracy;
  *status = api->scene_balance(object[*at], (size_t)*n, time_s, &options, (size_t)*k, &b, NULL);
  if (*status != ROTDYN_OK) return;
  const double x[] = {b.change, b.supplied, b.dissipated, b.residual, b.explained};
  memcpy(numbers, x, sizeof x);
  flags[0] = b.balanced;
  flags[1] = b.conserved;
  strncpy(*quantity, b.quantity, 199);
  strncpy(*why, b.why, 199);
}
