#include "maths/cone.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "maths/eigen.h"

enum { ROWS = ROT_CONE_ROWS, MAX_STEPS = 400 };

/* Larger friction is treated as infinite (a half-space), as in the linear program. */
static const double rough = 1e6;

/* Bounds on |x|/|c| for "no solution": in the first 100 steps and later, when rounding of the
 * Jacobian makes y grow slowly. */
static const double beyond = 1e13, late = 1e8;

/* Max residual of an equation that `blur` may allow, relative to |c|, and the residual that every
 * equation may have: one whose terms are all 0 at the solution would otherwise never hold. */
static const double max_blur = 1e-9, min_slack = 0x1p-70;

static rot_dd zero(void) { return (rot_dd){0.0, 0.0}; }

/* ---- the cone ------------------------------------------------------------------------------- */

typedef struct contact {
  rot_dd normal[3]; /* unit normal, to twice the precision */
  rot_dd push;      /* component along it */
  rot_dd across[3]; /* tangential part */
  rot_dd size;      /* |across| */
} contact;

/* (part, z) => normal and tangential components of z in that part */
static contact contact_of(const rot_cone_part *part, const rot_dd z[]) {
  contact out;
  rot_dd square = zero(), length;
  for (size_t i = 0; i < part->size; i++)
    square = rot_dd_add(square, rot_dd_mul2(part->normal[i], part->normal[i]));
  length = rot_dd_sqrt(square);
  out.push = square = zero();
  for (size_t i = 0; i < part->size; i++) {
    out.normal[i] = rot_dd_div((rot_dd){part->normal[i], 0.0}, length);
    out.push = rot_dd_add(out.push, rot_dd_mul(out.normal[i], z[part->first + i]));
  }
  for (size_t i = 0; i < part->size; i++) {
    out.across[i] = rot_dd_sub(z[part->first + i], rot_dd_mul(out.normal[i], out.push));
    square = rot_dd_add(square, rot_dd_mul(out.across[i], out.across[i]));
  }
  out.size = square.hi > 0.0 ? rot_dd_sqrt(square) : zero();
  return out;
}

/* Projection on the cone: z itself, 0, or a point of the surface. */
typedef enum place { INSIDE, APEX, SIDE } place;

static place place_of(const rot_cone_part *part, const contact *at) {
  if (!(part->friction < rough)) return at->push.hi >= 0.0 ? INSIDE : SIDE;
  if (rot_dd_sub(rot_dd_mul1(at->push, part->friction), at->size).hi >= 0.0) return INSIDE;
  return rot_dd_add(at->push, rot_dd_mul1(at->size, part->friction)).hi <= 0.0 ? APEX : SIDE;
}

/* Projects the elements of one part on its cone, in place. */
static void nearest(const rot_cone_part *part, rot_dd x[]) {
  const double mu = part->friction;
  if (part->size == 1) {
    if (!(x[part->first].hi > 0.0)) x[part->first] = zero();
    return;
  }
  const contact at = contact_of(part, x);
  const place where = place_of(part, &at);
  if (where == INSIDE) return;
  rot_dd push = zero(), ratio = {1.0, 0.0};
  if (where == SIDE && mu < rough) {
    push = rot_dd_div(rot_dd_add(at.push, rot_dd_mul1(at.size, mu)),
                      rot_dd_add1(rot_dd_mul2(mu, mu), 1.0));
    ratio = rot_dd_div(rot_dd_mul1(push, mu), at.size);
  }
  for (size_t i = 0; i < part->size; i++)
    x[part->first + i] =
        where == APEX ? zero()
                      : rot_dd_add(rot_dd_mul(at.normal[i], push), rot_dd_mul(at.across[i], ratio));
}

void rot_cone_project(const rot_cone *cone, rot_dd x[]) {
  for (size_t p = 0; p < cone->parts; p++) nearest(&cone->part[p], x);
}

/* Derivative of the projection of one part, applied to d in place. On the surface: components along
 * the normal n and the tangential direction u change together; across u, by `ratio`. */
