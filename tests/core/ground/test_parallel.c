/* Rows shared out: each is done once, whatever the part and the threads; a hook stops the rest. */
/* fork(), alarm() */
#define _POSIX_C_SOURCE 200809L
#include "ground/parallel.h"

#include <pthread.h>
#include <stdlib.h>
#include <time.h>

#ifndef _WIN32
#include <sys/wait.h>
#include <unistd.h>
#endif

#include "rot_test.h"

static void count(const void *frame, size_t first, size_t last) {
  int *const *done = frame;
  for (size_t i = first; i < last; i++) (*done)[i]++;
}

static void each_row_once(void) {
  const size_t sizes[] = {0, 1, 31, 64, 1000, 4097};
  for (int k = 0; k < 6; k++) {
    for (int threads = 0; threads <= 4; threads++) {
      const size_t n = sizes[k];
      int *done = calloc(n + 1, sizeof *done);
      rot_info info;
      ROT_CHECK(rot_parallel_rows(count, &done, n, 16, threads, NULL, &info) == ROT_OK);
      ROT_CHECK(info.rows_done == n);
      for (size_t i = 0; i < n; i++) ROT_CHECK(done[i] == 1);
      ROT_CHECK(done[n] == 0);
      free(done);
    }
  }
}

static rot_status stop(void *ctx, double fraction) {
  int *calls = ctx;
  ROT_CHECK(fraction > 0.0 && fraction <= 1.0);
  return ++*calls == 3 ? ROT_EUNWIND : ROT_OK;
}

static void a_hook_stops(void) {
  enum { N = 4096, PART = 16 };
  for (int threads = 1; threads <= 4; threads++) {
    int *done = calloc(N, sizeof *done), calls = 0;
    const rot_hooks hooks = {stop, &calls};
    rot_info info;
    const rot_status status = rot_parallel_rows(count, &done, N, PART, threads, &hooks, &info);
    /* Other threads may do all parts before this one polls three times. */
    ROT_CHECK(status == (calls == 3 ? ROT_EUNWIND : ROT_OK));
    if (threads == 1) ROT_CHECK(calls == 3 && info.rows_done == 3 * PART);
    ROT_CHECK(info.rows_done >= (size_t)(calls == 3 ? 3 * PART : N));
    for (size_t i = 0; i < N; i++) ROT_CHECK_EQ_INT(done[i], i < info.rows_done);
    free(done);
  }
}

/* Several threads are used where there are several: the first waits for another one. */
static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;
static pthread_t first_one;
static int known = 0, several = 0;

static int another_came(void) {
  (void)pthread_mutex_lock(&lock);
  if (!known) first_one = pthread_self(), known = 1;
  several |= !pthread_equal(first_one, pthread_self());
  const int came = several;
  (void)pthread_mutex_unlock(&lock);
  return came;
}

static void wait_for_another(const void *frame, size_t first, size_t last) {
  const time_t begun = time(NULL);
  (void)frame, (void)first, (void)last;
  while (!another_came() && difftime(time(NULL), begun) < 20.0) {}
}

static void threads_are_used(void) {
  rot_info info;
  if (rot_parallel_threads() < 2) return;
  ROT_CHECK(rot_parallel_rows(wait_for_another, NULL, 2, 1, 2, NULL, &info) == ROT_OK);
  ROT_CHECK(several && info.rows_done == 2);
}

/* A child that was forked after threads were used has none, and does not wait for them. */
#ifndef _WIN32
static void a_child_goes_alone(void) {
  rot_info info;
  int *done = calloc(64, sizeof *done), said = -1;
  ROT_CHECK(rot_parallel_rows(count, &done, 64, 16, 2, NULL, &info) == ROT_OK);
  (void)fflush(stdout);
  const pid_t child = fork();
  if (child == 0) {
    (void)alarm(20);
    _exit(rot_parallel_rows(count, &done, 64, 16, 2, NULL, &info) == ROT_OK && done[63] == 2 ? 0
                                                                                             : 1);
  }
  ROT_CHECK(child > 0 && waitpid(child, &said, 0) == child);
  ROT_CHECK_EQ_INT(said, 0);
  free(done);
}
#else
static void a_child_goes_alone(void) { ROT_CHECK(1); }
#endif

int main(void) {
  each_row_once();
  a_hook_stops();
  ROT_CHECK(rot_parallel_threads() >= 1);
  threads_are_used();
  a_child_goes_alone();
  return rot_test_report("share");
}
