/* R code of scenes: what stands in it, how it is laid out, what has none. */
#include "text/scene_code.h"
#include "rot_test.h"

static char *code_of(const char *text, char to[4096]) {
  rot_json *tree = rot_json_read(text);
  rot_writer code = {0};
  const int fine = rot_scene_code(tree, &code);
  ROT_CHECK(tree != NULL);
  (void)snprintf(to, 4096, "%s", fine ? code.text : code.text && code.text[0] ? "left" : "none");
  free(code.text);
  rot_json_free(tree);
  return to;
}

#define EXPECT(text, want)                                                                         \
  do {                                                                                             \
    char code_[4096];                                                                              \
    const int same_ = !strcmp(code_of(text, code_), want);                                         \
    ROT_CHECK(same_);                                                                              \
    if (!same_) puts(code_);                                                                       \
  } while (0)

static void check_code(void) {
  /* Rows of as many numbers are a matrix, others a list. */
  EXPECT("{\"scene_chain\": {\"links\": [[1, 2], [3, \"-Inf\"]]}}",
         "scene_chain(links = rbind(c(1, 2), c(3, -Inf)))");
  EXPECT("{\"scene_chain\": {\"links\": [[1, null], [2, 3]]}}",
         "scene_chain(links = list(list(1, NULL), c(2, 3)))");
  EXPECT("{\"scene_format\": 1, \"scene_axle\": {\"body\": 0.1, \"torque\": -2.5e-7}}",
         "scene_axle(body = 0.1, torque = -2.5e-07)");
  EXPECT("{\"body_disk\": {\"mass_kg\": 2, \"radius_m\": 0.25}}",
         "body_disk(mass_kg = 2, radius_m = 0.25)");
  /* An input of one kind of part needs no name of a constructor; infinite numbers. */
  EXPECT("{\"scene_incline\": {\"body\": {\"body_sphere\": {\"mass_kg\": 1, \"radius_m\": 0.1}},"
         " \"incline_angle_deg\": 20, \"static_friction\": \"Inf\","
         " \"resistance\": {\"drag_n_s_per_m\": 0.1}}}",
         "scene_incline(\n  body = body_sphere(mass_kg = 1, radius_m = 0.1),\n"
         "  incline_angle_deg = 20,\n  static_friction = Inf,\n"
         "  resistance = resistance(drag_n_s_per_m = 0.1)\n)");
  /* Sums of laws, empty places, vectors and matrices. */
  EXPECT("{\"scene_drive\": {\"bodies\": [1, 2], \"torque\": [null, {\"torque_sum\": {\"laws\":"
         " [{\"torque_spring\": {\"stiffness_n_m_per_rad\": 2}}, 3]}}]}}",
         "scene_drive(\n  bodies = c(1, 2),\n  torque = list(\n    NULL,\n"
         "    torque_spring(stiffness_n_m_per_rad = 2) + torque_constant(3)\n  )\n)");
  /* Steps are kept as knots; others that differ outside have no constructor. */
  EXPECT(
      "{\"scene_axle\": {\"body\": 1, \"torque\": {\"torque_knots\": {\"time_s\": [1, 2, 2, 3, 3],"
      " \"torque_n_m\": [4, 4, 5, 5, 6], \"outside\": [0, 6]}}}}",
      "scene_axle(\n  body = 1,\n"
      "  torque = torque_steps(time_s = c(1, 2, 3), torque_n_m = c(4, 5, 6))\n)");
  EXPECT("{\"torque_knots\": {\"time_s\": [1, 2, 2], \"torque_n_m\": [4, 4, 5],"
         " \"outside\": [1, 5]}}",
         "none");
  EXPECT("{\"torque_knots\": {\"time_s\": [1, 2, 2], \"torque_n_m\": [4, 3, 5],"
         " \"outside\": [0, 5]}}",
         "none");
  EXPECT("{\"torque_knots\": {\"time_s\": [1, 2, 3], \"torque_n_m\": [4, 4, 5],"
         " \"outside\": [0, 5]}}",
         "none");
  EXPECT(
      "{\"torque_polynomial\": {\"breaks_s\": [0, 1, 2], \"coefficients\": [[1, 2], [0, 1]]}}",
      "torque_polynomial(\n  breaks_s = c(0, 1, 2),\n  coefficients = rbind(c(1, 2), c(0, 1))\n)");
  EXPECT("{\"scene_free\": {\"body\": [1, 2, 3], \"omega0_rad_per_s\": [1, 0, 0],"
         " \"torque\": {\"time_s\": [0, 1], \"x_n_m\": [0, 1]}}}",
         "scene_free(\n  body = c(1, 2, 3),\n  omega0_rad_per_s = c(1, 0, 0),\n"
         "  torque = data.frame(time_s = c(0, 1), x_n_m = c(0, 1))\n)");
  EXPECT("{\"torque_term\": {\"kind\": \"spring\", \"x\": [-2, 0.5], \"text\": \"\"}}",
         "-torque_spring(stiffness_n_m_per_rad = 2, rest_rad = 0.5)");
  EXPECT("{\"torque_term\": {\"kind\": \"spring\", \"x\": [2, 0.5], \"text\": \"\"}}", "none");
  EXPECT("{\"torque_term\": {\"kind\": \"curve\", \"x\": [-2, 0.5], \"text\": \"\"}}", "none");
  EXPECT("{\"body_tensor\": {\"mass_kg\": 1, \"inertia_kg_m2\": [1, 1, 1], \"name\": \"a "
         "\\\"b\\\\\"}}",
         "body_tensor(mass_kg = 1, inertia_kg_m2 = c(1, 1, 1), name = \"a \\\"b\\\\\")");
}

