/* Inputs: the named arguments from which a scene, or a part of one, is built. A constraint or a
 * part lists them, and every caller reads that list: names with units, kinds, domains, defaults. */
#ifndef ROT_INPUT_H
#define ROT_INPUT_H

#include "ground/status.h"

enum { ROT_MAX_INPUTS = 32 };

/* An input takes one kind, or one of several: a mask. Those from ROT_INPUT_BODY on, but for a law,
 * are objects: what a part of this kind builds (engine/part.h). */
typedef enum rot_input_kind {
  ROT_INPUT_NUMBER = 1,    /* finite */
  ROT_INPUT_LIMIT = 2,     /* finite, or Inf */
  ROT_INPUT_TIMES = 4,     /* any number of them, finite and increasing */
  ROT_INPUT_VECTOR = 8,    /* three finite numbers */
  ROT_INPUT_ATTITUDE = 16, /* a quaternion, scalar first, not 0: it is scaled to unit length */
  ROT_INPUT_CHOICE = 32,   /* one of `options` */
  ROT_INPUT_BODY = 64,
  ROT_INPUT_LAW = 128,      /* a function that the caller evaluates */
  ROT_INPUT_NUMBERS = 256,  /* any count of finite numbers */
  ROT_INPUT_LIST = 512,     /* of what the input takes else, or of such lists */
  ROT_INPUT_NOTHING = 1024, /* an empty place of a list */
  ROT_INPUT_TEXT = 2048,    /* any text: no number depends on it, but for the options of a choice */
  ROT_INPUT_TORQUE = 4096,
  ROT_INPUT_RESISTANCE = 8192,
  ROT_INPUT_INERTIA = 16384, /* a moment of inertia that changes in time */
  ROT_INPUT_COUPLING = 32768,
  ROT_INPUT_BRAKE = 65536,
  ROT_INPUT_TABLE = 131072,   /* torques at times, linear between them */
  ROT_INPUT_ROTOR = 262144,   /* that a body carries */
  ROT_INPUT_MOMENTS = 524288, /* principal moments, and their axes */
  ROT_INPUT_POINTS = 1048576, /* masses and their places */
  ROT_INPUT_SIZES = 2097152,  /* of a body, by name */
  ROT_INPUT_RATES = 4194304   /* with a law: it gives a number for each that follows the time */
} rot_input_kind;

enum {
  ROT_INPUT_OBJECTS = ROT_INPUT_BODY | ROT_INPUT_TORQUE | ROT_INPUT_RESISTANCE | ROT_INPUT_INERTIA |
                      ROT_INPUT_COUPLING | ROT_INPUT_BRAKE | ROT_INPUT_TABLE | ROT_INPUT_ROTOR |
                      ROT_INPUT_MOMENTS | ROT_INPUT_POINTS | ROT_INPUT_SIZES
};

typedef struct rot_input {
  const char *name, *unit; /* "1": a number without unit; "": none */
  unsigned kinds;
  int required;
  double low, high; /* of numbers and limits: the domain; -Inf: a limit may be -Inf, */
  int above;        /* without `low` itself */
  double otherwise; /* of numbers: the default; NaN: as `words` say */
  const char *words;
  /* Of a choice, the first is the default; the list ends with NULL. Of one number: the input whose
   * value is its default, and the most that it may be. Of a law: its arguments after the time, each
   * with how many numbers it has ("attitude:4"); NULL: the position and the rate, or the states of
   * a law of rates. */
  const char *const *options;
} rot_input;

#define ROT_NUMBER_INPUT(name, unit, required, low, above, otherwise, words)                       \
  { name, unit, ROT_INPUT_NUMBER, required, low, DBL_MAX, above, otherwise, words, NULL }
#define ROT_NO_DOMAIN -DBL_MAX, DBL_MAX, 0

/* The options of kinetic friction. */
extern const char *const rot_max_static[];

/* Of a body as an input. */
typedef struct rot_given_body {
  double mass_kg;
  double centre_m[3];      /* of mass, in its own axes */
  double inertia_kg_m2[6]; /* tensor about it: xx, yy, zz, xy, xz, yz */
  double second_kg_m2[6];  /* second moments about it (body/inertia.h) */
  double axle_m[3];        /* a point of the axle that it names: else the centre */
  double radius_m;         /* on which it rolls about its own z axis; NaN: it has none */
} rot_given_body;

/* The values of a law at its arguments, which stand one after the other: rot_input_values() of
 * them. */
typedef struct rot_law {
  rot_status (*call)(const double argument[], double value[], void *ctx);
  void *ctx;
  double noise; /* how far each value may be off, where they are samples of another */
} rot_law;

/* What was given for an input. */
typedef struct rot_given {
  unsigned is; /* its kind; 0: not given */
  size_t n;    /* of numbers, of the items of a list */
  const double *x;
  const struct rot_given *item;
  int option; /* of a choice: its place */
  rot_given_body body;
  rot_law law;
  const void *object; /* what its part built; a body is above */
} rot_given;

/* Why a scene or a part was not built: an input, and what it must be. */
typedef struct rot_refusal {
  size_t input;
  char reason[400];
} rot_refusal;

/* The place of a name in a list; n: it is not there. */
size_t rot_input_named(size_t n, const rot_input inputs[], const char *name);

/* The input that is the default of this one, and the most it may be; this one: none. Stands before
 * it. */
size_t rot_input_max(const rot_input inputs[], size_t input);

/* Whether an input is given that must be, and lies in its domain: ROT_OK, or ROT_EVALUE. */
rot_status rot_input_check(size_t input, const rot_input inputs[], const rot_given given[],
                           rot_refusal *refusal);

/* Whether each input is given that must be, and lies in its domain: ROT_OK, or ROT_EVALUE with the
 * first that does not. */
rot_status rot_inputs_check(size_t n, const rot_input inputs[], const rot_given given[],
                            rot_refusal *refusal);

/* ROT_EVALUE, with the input and why it is refused. */
rot_status rot_refuse(rot_refusal *refusal, size_t input, const char *format, ...);

/* The same with two numbers, each the shortest text that reads back: `format` has two %s. */
rot_status rot_refuse_numbers(rot_refusal *refusal, size_t input, const char *format, double first,
                              double second);

/* Puts the place where it was refused in front of the reason: "item 2". */
void rot_refused_in(rot_refusal *refusal, const char *format, ...);

/* How many numbers each argument of a law has, the time the first; returns their count. */
enum { ROT_MAX_LAW_ARGUMENTS = 4 };
size_t rot_input_arguments(const rot_input *input, size_t size[ROT_MAX_LAW_ARGUMENTS]);
/* How many numbers the law gives: three where the input takes vectors, else one. */
size_t rot_input_values(const rot_input *input);

/* The number given, or the default. */
double rot_input_number(const rot_input inputs[], const rot_given given[], size_t input);
/* The same of n inputs. */
void rot_input_numbers(size_t n, const rot_input inputs[], const rot_given given[], double x[]);
/* The three numbers given, or 0. */
void rot_input_vector(const rot_given *given, double x[3]);
/* Three numbers scaled to unit length; a unit vector within rounding keeps its bits. 0: all are
 * 0. */
int rot_input_axis(const double x[3], double axis[3]);
/* n numbers: those given, or one for all, or the default for all. ROT_EVALUE: another count. */
rot_status rot_input_each(const rot_input inputs[], const rot_given given[], size_t input, size_t n,
                          double x[], rot_refusal *refusal);

#endif
