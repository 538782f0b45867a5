#include "scene/axle/closed.h"

#include <string.h>

#include "scene/axle/bands.h"
#include "scene/axle/drag.h"
#include "scene/axle/forced.h"
#include "scene/axle/linear.h"
#include "scene/axle/oscillator.h"
#include "scene/axle/pendulum.h"
#include "scene/axle/skater.h"

rot_axle_model rot_axle_closed_form(const char *id) {
  static const struct {
    const char *id;
    rot_axle_model run;
  } list[] = {{"axle_free", rot_axle_free_scene},   {"axle_linear", rot_axle_linear_scene},
              {"axle_skater", rot_axle_skater},     {"axle_drag", rot_axle_drag},
              {"axle_forced", rot_axle_forced},     {"axle_oscillator", rot_axle_oscillator},
              {"axle_pendulum", rot_axle_pendulum}, {"axle_bands", rot_axle_bands}};
  for (size_t i = 0; i < sizeof list / sizeof *list; i++) {
    if (!strcmp(list[i].id, id)) return list[i].run;
  }
  return NULL;
}
