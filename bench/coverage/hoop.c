/* Do the reported errors of a bead on a turning hoop cover the true ones, and do its audits
 * balance? Random hoops without friction, with viscous drag, with dry friction and sticking, judged
 * in quadruple precision: extrapolated midpoint steps, each stop bisected.
 *
 *   hoop [scenes per class] [seed] [class] */
#include "contest.h"

#include "engine/resistance.h"
#include "scene/hoop/hoop.h"

/* ---- random scenes --------------------------------------------------------------------------- */

static void draw_hoop(sample *s) {
  const double radius = power(-1.0, 0.7), gravity = chance(0.1) ? 0.0 : 9.80665;
  set_one(s, "mass_kg", power(-2.0, 1.0));
  set_one(s, "radius_m", radius);
  set_one(s, "gravity_m_per_s2", gravity);
  set_one(s, "hoop_omega_rad_per_s",
          chance(0.15) ? 0.0 : either(sqrt(9.8 / radius) * power(-0.5, 0.5)));
  set_one(s, "theta0_rad", chance(0.2) ? either(power(-9.0, 0.0)) : uniform(-3.3, 3.3));
  set_one(s, "omega0_rad_per_s", chance(0.3) ? 0.0 : either(power(-1.0, 1.0)));
  s->accuracy = power(-12.0, -3.0);
}

static void frictionless(sample *s) {
  draw_hoop(s);
  draw_rows(s, chance(0.4) ? -power(-0.5, 1.0) : 0.0, power(-0.5, 1.0));
}

/* A sample keeps its number where a number would be. */
static void set_drag(sample *s, double x) {
  const size_t at = rot_input_named(s->c->makers->n_inputs, s->c->makers->inputs, "resistance");
  rot_resistance *r = calloc(1, sizeof *r); /* until the program ends */
  r->drag_n_s_per_m = s->x[at][0] = x;
  s->given[at] = (rot_given){.is = ROT_INPUT_RESISTANCE, .n = 1, .object = r};
}

static double drag_of(const sample *s) {
  const size_t at = rot_input_named(s->c->makers->n_inputs, s->c->makers->inputs, "resistance");
  return s->given[at].is ? s->x[at][0] : 0.0;
}

static void viscous(sample *s) {
  draw_hoop(s);
  const size_t mass = rot_input_named(s->c->makers->n_inputs, s->c->makers->inputs, "mass_kg");
  set_drag(s, s->x[mass][0] * power(-2.0, 1.0));
  draw_rows(s, 0.0, power(-0.5, 1.0));
}

/* Half of them with drag, too. */
static void dry(sample *s) {
  const double mu = power(-2.0, 0.0);
  if (chance(0.5)) {
    viscous(s);
  } else {
    frictionless(s);
    draw_rows(s, 0.0, power(-0.5, 1.0));
  }
  set_one(s, "static_friction", mu);
  if (chance(0.7)) set_one(s, "kinetic_friction", mu * uniform(0.3, 1.0));
}

/* ---- the truth ------------------------------------------------------------------------------- */

enum { ANGLE, RATE, WORK, HEAT, IMPULSE, STATE };

typedef struct body {
  quad inertia, pull, turn, drag, holds, slides;
  int sign; /* of the rate in this stretch, where friction is dry */
  int face; /* which side of the wire bears, where the hoop does not turn */
} body;

static quad in_plane(const body *b, const quad y[]) {
  const quad s = sinq(y[ANGLE]);
  return b->pull * cosq(y[ANGLE]) + y[RATE] * y[RATE] + b->turn * b->turn * s * s;
}

static quad normal_of(const body *b, const quad y[]) {
  const quad across = 2 * b->turn * cosq(y[ANGLE]) * y[RATE], in = in_plane(b, y);
  return b->turn == 0 ? b->face * in : sqrtq(in * in + across * across);
}

static quad drive_of(const body *b, const quad y[]) {
  return (b->turn * b->turn * cosq(y[ANGLE]) - b->pull) * sinq(y[ANGLE]);
}

static void slopes(const void *system, quad t, const quad y[], quad f[]) {
  const body *b = system;
  const quad torque = 2 * b->inertia * b->turn * sinq(y[ANGLE]) * cosq(y[ANGLE]) * y[RATE];
  const quad dry_ = b->slides > 0 ? b->slides * normal_of(b, y) * b->sign : 0;
  (void)t;
  f[ANGLE] = y[RATE];
  f[RATE] = drive_of(b, y) - b->drag * y[RATE] - dry_;
  f[WORK] = torque * b->turn;
  f[HEAT] = b->inertia * (b->drag * y[RATE] + dry_) * y[RATE];
  f[IMPULSE] = torque;
}

