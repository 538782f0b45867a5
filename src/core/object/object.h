/* Objects: scenes, their parts and lists, made by the name of a constructor and set input by input,
 * and their translation for the builders of the core. */
#ifndef ROT_OBJECT_H
#define ROT_OBJECT_H

#include "engine/model.h"
#include "engine/part.h"
#include "ground/store.h"

enum {
  ROT_ONE_NUMBER = ROT_INPUT_NUMBER | ROT_INPUT_LIMIT,
  ROT_MANY_NUMBERS = ROT_INPUT_NUMBERS | ROT_INPUT_TIMES | ROT_INPUT_VECTOR | ROT_INPUT_ATTITUDE
};

/* A law of the caller: not 0 stops the run. */
typedef struct rot_caller_law {
  int (*call)(const double *argument, double *value, void *context);
  void *context;
} rot_caller_law;

/* The value of an input or of an item of a list. */
typedef struct rot_value {
  enum {
    ROT_VALUE_UNSET,
    ROT_VALUE_NUMBER,
    ROT_VALUE_NUMBERS,
    ROT_VALUE_OPTION,
    ROT_VALUE_TEXT,
    ROT_VALUE_LAW,
    ROT_VALUE_OBJECT
  } is;
  double number;
  size_t n;        /* of `numbers` */
  double *numbers; /* owned */
  int option;      /* index in the input's options */
  rot_caller_law law;
  struct rotdyn_object *object; /* owned */
} rot_value;

/* The name of the struct is that of the C interface. */
typedef struct rotdyn_object {
  const rot_constraint *constraint; /* of a scene, else NULL */
  const rot_maker *maker;           /* of a scene, else NULL */
  const rot_part *part;             /* of a part; a list has neither */
  const rot_input *inputs;
  size_t n;    /* values: one for each input, or items of a list */
  size_t room; /* values allocated */
  rot_value *values;
  int depth; /* levels of nested objects */
} rot_object;

/* What a constructor makes: a scene or a part. */
typedef struct rot_made {
  const rot_constraint *constraint;
  const rot_maker *maker;
  const rot_part *part;
  const rot_input *inputs;
  size_t n_inputs;
} rot_made;

/* => 1; 0: there is no such constructor (or NULL) */
int rot_object_made(const char *constructor, rot_made *to);

/* => an object without values; "list": an empty list. NULL: no such constructor, or no memory. */
rot_object *rot_object_new(const char *constructor);
void rot_object_free(rot_object *object);

static inline int rot_object_is_list(const rot_object *object) {
  return !object->constraint && !object->part;
}

typedef enum rot_set {
  ROT_SET_DONE,
  ROT_SET_NOT_TAKEN, /* the input takes no such value, or the object is NULL */
  ROT_SET_NO_NAME,   /* there is no such input */
  ROT_SET_NO_MEMORY
} rot_set;

/* Set an input, or add an item to a list (input NULL). Numbers and objects are copied. */
rot_set rot_object_unset(rot_object *object, const char *input);
rot_set rot_object_number(rot_object *object, const char *input, double number);
rot_set rot_object_numbers(rot_object *object, const char *input, size_t n, const double values[]);
rot_set rot_object_text(rot_object *object, const char *input, const char *text);
rot_set rot_object_part(rot_object *object, const char *input, const rot_object *part);
rot_set rot_object_law(rot_object *object, const char *input, rot_caller_law law);

/* 1 if the object contains a law of the caller. */
int rot_object_calls(const rot_object *object);

/* (value of input `at`, its table) => as the builders read it; ROT_EVALUE: refused. Parts are built
 * in the store. Valid as long as the object. */
rot_status rot_object_give(const rot_value *value, const rot_input *input, size_t at,
                           rot_store *store, rot_given *to, rot_refusal *refusal);
/* object => all inputs of a scene or a part, checked, in the store. ROT_EVALUE: refused. */
rot_status rot_object_given(const rot_object *object, rot_store *store, rot_given **given,
                            rot_refusal *refusal);
/* => kind as which an input takes n numbers, 0: none, but as a list */
unsigned rot_object_kind_of(const rot_input *input, size_t n);

#endif
