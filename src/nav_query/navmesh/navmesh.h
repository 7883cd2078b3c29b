// SPDX-License-Identifier: MIT
//
// The inside of a navmesh: slots of tiles, their seam links, and what is kept for them.

#ifndef TALUS_SRC_NAV_QUERY_NAVMESH_H
#define TALUS_SRC_NAV_QUERY_NAVMESH_H

#include "nav_query/history/history.h"
#include "nav_query/navmesh/islands.h"
#include "nav_query/navmesh/offmesh.h"
#include "nav_query/navmesh/rings.h"

enum { TL_NAV_REF_POLYGON_BITS = 28, TL_NAV_REF_SLOT_BITS = 20, TL_NAV_SEAM_LAYER_BITS = 16 };

/// A way into another tile, across the border or a cut. Where it lies is where both portals do: tl_nav_seam_ends.
typedef struct tl_nav_seam_link {
    uint64_t place;    ///< across: slot, then polygon, then the tile's layer in the lowest bits
    int32_t low, high; ///< of the portal across; a portal's links stand by low, then layer
} tl_nav_seam_link;

static inline uint32_t tl_nav_seam_slot(const tl_nav_seam_link *link)
{
    return (uint32_t)(link->place >> (TL_NAV_REF_POLYGON_BITS + TL_NAV_SEAM_LAYER_BITS));
}

static inline uint32_t tl_nav_seam_polygon(const tl_nav_seam_link *link)
{
    return (uint32_t)(link->place >> TL_NAV_SEAM_LAYER_BITS) & ((1u << TL_NAV_REF_POLYGON_BITS) - 1);
}

/// The links of one side of a tile; portal i of the side has [first[i], first[i + 1]). Without links it is zero.
struct tl_nav_side_links {
    uint32_t *first; ///< of a block that holds them, how many links it has room for, and the links
    uint32_t portal_count;
    uint32_t link_count;
};

/// `side` has some.
static inline tl_nav_seam_link *tl_nav_seam_links_of(const tl_nav_side_links *side)
{
    // Behind portal_count + 2 numbers, rounded up to an even count.
    return (tl_nav_seam_link *)(void *)(side->first + (((size_t)side->portal_count + 3) & ~(size_t)1));
}

/// The ends of a way over one of the tile's portals, seen looking out (tile_links.c).
void tl_nav_seam_ends(const tl_nav_tile *tile, uint32_t portal, const tl_nav_seam_link *link, tl_vec3 *left_out,
                      tl_vec3 *right_out);

/// A change of the navmesh: which one it was, counted from 1, and of which tile.
typedef struct tl_nav_edit {
    uint64_t number;
    int32_t tile_x, tile_z;
} tl_nav_edit;

/// Sums of the areas of a tile's polygons (area_table.h), of 32 bits where that of all has no more.
typedef struct tl_nav_areas {
    union {
        uint32_t *narrow;
        uint64_t *wide;
    } sums; ///< [polygon_count + 1]; NULL: there are none
    bool is_wide;
} tl_nav_areas;

typedef struct tl_nav_kept_walls tl_nav_kept_walls; // prepared_walls.h

typedef struct tl_nav_slot {
    const tl_nav_tile *tile;  ///< as queries see it; NULL: free
    tl_nav_tile *changed;     ///< that tile, where it is a copy with other flags or areas (state/); else NULL
    const tl_nav_tile *baked; ///< the tile as it was added, where `changed` stands in its place; else NULL
    uint32_t salt;            ///< 1 to 65535
    uint32_t next;            ///< in the chain of its bucket, or of the free slots
    tl_nav_edit last_edit;    ///< that changed what a search sees here
    uint64_t changed_in;      ///< the draft that made `changed`
    void *keeper;             ///< memory of a history that frees an owned tile; NULL: there is none
    tl_nav_tile_ownership ownership;
    uint32_t anchor_count; ///< ends of off-mesh links on its polygons
    tl_nav_side_links sides[TL_NAV_SIDE_COUNT];
    tl_nav_rings rings;
    tl_nav_areas areas;            ///< of the tile's polygons
    tl_nav_kept_walls *kept_walls; ///< NULL: not prepared, or dropped by an edit
} tl_nav_slot;

typedef struct tl_nav_visibility_graph tl_nav_visibility_graph; // visibility_graph.h

/// Data that a later room derives from the tiles and keeps with the navmesh.
typedef enum tl_nav_derived_kind {
    TL_NAV_DERIVED_GRAPH, ///< the visibility graph (prepared/)
    TL_NAV_DERIVED_WALLS, ///< walls around polygons (wide/)
    TL_NAV_DERIVED_KINDS
} tl_nav_derived_kind;

/// What the table of tiles does with it. Who derives the data sets this in the navmesh.
typedef struct tl_nav_derived {
    /// Drops what a change of the tile at a place makes wrong. NULL: nothing is dropped, the data knows its edit.
    void (*invalidate)(tl_navmesh *navmesh, int32_t tile_x, int32_t tile_z);
    void (*free_all)(tl_navmesh *navmesh);
    /// After an edit of flags or areas alone, which the data knows nothing of: what was right for the edit before is
    /// right now. NULL: it never asks for the edit.
    void (*outlive)(tl_navmesh *navmesh, uint64_t edit_before);
} tl_nav_derived;

/// How many of the things that a filter may meet, polygons and off-mesh links, have each flag.
typedef struct tl_nav_flag_counts {
    uint64_t all; ///< of them
    uint64_t with_bit[64];
    uint64_t all_flags; ///< that every one has; all of them when there is none
    uint64_t any_flags; ///< that at least one has
} tl_nav_flag_counts;

