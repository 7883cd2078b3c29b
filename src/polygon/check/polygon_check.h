// SPDX-License-Identifier: MIT
//
// The validator's shared state: which faults were found, and the first of them.

#ifndef TALUS_SRC_POLYGON_POLYGON_CHECK_H
#define TALUS_SRC_POLYGON_POLYGON_CHECK_H

#include "base/arena.h"
#include "base/radix_sort.h"
#include "polygon/outline/lattice_point.h"

#include <talus/polygon.h>

typedef struct tl_polygon_checker {
    const tl_polygon_mesh *mesh;
    const tl_contour_set *contours; // or NULL
    tl_arena arena;
    tl_polygon_check_report report;
} tl_polygon_checker;

void tl_polygon_checker_note(tl_polygon_checker *checker, tl_polygon_fault fault, const char *element, uint64_t index);

static inline tl_lattice_point tl_mesh_point(const tl_polygon_mesh *mesh, uint32_t vertex)
{
    tl_lattice_point p = { mesh->vertices[3 * (size_t)vertex], mesh->vertices[3 * (size_t)vertex + 2] };
    return p;
}

static inline tl_lattice_point tl_mesh_corner(const tl_polygon_mesh *mesh, uint32_t place)
{
    return tl_mesh_point(mesh, mesh->indices[place]);
}

/// The place of a polygon's next corner.
static inline uint32_t tl_mesh_next(const tl_polygon_mesh *mesh, uint32_t polygon, uint32_t place)
{
    return place + 1 < mesh->first[polygon + 1] ? place + 1 : mesh->first[polygon];
}

/// Whether the outline of `count` polygons (the values of the items), all of one contour, is the contour's.
tl_result tl_polygon_check_outline(tl_polygon_checker *checker, const tl_sort_item *polygons, uint32_t count,
                                   uint32_t contour);

/// Whether no two of `count` polygons of one group overlap, and no corner of one lies inside another's edge. False
/// where that is not proven: then pairs are to be looked at.
tl_result tl_polygon_sweep_cover(tl_polygon_checker *checker, const tl_sort_item *polygons, uint32_t count,
                                 bool *is_proven_out);

/// Overlaps, T-junctions, areas and outlines, contour by contour. The mesh's polygons are all convex.
tl_result tl_polygon_check_cover(tl_polygon_checker *checker);

#endif
