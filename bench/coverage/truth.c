#include "truth.h"

#include <math.h>
#include <quadmath.h>
#include <stdlib.h>

/* Which law holds: the sign of omega, the band of the torque-speed curve, and the piece of time,
 * named by a time inside it. */
typedef struct mode {
  const rot_axle_scene *scene;
  int sign; /* of omega; 0: stuck */
  size_t band;
  double inside_s;
} mode;

static size_t count_below(size_t n, const double x[], double t) {
  size_t i = 0;
  while (i < n && x[i] <= t) i++;
  return i;
}

static quad line(double x0, double y0, double x1, double y1, quad x) {
  return (quad)y0 + ((quad)y1 - (quad)y0) * (x - (quad)x0) / ((quad)x1 - (quad)x0);
}

/* Straight lines between knots: the piece that holds inside_s, continued to t. */
static quad knots_at(size_t n, const double t[], const double y[], double before, double after,
                     double inside_s, quad at) {
  const size_t i = count_below(n, t, inside_s);
  if (i == 0) return before;
  if (i == n) return after;
  return line(t[i - 1], y[i - 1], t[i], y[i], at);
}

static quad term_at(const mode *m, const rot_term *term, quad t, quad theta, quad omega) {
  const double *x = term->x;
  if (!(m->inside_s >= term->from_s && m->inside_s < term->to_s)) return 0;
  switch (term->kind) {
  case ROT_TERM_SINUSOID: return (quad)x[0] * cosq((quad)x[1] * t + (quad)x[2]);
  case ROT_TERM_EXPONENTIAL: return (quad)x[0] * expq(-(quad)x[1] * (t - (quad)x[2]));
  case ROT_TERM_POLYNOMIAL: {
    const size_t n = (size_t)x[0], k = (size_t)x[1], i = count_below(n + 1, x + 2, m->inside_s);
    if (i == 0 || i > n) return 0;
    const double *a = x + 3 + n + (i - 1) * k;
    quad sum = 0;
    for (size_t j = k; j-- > 0;) sum = sum * (t - (quad)x[1 + i]) + (quad)a[j];
    return sum;
  }
  case ROT_TERM_CURVE: {
    const size_t n = (size_t)x[0];
    if (m->band == 0) return x[1 + n];
    if (m->band == n) return x[2 * n];
    return line(x[m->band], x[n + m->band], x[m->band + 1], x[n + m->band + 1], omega);
  }
  case ROT_TERM_SPRING: return -(quad)x[0] * (theta - (quad)x[1]);
  case ROT_TERM_GRAVITY: return -(quad)x[0] * sinq(theta - (quad)x[1]);
  default: return nanq("");
  }
}

static quad applied(const mode *m, quad t, quad theta, quad omega) {
  const rot_torque *k = &m->scene->linear.torque;
  quad sum = knots_at(k->n, k->time_s, k->torque_n_m, k->before_n_m, k->after_n_m, m->inside_s, t);
  for (size_t i = 0; i < m->scene->n_terms; i++) {
    sum += term_at(m, &m->scene->terms[i], t, theta, omega);
  }
  return sum - (quad)m->scene->motor_n_m_s * omega;
}

static quad inertia(const mode *m, quad t) {
  const rot_axle_scene *s = m->scene;
  if (s->n_inertia == 0) return s->linear.inertia_kg_m2;
  return knots_at(s->n_inertia, s->inertia_time_s, s->inertia_kg_m2, s->inertia_kg_m2[0],
                  s->inertia_kg_m2[s->n_inertia - 1], m->inside_s, t);
}

/* y = theta, angular momentum. */
static void slope(const void *system, quad t, const quad y[2], quad f[2]) {
  const mode *m = system;
  const rot_axle_scene *s = m->scene;
  const quad omega = y[1] / inertia(m, t);
  f[0] = omega;
  f[1] = applied(m, t, y[0], omega) - (quad)s->viscous_n_m_s * omega -
         (quad)(m->sign * s->quadratic_n_m_s2) * omega * omega - (quad)(m->sign * s->coulomb_n_m);
}

