// SPDX-License-Identifier: MIT
//
// Off-mesh links as searches see them: found from the polygon that one of their ends is anchored to.
//
// Links stand in one table of the navmesh, and their anchored ends in buckets by polygon. So a link may lead anywhere,
// adding and removing one touches nothing but itself, and tiles know nothing of links. A slot counts the ends on its
// polygons: where there are none a search does not look.

#ifndef TALUS_SRC_NAV_QUERY_OFFMESH_H
#define TALUS_SRC_NAV_QUERY_OFFMESH_H

#include "base/hash.h"

#include <talus/nav_query.h>

#define TL_NAV_NO_SLOT UINT32_MAX
#define TL_NAV_NO_END  UINT32_MAX

/// Where an end of a link stands. An end's number is 2 * its link's index, and 1 more for the link's end.
typedef struct tl_nav_anchor {
    uint32_t slot, polygon; ///< TL_NAV_NO_SLOT: nowhere
    uint32_t next;          ///< end in the same bucket
    tl_vec3 point;
} tl_nav_anchor;

typedef struct tl_nav_offmesh_entry {
    tl_nav_offmesh offmesh;
    tl_nav_anchor ends[2];
    double cost;       ///< metres, while both ends are anchored
    uint32_t salt;     ///< 1 to TL_NAV_LAST_LINK_SALT; changes when the link is removed
    uint32_t next;     ///< free entry
    uint32_t short_at; ///< its place among the short cuts, or UINT32_MAX
    bool is_used;
} tl_nav_offmesh_entry;

enum { TL_NAV_LAST_LINK_SALT = 0x7fffff, TL_NAV_LINK_INDEX_BITS = 24 };

typedef struct tl_nav_offmesh_table {
    tl_nav_offmesh_entry *entries; ///< [capacity]
    uint32_t *buckets;             ///< [2 * capacity], a power of two: first ends
    uint32_t *short_cuts;          ///< [capacity]: anchored links that cost less than their length
    uint32_t capacity;
    uint32_t used;  ///< entries below have been used once
    uint32_t free;  ///< first free entry below, or UINT32_MAX
    uint32_t count; ///< links
    uint32_t short_count;
} tl_nav_offmesh_table;

static inline uint32_t tl_nav_anchor_bucket(const tl_nav_offmesh_table *table, uint32_t slot, uint32_t polygon)
{
    return (uint32_t)tl_hash_mix((uint64_t)slot << 32 | polygon) & (2 * table->capacity - 1);
}

static inline bool tl_nav_is_anchored(const tl_nav_offmesh_entry *entry)
{
    return entry->ends[0].slot != TL_NAV_NO_SLOT && entry->ends[1].slot != TL_NAV_NO_SLOT;
}

/// Whether a path may go from the end `end` of a link, which is in a bucket, to the other one, for a filter that NULL
/// stands for as everywhere.
static inline bool tl_nav_may_cross(const tl_nav_offmesh_entry *entry, uint32_t end, const tl_nav_filter *filter)
{
    uint64_t flags = entry->offmesh.flags;
    return (end == 0 || entry->offmesh.both_ways) && entry->ends[1 - end].slot != TL_NAV_NO_SLOT &&
           (filter == NULL || ((flags & filter->include_flags) != 0 && (flags & filter->exclude_flags) == 0));
}

/// The reference of a link as it is crossed from an end.
static inline tl_nav_ref tl_nav_offmesh_ref(const tl_nav_offmesh_table *table, uint32_t end)
{
    tl_nav_ref link = (uint64_t)table->entries[end / 2].salt << TL_NAV_LINK_INDEX_BITS | end / 2;
    return end % 2 == 0 ? link : link | TL_NAV_OFFMESH_BACKWARD;
}

/// The entry that a reference names, or NULL.
static inline tl_nav_offmesh_entry *tl_nav_find_offmesh(const tl_nav_offmesh_table *table, tl_nav_ref link)
{
    uint32_t index = (uint32_t)link & ((1u << TL_NAV_LINK_INDEX_BITS) - 1);
    bool exists = tl_nav_is_offmesh(link) && index < table->used && table->entries[index].is_used &&
                  table->entries[index].salt == (uint32_t)((link & ~TL_NAV_OFFMESH_BACKWARD) >> TL_NAV_LINK_INDEX_BITS);
    return exists ? &table->entries[index] : NULL;
}

void tl_nav_free_offmesh(tl_navmesh *navmesh);

#endif
