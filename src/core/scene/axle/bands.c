#include "scene/axle/bands.h"

#include <float.h>
#include <math.h>

#include "scene/axle/effects.h"
#include "scene/axle/motor.h"
#include "scene/axle/rest.h"
#include "engine/stepping.h"
#include "ground/real.h"
#include "ground/search.h"

/* The motion is a sequence of segments. In a segment the body is held, or moves in one band of
 * speed and one piece of the knots' torque, where the law is linear:
 *
 *   I v' = a + (b - a) s/span - c v,   v = omega - ref,
 *
 * c: viscous coefficient minus slope of the curve. A segment ends where v reaches an edge of the
 * band, where the piece ends, or where a torque breaks the body loose. Each segment starts at the
 * end of the previous one; enter_segment() selects its kind by the torque there. */

/* ---- bands ---------------------------------------------------------------------------------- */

/* A band. Rates are relative to `ref`, an edge of the band: the torque of a steep curve,
 * extrapolated from far to omega = 0, would lose its digits. */
typedef struct band {
  double lower, upper, ref;      /* rad/s */
  double torque_ref, torque_off; /* of the curve at ref; its error */
  double slope, slope_off;       /* of the curve; its error */
} band;

/* scene => points of the curve, their number; NULL and 0: no curve. */
static const double *speeds_of(const rot_axle_scene *scene, size_t *n) {
  *n = scene->n_terms ? (size_t)scene->terms[0].x[0] : 0;
  return *n ? scene->terms[0].x + 1 : NULL;
}

static double curve_at(const rot_axle_scene *scene, double omega) {
  if (scene->n_terms == 0) return 0.0;
  return rot_term_at(&scene->terms[0], scene->linear.start_s, 0.0, 0.0, omega);
}

/* (omega, heading) => band of omega; on an edge: the band ahead. */
static band band_of(const rot_axle_scene *scene, double omega, int heading) {
  size_t n;
  const double *speed = speeds_of(scene, &n), *torque = n ? speed + n : NULL;
  const size_t i = rot_bound(n, speed, omega, heading > 0);
  band b = {-INFINITY, INFINITY, 0.0, 0.0, 0.0, 0.0, 0.0};
  double size = 0.0;
  if (i > 0) b.lower = speed[i - 1];
  if (i < n) b.upper = speed[i];
  if (i > 0 && i < n) {
    b.slope = (torque[i] - torque[i - 1]) / (speed[i] - speed[i - 1]);
    size = fabs(torque[i]) + fabs(torque[i - 1]);
    b.slope_off = 2.0 * ROT_EPS * fabs(b.slope);
  }
  const int forward = omega > 0.0 || (omega == 0.0 && heading > 0);
  if (b.lower < 0.0 && forward) b.lower = 0.0;
  if (b.upper > 0.0 && !forward) b.upper = 0.0;
  if (b.lower != 0.0 && b.upper != 0.0) {
    b.ref = omega - b.lower <= b.upper - omega ? b.lower : b.upper;
    b.torque_ref = torque[b.ref == b.lower ? i - 1 : i];
  } else {
    b.torque_ref = curve_at(scene, 0.0);
    b.torque_off = 3.0 * ROT_EPS * size;
  }
  return b;
}

static int on_edge(const rot_axle_scene *scene, double omega) {
  size_t n;
  const double *speed = speeds_of(scene, &n);
  const size_t i = rot_upper_bound(n, speed, omega);
  return i > 0 && speed[i - 1] == omega;
}

/* ---- a motion in one band and one piece ------------------------------------------------------ */

typedef struct segment {
  const rot_axle_rest *rest; /* its base: start of the segment */
  band band;
  rot_axle_params law; /* of v = omega - ref: I, c minus slope */
  rot_axle_state from;
  double push, push_lo; /* constant torque of the band: curve, resistance at ref, friction */
  double a, b;          /* torque in the band at start and end */
  double span_s;
  int to_end;       /* 1: the span reaches the end of the piece or the last row */
  double low, high; /* edges of v */
  double farthest;  /* larger one of |v| at the base and at the extremum */
} segment;

