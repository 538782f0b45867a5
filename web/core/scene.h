/* Scenes from their text, and as the R code that makes them. */
#ifndef LAB_SCENE_H
#define LAB_SCENE_H

#include "json.h"
#include "rotdyn.h"

typedef struct lab_refusal {
  int status;       /* ROTDYN_OK: none */
  char input[64];   /* the input that was refused; empty: none */
  char reason[512]; /* in a sentence */
} lab_refusal;

/* A scene as write_scene() of R writes it => the object; NULL: refused. */
rotdyn_object *lab_scene_read(const lab_node *tree, lab_refusal *refusal);
/* The member that is the scene: its key is the constructor. NULL: there is none, or several. */
const lab_node *lab_scene_of(const lab_node *tree);
/* => R code that makes the scene from constructors; 0: it needs read_scene(). */
int lab_scene_code(const lab_node *tree, lab_text *to);

#endif
