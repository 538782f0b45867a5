#include "json.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- reading --------------------------------------------------------------------------------- */

enum { MAX_DEPTH = 40 };

typedef struct reader {
  const char *at;
  int depth;
} reader;

void lab_json_free(lab_node *node) {
  while (node) {
    lab_node *next = node->next;
    lab_json_free(node->first);
    free(node->text);
    free(node->key);
    free(node);
    node = next;
  }
}

static void blanks(reader *r) { r->at += strspn(r->at, " \t\r\n"); }

static int digits(const char **at) {
  const size_t n = strspn(*at, "0123456789");
  *at += n;
  return n > 0;
}

/* The grammar of RFC 8259: strtod() takes more. */
static int number_ends(const char *from, const char **end) {
  const char *at = from + (*from == '-');
  if (*at == '0' ? (at++, 0) : !digits(&at)) return 0;
  if (*at == '.') {
    at++;
    if (!digits(&at)) return 0;
  }
  if (*at == 'e' || *at == 'E') {
    at++;
    at += *at == '+' || *at == '-';
    if (!digits(&at)) return 0;
  }
  *end = at;
  return 1;
}

static int hex4(const char *at, unsigned *code) {
  *code = 0;
  for (int i = 0; i < 4; i++) {
    const char *place = at[i] ? strchr("0123456789abcdefABCDEF", at[i]) : NULL;
    if (!place) return 0;
    const unsigned value = (unsigned)(place - "0123456789abcdefABCDEF");
    *code = 16 * *code + (value < 16 ? value : value - 6);
  }
  return 1;
}

static char *utf8(char *to, unsigned code) {
  if (code < 0x80) {
    *to++ = (char)code;
  } else if (code < 0x800) {
    *to++ = (char)(0xC0 | code >> 6);
    *to++ = (char)(0x80 | (code & 0x3F));
  } else if (code < 0x10000) {
    *to++ = (char)(0xE0 | code >> 12);
    *to++ = (char)(0x80 | (code >> 6 & 0x3F));
    *to++ = (char)(0x80 | (code & 0x3F));
  } else {
    *to++ = (char)(0xF0 | code >> 18);
    *to++ = (char)(0x80 | (code >> 12 & 0x3F));
    *to++ = (char)(0x80 | (code >> 6 & 0x3F));
    *to++ = (char)(0x80 | (code & 0x3F));
  }
  return to;
}

/* "\uXXXX", a pair of surrogates included => the character; 0: none. */
static unsigned escaped(reader *r) {
  unsigned code, low;
  if (!hex4(r->at, &code)) return 0;
  r->at += 4;
  if (code >= 0xD800 && code < 0xDC00) {
    if (r->at[0] != '\\' || r->at[1] != 'u' || !hex4(r->at + 2, &low) || low < 0xDC00 ||
        low > 0xDFFF) {
      return 0;
    }
    r->at += 6;
    return 0x10000 + ((code - 0xD800) << 10) + (low - 0xDC00);
  }
  return code >= 0xDC00 && code < 0xE000 ? 0 : code;
}

static char *read_string(reader *r) {
  if (*r->at != '"') return NULL;
  r->at++;
  const char *end = r->at;
  while (*end && *end != '"') end += *end == '\\' && end[1] ? 2 : 1;
  /* No escape is shorter than what it stands for. */
  char *text = *end ? malloc((size_t)(end - r->at) + 1) : NULL, *to = text;
  if (!text) return NULL;
  while (r->at < end) {
    const char c = *r->at++;
    if ((unsigned char)c < 0x20) break;
    if (c != '\\') {
      *to++ = c;
      continue;
    }
    const char e = *r->at++;
    const char *place = strchr("\"\\/bfnrt", e);
    if (place) {
      *to++ = "\"\\/\b\f\n\r\t"[place - "\"\\/bfnrt"];
      continue;
    }
    const unsigned code = e == 'u' ? escaped(r) : 0;
    if (!code) break;
    to = utf8(to, code);
  }
  *to = '\0';
  if (r->at != end) {
    free(text);
    return NULL;
  }
  r->at++;
  return text;
}

