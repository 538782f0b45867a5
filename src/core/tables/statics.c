#include "tables/statics.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "maths/cone.h"
#include "ground/dd.h"
#include "maths/eigen.h"
#include "maths/simplex.h"

/* Rows of the plane problem among the six: forces along x and y, torque about z. */
static const size_t plane_rows[3] = {0, 1, 5}, space_rows[6] = {0, 1, 2, 3, 4, 5};

static int exponent_of(double largest) {
  int e = 0;
  if (largest > 0.0) frexp(largest, &e);
  return e;
}

static int exponent_of_all(size_t n, const double x[]) {
  double largest = 0.0;
  for (size_t i = 0; i < n; i++) largest = fmax(largest, fabs(x[i]));
  return exponent_of(largest);
}

static void cross(const rot_dd a[3], const rot_dd b[3], rot_dd to[3]) {
  for (int i = 0; i < 3; i++) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    to[i] = rot_dd_sub(rot_dd_mul(a[j], b[k]), rot_dd_mul(a[k], b[j]));
  }
}

/* Sums of absolute terms of the cross product, from absolute values a and b. */
static void cross_terms(const double a[3], const double b[3], double to[3]) {
  for (int i = 0; i < 3; i++) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    to[i] = a[j] * b[k] + a[k] * b[j];
  }
}

static rot_dd zero(void) { return (rot_dd){0.0, 0.0}; }

/* ---- sums ----------------------------------------------------------------------------------- */

typedef struct units {
  int length, force; /* exponents */
} units;

/* Adds n loads, in units: force and torque to `sum`, their absolute terms to `terms`. */
static void add_loads(size_t n, const double at[], const double force[], const double couple[],
                      const double about[3], units unit, rot_dd sum[6], double terms[6]) {
  for (size_t i = 0; i < n; i++) {
    rot_dd arm[3], f[3], turn[3];
    double size[3], strength[3], turns[3];
    for (int j = 0; j < 3; j++) {
      const double p = ldexp(at[3 * i + (size_t)j], -unit.length);
      const double q = ldexp(about[j], -unit.length);
      arm[j] = rot_dd_sum2(p, -q);
      size[j] = fabs(p) + fabs(q);
      f[j] = (rot_dd){ldexp(force[3 * i + (size_t)j], -unit.force), 0.0};
      strength[j] = fabs(f[j].hi);
    }
    cross(arm, f, turn);
    cross_terms(size, strength, turns);
    for (int j = 0; j < 3; j++) {
      const double c = ldexp(ldexp(couple[3 * i + (size_t)j], -unit.force), -unit.length);
      sum[j] = rot_dd_add(sum[j], f[j]);
      sum[j + 3] = rot_dd_add1(rot_dd_add(sum[j + 3], turn[j]), c);
      terms[j] += strength[j];
      terms[j + 3] += turns[j] + fabs(c);
    }
  }
}

/* => units; a couple counts as a force at the distance 2^length */
static units units_of(size_t n, const double force[], const double couple[], int length) {
  const int c = exponent_of_all(3 * n, couple), f = exponent_of_all(3 * n, force);
  units unit = {length, f};
  double any_force = 0.0, any_couple = 0.0;
  for (size_t i = 0; i < 3 * n; i++) {
    any_force = fmax(any_force, fabs(force[i]));
    any_couple = fmax(any_couple, fabs(couple[i]));
  }
  if (any_couple > 0.0 && (!(any_force > 0.0) || c - length > f)) unit.force = c - length;
  return unit;
}

rot_sums rot_statics_sums(size_t n, const double at[], const double force[], const double couple[],
                          const double about[3]) {
  const int la = exponent_of_all(3 * n, at), lb = exponent_of_all(3, about);
  const units unit = units_of(n, force, couple, la > lb ? la : lb);
  rot_dd sum[6] = {{0.0, 0.0}};
  double terms[6] = {0.0};
  add_loads(n, at, force, couple, about, unit, sum, terms);
  rot_sums out;
  out.force_terms = ldexp(fmax(terms[0], fmax(terms[1], terms[2])), unit.force);
  out.torque_terms =
      ldexp(ldexp(fmax(terms[3], fmax(terms[4], terms[5])), unit.force), unit.length);
  for (int j = 0; j < 3; j++) {
    out.force[j] = ldexp(sum[j].hi, unit.force);
    out.torque[j] = ldexp(ldexp(sum[j + 3].hi, unit.force), unit.length);
  }
  return out;
}

static double norm3(const double x[3]) { return hypot(hypot(x[0], x[1]), x[2]); }

rot_axis rot_statics_axis(const rot_sums *sums, const double about[3]) {
  const double f = norm3(sums->force), m = norm3(sums->torque);
  rot_axis out = {0, {about[0], about[1], about[2]}, 0.0, NAN};
  const int force = f > 8.0 * ROT_EPS * sums->force_terms;
  int turns = m > 8.0 * ROT_EPS * sums->torque_terms;
  if (!force) {
    out.kind = turns ? 2 : 0;
    out.couple = turns ? m : 0.0;
    return out;
  }
  double along = 0.0, u[3];
  for (int j = 0; j < 3; j++) u[j] = sums->force[j] / f;
  for (int j = 0; j < 3; j++) along += u[j] * sums->torque[j];
  for (int i = 0; i < 3; i++) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    out.point[i] = about[i] + (u[j] * (sums->torque[k] / f) - u[k] * (sums->torque[j] / f));
  }
  if (!(fabs(along) > 8.0 * ROT_EPS * (m + sums->torque_terms))) along = 0.0;
  out.kind = along > 0.0 || along < 0.0 ? 3 : 1;
  out.couple = along;
  out.pitch_m = along / f;
  return out;
}

/* ---- equations ------------------------------------------------------------------------------ */

typedef struct equations {
  size_t m;           /* equations: 3 or 6 */
  size_t k;           /* reactions */
  const size_t *rows; /* indices of the equations among the six */
  units unit;
  double about[3];      /* point of the torques */
  rot_dd *a;            /* m x k, by columns; reactions along unit vectors */
  double *terms;        /* sums of absolute terms of a */
  rot_dd load[6];       /* in the order of the rows */
  double load_terms[6]; /* sums of absolute terms of the loads */
  double sigma[6];      /* singular values, ascending */
  double left[36];      /* left singular vectors; column j for sigma j */
  double *right;        /* k x m: A' left / sigma, by columns j; 0 beyond the rank */
  size_t first;         /* first singular value that is not 0 */
} equations;

/* reaction => unit vector, absolute terms of its components */
static void direction_of(const rot_reaction *reaction, rot_dd unit[3], double terms[3]) {
  double all[6];
  memcpy(all, reaction->from, 3 * sizeof *all);
  memcpy(all + 3, reaction->to, 3 * sizeof *all);
  const int e = exponent_of_all(6, all);
  double size = 0.0;
  for (int j = 0; j < 3; j++) {
    const double a = ldexp(all[j], -e), b = ldexp(all[j + 3], -e);
    unit[j] = rot_dd_sum2(b, -a);
    terms[j] = fabs(a) + fabs(b);
    size = fmax(size, fabs(unit[j].hi));
  }
  const int small = exponent_of(size);
  rot_dd square = zero();
  for (int j = 0; j < 3; j++) {
    unit[j] = rot_dd_ldexp(unit[j], -small);
    terms[j] = ldexp(terms[j], -small);
    square = rot_dd_add(square, rot_dd_mul(unit[j], unit[j]));
  }
  const rot_dd length = rot_dd_sqrt(square);
  for (int j = 0; j < 3; j++) {
    unit[j] = rot_dd_div(unit[j], length);
    terms[j] /= length.hi;
  }
}

