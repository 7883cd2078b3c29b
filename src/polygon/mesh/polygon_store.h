// SPDX-License-Identifier: MIT
//
// The growing mesh of a build: merged vertices, polygons, notes.

#ifndef TALUS_SRC_POLYGON_POLYGON_STORE_H
#define TALUS_SRC_POLYGON_POLYGON_STORE_H

#include "base/arena.h"
#include "polygon/outline/key_table.h"
#include "polygon/outline/lattice_point.h"

#include <talus/polygon.h>

/// What a polygon is of. A polygon that was replaced has no corners left.
typedef struct tl_stored_polygon {
    uint32_t first; // into indices
    uint32_t count;
    uint32_t region, area, contour;
} tl_stored_polygon;

typedef struct tl_polygon_store {
    tl_arena *arena;
    uint32_t merge_height;

    int32_t *vertices; // [3 * vertex_count]
    uint8_t *is_border;
    uint32_t *next_above; // [vertex] another vertex at the same x and z, or TL_NO_VALUE
    uint32_t vertex_count, vertex_capacity;
    tl_key_table places; // (x, z) to the first vertex there
    uint32_t place_count;

    tl_stored_polygon *polygons;
    uint32_t polygon_count, polygon_capacity;
    uint32_t *indices;
    uint32_t index_count, index_capacity;
    uint32_t *neighbours; // [index_count], by tl_link_neighbours

    tl_contour_note *notes;
    uint32_t note_count, note_capacity;
} tl_polygon_store;

/// Room for the expected counts; it grows beyond them.
tl_result tl_polygon_store_init(tl_polygon_store *store, tl_arena *arena, const tl_polygon_def *def,
                                uint32_t vertex_count);

/// The vertex at a place, made when there is none within merge_height. Of several the nearest on y, then the lowest.
tl_result tl_polygon_store_vertex(tl_polygon_store *store, int32_t x, int32_t y, int32_t z, bool is_border,
                                  uint32_t *vertex_out);

/// Appends a polygon whose corners are map[corners[k]] (NULL: corners[k]).
tl_result tl_polygon_store_add(tl_polygon_store *store, const uint32_t *corners, uint32_t count, const uint32_t *map,
                               const tl_stored_polygon *of);

tl_result tl_polygon_store_note(tl_polygon_store *store, const tl_contour_note *note);

static inline tl_lattice_point tl_stored_point(const tl_polygon_store *store, uint32_t vertex)
{
    tl_lattice_point p = { store->vertices[3 * (size_t)vertex], store->vertices[3 * (size_t)vertex + 2] };
    return p;
}

/// Drops polygons that were replaced and vertices that no polygon uses any more. What is known of places and border
/// vertices is stale after it.
tl_result tl_polygon_store_compact(tl_polygon_store *store, tl_arena *scratch);

/// Takes border vertices out of the polygons where that leaves the floor as it is. Counts into *gone and *kept.
tl_result tl_remove_border_vertices(tl_polygon_store *store, tl_arena *scratch, uint32_t max_corners, uint32_t *gone,
                                    uint32_t *kept);

/// Fills store->neighbours: polygons across shared edges, portals where border_size > 0.
tl_result tl_link_neighbours(tl_polygon_store *store, tl_arena *scratch, const tl_contour_set *contours,
                             tl_polygon_report *report);

#endif
