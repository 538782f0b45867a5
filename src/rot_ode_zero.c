#include "rot_ode_zero.h"

#include <math.h>

#include "rot_ode_step.h"
#include "rot_real.h"

/* The cubic through values and slopes at both ends of a step, x from 0 to 1. */
static double cubic(const double w[4], double x) {
  const double u = 1.0 - x;
  return u * u * ((1.0 + 2.0 * x) * w[0] + x * w[1]) + x * x * ((3.0 - 2.0 * x) * w[2] - u * w[3]);
}

static rot_status attempt_part(rot_ode_march *run, double h, double *w, double *rise) {
  const size_t i = run->p->turn->watched;
  const rot_status status = rot_ode_attempt(run, run->t, h, run->y, run->slope);
  *w = *run->p->turn->mode * run->trial[i];
  *rise = *run->p->turn->mode * run->trial_slope[i];
  return status;
}

/* The watched component is positive (times the mode) at the start and not so after hi: re-step to
 * the zero by Newton, kept between. *hi becomes that step, trial the state there. */
static rot_status find_zero(rot_ode_march *run, const double w[4], double *hi) {
  double lo = 0.0, high = *hi, a = 0.0, b = 1.0;
  for (int k = 0; k < 40; k++) { /* first guess: the zero of the cubic, whose 1 is the whole step */
    const double mid = 0.5 * (a + b);
    if (cubic(w, mid) > 0.0) {
      a = mid;
    } else {
      b = mid;
    }
  }
  double x = b * *hi;
  for (int k = 0; k < 200; k++) {
    double v, rise;
    const rot_status status = attempt_part(run, x, &v, &rise);
    if (status != ROT_OK) return status;
    const double next = x - v / rise, resolved = 2.0 * ROT_EPS * fmax(fabs(run->t), fabs(x));
    if (v > 0.0) {
      lo = x;
    } else {
      high = x;
    }
    if (v == 0.0 || fabs(next - x) <= resolved || fabs(high - lo) <= 2.0 * resolved) break;
    const int inside = (next - lo) * (next - high) < 0.0; /* NaN is not */
    x = inside ? next : lo + 0.5 * (high - lo);
  }
  *hi = x;
  run->trial[run->p->turn->watched] = 0.0;
  return ROT_OK;
}

/* A step from rest that ends on the wrong side: does it go the right way at first? */
static rot_status leave_rest(rot_ode_march *run, const double w[4], double *h,
                             rot_ode_passage *what) {
  double best = 0.0, at = 0.0, v, rise;
  *what = ROT_ODE_TRY_SHORTER;
  for (int k = 1; k < 16; k++) {
    if (cubic(w, k / 16.0) > best) {
      best = cubic(w, k / 16.0);
      at = k / 16.0;
    }
  }
  if (best == 0.0) return ROT_OK;
  const rot_status status = attempt_part(run, at * *h, &v, &rise);
  if (status == ROT_OK && v > 0.0) {
    *h *= at;
    *what = ROT_ODE_CUT_SHORT;
  }
  return status;
}

/* Looks at the end of the step and, by its cubic, at seven places within. */
rot_status rot_ode_look_for_zero(rot_ode_march *run, double *h, rot_ode_passage *what) {
  const rot_ode_switch *turn = run->p->turn;
  *what = ROT_ODE_SAME_SIDE;
  if (!turn) return ROT_OK;
  const size_t i = turn->watched;
  const double s = *turn->mode;
  double w[4] = {s * run->y[i], s * run->slope[i] * *h, s * run->trial[i],
                 s * run->trial_slope[i] * *h};
  if (run->at_rest && w[1] == 0.0 && w[2] == 0.0 && w[3] == 0.0) return ROT_OK; /* still */
  if (run->at_rest && w[2] <= 0.0) {
    if (!run->may_flip) return leave_rest(run, w, h, what);
    run->may_flip = 0;
    *turn->mode = -*turn->mode;
    run->slope_known = 0;
    *what = ROT_ODE_TRY_SHORTER;
    return ROT_OK;
  }
  /* Between two ends on one side it may dip to the other. The cubic is of order 4, so that it is
   * believed only where it stays clear of zero. */
  double dip = 1.0, least = run->was_cut ? 0.0 : 0.3 * fmin(w[0], w[2]);
  for (int k = 1; k < 8 && w[2] > 0.0; k++) {
    if (cubic(w, 0.125 * k) < least) {
      least = cubic(w, 0.125 * k);
      dip = 0.125 * k;
    }
  }
  if (w[2] > 0.0 && (dip == 1.0 || run->at_rest)) return ROT_OK;
  if (dip < 1.0) { /* ask the method itself */
    double v, rise;
    const rot_status status = attempt_part(run, dip * *h, &v, &rise);
    if (status != ROT_OK) return status;
    *h *= dip;
    if (v > 0.0) {
      *what = ROT_ODE_CUT_SHORT;
      return ROT_OK;
    }
    w[1] *= dip;
    w[2] = v;
    w[3] = rise * *h;
  }
  *what = ROT_ODE_AT_ZERO;
  return find_zero(run, w, h);
}
