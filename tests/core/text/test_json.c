/* JSON: the grammar of RFC 8259, numbers bit for bit, damaged texts. */
#include "text/json.h"
#include "rot_test.h"

static int is_read(const char *text) {
  rot_json *tree = rot_json_read(text);
  rot_json_free(tree);
  return tree != NULL;
}

static void check_values(void) {
  rot_json *tree =
      rot_json_read(" {\"a\" : [1, -0.0, 2.5e-3, \"Inf\", \"-Inf\", \"NaN\"], \"b\\n\\u00e9"
                    "\\ud83d\\ude00\": null, \"c\": {}, \"d\": [], \"e\": true}\n");
  double x = 0.0;
  ROT_CHECK(tree && tree->kind == ROT_JSON_OBJECT && tree->n == 5);
  if (!tree) return;
  const rot_json *a = tree->first, *b = a->next, *c = b->next, *d = c->next, *e = d->next;
  ROT_CHECK(!strcmp(a->key, "a") && a->kind == ROT_JSON_ARRAY && a->n == 6);
  ROT_CHECK(rot_json_numbers(a) && !rot_json_numbers(d));
  const double want[] = {1.0, -0.0, 2.5e-3, INFINITY, -INFINITY, NAN};
  const rot_json *one = a->first;
  for (int i = 0; i < 6; i++, one = one->next) {
    ROT_CHECK(rot_json_number(one, &x));
    ROT_CHECK_ULP(x, want[i], 0);
    ROT_CHECK(!signbit(x) == !signbit(want[i]) || isnan(x));
  }
  ROT_CHECK(!one && !strcmp(b->key, "b\n\xc3\xa9\xf0\x9f\x98\x80") && b->kind == ROT_JSON_NULL);
  ROT_CHECK(c->kind == ROT_JSON_OBJECT && c->n == 0 && !c->first && d->n == 0);
  ROT_CHECK(e->kind == ROT_JSON_BOOLEAN && e->number == 1.0 && !e->next);
  ROT_CHECK(!rot_json_number(e, &x) && !rot_json_number(b, &x));
  rot_json_free(tree);
}

static void check_damage(void) {
  static const char *const wrong[] = {"",
                                      "{",
                                      "[1,]",
                                      "[1 2]",
                                      "{\"a\":1,}",
                                      "{\"a\" 1}",
                                      "{1:2}",
                                      "01",
                                      "1.",
                                      ".5",
                                      "+1",
                                      "1e",
                                      "0x10",
                                      "nul",
                                      "[1]x",
                                      "\"a",
                                      "\"\\x\"",
                                      "\"\\u12\"",
                                      "\"\\u0000\"",
                                      "\"\\udc00\"",
                                      "NaN",
                                      "{\"a\":1,\"a\":2}",
                                      "'a'",
                                      "[1}",
                                      "\"\x01\"",
                                      "-",
                                      "--1",
                                      "tru",
                                      "\"\\ud800x\""};
  for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) ROT_CHECK(!is_read(wrong[i]));
  static const char *const right[] = {"1", "-0", "1E5", "\"\"", "[]", " [ ] ", "false", "0.5e+3"};
  for (size_t i = 0; i < sizeof right / sizeof *right; i++) ROT_CHECK(is_read(right[i]));
  /* Deeper than any scene. */
  char deep[201];
  memset(deep, '[', 100), memset(deep + 100, ']', 100), deep[200] = 0;
  ROT_CHECK(!is_read(deep));
  memset(deep, '[', 30), memset(deep + 30, ']', 30), deep[60] = 0;
  ROT_CHECK(is_read(deep));
}

int main(void) {
  check_values();
  check_damage();
  return rot_test_report("json");
}
