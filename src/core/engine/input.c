#include "engine/input.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

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

double rot_input_number(const rot_input inputs[], const rot_given given[], size_t input) {
  return given[input].is ? given[input].x[0] : inputs[input].otherwise;
}

void rot_input_vector(const rot_given *given, double x[3]) {
  for (int i = 0; i < 3; i++) x[i] = given->is ? given->x[i] : 0.0;
}

static rot_status check_number(const rot_input *input, size_t at, const rot_given *given,
                               rot_refusal *refusal) {
  const double x = given->x[0];
  const int limit = (input->kinds & ROT_INPUT_LIMIT) != 0;
  if (given->n != 1) return rot_refuse(refusal, at, "must be one number");
  if (isnan(x) || (isinf(x) && (!limit || x < 0.0))) {
    return rot_refuse(refusal, at, "must be %s; it is %g", limit ? "a number, or Inf" : "finite",
                      x);
  }
  if (x < input->low || (input->above && x == input->low)) {
    return rot_refuse(refusal, at, "must be %s %g; it is %.17g",
                      input->above ? "greater than" : "at least", input->low, x);
  }
  if (x > input->high) {
    return rot_refuse(refusal, at, "must be at most %g; it is %.17g", input->high, x);
  }
  return ROT_OK;
}

static rot_status check_each(const rot_input *input, size_t at, const rot_given *given,
                             rot_refusal *refusal) {
  if (given->n == 0) return rot_refuse(refusal, at, "must have a number; it has none");
  for (size_t i = 0; i < given->n; i++) {
    const rot_given one = {.is = given->is, .n = 1, .x = given->x + i};
    const rot_status status = check_number(input, at, &one, refusal);
    if (status != ROT_OK) return status;
  }
  return ROT_OK;
}

static rot_status check_times(size_t at, const rot_given *given, rot_refusal *refusal) {
  for (size_t i = 0; i < given->n; i++) {
    if (!isfinite(given->x[i])) return rot_refuse(refusal, at, "must be finite");
    if (i && !(given->x[i] > given->x[i - 1])) return rot_refuse(refusal, at, "must increase");
  }
  return ROT_OK;
}

static rot_status check_numbers(size_t at, size_t n, const rot_given *given, rot_refusal *refusal) {
  double most = 0.0;
  if (given->n != n)
    return rot_refuse(refusal, at, "must have %zu numbers; it has %zu", n, given->n);
  for (size_t i = 0; i < n; i++) {
    if (!isfinite(given->x[i])) return rot_refuse(refusal, at, "must be finite");
    most = fmax(most, fabs(given->x[i]));
  }
  if (n == 4 && most == 0.0) return rot_refuse(refusal, at, "must not be 0");
  return ROT_OK;
}

static rot_status check_body(size_t at, const rot_given_body *body, rot_refusal *refusal) {
  if (!(body->mass_kg > 0.0 && body->mass_kg < INFINITY)) {
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

rot_status rot_inputs_check(size_t n, const rot_input inputs[], const rot_given given[],
                            rot_refusal *refusal) {
  rot_status status = ROT_OK;
  for (size_t i = 0; i < n && status == ROT_OK; i++) {
    if (!given[i].is) {
      if (inputs[i].required) status = rot_refuse(refusal, i, "is missing: it has no default");
      continue;
    }
    switch ((rot_input_kind)given[i].is) {
    case ROT_INPUT_NUMBER:
    case ROT_INPUT_LIMIT: status = check_number(&inputs[i], i, &given[i], refusal); break;
    case ROT_INPUT_NUMBERS: status = check_each(&inputs[i], i, &given[i], refusal); break;
    case ROT_INPUT_TIMES: status = check_times(i, &given[i], refusal); break;
    case ROT_INPUT_VECTOR: status = check_numbers(i, 3, &given[i], refusal); break;
    case ROT_INPUT_ATTITUDE: status = check_numbers(i, 4, &given[i], refusal); break;
    case ROT_INPUT_BODY: status = check_body(i, &given[i].body, refusal); break;
    case ROT_INPUT_CHOICE:
    case ROT_INPUT_LAW: break;
    }
  }
  return status;
}
