#include "object/object.h"

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "scene/parts.h"
#include "scene/run.h"

enum { MAX_DEPTH = 16 }; /* of objects in objects */

/* ---- the tables ------------------------------------------------------------------------------ */

int rot_object_made(const char *constructor, rot_made *to) {
  memset(to, 0, sizeof *to);
  if (!constructor) return 0;
  to->maker = rot_run_maker(constructor, &to->constraint);
  if (to->maker) {
    to->inputs = to->maker->inputs;
    to->n_inputs = to->maker->n_inputs;
    return 1;
  }
  to->part = rot_part_named(constructor);
  if (!to->part) return 0;
  to->inputs = to->part->inputs;
  to->n_inputs = to->part->n_inputs;
  return 1;
}

/* ---- objects --------------------------------------------------------------------------------- */

rot_object *rot_object_new(const char *constructor) {
  rot_made m;
  const int known = rot_object_made(constructor, &m);
  if (!known && !(constructor && !strcmp(constructor, "list"))) return NULL;
  rot_object *object = calloc(1, sizeof *object);
  if (!object) return NULL;
  object->constraint = m.constraint;
  object->maker = m.maker;
  object->part = m.part;
  object->inputs = m.inputs;
  object->n = object->room = m.n_inputs;
  object->values = calloc(object->n + 1, sizeof *object->values);
  if (object->values) return object;
  free(object);
  return NULL;
}

static void forget(rot_value *v) {
  free(v->numbers);
  rot_object_free(v->object);
  memset(v, 0, sizeof *v);
}

void rot_object_free(rot_object *object) {
  if (!object) return;
  for (size_t i = 0; i < object->n; i++) forget(&object->values[i]);
  free(object->values);
  free(object);
}

static double *copy_numbers(size_t n, const double x[]) {
  if (n >= SIZE_MAX / sizeof *x) return NULL;
  double *copy = malloc((n + 1) * sizeof *copy);
  if (copy && n) memcpy(copy, x, n * sizeof *copy);
  return copy;
}

/* => deep copy; NULL: no memory */
static rot_object *copy_object(const rot_object *from) {
  rot_object *to = calloc(1, sizeof *to);
  if (!to) return NULL;
  *to = *from;
  to->room = from->n;
  to->values = calloc(from->n + 1, sizeof *to->values);
  int ok = to->values != NULL;
  for (size_t i = 0; i < from->n && ok; i++) {
    const rot_value *v = &from->values[i];
    rot_value *w = &to->values[i];
    *w = *v;
    w->numbers = v->numbers ? copy_numbers(v->n, v->numbers) : NULL;
    w->object = v->object ? copy_object(v->object) : NULL;
    ok = (!v->numbers || w->numbers) && (!v->object || w->object);
  }
  if (ok) return to;
  if (!to->values) to->n = 0;
  rot_object_free(to);
  return NULL;
}

/* ---- setting --------------------------------------------------------------------------------- */

/* Kinds of items of a list, whose input is not known yet. */
enum {
  IN_A_LIST = ROT_ONE_NUMBER | ROT_MANY_NUMBERS | ROT_INPUT_LAW | ROT_INPUT_LIST | ROT_INPUT_OBJECTS
};

/* name => kinds of the input, index of its value. For a list (name NULL): index of a new item. */
static rot_set find(rot_object *object, const char *name, unsigned *kinds, size_t *at) {
  if (!object || (name == NULL) != rot_object_is_list(object)) return ROT_SET_NOT_TAKEN;
  if (!name) {
    *kinds = IN_A_LIST;
    *at = object->n;
    return ROT_SET_DONE;
  }
  *at = rot_input_named(object->n, object->inputs, name);
  if (*at == object->n) return ROT_SET_NO_NAME;
  *kinds = object->inputs[*at].kinds;
  return ROT_SET_DONE;
}

/* Sets value `at`; the object takes ownership of `v`. */
static rot_set put(rot_object *object, size_t at, rot_value v) {
  if (at == object->n && at == object->room) {
    const size_t room = 2 * object->room + 4;
    rot_value *more = room < SIZE_MAX / sizeof *more
                          ? realloc(object->values, room * sizeof *object->values)
                          : NULL;
    if (!more) {
      forget(&v);
      return ROT_SET_NO_MEMORY;
    }
    object->values = more;
    object->room = room;
  }
  if (at == object->n) {
    memset(&object->values[object->n++], 0, sizeof v);
  }
  forget(&object->values[at]);
  object->values[at] = v;
  return ROT_SET_DONE;
}

rot_set rot_object_unset(rot_object *object, const char *input) {
  unsigned kinds;
  size_t at;
  const rot_set status = find(object, input, &kinds, &at);
  return (status == ROT_SET_DONE ? put(object, at, (rot_value){.is = ROT_VALUE_UNSET}) : status);
}

