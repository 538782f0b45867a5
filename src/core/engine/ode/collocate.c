#include "engine/ode/collocate.h"

#include <gsl/gsl_integration.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "ground/real.h"

enum {
  FIRST_NODES = 8, /* of a step in the first sweep */
  MAX_NODES = 20,
  MAX_SWEEPS = 5,
  MAX_AGAIN = 3,
  NEAR = 6,        /* nodes of an interpolated derivative */
  NEAR_BEYOND = 4, /* of an extrapolated one */
  MAX_TURNS = 60,  /* of the iteration for the linear equations */
  MAX = ROT_ODE_MAX_COLLOCATED,
  MAX_DIM = ROT_ODE_MAX_COLLOCATED_ALL
};

/* ---- Gauss's nodes and Legendre's polynomials ------------------------------------------------ */

typedef struct rule {
  size_t s;                           /* 0: not made yet */
  double x[MAX_NODES];                /* in (-1, 1) */
  double into[MAX_NODES * MAX_NODES]; /* values at the nodes -> integrals from -1 to each */
  double part[MAX_NODES * MAX_NODES]; /* the same -> coefficients of the polynomials */
} rule;

/* P_0 to P_m. */
static void legendre(double x, size_t m, double p[]) {
  p[0] = 1.0;
  p[1] = x;
  for (size_t k = 1; k < m; k++) {
    const double n = (double)k;
    p[k + 1] = ((2.0 * n + 1.0) * x * p[k] - n * p[k - 1]) / (n + 1.0);
  }
}

/* The integral of P_m from -1 to x, with P_0 .. P_{m+1} there. */
static double legendre_integral(const double p[], size_t m) {
  return m == 0 ? p[1] + 1.0 : (p[m + 1] - p[m - 1]) / (2.0 * (double)m + 1.0);
}

static rot_status make_rule(rule *r, size_t s) {
  double p[MAX_NODES + 1], weight;
  if (r->s == s) return ROT_OK;
  gsl_integration_glfixed_table *table = gsl_integration_glfixed_table_alloc(s);
  if (!table) return ROT_ENOMEM;
  r->s = s;
  for (size_t j = 0; j < s; j++) {
    gsl_integration_glfixed_point(-1.0, 1.0, j, &r->x[j], &weight, table);
    legendre(r->x[j], s, p);
    for (size_t m = 0; m < s; m++) r->part[m * s + j] = ((double)m + 0.5) * weight * p[m];
  }
  gsl_integration_glfixed_table_free(table);
  for (size_t i = 0; i < s; i++) {
    legendre(r->x[i], s, p);
    for (size_t j = 0; j < s; j++) {
      double sum = 0.0;
      for (size_t m = 0; m < s; m++) sum += legendre_integral(p, m) * r->part[m * s + j];
      r->into[i * s + j] = sum;
    }
  }
  return ROT_OK;
}

/* Ends of steps so near to a surface, of their size, are on it; nodes so far beyond it belong
 * to a step that passes it. */
#define ON_SURFACE 1e-11
#define BEYOND     1e-4

/* ---- the solution of a sweep ----------------------------------------------------------------- */

/* A step: the state where it begins and ends, the slope as a sum of polynomials. */
typedef struct step {
  double t, end;
  double from, h; /* of the polynomials: the same, before its ends moved with a surface */
  size_t surface; /* the component whose surface it ends on, or NO_SURFACE */
  double level;   /* of that surface */
  double low[MAX], high[MAX]; /* the surfaces beside it: where the slope is called */
  size_t s;                   /* of its nodes; 0: not solved yet */
  unsigned long swept;        /* the numbers of nodes of all sweeps, as bits */
  double *y;                  /* dim, and dim at the end */
  double *c;                  /* s x dim */
  size_t first, node, last; /* of the trajectory: the segment from first to last, the step's own */
  int bent[2];              /* a kink in time is its start, its end */
  double off[2];            /* what a kink beside its start, its end may change, of the size */
  double moved;             /* its end by the last sweep, of the size, apart from its start */
} step;

/* All of one run on one side. */
typedef struct side {
  const rot_ode_params *p;
  const rot_ode_trajectory *trajectory;
  const rot_ode_surfaces *surfaces;
  const rot_hooks *hooks;
  rot_info *info;
  rule *rules;
  size_t n_steps;
  step *steps;
  double *data;             /* of the steps, and dim */
  double *size;             /* of each component, and of its slope */
  double wanted;            /* what the polynomials may leave out, of the size */
  size_t slope_of;          /* a component whose slope is to be as good; dim: none */
  double *difference;       /* of each component: between two sweeps */
  double *left_out;         /* of each component: by the polynomials */
  double moved, moved_fell; /* of all steps, summed; each times what it fell by */
  double missed;            /* by the nodes, of the size, a sum of squares */
} side;

