/* Memory that is freed at once: what an object and its parts are built of. */
#ifndef ROT_STORE_H
#define ROT_STORE_H

#include <stddef.h>

#include "ground/ieee.h"

/* Begin with {0}: blocks of calloc(), which rot_store_free() frees. A caller whose own memory is
 * freed elsewhere sets `take`: so many bytes, or NULL. */
typedef struct rot_store {
  void *last;
  void *(*take)(size_t bytes);
} rot_store;

/* n elements of a size, all bits 0; NULL: no memory, or n * size is beyond size_t. */
void *rot_store_get(rot_store *store, size_t n, size_t size);
/* All of it; the store may be used again. */
void rot_store_free(rot_store *store);

#endif
