/* The log of events: it grows, keeps the order, can be reused, and may be absent. */
#include "engine/events.h"
#include "rot_test.h"

static void names(void) {
  ROT_CHECK(strcmp(rot_event_name(ROT_EVENT_STICK), "stick") == 0);
  ROT_CHECK(strcmp(rot_event_name(ROT_EVENT_LOCK), "lock") == 0);
  ROT_CHECK(strcmp(rot_event_name(ROT_EVENT_COUNT), "unknown event") == 0);
  ROT_CHECK(strcmp(rot_event_name((rot_event)-1), "unknown event") == 0);
}

static void log_grows(void) {
  rot_events events = {0};
  for (int i = 0; i < 1000; i++)
    ROT_CHECK(rot_events_add(&events, 0.5 * i, (rot_event)(i % ROT_EVENT_COUNT)) == ROT_OK);
  ROT_CHECK_EQ_INT(events.count, 1000);
  for (int i = 0; i < 1000; i++) {
    ROT_CHECK_ULP(events.time_s[i], 0.5 * i, 0);
    ROT_CHECK_EQ_INT(events.event[i], i % ROT_EVENT_COUNT);
  }
  rot_events_free(&events);
  ROT_CHECK(events.count == 0 && events.room == 0 && !events.time_s && !events.event);
  ROT_CHECK(rot_events_add(&events, 1.0, ROT_EVENT_SLIP) == ROT_OK && events.count == 1);
  rot_events_free(&events);
}

static void log_is_optional(void) {
  ROT_CHECK(rot_events_add(NULL, 1.0, ROT_EVENT_SLIP) == ROT_OK);
}

int main(void) {
  names();
  log_grows();
  log_is_optional();
  return rot_test_report("events");
}
