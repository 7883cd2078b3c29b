// SPDX-License-Identifier: MIT
//
// Conservative voxelization of a triangle by walking its edges.
//
// Recast clips a polygon to each row and then to each cell (Sutherland, Hodgman). Here each row is entered with the two
// points where the triangle's outline crosses the row's line; the slice of the triangle between two lines has at most
// five edges, and the heights that it takes over a cell are those of its outline over that cell. So each edge is walked
// once along its row, widening the low and high of the cells it passes: no clipping, no copies of polygons, and a loop
// without branches.
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
#include "base/min_max.h"

#include <math.h>
#include <string.h>

enum { SUBDIVISION_BITS = 10, SUBDIVISIONS = TL_SUBDIVISIONS };
_Static_assert(SUBDIVISIONS == 1 << SUBDIVISION_BITS, "heights are shifted by the bits");

/// As TL_SUBDIVISION_ROUNDER, for whole numbers; the sum then ends in the number's low bits, as two's complement.
static const double WHOLE_ROUNDER = 6755399441055744.0;

/// Heights of a cell that nothing has reached yet.
static const double NO_LOW = (double)INFINITY, NO_HIGH = -(double)INFINITY;

// ---- Small helpers -----------------------------------------------------------------------------------------

// The nearest whole number, ties to even, of a value within +-2^31.
static inline int32_t round_to_int(double value)
{
    double sum = value + WHOLE_ROUNDER;
    uint64_t bits;
    memcpy(&bits, &sum, sizeof bits);
    return (int32_t)(uint32_t)bits;
}

// The cells of 0 .. count - 1 that [min, max] overlaps; none when *last_out < *first_out. What is only touched is not
// overlapped, but a single point lies in the cell to its right.
static inline void cell_range(double min, double max, uint32_t count, int32_t *first_out, int32_t *last_out)
{
    const double end = (double)count;
    int32_t first = (int32_t)tl_clamp_f64(min, 0.0, end), last = (int32_t)tl_clamp_f64(max, 0.0, end);
    if (min < max) {
        last -= (double)last >= max; // touched by max, or max is left of all
    } else {
        last -= max < 0.0;
    }
    *first_out = first;
    *last_out = last < (int32_t)count ? last : (int32_t)count - 1;
}

// Of two points of one edge, the one that it is walked from: the same for both triangles of the edge.
static bool is_first_end(const tl_voxel_point *a, const tl_voxel_point *b)
{
    if (a->z != b->z) {
        return a->z < b->z;
    }
    return a->x != b->x ? a->x < b->x : a->y < b->y;
}

static void swap_points(tl_voxel_point *a, tl_voxel_point *b)
{
    tl_voxel_point t = *a;
    *a = *b;
    *b = t;
}

// ---- Spans of a row ----------------------------------------------------------------------------------------

// The voxels of the heights [low, high], in subdivisions, cut to the field. False when they lie outside.
static inline bool span_of_heights(double low, double high, uint32_t height_voxels, uint32_t *min_out,
                                   uint32_t *max_out)
{
    // Bounded before the conversion, by more than rounding can bring back.
    const int32_t limit = (int32_t)height_voxels * SUBDIVISIONS;
    int32_t bottom = round_to_int(tl_clamp_f64(low, -TL_SUBDIVISIONS, (double)limit + TL_SUBDIVISIONS));
    int32_t top = round_to_int(tl_clamp_f64(high, -TL_SUBDIVISIONS, (double)limit + TL_SUBDIVISIONS));
    if (top < 0 || bottom > limit) {
        return false;
    }
    bottom = bottom > 0 ? bottom : 0;
    top = top < limit ? top : limit;
    uint32_t min = (uint32_t)bottom >> SUBDIVISION_BITS;
    uint32_t max = ((uint32_t)top + SUBDIVISIONS - 1) >> SUBDIVISION_BITS;
    *min_out = min;
    *max_out = max > min ? max : min + 1;
    return true;
}

// Whether any piece of the heights [low, high], in subdivisions, has the same span: they end below the next voxel and
// inside the field.
static bool lies_in_one_layer(double low, double high, uint32_t height_voxels)
{
    const int32_t limit = (int32_t)height_voxels * SUBDIVISIONS;
    if (!(low > -1.0 && high < (double)limit + 1.0)) {
        return false;
    }
    int32_t bottom = round_to_int(low), top = round_to_int(high);
    return bottom >= 0 && top <= limit && bottom >> SUBDIVISION_BITS == top >> SUBDIVISION_BITS;
}

