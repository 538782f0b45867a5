/* Values as JSON: numbers that strtod() reads back bit for bit, quoted strings. */
#ifndef ROT_TEXT_H
#define ROT_TEXT_H

#include <stddef.h>

#include "ground/ieee.h"

#define ROT_TEXT_SIZE 32 /* enough for any double and the final 0 */

/* x => JSON number, its length. The fewest of 15, 16 and 17 significant digits that read back
 * unchanged (17 always do). A decimal point in every locale; -0.0 has a point, since readers take
 * -0 as an integer. "Inf", "-Inf", "NaN" where JSON has no number. */
int rot_text_number(double x, char text[ROT_TEXT_SIZE]);
/* With at least `digits` of them. */
int rot_text_digits(double x, int digits, char text[ROT_TEXT_SIZE]);

/* UTF-8 string => quoted and escaped text, its length. `text` has room for six characters for each
 * byte and three more. */
size_t rot_text_string(const char *string, char *text);

#endif