rot_set rot_object_number(rot_object *object, const char *input, double number) {
  unsigned kinds;
  size_t at;
  const rot_set status = find(object, input, &kinds, &at);
  if (status != ROT_SET_DONE) return status;
  if (!(kinds & (ROT_ONE_NUMBER | ROT_INPUT_NUMBERS))) return ROT_SET_NOT_TAKEN;
  return put(object, at, (rot_value){.is = ROT_VALUE_NUMBER, .number = number});
}

rot_set rot_object_numbers(rot_object *object, const char *input, size_t n, const double *values) {
  unsigned kinds;
  size_t at;
  const rot_set status = find(object, input, &kinds, &at);
  if (status != ROT_SET_DONE) return status;
  const int as_list = kinds & ROT_INPUT_LIST && kinds & ROT_INPUT_NUMBER;
  if (!(kinds & ROT_MANY_NUMBERS || as_list) || (n && !values)) return ROT_SET_NOT_TAKEN;
  double *copy = copy_numbers(n, values);
  if (!copy) return ROT_SET_NO_MEMORY;
  return put(object, at, (rot_value){.is = ROT_VALUE_NUMBERS, .n = n, .numbers = copy});
}

rot_set rot_object_text(rot_object *object, const char *input, const char *text) {
  unsigned kinds;
  size_t at;
  int place = 0;
  const rot_set status = find(object, input, &kinds, &at);
  if (status != ROT_SET_DONE) return status;
  if (!text) return ROT_SET_NOT_TAKEN;
  if (!(kinds & (ROT_INPUT_CHOICE | ROT_INPUT_TEXT))) return ROT_SET_NOT_TAKEN;
  const char *const *options = kinds & ROT_INPUT_CHOICE ? object->inputs[at].options : NULL;
  while (options && options[place] && strcmp(options[place], text)) place++;
  if (!options || !options[place]) {
    if (!(kinds & ROT_INPUT_TEXT)) return ROT_SET_NOT_TAKEN;
    return put(object, at, (rot_value){.is = ROT_VALUE_TEXT});
  }
  return put(object, at, (rot_value){.is = ROT_VALUE_OPTION, .option = place});
}

/* list => its items as an array, if all are numbers; else NULL */
static double *numbers_of_list(const rot_object *list) {
  for (size_t i = 0; i < list->n; i++) {
    if (list->values[i].is != ROT_VALUE_NUMBER) return NULL;
  }
  double *x = malloc((list->n + 1) * sizeof *x);
  for (size_t i = 0; i < list->n && x; i++) x[i] = list->values[i].number;
  return x;
}

rot_set rot_object_part(rot_object *object, const char *input, const rot_object *from) {
  unsigned kinds;
  size_t at;
  const rot_set status = find(object, input, &kinds, &at);
  if (status != ROT_SET_DONE) return status;
  if (!from || from->constraint || from->depth + 1 > MAX_DEPTH) return ROT_SET_NOT_TAKEN;
  if (from->part && !(kinds & from->part->makes)) return ROT_SET_NOT_TAKEN;
  if (rot_object_is_list(from)) {
    double *x = kinds & ROT_MANY_NUMBERS ? numbers_of_list(from) : NULL;
    if (x) return put(object, at, (rot_value){.is = ROT_VALUE_NUMBERS, .n = from->n, .numbers = x});
    if (!(kinds & ROT_INPUT_LIST)) return ROT_SET_NOT_TAKEN;
  }
  rot_object *copy = copy_object(from);
  if (!copy) return ROT_SET_NO_MEMORY;
  if (object->depth < from->depth + 1) object->depth = from->depth + 1;
  return put(object, at, (rot_value){.is = ROT_VALUE_OBJECT, .object = copy});
}

rot_set rot_object_law(rot_object *object, const char *input, rot_caller_law law) {
  unsigned kinds;
  size_t at;
  const rot_set status = find(object, input, &kinds, &at);
  if (status != ROT_SET_DONE) return status;
  if (!law.call || !(kinds & ROT_INPUT_LAW)) return ROT_SET_NOT_TAKEN;
  return put(object, at, (rot_value){.is = ROT_VALUE_LAW, .law = law});
}

/* ---- values => inputs of the builders -------------------------------------------------------- */

static rot_status call_law(const double argument[], double result[], void *ctx) {
  const rot_caller_law *law = ctx;
  return law->call(argument, result, law->context) ? ROT_EUNWIND : ROT_OK;
}

static rot_status give_list(const rot_object *list, const rot_input *input, size_t at,
                            rot_store *store, rot_given *to, rot_refusal *no) {
  rot_given *item = rot_store_get(store, list->n, sizeof *item);
  if (!item) return ROT_ENOMEM;
  *to = (rot_given){.is = ROT_INPUT_LIST, .n = list->n, .item = item};
  for (size_t i = 0; i < list->n; i++) {
    const rot_status status = rot_object_give(&list->values[i], input, at, store, &item[i], no);
    if (status == ROT_EVALUE) rot_refused_in(no, "in item %zu,", i + 1);
    if (status != ROT_OK) return status;
  }
  return ROT_OK;
}

