// SPDX-License-Identifier: MIT
//
// Contour trace: the outlines of all regions, edge by edge of the lattice.
//
// A floor's edge is on an outline when the floor across it has another region, or is none. A walk keeps its region on
// the right: along such an edge it turns clockwise, through any other edge it steps and turns back. Vertices get the
// height of the highest floor that meets in them. Each edge knows its twin, the same edge in the outline of the region
// across, so that later stages can do to both sides what they do to one.
// Source: Mononen, Recast (walk, corner heights, border vertices).
//
// Differences from Recast: a region of one column is traced like any other; the region across is kept in 32 bits.

#include "nav_bake/contours/contours.h"

#include "base/assert.h"
#include "base/host.h"
#include "nav_bake/floors/links.h"

#include <string.h>

enum {
    MIN_RUN = 8, // of floors that are worth a loop of their own
    LONGEST_RUN = 64,
    MIN_TRACE_BLOCK = 8192 // floors
};

typedef struct tracer {
    tl_contour_work *work;
    uint8_t *outline;      // [span_count + 8] bit d: edge d is on an outline; bit d + 4: and was not walked yet
    uint32_t *first_edge;  // [span_count / 8 + 1] outline edges of the floors before each eighth one
    uint32_t *vertex_of;   // [outline edges] the raw vertex where that edge starts, once it was walked
    uint32_t block_size;   // floors that one task marks
    uint64_t *block_edges; // outline edges of a block, then of those before it
    uint32_t loop_capacity;
    uint64_t steps_left; // a walk leaves each pair (floor, direction) once: 4 a floor
} tracer;

static inline bool is_traced(uint32_t region)
{
    return region != 0 && (region & TL_NAV_BORDER_REGION) == 0;
}

// Bits set in the low halves of eight bytes.
static inline uint32_t count_edges(uint64_t outlines)
{
    uint64_t bits = outlines & 0x0f0f0f0f0f0f0f0fu;
    bits -= (bits >> 1) & 0x0505050505050505u;
    bits = (bits & 0x0303030303030303u) + ((bits >> 2) & 0x0303030303030303u);
    return (uint32_t)((bits * 0x0101010101010101u) >> 56);
}

// The outlines of the eight floors from `first` on, the lowest byte first on any machine. Compilers know this form as
// one load; not so a loop.
static inline uint64_t eight_outlines(const tracer *t, uint32_t first)
{
    const uint8_t *o = t->outline + first;
    return (uint64_t)o[0] | (uint64_t)o[1] << 8 | (uint64_t)o[2] << 16 | (uint64_t)o[3] << 24 | (uint64_t)o[4] << 32 |
           (uint64_t)o[5] << 40 | (uint64_t)o[6] << 48 | (uint64_t)o[7] << 56;
}

// Edges are numbered by floor, then by direction; a number for each eighth floor says where to begin counting.
static inline uint32_t edge_index(const tracer *t, uint32_t floor, uint32_t direction)
{
    const uint32_t place = 8 * (floor & 7u) + direction;
    const uint64_t before = eight_outlines(t, floor & ~7u) & ((UINT64_C(1) << place) - 1);
    return t->first_edge[floor / 8] + count_edges(before);
}

static inline bool is_open_edge(const tracer *t, uint32_t floor, uint32_t direction)
{
    return (t->outline[floor] >> (direction + 4) & 1) != 0;
}

// The outline edges of one floor: those beyond which there is no floor, or one of another region.
static inline uint32_t outline_of(const tl_nav_compact *compact, uint32_t floor)
{
    const uint32_t region = compact->region[floor];
    if (!is_traced(region)) {
        return 0; // nobody asks for its edges
    }
    const tl_links links = tl_floor_links(compact, floor);
    uint32_t mask = 0;
    for (uint32_t d = 0; d < 4; d++) {
        mask |= (uint32_t)(links.to[d] == TL_NAV_NO_SPAN || compact->region[links.to[d]] != region) << d;
    }
    return mask;
}

// Adds a bit to those floors of a run that have another region than what lies beside them.
static inline void add_where_differs(const uint32_t *own, const uint32_t *beside, uint32_t count, uint32_t bit,
                                     uint32_t *restrict mask)
{
    for (uint32_t k = 0; k < count; k++) {
        mask[k] |= own[k] != beside[k] ? bit : 0;
    }
}

