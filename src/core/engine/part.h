/* A part of a scene that is made by the name of its constructor: a torque law, a resistance, a
 * body, ... . It is built as scenes are, from a table of inputs. */
#ifndef ROT_PART_H
#define ROT_PART_H

#include "engine/input.h"
#include "ground/store.h"

typedef struct rot_part {
  const char *constructor; /* as users call it */
  unsigned makes;          /* one of ROT_INPUT_OBJECTS */
  size_t n_inputs;
  const rot_input *inputs;
  size_t size; /* of what it builds */
  /* From inputs that rot_inputs_check() passed, which must live as long as `to`. What `to` points
   * to is theirs, or the store's. */
  rot_status (*build)(const struct rot_part *part, const rot_given given[], rot_store *store,
                      void *to, rot_refusal *refusal);
} rot_part;

#endif
