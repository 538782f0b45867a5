/* A body with a fixed point under gravity. Its scene is a rot_free_params with a lever, its moments
 * about that point. This is the heavy symmetric top in closed form; the rest is integrated
 * (scene/free/ode.h). */
#ifndef ROT_PIVOT_H
#define ROT_PIVOT_H

#include "scene/free/free.h"

/* NULL, or why it is no symmetric top: the lever is not along a principal axis, or the moments
 * across it differ. */
const char *rot_pivot_not_top(const rot_free_params *p);

/* The axis of symmetry, along which the lever lies; -1: no symmetric top. */
int rot_pivot_axis(const rot_free_params *p);
/* Of each such axis k, the turn of the top's axes 1, 2, 3, which are k + 1, k + 2, k (modulo 3), to
 * the principal ones: v_principal = turn v_top turn*. */
extern const double rot_pivot_turns[3][4];

/* What lever_n_m lacks of mass gravity centre, by rounding: where the axes are the principal ones,
 * and the lever is that product. */
void rot_pivot_sharpen(rot_free_params *p, double mass_kg, double gravity_m_per_s2,
                       const double centre_m[3]);

/* Rows as rot_free_exact() writes them. Events: the turning points of the nutation, up to 10000. */
rot_status rot_pivot_top(const rot_free_params *p, size_t n, const double time_s[],
                         const rot_free_columns *out, rot_events *events, const rot_hooks *hooks,
                         rot_info *info);

/* The lever of the weight, in axes of space, at an attitude of the body's own axes: z is the
 * potential energy. */
void rot_pivot_lever(const rot_free_params *p, const double q[4], double lever_n_m[3]);

/* Of its nutation: c(period s, lowest and highest cosine, precession in a period). */
rot_status rot_pivot_nutation(const rot_free_params *p, double out[4]);

#endif