/* 16 digits that strtod() reads back, but that long doubles of 64 bits round to the middle of two
 * doubles; those of other numbers do not grow. */
static void check_literals(void) {
  EXPECT("{\"scene_axle\": {\"body\": 3.645301013417239}}",
         "scene_axle(body = 3.6453010134172392)");
  EXPECT("{\"scene_axle\": {\"body\": 1, \"torque\": [0.1, 1e22, 1e-22, 6.674e-11, 6.02214076e23,"
         " 123456789012345, 2.5e-7, 5e-324, 1.7976931348623157e308, 0.3333333333333333, -0.7]}}",
         "scene_axle(\n  body = 1,\n  torque = c(\n"
         "    0.1, 1e+22, 1e-22, 6.674e-11, 6.02214076e+23, 123456789012345, 2.5e-07,\n"
         "    4.94065645841247e-324, 1.7976931348623157e+308, 0.3333333333333333,\n"
         "    -0.7\n  )\n)");
}

static void check_without_code(void) {
  EXPECT("{\"scene_format\": 2, \"scene_axle\": {\"body\": 1}}", "none");
  EXPECT("{\"scene_orbit\": {\"body\": 1}}", "none");
  EXPECT("{\"scene_axle\": {\"body\": {\"rot_body\": {\"mass_kg\": 1}}}}", "none");
  EXPECT("{\"rot_body\": {\"mass_kg\": 1}}", "none");
  EXPECT("{\"scene_axle\": {\"body\": {\"odd\": 1, \"two\": 2}}}", "none");
  EXPECT("{\"scene_axle\": {\"body\": 1}, \"scene_free\": {}}", "none");
  EXPECT("{\"torque_knots\": {\"time_s\": [0, 1], \"torque_n_m\": [1, 2], \"outside\": [0, 1]}}",
         "none");
  EXPECT("[1]", "none");
  EXPECT("{}", "none");
  EXPECT("{\"scene_axle\": 3}", "none");
}

/* Many numbers fill the lines; the time of nested bodies does not double with each. */
static void check_long(void) {
  enum { MANY = 20000 };
  rot_writer text = {0}, code = {0};
  rot_write(&text, "{\"torque_knots\": {\"time_s\": [0");
  for (int i = 1; i < MANY; i++) rot_write(&text, ",%d", i);
  rot_write(&text, "], \"torque_n_m\": [0");
  for (int i = 1; i < MANY; i++) rot_write(&text, ",0.5");
  rot_write(&text, "]}}");
  rot_json *tree = rot_json_read(text.text);
  ROT_CHECK(rot_scene_code(tree, &code));
  size_t longest = 0, lines = 1, from = 0;
  for (size_t i = 0; i < code.length; i++) {
    if (code.text[i] != '\n') continue;
    longest = i - from > longest ? i - from : longest;
    from = i;
    lines++;
  }
  ROT_CHECK(longest < 85 && lines < MANY / 4);
  rot_json_free(tree);
  text.length = code.length = 0;
  for (int i = 0; i < 18; i++) rot_write(&text, "{\"place_body\":{\"body\":");
  rot_write(&text, "{\"body_hoop\":{\"mass_kg\":1,\"radius_m\":1}}");
  for (int i = 0; i < 18; i++) rot_write(&text, ",\"at_m\":[0,0,1]}}");
  tree = rot_json_read(text.text);
  ROT_CHECK(rot_scene_code(tree, &code) && code.length < 5000);
  rot_json_free(tree);
  free(text.text);
  free(code.text);
}

/* What grows: strings and numbers as JSON. */
static void check_writer(void) {
  rot_writer to = {0};
  rot_write_string(&to, "a\"\\\n\xc3\xa9");
  rot_write_string(&to, NULL);
  const double x[] = {0.1, -0.0, 1e22, INFINITY, -INFINITY, NAN, 5e-324};
  for (int i = 0; i < 7; i++) {
    rot_write(&to, "%s", " ");
    rot_write_number(&to, x[i]);
  }
  ROT_CHECK(!strcmp(to.text, "\"a\\\"\\\\\\n\xc3\xa9\"null 0.1 -0.0 1e+22 1e999 -1e999 null "
                             "4.94065645841247e-324"));
  ROT_CHECK(to.length == strlen(to.text) && !to.failed && to.room > to.length);
  free(to.text);
}

int main(void) {
  check_code();
  check_literals();
  check_without_code();
  check_long();
  check_writer();
  return rot_test_report("scene_code");
}
