#include "body/shapes_geometry.h"

#include <math.h>

#include "ground/real.h"

#define PI 3.14159265358979323846

/* A body centred at the origin, from second moments, measure and reach. */
static void body(rot_geometry *out, double cxx, double cyy, double czz, double measure,
                 double reach) {
  *out = (rot_geometry){{cxx, cyy, czz, 0.0}, cxx + cyy, {0.0, 0.0, 0.0}, measure, reach, NAN};
}

/* A body symmetric about z (c_xx = c_yy), centred at z = centre_z. */
static void round_body(rot_geometry *out, double cxx, double czz, double centre_z, double measure,
                       double reach) {
  body(out, cxx, cxx, czz, measure, reach);
  out->centre[2] = centre_z;
}

/* A body symmetric about z that rolls about z. */
static void roller(rot_geometry *out, double cxx, double czz, double measure, double reach,
                   double beta) {
  body(out, cxx, cxx, czz, measure, reach);
  out->beta = beta;
}

/* => some/all, 0 for 0/0; NaN stays */
static double part(double some, double all) { return all == 0.0 ? 0.0 : some / all; }

static double longest(double a, double b) { return a > b || isnan(a) ? a : b; }

/* hypot() without its scaling, for sizes near 1. */
static double norm(double a, double b) { return sqrt(a * a + b * b); }

/* size => two radii u, v in units of the larger one, which is returned; 1 if both are 0 (a rod) */
static double in_largest(const double size[], double *u, double *v) {
  const double big = longest(size[0], size[1]);
  *u = big > 0.0 ? size[0] / big : 1.0;
  *v = big > 0.0 ? size[1] / big : 1.0;
  return big;
}

/* ---- points and lines ----------------------------------------------------------------------- */

/* Moment about an axis at the distance r. */
static void point(const double size[], rot_geometry *out) {
  body(out, 0.0, 0.0, 0.0, NAN, 0.0);
  out->moment = size[0] * size[0];
  out->centre[0] = size[0];
}

static void sliding_point(const double size[], rot_geometry *out) {
  (void)size;
  body(out, 0.0, 0.0, 0.0, NAN, 0.0);
  out->beta = 0.0;
}

static void rod(const double size[], rot_geometry *out) {
  const double l = size[0];
  body(out, l * l / 12.0, 0.0, 0.0, l, l / 2.0);
}

/* Moment about the end. */
static void rod_end(const double size[], rot_geometry *out) {
  rod(size, out);
  out->moment = size[0] * size[0] / 3.0;
  out->centre[0] = size[0] / 2.0;
}

static void hoop(const double size[], rot_geometry *out) {
  const double r = size[0];
  roller(out, r * r / 2.0, 0.0, 2.0 * PI * r, r, 1.0);
}

/* Centre of mass 2 r/pi above the diameter; reach: distance from there to an end. */
static void half_hoop(const double size[], rot_geometry *out) {
  const double r = size[0], up = 2.0 / PI;
  const double across = 0.09471526543064891422; /* 1/2 - 4/pi^2 */
  body(out, r * r / 2.0, across * r * r, 0.0, PI * r, norm(1.0, up) * r);
  out->centre[1] = up * r;
}

/* ---- plates --------------------------------------------------------------------------------- */

static void disk(const double size[], rot_geometry *out) {
  const double r = size[0];
  roller(out, r * r / 4.0, 0.0, PI * (r * r), r, 0.5);
}

static void annulus(const double size[], rot_geometry *out) {
  const double outer = size[0], inner = size[1], x = inner / outer;
  roller(out, (outer * outer + inner * inner) / 4.0, 0.0, PI * (outer - inner) * (outer + inner),
         outer, (1.0 + x * x) / 2.0);
}

static void half_disk(const double size[], rot_geometry *out) {
  const double r = size[0], up = 4.0 / (3.0 * PI);
  const double across = 0.06987345130251062854; /* 1/4 - 16/(9 pi^2) */
  body(out, r * r / 4.0, across * r * r, 0.0, PI / 2.0 * (r * r), norm(1.0, up) * r);
  out->centre[1] = up * r;
}

static void elliptic_plate(const double size[], rot_geometry *out) {
  const double a = size[0], b = size[1];
  body(out, a * a / 4.0, b * b / 4.0, 0.0, PI * a * b, longest(a, b));
}

