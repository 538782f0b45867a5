#include "scene.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- reading --------------------------------------------------------------------------------- */

const lab_node *lab_scene_of(const lab_node *tree) {
  const lab_node *scene = NULL;
  if (!tree || tree->kind != LAB_OBJECT) return NULL;
  for (const lab_node *one = tree->first; one; one = one->next) {
    if (strcmp(one->key, "scene_format") == 0) {
      if (one->kind != LAB_NUMBER || one->number != 1.0) return NULL;
    } else if (scene) {
      return NULL;
    } else {
      scene = one;
    }
  }
  return scene;
}

static int refuse(lab_refusal *to, int status, const char *input, const char *reason) {
  to->status = status;
  (void)snprintf(to->input, sizeof to->input, "%s", input ? input : "");
  (void)snprintf(to->reason, sizeof to->reason, "%s", reason);
  return status;
}

/* "Inf" and its like are numbers. */
static int number_of(const lab_node *node, double *x) {
  if (node->kind == LAB_NUMBER) return *x = node->number, 1;
  if (node->kind != LAB_STRING) return 0;
  if (strcmp(node->text, "Inf") == 0) return *x = INFINITY, 1;
  if (strcmp(node->text, "-Inf") == 0) return *x = -INFINITY, 1;
  if (strcmp(node->text, "NaN") == 0) return *x = NAN, 1;
  return 0;
}

static int all_numbers(const lab_node *array) {
  double x;
  for (const lab_node *one = array->first; one; one = one->next) {
    if (!number_of(one, &x)) return 0;
  }
  return array->n > 0;
}

/* {"body_disk": {...}} names its constructor; else the input does: "resistance": {...}. */
static const char *constructor_of(const lab_node *node, const char *input,
                                  const lab_node **arguments) {
  if (node->n == 1 && rotdyn_object_kind(node->first->key)) {
    *arguments = node->first;
    return node->first->key;
  }
  *arguments = node;
  return input;
}

static rotdyn_object *read_object(const char *constructor, const lab_node *arguments,
                                  lab_refusal *refusal);

static int set_object(rotdyn_object *in, const char *key, const char *name, rotdyn_object *value,
                      lab_refusal *refusal) {
  if (!value) return refusal->status;
  const int status = rotdyn_set_object(in, key, value);
  rotdyn_object_free(value);
  return status ? refuse(refusal, status, name, "it takes no such object") : ROTDYN_OK;
}

/* Sets input `key`, or adds an item for the input `name` to a list (key NULL). */
static int put(rotdyn_object *in, const char *key, const char *name, const lab_node *node,
               lab_refusal *refusal) {
  int status = ROTDYN_EARGUMENT;
  double x;
  if (number_of(node, &x)) {
    status = rotdyn_set_number(in, key, x);
  } else if (node->kind == LAB_NULL) {
    status = rotdyn_unset(in, key);
  } else if (node->kind == LAB_STRING) {
    status = rotdyn_set_text(in, key, node->text);
  } else if (node->kind == LAB_OBJECT) {
    const lab_node *arguments;
    const char *constructor = constructor_of(node, name, &arguments);
    return set_object(in, key, name, read_object(constructor, arguments, refusal), refusal);
  } else if (node->kind == LAB_ARRAY && all_numbers(node)) {
    double *values = malloc(node->n * sizeof *values);
    size_t i = 0;
    if (!values) return refuse(refusal, ROTDYN_EMEMORY, name, "memory is out");
    for (const lab_node *one = node->first; one; one = one->next) {
      (void)number_of(one, &values[i++]);
    }
    status = rotdyn_set_numbers(in, key, node->n, values);
    free(values);
  } else if (node->kind == LAB_ARRAY) {
    rotdyn_object *list = rotdyn_object_new("list");
    for (const lab_node *one = node->first; one && list; one = one->next) {
      if (put(list, NULL, name, one, refusal)) {
        rotdyn_object_free(list);
        return refusal->status;
      }
    }
    if (!list) return refuse(refusal, ROTDYN_EMEMORY, name, "memory is out");
    return set_object(in, key, name, list, refusal);
  }
  if (status == ROTDYN_ENAME) return refuse(refusal, status, name, "is no input");
  return status ? refuse(refusal, status, name, "it takes no such value") : ROTDYN_OK;
}

static rotdyn_object *read_object(const char *constructor, const lab_node *arguments,
                                  lab_refusal *refusal) {
  if (!rotdyn_object_kind(constructor)) {
    (void)refuse(refusal, ROTDYN_ENAME, constructor, "there is no constructor of this name");
    return NULL;
  }
  if (arguments->kind != LAB_OBJECT) {
    (void)refuse(refusal, ROTDYN_EARGUMENT, constructor, "its inputs must be an object");
    return NULL;
  }
  rotdyn_object *object = rotdyn_object_new(constructor);
  if (!object) (void)refuse(refusal, ROTDYN_EMEMORY, constructor, "memory is out");
  for (const lab_node *one = arguments->first; one && object; one = one->next) {
    if (put(object, one->key, one->key, one, refusal)) {
      rotdyn_object_free(object);
      return NULL;
    }
  }
  return object;
}

