// SPDX-License-Identifier: MIT
//
// Floors packed in runs: how many each column has, their heights, their areas, and in which of the four directions each
// has a neighbour (packed_runs.c).
//
// Which floor lies beside another needs no number: links between two columns are mutual and do not cross, so the first
// linked floor of one goes with the first of the other, and so on (link_floors.c).
//
// DetourTileCache leaves its compression to the caller, most often a general one (FastLZ). Levels are flat and of one
// storey nearly everywhere, so runs do as well, in one pass that costs a few nanoseconds a floor.

#include "nav_obstacles/packed_floors.h"

#include "base/arena.h"
#include "base/assert.h"
#include "base/stage.h"
#include "nav_obstacles/obstacle_window.h"
#include "nav_obstacles/packed_runs.h"

#include <string.h>

// ---- Packing -----------------------------------------------------------------------------------------------

// What is packed besides floors and areas.
typedef struct pack_scratch {
    uint16_t *counts; ///< [columns] floors; heights take 16 bits, so no column has more
    uint8_t *links;   ///< [span_count] bit d: there is a neighbour in direction d
    uint8_t *bytes;   ///< [capacity]
    uint64_t columns, spans, capacity;
} pack_scratch;

static tl_result fill_scratch(const tl_nav_compact *compact, const tl_allocator *allocator, pack_scratch *s)
{
    s->counts = tl_allocate_array(allocator, s->columns, sizeof *s->counts);
    s->links = tl_allocate_array(allocator, s->spans, sizeof *s->links);
    if (s->counts == NULL || s->links == NULL) {
        return TL_ERR_MEMORY;
    }
    for (uint64_t c = 0; c < s->columns; c++) {
        s->counts[c] = (uint16_t)(compact->first_span[c + 1] - compact->first_span[c]);
    }
    for (uint32_t i = 0; i < compact->span_count; i++) {
        uint32_t links = 0;
        for (uint32_t d = 0; d < 4; d++) {
            links |= (uint32_t)(tl_nav_compact_neighbour(compact, i, d) != TL_NAV_NO_SPAN) << d;
        }
        s->links[i] = (uint8_t)links;
    }
    return TL_OK;
}

static tl_result pack(const tl_nav_compact *compact, const tl_allocator *allocator, pack_scratch *s,
                      tl_packed_floors *packed)
{
    TL_TRY(fill_scratch(compact, allocator, s));
    const tl_value_array parts[4] = { { (const uint8_t *)s->counts, sizeof *s->counts, s->columns },
                                      { (const uint8_t *)compact->floor, sizeof *compact->floor, s->spans },
                                      { compact->area, 1, s->spans },
                                      { s->links, 1, s->spans } };
    for (int k = 0; k < 4; k++) {
        s->capacity += tl_packed_runs_most_bytes(&parts[k]);
    }
    s->bytes = tl_allocate_array(allocator, s->capacity, 1);
    if (s->bytes == NULL) {
        return TL_ERR_MEMORY;
    }
    uint8_t *to = s->bytes;
    for (int k = 0; k < 4; k++) {
        packed->floors_at = k == 1 ? (uint64_t)(to - s->bytes) : packed->floors_at;
        packed->areas_at = k == 2 ? (uint64_t)(to - s->bytes) : packed->areas_at;
        to = tl_packed_runs_write(&parts[k], to);
    }
    const uint64_t size = (uint64_t)(to - s->bytes);
    packed->bytes = tl_allocate_array(allocator, size, 1);
    if (packed->bytes == NULL) {
        return TL_ERR_MEMORY;
    }
    memcpy(packed->bytes, s->bytes, (size_t)size);
    packed->size = size;
    return TL_OK;
}

// ---- Blocks: what lies where no obstacle has to be looked for ----------------------------------------------

enum { BLOCK_SIDE = 8 }; // columns

static uint32_t blocks_along(uint32_t columns)
{
    return (columns + BLOCK_SIDE - 1) / BLOCK_SIDE;
}

