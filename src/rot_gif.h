/* The pixels of a GIF image, compressed (LZW): GIF89a, appendix F. */
#ifndef ROT_GIF_H
#define ROT_GIF_H

#include <stddef.h>

/* Bytes that suffice for n pixels. */
size_t rot_gif_most(size_t n);

/* From the minimum code size to the block of no bytes that ends the data. Pixels are below
 * 2^bits, bits from 2 to 8. Returns the number of bytes. */
size_t rot_gif_pack(const unsigned char pixel[], size_t n, int bits, unsigned char out[]);

#endif
