// SPDX-License-Identifier: MIT
//
// What lies around a place on a navmesh: random points, walls, polygons in a zone, and how far it is to each of them.
//
// Like all queries these allocate nothing; those that search take a tl_nav_query for their nodes.

#ifndef TALUS_NAV_AROUND_H
#define TALUS_NAV_AROUND_H

#include <talus/nav_query.h>

#ifdef __cplusplus
extern "C" {
#endif

// ---------------------------------------------------------------------------------------------------------
// Zones: a part of the plane.

#define TL_NAV_MAX_ZONE_POINTS 64

/// A circle, or a convex outline. Its own outline belongs to it.
typedef struct tl_nav_zone {
    tl_vec3 center;        ///< of the circle; y is not looked at
    float radius;          ///< >= 0
    const tl_vec3 *points; ///< NULL: the circle. Else a convex outline in x and z, either winding
    uint32_t point_count;  ///< 3 to TL_NAV_MAX_ZONE_POINTS
} tl_nav_zone;

TL_API tl_nav_zone tl_nav_zone_circle(tl_vec3 center, float radius);
TL_API tl_nav_zone tl_nav_zone_polygon(const tl_vec3 *points, uint32_t point_count);

/// Heights from `min` to `max`, metres; they may be infinite.
typedef struct tl_nav_height_range {
    float min, max;
} tl_nav_height_range;

/// All polygons that pass and come into a zone, whether a path leads there or not. Their order is that of the tiles'
/// trees. Only those whose surface comes into `heights` (NULL: all), as far as its box tells. `*count_out` is the true
/// number. TL_INCOMPLETE: only the first were written. TL_ERR_ARGUMENT (a zone that is none), TL_ERR_NOT_FINITE.
TL_API tl_result tl_navmesh_find_polygons(const tl_navmesh *navmesh, const tl_nav_filter *filter,
                                          const tl_nav_zone *zone, const tl_nav_height_range *heights,
                                          tl_nav_ref *polygons_out, uint32_t capacity, uint32_t *count_out);

// ---------------------------------------------------------------------------------------------------------
// Fields: the cost of the way to each polygon around.

/// A polygon that a path leads to.
typedef struct tl_nav_field_entry {
    tl_nav_ref polygon;
    tl_nav_ref link; ///< the off-mesh link by which the path enters it; TL_NAV_NO_REF: over an edge
    uint32_t parent; ///< the entry that the path comes from; UINT32_MAX at the start
    float cost;      ///< of the path to `point`: metres times area costs, or what the filter's function says
    tl_vec3 point;   ///< where the path enters the polygon; the start in its own
} tl_nav_field_entry;

/// How far a field reaches, and what its ways cost. Begin with tl_default_nav_field_def.
typedef struct tl_nav_field_def {
    const tl_nav_filter *filter; ///< NULL: the default filter
    const tl_nav_zone *zone;     ///< NULL: everywhere; else only ways from polygon to polygon that come into it count,
                                 ///< and off-mesh links that land in it
    float max_cost;              ///< >= 0: polygons that are entered at a higher cost do not belong to the field
    bool by_reference;           ///< entries stand in the order of references, for tl_nav_field_find; false: in the
                                 ///< order in which they were found, the start's first, which takes less time
    uint32_t cookie;             ///< TL_DEF_COOKIE, set by tl_default_nav_field_def
} tl_nav_field_def;

/// The default filter, everywhere, at any cost (INFINITY), as found.
TL_API tl_nav_field_def tl_default_nav_field_def(void);

/// Floods the polygons around a start, the cheapest first: those that hang together with it within the field's reach,
/// what a path costs there, and from where it comes.
///
/// Paths go from polygon to polygon over the point of the way that is nearest to the one before: they are no shortest
/// ones, but lie near them; tl_navmesh_straight_path makes them short. `*count_out` is the true number.
/// TL_INCOMPLETE: only the first were written, and parents may name others. TL_ERR_LIMIT: the query was out of nodes;
/// those that were found are written, and costs may be too high. TL_NOT_FOUND: a stale reference.
/// TL_ERR_NOT_FINITE. TL_ERR_ARGUMENT: the zone, a cost, max_cost below 0. O(polygons log polygons). Source: Dijkstra
/// 1959.
TL_API tl_result tl_nav_query_flood(tl_nav_query *query, const tl_navmesh *navmesh, const tl_nav_location *start,
                                    const tl_nav_field_def *def, tl_nav_field_entry *entries_out, uint32_t capacity,
                                    uint32_t *count_out);

/// The entry of a polygon in a field by reference, or UINT32_MAX. O(log count).
TL_API uint32_t tl_nav_field_find(const tl_nav_field_entry *entries, uint32_t count, tl_nav_ref polygon);

/// The path from the field's start to an entry's polygon, as tl_nav_query_find_path writes it, for
/// tl_navmesh_straight_path. Without off-mesh links, read backwards, it leads to the start. No search. TL_INCOMPLETE:
/// only the first were written. TL_NOT_FOUND: there is no such entry, or a field that was cut off lacks one on the
/// way.
TL_API tl_result tl_nav_field_path(const tl_nav_field_entry *entries, uint32_t count, uint32_t entry,
                                   tl_nav_ref *polygons_out, uint32_t capacity, uint32_t *count_out);

// ---------------------------------------------------------------------------------------------------------
// Walls.

/// A piece of wall. The polygon lies on its left.
typedef struct tl_nav_wall_segment {
    tl_vec3 start, end;
    tl_nav_ref polygon; ///< that it belongs to
    tl_nav_ref across;  ///< the polygon behind it, that the filter refuses; TL_NAV_NO_REF: nothing lies there
    float distance;     ///< metres in the plane from the place that was asked for; 0 for one polygon's walls
} tl_nav_wall_segment;

/// The walls of a polygon, in the order of its edges. What the filter refuses is wall. `*count_out` is the true number.
/// TL_INCOMPLETE: only the first were written. TL_NOT_FOUND: a stale reference.
TL_API tl_result tl_navmesh_polygon_walls(const tl_navmesh *navmesh, const tl_nav_filter *filter, tl_nav_ref polygon,
                                          tl_nav_wall_segment *segments_out, uint32_t capacity, uint32_t *count_out);

/// The walls within `radius` metres in the plane of the polygons that hang together with the centre's within it: the
/// nearest `capacity` of them, the nearest first, whole. `*count_out` is the true number. TL_INCOMPLETE: there are
/// more. TL_ERR_LIMIT: the query was out of nodes. TL_NOT_FOUND: a stale reference. TL_ERR_NOT_FINITE.
/// TL_ERR_ARGUMENT: a negative radius.
TL_API tl_result tl_nav_query_find_walls(tl_nav_query *query, const tl_navmesh *navmesh,
                                         const tl_nav_around_request *request, tl_nav_wall_segment *segments_out,
                                         uint32_t capacity, uint32_t *count_out);

// ---------------------------------------------------------------------------------------------------------
// Random points. The random numbers are the caller's: all bits of both evenly spread. The same ones give the same point
// everywhere.

/// A point of the surface, each square of the lattice in the plane as likely as any other: areas are summed up in whole
/// numbers. O(log polygons); O(polygons) with a filter that refuses some. TL_NOT_FOUND: none passes.
TL_API tl_result tl_navmesh_random_point(const tl_navmesh *navmesh, const tl_nav_filter *filter,
                                         const uint64_t random[2], tl_nav_location *location_out);

/// A point that can be reached from `center`: uniform by area over what lies within the circle of `radius` metres in
/// the plane on those polygons which a path enters that is no longer than the radius and stays on polygons that come
/// into the circle. Paths and their lengths are those of tl_nav_query_flood with all area costs 1. The circle is
/// a regular polygon with 32 sides within it, which leaves out the outmost 0.5% of the radius between its corners.
/// A circle without area has its centre alone. TL_ERR_LIMIT: the query was out of nodes; the point lies on the polygons
/// that were found. TL_NOT_FOUND: a stale reference. TL_ERR_NOT_FINITE. TL_ERR_ARGUMENT: a negative radius.
TL_API tl_result tl_nav_query_random_reachable(tl_nav_query *query, const tl_navmesh *navmesh,
                                               const tl_nav_around_request *request, const uint64_t random[2],
                                               tl_nav_location *location_out);
/// The same `count` times, for one flood: random[2 * i] and random[2 * i + 1] choose locations_out[i].
TL_API tl_result tl_nav_query_random_reachable_points(tl_nav_query *query, const tl_navmesh *navmesh,
                                                      const tl_nav_around_request *request, const uint64_t *random,
                                                      uint32_t count, tl_nav_location *locations_out);

#ifdef __cplusplus
}
#endif

#endif
