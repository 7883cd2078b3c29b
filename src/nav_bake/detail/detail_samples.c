// SPDX-License-Identifier: MIT
//
// Detail samples: which heights inside a polygon become vertices.
//
// Heights are sampled on a grid. Greedy insertion: each triangle knows the samples that lie in it and the worst of
// them; the worst of all becomes a vertex, and only the triangles that this changes are measured again. Source:
// Garland, Heckbert, Fast Polygonal Approximation of Terrains and Height Fields, 1995 (their algorithm III); Mononen,
// Recast (the grid, and its distance from the edges).

#include "nav_bake/detail/detail.h"

#include "base/assert.h"

#include <math.h>

typedef struct interval {
    double low, high;
} interval;

// Where a row is at least half the spacing inside all edges. Columns.
static interval row_inside(const tl_detail_work *work, uint32_t polygon, double z)
{
    const tl_polygon_mesh *polygons = work->polygons;
    uint32_t begin = polygons->first[polygon], end = polygons->first[polygon + 1];
    interval row = { -(double)INFINITY, (double)INFINITY };
    for (uint32_t k = begin; k < end; k++) {
        const int32_t *a = polygons->vertices + 3 * (size_t)polygons->indices[k];
        const int32_t *b = polygons->vertices + 3 * (size_t)polygons->indices[k + 1 < end ? k + 1 : begin];
        double dx = (double)b[0] - a[0], dz = (double)b[2] - a[2];
        // Inside: (x - a.x) dz - dx (z - a.z) >= spacing / 2 * length
        double needed = 0.5 * work->spacing * sqrt(dx * dx + dz * dz) + dx * (z - a[2]);
        if (dz > 0) {
            double bound = a[0] + needed / dz;
            row.low = bound > row.low ? bound : row.low;
        } else if (dz < 0) {
            double bound = a[0] + needed / dz;
            row.high = bound < row.high ? bound : row.high;
        } else if (needed > 0) {
            row.high = -(double)INFINITY;
        }
    }
    return row;
}

uint64_t tl_detail_sample_bound(const tl_detail_work *work, uint32_t polygon)
{
    if (!(work->spacing > 0)) {
        return 0;
    }
    tl_detail_extent e = tl_detail_polygon_extent(work->polygons, polygon);
    double columns = ((double)e.max_x - e.min_x) / work->spacing, rows = ((double)e.max_z - e.min_z) / work->spacing;
    return ((uint64_t)columns + 2) * ((uint64_t)rows + 2);
}

uint32_t tl_detail_sample_inside(const tl_detail_work *work, uint32_t polygon, tl_detail_point *samples,
                                 uint32_t capacity)
{
    tl_detail_extent e = tl_detail_polygon_extent(work->polygons, polygon);
    tl_detail_floors floors = tl_detail_polygon_floors(work, polygon);
    uint32_t corners = work->polygons->first[polygon + 1] - work->polygons->first[polygon], count = 0;
    int32_t fallback = (int32_t)(e.sum_y / (int64_t)corners);
    int64_t border = work->compact->border_size, last_z = INT64_MIN;
    for (double i = floor(e.min_z / work->spacing);; i += 1) {
        int64_t z = (int64_t)floor(i * work->spacing);
        if (z >= e.max_z) {
            break;
        }
        interval row = row_inside(work, polygon, (double)z + 0.5);
        if (z == last_z || z < e.min_z || !(row.low <= row.high)) {
            continue; // a spacing below 1 meets some columns twice
        }
        last_z = z;
        int64_t last_x = INT64_MIN;
        for (double j = floor((row.low - 0.5) / work->spacing);; j += 1) {
            int64_t x = (int64_t)floor(j * work->spacing);
            if ((double)x + 0.5 > row.high) {
                break;
            }
            if ((double)x + 0.5 < row.low || x == last_x || x < e.min_x) {
                continue;
            }
            last_x = x;
            TL_ASSERT(count < capacity);
            tl_detail_point *s = &samples[count++];
            s->x = (int32_t)(x - e.min_x) * TL_DETAIL_ONE + TL_DETAIL_ONE / 2;
            s->z = (int32_t)(z - e.min_z) * TL_DETAIL_ONE + TL_DETAIL_ONE / 2;
            s->y = tl_detail_floor_at(&floors, x + border, z + border, true, fallback);
        }
    }
    (void)capacity;
    return count;
}

