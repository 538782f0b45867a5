/* One call of the C interface for a scene: built scene, options, hooks, report. */
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

/* (scene, n times, options) => w, all checked; rot_api_close() in each case */
rotdyn_status rot_api_open(const rotdyn_object *scene, size_t n, const double time_s[],
                           const rotdyn_options *options, rot_api_work *w);
/* Writes input name (or NULL) and reason to the report; returns ROTDYN_EARGUMENT. */
rotdyn_status rot_api_refuse(rot_api_work *w, const char *input, const char *reason);
/* Frees w and fills the caller's report; returns the status. */
int rot_api_close(rotdyn_status status, rot_api_work *w, rotdyn_report *report);

/* 1 if a scene can be run at these times. */
int rot_api_possible(const rot_constraint *constraint, const void *scene, size_t n,
                     const double time_s[]);

/* (scene, n times) => rows `want`, outcome, report. *outcome is cleared first; its events are to be
 * freed by rot_events_free(). */
rotdyn_status rot_api_run(const rot_constraint *constraint, const void *scene,
                          const rotdyn_options *options, const rot_hooks *hooks, size_t n,
                          const double time_s[], const rot_rows *want, rot_outcome *outcome,
                          rotdyn_report *report);

#endif
