// SPDX-License-Identifier: MIT
//
// Conservative voxelization of a triangle, by what it overlaps.
//
// Most triangles of a detailed level lie within one cell, and most others are walls along a row or a column of cells:
// those are seen from the side, where a triangle is two slopes over a line of cells. Only what is left walks its edges
// row by row (voxelize_rows.c).
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

#include "nav_bake/voxels/voxel_walk.h"

#include "base/assert.h"

#include <math.h>

// Whether any piece of the heights [low, high], in subdivisions, has the same span: they end below the next voxel and
// inside the field.
static bool lies_in_one_layer(double low, double high, uint32_t height_voxels)
{
    const int32_t limit = (int32_t)height_voxels * TL_SUBDIVISIONS;
    if (!(low > -1.0 && high < (double)limit + 1.0)) {
        return false;
    }
    int32_t bottom = tl_voxel_round(low), top = tl_voxel_round(high);
    return bottom >= 0 && top <= limit && bottom >> TL_SUBDIVISION_BITS == top >> TL_SUBDIVISION_BITS;
}

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

// Whether a range lies within one cell, borders included. A single point on a border lies in the cell to its right.
static inline bool is_in_one_cell(double min, double max)
{
    return max <= floor(min) + 1.0;
}

// A wall exactly on the field's far side moves half a cell inwards.
static void close_far_side(const tl_voxel_band *band, tl_voxel_point *a, tl_voxel_point *b, tl_voxel_point *c)
{
    const double end_x = (double)band->width, end_z = (double)band->field_height;
    if (a->x == end_x && b->x == end_x && c->x == end_x) {
        a->x = b->x = c->x = end_x - 0.5;
    }
    if (a->z == end_z && b->z == end_z && c->z == end_z) {
        a->z = b->z = c->z = end_z - 0.5;
    }
}

typedef struct point_box {
    tl_voxel_point min, max;
} point_box;

static inline point_box box_of_points(const tl_voxel_point *a, const tl_voxel_point *b, const tl_voxel_point *c)
{
    return (point_box){ { tl_min_f64(a->x, tl_min_f64(b->x, c->x)), tl_min_f64(a->y, tl_min_f64(b->y, c->y)),
                          tl_min_f64(a->z, tl_min_f64(b->z, c->z)) },
                        { tl_max_f64(a->x, tl_max_f64(b->x, c->x)), tl_max_f64(a->y, tl_max_f64(b->y, c->y)),
                          tl_max_f64(a->z, tl_max_f64(b->z, c->z)) } };
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

// Whether a box lies within one cell of the band, as those of most triangles do in a detailed level. One that reaches
// out of the band is not asked about.
static inline bool lies_in_one_cell_of(const tl_voxel_band *band, const point_box *box)
{
    const double first_row = (double)band->first_row;
    if (!(box->min.x >= 0.0 && box->max.x < (double)band->width && box->min.z >= first_row &&
          box->max.z < first_row + (double)band->row_count)) {
        return false;
    }
    const double end_x = (double)((int32_t)box->min.x + 1), end_z = (double)((int32_t)box->min.z + 1);
    return box->max.x <= end_x && box->max.z <= end_z;
}

static tl_result add_one_cell(const tl_voxel_band *band, const point_box *box, uint32_t area)
{
    const tl_voxel_walk w = { .band = band, .area = area };
    const uint32_t row = (uint32_t)(int32_t)box->min.z - band->first_row;
    const double low = box->min.y * TL_SUBDIVISIONS, high = box->max.y * TL_SUBDIVISIONS;
    TL_TRY(tl_span_buffer_reserve(band->buffer, 1));
    tl_voxel_add_heights(&w, low, high, row * band->width + (uint32_t)(int32_t)box->min.x);
    return TL_OK;
}

tl_result tl_voxelize_triangle(const tl_voxel_band *band, tl_voxel_point a, tl_voxel_point b, tl_voxel_point c,
                               uint32_t area)
{
    if (band->closed_far_side) {
        close_far_side(band, &a, &b, &c);
    }
    const point_box box = box_of_points(&a, &b, &c);
    if (lies_in_one_cell_of(band, &box)) {
        return add_one_cell(band, &box, area);
    }
    const double first_row = (double)band->first_row, height = (double)band->height_voxels;
    int32_t first_x, last_x, first_z, last_z; // columns and rows of the band
    tl_voxel_cell_range(box.min.x, box.max.x, band->width, &first_x, &last_x);
    tl_voxel_cell_range(box.min.z - first_row, box.max.z - first_row, band->row_count, &first_z, &last_z);
    if (first_x > last_x || first_z > last_z || box.max.y < -1.0 || box.min.y > height + 1.0) {
        return TL_OK;
    }
    const double low = box.min.y * TL_SUBDIVISIONS, high = box.max.y * TL_SUBDIVISIONS;
    tl_voxel_walk w = { .band = band, .area = area };
    const uint32_t column = (uint32_t)first_z * band->width + (uint32_t)first_x;
    // Judged in the whole lattice, not in the band's or field's part of it: all that see a triangle treat it alike.
    const bool in_one_row = is_in_one_cell(box.min.z, box.max.z), in_one_column = is_in_one_cell(box.min.x, box.max.x);
    if (in_one_row && in_one_column) { // on the rim of the band
        TL_TRY(tl_span_buffer_reserve(band->buffer, 1));
        tl_voxel_add_heights(&w, low, high, column);
        return TL_OK;
    }
    if (lies_in_one_layer(low, high, band->height_voxels)) {
        w.level = tl_voxel_span_of_heights(low, high, band->height_voxels, &w.level_min, &w.level_max);
    }
    a.y *= TL_SUBDIVISIONS;
    b.y *= TL_SUBDIVISIONS;
    c.y *= TL_SUBDIVISIONS;
    if (in_one_row) {
        const cell_line line = { first_x, last_x, column, 1 };
        return add_line(&w, (side_point){ a.x, a.y }, (side_point){ b.x, b.y }, (side_point){ c.x, c.y }, line);
    }
    if (in_one_column) {
        const cell_line line = { first_z, last_z, column, band->width };
        return add_line(&w, (side_point){ a.z - first_row, a.y }, (side_point){ b.z - first_row, b.y },
                        (side_point){ c.z - first_row, c.y }, line);
    }
    w.inside = box.min.y >= 0.0 && box.max.y <= height;
    w.beyond = !(box.min.x >= 0.0 && box.max.x < (double)band->width);
    const int32_t above = (int32_t)band->first_row;
    const tl_voxel_point *const corners[3] = { &a, &b, &c };
    return tl_voxelize_rows(&w, corners, first_z + above, last_z + above);
}
