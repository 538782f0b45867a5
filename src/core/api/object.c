#include "api/object.h"

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "api/structs.h"
#include "scene/parts.h"
#include "scene/run.h"

enum {
  MAX_DEPTH = 16, /* of objects in objects */
  ONE_NUMBER = ROT_INPUT_NUMBER | ROT_INPUT_LIMIT,
  MANY_NUMBERS = ROT_INPUT_NUMBERS | ROT_INPUT_TIMES | ROT_INPUT_VECTOR | ROT_INPUT_ATTITUDE
};

typedef struct caller_law {
  rotdyn_law_fn call;
  void *context;
} caller_law;

/* The value of an input or of an item of a list. */
typedef struct value {
  enum { UNSET, NUMBER, NUMBERS, OPTION, TEXT, LAW, OBJECT } is;
  double number;
  size_t n;        /* of `numbers` */
  double *numbers; /* freed with the value */
  int option;      /* index in the input's options */
  caller_law law;
  rotdyn_object *object; /* freed with the value */
} value;

struct rotdyn_object {
  const rot_constraint *constraint; /* of a scene, else NULL */
  const rot_maker *maker;           /* of a scene, else NULL */
  const rot_part *part;             /* of a part; a list has neither */
  const rot_input *inputs;
  size_t n;    /* values: one for each input, or items of a list */
  size_t room; /* values allocated */
  value *values;
  int depth; /* levels of nested objects, <= MAX_DEPTH */
};

/* ---- the tables ------------------------------------------------------------------------------ */

static const struct {
  unsigned kind;
  const char *name;
} kind_names[] = {{ROT_INPUT_NUMBER, "number"},   {ROT_INPUT_LIMIT, "limit"},
                  {ROT_INPUT_NUMBERS, "numbers"}, {ROT_INPUT_TIMES, "times"},
                  {ROT_INPUT_VECTOR, "vector"},   {ROT_INPUT_ATTITUDE, "attitude"},
                  {ROT_INPUT_CHOICE, "choice"},   {ROT_INPUT_TEXT, "text"},
                  {ROT_INPUT_LAW, "law"},         {ROT_INPUT_BODY, "body"},
                  {ROT_INPUT_TORQUE, "torque"},   {ROT_INPUT_RESISTANCE, "resistance"},
                  {ROT_INPUT_INERTIA, "inertia"}, {ROT_INPUT_COUPLING, "coupling"},
                  {ROT_INPUT_BRAKE, "brake"},     {ROT_INPUT_TABLE, "table"},
                  {ROT_INPUT_ROTOR, "rotor"},     {ROT_INPUT_MOMENTS, "moments"},
                  {ROT_INPUT_POINTS, "points"},   {ROT_INPUT_SIZES, "sizes"},
                  {ROT_INPUT_LIST, "list"},       {ROT_INPUT_NOTHING, "nothing"}};
enum { KIND_NAMES = sizeof kind_names / sizeof *kind_names };

/* The scene or the part of a constructor. */
typedef struct made {
  const rot_constraint *constraint;
  const rot_maker *maker;
  const rot_part *part;
  const rot_input *inputs;
  size_t n_inputs;
} made;