/* What one sweep does with a step: states, corrections, slopes and their derivatives at the
 * nodes. */
typedef struct stages {
  const rule *r;
  size_t dim, n;
  double h;
  double y[MAX_NODES * MAX], e[MAX_NODES * MAX], rest[MAX_NODES * MAX];
  double d[MAX_NODES * MAX_DIM * MAX], f[MAX_NODES * MAX_DIM];
} stages;

/* P_0 .. P_s at t. */
static void legendre_at(const step *st, double t, double p[]) {
  const double x = ((t - st->from) + (t - (st->from + st->h))) / st->h;
  legendre(t == st->end && st->end == st->from + st->h ? 1.0 : x, st->s, p);
}

static double legendre_state(const step *st, const double p[], size_t dim, size_t k) {
  double sum = 0.0;
  for (size_t m = st->s; m-- > 0;) sum += legendre_integral(p, m) * st->c[m * dim + k];
  return st->y[k] + 0.5 * st->h * sum;
}

static double legendre_slope(const step *st, const double p[], size_t dim, size_t k) {
  double sum = 0.0;
  for (size_t m = st->s; m-- > 0;) sum += p[m] * st->c[m * dim + k];
  return sum;
}

/* The first n components of the state at t. */
static void legendre_states(const step *st, double t, size_t dim, size_t n, double y[]) {
  double p[MAX_NODES + 1];
  legendre_at(st, t, p);
  for (size_t k = 0; k < n; k++) y[k] = legendre_state(st, p, dim, k);
}

/* The larger of two neighbouring coefficients, the last of them m: one of them may vanish. */
static double pair(const step *st, size_t dim, size_t k, size_t m) {
  return fmax(fabs(st->c[m * dim + k]), fabs(st->c[(m - 1) * dim + k]));
}

/* The last pair, of the one before. */
static double flatness(const step *st, size_t dim, size_t k) {
  const double last = pair(st, dim, k, st->s - 1), before = pair(st, dim, k, st->s - 3);
  return before > 0.0 ? fmin(1.0, last / before) : 0.0;
}

/* What polynomials leave out of a slope: their last pair of terms, times twice what it is of the
 * pair before. *fall: by what two terms more lessen it, from the pair before that. */
static double tail(const step *st, size_t dim, size_t k, double *fall) {
  const double last = pair(st, dim, k, st->s - 1), first = pair(st, dim, k, st->s - 5);
  *fall = first > 0.0 ? fmin(1.0, sqrt(last / first)) : 0.0;
  return last * fmin(1.0, 2.0 * fmax(*fall, flatness(st, dim, k)));
}

/* What it may be of component k in this step. */
static double allowed(const side *w, const step *st, size_t k) {
  const size_t dim = w->p->dim;
  double max = INFINITY;
  if (k < w->p->controlled) max = w->wanted * w->size[k] * (double)st->s / fabs(st->h);
  if (k == w->slope_of) max = fmin(max, w->wanted * w->size[dim + k]);
  return fmax(max, 16.0 * ROT_EPS * w->size[dim + k]);
}

/* A slope falls slower towards its last terms where it has a kink. */
#define SMOOTH_FALL 0.5

/* Nodes for the next sweep; more than MOST_NODES: too many. */
static size_t nodes_wanted(const side *w, const step *st) {
  double more = 0.0;
  for (size_t k = 0; k < w->p->dim; k++) {
    double fall;
    const double out = tail(st, w->p->dim, k, &fall), may = allowed(w, st, k);
    if (!(out > may)) continue;
    if (!(fall < SMOOTH_FALL)) return MAX_NODES + 1;
    more = fmax(more, 2.0 * ceil(log(may / out) / log(fall)));
  }
  return st->s + (size_t)fmin(more, MAX_NODES);
}

/* The derivative of the slopes by the state, at t: Lagrange's polynomial through the nearest nodes
 * of the segment where it is known. */
