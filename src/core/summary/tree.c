#include "summary/tree.h"

#include <stdlib.h>
#include <string.h>

struct rot_tree {
  const rot_tree_node *type;
  size_t n, room;
  void **node; /* by their rows */
};

rot_tree *rot_tree_new(const rot_tree_node *type) {
  rot_tree *tree = calloc(1, sizeof *tree);
  if (tree) tree->type = type;
  return tree;
}

void rot_tree_free(rot_tree *tree) {
  if (!tree) return;
  for (size_t i = 0; i < tree->n; i++) tree->type->free(tree->node[i]);
  free(tree->node);
  free(tree);
}

static rot_extent span_at(const rot_tree *tree, size_t i) {
  return tree->type->span(tree->node[i]);
}

/* Joins nodes i and i + 1. */
static rot_status join(rot_tree *tree, size_t i) {
  const rot_status status = tree->type->merge(tree->node[i], tree->node[i + 1]);
  if (status != ROT_OK) return status;
  tree->type->free(tree->node[i + 1]);
  tree->n--;
  memmove(tree->node + i + 1, tree->node + i + 2, (tree->n - i - 1) * sizeof *tree->node);
  return ROT_OK;
}

/* Complete children. An incomplete right child waits for the end: rows after it may still come. */
static int complete(const rot_tree *tree, size_t i) {
  if (i + 1 >= tree->n) return 0;
  const rot_extent left = span_at(tree, i), right = span_at(tree, i + 1);
  return left.rows == right.rows && rot_extent_are_children(left, right);
}

/* Joins complete children from node i - 1 on, which may give others. */
static rot_status join_complete(rot_tree *tree, size_t i) {
  i -= i > 0;
  while (i + 1 < tree->n) {
    if (!complete(tree, i)) {
      i++;
      continue;
    }
    const rot_status status = join(tree, i);
    if (status != ROT_OK) return status;
    i -= i > 0;
  }
  return ROT_OK;
}

rot_status rot_tree_add(rot_tree *tree, void *node) {
  const rot_extent span = tree->type->span(node);
  if (!rot_extent_is_node(span)) return ROT_EVALUE;
  if (tree->n > 0 && span_at(tree, 0).block_rows != span.block_rows) return ROT_EVALUE;
  size_t at = tree->n;
  while (at > 0 && span_at(tree, at - 1).first_row >= span.first_row) at--;
  if (at < tree->n && span_at(tree, at).first_row < span.first_row + span.rows) return ROT_EVALUE;
  if (at > 0) {
    const rot_extent left = span_at(tree, at - 1);
    if (left.first_row + left.rows > span.first_row) return ROT_EVALUE;
  }
  if (tree->n == tree->room) {
    const size_t room = 2 * tree->room + 8;
    void **more = realloc(tree->node, room * sizeof *more);
    if (!more) return ROT_ENOMEM;
    tree->node = more;
    tree->room = room;
  }
  memmove(tree->node + at + 1, tree->node + at, (tree->n - at) * sizeof *tree->node);
  tree->node[at] = node;
  tree->n++;
  /* What finds no memory now is joined later, with the same result. */
  (void)join_complete(tree, at);
  return ROT_OK;
}

/* From the end: there the last node is the right child of the one before it. */
rot_status rot_tree_finish(rot_tree *tree, void **node) {
  *node = NULL;
  if (tree->n == 0) return ROT_EVALUE;
  const rot_status pending = join_complete(tree, 0);
  if (pending != ROT_OK) return pending;
  rot_extent last = span_at(tree, tree->n - 1);
  for (size_t i = tree->n - 1; i-- > 0;) {
    const rot_extent left = span_at(tree, i);
    if (!rot_extent_are_children(left, last)) return ROT_EVALUE;
    last = (rot_extent){left.first_row, left.rows + last.rows, left.block_rows};
  }
  while (tree->n > 1) {
    const rot_status status = join(tree, tree->n - 2);
    if (status != ROT_OK) return status;
  }
  const rot_status status = tree->type->finish ? tree->type->finish(tree->node[0]) : ROT_OK;
  if (status != ROT_OK) return status;
  *node = tree->node[0];
  tree->n = 0;
  return ROT_OK;
}
