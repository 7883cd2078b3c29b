// SPDX-License-Identifier: MIT
//
// The nearest neighbours of an agent, from the grid: in a throng first those in the cells around its own, which are
// enough there; else all in reach. Which of them are nearest is a total order (by gap, then place), so the order of the
// scan does not count.
//
// Rows are scanned from the agent's own outward, each no farther than the circle in which agents still count. What is
// near is put in order at once at the end, or when there is a handful more than are wanted: then only nearer ones count
// from there on.

#include "nav_crowd/crowd_neighbors.h"

#include "base/min_max.h"
#include "nav_crowd/crowd_kernels.h"

#include <string.h>

// Half of a row's part is a root of a product of sums, times the cells of a metre: six roundings of half an ulp.
#define HALF_ROUNDING (8.0f * FLT_EPSILON)

// Distances are sums and a root of numbers up to the widest one: a share of it, four roundings and as many again.
#define DISTANCE_ROUNDING (8.0f * FLT_EPSILON)

// A place in a cell is a quotient, a product and a difference of doubles: a share of the coordinate.
#define PLACE_ROUNDING (4.0 * DBL_EPSILON)

// So many times the neighbours that are wanted, in the cells around an agent's own, are a throng: in half as many cells
// as the circle has, where most of them would not count.
#define THRONG 2u

typedef struct neighbor_search {
    const tl_nav_crowd *crowd;
    const crowd_kernels *kernels;
    float rounding; // metres: of distances
    uint32_t capacity;
    crowd_neighbor *nearest;
    crowd_scan scan;
} neighbor_search;

// A gap and the place that breaks ties, as a number in the same order. A gap is a difference, hence never -0.
static uint64_t order_of(const crowd_scan *scan, uint32_t i)
{
    uint32_t bits;
    memcpy(&bits, &scan->gap[i], sizeof bits);
    bits = (bits & 0x80000000u) != 0 ? ~bits : bits | 0x80000000u;
    return (uint64_t)bits << 32 | scan->seen->agents[scan->at[i]].agent;
}

// Where some gaps are equal.
static void rank_by_place(const crowd_scan *scan, uint32_t *ranks)
{
    uint64_t order[CROWD_MAX_FOUND];
    for (uint32_t i = 0; i < scan->count; i++) {
        order[i] = order_of(scan, i);
        ranks[i] = 0;
        for (uint32_t k = 0; k < i; k++) {
            const uint32_t is_before = order[k] < order[i];
            ranks[i] += is_before;
            ranks[k] += 1 - is_before;
        }
    }
}

// Puts what was found in order, and forgets all but the nearest. Nothing farther than the last of them counts then; by
// no less than the rounding of a distance. Returns how many they are.
static uint32_t keep_nearest(neighbor_search *search)
{
    crowd_scan *scan = &search->scan;
    uint32_t ranks[CROWD_MAX_FOUND];
    if (!search->kernels->rank(scan->gap, scan->count, ranks)) {
        rank_by_place(scan, ranks);
    }
    const uint32_t kept = tl_min_u32(scan->count, search->capacity);
    for (uint32_t i = 0; i < scan->count; i++) {
        if (ranks[i] < kept) {
            const crowd_neighbor neighbor = { scan->gap[i], scan->seen->agents[scan->at[i]].agent, scan->at[i] };
            search->nearest[ranks[i]] = neighbor;
        }
    }
    if (kept == search->capacity) {
        scan->reach = search->nearest[kept - 1].gap + search->rounding;
    }
    return kept;
}

static void run_scan(neighbor_search *search)
{
    crowd_scan *scan = &search->scan;
    while (!search->kernels->scan(scan)) {
        scan->count = keep_nearest(search);
        for (uint32_t i = 0; i < scan->count; i++) {
            scan->gap[i] = search->nearest[i].gap;
            scan->at[i] = search->nearest[i].snapshot;
        }
    }
}

static void add_span(neighbor_search *search, uint32_t begin, uint32_t end)
{
    if (begin == end) {
        return;
    }
    if (search->scan.span_count == CROWD_MAX_SPANS) {
        run_scan(search);
    }
    const crowd_span span = { begin, end };
    search->scan.spans[search->scan.span_count++] = span;
}

// The cells of a row from column x0 to x1, which may go round the grid. Returns how many agents are in them.
static uint32_t add_cell_row(neighbor_search *search, int32_t row, int32_t x0, int32_t x1)
{
    const crowd_grid *grid = &search->crowd->grid;
    const uint32_t *first = grid->first + ((size_t)((uint32_t)row & grid->mask_z) << grid->shift_z);
    const uint32_t begin = (uint32_t)x0 & grid->mask_x;
    const uint32_t end = (uint32_t)x1 & grid->mask_x;
    if (begin <= end) {
        add_span(search, first[begin], first[end + 1]);
        return first[end + 1] - first[begin];
    }
    add_span(search, first[begin], first[grid->mask_x + 1]);
    add_span(search, first[0], first[end + 1]);
    return first[grid->mask_x + 1] - first[begin] + first[end + 1] - first[0];
}

