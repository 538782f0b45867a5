/* The entries of web/core/lab.c as a program with GSL. A line of input is
 *
 *   START END ROWS ACCURACY STEPS SCENE
 *
 * the answer has these lines: what the scene is, the report, the models, the audit, the code (its
 * lines joined by a tab), then a line for each column, its values as hexadecimal digits; "end". */
#include <inttypes.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

char *lab_input(size_t n);
const char *lab_read(void);
const char *lab_run(double start, double end, unsigned n, double accuracy, double max_steps);
const double *lab_column(unsigned i);
const char *lab_models(void);
const char *lab_audit(void);
const char *lab_code(void);
const char *lab_catalogue(void);
size_t lab_rows(void);
void lab_close(void);

static char *line;
static size_t room;

static int read_line(void) {
  size_t n = 0;
  for (int c = getchar(); c != EOF && c != '\n'; c = getchar()) {
    if (n + 2 > room) line = realloc(line, room = 2 * room + 1024);
    if (!line) abort();
    line[n++] = (char)c;
  }
  if (n) line[n] = '\0';
  return n > 0;
}

static const char *answered(const char *answer) { return answer ? answer : "null"; }

static void put(const char *text) {
  char *input = lab_input(strlen(text));
  if (input) memcpy(input, text, strlen(text));
}

int main(void) {
  puts(answered(lab_catalogue()));
  (void)fflush(stdout);
  while (read_line()) {
    double start, end, accuracy, steps;
    unsigned rows;
    int at = 0;
    if (sscanf(line, "%lf %lf %u %lf %lf %n", &start, &end, &rows, &accuracy, &steps, &at) < 5) {
      return 2;
    }
    put(line + at);
    puts(answered(lab_read()));
    put("");
    const char *report = lab_run(start, end, rows, accuracy, steps);
    puts(answered(report));
    if (report) {
      puts(answered(lab_models()));
      puts(answered(lab_audit()));
      for (const char *c = answered(lab_code()); *c; c++) putchar(*c == '\n' ? '\t' : *c);
      putchar('\n');
      const double *column;
      for (unsigned i = 0; (column = lab_column(i)) != NULL; i++) {
        for (size_t k = 0; k < rows * lab_rows(); k++) {
          uint64_t bits;
          memcpy(&bits, &column[k], sizeof bits);
          printf("%016" PRIx64, bits);
        }
        putchar('\n');
      }
    }
    puts("end");
    (void)fflush(stdout);
  }
  free(line);
  lab_close();
  return 0;
}