static double push_of(const rot_axle_scene *scene, double omega, double curve, int sign,
                      double *lo) {
  double drag_lo, e1, e2;
  const double drag = rot_two_prod(scene->linear.viscous_n_m_s, omega, &drag_lo);
  const double one = rot_two_sum(curve, -drag, &e1);
  const double push = rot_two_sum(one, -sign * scene->coulomb_n_m, &e2);
  *lo = e1 + e2 - drag_lo;
  return push;
}

/* x + push with one rounding. */
static double add_push(double x, double push, double push_lo) {
  double lo, sum = rot_two_sum(x, push, &lo);
  return sum + (lo + push_lo);
}

static double in_band(const segment *l, double x) { return add_push(x, l->push, l->push_lo); }

/* Change of the knots' torque in a time, within a few roundings. */
static double rise_in(const rot_torque_piece *piece, double time_s) {
  const double rise = piece->end_n_m - piece->start_n_m;
  return rise != 0.0 ? rot_muldiv(rise, time_s, piece->end_s - piece->start_s, NULL) : 0.0;
}

/* Torque of the knots at the base, with its time in twice the precision. */
static double knots_at_base(const rot_axle_rest *rest) {
  const double tau = rot_torque_in_piece(&rest->piece, rest->base.time_s);
  return rest->base.time_lo != 0.0 ? tau + rise_in(&rest->piece, rest->base.time_lo) : tau;
}

/* Sign of the net torque at the time of the base and a speed; if 0: sign of its change. */
static int heading_at(const rot_axle_rest *rest, double omega) {
  double lo,
      push = push_of(rest->scene, omega, curve_at(rest->scene, omega), omega > 0.0 ? 1 : -1, &lo);
  const double net = add_push(knots_at_base(rest), push, lo);
  if (net != 0.0) return net > 0.0 ? 1 : -1;
  return rest->piece.end_n_m >= rest->piece.start_n_m ? 1 : -1;
}

/* Limit of |c| s/I in a step for c < 0: exp() does not overflow. */
enum { MAX_EXPONENT = 200 };

/* (base, heading) => segment: band, law, torques, span. */
static segment segment_from(const rot_axle_rest *rest, int heading) {
  const rot_axle_base *base = &rest->base;
  const rot_torque_piece *piece = &rest->piece;
  segment l = {.rest = rest};
  const double end_s = fmin(piece->end_s, rest->last_s);
  double lo;
  l.band = band_of(rest->scene, base->omega, heading);
  l.push =
      push_of(rest->scene, l.band.ref, l.band.torque_ref, l.band.lower >= 0.0 ? 1 : -1, &l.push_lo);
  l.law.inertia_kg_m2 = rest->scene->linear.inertia_kg_m2;
  l.law.viscous_n_m_s = rest->scene->linear.viscous_n_m_s - l.band.slope;
  l.from.omega_rad_per_s = rot_two_sum(base->omega, -l.band.ref, &l.from.omega_lo);
  l.from.omega_error = base->omega_error;
  l.a = in_band(&l, knots_at_base(rest));
  if (base->omega == 0.0) { /* from rest: rounding must not reverse it */
    l.a = heading > 0 ? fmax(l.a, 0.0) : fmin(l.a, 0.0);
  }
  l.b = in_band(&l, rot_torque_in_piece(piece, end_s));
  l.span_s = rot_axle_rest_elapsed(rest, end_s, &lo);
  l.to_end = 1;
  l.low = l.band.lower - l.band.ref;
  l.high = l.band.upper - l.band.ref;
  const double I = l.law.inertia_kg_m2, c = l.law.viscous_n_m_s;
  const int moves = l.from.omega_rad_per_s != 0.0 || l.a != 0.0 || l.b != 0.0;
  if (c < 0.0 && moves && rot_muldiv(-c, l.span_s, I, NULL) > MAX_EXPONENT) {
    const double shorter = rot_muldiv(MAX_EXPONENT, I, -c, NULL);
    l.b = l.a + (l.b - l.a) * (shorter / l.span_s);
    l.span_s = shorter;
    l.to_end = 0;
  }
  return l;
}

/* v after s with the torque b there. Exact absolute times avoid one residual. */
static rot_axle_state segment_state(const segment *l, double from_s, double to_s, double b) {
  const rot_torque_piece piece = {from_s, to_s, l->a, b};
  rot_axle_state from = l->from;
  from.time_s = from_s;
  return rot_axle_step(&l->law, &from, &piece, to_s);
}