// The same of a run of floors that all step alike: their neighbours too follow one another in memory.
static void outlines_of_run(const tl_nav_compact *compact, uint32_t first, uint32_t count, uint8_t *restrict outline)
{
    const uint32_t *own = compact->region + first;
    const int16_t *step = compact->step + 4 * (size_t)first;
    uint32_t mask[LONGEST_RUN], always = 0;
    for (uint32_t d = 0; d < 4; d++) {
        always |= (uint32_t)(step[d] == 0) << d; // nothing lies beside; and a floor does not differ from itself
    }
    for (uint32_t k = 0; k < count; k++) {
        mask[k] = always;
    }
    add_where_differs(own, own + step[0], count, 1, mask);
    add_where_differs(own, own + step[1], count, 2, mask);
    add_where_differs(own, own + step[2], count, 4, mask);
    add_where_differs(own, own + step[3], count, 8, mask);
    for (uint32_t k = 0; k < count; k++) {
        outline[k] = (uint8_t)(is_traced(own[k]) ? mask[k] : 0);
    }
}

// Marks the outlines of a block of floors, and counts them.
static void mark_outlines(uint32_t index, uint32_t worker, void *user)
{
    (void)worker;
    const tracer *t = user;
    const tl_nav_compact *compact = t->work->compact;
    const uint32_t begin = index * t->block_size, end = tl_block_end(index, t->block_size, compact->span_count);
    uint8_t *restrict outline = t->outline; // what pointers lead to would else be read again after each byte
    for (uint32_t i = begin, alike; i < end; i += alike) {
        if (!is_traced(compact->region[i])) {
            outline[i] = 0;
            alike = 1;
            continue;
        }
        const uint32_t most = end - i < LONGEST_RUN ? end - i : LONGEST_RUN;
        alike = compact->step != NULL ? tl_nav_steps_alike(compact, i, most) : 1;
        if (alike >= MIN_RUN) {
            outlines_of_run(compact, i, alike, outline + i);
        } else {
            for (uint32_t k = i; k < i + alike; k++) {
                outline[k] = (uint8_t)outline_of(compact, k);
            }
        }
    }
    uint32_t edge_count = 0; // below 4 * 2^30
    for (uint32_t i = begin; i < end; i += 8) {
        edge_count += count_edges(eight_outlines(t, i));
    }
    t->block_edges[index] = edge_count;
}

// Numbers the edges of a block, from those of the blocks before it on, and marks them as not yet walked.
static void number_edges(uint32_t index, uint32_t worker, void *user)
{
    (void)worker;
    const tracer *t = user;
    const uint32_t begin = index * t->block_size,
                   end = tl_block_end(index, t->block_size, t->work->compact->span_count);
    uint32_t edge_count = (uint32_t)t->block_edges[index];
    for (uint32_t i = begin; i < end; i += 8) {
        t->first_edge[i / 8] = edge_count;
        edge_count += count_edges(eight_outlines(t, i));
    }
    uint8_t *outline = t->outline;
    for (uint32_t i = begin; i < end; i++) {
        outline[i] = (uint8_t)(outline[i] * 0x11);
    }
}

// Finds all outline edges and returns how many they are, as the host's tasks in blocks of whole runs.
static tl_result find_edges(tracer *t, tl_arena *scratch, uint64_t *count_out)
{
    const uint32_t count = t->work->compact->span_count, workers = tl_worker_count(t->work->host);
    const uint32_t share = (count / workers / LONGEST_RUN + 1) * LONGEST_RUN;
    t->block_size = share > MIN_TRACE_BLOCK ? share : MIN_TRACE_BLOCK;
    const uint32_t block_count = tl_block_count(count, t->block_size);
    t->outline = TL_PUSH(scratch, uint8_t, (uint64_t)count + 8);
    t->first_edge = TL_PUSH(scratch, uint32_t, (uint64_t)count / 8 + 1);
    t->block_edges = TL_PUSH(scratch, uint64_t, block_count);
    if (t->outline == NULL || t->first_edge == NULL || t->block_edges == NULL) {
        return TL_ERR_MEMORY;
    }
    memset(t->outline + count, 0, 8);
    tl_run_tasks(t->work->host, mark_outlines, block_count, t);
    uint64_t edge_count = 0;
    for (uint32_t b = 0; b < block_count; b++) {
        const uint64_t of_block = t->block_edges[b];
        t->block_edges[b] = edge_count;
        edge_count += of_block;
    }
    if (edge_count >= UINT32_MAX) {
        return TL_ERR_LIMIT;
    }
    tl_run_tasks(t->work->host, number_edges, block_count, t);
    *count_out = edge_count;
    return TL_OK;
}

