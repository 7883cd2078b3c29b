// SPDX-License-Identifier: MIT
//
// A triangle of several rows and columns of cells.
//
// Recast clips a polygon to each row and then to each cell (Sutherland, Hodgman). Here each row is entered with the two
// points where the triangle's outline crosses the row's line; the slice of the triangle between two lines has at most
// five edges, and the heights that it takes over a cell are those of its outline over that cell. So each edge is walked
// once along its row, widening the low and high of the cells it passes: no clipping, and no copies of polygons.
//
// A triangle within one layer of voxels, as most floors are, has one span for all its cells: only the reach of each row
// is asked for then.

#include "nav_bake/voxels/voxel_walk.h"

#include "base/assert.h"
#include "base/compiler.h"

#include <math.h>

/// Heights of a cell that nothing has reached yet.
static const double NO_LOW = (double)INFINITY, NO_HIGH = -(double)INFINITY;

// Of two points of one edge, the one that it is walked from: the same for both triangles of the edge.
static inline bool is_first_end(const tl_voxel_point *a, const tl_voxel_point *b)
{
    if (a->z != b->z) {
        return a->z < b->z;
    }
    return a->x != b->x ? a->x < b->x : a->y < b->y;
}

static inline void order_ends(const tl_voxel_point **a, const tl_voxel_point **b)
{
    const tl_voxel_point *first = *a, *second = *b;
    const bool swap = is_first_end(second, first);
    *a = swap ? second : first;
    *b = swap ? first : second;
}

// ---- Spans of a row ----------------------------------------------------------------------------------------

// The span of heights that lie inside the field. One that takes no height still has a voxel.
static inline void add_inside(const tl_voxel_walk *w, double low, double high, uint32_t column)
{
    const uint32_t bottom = (uint32_t)tl_voxel_round(low), top = (uint32_t)tl_voxel_round(high);
    const uint32_t min = bottom >> TL_SUBDIVISION_BITS, max = (top + TL_SUBDIVISIONS - 1) >> TL_SUBDIVISION_BITS;
    tl_span_buffer_add(w->band->buffer, column, min, max > min ? max : min + 1, w->area);
}

// Adds the spans that lie in low and high for the cells first..last of a row, and clears those.
static tl_result add_row(const tl_voxel_walk *w, uint32_t row, int32_t first, int32_t last)
{
    tl_span_buffer *buffer = w->band->buffer;
    const uint32_t count = (uint32_t)(last - first + 1);
    TL_TRY(tl_span_buffer_reserve(buffer, count));
    const uint32_t column = (row - w->band->first_row) * w->band->width + (uint32_t)first;
    double *low = w->low + first, *high = w->high + first;
    if (w->inside) {
        for (uint32_t i = 0; i < count; i++) {
            add_inside(w, low[i], high[i], column + i);
        }
    } else {
        for (uint32_t i = 0; i < count; i++) {
            tl_voxel_add_heights(w, low[i], high[i], column + i);
        }
    }
    for (uint32_t i = 0; i < count; i++) {
        low[i] = NO_LOW;
        high[i] = NO_HIGH;
    }
    return TL_OK;
}

// ---- Edges of the pieces -----------------------------------------------------------------------------------

static inline void widen_cell(double *low, double *high, int32_t cell, double y0, double y1)
{
    low[cell] = tl_min_f64(low[cell], tl_min_f64(y0, y1));
    high[cell] = tl_max_f64(high[cell], tl_max_f64(y0, y1));
}

// A point of an edge seen from the side: how far along the cells it lies, and how high.
typedef struct profile_point {
    double along, y;
} profile_point;

// Low and high of some cells in line.
typedef struct cell_heights {
    double *low, *high;
} cell_heights;

// Widens the cells of 0 .. count - 1 that the edge from p to q passes, p.along <= q.along, in one line of cells, and in
// a second one where `both`. Over a cell the edge takes the heights from one border to the next; its ends are what they
// are. `beyond`: it may reach out of the cells.
static TL_ALWAYS_INLINE void walk_profile(profile_point p, profile_point q, uint32_t count, cell_heights one,
                                          cell_heights two, bool both, bool beyond)
{
    int32_t first, last;
    if (beyond) {
        tl_voxel_cell_range(p.along, q.along, count, &first, &last);
        if (first > last) {
            return;
        }
    } else {
        first = (int32_t)p.along;
        last = (int32_t)q.along;
        last -= last > first && (double)last >= q.along;
    }
    double before = p.y;
    if (first < last || (beyond && (p.along < (double)first || q.along > (double)(last + 1)))) { // p.along < q.along
        const double slope = (q.y - p.y) / (q.along - p.along);
        if (beyond && p.along < (double)first) {
            before = p.y + ((double)first - p.along) * slope;
        }
        for (; first < last; first++) {
            double after = p.y + ((double)(first + 1) - p.along) * slope;
            widen_cell(one.low, one.high, first, before, after);
            if (both) {
                widen_cell(two.low, two.high, first, before, after);
            }
            before = after;
        }
        if (beyond && q.along > (double)(last + 1)) {
            q.y = p.y + ((double)(last + 1) - p.along) * slope;
        }
    }
    widen_cell(one.low, one.high, last, before, q.y);
    if (both) {
        widen_cell(two.low, two.high, last, before, q.y);
    }
}

