/* Numbers of a scene by their paths: all forms, defaults, refusals; scenes built with them. */
#include "sweep_kit.h"
#include "body/compound.h"
#include "sweep/variants.h"

/* ---- the walk -------------------------------------------------------------------------------- */

typedef struct seen {
  size_t n, stop;
  char path[120][60];
  double value[120];
  size_t element[120];
} seen;

static int note(const rot_place *place, const char *path, void *ctx) {
  seen *s = ctx;
  (void)snprintf(s->path[s->n], sizeof s->path[0], "%s", path);
  s->value[s->n] = place->value;
  s->element[s->n] = place->element;
  return ++s->n == s->stop;
}

/* => place of a path among those seen; s->n: it is not there */
static size_t at(const seen *s, const char *path) {
  size_t i = 0;
  while (i < s->n && strcmp(s->path[i], path)) i++;
  return i;
}

static int has(const seen *s, const char *path, double value, size_t element) {
  const size_t i = at(s, path);
  return i < s->n && same_bits(s->value[i], value) && s->element[i] == element;
}

static void numbers_of_a_wheel(void) {
  static const double x[] = {2.0, 0.03, 1.0};
  rot_object *wheel = make_wheel(x);
  seen s = {.stop = 0};
  rot_variants_walk(wheel, note, &s);
  ROT_CHECK(has(&s, "body$mass_kg", 2.0, 0) && has(&s, "body$radius_m", 0.25, 0));
  ROT_CHECK(has(&s, "resistance$viscous_n_m_s", 0.03, 0));
  ROT_CHECK(has(&s, "resistance$static_n_m", NAN, 0)); /* its default follows */
  ROT_CHECK(has(&s, "omega0_rad_per_s", 1.0, 0) && has(&s, "theta0_rad", 0.0, 0));
  ROT_CHECK(has(&s, "torque", 0.8, 0) && has(&s, "body", NAN, 0));
  /* A direction that is not given, terms that axles do not take, options. */
  ROT_CHECK(has(&s, "axis[1]", 0.0, 1) && has(&s, "axis[3]", 0.0, 3) && at(&s, "axis[4]") == s.n);
  ROT_CHECK(at(&s, "resistance$damping_per_s") == s.n);
  ROT_CHECK(at(&s, "axis") == s.n && at(&s, "resistance") == s.n);
  ROT_CHECK(at(&s, "body$mass_kg") > at(&s, "body") && at(&s, "torque") > at(&s, "body$radius_m"));
  const size_t all = s.n;
  memset(&s, 0, sizeof s);
  s.stop = 3;
  rot_variants_walk(wheel, note, &s);
  ROT_CHECK(s.n == 3 && all > 12);
  rot_object_free(wheel);
}

static void numbers_of_lists_and_vectors(void) {
  static const double x[] = {2.0, 0.5, 1.0}, y[] = {0.25, 2.0, 1.0};
  rot_object *rotors = make_rotors(x), *box = make_box(y);
  seen s = {.stop = 0};
  rot_variants_walk(rotors, note, &s);
  ROT_CHECK(has(&s, "bodies[1]", 2.0, 0) && has(&s, "bodies[2]", NAN, 0));
  ROT_CHECK(has(&s, "bodies[2]$radius_m", 0.5, 0) && at(&s, "bodies[1]$radius_m") == s.n);
  ROT_CHECK(has(&s, "torque[1]", 1.0, 1) && has(&s, "torque[2]", 1.0, 2));
  ROT_CHECK(at(&s, "bodies") == s.n && at(&s, "torque") == s.n && at(&s, "torque[3]") == s.n);
  memset(&s, 0, sizeof s);
  rot_variants_walk(box, note, &s);
  /* An attitude that is not given is (1, 0, 0, 0). */
  ROT_CHECK(has(&s, "attitude0[1]", 1.0, 1) && has(&s, "attitude0[2]", 0.0, 2));
  ROT_CHECK(has(&s, "attitude0[4]", 0.0, 4) && has(&s, "omega0_rad_per_s[2]", 2.0, 2));
  rot_object_free(rotors);
  rot_object_free(box);
}

