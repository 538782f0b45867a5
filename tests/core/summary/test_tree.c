/* The tree of a sweep: the same nodes are joined for any chunks and any order of arrival; rows that
 * are no subtree are refused. The nodes here write down how they were joined. */
#include "rot_test.h"
#include "summary/tree.h"
#include "summary_kit.h"

typedef struct note {
  rot_extent span;
  char *text;
} note;

static int memory_left = -1; /* merges that succeed; -1: all */

static rot_extent span_of(const void *node) { return ((const note *)node)->span; }

static void free_note(void *node) {
  free(((note *)node)->text);
  free(node);
}

static rot_status merge(void *into, void *from) {
  note *a = into;
  const note *b = from;
  if (!rot_extent_are_children(a->span, b->span)) return ROT_EVALUE;
  if (memory_left == 0) return ROT_ENOMEM;
  if (memory_left > 0) memory_left--;
  char *text = malloc(strlen(a->text) + strlen(b->text) + 4);
  sprintf(text, "(%s+%s)", a->text, b->text);
  free(a->text);
  a->text = text;
  a->span.rows += b->span.rows;
  return ROT_OK;
}

static int finished = 0, finish_fails = 0;

static rot_status finish(void *node) {
  (void)node;
  if (finish_fails > 0) {
    finish_fails--;
    return ROT_ENOMEM;
  }
  finished++;
  return ROT_OK;
}

static const rot_tree_node type = {span_of, merge, finish, free_note};

static uint64_t block_rows; /* of all tests: main() runs them for each size */

static note *leaf(uint64_t block, uint64_t rows) {
  note *node = malloc(sizeof *node);
  node->span = (rot_extent){block * block_rows, rows, block_rows};
  node->text = malloc(24);
  sprintf(node->text, "%d", (int)block);
  return node;
}

static uint64_t rows_of(uint64_t block, uint64_t n) {
  const uint64_t left = n - block * block_rows;
  return left < block_rows ? left : block_rows;
}

/* n rows in chunks of `size` blocks, blocks and chunks in random order if `state` is given. */
static note *whole(uint64_t n, uint64_t size, uint64_t *state) {
  const uint64_t blocks = (n + block_rows - 1) / block_rows;
  const uint64_t chunks = (blocks + size - 1) / size;
  rot_tree *tree = rot_tree_new(&type), *part = rot_tree_new(&type);
  void *node = NULL;
  const uint64_t turn = state ? 2 * (kit_bits(state) % 1000) + 1 : 1;
  uint64_t most = 1;
  while (most < chunks) most *= 2;
  /* i -> turn i modulo a power of two: a permutation */
  for (uint64_t i = 0; i < most; i++) {
    const uint64_t chunk = turn * i % most;
    if (chunk >= chunks) continue;
    for (uint64_t k = 0; k < size; k++) {
      const uint64_t block = chunk * size + (state ? turn * k % size : k);
      if (block >= blocks) continue;
      ROT_CHECK_EQ_INT(rot_tree_add(part, leaf(block, rows_of(block, n))), ROT_OK);
    }
    ROT_CHECK_EQ_INT(rot_tree_finish(part, &node), ROT_OK);
    ROT_CHECK_EQ_INT(rot_tree_add(tree, node), ROT_OK);
  }
  ROT_CHECK_EQ_INT(rot_tree_finish(tree, &node), ROT_OK);
  rot_tree_free(tree);
  rot_tree_free(part);
  return node;
}

static void known_trees(void) {
  static const struct {
    uint64_t blocks;
    int more; /* rows */
    const char *text;
  } row[] = {{0, 1, "0"},
             {1, 0, "0"},
             {1, 1, "(0+1)"},
             {3, 0, "((0+1)+2)"},
             {4, -7, "((0+1)+(2+3))"},
             {5, 0, "(((0+1)+(2+3))+4)"},
             {6, 0, "(((0+1)+(2+3))+(4+5))"},
             {7, -1, "(((0+1)+(2+3))+((4+5)+6))"}};
  uint64_t state = 5;
  for (size_t i = 0; i < sizeof row / sizeof row[0]; i++) {
    const uint64_t rows = row[i].blocks * block_rows + (uint64_t)row[i].more;
    for (uint64_t size = 1; size <= 8; size *= 2) {
      for (int random = 0; random < 3; random++) {
        note *node = whole(rows, size, random ? &state : NULL);
        ROT_CHECK(strcmp(node->text, row[i].text) == 0);
        ROT_CHECK_EQ_INT(node->span.first_row, 0);
        ROT_CHECK_EQ_INT(node->span.rows, rows);
        free_note(node);
      }
    }
  }
}

