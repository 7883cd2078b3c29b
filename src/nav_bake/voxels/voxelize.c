// SPDX-License-Identifier: MIT
//
// Conservative voxelization of a triangle, by what it overlaps.
//
// Most triangles of a detailed level lie within one cell, which triangle_block.inl finds, and most others are walls
// along a row or a column of cells: those are seen from the side, where a triangle is two slopes over a line of cells.
// Only what is left walks its edges row by row (voxelize_rows.c).
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

#include "nav_bake/voxels/voxelize.h"

#include "base/assert.h"
#include "nav_bake/voxels/voxel_walk.h"

// Cells in line, first..last along it.
typedef struct cell_line {
    int32_t first, last;
    uint32_t column, step; ///< the first one's column, and what leads to the next
} cell_line;

// A point of a triangle seen from the side: how far along the cells it lies, and how high.
typedef struct side_point {
    double along, y;
} side_point;

static inline void swap_if_behind(side_point *p, side_point *q)
{
    const side_point low = *p, high = *q;
    const bool swap = low.along > high.along;
    p->along = swap ? high.along : low.along;
    p->y = swap ? high.y : low.y;
    q->along = swap ? low.along : high.along;
    q->y = swap ? low.y : high.y;
}

static inline double slope_between(const side_point *p, const side_point *q)
{
    return q->along > p->along ? (q->y - p->y) / (q->along - p->along) : 0.0;
}

static inline double height_at(const side_point *from, double slope, double along)
{
    return from->y + (along - from->along) * slope;
}

// The triangle pqr, p.along <= q.along <= r.along and p.along < r.along, within the cells first..last of one line, that
// is all that it overlaps: a wall along a row or a column. `column` is that of the first cell, `step` leads from one to
// the next. There is room for their spans.
//
// Between two cells the triangle takes the heights from its long side, pr, to its bent one, pq and qr. So a cell's
// lowest and highest are at its two borders, or where a corner lies in it, and each border is computed once.
static void walk_line(const tl_voxel_walk *w, const side_point *p, const side_point *q, const side_point *r,
                      cell_line line)
{
    const double straight = slope_between(p, r), before = slope_between(p, q), after = slope_between(q, r);
    double near = p->y, far = p->y; // the heights at the border behind: of the long side, of the bent one
    if (p->along < (double)line.first) {
        const double border = (double)line.first;
        near = height_at(p, straight, border);
        far = border < q->along ? height_at(p, before, border) : height_at(q, after, border);
    }
    uint32_t column = line.column;
    for (int32_t cell = line.first; cell <= line.last; cell++, column += line.step) {
        const double border = (double)cell + 1.0;
        double low = tl_min_f64(near, far), high = tl_max_f64(near, far);
        if (cell < line.last || r->along > border) {
            near = height_at(p, straight, border);
            far = border < q->along ? height_at(p, before, border) : height_at(q, after, border);
        } else {
            near = r->y;
            far = q->along >= border ? q->y : r->y;
        }
        low = tl_min_f64(low, tl_min_f64(near, far));
        high = tl_max_f64(high, tl_max_f64(near, far));
        if (q->along >= (double)cell && q->along < border) {
            low = tl_min_f64(low, q->y);
            high = tl_max_f64(high, q->y);
        }
        tl_voxel_add_heights(w, low, high, column);
    }
}

// The spans of a triangle that lies within one line of cells, in field and band.
static tl_result add_line(const tl_voxel_walk *w, side_point p, side_point q, side_point r, cell_line line)
{
    TL_TRY(tl_span_buffer_reserve(w->band->buffer, (uint32_t)(line.last - line.first + 1)));
    if (w->level) {
        uint32_t column = line.column;
        for (int32_t cell = line.first; cell <= line.last; cell++, column += line.step) {
            tl_span_buffer_add(w->band->buffer, column, w->level_min, w->level_max, w->area);
        }
        return TL_OK;
    }
    swap_if_behind(&p, &q);
    swap_if_behind(&q, &r);
    swap_if_behind(&p, &q);
    walk_line(w, &p, &q, &r, line);
    return TL_OK;
}

// A triangle within one row or one column of cells.
static tl_result add_thin(const tl_voxel_walk *w, const tl_triangle_block *block, uint32_t i, uint32_t column)
{
    const tl_voxel_point a = tl_triangle_block_corner(block, 0, i), b = tl_triangle_block_corner(block, 1, i),
                         c = tl_triangle_block_corner(block, 2, i);
    const double ay = a.y * TL_SUBDIVISIONS, by = b.y * TL_SUBDIVISIONS, cy = c.y * TL_SUBDIVISIONS;
    if ((block->place[i] & TL_PLACE_ONE_ROW) != 0) {
        const cell_line line = { block->first_x[i], block->last_x[i], column, 1 };
        return add_line(w, (side_point){ a.x, ay }, (side_point){ b.x, by }, (side_point){ c.x, cy }, line);
    }
    const cell_line line = { block->first_z[i], block->last_z[i], column, w->band->width };
    const double first_row = (double)w->band->first_row;
    return add_line(w, (side_point){ a.z - first_row, ay }, (side_point){ b.z - first_row, by },
                    (side_point){ c.z - first_row, cy }, line);
}

// A triangle of several rows and columns.
static tl_result add_rows(tl_voxel_walk *w, const tl_triangle_block *block, uint32_t i)
{
    tl_voxel_point a = tl_triangle_block_corner(block, 0, i), b = tl_triangle_block_corner(block, 1, i),
                   c = tl_triangle_block_corner(block, 2, i);
    a.y *= TL_SUBDIVISIONS;
    b.y *= TL_SUBDIVISIONS;
    c.y *= TL_SUBDIVISIONS;
    w->inside = (block->place[i] & TL_PLACE_INSIDE) != 0;
    w->beyond = (block->place[i] & (TL_PLACE_BEFORE | TL_PLACE_BEHIND)) != 0;
    const tl_voxel_point *const corners[3] = { &a, &b, &c };
    const int32_t first_row = (int32_t)w->band->first_row;
    return tl_voxelize_rows(w, corners, block->first_z[i] + first_row, block->last_z[i] + first_row);
}

tl_result tl_voxelize_triangle(const tl_voxel_band *band, const tl_triangle_block *block, uint32_t i, uint32_t area)
{
    const int32_t first_x = block->first_x[i], first_z = block->first_z[i], place = block->place[i];
    if (first_x > block->last_x[i] || first_z > block->last_z[i] || block->min[i] >= block->max[i]) {
        return TL_OK;
    }
    const uint32_t column = (uint32_t)first_z * band->width + (uint32_t)first_x;
    const uint32_t min = (uint32_t)block->min[i], max = (uint32_t)block->max[i];
    if ((place & TL_PLACE_ONE_CELL) == TL_PLACE_ONE_CELL) {
        TL_TRY(tl_span_buffer_reserve(band->buffer, 1));
        tl_span_buffer_add(band->buffer, column, min, max, area);
        return TL_OK;
    }
    tl_voxel_walk w = { .band = band, .area = area, .level = (place & TL_PLACE_LEVEL) != 0 };
    w.level_min = min;
    w.level_max = max;
    return (place & TL_PLACE_ONE_CELL) != 0 ? add_thin(&w, block, i, column) : add_rows(&w, block, i);
}
