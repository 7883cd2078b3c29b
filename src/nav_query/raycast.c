// SPDX-License-Identifier: MIT
//
// A ray along the surface: walk from polygon to polygon through the edge by which the ray leaves.
//
// Which edge that is is not read off intersection parameters, whose rounding differs from polygon to polygon, but off
// one label a vertex: left or right of the ray. The ray leaves by the edge that runs from a right vertex to a left one.
// A vertex has the same label in all polygons around it, so the walk cannot lose its way or turn in circles at a
// corner. A vertex within rounding of the ray counts as left, or, when that ends at a wall, as right in a second walk:
// so a ray that only touches a corner or runs along a wall passes.
// Sources: for the walk, Guibas and Stolfi 1985; for the labels, Edelsbrunner and Muecke, Simulation of Simplicity,
// 1990.

#include "filter.h"
#include "navmesh.h"
#include "side.h"
#include "surface.h"

#include <string.h>

typedef struct surface_ray {
    const tl_navmesh *navmesh;
    const tl_nav_filter *filter;
    tl_vec3 start, end;
    double grazing;        // doubled area: a vertex nearer to the ray's line than rounding
    bool touching_is_left; // the label of such a vertex
    bool touched;          // there was one
} surface_ray;

typedef struct walk_end {
    bool hit;
    double t;
    uint32_t slot, polygon, edge;
    uint32_t polygon_count;
} walk_end;

// Distance in the plane, as a share of the largest coordinate, within which a vertex may lie on the ray: its own and
// the ray's two points' coordinates are each rounded to float, on both axes.
#define GRAZING_ERROR ((double)TL_FLOAT_GAMMA(6))

static bool is_left(surface_ray *ray, tl_vec3 vertex)
{
    double turn = tl_nav_turn(ray->start, ray->end, vertex);
    if (fabs(turn) <= ray->grazing) {
        ray->touched = true;
        return ray->touching_is_left;
    }
    return turn < 0.0;
}

