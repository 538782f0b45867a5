/* Memory that is freed at once: zeroed, aligned, counted in size_t. The sanitizers see leaks. */
#include "ground/store.h"

#include <stdint.h>

#include "rot_test.h"

static void check_blocks(void) {
  rot_store store = {0};
  size_t odd = 0;
  for (size_t n = 0; n < 200; n++) {
    double *x = rot_store_get(&store, n, sizeof *x);
    ROT_CHECK(x != NULL && (uintptr_t)x % sizeof *x == 0);
    for (size_t i = 0; x && i < n; i++) {
      odd += x[i] != 0.0;
      x[i] = 1.0;
    }
  }
  ROT_CHECK(odd == 0);
  rot_store_free(&store);
  ROT_CHECK(store.last == NULL && rot_store_get(&store, 1, 1) != NULL);
  rot_store_free(&store);
  rot_store_free(&store);
}

static void check_limits(void) {
  rot_store store = {0};
  ROT_CHECK(!rot_store_get(&store, SIZE_MAX, 1) && !rot_store_get(&store, SIZE_MAX / 8, 9));
  ROT_CHECK(!rot_store_get(&store, 2, SIZE_MAX / 2 + 1) && !store.last);
}

static char room[64];
static size_t asked;

static void *take(size_t bytes) {
  asked = bytes;
  return bytes <= sizeof room ? room : NULL;
}

/* Memory of the caller: zeroed, and not freed. */
static void check_taken(void) {
  rot_store store = {.take = take};
  room[0] = 1;
  const char *x = rot_store_get(&store, 4, 8);
  ROT_CHECK(x == room && asked >= 32 && x[0] == 0);
  ROT_CHECK(!rot_store_get(&store, 9, 8));
  rot_store_free(&store);
}

/* After a rewind the same objects take the memory of the last ones: zeroed, aligned, at the places
 * that they had from the second time on, and no block is allocated. */
static void check_rewind(void) {
  rot_store store = {0};
  enum { N = 20 };
  double *at[N] = {NULL};
  size_t odd = 0, moved = 0, blocks = 0;
  for (int round = 0; round < 5; round++) {
    for (size_t i = 0; i < N; i++) {
      double *x = rot_store_get(&store, i, sizeof *x);
      ROT_CHECK(x != NULL && (uintptr_t)x % sizeof *x == 0);
      for (size_t k = 0; x && k < i; k++) {
        odd += x[k] != 0.0;
        x[k] = (double)(100 * i + k + 1);
      }
      moved += round > 1 && x != at[i];
      at[i] = x;
    }
    /* None overlaps another. */
    for (size_t i = 0; i < N; i++) {
      for (size_t k = 0; k < i; k++) odd += at[i][k] != (double)(100 * i + k + 1);
    }
    blocks += round > 0 && store.last != NULL;
    rot_store_rewind(&store);
    ROT_CHECK(store.last == NULL && store.used == 0 && store.lacked == 0 && store.room > 0);
  }
  ROT_CHECK_EQ_INT(odd, 0);
  ROT_CHECK_EQ_INT(moved, 0);
  ROT_CHECK_EQ_INT(blocks, 0);
  /* More than before: the rest in blocks, and all of it kept from then on. */
  const size_t kept = store.room;
  ROT_CHECK(rot_store_get(&store, kept / 2, 1) && !store.last);
  char *more = rot_store_get(&store, kept, 1);
  ROT_CHECK(more && store.last && store.lacked >= kept && more[0] == 0 && more[kept - 1] == 0);
  rot_store_rewind(&store);
  ROT_CHECK(store.room >= kept + kept / 2 && !store.last);
  ROT_CHECK(rot_store_get(&store, kept / 2, 1) && rot_store_get(&store, kept, 1) && !store.last);
  rot_store_free(&store);
  ROT_CHECK(store.kept == NULL && store.room == 0 && store.used == 0);
  rot_store_rewind(&store); /* nothing was taken */
  ROT_CHECK(store.kept == NULL && store.room == 0);
}

int main(void) {
  check_blocks();
  check_taken();
  check_limits();
  check_rewind();
  return rot_test_report("store");
}
