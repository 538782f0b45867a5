#include "sweep/variants.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "body/compound.h"
#include "engine/resistance.h"
#include "scene/run.h"

enum { PATH = 256, MAX_DEPTH = 20 };

/* ---- numbers that may vary ------------------------------------------------------------------- */

/* => how many numbers an input that lacks a value has, if it takes a fixed count; else 0 */
static size_t fixed_count(const rot_input *input) {
  if (input->kinds & ROT_INPUT_NUMBERS) return 0;
  return input->kinds & ROT_INPUT_VECTOR ? 3 : input->kinds & ROT_INPUT_ATTITUDE ? 4 : 0;
}

/* => 1 if the value may be replaced by one number; a list may not */
static int takes_one(const rot_input *input, const rot_value *v) {
  if (v->is == ROT_VALUE_NUMBERS) return 0;
  if (v->is == ROT_VALUE_OBJECT && rot_object_is_list(v->object)) return 0;
  if (input->kinds & ROT_ONE_NUMBER) return 1;
  return v->is == ROT_VALUE_NUMBER && (input->kinds & ROT_INPUT_NUMBERS);
}

static double value_now(const rot_input *input, const rot_value *v) {
  if (v->is == ROT_VALUE_NUMBER) return v->number;
  return v->is == ROT_VALUE_UNSET ? input->otherwise : (double)NAN;
}

/* => the input of value i; items of a list have that of the list, `list` */
static const rot_input *input_of(const rot_object *object, const rot_input *list, size_t i) {
  return rot_object_is_list(object) ? list : &object->inputs[i];
}

typedef struct walk {
  rot_place_visit visit;
  void *ctx;
  char path[PATH];
} walk;

static int visit_one(walk *w, const rot_object *object, const rot_input *input, size_t at,
                     size_t element, double value) {
  const rot_place place = {object, input, at, element, value};
  return w->visit(&place, w->path, w->ctx);
}

/* Of a resistance the terms that the input takes it for; of derived numbers nothing. */
static int is_taken(const rot_object *object, const rot_input *of, const char *name) {
  if (object->part && rot_compound_is_derived(object->part)) return 0;
  const char *const *terms = of && of->kinds & ROT_INPUT_RESISTANCE ? of->options : NULL;
  size_t i = 0;
  if (object->part != &rot_resistance_part || !terms) return 1;
  while (terms[i] && strcmp(terms[i], name)) i++;
  return terms[i] != NULL;
}

/* Visits the numbers of an object whose path is w->path[0 .. length - 1]; `list`: the input that it
 * is the value of. */
static int walk_object(walk *w, const rot_object *object, const rot_input *list, size_t length,
                       int depth) {
  int ended = 0;
  for (size_t i = 0; i < object->n && !ended; i++) {
    const rot_value *v = &object->values[i];
    const rot_input *input = input_of(object, list, i);
    if (!is_taken(object, list, input->name)) continue;
    const int more =
        rot_object_is_list(object)
            ? snprintf(w->path + length, PATH - length, "[%zu]", i + 1)
            : snprintf(w->path + length, PATH - length, "%s%s", length ? "$" : "", input->name);
    if (more < 0 || (size_t)more >= PATH - length) continue;
    const size_t end = length + (size_t)more;
    if (takes_one(input, v)) ended = visit_one(w, object, input, i, 0, value_now(input, v));
    const size_t n = v->is == ROT_VALUE_NUMBERS ? v->n
                     : v->is == ROT_VALUE_UNSET ? fixed_count(input)
                                                : 0;
    for (size_t k = 0; k < n && !ended; k++) {
      const int bracket = snprintf(w->path + end, PATH - end, "[%zu]", k + 1);
      if (bracket < 0 || (size_t)bracket >= PATH - end) break;
      const double zero = input->kinds & ROT_INPUT_ATTITUDE && k == 0 ? 1.0 : 0.0;
      ended = visit_one(w, object, input, i, k + 1, v->numbers ? v->numbers[k] : zero);
    }
    w->path[end] = '\0';
    if (v->is == ROT_VALUE_OBJECT && depth < MAX_DEPTH && !ended) {
      ended = walk_object(w, v->object, input, end, depth + 1);
    }
  }
  return ended;
}

void rot_variants_walk(const rot_object *scene, rot_place_visit visit, void *ctx) {
  walk w = {.visit = visit, .ctx = ctx};
  (void)walk_object(&w, scene, NULL, 0, 0);
}