static void derivative_at(const side *w, const step *st, double t, double d[]) {
  const rot_dense *nodes = &w->trajectory->nodes;
  const size_t each = nodes->dim * w->trajectory->controlled;
  const size_t first =
      isnan(w->trajectory->derivative[st->first * each]) ? st->first + 1 : st->first;
  const size_t max = st->node < first ? NEAR_BEYOND : NEAR; /* of low degree outside of them */
  size_t low = st->node < first ? first : st->node, high = st->node + 1;
  while (high - low + 1 < max && (low > first || high < st->last)) {
    if (low > first) low--;
    if (high < st->last && high - low + 1 < max) high++;
  }
  memset(d, 0, each * sizeof *d);
  for (size_t i = low; i <= high; i++) {
    double weight = 1.0;
    for (size_t j = low; j <= high; j++) {
      const double at = rot_dense_node(nodes, j)[0];
      if (j != i) weight *= (t - at) / (rot_dense_node(nodes, i)[0] - at);
    }
    for (size_t k = 0; k < each; k++) d[k] += weight * w->trajectory->derivative[i * each + k];
  }
}

/* to = from changed by J e at a node. */
static void add_change(const stages *g, size_t j, const double e[], size_t dim, double to[]) {
  const double *d = g->d + j * g->dim * g->n;
  for (size_t k = 0; k < dim; k++) {
    for (size_t i = 0; i < g->n; i++) to[k] += d[k * g->n + i] * e[j * g->n + i];
  }
}

/* e = rest + integral of J e, by iteration: its terms fall as those of an exponential. */
static int solve(stages *g) {
  double turn[MAX_NODES * MAX], now[MAX_NODES * MAX];
  const size_t s = g->r->s, n = g->n;
  memcpy(now, g->rest, s * n * sizeof *now);
  memcpy(g->e, g->rest, s * n * sizeof *now);
  for (int turns = 0; turns < MAX_TURNS; turns++) {
    double change = 0.0, max = 0.0;
    memset(turn, 0, s * n * sizeof *turn);
    for (size_t j = 0; j < s; j++) add_change(g, j, now, n, turn + j * n);
    for (size_t j = 0; j < s; j++) {
      for (size_t k = 0; k < n; k++) {
        double sum = 0.0;
        for (size_t i = 0; i < s; i++) sum += g->r->into[j * s + i] * turn[i * n + k];
        now[j * n + k] = 0.5 * g->h * sum;
        g->e[j * n + k] += now[j * n + k];
        if (!isfinite(now[j * n + k])) return 0; /* also where no derivative is known */
        change = fmax(change, fabs(now[j * n + k]));
        max = fmax(max, fabs(g->e[j * n + k]));
      }
    }
    if (change <= 1e-8 * max) return 1;
  }
  return 0;
}

/* State of the sweep before, or of the run, at a time of the step. */
static void state_at(const step *st, const rot_dense_form form[], size_t dim, size_t n, double t,
                     double y[]) {
  if (st->s) legendre_states(st, t, dim, n, y);
  for (size_t k = 0; k < n && !st->s; k++) y[k] = rot_dense_at(&form[k], t, NULL, NULL, NULL);
}

/* The sweep before at the nodes, moved by what the start has changed; end[]: by what that moves the
 * end. */
static int predict(const side *w, const step *st, const double start[], stages *g, double end[]) {
  const size_t n = g->n, s = g->r->s;
  double old[MAX];
  rot_dense_form form[MAX];
  rot_dense segment = w->trajectory->nodes;
  segment.data += st->first * (1 + 2 * g->dim);
  segment.count = st->last - st->first + 1;
  for (size_t k = 0; k < n && st->s == 0; k++) {
    form[k] = rot_dense_between(&segment, st->node - st->first, k);
  }
  state_at(st, form, g->dim, n, st->t, old);
  for (size_t k = 0; k < n; k++) end[k] = start[k] - old[k];
  for (size_t j = 0; j < s; j++) {
    const double t = st->t + 0.5 * g->h * (1.0 + g->r->x[j]);
    state_at(st, form, g->dim, n, t, g->y + j * n);
    memcpy(g->rest + j * n, end, n * sizeof *end);
    derivative_at(w, st, t, g->d + j * g->dim * n);
  }
  if (!solve(g)) return 0;
  for (size_t j = 0; j < s; j++) {
    double rise[MAX] = {0.0};
    add_change(g, j, g->e, n, rise);
    for (size_t k = 0; k < n; k++) {
      g->y[j * n + k] += g->e[j * n + k];
      end[k] += g->h * g->r->part[j] * rise[k];
    }
  }
  return 1;
}

