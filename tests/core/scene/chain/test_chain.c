/* Chains: one link against the pendulum's closed form, normal modes against formulas, what is
 * conserved, audits, the mode model against the integrator within its bound, extremes, refusals. */
#include "scene/chain/chain.h"

#include "scene/axle/pendulum.h"
#include "scene/chain/links.h"
#include "scene_kit.h"

#define GRAVITY 9.80665
static const double pi = 3.14159265358979323846;

/* `mass` and `theta0`: n numbers, or one for all. */
static kit *chain(size_t n, const double length[], size_t n_mass, const double mass[], int points,
                  size_t n_theta0, const double theta0[], const double omega0[]) {
  kit *k = kit_new("scene_chain");
  kit_numbers(k, "length_m", n, length);
  kit_numbers(k, "mass_kg", n_mass, mass);
  kit_option(k, "links", points);
  kit_numbers(k, "theta0_rad", n_theta0, theta0);
  if (omega0) kit_numbers(k, "omega0_rad_per_s", n, omega0);
  return k;
}

static double theta(const kit *k, const motion *m, size_t i, size_t link) {
  return value(k, m, "theta_rad", i, link);
}

static double omega(const kit *k, const motion *m, size_t i, size_t link) {
  return value(k, m, "omega_rad_per_s", i, link);
}

/* Two motions at the same times, within the errors that both report. */
static void check_same(const kit *k, const motion *a, const motion *b) {
  for (size_t i = 0; i < a->n; i++) {
    for (size_t l = 0; l < a->rows_per_time; l++) {
      ROT_CHECK(fabs(theta(k, a, i, l) - theta(k, b, i, l)) <=
                reported(a, ROT_THETA) + reported(b, ROT_THETA));
      ROT_CHECK(fabs(omega(k, a, i, l) - omega(k, b, i, l)) <=
                reported(a, ROT_OMEGA) + reported(b, ROT_OMEGA));
    }
  }
}

/* ---- equations ------------------------------------------------------------------------------- */

static uint64_t random_state = 88172645463325252u;

static double uniform(double low, double high) {
  random_state ^= random_state << 13;
  random_state ^= random_state >> 7;
  random_state ^= random_state << 17;
  return low + (high - low) * (double)(random_state >> 11) * 0x1p-53;
}

/* The accelerations fulfil the equations as links.h has them. */
static void equations(void) {
  static const double none[ROT_LINKS_MAX] = {0.0};
  for (int trial = 0; trial < rot_test_trials(1600); trial++) {
    rot_links c = {.n = 1 + (size_t)trial % ROT_LINKS_MAX, .rods = trial / 16 % 2};
    double mass[ROT_LINKS_MAX], q[ROT_LINKS_MAX], v[ROT_LINKS_MAX], a[ROT_LINKS_MAX];
    c.gravity_m_per_s2 = trial % 5 ? uniform(0.5, 20.0) : 0.0;
    for (size_t i = 0; i < c.n; i++) {
      mass[i] = uniform(0.2, 3.0);
      c.length_m[i] = uniform(0.2, 3.0);
      c.joint_n_m_s[i] = trial % 3 ? uniform(0.0, 2.0) : 0.0;
      q[i] = uniform(-4.0, 4.0);
      v[i] = uniform(-4.0, 4.0);
    }
    ROT_CHECK(rot_links_masses(&c, mass));
    rot_links_accelerations(&c, q, none, v, a);
    for (size_t i = 0; i < c.n; i++) {
      const double f = c.rods ? 0.5 : 1.0, h = c.rods ? 1.0 / 3.0 : 1.0;
      double below = 0.0, sum = rot_links_joint(&c, v, i), size = fabs(sum);
      for (size_t j = i + 1; j < c.n; j++) below += mass[j];
      if (i + 1 < c.n) sum -= rot_links_joint(&c, v, i + 1);
      const double weight = c.gravity_m_per_s2 * c.length_m[i] * (f * mass[i] + below) * sin(q[i]);
      sum -= weight;
      size += fabs(weight);
      for (size_t j = 0; j < c.n; j++) {
        double s = 0.0;
        for (size_t p = (i > j ? i : j) + 1; p < c.n; p++) s += mass[p];
        s += (i == j ? h : f) * mass[i > j ? i : j];
        const double inertia = s * c.length_m[i] * c.length_m[j];
        sum -= inertia * (cos(q[i] - q[j]) * a[j] + sin(q[i] - q[j]) * v[j] * v[j]);
        size += inertia * (fabs(a[j]) + v[j] * v[j]);
      }
      ROT_CHECK(fabs(sum) <= 1e-13 * size);
    }
  }
}

