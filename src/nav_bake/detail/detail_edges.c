// SPDX-License-Identifier: MIT
//
// Detail edges: heights along the polygons' edges.
//
// An edge is sampled in 2^n equal steps, and of these samples the fewest are kept by Ramer, Douglas and Peucker so that
// the heights between are within the error. The deviation is the vertical one and is compared exactly. Two polygons
// that share an edge must agree on it: the lower one samples it, from the end that is smaller by x, then z; the other
// reads. Source: Mononen, Recast. There both sides sample, each from its own floors, and seams differ where these do;
// and equal steps that are no power of two give points beside the edge.

#include "nav_bake/detail/detail.h"

#include "base/assert.h"

#include <string.h>

tl_detail_extent tl_detail_polygon_extent(const tl_polygon_mesh *polygons, uint32_t polygon)
{
    tl_detail_extent e = { INT32_MAX, INT32_MAX, INT32_MIN, INT32_MIN, 0, 0, 0 };
    for (uint32_t k = polygons->first[polygon]; k < polygons->first[polygon + 1]; k++) {
        const int32_t *v = polygons->vertices + 3 * (size_t)polygons->indices[k];
        e.min_x = v[0] < e.min_x ? v[0] : e.min_x;
        e.max_x = v[0] > e.max_x ? v[0] : e.max_x;
        e.min_z = v[2] < e.min_z ? v[2] : e.min_z;
        e.max_z = v[2] > e.max_z ? v[2] : e.max_z;
        e.sum_x += v[0];
        e.sum_y += v[1];
        e.sum_z += v[2];
    }
    return e;
}

tl_detail_floors tl_detail_polygon_floors(const tl_detail_work *work, uint32_t polygon)
{
    const tl_polygon_mesh *polygons = work->polygons;
    tl_detail_extent e = tl_detail_polygon_extent(polygons, polygon);
    int64_t corners = (int64_t)polygons->first[polygon + 1] - polygons->first[polygon];
    int64_t border = work->compact->border_size, width = (int64_t)e.max_x - e.min_x, depth = (int64_t)e.max_z - e.min_z;
    uint32_t reach = (uint32_t)((width > depth ? width : depth) + 2);
    const int64_t x = e.sum_x / corners + border, z = e.sum_z / corners + border;
    const bool several = polygons->regions[polygon] == TL_SEVERAL_REGIONS;
    const uint32_t region =
        several ? tl_detail_choose_region(work->compact, polygons, polygon, reach, x, z, (int32_t)(e.sum_y / corners))
                : polygons->regions[polygon];
    return tl_detail_floors_make(work->compact, region, several, reach, x, z);
}

// Steps so that their length is at most the spacing, as far as TL_DETAIL_MAX_EDGE_BITS allow.
static void choose_steps(const tl_detail_work *work, const int32_t *a, const int32_t *b, tl_detail_edge *edge)
{
    double dx = (double)b[0] - a[0], dz = (double)b[2] - a[2], length_sq = dx * dx + dz * dz;
    uint32_t bits = 0;
    double step = work->spacing;
    while (work->spacing > 0 && bits < TL_DETAIL_MAX_EDGE_BITS && step * step < length_sq) {
        step *= 2;
        bits++;
    }
    edge->bits = (uint8_t)bits;
    edge->coarse = work->spacing > 0 && step * step < length_sq;
}

static bool is_lower(const int32_t *a, const int32_t *b)
{
    return a[0] < b[0] || (a[0] == b[0] && a[2] < b[2]);
}

// heights[0 .. steps]: the ends are the corners' own heights.
static void sample_heights(const tl_detail_floors *floors, const int32_t *low, const int32_t *high, uint32_t bits,
                           int32_t *heights)
{
    int64_t border = floors->compact->border_size, one = TL_DETAIL_ONE, steps = (int64_t)1 << bits;
    int64_t dx = (int64_t)high[0] - low[0], dz = (int64_t)high[2] - low[2], dy = (int64_t)high[1] - low[1];
    heights[0] = low[1];
    heights[steps] = high[1];
    for (int64_t k = 1; k < steps; k++) {
        // one / steps is whole, so the place is exact. A shift rounds down, for negative places too.
        int64_t x = low[0] * one + dx * k * (one / steps), z = low[2] * one + dz * k * (one / steps);
        int32_t straight = (int32_t)(low[1] + dy * k / steps);
        heights[k] = tl_detail_floor_at(floors, (x >> TL_DETAIL_FRACTION_BITS) + border,
                                        (z >> TL_DETAIL_FRACTION_BITS) + border, false, straight);
    }
}

