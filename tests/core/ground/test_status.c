/* Codes, the report of a run, and the hook. */
#include "ground/status.h"
#include "rot_test.h"

/* Every code has a text and a kind of its own; R builds its condition classes from the kinds. */
static void check_texts(void) {
  static const char *const kind[] = {"none", "memory", "value", "range",  "torque",
                                     "rhs",  "budget", "step",  "random", "unwind"};
  ROT_CHECK_EQ_INT(ROT_OK, 0);
  ROT_CHECK_EQ_INT(ROT_STATUS_COUNT, sizeof kind / sizeof kind[0]);
  for (int i = 0; i < ROT_STATUS_COUNT; i++) {
    ROT_CHECK(strcmp(rot_status_kind((rot_status)i), kind[i]) == 0);
    ROT_CHECK(strlen(rot_status_text((rot_status)i)) >= 2);
    for (int j = 0; j < i; j++) {
      ROT_CHECK(strcmp(rot_status_text((rot_status)i), rot_status_text((rot_status)j)) != 0);
    }
  }
  ROT_CHECK(strcmp(rot_status_text(ROT_OK), "ok") == 0);
  ROT_CHECK(strcmp(rot_status_kind(ROT_EUNWIND), "unwind") == 0);
  ROT_CHECK(strstr(rot_status_text(ROT_EBUDGET), "budget") != NULL);
}

static void check_unknown_code(void) {
  ROT_CHECK(strcmp(rot_status_text(ROT_STATUS_COUNT), "unknown status") == 0);
  ROT_CHECK(strcmp(rot_status_kind(ROT_STATUS_COUNT), "internal") == 0);
  ROT_CHECK(strcmp(rot_method_name(ROT_METHOD_COUNT), "unknown method") == 0);
  ROT_CHECK(strcmp(rot_method_name(ROT_METHOD_NONE), "none") == 0);
  ROT_CHECK(strcmp(rot_method_name(ROT_METHOD_SPLIT), "split") == 0);
}

static void check_clear(void) {
  rot_info info;
  memset(&info, 0x5a, sizeof info);
  rot_info_clear(&info, rot_turning);
  ROT_CHECK_EQ_INT(info.status, ROT_OK);
  ROT_CHECK(info.time_s == 0.0 && info.tolerance == 0.0);
  ROT_CHECK(info.rows_done == 0 && info.steps == 0 && info.rejected == 0 && info.rhs_calls == 0);
  ROT_CHECK(info.measure[ROT_THETA].error == 0.0 && info.measure[ROT_OMEGA].error == 0.0);
  ROT_CHECK(info.measure[ROT_THETA].largest == 0.0 && info.measure[ROT_OMEGA].largest == 0.0);
}

/* A run with other measures, or with none. */
static void check_measures(void) {
  static const char *const names[] = {"x", "y", "spin", NULL};
  const double errors[] = {1.0, NAN}, sizes[] = {4.0, 1.0};
  rot_info info;
  rot_info_clear(&info, names);
  ROT_CHECK_EQ_INT((int)info.n_measures, 3);
  ROT_CHECK(strcmp(info.measure_names[2], "spin") == 0);
  rot_note_value(&info.measure[2], -3.0);
  rot_note_value(&info.measure[2], 2.0);
  ROT_CHECK(info.measure[2].largest == 3.0);
  ROT_CHECK(info.measure[2].high == 2.0 && info.measure[2].low == -3.0);
  info.measure[2].error = 1.5;
  ROT_CHECK(rot_info_error(&info) == 0.5);
  rot_info_clear(&info, NULL);
  ROT_CHECK(info.n_measures == 0 && rot_info_error(&info) == 0.0);
  ROT_CHECK(rot_error_figure(1, errors, sizes) == 0.25);
  ROT_CHECK(isnan(rot_error_figure(2, errors, sizes)));
  ROT_CHECK(rot_error_figure(0, NULL, NULL) == 0.0);
}

static double error_of(double theta_error, double theta_max, double omega_error, double omega_max) {
  rot_info info;
  rot_info_clear(&info, rot_turning);
  info.measure[ROT_THETA].error = theta_error;
  info.measure[ROT_THETA].largest = theta_max;
  info.measure[ROT_OMEGA].error = omega_error;
  info.measure[ROT_OMEGA].largest = omega_max;
  return rot_info_error(&info);
}

/* The worse of the two, each relative to its own largest value. */
static void check_error(void) {
  ROT_CHECK(error_of(3.0, 4.0, 2.0, 16.0) == 0.75);
  ROT_CHECK(error_of(2.0, 16.0, 3.0, 4.0) == 0.75);
  ROT_CHECK(error_of(3.0, 4.0, 0.0, 5.0) == 0.75);
  ROT_CHECK(error_of(0.0, 4.0, 0.5, 4.0) == 0.125);
}

/* Nothing moved and no error: 0. An error without a size: 1, for not a digit is known. */
static void check_error_of_nothing(void) {
  ROT_CHECK(error_of(0.0, 0.0, 0.0, 0.0) == 0.0);
  ROT_CHECK(error_of(0.0, 0.0, 0.5, 4.0) == 0.125);
  ROT_CHECK(error_of(0.25, 0.0, 0.0, 0.0) == 1.0);
  ROT_CHECK(error_of(0.0, 3.0, 0.25, 0.0) == 1.0);
}

/* A NaN is never hidden behind the other figure. */
static void check_error_of_nan(void) {
  ROT_CHECK(isnan(error_of(NAN, 4.0, 0.5, 4.0)));
  ROT_CHECK(isnan(error_of(0.5, 4.0, NAN, 4.0)));
  ROT_CHECK(isnan(error_of(NAN, 0.0, NAN, 0.0)));
}

static double seen_fraction;
static rot_status answer(void *ctx, double fraction) {
  seen_fraction = fraction;
  return *(const rot_status *)ctx;
}

static void check_poll(void) {
  rot_status says = ROT_EUNWIND;
  const rot_hooks none = {NULL, NULL}, hooks = {answer, &says};
  ROT_CHECK_EQ_INT(rot_poll(NULL, 0.5), ROT_OK);
  ROT_CHECK_EQ_INT(rot_poll(&none, 0.5), ROT_OK);
  ROT_CHECK_EQ_INT(rot_poll(&hooks, 0.75), ROT_EUNWIND);
  ROT_CHECK(seen_fraction == 0.75);
  says = ROT_OK;
  ROT_CHECK_EQ_INT(rot_poll(&hooks, 0.25), ROT_OK);
  ROT_CHECK(seen_fraction == 0.25);
}

int main(void) {
  check_texts();
  check_unknown_code();
  check_clear();
  check_measures();
  check_error();
  check_error_of_nothing();
  check_error_of_nan();
  check_poll();
  return rot_test_report("status");
}
