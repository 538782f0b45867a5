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

int main(void) {
  check_blocks();
  check_taken();
  check_limits();
  return rot_test_report("store");
}