/* reaction => column j of A, its absolute terms */
static void fill_column(equations *eq, size_t j, const rot_reaction *reaction) {
  rot_dd all[6], arm[3], unit[3];
  double terms[6] = {0.0}, size[3], spread[3];
  direction_of(reaction, unit, spread);
  for (int i = 0; i < 6; i++) all[i] = zero();
  if (reaction->is_couple) {
    for (int i = 0; i < 3; i++) {
      all[i + 3] = unit[i];
      terms[i + 3] = spread[i];
    }
  } else {
    for (int i = 0; i < 3; i++) {
      const double p = ldexp(reaction->at[i], -eq->unit.length);
      const double q = ldexp(eq->about[i], -eq->unit.length);
      arm[i] = rot_dd_sum2(p, -q);
      size[i] = fabs(p) + fabs(q);
      all[i] = unit[i];
      terms[i] = spread[i];
    }
    cross(arm, unit, all + 3);
    cross_terms(size, spread, terms + 3);
  }
  for (size_t i = 0; i < eq->m; i++) {
    eq->a[j * eq->m + i] = all[eq->rows[i]];
    eq->terms[j * eq->m + i] = terms[eq->rows[i]];
  }
}

/* => exponent of the largest distance of a load or support from `about`. Loads count up to FAR
 * times as far away as the supports: further, they would make a lever of those, that of a rank, a
 * rounding. */
static int extent(const rot_structure *s, const double about[3], int e) {
  enum { FAR = 20, NEVER = 1000 }; /* exponents; numbers of 2^1000 have no products */
  double of_loads = 0.0, of_supports = 0.0;
  for (size_t i = 0; i < 3 * s->loads; i++)
    of_loads = fmax(of_loads, fabs(ldexp(s->load_at[i], -e) - ldexp(about[i % 3], -e)));
  for (size_t j = 0; j < s->reactions; j++)
    for (int i = 0; i < 3; i++)
      of_supports = fmax(of_supports, fabs(ldexp(s->reaction[j].at[i], -e) - ldexp(about[i], -e)));
  const double largest = fmax(of_loads, of_supports);
  if (!(largest > 0.0)) return e;
  const int far = exponent_of(largest);
  if (!(of_supports > 0.0)) return far + e;
  const int near = exponent_of(of_supports) + FAR;
  return (near > far ? far : near > far - NEVER ? near : far - NEVER) + e;
}

static void set_loads(equations *eq, const rot_structure *s, const int chosen[], int wanted) {
  rot_dd sum[6];
  double terms[6] = {0.0};
  for (int i = 0; i < 6; i++) sum[i] = zero();
  for (size_t i = 0; i < s->loads; i++) {
    if (chosen && (chosen[i] != 0) != wanted) continue;
    add_loads(1, s->load_at + 3 * i, s->load_force + 3 * i, s->load_couple + 3 * i, eq->about,
              eq->unit, sum, terms);
  }
  for (size_t i = 0; i < eq->m; i++) {
    eq->load[i] = sum[eq->rows[i]];
    eq->load_terms[i] = terms[eq->rows[i]];
  }
}

static void free_equations(equations *eq) {
  free(eq->a);
  free(eq->terms);
  free(eq->right);
}

/* Left singular vectors of the values that count as 0: an orthonormal basis of the orthogonal
 * complement of the range. rot_eigen_singular() gives none for a value of exactly 0. */
static void complete(equations *eq) {
  const size_t m = eq->m;
  for (size_t c = eq->first; c-- > 0;) {
    double best = 0.0, v[6], kept[6] = {0.0};
    for (size_t axis = 0; axis < m; axis++) {
      for (size_t i = 0; i < m; i++) v[i] = i == axis ? 1.0 : 0.0;
      double size = 0.0;
      for (int twice = 0; twice < 2; twice++)
        for (size_t j = c + 1; j < m; j++) {
          double along = 0.0;
          for (size_t i = 0; i < m; i++) along += v[i] * eq->left[i * m + j];
          for (size_t i = 0; i < m; i++) v[i] -= along * eq->left[i * m + j];
        }
      for (size_t i = 0; i < m; i++) size = hypot(size, v[i]);
      if (!(size > 1.000001 * best)) continue; /* ties by rounding: the first axis */
      best = size;
      for (size_t i = 0; i < m; i++) kept[i] = v[i] / size;
    }
    for (size_t i = 0; i < m; i++) eq->left[i * m + c] = kept[i];
  }
}

/* A => sigma, left, right, first */
static rot_status decompose(equations *eq, double tolerance) {
  const size_t rows = eq->k > eq->m ? eq->k : eq->m;
  double *g = calloc(rows * eq->m, sizeof *g);
  if (!g) return ROT_ENOMEM;
  for (size_t j = 0; j < eq->k; j++)
    for (size_t i = 0; i < eq->m; i++) g[j * eq->m + i] = eq->a[j * eq->m + i].hi;
  const rot_status status = rot_eigen_singular(rows, eq->m, g, eq->sigma, eq->left, NULL);
  free(g);
  if (status != ROT_OK) return status;
  const double min = tolerance * eq->sigma[eq->m - 1];
  for (eq->first = 0; eq->first < eq->m && !(eq->sigma[eq->first] > min);) eq->first++;
  complete(eq);
  for (size_t j = eq->first; j < eq->m; j++)
    for (size_t i = 0; i < eq->k; i++) {
      double sum = 0.0;
      for (size_t l = 0; l < eq->m; l++) sum += eq->a[i * eq->m + l].hi * eq->left[l * eq->m + j];
      eq->right[j * eq->k + i] = sum / eq->sigma[j];
    }
  return ROT_OK;
}

/* structure => equations in units, decomposed */
static rot_status set_up(equations *eq, const rot_structure *s) {
  memset(eq, 0, sizeof *eq);
  eq->m = s->plane ? 3 : 6;
  eq->rows = s->plane ? plane_rows : space_rows;
  eq->k = s->reactions;
  const double *origin = s->reactions ? s->reaction[0].at : s->loads ? s->load_at : NULL;
  if (origin) memcpy(eq->about, origin, sizeof eq->about);
  int e = exponent_of_all(3 * s->loads, s->load_at);
  for (size_t j = 0; j < s->reactions; j++) {
    const int own = exponent_of_all(3, s->reaction[j].at);
    e = own > e ? own : e;
  }
  const int length = extent(s, eq->about, e);
  eq->unit = units_of(s->loads, s->load_force, s->load_couple, length);
  const size_t room = eq->k ? eq->k * eq->m : 1;
  eq->a = calloc(room, sizeof *eq->a);
  eq->terms = calloc(room, sizeof *eq->terms);
  eq->right = calloc(room, sizeof *eq->right);
  if (!eq->a || !eq->terms || !eq->right) return ROT_ENOMEM;
  for (size_t j = 0; j < eq->k; j++) fill_column(eq, j, &s->reaction[j]);
  set_loads(eq, s, NULL, 0);
  return decompose(eq, s->rank_tolerance);
}

