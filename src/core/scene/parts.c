#include "scene/parts.h"

#include <string.h>

#include "body/compound.h"
#include "body/parts.h"
#include "engine/laws.h"
#include "engine/resistance.h"
#include "scene/axle/inputs.h"
#include "scene/drive/inputs.h"
#include "scene/free/parts.h"

/* Number of lists of parts, one per folder. */
enum { LISTS = 7 };

static const rot_part *list_at(size_t k, size_t *n) {
  switch (k) {
  case 0: return (*n = rot_body_n_parts, rot_body_parts);
  case 1: return (*n = rot_compound_n_parts, rot_compound_parts);
  case 2: return (*n = rot_law_n_parts, rot_law_parts);
  case 3: return (*n = rot_axle_n_parts, rot_axle_parts);
  case 4: return (*n = rot_drive_n_parts, rot_drive_parts);
  case 5: return (*n = 1, &rot_resistance_part);
  default: return (*n = rot_free_n_parts, rot_free_parts);
  }
}

const rot_part *rot_part_at(size_t i) {
  for (size_t k = 0, n; k < LISTS; k++) {
    const rot_part *list = list_at(k, &n);
    if (i < n) return &list[i];
    i -= n;
  }
  return NULL;
}

const rot_part *rot_part_named(const char *constructor) {
  for (size_t k = 0, n; k < LISTS; k++) {
    const rot_part *list = list_at(k, &n);
    for (size_t i = 0; i < n; i++) {
      if (!strcmp(list[i].constructor, constructor)) return &list[i];
    }
  }
  return NULL;
}