/* A heavy end on light links, straight: the end falls as a pendulum of the whole length, whose
 * acceleration a factorised mass matrix has with 1e-16 m_1/m_n. */
static void heavy_end(void) {
  static const double none[2] = {0.0, 0.0};
  rot_links c = {.n = 2, .length_m = {1.0, 1.0}, .gravity_m_per_s2 = 10.0};
  const double mass[2] = {1e-12, 1.0}, q[2] = {0.3, 0.3 + 1e-13}, v[2] = {0.0, 0.0};
  double a[2];
  ROT_CHECK(rot_links_masses(&c, mass));
  rot_links_accelerations(&c, q, none, v, a);
  /* By Cramer's rule with x = sin^2(delta) and the masses 1e-12, 1:
   * a_1 = -g ((1e-12 + 1) sin q_1 - sin q_2 cos(delta))/(1e-12 + x). */
  const double difference = q[1] - q[0];
  const double top = 1e-12 * sin(0.3) - cos(0.3) * difference * (1.0 - 0.0); /* to 1e-13 */
  ROT_CHECK_REL(a[0], -10.0 * top / 1e-12, 1e-9);
}

/* ---- one link -------------------------------------------------------------------------------- */

static void one_link(void) {
  const double starts[][2] = {{0.3, 0.0}, {2.5, -1.0}, {0.0, 12.0}, {3.1, 0.0}, {-1.0, 6.5}};
  const double length = 0.7, mass = 2.3, t[] = {-2.0, 0.5, 3.0, 7.0};
  double got[7];
  const rot_axle_columns out = {got, got + 1, got + 2, got + 3, got + 4, got + 5, got + 6};
  for (int points = 0; points < 2; points++) {
    for (size_t i = 0; i < sizeof starts / sizeof *starts; i++) {
      const double x[2] = {(points ? 1.0 : 0.5) * GRAVITY / length, 0.0};
      const double inertia = points ? 1.0 : 1.0 / 3.0;
      const rot_term term = {ROT_TERM_GRAVITY, -INFINITY, INFINITY, 2, x};
      const rot_axle_scene axle = {.linear = {inertia, 0.0, 0.0, starts[i][0], starts[i][1], {0}},
                                   .n_terms = 1,
                                   .terms = &term};
      kit *k = chain(1, &length, 1, &mass, points, 1, &starts[i][0], &starts[i][1]);
      motion m = kit_run(k, NULL, 1e-10, 4, t);
      /* From next to the top the figure of rounding is large. */
      ROT_CHECK(ran(&m) && m.out.error <= (starts[i][0] > 3.0 ? 1e-7 : 1e-10));
      for (size_t j = 0; j < 4; j++) {
        rot_info info;
        ROT_CHECK(rot_axle_pendulum(&axle, 1, &t[j], &out, NULL, NULL, &info) == ROT_OK);
        ROT_CHECK(fabs(theta(k, &m, j, 0) - got[0]) <= reported(&m, ROT_THETA) + 1e-13);
        ROT_CHECK(fabs(omega(k, &m, j, 0) - got[1]) <= reported(&m, ROT_OMEGA) + 1e-12);
        ROT_CHECK_REL(value(k, &m, "x_m", j, 0), length * sin(got[0]), 1e-8);
        ROT_CHECK_REL(value(k, &m, "y_m", j, 0), -length * cos(got[0]), 1e-8);
        ROT_CHECK_REL(value(k, &m, "kinetic_energy_j", j, 0),
                      0.5 * inertia * mass * length * length * got[1] * got[1], 1e-7);
        ROT_CHECK_REL(value(k, &m, "potential_energy_j", j, 0),
                      x[0] * mass * length * length * (1.0 - cos(got[0])), 1e-7);
      }
      check_audits(k, &m);
      motion_free(&m);
      kit_free(k);
    }
  }
}

