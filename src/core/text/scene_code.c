#include "text/scene_code.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "ground/text.h"
#include "object/object.h"

const rot_json *rot_scene_member(const rot_json *tree) {
  const rot_json *scene = NULL;
  if (!tree || tree->kind != ROT_JSON_OBJECT) return NULL;
  for (const rot_json *one = tree->first; one; one = one->next) {
    if (strcmp(one->key, "scene_format") == 0) {
      if (one->kind != ROT_JSON_NUMBER || one->number != 1.0) return NULL;
    } else if (scene) {
      return NULL;
    } else {
      scene = one;
    }
  }
  return scene;
}

const char *rot_scene_part(const rot_json *node, const char *input, const rot_json **arguments) {
  rot_made made;
  if (node->n == 1 && rot_object_made(node->first->key, &made)) {
    *arguments = node->first;
    return node->first->key;
  }
  *arguments = node;
  return input;
}

static void indent(rot_writer *to, int level) { rot_write(to, "\n%*s", 2 * level, ""); }

/* Room in a line; 0: the code may take several. */
typedef size_t line_end;
typedef enum made { NO_CODE, CODE, TOO_LONG } made;

static made code_of(const rot_json *node, const char *name, int level, line_end end,
                    rot_writer *to);

/* `items`: the input whose items the arguments without names are. */
static made write_call(const char *function, const rot_json *arguments, const char *items,
                       int level, line_end end, rot_writer *to) {
  rot_write(to, "%s(", function);
  for (const rot_json *one = arguments->first; one; one = one->next) {
    if (!end) indent(to, level + 1);
    if (one->key) rot_write(to, "%s = ", one->key);
    const made done = code_of(one, one->key ? one->key : items, level + 1, end, to);
    if (done != CODE) return done;
    if (one->next) rot_write(to, end ? ", " : ",");
  }
  if (!end) indent(to, level);
  rot_write(to, ")");
  if (to->failed) return NO_CODE;
  return end && to->length > end ? TOO_LONG : CODE;
}

/* A call in one line where it is short, else an argument a line. */
static made code_of_call(const char *function, const rot_json *arguments, const char *items,
                         int level, line_end end, rot_writer *to) {
  const size_t from = to->length, used = 2 * (size_t)level, room = used < 64 ? 72 - used : 8;
  const made short_one = write_call(function, arguments, items, level, end ? end : from + room, to);
  if (short_one != TOO_LONG || end) return short_one;
  to->length = from;
  return write_call(function, arguments, items, level, 0, to);
}

static made code_of_text(const char *text, rot_writer *to) {
  rot_write(to, "\"");
  for (; *text; text++) {
    if ((unsigned char)*text < 0x20) return NO_CODE;
    rot_write(to, *text == '"' || *text == '\\' ? "\\%c" : "%c", *text);
  }
  rot_write(to, "\"");
  return CODE;
}

/* Laws are added by `+`; one of them must be a law. */
static made code_of_sum(const rot_json *laws, int level, line_end end, rot_writer *to) {
  if (!laws || laws->kind != ROT_JSON_ARRAY || laws->n == 0) return NO_CODE;
  for (const rot_json *one = laws->first; one; one = one->next) {
    const int number = one->kind == ROT_JSON_NUMBER;
    if (number) rot_write(to, "torque_constant(");
    const made done = code_of(one, "torque", level, end, to);
    if (done != CODE) return done;
    rot_write(to, "%s%s", number ? ")" : "", one->next ? " + " : "");
  }
  return CODE;
}

static const rot_json *argument(const rot_json *arguments, const char *key) {
  for (const rot_json *one = arguments->first; one; one = one->next) {
    if (!strcmp(one->key, key)) return one;
  }
  return NULL;
}

static double number_of(const rot_json *node) {
  double x = NAN;
  (void)rot_json_number(node, &x);
  return x;
}

/* A literal of up to 16 digits => does R's parser read x? It scales the digits in long doubles of
 * 64 bits, with one rounding up to 10^27 and less than 33 beyond, and rounds again: it may read a
 * neighbour of x where the middle between the two is that close. */