static void rectangle(const double size[], rot_geometry *out) {
  const double a = size[0], b = size[1];
  body(out, a * a / 12.0, b * b / 12.0, 0.0, a * b, norm(a, b) / 2.0);
}

/* Corners (0, 0), (b, 0), (p, h). */
static void triangle(const double size[], rot_geometry *out) {
  const double b = size[0], h = size[1], p = size[2], q = b - p;
  const double gx = (b + p) / 3.0, gy = h / 3.0;
  body(out, (b * b + p * p + q * q) / 36.0, h * h / 18.0, 0.0, b * h / 2.0,
       longest(longest(norm(gx, gy), norm(b - gx, gy)), norm(p - gx, h - gy)));
  out->second[3] = h * (p - q) / 36.0;
  out->centre[0] = gx;
  out->centre[1] = gy;
}

/* Radius of the circumscribed circle, a corner on the x axis. Degrees: the cosines of common
 * polygons are exact. */
static void polygon_plate(const double size[], rot_geometry *out) {
  const double r = size[0], n = size[1], deg = 360.0 / n;
  round_body(out, r * r * (2.0 + rot_cos_deg(deg)) / 12.0, 0.0, 0.0,
             r * r * (n / 2.0 * rot_sin_deg(deg)), r);
}

/* ---- shells --------------------------------------------------------------------------------- */

static void tube(const double size[], rot_geometry *out) {
  const double r = size[0], l = size[1];
  roller(out, r * r / 2.0, l * l / 12.0, 2.0 * PI * r * l, norm(r, l / 2.0), 1.0);
}

/* A tube and two disks with areas in the ratio l to r. */
static void can(const double size[], rot_geometry *out) {
  const double r = size[0], l = size[1], ends = part(r, r + l);
  roller(out, r * r * part(2.0 * l + r, l + r) / 4.0, l * l * (1.0 + 2.0 * ends) / 12.0,
         2.0 * PI * r * (l + r), norm(r, l / 2.0), (2.0 * l + r) / (l + r) / 2.0);
}

static void spherical_shell(const double size[], rot_geometry *out) {
  const double r = size[0];
  roller(out, r * r / 3.0, r * r / 3.0, 4.0 * PI * (r * r), r, 2.0 / 3.0);
}

/* The rim is at sqrt(5)/2 r from the centre. */
static void hemispherical_shell(const double size[], rot_geometry *out) {
  const double r = size[0];
  round_body(out, r * r / 3.0, r * r / 12.0, r / 2.0, 2.0 * PI * (r * r),
             1.1180339887498948482 * r);
}

/* The area is uniform in z (Archimedes). */
static void spherical_cap_shell(const double size[], rot_geometry *out) {
  const double r = size[0], h = size[1], b = 2.0 * r - h;
  round_body(out, h * (3.0 * b + h) / 12.0, h * h / 12.0, h / 2.0, 2.0 * PI * r * h,
             sqrt(h * (h / 4.0 + b)));
}

static void cone_shell(const double size[], rot_geometry *out) {
  const double r = size[0], h = size[1];
  round_body(out, r * r / 4.0, h * h / 18.0, h / 3.0, PI * r * norm(r, h),
             longest(2.0 * h / 3.0, norm(r, h / 3.0)));
}

static void frustum_shell(const double size[], rot_geometry *out) {
  const double h = size[2];
  double u, v;
  const double big = in_largest(size, &u, &v), s = u + v, low = h * (u + 2.0 * v) / (3.0 * s);
  round_body(out, big * big * (u * u + v * v) / 4.0,
             h * h * (u * u + 4.0 * u * v + v * v) / (18.0 * (s * s)), low,
             PI * (size[0] + size[1]) * norm(size[0] - size[1], h),
             longest(norm(size[0], low), norm(size[1], h - low)));
}

static void torus_shell(const double size[], rot_geometry *out) {
  const double ring = size[0], a = size[1], f = ring + a, x = ring / f, y = a / f;
  roller(out, (ring * ring + 1.5 * (a * a)) / 2.0, a * a / 2.0, 4.0 * PI * PI * ring * a, f,
         x * x + 1.5 * (y * y));
}

/* Shell between similar ellipsoids: the thickness varies, so there is no areal density. */
static void ellipsoid_shell(const double size[], rot_geometry *out) {
  const double a = size[0], b = size[1], c = size[2];
  body(out, a * a / 3.0, b * b / 3.0, c * c / 3.0, NAN, longest(longest(a, b), c));
}

