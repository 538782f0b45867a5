/* What acts on an axle at one instant, and the times where it changes abruptly. */
#include "scene/axle/scene.h"

#include "scene/axle/time_scales.h"
#include "ground/real.h"
#include "rot_test.h"

static const double knots_s[] = {1.0, 1.0, 4.0}, torque_n_m[] = {2.0, 3.0, 6.0};
static const double told_s[] = {9.0, 4.0, -7.0};
static const double moments_s[] = {0.0, 2.0}, moments[] = {2.0, 4.0};
static const double pieces[] = {2, 1, -2.0, 1.0, 3.0, 1, 1}, spring[] = {8.0, 0.25};

/* Each time once, in order, wherever it comes from. */
static void check_breaks(void) {
  const rot_term terms[] = {{ROT_TERM_POLYNOMIAL, -INFINITY, INFINITY, 7, pieces},
                            {ROT_TERM_SPRING, 5.0, INFINITY, 2, spring}};
  rot_axle_scene scene = {.linear.torque = {.n = 3, .time_s = knots_s, .torque_n_m = torque_n_m}};
  const double want[] = {-7.0, -2.0, 0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 9.0};
  double out[32];
  ROT_CHECK_EQ_INT((int)rot_axle_scene_breaks(&scene, out), 2);
  ROT_CHECK(out[0] == 1.0 && out[1] == 4.0);
  scene.terms = terms;
  scene.n_terms = 2;
  scene.inertia_time_s = moments_s;
  scene.inertia_kg_m2 = moments;
  scene.n_inertia = 2;
  scene.breaks_s = told_s;
  scene.n_breaks = 3;
  ROT_CHECK(rot_axle_scene_room(&scene) <= 32);
  ROT_CHECK_EQ_INT((int)rot_axle_scene_breaks(&scene, out), 9);
  for (int i = 0; i < 9; i++) ROT_CHECK(out[i] == want[i]);
  scene = (rot_axle_scene){.n_terms = 0};
  ROT_CHECK_EQ_INT((int)rot_axle_scene_breaks(&scene, out), 0);
}

static void check_row(void) {
  const rot_term term = {ROT_TERM_SPRING, -INFINITY, INFINITY, 2, spring};
  const rot_axle_scene scene = {
      .linear = {.inertia_kg_m2 = 2.0, .torque = {.before_n_m = 5.0, .after_n_m = 5.0}},
      .viscous_n_m_s = 0.5,
      .motor_n_m_s = 0.25,
      .quadratic_n_m_s2 = 2.0,
      .coulomb_n_m = 3.0,
      .n_terms = 1,
      .terms = &term,
      .n_inertia = 2,
      .inertia_time_s = moments_s,
      .inertia_kg_m2 = moments};
  double row[7];
  const rot_axle_columns out = {row, row + 1, row + 2, row + 3, row + 4, row + 5, row + 6};
  /* 5 - 8 (1.25 - 0.25) - 0.25 (-2) = -2.5; 1 + 8 + 3 = 12; I(1) = 3 */
  const double applied = rot_axle_scene_applied(&scene, 1.0, 1.25, 0.0, -2.0);
  ROT_CHECK(applied == -2.5);
  ROT_CHECK(rot_axle_scene_resistance(&scene, -2.0) == 12.0);
  ROT_CHECK(rot_axle_scene_resistance(&scene, 0.0) == 0.0);
  ROT_CHECK(rot_axle_scene_inertia(&scene, 1.0) == 3.0);
  rot_axle_scene_row(&scene, &out, 0, 1.0, 1.25, -2.0, applied, 0);
  const double want[] = {1.25, -2.0, -2.5, 12.0, 9.5, -6.0, 6.0};
  for (int i = 0; i < 7; i++) ROT_CHECK(row[i] == want[i]);
  rot_axle_scene_row(&scene, &out, 0, 1.0, 1.25, 0.0, -2.0, 1);
  ROT_CHECK(row[3] == 2.0 && row[4] == 0.0); /* held */
}

