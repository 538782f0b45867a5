/* Files that are written: their bytes, and what is said where they cannot be. */
#ifndef _WIN32
#define _XOPEN_SOURCE 600 /* fork(), setitimer() */
#endif
#include "ground/file.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "rot_test.h"

#ifndef _WIN32
#include <signal.h>
#include <sys/select.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>
#endif

static rot_file file;

/* `times` copies of `n` bytes; 1 if exactly they are in the file afterwards. */
static int comes_back(const char *path, size_t n, int times) {
  unsigned char *bytes = malloc(n + 1), *back = malloc(n + 1);
  int same = bytes != NULL && back != NULL;
  for (size_t i = 0; same && i < n; i++) bytes[i] = (unsigned char)(i * 131 + i / 256);
  rot_file_open(&file, path);
  for (int k = 0; same && k < times; k++) rot_file_add(&file, bytes, n);
  same = rot_file_close(&file) == 0 && same;
  FILE *in = fopen(path, "rb");
  same = in != NULL && same;
  for (int k = 0; same && k < times; k++)
    same = fread(back, 1, n, in) == n && memcmp(bytes, back, n) == 0;
  same = same && fgetc(in) == EOF;
  if (in != NULL) fclose(in);
  free(bytes);
  free(back);
  return same;
}

/* Less than the buffer, all of it, one more, and many times. */
static void bytes(void) {
  const char *path = "rot_test_file.tmp";
  const size_t room = sizeof file.buffer;
  ROT_CHECK(comes_back(path, 0, 1));
  ROT_CHECK(comes_back(path, 10, 3));
  ROT_CHECK(comes_back(path, room, 2));
  ROT_CHECK(comes_back(path, room + 1, 2));
  ROT_CHECK(comes_back(path, room - 1, 3));
  ROT_CHECK(comes_back(path, 7, 30000));
  ROT_CHECK(rot_file_special(path) == 0);
  remove(path);
  ROT_CHECK(rot_file_special(path) == 0);
  ROT_CHECK(rot_file_special(".") == 1);
}

#ifndef _WIN32
static unsigned char byte_at(size_t i) { return (unsigned char)(i * 131 + i / 256); }

/* Reads slowly what write_all() wrote; 0 if it is n bytes, in their order. */
static int read_slowly(int descriptor, size_t n) {
  unsigned char part[4096];
  size_t at = 0;
  ssize_t got;
  while ((got = read(descriptor, part, sizeof part)) > 0) {
    struct timeval rest = {0, 1000};
    for (ssize_t i = 0; i < got; i++) {
      if (part[i] != byte_at(at++)) return 1;
    }
    (void)select(0, NULL, NULL, NULL, &rest);
  }
  return at == n ? 0 : 2;
}

static void on_alarm(int number) { (void)number; }

/* A pipe takes a part at a time, and signals interrupt what waits for room in it. */
static void interrupted(void) {
  enum { N = 500000 };
  int ends[2], status = 1;
  unsigned char *bytes = malloc(N);
  struct sigaction action = {.sa_handler = on_alarm};
  const struct itimerval often = {{0, 2000}, {0, 2000}}, never = {{0, 0}, {0, 0}};
  if (bytes == NULL || pipe(ends) != 0) exit(1);
  for (size_t i = 0; i < N; i++) bytes[i] = byte_at(i);
  const pid_t reader = fork();
  if (reader < 0) exit(1);
  if (reader == 0) {
    close(ends[1]);
    _exit(read_slowly(ends[0], N));
  }
  close(ends[0]);
  sigaction(SIGALRM, &action, NULL);
  setitimer(ITIMER_REAL, &often, NULL);
  rot_file_on(&file, ends[1]);
  rot_file_add(&file, bytes, N);
  ROT_CHECK(rot_file_close(&file) == 0);
  setitimer(ITIMER_REAL, &never, NULL);
  close(ends[1]);
  while (waitpid(reader, &status, 0) < 0 && errno == EINTR) continue;
  ROT_CHECK(WIFEXITED(status) && WEXITSTATUS(status) == 0);
  free(bytes);
}
#endif

static void faults(void) {
  rot_file_open(&file, "rot_no_such_folder/file");
  rot_file_add(&file, "a", 1);
  const int code = rot_file_close(&file);
  ROT_CHECK(code == ENOENT);
  ROT_CHECK(strcmp(rot_file_fault(code), strerror(ENOENT)) == 0);
  ROT_CHECK(strcmp(rot_file_fault(0), "") == 0);
  ROT_CHECK(strcmp(rot_file_fault(ENOSPC), "The disk is full.") == 0);
  rot_file_on(&file, 987); /* a descriptor that is not open */
  rot_file_add(&file, "a", 1);
  ROT_CHECK(rot_file_close(&file) == EBADF);
}

/* Few bytes fail when the buffer is written, many before. */
static void full(void) {
  if (rot_file_special("/dev/full") == 0) {
    printf("skip - there is no /dev/full\n");
    return;
  }
  for (int n = 1; n <= 100001; n += 100000) {
    rot_file_open(&file, "/dev/full");
    for (int i = 0; i < n; i++) rot_file_add(&file, "a", 1);
    ROT_CHECK(rot_file_close(&file) == ENOSPC);
  }
}

int main(void) {
  bytes();
#ifndef _WIN32
  interrupted();
#endif
  faults();
  full();
  return rot_test_report("file");
}
