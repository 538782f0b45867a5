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
  if (size && n > (SIZE_MAX - 2 * sizeof(head)) / size) return NULL;
  if (store->take) {
    void *own = store->take(n * size + 1);
    return own ? memset(own, 0, n * size) : NULL;
  }
  const size_t bytes = (n * size / sizeof(head) + 1) * sizeof(head);
  if (bytes <= store->room - store->used) {
    void *own = store->kept + store->used;
    store->used += bytes;
    return memset(own, 0, bytes);
  }
  head *block = calloc(1, sizeof *block + bytes);
  if (!block) return NULL;
  store->lacked += bytes;
  block->before = store->last;
  store->last = block;
  return block + 1;
}

static void free_blocks(rot_store *store) {
  while (store->last) {
    head *block = store->last;
    store->last = block->before;
    free(block);
  }
}

void rot_store_rewind(rot_store *store) {
  free_blocks(store);
  if (store->lacked) {
    const size_t room = store->used + store->lacked;
    free(store->kept);
    store->kept = room >= store->lacked ? malloc(room) : NULL;
    store->room = store->kept ? room : 0;
  }
  store->used = store->lacked = 0;
}

void rot_store_free(rot_store *store) {
  free_blocks(store);
  free(store->kept);
  store->kept = NULL;
  store->room = store->used = store->lacked = 0;
}
