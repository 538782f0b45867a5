#include "summary/long.h"

#include <math.h>

const char *rot_kind_name(int kind) {
  switch (kind) {
#define X(code, number, name)                                                                      \
  case code: return name;
    ROT_KIND_LIST(X)
#undef X
  default: return NULL;
  }
}

int rot_long_whole(double x, uint64_t max, uint64_t *whole) {
  if (!(x >= 0.0 && x <= (double)max) || signbit(x) || x != floor(x)) return 0;
  *whole = (uint64_t)x;
  return 1;
}

int rot_long_is_sum(double hi, double lo) {
  return isfinite(hi) ? hi + lo == hi : lo == 0.0 && !signbit(lo);
}

void rot_long_number(rot_long_at *at, int quantity, rot_kind kind, int64_t key, double *value) {
  const size_t i = at->next++;
  if (!at->rows || at->bad) return;
  if (!at->read) {
    at->rows->quantity[i] = quantity;
    at->rows->kind[i] = (int)kind;
    at->rows->key[i] = key;
    at->rows->value[i] = *value;
  } else if (i < at->n && at->rows->quantity[i] == quantity && at->rows->kind[i] == (int)kind &&
             at->rows->key[i] == key) {
    *value = at->rows->value[i];
  } else {
    at->bad = 1;
  }
}

void rot_long_count(rot_long_at *at, int quantity, rot_kind kind, int64_t key, uint64_t max,
                    uint64_t *value) {
  double x = (double)*value;
  rot_long_number(at, quantity, kind, key, &x);
  if (at->read && !at->bad && !rot_long_whole(x, max, value)) at->bad = 1;
}