/* The law strictly inside the step, which may end at breaks, and on its sides of the surfaces. */
static rot_status slope_in(const side *w, const step *st, double t, const double y[],
                           double dydt[]) {
  const double after = nextafter(st->t, st->end), before = nextafter(st->end, st->t);
  double x[MAX_DIM];
  memcpy(x, y, w->p->dim * sizeof *y);
  for (size_t k = 0; k < w->p->controlled; k++) x[k] = fmin(fmax(y[k], st->low[k]), st->high[k]);
  t = st->end > st->t ? fmin(fmax(t, after), before) : fmax(fmin(t, after), before);
  w->info->rhs_calls++;
  rot_status status = w->p->rhs(t, x, dydt, w->p->ctx);
  for (size_t k = 0; k < w->p->controlled && status == ROT_OK; k++) {
    if (!isfinite(dydt[k])) status = ROT_ERHS;
  }
  return status;
}

/* The slopes at the nodes. *good = 0: not defined there. */
static rot_status call(const side *w, const step *st, const double start[], stages *g, int *good) {
  double y[MAX_DIM];
  memcpy(y, start, g->dim * sizeof *y);
  *good = 0;
  for (size_t j = 0; j < g->r->s; j++) {
    for (size_t k = 0; k < g->n; k++) {
      const double x = y[k] = g->y[j * g->n + k];
      if (fabs(fmin(fmax(x, st->low[k]), st->high[k]) - x) > BEYOND * w->size[k]) return ROT_OK;
    }
    const double t = st->t + 0.5 * g->h * (1.0 + g->r->x[j]);
    const rot_status status = slope_in(w, st, t, y, g->f + j * g->dim);
    if (status != ROT_OK) return status == ROT_ERHS ? ROT_OK : status;
  }
  *good = 1;
  return ROT_OK;
}

/* The slopes where the equations of collocation hold, linear about those of the calls. */
static int correct(const double start[], stages *g) {
  const size_t n = g->n, s = g->r->s;
  for (size_t j = 0; j < s; j++) {
    for (size_t k = 0; k < n; k++) {
      double sum = 0.0;
      for (size_t i = 0; i < s; i++) sum += g->r->into[j * s + i] * g->f[i * g->dim + k];
      g->rest[j * n + k] = (start[k] - g->y[j * n + k]) + 0.5 * g->h * sum;
    }
  }
  if (!solve(g)) return 0;
  for (size_t j = 0; j < s; j++) add_change(g, j, g->e, g->dim, g->f + j * g->dim);
  return 1;
}

/* The result of a step, and by what it moved. end[]: see predict(). */
static void keep(side *w, step *st, const double start[], const stages *g, const double end[]) {
  const size_t dim = g->dim, s = g->r->s;
  st->s = s;
  st->swept |= 1UL << s;
  st->from = st->t;
  st->h = g->h;
  st->moved = 0.0;
  memcpy(st->y, start, dim * sizeof *start);
  memset(st->c, 0, s * dim * sizeof *st->c);
  for (size_t m = 0; m < s; m++) {
    for (size_t j = 0; j < s; j++) {
      for (size_t k = 0; k < dim; k++) {
        st->c[m * dim + k] += g->r->part[m * s + j] * g->f[j * dim + k];
      }
    }
  }
  for (size_t k = 0; k < dim; k++) {
    const double now = start[k] + st->h * st->c[k], change = now - st->y[dim + k];
    w->difference[k] = fmax(w->difference[k], fabs(change));
    w->size[k] = fmax(w->size[k], fabs(now));
    if (k < g->n) st->moved = fmax(st->moved, fabs(change - end[k]) / w->size[k]);
    st->y[dim + k] = now;
  }
}

/* The end of a step on a surface, where the polynomial meets it. 0: not near. */
static int meet_surface(step *st, size_t dim) {
  const size_t k = st->surface;
  double polynomial[MAX_NODES + 1], t = st->end;
  for (int turn = 0; turn < 4; turn++) {
    legendre_at(st, t, polynomial);
    const double slope = legendre_slope(st, polynomial, dim, k);
    t += (st->level - legendre_state(st, polynomial, dim, k)) / slope;
    if (!(fabs(t - st->end) < 0.02 * fabs(st->h))) return 0;
  }
  legendre_states(st, t, dim, dim, st->y + dim);
  st->y[dim + k] = st->level;
  st->end = t;
  return 1;
}

/* A kink between two nodes shows in the last terms, which do not fall: the integral over the step
 * is then no better than they are. One between an end and the node next to it shows in the slope
 * there, which the run knows. */
