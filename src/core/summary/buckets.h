/* Histogram of finite doubles on their leading bits: 256 buckets to an octave, one for zero. Counts
 * are exact, and histograms of parts add up to that of the whole in any order.
 *
 * The bucket of x > 0, with x = 2^e (1 + f), -1074 <= e <= 1023, is 256 (e + 1075) + floor(256 f),
 * an integer from 256 to 537,343; that of -x is its negative; that of 0 and of -0 is 0. Buckets are
 * in the order of the values. The largest value of a bucket exceeds the smallest by less than 2^-8
 * of it, subnormal numbers included. */
#ifndef ROT_BUCKETS_H
#define ROT_BUCKETS_H

#include <stddef.h>
#include <stdint.h>

#include "ground/status.h"

typedef struct rot_bucket {
  int32_t bucket;
  uint64_t count; /* > 0 */
} rot_bucket;

/* Values to be counted later. */
typedef struct rot_bucket_values rot_bucket_values;

/* The buckets in use, in increasing order, and values that are not in them yet. Begin with {0}. */
typedef struct rot_buckets {
  size_t n;
  rot_bucket *at;
  rot_bucket_values *later; /* NULL: none */
} rot_buckets;

/* finite x => bucket */
int32_t rot_bucket_of(double x);
/* bucket => smallest and largest double in it (of 0: -0 and 0); 0 if there is no such bucket, else
 * 1 */
int rot_bucket_limits(int64_t bucket, double *low, double *high);

void rot_buckets_free(rot_buckets *buckets);
/* (a, b) => *sum, new memory; a and b have no values for later. ROT_ENOMEM leaves it {0}. */
rot_status rot_buckets_add(const rot_buckets *a, const rot_buckets *b, rot_buckets *sum);

/* Counts of one column, for values that come in pieces: memory for the octaves in use only. */
typedef struct rot_bucket_counter rot_bucket_counter;

/* NULL: no memory. */
rot_bucket_counter *rot_bucket_counter_new(void);
void rot_bucket_counter_free(rot_bucket_counter *counter);
/* Counts n finite values; at most 2^32 - 1 in all. After ROT_ENOMEM: free the counter. */
rot_status rot_bucket_counter_add(rot_bucket_counter *counter, size_t n, const double x[]);
/* => histogram, new memory; the counter is empty then. After ROT_ENOMEM: free the counter. */
rot_status rot_bucket_counter_take(rot_bucket_counter *counter, rot_buckets *buckets);

/* The histogram of a few values takes longer than the values: those of small blocks are joined as
 * they are and counted together. Takes n finite values to be counted later; ROT_ENOMEM changes
 * nothing. */
rot_status rot_buckets_later(rot_buckets *buckets, size_t n, const double x[]);
/* Moves the values for later of `from` to those of `into`. */
void rot_buckets_move(rot_buckets *into, rot_buckets *from);
/* Counts the values for later; at most 2^32 - 1. `counter` is empty, or NULL for one of its own.
 * ROT_ENOMEM changes nothing; a counter of the caller's is then to be freed. */
rot_status rot_buckets_count(rot_buckets *buckets, rot_bucket_counter *counter);

#endif
