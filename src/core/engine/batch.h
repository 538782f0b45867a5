/* Many scenes of a constraint that differ in some numbers, by one kernel: their state at the start
 * and at one later time, within the error figures that it gives, not in the bits of the model. */
#ifndef ROT_BATCH_H
#define ROT_BATCH_H

#include "ground/column.h"
#include "ground/status.h"

enum { ROT_BATCH_INPUTS = 8, ROT_BATCH_COLUMNS = 10, ROT_BATCH_ROWS = 256 };

/* Inputs and results of n scenes. */
typedef struct rot_batch_rows {
  size_t n; /* up to ROT_BATCH_ROWS */
  rot_column
      input[ROT_BATCH_INPUTS]; /* finite, in their domains; values NULL: as the scene has it */
  unsigned given;    /* bit k: the scene is given a number as input k of its own, or it varies */
  rot_column time_s; /* finite, not before the start */
  double *start[ROT_BATCH_COLUMNS], *end[ROT_BATCH_COLUMNS];
  double *error;
  int *status; /* a rot_status; if not ROT_OK, the numbers of the row mean nothing */
} rot_batch_rows;

typedef struct rot_batch {
  const char *model;          /* the one that it stands for */
  const char *const *inputs;  /* paths that may vary (sweep/variants.h); the list ends with NULL */
  const char *const *columns; /* names; the list ends with NULL */
  /* 1 if the kernel takes the scene, whatever these inputs are. The model takes it. */
  int (*takes)(const void *scene);
  rot_status (*run)(const void *scene, const rot_batch_rows *rows);
} rot_batch;

/* => the column of the batch, or the number of the scene */
static inline rot_column rot_batch_input(const rot_batch_rows *batch, size_t k,
                                         const double *of_scene) {
  return batch->input[k].values ? batch->input[k] : (rot_column){of_scene, 0};
}

#endif