// A triangle on its way through the rows of a band. Heights in subdivisions of a voxel.
typedef struct walk {
    const tl_voxel_band *band;
    uint32_t area;
    bool level;  ///< all cells have the span [level_min, level_max)
    bool inside; ///< all heights lie inside the field
    uint32_t level_min, level_max;
    double *low, *high;           ///< of the row at hand
    double *next_low, *next_high; ///< of the row after it
    double left, right;           ///< of the piece in the row at hand
    double next_left, next_right;
} walk;

static const tl_span_item NEXT_COLUMN = (tl_span_item)1 << 40;

// Adds the span of a column, for which there is room, if it is not outside the field.
static inline void add_heights(const walk *w, double low, double high, uint32_t column)
{
    uint32_t min, max;
    if (span_of_heights(low, high, w->band->height_voxels, &min, &max)) {
        tl_span_buffer_add(w->band->buffer, tl_span_item_make(column, min, max, w->area));
    }
}

static tl_result add_level_row(const walk *w, uint32_t row, int32_t first, int32_t last)
{
    tl_span_buffer *buffer = w->band->buffer;
    const uint32_t count = (uint32_t)(last - first + 1);
    TL_TRY(tl_span_buffer_reserve(buffer, count));
    const uint32_t column = (row - w->band->first_row) * w->band->width + (uint32_t)first;
    tl_span_item item = tl_span_item_make(column, w->level_min, w->level_max, w->area);
    tl_span_item *items = buffer->items + buffer->count;
    for (uint32_t i = 0; i < count; i++) {
        items[i] = item;
        item += NEXT_COLUMN;
    }
    tl_span_buffer_add_run(buffer, column, count);
    return TL_OK;
}

static inline uint64_t bits_of_double(double value)
{
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    return bits;
}

// The items of heights that all lie inside the field: what span_of_heights does, without a branch. One that takes no
// height still has a voxel: its top is at least a subdivision above its bottom.
static void pack_items(const double *restrict low, const double *restrict high, uint32_t count, tl_span_item item,
                       tl_span_item *restrict items)
{
    const uint64_t min_mask = tl_span_item_make(0, 0xffff, 0, 0), max_mask = tl_span_item_make(0, 0, 0xffff, 0);
    for (uint32_t i = 0; i < count; i++) {
        const double bottom = low[i] + WHOLE_ROUNDER, top = tl_max_f64(high[i] + WHOLE_ROUNDER, bottom + 1.0);
        const uint64_t min = bits_of_double(bottom) << (24 - SUBDIVISION_BITS);
        const uint64_t max = bits_of_double(top + (SUBDIVISIONS - 1)) >> (SUBDIVISION_BITS - 8);
        items[i] = item | (min & min_mask) | (max & max_mask);
        item += NEXT_COLUMN;
    }
}