static int reads_alike(const char *literal, double x) {
  unsigned long long digits = 0;
  int power = 0, decimal = 0;
  for (; *literal && *literal != 'e'; literal++) {
    if (*literal == '.') decimal = 1;
    if (*literal < '0' || *literal > '9') continue;
    digits = 10 * digits + (unsigned)(*literal - '0');
    power -= decimal;
  }
  if (*literal) power += atoi(literal + 1);
  const int exact = abs(power) <= 27;
  for (; digits < 1000000000000000; digits *= 10) power--; /* to 16 of them */
  for (int side = 0; side < 2; side++) {
    /* Moved by 6e-19 or 2e-17 in units of the first digit: more than 1 and 33 times 10 x 2^-64. */
    const char *tail = exact ? side ? "9994" : "0006" : side ? "8" : "2";
    char moved[2 * ROT_TEXT_SIZE];
    snprintf(moved, sizeof moved, "%llu%se%d", digits - (unsigned)side, tail,
             power - (int)strlen(tail));
    if (strtod(moved, NULL) != fabs(x)) return 0;
  }
  return 1;
}

static void write_literal(double x, rot_writer *to) {
  char literal[ROT_TEXT_SIZE];
  for (int digits = 15; digits <= 17; digits++) {
    (void)rot_text_digits(x, digits, literal);
    if (x == 0.0 || !isfinite(x) || digits == 17 || reads_alike(literal, x)) break;
  }
  rot_write(to, "%s", literal);
}

/* The first, third, ... of the numbers, in the room given. */
static rot_json every_other(const rot_json *numbers, rot_json room[]) {
  rot_json out = *numbers;
  size_t n = 0;
  for (const rot_json *one = numbers->first; one; one = one->next ? one->next->next : NULL) {
    if (n) room[n - 1].next = &room[n];
    room[n] = *one;
    room[n++].next = NULL;
  }
  out.first = room;
  out.n = n;
  return out;
}

/* Knots that hold each torque to the next jump, from 0 before the first to the last one after. */
static int are_steps(const rot_json *time, const rot_json *torque, const rot_json *outside) {
  if (!rot_json_numbers(time) || !rot_json_numbers(torque) || !rot_json_numbers(outside)) return 0;
  if (outside->n != 2 || time->n != torque->n || time->n % 2 == 0) return 0;
  const double before = number_of(outside->first), after = number_of(outside->first->next);
  if (before != 0.0 || signbit(before)) return 0;
  const rot_json *t = time->first, *x = torque->first;
  for (; t->next; t = t->next->next, x = x->next->next) {
    if (number_of(t->next) != number_of(t->next->next)) return 0;
    if (number_of(x) != number_of(x->next)) return 0;
  }
  return number_of(x) == after;
}

/* A number alone as an array of one. */
static rot_json as_numbers(const rot_json *node, rot_json *one) {
  rot_json out = *node;
  if (node->kind == ROT_JSON_ARRAY) return out;
  *one = *node;
  one->next = NULL;
  out.kind = ROT_JSON_ARRAY;
  out.first = one;
  out.n = 1;
  return out;
}

/* Laws keep what is outside of them as two numbers, for which torque_knots() has words. */
static made code_of_outside(const rot_json *arguments, const rot_json *outside, int level,
                            line_end end, rot_writer *to) {
  const rot_json *times = argument(arguments, "time_s");
  const rot_json *torques = argument(arguments, "torque_n_m");
  if (!times || !torques) return NO_CODE;
  rot_json alone[2];
  const rot_json time = as_numbers(times, &alone[0]), torque = as_numbers(torques, &alone[1]);
  if (!are_steps(&time, &torque, outside)) return NO_CODE;
  rot_json *room = malloc(2 * time.n * sizeof *room);
  if (!room) return NO_CODE;
  rot_json input[2] = {every_other(&time, room), every_other(&torque, room + time.n)};
  rot_json steps = *arguments;
  steps.first = input;
  steps.n = 2;
  input[0].next = &input[1];
  input[1].next = NULL;
  const made done = code_of_call("torque_steps", &steps, "", level, end, to);
  free(room);
  return done;
}