static double condition_of(const equations *eq) {
  return eq->first < eq->m ? eq->sigma[eq->m - 1] / eq->sigma[eq->first] : 1.0;
}

/* x => A x + b in double-double */
static void residual(const equations *eq, const rot_dd x[], rot_dd to[6]) {
  for (size_t i = 0; i < eq->m; i++) {
    to[i] = eq->load[i];
    for (size_t j = 0; j < eq->k; j++)
      to[i] = rot_dd_add(to[i], rot_dd_mul(eq->a[j * eq->m + i], x[j]));
  }
}

/* x -= A+ r with the pseudoinverse A+; returns the max change. */
static double correct(const equations *eq, const rot_dd r[6], rot_dd x[]) {
  double along[6], largest = 0.0;
  for (size_t j = eq->first; j < eq->m; j++) {
    along[j] = 0.0;
    for (size_t i = 0; i < eq->m; i++) along[j] += eq->left[i * eq->m + j] * r[i].hi;
    along[j] /= eq->sigma[j];
  }
  for (size_t i = 0; i < eq->k; i++) {
    double change = 0.0;
    for (size_t j = eq->first; j < eq->m; j++) change += eq->right[j * eq->k + i] * along[j];
    x[i] = rot_dd_add1(x[i], -change);
    largest = fmax(largest, fabs(change));
  }
  return largest;
}

static void minimum_norm(const equations *eq, rot_dd x[]) {
  rot_dd r[6];
  for (size_t i = 0; i < eq->k; i++) x[i] = zero();
  for (int pass = 0; pass < 8; pass++) {
    double size = 0.0;
    residual(eq, x, r);
    const double change = correct(eq, r, x);
    for (size_t i = 0; i < eq->k; i++) size = fmax(size, fabs(x[i].hi));
    if (!(change > 0x1p-70 * size)) return;
  }
}

/* => element (i, l) of the projector on the null space of A */
static double open_part(const equations *eq, size_t i, size_t l) {
  double sum = i == l ? 1.0 : 0.0;
  for (size_t j = eq->first; j < eq->m; j++)
    sum -= eq->right[j * eq->k + i] * eq->right[j * eq->k + l];
  return sum;
}

/* x => errors of x for errors of half an ulp in each number (two in a product, one of the result),
 * `determined` flags */
static void errors_of(const equations *eq, const rot_dd x[], double error[], int determined[]) {
  const double u = 4.0 * ROT_EPS, blur = fmax(1e-9, 64.0 * ROT_EPS * condition_of(eq));
  double off[6], along[6], y[6];
  for (size_t i = 0; i < eq->m; i++) {
    off[i] = eq->load_terms[i];
    for (size_t j = 0; j < eq->k; j++) off[i] += eq->terms[j * eq->m + i] * fabs(x[j].hi);
    y[i] = 0.0;
  }
  for (size_t j = eq->first; j < eq->m; j++) {
    along[j] = 0.0;
    for (size_t i = 0; i < eq->k; i++) along[j] += eq->right[j * eq->k + i] * x[i].hi;
    for (size_t i = 0; i < eq->m; i++) y[i] += eq->left[i * eq->m + j] * along[j] / eq->sigma[j];
  }
  for (size_t i = 0; i < eq->k; i++) {
    double sum = ROT_EPS * fabs(x[i].hi), open = 0.0;
    for (size_t l = 0; l < eq->m; l++) {
      double fraction = 0.0;
      for (size_t j = eq->first; j < eq->m; j++)
        fraction += eq->right[j * eq->k + i] * eq->left[l * eq->m + j] / eq->sigma[j];
      sum += u * fabs(fraction) * off[l];
    }
    for (size_t l = 0; l < eq->k; l++) {
      const double p = open_part(eq, i, l);
      open += p * p;
      double spread = 0.0;
      for (size_t j = 0; j < eq->m; j++) spread += eq->terms[l * eq->m + j] * fabs(y[j]);
      sum += u * fabs(p) * spread;
    }
    determined[i] = eq->k == eq->m - eq->first || sqrt(open) <= blur;
    error[i] = sum;
  }
}

/* ---- unilateral supports, friction ----------------------------------------------------------- */

/* Friction: as given, unlimited, none. */
typedef enum support_mode { AS_GIVEN, STICKING, SMOOTH } support_mode;

typedef struct program {
  const equations *eq;
  const rot_structure *s;
  support_mode mode;
  const double *cost;  /* of each reaction, or NULL */
  const double *known; /* reactions that balance the loads, or NULL */
  rot_simplex lp;
} program;

static int contact_of(const rot_structure *s, size_t j, size_t *which) {
  const size_t size = s->plane ? 2 : 3;
  for (size_t c = 0; c < s->contacts; c++)
    if (j >= s->contact[c].first && j < s->contact[c].first + size) {
      *which = c;
      return 1;
    }
  return 0;
}

/* (contact, v) => column of its reaction along v, its cost */
static void along_axes(const program *p, const rot_contact *contact, const double v[3],
                       double column[], double *cost) {
  const size_t m = p->eq->m, size = p->s->plane ? 2 : 3;
  memset(column, 0, m * sizeof *column);
  *cost = 0.0;
  for (size_t l = 0; l < size; l++) {
    for (size_t i = 0; i < m; i++) column[i] += p->eq->a[(contact->first + l) * m + i].hi * v[l];
    if (p->cost) *cost += p->cost[contact->first + l] * v[l];
  }
}

static void push(program *p, const double column[], double sign, double cost) {
  const size_t m = p->eq->m;
  for (size_t i = 0; i < m; i++) p->lp.column[p->lp.n * m + i] = sign * column[i];
  p->lp.cost[p->lp.n++] = sign * cost;
}

/* n => two unit vectors normal to n and to each other */
static void tangents(const double n[3], double first[3], double second[3]) {
  int min = 0;
  for (int i = 1; i < 3; i++)
    if (fabs(n[i]) < fabs(n[min])) min = i;
  double e[3] = {0.0, 0.0, 0.0};
  e[min] = 1.0;
  for (int i = 0; i < 3; i++) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    first[i] = n[j] * e[k] - n[k] * e[j];
  }
  const double size = norm3(first);
  for (int i = 0; i < 3; i++) first[i] /= size;
  for (int i = 0; i < 3; i++) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    second[i] = n[j] * first[k] - n[k] * first[j];
  }
}

/* Adds the known force of a contact in space as a column. Near the limit of equilibrium few
 * directions are feasible, and generated columns approach them slowly. */
