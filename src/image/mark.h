/* SPDX-License-Identifier: MIT */
/* The mark by which a finished picture is known: a fingerprint of all that decides its pixels, and
   a hash of the file's bytes before it. It is the last chunk but one of a PNG, of the type tEXt. */
#ifndef HD_IMAGE_MARK_H
#define HD_IMAGE_MARK_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* The mark's chunk, and IEND behind it, which is always the same. */
enum { HD_PICTURE_END_SIZE = 12 + 7 + 45 + 12 };

/* Of frame `number` of a run whose fingerprint is `run`. */
uint64_t hd_picture_fingerprint(uint64_t run, int number);

/* The end of a PNG with that fingerprint; `bytes_hash` is that of all bytes before (hash.h). */
void hd_picture_end(uint64_t fingerprint, uint64_t bytes_hash,
                    unsigned char end[HD_PICTURE_END_SIZE]);

/* Whether these bytes are those of a PNG that ends so: not one has changed since it was written. */
bool hd_picture_is_whole(const unsigned char *bytes, size_t size, uint64_t fingerprint);

#endif
