// SPDX-License-Identifier: MIT
//
// What a Navmesh of JavaScript is: the table of tiles with all that belongs to it.

#ifndef TALUS_WASM_JS_NAVMESH_H
#define TALUS_WASM_JS_NAVMESH_H

#include "js_mesh.h"

typedef struct tl_js_navmesh {
    tl_navmesh *navmesh;
    tl_nav_query *query; ///< NULL until a search needs it
    uint32_t max_nodes;  ///< of `query`, and of the next one
    tl_nav_def def;      ///< what it was baked with; bounds are those that were baked
    tl_nav_bake_report report;
    uint32_t tiles_x, tiles_z;
    tl_nav_obstacles *obstacles; ///< NULL: it was baked without
    tl_nav_links *links;         ///< found ones, for the file; NULL: none
    tl_pack_pruning *pruning;    ///< the rules it was pruned by; NULL: it was not
    tl_navmesh *removed;         ///< what was pruned; NULL: nothing
    void **copies;               ///< blocks of borrowed tiles
    uint32_t copy_count, copy_capacity;
    // The last path.
    tl_nav_corner *corners;
    tl_nav_ref *polygons;
    uint32_t corner_capacity, polygon_capacity;
} tl_js_navmesh;

/// An empty one. NULL: out of memory.
tl_js_navmesh *tl_js_navmesh_create(void);
void tl_js_navmesh_destroy(tl_js_navmesh *self);

/// The query of `self`, made where there is none.
tl_result tl_js_navmesh_query(tl_js_navmesh *self, tl_nav_query **query_out);

/// The smallest area by which it was pruned, square metres; 0: it was not.
double tl_js_pruned_area(const tl_js_navmesh *self);

/// An off-mesh link in the slot: start, end, radius, cost factor, fixed cost, flags, user, area, both ways.
tl_nav_offmesh tl_js_offmesh(uint32_t at);
/// Gives the entry behind it.
uint32_t tl_js_put_offmesh(uint32_t at, const tl_nav_offmesh *link);

/// Corners as three arrays in the buffer: references, points, flags. Slot, from `at` on: how many, and where.
tl_result tl_js_put_corners(uint32_t at, const tl_nav_corner *corners, uint32_t count);

/// Tiles in the order of a file: by z, x and layer. Slot numbers, tl_navmesh_tile_count of them; NULL: out of memory.
/// Freed with free().
uint32_t *tl_js_tile_order(const tl_navmesh *navmesh);

#endif