static void look_between(side *w, step *st, stages *g) {
  const size_t dim = g->dim, n = g->n;
  const double gap = 0.5 * fabs(st->h) * (1.0 - fabs(g->r->x[0]));
  double polynomial[MAX_NODES + 1], max = 0.0, fall;
  for (size_t end = 0; end < 2; end++) {
    const double *node = rot_dense_node(&w->trajectory->nodes, st->node + end);
    double slope[MAX] = {0.0}, change[MAX];
    st->off[end] = 0.0;
    if (st->bent[end]) continue;
    legendre_at(st, node[0], polynomial);
    for (size_t k = 0; k < n; k++) {
      change[k] = legendre_state(st, polynomial, dim, k) - node[1 + k];
    }
    derivative_at(w, st, node[0], g->d);
    add_change(g, 0, change, n, slope);
    for (size_t k = 0; k < n; k++) {
      const double off = node[1 + dim + k] + slope[k] - legendre_slope(st, polynomial, dim, k);
      st->off[end] = fmax(st->off[end], gap * fabs(off) / w->size[k]);
    }
    max = fmax(max, st->off[end]);
  }
  for (size_t k = 0; k < dim; k++) {
    const double out = fabs(st->h) * tail(st, dim, k, &fall);
    if (k < n) max = fmax(max, out * flatness(st, dim, k) / w->size[k]);
    w->left_out[k] = fmax(w->left_out[k], out / (double)st->s);
  }
  w->missed += max * max;
}

/* A kink in time beside the nodes: where the slopes of the step before and of this one meet, which
 * becomes the end of the one and the start of the other. *off: what it changes, of the size. 0:
 * they do not meet near. */
static int meet_step(const side *w, step *st, double *off) {
  const size_t dim = w->p->dim;
  const double near = 0.05 * fmin(fabs(st->h), fabs(st[-1].h)), d = 1e-3 * near;
  double min = INFINITY, at = st->t;
  *off = 0.0;
  for (size_t k = 0; k < w->p->controlled; k++) {
    double difference[2];
    for (int later = 0; later < 2; later++) {
      double before[MAX_NODES + 1], after[MAX_NODES + 1];
      legendre_at(st - 1, st->t + later * d, before);
      legendre_at(st, st->t + later * d, after);
      difference[later] =
          legendre_slope(st - 1, before, dim, k) - legendre_slope(st, after, dim, k);
    }
    const double by = difference[0] * d / (difference[0] - difference[1]),
                 size = fabs(difference[0]) / w->size[k];
    if (!(fabs(by) <= near) || size * fabs(by) <= *off) continue;
    *off = size * fabs(by);
    min = fabs(by);
    at = st->t + by;
  }
  if (!(min <= near)) return 0;
  st[-1].end = st->t = at;
  legendre_states(st - 1, at, dim, dim, st[-1].y + dim);
  return 1;
}

/* What a kink beside the nodes may change, of the accuracy: less in the first sweep may be the
 * error of the states. */
#define BESIDE 30.0

/* Kinks beside the end of the step before and the start of this one; 0: they cannot be met. */
static int meet_kinks(side *w, step *st, int first, int last) {
  const double max = BESIDE * w->p->accuracy;
  const int alone = first || st[-1].first != st->first;
  double off;
  if (last && st->off[1] > max) return 0;
  if (alone) return st->off[0] <= max;
  if (!st->bent[0] && fmax(st[-1].off[1], st->off[0]) <= max) return 1;
  if (!meet_step(w, st, &off)) return st->bent[0];
  if (st->bent[0]) w->missed += off * off;
  st->bent[0] = st[-1].bent[1] = 1;
  return 1;
}

/* One sweep over one step. *good = 0: not solved. */
static rot_status solve_step(side *w, step *st, const double start[], stages *g, int *good) {
  const size_t wanted = st->s ? nodes_wanted(w, st) : FIRST_NODES;
  const size_t other = st->s < MAX_NODES ? st->s + 1 : st->s - 1;
  const size_t s = wanted > st->s ? wanted : other;
  double end[MAX];
  *good = 0;
  if (s > MAX_NODES) return ROT_OK;
  rot_status status = make_rule(&w->rules[s], s);
  if (status != ROT_OK) return status;
  g->r = &w->rules[s];
  g->h = st->end - st->t;
  if (!predict(w, st, start, g, end)) return ROT_OK;
  status = call(w, st, start, g, good);
  if (status != ROT_OK || !*good) return status;
  *good = correct(start, g);
  if (*good) keep(w, st, start, g, end);
  return ROT_OK;
}

/* What one step may leave to further sweeps, of the accuracy: more is solved at once, mostly in the
 * first steps of a segment, where states and derivatives are interpolated from one side alone. */
#define MAX_LEFT 0.03

