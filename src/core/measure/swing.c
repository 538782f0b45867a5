#include "measure/swing.h"

#include <float.h>
#include <math.h>
#include <string.h>

enum { P = ROT_SWING_PARAMETERS, ORDER = 22, TERMS = ORDER + 1 };

/* Max step of time omega0 t: the series of a spring converge everywhere, those of a pendulum at
 * least to pi/2. Half a period is pi. */
static const double LONGEST_STEP = 1.5;

/* ---- the series ----------------------------------------------------------------------------- */

typedef struct series {
  double theta[TERMS], omega[TERMS]; /* rad, rad per unit of time */
  double d_theta[P][TERMS], d_omega[P][TERMS];
} series;

typedef struct state {
  double theta, omega;
  double d_theta[P], d_omega[P];
} state;

/* Parameters in units of time 1/omega0. */
typedef struct scaled {
  double decay, coulomb, quadratic; /* gamma/omega0, a/omega0^2, k */
  double omega0;
  int spring;
} scaled;

/* => sum a_j b_(k-j) */
static double product(const double a[], const double b[], int k) {
  double sum = 0.0;
  for (int j = 0; j <= k; j++) sum += a[j] * b[k - j];
  return sum;
}

/* (state, direction of the motion, +1 or -1) => series. Derivatives are by the scaled parameters;
 * that by omega0 is 0 here and computed in row_at(). */
static void expand(const scaled *law, const state *from, double side, series *out) {
  double sine[TERMS], cosine[TERMS], square[TERMS];
  out->theta[0] = from->theta;
  out->omega[0] = from->omega;
  for (int i = 0; i < P; i++) {
    out->d_theta[i][0] = from->d_theta[i];
    out->d_omega[i][0] = from->d_omega[i];
  }
  for (int k = 0; k < TERMS; k++) {
    if (law->spring) {
      sine[k] = out->theta[k];
      cosine[k] = k == 0 ? 1.0 : 0.0;
    } else if (k == 0) {
      sine[0] = sin(out->theta[0]);
      cosine[0] = cos(out->theta[0]);
    } else {
      double s = 0.0, c = 0.0;
      for (int j = 1; j <= k; j++) {
        s += j * out->theta[j] * cosine[k - j];
        c -= j * out->theta[j] * sine[k - j];
      }
      sine[k] = s / k;
      cosine[k] = c / k;
    }
    square[k] = product(out->omega, out->omega, k);
    if (k == ORDER) break;
    const double one = k == 0 ? 1.0 : 0.0, next = 1.0 / (k + 1);
    out->theta[k + 1] = next * out->omega[k];
    out->omega[k + 1] = -next * (sine[k] + 2.0 * law->decay * out->omega[k] +
                                 side * (law->coulomb * one + law->quadratic * square[k]));
    for (int i = 0; i < P; i++) {
      const double *const v = out->d_omega[i];
      double force = 2.0 * law->decay * v[k];
      force += law->spring ? out->d_theta[i][k] : product(cosine, out->d_theta[i], k);
      if (law->quadratic != 0.0) force += 2.0 * side * law->quadratic * product(out->omega, v, k);
      if (i == ROT_SWING_DECAY) force += 2.0 * out->omega[k];
      if (i == ROT_SWING_COULOMB) force += side * one;
      if (i == ROT_SWING_QUADRATIC) force += side * square[k];
      out->d_theta[i][k + 1] = next * v[k];
      out->d_omega[i][k + 1] = -next * force;
    }
  }
}

/* => step at which the last two terms are below rounding of the largest */
static double reach_of(const double c[]) {
  double size = 0.0, reach = LONGEST_STEP;
  for (int k = 0; k < 4; k++) size = fmax(size, fabs(c[k]));
  for (int k = ORDER - 1; k <= ORDER; k++) {
    const double last = fabs(c[k]);
    if (last > 0.0 && size > 0.0)
      reach = fmin(reach, pow(0.1 * DBL_EPSILON * size / last, 1.0 / k));
  }
  return reach;
}

static double step_of(const series *s) {
  double step = fmin(reach_of(s->theta), reach_of(s->omega));
  for (int i = 0; i < P; i++) step = fmin(step, reach_of(s->d_omega[i]));
  return step;
}

static double at(const double c[], double x) {
  double sum = c[ORDER];
  for (int k = ORDER - 1; k >= 0; k--) sum = sum * x + c[k];
  return sum;
}

