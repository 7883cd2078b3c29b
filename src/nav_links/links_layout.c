// SPDX-License-Identifier: MIT
//
// A set of links as bytes: laid out, checked, and added to a navmesh.

#include "nav_links/links_layout.h"

#include "base/arena.h"
#include "base/assert.h"
#include "base/blob_check.h"
#include "base/host.h"

#include <math.h>
#include <string.h>

_Static_assert(sizeof(tl_nav_jump_link) == 32 && sizeof(tl_nav_links) == 56, "no hidden padding");

// Links begin at the next multiple of 64.
enum { FIRST_LINK = 64 };

const char *tl_nav_link_kind_name(tl_nav_link_kind kind)
{
    static const char *const NAMES[] = { "drop", "jump", "climb" };
    return (unsigned)kind < TL_COUNT_OF(NAMES) ? NAMES[kind] : "unknown";
}

static uint64_t links_bytes(uint32_t count)
{
    uint64_t size = FIRST_LINK + (uint64_t)count * sizeof(tl_nav_jump_link);
    return (size + TL_BLOB_ALIGNMENT - 1) & ~(uint64_t)(TL_BLOB_ALIGNMENT - 1);
}

tl_nav_links *tl_nav_links_allocate(const tl_allocator *allocator, uint32_t count)
{
    tl_nav_links *links = tl_blob_allocate(allocator, TL_NAV_LINKS_MAGIC, TL_NAV_LINKS_VERSION, links_bytes(count));
    if (links != NULL) {
        links->link_count = count;
        links->links = FIRST_LINK;
    }
    return links;
}

static bool is_sound_link(const tl_nav_jump_link *link)
{
    float up = link->end.y - link->start.y;
    bool jumps = link->kind == TL_NAV_LINK_JUMP;
    return link->kind < TL_NAV_LINK_KINDS && link->both_ways <= 1 && link->reserved == 0 && tl_is_finite(link->start) &&
           tl_is_finite(link->end) && isfinite(link->apex) && link->apex >= 0.0f && isfinite(up) &&
           (jumps ? link->apex >= up : link->apex == 0.0f && up < 0.0f);
}

static bool is_length_or_zero(float metres)
{
    return isfinite(metres) && metres >= 0.0f;
}

static bool is_sound_links_head(const tl_nav_links *links, uint64_t size)
{
    return size == links->blob.size && size == links_bytes(links->link_count) && links->links == FIRST_LINK &&
           is_length_or_zero(links->agent_radius) && is_length_or_zero(links->agent_height) &&
           links->agent_height > 0.0f && is_length_or_zero(links->agent_max_climb) && is_length_or_zero(links->margin);
}

// The head's end and what follows the last link are zeros.
static bool is_padded_links(const tl_nav_links *links, uint64_t size)
{
    const uint8_t *bytes = (const uint8_t *)links;
    uint8_t any = 0;
    for (uint64_t i = sizeof *links; i < FIRST_LINK; i++) {
        any |= bytes[i];
    }
    for (uint64_t i = FIRST_LINK + (uint64_t)links->link_count * sizeof(tl_nav_jump_link); i < size; i++) {
        any |= bytes[i];
    }
    return any == 0;
}

tl_result tl_nav_links_check(const void *bytes, uint64_t size, tl_report *report_out)
{
    const tl_blob expected = { TL_NAV_LINKS_MAGIC, TL_NAV_LINKS_VERSION, sizeof(tl_nav_links) };
    TL_TRY(tl_blob_check_head(bytes, size, expected, 8, report_out));
    const tl_nav_links *links = bytes;
    if (!is_sound_links_head(links, size) || !is_padded_links(links, size)) {
        return tl_report_fail(report_out, TL_ERR_CORRUPT, "head", TL_NO_ELEMENT, "find the links again");
    }
    uint32_t counts[TL_NAV_LINK_KINDS] = { 0 };
    const tl_nav_jump_link *at = tl_nav_links_array(links);
    for (uint32_t i = 0; i < links->link_count; i++) {
        if (!is_sound_link(&at[i])) {
            return tl_report_fail(report_out, TL_ERR_CORRUPT, "link", i, "find the links again");
        }
        counts[at[i].kind]++;
    }
    return memcmp(counts, links->kind_counts, sizeof counts) == 0
               ? TL_OK
               : tl_report_fail(report_out, TL_ERR_CORRUPT, "head", TL_NO_ELEMENT, "find the links again");
}

tl_result tl_nav_links_add(const tl_nav_links *links, const tl_nav_offmesh *prototype, tl_navmesh *navmesh)
{
    if (links == NULL || navmesh == NULL) {
        return TL_ERR_ARGUMENT;
    }
    tl_nav_offmesh offmesh = prototype != NULL ? *prototype : tl_default_nav_offmesh();
    const tl_nav_jump_link *at = tl_nav_links_array(links);
    tl_nav_ref added;
    // With capacity for all of them only the prototype can be refused, and the first link finds that out.
    TL_TRY(tl_navmesh_reserve_offmesh(navmesh, links->link_count));
    for (uint32_t i = 0; i < links->link_count; i++) {
        offmesh.start = at[i].start;
        offmesh.end = at[i].end;
        offmesh.both_ways = at[i].both_ways != 0;
        offmesh.user = i;
        TL_TRY(tl_navmesh_add_offmesh(navmesh, &offmesh, &added, NULL));
    }
    return TL_OK;
}
