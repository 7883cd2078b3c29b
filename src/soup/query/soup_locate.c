// SPDX-License-Identifier: MIT
//
// Inside or outside of a closed surface: the winding number around the point, by ray casting.
//
// A ray from the point counts a crossing out through a front as 1 and one in as -1; for a closed surface the sum is the
// winding number, for any direction. Crossings are counted exactly (line_triangle.c), so the answer is exact. A second
// ray runs the opposite way: on a closed surface both sums are equal, so where they differ it is not closed, and the
// answer says so. Solid angles (Jacobson, Kavan, Sorkine-Hornung, Robust Inside-Outside Segmentation, 2013) would give
// a fraction for open surfaces, but cost a pass over all triangles or a far field, and arctangents, which differ
// between machines.
//
// The ray runs mainly along the axis in which the soup is thinnest: across a level it crosses a few floors, along it
// every house.

#include "math/predicates.h"
#include "soup/query/line_region.h"
#include "soup/ray/ray_job.h"
#include "soup/triangle/line_triangle.h"

typedef struct crossings {
    int32_t winding;
    uint32_t count;
} crossings;

typedef struct counter {
    const tl_soup *soup;
    tl_ray_job job;
    tl_vec3 origin, direction;
    crossings found;
} counter;

// Whether a point in a triangle's plane lies within it, in a projection in which the triangle has area.
static bool plane_point_is_inside(const tl_vec3 c[3], tl_vec3 p)
{
    for (int axis = 0; axis < 3; axis++) {
        float x[4], y[4];
        for (int k = 0; k < 4; k++) {
            tl_vec3 v = k < 3 ? c[k] : p;
            x[k] = axis == 0 ? v.y : axis == 1 ? v.z : v.x;
            y[k] = axis == 0 ? v.z : axis == 1 ? v.x : v.y;
        }
        int area = tl_orient2d(x[0], y[0], x[1], y[1], x[2], y[2]);
        if (area != 0) {
            return area * tl_orient2d(x[0], y[0], x[1], y[1], x[3], y[3]) >= 0 &&
                   area * tl_orient2d(x[1], y[1], x[2], y[2], x[3], y[3]) >= 0 &&
                   area * tl_orient2d(x[2], y[2], x[0], y[0], x[3], y[3]) >= 0;
        }
    }
    return false;
}

typedef struct surface_touch {
    tl_vec3 point;
    uint32_t triangle; // the lowest
} surface_touch;

static bool holds_point(const tl_walk_triangle *triangle, void *user)
{
    const surface_touch *t = user;
    return tl_aabb_contains(tl_walk_triangle_box(triangle), t->point) &&
           tl_orient3d(triangle->corners[0], triangle->corners[1], triangle->corners[2], t->point) == 0 &&
           plane_point_is_inside(triangle->corners, t->point);
}

static bool keep_lowest(const tl_walk_triangle *triangle, void *user)
{
    surface_touch *t = user;
    t->triangle = triangle->triangle < t->triangle ? triangle->triangle : t->triangle;
    return true;
}

static bool is_crossed(const tl_walk_triangle *triangle, void *user)
{
    counter *c = user;
    c->job.t = INFINITY;
    c->job.triangle = UINT32_MAX;
    return tl_ray_decide_triangle(&c->job, triangle->leaf->leaf, triangle->lane, tl_walk_id(triangle)) &&
           tl_moved_line_crosses(c->origin, c->direction, triangle->corners);
}

static bool count_crossing(const tl_walk_triangle *triangle, void *user)
{
    counter *c = user;
    (void)triangle;
    c->found.winding += c->job.back ? 1 : -1;
    c->found.count++;
    return true;
}

static crossings count_crossings(const tl_soup *soup, tl_vec3 point, tl_vec3 direction)
{
    counter c = { .soup = soup, .origin = point, .direction = direction };
    c.job.soup = soup;
    c.job.filter = NULL;
    c.job.is_segment = false;
    c.job.t = INFINITY;
    if (tl_ray_prepare(&c.job, point, direction)) {
        tl_ray ray = { point, direction, INFINITY };
        tl_line_region line;
        tl_line_region_make(&ray, &line);
        tl_region_memory memory;
        tl_region region = { .enter = tl_region_enter_line,
                             .region = &line,
                             .belongs = is_crossed,
                             .found = count_crossing,
                             .user = &c,
                             .memory = &memory };
        tl_region_walk(soup, &region);
    }
    return c.found;
}

// Oblique, so that it seldom lies in the plane of a wall or meets an edge parallel to an axis.
static tl_vec3 choose_direction(const tl_soup *soup)
{
    tl_vec3 size = tl_aabb_size(tl_soup_bounds(soup));
    if (size.y <= size.x && size.y <= size.z) {
        return tl_vec3_make(0.0546875f, 1.0f, 0.0859375f);
    }
    return size.x <= size.z ? tl_vec3_make(1.0f, 0.0859375f, 0.0546875f) : tl_vec3_make(0.0859375f, 0.0546875f, 1.0f);
}

tl_result tl_soup_locate(const tl_soup *soup, tl_vec3 point, tl_soup_location *location_out)
{
    if (location_out == NULL) {
        return TL_ERR_ARGUMENT;
    }
    memset(location_out, 0, sizeof *location_out);
    if (soup == NULL) {
        return TL_ERR_ARGUMENT;
    }
    if (!tl_is_finite(point)) {
        return TL_ERR_NOT_FINITE;
    }
    tl_soup_location place = { TL_SOUP_OUTSIDE, 0, TL_NO_TRIANGLE };
    surface_touch t = { point, TL_NO_TRIANGLE };
    tl_aabb at = { point, point };
    tl_region region = { .box = &at, .belongs = holds_point, .found = keep_lowest, .user = &t };
    tl_region_walk(soup, &region);
    if (t.triangle != TL_NO_TRIANGLE) {
        place.side = TL_SOUP_ON_SURFACE;
        place.triangle = t.triangle;
    } else if (tl_aabb_contains(tl_soup_bounds(soup), point)) {
        tl_vec3 direction = choose_direction(soup);
        crossings there = count_crossings(soup, point, direction),
                  back = count_crossings(soup, point, tl_neg(direction));
        if (there.count % 2 != back.count % 2) {
            return TL_ERR_NOT_CLOSED;
        }
        if (there.winding != back.winding) {
            return TL_ERR_WINDING;
        }
        place.winding = there.winding;
        place.side = there.winding != 0 ? TL_SOUP_INSIDE : TL_SOUP_OUTSIDE;
    }
    *location_out = place;
    return TL_OK;
}
