// SPDX-License-Identifier: MIT
//
// The AREA chunk: the area that each triangle of the source had, so that an audit knows which floors are not walkable
// on purpose, and stages that are baked again are those of the file.

#include "base/arena.h"
#include "base/assert.h"
#include "base/host.h"
#include "pack/pack_format.h"

#include <string.h>

_Static_assert(sizeof(tl_pack_areas) == 64, "no hidden padding");

tl_result tl_pack_areas_encode(const uint8_t *areas, uint32_t count, const tl_allocator *allocator,
                               tl_pack_areas **areas_out, tl_report *report_out)
{
    tl_report_begin(report_out, "encode areas");
    if (areas_out == NULL) {
        return tl_report_field(report_out, TL_ERR_ARGUMENT, "areas_out", "it may not be NULL");
    }
    *areas_out = NULL;
    if (areas == NULL && count > 0) {
        return tl_report_field(report_out, TL_ERR_ARGUMENT, "areas", "it may not be NULL");
    }
    tl_pack_areas *blob = tl_blob_allocate(allocator, TL_PACK_AREAS_MAGIC, TL_PACK_AREAS_VERSION,
                                           sizeof(tl_pack_areas) + (uint64_t)count);
    if (blob == NULL) {
        return TL_ERR_MEMORY;
    }
    blob->count = count;
    if (count > 0) {
        memcpy(blob + 1, areas, count);
    }
    *areas_out = blob;
    return TL_OK;
}

const uint8_t *tl_pack_areas_array(const tl_pack_areas *areas)
{
    return (const uint8_t *)(areas + 1);
}

tl_result tl_pack_areas_check(const void *bytes, uint64_t size, tl_report *report_out)
{
    const tl_blob expected = { TL_PACK_AREAS_MAGIC, TL_PACK_AREAS_VERSION, sizeof(tl_pack_areas) };
    TL_TRY(tl_pack_check_head(bytes, size, expected, report_out));
    const tl_pack_areas *areas = bytes;
    uint32_t any = 0;
    for (size_t i = 0; i < TL_COUNT_OF(areas->reserved); i++) {
        any |= areas->reserved[i];
    }
    const uint64_t used = sizeof *areas + (uint64_t)areas->count;
    for (uint64_t i = used; i < size; i++) {
        any |= ((const uint8_t *)bytes)[i];
    }
    return size < used || size - used >= TL_BLOB_ALIGNMENT || any != 0
               ? tl_report_fail(report_out, TL_ERR_CORRUPT, "areas", TL_NO_ELEMENT, "bake the file again")
               : TL_OK;
}
