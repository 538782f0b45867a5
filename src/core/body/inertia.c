#include "body/inertia.h"

#include <math.h>
#include <string.h>

#include "maths/eigen.h"
#include "ground/real.h"

static void to_matrix(const double c[], double m[9]) {
  for (int k = 0; k < ROT_TENSOR; k++) {
    m[3 * rot_tensor_row[k] + rot_tensor_column[k]] =
        m[3 * rot_tensor_column[k] + rot_tensor_row[k]] = c[k];
  }
}

void rot_inertia_of_second(const double c[], double inertia[]) {
  const double x = c[ROT_XX], y = c[ROT_YY], z = c[ROT_ZZ];
  inertia[ROT_XX] = y + z;
  inertia[ROT_YY] = x + z;
  inertia[ROT_ZZ] = x + y;
  /* 0 - c, so that no product is -0. */
  for (int k = ROT_XY; k < ROT_TENSOR; k++) inertia[k] = 0.0 - c[k];
}

/* => (a + b - c)/2 with about one rounding: the rounding error of a + b is added at the end */
static double half_excess(double a, double b, double c) {
  double lo, lost;
  const double s = rot_two_sum(0.5 * a, 0.5 * b, &lo), e = rot_two_sum(s, -0.5 * c, &lost);
  return e + (lo + lost);
}

void rot_inertia_to_second(const double inertia[], double c[]) {
  const double x = inertia[ROT_XX], y = inertia[ROT_YY], z = inertia[ROT_ZZ];
  c[ROT_XX] = half_excess(y, z, x);
  c[ROT_YY] = half_excess(x, z, y);
  c[ROT_ZZ] = half_excess(x, y, z);
  for (int k = ROT_XY; k < ROT_TENSOR; k++) c[k] = 0.0 - inertia[k];
}

void rot_inertia_shift_second(double mass, const double d[3], double sign, const double c[],
                              double out[]) {
  for (int k = 0; k < ROT_TENSOR; k++) {
    out[k] =
        c[k] +
        sign * rot_product(3, (double[]){mass, d[rot_tensor_row[k]], d[rot_tensor_column[k]]}, 1.0);
  }
}

void rot_inertia_shift(double mass, const double d[3], double sign, const double inertia[],
                       double out[]) {
  static const double zero[ROT_TENSOR] = {0.0};
  double second[ROT_TENSOR], point[ROT_TENSOR];
  rot_inertia_shift_second(mass, d, 1.0, zero, second);
  rot_inertia_of_second(second, point);
  for (int k = 0; k < ROT_TENSOR; k++) out[k] = inertia[k] + sign * point[k];
}

void rot_inertia_rotate(const double r[9], const double c[], double out[]) {
  double m[9], half[9];
  to_matrix(c, m);
  for (int i = 0; i < 3; i++) {
    for (int j = 0; j < 3; j++) {
      half[3 * i + j] = (r[3 * i] * m[j] + r[3 * i + 1] * m[3 + j]) + r[3 * i + 2] * m[6 + j];
    }
  }
  for (int k = 0; k < ROT_TENSOR; k++) {
    const double *a = half + 3 * rot_tensor_row[k], *b = r + 3 * rot_tensor_column[k];
    out[k] = (a[0] * b[0] + a[1] * b[1]) + a[2] * b[2];
  }
}

/* ---- about an axis -------------------------------------------------------------------------- */

/* n => n/|n|, scaled first so that no square over- or underflows */
static void unit_vector(const double n[3], double u[3]) {
  const double max = fmax(fmax(fabs(n[0]), fabs(n[1])), fabs(n[2]));
  int e;
  frexp(max, &e);
  for (int i = 0; i < 3; i++) u[i] = ldexp(n[i], -e);
  const double length = sqrt((u[0] * u[0] + u[1] * u[1]) + u[2] * u[2]);
  for (int i = 0; i < 3; i++) u[i] /= length;
}

double rot_inertia_axis(const rot_inertial *body, const double n[3], const double point[3]) {
  const double *c = body->second_kg_m2;
  double u[3], d[3];
  unit_vector(n, u);
  for (int i = 0; i < 3; i++) d[i] = body->centre_m[i] - point[i];
  const double x = u[0] * u[0], y = u[1] * u[1], z = u[2] * u[2];
  /* tr C - u'Cu, without the terms that cancel. */
  double own = (c[ROT_XX] * (y + z) + c[ROT_YY] * (x + z) + c[ROT_ZZ] * (x + y)) -
               2.0 * (c[ROT_XY] * u[0] * u[1] + c[ROT_XZ] * u[0] * u[2] + c[ROT_YZ] * u[1] * u[2]);
  /* A rod about its own axis: rounding may give a negative moment. */
  if (body->mass_kg >= 0.0 && own < 0.0) own = 0.0;
  const double cross[3] = {u[1] * d[2] - u[2] * d[1], u[2] * d[0] - u[0] * d[2],
                           u[0] * d[1] - u[1] * d[0]};
  double moved = 0.0;
  for (int i = 0; i < 3; i++) {
    moved += rot_product(3, (double[]){body->mass_kg, cross[i], cross[i]}, 1.0);
  }
  return own + moved;
}

