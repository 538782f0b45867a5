#include "scene.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "text/scene_code.h"

static int refuse(lab_refusal *to, int status, const char *input, const char *reason) {
  to->status = status;
  (void)snprintf(to->input, sizeof to->input, "%s", input ? input : "");
  (void)snprintf(to->reason, sizeof to->reason, "%s", reason);
  return status;
}

static rotdyn_object *read_object(const char *constructor, const rot_json *arguments,
                                  lab_refusal *refusal);

static int set_object(rotdyn_object *in, const char *key, const char *name, rotdyn_object *value,
                      lab_refusal *refusal) {
  if (!value) return refusal->status;
  const int status = rotdyn_set_object(in, key, value);
  rotdyn_object_free(value);
  return status ? refuse(refusal, status, name, "it takes no such object") : ROTDYN_OK;
}

/* Sets input `key`, or adds an item for the input `name` to a list (key NULL). */
static int put(rotdyn_object *in, const char *key, const char *name, const rot_json *node,
               lab_refusal *refusal) {
  int status = ROTDYN_EARGUMENT;
  double x;
  if (rot_json_number(node, &x)) {
    status = rotdyn_set_number(in, key, x);
  } else if (node->kind == ROT_JSON_NULL) {
    status = rotdyn_unset(in, key);
  } else if (node->kind == ROT_JSON_STRING) {
    status = rotdyn_set_text(in, key, node->text);
  } else if (node->kind == ROT_JSON_OBJECT) {
    const rot_json *arguments;
    const char *constructor = rot_scene_part(node, name, &arguments);
    return set_object(in, key, name, read_object(constructor, arguments, refusal), refusal);
  } else if (node->kind == ROT_JSON_ARRAY && rot_json_numbers(node)) {
    double *values = malloc(node->n * sizeof *values);
    size_t i = 0;
    if (!values) return refuse(refusal, ROTDYN_EMEMORY, name, "memory is out");
    for (const rot_json *one = node->first; one; one = one->next) {
      (void)rot_json_number(one, &values[i++]);
    }
    status = rotdyn_set_numbers(in, key, node->n, values);
    /* An array of one number is that number, as R reads it. */
    if (status == ROTDYN_EARGUMENT && node->n == 1) status = rotdyn_set_number(in, key, *values);
    free(values);
  } else if (node->kind == ROT_JSON_ARRAY) {
    rotdyn_object *list = rotdyn_object_new("list");
    for (const rot_json *one = node->first; one && list; one = one->next) {
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

static rotdyn_object *read_object(const char *constructor, const rot_json *arguments,
                                  lab_refusal *refusal) {
  if (!rotdyn_object_kind(constructor)) {
    (void)refuse(refusal, ROTDYN_ENAME, constructor, "there is no constructor of this name");
    return NULL;
  }
  if (arguments->kind != ROT_JSON_OBJECT) {
    (void)refuse(refusal, ROTDYN_EARGUMENT, constructor, "its inputs must be an object");
    return NULL;
  }
  rotdyn_object *object = rotdyn_object_new(constructor);
  if (!object) (void)refuse(refusal, ROTDYN_EMEMORY, constructor, "memory is out");
  for (const rot_json *one = arguments->first; one && object; one = one->next) {
    if (put(object, one->key, one->key, one, refusal)) {
      rotdyn_object_free(object);
      return NULL;
    }
  }
  return object;
}

rotdyn_object *lab_scene_read(const rot_json *tree, lab_refusal *refusal) {
  memset(refusal, 0, sizeof *refusal);
  if (!tree) {
    (void)refuse(refusal, ROTDYN_EARGUMENT, NULL, "the text is no JSON");
    return NULL;
  }
  const rot_json *scene = rot_scene_member(tree);
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
