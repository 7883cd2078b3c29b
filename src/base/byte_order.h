// SPDX-License-Identifier: MIT
//
// Blobs and files are little-endian. Machines of the other byte order (s390x, older MIPS and PowerPC) turn a blob's
// words round when it is written and before it is read; on all others a blob in memory and in a file are the same
// bytes, and nothing here is called.
//
// Each kind of blob says which words it is made of: a head, whose counts tell the arrays behind it. The code that turns
// words round runs on every machine, so that the tests of every machine reach it: turned round twice, a blob is as it
// was.

#ifndef TALUS_SRC_BASE_BYTE_ORDER_H
#define TALUS_SRC_BASE_BYTE_ORDER_H

#include <talus/base.h>

#if defined(__BYTE_ORDER__) && defined(__ORDER_BIG_ENDIAN__)
#define TL_BIG_ENDIAN (__BYTE_ORDER__ == __ORDER_BIG_ENDIAN__)
#else
#define TL_BIG_ENDIAN 0 // compilers that do not say are those of Windows
#endif

/// Bytes whose words are turned round in place.
typedef struct tl_byte_swap {
    uint8_t *bytes;
    uint64_t size;
    bool to_host; ///< the bytes have the other order, and get this machine's; false: the other way
    bool fits;    ///< false once words were asked for that the bytes do not have: the counts are wrong
} tl_byte_swap;

/// `count` words of `width` bytes, one behind the other. Width 1: bytes, which have no order.
typedef struct tl_word_run {
    uint32_t width;
    uint32_t count;
} tl_word_run;

/// Turns round `count` words of 2, 4 or 8 bytes (1: none) at `offset`. Any values are safe.
void tl_swap_words(tl_byte_swap *swap, uint64_t offset, uint64_t count, uint32_t width);

/// The same for `count` elements, each made of the runs.
void tl_swap_elements(tl_byte_swap *swap, uint64_t offset, uint64_t count, const tl_word_run *runs, uint32_t run_count);

/// Turns round the head at offset 0, `head_size` bytes in all, and copies it as this machine reads it to `head_out`,
/// which is zeroed when the bytes are too few.
void tl_swap_head(tl_byte_swap *swap, const tl_word_run *runs, uint32_t run_count, void *head_out, size_t head_size);

/// The kinds of blobs, each by the wing that lays it out. They stop at the first count that contradicts the size.
typedef void tl_blob_swap_fn(tl_byte_swap *swap);
tl_blob_swap_fn tl_soup_swap_words, tl_hull_swap_words, tl_nav_tile_swap_words, tl_nav_links_swap_words,
    tl_nav_pvs_swap_words;

#endif
