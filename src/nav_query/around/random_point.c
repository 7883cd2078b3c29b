// SPDX-License-Identifier: MIT
//
// A random point of the surface, uniform by area: a random unit of the total area selects a tile, a polygon of it, a
// triangle of that, and a point of that.
//
// Detour picks each tile with the same probability, however much floor is in it, and sums up its areas for every point.
// Here integer sums are kept (area_table.c), so the distribution is exactly uniform.

#include "nav_query/filter/nav_filter.h"
#include "nav_query/navmesh/area_table.h"
#include "nav_query/plane/point_of_random.h"
#include "nav_query/plane/surface.h"

#include <talus/nav_around.h>

// The polygon of a tile in which a square lies; `*at` becomes its number within the polygon.
static uint32_t find_polygon(const tl_nav_slot *slot, uint64_t *at)
{
    uint32_t low = 0;
    uint32_t high = slot->tile->polygon_count;
    while (high - low > 1) {
        uint32_t middle = low + (high - low) / 2;
        if (tl_nav_area_before(slot, middle) <= *at) {
            low = middle;
        } else {
            high = middle;
        }
    }
    *at -= tl_nav_area_before(slot, low);
    return low;
}

// Goes over all polygons that pass: up to the one in which square number `*at` lies, or, with UINT64_MAX, through all
// of them. Returns the sum of the areas before.
static uint64_t sum_passing(const tl_navmesh *navmesh, const tl_nav_filter *filter, uint64_t at, uint32_t *slot_out,
                            uint32_t *polygon_out)
{
    uint64_t sum = 0;
    for (uint32_t s = 0; s < navmesh->slot_count; s++) {
        const tl_nav_slot *slot = &navmesh->slots[s];
        for (uint32_t p = 0; slot->tile != NULL && p < slot->tile->polygon_count; p++) {
            if (tl_nav_passes(filter, slot->tile, p)) {
                uint64_t area = tl_nav_area_of(slot, p);
                if (at - sum < area) {
                    *slot_out = s;
                    *polygon_out = p;
                    return sum;
                }
                sum += area;
            }
        }
    }
    return sum;
}

static uint64_t doubled_triangle_area(const int32_t *a, const int32_t *b, const int32_t *c)
{
    int64_t abx = (int64_t)b[0] - a[0];
    int64_t abz = (int64_t)b[2] - a[2];
    int64_t acx = (int64_t)c[0] - a[0];
    int64_t acz = (int64_t)c[2] - a[2];
    int64_t area = acx * abz - acz * abx;
    return area > 0 ? (uint64_t)area : 0;
}

// The triangle of the polygon's fan in which a square lies; a point of it by the bits.
static tl_vec3 point_in_polygon(const tl_nav_tile *tile, uint32_t polygon, uint64_t at, uint64_t bits)
{
    uint32_t count = 0;
    const tl_vec3 *corners = tl_nav_tile_corners(tile, polygon, &count);
    const tl_nav_lattice_point first = tl_nav_tile_lattice(tile, polygon, 0);
    uint32_t i = 1;
    for (; i + 2 < count; i++) {
        const tl_nav_lattice_point a = tl_nav_tile_lattice(tile, polygon, i);
        const tl_nav_lattice_point b = tl_nav_tile_lattice(tile, polygon, i + 1);
        const uint64_t area = doubled_triangle_area(first.at, a.at, b.at);
        if (at < area) {
            break;
        }
        at -= area;
    }
    double second = 0.0;
    double third = 0.0;
    tl_nav_random_in_triangle(bits, &second, &third);
    const tl_vec3 a = corners[0];
    const tl_vec3 b = corners[i];
    const tl_vec3 c = corners[i + 1];
    return tl_vec3_make(
        (float)((double)a.x + second * ((double)b.x - (double)a.x) + third * ((double)c.x - (double)a.x)), a.y,
        (float)((double)a.z + second * ((double)b.z - (double)a.z) + third * ((double)c.z - (double)a.z)));
}

tl_result tl_navmesh_random_point(const tl_navmesh *navmesh, const tl_nav_filter *filter, const uint64_t random[2],
                                  tl_nav_location *location_out)
{
    tl_nav_location none = { TL_NAV_NO_REF, { 0.0f, 0.0f, 0.0f } };
    if (location_out == NULL) {
        return TL_ERR_ARGUMENT;
    }
    *location_out = none;
    if (navmesh == NULL || random == NULL || !tl_nav_filter_is_begun(filter)) {
        return TL_ERR_ARGUMENT;
    }
    uint32_t slot = 0;
    uint32_t polygon = 0;
    uint64_t at = 0;
    bool all_pass = tl_nav_all_pass(navmesh, filter);
    uint64_t sum =
        all_pass ? tl_nav_area_table_sum(navmesh) : sum_passing(navmesh, filter, UINT64_MAX, &slot, &polygon);
    if (sum == 0) {
        return TL_NOT_FOUND;
    }
    at = tl_nav_random_below(random[0], sum);
    if (all_pass) {
        slot = tl_nav_area_table_find(navmesh, &at);
        polygon = find_polygon(&navmesh->slots[slot], &at);
    } else {
        at -= sum_passing(navmesh, filter, at, &slot, &polygon);
    }
    const tl_nav_tile *tile = navmesh->slots[slot].tile;
    bool inside = false;
    location_out->polygon = tl_nav_make_ref(navmesh, slot, polygon);
    location_out->point =
        tl_nav_closest_on_surface(tile, polygon, point_in_polygon(tile, polygon, at, random[1]), &inside);
    return TL_OK;
}
