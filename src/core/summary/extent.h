/* Which rows a summary covers, and the tree in which summaries of neighbouring rows are joined.
 *
 * A block is block_rows rows, a power of two from 2^8 to 2^16 that the caller chooses for a sweep:
 * fewer rows where a row is expensive. Block b holds rows block_rows b to block_rows (b + 1) - 1.
 * The blocks of a sweep are the leaves of a binary tree: the children of a node of 2^(k + 1) blocks
 * are two nodes of 2^k blocks, the first of which begins at a multiple of 2^(k + 1) blocks. At the
 * end of the sweep, where the right child has no rows, the left child takes the place of the node.
 * So the tree depends on the numbers of rows and block_rows alone, and sums that are added along it
 * do not depend on threads, order of arrival or chunks: a chunk of 2^k blocks is a node. */
#ifndef ROT_EXTENT_H
#define ROT_EXTENT_H

#include <stdint.h>

#include "ground/ieee.h"

enum { ROT_BLOCK_ROWS_MIN = 256, ROT_BLOCK_ROWS_MAX = 65536 };

#define ROT_SWEEP_ROWS ((uint64_t)1 << 52) /* max rows of a sweep: exact as doubles */

/* Rows first_row .. first_row + rows - 1 of a sweep; none for rows = 0. */
typedef struct rot_extent {
  uint64_t first_row, rows;
  uint64_t block_rows; /* of the sweep */
} rot_extent;

/* 1 for a number of rows that a block can have */
static inline int rot_extent_is_size(uint64_t block_rows) {
  return block_rows >= ROT_BLOCK_ROWS_MIN && block_rows <= ROT_BLOCK_ROWS_MAX &&
         (block_rows & (block_rows - 1)) == 0;
}

/* => number of blocks, the last of which may be incomplete */
static inline uint64_t rot_extent_blocks(rot_extent span) {
  return (span.rows + span.block_rows - 1) / span.block_rows;
}

/* => rows of the smallest subtree for that many rows: a power of two of blocks */
static inline uint64_t rot_extent_size(rot_extent span) {
  uint64_t size = span.block_rows;
  while (size < span.rows) size *= 2;
  return size;
}

/* 1 for rows that a node can cover: some, up to 2^52, from the first row of a subtree on. */
static inline int rot_extent_is_node(rot_extent span) {
  return rot_extent_is_size(span.block_rows) && span.rows > 0 && span.rows <= ROT_SWEEP_ROWS &&
         span.first_row <= ROT_SWEEP_ROWS - span.rows &&
         span.first_row % rot_extent_size(span) == 0;
}

/* 1 if the nodes are the left and the right child of a node, with blocks of one size. The left one
 * is complete, the right one is so except at the end of the sweep. */
static inline int rot_extent_are_children(rot_extent left, rot_extent right) {
  return rot_extent_is_node(left) && rot_extent_is_node(right) &&
         left.block_rows == right.block_rows && left.rows == rot_extent_size(left) &&
         left.first_row % (2 * left.rows) == 0 && right.first_row == left.first_row + left.rows &&
         right.rows <= left.rows;
}

/* 1 for one block: n rows, up to block_rows, from the first row of a block on. */
static inline int rot_extent_is_block(rot_extent span) {
  return rot_extent_is_node(span) && span.rows <= span.block_rows;
}

#endif
