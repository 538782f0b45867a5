#include "engine/laws.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "ground/real.h"

#define NUMBERS(name, unit, words)                                                                 \
  { name, unit, ROT_INPUT_NUMBERS, 1, ROT_NO_DOMAIN, NAN, words, NULL }
#define TIMES(name, words)                                                                         \
  { name, "s", ROT_INPUT_TIMES, 1, ROT_NO_DOMAIN, NAN, words, NULL }
#define REQUIRED(name, unit, words) ROT_NUMBER_INPUT(name, unit, 1, -DBL_MAX, 0, NAN, words)
#define OPTIONAL(name, unit, otherwise, words)                                                     \
  ROT_NUMBER_INPUT(name, unit, 0, -DBL_MAX, 0, otherwise, words)

#define BUILD(name)                                                                                \
  static rot_status name(const rot_part *part, const rot_given given[], rot_store *store,          \
                         void *to, rot_refusal *no)

#define VALUE(i) rot_input_number(part->inputs, given, i)

/* A sum of one law, in the store. */
static rot_status one_law(rot_law_one law, rot_store *store, void *to) {
  rot_law_one *own = rot_store_get(store, 1, sizeof *own);
  if (!own) return ROT_ENOMEM;
  *own = law;
  *(rot_law_sum *)to = (rot_law_sum){1, own};
  return ROT_OK;
}

static rot_status knots_law(rot_torque knots, rot_store *store, void *to) {
  return one_law((rot_law_one){.kind = ROT_LAW_KNOTS, .knots = knots}, store, to);
}

/* n numbers of a term, to be filled. */
static rot_status term_law(rot_term_kind kind, size_t n, const double window[2], rot_store *store,
                           void *to, double **x) {
  static const double always[2] = {-INFINITY, INFINITY};
  const double *acts = window ? window : always;
  *x = rot_store_get(store, n, sizeof **x);
  if (!*x) return ROT_ENOMEM;
  const rot_term term = {kind, acts[0], acts[1], n, *x};
  return one_law((rot_law_one){.kind = ROT_LAW_TERM, .term = term}, store, to);
}

rot_status rot_law_window(const rot_input inputs[], const rot_given given[], size_t from,
                          double window[2], rot_refusal *no) {
  window[0] = rot_input_number(inputs, given, from);
  window[1] = rot_input_number(inputs, given, from + 1);
  if (window[0] < window[1]) return ROT_OK;
  return rot_refuse_numbers(no, from, "must lie before `to_s`; they are %s and %s", window[0],
                            window[1]);
}

static rot_status same_count(const rot_given given[], size_t a, size_t b, rot_refusal *no) {
  if (given[a].n == given[b].n) return ROT_OK;
  return rot_refuse(no, b, "must have as many numbers as there are in front, %zu; it has %zu",
                    given[a].n, given[b].n);
}

/* ---- constants, knots, steps, pulses --------------------------------------------------------- */

static const rot_input constant_inputs[] = {REQUIRED("torque_n_m", "N*m", "the same at all times")};

BUILD(constant) {
  (void)no;
  return knots_law(rot_loads_constant(VALUE(0)), store, to);
}

static const char *const outsides[] = {"zero", "hold", NULL};

static const rot_input knots_inputs[] = {
    NUMBERS("time_s", "s", "of the knots, not decreasing; a repeated time is a jump"),
    NUMBERS("torque_n_m", "N*m", "at each knot"),
    {"outside", "", ROT_INPUT_CHOICE | ROT_INPUT_NUMBERS, 0, ROT_NO_DOMAIN, NAN,
     "outside the knots it is zero, or holds its first and last value; or two numbers in N m",
     outsides}};

