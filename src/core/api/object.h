/* Objects of the C interface, and scenes built of them for one call. */
#ifndef ROT_API_OBJECT_H
#define ROT_API_OBJECT_H

#include "api/interface.h"
#include "object/object.h"

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