// The floors that meet in the corner behind edge `direction` of a floor, going clockwise: the floor itself, the one
// across the edge, the one diagonally across, the one across the next edge. Those that are not linked are
// TL_NAV_NO_SPAN.
typedef struct trace_corner {
    uint32_t floors[4];
    uint32_t height;
} trace_corner;

static trace_corner find_corner(const tl_nav_compact *compact, uint32_t floor, uint32_t direction, uint32_t across)
{
    uint32_t turned = (direction + 1) & 3;
    trace_corner c = { { floor, across, TL_NAV_NO_SPAN, tl_nav_compact_neighbour(compact, floor, turned) },
                       compact->floor[floor] };
    uint32_t first_way =
        c.floors[1] != TL_NAV_NO_SPAN ? tl_nav_compact_neighbour(compact, c.floors[1], turned) : TL_NAV_NO_SPAN;
    uint32_t other_way =
        c.floors[3] != TL_NAV_NO_SPAN ? tl_nav_compact_neighbour(compact, c.floors[3], direction) : TL_NAV_NO_SPAN;
    c.floors[2] = other_way != TL_NAV_NO_SPAN ? other_way : first_way;
    const uint32_t seen[4] = { c.floors[1], first_way, c.floors[3], other_way };
    for (int k = 0; k < 4; k++) {
        if (seen[k] != TL_NAV_NO_SPAN && compact->floor[seen[k]] > c.height) {
            c.height = compact->floor[seen[k]];
        }
    }
    return c;
}

// Whether a place in the tile without its border is on the line between the two: only there border floors meet others.
static inline bool is_on_border_line(const tl_nav_compact *compact, const tl_contour_vertex *v)
{
    const int64_t border = compact->border_size;
    return v->x == 0 || v->z == 0 || v->x == (int64_t)compact->width - 2 * border ||
           v->z == (int64_t)compact->height - 2 * border;
}

// Two floors of one border side beside two inner floors of one area: the vertex is there only because the outline bends
// or changes its neighbour on the tile's border. It is removed after merging, so that both tiles have the same edge.
static bool is_border_vertex(const tl_nav_compact *compact, const trace_corner *c)
{
    uint32_t region[4], area[4], any = 0;
    for (int k = 0; k < 4; k++) {
        region[k] = c->floors[k] != TL_NAV_NO_SPAN ? compact->region[c->floors[k]] : 0;
        any |= region[k];
    }
    if ((any & TL_NAV_BORDER_REGION) == 0) {
        return false; // as most
    }
    for (int k = 0; k < 4; k++) {
        area[k] = c->floors[k] != TL_NAV_NO_SPAN ? compact->area[c->floors[k]] : 0;
        if (region[k] == 0 && area[k] == 0) {
            return false;
        }
    }
    for (int k = 0; k < 4; k++) {
        int l = (k + 1) & 3, m = (k + 2) & 3, n = (k + 3) & 3;
        bool same_outside = (region[k] & TL_NAV_BORDER_REGION) != 0 && region[k] == region[l] && area[k] == area[l];
        bool inside = ((region[m] | region[n]) & TL_NAV_BORDER_REGION) == 0 && area[m] == area[n];
        if (same_outside && inside) {
            return true;
        }
    }
    return false;
}

// The low 16 bits of a vertex's flags: the region across, so that 0 means none and the border is told apart. Ids above
// 0x7fff repeat; nothing but information rests on them.
static uint32_t region_flags(uint32_t across)
{
    if (across == 0) {
        return 0;
    }
    uint32_t id = across & ~TL_NAV_BORDER_REGION;
    id = id > 0x7fff ? (id - 1) % 0x7fffu + 1 : id;
    return (across & TL_NAV_BORDER_REGION) != 0 ? id | 0x8000u : id;
}

