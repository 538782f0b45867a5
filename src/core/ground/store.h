/* Memory of an object and its parts, freed in one call. */
#ifndef ROT_STORE_H
#define ROT_STORE_H

#include <stddef.h>

#include "ground/ieee.h"

/* Begin with {0}. */
typedef struct rot_store {
  void *last;                  /* last block of calloc() */
  void *(*take)(size_t bytes); /* NULL, or an allocator whose memory the caller frees */
  char *kept;                  /* memory that rot_store_rewind() keeps */
  size_t room, used, lacked;   /* bytes of it; those in use; those that blocks took besides */
} rot_store;

/* => n elements of `size` bytes, all bits 0; NULL: no memory, or n * size exceeds size_t */
void *rot_store_get(rot_store *store, size_t n, size_t size);
/* Ends the use of all memory of a store without allocator; keeps as much as was in use, so that the
 * next objects of the same kind allocate nothing. */
void rot_store_rewind(rot_store *store);
/* Frees all memory that calloc() gave; the store may be used again. */
void rot_store_free(rot_store *store);

#endif