static void derivative(const rot_cone_part *part, const rot_dd z[], double d[]) {
  if (part->size == 1) {
    if (z[part->first].hi < 0.0) d[part->first] = 0.0;
    return;
  }
  const contact at = contact_of(part, z);
  const place where = place_of(part, &at);
  const double mu = part->friction;
  double *v = d + part->first, push = 0.0, along = 0.0;
  if (where == INSIDE) return;
  for (size_t i = 0; i < part->size; i++) push += at.normal[i].hi * v[i];
  if (!(mu < rough)) {
    for (size_t i = 0; i < part->size; i++) v[i] -= at.normal[i].hi * push;
    return;
  }
  double ratio = 0.0, normal = 0.0;
  if (where == SIDE) {
    const rot_dd sum = rot_dd_add(at.push, rot_dd_mul1(at.size, mu));
    ratio = mu * sum.hi / (1.0 + mu * mu) / at.size.hi;
    for (size_t i = 0; i < part->size; i++) along += at.across[i].hi / at.size.hi * v[i];
    normal = (push + mu * along) / (1.0 + mu * mu);
  }
  for (size_t i = 0; i < part->size; i++) {
    const double n = at.normal[i].hi, u = where == SIDE ? at.across[i].hi / at.size.hi : 0.0;
    v[i] = normal * (n + mu * u) + ratio * (v[i] - push * n - along * u);
  }
}

void rot_cone_derivative(const rot_cone *cone, const rot_dd z[], const double d[], double to[]) {
  memcpy(to, d, cone->k * sizeof *to);
  for (size_t p = 0; p < cone->parts; p++) derivative(&cone->part[p], z, to);
}

/* ---- Newton's method ------------------------------------------------------------------------ */

typedef struct state {
  rot_dd y[ROWS];
  rot_dd gap[ROWS]; /* residual B x - c */
  rot_dd value;     /* |x|^2/2 - c.y */
  rot_dd *z;        /* B'y */
  rot_dd *x;        /* P(z) */
  double size;      /* |gap| */
  double excess;    /* max of |gap|/allowed residual */
  double norm;      /* |x| */
  double gain;      /* c.y */
} state;

/* s->y => the other members of s */
static void evaluate(const rot_cone *cone, state *s) {
  const size_t m = cone->m, k = cone->k;
  rot_dd square = zero(), gain = zero();
  double load = 0.0;
  for (size_t j = 0; j < k; j++) {
    rot_dd sum = zero();
    for (size_t i = 0; i < m; i++) sum = rot_dd_add(sum, rot_dd_mul(cone->b[j * m + i], s->y[i]));
    s->z[j] = s->x[j] = sum;
  }
  rot_cone_project(cone, s->x);
  for (size_t j = 0; j < k; j++) square = rot_dd_add(square, rot_dd_mul(s->x[j], s->x[j]));
  s->size = s->excess = 0.0;
  for (size_t i = 0; i < m; i++) load = hypot(load, cone->c[i].hi);
  for (size_t i = 0; i < m; i++) {
    rot_dd gap = rot_dd_neg(cone->c[i]);
    double blur = 0.0;
    for (size_t j = 0; j < k; j++) {
      gap = rot_dd_add(gap, rot_dd_mul(cone->b[j * m + i], s->x[j]));
      blur += cone->blur[j * m + i] * fabs(s->x[j].hi);
    }
    const double slack = fmax(cone->slack[i], min_slack * load);
    const double allowed = slack + fmin(blur, max_blur * load);
    s->gap[i] = gap;
    s->size = hypot(s->size, gap.hi);
    if (fabs(gap.hi) > 0.0) s->excess = fmax(s->excess, fabs(gap.hi) / allowed);
    gain = rot_dd_add(gain, rot_dd_mul(cone->c[i], s->y[i]));
  }
  s->value = rot_dd_sub(rot_dd_half(square), gain);
  s->norm = sqrt(square.hi);
  s->gain = gain.hi;
}

/* (state, weight) => Newton direction d = -(B V B' + weight)^-1 gap, by eigenvectors */
static rot_status direction_of(const rot_cone *cone, const state *s, double weight, double work[],
                               double d[ROWS]) {
  const size_t m = cone->m, k = cone->k;
  double a[ROWS * ROWS] = {0.0}, values[ROWS], vectors[ROWS * ROWS];
  double *row = work, *moved = work + k;
  for (size_t i = 0; i < m; i++) {
    for (size_t j = 0; j < k; j++) row[j] = cone->b[j * m + i].hi;
    rot_cone_derivative(cone, s->z, row, moved);
    for (size_t l = 0; l < m; l++)
      for (size_t j = 0; j < k; j++) a[i * m + l] += cone->b[j * m + l].hi * moved[j];
  }
  for (size_t i = 0; i < m; i++)
    for (size_t l = 0; l < i; l++)
      a[i * m + l] = a[l * m + i] = 0.5 * (a[i * m + l] + a[l * m + i]);
  const rot_status status = rot_eigen_symmetric(m, a, values, vectors, NULL);
  if (status != ROT_OK) return status;
  for (size_t i = 0; i < m; i++) d[i] = 0.0;
  for (size_t j = 0; j < m; j++) {
    const double value = values[j] > 1e-14 * values[m - 1] ? values[j] : 0.0; /* rounding */
    double along = 0.0;
    for (size_t i = 0; i < m; i++) along -= vectors[i * m + j] * s->gap[i].hi;
    for (size_t i = 0; i < m; i++) d[i] += vectors[i * m + j] * along / (value + weight);
  }
  return ROT_OK;
}