BUILD(knots) {
  const size_t n = given[0].n;
  const double *t = given[0].x, *tau = given[1].x;
  const rot_given *outside = &given[2];
  rot_torque law = {.n = n, .time_s = t, .torque_n_m = tau};
  const int numbers = outside->is == ROT_INPUT_NUMBERS;
  (void)part;
  if (n < 2 && !(n == 1 && numbers)) {
    return rot_refuse(no, 0, "must have two knots or more; it has %zu", n);
  }
  if (same_count(given, 0, 1, no) != ROT_OK) return ROT_EVALUE;
  for (size_t i = 1; i < n; i++) {
    if (t[i] < t[i - 1]) return rot_refuse(no, 0, "must not go back in time");
  }
  if (!isfinite(t[n - 1] - t[0])) return rot_refuse(no, 0, "must span a finite time");
  if (numbers) {
    if (outside->n != 2) return rot_refuse(no, 2, "must have two numbers; it has %zu", outside->n);
    law.before_n_m = outside->x[0];
    law.after_n_m = outside->x[1];
  } else if (outside->is && outside->option == 1) {
    law.before_n_m = tau[0];
    law.after_n_m = tau[n - 1];
  }
  return knots_law(law, store, to);
}

static const rot_input steps_inputs[] = {
    TIMES("time_s", "of the steps"),
    NUMBERS("torque_n_m", "N*m", "from each step on until the next; 0 before the first")};

BUILD(steps) {
  const size_t n = given[0].n;
  const double *t = given[0].x, *tau = given[1].x;
  size_t at = 0;
  (void)part;
  if (n < 1) return rot_refuse(no, 0, "must have one time or more");
  if (same_count(given, 0, 1, no) != ROT_OK) return ROT_EVALUE;
  double *time_s = rot_store_get(store, n, 2 * sizeof *time_s);
  double *torque = rot_store_get(store, n, 2 * sizeof *torque);
  if (!time_s || !torque) return ROT_ENOMEM;
  for (size_t i = 0; i < n; i++) {
    if (i > 0) time_s[at] = t[i], torque[at++] = tau[i - 1];
    time_s[at] = t[i], torque[at++] = tau[i];
  }
  return knots_law(
      (rot_torque){.n = at, .time_s = time_s, .torque_n_m = torque, .after_n_m = tau[n - 1]}, store,
      to);
}

static const rot_input pulse_inputs[] = {
    NUMBERS("start_s", "s", "when each pulse begins"),
    {"duration_s", "s", ROT_INPUT_NUMBERS, 1, 0.0, DBL_MAX, 1, NAN, "how long each lasts", NULL},
    NUMBERS("torque_n_m", "N*m", "of each; one number is that of all")};

/* Where the end is rounded, the last unit of it in time carries what that takes from the impulse or
 * adds to it: before, the torque is as given, and after it the impulse. */
static rot_status one_pulse(double start, double duration, double end, double torque,
                            rot_store *store, rot_torque *pulse) {
  double *t = rot_store_get(store, 4, sizeof *t), *tau = rot_store_get(store, 4, sizeof *tau);
  if (!t || !tau) return ROT_ENOMEM;
  const double lasts = end - start;
  const double lost = (start - (end - lasts)) + (duration - lasts);
  *pulse = (rot_torque){.n = 2, .time_s = t, .torque_n_m = tau};
  t[0] = start;
  t[1] = end;
  tau[0] = tau[1] = torque;
  if (fabs(lost) <= 4.0 * DBL_EPSILON * duration) return ROT_OK;
  const double before = end - ldexp(1.0, (int)floor(log2(fabs(end))) - 52);
  pulse->n = 4;
  t[1] = t[2] = before;
  t[3] = end;
  tau[2] = tau[3] = torque * (1.0 + lost / (end - before));
  return ROT_OK;
}

BUILD(pulses) {
  size_t n = 0;
  rot_torque sum;
  (void)part;
  for (size_t i = 0; i < 3; i++) n = given[i].n > n ? given[i].n : n;
  for (size_t i = 0; i < 3; i++) {
    if (given[i].n != n && given[i].n != 1) {
      return rot_refuse(no, i, "must have 1 or %zu numbers; it has %zu", n, given[i].n);
    }
  }
  rot_torque *pulse = rot_store_get(store, n, sizeof *pulse);
  if (!pulse) return ROT_ENOMEM;
  for (size_t i = 0; i < n; i++) {
    const double start = given[0].x[given[0].n == 1 ? 0 : i];
    const double duration = given[1].x[given[1].n == 1 ? 0 : i], end = start + duration;
    /* The rounded duration is 0, or wrong by more than a thousandth. */
    if (!(fabs((end - start) - duration) <= 1e-3 * duration)) {
      return rot_refuse(no, 1, "of %g s at %g s is shorter than double precision resolves there",
                        duration, start);
    }
    const double torque = given[2].x[given[2].n == 1 ? 0 : i];
    if (one_pulse(start, duration, end, torque, store, &pulse[i]) != ROT_OK) return ROT_ENOMEM;
    for (size_t k = 0; k < pulse[i].n; k++) {
      if (!isfinite(pulse[i].torque_n_m[k])) return rot_refuse(no, 2, "is beyond double precision");
    }
  }
  if (rot_loads_add_knots(n, pulse, store, &sum) != ROT_OK) return ROT_ENOMEM;
  return knots_law(sum, store, to);
}

