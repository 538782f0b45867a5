/* Scenes from their text. */
#ifndef LAB_SCENE_H
#define LAB_SCENE_H

#include "rotdyn.h"
#include "text/json.h"

typedef struct lab_refusal {
  int status;       /* ROTDYN_OK: none */
  char input[64];   /* the input that was refused; empty: none */
  char reason[512]; /* in a sentence */
} lab_refusal;

/* A scene as write_scene() of R writes it => the object; NULL: refused. */
rotdyn_object *lab_scene_read(const rot_json *tree, lab_refusal *refusal);

#endif
