// SPDX-License-Identifier: MIT
//
// Names of content: 128 bits of XXH3 (Yann Collet, xxHash, from Debian). Two contents of one name would need about 2^64
// contents, unless somebody looks for them: the hash finds what changed, it keeps no secret.

#ifndef TALUS_WORLD_CONTENT_HASH_H
#define TALUS_WORLD_CONTENT_HASH_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct tl_content_hash {
    uint64_t low, high;
} tl_content_hash;

enum { TL_CONTENT_TEXT_BYTES = 33 };

tl_content_hash tl_content_hash_of(const void *bytes, size_t size);
/// 64 bits, as a checksum.
uint64_t tl_content_checksum(const void *bytes, size_t size);
/// 32 hexadecimal digits and a zero.
void tl_content_hash_text(tl_content_hash hash, char text_out[TL_CONTENT_TEXT_BYTES]);

/// The sum modulo 2^128. The sum of the hashes of the members of a set names the set whatever their order, and can be
/// put together from parts (Bellare, Micciancio, A New Paradigm for Collision-Free Hashing, EUROCRYPT 1997).
static inline tl_content_hash tl_content_hash_add(tl_content_hash a, tl_content_hash b)
{
    const uint64_t low = a.low + b.low;
    const tl_content_hash sum = { low, a.high + b.high + (low < a.low) };
    return sum;
}

static inline bool tl_content_hash_equal(tl_content_hash a, tl_content_hash b)
{
    return a.low == b.low && a.high == b.high;
}

#endif