/* The textbook's series of the period, T/T0 = 1 + a^2/16 + 11 a^4/3072. */
static void textbook_period(void) {
  const double a = 0.1, length = 1.3, mass = 1.0;
  const double period =
      2.0 * pi * sqrt(length / GRAVITY) * (1.0 + a * a / 16.0 + 11.0 * a * a * a * a / 3072.0);
  kit *k = chain(1, &length, 1, &mass, 1, 1, &a, NULL);
  motion m = kit_run(k, NULL, 1e-11, 1, &period);
  ROT_CHECK(ran(&m));
  ROT_CHECK_REL(theta(k, &m, 0, 0), a, 1e-9);
  ROT_CHECK(fabs(omega(k, &m, 0, 0)) < 1e-7);
  motion_free(&m);
  kit_free(k);
}

/* The sizes behind a relative figure are of this motion, whatever was in memory before: where the
 * figure is more than 1e-13, they come from more times than the rows'. */
static void sizes_of_small_swings(void) {
  const double length[] = {0.5, 0.5}, mass[] = {1.0, 1.0}, theta0[] = {1e-4, -5e-5};
  const double t[] = {0.5, 1.5};
  volatile double garbage[512];
  for (int i = 0; i < 512; i++) garbage[i] = 1e3 + i;
  kit *k = chain(2, length, 2, mass, 1, 2, theta0, NULL);
  motion m = kit_run(k, "chain_modes", 1e-2, 2, t);
  ROT_CHECK(ran(&m) && garbage[511] > 0.0);
  ROT_CHECK(m.out.info.measure[ROT_THETA].largest < 2e-4);
  ROT_CHECK(m.out.info.measure[ROT_OMEGA].largest < 2e-3);
  ROT_CHECK(m.out.error > 1e-13);
  motion_free(&m);
  kit_free(k);
}

/* ---- modes ----------------------------------------------------------------------------------- */

static void mode_formulas(void) {
  double length[16], mass[16], w[16], shape[256];
  for (int i = 0; i < 16; i++) length[i] = 0.5, mass[i] = 3.0;
  const double unit = GRAVITY / 0.5, root = sqrt(2.0);
  ROT_CHECK(rot_chain_modes(length, mass, 2, 0, GRAVITY, w, shape) == ROT_OK);
  ROT_CHECK_REL(w[0] * w[0], (2.0 - root) * unit, 2e-15);
  ROT_CHECK_REL(w[1] * w[1], (2.0 + root) * unit, 2e-15);
  ROT_CHECK_REL(shape[2] / shape[0], root, 4e-15);
  ROT_CHECK_REL(shape[3] / shape[1], -root, 4e-15);
  ROT_CHECK(shape[2] == 1.0 && fabs(shape[3]) == 1.0);
  /* Zeros of Laguerre's polynomials. */
  ROT_CHECK(rot_chain_modes(length, mass, 3, 0, GRAVITY, w, shape) == ROT_OK);
  ROT_CHECK_REL(w[0] * w[0], 0.4157745567834791 * unit, 4e-15);
  ROT_CHECK_REL(w[1] * w[1], 2.294280360279042 * unit, 4e-15);
  ROT_CHECK_REL(w[2] * w[2], 6.289945082937479 * unit, 4e-15);
  ROT_CHECK(rot_chain_modes(length, mass, 16, 0, GRAVITY, w, shape) == ROT_OK);
  ROT_CHECK_REL(w[0] * w[0], 0.08764941047892784 * unit, 2e-14);
  ROT_CHECK_REL(w[15] * w[15], 51.70116033954332 * unit, 2e-14);
  /* One rod; two rods: 7 x^2 - 42 x + 27 = 0 with x = w^2 l/g. */
  ROT_CHECK(rot_chain_modes(length, mass, 1, 1, GRAVITY, w, shape) == ROT_OK);
  ROT_CHECK_REL(w[0] * w[0], 1.5 * unit, 2e-15);
  ROT_CHECK(rot_chain_modes(length, mass, 2, 1, GRAVITY, w, shape) == ROT_OK);
  ROT_CHECK_REL(w[0] * w[0], (3.0 - 6.0 / sqrt(7.0)) * unit, 4e-15);
  ROT_CHECK_REL(w[1] * w[1], (3.0 + 6.0 / sqrt(7.0)) * unit, 4e-15);
  /* Graded: the product of w^2 is (g/l)^2 (m_1 + m_2)/m_1, the sum 2 (g/l) (m_1 + m_2)/m_1. */
  mass[0] = 1e-9, mass[1] = 1.0;
  ROT_CHECK(rot_chain_modes(length, mass, 2, 0, GRAVITY, w, shape) == ROT_OK);
  ROT_CHECK_REL(w[0] * w[1], unit * sqrt(1.0 + 1e9), 1e-14);
  ROT_CHECK_REL(w[0] * w[0] + w[1] * w[1], 2.0 * unit * (1.0 + 1e9), 1e-14);
  ROT_CHECK(rot_chain_modes(length, mass, 0, 0, GRAVITY, w, shape) == ROT_EVALUE);
  ROT_CHECK(rot_chain_modes(length, mass, 17, 0, GRAVITY, w, shape) == ROT_EVALUE);
  ROT_CHECK(rot_chain_modes(length, mass, 2, 0, -1.0, w, shape) == ROT_EVALUE);
  mass[1] = 0.0;
  ROT_CHECK(rot_chain_modes(length, mass, 2, 0, GRAVITY, w, shape) == ROT_EVALUE);
  mass[1] = 1e-300;
  mass[0] = 1.0;
  ROT_CHECK(rot_chain_modes(length, mass, 2, 0, GRAVITY, w, shape) == ROT_EVALUE);
}

