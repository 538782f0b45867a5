/* A scene of which some numbers vary: named by their paths, set, and built again. */
#ifndef ROT_VARIANTS_H
#define ROT_VARIANTS_H

#include "object/object.h"

/* A path is the name of an input of the scene, of a part after `$`, with the place of an item or of
 * a number in brackets, from 1: "body$mass_kg", "pivot_m[3]", "bodies[2]$radius_m". */

/* One number that may vary. */
typedef struct rot_place {
  const rot_object *object; /* the scene, part or list that has it */
  const rot_input *input;   /* that it is a value of */
  size_t at;                /* which of the object's values */
  size_t element;           /* of several numbers: from 1; 0: the value is one number */
  double value;             /* now; NaN: the default follows from others, or it is an object */
} rot_place;

/* Called for each number that may vary, in the order of the inputs. Not 0 ends the walk. */
typedef int (*rot_place_visit)(const rot_place *place, const char *path, void *ctx);
/* Visits the numbers of a scene, those of its parts and lists among them. */
void rot_variants_walk(const rot_object *scene, rot_place_visit visit, void *ctx);

typedef struct rot_variants rot_variants;

/* (scene, n paths) => variants. The scene must outlive them and not change. ROT_EVALUE: a path
 * names no number that may vary, or the scene is refused; `no->input` is the path's place then. */
rot_status rot_variants_new(const rot_object *scene, size_t n, const char *const paths[],
                            rot_variants **to, rot_refusal *no);
/* Frees; NULL: does nothing. */
void rot_variants_free(rot_variants *variants);

/* => the scene itself, before the first rot_variants_build() */
const void *rot_variants_base(const rot_variants *variants);
/* Sets number i (the place of its path); counts with the next rot_variants_build(). */
void rot_variants_set(rot_variants *variants, size_t i, double value);
/* => the scene with the numbers set, as the models of the constraint read it, until the next call.
 * ROT_EVALUE: a builder refuses them. */
rot_status rot_variants_build(rot_variants *variants, const void **scene, rot_refusal *no);

#endif