struct tl_navmesh {
    tl_allocator allocator;
    tl_nav_history *history; ///< NULL: it is no version of several (versions/)
    tl_nav_slot *slots;
    uint32_t *buckets; ///< heads of chains of slots by tile place; bucket_count is a power of two
    uint32_t slot_count, slot_capacity;
    uint32_t bucket_count;
    uint32_t free_slots; ///< head of the chain of free slots
    uint32_t tile_count;
    uint64_t link_count;
    uint64_t polygon_count;
    tl_nav_edit edit;     ///< the last one
    uint64_t *area_table; ///< [slot_capacity + 1], of the slots' areas
    tl_nav_islands islands;
    tl_nav_offmesh_table offmesh;
    const tl_nav_derived *derived[TL_NAV_DERIVED_KINDS]; ///< NULL: there is none
    tl_nav_visibility_graph *graph;                      ///< NULL, or that of the edit `graph_edit`
    uint64_t graph_edit;
    uint32_t last_fan;        ///< the last number that fans.c gave
    tl_nav_flag_counts flags; ///< of all polygons and off-mesh links
    float extent;             ///< metres: the largest |x| or |z| of any tile so far
    double kept_reach;        ///< metres: slots' kept walls lie within it
    double kept_touch;        ///< what touched when they were found (clearance.h)
    uint64_t kept_bytes;      ///< of them
    // Of all tiles; valid while tile_count > 0.
    tl_vec3 origin;
    float cell_size, cell_height;
    uint32_t tile_size;
};

/// Counts what comes (sign 1) or goes (-1) with those flags. tl_nav_settle_flags afterwards.
static inline void tl_nav_count_flags(tl_nav_flag_counts *counts, uint64_t flags, int sign)
{
    const uint64_t step = sign > 0 ? 1 : UINT64_MAX;
    counts->all += step;
    for (uint32_t bit = 0; flags != 0; bit++, flags >>= 1) {
        counts->with_bit[bit] += (flags & 1) != 0 ? step : 0;
    }
}

static inline void tl_nav_settle_flags(tl_nav_flag_counts *counts)
{
    counts->all_flags = 0;
    counts->any_flags = 0;
    for (uint32_t bit = 0; bit < 64; bit++) {
        counts->all_flags |= counts->with_bit[bit] == counts->all ? (uint64_t)1 << bit : 0;
        counts->any_flags |= counts->with_bit[bit] > 0 ? (uint64_t)1 << bit : 0;
    }
}

/// Counts the flags of a tile that comes or goes.
void tl_nav_count_tile_flags(tl_navmesh *navmesh, const tl_nav_tile *tile, int sign);

/// Makes a slot's tile the one that was added.
void tl_nav_drop_changes(tl_nav_slot *slot);
/// Frees a navmesh whose arrays are its own, with all that it owns; of a history that ends, with all of its memory.
void tl_nav_free_content(tl_navmesh *navmesh);

/// Notes that a slot is changed, for the versions after this one (history.h).
static inline void tl_nav_touch_slot(const tl_navmesh *navmesh, uint32_t slot)
{
    tl_nav_touch(navmesh->history, TL_NAV_PAGED_SLOTS, slot);
}

static inline tl_nav_ref tl_nav_make_ref(const tl_navmesh *navmesh, uint32_t slot, uint32_t polygon)
{
    return (uint64_t)navmesh->slots[slot].salt << (TL_NAV_REF_POLYGON_BITS + TL_NAV_REF_SLOT_BITS) |
           (uint64_t)slot << TL_NAV_REF_POLYGON_BITS | polygon;
}

/// The chain of slots that a place belongs to; there are some.
static inline uint32_t tl_nav_place_bucket(const tl_navmesh *navmesh, int32_t tile_x, int32_t tile_z)
{
    const uint64_t place = (uint64_t)(uint32_t)tile_x << 32 | (uint32_t)tile_z;
    return (uint32_t)tl_hash_mix(place) & (navmesh->bucket_count - 1);
}

/// Begins a change of the tile at a place.
static inline void tl_nav_begin_edit(tl_navmesh *navmesh, int32_t tile_x, int32_t tile_z)
{
    navmesh->edit.number++;
    navmesh->edit.tile_x = tile_x;
    navmesh->edit.tile_z = tile_z;
}

/// Notes that the change under way is one of what a search sees in a slot (sliced_path.c asks).
static inline void tl_nav_note_edit(tl_navmesh *navmesh, uint32_t slot)
{
    tl_nav_touch_slot(navmesh, slot);
    navmesh->slots[slot].last_edit = navmesh->edit;
}

/// Whether a filter, for which NULL stands for the default one, surely refuses no polygon.
static inline bool tl_nav_all_pass(const tl_navmesh *navmesh, const tl_nav_filter *filter)
{
    if (filter == NULL) {
        return navmesh->flags.all_flags != 0;
    }
    return (navmesh->flags.all_flags & filter->include_flags) != 0 &&
           (navmesh->flags.any_flags & filter->exclude_flags) == 0 && filter->pass == NULL;
}

/// Slot and polygon of a reference; false when it is stale.
bool tl_nav_split_ref(const tl_navmesh *navmesh, tl_nav_ref ref, uint32_t *slot_out, uint32_t *polygon_out);

/// The first slot of the tiles at a place, then the next one, or TL_NAV_NO_SLOT. In no order.
uint32_t tl_nav_find_slot(const tl_navmesh *navmesh, int64_t tile_x, int64_t tile_z);
uint32_t tl_nav_next_slot(const tl_navmesh *navmesh, uint32_t slot);
/// The slot of one layer at a place, or TL_NAV_NO_SLOT.
uint32_t tl_nav_find_layer_slot(const tl_navmesh *navmesh, int32_t tile_x, uint32_t layer, int32_t tile_z);

#endif