// ---------------------------------------------------------------------------------------------------------

static bool is_worse_fit(const tl_detail_heap *heap, uint32_t a, uint32_t b)
{
    return heap->error[a] > heap->error[b] || (heap->error[a] == heap->error[b] && heap->worst[a] < heap->worst[b]);
}

#define TL_HEAP(name)                        worst_triangles_##name
#define TL_HEAP_ITEM                         uint32_t
#define TL_HEAP_CONTEXT                      tl_detail_heap *
#define TL_HEAP_BEFORE(context, a, b)        is_worse_fit((context), (a), (b))
#define TL_HEAP_MOVED(context, triangle, at) ((context)->place[triangle] = (at))
#include "base/heap.inl"

// A triangle's error has changed, up or down.
static void reorder_triangle(tl_detail_heap *heap, uint32_t triangle)
{
    worst_triangles_sift_up(heap->triangles, heap->place[triangle], triangle, heap);
    worst_triangles_sift_down(heap->triangles, heap->count, heap->place[triangle], triangle, heap);
}

// Finds a triangle's worst sample: vertical distance from its plane.
static void measure_triangle(const tl_detail_mesh *mesh, uint32_t t, tl_detail_heap *heap)
{
    const tl_detail_triangle *triangle = &mesh->triangles[t];
    const tl_detail_point *a = &mesh->points[triangle->corner[0]], *b = &mesh->points[triangle->corner[1]],
                          *c = &mesh->points[triangle->corner[2]];
    double bx = (double)b->x - a->x, bz = (double)b->z - a->z, by = (double)b->y - a->y;
    double cx = (double)c->x - a->x, cz = (double)c->z - a->z, cy = (double)c->y - a->y;
    double area2 = (double)tl_detail_orient(a, b, c);
    double slope_x = (cy * bz - by * cz) / area2, slope_z = (by * cx - cy * bx) / area2;
    heap->error[t] = -1;
    heap->worst[t] = TL_DETAIL_NONE;
    for (uint32_t s = triangle->first_sample; s != TL_DETAIL_NONE; s = mesh->next_sample[s]) {
        const tl_detail_point *p = &mesh->samples[s];
        double surface = a->y + slope_x * ((double)p->x - a->x) + slope_z * ((double)p->z - a->z);
        double error = fabs(p->y - surface);
        if (error > heap->error[t] || (error == heap->error[t] && s < heap->worst[t])) {
            heap->error[t] = error;
            heap->worst[t] = s;
        }
    }
}

static void remove_sample(tl_detail_mesh *mesh, uint32_t t, uint32_t sample)
{
    uint32_t *link = &mesh->triangles[t].first_sample;
    while (*link != sample) {
        link = &mesh->next_sample[*link];
    }
    *link = mesh->next_sample[sample];
}

double tl_detail_refine(tl_detail_mesh *mesh, tl_detail_heap *heap, uint32_t sample_count, double max_error)
{
    if (sample_count == 0) {
        return 0;
    }
    heap->count = 0;
    for (uint32_t t = 0; t < mesh->triangle_count; t++) {
        measure_triangle(mesh, t, heap);
        worst_triangles_push(heap->triangles, &heap->count, t, heap);
    }
    while (mesh->point_count < TL_DETAIL_MAX_VERTICES && heap->error[heap->triangles[0]] > max_error) {
        uint32_t t = heap->triangles[0], sample = heap->worst[t], before = mesh->triangle_count;
        remove_sample(mesh, t, sample);
        mesh->points[mesh->point_count++] = mesh->samples[sample];
        mesh->changed_count = 0;
        tl_detail_insert_inside(mesh, t);
        for (t = before; t < mesh->triangle_count; t++) {
            heap->error[t] = -1;
            heap->worst[t] = TL_DETAIL_NONE;
            heap->place[t] = heap->count;
            heap->triangles[heap->count++] = t;
        }
        for (uint32_t k = 0; k < mesh->changed_count; k++) {
            measure_triangle(mesh, mesh->changed[k], heap);
            reorder_triangle(heap, mesh->changed[k]);
        }
    }
    double left = heap->error[heap->triangles[0]];
    return left > 0 ? left : 0;
}
