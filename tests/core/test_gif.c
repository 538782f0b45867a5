/* GIF's compression, against a reader written from the description of the format. */
#include "rot_gif.h"

#include <stdlib.h>
#include <string.h>

#include "rot_test.h"

enum { MOST = 300000 };

static unsigned char pixel[MOST], packed[2 * MOST], read_back[MOST];

/* The bytes of the blocks; *used: all that was read. */
static size_t join_blocks(const unsigned char *from, unsigned char *to, size_t *used) {
  size_t size = 0, at = 1;
  while (from[at]) {
    memcpy(to + size, from + at + 1, from[at]);
    size += from[at];
    at += from[at] + (size_t)1;
  }
  *used = at + 1;
  return size;
}

/* The number of pixels, 0 for damaged data. */
static size_t unpack(const unsigned char *from, unsigned char *to, size_t *used) {
  static unsigned char bytes[2 * MOST], last[4096];
  static int before[4096];
  const size_t size = join_blocks(from, bytes, used);
  const int bits = from[0], clear = 1 << bits;
  int width = bits + 1, next = clear + 2, old = -1;
  size_t n = 0, bit = 0;
  for (;;) {
    int code = 0;
    if (bit + (size_t)width > 8 * size) return 0;
    for (int k = 0; k < width; k++, bit++) code |= (bytes[bit / 8] >> bit % 8 & 1) << k;
    if (code == clear + 1) return n;
    if (code == clear) {
      width = bits + 1;
      next = clear + 2;
      old = -1;
      continue;
    }
    unsigned char string[4096];
    size_t length = 0;
    int at = code < next ? code : old;
    if (code > next || at < 0) return 0;
    if (code == next) length++;
    for (; at >= clear; at = before[at]) string[length++] = last[at];
    string[length++] = (unsigned char)at;
    if (code == next) string[0] = (unsigned char)at;
    if (old >= 0 && next < 4096) {
      before[next] = old;
      last[next++] = (unsigned char)at;
      if (next == 1 << width && width < 12) width++;
    }
    old = code;
    if (n + length > MOST) return 0;
    while (length) to[n++] = string[--length];
  }
}

static void check(size_t n, int bits) {
  size_t used;
  memset(packed, 99, sizeof packed);
  const size_t size = rot_gif_pack(pixel, n, bits, packed);
  ROT_CHECK(size <= rot_gif_most(n) && rot_gif_most(n) <= sizeof packed);
  ROT_CHECK(packed[size] == 99); /* nothing beyond */
  ROT_CHECK(n == unpack(packed, read_back, &used) && used == size);
  ROT_CHECK(memcmp(pixel, read_back, n) == 0);
}

static void check_sizes(void) {
  static const size_t sizes[] = {0, 1, 2, 3, 7, 254, 255, 256, 1000, 4094, 4095, 65536, MOST};
  srand(3);
  for (int bits = 2; bits <= 8; bits++) {
    for (size_t k = 0; k < sizeof sizes / sizeof *sizes; k++) {
      const size_t n = sizes[k];
      for (size_t i = 0; i < n; i++) pixel[i] = (unsigned char)(rand() % (1 << bits));
      check(n, bits); /* nothing to compress */
      for (size_t i = 0; i < n; i++) pixel[i] = (unsigned char)(i / 97 % 3);
      check(n, bits);
      memset(pixel, 1, n); /* one string longer than the last */
      check(n, bits);
    }
  }
  /* a code of 12 bits for each place where the table fills */
  for (size_t n = 3000; n < 9000; n++) {
    for (size_t i = 0; i < n; i++) pixel[i] = (unsigned char)(i * i / 7 % 251);
    if (n % 53 == 0) check(n, 8);
  }
}

/* Of M. Flickinger, What's In A GIF: 10 x 10 pixels in 4 colours. */
static void check_example(void) {
  static const char rows[10][11] = {"1111122222", "1111122222", "1111122222", "1110000222",
                                    "1110000222", "2220000111", "2220000111", "2222211111",
                                    "2222211111", "2222211111"};
  static const unsigned char want[] = {0x02, 0x16, 0x8C, 0x2D, 0x99, 0x87, 0x2A, 0x1C, 0xDC,
                                       0x33, 0xA0, 0x02, 0x75, 0xEC, 0x95, 0xFA, 0xA8, 0xDE,
                                       0x60, 0x8C, 0x04, 0x91, 0x4C, 0x01, 0x00};
  for (int i = 0; i < 100; i++) pixel[i] = (unsigned char)(rows[i / 10][i % 10] - '0');
  ROT_CHECK(rot_gif_pack(pixel, 100, 2, packed) == sizeof want);
  ROT_CHECK(memcmp(packed, want, sizeof want) == 0);
}

int main(void) {
  check_sizes();
  check_example();
  return rot_test_report("gif");
}