/* A double pendulum let go in a mode swings in it. */
static void in_a_mode(void) {
  const double length[2] = {1.0, 1.0}, mass = 2.0, root = sqrt(2.0);
  for (int sign = -1; sign <= 1; sign += 2) {
    const double start[2] = {1e-5, sign * root * 1e-5};
    const double w = sqrt((2.0 - sign * root) * GRAVITY), t[2] = {1.7, -3.1};
    kit *k = chain(2, length, 1, &mass, 1, 2, start, NULL);
    const double sorted[2] = {t[1], t[0]};
    motion m = kit_run(k, NULL, 1e-6, 2, sorted);
    ROT_CHECK(ran(&m) && !strcmp(m.out.model->id, "chain_modes"));
    for (size_t i = 0; i < 2; i++) {
      for (size_t l = 0; l < 2; l++) {
        const double want = start[l] * cos(w * sorted[i]);
        ROT_CHECK(fabs(theta(k, &m, i, l) - want) < 1e-18);
        ROT_CHECK(fabs(omega(k, &m, i, l) + start[l] * w * sin(w * sorted[i])) < 1e-18);
      }
    }
    check_audits(k, &m);
    motion_free(&m);
    kit_free(k);
  }
}

/* Beside the integrator: within the bound, which is no more than 1e5 times what is left out, of one
 * link 100 times. */
static void mode_bound(void) {
  for (int trial = 0; trial < rot_test_trials(160); trial++) {
    const size_t n = 1 + (size_t)trial % 6;
    double length[6], mass[6], start[6], rate[6], t[5];
    const double size = pow(10.0, uniform(-4.0, -1.5));
    for (size_t i = 0; i < n; i++) {
      length[i] = uniform(0.3, 2.0);
      mass[i] = uniform(0.3, 2.0);
      start[i] = size * uniform(-1.0, 1.0);
      rate[i] = trial % 3 ? 0.0 : size * uniform(-2.0, 2.0);
    }
    for (int i = 0; i < 5; i++) t[i] = (i - 1) * uniform(0.9, 1.1);
    kit *k = chain(n, length, n, mass, trial % 2, n, start, rate);
    motion a = kit_run(k, "chain_modes", 0.5, 5, t), b = kit_run(k, "chain_rk8pd", 1e-11, 5, t);
    ROT_CHECK(ran(&b));
    if (a.end == ROT_RUN_DONE) {
      double off = 0.0;
      ROT_CHECK(ran(&a));
      check_same(k, &a, &b);
      check_audits(k, &a);
      for (size_t i = 0; i < 5; i++) {
        for (size_t l = 0; l < n; l++) {
          off = fmax(off, fabs(theta(k, &a, i, l) - theta(k, &b, i, l)));
        }
      }
      ROT_CHECK(reported(&a, ROT_THETA) < (n > 1 ? 1e5 : 100.0) * off);
    } else {
      ROT_CHECK(size > 3e-4 && n > 1);
    }
    motion_free(&a);
    motion_free(&b);
    kit_free(k);
  }
}

/* ---- what is conserved ----------------------------------------------------------------------- */

