/* Do the reported errors of the incline cover the true ones? Random scenes, judged in quadruple
 * precision: extrapolated midpoint steps of the equations of v and R omega, each event bisected.
 *
 *   incline [scenes per model] [seed] [model] */
#include <math.h>
#include <quadmath.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "midpoint.h"
#include "random.h"
#include "scene/incline/ode.h"
#include "scene/incline/table.h"

enum { ROWS = 8 };

/* ---- random scenes --------------------------------------------------------------------------- */

/* A force size sin(rate t), its absolute value, or its sign, which no break marks. */
typedef enum form { SINE, KINKS, JUMPS } form;

typedef struct wave {
  double size, rate;
  form form;
} wave;

typedef struct sample {
  rot_incline_scene scene;
  wave wave;
  double rows_s[ROWS], accuracy;
} sample;

static double sign_of(double x) { return (x > 0.0) - (x < 0.0); }

static rot_status wave_at(double t, double x, double v, double *force, void *ctx) {
  const wave *w = ctx;
  (void)x, (void)v;
  const double sine = sin(w->rate * t);
  *force = w->size * (w->form == SINE ? sine : w->form == KINKS ? fabs(sine) : sign_of(sine));
  return ROT_OK;
}

static int by_size(const void *a, const void *b) {
  const double x = *(const double *)a, y = *(const double *)b;
  return (x > y) - (x < y);
}

static void constant_scene(sample *s) {
  memset(s, 0, sizeof *s);
  rot_incline_params *p = &s->scene.slope;
  const double radius = power(-2.0, 0.0), mu = chance(0.1) ? 0.0 : uniform(0.0, 0.9);
  p->mass_kg = power(-1.0, 1.5);
  p->radius_m = radius;
  p->inertia_kg_m2 = uniform(0.05, 1.0) * p->mass_kg * radius * radius;
  p->angle_deg = chance(0.15) ? 0.0 : uniform(-75.0, 75.0);
  p->gravity_m_per_s2 = 9.80665;
  p->mu_static = mu;
  p->mu_kinetic = chance(0.4) ? mu : uniform(0.3, 1.0) * mu;
  p->arm_m = chance(0.5) ? 0.0 : power(-3.0, -0.5) * radius;
  p->v0_m_per_s = chance(0.2) ? 0.0 : either(power(-1.0, 1.0));
  p->omega0_rad_per_s = chance(0.2)   ? 0.0
                        : chance(0.2) ? p->v0_m_per_s / radius
                                      : either(power(-1.0, 1.0)) / radius;
  p->x0_m = chance(0.7) ? 0.0 : uniform(-3.0, 3.0);
  p->theta0_rad = chance(0.7) ? 0.0 : uniform(-3.0, 3.0);
  p->start_s = chance(0.5) ? 0.0 : uniform(-2.0, 2.0);
  const double span = power(-1.0, 0.8);
  for (int i = 0; i < ROWS; i++) s->rows_s[i] = p->start_s + uniform(0.0, span);
  qsort(s->rows_s, ROWS, sizeof *s->rows_s, by_size);
  s->accuracy = power(-11.0, -4.0);
}

static void table_scene(sample *s) {
  constant_scene(s);
  s->scene.slope.start_s = s->scene.slope.x0_m = s->scene.slope.theta0_rad = 0.0;
  for (int i = 0; i < ROWS; i++) s->rows_s[i] = power(-2.0, 0.8);
  qsort(s->rows_s, ROWS, sizeof *s->rows_s, by_size);
}

static void forced_scene(sample *s) {
  constant_scene(s);
  const double mass = s->scene.slope.mass_kg;
  if (chance(0.7)) s->scene.drag_n_s_per_m = mass * power(-1.5, 0.5);
  if (chance(0.5)) s->scene.drag_n_s2_per_m2 = mass * power(-2.0, 0.0);
  if (chance(0.5)) {
    const double size = mass * either(power(-0.5, 1.0));
    s->wave = (wave){size, power(-0.5, 0.8), chance(0.6) ? SINE : chance(0.5) ? KINKS : JUMPS};
    s->scene.force = wave_at;
    s->scene.ctx = &s->wave;
  }
}

