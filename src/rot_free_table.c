#include "rot_free_table.h"

#include <math.h>

#include "rot_attitude.h"
#include "rot_free_motion.h"
#include "rot_share.h"

enum { CHUNK = 2048 };

typedef struct frame {
  const rot_free_table_rows *rows;
  const rot_free_table_columns *out;
} frame;

static void row(const rot_free_table_rows *in, size_t i, const rot_free_table_columns *out) {
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
}

static void table_rows(const void *of, size_t first, size_t last) {
  const frame *f = of;
  for (size_t i = first; i < last; i++) row(f->rows, i, f->out);
}

rot_status rot_free_table(const rot_free_table_rows *rows, int threads,
                          const rot_free_table_columns *out, const rot_hooks *hooks,
                          rot_info *info) {
  const frame f = {rows, out};
  return rot_share_rows(table_rows, &f, rows->n, CHUNK, threads, hooks, info);
}