static void balances(void) {
  for (int trial = 0; trial < 48; trial++) {
    const size_t n = 1 + (size_t)trial % 4;
    double length[4], mass[4], start[4], rate[4], joint[4], t[4];
    const int heavy = trial / 4 % 3 != 0, damped = trial / 12 % 2;
    for (size_t i = 0; i < n; i++) {
      length[i] = uniform(0.3, 2.0);
      mass[i] = uniform(0.3, 2.0);
      start[i] = uniform(-3.0, 3.0);
      rate[i] = uniform(-3.0, 3.0);
      joint[i] = damped ? uniform(0.01, 0.5) : 0.0;
    }
    for (int i = 0; i < 4; i++) t[i] = 2.0 + 0.7 * i;
    kit *k = chain(n, length, n, mass, trial / 24, n, start, rate);
    if (!heavy) kit_number(k, "gravity_m_per_s2", 0.0);
    kit_numbers(k, "resistance", n, joint);
    kit_number(k, "start_s", 1.5);
    motion m = kit_run(k, NULL, 1e-9, 4, t);
    ROT_CHECK(ran(&m) && m.out.error < 1e-8);
    check_audits(k, &m);
    const char *why = NULL;
    ROT_CHECK(!k->c->conserved(k->scene, 0, &why) == !damped && why);
    ROT_CHECK(!k->c->conserved(k->scene, 1, &why) == (!damped && !heavy) && why);
    /* The columns of energy, and its start from the formula. */
    double energy[4] = {0.0};
    for (size_t i = 0; i < 4; i++) {
      for (size_t l = 0; l < n; l++) {
        energy[i] += value(k, &m, "kinetic_energy_j", i, l);
        energy[i] += value(k, &m, "potential_energy_j", i, l);
        const double above = l ? omega(k, &m, i, l - 1) : 0.0;
        ROT_CHECK(fabs(value(k, &m, "joint_torque_n_m", i, l) +
                       joint[l] * (omega(k, &m, i, l) - above)) < 1e-12);
      }
      if (!i) continue;
      const double heat = m.flow[0][i] - m.flow[0][0];
      ROT_CHECK(fabs(energy[i] + heat - energy[0]) < 1e-6 * energy[0]);
      ROT_CHECK(damped ? heat > 0.0 : heat == 0.0);
    }
    motion_free(&m);
    kit_free(k);
  }
}

/* Positions and velocities of the ends agree, and a row at the start is the start. */
static void ends(void) {
  const double length[3] = {0.5, 1.0, 0.7}, mass[3] = {1.0, 2.0, 0.5}, start[3] = {0.4, -1.0, 2.0};
  const double rate[3] = {1.0, -0.5, 2.0}, h = 1e-4, t[3] = {-h, 0.0, h};
  kit *k = chain(3, length, 3, mass, 0, 3, start, rate);
  motion m = kit_run(k, NULL, 1e-11, 3, t);
  double x = 0.0, y = 0.0;
  for (size_t l = 0; l < 3; l++) {
    x += length[l] * sin(start[l]);
    y -= length[l] * cos(start[l]);
    ROT_CHECK(theta(k, &m, 1, l) == start[l] && omega(k, &m, 1, l) == rate[l]);
    ROT_CHECK_REL(value(k, &m, "x_m", 1, l), x, 1e-14);
    ROT_CHECK_REL(value(k, &m, "y_m", 1, l), y, 1e-14);
    const char *const at[2] = {"x_m", "y_m"}, *const speed[2] = {"vx_m_per_s", "vy_m_per_s"};
    for (int i = 0; i < 2; i++) {
      const double moved = value(k, &m, at[i], 2, l) - value(k, &m, at[i], 0, l);
      ROT_CHECK(fabs(moved / (2.0 * h) - value(k, &m, speed[i], 1, l)) < 1e-5);
    }
  }
  motion_free(&m);
  kit_free(k);
}

/* A joint that is nearly stiff makes two rods one of twice the length. */
static void stiff_joint(void) {
  const double length[2] = {0.5, 0.5}, mass = 1.0, start = 1.0, joint[2] = {0.0, 1e7};
  const double one = 1.0, two = 2.0, t[2] = {1.0, 3.0};
  kit *k = chain(2, length, 1, &mass, 0, 1, &start, NULL),
      *rod = chain(1, &one, 1, &two, 0, 1, &start, NULL);
  kit_numbers(k, "resistance", 2, joint);
  motion m = kit_run(k, NULL, 1e-8, 2, t), want = kit_run(rod, NULL, 1e-10, 2, t);
  ROT_CHECK(ran(&m) && !strcmp(m.out.model->id, "chain_radau"));
  for (size_t i = 0; i < 2; i++) {
    for (size_t l = 0; l < 2; l++) {
      ROT_CHECK(fabs(theta(k, &m, i, l) - theta(rod, &want, i, 0)) < 2e-6);
    }
  }
  check_audits(k, &m);
  motion_free(&m);
  motion_free(&want);
  kit_free(k);
  kit_free(rod);
}