/* ---- terms ----------------------------------------------------------------------------------- */

static const rot_input polynomial_inputs[] = {
    TIMES("breaks_s", "ends of the pieces: one more than there are pieces"),
    {"coefficients", "N*m/s^j", ROT_INPUT_NUMBERS | ROT_INPUT_LIST, 1, ROT_NO_DOMAIN, NAN,
     "of one piece, of ascending powers of the time since it began; or a list of these, of one "
     "length",
     NULL}};

BUILD(polynomial) {
  const rot_given *a = &given[1];
  const rot_given *row = a->is == ROT_INPUT_LIST ? a->item : a;
  const size_t rows = a->is == ROT_INPUT_LIST ? a->n : 1;
  double *x;
  size_t degree = 1;
  (void)part;
  if (given[0].n < 2) return rot_refuse(no, 0, "must have two times or more");
  const size_t n = given[0].n - 1;
  if (rows != n) {
    return rot_refuse(no, 1, "must have a row for each of the %zu pieces; it has %zu", n, rows);
  }
  for (size_t i = 0; i < n; i++) {
    if (row[i].is == ROT_INPUT_LIST || row[i].n != row[0].n || row[i].n < 1) {
      return rot_refuse(no, 1, "must have rows of numbers of one length, 1 or more");
    }
    /* Trailing zeros do not raise the degree. */
    for (size_t j = degree; j < row[i].n; j++) {
      if (row[i].x[j] != 0.0) degree = j + 1;
    }
  }
  const rot_status status = term_law(ROT_TERM_POLYNOMIAL, 3 + n + n * degree, NULL, store, to, &x);
  if (status != ROT_OK) return status;
  *x++ = (double)n;
  *x++ = (double)degree;
  memcpy(x, given[0].x, (n + 1) * sizeof *x);
  x += n + 1;
  for (size_t i = 0; i < n; i++, x += degree) memcpy(x, row[i].x, degree * sizeof *x);
  return ROT_OK;
}

static const rot_input sinusoid_inputs[] = {
    REQUIRED("amplitude_n_m", "N*m", "amplitude cos(angular_frequency t + phase)"),
    REQUIRED("angular_frequency_rad_per_s", "rad/s", "angular frequency"),
    OPTIONAL("phase_rad", "rad", 0.0, "at the time 0"), ROT_WINDOW_INPUTS(-INFINITY)};

BUILD(sinusoid) {
  double window[2], *x;
  if (rot_law_window(part->inputs, given, 3, window, no) != ROT_OK) return ROT_EVALUE;
  if (term_law(ROT_TERM_SINUSOID, 3, window, store, to, &x) != ROT_OK) return ROT_ENOMEM;
  for (size_t i = 0; i < 3; i++) x[i] = VALUE(i);
  return ROT_OK;
}

static const rot_input exponential_inputs[] = {
    REQUIRED("torque_n_m", "N*m", "at `from_s`; 0 before"),
    REQUIRED("decay_per_s", "1/s", "rate of decay; below 0 it grows"),
    OPTIONAL("from_s", "s", 0.0, "when it begins"),
    {"to_s", "s", ROT_INPUT_LIMIT, 0, -INFINITY, INFINITY, 0, INFINITY, "it acts before", NULL}};

BUILD(exponential) {
  double window[2], *x;
  if (rot_law_window(part->inputs, given, 2, window, no) != ROT_OK) return ROT_EVALUE;
  if (term_law(ROT_TERM_EXPONENTIAL, 3, window, store, to, &x) != ROT_OK) return ROT_ENOMEM;
  for (size_t i = 0; i < 3; i++) x[i] = VALUE(i);
  return ROT_OK;
}

