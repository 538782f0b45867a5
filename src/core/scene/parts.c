#include "scene/parts.h"

#include <string.h>

#include "body/compound.h"
#include "body/parts.h"
#include "engine/laws.h"
#include "scene/axle/inputs.h"
#include "scene/drive/inputs.h"
#include "scene/free/parts.h"

const rot_part *rot_part_at(size_t i) {
  const struct {
    const rot_part *list;
    size_t n;
  } all[] = {{rot_body_parts, rot_body_n_parts},   {rot_compound_parts, rot_compound_n_parts},
             {rot_law_parts, rot_law_n_parts},     {rot_axle_parts, rot_axle_n_parts},
             {rot_drive_parts, rot_drive_n_parts}, {rot_free_parts, rot_free_n_parts}};
  for (size_t k = 0; k < sizeof all / sizeof *all; k++) {
    if (i < all[k].n) return &all[k].list[i];
    i -= all[k].n;
  }
  return NULL;
}

const rot_part *rot_part_named(const char *constructor) {
  const rot_part *part;
  for (size_t i = 0; (part = rot_part_at(i)) != NULL; i++) {
    if (!strcmp(part->constructor, constructor)) return part;
  }
  return NULL;
}