/* The faces normal to x, 2 b c of the area 2 (b c + a c + a b), are at a/2; x is uniform over the
 * others. */
static void box_shell(const double size[], rot_geometry *out) {
  const double a = size[0], b = size[1], c = size[2], bc = b * c, ac = a * c, ab = a * b,
               area = bc + ac + ab;
  body(out, a * a * (1.0 + 2.0 * part(bc, area)) / 12.0,
       b * b * (1.0 + 2.0 * part(ac, area)) / 12.0, c * c * (1.0 + 2.0 * part(ab, area)) / 12.0,
       2.0 * area, norm(norm(a, b), c) / 2.0);
}

/* ---- round solids --------------------------------------------------------------------------- */

/* plate => prism of length l */
static void extrude(double l, rot_geometry *out) {
  out->second[2] = l * l / 12.0;
  out->measure *= l;
  out->reach = norm(out->reach, l / 2.0);
}

static void cylinder(const double size[], rot_geometry *out) {
  const double r = size[0], l = size[1];
  roller(out, r * r / 4.0, l * l / 12.0, PI * (r * r) * l, norm(r, l / 2.0), 0.5);
}

static void thick_tube(const double size[], rot_geometry *out) {
  annulus(size, out);
  extrude(size[2], out);
}

static void half_cylinder(const double size[], rot_geometry *out) {
  half_disk(size, out);
  extrude(size[1], out);
}

static void elliptic_cylinder(const double size[], rot_geometry *out) {
  elliptic_plate(size, out);
  extrude(size[2], out);
}

static void sphere(const double size[], rot_geometry *out) {
  const double r = size[0];
  roller(out, r * r / 5.0, r * r / 5.0, 4.0 * PI / 3.0 * (r * r * r), r, 0.4);
}

/* (R^5 - r^5)/(R^3 - r^3) loses all digits for a thin shell. With x = r/R it is equal to
 * r^2 + R (R + r)/(1 + x + x^2), the form with the fewest roundings: 4 ulp for all x. */
static void hollow_sphere(const double size[], rot_geometry *out) {
  const double outer = size[0], inner = size[1], x = outer > 0.0 ? inner / outer : inner;
  const double q = 1.0 + x * (1.0 + x);
  const double c = (inner * inner + outer * ((outer + inner) / q)) / 5.0;
  roller(out, c, c, 4.0 * PI / 3.0 * (outer - inner) * (outer * outer * q), outer,
         outer > 0.0 ? 0.4 * (x * x + (1.0 + x) / q) : NAN);
}

/* The rim is at sqrt(73)/8 r from the centre. */
static void hemisphere(const double size[], rot_geometry *out) {
  const double r = size[0];
  round_body(out, r * r / 5.0, 19.0 * (r * r) / 320.0, 3.0 * r / 8.0, 2.0 * PI / 3.0 * (r * r * r),
             1.0680004681646913960 * r);
}

static void spherical_cap(const double size[], rot_geometry *out) {
  const double h = size[1], b = 2.0 * size[0] - h, d = 3.0 * b + h;
  /* Ratios of b and h to d, so that a flat cap of a huge sphere does not overflow. */
  const double x = part(b, d), y = part(h, d), up = h * (2.0 * x + y) / 2.0;
  round_body(out, h * (10.0 * b * x + 5.0 * b * y + h * y) / 20.0,
             h * h * (10.0 * (x * x) + 8.0 * (x * y) + y * y) / 20.0, up, PI * (h * h) * d / 6.0,
             norm(up, sqrt(h * b)));
}

static void cone(const double size[], rot_geometry *out) {
  const double r = size[0], h = size[1];
  round_body(out, 3.0 * (r * r) / 20.0, 3.0 * (h * h) / 80.0, h / 4.0, PI * (r * r) * h / 3.0,
             longest(3.0 * h / 4.0, norm(r, h / 4.0)));
}

static void frustum(const double size[], rot_geometry *out) {
  const double h = size[2];
  double u, v;
  const double big = in_largest(size, &u, &v), uu = u * u, uv = u * v, vv = v * v;
  const double s = uu + uv + vv, low = h * (uu + 2.0 * uv + 3.0 * vv) / (4.0 * s);
  round_body(
      out, big * big * (3.0 * (uu * (uu + uv + vv) + vv * (uv + vv))) / (20.0 * s),
      h * h * (3.0 * (uu * (uu + 4.0 * uv + 10.0 * vv) + vv * (4.0 * uv + vv))) / (80.0 * (s * s)),
      low, PI * h * (big * big * s) / 3.0, longest(norm(size[0], low), norm(size[1], h - low)));
}

