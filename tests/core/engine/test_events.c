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

/* A run backwards, then forwards: each event keeps its name and its place, and those of one time
 * their order. Many do not take the square of their count. */
static void log_is_sorted(void) {
  rot_events events = {0};
  const int n = 200000;
  ROT_CHECK(rot_events_sort(&events) == ROT_OK);
  for (int i = n; i > 0; i--) {
    ROT_CHECK(rot_events_add_at(&events, -0.5 * i, (rot_event)(i % 3), i) == ROT_OK);
  }
  for (int i = 0; i < 4; i++) rot_events_add_at(&events, -1.0, (rot_event)i, -i);
  ROT_CHECK(rot_events_sort(&events) == ROT_OK && events.count == (size_t)n + 4);
  int wrong = 0;
  for (int i = 0; i < n + 4; i++) {
    const int k = i < n - 1 ? n - i : i < n + 3 ? -(i - n + 1) : 1;
    const int among = i >= n - 1 && i < n + 3;
    wrong += events.place[i] != k || events.time_s[i] != (among ? -1.0 : -0.5 * k);
    wrong += (int)events.event[i] != (among ? -k : k % 3);
  }
  ROT_CHECK_EQ_INT(wrong, 0);
  rot_events_free(&events);
}

static void log_is_optional(void) {
  ROT_CHECK(rot_events_add(NULL, 1.0, ROT_EVENT_SLIP) == ROT_OK);
}

int main(void) {
  names();
  log_grows();
  log_is_sorted();
  log_is_optional();
  return rot_test_report("events");
}