/* A spring multiplied by less than 0, which its constructor does not take. */
static made code_of_term(const rot_json *term, rot_writer *to) {
  const rot_json *kind = argument(term, "kind"), *x = argument(term, "x");
  if (!kind || kind->kind != ROT_JSON_STRING || strcmp(kind->text, "spring") != 0) return NO_CODE;
  if (!x || !rot_json_numbers(x) || x->n != 2 || !(number_of(x->first) < 0.0)) return NO_CODE;
  rot_write(to, "-torque_spring(stiffness_n_m_per_rad = ");
  write_literal(-number_of(x->first), to);
  rot_write(to, ", rest_rad = ");
  write_literal(number_of(x->first->next), to);
  rot_write(to, ")");
  return CODE;
}

static made code_of_made(const char *constructor, const rot_json *arguments, int level,
                         line_end end, rot_writer *to) {
  rot_made m;
  if (!rot_object_made(constructor, &m) || arguments->kind != ROT_JSON_OBJECT) return NO_CODE;
  if (strcmp(constructor, "torque_sum") == 0) return code_of_sum(arguments->first, level, end, to);
  const unsigned makes = m.part ? m.part->makes : 0;
  if (makes == ROT_INPUT_TABLE) return code_of_call("data.frame", arguments, "", level, end, to);
  /* Those are no functions of R. */
  if (makes & (ROT_INPUT_MOMENTS | ROT_INPUT_SIZES | ROT_INPUT_POINTS)) return NO_CODE;
  if (strncmp(constructor, "rot_", 4) == 0) return NO_CODE;
  if (strcmp(constructor, "torque_term") == 0) return code_of_term(arguments, to);
  const rot_json *outside = argument(arguments, "outside");
  if (outside && outside->kind == ROT_JSON_ARRAY) {
    return code_of_outside(arguments, outside, level, end, to);
  }
  return code_of_call(constructor, arguments, "", level, end, to);
}

/* Many numbers fill the lines. */
static made code_of_numbers(const rot_json *numbers, int level, line_end end, rot_writer *to) {
  const size_t from = to->length;
  const made done = code_of_call("c", numbers, "", level, end ? end : from + 72, to);
  if (done != TOO_LONG || end) return done;
  to->length = from;
  rot_write(to, "c(");
  indent(to, level + 1);
  size_t line = to->length;
  for (const rot_json *one = numbers->first; one; one = one->next) {
    if (to->length - line > 64) {
      indent(to, level + 1);
      line = to->length;
    }
    (void)code_of(one, "", level, 0, to);
    if (one->next) rot_write(to, to->length - line > 64 ? "," : ", ");
  }
  indent(to, level);
  rot_write(to, ")");
  return CODE;
}

/* Rows of as many numbers. */
static int is_matrix(const rot_json *array) {
  for (const rot_json *one = array->first; one; one = one->next) {
    if (one->kind != ROT_JSON_ARRAY || !rot_json_numbers(one) || one->n != array->first->n) {
      return 0;
    }
  }
  return array->n > 1;
}

static made code_of(const rot_json *node, const char *name, int level, line_end end,
                    rot_writer *to) {
  const rot_json *arguments;
  double x;
  if (end && to->length > end) return TOO_LONG;
  if (rot_json_number(node, &x)) {
    write_literal(x, to);
    return CODE;
  }
  switch (node->kind) {
  case ROT_JSON_NULL: rot_write(to, "NULL"); return CODE;
  case ROT_JSON_BOOLEAN: rot_write(to, node->number != 0.0 ? "TRUE" : "FALSE"); return CODE;
  case ROT_JSON_STRING: return code_of_text(node->text, to);
  case ROT_JSON_OBJECT:
    name = rot_scene_part(node, name, &arguments);
    return code_of_made(name, arguments, level, end, to);
  default: break;
  }
  if (!node->first) { /* such as the ratios of one body */
    rot_write(to, "numeric()");
    return CODE;
  }
  if (rot_json_numbers(node)) return code_of_numbers(node, level, end, to);
  if (is_matrix(node)) return code_of_call("rbind", node, "", level, end, to);
  return code_of_call("list", node, name, level, end, to);
}

int rot_scene_code(const rot_json *tree, rot_writer *to) {
  const rot_json *scene = rot_scene_member(tree);
  if (!scene) return 0;
  const size_t from = to->length;
  const int fine = code_of_made(scene->key, scene, 0, 0, to) == CODE && !to->failed;
  if (!fine && to->text) {
    to->length = from;
    to->text[from] = '\0';
  }
  return fine;
}
