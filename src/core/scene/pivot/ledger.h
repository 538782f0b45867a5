/* Work and impulse of gravity on a body with a fixed point in closed form; conserved quantities. */
#ifndef ROT_PIVOT_LEDGER_H
#define ROT_PIVOT_LEDGER_H

#include "engine/model.h"
#include "scene/free/scene.h"

/* (rows of a closed form) => rows->flow since the start, their errors. Work of gravity: from the
 * height; impulses: integrals along the motion of the form that filled the rows. */
rot_status rot_pivot_flows(rot_free_rows_of *form, const rot_free_params *p, const rot_task *task,
                           const rot_rows *rows, const rot_info *info, const rot_hooks *hooks);

/* rot_constraint.conserved: balance => number of reasons against conservation, reasons. */
size_t rot_pivot_conserved(const void *scene, size_t balance, const char *why[]);
/* rot_constraint.time_scales: largest values of the measures => time scales. */
void rot_pivot_time_scales(const void *scene, const double sizes[], rot_time_scales *time_scales);

#endif