/* numbers => list of single numbers */
static rot_status give_each(const rot_value *v, rot_store *store, rot_given *to) {
  rot_given *item = rot_store_get(store, v->n, sizeof *item);
  if (!item) return ROT_ENOMEM;
  for (size_t i = 0; i < v->n; i++) {
    item[i] = (rot_given){.is = ROT_INPUT_NUMBER, .n = 1, .x = &v->numbers[i]};
  }
  *to = (rot_given){.is = ROT_INPUT_LIST, .n = v->n, .item = item};
  return ROT_OK;
}

/* object => part, checked and built */
static rot_status give_part(const rot_object *object, size_t at, rot_store *store, rot_given *to,
                            rot_refusal *no) {
  const rot_part *part = object->part;
  rot_given *given;
  void *built = rot_store_get(store, 1, part->size);
  if (!built) return ROT_ENOMEM;
  rot_status status = rot_object_given(object, store, &given, no);
  if (status == ROT_OK) status = part->build(part, given, store, built, no);
  if (status == ROT_EVALUE) {
    rot_refused_in(no, "in %s, `%s`", part->constructor, part->inputs[no->input].name);
    no->input = at;
  }
  if (status != ROT_OK) return status;
  *to = (rot_given){.is = part->makes, .n = 1, .object = built};
  if (part->makes == ROT_INPUT_BODY) to->body = *(const rot_given_body *)built;
  return ROT_OK;
}

/* => first of these kinds that the input accepts, 0 if none */
static unsigned first_of(const rot_input *input, unsigned kinds) {
  const unsigned both = input->kinds & kinds;
  return both & (~both + 1u);
}

/* => kind as which an input accepts n numbers. If it accepts any count, a vector must have 3 and a
 * quaternion 4. */
unsigned rot_object_kind_of(const rot_input *input, size_t n) {
  unsigned kinds = input->kinds & ROT_MANY_NUMBERS;
  if (kinds & ROT_INPUT_NUMBERS && n != 3) kinds &= ~(unsigned)ROT_INPUT_VECTOR;
  if (kinds & ROT_INPUT_NUMBERS && n != 4) kinds &= ~(unsigned)ROT_INPUT_ATTITUDE;
  return kinds & (~kinds + 1u);
}

/* value of input `at` => as the builders read it; ROT_EVALUE: refused */
rot_status rot_object_give(const rot_value *v, const rot_input *input, size_t at, rot_store *store,
                           rot_given *to, rot_refusal *no) {
  unsigned kind;
  switch (v->is) {
  case ROT_VALUE_NUMBER:
    kind = first_of(input, ROT_ONE_NUMBER);
    if (!kind) kind = first_of(input, ROT_INPUT_NUMBERS);
    *to = (rot_given){.is = kind, .n = 1, .x = &v->number};
    break;
  case ROT_VALUE_NUMBERS:
    kind = rot_object_kind_of(input, v->n);
    if (!kind) return give_each(v, store, to);
    *to = (rot_given){.is = kind, .n = v->n, .x = v->numbers};
    break;
  case ROT_VALUE_OPTION: *to = (rot_given){.is = ROT_INPUT_CHOICE, .option = v->option}; break;
  case ROT_VALUE_TEXT: *to = (rot_given){.is = ROT_INPUT_TEXT}; break;
  case ROT_VALUE_LAW: {
    rot_caller_law *law = rot_store_get(store, 1, sizeof *law);
    if (!law) return ROT_ENOMEM;
    *law = v->law;
    *to = (rot_given){.is = ROT_INPUT_LAW, .law = {.call = call_law, .ctx = law}};
    break;
  }
  case ROT_VALUE_OBJECT:
    return v->object->part ? give_part(v->object, at, store, to, no)
                           : give_list(v->object, input, at, store, to, no);
  default: memset(to, 0, sizeof *to); return ROT_OK;
  }
  if (to->is) return ROT_OK;
  return rot_refuse(no, at, "is a number, which this input does not take");
}

rot_status rot_object_given(const rot_object *object, rot_store *store, rot_given **given,
                            rot_refusal *no) {
  *given = rot_store_get(store, object->n, sizeof **given);
  if (!*given) return ROT_ENOMEM;
  for (size_t i = 0; i < object->n; i++) {
    const rot_status status =
        rot_object_give(&object->values[i], &object->inputs[i], i, store, &(*given)[i], no);
    if (status != ROT_OK) return status;
  }
  return rot_inputs_check(object->n, object->inputs, *given, no);
}

/* ---- laws ------------------------------------------------------------------------------------ */

int rot_object_calls(const rot_object *object) {
  for (size_t i = 0; i < object->n; i++) {
    const rot_value *v = &object->values[i];
    if (v->is == ROT_VALUE_LAW || (v->is == ROT_VALUE_OBJECT && rot_object_calls(v->object)))
      return 1;
  }
  return 0;
}
