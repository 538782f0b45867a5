/* For R: quadrature nodes and random points. */
#include "glue/ffi.h"
#include "body/density.h"

/* c(kind, low, high, stretch) => domain */
static rot_domain read_domain(SEXP x) {
  const double *v = ffi_reals(x, "domain", 10);
  if (!(v[0] >= 0.0 && v[0] < (double)ROT_DOMAIN_COUNT)) Rf_error("internal: no such domain");
  rot_domain domain = {.kind = (rot_domain_kind)v[0]};
  for (int k = 0; k < 3; k++) {
    domain.low[k] = v[1 + k];
    domain.high[k] = v[4 + k];
    domain.stretch[k] = v[7 + k];
  }
  return domain;
}

static size_t read_size(SEXP x, const char *what) {
  const double v = ffi_real(x, what);
  if (!(v >= 0.0 && v < 0x1p52)) Rf_error("internal: `%s` is not a size", what);
  return (size_t)v;
}

static const char *const node_names[] = {"x", "y", "z", "w"};

SEXP ffi_density_exponent(SEXP domain) {
  const rot_domain d = read_domain(domain);
  return Rf_ScalarReal((double)rot_domain_exponent(&d));
}

SEXP ffi_density_size(SEXP n) { return Rf_ScalarReal((double)rot_rule_size(read_size(n, "n"))); }

/* n => nodes and weights on [-1, 1], evenly spaced or Gauss-Legendre */
SEXP ffi_density_rule(SEXP n, SEXP even) {
  static const char *const names[] = {"t", "w"};
  const size_t size = read_size(n, "n");
  double *columns[2];
  rot_status status = ROT_OK;
  const int is_even = ffi_real(even, "even") > 0.0;
  if (rot_rule_size(size) != size && !is_even) Rf_error("internal: no rule of this size");
  SEXP out = ffi_columns(2, names, (R_xlen_t)size, columns);
  if (is_even) {
    rot_rule_even(size, columns[0], columns[1]);
  } else {
    status = rot_rule_gauss(size, columns[0], columns[1]);
  }
  if (status != ROT_OK) Rf_error("%s", rot_status_text(status));
  UNPROTECT(1);
  return out;
}

SEXP ffi_density_nodes(SEXP domain, SEXP rules, SEXP from, SEXP count) {
  const rot_domain d = read_domain(domain);
  const size_t first = read_size(from, "from"), n = read_size(count, "count");
  rot_rule rule[3];
  size_t all = 1;
  if (TYPEOF(rules) != VECSXP || XLENGTH(rules) != 3) Rf_error("internal: three rules");
  for (int k = 0; k < 3; k++) {
    SEXP one = VECTOR_ELT(rules, k);
    if (TYPEOF(one) != VECSXP || XLENGTH(one) != 2) Rf_error("internal: a rule is two columns");
    const R_xlen_t size = XLENGTH(VECTOR_ELT(one, 0));
    rule[k] = (rot_rule){(size_t)size, ffi_reals(VECTOR_ELT(one, 0), "t", size),
                         ffi_reals(VECTOR_ELT(one, 1), "w", size)};
    all *= (size_t)size;
  }
  if (first > all || n > all - first) Rf_error("internal: no such nodes");
  double *columns[4];
  SEXP out = ffi_columns(4, node_names, (R_xlen_t)n, columns);
  rot_density_nodes(&d, rule, first, n, columns[0], columns[1], columns[2], columns[3]);
  UNPROTECT(1);
  return out;
}

/* => nodes `from` on of the strata; key: seed, replicate */
SEXP ffi_density_strata(SEXP domain, SEXP side, SEXP key, SEXP from, SEXP count) {
  const rot_domain d = read_domain(domain);
  const double *k = ffi_reals(key, "key", 2);
  const size_t cells = read_size(side, "side"), first = read_size(from, "from"),
               n = read_size(count, "count");
  double *columns[4];
  SEXP out = ffi_columns(4, node_names, (R_xlen_t)n, columns);
  const rot_status status =
      rot_density_strata(&d, cells, (unsigned long)k[0], (unsigned long)k[1], first, n, columns[0],
                         columns[1], columns[2], columns[3]);
  if (status != ROT_OK) Rf_error("%s", rot_status_text(status));
  UNPROTECT(1);
  return out;
}