static double torque_after(const segment *l, double s) {
  if (s >= l->span_s) return l->b;
  return l->a + (l->b - l->a) * (s / l->span_s);
}

static rot_axle_state segment_after(const segment *l, double s) {
  return segment_state(l, 0.0, s, torque_after(l, s));
}

/* Error of omega after s due to an error x of the torque: x (s/I) phi1. */
static double response(const segment *l, double x, double s) {
  const double I = l->law.inertia_kg_m2, c = l->law.viscous_n_m_s;
  if (!(x > 0.0 && s > 0.0)) return x * s; /* 0 or NaN */
  const double z = rot_muldiv(c, s, I, NULL);
  if (z > 1.0) return x / c;
  return rot_product(3, (double[]){x, s, z != 0.0 ? -expm1(-z) / z : 1.0}, I);
}

/* state v after s => change from the base. Adds errors not included in rot_axle_step(): rounding of
 * its coefficients and, with inexact_s, of s. v has one sign in a band: |theta of v| is the
 * integral of |v|. */
static rot_axle_change segment_change(const segment *l, const rot_axle_state *v, double s, double b,
                                      int inexact_s) {
  const double I = l->law.inertia_kg_m2, c = l->law.viscous_n_m_s;
  rot_axle_change out;
  double off = l->band.torque_off;
  if (l->a != b && (l->push != 0.0 || inexact_s)) {
    off += 4.0 * ROT_EPS * (fabs(l->a) + fabs(b) + 2.0 * fabs(l->push));
  }
  double wrong = response(l, off, s), turned_off = wrong * s;
  if (l->band.slope != 0.0) {
    const double off_c = l->band.slope_off + ROT_EPS * (fabs(l->rest->scene->linear.viscous_n_m_s) +
                                                        fabs(l->band.slope));
    wrong += response(l, off_c * fmax(l->farthest, fabs(v->omega_rad_per_s)), s);
    turned_off += response(l, off_c * fabs(v->theta_rad), s);
  }
  if (inexact_s) { /* by the net torque at the end */
    const double net = fabs(b - c * v->omega_rad_per_s);
    wrong += 2.0 * ROT_EPS * rot_muldiv(net, s, I, NULL);
    turned_off += 2.0 * ROT_EPS * fabs(v->omega_rad_per_s * s);
  }
  const double carried = l->band.ref * s;
  out.omega = l->band.ref + v->omega_rad_per_s;
  out.dtheta = carried + (v->theta_rad + v->theta_lo);
  out.omega_error = v->omega_error + wrong + (l->band.ref != 0.0 ? ROT_EPS * fabs(out.omega) : 0.0);
  out.theta_error = l->rest->base.theta_error + v->theta_error + turned_off +
                    2.0 * ROT_EPS * fabs(carried) +
                    ROT_EPS * fabs(l->rest->base.theta + out.dtheta);
  return out;
}

/* ---- end of a segment ------------------------------------------------------------------------ */

/* How v leaves the band. AGAINST: by the edge it starts from. */
typedef enum exit_side { NOWHERE, BELOW, ABOVE, AGAINST } exit_side;

typedef struct exit_point {
  double s; /* time since the base; the span if v does not leave */
  exit_side side;
  double peak; /* extremum of v before it, or v at the start */
} exit_point;

/* x log1p(y)/y with y = x c/I: time of a linear law for the change that a constant one makes in
 * x. */
static double linear_time(const segment *l, double x, double sign) {
  const double I = l->law.inertia_kg_m2, c = l->law.viscous_n_m_s;
  double y = sign * rot_muldiv(x, c, I, NULL);
  if (!(y > -1.0)) return INFINITY;
  if (fabs(y) < 1.0) return y != 0.0 ? x * (log1p(y) / y) : x;
  if (y > DBL_MAX) y = DBL_MAX;
  return sign * rot_muldiv(log1p(y), I, c, NULL);
}

