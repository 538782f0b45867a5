#include "tables/collide.h"

#include <math.h>
#include <string.h>

#include "ground/real.h"

/* normal => right-handed unit axes t1, t2, n */
static void contact_axes(const double normal[3], double e[3][3]) {
  double n[3], *t1 = e[0], *t2 = e[1];
  int exponent;
  const double max = fmax(fmax(fabs(normal[0]), fabs(normal[1])), fabs(normal[2]));
  frexp(max, &exponent);
  for (int i = 0; i < 3; i++) n[i] = ldexp(normal[i], -exponent);
  const double size = sqrt(rot_dot(n, n));
  for (int i = 0; i < 3; i++) e[2][i] = n[i] / size;
  int min = 0;
  for (int i = 1; i < 3; i++)
    if (fabs(e[2][i]) < fabs(e[2][min])) min = i;
  double x[3] = {0.0, 0.0, 0.0};
  x[min] = 1.0;
  rot_cross(e[2], x, t2);
  const double length = sqrt(rot_dot(t2, t2));
  for (int i = 0; i < 3; i++) t2[i] /= length;
  rot_cross(t2, e[2], t1);
}

/* => x/d 2^exponent without intermediate overflow */
static double ratio(double x, double d, int exponent) {
  int a, b;
  const double xm = frexp(x, &a), dm = frexp(d, &b);
  return ldexp(xm / dm, a - b + exponent);
}

/* => rows of the body in G, where K = G' G: the angular response to an impulse along e_k, weighted
 * by the root of the inertia. Returns 0 for a moment about an axis without inertia. */
static int response(const rot_collide_body *body, double e[3][3], double rows[3][3]) {
  const double far = sqrt(rot_dot(body->arm, body->arm));
  for (int j = 0; j < 3; j++)
    for (int k = 0; k < 3; k++) {
      double turn[3];
      rot_cross(body->arm, e[k], turn);
      const double moment = rot_dot(body->axes[j], turn);
      if (body->moment[j] > 0.0)
        rows[j][k] = moment / sqrt(body->moment[j]);
      else if (fabs(moment) <= 1e-12 * far)
        rows[j][k] = 0.0;
      else
        return 0;
    }
  return 1;
}

/* n rows => R, upper triangular with a positive diagonal, by Givens rotations */
static void triangle(int n, double g[][3], double r[3][3]) {
  memset(r, 0, 9 * sizeof r[0][0]);
  for (int i = 0; i < n; i++) {
    double row[3] = {g[i][0], g[i][1], g[i][2]};
    for (int k = 0; k < 3; k++) {
      const double size = hypot(r[k][k], row[k]);
      if (!(size > 0.0)) continue;
      const double c = r[k][k] / size, s = row[k] / size;
      for (int j = k; j < 3; j++) {
        const double keep = r[k][j];
        r[k][j] = c * keep + s * row[j];
        row[j] = c * row[j] - s * keep;
      }
    }
  }
}

/* => velocity of the body at the point of contact */
static void velocity_at(const rot_collide_body *body, double u[3]) {
  rot_cross(body->omega, body->arm, u);
  for (int i = 0; i < 3; i++) u[i] += body->v[i];
}

static void push(const rot_collide_body *body, const double p[3], double sign, int exponent,
                 double v[3], double omega[3]) {
  double turn[3];
  rot_cross(body->arm, p, turn);
  for (int i = 0; i < 3; i++) v[i] += sign * ratio(p[i], body->mass, exponent);
  for (int j = 0; j < 3; j++) {
    if (!(body->moment[j] > 0.0)) continue;
    const double w = sign * ratio(rot_dot(body->axes[j], turn), body->moment[j], exponent);
    for (int i = 0; i < 3; i++) omega[i] += w * body->axes[j][i];
  }
}

/* The motion and the impulse; an energy may be infinite beside them. */
static int is_finite(int bodies, const rot_collide_end *end) {
  int all = 1;
  for (int i = 0; i < 3; i++) {
    all = all && isfinite(end->impulse[i]);
    for (int b = 0; b < bodies; b++)
      all = all && isfinite(end->v[b][i]) && isfinite(end->omega[b][i]);
  }
  return all;
}