static tl_result fill_blocks(const tl_nav_compact *compact, const tl_allocator *allocator, tl_packed_floors *packed)
{
    const uint32_t blocks_x = blocks_along(compact->width);
    packed->block_count = blocks_x * blocks_along(compact->height);
    packed->blocks = tl_allocate_array(allocator, packed->block_count, sizeof *packed->blocks);
    if (packed->blocks == NULL) {
        return TL_ERR_MEMORY;
    }
    for (uint32_t b = 0; b < packed->block_count; b++) {
        packed->blocks[b] = (tl_floor_block){ UINT16_MAX, 0 };
    }
    for (uint32_t z = 0; z < compact->height; z++) {
        for (uint32_t x = 0; x < compact->width; x++) {
            tl_floor_block *block = &packed->blocks[z / BLOCK_SIDE * blocks_x + x / BLOCK_SIDE];
            const uint32_t *first = compact->first_span + (size_t)z * compact->width + x;
            for (uint32_t i = first[0]; i < first[1]; i++) {
                if (compact->area[i] != TL_NAV_NULL_AREA) {
                    block->low = compact->floor[i] < block->low ? compact->floor[i] : block->low;
                    block->high = compact->floor[i] > block->high ? compact->floor[i] : block->high;
                }
            }
        }
    }
    return TL_OK;
}

static bool block_is_in(const tl_packed_floors *packed, uint32_t block, const tl_aabb *box)
{
    const tl_floor_block *heights = &packed->blocks[block];
    const double origin = (double)packed->frame.lattice.origin.y, step = (double)packed->frame.cell_height;
    return heights->low <= heights->high && origin + (double)heights->high * step >= (double)box->min.y &&
           origin + (double)heights->low * step <= (double)box->max.y;
}

bool tl_packed_floors_reach(const tl_packed_floors *packed, tl_aabb box)
{
    if (packed->block_count == 0) {
        return false;
    }
    const tl_obstacle_window window = tl_obstacle_window_make(&packed->frame, box);
    const uint32_t blocks_x = blocks_along(packed->frame.width);
    for (uint32_t z = window.first_z / BLOCK_SIDE; z < blocks_along(window.end_z); z++) {
        for (uint32_t x = window.first_x / BLOCK_SIDE; x < blocks_along(window.end_x); x++) {
            if (block_is_in(packed, z * blocks_x + x, &box)) {
                return true;
            }
        }
    }
    return false;
}

// The fields without the arrays.
static tl_nav_compact frame_of(const tl_nav_compact *compact, const tl_allocator *allocator)
{
    tl_nav_compact frame = *compact;
    frame.first_span = NULL;
    frame.floor = frame.clearance = frame.distance = NULL;
    frame.area = NULL;
    frame.step = NULL;
    frame.neighbour = frame.region = NULL;
    frame.max_distance = 0;
    frame.region_count = 0;
    memset(&frame.region_stats, 0, sizeof frame.region_stats);
    frame.allocator = *allocator;
    return frame;
}

tl_result tl_floors_pack(const tl_nav_compact *compact, const tl_allocator *allocator, tl_packed_floors *packed_out)
{
    memset(packed_out, 0, sizeof *packed_out);
    if (compact->span_count == 0) {
        return TL_OK;
    }
    pack_scratch s = { NULL, NULL, NULL, (uint64_t)compact->width * compact->height, compact->span_count, 0 };
    const tl_result result = pack(compact, allocator, &s, packed_out);
    tl_release_array(allocator, s.counts, s.columns, sizeof *s.counts);
    tl_release_array(allocator, s.links, s.spans, sizeof *s.links);
    tl_release_array(allocator, s.bytes, s.capacity, 1);
    packed_out->frame = frame_of(compact, allocator);
    packed_out->has_steps = compact->step != NULL;
    if (result != TL_OK || fill_blocks(compact, allocator, packed_out) != TL_OK) {
        tl_packed_floors_free(packed_out);
        return TL_ERR_MEMORY;
    }
    return TL_OK;
}

