/* What gravity does to a body with a fixed point in closed form, and what stays of its balances. */
#ifndef ROT_PIVOT_LEDGER_H
#define ROT_PIVOT_LEDGER_H

#include "engine/model.h"
#include "scene/free/scene.h"

/* Since the start, to rows->flow; their errors. Gravity's work is what the height gives, its
 * impulses are integrals along the motion of the form that filled the rows. */
rot_status rot_pivot_flows(rot_free_rows_of *form, const rot_free_params *p, const rot_task *task,
                           const rot_rows *rows, const rot_info *info, const rot_hooks *hooks);

/* rot_constraint.conserved, .time_scales */
size_t rot_pivot_conserved(const void *scene, size_t balance, const char *why[]);
void rot_pivot_time_scales(const void *scene, const double sizes[], rot_time_scales *time_scales);

#endif
