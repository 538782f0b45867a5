/* Do the reported errors of chains of pendulums cover the true ones, and do their audits balance?
 * Random chains of 1 to 5 links, judged in quadruple precision: extrapolated midpoint steps of
 * Lagrange's equations, the mass matrix eliminated with pivots.
 *
 *   pendulums [scenes per class] [seed] [class] */
#include "contest.h"
#include "scene/chain/chain.h"

enum { MOST = 5 };

/* ---- random scenes --------------------------------------------------------------------------- */

enum { POINTS = 1, RODS = 2 };

static size_t draw_chain(sample *s, int kind, double grade, double size, double fast) {
  const size_t n = 1 + (size_t)uniform(0.0, 4.999);
  double length[MOST], mass[MOST], theta[MOST], omega[MOST];
  for (size_t i = 0; i < n; i++) {
    length[i] = power(-0.7, 0.5);
    mass[i] = power(-grade, grade);
    theta[i] = size * uniform(-1.0, 1.0);
    omega[i] = fast * uniform(-1.0, 1.0);
  }
  set(s, "length_m", n, length);
  set(s, "mass_kg", n, mass);
  set(s, "theta0_rad", n, theta);
  set(s, "omega0_rad_per_s", n, omega);
  set_option(s, "links", kind == POINTS);
  set_one(s, "gravity_m_per_s2", chance(0.1) ? 0.0 : chance(0.7) ? 9.80665 : power(-1.0, 1.0));
  s->accuracy = power(-12.0, -3.0);
  return n;
}

static void draw_joints(sample *s, size_t n, double low, double high) {
  double joint[MOST];
  for (size_t i = 0; i < n; i++) joint[i] = chance(0.2) ? 0.0 : power(low, high);
  set(s, "resistance", n, joint);
}

static void points(sample *s) {
  draw_chain(s, POINTS, 0.5, 3.1, chance(0.3) ? 0.0 : power(-1.0, 0.6));
  draw_rows(s, chance(0.3) ? -power(-0.5, 0.5) : 0.0, power(-0.5, 0.5));
}

static void rods(sample *s) {
  draw_chain(s, RODS, 0.5, 3.1, chance(0.3) ? 0.0 : power(-1.0, 0.6));
  draw_rows(s, chance(0.3) ? -power(-0.5, 0.5) : 0.0, power(-0.5, 0.5));
}

/* Small swings, also of the modes. */
static void small(sample *s) {
  const double size = power(-9.0, -1.0);
  draw_chain(s, chance(0.5) ? POINTS : RODS, 0.5, size, chance(0.5) ? 0.0 : size);
  draw_rows(s, chance(0.3) ? -power(-0.5, 0.5) : 0.0, power(-0.5, 0.7));
}

static void modes(sample *s) {
  small(s);
  set_one(s, "gravity_m_per_s2", 9.80665);
  s->accuracy = 0.9;
}

/* Masses that differ by up to six decades. */
static void graded(sample *s) {
  draw_chain(s, chance(0.5) ? POINTS : RODS, 3.0, 1.5, chance(0.5) ? 0.0 : power(-1.0, 0.3));
  draw_rows(s, 0.0, power(-1.0, 0.0));
}

static void damped(sample *s) {
  const size_t n = draw_chain(s, chance(0.5) ? POINTS : RODS, 0.5, 3.1, power(-1.0, 0.6));
  draw_joints(s, n, -2.0, 1.0);
  draw_rows(s, 0.0, power(-0.5, 0.5));
}

static void stiff(sample *s) {
  const size_t n = draw_chain(s, chance(0.5) ? POINTS : RODS, 0.5, 3.1, power(-1.0, 0.5));
  draw_joints(s, n, 0.5, 2.3);
  draw_rows(s, 0.0, power(-0.5, 0.3));
  s->model = "chain_radau";
}

/* ---- the truth ------------------------------------------------------------------------------- */

