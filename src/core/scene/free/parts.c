#include "scene/free/parts.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "ground/exact.h"
#include "maths/attitude.h"

const char *const rot_free_arguments[] = {"omega_rad_per_s:3", "attitude:4", NULL};

void rot_free_read_attitude(const double given[4], double q[4]) {
  double difference = 0.0;
  (void)rot_attitude_from(ROT_FORM_QUATERNION, given, NULL, q);
  for (int i = 0; i < 4; i++) difference = fmax(difference, fabs(q[i] - given[i]));
  if (difference <= 8.0 * ROT_EPS) memcpy(q, given, 4 * sizeof *q);
}

/* ---- tables of torques ----------------------------------------------------------------------- */

#define TORQUES(name, words)                                                                       \
  { name, "N*m", ROT_INPUT_NUMBERS, 0, ROT_NO_DOMAIN, NAN, words, NULL }

static const rot_input table_inputs[] = {
    {"time_s", "s", ROT_INPUT_NUMBERS, 1, ROT_NO_DOMAIN, NAN,
     "not decreasing: linear between, 0 before and after; a repeated time is a jump", NULL},
    TORQUES("torque_n_m", "of a motor, at each time"),
    TORQUES("x_n_m", "of a body, at each time"),
    TORQUES("y_n_m", "likewise"),
    TORQUES("z_n_m", "likewise")};

/* inputs => rot_free_table_of, or a refusal. */
static rot_status build_table(const rot_part *part, const rot_given given[], rot_store *store,
                              void *to, rot_refusal *no) {
  rot_free_table_of *table = to;
  const size_t n = given[0].n, first = given[1].is ? 1 : 2;
  const double *t = given[0].x;
  (void)part, (void)store;
  *table = (rot_free_table_of){.n = n, .columns = first == 1 ? 1 : 3, .time_s = t};
  if (n < 2) return rot_refuse(no, 0, "must have two times at least");
  for (size_t i = 1; i < n; i++) {
    if (t[i] < t[i - 1]) return rot_refuse(no, 0, "must not go back");
  }
  if (!(t[n - 1] > t[0])) return rot_refuse(no, 0, "must span some time");
  for (size_t k = 0; k < table->columns; k++) {
    const rot_given *torque = &given[first + k];
    if (torque->n != n) return rot_refuse(no, first + k, "must have a torque for each time");
    table->torque[k] = torque->x;
  }
  return ROT_OK;
}

/* ---- rotors ---------------------------------------------------------------------------------- */

enum { AXIS, INERTIA, OMEGA, TORQUE, BREAKS };
static const rot_input rotor_inputs[] = {
    [AXIS] = {"axis", "1", ROT_INPUT_VECTOR, 1, ROT_NO_DOMAIN, NAN,
              "in the body's own axes, of any length", NULL},
    [INERTIA] =
        ROT_NUMBER_INPUT("moment_of_inertia_kg_m2", "kg*m^2", 1, 0.0, 1, NAN, "about its axis"),
    [OMEGA] = ROT_NUMBER_INPUT("omega_rad_per_s", "rad/s", 1, -DBL_MAX, 0, NAN,
                               "at the start, relative to the body"),
    [TORQUE] = {"torque", "N*m", ROT_INPUT_NUMBER | ROT_INPUT_TABLE | ROT_INPUT_LAW, 0,
                ROT_NO_DOMAIN, NAN, "of its motor, as that of a body; default: it keeps its speed",
                rot_free_arguments},
    [BREAKS] = {"breaks_s", "s", ROT_INPUT_TIMES, 0, ROT_NO_DOMAIN, NAN,
                "where the torque may jump or kink", NULL}};

/* inputs => rot_free_rotor_of, or a refusal. */
static rot_status build_rotor(const rot_part *part, const rot_given given[], rot_store *store,
                              void *to, rot_refusal *no) {
  rot_free_rotor_of *of = to;
  rot_free_rotor *rotor = &of->rotor;
  (void)store;
  memset(of, 0, sizeof *of);
  if (!rot_input_axis(given[AXIS].x, rotor->axis)) return rot_refuse(no, AXIS, "must not be 0");
  rotor->moment_kg_m2 = rot_input_number(part->inputs, given, INERTIA);
  rotor->omega_rad_per_s = rot_input_number(part->inputs, given, OMEGA);
  rotor->driven = !given[TORQUE].is;
  if (given[TORQUE].is == ROT_INPUT_NUMBER) rotor->torque = given[TORQUE].x[0];
  if (given[TORQUE].is == ROT_INPUT_LAW) of->law = given[TORQUE].law;
  if (given[TORQUE].is == ROT_INPUT_TABLE) {
    const rot_free_table_of *table = given[TORQUE].object;
    if (table->columns != 1) return rot_refuse(no, TORQUE, "must have the column `torque_n_m`");
    rotor->n_knots = table->n;
    rotor->knot_s = table->time_s;
    rotor->knot_torque = table->torque[0];
  }
  of->n_breaks = given[BREAKS].n;
  of->breaks_s = given[BREAKS].x;
  return ROT_OK;
}

/* ---- principal moments ----------------------------------------------------------------------- */

static const rot_input moments_inputs[] = {
    {"moment_of_inertia_kg_m2", "kg*m^2", ROT_INPUT_VECTOR, 1, ROT_NO_DOMAIN, NAN,
     "the three principal moments", NULL},
    {"axes", "1", ROT_INPUT_ATTITUDE, 1, ROT_NO_DOMAIN, NAN,
     "of these moments, to the body's own axes, scalar first", NULL}};

static rot_status build_moments(const rot_part *part, const rot_given given[], rot_store *store,
                                void *to, rot_refusal *no) {
  rot_free_moments_of *of = to;
  (void)part, (void)store, (void)no;
  memcpy(of->moment_kg_m2, given[0].x, sizeof of->moment_kg_m2);
  rot_free_read_attitude(given[1].x, of->axes);
  return ROT_OK;
}

/* A table has no constructor in R: its name is that of its input. */
#define COUNT(list) (sizeof(list) / sizeof *(list))
const rot_part rot_free_parts[] = {{"rotor", ROT_INPUT_ROTOR, COUNT(rotor_inputs), rotor_inputs,
                                    sizeof(rot_free_rotor_of), build_rotor},
                                   {"torque", ROT_INPUT_TABLE, COUNT(table_inputs), table_inputs,
                                    sizeof(rot_free_table_of), build_table},
                                   {"principal_moments", ROT_INPUT_MOMENTS, COUNT(moments_inputs),
                                    moments_inputs, sizeof(rot_free_moments_of), build_moments}};
const size_t rot_free_n_parts = COUNT(rot_free_parts);
