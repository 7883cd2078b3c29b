// SPDX-License-Identifier: MIT
//
// A ray along the surface: walk from polygon to polygon through the edge by which the ray leaves.
//
// That edge is not chosen by intersection parameters, whose rounding differs from polygon to polygon, but by one label
// a vertex: left or right of the ray. The ray leaves by the edge that runs from a right vertex to a left one. A vertex
// has the same label in all polygons around it, so the walk cannot lose its way or circle around a corner.
//
// A vertex within rounding of the ray is touched. It counts as left first. Where that walk ends at a wall, a second
// walk counts it as right; where both end at a wall that begins in a touched vertex, the walk continues from this
// vertex in the same two ways. So a ray that only touches corners, on either side, or runs along walls, is not stopped.
// Sources: for the walk, Guibas and Stolfi 1985; for the labels, Edelsbrunner and Muecke, Simulation of Simplicity,
// 1990.

#include "nav_query/filter/nav_filter.h"
#include "nav_query/navmesh/ring_step.h"
#include "nav_query/navmesh/ways.h"
#include "nav_query/plane/side.h"
#include "nav_query/plane/surface.h"

#include <string.h>

typedef struct surface_ray {
    const tl_navmesh *navmesh;
    const tl_nav_filter *filter;
    tl_vec3 start, end;
    tl_vec3 from;          // where the walk begins: the start, or a touched vertex
    double rounding;       // metres in the plane within which two points are the same
    double grazing;        // doubled area: a vertex nearer to the ray's line than rounding
    bool touching_is_left; // the label of such a vertex
    bool touched;          // there was one
    uint64_t steps_left;
} surface_ray;

// Where a walk is, and what it has crossed.
typedef struct ray_walk {
    uint32_t slot, polygon;
    uint32_t polygon_count; // crossed, this one included
    double t;
    bool hit;
    uint32_t edge; // that was hit
    bool has_point;
    tl_vec3 point; // where it ends, in the plane and in the polygon
} ray_walk;

typedef struct ray_trace {
    tl_nav_ref *polygons;
    uint32_t capacity;
} ray_trace;

// Distance in the plane, as a share of the largest coordinate, within which a vertex may lie on the ray: its own and
// the ray's two points' coordinates are each rounded to float, on both axes.
#define GRAZING_ERROR ((double)TL_FLOAT_GAMMA(6))

static bool is_left_of_ray(surface_ray *ray, tl_vec3 vertex)
{
    double turn = tl_nav_turn(ray->start, ray->end, vertex);
    if (fabs(turn) <= ray->grazing) {
        ray->touched = true;
        return ray->touching_is_left;
    }
    return turn < 0.0;
}

// Where on the ray the line through a and b is crossed, >= 0.
static double crossing_of_ray(const surface_ray *ray, tl_vec3 a, tl_vec3 b)
{
    double at_start = tl_nav_turn(a, b, ray->start);
    double at_end = tl_nav_turn(a, b, ray->end);
    double change = at_start - at_end;
    double t = change != 0.0 ? at_start / change : 0.0;
    return t > 0.0 ? t : 0.0;
}

// The edge by which the ray leaves the polygon; false when it does not cross it. With rounded corners there may be more
// than one: the farthest.
static bool find_exit(surface_ray *ray, const tl_vec3 *corners, uint32_t count, uint32_t *edge_out, double *t_out)
{
    bool found = false;
    bool left = is_left_of_ray(ray, corners[0]);
    for (uint32_t i = 0; i < count; i++) {
        tl_vec3 a = corners[i];
        tl_vec3 b = corners[i + 1 < count ? i + 1 : 0];
        bool next_left = is_left_of_ray(ray, b);
        if (!left && next_left) {
            double t = crossing_of_ray(ray, a, b);
            if (!found || t > *t_out) {
                found = true;
                *edge_out = i;
                *t_out = t;
            }
        }
        left = next_left;
    }
    return found;
}

// Whether the ray goes through this stretch of a seam.
static bool is_through(surface_ray *ray, const tl_nav_tile *tile, uint32_t portal, const tl_nav_seam_link *seam)
{
    tl_vec3 left, right;
    tl_nav_seam_ends(tile, portal, seam, &left, &right);
    return !is_left_of_ray(ray, right) && is_left_of_ray(ray, left);
}