// The step between a and b whose height strays farthest from the straight line, or a when all are within the error.
static uint32_t farthest_step(const int32_t *heights, uint32_t a, uint32_t b, double max_error)
{
    int64_t span = (int64_t)b - a, rise = (int64_t)heights[b] - heights[a], worst = 0;
    uint32_t farthest = a;
    for (uint32_t k = a + 1; k < b; k++) {
        int64_t away = ((int64_t)heights[k] - heights[a]) * span - rise * ((int64_t)k - a);
        away = away < 0 ? -away : away;
        if (away > worst) {
            worst = away;
            farthest = k;
        }
    }
    return (double)worst > max_error * (double)span ? farthest : a;
}

static tl_result append_sample(tl_detail_work *work, uint32_t step, int32_t y)
{
    tl_detail_edges *edges = &work->edges;
    if (edges->sample_count == edges->sample_capacity) {
        if (edges->sample_capacity > UINT32_MAX / 2) {
            return TL_ERR_LIMIT;
        }
        tl_detail_edge_sample *grown =
            tl_arena_grow(work->arena, edges->samples, &edges->sample_capacity, 1024, sizeof *grown);
        if (grown == NULL) {
            return TL_ERR_MEMORY;
        }
        edges->samples = grown;
    }
    edges->samples[edges->sample_count++] = (tl_detail_edge_sample){ (uint16_t)step, 0, y };
    return TL_OK;
}

// Keeps samples in the order of steps.
static tl_result simplify(tl_detail_work *work, const int32_t *heights, tl_detail_edge *edge)
{
    uint32_t stack[1 << TL_DETAIL_MAX_EDGE_BITS], depth = 0; // ends that wait, each a step of its own
    uint32_t a = 0, b = 1u << edge->bits;
    edge->first = work->edges.sample_count;
    for (;;) {
        uint32_t middle = farthest_step(heights, a, b, work->max_error);
        if (middle != a) {
            stack[depth++] = b;
            b = middle;
        } else if (depth > 0) {
            TL_TRY(append_sample(work, b, heights[b]));
            a = b;
            b = stack[--depth];
        } else {
            break;
        }
    }
    edge->count = (uint16_t)(work->edges.sample_count - edge->first);
    return TL_OK;
}

static uint32_t next_patch_corner(const tl_polygon_mesh *polygons, uint32_t polygon, uint32_t k)
{
    return k + 1 < polygons->first[polygon + 1] ? k + 1 : polygons->first[polygon];
}

// The place of the edge from `to` to `from` in a polygon, or TL_DETAIL_NONE.
static uint32_t find_reverse(const tl_polygon_mesh *polygons, uint32_t polygon, uint32_t from, uint32_t to)
{
    for (uint32_t k = polygons->first[polygon]; k < polygons->first[polygon + 1]; k++) {
        if (polygons->indices[k] == to && polygons->indices[next_patch_corner(polygons, polygon, k)] == from) {
            return k;
        }
    }
    return TL_DETAIL_NONE;
}

static tl_result sample_patch_edge(tl_detail_work *work, const tl_detail_floors *floors, uint32_t polygon, uint32_t k,
                                   int32_t *heights)
{
    const tl_polygon_mesh *polygons = work->polygons;
    uint32_t from = polygons->indices[k], to = polygons->indices[next_patch_corner(polygons, polygon, k)];
    uint32_t other = polygons->neighbours[k];
    if (other < polygon) {
        uint32_t reverse = find_reverse(polygons, other, from, to);
        if (reverse != TL_DETAIL_NONE) {
            work->edges.edges[k] = work->edges.edges[reverse];
            return TL_OK;
        }
    }
    const int32_t *a = polygons->vertices + 3 * (size_t)from, *b = polygons->vertices + 3 * (size_t)to;
    const int32_t *low = is_lower(a, b) ? a : b, *high = is_lower(a, b) ? b : a;
    tl_detail_edge *edge = &work->edges.edges[k];
    choose_steps(work, low, high, edge);
    sample_heights(floors, low, high, edge->bits, heights);
    return simplify(work, heights, edge);
}

tl_result tl_detail_sample_edges(tl_detail_work *work)
{
    const tl_polygon_mesh *polygons = work->polygons;
    int32_t heights[(1 << TL_DETAIL_MAX_EDGE_BITS) + 1];
    work->edges.edges = TL_PUSH_ZERO(work->arena, tl_detail_edge, polygons->index_count);
    if (work->edges.edges == NULL) {
        return TL_ERR_MEMORY;
    }
    for (uint32_t p = 0; p < polygons->polygon_count && work->spacing > 0; p++) {
        tl_detail_floors floors = tl_detail_polygon_floors(work, p);
        for (uint32_t k = polygons->first[p]; k < polygons->first[p + 1]; k++) {
            TL_TRY(sample_patch_edge(work, &floors, p, k, heights));
        }
    }
    return TL_OK;
}
