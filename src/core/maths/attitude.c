#include "maths/attitude.h"

#include <math.h>

#include "ground/real.h"

int rot_attitude_numbers(rot_attitude_form form) {
  static const int numbers[ROT_FORM_COUNT] = {4, 9, 3, 4, 3, 3};
  return numbers[form];
}

/* ---- vectors --------------------------------------------------------------------------------- */

/* n numbers => their length, without over- or underflow */
static double length_of(int n, const double x[]) {
  double max = 0.0, sum = 0.0;
  int e;
  for (int i = 0; i < n; i++) {
    if (isnan(x[i])) return NAN;
    max = fmax(max, fabs(x[i]));
  }
  if (max == 0.0 || isinf(max)) return max;
  if (max > 1e-100 && max < 1e100) { /* same bits as the scaled sum below */
    for (int i = 0; i < n; i++) sum += x[i] * x[i];
    return sqrt(sum);
  }
  (void)frexp(max, &e);
  for (int i = 0; i < n; i++) {
    const double scaled = ldexp(x[i], -e);
    sum += scaled * scaled;
  }
  return ldexp(sqrt(sum), e);
}

double rot_attitude_unit(double q[4]) {
  int e;
  const double length = length_of(4, q);
  if (length == 1.0) return length;
  if (isinf(length) && isfinite(q[0]) && isfinite(q[1]) && isfinite(q[2]) && isfinite(q[3])) {
    for (int i = 0; i < 4; i++) q[i] *= 0.25;
    (void)rot_attitude_unit(q);
    return length;
  }
  if (!(length > 0.0) || isinf(length)) {
    for (int i = 0; i < 4; i++) q[i] = NAN;
    return length;
  }
  (void)frexp(length, &e);
  const double scaled = rot_ldexp(length, -e);
  for (int i = 0; i < 4; i++) q[i] = rot_ldexp(q[i], -e) / scaled;
  return length;
}

void rot_attitude_times(const double p[4], const double q[4], double out[4]) {
  const double w = p[0] * q[0] - p[1] * q[1] - p[2] * q[2] - p[3] * q[3];
  const double x = p[0] * q[1] + p[1] * q[0] + p[2] * q[3] - p[3] * q[2];
  const double y = p[0] * q[2] + p[2] * q[0] + p[3] * q[1] - p[1] * q[3];
  const double z = p[0] * q[3] + p[3] * q[0] + p[1] * q[2] - p[2] * q[1];
  out[0] = w;
  out[1] = x;
  out[2] = y;
  out[3] = z;
}

/* v + 2 u x (u x v + w v) */
static void turn(double w, double x, double y, double z, const double v[3], double out[3]) {
  const double a = y * v[2] - z * v[1] + w * v[0];
  const double b = z * v[0] - x * v[2] + w * v[1];
  const double c = x * v[1] - y * v[0] + w * v[2];
  const double along[3] = {v[0], v[1], v[2]};
  out[0] = along[0] + 2.0 * (y * c - z * b);
  out[1] = along[1] + 2.0 * (z * a - x * c);
  out[2] = along[2] + 2.0 * (x * b - y * a);
}

void rot_attitude_to_space(const double q[4], const double v[3], double out[3]) {
  turn(q[0], q[1], q[2], q[3], v, out);
}

void rot_attitude_to_body(const double q[4], const double v[3], double out[3]) {
  turn(q[0], -q[1], -q[2], -q[3], v, out);
}

/* ---- rotation between two attitudes ---------------------------------------------------------- */

/* (p, q) => p* q, the rotation from p to q */
static void from_to(const double p[4], const double q[4], double out[4]) {
  const double back[4] = {p[0], -p[1], -p[2], -p[3]};
  rot_attitude_times(back, q, out);
}

double rot_attitude_angle(const double p[4], const double q[4]) {
  double d[4];
  from_to(p, q, d);
  return 2.0 * atan2(length_of(3, d + 1), fabs(d[0]));
}

void rot_attitude_slerp(const double p[4], const double q[4], double fraction, double out[4]) {
  double d[4];
  from_to(p, q, d);
  const double sign = d[0] < 0.0 ? -1.0 : 1.0, sine = length_of(3, d + 1);
  const double half = atan2(sine, fabs(d[0])) * fraction;
  const double by = sine > 0.0 ? sign * sin(half) / sine : 0.0;
  d[0] = cos(half);
  for (int i = 1; i < 4; i++) d[i] *= by;
  rot_attitude_times(p, d, out);
  (void)rot_attitude_unit(out);
}

/* ---- other forms => quaternions -------------------------------------------------------------- */