/* The same torques for given states; at rest friction holds, or opposes breaking loose. */
static void check_torques(void) {
  const rot_axle_scene scene = {
      .linear = {.inertia_kg_m2 = 2.0, .torque = {.before_n_m = 5.0, .after_n_m = 5.0}},
      .viscous_n_m_s = 0.5,
      .quadratic_n_m_s2 = 2.0,
      .coulomb_n_m = 3.0,
      .static_n_m = 4.0};
  const double zero[] = {0.0, 0.0}, omega[] = {-2.0, 0.0};
  double applied[2], damping[2], net[2];
  rot_axle_scene_torques(&scene, 2, zero, zero, omega, applied, damping, net);
  ROT_CHECK(applied[0] == 5.0 && damping[0] == 12.0 && net[0] == 17.0);
  ROT_CHECK(applied[1] == 5.0 && damping[1] == -3.0 && net[1] == 2.0);
  rot_axle_scene held = scene;
  held.static_n_m = 5.0;
  rot_axle_scene_torques(&held, 2, zero, zero, omega, applied, damping, net);
  ROT_CHECK(damping[1] == -5.0 && net[1] == 0.0);
}

/* A scene is plain where none of its numbers is near the ends of the range of doubles. */
static void check_plain(void) {
  const rot_info info = {0};
  const rot_axle_scene plain = {
      .linear = {.inertia_kg_m2 = 2.0, .torque = {.before_n_m = 5.0, .after_n_m = 5.0}},
      .viscous_n_m_s = 0.5,
      .quadratic_n_m_s2 = 2.0,
      .static_n_m = 4.0};
  ROT_CHECK(rot_axle_scene_plain(&plain, &info));
  rot_axle_scene scene[7];
  for (int i = 0; i < 7; i++) scene[i] = plain;
  scene[0].linear.inertia_kg_m2 = 1e80;
  scene[1].viscous_n_m_s = -1e80;
  scene[2].motor_n_m_s = 1e80;
  scene[3].quadratic_n_m_s2 = 1e80;
  scene[4].static_n_m = 1e80;
  scene[5].linear.torque.before_n_m = -1e80;
  scene[6].linear.torque.after_n_m = -1e80;
  for (int i = 0; i < 7; i++) ROT_CHECK(!rot_axle_scene_plain(&scene[i], &info));
}

/* How fast a motion goes: rates of what damps add up, over the least inertia; of laws the fastest
 * counts. */
static void check_time_scales(void) {
  const double sizes[] = {0.0, 5.0};
  const rot_axle_scene damped = {
      .linear = {.inertia_kg_m2 = 2.0}, .viscous_n_m_s = 0.5, .quadratic_n_m_s2 = 0.25};
  rot_time_scales time_scales;
  rot_axle_time_scales(&damped, sizes, &time_scales);
  ROT_CHECK(time_scales.fades_s == 2.0 / (0.5 + 2.0 * 0.25 * 5.0) &&
            time_scales.swing_rad_per_s == 0.0);
  const double stiff[] = {18.0, 0.0};
  const rot_term law = {ROT_TERM_SPRING, -INFINITY, INFINITY, 2, stiff};
  rot_axle_scene swings = {.linear = {.inertia_kg_m2 = 2.0}, .n_terms = 1, .terms = &law};
  rot_axle_time_scales(&swings, sizes, &time_scales);
  ROT_CHECK_REL(time_scales.fades_s, 1.0 / 3.0, 1e-15);
  ROT_CHECK_REL(time_scales.swing_rad_per_s, 3.0, 1e-15);
  const double inertia[] = {2.0, 0.5};
  swings.n_inertia = 2;
  swings.inertia_kg_m2 = inertia;
  rot_axle_time_scales(&swings, sizes, &time_scales);
  ROT_CHECK_REL(time_scales.fades_s, 1.0 / 6.0, 1e-15);
  const rot_axle_scene free = {.linear = {.inertia_kg_m2 = 2.0}};
  rot_axle_time_scales(&free, sizes, &time_scales);
  ROT_CHECK(isinf(time_scales.fades_s) && time_scales.swing_rad_per_s == 0.0);
}

int main(void) {
  check_breaks();
  check_row();
  check_torques();
  check_plain();
  check_time_scales();
  return rot_test_report("axle_scene");
}
