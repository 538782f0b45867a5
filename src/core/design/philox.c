#include "design/philox.h"

/* Ten rounds; the key is raised between them. */
static inline void rounds(uint32_t c[4], uint32_t k0, uint32_t k1) {
  for (int round = 0; round < 10; round++) {
    const uint64_t a = (uint64_t)0xD2511F53u * c[0], b = (uint64_t)0xCD9E8D57u * c[2];
    c[0] = (uint32_t)(b >> 32) ^ c[1] ^ k0;
    c[1] = (uint32_t)b;
    c[2] = (uint32_t)(a >> 32) ^ c[3] ^ k1;
    c[3] = (uint32_t)a;
    k0 += 0x9E3779B9u;
    k1 += 0xBB67AE85u;
  }
}

void rot_philox(const uint32_t counter[4], const uint32_t key[2], uint32_t out[4]) {
  uint32_t c[4] = {counter[0], counter[1], counter[2], counter[3]};
  rounds(c, key[0], key[1]);
  for (int i = 0; i < 4; i++) out[i] = c[i];
}

static inline void row_words(uint64_t seed, uint64_t row, uint32_t pair, rot_stream stream,
                             uint64_t out[2]) {
  uint32_t c[4] = {(uint32_t)row, (uint32_t)(row >> 32), pair, (uint32_t)stream};
  rounds(c, (uint32_t)seed, (uint32_t)(seed >> 32));
  out[0] = (uint64_t)c[1] << 32 | c[0];
  out[1] = (uint64_t)c[3] << 32 | c[2];
}

void rot_philox_row(uint64_t seed, uint64_t row, uint32_t pair, rot_stream stream,
                    uint64_t out[2]) {
  row_words(seed, row, pair, stream, out);
}

void rot_philox_columns(uint64_t seed, uint64_t first, size_t n, uint32_t pair, rot_stream stream,
                        double even[], double odd[]) {
  for (size_t i = 0; i < n; i++) {
    uint64_t words[2];
    row_words(seed, first + i, pair, stream, words);
    if (even) even[i] = rot_unit(words[0]);
    if (odd) odd[i] = rot_unit(words[1]);
  }
}
