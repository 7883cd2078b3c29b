// SPDX-License-Identifier: MIT
//
// The inside of a navmesh: slots of tiles, their seam links, and walking over a polygon's ways out.

#ifndef TALUS_SRC_NAV_QUERY_NAVMESH_H
#define TALUS_SRC_NAV_QUERY_NAVMESH_H

#include "nav_query/navmesh/islands.h"
#include "nav_query/navmesh/offmesh.h"
#include "nav_query/navmesh/rings.h"

/// A way into another tile, across the border or a cut.
typedef struct tl_nav_seam_link {
    uint32_t slot, polygon; ///< where it leads
    int32_t low;            ///< of the portal across
    uint32_t layer;         ///< of the tile across; a portal's links stand by low, then layer
    tl_vec3 left, right;    ///< seen looking out
} tl_nav_seam_link;

/// The links of one side of a tile; portal i of the side has [first[i], first[i + 1]). NULL without links.
struct tl_nav_side_links {
    uint32_t *first;
    tl_nav_seam_link *links;
    uint32_t portal_count;
    uint32_t link_count, link_capacity;
};

/// A change of the navmesh: which one it was, counted from 1, and of which tile.
typedef struct tl_nav_edit {
    uint64_t number;
    int32_t tile_x, tile_z;
} tl_nav_edit;

typedef struct tl_nav_kept_walls tl_nav_kept_walls; // prepared_walls.h

typedef struct tl_nav_slot {
    const tl_nav_tile *tile; ///< NULL: free
    uint32_t salt;           ///< 1 to 65535
    uint32_t next;           ///< in the chain of its bucket, or of the free slots
    tl_nav_edit last_edit;   ///< that changed what a search sees here
    uint64_t inner_links;    ///< ways between polygons of the tile
    tl_nav_tile_ownership ownership;
    uint32_t anchor_count; ///< ends of off-mesh links on its polygons
    tl_nav_side_links sides[TL_NAV_SIDE_COUNT];
    tl_nav_rings rings;
    uint64_t *areas;               ///< of the tile's polygons, summed up (area_table.h)
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
} tl_nav_derived;

struct tl_navmesh {
    tl_allocator allocator;
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
    tl_nav_visibility_graph *graph;                      ///< NULL, or that of the edit whose number it holds
    uint32_t last_fan;                                   ///< the last number that fans.c gave
    uint64_t all_flags;                                  ///< that every polygon of every tile so far has
    uint64_t any_flags;                                  ///< that some polygon of some tile so far has
    float extent;                                        ///< metres: the largest |x| or |z| of any tile so far
    double kept_reach;                                   ///< metres: slots' kept walls lie within it
    double kept_touch;                                   ///< what touched when they were found (clearance.h)
    uint64_t kept_bytes;                                 ///< of them
    // Of all tiles; valid while tile_count > 0.
    tl_vec3 origin;
    float cell_size, cell_height;
    uint32_t tile_size;
};

enum { TL_NAV_REF_POLYGON_BITS = 28, TL_NAV_REF_SLOT_BITS = 20 };

static inline tl_nav_ref tl_nav_make_ref(const tl_navmesh *navmesh, uint32_t slot, uint32_t polygon)
{
    return (uint64_t)navmesh->slots[slot].salt << (TL_NAV_REF_POLYGON_BITS + TL_NAV_REF_SLOT_BITS) |
           (uint64_t)slot << TL_NAV_REF_POLYGON_BITS | polygon;
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
    navmesh->slots[slot].last_edit = navmesh->edit;
}

/// Whether a filter, for which NULL stands for the default one, surely refuses no polygon.
static inline bool tl_nav_all_pass(const tl_navmesh *navmesh, const tl_nav_filter *filter)
{
    if (filter == NULL) {
        return navmesh->all_flags != 0;
    }
    return (navmesh->all_flags & filter->include_flags) != 0 && (navmesh->any_flags & filter->exclude_flags) == 0 &&
           filter->pass == NULL;
}

/// Slot and polygon of a reference; false when it is stale.
bool tl_nav_split_ref(const tl_navmesh *navmesh, tl_nav_ref ref, uint32_t *slot_out, uint32_t *polygon_out);

/// The first end of a link that is anchored in a slot, TL_NAV_NO_END when there is none; then the next one in its
/// bucket. Others than this polygon's are among them.
static inline uint32_t tl_nav_first_anchor(const tl_navmesh *navmesh, uint32_t slot, uint32_t polygon)
{
    const tl_nav_offmesh_table *table = &navmesh->offmesh;
    return navmesh->slots[slot].anchor_count > 0 ? table->buckets[tl_nav_anchor_bucket(table, slot, polygon)]
                                                 : TL_NAV_NO_END;
}

/// The side of a neighbour that faces a tile's side.
static inline uint32_t tl_nav_facing_side(uint32_t side)
{
    return side == TL_NAV_SIDE_CUT ? side : side ^ 2u;
}

/// The first slot of the tiles at a place, then the next one, or TL_NAV_NO_SLOT. In no order.
uint32_t tl_nav_find_slot(const tl_navmesh *navmesh, int64_t tile_x, int64_t tile_z);
uint32_t tl_nav_next_slot(const tl_navmesh *navmesh, uint32_t slot);

/// Links side `side` of tile a with the side of tile b that faces it, both ways. Both outputs are fresh, or on
/// TL_ERR_MEMORY untouched; zero when there are no links.
tl_result tl_nav_link_sides(const tl_allocator *allocator, const tl_nav_tile *a, uint32_t slot_a, uint32_t side,
                            const tl_nav_tile *b, uint32_t slot_b, tl_nav_side_links *a_out, tl_nav_side_links *b_out);
