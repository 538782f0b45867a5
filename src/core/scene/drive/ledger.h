/* What flows in a drive, and its balances. */
#ifndef ROT_DRIVE_LEDGER_H
#define ROT_DRIVE_LEDGER_H

#include "engine/model.h"
#include "scene/drive/drive.h"

enum { ROT_DRIVE_FLOWS = 10, ROT_DRIVE_BALANCES = 2, ROT_DRIVE_TERMS = 11 };

extern const char *const rot_drive_flow_names[ROT_DRIVE_FLOWS];
extern const rot_balance rot_drive_balances[ROT_DRIVE_BALANCES];
extern const rot_balance_term rot_drive_terms[ROT_DRIVE_TERMS];
enum { ROT_DRIVE_MESH = 1 << 9 }; /* the effect of gears with a loss */

/* Of n rows: what the springs hold more than at the start, with its error. The other errors of the
 * ledger are known. */
void rot_drive_elastic(const rot_drive_scene *scene, size_t n, const rot_drive_columns *rows,
                       const rot_info *info, rot_drive_ledger *ledger);

/* The errors of its flows. That of heat is of all heat: each column of it has its share. */
void rot_drive_flow_errors(const rot_drive_scene *scene, const rot_drive_ledger *ledger,
                           double error[ROT_DRIVE_FLOWS]);

/* rot_constraint.audit and .keeps */
void rot_drive_audit(const void *scene, const rot_span *span, double term[]);
size_t rot_drive_conserved(const void *scene, size_t balance, const char *why[]);

#endif
