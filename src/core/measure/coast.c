#include "measure/coast.h"

#include <math.h>
#include <string.h>

#include "maths/drag.h"

/* A motion that needs more steps is not a coast-down: it grows without bound, or stops immediately.
 */
enum { P = ROT_COAST_PARAMETERS, MAX_STEPS = 4000 };

/* The motion in a smooth segment: u = side omega >= 0, u' = -(a + b u + k u^2). */
typedef struct coast {
  const rot_coast_load *load;
  const double *p;             /* parameters */
  double torque;               /* present T/I */
  double drive, d_drive;       /* T/(I + J), its derivative by the multiplier */
  double fraction, d_fraction; /* I/(I + J), its derivative by the multiplier */
  double side;                 /* sign of omega */
  double a, b, k;
  double D;                 /* b^2/4 - a k */
  long steps;               /* since the start of the segment */
  double since, theta0, u0; /* start of the segment */
  rot_drag flow;            /* valid if `exact` */
  int exact;                /* 1: b, k >= 0, the motion is that of rot_drag */
  int rests;                /* 1: at rest in the whole segment */
  double stop;              /* time from `since` at which u reaches 0 */
  double t, theta, u;       /* present state */
  double s[P], x[P];        /* derivatives of omega, theta */
  int wanted;               /* 1: compute the derivatives */
} coast;

/* ---- the flow for any signs of the losses ---------------------------------------------------- */

/* t => T = tanh(s t)/s with s^2 = D = b^2/4 - a k; tan for D < 0 */
static double slow_time(double D, double t) {
  const double y = D * t * t;
  if (fabs(y) < 1e-3) {
    return t * (1.0 - y * (1.0 / 3.0 - y * (2.0 / 15.0 - y * (17.0 / 315.0 - y * 62.0 / 2835.0))));
  }
  const double s = sqrt(fabs(D));
  return D > 0.0 ? tanh(s * t) / s : tan(s * t) / s;
}

/* u => time until u reaches 0, Inf if never */
static double stop_after(const coast *c, double u) {
  const double D = c->D, lower = c->a + 0.5 * c->b * u;
  if (D < 0.0) {
    const double s = sqrt(-D);
    return c->a > 0.0 ? atan2(s * u, lower) / s : INFINITY;
  }
  const double T = u / lower, y = sqrt(D) * T;
  if (!(lower > 0.0) || !(y < 1.0)) return INFINITY;
  return y > 1e-4 ? atanh(y) / sqrt(D) : T * (1.0 + y * y / 3.0);
}

/* ---- segments ------------------------------------------------------------------------------- */

/* Sets T/(I + J) and I/(I + J); without load (`acts` 0) they are 0 and 1. */
static void take_load(coast *c, int acts) {
  const double p = c->p[ROT_COAST_LOAD], j = c->load->added_ratio, tau = c->torque;
  const double sum = 1.0 + j * (c->load->scales ? p : 1.0);
  c->drive = acts ? tau * p / sum : 0.0;
  c->fraction = acts ? 1.0 / sum : 1.0;
  c->d_drive = acts ? tau / (c->load->scales ? sum * sum : sum) : 0.0;
  c->d_fraction = acts && c->load->scales ? -j / (sum * sum) : 0.0;
}

/* Begins a segment at the present state; side: sign of omega, or of the torque for omega = 0. */
static void begin(coast *c, double omega, double side, double span) {
  const double *p = c->p;
  c->side = side;
  c->a = c->fraction * p[ROT_COAST_COULOMB] - side * c->drive;
  c->b = c->fraction * p[ROT_COAST_VISCOUS];
  c->k = c->fraction * p[ROT_COAST_QUADRATIC];
  c->D = 0.25 * c->b * c->b - c->a * c->k;
  c->since = c->t;
  c->steps = 0;
  c->theta0 = c->theta;
  c->u0 = c->u = fabs(omega);
  c->rests = c->u0 == 0.0 && c->a > 0.0;
  c->exact = c->b >= 0.0 && c->k >= 0.0;
  c->stop = INFINITY;
  if (c->rests) {
    memset(c->s, 0, sizeof c->s);
    return;
  }
  if (c->exact) {
    const rot_drag_law law = {-c->a, 0.0, c->b, c->k, 1.0};
    c->flow = rot_drag_from(&law, c->u0, span);
    if (c->a > 0.0) c->stop = rot_drag_stop(&c->flow);
  } else {
    c->stop = stop_after(c, c->u0);
  }
}