/* ---- the truth ------------------------------------------------------------------------------- */

/* Signs of slip and spin in this stretch; 0: the contact grips, the resistance holds. */
typedef struct body {
  const sample *s;
  quad beta, gravity, grips, slides, resists;
  int slip, spin, way; /* way: sign of v for the quadratic drag */
  int half;            /* sign of the wave in this half of its period */
  quad t, y[4];        /* x, path of the rim, v, w */
  double most[4];      /* largest |x|, |v|, |theta|, |omega| so far */
} body;

static quad pull_at(const body *b, quad t, quad v) {
  const rot_incline_scene *scene = &b->s->scene;
  quad force = -(quad)scene->drag_n_s_per_m * v - (quad)scene->drag_n_s2_per_m2 * v * v * b->way;
  if (scene->force) {
    const wave *w = &b->s->wave;
    const quad sine = w->form == JUMPS ? b->half : sinq((quad)w->rate * t);
    force += (quad)w->size * (w->form == KINKS ? b->half * sine : sine);
  }
  return b->gravity + force / (quad)scene->slope.mass_kg;
}

static int sign(quad x) { return (x > 0) - (x < 0); }
static int held(const body *b) { return b->resists > 0 && b->spin == 0; }
static int rests(const body *b) { return held(b) && b->slip == 0; }

/* The friction that makes v' = w' while it rolls: pull - F = (F - T)/beta. */
static quad grip_of(const body *b, quad pull) {
  return (pull + b->spin * b->resists / b->beta) / (1 + 1 / b->beta);
}

static void slope(const void *system, quad t, const quad y[4], quad f[4]) {
  const body *b = system;
  const quad pull = pull_at(b, t, y[2]);
  f[0] = y[2];
  f[1] = y[3];
  if (rests(b)) {
    f[2] = f[3] = 0;
  } else if (b->slip == 0) {
    f[2] = f[3] = pull - grip_of(b, pull);
  } else {
    f[2] = pull - b->slip * b->slides;
    f[3] = held(b) ? 0 : (b->slip * b->slides - b->spin * b->resists) / b->beta;
  }
}

/* Its error, of numbers below 1 absolute. */
static double step(const body *b, quad h, quad out[4]) {
  static const midpoint rule = {slope, 4, 11, 1e-30};
  static const quad size[4] = {1, 1, 1, 1};
  return midpoint_step(&rule, b, b->t, h, b->y, size, out);
}

/* Whether the state is no longer one of the stretch. */
static int is_over(const body *b, quad t, const quad y[4]) {
  const quad pull = pull_at(b, t, y[2]);
  if (rests(b)) return fabsq(pull) > b->resists || fabsq(pull) > b->grips;
  if (b->s->scene.drag_n_s2_per_m2 != 0.0 && b->way * y[2] < 0) return 1;
  if (b->slip != 0 && b->slip * (y[2] - y[3]) <= 0) return 1;
  if (b->resists > 0 && b->spin != 0 && b->spin * y[3] <= 0) return 1;
  return b->slip == 0 && fabsq(grip_of(b, pull)) > b->grips;
}

/* How far what sticks is from slipping, where nothing moves against another. */
static quad margin(const body *b, quad t, const quad y[4]) {
  const quad pull = pull_at(b, t, y[2]);
  if (rests(b)) return fminq(b->resists, b->grips) - fabsq(pull);
  return b->slip == 0 ? b->grips - fabsq(grip_of(b, pull)) : INFINITY;
}

/* A force of time may break the grip within a step and let it hold again before the end. *d becomes
 * a step to where it is broken, found at the least of the margin; 0: there is none. */
