/* XXH128 of every branch of lengths, against xxHash (in rlang 1.0.6): bytes (131 i + 29 [i / 7] +
 * 11) modulo 256. The first is what xxhsum -H2 prints for an empty file. */
#include "ground/hash.h"

#include <string.h>

#include "rot_test.h"

static void published(void) {
  static const struct {
    size_t n;
    const char *hash;
  } cases[] = {
      {0, "99aa06d3014798d86001c324468d497f"},    {1, "885f487031a569684a4139caf4136257"},
      {2, "a491ec4799af18f917ac6bb7f76e4d01"},    {3, "22e8598bd34d7d6ea6433b6492647aaf"},
      {4, "2fcdf5bf971d9168ba0e46f51b4ce011"},    {7, "2067aaa4402cd05708d9b09ffce7141f"},
      {8, "98954afbc1d4bfebe9457f286b4a787a"},    {9, "f4ada6004f4e9a4a7cc9e32a8451f54b"},
      {15, "d3b3a3ef5d002d360af949fd356fee8d"},   {16, "6ad034ec042207276725f056b5a682ac"},
      {17, "e066b0861757a335ec9e3c61d371c799"},   {32, "00f1733cfe450f29c5c9262828234274"},
      {33, "9f506c5b7f4927b4895d3a5fa5d404d3"},   {128, "5d1e347c51c09737a310ce86f057de5d"},
      {129, "e80bd9dfe8761889d03140fdcd5a9180"},  {159, "fa954296aaa52194f1f97de259bd6cb8"},
      {160, "547e95630d9f0d955af63992c8eb3c67"},  {161, "ba745a5b6d6c203834122351029edd29"},
      {239, "932d0c544a2d843cab330bf65ee4ed8c"},  {240, "53e3245120628efbe9971dce5605a40e"},
      {241, "ebe6219ddb40272405394a64ba263b28"},  {1023, "96d3d430e6b3f8da33dc3a248c412ee6"},
      {1024, "4388d45bf721cf50c10828bcb9837f46"}, {1025, "bea9f9413db277c8c9175dd30e583315"},
      {1088, "887ac6337d3e4b796e3e420ef2bbabc1"}, {2048, "d29074292dfd3eb0c2d83819b95295d6"},
      {2049, "3a92991dbe7abd638fd9c4b6341d2258"}, {9999, "6458eb3bd9f7ebd35b5631a5012aa883"}};
  unsigned char bytes[10000];
  for (size_t i = 0; i < sizeof bytes; i++) {
    bytes[i] = (unsigned char)(131 * i + 29 * (i / 7) + 11);
  }
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
    char hash[ROT_HASH_SIZE];
    rot_hash(bytes, cases[i].n, hash);
    ROT_CHECK(strcmp(hash, cases[i].hash) == 0);
  }
}

int main(void) {
  published();
  return rot_test_report("hash");
}
