#include "text/json.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_DEPTH = 40 };

typedef struct reader {
  const char *at;
  int depth;
} reader;

void rot_json_free(rot_json *node) {
  while (node) {
    rot_json *next = node->next;
    rot_json_free(node->first);
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
  static const char digit[] = "0123456789abcdefABCDEF";
  *code = 0;
  for (int i = 0; i < 4; i++) {
    const char *place = at[i] ? strchr(digit, at[i]) : NULL;
    if (!place) return 0;
    const unsigned value = (unsigned)(place - digit);
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
  static const char letter[] = "\"\\/bfnrt", stands_for[] = "\"\\/\b\f\n\r\t";
  if (*r->at != '"') return NULL;
  r->at++;
  const char *end = r->at;
  while (*end && *end != '"') end += *end == '\\' && end[1] ? 2 : 1;
  /* No escape is shorter than what it stands for. */
  char *text = *end ? malloc((size_t)(end - r->at) + 1) : NULL, *to = text;
  if (!text) return NULL;
  int fine = 1;
  while (fine && r->at < end) {
    const char c = *r->at++;
    fine = (unsigned char)c >= 0x20;
    if (c != '\\') {
      *to++ = c;
      continue;
    }
    const char e = *r->at++;
    const char *place = strchr(letter, e);
    if (place) {
      *to++ = stands_for[place - letter];
      continue;
    }
    const unsigned code = e == 'u' ? escaped(r) : 0;
    fine = code != 0 && r->at <= end;
    if (fine) to = utf8(to, code);
  }
  *to = '\0';
  if (!fine) {
    free(text);
    return NULL;
  }
  r->at++;
  return text;
}

static rot_json *read_value(reader *r);

/* The members of an object or the items of an array, behind its bracket. */
static int read_members(reader *r, rot_json *in, char end) {
  rot_json **to = &in->first;
  blanks(r);
  if (*r->at == end) return r->at++, 1;
  for (;;) {
    char *key = NULL;
    blanks(r);
    if (in->kind == ROT_JSON_OBJECT) {
      key = read_string(r);
      blanks(r);
      const int fine = key && *r->at == ':';
      for (const rot_json *one = in->first; one && fine; one = one->next) {
        if (strcmp(one->key, key) == 0) return free(key), 0;
      }
      if (!fine) return free(key), 0;
      r->at++;
    }
    rot_json *node = read_value(r);
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

static int read_into(reader *r, rot_json *node) {
  const char *end;
  switch (*r->at) {
  case '{':
  case '[':
    node->kind = *r->at == '{' ? ROT_JSON_OBJECT : ROT_JSON_ARRAY;
    r->at++;
    return read_members(r, node, node->kind == ROT_JSON_OBJECT ? '}' : ']');
  case '"': node->kind = ROT_JSON_STRING; return (node->text = read_string(r)) != NULL;
  case 'n': return read_word(r, "null");
  case 't':
    node->number = 1.0;
    node->kind = ROT_JSON_BOOLEAN;
    return read_word(r, "true");
  case 'f': node->kind = ROT_JSON_BOOLEAN; return read_word(r, "false");
  default: break;
  }
  if (!number_ends(r->at, &end)) return 0;
  node->kind = ROT_JSON_NUMBER;
  node->number = strtod(r->at, NULL);
  r->at = end;
  return 1;
}

static rot_json *read_value(reader *r) {
  rot_json *node = r->depth < MAX_DEPTH ? calloc(1, sizeof *node) : NULL;
  if (!node) return NULL;
  blanks(r);
  r->depth++;
  const int fine = read_into(r, node);
  r->depth--;
  if (fine) return node;
  rot_json_free(node);
  return NULL;
}

rot_json *rot_json_read(const char *text) {
  reader r = {text, 0};
  rot_json *node = read_value(&r);
  blanks(&r);
  if (!node || *r.at == '\0') return node;
  rot_json_free(node);
  return NULL;
}

int rot_json_number(const rot_json *node, double *x) {
  if (node->kind == ROT_JSON_NUMBER) return *x = node->number, 1;
  if (node->kind != ROT_JSON_STRING) return 0;
  if (strcmp(node->text, "Inf") == 0) return *x = INFINITY, 1;
  if (strcmp(node->text, "-Inf") == 0) return *x = -INFINITY, 1;
  if (strcmp(node->text, "NaN") == 0) return *x = NAN, 1;
  return 0;
}

int rot_json_numbers(const rot_json *array) {
  double x;
  for (const rot_json *one = array->first; one; one = one->next) {
    if (!rot_json_number(one, &x)) return 0;
  }
  return array->n > 0;
}