/* One sweep over all steps. */
static rot_status sweep(side *w, int *good) {
  const double max = MAX_LEFT * w->p->accuracy;
  const double *start = w->p->start;
  stages g;
  g.dim = w->p->dim;
  g.n = w->p->controlled;
  *good = 1;
  for (size_t i = 0; i < w->n_steps; i++) {
    step *st = &w->steps[i];
    double fell = 1.0;
    rot_status status = i % 4 ? ROT_OK : rot_poll(w->hooks, (double)i / (double)w->n_steps);
    for (int again = 0; again < MAX_AGAIN && status == ROT_OK; again++) {
      const double before = st->moved;
      const int first = st->s == 0;
      status = solve_step(w, st, start, &g, good);
      if (status != ROT_OK || !*good) return status;
      fell = before > 0.0 ? fmin(1.0, st->moved / before) : 1.0;
      if (first || fell * st->moved <= max) break;
    }
    if (status != ROT_OK) return status;
    w->moved += st->moved;
    w->moved_fell += fell * st->moved;
    look_between(w, st, &g);
    /* A kink beside the nodes, or too many nodes later on: no sweep will do. */
    *good = meet_kinks(w, st, i == 0, st->node + 1 == st->last) &&
            nodes_wanted(w, st) <= MAX_NODES &&
            (st->surface == NO_SURFACE || meet_surface(st, g.dim));
    if (!*good) return ROT_OK;
    start = st->y + g.dim;
    if (st->surface != NO_SURFACE && i + 1 < w->n_steps) st[1].t = st->end;
  }
  return ROT_OK;
}

/* ---- both sides ------------------------------------------------------------------------------ */

/* The surfaces beside a step, and that which it ends on. surfaces in time are its ends already. */
static void beside_surfaces(const side *w, step *st) {
  const size_t dim = w->p->dim;
  const double *a = rot_dense_node(&w->trajectory->nodes, st->node) + 1, *b = a + 1 + 2 * dim;
  const int last = st->node + 1 == st->last && st->last + 1 < w->trajectory->nodes.count;
  st->surface = NO_SURFACE;
  for (size_t k = 0; k < w->p->controlled; k++) {
    st->low[k] = -INFINITY;
    st->high[k] = INFINITY;
  }
  for (size_t i = 0; i < w->surfaces->count; i++) {
    const rot_ode_surface *surface = &w->surfaces->surface[i];
    const size_t k = surface->component;
    if (k == dim) continue;
    const double mid = 0.5 * (a[k] + b[k]) + 0.125 * st->h * (a[dim + k] - b[dim + k]);
    const int above = mid > 0.5 * (surface->below + surface->above);
    const double level = above ? surface->above : surface->below;
    if (above) st->low[k] = fmax(st->low[k], level);
    if (!above) st->high[k] = fmin(st->high[k], level);
    if (last && fabs(b[k] - level) <= ON_SURFACE * w->size[k]) {
      st->surface = k;
      st->level = level;
    }
  }
}

/* The steps of the trajectory, its segments apart. */
static rot_status side_begin(side *w) {
  const rot_dense *nodes = &w->trajectory->nodes;
  const size_t dim = w->p->dim, each = (2 + MAX_NODES) * dim;
  w->steps = calloc(nodes->count + 1, sizeof *w->steps);
  w->data = calloc((nodes->count + 1) * each, sizeof *w->data);
  if (!w->steps || !w->data) return ROT_ENOMEM;
  for (size_t i = 0, first = 0; i + 1 < nodes->count; i++) {
    const double *a = rot_dense_node(nodes, i), *b = rot_dense_node(nodes, i + 1);
    for (size_t k = 0; k < dim; k++) {
      w->size[k] = fmax(w->size[k], fmax(fabs(a[1 + k]), fabs(b[1 + k])));
      w->size[dim + k] = fmax(w->size[dim + k], fmax(fabs(a[1 + dim + k]), fabs(b[1 + dim + k])));
    }
    if (a[0] == b[0]) {
      first = i + 1;
      continue;
    }
    step *st = &w->steps[w->n_steps];
    st->t = st->from = a[0];
    st->end = b[0];
    st->h = b[0] - a[0];
    st->first = first;
    st->node = i;
    st->y = w->data + w->n_steps++ * each;
    st->c = st->y + 2 * dim;
    memcpy(st->y, a + 1, dim * sizeof *a);
    memcpy(st->y + dim, b + 1, dim * sizeof *b);
    st->last = i + 1;
  }
  for (size_t i = w->n_steps; i-- > 0;) {
    step *st = &w->steps[i];
    if (i + 1 < w->n_steps && st[1].first == st->first) st->last = st[1].last;
    beside_surfaces(w, st);
  }
  return ROT_OK;
}