/* ---- variants -------------------------------------------------------------------------------- */

/* An object on the way from the scene to a number that varies. */
typedef struct slot {
  const rot_object *object;
  const rot_input *list; /* of the items of a list */
  size_t up, at;         /* the slot that has it, as which value */
  int depth;             /* 0: the scene */
  rot_given *given;      /* its inputs, or the items of the list */
  size_t n_moving;       /* inputs that vary, have a slot, or are bounded by one that does */
  size_t *moving;        /* their places, in order */
  void *built;           /* the scene or the part; of a list NULL */
} slot;

struct rot_variants {
  size_t n_slots, n_leaves;
  slot *slots;       /* the scene first, each behind the one that has it */
  double **leaves;   /* where each number is set */
  rot_store store;   /* what stays */
  rot_store rebuilt; /* what the builders take, for one scene */
};

/* => the slot of an object below `up`, made if it is new; n_slots: no memory */
static size_t slot_of(rot_variants *v, const rot_object *object, const rot_input *list, size_t up,
                      size_t at) {
  for (size_t i = 1; i < v->n_slots; i++) {
    if (v->slots[i].object == object) return i;
  }
  v->slots[v->n_slots] =
      (slot){.object = object, .list = list, .up = up, .at = at, .depth = v->slots[up].depth + 1};
  return v->n_slots++;
}

/* Reads all inputs of a slot; those that are slots themselves are replaced by the next build. */
static rot_status open_slot(rot_variants *v, slot *s, rot_refusal *no) {
  const rot_object *object = s->object;
  if (!rot_object_is_list(object)) {
    const size_t size = object->part ? object->part->size : object->constraint->scene_size;
    s->built = rot_store_get(&v->store, 1, size);
    return s->built ? rot_object_given(object, &v->store, &s->given, no) : ROT_ENOMEM;
  }
  s->given = rot_store_get(&v->store, object->n, sizeof *s->given);
  rot_status status = s->given ? ROT_OK : ROT_ENOMEM;
  for (size_t i = 0; i < object->n && status == ROT_OK; i++) {
    status = rot_object_give(&object->values[i], s->list, s->at, &v->store, &s->given[i], no);
  }
  return status;
}

/* What a slot builds, as a value of the one that has it: a body as a copy of it, which each build
 * makes, others by their place. */
static rot_given given_of(const slot *s) {
  if (!s->built) {
    return (rot_given){.is = ROT_INPUT_LIST, .n = s->object->n, .item = s->given};
  }
  return (rot_given){.is = s->object->part->makes, .n = 1, .object = s->built};
}

/* (name or place of the next segment) => *text behind it. Returns the value's place in the object;
 * object->n: there is none. */
static size_t value_named(const rot_object *object, const char **text) {
  char name[PATH];
  size_t n = strcspn(*text, "$[");
  if (rot_object_is_list(object) || n == 0 || n >= PATH) return object->n;
  memcpy(name, *text, n);
  name[n] = '\0';
  *text += n;
  return rot_input_named(object->n, object->inputs, name);
}

/* "[12]..." => 12, *text behind it; 0: no such place */
static size_t place_in(const char **text) {
  const char *at = *text + 1;
  size_t k = 0;
  if (**text != '[' || *at == '0') return 0;
  while (*at >= '0' && *at <= '9' && k < 100000000) k = 10 * k + (size_t)(*at++ - '0');
  if (*at != ']') return 0;
  *text = at + 1;
  return k;
}

static rot_status no_number(rot_refusal *no, size_t path, const char *text) {
  return rot_refuse(no, path, "`%s` names no number that may vary", text);
}

/* Follows a path from the scene; makes its slots. => the place of the number */
static rot_status follow(rot_variants *v, const char *path, size_t p, size_t *of, rot_place *to,
                         rot_refusal *no) {
  const char *text = path;
  size_t at_slot = 0;
  const rot_object *object = v->slots[0].object;
  const rot_input *list = NULL;
  for (int depth = 0; depth < MAX_DEPTH; depth++) {
    size_t at;
    if (rot_object_is_list(object)) {
      at = place_in(&text);
      if (at == 0 || at > object->n) return no_number(no, p, path);
      at--;
    } else {
      if (depth > 0 && *text++ != '$') return no_number(no, p, path);
      at = value_named(object, &text);
      if (at == object->n) return no_number(no, p, path);
    }
    const rot_value *value = &object->values[at];
    const rot_input *input = input_of(object, list, at);
    if (!is_taken(object, list, input->name)) return no_number(no, p, path);
    *of = at_slot;
    *to = (rot_place){object, input, at, 0, value_now(input, value)};
    if (*text == '\0') return takes_one(input, value) ? ROT_OK : no_number(no, p, path);
    if (value->is == ROT_VALUE_OBJECT) {
      at_slot = slot_of(v, value->object, input, at_slot, at);
      object = value->object;
      list = input;
      continue;
    }
    const size_t n = value->is == ROT_VALUE_NUMBERS ? value->n
                     : value->is == ROT_VALUE_UNSET ? fixed_count(input)
                                                    : 0;
    to->element = place_in(&text);
    if (to->element == 0 || to->element > n || *text != '\0') return no_number(no, p, path);
    return ROT_OK;
  }
  return no_number(no, p, path);
}