// Links an edge with the same one as the floor across it has it, if that one is an outline and was walked already: of
// the two the later one finds the earlier.
static inline void link_twin(tracer *t, uint32_t vertex, uint32_t beside, uint32_t back)
{
    tl_contour_work *work = t->work;
    work->twin[vertex] = TL_NO_TWIN;
    if (beside != TL_NAV_NO_SPAN && (t->outline[beside] & (1u << back)) != 0 && !is_open_edge(t, beside, back)) {
        const uint32_t twin = t->vertex_of[edge_index(t, beside, back)];
        work->twin[vertex] = twin;
        work->twin[twin] = vertex;
    }
}

// Writes what belongs to the edge at its start vertex, and what belongs to its end vertex one place further.
static void emit_edge(tracer *t, uint32_t vertex, uint32_t floor, uint32_t direction, uint32_t x, uint32_t z)
{
    tl_contour_work *work = t->work;
    const tl_nav_compact *compact = work->compact;
    uint32_t beside = tl_nav_compact_neighbour(compact, floor, direction);
    uint32_t across = beside != TL_NAV_NO_SPAN ? compact->region[beside] : 0;
    bool area_border = beside != TL_NAV_NO_SPAN && compact->area[beside] != compact->area[floor];
    work->across[vertex] = across;
    work->vertices[vertex].flags |= region_flags(across) | (area_border ? TL_CONTOUR_AREA_BORDER : 0);
    t->vertex_of[edge_index(t, floor, direction)] = vertex;
    link_twin(t, vertex, beside, direction ^ 2);

    trace_corner c = find_corner(compact, floor, direction, beside);
    tl_contour_vertex *end = &work->vertices[vertex + 1];
    end->x = (int32_t)(x + (direction == 1 || direction == 2)) - (int32_t)compact->border_size;
    end->z = (int32_t)(z + (direction == 0 || direction == 1)) - (int32_t)compact->border_size;
    end->y = (int32_t)c.height;
    const bool is_border = is_on_border_line(compact, end) && is_border_vertex(compact, &c);
    end->flags = is_border ? TL_CONTOUR_BORDER_VERTEX : 0;
    if (work->guarded != NULL) {
        work->guarded[vertex] = work->near[floor];
    }
}

static int64_t loop_area2(const tl_contour_vertex *vertices, uint32_t count)
{
    int64_t area2 = 0; // exact: the sum of at most 2^30 columns, doubled
    for (uint32_t k = 0, previous = count - 1; k < count; previous = k++) {
        area2 += (int64_t)vertices[k].x * vertices[previous].z - (int64_t)vertices[previous].x * vertices[k].z;
    }
    return area2;
}

static tl_result close_loop(tracer *t, uint32_t first, uint32_t floor)
{
    tl_contour_work *work = t->work;
    if (work->loop_count == t->loop_capacity) {
        tl_contour_loop *grown = tl_arena_grow(work->arena, work->loops, &t->loop_capacity, 64, sizeof *grown);
        if (grown == NULL) {
            return TL_ERR_MEMORY;
        }
        work->loops = grown;
    }
    // The last edge's end is the first vertex, whose flags hold the first edge's share already.
    tl_contour_vertex last = work->vertices[work->vertex_count];
    uint32_t edge_flags = work->vertices[first].flags;
    work->vertices[first] = last;
    work->vertices[first].flags |= edge_flags;
    tl_contour_loop *loop = &work->loops[work->loop_count];
    loop->first = first;
    loop->count = work->vertex_count - first;
    loop->region = work->compact->region[floor];
    loop->area = work->compact->area[floor];
    loop->area2 = loop_area2(work->vertices + first, loop->count);
    for (uint32_t k = first; k < work->vertex_count; k++) {
        work->loop_of[k] = work->loop_count;
    }
    work->loop_count++;
    return TL_OK;
}

