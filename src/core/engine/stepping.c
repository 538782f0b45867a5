#include "engine/stepping.h"

#include "ground/search.h"

enum { ROWS_PER_POLL = 8192 };

/* Rows first .. last - 1, all on one side of the start; row k of them is the k-th outward. */
typedef struct side {
  const rot_stepping *stepping;
  void *model;
  size_t n, first, last;
  int forward;
  const double *time_s;
  const rot_hooks *hooks;
  rot_info *info;
  size_t since_poll;
} side;

static size_t row_at(const side *s, size_t k) {
  return s->forward ? s->first + k : s->last - 1 - k;
}

static int holds(const side *s, size_t k) {
  return s->stepping->holds(s->model, s->time_s[row_at(s, k)]);
}

/* How many rows lie before the end of the piece, if the first `done` do: from there in doubling
 * steps, then by halves. */
static size_t rows_in_piece(const side *s, size_t done) {
  const size_t total = s->last - s->first;
  if (!s->stepping->holds || holds(s, total - 1)) return total;
  size_t lo = done, hi = total - 1, step = 1;
  while (lo < hi) {
    const size_t half = (hi - lo) / 2, mid = lo + (step < half ? step : half);
    if (holds(s, mid)) {
      lo = mid + 1;
      step *= 2;
    } else {
      hi = mid;
    }
  }
  return lo;
}

static rot_status poll(side *s, size_t done) {
  s->since_poll = 0;
  return rot_poll(s->hooks, (double)(s->first + done) / (double)s->n);
}

/* Some of the rows from `done` to `end`, counted outward; *done moves on. */
static rot_status write_some(side *s, size_t *done, size_t end) {
  const rot_stepping *stepping = s->stepping;
  rot_info *info = s->info;
  rot_status status = ROT_OK;
  if (end - *done > ROWS_PER_POLL - s->since_poll) end = *done + (ROWS_PER_POLL - s->since_poll);
  const size_t begin = *done;
  if (stepping->write_row) {
    while (*done < end && status == ROT_OK) {
      const size_t i = row_at(s, *done);
      info->time_s = s->time_s[i];
      status = stepping->write_row(s->model, i);
      if (status == ROT_OK) ++*done;
    }
  } else {
    size_t i = s->forward ? s->first + begin : s->last - end, good = i;
    status = stepping->write_rows(s->model, i, i + (end - begin), &good);
    *done += good - i;
    info->time_s = s->time_s[status != ROT_OK ? good : row_at(s, *done - 1)];
  }
  if (s->forward) info->rows_done = s->first + *done; /* backward, the first rows come last */
  s->since_poll += *done - begin;
  if (status == ROT_OK && (*done < end || s->since_poll == ROWS_PER_POLL)) status = poll(s, *done);
  return status;
}

static rot_status travel(side *s, size_t first, size_t last, int forward) {
  const rot_stepping *stepping = s->stepping;
  const size_t total = last - first;
  rot_status status = ROT_OK;
  if (total == 0) return ROT_OK;
  s->first = first;
  s->last = last;
  s->forward = forward;
  s->info->time_s = s->time_s[first];
  if (stepping->restart) {
    status = stepping->restart(s->model, forward);
    s->info->steps++;
  }
  for (size_t done = 0; status == ROT_OK && done < total;) {
    const size_t end = rows_in_piece(s, done);
    while (status == ROT_OK && done < end) status = write_some(s, &done, end);
    if (status != ROT_OK || done == total) break;
    status = stepping->next_piece(s->model, &s->info->time_s);
    s->info->steps++;
    if (status == ROT_OK && ++s->since_poll == ROWS_PER_POLL) status = poll(s, done);
  }
  return status;
}

rot_status rot_step_rows(const rot_stepping *stepping, void *model, double start_s, size_t n,
                         const double time_s[], const rot_hooks *hooks, rot_info *info) {
  side s = {stepping, model, n, 0, 0, 1, time_s, hooks, info, 0};
  const size_t before =
      stepping->restart && n > 0 && time_s[0] < start_s ? rot_lower_bound(n, time_s, start_s) : 0;
  info->status = travel(&s, 0, before, 0);
  if (info->status == ROT_OK) {
    info->rows_done = before;
    info->status = travel(&s, before, n, 1);
  }
  return info->status;
}