void tl_packed_floors_free(tl_packed_floors *packed)
{
    tl_release_array(&packed->frame.allocator, packed->bytes, packed->size, 1);
    tl_release_array(&packed->frame.allocator, packed->blocks, packed->block_count, sizeof *packed->blocks);
    memset(packed, 0, sizeof *packed);
}

// ---- Unpacking ---------------------------------------------------------------------------------------------

static void link_pair_of_floors(const tl_nav_compact *compact, uint32_t a, uint32_t b, uint32_t direction)
{
    if (compact->step != NULL) {
        const int32_t step = (int32_t)(b - a);
        compact->step[4 * (size_t)a + direction] = (int16_t)step;
        compact->step[4 * (size_t)b + (direction ^ 2)] = (int16_t)-step;
    } else {
        compact->neighbour[4 * (size_t)a + direction] = b;
        compact->neighbour[4 * (size_t)b + (direction ^ 2)] = a;
    }
}

// Links the floors of a column with those of the column beside it in a direction: the linked ones in order.
static void link_packed_columns(const tl_nav_compact *compact, const uint8_t *links, uint32_t column, uint32_t beside,
                                uint32_t direction)
{
    uint32_t other = compact->first_span[beside];
    for (uint32_t i = compact->first_span[column]; i < compact->first_span[column + 1]; i++) {
        if ((links[i] >> direction & 1) == 0) {
            continue;
        }
        while ((links[other] >> (direction ^ 2) & 1) == 0) {
            other++;
        }
        TL_ASSERT(other < compact->first_span[beside + 1]);
        link_pair_of_floors(compact, i, other, direction);
        other++;
    }
}

// ---- Linking -----------------------------------------------------------------------------------------------

// Whether the floors of a stretch are linked with those `forward` after them in one direction, each with the one that
// stands as high in its column: then a floor has a link exactly where the other one has it back.
static bool are_linked_in_order(const uint8_t *links, uint32_t begin, uint32_t end, int32_t forward, uint32_t direction)
{
    const uint8_t *own = links + begin, *other = own + forward;
    const uint8_t bit = (uint8_t)(1u << direction), back = (uint8_t)(1u << (direction ^ 2));
    uint8_t differ = 0;
    for (uint32_t k = 0; k < end - begin; k++) {
        differ |= (uint8_t)(((own[k] & bit) == 0) ^ ((other[k] & back) == 0));
    }
    return differ == 0;
}

// The steps of a stretch of floors whose columns, and those all around, have `count` floors each.
static bool link_even_floors(const tl_nav_compact *compact, const uint8_t *links, uint32_t first_column,
                             uint32_t end_column, uint32_t count)
{
    // By the links of a floor, what is kept of its four steps.
    static const int16_t kept[16][4] = { { 0, 0, 0, 0 },   { -1, 0, 0, 0 },   { 0, -1, 0, 0 },   { -1, -1, 0, 0 },
                                         { 0, 0, -1, 0 },  { -1, 0, -1, 0 },  { 0, -1, -1, 0 },  { -1, -1, -1, 0 },
                                         { 0, 0, 0, -1 },  { -1, 0, 0, -1 },  { 0, -1, 0, -1 },  { -1, -1, 0, -1 },
                                         { 0, 0, -1, -1 }, { -1, 0, -1, -1 }, { 0, -1, -1, -1 }, { -1, -1, -1, -1 } };
    const uint32_t *first = compact->first_span, width = compact->width;
    const uint32_t begin = first[first_column], end = first[end_column];
    const int32_t to[4] = { -(int32_t)count, (int32_t)(first[first_column + width] - begin), (int32_t)count,
                            -(int32_t)(begin - first[first_column - width]) };
    for (uint32_t d = 0; d < 4 && count > 1; d++) {
        if (!are_linked_in_order(links, begin, end, to[d], d)) {
            return false;
        }
    }
    const int16_t steps[4] = { (int16_t)to[0], (int16_t)to[1], (int16_t)to[2], (int16_t)to[3] };
    uint64_t all, mask;
    memcpy(&all, steps, sizeof all);
    for (uint32_t i = begin; i < end; i++) {
        memcpy(&mask, kept[links[i]], sizeof mask);
        mask &= all;
        memcpy(compact->step + 4 * (size_t)i, &mask, sizeof mask);
    }
    return true;
}

