#define _POSIX_C_SOURCE 200809L

#include "ground/file.h"

#include <errno.h>
#include <fcntl.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/types.h>

#ifdef _WIN32
#include <io.h>
#define MAKE_FLAGS (_O_WRONLY | _O_CREAT | _O_TRUNC | _O_BINARY)
#define MAKE_MODE  (_S_IREAD | _S_IWRITE)
#else
#include <unistd.h>
#define MAKE_FLAGS (O_WRONLY | O_CREAT | O_TRUNC)
#define MAKE_MODE  0666
#endif

static void begin(rot_file *file, int descriptor, int owned) {
  file->descriptor = descriptor;
  file->owned = owned;
  file->code = 0;
  file->n = 0;
}

static void keep_code(rot_file *file) {
  if (file->code == 0) file->code = errno != 0 ? errno : EIO;
}

void rot_file_open(rot_file *file, const char *path) {
  errno = 0;
  begin(file, open(path, MAKE_FLAGS, MAKE_MODE), 1);
  if (file->descriptor < 0) keep_code(file);
}

void rot_file_on(rot_file *file, int descriptor) { begin(file, descriptor, 0); }

/* Writes n bytes; repeats partial and interrupted writes. */
static void write_all(rot_file *file, const char *bytes, size_t n) {
  while (n > 0 && file->code == 0) {
    errno = 0;
    /* At most 1 GB at a time: Windows counts in int. */
    const size_t part = n < (1u << 30) ? n : (1u << 30);
#ifdef _WIN32
    const long long written = _write(file->descriptor, bytes, (unsigned)part);
#else
    const long long written = write(file->descriptor, bytes, part);
#endif
    if (written > 0) {
      bytes += written;
      n -= (size_t)written;
    } else if (errno != EINTR) {
      keep_code(file);
    }
  }
}

static void flush_buffer(rot_file *file) {
  write_all(file, file->buffer, file->n);
  file->n = 0;
}

void rot_file_add(rot_file *file, const void *bytes, size_t n) {
  if (file->n + n > sizeof file->buffer) flush_buffer(file);
  if (n > sizeof file->buffer) {
    write_all(file, bytes, n);
  } else if (n > 0) {
    memcpy(file->buffer + file->n, bytes, n);
    file->n += n;
  }
}

/* Some systems report a full disk or quota when the file is closed. */
int rot_file_close(rot_file *file) {
  flush_buffer(file);
  errno = 0;
  if (file->owned && file->descriptor >= 0 && close(file->descriptor) != 0) keep_code(file);
  return file->code;
}

const char *rot_file_fault(int code) {
  if (code == 0) return "";
  if (code == ENOSPC) return "The disk is full.";
#ifdef EDQUOT
  if (code == EDQUOT) return "The disk is full: your quota is used up.";
#endif
  return strerror(code);
}

int rot_file_special(const char *path) {
  struct stat is;
  return stat(path, &is) == 0 && (is.st_mode & S_IFMT) != S_IFREG;
}