/* Time at which omega' is 0; there is at most one. */
static double extremum(const segment *l) {
  const double c = l->law.viscous_n_m_s, v0 = l->from.omega_rad_per_s;
  const double net = l->a - c * v0, rise = l->b - l->a;
  if (!((net > 0.0 && rise < 0.0) || (net < 0.0 && rise > 0.0))) return INFINITY;
  return linear_time(l, rot_muldiv(-net, l->span_s, rise, NULL), 1.0);
}

/* Net torque I v' after s, without the difference b - c v, which is pure rounding once v has
 * settled. */
static double net_after(const segment *l, double s) {
  const double I = l->law.inertia_kg_m2, c = l->law.viscous_n_m_s;
  const double z = rot_muldiv(c, s, I, NULL), rise = torque_after(l, s) - l->a;
  const double spread = z != 0.0 ? -expm1(-z) / z : 1.0;
  return (l->a - c * l->from.omega_rad_per_s) * exp(-z) + (rise != 0.0 ? rise * spread : 0.0);
}

/* Time at which v reaches the level under the present torque; exact if it is constant. */
static double first_guess(const segment *l, double level) {
  const double I = l->law.inertia_kg_m2, c = l->law.viscous_n_m_s, v0 = l->from.omega_rad_per_s;
  const double now = l->a - c * v0, then = l->a - c * level;
  /* An argument of log1p() near -1 loses its digits; 1 + argument is then/now. */
  if (c > 0.0 && then / now < 0.5 && then / now > 0.0) {
    return rot_muldiv(log(now / then), I, c, NULL);
  }
  return linear_time(l, rot_muldiv(I, level - v0, now, NULL), -1.0);
}

/* Solves v(s) = level in a bracket where v - level changes its sign: Newton's steps inside the
 * bracket, else bisection, geometric or by a fixed factor if the bracket starts at 0. */
static double when_at(const segment *l, double level, double s_lo, double s_hi, int rising) {
  segment alone = *l;
  double s = first_guess(l, level);
  alone.from.omega_error = 0.0; /* omega_error: rounding of this step only */
  if (!(s > s_lo && s < s_hi)) s = 0.5 * (s_lo + s_hi);
  for (int i = 0; i < 300; i++) {
    const rot_axle_state at = segment_after(&alone, s);
    const double f = (at.omega_rad_per_s - level) + at.omega_lo;
    /* Finally f is pure rounding. */
    if (f == 0.0 || (i > 8 && fabs(f) <= at.omega_error)) return s;
    if ((f > 0.0) == rising) {
      s_hi = s;
    } else {
      s_lo = s;
    }
    double next = s - rot_muldiv(f, l->law.inertia_kg_m2, net_after(l, s), NULL);
    if (fabs(next - s) <= 2.0 * ROT_EPS * s) return next;
    if (!(next > s_lo && next < s_hi)) {
      next = s_lo > 0.0 && s_hi > 4.0 * s_lo ? sqrt(s_lo) * sqrt(s_hi)
             : s_lo == 0.0 && i > 20         ? s_hi * 0x1p-8
                                             : 0.5 * (s_lo + s_hi);
      if (next == s_lo || next == s_hi) return next;
    }
    s = next;
  }
  return s;
}

/* v monotonic on [s0, s1] => 1 if it crosses an edge, time. A start on an edge counts as a crossing
 * only beyond the error of the step. */
static int leaves(const segment *l, double s0, double v0, double s1, const rot_axle_state *to,
                  int touching, exit_point *out) {
  const double v1 = to->omega_rad_per_s;
  const int up = v1 > v0;
  const double edge = up ? l->high : l->low;
  if (up ? !(v1 > edge || (touching && v1 == edge)) : !(v1 < edge || (touching && v1 == edge))) {
    return 0;
  }
  if (s0 == 0.0 && v0 == edge) {
    if (!(fabs(v1 - edge) > 2.0 * to->omega_error)) return 0;
    out->side = AGAINST;
    out->s = 0.0;
    return 1;
  }
  out->side = up ? ABOVE : BELOW;
  out->s = v1 == edge ? s1 : when_at(l, edge, s0, s1, up);
  return 1;
}

/* A line so steep that v settles within its error of an edge: the torque on the edge, which is
 * exact, decides whether v reaches it. */
