/* JSON (RFC 8259) as a tree. */
#ifndef ROT_JSON_H
#define ROT_JSON_H

#include <stddef.h>

#include "ground/ieee.h"

typedef enum rot_json_kind {
  ROT_JSON_NULL,
  ROT_JSON_BOOLEAN,
  ROT_JSON_NUMBER,
  ROT_JSON_STRING,
  ROT_JSON_ARRAY,
  ROT_JSON_OBJECT
} rot_json_kind;

typedef struct rot_json {
  rot_json_kind kind;
  double number; /* of a boolean: 0 or 1 */
  char *text;    /* of a string */
  char *key;     /* of a member of an object */
  size_t n;      /* members or items */
  struct rot_json *first, *next;
} rot_json;

/* Text that ends with a zero byte => its tree; NULL: it is no JSON, has a key twice or a zero
 * character, is too deep, or memory is out. */
rot_json *rot_json_read(const char *text);
void rot_json_free(rot_json *node);

/* => 1, its number; 0: it is none. "Inf", "-Inf", "NaN" are numbers. */
int rot_json_number(const rot_json *node, double *x);
/* 1: an array of numbers alone, of one at least */
int rot_json_numbers(const rot_json *array);

#endif
