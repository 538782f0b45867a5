/* Joins summaries of parts of a sweep along the tree of its blocks (summary/extent.h), in any
 * order of arrival. The nodes are of one type: rot_summary, rot_indices or rot_means.
 *
 *   rot_tree *tree = rot_tree_new(&rot_summary_node);
 *   for each part: rot_tree_add(tree, summary of the part);
 *   rot_tree_finish(tree, &whole);
 *   rot_tree_free(tree);
 *
 * A part is a block or what rot_tree_finish() returned for a chunk of 2^k blocks whose first block
 * is a multiple of 2^k; the last chunk may have fewer rows. Chunks of different sizes may be mixed.
 * Parts that arrive in order leave at most 53 nodes in memory. */
#ifndef ROT_TREE_H
#define ROT_TREE_H

#include "ground/status.h"
#include "summary/extent.h"

/* A type of nodes. */
typedef struct rot_tree_node {
  rot_extent (*span)(const void *node);
  /* Both are unchanged if it fails; else the tree frees `from`, whose memory may be taken. */
  rot_status (*merge)(void *into, void *from);
  rot_status (*finish)(void *node); /* completes what merge() left for later; NULL: nothing */
  void (*free)(void *node);
} rot_tree_node;

typedef struct rot_tree rot_tree;

/* NULL: no memory. */
rot_tree *rot_tree_new(const rot_tree_node *type);
/* Frees the tree with its nodes. */
void rot_tree_free(rot_tree *tree);

/* On ROT_OK the tree owns the node, else the caller still does. ROT_EVALUE: the rows are no
 * subtree, some of them were added before, or the nodes before have blocks of another size.
 * ROT_ENOMEM leaves the tree usable; the node is the caller's. */
rot_status rot_tree_add(rot_tree *tree, void *node);

/* => the node of all rows added, which the caller frees; the tree is empty then and may be used
 * again. ROT_EVALUE: no rows, rows missing between others, or rows that are no subtree of a sweep
 * that ends with them; the tree is unchanged. ROT_ENOMEM: may be called again. */
rot_status rot_tree_finish(rot_tree *tree, void **node);

#endif