static double slope_at(const double c[], double x) {
  double sum = ORDER * c[ORDER];
  for (int k = ORDER - 1; k >= 1; k--) sum = sum * x + k * c[k];
  return sum;
}

static void state_at(const series *s, double x, state *out) {
  out->theta = at(s->theta, x);
  out->omega = at(s->omega, x);
  for (int i = 0; i < P; i++) {
    out->d_theta[i] = at(s->d_theta[i], x);
    out->d_omega[i] = at(s->d_omega[i], x);
  }
}

/* => zero in (0, end] of a function that has the sign `side` after 0 and not at the end */
static double zero_of(double (*f)(const double[], double), const double c[], double side,
                      double end) {
  double low = 0.0, high = end;
  for (int round = 0; round < 80 && high - low > 0.25 * DBL_EPSILON * end; round++) {
    const double middle = 0.5 * (low + high);
    if (side * f(c, middle) > 0.0)
      low = middle;
    else
      high = middle;
  }
  return 0.5 * (low + high);
}

/* ---- the motion ----------------------------------------------------------------------------- */

typedef struct motion {
  scaled law;
  state now;
  double side;  /* direction of the motion; 0: permanent rest */
  double phase; /* omega0 (t - start) */
  series s;
  double step;  /* length of the series' step, at most to the turning point */
  int turns;    /* 1: the step ends at a turning point */
  double steps; /* so far */
} motion;

static double restoring(const scaled *law, double theta) {
  return law->spring ? theta : sin(theta);
}

/* => direction after a turning point: towards the centre, or 0 if static friction is sufficient */
static double side_from_rest(const scaled *law, double theta) {
  const double pull = -restoring(law, theta);
  return fabs(pull) > law->coulomb ? (pull > 0.0) - (pull < 0.0) : 0.0;
}

static int finite_state(const state *x) {
  double sum = x->theta + x->omega;
  for (int i = 0; i < P; i++) sum += x->d_theta[i] + x->d_omega[i];
  return isfinite(sum);
}

/* swing => motion at the start; ROT_EVALUE for invalid parameters */
static rot_status begin(const rot_swing *swing, motion *m) {
  const double *const p = swing->p;
  const double w = p[ROT_SWING_OMEGA0];
  memset(m, 0, sizeof *m);
  for (int i = 0; i < P; i++) {
    if (!isfinite(p[i])) return ROT_EVALUE;
  }
  if (!(w > 0.0)) return ROT_EVALUE;
  m->law = (scaled){p[ROT_SWING_DECAY] / w, p[ROT_SWING_COULOMB] / (w * w), p[ROT_SWING_QUADRATIC],
                    w, swing->spring};
  m->now.theta = p[ROT_SWING_THETA];
  m->now.omega = p[ROT_SWING_OMEGA] / w;
  /* Derivatives by the scaled parameters: start angle, start rate, -, decay, coulomb, quadratic. */
  m->now.d_theta[ROT_SWING_THETA] = 1.0;
  m->now.d_omega[ROT_SWING_OMEGA] = 1.0;
  m->side = m->now.omega > 0.0   ? 1.0
            : m->now.omega < 0.0 ? -1.0
                                 : side_from_rest(&m->law, m->now.theta);
  return ROT_OK;
}

/* present state => series, its step */
static rot_status look_ahead(motion *m) {
  if (m->side == 0.0) {
    m->step = HUGE_VAL;
    m->turns = 0;
    return ROT_OK;
  }
  expand(&m->law, &m->now, m->side, &m->s);
  m->step = step_of(&m->s);
  if (!(m->step > 1e-9)) return ROT_ERANGE;
  m->turns = m->side * at(m->s.omega, m->step) <= 0.0;
  if (m->turns) m->step = zero_of(at, m->s.omega, m->side, m->step);
  return ROT_OK;
}

/* Advances by the step. Oscillations take 1 to 5 steps per unit of time; ROT_EBUDGET for losses
 * that take many more. */
static rot_status step_ahead(motion *m) {
  if (++m->steps > 1000.0 + 20.0 * m->phase) return ROT_EBUDGET;
  state_at(&m->s, m->step, &m->now);
  m->phase += m->step;
  if (m->turns) {
    /* The rate is continuous along the motion; its derivatives change with the force, since the
     * time of the turning point moves. */
    const double pull = -restoring(&m->law, m->now.theta);
    const double before = pull - m->side * m->law.coulomb;
    const double after = pull + m->side * m->law.coulomb;
    const int goes_on = -m->side * after > 0.0;
    for (int i = 0; i < P; i++) {
      m->now.d_omega[i] *= goes_on && before != 0.0 ? after / before : 0.0;
    }
    m->now.omega = 0.0;
    m->side = goes_on ? -m->side : 0.0;
  }
  return finite_state(&m->now) ? ROT_OK : ROT_ERANGE;
}

