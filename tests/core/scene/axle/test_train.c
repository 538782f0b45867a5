/* A gear train as one body: sums by hand, losses by the power through each mesh, the error of a
 * rounded coefficient. */
#include <stdint.h>
#include <math.h>
#include <string.h>

#include "scene/axle/train.h"
#include "rot_test.h"

enum { MAX = 5 };

static rot_store store;
static rot_axle_train train;
static rot_axle_train_law law;

static uint64_t seed = 20260911;

static double uniform(double from, double to) {
  seed = seed * 6364136223846793005u + 1442695040888963407u;
  return from + (to - from) * ((double)(seed >> 11) * 0x1p-53);
}

static int chance(double p) { return uniform(0.0, 1.0) < p; }

static rot_status make(size_t n, const double ratio[], const double inertia[],
                       const double viscous[], const double torque[], const double efficiency[]) {
  rot_store_free(&store);
  const rot_status status =
      rot_axle_train_reflect(n, ratio, inertia, viscous, torque, efficiency, &store, &train);
  return status == ROT_OK ? rot_axle_train_law_of(&train, &store, &law) : status;
}

/* 2 N m on 0.01 kg m^2, -4 N m on 0.5 kg m^2 behind a ratio of 5. */
static void check_by_hand(void) {
  const double ratio[] = {5.0}, inertia[] = {0.01, 0.5}, viscous[] = {0.0, 0.5};
  const double torque[] = {2.0, -4.0}, whole[] = {1.0}, lossy[] = {0.9}, load[] = {0.0, -4.0};
  double steady[2];
  ROT_CHECK(make(2, ratio, inertia, viscous, torque, whole) == ROT_OK);
  ROT_CHECK_REL(law.inertia_kg_m2, 0.03, 1e-15);
  ROT_CHECK_REL(law.torque_n_m, 1.2, 1e-15);
  ROT_CHECK_REL(law.viscous_n_m_s, 0.02, 1e-15);
  ROT_CHECK(law.dry_n_m == 0.0 && !law.lossy && law.n_curve == 0);
  /* Forward the mesh takes a tenth of what the load needs: 0.8/0.9 N m. */
  ROT_CHECK(make(2, ratio, inertia, viscous, torque, lossy) == ROT_OK);
  rot_axle_train_steady(&train, steady);
  ROT_CHECK_REL(steady[1], -0.8 / 0.9, 1e-15);
  ROT_CHECK_REL(steady[0], 2.0, 1e-15);
  /* Backward the load of 0.8 N m drives: 0.01 a = 0.9 (-0.8 - 0.02 a), a = -0.72/0.028. Forward it
   * resists alone, and its inertia drives: 0.01 a = -(0.8 + 0.02 a)/0.9 while that is taken. */
  ROT_CHECK(make(2, ratio, inertia, (const double[]){0.0, 0.0}, load, lossy) == ROT_OK);
  const double back = -0.03 * 0.72 / 0.028;
  ROT_CHECK_REL(law.torque_n_m + law.dry_n_m, back, 1e-14);
  ROT_CHECK(law.torque_n_m - law.dry_n_m <= back);
  ROT_CHECK_REL(law.gears.applied_n_m, -0.8, 1e-15);
  ROT_CHECK_REL(law.gears.backward_n_m, back + 0.8, 1e-13);
}

/* The acceleration at omega in one sense, by trying the directions of power through the meshes. */
static double by_trial(double omega) {
  const size_t n = train.n;
  for (unsigned forward = 0; forward < 1u << (n - 1); forward++) {
    double gain[MAX] = {1.0}, inertia = 0.0, force = 0.0, taken[MAX], a;
    for (size_t i = 1; i < n; i++) {
      const int through = (forward >> (i - 1) & 1u) != 0;
      gain[i] = gain[i - 1] * (through ? 1.0 / train.efficiency[i - 1] : train.efficiency[i - 1]);
    }
    for (size_t i = 0; i < n; i++) {
      inertia += gain[i] * train.inertia_kg_m2[i];
      force += gain[i] * (train.torque_n_m[i] - train.viscous_n_m_s[i] * omega);
    }
    a = force / inertia;
    int agrees = 1;
    double behind = 0.0;
    for (size_t i = n; i-- > 0;) {
      taken[i] = train.inertia_kg_m2[i] * a - train.torque_n_m[i] + train.viscous_n_m_s[i] * omega +
                 behind;
      behind = i ? gain[i] / gain[i - 1] * taken[i] : 0.0;
      const int through = i && (forward >> (i - 1) & 1u) != 0;
      /* Power goes forward where what is taken has the sense of the rotation. */
      if (i && fabs(taken[i]) > 1e-12) agrees &= (taken[i] * omega > 0.0) == through;
    }
    if (agrees) return a;
  }
  return NAN;
}

static double on_curve(double omega) {
  const double *w = law.omega_rad_per_s, *tau = law.curve_n_m;
  const size_t n = law.n_curve;
  if (n == 0) return 0.0;
  if (omega <= w[0]) return tau[0];
  for (size_t i = 1; i < n; i++) {
    if (omega <= w[i]) {
      return tau[i - 1] + (tau[i] - tau[i - 1]) * (omega - w[i - 1]) / (w[i] - w[i - 1]);
    }
  }
  return tau[n - 1];
}

