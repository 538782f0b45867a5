/* For R: sums of forces, static equilibrium. */
#include "tables/statics.h"

#include "glue/run.h"

/* points, forces, couples (3 numbers each) => sums about a point, central axis */
SEXP ffi_statics_sums(SEXP at, SEXP force, SEXP couple, SEXP about) {
  static const char *const names[] = {"force", "torque", "point", "axis", ""};
  const double *r = ffi_reals(at, "at", -1);
  const R_xlen_t n = XLENGTH(at);
  const double *origin = ffi_reals(about, "about", 3);
  const rot_sums sums = rot_statics_sums((size_t)n / 3, r, ffi_reals(force, "force", n),
                                         ffi_reals(couple, "couple", n), origin);
  const rot_axis axis = rot_statics_axis(&sums, origin);
  const double numbers[] = {axis.kind, axis.couple, axis.pitch_m, sums.force_terms,
                            sums.torque_terms};
  const ffi_vector parts[] = {{3, sums.force}, {3, sums.torque}, {3, axis.point}, {5, numbers}};
  return ffi_vectors(4, names, parts);
}

/* list => structure; its arrays are valid until the call from R ends */
static rot_structure read_structure(SEXP list) {
  rot_structure s;
  SEXP couples = ffi_element(list, "is_couple"), friction = ffi_element(list, "friction");
  const R_xlen_t k = XLENGTH(couples), c = XLENGTH(friction);
  const double *is_couple = ffi_reals(couples, "is_couple", k);
  const double *one_sided = ffi_numbers_of(list, "one_sided", k);
  const double *at = ffi_numbers_of(list, "at", 3 * k);
  const double *from = ffi_numbers_of(list, "from", 3 * k);
  const double *to = ffi_numbers_of(list, "to", 3 * k);
  const double *mu = ffi_reals(friction, "friction", c);
  const double *first = ffi_numbers_of(list, "first", c);
  const double *normal = ffi_numbers_of(list, "normal", 3 * c);
  rot_reaction *reaction = (rot_reaction *)R_alloc((size_t)k + 1, sizeof *reaction);
  rot_contact *contact = (rot_contact *)R_alloc((size_t)c + 1, sizeof *contact);
  s.plane = ffi_number_of(list, "plane") > 0.0;
  for (R_xlen_t j = 0; j < k; j++) {
    for (int i = 0; i < 3; i++) {
      reaction[j].at[i] = at[3 * j + i];
      reaction[j].from[i] = from[3 * j + i];
      reaction[j].to[i] = to[3 * j + i];
    }
    reaction[j].is_couple = is_couple[j] > 0.0;
    reaction[j].one_sided = one_sided[j] > 0.0;
  }
  for (R_xlen_t j = 0; j < c; j++) {
    if (!(first[j] >= 0.0 && first[j] + (s.plane ? 2.0 : 3.0) <= (double)k))
      Rf_error("internal: `first`");
    contact[j].first = (size_t)first[j];
    contact[j].friction = mu[j];
    for (int i = 0; i < 3; i++) contact[j].normal[i] = normal[3 * j + i];
  }
  SEXP load_at = ffi_element(list, "load_at");
  const R_xlen_t n = XLENGTH(load_at);
  s.reactions = (size_t)k;
  s.contacts = (size_t)c;
  s.loads = (size_t)n / 3;
  s.reaction = reaction;
  s.contact = contact;
  s.load_at = ffi_reals(load_at, "load_at", n);
  s.load_force = ffi_numbers_of(list, "load_force", n);
  s.load_couple = ffi_numbers_of(list, "load_couple", n);
  s.rank_tolerance = ffi_number_of(list, "rank_tolerance");
  return s;
}

/* structure => reactions, errors, ranges, motion, state */
SEXP ffi_statics_solve(SEXP list) {
  static const char *const names[] = {"reaction", "error", "determined", "lowest", "highest",
                                      "sigma",    "about", "velocity",   "omega",  "state",
                                      ""};
  const rot_structure s = read_structure(list);
  const size_t k = s.reactions;
  double *x = (double *)R_alloc(5 * k + 1, sizeof *x);
  int *determined = (int *)R_alloc(k + 1, sizeof *determined);
  rot_rest rest;
  const rot_status status =
      rot_statics_solve(&s, x, x + k, determined, x + 2 * k, x + 3 * k, &rest);
  for (size_t j = 0; j < k; j++) x[4 * k + j] = status == ROT_OK && determined[j];
  const double state[] = {(double)status,         (double)rest.equations, (double)rest.rank,
                          (double)rest.driven,    (double)rest.rests,     (double)rest.sticks,
                          (double)rest.projected, rest.residual_force,    rest.residual_torque};
  const int size = (int)k, equations = (int)rest.equations;
  const ffi_vector parts[] = {{size, x},         {size, x + k},      {size, x + 4 * k},
                              {size, x + 2 * k}, {size, x + 3 * k},  {equations, rest.sigma},
                              {3, rest.about},   {3, rest.velocity}, {3, rest.omega},
                              {9, state}};
  return ffi_vectors(10, names, parts);
}

/* => c(status, min, max factor); chosen: a number per load, > 0 if the factor applies to it */
SEXP ffi_statics_factors(SEXP list, SEXP chosen) {
  const rot_structure s = read_structure(list);
  const double *wanted = ffi_reals(chosen, "chosen", (R_xlen_t)s.loads);
  int *flags = (int *)R_alloc(s.loads + 1, sizeof *flags);
  double limits[2];
  for (size_t i = 0; i < s.loads; i++) flags[i] = wanted[i] > 0.0;
  const rot_status status = rot_statics_factors(&s, flags, limits);
  const double out[] = {(double)status, limits[0], limits[1]};
  return ffi_numbers(3, out);
}
