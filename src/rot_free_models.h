/* The effects and models of a free body. */
#ifndef ROT_FREE_MODELS_H
#define ROT_FREE_MODELS_H

#include "rot_model.h"

/* Its scene is a rot_free_params. */
extern const rot_constraint rot_free_constraint;

/* Predicted times of a run in closed form and of an integrated one: see rot_free_models.c for the
 * numbers that they take from the model. */
double rot_free_exact_s(const rot_model *model, const void *scene, const rot_query *query);
double rot_free_integrated_s(const rot_model *model, const void *scene, const rot_query *query);
/* And by steps of fixed length. */
double rot_free_steps_s(const rot_model *model, const void *scene, const rot_query *query);

/* Why the closed form, or the integrators, do not take it: NULL where they do. */
const char *rot_free_refuses_exact(const void *scene, const rot_query *query);
const char *rot_free_refuses_ode(const void *scene, const rot_query *query);

#endif