/* All numbers of blocks up to 70, all chunks up to 32 blocks, against blocks in order. */
static void any_chunks(void) {
  uint64_t state = 1;
  for (uint64_t blocks = 1; blocks <= 70; blocks++) {
    const uint64_t n = blocks * block_rows - kit_bits(&state) % 2 * (kit_bits(&state) % block_rows);
    note *want = whole(n, 1, NULL);
    for (uint64_t size = 1; size <= 32; size *= 2) {
      note *got = whole(n, size, &state);
      ROT_CHECK(strcmp(got->text, want->text) == 0);
      free_note(got);
    }
    free_note(want);
  }
}

/* A chunk away from the first row, alone. */
static void chunk_alone(void) {
  rot_tree *tree = rot_tree_new(&type);
  void *node = NULL;
  for (uint64_t b = 8; b < 15; b++) rot_tree_add(tree, leaf(b, b == 14 ? 5 : block_rows));
  ROT_CHECK_EQ_INT(rot_tree_finish(tree, &node), ROT_OK);
  ROT_CHECK(strcmp(((note *)node)->text, "(((8+9)+(10+11))+((12+13)+14))") == 0);
  free_note(node);
  rot_tree_free(tree);
}

static void refuse(rot_tree *tree, note *node) {
  ROT_CHECK_EQ_INT(rot_tree_add(tree, node), ROT_EVALUE);
  free_note(node);
}

static void wrong_rows(void) {
  rot_tree *tree = rot_tree_new(&type);
  void *node = NULL;
  ROT_CHECK_EQ_INT(rot_tree_finish(tree, &node), ROT_EVALUE);
  ROT_CHECK(node == NULL);
  refuse(tree, leaf(0, 0));
  refuse(tree, leaf(1, block_rows + 1));     /* two blocks from an odd one on */
  refuse(tree, leaf(2, 2 * block_rows + 1)); /* three from a multiple of two */
  refuse(tree, leaf(0, ROT_SWEEP_ROWS + 1));
  refuse(tree, leaf(ROT_SWEEP_ROWS / block_rows, 1)); /* first row 2^52 */
  for (int i = 0; i < KIT_NO_SIZES; i++) {
    note *odd = leaf(0, 1);
    odd->span.block_rows = kit_no_block_rows[i];
    refuse(tree, odd);
  }
  note *middle = leaf(0, 1);
  middle->span.first_row = 1;
  refuse(tree, middle);
  ROT_CHECK_EQ_INT(rot_tree_add(tree, leaf(2, block_rows)), ROT_OK);
  refuse(tree, leaf(2, block_rows)); /* twice */
  refuse(tree, leaf(2, 1));
  for (int i = 0; i < KIT_SIZES; i++) { /* blocks of another size */
    if (kit_block_rows[i] == block_rows) continue;
    note *other = leaf(0, 1);
    other->span.block_rows = kit_block_rows[i];
    refuse(tree, other);
  }
  refuse(tree, leaf(0, 4 * block_rows)); /* its rows again in others */
  ROT_CHECK_EQ_INT(rot_tree_add(tree, leaf(0, block_rows)), ROT_OK);
  ROT_CHECK_EQ_INT(rot_tree_finish(tree, &node), ROT_EVALUE); /* block 1 is missing */
  ROT_CHECK_EQ_INT(rot_tree_add(tree, leaf(1, 7)), ROT_OK);
  ROT_CHECK_EQ_INT(rot_tree_finish(tree, &node), ROT_EVALUE); /* block 1 is incomplete */
  rot_tree_free(tree);
  /* no chunk: its first block is odd */
  tree = rot_tree_new(&type);
  rot_tree_add(tree, leaf(1, block_rows));
  rot_tree_add(tree, leaf(2, block_rows));
  ROT_CHECK_EQ_INT(rot_tree_finish(tree, &node), ROT_EVALUE);
  rot_tree_free(tree);
  rot_tree_free(NULL);
}

/* Merges that find no memory are made later, in the same order. */
static void no_memory(void) {
  for (int left = 0; left < 12; left++) {
    rot_tree *tree = rot_tree_new(&type);
    void *node = NULL;
    memory_left = left;
    for (uint64_t b = 0; b < 11; b++) {
      ROT_CHECK_EQ_INT(rot_tree_add(tree, leaf(b, block_rows)), ROT_OK);
    }
    const rot_status status = rot_tree_finish(tree, &node);
    ROT_CHECK_EQ_INT(status, left < 10 ? ROT_ENOMEM : ROT_OK);
    memory_left = -1;
    if (status != ROT_OK) ROT_CHECK_EQ_INT(rot_tree_finish(tree, &node), ROT_OK);
    ROT_CHECK(strcmp(((note *)node)->text, "((((0+1)+(2+3))+((4+5)+(6+7)))+((8+9)+10))") == 0);
    free_note(node);
    rot_tree_free(tree);
  }
}

