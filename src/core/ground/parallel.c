#include "ground/parallel.h"

#ifdef _OPENMP
#include <omp.h>
#ifndef _WIN32
#include <unistd.h>
#endif
#endif

#if defined(_OPENMP) && !defined(_WIN32)
/* Id of the process that first started threads. A forked child has no such threads, and GCC's
 * OpenMP would wait for them forever. */
static long threads_of = 0;

static int may_use_threads(void) {
  const long here = (long)getpid();
  if (threads_of == 0) threads_of = here;
  return threads_of == here;
}
#else
static int may_use_threads(void) { return 1; }
#endif

int rot_parallel_threads(void) {
#ifdef _OPENMP
  const int max = omp_get_max_threads(), limit = omp_get_thread_limit();
  return max < limit ? max : limit;
#else
  return 1;
#endif
}

typedef struct job {
  rot_parallel_worker work;
  const void *frame;
  size_t n;    /* rows */
  size_t part; /* rows of a part */
  size_t next; /* first row that no thread has taken */
  const rot_hooks *hooks;
  rot_status status; /* of the last poll */
} job;

#ifdef _OPENMP
#define ATOMIC(how) _Pragma(#how)
#else
#define ATOMIC(how)
#endif

/* Computes parts until none is left or a poll stops the job. A part taken is completed, so all rows
 * before `next` are done at the end. One parallel region for all parts: threads that wait at the
 * end of a region use processor time (1e6 inclines on two threads: 160 ms in regions of 65,536
 * rows, 80 ms in one). */
static void take_parts(job *s, int polls) {
  for (;;) {
    rot_status status;
    size_t first;
    ATOMIC(omp atomic read)
    status = s->status;
    if (status != ROT_OK) return;
    ATOMIC(omp atomic capture) {
      first = s->next;
      s->next += s->part;
    }
    if (first >= s->n) return;
    const size_t last = s->n - first < s->part ? s->n : first + s->part;
    s->work(s->frame, first, last);
    if (!polls) continue;
    status = rot_poll(s->hooks, (double)last / (double)s->n);
    ATOMIC(omp atomic write)
    s->status = status;
  }
}

/* Only the calling thread polls: the hooks may call R. */
rot_status rot_parallel_rows(rot_parallel_worker work, const void *frame, size_t n, size_t part,
                             int threads, const rot_hooks *hooks, rot_info *info) {
  const int max = rot_parallel_threads();
  job s = {work, frame, n, part, 0, hooks, ROT_OK};
  if (threads < 1 || threads > max) threads = max;
  if (n <= part || (threads > 1 && !may_use_threads())) threads = 1;
  rot_info_clear(info, NULL);
  if (threads > 1) {
#ifdef _OPENMP
#pragma omp parallel num_threads(threads)
    take_parts(&s, omp_get_thread_num() == 0);
#endif
  } else {
    take_parts(&s, 1);
  }
  info->rows_done = s.next < n ? s.next : n;
  info->status = s.status;
  return info->status;
}
