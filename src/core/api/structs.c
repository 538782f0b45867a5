#include "api/structs.h"

#include <math.h>
#include <string.h>

rotdyn_status rot_api_status(rot_status status) {
  switch (status) {
  case ROT_OK: return ROTDYN_OK;
  case ROT_ENOMEM: return ROTDYN_EMEMORY;
  case ROT_EVALUE: return ROTDYN_EARGUMENT;
  case ROT_ERANGE: return ROTDYN_ERANGE;
  case ROT_ETORQUE:
  case ROT_ERANDOM:
  case ROT_ERHS: return ROTDYN_ETORQUE;
  case ROT_EBUDGET: return ROTDYN_EBUDGET;
  case ROT_ESTEP: return ROTDYN_ESTEP;
  case ROT_EUNWIND: return ROTDYN_ESTOPPED;
  default: return ROTDYN_EINTERNAL;
  }
}

int rot_api_take(const void *from, size_t size, void *to) {
  const unsigned char *bytes = from;
  size_t given;
  if (!from) return 0;
  memcpy(&given, from, sizeof given);
  if (given < sizeof given) return 0;
  for (size_t i = size; i < given; i++) {
    if (bytes[i]) return 0;
  }
  memset(to, 0, size);
  memcpy(to, from, given < size ? given : size);
  return 1;
}

int rot_api_give(const void *from, size_t size, void *to) {
  const size_t head = sizeof(size_t);
  size_t given;
  if (!to) return 1;
  memcpy(&given, to, sizeof given);
  if (given < head) return 0;
  const size_t both = given < size ? given : size;
  memcpy((unsigned char *)to + head, (const unsigned char *)from + head, both - head);
  return 1;
}

int rot_api_finite(size_t n, const double x[]) {
  for (size_t i = 0; i < n; i++) {
    if (!isfinite(x[i])) return 0;
  }
  return 1;
}

int rot_api_times(size_t n, const double t[]) {
  if (n && (!t || !rot_api_finite(n, t) || !isfinite(t[n - 1] - t[0]))) return 0;
  for (size_t i = 1; i < n; i++) {
    if (t[i] < t[i - 1]) return 0;
  }
  return 1;
}

void rot_api_events(const rot_events *from, rotdyn_events *to) {
  rotdyn_events events;
  if (!to || !rot_api_take(to, sizeof events, &events)) return;
  for (size_t i = 0; i < from->count && i < events.room; i++) {
    if (events.time_s) events.time_s[i] = from->time_s[i];
    if (events.name) events.name[i] = rot_event_name(from->event[i]);
  }
  events.count = from->count;
  (void)rot_api_give(&events, sizeof events, to);
}