/* (axis, angle) => cos(angle/2), sin(angle/2) axis/length */
static void about(const double axis[3], double length, double angle, double q[4]) {
  const double sine = sin(0.5 * angle);
  q[0] = cos(0.5 * angle);
  for (int i = 0; i < 3; i++) q[1 + i] = sine * (axis[i] / length);
}

static void from_vector(const double x[3], double q[4]) {
  const double angle = length_of(3, x);
  if (angle == 0.0) {
    q[0] = 1.0;
    q[1] = q[2] = q[3] = 0.0;
  } else {
    about(x, angle, angle, q);
  }
}

/* s => (1 - s^2, 2 s)/(1 + s^2); for |s| > 1 from the shadow set -s/s^2, the same attitude */
static void from_rodrigues(const double x[3], double q[4]) {
  const double s = length_of(3, x), inner = s > 1.0 ? 1.0 / s : s;
  const double half = 2.0 * atan(inner);
  q[0] = s > 1.0 ? -cos(half) : cos(half);
  for (int i = 0; i < 3; i++) q[1 + i] = s > 0.0 ? sin(half) * (x[i] / s) : 0.0;
}

static void from_euler(const double x[3], const rot_euler *sequence, double q[4]) {
  double p[4] = {1.0, 0.0, 0.0, 0.0};
  for (int i = 0; i < 3; i++) {
    double one[4] = {cos(0.5 * x[i]), 0.0, 0.0, 0.0};
    one[1 + sequence->axis[i]] = sin(0.5 * x[i]);
    if (sequence->intrinsic) {
      rot_attitude_times(p, one, p);
    } else {
      rot_attitude_times(one, p, p);
    }
  }
  for (int i = 0; i < 4; i++) q[i] = p[i];
}

/* R => max element of |R'R - 1|, Inf for a reflection; `nearest`: R after one Newton step towards
 * an orthogonal matrix */
static double off_rotation(const double r[9], double nearest[9]) {
  double off = 0.0, square[9];
  for (int i = 0; i < 3; i++) {
    for (int k = 0; k < 3; k++) {
      const double sum = r[i] * r[k] + r[3 + i] * r[3 + k] + r[6 + i] * r[6 + k];
      square[3 * i + k] = (i == k ? 3.0 : 0.0) - sum;
      off = fmax(off, fabs(sum - (i == k ? 1.0 : 0.0)));
    }
  }
  for (int i = 0; i < 3; i++) {
    for (int k = 0; k < 3; k++) {
      nearest[3 * i + k] = 0.5 * (r[3 * i] * square[k] + r[3 * i + 1] * square[3 + k] +
                                  r[3 * i + 2] * square[6 + k]);
    }
  }
  const double det = r[0] * (r[4] * r[8] - r[5] * r[7]) - r[1] * (r[3] * r[8] - r[5] * r[6]) +
                     r[2] * (r[3] * r[7] - r[4] * r[6]);
  return isnan(det) ? NAN : det > 0.0 ? off : INFINITY;
}

/* R => q, error of R that was corrected (0 within rounding). Shepperd: the largest of the four
 * squares is the divisor, so that it does not cancel. */
static double from_matrix(const double x[9], double q[4]) {
  double near[9];
  const double off = off_rotation(x, near), *r = off > 16.0 * ROT_EPS ? near : x;
  const double trace = r[0] + r[4] + r[8];
  int at = -1;
  double max = trace;
  for (int i = 0; i < 3; i++) {
    if (r[4 * i] > max) max = r[4 * (at = i)];
  }
  if (at < 0) {
    q[0] = 1.0 + trace;
    q[1] = r[7] - r[5];
    q[2] = r[2] - r[6];
    q[3] = r[3] - r[1];
  } else {
    const int j = (at + 1) % 3, k = (at + 2) % 3;
    q[0] = r[3 * k + j] - r[3 * j + k];
    q[1 + at] = 1.0 + r[4 * at] - r[4 * j] - r[4 * k];
    q[1 + j] = r[3 * j + at] + r[3 * at + j];
    q[1 + k] = r[3 * k + at] + r[3 * at + k];
  }
  (void)rot_attitude_unit(q);
  return off > 16.0 * ROT_EPS || isnan(off) ? off : 0.0;
}

double rot_attitude_from(rot_attitude_form form, const double x[], const rot_euler *sequence,
                         double q[4]) {
  double length = 1.0;
  switch (form) {
  case ROT_FORM_MATRIX: return from_matrix(x, q);
  case ROT_FORM_VECTOR: from_vector(x, q); break;
  case ROT_FORM_AXIS_ANGLE: about(x, length_of(3, x), x[3], q); break;
  case ROT_FORM_RODRIGUES: from_rodrigues(x, q); break;
  case ROT_FORM_EULER: from_euler(x, sequence, q); break;
  default:
    for (int i = 0; i < 4; i++) q[i] = x[i];
    length = rot_attitude_unit(q);
    /* A unit quaternion within its rounding stays as it is: reading it again changes nothing. */
    for (int i = 0; i < 4 && fabs(length - 1.0) <= 4.0 * ROT_EPS; i++) q[i] = x[i];
  }
  const double off = fabs(length - 1.0);
  return off <= 8.0 * ROT_EPS ? 0.0 : off;
}

