/* Times and lengths along curves in quadruple precision, for curves.R:
 *
 *   y(x) = a + b x + c x^2 + d sin(k x + p)
 *
 * A line is: a b c d k p, from, v0, 2 g/(1 + beta), n, and n places x. The answer has a line of
 * four numbers for each place: the time and what its double lacks, the length and what it lacks.
 * Double-exponential quadrature takes the start from rest as it is. */
#include <math.h>
#include <quadmath.h>
#include <stdio.h>
#include <stdlib.h>

typedef __float128 quad;

typedef struct run {
  quad a, b, c, d, k, p, from, v0, pull;
} run;

static quad slope(const run *r, quad x) {
  return r->b + 2 * r->c * x + r->d * r->k * cosq(r->k * x + r->p);
}

/* y(from) - y(from + u), without cancellation. */
static quad drop(const run *r, quad u) {
  const quad mid = r->k * (r->from + u / 2) + r->p;
  return -u * (r->b + r->c * (2 * r->from + u)) - 2 * r->d * cosq(mid) * sinq(r->k * u / 2);
}

/* The integrals over u from 0 to `to` by t = pi/2 sinh(s), u = to/(1 + exp(-2 t)). */
static void integrate(const run *r, quad to, quad *time, quad *path) {
  const quad step = 1.0Q / 64;
  *time = *path = 0;
  for (int i = -64 * 5; i <= 64 * 5; i++) {
    const quad s = i * step, t = M_PI_2q * sinhq(s);
    const quad share = 1 / (1 + expq(-2 * t));
    const quad weight = step * M_PI_2q * coshq(s) / (2 * coshq(t) * coshq(t)) * fabsq(to);
    const quad u = to * share, ds = sqrtq(1 + powq(slope(r, r->from + u), 2));
    const quad v2 = r->v0 * r->v0 + r->pull * drop(r, u);
    if (weight == 0 || !(v2 > 0)) continue;
    *time += weight * ds / sqrtq(v2);
    *path += weight * ds;
  }
}

static void show(quad x) {
  const double near = (double)x;
  printf("%.17g %.17g ", near, (double)(x - near));
}

int main(void) {
  double in[9];
  int n;
  for (;;) {
    for (int i = 0; i < 9; i++) {
      if (scanf("%lf", &in[i]) != 1) return EXIT_SUCCESS;
    }
    const run r = {in[0], in[1], in[2], in[3], in[4], in[5], in[6], in[7], in[8]};
    if (scanf("%d", &n) != 1) return EXIT_FAILURE;
    for (int i = 0; i < n; i++) {
      double x;
      quad time, path;
      if (scanf("%lf", &x) != 1) return EXIT_FAILURE;
      integrate(&r, (quad)x - r.from, &time, &path);
      show(time);
      show(path);
    }
    putchar('\n');
  }
}