// Where on the ray the line through a and b is crossed, >= 0.
static double crossing(const surface_ray *ray, tl_vec3 a, tl_vec3 b)
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
    bool left = is_left(ray, corners[0]);
    for (uint32_t i = 0; i < count; i++) {
        tl_vec3 a = corners[i];
        tl_vec3 b = corners[i + 1 < count ? i + 1 : 0];
        bool next_left = is_left(ray, b);
        if (!left && next_left) {
            double t = crossing(ray, a, b);
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

// Steps over an edge; false at a wall, at a gap in a tile's seam, and where the filter refuses the polygon behind.
static bool step(surface_ray *ray, uint32_t edge, uint32_t *slot, uint32_t *polygon)
{
    const tl_nav_slot *from = &ray->navmesh->slots[*slot];
    uint32_t link = tl_nav_tile_links(from->tile, *polygon)[edge];
    uint32_t to_slot = *slot;
    uint32_t to_polygon = link;
    if (link == TL_NAV_LINK_WALL) {
        return false;
    }
    if ((link & TL_NAV_LINK_PORTAL) != 0) {
        const tl_nav_seam_link *seam = NULL;
        const tl_nav_seam_link *end = NULL;
        uint64_t key = 0;
        tl_nav_seam_range(from, link & ~TL_NAV_LINK_PORTAL, &seam, &end, &key);
        while (seam != end && (is_left(ray, seam->right) || !is_left(ray, seam->left))) {
            seam++;
        }
        if (seam == end) {
            return false;
        }
        to_slot = seam->slot;
        to_polygon = seam->polygon;
    }
    if (!tl_nav_passes(ray->filter, ray->navmesh->slots[to_slot].tile, to_polygon)) {
        return false;
    }
    *slot = to_slot;
    *polygon = to_polygon;
    return true;
}

static tl_result walk(surface_ray *ray, uint32_t slot, uint32_t polygon, tl_nav_ref *polygons_out, uint32_t capacity,
                      walk_end *end_out)
{
    double t = 0.0;
    // A line enters a convex polygon once at most.
    for (uint64_t steps = 0; steps < ray->navmesh->polygon_count; steps++) {
        if (steps < capacity) {
            polygons_out[steps] = tl_nav_make_ref(ray->navmesh, slot, polygon);
        }
        walk_end end = { false, 1.0, slot, polygon, 0, (uint32_t)steps + 1 };
        *end_out = end;
        uint32_t count = 0;
        const tl_vec3 *corners = tl_nav_tile_corners(ray->navmesh->slots[slot].tile, polygon, &count);
        double exit_t = 0.0;
        bool crosses = find_exit(ray, corners, count, &end_out->edge, &exit_t);
        t = exit_t > t ? exit_t : t;
        if (t >= 1.0) {
            return TL_OK;
        }
        if (!crosses || !step(ray, end_out->edge, &slot, &polygon)) {
            end_out->hit = true;
            end_out->t = t;
            return TL_OK;
        }
    }
    return TL_ERR_ITERATIONS;
}

static double largest_coordinate(tl_vec3 a, tl_vec3 b)
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

static void describe(const surface_ray *ray, const walk_end *end, tl_nav_ray_hit *hit_out)
{
    const tl_nav_tile *tile = ray->navmesh->slots[end->slot].tile;
    hit_out->hit = end->hit;
    hit_out->t = (float)end->t;
    hit_out->polygon = tl_nav_make_ref(ray->navmesh, end->slot, end->polygon);
    hit_out->polygon_count = end->polygon_count;
    tl_vec3 point = end->hit ? tl_lerp(ray->start, ray->end, (float)end->t) : ray->end;
    bool inside = false;
    hit_out->point = tl_nav_closest_on_surface(tile, end->polygon, point, &inside);
    if (end->hit) {
        uint32_t count = 0;
        const tl_vec3 *corners = tl_nav_tile_corners(tile, end->polygon, &count);
        hit_out->edge = end->edge;
        hit_out->normal = edge_normal(corners, count, end->edge);
    }
}

tl_result tl_navmesh_cast_ray(const tl_navmesh *navmesh, const tl_nav_filter *filter, const tl_nav_location *start,
                              tl_vec3 end, tl_nav_ref *polygons_out, uint32_t capacity, tl_nav_ray_hit *hit_out)
{
    uint32_t slot = 0;
    uint32_t polygon = 0;
    memset(hit_out, 0, sizeof *hit_out);
    if (!tl_nav_is_finite(start->point) || !tl_nav_is_finite(end)) {
        return TL_ERR_NOT_FINITE;
    }
    if (!tl_nav_split_ref(navmesh, start->polygon, &slot, &polygon)) {
        return TL_ERR_NOT_FOUND;
    }
    bool inside = false;
    tl_vec3 from = tl_nav_clamp_to_polygon(navmesh->slots[slot].tile, polygon, start->point, &inside);
    double dx = (double)end.x - (double)from.x;
    double dz = (double)end.z - (double)from.z;
    double grazing = GRAZING_ERROR * largest_coordinate(from, end) * sqrt(dx * dx + dz * dz);
    surface_ray ray = { navmesh, filter, from, end, grazing, true, false };
    if (dx == 0.0 && dz == 0.0) {
        walk_end stay = { false, 1.0, slot, polygon, 0, 1 };
        if (capacity > 0) {
            polygons_out[0] = start->polygon;
        }
        describe(&ray, &stay, hit_out);
        return capacity > 0 || polygons_out == NULL ? TL_OK : TL_ERR_CAPACITY;
    }
    walk_end first;
    tl_result result = walk(&ray, slot, polygon, polygons_out, capacity, &first);
    if (result == TL_OK && first.hit && ray.touched) {
        walk_end second;
        ray.touching_is_left = false;
        tl_result again = walk(&ray, slot, polygon, NULL, 0, &second);
        if (again == TL_OK && second.t > first.t) {
            result = walk(&ray, slot, polygon, polygons_out, capacity, &first);
        }
    }
    if (result != TL_OK) {
        return result;
    }
    describe(&ray, &first, hit_out);
    return first.polygon_count <= capacity || polygons_out == NULL ? TL_OK : TL_ERR_CAPACITY;
}