static void look_past_edge(const segment *l, double s0, double v, const rot_axle_state *end,
                           exit_point *out) {
  if (l->band.slope == 0.0) return;
  const double near = 2.0 * segment_change(l, end, l->span_s, l->b, 0).omega_error;
  const int up = fabs(end->omega_rad_per_s - l->high) < fabs(end->omega_rad_per_s - l->low);
  const double edge = up ? l->high : l->low;
  const double omega = up ? l->band.upper : l->band.lower;
  const rot_torque_piece *piece = &l->rest->piece;
  if (!(fabs(end->omega_rad_per_s - edge) <= near) || omega == 0.0 || v == edge) return;
  if (piece->start_n_m != piece->end_n_m) return;
  if (heading_at(l->rest, omega) != (up ? 1 : -1)) return;
  out->side = up ? ABOVE : BELOW;
  out->s = s0;
  if (fabs(v - edge) > near) {
    out->s = when_at(l, up ? edge - near : edge + near, s0, l->span_s, up);
  }
}

static exit_point exit_of(const segment *l) {
  const double v0 = l->from.omega_rad_per_s, turn = extremum(l);
  exit_point out = {l->span_s, NOWHERE, v0};
  double s0 = 0.0, v = v0;
  if (turn > 0.0 && turn < l->span_s) {
    const rot_axle_state at = segment_after(l, turn);
    if (leaves(l, s0, v, turn, &at, 1, &out)) return out;
    s0 = turn;
    v = out.peak = at.omega_rad_per_s;
  }
  const rot_axle_state end = segment_after(l, l->span_s);
  if (!leaves(l, s0, v, l->span_s, &end, 0, &out)) look_past_edge(l, s0, v, &end, &out);
  return out;
}

/* ---- segments -------------------------------------------------------------------------------- */

/* State of a run: a segment, which is a motion in one band, or a hold at rest. */
typedef struct bands_run {
  rot_axle_rest rest;
  size_t segments;        /* number so far in this piece */
  int held;               /* 1: hold, 0: motion */
  segment segment;        /* motion */
  exit_point to;          /* motion: exit from the band */
  int slips;              /* hold: direction of breaking loose; 0: not in this piece */
  double slip_s, slip_lo; /* hold: time of breaking loose */
  double late_s;          /* hold: error of that time */
} bands_run;

/* base => motion in its band. heading: used if it starts on an edge. */
static void begin_motion(bands_run *run, int heading, int slipped) {
  rot_axle_rest *rest = &run->rest;
  segment l = segment_from(rest, heading);
  if (slipped) l.a = heading * (rest->scene->static_n_m - rest->scene->coulomb_n_m);
  exit_point to = exit_of(&l);
  if (to.side == AGAINST) {
    if (rest->base.omega != 0.0) {
      l = segment_from(rest, -heading);
      to = exit_of(&l);
    }
    if (to.side == AGAINST) {
      to.side = NOWHERE;
      to.s = l.span_s;
    }
  }
  l.farthest = fmax(fabs(l.from.omega_rad_per_s), fabs(to.peak));
  if (to.peak != l.from.omega_rad_per_s) rot_note_state(rest->info, 0.0, l.band.ref + to.peak);
  run->held = 0;
  run->segment = l;
  run->to = to;
}

/* End of a hold => motion. Adds to the errors the speed gained until the latest time of breaking
 * loose, limited by strong resistance. */
static rot_status break_loose(bands_run *run) {
  rot_axle_rest *rest = &run->rest;
  rot_axle_base *base = &rest->base;
  const rot_axle_scene *scene = rest->scene;
  const double I = scene->linear.inertia_kg_m2, max = scene->static_n_m, late = run->late_s;
  const double push = max - scene->coulomb_n_m, more = fabs(rise_in(&rest->piece, late));
  const double c = scene->linear.viscous_n_m_s - band_of(scene, 0.0, run->slips).slope;
  double ahead = rot_muldiv(push, late, I, NULL) + 0.5 * rot_muldiv(more, late, I, NULL);
  if (c > 0.0) ahead = fmin(ahead, (push + more) / c);
  base->omega_error += ahead;
  base->theta_error += base->omega_error * late;
  int heading = run->slips;
  const double above = nextafter(heading * max, heading * DBL_MAX);
  const rot_status status = rot_axle_rest_decide(rest, above, &heading);
  begin_motion(run, heading, 1);
  return status;
}

