/* Tables of reference numbers that lie beside the repository, where ROTDYN_SHARED says.
 *
 *   FILE *file = shared_table("refs/eig3.csv");
 *   if (!file) return;
 *   while (shared_row(file, 9, x)) rows++; */
#ifndef SHARED_TABLE_H
#define SHARED_TABLE_H

#include <stdio.h>
#include <stdlib.h>

/* NULL, and a line that counts as a skip, where it is not at hand. */
static inline FILE *shared_table(const char *name) {
  const char *shared = getenv("ROTDYN_SHARED");
  char path[4096];
  FILE *table = NULL;
  if (shared && snprintf(path, sizeof path, "%s/%s", shared, name) < (int)sizeof path)
    table = fopen(path, "r");
  if (!table) printf("skip - %s: ROTDYN_SHARED does not lead to it\n", name);
  return table;
}

/* The first n numbers of the next line that has as many, which the heading has not. At the end it
 * closes the table and returns 0. */
static inline int shared_row(FILE *table, int n, double x[]) {
  char line[8192];
  while (fgets(line, sizeof line, table)) {
    char *at = line, *end = line;
    int i = 0;
    for (; i < n; i++, at = end + (*end == ',')) {
      x[i] = strtod(at, &end);
      if (end == at) break;
    }
    if (i == n) return 1;
  }
  fclose(table);
  return 0;
}

#endif