// Steps over an edge; false at a wall, at a gap in a tile's seam, and where the filter refuses the polygon behind.
static bool step_over(surface_ray *ray, uint32_t edge, uint32_t *slot, uint32_t *polygon)
{
    const tl_nav_slot *from = &ray->navmesh->slots[*slot];
    const uint32_t link = tl_nav_tile_edge_link(from->tile, *polygon, edge);
    uint32_t to_slot = *slot;
    uint32_t to_polygon = link;
    if (link == TL_NAV_LINK_WALL) {
        return false;
    }
    if ((link & TL_NAV_LINK_PORTAL) != 0) {
        const tl_nav_seam_link *seam = NULL;
        const tl_nav_seam_link *end = NULL;
        uint64_t key = 0;
        const uint32_t portal = tl_nav_link_portal(link);
        tl_nav_seam_range(from, portal, &seam, &end, &key);
        while (seam != end && !is_through(ray, from->tile, portal, seam)) {
            seam++;
        }
        if (seam == end) {
            return false;
        }
        to_slot = tl_nav_seam_slot(seam);
        to_polygon = tl_nav_seam_polygon(seam);
    }
    if (!tl_nav_passes(ray->filter, ray->navmesh->slots[to_slot].tile, to_polygon)) {
        return false;
    }
    *slot = to_slot;
    *polygon = to_polygon;
    return true;
}

// Whether the walk's begin, moved ahead by a trifle and by a far smaller one aside, is beyond the edge from a to b. To
// the side away from vertices that touch: they count as left, so the ray passes right of them, or the other way around.
static bool starts_beyond(const surface_ray *ray, tl_vec3 a, tl_vec3 b)
{
    double ex = (double)b.x - (double)a.x;
    double ez = (double)b.z - (double)a.z;
    double length = sqrt(ex * ex + ez * ez);
    double turn = tl_nav_turn(a, b, ray->from);
    if (fabs(turn) > ray->rounding * length) {
        return turn > 0.0;
    }
    double dx = (double)ray->end.x - (double)ray->start.x;
    double dz = (double)ray->end.z - (double)ray->start.z;
    double ahead = ex * dz - ez * dx;
    if (fabs(ahead) > ray->rounding * length) {
        return ahead > 0.0;
    }
    // The edge lies on the ray: it runs with it or against it, and its inside is on its left.
    bool with_ray = ex * dx + ez * dz > 0.0;
    return with_ray == ray->touching_is_left;
}

static void record_polygon(const surface_ray *ray, const ray_walk *at, const ray_trace *trace)
{
    if (at->polygon_count <= trace->capacity) {
        trace->polygons[at->polygon_count - 1] = tl_nav_make_ref(ray->navmesh, at->slot, at->polygon);
    }
}

static bool begins_in(const surface_ray *ray, uint32_t slot, uint32_t polygon)
{
    uint32_t count = 0;
    const tl_vec3 *corners = tl_nav_tile_corners(ray->navmesh->slots[slot].tile, polygon, &count);
    for (uint32_t i = 0; i < count; i++) {
        if (starts_beyond(ray, corners[i], corners[i + 1 < count ? i + 1 : 0])) {
            return false;
        }
    }
    return true;
}

// Whether the place where the walk begins lies on a way, ends included.
static bool begins_on(const surface_ray *ray, const tl_nav_way *way)
{
    double dx = (double)way->left.x - (double)way->right.x;
    double dz = (double)way->left.z - (double)way->right.z;
    double length_sq = dx * dx + dz * dz;
    double slack = ray->rounding * sqrt(length_sq);
    double along =
        dx * ((double)ray->from.x - (double)way->right.x) + dz * ((double)ray->from.z - (double)way->right.z);
    return along >= -slack && along <= length_sq + slack &&
           fabs(tl_nav_turn(way->right, way->left, ray->from)) <= slack;
}

// Polygons around one point: more than meet in any vertex that a bake makes. Beyond it a corner stops the ray.
enum { MAX_RAY_STARTS = 64 };

