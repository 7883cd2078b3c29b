// SPDX-License-Identifier: MIT
//
// The three filters and the floors that pass them, in one sweep over the rows.
//
// Of a column only the gaps between its spans that an agent fits into matter: to its neighbours' ledges, and to its own
// floors. A row's gaps are laid out in blocks of columns, the lowest gaps of all columns side by side, then the second
// ones, and so on; so one layer of a block is compared with one layer of the block beside in a loop without branches,
// which compilers make eight columns wide. Layers whose heights are apart are not compared at all: mostly one or two
// are left.
//
// Rejected: to walk up two columns at a time, or up each neighbour for each floor. Both take a branch a gap, which
// cities of hollow houses keep unpredictable. Recast's filters are passes over linked spans. The rules are those of
// filter_low_hanging.c, filter_ledge.c and filter_low_height.c, which are the filters one by one.

#include "nav_bake/floors/open_floors.h"

#include "base/arena.h"
#include "base/assert.h"
#include "nav_bake/voxels/column.h"

#include <string.h>

enum {
    BLOCK = 32,         // columns
    STRIDE = BLOCK + 2, // with those beside it
    ROWS = 3,           // the row at hand, and those beside it
    MIN_FLOORS = 512    // that the first allocation has room for
};

// Heights of 0 .. 0xffff as signed 16 bits: SSE2 has no minimum of unsigned ones.
typedef int16_t biased_floor;

#define LOWEST  INT16_MIN // below all floors: a floor's height is at least 1
#define HIGHEST INT16_MAX

static inline biased_floor bias(int32_t height)
{
    return (biased_floor)(height - 0x8000);
}

/// One gap of each column of a block, where it has so many.
typedef struct tl_gap_layer {
    biased_floor floor[STRIDE];   ///< HIGHEST where there is none
    biased_floor ceiling[STRIDE]; ///< HIGHEST: the sky, no span begins so high
    biased_floor top[STRIDE];   ///< the highest floor from which an agent fits into the gap; LOWEST where there is none
    biased_floor down[STRIDE];  ///< the lowest floor from which one can climb to the gap's
    biased_floor lowest[BLOCK]; ///< floors that one can step or fall to from the gap
    biased_floor highest[BLOCK];
    uint8_t area[STRIDE]; ///< of the floor, after the filters so far
    bool has_floors;      ///< any area is not 0
    biased_floor min_floor, greatest_top;
} layer;

typedef struct tl_gap_block {
    biased_floor under[STRIDE]; ///< the highest floor from which one falls under the column's lowest span; LOWEST: none
    uint32_t count[STRIDE];     ///< gaps
    uint32_t first_layer, layer_count;
} block;

typedef struct floor_sweep {
    const tl_nav_config *config;
    tl_row_source *source;
    const tl_span_rows *rows; ///< of the source
    int32_t room, climb;
    uint32_t block_count;
    bool low_hanging, low_height;
    tl_open_scratch *scratch;
    tl_floors *floors;
    uint32_t *ends;
} floor_sweep;

tl_result tl_floors_allocate(tl_floors *floors, uint32_t capacity, const tl_allocator *allocator)
{
    memset(floors, 0, sizeof *floors);
    floors->floor = tl_allocate_array(allocator, capacity, 2 * sizeof *floors->floor + sizeof *floors->area);
    if (floors->floor == NULL) {
        return TL_ERR_MEMORY;
    }
    floors->clearance = floors->floor + capacity;
    floors->area = (uint8_t *)(floors->clearance + capacity);
    floors->capacity = capacity;
    return TL_OK;
}

void tl_floors_release(tl_floors *floors, const tl_allocator *allocator)
{
    tl_release_array(allocator, floors->floor, floors->capacity, 2 * sizeof *floors->floor + sizeof *floors->area);
    memset(floors, 0, sizeof *floors);
}

