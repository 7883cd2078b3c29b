// SPDX-License-Identifier: MIT
//
// Detail heights: the floor of a polygon in any column that the polygon covers.
//
// A column that holds a floor of the polygon's region answers at once; a region has at most one floor a column. Else
// the polygon overhangs its region there, by the simplification of its outline: the nearest floor of the region is
// looked for ring by ring, and from it one walks over linked floors towards the column. So the height is always one
// that can be walked to from the region, never that of a floor above or below.
// Idea: Mononen, Recast (heights flooded from the region). Why it is faster: Recast copies and floods the whole
// bounding box of each polygon; here only columns that are sampled are looked at, one of some tens.

#include "nav_build/detail.h"

typedef struct column_range {
    uint32_t begin, end;
} column_range;

static column_range column_at(const tl_nav_compact *compact, int64_t x, int64_t z)
{
    size_t column = (size_t)z * compact->width + (size_t)x;
    return (column_range){ compact->first_span[column], compact->first_span[column + 1] };
}

static uint32_t floor_of_region(const tl_nav_compact *compact, uint32_t region, int64_t x, int64_t z)
{
    if (x < 0 || z < 0 || x >= (int64_t)compact->width || z >= (int64_t)compact->height) {
        return TL_NAV_NO_SPAN;
    }
    column_range range = column_at(compact, x, z);
    for (uint32_t i = range.begin; i < range.end; i++) {
        if (compact->region[i] == region) {
            return i;
        }
    }
    return TL_NAV_NO_SPAN;
}

typedef struct found_floor {
    uint32_t span;
    int64_t x, z;
    int64_t distance_sq;
} found_floor;

static void consider(const tl_detail_floors *floors, int64_t x, int64_t z, int64_t dx, int64_t dz, found_floor *best)
{
    int64_t distance_sq = dx * dx + dz * dz;
    if (distance_sq < best->distance_sq) {
        uint32_t span = floor_of_region(floors->compact, floors->region, x + dx, z + dz);
        if (span != TL_NAV_NO_SPAN) {
            *best = (found_floor){ span, x + dx, z + dz, distance_sq };
        }
    }
}

// The nearest column of the region; ties go to the lower z, then x.
static found_floor find_nearest(const tl_detail_floors *floors, int64_t x, int64_t z)
{
    found_floor best = { TL_NAV_NO_SPAN, 0, 0, INT64_MAX };
    // A ring at distance r holds nothing nearer than r.
    for (int64_t r = 1; r <= (int64_t)floors->reach && r * r < best.distance_sq; r++) {
        for (int64_t dx = -r; dx <= r; dx++) {
            consider(floors, x, z, dx, -r, &best);
        }
        for (int64_t dz = 1 - r; dz < r; dz++) {
            consider(floors, x, z, -r, dz, &best);
            consider(floors, x, z, r, dz, &best);
        }
        for (int64_t dx = -r; dx <= r; dx++) {
            consider(floors, x, z, dx, r, &best);
        }
    }
    return best;
}

// Walks over links towards a column, along one axis first, and along the other where a link is missing.
static void walk_towards(const tl_nav_compact *compact, found_floor *at, int64_t x, int64_t z, bool x_first)
{
    while (at->x != x || at->z != z) {
        int64_t dx = x - at->x, dz = z - at->z;
        uint32_t along_x = dx < 0 ? 0 : 2, along_z = dz < 0 ? 3 : 1;
        uint32_t first = (x_first && dx != 0) || dz == 0 ? along_x : along_z, direction = first;
        uint32_t next = tl_nav_beside(compact, at->span, direction);
        if (next == TL_NAV_NO_SPAN && dx != 0 && dz != 0) {
            direction = first == along_x ? along_z : along_x;
            next = tl_nav_beside(compact, at->span, direction);
        }
        if (next == TL_NAV_NO_SPAN) {
            break;
        }
        at->span = next;
        at->x += (direction == 2) - (direction == 0);
        at->z += (direction == 1) - (direction == 3);
    }
    at->distance_sq = (x - at->x) * (x - at->x) + (z - at->z) * (z - at->z);
}

// The floor nearest to the column of those that two walks reach.
static uint32_t walk_on(const tl_nav_compact *compact, found_floor from, int64_t x, int64_t z)
{
    int64_t dx = x - from.x, dz = z - from.z;
    bool x_first = (dx < 0 ? -dx : dx) >= (dz < 0 ? -dz : dz); // the longer way
    found_floor first = from, second = from;
    walk_towards(compact, &first, x, z, x_first);
    if (first.distance_sq > 0) {
        walk_towards(compact, &second, x, z, !x_first);
        first = second.distance_sq < first.distance_sq ? second : first;
    }
    return first.span;
}

int32_t tl_detail_floor_at(const tl_detail_floors *floors, int64_t x, int64_t z, int32_t fallback)
{
    const tl_nav_compact *compact = floors->compact;
    if (floors->region == 0) {
        return fallback;
    }
    uint32_t span = floor_of_region(compact, floors->region, x, z);
    if (span == TL_NAV_NO_SPAN) {
        found_floor nearest = find_nearest(floors, x, z);
        if (nearest.span == TL_NAV_NO_SPAN) {
            return fallback;
        }
        span = walk_on(compact, nearest, x, z);
    }
    return compact->floor[span];
}

static uint32_t region_near(const tl_nav_compact *compact, int64_t x, int64_t z, int32_t height)
{
    if (x < 0 || z < 0 || x >= (int64_t)compact->width || z >= (int64_t)compact->height) {
        return 0;
    }
    column_range range = column_at(compact, x, z);
    uint32_t region = 0;
    int32_t nearest = INT32_MAX;
    for (uint32_t i = range.begin; i < range.end; i++) {
        int32_t away = compact->floor[i] > height ? compact->floor[i] - height : height - compact->floor[i];
        bool interior = compact->region[i] != 0 && (compact->region[i] & TL_NAV_BORDER_REGION) == 0;
        if (interior && away < nearest) {
            nearest = away;
            region = compact->region[i];
        }
    }
    return region;
}

tl_detail_floors tl_detail_floors_make(const tl_nav_compact *compact, uint32_t region, uint32_t reach, int64_t x,
                                       int64_t z, int32_t height)
{
    tl_detail_floors floors = { compact, region, reach };
    for (int64_t r = 0; floors.region == TL_SEVERAL_REGIONS && r <= (int64_t)reach; r++) {
        for (int64_t dz = -r; floors.region == TL_SEVERAL_REGIONS && dz <= r; dz++) {
            int64_t step = dz == -r || dz == r ? 1 : 2 * r; // the ring only
            for (int64_t dx = -r; floors.region == TL_SEVERAL_REGIONS && dx <= r; dx += step) {
                floors.region = region_near(compact, x + dx, z + dz, height);
            }
        }
    }
    return floors;
}