static int dips(const body *b, quad *d) {
  enum { PARTS = 4 };
  quad v[PARTS + 1], next[4];
  int least = 0;
  for (int i = 0; i <= PARTS; i++) {
    step(b, *d * i / PARTS, next);
    v[i] = margin(b, b->t + *d * i / PARTS, i ? next : b->y);
    if (v[i] < v[least]) least = i;
  }
  if (!(least > 0 && least < PARTS)) return 0;
  quad lo = *d * (least - 1) / PARTS, hi = *d * (least + 1) / PARTS;
  for (int i = 0; i < 80; i++) { /* golden section */
    const quad a = hi - 0.618033988749895Q * (hi - lo), c = lo + 0.618033988749895Q * (hi - lo);
    step(b, a, next);
    const quad at_a = margin(b, b->t + a, next);
    step(b, c, next);
    const quad at_c = margin(b, b->t + c, next);
    if (fminq(at_a, at_c) < 0) {
      *d = at_a < 0 ? a : c;
      return 1;
    }
    if (at_a < at_c) {
      hi = c;
    } else {
      lo = a;
    }
    /* Far above zero the parabola through the least is enough. */
    if (fminq(at_a, at_c) > 0.5Q * fminq(v[0], v[PARTS]) && i > 3) return 0;
  }
  return 0;
}

/* The law that fits the state. Speeds that are zero here are zero exactly. */
static void choose(body *b) {
  b->way = sign(b->y[2]);
  quad pull = pull_at(b, b->t, b->y[2]);
  b->slip = sign(b->y[2] - b->y[3]);
  b->spin = b->resists > 0 ? sign(b->y[3]) : 0;
  if (b->slip == 0) {
    if (b->resists > 0 && b->spin == 0) {
      if (fabsq(pull) <= b->resists && fabsq(pull) <= b->grips) {
        if (b->way == 0) b->way = 1;
        return;
      }
      if (fabsq(pull) > b->resists) b->spin = sign(pull);
    }
    const quad grip = grip_of(b, pull);
    const int stays = b->resists > 0 && b->spin == 0; /* held, it can only slide */
    if (stays || fabsq(grip) > b->grips) b->slip = stays ? sign(pull) : sign(grip);
    if (b->slip != 0 && b->y[3] == 0 && b->resists > 0) {
      b->spin = b->slides > b->resists ? b->slip : 0;
    }
  } else if (b->spin == 0 && b->resists > 0 && b->slides > b->resists) {
    b->spin = b->slip;
  }
  if (b->way == 0) {
    quad f[4];
    slope(b, b->t, b->y, f);
    b->way = f[2] < 0 ? -1 : 1;
  }
}

/* What the event sets to zero exactly. */
static void settle(body *b) {
  const quad size = fabsq(b->y[2]) + fabsq(b->y[3]) + 1e-3Q;
  if (b->slip != 0 && b->slip * (b->y[2] - b->y[3]) <= 0) {
    b->y[2] = b->y[3] = (b->y[2] + b->beta * b->y[3]) / (1 + b->beta);
  }
  for (int i = 2; i < 4; i++) {
    if (fabsq(b->y[i]) < 1e-25Q * size) b->y[i] = 0;
  }
  if (b->slip == 0) b->y[2] = b->y[3];
}

static void note(body *b, const quad y[4]) {
  const rot_incline_params *p = &b->s->scene.slope;
  const quad r = p->radius_m;
  const quad now[] = {(quad)p->x0_m + y[0], y[2], (quad)p->theta0_rad + y[1] / r, y[3] / r};
  for (int k = 0; k < 4; k++) b->most[k] = fmax(b->most[k], fabs((double)now[k]));
}

