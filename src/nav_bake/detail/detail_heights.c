// SPDX-License-Identifier: MIT
//
// Detail heights: the floor of a polygon in any column that the polygon covers.
//
// A column that holds a floor of the polygon's region answers at once; a region has at most one floor a column. Else
// the polygon overhangs its region there, by the simplification of its outline: the nearest floor of the region is
// looked for ring by ring, and from it one walks over linked floors towards the column. So the height is always one
// that can be walked to from the region, never that of a floor above or below.
//
// But a region may climb a stair and come back over the floors beside it. Beyond the polygon's outline a column may so
// hold the region's floor of another storey. Where a column has several floors one therefore walks to it from the
// polygon's middle, straight, inside the polygon; what is reached is of its storey. The same where the walk from the
// nearest floor of the region ended before the column: that floor may be of another storey too.
// Idea: Mononen, Recast (heights flooded from the region). Why it is faster: Recast copies and floods the whole
// bounding box of each polygon; here only the sampled columns are read, one of some tens.

#include "nav_bake/detail/detail.h"

// Columns, squared: as far as an outline is moved from its region by the usual edge_max_error, rounded up.
#define BESIDE_SQ 8

typedef struct height_window {
    uint32_t begin, end;
} height_window;

static height_window column_at(const tl_nav_compact *compact, int64_t x, int64_t z)
{
    size_t column = (size_t)z * compact->width + (size_t)x;
    return (height_window){ compact->first_span[column], compact->first_span[column + 1] };
}