// Room for `more` floors behind those that are there.
static tl_result reserve_floors(tl_floors *floors, uint64_t more, const tl_allocator *allocator)
{
    const uint64_t needed = floors->count + more, half = (uint64_t)floors->capacity + floors->capacity / 2;
    uint64_t wanted = needed > half ? needed : half;
    wanted = wanted > MIN_FLOORS ? wanted : MIN_FLOORS;
    if (needed <= floors->capacity) {
        return TL_OK;
    }
    if (wanted >= UINT32_MAX) {
        return TL_ERR_LIMIT;
    }
    tl_floors grown;
    TL_TRY(tl_floors_allocate(&grown, (uint32_t)wanted, allocator));
    if (floors->count > 0) {
        tl_floors_append(&grown, floors);
    }
    tl_floors_release(floors, allocator);
    *floors = grown;
    return TL_OK;
}

void tl_floors_append(tl_floors *floors, const tl_floors *more)
{
    TL_ASSERT(more->count <= floors->capacity - floors->count);
    memcpy(floors->floor + floors->count, more->floor, more->count * sizeof *floors->floor);
    memcpy(floors->clearance + floors->count, more->clearance, more->count * sizeof *floors->clearance);
    memcpy(floors->area + floors->count, more->area, more->count * sizeof *floors->area);
    floors->count += more->count;
}

static void free_row(tl_open_row *row, const tl_allocator *allocator)
{
    tl_release_array(allocator, row->blocks, row->block_capacity, sizeof(block));
    tl_release_array(allocator, row->layers, row->layer_capacity, sizeof(layer));
    memset(row, 0, sizeof *row);
}

void tl_open_scratch_free(tl_open_scratch *scratch)
{
    for (int k = 0; k < ROWS; k++) {
        free_row(&scratch->rows[k], scratch->allocator);
    }
}

// ---- The gaps of a row -------------------------------------------------------------------------------------

// As many layers as the block's columns, and those beside it, have spans.
static uint32_t layers_needed(const floor_sweep *s, const uint32_t *first, uint32_t b)
{
    const uint32_t begin = b * BLOCK - (b > 0), width = s->rows->width;
    const uint32_t end = (b + 1) * BLOCK < width ? (b + 1) * BLOCK + 1 : width;
    uint32_t most = 0;
    for (uint32_t x = begin; x < end; x++) {
        most = first[x + 1] - first[x] > most ? first[x + 1] - first[x] : most;
    }
    return most;
}

static tl_result lay_out_rows(const floor_sweep *s, const uint32_t *first, tl_open_row *row)
{
    const tl_allocator *allocator = s->scratch->allocator;
    if (row->block_capacity < s->block_count) {
        tl_release_array(allocator, row->blocks, row->block_capacity, sizeof(block));
        row->block_capacity = 0;
        row->blocks = tl_allocate_array(allocator, s->block_count, sizeof(block));
        if (row->blocks == NULL) {
            return TL_ERR_MEMORY;
        }
        row->block_capacity = s->block_count;
    }
    uint64_t layers = 0;
    for (uint32_t b = 0; b < s->block_count; b++) {
        row->blocks[b].first_layer = (uint32_t)layers;
        row->blocks[b].layer_count = layers_needed(s, first, b);
        layers += row->blocks[b].layer_count;
    }
    if (row->layers == NULL || row->layer_capacity < layers) {
        tl_release_array(allocator, row->layers, row->layer_capacity, sizeof(layer));
        row->layer_capacity = 0;
        row->layers = tl_allocate_array(allocator, layers, sizeof(layer));
        if (row->layers == NULL) {
            return TL_ERR_MEMORY;
        }
        row->layer_capacity = layers;
    }
    return TL_OK;
}

static void clear_block(const tl_open_row *row, block *b)
{
    for (uint32_t i = 0; i < STRIDE; i++) {
        b->under[i] = HIGHEST; // columns without spans, and those beyond the field
        b->count[i] = 0;
    }
    for (uint32_t k = 0; k < b->layer_count; k++) {
        layer *l = &row->layers[b->first_layer + k];
        for (uint32_t i = 0; i < STRIDE; i++) {
            l->floor[i] = HIGHEST;
            l->ceiling[i] = LOWEST;
        }
        memset(l->area, TL_NAV_NULL_AREA, sizeof l->area);
    }
}