/* Where the body turns round within a step, it is farthest. */
static void note_turns(body *b, quad d, const quad next[4]) {
  for (int i = 2; i < 4; i++) {
    if (b->y[i] * next[i] >= 0) continue;
    quad lo = 0, hi = d, at[4];
    for (int k = 0; k < 40; k++) {
      const quad mid = (lo + hi) / 2;
      step(b, mid, at);
      if (b->y[i] * at[i] > 0) {
        lo = mid;
      } else {
        hi = mid;
      }
    }
    note(b, at);
  }
}

/* The next zero of the wave; *half: its sign until then. */
static quad half_period(const wave *w, quad t, int *half) {
  const quad turns = floorq(w->rate * t / M_PIq + 1e-25Q);
  *half = fmodq(turns, 2) == 0 ? 1 : -1;
  return (turns + 1) * M_PIq / w->rate;
}

static int walk(body *b, quad target, quad most) {
  const wave *w = &b->s->wave;
  const int broken = b->s->scene.force && w->form != SINE;
  long budget = 20000, events = 300;
  quad h = most;
  while (b->t < target) {
    if (--budget == 0) return 1;
    int half = b->half;
    const quad zero = broken ? half_period(w, b->t, &half) : INFINITY;
    if (half != b->half) {
      b->half = half;
      choose(b);
    }
    const quad stop = fminq(target, zero);
    const int last = h >= stop - b->t;
    const quad d = last ? stop - b->t : h;
    quad next[4];
    if (!(step(b, d, next) < 1e-26)) {
      h = d / 2;
      continue;
    }
    quad hi = d;
    const int broken_within = b->s->scene.force && !is_over(b, b->t + d, next) && dips(b, &hi);
    if (broken_within || is_over(b, b->t + d, next)) {
      if (--events == 0) return 1;
      quad lo = 0;
      for (int i = 0; i < 112; i++) {
        const quad mid = (lo + hi) / 2;
        step(b, mid, next);
        if (is_over(b, b->t + mid, next)) {
          hi = mid;
        } else {
          lo = mid;
        }
      }
      step(b, hi, next);
      note_turns(b, hi, next);
      memcpy(b->y, next, sizeof next);
      b->t += hi;
      settle(b);
      choose(b);
      note(b, b->y);
      continue;
    }
    note_turns(b, d, next);
    memcpy(b->y, next, sizeof next);
    b->t = last ? stop : b->t + d;
    note(b, b->y);
    if (h < most) h *= 1.5Q;
  }
  return 0;
}

/* Rows of x, v, theta, omega; the largest of each until then. 0, or 1 without an answer. */
static int truth(const sample *s, quad rows[ROWS][4], double most[ROWS][4]) {
  const rot_incline_params *p = &s->scene.slope;
  const quad angle = (quad)p->angle_deg * M_PIq / 180, r = p->radius_m;
  const quad normal = (quad)p->gravity_m_per_s2 * cosq(angle);
  body b;
  memset(&b, 0, sizeof b);
  b.s = s;
  b.beta = (quad)p->inertia_kg_m2 / (quad)p->mass_kg / r / r;
  b.gravity = (quad)p->gravity_m_per_s2 * sinq(angle);
  b.grips = (quad)p->mu_static * normal;
  b.slides = (quad)p->mu_kinetic * normal;
  b.resists = (quad)p->arm_m / r * normal;
  b.t = p->start_s;
  b.y[2] = p->v0_m_per_s;
  b.y[3] = r * (quad)p->omega0_rad_per_s;
  /* A start within its rounding rolls. */
  if (fabsq(b.y[2] - b.y[3]) <= 4 * 0x1p-53Q * fabsq(b.y[3])) b.y[3] = b.y[2];
  if (s->scene.force) (void)half_period(&s->wave, b.t, &b.half);
  choose(&b);
  note(&b, b.y);
  const quad span = (quad)s->rows_s[ROWS - 1] - (quad)p->start_s;
  for (int i = 0; i < ROWS; i++) {
    if (walk(&b, s->rows_s[i], span / 32)) return 1;
    const quad row[] = {(quad)p->x0_m + b.y[0], b.y[2], (quad)p->theta0_rad + b.y[1] / r,
                        b.y[3] / r};
    for (int k = 0; k < 4; k++) {
      rows[i][k] = row[k];
      most[i][k] = b.most[k];
    }
  }
  return 0;
}

