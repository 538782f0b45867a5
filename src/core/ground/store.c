#include "ground/store.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

/* Header of each block, aligned as strictly as any type stored. */
typedef union head {
  void *before;
  double number;
  long long whole;
} head;

void *rot_store_get(rot_store *store, size_t n, size_t size) {
  if (size && n > (SIZE_MAX - sizeof(head)) / size) return NULL;
  if (store->take) {
    void *own = store->take(n * size + 1);
    return own ? memset(own, 0, n * size) : NULL;
  }
  head *block = calloc(1, sizeof *block + n * size);
  if (!block) return NULL;
  block->before = store->last;
  store->last = block;
  return block + 1;
}

void rot_store_free(rot_store *store) {
  while (store->last) {
    head *block = store->last;
    store->last = block->before;
    free(block);
  }
}