/* ---- refusals -------------------------------------------------------------------------------- */

/* => the place that is refused; 99: none is */
static size_t refused(const rot_object *scene, size_t n, const char *const paths[],
                      const char *words) {
  rot_variants *v = NULL;
  rot_refusal no = {0};
  const rot_status status = rot_variants_new(scene, n, paths, &v, &no);
  rot_variants_free(v);
  if (status == ROT_OK) return 99;
  ROT_CHECK(status == ROT_EVALUE && !v && strstr(no.reason, words) != NULL);
  return no.input;
}

static void paths_of_no_number(void) {
  static const double x[] = {2.0, 0.03, 1.0}, y[] = {2.0, 0.5, 1.0}, z[] = {0.5, 2.0, 0.1};
  static const char *const wrong[] = {"",
                                      "mass_kg",
                                      "body$mass",
                                      "body$",
                                      "$body",
                                      "body$mass_kg$x",
                                      "bodymass",
                                      "axis",
                                      "axis[0]",
                                      "axis[4]",
                                      "axis[01]",
                                      "axis[1",
                                      "axis[1]x",
                                      "axis[]",
                                      "axis[1]$x",
                                      "body[1]",
                                      "torque$x",
                                      "resistance",
                                      "resistance$damping_per_s",
                                      "omega0_rad_per_s[1]",
                                      "body$mass_kg[1]",
                                      "axis[-1]"};
  static const char *const wrong_item[] = {
      "bodies[0]",       "bodies[3]",          "bodies", "bodies[1]$radius_m",
      "bodies$radius_m", "bodies[2].radius_m", "torque", "torque[3]"};
  rot_object *wheel = make_wheel(x), *rotors = make_rotors(y), *knots = make_knots(z);
  for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
    const char *const paths[] = {"theta0_rad", wrong[i]};
    ROT_CHECK_EQ_INT(refused(wheel, 2, paths, "names no number that may vary"), 1);
  }
  for (size_t i = 0; i < sizeof wrong_item / sizeof *wrong_item; i++) {
    ROT_CHECK_EQ_INT(refused(rotors, 1, &wrong_item[i], "names no number that may vary"), 0);
  }
  const char *const good[] = {"axis[3]", "body$mass_kg"};
  ROT_CHECK_EQ_INT(refused(wheel, 2, good, ""), 99);
  const char *const table[] = {"torque$time_s[4]", "torque$torque_n_m[1]"};
  ROT_CHECK_EQ_INT(refused(knots, 2, table, ""), 99);
  char far[300] = "body$";
  memset(far + 5, 'x', sizeof far - 6);
  const char *const long_name[] = {far};
  ROT_CHECK_EQ_INT(refused(wheel, 1, long_name, "names no number"), 0);
  rot_object_free(wheel);
  rot_object_free(rotors);
  rot_object_free(knots);
}

static void paths_that_meet(void) {
  static const double x[] = {2.0, 0.03, 1.0}, y[] = {0.25, 2.0, 1.0};
  rot_object *wheel = make_wheel(x), *box = make_box(y);
  const char *const twice[] = {"theta0_rad", "body$mass_kg", "body$mass_kg"};
  ROT_CHECK_EQ_INT(refused(wheel, 3, twice, "are the same number"), 2);
  const char *const element[] = {"attitude0[2]", "attitude0[3]", "attitude0[2]"};
  ROT_CHECK_EQ_INT(refused(box, 3, element, "are the same number"), 2);
  ROT_CHECK_EQ_INT(refused(box, 2, element, ""), 99);
  /* A number in the place of a body of which a number varies, in either order. */
  const char *const below[] = {"body", "body$mass_kg"}, *const above[] = {"body$mass_kg", "body"};
  ROT_CHECK_EQ_INT(refused(wheel, 2, below, "takes the place of a part"), 0);
  ROT_CHECK_EQ_INT(refused(wheel, 2, above, "takes the place of a part"), 1);
  ROT_CHECK_EQ_INT(refused(wheel, 1, below, ""), 99);
  rot_object_free(wheel);
  rot_object_free(box);
}