// Widens the cells of the row at hand, and of the next one where `in_next`.
static TL_ALWAYS_INLINE void walk_edge(tl_voxel_walk *w, const tl_voxel_point *p, const tl_voxel_point *q, bool in_next,
                                       bool beyond)
{
    const profile_point from = { p->x, p->y }, to = { q->x, q->y };
    const cell_heights here = { w->low, w->high }, next = { w->next_low, w->next_high };
    if (from.along <= to.along) {
        walk_profile(from, to, w->band->width, here, next, in_next, beyond);
    } else {
        walk_profile(to, from, w->band->width, here, next, in_next, beyond);
    }
}

// The piece in the row at hand reaches to the point, which lies in it or on its lines.
static inline void reach_of_row(tl_voxel_walk *w, const tl_voxel_point *point)
{
    w->left = tl_min_f64(w->left, point->x);
    w->right = tl_max_f64(w->right, point->x);
}

// The cut between the row at hand and the next one.
static TL_ALWAYS_INLINE void add_row_cut(tl_voxel_walk *w, const tl_voxel_point *p, const tl_voxel_point *q,
                                         bool beyond)
{
    w->next_left = tl_min_f64(p->x, q->x);
    w->next_right = tl_max_f64(p->x, q->x);
    w->left = tl_min_f64(w->left, w->next_left);
    w->right = tl_max_f64(w->right, w->next_right);
    walk_edge(w, p, q, true, beyond);
}

// The row at hand is complete: adds its spans, and the next one is at hand.
static TL_ALWAYS_INLINE tl_result finish_row(tl_voxel_walk *w, uint32_t row)
{
    int32_t first, last;
    tl_voxel_cell_range(w->left, w->right, w->band->width, &first, &last);
    if (first <= last) {
        TL_TRY(add_row(w, row, first, last));
    }
    double *low = w->low, *high = w->high;
    if (last + 1 < (int32_t)w->band->width) { // what only touches the piece's right end is in that cell
        low[last + 1] = NO_LOW;
        high[last + 1] = NO_HIGH;
    }
    w->low = w->next_low;
    w->high = w->next_high;
    w->next_low = low;
    w->next_high = high;
    w->left = w->next_left;
    w->right = w->next_right;
    return TL_OK;
}

// Low and high of the row at hand, then of the next one.
void tl_voxel_heights_init(double *heights, uint32_t line)
{
    for (uint32_t i = 0; i < line; i++) {
        heights[i] = heights[2 * (size_t)line + i] = NO_LOW;
        heights[line + i] = heights[3 * (size_t)line + i] = NO_HIGH;
    }
}

// ---- The triangle ------------------------------------------------------------------------------------------

// An edge as a function of z, from its lower to its upper end.
typedef struct edge {
    tl_voxel_point start;
    double dx, dy; ///< per unit of z; not used when the edge lies along a row
} edge;

static inline edge make_edge(const tl_voxel_point *start, const tl_voxel_point *end)
{
    double dz = end->z - start->z;
    edge e = { *start, 0.0, 0.0 };
    if (dz > 0.0) {
        e.dx = (end->x - start->x) / dz;
        e.dy = (end->y - start->y) / dz;
    }
    return e;
}

static inline tl_voxel_point cross_line(const edge *e, double z)
{
    double along = z - e->start.z;
    tl_voxel_point point = { tl_round_to_subdivision(e->start.x + along * e->dx), e->start.y + along * e->dy, z };
    return point;
}