/* base => hold until the end of the piece, or until the torque exceeds static friction. */
static rot_status begin_hold(bands_run *run) {
  rot_axle_rest *rest = &run->rest;
  const rot_torque_piece *piece = &rest->piece;
  const rot_axle_base *base = &rest->base;
  const double max = rest->scene->static_n_m, at_rest = curve_at(rest->scene, 0.0);
  const double rise = piece->end_n_m - piece->start_n_m, span = piece->end_s - piece->start_s;
  run->held = 1;
  run->slips = (rise > 0.0) - (rise < 0.0);
  if (!(run->slips * (piece->end_n_m + at_rest) > max)) run->slips = 0;
  if (run->slips == 0) return ROT_OK;
  double lo, time_lo, now_lo;
  const double x = rot_muldiv(run->slips * max - at_rest - piece->start_n_m, span, rise, &lo);
  run->slip_s = rot_two_sum(piece->start_s, x, &time_lo);
  run->slip_lo = time_lo + lo;
  const double size = max + fabs(at_rest) + fabs(piece->start_n_m);
  run->late_s = 4.0 * ROT_EPS * (rot_muldiv(size, span, fabs(rise), NULL) + fabs(x));
  const double now =
      rot_two_sum(run->slip_s, -base->time_s, &now_lo) + (now_lo + run->slip_lo - base->time_lo);
  return now > 0.0 ? ROT_OK : break_loose(run);
}

/* base => hold or motion by the torque there, events. */
static rot_status enter_segment(bands_run *run) {
  rot_axle_rest *rest = &run->rest;
  const rot_axle_scene *scene = rest->scene;
  const rot_axle_base *base = &rest->base;
  /* Limit of the number of segments: omega' changes its sign once per piece without rest, and once
   * more per stop; each edge is reached a few times at most. */
  size_t n;
  (void)speeds_of(scene, &n);
  if (rot_axle_rest_enter(rest)) run->segments = 0;
  if (run->segments++ == 1000 + 16 * n) return ROT_EBUDGET;
  int heading = base->omega > 0.0 ? 1 : -1;
  if (base->omega == 0.0) {
    const double applied = knots_at_base(rest) + curve_at(scene, 0.0);
    const rot_status status = rot_axle_rest_decide(rest, applied, &heading);
    if (status != ROT_OK) return status;
    if (!heading) return begin_hold(run);
  } else if (on_edge(scene, base->omega)) {
    heading = heading_at(rest, base->omega);
  }
  begin_motion(run, heading, 0);
  return ROT_OK;
}

static rot_status restart(void *model, int forward) {
  return forward ? enter_segment(model) : ROT_EVALUE;
}

static double hold_end(const bands_run *run) {
  const double end_s = run->rest.piece.end_s;
  return run->slips ? fmin(run->slip_s, end_s) : end_s;
}

static int holds(const void *model, double time_s) {
  const bands_run *run = model;
  double lo;
  if (run->held) return time_s < hold_end(run);
  if (!(time_s < run->rest.piece.end_s)) return 0;
  if (run->to.side == NOWHERE && run->segment.to_end) return 1;
  return !(rot_axle_rest_elapsed(&run->rest, time_s, &lo) >= run->to.s);
}

/* Row i, moving or held. */
static rot_status write_row(void *model, size_t i) {
  bands_run *run = model;
  rot_axle_rest *rest = &run->rest;
  if (run->held) return rot_axle_rest_held_row(rest, i);
  const rot_axle_base *base = &rest->base;
  const segment *l = &run->segment;
  const double t = rest->time_s[i];
  double lo, s = rot_axle_rest_elapsed(rest, t, &lo);
  const int exact = base->time_lo == 0.0;
  const double b = in_band(l, rot_torque_in_piece(&rest->piece, t));
  const rot_axle_state v =
      exact ? segment_state(l, base->time_s, t, b) : segment_state(l, 0.0, s, b);
  rot_axle_change row = segment_change(l, &v, s, b, !exact);
  if (s == 0.0) row.omega = base->omega;
  return rot_axle_rest_row(rest, i, &row,
                           rot_axle_scene_applied(rest->scene, t, base->theta, 0.0, row.omega));
}

