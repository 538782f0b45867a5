/* The effects of a scene, and which closed forms take it. */
#include "scene/axle/effects.h"
#include "rot_test.h"

#include <math.h>

static rot_axle_scene plain(void) {
  const rot_axle_scene scene = {.linear = {.inertia_kg_m2 = 1.0}};
  return scene;
}

int main(void) {
  const double t[] = {0.0, 1.0, 1.0}, steps[] = {2.0, 2.0, 1.0}, ramp[] = {0.0, 2.0, 2.0};
  const double x[] = {1.0, 2.0, 0.0}, inertia[] = {1.0, 2.0, 0.0};
  rot_axle_scene scene = plain();
  ROT_CHECK(rot_axle_effects(&scene) == 0u && rot_axle_fits(&scene, 0u));
  scene.linear.torque = (rot_torque){3, t, steps, 2.0, 1.0, NULL, NULL};
  ROT_CHECK(rot_axle_effects(&scene) == ROT_AXLE_TORQUE);
  ROT_CHECK(rot_axle_fits(&scene, ROT_AXLE_DRAG_TAKES) && !rot_axle_fits(&scene, 0u));
  scene.linear.torque.torque_n_m = ramp;
  ROT_CHECK(rot_axle_effects(&scene) == (ROT_AXLE_TORQUE | ROT_AXLE_RAMP));
  ROT_CHECK(!rot_axle_fits(&scene, ROT_AXLE_DRAG_TAKES));
  ROT_CHECK(rot_axle_fits(&scene, ROT_AXLE_BANDS_TAKES));
  for (int kind = 0; kind < ROT_TERM_KINDS; kind++) {
    const rot_term term = {(rot_term_kind)kind, -INFINITY, INFINITY, 3, x};
    scene = plain();
    scene.n_terms = 1;
    scene.terms = &term;
    ROT_CHECK(rot_axle_effects(&scene) == 1u << (ROT_AXLE_INDEX_SINUSOID + kind));
  }
  scene = plain();
  scene.viscous_n_m_s = scene.motor_n_m_s = scene.quadratic_n_m_s2 = scene.static_n_m = 1.0;
  ROT_CHECK(rot_axle_effects(&scene) ==
            (ROT_AXLE_VISCOUS | ROT_AXLE_MOTOR | ROT_AXLE_QUADRATIC | ROT_AXLE_FRICTION));
  scene = plain();
  scene.n_inertia = 2;
  scene.inertia_time_s = t;
  scene.inertia_kg_m2 = inertia;
  ROT_CHECK(rot_axle_fits(&scene, ROT_AXLE_SKATER_TAKES));
  ROT_CHECK(!rot_axle_fits(&scene, ROT_AXLE_LINEAR_TAKES));
  scene.n_inertia = 3; /* a moment of 0 */
  ROT_CHECK(!rot_axle_fits(&scene, ROT_AXLE_SKATER_TAKES));
  return rot_test_report("axle_effects");
}
