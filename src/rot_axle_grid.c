#include "rot_axle_grid.h"

#include <math.h>

#include "rot_pair.h"
#include "rot_phi.h"
#include "rot_real.h"

enum { LEVELS = 8 };

/* A row may be off the even grid by so much of a step: its state is carried over to first order,
 * and what that leaves is below 1e-16 of it. Rounded times are off by 1e-12 of a step or less. */
#define UNEVEN 1e-9

/* One step of length h d:  omega1 = decay omega0 + (near tau0 + far tau1),
 * theta1 = theta0 + reach omega0 + (near_theta tau0 + far_theta tau1). */
typedef struct grid_step {
  double decay, near, far, reach, near_theta, far_theta;
} grid_step;

static void make_steps(const rot_axle_params *p, double d, grid_step step[LEVELS]) {
  const double I = p->inertia_kg_m2, c = p->viscous_n_m_s;
  double z[ROT_LANES] = {0.0}, z_lo[ROT_LANES] = {0.0};
  rot_phi_lanes phi;
  for (int m = 0; m < LEVELS && m < ROT_LANES; m++) {
    double cs_lo;
    const double s = ldexp(d, m), cs = rot_two_prod(c, s, &cs_lo);
    z[m] = cs / I;
    z_lo[m] = (fma(-z[m], I, cs) + cs_lo) / I;
  }
  rot_phi_in_lanes(z, z_lo, &phi);
  for (int m = 0; m < LEVELS && m < ROT_LANES; m++) {
    const double s = ldexp(d, m), u = s / I;
    step[m].decay = phi.phi0[m];
    step[m].near = u * phi.g1[m];
    step[m].far = u * phi.phi2[m];
    step[m].reach = s * phi.phi1[m];
    step[m].near_theta = s * u * (phi.phi2[m] - phi.phi3[m]);
    step[m].far_theta = s * u * phi.phi3[m];
  }
}

/* Rows first .. first + rows - 1 from rows 0 .. rows - 1. */
static void double_rows(const grid_step *step, size_t first, size_t rows, double theta[],
                        double omega[], const double tau[]) {
  size_t j = 0;
  for (; j + ROT_PAIR <= rows; j += ROT_PAIR) {
    const rot_pair w = rot_load(omega + j), t0 = rot_load(tau + j), t1 = rot_load(tau + first + j);
    rot_store(omega + first + j,
              ROT_BOTH(step->decay) * w + (ROT_BOTH(step->near) * t0 + ROT_BOTH(step->far) * t1));
    rot_store(theta + first + j,
              rot_load(theta + j) + (ROT_BOTH(step->reach) * w + (ROT_BOTH(step->near_theta) * t0 +
                                                                  ROT_BOTH(step->far_theta) * t1)));
  }
  for (; j < rows; j++) {
    const double t0 = tau[j], t1 = tau[first + j];
    omega[first + j] = step->decay * omega[j] + (step->near * t0 + step->far * t1);
    theta[first + j] =
        theta[j] + (step->reach * omega[j] + (step->near_theta * t0 + step->far_theta * t1));
  }
}

/* How many of the rows lie on the grid of the first and the last of them; off[j]: by how much. */
static size_t even_rows(size_t n, const double time_s[], double *d, double off[]) {
  if (n < ROT_GRID_LEAST) return 0;
  const double t0 = time_s[0];
  *d = (time_s[n - 1] - t0) / (double)(n - 1);
  double worst = 0.0;
  for (size_t j = 0; j < n; j++) {
    off[j] = (time_s[j] - t0) - (double)j * *d;
    worst = fabs(off[j]) > worst ? fabs(off[j]) : worst;
  }
  return worst <= UNEVEN * *d ? n : 0;
}

size_t rot_axle_grid_rows(const rot_axle_params *p, const rot_axle_state *base,
                          const rot_torque_piece *piece, size_t n, const double time_s[],
                          const rot_axle_columns *out, rot_info *info) {
  const double I = p->inertia_kg_m2, c = p->viscous_n_m_s;
  const double a = piece->start_n_m, b = piece->end_n_m;
  double d, off[ROT_GRID_ROWS], at[ROT_GRID_ROWS], tau[ROT_GRID_ROWS];
  double theta[ROT_GRID_ROWS], omega[ROT_GRID_ROWS];
  if (a * b < 0.0) return 0; /* the torque's digits at its zero need the careful path */
  if (n > ROT_GRID_ROWS) n = ROT_GRID_ROWS;
  n = even_rows(n, time_s, &d, off);
  /* Lanes of phi functions reach to z = 3. */
  if (n == 0 || !(c * d * ROT_GRID_ROWS < 5.9 * I)) return 0;

  /* Torque at the rows, and on the grid. */
  const double span = piece->end_s - piece->start_s, slope = a == b ? 0.0 : (b - a) / span;
  for (size_t j = 0; j < n; j++) {
    at[j] = a == b ? a : (a * (piece->end_s - time_s[j]) + b * (time_s[j] - piece->start_s)) / span;
    tau[j] = at[j] - slope * off[j];
  }

  grid_step step[LEVELS];
  make_steps(p, d, step);
  const rot_axle_state first = rot_axle_step(p, base, piece, time_s[0]);
  theta[0] = first.theta_rad;
  omega[0] = first.omega_rad_per_s;
  int levels = 0;
  for (size_t h = 1; h < n; h *= 2, levels++) {
    double_rows(&step[levels], h, h < n - h ? h : n - h, theta, omega, tau);
  }

  double omega_max = 0.0, theta_max = 0.0;
  for (size_t j = 0; j < n; j++) {
    const double slow = omega[j], turned = theta[j] + slow * off[j];
    const double fast = slow + (tau[j] - c * slow) / I * off[j];
    rot_axle_row(p, out, j, turned, fast, at[j]);
    theta_max = fabs(turned) > theta_max ? fabs(turned) : theta_max;
    omega_max = fabs(fast) > omega_max ? fabs(fast) : omega_max;
  }

  /* A step rounds its coefficients (4 units) and their products and sums (4 units). */
  const grid_step *last = &step[levels - 1];
  const double torque = fmax(fabs(a), fabs(b)), rounding = 8.0 * ROT_EPS * levels;
  const double omega_error =
      first.omega_error + rounding * (omega_max + (last->near + last->far) * torque);
  const double theta_error =
      first.theta_error + 2.0 * last->reach * omega_error +
      rounding * (last->reach * omega_max + (last->near_theta + last->far_theta) * torque) +
      2.0 * ROT_EPS * levels * theta_max;
  info->theta_max = fmax(info->theta_max, theta_max);
  info->omega_max = fmax(info->omega_max, omega_max);
  info->theta_error = fmax(info->theta_error, theta_error);
  info->omega_error = fmax(info->omega_error, omega_error);
  return n;
}
