/* Inputs: the named arguments from which a scene is built. A constraint lists them, and every
 * caller reads that list: names with units, kinds, domains, defaults. */
#ifndef ROT_INPUT_H
#define ROT_INPUT_H

#include "ground/status.h"

enum { ROT_MOST_INPUTS = 32 };

/* An input takes one kind, or one of several: a mask. */
typedef enum rot_input_kind {
  ROT_INPUT_NUMBER = 1,    /* finite */
  ROT_INPUT_LIMIT = 2,     /* finite, or Inf */
  ROT_INPUT_TIMES = 4,     /* any number of them, finite and increasing */
  ROT_INPUT_VECTOR = 8,    /* three finite numbers */
  ROT_INPUT_ATTITUDE = 16, /* a quaternion, scalar first, not 0: it is scaled to unit length */
  ROT_INPUT_CHOICE = 32,   /* one of `options` */
  ROT_INPUT_BODY = 64,
  ROT_INPUT_LAW = 128,    /* a function that the caller evaluates */
  ROT_INPUT_NUMBERS = 256 /* one or more, each finite */
} rot_input_kind;

typedef struct rot_input {
  const char *name, *unit; /* "1": a number without unit; "": none */
  unsigned kinds;
  int required;
  double low, high; /* of numbers and limits: the domain, */
  int above;        /* without `low` itself */
  double otherwise; /* of numbers: the default; NaN: as `words` say */
  const char *words;
  const char *const *options; /* of a choice, the first is the default; the list ends with NULL */
} rot_input;

/* A number as an input: required, or with a default (NaN: as the words say). At least or above
 * `low`, at most `high`. */
#define ROT_REQUIRED(name, unit, low, above, high, words)                                          \
  { name, unit, ROT_INPUT_NUMBER, 1, low, high, above, NAN, words, NULL }
#define ROT_OPTIONAL(name, unit, low, high, otherwise, words)                                      \
  { name, unit, ROT_INPUT_NUMBER, 0, low, high, 0, otherwise, words, NULL }

/* Of a body as an input. */
typedef struct rot_given_body {
  double mass_kg;
  double centre_m[3];      /* of mass, in its own axes */
  double inertia_kg_m2[6]; /* tensor about it: xx, yy, zz, xy, xz, yz */
  double radius_m;         /* on which it rolls about its own z axis; NaN: it has none */
} rot_given_body;

/* The values of a law at its arguments, in the order that the input's words say. */
typedef struct rot_law {
  rot_status (*call)(const double argument[], double value[], void *ctx);
  void *ctx;
} rot_law;

/* What was given for an input. */
typedef struct rot_given {
  unsigned is; /* its kind; 0: not given */
  size_t n;    /* of numbers */
  const double *x;
  int option; /* of a choice: its place */
  rot_given_body body;
  rot_law law;
} rot_given;

/* Why a scene was not built: an input, and what it must be. */
typedef struct rot_refusal {
  size_t input;
  char reason[240];
} rot_refusal;

/* The place of a name in a list; n: it is not there. */
size_t rot_input_named(size_t n, const rot_input inputs[], const char *name);

/* Whether each input is given that must be, and lies in its domain: ROT_OK, or ROT_EVALUE with the
 * first that does not. */
rot_status rot_inputs_check(size_t n, const rot_input inputs[], const rot_given given[],
                            rot_refusal *refusal);

/* ROT_EVALUE, with the input and why it is refused. */
rot_status rot_refuse(rot_refusal *refusal, size_t input, const char *format, ...);

/* The number given, or the default. */
double rot_input_number(const rot_input inputs[], const rot_given given[], size_t input);
/* The three numbers given, or 0. */
void rot_input_vector(const rot_given *given, double x[3]);

#endif
