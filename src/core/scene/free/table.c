#include "scene/free/table.h"

#include <math.h>

#include "maths/attitude.h"
#include "scene/free/motion.h"
#include "scene/free/kernel.h"
#include "ground/parallel.h"
#include "ground/simd.h"

enum { PART = 2048, BLOCK = ROT_FREE_BLOCK };

typedef struct frame {
  const rot_free_table_rows *rows;
  const rot_free_table_columns *out;
  int simd;
} frame;

/* Row i by rot_free_begin() and rot_free_at(), for any numbers. */
static void any_row(const rot_free_table_rows *in, size_t i, const rot_free_table_columns *out) {
  double moment[3], omega[3], q0[4], q[4] = {NAN, NAN, NAN, NAN};
  rot_free_motion motion;
  rot_free_state at = {{NAN, NAN, NAN, NAN}, {NAN, NAN, NAN}, NAN, NAN};
  const double t = rot_at(in->time_s, i);
  for (int k = 0; k < 3; k++) {
    moment[k] = rot_at(in->moment_kg_m2[k], i);
    omega[k] = rot_at(in->omega_rad_per_s[k], i);
  }
  for (int k = 0; k < 4; k++) q0[k] = rot_at(in->q[k], i);
  if (isfinite(t) && rot_free_begin(moment, omega, 0.0, &motion) == ROT_OK) {
    rot_free_at(&motion, (rot_dd){t, 0.0}, &at);
    (void)rot_attitude_unit(q0);
    rot_attitude_times(q0, at.q, q);
    (void)rot_attitude_unit(q);
  }
  out->final_qw[i] = q[0];
  out->final_qx[i] = q[1];
  out->final_qy[i] = q[2];
  out->final_qz[i] = q[3];
  out->final_omega_x_rad_per_s[i] = at.omega[0];
  out->final_omega_y_rad_per_s[i] = at.omega[1];
  out->final_omega_z_rad_per_s[i] = at.omega[2];
  out->error[i] = at.q_error + 8.0 * ROT_EPS;
  if (out->omega_error) out->omega_error[i] = at.omega_error;
}

/* Unused lanes get NaN: the kernel computes another body for them. */
static void load(rot_column column, size_t first, size_t n, double to[BLOCK]) {
  for (size_t l = 0; l < n; l++) to[l] = rot_at(column, first + l);
  for (size_t l = n; l < BLOCK; l++) to[l] = NAN;
}

/* n rows by the kernel; any_row() if it does not apply. */
static void block_rows(const frame *f, size_t first, size_t n) {
  const rot_free_table_rows *in = f->rows;
  const rot_free_table_columns *out = f->out;
  rot_free_block x;
  for (int k = 0; k < 3; k++) {
    load(in->moment_kg_m2[k], first, n, x.moment[k]);
    load(in->omega_rad_per_s[k], first, n, x.omega[k]);
  }
  for (int k = 0; k < 4; k++) load(in->q[k], first, n, x.q[k]);
  load(in->time_s, first, n, x.time);
  if (f->simd)
    rot_free_pass_simd(&x);
  else
    rot_free_pass(&x);
  for (size_t l = 0; l < n; l++) {
    const size_t i = first + l;
    out->final_qw[i] = x.q[0][l];
    out->final_qx[i] = x.q[1][l];
    out->final_qy[i] = x.q[2][l];
    out->final_qz[i] = x.q[3][l];
    out->final_omega_x_rad_per_s[i] = x.omega[0][l];
    out->final_omega_y_rad_per_s[i] = x.omega[1][l];
    out->final_omega_z_rad_per_s[i] = x.omega[2][l];
    out->error[i] = x.error[l] + 8.0 * ROT_EPS;
    if (out->omega_error) out->omega_error[i] = x.omega_error[l];
    if (!(x.good[l] > 0.0)) any_row(in, i, out);
  }
}

static void table_rows(const void *of, size_t first, size_t last) {
  for (size_t i = first; i < last; i += BLOCK) {
    block_rows(of, i, last - i < BLOCK ? last - i : BLOCK);
  }
}

rot_status rot_free_table(const rot_free_table_rows *rows, int threads,
                          const rot_free_table_columns *out, const rot_hooks *hooks,
                          rot_info *info) {
  const frame f = {rows, out, rot_simd_fma_ok()};
  return rot_parallel_rows(table_rows, &f, rows->n, PART, threads, hooks, info);
}