/* ---- figures --------------------------------------------------------------------------------- */

/* Forward from where it came from: back at the start. */
static void backwards(void) {
  const double length[2] = {1.0, 0.8}, mass = 1.0, start[2] = {1.0, 1.5}, t = -2.5;
  kit *k = chain(2, length, 1, &mass, 1, 2, start, NULL);
  motion m = kit_run(k, NULL, 1e-11, 1, &t);
  ROT_CHECK(ran(&m));
  const double from[2] = {theta(k, &m, 0, 0), theta(k, &m, 0, 1)};
  const double rate[2] = {omega(k, &m, 0, 0), omega(k, &m, 0, 1)}, zero = 0.0;
  kit_numbers(k, "theta0_rad", 2, from);
  kit_numbers(k, "omega0_rad_per_s", 2, rate);
  kit_number(k, "start_s", t);
  motion back = kit_run(k, NULL, 1e-11, 1, &zero);
  for (size_t l = 0; l < 2; l++) {
    ROT_CHECK(fabs(theta(k, &back, 0, l) - start[l]) < 1e-9);
    ROT_CHECK(fabs(omega(k, &back, 0, l)) < 1e-9);
  }
  motion_free(&m);
  motion_free(&back);
  kit_free(k);
}

/* Chaos: the figure of a long run tells its error, or that nothing is left. */
static void chaos(void) {
  const double length[2] = {1.0, 1.0}, mass = 1.0, start[2] = {2.0, 2.5};
  double t[12];
  kit *k = chain(2, length, 1, &mass, 1, 2, start, NULL);
  for (int i = 0; i < 12; i++) t[i] = 5.0 * (i + 1);
  for (size_t n = 2; n <= 12; n += 5) {
    motion a = kit_run(k, "chain_rk8pd", 1e-7, n, t), b = kit_run(k, "chain_rk8pd", 1e-13, n, t);
    check_same(k, &a, &b);
    motion_free(&a);
    motion_free(&b);
  }
  kit_free(k);
}

static void extremes(void) {
  const double length[3] = {1.0, 0.5, 0.8}, mass[3] = {1.0, 2.0, 0.7}, t[3] = {-1.0, 0.7, 4.0};
  const double tiny[3] = {1e-150, -2e-150, 3e-150}, small[3] = {1e-6, -2e-6, 3e-6};
  kit *k = chain(3, length, 3, mass, 0, 3, small, NULL);
  motion want = kit_run(k, "chain_modes", 1e-3, 3, t);
  kit_numbers(k, "theta0_rad", 3, tiny);
  for (int model = 0; model < 2; model++) {
    motion m = kit_run(k, model ? "chain_rk8pd" : NULL, 1e-9, 3, t);
    ROT_CHECK(ran(&m) && m.out.error < 1e-8);
    for (size_t i = 0; i < 3; i++) {
      for (size_t l = 0; l < 3; l++) {
        ROT_CHECK(fabs(1e144 * theta(k, &m, i, l) - theta(k, &want, i, l)) < 1e-13);
        ROT_CHECK(fabs(1e144 * omega(k, &m, i, l) - omega(k, &want, i, l)) < 1e-13);
      }
    }
    motion_free(&m);
  }
  motion_free(&want);
  /* At rest, and balanced as well as a double tells. */
  kit_number(k, "theta0_rad", 0.0);
  want = kit_run(k, NULL, 1e-9, 3, t);
  ROT_CHECK(ran(&want) && want.out.error == 0.0 && theta(k, &want, 2, 2) == 0.0);
  motion_free(&want);
  /* Next to upside-down: it leaves as cosh, and the figure knows. */
  const double up[3] = {pi - 1e-12, pi - 1e-12, pi - 1e-12}, fall[3] = {1.0, 2.0, 3.0};
  kit_numbers(k, "theta0_rad", 3, up);
  motion m = kit_run(k, NULL, 1e-9, 3, fall);
  want = kit_run(k, "chain_rk8pd", 1e-12, 3, fall);
  ROT_CHECK(ran(&m) && ran(&want) && m.out.error < 1e-7);
  check_same(k, &m, &want);
  ROT_CHECK(fabs(theta(k, &m, 2, 2) - pi) > 1e-6);
  motion_free(&m);
  motion_free(&want);
  /* Whole turns change nothing. */
  const double far[3] = {1e6, 1e6 + 0.5, 1e6 - 0.5};
  double near[3];
  for (int i = 0; i < 3; i++) near[i] = remainder(far[i], 2.0 * pi);
  kit_numbers(k, "theta0_rad", 3, far);
  m = kit_run(k, NULL, 1e-9, 3, t);
  kit_numbers(k, "theta0_rad", 3, near);
  want = kit_run(k, NULL, 1e-9, 3, t);
  for (size_t l = 0; l < 3; l++) {
    const double off = theta(k, &m, 1, l) - far[l] - (theta(k, &want, 1, l) - near[l]);
    ROT_CHECK(fabs(off) < 1e-8);
  }
  motion_free(&m);
  motion_free(&want);
  kit_free(k);
}

