#include "rot_incline_models.h"

#include "rot_incline.h"

enum { GRAVITY = 1, FRICTION = 2, RESISTANCE = 4 };

static const rot_effect effects[] = {{"gravity", "gravity", 0, 0},
                                     {"friction", "friction of the contact", 0, 0},
                                     {"resistance", "rolling resistance", 0, 0}};

static unsigned effects_of(const void *scene) {
  const rot_incline_params *p = scene;
  return (p->gravity_m_per_s2 != 0.0 ? GRAVITY : 0u) | (p->mu_static != 0.0 ? FRICTION : 0u) |
         (p->arm_m != 0.0 ? RESISTANCE : 0u);
}

static const char *not_exact(const void *scene, const rot_query *query) {
  const int before = query->n && query->time_s[0] < ((const rot_incline_params *)scene)->start_s;
  return before ? "it cannot run backwards from the scene's start" : NULL;
}

/* seconds: of a run, of a row. */
static double cost_s(const rot_model *model, const void *scene, const rot_query *query) {
  (void)scene;
  return model->seconds[0] + (double)query->n * model->seconds[1];
}

static const rot_model models[] = {
    {"incline_exact",
     GRAVITY | FRICTION | RESISTANCE,
     ROT_BOUND,
     8e-15,
     0,
     "all forces are constant between events: closed form",
     not_exact,
     cost_s,
     {0.6e-6, 60e-9, 0.0, 0.0}},
};

const rot_constraint rot_incline_constraint = {"incline",
                                               rot_incline_measures,
                                               sizeof effects / sizeof *effects,
                                               sizeof models / sizeof *models,
                                               effects,
                                               models,
                                               effects_of,
                                               NULL};
