/* Batch kernel of scene/axle/sweep.c: a block of axles through one piece of the torque law.
 * Compiled for registers of two lanes there, of four in scene/axle/sweep_kernel.c.
 *
 * rot_axle_step(), for rows of any magnitude, has products and divisions that keep all digits: 1190
 * ns for four pieces, against 65 here and 191 by this text for doubles (ROT_ALONE). */
#ifndef ROT_AXLE_SWEEP_PASS_H
#define ROT_AXLE_SWEEP_PASS_H

#include "ground/pair.h"
#include "ground/real.h"
#include "engine/torque.h"

/* A block of axles in one piece of the torque law. */
enum { ROT_AXLE_SWEEP_BLOCK = 32 };

typedef struct rot_axle_sweep_block {
  double c[ROT_AXLE_SWEEP_BLOCK];
  double inverse[ROT_AXLE_SWEEP_BLOCK]; /* 1/I */
  double lambda[ROT_AXLE_SWEEP_BLOCK];  /* c/I */
  double scale[ROT_AXLE_SWEEP_BLOCK];   /* of the torque */
  double end_s[ROT_AXLE_SWEEP_BLOCK];   /* final time of the axle */
  double time_s[ROT_AXLE_SWEEP_BLOCK], theta[ROT_AXLE_SWEEP_BLOCK], omega[ROT_AXLE_SWEEP_BLOCK];
  double theta_error[ROT_AXLE_SWEEP_BLOCK], omega_error[ROT_AXLE_SWEEP_BLOCK];
  /* Extremes so far; worst_error: of omega. */
  double omega_max[ROT_AXLE_SWEEP_BLOCK], omega_max_time_s[ROT_AXLE_SWEEP_BLOCK];
  double omega_min[ROT_AXLE_SWEEP_BLOCK], theta_max[ROT_AXLE_SWEEP_BLOCK];
  double worst_error[ROT_AXLE_SWEEP_BLOCK];
} rot_axle_sweep_block;

/* Weights of a step in each lane. */
typedef struct weights {
  rot_pair start, reach, near, far, last; /* phi0, phi1, g1, phi2, phi3 of -z */
} weights;

/* phi3(-z), 0 <= z <= 1, by interleaved sums; truncation error below 2^-54 of the first term. */
ROT_INLINE rot_pair phi3_below_1(rot_pair z) {
#define C(x) (1 / x)
  const rot_pair zz = z * z, z4 = zz * zz, z8 = z4 * z4;
  const rot_pair p =
      (C(6.0) + zz * C(120.0)) + z4 * (C(5040.0) + zz * C(362880.0)) +
      z8 * ((C(39916800.0) + zz * C(6227020800.0)) +
            z4 * ((C(1307674368000.0) + zz * C(355687428096000.0)) + z4 * C(121645100408832000.0)));
  const rot_pair q = (C(24.0) + zz * C(720.0)) + z4 * (C(40320.0) + zz * C(3628800.0)) +
                     z8 * ((C(479001600.0) + zz * C(87178291200.0)) +
                           z4 * (C(20922789888000.0) + zz * C(6402373705728000.0)));
#undef C
  return p - z * q;
}

/* z <= 1: downward recursion from the series. */
ROT_INLINE weights weights_below(rot_pair z) {
  weights w;
  w.last = phi3_below_1(z);
  w.far = 0.5 - z * w.last;
  w.reach = 1.0 - z * w.far;
  w.near = w.reach - w.far;
  w.start = 1.0 - z * w.reach;
  return w;
}

/* z > 1: upward recursion from the exponential, which loses less than a factor of ten. */
ROT_INLINE weights weights_above(rot_pair z) {
  const rot_pair one = ROT_BOTH(1.0), max = ROT_BOTH(700.0), each = one / z;
  weights w;
  w.start = rot_pair_decay(rot_pair_if_more(z, max, max, z));
  w.reach = (one - w.start) * each;
  w.near = (w.reach - w.start) * each;
  w.far = (one - w.reach) * each;
  w.last = (0.5 - w.far) * each;
  return w;
}