/* torque + curve - viscous omega - dry sign(omega) is the inertia times that acceleration. */
static void check_losses(void) {
  int curves = 0, points = 0;
  for (int i = 0; i < rot_test_trials(2000); i++) {
    const size_t n = 2 + (size_t)(4.0 * uniform(0.0, 1.0)); /* 2 to MOST */
    double ratio[MAX], inertia[MAX], viscous[MAX], torque[MAX], efficiency[MAX];
    double sizes = 0.0;
    for (size_t k = 0; k < n; k++) {
      ratio[k] = uniform(0.4, 4.0) * (chance(0.3) ? -1.0 : 1.0);
      inertia[k] = uniform(0.01, 1.0);
      viscous[k] = chance(0.5) ? 0.0 : uniform(0.0, 0.3);
      torque[k] = chance(0.2) ? 0.0 : uniform(-3.0, 3.0);
      efficiency[k] = uniform(0.4, 1.0);
    }
    ROT_CHECK(make(n, ratio, inertia, viscous, torque, efficiency) == ROT_OK);
    ROT_CHECK(law.lossy && law.rounding[0] >= 0.0 && law.rounding[1] >= 0.0);
    for (size_t k = 0; k < n; k++) sizes += fabs(train.torque_n_m[k]);
    curves += law.n_curve > 0;
    for (int k = 0; k < 8; k++) {
      const double omega = uniform(-1.0, 1.0) * pow(10.0, uniform(-2.0, 2.0));
      const double a = by_trial(omega), dry = omega > 0.0 ? law.dry_n_m : -law.dry_n_m;
      if (isnan(a)) continue;
      const double got = law.torque_n_m + on_curve(omega) - law.viscous_n_m_s * omega - dry;
      const double size = sizes + law.viscous_n_m_s * fabs(omega);
      ROT_CHECK(fabs(got - law.inertia_kg_m2 * a) <= 1e-11 * size + 1e-13);
      points++;
    }
  }
  ROT_CHECK(curves > 0 && points > 0);
}

/* Two equal torques but for 1e-10 N m: the power through the mesh turns at 1e-10 rad/s, of 2 rad/s
 * that the motion reaches. */
static void check_slow_bend(void) {
  const double ratio[] = {1.0}, inertia[] = {1.0, 1.0}, viscous[] = {0.0, 1.0};
  const double torque[] = {1.0, 1.0 + 1e-10}, efficiency[] = {0.9};
  ROT_CHECK(make(2, ratio, inertia, viscous, torque, efficiency) == ROT_OK);
  int near = 0;
  for (size_t i = 0; i < law.n_curve; i++) near += fabs(law.omega_rad_per_s[i] - 1e-10) <= 1e-13;
  ROT_CHECK_EQ_INT(near, 1);
}

/* A torque that is off by E moves a body of 2 kg m^2 by E t^2/(2 I), its rate by E t/I; with a
 * viscous resistance c backwards in time: I omega' = E - c omega. */
static void check_error(void) {
  rot_axle_scene scene;
  double error[2];
  const double torque[] = {0.3, 0.0}, slope[] = {0.0, 0.3};
  memset(&scene, 0, sizeof scene);
  scene.linear.inertia_kg_m2 = 2.0;
  scene.linear.start_s = 1.0;
  rot_axle_train_error(&scene, torque, 0.0, 1.0, 5.0, 1.0, error);
  ROT_CHECK_REL(error[ROT_THETA], 0.3 * 16.0 / 4.0, 1e-14);
  ROT_CHECK_REL(error[ROT_OMEGA], 0.3 * 4.0 / 2.0, 1e-14);
  rot_axle_train_error(&scene, slope, 0.0, 1.0, 5.0, 7.0, error);
  ROT_CHECK_REL(error[ROT_OMEGA], 7.0 * 0.3 * 4.0 / 2.0, 1e-14);
  scene.viscous_n_m_s = 1.5;
  rot_axle_train_error(&scene, torque, 1.5, 1.0, 100.0, 1.0, error);
  ROT_CHECK_REL(error[ROT_OMEGA], 0.3 / 1.5, 1e-14);
  ROT_CHECK_REL(error[ROT_THETA], 0.3 * 99.0 / 1.5, 1e-14);
  /* Backwards over 4 s: what the resistance makes of it. */
  rot_axle_train_error(&scene, torque, 1.5, -3.0, 1.0, 1.0, error);
  const double propagation = expm1(1.5 * 4.0 / 2.0),
               theta = 0.3 / 1.5 * (propagation * 2.0 / 1.5 - 4.0);
  ROT_CHECK_REL(error[ROT_OMEGA], 0.3 / 1.5 * propagation, 1e-14);
  ROT_CHECK(error[ROT_THETA] >= theta && error[ROT_THETA] < 4.0 * theta);
  rot_axle_train_error(&scene, torque, 1.5, 1.0, 5.0, 0.0, error);
  ROT_CHECK(error[ROT_THETA] == 0.0 && error[ROT_OMEGA] == 0.0);
}

int main(void) {
  check_by_hand();
  check_losses();
  check_slow_bend();
  check_error();
  rot_store_free(&store);
  return rot_test_report("train");
}