// How many floors each column of a row has where the columns before and after it on z have as many, else 0.
static void find_even_columns(const tl_nav_compact *compact, uint32_t z, uint16_t *restrict even)
{
    const uint32_t width = compact->width, *row = compact->first_span + (size_t)z * width;
    if (z == 0 || z + 1 == compact->height) {
        memset(even, 0, width * sizeof *even);
        return;
    }
    const uint32_t *before = row - width, *after = row + width;
    for (uint32_t x = 0; x < width; x++) {
        const uint32_t count = row[x + 1] - row[x];
        const bool is_even = (before[x + 1] - before[x] == count) & (after[x + 1] - after[x] == count);
        even[x] = (uint16_t)(is_even ? count : 0);
    }
}

enum { MIN_EVEN_COLUMNS = 3 };

static void clear_floor_links(const tl_nav_compact *compact, uint32_t begin, uint32_t end)
{
    const size_t first = 4 * (size_t)begin, count = 4 * (size_t)(end - begin);
    if (compact->step != NULL) {
        memset(compact->step + first, 0, count * sizeof *compact->step);
    } else {
        memset(compact->neighbour + first, 0xff, count * sizeof *compact->neighbour); // TL_NAV_NO_SPAN
    }
}

// Links the floors of a row's even stretches, leaves 1 in `is_done` for their columns, and clears the links of others.
static void link_even_columns(const tl_nav_compact *compact, const uint8_t *links, uint32_t z, uint16_t *even,
                              uint8_t *is_done)
{
    const uint32_t width = compact->width, row = z * width, *first = compact->first_span + row;
    uint32_t cleared = 0;
    find_even_columns(compact, z, even);
    for (uint32_t x = 0, end; x < width; x = end) {
        for (end = x + 1; end < width && even[end] == even[x]; end++) {
        }
        if (even[x] != 0 && end - x >= MIN_EVEN_COLUMNS &&
            link_even_floors(compact, links, row + x + 1, row + end - 1, even[x])) {
            memset(is_done + x + 1, 1, end - x - 2);
            clear_floor_links(compact, first[cleared], first[x + 1]);
            cleared = end - 1;
        }
    }
    clear_floor_links(compact, first[cleared], first[width]);
}

// The next of `count` columns from `at` on that is not done; `count` when all are.
static uint32_t next_open_column(const uint8_t *is_done, uint32_t count, uint32_t at)
{
    const uint8_t *open = (const uint8_t *)memchr(is_done + at, 0, count - at);
    return open != NULL ? (uint32_t)(open - is_done) : count;
}

// Links the other columns with those around them. What lies before them on an axis has done so, unless it is one of the
// even ones, which write their own links only.
static void link_other_columns(const tl_nav_compact *compact, const uint8_t *links, const uint8_t *is_done)
{
    const uint32_t width = compact->width, count = width * compact->height;
    for (uint32_t c = 0; (c = next_open_column(is_done, count, c)) < count; c++) {
        const uint32_t x = c % width;
        if (compact->first_span[c] == compact->first_span[c + 1]) {
            continue;
        }
        if (x + 1 < width) {
            link_packed_columns(compact, links, c, c + 1, 2);
        }
        if (c + width < count) {
            link_packed_columns(compact, links, c, c + width, 1);
        }
        if (x > 0 && is_done[c - 1]) {
            link_packed_columns(compact, links, c, c - 1, 0);
        }
        if (c >= width && is_done[c - width]) {
            link_packed_columns(compact, links, c, c - width, 3);
        }
    }
}