/* => omega' at the present u */
static double slope_of(const coast *c) { return -c->side * (c->a + c->u * (c->b + c->k * c->u)); }

/* ---- time stepping --------------------------------------------------------------------------- */

/* Gauss-Legendre rules on (0, 1). */
typedef struct rule {
  int points;
  double at[8], weight[8];
} rule;

static const rule rules[3] = {
    {3,
     {0.11270166537925831, 0.5, 0.88729833462074169},
     {0.27777777777777778, 0.44444444444444444, 0.27777777777777778}},
    {4,
     {0.06943184420297371, 0.33000947820757187, 0.66999052179242813, 0.93056815579702629},
     {0.17392742256872693, 0.32607257743127307, 0.32607257743127307, 0.17392742256872693}},
    {8,
     {0.01985507175123188, 0.10166676129318664, 0.23723379504183550, 0.40828267875217510,
      0.59171732124782490, 0.76276620495816450, 0.89833323870681336, 0.98014492824876812},
     {0.05061426814518813, 0.11119051722668724, 0.15685332293894364, 0.18134189168918100,
      0.18134189168918100, 0.15685332293894364, 0.11119051722668724, 0.05061426814518813}}};

/* Advances theta, omega and the derivatives by h, x = rate h <= 0.4. The poles of the integrands
 * are at a distance of 1/x steps, so the error is (x/4)^(2 points), below 1e-15. */
static void step_by(coast *c, double h, double x) {
  const rule *gauss = rules + (x < 0.002 ? 0 : x < 0.025 ? 1 : 2);
  const double D = c->D, T = slow_time(D, h), u = c->u;
  const double half = 0.5 * c->b, slope = half + c->k * u, far = 1.0 + slope * T;
  double turned = 0.0;
  if (!c->wanted) {
    for (int i = 0; i < gauss->points; i++) {
      const double v = T * gauss->at[i];
      turned += gauss->weight[i] * (u * (1.0 - half * v) - c->a * v) /
                ((1.0 + slope * v) * (1.0 - D * v * v));
    }
  } else {
    const double gain = (1.0 - D * T * T) / (far * far), reach = T / far, *p = c->p;
    double by_omega[3] = {0}, by_theta[3] = {0}, *sensitivity = c->s, *of_theta = c->x;
    for (int i = 0; i < gauss->points; i++) {
      const double v = T * gauss->at[i], rest = 1.0 / (1.0 - D * v * v), lower = 1.0 + slope * v;
      const double w = T * gauss->weight[i] * rest;
      const double at = (u * (1.0 - half * v) - c->a * v) / lower;
      /* Derivative from this point to the end: that of the whole step over that up to the point. */
      const double g = w * gain * (lower * lower) * rest;
      const double r = w * (T - v) / ((1.0 - D * T * v) + (half + c->k * at) * (T - v));
      turned += gauss->weight[i] * rest * at;
      by_omega[0] += g;
      by_omega[1] += g * at;
      by_omega[2] += g * at * at;
      by_theta[0] += r;
      by_theta[1] += r * at;
      by_theta[2] += r * at * at;
    }
    for (int i = ROT_COAST_OMEGA; i < P; i++) {
      of_theta[i] += reach * sensitivity[i];
      sensitivity[i] *= gain;
    }
    sensitivity[ROT_COAST_LOAD] += c->d_drive * by_omega[0];
    of_theta[ROT_COAST_LOAD] += c->d_drive * by_theta[0];
    for (int i = 0; i < 3; i++) {
      const int at = ROT_COAST_COULOMB + i;
      const double direct = c->side * c->fraction, by_load = c->side * c->d_fraction * p[at];
      sensitivity[at] -= direct * by_omega[i];
      of_theta[at] -= direct * by_theta[i];
      sensitivity[ROT_COAST_LOAD] -= by_load * by_omega[i];
      of_theta[ROT_COAST_LOAD] -= by_load * by_theta[i];
    }
  }
  c->theta += c->side * T * turned;
  c->u = fmax(0.0, (u * (1.0 - half * T) - c->a * T) / far);
}

enum { FRESH = 64 };

/* Advances to the time t within the segment. Rounding accumulates over the steps: if rot_drag
 * applies, every 64th call takes its state. */