static void push_known(program *p, const rot_contact *contact) {
  double column[6], cost, v[3];
  if (p->s->plane || !p->known) return;
  memcpy(v, p->known + contact->first, sizeof v);
  const double size = norm3(v);
  if (!(size > 0.0)) return;
  for (int i = 0; i < 3; i++) v[i] /= size;
  along_axes(p, contact, v, column, &cost);
  push(p, column, 1.0, cost);
}

/* Adds the columns of a contact: edges of its friction cone, or its normal and tangents. */
static void push_contact(program *p, const rot_contact *contact) {
  const double *n = contact->normal, mu = contact->friction;
  double column[6], cost, first[3], second[3], v[3];
  along_axes(p, contact, n, column, &cost);
  if (p->s->plane) {
    first[0] = -n[1];
    first[1] = n[0];
    first[2] = 0.0;
  } else {
    tangents(n, first, second);
  }
  if (p->mode == AS_GIVEN && mu < 1e6) {
    /* In space, these two are the initial columns; others are generated. */
    for (int sign = -1; sign <= 1; sign += 2) {
      for (int i = 0; i < 3; i++) v[i] = n[i] + sign * mu * first[i];
      along_axes(p, contact, v, column, &cost);
      push(p, column, 1.0, cost);
    }
    push_known(p, contact);
    return;
  }
  push(p, column, 1.0, cost);
  if (p->mode == SMOOTH) return;
  for (int side = 0; side < (p->s->plane ? 1 : 2); side++) {
    along_axes(p, contact, side ? second : first, column, &cost);
    push(p, column, 1.0, cost);
    push(p, column, -1.0, cost);
  }
}

/* dual => generator n + mu u of a friction cone in space with the min reduced cost: u is opposite
 * to the tangential part of the cost gradient */
static int price_cone(void *ctx, const double dual[], int phase, double column[], double *cost) {
  const program *p = ctx;
  const size_t m = p->eq->m;
  double best = 0.0, v[3] = {0.0, 0.0, 0.0};
  const rot_contact *which = NULL;
  for (size_t c = 0; c < p->s->contacts; c++) {
    const rot_contact *contact = &p->s->contact[c];
    if (!(contact->friction < 1e6)) continue;
    double slope[3], normal = 0.0, across[3];
    for (size_t l = 0; l < 3; l++) {
      slope[l] = phase == 1 || !p->cost ? 0.0 : p->cost[contact->first + l];
      for (size_t i = 0; i < m; i++)
        slope[l] -= dual[i] * p->eq->a[(contact->first + l) * m + i].hi;
      normal += slope[l] * contact->normal[l];
    }
    for (int l = 0; l < 3; l++) across[l] = slope[l] - normal * contact->normal[l];
    const double size = norm3(across), value = normal - contact->friction * size;
    if (!(value < best) || !(size > 0.0)) continue;
    best = value;
    which = contact;
    for (int l = 0; l < 3; l++) v[l] = contact->normal[l] - contact->friction * across[l] / size;
  }
  if (!which) return 0;
  along_axes(p, which, v, column, cost);
  return 1;
}

/* (equations, friction mode, cost, known reactions) => linear program for the reactions */
static rot_status start_program(program *p, const equations *eq, const rot_structure *s,
                                support_mode mode, const double cost[], const double known[]) {
  memset(p, 0, sizeof *p);
  p->eq = eq;
  p->s = s;
  p->mode = mode;
  p->cost = cost;
  p->known = known;
  const int cones = !s->plane && s->contacts && mode == AS_GIVEN;
  p->lp.m = eq->m;
  p->lp.capacity = 2 * eq->k + 2 + 4 * s->contacts + (cones ? 400 + 100 * s->contacts : 0);
  p->lp.column = malloc(p->lp.capacity * eq->m * sizeof *p->lp.column);
  p->lp.cost = malloc(p->lp.capacity * sizeof *p->lp.cost);
  if (!p->lp.column || !p->lp.cost) return ROT_ENOMEM;
  if (cones) {
    p->lp.price = price_cone;
    p->lp.ctx = p;
  }
  p->lp.tolerance = fmax(cones ? 1e-8 : 1e-11, 64.0 * ROT_EPS * condition_of(eq));
  for (size_t i = 0; i < eq->m; i++) p->lp.rhs[i] = -eq->load[i].hi;
  for (size_t j = 0, c; j < eq->k; j++) {
    double column[6];
    if (contact_of(s, j, &c)) {
      if (j == s->contact[c].first) push_contact(p, &s->contact[c]);
      continue;
    }
    for (size_t i = 0; i < eq->m; i++) column[i] = eq->a[j * eq->m + i].hi;
    push(p, column, 1.0, cost ? cost[j] : 0.0);
    if (!s->reaction[j].one_sided) push(p, column, -1.0, cost ? cost[j] : 0.0);
  }
  return ROT_OK;
}

static void end_program(program *p) {
  free(p->lp.column);
  free(p->lp.cost);
}

/* ---- initial motion -------------------------------------------------------------------------- */

enum { MAX_PASSIVE = 6 };

/* passive set => least-squares coefficients x of its columns, by normal equations with pivoting */
static void solve_passive(const program *p, size_t n, const size_t set[], double x[]) {
  const size_t m = p->eq->m;
  double a[MAX_PASSIVE][MAX_PASSIVE + 1];
  for (size_t i = 0; i < n; i++) {
    const double *column = p->lp.column + set[i] * m;
    for (size_t j = 0; j < n; j++) {
      a[i][j] = 0.0;
      for (size_t l = 0; l < m; l++) a[i][j] += column[l] * p->lp.column[set[j] * m + l];
    }
    a[i][n] = 0.0;
    for (size_t l = 0; l < m; l++) a[i][n] += column[l] * p->lp.rhs[l];
  }
  for (size_t j = 0; j < n; j++) {
    size_t best = j;
    for (size_t i = j; i < n; i++)
      if (fabs(a[i][j]) > fabs(a[best][j])) best = i;
    for (size_t l = 0; l <= n; l++) {
      const double swap = a[best][l];
      a[best][l] = a[j][l];
      a[j][l] = swap;
    }
    for (size_t i = 0; i < n; i++) {
      const double factor = i == j ? 0.0 : a[i][j] / a[j][j];
      for (size_t l = j; l <= n && i != j; l++) a[i][l] -= factor * a[j][l];
    }
  }
  for (size_t i = 0; i < n; i++) x[i] = a[i][n] / a[i][i];
}

/* => least-squares residual of the loads after the reactions: contacts with a reaction persist, the
 * others separate (Gauss's principle with unit masses). Non-negative least squares of Lawson and
 * Hanson, Solving Least Squares Problems (1974), chapter 23. */