// a, b, c in the order of is_first_end; the rows first..last are the band's that it overlaps.
static TL_ALWAYS_INLINE tl_result walk_rows(tl_voxel_walk *w, const tl_voxel_point *const corner[3], int32_t first,
                                            int32_t last, bool beyond)
{
    const tl_voxel_point *a = corner[0], *b = corner[1], *c = corner[2];
    const edge whole = make_edge(a, c), lower = make_edge(a, b), upper = make_edge(b, c);
    double line = (double)first;
    tl_voxel_point on_whole = *a, on_bent = *a; // where the two sides of the outline enter the row
    w->left = w->right = a->x;
    if (a->z < line) {
        on_whole = cross_line(&whole, line);
        on_bent = cross_line(b->z > line ? &lower : &upper, line);
        w->left = tl_min_f64(on_whole.x, on_bent.x);
        w->right = tl_max_f64(on_whole.x, on_bent.x);
        walk_edge(w, &on_whole, &on_bent, false, beyond);
    }
    for (int32_t row = first; row <= last; row++) {
        const double next = line + 1.0;
        tl_voxel_point whole_end = *c, bent_end = *c;
        const bool cut = c->z > next;
        if (cut) {
            whole_end = cross_line(&whole, next);
            bent_end = cross_line(b->z > next ? &lower : &upper, next);
            if (row < last) {
                add_row_cut(w, &whole_end, &bent_end, beyond);
            } else {
                walk_edge(w, &whole_end, &bent_end, false, beyond);
                reach_of_row(w, &whole_end);
                reach_of_row(w, &bent_end);
            }
        } else {
            reach_of_row(w, c);
        }
        walk_edge(w, &on_whole, &whole_end, false, beyond);
        if (b->z >= line && b->z <= next) {
            walk_edge(w, &on_bent, b, false, beyond);
            walk_edge(w, b, &bent_end, false, beyond);
            reach_of_row(w, b);
        } else {
            walk_edge(w, &on_bent, &bent_end, false, beyond);
        }
        TL_TRY(finish_row(w, (uint32_t)row));
        on_whole = whole_end;
        on_bent = bent_end;
        line = next;
    }
    return TL_OK;
}

static tl_result walk_rows_inside(tl_voxel_walk *w, const tl_voxel_point *const corner[3], int32_t first, int32_t last)
{
    return walk_rows(w, corner, first, last, false);
}

static tl_result walk_rows_beyond(tl_voxel_walk *w, const tl_voxel_point *const corner[3], int32_t first, int32_t last)
{
    return walk_rows(w, corner, first, last, true);
}

static inline double x_at_line(const edge *e, double z)
{
    return tl_round_to_subdivision(e->start.x + (z - e->start.z) * e->dx);
}

// The same for a triangle in one layer of voxels, of which only the reach of each row matters.
static tl_result walk_level_rows(const tl_voxel_walk *w, const tl_voxel_point *const corner[3], int32_t first,
                                 int32_t last)
{
    const tl_voxel_point *a = corner[0], *b = corner[1], *c = corner[2];
    const edge whole = make_edge(a, c), lower = make_edge(a, b), upper = make_edge(b, c);
    const uint32_t width = w->band->width;
    tl_span_buffer *buffer = w->band->buffer;
    double line = (double)first, left = a->x, right = a->x;
    if (a->z < line) {
        const double on_whole = x_at_line(&whole, line), on_bent = x_at_line(b->z > line ? &lower : &upper, line);
        left = tl_min_f64(on_whole, on_bent);
        right = tl_max_f64(on_whole, on_bent);
    }
    uint32_t row_begin = ((uint32_t)first - w->band->first_row) * width;
    for (int32_t row = first; row <= last; row++, row_begin += width) {
        const double next = line + 1.0;
        double next_left = c->x, next_right = c->x;
        if (c->z > next) {
            const double on_whole = x_at_line(&whole, next), on_bent = x_at_line(b->z > next ? &lower : &upper, next);
            next_left = tl_min_f64(on_whole, on_bent);
            next_right = tl_max_f64(on_whole, on_bent);
        }
        left = tl_min_f64(left, next_left);
        right = tl_max_f64(right, next_right);
        if (b->z >= line && b->z <= next) {
            left = tl_min_f64(left, b->x);
            right = tl_max_f64(right, b->x);
        }
        int32_t from, to;
        tl_voxel_cell_range(left, right, width, &from, &to);
        if (from <= to) {
            TL_TRY(tl_span_buffer_reserve(buffer, (uint32_t)(to - from + 1)));
        }
        for (int32_t cell = from; cell <= to; cell++) {
            tl_span_buffer_add(buffer, row_begin + (uint32_t)cell, w->level_min, w->level_max, w->area);
        }
        left = next_left;
        right = next_right;
        line = next;
    }
    return TL_OK;
}

tl_result tl_voxelize_rows(tl_voxel_walk *w, const tl_voxel_point *const corners[3], int32_t first, int32_t last)
{
    const tl_voxel_point *corner[3] = { corners[0], corners[1], corners[2] };
    order_ends(&corner[0], &corner[1]);
    order_ends(&corner[1], &corner[2]);
    order_ends(&corner[0], &corner[1]);
    if (w->level) {
        return walk_level_rows(w, corner, first, last);
    }
    const size_t line = w->band->line;
    w->low = w->band->heights;
    w->high = w->low + line;
    w->next_low = w->high + line;
    w->next_high = w->next_low + line;
    return w->beyond ? walk_rows_beyond(w, corner, first, last) : walk_rows_inside(w, corner, first, last);
}
