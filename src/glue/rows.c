/* For R: the numbers of a scene that may vary, its outputs, rows of a sweep. */
#include "sweep/rows.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "glue/object.h"
#include "sweep/outputs.h"

/* ---- what may vary, what comes out ----------------------------------------------------------- */

enum { TEXT = 256 };

/* Lists of texts and numbers are collected in C first: R allocates nothing during a walk. */
typedef struct entry {
  char path[TEXT];
  const char *unit, *words;
  double value, low, high;
  int above;
  struct entry *next;
} entry;

typedef struct entries {
  entry *first, **last;
  R_xlen_t n;
} entries;

static entry *add_entry(entries *to, const char *path) {
  entry *e = calloc(1, sizeof *e);
  if (!e) return NULL;
  (void)snprintf(e->path, TEXT, "%s", path);
  *to->last = e;
  to->last = &e->next;
  to->n++;
  return e;
}

static void free_entries(entries *of) {
  while (of->first) {
    entry *next = of->first->next;
    free(of->first);
    of->first = next;
  }
}

static int take_place(const rot_place *place, const char *path, void *ctx) {
  entry *e = add_entry(ctx, path);
  if (!e) return 1;
  e->unit = place->input->unit;
  e->words = place->input->words;
  e->value = place->value;
  e->low = place->input->low;
  e->high = place->input->high;
  e->above = place->input->above;
  return 0;
}

static int take_output(const char *name, const char *unit, const char *words, void *ctx) {
  entry *e = add_entry(ctx, name);
  if (!e) return 1;
  e->unit = unit;
  e->words = words;
  return 0;
}

/* Frees the entries. */
static SEXP list_of(entries *of) {
  static const char *const names[] = {"path", "unit", "words", "value", "low", "high", "above", ""};
  SEXP out = PROTECT(Rf_mkNamed(VECSXP, (const char **)names));
  SEXP text[3];
  for (int k = 0; k < 3; k++) SET_VECTOR_ELT(out, k, text[k] = Rf_allocVector(STRSXP, of->n));
  double *number[3];
  for (int k = 0; k < 3; k++) {
    SEXP x = Rf_allocVector(REALSXP, of->n);
    SET_VECTOR_ELT(out, 3 + k, x);
    number[k] = REAL(x);
  }
  SEXP above = Rf_allocVector(LGLSXP, of->n);
  SET_VECTOR_ELT(out, 6, above);
  R_xlen_t i = 0;
  for (const entry *e = of->first; e; e = e->next, i++) {
    SET_STRING_ELT(text[0], i, Rf_mkChar(e->path));
    SET_STRING_ELT(text[1], i, e->unit ? Rf_mkChar(e->unit) : NA_STRING);
    SET_STRING_ELT(text[2], i, e->words ? Rf_mkChar(e->words) : NA_STRING);
    number[0][i] = e->value;
    number[1][i] = e->low;
    number[2][i] = e->high;
    LOGICAL(above)[i] = e->above;
  }
  free_entries(of);
  UNPROTECT(1);
  return out;
}

static rot_object *object_of(SEXP node) {
  char fault[FFI_OBJECT_FAULT];
  rot_object *scene = ffi_object(node, fault);
  if (!scene) Rf_error("internal: %s", fault);
  return scene;
}

/* node of a scene => list(path, unit, words, value, low, high, above) of the numbers that may
 * vary */
SEXP ffi_sweep_inputs(SEXP node) {
  rot_object *scene = object_of(node);
  entries found = {NULL, &found.first, 0};
  rot_variants_walk(scene, take_place, &found);
  rot_object_free(scene);
  return list_of(&found);
}

/* node of a scene => list(path, unit, words, ...) of its outputs */
SEXP ffi_sweep_outputs(SEXP node) {
  rot_object *scene = object_of(node);
  entries found = {NULL, &found.first, 0};
  rot_variants *variants = NULL;
  rot_refusal no;
  const rot_status status = rot_variants_new(scene, 0, NULL, &variants, &no);
  if (status == ROT_OK) {
    rot_outputs_walk(scene->constraint, rot_variants_base(variants), take_output, &found);
  }
  rot_variants_free(variants);
  rot_object_free(scene);
  if (status != ROT_OK) {
    Rf_error("internal: %s", status == ROT_EVALUE ? no.reason : rot_status_text(status));
  }
  return list_of(&found);
}