// Puts the gaps above the spans [i, end) of a column into place `at` of its block's layers, with the areas that the
// column's own filters leave. Returns how many there are. Low-hanging: a span that one can step onto from the walkable
// span below it has that one's area; one may be stepped on, not a pile of them.
//
// A gap that is too low does no harm in its place: its top is below its floor, so nothing sees it, and it is
// overwritten by the next one or not counted.
static uint32_t list_column(const floor_sweep *s, uint32_t i, uint32_t end, layer *layers, uint32_t at)
{
    const tl_nav_span *spans = s->rows->spans;
    const int32_t room = s->room, climb = s->climb;
    const bool low_hanging = s->low_hanging, low_height = s->low_height;
    layer *l = layers;
    uint32_t area_below = TL_NAV_NULL_AREA;
    int32_t highest_step = -1; // of a span that is not walkable, above one that is
    for (; i < end; i++) {
        const int32_t floor = spans[i].max, ceiling = i + 1 < end ? spans[i + 1].min : 0xffff;
        const uint32_t own_area = spans[i].area;
        uint32_t area = floor <= highest_step && own_area == TL_NAV_NULL_AREA ? area_below : own_area;
        highest_step = low_hanging && own_area != TL_NAV_NULL_AREA ? floor + climb : -1;
        area_below = area;
        const bool fits = ceiling - floor >= room || i + 1 == end;
        area = fits || !low_height ? area : TL_NAV_NULL_AREA;
        l->floor[at] = bias(floor);
        l->ceiling[at] = bias(ceiling);
        l->area[at] = (uint8_t)area;
        l += fits || area != TL_NAV_NULL_AREA;
    }
    return (uint32_t)(l - layers);
}

// The column beside a block, which belongs to another one.
static void copy_column(const tl_open_row *row, const block *from, uint32_t from_at, block *to, uint32_t to_at)
{
    to->under[to_at] = from->under[from_at];
    for (uint32_t k = 0; k < from->count[from_at]; k++) {
        const layer *l = &row->layers[from->first_layer + k];
        row->layers[to->first_layer + k].floor[to_at] = l->floor[from_at];
        row->layers[to->first_layer + k].ceiling[to_at] = l->ceiling[from_at];
    }
}

// What follows from the floors and ceilings of a layer. In short loops over constants, which compilers make eight
// columns wide.
static void finish_layer(const floor_sweep *s, layer *l)
{
    const biased_floor room = (biased_floor)s->room, climb = (biased_floor)s->climb; // both are below 2^15
    const biased_floor min_ceiling = (biased_floor)(LOWEST + room), min_step = (biased_floor)(LOWEST + climb);
    const biased_floor *restrict floors = l->floor, *restrict ceilings = l->ceiling;
    biased_floor *restrict tops = l->top, *restrict downs = l->down;
    for (uint32_t i = 0; i < STRIDE; i++) {
        const biased_floor ceiling = ceilings[i] > min_ceiling ? ceilings[i] : min_ceiling;
        tops[i] = ceilings[i] == HIGHEST ? HIGHEST : (biased_floor)(ceiling - room);
    }
    for (uint32_t i = 0; i < STRIDE; i++) {
        const biased_floor floor = floors[i] > min_step ? floors[i] : min_step;
        downs[i] = (biased_floor)(floor - climb);
    }
    biased_floor least = HIGHEST, greatest = LOWEST;
    for (uint32_t i = 0; i < STRIDE; i++) {
        least = floors[i] < least ? floors[i] : least;
        greatest = tops[i] > greatest ? tops[i] : greatest;
    }
    uint8_t any = 0;
    for (uint32_t i = 0; i < STRIDE; i++) {
        any |= l->area[i];
    }
    l->min_floor = least;
    l->greatest_top = greatest;
    l->has_floors = any != TL_NAV_NULL_AREA;
}

static void finish_block(const floor_sweep *s, const tl_open_row *row, const block *b)
{
    for (uint32_t k = 0; k < b->layer_count; k++) {
        finish_layer(s, &row->layers[b->first_layer + k]);
    }
}

