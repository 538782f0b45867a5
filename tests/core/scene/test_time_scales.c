/* Time scales of the constraints that take steps of fixed length, by hand from their loads. */
#include "scene/axle/time_scales.h"

#include "scene/drive/drive.h"
#include "scene/drive/time_scales.h"
#include "scene/incline/incline.h"
#include "scene/incline/ode.h"
#include "scene/incline/time_scales.h"
#include "rot_test.h"

/* I = 4 kg m^2 and one term. */
static rot_axle_scene with_term(rot_term *term, rot_term_kind kind, size_t length,
                                const double x[]) {
  *term = (rot_term){kind, -INFINITY, INFINITY, length, x};
  return (rot_axle_scene){.linear.inertia_kg_m2 = 4.0, .n_terms = 1, .terms = term};
}

static void expect_rates(const rot_axle_scene *scene, double omega, double decay, double swing) {
  const rot_axle_rates rates = rot_axle_rates_of(scene, omega);
  ROT_CHECK(rates.decay_per_s == decay && rates.swing_rad_per_s == swing);
}

static void check_axle(void) {
  rot_term term;
  /* A spring of 36 N m/rad: sqrt(36/4) rad/s. Gravity of 36 N m: a body that falls from the top is
   * twice as fast below, 2 sqrt(36/4), unless it rotates faster. */
  const double spring[] = {36.0, 0.0}, wave[] = {5.0, -7.0, 0.0}, fading[] = {5.0, 4.0, 0.0};
  const double curve[] = {3, 0.0, 1.0, 3.0, 5.0, 2.0, -6.0}; /* -3, -4 N m s */
  rot_axle_scene scene = with_term(&term, ROT_TERM_SPRING, 2, spring);
  expect_rates(&scene, 100.0, 3.0, 3.0);
  scene = with_term(&term, ROT_TERM_GRAVITY, 2, spring);
  expect_rates(&scene, 0.0, 6.0, 6.0);
  expect_rates(&scene, 100.0, 6.0, 100.0);
  scene = with_term(&term, ROT_TERM_SINUSOID, 3, wave);
  expect_rates(&scene, 0.0, 7.0, 7.0);
  scene = with_term(&term, ROT_TERM_EXPONENTIAL, 3, fading);
  expect_rates(&scene, 0.0, 4.0, 0.0);
  scene = with_term(&term, ROT_TERM_CURVE, 7, curve);
  expect_rates(&scene, 0.0, 1.0, 0.0);
  /* (|-1| + 2 + 2 q omega)/I; the smallest of the moments of inertia counts. */
  const double inertia[] = {1.0, 0.5, 4.0};
  scene = (rot_axle_scene){.linear.inertia_kg_m2 = 2.0,
                           .viscous_n_m_s = -1.0,
                           .motor_n_m_s = 2.0,
                           .quadratic_n_m_s2 = 0.25};
  expect_rates(&scene, 10.0, 4.0, 0.0);
  scene.n_inertia = 3;
  scene.inertia_kg_m2 = inertia;
  expect_rates(&scene, 10.0, 16.0, 0.0);
  /* Of the start: 1/decay with its speed. */
  rot_time_scales scales;
  scene.linear.omega0_rad_per_s = -6.0;
  rot_axle_time_scales_of_start(&scene, &scales);
  ROT_CHECK(scales.fades_s == 1.0 / 12.0 && scales.swing_rad_per_s == 0.0);
}

/* Rotors of 2 and 8 kg m^2, ratio 2: k (1/2 + 2^2/8) and half of k for the pair, 3/2 k by
 * Gershgorin's bound. The damper adds to the decay of the rotors. */
static void check_drive(void) {
  rot_drive_coupling coupling[2] = {
      {.kind = ROT_DRIVE_SHAFT, .ratio = 2.0, .stiffness_n_m_per_rad = 9.0, .damping_n_m_s = 3.0}};
  const rot_drive_friction brake[2] = {{0}};
  const rot_axle_scene rotor[2] = {
      {.linear = {.inertia_kg_m2 = 2.0, .omega0_rad_per_s = 1.0}, .viscous_n_m_s = 4.0},
      {.linear = {.inertia_kg_m2 = 8.0, .omega0_rad_per_s = -5.0}, .quadratic_n_m_s2 = 4.0}};
  const rot_drive_scene scene = {.n = 2, .rotor = rotor, .brake = brake, .coupling = coupling};
  rot_time_scales scales;
  rot_drive_time_scales_of_start(&scene, &scales);
  /* 2 x 4 x 5/8 of the second rotor; 3 (1/2 + 2/4) of the damper. */
  ROT_CHECK_ULP(scales.fades_s, 1.0 / (5.0 + 3.0), 1);
  ROT_CHECK_ULP(scales.swing_rad_per_s, 3.0, 1);
  /* A third rotor of 2 kg m^2 behind a spring of 16: the rows of the matrix have the sums 9,
   * 9 + 16/8 + 16/4 and 16/2 + 4. */
  rot_drive_coupling couplings[3] = {coupling[0]};
  couplings[1] =
      (rot_drive_coupling){.kind = ROT_DRIVE_SHAFT, .ratio = 1.0, .stiffness_n_m_per_rad = 16.0};
  const rot_drive_friction brakes[3] = {{0}};
  const rot_axle_scene rotors[3] = {rotor[0], rotor[1], {.linear = {.inertia_kg_m2 = 2.0}}};
  const rot_drive_scene three = {.n = 3, .rotor = rotors, .brake = brakes, .coupling = couplings};
  rot_drive_time_scales_of_start(&three, &scales);
  ROT_CHECK_ULP(scales.swing_rad_per_s, sqrt(15.0), 1);
  ROT_CHECK_ULP(scales.fades_s, 1.0 / (5.0 + 3.0), 1);
}

/* The time of a fall to the speed, or of the drag. */
static void check_incline(void) {
  rot_incline_scene scene = {.slope = {.mass_kg = 2.0,
                                       .radius_m = 0.5,
                                       .gravity_m_per_s2 = 10.0,
                                       .v0_m_per_s = -4.0,
                                       .omega0_rad_per_s = 12.0}};
  rot_time_scales scales;
  rot_incline_time_scales_of_start(&scene, &scales);
  ROT_CHECK(scales.fades_s == 0.6 && scales.swing_rad_per_s == 0.0);
  scene.drag_n_s_per_m = 1.0; /* (1 + 0.5 x 6)/2 per s */
  scene.drag_n_s2_per_m2 = 0.5;
  rot_incline_time_scales_of_start(&scene, &scales);
  ROT_CHECK(scales.fades_s == 0.5);
  scene.slope.v0_m_per_s = scene.slope.omega0_rad_per_s = 0.0; /* at rest: the drag's */
  rot_incline_time_scales_of_start(&scene, &scales);
  ROT_CHECK(scales.fades_s == 2.0);
  scene.drag_n_s_per_m = scene.drag_n_s2_per_m2 = scene.slope.gravity_m_per_s2 = 0.0;
  rot_incline_time_scales_of_start(&scene, &scales);
  ROT_CHECK(scales.fades_s == (double)INFINITY);
}

int main(void) {
  check_axle();
  check_drive();
  check_incline();
  return rot_test_report("time_scales");
}
