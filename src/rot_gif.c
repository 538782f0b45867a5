#include "rot_gif.h"

#include <string.h>

/* 8192 places for at most 4096 strings, each a string and a pixel more. */
enum { PLACES = 8192, CODES = 4096, BLOCK = 255 };

/* Codes to bits, lowest first, in blocks with their length before them. */
typedef struct writer {
  unsigned char *out;
  size_t size, length_at; /* of the block that is being filled */
  unsigned long held;
  int held_bits;
} writer;

static void put_byte(writer *w, unsigned char byte) {
  if (w->size - w->length_at > BLOCK) {
    w->length_at = w->size++;
    w->out[w->length_at] = 0;
  }
  w->out[w->size++] = byte;
  w->out[w->length_at]++;
}

static void put_code(writer *w, int code, int width) {
  w->held |= (unsigned long)code << w->held_bits;
  for (w->held_bits += width; w->held_bits >= 8; w->held_bits -= 8) {
    put_byte(w, (unsigned char)(w->held & 255));
    w->held >>= 8;
  }
}

typedef struct strings {
  long key[PLACES]; /* string before times 256 plus pixel; -1: empty */
  short code[PLACES];
} strings;

static size_t place_of(const strings *s, long key) {
  size_t at = (size_t)(key * 40503L) % PLACES;
  while (s->key[at] != -1 && s->key[at] != key) at = (at + 1) % PLACES;
  return at;
}

static void forget(strings *s) {
  for (size_t i = 0; i < PLACES; i++) s->key[i] = -1;
}

/* 12 bits a pixel, codes to clear, the lengths of blocks, and what begins and ends. */
size_t rot_gif_most(size_t n) {
  const size_t bytes = n + n / 2 + n / 1024 + 16;
  return bytes + bytes / BLOCK + 16;
}

size_t rot_gif_pack(const unsigned char pixel[], size_t n, int bits, unsigned char out[]) {
  const int clear = 1 << bits, end = clear + 1;
  writer w = {.out = out, .size = 2, .length_at = 1};
  strings s;
  int next = end + 1, width = bits + 1;
  out[0] = (unsigned char)bits;
  out[1] = 0;
  forget(&s);
  put_code(&w, clear, width);
  for (size_t i = 0; i < n;) {
    int code = pixel[i++];
    for (; i < n; i++) {
      const long key = (long)code * 256 + pixel[i];
      const size_t at = place_of(&s, key);
      if (s.key[at] == -1) {
        put_code(&w, code, width);
        s.key[at] = key;
        s.code[at] = (short)next;
        /* A reader knows the new string one code later: the width grows after it. */
        if (next == 1 << width) width++;
        next++;
        break;
      }
      code = s.code[at];
    }
    if (i == n) {
      put_code(&w, code, width);
      if (next == 1 << width && width < 12) width++;
    } else if (next == CODES) {
      put_code(&w, clear, width);
      forget(&s);
      next = end + 1;
      width = bits + 1;
    }
  }
  put_code(&w, end, width);
  if (w.held_bits) put_byte(&w, (unsigned char)(w.held & 255));
  out[w.size++] = 0;
  return w.size;
}