/* 16 links, whose rounding is followed like that of few. */
static void many_links(void) {
  double length[16], start[16];
  const double mass = 0.1, t[2] = {0.3, 1.0};
  for (int i = 0; i < 16; i++) length[i] = 0.1, start[i] = 1.2;
  kit *k = chain(16, length, 1, &mass, 0, 16, start, NULL);
  motion m = kit_run(k, NULL, 1e-8, 2, t), finer = kit_run(k, NULL, 1e-11, 2, t);
  ROT_CHECK(ran(&m) && m.out.error < 1e-7 && m.rows_per_time == 16);
  check_same(k, &m, &finer);
  check_audits(k, &m);
  motion_free(&m);
  motion_free(&finer);
  kit_free(k);
}

/* Time scales: of one point c/(m l^2) and sqrt(g/l); of two rods free of gravity that one joint
 * joins, the trace of M^-1 C. */
static void test_time_scales(void) {
  const double length[2] = {0.5, 0.5}, mass = 2.0, start = 0.3, sizes[2] = {1.0, 3.0};
  const double joint[2] = {0.0, 0.1};
  rot_time_scales scales;
  kit *k = chain(1, length, 1, &mass, 1, 1, &start, NULL);
  ROT_CHECK(kit_build(k) == ROT_OK);
  k->c->time_scales(k->scene, sizes, &scales);
  ROT_CHECK(isinf(scales.fades_s));
  ROT_CHECK_REL(scales.swing_rad_per_s, 6.0 + sqrt(GRAVITY / 0.5), 1e-14);
  kit_number(k, "resistance", 0.1);
  ROT_CHECK(kit_build(k) == ROT_OK);
  k->c->time_scales(k->scene, sizes, &scales);
  ROT_CHECK_REL(scales.fades_s, 2.0 * 0.25 / 0.1, 1e-14);
  /* m l^2 (4/3 1/2; 1/2 1/3) has the inverse (1/3 -1/2; -1/2 4/3) 36/7 over m l^2. */
  kit_numbers(k, "length_m", 2, length);
  kit_option(k, "links", 0);
  kit_numbers(k, "resistance", 2, joint);
  ROT_CHECK(kit_build(k) == ROT_OK);
  k->c->time_scales(k->scene, sizes, &scales);
  ROT_CHECK_REL(1.0 / scales.fades_s, 0.1 / (2.0 * 0.25) * (8.0 / 3.0) * (36.0 / 7.0), 1e-13);
  kit_free(k);
}

/* ---- what is refused ------------------------------------------------------------------------- */