// The polygons around the place where a walk begins, each with the one that it was found from.
typedef struct polygons_around {
    uint32_t slot[MAX_RAY_STARTS], polygon[MAX_RAY_STARTS], found_from[MAX_RAY_STARTS];
    uint32_t count;
} polygons_around;

static void add_around(polygons_around *around, uint32_t slot, uint32_t polygon, uint32_t found_from)
{
    for (uint32_t i = 0; i < around->count; i++) {
        if (around->slot[i] == slot && around->polygon[i] == polygon) {
            return;
        }
    }
    if (around->count < MAX_RAY_STARTS) {
        around->slot[around->count] = slot;
        around->polygon[around->count] = polygon;
        around->found_from[around->count] = found_from;
        around->count++;
    }
}

// Moves the walk to one of the polygons around, through those in between.
static void move_around(const surface_ray *ray, const polygons_around *around, uint32_t to, ray_walk *walk,
                        const ray_trace *trace)
{
    uint32_t steps = 0;
    for (uint32_t i = to; i != 0; i = around->found_from[i]) {
        steps++;
    }
    ray_walk at = *walk;
    at.polygon_count += steps;
    for (uint32_t i = to; i != 0; i = around->found_from[i]) {
        at.slot = around->slot[i];
        at.polygon = around->polygon[i];
        record_polygon(ray, &at, trace);
        at.polygon_count--;
    }
    walk->slot = around->slot[to];
    walk->polygon = around->polygon[to];
    walk->polygon_count += steps;
}

// Moves to the polygon in which the walk begins: from a vertex or an edge there may be several to begin in. Breadth
// first through the polygons that share the point; where walls close every way, the walk stays.
static void find_start(surface_ray *ray, ray_walk *walk, const ray_trace *trace)
{
    polygons_around around;
    around.count = 0;
    add_around(&around, walk->slot, walk->polygon, 0);
    for (uint32_t i = 0; i < around.count; i++) {
        if (begins_in(ray, around.slot[i], around.polygon[i])) {
            move_around(ray, &around, i, walk, trace);
            return;
        }
        tl_nav_ways ways = tl_nav_ways_of(ray->navmesh, around.slot[i], around.polygon[i]);
        tl_nav_way way;
        while (tl_nav_ways_next(&ways, &way)) {
            if (begins_on(ray, &way) && tl_nav_passes(ray->filter, ray->navmesh->slots[way.slot].tile, way.polygon)) {
                add_around(&around, way.slot, way.polygon, i);
            }
        }
    }
}

// Whether the ray's end lies beyond the edge by more than rounding.
static bool ends_beyond(const surface_ray *ray, tl_vec3 a, tl_vec3 b)
{
    double turn = tl_nav_turn(a, b, ray->end);
    double ex = (double)b.x - (double)a.x;
    double ez = (double)b.z - (double)a.z;
    // The sum of both is no less than the length: mostly that decides.
    return turn > 0.0 &&
           (turn > ray->rounding * (fabs(ex) + fabs(ez)) || turn > ray->rounding * sqrt(ex * ex + ez * ez));
}

// Walks on from the polygon of `walk`, which is on record, to the ray's end or a wall.
static tl_result walk_one_way(surface_ray *ray, ray_walk *walk, const ray_trace *trace)
{
    find_start(ray, walk, trace);
    for (; ray->steps_left > 0; ray->steps_left--) {
        uint32_t count = 0;
        const tl_vec3 *corners = tl_nav_tile_corners(ray->navmesh->slots[walk->slot].tile, walk->polygon, &count);
        double t = 0.0;
        uint32_t edge = 0;
        bool crosses = find_exit(ray, corners, count, &edge, &t);
        if (crosses && !ends_beyond(ray, corners[edge], corners[edge + 1 < count ? edge + 1 : 0])) {
            walk->hit = false;
            walk->t = 1.0;
            return TL_OK;
        }
        t = t < 1.0 ? t : 1.0;
        walk->t = t > walk->t ? t : walk->t;
        if (!crosses || !step_over(ray, edge, &walk->slot, &walk->polygon)) {
            walk->hit = true;
            walk->edge = edge;
            return TL_OK;
        }
        walk->polygon_count++;
        record_polygon(ray, walk, trace);
    }
    return TL_ERR_ITERATIONS;
}

