#include "rot_share.h"

#ifdef _OPENMP
#include <omp.h>
#ifndef _WIN32
#include <unistd.h>
#endif
#endif

enum { PARTS = 32 }; /* of a chunk; a thread takes part by part */

#if defined(_OPENMP) && !defined(_WIN32)
/* The process that started threads first. In a child forked from it the threads do not exist, and
 * OpenMP of GCC waits for them for good. */
static long threads_of = 0;

static int may_use_threads(void) {
  const long here = (long)getpid();
  if (threads_of == 0) threads_of = here;
  return threads_of == here;
}
#else
static int may_use_threads(void) { return 1; }
#endif

int rot_share_threads(void) {
#ifdef _OPENMP
  const int most = omp_get_max_threads(), limit = omp_get_thread_limit();
  return most < limit ? most : limit;
#else
  return 1;
#endif
}

static void share_out(rot_share_worker work, const void *frame, size_t first, size_t last,
                      size_t part, int threads) {
#ifdef _OPENMP
  if (threads > 1) {
    const int parts = (int)((last - first + part - 1) / part);
#pragma omp parallel for num_threads(threads) schedule(dynamic, 1)
    for (int i = 0; i < parts; i++) {
      const size_t from = first + (size_t)i * part;
      work(frame, from, last - from < part ? last : from + part);
    }
    return;
  }
#endif
  (void)part;
  (void)threads;
  work(frame, first, last);
}

/* Only this thread polls: the hooks may speak to R. */
rot_status rot_share_rows(rot_share_worker work, const void *frame, size_t n, size_t chunk,
                          int threads, const rot_hooks *hooks, rot_info *info) {
  const int most = rot_share_threads();
  if (threads < 1 || threads > most) threads = most;
  if (threads > 1 && !may_use_threads()) threads = 1;
  rot_info_clear(info, NULL);
  for (size_t first = 0; first < n && info->status == ROT_OK;) {
    const size_t last = n - first < chunk ? n : first + chunk;
    share_out(work, frame, first, last, chunk / PARTS, threads);
    info->rows_done = first = last;
    info->status = rot_poll(hooks, (double)last / (double)n);
  }
  return info->status;
}
