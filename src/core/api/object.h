/* Objects of the C interface (scenes, their parts, lists): values set by the caller, and their
 * translation for the builders of the core. */
#ifndef ROT_API_OBJECT_H
#define ROT_API_OBJECT_H

#include "api/interface.h"
#include "engine/model.h"
#include "ground/store.h"

/* scene => its constraint; NULL for a part or a list */
const rot_constraint *rot_api_constraint(const rotdyn_object *scene);

/* object => inputs of a scene or a part, checked, with its parts built. In the store; valid as long
 * as the object. ROT_EVALUE: refused. */
rot_status rot_api_given(const rotdyn_object *object, rot_store *store, rot_given **given,
                         rot_refusal *refusal);

/* 1 if the object contains a law of the caller. */
int rot_api_calls(const rotdyn_object *object);

/* A scene built for one call, since threads may share objects. Begin with {0}. */
typedef struct rot_api_built {
  const rot_constraint *constraint;
  const rot_maker *maker;
  rot_given *given;
  void *scene;
  rot_store store;
} rot_api_built;

/* object => built scene; input name and reason of a refusal in the report. rot_api_release() in
 * each case. */
rotdyn_status rot_api_build(const rotdyn_object *scene, rot_api_built *built,
                            rotdyn_report *report);
/* Frees the built scene. */
void rot_api_release(rot_api_built *built);

#endif