static uint32_t floor_of_region(const tl_nav_compact *compact, uint32_t region, int64_t x, int64_t z)
{
    if (x < 0 || z < 0 || x >= (int64_t)compact->width || z >= (int64_t)compact->height) {
        return TL_NAV_NO_SPAN;
    }
    height_window range = column_at(compact, x, z);
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

static void consider_floor(const tl_detail_floors *floors, int64_t x, int64_t z, int64_t dx, int64_t dz,
                           found_floor *best)
{
    int64_t distance_sq = dx * dx + dz * dz;
    if (distance_sq < best->distance_sq) {
        uint32_t span = floor_of_region(floors->compact, floors->region, x + dx, z + dz);
        if (span != TL_NAV_NO_SPAN) {
            *best = (found_floor){ span, x + dx, z + dz, distance_sq };
        }
    }
}

// The columns of row z + dz from x - r to x + r. Their floors are one stretch of memory: mostly none is of the region,
// and then no column is read.
static void consider_row(const tl_detail_floors *floors, int64_t x, int64_t z, int64_t r, int64_t dz, found_floor *best)
{
    const tl_nav_compact *compact = floors->compact;
    const int64_t row = z + dz, low = x - r > 0 ? x - r : 0, last = (int64_t)compact->width - 1;
    const int64_t high = x + r < last ? x + r : last;
    if (row < 0 || row >= (int64_t)compact->height || low > high) {
        return;
    }
    const uint32_t *first = compact->first_span + row * compact->width;
    uint32_t i = first[low];
    while (i < first[high + 1] && compact->region[i] != floors->region) {
        i++;
    }
    for (int64_t dx = low - x; i < first[high + 1] && dx <= high - x; dx++) {
        consider_floor(floors, x, z, dx, dz, best);
    }
}

// The nearest column of the region; ties go to the lower z, then x. Mostly it is one of the four beside: outlines run
// along columns.
static found_floor find_nearest(const tl_detail_floors *floors, int64_t x, int64_t z)
{
    found_floor best = { TL_NAV_NO_SPAN, 0, 0, INT64_MAX };
    static const int8_t beside[4][2] = { { 0, -1 }, { -1, 0 }, { 1, 0 }, { 0, 1 } };
    for (int k = 0; k < 4 && floors->reach > 0 && best.span == TL_NAV_NO_SPAN; k++) {
        consider_floor(floors, x, z, beside[k][0], beside[k][1], &best);
    }
    // A ring at distance r holds nothing nearer than r.
    for (int64_t r = 1; r <= (int64_t)floors->reach && r * r < best.distance_sq; r++) {
        consider_row(floors, x, z, r, -r, &best);
        for (int64_t dz = 1 - r; dz < r; dz++) {
            consider_floor(floors, x, z, -r, dz, &best);
            consider_floor(floors, x, z, r, dz, &best);
        }
        consider_row(floors, x, z, r, r, &best);
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
        uint32_t next = tl_nav_compact_neighbour(compact, at->span, direction);
        if (next == TL_NAV_NO_SPAN && dx != 0 && dz != 0) {
            direction = first == along_x ? along_z : along_x;
            next = tl_nav_compact_neighbour(compact, at->span, direction);
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
static uint32_t walk_to_column(const tl_nav_compact *compact, found_floor from, int64_t x, int64_t z)
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

// Walks over links straight towards a column, as a line is drawn, around where a link is missing.
static void walk_straight(const tl_nav_compact *compact, found_floor *at, int64_t x, int64_t z)
{
    const uint32_t toward_x = x > at->x ? 2 : 0, toward_z = z > at->z ? 1 : 3;
    int64_t left_x = x > at->x ? x - at->x : at->x - x, left_z = z > at->z ? z - at->z : at->z - z;
    const int64_t length_x = left_x, length_z = left_z;
    while (left_x > 0 || left_z > 0) {
        // The axis along which more of its own way is left; the other one when there is no link.
        bool along_x = left_z == 0 || (left_x != 0 && left_x * length_z >= left_z * length_x);
        uint32_t next = tl_nav_compact_neighbour(compact, at->span, along_x ? toward_x : toward_z);
        if (next == TL_NAV_NO_SPAN && left_x > 0 && left_z > 0) {
            along_x = !along_x;
            next = tl_nav_compact_neighbour(compact, at->span, along_x ? toward_x : toward_z);
        }
        if (next == TL_NAV_NO_SPAN) {
            break;
        }
        at->span = next;
        left_x -= along_x;
        left_z -= !along_x;
    }
    at->x = toward_x == 2 ? x - left_x : x + left_x;
    at->z = toward_z == 1 ? z - left_z : z + left_z;
    at->distance_sq = left_x * left_x + left_z * left_z;
}

// Whether a column holds this floor and no other.
static bool is_only_floor(const tl_nav_compact *compact, int64_t x, int64_t z, uint32_t span)
{
    if (x < 0 || z < 0 || x >= (int64_t)compact->width || z >= (int64_t)compact->height) {
        return false;
    }
    const height_window range = column_at(compact, x, z);
    return range.end - range.begin == 1 && range.begin == span;
}

// Whether one walks from a floor straight to the polygon's middle.
static bool leads_to_middle(const tl_detail_floors *floors, uint32_t span, int64_t x, int64_t z)
{
    found_floor at = { span, x, z, 0 };
    walk_straight(floors->compact, &at, floors->anchor_x, floors->anchor_z);
    return at.span == floors->anchor;
}

// The floor to which one walks from the polygon's middle. Where something is in the way just before the column: the
// floor before it, or the other one that was found, whichever is nearer to the height that is expected.
static uint32_t walk_from_middle(const tl_detail_floors *floors, int64_t x, int64_t z, uint32_t other, int32_t expected)
{
    const uint16_t *floor = floors->compact->floor;
    found_floor walked = { floors->anchor, floors->anchor_x, floors->anchor_z, 0 };
    walk_straight(floors->compact, &walked, x, z);
    const int32_t off_walked = (int32_t)floor[walked.span] - expected, off_other = (int32_t)floor[other] - expected;
    const bool nearer = (off_walked < 0 ? -off_walked : off_walked) < (off_other < 0 ? -off_other : off_other);
    return walked.distance_sq == 0 || (walked.distance_sq <= BESIDE_SQ && nearer) ? walked.span : other;
}

int32_t tl_detail_floor_at(const tl_detail_floors *floors, int64_t x, int64_t z, bool inner, int32_t expected)
{
    const tl_nav_compact *compact = floors->compact;
    if (floors->region == 0) {
        return expected;
    }
    uint32_t span = floor_of_region(compact, floors->region, x, z);
    const bool own = span != TL_NAV_NO_SPAN;
    if (!own) {
        found_floor nearest = find_nearest(floors, x, z);
        if (nearest.span == TL_NAV_NO_SPAN) {
            return expected;
        }
        span = walk_to_column(compact, nearest, x, z);
    }
    const bool sure =
        (own && inner && !floors->several) || is_only_floor(compact, x, z, span) || floors->anchor == TL_NAV_NO_SPAN;
    if (!sure && !(own && leads_to_middle(floors, span, x, z))) {
        span = walk_from_middle(floors, x, z, span, expected);
    }
    return compact->floor[span];
}

static uint32_t region_near(const tl_nav_compact *compact, int64_t x, int64_t z, int32_t height)
{
    if (x < 0 || z < 0 || x >= (int64_t)compact->width || z >= (int64_t)compact->height) {
        return 0;
    }
    height_window range = column_at(compact, x, z);
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
    tl_detail_floors floors = { compact, region, reach, region == TL_SEVERAL_REGIONS, TL_NAV_NO_SPAN, x, z };
    for (int64_t r = 0; floors.region == TL_SEVERAL_REGIONS && r <= (int64_t)reach; r++) {
        for (int64_t dz = -r; floors.region == TL_SEVERAL_REGIONS && dz <= r; dz++) {
            int64_t step = dz == -r || dz == r ? 1 : 2 * r; // the ring only
            for (int64_t dx = -r; floors.region == TL_SEVERAL_REGIONS && dx <= r; dx += step) {
                floors.region = region_near(compact, x + dx, z + dz, height);
            }
        }
    }
    floors.anchor = floor_of_region(compact, floors.region, x, z);
    if (floors.anchor == TL_NAV_NO_SPAN) {
        const found_floor nearest = find_nearest(&floors, x, z);
        floors.anchor = nearest.span;
        floors.anchor_x = nearest.x;
        floors.anchor_z = nearest.z;
    }
    return floors;
}
