/* The events of a run, with their times: a log that grows. */
#ifndef ROT_EVENTS_H
#define ROT_EVENTS_H

#include <stddef.h>

#include "ground/status.h"

/* code, name as R shows it. Listed once, here. */
#define ROT_EVENT_LIST(X)                                                                          \
  X(ROT_EVENT_STICK, "stick")     /* comes to rest and is held there */                            \
  X(ROT_EVENT_SLIP, "slip")       /* breaks loose from rest */                                     \
  X(ROT_EVENT_REVERSE, "reverse") /* passes through rest */                                        \
  X(ROT_EVENT_LOCK, "lock")       /* a clutch locks */                                             \
  X(ROT_EVENT_ROLL, "roll")       /* slip of a contact ends, rolling begins */                     \
  X(ROT_EVENT_FLIP, "flip")       /* the middle axis of a tumbling body turns over */              \
  X(ROT_EVENT_HIGHEST, "highest") /* the centre of mass of a top turns back, highest */            \
  X(ROT_EVENT_LOWEST, "lowest")   /* or lowest */                                                  \
  X(ROT_EVENT_SLIP_REVERSES,                                                                       \
    "slip_reverse") /* slip of a contact changes its sign, without sticking */

typedef enum rot_event {
#define X(code, name) code,
  ROT_EVENT_LIST(X)
#undef X
      ROT_EVENT_COUNT
} rot_event;

const char *rot_event_name(rot_event event);

/* `place`: 0, or where: the copy i of the constraint (engine/model.h) as i + 1, what couples the
 * copies j and j + 1 as -(j + 1). */
typedef struct rot_events {
  size_t count, room;
  double *time_s;
  rot_event *event;
  int *place;
} rot_events; /* begin with {0} */

/* ROT_OK or ROT_ENOMEM. `events` may be NULL: nothing is logged. */
rot_status rot_events_add(rot_events *events, double time_s, rot_event event);
rot_status rot_events_add_at(rot_events *events, double time_s, rot_event event, int place);
void rot_events_free(rot_events *events);
/* By time; those of one time keep their order. ROT_OK or ROT_ENOMEM. */
rot_status rot_events_sort(rot_events *events);

/* Rows at the times of events, after them, one for each time: the time and `width` values. */
typedef struct rot_event_rows {
  size_t width, count, room;
  double *value;  /* count times 1 + width */
} rot_event_rows; /* begin with {width} */

/* The values of a new row, after its time; NULL: no memory. */
double *rot_event_rows_add(rot_event_rows *rows, double time_s);
void rot_event_rows_free(rot_event_rows *rows);

#endif
