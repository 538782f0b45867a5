/* Rows outward from a start, over pieces of two seconds; the model counts what it is asked. */
#include "engine/stepping.h"
#include "rot_test.h"

#include <math.h>

enum { MAX = 20000 };

typedef struct counter {
  const double *time_s;
  double start_s, base_s, piece_end_s;
  int forward, backward_too, restarts, pieces;
  size_t written, fail_at;
  size_t order[MAX];
} counter;

static rot_status restart(void *model, int forward) {
  counter *c = model;
  if (!forward && !c->backward_too) return ROT_EVALUE;
  c->forward = forward;
  c->restarts++;
  c->base_s = c->start_s;
  c->piece_end_s = c->start_s + (forward ? 2.0 : -2.0);
  return ROT_OK;
}

static int holds(const void *model, double time_s) {
  const counter *c = model;
  return c->forward ? time_s < c->piece_end_s : time_s > c->piece_end_s;
}

static rot_status next_piece(void *model, double *end_s) {
  counter *c = model;
  c->pieces++;
  *end_s = c->base_s = c->piece_end_s;
  c->piece_end_s += c->forward ? 2.0 : -2.0;
  return ROT_OK;
}

static rot_status write_row(void *model, size_t i) {
  counter *c = model;
  const double since = fabs(c->time_s[i] - c->base_s);
  ROT_CHECK(since < 2.0); /* in the piece, its end not included */
  if (i == c->fail_at) return ROT_ERANGE;
  c->order[c->written++] = i;
  return ROT_OK;
}

/* All rows of a piece at once, in the order of time. */
static rot_status write_rows(void *model, size_t first, size_t last, size_t *end) {
  counter *c = model;
  for (*end = first; *end < last; ++*end) {
    const rot_status status = write_row(c, *end);
    if (status != ROT_OK) return status;
  }
  return ROT_OK;
}

static rot_status some_rows(void *model, size_t first, size_t last, size_t *end) {
  counter *c = model;
  *end = last < first + 3 ? last : first + 3;
  for (size_t i = first; i < *end; i++) c->order[c->written++] = i;
  return ROT_OK;
}

static const rot_stepping by_row = {restart, holds, next_piece, write_row, NULL};
static const rot_stepping by_piece = {restart, holds, next_piece, NULL, write_rows};
static const rot_stepping in_order = {.write_rows = some_rows};

static rot_status go(const rot_stepping *stepping, counter *c, size_t n, const double t[],
                     const rot_hooks *hooks, rot_info *info) {
  rot_info_clear(info, NULL);
  c->time_s = t;
  return rot_step_rows(stepping, c, c->start_s, n, t, hooks, info);
}

static void check_order(void) {
  const double t[] = {-3.0, -2.0, -0.5, 0.0, 1.0, 2.0, 2.5, 9.0};
  const size_t outward[] = {2, 1, 0, 3, 4, 5, 6, 7};
  static counter c;
  rot_info info;
  c = (counter){.backward_too = 1, .fail_at = MAX};
  ROT_CHECK_EQ_INT(go(&by_row, &c, 8, t, NULL, &info), ROT_OK);
  for (int i = 0; i < 8; i++) ROT_CHECK_EQ_INT(c.order[i], outward[i]);
  ROT_CHECK(c.restarts == 2 && c.pieces == 1 + 4 && info.steps == 7);
  ROT_CHECK(info.rows_done == 8 && info.time_s == 9.0);
  c = (counter){.backward_too = 1, .fail_at = MAX};
  ROT_CHECK_EQ_INT(go(&by_piece, &c, 8, t, NULL, &info), ROT_OK);
  ROT_CHECK(c.written == 8 && info.steps == 7 && c.order[0] == 2 && c.order[1] == 0);
  c = (counter){.fail_at = MAX};
  ROT_CHECK_EQ_INT(go(&in_order, &c, 8, t, NULL, &info), ROT_OK);
  for (size_t i = 0; i < 8; i++) ROT_CHECK_EQ_INT(c.order[i], i);
  ROT_CHECK(info.rows_done == 8 && info.steps == 0);
  ROT_CHECK_EQ_INT(go(&by_row, &c, 0, t, NULL, &info), ROT_OK);
  ROT_CHECK(info.rows_done == 0 && info.steps == 0);
}

/* What is done counts from the first row; backward none is, until all are. */
static void check_failures(void) {
  const double t[] = {-3.0, -2.0, -0.5, 0.0, 1.0, 2.0, 2.5, 9.0};
  static counter c;
  rot_info info;
  for (int bulk = 0; bulk < 2; bulk++) {
    const rot_stepping *stepping = bulk ? &by_piece : &by_row;
    for (size_t fail_at = 0; fail_at < 8; fail_at++) {
      c = (counter){.backward_too = 1, .fail_at = fail_at};
      ROT_CHECK_EQ_INT(go(stepping, &c, 8, t, NULL, &info), ROT_ERANGE);
      ROT_CHECK_EQ_INT(info.status, ROT_ERANGE);
      ROT_CHECK_EQ_INT(info.rows_done, fail_at < 3 ? 0 : fail_at);
      ROT_CHECK(info.time_s == t[fail_at]);
    }
  }
  c = (counter){.fail_at = MAX}; /* forward only */
  ROT_CHECK_EQ_INT(go(&by_row, &c, 8, t, NULL, &info), ROT_EVALUE);
  ROT_CHECK(info.rows_done == 0 && info.time_s == t[0]);
  ROT_CHECK_EQ_INT(go(&by_row, &c, 5, t + 3, NULL, &info), ROT_OK);
}

static rot_status no_more(void *ctx, double fraction) {
  int *left = ctx;
  ROT_CHECK(fraction >= 0.0 && fraction <= 1.0);
  return (*left)-- > 0 ? ROT_OK : ROT_EUNWIND;
}

static void check_polls(void) {
  static double t[MAX];
  static counter c;
  rot_info info;
  for (int i = 0; i < MAX; i++) t[i] = 1e-5 * i; /* one piece */
  for (int bulk = 0; bulk < 2; bulk++) {
    int left = 1;
    const rot_hooks hooks = {no_more, &left};
    c = (counter){.fail_at = MAX};
    ROT_CHECK_EQ_INT(go(bulk ? &by_piece : &by_row, &c, MAX, t, &hooks, &info), ROT_EUNWIND);
    ROT_CHECK(info.rows_done == 16384 && info.time_s == t[16383]);
  }
  for (int i = 0; i < MAX; i++) t[i] = 4.0 * i; /* two pieces to a row */
  int left = 0;
  const rot_hooks hooks = {no_more, &left};
  c = (counter){.fail_at = MAX};
  ROT_CHECK_EQ_INT(go(&by_row, &c, MAX, t, &hooks, &info), ROT_EUNWIND);
  ROT_CHECK_EQ_INT(info.rows_done + (size_t)c.pieces, 8192);
  left = 2; /* a model that stops early is polled each time */
  ROT_CHECK_EQ_INT(go(&in_order, &c, 20, t, &hooks, &info), ROT_EUNWIND);
  ROT_CHECK_EQ_INT(info.rows_done, 9);
}

int main(void) {
  check_order();
  check_failures();
  check_polls();
  return rot_test_report("march");
}
