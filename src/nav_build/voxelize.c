// SPDX-License-Identifier: MIT
//
// Conservative voxelization of a triangle by walking its edges.
//
// The classic way clips a polygon to each row and then to each cell. Here each row is entered with the two points where
// the triangle's outline crosses the row's line; the slice of the triangle between two lines has at most five edges,
// and the heights that it takes over a cell are those of its outline over that cell. So each edge is walked once along
// its row, widening the low and high of the cells it passes: no clipping, no copies of polygons, and a loop without
// branches.
//
// A column is covered when the triangle's projection overlaps the open cell; a triangle that projects to a line, when
// the line runs through the cell, where a line along a border belongs to the higher cell. The heights are those of the
// triangle over the closed cell; a span reaches from the floor of the lowest to the ceiling of the highest, and is at
// least one voxel tall.
//
// Numbers. All is done in double. x and z are rounded to 2^-10 of a cell, heights to 2^-10 of a voxel before floor and
// ceiling: the noise of decimals and of interpolation is far below that, so a floor at exactly five voxels and a wall
// at exactly three cells are what they are meant to be, and the result is that of a triangle displaced by less than
// 2^-10 of a cell. An edge is walked in an order that depends on its ends alone, so two triangles that share an edge
// agree on it.

#include "nav_build/voxelize.h"

#include "base/assert.h"

#include <math.h>

enum { SUBDIVISION_BITS = 10, SUBDIVISIONS = 1 << SUBDIVISION_BITS };

/// 1.5 * 2^(52 - 10): to add and subtract it rounds a double to a multiple of 2^-10, ties to even, when it is below
/// 2^41 in size. Larger values keep their own, coarser ulp: such points are far outside any field.
static const double ROUNDER = 6755399441055744.0 / SUBDIVISIONS;

static double round_to_subdivision(double value)
{
    return (value + ROUNDER) - ROUNDER;
}

tl_lattice_map tl_lattice_map_make(const tl_nav_lattice *lattice, float cell_size, float cell_height)
{
    tl_lattice_map map = { (double)lattice->origin.x, (double)lattice->origin.y, (double)lattice->origin.z,
                           1.0 / (double)cell_size,   1.0 / (double)cell_height, (double)lattice->first_x,
                           (double)lattice->first_z };
    return map;
}

tl_lattice_point tl_lattice_map_point(const tl_lattice_map *map, tl_vec3 point)
{
    // Rounded in the level's lattice, then moved by whole columns: every tile gets the same point.
    tl_lattice_point mapped = {
        round_to_subdivision(((double)point.x - map->origin_x) * map->per_cell) - map->first_x,
        ((double)point.y - map->origin_y) * map->per_height,
        round_to_subdivision(((double)point.z - map->origin_z) * map->per_cell) - map->first_z,
    };
    return mapped;
}

// ---- Small helpers -----------------------------------------------------------------------------------------

static double min_of(double a, double b)
{
    return a < b ? a : b;
}

static double max_of(double a, double b)
{
    return a > b ? a : b;
}

// The cells that [min, max] overlaps, cut to [low, high]; none when *last_out < *first_out.
static void cell_range(double min, double max, int64_t low, int64_t high, int64_t *first_out, int64_t *last_out)
{
    // Cut before the conversion, to what it can hold, one cell wider than the range so that outside stays outside.
    double bounded_min = max_of(min, (double)low - 1.0), bounded_max = min_of(max, (double)high + 2.0);
    bounded_min = min_of(bounded_min, (double)high + 2.0);
    bounded_max = max_of(bounded_max, (double)low - 1.0);
    int64_t first = (int64_t)bounded_min, last = (int64_t)bounded_max;
    first -= (double)first > bounded_min; // floor
    last -= (double)last > bounded_max;
    if (min < max && (double)last == bounded_max) {
        last--; // the next cell is only touched
    }
    *first_out = first > low ? first : low;
    *last_out = last < high ? last : high;
}

// Of two points of one edge, the one that it is walked from: the same for both triangles of the edge.
static bool comes_first(const tl_lattice_point *a, const tl_lattice_point *b)
{
    if (a->z != b->z) {
        return a->z < b->z;
    }
    return a->x != b->x ? a->x < b->x : a->y < b->y;
}

static void swap_points(tl_lattice_point *a, tl_lattice_point *b)
{
    tl_lattice_point t = *a;
    *a = *b;
    *b = t;
}

// ---- Spans -------------------------------------------------------------------------------------------------