/* ---- the models ------------------------------------------------------------------------------ */

/* Rows of x, v, theta, omega, and the bounds or estimates of their errors, a row each. */
typedef struct answer {
  double c[4][ROWS], error[4][ROWS];
} answer;

static rot_status spread(const rot_info *info, answer *to, rot_status status) {
  for (int k = 0; k < 4; k++) {
    for (int i = 0; i < ROWS; i++) to->error[k][i] = info->measure[k].error;
  }
  return status;
}

static rot_status run_exact(const sample *s, answer *to) {
  double c[7][ROWS];
  int rolling[ROWS];
  const rot_incline_columns out = {to->c[0], to->c[1], to->c[2], to->c[3], c[0], c[1],
                                   c[2],     c[3],     c[4],     c[5],     c[6], rolling};
  rot_info info;
  const rot_status status =
      rot_incline_run(&s->scene.slope, ROWS, s->rows_s, &out, NULL, NULL, NULL, &info);
  return spread(&info, to, status);
}

static rot_status integrate(const sample *s, rot_method method, answer *to) {
  double c[7][ROWS], sum[8][ROWS];
  int rolling[ROWS];
  const rot_incline_columns out = {to->c[0], to->c[1], to->c[2], to->c[3], c[0], c[1],
                                   c[2],     c[3],     c[4],     c[5],     c[6], rolling};
  rot_incline_sums sums = {sum[0], sum[1], sum[2], sum[3], sum[4], sum[5],
                           sum[6], sum[7], {0.0}};
  const rot_incline_ode_options options = {s->accuracy, 1000000, method, 0.0};
  rot_info info;
  const rot_status status = rot_incline_integrate(&s->scene, &options, ROWS, s->rows_s, &out, &sums,
                                                  NULL, NULL, NULL, &info);
  return spread(&info, to, status);
}

static rot_status run_rk8pd(const sample *s, answer *to) {
  return integrate(s, ROT_METHOD_RK8PD, to);
}

static rot_status run_radau(const sample *s, answer *to) {
  return integrate(s, ROT_METHOD_RADAU, to);
}

/* Each row of the table is a scene; its errors are relative. */
static rot_status run_table(const sample *s, answer *to) {
  const rot_incline_params *p = &s->scene.slope;
  double heat[3][ROWS], error[ROWS];
  int rolling[ROWS], status[ROWS];
  const double beta = p->inertia_kg_m2 / p->mass_kg / p->radius_m / p->radius_m;
#define ONE(x)                                                                                     \
  { &(x), 0 }
  const rot_incline_rows rows = {ROWS,
                                 ONE(beta),
                                 ONE(p->radius_m),
                                 ONE(p->mass_kg),
                                 ONE(p->angle_deg),
                                 ONE(p->gravity_m_per_s2),
                                 ONE(p->mu_static),
                                 ONE(p->mu_kinetic),
                                 ONE(p->arm_m),
                                 ONE(p->v0_m_per_s),
                                 ONE(p->omega0_rad_per_s),
                                 {s->rows_s, 1}};
  const rot_incline_table_columns out = {to->c[0], to->c[1], to->c[2], to->c[3], heat[0], heat[1],
                                         heat[2],  rolling,  error,    status,   NAN};
  rot_info info;
  rot_incline_table(&rows, 1, &out, NULL, &info);
  for (int i = 0; i < ROWS; i++) {
    if (status[i] != ROT_OK) return (rot_status)status[i];
    for (int k = 0; k < 4; k++) {
      to->error[k][i] = error[i] + 1e-15; /* beta is rounded here */
    }
  }
  return ROT_OK;
}

