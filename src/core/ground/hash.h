/* XXH128, that is XXH3 with 128 bits, without a seed: the fingerprint of texts and results. */
#ifndef ROT_HASH_H
#define ROT_HASH_H

#include <stddef.h>

#include "ground/ieee.h"

#define ROT_HASH_SIZE 33 /* 32 hexadecimal digits, with the end */

/* n bytes => 32 hexadecimal digits, the higher half first, as xxhsum -H2 prints them. Independent
 * of the byte order of the machine. */
void rot_hash(const unsigned char *bytes, size_t n, char hash[ROT_HASH_SIZE]);

#endif
