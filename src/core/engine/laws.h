/* The constructors of torque laws. */
#ifndef ROT_LAWS_H
#define ROT_LAWS_H

#include "engine/loads.h"

extern const rot_part rot_law_parts[];
extern const size_t rot_law_n_parts;

/* Inputs from when on and until when something acts: LIMITs that may be infinite. */
#define ROT_WINDOW_INPUTS(from)                                                                    \
  {"from_s", "s", ROT_INPUT_LIMIT, 0, -INFINITY, INFINITY, 0, from, "it acts from then on", NULL}, \
  {                                                                                                \
    "to_s", "s", ROT_INPUT_LIMIT, 0, -INFINITY, INFINITY, 0, INFINITY, "and before", NULL          \
  }

/* Of an input `from` of a table and the one behind it. */
rot_status rot_law_window(const rot_input inputs[], const rot_given given[], size_t from,
                          double window[2], rot_refusal *refusal);

#endif