static void unbalanced_loads(const program *p, double motion[6]) {
  const size_t m = p->eq->m;
  size_t set[MAX_PASSIVE], n = 0;
  double x[MAX_PASSIVE] = {0.0}, z[MAX_PASSIVE], size = 0.0;
  for (size_t i = 0; i < m; i++) size = fmax(size, fabs(p->lp.rhs[i]));
  for (int step = 0; step < 1000; step++) {
    size_t best = p->lp.n;
    double max = 1e-11 * size;
    for (size_t i = 0; i < m; i++) {
      motion[i] = -p->lp.rhs[i];
      for (size_t j = 0; j < n; j++) motion[i] += x[j] * p->lp.column[set[j] * m + i];
    }
    for (size_t j = 0; j < p->lp.n; j++) {
      double along = 0.0;
      for (size_t i = 0; i < m; i++) along -= motion[i] * p->lp.column[j * m + i];
      if (!(along > max)) continue;
      best = j;
      max = along;
    }
    if (best == p->lp.n || n == MAX_PASSIVE) return;
    x[n] = 0.0;
    set[n++] = best;
    for (int inner = 0; inner < 50; inner++) {
      double reach = 1.0;
      solve_passive(p, n, set, z);
      for (size_t j = 0; j < n; j++)
        if (z[j] <= 0.0) reach = fmin(reach, x[j] > 0.0 ? x[j] / (x[j] - z[j]) : 0.0);
      size_t kept = 0;
      const int whole = reach >= 1.0;
      for (size_t j = 0; j < n; j++) {
        x[kept] = whole ? z[j] : x[j] + reach * (z[j] - x[j]);
        set[kept] = set[j];
        if (x[kept] > 1e-14 * size || whole) kept++;
      }
      n = kept;
      if (whole) break;
    }
  }
}

static rot_status motion_of(const equations *eq, const rot_structure *s, support_mode mode,
                            double motion[6]) {
  program p;
  const rot_status status = start_program(&p, eq, s, mode, NULL, NULL);
  if (status == ROT_OK) unbalanced_loads(&p, motion);
  end_program(&p);
  return status;
}

/* 1 if a program is unbounded. With generated columns this is unreliable, since a basis may be
 * nearly singular: the search decides. */
static int without_limit(const program *p, rot_simplex_result result) {
  return result == ROT_SIMPLEX_UNBOUNDED && !p->lp.price;
}

static rot_status range_by_program(const equations *eq, const rot_structure *s, size_t j,
                                   double sign, const double x[], double cost[], double *limit) {
  program p;
  cost[j] = sign;
  rot_status status = start_program(&p, eq, s, AS_GIVEN, cost, x);
  if (status == ROT_OK) {
    const rot_simplex_result result = rot_simplex_solve(&p.lp);
    *limit = result == ROT_SIMPLEX_OPTIMAL ? sign * p.lp.value
             : without_limit(&p, result)   ? -sign * INFINITY
                                           : NAN;
  }
  end_program(&p);
  cost[j] = 0.0;
  return status;
}

/* ---- unilateral reactions: min norm, feasibility, extremes --------------------------------- */

/* The equations A x + b = 0 along the singular vectors, divided by the singular values: rows of
 * length 1. A search may add rows and columns. */
typedef struct cone_system {
  rot_cone cone;
  rot_cone_part *part;
  rot_dd *b, c[ROT_CONE_ROWS], y[ROT_CONE_ROWS], *x; /* as in rot_cone and rot_cone_solve() */
  double slack[ROT_CONE_ROWS], *blur;
} cone_system;

static void free_cone(cone_system *sys) {
  free(sys->part);
  free(sys->b);
  free(sys->x);
  free(sys->blur);
}

/* Relative effect of half an ulp of each number: two numbers in a product, and the result. */
static const double ulps = 4.0 * ROT_EPS;

/* v, one number per original equation => its combination in row i */
static rot_dd combined(const equations *eq, size_t i, const rot_dd v[]) {
  const size_t m = eq->m, j = eq->first + i;
  rot_dd sum = zero();
  for (size_t l = 0; l < m; l++) sum = rot_dd_add(sum, rot_dd_mul1(v[l], eq->left[l * m + j]));
  return rot_dd_div(sum, (rot_dd){eq->sigma[j], 0.0});
}

static double combined_terms(const equations *eq, size_t i, const double v[]) {
  const size_t m = eq->m, j = eq->first + i;
  double sum = 0.0;
  for (size_t l = 0; l < m; l++) sum += v[l] * fabs(eq->left[l * m + j]);
  return ulps * sum / eq->sigma[j];
}

static void set_parts(cone_system *sys, const rot_structure *s, support_mode mode) {
  rot_cone_part *part = sys->part;
  for (size_t j = 0; j < s->reactions; j++)
    if (s->reaction[j].one_sided) *part++ = (rot_cone_part){j, 1, {0.0, 0.0, 0.0}, 0.0};
  for (size_t c = 0; c < s->contacts; c++) {
    const rot_contact *contact = &s->contact[c];
    part->first = contact->first;
    part->size = s->plane ? 2 : 3;
    memcpy(part->normal, contact->normal, sizeof part->normal);
    part->friction = mode == STICKING ? INFINITY : contact->friction;
    part++;
  }
  sys->cone.part = sys->part;
  sys->cone.parts = (size_t)(part - sys->part);
}

/* equations => cone problem, with space for additional rows and columns */
static rot_status make_cone(cone_system *sys, const equations *eq, const rot_structure *s,
                            support_mode mode, size_t rows, size_t columns) {
  const size_t rank = eq->m - eq->first, m = rank + rows, k = eq->k + columns;
  memset(sys, 0, sizeof *sys);
  sys->part = calloc(s->reactions + s->contacts + 1, sizeof *sys->part);
  sys->b = calloc(m * k + 1, sizeof *sys->b);
  sys->x = calloc(k + 1, sizeof *sys->x);
  sys->blur = calloc(m * k + 1, sizeof *sys->blur);
  if (!sys->part || !sys->b || !sys->x || !sys->blur) return ROT_ENOMEM;
  for (size_t i = 0; i < rank; i++) {
    sys->c[i] = rot_dd_neg(combined(eq, i, eq->load));
    sys->slack[i] = combined_terms(eq, i, eq->load_terms);
    for (size_t j = 0; j < eq->k; j++) {
      sys->b[j * m + i] = combined(eq, i, eq->a + j * eq->m);
      sys->blur[j * m + i] = combined_terms(eq, i, eq->terms + j * eq->m);
    }
  }
  for (size_t i = 0; i < m; i++) sys->slack[i] = fmax(sys->slack[i], 1e-300);
  set_parts(sys, s, mode);
  sys->cone = (rot_cone){m, k, sys->cone.parts, sys->part, sys->b, sys->c, sys->slack, sys->blur};
  return ROT_OK;
}

/* (g, t) => *found: 1 if there is an x for the right-hand side c + t g. *gap: relative residual if
 * the search stopped without an answer, else NaN. */
static rot_status holds(cone_system *sys, const rot_dd g[], double t, int *found, double *gap) {
  rot_dd c[ROT_CONE_ROWS];
  rot_cone cone = sys->cone;
  rot_cone_result result;
  double size = 0.0;
  for (size_t i = 0; i < cone.m; i++) {
    c[i] = g ? rot_dd_add(sys->c[i], rot_dd_mul1(g[i], t)) : sys->c[i];
    sys->y[i] = c[i];
    size = hypot(size, c[i].hi);
  }
  cone.c = c;
  const rot_status status = rot_cone_solve(&cone, sys->y, sys->x, &result, gap);
  *found = status == ROT_OK && result == ROT_CONE_FOUND;
  *gap = result == ROT_CONE_STOPPED ? *gap / size : NAN;
  return status;
}

