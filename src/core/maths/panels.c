#include "maths/panels.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "ground/real.h"

/* Kronrod's rule of 15 nodes on [-1, 1] with Gauss's of 7 (Piessens et al. 1983, QUADPACK). */
enum { NODES = 15, HALF = 7 };
static const double node[HALF + 1] = {
    0.991455371120812639206854697526329, 0.949107912342758524526189684047851,
    0.864864423359769072789712788640926, 0.741531185599394439863864773280788,
    0.586087235467691130294144691693557, 0.405845151377397166906606412076961,
    0.207784955007898467600689403773245, 0.0};
static const double kronrod[HALF + 1] = {
    0.022935322010529224963732008058970, 0.063092092629978553290700663189204,
    0.104790010322250183839876322541518, 0.140653259715525918745189590510238,
    0.169004726639267902826583426598550, 0.190350578064785409913256402421014,
    0.204432940075298892414161999234649, 0.209482141084727828012999174891714};
static const double gauss[HALF + 1] = {
    0.0, 0.129484966168869693270611432679082, 0.0, 0.279705391489276667901467771423780,
    0.0, 0.381830050505118944950369775488975, 0.0, 0.417959183673469387755102040816327};

enum {
  MAX = 200000,  /* panels evaluated, in addition to four for each initial panel */
  AT_ONCE = 256, /* panels in one call of the integrands */
  HALVINGS = 24
};

typedef struct panel {
  double from, to; /* s */
  size_t owner;    /* index of the initial panel */
} panel;

/* Integrals of one panel, `width` numbers each. */
typedef struct sums {
  double *value, *size, *error, *noise, *coarse;
} sums;

static int at(int i) { return i <= HALF ? i : NODES - 1 - i; }

/* (panel, f: NODES x width values) => integrals, sizes, errors, effect of rounded times, error
 * of a panel that is not resolved */
static void integrate(const panel *p, size_t width, const double f[], const sums *out) {
  const double half = 0.5 * (p->to - p->from),
               late = 2.0 * ROT_EPS * fmax(fabs(p->from), fabs(p->to));
  for (size_t k = 0; k < width; k++) {
    double by_kronrod = 0.0, by_gauss = 0.0, size = 0.0, varies = 0.0;
    double low = f[k], high = f[k];
    for (int i = 0; i < NODES; i++) {
      const double y = f[(size_t)i * width + k];
      by_kronrod += kronrod[at(i)] * y;
      by_gauss += gauss[at(i)] * y;
      size += kronrod[at(i)] * fabs(y);
      low = fmin(low, y);
      high = fmax(high, y);
      if (i > 0) varies += fabs(y - f[(size_t)(i - 1) * width + k]);
    }
    const double difference = fabs(by_kronrod - by_gauss) * half;
    out->value[k] = by_kronrod * half;
    out->size[k] = size = size * half;
    /* Piessens' rule: the difference is the error of Gauss's rule, Kronrod's is far less. */
    out->error[k] = size > 0.0 ? size * fmin(1.0, pow(200.0 * difference / fmax(size, 1e-300), 1.5))
                               : difference;
    out->noise[k] = varies * late; /* the times of the nodes are rounded */
    out->coarse[k] = fmin((high - low) * 2.0 * half, 10.0 * difference);
  }
}

/* 1 if halving the panel would not reduce the error. */
static int is_good(const panel *p, size_t width, const sums *of, const double total[]) {
  int good = 1;
  for (size_t k = 0; k < width; k++) {
    if (!isfinite(of->value[k])) return 1;
    good &= of->error[k] <= 1e-15 * total[k];
  }
  return good || p->to - p->from < 8.0 * ROT_EPS * fmax(fabs(p->from), fabs(p->to));
}

typedef struct work {
  const rot_panels *p;
  rot_panels_rates rates;
  void *ctx;
  panel *open, *next;    /* panels of this halving and of the next, increasing */
  size_t n_open, n_next; /* their numbers */
  size_t room;           /* panels allocated in each */
  double *time_s, *f;    /* nodes and integrands of AT_ONCE panels */
  double *total;         /* width: sizes that errors are compared with */
  double *all;           /* value, size, error, noise, coarse of the open panels */
} work;

static sums sums_of(const work *w, size_t i) {
  const size_t width = w->p->width;
  double *x = w->all + 5 * i * width;
  return (sums){x, x + width, x + 2 * width, x + 3 * width, x + 4 * width};
}

