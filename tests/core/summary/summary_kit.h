/* Shared by the tests of src/core/summary: random numbers, rows of a sweep, the long form of a
 * summary and its hash. */
#ifndef SUMMARY_KIT_H
#define SUMMARY_KIT_H

#include "ground/hash.h"
#include "rot_test.h"
#include "summary/long.h"

/* Rows of a block: the smallest, one between, the largest. */
enum { KIT_SIZES = 3, KIT_NO_SIZES = 9 };
static const uint64_t kit_block_rows[KIT_SIZES] = {256, 4096, 65536};

/* Numbers that no block has. */
static const uint64_t kit_no_block_rows[KIT_NO_SIZES] = {0,   1,     128,    255,       257,
                                                         768, 65535, 131072, UINT64_MAX};

/* splitmix64: a state of its own for each use. */
static inline uint64_t kit_bits(uint64_t *state) {
  uint64_t z = (*state += 0x9e3779b97f4a7c15u);
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return z ^ (z >> 31);
}

static inline double kit_uniform(uint64_t *state) {
  return ((double)(kit_bits(state) >> 11) + 0.5) * 0x1p-53;
}

static inline double kit_normal(uint64_t *state) {
  const double r = sqrt(-2.0 * log(kit_uniform(state)));
  return r * cos(6.283185307179586 * kit_uniform(state));
}

static inline size_t kit_below(uint64_t *state, size_t n) { return (size_t)(kit_bits(state) % n); }

/* n rows of the long form in one allocation, a multiple of eight bytes each. */
typedef struct kit_table {
  size_t n;
  rot_long rows;
} kit_table;

static inline kit_table kit_table_new(size_t n) {
  kit_table table = {n, {NULL, NULL, NULL, NULL}};
  table.rows.quantity = calloc(n + 1, sizeof(int));
  table.rows.kind = calloc(n + 1, sizeof(int));
  table.rows.key = calloc(n + 1, sizeof(int64_t));
  table.rows.value = calloc(n + 1, sizeof(double));
  return table;
}

static inline void kit_table_free(kit_table *table) {
  free(table->rows.quantity);
  free(table->rows.kind);
  free(table->rows.key);
  free(table->rows.value);
}

static inline void kit_table_copy(const kit_table *from, kit_table *to) {
  *to = kit_table_new(from->n);
  memcpy(to->rows.quantity, from->rows.quantity, from->n * sizeof(int));
  memcpy(to->rows.kind, from->rows.kind, from->n * sizeof(int));
  memcpy(to->rows.key, from->rows.key, from->n * sizeof(int64_t));
  memcpy(to->rows.value, from->rows.value, from->n * sizeof(double));
}

static inline int kit_same(const kit_table *a, const kit_table *b) {
  return a->n == b->n && memcmp(a->rows.quantity, b->rows.quantity, a->n * sizeof(int)) == 0 &&
         memcmp(a->rows.kind, b->rows.kind, a->n * sizeof(int)) == 0 &&
         memcmp(a->rows.key, b->rows.key, a->n * sizeof(int64_t)) == 0 &&
         memcmp(a->rows.value, b->rows.value, a->n * sizeof(double)) == 0;
}

/* Sorted by quantity, kind, key, none twice, all kinds known. */
static inline int kit_sorted(const kit_table *t) {
  const rot_long *r = &t->rows;
  for (size_t i = 0; i < t->n; i++) {
    if (!rot_kind_name(r->kind[i])) return 0;
    if (i == 0) continue;
    const int q = (r->quantity[i] > r->quantity[i - 1]) - (r->quantity[i] < r->quantity[i - 1]);
    const int k = (r->kind[i] > r->kind[i - 1]) - (r->kind[i] < r->kind[i - 1]);
    if (q < 0 || (q == 0 && k < 0)) return 0;
    if (q == 0 && k == 0 && r->key[i] <= r->key[i - 1]) return 0;
  }
  return 1;
}

typedef struct kit_row {
  int quantity, kind;
  int64_t key;
  double value;
} kit_row;

