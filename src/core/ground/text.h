/* Values as JSON: numbers that strtod() reads back bit for bit, strings in quotes. */
#ifndef ROT_TEXT_H
#define ROT_TEXT_H

#include <stddef.h>

#include "ground/ieee.h"

#define ROT_TEXT_SIZE 32 /* enough for any double, with the end */

/* The shortest of 15, 16 and 17 significant digits that come back the same (17 always do), as JSON
 * has numbers: a decimal point in every locale, -0.0 with its point, since readers take -0 as an
 * integer. "Inf", "-Inf", "NaN" for what JSON has no number for. Returns the length. */
int rot_text_number(double x, char text[ROT_TEXT_SIZE]);

/* A string of UTF-8 in quotes, with escapes; `text` has room for six characters for each, and three
 * more. Returns the length. */
size_t rot_text_string(const char *string, char *text);

#endif