/* => the leaf of a place: where its number is set */
static rot_status open_leaf(rot_variants *v, slot *s, const rot_place *place, double **to) {
  rot_given *given = &s->given[place->at];
  const rot_value *value = &place->object->values[place->at];
  if (place->element == 0) {
    double *x = rot_store_get(&v->store, 1, sizeof *x);
    if (!x) return ROT_ENOMEM;
    *x = place->value;
    const unsigned one = place->input->kinds & ROT_ONE_NUMBER;
    *given = (rot_given){.is = one ? one & (~one + 1u) : ROT_INPUT_NUMBERS, .n = 1, .x = x};
    *to = x;
    return ROT_OK;
  }
  /* A vector of which another element varies has its copy. */
  const size_t n = value->is == ROT_VALUE_NUMBERS ? value->n : fixed_count(place->input);
  const int listed = given->is == ROT_INPUT_LIST;
  const double *first = listed ? given->item[0].x : given->x;
  double *x = (double *)first;
  if (!first || (value->numbers && first == value->numbers)) {
    x = rot_store_get(&v->store, n, sizeof *x);
    if (!x) return ROT_ENOMEM;
    if (value->numbers)
      memcpy(x, value->numbers, n * sizeof *x);
    else if (place->input->kinds & ROT_INPUT_ATTITUDE)
      x[0] = 1.0;
    if (listed) {
      rot_given *item = rot_store_get(&v->store, n, sizeof *item);
      if (!item) return ROT_ENOMEM;
      for (size_t k = 0; k < n; k++) {
        item[k] = (rot_given){.is = ROT_INPUT_NUMBER, .n = 1, .x = &x[k]};
      }
      given->item = item;
    } else {
      *given = (rot_given){.is = rot_object_kind_of(place->input, n), .n = n, .x = x};
    }
  }
  *to = &x[place->element - 1];
  return ROT_OK;
}

/* Finds which inputs of slot `at` each build checks: the others passed with the scene. */
static rot_status open_moving(rot_variants *v, size_t at, size_t n, const rot_place places[],
                              const size_t of[]) {
  slot *s = &v->slots[at];
  s->moving = rot_store_get(&v->store, s->object->n, sizeof *s->moving);
  if (!s->moving) return ROT_ENOMEM;
  for (size_t i = 0; i < s->object->n; i++) {
    int moves = 0;
    for (size_t k = 0; k < n; k++) moves |= of[k] == at && places[k].at == i;
    for (size_t k = 1; k < v->n_slots; k++) moves |= v->slots[k].up == at && v->slots[k].at == i;
    const size_t max = rot_input_max(s->object->inputs, i);
    for (size_t k = 0; k < s->n_moving; k++) moves |= s->moving[k] == max;
    if (moves) s->moving[s->n_moving++] = i;
  }
  return ROT_OK;
}