rot_collide_status rot_collide(const rot_collide_input *in, rot_collide_end *end) {
  const int bodies = isfinite(in->body[1].mass) ? 2 : 1;
  double e[3][3], g[9][3], u[3], other[3] = {0.0, 0.0, 0.0}, w[3];
  memset(end, 0, sizeof *end);
  for (int b = 0; b < bodies; b++) {
    memcpy(end->v[b], in->body[b].v, sizeof end->v[b]);
    memcpy(end->omega[b], in->body[b].omega, sizeof end->omega[b]);
  }
  contact_axes(in->normal, e);
  memset(g, 0, sizeof g);
  double inverse = 0.0;
  for (int b = 0; b < bodies; b++) {
    inverse += 1.0 / in->body[b].mass;
    if (!response(&in->body[b], e, g + 3 * b)) return ROT_COLLIDE_NO_MOMENT;
  }
  for (int i = 0; i < 3; i++) g[6 + i][i] = sqrt(inverse);
  velocity_at(&in->body[0], u);
  if (bodies == 2) velocity_at(&in->body[1], other);
  for (int i = 0; i < 3; i++) u[i] -= other[i];
  for (int k = 0; k < 3; k++) w[k] = rot_dot(u, e[k]);
  if (!(isfinite(w[0]) && isfinite(w[1]) && isfinite(w[2]))) return ROT_COLLIDE_BEYOND;
  if (!(w[2] < 0.0)) return ROT_COLLIDE_OK;

  /* G in units of 2^mass, u in units of 2^speed. */
  int mass, speed;
  double max = 0.0;
  for (int i = 0; i < 9; i++)
    for (int k = 0; k < 3; k++) max = fmax(max, fabs(g[i][k]));
  if (!(max < HUGE_VAL)) return ROT_COLLIDE_BEYOND;
  frexp(max, &mass);
  frexp(fmax(fmax(fabs(w[0]), fabs(w[1])), fabs(w[2])), &speed);
  for (int i = 0; i < 9; i++)
    for (int k = 0; k < 3; k++) g[i][k] = ldexp(g[i][k], -mass);
  for (int k = 0; k < 3; k++) w[k] = ldexp(w[k], -speed);

  rot_contact contact = {.friction = in->friction, .restitution = in->restitution, .law = in->law};
  rot_contact_end flow;
  for (int j = 0; j < 3; j++)
    for (int k = 0; k < 3; k++)
      for (int i = 0; i < 6; i++) contact.k[j][k] += g[i][j] * g[i][k];
  for (int k = 0; k < 3; k++) contact.k[k][k] += ldexp(inverse, -2 * mass);
  triangle(9, g, contact.root);
  if (!rot_contact_flow(&contact, w, &flow)) return ROT_COLLIDE_BEYOND;

  const int impulse = speed - 2 * mass, energy = 2 * speed - 2 * mass;
  double p[3];
  for (int i = 0; i < 3; i++)
    p[i] = flow.p[0] * e[0][i] + flow.p[1] * e[1][i] + flow.p[2] * e[2][i];
  for (int b = 0; b < bodies; b++)
    push(&in->body[b], p, b == 0 ? 1.0 : -1.0, impulse, end->v[b], end->omega[b]);
  for (int i = 0; i < 3; i++) end->impulse[i] = ldexp(p[i], impulse);
  end->normal_impulse = ldexp(flow.p[2], impulse);
  end->friction_impulse = ldexp(hypot(flow.p[0], flow.p[1]), impulse);
  const double lost = in->law == ROT_ENERGETIC ? (1.0 - in->restitution) * (1.0 + in->restitution) *
                                                     flow.compression_work
                                               : flow.compression_work - flow.restitution_work;
  end->normal_loss = ldexp(lost, energy);
  end->friction_loss = ldexp(flow.slip_heat, energy);
  end->sticks = flow.sticks;
  return is_finite(bodies, end) ? ROT_COLLIDE_OK : ROT_COLLIDE_BEYOND;
}
