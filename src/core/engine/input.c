#include "engine/input.h"

#include <float.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "ground/text.h"

const char *const rot_max_static[] = {"static_friction", NULL};

size_t rot_input_named(size_t n, const rot_input inputs[], const char *name) {
  size_t i = 0;
  while (i < n && strcmp(inputs[i].name, name)) i++;
  return i;
}

rot_status rot_refuse(rot_refusal *refusal, size_t input, const char *format, ...) {
  va_list arguments;
  refusal->input = input;
  va_start(arguments, format);
  (void)vsnprintf(refusal->reason, sizeof refusal->reason, format, arguments);
  va_end(arguments);
  return ROT_EVALUE;
}

rot_status rot_refuse_numbers(rot_refusal *refusal, size_t input, const char *format, double first,
                              double second) {
  char text[2][ROT_TEXT_SIZE];
  (void)rot_text_number(first, text[0]);
  (void)rot_text_number(second, text[1]);
  return rot_refuse(refusal, input, format, text[0], text[1]);
}

void rot_refused_in(rot_refusal *refusal, const char *format, ...) {
  char place[100];
  va_list arguments;
  va_start(arguments, format);
  (void)vsnprintf(place, sizeof place - 1, format, arguments);
  va_end(arguments);
  strcat(place, " ");
  const size_t length = strlen(place), room = sizeof refusal->reason - 1 - length;
  memmove(refusal->reason + length, refusal->reason, room);
  memcpy(refusal->reason, place, length);
  refusal->reason[sizeof refusal->reason - 1] = '\0';
}

size_t rot_input_arguments(const rot_input *input, size_t size[ROT_MAX_LAW_ARGUMENTS]) {
  size_t n = 1;
  size[0] = size[1] = size[2] = 1;
  if (!input->options) return 3;
  while (input->options[n - 1]) {
    const char *count = strchr(input->options[n - 1], ':');
    size[n++] = count ? (size_t)(count[1] - '0') : 1;
  }
  return n;
}

size_t rot_input_values(const rot_input *input) { return input->kinds & ROT_INPUT_VECTOR ? 3 : 1; }

size_t rot_input_max(const rot_input inputs[], size_t input) {
  const int one = (inputs[input].kinds & (ROT_INPUT_NUMBER | ROT_INPUT_LIMIT)) != 0;
  return one && inputs[input].options ? rot_input_named(input, inputs, inputs[input].options[0])
                                      : input;
}

double rot_input_number(const rot_input inputs[], const rot_given given[], size_t input) {
  if (given[input].x) return given[input].x[0];
  const size_t max = rot_input_max(inputs, input);
  return max < input ? rot_input_number(inputs, given, max) : inputs[input].otherwise;
}

void rot_input_numbers(size_t n, const rot_input inputs[], const rot_given given[], double x[]) {
  for (size_t i = 0; i < n; i++) x[i] = rot_input_number(inputs, given, i);
}

void rot_input_vector(const rot_given *given, double x[3]) {
  for (int i = 0; i < 3; i++) x[i] = given->is ? given->x[i] : 0.0;
}

static double sum_of_squares(const double x[3]) {
  long double sum = 0.0L; /* as R adds numbers */
  for (int i = 0; i < 3; i++) sum += x[i] * x[i];
  return (double)sum;
}

int rot_input_axis(const double x[3], double axis[3]) {
  double max = 0.0;
  for (int i = 0; i < 3; i++) max = fmax(max, fabs(axis[i] = x[i]));
  if (max == 0.0) return 0;
  if (fabs(sum_of_squares(axis) - 1.0) <= 4.0 * DBL_EPSILON) return 1;
  for (int i = 0; i < 3; i++) axis[i] /= max;
  const double length = sqrt(sum_of_squares(axis));
  for (int i = 0; i < 3; i++) axis[i] /= length;
  return 1;
}

rot_status rot_input_each(const rot_input inputs[], const rot_given given[], size_t input, size_t n,
                          double x[], rot_refusal *refusal) {
  const rot_given *g = &given[input];
  if (g->is && g->n != n && g->n != 1) {
    return n > 1 ? rot_refuse(refusal, input, "must have 1 or %zu numbers; it has %zu", n, g->n)
                 : rot_refuse(refusal, input, "must have %zu numbers; it has %zu", n, g->n);
  }
  for (size_t i = 0; i < n; i++) {
    x[i] = g->is ? g->x[g->n == 1 ? 0 : i] : inputs[input].otherwise;
  }
  return ROT_OK;
}

/* ---- checks ---------------------------------------------------------------------------------- */

static rot_status check_domain(const rot_input *input, size_t at, double x, rot_refusal *refusal) {
  const int limit = (input->kinds & ROT_INPUT_LIMIT) != 0;
  if (isnan(x) || (isinf(x) && (!limit || x < input->low || x > input->high))) {
    return rot_refuse(refusal, at, "must be %s; it is %s",
                      !limit                   ? "finite"
                      : input->high < INFINITY ? "a number, or -Inf"
                                               : "a number, or Inf",
                      isnan(x) ? "NaN"
                      : x > 0  ? "Inf"
                               : "-Inf");
  }
  if (x < input->low || (input->above && x == input->low)) {
    return rot_refuse_numbers(refusal, at,
                              input->above ? "must be greater than %s; it is %s"
                                           : "must be at least %s; it is %s",
                              input->low, x);
  }
  if (x > input->high) {
    return rot_refuse_numbers(refusal, at, "must be at most %s; it is %s", input->high, x);
  }
  return ROT_OK;
}

