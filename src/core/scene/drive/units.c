#include "scene/drive/units.h"

#include <string.h>

/* Sums inertia and viscous coefficients of geared rotors at the first shaft. */
rot_status rot_drive_units_of(const rot_drive_scene *scene, rot_store *store, rot_drive_units *u) {
  const size_t n = scene->n;
  long double product = 1.0L; /* as in R */
  u->n = n;
  u->m = 0;
  u->unit = rot_store_get(store, n, 2 * sizeof *u->unit);
  u->ratio = rot_store_get(store, n, 4 * sizeof *u->ratio);
  if (!u->unit || !u->ratio) return ROT_ENOMEM;
  u->between = u->unit + n;
  u->inertia_kg_m2 = u->ratio + n;
  u->viscous_n_m_s = u->inertia_kg_m2 + n;
  u->omega0_rad_per_s = u->viscous_n_m_s + n;
  for (size_t i = 0; i < n; i++) {
    const rot_axle_scene *r = &scene->rotor[i];
    const int first = i == 0 || scene->coupling[i - 1].kind != ROT_DRIVE_GEAR;
    if (i > 0) product *= scene->coupling[i - 1].ratio;
    if (first && i > 0) u->between[u->m - 1] = i - 1;
    const double P = u->ratio[i] = (double)product;
    const size_t k = u->unit[i] = first ? u->m++ : u->m - 1;
    if (first) u->omega0_rad_per_s[k] = r->linear.omega0_rad_per_s * P;
    u->inertia_kg_m2[k] += r->linear.inertia_kg_m2 / P / P;
    u->viscous_n_m_s[k] += r->viscous_n_m_s / P / P;
  }
  return ROT_OK;
}

/* ---- torques --------------------------------------------------------------------------------- */

int rot_drive_of_time(const rot_axle_scene *r) {
  for (size_t i = 0; i < r->n_terms; i++) {
    const rot_term_kind kind = r->terms[i].kind;
    if (kind != ROT_TERM_SINUSOID && kind != ROT_TERM_EXPONENTIAL && kind != ROT_TERM_POLYNOMIAL) {
      return 0;
    }
  }
  return !r->linear.torque.call;
}

int rot_drive_stepped(const rot_axle_scene *r) {
  const rot_torque *knots = &r->linear.torque;
  for (size_t i = 1; i < knots->n; i++) {
    const int difference = knots->time_s[i] > knots->time_s[i - 1];
    if (difference && knots->torque_n_m[i] != knots->torque_n_m[i - 1]) return 0;
  }
  return !knots->call && !r->n_terms && r->motor_n_m_s == 0.0;
}

int rot_drive_constant(const rot_axle_scene *r) {
  return rot_drive_stepped(r) && !r->linear.torque.n;
}

static rot_status scale_knots(rot_torque *knots, double by, rot_store *store) {
  double *torque = rot_store_get(store, knots->n, sizeof *torque);
  if (!torque) return ROT_ENOMEM;
  for (size_t i = 0; i < knots->n; i++) torque[i] = by * knots->torque_n_m[i];
  knots->torque_n_m = torque;
  knots->before_n_m *= by;
  knots->after_n_m *= by;
  return ROT_OK;
}

/* Layout of a polynomial term: n pieces, m coefficients each, n + 1 breaks, coefficients. */
static rot_status scale_term(rot_term *term, double by, rot_store *store) {
  double *x = rot_store_get(store, term->length, sizeof *x);
  if (!x) return ROT_ENOMEM;
  memcpy(x, term->x, term->length * sizeof *x);
  const int pieces = term->kind == ROT_TERM_POLYNOMIAL;
  const size_t first = pieces ? 3 + (size_t)x[0] : 0, end = pieces ? term->length : 1;
  for (size_t i = first; i < end; i++) x[i] *= by;
  term->x = x;
  return ROT_OK;
}

/* Loads of each rotor, scaled to the first shaft and added. */
rot_status rot_drive_unit_loads(const rot_drive_scene *scene, const rot_drive_units *u, size_t k,
                                rot_store *store, rot_loads *loads) {
  size_t n_terms = 0, n_knots = 0;
  for (size_t i = 0; i < u->n; i++) n_terms += scene->rotor[i].n_terms;
  rot_torque *knots = rot_store_get(store, u->n, sizeof *knots);
  rot_term *terms = rot_store_get(store, n_terms, sizeof *terms);
  if (!knots || !terms) return ROT_ENOMEM;
  memset(loads, 0, sizeof *loads);
  for (size_t i = 0; i < u->n; i++) {
    const rot_axle_scene *r = &scene->rotor[i];
    const double P = u->ratio[i];
    if (u->unit[i] != k) continue;
    rot_torque *own = &knots[n_knots++];
    *own = r->linear.torque;
    rot_status status = P == 1.0 ? ROT_OK : scale_knots(own, 1.0 / P, store);
    for (size_t j = 0; j < r->n_terms && status == ROT_OK; j++) {
      terms[loads->n_terms] = r->terms[j];
      if (P != 1.0) status = scale_term(&terms[loads->n_terms], 1.0 / P, store);
      loads->n_terms++;
    }
    if (status != ROT_OK) return status;
    loads->motor_n_m_s += r->motor_n_m_s / P / P;
  }
  loads->terms = terms;
  return rot_loads_add_knots(n_knots, knots, store, &loads->knots);
}