static void paraboloid(const double size[], rot_geometry *out) {
  const double r = size[0], h = size[1];
  round_body(out, r * r / 6.0, h * h / 18.0, h / 3.0, PI * (r * r) * h / 2.0,
             longest(2.0 * h / 3.0, norm(r, h / 3.0)));
}

static void ellipsoid(const double size[], rot_geometry *out) {
  const double a = size[0], b = size[1], c = size[2];
  body(out, a * a / 5.0, b * b / 5.0, c * c / 5.0, 4.0 * PI / 3.0 * a * b * c,
       longest(longest(a, b), c));
}

static void torus(const double size[], rot_geometry *out) {
  const double ring = size[0], a = size[1], f = ring + a, x = ring / f, y = a / f;
  roller(out, (ring * ring + 0.75 * (a * a)) / 2.0, a * a / 4.0, 2.0 * PI * PI * ring * (a * a), f,
         x * x + 0.75 * (y * y));
}

/* A cylinder and two hemispheres with volumes in the ratio 3 l to 4 r. */
static void capsule(const double size[], rot_geometry *out) {
  const double r = size[0], l = size[1], all = 3.0 * l + 4.0 * r;
  const double cylinder = part(3.0 * l, all), ends = part(4.0 * r, all);
  roller(out, r * r * (cylinder / 4.0 + ends / 5.0),
         cylinder * (l * l) / 12.0 + ends * (r * r / 5.0 + l * l / 4.0 + 3.0 * l * r / 8.0),
         PI * (r * r) * all / 3.0, l / 2.0 + r,
         all > 0.0 ? cylinder / 2.0 + 2.0 * ends / 5.0 : NAN);
}

/* ---- solids with flat faces ----------------------------------------------------------------- */

static void box(const double size[], rot_geometry *out) {
  const double a = size[0], b = size[1], c = size[2];
  body(out, a * a / 12.0, b * b / 12.0, c * c / 12.0, a * b * c, norm(norm(a, b), c) / 2.0);
}

static void cube(const double size[], rot_geometry *out) {
  const double a = size[0];
  round_body(out, a * a / 12.0, a * a / 12.0, 0.0, a * a * a,
             0.86602540378443864676 * a); /* sqrt(3)/2 */
}

static void polygon_prism(const double size[], rot_geometry *out) {
  polygon_plate(size, out);
  extrude(size[2], out);
}

static void triangular_prism(const double size[], rot_geometry *out) {
  triangle(size, out);
  extrude(size[3], out);
}

static void pyramid(const double size[], rot_geometry *out) {
  const double a = size[0], b = size[1], h = size[2];
  body(out, a * a / 20.0, b * b / 20.0, 3.0 * (h * h) / 80.0, a * b * h / 3.0,
       longest(3.0 * h / 4.0, norm(norm(a, b) / 2.0, h / 4.0)));
  out->centre[2] = h / 4.0;
}

/* Centre sqrt(6)/12, volume sqrt(2)/12, reach sqrt(6)/4. */
static void regular_tetrahedron(const double size[], rot_geometry *out) {
  const double a = size[0];
  round_body(out, a * a / 40.0, a * a / 40.0, 0.20412414523193150818 * a,
             0.11785113019775792073 * (a * a * a), 0.61237243569579452455 * a);
}

/* Volume sqrt(2)/3, reach sqrt(2)/2. */
static void regular_octahedron(const double size[], rot_geometry *out) {
  const double a = size[0];
  round_body(out, a * a / 20.0, a * a / 20.0, 0.0, 0.47140452079103168293 * (a * a * a),
             0.70710678118654752440 * a);
}

/* ---- the list ------------------------------------------------------------------------------- */

#define X(name, dimension, roundings, fit, n, ...)                                                 \
  {#name, dimension, n, {__VA_ARGS__}, fit, roundings, name},

static const rot_shape shapes[] = {ROT_SHAPE_LIST(X)};
#undef X

size_t rot_shape_count(void) { return sizeof shapes / sizeof shapes[0]; }

const rot_shape *rot_shape_at(size_t i) { return &shapes[i]; }

static const rot_size sizes[] = {
#define X(id, name, kind) {name, kind},
    ROT_SIZE_LIST(X)
#undef X
};

const rot_size *rot_size_at(int id) { return &sizes[id]; }