static tl_result list_gaps(floor_sweep *s, uint32_t z)
{
    TL_TRY(tl_row_source_seek(s->source, z));
    const uint32_t width = s->rows->width, *first = tl_span_rows_at(s->rows, z);
    tl_open_row *row = &s->scratch->rows[z % ROWS];
    row->span_count = first[width] - first[0];
    TL_TRY(lay_out_rows(s, first, row));
    for (uint32_t k = 0; k < s->block_count; k++) {
        block *b = &row->blocks[k];
        layer *layers = row->layers + b->first_layer;
        const uint32_t left = width - k * BLOCK, columns = left < BLOCK ? left : BLOCK;
        clear_block(row, b);
        for (uint32_t at = 1; at <= columns; at++) {
            const uint32_t i = first[k * BLOCK + at - 1], end = first[k * BLOCK + at];
            if (i < end) {
                const int32_t under = s->rows->spans[i].min - s->room;
                b->under[at] = bias(under > 0 ? under : 0);
                b->count[at] = list_column(s, i, end, layers, at);
            }
        }
        if (k > 0) {
            copy_column(row, b - 1, BLOCK, b, 0);
            copy_column(row, b, 1, b - 1, BLOCK + 1);
            finish_block(s, row, b - 1);
        }
    }
    finish_block(s, row, &row->blocks[s->block_count - 1]);
    return TL_OK;
}

// ---- Ledges ------------------------------------------------------------------------------------------------

// Widens the ranges of a layer's gaps by those that they see in a layer beside, which begins `shift` columns further. A
// floor too high for a step is a wall.
static void look_at_layer(layer *restrict own, const layer *beside, uint32_t shift)
{
    const biased_floor *restrict floor = own->floor + 1, *restrict top = own->top + 1;
    const biased_floor *beside_floor = beside->floor + shift, *beside_top = beside->top + shift,
                       *beside_down = beside->down + shift;
    for (uint32_t i = 0; i < BLOCK; i++) {
        const biased_floor f = floor[i], g = beside_floor[i];
        const biased_floor ceiling = top[i] < beside_top[i] ? top[i] : beside_top[i], bottom = f > g ? f : g;
        const biased_floor reached = ((ceiling >= bottom) & (beside_down[i] <= f)) ? g : f;
        own->lowest[i] = reached < own->lowest[i] ? reached : own->lowest[i];
        own->highest[i] = reached > own->highest[i] ? reached : own->highest[i];
    }
}

// The highest floor beside each column from which one falls under the column's neighbours.
static void join_under(const block *b, const block *above, const block *below, biased_floor *restrict under)
{
    const biased_floor *left = b->under, *right = b->under + 2, *up = above->under + 1, *down = below->under + 1;
    for (uint32_t i = 0; i < BLOCK; i++) {
        const biased_floor along = left[i] > right[i] ? left[i] : right[i], across = up[i] > down[i] ? up[i] : down[i];
        under[i] = along > across ? along : across;
    }
}

static void look_under(layer *restrict own, const biased_floor *restrict under)
{
    const biased_floor *restrict floor = own->floor + 1, *restrict top = own->top + 1;
    for (uint32_t i = 0; i < BLOCK; i++) {
        own->lowest[i] = ((top[i] >= floor[i]) & (under[i] >= floor[i])) ? LOWEST : floor[i];
    }
}

// Floors beside ledges lose their areas.
static void drop_ledges(const floor_sweep *s, layer *l)
{
    const int32_t climb = s->climb;
    for (uint32_t i = 0; i < BLOCK; i++) {
        const int32_t lowest = l->lowest[i], highest = l->highest[i];
        l->area[i + 1] = lowest == LOWEST || highest - lowest > climb ? TL_NAV_NULL_AREA : l->area[i + 1];
    }
}

static void look_at_block(layer *own, const tl_open_row *row, const block *beside, uint32_t shift)
{
    for (uint32_t k = 0; k < beside->layer_count; k++) {
        const layer *l = &row->layers[beside->first_layer + k];
        if (l->greatest_top >= own->min_floor && own->greatest_top >= l->min_floor) {
            look_at_layer(own, l, shift);
        }
    }
}

// What the gaps above a row's walkable floors reach decides whether these stay.
static void filter_ledge_row(const floor_sweep *s, uint32_t z)
{
    const tl_open_row *above = &s->scratch->rows[(z + ROWS - 1) % ROWS], *row = &s->scratch->rows[z % ROWS],
                      *below = &s->scratch->rows[(z + 1) % ROWS];
    for (uint32_t k = 0; k < s->block_count; k++) {
        const block *b = &row->blocks[k];
        biased_floor under[BLOCK];
        join_under(b, &above->blocks[k], &below->blocks[k], under);
        for (uint32_t j = 0; j < b->layer_count; j++) {
            layer *l = &row->layers[b->first_layer + j];
            if (!l->has_floors) {
                continue;
            }
            look_under(l, under);
            memcpy(l->highest, l->floor + 1, sizeof l->highest);
            look_at_block(l, row, b, 0);
            look_at_block(l, row, b, 2);
            look_at_block(l, above, &above->blocks[k], 1);
            look_at_block(l, below, &below->blocks[k], 1);
            drop_ledges(s, l);
        }
    }
}

