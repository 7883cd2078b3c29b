// SPDX-License-Identifier: MIT
//
// The nearest neighbours of an agent, from the grid: first the cells around its own, which are enough in a throng; else
// all cells in reach. Which of them are nearest is a total order (by gap, then place), so the order of the scan does
// not count.
//
// Rows are scanned from the agent's own outward, each no farther than the circle in which agents still count, which
// shrinks with what is found. The first sixteen that are found are put in order at once, by counting how many come
// before each: no branch of that depends on the data, while each insertion costs a mispredicted one.

#include "nav_crowd/crowd_neighbors.h"

#include "base/min_max.h"

#include <string.h>

enum {
    FIRST_FOUND = 16,            // are put in order at once
    IN_ORDER = FIRST_FOUND + 1u, // `first_count` after that
};

// Half of a row's part is a root of a product of sums, times the cells of a metre: six roundings of half an ulp.
#define HALF_ROUNDING (8.0f * FLT_EPSILON)

// Distances are sums and a root of numbers up to the widest one: a share of it, four roundings and as many again.
#define DISTANCE_ROUNDING (8.0f * FLT_EPSILON)

// A place in a cell is a quotient, a product and a difference of doubles: a share of the coordinate.
#define PLACE_ROUNDING (4.0 * DBL_EPSILON)

typedef struct neighbor_search {
    const tl_nav_crowd *crowd;
    uint32_t self;
    float reach;    // metres, rim to rim
    float rounding; // metres: of distances
    crowd_neighbor *found;
    uint32_t count, capacity;
    uint32_t first_count;
    crowd_neighbor first[FIRST_FOUND];
} neighbor_search;

// A gap and the place that breaks ties, as a number in the same order. A gap is a difference, hence never -0.
static uint64_t order_of(const crowd_neighbor *neighbor)
{
    uint32_t bits;
    memcpy(&bits, &neighbor->gap, sizeof bits);
    bits = (bits & 0x80000000u) != 0 ? ~bits : bits | 0x80000000u;
    return (uint64_t)bits << 32 | neighbor->agent;
}

// Nothing farther than the last one counts; by no less than the rounding of a distance.
static void shrink_reach(neighbor_search *search)
{
    if (search->count == search->capacity) {
        search->reach = search->found[search->count - 1].gap + search->rounding;
    }
}

static void order_first(neighbor_search *search)
{
    const uint32_t count = search->first_count;
    uint64_t order[FIRST_FOUND];
    uint32_t rank[FIRST_FOUND];
    for (uint32_t i = 0; i < count; i++) {
        const uint64_t mine = order_of(&search->first[i]);
        uint32_t before = 0;
        for (uint32_t k = 0; k < i; k++) {
            const uint32_t is_before = order[k] < mine;
            before += is_before;
            rank[k] += 1 - is_before;
        }
        order[i] = mine;
        rank[i] = before;
    }
    for (uint32_t i = 0; i < count; i++) {
        if (rank[i] < search->capacity) {
            search->found[rank[i]] = search->first[i];
        }
    }
    search->count = tl_min_u32(count, search->capacity);
    search->first_count = IN_ORDER;
    shrink_reach(search);
}

static void insert_neighbor(neighbor_search *search, crowd_neighbor neighbor)
{
    if (search->count == search->capacity) {
        const crowd_neighbor *last = &search->found[search->count - 1];
        if (neighbor.gap > last->gap || (neighbor.gap == last->gap && neighbor.agent > last->agent)) {
            return;
        }
        search->count--;
    }
    uint32_t at = search->count++;
    while (at > 0 && (neighbor.gap < search->found[at - 1].gap ||
                      (neighbor.gap == search->found[at - 1].gap && neighbor.agent < search->found[at - 1].agent))) {
        search->found[at] = search->found[at - 1];
        at--;
    }
    search->found[at] = neighbor;
    shrink_reach(search);
}

static void keep_nearest(neighbor_search *search, crowd_neighbor neighbor)
{
    if (search->first_count == FIRST_FOUND) {
        order_first(search);
    }
    if (search->first_count < FIRST_FOUND) {
        search->first[search->first_count++] = neighbor;
    } else {
        insert_neighbor(search, neighbor);
    }
}

static void begin_search(neighbor_search *search, float reach)
{
    search->reach = reach;
    search->count = 0;
    search->first_count = 0;
}

static void end_search(neighbor_search *search)
{
    if (search->first_count != IN_ORDER) {
        order_first(search);
    }
}

static void scan_cells(neighbor_search *search, uint32_t begin, uint32_t end)
{
    const crowd_snapshot *seen = &search->crowd->seen;
    const uint32_t self = search->self;
    const float x = seen->x[self], z = seen->z[self];
    const float low = seen->y[self], high = seen->y[self] + seen->height[self];
    for (uint32_t k = begin; k < end; k++) {
        float dx = seen->x[k] - x;
        float dz = seen->z[k] - z;
        float rims = seen->radius[k] + seen->radius[self];
        float far = search->reach + rims;
        float distance_sq = dx * dx + dz * dz;
        if (!(distance_sq < far * far) || seen->y[k] >= high || seen->y[k] + seen->height[k] <= low || k == self) {
            continue;
        }
        const crowd_neighbor neighbor = { sqrtf(distance_sq) - rims, seen->agent[k], k };
        keep_nearest(search, neighbor);
    }
}

