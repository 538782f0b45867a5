#include "summary/buckets.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
  PART = 256,         /* buckets of an octave */
  SUBNORMAL = 52,     /* octaves of subnormal numbers */
  OCTAVES = 2046 + 52 /* of one sign */
};

static uint64_t bits_of(double x) {
  uint64_t bits;
  memcpy(&bits, &x, sizeof bits);
  return bits;
}

static double double_of(uint64_t bits) {
  double x;
  memcpy(&x, &bits, sizeof x);
  return x;
}

/* Bucket of a positive number or 0 by its bits. For subnormal numbers the number of significant
 * bits takes the place of the exponent. */
static int32_t bucket_of_bits(uint64_t bits) {
  if (bits >> 52) return (int32_t)(bits >> 44) + SUBNORMAL * PART;
  int length = 0;
  while (bits >> length) length++;
  if (length == 0) return 0;
  const uint64_t lead = length > 9 ? bits >> (length - 9) : bits << (9 - length);
  return length * PART + (int32_t)(lead & (PART - 1));
}

int32_t rot_bucket_of(double x) {
  const uint64_t bits = bits_of(x);
  const int32_t bucket = bucket_of_bits(bits & (UINT64_MAX >> 1));
  return bits >> 63 ? -bucket : bucket;
}

int rot_bucket_limits(int64_t bucket, double *low, double *high) {
  if (bucket < 0) {
    double smallest, largest;
    if (bucket < -INT32_MAX || !rot_bucket_limits(-bucket, &smallest, &largest)) return 0;
    *low = -largest;
    *high = -smallest;
    return 1;
  }
  if (bucket == 0) {
    *low = -0.0;
    *high = 0.0;
    return 1;
  }
  const int64_t octave = bucket / PART;
  if (octave < 1 || octave > OCTAVES) return 0;
  if (octave > SUBNORMAL) {
    const uint64_t bits = (uint64_t)(bucket - SUBNORMAL * PART) << 44;
    *low = double_of(bits);
    *high = double_of(bits | (((uint64_t)1 << 44) - 1));
    return 1;
  }
  const uint64_t lead = PART | (uint64_t)(bucket % PART);
  const int more = (int)octave - 9; /* bits beyond the leading nine */
  if (more < 0) {
    if (lead & (((uint64_t)1 << -more) - 1)) return 0;
    *low = *high = double_of(lead >> -more);
    return 1;
  }
  *low = double_of(lead << more);
  *high = double_of(lead << more | (((uint64_t)1 << more) - 1));
  return 1;
}

/* A circle: `later` of a histogram is the last one, `next` of that the first one. Codes of values:
 * their place in a counter, below. */
struct rot_bucket_values {
  rot_bucket_values *next;
  size_t n;
  uint32_t code[];
};

static void free_later(rot_buckets *buckets) {
  if (!buckets->later) return;
  rot_bucket_values *next = buckets->later->next;
  buckets->later->next = NULL;
  while (next) {
    rot_bucket_values *old = next;
    next = old->next;
    free(old);
  }
  buckets->later = NULL;
}

void rot_buckets_free(rot_buckets *buckets) {
  free_later(buckets);
  free(buckets->at);
  *buckets = (rot_buckets){0, NULL, NULL};
}

/* A block of memory also for n = 0, so that NULL says that there is none. */
static rot_status room_for(rot_buckets *buckets, size_t n) {
  *buckets = (rot_buckets){0, NULL, NULL};
  if (n > SIZE_MAX / sizeof *buckets->at - 1) return ROT_ENOMEM;
  buckets->at = malloc((n + 1) * sizeof *buckets->at);
  return buckets->at ? ROT_OK : ROT_ENOMEM;
}

rot_status rot_buckets_add(const rot_buckets *a, const rot_buckets *b, rot_buckets *sum) {
  if (room_for(sum, a->n + b->n) != ROT_OK) return ROT_ENOMEM;
  size_t i = 0, k = 0, n = 0;
  while (i < a->n && k < b->n) {
    const rot_bucket left = a->at[i], right = b->at[k];
    rot_bucket *to = &sum->at[n++];
    *to = left.bucket <= right.bucket ? left : right;
    if (left.bucket == right.bucket) to->count += right.count;
    i += left.bucket <= right.bucket;
    k += right.bucket <= left.bucket;
  }
  while (i < a->n) sum->at[n++] = a->at[i++];
  while (k < b->n) sum->at[n++] = b->at[k++];
  sum->n = n;
  return ROT_OK;
}

/* ---- counting -------------------------------------------------------------------------------- */

/* Each octave in use has a page of 256 counts. Normal numbers find it by sign and exponent; zero
 * and subnormal numbers, whose exponent field is 0, by slots behind these. Page 0 stands for no
 * page, so slots 0 and 2048 lead to the slow branch. */
enum { EXPONENTS = 4096, ZERO = 64, SLOTS = EXPONENTS + 2 * ZERO };

struct rot_bucket_counter {
  uint16_t page[SLOTS];
  size_t pages, room; /* page 0 included */
  uint32_t *count;
};

rot_bucket_counter *rot_bucket_counter_new(void) {
  rot_bucket_counter *counter = calloc(1, sizeof *counter);
  if (!counter) return NULL;
  counter->pages = 1;
  counter->room = 32;
  counter->count = calloc(counter->room * PART, sizeof *counter->count);
  if (counter->count) return counter;
  free(counter);
  return NULL;
}

void rot_bucket_counter_free(rot_bucket_counter *counter) {
  if (counter) free(counter->count);
  free(counter);
}

/* => code of the number with those bits: 256 slot + part of its octave, a normal number's leading
 * 20 bits */