/* *answer: 1 if the supports can balance the loads to 1e-8, by the linear program; -1 if it stopped
 */
static rot_status balances(const equations *eq, const rot_structure *s, support_mode mode,
                           int *answer) {
  program p;
  const rot_status status = start_program(&p, eq, s, mode, NULL, NULL);
  if (status == ROT_OK) {
    const rot_simplex_result result = rot_simplex_solve(&p.lp);
    *answer = result == ROT_SIMPLEX_STOPPED ? -1 : result != ROT_SIMPLEX_INFEASIBLE;
  }
  end_program(&p);
  return status;
}

/* *rests: 1 if equilibrium reactions exist. A search without an answer counts as "none" if the
 * linear program is infeasible, or if the residual is so small that the load exceeds its limit by
 * less than the program resolves. */
static rot_status can_rest(const equations *eq, const rot_structure *s, support_mode mode,
                           int *rests) {
  cone_system sys;
  double gap = NAN;
  int answer = 0;
  rot_status status = make_cone(&sys, eq, s, mode, 0, 0);
  if (status == ROT_OK) status = holds(&sys, NULL, 0.0, rests, &gap);
  if (status == ROT_OK && !isnan(gap)) {
    status = balances(eq, s, mode, &answer);
    if (status == ROT_OK && answer != 0 && !(gap < 1e-7)) status = ROT_EBUDGET;
  }
  free_cone(&sys);
  return status;
}

/* Error of the reactions by solutions with each equation shifted by 512 times its error in both
 * directions, which crosses the states where a support begins to carry load. A side without
 * solution is ignored. */
static rot_status moved_reactions(const equations *eq, const cone_system *solved, double off[],
                                  double error[]) {
  const size_t k = eq->k;
  const double factor = 512.0;
  cone_system sys = *solved;
  rot_status status = ROT_OK;
  sys.x = calloc(k + 1, sizeof *sys.x);
  if (!sys.x) return ROT_ENOMEM;
  for (size_t l = 0; l < eq->m && status == ROT_OK; l++) {
    rot_dd unit[6], g[ROT_CONE_ROWS];
    double both[2];
    for (size_t i = 0; i < eq->m; i++) unit[i] = (rot_dd){i == l ? 1.0 : 0.0, 0.0};
    for (size_t i = 0; i < sys.cone.m; i++) g[i] = combined(eq, i, unit);
    double *worst = calloc(k + 1, sizeof *worst);
    if (!worst) {
      status = ROT_ENOMEM;
      break;
    }
    for (int side = 0; side < 2; side++) {
      int found;
      double gap;
      both[side] = (side ? 1.0 : -1.0) * factor * ulps * off[l];
      status = holds(&sys, g, both[side], &found, &gap);
      if (status != ROT_OK || !found) continue;
      for (size_t j = 0; j < k; j++)
        worst[j] = fmax(worst[j], fabs(sys.x[j].hi - solved->x[j].hi) / factor);
    }
    for (size_t j = 0; j < k; j++) error[j] += worst[j];
    free(worst);
  }
  free(sys.x);
  return status;
}

/* Errors of the reactions in cones for half an ulp of each number: by shifted equations and, for
 * undetermined reactions, by rotated axes under the dual y. */
static rot_status errors_of_cone(const equations *eq, const cone_system *sys,
                                 const int determined[], double error[]) {
  const size_t m = eq->m, k = eq->k;
  double off[6], y[6] = {0.0}, turn = 0.0;
  double *own = calloc(k + 1, sizeof *own);
  if (!own) return ROT_ENOMEM;
  for (size_t i = 0; i < m; i++) {
    off[i] = eq->load_terms[i];
    for (size_t j = 0; j < k; j++) off[i] += eq->terms[j * m + i] * fabs(sys->x[j].hi);
    for (size_t l = eq->first; l < m; l++)
      y[i] += eq->left[i * m + l] * sys->y[l - eq->first].hi / eq->sigma[l];
  }
  for (size_t j = 0; j < k; j++) {
    double spread = 0.0;
    for (size_t i = 0; i < m; i++) spread += eq->terms[j * m + i] * fabs(y[i]);
    turn = hypot(turn, ulps * spread);
    own[j] = ROT_EPS * fabs(sys->x[j].hi);
  }
  const rot_status status = moved_reactions(eq, sys, off, own);
  for (size_t j = 0; j < k; j++)
    if (!determined[j]) error[j] = own[j] + (fabs(sys->x[j].hi) > 0.0 ? turn : 0.0);
  free(own);
  return status;
}

static rot_status push_only(const equations *eq, const rot_structure *s, rot_dd x[],
                            const int determined[], double error[]) {
  cone_system sys;
  int found = 0;
  double gap;
  rot_status status = make_cone(&sys, eq, s, AS_GIVEN, 0, 0);
  if (status == ROT_OK) status = holds(&sys, NULL, 0.0, &found, &gap);
  if (status == ROT_OK && !found) status = ROT_EBUDGET;
  if (status == ROT_OK) {
    memcpy(x, sys.x, eq->k * sizeof *x);
    status = errors_of_cone(eq, &sys, determined, error);
  }
  free_cone(&sys);
  return status;
}

/* => bound on t from an infeasible t, or `t`. If c + t g has no x, the search ends with a y such
 * that B'y is in the polar cone and (c + t g).y > 0; each feasible t satisfies (c + t g).y <= 0. */
static double cut_of(const cone_system *sys, const rot_dd g[], double good, double t) {
  double c_y = 0.0, g_y = 0.0;
  for (size_t i = 0; i < sys->cone.m; i++) {
    c_y += sys->c[i].hi * sys->y[i].hi;
    g_y += g[i].hi * sys->y[i].hi;
  }
  const double bound = -c_y / g_y, part = (bound - good) / (t - good);
  return part > 0.0 && part < 1.0 ? bound + 1e-6 * (t - bound) : t;
}

/* Beyond this multiple of the loads a limit is believed only if it is proved that there is none
 * further: two surfaces of one normal were squeezed to 1e10 times the loads, where the search has
 * no answer. */
#define FAR_LIMIT 1e8

/* feasible t => largest feasible t in direction `sign` for the right-hand side c + t g. Unbounded
 * if g is feasible; else growing steps, cuts and bisection. A search without an answer counts as
 * infeasible. */