/* Integrates all open panels, AT_ONCE at a time. */
static rot_status evaluate(work *w) {
  const size_t width = w->p->width;
  rot_status status = ROT_OK;
  for (size_t first = 0; first < w->n_open && status == ROT_OK; first += AT_ONCE) {
    const size_t n = w->n_open - first < AT_ONCE ? w->n_open - first : AT_ONCE;
    for (size_t i = 0; i < n; i++) {
      const panel *p = &w->open[first + i];
      const double half = 0.5 * (p->to - p->from), middle = p->from + half;
      for (int k = 0; k < NODES; k++) {
        w->time_s[i * NODES + (size_t)k] = middle + (k < HALF ? -half : half) * node[at(k)];
      }
    }
    status = w->rates(n * NODES, w->time_s, w->f, w->ctx);
    for (size_t i = 0; i < n && status == ROT_OK; i++) {
      const sums of = sums_of(w, first + i);
      integrate(&w->open[first + i], width, w->f + i * NODES * width, &of);
    }
  }
  return status;
}

/* Allocates n open panels, n next ones and their integrals. */
static rot_status make_room(work *w, size_t n) {
  if (n <= w->room) return ROT_OK;
  panel *open = realloc(w->open, n * sizeof *open), *next;
  if (open) w->open = open;
  next = open ? realloc(w->next, n * sizeof *next) : NULL;
  if (next) w->next = next;
  double *all = next ? realloc(w->all, 5 * n * w->p->width * sizeof *all) : NULL;
  if (!all) return ROT_ENOMEM;
  w->all = all;
  w->room = n;
  return ROT_OK;
}

static void find_total(work *w) {
  for (size_t k = 0; k < w->p->width; k++) {
    double total = 0.0;
    for (size_t i = 0; i < w->n_open; i++) total += sums_of(w, i).size[k];
    if (w->p->min) total = fmax(total, w->p->min[k]);
    w->total[k] = isfinite(total) ? total : (double)INFINITY; /* no halving helps */
  }
}

/* resolved: 0, the error is that of an unresolved panel. */
static void keep(work *w, size_t i, int resolved) {
  const rot_panels *p = w->p;
  const sums of = sums_of(w, i);
  for (size_t k = 0; k < p->width; k++) {
    p->value[w->open[i].owner * p->width + k] += of.value[k];
    p->size[k] += of.size[k];
    p->error[k] += (resolved ? of.error[k] : of.coarse[k]) + of.noise[k];
  }
}

static void halve(work *w, size_t i) {
  const panel *p = &w->open[i];
  const double middle = p->from + 0.5 * (p->to - p->from);
  w->next[w->n_next++] = (panel){p->from, middle, p->owner};
  w->next[w->n_next++] = (panel){middle, p->to, p->owner};
}

/* Halves panels until each is good or the work is spent; adds them to the results. */
static rot_status refine(work *w) {
  const rot_panels *p = w->p;
  size_t left = p->max ? p->max : MAX + 4 * p->n;
  for (size_t i = 0; i < p->n; i++) w->open[i] = (panel){p->edge_s[i], p->edge_s[i + 1], i};
  w->n_open = p->n;
  for (int halving = 0; w->n_open; halving++) {
    const rot_status status = evaluate(w);
    if (status != ROT_OK) return status;
    if (halving == 0) find_total(w);
    left = left > w->n_open ? left - w->n_open : 0;
    size_t bad = 0;
    for (size_t i = 0; i < w->n_open; i++) {
      const sums of = sums_of(w, i);
      bad += !is_good(&w->open[i], p->width, &of, w->total);
    }
    const int spent = 2 * bad > left, stop = halving == HALVINGS || spent;
    /* The panels do not resolve the integrand: its error is unknown. */
    for (size_t k = 0; k < p->width && spent && !p->bounded; k++) p->error[k] = (double)NAN;
    if (make_room(w, 2 * bad) != ROT_OK) return ROT_ENOMEM;
    w->n_next = 0;
    for (size_t i = 0; i < w->n_open; i++) {
      const sums of = sums_of(w, i);
      const int good = is_good(&w->open[i], p->width, &of, w->total);
      if (stop || good) {
        keep(w, i, good || !spent || !p->bounded);
      } else {
        halve(w, i);
      }
    }
    panel *swap = w->open;
    w->open = w->next;
    w->next = swap;
    w->n_open = w->n_next;
  }
  return ROT_OK;
}

rot_status rot_panels_integrate(const rot_panels *p, rot_panels_rates rates, void *ctx) {
  work w = {.p = p, .rates = rates, .ctx = ctx};
  const size_t nodes = (size_t)AT_ONCE * NODES;
  memset(p->value, 0, p->n * p->width * sizeof *p->value);
  memset(p->error, 0, p->width * sizeof *p->error);
  memset(p->size, 0, p->width * sizeof *p->size);
  w.time_s = malloc((nodes + nodes * p->width + p->width) * sizeof *w.time_s);
  rot_status status = w.time_s ? make_room(&w, p->n ? p->n : 1) : ROT_ENOMEM;
  if (status == ROT_OK) {
    w.f = w.time_s + nodes;
    w.total = w.f + nodes * p->width;
    status = refine(&w);
  }
  free(w.time_s);
  free(w.open);
  free(w.next);
  free(w.all);
  return status;
}
