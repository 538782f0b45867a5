/* For R: collisions of two bodies. */
#include "tables/collide.h"

#include "glue/run.h"
#include "body/inertia.h"

/* A matrix with one row, or one row per collision. */
typedef struct block {
  const double *x;
  R_xlen_t rows;
} block;

static double cell(block b, R_xlen_t i, int k) { return b.x[(b.rows == 1 ? 0 : i) + k * b.rows]; }

static block block_of(SEXP list, const char *name, int columns, R_xlen_t n) {
  SEXP x = ffi_element(list, name);
  block b = {NULL, TYPEOF(x) == REALSXP ? XLENGTH(x) / columns : 0};
  if (TYPEOF(x) != REALSXP || (b.rows != 1 && b.rows != n) || XLENGTH(x) != b.rows * columns)
    Rf_error("internal: `%s`", name);
  b.x = REAL(x);
  return b;
}

static int vector_of(block b, R_xlen_t i, double out[3]) {
  int known = 1;
  for (int k = 0; k < 3; k++) {
    out[k] = cell(b, i, k);
    known &= !ISNAN(out[k]);
  }
  return known;
}

typedef struct party {
  block mass, second, attitude, arm, v, omega;
  rot_principal principal;
} party;

static void party_of(SEXP list, R_xlen_t n, party *p) {
  p->mass = block_of(list, "mass_kg", 1, n);
  p->second = block_of(list, "second_moment_kg_m2", 9, n);
  p->attitude = block_of(list, "attitude", 9, n);
  p->arm = block_of(list, "arm_m", 3, n);
  p->v = block_of(list, "v", 3, n);
  p->omega = block_of(list, "omega", 3, n);
}

/* => body of collision i with principal moments and axes in space; returns 0 for NA. A second
 * moment at rounding level of the largest counts as 0. */
static int body_of(party *p, R_xlen_t i, rot_collide_body *body) {
  double c[ROT_TENSOR], turn[9];
  int known = 1;
  body->mass = cell(p->mass, i, 0);
  for (int k = 0; k < 9; k++) {
    turn[k] = cell(p->attitude, i, k);
    known &= !ISNAN(turn[k]);
  }
  known &= vector_of(p->arm, i, body->arm) & vector_of(p->v, i, body->v) &
           vector_of(p->omega, i, body->omega);
  if (i == 0 || p->second.rows > 1) {
    for (int k = 0; k < ROT_TENSOR; k++)
      c[k] = cell(p->second, i, rot_tensor_row[k] + 3 * rot_tensor_column[k]);
    if (rot_inertia_principal(c, 1e-12, &p->principal) != ROT_OK) Rf_error("internal: `second`");
  }
  double second[3];
  for (int j = 0; j < 3; j++) {
    const double own = p->principal.second[j];
    second[j] = own > 1e-15 * p->principal.second[0] ? own : 0.0;
  }
  for (int j = 0; j < 3; j++) {
    body->moment[j] = second[(j + 1) % 3] + second[(j + 2) % 3];
    for (int k = 0; k < 3; k++) {
      body->axes[j][k] = 0.0;
      for (int l = 0; l < 3; l++) /* a matrix of R: element (k, l) at k + 3 l */
        body->axes[j][k] += turn[k + 3 * l] * p->principal.axes[3 * l + j];
    }
  }
  return known;
}

enum { MAX_COLUMNS = 20 };

/* two bodies (second NULL: a fixed obstacle), normals, coefficients, law of n collisions => list(
 * columns, first row where a body has no moment) */
SEXP ffi_collide(SEXP first, SEXP second, SEXP contact, SEXP rows) {
  static const char *const one[] = {"vx_1_m_per_s",        "vy_1_m_per_s",
                                    "vz_1_m_per_s",        "omega_x_1_rad_per_s",
                                    "omega_y_1_rad_per_s", "omega_z_1_rad_per_s"};
  static const char *const two[] = {"vx_2_m_per_s",        "vy_2_m_per_s",
                                    "vz_2_m_per_s",        "omega_x_2_rad_per_s",
                                    "omega_y_2_rad_per_s", "omega_z_2_rad_per_s"};
  static const char *const rest[] = {
      "impulse_x_n_s",        "impulse_y_n_s", "impulse_z_n_s",   "normal_impulse_n_s",
      "friction_impulse_n_s", "normal_loss_j", "friction_loss_j", "sticks"};
  const int bodies = Rf_isNull(second) ? 1 : 2;
  const R_xlen_t n = (R_xlen_t)ffi_real(rows, "rows");
  const int law = (int)ffi_number_of(contact, "law");
  party parties[2];
  party_of(first, n, &parties[0]);
  if (bodies == 2) party_of(second, n, &parties[1]);
  const block normal = block_of(contact, "normal", 3, n);
  const block restitution = block_of(contact, "restitution", 1, n);
  const block friction = block_of(contact, "friction", 1, n);
  const char *names[MAX_COLUMNS];
  double *c[MAX_COLUMNS];
  int columns = 0;
  for (int k = 0; k < 6; k++) names[columns++] = one[k];
  for (int k = 0; k < 6 && bodies == 2; k++) names[columns++] = two[k];
  for (int k = 0; k < 8; k++) names[columns++] = rest[k];
  SEXP out = ffi_columns(columns, names, n, c);
  double bad = 0.0; /* first row without a moment, from 1; 0: none */
  for (R_xlen_t i = 0; i < n; i++) {
    rot_collide_input in = {.law = (rot_restitution)law};
    rot_collide_end end;
    if (i % 4096 == 4095) R_CheckUserInterrupt(); /* nothing here needs to be freed */
    int known = vector_of(normal, i, in.normal);
    in.body[1].mass = R_PosInf;
    for (int b = 0; b < bodies; b++) known &= body_of(&parties[b], i, &in.body[b]);
    in.restitution = cell(restitution, i, 0);
    in.friction = cell(friction, i, 0);
    known &= !ISNAN(in.restitution) && !ISNAN(in.friction);
    const rot_collide_status status = known ? rot_collide(&in, &end) : ROT_COLLIDE_OK;
    if (status == ROT_COLLIDE_NO_MOMENT && !(bad > 0.0)) bad = (double)(i + 1);
    if (!known || status != ROT_COLLIDE_OK) {
      for (int k = 0; k < columns; k++) c[k][i] = known ? R_NaN : NA_REAL;
      continue;
    }
    int k = 0;
    for (int b = 0; b < bodies; b++) {
      for (int j = 0; j < 3; j++) c[k++][i] = end.v[b][j];
      for (int j = 0; j < 3; j++) c[k++][i] = end.omega[b][j];
    }
    for (int j = 0; j < 3; j++) c[k++][i] = end.impulse[j];
    c[k++][i] = end.normal_impulse;
    c[k++][i] = end.friction_impulse;
    c[k++][i] = end.normal_loss;
    c[k++][i] = end.friction_loss;
    c[k][i] = end.sticks;
  }
  SEXP result = PROTECT(Rf_allocVector(VECSXP, 2));
  SET_VECTOR_ELT(result, 0, out);
  SET_VECTOR_ELT(result, 1, Rf_ScalarReal(bad));
  UNPROTECT(2);
  return result;
}