// Scans the cells of a row from column x0 to x1, which may go round the grid.
static void scan_row(neighbor_search *search, int32_t row, int32_t x0, int32_t x1)
{
    const crowd_grid *grid = &search->crowd->grid;
    const uint32_t *first = grid->first + ((size_t)((uint32_t)row & grid->mask_z) << grid->shift_z);
    uint32_t begin = (uint32_t)x0 & grid->mask_x;
    uint32_t end = (uint32_t)x1 & grid->mask_x;
    if (begin <= end) {
        scan_cells(search, first[begin], first[end + 1]);
    } else {
        scan_cells(search, first[begin], first[grid->mask_x + 1]);
        scan_cells(search, first[0], first[end + 1]);
    }
}

// The agent's cell, and how far it stands within that.
typedef struct cell_place {
    int32_t x, z;
    float in_x, in_z; // metres, 0 to a cell
    float per_metre;  // cells
    float slack;      // metres: what rounding may do to distances
} cell_place;

// Scans row `z + away` as far as the circle cuts it; false: it does not.
static bool scan_cut_row(neighbor_search *search, const cell_place *at, int32_t away)
{
    const crowd_snapshot *seen = &search->crowd->seen;
    const float cell = search->crowd->grid.cell_size;
    const float far = search->reach + seen->radius[search->self] + seen->max_radius + at->slack;
    float off = away > 0 ? (float)away * cell - at->in_z : away < 0 ? at->in_z - (float)(away + 1) * cell : 0.0f;
    off = tl_max_f32(off - at->slack, 0.0f);
    if (!(off < far)) {
        return false;
    }
    const float half = sqrtf((far - off) * (far + off)) * (1.0f + HALF_ROUNDING) + at->slack;
    const float left = half - at->in_x;
    const int32_t x0 = left > 0.0f ? -1 - (int32_t)(left * at->per_metre) : 0;
    scan_row(search, at->z + away, at->x + x0, at->x + (int32_t)((at->in_x + half) * at->per_metre));
    return true;
}

// All cells that the circle meets, each once.
static void scan_circle(neighbor_search *search, const cell_place *at)
{
    const crowd_grid *grid = &search->crowd->grid;
    const crowd_snapshot *seen = &search->crowd->seen;
    const float far = search->reach + seen->radius[search->self] + seen->max_radius + at->slack;
    if (!(2.0f * (far + at->slack) / grid->cell_size + 4.0f < (float)tl_min_u32(grid->mask_x, grid->mask_z))) {
        scan_cells(search, 0, seen->count); // the grid goes round within it
        return;
    }
    bool is_up = true, is_down = true;
    scan_cut_row(search, at, 0);
    for (int32_t away = 1; is_up || is_down; away++) {
        is_up = is_up && scan_cut_row(search, at, away);
        is_down = is_down && scan_cut_row(search, at, -away);
    }
}

// Agents in the nine cells around one, itself included; more where the grid goes round.
static uint32_t count_near(const tl_nav_crowd *crowd, int32_t x, int32_t z)
{
    const crowd_grid *grid = &crowd->grid;
    uint32_t count = 0;
    for (int32_t row = z - 1; row <= z + 1; row++) {
        const uint32_t *first = grid->first + ((size_t)((uint32_t)row & grid->mask_z) << grid->shift_z);
        for (int32_t column = x - 1; column <= x + 1; column++) {
            uint32_t cell = (uint32_t)column & grid->mask_x;
            count += first[cell + 1] - first[cell];
        }
    }
    return count;
}

// How far a coordinate lies within its cell.
static float in_cell(float at, float cell_size)
{
    return (float)((double)at - floor((double)at / (double)cell_size) * (double)cell_size);
}

uint32_t tl_crowd_find_neighbors(const tl_nav_crowd *crowd, uint32_t k, crowd_neighbor *neighbors_out)
{
    const crowd_snapshot *seen = &crowd->seen;
    const float cell = crowd->grid.cell_size;
    const float widest = crowd->def.neighbor_distance + seen->radius[k] + seen->max_radius;
    neighbor_search search;
    search.crowd = crowd;
    search.self = k;
    search.rounding = DISTANCE_ROUNDING * widest;
    search.found = neighbors_out;
    search.capacity = crowd->def.max_neighbors;
    const double largest = fmax(fabs((double)seen->x[k]), fabs((double)seen->z[k]));
    const cell_place at = { tl_crowd_cell(seen->x[k], cell),
                            tl_crowd_cell(seen->z[k], cell),
                            in_cell(seen->x[k], cell),
                            in_cell(seen->z[k], cell),
                            1.0f / cell,
                            search.rounding + (float)(PLACE_ROUNDING * largest) };
    begin_search(&search, crowd->def.neighbor_distance);
    if (count_near(crowd, at.x, at.z) > search.capacity) {
        for (int32_t row = -1; row <= 1; row++) {
            scan_row(&search, at.z + row, at.x - 1, at.x + 1);
        }
        end_search(&search);
        // Beyond the cells around it every center is more than a cell away.
        if (search.count == search.capacity &&
            search.found[search.count - 1].gap < cell - seen->radius[k] - seen->max_radius) {
            return search.count;
        }
        begin_search(&search, search.reach);
    }
    scan_circle(&search, &at);
    end_search(&search);
    return search.count;
}
