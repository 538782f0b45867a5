/* Rows of a sweep by a batch kernel of the constraint (engine/batch.h): the outputs of the rows of
 * sweep/rows.h, within the error figures of both, at a fraction of the time. */
#ifndef ROT_SWEEP_TABLE_H
#define ROT_SWEEP_TABLE_H

#include "sweep/rows.h"

typedef struct rot_table rot_table; /* of one thread */

/* The kernel for a plan with a named model, one time, states and errors as outputs. *to is NULL if
 * there is none. */
rot_status rot_table_open(const rot_row_plan *plan, rot_table **to);
void rot_table_close(rot_table *table);

/* Rows first .. first + n - 1 of columns, n <= ROT_BATCH_ROWS. Those that the kernel leaves have
 * the status ROT_TABLE_LEFT: they are for rot_rows_run(). */
enum { ROT_TABLE_LEFT = -1 };
rot_status rot_table_run(rot_table *table, size_t first, size_t n, const double *const input[],
                         double *const output[], double error[], int status[]);

#endif