/* ---- principal axes ------------------------------------------------------------------------- */

/* Relative difference of eigenvalues below which the eigenvectors are undetermined: some fifty
 * roundings. */
static const double same = 1e-14;

static void set_axis(double axes[9], int k, const double v[3]) {
  for (int i = 0; i < 3; i++) axes[3 * i + k] = v[i];
}

static void get_axis(const double axes[9], int k, double v[3]) {
  for (int i = 0; i < 3; i++) v[i] = axes[3 * i + k];
}

static void cross_product(const double a[3], const double b[3], double out[3]) {
  out[0] = a[1] * b[2] - a[2] * b[1];
  out[1] = a[2] * b[0] - a[0] * b[2];
  out[2] = a[0] * b[1] - a[1] * b[0];
}

/* v => u: the coordinate axis nearest to the plane perpendicular to v (the first of equals),
 * projected on the plane and normalized */
static void nearest_in_plane(const double v[3], double u[3]) {
  int k = 0;
  for (int i = 1; i < 3; i++) {
    /* By more than rounding: two axes are equally near to a plane at 45 degrees. */
    if (fabs(v[i]) < fabs(v[k]) - 1e-8) k = i;
  }
  for (int i = 0; i < 3; i++) u[i] = (i == k ? 1.0 : 0.0) - v[k] * v[i];
  unit_vector(u, u);
}

static void fix_sign(double axes[9], int k) {
  double v[3];
  int max = 0;
  get_axis(axes, k, v);
  for (int i = 1; i < 3; i++) {
    if (fabs(v[i]) > fabs(v[max]) * (1.0 + 1e-8)) max = i;
  }
  if (v[max] < 0.0) {
    for (int i = 0; i < 3; i++) v[i] = 0.0 - v[i];
    set_axis(axes, k, v);
  }
}

/* Replaces the axes of equal moments, which are not unique, by those nearest to x, y, z. */
static void settle_equal_axes(const double second[3], double axes[9]) {
  const int first = second[0] - second[1] <= same * second[0];
  const int last = second[1] - second[2] <= same * second[0];
  double alone[3], u[3], v[3];
  if (first && last) {
    for (int i = 0; i < 9; i++) axes[i] = i % 4 == 0 ? 1.0 : 0.0;
  } else if (first || last) {
    get_axis(axes, first ? 2 : 0, alone);
    nearest_in_plane(alone, u);
    cross_product(alone, u, v);
    set_axis(axes, first ? 0 : 1, u);
    set_axis(axes, first ? 1 : 2, v);
  }
}

rot_status rot_inertia_principal(const double c[], double tolerance, rot_principal *out) {
  double m[9], values[3], vectors[9], e1[3], e2[3], e3[3];
  to_matrix(c, m);
  const rot_status status = rot_eigen_symmetric(3, m, values, vectors, NULL);
  if (status != ROT_OK) return status;
  for (int k = 0; k < 3; k++) {
    out->second[k] = values[2 - k];
    for (int i = 0; i < 3; i++) out->axes[3 * i + k] = vectors[3 * i + 2 - k];
  }
  settle_equal_axes(out->second, out->axes);
  fix_sign(out->axes, 0);
  fix_sign(out->axes, 1);
  get_axis(out->axes, 0, e1);
  get_axis(out->axes, 1, e2);
  cross_product(e1, e2, e3);
  for (int i = 0; i < 3; i++) e3[i] += 0.0; /* -0 becomes 0, for printing */
  set_axis(out->axes, 2, e3);
  const double *s = out->second;
  out->moment[0] = s[1] + s[2];
  out->moment[1] = s[0] + s[2];
  out->moment[2] = s[0] + s[1];
  out->equal12 = s[0] - s[1] <= tolerance * s[0];
  out->equal23 = s[1] - s[2] <= tolerance * s[0];
  return ROT_OK;
}

/* ---- several bodies as one ------------------------------------------------------------------ */

typedef struct scales {
  int mass, length;
} scales;

/* => exponents that scale masses and distances to near 1, so that no product over- or underflows; 0
 * where all finite values are 0 */
