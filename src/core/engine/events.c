#include "engine/events.h"

#include <stdlib.h>

const char *rot_event_name(rot_event event) {
  static const char *const names[] = {
#define X(code, name) name,
      ROT_EVENT_LIST(X)
#undef X
  };
  return (unsigned)event < ROT_EVENT_COUNT ? names[event] : "unknown event";
}

rot_status rot_events_add(rot_events *events, double time_s, rot_event event) {
  return rot_events_add_at(events, time_s, event, 0);
}

rot_status rot_events_add_at(rot_events *events, double time_s, rot_event event, int place) {
  if (!events) return ROT_OK;
  if (events->count == events->room) {
    const size_t room = events->room ? 2 * events->room : 16;
    double *times = realloc(events->time_s, room * sizeof *times);
    if (times) events->time_s = times;
    rot_event *kinds = realloc(events->event, room * sizeof *kinds);
    if (kinds) events->event = kinds;
    int *places = realloc(events->place, room * sizeof *places);
    if (places) events->place = places;
    if (!times || !kinds || !places) return ROT_ENOMEM;
    events->room = room;
  }
  events->time_s[events->count] = time_s;
  events->place[events->count] = place;
  events->event[events->count++] = event;
  return ROT_OK;
}

void rot_events_free(rot_events *events) {
  if (!events->time_s && !events->event && !events->place) return;
  free(events->time_s);
  free(events->event);
  free(events->place);
  *events = (rot_events){0};
}

typedef struct entry {
  double time_s;
  size_t order;
  rot_event event;
  int place;
} entry;

static int earlier(const void *a, const void *b) {
  const entry *x = a, *y = b;
  if (x->time_s != y->time_s) return x->time_s < y->time_s ? -1 : 1;
  return x->order < y->order ? -1 : 1;
}

rot_status rot_events_sort(rot_events *events) {
  const size_t n = events->count;
  size_t sorted = 1;
  while (sorted < n && events->time_s[sorted - 1] <= events->time_s[sorted]) sorted++;
  if (sorted >= n) return ROT_OK;
  entry *all = malloc(n * sizeof *all);
  if (!all) return ROT_ENOMEM;
  for (size_t i = 0; i < n; i++) {
    all[i] = (entry){events->time_s[i], i, events->event[i], events->place[i]};
  }
  qsort(all, n, sizeof *all, earlier);
  for (size_t i = 0; i < n; i++) {
    events->time_s[i] = all[i].time_s;
    events->event[i] = all[i].event;
    events->place[i] = all[i].place;
  }
  free(all);
  return ROT_OK;
}

double *rot_event_rows_add(rot_event_rows *rows, double time_s) {
  const size_t all = 1 + rows->width;
  if (rows->count == rows->room) {
    const size_t room = rows->room ? 2 * rows->room : 8;
    double *more = realloc(rows->value, room * all * sizeof *more);
    if (!more) return NULL;
    rows->value = more;
    rows->room = room;
  }
  double *row = rows->value + all * rows->count++;
  row[0] = time_s;
  return row + 1;
}

void rot_event_rows_free(rot_event_rows *rows) {
  free(rows->value);
  *rows = (rot_event_rows){0, 0, 0, NULL};
}