/* One step of length h; the error relative to `scale`. */
static double step(const mode *m, quad t, const quad y[2], quad h, const quad scale[2],
                   quad out[2]) {
  static const midpoint rule = {slope, 2, 12, 1e-29};
  return midpoint_step(&rule, m, t, h, y, scale, out);
}

typedef struct walk {
  mode m;
  quad t, y[2], scale[2], h, span;
  int has_levels;
} walk;

static quad omega_of(const walk *w) { return w->y[1] / inertia(&w->m, w->t); }

static void note(walk *w, double *theta_max, double *omega_max) {
  const double th = fabs((double)w->y[0]), om = fabs((double)omega_of(w));
  if (th > *theta_max) *theta_max = th;
  if (om > *omega_max) *omega_max = om;
  for (int i = 0; i < 2; i++) w->scale[i] = fmaxq(w->scale[i], fabsq(w->y[i]));
}

static const rot_term *curve_of(const rot_axle_scene *s) {
  for (size_t i = 0; i < s->n_terms; i++) {
    if (s->terms[i].kind == ROT_TERM_CURVE) return &s->terms[i];
  }
  return NULL;
}

/* omega's distance past the nearer end of the mode's band: > 0 outside; *level is that end. */
static quad outside(const walk *w, quad omega, double *level) {
  const rot_term *curve = curve_of(w->m.scene);
  double low = -INFINITY, high = INFINITY;
  if (w->m.sign > 0) low = 0.0;
  if (w->m.sign < 0) high = 0.0;
  if (curve) {
    const size_t n = (size_t)curve->x[0];
    if (w->m.band > 0 && curve->x[w->m.band] > low) low = curve->x[w->m.band];
    if (w->m.band < n && curve->x[w->m.band + 1] < high) high = curve->x[w->m.band + 1];
  }
  const quad below = isinf(low) ? -1 : (quad)low - omega, above = isinf(high) ? -1 : omega - high;
  *level = below > above ? low : high;
  return fmaxq(below, above);
}

static int has_sign(const rot_axle_scene *s) {
  return s->quadratic_n_m_s2 != 0.0 || s->static_n_m != 0.0;
}

/* The law just after omega equals a level (or any value): by where omega is about to go. */
static void choose_mode(walk *w) {
  const rot_axle_scene *s = w->m.scene;
  const rot_term *curve = curve_of(s);
  const quad omega = omega_of(w);
  quad rate = 0;
  w->m.sign = 0;
  if (curve) w->m.band = count_below((size_t)curve->x[0], curve->x + 1, (double)omega);
  const quad push = applied(&w->m, w->t, w->y[0], omega);
  if (has_sign(s)) {
    if (omega != 0) {
      w->m.sign = omega > 0 ? 1 : -1;
    } else if (fabsq(push) > (quad)s->static_n_m) {
      w->m.sign = push > 0 ? 1 : -1;
    }
  }
  quad f[2];
  slope(&w->m, w->t, w->y, f);
  rate = f[1];
  if (curve && rate < 0) { /* on a point of the curve and falling: the band below it */
    const size_t n = (size_t)curve->x[0];
    for (size_t i = 0; i < n; i++) {
      if (omega == (quad)curve->x[1 + i]) w->m.band = i;
    }
  }
}

static int stuck(const walk *w) { return has_sign(w->m.scene) && w->m.sign == 0; }