/* Each lane by its own z: rows are independent. */
ROT_INLINE weights weights_of(rot_pair z) {
  const rot_pair one = ROT_BOTH(1.0);
  const int above = rot_pair_count_more(z, one);
  if (above == 0) return weights_below(z);
  if (above == ROT_PAIR) return weights_above(z);
  const weights low = weights_below(rot_pair_if_more(z, one, one, z));
  const weights high = weights_above(rot_pair_if_more(z, one, z, one));
  weights w;
  w.start = rot_pair_if_more(z, one, high.start, low.start);
  w.reach = rot_pair_if_more(z, one, high.reach, low.reach);
  w.near = rot_pair_if_more(z, one, high.near, low.near);
  w.far = rot_pair_if_more(z, one, high.far, low.far);
  w.last = rot_pair_if_more(z, one, high.last, low.last);
  return w;
}

/* Extremum of omega inside a piece, with its error. Errors of the weights: of omega at most 10
 * units (worst at z = 1), of theta 20; with products, sums, the rounding of z and a torque inside
 * the piece: 16 + 3 z and 24. g1 + phi2 = phi1.
 *
 * The extremum is where I A vanishes (I A = excess at the start): exp(c s/I) = 1 - (c/I)
 * excess/slope. From c s/I = 1 on, omega is torque/c there. */
ROT_INLINE void pass_turns(rot_axle_sweep_block *x, size_t i, rot_pair turns, rot_pair stop,
                           rot_pair s, rot_pair a, rot_pair b, rot_pair w0, rot_pair excess) {
  const rot_pair none = ROT_BOTH(0.0), one = ROT_BOTH(1.0), c = rot_load(x->c + i);
  const rot_pair lambda = rot_load(x->lambda + i);
  /* Lanes without an extremum get neutral numbers. */
  const rot_pair rise = rot_pair_if(turns, b - a, one);
  const rot_pair straight = rot_pair_if(turns, none - excess, none) * s / rise;
  const rot_pair more = lambda * straight, tiny = ROT_BOTH(1e-290);
  const rot_pair at = rot_pair_if_more(
      more, tiny, straight * (rot_pair_log1p(more) / rot_pair_if_more(more, tiny, more, one)),
      straight);
  const rot_pair inside = rot_pair_if(at, rot_pair_if_more(s, at, turns, none), none);
  const rot_pair z = lambda * at, v = at * rot_load(x->inverse + i);
  const rot_pair torque = a + (b - a) * (at / rot_pair_if(turns, s, one));
  const rot_pair max = rot_pair_max(rot_pair_abs(a), rot_pair_abs(b)), size = rot_pair_abs(w0);
  const weights w = weights_of(z);
  const rot_pair below = w0 * w.start + v * (a * w.near + torque * w.far);
  /* 1 - eps < 1: z >= 1 takes the steady state. */
  const rot_pair last = ROT_BOTH(1.0 - ROT_EPS), each = one / rot_pair_if_more(z, last, c, one);
  const rot_pair omega = rot_pair_if_more(z, last, torque * each, below);
  const rot_pair unit = ROT_BOTH(ROT_EPS);
  const rot_pair error =
      rot_load(x->omega_error + i) +
      rot_pair_if_more(z, last, 12.0 * unit * (max * each + size), 16.0 * unit * (size + v * max));
  /* The end of the step is already recorded; the extremum exceeds it, up to rounding. */
  const rot_pair top = rot_load(x->omega_max + i), when = rot_load(x->omega_max_time_s + i);
  const rot_pair beyond = rot_pair_if(excess, rot_pair_if_more(stop, when, none, inside), none);
  const rot_pair higher = rot_pair_if_more(omega, top, inside, beyond);
  rot_store(x->omega_max_time_s + i, rot_pair_if(higher, rot_load(x->time_s + i) + at, when));
  rot_store(x->omega_max + i, rot_pair_if(higher, rot_pair_max(omega, top), top));
  const rot_pair low = rot_load(x->omega_min + i), worst = rot_load(x->worst_error + i);
  rot_store(x->omega_min + i, rot_pair_if(inside, rot_pair_if_more(low, omega, omega, low), low));
  rot_store(x->worst_error + i, rot_pair_if(inside, rot_pair_max(error, worst), worst));
}

