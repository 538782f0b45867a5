/* A rolling disk: steady circles known by hand, the least stable speed, energy, rolling itself. */
#include "tables/rolling_disk.h"

#include "rot_test.h"

enum { ROWS = 41 };

typedef struct table {
  double number[17][ROWS];
  rot_rolling_disk_columns columns;
} table;

static void point(table *x) {
  double *at[17];
  for (int k = 0; k < 17; k++) at[k] = x->number[k];
  int k = 0;
#define X(type, name) x->columns.name = at[k++];
  ROT_ROLLING_DISK_COLUMNS(X)
#undef X
}

static double error[3], flat_s;

static rot_status roll(const rot_rolling_disk *p, double span, table *x, rot_info *info) {
  double t[ROWS];
  for (int i = 0; i < ROWS; i++) t[i] = span * i / (ROWS - 1);
  point(x);
  return rot_rolling_disk_run(p, 1e-11, ROWS, t, &x->columns, error, &flat_s, NULL, info);
}

/* Straight and upright: x = v t. */
static void check_straight(void) {
  const rot_rolling_disk p = {.mass_kg = 2.0,
                              .radius_m = 0.5,
                              .axial = 0.5,
                              .transverse = 0.25,
                              .gravity_m_per_s2 = 9.81,
                              .spin_rad_per_s = 6.0};
  static table x;
  rot_info info;
  ROT_CHECK_EQ_INT(roll(&p, 2.0, &x, &info), ROT_OK);
  ROT_CHECK_REL(x.columns.x_m[ROWS - 1], 6.0, 1e-12);
  ROT_CHECK(fabs(x.columns.y_m[ROWS - 1]) < 1e-12 && fabs(x.columns.lean_rad[ROWS - 1]) < 1e-14);
  ROT_CHECK_REL(x.columns.kinetic_energy_j[20], 0.5 * 2.0 * 9.0 * 1.5, 1e-13);
  ROT_CHECK_REL(x.columns.normal_n[20], 2.0 * 9.81, 1e-13);
}

/* A steady circle: with lean l, yaw W and spin s,
 *   (It + 1) 0 = W cos(l) ((Ia + 1) s + (Ia + 1 - It) W sin(l)) + (g/r) sin(l),
 * so that the spin follows from the yaw (Routh, section 244). */
static void check_steady(void) {
  for (int k = 0; k < 6; k++) {
    rot_rolling_disk p = {.mass_kg = 1.0,
                          .radius_m = 0.3,
                          .axial = k % 2 ? 1.0 : 0.5,
                          .transverse = k % 2 ? 0.5 : 0.25,
                          .gravity_m_per_s2 = 9.81};
    const double lean = -0.2 * (k + 1), yaw = 2.0 + k;
    p.lean_rad = lean;
    p.yaw_rad_per_s = yaw;
    const double ia = p.axial, it = p.transverse;
    p.spin_rad_per_s =
        -((9.81 / 0.3) * sin(lean) / (yaw * cos(lean)) + (ia + 1.0 - it) * yaw * sin(lean)) /
        (ia + 1.0);
    static table x;
    rot_info info;
    ROT_CHECK_EQ_INT(roll(&p, 3.0, &x, &info), ROT_OK);
    double off = 0.0;
    for (int i = 0; i < ROWS; i++) off = fmax(off, fabs(x.columns.lean_rad[i] - lean));
    printf("steady %d: lean off by %.1e\n", k, off);
    ROT_CHECK(off < 1e-8);
  }
}

/* Just above the least speed the lean swings, just below it grows; known: v^2 = g r/3 for a disk,
 * g r/4 for a hoop. */
static void check_stability(void) {
  for (int k = 0; k < 2; k++) {
    rot_rolling_disk p = {.mass_kg = 1.0,
                          .radius_m = 0.2,
                          .axial = k ? 1.0 : 0.5,
                          .transverse = k ? 0.5 : 0.25,
                          .gravity_m_per_s2 = 9.81,
                          .lean_rad = 1e-5};
    const double min = rot_rolling_disk_min(&p), v = min * 0.2;
    ROT_CHECK_REL(v * v, 9.81 * 0.2 / (k ? 4.0 : 3.0), 1e-14);
    static table x;
    rot_info info;
    double max[2] = {0.0, 0.0};
    for (int above = 0; above < 2; above++) {
      p.spin_rad_per_s = min * (above ? 1.1 : 0.9);
      ROT_CHECK_EQ_INT(roll(&p, 3.0, &x, &info), ROT_OK);
      for (int i = 0; i < ROWS; i++) max[above] = fmax(max[above], fabs(x.columns.lean_rad[i]));
    }
    printf("least %d: below it %.1e, above %.1e\n", k, max[0], max[1]);
    /* it swings about a circle of its own: 2/(1 - 1/1.21) times the start */
    ROT_CHECK(max[0] > 1e-2 && max[1] < 12.0e-5);
  }
}

/* A wobble: the energy stays, the contact has no velocity. */
static void check_energy(void) {
  const rot_rolling_disk p = {.mass_kg = 2.0,
                              .radius_m = 0.5,
                              .axial = 0.5,
                              .transverse = 0.25,
                              .gravity_m_per_s2 = 9.81,
                              .lean_rad = 0.4,
                              .spin_rad_per_s = 3.0,
                              .yaw_rad_per_s = -2.0,
                              .lean_rad_per_s = 0.5};
  static table x;
  rot_info info;
  ROT_CHECK_EQ_INT(roll(&p, 10.0, &x, &info), ROT_OK);
  const rot_rolling_disk_columns *c = &x.columns;
  double off = 0.0, swing = 0.0;
  for (int i = 0; i < ROWS; i++) {
    off = fmax(off, fabs(c->kinetic_energy_j[i] + c->potential_energy_j[i] -
                         c->kinetic_energy_j[0] - c->potential_energy_j[0]));
    swing = fmax(swing, fabs(c->lean_rad[i] - 0.4));
    ROT_CHECK_REL(c->z_m[i], 0.5 * cos(c->lean_rad[i]), 1e-13);
  }
  printf("energy off by %.1e of %.3g J, the lean by %.2g rad\n", off, c->kinetic_energy_j[0],
         swing);
  ROT_CHECK(off < 1e-8 * c->kinetic_energy_j[0] && swing > 0.1);
  ROT_CHECK(error[0] < 1e-9 && isnan(flat_s));
}

/* Let go at rest, leaning: it falls flat, as a plate does about its edge. */
static void check_fall(void) {
  const rot_rolling_disk p = {.mass_kg = 1.0,
                              .radius_m = 0.5,
                              .axial = 0.5,
                              .transverse = 0.25,
                              .gravity_m_per_s2 = 9.81,
                              .lean_rad = 0.3};
  static table x;
  rot_info info;
  ROT_CHECK_EQ_INT(roll(&p, 4.0, &x, &info), ROT_OK);
  ROT_CHECK(info.rows_done < ROWS && flat_s > 0.0);
  /* (It + 1) l'^2/2 = (g/r) (cos(l0) - cos(l)): the time by quadrature, mpmath */
  ROT_CHECK_REL(flat_s, 0.60711340698828717670, 1e-9);
}

int main(void) {
  check_straight();
  check_steady();
  check_stability();
  check_energy();
  check_fall();
  return rot_test_report("rolling_disk");
}