/* The state: angles, rates, heat, impulse. */
typedef struct body {
  int n;
  quad a[MOST][MOST], b[MOST], c[MOST];
} body;

static const double *given(const sample *s, const char *input, size_t *n) {
  const size_t at = rot_input_named(s->c->makers->n_inputs, s->c->makers->inputs, input);
  *n = s->given[at].n;
  return s->given[at].is ? s->given[at].x : NULL;
}

static void slopes(const void *system, quad t, const quad y[], quad f[]) {
  const body *p = system;
  const int n = p->n;
  quad m[MOST][MOST + 1], sine[MOST], cosine[MOST];
  (void)t;
  for (int i = 0; i < n; i++) sincosq(y[i], &sine[i], &cosine[i]);
  f[2 * n] = f[2 * n + 1] = 0;
  for (int i = 0; i < n; i++) {
    const quad above = y[n + i] - (i ? y[n + i - 1] : 0);
    const quad below = i + 1 < n ? y[n + i + 1] - y[n + i] : 0;
    m[i][n] = -p->b[i] * sine[i] - p->c[i] * above;
    if (i + 1 < n) m[i][n] += p->c[i + 1] * below;
    for (int j = 0; j < n; j++) {
      m[i][j] = p->a[i][j] * (cosine[i] * cosine[j] + sine[i] * sine[j]);
      m[i][n] -= p->a[i][j] * (sine[i] * cosine[j] - cosine[i] * sine[j]) * y[n + j] * y[n + j];
    }
    f[i] = y[n + i];
    f[2 * n] += p->c[i] * above * above;
    f[2 * n + 1] -= p->b[i] * sine[i];
  }
  f[2 * n + 1] -= p->c[0] * y[n];
  for (int k = 0; k < n; k++) {
    int pivot = k;
    for (int i = k + 1; i < n; i++) {
      if (fabsq(m[i][k]) > fabsq(m[pivot][k])) pivot = i;
    }
    for (int j = k; j <= n; j++) {
      const quad keep = m[k][j];
      m[k][j] = m[pivot][j];
      m[pivot][j] = keep;
    }
    for (int i = k + 1; i < n; i++) {
      const quad by = m[i][k] / m[k][k];
      for (int j = k; j <= n; j++) m[i][j] -= by * m[k][j];
    }
  }
  for (int i = n - 1; i >= 0; i--) {
    quad sum = m[i][n];
    for (int j = i + 1; j < n; j++) sum -= m[i][j] * f[n + j];
    f[n + i] = sum / m[i][i];
  }
}

static void note(const body *p, const quad y[], answer *out) {
  for (int i = 0; i < p->n; i++) {
    out->most[0] = fmax(out->most[0], fabs((double)y[i]));
    out->most[1] = fmax(out->most[1], fabs((double)y[p->n + i]));
  }
}

/* From the start to a time, in steps that the table of the extrapolation takes; `halved`: in half
 * of them, as a check. */
static int walk(const body *p, quad *t, quad target, quad *h, quad y[], int halved, answer *out) {
  const midpoint rule = {slopes, 2 * p->n + 2, 12, 1e-27};
  quad size[2 * MOST + 2];
  long budget = 20000;
  while (*t != target) {
    if (--budget == 0) return 1;
    quad next[2 * MOST + 2], d = target - *t;
    const int last = fabsq(*h) >= fabsq(d);
    if (!last) d = copysignq(*h, d);
    quad most = 0, fast = 0;
    for (int i = 0; i < p->n; i++) {
      most = fmaxq(most, fabsq(y[i]));
      fast = fmaxq(fast, fabsq(y[p->n + i]));
    }
    for (int i = 0; i < p->n; i++) {
      size[i] = fmaxq(most, fabsq(d) * fast);
      size[p->n + i] = fmaxq(fast, most / fabsq(d));
    }
    size[2 * p->n] = size[2 * p->n + 1] = 1e300Q; /* they follow */
    const double error = midpoint_step(&rule, p, *t, d, y, size, next);
    int finite = 1; /* the largest of several leaves a NaN out */
    for (int i = 0; i < 2 * p->n + 2; i++) finite = finite && finiteq(next[i]);
    if (!(error < 1e-26 && finite)) {
      *h = fabsq(d) / 2;
      continue;
    }
    if (halved) {
      midpoint_step(&rule, p, *t, d / 2, y, size, next);
      midpoint_step(&rule, p, *t + d / 2, d / 2, next, size, next);
    }
    memcpy(y, next, (size_t)(2 * p->n + 2) * sizeof *y);
    *t = last ? target : *t + d;
    note(p, y, out);
    if (!last && error < 1e-27) *h *= 1.2Q;
  }
  return 0;
}