static const rot_input curve_inputs[] = {
    /* Increasing, as times are. */
    {"omega_rad_per_s", "rad/s", ROT_INPUT_TIMES, 1, ROT_NO_DOMAIN, NAN,
     "of the points, increasing", NULL},
    NUMBERS("torque_n_m", "N*m", "at each point: straight lines between, constant outside")};

rot_status rot_law_curve(size_t n, const double omega_rad_per_s[], const double torque_n_m[],
                         rot_store *store, rot_law_sum *to) {
  double *x;
  if (term_law(ROT_TERM_CURVE, 1 + 2 * n, NULL, store, to, &x) != ROT_OK) return ROT_ENOMEM;
  x[0] = (double)n;
  memcpy(x + 1, omega_rad_per_s, n * sizeof *x);
  memcpy(x + 1 + n, torque_n_m, n * sizeof *x);
  return ROT_OK;
}

BUILD(curve) {
  const size_t n = given[0].n;
  (void)part;
  if (n < 2) return rot_refuse(no, 0, "must have two points or more");
  if (same_count(given, 0, 1, no) != ROT_OK) return ROT_EVALUE;
  return rot_law_curve(n, given[0].x, given[1].x, store, to);
}

static const rot_input spring_inputs[] = {
    ROT_NUMBER_INPUT("stiffness_n_m_per_rad", "N*m/rad", 1, 0.0, 1, NAN, "torsional stiffness"),
    OPTIONAL("rest_rad", "rad", 0.0, "where the spring is relaxed")};

BUILD(spring) {
  double *x;
  (void)no;
  if (term_law(ROT_TERM_SPRING, 2, NULL, store, to, &x) != ROT_OK) return ROT_ENOMEM;
  x[0] = VALUE(0);
  x[1] = VALUE(1);
  return ROT_OK;
}

static const rot_input gravity_inputs[] = {
    ROT_NUMBER_INPUT("mass_kg", "kg", 1, 0.0, 0, NAN, "mass"),
    ROT_NUMBER_INPUT("distance_m", "m", 1, 0.0, 0, NAN, "of the centre of mass from the axle"),
    OPTIONAL("rest_rad", "rad", 0.0, "where the body hangs straight down"),
    OPTIONAL("gravity_m_per_s2", "m/s^2", 9.80665, "acceleration of gravity")};

rot_status rot_law_gravity(double mass_kg, double distance_m, double gravity_m_per_s2,
                           double rest_rad, rot_store *store, rot_law_sum *to) {
  const double factor[] = {mass_kg, distance_m, gravity_m_per_s2};
  double *x, rest;
  /* Over a long time its rounding counts. */
  const double largest = rot_sum_product(0.0, 3, factor, &rest);
  if (!isfinite(largest)) return ROT_EVALUE;
  if (largest == 0.0) return knots_law(rot_loads_constant(0.0), store, to);
  if (term_law(ROT_TERM_GRAVITY, 3, NULL, store, to, &x) != ROT_OK) return ROT_ENOMEM;
  x[0] = largest;
  x[1] = rest_rad;
  x[2] = rest;
  return ROT_OK;
}

BUILD(gravity) {
  const rot_status status = rot_law_gravity(VALUE(0), VALUE(1), VALUE(3), VALUE(2), store, to);
  return status == ROT_EVALUE ? rot_refuse(no, 0, "gives a torque beyond double precision")
                              : status;
}

/* As write_scene() of R writes a law that was multiplied. */
static const char *const term_kinds[] = {
#define X(code, name) name,
    ROT_TERM_LIST(X)
#undef X
        NULL};

static const rot_input term_inputs[] = {
    {"kind", "", ROT_INPUT_CHOICE, 1, ROT_NO_DOMAIN, NAN, "of the term", term_kinds},
    NUMBERS("x", "1", "its numbers"),
    {"text", "", ROT_INPUT_TEXT, 0, ROT_NO_DOMAIN, NAN, "in words", NULL},
    {"breaks_s", "s", ROT_INPUT_NUMBERS, 0, ROT_NO_DOMAIN, NAN, "those of the kind: not read",
     NULL},
    ROT_WINDOW_INPUTS(-INFINITY)};