static uint32_t code_of(uint64_t bits) {
  const uint64_t size = bits & (UINT64_MAX >> 1);
  if (size >> 52) return (uint32_t)(bits >> 44);
  const int32_t bucket = bucket_of_bits(size);
  return (uint32_t)(EXPONENTS * PART + bucket) + (size && bits >> 63 ? ZERO * PART : 0);
}

/* => count of a code, in a new page if need be; NULL: no memory */
static uint32_t *find(rot_bucket_counter *counter, uint32_t code) {
  const size_t slot = code / PART;
  if (!counter->page[slot]) {
    if (counter->pages == counter->room) {
      const size_t old = counter->room * PART;
      uint32_t *more = realloc(counter->count, 2 * old * sizeof *more);
      if (!more) return NULL;
      memset(more + old, 0, old * sizeof *more);
      counter->count = more;
      counter->room *= 2;
    }
    counter->page[slot] = (uint16_t)counter->pages++;
  }
  return &counter->count[(size_t)counter->page[slot] * PART + code % PART];
}

rot_status rot_bucket_counter_add(rot_bucket_counter *counter, size_t n, const double x[]) {
  uint32_t *count = counter->count;
  for (size_t i = 0; i < n; i++) {
    const uint64_t bits = bits_of(x[i]);
    const size_t page = counter->page[bits >> 52];
    if (page) {
      count[page * PART + (size_t)(bits >> 44) % PART]++;
      continue;
    }
    uint32_t *to = find(counter, code_of(bits));
    if (!to) return ROT_ENOMEM;
    (*to)++;
    count = counter->count;
  }
  return ROT_OK;
}

/* The page of a slot, if it has one: its counts in the order of the values. */
static void take_slot(rot_bucket_counter *counter, size_t slot, int64_t octave, int negative,
                      rot_buckets *to) {
  const size_t page = counter->page[slot];
  if (!page) return;
  uint32_t *count = counter->count + page * PART;
  for (int i = 0; i < PART; i++) {
    const int part = negative ? PART - 1 - i : i;
    if (!count[part]) continue;
    const int32_t bucket = (int32_t)octave * PART + part;
    to->at[to->n++] = (rot_bucket){negative ? -bucket : bucket, count[part]};
  }
  memset(count, 0, PART * sizeof *count);
  counter->page[slot] = 0;
}

rot_status rot_bucket_counter_take(rot_bucket_counter *counter, rot_buckets *buckets) {
  size_t n = 0;
  for (size_t i = PART; i < counter->pages * PART; i++) n += counter->count[i] > 0;
  if (room_for(buckets, n) != ROT_OK) return ROT_ENOMEM;
  const size_t zero = EXPONENTS, negative = EXPONENTS / 2;
  for (size_t e = negative - 1; e > 0; e--) {
    take_slot(counter, negative + e, (int64_t)e + SUBNORMAL, 1, buckets);
  }
  for (size_t e = SUBNORMAL; e > 0; e--) {
    take_slot(counter, zero + ZERO + e, (int64_t)e, 1, buckets);
  }
  for (size_t e = 0; e <= SUBNORMAL; e++) take_slot(counter, zero + e, (int64_t)e, 0, buckets);
  for (size_t e = 1; e < negative; e++) take_slot(counter, e, (int64_t)e + SUBNORMAL, 0, buckets);
  counter->pages = 1;
  return ROT_OK;
}

/* ---- values for later ------------------------------------------------------------------------ */

rot_status rot_buckets_later(rot_buckets *buckets, size_t n, const double x[]) {
  if (n == 0) return ROT_OK;
  rot_bucket_values *values = malloc(sizeof *values + n * sizeof values->code[0]);
  if (!values) return ROT_ENOMEM;
  for (size_t i = 0; i < n; i++) values->code[i] = code_of(bits_of(x[i]));
  values->n = n;
  values->next = values;
  rot_buckets more = {0, NULL, values};
  rot_buckets_move(buckets, &more);
  return ROT_OK;
}

void rot_buckets_move(rot_buckets *into, rot_buckets *from) {
  if (!from->later) return;
  if (into->later) {
    rot_bucket_values *first = into->later->next;
    into->later->next = from->later->next;
    from->later->next = first;
  }
  into->later = from->later;
  from->later = NULL;
}

static rot_status count_codes(rot_bucket_counter *counter, size_t n, const uint32_t code[]) {
  for (size_t i = 0; i < n; i++) {
    const size_t page = counter->page[code[i] / PART];
    uint32_t *to = page ? &counter->count[page * PART + code[i] % PART] : find(counter, code[i]);
    if (!to) return ROT_ENOMEM;
    (*to)++;
  }
  return ROT_OK;
}

static rot_status count_later(rot_buckets *buckets, rot_bucket_counter *counter) {
  const rot_bucket_values *values = buckets->later;
  rot_buckets counted = {0, NULL, NULL}, sum;
  do {
    values = values->next;
    if (count_codes(counter, values->n, values->code) != ROT_OK) return ROT_ENOMEM;
  } while (values != buckets->later);
  if (rot_bucket_counter_take(counter, &counted) != ROT_OK) return ROT_ENOMEM;
  if (buckets->n > 0) {
    const rot_status status = rot_buckets_add(buckets, &counted, &sum);
    rot_buckets_free(&counted);
    if (status != ROT_OK) return status;
    counted = sum;
  }
  rot_buckets_free(buckets);
  *buckets = counted;
  return ROT_OK;
}

rot_status rot_buckets_count(rot_buckets *buckets, rot_bucket_counter *counter) {
  if (!buckets->later) return ROT_OK;
  rot_bucket_counter *own = counter ? NULL : rot_bucket_counter_new();
  if (!counter && !own) return ROT_ENOMEM;
  const rot_status status = count_later(buckets, counter ? counter : own);
  rot_bucket_counter_free(own);
  return status;
}
