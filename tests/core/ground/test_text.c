/* Numbers as text: known texts, and every exponent there and back, bit for bit. */
#include "ground/text.h"

#include <locale.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "rot_test.h"

static int reads(double x, const char *want) {
  char text[ROT_TEXT_SIZE];
  return rot_text_number(x, text) == (int)strlen(want) && strcmp(text, want) == 0;
}

static void known(void) {
  ROT_CHECK(reads(0.0, "0"));
  ROT_CHECK(reads(-0.0, "-0.0"));
  ROT_CHECK(reads(2.0, "2"));
  ROT_CHECK(reads(-2.5, "-2.5"));
  ROT_CHECK(reads(0.1, "0.1"));
  ROT_CHECK(reads(2.0 / 3.0, "0.6666666666666666"));
  ROT_CHECK(reads(0.1 + 0.2, "0.30000000000000004"));
  ROT_CHECK(reads(1e22, "1e+22"));
  ROT_CHECK(reads(0x1p-1074, "4.94065645841247e-324"));
  ROT_CHECK(reads(0x1.fffffffffffffp+1023, "1.7976931348623157e+308"));
  ROT_CHECK(reads(INFINITY, "Inf"));
  ROT_CHECK(reads(-INFINITY, "-Inf"));
  ROT_CHECK(reads(NAN, "NaN"));
}

/* 500 doubles of each of the 2046 exponents, and the subnormal ones: 1e6. */
static void there_and_back(void) {
  uint64_t state = 88172645463325252u;
  int lost = 0, longest = 0;
  for (uint64_t exponent = 0; exponent < 2047; exponent++) {
    for (int i = 0; i < rot_test_trials(500); i++) {
      state ^= state << 13;
      state ^= state >> 7;
      state ^= state << 17;
      const uint64_t bits = (state & 0x800fffffffffffffu) | exponent << 52;
      double x, back;
      char text[ROT_TEXT_SIZE];
      memcpy(&x, &bits, sizeof x);
      const int length = rot_text_number(x, text);
      back = strtod(text, NULL);
      if (memcmp(&x, &back, sizeof x) != 0) lost++;
      if (length > longest) longest = length;
    }
  }
  ROT_CHECK(lost == 0);
  ROT_CHECK(longest == 24);
}

/* Skipped where the locale is not installed. */
static void decimal_comma(void) {
  if (!setlocale(LC_NUMERIC, "de_DE.UTF-8")) return;
  ROT_CHECK(reads(-2.5, "-2.5"));
  ROT_CHECK(reads(2.0 / 3.0, "0.6666666666666666"));
  ROT_CHECK(reads(1.5e300, "1.5e+300"));
  ROT_CHECK(reads(1e22, "1e+22"));
  setlocale(LC_NUMERIC, "C");
}

static void strings(void) {
  static const struct {
    const char *string, *want;
  } cases[] = {{"", "\"\""},
               {"plain", "\"plain\""},
               {"\"\\\n\r\t", "\"\\\"\\\\\\n\\r\\t\""},
               {"\001\037/\177", "\"\\u0001\\u001f/\177\""},
               {"\303\251", "\"\303\251\""}};
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
    char text[64];
    ROT_CHECK(rot_text_string(cases[i].string, text) == strlen(cases[i].want));
    ROT_CHECK(strcmp(text, cases[i].want) == 0);
  }
}

int main(void) {
  known();
  strings();
  there_and_back();
  decimal_comma();
  return rot_test_report("text");
}
