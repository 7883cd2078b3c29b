// SPDX-License-Identifier: MIT
//
// The OFFM chunk: off-mesh links that a person set, as ladders, doors and lifts, which nothing in the triangles shows.

#include "base/arena.h"
#include "base/assert.h"
#include "base/host.h"
#include "pack/pack_format.h"

#include <math.h>
#include <string.h>

_Static_assert(sizeof(tl_pack_offmesh) == 64 && sizeof(tl_pack_offmesh_link) == 64, "no hidden padding");

// As tl_navmesh_add_offmesh takes them.
static bool is_length(float value)
{
    return isfinite(value) && value >= 0.0f;
}

static bool is_sound_offmesh(const tl_pack_offmesh_link *link)
{
    return tl_is_finite(link->start) && tl_is_finite(link->end) && is_length(link->radius) &&
           is_length(link->cost_factor) && is_length(link->fixed_cost) && link->flags != 0 &&
           link->area <= TL_NAV_MAX_AREA && link->both_ways <= 1 && link->reserved == 0;
}

static tl_pack_offmesh_link encode_offmesh_link(const tl_nav_offmesh *link)
{
    tl_pack_offmesh_link packed;
    memset(&packed, 0, sizeof packed);
    packed.start = link->start;
    packed.end = link->end;
    packed.radius = link->radius;
    packed.cost_factor = link->cost_factor;
    packed.fixed_cost = link->fixed_cost;
    packed.area = link->area;
    packed.both_ways = link->both_ways;
    packed.flags = link->flags;
    packed.user = link->user;
    return packed;
}

tl_result tl_pack_offmesh_encode(const tl_nav_offmesh *links, uint32_t count, const tl_allocator *allocator,
                                 tl_pack_offmesh **offmesh_out, tl_report *report_out)
{
    tl_report_begin(report_out, "encode off-mesh links");
    if (offmesh_out == NULL) {
        return tl_report_field(report_out, TL_ERR_ARGUMENT, "offmesh_out", "it may not be NULL");
    }
    *offmesh_out = NULL;
    if (links == NULL && count > 0) {
        return tl_report_field(report_out, TL_ERR_ARGUMENT, "links", "it may not be NULL");
    }
    if (count > TL_NAV_MAX_OFFMESH) {
        return tl_report_fail(report_out, TL_ERR_LIMIT, "link", TL_NAV_MAX_OFFMESH, "give fewer links");
    }
    const uint64_t size = sizeof(tl_pack_offmesh) + count * (uint64_t)sizeof(tl_pack_offmesh_link);
    tl_pack_offmesh *offmesh = tl_blob_allocate(allocator, TL_PACK_OFFMESH_MAGIC, TL_PACK_OFFMESH_VERSION, size);
    if (offmesh == NULL) {
        return TL_ERR_MEMORY;
    }
    offmesh->count = count;
    for (uint32_t i = 0; i < count; i++) {
        const tl_pack_offmesh_link link = encode_offmesh_link(&links[i]);
        if (links[i].cookie != TL_DEF_COOKIE || !is_sound_offmesh(&link)) {
            tl_blob_free(offmesh);
            return tl_report_fail(report_out, TL_ERR_ARGUMENT, "link", i,
                                  "begin with tl_default_nav_offmesh(); give finite numbers, lengths >= 0 and a flag");
        }
        memcpy((tl_pack_offmesh_link *)(offmesh + 1) + i, &link, sizeof link);
    }
    *offmesh_out = offmesh;
    return TL_OK;
}

tl_nav_offmesh tl_pack_offmesh_at(const tl_pack_offmesh *offmesh, uint32_t index)
{
    const tl_pack_offmesh_link *packed = (const tl_pack_offmesh_link *)(offmesh + 1) + index;
    tl_nav_offmesh link = tl_default_nav_offmesh();
    link.start = packed->start;
    link.end = packed->end;
    link.radius = packed->radius;
    link.cost_factor = packed->cost_factor;
    link.fixed_cost = packed->fixed_cost;
    link.flags = packed->flags;
    link.user = packed->user;
    link.area = (uint8_t)packed->area;
    link.both_ways = packed->both_ways != 0;
    return link;
}

tl_result tl_pack_offmesh_check(const void *bytes, uint64_t size, tl_report *report_out)
{
    const tl_blob expected = { TL_PACK_OFFMESH_MAGIC, TL_PACK_OFFMESH_VERSION, sizeof(tl_pack_offmesh) };
    const char *again = "bake the file again";
    TL_TRY(tl_pack_check_head(bytes, size, expected, report_out));
    const tl_pack_offmesh *offmesh = bytes;
    uint32_t any = 0;
    for (size_t i = 0; i < TL_COUNT_OF(offmesh->reserved); i++) {
        any |= offmesh->reserved[i];
    }
    const uint64_t used = sizeof *offmesh + offmesh->count * (uint64_t)sizeof(tl_pack_offmesh_link);
    if (size != used || any != 0 || offmesh->count > TL_NAV_MAX_OFFMESH) {
        return tl_report_fail(report_out, TL_ERR_CORRUPT, "head", TL_NO_ELEMENT, again);
    }
    for (uint32_t i = 0; i < offmesh->count; i++) {
        if (!is_sound_offmesh((const tl_pack_offmesh_link *)(offmesh + 1) + i)) {
            return tl_report_fail(report_out, TL_ERR_CORRUPT, "link", i, again);
        }
    }
    return TL_OK;
}