/* The node is completed once, when all are joined; without memory, by another call. */
static void completed(void) {
  rot_tree *tree = rot_tree_new(&type);
  void *node = NULL;
  for (uint64_t b = 0; b < 3; b++) rot_tree_add(tree, leaf(b, block_rows));
  finished = 0;
  finish_fails = 1;
  ROT_CHECK_EQ_INT(rot_tree_finish(tree, &node), ROT_ENOMEM);
  ROT_CHECK(node == NULL && finished == 0);
  ROT_CHECK_EQ_INT(rot_tree_finish(tree, &node), ROT_OK);
  ROT_CHECK_EQ_INT(finished, 1);
  free_note(node);
  rot_tree_free(tree);
}

/* An empty tree takes blocks of any size. */
static void another_size(void) {
  const uint64_t old = block_rows;
  rot_tree *tree = rot_tree_new(&type);
  void *node = NULL;
  for (int i = 0; i < KIT_SIZES; i++) {
    block_rows = kit_block_rows[i];
    ROT_CHECK_EQ_INT(rot_tree_add(tree, leaf(0, block_rows)), ROT_OK);
    ROT_CHECK_EQ_INT(rot_tree_add(tree, leaf(1, 1)), ROT_OK);
    ROT_CHECK_EQ_INT(rot_tree_finish(tree, &node), ROT_OK);
    ROT_CHECK_EQ_INT(((note *)node)->span.block_rows, block_rows);
    free_note(node);
  }
  rot_tree_free(tree);
  block_rows = old;
}

static void spans(void) {
  const uint64_t b = block_rows;
  ROT_CHECK_EQ_INT(rot_extent_blocks((rot_extent){0, 1, b}), 1);
  ROT_CHECK_EQ_INT(rot_extent_blocks((rot_extent){0, b, b}), 1);
  ROT_CHECK_EQ_INT(rot_extent_blocks((rot_extent){0, b + 1, b}), 2);
  ROT_CHECK_EQ_INT(rot_extent_size((rot_extent){0, 3 * b, b}), 4 * b);
  ROT_CHECK(rot_extent_are_children((rot_extent){4 * b, 2 * b, b}, (rot_extent){6 * b, 2 * b, b}));
  ROT_CHECK(rot_extent_are_children((rot_extent){4 * b, 2 * b, b}, (rot_extent){6 * b, 1, b}));
  ROT_CHECK(!rot_extent_are_children((rot_extent){2 * b, 2 * b, b}, (rot_extent){4 * b, 2 * b, b}));
  ROT_CHECK(!rot_extent_are_children((rot_extent){4 * b, 2 * b, b}, (rot_extent){6 * b, 3 * b, b}));
  ROT_CHECK(!rot_extent_are_children((rot_extent){4 * b, 2 * b - 1, b}, (rot_extent){6 * b, b, b}));
  ROT_CHECK(!rot_extent_are_children((rot_extent){4 * b, 2 * b, b}, (rot_extent){7 * b, b, b}));
  ROT_CHECK(!rot_extent_are_children((rot_extent){4 * b, 2 * b, b}, (rot_extent){6 * b, 0, b}));
  for (int i = 0; i < KIT_SIZES; i++) {
    const uint64_t other = kit_block_rows[i];
    ROT_CHECK(rot_extent_are_children((rot_extent){0, 1 << 16, b},
                                      (rot_extent){1 << 16, 1 << 16, other}) == (other == b));
  }
  for (int i = 0; i < KIT_NO_SIZES; i++) {
    ROT_CHECK(!rot_extent_is_size(kit_no_block_rows[i]));
    ROT_CHECK(!rot_extent_is_block((rot_extent){0, 1, kit_no_block_rows[i]}));
  }
  for (uint64_t size = 256; size <= 65536; size *= 2) ROT_CHECK(rot_extent_is_size(size));
  ROT_CHECK(rot_extent_is_node((rot_extent){0, ROT_SWEEP_ROWS, b}));
  ROT_CHECK(rot_extent_is_block((rot_extent){7 * b, b, b}));
  ROT_CHECK(!rot_extent_is_block((rot_extent){8 * b, b + 1, b}));
}

int main(void) {
  for (int i = 0; i < KIT_SIZES; i++) {
    block_rows = kit_block_rows[i];
    spans();
    known_trees();
    any_chunks();
    chunk_alone();
    wrong_rows();
    no_memory();
    completed();
    another_size();
  }
  return rot_test_report("tree");
}