/* ---- probes and rows ------------------------------------------------------------------------- */

/* A solved step as a piece of the path. */
typedef struct solution {
  const side *w;
  const step *st;
  const double *error; /* of each component */
  double called[MAX_NODES * (MAX_NODES + 1)];
} solution;

static void state_in(void *path, double t, double y[]) {
  const solution *v = path;
  legendre_states(v->st, t, v->w->p->dim, v->w->p->controlled, y);
}

static int believed_in(void *path, double t, double y[], double slope[], double y_unsure[],
                       double slope_unsure[]) {
  const solution *v = path;
  const size_t dim = v->w->p->dim;
  double polynomial[MAX_NODES + 1];
  legendre_at(v->st, t, polynomial);
  for (size_t k = 0; k < dim; k++) {
    y[k] = legendre_state(v->st, polynomial, dim, k);
    slope[k] = legendre_slope(v->st, polynomial, dim, k);
    slope_unsure[k] = pair(v->st, dim, k, v->st->s - 1);
    y_unsure[k] = v->error[k];
  }
  return 1;
}

static rot_status call_in(void *path, double t, const double y[], double dydt[]) {
  const solution *v = path;
  return slope_in(v->w, v->st, t, y, dydt);
}

/* In any sweep, a node in a narrow change of the law leaves polynomials whose terms do not fall, so
 * the nodes of all sweeps count as calls. */
static rot_ode_piece piece_of(solution *v) {
  const step *st = v->st;
  size_t n = 0;
  for (size_t s = FIRST_NODES; s <= MAX_NODES; s++) {
    for (size_t j = 0; j < s && st->swept >> s & 1UL; j++) {
      const double at = st->from + 0.5 * st->h * (1.0 + v->w->rules[s].x[j]);
      const double part = (at - st->t) / (st->end - st->t);
      if (part >= 0.0 && part <= 1.0) v->called[n++] = part;
    }
  }
  return (rot_ode_piece){.t = st->t,
                         .end = st->end,
                         .n_called = n,
                         .called = v->called,
                         .largest = v->w->size,
                         .path = v,
                         .state = state_in,
                         .believed = believed_in,
                         .call = call_in};
}

static rot_status probe_steps(const side *w, rot_ode_probes *probes, const double error[]) {
  rot_status status = ROT_OK;
  for (size_t i = 0; i < w->n_steps && status == ROT_OK; i++) {
    solution v = {.w = w, .st = &w->steps[i], .error = error};
    const rot_ode_piece piece = piece_of(&v);
    status = rot_ode_probe(probes, &piece);
  }
  return status;
}

/* The law's own slope; NaN at breaks. */
static rot_status slope_of_row(const side *w, const step *st, rot_ode_probes *probes,
                               const double error[], double t, double *slope) {
  double dydt[MAX_DIM];
  int known;
  *slope = NAN;
  if (!probes || (t == st->end && st->node + 1 == st->last)) return ROT_OK;
  solution v = {.w = w, .st = st, .error = error};
  const rot_ode_piece piece = piece_of(&v);
  const rot_status status = rot_ode_probe_at(probes, &piece, t, dydt, &known);
  if (status == ROT_OK && known) *slope = dydt[w->p->sloped];
  return status;
}

static rot_status fill_rows(const side *w, const rot_ode_output *rows, rot_ode_probes *probes,
                            const double error[], int forward) {
  const size_t dim = w->p->dim, total = forward ? rows->n - rows->before : rows->before;
  const double direction = forward ? 1.0 : -1.0;
  size_t i = 0;
  rot_status status = ROT_OK;
  for (size_t k = 0; k < total && status == ROT_OK; k++) {
    const size_t row = forward ? rows->before + k : rows->before - 1 - k;
    const double t = rows->time_s[row];
    double *y = rows->y + row * dim, slope = NAN;
    if (t == w->p->start_s || w->n_steps == 0) {
      memcpy(y, w->p->start, dim * sizeof *y);
    } else {
      while (i + 1 < w->n_steps && direction * (t - w->steps[i].end) > 0.0) i++;
      const step *st = &w->steps[i];
      if (t == st->end) {
        memcpy(y, st->y + dim, dim * sizeof *y);
      } else {
        legendre_states(st, t, dim, dim, y);
      }
      if (rows->slope) status = slope_of_row(w, st, probes, error, t, &slope);
    }
    if (rows->slope) rows->slope[row] = slope;
  }
  return status;
}