static const struct {
  const char *name;
  void (*make)(sample *);
  rot_status (*run)(const sample *, answer *);
  double least; /* share to be covered */
  int relative; /* its errors are */
} contestants[] = {{"incline_exact", constant_scene, run_exact, 1.0, 0},
                   {"incline_table", table_scene, run_table, 1.0, 1},
                   {"incline_rk8pd", forced_scene, run_rk8pd, 0.95, 0},
                   {"incline_radau", forced_scene, run_radau, 0.95, 0}};

static double median(size_t n, double x[]) {
  if (n == 0) return NAN;
  qsort(x, n, sizeof *x, by_size);
  return x[n / 2];
}

int main(int argc, char **argv) {
  const long scenes = argc > 1 ? atol(argv[1]) : 1000;
  const uint64_t seed = argc > 2 ? (uint64_t)atoll(argv[2]) : 20;
  const char *only = argc > 3 ? argv[3] : NULL;
  double *ratio = malloc((size_t)scenes * sizeof *ratio);
  double *error = malloc((size_t)scenes * sizeof *error);
  long silent = 0; /* beyond ten times the figure and what was asked */
  int bad = 0;
  printf("| model | scenes | covered | true error, median | true error, worst | reported / true, "
         "median |\n|---|---|---|---|---|---|\n");
  for (size_t k = 0; k < sizeof contestants / sizeof *contestants; k++) {
    if (only && strcmp(only, contestants[k].name)) continue;
    long judged = 0, covered = 0;
    size_t ratios = 0, errors = 0;
    double worst = 0.0;
    state = seed * 0x9E3779B97F4A7C15u + 1;
    for (long i = 0; i < scenes; i++) {
      static sample s;
      answer got;
      quad rows[ROWS][4];
      double most[ROWS][4], off = 0.0, said = 0.0;
      contestants[k].make(&s);
      const rot_status status = contestants[k].run(&s, &got);
      if (truth(&s, rows, most)) {
        fprintf(stderr, "%s %ld: no truth\n", contestants[k].name, i);
        continue;
      }
      judged++;
      if (status != ROT_OK) {
        fprintf(stderr, "%s %ld: %s\n", contestants[k].name, i, rot_status_text(status));
        continue;
      }
      int held_all = 1;
      for (int m = 0; m < 4; m++) {
        for (int j = 0; j < ROWS; j++) {
          const double e = (double)fabsq((quad)got.c[m][j] - rows[j][m]);
          const double size = most[ROWS - 1][m];
          if (contestants[k].relative) got.error[m][j] *= most[j][m];
          const int here = e <= got.error[m][j] + 1e-24 * (size + 1e-3);
          if (!here && getenv("COVERAGE_SHOW")) {
            fprintf(stderr, "%s %ld: measure %d off by %.3g of %.3g (largest %.3g, row %d)\n",
                    contestants[k].name, i, m, e, got.error[m][j], size, j);
          }
          held_all = held_all && here;
          if (size > 1e-200) off = fmax(off, e / size);
          if (size > 1e-200) said = fmax(said, got.error[m][j] / size);
        }
      }
      covered += held_all;
      if (!held_all && off > 10.0 * fmax(said, s.accuracy)) {
        silent++;
        fprintf(stderr, "%s %ld: silent\n", contestants[k].name, i);
      }
      worst = fmax(worst, off);
      error[errors++] = off;
      if (off > 0.0) ratio[ratios++] = said / off;
    }
    printf("| `%s` | %ld | %.1f %% | %.1e | %.1e | %.3g |\n", contestants[k].name, judged,
           judged ? 100.0 * (double)covered / (double)judged : 0.0, median(errors, error), worst,
           median(ratios, ratio));
    fflush(stdout);
    if ((double)covered < contestants[k].least * (double)judged) bad = 1;
  }
  printf("inclines: %ld silent\n", silent);
  free(ratio);
  free(error);
  return bad || silent > 0;
}