// The same with touched vertices left of the ray, then right of it; what came farther.
static tl_result walk_both_ways(surface_ray *ray, ray_walk *walk, const ray_trace *trace)
{
    const ray_walk begin = *walk;
    const ray_trace no_trace = { NULL, 0 };
    ray->touching_is_left = true;
    ray->touched = false;
    tl_result result = walk_one_way(ray, walk, trace);
    if (result != TL_OK || !walk->hit || !ray->touched) {
        return result;
    }
    ray_walk other = begin;
    ray->touching_is_left = false;
    if (walk_one_way(ray, &other, &no_trace) == TL_OK && other.t > walk->t) {
        *walk = begin;
        result = walk_one_way(ray, walk, trace);
    }
    return result;
}

// How far along the ray a point lies, 0 at the start, 1 at the end.
static double place_on(const surface_ray *ray, tl_vec3 point)
{
    double dx = (double)ray->end.x - (double)ray->start.x;
    double dz = (double)ray->end.z - (double)ray->start.z;
    double along = dx * ((double)point.x - (double)ray->start.x) + dz * ((double)point.z - (double)ray->start.z);
    return along / (dx * dx + dz * dz);
}

// Whether the wall that was hit begins or ends in a touched vertex farther along the ray than the last walk began; that
// is where the next one begins.
static bool touches_ahead(surface_ray *ray, const ray_walk *walk)
{
    uint32_t count = 0;
    const tl_vec3 *corners = tl_nav_tile_corners(ray->navmesh->slots[walk->slot].tile, walk->polygon, &count);
    double farthest = place_on(ray, ray->from);
    bool found = false;
    for (uint32_t k = 0; k < 2; k++) {
        tl_vec3 vertex = corners[(walk->edge + k) % count];
        if (fabs(tl_nav_turn(ray->start, ray->end, vertex)) <= ray->grazing && place_on(ray, vertex) > farthest) {
            farthest = place_on(ray, vertex);
            ray->from = vertex;
            found = true;
        }
    }
    return found && farthest < 1.0;
}

// ---------------------------------------------------------------------------------------------------------
// The common case: a ray that begins inside its polygon and touches no vertex. It runs on the rings, where a step is
// one look at the vertices between the edge of entry and that of exit. Its answers are those of the walk above.

// Whether the walk's begin lies inside a ring by more than rounding, and which edge the ray leaves it by.
static bool find_clean_exit(const surface_ray *ray, const tl_nav_ring *ring, uint32_t *edge_out)
{
    bool found = false;
    tl_vec3 a = tl_vec3_make(ring->points[0].x, 0.0f, ring->points[0].z);
    double side = tl_nav_turn(ray->start, ray->end, a);
    for (uint32_t i = 0; i < ring->count; i++) {
        const tl_vec3 *next = &ring->points[i + 1 < ring->count ? i + 1 : 0];
        tl_vec3 b = tl_vec3_make(next->x, 0.0f, next->z);
        double next_side = tl_nav_turn(ray->start, ray->end, b);
        double size = fabs((double)b.x - (double)a.x) + fabs((double)b.z - (double)a.z);
        if (fabs(next_side) <= ray->grazing || tl_nav_turn(a, b, ray->start) >= -ray->rounding * size) {
            return false;
        }
        if (side > 0.0 && next_side < 0.0) {
            *edge_out = i;
            found = true;
        }
        a = b;
        side = next_side;
    }
    return found;
}

// The edge that the ray leaves a ring by, from the edge of entry on; false when it touches a vertex on the way.
static bool find_next_exit(const surface_ray *ray, const tl_nav_ring *ring, uint32_t entry, uint32_t *edge_out)
{
    uint32_t i = entry + 1 < ring->count ? entry + 1 : 0; // where the edge of entry ends: right of the ray
    for (uint32_t k = 1; k < ring->count; k++) {
        uint32_t next = i + 1 < ring->count ? i + 1 : 0;
        double side = tl_nav_turn(ray->start, ray->end, tl_vec3_make(ring->points[next].x, 0.0f, ring->points[next].z));
        if (fabs(side) <= ray->grazing) {
            return false;
        }
        if (side < 0.0) {
            *edge_out = i;
            return next != entry + 1;
        }
        i = next;
    }
    return false;
}

