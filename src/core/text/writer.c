#include "text/writer.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "ground/text.h"

static int room_for(rot_writer *to, size_t more) {
  if (to->failed) return 0;
  if (to->length + more + 1 > to->room) {
    const size_t room = 2 * (to->length + more + 64);
    char *text = realloc(to->text, room);
    if (!text) {
      to->failed = 1;
      return 0;
    }
    to->text = text;
    to->room = room;
  }
  return 1;
}

void rot_write(rot_writer *to, const char *format, ...) {
  va_list list;
  va_start(list, format);
  const int n = vsnprintf(NULL, 0, format, list);
  va_end(list);
  if (n < 0 || !room_for(to, (size_t)n)) return;
  va_start(list, format);
  (void)vsnprintf(to->text + to->length, (size_t)n + 1, format, list);
  va_end(list);
  to->length += (size_t)n;
}

void rot_write_string(rot_writer *to, const char *text) {
  if (!text) {
    rot_write(to, "null");
  } else if (room_for(to, 6 * strlen(text) + 3)) {
    to->length += rot_text_string(text, to->text + to->length);
    to->text[to->length] = '\0';
  }
}

void rot_write_number(rot_writer *to, double x) {
  char text[ROT_TEXT_SIZE];
  (void)rot_text_number(x, text);
  rot_write(to, "%s", isnan(x) ? "null" : isinf(x) ? (x > 0.0 ? "1e999" : "-1e999") : text);
}