static int find_made(const char *constructor, made *to) {
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

const char *rotdyn_object_at(size_t i) {
  size_t n;
  const rot_constraint *const *list = rot_choice_constraints(&n);
  for (size_t k = 0; k < n; k++) {
    if (i < list[k]->n_makers) return list[k]->makers[i].constructor;
    i -= list[k]->n_makers;
  }
  const rot_part *part = rot_part_at(i);
  return part ? part->constructor : NULL;
}

const char *rotdyn_object_kind(const char *constructor) {
  made m;
  if (!find_made(constructor, &m)) return NULL;
  for (int i = 0; i < KIND_NAMES && m.part; i++) {
    if (kind_names[i].kind == m.part->makes) return kind_names[i].name;
  }
  return "scene";
}

int rotdyn_input_at(const char *constructor, size_t i, rotdyn_input *out) {
  made m;
  size_t used = 0;
  if (!out) return ROTDYN_EARGUMENT;
  if (!find_made(constructor, &m)) return ROTDYN_ENAME;
  if (i >= m.n_inputs) return ROTDYN_EEND;
  const rot_input *from = &m.inputs[i];
  rotdyn_input to = {.name = from->name,
                     .unit = from->unit,
                     .required = from->required,
                     .low = from->low,
                     .high = from->high,
                     .above = from->above,
                     .otherwise = from->otherwise,
                     .words = from->words,
                     .options = from->kinds & ROT_INPUT_CHOICE ? from->options : NULL};
  for (int k = 0; k < KIND_NAMES; k++) {
    if (!(from->kinds & kind_names[k].kind) || used >= sizeof to.kinds) continue;
    const int length = snprintf(to.kinds + used, sizeof to.kinds - used, "%s%s", used ? ", " : "",
                                kind_names[k].name);
    if (length > 0) used += (size_t)length;
  }
  return rot_api_give(&to, sizeof to, out) ? ROTDYN_OK : ROTDYN_EARGUMENT;
}

const char *rotdyn_column_at(const char *constructor, size_t i) {
  made m;
  if (!find_made(constructor, &m) || !m.constraint) return NULL;
  return i < m.constraint->n_columns ? m.constraint->columns[i].name : NULL;
}

/* ---- objects --------------------------------------------------------------------------------- */

rotdyn_object *rotdyn_object_new(const char *constructor) {
  made m;
  const int known = find_made(constructor, &m);
  if (!known && !(constructor && !strcmp(constructor, "list"))) return NULL;
  rotdyn_object *object = calloc(1, sizeof *object);
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

static int is_list(const rotdyn_object *object) { return !object->constraint && !object->part; }

static void forget(value *v) {
  free(v->numbers);
  rotdyn_object_free(v->object);
  memset(v, 0, sizeof *v);
}

void rotdyn_object_free(rotdyn_object *object) {
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
static rotdyn_object *copy_object(const rotdyn_object *from) {
  rotdyn_object *to = calloc(1, sizeof *to);
  if (!to) return NULL;
  *to = *from;
  to->room = from->n;
  to->values = calloc(from->n + 1, sizeof *to->values);
  int ok = to->values != NULL;
  for (size_t i = 0; i < from->n && ok; i++) {
    const value *v = &from->values[i];
    value *w = &to->values[i];
    *w = *v;
    w->numbers = v->numbers ? copy_numbers(v->n, v->numbers) : NULL;
    w->object = v->object ? copy_object(v->object) : NULL;
    ok = (!v->numbers || w->numbers) && (!v->object || w->object);
  }
  if (ok) return to;
  if (!to->values) to->n = 0;
  rotdyn_object_free(to);
  return NULL;
}

/* ---- setting --------------------------------------------------------------------------------- */

/* Kinds of items of a list, whose input is not known yet. */
enum { IN_A_LIST = ONE_NUMBER | MANY_NUMBERS | ROT_INPUT_LAW | ROT_INPUT_LIST | ROT_INPUT_OBJECTS };

/* name => kinds of the input, index of its value. For a list (name NULL): index of a new item. */
static rotdyn_status find(rotdyn_object *object, const char *name, unsigned *kinds, size_t *at) {
  if (!object || (name == NULL) != is_list(object)) return ROTDYN_EARGUMENT;
  if (!name) {
    *kinds = IN_A_LIST;
    *at = object->n;
    return ROTDYN_OK;
  }
  *at = rot_input_named(object->n, object->inputs, name);
  if (*at == object->n) return ROTDYN_ENAME;
  *kinds = object->inputs[*at].kinds;
  return ROTDYN_OK;
}

/* Sets value `at`; the object takes ownership of `v`. */
static rotdyn_status put(rotdyn_object *object, size_t at, value v) {
  if (at == object->n && at == object->room) {
    const size_t room = 2 * object->room + 4;
    value *more = room < SIZE_MAX / sizeof *more
                      ? realloc(object->values, room * sizeof *object->values)
                      : NULL;
    if (!more) {
      forget(&v);
      return ROTDYN_EMEMORY;
    }
    object->values = more;
    object->room = room;
  }
  if (at == object->n) {
    memset(&object->values[object->n++], 0, sizeof v);
  }
  forget(&object->values[at]);
  object->values[at] = v;
  return ROTDYN_OK;
}

int rotdyn_unset(rotdyn_object *object, const char *input) {
  unsigned kinds;
  size_t at;
  const rotdyn_status status = find(object, input, &kinds, &at);
  return (int)(status == ROTDYN_OK ? put(object, at, (value){.is = UNSET}) : status);
}

int rotdyn_set_number(rotdyn_object *object, const char *input, double number) {
  unsigned kinds;
  size_t at;
  const rotdyn_status status = find(object, input, &kinds, &at);
  if (status != ROTDYN_OK) return (int)status;
  if (!(kinds & (ONE_NUMBER | ROT_INPUT_NUMBERS))) return ROTDYN_EARGUMENT;
  return (int)put(object, at, (value){.is = NUMBER, .number = number});
}

int rotdyn_set_numbers(rotdyn_object *object, const char *input, size_t n, const double *values) {
  unsigned kinds;
  size_t at;
  const rotdyn_status status = find(object, input, &kinds, &at);
  if (status != ROTDYN_OK) return (int)status;
  const int as_list = kinds & ROT_INPUT_LIST && kinds & ROT_INPUT_NUMBER;
  if (!(kinds & MANY_NUMBERS || as_list) || (n && !values)) return ROTDYN_EARGUMENT;
  double *copy = copy_numbers(n, values);
  if (!copy) return ROTDYN_EMEMORY;
  return (int)put(object, at, (value){.is = NUMBERS, .n = n, .numbers = copy});
}

int rotdyn_set_text(rotdyn_object *object, const char *input, const char *text) {
  unsigned kinds;
  size_t at;
  int place = 0;
  const rotdyn_status status = find(object, input, &kinds, &at);
  if (status != ROTDYN_OK) return (int)status;
  if (!text) return ROTDYN_EARGUMENT;
  if (!(kinds & (ROT_INPUT_CHOICE | ROT_INPUT_TEXT))) return ROTDYN_EARGUMENT;
  const char *const *options = kinds & ROT_INPUT_CHOICE ? object->inputs[at].options : NULL;
  while (options && options[place] && strcmp(options[place], text)) place++;
  if (!options || !options[place]) {
    if (!(kinds & ROT_INPUT_TEXT)) return ROTDYN_EARGUMENT;
    return (int)put(object, at, (value){.is = TEXT});
  }
  return (int)put(object, at, (value){.is = OPTION, .option = place});
}

/* list => its items as an array, if all are numbers; else NULL */
static double *numbers_of_list(const rotdyn_object *list) {
  for (size_t i = 0; i < list->n; i++) {
    if (list->values[i].is != NUMBER) return NULL;
  }
  double *x = malloc((list->n + 1) * sizeof *x);
  for (size_t i = 0; i < list->n && x; i++) x[i] = list->values[i].number;
  return x;
}

int rotdyn_set_object(rotdyn_object *object, const char *input, const rotdyn_object *from) {
  unsigned kinds;
  size_t at;
  const rotdyn_status status = find(object, input, &kinds, &at);
  if (status != ROTDYN_OK) return (int)status;
  if (!from || from->constraint || from->depth + 1 > MAX_DEPTH) return ROTDYN_EARGUMENT;
  if (from->part && !(kinds & from->part->makes)) return ROTDYN_EARGUMENT;
  if (is_list(from)) {
    double *x = kinds & MANY_NUMBERS ? numbers_of_list(from) : NULL;
    if (x) return (int)put(object, at, (value){.is = NUMBERS, .n = from->n, .numbers = x});
    if (!(kinds & ROT_INPUT_LIST)) return ROTDYN_EARGUMENT;
  }
  rotdyn_object *copy = copy_object(from);
  if (!copy) return ROTDYN_EMEMORY;
  if (object->depth < from->depth + 1) object->depth = from->depth + 1;
  return (int)put(object, at, (value){.is = OBJECT, .object = copy});
}

int rotdyn_set_law(rotdyn_object *object, const char *input, rotdyn_law_fn law, void *context) {
  unsigned kinds;
  size_t at;
  const rotdyn_status status = find(object, input, &kinds, &at);
  if (status != ROTDYN_OK) return (int)status;
  if (!law || !(kinds & ROT_INPUT_LAW)) return ROTDYN_EARGUMENT;
  return (int)put(object, at, (value){.is = LAW, .law = {law, context}});
}

/* ---- values => inputs of the builders -------------------------------------------------------- */

static rot_status call_law(const double argument[], double result[], void *ctx) {
  const caller_law *law = ctx;
  return law->call(argument, result, law->context) ? ROT_EUNWIND : ROT_OK;
}

static rot_status give(const value *v, const rot_input *input, size_t at, rot_store *store,
                       rot_given *to, rot_refusal *no);

static rot_status give_list(const rotdyn_object *list, const rot_input *input, size_t at,
                            rot_store *store, rot_given *to, rot_refusal *no) {
  rot_given *item = rot_store_get(store, list->n, sizeof *item);
  if (!item) return ROT_ENOMEM;
  *to = (rot_given){.is = ROT_INPUT_LIST, .n = list->n, .item = item};
  for (size_t i = 0; i < list->n; i++) {
    const rot_status status = give(&list->values[i], input, at, store, &item[i], no);
    if (status == ROT_EVALUE) rot_refused_in(no, "in item %zu,", i + 1);
    if (status != ROT_OK) return status;
  }
  return ROT_OK;
}

/* numbers => list of single numbers */
static rot_status give_each(const value *v, rot_store *store, rot_given *to) {
  rot_given *item = rot_store_get(store, v->n, sizeof *item);
  if (!item) return ROT_ENOMEM;
  for (size_t i = 0; i < v->n; i++) {
    item[i] = (rot_given){.is = ROT_INPUT_NUMBER, .n = 1, .x = &v->numbers[i]};
  }
  *to = (rot_given){.is = ROT_INPUT_LIST, .n = v->n, .item = item};
  return ROT_OK;
}

/* object => part, checked and built */
static rot_status give_part(const rotdyn_object *object, size_t at, rot_store *store, rot_given *to,
                            rot_refusal *no) {
  const rot_part *part = object->part;
  rot_given *given;
  void *built = rot_store_get(store, 1, part->size);
  if (!built) return ROT_ENOMEM;
  rot_status status = rot_api_given(object, store, &given, no);
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
static unsigned many_of(const rot_input *input, size_t n) {
  unsigned kinds = input->kinds & MANY_NUMBERS;
  if (kinds & ROT_INPUT_NUMBERS && n != 3) kinds &= ~(unsigned)ROT_INPUT_VECTOR;
  if (kinds & ROT_INPUT_NUMBERS && n != 4) kinds &= ~(unsigned)ROT_INPUT_ATTITUDE;
  return kinds & (~kinds + 1u);
}

/* value of input `at` => as the builders read it; ROT_EVALUE: refused */
static rot_status give(const value *v, const rot_input *input, size_t at, rot_store *store,
                       rot_given *to, rot_refusal *no) {
  unsigned kind;
  switch (v->is) {
  case NUMBER:
    kind = first_of(input, ONE_NUMBER);
    if (!kind) kind = first_of(input, ROT_INPUT_NUMBERS);
    *to = (rot_given){.is = kind, .n = 1, .x = &v->number};
    break;
  case NUMBERS:
    kind = many_of(input, v->n);
    if (!kind) return give_each(v, store, to);
    *to = (rot_given){.is = kind, .n = v->n, .x = v->numbers};
    break;
  case OPTION: *to = (rot_given){.is = ROT_INPUT_CHOICE, .option = v->option}; break;
  case TEXT: *to = (rot_given){.is = ROT_INPUT_TEXT}; break;
  case LAW: {
    caller_law *law = rot_store_get(store, 1, sizeof *law);
    if (!law) return ROT_ENOMEM;
    *law = v->law;
    *to = (rot_given){.is = ROT_INPUT_LAW, .law = {.call = call_law, .ctx = law}};
    break;
  }
  case OBJECT:
    return v->object->part ? give_part(v->object, at, store, to, no)
                           : give_list(v->object, input, at, store, to, no);
  default: memset(to, 0, sizeof *to); return ROT_OK;
  }
  if (to->is) return ROT_OK;
  return rot_refuse(no, at, "is a number, which this input does not take");
}

rot_status rot_api_given(const rotdyn_object *object, rot_store *store, rot_given **given,
                         rot_refusal *no) {
  *given = rot_store_get(store, object->n, sizeof **given);
  if (!*given) return ROT_ENOMEM;
  for (size_t i = 0; i < object->n; i++) {
    const rot_status status =
        give(&object->values[i], &object->inputs[i], i, store, &(*given)[i], no);
    if (status != ROT_OK) return status;
  }
  return rot_inputs_check(object->n, object->inputs, *given, no);
}

/* ---- built ----------------------------------------------------------------------------------- */

const rot_constraint *rot_api_constraint(const rotdyn_object *scene) {
  return scene ? scene->constraint : NULL;
}

int rot_api_calls(const rotdyn_object *object) {
  for (size_t i = 0; i < object->n; i++) {
    const value *v = &object->values[i];
    if (v->is == LAW || (v->is == OBJECT && rot_api_calls(v->object))) return 1;
  }
  return 0;
}

static rotdyn_status refuse(rotdyn_report *report, const char *input, const char *reason) {
  report->input = input;
  (void)snprintf(report->reason, sizeof report->reason, "%s", reason);
  return ROTDYN_EARGUMENT;
}

rotdyn_status rot_api_build(const rotdyn_object *scene, rot_api_built *built,
                            rotdyn_report *report) {
  rot_refusal no;
  const rot_constraint *c = built->constraint = rot_api_constraint(scene);
  built->maker = c ? scene->maker : NULL;
  if (!c) return refuse(report, NULL, scene ? "it is no scene" : "the scene is NULL");
  built->scene = calloc(1, c->scene_size);
  if (!built->scene) return ROTDYN_EMEMORY;
  rot_status status = rot_api_given(scene, &built->store, &built->given, &no);
  if (status == ROT_OK)
    status = built->maker->build(built->given, &built->store, built->scene, &no);
  if (status == ROT_EVALUE) return refuse(report, built->maker->inputs[no.input].name, no.reason);
  if (status != ROT_OK) return rot_api_status(status);
  report->index = c->index;
  report->rows_per_time = rot_run_rows_per_time(c, built->scene);
  return ROTDYN_OK;
}

void rot_api_release(rot_api_built *built) {
  free(built->scene);
  rot_store_free(&built->store);
}

/* Checks a part outside a scene. */
static rotdyn_status check_part(const rotdyn_object *object, rotdyn_report *report) {
  rot_store store = {0};
  rot_given *given;
  rot_refusal no;
  void *built = rot_store_get(&store, 1, object->part->size);
  rot_status status = built ? rot_api_given(object, &store, &given, &no) : ROT_ENOMEM;
  if (status == ROT_OK) status = object->part->build(object->part, given, &store, built, &no);
  rot_store_free(&store);
  if (status == ROT_EVALUE) return refuse(report, object->inputs[no.input].name, no.reason);
  return rot_api_status(status);
}

int rotdyn_object_check(const rotdyn_object *object, rotdyn_report *report) {
  rotdyn_report local = {0};
  rotdyn_status status;
  if (object && object->part) {
    status = check_part(object, &local);
  } else if (object && is_list(object)) {
    status = refuse(&local, NULL, "a list is checked with the object that it is an input of");
  } else {
    rot_api_built built = {0};
    status = rot_api_build(object, &built, &local);
    rot_api_release(&built);
  }
  local.status = (int)status;
  return rot_api_give(&local, sizeof local, report) ? (int)status : ROTDYN_EARGUMENT;
}