/* => value and its derivatives by p at x after the present state, from those by the scaled
 * parameters: theta(t) = f(omega0 t; theta, omega/omega0, decay/omega0, coulomb/omega0^2,
 * quadratic). */
static void row_at(const motion *m, const rot_swing *swing, double x, double *value,
                   double derivative[]) {
  const double w = m->law.omega0, *const p = swing->p;
  const int rests = m->side == 0.0;
  const int rate = swing->rate;
  double d[P];
  double theta = m->now.theta, omega = 0.0, slope = 0.0;
  if (!rests) {
    theta = at(m->s.theta, x);
    omega = at(m->s.omega, x);
    slope = rate ? slope_at(m->s.omega, x) : omega;
  }
  for (int i = 0; i < P; i++) {
    if (rests)
      d[i] = rate ? 0.0 : m->now.d_theta[i];
    else
      d[i] = at(rate ? m->s.d_omega[i] : m->s.d_theta[i], x);
  }
  const double scale = rate ? w : 1.0;
  *value = rate ? w * omega : theta;
  derivative[ROT_SWING_THETA] = scale * d[ROT_SWING_THETA];
  derivative[ROT_SWING_OMEGA] = scale * d[ROT_SWING_OMEGA] / w;
  derivative[ROT_SWING_DECAY] = scale * d[ROT_SWING_DECAY] / w;
  derivative[ROT_SWING_COULOMB] = scale * d[ROT_SWING_COULOMB] / (w * w);
  derivative[ROT_SWING_QUADRATIC] = scale * d[ROT_SWING_QUADRATIC];
  derivative[ROT_SWING_OMEGA0] =
      scale *
          (slope * (m->phase + (rests ? 0.0 : x)) - d[ROT_SWING_OMEGA] * p[ROT_SWING_OMEGA] / w -
           d[ROT_SWING_DECAY] * p[ROT_SWING_DECAY] / w -
           2.0 * d[ROT_SWING_COULOMB] * p[ROT_SWING_COULOMB] / (w * w)) /
          w +
      (rate ? omega : 0.0);
}

rot_status rot_swing_rows(const rot_swing *swing, double start_s, size_t n, const double time_s[],
                          const rot_hooks *hooks, double value[], double derivative[]) {
  motion m;
  rot_status status = begin(swing, &m);
  if (status == ROT_OK) status = look_ahead(&m);
  for (size_t i = 0; status == ROT_OK && i < n; i++) {
    const double phase = m.law.omega0 * (time_s[i] - start_s);
    if (!(phase >= 0.0) || !isfinite(phase)) return ROT_EVALUE;
    while (status == ROT_OK && phase - m.phase > m.step) {
      status = step_ahead(&m);
      if (status == ROT_OK) status = rot_poll(hooks, (double)i / (double)n);
      if (status == ROT_OK) status = look_ahead(&m);
    }
    if (status == ROT_OK) row_at(&m, swing, phase - m.phase, value + i, derivative + i * P);
  }
  return status;
}

rot_status rot_swing_extremes(const rot_swing *swing, double start_s, double end_s, size_t max,
                              const rot_hooks *hooks, size_t *n, double time_s[], double value[],
                              double derivative[]) {
  motion m;
  *n = 0;
  rot_status status = begin(swing, &m);
  const double end = m.law.omega0 * (end_s - start_s);
  if (status == ROT_OK) status = look_ahead(&m);
  while (status == ROT_OK && *n < max && m.side != 0.0 && m.phase < end) {
    double x = -1.0;
    if (swing->rate) {
      const double first = slope_at(m.s.omega, 0.0), last = slope_at(m.s.omega, m.step);
      if (first * last < 0.0) x = zero_of(slope_at, m.s.omega, first > 0.0 ? 1.0 : -1.0, m.step);
    } else if (m.turns) {
      x = m.step;
    }
    if (x >= 0.0 && m.phase + x <= end) {
      time_s[*n] = start_s + (m.phase + x) / m.law.omega0;
      row_at(&m, swing, x, value + *n, derivative + *n * P);
      ++*n;
    }
    status = step_ahead(&m);
    if (status == ROT_OK) status = rot_poll(hooks, m.phase / end);
    if (status == ROT_OK) status = look_ahead(&m);
  }
  return status;
}
