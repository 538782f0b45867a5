/* Objects of the C interface - scenes, their parts, lists - as they are set, and what the builders
 * of the core read of them. */
#ifndef ROT_API_OBJECT_H
#define ROT_API_OBJECT_H

#include "api/interface.h"
#include "engine/model.h"
#include "ground/store.h"

/* NULL: a part, or a list. */
const rot_constraint *rot_api_constraint(const rotdyn_object *scene);

/* The inputs of a scene or a part, checked, with its parts built: in the store, and valid as long
 * as the object. ROT_EVALUE: refused. */
rot_status rot_api_given(const rotdyn_object *object, rot_store *store, rot_given **given,
                         rot_refusal *refusal);

/* Whether a law of the caller is in it. */
int rot_api_calls(const rotdyn_object *object);

/* A scene as built, for one call: scenes are shared by threads. Begin with {0}. */
typedef struct rot_api_built {
  const rot_constraint *constraint;
  const rot_maker *maker;
  rot_given *given;
  void *scene;
  rot_store store;
} rot_api_built;

/* A name and the reason go to the report. rot_api_release() afterwards, in any case. */
rotdyn_status rot_api_build(const rotdyn_object *scene, rot_api_built *built,
                            rotdyn_report *report);
void rot_api_release(rot_api_built *built);

#endif