static tl_result walk_loop(tracer *t, uint32_t start, uint32_t start_x, uint32_t start_z)
{
    tl_contour_work *work = t->work;
    uint32_t floor = start, x = start_x, z = start_z, direction = 0, first = work->vertex_count;
    while (!is_open_edge(t, start, direction)) {
        direction++;
    }
    uint32_t start_direction = direction;
    work->vertices[first].flags = 0;
    do {
        if (t->steps_left-- == 0) {
            return TL_ERR_CORRUPT;
        }
        if ((t->outline[floor] & (1u << direction)) != 0) {
            if (!is_open_edge(t, floor, direction)) {
                return TL_ERR_CORRUPT;
            }
            t->outline[floor] = (uint8_t)(t->outline[floor] & ~(0x10u << direction));
            emit_edge(t, work->vertex_count++, floor, direction, x, z);
            direction = (direction + 1) & 3;
        } else {
            floor = tl_nav_compact_neighbour(work->compact, floor, direction);
            x += (direction == 2) - (uint32_t)(direction == 0);
            z += (direction == 1) - (uint32_t)(direction == 3);
            direction = (direction + 3) & 3;
        }
    } while (floor != start || direction != start_direction);
    return close_loop(t, first, start);
}

// The column of a floor within a row: the last one that begins at or before it.
static uint32_t column_of(const uint32_t *row, uint32_t width, uint32_t floor)
{
    uint32_t low = 0, high = width;
    while (high - low > 1) {
        uint32_t middle = low + (high - low) / 2;
        low = row[middle] <= floor ? middle : low;
        high = row[middle] <= floor ? high : middle;
    }
    return low;
}

static tl_result walk_all(tracer *t)
{
    const tl_nav_compact *compact = t->work->compact;
    const uint32_t count = compact->span_count;
    const uint32_t *row = compact->first_span;
    for (uint32_t eight = 0, z = 0; eight < count; eight += 8) {
        if ((eight_outlines(t, eight) & UINT64_C(0xf0f0f0f0f0f0f0f0)) == 0) {
            continue;
        }
        for (uint32_t i = eight; i < count && i < eight + 8; i++) {
            for (; i >= row[compact->width]; row += compact->width) {
                z++;
            }
            while (t->outline[i] >> 4 != 0) { // few floors begin a walk, so columns are looked up and not counted along
                TL_TRY(walk_loop(t, i, column_of(row, compact->width, i), z));
            }
        }
    }
    return TL_OK;
}

// What only the walk needs, in the scratch arena; what stays, in the work's.
static tl_result prepare_trace(tracer *t, tl_arena *scratch)
{
    tl_contour_work *work = t->work;
    uint64_t edge_count = 0;
    TL_TRY(find_edges(t, scratch, &edge_count));
    t->vertex_of = TL_PUSH(scratch, uint32_t, edge_count);
    work->vertices = TL_PUSH(work->arena, tl_contour_vertex, edge_count + 1); // one ahead while a loop is open
    work->across = TL_PUSH(work->arena, uint32_t, edge_count);
    work->twin = TL_PUSH(work->arena, uint32_t, edge_count);
    work->loop_of = TL_PUSH(work->arena, uint32_t, edge_count);
    work->guarded = work->near != NULL ? TL_PUSH_ZERO(work->arena, uint8_t, edge_count) : NULL;
    if (work->near != NULL && work->guarded == NULL) {
        return TL_ERR_MEMORY;
    }
    return t->vertex_of && work->vertices && work->across && work->twin && work->loop_of ? TL_OK : TL_ERR_MEMORY;
}

// A counting sort.
static tl_result group_by_region(tl_contour_work *work)
{
    const uint32_t region_count = work->compact->region_count;
    work->region_first = TL_PUSH_ZERO(work->arena, uint32_t, (uint64_t)region_count + 2);
    work->by_region = TL_PUSH(work->arena, uint32_t, work->loop_count);
    if (work->region_first == NULL || work->by_region == NULL) {
        return TL_ERR_MEMORY;
    }
    uint32_t *next = work->region_first + 1;
    for (uint32_t l = 0; l < work->loop_count; l++) {
        next[work->loops[l].region + 1]++;
    }
    for (uint32_t r = 1; r <= region_count; r++) {
        next[r] += next[r - 1];
    }
    for (uint32_t l = 0; l < work->loop_count; l++) {
        work->by_region[next[work->loops[l].region]++] = l;
    }
    return TL_OK;
}

tl_result tl_contours_trace(tl_contour_work *work)
{
    tracer t = { .work = work, .steps_left = 4 * (uint64_t)work->compact->span_count };
    tl_arena scratch;
    tl_arena_init(&scratch, &work->arena->allocator);
    tl_result result = prepare_trace(&t, &scratch);
    result = result == TL_OK ? walk_all(&t) : result;
    tl_arena_free(&scratch);
    return result == TL_OK ? group_by_region(work) : result;
}