static lab_node *read_value(reader *r);

/* The members of an object or the items of an array, behind its bracket. */
static int read_members(reader *r, lab_node *in, char end) {
  lab_node **to = &in->first;
  blanks(r);
  if (*r->at == end) return r->at++, 1;
  for (;;) {
    char *key = NULL;
    blanks(r);
    if (in->kind == LAB_OBJECT) {
      key = read_string(r);
      blanks(r);
      const int fine = key && *r->at == ':';
      for (const lab_node *one = in->first; one && fine; one = one->next) {
        if (strcmp(one->key, key) == 0) return free(key), 0;
      }
      if (!fine) return free(key), 0;
      r->at++;
    }
    lab_node *node = read_value(r);
    if (!node) return free(key), 0;
    node->key = key;
    *to = node;
    to = &node->next;
    in->n++;
    blanks(r);
    if (*r->at == end) return r->at++, 1;
    if (*r->at != ',') return 0;
    r->at++;
  }
}

static int read_word(reader *r, const char *word) {
  const size_t n = strlen(word);
  if (strncmp(r->at, word, n) != 0) return 0;
  r->at += n;
  return 1;
}

static int read_into(reader *r, lab_node *node) {
  const char *end;
  switch (*r->at) {
  case '{':
  case '[':
    node->kind = *r->at == '{' ? LAB_OBJECT : LAB_ARRAY;
    r->at++;
    return read_members(r, node, node->kind == LAB_OBJECT ? '}' : ']');
  case '"': node->kind = LAB_STRING; return (node->text = read_string(r)) != NULL;
  case 'n': return read_word(r, "null");
  case 't':
    node->number = 1.0;
    node->kind = LAB_BOOLEAN;
    return read_word(r, "true");
  case 'f': node->kind = LAB_BOOLEAN; return read_word(r, "false");
  default: break;
  }
  if (!number_ends(r->at, &end)) return 0;
  node->kind = LAB_NUMBER;
  node->number = strtod(r->at, NULL);
  r->at = end;
  return 1;
}

static lab_node *read_value(reader *r) {
  lab_node *node = r->depth < MAX_DEPTH ? calloc(1, sizeof *node) : NULL;
  if (!node) return NULL;
  blanks(r);
  r->depth++;
  const int fine = read_into(r, node);
  r->depth--;
  if (fine) return node;
  lab_json_free(node);
  return NULL;
}

lab_node *lab_json_read(const char *text) {
  reader r = {text, 0};
  lab_node *node = read_value(&r);
  blanks(&r);
  if (!node || *r.at == '\0') return node;
  lab_json_free(node);
  return NULL;
}

/* ---- writing --------------------------------------------------------------------------------- */

static int room_for(lab_text *to, size_t more) {
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

void lab_text_add(lab_text *to, const char *format, ...) {
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

void lab_text_string(lab_text *to, const char *text) {
  if (!text) {
    lab_text_add(to, "null");
    return;
  }
  lab_text_add(to, "\"");
  for (; *text; text++) {
    const unsigned char c = (unsigned char)*text;
    if (c == '"' || c == '\\') {
      lab_text_add(to, "\\%c", c);
    } else if (c < 0x20) {
      lab_text_add(to, "\\u%04x", c);
    } else {
      lab_text_add(to, "%c", c);
    }
  }
  lab_text_add(to, "\"");
}

void lab_shortest(double x, char to[32]) {
  if (isnan(x)) {
    (void)snprintf(to, 32, "NaN");
  } else if (isinf(x)) {
    (void)snprintf(to, 32, x > 0.0 ? "Inf" : "-Inf");
  } else {
    for (int places = 15; places <= 17; places++) {
      (void)snprintf(to, 32, "%.*g", places, x);
      if (strtod(to, NULL) == x) break;
    }
  }
}

void lab_text_number(lab_text *to, double x) {
  char text[32];
  lab_shortest(x, text);
  lab_text_add(to, "%s", isnan(x) ? "null" : isinf(x) ? (x > 0.0 ? "1e999" : "-1e999") : text);
}