/* The rows that files have. */
static inline int kit_is(const kit_table *t, size_t n, const kit_row want[]) {
  int same = t->n == n;
  for (size_t i = 0; same && i < n; i++) {
    same = t->rows.quantity[i] == want[i].quantity && t->rows.kind[i] == want[i].kind &&
           t->rows.key[i] == want[i].key && t->rows.value[i] == want[i].value;
    if (!same) {
      printf("row %d: %d %d %lld %.17g\n", (int)i, t->rows.quantity[i], t->rows.kind[i],
             (long long)t->rows.key[i], t->rows.value[i]);
    }
  }
  return same;
}

/* One damage of many kinds. */
static inline void kit_damage(uint64_t *state, kit_table *t) {
  static const double odd[] = {-1.0, 0.5, NAN, INFINITY, -INFINITY, -0.0, 0.0, 1e300, 0x1p53, 1.0};
  static const int64_t keys[] = {0,     1,     -1,     INT64_MAX, INT64_MIN,
                                 65535, 65536, 537344, 255,       1 << 20};
  const size_t i = kit_below(state, t->n), k = kit_below(state, t->n);
  rot_long *r = &t->rows;
  uint64_t bits;
  switch (kit_below(state, 12)) {
  case 0: r->value[i] = odd[kit_below(state, 10)]; break;
  case 1: r->key[i] = keys[kit_below(state, 10)]; break;
  case 2: r->kind[i] = (int)kit_below(state, 260) - 10; break;
  case 3: r->quantity[i] = (int)kit_below(state, 6) - 2; break;
  case 4: r->value[i] += (double)kit_below(state, 5) - 2.0; break;
  case 5: r->key[i] += (int64_t)kit_below(state, 5) - 2; break;
  case 6: t->n = kit_below(state, t->n); break;
  case 7: /* two rows exchanged, each column or all */
  {
    const rot_long old = {&r->quantity[i], &r->kind[i], &r->key[i], &r->value[i]};
    const int quantity = *old.quantity, kind = *old.kind;
    const int64_t key = *old.key;
    const double value = *old.value;
    r->quantity[i] = r->quantity[k];
    r->kind[i] = r->kind[k];
    r->key[i] = r->key[k];
    r->value[i] = r->value[k];
    r->quantity[k] = quantity;
    r->kind[k] = kind;
    r->key[k] = key;
    r->value[k] = value;
    break;
  }
  case 8: /* a row twice in place of its neighbour */
    if (i + 1 < t->n) {
      r->quantity[i + 1] = r->quantity[i];
      r->kind[i + 1] = r->kind[i];
      r->key[i + 1] = r->key[i];
      r->value[i + 1] = r->value[i];
    }
    break;
  case 9: /* a row lost */
    for (size_t j = i; j + 1 < t->n; j++) {
      r->quantity[j] = r->quantity[j + 1];
      r->kind[j] = r->kind[j + 1];
      r->key[j] = r->key[j + 1];
      r->value[j] = r->value[j + 1];
    }
    t->n--;
    break;
  case 10: /* one bit of a value */
    memcpy(&bits, &r->value[i], sizeof bits);
    bits ^= (uint64_t)1 << kit_below(state, 64);
    memcpy(&r->value[i], &bits, sizeof bits);
    break;
  default: r->key[i] = (int64_t)kit_bits(state); break;
  }
}

/* Hash of all bits of a long form. */
static inline void kit_hash(const kit_table *t, char hash[ROT_HASH_SIZE]) {
  unsigned char *bytes = malloc(t->n * 24 + 1);
  size_t at = 0;
  for (size_t i = 0; i < t->n; i++) {
    memcpy(bytes + at, &t->rows.quantity[i], 4);
    memcpy(bytes + at + 4, &t->rows.kind[i], 4);
    memcpy(bytes + at + 8, &t->rows.key[i], 8);
    memcpy(bytes + at + 16, &t->rows.value[i], 8);
    at += 24;
  }
  rot_hash(bytes, at, hash);
  free(bytes);
}

#endif
