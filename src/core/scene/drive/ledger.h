/* Flows of a drive (work, heat, impulses), and its balances. */
#ifndef ROT_DRIVE_LEDGER_H
#define ROT_DRIVE_LEDGER_H

#include "engine/model.h"
#include "scene/drive/drive.h"

enum { ROT_DRIVE_FLOWS = 10, ROT_DRIVE_BALANCES = 2, ROT_DRIVE_TERMS = 11 };

extern const char *const rot_drive_flow_names[ROT_DRIVE_FLOWS];
extern const rot_balance rot_drive_balances[ROT_DRIVE_BALANCES];
extern const rot_balance_term rot_drive_terms[ROT_DRIVE_TERMS];
enum { ROT_DRIVE_MESH = 1 << 9 }; /* effect: lossy gears */

/* n rows => change of the elastic energy since the start, its error; the other errors of the ledger
 * must be set. */
void rot_drive_elastic(const rot_drive_scene *scene, size_t n, const rot_drive_columns *rows,
                       const rot_info *info, rot_drive_ledger *ledger);

/* ledger => errors of its flows. The error of the total heat is divided among its columns. */
void rot_drive_flow_errors(const rot_drive_scene *scene, const rot_drive_ledger *ledger,
                           double error[ROT_DRIVE_FLOWS]);

/* rot_constraint.audit: (two rows, flows) => terms of the balances. */
void rot_drive_audit(const void *scene, const rot_span *span, double term[]);
/* rot_constraint.conserved: balance => number of reasons against conservation, reasons. */
size_t rot_drive_conserved(const void *scene, size_t balance, const char *why[]);

#endif
