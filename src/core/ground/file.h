/* Files that are written, with the status of every step, the last one of closing included. */
#ifndef ROT_FILE_H
#define ROT_FILE_H

#include <stddef.h>

#include "ground/ieee.h"

/* `code`: 0, or the first errno. */
typedef struct rot_file {
  int descriptor, owned, code;
  size_t n; /* bytes in the buffer */
  char buffer[65536];
} rot_file;

/* A file that is made, or emptied. */
void rot_file_open(rot_file *file, const char *path);

/* A descriptor of the process, such as 1; rot_file_close() leaves it open. */
void rot_file_on(rot_file *file, int descriptor);

void rot_file_add(rot_file *file, const void *bytes, size_t n);

/* Returns the code. */
int rot_file_close(rot_file *file);

/* Words for a code; "" for 0. */
const char *rot_file_fault(int code);

/* 1 for what exists and is no regular file: a device, a pipe, a folder. */
int rot_file_special(const char *path);

#endif
