// SPDX-License-Identifier: MIT
//
// Volumes give the floors inside them an area, or cut holes.
// Source: Mikko Mononen, Recast (rcMarkBoxArea, rcMarkConvexPolyArea, rcMarkCylinderArea); the crossing test for points
// in polygons: W. Randolph Franklin, PNPOLY.
//
// A column is tested at its centre, computed in the level's lattice, so that two tiles agree on the columns they share.

#include "base/assert.h"
#include "math/column_range.h"

#include <talus/nav_bake.h>

#include <math.h>

// The part of the field that a volume may touch. Column centres and heights in lattice units.
typedef struct mark_window {
    uint32_t first_x, end_x, first_z, end_z; ///< columns; none when end <= first
    double low, high;                        ///< floor heights, voxels, both included
} mark_window;

// Columns [*first, *end) whose centres lie in [min, max], metres.
static void centers_within(const tl_column_axis *axis, float min, float max, uint32_t *first, uint32_t *end)
{
    const double low = ceil(tl_column_of_center(axis, min)), high = floor(tl_column_of_center(axis, max)) + 1.0;
    tl_clamp_columns(axis, low, high, first, end);
}

static mark_window window_of(const tl_nav_compact *compact, tl_aabb box)
{
    const tl_nav_lattice *lattice = &compact->lattice;
    mark_window window;
    const tl_column_axis x = { lattice->origin.x, compact->cell_size, lattice->first_x, compact->width };
    const tl_column_axis z = { lattice->origin.z, compact->cell_size, lattice->first_z, compact->height };
    centers_within(&x, box.min.x, box.max.x, &window.first_x, &window.end_x);
    centers_within(&z, box.min.z, box.max.z, &window.first_z, &window.end_z);
    window.low = ((double)box.min.y - (double)lattice->origin.y) / (double)compact->cell_height;
    window.high = ((double)box.max.y - (double)lattice->origin.y) / (double)compact->cell_height;
    return window;
}

static double center_x(const tl_nav_compact *compact, uint32_t x)
{
    const tl_nav_lattice *lattice = &compact->lattice;
    return (double)lattice->origin.x + ((double)lattice->first_x + (double)x + 0.5) * (double)compact->cell_size;
}

static double center_z(const tl_nav_compact *compact, uint32_t z)
{
    const tl_nav_lattice *lattice = &compact->lattice;
    return (double)lattice->origin.z + ((double)lattice->first_z + (double)z + 0.5) * (double)compact->cell_size;
}

static void mark_column_area(tl_nav_compact *compact, uint32_t x, uint32_t z, const mark_window *window, uint8_t area)
{
    const uint32_t column = z * compact->width + x;
    for (uint32_t i = compact->first_span[column]; i < compact->first_span[column + 1]; i++) {
        double floor_height = (double)compact->floor[i];
        if (compact->area[i] != TL_NAV_NULL_AREA && floor_height >= window->low && floor_height <= window->high) {
            compact->area[i] = area;
        }
    }
}

void tl_nav_mark_box_area(tl_nav_compact *compact, tl_aabb box, uint8_t area)
{
    TL_ASSERT(compact != NULL);
    const mark_window window = window_of(compact, box);
    for (uint32_t z = window.first_z; z < window.end_z; z++) {
        for (uint32_t x = window.first_x; x < window.end_x; x++) {
            mark_column_area(compact, x, z, &window, area);
        }
    }
}

// Counts the edges that a ray from the point along +x crosses. An edge has its lower end and not its upper one, so
// polygons that share an edge or corner never both hold a point.
static bool polygon_holds(const tl_vec3 *points, uint32_t count, double x, double z)
{
    bool inside = false;
    for (uint32_t i = 0, before = count - 1; i < count; before = i++) {
        double ax = (double)points[before].x, az = (double)points[before].z;
        double bx = (double)points[i].x, bz = (double)points[i].z;
        if ((az > z) != (bz > z) && x < (bx - ax) * (z - az) / (bz - az) + ax) {
            inside = !inside;
        }
    }
    return inside;
}

void tl_nav_mark_polygon_area(tl_nav_compact *compact, const tl_vec3 *points, uint32_t count, float min_y, float max_y,
                              uint8_t area)
{
    TL_ASSERT(compact != NULL && (points != NULL || count == 0));
    if (count < 3) {
        return;
    }
    tl_aabb box = tl_aabb_empty();
    for (uint32_t i = 0; i < count; i++) {
        box = tl_aabb_add_point(box, points[i]);
    }
    box.min.y = min_y;
    box.max.y = max_y;
    const mark_window window = window_of(compact, box);
    for (uint32_t z = window.first_z; z < window.end_z; z++) {
        for (uint32_t x = window.first_x; x < window.end_x; x++) {
            if (polygon_holds(points, count, center_x(compact, x), center_z(compact, z))) {
                mark_column_area(compact, x, z, &window, area);
            }
        }
    }
}

void tl_nav_mark_cylinder_area(tl_nav_compact *compact, tl_vec3 base, float radius, float height, uint8_t area)
{
    TL_ASSERT(compact != NULL);
    if (!(radius > 0.0f && height >= 0.0f)) {
        return;
    }
    tl_aabb box = { { base.x - radius, base.y, base.z - radius },
                    { base.x + radius, base.y + height, base.z + radius } };
    const mark_window window = window_of(compact, box);
    const double radius_sq = (double)radius * (double)radius;
    for (uint32_t z = window.first_z; z < window.end_z; z++) {
        double dz = center_z(compact, z) - (double)base.z;
        for (uint32_t x = window.first_x; x < window.end_x; x++) {
            double dx = center_x(compact, x) - (double)base.x;
            if (dx * dx + dz * dz < radius_sq) {
                mark_column_area(compact, x, z, &window, area);
            }
        }
    }
}

void tl_nav_mark_volume_area(tl_nav_compact *compact, const tl_nav_volume *volume)
{
    TL_ASSERT(compact != NULL && volume != NULL);
    switch (volume->kind) {
    case TL_NAV_VOLUME_BOX:
        tl_nav_mark_box_area(compact, volume->box, volume->area);
        break;
    case TL_NAV_VOLUME_POLYGON:
        tl_nav_mark_polygon_area(compact, volume->points, volume->point_count, volume->box.min.y, volume->box.max.y,
                                 volume->area);
        break;
    case TL_NAV_VOLUME_CYLINDER:
        tl_nav_mark_cylinder_area(compact, volume->base, volume->radius, volume->height, volume->area);
        break;
    }
}