/* Each axle from its time to the end of the piece, or to its final time. A step of length 0 changes
 * nothing. */
ROT_INLINE void pass_block(rot_axle_sweep_block *x, const rot_torque_piece *piece,
                           double start_n_m) {
  const rot_pair none = ROT_BOTH(0.0), eps = ROT_BOTH(ROT_EPS), end = ROT_BOTH(piece->end_s);
  const double A = piece->start_n_m, B = piece->end_n_m;
  const double max_n_m = fabs(A) > fabs(B) ? fabs(A) : fabs(B);
  const int sloping = A != B;
  for (size_t i = 0; i < ROT_AXLE_SWEEP_BLOCK; i += ROT_PAIR) {
    const rot_pair own = rot_load(x->end_s + i), from = rot_load(x->time_s + i);
    const rot_pair stop = rot_pair_if_more(own, end, end, own), s = stop - from;
    const rot_pair scale = rot_load(x->scale + i), a = start_n_m * scale;
    rot_pair at_stop = ROT_BOTH(B);
    if (sloping && rot_pair_count_more(end, stop) > 0) {
      const rot_pair within =
          (A * (end - stop) + at_stop * (stop - piece->start_s)) / (piece->end_s - piece->start_s);
      at_stop = rot_pair_if_more(end, stop, rot_pair_if(s, within, at_stop), at_stop);
    }
    const rot_pair b = at_stop * scale;
    const rot_pair w0 = rot_load(x->omega + i), z = rot_load(x->lambda + i) * s;
    const rot_pair v = s * rot_load(x->inverse + i);
    const weights w = weights_of(z);
    const rot_pair rest = w.far - w.last;
    const rot_pair w1 = w0 * w.start + v * (a * w.near + b * w.far);
    const rot_pair theta =
        rot_load(x->theta + i) + s * (w0 * w.reach + v * (a * rest + b * w.last));
    const rot_pair max = max_n_m * rot_pair_abs(scale);
    const rot_pair size = rot_pair_abs(w0), unit = rot_pair_if(s, eps, none);
    const rot_pair before = rot_load(x->omega_error + i);
    const rot_pair error =
        before * w.start + unit * ((16.0 + 3.0 * z) * size * w.start + 16.0 * v * max * w.reach);
    const rot_pair top = rot_load(x->omega_max + i), low = rot_load(x->omega_min + i);
    rot_store(x->theta + i, theta);
    rot_store(x->theta_error + i,
              rot_load(x->theta_error + i) +
                  (s * w.reach * before +
                   unit * (24.0 * s * (size * w.reach + v * max * w.far) + rot_pair_abs(theta))));
    rot_store(x->theta_max + i, rot_pair_max(rot_load(x->theta_max + i), rot_pair_abs(theta)));
    rot_store(x->worst_error + i, rot_pair_max(rot_load(x->worst_error + i), error));
    rot_store(x->omega_max_time_s + i,
              rot_pair_if_more(w1, top, stop, rot_load(x->omega_max_time_s + i)));
    rot_store(x->omega_max + i, rot_pair_max(top, w1));
    rot_store(x->omega_min + i, rot_pair_if_more(low, w1, w1, low));
    if (sloping) {
      const rot_pair c = rot_load(x->c + i), excess = a - c * w0;
      const rot_pair turns = rot_pair_if(s, none - excess * (b - c * w1), none);
      if (rot_pair_count_more(turns, none) > 0) {
        pass_turns(x, i, turns, stop, s, a, b, w0, excess);
      }
    }
    rot_store(x->omega_error + i, error);
    rot_store(x->omega + i, w1);
    rot_store(x->time_s + i, stop);
  }
}

/* pass_block() for registers of four lanes. */
void rot_axle_sweep_pass_simd(rot_axle_sweep_block *block, const rot_torque_piece *piece,
                              double start_n_m);

#endif
