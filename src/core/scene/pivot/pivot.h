/* A body with a fixed point under gravity: a rot_free_params with a lever and moments about that
 * point. Closed form of the heavy symmetric top; other bodies are integrated (scene/free/ode.h). */
#ifndef ROT_PIVOT_H
#define ROT_PIVOT_H

#include "scene/free/free.h"

/* 1 if a torque other than that of gravity, or the damping acts, else 0. */
int rot_pivot_is_driven(const rot_free_params *p);

/* parameters => NULL, or why the body is no symmetric top: the lever is not along a principal axis,
 * the moments across it differ, or gravity is too small beside the rates. */
const char *rot_pivot_not_top(const rot_free_params *p);

/* parameters => axis of symmetry 0, 1 or 2 (the lever is along it); -1: no symmetric top. */
int rot_pivot_axis(const rot_free_params *p);
/* Quaternion for each axis of symmetry k from the top's axes 1, 2, 3 (= k + 1, k + 2, k modulo 3)
 * to the principal axes: v_principal = turn v_top turn*. */
extern const double rot_pivot_turns[3][4];

/* Sets lever_low_n_m: mass gravity centre minus lever_n_m, its rounding error; 0 if the lever is
 * not that product. Where the body axes are not the principal ones: own_lever_n_m. */
void rot_pivot_sharpen(rot_free_params *p, double mass_kg, double gravity_m_per_s2,
                       const double centre_m[3]);

/* (parameters, times) => rows as rot_free_exact(), events: turning points of the nutation, at most
 * 10000. */
rot_status rot_pivot_top(const rot_free_params *p, size_t n, const double time_s[],
                         const rot_free_columns *out, rot_events *events, const rot_hooks *hooks,
                         rot_info *info);

/* (parameters, attitude of the body axes) => weight times centre of mass in space axes; z:
 * potential energy. */
void rot_pivot_lever(const rot_free_params *p, const double q[4], double lever_n_m[3]);

/* parameters => nutation: {period in s, half the difference of the inclinations in rad, mean
 * precession in rad/s}. */
rot_status rot_pivot_nutation(const rot_free_params *p, double out[3]);

/* A pendulum about a fixed line through the pivot: I angle'' = -G sin(angle). */
typedef struct rot_pivot_pendulum {
  double moment_kg_m2; /* I, about the line */
  double weight_n_m;   /* G, m g times the distance; < 0: the angle is from the highest position */
  double angle_rad, omega_rad_per_s; /* at the start; angle of the centre of mass from the lowest
                                        position or the highest, the nearer one */
} rot_pivot_pendulum;

/* parameters => pendulum. Returns 0 if the centre of mass leaves a vertical plane, or more than
 * gravity acts, else 1. */
int rot_pivot_plane(const rot_free_params *p, rot_pivot_pendulum *out);

#endif
