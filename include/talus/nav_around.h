// SPDX-License-Identifier: MIT
//
// What lies around a place on a navmesh: random points, walls, the polygons in a zone, Dijkstra maps (flow fields):
// what a path costs to each of them; and goal trees: paths to one goal from everywhere, by one search.
//
// Like all queries these allocate nothing; those that search take a tl_nav_query for their nodes. Results are those of
// all searches (nav_query.h): TL_ERR_STALE, TL_ERR_NODES, TL_INCOMPLETE ...

#ifndef TALUS_NAV_AROUND_H
#define TALUS_NAV_AROUND_H

#include <talus/nav_query.h>

#ifdef __cplusplus
extern "C" {
#endif

// ---------------------------------------------------------------------------------------------------------
// Zones: parts of the plane.

#define TL_NAV_MAX_ZONE_POINTS 64

/// A circle, or a convex outline. The outline belongs to the zone.
typedef struct tl_nav_zone {
    tl_vec3 center;        ///< of the circle; y is ignored
    float radius;          ///< metres, >= 0
    const tl_vec3 *points; ///< NULL: the circle. Else a convex outline in x and z, either winding; the caller's
    uint32_t point_count;  ///< 3 to TL_NAV_MAX_ZONE_POINTS
} tl_nav_zone;

/// A circle of `radius` metres around `center`.
TL_API tl_nav_zone tl_nav_zone_circle(tl_vec3 center, float radius);
/// A convex outline of 3 to TL_NAV_MAX_ZONE_POINTS points, which must outlive the zone.
TL_API tl_nav_zone tl_nav_zone_polygon(const tl_vec3 *points, uint32_t point_count);

/// Heights from `min` to `max`, metres; they may be infinite.
typedef struct tl_nav_height_range {
    float min, max; ///< min <= max
} tl_nav_height_range;

/// Finds all polygons that pass the filter and overlap a zone, whether a path leads there or not, in the order of the
/// tiles' BVHs. With `heights` (NULL: all) only those whose bounding box comes into that range.
/// TL_ERR_ARGUMENT: the zone is invalid.
TL_API tl_result tl_navmesh_find_polygons(const tl_navmesh *navmesh, const tl_nav_filter *filter,
                                          const tl_nav_zone *zone, const tl_nav_height_range *heights,
                                          tl_nav_ref *polygons_out, uint32_t capacity, uint32_t *count_out);

// ---------------------------------------------------------------------------------------------------------
// Fields (Dijkstra maps, flow fields): the cost of the path to each polygon around a start.

/// A polygon that a path leads to.
typedef struct tl_nav_field_entry {
    tl_nav_ref polygon; ///< that the path enters last
    tl_nav_ref link;    ///< the off-mesh link by which the path enters it; TL_NAV_NO_REF: over an edge
    uint32_t parent;    ///< the entry that the path comes from; UINT32_MAX at the start
    float cost;         ///< of the path to `point`: metres times area costs, or what the filter's function says
    tl_vec3 point;      ///< where the path enters the polygon; the start in its own
} tl_nav_field_entry;

/// How far a field reaches, and what its paths cost. Begin with tl_default_nav_field_def.
typedef struct tl_nav_field_def {
    const tl_nav_filter *filter; ///< NULL: the default filter
    const tl_nav_zone *zone;     ///< NULL: everywhere; else paths cross only edges that overlap it, and take only
                                 ///< off-mesh links that land in it
    float max_cost;              ///< >= 0: polygons that are entered at a higher cost do not belong to the field
    bool by_reference;           ///< entries are ordered by reference, for tl_nav_field_find; false: in the order in
                                 ///< which they were found, the start's first, which takes less time
    uint32_t cookie;             ///< TL_DEF_COOKIE, set by tl_default_nav_field_def
} tl_nav_field_def;

/// The default filter, everywhere, at any cost (INFINITY), in the order found.
TL_API tl_nav_field_def tl_default_nav_field_def(void);

/// Floods the polygons around a start, the cheapest first: all that a path within the field's reach leads to, what that
/// path costs, and from where it comes. NULL def: the default one.
///
/// Paths enter each polygon at the point of its edge that is nearest to the point before: they are near the shortest
/// ones; tl_navmesh_straight_path pulls them straight. TL_INCOMPLETE: parents may name entries that did not fit.
/// TL_ERR_NODES: what was found is written, and costs may be too high. TL_ERR_ARGUMENT: the zone, an area cost,
/// max_cost below 0. O(polygons log polygons). Source: Dijkstra, A Note on Two Problems in Connexion with Graphs, 1959.
TL_API tl_result tl_nav_query_flood(tl_nav_query *query, const tl_navmesh *navmesh, const tl_nav_location *start,
                                    const tl_nav_field_def *def, tl_nav_field_entry *entries_out, uint32_t capacity,
                                    uint32_t *count_out);

/// The entry of a polygon in a field by reference, or UINT32_MAX. O(log count).
TL_API uint32_t tl_nav_field_find(const tl_nav_field_entry *entries, uint32_t count, tl_nav_ref polygon);

/// The path from the field's start to an entry's polygon, as tl_nav_query_find_path writes it, for
/// tl_navmesh_straight_path. A path without off-mesh links leads to the start when it is read backwards. No search.
/// TL_NOT_FOUND: there is no such entry, or a field that was cut off lacks one on the path.
TL_API tl_result tl_nav_field_path(const tl_nav_field_entry *entries, uint32_t count, uint32_t entry,
                                   tl_nav_ref *polygons_out, uint32_t capacity, uint32_t *count_out);

// ---------------------------------------------------------------------------------------------------------
// Goal trees: the paths of many to one goal, by one search.
//
//   tl_nav_goal_tree tree = { entries, capacity, 0, goal };
//   tl_nav_query_find_goal_tree(query, navmesh, NULL, &tree);
//   for each agent:
//     tl_nav_goal_path_request request = { NULL, start, 0 };
//     tl_nav_goal_tree_path(&tree, navmesh, &request, polygons, capacity, &path);

/// A polygon from which a path leads to the goal: a funnel in which its points see the last corner before them.
typedef struct tl_nav_goal_entry {
    tl_nav_ref polygon;
    tl_nav_ref link;         ///< the off-mesh link by which the path leaves it; TL_NAV_NO_REF: over an edge
    uint32_t parent;         ///< the entry of the polygon that the path enters next; UINT32_MAX: the goal is here
    float min_cost;          ///< of the polygon's cheapest point: metres times area costs, or what the filter says
    float cost;              ///< from the corner to the goal
    tl_vec3 corner;          ///< to which paths from here lead first
    float left[2], right[2]; ///< x and z, between which the corner is seen; both the corner itself: from everywhere
} tl_nav_goal_entry;

/// A tree in the caller's memory.
typedef struct tl_nav_goal_tree {
    tl_nav_goal_entry *entries; ///< by reference
    uint32_t capacity;
    uint32_t count; ///< that were found
    tl_nav_location goal;
} tl_nav_goal_tree;

/// Finds the paths to `tree->goal` from all polygons that lead there, the nearest first, off-mesh links in their
/// direction. NULL filter: the default one. TL_INCOMPLETE: the capacity is too small; TL_ERR_NODES: the query's nodes
/// are too few. Then the tree holds the polygons found so far, most of them nearer than those it lacks, and is of use.
/// TL_ERR_STALE: the goal's polygon. TL_ERR_ARGUMENT: an area cost. O(polygons log polygons).
///
/// A polygon has one funnel, so that among several ways of about the same length from a wide polygon the tree knows
/// one. Sources: Dijkstra, A Note on Two Problems in Connexion with Graphs, 1959; the funnel of Lee and Preparata,
/// Euclidean Shortest Paths in the Presence of Rectilinear Barriers, 1984, carried from each polygon to the next.
TL_API tl_result tl_nav_query_find_goal_tree(tl_nav_query *query, const tl_navmesh *navmesh,
                                             const tl_nav_filter *filter, tl_nav_goal_tree *tree);

/// A path by a tree.
typedef struct tl_nav_goal_path_request {
    const tl_nav_filter *filter; ///< the tree's
    tl_nav_location start;
    uint32_t max_polygons; ///< the path ends after as many, links among them; 0: at the goal
} tl_nav_goal_path_request;

/// The path from a start to the tree's goal, as tl_nav_query_find_path writes it, without a search: from each polygon
/// it goes on over the edge from where the goal is nearest, by the funnels of all its neighbours. The straight path
/// over these polygons is exact, but they need not be those of the shortest one. Where `max_polygons` ended it its
/// status is TL_NAV_PATH_UNFINISHED, and `path_out->end` the place from where it goes on. TL_NOT_FOUND: the tree does
/// not have the start's polygon. TL_ERR_STALE: the navmesh was edited since. O(path).
TL_API tl_result tl_nav_goal_tree_path(const tl_nav_goal_tree *tree, const tl_navmesh *navmesh,
                                       const tl_nav_goal_path_request *request, tl_nav_ref *polygons_out,
                                       uint32_t capacity, tl_nav_path *path_out);

// ---------------------------------------------------------------------------------------------------------
// Walls.

/// A piece of wall. The polygon lies on its left.
typedef struct tl_nav_wall_segment {
    tl_vec3 start, end; ///< metres
    tl_nav_ref polygon; ///< that it belongs to
    tl_nav_ref across;  ///< the polygon behind it, which the filter refuses; TL_NAV_NO_REF: there is none
    float distance;     ///< metres in the plane from the request's center; 0 for one polygon's walls
} tl_nav_wall_segment;

/// The walls of a polygon, in the order of its edges. What the filter refuses is wall.
TL_API tl_result tl_navmesh_polygon_walls(const tl_navmesh *navmesh, const tl_nav_filter *filter, tl_nav_ref polygon,
                                          tl_nav_wall_segment *segments_out, uint32_t capacity, uint32_t *count_out);

/// Finds the walls within a radius of a place in the plane, of the polygons that are connected with the center's within
/// it: the nearest `capacity` of them, uncut, the nearest first. TL_ERR_ARGUMENT: a negative radius.
TL_API tl_result tl_nav_query_find_walls(tl_nav_query *query, const tl_navmesh *navmesh,
                                         const tl_nav_around_request *request, tl_nav_wall_segment *segments_out,
                                         uint32_t capacity, uint32_t *count_out);

// ---------------------------------------------------------------------------------------------------------
// Random points. The random numbers are the caller's: all bits of both uniform. The same numbers give the same point on
// every machine.

/// A random point of the surface, uniform by area in the plane; areas are summed up in whole numbers, exactly.
/// O(log polygons); O(polygons) with a filter that refuses some. TL_NOT_FOUND: no polygon passes.
TL_API tl_result tl_navmesh_random_point(const tl_navmesh *navmesh, const tl_nav_filter *filter,
                                         const uint64_t random[2], tl_nav_location *location_out);

/// A random point that can be reached from the request's center: uniform by area over the part of the circle that lies
/// on polygons which a path of at most the radius enters over polygons that overlap the circle. Paths and their
/// lengths are those of tl_nav_query_flood with all area costs 1.
///
/// The circle is a regular polygon with 32 sides inscribed in it, which leaves out the outer 0.5% of the radius between
/// its corners. A circle without area has its center alone. TL_ERR_NODES: the point lies on the polygons that were
/// found. TL_ERR_ARGUMENT: a negative radius.
TL_API tl_result tl_nav_query_random_reachable(tl_nav_query *query, const tl_navmesh *navmesh,
                                               const tl_nav_around_request *request, const uint64_t random[2],
                                               tl_nav_location *location_out);
/// The same `count` times with one flood: random[2 * i] and random[2 * i + 1] choose locations_out[i].
TL_API tl_result tl_nav_query_random_reachable_points(tl_nav_query *query, const tl_navmesh *navmesh,
                                                      const tl_nav_around_request *request, const uint64_t *random,
                                                      uint32_t count, tl_nav_location *locations_out);

#ifdef __cplusplus
}
#endif

#endif
