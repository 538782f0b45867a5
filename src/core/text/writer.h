/* Texts that grow. */
#ifndef ROT_WRITER_H
#define ROT_WRITER_H

#include <stddef.h>

#include "ground/ieee.h"

/* A text that grows; `failed`: memory was out, and something is missing. */
typedef struct rot_writer {
  char *text;
  size_t length, room;
  int failed;
} rot_writer;

void rot_write(rot_writer *to, const char *format, ...)
#ifdef __GNUC__
    __attribute__((format(printf, 2, 3)))
#endif
    ;
/* As a JSON string; NULL: null. */
void rot_write_string(rot_writer *to, const char *text);
/* As JSON: NaN is null, Inf 1e999. */
void rot_write_number(rot_writer *to, double x);

#endif
