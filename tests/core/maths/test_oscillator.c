/* One step of the damped oscillator against the textbook forms of each regime, and against the
 * identities that every step satisfies: its determinant, its integrals, the way back, a wave. */
#include "maths/oscillator.h"
#include "rot_test.h"

typedef struct scene {
  double inertia, damping, stiffness;
} scene;

/* Under-, critically, overdamped, growing, with far roots. */
static const scene scenes[] = {{2.0, 0.0, 8.0},   {1.3, 0.2, 5.0},  {1.0, 4.0, 4.0},
                               {0.5, 3.0, 2.0},   {1.3, -0.2, 5.0}, {0.5, -3.0, 2.0},
                               {1.0, 400.0, 1.0}, {1e-3, 0.1, 7.0}};
enum { SCENES = sizeof scenes / sizeof *scenes };

/* A step of s seconds, and the unit of time in s. */
static double step_of(const scene *of, double s, rot_oscillator *oscillator,
                      rot_oscillator_step *step) {
  ROT_CHECK(rot_oscillator_begin(of->inertia, of->damping, of->stiffness, oscillator) == ROT_OK);
  rot_oscillator_at(oscillator, (rot_dd){s, 0.0}, step);
  return ldexp(1.0, oscillator->exponent);
}

static void regimes(void) {
  static const int regime[SCENES] = {1, 1, 0, -1, 1, -1, -1, 1};
  for (int i = 0; i < SCENES; i++) {
    rot_oscillator oscillator;
    rot_oscillator_step step;
    step_of(&scenes[i], 1.0, &oscillator, &step);
    ROT_CHECK_EQ_INT(oscillator.regime, regime[i]);
  }
}

/* u and psi_1 by the textbook: cos and sin, t exp(-g t), two exponentials. */
static void textbook(void) {
  rot_oscillator oscillator;
  rot_oscillator_step step;
  for (double s = 0.01; s < 20.0; s *= 1.7) {
    double unit = step_of(&scenes[0], s, &oscillator, &step);
    ROT_CHECK(fabs(step.u - cos(2.0 * s)) < 1e-15);
    ROT_CHECK(fabs(step.psi0 - cos(2.0 * s)) < 1e-15);
    ROT_CHECK(fabs(step.psi1 * unit - 0.5 * sin(2.0 * s)) < 1e-15);
    unit = step_of(&scenes[2], s, &oscillator, &step);
    ROT_CHECK_REL(step.u, exp(-2.0 * s) * (1.0 + 2.0 * s), 1e-14);
    ROT_CHECK_REL(step.psi1 * unit, exp(-2.0 * s) * s, 1e-14);
    unit = step_of(&scenes[3], s, &oscillator, &step);
    const double slow = 3.0 - sqrt(5.0), fast = 3.0 + sqrt(5.0);
    ROT_CHECK_REL(step.u, (fast * exp(-slow * s) - slow * exp(-fast * s)) / (fast - slow), 1e-13);
    ROT_CHECK_REL(step.psi1 * unit, (exp(-slow * s) - exp(-fast * s)) / (fast - slow), 1e-13);
  }
}

/* u psi_0 + (k/I) psi_1^2 = exp(-c s/I), and a step back undoes a step. */
static void determinant_and_direction_back(void) {
  for (int i = 0; i < SCENES; i++)
    for (double s = 1e-3; s < 3.0; s *= 2.3) {
      rot_oscillator oscillator;
      rot_oscillator_step step, back;
      step_of(&scenes[i], s, &oscillator, &step);
      rot_oscillator_at(&oscillator, (rot_dd){-s, 0.0}, &back);
      const double k = oscillator.stiff.hi, size = step.u_size * step.psi0_size;
      const double terms = size + k * step.psi1 * step.psi1;
      const double decay = exp(-scenes[i].damping / scenes[i].inertia * s);
      ROT_CHECK(fabs(step.u * step.psi0 + k * step.psi1 * step.psi1 - decay) <= 1e-14 * terms);
      if (decay < 1e-6 || decay > 1e6) continue; /* the way back multiplies the rounding */
      const double grown = 1e-14 * (1.0 + step.norm * back.norm);
      ROT_CHECK(step.psi1 > 0.0 || oscillator.regime == 1);
      ROT_CHECK(fabs(back.u * step.u - k * back.psi1 * step.psi1 - 1.0) <= grown);
      ROT_CHECK(fabs(back.u * step.psi1 + back.psi1 * step.psi0) * sqrt(k) <= grown);
    }
}