/* Numbers that follow from others do not vary. */
static void derived_numbers(void) {
  static const char *const path[] = {"body$mass_kg"};
  rot_object *scene = of("scene_axle");
  rot_made made;
  size_t derived = 0;
  for (size_t i = 0; i < rot_compound_n_parts; i++) {
    if (!rot_compound_is_derived(&rot_compound_parts[i])) continue;
    rot_object *body = rot_object_new(rot_compound_parts[i].constructor);
    if (!body || !rot_object_made(rot_compound_parts[i].constructor, &made)) continue;
    if (rot_object_part(scene, "body", body) == ROT_SET_DONE) {
      seen s = {.stop = 0};
      rot_variants_walk(scene, note, &s);
      for (size_t k = 0; k < s.n; k++) ROT_CHECK(strncmp(s.path[k], "body$", 5) != 0);
      ROT_CHECK_EQ_INT(refused(scene, 1, path, "names no number that may vary"), 0);
      derived++;
    }
    rot_object_free(body);
  }
  ROT_CHECK(derived > 0);
  rot_object_free(scene);
}

static void no_scenes(void) {
  rot_object *body = disk(1.0, 1.0), *empty = of("scene_axle");
  ROT_CHECK_EQ_INT(refused(body, 0, NULL, "no scene"), 0);
  ROT_CHECK_EQ_INT(refused(NULL, 0, NULL, "no scene"), 0);
  const char *const path[] = {"theta0_rad"};
  ROT_CHECK_EQ_INT(refused(empty, 1, path, "missing"), 1); /* behind the paths: the scene */
  rot_object_free(body);
  rot_object_free(empty);
}

/* ---- scenes built ---------------------------------------------------------------------------- */

/* Theta at 1 s of a built scene. */
static double theta_of(const rot_object *object, const void *scene) {
  static const double times[] = {0.0, 1.0};
  const rot_task task = {.n = 2, .time_s = times, .accuracy = 1e-9, .max_steps = 10000};
  rot_outcome out;
  double memory[2 * ROT_MAX_COLUMNS] = {0.0};
  void *column[ROT_MAX_COLUMNS];
  for (size_t i = 0; i < ROT_MAX_COLUMNS; i++) column[i] = memory + 2 * i;
  const rot_rows want = {.column = column};
  memset(&out, 0, sizeof out);
  ROT_CHECK(rot_run(object->constraint, scene, NULL, &task, 0.0, &want, &out, NULL) ==
            ROT_RUN_DONE);
  rot_events_free(&out.events);
  return memory[1];
}

static double theta_anew(const double x[]) {
  rot_object *wheel = make_wheel(x);
  kit_run r = kit_run_of(wheel, NULL, 1e-9, 2, (const double[]){0.0, 1.0});
  const double theta = kit_cell(&r, 0, 1, 0);
  kit_free(&r);
  rot_object_free(wheel);
  return theta;
}

