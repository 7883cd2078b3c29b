// SPDX-License-Identifier: MIT
//
// What an edit left of a visibility graph (graph_reuse.c).

#ifndef TALUS_SRC_NAV_QUERY_GRAPH_REUSE_H
#define TALUS_SRC_NAV_QUERY_GRAPH_REUSE_H

#include "nav_query/prepared/visibility_graph.h"

/// No vertex.
#define TL_NAV_NO_VERTEX UINT32_MAX

struct tl_nav_graph_reuse {
    const tl_nav_visibility_graph *old; ///< NULL: nothing of it is left
    uint32_t *now;                      ///< by old vertex: the new one that sees what it saw, or TL_NAV_NO_VERTEX
    uint32_t *before;                   ///< by new vertex: the old one of that name, or TL_NAV_NO_VERTEX
};

/// Compares the navmesh's graph, which may be NULL, with a new one whose vertices and slots are known. `vertex_of`: new
/// vertices by their numbers, of which there are `fan_count`. TL_ERR_MEMORY. tl_nav_free_reuse frees what is returned,
/// after an error too.
tl_result tl_nav_find_reuse(const tl_navmesh *navmesh, tl_nav_visibility_graph *graph, const uint32_t *vertex_of,
                            uint32_t fan_count, tl_nav_graph_reuse *reuse_out);
void tl_nav_free_reuse(const tl_allocator *allocator, const tl_nav_visibility_graph *graph, tl_nav_graph_reuse *reuse);

/// Whether a vertex of the new graph sees what it saw.
static inline bool tl_nav_is_reused(const tl_nav_graph_reuse *reuse, uint32_t vertex)
{
    return reuse->old != NULL && reuse->before[vertex] != TL_NAV_NO_VERTEX &&
           reuse->now[reuse->before[vertex]] == vertex;
}

/// Whether a slot has the tile that it had when the old graph was baked.
static inline bool tl_nav_is_tile_reused(const tl_navmesh *navmesh, const tl_nav_graph_reuse *reuse, uint32_t slot)
{
    return reuse->old != NULL && slot < reuse->old->slot_count && navmesh->slots[slot].tile != NULL &&
           navmesh->slots[slot].salt == reuse->old->slot_salt[slot];
}

#endif