static int truth(const sample *s, answer *out) {
  size_t n, n_mass, n_theta, n_omega, n_joint, one;
  const double *length = given(s, "length_m", &n), *mass = given(s, "mass_kg", &n_mass);
  const double *theta = given(s, "theta0_rad", &n_theta);
  const double *omega = given(s, "omega0_rad_per_s", &n_omega);
  const double *joint = given(s, "resistance", &n_joint);
  const quad gravity = given(s, "gravity_m_per_s2", &one)[0];
  const size_t links = rot_input_named(s->c->makers->n_inputs, s->c->makers->inputs, "links");
  const int rods_ = s->given[links].option == 0;
  const quad f = rods_ ? 0.5Q : 1, h = rods_ ? 1 / 3.0Q : 1;
  body p = {.n = (int)n};
  memset(out, 0, sizeof *out);
  for (int i = 0; i < p.n; i++) {
    for (int j = 0; j < p.n; j++) {
      const int low = i > j ? i : j;
      quad below = 0;
      for (int k = low + 1; k < p.n; k++) below += mass[k];
      p.a[i][j] = (quad)length[i] * length[j] * ((i == j ? h : f) * mass[low] + below);
      if (i == j) p.b[i] = gravity * length[i] * (f * mass[i] + below);
    }
    p.c[i] = joint ? joint[i] : 0;
  }
  for (int way = -1; way <= 1; way += 2) {
    quad y[2 * MOST + 2] = {0}, check[2 * MOST + 2], t = s->start_s, step = 0.05Q;
    for (int i = 0; i < p.n; i++) y[i] = theta[i], y[p.n + i] = omega[i];
    note(&p, y, out);
    memcpy(check, y, sizeof y);
    for (int k = 0; k < ROWS; k++) {
      const int row = way > 0 ? k : ROWS - 1 - k;
      if (way * (s->rows_s[row] - s->start_s) < 0) continue;
      if (walk(&p, &t, s->rows_s[row], &step, y, 0, out)) return 1;
      for (int i = 0; i < p.n; i++) {
        out->theta[row][i] = y[i];
        out->omega[row][i] = y[p.n + i];
      }
      out->flow[row][0] = y[2 * p.n];
      out->flow[row][1] = y[2 * p.n + 1];
    }
    if (getenv("COVERAGE_HALVE")) {
      quad u = s->start_s, worst = 0;
      step = 0.05Q;
      if (t == u || walk(&p, &u, t, &step, check, 1, out)) continue;
      for (int i = 0; i < 2 * p.n; i++) worst = fmaxq(worst, fabsq(check[i] - y[i]));
      fprintf(stderr, "halved steps: %.1e of %.3g\n", (double)worst, out->most[0]);
    }
  }
  return 0;
}

static const contest contests[] = {{"points", points, 0.95}, {"rods", rods, 0.95},
                                   {"small", small, 0.95},   {"modes", modes, 0.95},
                                   {"graded", graded, 0.95}, {"damped", damped, 0.95},
                                   {"stiff", stiff, 0.95}};

int main(int argc, char **argv) {
  return run_contests("pendulums", sizeof contests / sizeof *contests, contests,
                      &rot_chain_constraint, truth, argc, argv);
}
