// SPDX-License-Identifier: MIT
//
// All polygons of a navmesh, island by island.

#ifndef TALUS_SRC_NAV_AUDIT_POLYGON_LIST_H
#define TALUS_SRC_NAV_AUDIT_POLYGON_LIST_H

#include <talus/nav_query.h>

typedef struct tl_audit_polygon {
    tl_nav_ref ref;
    const tl_nav_tile *tile;
    uint32_t polygon;
    uint32_t island;
    double area_before;    ///< square metres of all polygons before it
    uint64_t steps_before; ///< of the lines of all polygons before it (audit_polygons.c)
} tl_audit_polygon;

typedef struct tl_audit_polygon_list {
    tl_audit_polygon *polygons; ///< by island, then slot and polygon
    uint32_t count;
    double area; ///< square metres in the plane
    const tl_allocator *allocator;
} tl_audit_polygon_list;

/// A navmesh that is NULL has none. TL_ERR_MEMORY, TL_ERR_LIMIT (2^31 polygons).
tl_result tl_audit_list_polygons(const tl_navmesh *navmesh, const tl_allocator *allocator,
                                 tl_audit_polygon_list *list_out);
void tl_audit_polygons_free(tl_audit_polygon_list *list);

/// Square metres before polygon number `index` <= count.
double tl_audit_area_before(const tl_audit_polygon_list *list, uint32_t index);

/// The island of polygon number `index`: numbers from *begin_out up to, but not, the value returned.
uint32_t tl_audit_island_around(const tl_audit_polygon_list *list, uint32_t index, uint32_t *begin_out);

#endif
