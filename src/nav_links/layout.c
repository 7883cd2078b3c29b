// SPDX-License-Identifier: MIT
//
// A set of links as bytes: made, checked, and put into a navmesh.

#include "nav_links/layout.h"

#include "base/arena.h"
#include "base/assert.h"

#include <math.h>
#include <string.h>

_Static_assert(sizeof(tl_nav_found_link) == 32 && sizeof(tl_nav_links) == 56, "no hidden padding");

// Links begin at the next multiple of 64.
enum { FIRST_LINK = 64 };

const char *tl_nav_link_kind_name(tl_nav_link_kind kind)
{
    static const char *const NAMES[] = { "drop", "jump", "climb" };
    return (unsigned)kind < TL_COUNT_OF(NAMES) ? NAMES[kind] : "unknown";
}

static uint64_t size_of(uint32_t count)
{
    uint64_t size = FIRST_LINK + (uint64_t)count * sizeof(tl_nav_found_link);
    return (size + TL_BLOB_ALIGNMENT - 1) & ~(uint64_t)(TL_BLOB_ALIGNMENT - 1);
}

tl_nav_links *tl_nav_links_create(const tl_allocator *allocator, uint32_t count)
{
    tl_nav_links *links = tl_blob_allocate(allocator, TL_NAV_LINKS_MAGIC, TL_NAV_LINKS_VERSION, size_of(count));
    if (links != NULL) {
        links->link_count = count;
        links->links = FIRST_LINK;
    }
    return links;
}

static bool is_finite(tl_vec3 v)
{
    return isfinite(v.x) && isfinite(v.y) && isfinite(v.z);
}

static bool is_sane(const tl_nav_found_link *link)
{
    float up = link->end.y - link->start.y;
    bool jumps = link->kind == TL_NAV_LINK_JUMP;
    return link->kind < TL_NAV_LINK_KINDS && link->both_ways <= 1 && link->reserved == 0 && is_finite(link->start) &&
           is_finite(link->end) && isfinite(link->apex) && link->apex >= 0.0f && isfinite(up) &&
           (jumps ? link->apex >= up : link->apex == 0.0f && up < 0.0f);
}

tl_result tl_nav_links_check(const void *bytes, uint64_t size)
{
    if ((uintptr_t)bytes % 8 != 0) {
        return TL_ERR_ARGUMENT;
    }
    const tl_nav_links *links = bytes;
    if (size < sizeof(tl_blob)) {
        return TL_ERR_TRUNCATED;
    }
    if (links->blob.magic != TL_NAV_LINKS_MAGIC) {
        return TL_ERR_MAGIC;
    }
    if (links->blob.version != TL_NAV_LINKS_VERSION) {
        return TL_ERR_VERSION;
    }
    if (size < sizeof *links || size < links->blob.size) {
        return TL_ERR_TRUNCATED;
    }
    if (size != links->blob.size || size != size_of(links->link_count) || links->links != FIRST_LINK) {
        return TL_ERR_CORRUPT;
    }
    bool sane = links->agent_radius >= 0.0f && isfinite(links->agent_radius) && links->agent_height > 0.0f &&
                isfinite(links->agent_height) && links->agent_lift >= 0.0f && isfinite(links->agent_lift) &&
                links->margin >= 0.0f && isfinite(links->margin);
    uint32_t counts[TL_NAV_LINK_KINDS] = { 0 };
    const tl_nav_found_link *at = tl_nav_links_at(links);
    for (uint32_t i = 0; i < links->link_count && sane; i++) {
        sane = is_sane(&at[i]);
        if (sane) {
            counts[at[i].kind]++;
        }
    }
    // The head's end and what follows the last link are zeros.
    const uint8_t *byte = bytes;
    for (uint64_t i = sizeof *links; i < FIRST_LINK; i++) {
        sane = sane && byte[i] == 0;
    }
    for (uint64_t i = FIRST_LINK + (uint64_t)links->link_count * sizeof *at; i < size; i++) {
        sane = sane && byte[i] == 0;
    }
    return sane && memcmp(counts, links->kind_counts, sizeof counts) == 0 ? TL_OK : TL_ERR_CORRUPT;
}

tl_result tl_nav_links_add(const tl_nav_links *links, const tl_nav_offmesh *like, tl_navmesh *navmesh)
{
    tl_nav_offmesh offmesh = like != NULL ? *like : tl_default_nav_offmesh();
    const tl_nav_found_link *at = tl_nav_links_at(links);
    tl_nav_ref added;
    // With room for all of them only `like` can be refused, and the first link finds that out.
    TL_TRY(tl_navmesh_reserve_offmesh(navmesh, links->link_count));
    for (uint32_t i = 0; i < links->link_count; i++) {
        offmesh.start = at[i].start;
        offmesh.end = at[i].end;
        offmesh.both_ways = at[i].both_ways != 0;
        offmesh.user = i;
        TL_TRY(tl_navmesh_add_offmesh(navmesh, &offmesh, &added));
    }
    return TL_OK;
}
