// SPDX-License-Identifier: MIT

#include "world/bytes/content_hash.h"

#include <stdio.h>

#define XXH_INLINE_ALL // the header alone: nothing to link, for whatever machine this is compiled
#include <xxhash.h>

tl_content_hash tl_content_hash_of(const void *bytes, size_t size)
{
    const XXH128_hash_t hash = XXH3_128bits(bytes, size);
    const tl_content_hash result = { hash.low64, hash.high64 };
    return result;
}

uint64_t tl_content_checksum(const void *bytes, size_t size)
{
    return XXH3_64bits(bytes, size);
}

void tl_content_hash_text(tl_content_hash hash, char text_out[TL_CONTENT_TEXT_BYTES])
{
    snprintf(text_out, TL_CONTENT_TEXT_BYTES, "%016llx%016llx", (unsigned long long)hash.high,
             (unsigned long long)hash.low);
}