static rot_status advance(coast *c, double t) {
  const double h = t - c->t;
  if (!(h > 0.0)) return ROT_OK;
  c->t = t;
  if (c->rests) return ROT_OK;
  double left = h;
  const double s = 1.7 * sqrt(fabs(c->D));
  for (int steps = 0; left > 0.0; steps++) {
    const double rate = fmax(s, fabs(0.5 * c->b + c->k * c->u));
    if (steps == MAX_STEPS || !isfinite(rate)) return ROT_ERANGE;
    const double step = rate * left <= 0.4 ? left : 0.4 / rate;
    step_by(c, step, rate * step);
    left -= step;
  }
  if (c->exact && ++c->steps % FRESH == 0) {
    const rot_drag_state at = rot_drag_at(&c->flow, t - c->since, 0.0);
    c->u = at.omega;
    c->theta = c->theta0 + c->side * at.theta;
  }
  return isfinite(c->u) && isfinite(c->theta) ? ROT_OK : ROT_ERANGE;
}

/* At omega = 0: rest, or reversal by the torque. The derivatives of omega change by the ratio of
 * omega' after and before. */
static void meet_zero(coast *c, double span) {
  const double before = slope_of(c);
  const double side = c->drive < 0.0 ? -1.0 : 1.0;
  c->u = 0.0;
  begin(c, 0.0, side, span);
  const double factor = c->rests ? 0.0 : slope_of(c) / before;
  for (int i = 0; i < P; i++) c->s[i] *= factor;
}

/* Advances to t, also past the stop. */
static rot_status go(coast *c, double t) {
  while (!c->rests && c->since + c->stop < t) {
    const double at = c->since + c->stop;
    const rot_status status = advance(c, fmax(at, c->t));
    if (status != ROT_OK) return status;
    meet_zero(c, t - at);
  }
  return advance(c, t);
}

/* Ends the load: omega' jumps, at a time that is a parameter. */
static void release(coast *c, double span) {
  const double before = c->rests ? 0.0 : slope_of(c), omega = c->side * c->u;
  const double side = omega < 0.0 ? -1.0 : 1.0;
  take_load(c, 0);
  begin(c, omega, side, span);
  c->s[ROT_COAST_RELEASE] += before - (c->rests ? 0.0 : slope_of(c));
}

/* Changes the torque: omega' jumps, at a time that is not a parameter. */
static void change_torque(coast *c, double torque, double span) {
  const double omega = c->rests ? 0.0 : c->side * c->u;
  c->torque = torque;
  take_load(c, 1);
  begin(c, omega, omega < 0.0 || (!(omega > 0.0) && c->drive < 0.0) ? -1.0 : 1.0, span);
}

rot_status rot_coast_rows(const rot_coast_load *load, const double p[ROT_COAST_PARAMETERS],
                          double start_s, size_t n, const double t[], double theta[],
                          double omega[], double d_theta[], double d_omega[]) {
  coast c;
  if (n == 0) return ROT_OK;
  memset(&c, 0, sizeof c);
  const double end = t[n - 1], until = p[ROT_COAST_RELEASE];
  const int loaded = load->torque_ratio != 0.0 || load->added_ratio != 0.0 || load->steps > 0;
  size_t step = 0;
  int acts = loaded && until > start_s;
  c.load = load;
  c.p = p;
  c.torque = load->torque_ratio;
  for (; step < load->steps && load->step_s[step] <= start_s; step++)
    c.torque = load->step_ratio[step];
  c.wanted = d_theta != NULL || d_omega != NULL;
  c.t = start_s;
  c.theta = p[ROT_COAST_THETA];
  c.s[ROT_COAST_OMEGA] = c.x[ROT_COAST_THETA] = 1.0;
  take_load(&c, acts);
  const double omega0 = p[ROT_COAST_OMEGA];
  const double side = omega0 != 0.0 ? (omega0 < 0.0 ? -1.0 : 1.0) : c.drive < 0.0 ? -1.0 : 1.0;
  begin(&c, omega0, side, end - start_s);
  for (size_t i = 0; i < n; i++) {
    rot_status status = ROT_OK;
    for (; acts && step < load->steps && load->step_s[step] < fmin(t[i], until); step++) {
      status = go(&c, load->step_s[step]);
      if (status != ROT_OK) return status;
      change_torque(&c, load->step_ratio[step], end - load->step_s[step]);
    }
    if (acts && t[i] > until) {
      status = go(&c, until);
      release(&c, end - until);
      acts = 0;
    }
    if (status == ROT_OK) status = go(&c, t[i]);
    if (status != ROT_OK) return status;
    theta[i] = c.theta;
    omega[i] = c.rests ? 0.0 : c.side * c.u;
    if (d_theta) memcpy(d_theta + i * P, c.x, sizeof c.x);
    if (d_omega) memcpy(d_omega + i * P, c.s, sizeof c.s);
  }
  return ROT_OK;
}