// ---- Floors ------------------------------------------------------------------------------------------------

// Appends the floors of a block's columns that are left; the next one takes the place of what was written for one that
// is not.
static void append_block(tl_floors *floors, const block *b, const layer *layers, uint32_t columns, uint32_t *ends)
{
    uint16_t *restrict floor_out = floors->floor, *restrict clearance_out = floors->clearance;
    uint8_t *restrict area_out = floors->area;
    uint32_t to = floors->count;
    for (uint32_t at = 1; at <= columns; at++) {
        for (const layer *l = layers; l < layers + b->count[at]; l++) {
            const int32_t floor = l->floor[at], ceiling = l->ceiling[at];
            floor_out[to] = (uint16_t)(floor + 0x8000);
            clearance_out[to] = (uint16_t)(ceiling == HIGHEST ? 0xffff : ceiling - floor);
            area_out[to] = l->area[at];
            to += l->area[at] != TL_NAV_NULL_AREA;
        }
        ends[at - 1] = to;
    }
    floors->count = to;
}

// Beyond the field nothing is known: its rim counts as a ledge.
static void drop_rim(tl_open_row *row, uint32_t begin, uint32_t end)
{
    for (uint32_t x = begin; x < end; x++) {
        const block *b = &row->blocks[x / BLOCK];
        for (uint32_t k = 0; k < b->layer_count; k++) {
            row->layers[b->first_layer + k].area[x % BLOCK + 1] = TL_NAV_NULL_AREA;
        }
    }
}

static tl_result append_row(floor_sweep *s, uint32_t z)
{
    const uint32_t width = s->rows->width;
    tl_open_row *row = &s->scratch->rows[z % ROWS];
    s->scratch->span_count += row->span_count;
    TL_TRY(reserve_floors(s->floors, (uint64_t)row->span_count + 1, s->scratch->allocator));
    if (s->config->filter_ledge_spans) {
        const bool end_row = z == 0 || z + 1 == s->rows->field_height;
        drop_rim(row, 0, end_row ? width : 1);
        drop_rim(row, width - 1, width);
        if (!end_row) {
            filter_ledge_row(s, z);
        }
    }
    for (uint32_t k = 0; k < s->block_count; k++) {
        const block *b = &row->blocks[k];
        const uint32_t left = width - k * BLOCK, columns = left < BLOCK ? left : BLOCK;
        append_block(s->floors, b, row->layers + b->first_layer, columns, s->ends);
        s->ends += columns;
    }
    return TL_OK;
}

tl_result tl_open_rows(const tl_nav_config *config, tl_row_source *source, uint32_t begin, uint32_t end,
                       tl_open_scratch *scratch, tl_floors *floors, uint32_t *ends_out)
{
    floor_sweep s;
    memset(&s, 0, sizeof s);
    s.config = config;
    s.source = source;
    s.rows = &source->rows;
    s.room = (int32_t)config->walkable_height;
    s.climb = (int32_t)config->walkable_climb;
    s.block_count = (s.rows->width - 1) / BLOCK + 1;
    s.low_hanging = config->filter_low_hanging_obstacles;
    s.low_height = config->filter_walkable_low_height_spans;
    s.scratch = scratch;
    s.floors = floors;
    s.ends = ends_out;
    const bool ledges = config->filter_ledge_spans;
    const uint32_t first = ledges && begin > 0 ? begin - 1 : begin;
    const uint32_t last = ledges && end < s.rows->field_height ? end : end - 1;
    for (uint32_t z = first; z <= last; z++) {
        TL_TRY(list_gaps(&s, z));
        if (z > begin) {
            TL_TRY(append_row(&s, z - 1));
        }
    }
    if (last < end) {
        TL_TRY(append_row(&s, last));
    }
    return TL_OK;
}
