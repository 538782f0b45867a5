#include "ground/text.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

int rot_text_number(double x, char text[ROT_TEXT_SIZE]) { return rot_text_digits(x, 15, text); }

int rot_text_digits(double x, int digits, char text[ROT_TEXT_SIZE]) {
  if (!isfinite(x)) {
    strcpy(text, isnan(x) ? "NaN" : x > 0.0 ? "Inf" : "-Inf");
  } else if (x == 0.0) {
    strcpy(text, signbit(x) ? "-0.0" : "0");
  } else {
    for (; digits <= 17; digits++) {
      snprintf(text, ROT_TEXT_SIZE, "%.*g", digits, x);
      if (digits == 17 || strtod(text, NULL) == x) break;
    }
    /* Replaces the locale's decimal point, which strtod() above needed. */
    char *point = text + strcspn(text, "0123456789") + 1;
    const size_t other = strcspn(point, "0123456789e");
    if (other > 0 && *point != '.') {
      *point = '.';
      memmove(point + 1, point + other, strlen(point + other) + 1);
    }
  }
  return (int)strlen(text);
}

size_t rot_text_string(const char *string, char *text) {
  static const char escapes[] = "\"\"\\\\\nn\rr\tt"; /* pairs: a character, its escape letter */
  char *at = text;
  *at++ = '"';
  for (; *string != '\0'; string++) {
    const char *escape = escapes;
    while (*escape != '\0' && *escape != *string) escape += 2;
    if (*escape != '\0') {
      *at++ = '\\';
      *at++ = escape[1];
    } else if ((unsigned char)*string < 0x20) {
      at += snprintf(at, 7, "\\u%04x", (unsigned)*string);
    } else {
      *at++ = *string;
    }
  }
  *at++ = '"';
  *at = '\0';
  return (size_t)(at - text);
}
