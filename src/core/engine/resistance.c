#include "engine/resistance.h"

#include <float.h>
#include <math.h>
#include <string.h>

enum { VISCOUS, QUADRATIC, COULOMB, STATIC, DAMPING, DRAG, DRAG_2, TERMS };

static const rot_input inputs[TERMS] = {
    [VISCOUS] = ROT_NUMBER_INPUT("viscous_n_m_s", "N*m*s", 0, -DBL_MAX, 0, 0.0,
                                 "torque over the angular velocity; below 0 it drives"),
    [QUADRATIC] = ROT_NUMBER_INPUT("quadratic_n_m_s2", "N*m*s^2", 0, 0.0, 0, 0.0,
                                   "torque over the square of the angular velocity"),
    [COULOMB] = ROT_NUMBER_INPUT("coulomb_n_m", "N*m", 0, 0.0, 0, 0.0, "sliding friction"),
    [STATIC] = ROT_NUMBER_INPUT("static_n_m", "N*m", 0, 0.0, 0, NAN,
                                "largest static friction; default: the sliding one"),
    [DAMPING] = ROT_NUMBER_INPUT("damping_per_s", "1/s", 0, -DBL_MAX, 0, 0.0,
                                 "of a body in space: torque over the angular momentum"),
    [DRAG] = ROT_NUMBER_INPUT("drag_n_s_per_m", "N*s/m", 0, 0.0, 0, 0.0,
                              "linear drag on the centre of mass"),
    [DRAG_2] = ROT_NUMBER_INPUT("drag_n_s2_per_m2", "N*s^2/m^2", 0, 0.0, 0, 0.0,
                                "quadratic drag on the centre of mass")};

static rot_status build(const rot_part *part, const rot_given given[], rot_store *store, void *to,
                        rot_refusal *no) {
  double x[TERMS];
  (void)part, (void)store;
  rot_input_numbers(TERMS, inputs, given, x);
  if (!given[STATIC].is) x[STATIC] = x[COULOMB];
  *(rot_resistance *)to = (rot_resistance){x[VISCOUS], x[QUADRATIC], x[COULOMB], x[STATIC],
                                           x[DAMPING], x[DRAG],      x[DRAG_2]};
  if (x[STATIC] >= x[COULOMB]) return ROT_OK;
  return rot_refuse_numbers(no, STATIC, "must be at least the sliding friction, %s; it is %s",
                            x[COULOMB], x[STATIC]);
}

const rot_part rot_resistance_part = {"resistance", ROT_INPUT_RESISTANCE,   TERMS,
                                      inputs,       sizeof(rot_resistance), build};

const char *const rot_axle_resistance[] = {"viscous_n_m_s", "quadratic_n_m_s2", "coulomb_n_m",
                                           "static_n_m", NULL};
const char *const rot_viscous_resistance[] = {"viscous_n_m_s", NULL};
const char *const rot_drag_resistance[] = {"drag_n_s_per_m", NULL};

static void list_of(const rot_resistance *r, double x[TERMS]) {
  x[VISCOUS] = r->viscous_n_m_s;
  x[QUADRATIC] = r->quadratic_n_m_s2;
  x[COULOMB] = r->coulomb_n_m;
  x[STATIC] = r->static_n_m;
  x[DAMPING] = r->damping_per_s;
  x[DRAG] = r->drag_n_s_per_m;
  x[DRAG_2] = r->drag_n_s2_per_m2;
}

static int takes(const rot_input *input, const char *term) {
  size_t i = 0;
  while (input->options[i] && strcmp(input->options[i], term)) i++;
  return input->options[i] != NULL;
}

rot_status rot_resistance_of(const rot_input *input, size_t at, const rot_given *given,
                             rot_resistance *terms, rot_refusal *no) {
  *terms = (rot_resistance){0};
  if (given->is != ROT_INPUT_RESISTANCE) return ROT_OK;
  *terms = *(const rot_resistance *)given->object;
  const double x[TERMS] = {terms->viscous_n_m_s,   terms->quadratic_n_m_s2, terms->coulomb_n_m,
                           terms->static_n_m,      terms->damping_per_s,    terms->drag_n_s_per_m,
                           terms->drag_n_s2_per_m2};
  for (size_t i = 0; i < TERMS; i++) {
    if (x[i] == 0.0 || takes(input, inputs[i].name)) continue;
    return rot_refuse(no, at, "has the term `%s`, which this scene does not take: it takes `%s`%s",
                      inputs[i].name, input->options[0], input->options[1] ? " and others" : "");
  }
  return ROT_OK;
}

rot_status rot_resistance_numbers(size_t n, const rot_input of[], const rot_given given[],
                                  double x[], rot_refusal *no) {
  rot_input_numbers(n, of, given, x);
  for (size_t i = 0; i < n; i++) {
    rot_resistance terms;
    double each[TERMS];
    if (!(of[i].kinds & ROT_INPUT_RESISTANCE)) continue;
    const rot_status status = rot_resistance_of(&of[i], i, &given[i], &terms, no);
    if (status != ROT_OK) return status;
    list_of(&terms, each);
    x[i] = each[rot_input_named(TERMS, inputs, of[i].options[0])];
  }
  return ROT_OK;
}

rot_status rot_resistance_each(const rot_input *input, size_t at, const rot_given *given, size_t n,
                               double viscous_n_m_s[], rot_refusal *no) {
  const int one = given->is != ROT_INPUT_LIST && given->n == 1;
  if (given->is && !one && given->n != n) {
    return n > 1 ? rot_refuse(no, at, "must have 1 or %zu items; it has %zu", n, given->n)
                 : rot_refuse(no, at, "must have one item; it has %zu", given->n);
  }
  for (size_t i = 0; i < n; i++) {
    const rot_given *g = given->is == ROT_INPUT_LIST ? &given->item[i] : given;
    rot_resistance terms;
    const rot_status status = rot_resistance_of(input, at, g, &terms, no);
    if (status != ROT_OK) return status;
    const int is_number = g->is && g->is != ROT_INPUT_RESISTANCE;
    if (is_number && g == given) {
      viscous_n_m_s[i] = g->x[one ? 0 : i];
    } else if (is_number && g->n != 1) {
      return rot_refuse(no, at, "item %zu must be one number", i + 1);
    } else {
      viscous_n_m_s[i] = is_number ? g->x[0] : terms.viscous_n_m_s;
    }
    if (!isfinite(viscous_n_m_s[i])) return rot_refuse(no, at, "must be finite");
    if (!(viscous_n_m_s[i] >= input->low)) {
      return rot_refuse(no, at, "must be at least %g; item %zu is %g", input->low, i + 1,
                        viscous_n_m_s[i]);
    }
  }
  return ROT_OK;
}