static rot_status check_number(const rot_input *input, size_t at, const rot_given *given,
                               rot_refusal *refusal) {
  if (given->n != 1) return rot_refuse(refusal, at, "must be one number");
  return check_domain(input, at, given->x[0], refusal);
}

static rot_status check_each(const rot_input *input, size_t at, const rot_given *given,
                             rot_refusal *refusal) {
  rot_status status = ROT_OK;
  for (size_t i = 0; i < given->n && status == ROT_OK; i++) {
    status = check_domain(input, at, given->x[i], refusal);
    if (status != ROT_OK && given->n > 1) rot_refused_in(refusal, "item %zu", i + 1);
  }
  return status;
}

static rot_status check_times(size_t at, const rot_given *given, rot_refusal *refusal) {
  for (size_t i = 0; i < given->n; i++) {
    if (!isfinite(given->x[i])) return rot_refuse(refusal, at, "must be finite");
    if (i && !(given->x[i] > given->x[i - 1])) return rot_refuse(refusal, at, "must increase");
  }
  return ROT_OK;
}

static rot_status check_numbers(size_t at, size_t n, const rot_given *given, rot_refusal *refusal) {
  double max = 0.0;
  if (given->n != n)
    return rot_refuse(refusal, at, "must have %zu numbers; it has %zu", n, given->n);
  for (size_t i = 0; i < n; i++) {
    if (!isfinite(given->x[i])) return rot_refuse(refusal, at, "must be finite");
    max = fmax(max, fabs(given->x[i]));
  }
  if (n == 4 && max == 0.0) return rot_refuse(refusal, at, "must not be 0");
  return ROT_OK;
}

/* `massless`: only a moment of inertia counts, which its builder checks. */
static rot_status check_body(size_t at, const rot_given_body *body, int massless,
                             rot_refusal *refusal) {
  const int mass = body->mass_kg > 0.0 || (massless && body->mass_kg == 0.0);
  if (!(mass && body->mass_kg < INFINITY)) {
    return rot_refuse(refusal, at, "must have a mass, finite and greater than 0; it is %g",
                      body->mass_kg);
  }
  for (int i = 0; i < 6; i++) {
    if (!isfinite(body->inertia_kg_m2[i]) || (i < 3 && !isfinite(body->centre_m[i]))) {
      return rot_refuse(refusal, at, "must have finite numbers");
    }
  }
  return ROT_OK;
}

/* Of lists, its items. */
static rot_status check_given(const rot_input *input, size_t at, const rot_given *given,
                              rot_refusal *refusal) {
  rot_status status = ROT_OK;
  switch ((rot_input_kind)given->is) {
  case ROT_INPUT_NUMBER:
  case ROT_INPUT_LIMIT: return check_number(input, at, given, refusal);
  case ROT_INPUT_TIMES: return check_times(at, given, refusal);
  case ROT_INPUT_VECTOR: return check_numbers(at, 3, given, refusal);
  case ROT_INPUT_ATTITUDE: return check_numbers(at, 4, given, refusal);
  case ROT_INPUT_NUMBERS: return check_each(input, at, given, refusal);
  case ROT_INPUT_BODY:
    return check_body(at, &given->body, (input->kinds & ROT_INPUT_NUMBER) != 0, refusal);
  case ROT_INPUT_LIST:
    for (size_t i = 0; i < given->n && status == ROT_OK; i++) {
      const rot_given *item = &given->item[i];
      if (item->is && !(item->is & input->kinds)) {
        status = rot_refuse(refusal, at, "is of a kind that this input does not take");
      } else if (!item->is && !(input->kinds & ROT_INPUT_NOTHING)) {
        status = rot_refuse(refusal, at, "is nothing");
      } else if (item->is) {
        status = check_given(input, at, item, refusal);
      }
      if (status != ROT_OK) rot_refused_in(refusal, "item %zu", i + 1);
    }
    return status;
  default: return ROT_OK;
  }
}

rot_status rot_input_check(size_t input, const rot_input inputs[], const rot_given given[],
                           rot_refusal *refusal) {
  const rot_given *own = &given[input];
  if (!own->is) {
    return inputs[input].required ? rot_refuse(refusal, input, "is missing: it has no default")
                                  : ROT_OK;
  }
  const rot_status status = check_given(&inputs[input], input, own, refusal);
  if (status != ROT_OK || own->n != 1) return status;
  const size_t max = rot_input_max(inputs, input);
  if (max == input || own->x[0] <= rot_input_number(inputs, given, max)) return ROT_OK;
  (void)rot_refuse_numbers(refusal, input, "%s; it is %s", rot_input_number(inputs, given, max),
                           own->x[0]);
  rot_refused_in(refusal, "must be at most `%s`,", inputs[max].name);
  return ROT_EVALUE;
}

rot_status rot_inputs_check(size_t n, const rot_input inputs[], const rot_given given[],
                            rot_refusal *refusal) {
  rot_status status = ROT_OK;
  for (size_t i = 0; i < n && status == ROT_OK; i++) {
    status = rot_input_check(i, inputs, given, refusal);
  }
  return status;
}