static void refused_inputs(void) {
  const double length[3] = {1.0, 0.5, 0.8}, mass = 1.0, start = 0.1;
  double many[17];
  for (int i = 0; i < 17; i++) many[i] = 1.0;
  kit *k = chain(3, length, 1, &mass, 0, 1, &start, NULL);
  ROT_CHECK(kit_build(k) == ROT_OK);
  const char *const lists[] = {"mass_kg", "theta0_rad", "omega0_rad_per_s", "resistance"};
  for (int i = 0; i < 4; i++) {
    kit_numbers(k, lists[i], 3, many);
    ROT_CHECK(kit_build(k) == ROT_OK);
    kit_numbers(k, lists[i], 2, many);
    ROT_CHECK(kit_refuses(k, lists[i], i < 3 ? "3, one for each length" : "1 or 3 items"));
    kit_numbers(k, lists[i], 0, many);
    ROT_CHECK(kit_refuses(k, lists[i], "it has 0"));
    many[1] = NAN;
    kit_numbers(k, lists[i], 3, many);
    ROT_CHECK(kit_refuses(k, lists[i], "finite"));
    many[1] = 1.0;
    if (i < 2) {
      kit_unset(k, lists[i]);
      ROT_CHECK(kit_refuses(k, lists[i], "missing"));
    }
    kit_number(k, lists[i], 1.0);
    ROT_CHECK(kit_build(k) == ROT_OK);
  }
  kit_numbers(k, "length_m", 17, many);
  ROT_CHECK(kit_refuses(k, "length_m", "1 to 16"));
  kit_numbers(k, "length_m", 16, many);
  ROT_CHECK(kit_build(k) == ROT_OK);
  const double zero[2] = {1.0, 0.0}, below[2] = {0.5, -0.5};
  kit_numbers(k, "length_m", 2, zero);
  ROT_CHECK(kit_refuses(k, "length_m", "greater than 0"));
  kit_numbers(k, "length_m", 2, many);
  kit_numbers(k, "resistance", 2, below);
  ROT_CHECK(kit_refuses(k, "resistance", "at least 0"));
  kit_unset(k, "resistance");
  kit_number(k, "gravity_m_per_s2", -1.0);
  ROT_CHECK(kit_refuses(k, "gravity_m_per_s2", "at least 0"));
  kit_unset(k, "gravity_m_per_s2");
  const double graded[2] = {1.0, 1e-300}, huge[2] = {1e308, 1e308};
  kit_numbers(k, "mass_kg", 2, graded);
  ROT_CHECK(kit_refuses(k, "mass_kg", "double precision"));
  kit_numbers(k, "mass_kg", 2, huge);
  ROT_CHECK(kit_refuses(k, "mass_kg", "double precision"));
  kit_number(k, "mass_kg", 1.0);
  kit_numbers(k, "length_m", 2, huge);
  ROT_CHECK(kit_refuses(k, "length_m", "double precision"));
  kit_free(k);
}

/* The mode model's reasons. */
static void refused_modes(void) {
  const double length[2] = {1.0, 0.5}, mass = 1.0, small = 1e-7, large = 0.8,
               turn = 6.283185307179586;
  const double t = 1.0;
  char text[200];
  kit *k = chain(2, length, 1, &mass, 0, 1, &small, NULL);
  motion m = kit_run(k, "chain_modes", 1e-6, 1, &t);
  ROT_CHECK(ran(&m) && m.out.error < 1e-10);
  motion_free(&m);
  /* Its error beyond the accuracy. */
  m = kit_run(k, "chain_modes", 1e-14, 1, &t);
  ROT_CHECK(m.end == ROT_RUN_NO_MODEL);
  motion_free(&m);
  m = kit_run(k, NULL, 1e-13, 1, &t);
  ROT_CHECK(ran(&m) && !strcmp(m.out.model->id, "chain_rk8pd"));
  motion_free(&m);
  for (int i = 0; i < 4; i++) {
    const char *const words[] = {"half a radian", "half a radian", "without gravity", "viscous"};
    kit_number(k, "theta0_rad", i == 0 ? large : i == 1 ? turn : small);
    if (i == 2) kit_number(k, "gravity_m_per_s2", 0.0);
    if (i == 3) kit_unset(k, "gravity_m_per_s2");
    if (i == 3) kit_number(k, "resistance", 1e-3);
    m = kit_run(k, "chain_modes", 1e-3, 1, &t);
    ROT_CHECK(m.end == ROT_RUN_NO_MODEL);
    rot_choice_reason(k->c, &m.out.picked, sizeof text, text);
    ROT_CHECK(strstr(text, words[i]) != NULL);
    motion_free(&m);
    m = kit_run(k, NULL, 1e-8, 1, &t);
    ROT_CHECK(ran(&m) && strcmp(m.out.model->id, "chain_modes"));
    motion_free(&m);
  }
  kit_free(k);
}

int main(void) {
  equations();
  heavy_end();
  one_link();
  textbook_period();
  sizes_of_small_swings();
  mode_formulas();
  in_a_mode();
  mode_bound();
  balances();
  ends();
  stiff_joint();
  backwards();
  chaos();
  extremes();
  many_links();
  test_time_scales();
  refused_inputs();
  refused_modes();
  return rot_test_report("chain");
}