// The voxels of the heights [low, high], cut to the field. False when they lie outside.
static bool span_of_heights(double low, double high, uint32_t height_voxels, uint32_t *min_out, uint32_t *max_out)
{
    double limit = (double)height_voxels;
    low = round_to_subdivision(low);
    high = round_to_subdivision(high);
    if (high < 0.0 || low > limit) {
        return false;
    }
    low = max_of(low, 0.0);
    high = min_of(high, limit);
    uint32_t min = (uint32_t)low, max = (uint32_t)high;
    max += (double)max < high;
    *min_out = min;
    *max_out = max > min ? max : min + 1;
    return true;
}

// Whether any piece of the heights [low, high] has the same span: they end below the next voxel and inside the field.
static bool lies_in_one_layer(double low, double high, uint32_t height_voxels)
{
    low = round_to_subdivision(low);
    high = round_to_subdivision(high);
    return low >= 0.0 && high <= (double)height_voxels && high < (double)((uint32_t)low + 1);
}

// Adds the span [min, max) to the cells first..last of a row.
static tl_result add_level_row(const tl_voxel_band *band, uint32_t row, int64_t first, int64_t last, uint32_t min,
                               uint32_t max, uint32_t area)
{
    tl_span_buffer *buffer = band->buffer;
    TL_TRY(tl_span_buffer_reserve(buffer, (uint32_t)(last - first + 1)));
    const uint32_t row_start = (row - band->first_row) * band->width;
    tl_span_item item = tl_span_item_make(row_start + (uint32_t)first, min, max, area);
    tl_span_item *items = buffer->items + buffer->count;
    const tl_span_item next_column = tl_span_item_make(1, 0, 0, 0);
    for (int64_t i = first; i <= last; i++) {
        *items++ = item;
        item += next_column;
    }
    buffer->count += (uint64_t)(last - first + 1);
    return TL_OK;
}

// Adds the spans that lie in band->low and ->high for the cells first..last of a row, and clears those.
static tl_result add_row(const tl_voxel_band *band, uint32_t row, int64_t first, int64_t last, uint32_t area)
{
    tl_span_buffer *buffer = band->buffer;
    TL_TRY(tl_span_buffer_reserve(buffer, (uint32_t)(last - first + 1)));
    const uint32_t row_start = (row - band->first_row) * band->width;
    double *low = band->low, *high = band->high;
    tl_span_item *items = buffer->items + buffer->count;
    for (int64_t i = first; i <= last; i++) {
        uint32_t min, max;
        if (span_of_heights(low[i], high[i], band->height_voxels, &min, &max)) {
            *items++ = tl_span_item_make(row_start + (uint32_t)i, min, max, area);
        }
        low[i] = INFINITY;
        high[i] = -INFINITY;
    }
    buffer->count = (uint64_t)(items - buffer->items);
    return TL_OK;
}

// ---- The slice of a triangle in one row --------------------------------------------------------------------

typedef struct slice {
    tl_lattice_point points[5]; ///< the outline in order; z is not used
    int count;
} slice;

static void slice_add(slice *s, tl_lattice_point point)
{
    s->points[s->count++] = point;
}

// Widens the cells first..last by the heights of the edge from p to q.
static void widen_by_edge(const tl_voxel_band *band, tl_lattice_point p, tl_lattice_point q, int64_t first,
                          int64_t last)
{
    if (p.x > q.x) {
        swap_points(&p, &q);
    }
    const double min_y = min_of(p.y, q.y), max_y = max_of(p.y, q.y);
    int64_t begin, end;
    cell_range(p.x, q.x, first, last, &begin, &end);
    double *low = band->low, *high = band->high;
    if (begin == end && p.x >= (double)begin && q.x <= (double)(begin + 1)) {
        low[begin] = min_of(low[begin], min_y);
        high[begin] = max_of(high[begin], max_y);
        return;
    }
    if (begin > end) {
        return;
    }
    // Over cell i the edge takes the heights from line i to line i + 1, which is cut off at its ends by the clamp: the
    // height is monotone along the edge. p.x < q.x, or else it lay within one cell.
    const double slope = (q.y - p.y) / (q.x - p.x);
    double left = p.y + ((double)begin - p.x) * slope;
    left = max_of(min_of(left, max_y), min_y);
    for (int64_t i = begin; i <= end; i++) {
        double right = p.y + ((double)(i + 1) - p.x) * slope;
        right = max_of(min_of(right, max_y), min_y);
        low[i] = min_of(low[i], min_of(left, right));
        high[i] = max_of(high[i], max_of(left, right));
        left = right;
    }
}

