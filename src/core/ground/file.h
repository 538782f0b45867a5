/* Output files that keep the first error of opening, writing and closing. */
#ifndef ROT_FILE_H
#define ROT_FILE_H

#include <stddef.h>

#include "ground/ieee.h"

typedef struct rot_file {
  int descriptor; /* < 0: not open */
  int owned;      /* 1: rot_file_close() closes the descriptor */
  int code;       /* 0, or the first errno */
  size_t n;       /* bytes in the buffer */
  char buffer[65536];
} rot_file;

/* Opens a file for writing; creates or truncates it. */
void rot_file_open(rot_file *file, const char *path);

/* Uses an open descriptor, such as 1; rot_file_close() leaves it open. */
void rot_file_on(rot_file *file, int descriptor);

/* Appends n bytes through the buffer; no effect after an error. */
void rot_file_add(rot_file *file, const void *bytes, size_t n);

/* Flushes and closes; returns the code. */
int rot_file_close(rot_file *file);

/* code => message; "" for 0 */
const char *rot_file_fault(int code);

/* 1 if `path` exists and is not a regular file: a device, a pipe, a folder. */
int rot_file_special(const char *path);

#endif