static void built_scenes(void) {
  static const double x[] = {2.0, 0.03, 1.0};
  static const char *const path[] = {"body$mass_kg", "resistance$viscous_n_m_s",
                                     "omega0_rad_per_s"};
  rot_object *wheel = make_wheel(x);
  rot_variants *v;
  rot_refusal no;
  const void *scene;
  ROT_CHECK(rot_variants_new(wheel, 3, path, &v, &no) == ROT_OK);
  ROT_CHECK(same_bits(theta_of(wheel, rot_variants_base(v)), theta_anew(x)));
  /* Without a number set, the scene itself. */
  ROT_CHECK(rot_variants_build(v, &scene, &no) == ROT_OK);
  ROT_CHECK(same_bits(theta_of(wheel, scene), theta_anew(x)));
  double y[] = {3.0, 0.03, 1.0};
  rot_variants_set(v, 0, 3.0);
  ROT_CHECK(rot_variants_build(v, &scene, &no) == ROT_OK);
  ROT_CHECK(same_bits(theta_of(wheel, scene), theta_anew(y)));
  y[2] = -4.0;
  rot_variants_set(v, 2, -4.0);
  ROT_CHECK(rot_variants_build(v, &scene, &no) == ROT_OK);
  ROT_CHECK(same_bits(theta_of(wheel, scene), theta_anew(y)));
  /* A refusal names part and input, the place is that of the scene's input; the next is sound. */
  rot_variants_set(v, 0, -0.5);
  ROT_CHECK(rot_variants_build(v, &scene, &no) == ROT_EVALUE);
  ROT_CHECK(strstr(no.reason, "in body_disk, `mass_kg`") != NULL);
  ROT_CHECK_EQ_INT(no.input, rot_input_named(wheel->n, wheel->inputs, "body"));
  rot_variants_set(v, 0, 3.0);
  rot_variants_set(v, 2, INFINITY);
  ROT_CHECK(rot_variants_build(v, &scene, &no) == ROT_EVALUE);
  ROT_CHECK_EQ_INT(no.input, rot_input_named(wheel->n, wheel->inputs, "omega0_rad_per_s"));
  rot_variants_set(v, 2, -4.0);
  ROT_CHECK(rot_variants_build(v, &scene, &no) == ROT_OK);
  ROT_CHECK(same_bits(theta_of(wheel, scene), theta_anew(y)));
  /* The object is as it was. */
  ROT_CHECK(same_bits(theta_anew(x), theta_of(wheel, rot_variants_base(v))) == 0);
  kit_run r = kit_run_of(wheel, NULL, 1e-9, 2, (const double[]){0.0, 1.0});
  ROT_CHECK(same_bits(kit_cell(&r, 0, 1, 0), theta_anew(x)));
  kit_free(&r);
  rot_variants_free(v);
  rot_variants_free(NULL);
  rot_object_free(wheel);
}

/* Inputs that a varying one bounds, and those of which an item varies, are checked with it. */
static void inputs_that_follow(void) {
  static const double x[] = {0.1, 20.0, 0.4}, y[] = {0.5, 0.2, 1.0};
  static const char *const friction[] = {"static_friction"}, *const item[] = {"bodies[1]"};
  rot_object *slope = make_slope(x), *rotors = make_rotors(y);
  rot_variants *v;
  rot_refusal no;
  const void *scene;
  put(slope, "kinetic_friction", 0.3);
  ROT_CHECK(rot_variants_new(slope, 1, friction, &v, &no) == ROT_OK);
  rot_variants_set(v, 0, 0.2);
  ROT_CHECK(rot_variants_build(v, &scene, &no) == ROT_EVALUE);
  ROT_CHECK(strstr(no.reason, "at most `static_friction`") != NULL);
  ROT_CHECK_EQ_INT(no.input, rot_input_named(slope->n, slope->inputs, "kinetic_friction"));
  rot_variants_set(v, 0, 0.3);
  ROT_CHECK(rot_variants_build(v, &scene, &no) == ROT_OK);
  rot_variants_free(v);
  ROT_CHECK(rot_variants_new(rotors, 1, item, &v, &no) == ROT_OK);
  rot_variants_set(v, 0, -1.0);
  ROT_CHECK(rot_variants_build(v, &scene, &no) == ROT_EVALUE);
  ROT_CHECK(strstr(no.reason, "item 1 must be greater than 0") != NULL);
  ROT_CHECK_EQ_INT(no.input, rot_input_named(rotors->n, rotors->inputs, "bodies"));
  rot_variants_set(v, 0, 0.7);
  ROT_CHECK(rot_variants_build(v, &scene, &no) == ROT_OK);
  rot_variants_free(v);
  rot_object_free(slope);
  rot_object_free(rotors);
}

int main(void) {
  numbers_of_a_wheel();
  numbers_of_lists_and_vectors();
  paths_of_no_number();
  paths_that_meet();
  derived_numbers();
  no_scenes();
  built_scenes();
  inputs_that_follow();
  return rot_test_report("variants");
}