BUILD(term) {
  rot_term own = {.kind = (rot_term_kind)given[0].option, .length = given[1].n, .x = given[1].x};
  double window[2];
  if (!rot_term_valid(&own)) return rot_refuse(no, 1, "does not fit the kind");
  if (rot_law_window(part->inputs, given, 4, window, no) != ROT_OK) return ROT_EVALUE;
  own.from_s = window[0];
  own.to_s = window[1];
  return one_law((rot_law_one){.kind = ROT_LAW_TERM, .term = own}, store, to);
}

/* ---- motors, functions, sums ----------------------------------------------------------------- */

static const rot_input motor_inputs[] = {
    REQUIRED("stall_torque_n_m", "N*m", "stall_torque (1 - omega/no_load_omega)"),
    REQUIRED("no_load_omega_rad_per_s", "rad/s",
             "where its torque is 0: not 0, of the sign of the "
             "stall torque")};

BUILD(motor) {
  const double stall = VALUE(0), fast = VALUE(1), slope = stall / fast;
  if (!isfinite(slope) || slope < 0.0) {
    return rot_refuse_numbers(
        no, 1, "must not be 0 and have the sign of the stall torque, %s; it is %s", stall, fast);
  }
  return one_law(
      (rot_law_one){.kind = ROT_LAW_MOTOR, .stall_n_m = stall, .no_load_rad_per_s = fast}, store,
      to);
}

static const rot_input function_inputs[] = {
    {"f", "N*m", ROT_INPUT_LAW, 1, ROT_NO_DOMAIN, NAN, "of time_s, theta_rad, omega_rad_per_s",
     NULL},
    {"breaks_s", "s", ROT_INPUT_TIMES, 0, ROT_NO_DOMAIN, NAN, "where it may jump or kink", NULL}};

BUILD(function) {
  (void)part, (void)no;
  return one_law((rot_law_one){.kind = ROT_LAW_CALL,
                               .call = given[0].law,
                               .n_breaks = given[1].is ? given[1].n : 0,
                               .breaks_s = given[1].x},
                 store, to);
}

static const rot_input sum_inputs[] = {
    {"laws", "N*m", ROT_INPUT_NUMBER | ROT_INPUT_LAW | ROT_INPUT_TORQUE | ROT_INPUT_LIST, 1,
     ROT_NO_DOMAIN, NAN, "what is added up", NULL}};

BUILD(sum) {
  (void)part;
  for (size_t i = 0; i < given[0].n && given[0].is == ROT_INPUT_LIST; i++) {
    if (given[0].item[i].is == ROT_INPUT_LIST) {
      return rot_refuse(no, 0, "item %zu must not be a list", i + 1);
    }
  }
  return rot_law_sum_of(&given[0], store, to) == ROT_OK ? ROT_OK : ROT_ENOMEM;
}

#define PART(constructor, inputs, build)                                                           \
  {                                                                                                \
    constructor, ROT_INPUT_TORQUE, sizeof inputs / sizeof *inputs, inputs, sizeof(rot_law_sum),    \
        build                                                                                      \
  }

const rot_part rot_law_parts[] = {
    PART("torque_constant", constant_inputs, constant),
    PART("torque_knots", knots_inputs, knots),
    PART("torque_steps", steps_inputs, steps),
    PART("torque_pulse", pulse_inputs, pulses),
    PART("torque_polynomial", polynomial_inputs, polynomial),
    PART("torque_sinusoid", sinusoid_inputs, sinusoid),
    PART("torque_exponential", exponential_inputs, exponential),
    PART("torque_motor", motor_inputs, motor),
    PART("torque_curve", curve_inputs, curve),
    PART("torque_spring", spring_inputs, spring),
    PART("torque_gravity", gravity_inputs, gravity),
    PART("torque_term", term_inputs, term),
    PART("torque_function", function_inputs, function),
    PART("torque_sum", sum_inputs, sum),
};
const size_t rot_law_n_parts = sizeof rot_law_parts / sizeof *rot_law_parts;