static double step(const body *b, quad d, const quad y[], quad next[]) {
  const midpoint rule = {slopes, STATE, 12, 1e-28};
  quad size[STATE];
  const quad angle = fabsq(y[ANGLE]), rate = fabsq(y[RATE]);
  size[ANGLE] = fmaxq(angle, fabsq(d) * rate);
  size[RATE] = fmaxq(rate, angle);
  size[WORK] = size[HEAT] = size[IMPULSE] = 1e300Q; /* they follow */
  const double error = midpoint_step(&rule, b, 0, d, y, size, next);
  for (int i = 0; i < STATE; i++) {
    if (!finiteq(next[i])) return INFINITY;
  }
  return error;
}

static int is_over(const body *b, const quad y[]) {
  if (b->holds == 0) return 0;
  return b->sign * y[RATE] <= 0 || (b->turn == 0 && b->face * in_plane(b, y) < 0);
}

/* What follows a stop: 1: it sticks. */
static int settle(body *b, quad y[]) {
  if (b->turn == 0) b->face = in_plane(b, y) >= 0 ? 1 : -1;
  if (fabsq(y[RATE]) > 1e-27Q) {
    b->sign = y[RATE] > 0 ? 1 : -1;
    return 0;
  }
  y[RATE] = 0;
  const quad drive = drive_of(b, y);
  if (fabsq(drive) <= b->holds * normal_of(b, y)) return 1;
  b->sign = drive > 0 ? 1 : -1;
  return 0;
}

static void note(const quad y[], answer *out) {
  out->most[0] = fmax(out->most[0], fabs((double)y[ANGLE]));
  out->most[1] = fmax(out->most[1], fabs((double)y[RATE]));
}

static int truth(const sample *s, answer *out) {
#define GIVEN(name) s->x[rot_input_named(s->c->makers->n_inputs, s->c->makers->inputs, name)][0]
  const quad mass = GIVEN("mass_kg"), radius = GIVEN("radius_m");
  const size_t kinetic =
      rot_input_named(s->c->makers->n_inputs, s->c->makers->inputs, "kinetic_friction");
  body b = {.inertia = mass * radius * radius,
            .pull = GIVEN("gravity_m_per_s2") / radius,
            .turn = GIVEN("hoop_omega_rad_per_s"),
            .drag = drag_of(s) / mass,
            .holds = GIVEN("static_friction"),
            .face = 1};
  b.slides = s->given[kinetic].is ? s->x[kinetic][0] : b.holds;
  memset(out, 0, sizeof *out);
  for (int way = -1; way <= 1; way += 2) {
    quad y[STATE] = {GIVEN("theta0_rad"), GIVEN("omega0_rad_per_s")}, t = s->start_s, h = 0.05Q;
    int sticks = b.holds > 0 && settle(&b, y), events = 0;
    long budget = 20000;
    note(y, out);
    for (int k = 0; k < ROWS; k++) {
      const int row = way > 0 ? k : ROWS - 1 - k;
      const quad target = s->rows_s[row];
      if (way * (target - (quad)s->start_s) < 0) continue;
      while (t != target && !sticks) {
        quad next[STATE], d = target - t;
        const int last = h >= fabsq(d);
        if (--budget == 0) return 1;
        if (!last) d = copysignq(h, d);
        const double error = step(&b, d, y, next);
        if (!(error < 1e-27)) {
          h = fabsq(d) / 2;
          continue;
        }
        if (is_over(&b, next)) {
          quad low = 0, high = d;
          if (++events > 500) return 1;
          for (int i = 0; i < 110; i++) {
            const quad mid = (low + high) / 2;
            step(&b, mid, y, next);
            if (is_over(&b, next)) {
              high = mid;
            } else {
              low = mid;
            }
          }
          step(&b, high, y, next);
          memcpy(y, next, sizeof next);
          t += high;
          note(y, out);
          sticks = settle(&b, y);
          continue;
        }
        memcpy(y, next, sizeof next);
        t = last ? target : t + d;
        note(y, out);
        if (!last && error < 1e-28) h *= 1.2Q;
      }
      out->theta[row][0] = y[ANGLE];
      out->omega[row][0] = y[RATE];
      for (int f = 0; f < 3; f++) out->flow[row][f] = y[WORK + f];
      t = target;
    }
  }
  return 0;
}

static const contest contests[] = {
    {"frictionless", frictionless, 0.95}, {"viscous", viscous, 0.95}, {"dry", dry, 0.95}};

int main(int argc, char **argv) {
  return run_contests("hoop", sizeof contests / sizeof *contests, contests, &rot_hoop_constraint,
                      truth, argc, argv);
}