static rot_status extreme(cone_system *sys, const rot_dd g[], double sign, double t,
                          double *limit) {
  const size_t m = sys->cone.m;
  rot_dd c[ROT_CONE_ROWS];
  int found, proved = 0;
  double gap, good = t, bad = sign * INFINITY, step = fmax(1e-3 * fabs(t), 1e-6), part = 0.5;
  memcpy(c, sys->c, sizeof c);
  for (size_t i = 0; i < m; i++) sys->c[i] = zero();
  rot_status status = holds(sys, g, sign, &found, &gap);
  memcpy(sys->c, c, sizeof c);
  *limit = sign * INFINITY;
  if (status != ROT_OK || found) return status;
  for (int i = 0; i < 160; i++) {
    const double next = isfinite(bad) ? good + part * (bad - good) : good + sign * step;
    if (isfinite(bad) && fabs(bad - good) <= 1e-12 * fmax(fabs(good), fabs(bad))) break;
    if (fabs(next) > 1e16) return ROT_OK;
    status = holds(sys, g, next, &found, &gap);
    if (status != ROT_OK) return status;
    part = 0.5;
    if (found) {
      good = next;
    } else {
      proved = isnan(gap);
      bad = proved ? cut_of(sys, g, good, next) : next;
      if ((bad - next) * sign < 0.0) part = 0.999;
    }
    step *= 4.0;
  }
  if (proved || fabs(good) < FAR_LIMIT) *limit = good;
  return ROT_OK;
}

/* => min (sign 1) or max (sign -1) of reaction j, from known reactions: by the linear program, else
 * by a search with a separate equation for that reaction */
static rot_status range_of(const equations *eq, const rot_structure *s, size_t j, double sign,
                           const double known[], double cost[], double *limit) {
  const double x = known[j];
  rot_status status = range_by_program(eq, s, j, sign, known, cost, limit);
  if (status == ROT_OK && isnan(*limit)) {
    cone_system sys;
    rot_dd g[ROT_CONE_ROWS] = {{0.0, 0.0}};
    status = make_cone(&sys, eq, s, AS_GIVEN, 1, 0);
    if (status == ROT_OK) {
      const size_t m = sys.cone.m;
      sys.b[j * m + m - 1] = g[m - 1] = (rot_dd){1.0, 0.0};
      sys.slack[m - 1] = ulps * (fabs(x) + 1.0);
      status = extreme(&sys, g, -sign, x, limit);
    }
    free_cone(&sys);
  }
  *limit = sign > 0.0 ? fmin(*limit, x) : fmax(*limit, x);
  return status;
}

/* ---- solution -------------------------------------------------------------------------------- */

/* reaction j in units => N or N m */
static double in_newton(const equations *eq, const rot_structure *s, size_t j, double x) {
  x = ldexp(x, eq->unit.force);
  return s->reaction[j].is_couple ? ldexp(x, eq->unit.length) : x;
}

static void note_motion(const equations *eq, const double motion[6], rot_rest *rest) {
  double largest = 0.0;
  for (size_t i = 0; i < eq->m; i++) largest = fmax(largest, fabs(motion[i]));
  for (size_t i = 0; i < eq->m; i++) {
    const double part = fabs(motion[i]) > 1e-12 * largest ? motion[i] / largest : 0.0;
    const size_t row = eq->rows[i];
    if (row < 3)
      rest->velocity[row] = part;
    else
      rest->omega[row - 3] = ldexp(part, -eq->unit.length);
  }
}

/* => motion that no support prevents: that of the loads if they do work on it, else the first */
static void find_free_motion(const equations *eq, const rot_structure *s, rot_rest *rest) {
  double motion[6] = {0.0}, size = 0.0, terms = 0.0;
  for (size_t i = 0; i < eq->m; i++) terms = fmax(terms, eq->load_terms[i]);
  for (size_t j = 0; j < eq->first; j++) {
    double work = 0.0;
    for (size_t i = 0; i < eq->m; i++) work += eq->left[i * eq->m + j] * eq->load[i].hi;
    for (size_t i = 0; i < eq->m; i++) motion[i] += work * eq->left[i * eq->m + j];
    size = fmax(size, fabs(work));
  }
  rest->driven = size > s->rank_tolerance * terms;
  if (!rest->driven)
    for (size_t i = 0; i < eq->m; i++) motion[i] = eq->left[i * eq->m];
  if (eq->first) note_motion(eq, motion, rest);
}

/* 1 if a reaction violates its cone by more than its error. */
static int violates(const rot_structure *s, const double x[], const double error[]) {
  const size_t size = s->plane ? 2 : 3;
  for (size_t j = 0; j < s->reactions; j++)
    if (s->reaction[j].one_sided && !(x[j] >= -error[j])) return 1;
  for (size_t c = 0; c < s->contacts; c++) {
    const rot_contact *contact = &s->contact[c];
    const double *f = x + contact->first;
    double n = 0.0, t[3] = {0.0, 0.0, 0.0}, slack = 0.0;
    for (size_t i = 0; i < size; i++) {
      n += f[i] * contact->normal[i];
      slack += error[contact->first + i];
    }
    for (size_t i = 0; i < size; i++) t[i] = f[i] - n * contact->normal[i];
    if (!(n >= -slack)) return 1;
    if (contact->friction < INFINITY &&
        !(norm3(t) <= contact->friction * fmax(n, 0.0) + (1.0 + contact->friction) * slack))
      return 1;
  }
  return 0;
}

/* => equilibrium, stick, initial motion. A sliding motion is computed without friction: with the
 * friction cone the residual would lift the body. */
static rot_status judge(const equations *eq, const rot_structure *s, const double x[],
                        const double error[], rot_rest *rest) {
  double motion[6] = {0.0};
  const size_t redundant = eq->k - (eq->m - eq->first);
  if (rest->driven) return ROT_OK;
  if (!redundant && !violates(s, x, error)) {
    rest->rests = rest->sticks = 1;
    return ROT_OK;
  }
  rot_status status = can_rest(eq, s, AS_GIVEN, &rest->rests);
  rest->sticks = rest->rests;
  if (status != ROT_OK || rest->rests) return status;
  if (s->contacts) status = can_rest(eq, s, STICKING, &rest->sticks);
  if (status == ROT_OK) status = motion_of(eq, s, rest->sticks ? SMOOTH : STICKING, motion);
  note_motion(eq, motion, rest);
  return status;
}

/* equations => reactions (min norm, if necessary in their cones), errors, equilibrium */
static rot_status solve_in_units(const equations *eq, const rot_structure *s, rot_dd x[],
                                 double plain[], double error[], int determined[], rot_rest *rest) {
  minimum_norm(eq, x);
  errors_of(eq, x, error, determined);
  find_free_motion(eq, s, rest);
  for (size_t j = 0; j < eq->k; j++) plain[j] = x[j].hi;
  const rot_status status = judge(eq, s, plain, error, rest);
  if (status != ROT_OK || !rest->rests) return status;
  if (!violates(s, plain, error)) {
    for (size_t j = 0; j < eq->k; j++) /* rounding */
      if (s->reaction[j].one_sided) plain[j] = fmax(plain[j], 0.0);
    return ROT_OK;
  }
  rest->projected = 1;
  const rot_status pushed = push_only(eq, s, x, determined, error);
  for (size_t j = 0; j < eq->k; j++) /* exact ones: the search ends with a residual */
    if (!determined[j] || error[j] > 0.0) plain[j] = x[j].hi;
  return pushed;
}