// The polygon's own number of a ring's edge, which may be a piece of it.
static uint32_t edge_of_piece(const tl_nav_tile *tile, uint32_t polygon, const tl_vec3 *points, uint32_t piece)
{
    uint32_t count = 0;
    const tl_vec3 *corners = tl_nav_tile_corners(tile, polygon, &count);
    uint32_t edge = 0;
    for (uint32_t i = 1; i <= piece && edge + 1 < count; i++) {
        edge += points[i].x == corners[edge + 1].x && points[i].z == corners[edge + 1].z ? 1 : 0;
    }
    return edge;
}

// False where the ray is no such case; then `walk` is as it was.
static bool walk_clean(surface_ray *ray, ray_walk *walk, const ray_trace *trace)
{
    const bool all_pass = tl_nav_all_pass(ray->navmesh, ray->filter);
    ray_walk at = *walk;
    uint32_t edge = 0;
    tl_nav_ring ring = tl_nav_ring_at(ray->navmesh, at.slot, at.polygon);
    bool is_clean = find_clean_exit(ray, &ring, &edge);
    for (uint64_t steps = ray->steps_left; is_clean && steps > 0; steps--) {
        const tl_vec3 *next = &ring.points[edge + 1 < ring.count ? edge + 1 : 0];
        tl_vec3 a = tl_vec3_make(ring.points[edge].x, 0.0f, ring.points[edge].z);
        tl_vec3 b = tl_vec3_make(next->x, 0.0f, next->z);
        if (!ends_beyond(ray, a, b)) {
            at.t = 1.0;
            at.point = ray->end;
            at.has_point = tl_nav_side_of(a, b, ray->end) <= 0;
            *walk = at;
            return true;
        }
        if (ray->navmesh->slots[at.slot].rings.has_back) {
            return false;
        }
        bool is_way = tl_nav_ring_to(&ring, edge) != TL_NAV_RING_WALL;
        tl_nav_ring_place twin = { at.slot, at.polygon, 0 };
        if (is_way) {
            twin = tl_nav_ring_twin(ray->navmesh, at.slot, at.polygon, &ring, edge);
            is_way = all_pass || tl_nav_passes(ray->filter, ray->navmesh->slots[twin.slot].tile, twin.polygon);
        }
        if (!is_way) {
            double t = crossing_of_ray(ray, a, b);
            at.t = t < 1.0 ? t : 1.0;
            at.hit = true;
            at.has_point = true;
            at.point = tl_lerp(ray->start, ray->end, (float)at.t);
            if (tl_nav_side_of(a, b, at.point) > 0) {
                at.point = tl_nav_closest_on_edge(a, b, at.point);
            }
            at.edge = edge_of_piece(ray->navmesh->slots[at.slot].tile, at.polygon, ring.points, edge);
            *walk = at;
            return true;
        }
        at.slot = twin.slot;
        at.polygon = twin.polygon;
        at.polygon_count++;
        record_polygon(ray, &at, trace);
        ring = tl_nav_ring_at(ray->navmesh, at.slot, at.polygon);
        is_clean = find_next_exit(ray, &ring, twin.edge, &edge);
    }
    return false;
}

static tl_result walk_to_end(surface_ray *ray, ray_walk *walk, const ray_trace *trace)
{
    do {
        tl_result result = walk_both_ways(ray, walk, trace);
        if (result != TL_OK) {
            return result;
        }
    } while (walk->hit && touches_ahead(ray, walk));
    return TL_OK;
}

static double largest_coordinate_of(tl_vec3 a, tl_vec3 b)
{
    double largest = fabs((double)a.x);
    double others[3] = { fabs((double)a.z), fabs((double)b.x), fabs((double)b.z) };
    for (int i = 0; i < 3; i++) {
        largest = others[i] > largest ? others[i] : largest;
    }
    return largest;
}