// Adds the spans that lie in low and high for the cells first..last of a row, and clears those.
static tl_result add_row(const walk *w, uint32_t row, int32_t first, int32_t last)
{
    tl_span_buffer *buffer = w->band->buffer;
    const uint32_t count = (uint32_t)(last - first + 1);
    TL_TRY(tl_span_buffer_reserve(buffer, count));
    const uint32_t column = (row - w->band->first_row) * w->band->width + (uint32_t)first;
    double *low = w->low + first, *high = w->high + first;
    if (w->inside) {
        pack_items(low, high, count, tl_span_item_make(column, 0, 0, w->area), buffer->items + buffer->count);
        tl_span_buffer_add_run(buffer, column, count);
    } else {
        for (uint32_t i = 0; i < count; i++) {
            add_heights(w, low[i], high[i], column + i);
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

// Widens the cells of 0 .. count - 1 that the edge from p to q passes, in one line of cells, and in a second one where
// `both`. Over a cell the edge takes the heights from one border to the next; its ends are what they are.
static inline void walk_profile(profile_point p, profile_point q, uint32_t count, cell_heights one, cell_heights two,
                                bool both)
{
    if (p.along > q.along) {
        const profile_point t = p;
        p = q;
        q = t;
    }
    int32_t first, last;
    cell_range(p.along, q.along, count, &first, &last);
    if (first > last) {
        return;
    }
    double before = p.y;
    if (first < last || p.along < (double)first || q.along > (double)(last + 1)) { // then p.along < q.along
        const double slope = (q.y - p.y) / (q.along - p.along);
        if (p.along < (double)first) {
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
        if (q.along > (double)(last + 1)) {
            q.y = p.y + ((double)(last + 1) - p.along) * slope;
        }
    }
    widen_cell(one.low, one.high, last, before, q.y);
    if (both) {
        widen_cell(two.low, two.high, last, before, q.y);
    }
}

// Widens the cells of the row at hand, and of the next one where `in_next`.
static inline void walk_edge(walk *w, const tl_voxel_point *p, const tl_voxel_point *q, bool in_next)
{
    const profile_point from = { p->x, p->y }, to = { q->x, q->y };
    const cell_heights here = { w->low, w->high }, next = { w->next_low, w->next_high };
    walk_profile(from, to, w->band->width, here, next, in_next);
}

// The piece in the row at hand reaches to the point, which lies in it or on its lines.
static inline void reach_of_row(walk *w, const tl_voxel_point *point)
{
    w->left = tl_min_f64(w->left, point->x);
    w->right = tl_max_f64(w->right, point->x);
}

// The cut between the row at hand and the next one.
static inline void add_row_cut(walk *w, const tl_voxel_point *p, const tl_voxel_point *q)
{
    w->next_left = tl_min_f64(p->x, q->x);
    w->next_right = tl_max_f64(p->x, q->x);
    w->left = tl_min_f64(w->left, w->next_left);
    w->right = tl_max_f64(w->right, w->next_right);
    if (!w->level) {
        walk_edge(w, p, q, true);
    }
}

static inline void add_edge_heights(walk *w, const tl_voxel_point *p, const tl_voxel_point *q)
{
    if (!w->level) {
        walk_edge(w, p, q, false);
    }
}

// The row at hand is complete: adds its spans, and the next one is at hand.
static tl_result finish_row(walk *w, uint32_t row)
{
    int32_t first, last;
    cell_range(w->left, w->right, w->band->width, &first, &last);
    if (first <= last) {
        TL_TRY(w->level ? add_level_row(w, row, first, last) : add_row(w, row, first, last));
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

// a, b, c in the order of comes_first; the rows first..last are the band's that it overlaps.
static tl_result walk_rows(walk *w, const tl_voxel_point *a, const tl_voxel_point *b, const tl_voxel_point *c,
                           int32_t first, int32_t last)
{
    const edge whole = make_edge(a, c), lower = make_edge(a, b), upper = make_edge(b, c);
    double line = (double)first;
    tl_voxel_point on_whole = *a, on_bent = *a; // where the two sides of the outline enter the row
    w->left = w->right = a->x;
    if (a->z < line) {
        on_whole = cross_line(&whole, line);
        on_bent = cross_line(b->z > line ? &lower : &upper, line);
        w->left = tl_min_f64(on_whole.x, on_bent.x);
        w->right = tl_max_f64(on_whole.x, on_bent.x);
        add_edge_heights(w, &on_whole, &on_bent);
    }
    for (int32_t row = first; row <= last; row++) {
        const double next = line + 1.0;
        tl_voxel_point whole_end = *c, bent_end = *c;
        const bool cut = c->z > next;
        if (cut) {
            whole_end = cross_line(&whole, next);
            bent_end = cross_line(b->z > next ? &lower : &upper, next);
            if (row < last) {
                add_row_cut(w, &whole_end, &bent_end);
            } else {
                add_edge_heights(w, &whole_end, &bent_end);
                reach_of_row(w, &whole_end);
                reach_of_row(w, &bent_end);
            }
        } else {
            reach_of_row(w, c);
        }
        add_edge_heights(w, &on_whole, &whole_end);
        if (b->z >= line && b->z <= next) {
            add_edge_heights(w, &on_bent, b);
            add_edge_heights(w, b, &bent_end);
            reach_of_row(w, b);
        } else {
            add_edge_heights(w, &on_bent, &bent_end);
        }
        TL_TRY(finish_row(w, (uint32_t)row));
        on_whole = whole_end;
        on_bent = bent_end;
        line = next;
    }
    return TL_OK;
}

// A triangle within one row of cells, such as a wall along x: its edges are walked as they are.
static tl_result walk_one_row(walk *w, const tl_voxel_point *a, const tl_voxel_point *b, const tl_voxel_point *c,
                              uint32_t row)
{
    w->left = tl_min_f64(a->x, tl_min_f64(b->x, c->x));
    w->right = tl_max_f64(a->x, tl_max_f64(b->x, c->x));
    add_edge_heights(w, a, c);
    add_edge_heights(w, a, b);
    add_edge_heights(w, b, c);
    return finish_row(w, row);
}

// A triangle within one column of cells, such as a wall along z: the same with x and z exchanged. a, b, c in the order
// of comes_first; the rows first..last are the band's that it overlaps.
static tl_result walk_one_column(walk *w, const tl_voxel_point *a, const tl_voxel_point *b, const tl_voxel_point *c,
                                 uint32_t column, int32_t first, int32_t last)
{
    const tl_voxel_band *band = w->band;
    tl_span_buffer *buffer = band->buffer;
    TL_TRY(tl_span_buffer_reserve(buffer, (uint32_t)(last - first + 1)));
    uint32_t cell = (uint32_t)first * band->width + column;
    if (w->level) {
        for (int32_t i = first; i <= last; i++, cell += band->width) {
            tl_span_buffer_add(buffer, tl_span_item_make(cell, w->level_min, w->level_max, w->area));
        }
        return TL_OK;
    }
    const double origin = (double)band->first_row;
    const profile_point p = { a->z - origin, a->y }, q = { b->z - origin, b->y }, r = { c->z - origin, c->y };
    const cell_heights heights = { w->low, w->high };
    walk_profile(p, r, band->row_count, heights, heights, false);
    walk_profile(p, q, band->row_count, heights, heights, false);
    walk_profile(q, r, band->row_count, heights, heights, false);
    for (int32_t i = first; i <= last; i++, cell += band->width) {
        add_heights(w, w->low[i], w->high[i], cell);
        w->low[i] = NO_LOW;
        w->high[i] = NO_HIGH;
    }
    if (last + 1 < (int32_t)band->row_count) { // what only touches the far end is in that cell
        w->low[last + 1] = NO_LOW;
        w->high[last + 1] = NO_HIGH;
    }
    return TL_OK;
}

// Whether a range lies within one cell, borders included. A single point on a border lies in the cell to its right.
static inline bool is_in_one_cell(double min, double max, double *cell_out)
{
    *cell_out = floor(min);
    return max <= *cell_out + 1.0;
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

tl_result tl_voxelize_triangle(const tl_voxel_band *band, tl_voxel_point a, tl_voxel_point b, tl_voxel_point c,
                               uint32_t area)
{
    if (is_first_end(&b, &a)) {
        swap_points(&a, &b);
    }
    if (is_first_end(&c, &b)) {
        swap_points(&b, &c);
        if (is_first_end(&b, &a)) {
            swap_points(&a, &b);
        }
    }
    if (band->closed_far_side) {
        close_far_side(band, &a, &b, &c);
    }
    double min_x = tl_min_f64(a.x, tl_min_f64(b.x, c.x)), max_x = tl_max_f64(a.x, tl_max_f64(b.x, c.x));
    double min_y = tl_min_f64(a.y, tl_min_f64(b.y, c.y)), max_y = tl_max_f64(a.y, tl_max_f64(b.y, c.y));
    if (max_x < 0.0 || min_x > (double)band->width || max_y < -1.0 || min_y > (double)band->height_voxels + 1.0) {
        return TL_OK;
    }
    int32_t first, last;
    cell_range(a.z - (double)band->first_row, c.z - (double)band->first_row, band->row_count, &first, &last);
    if (first > last) {
        return TL_OK;
    }
    a.y *= TL_SUBDIVISIONS;
    b.y *= TL_SUBDIVISIONS;
    c.y *= TL_SUBDIVISIONS;
    const size_t line = band->line;
    const double limit = (double)band->height_voxels * TL_SUBDIVISIONS;
    const bool inside = min_y >= 0.0 && max_y * TL_SUBDIVISIONS <= limit;
    walk w = { band, area, false, inside, 0, 0, band->heights, band->heights + line, NULL, NULL, 0, 0, 0, 0 };
    w.next_low = w.high + line;
    w.next_high = w.next_low + line;
    if (lies_in_one_layer(min_y * TL_SUBDIVISIONS, max_y * TL_SUBDIVISIONS, band->height_voxels)) {
        w.level = span_of_heights(min_y * TL_SUBDIVISIONS, max_y * TL_SUBDIVISIONS, band->height_voxels, &w.level_min,
                                  &w.level_max);
    }
    // Judged in the whole lattice, not in the band's or field's part of it: all that see a triangle treat it alike.
    double cell;
    if (is_in_one_cell(a.z, c.z, &cell)) {
        return walk_one_row(&w, &a, &b, &c, (uint32_t)first + band->first_row);
    }
    if (is_in_one_cell(min_x, max_x, &cell)) {
        const bool in_field = cell >= 0.0 && cell < (double)band->width;
        return in_field ? walk_one_column(&w, &a, &b, &c, (uint32_t)cell, first, last) : TL_OK;
    }
    return walk_rows(&w, &a, &b, &c, first + (int32_t)band->first_row, last + (int32_t)band->first_row);
}
