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

#include <stdlib.h>

// Columns, squared: as far as an outline is moved from its region by the usual edge_max_error, rounded up.
#define BESIDE_SQ 8

typedef struct height_window {
    uint32_t begin, end;
} height_window;

// A column's floors; none beyond the field.
static height_window column_at(const tl_nav_compact *compact, int64_t x, int64_t z)
{
    if (x < 0 || z < 0 || x >= (int64_t)compact->width || z >= (int64_t)compact->height) {
        return (height_window){ 0, 0 };
    }
    const size_t column = (size_t)z * compact->width + (size_t)x;
    return (height_window){ compact->first_span[column], compact->first_span[column + 1] };
}

static uint32_t floor_of_region(const tl_nav_compact *compact, uint32_t region, int64_t x, int64_t z)
{
    const height_window range = column_at(compact, x, z);
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

// ---------------------------------------------------------------------------------------------------------
// Polygons of several regions.

typedef struct polygon_stand {
    const tl_nav_compact *compact;
    const tl_polygon_mesh *polygons;
    uint32_t polygon;
} polygon_stand;

// Whether a column's centre lies in the polygon or on its edges. Twice the lattice, so that centres are whole.
static bool covers_column(const polygon_stand *s, int64_t x, int64_t z)
{
    const uint32_t begin = s->polygons->first[s->polygon], end = s->polygons->first[s->polygon + 1];
    for (uint32_t k = begin; k < end; k++) {
        const int32_t *a = s->polygons->vertices + 3 * (size_t)s->polygons->indices[k];
        const int32_t *b = s->polygons->vertices + 3 * (size_t)s->polygons->indices[k + 1 < end ? k + 1 : begin];
        const int64_t dx = (int64_t)b[0] - a[0], dz = (int64_t)b[2] - a[2];
        if ((2 * x + 1 - 2 * (int64_t)a[0]) * dz - dx * (2 * z + 1 - 2 * (int64_t)a[2]) < 0) {
            return false;
        }
    }
    return true;
}

typedef struct region_choice {
    uint32_t region; // 0: none yet
    int32_t away;    // voxels from the height looked for
} region_choice;

static bool is_better_region(const tl_nav_compact *compact, uint32_t span, int32_t height, const region_choice *best)
{
    const uint32_t region = compact->region[span];
    const bool interior = region != 0 && (region & TL_NAV_BORDER_REGION) == 0;
    return interior && (best->region == 0 || abs((int32_t)compact->floor[span] - height) < best->away);
}

static void choose_region_of(const tl_nav_compact *compact, uint32_t span, int32_t height, region_choice *best)
{
    *best = (region_choice){ compact->region[span], abs((int32_t)compact->floor[span] - height) };
}

// The region on which the polygon stands at a corner: that of the floor nearest in height, in the columns around the
// corner that the polygon covers, or, at the tip of a sliver, in all four. 0: there is no floor.
static uint32_t region_at_corner(const polygon_stand *s, const int32_t *corner)
{
    region_choice covered = { 0, 0 }, beside = { 0, 0 };
    for (int around = 0; around < 4; around++) {
        const int64_t x = (int64_t)corner[0] - (around & 1), z = (int64_t)corner[2] - (around >> 1);
        const int64_t border = s->compact->border_size;
        region_choice *best = covers_column(s, x, z) ? &covered : &beside;
        const height_window range = column_at(s->compact, x + border, z + border);
        for (uint32_t i = range.begin; i < range.end; i++) {
            if (is_better_region(s->compact, i, corner[1], best)) {
                choose_region_of(s->compact, i, corner[1], best);
            }
        }
    }
    return covered.region != 0 ? covered.region : beside.region;
}

static bool stands_on_region(const polygon_stand *s, uint32_t region)
{
    for (uint32_t k = s->polygons->first[s->polygon]; k < s->polygons->first[s->polygon + 1]; k++) {
        if (region_at_corner(s, s->polygons->vertices + 3 * (size_t)s->polygons->indices[k]) == region) {
            return true;
        }
    }
    return false;
}

// Considers a column's floors. `refused`: the region that was last refused; columns side by side are mostly of one.
static void consider_regions(const polygon_stand *s, height_window range, int32_t height, uint32_t *refused,
                             region_choice *best)
{
    for (uint32_t i = range.begin; i < range.end; i++) {
        const uint32_t region = s->compact->region[i];
        if (region == *refused || !is_better_region(s->compact, i, height, best)) {
            continue;
        }
        if (stands_on_region(s, region)) {
            choose_region_of(s->compact, i, height, best);
        } else {
            *refused = region;
        }
    }
}

uint32_t tl_detail_choose_region(const tl_nav_compact *compact, const tl_polygon_mesh *polygons, uint32_t polygon,
                                 uint32_t reach, int64_t x, int64_t z, int32_t height)
{
    const polygon_stand s = { compact, polygons, polygon };
    region_choice best = { 0, 0 };
    uint32_t refused = 0;
    for (int64_t r = 0; best.region == 0 && r <= (int64_t)reach; r++) {
        for (int64_t dz = -r; best.region == 0 && dz <= r; dz++) {
            const int64_t step = dz == -r || dz == r ? 1 : 2 * r; // the ring only
            for (int64_t dx = -r; best.region == 0 && dx <= r; dx += step) {
                consider_regions(&s, column_at(compact, x + dx, z + dz), height, &refused, &best);
            }
        }
    }
    return best.region;
}

// ---------------------------------------------------------------------------------------------------------

tl_detail_floors tl_detail_floors_make(const tl_nav_compact *compact, uint32_t region, bool several, uint32_t reach,
                                       int64_t x, int64_t z)
{
    tl_detail_floors floors = { compact, region, reach, several, TL_NAV_NO_SPAN, x, z };
    floors.anchor = floor_of_region(compact, region, x, z);
    if (floors.anchor == TL_NAV_NO_SPAN) {
        const found_floor nearest = find_nearest(&floors, x, z);
        floors.anchor = nearest.span;
        floors.anchor_x = nearest.x;
        floors.anchor_z = nearest.z;
    }
    return floors;
}