static rot_status find_ranges(const equations *eq, const rot_structure *s, const rot_rest *rest,
                              const double x[], const int determined[], double cost[],
                              double lowest[], double highest[]) {
  rot_status status = ROT_OK;
  for (size_t j = 0; j < eq->k && status == ROT_OK; j++) {
    lowest[j] = highest[j] = rest->rests ? in_newton(eq, s, j, x[j]) : NAN;
    if (determined[j] || !rest->rests) continue;
    status = range_of(eq, s, j, 1.0, x, cost, &lowest[j]);
    if (status == ROT_OK) status = range_of(eq, s, j, -1.0, x, cost, &highest[j]);
    lowest[j] = in_newton(eq, s, j, lowest[j]);
    highest[j] = in_newton(eq, s, j, highest[j]);
  }
  return status;
}

static void note_residual(const equations *eq, const double plain[], rot_dd x[], rot_rest *rest) {
  rot_dd r[6];
  double force[3] = {0.0, 0.0, 0.0}, torque[3] = {0.0, 0.0, 0.0};
  for (size_t j = 0; j < eq->k; j++) x[j] = (rot_dd){plain[j], 0.0};
  residual(eq, x, r);
  for (size_t i = 0; i < eq->m; i++) {
    if (eq->rows[i] < 3)
      force[eq->rows[i]] = r[i].hi;
    else
      torque[eq->rows[i] - 3] = r[i].hi;
  }
  rest->residual_force = ldexp(norm3(force), eq->unit.force);
  rest->residual_torque = ldexp(ldexp(norm3(torque), eq->unit.force), eq->unit.length);
}

rot_status rot_statics_solve(const rot_structure *s, double x[], double error[], int determined[],
                             double lowest[], double highest[], rot_rest *rest) {
  equations eq;
  memset(rest, 0, sizeof *rest);
  rot_status status = set_up(&eq, s);
  const size_t room = s->reactions + 1;
  rot_dd *precise = calloc(room, sizeof *precise);
  double *cost = calloc(2 * room, sizeof *cost);
  if (!precise || !cost) status = ROT_ENOMEM;
  if (status == ROT_OK) {
    double *plain = cost + room;
    rest->equations = eq.m;
    rest->rank = eq.m - eq.first;
    memcpy(rest->sigma, eq.sigma, sizeof rest->sigma);
    memcpy(rest->about, eq.about, sizeof rest->about);
    status = solve_in_units(&eq, s, precise, plain, error, determined, rest);
    if (status == ROT_OK)
      status = find_ranges(&eq, s, rest, plain, determined, cost, lowest, highest);
    note_residual(&eq, plain, precise, rest);
    for (size_t j = 0; j < eq.k; j++) {
      x[j] = in_newton(&eq, s, j, plain[j]);
      error[j] = in_newton(&eq, s, j, error[j]);
    }
  }
  free(precise);
  free(cost);
  free_equations(&eq);
  return status;
}

/* => limits of the load factor by the linear program; NaN if it stopped or is infeasible */
static rot_status factors_by_program(const equations *eq, const rot_structure *s,
                                     const double column[], double limits[2]) {
  rot_status status = ROT_OK;
  for (int side = 0; side < 2 && status == ROT_OK; side++) {
    program p;
    const double sign = side ? -1.0 : 1.0;
    limits[side] = NAN;
    status = start_program(&p, eq, s, AS_GIVEN, NULL, NULL);
    if (status == ROT_OK) {
      push(&p, column, 1.0, sign);
      push(&p, column, -1.0, sign);
      const rot_simplex_result result = rot_simplex_solve(&p.lp);
      if (result == ROT_SIMPLEX_OPTIMAL) limits[side] = sign * p.lp.value;
      if (without_limit(&p, result)) limits[side] = -sign * INFINITY;
    }
    end_program(&p);
  }
  return status;
}

/* 1 if this load does work on a motion that no support prevents. */
static int drives(const equations *eq, const rot_structure *s, const rot_dd column[]) {
  double size = 0.0, terms = 0.0;
  for (size_t i = 0; i < eq->m; i++) terms = fmax(terms, fabs(column[i].hi));
  for (size_t j = 0; j < eq->first; j++) {
    double work = 0.0;
    for (size_t i = 0; i < eq->m; i++) work += eq->left[i * eq->m + j] * column[i].hi;
    size = fmax(size, fabs(work));
  }
  return size > s->rank_tolerance * terms;
}

/* The same by searches from a feasible factor: 1, or one found as an additional unknown. */
static rot_status factors_by_search(const equations *eq, const rot_structure *s,
                                    const rot_dd column[], int rests, double limits[2]) {
  cone_system sys;
  rot_dd g[ROT_CONE_ROWS];
  double from = 1.0, gap;
  int found = rests;
  limits[0] = limits[1] = NAN;
  rot_status status = make_cone(&sys, eq, s, AS_GIVEN, 0, 1);
  if (status == ROT_OK && drives(eq, s, column)) { /* only the factor 1 is feasible */
    if (rests) limits[0] = limits[1] = 1.0;
  } else if (status == ROT_OK) {
    const size_t m = sys.cone.m, k = eq->k;
    for (size_t i = 0; i < m; i++) {
      g[i] = rot_dd_neg(combined(eq, i, column));
      sys.b[k * m + i] = rot_dd_neg(g[i]);
    }
    if (!rests) {
      status = holds(&sys, NULL, 0.0, &found, &gap);
      from = sys.x[k].hi;
    }
    sys.cone.k = k;
    for (int side = 0; side < 2 && found && status == ROT_OK; side++)
      status = extreme(&sys, g, side ? 1.0 : -1.0, from, &limits[side]);
  }
  free_cone(&sys);
  return status;
}

/* 1 if the program's limits agree with the result for a factor of 1. NaN: it may have stopped. */
static int limits_agree(const double limits[2], int rests) {
  if (isnan(limits[0]) || isnan(limits[1])) return 0;
  return (limits[0] <= 1.0 && limits[1] >= 1.0) == (rests != 0) && !(limits[0] > limits[1]);
}

rot_status rot_statics_factors(const rot_structure *s, const int chosen[], double limits[2]) {
  equations eq;
  rot_rest rest;
  rot_dd column[6];
  double plain[6];
  memset(&rest, 0, sizeof rest);
  rot_status status = set_up(&eq, s);
  double *x = calloc(3 * eq.k + 1, sizeof *x);
  rot_dd *precise = calloc(eq.k + 1, sizeof *precise);
  int *determined = calloc(eq.k + 1, sizeof *determined);
  limits[0] = limits[1] = NAN;
  if (!x || !precise || !determined) status = ROT_ENOMEM;
  if (status == ROT_OK) status = solve_in_units(&eq, s, precise, x, x + eq.k, determined, &rest);
  if (status == ROT_OK) {
    set_loads(&eq, s, chosen, 1);
    for (size_t i = 0; i < eq.m; i++) {
      column[i] = eq.load[i];
      plain[i] = eq.load[i].hi;
    }
    set_loads(&eq, s, chosen, 0);
    status = factors_by_program(&eq, s, plain, limits);
    if (status == ROT_OK && !rest.driven && !limits_agree(limits, rest.rests))
      status = factors_by_search(&eq, s, column, rest.rests, limits);
  }
  free(x);
  free(precise);
  free(determined);
  free_equations(&eq);
  return status;
}