static void copy_state(size_t k, const state *from, state *to) {
  rot_dd *z = to->z, *x = to->x;
  *to = *from;
  to->z = z;
  to->x = x;
  memcpy(z, from->z, k * sizeof *z);
  memcpy(x, from->x, k * sizeof *x);
}

static double advance(const rot_cone *cone, const state *from, const double d[], double step,
                      state *to) {
  for (size_t i = 0; i < cone->m; i++) to->y[i] = rot_dd_add1(from->y[i], step * d[i]);
  evaluate(cone, to);
  return rot_dd_sub(to->value, from->value).hi;
}

/* (from, direction d) => state `to`, step length (0: none). Backtracks until the value meets
 * Armijo's condition, or until the residual halves where the value is at rounding level. */
static double search(const rot_cone *cone, const state *from, const double d[], state *to) {
  double slope = 0.0;
  for (size_t i = 0; i < cone->m; i++) slope += from->gap[i].hi * d[i];
  for (double step = 1.0; step > 1e-9; step *= 0.25) {
    if (advance(cone, from, d, step, to) <= 1e-4 * step * slope) return step;
    if (to->size < 0.5 * from->size && to->excess < 1e6) return step;
  }
  return 0.0;
}

/* Newton steps from now->y to the solution, a proof that there is none, or MAX_STEPS. */
static rot_status iterate(const rot_cone *cone, state *now, state *next, double work[],
                          rot_cone_result *result) {
  double weight = 1e-3, d[ROWS], reach = 0.0;
  int more = 3; /* steps after the residual is allowed, for the last digits */
  for (size_t i = 0; i < cone->m; i++) reach = hypot(reach, cone->c[i].hi);
  *result = ROT_CONE_STOPPED;
  evaluate(cone, now);
  for (int step = 0; step < MAX_STEPS; step++) {
    if (now->excess <= 1.0) *result = ROT_CONE_FOUND;
    if (!(now->size > 0.0) || (*result == ROT_CONE_FOUND && more-- == 0)) return ROT_OK;
    if (*result != ROT_CONE_FOUND && now->gain > (step < 100 ? beyond : late) * now->norm * reach) {
      *result = ROT_CONE_NONE;
      return ROT_OK;
    }
    const rot_status status = direction_of(cone, now, weight, work, d);
    if (status != ROT_OK) return status;
    const double length = search(cone, now, d, next);
    if (*result == ROT_CONE_FOUND && !(length > 0.0 && next->size < now->size)) return ROT_OK;
    if (length > 0.0) copy_state(cone->k, next, now);
    weight *= length < 1.0 ? (length > 0.0 ? 4.0 : 100.0) : 0.05;
    weight = fmin(fmax(weight, 1e-30), 1.0);
  }
  return ROT_OK;
}

rot_status rot_cone_solve(const rot_cone *cone, rot_dd y[], rot_dd x[], rot_cone_result *result,
                          double *gap) {
  const size_t k = cone->k;
  rot_dd *room = calloc(4 * k + 1, sizeof *room);
  double *work = calloc(2 * k + 1, sizeof *work);
  rot_status status = room && work ? ROT_OK : ROT_ENOMEM;
  *result = ROT_CONE_STOPPED;
  *gap = INFINITY;
  if (status == ROT_OK) {
    state now, next;
    memset(&now, 0, sizeof now);
    memset(&next, 0, sizeof next);
    now.z = room;
    now.x = room + k;
    next.z = room + 2 * k;
    next.x = room + 3 * k;
    memcpy(now.y, y, cone->m * sizeof *y);
    status = iterate(cone, &now, &next, work, result);
    memcpy(y, now.y, cone->m * sizeof *y);
    memcpy(x, now.x, k * sizeof *x);
    *gap = now.size;
  }
  free(room);
  free(work);
  return status;
}