/// The links of both, which lead to different tiles from the same side. The output is fresh. TL_ERR_MEMORY.
tl_result tl_nav_join_sides(const tl_allocator *allocator, const tl_nav_side_links *a, const tl_nav_side_links *b,
                            tl_nav_side_links *out);
/// Drops the links that lead to a slot; returns how many.
uint32_t tl_nav_drop_links(const tl_allocator *allocator, tl_nav_side_links *side, uint32_t slot);
void tl_nav_free_side(const tl_allocator *allocator, tl_nav_side_links *side);

/// Numbers the turning vertices of all fans that touch a slot's polygons (fans.c).
void tl_nav_number_fans(tl_navmesh *navmesh, uint32_t slot);
/// The same for the fans that touch one side of a slot's tile: those that change when a tile comes or goes there.
void tl_nav_number_fans_on_side(tl_navmesh *navmesh, uint32_t slot, uint32_t side);

/// Joins the islands of a link's two anchors.
void tl_nav_join_anchors(tl_navmesh *navmesh, const tl_nav_offmesh_entry *entry);
/// Whether a link's anchors hang together without any off-mesh link.
bool tl_nav_is_same_component(const tl_navmesh *navmesh, const tl_nav_offmesh_entry *entry);

/// Anchors the ends of off-mesh links near a slot anew, after its tile has come, or for those that stood on it, before
/// it is freed but after it can be found no more. Seeds the islands where a link was lost.
void tl_nav_anchor_near(tl_navmesh *navmesh, uint32_t slot, bool tile_leaves);
/// Adds the flags of all off-mesh links to those that a filter may meet.
void tl_nav_note_offmesh_flags(tl_navmesh *navmesh);
void tl_nav_free_offmesh(tl_navmesh *navmesh);

// ---------------------------------------------------------------------------------------------------------
// Walking over the ways out of a polygon, edge by edge.

typedef struct tl_nav_way {
    uint32_t slot, polygon; ///< where it leads
    uint32_t edge;          ///< of the polygon that is left
    tl_vec3 left, right;    ///< seen looking out
    uint64_t key;           ///< names this way among all of the navmesh
} tl_nav_way;

typedef struct tl_nav_ways {
    const tl_nav_slot *slots;
    const tl_nav_tile *tile;
    uint32_t slot;
    uint32_t first_corner;
    const tl_vec3 *corners;
    const uint32_t *links;
    uint32_t corner_count;
    uint32_t edge; ///< the next one
    const tl_nav_seam_link *seam, *seam_end;
    uint64_t seam_key; ///< of the next seam link
} tl_nav_ways;

static inline tl_nav_ways tl_nav_ways_of(const tl_navmesh *navmesh, uint32_t slot, uint32_t polygon)
{
    tl_nav_ways ways;
    ways.slots = navmesh->slots;
    ways.tile = navmesh->slots[slot].tile;
    ways.slot = slot;
    ways.first_corner = ((const uint32_t *)tl_nav_tile_at(ways.tile, ways.tile->first_corner))[polygon];
    ways.corners = tl_nav_tile_corners(ways.tile, polygon, &ways.corner_count);
    ways.links = tl_nav_tile_links(ways.tile, polygon);
    ways.edge = 0;
    ways.seam = NULL;
    ways.seam_end = NULL;
    ways.seam_key = 0;
    return ways;
}

/// The seam links of a portal. An empty range (both NULL) where no tile lies.
static inline void tl_nav_seam_range(const tl_nav_slot *slot, uint32_t portal, const tl_nav_seam_link **begin_out,
                                     const tl_nav_seam_link **end_out, uint64_t *key_out)
{
    uint32_t side = tl_nav_tile_side_of(slot->tile, portal);
    const tl_nav_side_links *links = &slot->sides[side];
    *begin_out = NULL;
    *end_out = NULL;
    if (links->first != NULL) {
        uint32_t at = portal - tl_nav_tile_side_first(slot->tile, side);
        *begin_out = links->links + links->first[at];
        *end_out = links->links + links->first[at + 1];
        *key_out = (uint64_t)1 << 35 | (uint64_t)side << 32 | links->first[at];
    }
}

/// A way's key: slot (20 bits), then 36 bits: an edge's place among the tile's corners, or seam | side | link.
static inline uint64_t tl_nav_way_key(uint32_t slot, uint64_t place)
{
    return (uint64_t)slot << 36 | place;
}

static inline bool tl_nav_ways_next(tl_nav_ways *ways, tl_nav_way *way_out)
{
    for (;;) {
        if (ways->seam != ways->seam_end) {
            way_out->slot = ways->seam->slot;
            way_out->polygon = ways->seam->polygon;
            way_out->edge = ways->edge - 1;
            way_out->left = ways->seam->left;
            way_out->right = ways->seam->right;
            way_out->key = tl_nav_way_key(ways->slot, ways->seam_key++);
            ways->seam++;
            return true;
        }
        if (ways->edge == ways->corner_count) {
            return false;
        }
        uint32_t edge = ways->edge++;
        uint32_t link = ways->links[edge];
        if (link == TL_NAV_LINK_WALL) {
            continue;
        }
        if ((link & TL_NAV_LINK_PORTAL) != 0) {
            tl_nav_seam_range(&ways->slots[ways->slot], link & ~TL_NAV_LINK_PORTAL, &ways->seam, &ways->seam_end,
                              &ways->seam_key);
            continue;
        }
        way_out->slot = ways->slot;
        way_out->polygon = link;
        way_out->edge = edge;
        way_out->right = ways->corners[edge];
        way_out->left = ways->corners[edge + 1 < ways->corner_count ? edge + 1 : 0];
        way_out->key = tl_nav_way_key(ways->slot, ways->first_corner + edge);
        return true;
    }
}

#endif