rotdyn_object *lab_scene_read(const lab_node *tree, lab_refusal *refusal) {
  memset(refusal, 0, sizeof *refusal);
  if (!tree) {
    (void)refuse(refusal, ROTDYN_EARGUMENT, NULL, "the text is no JSON");
    return NULL;
  }
  const lab_node *scene = lab_scene_of(tree);
  const char *kind = scene ? rotdyn_object_kind(scene->key) : NULL;
  if (!kind || strcmp(kind, "scene") != 0) {
    (void)refuse(refusal, ROTDYN_EARGUMENT, scene ? scene->key : NULL,
                 "the text has no scene that this version knows");
    return NULL;
  }
  rotdyn_object *object = read_object(scene->key, scene, refusal);
  rotdyn_report report = ROTDYN_INIT(rotdyn_report);
  if (!object) return NULL;
  const int status = rotdyn_object_check(object, &report);
  if (status) {
    (void)refuse(refusal, status, report.input,
                 report.reason[0] ? report.reason : rotdyn_status_text(status));
    rotdyn_object_free(object);
    return NULL;
  }
  return object;
}

/* ---- R code ---------------------------------------------------------------------------------- */

static void indent(lab_text *to, int level) { lab_text_add(to, "\n%*s", 2 * level, ""); }

static int code_of(const lab_node *node, const char *name, int level, lab_text *to);

/* A call in one line where it is short, else an argument a line. */
static int code_of_call(const char *function, const lab_node *arguments, int level, lab_text *to) {
  const size_t from = to->length;
  for (int broken = 0; broken < 2; broken++) {
    to->length = from;
    lab_text_add(to, "%s(", function);
    for (const lab_node *one = arguments->first; one; one = one->next) {
      if (broken) indent(to, level + 1);
      if (one->key) lab_text_add(to, "%s = ", one->key);
      if (!code_of(one, one->key ? one->key : "", level + 1, to)) return 0;
      if (one->next) lab_text_add(to, broken ? "," : ", ");
    }
    if (broken) indent(to, level);
    lab_text_add(to, ")");
    if (to->failed) return 0;
    if (to->length - from + 2 * (size_t)level < 72 && !strchr(to->text + from, '\n')) return 1;
  }
  return 1;
}

static int code_of_text(const char *text, lab_text *to) {
  lab_text_add(to, "\"");
  for (; *text; text++) {
    if ((unsigned char)*text < 0x20) return 0;
    lab_text_add(to, *text == '"' || *text == '\\' ? "\\%c" : "%c", *text);
  }
  lab_text_add(to, "\"");
  return 1;
}

/* Laws are added by `+`; one of them must be a law. */
static int code_of_sum(const lab_node *laws, int level, lab_text *to) {
  if (!laws || laws->kind != LAB_ARRAY || laws->n == 0) return 0;
  for (const lab_node *one = laws->first; one; one = one->next) {
    const int number = one->kind == LAB_NUMBER;
    if (number) lab_text_add(to, "torque_constant(");
    if (!code_of(one, "torque", level, to)) return 0;
    lab_text_add(to, "%s%s", number ? ")" : "", one->next ? " + " : "");
  }
  return 1;
}

static int code_of_object(const lab_node *node, const char *name, int level, lab_text *to) {
  const lab_node *arguments;
  const char *constructor = constructor_of(node, name, &arguments);
  const char *kind = rotdyn_object_kind(constructor);
  if (!kind || arguments->kind != LAB_OBJECT) return 0;
  if (strcmp(constructor, "torque_sum") == 0) return code_of_sum(arguments->first, level, to);
  if (strcmp(kind, "table") == 0) return code_of_call("data.frame", arguments, level, to);
  /* Those are no functions of R. */
  if (strcmp(kind, "moments") == 0 || strcmp(kind, "sizes") == 0 || strcmp(kind, "points") == 0 ||
      strncmp(constructor, "rot_", 4) == 0 || strcmp(constructor, "torque_term") == 0) {
    return 0;
  }
  return code_of_call(constructor, arguments, level, to);
}

static int code_of(const lab_node *node, const char *name, int level, lab_text *to) {
  char number[32];
  double x;
  if (number_of(node, &x)) {
    lab_shortest(x, number);
    lab_text_add(to, "%s", number);
    return 1;
  }
  switch (node->kind) {
  case LAB_NULL: lab_text_add(to, "NULL"); return 1;
  case LAB_STRING: return code_of_text(node->text, to);
  case LAB_OBJECT: return code_of_object(node, name, level, to);
  case LAB_ARRAY: break;
  default: return 0;
  }
  if (all_numbers(node)) return code_of_call("c", node, level, to);
  for (const lab_node *one = node->first; one; one = one->next) {
    /* Rows of a matrix. */
    if (one->kind == LAB_ARRAY && all_numbers(one)) return 0;
  }
  /* The items have no keys: what they are is named by the input. */
  lab_text_add(to, "list(");
  for (const lab_node *one = node->first; one; one = one->next) {
    if (!code_of(one, name, level + 1, to)) return 0;
    if (one->next) lab_text_add(to, ", ");
  }
  lab_text_add(to, ")");
  return 1;
}

int lab_scene_code(const lab_node *tree, lab_text *to) {
  const lab_node *scene = lab_scene_of(tree);
  if (!scene || scene->kind != LAB_OBJECT) return 0;
  const size_t from = to->length;
  const int fine = code_of_call(scene->key, scene, 0, to) && !to->failed;
  if (!fine && to->text) {
    to->length = from;
    to->text[from] = '\0';
  }
  return fine;
}