static tl_result add_slice(const tl_voxel_band *band, uint32_t row, const slice *s, uint32_t area)
{
    double min_x = s->points[0].x, max_x = min_x, min_y = s->points[0].y, max_y = min_y;
    for (int i = 1; i < s->count; i++) {
        min_x = min_of(min_x, s->points[i].x);
        max_x = max_of(max_x, s->points[i].x);
        min_y = min_of(min_y, s->points[i].y);
        max_y = max_of(max_y, s->points[i].y);
    }
    if (band->closed_far_side && min_x == max_x && min_x == (double)band->width) {
        // A wall on the far side: as a piece within the last column.
        uint32_t min, max;
        int64_t column = (int64_t)band->width - 1;
        return span_of_heights(min_y, max_y, band->height_voxels, &min, &max)
                   ? add_level_row(band, row, column, column, min, max, area)
                   : TL_OK;
    }
    int64_t first, last;
    cell_range(min_x, max_x, 0, (int64_t)band->width - 1, &first, &last);
    if (first > last) {
        return TL_OK;
    }
    bool one_cell = first == last && min_x >= (double)first && max_x <= (double)(first + 1);
    if (one_cell || lies_in_one_layer(min_y, max_y, band->height_voxels)) {
        uint32_t min, max;
        return span_of_heights(min_y, max_y, band->height_voxels, &min, &max)
                   ? add_level_row(band, row, first, last, min, max, area)
                   : TL_OK;
    }
    for (int i = 0; i < s->count; i++) {
        widen_by_edge(band, s->points[i], s->points[i + 1 < s->count ? i + 1 : 0], first, last);
    }
    return add_row(band, row, first, last, area);
}

// ---- The triangle ------------------------------------------------------------------------------------------

// An edge as a function of z, from its lower to its upper end.
typedef struct edge {
    tl_lattice_point start;
    double dx, dy; ///< per unit of z; not used when the edge lies along a row
} edge;

static edge make_edge(const tl_lattice_point *start, const tl_lattice_point *end)
{
    double dz = end->z - start->z;
    edge e = { *start, 0.0, 0.0 };
    if (dz > 0.0) {
        e.dx = (end->x - start->x) / dz;
        e.dy = (end->y - start->y) / dz;
    }
    return e;
}

static tl_lattice_point cross_line(const edge *e, double z)
{
    double along = z - e->start.z;
    tl_lattice_point point = { round_to_subdivision(e->start.x + along * e->dx), e->start.y + along * e->dy, z };
    return point;
}

tl_result tl_voxelize_triangle(const tl_voxel_band *band, tl_lattice_point a, tl_lattice_point b, tl_lattice_point c,
                               uint32_t area)
{
    if (comes_first(&b, &a)) {
        swap_points(&a, &b);
    }
    if (comes_first(&c, &b)) {
        swap_points(&b, &c);
        if (comes_first(&b, &a)) {
            swap_points(&a, &b);
        }
    }
    double min_x = min_of(a.x, min_of(b.x, c.x)), max_x = max_of(a.x, max_of(b.x, c.x));
    double min_y = min_of(a.y, min_of(b.y, c.y)), max_y = max_of(a.y, max_of(b.y, c.y));
    if (max_x < 0.0 || min_x > (double)band->width || max_y < -1.0 || min_y > (double)band->height_voxels + 1.0) {
        return TL_OK;
    }
    int64_t first, last;
    const int64_t row_end = (int64_t)band->first_row + band->row_count;
    if (band->closed_far_side && a.z == c.z && a.z == (double)band->field_height) {
        first = (int64_t)band->field_height - 1;
        last = row_end > first ? first : first - 1;
    } else {
        cell_range(a.z, c.z, band->first_row, row_end - 1, &first, &last);
    }
    if (first > last) {
        return TL_OK;
    }

    const edge whole = make_edge(&a, &c), lower = make_edge(&a, &b), upper = make_edge(&b, &c);
    double line = (double)first;
    tl_lattice_point on_whole = a, on_bent = a; // where the two sides of the outline enter the row
    if (a.z < line) {
        on_whole = cross_line(&whole, line);
        on_bent = cross_line(b.z > line ? &lower : &upper, line);
    }
    for (int64_t row = first; row <= last; row++) {
        const double next = (double)(row + 1);
        slice s;
        s.count = 0;
        slice_add(&s, on_whole);
        slice_add(&s, on_bent);
        if (b.z >= line && b.z <= next) {
            slice_add(&s, b);
        }
        if (c.z > next) {
            on_whole = cross_line(&whole, next);
            on_bent = cross_line(b.z > next ? &lower : &upper, next);
            slice_add(&s, on_bent);
            slice_add(&s, on_whole);
        } else {
            slice_add(&s, c);
        }
        TL_TRY(add_slice(band, (uint32_t)row, &s, area));
        line = next;
    }
    return TL_OK;
}