/* The equation and its integral for the answer psi_1 to an impulse:
 * psi_0 + (c/I) psi_1 + (k/I) psi_2 = 1 and psi_1 + (c/I) psi_2 + (k/I) psi_3 = s. */
static void integrals(void) {
  int early = 0;
  for (int i = 0; i < SCENES; i++)
    for (double s = 1e-4; s < 3.0; s *= 2.3) {
      rot_oscillator oscillator;
      rot_oscillator_step step;
      step_of(&scenes[i], s, &oscillator, &step);
      if (!step.early) continue;
      early++;
      const double t = step.s.hi, k = oscillator.stiff.hi, c = 2.0 * oscillator.half_rate.hi;
      const double psi2 = step.second * t * t, psi3 = step.third * t * t * t;
      ROT_CHECK(fabs(step.psi0 + c * step.psi1 + k * psi2 - 1.0) <=
                4e-15 * (step.psi0_size + fabs(c * step.psi1)));
      ROT_CHECK(fabs(step.psi1 + c * psi2 + k * psi3 - t) <= 4e-15 * (t + fabs(c * psi2)));
    }
  ROT_CHECK(early > SCENES);
}

/* From rest under exp(i Omega s): steady (exp(i Omega s) - u - i Omega psi_1). */
static void wave(void) {
  for (int i = 0; i < SCENES; i++)
    for (double s = 0.05; s < 2.0; s *= 1.9) {
      const double rate = 0.3 * sqrt(scenes[i].stiffness / scenes[i].inertia);
      rot_oscillator oscillator;
      rot_oscillator_step step;
      rot_complex y, v;
      double y_size, v_size;
      const double unit = step_of(&scenes[i], s, &oscillator, &step);
      if (!rot_oscillator_wave(&step, rate, &y, &v, &y_size, &v_size)) continue;
      const rot_complex steady = rot_oscillator_steady(&oscillator, rate);
      const double a = cos(rate * s) - step.u, b = sin(rate * s) - rate * step.psi1 * unit;
      const double size = unit * unit * (fabs(steady.re) + fabs(steady.im)) *
                          (1.0 + step.u_size + fabs(rate * unit * step.psi1));
      ROT_CHECK(fabs(s * s * y.re - unit * unit * (steady.re * a - steady.im * b)) <= 1e-14 * size);
      ROT_CHECK(fabs(s * s * y.im - unit * unit * (steady.re * b + steady.im * a)) <= 1e-14 * size);
    }
}

/* Undamped, at its own frequency w: y = -(i s/(2 w)) exp(i w s) + i sin(w s)/(2 w^2). */
static void resonance(void) {
  for (double s = 0.05; s < 30.0; s *= 1.9) {
    rot_oscillator oscillator;
    rot_oscillator_step step;
    rot_complex y, v;
    double y_size, v_size;
    step_of(&scenes[0], s, &oscillator, &step);
    ROT_CHECK(rot_oscillator_wave(&step, 2.0, &y, &v, &y_size, &v_size));
    ROT_CHECK(fabs(s * s * y.re - 0.25 * s * sin(2.0 * s)) <= 1e-15 * s * (1.0 + s));
    ROT_CHECK(fabs(s * s * y.im - (0.125 * sin(2.0 * s) - 0.25 * s * cos(2.0 * s))) <=
              1e-15 * s * (1.0 + s));
  }
}

static void at_the_start(void) {
  for (int i = 0; i < SCENES; i++) {
    rot_oscillator oscillator;
    rot_oscillator_step step;
    step_of(&scenes[i], 0.0, &oscillator, &step);
    ROT_CHECK(step.first == 1.0 && step.psi1 == 0.0);
  }
}

static void out_of_range(void) {
  rot_oscillator oscillator;
  ROT_CHECK(rot_oscillator_begin(1.0, 1e150, 1.0, &oscillator) == ROT_ERANGE);
  ROT_CHECK(rot_oscillator_begin(1e-306, 1.0, 1.0, &oscillator) == ROT_ERANGE);
  ROT_CHECK(rot_oscillator_begin(1e-300, 0.0, 1e-300, &oscillator) == ROT_OK);
}

int main(void) {
  regimes();
  textbook();
  determinant_and_direction_back();
  integrals();
  wave();
  resonance();
  at_the_start();
  out_of_range();
  return rot_test_report("oscillator");
}