static rot_status open_all(rot_variants *v, size_t n, const char *const paths[], rot_refusal *no) {
  rot_status status = ROT_OK;
  rot_place *places = rot_store_get(&v->store, n, sizeof *places);
  size_t *of = rot_store_get(&v->store, n, sizeof *of);
  if (!places || !of) return ROT_ENOMEM;
  for (size_t i = 0; i < n && status == ROT_OK; i++) {
    status = follow(v, paths[i], i, &of[i], &places[i], no);
    for (size_t k = 0; k < i && status == ROT_OK; k++) {
      if (places[k].object == places[i].object && places[k].at == places[i].at &&
          (places[k].element == places[i].element || !places[k].element || !places[i].element)) {
        status = rot_refuse(no, i, "`%s` and `%s` are the same number", paths[k], paths[i]);
      }
      /* An object that a number replaces. */
      for (size_t s = 1; s < v->n_slots && status == ROT_OK; s++) {
        const slot *below = &v->slots[s];
        for (size_t q = 0; q <= i; q++) {
          if (below->up == of[q] && below->at == places[q].at && places[q].element == 0) {
            status =
                rot_refuse(no, q, "`%s` takes the place of a part of which numbers vary", paths[q]);
          }
        }
      }
    }
  }
  for (size_t s = 0; s < v->n_slots && status == ROT_OK; s++) {
    status = open_slot(v, &v->slots[s], no);
    if (status == ROT_EVALUE) no->input = n;
  }
  if (status == ROT_OK) {
    status = rot_run_build(v->slots[0].object->maker, v->slots[0].given, &v->store,
                           v->slots[0].built, no);
    if (status == ROT_EVALUE) no->input = n;
  }
  for (size_t i = 0; i < n && status == ROT_OK; i++) {
    status = open_leaf(v, &v->slots[of[i]], &places[i], &v->leaves[i]);
  }
  for (size_t s = 1; s < v->n_slots && status == ROT_OK; s++) {
    v->slots[v->slots[s].up].given[v->slots[s].at] = given_of(&v->slots[s]);
  }
  for (size_t s = 0; s < v->n_slots && status == ROT_OK; s++) {
    if (v->slots[s].built) status = open_moving(v, s, n, places, of);
  }
  return status;
}

rot_status rot_variants_new(const rot_object *scene, size_t n, const char *const paths[],
                            rot_variants **to, rot_refusal *no) {
  rot_variants *v = calloc(1, sizeof *v);
  rot_status status = ROT_ENOMEM;
  *to = NULL;
  if (!v) return ROT_ENOMEM;
  v->n_leaves = n;
  v->leaves = rot_store_get(&v->store, n, sizeof *v->leaves);
  v->slots = rot_store_get(&v->store, n * (MAX_DEPTH + 1) + 1, sizeof *v->slots);
  if (v->leaves && v->slots) {
    v->slots[0].object = scene;
    v->n_slots = 1;
    status = scene && scene->constraint ? open_all(v, n, paths, no)
                                        : rot_refuse(no, n, "it is no scene");
  }
  if (status == ROT_OK)
    *to = v;
  else
    rot_variants_free(v);
  return status;
}

void rot_variants_free(rot_variants *v) {
  if (!v) return;
  rot_store_free(&v->rebuilt);
  rot_store_free(&v->store);
  free(v);
}

const void *rot_variants_base(const rot_variants *v) { return v->slots[0].built; }

void rot_variants_set(rot_variants *v, size_t i, double value) { *v->leaves[i] = value; }

static rot_status check_moving(const slot *s, rot_refusal *no) {
  rot_status status = ROT_OK;
  for (size_t i = 0; i < s->n_moving && status == ROT_OK; i++) {
    status = rot_input_check(s->moving[i], s->object->inputs, s->given, no);
  }
  return status;
}

static rot_status build_part(rot_variants *v, slot *s, rot_refusal *no) {
  const rot_part *part = s->object->part;
  memset(s->built, 0, part->size);
  rot_status status = check_moving(s, no);
  if (status == ROT_OK) status = part->build(part, s->given, &v->rebuilt, s->built, no);
  if (status == ROT_OK && part->makes == ROT_INPUT_BODY) {
    v->slots[s->up].given[s->at].body = *(const rot_given_body *)s->built;
  }
  return status;
}

rot_status rot_variants_build(rot_variants *v, const void **scene, rot_refusal *no) {
  const rot_object *root = v->slots[0].object;
  rot_status status = ROT_OK;
  rot_store_rewind(&v->rebuilt);
  for (size_t i = v->n_slots - 1; i > 0 && status == ROT_OK; i--) {
    slot *s = &v->slots[i];
    if (s->built) status = build_part(v, s, no);
    if (status == ROT_EVALUE) {
      rot_refused_in(no, "in %s, `%s`", s->object->part->constructor,
                     s->object->inputs[no->input].name);
      while (v->slots[s->up].depth > 0) s = &v->slots[s->up];
      no->input = s->at;
      return status;
    }
  }
  const slot *top = &v->slots[0];
  if (status == ROT_OK) status = check_moving(top, no);
  if (status == ROT_OK) {
    memset(top->built, 0, root->constraint->scene_size);
    status = root->maker->build(top->given, &v->rebuilt, top->built, no);
  }
  *scene = top->built;
  return status;
}