/* Error of the time of a stop, from the error of omega and the net torque; if the torques balance:
 * from its rate of change. */
static double settling_time(const segment *l, double net, double omega_error) {
  const rot_torque_piece *piece = &l->rest->piece;
  const double I = l->law.inertia_kg_m2, rise = fabs(piece->end_n_m - piece->start_n_m);
  const double inertia_over_rate =
      rise > 0.0 ? rot_muldiv(I, piece->end_s - piece->start_s, rise, NULL) : (double)INFINITY;
  return fmin(rot_muldiv(omega_error, I, net, NULL),
              sqrt(2.0 * omega_error) * sqrt(inertia_over_rate));
}

/* motion => base at its end: on the edge, or at the end of the piece. */
static rot_status finish_motion(bands_run *run) {
  rot_axle_rest *rest = &run->rest;
  rot_axle_base *base = &rest->base;
  const segment *l = &run->segment;
  const exit_point *to = &run->to;
  const double s = to->s, b = torque_after(l, s);
  const int exact = to->side == NOWHERE && l->to_end && base->time_lo == 0.0;
  const rot_axle_state v =
      exact ? segment_state(l, base->time_s, rest->piece.end_s, l->b) : segment_state(l, 0.0, s, b);
  rot_axle_change end = segment_change(l, &v, s, b, !exact);
  double time = rest->piece.end_s, time_lo = 0.0, wanted = end.omega;
  if (to->side != NOWHERE) {
    wanted = to->side == ABOVE ? l->band.upper : l->band.lower;
  } else { /* rounding must not leave the band */
    wanted = fmin(fmax(wanted, l->band.lower), l->band.upper);
  }
  if (to->side != NOWHERE || !l->to_end) {
    time = rot_two_sum(base->time_s, s, &time_lo);
    time_lo += base->time_lo;
  }
  if (wanted != end.omega) end.omega_error += fabs(wanted - end.omega);
  if (wanted == 0.0) {
    const double net = fabs(b - l->law.viscous_n_m_s * v.omega_rad_per_s);
    base->settle_s = settling_time(l, net, end.omega_error);
  }
  if (!isnan(end.omega)) end.omega = wanted;
  return rot_axle_rest_move(rest, time, time_lo, &end);
}

/* End of the present segment, next segment. */
static rot_status next_piece(void *model, double *end_s) {
  bands_run *run = model;
  rot_axle_base *base = &run->rest.base;
  const int breaks_loose = run->held && run->slips != 0;
  rot_status status = ROT_OK;
  if (run->held) {
    rot_axle_rest_hold(&run->rest, hold_end(run));
  } else {
    status = finish_motion(run);
  }
  *end_s = base->time_s;
  if (status != ROT_OK || !breaks_loose) return status != ROT_OK ? status : enter_segment(run);
  base->time_s = rot_two_sum(run->slip_s, run->slip_lo, &base->time_lo);
  base->omega_error = 0.0;
  return break_loose(run);
}

/* ---- the model ------------------------------------------------------------------------------ */

static int fits(const rot_axle_scene *scene, double last_s) {
  const rot_term *curve = scene->terms;
  if (scene->n_terms > 1) return 0;
  if (scene->n_terms == 1) {
    if (!(curve->from_s <= scene->linear.start_s && curve->to_s > last_s)) return 0;
    if (!rot_term_valid(curve)) return 0;
  }
  return rot_axle_fits(scene, ROT_AXLE_BANDS_TAKES) && scene->coulomb_n_m >= 0.0 &&
         scene->static_n_m >= scene->coulomb_n_m;
}

rot_status rot_axle_bands(const rot_axle_scene *scene, size_t n, const double time_s[],
                          const rot_axle_columns *out, rot_events *events, const rot_hooks *hooks,
                          rot_info *info) {
  static const rot_stepping stepping = {restart, holds, next_piece, write_row, NULL};
  bands_run run = {.rest = rot_axle_rest_from(scene, n, time_s, out, events, info)};
  if (n > 0 && !fits(scene, time_s[n - 1])) return info->status = ROT_EVALUE;
  rot_step_rows(&stepping, &run, scene->linear.start_s, n, time_s, hooks, info);
  rot_axle_motor_error(scene, n, time_s, info);
  return info->status;
}