void tl_floors_link(const tl_floors_scratch *scratch, tl_nav_compact *compact)
{
    memset(scratch->is_done, 0, (size_t)compact->width * compact->height);
    if (compact->step == NULL) {
        clear_floor_links(compact, 0, compact->span_count);
    }
    for (uint32_t z = 0; z < compact->height && compact->step != NULL; z++) {
        link_even_columns(compact, scratch->links, z, scratch->even, scratch->is_done + (size_t)z * compact->width);
    }
    link_other_columns(compact, scratch->links, scratch->is_done);
}

static void fill_floors(const tl_packed_floors *packed, const tl_nav_compact *compact, uint16_t *counts, uint8_t *links)
{
    const uint64_t columns = (uint64_t)compact->width * compact->height, spans = compact->span_count;
    const uint8_t *from = tl_packed_runs_read(packed->bytes, sizeof *counts, columns, counts);
    from = tl_packed_runs_read(from, sizeof *compact->floor, spans, compact->floor);
    from = tl_packed_runs_read(from, 1, spans, compact->area);
    from = tl_packed_runs_read(from, 1, spans, links);
    TL_ASSERT(from == packed->bytes + packed->size);
    (void)from;
    uint32_t end = 0;
    for (uint64_t c = 0; c < columns; c++) {
        compact->first_span[c] = end;
        end += counts[c];
    }
    compact->first_span[columns] = end;
}

// The next `size` bytes of a block, from a multiple of 8 on.
static void *take_bytes(uint8_t **at, uint64_t size)
{
    void *taken = *at;
    *at += (size + 7) / 8 * 8;
    return taken;
}

tl_result tl_floors_unpack(const tl_packed_floors *packed, tl_floors_scratch *scratch, tl_nav_compact *compact_out,
                           uint8_t **base_area_out)
{
    const uint64_t columns = (uint64_t)packed->frame.width * packed->frame.height, spans = packed->frame.span_count;
    const uint64_t link_size = 4 * (packed->has_steps ? sizeof(int16_t) : sizeof(uint32_t));
    // Of a column its begin and its count, of a floor its links twice, its height and its area twice; of a row what
    // linking takes besides the counts' room, which it uses again; the gaps between.
    const uint64_t row_size = packed->frame.width * sizeof(uint16_t);
    const uint64_t size = columns * 6 + row_size + 4 + spans * (link_size + 5) + 7 * UINT64_C(8);
    if (scratch->size < size) {
        tl_release_array(scratch->allocator, scratch->block, scratch->size, 1);
        scratch->size = 0;
        scratch->block = tl_allocate_array(scratch->allocator, size, 1);
        if (scratch->block == NULL) {
            return TL_ERR_MEMORY;
        }
        scratch->size = size;
    }
    uint8_t *at = scratch->block;
    *compact_out = packed->frame;
    void *links_out = take_bytes(&at, spans * link_size);
    compact_out->step = packed->has_steps ? (int16_t *)links_out : NULL;
    compact_out->neighbour = packed->has_steps ? NULL : (uint32_t *)links_out;
    compact_out->first_span = take_bytes(&at, (columns + 1) * sizeof *compact_out->first_span);
    compact_out->floor = take_bytes(&at, spans * sizeof *compact_out->floor);
    uint16_t *counts = take_bytes(&at, columns * sizeof *counts + row_size);
    compact_out->area = take_bytes(&at, spans);
    uint8_t *base_area = take_bytes(&at, spans), *links = take_bytes(&at, spans);
    TL_ASSERT(at <= (uint8_t *)scratch->block + scratch->size);
    fill_floors(packed, compact_out, counts, links);
    scratch->links = links;
    scratch->even = counts; // whose last reader is done
    scratch->is_done = (uint8_t *)(counts + packed->frame.width);
    memcpy(base_area, compact_out->area, (size_t)spans);
    *base_area_out = base_area;
    return TL_OK;
}

void tl_floors_scratch_free(tl_floors_scratch *scratch)
{
    tl_release_array(scratch->allocator, scratch->block, scratch->size, 1);
    memset(scratch, 0, sizeof *scratch);
}
