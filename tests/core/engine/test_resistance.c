/* Terms of a resistance: built, taken or refused by name, one for each of several bodies. */
#include "engine/resistance.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "rot_test.h"

static const char *const drags[] = {"drag_n_s_per_m", "drag_n_s2_per_m2", NULL};
static const rot_input takes_axle = {"resistance", "",  ROT_INPUT_RESISTANCE, 0, -1e300, 1e300, 0,
                                     NAN,          "r", rot_axle_resistance};
static const rot_input takes_drag = {"resistance", "",   ROT_INPUT_RESISTANCE, 0, 0.0, 0.0, 0, NAN,
                                     "r",          drags};
static const rot_input takes_each = {"resistance", "N*m*s", ROT_RESISTANCES,       0, 0.0, 1e300, 0,
                                     0.0,          "r",     rot_viscous_resistance};

static rot_status make(size_t n, const char *const names[], const double x[], rot_resistance *to,
                       rot_refusal *no) {
  const rot_part *part = &rot_resistance_part;
  rot_given given[ROT_MAX_INPUTS];
  memset(given, 0, sizeof given);
  for (size_t i = 0; i < n; i++) {
    given[rot_input_named(part->n_inputs, part->inputs, names[i])] =
        (rot_given){.is = ROT_INPUT_NUMBER, .n = 1, .x = &x[i]};
  }
  const rot_status status = rot_inputs_check(part->n_inputs, part->inputs, given, no);
  return status == ROT_OK ? part->build(part, given, NULL, to, no) : status;
}

static void check_terms(void) {
  static const char *const all[] = {"viscous_n_m_s",   "quadratic_n_m_s2", "coulomb_n_m",
                                    "static_n_m",      "damping_per_s",    "drag_n_s_per_m",
                                    "drag_n_s2_per_m2"};
  const double x[] = {1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0};
  rot_resistance r;
  rot_refusal no;
  ROT_CHECK(make(7, all, x, &r, &no) == ROT_OK);
  ROT_CHECK(r.viscous_n_m_s == 1.0 && r.quadratic_n_m_s2 == 2.0 && r.coulomb_n_m == 3.0);
  ROT_CHECK(r.static_n_m == 4.0 && r.damping_per_s == 5.0);
  ROT_CHECK(r.drag_n_s_per_m == 6.0 && r.drag_n_s2_per_m2 == 7.0);
  /* Static friction is the sliding one where it is not given, and not below it. */
  ROT_CHECK(make(1, all + 2, x + 2, &r, &no) == ROT_OK && r.static_n_m == 3.0);
  const double low[] = {3.0, 2.5};
  ROT_CHECK(make(2, all + 2, low, &r, &no) == ROT_EVALUE && strstr(no.reason, "sliding friction"));
  const double below = -0.1;
  ROT_CHECK(make(1, all, &below, &r, &no) == ROT_OK);
  for (int i = 1; i < 4; i++) ROT_CHECK(make(1, all + i, &below, &r, &no) == ROT_EVALUE);
  ROT_CHECK(make(1, all + 4, &below, &r, &no) == ROT_OK);
  for (int i = 5; i < 7; i++) ROT_CHECK(make(1, all + i, &below, &r, &no) == ROT_EVALUE);
}

/* Each term alone, where it is taken and where it is not. */
static void check_taken(void) {
  rot_refusal no;
  for (size_t i = 0; i < rot_resistance_part.n_inputs; i++) {
    const char *name = rot_resistance_part.inputs[i].name;
    const double x = 0.5;
    rot_resistance r, got;
    const char *const names[] = {name};
    ROT_CHECK(make(1, names, &x, &r, &no) == ROT_OK);
    const rot_given given = {.is = ROT_INPUT_RESISTANCE, .n = 1, .object = &r};
    const int axle = i < 4, drag = i >= 5;
    ROT_CHECK((rot_resistance_of(&takes_axle, 3, &given, &got, &no) == ROT_OK) == axle);
    if (axle) ROT_CHECK(!memcmp(&got, &r, sizeof r));
    if (!axle) ROT_CHECK(no.input == 3 && strstr(no.reason, name));
    ROT_CHECK((rot_resistance_of(&takes_drag, 2, &given, &got, &no) == ROT_OK) == drag);
  }
  const rot_given nothing = {0};
  rot_resistance got = {1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0};
  ROT_CHECK(rot_resistance_of(&takes_axle, 0, &nothing, &got, &no) == ROT_OK);
  ROT_CHECK(got.viscous_n_m_s == 0.0 && got.drag_n_s2_per_m2 == 0.0);
}

