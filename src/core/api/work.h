/* One call of the C interface about a scene: the scene as built, options, hooks, report. */
#ifndef ROT_API_WORK_H
#define ROT_API_WORK_H

#include "api/object.h"
#include "api/structs.h"
#include "scene/run.h"

typedef struct rot_api_work {
  rot_api_built built;
  rotdyn_options options;
  rot_hooks hooks;
  rotdyn_report report;
} rot_api_work;

/* Opens it, with times for it; rot_api_close() afterwards, in any case. */
rotdyn_status rot_api_open(const rotdyn_object *scene, size_t n, const double time_s[],
                           const rotdyn_options *options, rot_api_work *w);
rotdyn_status rot_api_refuse(rot_api_work *w, const char *input, const char *reason);
/* The caller's report is filled; gives the status. */
int rot_api_close(rotdyn_status status, rot_api_work *w, rotdyn_report *report);

/* Whether a scene can be run at these times. */
int rot_api_possible(const rot_constraint *constraint, const void *scene, size_t n,
                     const double time_s[]);

/* A scene at some times. *outcome is cleared first; rot_events_free() of its events afterwards. */
rotdyn_status rot_api_run(const rot_constraint *constraint, const void *scene,
                          const rotdyn_options *options, const rot_hooks *hooks, size_t n,
                          const double time_s[], const rot_rows *want, rot_outcome *outcome,
                          rotdyn_report *report);

#endif
