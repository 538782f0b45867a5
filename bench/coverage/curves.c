/* Times and lengths along curves in quadruple precision, for curves.R:
 *
 *   y(x) = a + b x + c x^2 + d sin(k x + p) + h exp(-((x - m)/w)^2)
 *
 * A line is: a b c d k p h m w, from, to, v0, g, 2 g/(1 + beta), n, and n places x. The answer has
 * four numbers for each place: the time and what its double lacks, the length and what it lacks;
 * then the event (0 arrives, 1 turns, 2 leaves), its place and the least v^2 before it.
 * Double-exponential quadrature takes the start from rest, and an end at rest, as it is; the bump
 * has panels of its own. */
#include <math.h>
#include <quadmath.h>
#include <stdio.h>
#include <stdlib.h>

typedef __float128 quad;

typedef struct run {
  quad a, b, c, d, k, p, h, m, w, from, to, v0, g, pull;
} run;

static quad bump(const run *r, quad x) {
  const quad z = (x - r->m) / r->w;
  return r->h * expq(-z * z);
}

static quad slope(const run *r, quad x) {
  return r->b + 2 * r->c * x + r->d * r->k * cosq(r->k * x + r->p) -
         2 * (x - r->m) / (r->w * r->w) * bump(r, x);
}

static quad second(const run *r, quad x) {
  const quad z = (x - r->m) / r->w;
  return 2 * r->c - r->d * r->k * r->k * sinq(r->k * x + r->p) +
         (4 * z * z - 2) / (r->w * r->w) * bump(r, x);
}

/* y(from) - y(from + u), without cancellation. */
static quad drop(const run *r, quad u) {
  const quad mid = r->k * (r->from + u / 2) + r->p;
  const quad z0 = (r->from - r->m) / r->w, z1 = (r->from + u - r->m) / r->w;
  const quad low = fminq(fabsq(z0), fabsq(z1)), more = fabsq(z0 * z0 - z1 * z1);
  const quad apart = -r->h * expq(-low * low) * expm1q(-more);
  return -u * (r->b + r->c * (2 * r->from + u)) - 2 * r->d * cosq(mid) * sinq(r->k * u / 2) +
         (fabsq(z0) < fabsq(z1) ? apart : -apart);
}

static quad square_speed(const run *r, quad u) { return r->v0 * r->v0 + r->pull * drop(r, u); }

/* v^2 where that is negative, else the push over the mass where that is. */
static quad allowed(const run *r, quad u, int *event) {
  const quad v2 = square_speed(r, u), s = slope(r, r->from + u);
  const quad push = v2 * second(r, r->from + u) / powq(1 + s * s, 1.5Q) + r->g / sqrtq(1 + s * s);
  *event = v2 < 0 ? 1 : push < 0 ? 2 : 0;
  return v2 < 0 ? v2 : push;
}

/* The integrals over u from u0 to u1 by t = pi/2 sinh(s), u = u0 + (u1 - u0)/(1 + exp(-2 t)). */
static void integrate(const run *r, quad u0, quad u1, quad *time, quad *path) {
  const quad step = 1.0Q / 64;
  for (int i = -64 * 5; i <= 64 * 5; i++) {
    const quad s = i * step, t = M_PI_2q * sinhq(s);
    const quad share = 1 / (1 + expq(-2 * t));
    const quad weight = step * M_PI_2q * coshq(s) / (2 * coshq(t) * coshq(t)) * fabsq(u1 - u0);
    const quad u = u0 + (u1 - u0) * share, ds = sqrtq(1 + powq(slope(r, r->from + u), 2));
    const quad v2 = square_speed(r, u);
    if (weight == 0 || !(v2 > 0)) continue;
    *time += weight * ds / sqrtq(v2);
    *path += weight * ds;
  }
}

enum { SIDES = 8 }; /* panels of the width w on either side of the bump */

/* Edges of panels from 0 to `to`, at most 2 SIDES + 3. */
static int panels(const run *r, quad to, quad edge[]) {
  const quad way = to < 0 ? -1 : 1;
  int n = 0;
  edge[n++] = 0;
  for (int i = -SIDES; i <= SIDES && r->h != 0; i++) {
    const quad u = r->m + way * i * r->w - r->from;
    if (u * way > 0 && u * way < to * way) edge[n++] = u;
  }
  edge[n++] = to;
  return n;
}

/* Time and length up to a place. */
static void up_to(const run *r, quad to, quad *time, quad *path) {
  quad edge[2 * SIDES + 3];
  const int n = panels(r, to, edge);
  *time = *path = 0;
  for (int i = 1; i < n; i++) integrate(r, edge[i - 1], edge[i], time, path);
}

/* The first place that is not allowed, by samples in each panel and halving. */
static int event_of(const run *r, quad *place, quad *least) {
  quad edge[2 * SIDES + 3], before = 0;
  const int n = panels(r, r->to - r->from, edge);
  int event, at;
  *place = r->to;
  *least = INFINITY;
  for (int i = 1; i < n; i++) {
    const int parts = fabsq(edge[i] - edge[i - 1]) > 1.5Q * r->w ? 2000 : 200;
    for (int j = 1; j <= parts; j++) {
      quad good = before, bad = edge[i - 1] + (edge[i] - edge[i - 1]) * j / parts;
      before = bad;
      allowed(r, bad, &event);
      *least = fminq(*least, square_speed(r, bad));
      if (!event) continue;
      for (int k = 0; k < 100; k++) {
        const quad mid = (good + bad) / 2;
        allowed(r, mid, &at);
        if (at) {
          bad = mid;
          event = at;
        } else {
          good = mid;
        }
      }
      *place = r->from + bad;
      return event;
    }
  }
  return 0;
}

static void show(quad x) {
  const double near = (double)x;
  printf("%.17g %.17g ", near, (double)(x - near));
}

int main(void) {
  double in[14];
  int n;
  for (;;) {
    for (int i = 0; i < 14; i++) {
      if (scanf("%lf", &in[i]) != 1) return EXIT_SUCCESS;
    }
    const run r = {in[0], in[1], in[2], in[3],  in[4],  in[5],  in[6],
                   in[7], in[8], in[9], in[10], in[11], in[12], in[13]};
    quad place, least;
    if (scanf("%d", &n) != 1) return EXIT_FAILURE;
    for (int i = 0; i < n; i++) {
      double x;
      quad time, path;
      if (scanf("%lf", &x) != 1) return EXIT_FAILURE;
      up_to(&r, (quad)x - r.from, &time, &path);
      show(time);
      show(path);
    }
    const int event = event_of(&r, &place, &least);
    printf("%d %.17g %.17g\n", event, (double)place, (double)least);
  }
}