// Towards the inside, which is left of the edge.
static tl_vec3 edge_normal(const tl_vec3 *corners, uint32_t count, uint32_t edge)
{
    tl_vec3 along = tl_sub(corners[edge + 1 < count ? edge + 1 : 0], corners[edge]);
    return tl_normalize(tl_vec3_make(along.z, 0.0f, -along.x));
}

static void describe(const surface_ray *ray, const ray_walk *end, tl_nav_ray_hit *hit_out)
{
    const tl_nav_tile *tile = ray->navmesh->slots[end->slot].tile;
    hit_out->hit = end->hit;
    hit_out->t = (float)end->t;
    hit_out->polygon = tl_nav_make_ref(ray->navmesh, end->slot, end->polygon);
    hit_out->polygon_count = end->polygon_count;
    tl_vec3 along = tl_lerp(ray->start, ray->end, (float)end->t);
    bool inside = false;
    hit_out->point =
        end->has_point ? end->point : tl_nav_clamp_to_polygon(tile, end->polygon, end->hit ? along : ray->end, &inside);
    hit_out->point.y = along.y;
    if (end->hit) {
        uint32_t count = 0;
        const tl_vec3 *corners = tl_nav_tile_corners(tile, end->polygon, &count);
        hit_out->edge = end->edge;
        hit_out->normal = edge_normal(corners, count, end->edge);
    }
}

static surface_ray make_ray(const tl_navmesh *navmesh, const tl_nav_filter *filter, tl_vec3 from, tl_vec3 end)
{
    double dx = (double)end.x - (double)from.x;
    double dz = (double)end.z - (double)from.z;
    double rounding = GRAZING_ERROR * largest_coordinate_of(from, end);
    // Each polygon once, in either way of touching, and again for each vertex that it turns around.
    uint64_t steps = 4 * navmesh->polygon_count + MAX_RAY_STARTS;
    surface_ray ray = { navmesh, filter, from, end, from, rounding, rounding * sqrt(dx * dx + dz * dz),
                        true,    false,  steps };
    return ray;
}

tl_result tl_navmesh_cast_ray(const tl_navmesh *navmesh, const tl_nav_filter *filter, const tl_nav_location *start,
                              tl_vec3 end, tl_nav_ref *polygons_out, uint32_t capacity, tl_nav_ray_hit *hit_out)
{
    uint32_t slot = 0;
    uint32_t polygon = 0;
    if (navmesh == NULL || start == NULL || hit_out == NULL || (polygons_out == NULL && capacity > 0) ||
        !tl_nav_filter_is_begun(filter)) {
        return TL_ERR_ARGUMENT;
    }
    memset(hit_out, 0, sizeof *hit_out);
    if (!tl_nav_is_finite(start->point) || !tl_nav_is_finite(end)) {
        return TL_ERR_NOT_FINITE;
    }
    if (!tl_nav_split_ref(navmesh, start->polygon, &slot, &polygon)) {
        return TL_ERR_STALE;
    }
    ray_walk walk;
    memset(&walk, 0, sizeof walk);
    walk.slot = slot;
    walk.polygon = polygon;
    walk.polygon_count = 1;
    const ray_trace trace = { polygons_out, capacity };
    surface_ray ray = make_ray(navmesh, filter, start->point, end);
    record_polygon(&ray, &walk, &trace);
    // A clean start is inside its polygon.
    if (!walk_clean(&ray, &walk, &trace)) {
        bool inside = false;
        ray = make_ray(navmesh, filter,
                       tl_nav_clamp_to_polygon(navmesh->slots[slot].tile, polygon, start->point, &inside), end);
        tl_result result = TL_OK;
        if (ray.start.x == end.x && ray.start.z == end.z) {
            walk.t = 1.0;
        } else {
            result = walk_to_end(&ray, &walk, &trace);
        }
        if (result != TL_OK) {
            return result;
        }
    }
    describe(&ray, &walk, hit_out);
    return walk.polygon_count <= capacity || capacity == 0 ? TL_OK : TL_INCOMPLETE;
}
