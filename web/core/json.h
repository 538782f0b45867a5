/* JSON (RFC 8259) as a tree, and texts that grow. */
#ifndef LAB_JSON_H
#define LAB_JSON_H

#include <stddef.h>

typedef enum lab_kind {
  LAB_NULL,
  LAB_BOOLEAN,
  LAB_NUMBER,
  LAB_STRING,
  LAB_ARRAY,
  LAB_OBJECT
} lab_kind;

typedef struct lab_node {
  lab_kind kind;
  double number; /* of a boolean: 0 or 1 */
  char *text;    /* of a string */
  char *key;     /* of a member of an object */
  size_t n;      /* members or items */
  struct lab_node *first, *next;
} lab_node;

/* Text that ends with a zero byte => its tree; NULL: it is no JSON, has a key twice or a zero
 * character, is too deep, or memory is out. */
lab_node *lab_json_read(const char *text);
void lab_json_free(lab_node *node);

/* A text that grows; `failed`: memory was out, and something is missing. */
typedef struct lab_text {
  char *text;
  size_t length, room;
  int failed;
} lab_text;

void lab_text_add(lab_text *to, const char *format, ...)
#ifdef __GNUC__
    __attribute__((format(printf, 2, 3)))
#endif
    ;
/* As a JSON string; NULL: null. */
void lab_text_string(lab_text *to, const char *text);
/* As JSON: NaN is null, Inf 1e999. */
void lab_text_number(lab_text *to, double x);
/* The shortest decimal number that is read as x; "Inf", "-Inf", "NaN". */
void lab_shortest(double x, char to[32]);

#endif
