// SPDX-License-Identifier: MIT
//
// The nearest neighbours of an agent, from the grid: first the cells around its own, which are enough in a throng; else
// all cells in reach. Which of them are nearest is a total order (by gap, then place), so the order of the scan does
// not count.

#include "nav_crowd/crowd_neighbors.h"

#include "base/min_max.h"

typedef struct neighbor_search {
    const tl_nav_crowd *crowd;
    uint32_t self;
    float reach;    // metres, rim to rim
    float rounding; // metres: of distances
    crowd_neighbor *found;
    uint32_t count, capacity;
} neighbor_search;

static void keep_nearest(neighbor_search *search, crowd_neighbor neighbor)
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
    if (search->count == search->capacity) {
        // Nothing farther than the last one counts; by no less than the rounding of a distance.
        search->reach = search->found[search->count - 1].gap + search->rounding;
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

// Scans all cells that are at most `cells` columns and rows away, each once.
static void scan_around(neighbor_search *search, int32_t x, int32_t z, int32_t cells)
{
    const crowd_grid *grid = &search->crowd->grid;
    const int32_t columns = tl_min_i32(cells, (int32_t)(grid->mask_x / 2));
    const int32_t rows = tl_min_i32(cells, (int32_t)(grid->mask_z / 2));
    search->count = 0;
    // Where the ring of cells closes, its last column or row is reached from one side alone.
    const int32_t last_x = x + columns + (columns < cells ? 1 : 0);
    const int32_t last_z = z + rows + (rows < cells ? 1 : 0);
    // From the middle outward: the nearest come first, and those after them are soon out of reach.
    for (int32_t far = 0; far <= last_z - z; far++) {
        scan_row(search, z + far, x - columns, last_x);
        if (far > 0 && far <= rows) {
            scan_row(search, z - far, x - columns, last_x);
        }
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

uint32_t tl_crowd_find_neighbors(const tl_nav_crowd *crowd, uint32_t k, crowd_neighbor *neighbors_out)
{
    const crowd_snapshot *seen = &crowd->seen;
    const float cell = crowd->grid.cell_size;
    const float widest = crowd->def.neighbor_distance + seen->radius[k] + seen->max_radius;
    // Distances are sums and a root, of numbers up to the widest: four roundings.
    neighbor_search search = { crowd,         k, crowd->def.neighbor_distance, 8.0f * FLT_EPSILON * widest,
                               neighbors_out, 0, crowd->def.max_neighbors };
    const int32_t x = tl_crowd_cell(seen->x[k], cell);
    const int32_t z = tl_crowd_cell(seen->z[k], cell);
    // Beyond the cells around it every center is more than a cell away.
    const float unseen = cell - seen->radius[k] - seen->max_radius;
    const bool is_dense = count_near(crowd, x, z) > search.capacity;
    if (is_dense) {
        scan_around(&search, x, z, 1);
    }
    if (!is_dense || search.count < search.capacity || search.found[search.count - 1].gap >= unseen) {
        search.reach = crowd->def.neighbor_distance;
        scan_around(&search, x, z, (int32_t)tl_min_f32(widest / cell + 1.0f, 1048576.0f));
    }
    return search.count;
}
