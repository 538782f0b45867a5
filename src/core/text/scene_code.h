/* The text of a scene, as write_scene() of R writes it: its parts, and the R code that makes it. */
#ifndef ROT_SCENE_CODE_H
#define ROT_SCENE_CODE_H

#include "text/json.h"
#include "text/writer.h"

/* The member that is the scene: its key is the constructor. NULL: there is none, or several. */
const rot_json *rot_scene_member(const rot_json *tree);
/* (value of an input) => constructor of the object, its arguments: {"body_disk": {...}} names it;
 * else the input does: "resistance": {...}. */
const char *rot_scene_part(const rot_json *node, const char *input, const rot_json **arguments);
/* => 1, R code that makes the scene from constructors; 0: it needs read_scene(). */
int rot_scene_code(const rot_json *tree, rot_writer *to);

#endif