static void check_each(void) {
  const double one = 0.25, three[] = {1.0, 0.0, 2.0}, bad[] = {1.0, -1.0, 2.0};
  const rot_resistance viscous = {.viscous_n_m_s = 0.5}, dry = {.coulomb_n_m = 1.0};
  double x[3];
  rot_refusal no;
  rot_given g = {.is = ROT_INPUT_NUMBERS, .n = 1, .x = &one};
#define EACH rot_resistance_each(&takes_each, 1, &g, 3, x, &no)
  ROT_CHECK(EACH == ROT_OK && x[0] == 0.25 && x[2] == 0.25);
  g = (rot_given){.is = ROT_INPUT_NUMBERS, .n = 3, .x = three};
  ROT_CHECK(EACH == ROT_OK && !memcmp(x, three, sizeof x));
  g.x = bad;
  ROT_CHECK(EACH == ROT_EVALUE && strstr(no.reason, "item 2"));
  g.n = 2;
  ROT_CHECK(EACH == ROT_EVALUE && strstr(no.reason, "1 or 3"));
  g = (rot_given){0};
  ROT_CHECK(EACH == ROT_OK && x[0] == 0.0 && x[1] == 0.0);
  g = (rot_given){.is = ROT_INPUT_RESISTANCE, .n = 1, .object = &viscous};
  ROT_CHECK(EACH == ROT_OK && x[0] == 0.5 && x[2] == 0.5);
  g.object = &dry;
  ROT_CHECK(EACH == ROT_EVALUE && strstr(no.reason, "coulomb_n_m"));
  const rot_given items[] = {{.is = ROT_INPUT_RESISTANCE, .n = 1, .object = &viscous},
                             {0},
                             {.is = ROT_INPUT_NUMBERS, .n = 1, .x = &one}};
  g = (rot_given){.is = ROT_INPUT_LIST, .n = 3, .item = items};
  ROT_CHECK(EACH == ROT_OK && x[0] == 0.5 && x[1] == 0.0 && x[2] == 0.25);
  const rot_given simd[] = {{.is = ROT_INPUT_NUMBERS, .n = 3, .x = three}, {0}, {0}};
  g.item = simd;
  ROT_CHECK(EACH == ROT_EVALUE && strstr(no.reason, "one number"));
#undef EACH
}

/* Numbers and the one term of a resistance, in the order of the inputs. */
static void check_numbers(void) {
  const rot_input both[] = {ROT_NUMBER_INPUT("mass_kg", "kg", 1, 0.0, 1, NAN, "m"),
                            ROT_RESISTANCE_INPUT("drag", rot_drag_resistance)};
  const rot_resistance drag = {.drag_n_s_per_m = 0.5}, viscous = {.viscous_n_m_s = 0.5};
  const double mass = 3.0;
  double x[2];
  rot_refusal no;
  rot_given given[2] = {{.is = ROT_INPUT_NUMBER, .n = 1, .x = &mass}, {0}};
  ROT_CHECK(rot_resistance_numbers(2, both, given, x, &no) == ROT_OK && x[0] == 3.0 && x[1] == 0.0);
  given[1] = (rot_given){.is = ROT_INPUT_RESISTANCE, .n = 1, .object = &drag};
  ROT_CHECK(rot_resistance_numbers(2, both, given, x, &no) == ROT_OK && x[0] == 3.0 && x[1] == 0.5);
  given[1].object = &viscous;
  ROT_CHECK(rot_resistance_numbers(2, both, given, x, &no) == ROT_EVALUE && no.input == 1);
}

int main(void) {
  check_terms();
  check_taken();
  check_each();
  check_numbers();
  return rot_test_report("resistance");
}
