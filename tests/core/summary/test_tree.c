/* The tree of a sweep: the same nodes are joined for any chunks and any order of arrival; rows that
 * are no subtree are refused. The nodes here write down how they were joined. */
#include "rot_test.h"
#include "summary/tree.h"
#include "summary_kit.h"

typedef struct note {
  rot_stretch span;
  char *text;
} note;

static int memory_left = -1; /* merges that succeed; -1: all */

static rot_stretch span_of(const void *node) { return ((const note *)node)->span; }

static void free_note(void *node) {
  free(((note *)node)->text);
  free(node);
}

static rot_status merge(void *into, const void *from) {
  note *a = into;
  const note *b = from;
  if (!rot_stretch_are_children(a->span, b->span)) return ROT_EVALUE;
  if (memory_left == 0) return ROT_ENOMEM;
  if (memory_left > 0) memory_left--;
  char *text = malloc(strlen(a->text) + strlen(b->text) + 4);
  sprintf(text, "(%s+%s)", a->text, b->text);
  free(a->text);
  a->text = text;
  a->span.rows += b->span.rows;
  return ROT_OK;
}

static const rot_tree_node type = {span_of, merge, free_note};

static note *leaf(uint64_t block, uint64_t rows) {
  note *node = malloc(sizeof *node);
  node->span = (rot_stretch){block * ROT_BLOCK_ROWS, rows};
  node->text = malloc(24);
  sprintf(node->text, "%d", (int)block);
  return node;
}

static uint64_t rows_of(uint64_t block, uint64_t n) {
  const uint64_t left = n - block * ROT_BLOCK_ROWS;
  return left < ROT_BLOCK_ROWS ? left : ROT_BLOCK_ROWS;
}

/* n rows in chunks of `size` blocks, blocks and chunks in random order if `state` is given. */
static note *whole(uint64_t n, uint64_t size, uint64_t *state) {
  const uint64_t blocks = (n + ROT_BLOCK_ROWS - 1) / ROT_BLOCK_ROWS;
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
    uint64_t rows;
    const char *text;
  } row[] = {{1, "0"},
             {65536, "0"},
             {65537, "(0+1)"},
             {3 * 65536, "((0+1)+2)"},
             {4 * 65536 - 7, "((0+1)+(2+3))"},
             {5 * 65536, "(((0+1)+(2+3))+4)"},
             {6 * 65536, "(((0+1)+(2+3))+(4+5))"},
             {7 * 65536 - 1, "(((0+1)+(2+3))+((4+5)+6))"}};
  uint64_t state = 5;
  for (size_t i = 0; i < sizeof row / sizeof row[0]; i++) {
    for (uint64_t size = 1; size <= 8; size *= 2) {
      for (int random = 0; random < 3; random++) {
        note *node = whole(row[i].rows, size, random ? &state : NULL);
        ROT_CHECK(strcmp(node->text, row[i].text) == 0);
        ROT_CHECK_EQ_INT(node->span.first_row, 0);
        ROT_CHECK_EQ_INT(node->span.rows, row[i].rows);
        free_note(node);
      }
    }
  }
}

/* All numbers of blocks up to 70, all chunks up to 32 blocks, against blocks in order. */
static void any_chunks(void) {
  uint64_t state = 1;
  for (uint64_t blocks = 1; blocks <= 70; blocks++) {
    const uint64_t n = blocks * ROT_BLOCK_ROWS - kit_bits(&state) % 2 * (kit_bits(&state) % 65536);
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
  for (uint64_t b = 8; b < 15; b++) rot_tree_add(tree, leaf(b, b == 14 ? 5 : ROT_BLOCK_ROWS));
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
  refuse(tree, leaf(1, ROT_BLOCK_ROWS + 1));     /* two blocks from an odd one on */
  refuse(tree, leaf(2, 2 * ROT_BLOCK_ROWS + 1)); /* three from a multiple of two */
  refuse(tree, leaf(0, ROT_SWEEP_ROWS + 1));
  refuse(tree, leaf((uint64_t)1 << 36, 1)); /* first row 2^52 */
  note *middle = leaf(0, 1);
  middle->span.first_row = 1;
  refuse(tree, middle);
  ROT_CHECK_EQ_INT(rot_tree_add(tree, leaf(2, ROT_BLOCK_ROWS)), ROT_OK);
  refuse(tree, leaf(2, ROT_BLOCK_ROWS)); /* twice */
  refuse(tree, leaf(2, 1));
  refuse(tree, leaf(0, 4 * ROT_BLOCK_ROWS)); /* its rows again in others */
  ROT_CHECK_EQ_INT(rot_tree_add(tree, leaf(0, ROT_BLOCK_ROWS)), ROT_OK);
  ROT_CHECK_EQ_INT(rot_tree_finish(tree, &node), ROT_EVALUE); /* block 1 is missing */
  ROT_CHECK_EQ_INT(rot_tree_add(tree, leaf(1, 7)), ROT_OK);
  ROT_CHECK_EQ_INT(rot_tree_finish(tree, &node), ROT_EVALUE); /* block 1 is incomplete */
  rot_tree_free(tree);
  /* no chunk: its first block is odd */
  tree = rot_tree_new(&type);
  rot_tree_add(tree, leaf(1, ROT_BLOCK_ROWS));
  rot_tree_add(tree, leaf(2, ROT_BLOCK_ROWS));
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
      ROT_CHECK_EQ_INT(rot_tree_add(tree, leaf(b, ROT_BLOCK_ROWS)), ROT_OK);
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

static void spans(void) {
  const uint64_t b = ROT_BLOCK_ROWS;
  ROT_CHECK_EQ_INT(rot_stretch_blocks((rot_stretch){0, 1}), 1);
  ROT_CHECK_EQ_INT(rot_stretch_blocks((rot_stretch){0, b}), 1);
  ROT_CHECK_EQ_INT(rot_stretch_blocks((rot_stretch){0, b + 1}), 2);
  ROT_CHECK_EQ_INT(rot_stretch_size((rot_stretch){0, 3 * b}), 4 * b);
  ROT_CHECK(rot_stretch_are_children((rot_stretch){4 * b, 2 * b}, (rot_stretch){6 * b, 2 * b}));
  ROT_CHECK(rot_stretch_are_children((rot_stretch){4 * b, 2 * b}, (rot_stretch){6 * b, 1}));
  ROT_CHECK(!rot_stretch_are_children((rot_stretch){2 * b, 2 * b}, (rot_stretch){4 * b, 2 * b}));
  ROT_CHECK(!rot_stretch_are_children((rot_stretch){4 * b, 2 * b}, (rot_stretch){6 * b, 3 * b}));
  ROT_CHECK(!rot_stretch_are_children((rot_stretch){4 * b, 2 * b - 1}, (rot_stretch){6 * b, b}));
  ROT_CHECK(!rot_stretch_are_children((rot_stretch){4 * b, 2 * b}, (rot_stretch){7 * b, b}));
  ROT_CHECK(!rot_stretch_are_children((rot_stretch){4 * b, 2 * b}, (rot_stretch){6 * b, 0}));
  ROT_CHECK(rot_stretch_is_node((rot_stretch){0, ROT_SWEEP_ROWS}));
  ROT_CHECK(rot_stretch_is_block((rot_stretch){7 * b, b}));
  ROT_CHECK(!rot_stretch_is_block((rot_stretch){8 * b, b + 1}));
}

int main(void) {
  spans();
  known_trees();
  any_chunks();
  chunk_alone();
  wrong_rows();
  no_memory();
  return rot_test_report("tree");
}