static scales find_scales(size_t n, const rot_inertial part[], const double from[3]) {
  double mass = 0.0, second = 0.0, length = 0.0;
  scales s = {0, 0};
  for (size_t i = 0; i < n; i++) {
    mass = fmax(mass, fabs(part[i].mass_kg));
    for (int k = 0; k < 3; k++) {
      length = fmax(length, fabs(part[i].centre_m[k] - from[k]));
      second = fmax(second, fabs(part[i].second_kg_m2[k]));
    }
  }
  if (mass > 0.0) frexp(mass, &s.mass);
  if (length > 0.0 && isfinite(length)) frexp(length, &s.length);
  if (second > 0.0 && isfinite(second)) {
    /* From exponents: 1e300 kg m^2/1e-300 kg overflows. */
    int e;
    frexp(second, &e);
    const int own = (e - s.mass) / 2 + 1;
    if (own > s.length || !(length > 0.0)) s.length = own;
  }
  return s;
}

static size_t heaviest(size_t n, const rot_inertial part[]) {
  size_t max = 0;
  for (size_t i = 1; i < n; i++) {
    if (fabs(part[i].mass_kg) > fabs(part[max].mass_kg)) max = i;
  }
  return max;
}

typedef struct running {
  double sum, lo;
} running;

static void add(running *r, double x) { rot_accumulate(&r->sum, &r->lo, x); }

static double total(const running *r) { return r->sum + r->lo; }

rot_status rot_inertia_join(size_t n, const rot_inertial part[], rot_inertial *whole,
                            double *error) {
  if (n == 0) return ROT_EVALUE;
  const double *from = part[heaviest(n, part)].centre_m;
  const scales s = find_scales(n, part, from);
  running mass, first[3], second[ROT_TENSOR];
  memset(&mass, 0, sizeof mass);
  memset(first, 0, sizeof first);
  memset(second, 0, sizeof second);
  for (size_t i = 0; i < n; i++) {
    const double m = ldexp(part[i].mass_kg, -s.mass);
    add(&mass, m);
    for (int k = 0; k < 3; k++) {
      add(&first[k], m * ldexp(part[i].centre_m[k] - from[k], -s.length));
    }
  }
  const double m_all = total(&mass);
  if (!isfinite(m_all)) return ROT_EVALUE;
  /* With zero total mass the centre is that of the heaviest part. */
  double mean[3], trace = 0.0, spread = 0.0;
  for (int k = 0; k < 3; k++) mean[k] = m_all == 0.0 ? 0.0 : total(&first[k]) / m_all;
  for (size_t i = 0; i < n; i++) {
    const double m = ldexp(part[i].mass_kg, -s.mass);
    double d[3];
    for (int k = 0; k < 3; k++) {
      const double x = ldexp(part[i].centre_m[k] - from[k], -s.length);
      d[k] = x - mean[k];
      spread += fabs(m) * (fabs(x) + fabs(mean[k])) * (fabs(x) + fabs(mean[k]));
    }
    for (int k = 0; k < ROT_TENSOR; k++) {
      const double own = ldexp(part[i].second_kg_m2[k], -s.mass - 2 * s.length);
      add(&second[k], own);
      add(&second[k], m * d[rot_tensor_row[k]] * d[rot_tensor_column[k]]);
      if (k < ROT_XY) spread += fabs(own);
    }
  }
  for (int k = 0; k < 3; k++) {
    trace += total(&second[k]);
    whole->centre_m[k] = from[k] + ldexp(mean[k], s.length);
  }
  whole->mass_kg = ldexp(m_all, s.mass);
  if (!isfinite(whole->mass_kg)) return ROT_ERANGE;
  for (int k = 0; k < ROT_TENSOR; k++) {
    whole->second_kg_m2[k] = ldexp(total(&second[k]), s.mass + 2 * s.length);
    if (!isfinite(whole->second_kg_m2[k])) return ROT_ERANGE;
  }
  /* Roundings: two of a term m d d', two in each d, one of the sums. */
  const double rounding = 8.0 * ROT_EPS * spread;
  *error = rounding <= 0.0 ? 0.0 : trace > 0.0 ? rounding / trace : INFINITY;
  return ROT_OK;
}

double rot_inertia_error(const double second[ROT_TENSOR], double mass, int is_density,
                         double roundings, int has_moment) {
  const double trace = second[ROT_XX] + second[ROT_YY] + second[ROT_ZZ];
  double bound = roundings * ROT_EPS;
  if (is_density && mass > 0.0) bound += 0x1p-1074 / mass;
  if (trace > 0x1p-960) return bound;
  return trace > 0.0 ? bound + 0x1p-1072 / trace : has_moment ? HUGE_VAL : 0.0;
}

int rot_inertia_possible(const double c[]) {
  rot_principal principal;
  return rot_inertia_principal(c, 1e-12, &principal) == ROT_OK &&
         principal.second[2] >= -1e-12 * principal.moment[2];
}