/* Walk to a time with no break in between. */
static int walk_to(walk *w, quad target, double *theta_max, double *omega_max) {
  long budget = 200000;
  while (w->t < target) {
    if (--budget == 0) return 1;
    if (stuck(w)) { /* scan for the moment it breaks loose */
      const quad d = (target - w->t) / 256;
      quad lo = w->t, hi = w->t;
      int loose = 0;
      for (int i = 1; i <= 256 && !loose; i++) {
        hi = i == 256 ? target : w->t + d * i;
        loose = fabsq(applied(&w->m, hi, w->y[0], 0)) > (quad)w->m.scene->static_n_m;
        if (!loose) lo = hi;
      }
      if (!loose) {
        w->t = target;
        return 0;
      }
      for (int i = 0; i < 120; i++) {
        const quad mid = lo + (hi - lo) / 2;
        if (fabsq(applied(&w->m, mid, w->y[0], 0)) > (quad)w->m.scene->static_n_m) {
          hi = mid;
        } else {
          lo = mid;
        }
      }
      w->t = hi;
      choose_mode(w);
      continue;
    }
    const quad left = target - w->t;
    int last = w->h >= left;
    quad h = last ? left : w->h, next[2];
    const double error = step(&w->m, w->t, w->y, h, w->scale, next);
    if (!(error < 1e-27)) {
      w->h = h / 2;
      if (w->h < 1e-32Q * w->span) return 1;
      continue;
    }
    if (w->has_levels) {
      double level;
      walk probe = *w;
      probe.t = w->t + h;
      probe.y[0] = next[0];
      probe.y[1] = next[1];
      if (outside(w, omega_of(&probe), &level) > 0) {
        quad lo = 0, hi = h; /* inside at lo, outside at hi */
        for (int i = 0; i < 130; i++) {
          const quad mid = lo + (hi - lo) / 2;
          step(&w->m, w->t, w->y, mid, w->scale, next);
          probe.t = w->t + mid;
          probe.y[0] = next[0];
          probe.y[1] = next[1];
          double unused;
          if (outside(w, omega_of(&probe), &unused) > 0) {
            hi = mid;
          } else {
            lo = mid;
          }
          if (hi - lo <= 1e-33Q * w->span) break;
        }
        w->t += hi;
        w->y[0] = next[0];
        w->y[1] = (quad)level * inertia(&w->m, w->t);
        note(w, theta_max, omega_max);
        choose_mode(w);
        continue;
      }
    }
    w->y[0] = next[0];
    w->y[1] = next[1];
    w->t = last ? target : w->t + h;
    if (!last && error < 1e-31) w->h *= 1.5Q;
    if (w->has_levels && w->h > w->span / 2048) w->h = w->span / 2048;
    note(w, theta_max, omega_max);
  }
  return 0;
}

int truth_run(const rot_axle_scene *scene, size_t n, const double time_s[], quad theta[],
              quad omega[], double *theta_max, double *omega_max) {
  walk w = {{scene, 0, 0, 0.0}, 0, {0, 0}, {0, 0}, 0, 0, 0};
  const rot_axle_params *p = &scene->linear;
  w.t = p->start_s;
  w.span = n ? (quad)time_s[n - 1] - p->start_s : 0;
  w.h = w.span / 256;
  w.has_levels = has_sign(scene) || curve_of(scene);
  *theta_max = fabs(p->theta0_rad);
  *omega_max = fabs(p->omega0_rad_per_s);
  size_t k = count_below(scene->n_breaks, scene->breaks_s, p->start_s);
  int first = 1;
  for (size_t i = 0; i < n; i++) {
    for (;;) {
      const double next = k < scene->n_breaks ? scene->breaks_s[k] : INFINITY;
      const double begin = k > 0 ? scene->breaks_s[k - 1] : p->start_s - 1.0;
      const double last = (double)w.t > begin ? (double)w.t : begin;
      if (first) {
        w.m.inside_s = isinf(next) ? last + 1.0 : last + (next - last) / 2;
        w.y[0] = p->theta0_rad;
        w.y[1] = (quad)p->omega0_rad_per_s * inertia(&w.m, w.t);
        note(&w, theta_max, omega_max);
        choose_mode(&w);
        first = 0;
      }
      const int at_break = next <= time_s[i];
      if (walk_to(&w, at_break ? (quad)next : (quad)time_s[i], theta_max, omega_max)) return 1;
      if (!at_break) break;
      k++;
      const double after = k < scene->n_breaks ? scene->breaks_s[k] : INFINITY;
      const quad held = w.y[1];
      w.m.inside_s = isinf(after) ? next + 1.0 : next + (after - next) / 2;
      w.y[1] = held;
      choose_mode(&w);
    }
    theta[i] = w.y[0];
    omega[i] = omega_of(&w);
  }
  return 0;
}
