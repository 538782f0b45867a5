#include "scene/axle/period.h"

#include <math.h>

#include "scene/axle/effects.h"
#include "scene/axle/pendulum.h"
#include "ground/real.h"
#include "maths/oscillator.h"

static const rot_dd two_pi = {0x1.921fb54442d18p+2, 0x1.1a62633145c07p-52};

static rot_period pendulum_period(const rot_axle_scene *scene) {
  rot_period out = {ROT_PERIOD_UNKNOWN, NAN, NAN, NAN};
  if (rot_axle_pendulum_period(scene, &out.period_s, &out.amplitude_rad) != ROT_OK) return out;
  out.ratio = 1.0;
  out.kind = isinf(out.period_s)        ? ROT_PERIOD_SEPARATRIX
             : isnan(out.amplitude_rad) ? ROT_PERIOD_ROTATION
             : out.amplitude_rad == 0.0 ? ROT_PERIOD_REST
                                        : ROT_PERIOD_OSCILLATION;
  return out;
}

/* 1 if the torque is constant, else 0. */
static int steady(const rot_torque *torque) {
  int same = torque->before_n_m == torque->after_n_m;
  for (size_t i = 0; i < torque->n; i++) same &= torque->torque_n_m[i] == torque->after_n_m;
  return same;
}

/* Amplitude about the angle at which the spring balances the torque. */
static double spring_amplitude(const rot_axle_scene *scene, const rot_oscillator *of) {
  const rot_axle_params *p = &scene->linear;
  const double *x = scene->terms[0].x;
  rot_dd away = rot_dd_sum2(p->theta0_rad, -x[1]);
  double lo, hi = rot_muldiv(p->torque.after_n_m, 1.0, x[0], &lo);
  away = rot_dd_sub(away, (rot_dd){hi, lo});
  return hypot(away.hi, ldexp(p->omega0_rad_per_s / of->omega0, of->exponent));
}

/* Undamped, damped or overdamped oscillation. */
static rot_period spring_period(const rot_axle_scene *scene) {
  rot_period out = {ROT_PERIOD_UNKNOWN, NAN, NAN, NAN};
  const double c = scene->linear.viscous_n_m_s, k = scene->terms[0].x[0];
  rot_oscillator of;
  if (!(k > 0.0)) {
    out.kind = ROT_PERIOD_NONE;
    return out;
  }
  if (rot_oscillator_begin(scene->linear.inertia_kg_m2, c, k, &of) != ROT_OK) return out;
  if (of.regime <= 0) {
    out.kind = ROT_PERIOD_OVERDAMPED;
    return out;
  }
  const rot_dd period = rot_dd_div(two_pi, of.split), lost = rot_dd_mul(of.half_rate, period);
  out.period_s = ldexp(period.hi, of.exponent);
  const double decay = exp(-lost.hi);
  out.ratio = isfinite(decay) ? decay - decay * lost.lo : decay;
  out.kind = ROT_PERIOD_DAMPED;
  if (c != 0.0) return out;
  out.amplitude_rad = spring_amplitude(scene, &of);
  out.kind = out.amplitude_rad == 0.0 ? ROT_PERIOD_REST : ROT_PERIOD_OSCILLATION;
  return out;
}

static rot_period free_period(const rot_axle_scene *scene) {
  const double omega = fabs(scene->linear.omega0_rad_per_s);
  if (omega == 0.0) return (rot_period){ROT_PERIOD_NONE, NAN, NAN, NAN};
  return (rot_period){ROT_PERIOD_ROTATION, two_pi.hi / omega, NAN, 1.0};
}

/* Closed form by the effects of the scene. */
rot_period rot_axle_period(const rot_axle_scene *scene) {
  enum {
    LOSSES = ROT_AXLE_VISCOUS | ROT_AXLE_MOTOR | ROT_AXLE_QUADRATIC | ROT_AXLE_FRICTION,
    LINEAR = ROT_AXLE_TORQUE | ROT_AXLE_SPRING | ROT_AXLE_VISCOUS | ROT_AXLE_MOTOR
  };
  const unsigned effects = rot_axle_effects(scene);
  const int lasts = scene->n_terms == 1 && scene->terms[0].from_s == -INFINITY &&
                    scene->terms[0].to_s == INFINITY && scene->terms[0].x[0] != 0.0;
  if (effects == 0) return free_period(scene);
  if (effects == ROT_AXLE_GRAVITY && lasts) return pendulum_period(scene);
  if (effects & ROT_AXLE_SPRING && !(effects & ~(unsigned)LINEAR) && lasts &&
      steady(&scene->linear.torque)) {
    return spring_period(scene);
  }
  rot_period out = {ROT_PERIOD_UNKNOWN, NAN, NAN, NAN};
  if (!steady(&scene->linear.torque)) return out;
  const unsigned others = effects & ~(unsigned)(LOSSES | ROT_AXLE_TORQUE);
  if (!others) out.kind = ROT_PERIOD_NONE; /* losses have no restoring torque */
  if ((others == ROT_AXLE_GRAVITY || others == ROT_AXLE_SPRING) && lasts && effects & LOSSES) {
    out.kind = ROT_PERIOD_DAMPED; /* all cycles differ */
  }
  return out;
}