/* Share of the accuracy that the polynomials may leave out. */
#define MAX_LEFT_OUT 0.02
/* The error of a sweep: its distance from the one before, times what that fell by, times this; and
 * at least a part of the distance. */
#define SWEEP_MARGIN 4.0
#define MIN_PART     0.02
/* How often counts what kinks may have changed that the nodes do not show. */
#define MISSED_COUNT 3.0
/* Sweeps that are no further apart, of the size, show rounding. */
#define ROUNDING     (32.0 * ROT_EPS)

/* One sweep over both sides; its part of the distance from the one before. */
static rot_status sweep_sides(side sides[2], double last, double *part, double *difference,
                              int *good) {
  double moved = 0.0, fell = 0.0;
  const side *w = &sides[0];
  memset(w->difference, 0, w->p->dim * sizeof *w->difference);
  memset(w->left_out, 0, w->p->dim * sizeof *w->left_out);
  *good = 1;
  for (int forward = 0; forward < 2 && *good; forward++) {
    sides[forward].moved = sides[forward].moved_fell = sides[forward].missed = 0.0;
    const rot_status status = sweep(&sides[forward], good);
    if (status != ROT_OK) return status;
    moved += sides[forward].moved;
    fell += sides[forward].moved_fell;
  }
  *difference = 0.0;
  for (size_t k = 0; k < w->p->controlled; k++) {
    if (w->size[k] > 0.0) *difference = fmax(*difference, w->difference[k] / w->size[k]);
  }
  fell = moved > 0.0 && *difference <= last ? fell / moved : *difference > 0.0 ? 1.0 : 0.0;
  *part = fell < 0.5 ? fmin(1.0, fmax(MIN_PART, SWEEP_MARGIN * fell / (1.0 - fell))) : 1.0;
  return ROT_OK;
}

rot_status rot_ode_collocate(const rot_ode_params *p, const rot_ode_trajectory trajectory[2],
                             const rot_ode_surfaces *surfaces, const rot_ode_output *rows,
                             rot_ode_probes *probes, const rot_hooks *hooks, rot_info *info,
                             int *good) {
  const size_t dim = p->dim;
  rule *rules = calloc(MAX_NODES + 1, sizeof *rules);
  double *scratch = calloc(4 * dim, sizeof *scratch), difference = INFINITY;
  side sides[2] = {{.p = p}, {.p = p}};
  rot_status status = rules && scratch ? ROT_OK : ROT_ENOMEM;
  *good = 0;
  for (int forward = 0; forward < 2 && status == ROT_OK; forward++) {
    sides[forward] = (side){.p = p,
                            .trajectory = &trajectory[forward],
                            .surfaces = surfaces,
                            .hooks = hooks,
                            .info = info,
                            .rules = rules,
                            .size = scratch,
                            .difference = scratch + 2 * dim,
                            .left_out = scratch + 3 * dim,
                            .wanted = MAX_LEFT_OUT * p->accuracy,
                            .slope_of = rows->slope ? p->sloped : dim};
    status = side_begin(&sides[forward]);
  }
  int solved = !trajectory[0].slid && !trajectory[1].slid;
  for (int k = 0; k < MAX_SWEEPS && status == ROT_OK && solved && !*good; k++) {
    double part, last = difference, worst = 0.0;
    status = sweep_sides(sides, last, &part, &difference, &solved);
    if (status != ROT_OK || !solved || k == 0) continue;
    const double missed = MISSED_COUNT * sqrt(sides[0].missed + sides[1].missed);
    for (size_t i = 0; i < dim; i++) {
      const double size = scratch[i];
      rows->error[i] = part * sides[0].difference[i] + sides[0].left_out[i] + missed * size;
      if (i < p->controlled && size > 0.0) worst = fmax(worst, rows->error[i] / size);
    }
    *good = worst <= fmax(p->accuracy, ROUNDING);
    solved = missed <= fmax(4.0 * p->accuracy, ROUNDING); /* sweeps lessen it by little */
  }
  for (int forward = 0; forward < 2; forward++) {
    if (*good && status == ROT_OK && probes)
      status = probe_steps(&sides[forward], probes, rows->error);
    if (*good && status == ROT_OK) {
      status = fill_rows(&sides[forward], rows, probes, rows->error, forward);
    }
    free(sides[forward].steps);
    free(sides[forward].data);
  }
  for (size_t i = 0; i < dim && *good; i++) rows->largest[i] = fmax(rows->largest[i], scratch[i]);
  free(scratch);
  free(rules);
  return status;
}
