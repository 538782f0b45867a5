#include "api/object.h"

#include <stdio.h>
#include <stdlib.h>

#include "api/structs.h"
#include "scene/parts.h"
#include "scene/run.h"

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
  rot_made m;
  if (!rot_object_made(constructor, &m)) return NULL;
  for (int i = 0; i < KIND_NAMES && m.part; i++) {
    if (kind_names[i].kind == m.part->makes) return kind_names[i].name;
  }
  return "scene";
}

int rotdyn_input_at(const char *constructor, size_t i, rotdyn_input *out) {
  rot_made m;
  size_t used = 0;
  if (!out) return ROTDYN_EARGUMENT;
  if (!rot_object_made(constructor, &m)) return ROTDYN_ENAME;
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
  rot_made m;
  if (!rot_object_made(constructor, &m) || !m.constraint) return NULL;
  return i < m.constraint->n_columns ? m.constraint->columns[i].name : NULL;
}

/* ---- objects --------------------------------------------------------------------------------- */

rotdyn_object *rotdyn_object_new(const char *constructor) { return rot_object_new(constructor); }

void rotdyn_object_free(rotdyn_object *object) { rot_object_free(object); }

static int status_of(rot_set set) {
  switch (set) {
  case ROT_SET_DONE: return ROTDYN_OK;
  case ROT_SET_NO_NAME: return ROTDYN_ENAME;
  case ROT_SET_NO_MEMORY: return ROTDYN_EMEMORY;
  default: return ROTDYN_EARGUMENT;
  }
}

int rotdyn_unset(rotdyn_object *object, const char *input) {
  return status_of(rot_object_unset(object, input));
}

int rotdyn_set_number(rotdyn_object *object, const char *input, double number) {
  return status_of(rot_object_number(object, input, number));
}

int rotdyn_set_numbers(rotdyn_object *object, const char *input, size_t n, const double *values) {
  return status_of(rot_object_numbers(object, input, n, values));
}

int rotdyn_set_text(rotdyn_object *object, const char *input, const char *text) {
  return status_of(rot_object_text(object, input, text));
}

int rotdyn_set_object(rotdyn_object *object, const char *input, const rotdyn_object *value) {
  return status_of(rot_object_part(object, input, value));
}

int rotdyn_set_law(rotdyn_object *object, const char *input, rotdyn_law_fn law, void *context) {
  return status_of(rot_object_law(object, input, (rot_caller_law){law, context}));
}

/* ---- built ----------------------------------------------------------------------------------- */

static rotdyn_status refuse(rotdyn_report *report, const char *input, const char *reason) {
  report->input = input;
  (void)snprintf(report->reason, sizeof report->reason, "%s", reason);
  return ROTDYN_EARGUMENT;
}

rotdyn_status rot_api_build(const rotdyn_object *scene, rot_api_built *built,
                            rotdyn_report *report) {
  rot_refusal no;
  const rot_constraint *c = built->constraint = scene ? scene->constraint : NULL;
  built->maker = c ? scene->maker : NULL;
  if (!c) return refuse(report, NULL, scene ? "it is no scene" : "the scene is NULL");
  built->scene = calloc(1, c->scene_size);
  if (!built->scene) return ROTDYN_EMEMORY;
  rot_status status = rot_object_given(scene, &built->store, &built->given, &no);
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
  rot_status status = built ? rot_object_given(object, &store, &given, &no) : ROT_ENOMEM;
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
  } else if (object && rot_object_is_list(object)) {
    status = refuse(&local, NULL, "a list is checked with the object that it is an input of");
  } else {
    rot_api_built built = {0};
    status = rot_api_build(object, &built, &local);
    rot_api_release(&built);
  }
  local.status = (int)status;
  return rot_api_give(&local, sizeof local, report) ? (int)status : ROTDYN_EARGUMENT;
}
