#include "body/parts.h"

#include <math.h>
#include <string.h>

#include "rot_test.h"

/* Moments of numbers and of lists: which item is refused, and why. */
static void moments(void) {
  const double x[] = {2.0, 0.5, 0.0}, nothing = NAN;
  const rot_given number = {.is = ROT_INPUT_NUMBER, .n = 1, .x = x + 1};
  const rot_given list[] = {{.is = ROT_INPUT_NUMBER, .n = 1, .x = x}, number};
  const rot_given given[] = {{.is = ROT_INPUT_NUMBERS, .n = 3, .x = x},
                             {.is = ROT_INPUT_LIST, .n = 2, .item = list},
                             {.is = ROT_INPUT_LIST, .n = 0},
                             {.is = ROT_INPUT_NUMBERS, .n = 2, .x = x},
                             {.is = ROT_INPUT_NUMBER, .n = 1, .x = &nothing}};
  double inertia[3];
  rot_refusal no = {7, ""};
  ROT_CHECK_EQ_INT(rot_body_moments(given, 1, inertia, &no), ROT_OK);
  ROT_CHECK(inertia[0] == 2.0 && inertia[1] == 0.5);
  ROT_CHECK_EQ_INT(rot_body_moments(given, 3, inertia, &no), ROT_OK);
  ROT_CHECK(inertia[0] == 2.0 && inertia[1] == 0.5);
  ROT_CHECK_EQ_INT(rot_body_moments(given, 0, inertia, &no), ROT_EVALUE);
  ROT_CHECK(no.input == 0 && strncmp(no.reason, "item 3 must have a moment", 25) == 0);
  ROT_CHECK_EQ_INT(rot_body_moments(given, 2, inertia, &no), ROT_EVALUE);
  ROT_CHECK(no.input == 2 && strcmp(no.reason, "is empty") == 0);
  ROT_CHECK_EQ_INT(rot_body_moments(given, 4, inertia, &no), ROT_EVALUE);
  ROT_CHECK(no.input == 4 && strncmp(no.reason, "must have a moment", 18) == 0);
}

int main(void) {
  moments();
  return rot_test_report("parts of bodies");
}
