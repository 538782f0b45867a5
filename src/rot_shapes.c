#include "rot_shapes.h"

#include <math.h>

#include "rot_real.h"

static const rot_shape shapes[] = {
#define X(name, axis, x, y, z, size, axis_text, formula)                                           \
  {name, axis, {x, y, z}, size, axis_text, formula},
    ROT_SHAPE_LIST(X)
#undef X
};

size_t rot_shape_count(void) { return sizeof shapes / sizeof shapes[0]; }

const rot_shape *rot_shape_at(size_t i) { return &shapes[i]; }

void rot_shapes_table(size_t n, rot_column k, rot_column mass_kg, rot_column size_m,
                       double inertia_kg_m2[], double gyration_m[]) {
  for (size_t i = 0; i < n; i++) {
    const double ki = rot_at(k, i), m = rot_at(mass_kg, i), size = rot_at(size_m, i);
    inertia_kg_m2[i] = rot_product(4, (double[]){ki, m, size, size}, 1.0);
    gyration_m[i] = sqrt(ki) * size;
  }
}
