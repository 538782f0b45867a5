#include "engine/torque.h"

#include <math.h>

#include "ground/real.h"
#include "ground/search.h"

rot_torque_piece rot_torque_piece_at(const rot_torque *torque, size_t i) {
  rot_torque_piece piece = {-INFINITY, INFINITY, torque->before_n_m, torque->before_n_m};
  if (i > 0) {
    piece.start_s = torque->time_s[i - 1];
    piece.start_n_m = torque->torque_n_m[i - 1];
  }
  if (i < torque->n) {
    piece.end_s = torque->time_s[i];
    piece.end_n_m = torque->torque_n_m[i];
  }
  if (i == 0) {
    piece.end_n_m = piece.start_n_m;
  } else if (i == torque->n) {
    piece.start_n_m = piece.end_n_m = torque->after_n_m;
  }
  return piece;
}

size_t rot_torque_find(const rot_torque *torque, double t, int forward) {
  return rot_bound(torque->n, torque->time_s, t, forward); /* knots <= t (forward) or < t */
}

double rot_torque_in_piece(const rot_torque_piece *piece, double t) {
  double a = piece->start_n_m, b = piece->end_n_m;
  if (a == b || t == piece->start_s) return a;
  if (t == piece->end_s) return b;
  double left_lo, right_lo, span_lo;
  double left = rot_two_sum(t, -piece->start_s, &left_lo);
  double right = rot_two_sum(piece->end_s, -t, &right_lo);
  double span = rot_two_sum(piece->end_s, -piece->start_s, &span_lo);
  /* Each end weighted by the distance to the other: exact zeros stay zeros, and with one sign
   * nothing cancels. With two signs the sum is carried to twice the precision. */
  double from_a_lo, from_b_lo, from_a = rot_muldiv(a, right, span, &from_a_lo),
                               from_b = rot_muldiv(b, left, span, &from_b_lo);
  if ((a <= 0 && b <= 0) || (a >= 0 && b >= 0)) return from_a + from_b;
  from_a_lo += from_a * (right_lo / right - span_lo / span);
  from_b_lo += from_b * (left_lo / left - span_lo / span);
  double sum_lo, sum = rot_two_sum(from_a, from_b, &sum_lo);
  return sum + (sum_lo + (from_a_lo + from_b_lo));
}

double rot_torque_at(const rot_torque *torque, double t) {
  size_t n = torque->n;
  if (n && t == torque->time_s[n - 1]) return torque->torque_n_m[n - 1];
  rot_torque_piece piece = rot_torque_piece_at(torque, rot_torque_find(torque, t, 1));
  return rot_torque_in_piece(&piece, t);
}