// The agent's place in the grid.
typedef struct grid_place {
    crowd_cell_place x, z;
    float per_metre; // cells
    float slack;     // metres: what rounding may do to distances
} grid_place;

// Adds row `away` as far as the circle cuts it; false: it does not.
static bool add_cut_cell_row(neighbor_search *search, const grid_place *at, float far, int32_t away)
{
    const float cell = search->crowd->grid.cell_size;
    float off = away > 0 ? (float)away * cell - at->z.in : away < 0 ? at->z.in - (float)(away + 1) * cell : 0.0f;
    off = tl_max_f32(off - at->slack, 0.0f);
    if (!(off < far)) {
        return false;
    }
    const float half = sqrtf((far - off) * (far + off)) * (1.0f + HALF_ROUNDING) + at->slack;
    const float left = half - at->x.in;
    const int32_t x0 = left > 0.0f ? -1 - (int32_t)(left * at->per_metre) : 0;
    add_cell_row(search, at->z.cell + away, at->x.cell + x0, at->x.cell + (int32_t)((at->x.in + half) * at->per_metre));
    return true;
}

// All cells that the circle meets, each once.
static void scan_circle(neighbor_search *search, const grid_place *at)
{
    const crowd_grid *grid = &search->crowd->grid;
    const crowd_snapshot *seen = &search->crowd->seen;
    const float far = search->scan.reach + seen->agents[search->scan.self].radius + seen->max_radius + at->slack;
    if (2.0f * (far + at->slack) / grid->cell_size + 4.0f < (float)tl_min_u32(grid->mask_x, grid->mask_z)) {
        bool is_up = true, is_down = true;
        add_cut_cell_row(search, at, far, 0);
        for (int32_t away = 1; is_up || is_down; away++) {
            is_up = is_up && add_cut_cell_row(search, at, far, away);
            is_down = is_down && add_cut_cell_row(search, at, far, -away);
        }
    } else {
        add_span(search, 0, seen->count); // the grid goes round within it
    }
    run_scan(search);
}

// Looks in the cells around the agent's own, where they hold a throng. True: no other cell holds a nearer one.
static bool scan_throng(neighbor_search *search, const grid_place *at)
{
    const crowd_snapshot *seen = &search->crowd->seen;
    uint32_t count = 0;
    for (int32_t row = -1; row <= 1; row++) {
        count += add_cell_row(search, at->z.cell + row, at->x.cell - 1, at->x.cell + 1);
    }
    if (count <= THRONG * search->capacity) {
        search->scan.span_count = 0;
        return false;
    }
    run_scan(search);
    // Beyond the cells around it every center is more than a cell away.
    const uint32_t found = keep_nearest(search);
    const float cell = search->crowd->grid.cell_size;
    const bool is_done =
        found == search->capacity &&
        search->nearest[found - 1].gap < cell - seen->agents[search->scan.self].radius - seen->max_radius;
    search->scan.count = is_done ? found : 0;
    return is_done;
}

uint32_t tl_crowd_find_neighbors(const tl_nav_crowd *crowd, uint32_t k, crowd_neighbor *neighbors_out)
{
    const crowd_snapshot *seen = &crowd->seen;
    const float cell = crowd->grid.cell_size;
    neighbor_search search;
    search.crowd = crowd;
    search.kernels = tl_crowd_best_kernels();
    search.rounding = DISTANCE_ROUNDING * (crowd->def.neighbor_distance + seen->agents[k].radius + seen->max_radius);
    search.capacity = crowd->def.max_neighbors;
    search.nearest = neighbors_out;
    search.scan.seen = seen;
    search.scan.self = k;
    search.scan.reach = crowd->def.neighbor_distance;
    search.scan.next_span = search.scan.span_count = 0;
    search.scan.full = search.capacity + CROWD_MORE_FOUND;
    search.scan.count = 0;
    const double largest = fmax(fabs((double)seen->agents[k].x), fabs((double)seen->agents[k].z));
    const grid_place at = { tl_crowd_place_in_grid(seen->agents[k].x, cell),
                            tl_crowd_place_in_grid(seen->agents[k].z, cell), 1.0f / cell,
                            search.rounding + (float)(PLACE_ROUNDING * largest) };
    if (scan_throng(&search, &at)) {
        return search.scan.count;
    }
    scan_circle(&search, &at);
    return keep_nearest(&search);
}