/* ---- quaternions => other forms -------------------------------------------------------------- */

/* q => q or -q such that the first component that is not 0 is positive */
static void near_side(const double q[4], double out[4]) {
  double sign = q[0] < 0.0 ? -1.0 : 1.0;
  for (int i = 0, known = q[0] != 0.0; i < 4 && !known; i++) {
    known = q[i] != 0.0;
    if (q[i] < 0.0) sign = -1.0;
  }
  for (int i = 0; i < 4; i++) out[i] = sign * q[i];
}

static void to_matrix(const double q[4], double r[9]) {
  for (int k = 0; k < 3; k++) {
    const double unit[3] = {k == 0, k == 1, k == 2};
    double v[3];
    rot_attitude_to_space(q, unit, v);
    for (int i = 0; i < 3; i++) r[3 * i + k] = v[i];
  }
}

static double to_half_turn(double angle) {
  static const double pi = 0x1.921fb54442d18p+1;
  return angle > pi ? angle - 2.0 * pi : angle < -pi ? angle + 2.0 * pi : angle;
}

/* q => angles x; returns gimbal lock. Computed about the axes of space: an intrinsic sequence is
 * the reverse sequence about them. The arguments of (a, b) and (c, d) are half the sum and half the
 * difference of the outer angles; their lengths give the middle angle, accurate also if small. */
static int to_euler(const double q[4], const rot_euler *sequence, double x[3]) {
  const int first = sequence->intrinsic ? 2 : 0;
  const int i = sequence->axis[first], j = sequence->axis[1];
  const int same = sequence->axis[0] == sequence->axis[2], k = 3 - i - j;
  const double sign = (i - j) * (j - k) * (k - i) / 2;
  const double w = q[0], qi = q[1 + i], qj = q[1 + j], qk = sign * q[1 + k];
  const double a = same ? w : w - qj, b = same ? qi : qi + qk;
  const double c = same ? qj : qj + w, d = same ? qk : qk - qi;
  const double sum = hypot(a, b), difference = hypot(c, d);
  double half_sum = atan2(b, a), half_difference = atan2(d, c), one, three;
  const double none = 4.0 * ROT_EPS;
  if (difference <= none || sum <= none) { /* sum or difference is undetermined: third angle 0 */
    const double both = difference <= none ? 2.0 * half_sum : -2.0 * half_difference;
    /* The first angle in the caller's order gets the whole rotation. */
    one = sequence->intrinsic ? 0.0 : both;
    three = sequence->intrinsic ? (difference <= none ? both : -both) : 0.0;
  } else {
    one = half_sum - half_difference;
    three = half_sum + half_difference;
  }
  /* sin of the middle angle as a difference of products: 2 atan2() - pi/2 would round it to pi/2 */
  const double middle =
      same ? 2.0 * atan2(difference, sum) : atan2(2.0 * (w * qj - qi * qk), sum * difference);
  x[first] = to_half_turn(one);
  x[1] = middle;
  x[2 - first] = to_half_turn(same ? three : sign * three);
  const double from_lock = same ? fmin(sum, difference) : fmin(sum, difference) / sqrt(2.0);
  return 2.0 * from_lock <= ROT_GIMBAL_LOCK;
}

int rot_attitude_to(rot_attitude_form form, const double q[4], const rot_euler *sequence,
                    double x[]) {
  double p[4];
  near_side(q, p);
  const double sine = length_of(3, p + 1), angle = 2.0 * atan2(sine, p[0]);
  const int still = sine == 0.0;
  switch (form) {
  case ROT_FORM_MATRIX: to_matrix(p, x); break;
  case ROT_FORM_VECTOR:
    for (int i = 0; i < 3; i++) x[i] = still ? 0.0 : angle * (p[1 + i] / sine);
    break;
  case ROT_FORM_AXIS_ANGLE:
    for (int i = 0; i < 3; i++) x[i] = still ? i == 0 : p[1 + i] / sine;
    x[3] = angle;
    break;
  case ROT_FORM_RODRIGUES:
    for (int i = 0; i < 3; i++) x[i] = p[1 + i] / (1.0 + p[0]);
    break;
  case ROT_FORM_EULER: return to_euler(p, sequence, x);
  default:
    for (int i = 0; i < 4; i++) x[i] = q[i];
  }
  return 0;
}
